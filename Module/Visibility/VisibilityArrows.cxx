// SPDX-License-Identifier: BSD-3-Clause
#include "Visibility/VisibilityArrows.h"

#include "Geometry/ExactOrientation.h"
#include "Visibility/ViewOrientation.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace tetralux
{
namespace
{

constexpr std::uint8_t PositiveCell = 0x10;
constexpr std::uint8_t NegativeCell = 0x20; ///< neither of both: not known
constexpr std::uint8_t BoundaryCell = 0x40;

/// Fewer cells are done before a second thread would have started.
constexpr std::int64_t SmallestParallelMesh = 1 << 13;

constexpr unsigned AllFaces = 0xf;
constexpr unsigned OddFaces = 0xa; ///< see GetFaceSide

/// The points of a cell's faces, in their order: face i has those other than i.
constexpr int FirstPoints[4] = { 1, 0, 0, 0 };
constexpr int SecondPoints[4] = { 2, 2, 1, 1 };
constexpr int ThirdPoints[4] = { 3, 3, 3, 2 };

/// The side of face i's points in their order on which the cell lies is that of its volume for odd
/// i, the other one for even i.
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
#pragma omp parallel for schedule(static) if (numberOfCells > SmallestParallelMesh)
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
#pragma omp parallel for schedule(static) if (numberOfCells > SmallestParallelMesh)
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
#pragma omp parallel for schedule(static) if (numberOfCells > SmallestParallelMesh)
  for (std::int64_t cell = 0; cell < numberOfCells; ++cell)
  {
    std::uint8_t added = 0;
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
        added |= (behind * GetFaceSide(face, sign) < 0) << face;
      }
      else
      {
        added |= BoundaryCell;
      }
    }
#pragma omp atomic
    this->Sides[cell] |= added;
  }
}

//----------------------------------------------------------------------------
int VisibilityArrows::GetBoundarySide(const WalkEntry& entry) const
{
  const int face = static_cast<int>(std::count_if(std::begin(entry.Points), std::end(entry.Points),
    [&](std::int32_t point) { return point < entry.Opposite; }));
  return GetFaceSide(face, GetVolumeSign(this->Sides[entry.Cell]));
}

//----------------------------------------------------------------------------
/// The turns of faces towards the viewer in single precision, as far as they are beyond rounding:
/// of eight cells at a time, in loops over these that compilers turn into vector instructions.
class VisibilityArrows::ClearTurns
{
public:
  static constexpr int Width = 8;

  ClearTurns(const VisibilityGeometry& geometry, const VisibilityView& view)
    : Geometry(geometry)
    , Start(view.Parallel ? 0 : 1)
  {
    double largest = 0;
    double vector[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      vector[axis] = view.Parallel ? view.Direction[axis]
                                   : (view.Eye[axis] - geometry.Center[axis]) / geometry.Radius;
      largest = std::max(largest, std::abs(vector[axis]));
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Vector[axis] =
        static_cast<float>(view.Parallel ? -vector[axis] / largest : vector[axis]);
    }
    // Coordinates are at most 1, and off by their rounding, as all that is computed. Of a face
    // whose edges have components of at most l, seen along a vector with components of at most m:
    // the edges are off by 4 roundings, products of them by 28 l + 32 roundings, the sum of their
    // products with the vector by three times that times m, and by what the vector is off.
    constexpr float rounding = 1.f / (1 << 24);
    const float m = static_cast<float>(view.Parallel ? 1 : 1 + largest);
    this->BoundPerEdge = 144 * rounding * m;
    this->Bound = 96 * rounding * rounding * m;
  }

  /// Of the cells from first on, at most Width. Bit i of each: face i runs counter-clockwise, or
  /// clockwise; neither of both where rounding leaves that open.
  void Compute(std::int64_t first, int count)
  {
    float x[4][3][Width];
    for (int lane = 0; lane < Width; ++lane)
    {
      const std::int32_t* ids = this->Geometry.GetPointIds(first + std::min(lane, count - 1));
      for (int corner = 0; corner < 4; ++corner)
      {
        const WalkPoint<float>& point = this->Geometry.RelativePoints[ids[corner]];
        x[corner][0][lane] = point.X;
        x[corner][1][lane] = point.Y;
        x[corner][2][lane] = point.Z;
      }
    }
    std::fill_n(this->Positive, Width, 0);
    std::fill_n(this->Negative, Width, 0);
    this->AddFace<0>(x);
    this->AddFace<1>(x);
    this->AddFace<2>(x);
    this->AddFace<3>(x);
  }

  int Positive[Width];
  int Negative[Width];

private:
  // A template, since compilers make vector instructions of it only for fixed corners.
  template <int Face>
  void AddFace(const float (&x)[4][3][Width])
  {
    const auto& a = x[FirstPoints[Face]];
    const auto& b = x[SecondPoints[Face]];
    const auto& c = x[ThirdPoints[Face]];
    const float start = this->Start, boundPerEdge = this->BoundPerEdge, bound = this->Bound;
    const float vector[3] = { this->Vector[0], this->Vector[1], this->Vector[2] };
    int positive[Width];
    int negative[Width];
    for (int lane = 0; lane < Width; ++lane)
    {
      const float ab0 = b[0][lane] - a[0][lane], ac0 = c[0][lane] - a[0][lane];
      const float ab1 = b[1][lane] - a[1][lane], ac1 = c[1][lane] - a[1][lane];
      const float ab2 = b[2][lane] - a[2][lane], ac2 = c[2][lane] - a[2][lane];
      float edge = std::abs(ab0);
      edge = std::max(edge, std::abs(ab1));
      edge = std::max(edge, std::abs(ab2));
      edge = std::max(edge, std::abs(ac0));
      edge = std::max(edge, std::abs(ac1));
      edge = std::max(edge, std::abs(ac2));
      const float determinant = (ab1 * ac2 - ab2 * ac1) * (start * a[0][lane] - vector[0]) +
        (ab2 * ac0 - ab0 * ac2) * (start * a[1][lane] - vector[1]) +
        (ab0 * ac1 - ab1 * ac0) * (start * a[2][lane] - vector[2]);
      const float limit = edge * boundPerEdge + bound;
      positive[lane] = static_cast<int>(determinant < -limit) << Face;
      negative[lane] = static_cast<int>(determinant > limit) << Face;
    }
    for (int lane = 0; lane < Width; ++lane)
    {
      this->Positive[lane] |= positive[lane];
      this->Negative[lane] |= negative[lane];
    }
  }

  const VisibilityGeometry& Geometry;
  // Rays to a point x go along Start x - Vector.
  float Start;
  float Vector[3];
  float BoundPerEdge;
  float Bound;
};

//----------------------------------------------------------------------------
void VisibilityArrows::Point(const VisibilityView& view, Span<std::uint8_t> arrows) const
{
  const ViewOrientation orientation(view);
  const std::int64_t numberOfCells = this->Geometry.GetNumberOfCells();
  const std::int64_t numberOfBlocks = (numberOfCells + ClearTurns::Width - 1) / ClearTurns::Width;
#pragma omp parallel if (numberOfCells > SmallestParallelMesh)
  {
    ClearTurns turns(this->Geometry, view);
#pragma omp for schedule(static)
    for (std::int64_t block = 0; block < numberOfBlocks; ++block)
    {
      const std::int64_t first = block * ClearTurns::Width;
      const int count =
        static_cast<int>(std::min<std::int64_t>(ClearTurns::Width, numberOfCells - first));
      turns.Compute(first, count);
      for (int lane = 0; lane < count; ++lane)
      {
        const std::int64_t cell = first + lane;
        unsigned positive = turns.Positive[lane];
        unsigned negative = turns.Negative[lane];
        if ((positive | negative) != AllFaces)
        {
          const auto corners = this->Geometry.GetCorners(cell);
          for (int face = 0; face < 4; ++face)
          {
            if (((positive | negative) >> face & 1) == 0)
            {
              const int turn = orientation.GetTurn(corners[FirstPoints[face]],
                corners[SecondPoints[face]], corners[ThirdPoints[face]]);
              positive |= static_cast<unsigned>(turn > 0) << face;
              negative |= static_cast<unsigned>(turn < 0) << face;
            }
          }
        }
        const std::uint8_t side = this->Sides[cell];
        if (GetVolumeSign(side) < 0)
        {
          std::swap(positive, negative);
        }
        // On the cell's side of a face are those who see it run as the cell does.
        const unsigned inside = (positive & OddFaces) | (negative & ~OddFaces);
        const unsigned outside = (negative & OddFaces) | (positive & ~OddFaces);
        unsigned entered = 0;
        if ((side & BoundaryCell) != 0)
        {
          for (int face = 0; face < 4; ++face)
          {
            const bool boundary = this->Geometry.Faces[4 * cell + face].Cell < 0;
            entered |= static_cast<unsigned>(boundary) << face & outside;
          }
        }
        arrows[cell] = static_cast<std::uint8_t>(
          (inside & side & HidingFaces) | (entered != 0 ? EnteredCell : 0));
      }
    }
  }
}

} // namespace tetralux
