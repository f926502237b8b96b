// SPDX-License-Identifier: BSD-3-Clause
#include "ImagePreparation/ImageScalars.h"

#include "ImagePreparation/ImageObstacles.h"
#include "Preparation/InputSignature.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkImageData.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace tetralux
{
namespace
{

/// Values that one task copies.
constexpr vtkIdType Grain = 65536;

/// The types that the caster reads as they are.
template <class T>
constexpr bool IsPlain = std::is_same_v<T, float> || (std::is_integral_v<T> && sizeof(T) <= 2);

template <class T>
constexpr ImageScalar GetImageScalar()
{
  if constexpr (std::is_same_v<T, float>)
  {
    return ImageScalar::Float;
  }
  else if constexpr (sizeof(T) == 1)
  {
    return std::is_signed_v<T> ? ImageScalar::Int8 : ImageScalar::UInt8;
  }
  else
  {
    return std::is_signed_v<T> ? ImageScalar::Int16 : ImageScalar::UInt16;
  }
}

/// The scalar of a tuple, in double precision.
template <class TupleT>
double GetScalar(const TupleT& tuple, const SelectedArray& selected)
{
  if (!selected.Magnitude)
  {
    return static_cast<double>(tuple[selected.Component]);
  }
  double sum = 0;
  for (const auto value : tuple)
  {
    sum += static_cast<double>(value) * static_cast<double>(value);
  }
  return std::sqrt(sum);
}

/// Smallest and largest finite scalar; the first above the second where there is none.
struct Range
{
  double Least = std::numeric_limits<double>::infinity();
  double Largest = -std::numeric_limits<double>::infinity();

  void Add(double value)
  {
    if (std::isfinite(value))
    {
      this->Least = std::min(this->Least, value);
      this->Largest = std::max(this->Largest, value);
    }
  }
};

template <class TuplesT>
Range FindRange(const TuplesT& tuples, const SelectedArray& selected)
{
  vtkSMPThreadLocal<Range> parts;
  vtkSMPTools::For(0, tuples.size(), Grain,
    [&](vtkIdType begin, vtkIdType end)
    {
      Range& part = parts.Local();
      for (vtkIdType i = begin; i < end; ++i)
      {
        part.Add(GetScalar(tuples[i], selected));
      }
    });
  Range range;
  for (const Range& part : parts)
  {
    range.Add(part.Least);
    range.Add(part.Largest);
  }
  return range;
}

/// Scale and offset that bring a range to -2..2 without a rounding of the scale, so that floats
/// keep the range as exactly as they can.
void SetRange(const Range& range, ImageVolume& volume)
{
  volume.Scale = 1;
  volume.Offset = 0;
  if (range.Least <= range.Largest)
  {
    volume.Offset = range.Least + (range.Largest / 2 - range.Least / 2);
    const double half = range.Largest / 2 - range.Least / 2;
    volume.Scale = half > 0 ? std::exp2(std::ilogb(half)) : 1;
  }
}

/// Fills a volume from an array: in place, or by a copy.
struct ReadArray
{
  template <class ArrayT>
  void operator()(ArrayT* array, const SelectedArray& selected, vtkIdType count,
    ImageVolume& volume, std::vector<unsigned char>& copy) const
  {
    using ValueT = vtk::GetAPIType<ArrayT>;
    const auto tuples = vtk::DataArrayTupleRange(array, 0, count);
    volume.Scale = 1;
    volume.Offset = 0;
    if constexpr (IsPlain<ValueT>)
    {
      if (!selected.Magnitude)
      {
        volume.Type = GetImageScalar<ValueT>();
        const bool inPlace =
          array->GetNumberOfComponents() == 1 && array->HasStandardMemoryLayout();
        if (inPlace && !this->HasInfinite<ValueT>(tuples, selected))
        {
          copy = {};
          volume.Values = array->GetVoidPointer(0);
          return;
        }
        this->Copy<ValueT>(tuples, copy, volume,
          [&](const auto& tuple) { return this->MakeFinite(ValueT(tuple[selected.Component])); });
        return;
      }
    }
    volume.Type = ImageScalar::Float;
    SetRange(FindRange(tuples, selected), volume);
    this->Copy<float>(tuples, copy, volume,
      [&](const auto& tuple)
      {
        const double scalar = GetScalar(tuple, selected);
        return this->MakeFinite(static_cast<float>((scalar - volume.Offset) / volume.Scale));
      });
  }

private:
  template <class T>
  static T MakeFinite(T value)
  {
    if constexpr (std::is_same_v<T, float>)
    {
      return std::isfinite(value) ? value : std::numeric_limits<float>::quiet_NaN();
    }
    else
    {
      return value;
    }
  }

  template <class T, class TuplesT>
  static bool HasInfinite(const TuplesT& tuples, const SelectedArray& selected)
  {
    if constexpr (std::is_same_v<T, float>)
    {
      return std::any_of(tuples.begin(), tuples.end(),
        [&](const auto& tuple)
        { return std::isinf(static_cast<float>(tuple[selected.Component])); });
    }
    else
    {
      return false;
    }
  }

  template <class T, class TuplesT, class ScalarT>
  static void Copy(const TuplesT& tuples, std::vector<unsigned char>& copy, ImageVolume& volume,
    const ScalarT& getScalar)
  {
    copy.resize(sizeof(T) * tuples.size());
    T* values = reinterpret_cast<T*>(copy.data());
    vtkSMPTools::For(0, tuples.size(), Grain,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          values[i] = getScalar(tuples[i]);
        }
      });
    volume.Values = values;
  }
};

} // namespace

bool ImageScalars::Update(vtkImageData* image, const ScalarSelection& selection)
{
  CacheKey array = GetScalarsKey({ { image, 0, 0 } }, selection);
  const SelectedArray selected = FindSelectedArray(image, selection);
  if (selected.Array && selected.Array->HasStandardMemoryLayout())
  {
    // Memory that is read in place may be replaced without a new time.
    array.Add(selected.Array->GetVoidPointer(0));
    array.Add(selected.Array->GetNumberOfValues());
  }
  CacheKey grid = GetCellsKey({ { image, 0, 0 } });
  if (this->Array.Has(array) && this->Grid.Has(grid))
  {
    return false;
  }
  this->Array.Reset();
  const std::string obstacle = FindObstacle(image, selection);
  if (!obstacle.empty())
  {
    throw std::invalid_argument(obstacle);
  }
  image->GetDimensions(this->Volume.Dimensions);
  const vtkIdType count = image->GetNumberOfPoints();
  ReadArray worker;
  if (!vtkArrayDispatch::Dispatch::Execute(
        selected.Array, worker, selected, count, this->Volume, this->Copy))
  {
    worker(selected.Array, selected, count, this->Volume, this->Copy);
  }
  this->ArrayName = selected.Array->GetName() ? selected.Array->GetName() : "";
  this->TypeName = selected.Array->GetDataTypeAsString();
  this->NumberOfComponents = selected.Array->GetNumberOfComponents();
  this->Array.Set(std::move(array));
  this->Grid.Set(std::move(grid));
  return true;
}

} // namespace tetralux
