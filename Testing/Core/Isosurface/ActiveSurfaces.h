// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ActiveSurfaces_h
#define tetralux_ActiveSurfaces_h

#include "Isosurface/ActiveTree.h"
#include "Walk/WalkMesh.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace tetralux
{

/// A mesh in the order of the tables, its scalars, its tree and the polygons of some values.
class ActiveSurfaces
{
public:
  ActiveSurfaces(
    TetrahedralMesh mesh, const std::vector<double>& scalars, std::vector<double> values)
    : Walk(std::move(mesh))
    , Mesh(this->Walk.GetMesh())
    , Values(std::move(values))
  {
    for (const std::int64_t id : this->Mesh.OriginalPoints)
    {
      this->Scalars.push_back(scalars[id]);
    }
    std::copy_n(this->Walk.GetCenter(), 3, this->Source.Frame.Center);
    this->Source.Frame.Radius = this->Walk.GetRadius();
    this->Source.Points = this->Mesh.Points.data();
    this->Source.Cells = this->Mesh.Cells.data();
    this->Source.Scalars = this->Scalars.data();
    this->Source.Values = this->Values.data();
    this->Source.NumberOfValues = static_cast<int>(this->Values.size());
  }
  ActiveSurfaces(const ActiveSurfaces&) = delete;
  ActiveSurfaces& operator=(const ActiveSurfaces&) = delete;

  ActiveTree Make(int threads = 2, TreeBuild build = TreeBuild::SpatialMedian) const
  {
    MinMaxTreeOptions options;
    options.Build = build;
    const MinMaxTree tree =
      BuildMinMaxTree(this->Mesh, this->Walk.GetCenter(), this->Walk.GetRadius(), options);
    const MinMaxRanges ranges = MakeMinMaxRanges(tree, this->Mesh, this->Scalars, 0);
    return MakeActiveTree(tree, ranges, this->Source, threads);
  }

  /// The cells and values that have a polygon, by the rule: some points are below, some are not.
  std::set<std::pair<std::int32_t, std::int32_t>> FindCrossed() const
  {
    std::set<std::pair<std::int32_t, std::int32_t>> crossed;
    for (std::int32_t cell = 0; cell < this->Walk.GetNumberOfCells(); ++cell)
    {
      for (std::size_t v = 0; v < this->Values.size(); ++v)
      {
        int above = 0;
        bool finite = true;
        for (int i = 0; i < 4; ++i)
        {
          const double scalar = this->Scalars[this->Mesh.Cells[4 * cell + i]];
          finite = finite && std::isfinite(scalar);
          above += scalar >= this->Values[v] ? 1 : 0;
        }
        if (finite && above > 0 && above < 4)
        {
          crossed.emplace(cell, static_cast<std::int32_t>(v));
        }
      }
    }
    return crossed;
  }

  WalkMesh Walk;
  const TetrahedralMesh& Mesh;
  std::vector<double> Scalars;
  std::vector<double> Values;
  IsopolygonSource Source;
};

/// Values between the scalars and equal to some.
inline std::vector<double> MakeValues(const std::vector<double>& scalars, int count)
{
  std::vector<double> sorted = scalars;
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> values = { sorted.front() - 1, sorted.front(), sorted.back() };
  for (int k = 1; k <= count; ++k)
  {
    const double scalar = sorted[sorted.size() * k / (count + 1)];
    values.push_back(k % 3 == 0 ? scalar : 0.99 * scalar + 0.01 * sorted.front());
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

} // namespace tetralux

#endif
