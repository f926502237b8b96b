// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceScenes.h"

#include <cmath>
#include <random>
#include <stdexcept>

namespace tetralux
{
namespace
{

using Vector = std::array<double, 3>;

Vector Subtract(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

Vector Normalize(const Vector& v)
{
  const double length = std::hypot(v[0], v[1], v[2]);
  return { v[0] / length, v[1] / length, v[2] / length };
}

/// Right, up and forward of a camera, of length 1.
struct Frame
{
  Frame(const Vector& position, const Vector& focalPoint, const Vector& viewUp)
    : Forward(Normalize(Subtract(focalPoint, position)))
    , Right(Normalize(Cross(this->Forward, viewUp)))
    , Up(Cross(this->Right, this->Forward))
  {
  }
  Vector Forward;
  Vector Right;
  Vector Up;
};

/// Spreads the pixel centres of a window over begin + x Right + y Up; halfHeight: of the window.
void SpreadPixels(const Frame& frame, double halfHeight, int width, int height, double begin[3],
  double stepX[3], double stepY[3])
{
  const double pixel = 2 * halfHeight / height; // pixels are square
  for (int axis = 0; axis < 3; ++axis)
  {
    stepX[axis] = pixel * frame.Right[axis];
    stepY[axis] = pixel * frame.Up[axis];
    begin[axis] += 0.5 * (1 - width) * stepX[axis] + 0.5 * (1 - height) * stepY[axis];
  }
}

/// A grid whose rays all are that of the window's middle.
RayGrid MakeGridOfCentralRay(const Frame& frame, const Vector& position, int width, int height)
{
  RayGrid grid;
  grid.Width = width;
  grid.Height = height;
  for (int axis = 0; axis < 3; ++axis)
  {
    grid.Origin[axis] = position[axis];
    grid.Direction[axis] = frame.Forward[axis];
  }
  return grid;
}

} // namespace

RayGrid MakePerspectiveGrid(const Vector& position, const Vector& focalPoint, const Vector& viewUp,
  double viewAngle, int width, int height)
{
  const Frame frame(position, focalPoint, viewUp);
  RayGrid grid = MakeGridOfCentralRay(frame, position, width, height);
  const double degree = std::acos(-1.0) / 180;
  SpreadPixels(frame, std::tan(0.5 * viewAngle * degree), width, height, grid.Direction,
    grid.DirectionStepX, grid.DirectionStepY);
  return grid;
}

RayGrid MakeParallelGrid(const Vector& position, const Vector& focalPoint, const Vector& viewUp,
  double parallelScale, int width, int height)
{
  const Frame frame(position, focalPoint, viewUp);
  RayGrid grid = MakeGridOfCentralRay(frame, position, width, height);
  SpreadPixels(
    frame, parallelScale, width, height, grid.Origin, grid.OriginStepX, grid.OriginStepY);
  return grid;
}

RayGrid MakeTile(const RayGrid& grid, int x, int y, int width, int height)
{
  RayGrid tile = grid;
  tile.Width = width;
  tile.Height = height;
  for (int axis = 0; axis < 3; ++axis)
  {
    tile.Origin[axis] += x * grid.OriginStepX[axis] + y * grid.OriginStepY[axis];
    tile.Direction[axis] += x * grid.DirectionStepX[axis] + y * grid.DirectionStepY[axis];
  }
  return tile;
}

void PlaceMesh(RayGrid& grid, const double worldFromMesh[3][4])
{
  Vector columns[4];
  for (int column = 0; column < 4; ++column)
  {
    for (int row = 0; row < 3; ++row)
    {
      columns[column][row] = worldFromMesh[row][column];
    }
  }
  const Vector rows[3] = { Cross(columns[1], columns[2]), Cross(columns[2], columns[0]),
    Cross(columns[0], columns[1]) };
  const double determinant =
    columns[0][0] * rows[0][0] + columns[0][1] * rows[0][1] + columns[0][2] * rows[0][2];
  if (!std::isnormal(determinant))
  {
    throw std::invalid_argument("PlaceMesh: the matrix has no inverse");
  }
  for (int row = 0; row < 3; ++row)
  {
    grid.MeshFromWorld[row][3] = 0;
    for (int column = 0; column < 3; ++column)
    {
      grid.MeshFromWorld[row][column] = rows[row][column] / determinant;
      grid.MeshFromWorld[row][3] -= grid.MeshFromWorld[row][column] * columns[3][column];
    }
  }
}

void AddClippingRange(RayLimits& limits, const Vector& position, const Vector& focalPoint,
  double nearDistance, double farDistance)
{
  const Vector forward = Normalize(Subtract(focalPoint, position));
  const double offset =
    forward[0] * position[0] + forward[1] * position[1] + forward[2] * position[2];
  limits.Planes.push_back({ forward[0], forward[1], forward[2], -(offset + nearDistance) });
  limits.Planes.push_back({ -forward[0], -forward[1], -forward[2], offset + farDistance });
}

TransferFunction MakeConstantFunction(double attenuation, const Vector& color)
{
  return MakeLinearFunction({ { 0, color[0], color[1], color[2], attenuation } });
}

TransferFunction MakeLinearFunction(const std::vector<std::array<double, 5>>& points)
{
  TransferFunction function;
  for (const auto& point : points)
  {
    const TransferFunction::Value value{ { point[1], point[2], point[3] }, point[4] };
    function.Nodes.push_back({ point[0], value, value });
  }
  return function;
}

TransferFunction MakeFunctionWithSteps()
{
  TransferFunction function;
  function.Nodes = {
    { 0.0, { { 0.1, 0.9, 0.3 }, 0.5 }, { { 0.8, 0.2, 0.4 }, 0.0 } },
    { 0.4, { { 0.7, 0.1, 0.0 }, 0.0 }, { { 0.2, 0.6, 1.0 }, 7.0 } },
    { 1.0, { { 0.0, 1.0, 0.5 }, 2.0 }, { { 0.9, 0.9, 0.2 }, 11.0 } },
  };
  return function;
}

TetrahedralMesh MakeBox(int nx, int ny, int nz, const Vector& lower, const Vector& upper,
  double jitter, std::uint64_t seed)
{
  // Corners of a hexahedron as bits (x, y, z): four corner tetrahedra around the inner one that
  // joins the even corners; in odd hexahedra, mirrored along x, so that shared faces agree.
  static constexpr int Split[5][4] = { { 1, 0, 3, 5 }, { 2, 0, 6, 3 }, { 4, 0, 5, 6 },
    { 7, 3, 6, 5 }, { 0, 3, 5, 6 } };

  TetrahedralMesh mesh;
  const int counts[3] = { nx, ny, nz };
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> displacement(-jitter, jitter);
  int ijk[3];
  for (ijk[2] = 0; ijk[2] <= nz; ++ijk[2])
  {
    for (ijk[1] = 0; ijk[1] <= ny; ++ijk[1])
    {
      for (ijk[0] = 0; ijk[0] <= nx; ++ijk[0])
      {
        bool inner = true;
        for (int axis = 0; axis < 3; ++axis)
        {
          inner = inner && ijk[axis] > 0 && ijk[axis] < counts[axis];
        }
        for (int axis = 0; axis < 3; ++axis)
        {
          const double shift = inner && jitter > 0 ? displacement(generator) : 0;
          const double share = (ijk[axis] + shift) / counts[axis];
          mesh.Points.push_back(lower[axis] * (1 - share) + upper[axis] * share);
        }
      }
    }
  }
  for (int k = 0; k < nz; ++k)
  {
    for (int j = 0; j < ny; ++j)
    {
      for (int i = 0; i < nx; ++i)
      {
        const int mirror = (i + j + k) % 2;
        for (const auto& tetrahedron : Split)
        {
          for (int corner : tetrahedron)
          {
            corner ^= mirror;
            const int x = i + (corner & 1);
            const int y = j + (corner >> 1 & 1);
            const int z = k + (corner >> 2);
            mesh.Cells.push_back(x + (nx + 1) * (y + (ny + 1) * z));
          }
        }
      }
    }
  }
  return mesh;
}

TetrahedralMesh MakeCyclicTetrahedra(int count)
{
  TetrahedralMesh mesh;
  for (int i = 0; i < count; ++i)
  {
    const double angle = 6.283185307179586 * i / count;
    const double c = std::cos(angle), s = std::sin(angle);
    // Across, along, up.
    const double corners[4][3] = { { 0.4, -2, -0.5 }, { 0.7, -2, -0.5 }, { 0.4, 2, 0.5 },
      { 0.55, 2, 0.6 } };
    for (int corner = 0; corner < 4; ++corner)
    {
      const double* x = corners[corner];
      mesh.Points.insert(mesh.Points.end(), { c * x[0] - s * x[1], s * x[0] + c * x[1], x[2] });
      mesh.Cells.push_back(4 * i + corner);
    }
  }
  return mesh;
}

} // namespace tetralux
