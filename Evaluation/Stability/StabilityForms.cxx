// SPDX-License-Identifier: BSD-3-Clause
#include "Stability/StabilityForms.h"

#include "Integral/SegmentIntegral.h"
#include "PreIntegration/PreIntegrationBuilder.h"
#include "PreIntegration/PreIntegrationTable.h"
#include "RayCast/RayCaster.h"
#include "Stability/SegmentLanes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <omp.h>

namespace tetralux
{
namespace
{

std::string Format(double number)
{
  std::ostringstream text;
  text << number;
  return text.str();
}

StabilityResult IntegrateDouble(const StabilityCase& segment)
{
  return { IntegrateEmissionAbsorption(
             segment.Function, segment.FrontScalar, segment.BackScalar, segment.Length),
    RayIntegralError, 0 };
}

StabilityResult IntegrateEmission(const StabilityCase& segment)
{
  return { IntegrateEmissionOnly(
             segment.Function, segment.FrontScalar, segment.BackScalar, segment.Length),
    RayIntegralError, 0 };
}

/// As the kernels do it: the pieces front to back, all sums in single precision.
StabilityResult IntegrateSingle(const SegmentLanes& lanes, const StabilityCase& segment)
{
  float color[3] = { 0, 0, 0 };
  float opacity = 0;
  float transmittance = 1;
  ForEachExtendedPiece<Extended>(segment.Function, segment.FrontScalar, segment.BackScalar,
    segment.Length,
    [&](const ExtendedValue<Extended>& front, const ExtendedValue<Extended>& back,
      const Extended& length)
    {
      // All lanes alike.
      float d0[LaneCount], d1[LaneCount], w0[LaneCount], w1[LaneCount], t[LaneCount];
      std::fill_n(d0, LaneCount, static_cast<float>(front.Attenuation * length));
      std::fill_n(d1, LaneCount, static_cast<float>(back.Attenuation * length));
      lanes.IntegrateSegment(d0, d1, w0, w1, t);
      for (int c = 0; c < 3; ++c)
      {
        color[c] += transmittance *
          (static_cast<float>(front.Color[c]) * w0[0] + static_cast<float>(back.Color[c]) * w1[0]);
      }
      opacity += transmittance * (w0[0] + w1[0]);
      transmittance *= t[0];
    });
  StabilityResult result;
  std::copy_n(color, 3, result.Radiance.Color);
  result.Radiance.Opacity = std::min(1.f, opacity);
  result.Radiance.Transmittance = transmittance;
  result.RelativeLimit = SingleIntegralError;
  return result;
}

/// Largest error by taking scalars on the segment for others within a distance, in the integral
/// over its length: a change of tau by d changes the radiance by at most d through the emission and
/// d through the absorption, one of the colour by d changes it by at most tau d.
double GetBlur(const StabilityCase& segment, double distance)
{
  const auto& nodes = segment.Function.Nodes;
  const double first = std::min(segment.FrontScalar, segment.BackScalar) - distance;
  const double last = std::max(segment.FrontScalar, segment.BackScalar);
  // Where the change from the begin of a window to its end can be largest.
  std::vector<double> begins = { first, last };
  for (const TransferFunction::Node& node : nodes)
  {
    begins.push_back(std::clamp(node.Scalar, first, last));
    begins.push_back(std::clamp(node.Scalar - distance, first, last));
  }
  double largest = 0;
  for (const double begin : begins)
  {
    const double end = begin + distance;
    TransferFunction::Value low = Evaluate(segment.Function, begin);
    TransferFunction::Value high = low;
    const auto include = [&](const TransferFunction::Value& value)
    {
      low.Attenuation = std::min(low.Attenuation, value.Attenuation);
      high.Attenuation = std::max(high.Attenuation, value.Attenuation);
      for (int c = 0; c < 3; ++c)
      {
        low.Color[c] = std::min(low.Color[c], value.Color[c]);
        high.Color[c] = std::max(high.Color[c], value.Color[c]);
      }
    };
    include(Evaluate(segment.Function, end));
    for (const TransferFunction::Node& node : nodes)
    {
      if (begin <= node.Scalar && node.Scalar <= end)
      {
        include(node.Left);
        include(node.Right);
      }
    }
    double colorChange = 0;
    for (int c = 0; c < 3; ++c)
    {
      colorChange = std::max(colorChange, high.Color[c] - low.Color[c]);
    }
    largest =
      std::max(largest, 2 * (high.Attenuation - low.Attenuation) + high.Attenuation * colorChange);
  }
  return std::min(1., segment.Length * largest);
}

double GetCasterRounding(const StabilityCase& segment)
{
  const IntervalTable table = MakeIntervalTable(segment.Function);
  const double reach = std::max({ table.Scale, std::abs(segment.FrontScalar - table.Offset),
    std::abs(segment.BackScalar - table.Offset) });
  return CasterRounding * reach;
}

/// Keeps OpenMP from waking its threads for a few cells, ten thousand times.
class OneThread
{
public:
  OneThread()
    : Before(omp_get_max_threads())
  {
    omp_set_num_threads(1);
  }
  ~OneThread() { omp_set_num_threads(this->Before); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

private:
  int Before;
};

/// One ray along the axis of a prism of three tetrahedra, whose bottom has the scalar of the front
/// end and whose top that of the back end. The mesh is always the same; its length is that of its
/// placement in the world.
class CastPrism
{
public:
  CastPrism(Precision precision, bool portable)
  {
    const OneThread oneThread;
    TetrahedralMesh mesh;
    mesh.Points = { -1, -0.8, 0, 1, -0.9, 0, 0.1, 1, 0, -1, -0.8, 1, 1, -0.9, 1, 0.1, 1, 1 };
    mesh.Cells = { 0, 1, 2, 5, 0, 1, 4, 5, 0, 3, 4, 5 };
    const auto walkMesh = std::make_shared<WalkMesh>(std::move(mesh));
    for (std::size_t i = 2; i < walkMesh->GetMesh().Points.size(); i += 3)
    {
      this->AtBack.push_back(walkMesh->GetMesh().Points[i] > 0);
    }
    this->Volume.Mesh.SetMesh(walkMesh);
    // Rays must not end early: the error of that is chosen, not suffered.
    this->Options.MaximumError = 1e-12;
    this->Options.Arithmetic = precision;
    this->Options.NumberOfThreads = 1;
    if (portable)
    {
      this->Options.Kernels = InstructionSet::Generic;
    }
  }

  StabilityResult operator()(const StabilityCase& segment)
  {
    const OneThread oneThread;
    std::vector<double> scalars;
    for (const bool back : this->AtBack)
    {
      scalars.push_back(back ? segment.BackScalar : segment.FrontScalar);
    }
    this->Volume.Mesh.SetPointScalars(std::move(scalars));
    this->Volume.Optics.SetTransferFunction(segment.Function);
    RayGrid grid;
    grid.Width = grid.Height = 1;
    grid.Direction[2] = 1;
    grid.Origin[0] = 0.05 * segment.Length;
    grid.Origin[1] = 0.03 * segment.Length;
    grid.Origin[2] = -segment.Length;
    for (int axis = 0; axis < 3; ++axis)
    {
      grid.MeshFromWorld[axis][axis] = 1 / segment.Length;
    }
    float color[4];
    float depth;
    const RayCastStatistics statistics = CastRays(this->Volume, grid, RayLimits(), this->Options,
      Span<float>(color, 4), Span<float>(&depth, 1));
    StabilityResult result;
    std::copy_n(color, 3, result.Radiance.Color);
    result.Radiance.Opacity = color[3];
    result.Radiance.Transmittance = 1.f - color[3];
    // Colours are single precision numbers, whichever way they were computed.
    result.AbsoluteLimit = std::max(statistics.ErrorEstimate, SegmentWeightError) +
      GetBlur(segment, GetCasterRounding(segment));
    return result;
  }

private:
  VolumeScene Volume;
  std::vector<char> AtBack;
  RayCastOptions Options;
};

std::optional<StabilityResult> LookUp(
  PreIntegrationTable& table, PreIntegrationSettings settings, const StabilityCase& segment)
{
  const OneThread oneThread;
  const auto& nodes = segment.Function.Nodes;
  settings.ScalarSize = settings.LengthSize = StabilityTableSize;
  settings.ScalarRange[0] =
    std::min({ segment.FrontScalar, segment.BackScalar, nodes.front().Scalar });
  settings.ScalarRange[1] =
    std::max({ segment.FrontScalar, segment.BackScalar, nodes.back().Scalar });
  // Of no size that puts the segment on a texel.
  settings.LongestSegment = 1.7 * segment.Length;
  try
  {
    BuildPreIntegrationTable(segment.Function, settings, table);
  }
  catch (const std::invalid_argument&)
  {
    return std::nullopt;
  }
  float color[4];
  table.Lookup(segment.FrontScalar, segment.BackScalar, segment.Length, color);
  StabilityResult result;
  std::copy_n(color, 3, result.Radiance.Color);
  result.Radiance.Opacity = color[3];
  result.Radiance.Transmittance = 1.f - color[3];
  result.AbsoluteLimit =
    table.Bound.Segment + table.Bound.Rounding + GetBlur(segment, GetCasterRounding(segment));
  return result;
}

/// Settings of the tables that are compared, by name.
std::vector<std::pair<std::string, PreIntegrationSettings>> MakeTableSettings()
{
  std::vector<std::pair<std::string, PreIntegrationSettings>> all;
  PreIntegrationSettings settings;
  all.emplace_back("float, linear", settings);
  settings.Axis = ScalarAxis::Uniform;
  all.emplace_back("float, linear, uniform", settings);
  settings.Axis = ScalarAxis::Nodes;
  settings.Scale = LengthScale::Logarithmic;
  all.emplace_back("float, logarithmic", settings);
  settings.Format = TexelFormat::Half;
  all.emplace_back("half, logarithmic", settings);
  settings.Format = TexelFormat::UNorm16;
  all.emplace_back("16 bit, logarithmic", settings);
  settings.Format = TexelFormat::UNorm8;
  all.emplace_back("8 bit, logarithmic", settings);
  return all;
}

} // namespace

std::vector<StabilityForm> MakeStabilityForms()
{
  std::vector<StabilityForm> forms;
  const auto add = [&](const std::string& name, const std::string& promise, auto integrate) {
    forms.push_back({ name, promise, OpticalModel::EmissionAbsorption, std::move(integrate) });
  };
  const std::string ofOpacity = " of the opacity";
  add("double", Format(RayIntegralError) + ofOpacity, IntegrateDouble);
  forms.push_back({ "double, emission only", Format(RayIntegralError) + " of the optical depth",
    OpticalModel::EmissionOnly, IntegrateEmission });
  for (const SegmentLanes& lanes : GetSegmentLanes())
  {
    add("single, " + std::string(lanes.Name), Format(SingleIntegralError) + ofOpacity,
      [lanes](const StabilityCase& segment) { return IntegrateSingle(lanes, segment); });
  }
  const auto addCaster = [&](const std::string& name, Precision precision)
  {
    const auto volume = std::make_shared<CastPrism>(precision, false);
    add("ray caster, " + name, "its own estimate, for scalars rounded to " + Format(CasterRounding),
      [volume](const StabilityCase& segment) { return (*volume)(segment); });
  };
  addCaster("single", Precision::Single);
  addCaster("double", Precision::Double);
  for (const auto& [name, settings] : MakeTableSettings())
  {
    const auto table = std::make_shared<PreIntegrationTable>();
    add("table, " + name, "its own bound, for scalars rounded to " + Format(CasterRounding),
      [table, settings = settings](const StabilityCase& segment)
      { return LookUp(*table, settings, segment); });
  }
  return forms;
}

} // namespace tetralux
