// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/PolyhedronFilling.h"

#include "Geometry/ExactOrientation.h"
#include "Geometry/SimplexIntersection.h"

#include <algorithm>
#include <array>

namespace tetralux
{
namespace
{

using Triangle = std::array<std::int32_t, 3>;

/// Tests of a tetrahedron with a triangle, of a microsecond at most, after which a search is given
/// up.
constexpr std::int64_t MaximumTests = 100000;

/// From the smallest corner on, in the same turn.
Triangle Rotate(Triangle triangle)
{
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

/// Cuts one tetrahedron after the other off what is left. Where none can be cut off any more, it
/// goes back.
class Search
{
public:
  Search(const std::vector<double>& corners,
    const std::function<bool(const std::vector<std::int32_t>&)>& isDone)
    : IsDone(isDone)
    , Points(corners.data())
    , NumberOfCorners(static_cast<std::int32_t>(corners.size() / 3))
  {
  }

  /// False: the triangle has no area.
  bool Add(const Triangle& triangle)
  {
    this->Surface.push_back(Rotate(triangle));
    return this->Points.FindProjection(triangle[0], triangle[1], triangle[2]) >= 0;
  }

  bool Fill(PolyhedronFilling& filling);

private:
  /// A tetrahedron between a triangle of the surface and a corner.
  struct Candidate
  {
    std::int32_t Apex;
    int Shared; ///< its faces in the surface
  };

  bool TestApex(const Triangle& base, std::int32_t apex, int& shared);
  void FindCandidates(const Triangle& base, std::size_t most, std::vector<Candidate>& candidates);
  bool ChooseBase(Triangle& base, std::vector<Candidate>& candidates);
  void CutOff(const Triangle& base, std::int32_t apex);

  const std::function<bool(const std::vector<std::int32_t>&)>& IsDone;
  ExactPoints Points;
  std::int32_t NumberOfCorners;
  std::vector<Triangle> Surface; ///< of what is left
  std::int64_t Tests = 0;
};

/// The other faces of a tetrahedron on a base, seen counter-clockwise from outside of it.
std::array<Triangle, 3> GetSides(const Triangle& base, std::int32_t apex)
{
  return { Rotate({ base[1], base[0], apex }), Rotate({ base[2], base[1], apex }),
    Rotate({ base[0], base[2], apex }) };
}

/// Whether the tetrahedron is in what is left, and meets its surface in whole faces, edges and
/// corners alone.
bool Search::TestApex(const Triangle& base, std::int32_t apex, int& shared)
{
  if (this->Points.Orient(base[0], base[2], base[1], apex) <= 0)
  {
    return false;
  }
  const std::int32_t cell[4] = { base[0], base[2], base[1], apex };
  const std::array<Triangle, 3> sides = GetSides(base, apex);
  shared = 1;
  for (const Triangle& triangle : this->Surface)
  {
    const auto isOfCell = [&cell](std::int32_t corner)
    { return std::find(cell, cell + 4, corner) != cell + 4; };
    if (std::all_of(triangle.begin(), triangle.end(), isOfCell))
    {
      const bool isSide = std::find(sides.begin(), sides.end(), triangle) != sides.end();
      if (!isSide && triangle != base)
      {
        return false; // seen from its other side
      }
      shared += isSide ? 1 : 0;
      continue;
    }
    ++this->Tests;
    if (!CellMeetsTriangleProperly(this->Points, cell, triangle.data()))
    {
      return false;
    }
  }
  return true;
}

/// All tetrahedra on a base, or some where there are more than most. Those with the most faces in
/// the surface first.
void Search::FindCandidates(
  const Triangle& base, std::size_t most, std::vector<Candidate>& candidates)
{
  candidates.clear();
  for (std::int32_t apex = 0; apex < this->NumberOfCorners && candidates.size() <= most; ++apex)
  {
    int shared = 0;
    if (this->TestApex(base, apex, shared))
    {
      candidates.push_back({ apex, shared });
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
    [](const Candidate& a, const Candidate& b) { return a.Shared > b.Shared; });
}

/// The triangle with the fewest tetrahedra on it. False if there are none on any; or on one, where
/// nothing may be left.
bool Search::ChooseBase(Triangle& base, std::vector<Candidate>& candidates)
{
  candidates.clear();
  std::vector<Candidate> found;
  std::size_t fewest = static_cast<std::size_t>(this->NumberOfCorners);
  for (const Triangle& triangle : std::vector<Triangle>(this->Surface))
  {
    this->FindCandidates(triangle, fewest, found);
    if (found.empty() && !this->IsDone)
    {
      return false;
    }
    if (!found.empty() && (candidates.empty() || found.size() < candidates.size()))
    {
      base = triangle;
      candidates = found;
      fewest = found.size();
    }
    if (fewest == 1)
    {
      break;
    }
  }
  return !candidates.empty();
}

void Search::CutOff(const Triangle& base, std::int32_t apex)
{
  this->Surface.erase(std::find(this->Surface.begin(), this->Surface.end(), base));
  for (const Triangle& side : GetSides(base, apex))
  {
    const auto found = std::find(this->Surface.begin(), this->Surface.end(), side);
    if (found != this->Surface.end())
    {
      this->Surface.erase(found);
    }
    else
    {
      this->Surface.push_back(Rotate({ side[1], side[0], side[2] }));
    }
  }
}

bool Search::Fill(PolyhedronFilling& filling)
{
  filling.Rest.clear();
  for (const Triangle& triangle : this->Surface)
  {
    filling.Rest.insert(filling.Rest.end(), triangle.begin(), triangle.end());
  }
  if (filling.Rest.empty() || (this->IsDone && this->IsDone(filling.Rest)))
  {
    return true;
  }
  Triangle base;
  std::vector<Candidate> candidates;
  if (!this->ChooseBase(base, candidates))
  {
    return false;
  }
  const std::vector<Triangle> before = this->Surface;
  for (const Candidate& candidate : candidates)
  {
    if (this->Tests > MaximumTests)
    {
      return false;
    }
    this->CutOff(base, candidate.Apex);
    filling.Cells.insert(filling.Cells.end(), { base[0], base[2], base[1], candidate.Apex });
    if (this->Fill(filling))
    {
      return true;
    }
    filling.Cells.resize(filling.Cells.size() - 4);
    this->Surface = before;
  }
  return false;
}

} // namespace

bool FillPolyhedron(const std::vector<double>& corners, const std::vector<std::int32_t>& triangles,
  const std::function<bool(const std::vector<std::int32_t>&)>& isDone, PolyhedronFilling& filling)
{
  filling.Cells.clear();
  Search search(corners, isDone);
  for (std::size_t i = 0; i < triangles.size(); i += 3)
  {
    if (!search.Add({ triangles[i], triangles[i + 1], triangles[i + 2] }))
    {
      return false;
    }
  }
  return search.Fill(filling);
}

} // namespace tetralux
