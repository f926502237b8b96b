// SPDX-License-Identifier: BSD-3-Clause
#include "ImagePreparation/ImageMask.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace tetralux
{
namespace
{

constexpr double LargestLabel = 255;

std::string DescribeSize(const int dimensions[3])
{
  return std::to_string(dimensions[0]) + " x " + std::to_string(dimensions[1]) + " x " +
    std::to_string(dimensions[2]);
}

} // namespace

bool ImageMask::Update(vtkImageData* mask, MaskType type, const int dimensions[3])
{
  vtkDataArray* array = mask ? mask->GetPointData()->GetScalars() : nullptr;
  CacheKey key = CacheKey::Of(mask, array, type);
  key.Add(mask ? mask->GetMTime() : 0);
  key.Add(array ? array->GetMTime() : 0);
  for (int a = 0; a < 3; ++a)
  {
    key.Add(dimensions[a]);
  }
  if (this->Stamp.Has(key))
  {
    return false;
  }
  this->Stamp.Reset();
  this->Values = nullptr;
  this->Type = type;
  if (mask)
  {
    const int* size = mask->GetDimensions();
    if (!std::equal(size, size + 3, dimensions))
    {
      throw std::invalid_argument("the MaskInput has " + DescribeSize(size) +
        " points; those of the image data are " + DescribeSize(dimensions));
    }
    if (!array || array->GetNumberOfComponents() != 1)
    {
      throw std::invalid_argument("the MaskInput has no scalars of one component at points");
    }
    auto* bytes = vtkUnsignedCharArray::SafeDownCast(array);
    if (bytes)
    {
      this->Copy = {};
      this->Values = bytes->GetPointer(0);
    }
    else
    {
      this->Copy.resize(array->GetNumberOfTuples());
      for (std::size_t i = 0; i < this->Copy.size(); ++i)
      {
        const double value = array->GetTuple1(static_cast<vtkIdType>(i));
        if (type == MaskType::Labels && !(value >= 0 && value <= LargestLabel))
        {
          throw std::invalid_argument(
            "the MaskInput has label " + std::to_string(value) + "; labels are from 0 to 255");
        }
        this->Copy[i] = type == MaskType::Labels ? static_cast<unsigned char>(value)
                                                 : static_cast<unsigned char>(value != 0);
      }
      this->Values = this->Copy.data();
    }
  }
  this->Stamp.Set(std::move(key));
  return true;
}

void ImageMask::AddTo(ImageVolume& volume) const
{
  (this->Type == MaskType::Labels ? volume.Labels : volume.Mask) = this->Values;
}

} // namespace tetralux
