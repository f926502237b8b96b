// SPDX-License-Identifier: BSD-3-Clause
#include "Stability/StabilitySuite.h"

#include "Integral/SegmentIntegral.h"
#include "RayCast/RayCaster.h"

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tetralux
{
namespace
{

using FiftyDigits = boost::multiprecision::cpp_bin_float_50;

constexpr std::uint64_t Seed = 20031022;
constexpr int NumberOfRandomCases = 3000;

/// What the reference leaves out and rounds, relative to the opacity.
constexpr double ReferenceError = 1e-17;

double ToDouble(const FiftyDigits& number) { return static_cast<double>(number); }

/// Some cases of each group.
std::vector<StabilityCase> PickCases(std::size_t stride)
{
  std::vector<StabilityCase> picked;
  for (const StabilityGroup& group : MakeStabilityGroups(Seed, 200))
  {
    for (std::size_t i = stride / 2; i < group.Cases.size(); i += stride)
    {
      picked.push_back(group.Cases[i]);
    }
  }
  return picked;
}

/// One channel's integral by tanh-sinh quadrature over each piece as a whole.
FiftyDigits IntegrateByTanhSinh(const StabilityCase& segment, int channel)
{
  boost::math::quadrature::tanh_sinh<FiftyDigits> rule;
  FiftyDigits depth = 0;
  FiftyDigits sum = 0;
  ForEachExtendedPiece<FiftyDigits>(segment.Function, segment.FrontScalar, segment.BackScalar,
    segment.Length,
    [&](const ExtendedValue<FiftyDigits>& front, const ExtendedValue<FiftyDigits>& back,
      const FiftyDigits& length)
    {
      const FiftyDigits rise = back.Attenuation - front.Attenuation;
      const auto radiance = [&](const FiftyDigits& x) -> FiftyDigits
      {
        const FiftyDigits behind = depth + length * (front.Attenuation * x + rise * x * x / 2);
        return length * (front.Attenuation + rise * x) *
          (front.Color[channel] * (1 - x) + back.Color[channel] * x) * exp(FiftyDigits(-behind));
      };
      sum += rule.integrate(radiance, FiftyDigits(0), FiftyDigits(1), FiftyDigits(1e-25));
      depth += length * (front.Attenuation + back.Attenuation) / 2;
    });
  return sum;
}

TEST(Stability, ReferenceAgreesWithAnotherQuadrature)
{
  // tanh-sinh does not cut pieces, so it is slow where the light fades in a small part of one.
  constexpr double LargestDepth = 30;
  int compared = 0;
  for (const StabilityCase& segment : PickCases(137))
  {
    const auto reference = IntegrateExtended<FiftyDigits>(
      segment.Function, segment.FrontScalar, segment.BackScalar, segment.Length);
    if (reference.Depth > LargestDepth || reference.Opacity < SmallestOpacity)
    {
      continue;
    }
    for (int c = 0; c < 3; ++c)
    {
      const FiftyDigits other = IntegrateByTanhSinh(segment, c);
      EXPECT_LE(ToDouble(abs(reference.Color[c] - other) / reference.Opacity), ReferenceError);
    }
    ++compared;
  }
  EXPECT_GE(compared, 15);
}

TEST(Stability, ReferenceAgreesWithFiftyDigits)
{
  for (const StabilityCase& segment : PickCases(97))
  {
    const auto precise = IntegrateExtended<FiftyDigits>(
      segment.Function, segment.FrontScalar, segment.BackScalar, segment.Length);
    const auto reference = IntegrateExtended<Extended>(
      segment.Function, segment.FrontScalar, segment.BackScalar, segment.Length);
    const FiftyDigits limit = FiftyDigits(ReferenceError) * precise.Opacity;
    EXPECT_LE(abs(FiftyDigits(reference.Opacity) - precise.Opacity), limit);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_LE(abs(FiftyDigits(reference.Color[c]) - precise.Color[c]), limit);
      EXPECT_LE(abs(FiftyDigits(reference.Emission[c]) - precise.Emission[c]),
        FiftyDigits(ReferenceError) * precise.Depth);
    }
  }
}

bool StartsWith(const std::string& text, const std::string& start)
{
  return text.compare(0, start.size(), start) == 0;
}

TEST(Stability, EveryFormKeepsItsPromise)
{
  const std::vector<StabilityGroup> groups = MakeStabilityGroups(Seed, NumberOfRandomCases);
  const std::vector<StabilityForm> forms = MakeStabilityForms();
  std::size_t cases = 0;
  for (const StabilityGroup& group : groups)
  {
    cases += group.Cases.size();
  }
  EXPECT_GE(cases, 5000u);
  double ofDouble = 0;
  double ofSingle = 0;
  for (const StabilityRow& row : MeasureStability(groups, forms))
  {
    SCOPED_TRACE(row.Form + ", " + row.Group);
    EXPECT_GT(row.NumberOfCases, 0);
    EXPECT_EQ(row.NotFinite, 0);
    EXPECT_EQ(row.Negative, 0);
    EXPECT_EQ(row.AboveOne, 0);
    EXPECT_LE(row.ShareOfPromise, 1);
    if (StartsWith(row.Form, "double"))
    {
      EXPECT_LE(row.RelativeError, 1e-12);
      ofDouble = std::max(ofDouble, row.RelativeError);
    }
    else if (StartsWith(row.Form, "single"))
    {
      EXPECT_LE(row.RelativeError, 1e-6);
      ofSingle = std::max(ofSingle, row.RelativeError);
    }
  }
  std::cout << "Largest error, relative to the opacity: double " << ofDouble << ", single "
            << ofSingle << "\n";
  RecordProperty("double", std::to_string(ofDouble * 1e15) + "e-15");
  RecordProperty("single", std::to_string(ofSingle * 1e9) + "e-9");
}

TEST(Stability, RayCasterIsExactWhereNothingIsNarrowerThanItsRounding)
{
  // Absolute, of a colour channel or the opacity: the integral's, and as much for the coordinates.
  constexpr double Limit = 2 * SegmentWeightError;
  const std::string smooth[] = { "optical depth", "attenuation slope", "opacity 1", "scalar range",
    "constant field", "length" };
  int compared = 0;
  for (const StabilityRow& row :
    MeasureStability(MakeStabilityGroups(Seed, 0), MakeStabilityForms()))
  {
    const bool isSmooth = std::any_of(std::begin(smooth), std::end(smooth),
      [&](const std::string& start) { return StartsWith(row.Group, start); });
    if (StartsWith(row.Form, "ray caster") && isSmooth)
    {
      EXPECT_LE(row.AbsoluteError, Limit) << row.Form << ", " << row.Group;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 12);
}

/// A column of so many prisms, each of three tetrahedra, along z from 0 to 1.
TetrahedralMesh MakeColumn(int layers)
{
  TetrahedralMesh mesh;
  for (int k = 0; k <= layers; ++k)
  {
    const double z = static_cast<double>(k) / layers;
    mesh.Points.insert(mesh.Points.end(), { -1, -0.8, z, 1, -0.9, z, 0.1, 1, z });
  }
  for (int k = 0; k < layers; ++k)
  {
    for (const int corner : { 0, 1, 2, 5, 0, 1, 4, 5, 0, 3, 4, 5 })
    {
      mesh.Cells.push_back(3 * k + corner);
    }
  }
  return mesh;
}

TEST(Stability, RayCasterLosesAtMostOneRoundingForEachSegment)
{
  // Transmittance and colours are sums over the segments in single precision: what a thin segment
  // changes is rounded to 2^-24 of them. RayCastStatistics::ErrorEstimate leaves that out, since it
  // does not know how many cells a ray goes through.
  constexpr double Rounding = 1. / (1 << 24);
  for (const int layers : { 10, 100, 1000 })
  {
    const auto mesh = std::make_shared<WalkMesh>(MakeColumn(layers));
    std::vector<double> scalars;
    for (std::size_t i = 2; i < mesh->GetMesh().Points.size(); i += 3)
    {
      scalars.push_back(mesh->GetMesh().Points[i]);
    }
    VolumeScene volume;
    volume.Mesh.SetMesh(mesh);
    volume.Mesh.SetPointScalars(scalars);
    for (const double depth : { 1e-6, 1e-3, 0.1, 1., 10. })
    {
      const TransferFunction::Value left = { { 1, 0.5, 0 }, depth };
      const TransferFunction::Value right = { { 0.25, 1, 0.75 }, 1.5 * depth };
      TransferFunction function;
      function.Nodes = { { 0, left, left }, { 1, right, right } };
      volume.Optics.SetTransferFunction(function);
      RayGrid grid;
      grid.Width = grid.Height = 1;
      grid.Origin[0] = 0.05;
      grid.Origin[1] = 0.03;
      grid.Origin[2] = -1;
      grid.Direction[2] = 1;
      RayCastOptions options;
      options.MaximumError = 1e-12; // nothing ends early
      float color[4];
      float first;
      const RayCastStatistics statistics =
        CastRays(volume, grid, RayLimits(), options, Span<float>(color, 4), Span<float>(&first, 1));
      ASSERT_EQ(statistics.Segments, 3 * layers);
      const double limit = SegmentWeightError + statistics.ErrorEstimate +
        Rounding * static_cast<double>(statistics.Segments);
      const SegmentRadiance expected = IntegrateEmissionAbsorption(function, 0, 1, 1);
      EXPECT_NEAR(color[3], expected.Opacity, limit) << layers << " " << depth;
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(color[c], expected.Color[c], limit) << layers << " " << depth;
      }
    }
  }
}

TEST(Stability, SameSeedSameCases)
{
  const auto draw = [](std::uint64_t seed) { return MakeStabilityGroups(seed, 50).back().Cases; };
  const std::vector<StabilityCase> first = draw(1);
  const std::vector<StabilityCase> again = draw(1);
  const std::vector<StabilityCase> other = draw(2);
  ASSERT_EQ(first.size(), 50u);
  bool differs = false;
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    EXPECT_EQ(first[i].FrontScalar, again[i].FrontScalar);
    EXPECT_EQ(first[i].Length, again[i].Length);
    differs = differs || first[i].Length != other[i].Length;
  }
  EXPECT_TRUE(differs);
}

/// What the suite says about a form that is right but for what is done to its result.
template <class Spoil>
StabilityRow MeasureSpoilt(const Spoil& spoil)
{
  TransferFunction function;
  const TransferFunction::Value value = { { 0.5, 0.25, 1 }, 2 };
  function.Nodes = { { 0, value, value } };
  const std::vector<StabilityGroup> groups = { { "one", { { function, 0, 0, 1 } } } };
  StabilityForm form = MakeStabilityForms().front();
  form.Integrate = [integrate = form.Integrate, spoil](const StabilityCase& segment)
  {
    std::optional<StabilityResult> result = integrate(segment);
    spoil(result->Radiance);
    return result;
  };
  return MeasureStability(groups, std::vector<StabilityForm>{ form }).front();
}

TEST(Stability, BadResultsAreCounted)
{
  EXPECT_TRUE(MeasureSpoilt([](SegmentRadiance&) {}).IsKept());

  StabilityRow row = MeasureSpoilt([](SegmentRadiance& r) { r.Color[1] += 1e-11; });
  EXPECT_FALSE(row.IsKept());
  EXPECT_NEAR(row.AbsoluteError, 1e-11, 1e-15);
  EXPECT_EQ(row.NotFinite + row.Negative + row.AboveOne, 0);

  row = MeasureSpoilt([](SegmentRadiance& r) { r.Transmittance += 1e-11; });
  EXPECT_FALSE(row.IsKept());

  row = MeasureSpoilt(
    [](SegmentRadiance& r) { r.Color[0] = std::numeric_limits<double>::quiet_NaN(); });
  EXPECT_EQ(row.NotFinite, 1);
  EXPECT_FALSE(row.IsKept());

  row = MeasureSpoilt([](SegmentRadiance& r) { r.Color[2] = -1e-300; });
  EXPECT_EQ(row.Negative, 1);
  EXPECT_FALSE(row.IsKept());

  row = MeasureSpoilt([](SegmentRadiance& r) { r.Opacity = std::nextafter(1., 2.); });
  EXPECT_EQ(row.AboveOne, 1);
  EXPECT_FALSE(row.IsKept());
}

} // namespace
} // namespace tetralux
