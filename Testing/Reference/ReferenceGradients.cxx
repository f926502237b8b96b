// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceGradients.h"

#include <cmath>
#include <cstddef>

namespace tetralux
{
namespace reference
{
namespace
{

/// The volume of a cell, signed; with one corner replaced by a point, where it is not nullptr.
Real GetSixfoldVolume(const Cell& cell, const Vector* point, int corner)
{
  Vector corners[4];
  for (int i = 0; i < 4; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      corners[i][axis] =
        point && i == corner ? (*point)[axis] : static_cast<Real>(cell.Coordinates[i][axis]);
    }
  }
  for (int i = 1; i < 4; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      corners[i][axis] -= corners[0][axis];
    }
  }
  return Dot(Cross(corners[1], corners[2]), corners[3]);
}

} // namespace

Vector FindGradient(const Cell& cell)
{
  Vector edges[3];
  for (int i = 0; i < 3; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      edges[i][axis] = static_cast<Real>(cell.Coordinates[i + 1][axis]) - cell.Coordinates[0][axis];
    }
  }
  // Cramer's rule for gradient * edge = difference of scalars, for each of three edges.
  const Real determinant = Dot(Cross(edges[0], edges[1]), edges[2]);
  Vector gradient{ 0, 0, 0 };
  for (int i = 0; i < 3; ++i)
  {
    const Vector normal = Cross(edges[(i + 1) % 3], edges[(i + 2) % 3]);
    const Real difference = static_cast<Real>(cell.Scalars[i + 1]) - cell.Scalars[0];
    for (int axis = 0; axis < 3; ++axis)
    {
      gradient[axis] += difference / determinant * normal[axis];
    }
  }
  return gradient;
}

std::vector<Vector> FindPointGradients(const ReferenceMesh& mesh)
{
  std::vector<Vector> gradients(mesh.Points.size() / 3, Vector{ 0, 0, 0 });
  std::vector<Real> volumes(gradients.size(), 0);
  const std::size_t numberOfCells = mesh.Cells.size() / 4;
  for (std::size_t id = 0; id < numberOfCells; ++id)
  {
    Cell cell;
    const bool usable = GetCell(mesh, id, cell);
    const Real volume = usable ? std::abs(GetSixfoldVolume(cell, nullptr, 0)) : 0;
    if (volume == 0)
    {
      continue;
    }
    const Vector gradient = FindGradient(cell);
    for (const std::int32_t point : cell.Points)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        gradients[point][axis] += volume * gradient[axis];
      }
      volumes[point] += volume;
    }
  }
  for (std::size_t point = 0; point < gradients.size(); ++point)
  {
    for (Real& component : gradients[point])
    {
      component /= volumes[point] > 0 ? volumes[point] : 1;
    }
  }
  return gradients;
}

Vector InterpolateGradient(
  const Cell& cell, const std::vector<Vector>& pointGradients, const Vector& position)
{
  const Real whole = GetSixfoldVolume(cell, nullptr, 0);
  Vector gradient{ 0, 0, 0 };
  for (int corner = 0; corner < 4; ++corner)
  {
    const Real share = GetSixfoldVolume(cell, &position, corner) / whole;
    const Vector ofPoint = pointGradients[cell.Points[corner]];
    for (int axis = 0; axis < 3; ++axis)
    {
      gradient[axis] += share * ofPoint[axis];
    }
  }
  return gradient;
}

} // namespace reference
} // namespace tetralux
