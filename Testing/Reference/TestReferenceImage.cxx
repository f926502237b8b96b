// SPDX-License-Identifier: BSD-3-Clause
// Tests of the oracle of image data, against fields whose integral is known in closed form.
#include "ReferenceImage.h"
#include "ReferenceScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using namespace tetralux;
using Vector = std::array<double, 3>;

/// Of a channel: some thousand roundings of double precision at worst.
constexpr double Rounding = 1e-12;
/// Of a channel: what the integral promises.
constexpr double IntegralError = 1e-10;

struct Scene
{
  std::array<int, 3> Dimensions;
  std::vector<float> Values;
  ImageOptics Optics;
  RayGrid Grid;
  RayLimits Limits;

  Scene(const std::array<int, 3>& dimensions, const std::function<double(int, int, int)>& value)
    : Dimensions(dimensions)
  {
    for (int k = 0; k < dimensions[2]; ++k)
    {
      for (int j = 0; j < dimensions[1]; ++j)
      {
        for (int i = 0; i < dimensions[0]; ++i)
        {
          this->Values.push_back(static_cast<float>(value(i, j, k)));
        }
      }
    }
  }

  ImageVolume GetVolume() const
  {
    ImageVolume volume;
    std::copy(this->Dimensions.begin(), this->Dimensions.end(), volume.Dimensions);
    volume.Values = this->Values.data();
    return volume;
  }

  /// One ray from a point towards another one.
  void Aim(const Vector& from, const Vector& to)
  {
    this->Grid = RayGrid();
    this->Grid.Width = this->Grid.Height = 1;
    for (int a = 0; a < 3; ++a)
    {
      this->Grid.Origin[a] = from[a];
      this->Grid.Direction[a] = to[a] - from[a];
    }
  }

  ReferencePixel Integrate() const
  {
    return IntegrateReferenceRay(this->GetVolume(), this->Optics, this->Grid, this->Limits, 0, 0);
  }
  ReferencePixel Sample(double distance, SliceShape shape = SliceShape::Planes) const
  {
    ReferenceSlices slices;
    slices.Shape = shape;
    slices.Distance = distance;
    return SampleReferenceRay(
      this->GetVolume(), this->Optics, this->Grid, this->Limits, slices, 0, 0);
  }
};

Scene MakeConstant(double opacity, StepOpacity model, double unit)
{
  Scene scene({ 9, 7, 5 }, [](int, int, int) { return 0.3; });
  scene.Optics.Function = MakeConstantFunction(opacity, { 0.8, 0.5, 0.1 });
  scene.Optics.Opacity = model;
  scene.Optics.UnitDistance = unit;
  return scene;
}

/// A ray over a length, through constant opacity, by both ways and several distances.
void ExpectConstant(const Scene& scene, double length, double depth)
{
  const double a = scene.Optics.Function.Nodes[0].Left.Attenuation;
  const double l = length / scene.Optics.UnitDistance;
  const double alpha = scene.Optics.Opacity == StepOpacity::Power ? -std::expm1(std::log1p(-a) * l)
                                                                  : -std::expm1(-a * l);
  std::vector<ReferencePixel> pixels{ scene.Integrate() };
  for (const double distance : { 1e-2, 0.37, 1., 100. })
  {
    pixels.push_back(scene.Sample(distance));
    pixels.push_back(scene.Sample(distance, SliceShape::Shells));
  }
  for (const ReferencePixel& pixel : pixels)
  {
    EXPECT_NEAR(pixel.Length, length, Rounding);
    EXPECT_NEAR(pixel.Rgba[3], alpha, Rounding);
    EXPECT_NEAR(pixel.Rgba[0], 0.8 * alpha, Rounding);
    EXPECT_NEAR(pixel.Rgba[1], 0.5 * alpha, Rounding);
    EXPECT_NEAR(pixel.Rgba[2], 0.1 * alpha, Rounding);
    EXPECT_NEAR(pixel.Depth, depth, Rounding);
  }
}

TEST(ReferenceImage, KnowsConstantVolumes)
{
  for (const StepOpacity model : { StepOpacity::Power, StepOpacity::Attenuation })
  {
    for (const double opacity : { 1e-8, 0.1, 0.999 })
    {
      Scene scene = MakeConstant(opacity, model, 2.5);
      scene.Aim({ -3, 2.2, 1.7 }, { 0, 2.2, 1.7 });
      ExpectConstant(scene, 8, 3);
      scene.Aim({ 9, 7, 5 }, { 0, -2, -4 }); // in the diagonal of faces x = 8 and z = 0
      ExpectConstant(scene, 4 * std::sqrt(3), std::sqrt(3));
      scene.Aim({ 3, 1, 1 }, { 3, 1, 9 }); // from inside, along an edge of the grid
      ExpectConstant(scene, 3, 0);
      scene.Aim({ 8, 6, -1 }, { 8, 6, 0 }); // along an edge of the box
      ExpectConstant(scene, 4, 1);
    }
  }
}

TEST(ReferenceImage, KnowsLimits)
{
  Scene scene = MakeConstant(0.2, StepOpacity::Power, 1);
  scene.Aim({ -3, 1.2, 1.7 }, { 0, 1.2, 1.7 });
  scene.Limits.Planes = { { 1, 0, 0, -0.5 }, { -1, 0, 0, 7.25 }, { 0, 1, 0, 0 } };
  ExpectConstant(scene, 6.75, 3.5);

  const float distance = 8.5f;
  scene.Limits.MaximumDistances = &distance;
  ExpectConstant(scene, 5, 3.5);

  // Regions below and above along x, and y: where the ray is, the first of three along y.
  scene.Limits.Cropping = true;
  const double planes[6] = { 2.5, 4.125, 1.5, 3, 1, 2 };
  std::copy_n(planes, 6, scene.Limits.CroppingPlanes);
  scene.Limits.CroppingFlags = 1u << (0 + 9) | 1u << (2 + 9);
  ExpectConstant(scene, 2 + 1.375, 3.5);
  // Planes between regions that are kept cut nothing.
  scene.Limits.CroppingFlags = 7u << 9;
  ExpectConstant(scene, 5, 3.5);
  scene.Limits.CroppingFlags = 1u << (1 + 9);
  ExpectConstant(scene, 1.625, 5.5);
  scene.Limits.CroppingFlags = 0x2000;
  EXPECT_EQ(scene.Integrate().Depth, -1);
  EXPECT_EQ(scene.Sample(1).Rgba[3], 0);

  scene.Limits = RayLimits();
  scene.Limits.Planes = { { 0, 0, 1, -1.8 } };
  EXPECT_EQ(scene.Integrate().Length, 0);
}

TEST(ReferenceImage, CutsOnlyWhereCroppingDoes)
{
  // One sample in the slab of all: where a plane between two regions cut, there would be two.
  Scene scene({ 9, 2, 2 }, [](int i, int, int) { return i; });
  scene.Optics.Function = MakeLinearFunction({ { 0, 0, 0, 0, 0 }, { 8, 1, 1, 1, 0.8 } });
  scene.Aim({ -3, 0.5, 0.5 }, { 0, 0.5, 0.5 });
  const ReferencePixel whole = scene.Sample(100);
  EXPECT_NEAR(whole.Rgba[3], 1 - std::pow(0.6, 8), Rounding);
  scene.Limits.Cropping = true;
  const double planes[6] = { 2, 6, -1, 2, -1, 2 };
  std::copy_n(planes, 6, scene.Limits.CroppingPlanes);
  scene.Limits.CroppingFlags = 7u << 12;
  EXPECT_NEAR(scene.Sample(100).Rgba[3], whole.Rgba[3], Rounding);
  scene.Limits.CroppingFlags = 5u << 12;
  EXPECT_NEAR(scene.Sample(100).Rgba[3], 1 - std::pow(0.9 * 0.3, 2), Rounding);
}

TEST(ReferenceImage, PlacesSamples)
{
  // From (1, 0, 0) along (3, 4, 0) / 5, planes across x: depths are 3/5 of distances.
  Scene scene({ 9, 9, 2 }, [](int i, int, int) { return i; });
  scene.Optics.Function = MakeLinearFunction({ { 0, 0, 0, 0, 0 }, { 8, 1, 0, 0, 0.8 } });
  scene.Grid.Width = scene.Grid.Height = 2;
  scene.Grid.Origin[0] = -2;
  scene.Grid.Origin[1] = -4;
  scene.Grid.Origin[2] = 0.5;
  scene.Grid.Direction[0] = 1;
  scene.Grid.Direction[2] = 0;
  scene.Grid.DirectionStepX[1] = 4. / 3;
  scene.Grid.DirectionStepY[2] = 0.01;
  ReferenceSlices slices;
  slices.Distance = 1.5; // depths 2, 3.5, 5, 6.5, ...; enters the box at 3, leaves at 9
  const auto sample = [&]()
  {
    return SampleReferenceRay(
      scene.GetVolume(), scene.Optics, scene.Grid, scene.Limits, slices, 1, 0);
  };
  const auto expect = [&](const std::vector<std::array<double, 2>>& samples) // x, length
  {
    double color = 0;
    double translucency = 1;
    for (const auto& [x, length] : samples)
    {
      const double step = std::pow(1 - x / 10, length);
      color += translucency * (1 - step) * x / 8;
      translucency *= step;
    }
    const ReferencePixel pixel = sample();
    EXPECT_NEAR(pixel.Rgba[0], color, Rounding);
    EXPECT_NEAR(pixel.Rgba[3], 1 - translucency, Rounding);
    EXPECT_NEAR(pixel.Depth, 5, Rounding);
  };
  expect({ { 1.25, 2.5 / 3 }, { 2.25, 2.5 }, { 3.75, 2.5 }, { 5.25, 2.5 }, { 6.5, 5. / 3 } });
  slices.CorrectOpacity = false;
  expect({ { 1.25, 0.5 }, { 2.25, 1.5 }, { 3.75, 1.5 }, { 5.25, 1.5 }, { 6.5, 1 } });
  // Shells from the box on, which is sqrt(4 + 16) away: of the ray 5 to 15 is in the box.
  slices.Shape = SliceShape::Shells;
  slices.Distance = 5;
  const double origin = std::sqrt(20.);
  for (const bool correct : { false, true })
  {
    slices.CorrectOpacity = correct;
    const auto middle = [](double from, double to) { return 0.6 * (from + to) / 2 - 2; };
    expect({ { middle(5, origin + 5), origin }, { middle(origin + 5, origin + 10), 5 },
      { middle(origin + 10, 15), 5 - origin } });
  }
}

TEST(ReferenceImage, IntegratesLinearOpacities)
{
  // The scalar is x; opacity and red go linearly with it over a length of 8.
  constexpr double L = 8;
  Scene scene({ 9, 5, 5 }, [](int i, int, int) { return i; });
  scene.Aim({ -1, 1.3, 2.6 }, { 0, 1.3, 2.6 });
  for (const double a : { 1e-9, 0.01, 0.5, 1., 700., 1e6 })
  {
    for (const double unit : { 0.25, 1., 30. })
    {
      scene.Optics.UnitDistance = unit;
      scene.Optics.Function = MakeLinearFunction({ { 0, 0, 1, 1, 0 }, { L, 1, 1, 1, a } });
      scene.Optics.Opacity = StepOpacity::Attenuation;
      const double k = a / L / unit;
      ReferencePixel pixel = scene.Integrate();
      EXPECT_NEAR(pixel.Rgba[3], -std::expm1(-k * L * L / 2), IntegralError) << a << " " << unit;
      EXPECT_NEAR(pixel.Rgba[0],
        -std::exp(-k * L * L / 2) +
          std::sqrt(std::acos(-1.) / (2 * k)) / L * std::erf(L * std::sqrt(k / 2)),
        a < 1e-6 ? 1e-6 : IntegralError) // both terms cancel
        << a << " " << unit;
      EXPECT_NEAR(pixel.Rgba[1], pixel.Rgba[3], IntegralError);
      EXPECT_NEAR(pixel.Depth, 1, Rounding);
      if (a <= 1)
      {
        scene.Optics.Opacity = StepOpacity::Power;
        const double rest = a < 1 ? (1 - a) * std::log1p(-a) : 0;
        pixel = scene.Integrate();
        EXPECT_NEAR(pixel.Rgba[3], -std::expm1(-(rest + a) * L / a / unit),
          a < 1e-6 ? 1e-8 : IntegralError) // both terms cancel
          << a << " " << unit;
        EXPECT_NEAR(pixel.Rgba[1], pixel.Rgba[3], IntegralError);
      }
    }
  }
}

TEST(ReferenceImage, IntegratesCubicScalars)
{
  // Along the diagonal of a cell x y z is the cube of the share.
  Scene scene({ 2, 2, 2 }, [](int i, int j, int k) { return i * j * k; });
  scene.Aim({ -1, -1, -1 }, { 0, 0, 0 });
  const double diagonal = std::sqrt(3);
  scene.Optics.Function = MakeLinearFunction({ { 0, 0, 0, 0, 0 }, { 1, 1, 1, 1, 0.9 } });
  scene.Optics.Opacity = StepOpacity::Attenuation;
  EXPECT_NEAR(scene.Integrate().Rgba[3], -std::expm1(-0.9 * diagonal / 4), IntegralError);

  // A step, from above too.
  const TransferFunction::Value empty{ { 0, 0, 0 }, 0 };
  const TransferFunction::Value full{ { 1, 1, 1 }, 0.9 };
  scene.Optics.Function.Nodes = { { 0.4, empty, full } };
  const double clear = std::cbrt(0.4);
  ReferencePixel pixel = scene.Integrate();
  EXPECT_NEAR(pixel.Rgba[3], -std::expm1(-0.9 * diagonal * (1 - clear)), IntegralError);
  EXPECT_NEAR(pixel.Depth, diagonal * (1 + clear), Rounding);
  scene.Optics.Function.Nodes = { { 0.4, full, empty } };
  pixel = scene.Integrate();
  EXPECT_NEAR(pixel.Rgba[3], -std::expm1(-0.9 * diagonal * clear), IntegralError);
  EXPECT_NEAR(pixel.Depth, diagonal, Rounding);
}

TEST(ReferenceImage, FindsWhatTurnsWithinACell)
{
  // x (1 - y) rises to 1/4 in the middle of a face's diagonal.
  Scene scene({ 2, 2, 2 }, [](int i, int j, int) { return i * (1 - j); });
  scene.Aim({ -1, -1, 0.5 }, { 0, 0, 0.5 });
  const TransferFunction::Value empty{ { 0, 0, 0 }, 0 };
  const TransferFunction::Value full{ { 1, 1, 1 }, 0.75 };
  for (const double depth : { 1e-1, 1e-6, 1e-12 })
  {
    scene.Optics.Function.Nodes = { { 0.25 - depth, empty, full } };
    const double length = 2 * std::sqrt(2 * depth);
    const ReferencePixel pixel = scene.Integrate();
    EXPECT_NEAR(pixel.Rgba[3], -std::expm1(std::log1p(-0.75) * length), IntegralError);
    EXPECT_NEAR(pixel.Depth, std::sqrt(2) * 1.5 - length / 2, IntegralError);
  }
  scene.Optics.Function.Nodes = { { 0.26, empty, full } };
  EXPECT_EQ(scene.Integrate().Depth, -1);
}

TEST(ReferenceImage, EndsWhereOpacityIsOne)
{
  Scene scene({ 9, 2, 2 }, [](int i, int, int) { return i; });
  const TransferFunction::Value thin{ { 0, 1, 0 }, 0.1 };
  const TransferFunction::Value wall{ { 1, 0, 0.5 }, 1 };
  scene.Optics.Function.Nodes = { { 3, thin, wall }, { 5, wall, thin } };
  scene.Aim({ -1, 0.4, 0.3 }, { 0, 0.4, 0.3 });
  const double rest = std::pow(0.9, 3);
  for (const ReferencePixel& pixel : { scene.Integrate(), scene.Sample(0.5) })
  {
    EXPECT_EQ(pixel.Rgba[3], 1);
    EXPECT_NEAR(pixel.Rgba[0], rest, Rounding);
    EXPECT_NEAR(pixel.Rgba[1], 1 - rest, Rounding);
    EXPECT_NEAR(pixel.Rgba[2], rest / 2, Rounding);
    EXPECT_NEAR(pixel.Depth, 1, Rounding);
  }
  // Attenuation has no such opacity.
  scene.Optics.Opacity = StepOpacity::Attenuation;
  EXPECT_NEAR(scene.Integrate().Rgba[3], -std::expm1(-0.6 - 2), IntegralError);
}

TEST(ReferenceImage, LeavesOutCellsWithoutScalar)
{
  Scene scene({ 9, 3, 3 }, [](int, int, int) { return 1; });
  scene.Optics.Function = MakeConstantFunction(0.3, { 1, 1, 1 });
  scene.Values[4 + 9 * (1 + 3)] = std::numeric_limits<float>::quiet_NaN();
  scene.Aim({ -1, 0.4, 0.3 }, { 0, 0.4, 0.3 });
  EXPECT_NEAR(scene.Integrate().Rgba[3], 1 - std::pow(0.7, 6), IntegralError);
  EXPECT_NEAR(scene.Sample(0.5).Rgba[3], 1 - std::pow(0.7, 6), Rounding);
  scene.Values.assign(scene.Values.size(), std::numeric_limits<float>::infinity());
  EXPECT_EQ(scene.Integrate().Depth, -1);
  EXPECT_EQ(scene.Sample(0.5).Depth, -1);
}

/// A random volume before a perspective camera that is oblique to it.
Scene MakeRandomScene()
{
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> unit(0, 1);
  Scene scene({ 9, 7, 5 }, [&](int, int, int) { return unit(generator); });
  scene.Grid = MakePerspectiveGrid({ 17, 12, 11 }, { 4, 3, 2 }, { 0.1, 1, 0.2 }, 30, 12, 10);
  const double worldFromMesh[3][4] = { { 0.9, 0.1, 0, 0.2 }, { -0.1, 0.8, 0.3, 0.4 },
    { 0.1, -0.2, 1.4, -0.3 } };
  PlaceMesh(scene.Grid, worldFromMesh);
  scene.Optics.UnitDistance = 3;
  return scene;
}

/// Differences of channels between samples and integral.
struct SamplingError
{
  double Largest = 0;
  double Mean = 0;
};

SamplingError FindSamplingError(const Scene& scene, const ReferenceSlices& slices)
{
  const auto exact =
    IntegrateReferenceImage(scene.GetVolume(), scene.Optics, scene.Grid, scene.Limits);
  const auto samples =
    SampleReferenceImage(scene.GetVolume(), scene.Optics, scene.Grid, scene.Limits, slices);
  SamplingError error;
  for (std::size_t p = 0; p < exact.size(); ++p)
  {
    EXPECT_NEAR(samples[p].Length, exact[p].Length, Rounding);
    for (int c = 0; c < 4; ++c)
    {
      const double difference = std::abs(samples[p].Rgba[c] - exact[p].Rgba[c]);
      error.Largest = std::max(error.Largest, difference);
      error.Mean += difference / (4. * exact.size());
    }
  }
  return error;
}

TEST(ReferenceImage, SamplesComeToTheIntegral)
{
  Scene scene = MakeRandomScene();
  for (const StepOpacity model : { StepOpacity::Power, StepOpacity::Attenuation })
  {
    for (const SliceShape shape : { SliceShape::Planes, SliceShape::Shells })
    {
      for (const bool steps : { false, true })
      {
        SCOPED_TRACE(testing::Message()
          << static_cast<int>(model) << static_cast<int>(shape) << (steps ? " with steps" : ""));
        scene.Optics.Opacity = model;
        scene.Optics.Function = MakeLinearFunction(
          { { 0.1, 0, 0, 1, 0 }, { 0.4, 1, 0.5, 0.2, 0.5 }, { 0.8, 0, 1, 0, 0.9 } });
        if (steps)
        {
          scene.Optics.Function.Nodes[1].Right.Attenuation = 0.1;
          scene.Optics.Function.Nodes[2].Left.Color[0] = 1;
        }
        ReferenceSlices slices;
        slices.Shape = shape;
        std::vector<SamplingError> errors;
        for (const double distance : { 0.16, 0.04, 0.01 })
        {
          slices.Distance = distance;
          errors.push_back(FindSamplingError(scene, slices));
        }
        // A fourth of the distance: a sixteenth of the error, or of that at steps a fourth.
        for (int k = 0; k < 2; ++k)
        {
          EXPECT_LT(errors[k + 1].Mean, errors[k].Mean * (steps ? 0.3 : 0.08));
        }
        // A slab where a ray meets a step is no more than about as opaque as that.
        EXPECT_LT(errors[2].Largest, steps ? 4e-3 : 2e-5);
      }
    }
  }
}

TEST(ReferenceImage, DoubtsWhatRoundingDecides)
{
  Scene scene({ 9, 2, 2 }, [](int i, int, int) { return i; });
  scene.Aim({ -1, 0.5, 0.5 }, { 0, 0.5, 0.5 });
  const TransferFunction::Value thin{ { 1, 1, 1 }, 0.1 };
  const TransferFunction::Value thick{ { 1, 1, 1 }, 0.4 };
  ReferenceSlices slices;
  const auto sample = [&]()
  {
    return SampleReferenceRay(
      scene.GetVolume(), scene.Optics, scene.Grid, scene.Limits, slices, 0, 0);
  };
  scene.Optics.Function.Nodes = { { 2.5, thin, thick } }; // where the third sample is
  EXPECT_EQ(sample().Doubt, 0);
  slices.Rounding = { 1e-6, 1e-6, 1e-6 };
  EXPECT_NEAR(sample().Doubt, 0.3 * 0.9 * 0.9, 1e-4);
  scene.Optics.Function.Nodes = { { 2.6, thin, thick } };
  EXPECT_LT(sample().Doubt, 1e-4);
  // An opaque sample of no length, where the part ends with a slab, or just behind it.
  scene.Optics.Function.Nodes = { { 7.9, thin, { { 1, 1, 1 }, 1 } } };
  EXPECT_GT(sample().Doubt, 0.4);
  EXPECT_LT(sample().Rgba[3], 0.6);
  slices.Distance = 8 - 1e-8;
  EXPECT_GT(sample().Doubt, 0.4);
  EXPECT_EQ(sample().Rgba[3], 1);
  // Empty cells beside a sample.
  slices.Distance = 1.5;
  scene.Optics.Function = MakeConstantFunction(0.4, { 1, 1, 1 });
  EXPECT_LT(sample().Doubt, 1e-4);
  scene.Values[7] = std::numeric_limits<float>::quiet_NaN();
  slices.Distance = 2; // samples at 1, 3, 5 and 7
  scene.Values[8] = scene.Values[7];
  EXPECT_LT(sample().Doubt, 1e-4);
  scene.Aim({ 9, 0.5, 0.5 }, { 8, 0.5, 0.5 });
  slices.Distance = 4; // at 6 and 2
  EXPECT_GT(sample().Doubt, 0.4);
}

TEST(ReferenceImage, ReadsAllTypes)
{
  const std::int8_t int8[8] = { -128, -128, -128, -128, -128, -128, -128, -128 };
  const std::uint8_t uint8[8] = { 255, 255, 255, 255, 255, 255, 255, 255 };
  const std::int16_t int16[8] = { -32768, -32768, -32768, -32768, -32768, -32768, -32768, -32768 };
  const std::uint16_t uint16[8] = { 65535, 65535, 65535, 65535, 65535, 65535, 65535, 65535 };
  const struct
  {
    ImageScalar Type;
    const void* Values;
    double Value;
  } all[] = { { ImageScalar::Int8, int8, -128 }, { ImageScalar::UInt8, uint8, 255 },
    { ImageScalar::Int16, int16, -32768 }, { ImageScalar::UInt16, uint16, 65535 } };
  Scene scene({ 2, 2, 2 }, [](int, int, int) { return 0; });
  scene.Aim({ -1, 0.5, 0.5 }, { 0, 0.5, 0.5 });
  for (const auto& of : all)
  {
    ImageVolume volume = scene.GetVolume();
    volume.Type = of.Type;
    volume.Values = of.Values;
    volume.Scale = 0.5 / of.Value;
    volume.Offset = 0.25;
    scene.Optics.Function = MakeLinearFunction({ { 0, 0, 0, 0, 0 }, { 1, 1, 1, 1, 1 } });
    const ReferencePixel pixel =
      IntegrateReferenceRay(volume, scene.Optics, scene.Grid, scene.Limits, 0, 0);
    EXPECT_NEAR(pixel.Rgba[3], 0.75, Rounding);
  }
}

TEST(ReferenceImage, RefusesBadInput)
{
  Scene scene = MakeConstant(0.2, StepOpacity::Power, 1);
  scene.Aim({ -3, 2.2, 1.7 }, { 0, 2.2, 1.7 });
  EXPECT_THROW(scene.Sample(0), std::invalid_argument);
  scene.Optics.UnitDistance = 0;
  EXPECT_THROW(scene.Integrate(), std::invalid_argument);
  scene.Optics.UnitDistance = 1;
  scene.Optics.Function.Nodes.clear();
  EXPECT_THROW(scene.Integrate(), std::invalid_argument);
  scene = MakeConstant(0.2, StepOpacity::Power, 1);
  scene.Dimensions[1] = 1;
  EXPECT_THROW(scene.Integrate(), std::invalid_argument);
}

} // namespace
