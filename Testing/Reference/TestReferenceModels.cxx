// SPDX-License-Identifier: BSD-3-Clause
// Tests of the oracle's optical models other than emission and absorption, against closed
// forms. In a box with a linear field the whole picture has one, whatever the mesh inside:
// surfaces of constant scalar are planes, and the largest scalar is at one end of the ray's
// way through the box.
#include "ReferenceIntegral.h"
#include "ReferenceRenderer.h"
#include "ReferenceScenes.h"
#include "ReferenceShading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace
{

using namespace tetralux;
using Vector = std::array<double, 3>;

double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector Normalize(const Vector& v)
{
  const double length = std::sqrt(Dot(v, v));
  return { v[0] / length, v[1] / length, v[2] / length };
}

//------------------------------------------------------------------------------------------------
// Integrals over one segment
//------------------------------------------------------------------------------------------------

/// The integral of tau c over the scalar from far below to s.
long double EmissionUpTo(const TransferFunction& function, long double s, int channel)
{
  constexpr double FarBelow = -10;
  const auto& nodes = function.Nodes;
  long double sum = 0;
  for (std::size_t k = 0; k <= nodes.size(); ++k)
  {
    const bool first = k == 0;
    const bool last = k == nodes.size();
    const long double low = first ? FarBelow : nodes[k - 1].Scalar;
    const long double high = last ? s : std::min<long double>(s, nodes[k].Scalar);
    if (high <= low)
    {
      break;
    }
    const auto& begin = first ? nodes.front().Left : nodes[k - 1].Right;
    const auto& end = first ? nodes.front().Left : last ? nodes.back().Right : nodes[k].Left;
    const long double width = first || last ? 1 : nodes[k].Scalar - low;
    const long double x = high - low;
    const long double a = begin.Attenuation;
    const long double c = begin.Color[channel];
    const long double da = first || last ? 0 : (end.Attenuation - a) / width;
    const long double dc = first || last ? 0 : (end.Color[channel] - c) / width;
    sum += x * (a * c + x * ((a * dc + c * da) / 2 + x * da * dc / 3));
  }
  return sum;
}

TEST(ReferenceModels, EmissionIsTheDifferenceOfItsAntiderivative)
{
  const TransferFunction function = MakeFunctionWithSteps();
  std::mt19937_64 generator(41);
  std::uniform_real_distribution<double> scalar(-0.5, 1.5);
  for (int trial = 0; trial < 1000; ++trial)
  {
    const double s0 = scalar(generator);
    const double s1 = scalar(generator);
    const double length = std::pow(10, 3 * scalar(generator));
    const ReferenceSegment segment =
      IntegrateReference(function, s0, s1, length, OpticalModel::EmissionOnly);
    EXPECT_EQ(segment.Alpha, 0);
    for (int channel = 0; channel < 3; ++channel)
    {
      const long double expected = length *
        (EmissionUpTo(function, s1, channel) - EmissionUpTo(function, s0, channel)) /
        (static_cast<long double>(s1) - s0);
      EXPECT_NEAR(segment.Color[channel], static_cast<double>(expected), 1e-13 * length);
    }
  }
  const ReferenceSegment constant =
    IntegrateReference(function, 0.7, 0.7, 3, OpticalModel::EmissionOnly);
  EXPECT_NEAR(constant.Color[1], 3 * 4.5 * 0.8, 1e-14);
  EXPECT_NEAR(constant.OpticalDepth, 3 * 4.5, 1e-14);
}

TEST(ReferenceModels, AbsorptionHasTheOpacityOfBoth)
{
  const TransferFunction function = MakeFunctionWithSteps();
  for (const double length : { 1e-9, 0.3, 20.0 })
  {
    const ReferenceSegment both = IntegrateReference(function, -0.2, 1.3, length);
    const ReferenceSegment alone =
      IntegrateReference(function, -0.2, 1.3, length, OpticalModel::AbsorptionOnly);
    EXPECT_EQ(alone.Alpha, both.Alpha);
    EXPECT_GT(alone.Alpha, 0);
    EXPECT_EQ(alone.Color[0] + alone.Color[1] + alone.Color[2], 0);
    EXPECT_EQ(alone.FirstContribution, both.FirstContribution);
  }
}

TEST(ReferenceModels, EvaluatesWithStepsToTheRight)
{
  const TransferFunction function = MakeFunctionWithSteps();
  EXPECT_EQ(EvaluateReference(function, -1).Attenuation, 0.5);
  EXPECT_EQ(EvaluateReference(function, 0).Attenuation, 0);
  EXPECT_EQ(EvaluateReference(function, 0.4).Attenuation, 7);
  EXPECT_NEAR(EvaluateReference(function, 0.7).Attenuation, 4.5, 1e-15);
  EXPECT_EQ(EvaluateReference(function, 1).Attenuation, 11);
  EXPECT_EQ(EvaluateReference(function, 5).Color[2], 0.2);
}

TEST(ReferenceModels, RefusesWhatIsNoIntegral)
{
  const TransferFunction function = MakeFunctionWithSteps();
  EXPECT_THROW(
    IntegrateReference(function, 0, 1, 1, OpticalModel::MaximumIntensity), std::invalid_argument);
  EXPECT_THROW(
    IntegrateReference(function, 0, 1, 1, OpticalModel::Isosurfaces), std::invalid_argument);
}

//------------------------------------------------------------------------------------------------
// Lit colours
//------------------------------------------------------------------------------------------------

constexpr float Orange[3] = { 0.8f, 0.5f, 0.1f };
constexpr Material Glossy = { 0.25f, 0.5f, 0.375f, 6.f };

Light MakeDistantLight(const Vector& direction)
{
  return { { direction[0], direction[1], direction[2] }, false, { 1, 1, 1 }, { 0.5f, 1, 0.25f },
    { 1, 0.5f, 0.25f } };
}

Light MakePositionalLight(const Vector& position)
{
  Light light = MakeDistantLight(position);
  light.Positional = true;
  return light;
}

TEST(ReferenceShading, LightAtTheViewerFollowsThePowersOfTheCosine)
{
  const Vector view = Normalize({ 1, 2, 2 });
  for (const double cosine : { 1.0, 0.6, 0.1, 0.0, -0.6 })
  {
    // A normal at that angle to the view, of any length; which side it is on does not matter.
    const Vector across = Normalize({ 2, -1, 0 });
    const double sine = std::sqrt(1 - cosine * cosine);
    Vector normal;
    for (int axis = 0; axis < 3; ++axis)
    {
      normal[axis] = 1e-200 * (cosine * view[axis] + sine * across[axis]);
    }
    const auto color =
      ShadeReference(Orange, Glossy, { MakeDistantLight(view) }, { 7, 8, 9 }, normal, view);
    const double facing = std::abs(cosine);
    const double highlight = facing == 0 ? 0 : 0.375 * std::pow(facing, 6);
    EXPECT_NEAR(color[0], 0.8f * (0.25 + 0.5 * 0.5 * facing) + highlight, 1e-14);
    EXPECT_NEAR(color[1], 0.5f * (0.25 + 0.5 * 1.0 * facing) + 0.5 * highlight, 1e-14);
    EXPECT_NEAR(color[2], 0.1f * (0.25 + 0.5 * 0.25 * facing) + 0.25 * highlight, 1e-14);
  }
}

TEST(ReferenceShading, LightAtAnAngle)
{
  // Normal along z, view and light on different sides of it: all cosines by hand.
  const Vector view = Normalize({ 3, 0, 4 });
  const Vector light = Normalize({ 0, 4, 3 });
  const Vector half = Normalize({ 0.6, 0.8, 1.4 });
  const auto color =
    ShadeReference(Orange, Glossy, { MakeDistantLight(light) }, { 0, 0, 0 }, { 0, 0, -5 }, view);
  const double highlight = 0.375 * std::pow(half[2], 6);
  EXPECT_NEAR(color[1], 0.5f * (0.25 + 0.5 * 0.6) + 0.5 * highlight, 1e-14);
}

TEST(ReferenceShading, LightBehindTheSurfaceAddsItsAmbientPartOnly)
{
  const auto color = ShadeReference(
    Orange, Glossy, { MakeDistantLight({ 0, 0.6, -0.8 }) }, { 0, 0, 0 }, { 0, 0, 1 }, { 0, 0, 1 });
  EXPECT_NEAR(color[0], 0.25 * 0.8f, 1e-15);
}

TEST(ReferenceShading, LightsAddUpToOne)
{
  const Light light = MakeDistantLight({ 0, 0, 1 });
  const auto once = ShadeReference(Orange, Glossy, { light }, {}, { 0, 0, 1 }, { 0, 0, 1 });
  const auto twice = ShadeReference(Orange, Glossy, { light, light }, {}, { 0, 0, 1 }, { 0, 0, 1 });
  EXPECT_NEAR(twice[2], 2 * once[2], 1e-15);
  EXPECT_GT(2 * once[0], 1);
  EXPECT_EQ(twice[0], 1);
  EXPECT_EQ(ShadeReference(Orange, Glossy, {}, {}, { 0, 0, 1 }, { 0, 0, 1 }), (Vector{ 0, 0, 0 }));
}

TEST(ReferenceShading, WithoutANormalFacesTheViewer)
{
  const Vector view{ 0.6, 0, 0.8 };
  const Light light = MakeDistantLight({ 0, 0, 1 });
  EXPECT_EQ(ShadeReference(Orange, Glossy, { light }, {}, { 0, 0, 0 }, view),
    ShadeReference(Orange, Glossy, { light }, {}, view, view));
}

TEST(ReferenceShading, PositionalLightsFadeWithDistanceAndInTheirCone)
{
  Light light = MakePositionalLight({ 1, 1, 5 });
  light.Attenuation[0] = 1;
  light.Attenuation[1] = 0.5;
  light.Attenuation[2] = 0.25;
  const Vector point{ 1, 1, 3 };
  const Vector up{ 0, 0, 1 };
  const auto lit = [&] { return ShadeReference(Orange, Glossy, { light }, point, up, up)[1]; };
  const double ambient = 0.25 * 0.5f;
  const double full = 0.5f * 0.5 + 0.5 * 0.375;
  EXPECT_NEAR(lit(), ambient + full / 3, 1e-14);

  // A spot whose axis misses the point by 36.87 degrees.
  light.Axis[0] = 0.6;
  light.Axis[2] = -0.8;
  light.Exponent = 2;
  light.ConeCosine = 0.75;
  EXPECT_NEAR(lit(), ambient + full / 3 * 0.64, 1e-14);
  light.ConeCosine = 0.85;
  EXPECT_NEAR(lit(), ambient, 1e-14);
  light.ConeCosine = -1;
  EXPECT_NEAR(lit(), ambient + full / 3, 1e-14);
}

//------------------------------------------------------------------------------------------------
// Pictures
//------------------------------------------------------------------------------------------------

/// A box with the scalar Gradient * p + Constant.
struct LinearBox
{
  Vector Gradient{ 0.4, -0.7, 0.6 };
  double Constant = 0.3;
  Vector Upper{ 1, 1.2, 0.9 };
  TetrahedralMesh Mesh;
  std::vector<double> Scalars;

  explicit LinearBox(double jitter = 0.15)
    : Mesh(MakeBox(7, 6, 5, { 0, 0, 0 }, { 1, 1.2, 0.9 }, jitter, 3))
  {
    this->FillScalars();
  }
  void FillScalars()
  {
    this->Scalars.clear();
    for (std::size_t i = 0; i < this->Mesh.Points.size(); i += 3)
    {
      const double* p = this->Mesh.Points.data() + i;
      this->Scalars.push_back(Dot(this->Gradient, { p[0], p[1], p[2] }) + this->Constant);
    }
  }
  ReferenceMesh View() const
  {
    return { this->Mesh.Points, this->Mesh.Cells, this->Scalars, false };
  }
};

/// The way of a ray through a box, and the scalar along it.
struct Way
{
  Vector Origin;
  Vector Direction; ///< of length 1
  double Begin = -std::numeric_limits<double>::infinity();
  double End = std::numeric_limits<double>::infinity();
  double BeginScalar = 0;
  double EndScalar = 0;

  Way(const LinearBox& box, const RayGrid& grid, int i, int j)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Origin[axis] =
        grid.Origin[axis] + i * grid.OriginStepX[axis] + j * grid.OriginStepY[axis];
      this->Direction[axis] =
        grid.Direction[axis] + i * grid.DirectionStepX[axis] + j * grid.DirectionStepY[axis];
    }
    this->Direction = Normalize(this->Direction);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double a = -this->Origin[axis] / this->Direction[axis];
      const double b = (box.Upper[axis] - this->Origin[axis]) / this->Direction[axis];
      this->Begin = std::max(this->Begin, std::min(a, b));
      this->End = std::min(this->End, std::max(a, b));
    }
    const double slope = Dot(box.Gradient, this->Direction);
    const double start = Dot(box.Gradient, this->Origin) + box.Constant;
    this->BeginScalar = start + slope * this->Begin;
    this->EndScalar = start + slope * this->End;
  }
  bool IsEmpty() const { return !(this->Begin < this->End); }
};

/// Compares each pixel of a few views with expected(way, rgba, depth), which is asked only where
/// the ray meets the box and starts from an empty pixel.
template <class Expected>
void ExpectPictures(const ReferenceOptics& optics, const Expected& expected)
{
  const LinearBox box;
  const Vector center{ 0.5, 0.6, 0.45 };
  const RayGrid grids[] = { MakePerspectiveGrid(
                              { 2.1, 1.7, 2.9 }, center, { 0, 1, 0.1 }, 30, 37, 29),
    MakePerspectiveGrid({ -1.3, 0.2, -2.5 }, center, { 0, 1, 0.1 }, 30, 37, 29),
    MakeParallelGrid({ 1.9, -2.3, 0.7 }, center, { 0, 1, 0.1 }, 0.8, 37, 29) };
  for (const RayGrid& grid : grids)
  {
    const ReferenceImage image = RenderReference(box.View(), optics, grid);
    int covered = 0;
    for (int pixel = 0; pixel < 37 * 29; ++pixel)
    {
      const Way way(box, grid, pixel % 37, pixel / 37);
      double rgba[4] = { 0, 0, 0, 0 };
      double depth = -1;
      if (!way.IsEmpty())
      {
        ++covered;
        expected(way, rgba, depth);
      }
      for (int channel = 0; channel < 4; ++channel)
      {
        EXPECT_NEAR(image.Rgba[4 * pixel + channel], rgba[channel], 1e-13);
      }
      EXPECT_NEAR(image.Depth[pixel], depth, 1e-12);
    }
    EXPECT_GT(covered, 150);
  }
}

/// From transparent over a peak to half opaque; largest scalar of the box: 1.24.
const TransferFunction Peak = MakeLinearFunction({ { -0.5, 0.1, 0.9, 0.4, 0 }, { 0.1, 1, 0, 0, 0 },
  { 0.3, 0, 0.5, 1, 4 }, { 0.9, 1, 1, 0, 0.1 }, { 2, 0, 0, 1, 0.7 } });

TEST(ReferenceModels, PicturesOfEmissionAndOfAbsorption)
{
  for (const OpticalModel model : { OpticalModel::EmissionOnly, OpticalModel::AbsorptionOnly })
  {
    ExpectPictures({ Peak, model },
      [model](const Way& way, double rgba[4], double& depth)
      {
        const ReferenceSegment segment =
          IntegrateReference(Peak, way.BeginScalar, way.EndScalar, way.End - way.Begin, model);
        std::copy(segment.Color, segment.Color + 3, rgba);
        rgba[3] = segment.Alpha;
        if (segment.FirstContribution >= 0)
        {
          depth = way.Begin + segment.FirstContribution * (way.End - way.Begin);
        }
      });
  }
}

TEST(ReferenceModels, PicturesOfTheLargestScalar)
{
  ExpectPictures({ Peak, OpticalModel::MaximumIntensity },
    [](const Way& way, double rgba[4], double& depth)
    {
      const bool atBegin = way.BeginScalar > way.EndScalar;
      const auto value = EvaluateReference(Peak, atBegin ? way.BeginScalar : way.EndScalar);
      rgba[3] = std::min(1.0, value.Attenuation);
      for (int channel = 0; channel < 3; ++channel)
      {
        rgba[channel] = rgba[3] * value.Color[channel];
      }
      if (rgba[3] > 0)
      {
        depth = atBegin ? way.Begin : way.End;
      }
    });
}

ReferenceOptics MakePlanes()
{
  ReferenceOptics optics;
  optics.Model = OpticalModel::Isosurfaces;
  optics.Isosurfaces = { { -0.2, { 1, 0, 0 }, 0.5f }, { 0.1, { 0, 1, 0 }, 0.f },
    { 0.35, { 0, 0, 1 }, 0.25f }, { 0.351, { 1, 1, 0 }, 0.75f }, { 0.8, { 1, 0, 1 }, 1.f } };
  return optics;
}

/// Calls visit(surface, t) for each plane that the ray meets, front to back.
template <class Visit>
void ForEachPlane(const ReferenceOptics& optics, const Way& way, const Visit& visit)
{
  auto surfaces = optics.Isosurfaces;
  if (way.EndScalar < way.BeginScalar)
  {
    std::reverse(surfaces.begin(), surfaces.end());
  }
  for (const Isosurface& surface : surfaces)
  {
    const double share = (surface.Value - way.BeginScalar) / (way.EndScalar - way.BeginScalar);
    if (share > 0 && share < 1)
    {
      visit(surface, way.Begin + share * (way.End - way.Begin));
    }
  }
}

void Composite(const Vector& color, double opacity, double rgba[4])
{
  for (int channel = 0; channel < 3; ++channel)
  {
    rgba[channel] += (1 - rgba[3]) * opacity * color[channel];
  }
  rgba[3] += (1 - rgba[3]) * opacity;
}

TEST(ReferenceModels, PicturesOfFlatSurfaces)
{
  const ReferenceOptics optics = MakePlanes();
  int met[6] = { 0, 0, 0, 0, 0, 0 };
  ExpectPictures(optics,
    [&](const Way& way, double rgba[4], double& depth)
    {
      int count = 0;
      ForEachPlane(optics, way,
        [&](const Isosurface& surface, double t)
        {
          const float* c = surface.Color;
          Composite({ c[0], c[1], c[2] }, surface.Opacity, rgba);
          depth = depth == -1 && surface.Opacity > 0 ? t : depth;
          ++count;
        });
      ++met[count];
    });
  // Rays that meet none and some of them.
  EXPECT_GT(met[0], 10);
  EXPECT_GT(met[2] + met[3], 100);
}

/// Halving ends where both halves agree with the whole to 1e-10, some of it on each side of a jump.
constexpr double LitTolerance = 1e-8;

/// Light that scales colours by factor(share), and adds nothing.
std::function<ReferenceLight(double)> ScaleBy(const std::function<double(double)>& factor)
{
  return [factor](double share)
  {
    ReferenceLight light;
    light.Scale = { factor(share), factor(share), factor(share) };
    return light;
  };
}

// In an even medium what reaches the eye has a density exp(-depth share) along the segment.
TEST(ReferenceModels, LitSegmentsHaveClosedForms)
{
  const TransferFunction function = MakeConstantFunction(2, { 1, 0.5, 0.25 });
  for (const double length : { 1e-3, 0.5, 4., 60. })
  {
    const double depth = 2 * length;
    const auto until = [depth](double share) { return -std::expm1(-depth * share); };
    const auto expect = [&](const std::function<double(double)>& factor, double expected)
    {
      const ReferenceSegment segment =
        IntegrateLitReference(function, 0.3, 0.7, length, ScaleBy(factor));
      EXPECT_NEAR(segment.Color[0], expected, LitTolerance);
      EXPECT_NEAR(segment.Color[1], 0.5 * expected, LitTolerance);
      EXPECT_NEAR(segment.Alpha, until(1), 1e-12);
    };
    expect([](double) { return 1; }, until(1));
    expect([](double share) { return share; }, until(1) / depth - std::exp(-depth));
    // Jumps, next to the ends as well.
    for (const double jump : { 0.001, 0.31415, 0.9995 })
    {
      expect([jump](double share) { return share < jump ? 0.2 : 0.9; },
        0.2 * until(jump) + 0.9 * (until(1) - until(jump)));
    }
  }
}

// A spike of light that no point of a quadrature would meet.
TEST(ReferenceModels, LitSegmentsAreSplitWhereLightIsSharpest)
{
  const TransferFunction function = MakeConstantFunction(1, { 1, 1, 1 });
  constexpr double Place = 0.45;
  constexpr double Width = 1e-5;
  const auto light = ScaleBy(
    [](double share) { return 1 / (1 + (share - Place) * (share - Place) / (Width * Width)); });
  const ReferenceSegment segment = IntegrateLitReference(function, 0, 1, 1e-3, light, Place);
  EXPECT_NEAR(segment.Color[0], 1e-3 * Width * std::acos(-1.), 1e-10);
}

TEST(ReferenceModels, PicturesOfShadedSurfaces)
{
  ReferenceOptics optics = MakePlanes();
  optics.Shaded = true;
  optics.Surface = Glossy;
  optics.Lights = { MakeDistantLight(Normalize({ 1, 2, 3 })), MakePositionalLight({ 3, -2, 1 }) };
  const LinearBox box;
  ExpectPictures(optics,
    [&](const Way& way, double rgba[4], double& depth)
    {
      ForEachPlane(optics, way,
        [&](const Isosurface& surface, double t)
        {
          Vector point;
          Vector view;
          for (int axis = 0; axis < 3; ++axis)
          {
            view[axis] = -way.Direction[axis];
            point[axis] = way.Origin[axis] - t * view[axis];
          }
          Composite(
            ShadeReference(surface.Color, optics.Surface, optics.Lights, point, box.Gradient, view),
            surface.Opacity, rgba);
          depth = depth == -1 && surface.Opacity > 0 ? t : depth;
        });
    });
}

TEST(ReferenceModels, ShadesInTheWorld)
{
  // A matrix with scaling, shear and a mirror, applied by the renderer or to the points beforehand.
  const double matrix[3][4] = { { 2, 0.7, -0.3, 5 }, { 0.2, -0.5, 1.1, -3 },
    { -0.4, 0.6, 0.8, 1 } };
  const LinearBox box;
  LinearBox moved = box;
  for (std::size_t i = 0; i < moved.Mesh.Points.size(); i += 3)
  {
    const double* p = box.Mesh.Points.data() + i;
    for (int row = 0; row < 3; ++row)
    {
      moved.Mesh.Points[i + row] =
        matrix[row][0] * p[0] + matrix[row][1] * p[1] + matrix[row][2] * p[2] + matrix[row][3];
    }
  }
  ReferenceOptics optics = MakePlanes();
  optics.Shaded = true;
  optics.Surface = Glossy;
  optics.Lights = { MakePositionalLight({ 9, 1, 7 }) };
  RayGrid grid = MakePerspectiveGrid({ 9, 1, 6 }, { 6.2, -2.6, 1.5 }, { 0, 0, 1 }, 25, 41, 33);
  const ReferenceImage expected = RenderReference(moved.View(), optics, grid);
  PlaceMesh(grid, matrix);
  const ReferenceImage image = RenderReference(box.View(), optics, grid);
  for (std::size_t k = 0; k < image.Rgba.size(); ++k)
  {
    EXPECT_NEAR(image.Rgba[k], expected.Rgba[k], 1e-12);
  }
  EXPECT_GT(*std::max_element(image.Rgba.begin(), image.Rgba.end()), 0.5);
}

TEST(ReferenceModels, LimitsHoldForEveryModel)
{
  // Along z through a box whose scalar is z: what the plane keeps is z of 0.5 and less.
  LinearBox box;
  box.Gradient = { 0, 0, 1 };
  box.Constant = 0;
  box.FillScalars();
  const RayGrid grid = MakeParallelGrid({ 0.5, 0.6, 3 }, { 0.5, 0.6, 0 }, { 0, 1, 0 }, 0.1, 3, 3);
  RayLimits limits;
  limits.Planes.push_back({ 0, 0, -1, 0.5 });
  const TransferFunction ramp = MakeLinearFunction({ { 0, 0, 1, 0, 0 }, { 1, 1, 1, 0, 1 } });

  const ReferenceImage largest =
    RenderReference(box.View(), { ramp, OpticalModel::MaximumIntensity }, grid, limits);
  EXPECT_NEAR(largest.Rgba[3], 0.5, 1e-14);
  EXPECT_NEAR(largest.Rgba[0], 0.25, 1e-14);
  EXPECT_NEAR(largest.Depth[0], 2.5, 1e-14);

  const ReferenceImage emission =
    RenderReference(box.View(), { ramp, OpticalModel::EmissionOnly }, grid, limits);
  EXPECT_NEAR(emission.Rgba[0], 0.125 / 3, 1e-14);
  EXPECT_NEAR(emission.Rgba[1], 0.125, 1e-14);
  EXPECT_EQ(emission.Rgba[3], 0);
  EXPECT_NEAR(emission.Depth[0], 2.5, 1e-14);

  ReferenceOptics optics;
  optics.Model = OpticalModel::Isosurfaces;
  optics.Isosurfaces = { { 0.2, { 1, 0, 0 }, 0.5f }, { 0.7, { 0, 1, 0 }, 1.f } };
  const ReferenceImage surfaces = RenderReference(box.View(), optics, grid, limits);
  EXPECT_NEAR(surfaces.Rgba[0], 0.5, 1e-14);
  EXPECT_NEAR(surfaces.Rgba[1], 0, 1e-14);
  EXPECT_NEAR(surfaces.Depth[0], 2.8, 1e-14);
}

TEST(ReferenceModels, SurfacesInFacesOfTheMeshAreMetOnce)
{
  // The scalar is the distance of a layer of points from the middle one, or less than that.
  for (const double sign : { 1.0, -1.0 })
  {
    const TetrahedralMesh mesh = MakeBox(2, 2, 4, { 0, 0, 0 }, { 1, 1, 4 });
    std::vector<double> rising;
    std::vector<double> ridge;
    for (std::size_t i = 2; i < mesh.Points.size(); i += 3)
    {
      rising.push_back(sign * mesh.Points[i]);
      ridge.push_back(sign * std::abs(mesh.Points[i] - 2));
    }
    ReferenceOptics optics;
    optics.Model = OpticalModel::Isosurfaces;
    optics.Isosurfaces = { { 0, { 1, 0, 0 }, 0.5f } };
    // Off the diagonals, where rays would run along edges as far as rounding lets them.
    const RayGrid grid =
      MakeParallelGrid({ 0.51, 0.52, 9 }, { 0.51, 0.52, 0 }, { 0, 1, 0 }, 0.45, 8, 8);
    const auto getOpacity = [&](const std::vector<double>& scalars, double value)
    {
      optics.Isosurfaces[0].Value = value;
      const ReferenceImage image =
        RenderReference({ mesh.Points, mesh.Cells, scalars, false }, optics, grid);
      for (std::size_t pixel = 1; pixel < image.Depth.size(); ++pixel)
      {
        EXPECT_EQ(image.Rgba[4 * pixel + 3], image.Rgba[3]);
      }
      return image.Rgba[3];
    };
    EXPECT_EQ(getOpacity(rising, sign * 2), 0.5);
    // At the ends of the mesh it is met where the other end of the cell is below.
    EXPECT_EQ(getOpacity(rising, 0), sign > 0 ? 0 : 0.5);
    EXPECT_EQ(getOpacity(rising, sign * 4), sign > 0 ? 0.5 : 0);
    // Touched from above it is not met, from below by both cells.
    EXPECT_EQ(getOpacity(ridge, 0), sign > 0 ? 0 : 0.75);
  }
}

TEST(ReferenceModels, SurfacesOfOverlappingCellsAreMetCellByCell)
{
  // Two nested tetrahedra, z up to 1 and 1.9: at the axis their surfaces alternate.
  const std::vector<double> points{ -1, -1, 0, 1, -1, 0, 0, 1, 0, 0, 0, 1, //
    -2, -2, -0.1, 2, -2, -0.1, 0, 2, -0.1, 0, 0, 1.9 };
  const std::vector<std::int32_t> cells{ 0, 1, 2, 3, 4, 5, 6, 7 };
  const std::vector<double> scalars{ 0, 0, 0, 1, 0, 0, 0, 1 };
  ReferenceOptics optics;
  optics.Model = OpticalModel::Isosurfaces;
  optics.Isosurfaces = { { 0.25, { 1, 0, 0 }, 0.5f }, { 0.5, { 0, 1, 0 }, 0.5f } };
  const RayGrid grid =
    MakeParallelGrid({ 0.01, 0.02, 5 }, { 0.01, 0.02, 0 }, { 0, 1, 0 }, 0.001, 1, 1);
  const ReferenceImage image = RenderReference({ points, cells, scalars, false }, optics, grid);
  // From above: the ray enters the outer one first, and meets its surfaces of 0.5 and 0.25, then
  // those of the inner one.
  EXPECT_NEAR(image.Rgba[1], 0.5 + 0.125, 1e-15);
  EXPECT_NEAR(image.Rgba[0], 0.25 + 0.0625, 1e-15);
  EXPECT_NEAR(image.Depth[0], 4.1, 1e-14);
}

TEST(ReferenceModels, RefusesWhatHasNoSurfaces)
{
  const LinearBox box;
  const RayGrid grid = MakeParallelGrid({ 0.5, 0.6, 3 }, { 0.5, 0.6, 0 }, { 0, 1, 0 }, 0.1, 3, 3);
  ReferenceOptics optics = MakePlanes();
  std::swap(optics.Isosurfaces[0], optics.Isosurfaces[1]);
  EXPECT_THROW(RenderReference(box.View(), optics, grid), std::invalid_argument);

  const std::vector<double> scalars(box.Mesh.GetNumberOfCells(), 1.0);
  EXPECT_THROW(
    RenderReference({ box.Mesh.Points, box.Mesh.Cells, scalars, true }, MakePlanes(), grid),
    std::invalid_argument);

  optics.Isosurfaces.clear();
  const ReferenceImage image = RenderReference(box.View(), optics, grid);
  EXPECT_EQ(image.Rgba, std::vector<double>(4 * 9, 0.0));
}

} // namespace
