// SPDX-License-Identifier: BSD-3-Clause
#include "Preparation/PointMerger.h"

#include "Intake/PointExtraction.h"
#include "Walk/WalkMesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace tetralux
{
namespace
{

/// Roundings that scalars of one place may have behind them: a few operations, as a magnitude has.
/// Each is one of the array's type, and one of a double where terms cancelled that are as large as
/// the largest scalar.
constexpr double ScalarRoundings = 4;

/// Points for each tetrahedron from which on most points are no others' too: a shared lattice has
/// 0.2, one of hexahedra with points of their own 1.3.
constexpr double OwnPoints = 0.75;

std::vector<std::int32_t> GetBoundaryPoints(const WalkMesh& mesh)
{
  std::vector<bool> isOnBoundary(mesh.GetMesh().GetNumberOfPoints());
  std::vector<std::int32_t> points;
  for (std::int32_t i = 0; i < mesh.GetNumberOfBoundaryFaces(); ++i)
  {
    for (const std::int32_t point : mesh.GetEntries()[i].Points)
    {
      if (!isOnBoundary[point])
      {
        isOnBoundary[point] = true;
        points.push_back(point);
      }
    }
  }
  return points;
}

/// Cells that are the same as others, and faces of more than two cells.
std::int64_t CountMisfits(const WalkMesh& mesh)
{
  return mesh.GetRemovedCells().Duplicates + mesh.GetNumberOfNonManifoldFaces();
}

/// Points of an input, as a mesh without cells, to take their coordinates and scalars.
TetrahedralMesh SelectPoints(const CoincidentPoints& points)
{
  TetrahedralMesh mesh;
  mesh.OriginalPoints.assign(points.Points.begin(), points.Points.end());
  mesh.OriginalPoints.insert(mesh.OriginalPoints.end(), points.Firsts.begin(), points.Firsts.end());
  mesh.Points.resize(3 * mesh.OriginalPoints.size());
  return mesh;
}

/// Splits what is at one place by scalars: a point is taken with the first one that agrees with it.
class ScalarGroups
{
public:
  ScalarGroups(const CoincidentPoints& points, const ExtractedScalars& scalars)
    : Points(points)
    , Scalars(scalars)
  {
    for (const double scalar : scalars.Values)
    {
      const double size = std::abs(scalar);
      this->Cancelled = std::isfinite(size) ? std::max(this->Cancelled, size) : this->Cancelled;
    }
    this->Cancelled *= std::numeric_limits<double>::epsilon();
  }

  CoincidentPoints Split()
  {
    CoincidentPoints result;
    const std::size_t count = this->Points.Points.size();
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
      [this](std::size_t a, std::size_t b)
      { return this->Points.Firsts[a] < this->Points.Firsts[b]; });
    std::vector<std::int64_t> taken(count);
    for (std::size_t begin = 0, end; begin < count; begin = end)
    {
      const std::int64_t first = this->Points.Firsts[order[begin]];
      std::vector<Kind> kinds = { { first, this->Scalars.Values[count + order[begin]] } };
      for (end = begin; end < count && this->Points.Firsts[order[end]] == first; ++end)
      {
        taken[order[end]] = this->Take(order[end], kinds);
      }
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      if (taken[i] != this->Points.Points[i])
      {
        result.Points.push_back(this->Points.Points[i]);
        result.Firsts.push_back(taken[i]);
      }
    }
    result.Distance = this->Points.Distance;
    return result;
  }

private:
  struct Kind
  {
    std::int64_t Point;
    double Scalar;
  };

  std::int64_t Take(std::size_t index, std::vector<Kind>& kinds) const
  {
    const double scalar = this->Scalars.Values[index];
    for (const Kind& kind : kinds)
    {
      if (this->Agree(kind.Scalar, scalar))
      {
        return kind.Point;
      }
    }
    kinds.push_back({ this->Points.Points[index], scalar });
    return kinds.back().Point;
  }

  bool Agree(double a, double b) const
  {
    const double rounding = this->Scalars.Rounding * std::max(std::abs(a), std::abs(b));
    const double tolerance = ScalarRoundings * (rounding + this->Cancelled);
    return a == b || std::abs(a - b) <= tolerance || (std::isnan(a) && std::isnan(b));
  }

  const CoincidentPoints& Points;
  const ExtractedScalars& Scalars;
  double Cancelled = 0; ///< rounding of a double of the size of the largest scalar
};

} // namespace

void PointMerger::Start(PointMerging merging, vtkDataObject* input, const TetrahedralMesh& mesh)
{
  *this = PointMerger();
  const std::size_t numberOfPoints = mesh.GetNumberOfPoints();
  if (merging == PointMerging::Never ||
    static_cast<double>(numberOfPoints) < OwnPoints * static_cast<double>(mesh.GetNumberOfCells()))
  {
    return;
  }
  std::vector<std::int32_t> points(numberOfPoints);
  std::iota(points.begin(), points.end(), 0);
  this->Found = FindCoincidentPoints(mesh, points, GetPointTolerance(input));
}

void PointMerger::Find(vtkDataObject* input, const WalkMesh& mesh)
{
  this->Found =
    FindCoincidentPoints(mesh.GetMesh(), GetBoundaryPoints(mesh), GetPointTolerance(input));
  this->Misfits = CountMisfits(mesh);
}

bool PointMerger::Follow(vtkDataObject* input)
{
  if (this->Merged.Points.empty())
  {
    this->Found.reset();
    this->Fits = true;
    return true;
  }
  const std::vector<double> points = ExtractPoints(input, SelectPoints(*this->Found));
  const std::size_t half = points.size() / 2;
  for (std::size_t i = 0; i < half; ++i)
  {
    if (!(std::abs(points[i] - points[half + i]) <= this->Found->Distance))
    {
      return false;
    }
  }
  return true;
}

void PointMerger::CompareWith(const WalkMesh& mesh)
{
  this->Misfits = CountMisfits(mesh);
  this->Fits = this->MergedMisfits <= this->Misfits;
}

CoincidentPoints PointMerger::Choose(
  PointMerging merging, vtkDataObject* input, const ScalarSelection& selection) const
{
  if (merging == PointMerging::Never || !this->Found || this->Found->Points.empty() ||
    (merging == PointMerging::Automatic && !this->Fits))
  {
    return {};
  }
  const ExtractedScalars scalars = ExtractScalars(input, SelectPoints(*this->Found), selection);
  if (!scalars.Error.empty())
  {
    return this->Merged; // the error is that of the scalars themselves
  }
  if (scalars.CellData)
  {
    return *this->Found;
  }
  CoincidentPoints agreeing = ScalarGroups(*this->Found, scalars).Split();
  return agreeing == *this->Found || merging == PointMerging::Always ? agreeing
                                                                     : CoincidentPoints();
}

bool PointMerger::Accept(PointMerging merging, const CoincidentPoints& merged, const WalkMesh& mesh)
{
  const std::int64_t misfits = CountMisfits(mesh);
  const bool fits = misfits <= this->Misfits;
  if (merged == *this->Found)
  {
    this->Fits = fits;
    this->MergedMisfits = misfits;
  }
  if (merging == PointMerging::Automatic && !fits)
  {
    return false;
  }
  this->Merged = merged;
  return true;
}

} // namespace tetralux
