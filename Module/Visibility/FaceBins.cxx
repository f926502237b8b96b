// SPDX-License-Identifier: BSD-3-Clause
#include "Visibility/FaceBins.h"

#include <cmath>
#include <limits>

namespace tetralux
{
namespace
{

/// How far in front of the viewer all faces must be, along the view to the middle of the mesh: so
/// that places on the picture have a bound, and with it their rounding.
constexpr double SmallestDepth = 1. / 16;

/// What boxes are widened by: of the extent of all, far more than double precision rounds, and far
/// less than a face; and of the largest place, some hundred roundings, which a viewer far away
/// leaves.
constexpr double MarginOfExtent = 1e-9;
constexpr double MarginOfPlace = 1e-14;

constexpr double FacesPerBin = 2;
constexpr std::int32_t LargestResolution = 512;

/// Fewer bins than that, of many faces, are no better than a hierarchy.
constexpr std::int32_t SmallestResolution = 8;

/// Entries in bins, for each face, beyond which bins are too small for the faces.
constexpr std::int64_t LargestShare = 8;

} // namespace

FaceBins::FaceBins(
  const VisibilityView& view, Span<const Face> faces, Span<const std::uint8_t> binned)
{
  if (this->FindBoxes(view, faces))
  {
    this->Fill(binned);
  }
}

bool FaceBins::FindBoxes(const VisibilityView& view, Span<const Face> faces)
{
  // Towards the origin, and across.
  Corner axes[3];
  double length = 0;
  for (int a = 0; a < 3; ++a)
  {
    axes[2][a] = view.Parallel ? view.Direction[a] : -view.Eye[a];
    length = std::hypot(length, axes[2][a]);
  }
  if (!(length > 0) || !std::isfinite(length))
  {
    return false;
  }
  int least = 0;
  for (int a = 0; a < 3; ++a)
  {
    axes[2][a] /= length;
    least = std::abs(axes[2][a]) < std::abs(axes[2][least]) ? a : least;
  }
  const auto cross = [](const Corner& a, const Corner& b)
  {
    return Corner{ a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
      a[0] * b[1] - a[1] * b[0] };
  };
  Corner unit = { 0, 0, 0 };
  unit[least] = 1;
  axes[0] = cross(unit, axes[2]);
  axes[1] = cross(axes[2], axes[0]);

  constexpr double infinity = std::numeric_limits<double>::infinity();
  double nearest = infinity;
  double lo[2] = { infinity, infinity };
  double hi[2] = { -infinity, -infinity };
  const auto numberOfFaces = static_cast<std::int64_t>(faces.size());
  this->Boxes.resize(faces.size());
#pragma omp parallel for schedule(static) reduction(min : nearest, lo) reduction(max : hi)
  for (std::int64_t face = 0; face < numberOfFaces; ++face)
  {
    Box& box = this->Boxes[face];
    std::fill_n(box.Lo, 2, infinity);
    std::fill_n(box.Hi, 2, -infinity);
    for (const Corner& corner : faces[face])
    {
      double along[3] = { 0, 0, 0 };
      for (int axis = 0; axis < 3; ++axis)
      {
        for (int a = 0; a < 3; ++a)
        {
          along[axis] += axes[axis][a] * (corner[a] - (view.Parallel ? 0 : view.Eye[a]));
        }
      }
      const double depth = view.Parallel ? 1 : along[2];
      nearest = std::min(nearest, depth);
      for (int axis = 0; axis < 2; ++axis)
      {
        const double place = along[axis] / depth;
        box.Lo[axis] = std::min(box.Lo[axis], place);
        box.Hi[axis] = std::max(box.Hi[axis], place);
      }
    }
    for (int axis = 0; axis < 2; ++axis)
    {
      lo[axis] = std::min(lo[axis], box.Lo[axis]);
      hi[axis] = std::max(hi[axis], box.Hi[axis]);
    }
  }
  if (!(nearest >= SmallestDepth) || faces.empty())
  {
    return false;
  }
  const double largest =
    std::max({ std::abs(lo[0]), std::abs(lo[1]), std::abs(hi[0]), std::abs(hi[1]) });
  const double extent = std::max(hi[0] - lo[0], hi[1] - lo[1]);
  const double margin = MarginOfExtent * extent + MarginOfPlace * largest;
  for (Box& box : this->Boxes)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      box.Lo[axis] -= margin;
      box.Hi[axis] += margin;
    }
  }
  for (int axis = 0; axis < 2; ++axis)
  {
    this->Origin[axis] = lo[axis] - margin;
    this->BinsPerLength[axis] = 1 / (hi[axis] - lo[axis] + 2 * margin); // of one bin in all
  }
  return std::isfinite(this->BinsPerLength[0]) && std::isfinite(this->BinsPerLength[1]);
}

void FaceBins::Fill(Span<const std::uint8_t> binned)
{
  std::vector<std::int32_t> chosen;
  for (std::size_t face = 0; face < binned.size(); ++face)
  {
    if (binned[face] != 0)
    {
      chosen.push_back(static_cast<std::int32_t>(face));
    }
  }
  const double perLength[2] = { this->BinsPerLength[0], this->BinsPerLength[1] };
  const auto wish =
    static_cast<std::int32_t>(std::sqrt(static_cast<double>(chosen.size()) / FacesPerBin));
  const std::int32_t finest = std::clamp(wish, 1, LargestResolution);
  const std::int32_t coarsest = std::min(finest, SmallestResolution);
  for (std::int32_t resolution = finest; resolution >= coarsest; resolution /= 2)
  {
    this->Resolution = resolution;
    for (int axis = 0; axis < 2; ++axis)
    {
      this->BinsPerLength[axis] = perLength[axis] * resolution;
    }
    std::int64_t entries = 0;
    this->Begins.assign(static_cast<std::size_t>(resolution) * resolution + 1, 0);
    const auto forEachBin = [this](std::int32_t face, const auto& act)
    {
      const Range range = this->FindRange(this->Boxes[face]);
      for (std::int32_t row = range.Lo[1]; row <= range.Hi[1]; ++row)
      {
        for (std::int32_t column = range.Lo[0]; column <= range.Hi[0]; ++column)
        {
          act(row * this->Resolution + column);
        }
      }
    };
    const auto largest = LargestShare * static_cast<std::int64_t>(chosen.size());
    for (std::size_t i = 0; i < chosen.size() && entries <= largest; ++i)
    {
      forEachBin(chosen[i],
        [&](std::int32_t bin)
        {
          ++this->Begins[bin + 1];
          ++entries;
        });
    }
    if (entries > largest)
    {
      continue;
    }
    for (std::size_t bin = 1; bin < this->Begins.size(); ++bin)
    {
      this->Begins[bin] += this->Begins[bin - 1];
    }
    std::vector<std::int32_t> next(this->Begins.begin(), this->Begins.end() - 1);
    this->Faces.resize(entries);
    for (const std::int32_t face : chosen)
    {
      forEachBin(face, [&](std::int32_t bin) { this->Faces[next[bin]++] = face; });
    }
    return;
  }
  this->Resolution = 0;
}

} // namespace tetralux
