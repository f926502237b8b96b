// SPDX-License-Identifier: BSD-3-Clause
// Scalars on faces: the same for the cells on both sides, and right.
#include "Projection/FaceScalar.h"

#include "Projection/ProjectedCells.h"
#include "ReferenceScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <random>
#include <vector>

namespace tetralux
{
namespace
{

using Point = std::array<double, 3>;
using Triangle = std::array<Point, 3>;

constexpr int Size = 64;

const double Center[3] = { 0, 0, 0 };

ProjectionSettings MakeSettings()
{
  ProjectionSettings settings;
  settings.Width = settings.Height = Size;
  return settings;
}

RayGrid MakePerspective()
{
  return MakePerspectiveGrid({ 0.75, 0.5, 2.5 }, { 0, 0, 0 }, { 0.1, 1, 0 },
    2 * std::atan(0.5) * 180 / 3.14159265, Size, Size);
}

RayGrid MakeParallel()
{
  return MakeParallelGrid({ 0.9, -0.7, 3 }, { 0, 0, 0 }, { 0.1, 1, 0 }, 1.3, Size, Size);
}

/// What the shader does, in the words of FaceScalar.
float Evaluate(const FaceScalar& face, bool perspective, int i, int j)
{
  const float dx = static_cast<float>(i) + 0.5f - face.Reference[0];
  const float dy = static_cast<float>(j) + 0.5f - face.Reference[1];
  const auto at = [dx, dy](const float f[3]) { return f[0] + f[1] * dx + f[2] * dy; };
  const float share = perspective ? at(face.Share) / at(face.Inverse) : at(face.Share);
  return std::min(
    face.Lowest + std::clamp(share, 0.f, 1.f) * (face.Highest - face.Lowest), face.Highest);
}

/// The scalar where a ray goes through a triangle; false where the ray misses it.
bool Intersect(const RayGrid& grid, int i, int j, const Triangle& triangle,
  const std::array<double, 3>& scalars, double& scalar)
{
  // Volumes of the ray with each edge.
  using Long = long double;
  Long origin[3], direction[3];
  for (int c = 0; c < 3; ++c)
  {
    origin[c] = grid.Origin[c] + static_cast<Long>(i) * grid.OriginStepX[c] +
      static_cast<Long>(j) * grid.OriginStepY[c];
    direction[c] = grid.Direction[c] + static_cast<Long>(i) * grid.DirectionStepX[c] +
      static_cast<Long>(j) * grid.DirectionStepY[c];
  }
  Long weights[3];
  Long sum = 0;
  Long weighted = 0;
  Long along = 0;
  for (int k = 0; k < 3; ++k)
  {
    Long p[3], q[3];
    for (int c = 0; c < 3; ++c)
    {
      p[c] = triangle[(k + 1) % 3][c] - origin[c];
      q[c] = triangle[(k + 2) % 3][c] - origin[c];
    }
    weights[k] = direction[0] * (p[1] * q[2] - p[2] * q[1]) +
      direction[1] * (p[2] * q[0] - p[0] * q[2]) + direction[2] * (p[0] * q[1] - p[1] * q[0]);
    sum += weights[k];
    weighted += weights[k] * scalars[k];
    for (int c = 0; c < 3; ++c)
    {
      along += weights[k] * (triangle[k][c] - origin[c]) * direction[c];
    }
  }
  scalar = static_cast<double>(weighted / sum);
  const bool left = weights[0] > 0 && weights[1] > 0 && weights[2] > 0;
  const bool right = weights[0] < 0 && weights[1] < 0 && weights[2] < 0;
  return (left || right) && along / sum > 0;
}

/// How many times longer a triangle's projection is than it is wide: slivers are as much more
/// sensitive to where exactly a ray goes through them.
double FindSlenderness(const ScreenPoint (&points)[3])
{
  double longest = 0;
  for (int k = 0; k < 3; ++k)
  {
    const ScreenPoint& a = points[k];
    const ScreenPoint& b = points[(k + 1) % 3];
    longest = std::max(longest, std::hypot(b.X - a.X, b.Y - a.Y));
  }
  const double area = std::abs((points[1].X - points[0].X) * (points[2].Y - points[0].Y) -
    (points[1].Y - points[0].Y) * (points[2].X - points[0].X));
  return longest * longest / area;
}

struct Errors
{
  int Hits = 0;
  double Largest = 0;          ///< of scalars within -1..1, of triangles as they come
  double LargestOfSlivers = 0; ///< over their slenderness
};

void Compare(const RayGrid& grid, const Triangle& triangle, const std::array<double, 3>& scalars,
  Errors& errors)
{
  const ScreenFrame frame(grid, Center, 2);
  ScreenPoint points[3];
  for (int k = 0; k < 3; ++k)
  {
    points[k] = frame.Project(triangle[k].data(), scalars[k]);
  }
  const bool inFront =
    std::all_of(points, points + 3, [&](const ScreenPoint& p) { return frame.IsInFront(p); });
  const FaceScalar face = FindFaceScalar(frame, MakeSettings(), points[0], points[1], points[2]);
  for (int j = 0; j < Size; ++j)
  {
    for (int i = 0; i < Size; ++i)
    {
      double expected;
      const float found = Evaluate(face, frame.IsPerspective(), i, j);
      ASSERT_GE(found, static_cast<float>(*std::min_element(scalars.begin(), scalars.end())));
      ASSERT_LE(found, static_cast<float>(*std::max_element(scalars.begin(), scalars.end())));
      if (Intersect(grid, i, j, triangle, scalars, expected))
      {
        ++errors.Hits;
        const double error = std::abs(found - expected);
        errors.Largest = std::max(errors.Largest, error);
        errors.LargestOfSlivers =
          std::max(errors.LargestOfSlivers, inFront ? error / FindSlenderness(points) : 0);
      }
    }
  }
}

TEST(FaceScalar, AgreesWithRaysCutWithTheTriangle)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const RayGrid& grid : { MakePerspective(), MakeParallel() })
  {
    // Any triangles; such that are nearly seen from the side; a million times longer than wide.
    int hits = 0;
    for (const double width : { 1., 1e-2, 1e-4, 1e-6 })
    {
      Errors errors;
      for (int k = 0; k < 300; ++k)
      {
        const Point along = { uniform(random), uniform(random), uniform(random) };
        const Point across = k % 2 == 0
          ? Point{ uniform(random), uniform(random), uniform(random) }
          : Point{ grid.Direction[0], grid.Direction[1], grid.Direction[2] };
        Triangle triangle;
        for (Point& point : triangle)
        {
          const double u = uniform(random);
          const double v = k % 2 == 0 ? width * uniform(random) : uniform(random);
          for (int c = 0; c < 3; ++c)
          {
            point[c] = u * along[c] + v * across[c] + (k % 2 == 0 ? 0 : width * uniform(random));
          }
        }
        Compare(grid, triangle, { uniform(random), uniform(random), uniform(random) }, errors);
      }
      hits += errors.Hits;
      EXPECT_LT(errors.LargestOfSlivers, 1e-6) << width;
    }
    EXPECT_GT(hits, 10000);
  }
}

TEST(FaceScalar, FacesThatReachBehindTheEye)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const RayGrid grid =
    MakePerspectiveGrid({ 0, 0, 0 }, { 0.1, 0.2, -1 }, { 0, 1, 0 }, 80, Size, Size);
  Errors errors;
  for (int k = 0; k < 300; ++k)
  {
    Triangle triangle;
    for (Point& point : triangle)
    {
      point = { uniform(random), uniform(random), uniform(random) };
    }
    Compare(grid, triangle, { uniform(random), uniform(random), uniform(random) }, errors);
  }
  EXPECT_GT(errors.Hits, 10000);
  EXPECT_LT(errors.Largest, 1e-5);
}

TEST(FaceScalar, AConstantComesOutAsItIs)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int k = 0; k < 100; ++k)
  {
    const double value = uniform(random);
    Triangle triangle;
    for (Point& point : triangle)
    {
      point = { uniform(random), uniform(random), uniform(random) };
    }
    const ScreenFrame frame(MakePerspective(), Center, 2);
    ScreenPoint points[3];
    for (int i = 0; i < 3; ++i)
    {
      points[i] = frame.Project(triangle[i].data(), value);
    }
    const FaceScalar face = FindFaceScalar(frame, MakeSettings(), points[0], points[1], points[2]);
    EXPECT_EQ(Evaluate(face, true, k % Size, k / 2), static_cast<float>(value));
  }
}

TEST(FaceScalar, NumbersAreFiniteForAllFaces)
{
  const RayGrid grids[] = { MakePerspectiveGrid(
                              { 0, 0, 0 }, { 0, 0, -1 }, { 0, 1, 0 }, 80, Size, Size),
    MakeParallelGrid({ 0, 0, 3 }, { 0, 0, 0 }, { 0, 1, 0 }, 1, Size, Size) };
  const Triangle triangles[] = {
    { { { 0.2, 0, -1 }, { 0.1, 0, -0.5 }, { 0.3, 0, -0.7 } } },   // from the side
    { { { 0.2, 0, -1 }, { 0.2, 0, -0.5 }, { 0.2, 0, -0.7 } } },   // in a line along rays
    { { { 0.2, 0, -1 }, { 0.2, 0, -1 }, { 0.2, 0, -1 } } },       // a point
    { { { 0.1, 0.2, 1 }, { 0.3, 0.1, 0.5 }, { -0.2, 0, 0.7 } } }, // behind the eye
    { { { 0, 0, 0 }, { 0.3, 0.1, -1 }, { -0.2, 0, -0.7 } } },     // in it
    { { { 1e30, 0, -1 }, { 0, 1e30, -0.5 }, { 0, 0, -0.7 } } },
    { { { 1e-30, 0, -1 }, { 0, 1e-30, -1 }, { 0, 0, -1 } } },
  };
  for (const RayGrid& grid : grids)
  {
    const ScreenFrame frame(grid, Center, 2);
    for (const Triangle& triangle : triangles)
    {
      ScreenPoint points[3];
      for (int i = 0; i < 3; ++i)
      {
        points[i] = frame.Project(triangle[i].data(), i);
      }
      const FaceScalar face =
        FindFaceScalar(frame, MakeSettings(), points[0], points[1], points[2]);
      float numbers[sizeof(FaceScalar) / sizeof(float)];
      std::memcpy(numbers, &face, sizeof(face));
      for (const float number : numbers)
      {
        EXPECT_TRUE(std::isfinite(number));
      }
      for (const float place : face.Reference)
      {
        EXPECT_GE(place, 0);
        EXPECT_LE(place, Size + 1);
      }
    }
  }
}

struct CellErrors
{
  double OfFaces = 0; ///< largest errors of scalars where rays enter or leave cells, by FaceScalar,
  double OfCells = 0; ///< and as a cell by itself interpolates
};

/// Each face of a mesh has the same numbers in both its cells, in the place of the face there.
CellErrors ExpectSameInBothCells(
  const TetrahedralMesh& mesh, const std::vector<double>& scalars, const RayGrid& grid)
{
  std::vector<std::int32_t> order(mesh.GetNumberOfCells());
  std::iota(order.rbegin(), order.rend(), 0);
  const ScreenFrame frame(grid, Center, 2);
  std::vector<ScreenPoint> points(mesh.GetNumberOfPoints());
  frame.Project(mesh.Points, scalars, 0, 1, points);
  CellData data;
  data.FaceScalars = data.Ids = true;
  ProjectedCells cells;
  ProjectCells(frame, MakeSettings(), points, mesh.Cells, order, data, cells);
  EXPECT_EQ(cells.FaceScalars.size(), 4 * static_cast<std::size_t>(cells.GetNumberOfCells()));

  using Ids = std::array<std::int32_t, 3>;
  std::map<Ids, std::vector<FaceScalar>> faces;
  CellErrors errors;
  for (std::int64_t k = 0; k < cells.GetNumberOfCells(); ++k)
  {
    const ProjectedCell& cell = cells.Cells[k];
    const FaceScalar* own = &cells.FaceScalars[4 * k];
    const auto id = static_cast<std::int64_t>(cell.Fourth.Own[0]) * CellIdBase +
      static_cast<std::int64_t>(cell.Fourth.Own[1]);
    Ids idsOfSlot[4];
    for (int opposite = 0; opposite < 4; ++opposite)
    {
      Ids ids;
      std::remove_copy(
        &mesh.Cells[4 * id], &mesh.Cells[4 * id] + 4, ids.begin(), mesh.Cells[4 * id + opposite]);
      std::sort(ids.begin(), ids.end());
      const FaceScalar expected =
        FindFaceScalar(frame, MakeSettings(), points[ids[0]], points[ids[1]], points[ids[2]]);
      const FaceScalar* slot = std::find_if(own, own + 4,
        [&](const FaceScalar& face) { return std::memcmp(&face, &expected, sizeof(face)) == 0; });
      EXPECT_NE(slot, own + 4);
      if (slot != own + 4)
      {
        idsOfSlot[slot - own] = ids;
        faces[ids].push_back(*slot);
      }
    }

    // Where rays enter and leave the cell.
    const int code = static_cast<int>(cell.Fourth.Code);
    const float sign = code >= 4 ? -1.f : 1.f;
    const int entries = code % 4;
    for (int pixel = 0; pixel < Size * Size; ++pixel)
    {
      const int i = pixel % Size;
      const int j = pixel / Size;
      const float dx = static_cast<float>(i) + 0.5f - cell.Fourth.Reference[0];
      const float dy = static_cast<float>(j) + 0.5f - cell.Fourth.Reference[1];
      const auto at = [dx, dy](const float f[3]) { return f[0] + f[1] * dx + f[2] * dy; };
      const float* differences[3] = { cell.First.Face0, cell.Second.Face1, cell.Second.Face2 };
      float ends[2] = { 0, -1e30f };
      int slots[2] = { 0, 0 };
      for (int slot = 1; slot < 4; ++slot)
      {
        const float z = at(differences[slot - 1]);
        const int end = slot <= entries ? 0 : 1;
        if (end == 0 ? z < ends[0] : z > ends[1])
        {
          ends[end] = z;
          slots[end] = slot;
        }
      }
      if (ends[0] <= ends[1])
      {
        continue;
      }
      for (int end = 0; end < 2; ++end)
      {
        Triangle triangle;
        std::array<double, 3> values;
        for (int c = 0; c < 3; ++c)
        {
          const std::int32_t point = idsOfSlot[slots[end]][c];
          std::copy_n(&mesh.Points[3 * point], 3, triangle[c].begin());
          values[c] = scalars[point];
        }
        double expected;
        if (!Intersect(grid, i, j, triangle, values, expected))
        {
          continue; // beside an edge, by rounding
        }
        const float z = at(cell.First.Base) + sign * ends[end];
        const float interpolated = (at(cell.Third.Scalar) + cell.Third.ScalarSlope * ends[end]) /
          (frame.IsPerspective() ? z : 1.f);
        const float found = Evaluate(own[slots[end]], frame.IsPerspective(), i, j);
        errors.OfFaces = std::max(errors.OfFaces, std::abs(found - expected));
        errors.OfCells = std::max(errors.OfCells,
          std::abs(std::clamp(interpolated, cell.Third.ScalarRange[0], cell.Third.ScalarRange[1]) -
            expected));
      }
    }
  }
  std::size_t shared = 0;
  for (const auto& [ids, both] : faces)
  {
    EXPECT_LE(both.size(), 2u);
    shared += both.size() == 2;
    EXPECT_EQ(std::memcmp(&both.front(), &both.back(), sizeof(FaceScalar)), 0);
  }
  EXPECT_GT(shared, faces.size() / 2);
  return errors;
}

TEST(FaceScalar, TheSameInBothCells)
{
  const TetrahedralMesh mesh = MakeBox(8, 7, 6, { -1, -1, -1 }, { 1, 1, 1 }, 0.2);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> scalars(mesh.GetNumberOfPoints());
  std::generate(scalars.begin(), scalars.end(), [&] { return uniform(random); });
  for (const RayGrid& grid : { MakePerspective(), MakeParallel() })
  {
    const CellErrors errors = ExpectSameInBothCells(mesh, scalars, grid);
    EXPECT_LT(errors.OfFaces, 5e-6);
    EXPECT_LE(errors.OfFaces, errors.OfCells);
  }
}

// A million times thinner than wide.
TEST(FaceScalar, TheSameInBothCellsOfThinLayers)
{
  TetrahedralMesh mesh = MakeBox(6, 5, 12, { -1, -1, -1 }, { 1, 1, 1 }, 0.1);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> scalars(mesh.GetNumberOfPoints());
  std::generate(scalars.begin(), scalars.end(), [&] { return uniform(random); });
  for (std::size_t p = 0; p < mesh.GetNumberOfPoints(); ++p)
  {
    mesh.Points[3 * p + 2] *= 2e-6;
  }
  for (const RayGrid& grid : { MakePerspective(), MakeParallel() })
  {
    const CellErrors errors = ExpectSameInBothCells(mesh, scalars, grid);
    EXPECT_LT(errors.OfFaces, 5e-6);
    EXPECT_LE(errors.OfFaces, errors.OfCells);
  }
}

} // namespace
} // namespace tetralux
