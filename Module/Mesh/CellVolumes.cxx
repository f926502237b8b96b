// SPDX-License-Identifier: BSD-3-Clause
#include "Mesh/CellVolumes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tetralux
{
namespace
{

/// The rounding error of a determinant of coordinate differences is at most this times the sum of
/// the magnitudes of its products (Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast
/// Robust Geometric Predicates, 1997: the bound A of ORIENT3D). No unit.
constexpr double HalfUlp = 0.5 * std::numeric_limits<double>::epsilon();
constexpr double RelativeError = (7 + 56 * HalfUlp) * HalfUlp;

/// Sums are taken over blocks of this many cells, whatever the number of threads, so that the
/// result does not depend on it.
constexpr std::int64_t BlockSize = 4096;

struct Measures
{
  double SixfoldVolume = 0;
  std::int64_t NumberOfZero = 0;
  std::int64_t NumberOfInverted = 0;
  double ShortestSquared = std::numeric_limits<double>::infinity();
  double LongestSquared = 0;

  void Add(const double* const corners[4])
  {
    double edges[3][3]; // from the first corner
    for (int i = 0; i < 3; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        edges[i][axis] = corners[i + 1][axis] - corners[0][axis];
      }
    }
    double determinant = 0;
    double magnitude = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int next = (axis + 1) % 3;
      const int last = (axis + 2) % 3;
      const double product0 = edges[1][next] * edges[2][last];
      const double product1 = edges[1][last] * edges[2][next];
      determinant += edges[0][axis] * (product0 - product1);
      magnitude += std::abs(edges[0][axis]) * (std::abs(product0) + std::abs(product1));
    }
    // Also true where the products overflow, so that no infinite volume enters the sum.
    if (!(std::abs(determinant) > RelativeError * magnitude))
    {
      ++this->NumberOfZero;
    }
    else
    {
      this->SixfoldVolume += std::abs(determinant);
      this->NumberOfInverted += determinant < 0;
    }

    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        double squared = 0;
        for (int axis = 0; axis < 3; ++axis)
        {
          const double difference = corners[i][axis] - corners[j][axis];
          squared += difference * difference;
        }
        if (squared > 0)
        {
          this->ShortestSquared = std::min(this->ShortestSquared, squared);
        }
        this->LongestSquared = std::max(this->LongestSquared, squared);
      }
    }
  }

  void Add(const Measures& other)
  {
    this->SixfoldVolume += other.SixfoldVolume;
    this->NumberOfZero += other.NumberOfZero;
    this->NumberOfInverted += other.NumberOfInverted;
    this->ShortestSquared = std::min(this->ShortestSquared, other.ShortestSquared);
    this->LongestSquared = std::max(this->LongestSquared, other.LongestSquared);
  }
};

} // namespace

//----------------------------------------------------------------------------
CellVolumes MeasureCells(const TetrahedralMesh& mesh)
{
  const auto numberOfCells = static_cast<std::int64_t>(mesh.GetNumberOfCells());
  const std::int64_t numberOfBlocks = (numberOfCells + BlockSize - 1) / BlockSize;
  std::vector<Measures> blocks(numberOfBlocks);
#pragma omp parallel for schedule(static)
  for (std::int64_t block = 0; block < numberOfBlocks; ++block)
  {
    Measures measures;
    const std::int64_t end = std::min(numberOfCells, (block + 1) * BlockSize);
    for (std::int64_t cell = block * BlockSize; cell < end; ++cell)
    {
      const double* corners[4];
      for (int i = 0; i < 4; ++i)
      {
        corners[i] = &mesh.Points[std::size_t{ 3 } * mesh.Cells[4 * cell + i]];
      }
      measures.Add(corners);
    }
    blocks[block] = measures;
  }

  Measures all;
  for (const Measures& measures : blocks)
  {
    all.Add(measures);
  }
  CellVolumes volumes;
  volumes.Total = all.SixfoldVolume / 6;
  volumes.NumberOfZero = all.NumberOfZero;
  volumes.NumberOfInverted = all.NumberOfInverted;
  volumes.LongestEdge = std::sqrt(all.LongestSquared);
  volumes.ShortestEdge = all.LongestSquared > 0 ? std::sqrt(all.ShortestSquared) : 0;
  return volumes;
}

} // namespace tetralux
