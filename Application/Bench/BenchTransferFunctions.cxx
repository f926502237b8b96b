// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchTransferFunctions.h"

#include "vtkColorTransferFunction.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkVolumeProperty.h"

#include <algorithm>

namespace
{

/// A node: where in the range, 0..1; red, green and blue; opacity.
struct Node
{
  double Place;
  double Color[3];
  double Opacity;
};

/// Half of the needle's width, as a part of the range: a quarter of a texel of 256 scalars.
constexpr double NeedleHalfWidth = 0.25 / 256;

/// Width of a step, as a part of the range. VTK's integrators have no steps, only steep ramps.
constexpr double StepWidth = 1e-6;

/// How much shorter the unit distance is if surfaces are to be opaque.
constexpr double OpaqueDensity = 200;

vtkSmartPointer<vtkVolumeProperty> MakeProperty(
  const std::vector<Node>& nodes, const double range[2], double unitDistance)
{
  vtkNew<vtkColorTransferFunction> color;
  vtkNew<vtkPiecewiseFunction> opacity;
  for (const Node& node : nodes)
  {
    const double scalar = range[0] + node.Place * (range[1] - range[0]);
    color->AddRGBPoint(scalar, node.Color[0], node.Color[1], node.Color[2]);
    opacity->AddPoint(scalar, node.Opacity);
  }
  auto property = vtkSmartPointer<vtkVolumeProperty>::New();
  property->SetColor(color);
  property->SetScalarOpacity(opacity);
  property->SetScalarOpacityUnitDistance(unitDistance);
  property->SetInterpolationTypeToLinear();
  return property;
}

vtkSmartPointer<vtkVolumeProperty> MakeSmooth(const double range[2], double unitDistance)
{
  return MakeProperty(
    { { 0, { 0, 0, 1 }, 0 }, { 0.13, { 0, 1, 1 }, 0.02 }, { 0.21, { 0, 1, 0 }, 0.3 },
      { 0.38, { 1, 1, 0 }, 0.05 }, { 0.7, { 1, 0.5, 0 }, 0.3 }, { 1, { 1, 0, 0 }, 1 } },
    range, unitDistance);
}

/// With the map that ParaView has by default, cool to warm. Between its nodes it is curved.
vtkSmartPointer<vtkVolumeProperty> MakeDiverging(const double range[2], double unitDistance)
{
  vtkSmartPointer<vtkVolumeProperty> property = MakeSmooth(range, unitDistance);
  vtkNew<vtkColorTransferFunction> color;
  color->SetColorSpaceToDiverging();
  color->AddRGBPoint(range[0], 0.231373, 0.298039, 0.752941);
  color->AddRGBPoint(0.5 * (range[0] + range[1]), 0.865, 0.865, 0.865);
  color->AddRGBPoint(range[1], 0.705882, 0.0156863, 0.14902);
  property->SetColor(color);
  return property;
}

vtkSmartPointer<vtkVolumeProperty> MakeNeedle(const double range[2], double unitDistance)
{
  constexpr double place = 0.3;
  return MakeProperty(
    { { 0, { 0.3, 0.4, 1 }, 0.01 }, { place - NeedleHalfWidth, { 0.3, 0.4, 1 }, 0.01 },
      { place, { 1, 0.9, 0.2 }, 1 }, { place + NeedleHalfWidth, { 0.3, 0.9, 0.5 }, 0.01 },
      { 1, { 1, 0.3, 0.2 }, 0.02 } },
    range, unitDistance / 10);
}

vtkSmartPointer<vtkVolumeProperty> MakeSteps(const double range[2], double unitDistance)
{
  const std::vector<Node> colors = { { 0, { 0.2, 0.3, 0.9 }, 0.02 },
    { 0.15, { 0.1, 0.8, 0.9 }, 0.2 }, { 0.25, { 0.2, 0.8, 0.2 }, 0 },
    { 0.35, { 0.9, 0.8, 0.1 }, 0.4 }, { 0.55, { 0.9, 0.4, 0.1 }, 0.05 },
    { 0.8, { 0.9, 0.1, 0.1 }, 0.9 } };
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    nodes.push_back(colors[i]);
    nodes.push_back(colors[i]);
    nodes.back().Place = i + 1 < colors.size() ? colors[i + 1].Place - StepWidth : 1;
  }
  return MakeProperty(nodes, range, unitDistance);
}

vtkSmartPointer<vtkVolumeProperty> MakeOpaque(const double range[2], double unitDistance)
{
  return MakeProperty({ { 0, { 0.2, 0.3, 0.9 }, 0 }, { 0.2, { 0.2, 0.7, 0.9 }, 0 },
                        { 0.3, { 0.9, 0.8, 0.3 }, 1 }, { 1, { 0.9, 0.2, 0.1 }, 1 } },
    range, unitDistance / OpaqueDensity);
}

} // namespace

const std::vector<BenchTransferFunction>& GetBenchTransferFunctions()
{
  static const std::vector<BenchTransferFunction> functions = {
    { "smooth", "colour and opacity of six nodes", MakeSmooth },
    { "diverging", "the same opacity, and ParaView's diverging colours, cool to warm",
      MakeDiverging },
    { "needle", "a peak of 1/512 of the scalar range, narrower than a texel of 256 scalars",
      MakeNeedle },
    { "steps", "six constant pieces with steps of 1e-6 of the range between them", MakeSteps },
    { "opaque", "nothing, then surfaces that light does not get through", MakeOpaque },
  };
  return functions;
}

const BenchTransferFunction& GetBenchTransferFunction(const std::string& name)
{
  const std::vector<BenchTransferFunction>& functions = GetBenchTransferFunctions();
  return *std::find_if(functions.begin(), functions.end(),
    [&name](const BenchTransferFunction& function) { return function.Name == name; });
}
