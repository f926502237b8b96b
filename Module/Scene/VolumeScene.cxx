// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/VolumeScene.h"

#include "PreIntegration/TableChoice.h"
#include "Scene/LargestChannel.h"
#include "Scene/LargestScalarError.h"
#include "Scene/OrderError.h"
#include "Scene/VisibleCells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
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

/// World radii of meshes for which single precision does: distances inside keep all their digits,
/// as do the attenuations that make them visible, their inverses.
constexpr double SmallestSingleRadius = 1e-31;
constexpr double LargestSingleRadius = 1e31;

bool IsInSingleRange(double worldRadius)
{
  return SmallestSingleRadius <= worldRadius && worldRadius <= LargestSingleRadius;
}

CellValue MakeMappedValue(const ScalarMap& map, double scalar)
{
  CellValue value{};
  value.Attenuation = std::isfinite(scalar) ? static_cast<float>(map.Map(scalar))
                                            : std::numeric_limits<float>::quiet_NaN();
  return value;
}

/// What a place has whose scalars have these values of their functions.
TransferFunction::Value Mix(const std::vector<TransferFunction::Value>& values, bool dependent)
{
  TransferFunction::Value mixed{};
  for (const TransferFunction::Value& value : values)
  {
    mixed.Attenuation += value.Attenuation;
    for (int c = 0; c < 3; ++c)
    {
      mixed.Color[c] += dependent ? value.Color[c] : value.Attenuation * value.Color[c];
    }
  }
  for (double& channel : mixed.Color)
  {
    channel = dependent || mixed.Attenuation == 0 ? channel : channel / mixed.Attenuation;
  }
  return mixed;
}

/// For each cell 1 where any of the scalars attenuates.
std::vector<std::uint8_t> FindCellsOfComponents(
  const MeshScene& mesh, const ComponentFunctions& components)
{
  const std::vector<std::int32_t>& cells = mesh.GetMesh()->GetMesh().Cells;
  std::vector<std::uint8_t> visible(cells.size() / 4, 0);
  for (std::size_t c = 0; c < components.Functions.size(); ++c)
  {
    const std::vector<std::uint8_t> one = FindVisibleCells(components.Functions[c], cells,
      c == 0 ? mesh.GetScalars() : mesh.GetOtherScalars()[c - 1], mesh.HasCellScalars());
    std::transform(one.begin(), one.end(), visible.begin(), visible.begin(),
      [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a | b); });
  }
  return visible;
}

} // namespace

void VolumeScene::CheckWorldRadius(double worldRadius)
{
  if (!IsInSingleRange(worldRadius))
  {
    std::ostringstream message;
    message << "the mesh is too small or too large for single precision, in which attenuations are "
               "kept: its radius is "
            << worldRadius << " world units, and " << SmallestSingleRadius << " to "
            << LargestSingleRadius << " can be rendered";
    throw std::invalid_argument(message.str());
  }
}

void VolumeScene::CheckComplete() const
{
  const bool isosurfaces = this->Optics.GetModel() == OpticalModel::Isosurfaces;
  const bool hasFunction = !this->Optics.GetIntervalTable().Intervals.empty();
  if (!this->Mesh.GetMesh() || (!hasFunction && !isosurfaces))
  {
    throw std::invalid_argument("a mesh and a transfer function must be set before rays are cast");
  }
  if (!this->Mesh.IsComplete())
  {
    throw std::invalid_argument("scalars must be set after the mesh and before rays are cast");
  }
  if (this->HasComponents() &&
    this->Mesh.GetOtherScalars().size() + 1 != this->Optics.GetComponents().Functions.size())
  {
    throw std::invalid_argument("there are functions of " +
      std::to_string(this->Optics.GetComponents().Functions.size()) + " scalars, and " +
      std::to_string(this->Mesh.GetOtherScalars().size() + 1) + " scalars at each place");
  }
  if (isosurfaces && this->Mesh.HasCellScalars() && !this->Mesh.GetScalars().empty())
  {
    throw std::invalid_argument("isosurfaces need scalars at points: at cells they are constant");
  }
}

void VolumeScene::Prepare(const SceneNeeds& needs)
{
  this->PreparePlan();
  if (this->Mesh.HasCellScalars() && this->Optics.GetModel() != OpticalModel::Isosurfaces)
  {
    this->PrepareCellValues();
  }
  else
  {
    this->CellValues.Reset();
  }
  if (needs.SinglePoints)
  {
    this->PreparePoints<float>(this->SinglePoints);
  }
  if (needs.DoublePoints)
  {
    this->PreparePoints<double>(this->DoublePoints);
  }
  if (needs.VisibleCells || needs.VisibleTables)
  {
    this->PrepareVisibleCells();
  }
  if (needs.VisibleTables)
  {
    this->PrepareVisibleTables();
  }
  if (needs.PointGradients)
  {
    this->Mesh.PreparePointGradients();
  }
  if (needs.CellGradients)
  {
    this->Mesh.PrepareCellGradients();
  }
  if (needs.LongestEdge)
  {
    this->Mesh.PrepareLongestEdge();
  }
  if (needs.ComponentRows)
  {
    this->PrepareComponentRows();
  }
  else if (!this->HasComponents())
  {
    this->ComponentRows.Reset();
  }
  if (needs.FloatTexels)
  {
    this->Optics.PrepareFloatTexels();
  }
}

void VolumeScene::PreparePlan()
{
  const OpticalModel model = this->Optics.GetModel();
  const double* range = this->Mesh.GetScalarRange();
  this->Plan.Update(CacheKey::Of(model, this->Optics.GetFunctionVersion(), range[0], range[1]),
    [&]
    {
      return model == OpticalModel::Isosurfaces
        ? IntegrationPlan()
        : MakeIntegrationPlan(model, this->Optics.GetTransferFunction(), range);
    });
}

ScalarMap VolumeScene::GetScalarMap() const
{
  if (this->Optics.GetModel() != OpticalModel::Isosurfaces)
  {
    return { this->Optics.GetIntervalTable().Offset, this->Optics.GetIntervalTable().Scale };
  }
  // Halved before they are added, so that no sum overflows.
  const double lo = 0.5 * this->Mesh.GetScalarRange()[0];
  const double hi = 0.5 * this->Mesh.GetScalarRange()[1];
  return { lo + hi, hi - lo > 0 ? hi - lo : 1 };
}

double VolumeScene::GetLargestMappedScalar() const
{
  const ScalarMap map = this->GetScalarMap();
  const double* range = this->Mesh.GetScalarRange();
  return std::max({ 1., std::abs(map.Map(range[0])), std::abs(map.Map(range[1])) });
}

template <class Real>
void VolumeScene::PreparePoints(CacheStamp& stamp)
{
  const bool ofCells = this->Mesh.HasCellScalars();
  const ScalarMap map = ofCells ? ScalarMap() : this->GetScalarMap();
  CacheKey key = CacheKey::Of(this->Mesh.GetPointsVersion(),
    ofCells ? 0 : this->Mesh.GetScalarsVersion(), map.Offset, map.Scale);
  if (stamp.Has(key))
  {
    return;
  }
  if (!ofCells)
  {
    this->Mesh.GetMesh()->SetPointScalars<Real>(this->Mesh.GetScalars(), map.Offset, map.Scale);
  }
  else if (!this->Mesh.GetMesh()->GetPoints<Real>())
  {
    // Coordinates in double precision are filled in together with the scalars.
    const std::vector<double> none(this->Mesh.GetMesh()->GetMesh().GetNumberOfPoints(), 0.);
    this->Mesh.GetMesh()->SetPointScalars<Real>(none, map.Offset, map.Scale);
  }
  stamp.Set(std::move(key));
}

void VolumeScene::PrepareCellValues()
{
  const OpticalModel model = this->Optics.GetModel();
  const auto build = [&]
  {
    const ScalarMap map = this->GetScalarMap();
    const std::vector<double>& scalars = this->Mesh.GetScalars();
    const std::int64_t n = static_cast<std::int64_t>(scalars.size());
    std::vector<CellValue> values(n);
#pragma omp parallel for schedule(static)
    for (std::int64_t t = 0; t < n; ++t)
    {
      values[t] = model == OpticalModel::MaximumIntensity
        ? MakeMappedValue(map, scalars[t])
        : this->MakeCellValue(static_cast<std::size_t>(t));
    }
    return values;
  };
  this->CellValues.Update(CacheKey::Of(model == OpticalModel::MaximumIntensity,
                            this->Optics.GetFunctionVersion(), this->Mesh.GetScalarsVersion()),
    build);
}

CellValue VolumeScene::MakeCellValue(std::size_t cell) const
{
  CellValue value{};
  const double scalar = this->Mesh.GetScalars()[cell];
  if (!std::isfinite(scalar))
  {
    return value;
  }
  TransferFunction::Value exact{};
  if (this->HasComponents())
  {
    const ComponentFunctions& components = this->Optics.GetComponents();
    std::vector<TransferFunction::Value> values = { Evaluate(components.Functions[0], scalar) };
    for (std::size_t c = 1; c < components.Functions.size(); ++c)
    {
      values.push_back(
        Evaluate(components.Functions[c], this->Mesh.GetOtherScalars()[c - 1][cell]));
    }
    exact = Mix(values, components.Dependent);
  }
  else
  {
    exact = Evaluate(this->Optics.GetTransferFunction(), scalar);
  }
  value.Attenuation = static_cast<float>(exact.Attenuation);
  for (int c = 0; c < 3; ++c)
  {
    value.Color[c] = static_cast<float>(exact.Color[c]);
  }
  return value;
}

void VolumeScene::PrepareComponentRows()
{
  const std::size_t rows = this->Mesh.GetMesh()->GetNumberOfTablePoints();
  const auto build = [&]
  {
    const std::vector<IntervalTable>& tables = this->Optics.GetComponentIntervals();
    std::vector<ComponentRow> result(rows, ComponentRow{});
    for (std::size_t c = 0; c < tables.size(); ++c)
    {
      const ScalarMap map = { tables[c].Offset, tables[c].Scale };
      const std::vector<double>& scalars =
        c == 0 ? this->Mesh.GetScalars() : this->Mesh.GetOtherScalars()[c - 1];
      for (std::size_t p = 0; p < scalars.size(); ++p)
      {
        result[p].Scalars[c] = map.Map(scalars[p]);
      }
    }
    return result;
  };
  this->ComponentRows.Update(
    CacheKey::Of(rows, this->Mesh.GetScalarsVersion(), this->Optics.GetFunctionVersion()), build);
}

bool VolumeScene::HasComponents() const
{
  return this->Optics.GetModel() == OpticalModel::EmissionAbsorption &&
    this->Optics.HasComponents();
}

void VolumeScene::PrepareVisibleCells()
{
  const OpticalModel model = this->Optics.GetModel();
  const auto build = [&]
  {
    const std::vector<std::int32_t>& cells = this->Mesh.GetMesh()->GetMesh().Cells;
    VisibleCellFlags flags;
    if (this->HasComponents())
    {
      flags.Cells = FindCellsOfComponents(this->Mesh, this->Optics.GetComponents());
      flags.NumberOfTransparent = std::count(flags.Cells.begin(), flags.Cells.end(), 0);
      return flags;
    }
    switch (model)
    {
      case OpticalModel::MaximumIntensity: // the largest scalar may be where it is transparent
        break;
      case OpticalModel::Isosurfaces:
      {
        // Both are rounded to single precision as they are mapped to -1..1.
        constexpr double MappedRounding = 1. / (1 << 23);
        flags.Cells = FindCrossedCells(this->Optics.GetIsosurfaces(), cells,
          this->Mesh.GetScalars(), MappedRounding * this->GetScalarMap().Scale);
        break;
      }
      default:
        flags.Cells = FindVisibleCells(this->Optics.GetTransferFunction(), cells,
          this->Mesh.GetScalars(), this->Mesh.HasCellScalars());
    }
    flags.NumberOfTransparent = std::count(flags.Cells.begin(), flags.Cells.end(), 0);
    return flags;
  };
  const std::uint64_t optics = model == OpticalModel::Isosurfaces
    ? this->Optics.GetSurfacesVersion()
    : this->Optics.GetFunctionVersion();
  this->Visible.Update(
    CacheKey::Of(model, optics, this->Mesh.GetCellsVersion(), this->Mesh.GetScalarsVersion()),
    build);
}

void VolumeScene::PrepareVisibleTables()
{
  const WalkMesh& walk = *this->Mesh.GetMesh();
  const Span<const WalkPoint<float>> points(
    walk.GetPoints<float>(), walk.GetMesh().GetNumberOfPoints());
  CacheKey key = CacheKey::Of(this->Visible.GetVersion());
  if (!this->VisibleTopology.Has(key))
  {
    this->VisibleTables = WalkTables();
    const std::vector<std::uint8_t>& visible = this->Visible.Get().Cells;
    const auto transparent = static_cast<double>(this->Visible.Get().NumberOfTransparent);
    if (transparent > MinimumTransparentShare * static_cast<double>(visible.size()))
    {
      const WalkTables& all = walk.GetTables();
      WalkTables tables = MakeWalkTables(all.Faces, walk.GetMesh().Cells, points, visible);
      const double entriesMore =
        static_cast<double>(tables.Entries.size()) - static_cast<double>(all.Entries.size());
      if (EntryCost * entriesMore < transparent)
      {
        this->VisibleTables = std::move(tables);
      }
    }
    this->VisibleTopology.Set(std::move(key));
  }
  else if (this->VisiblePointsVersion != this->Mesh.GetPointsVersion())
  {
    RefitWalkTables(this->VisibleTables, points);
  }
  this->VisiblePointsVersion = this->Mesh.GetPointsVersion();
}

double VolumeScene::EstimateGeometryError(double worldRadius, const GeometryRounding& rounding)
{
  if (!IsInSingleRange(worldRadius))
  {
    return std::numeric_limits<double>::infinity();
  }
  return this->Optics.GetModel() == OpticalModel::Isosurfaces
    ? 0
    : this->EstimateRounding(worldRadius, rounding, this->GeometryError);
}

double VolumeScene::EstimateShiftError(double worldRadius, double shift)
{
  const OpticalModel model = this->Optics.GetModel();
  if (model == OpticalModel::Isosurfaces || model == OpticalModel::MaximumIntensity || shift == 0)
  {
    return 0;
  }
  if (!(shift < 1))
  {
    return 1;
  }
  // So that a camera which moves a little changes nothing.
  const double rounded = std::exp2(std::ceil(4 * std::log2(shift)) / 4);
  return std::min(1., this->EstimateRounding(worldRadius, { rounded, 0 }, this->ShiftError));
}

double VolumeScene::EstimateRounding(
  double worldRadius, const GeometryRounding& rounding, Cached<double>& result)
{
  // Rounded, so that a volume which is only turned keeps its estimate.
  const double radius = static_cast<float>(worldRadius);
  const OpticalModel model = this->Optics.GetModel();
  result.Update(
    CacheKey::Of(this->Mesh.GetPointsVersion(), this->Mesh.GetScalarsVersion(),
      this->Optics.GetFunctionVersion(), model, radius, rounding.Across, rounding.Scalar),
    [&]
    {
      const RayUnits units{ radius / this->Mesh.GetMesh()->GetRadius(), radius,
        this->GetLargestMappedScalar() * this->GetScalarMap().Scale };
      const RaySample& rays = *this->Mesh.DrawRays(1);
      const TransferFunction& function = this->Optics.GetTransferFunction();
      return model == OpticalModel::MaximumIntensity
        ? EstimateLargestScalarError(rays, units, function, this->Mesh.HasCellScalars(), rounding)
        : EstimateRoundingError(
            rays, units, function, model != OpticalModel::EmissionOnly, rounding);
    });
  return result.Get();
}

double VolumeScene::EstimateOrderError(double worldRadius)
{
  if (this->Optics.GetModel() != OpticalModel::EmissionAbsorption)
  {
    return 0;
  }
  const double radius = static_cast<float>(worldRadius);
  this->OrderError.Update(
    CacheKey::Of(this->Mesh.GetPointsVersion(), this->Mesh.GetScalarsVersion(),
      this->Optics.GetFunctionVersion(), radius),
    [&]
    {
      return tetralux::EstimateOrderError(*this->Mesh.DrawRays(1),
        radius / this->Mesh.GetMesh()->GetRadius(), this->Optics.GetTransferFunction());
    });
  return this->OrderError.Get();
}

EightBitErrors VolumeScene::EstimateEightBitErrors(double worldRadius)
{
  const OpticalModel model = this->Optics.GetModel();
  if (model == OpticalModel::MaximumIntensity || model == OpticalModel::Isosurfaces)
  {
    return {};
  }
  const double radius = static_cast<float>(worldRadius);
  this->EightBits.Update(CacheKey::Of(this->Mesh.GetPointsVersion(), this->Mesh.GetScalarsVersion(),
                           this->Optics.GetFunctionVersion(), model, radius),
    [&]
    {
      return tetralux::EstimateEightBitErrors(*this->Mesh.DrawRays(1),
        radius / this->Mesh.GetMesh()->GetRadius(), this->Optics.GetTransferFunction(), model);
    });
  return this->EightBits.Get();
}

double VolumeScene::EstimateLargestChannel(double worldRadius)
{
  const OpticalModel model = this->Optics.GetModel();
  const double radius = static_cast<float>(worldRadius);
  this->LargestChannel.Update(
    CacheKey::Of(this->Mesh.GetPointsVersion(), this->Mesh.GetScalarsVersion(),
      this->Optics.GetFunctionVersion(), model, radius),
    [&]
    {
      const RaySample none;
      return tetralux::EstimateLargestChannel(
        model == OpticalModel::EmissionOnly ? *this->Mesh.DrawRays(1) : none,
        radius / this->Mesh.GetMesh()->GetRadius(), this->Optics.GetTransferFunction(), model);
    });
  return this->LargestChannel.Get();
}

double VolumeScene::EstimatePieces()
{
  this->Pieces.Update(CacheKey::Of(this->Mesh.GetPointsVersion(), this->Mesh.GetScalarsVersion(),
                        this->Optics.GetFunctionVersion()),
    [&]
    { return CountPiecesPerSegment(this->Optics.GetIntervalTable(), *this->Mesh.DrawRays(1)); });
  return this->Pieces.Get();
}

} // namespace tetralux
