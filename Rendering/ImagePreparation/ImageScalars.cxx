// SPDX-License-Identifier: BSD-3-Clause
#include "ImagePreparation/ImageScalars.h"

#include "ImagePreparation/ImageObstacles.h"
#include "Preparation/InputSignature.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
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

/// What of an array is read.
struct Choice
{
  bool Magnitude;
  int First; ///< component
  int Count; ///< of components
};

constexpr int DisabledVectorMode = -1; ///< of ScalarSelection

Choice Choose(const SelectedArray& selected, int vectorMode)
{
  const int components = selected.Array->GetNumberOfComponents();
  const bool all = vectorMode == DisabledVectorMode && components <= ImageVolume::MostComponents;
  return { selected.Magnitude, all ? 0 : selected.Component, all ? components : 1 };
}

/// A scalar of a tuple, in double precision. component: counted from the first that is read.
template <class TupleT>
double GetScalar(const TupleT& tuple, const Choice& selected, int component)
{
  if (!selected.Magnitude)
  {
    return static_cast<double>(tuple[selected.First + component]);
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
Range FindRange(const TuplesT& tuples, const Choice& selected)
{
  vtkSMPThreadLocal<Range> parts;
  vtkSMPTools::For(0, tuples.size(), Grain,
    [&](vtkIdType begin, vtkIdType end)
    {
      Range& part = parts.Local();
      for (vtkIdType i = begin; i < end; ++i)
      {
        for (int c = 0; c < selected.Count; ++c)
        {
          part.Add(GetScalar(tuples[i], selected, c));
        }
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
  void operator()(ArrayT* array, const Choice& selected, vtkIdType count, ImageVolume& volume,
    std::vector<unsigned char>& copy) const
  {
    using ValueT = vtk::GetAPIType<ArrayT>;
    const auto tuples = vtk::DataArrayTupleRange(array, 0, count);
    volume.Components = selected.Count;
    volume.Scale = 1;
    volume.Offset = 0;
    if constexpr (IsPlain<ValueT>)
    {
      if (!selected.Magnitude)
      {
        volume.Type = GetImageScalar<ValueT>();
        const bool inPlace =
          array->GetNumberOfComponents() == selected.Count && array->HasStandardMemoryLayout();
        if (inPlace && !this->HasInfinite<ValueT>(tuples, selected))
        {
          copy = {};
          volume.Values = array->GetVoidPointer(0);
          return;
        }
        this->Copy<ValueT>(tuples, copy, volume,
          [&](const auto& tuple, int c)
          { return this->MakeFinite(ValueT(tuple[selected.First + c])); });
        return;
      }
    }
    volume.Type = ImageScalar::Float;
    SetRange(FindRange(tuples, selected), volume);
    this->Copy<float>(tuples, copy, volume,
      [&](const auto& tuple, int c)
      {
        const double scalar = GetScalar(tuple, selected, c);
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
  static bool HasInfinite(const TuplesT& tuples, const Choice& selected)
  {
    if constexpr (std::is_same_v<T, float>)
    {
      return std::any_of(tuples.begin(), tuples.end(),
        [&](const auto& tuple)
        {
          bool infinite = false;
          for (int c = 0; c < selected.Count; ++c)
          {
            infinite = infinite || std::isinf(static_cast<float>(tuple[selected.First + c]));
          }
          return infinite;
        });
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
    const int components = volume.Components;
    copy.resize(sizeof(T) * components * tuples.size());
    T* values = reinterpret_cast<T*>(copy.data());
    vtkSMPTools::For(0, tuples.size(), Grain,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          for (int c = 0; c < components; ++c)
          {
            values[components * i + c] = getScalar(tuples[i], c);
          }
        }
      });
    volume.Values = values;
  }
};

/// Gives a volume the flags that say what is hidden.
void AddFlags(vtkImageData* image, ImageVolume& volume)
{
  const auto getFlags = [](vtkUnsignedCharArray* ghosts, vtkIdType count) -> const unsigned char*
  {
    if (ghosts && ghosts->GetNumberOfValues() != count)
    {
      throw std::invalid_argument("the image data have an array of ghosts with " +
        std::to_string(ghosts->GetNumberOfValues()) + " values for " + std::to_string(count) +
        " points or cells");
    }
    return ghosts ? ghosts->GetPointer(0) : nullptr;
  };
  volume.PointFlags = getFlags(image->GetPointGhostArray(), image->GetNumberOfPoints());
  volume.HidingPointFlags = vtkDataSetAttributes::HIDDENPOINT;
  volume.CellFlags = getFlags(image->GetCellGhostArray(), image->GetNumberOfCells());
  volume.HidingCellFlags = vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;
}

} // namespace

bool ImageScalars::Update(vtkImageData* image, const ScalarSelection& selection)
{
  const std::vector<DataSetBlock> blocks = { { image, 0, 0 } };
  CacheKey array = GetScalarsKey(blocks, selection);
  const SelectedArray selected = FindSelectedArray(image, selection);
  if (selected.Array && selected.Array->HasStandardMemoryLayout())
  {
    // Memory that is read in place may be replaced without a new time.
    array.Add(selected.Array->GetVoidPointer(0));
    array.Add(selected.Array->GetNumberOfValues());
  }
  CacheKey grid = GetCellsKey(blocks);
  const vtkMTimeType inputTime = std::max(GetInputTime(image, blocks), GetAttributesTime(blocks));
  const bool same = this->Array.Has(array) && this->Grid.Has(grid);
  if (same && inputTime == this->InputTime)
  {
    return false;
  }
  const Digest values = DigestScalars(blocks, selection);
  if (same && values == this->Values)
  {
    this->InputTime = inputTime;
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
  const Choice choice = Choose(selected, selection.VectorMode);
  ReadArray worker;
  if (!vtkArrayDispatch::Dispatch::Execute(
        selected.Array, worker, choice, count, this->Volume, this->Copy))
  {
    worker(selected.Array, choice, count, this->Volume, this->Copy);
  }
  AddFlags(image, this->Volume);
  this->ArrayName = selected.Array->GetName() ? selected.Array->GetName() : "";
  this->TypeName = selected.Array->GetDataTypeAsString();
  this->NumberOfComponents = selected.Array->GetNumberOfComponents();
  this->ValueType = selected.Array->GetDataType();
  this->InputTime = inputTime;
  this->Values = values;
  this->Array.Set(std::move(array));
  this->Grid.Set(std::move(grid));
  return true;
}

} // namespace tetralux
