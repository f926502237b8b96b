// SPDX-License-Identifier: BSD-3-Clause
#include "Visibility/TwinFaces.h"

#include "Base/RadixSort.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace tetralux
{
namespace
{

/// The corners of a face in an order that depends on their places alone.
using Places = std::array<std::array<double, 3>, 3>;

Places GetPlaces(const VisibilityGeometry& geometry, std::int64_t face)
{
  const WalkEntry& entry = geometry.Boundary->Entries[face];
  Places places;
  for (int corner = 0; corner < 3; ++corner)
  {
    const double* point = geometry.GetPoint(entry.Points[corner]);
    for (int axis = 0; axis < 3; ++axis)
    {
      places[corner][axis] = point[axis] + 0.; // one zero instead of two
    }
  }
  std::sort(places.begin(), places.end());
  return places;
}

/// Equal for equal places, and seldom for others.
std::uint32_t Mix(const Places& places)
{
  std::uint64_t mixed = 0;
  for (const auto& place : places)
  {
    for (const double coordinate : place)
    {
      std::uint64_t bits;
      std::memcpy(&bits, &coordinate, sizeof bits);
      // A step of Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators, 2014.
      mixed = (mixed ^ bits) * 0xbf58476d1ce4e5b9U;
      mixed ^= mixed >> 31;
    }
  }
  return static_cast<std::uint32_t>(mixed >> 32);
}

} // namespace

//----------------------------------------------------------------------------
std::vector<std::int32_t> FindTwinFaces(const VisibilityGeometry& geometry)
{
  const std::int64_t numberOfFaces = static_cast<std::int64_t>(geometry.Boundary->Entries.size());
  std::vector<KeyedItem> faces(numberOfFaces);
#pragma omp parallel for schedule(static)
  for (std::int64_t face = 0; face < numberOfFaces; ++face)
  {
    faces[face] = { Mix(GetPlaces(geometry, face)), static_cast<std::int32_t>(face) };
  }
  std::vector<KeyedItem> buffer;
  SortByKey(faces, buffer);

  std::vector<std::int32_t> twins(numberOfFaces, -1);
  std::vector<std::pair<Places, std::int32_t>> run; // of faces with one key
  for (std::int64_t begin = 0, end = 0; begin < numberOfFaces; begin = end)
  {
    run.clear();
    for (; end < numberOfFaces && faces[end].Key == faces[begin].Key; ++end)
    {
      run.emplace_back(GetPlaces(geometry, faces[end].Item), faces[end].Item);
    }
    std::sort(run.begin(), run.end());
    for (std::size_t first = 0, next = 0; first < run.size(); first = next)
    {
      while (next < run.size() && run[next].first == run[first].first)
      {
        ++next;
      }
      if (next - first == 2)
      {
        twins[run[first].second] = run[first + 1].second;
        twins[run[first + 1].second] = run[first].second;
      }
    }
  }
  return twins;
}

} // namespace tetralux
