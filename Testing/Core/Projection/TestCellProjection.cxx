// SPDX-License-Identifier: BSD-3-Clause
// Projected cells against rays cut with the cell's faces one by one in double precision.
#include "Projection/ProjectedCells.h"

#include "ReferenceScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include <omp.h>

namespace tetralux
{
namespace
{

using Point = std::array<double, 3>;
using Tetrahedron = std::array<Point, 4>;

constexpr int Size = 64;

/// Where a ray is in a cell: distances and scalars at both ends. Missed where End <= Begin.
struct Part
{
  double Begin, End;
  double Front, Back;
};

Point Subtract(const Point& a, const Point& b) { return { a[0] - b[0], a[1] - b[1], a[2] - b[2] }; }

double Dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point Cross(const Point& a, const Point& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

struct Ray
{
  Point Origin, Direction; // of length 1
};

Ray MakeRay(const RayGrid& grid, int i, int j)
{
  Ray ray;
  for (int c = 0; c < 3; ++c)
  {
    ray.Origin[c] = grid.Origin[c] + i * grid.OriginStepX[c] + j * grid.OriginStepY[c];
    ray.Direction[c] = grid.Direction[c] + i * grid.DirectionStepX[c] + j * grid.DirectionStepY[c];
  }
  const double length = std::sqrt(Dot(ray.Direction, ray.Direction));
  for (double& x : ray.Direction)
  {
    x /= length;
  }
  return ray;
}

/// The scalar at a point by volumes.
double Interpolate(const Tetrahedron& cell, const std::array<double, 4>& scalars, const Point& x)
{
  double sum = 0;
  double volumes = 0;
  for (int i = 0; i < 4; ++i)
  {
    Tetrahedron part = cell;
    part[i] = x;
    const double volume = Dot(
      Subtract(part[1], part[0]), Cross(Subtract(part[2], part[0]), Subtract(part[3], part[0])));
    sum += volume * scalars[i];
    volumes += volume;
  }
  return sum / volumes;
}

Part CutRay(const Ray& ray, const Tetrahedron& cell, const std::array<double, 4>& scalars)
{
  double begin = 0; // not behind the eye
  double end = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 4; ++i)
  {
    const Point& a = cell[(i + 1) % 4];
    Point normal = Cross(Subtract(cell[(i + 2) % 4], a), Subtract(cell[(i + 3) % 4], a));
    if (Dot(normal, Subtract(cell[i], a)) < 0)
    {
      normal = { -normal[0], -normal[1], -normal[2] };
    }
    const double height = Dot(normal, Subtract(ray.Origin, a));
    const double slope = Dot(normal, ray.Direction);
    (slope > 0 ? begin : end) =
      slope > 0 ? std::max(begin, -height / slope) : std::min(end, -height / slope);
  }
  Part part = { begin, end, 0, 0 };
  Point front, back;
  for (int c = 0; c < 3; ++c)
  {
    front[c] = ray.Origin[c] + begin * ray.Direction[c];
    back[c] = ray.Origin[c] + end * ray.Direction[c];
  }
  part.Front = Interpolate(cell, scalars, front);
  part.Back = Interpolate(cell, scalars, back);
  return part;
}

/// What the shader does, in the words of ProjectedCell. eye: whether there is no front but the eye.
struct Fragment
{
  double Length;
  double Front, Back;
};

Fragment Shade(const ProjectedCell& cell, const ScreenFrame& frame, bool interpolate,
  const RayGrid& grid, int i, int j)
{
  const float dx = static_cast<float>(i) + 0.5f - cell.Fourth.Reference[0];
  const float dy = static_cast<float>(j) + 0.5f - cell.Fourth.Reference[1];
  const auto at = [dx, dy](const float f[3]) { return f[0] + f[1] * dx + f[2] * dy; };
  const float* faces[3] = { cell.First.Face0, cell.Second.Face1, cell.Second.Face2 };
  const int code = static_cast<int>(cell.Fourth.Code);
  const float sign = code >= 4 ? -1.f : 1.f;
  const int entries = code % 4;
  float near = 0;
  float far = -std::numeric_limits<float>::infinity();
  for (int k = 0; k < 3; ++k)
  {
    const float e = at(faces[k]);
    near = k < entries ? std::min(near, e) : near;
    far = k < entries ? far : std::max(far, e);
  }
  const bool homogeneous = frame.IsPerspective() && interpolate;
  const float base = at(cell.First.Base);
  if (homogeneous)
  {
    // The eye itself ends what no face does.
    const float infinity = 1e30f;
    far = sign > 0 ? far : std::max(far, base - infinity);
  }
  const float zNear = base + sign * near;
  const float zFar = base + sign * far;
  const float scale = homogeneous ? 1 / (zNear * zFar) : 1;
  const float sNear =
    (at(cell.Third.Scalar) + cell.Third.ScalarSlope * near) / (homogeneous ? zNear : 1.f);
  const float sFar =
    (at(cell.Third.Scalar) + cell.Third.ScalarSlope * far) / (homogeneous ? zFar : 1.f);
  const auto bound = [&cell](float s)
  { return std::clamp(s, cell.Third.ScalarRange[0], cell.Third.ScalarRange[1]); };
  double direction = 0;
  for (int c = 0; c < 3; ++c)
  {
    direction = std::hypot(
      direction, grid.Direction[c] + i * grid.DirectionStepX[c] + j * grid.DirectionStepY[c]);
  }
  const double unit = frame.GetDepthUnit() * direction;
  return { static_cast<double>((near - far) * scale) * unit, bound(sign > 0 ? sNear : sFar),
    bound(sign > 0 ? sFar : sNear) };
}

/// Whether a pixel's centre is in the polygon of the corners, in the fan's order.
bool Covers(const ProjectedCell& cell, int n, int i, int j)
{
  const float* corners[4] = { &cell.First.X, &cell.Second.X, &cell.Third.X, &cell.Fourth.X };
  const double x = i + 0.5;
  const double y = j + 0.5;
  bool left = true;
  bool right = true;
  for (int k = 0; k < n; ++k)
  {
    const float* a = corners[k];
    const float* b = corners[(k + 1) % n];
    const double side = (static_cast<double>(b[0]) - a[0]) * (y - a[1]) -
      (static_cast<double>(b[1]) - a[1]) * (x - a[0]);
    left = left && side >= 0;
    right = right && side <= 0;
  }
  return left || right;
}

struct Errors
{
  int Hits = 0;
  double Length = 0; ///< largest error, of a cell of size 1
  double Scalar = 0; ///< largest error times the length
};

void Compare(const Tetrahedron& cell, const std::array<double, 4>& scalars, const RayGrid& grid,
  Errors& errors, bool exact = true)
{
  const double center[3] = { 0, 0, 0 };
  const ScreenFrame frame(grid, center, 2);
  ProjectionSettings settings;
  settings.Width = grid.Width;
  settings.Height = grid.Height;
  ScreenPoint points[4];
  for (int i = 0; i < 4; ++i)
  {
    points[i] = frame.Project(cell[i].data(), scalars[i]);
  }
  ProjectedCell projected;
  const int n = ProjectCell(frame, settings, points[0], points[1], points[2], points[3], projected);
  for (int j = 0; j < grid.Height; ++j)
  {
    for (int i = 0; i < grid.Width; ++i)
    {
      const Part part = CutRay(MakeRay(grid, i, j), cell, scalars);
      const bool hit = part.End > part.Begin;
      if (hit)
      {
        ++errors.Hits;
        ASSERT_TRUE(n > 0 && Covers(projected, n, i, j)) << i << ", " << j;
      }
      if (n == 0 || !Covers(projected, n, i, j))
      {
        continue;
      }
      const Fragment fragment = Shade(projected, frame, true, grid, i, j);
      const double length = hit ? part.End - part.Begin : 0;
      const double found = std::max(fragment.Length, 0.);
      if (!exact)
      {
        continue;
      }
      errors.Length = std::max(errors.Length, std::abs(found - length));
      if (hit)
      {
        const double scalar =
          std::max(std::abs(fragment.Front - part.Front), std::abs(fragment.Back - part.Back));
        errors.Scalar = std::max(errors.Scalar, length * scalar);
      }
    }
  }
}

RayGrid MakePerspective(double distance)
{
  return MakePerspectiveGrid({ 0.3 * distance, 0.2 * distance, distance }, { 0, 0, 0 },
    { 0.1, 1, 0 }, 2 * std::atan(1.2 / distance) * 180 / std::acos(-1.), Size, Size);
}

RayGrid MakeParallel()
{
  return MakeParallelGrid({ 0.9, -0.7, 3 }, { 0, 0, 0 }, { 0.1, 1, 0 }, 1.3, Size, Size);
}

TEST(CellProjection, RandomCells)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Errors perspective, parallel;
  for (int k = 0; k < 200; ++k)
  {
    Tetrahedron cell;
    for (Point& point : cell)
    {
      point = { uniform(random), uniform(random), uniform(random) };
    }
    const std::array<double, 4> scalars = { uniform(random), uniform(random), uniform(random),
      uniform(random) };
    Compare(cell, scalars, MakePerspective(2.5), perspective);
    Compare(cell, scalars, MakeParallel(), parallel);
  }
  EXPECT_GT(perspective.Hits, 10000);
  EXPECT_LT(perspective.Length, 1e-5);
  EXPECT_LT(perspective.Scalar, 1e-5);
  EXPECT_GT(parallel.Hits, 10000);
  EXPECT_LT(parallel.Length, 1e-5);
  EXPECT_LT(parallel.Scalar, 1e-5);
}

TEST(CellProjection, ThinCells)
{
  // Plates and needles, ten thousand to a million times thinner than they are wide.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const double thickness : { 1e-4, 1e-6 })
  {
    Errors errors;
    for (int k = 0; k < 200; ++k)
    {
      const Point along = { uniform(random), uniform(random), uniform(random) };
      const Point across = { uniform(random), uniform(random), uniform(random) };
      Tetrahedron cell;
      for (Point& point : cell)
      {
        const double u = uniform(random);
        const double v = k % 2 == 0 ? uniform(random) : thickness * uniform(random);
        for (int c = 0; c < 3; ++c)
        {
          point[c] = u * along[c] + v * across[c] + thickness * uniform(random);
        }
      }
      const std::array<double, 4> scalars = { uniform(random), uniform(random), uniform(random),
        uniform(random) };
      Compare(cell, scalars, MakePerspective(2.5), errors);
      Compare(cell, scalars, MakeParallel(), errors);
    }
    EXPECT_GT(errors.Hits, 100);
    EXPECT_LT(errors.Length, 1e-3 * thickness + 5e-7) << thickness;
  }
}

// Cells around and behind the eye: what is in front of it is covered, and limited by the eye alone.
TEST(CellProjection, CellsThatReachBehindTheEye)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const RayGrid grid =
    MakePerspectiveGrid({ 0, 0, 0 }, { 0.1, 0.2, -1 }, { 0, 1, 0 }, 80, Size, Size);
  Errors errors;
  for (int k = 0; k < 200; ++k)
  {
    Tetrahedron cell;
    for (Point& point : cell)
    {
      point = { uniform(random), uniform(random), uniform(random) };
    }
    // Covered is all that is asked for: the shader ends such rays by the near plane.
    Compare(cell, { 0, 0, 0, 0 }, grid, errors, false);
  }
  EXPECT_GT(errors.Hits, 10000);
}

// A box of cells seen exactly along its edges: every ray's lengths add up to the depth of the box.
TEST(CellProjection, RaysAlongFaces)
{
  const TetrahedralMesh mesh = MakeBox(4, 4, 3, { -1, -1, -1 }, { 1, 1, 1 });
  // Pixels of 1 / 16, with centres on the faces.
  const RayGrid grid =
    MakeParallelGrid({ 1. / 32, 1. / 32, 3 }, { 1. / 32, 1. / 32, 0 }, { 0, 1, 0 }, 2, Size, Size);
  const double center[3] = { 0, 0, 0 };
  const ScreenFrame frame(grid, center, 2);
  ProjectionSettings settings;
  settings.Width = settings.Height = Size;
  std::vector<ScreenPoint> points(mesh.GetNumberOfPoints());
  frame.Project(mesh.Points, {}, 0, 1, points);
  settings.Shift = FindShift(frame, settings, points, mesh.Cells);
  EXPECT_GT(settings.Shift, 0);
  EXPECT_LT(settings.Shift, 1e-4);
  std::vector<std::int32_t> order(mesh.GetNumberOfCells());
  std::iota(order.begin(), order.end(), 0);
  ProjectedCells cells;
  ProjectCells(frame, settings, points, mesh.Cells, order, CellData(), cells);
  int covered = 0;
  for (int j = 0; j < Size; ++j)
  {
    for (int i = 0; i < Size; ++i)
    {
      const Ray ray = MakeRay(grid, i, j);
      const double outside = std::max(std::abs(ray.Origin[0]), std::abs(ray.Origin[1])) - 1;
      if (std::abs(outside) < 1e-6)
      {
        continue; // along the hull
      }
      double sum = 0;
      for (std::int64_t cell = 0; cell < cells.GetNumberOfCells(); ++cell)
      {
        sum += std::max(Shade(cells.Cells[cell], frame, true, grid, i, j).Length, 0.);
      }
      ASSERT_NEAR(sum, outside < 0 ? 2 : 0, 1e-4) << i << ", " << j;
      covered += outside < 0;
    }
  }
  EXPECT_GT(covered, 800);
}

TEST(CellProjection, BatchesDoNotDependOnThreads)
{
  const TetrahedralMesh mesh = MakeBox(20, 20, 20, { -1, -1, -1 }, { 1, 1, 1 }, 0.15);
  const RayGrid grid = MakePerspective(2.5);
  const double center[3] = { 0, 0, 0 };
  const ScreenFrame frame(grid, center, 2);
  ProjectionSettings settings;
  settings.Width = settings.Height = Size;
  std::vector<ScreenPoint> points(mesh.GetNumberOfPoints());
  frame.Project(mesh.Points, {}, 0, 1, points);
  std::vector<std::int32_t> order(mesh.GetNumberOfCells());
  std::iota(order.rbegin(), order.rend(), 0);
  CellData data;
  data.Keys = data.Ids = true;
  std::vector<ProjectedCells> results;
  for (const int threads : { 1, 3 })
  {
    omp_set_num_threads(threads);
    results.emplace_back();
    ProjectCells(frame, settings, points, mesh.Cells, order, data, results.back());
  }
  omp_set_num_threads(omp_get_num_procs());
  ASSERT_EQ(results[0].GetNumberOfCells(), results[1].GetNumberOfCells());
  EXPECT_GT(results[0].GetNumberOfCells(), 30000);
  EXPECT_EQ(results[0].Triangles, results[1].Triangles);
  EXPECT_EQ(results[0].PartBegins, results[1].PartBegins);
  EXPECT_EQ(results[0].PartBegins.front(), 0U);
  EXPECT_EQ(results[0].PartBegins.back(), results[0].Triangles.size());
  EXPECT_EQ(results[0].GetNumberOfParts(),
    (results[0].GetNumberOfCells() + ProjectedCells::PartSize - 1) / ProjectedCells::PartSize);
  std::int32_t last = static_cast<std::int32_t>(mesh.GetNumberOfCells());
  std::int64_t triangles = 0;
  for (std::int64_t i = 0; i < results[0].GetNumberOfCells(); ++i)
  {
    const auto& own = results[0].Cells[i].Fourth.Own;
    const auto cell =
      static_cast<std::int32_t>(own[0]) * CellIdBase + static_cast<std::int32_t>(own[1]);
    EXPECT_EQ(own[1], results[1].Cells[i].Fourth.Own[1]);
    ASSERT_LT(cell, last); // in order
    last = cell;
  }
  for (std::size_t t = 0; t < results[0].Triangles.size(); t += 3)
  {
    EXPECT_EQ(results[0].Triangles[t + 2] % 4, 0u); // the corner that has the data with it
    triangles += 1;
  }
  EXPECT_LE(triangles, 2 * results[0].GetNumberOfCells());
}

TEST(CellProjection, CornersOfInterpolatedCellsHaveTheValuesOfTheFunctions)
{
  const TetrahedralMesh mesh = MakeBox(6, 6, 6, { -1, -1, -1 }, { 1, 1, 1 }, 0.15);
  const RayGrid grid = MakePerspective(2.5);
  const double center[3] = { 0, 0, 0 };
  const ScreenFrame frame(grid, center, 2);
  ProjectionSettings settings;
  settings.Width = settings.Height = Size;
  settings.Interpolate = false;
  std::vector<ScreenPoint> points(mesh.GetNumberOfPoints());
  std::vector<double> scalars(points.size());
  std::iota(scalars.begin(), scalars.end(), 0.);
  frame.Project(mesh.Points, scalars, 0, 1. / static_cast<double>(scalars.size()), points);
  std::vector<std::int32_t> order(mesh.GetNumberOfCells());
  std::iota(order.begin(), order.end(), 0);
  CellData data;
  data.Ids = true;
  ProjectedCells cells;
  ProjectCells(frame, settings, points, mesh.Cells, order, data, cells);
  EXPECT_TRUE(cells.Cells.empty());
  ASSERT_EQ(cells.InterpolatedCells.size(), static_cast<std::size_t>(cells.GetNumberOfCells()) + 1);
  EXPECT_GT(cells.GetNumberOfCells(), 900);
  for (std::int64_t i = 0; i < cells.GetNumberOfCells(); ++i)
  {
    const InterpolatedCell::Corner* corners = cells.InterpolatedCells[i].Corners;
    const auto id = static_cast<std::size_t>(corners[3].Own[0]) * CellIdBase +
      static_cast<std::size_t>(corners[3].Own[1]);
    const std::int32_t* p = &mesh.Cells[4 * id];
    ProjectedCell cell;
    ASSERT_GT(
      ProjectCell(frame, settings, points[p[0]], points[p[1]], points[p[2]], points[p[3]], cell),
      0);
    EXPECT_EQ(corners[0].Own[0], cell.Third.ScalarSlope);
    EXPECT_EQ(corners[0].Own[1], cell.Fourth.Code);
    EXPECT_EQ(corners[1].Own[0], cell.Third.ScalarRange[0]);
    EXPECT_EQ(corners[1].Own[1], cell.Third.ScalarRange[1]);
    EXPECT_EQ(corners[2].Own[0], cell.Fourth.Reference[0]);
    EXPECT_EQ(corners[2].Own[1], cell.Fourth.Reference[1]);
    const float* places[4] = { &cell.First.X, &cell.Second.X, &cell.Third.X, &cell.Fourth.X };
    for (int k = 0; k < 4; ++k)
    {
      EXPECT_EQ(corners[k].X, places[k][0]);
      EXPECT_EQ(corners[k].Y, places[k][1]);
      const double dx = static_cast<double>(corners[k].X) - cell.Fourth.Reference[0];
      const double dy = static_cast<double>(corners[k].Y) - cell.Fourth.Reference[1];
      const auto expectNear = [&](float value, const float f[3])
      {
        constexpr double Roundings = 4. / (1 << 24); // of the terms of a sum of three
        const double size = std::abs(f[0]) + std::abs(f[1] * dx) + std::abs(f[2] * dy);
        EXPECT_NEAR(value, f[0] + f[1] * dx + f[2] * dy, Roundings * size);
      };
      expectNear(corners[k].Scalar, cell.Third.Scalar);
      expectNear(corners[k].Faces[0], cell.First.Face0);
      expectNear(corners[k].Faces[1], cell.Second.Face1);
      expectNear(corners[k].Faces[2], cell.Second.Face2);
      expectNear(corners[k].Base, cell.First.Base);
    }
  }
}

TEST(ScreenFrame, LimitsThatCutNothingAreLeftOut)
{
  const TetrahedralMesh mesh = MakeBox(3, 3, 3, { -1, -1, -1 }, { 1, 1, 1 });
  const RayGrid grid = MakePerspective(3);
  const double center[3] = { 0, 0, 0 };
  const ScreenFrame frame(grid, center, 2);
  std::vector<ScreenPoint> points(mesh.GetNumberOfPoints());
  frame.Project(mesh.Points, {}, 0, 1, points);
  const std::vector<std::array<double, 4>> planes = { { 1, 0, 0, 1.5 }, { 0, 0, -1, 0.1 },
    { 0, 1, 0, 2 } };
  const ScreenFrame::Limits limits = frame.FindLimits(planes, points, mesh.Cells, {});
  ASSERT_EQ(limits.Planes.size(), 1u);
  ASSERT_EQ(limits.Cells.size(), mesh.GetNumberOfCells());
  for (std::size_t cell = 0; cell < mesh.GetNumberOfCells(); ++cell)
  {
    bool kept = false;
    for (int k = 0; k < 4; ++k)
    {
      kept = kept || mesh.Points[3 * static_cast<std::size_t>(mesh.Cells[4 * cell + k]) + 2] <= 0.1;
    }
    EXPECT_EQ(limits.Cells[cell] != 0, kept);
  }
  // The side of the plane as a fragment sees it.
  for (const double z : { -0.5, 0.5 })
  {
    const double place[3] = { 0.3, -0.2, z };
    const ScreenPoint point = frame.Project(place, 0);
    const ScreenPlane& plane = limits.Planes[0];
    const double side = plane.X * (point.X - frame.GetMiddle()[0]) +
      plane.Y * (point.Y - frame.GetMiddle()[1]) + plane.Constant + plane.Z / point.Depth;
    EXPECT_EQ(side > 0, z < 0.1);
  }
  EXPECT_TRUE(frame.FindLimits({}, points, mesh.Cells, {}).Cells.empty());
}

} // namespace
} // namespace tetralux
