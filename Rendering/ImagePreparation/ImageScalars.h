// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageScalars_h
#define tetralux_ImageScalars_h

#include "Base/Cached.h"
#include "Base/Digest.h"
#include "Intake/ScalarExtraction.h"
#include "TetraluxRenderingModule.h"
#include "TriangleCaster/ImageVolume.h"

#include "vtkType.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkImageData;

namespace tetralux
{

/// The scalars of image data as a volume, with the flags of points and cells that are hidden.
/// Arrays of 8 or 16 bit integers or of floats are read where they are, with all of up to 4
/// components if the vector mode is disabled. One component of several of these types is copied, as
/// it is; all else is brought to floats relative to the middle of the range of all components.
/// Values that are infinite become not-a-number. A copy is kept until the array or the choice of it
/// changes.
class TETRALUXRENDERING_EXPORT ImageScalars
{
public:
  /// Brings the volume up to date; returns whether its values may have changed. Throws
  /// std::invalid_argument, with one line, if the array is not there, or FindObstacle finds one.
  bool Update(vtkImageData* image, const ScalarSelection& selection);

  const ImageVolume& GetVolume() const { return this->Volume; }
  const std::string& GetArrayName() const { return this->ArrayName; }    ///< may be empty
  const std::string& GetTypeName() const { return this->TypeName; }      ///< of the array
  int GetNumberOfComponents() const { return this->NumberOfComponents; } ///< of the array
  int GetValueType() const { return this->ValueType; }                   ///< of VTK, of the array

  /// Of the copy; 0 where values are read in place.
  std::size_t GetNumberOfCopiedBytes() const { return this->Copy.size(); }

private:
  vtkMTimeType InputTime = 0; ///< of input and attributes, when values were last compared
  Digest Values{};            ///< of the array and of flags
  CacheStamp Array;
  CacheStamp Grid; ///< extent and ghosts
  ImageVolume Volume;
  std::vector<unsigned char> Copy;
  std::string ArrayName;
  std::string TypeName;
  int NumberOfComponents = 0;
  int ValueType = 0;
};

} // namespace tetralux

#endif
