// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/VisibleHull.h"

#include <algorithm>
#include <stdexcept>

namespace tetralux
{
namespace
{

std::size_t GetCount(const int (&sizes)[3])
{
  return static_cast<std::size_t>(sizes[0]) * sizes[1] * sizes[2];
}

void CheckCells(const int (&cells)[3], Span<const std::uint8_t> visible)
{
  if (visible.size() != GetCount(cells))
  {
    throw std::invalid_argument("the number of visible flags is not the number of cells");
  }
}

/// Visible blocks of a size, with a border of transparent ones before the first and behind the last
/// along each axis.
struct Blocks
{
  int Sizes[3]; ///< with the border
  std::vector<std::uint8_t> Visible;

  std::size_t GetStep(int axis) const
  {
    return axis == 0 ? 1
      : axis == 1    ? static_cast<std::size_t>(this->Sizes[0])
                     : static_cast<std::size_t>(this->Sizes[0]) * this->Sizes[1];
  }
};

Blocks MakeBlocks(const int (&cells)[3], Span<const std::uint8_t> visible, int blockSize)
{
  Blocks blocks;
  for (int a = 0; a < 3; ++a)
  {
    blocks.Sizes[a] = (cells[a] + blockSize - 1) / blockSize + 2;
  }
  blocks.Visible.resize(GetCount(blocks.Sizes));
  std::size_t cell = 0;
  for (int z = 0; z < cells[2]; ++z)
  {
    for (int y = 0; y < cells[1]; ++y)
    {
      std::uint8_t* row = &blocks.Visible[(z / blockSize + 1) * blocks.GetStep(2) +
        (y / blockSize + 1) * blocks.GetStep(1) + 1];
      for (int x = 0; x < cells[0]; ++x, ++cell)
      {
        row[x / blockSize] |= static_cast<std::uint8_t>(visible[cell] != 0);
      }
    }
  }
  return blocks;
}

/// Adds a face on the lower side of a block, or on the upper side of the one before it.
void AddFace(VisibleHull& hull, const int (&cells)[3], const int (&block)[3], int axis)
{
  HullFace face;
  for (int a = 0; a < 3; ++a)
  {
    face.Low[a] = std::min(block[a] * hull.BlockSize, cells[a]);
    face.High[a] = a == axis ? face.Low[a] : std::min((block[a] + 1) * hull.BlockSize, cells[a]);
    hull.Low[a] = hull.Faces.empty() ? face.Low[a] : std::min(hull.Low[a], face.Low[a]);
    hull.High[a] = hull.Faces.empty() ? face.High[a] : std::max(hull.High[a], face.High[a]);
  }
  hull.Faces.push_back(face);
}

} // namespace

VisibleHull MakeVisibleHull(const int (&cells)[3], Span<const std::uint8_t> visible, int blockSize)
{
  CheckCells(cells, visible);
  if (blockSize < 1)
  {
    throw std::invalid_argument("the size of blocks is below 1");
  }
  const Blocks blocks = MakeBlocks(cells, visible, blockSize);
  VisibleHull hull;
  hull.BlockSize = blockSize;
  std::size_t index = blocks.GetStep(2) + blocks.GetStep(1) + 1;
  for (int z = 1; z < blocks.Sizes[2]; ++z, index += blocks.GetStep(1))
  {
    for (int y = 1; y < blocks.Sizes[1]; ++y, ++index)
    {
      for (int x = 1; x < blocks.Sizes[0]; ++x, ++index)
      {
        const int block[3] = { x - 1, y - 1, z - 1 };
        for (int axis = 0; axis < 3; ++axis)
        {
          if (blocks.Visible[index] != blocks.Visible[index - blocks.GetStep(axis)])
          {
            AddFace(hull, cells, block, axis);
          }
        }
      }
    }
  }
  return hull;
}

VisibleHull MakeCoarseHull(
  const int (&cells)[3], Span<const std::uint8_t> visible, std::size_t mostTriangles)
{
  const int largest = *std::max_element(cells, cells + 3);
  int blockSize = 1;
  VisibleHull hull = MakeVisibleHull(cells, visible, blockSize);
  while (hull.GetNumberOfTriangles() > mostTriangles && blockSize < largest)
  {
    blockSize *= 2;
    hull = MakeVisibleHull(cells, visible, blockSize);
  }
  return hull;
}

std::vector<std::uint8_t> SelectMaterial(const int (&cells)[3], Span<const std::uint8_t> visible,
  Span<const std::uint8_t> labels, std::uint8_t label)
{
  CheckCells(cells, visible);
  const int points[3] = { cells[0] + 1, cells[1] + 1, cells[2] + 1 };
  if (labels.size() != GetCount(points))
  {
    throw std::invalid_argument("the number of labels is not the number of points");
  }
  const std::size_t row = points[0];
  const std::size_t slice = row * points[1];
  const std::size_t corners[8] = { 0, 1, row, row + 1, slice, slice + 1, slice + row,
    slice + row + 1 };
  std::vector<std::uint8_t> selected(visible.size());
  std::size_t cell = 0;
  for (int z = 0; z < cells[2]; ++z)
  {
    for (int y = 0; y < cells[1]; ++y)
    {
      const std::uint8_t* first = &labels[z * slice + y * row];
      for (int x = 0; x < cells[0]; ++x, ++cell)
      {
        const bool found = std::any_of(
          corners, corners + 8, [&](std::size_t corner) { return first[x + corner] == label; });
        selected[cell] = static_cast<std::uint8_t>(found && visible[cell] != 0);
      }
    }
  }
  return selected;
}

} // namespace tetralux
