// SPDX-License-Identifier: BSD-3-Clause
// Light in shaders against that of ReferenceShading.h.

#include "GlslEvaluator.h"
#include "GpuIntegral/GpuLighting.h"
#include "GpuIntegral/GpuSegmentIntegral.h"
#include "GpuIntegral/RayGridUniforms.h"
#include "Integral/RayIntegral.h"
#include "Optics/IntervalTable.h"
#include "ReferenceIntegral.h"
#include "ReferenceShading.h"

#include "vtkShaderProgram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <stdexcept>

namespace
{

using tetralux::Light;
using tetralux::ReferenceLight;
using Arguments = GlslEvaluator::Arguments;
using Result = GlslEvaluator::Result;
using Vector = std::array<double, 3>;

/// Factors are sums of products of single precision, with powers.
constexpr double FactorError = 5e-6;

Light MakeLight(const Vector& position, bool positional)
{
  Light light{};
  std::copy(position.begin(), position.end(), light.Position);
  light.Positional = positional;
  for (int c = 0; c < 3; ++c)
  {
    light.Ambient[c] = 0.2f + 0.1f * static_cast<float>(c);
    light.Diffuse[c] = 0.9f - 0.2f * static_cast<float>(c);
    light.Specular[c] = 0.5f + 0.1f * static_cast<float>(c);
  }
  return light;
}

class GpuLightingTest : public testing::Test
{
public:
  GpuLightingTest()
  {
    // Coordinates of the world turned, stretched and moved.
    const double rows[3][4] = { { 0.5, -1, 0, 3 }, { 1, 0.4, 0.1, -2 }, { 0, 0.2, 2, 1 } };
    std::copy_n(&rows[0][0], 12, &this->Grid.MeshFromWorld[0][0]);
  }

  /// The light in the reference, for a gradient in coordinates of the mesh.
  ReferenceLight FindLight(
    const Vector& gradient, const Vector& point, const Vector& direction) const
  {
    Vector normal;
    for (int a = 0; a < 3; ++a)
    {
      normal[a] = 0;
      for (int row = 0; row < 3; ++row)
      {
        normal[a] += this->Grid.MeshFromWorld[row][a] * gradient[row];
      }
    }
    return tetralux::FindReferenceLight(
      this->Surface, this->Lights, point, normal, { -direction[0], -direction[1], -direction[2] });
  }

  Vector ToMesh(const Vector& x, bool point) const
  {
    Vector result;
    for (int a = 0; a < 3; ++a)
    {
      const double* row = this->Grid.MeshFromWorld[a];
      result[a] = row[0] * x[0] + row[1] * x[1] + row[2] * x[2] + (point ? row[3] : 0);
    }
    return result;
  }

  /// Points of the world near the mesh, directions of length 1, and both as a shader gets them.
  struct LightCases
  {
    std::vector<Vector> Points;
    std::vector<Vector> Directions;
    std::vector<Arguments> InMesh;
  };

  LightCases MakeCases() const
  {
    LightCases cases;
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 300; ++i)
    {
      Vector direction = { normal(random), normal(random), normal(random) };
      const double length = std::hypot(direction[0], direction[1], direction[2]);
      for (double& x : direction)
      {
        x /= length;
      }
      cases.Directions.push_back(direction);
      cases.Points.push_back({ 13 + normal(random), -5 + normal(random), 15 + normal(random) });
      cases.InMesh.push_back(this->MakeArguments(cases.Points.back(), direction));
    }
    return cases;
  }

  Arguments MakeArguments(const Vector& point, const Vector& direction) const
  {
    const Vector p = this->ToMesh(point, true);
    const Vector d = this->ToMesh(direction, false);
    const double unit = tetralux::GetRayLengthUnit(this->Grid, this->Radius);
    Arguments arguments{};
    for (int a = 0; a < 3; ++a)
    {
      arguments[a] = static_cast<float>((p[a] - this->Center[a]) / this->Radius);
      arguments[4 + a] = static_cast<float>(unit * d[a] / this->Radius);
    }
    return arguments;
  }

  void ExpectFactors()
  {
    const LightCases cases = this->MakeCases();
    tetralux::GpuLighting lighting;
    lighting.Update(this->Lights, this->Surface, {}, this->Grid, this->Center.data(), this->Radius);
    const std::string gradient = "vec3(" + std::to_string(this->Gradient[0]) + ", " +
      std::to_string(this->Gradient[1]) + ", " + std::to_string(this->Gradient[2]) + ")";
    double worst = 0;
    for (const bool add : { false, true })
    {
      const std::vector<Result> results = this->Evaluator.Evaluate(lighting.GetDeclarations(),
        "vec4(FindLight(a.xyz, " + gradient + ", b.xyz)." + (add ? "Add" : "Scale") + ", 0.0)",
        cases.InMesh, [&](vtkShaderProgram* program) { lighting.Set(program); });
      for (std::size_t i = 0; i < cases.InMesh.size(); ++i)
      {
        const ReferenceLight expected =
          this->FindLight(this->Gradient, cases.Points[i], cases.Directions[i]);
        for (int c = 0; c < 3; ++c)
        {
          worst = std::max<double>(
            worst, std::abs(results[i][c] - (add ? expected.Add[c] : expected.Scale[c])));
        }
      }
    }
    std::cout << "error " << worst << "\n";
    EXPECT_LE(worst, FactorError);
  }

  /// What a call in GLSL gives of lit segments.
  std::vector<Result> EvaluateSegments(const tetralux::GpuLighting& lighting,
    const tetralux::SegmentSource& source, const LightCases& cases, const std::string& call)
  {
    tetralux::GpuSegmentIntegral integral;
    integral.Update(this->Evaluator.Window, source);
    const std::vector<Result> results = this->Evaluator.Evaluate(
      lighting.GetDeclarations() + integral.GetDeclarations(), call, cases.InMesh,
      [&](vtkShaderProgram* program)
      {
        lighting.Set(program);
        integral.Activate(program);
      },
      [&] { integral.Deactivate(); });
    integral.ReleaseGraphicsResources(this->Evaluator.Window);
    return results;
  }

  GlslEvaluator Evaluator;
  std::vector<Light> Lights;
  tetralux::Material Surface = { 0.3f, 0.6f, 0.4f, 12.f };
  tetralux::RayGrid Grid;
  Vector Gradient = { 0, 0, 0 };
  Vector Center = { 10.5, 20.5, 30.5 };
  double Radius = 2;
};

TEST_F(GpuLightingTest, DistantLights)
{
  this->Gradient = { 0.5, -1, 2 };
  this->Lights = { MakeLight({ 0.6, 0, 0.8 }, false), MakeLight({ 0, -1, 0 }, false) };
  this->ExpectFactors();
}

TEST_F(GpuLightingTest, PositionalLightsAndSpots)
{
  this->Gradient = { 0.5, -1, 2 };
  Light far = MakeLight({ 20, 3, 40 }, true);
  far.Attenuation[0] = 0.5;
  far.Attenuation[1] = 0.02;
  far.Attenuation[2] = 0.001;
  Light spot = MakeLight({ 13, -5, 18 }, true);
  spot.ConeCosine = 0.8;
  spot.Exponent = 3;
  this->Lights = { far, spot };
  this->ExpectFactors();
}

TEST_F(GpuLightingTest, WithoutAGradientSurfacesFaceTheViewer)
{
  this->Gradient = { 0, 0, 0 };
  this->Lights = { MakeLight({ 0.6, 0, 0.8 }, false) };
  this->ExpectFactors();
}

TEST_F(GpuLightingTest, NoLightsAreBlack)
{
  tetralux::GpuLighting lighting;
  lighting.Update({}, this->Surface, {}, this->Grid, this->Center.data(), this->Radius);
  const std::vector<Result> results = this->Evaluator.Evaluate(lighting.GetDeclarations(),
    "vec4(FindLight(a.xyz, b.xyz, b.xyz).Scale + FindLight(a.xyz, b.xyz, b.xyz).Add, a.x)",
    { { 0.5f, 0, 0, 0, 0, 0, 1 } }, [&](vtkShaderProgram* program) { lighting.Set(program); });
  EXPECT_EQ(results.front(), (Result{ 0, 0, 0, 0.5f }));
}

TEST_F(GpuLightingTest, MoreLightsThanShadersTakeAreAnError)
{
  const std::vector<Light> lights(
    tetralux::GpuLighting::LargestNumberOfLights + 1, MakeLight({ 0.6, 0, 0.8 }, false));
  tetralux::GpuLighting lighting;
  EXPECT_THROW(
    lighting.Update(lights, this->Surface, {}, this->Grid, this->Center.data(), this->Radius),
    std::invalid_argument);
}

TEST_F(GpuLightingTest, LitSegments)
{
  this->Gradient = { 0.5, -1, 2 };
  this->Lights = { MakeLight({ 0.6, 0, 0.8 }, false) };
  tetralux::GpuLighting lighting;
  lighting.Update(this->Lights, this->Surface, {}, this->Grid, this->Center.data(), this->Radius);
  tetralux::TransferFunction function;
  function.Nodes = { { -1, { { 1, 0, 0.5 }, 0.5 }, { { 1, 0, 0.5 }, 0.5 } },
    { 1, { { 0, 1, 0.25 }, 2 }, { { 0, 1, 0.25 }, 2 } } };
  const tetralux::IntervalTable table = tetralux::MakeIntervalTable(function);
  const std::vector<tetralux::Isosurface> surfaces = { { -0.25, { 1, 0.5f, 0 }, 0.5f },
    { 0.5, { 0, 0.5f, 1 }, 0.75f } };
  const LightCases cases = this->MakeCases();
  constexpr double Front = 0.75;
  constexpr double Back = -0.5;
  constexpr double Length = 1.5;
  for (const bool volume : { true, false })
  {
    tetralux::SegmentSource source;
    source.Integrator =
      volume ? tetralux::Integrator::LitClosedForm : tetralux::Integrator::Isosurfaces;
    source.Intervals = &table;
    source.Surfaces = surfaces;
    source.ShadedSurfaces = !volume;
    const std::vector<Result> results = this->EvaluateSegments(lighting, source, cases,
      "IntegrateShadedSegment(0.75, -0.5, 1.5, vec3(0.5, -1.0, 2.0), vec3(0.5, -1.0, 2.0), "
      "a.xyz, a.xyz + 1.5 * b.xyz, b.xyz)");
    const tetralux::SegmentRadiance flat =
      tetralux::IntegrateEmissionAbsorption(function, Front, Back, Length);
    for (std::size_t i = 0; i < cases.InMesh.size(); ++i)
    {
      // A place does not change the light of a distant light.
      const ReferenceLight light =
        this->FindLight(this->Gradient, cases.Points[i], cases.Directions[i]);
      double expected[4] = { 0, 0, 0, volume ? flat.Opacity : 1 - 0.25 * 0.5 };
      for (int c = 0; c < 3; ++c)
      {
        const auto lit = [&](int surface)
        { return std::clamp(surfaces[surface].Color[c] * light.Scale[c] + light.Add[c], 0., 1.); };
        expected[c] = volume ? flat.Color[c] * light.Scale[c] + flat.Opacity * light.Add[c]
                             : 0.75 * lit(1) + 0.25 * 0.5 * lit(0);
      }
      for (int c = 0; c < 4; ++c)
      {
        EXPECT_NEAR(results[i][c], expected[c], FactorError);
      }
    }
  }
}

TEST_F(GpuLightingTest, GradientsAndPlacesRunAlongASegment)
{
  // The gradient turns from one end to the other, and a near light shines.
  this->Lights = { MakeLight({ 13, -5, 16 }, true) };
  this->Lights[0].Attenuation[2] = 0.1;
  tetralux::GpuLighting lighting;
  lighting.Update(this->Lights, this->Surface, {}, this->Grid, this->Center.data(), this->Radius);
  const LightCases cases = this->MakeCases();
  const std::vector<tetralux::Isosurface> surfaces = { { 0.25, { 1, 0.5f, 0.25f }, 1 } };
  tetralux::SegmentSource source;
  source.Integrator = tetralux::Integrator::Isosurfaces;
  source.Surfaces = surfaces;
  source.ShadedSurfaces = true;
  const std::vector<Result> results = this->EvaluateSegments(lighting, source, cases,
    "IntegrateShadedSegment(0.0, 1.0, 1.0, vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.5), "
    "a.xyz, a.xyz + b.xyz / " +
      std::to_string(tetralux::GetRayLengthUnit(this->Grid, this->Radius)) + ", b.xyz)");
  for (std::size_t i = 0; i < cases.InMesh.size(); ++i)
  {
    const Vector place = { cases.Points[i][0] + 0.25 * cases.Directions[i][0],
      cases.Points[i][1] + 0.25 * cases.Directions[i][1],
      cases.Points[i][2] + 0.25 * cases.Directions[i][2] };
    const ReferenceLight light = this->FindLight({ 0.75, 0.25, 0.125 }, place, cases.Directions[i]);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(results[i][c],
        std::clamp(surfaces[0].Color[c] * light.Scale[c] + light.Add[c], 0., 1.), FactorError);
    }
  }
}

// The integral of what is lit, against quadrature: gradients that turn through the viewer and away
// from a light, a near light that fades, a spot whose cone is passed, and thick pieces.
TEST_F(GpuLightingTest, LightThatVariesAlongASegment)
{
  Light fading = MakeLight({ 13, -5, 16.5 }, true);
  fading.Attenuation[2] = 0.1;
  Light spot = MakeLight({ 13, -4, 17 }, true);
  spot.ConeCosine = 0.8;
  spot.Exponent = 3;
  spot.Axis[0] = 0;
  spot.Axis[1] = -0.6;
  spot.Axis[2] = -0.8;
  tetralux::TransferFunction function;
  function.Nodes = { { -1, { { 1, 0, 0.5 }, 0.5 }, { { 1, 0, 0.5 }, 0.5 } },
    { 0.1, { { 0.5, 1, 0.25 }, 20 }, { { 0, 1, 0.25 }, 0.2 } },
    { 1, { { 0, 1, 0.25 }, 2 }, { { 0, 1, 0.25 }, 2 } } };
  const tetralux::IntervalTable table = tetralux::MakeIntervalTable(function);
  constexpr double Front = 0.75;
  constexpr double Back = -0.5;
  constexpr double Length = 1.5;
  const Vector frontGradient = { 1, -0.5, 0.3 };
  const Vector backGradient = { -0.9, 1, 0.5 };
  constexpr double Error = 1e-5;
  const LightCases cases = this->MakeCases();
  for (const std::vector<Light>& lights :
    { std::vector<Light>{ MakeLight({ 0.6, 0, 0.8 }, false) }, { fading }, { spot } })
  {
    this->Lights = lights;
    tetralux::GpuLighting lighting;
    lighting.Update(this->Lights, this->Surface,
      tetralux::FindLightSteps(this->Lights, this->Surface, Error), this->Grid, this->Center.data(),
      this->Radius);
    tetralux::SegmentSource source;
    source.Integrator = tetralux::Integrator::VaryingLight;
    source.Intervals = &table;
    const std::vector<Result> results = this->EvaluateSegments(lighting, source, cases,
      "IntegrateShadedSegment(0.75, -0.5, 1.5, vec3(1.0, -0.5, 0.3), vec3(-0.9, 1.0, 0.5), "
      "a.xyz, a.xyz + 1.5 * b.xyz / " +
        std::to_string(tetralux::GetRayLengthUnit(this->Grid, this->Radius)) + ", b.xyz)");
    double worst = 0;
    for (std::size_t i = 0; i < cases.InMesh.size(); ++i)
    {
      const auto light = [&](double share)
      {
        Vector gradient, point;
        for (int a = 0; a < 3; ++a)
        {
          gradient[a] = (1 - share) * frontGradient[a] + share * backGradient[a];
          point[a] = cases.Points[i][a] + share * Length * cases.Directions[i][a];
        }
        return this->FindLight(gradient, point, cases.Directions[i]);
      };
      const tetralux::ReferenceSegment expected =
        tetralux::IntegrateLitReference(function, Front, Back, Length, light);
      for (int c = 0; c < 3; ++c)
      {
        worst = std::max(worst, std::abs(results[i][c] - expected.Color[c]));
      }
      EXPECT_NEAR(results[i][3], expected.Alpha, FactorError);
    }
    std::cout << "error " << worst << "\n";
    EXPECT_LE(worst, Error + FactorError);
  }
}

} // namespace
