// SPDX-License-Identifier: BSD-3-Clause
#include "GpuIntegral/GpuLighting.h"

#include "GpuIntegral/RayGridUniforms.h"
#include "LightAlongRayDec.h"
#include "LightingDec.h"

#include "vtkMatrix3x3.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tetralux
{
namespace
{

using Vector = std::array<double, 3>;

/// In the place of a cone's sine, see LightingDec.glsl.
constexpr float NoCone = 2;

/// Coordinates of the mesh into those of the world.
Vector Transform(const double worldFromMesh[9], const Vector& x)
{
  Vector result;
  for (int a = 0; a < 3; ++a)
  {
    const double* row = &worldFromMesh[3 * a];
    result[a] = row[0] * x[0] + row[1] * x[1] + row[2] * x[2];
  }
  return result;
}

/// The nearest number that is not infinite.
float ToSingle(double x)
{
  constexpr double Largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -Largest, Largest));
}

} // namespace

void GpuLighting::Update(const std::vector<Light>& lights, const Material& surface,
  const LightSteps& steps, const RayGrid& grid, const double center[3], double radius)
{
  if (lights.size() > LargestNumberOfLights)
  {
    throw std::invalid_argument(std::to_string(lights.size()) +
      " lights shine; methods of the graphics card take at most " +
      std::to_string(LargestNumberOfLights) + ", ray-cast takes any number");
  }
  double meshFromWorld[9];
  Vector offset;
  double largest = 0;
  for (int a = 0; a < 3; ++a)
  {
    for (int b = 0; b < 3; ++b)
    {
      meshFromWorld[3 * a + b] = grid.MeshFromWorld[a][b];
      largest = std::max(largest, std::abs(grid.MeshFromWorld[a][b]));
    }
    offset[a] = center[a] - grid.MeshFromWorld[a][3];
  }
  if (vtkMatrix3x3::Determinant(meshFromWorld) == 0)
  {
    throw std::invalid_argument("the volume's matrix has no inverse");
  }
  double worldFromMesh[9];
  vtkMatrix3x3::Invert(meshFromWorld, worldFromMesh);
  const double unit = GetRayLengthUnit(grid, radius);
  const Vector worldCenter = Transform(worldFromMesh, offset);
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      this->WorldFromRay[3 * column + row] =
        static_cast<float>(radius / unit * worldFromMesh[3 * row + column]);
      // Gradients are transformed by the transposed inverse.
      this->NormalFromMesh[3 * column + row] =
        static_cast<float>(meshFromWorld[3 * column + row] / largest);
    }
  }
  // 0 to the power of 0 is 1, in shaders too: see LightingDec.glsl.
  this->SpecularPower = surface.SpecularPower;
  this->Steps = steps;
  this->Shines = false;
  for (auto* vectors : { &this->Positions, &this->Cones, &this->Falloffs })
  {
    vectors->clear();
  }
  for (auto* vectors : { &this->Ambient, &this->Diffuse, &this->Specular, &this->AcrossAxes })
  {
    vectors->clear();
  }
  const auto scale = [](float factor, const float(&color)[3]) -> Vector3 {
    return { factor * color[0], factor * color[1], factor * color[2] };
  };
  for (const Light& light : lights)
  {
    Vector4 position, cone, falloff;
    // Farther than this the light is a distant one for single precision.
    constexpr double Farthest = 1e15;
    double largest = Farthest;
    for (int a = 0; a < 3 && light.Positional; ++a)
    {
      largest = std::max(largest, std::abs(light.Position[a] - worldCenter[a]) / unit);
    }
    double power = 1; // of the unit
    for (int a = 0; a < 3; ++a)
    {
      position[a] = ToSingle(light.Positional
          ? (light.Position[a] - worldCenter[a]) / unit * (Farthest / largest)
          : light.Position[a]);
      cone[a] = static_cast<float>(light.Axis[a]);
      falloff[a] = ToSingle(power * light.Attenuation[a]);
      power *= unit;
    }
    position[3] = light.Positional ? 1.f : 0.f;
    // Narrow cones have a sine with all of its digits.
    const double sine = std::sqrt(std::max(0., 1 - light.ConeCosine * light.ConeCosine));
    cone[3] =
      light.ConeCosine <= -1 ? NoCone : static_cast<float>(light.ConeCosine < 0 ? -sine : sine);
    falloff[3] = static_cast<float>(light.Exponent);
    Vector3 across;
    for (int a = 0; a < 3; ++a)
    {
      const int b = (a + 1) % 3;
      const int c = (a + 2) % 3;
      across[a] = ToSingle((light.Position[b] - worldCenter[b]) / unit * light.Axis[c] -
        (light.Position[c] - worldCenter[c]) / unit * light.Axis[b]);
    }
    this->AcrossAxes.push_back(across);
    this->Positions.push_back(position);
    this->Cones.push_back(cone);
    this->Falloffs.push_back(falloff);
    this->Ambient.push_back(scale(surface.Ambient, light.Ambient));
    this->Diffuse.push_back(scale(surface.Diffuse, light.Diffuse));
    this->Specular.push_back(scale(surface.Specular, light.Specular));
    for (const float specular : this->Specular.back())
    {
      this->Shines = this->Shines || specular != 0;
    }
  }
}

std::string GpuLighting::GetDeclarations() const
{
  std::string defines = "#define NUMBER_OF_LIGHTS " + std::to_string(this->Positions.size()) + "\n";
  const auto any = [](const std::vector<Vector4>& rows, auto holds)
  { return std::any_of(rows.begin(), rows.end(), holds); };
  defines += any(this->Positions, [](const Vector4& position) { return position[3] > 0; })
    ? "#define POSITIONAL_LIGHTS\n"
    : "";
  defines += any(this->Cones, [](const Vector4& cone) { return cone[3] != NoCone; })
    ? "#define SPOTS\n"
    : "";
  defines += this->Shines ? "#define HIGHLIGHTS\n" : "";
  return defines + LightingDec + LightAlongRayDec;
}

void GpuLighting::Set(vtkShaderProgram* program) const
{
  const int count = static_cast<int>(this->Positions.size());
  if (count == 0)
  {
    return;
  }
  program->SetUniformMatrix3x3("worldFromRay", const_cast<float*>(this->WorldFromRay)); // only read
  program->SetUniformMatrix3x3("normalFromMesh", const_cast<float*>(this->NormalFromMesh));
  program->SetUniformf("specularPower", this->SpecularPower);
  program->SetUniformf("lightTurn", static_cast<float>(this->Steps.Turn));
  program->SetUniformf("lightApproach", static_cast<float>(this->Steps.Approach));
  program->SetUniform4fv("lightPositions", count, this->Positions.front().data());
  program->SetUniform4fv("lightCones", count, this->Cones.front().data());
  program->SetUniform4fv("lightFalloffs", count, this->Falloffs.front().data());
  program->SetUniform3fv("lightAcrossAxes", count, this->AcrossAxes.front().data());
  program->SetUniform3fv("lightAmbient", count, this->Ambient.front().data());
  program->SetUniform3fv("lightDiffuse", count, this->Diffuse.front().data());
  program->SetUniform3fv("lightSpecular", count, this->Specular.front().data());
}

} // namespace tetralux
