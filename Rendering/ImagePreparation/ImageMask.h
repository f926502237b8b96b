// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageMask_h
#define tetralux_ImageMask_h

#include "Base/Cached.h"
#include "TriangleCaster/ImageVolume.h"

#include <vector>

class vtkImageData;

namespace tetralux
{

/// What a mask says of the points of image data.
enum class MaskType
{
  Binary, ///< where it is 0 there is nothing
  Labels  ///< which functions of the property a point has
};

/// A mask as a volume has it. Arrays of unsigned bytes are read where they are; others are copied,
/// and the copy is kept until the mask changes.
class ImageMask
{
public:
  /// Brings the mask up to date; returns whether its values may have changed. mask: may be nullptr.
  /// dimensions: of the image. Throws std::invalid_argument, with one line, if those of the mask
  /// are others, if it has no scalars of one component, or labels that are not within 0..255.
  bool Update(vtkImageData* mask, MaskType type, const int dimensions[3]);

  /// Gives a volume the mask.
  void AddTo(ImageVolume& volume) const;

  bool HasLabels() const { return this->Values && this->Type == MaskType::Labels; }

private:
  CacheStamp Stamp;
  MaskType Type = MaskType::Labels;
  const unsigned char* Values = nullptr;
  std::vector<unsigned char> Copy;
};

} // namespace tetralux

#endif
