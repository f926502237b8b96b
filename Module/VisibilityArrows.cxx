// SPDX-License-Identifier: BSD-3-Clause
#include "VisibilityArrows.h"

#include "ExactOrientation.h"
#include "ViewOrientation.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{
namespace
{

constexpr std::uint8_t PositiveCell = 0x10;
constexpr std::uint8_t NegativeCell = 0x20; ///< neither of both: not known

/// The side of face i's points in their order on which the cell lies is that of its volume for odd i,
/// the other one for even i.
int GetFaceSide(int face, int volumeSign) { return face % 2 == 1 ? volumeSign : -volumeSign; }

int GetVolumeSign(std::uint8_t side)
{
  return (side & PositiveCell) != 0 ? 1 : (side & NegativeCell) != 0 ? -1 : 0;
}

std::uint8_t GetSide(int volumeSign)
{
  return volumeSign > 0 ? PositiveCell : volumeSign < 0 ? NegativeCell : 0;
}

double MeasureVolume(const std::array<const double*, 4>& corners)
{
  double edges[3][3];
  for (int edge = 0; edge < 3; ++edge)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      edges[edge][axis] = corners[edge + 1][axis] - corners[0][axis];
    }
  }
  return std::abs(edges[0][0] * (edges[1][1] * edges[2][2] - edges[1][2] * edges[2][1]) +
    edges[0][1] * (edges[1][2] * edges[2][0] - edges[1][0] * edges[2][2]) +
    edges[0][2] * (edges[1][0] * edges[2][1] - edges[1][1] * edges[2][0]));
}

/// The face of neighbor that is a face of cell.
int FindFace(Span<const WalkFace> faces, std::int64_t neighbor, std::int64_t cell)
{
  int face = 0;
  while (face < 3 && faces[4 * neighbor + face].Cell != cell)
  {
    ++face;
  }
  return face;
}

} // namespace

//----------------------------------------------------------------------------
VisibilityArrows::VisibilityArrows(const VisibilityGeometry& geometry)
  : Geometry(geometry)
  , Sides(geometry.GetNumberOfCells())
{
  const std::int64_t numberOfCells = geometry.GetNumberOfCells();
#pragma omp parallel for schedule(static)
  for (std::int64_t cell = 0; cell < numberOfCells; ++cell)
  {
    const auto corners = geometry.GetCorners(cell);
    this->Sides[cell] = GetSide(GetOrientation(corners[0], corners[1], corners[2], corners[3]));
  }
  this->TurnCells();
  this->JoinFaces();
}

//----------------------------------------------------------------------------
void VisibilityArrows::TurnCells()
{
  const Span<const WalkFace> faces = this->Geometry.Faces;
  const std::int64_t numberOfCells = this->Geometry.GetNumberOfCells();
  // The sign that the neighbour behind a face wants the cell to have, 0 where there is none.
  const auto getWish = [&](std::int64_t cell, int face)
  {
    const std::int32_t neighbor = faces[4 * cell + face].Cell;
    if (neighbor < 0)
    {
      return 0;
    }
    const int side =
      GetFaceSide(FindFace(faces, neighbor, cell), GetVolumeSign(this->Sides[neighbor]));
    return GetFaceSide(face, -side);
  };

  struct Doubt
  {
    double Volume;
    std::int32_t Cell;
  };
  std::vector<Doubt> doubts;
  std::vector<std::uint8_t> doubted(numberOfCells, 0);
#pragma omp parallel for schedule(static)
  for (std::int64_t cell = 0; cell < numberOfCells; ++cell)
  {
    const int sign = GetVolumeSign(this->Sides[cell]);
    bool doubt = sign == 0;
    for (int face = 0; face < 4; ++face)
    {
      doubt = doubt || getWish(cell, face) * sign < 0;
    }
    doubted[cell] = doubt;
  }
  for (std::int64_t cell = 0; cell < numberOfCells; ++cell)
  {
    if (doubted[cell])
    {
      doubts.push_back(
        { MeasureVolume(this->Geometry.GetCorners(cell)), static_cast<std::int32_t>(cell) });
    }
  }
  std::sort(doubts.begin(), doubts.end(),
    [](const Doubt& a, const Doubt& b)
    { return a.Volume != b.Volume ? a.Volume > b.Volume : a.Cell < b.Cell; });

  // Sums what the decided neighbours wish; false where none of them wishes anything and the cell is
  // flat.
  const auto decide = [&](std::int32_t cell, double volume)
  {
    const int sign = GetVolumeSign(this->Sides[cell]);
    double vote = sign * volume;
    bool heard = sign != 0;
    for (int face = 0; face < 4; ++face)
    {
      const std::int32_t neighbor = faces[4 * static_cast<std::int64_t>(cell) + face].Cell;
      const int wish = neighbor >= 0 && !doubted[neighbor] ? getWish(cell, face) : 0;
      if (wish != 0)
      {
        heard = true;
        vote += wish * MeasureVolume(this->Geometry.GetCorners(neighbor));
      }
    }
    if (heard)
    {
      this->Sides[cell] = GetSide(vote >= 0 ? 1 : -1);
      doubted[cell] = 0;
    }
    return heard;
  };
  // From the largest to the smallest; flat cells wait for a neighbour that is decided.
  for (const Doubt& doubt : doubts)
  {
    decide(doubt.Cell, doubt.Volume);
  }
  std::vector<std::int32_t> waiting;
  for (const Doubt& doubt : doubts)
  {
    waiting.push_back(doubt.Cell);
    while (!waiting.empty())
    {
      const std::int32_t cell = waiting.back();
      waiting.pop_back();
      if (doubted[cell] && decide(cell, 0))
      {
        for (int face = 0; face < 4; ++face)
        {
          const std::int32_t neighbor = faces[4 * static_cast<std::int64_t>(cell) + face].Cell;
          if (neighbor >= 0 && doubted[neighbor])
          {
            waiting.push_back(neighbor);
          }
        }
      }
    }
  }
}

//----------------------------------------------------------------------------
void VisibilityArrows::JoinFaces()
{
  const Span<const WalkFace> faces = this->Geometry.Faces;
  const std::int64_t numberOfCells = this->Geometry.GetNumberOfCells();
#pragma omp parallel for schedule(static)
  for (std::int64_t cell = 0; cell < numberOfCells; ++cell)
  {
    std::uint8_t joined = 0;
    const int sign = GetVolumeSign(this->Sides[cell]);
    for (int face = 0; face < 4; ++face)
    {
      const std::int32_t neighbor = faces[4 * cell + face].Cell;
      if (neighbor >= 0)
      {
        std::uint8_t side;
#pragma omp atomic read
        side = this->Sides[neighbor];
        const int behind = GetFaceSide(FindFace(faces, neighbor, cell), GetVolumeSign(side));
        joined |= (behind * GetFaceSide(face, sign) < 0) << face;
      }
    }
#pragma omp atomic
    this->Sides[cell] |= joined;
  }
}

//----------------------------------------------------------------------------
void VisibilityArrows::Point(const VisibilityView& view, Span<std::uint8_t> arrows) const
{
  const ViewOrientation orientation(view);
  const std::int64_t numberOfCells = this->Geometry.GetNumberOfCells();
#pragma omp parallel for schedule(static)
  for (std::int64_t cell = 0; cell < numberOfCells; ++cell)
  {
    std::array<int, 4> turns;
    orientation.GetFaceTurns(this->Geometry.GetCorners(cell), turns);
    const std::uint8_t side = this->Sides[cell];
    const int sign = GetVolumeSign(side);
    std::uint8_t hiding = 0;
    bool entered = false;
    for (int face = 0; face < 4; ++face)
    {
      // Positive where the viewer is on the cell's side.
      const int facing = turns[face] * GetFaceSide(face, sign);
      hiding |= (facing > 0) << face;
      entered = entered || (facing < 0 && this->Geometry.Faces[4 * cell + face].Cell < 0);
    }
    arrows[cell] = (hiding & side & HidingFaces) | (entered ? EnteredCell : 0);
  }
}

} // namespace tetralux
