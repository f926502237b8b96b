// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MapperGroup_h
#define tetralux_MapperGroup_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkAbstractVolumeMapper;
class vtkImplicitFunction;

namespace tetralux
{

/// The mappers of a representation, whose properties its panel sets together.
class MapperGroup
{
public:
  MapperGroup();
  ~MapperGroup();

  void Add(vtkAbstractVolumeMapper* mapper);

  /// Sets a property of the property table where mappers have it; an enumeration where they honour
  /// the value. Throws std::out_of_range if the table has no property of that name.
  void SetProperty(const char* name, const std::vector<double>& values);

  /// What is shown is inside of it, see MakeClippingPlanes. nullptr: everything is shown.
  void SetClipFunction(vtkImplicitFunction* function);

  /// To be called before each frame: follows changes of the clip function.
  void UpdateClippingPlanes();

private:
  std::vector<vtkSmartPointer<vtkAbstractVolumeMapper>> Mappers;
  vtkSmartPointer<vtkImplicitFunction> ClipFunction;
  unsigned long long ClipTime = 0; ///< of the function that the planes are of
};

} // namespace tetralux

#endif
