// SPDX-License-Identifier: BSD-3-Clause
// Tests of the tests' own oracle: its integral against quadrature with fifty digits, its pictures
// against scenes whose radiance is known in closed form.
#include "ReferenceGrazing.h"
#include "ReferenceIntegral.h"
#include "ReferenceRenderer.h"
#include "ReferenceScenes.h"

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace
{

using namespace tetralux;
using Precise = boost::multiprecision::cpp_bin_float_50;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

//------------------------------------------------------------------------------------------------
// The integral over one segment
//------------------------------------------------------------------------------------------------

struct PreciseSegment
{
  Precise Color[3];
  Precise Alpha;
};

/// Over which attenuation and colour are linear in x = 0..1.
struct PrecisePiece
{
  Precise Begin[4]; ///< colour and attenuation
  Precise End[4];
  Precise Length;

  Precise Value(int channel, const Precise& x) const
  {
    return this->Begin[channel] + (this->End[channel] - this->Begin[channel]) * x;
  }
  Precise OpticalDepth(const Precise& x) const
  {
    return this->Length * (this->Begin[3] * x + (this->End[3] - this->Begin[3]) * x * x / 2);
  }
};

/// What reaches the begin of the piece; channel 3: its alpha.
Precise IntegratePrecisely(const PrecisePiece& piece, int channel)
{
  static boost::math::quadrature::tanh_sinh<Precise> rule(12);
  const Precise depth = piece.OpticalDepth(1);
  if (depth == 0)
  {
    return 0;
  }
  // exp(-100) is 4e-44: beyond any digit that counts.
  Precise sum = 0;
  Precise begin = 0;
  for (int k = 0; k < 5 && begin < 1; ++k)
  {
    Precise end = 1;
    if (depth > 20 * (k + 1))
    {
      Precise low = begin;
      Precise high = 1;
      for (int bisection = 0; bisection < 120; ++bisection)
      {
        const Precise middle = (low + high) / 2;
        (piece.OpticalDepth(middle) < 20 * (k + 1) ? low : high) = middle;
      }
      end = high;
    }
    const Precise halfWidth = (end - begin) / 2;
    const auto integrand = [&](const Precise& y) -> Precise { // y = -1..1
      const Precise x = begin + (1 + y) * halfWidth;
      const Precise value = channel == 3 ? Precise(1) : piece.Value(channel, x);
      return value * piece.Value(3, x) * exp(-piece.OpticalDepth(x));
    };
    sum += rule.integrate(integrand, Precise(1e-22)) * halfWidth * piece.Length;
    begin = end;
  }
  return sum;
}

PreciseSegment IntegratePrecisely(
  const TransferFunction& function, double s0, double s1, double length)
{
  const auto& nodes = function.Nodes;
  std::vector<Precise> cuts{ 0, 1 };
  for (const auto& node : nodes)
  {
    if ((node.Scalar > s0 && node.Scalar < s1) || (node.Scalar < s0 && node.Scalar > s1))
    {
      cuts.push_back((Precise(node.Scalar) - s0) / (Precise(s1) - s0));
    }
  }
  std::sort(cuts.begin(), cuts.end());

  PreciseSegment result{};
  Precise transmittance = 1;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
  {
    const auto scalar = [&](const Precise& x) -> Precise { return s0 + (Precise(s1) - s0) * x; };
    const Precise middle = scalar((cuts[i] + cuts[i + 1]) / 2);
    std::size_t k = 0;
    while (k < nodes.size() && nodes[k].Scalar <= middle)
    {
      ++k;
    }
    const auto value = [&](const Precise& s, int channel) -> Precise
    {
      const auto get = [channel](const TransferFunction::Value& v) -> Precise
      { return channel == 3 ? v.Attenuation : v.Color[channel]; };
      if (k == 0 || k == nodes.size())
      {
        return get(k == 0 ? nodes.front().Left : nodes.back().Right);
      }
      const Precise w =
        (s - nodes[k - 1].Scalar) / (Precise(nodes[k].Scalar) - nodes[k - 1].Scalar);
      return (1 - w) * get(nodes[k - 1].Right) + w * get(nodes[k].Left);
    };
    PrecisePiece piece;
    piece.Length = (cuts[i + 1] - cuts[i]) * length;
    for (int channel = 0; channel < 4; ++channel)
    {
      piece.Begin[channel] = value(scalar(cuts[i]), channel);
      piece.End[channel] = value(scalar(cuts[i + 1]), channel);
    }
    for (int channel = 0; channel < 3; ++channel)
    {
      result.Color[channel] += transmittance * IntegratePrecisely(piece, channel);
    }
    const Precise alpha = IntegratePrecisely(piece, 3);
    result.Alpha += transmittance * alpha;
    transmittance *= exp(-piece.OpticalDepth(1));
  }
  return result;
}

double RelativeError(double value, const Precise& expected)
{
  return expected == 0 ? std::abs(value)
                       : static_cast<double>(abs(value - expected) / abs(expected));
}

/// The largest relative error of the four channels; fails above 1e-12.
double CheckSegment(const TransferFunction& function, double s0, double s1, double length)
{
  const ReferenceSegment segment = IntegrateReference(function, s0, s1, length);
  const PreciseSegment expected = IntegratePrecisely(function, s0, s1, length);
  double error = RelativeError(segment.Alpha, expected.Alpha);
  for (int channel = 0; channel < 3; ++channel)
  {
    error = std::max(error, RelativeError(segment.Color[channel], expected.Color[channel]));
  }
  EXPECT_LT(error, 1e-12) << "s0 " << s0 << " s1 " << s1 << " length " << length;
  return error;
}

TEST(ReferenceIntegral, AgreesWithFiftyDigitsAtEveryOpticalDepthAndSlope)
{
  const double slopes[][2] = { { 1, 1 }, { 0, 1 }, { 1, 0 }, { 1, 1.0000001 }, { 1.0000001, 1 },
    { 1e-6, 1 }, { 1, 1e-6 } };
  double largest = 0;
  for (double depth = 1e-12; depth < 2e6; depth *= 10)
  {
    for (const auto& slope : slopes)
    {
      const double scale = 2 * depth / (slope[0] + slope[1]);
      const TransferFunction function = MakeLinearFunction(
        { { 0, 1, 0, 0.3, scale * slope[0] }, { 1, 0, 1, 0.7, scale * slope[1] } });
      largest = std::max(largest, CheckSegment(function, 0, 1, 1));
    }
  }
  RecordProperty("LargestRelativeError", std::to_string(largest * 1e15) + "e-15");
}

TEST(ReferenceIntegral, AgreesWithFiftyDigitsAcrossNeedles)
{
  for (const double width : { 1e-3, 1e-9, 1e-14 })
  {
    for (const double depth : { 1e-12, 0.3, 30.0, 1e6 })
    {
      const TransferFunction function = MakeLinearFunction({ { 0, 0.1, 0.2, 0.3, 0 },
        { 0.5 - width, 0.4, 0.1, 0.9, 0 }, { 0.5, 1, 0, 0.5, depth / width },
        { 0.5 + width, 0, 0.8, 0.5, 0 }, { 1, 0.2, 0.2, 0.2, 0 } });
      CheckSegment(function, -0.5, 1.5, 2);
      CheckSegment(function, 1.5, -0.5, 2);
      CheckSegment(function, 0.5, 1.0, 1e-3);
      CheckSegment(function, 0.5 - width / 4, 0.5 + width / 2, 1);
    }
  }
}

TEST(ReferenceIntegral, AgreesWithFiftyDigitsForNearlyEqualScalars)
{
  const TransferFunction function = MakeFunctionWithSteps();
  for (const double s : { 0.0, 0.1, 0.4, 0.7, 1.0, 1e5 })
  {
    for (const double difference : { 1e-16, 1e-15, 1e-12, 1e-8, 1e-4 })
    {
      CheckSegment(function, s, s + difference, 0.7);
      CheckSegment(function, s + difference, s, 0.7);
      CheckSegment(function, s - difference, s + difference, 0.7);
      CheckSegment(function, s + difference, s - difference, 0.7);
    }
    CheckSegment(function, s, s, 0.7);
  }
}

TEST(ReferenceIntegral, AgreesWithFiftyDigitsForRandomFunctions)
{
  std::mt19937_64 generator(20);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int example = 0; example < 60; ++example)
  {
    TransferFunction function;
    const auto randomValue = [&]() -> TransferFunction::Value
    {
      const double attenuation = unit(generator) < 0.2 ? 0 : std::pow(10, 8 * unit(generator) - 5);
      return { { unit(generator), unit(generator), unit(generator) }, attenuation };
    };
    double scalar = -3;
    const int numberOfNodes = 1 + static_cast<int>(8 * unit(generator));
    for (int node = 0; node < numberOfNodes; ++node)
    {
      scalar += std::pow(10, 4 * unit(generator) - 4);
      const TransferFunction::Value left = randomValue();
      function.Nodes.push_back({ scalar, left, unit(generator) < 0.5 ? left : randomValue() });
    }
    const double s0 = -3.5 + (scalar + 4) * unit(generator);
    const double s1 = -3.5 + (scalar + 4) * unit(generator);
    CheckSegment(function, s0, s1, std::pow(10, 3 * unit(generator) - 2));
  }
}

TEST(ReferenceIntegral, ConstantScalarAtAStepTakesTheRightValue)
{
  const ReferenceSegment segment = IntegrateReference(MakeFunctionWithSteps(), 0.4, 0.4, 0.5);
  EXPECT_NEAR(segment.Alpha, 1 - std::exp(-3.5), 1e-15);
  EXPECT_NEAR(segment.Color[1], 0.6 * (1 - std::exp(-3.5)), 1e-15);
}

TEST(ReferenceIntegral, FindsTheFirstContribution)
{
  const TransferFunction function = MakeFunctionWithSteps();
  EXPECT_DOUBLE_EQ(IntegrateReference(function, 0.1, 0.5, 1).FirstContribution, 0.75);
  EXPECT_DOUBLE_EQ(IntegrateReference(function, 0.5, 0.1, 1).FirstContribution, 0);
  EXPECT_EQ(IntegrateReference(function, 0.1, 0.3, 1).FirstContribution, -1);
  EXPECT_EQ(IntegrateReference(function, 0.1, 0.3, 1).Alpha, 0);
  EXPECT_EQ(IntegrateReference(function, 2, 3, 0).FirstContribution, -1);
}

//------------------------------------------------------------------------------------------------
// Pictures
//------------------------------------------------------------------------------------------------

using Vector = std::array<double, 3>;

/// A mesh with scalars, and the view of it that the renderer takes.
struct Scene
{
  TetrahedralMesh Mesh;
  std::vector<double> Scalars;
  bool CellScalars = false;

  ReferenceImage Render(const TransferFunction& function, const RayGrid& grid,
    const RayLimits& limits = {}, Span<const std::uint8_t> pixels = {}) const
  {
    return RenderReference(this->View(), function, grid, limits, pixels);
  }
  ReferenceMesh View() const
  {
    return { this->Mesh.Points, this->Mesh.Cells, this->Scalars, this->CellScalars };
  }
};

/// A scene whose scalar is gradient * point + constant.
Scene MakeLinearScene(TetrahedralMesh mesh, const Vector& gradient, double constant)
{
  Scene scene;
  scene.Mesh = std::move(mesh);
  for (std::size_t i = 0; i < scene.Mesh.Points.size(); i += 3)
  {
    const double* p = scene.Mesh.Points.data() + i;
    scene.Scalars.push_back(
      gradient[0] * p[0] + gradient[1] * p[1] + gradient[2] * p[2] + constant);
  }
  return scene;
}

Scene MakeConstantScene(TetrahedralMesh mesh)
{
  return MakeLinearScene(std::move(mesh), { 0, 0, 0 }, 0);
}

Scene MakeUnitTetrahedron()
{
  TetrahedralMesh mesh;
  mesh.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  mesh.Cells = { 0, 1, 2, 3 };
  return MakeConstantScene(std::move(mesh));
}

/// A ray in plain terms; its direction has length 1.
struct WorldRay
{
  long double Origin[3];
  long double Direction[3];
};

WorldRay GetRay(const RayGrid& grid, int i, int j)
{
  WorldRay ray;
  long double length = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    ray.Origin[axis] = grid.Origin[axis] + i * grid.OriginStepX[axis] + j * grid.OriginStepY[axis];
    ray.Direction[axis] =
      grid.Direction[axis] + i * grid.DirectionStepX[axis] + j * grid.DirectionStepY[axis];
    length += ray.Direction[axis] * ray.Direction[axis];
  }
  for (long double& component : ray.Direction)
  {
    component /= std::sqrt(length);
  }
  return ray;
}

/// The part begin..end of a line in a box; empty where begin >= end.
struct Chord
{
  long double Begin = -std::numeric_limits<long double>::infinity();
  long double End = std::numeric_limits<long double>::infinity();
  double Length() const
  {
    return this->Begin < this->End ? static_cast<double>(this->End - this->Begin) : 0;
  }
};

Chord ClipByBox(const WorldRay& ray, const Vector& lower, const Vector& upper)
{
  Chord chord;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (ray.Direction[axis] == 0)
    {
      if (ray.Origin[axis] < lower[axis] || ray.Origin[axis] > upper[axis])
      {
        return { 0, 0 };
      }
      continue;
    }
    const long double a = (lower[axis] - ray.Origin[axis]) / ray.Direction[axis];
    const long double b = (upper[axis] - ray.Origin[axis]) / ray.Direction[axis];
    chord.Begin = std::max(chord.Begin, std::min(a, b));
    chord.End = std::min(chord.End, std::max(a, b));
  }
  return chord;
}

/// One ray from position through target, as a picture of one pixel.
RayGrid MakeSingleRay(const Vector& position, const Vector& target)
{
  RayGrid grid;
  grid.Width = grid.Height = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.Origin[axis] = position[axis];
    grid.Direction[axis] = target[axis] - position[axis];
  }
  return grid;
}

const TransferFunction Grey = MakeConstantFunction(1.5, { 0.2, 0.4, 0.8 });

TEST(Reference, SingleTetrahedron)
{
  const Scene scene = MakeUnitTetrahedron();
  const RayGrid grid = MakeParallelGrid({ 0.5, 0.5, 3 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, 0.6, 33, 21);
  const ReferenceImage image = scene.Render(Grey, grid);
  int covered = 0;
  for (int pixel = 0; pixel < 33 * 21; ++pixel)
  {
    const WorldRay ray = GetRay(grid, pixel % 33, pixel / 33);
    const double x = static_cast<double>(ray.Origin[0]);
    const double y = static_cast<double>(ray.Origin[1]);
    const double length = x > 0 && y > 0 && x + y < 1 ? 1 - x - y : 0;
    const double alpha = 1 - std::exp(-1.5 * length);
    EXPECT_NEAR(image.Rgba[4 * pixel + 3], alpha, 1e-15);
    EXPECT_NEAR(image.Rgba[4 * pixel + 0], 0.2 * alpha, 1e-15);
    EXPECT_NEAR(image.Rgba[4 * pixel + 2], 0.8 * alpha, 1e-15);
    EXPECT_NEAR(image.Depth[pixel], length > 0 ? 2 + x + y : -1, 1e-14);
    covered += length > 0;
  }
  EXPECT_GT(covered, 100);
}

TEST(Reference, ViewsAreThoseOfACamera)
{
  const int width = 40;
  const int height = 20;
  const RayGrid perspective =
    MakePerspectiveGrid({ 1, 2, 3 }, { 1, 2, -5 }, { 0, 3, 1 }, 90, width, height);
  const RayGrid parallel =
    MakeParallelGrid({ 1, 2, 3 }, { 1, 2, -5 }, { 0, 3, 1 }, 7, width, height);
  for (const int corner : { 0, 1 })
  {
    const double x = (corner ? width - 0.5 : 0.5) / width * 4 - 2;
    const double y = (corner ? height - 0.5 : 0.5) / height * 2 - 1;
    const int i = corner ? width - 1 : 0;
    const int j = corner ? height - 1 : 0;
    const WorldRay ray = GetRay(perspective, i, j);
    EXPECT_NEAR(ray.Direction[0] / -ray.Direction[2], x, 1e-14);
    EXPECT_NEAR(ray.Direction[1] / -ray.Direction[2], y, 1e-14);
    EXPECT_EQ(ray.Origin[0], 1);
    EXPECT_LT(ray.Direction[2], 0);
    const WorldRay parallelRay = GetRay(parallel, i, j);
    EXPECT_NEAR(parallelRay.Origin[0], 1 + 7 * x, 1e-14);
    EXPECT_NEAR(parallelRay.Origin[1], 2 + 7 * y, 1e-14);
    EXPECT_NEAR(parallelRay.Origin[2], 3, 1e-14);
    EXPECT_NEAR(parallelRay.Direction[2], -1, 1e-15);
  }
}

TEST(Reference, RaysThroughVerticesEdgesAndFacesCountOnce)
{
  // A cube of five tetrahedra, and a grid whose lines all rays below run along or cut.
  for (const int n : { 1, 4 })
  {
    const Scene scene = MakeConstantScene(MakeBox(n, n, n, { 0, 0, 0 }, { 1, 1, 1 }));
    const Vector targets[] = { { 0, 0, 0 }, { 1, 1, 1 }, { 1, 0, 0 }, { 0, 1, 1 }, { 0.5, 0.5, 0 },
      { 0.5, 0.5, 1 }, { 0.5, 0, 0.5 }, { 1, 0.5, 0.5 }, { 0.5, 0.5, 0.5 }, { 0.25, 0.5, 0.75 },
      { 0.25, 0.25, 0 } };
    const Vector positions[] = { { -1, -1, -1 }, { 2, 2, 2 }, { 2, -1, -1 }, { 0.5, 0.5, -3 },
      { 0.5, 0.5, 3 }, { -2, 0.5, 0.5 }, { 0.25, 3, 0.5 }, { 3, 3, 0.5 }, { -1, 2, 0.25 },
      { 0.25, 0.5, 2 } };
    for (const Vector& position : positions)
    {
      for (const Vector& target : targets)
      {
        const RayGrid grid = MakeSingleRay(position, target);
        const Chord chord = ClipByBox(GetRay(grid, 0, 0), { 0, 0, 0 }, { 1, 1, 1 });
        const ReferenceImage image = scene.Render(Grey, grid);
        EXPECT_NEAR(image.Length[0], chord.Length(), 1e-15)
          << n << ": " << position[0] << ' ' << position[1] << ' ' << position[2] << " to "
          << target[0] << ' ' << target[1] << ' ' << target[2];
        if (chord.Length() > 0)
        {
          EXPECT_NEAR(image.Depth[0], static_cast<double>(chord.Begin), 1e-15);
        }
      }
    }
  }
}

TEST(Reference, RaysInTheHullAreInsideOrOutside)
{
  const Scene scene = MakeConstantScene(MakeBox(3, 3, 3, { 0, 0, 0 }, { 1, 1, 1 }));
  int inside = 0;
  for (const double x : { 0.0, 1.0 })
  {
    for (const double y : { 0.0, 0.2, 1.0 / 3, 1.0 })
    {
      const ReferenceImage image = scene.Render(Grey, MakeSingleRay({ x, y, -1 }, { x, y, 0 }));
      if (image.Length[0] != 0)
      {
        EXPECT_NEAR(image.Length[0], 1, 1e-15);
        ++inside;
      }
    }
  }
  EXPECT_EQ(inside, 3); // one of the two sides, and of that one corner line not
}

TEST(Reference, ParallelPictureAlongTheGridLinesLosesNothing)
{
  // Pixel centres are the grid's vertices and the middles of its edges.
  const int n = 8;
  const Scene scene = MakeLinearScene(MakeBox(n, n, n, { 0, 0, 0 }, { 1, 1, 1 }), { 0, 0, 1 }, 0);
  const TransferFunction ramp = MakeLinearFunction({ { 0, 1, 0, 0, 0.5 }, { 1, 0, 1, 0, 3.0 } });
  const int size = 2 * n - 1;
  const RayGrid grid =
    MakeParallelGrid({ 0.5, 0.5, 2 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, size / (4.0 * n), size, size);
  const ReferenceImage image = scene.Render(ramp, grid);
  const ReferenceSegment expected = IntegrateReference(ramp, 1, 0, 1);
  for (int pixel = 0; pixel < size * size; ++pixel)
  {
    EXPECT_NEAR(image.Length[pixel], 1, 1e-15);
    EXPECT_NEAR(image.Rgba[4 * pixel + 0], expected.Color[0], 1e-14);
    EXPECT_NEAR(image.Rgba[4 * pixel + 1], expected.Color[1], 1e-14);
    EXPECT_NEAR(image.Rgba[4 * pixel + 3], expected.Alpha, 1e-14);
    EXPECT_NEAR(image.Depth[pixel], 1, 1e-15);
  }
}

/// Where a line enters and leaves a tetrahedron, by its four planes in fifty digits.
Precise ClipByPlanes(const WorldRay& ray, const std::vector<double>& points)
{
  Precise begin = -1e30;
  Precise end = 1e30;
  for (int opposite = 0; opposite < 4; ++opposite)
  {
    const double* corner[4]; // the one opposite to the plane comes first
    for (int i = 0; i < 4; ++i)
    {
      corner[i] = points.data() + 3 * ((opposite + i) % 4);
    }
    Precise normal[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      normal[axis] =
        (Precise(corner[2][u]) - corner[1][u]) * (Precise(corner[3][v]) - corner[1][v]) -
        (Precise(corner[2][v]) - corner[1][v]) * (Precise(corner[3][u]) - corner[1][u]);
    }
    Precise inside = 0;
    Precise distance = 0;
    Precise slope = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      inside += normal[axis] * (Precise(corner[0][axis]) - corner[1][axis]);
      distance += normal[axis] * (Precise(ray.Origin[axis]) - corner[1][axis]);
      slope += normal[axis] * Precise(ray.Direction[axis]);
    }
    if (slope != 0)
    {
      const Precise t = -distance / slope;
      if ((slope > 0) == (inside > 0))
      {
        begin = std::max(begin, t);
      }
      else
      {
        end = std::min(end, t);
      }
    }
    else if ((distance > 0) != (inside > 0))
    {
      return 0;
    }
  }
  return begin < end ? Precise(end - begin) : Precise(0);
}

TEST(Reference, ClipsAsByPlanes)
{
  // Random tetrahedra, and the same flattened: one corner moved close to the opposite face.
  const struct
  {
    double Thickness;
    double Tolerance;
  } examples[] = { { 1, 1e-14 }, { 1e-6, 1e-11 } };
  for (const auto& example : examples)
  {
    std::mt19937_64 generator(12);
    std::uniform_real_distribution<double> unit(0, 1);
    int hits = 0;
    for (int trial = 0; trial < 1000; ++trial)
    {
      TetrahedralMesh mesh;
      for (int i = 0; i < 12; ++i)
      {
        mesh.Points.push_back(unit(generator));
      }
      for (int axis = 0; axis < 3; ++axis)
      {
        const double mean = (mesh.Points[axis] + mesh.Points[3 + axis] + mesh.Points[6 + axis]) / 3;
        mesh.Points[9 + axis] = mean + example.Thickness * (mesh.Points[9 + axis] - mean);
      }
      mesh.Cells = { 0, 1, 2, 3 };
      const Vector target{ unit(generator), unit(generator), unit(generator) };
      const RayGrid grid =
        MakeSingleRay({ 5 * unit(generator), 4, 6 * unit(generator) - 3 }, target);
      const std::vector<double> points = mesh.Points;
      const Precise expected = ClipByPlanes(GetRay(grid, 0, 0), points);
      const double length = MakeConstantScene(std::move(mesh)).Render(Grey, grid).Length[0];
      EXPECT_NEAR(length, static_cast<double>(expected), example.Tolerance) << "trial " << trial;
      hits += expected > 0;
    }
    EXPECT_GT(hits, 50);
  }
}

/// A linear field is linear across every cell, so the picture of a box has a closed form for any
/// mesh inside of it.
void ExpectLinearBox(const Scene& scene, const Vector& lower, const Vector& upper,
  const Vector& gradient, double constant, const RayGrid& grid, double tolerance)
{
  const TransferFunction function = MakeLinearFunction({ { -2, 0.1, 0.9, 0.4, 0 },
    { 0.1, 1, 0, 0, 0.2 }, { 0.3, 0, 0.5, 1, 4 }, { 0.9, 1, 1, 0, 0.1 }, { 2, 0, 0, 1, 1 } });
  const ReferenceImage image = scene.Render(function, grid);
  double largest = 0;
  int covered = 0;
  for (int pixel = 0; pixel < grid.Width * grid.Height; ++pixel)
  {
    const WorldRay ray = GetRay(grid, pixel % grid.Width, pixel / grid.Width);
    const Chord chord = ClipByBox(ray, lower, upper);
    const auto scalar = [&](long double t)
    {
      long double s = constant;
      for (int axis = 0; axis < 3; ++axis)
      {
        s += gradient[axis] * (ray.Origin[axis] + t * ray.Direction[axis]);
      }
      return static_cast<double>(s);
    };
    ReferenceSegment expected;
    if (chord.Length() > 0)
    {
      ++covered;
      expected =
        IntegrateReference(function, scalar(chord.Begin), scalar(chord.End), chord.Length());
    }
    for (int channel = 0; channel < 3; ++channel)
    {
      largest =
        std::max(largest, std::abs(image.Rgba[4 * pixel + channel] - expected.Color[channel]));
    }
    largest = std::max(largest, std::abs(image.Rgba[4 * pixel + 3] - expected.Alpha));
    largest = std::max(largest, std::abs(image.Length[pixel] - chord.Length()));
  }
  EXPECT_LT(largest, tolerance);
  EXPECT_GT(covered, 150);
}

TEST(Reference, LinearFieldInAJitteredBox)
{
  const Vector gradient{ 0.4, -0.7, 0.6 };
  const Scene scene =
    MakeLinearScene(MakeBox(7, 6, 5, { 0, 0, 0 }, { 1, 1.2, 0.9 }, 0.15, 3), gradient, 0.3);
  const Vector upper{ 1, 1.2, 0.9 };
  const Vector center{ 0.5, 0.6, 0.45 };
  const Vector up{ 0, 1, 0.1 };
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int view = 0; view < 4; ++view)
  {
    const Vector position{ 0.5 + 3 * unit(generator), 0.6 + 3 * unit(generator),
      0.45 + 3 * unit(generator) };
    ExpectLinearBox(scene, { 0, 0, 0 }, upper, gradient, 0.3,
      MakePerspectiveGrid(position, center, up, 40, 37, 29), 1e-13);
    ExpectLinearBox(scene, { 0, 0, 0 }, upper, gradient, 0.3,
      MakeParallelGrid(position, center, up, 0.7, 37, 29), 1e-13);
  }
  // From inside, also what lies behind the camera; and a view of 170 degrees.
  ExpectLinearBox(scene, { 0, 0, 0 }, upper, gradient, 0.3,
    MakePerspectiveGrid({ 0.31, 0.52, 0.23 }, center, up, 100, 37, 29), 1e-13);
  ExpectLinearBox(scene, { 0, 0, 0 }, upper, gradient, 0.3,
    MakePerspectiveGrid({ 0.5, 0.6, 1.0 }, center, up, 170, 37, 29), 1e-13);
  // At a vertex of the mesh.
  ExpectLinearBox(scene, { 0, 0, 0 }, upper, gradient, 0.3,
    MakePerspectiveGrid({ scene.Mesh.Points[300], scene.Mesh.Points[301], scene.Mesh.Points[302] },
      { 0.5, 0.6, 2 }, up, 100, 37, 29),
    1e-13);
}

TEST(Reference, GridsThatAreNoCamera)
{
  // Both the begin and the direction vary: no image plane to project to.
  const Vector gradient{ 0.4, -0.7, 0.6 };
  const Scene scene =
    MakeLinearScene(MakeBox(4, 4, 4, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, 3), gradient, 0.3);
  RayGrid grid = MakeParallelGrid({ 0.5, 0.5, 3 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, 0.7, 25, 25);
  grid.DirectionStepX[0] = 0.01;
  grid.DirectionStepY[1] = -0.02;
  ExpectLinearBox(scene, { 0, 0, 0 }, { 1, 1, 1 }, gradient, 0.3, grid, 1e-13);
}

TEST(Reference, LeavesOutOnlyPixelsThatSeeNothing)
{
  // Random overlapping cells, large, small and flat, around the camera. Steps of the begin that are
  // too small to move it make a grid that is no camera, of which every pixel tries every cell.
  std::mt19937_64 generator(31);
  std::uniform_real_distribution<double> unit(-1, 1);
  Scene scene;
  for (int cell = 0; cell < 500; ++cell)
  {
    const double size = std::pow(10, 2 * unit(generator) - 1.5);
    const double thickness = std::pow(10, 3 * unit(generator) - 3);
    const double center[3] = { 3 * unit(generator), 3 * unit(generator), 3 * unit(generator) };
    const double normal[3] = { unit(generator), unit(generator), unit(generator) };
    for (int i = 0; i < 4; ++i)
    {
      double p[3] = { unit(generator), unit(generator), unit(generator) };
      const double height = p[0] * normal[0] + p[1] * normal[1] + p[2] * normal[2];
      const double square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
      for (int axis = 0; axis < 3; ++axis)
      {
        p[axis] += (thickness - 1) * height / square * normal[axis];
        scene.Mesh.Points.push_back(center[axis] + size * p[axis]);
      }
      scene.Mesh.Cells.push_back(4 * cell + i);
      scene.Scalars.push_back(0);
    }
  }
  for (const double viewAngle : { 1.0, 40.0, 150.0 })
  {
    RayGrid grid =
      MakePerspectiveGrid({ 0.1, 0.2, 0.3 }, { 1, -0.5, 2 }, { 0, 1, 0 }, viewAngle, 53, 41);
    const ReferenceImage image = scene.Render(Grey, grid);
    grid.OriginStepX[0] = 1e-200;
    const ReferenceImage expected = scene.Render(Grey, grid);
    EXPECT_GT(image.NumberOfSegments, 1000);
    EXPECT_EQ(image.NumberOfSegments, expected.NumberOfSegments) << viewAngle;
    EXPECT_EQ(image.Rgba, expected.Rgba);
  }
  RayGrid grid = MakeParallelGrid({ 5, 6, 7 }, { 0, 0, 0 }, { 0, 1, 0 }, 4, 53, 41);
  const ReferenceImage image = scene.Render(Grey, grid);
  grid.DirectionStepX[0] = 1e-200;
  const ReferenceImage expected = scene.Render(Grey, grid);
  EXPECT_EQ(image.NumberOfSegments, expected.NumberOfSegments);
  EXPECT_EQ(image.Rgba, expected.Rgba);
}

TEST(Reference, FlatCellsKeepTheirShare)
{
  // A boundary layer: cells with edges of 1 by 1e-6.
  const Vector upper{ 1, 1, 8e-6 };
  const Vector gradient{ 0.4, 0.2, 3e4 };
  const Scene scene = MakeLinearScene(MakeBox(8, 8, 8, { 0, 0, 0 }, upper, 0.15, 9), gradient, 0.1);
  ExpectLinearBox(scene, { 0, 0, 0 }, upper, gradient, 0.1,
    MakePerspectiveGrid({ 0.4, 0.3, 2 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, 30, 33, 33), 1e-11);
}

TEST(Reference, CameraInsideSeesWhatItsClippingRangeKeeps)
{
  const Scene scene = MakeConstantScene(MakeBox(5, 5, 5, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, 3));
  const Vector position{ 0.4, 0.6, 0.5 };
  const Vector focalPoint{ 0.4, 0.6, -1 };
  const RayGrid grid = MakePerspectiveGrid(position, focalPoint, { 0, 1, 0 }, 60, 21, 21);
  RayLimits limits;
  AddClippingRange(limits, position, focalPoint, 0.1, 0.3);
  const ReferenceImage image = scene.Render(Grey, grid, limits);
  const ReferenceImage unlimited = scene.Render(Grey, grid);
  for (int pixel = 0; pixel < 21 * 21; ++pixel)
  {
    const WorldRay ray = GetRay(grid, pixel % 21, pixel / 21);
    const double slant = 1 / static_cast<double>(-ray.Direction[2]);
    EXPECT_NEAR(image.Length[pixel], 0.2 * slant, 1e-14);
    EXPECT_NEAR(image.Depth[pixel], 0.1 * slant, 1e-14);
    EXPECT_NEAR(image.Rgba[4 * pixel + 3], 1 - std::exp(-1.5 * 0.2 * slant), 1e-14);
    const Chord chord = ClipByBox(ray, { 0, 0, 0 }, { 1, 1, 1 });
    EXPECT_NEAR(unlimited.Length[pixel], chord.Length(), 1e-14);
    EXPECT_LT(unlimited.Depth[pixel], 0);
  }
}

TEST(Reference, CroppingKeepsTheFlaggedRegions)
{
  const Scene scene = MakeConstantScene(MakeBox(4, 4, 4, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, 3));
  const RayGrid grid =
    MakePerspectiveGrid({ 1.5, 1.9, 2.3 }, { 0.5, 0.5, 0.5 }, { 0, 1, 0 }, 35, 19, 17);
  RayLimits limits;
  limits.Cropping = true;
  const double planes[6] = { 0.3, 0.6, 0.25, 0.7, 0.4, 0.85 };
  std::copy(planes, planes + 6, limits.CroppingPlanes);
  const double borders[3][4] = { { 0, 0.3, 0.6, 1 }, { 0, 0.25, 0.7, 1 }, { 0, 0.4, 0.85, 1 } };
  std::vector<std::uint32_t> flags{ 0x2000, 0x7ffffff, 0, 0x4e4 };
  for (int bit = 0; bit < 27; ++bit)
  {
    flags.push_back(1u << bit);
  }
  std::mt19937_64 generator(8);
  for (int i = 0; i < 8; ++i)
  {
    flags.push_back(static_cast<std::uint32_t>(generator()) & 0x7ffffff);
  }
  for (const std::uint32_t flag : flags)
  {
    limits.CroppingFlags = flag;
    const ReferenceImage image = scene.Render(Grey, grid, limits);
    for (int pixel = 0; pixel < 19 * 17; ++pixel)
    {
      const WorldRay ray = GetRay(grid, pixel % 19, pixel / 19);
      double length = 0;
      for (int region = 0; region < 27; ++region)
      {
        const int i[3] = { region % 3, region / 3 % 3, region / 9 };
        if (flag >> region & 1)
        {
          length += ClipByBox(ray, { borders[0][i[0]], borders[1][i[1]], borders[2][i[2]] },
            { borders[0][i[0] + 1], borders[1][i[1] + 1], borders[2][i[2] + 1] })
                      .Length();
        }
      }
      EXPECT_NEAR(image.Length[pixel], length, 1e-14) << "flags " << flag << " pixel " << pixel;
      EXPECT_NEAR(image.Rgba[4 * pixel + 3], 1 - std::exp(-1.5 * length), 1e-13);
    }
  }
}

TEST(Reference, MaximumDistancesEndTheRays)
{
  const Vector gradient{ 0, 0, 1 };
  const Scene scene =
    MakeLinearScene(MakeBox(4, 4, 4, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, 3), gradient, 0);
  const TransferFunction ramp = MakeLinearFunction({ { 0, 1, 0, 0, 0.5 }, { 1, 0, 1, 0, 3.0 } });
  const RayGrid grid = MakeParallelGrid({ 0.5, 0.5, 2 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, 0.1, 5, 1);
  const float distances[5] = { 0.5f, 1.0f, 1.25f, 2.0f, std::numeric_limits<float>::infinity() };
  RayLimits limits;
  limits.MaximumDistances = distances;
  const ReferenceImage image = scene.Render(ramp, grid, limits);
  const double lengths[5] = { 0, 0, 0.25, 1, 1 };
  for (int pixel = 0; pixel < 5; ++pixel)
  {
    EXPECT_NEAR(image.Length[pixel], lengths[pixel], 1e-15);
    const ReferenceSegment expected =
      IntegrateReference(ramp, 1, 1 - lengths[pixel], lengths[pixel]);
    EXPECT_NEAR(image.Rgba[4 * pixel + 1], expected.Color[1], 1e-14);
    EXPECT_NEAR(image.Rgba[4 * pixel + 3], expected.Alpha, 1e-14);
  }
}

TEST(Reference, LengthsAreMeasuredInTheWorld)
{
  // Scaling, shear, rotation and a mirror, applied by the renderer or to the points beforehand.
  const double matrix[3][4] = { { 2, 0.7, -0.3, 5 }, { 0.2, -0.5, 1.1, -3 },
    { -0.4, 0.6, 0.8, 1 } };
  const Scene scene =
    MakeLinearScene(MakeBox(4, 5, 3, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, 3), { 0.3, 0.4, 0.2 }, 0);
  Scene moved = scene;
  for (std::size_t i = 0; i < moved.Mesh.Points.size(); i += 3)
  {
    const double* p = scene.Mesh.Points.data() + i;
    for (int row = 0; row < 3; ++row)
    {
      moved.Mesh.Points[i + row] =
        matrix[row][0] * p[0] + matrix[row][1] * p[1] + matrix[row][2] * p[2] + matrix[row][3];
    }
  }
  const TransferFunction ramp =
    MakeLinearFunction({ { 0, 1, 0, 0.2, 0.1 }, { 0.5, 0, 1, 0, 3.0 }, { 1, 1, 1, 0, 0 } });
  for (const bool parallel : { false, true })
  {
    const Vector center{ 6.2, -2.6, 1.5 };
    RayGrid grid = parallel ? MakeParallelGrid({ 9, 1, 6 }, center, { 0, 0, 1 }, 1.4, 41, 33)
                            : MakePerspectiveGrid({ 9, 1, 6 }, center, { 0, 0, 1 }, 25, 41, 33);
    RayLimits limits;
    limits.Planes.push_back({ 0.3, 0.5, -0.7, 0.6 });
    const ReferenceImage expected = moved.Render(ramp, grid, limits);
    PlaceMesh(grid, matrix);
    const ReferenceImage image = scene.Render(ramp, grid, limits);
    EXPECT_GT(*std::max_element(expected.Length.begin(), expected.Length.end()), 0.5);
    for (std::size_t k = 0; k < image.Rgba.size(); ++k)
    {
      EXPECT_NEAR(image.Rgba[k], expected.Rgba[k], 1e-13);
    }
    for (std::size_t pixel = 0; pixel < image.Depth.size(); ++pixel)
    {
      EXPECT_NEAR(image.Depth[pixel], expected.Depth[pixel], 1e-13);
    }
  }
}

TEST(Reference, FarFromTheOrigin)
{
  // Coordinates are rounded by the offset; taking it away again is exact.
  const struct
  {
    double Offset;
    double Size;
  } examples[] = { { 1e4, 1e-3 }, { 1e7, 1e-2 } };
  for (const auto& example : examples)
  {
    const double offset = example.Offset;
    const double size = example.Size;
    Scene far = MakeLinearScene(MakeBox(6, 6, 6, { offset, offset, offset },
                                  { offset + size, offset + size, offset + size }, 0.15, 3),
      { 0, 0, 0 }, 0);
    Scene near = far;
    for (std::size_t i = 0; i < near.Mesh.Points.size(); ++i)
    {
      near.Mesh.Points[i] -= offset;
      far.Scalars[i / 3] = near.Scalars[i / 3] = near.Mesh.Points[i / 3 * 3] / size;
    }
    const TransferFunction ramp = MakeLinearFunction(
      { { 0, 1, 0, 0.2, 0.1 / size }, { 0.5, 0, 1, 0, 3 / size }, { 1, 1, 1, 0, 0 } });
    RayGrid grid = MakePerspectiveGrid({ 2 * size, 3 * size, 4 * size },
      { 0.5 * size, 0.5 * size, 0.5 * size }, { 0, 1, 0 }, 20, 31, 31);
    double rounded[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      rounded[axis] = grid.Origin[axis] + offset;
      grid.Origin[axis] = rounded[axis] - offset;
    }
    const ReferenceImage expected = near.Render(ramp, grid);
    std::copy(rounded, rounded + 3, grid.Origin);
    const ReferenceImage image = far.Render(ramp, grid);
    double largest = 0;
    for (std::size_t k = 0; k < image.Rgba.size(); ++k)
    {
      largest = std::max(largest, std::abs(image.Rgba[k] - expected.Rgba[k]));
    }
    EXPECT_LT(largest, 1e-13) << offset;
    EXPECT_GT(*std::max_element(expected.Rgba.begin(), expected.Rgba.end()), 0.3);
  }
}

TEST(Reference, OpticalDepthOfAMillionInACell)
{
  const Scene scene = MakeLinearScene(MakeBox(1, 1, 1, { 0, 0, 0 }, { 1, 1, 1 }), { 0, 0, 1 }, 0);
  const TransferFunction function =
    MakeLinearFunction({ { 0, 1, 0, 0.5, 1e6 }, { 1, 0.25, 1, 0.5, 1e6 } });
  const ReferenceImage image =
    scene.Render(function, MakeSingleRay({ 0.4, 0.3, 2 }, { 0.4, 0.3, 0 }));
  EXPECT_EQ(image.Rgba[3], 1);
  EXPECT_NEAR(image.Rgba[0], 0.25 + 0.75e-6, 1e-15); // the mean depth of what is seen is 1e-6
  EXPECT_NEAR(image.Rgba[1], 1 - 1e-6, 1e-15);
  EXPECT_NEAR(image.Rgba[2], 0.5, 1e-15);
}

TEST(Reference, CellScalars)
{
  Scene scene;
  scene.Mesh = MakeBox(1, 1, 2, { 0, 0, 0 }, { 1, 1, 2 });
  scene.CellScalars = true;
  scene.Scalars.assign(10, 0.0);
  std::fill(scene.Scalars.begin() + 5, scene.Scalars.end(), 1.0);
  const TransferFunction function = MakeLinearFunction({ { 0, 1, 0, 0, 0.5 }, { 1, 0, 1, 0, 2 } });
  const RayGrid grid = MakeParallelGrid({ 0.5, 0.5, 4 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, 0.5, 9, 9);
  const ReferenceImage image = scene.Render(function, grid);
  for (int pixel = 0; pixel < 81; ++pixel)
  {
    EXPECT_NEAR(image.Rgba[4 * pixel + 1], 1 - std::exp(-2.0), 1e-14);
    EXPECT_NEAR(image.Rgba[4 * pixel + 0], std::exp(-2.0) * (1 - std::exp(-0.5)), 1e-14);
    EXPECT_NEAR(image.Rgba[4 * pixel + 3], 1 - std::exp(-2.5), 1e-14);
  }
}

TEST(Reference, UnusableCellsAddNothing)
{
  // A good cell, then one for each thing that can be wrong.
  const Scene good = MakeUnitTetrahedron();
  Scene scene = good;
  const double infinity = std::numeric_limits<double>::infinity();
  scene.Mesh.Points.insert(
    scene.Mesh.Points.end(), { NaN, 0, 0, 0, infinity, 0, 1, 1, 1, -1, 0.5, 0.5 });
  scene.Scalars.insert(scene.Scalars.end(), { 0, 0, NaN, infinity });
  const std::int32_t unusable[][4] = { { 0, 1, 2, 4 }, { 0, 1, 2, 5 }, { 1, 2, 3, 6 },
    { 0, 2, 3, 7 }, { 0, 1, 2, 8 }, { 0, 1, 2, -1 }, { 0, 1, 2, 2 } };
  for (const auto& cell : unusable)
  {
    scene.Mesh.Cells.insert(scene.Mesh.Cells.end(), cell, cell + 4);
  }
  const RayGrid grid = MakePerspectiveGrid({ 2, 3, 4 }, { 0.4, 0.4, 0.4 }, { 0, 1, 0 }, 40, 25, 25);
  const ReferenceImage image = scene.Render(Grey, grid);
  const ReferenceImage expected = good.Render(Grey, grid);
  EXPECT_EQ(image.Rgba, expected.Rgba);
  EXPECT_GT(*std::max_element(image.Rgba.begin(), image.Rgba.end()), 0.1);
}

TEST(Reference, RendersOnlyThePixelsAskedFor)
{
  const Scene scene = MakeConstantScene(MakeBox(3, 3, 3, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, 3));
  const RayGrid grid =
    MakePerspectiveGrid({ 1.5, 1.9, 2.3 }, { 0.5, 0.5, 0.5 }, { 0, 1, 0 }, 30, 24, 24);
  std::vector<std::uint8_t> pixels(24 * 24, 0);
  pixels[24 * 11 + 12] = 1;
  const ReferenceImage whole = scene.Render(Grey, grid);
  const ReferenceImage image = scene.Render(Grey, grid, {}, pixels);
  for (std::size_t pixel = 0; pixel < pixels.size(); ++pixel)
  {
    EXPECT_EQ(image.Rgba[4 * pixel + 3], pixels[pixel] ? whole.Rgba[4 * pixel + 3] : 0);
    EXPECT_EQ(image.Depth[pixel], pixels[pixel] ? whole.Depth[pixel] : -1);
  }
  EXPECT_GT(image.Rgba[4 * (24 * 11 + 12) + 3], 0.5);

  const ReferenceImage tile = scene.Render(Grey, MakeTile(grid, 5, 7, 10, 6));
  for (int pixel = 0; pixel < 60; ++pixel)
  {
    const int other = 5 + pixel % 10 + 24 * (7 + pixel / 10);
    EXPECT_NEAR(tile.Rgba[4 * pixel + 3], whole.Rgba[4 * other + 3], 1e-14);
  }
}

TEST(Reference, RefusesSizesThatDoNotFit)
{
  Scene scene = MakeUnitTetrahedron();
  const RayGrid grid = MakeSingleRay({ 0, 0, 2 }, { 0, 0, 0 });
  EXPECT_THROW(scene.Render(TransferFunction(), grid), std::invalid_argument);
  EXPECT_THROW(scene.Render(Grey, RayGrid()), std::invalid_argument);
  scene.Scalars.pop_back();
  EXPECT_THROW(scene.Render(Grey, grid), std::invalid_argument);
}

TEST(Reference, GrazingFindsSilhouettesAndOnlyThem)
{
  // One column of pixels straddles the side of a box, seen along its faces, at half the
  // displacement; a second box is seen obliquely, so that the picture kinks at its edges.
  const Scene box =
    MakeLinearScene(MakeBox(3, 3, 3, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, 3), { 0.5, 0.3, 0.2 }, 0);
  const TransferFunction smooth =
    MakeLinearFunction({ { 0, 1, 0, 0.2, 0.6 }, { 0.5, 0, 1, 0, 2 }, { 1, 1, 1, 0, 1 } });
  const int size = 32;
  const double pixel = 1.5 / size;
  const double center = pixel * (size / 2.0 - 0.5 + 5e-4); // column 0 is at x = 5e-4 pixel
  const RayGrid grid =
    MakeParallelGrid({ center, 0.7, 3 }, { center, 0.7, 0 }, { 0, 1, 0 }, 0.75, size, size);
  const ReferenceImage image = box.Render(smooth, grid);
  const std::vector<double> grazing = MeasureGrazing(box.View(), smooth, grid, {}, image);
  for (int j = 0; j < size; ++j)
  {
    for (int i = 0; i < size; ++i)
    {
      const double y = 0.7 + pixel * (j + 0.5 - size / 2.0);
      EXPECT_EQ(grazing[size * j + i] > GrazingThreshold, i == 0 && y > 0 && y < 1)
        << i << ' ' << j << ' ' << grazing[size * j + i];
    }
  }

  const RayGrid oblique =
    MakePerspectiveGrid({ 1.5, 1.9, 2.3 }, { 0.5, 0.5, 0.5 }, { 0, 1, 0 }, 30, 64, 64);
  const ReferenceImage obliqueImage = box.Render(smooth, oblique);
  const std::vector<double> measure = MeasureGrazing(box.View(), smooth, oblique, {}, obliqueImage);
  const auto grazed = std::count_if(
    measure.begin(), measure.end(), [](double value) { return value > GrazingThreshold; });
  EXPECT_LT(grazed, 10);
  EXPECT_TRUE(MeasureGrazing(box.View(), smooth, oblique, {}, obliqueImage,
                std::vector<std::uint8_t>(64 * 64, 0)) == std::vector<double>(64 * 64, 0.0));
}

} // namespace
