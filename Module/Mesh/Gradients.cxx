// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/Gradients.h"

#include "Mesh/CellGradient.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tetralux
{
namespace
{

/// Cells whose gradients are found in parallel before they are added up one by one: sums do not
/// depend on threads then, and this many gradients stay in the cache.
constexpr std::int64_t BlockSize = 16384;

/// Gradient times volume, and the volume; all 0 where a scalar is not finite.
std::array<double, 4> FindWeightedGradient(const TetrahedralMesh& mesh, Span<const double> scalars,
  std::int64_t cell, double length, double scalar)
{
  const std::int32_t* ids = &mesh.Cells[4 * cell];
  const double* origin = &mesh.Points[3 * static_cast<std::size_t>(ids[0])];
  double edges[3][3], rises[3];
  for (int i = 0; i < 3; ++i)
  {
    const double* point = &mesh.Points[3 * static_cast<std::size_t>(ids[i + 1])];
    for (int a = 0; a < 3; ++a)
    {
      edges[i][a] = (point[a] - origin[a]) / length;
    }
    // Divided first: a difference of large scalars may overflow.
    rises[i] = scalars[ids[i + 1]] / scalar - scalars[ids[0]] / scalar;
  }
  const CellGradient gradient(edges, rises);
  const double* g = gradient.Weighted;
  if (!std::isfinite(g[0] + g[1] + g[2]))
  {
    return { 0, 0, 0, 0 };
  }
  return { g[0], g[1], g[2], gradient.SixfoldVolume };
}

float ToFloat(double x)
{
  constexpr double Largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -Largest, Largest));
}

} // namespace

std::vector<GradientRow> MakePointGradients(
  const TetrahedralMesh& mesh, Span<const double> scalars, double length, double scalar)
{
  const auto numberOfPoints = static_cast<std::int64_t>(mesh.GetNumberOfPoints());
  const auto numberOfCells = static_cast<std::int64_t>(mesh.GetNumberOfCells());
  std::vector<std::array<double, 4>> sums(numberOfPoints, { 0, 0, 0, 0 });
  std::vector<std::array<double, 4>> block(std::min(numberOfCells, BlockSize));
  for (std::int64_t first = 0; first < numberOfCells; first += BlockSize)
  {
    const std::int64_t count = std::min(BlockSize, numberOfCells - first);
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < count; ++i)
    {
      block[i] = FindWeightedGradient(mesh, scalars, first + i, length, scalar);
    }
    for (std::int64_t i = 0; i < count; ++i)
    {
      for (int corner = 0; corner < 4; ++corner)
      {
        std::array<double, 4>& sum = sums[mesh.Cells[4 * (first + i) + corner]];
        for (int k = 0; k < 4; ++k)
        {
          sum[k] += block[i][k];
        }
      }
    }
  }
  std::vector<GradientRow> gradients(numberOfPoints);
#pragma omp parallel for schedule(static)
  for (std::int64_t p = 0; p < numberOfPoints; ++p)
  {
    const std::array<double, 4>& sum = sums[p];
    // Around flat cells alone the direction is all there is.
    const double volume = sum[3] > 0 ? sum[3] : 1;
    gradients[p] = { ToFloat(sum[0] / volume), ToFloat(sum[1] / volume), ToFloat(sum[2] / volume),
      0 };
  }
  return gradients;
}

std::vector<GradientRow> MakeCellGradients(
  const TetrahedralMesh& mesh, Span<const double> scalars, double length, double scalar)
{
  std::vector<GradientRow> gradients(mesh.GetNumberOfCells());
  const auto numberOfCells = static_cast<std::int64_t>(gradients.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t cell = 0; cell < numberOfCells; ++cell)
  {
    gradients[cell] = MakeCellGradient(mesh, scalars, cell, length, scalar);
  }
  return gradients;
}

GradientRow MakeCellGradient(const TetrahedralMesh& mesh, Span<const double> scalars,
  std::int64_t cell, double length, double scalar)
{
  const std::array<double, 4> g = FindWeightedGradient(mesh, scalars, cell, length, scalar);
  const double largest = std::max({ std::abs(g[0]), std::abs(g[1]), std::abs(g[2]) });
  const double divisor = g[3] > 0 ? g[3] : largest > 0 ? largest : 1;
  return { ToFloat(g[0] / divisor), ToFloat(g[1] / divisor), ToFloat(g[2] / divisor), 0 };
}

} // namespace tetralux
