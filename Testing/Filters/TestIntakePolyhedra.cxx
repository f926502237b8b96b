// SPDX-License-Identifier: BSD-3-Clause

// Polyhedra, dented and concave ones too, and convex point sets.

#include "Intake/TetrahedraIntake.h"

#include "Intake/LeftOutCells.h"
#include "IntakeChecks.h"

#include "vtkCellType.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

using namespace tetralux;

TEST(TetrahedraIntake, DentedPolyhedronIsConedFromItsMiddle)
{
  // A cube whose top has a dent, so that no corner of the top sees everything.
  const std::vector<CellPatch::Position> points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 },
    { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 }, { 0.5, 0.5, 0.75 } };
  const std::vector<std::vector<int>> outward = { { 0, 4, 7, 3 }, { 1, 2, 6, 5 }, { 0, 1, 5, 4 },
    { 3, 7, 6, 2 }, { 0, 3, 2, 1 }, { 4, 5, 8 }, { 5, 6, 8 }, { 6, 7, 8 }, { 7, 4, 8 } };
  std::vector<std::vector<int>> inward = outward;
  for (std::vector<int>& face : inward)
  {
    std::reverse(face.begin(), face.end());
  }
  std::set<std::size_t> numbersOfPoints;
  for (const auto& faces : { outward, inward })
  {
    CellPatch patch;
    patch.AddPolyhedron(points, faces);
    for (std::uint64_t seed = 1; seed <= 50; ++seed)
    {
      auto grid = patch.MakeGrid(seed, KeepPosition);
      const TetrahedraIntake intake = TakeInTetrahedra(grid);
      std::int64_t notPositive = 0;
      EXPECT_NEAR(GetVolume(intake.Mesh, &notPositive), 1 - 0.25 / 3, VolumeTolerance);
      EXPECT_EQ(notPositive, 0) << "seed " << seed;
      EXPECT_EQ(CountBoundaryFaces(intake.Mesh), 5u * 2 + 4);
      numbersOfPoints.insert(intake.Mesh.GetNumberOfPoints());
    }
  }
  EXPECT_EQ(numbersOfPoints, (std::set<std::size_t>{ 9, 10 })) << "both ways were tried";
}

namespace
{

/// Layers of a prism over a polygon, each a polyhedron.
CellPatch MakePolygonPrism(const std::vector<std::array<double, 2>>& polygon, int layers)
{
  const int n = static_cast<int>(polygon.size());
  CellPatch patch;
  for (int layer = 0; layer < layers; ++layer)
  {
    std::vector<CellPatch::Position> points;
    for (const int level : { layer, layer + 1 })
    {
      for (const auto& corner : polygon)
      {
        points.push_back({ corner[0], corner[1], 0.3 * level });
      }
    }
    std::vector<std::vector<int>> faces(2);
    for (int i = 0; i < n; ++i)
    {
      faces[0].insert(faces[0].begin(), i);
      faces[1].push_back(n + i);
      faces.push_back({ i, (i + 1) % n, n + (i + 1) % n, n + i });
    }
    patch.AddPolyhedron(points, faces);
  }
  return patch;
}

} // namespace

// Faces that are not convex are the same triangles from both sides, and where a point sees all of
// them, no tetrahedron lies on another one.
TEST(TetrahedraIntake, ConcavePolyhedraAreConedFromAPointThatSeesAllFaces)
{
  std::vector<std::array<double, 2>> star;
  for (int i = 0; i < 10; ++i)
  {
    const double angle = 0.2 * i * std::acos(-1.0);
    const double radius = i % 2 == 0 ? 1 : 0.4;
    star.push_back({ radius * std::cos(angle), radius * std::sin(angle) });
  }
  const std::vector<std::array<double, 2>> corner = { { 0, 0 }, { 1, 0 }, { 1, 0.1 }, { 0.1, 0.1 },
    { 0.1, 1 }, { 0, 1 } };
  constexpr double Rounding = 1e-6; // of points in single precision
  const double areas[] = { 5 * 0.4 * std::sin(0.2 * std::acos(-1.0)), 0.19 };
  const std::vector<std::array<double, 2>>* polygons[] = { &star, &corner };
  for (int shape = 0; shape < 2; ++shape)
  {
    const CellPatch patch = MakePolygonPrism(*polygons[shape], 2);
    const int n = static_cast<int>(polygons[shape]->size());
    for (std::uint64_t seed = 1; seed <= 50; ++seed)
    {
      const TetrahedraIntake intake = TakeInTetrahedra(patch.MakeGrid(seed, KeepPosition));
      std::int64_t notPositive = 0;
      EXPECT_NEAR(GetVolume(intake.Mesh, &notPositive), 0.6 * areas[shape], Rounding);
      EXPECT_EQ(notPositive, 0) << "shape " << shape << ", seed " << seed;
      EXPECT_EQ(CountBoundaryFaces(intake.Mesh), 2u * (n - 2) + 2u * 2 * n);
      EXPECT_EQ(intake.Report.FoldedCells, 0);
    }
  }
}

// A U, a comb and an S: no point sees all of their faces, but those of what is left of them
// after tetrahedra between their corners were cut off.
TEST(TetrahedraIntake, PolyhedraThatNoPointSeesAllOfAreCutUntilOneDoes)
{
  const std::vector<std::vector<std::array<double, 2>>> outlines = {
    { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0.7, 1 }, { 0.7, 0.3 }, { 0.3, 0.3 }, { 0.3, 1 }, { 0, 1 } },
    { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0.8, 1 }, { 0.8, 0.2 }, { 0.6, 0.2 }, { 0.6, 0.7 },
      { 0.4, 0.7 }, { 0.4, 0.2 }, { 0.2, 0.2 }, { 0.2, 1 }, { 0, 1 } },
    { { 0, 0 }, { 1, 0 }, { 1, 0.6 }, { 0.2, 0.6 }, { 0.2, 0.8 }, { 1, 0.8 }, { 1, 1 }, { 0, 1 },
      { 0, 0.4 }, { 0.8, 0.4 }, { 0.8, 0.2 }, { 0, 0.2 } },
  };
  constexpr double Rounding = 1e-6; // of points in single precision
  for (const auto& outline : outlines)
  {
    const int n = static_cast<int>(outline.size());
    double area = 0;
    for (int i = 0; i < n; ++i)
    {
      const auto& a = outline[i];
      const auto& b = outline[(i + 1) % n];
      area += 0.5 * (a[0] * b[1] - b[0] * a[1]);
    }
    const CellPatch patch = MakePolygonPrism(outline, 2);
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
    {
      SCOPED_TRACE(std::to_string(n) + " corners, seed " + std::to_string(seed));
      const TetrahedraIntake intake = TakeInTetrahedra(patch.MakeGrid(seed, KeepPosition));
      EXPECT_EQ(intake.Report.FoldedCells, 0);
      std::int64_t notPositive = 0;
      EXPECT_NEAR(GetVolume(intake.Mesh, &notPositive), 0.6 * area, Rounding);
      EXPECT_EQ(notPositive, 0);
      // Both layers have the same triangles between them.
      EXPECT_EQ(CountBoundaryFaces(intake.Mesh), 2u * (n - 2) + 2u * 2 * n);
    }
  }
}

// A spiral: what is cut off leaves nothing that can be divided.
TEST(TetrahedraIntake, PolyhedraThatAreNotDividedAreCounted)
{
  const CellPatch patch = MakePolygonPrism(
    { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0.3, 1 }, { 0.3, 0.4 }, { 0.6, 0.4 }, { 0.6, 0.6 },
      { 0.5, 0.6 }, { 0.5, 0.8 }, { 0.8, 0.8 }, { 0.8, 0.2 }, { 0.1, 0.2 }, { 0.1, 1 }, { 0, 1 } },
    1);
  const TetrahedraIntake intake = TakeInTetrahedra(patch.MakeGrid(1, KeepPosition));
  constexpr double Rounding = 1e-6;                          // of points in single precision
  EXPECT_NEAR(GetVolume(intake.Mesh), 0.3 * 0.64, Rounding); // signed: they overlap
  EXPECT_EQ(intake.Report.FoldedCells, 1);
  EXPECT_NE(DescribeFoldedCells(intake.Report).find("1 polyhedra"), std::string::npos);
}

TEST(TetrahedraIntake, ConvexPointSetsAgreeWithAnyNeighbour)
{
  CellPatch patch;
  patch.AddBoxes(VTK_HEXAHEDRON, 0, 0, 0, 1, 2, 2);
  patch.AddBoxes(VTK_CONVEX_POINT_SET, 1, 0, 0, 2, 2, 2);
  patch.AddBoxes(VTK_WEDGE, 3, 0, 0, 1, 2, 2);
  for (const auto& map : { MapAffine, MapFlat })
  {
    for (std::uint64_t seed = 1; seed <= 50; ++seed)
    {
      auto grid = patch.MakeGrid(seed, map);
      const TetrahedraIntake intake = TakeInTetrahedra(grid);
      std::int64_t notPositive = 0;
      GetVolume(intake.Mesh, &notPositive);
      EXPECT_EQ(notPositive, 0);
      EXPECT_EQ(intake.Mesh.GetNumberOfPoints(), 45u);
      EXPECT_EQ(FindConformityProblem(intake.Mesh, MakeToBox(grid, intake.Mesh), { 4, 2, 2 }), "");
    }
  }
}

TEST(TetrahedraIntake, PointsInsideOfAConvexPointSetSplitIt)
{
  // Corners of a cube, then the middle of an edge, of a face, of the diagonal that cones from a
  // corner make inside, and a point anywhere.
  std::vector<std::array<double, 3>> points;
  for (int i = 0; i < 8; ++i)
  {
    points.push_back({ double(i & 1), double(i >> 1 & 1), double(i >> 2) });
  }
  points.push_back({ 0.5, 0, 1 });
  points.push_back({ 1, 0.5, 0.5 });
  points.push_back({ 0.5, 0.5, 0.5 });
  points.push_back({ 0.7, 0.2, 0.6 });
  std::mt19937_64 random(1);
  for (int repeat = 0; repeat < 50; ++repeat)
  {
    std::shuffle(points.begin(), points.end(), random);
    vtkNew<vtkPoints> coordinates;
    coordinates->SetDataTypeToDouble();
    std::vector<vtkIdType> ids;
    for (const auto& x : points)
    {
      ids.push_back(coordinates->InsertNextPoint(x.data()));
    }
    ids.push_back(ids[3]); // once more
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(coordinates);
    grid->InsertNextCell(VTK_CONVEX_POINT_SET, static_cast<vtkIdType>(ids.size()), ids.data());
    const TetrahedraIntake intake = TakeInTetrahedra(grid);
    std::int64_t notPositive = 0;
    EXPECT_NEAR(GetVolume(intake.Mesh, &notPositive), 1, VolumeTolerance);
    EXPECT_EQ(notPositive, 0);
    const std::set<std::int32_t> used(intake.Mesh.Cells.begin(), intake.Mesh.Cells.end());
    EXPECT_EQ(used.size(), points.size());
    const auto toBox = [&](std::int64_t point) { return points[point]; };
    EXPECT_EQ(FindConformityProblem(intake.Mesh, toBox, { 1, 1, 1 }), "");
  }
}

TEST(TetrahedraIntake, ConvexPointSetOfASolidIsItsHull)
{
  // Twenty points on a sphere of radius 1e-20, and the same points moved into a plane.
  for (bool flat : { false, true })
  {
    std::mt19937_64 random(2);
    std::normal_distribution<double> normal;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    std::vector<vtkIdType> ids;
    for (int i = 0; i < 20; ++i)
    {
      double x[3] = { normal(random), normal(random), normal(random) };
      const double length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) / 1e-20;
      ids.push_back(
        points->InsertNextPoint(x[0] / length, x[1] / length, flat ? 0 : x[2] / length));
    }
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(points);
    grid->InsertNextCell(VTK_CONVEX_POINT_SET, 20, ids.data());
    const TetrahedraIntake intake = TakeInTetrahedra(grid);
    EXPECT_EQ(intake.Report.InvalidCells, flat ? 1 : 0);
    EXPECT_EQ(CountBoundaryFaces(intake.Mesh), flat ? 0u : 2u * 20 - 4); // by Euler
  }
}
