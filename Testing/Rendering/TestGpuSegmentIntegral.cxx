// SPDX-License-Identifier: BSD-3-Clause
// The integrals in shaders against those in double precision.

#include "BulgeWeight.h"
#include "GlslEvaluator.h"
#include "GpuIntegral/GpuSegmentIntegral.h"
#include "GpuIntegral/ScalarBuckets.h"
#include "GpuIntegral/TextureFilterError.h"
#include "Integral/RayIntegral.h"
#include "Integral/SegmentIntegral.h"
#include "OpenGLSnapshot.h"
#include "Optics/BulgeShareError.h"
#include "Optics/IntervalTable.h"
#include "PreIntegration/PreIntegrationBuilder.h"
#include "Stability/StabilityCases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <random>

namespace
{

using tetralux::Integrator;
using tetralux::IntervalTable;
using tetralux::SegmentRadiance;
using tetralux::TransferFunction;
using Arguments = GlslEvaluator::Arguments;
using Result = GlslEvaluator::Result;

constexpr float NotANumber = std::numeric_limits<float>::quiet_NaN();

/// Of a segment's channels, relative to the opacity: SegmentWeightError, and as much again for
/// colours, attenuations and lengths of pieces, which are numbers of single precision.
constexpr double SegmentError = 2 * tetralux::SegmentWeightError;

/// The function that a table holds, over mapped scalars and with its rounded values.
TransferFunction MakeMappedFunction(const IntervalTable& table)
{
  TransferFunction function;
  const auto evaluate = [](const IntervalTable::Interval& t, double x)
  {
    TransferFunction::Value value{};
    value.Attenuation =
      std::max(0., t.Attenuation + static_cast<double>(t.AttenuationSlope) * (x - t.Reference));
    for (int c = 0; c < 3; ++c)
    {
      value.Color[c] = t.Color[c] + static_cast<double>(t.ColorSlope[c]) * (x - t.Reference);
    }
    return value;
  };
  for (std::size_t k = 0; k + 1 < table.Intervals.size(); ++k)
  {
    const IntervalTable::Interval& below = table.Intervals[k];
    const IntervalTable::Interval& above = table.Intervals[k + 1];
    const double x = below.Hi;
    if (function.Nodes.empty() || function.Nodes.back().Scalar < x)
    {
      function.Nodes.push_back({ x, evaluate(below, x), evaluate(above, x) });
    }
    else
    {
      function.Nodes.back().Right = evaluate(above, x);
    }
  }
  return function;
}

struct Measured
{
  double Error = 0; ///< largest, relative
  int NeverRight = 0;
};

/// limit of an error: relative to what.
void Add(Measured& measured, const Result& result, const SegmentRadiance& expected, double size)
{
  const double channels[4] = { expected.Color[0], expected.Color[1], expected.Color[2],
    expected.Opacity };
  bool wrong = !(result[3] <= 1);
  for (int c = 0; c < 4; ++c)
  {
    wrong = wrong || !std::isfinite(result[c]) || result[c] < 0;
    // Numbers of single precision lose digits below 1e-38.
    constexpr double Smallest = 1e-30;
    if (size > Smallest)
    {
      measured.Error = std::max(measured.Error, std::abs(result[c] - channels[c]) / size);
    }
  }
  measured.NeverRight += wrong;
}

/// A function over -1..1, which its table maps to themselves: ramps, steps, a needle, nothing and
/// much.
TransferFunction MakeFunction(double attenuation, double needle)
{
  const auto value = [&](double a, double r, double g, double b) -> TransferFunction::Value {
    return { { r, g, b }, a * attenuation };
  };
  TransferFunction function;
  const auto add = [&](double s, TransferFunction::Value left, TransferFunction::Value right) {
    function.Nodes.push_back({ s, left, right });
  };
  add(-1, value(0.2, 0, 0.25, 1), value(0.2, 0, 0.25, 1));
  add(-0.5, value(1, 1, 0, 0.5), value(0, 0, 1, 0.125));
  add(0, value(0, 0.5, 0.5, 0.5), value(0, 0.5, 0.5, 0.5));
  const auto near = [](double s) { return static_cast<double>(static_cast<float>(s)); };
  add(near(0.25 - needle), value(0.01, 1, 1, 0), value(0.01, 1, 1, 0));
  add(0.25, value(0.1 / needle, 0, 1, 1), value(0.1 / needle, 0, 1, 1));
  add(near(0.25 + needle), value(0.01, 1, 0.75, 0), value(0.01, 1, 0.75, 0));
  add(0.5, value(0.5, 0.3, 0.1, 0.2), value(3, 1, 0, 0));
  add(1, value(2, 0, 0, 1), value(2, 0, 0, 1));
  return function;
}

/// Segments at nodes, beside them, anywhere, with nearly equal ends, and of all lengths.
std::vector<Arguments> MakeSegments(const IntervalTable& table, double longest)
{
  std::mt19937 random(7);
  std::vector<Arguments> segments;
  const auto unit = [&] { return static_cast<double>(random() >> 8) / (1 << 24); };
  const auto scalar = [&]() -> float
  {
    const std::size_t last = table.Intervals.size() - 1;
    const float node = table.Intervals[random() % last].Hi;
    switch (random() % 4)
    {
      case 0:
        return node;
      case 1:
        return std::nextafter(node, random() % 2 ? 2.f : -2.f);
      default:
        return static_cast<float>(2.4 * unit() - 1.2);
    }
  };
  for (int i = 0; i < 4000; ++i)
  {
    const float front = scalar();
    float back = scalar();
    switch (random() % 6)
    {
      case 0:
        back = front;
        break;
      case 1:
        back = front + static_cast<float>(1e-5 * (unit() - 0.5));
        break;
      default:
        break;
    }
    const auto length = static_cast<float>(longest * std::pow(10, -9 * unit()));
    segments.push_back({ front, back, length });
  }
  return segments;
}

class GpuSegmentIntegralTest : public testing::Test
{
public:
  /// IntegrateSegment of a source.
  std::vector<Result> Integrate(
    const tetralux::SegmentSource& source, const std::vector<Arguments>& segments)
  {
    this->Integral.Update(this->Evaluator.Window, source);
    return this->Evaluator.Evaluate(
      this->Integral.GetDeclarations(), this->Expression, segments,
      [this](vtkShaderProgram* program) { this->Integral.Activate(program); },
      [this] { this->Integral.Deactivate(); });
  }

  /// Largest error of a model, relative to size(opacity or depth, ...).
  template <class ReferenceT, class SizeT>
  void Expect(Integrator integrator, const ReferenceT& reference, const SizeT& getSize)
  {
    for (const double needle : { 1e-2, 1e-4 })
    {
      for (const double attenuation : { 1e-9, 1e-3, 1., 1e4, 1e12 })
      {
        const IntervalTable table = tetralux::MakeIntervalTable(MakeFunction(attenuation, needle));
        const TransferFunction mapped = MakeMappedFunction(table);
        tetralux::SegmentSource source;
        source.Integrator = integrator;
        source.Intervals = &table;
        const std::vector<Arguments> segments = MakeSegments(table, 10);
        const std::vector<Result> results = this->Integrate(source, segments);
        Measured measured;
        for (std::size_t i = 0; i < segments.size(); ++i)
        {
          const SegmentRadiance expected =
            reference(mapped, segments[i][0], segments[i][1], segments[i][2]);
          Add(measured, results[i], expected, getSize(mapped, segments[i], expected));
        }
        std::cout << "attenuation " << attenuation << ", needle " << needle << ": relative error "
                  << measured.Error << "\n";
        EXPECT_LE(measured.Error, SegmentError);
        EXPECT_EQ(measured.NeverRight, 0);
      }
    }
  }

  GlslEvaluator Evaluator;
  tetralux::GpuSegmentIntegral Integral;
  std::string Expression = "IntegrateSegment(a.x, a.y, a.z)";
};

double GetOpacity(const TransferFunction&, const Arguments&, const SegmentRadiance& expected)
{
  return expected.Opacity;
}

/// A function of which runs of colours are taken for parabolas.
TransferFunction MakeSmoothFunction()
{
  TransferFunction function;
  for (int k = 0; k <= 200; ++k)
  {
    const double t = k / 200.;
    const TransferFunction::Value value{ { t * t, std::sin(3 * t), 1 - t * t * t }, 1 + t };
    function.Nodes.push_back({ t, value, value });
  }
  return function;
}

TEST_F(GpuSegmentIntegralTest, WeightsOfBulgesAreThoseInDoublePrecision)
{
  std::vector<Arguments> cases;
  for (int k = -24; k <= 24; ++k)
  {
    for (const double share : { 0., 1e-3, 0.1, 0.4999, 0.5, 0.6, 0.9, 1. })
    {
      const double depth = 1.3 * std::pow(10, 0.25 * k);
      cases.push_back(
        { static_cast<float>(2 * depth * share), static_cast<float>(2 * depth * (1 - share)) });
    }
  }
  const TransferFunction function = MakeSmoothFunction();
  const IntervalTable table = tetralux::MakeIntervalTable(
    function, MakeRunTolerance(tetralux::OpticalModel::EmissionAbsorption, function, 1e-2, 1));
  ASSERT_TRUE(table.Curved);
  tetralux::SegmentSource source;
  source.Intervals = &table;
  this->Expression = "vec4(WeighSegment(a.x, a.y), 0.0)";
  const std::vector<Result> results = this->Integrate(source, cases);
  double largest = 0;
  for (std::size_t i = 0; i < cases.size(); ++i)
  {
    const double opacity = static_cast<double>(results[i][0]) + results[i][1];
    const double expected = tetralux::GetBulgeWeight(cases[i][0], cases[i][1]);
    largest = std::max(largest, std::abs(results[i][2] - expected) / opacity);
  }
  std::cout << "largest error of an opacity " << largest << "\n";
  EXPECT_LE(largest, tetralux::BulgeShareError);
}

TEST_F(GpuSegmentIntegralTest, WeightsAreThoseInDoublePrecision)
{
  std::vector<Arguments> cases;
  for (int k = -24; k <= 24; ++k)
  {
    for (const double share : { 0., 1e-9, 1e-3, 0.1, 0.3, 0.4999999, 0.5, 0.6, 0.9, 0.9999, 1. })
    {
      const double depth = 1.3 * std::pow(10, 0.5 * k);
      cases.push_back(
        { static_cast<float>(2 * depth * share), static_cast<float>(2 * depth * (1 - share)) });
    }
  }
  for (int i = 0; i < 2000; ++i)
  {
    cases.push_back({ static_cast<float>(0.01 * (i % 97)), static_cast<float>(0.013 * (i % 83)) });
  }
  const IntervalTable table = tetralux::MakeIntervalTable(MakeFunction(1, 1e-2));
  tetralux::SegmentSource source;
  source.Intervals = &table;
  this->Expression = "vec4(WeighSegment(a.x, a.y).xy, 0.0, 0.0)";
  const std::vector<Result> results = this->Integrate(source, cases);
  this->Expression = "vec4(GetOpacity(0.5 * (a.x + a.y)))";
  const std::vector<Result> opacities = this->Integrate(source, cases);
  double worst = 0;
  double worstOpacity = 0;
  for (std::size_t i = 0; i < cases.size(); ++i)
  {
    TransferFunction ramp;
    const TransferFunction::Value front{ { 1, 0, 0 }, cases[i][0] };
    const TransferFunction::Value back{ { 0, 1, 0 }, cases[i][1] };
    ramp.Nodes = { { 0, front, front }, { 1, back, back } };
    const SegmentRadiance expected = tetralux::IntegrateEmissionAbsorption(ramp, 0, 1, 1);
    if (expected.Opacity > 0)
    {
      for (int c = 0; c < 2; ++c)
      {
        EXPECT_GE(results[i][c], 0);
        worst = std::max(worst, std::abs(results[i][c] - expected.Color[c]) / expected.Opacity);
      }
      worstOpacity =
        std::max(worstOpacity, std::abs(opacities[i][0] - expected.Opacity) / expected.Opacity);
    }
    EXPECT_LE(results[i][0] + results[i][1], 1);
    EXPECT_LE(opacities[i][0], 1);
  }
  std::cout << "weights " << worst << ", opacity " << worstOpacity << "\n";
  EXPECT_LE(worst, tetralux::SegmentWeightError);
  EXPECT_LE(worstOpacity, tetralux::SegmentWeightError);
}

TEST_F(GpuSegmentIntegralTest, EmissionAndAbsorption)
{
  this->Expect(Integrator::ClosedForm, tetralux::IntegrateEmissionAbsorption, GetOpacity);
}

TEST_F(GpuSegmentIntegralTest, AbsorptionAlone)
{
  this->Expect(Integrator::OpticalDepth, tetralux::IntegrateAbsorptionOnly, GetOpacity);
}

TEST_F(GpuSegmentIntegralTest, EmissionAlone)
{
  const auto getSize =
    [](const TransferFunction& function, const Arguments& segment, const SegmentRadiance&)
  {
    // The optical depth: emission of white.
    TransferFunction white = function;
    for (TransferFunction::Node& node : white.Nodes)
    {
      node.Left.Color[0] = node.Right.Color[0] = 1;
    }
    return tetralux::IntegrateEmissionOnly(white, segment[0], segment[1], segment[2]).Color[0];
  };
  this->Expect(Integrator::Emission, tetralux::IntegrateEmissionOnly, getSize);
}

TEST_F(GpuSegmentIntegralTest, ThinSegmentsNeedNoParts)
{
  const IntervalTable table = tetralux::MakeIntervalTable(MakeFunction(0.01, 1e-2));
  tetralux::SegmentSource source;
  source.Intervals = &table;
  const double longest = 1.49 / table.MaximumAttenuation;
  const std::vector<Arguments> segments = MakeSegments(table, longest);
  const std::vector<Result> any = this->Integrate(source, segments);
  EXPECT_EQ(this->Integral.GetDeclarations().find("#define ONLY_THIN"), std::string::npos);
  source.LongestSegment = longest;
  const std::vector<Result> thin = this->Integrate(source, segments);
  EXPECT_NE(this->Integral.GetDeclarations().find("#define ONLY_THIN"), std::string::npos);
  const TransferFunction mapped = MakeMappedFunction(table);
  Measured measured;
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    const SegmentRadiance expected =
      tetralux::IntegrateEmissionAbsorption(mapped, segments[i][0], segments[i][1], segments[i][2]);
    Add(measured, thin[i], expected, expected.Opacity);
    for (int c = 0; c < 4; ++c)
    {
      EXPECT_NEAR(thin[i][c], any[i][c], SegmentError * expected.Opacity);
    }
  }
  EXPECT_LE(measured.Error, SegmentError);
  EXPECT_EQ(measured.NeverRight, 0);
}

TEST_F(GpuSegmentIntegralTest, HugeScalarsAreBeyondAllNodes)
{
  const IntervalTable table = tetralux::MakeIntervalTable(MakeFunction(1, 1e-2));
  tetralux::SegmentSource source;
  source.Intervals = &table;
  constexpr float Infinity = std::numeric_limits<float>::infinity();
  const std::vector<Result> results =
    this->Integrate(source, { { Infinity, 2, 1 }, { -2, -Infinity, 1 }, { 2, 3e38f, 1 } });
  const double opacities[] = { -std::expm1(-2.), -std::expm1(-0.2), -std::expm1(-2.) };
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(results[i][3], opacities[i], SegmentError);
  }
}

TEST_F(GpuSegmentIntegralTest, ConstantColor)
{
  TransferFunction function = MakeFunction(1, 1e-2);
  const double color[3] = { 0.25, 1, 0.5 };
  for (TransferFunction::Node& node : function.Nodes)
  {
    std::copy_n(color, 3, node.Left.Color);
    std::copy_n(color, 3, node.Right.Color);
  }
  const IntervalTable table = tetralux::MakeIntervalTable(function);
  const TransferFunction mapped = MakeMappedFunction(table);
  tetralux::SegmentSource source;
  source.Intervals = &table;
  source.Integrator = Integrator::OpticalDepth;
  std::copy_n(color, 3, source.Color);
  const std::vector<Arguments> segments = MakeSegments(table, 10);
  const std::vector<Result> results = this->Integrate(source, segments);
  Measured measured;
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    const SegmentRadiance expected =
      tetralux::IntegrateEmissionAbsorption(mapped, segments[i][0], segments[i][1], segments[i][2]);
    Add(measured, results[i], expected, expected.Opacity);
  }
  EXPECT_LE(measured.Error, SegmentError);
  EXPECT_EQ(measured.NeverRight, 0);
}

TEST_F(GpuSegmentIntegralTest, LargestScalar)
{
  const IntervalTable table = tetralux::MakeIntervalTable(MakeFunction(0.4, 0.1));
  const TransferFunction mapped = MakeMappedFunction(table);
  tetralux::SegmentSource source;
  source.Integrator = Integrator::Maximum;
  source.Intervals = &table;
  std::vector<Arguments> cases = MakeSegments(table, 1);
  cases.push_back({ NotANumber });
  cases.push_back({ -3e38f });
  this->Expression = "ClassifyLargest(a.x)";
  const std::vector<Result> results = this->Integrate(source, cases);
  for (std::size_t i = 0; i < cases.size(); ++i)
  {
    const SegmentRadiance expected =
      cases[i][0] > -1e30f ? tetralux::ClassifyMaximum(mapped, cases[i][0]) : SegmentRadiance();
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(results[i][c], expected.Color[c], 1e-6);
    }
    EXPECT_NEAR(results[i][3], expected.Opacity, 1e-6);
  }
}

TEST_F(GpuSegmentIntegralTest, CellsOfConstantScalar)
{
  std::vector<tetralux::CellValue> values;
  std::vector<Arguments> cases;
  for (int i = 0; i < 500; ++i)
  {
    values.push_back({ static_cast<float>(std::pow(10, (i % 40) * 0.5 - 10)),
      { 0.01f * (i % 100), 0.02f * (i % 50), 0.05f * (i % 20) } });
    cases.push_back({ static_cast<float>(i), 0.01f * static_cast<float>(1 + i % 300) });
  }
  this->Expression = "IntegrateCell(int(a.x), a.y)";
  const TransferFunction one{ { { 0, { { 1, 0, 0 }, 1 }, { { 1, 0, 0 }, 1 } } } };
  const IntervalTable table = tetralux::MakeIntervalTable(one);
  for (const Integrator integrator :
    { Integrator::ClosedForm, Integrator::Emission, Integrator::OpticalDepth })
  {
    tetralux::SegmentSource source;
    source.Integrator = integrator;
    source.Intervals = &table;
    source.CellValues = values;
    const std::vector<Result> results = this->Integrate(source, cases);
    for (std::size_t i = 0; i < cases.size(); ++i)
    {
      const double depth = static_cast<double>(values[i].Attenuation) * cases[i][1];
      const double opacity = integrator == Integrator::Emission ? 0 : -std::expm1(-depth);
      const double emission = integrator == Integrator::Emission ? depth
        : integrator == Integrator::OpticalDepth                 ? 0
                                                                 : opacity;
      const double size = std::max(opacity, emission);
      EXPECT_NEAR(results[i][3], opacity, SegmentError * size);
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_NEAR(results[i][c], emission * values[i].Color[c], SegmentError * size);
      }
    }
  }
}

TEST_F(GpuSegmentIntegralTest, Isosurfaces)
{
  const std::vector<tetralux::Isosurface> surfaces = { { -0.5, { 1, 0, 0.5f }, 0.5f },
    { 0, { 0, 1, 0.25f }, 0.25f }, { 0.75, { 0.5f, 0.125f, 1 }, 1 } };
  tetralux::SegmentSource source;
  source.Integrator = Integrator::Isosurfaces;
  source.Surfaces = surfaces;
  std::vector<Arguments> cases;
  for (const float front : { -1.f, -0.5f, 0.f, 0.3f, 0.75f, 0.8f, NotANumber })
  {
    for (const float back : { -1.f, -0.5f, 0.f, 0.3f, 0.75f, 0.8f, NotANumber })
    {
      cases.push_back({ front, back, 1 });
    }
  }
  const std::vector<Result> results = this->Integrate(source, cases);
  for (std::size_t i = 0; i < cases.size(); ++i)
  {
    const SegmentRadiance expected =
      tetralux::IntegrateIsosurfaces(surfaces, cases[i][0], cases[i][1]);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(results[i][c], expected.Color[c], 1e-6);
    }
    EXPECT_NEAR(results[i][3], expected.Opacity, 1e-6);
  }
}

TEST_F(GpuSegmentIntegralTest, NoNumbersAndNoLengthContributeNothing)
{
  const IntervalTable table = tetralux::MakeIntervalTable(MakeFunction(1, 1e-2));
  const std::vector<Arguments> cases = { { NotANumber, 0.5f, 1 }, { 0.5f, NotANumber, 1 },
    { NotANumber, NotANumber, 1 }, { 0.25f, 0.5f, 0 }, { 0.25f, 0.5f, -1 } };
  for (const Integrator integrator :
    { Integrator::ClosedForm, Integrator::Emission, Integrator::OpticalDepth })
  {
    tetralux::SegmentSource source;
    source.Integrator = integrator;
    source.Intervals = &table;
    for (const Result& result : this->Integrate(source, cases))
    {
      EXPECT_EQ(result, (Result{ 0, 0, 0, 0 }));
    }
  }
}

TEST_F(GpuSegmentIntegralTest, TablesAreInterpolatedAsTheirLookupDefines)
{
  const TransferFunction function = MakeFunction(1, 0.1);
  const IntervalTable intervals = tetralux::MakeIntervalTable(function);
  std::uint64_t version = 0;
  for (const tetralux::TexelFormat format :
    { tetralux::TexelFormat::Float, tetralux::TexelFormat::Half, tetralux::TexelFormat::UNorm16,
      tetralux::TexelFormat::UNorm8 })
  {
    for (const bool logarithmic : { false, true })
    {
      for (const bool uniform : { false, true })
      {
        tetralux::PreIntegrationSettings settings;
        settings.ScalarSize = 24;
        settings.LengthSize = 20;
        settings.Scale =
          logarithmic ? tetralux::LengthScale::Logarithmic : tetralux::LengthScale::Linear;
        settings.StepsPerDoubling = 2;
        settings.Axis = uniform ? tetralux::ScalarAxis::Uniform : tetralux::ScalarAxis::Nodes;
        settings.Format = format;
        settings.ScalarRange[0] = -1;
        settings.LongestSegment = 5;
        tetralux::PreIntegrationTable table;
        tetralux::BuildPreIntegrationTable(function, settings, table);
        // Beyond all axes, too.
        std::vector<Arguments> segments = MakeSegments(intervals, 7);
        segments.push_back({ NotANumber, 0, 1 });
        segments.push_back({ 0.5f, 0.5f, 0 });
        tetralux::SegmentSource source;
        source.Intervals = &intervals;
        source.Integrator = Integrator::Table;
        source.Table = &table;
        source.TableVersion = ++version;
        source.FilterInShader = true;
        const std::vector<Result> results = this->Integrate(source, segments);
        EXPECT_GE(this->Integral.GetNumberOfBytes(), table.GetNumberOfBytes());
        double worst = 0;
        for (std::size_t i = 0; i < segments.size(); ++i)
        {
          float expected[4] = { 0, 0, 0, 0 };
          if (!std::isnan(segments[i][0]) && segments[i][2] > 0)
          {
            table.Lookup(segments[i][0], segments[i][1], segments[i][2], expected);
          }
          for (int c = 0; c < 4; ++c)
          {
            worst = std::max<double>(worst, std::abs(results[i][c] - expected[c]));
          }
        }
        // Coordinates up to the sizes are numbers of single precision.
        EXPECT_LE(worst, 4e-6) << static_cast<int>(format) << logarithmic << uniform;

        // By the graphics card where that is off by a last place of the texels along each axis.
        source.FilterInShader = false;
        const std::vector<Result> filtered = this->Integrate(source, segments);
        double difference = 0;
        for (std::size_t i = 0; i < segments.size(); ++i)
        {
          for (int c = 0; c < 4; ++c)
          {
            difference = std::max<double>(difference, std::abs(filtered[i][c] - results[i][c]));
          }
        }
        std::cout << "format " << static_cast<int>(format) << ": error " << worst
                  << ", filtered by the card " << difference << " more\n";
        const double lastPlace[] = { 1. / 255, 1. / 65535, 1. / 2048, 1. / (1 << 20) };
        EXPECT_LE(difference, 3 * lastPlace[static_cast<int>(format)]);
      }
    }
  }
}

TEST_F(GpuSegmentIntegralTest, InterpolationOfTheCardIsMeasured)
{
  const OpenGLSnapshot before = TakeOpenGLSnapshot(this->Evaluator.Window);
  for (const tetralux::TexelFormat format :
    { tetralux::TexelFormat::UNorm8, tetralux::TexelFormat::UNorm16, tetralux::TexelFormat::Half,
      tetralux::TexelFormat::Float })
  {
    const double error = tetralux::MeasureTextureFilterError(this->Evaluator.Window, format);
    std::cout << "format " << static_cast<int>(format) << ": " << error << "\n";
    // Eight bits are what any card has.
    EXPECT_LE(error, 1.01 / 256 + 1.01 / 512);
    EXPECT_GE(error, 0);
  }
  EXPECT_EQ(FindDifferences(before, TakeOpenGLSnapshot(this->Evaluator.Window)), "");
}

TEST(ScalarBuckets, GiveTheIntervalAtTheirBegin)
{
  // Steps, clusters, and nodes at and beyond both ends.
  const std::vector<float> ends = { -3, -1, -0.5f, -0.5f, 0, 1e-6f, 2e-6f, 0.3f, 0.30001f, 1, 2 };
  const std::vector<std::int32_t> buckets = tetralux::MakeScalarBuckets(ends);
  const std::size_t size = buckets.size() - 2;
  EXPECT_GE(size, 1024u);
  EXPECT_LE(buckets.size(), 65536u); // what OpenGL promises
  EXPECT_EQ(buckets[0], 0);
  for (std::size_t k = 1; k < buckets.size(); ++k)
  {
    const double begin = -1 + 2. * static_cast<double>(k - 1) / static_cast<double>(size);
    const double before = begin - 0.05 / static_cast<double>(size); // rounding, and more
    const auto find = [&](double scalar)
    {
      return std::upper_bound(
               ends.begin(), ends.end(), scalar, [](double s, float end) { return s < end; }) -
        ends.begin();
    };
    ASSERT_LE(buckets[k], find(begin));
    ASSERT_GE(buckets[k], find(before));
  }
}

TEST_F(GpuSegmentIntegralTest, StableWhereIntegralsAreStiff)
{
  // Scalars and nodes as they are rounded, so that all that is measured is the integral.
  Measured measured;
  for (const tetralux::StabilityGroup& group : tetralux::MakeStabilityGroups(1, 200))
  {
    for (const tetralux::StabilityCase& segment : group.Cases)
    {
      IntervalTable table;
      try
      {
        table = tetralux::MakeIntervalTable(segment.Function);
      }
      catch (const std::invalid_argument&)
      {
        continue;
      }
      tetralux::SegmentSource source;
      source.Intervals = &table;
      const auto map = [&](double s)
      { return static_cast<float>(std::clamp((s - table.Offset) / table.Scale, -1e30, 1e30)); };
      const Arguments arguments = { map(segment.FrontScalar), map(segment.BackScalar),
        static_cast<float>(segment.Length) };
      const Result result = this->Integrate(source, { arguments }).front();
      const SegmentRadiance expected = tetralux::IntegrateEmissionAbsorption(
        MakeMappedFunction(table), arguments[0], arguments[1], arguments[2]);
      const double before = measured.Error;
      Add(measured, result, expected, expected.Opacity);
      if (measured.Error > before && measured.Error > SegmentError)
      {
        std::cout << group.Name << ": " << arguments[0] << " " << arguments[1] << " "
                  << arguments[2] << " error " << measured.Error << " of " << expected.Opacity
                  << "\n";
      }
    }
  }
  std::cout << "relative error " << measured.Error << "\n";
  EXPECT_LE(measured.Error, SegmentError);
  EXPECT_EQ(measured.NeverRight, 0);
}

} // namespace
