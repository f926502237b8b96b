// SPDX-License-Identifier: BSD-3-Clause
#include "Walk/CellOrientation.h"

namespace tetralux
{
namespace
{

/// Six times the volume of a cell, negative where its ascending points are oriented negatively.
double GetSignedVolume(Span<const double> points, const std::int32_t* cell)
{
  double edges[3][3];
  for (int i = 0; i < 3; ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      edges[i][a] = points[3 * static_cast<std::size_t>(cell[i + 1]) + a] -
        points[3 * static_cast<std::size_t>(cell[0]) + a];
    }
  }
  const auto cross = [&](int x, int y)
  { return edges[1][x] * edges[2][y] - edges[1][y] * edges[2][x]; };
  return edges[0][0] * cross(1, 2) + edges[0][1] * cross(2, 0) + edges[0][2] * cross(0, 1);
}

/// The orientation that the cell behind face i of a cell must have, where it is the cell's
/// own face `behind`: the points of the face ascend for both, so that the places of the
/// opposite points decide.
std::uint8_t OrientNeighbor(std::uint8_t positive, int face, int behind)
{
  return static_cast<std::uint8_t>(positive ^ ((face + behind + 1) & 1));
}

class Orienter
{
public:
  Orienter(Span<const double> points, Span<const std::int32_t> cells, Span<const WalkFace> faces)
    : Points(points)
    , Cells(cells)
    , Faces(faces)
    , NumberOfCells(static_cast<std::int64_t>(cells.size() / 4))
    , Positive(this->NumberOfCells)
  {
  }

  std::vector<std::uint8_t> Orient()
  {
    if (!this->OrientAsInSpace() && !this->OrientFromCellToCell())
    {
      this->Positive.clear();
    }
    return std::move(this->Positive);
  }

private:
  /// By the sign of each volume; whether neighbours agree.
  bool OrientAsInSpace()
  {
#pragma omp parallel for schedule(static)
    for (std::int64_t cell = 0; cell < this->NumberOfCells; ++cell)
    {
      this->Positive[cell] = GetSignedVolume(this->Points, &this->Cells[4 * cell]) > 0;
    }
    bool agree = true;
#pragma omp parallel for schedule(static) reduction(&& : agree)
    for (std::int64_t cell = 0; cell < this->NumberOfCells; ++cell)
    {
      for (int face = 0; face < 4 && agree; ++face)
      {
        const std::int32_t behind = this->Faces[4 * cell + face].Cell;
        agree = behind < 0 || this->Positive[behind] == this->ExpectBehind(cell, face);
      }
    }
    return agree;
  }

  bool OrientFromCellToCell()
  {
    std::vector<std::uint8_t> visited(this->NumberOfCells, 0);
    std::vector<std::int32_t> part; // cells of the present part, a queue
    bool agree = true;
    for (std::int64_t seed = 0; seed < this->NumberOfCells; ++seed)
    {
      if (visited[seed])
      {
        continue;
      }
      double volume = 0;
      part.assign(1, static_cast<std::int32_t>(seed));
      visited[seed] = 1;
      this->Positive[seed] = 1;
      for (std::size_t next = 0; next < part.size(); ++next)
      {
        const std::int64_t cell = part[next];
        const double ownVolume = GetSignedVolume(this->Points, &this->Cells[4 * cell]);
        volume += this->Positive[cell] ? ownVolume : -ownVolume;
        for (int face = 0; face < 4; ++face)
        {
          const std::int32_t behind = this->Faces[4 * cell + face].Cell;
          if (behind < 0)
          {
            continue;
          }
          const std::uint8_t expected = this->ExpectBehind(cell, face);
          if (!visited[behind])
          {
            visited[behind] = 1;
            this->Positive[behind] = expected;
            part.push_back(behind);
          }
          agree = agree && this->Positive[behind] == expected;
        }
      }
      if (volume < 0)
      {
        for (const std::int32_t cell : part)
        {
          this->Positive[cell] ^= 1;
        }
      }
    }
    return agree;
  }

  std::uint8_t ExpectBehind(std::int64_t cell, int face) const
  {
    const WalkFace& shared = this->Faces[4 * cell + face];
    const std::int32_t* behind = &this->Cells[4 * static_cast<std::int64_t>(shared.Cell)];
    const int place =
      (shared.Point > behind[0]) + (shared.Point > behind[1]) + (shared.Point > behind[2]);
    return OrientNeighbor(this->Positive[cell], face, place);
  }

  Span<const double> Points;
  Span<const std::int32_t> Cells;
  Span<const WalkFace> Faces;
  std::int64_t NumberOfCells;
  std::vector<std::uint8_t> Positive;
};

} // namespace

std::vector<std::uint8_t> OrientCells(
  Span<const double> points, Span<const std::int32_t> cells, Span<const WalkFace> faces)
{
  return Orienter(points, cells, faces).Orient();
}

} // namespace tetralux
