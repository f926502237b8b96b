// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/VolumeScene.h"

#include "Mesh/CellVolumes.h"

#include "Scene/OrderError.h"
#include "Scene/VisibleCells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace tetralux
{
namespace
{

/// Leaving transparent cells out takes tables of its own; below this share of the cells it is not
/// tried.
constexpr double MinimumTransparentShare = 0.1;

/// What finding a way in costs, in cells walked through: leaving transparent cells out saves these
/// and makes more boundary.
constexpr double EntryCost = 4;

/// World radii of meshes for which single precision does: distances inside keep all their digits, as
/// do their products with attenuations that make them visible.
constexpr double SmallestSingleRadius = 1e-30;
constexpr double LargestSingleRadius = 1e30;

} // namespace

void VolumeScene::SetMesh(std::shared_ptr<WalkMesh> mesh)
{
  this->Mesh = std::move(mesh);
  this->LongestEdge = -1;
  ++this->MeshVersion;
  this->Scalars.clear();
  this->FloatScalars = this->DoubleScalars = ScalarMap();
  this->SampledRays.reset();
  this->PointGradientsValid = false;
  this->Invalidate();
}

void VolumeScene::SetPointScalars(std::vector<double> scalars)
{
  this->SetScalars(std::move(scalars), false);
}

void VolumeScene::SetCellScalars(std::vector<double> scalars)
{
  this->SetScalars(std::move(scalars), true);
}

void VolumeScene::SetScalars(std::vector<double> scalars, bool ofCells)
{
  if (!this->Mesh)
  {
    throw std::invalid_argument("the mesh must be set before its scalars");
  }
  const TetrahedralMesh& mesh = this->Mesh->GetMesh();
  const std::size_t expected = ofCells ? mesh.GetNumberOfCells() : mesh.GetNumberOfPoints();
  if (scalars.size() != expected)
  {
    throw std::invalid_argument(std::to_string(scalars.size()) + " scalars were given for " +
      std::to_string(expected) + (ofCells ? " cells" : " points"));
  }
  this->Scalars = std::move(scalars);
  this->ScalarsOfCells = ofCells;
  this->FloatScalars = this->DoubleScalars = ScalarMap();
  this->SampledRays.reset();
  this->PointGradientsValid = false;
  this->Invalidate();

  bool allFinite = true;
  bool any = false;
  for (double s : this->Scalars)
  {
    if (!std::isfinite(s))
    {
      allFinite = false;
      continue;
    }
    this->ScalarRange[0] = any ? std::min(this->ScalarRange[0], s) : s;
    this->ScalarRange[1] = any ? std::max(this->ScalarRange[1], s) : s;
    any = true;
  }
  if (!any)
  {
    this->ScalarRange[0] = this->ScalarRange[1] = 0;
  }
  this->NumberOfBlankCells = 0;
  if (!allFinite)
  {
    this->CountBlankCells();
  }
}

void VolumeScene::CountBlankCells()
{
  const std::vector<std::int32_t>& cells = this->Mesh->GetMesh().Cells;
  const std::int64_t n = static_cast<std::int64_t>(cells.size() / 4);
  for (std::int64_t t = 0; t < n; ++t)
  {
    const std::int32_t* p = &cells[4 * t];
    const bool finite = this->ScalarsOfCells
      ? std::isfinite(this->Scalars[t])
      : std::all_of(p, p + 4, [this](std::int32_t id) { return std::isfinite(this->Scalars[id]); });
    this->NumberOfBlankCells += !finite;
  }
}

void VolumeScene::SetOpticalModel(OpticalModel model)
{
  if (model != this->Model)
  {
    this->Model = model;
    this->Invalidate();
  }
}

void VolumeScene::SetTransferFunction(const TransferFunction& function)
{
  this->Intervals = MakeIntervalTable(function);
  this->Function = function;
  this->SetTable(nullptr, 0);
  this->Invalidate();
}

void VolumeScene::Invalidate()
{
  this->CellValuesValid = this->VisibleCellsValid = this->VisibleTablesValid = this->PlanValid =
    false;
  this->GeometryError = this->OrderError = -1;
}

void VolumeScene::SetTable(std::shared_ptr<const PreIntegrationTable> table, double pictureError)
{
  this->Table = std::move(table);
  this->TableError = pictureError;
  this->Texels.clear();
  ++this->TableVersion;
}

const float* VolumeScene::GetFloatTexels()
{
  if (!this->Table)
  {
    return nullptr;
  }
  if (this->Table->Settings.Format == TexelFormat::Float)
  {
    return reinterpret_cast<const float*>(this->Table->Texels.GetData());
  }
  if (this->Texels.empty())
  {
    const int n = this->Table->Scalars.GetSize();
    const int lengths = this->Table->Lengths.Size;
    this->Texels.resize(4 * static_cast<std::size_t>(n) * n * lengths);
#pragma omp parallel for schedule(static)
    for (int length = 0; length < lengths; ++length)
    {
      float* texel = &this->Texels[4 * static_cast<std::size_t>(n) * n * length];
      for (int back = 0; back < n; ++back)
      {
        for (int front = 0; front < n; ++front, texel += 4)
        {
          this->Table->GetTexel(front, back, length, texel);
        }
      }
    }
  }
  return this->Texels.data();
}

void VolumeScene::SetIsosurfaces(std::vector<Isosurface> surfaces)
{
  for (const Isosurface& surface : surfaces)
  {
    const float* c = surface.Color;
    if (!std::isfinite(surface.Value) || !std::isfinite(c[0] + c[1] + c[2] + surface.Opacity))
    {
      throw std::invalid_argument("values, colours and opacities of isosurfaces must be finite");
    }
  }
  std::stable_sort(surfaces.begin(), surfaces.end(),
    [](const Isosurface& a, const Isosurface& b) { return a.Value < b.Value; });
  this->Surfaces.clear();
  for (const Isosurface& surface : surfaces)
  {
    if (!this->Surfaces.empty() && this->Surfaces.back().Value == surface.Value)
    {
      this->Surfaces.pop_back();
    }
    this->Surfaces.push_back(surface);
  }
  if (this->Model == OpticalModel::Isosurfaces)
  {
    this->VisibleCellsValid = this->VisibleTablesValid = false;
  }
}

const IntegrationPlan& VolumeScene::GetPlan()
{
  if (!this->PlanValid)
  {
    this->Plan = this->Model == OpticalModel::Isosurfaces
      ? IntegrationPlan()
      : MakeIntegrationPlan(this->Model, this->Function, this->ScalarRange);
    this->PlanValid = true;
  }
  return this->Plan;
}

void VolumeScene::CheckComplete() const
{
  const bool isosurfaces = this->Model == OpticalModel::Isosurfaces;
  if (!this->Mesh || (this->Intervals.Intervals.empty() && !isosurfaces))
  {
    throw std::invalid_argument("a mesh and a transfer function must be set before rays are cast");
  }
  const TetrahedralMesh& mesh = this->Mesh->GetMesh();
  if (this->Scalars.size() !=
    (this->ScalarsOfCells ? mesh.GetNumberOfCells() : mesh.GetNumberOfPoints()))
  {
    throw std::invalid_argument("scalars must be set after the mesh and before rays are cast");
  }
  if (isosurfaces && this->ScalarsOfCells && !this->Scalars.empty())
  {
    throw std::invalid_argument("isosurfaces need scalars at points: at cells they are constant");
  }
}

VolumeScene::ScalarMap VolumeScene::GetScalarMap() const
{
  if (this->Model != OpticalModel::Isosurfaces)
  {
    return { this->Intervals.Offset, this->Intervals.Scale };
  }
  // Halved before they are added, so that no sum overflows.
  const double lo = 0.5 * this->ScalarRange[0];
  const double hi = 0.5 * this->ScalarRange[1];
  return { lo + hi, hi - lo > 0 ? hi - lo : 1 };
}

double VolumeScene::GetLargestMappedScalar() const
{
  const ScalarMap map = this->GetScalarMap();
  return std::max(
    { 1., std::abs(map.Map(this->ScalarRange[0])), std::abs(map.Map(this->ScalarRange[1])) });
}

template <class Real>
const WalkPoint<Real>* VolumeScene::GetPoints()
{
  constexpr bool single = std::is_same<Real, float>::value;
  if (this->ScalarsOfCells)
  {
    // Coordinates in double precision are filled in together with the scalars.
    if (!this->Mesh->GetPoints<Real>())
    {
      const std::vector<double> none(this->Mesh->GetMesh().GetNumberOfPoints(), 0.);
      this->Mesh->SetPointScalars<Real>(none, 0, 1);
    }
    return this->Mesh->GetPoints<Real>();
  }
  const ScalarMap map = this->GetScalarMap();
  ScalarMap& present = single ? this->FloatScalars : this->DoubleScalars;
  if (!(present == map))
  {
    this->Mesh->SetPointScalars<Real>(this->Scalars, map.Offset, map.Scale);
    this->PointsVersion += single;
    present = map;
  }
  return this->Mesh->GetPoints<Real>();
}

template const WalkPoint<float>* VolumeScene::GetPoints<float>();
template const WalkPoint<double>* VolumeScene::GetPoints<double>();

const std::vector<CellValue>& VolumeScene::GetCellValues()
{
  if (this->CellValuesValid)
  {
    return this->CellValues;
  }
  const ScalarMap map = this->GetScalarMap();
  const std::int64_t n = static_cast<std::int64_t>(this->Scalars.size());
  this->CellValues.resize(n);
#pragma omp parallel for schedule(static)
  for (std::int64_t t = 0; t < n; ++t)
  {
    CellValue value{};
    if (this->Model == OpticalModel::MaximumIntensity)
    {
      value.Attenuation = std::isfinite(this->Scalars[t])
        ? static_cast<float>(map.Map(this->Scalars[t]))
        : std::numeric_limits<float>::quiet_NaN();
    }
    else if (std::isfinite(this->Scalars[t]))
    {
      const TransferFunction::Value v = Evaluate(this->Function, this->Scalars[t]);
      value.Attenuation = static_cast<float>(v.Attenuation);
      for (int c = 0; c < 3; ++c)
      {
        value.Color[c] = static_cast<float>(v.Color[c]);
      }
    }
    this->CellValues[t] = value;
  }
  this->CellValuesValid = true;
  ++this->CellValuesVersion;
  return this->CellValues;
}

const std::vector<PointGradient>& VolumeScene::GetPointGradients()
{
  if (!this->PointGradientsValid)
  {
    const double range = 0.5 * this->ScalarRange[1] - 0.5 * this->ScalarRange[0];
    this->PointGradients = MakePointGradients(
      this->Mesh->GetMesh(), this->Scalars, this->Mesh->GetRadius(), range > 0 ? range : 1);
    this->PointGradientsValid = true;
  }
  return this->PointGradients;
}

const std::vector<std::uint8_t>& VolumeScene::GetVisibleCells()
{
  if (this->VisibleCellsValid)
  {
    return this->VisibleCells;
  }
  const std::vector<std::int32_t>& cells = this->Mesh->GetMesh().Cells;
  switch (this->Model)
  {
    case OpticalModel::MaximumIntensity: // the largest scalar may be where it is transparent
      this->VisibleCells.clear();
      break;
    case OpticalModel::Isosurfaces:
    {
      // Both are rounded to single precision as they are mapped to -1..1.
      constexpr double MappedRounding = 1. / (1 << 23);
      this->VisibleCells = FindCrossedCells(
        this->Surfaces, cells, this->Scalars, MappedRounding * this->GetScalarMap().Scale);
      break;
    }
    default:
      this->VisibleCells =
        FindVisibleCells(this->Function, cells, this->Scalars, this->ScalarsOfCells);
  }
  this->NumberOfTransparentCells =
    std::count(this->VisibleCells.begin(), this->VisibleCells.end(), 0);
  this->VisibleCellsValid = true;
  return this->VisibleCells;
}

std::int64_t VolumeScene::GetNumberOfTransparentCells()
{
  this->GetVisibleCells();
  return this->NumberOfTransparentCells;
}

const WalkTables* VolumeScene::GetVisibleTables()
{
  if (!this->VisibleTablesValid)
  {
    this->VisibleTables = WalkTables();
    const std::vector<std::uint8_t>& visible = this->GetVisibleCells();
    const auto transparent = static_cast<double>(this->NumberOfTransparentCells);
    if (transparent > MinimumTransparentShare * static_cast<double>(visible.size()))
    {
      const TetrahedralMesh& mesh = this->Mesh->GetMesh();
      const WalkTables& all = this->Mesh->GetTables();
      const Span<const WalkPoint<float>> points(
        this->Mesh->GetPoints<float>(), mesh.GetNumberOfPoints());
      WalkTables tables = MakeWalkTables(all.Faces, mesh.Cells, points, visible);
      const double entriesMore =
        static_cast<double>(tables.Entries.size()) - static_cast<double>(all.Entries.size());
      if (EntryCost * entriesMore < transparent)
      {
        this->VisibleTables = std::move(tables);
      }
    }
    this->VisibleTablesValid = true;
    ++this->VisibleTablesVersion;
  }
  return this->VisibleTables.Faces.empty() ? nullptr : &this->VisibleTables;
}

double VolumeScene::GetLongestEdge()
{
  if (this->LongestEdge < 0)
  {
    this->LongestEdge = MeasureCells(this->Mesh->GetMesh()).LongestEdge;
  }
  return this->LongestEdge;
}

double VolumeScene::GetLongestSegment(const RayGrid& grid)
{
  // The root of the sum of squares of the inverse matrix, its cofactors over its determinant, bounds
  // what it stretches by.
  const double(*m)[4] = grid.MeshFromWorld;
  double determinant = 0;
  double squares = 0;
  for (int row = 0; row < 3; ++row)
  {
    const double* a = m[(row + 1) % 3];
    const double* b = m[(row + 2) % 3];
    for (int column = 0; column < 3; ++column)
    {
      const int i = (column + 1) % 3;
      const int j = (column + 2) % 3;
      const double cofactor = a[i] * b[j] - a[j] * b[i];
      squares += cofactor * cofactor;
      determinant += row == 0 ? m[0][column] * cofactor : 0;
    }
  }
  return this->GetLongestEdge() * std::sqrt(squares) / std::abs(determinant);
}

std::shared_ptr<const RaySample> VolumeScene::GetRaySample(double scale)
{
  if (!this->SampledRays || this->ScaleOfRays != scale)
  {
    this->SampledRays = std::make_shared<const RaySample>(
      DrawMeshRays(*this->Mesh, this->Scalars, scale, this->ScalarsOfCells));
    this->ScaleOfRays = scale;
  }
  return this->SampledRays;
}

double VolumeScene::GetWorldRadius(const RayGrid& grid) const
{
  // The shortest change in the mesh for one world unit bounds the scale from below; rows and
  // columns do for an estimate.
  double shortest = 0;
  for (int column = 0; column < 3; ++column)
  {
    const double length = std::hypot(
      grid.MeshFromWorld[0][column], grid.MeshFromWorld[1][column], grid.MeshFromWorld[2][column]);
    shortest = column == 0 ? length : std::min(shortest, length);
  }
  const double radius = this->Mesh->GetRadius();
  return shortest > 0 && std::isfinite(shortest) ? radius / shortest : radius;
}

double VolumeScene::EstimateGeometryError(double worldRadius, const GeometryRounding& rounding)
{
  if (!(SmallestSingleRadius <= worldRadius && worldRadius <= LargestSingleRadius))
  {
    return std::numeric_limits<double>::infinity();
  }
  switch (this->Model)
  {
    case OpticalModel::Isosurfaces:
      return 0;
    case OpticalModel::MaximumIntensity:
    {
      // Between three corners a scalar is interpolated with a few roundings.
      constexpr double ScalarRounding = 1. / (1 << 22);
      return ScalarRounding * this->GetLargestMappedScalar() * FindSteepestColor(this->Intervals);
    }
    default:
      return this->EstimateRounding(worldRadius, rounding);
  }
}

std::pair<const RaySample&, double> VolumeScene::GetAnyRays(double worldRadius)
{
  const double scale = worldRadius / this->Mesh->GetRadius();
  if (!this->SampledRays)
  {
    this->GetRaySample(scale);
  }
  return { *this->SampledRays, scale / this->ScaleOfRays };
}

double VolumeScene::EstimateRounding(double worldRadius, const GeometryRounding& rounding)
{
  // Rounded, so that a volume which is only turned keeps its estimate.
  const double radius = static_cast<float>(worldRadius);
  if (this->GeometryError < 0 || radius != this->GeometryErrorRadius ||
    rounding.Across != this->GeometryErrorRounding.Across ||
    rounding.Scalar != this->GeometryErrorRounding.Scalar)
  {
    const auto [rays, length] = this->GetAnyRays(radius);
    const RayUnits units{ length, radius,
      this->GetLargestMappedScalar() * this->GetScalarMap().Scale };
    this->GeometryError = EstimateRoundingError(
      rays, units, this->Function, this->Model != OpticalModel::EmissionOnly, rounding);
    this->GeometryErrorRadius = radius;
    this->GeometryErrorRounding = rounding;
  }
  return this->GeometryError;
}

double VolumeScene::EstimateOrderError(double worldRadius)
{
  if (this->Model != OpticalModel::EmissionAbsorption)
  {
    return 0;
  }
  const double radius = static_cast<float>(worldRadius);
  if (this->OrderError < 0 || radius != this->OrderErrorRadius)
  {
    const auto [rays, length] = this->GetAnyRays(radius);
    this->OrderError = tetralux::EstimateOrderError(rays, length, this->Function);
    this->OrderErrorRadius = radius;
  }
  return this->OrderError;
}

} // namespace tetralux
