// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/CellSplit.h"

#include <algorithm>

namespace tetralux
{
namespace
{

/// A face of a linear cell: local point numbers, counterclockwise seen from outside the cell.
struct Face
{
  int Size;
  int Points[4];
};

constexpr Face PyramidFaces[] = { { 4, { 0, 3, 2, 1 } }, { 3, { 0, 1, 4 } }, { 3, { 1, 2, 4 } },
  { 3, { 2, 3, 4 } }, { 3, { 3, 0, 4 } } };

// VTK's wedge: the normal of (0, 1, 2) points out of the cell.
constexpr Face WedgeFaces[] = { { 3, { 0, 1, 2 } }, { 3, { 3, 5, 4 } }, { 4, { 0, 3, 4, 1 } },
  { 4, { 1, 4, 5, 2 } }, { 4, { 2, 5, 3, 0 } } };

constexpr Face HexahedronFaces[] = { { 4, { 0, 4, 7, 3 } }, { 4, { 1, 2, 6, 5 } },
  { 4, { 0, 1, 5, 4 } }, { 4, { 3, 7, 6, 2 } }, { 4, { 0, 3, 2, 1 } }, { 4, { 4, 5, 6, 7 } } };

/// Joins the cell's smallest point to the triangles of all faces that do not contain it. On the
/// faces that do contain it, this leaves the diagonals that start at it.
template <int NumberOfFaces>
int SplitFromSmallestPoint(
  const Face (&faces)[NumberOfFaces], const std::int64_t* ids, int size, std::int64_t* tets)
{
  const std::int64_t apex = *std::min_element(ids, ids + size);
  int count = 0;
  for (const Face& face : faces)
  {
    std::int64_t corners[4];
    std::transform(
      face.Points, face.Points + face.Size, corners, [ids](int point) { return ids[point]; });
    if (std::find(corners, corners + face.Size, apex) != corners + face.Size)
    {
      continue;
    }
    std::rotate(corners, std::min_element(corners, corners + face.Size), corners + face.Size);
    for (int i = 2; i < face.Size; ++i)
    {
      // Seen from the apex, which is inside, the face is clockwise.
      const std::int64_t tet[4] = { corners[0], corners[i], corners[i - 1], apex };
      std::copy(tet, tet + 4, tets + 4 * count++);
    }
  }
  return count;
}

} // namespace

//----------------------------------------------------------------------------
int SplitPyramid(const std::int64_t ids[5], std::int64_t tets[2 * 4])
{
  return SplitFromSmallestPoint(PyramidFaces, ids, 5, tets);
}

//----------------------------------------------------------------------------
int SplitWedge(const std::int64_t ids[6], std::int64_t tets[3 * 4])
{
  return SplitFromSmallestPoint(WedgeFaces, ids, 6, tets);
}

//----------------------------------------------------------------------------
int SplitHexahedron(const std::int64_t ids[8], std::int64_t tets[6 * 4])
{
  const int count = SplitFromSmallestPoint(HexahedronFaces, ids, 8, tets);

  // If no diagonal ends at the corner opposite to the smallest point, three of the tetrahedra stand
  // around the line between these two, and five tetrahedra do with the same diagonals.
  constexpr int opposite[8] = { 6, 7, 4, 5, 2, 3, 0, 1 };
  constexpr bool odd[8] = { false, true, false, true, true, false, true, false };
  const auto smallest = std::min_element(ids, ids + 8) - ids;
  if (count == 6 && std::count(tets, tets + 6 * 4, ids[opposite[smallest]]) == 3)
  {
    return SplitStructuredHexahedron(ids, odd[smallest], tets);
  }
  return count;
}

//----------------------------------------------------------------------------
int SplitStructuredHexahedron(const std::int64_t ids[8], bool odd, std::int64_t tets[5 * 4])
{
  // The first tetrahedron is the one in the middle; each of the others cuts off one corner.
  constexpr int split[2][5 * 4] = {
    { 0, 5, 2, 7, 0, 1, 2, 5, 0, 2, 3, 7, 0, 5, 7, 4, 2, 7, 5, 6 },
    { 1, 3, 4, 6, 0, 1, 3, 4, 1, 2, 3, 6, 1, 6, 4, 5, 3, 4, 6, 7 },
  };
  std::transform(split[odd], split[odd] + 5 * 4, tets, [ids](int point) { return ids[point]; });
  return 5;
}

} // namespace tetralux
