// SPDX-License-Identifier: BSD-3-Clause
#include "RayCast/KernelInput.h"

#include "Optics/LightSteps.h"
#include "View/RayAcross.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetralux
{
namespace
{

/// Rounding of distances along rays, in radii of the mesh: sixteen times that of a coordinate.
constexpr double SingleDistanceRounding = 1. / (1 << 20);
constexpr double DoubleDistanceRounding = SingleDistanceRounding / (1 << 29);

void FillMesh(const WalkMesh& mesh, const WalkTables& tables, KernelInput& in)
{
  in.Faces = tables.Faces.data();
  in.Entries = tables.Entries.data();
  in.Nodes = tables.Bvh.Nodes.empty() ? nullptr : tables.Bvh.Nodes.data();
  in.Triangles = tables.Bvh.Triangles.data();
  in.NumberOfCells = mesh.GetNumberOfCells();
  in.NumberOfPoints = static_cast<std::int32_t>(mesh.GetNumberOfTablePoints());
  in.NumberOfWalkCells = static_cast<std::int32_t>(tables.Faces.size() / 4);
  in.NumberOfEntries = static_cast<std::int32_t>(tables.Entries.size());
  std::copy_n(mesh.GetCenter(), 3, in.Center);
  in.Radius = mesh.GetRadius();
}

void FillColumns(const std::vector<IntervalTable::Interval>& intervals, IntervalColumns& columns)
{
  for (std::size_t i = 0; i < intervals.size(); ++i)
  {
    const IntervalTable::Interval& t = intervals[i];
    columns.Lo[i] = t.Lo;
    columns.Hi[i] = t.Hi;
    columns.Reference[i] = t.Reference;
    columns.Attenuation[i] = t.Attenuation;
    columns.AttenuationSlope[i] = t.AttenuationSlope;
    for (int c = 0; c < 3; ++c)
    {
      columns.Color[c][i] = t.Color[c];
      columns.ColorSlope[c][i] = t.ColorSlope[c];
      columns.ColorBend[c][i] = t.ColorBend[c];
    }
  }
}

void FillIntervals(const IntervalTable& table, OwningKernelInput& in)
{
  in.Intervals = table.Intervals.data();
  in.NumberOfIntervals = static_cast<int>(table.Intervals.size());
  in.Curved = table.Curved;
  if (in.NumberOfIntervals <= IntervalColumns::Most)
  {
    FillColumns(table.Intervals, in.FewIntervals);
    in.Columns = &in.FewIntervals;
  }
}

void FillSurfaces(
  const std::vector<Isosurface>& surfaces, const ScalarMap& map, OwningKernelInput& in)
{
  // Beyond all scalars of the tables, which are bounded.
  float below = -std::numeric_limits<float>::infinity();
  for (const Isosurface& surface : surfaces)
  {
    const float value = static_cast<float>(map.Map(surface.Value));
    in.NeighborsOfSurfaces.push_back({ below, value });
    below = value;
    in.ColorsOfSurfaces.insert(in.ColorsOfSurfaces.end(),
      { surface.Color[0], surface.Color[1], surface.Color[2],
        std::clamp(surface.Opacity, 0.f, 1.f) });
  }
  in.NeighborsOfSurfaces.push_back({ below, std::numeric_limits<float>::infinity() });
  in.NumberOfSurfaces = static_cast<int>(surfaces.size());
  in.SurfaceNeighbors = in.NeighborsOfSurfaces.data();
  in.SurfaceColors = in.ColorsOfSurfaces.data();
}

void FillTable(const PreIntegrationTable& table, const float* texels, OwningKernelInput& in)
{
  in.Lookup.Texels = texels;
  in.Lookup.Axis = table.Scalars.Intervals.data();
  in.Lookup.AxisSize = static_cast<int>(table.Scalars.Intervals.size());
  in.Lookup.ScalarSize = table.Scalars.GetSize();
  in.Lookup.LengthSize = table.Lengths.Size;
  in.Lookup.Logarithmic = table.Lengths.Scale == LengthScale::Logarithmic;
  in.Lookup.StepsPerDoubling = table.Lengths.StepsPerDoubling;
  in.Lookup.InverseDelta = table.Lengths.InverseDelta;
  in.Table = &in.Lookup;
}

void FillComponents(const VolumeScene& scene, OwningKernelInput& in)
{
  const std::vector<IntervalTable>& tables = scene.Optics.GetComponentIntervals();
  KernelComponents& components = in.SeveralScalars;
  components.Count = static_cast<int>(tables.size());
  components.Dependent = scene.Optics.GetComponents().Dependent;
  components.Rows = scene.GetComponentRows().front().Scalars;
  for (std::size_t c = 0; c < tables.size(); ++c)
  {
    components.Intervals[c] = tables[c].Intervals.data();
  }
  in.Components = &components;
}

void FillLighting(const VolumeScene& scene, const RayGrid& grid, const RayCastOptions& options,
  const CastChoices& choices, OwningKernelInput& in)
{
  KernelLighting& lighting = in.Light;
  const std::vector<GradientRow>& gradients =
    choices.SmoothShading ? scene.Mesh.GetPointGradients() : scene.Mesh.GetCellGradients();
  lighting.Gradients = gradients.data();
  lighting.NumberOfGradients = static_cast<std::int32_t>(gradients.size());
  lighting.OfPoints = choices.SmoothShading;
  FillKernelLighting(
    options.Lights, options.Surface, grid, choices.WorldRadius, lighting, in.Lights);
  const LightSteps steps = FindLightSteps(options.Lights, options.Surface, choices.LightError);
  lighting.Turn = static_cast<float>(steps.Turn);
  lighting.Approach = static_cast<float>(steps.Approach);
  in.Lighting = &lighting;
}

void FillShifts(const SceneOptics& optics, const CastChoices& choices, KernelInput& in)
{
  const double attenuation = optics.GetIntervalTable().MaximumAttenuation;
  if (choices.DoublePrecision || !HasWeights(choices.Method) || attenuation == 0)
  {
    return;
  }
  in.LargestAttenuation = static_cast<float>(attenuation);
  in.ShiftFactor = static_cast<float>(ShiftRounding * ProjectionScale * attenuation *
    std::max(1., GetLargestColor(optics.GetTransferFunction())) * choices.Brightness);
  in.LargestShiftError = static_cast<float>(choices.GeometryError);
}

void FillRays(const RayGrid& grid, const RayLimits& limits, KernelInput& in)
{
  in.Grid = &grid;
  in.Axes = FindRayAxes(grid);
  in.Planes = limits.Planes.empty() ? nullptr : &limits.Planes.front();
  in.NumberOfPlanes = static_cast<int>(limits.Planes.size());
  in.CroppingPlanes = limits.Cropping ? &limits.CroppingPlanes : nullptr;
  in.CroppingFlags = limits.CroppingFlags;
  in.MaximumDistances = limits.MaximumDistances;
}

void FillEnds(const CastChoices& choices, KernelInput& in)
{
  // Light may make what is behind brighter.
  const double behind = choices.TerminationError / choices.Brightness;
  in.MaximumOpacity = static_cast<float>(1 - behind);
  in.MaximumDepth = static_cast<float>(-std::log(choices.TerminationError));
}

} // namespace

void FillKernelInput(const VolumeScene& scene, const RayGrid& grid, const RayLimits& limits,
  const RayCastOptions& options, const CastChoices& choices, OwningKernelInput& in)
{
  const SceneOptics& optics = scene.Optics;
  const WalkMesh& mesh = *scene.Mesh.GetMesh();
  in.Points = choices.DoublePrecision ? static_cast<const void*>(scene.GetPoints<double>())
                                      : static_cast<const void*>(scene.GetPoints<float>());
  in.CellValues = choices.CellData ? scene.GetCellValues().data() : nullptr;
  FillMesh(mesh, *choices.Tables, in);
  FillIntervals(optics.GetIntervalTable(), in);
  FillSurfaces(
    choices.Method == Integrator::Isosurfaces ? optics.GetIsosurfaces() : std::vector<Isosurface>(),
    scene.GetScalarMap(), in);
  if (choices.Lit)
  {
    FillLighting(scene, grid, options, choices, in);
  }
  if (choices.Method == Integrator::Components)
  {
    FillComponents(scene, in);
  }
  if (IsTabulated(choices.Method))
  {
    FillTable(*optics.GetTable(), optics.GetFloatTexels(), in);
  }
  if (optics.GetModel() == OpticalModel::EmissionAbsorption && scene.GetPlan().ConstantColor)
  {
    std::copy_n(scene.GetPlan().Color, 3, in.Color);
  }
  in.DistanceRounding = choices.WorldRadius *
    (choices.DoublePrecision ? DoubleDistanceRounding : SingleDistanceRounding);
  FillShifts(optics, choices, in);
  FillRays(grid, limits, in);
  FillEnds(choices, in);
}

} // namespace tetralux
