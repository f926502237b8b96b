// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GeneratedShape_h
#define tetralux_GeneratedShape_h

#include "Generate/GeneratedMesh.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tetralux
{

constexpr double Pi = 3.14159265358979323846;

inline double Square(double value) { return value * value; }

/// The values of a generator's parameters, all of them given and in range.
class Values
{
public:
  explicit Values(const std::map<std::string, double>& values)
    : Given(values)
  {
  }
  double Get(const char* name) const { return this->Given.at(name); }
  int GetCount(const char* name) const { return static_cast<int>(this->Given.at(name)); }

private:
  const std::map<std::string, double>& Given;
};

/// A named shape and what makes it.
struct Recipe
{
  const char* Name;
  const char* Description;
  std::vector<GeneratorParameter> Parameters;
  std::vector<std::string> WholeNumbers; ///< the parameters that count something
  void (*Make)(const Values& values, GeneratedMesh& result);
};

/// Evaluates field(x, y, z) at each point of the mesh.
template <class Field>
void SetScalars(GeneratedMesh& result, const Field& field)
{
  const auto numberOfPoints = static_cast<std::int64_t>(result.Mesh.GetNumberOfPoints());
  result.Scalars.resize(numberOfPoints);
#pragma omp parallel for schedule(static)
  for (std::int64_t point = 0; point < numberOfPoints; ++point)
  {
    const double* position = &result.Mesh.Points[3 * point];
    result.Scalars[point] = field(position[0], position[1], position[2]);
  }
}

/// A field with structure in all directions: the gyroid, shifted and scaled to 0 ... 1.
/// wavelength: in the units of the coordinates.
inline double GetGyroid(double x, double y, double z, double wavelength)
{
  const double frequency = 2 * Pi / wavelength;
  const double gyroid = std::sin(frequency * x) * std::cos(frequency * y) +
    std::sin(frequency * y) * std::cos(frequency * z) +
    std::sin(frequency * z) * std::cos(frequency * x);
  return 0.5 + gyroid / 3;
}

/// The shapes: each adds its mesh and its scalars to an empty result.
// RoundShapes.cxx
void MakeRing(const Values& values, GeneratedMesh& result);
void MakeBall(const Values& values, GeneratedMesh& result);
void MakeSwingingBall(const Values& values, GeneratedMesh& result);
void MakeCylinderWithHole(const Values& values, GeneratedMesh& result);
void MakeGear(const Values& values, GeneratedMesh& result);
void MakeHelicalGear(const Values& values, GeneratedMesh& result);

// BlockShapes.cxx
void MakeCubes(const Values& values, GeneratedMesh& result);
void MakeCavity(const Values& values, GeneratedMesh& result);
void MakeSharedEdge(const Values& values, GeneratedMesh& result);
void MakeCheckerboard(const Values& values, GeneratedMesh& result);
void MakeHeatSink(const Values& values, GeneratedMesh& result);

// HardShapes.cxx
void MakeBoundaryLayer(const Values& values, GeneratedMesh& result);
void MakeSchoenhardt(const Values& values, GeneratedMesh& result);
void MakeCycle(const Values& values, GeneratedMesh& result);
void MakeRandom(const Values& values, GeneratedMesh& result);

} // namespace tetralux

#endif
