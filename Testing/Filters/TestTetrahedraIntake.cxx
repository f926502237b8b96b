// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/TetrahedraIntake.h"

#include "CellPatch.h"
#include "GhostArray.h"
#include "Intake/DataSetCheck.h"
#include "Intake/LeftOutCells.h"
#include "Intake/ScalarExtraction.h"
#include "Mesh/FaceNeighbors.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredGrid.h"
#include "vtkTable.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

using namespace tetralux;

namespace
{

/// The largest error of a volume, in cubed units of the meshes. Their volumes, up to 100, are sums
/// of a few hundred products of coordinates up to 10, each rounded by 1e-16 of its size.
constexpr double VolumeTolerance = 1e-12;

CellPatch::Position KeepPosition(const CellPatch::Position& x) { return x; }

/// The largest error of a field of values up to 150 that is interpolated from 20 points at most.
constexpr double FieldTolerance = 1e-12;

// Corners in VTK's order.
const std::vector<CellPatch::Position> Tetrahedron = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 },
  { 0, 0, 1 } };
const std::vector<CellPatch::Position> Box = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 },
  { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };
const std::vector<CellPatch::Position> VoxelCorners = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 },
  { 1, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 } };
const std::vector<CellPatch::Position> Wedge = { { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 },
  { 0, 1, 1 }, { 1, 0, 1 } };
const std::vector<CellPatch::Position> Pyramid = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 },
  { 0, 1, 0 }, { 0.5, 0.5, 1 } };

/// As a boundary layer: a millionth in one direction, turned out of the axes.
CellPatch::Position MapFlat(const CellPatch::Position& x)
{
  const double z = 1e-6 * x[2];
  return { 0.8 * x[0] - 0.6 * z, x[1], 0.6 * x[0] + 0.8 * z };
}

/// Where a point of the mesh was before the map: the same weights apply before and after.
std::function<CellPatch::Position(std::int64_t)> MakeToBox(
  vtkUnstructuredGrid* grid, const TetrahedralMesh& mesh)
{
  vtkDataArray* unmapped = grid->GetPointData()->GetArray("Unmapped");
  return [unmapped, &mesh](std::int64_t point)
  {
    CellPatch::Position x = { 0, 0, 0 };
    const std::int64_t original = mesh.OriginalPoints.empty() ? point : mesh.OriginalPoints[point];
    if (original >= 0)
    {
      unmapped->GetTuple(original, x.data());
      return x;
    }
    const auto& added = mesh.AddedPoints;
    for (std::int64_t j = added.Offsets[-1 - original]; j < added.Offsets[-original]; ++j)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        x[axis] += added.Weights[j] * unmapped->GetComponent(added.Sources[j], axis);
      }
    }
    return x;
  };
}

std::size_t CountBoundaryFaces(const TetrahedralMesh& mesh)
{
  return FindFaceNeighbors(mesh.Cells, mesh.GetNumberOfPoints()).BoundaryFaces.size();
}

struct CellTypeCase
{
  int Type;
  int TetrahedraPerBox; ///< 0: depends on the ids
  int AddedPerBox;
};

class EveryCellType : public testing::TestWithParam<CellTypeCase>
{
};

std::string NameCase(const testing::TestParamInfo<CellTypeCase>& info)
{
  return GetCellTypeName(info.param.Type);
}

} // namespace

TEST_P(EveryCellType, FillsItsVolumeWithPositiveTetrahedraWhoseFacesAgree)
{
  const CellTypeCase& param = GetParam();
  CellPatch patch;
  patch.AddBoxes(param.Type, 0, 0, 0, 3, 2, 2);
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    auto grid = patch.MakeGrid(seed, MapAffine);
    const TetrahedraIntake intake = TakeInTetrahedra(grid);
    ASSERT_EQ(intake.Error, "");
    EXPECT_EQ(intake.Report.CellsByType.at(param.Type), grid->GetNumberOfCells());
    EXPECT_EQ(intake.Report.GetNumberOfSkippedCells(), 0);
    EXPECT_EQ(intake.Report.InvalidCells, 0);

    std::int64_t notPositive = 0;
    EXPECT_NEAR(GetVolume(intake.Mesh, &notPositive), 12 * GetAffineDeterminant(), VolumeTolerance);
    EXPECT_EQ(notPositive, 0) << "seed " << seed;
    EXPECT_EQ(FindConformityProblem(intake.Mesh, MakeToBox(grid, intake.Mesh), { 3, 2, 2 }), "")
      << "seed " << seed;
    if (param.TetrahedraPerBox > 0)
    {
      EXPECT_EQ(intake.Mesh.GetNumberOfCells(), 12u * param.TetrahedraPerBox);
    }
    EXPECT_EQ(intake.Mesh.GetNumberOfPoints(),
      static_cast<std::size_t>(grid->GetNumberOfPoints()) + 12u * param.AddedPerBox);
  }
}

TEST_P(EveryCellType, FacesAgreeWhereTheyAreNotPlanar)
{
  CellPatch patch;
  patch.AddBoxes(GetParam().Type, 0, 0, 0, 3, 2, 2);
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    auto grid = patch.MakeGrid(seed, MapWarped);
    const TetrahedraIntake intake = TakeInTetrahedra(grid);
    ASSERT_EQ(intake.Error, "");
    EXPECT_EQ(FindConformityProblem(intake.Mesh, MakeToBox(grid, intake.Mesh), { 3, 2, 2 }), "")
      << "seed " << seed;
  }
}

// Triangles of a surface: 4 of a quadratic triangle, 6 of a quadratic quadrilateral and of a
// biquadratic triangle, 8 of a biquadratic quadrilateral, 4 of a quadratic-linear quadrilateral.
INSTANTIATE_TEST_SUITE_P(Types, EveryCellType,
  testing::Values(CellTypeCase{ VTK_TETRA, 12, 0 }, CellTypeCase{ VTK_VOXEL, 0, 0 },
    CellTypeCase{ VTK_HEXAHEDRON, 0, 0 }, CellTypeCase{ VTK_WEDGE, 2 * 3, 0 },
    CellTypeCase{ VTK_PYRAMID, 6 * 2, 0 }, CellTypeCase{ VTK_POLYHEDRON, 6, 0 },
    CellTypeCase{ VTK_QUADRATIC_TETRA, 12 * 16, 12 },
    CellTypeCase{ VTK_QUADRATIC_HEXAHEDRON, 36, 1 },
    CellTypeCase{ VTK_TRIQUADRATIC_HEXAHEDRON, 48, 0 },
    CellTypeCase{ VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, 4 * 8 + 2 * 6, 1 },
    CellTypeCase{ VTK_QUADRATIC_WEDGE, 2 * (2 * 4 + 3 * 6), 2 },
    CellTypeCase{ VTK_QUADRATIC_LINEAR_WEDGE, 2 * (2 * 4 + 3 * 4), 2 },
    CellTypeCase{ VTK_BIQUADRATIC_QUADRATIC_WEDGE, 2 * (2 * 4 + 3 * 8), 2 },
    CellTypeCase{ VTK_QUADRATIC_PYRAMID, 6 * (6 + 4 * 4), 6 },
    CellTypeCase{ VTK_TRIQUADRATIC_PYRAMID, 6 * (8 + 4 * 6), 0 }),
  NameCase);

TEST(TetrahedraIntake, CellsTakeTheFirstOfMergedPoints)
{
  // Two boxes with four points in common, which the second has as points of its own: 8 to 11 at 1,
  // 2, 5, 6. A tetrahedron whose points 0 and 12 are merged encloses nothing.
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (const CellPatch::Position& x : Box)
  {
    points->InsertNextPoint(x.data());
  }
  for (const int corner : { 1, 2, 5, 6 })
  {
    points->InsertNextPoint(Box[corner].data());
  }
  points->InsertNextPoint(0, 0, 0);
  for (const int corner : { 1, 2, 5, 6 })
  {
    points->InsertNextPoint(2, Box[corner][1], Box[corner][2]);
  }
  grid->SetPoints(points);
  const vtkIdType first[] = { 0, 1, 2, 3, 4, 5, 6, 7 };
  const vtkIdType second[] = { 8, 13, 14, 9, 10, 15, 16, 11 };
  const vtkIdType flat[] = { 0, 12, 3, 4 };
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, first);
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, second);
  grid->InsertNextCell(VTK_TETRA, 4, flat);
  const TetrahedraIntake apart = TakeInTetrahedra(grid);
  EXPECT_EQ(
    FindFaceNeighbors(apart.Mesh.Cells, apart.Mesh.GetNumberOfPoints()).NumberOfComponents, 3);

  CoincidentPoints merged;
  merged.Points = { 8, 9, 10, 11, 12 };
  merged.Firsts = { 1, 2, 5, 6, 0 };
  const TetrahedraIntake intake = TakeInTetrahedra(grid, {}, merged);
  ASSERT_EQ(intake.Error, "");
  const FaceNeighbors neighbors =
    FindFaceNeighbors(intake.Mesh.Cells, intake.Mesh.GetNumberOfPoints());
  EXPECT_EQ(neighbors.NumberOfComponents, 1);
  EXPECT_EQ(neighbors.BoundaryFaces.size(), 2U * 10);
  EXPECT_EQ(intake.Mesh.GetNumberOfPoints(), 17U) << "ids are those of the input";
  EXPECT_EQ(intake.Report.InvalidCells, 1);
}

namespace
{

/// One cell of each type that is accepted, on its corners.
struct OneCell
{
  int Type;
  std::vector<CellPatch::Position> Corners;
};

std::vector<CellPatch::Position> MakePrism(int sides)
{
  std::vector<CellPatch::Position> corners;
  for (int level : { 0, 1 })
  {
    for (int i = 0; i < sides; ++i)
    {
      const double angle = 2 * std::acos(-1.0) * i / sides;
      corners.push_back({ std::cos(angle), std::sin(angle), double(level) });
    }
  }
  return corners;
}

class CellAmongOthers : public testing::TestWithParam<OneCell>
{
protected:
  /// The cell with its points in order, or on points of a grid that has others, in any order,
  /// behind a hexahedron and before a tetrahedron.
  vtkSmartPointer<vtkUnstructuredGrid> MakeGrid(bool amongOthers, std::uint64_t seed) const
  {
    CellPatch patch;
    if (amongOthers)
    {
      patch.AddBoxes(VTK_HEXAHEDRON, 7, 0, 0, 1, 1, 1);
    }
    if (this->GetParam().Type == VTK_POLYHEDRON)
    {
      patch.AddBoxes(VTK_POLYHEDRON, 0, 0, 0, 1, 1, 1);
    }
    else
    {
      patch.AddCell(this->GetParam().Type, this->GetParam().Corners);
    }
    if (amongOthers)
    {
      patch.AddCell(VTK_TETRA, { { 5, 0, 0 }, { 6, 0, 0 }, { 5, 1, 0 }, { 5, 0, 1 } });
    }
    return patch.MakeGrid(seed, MapAffine);
  }

  /// The volume of the cell's tetrahedra.
  static double GetCellVolume(TetrahedralMesh mesh, std::int64_t cell, std::int64_t* notPositive)
  {
    std::vector<std::int32_t> kept;
    for (std::size_t i = 0; i < mesh.GetNumberOfCells(); ++i)
    {
      if (mesh.OriginalCells.empty() || mesh.OriginalCells[i] == cell)
      {
        kept.insert(kept.end(), &mesh.Cells[4 * i], &mesh.Cells[4 * i] + 4);
      }
    }
    mesh.Cells = std::move(kept);
    return GetVolume(mesh, notPositive);
  }
};

std::string NameCell(const testing::TestParamInfo<OneCell>& info)
{
  return GetCellTypeName(info.param.Type);
}

/// Linear in the coordinates.
double GetField(const double* x) { return 3 + x[0] - 2 * x[1] + 0.5 * x[2]; }

} // namespace

TEST_P(CellAmongOthers, HasTheVolumeAndTheScalarsThatItHasAlone)
{
  std::int64_t notPositive = 0;
  const double alone =
    GetCellVolume(TakeInTetrahedra(this->MakeGrid(false, 0)).Mesh, 0, &notPositive);
  EXPECT_EQ(notPositive, 0);
  EXPECT_GT(alone, 0.05);
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    auto grid = this->MakeGrid(true, seed);
    vtkNew<vtkDoubleArray> field;
    field->SetName("Field");
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    {
      field->InsertNextValue(GetField(grid->GetPoint(i)));
    }
    grid->GetPointData()->SetScalars(field);
    const TetrahedraIntake intake = TakeInTetrahedra(grid);
    EXPECT_NEAR(GetCellVolume(intake.Mesh, 1, &notPositive), alone, VolumeTolerance);
    EXPECT_EQ(notPositive, 0);
    EXPECT_NEAR(
      GetCellVolume(intake.Mesh, 0, &notPositive), GetAffineDeterminant(), VolumeTolerance);
    EXPECT_NEAR(
      GetCellVolume(intake.Mesh, 2, &notPositive), GetAffineDeterminant() / 6, VolumeTolerance);
    const ExtractedScalars scalars = ExtractScalars(grid, intake.Mesh, {});
    ASSERT_EQ(scalars.Error, "");
    for (std::size_t i = 0; i < intake.Mesh.GetNumberOfPoints(); ++i)
    {
      EXPECT_NEAR(scalars.Values[i], GetField(&intake.Mesh.Points[3 * i]), FieldTolerance);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Types, CellAmongOthers,
  testing::Values(OneCell{ VTK_TETRA, Tetrahedron }, OneCell{ VTK_VOXEL, VoxelCorners },
    OneCell{ VTK_HEXAHEDRON, Box }, OneCell{ VTK_WEDGE, Wedge }, OneCell{ VTK_PYRAMID, Pyramid },
    OneCell{ VTK_PENTAGONAL_PRISM, MakePrism(5) }, OneCell{ VTK_HEXAGONAL_PRISM, MakePrism(6) },
    OneCell{ VTK_POLYHEDRON, {} }, OneCell{ VTK_CONVEX_POINT_SET, Box },
    OneCell{ VTK_QUADRATIC_TETRA, Tetrahedron }, OneCell{ VTK_QUADRATIC_HEXAHEDRON, Box },
    OneCell{ VTK_TRIQUADRATIC_HEXAHEDRON, Box },
    OneCell{ VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, Box }, OneCell{ VTK_QUADRATIC_WEDGE, Wedge },
    OneCell{ VTK_QUADRATIC_LINEAR_WEDGE, Wedge }, OneCell{ VTK_BIQUADRATIC_QUADRATIC_WEDGE, Wedge },
    OneCell{ VTK_QUADRATIC_PYRAMID, Pyramid }, OneCell{ VTK_TRIQUADRATIC_PYRAMID, Pyramid }),
  NameCell);

TEST(TetrahedraIntake, DifferentCellTypesAgreeOnTheirFaces)
{
  CellPatch patch;
  patch.AddBoxes(VTK_HEXAHEDRON, 0, 0, 0, 1, 2, 2);
  patch.AddBoxes(VTK_PYRAMID, 1, 0, 0, 1, 2, 2);
  patch.AddBoxes(VTK_WEDGE, 2, 0, 0, 1, 2, 2);
  patch.AddBoxes(VTK_POLYHEDRON, 3, 0, 0, 1, 2, 2);
  patch.AddBoxes(VTK_VOXEL, 4, 0, 0, 1, 2, 2);
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
  {
    auto grid = patch.MakeGrid(seed, MapAffine);
    const TetrahedraIntake intake = TakeInTetrahedra(grid);
    std::int64_t notPositive = 0;
    EXPECT_NEAR(GetVolume(intake.Mesh, &notPositive), 20 * GetAffineDeterminant(), VolumeTolerance);
    EXPECT_EQ(notPositive, 0);
    EXPECT_EQ(FindConformityProblem(intake.Mesh, MakeToBox(grid, intake.Mesh), { 5, 2, 2 }), "");
    ASSERT_EQ(intake.Mesh.OriginalCells.size(), intake.Mesh.GetNumberOfCells());
    EXPECT_EQ(intake.Mesh.OriginalCells.front(), 0);
    EXPECT_EQ(intake.Mesh.OriginalCells.back(), grid->GetNumberOfCells() - 1);
  }
}

TEST(TetrahedraIntake, PrismsShareTheirSides)
{
  for (int sides : { 5, 6 })
  {
    // Two prisms one above the other, and their volume from the regular polygon's area.
    const double pi = std::acos(-1.0);
    // Each corner is shifted by at most half a part in x and in y, and the sides with it: in cubed
    // units, their area is less than that of the cylinder around them.
    const double sideShift = 2 * 2 * pi * std::sqrt(0.5) / CellPatch::PartsOfUnit;
    CellPatch patch;
    for (int layer : { 0, 1 })
    {
      std::vector<CellPatch::Position> corners;
      for (int level : { layer, layer + 1 })
      {
        for (int i = 0; i < sides; ++i)
        {
          corners.push_back(
            { std::cos(2 * pi * i / sides), std::sin(2 * pi * i / sides), double(level) });
        }
      }
      patch.AddCell(sides == 5 ? VTK_PENTAGONAL_PRISM : VTK_HEXAGONAL_PRISM, corners);
    }
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
      auto grid = patch.MakeGrid(seed, KeepPosition);
      const TetrahedraIntake intake = TakeInTetrahedra(grid);
      std::int64_t notPositive = 0;
      EXPECT_NEAR(
        GetVolume(intake.Mesh, &notPositive), sides * std::sin(2 * pi / sides), sideShift);
      EXPECT_EQ(notPositive, 0);
      EXPECT_EQ(intake.Mesh.GetNumberOfPoints(), 3u * sides) << "a convex prism needs no new point";
      EXPECT_EQ(CountBoundaryFaces(intake.Mesh), 2u * (sides - 2) + 2u * 2 * sides);
    }
  }
}

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

TEST(TetrahedraIntake, AllTetrahedraPassAsTheyAre)
{
  CellPatch patch;
  patch.AddBoxes(VTK_TETRA, 0, 0, 0, 2, 2, 2);
  auto grid = patch.MakeGrid(7, KeepPosition);
  for (bool wide : { false, true })
  {
    wide ? grid->GetCells()->ConvertTo64BitStorage() : grid->GetCells()->ConvertTo32BitStorage();
    const TetrahedraIntake intake = TakeInTetrahedra(grid);
    EXPECT_TRUE(intake.Mesh.OriginalCells.empty());
    EXPECT_TRUE(intake.Mesh.OriginalPoints.empty());
    ASSERT_EQ(intake.Mesh.GetNumberOfCells(), static_cast<std::size_t>(grid->GetNumberOfCells()));
    for (vtkIdType cellId = 0; cellId < grid->GetNumberOfCells(); ++cellId)
    {
      vtkNew<vtkIdList> ids;
      grid->GetCellPoints(cellId, ids);
      for (int i = 0; i < 4; ++i)
      {
        EXPECT_EQ(intake.Mesh.Cells[4 * cellId + i], ids->GetId(i));
      }
    }
  }
}

TEST(TetrahedraIntake, SinglePrecisionAndIntegerPointsAreRead)
{
  for (int type : { VTK_FLOAT, VTK_DOUBLE, VTK_INT })
  {
    vtkNew<vtkPoints> points;
    points->SetDataType(type);
    points->InsertNextPoint(0, 0, 0);
    points->InsertNextPoint(3, 0, 0);
    points->InsertNextPoint(0, 4, 0);
    points->InsertNextPoint(0, 0, 5);
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(points);
    const vtkIdType ids[4] = { 0, 1, 2, 3 };
    grid->InsertNextCell(VTK_TETRA, 4, ids);
    EXPECT_DOUBLE_EQ(GetVolume(TakeInTetrahedra(grid).Mesh), 10) << "type " << type;
  }
}

TEST(TetrahedraIntake, GhostAndBlankedCellsAreCounted)
{
  CellPatch patch;
  patch.AddBoxes(VTK_HEXAHEDRON, 0, 0, 0, 5, 1, 1);
  auto grid = patch.MakeGrid(3, KeepPosition);
  grid->GetCellData()->AddArray(MakeGhostArray(5,
    {
      { 0, vtkDataSetAttributes::DUPLICATECELL }, { 1, vtkDataSetAttributes::HIDDENCELL },
      { 2, vtkDataSetAttributes::REFINEDCELL },
      { 3, vtkDataSetAttributes::EXTERIORCELL }, // says nothing about visibility
    }));
  TetrahedraIntake intake = TakeInTetrahedra(grid);
  EXPECT_EQ(intake.Report.GhostCells, 1);
  EXPECT_EQ(intake.Report.BlankedCells, 2);
  EXPECT_NEAR(GetVolume(intake.Mesh), 2, VolumeTolerance);
  EXPECT_EQ(
    std::set<std::int64_t>(intake.Mesh.OriginalCells.begin(), intake.Mesh.OriginalCells.end()),
    (std::set<std::int64_t>{ 3, 4 }));

  // A hidden corner hides the cells around it; a duplicated one does not.
  grid->GetCellData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  vtkNew<vtkIdList> ids;
  grid->GetCellPoints(0, ids);
  const vtkIdType corner = ids->GetId(0); // at x = 0
  grid->GetPointData()->AddArray(MakeGhostArray(grid->GetNumberOfPoints(),
    { { corner, vtkDataSetAttributes::HIDDENPOINT } }, vtkDataSetAttributes::DUPLICATEPOINT));
  intake = TakeInTetrahedra(grid);
  EXPECT_EQ(intake.Report.BlankedCells, 1);
  EXPECT_NEAR(GetVolume(intake.Mesh), 4, VolumeTolerance);
}

TEST(TetrahedraIntake, TetrahedraWithGhostsAreLeftOut)
{
  CellPatch patch;
  patch.AddBoxes(VTK_TETRA, 0, 0, 0, 1, 1, 1);
  auto grid = patch.MakeGrid(3, KeepPosition);
  grid->GetCellData()->AddArray(MakeGhostArray(12, { { 4, vtkDataSetAttributes::DUPLICATECELL } }));
  const TetrahedraIntake intake = TakeInTetrahedra(grid);
  EXPECT_EQ(intake.Mesh.GetNumberOfCells(), 11u);
  EXPECT_EQ(intake.Mesh.OriginalCells[4], 5);
}

TEST(TetrahedraIntake, BlankedCellsOfAStructuredGrid)
{
  vtkNew<vtkStructuredGrid> grid;
  vtkNew<vtkPoints> points;
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 4; ++j)
    {
      for (int i = 0; i < 4; ++i)
      {
        points->InsertNextPoint(i, j, k);
      }
    }
  }
  grid->SetDimensions(4, 4, 4);
  grid->SetPoints(points);
  EXPECT_NEAR(GetVolume(TakeInTetrahedra(grid).Mesh), 27, VolumeTolerance);
  grid->BlankCell(13); // the middle one
  TetrahedraIntake intake = TakeInTetrahedra(grid);
  EXPECT_EQ(intake.Report.BlankedCells, 1);
  EXPECT_NEAR(GetVolume(intake.Mesh), 26, VolumeTolerance);
  grid->BlankPoint(0);
  intake = TakeInTetrahedra(grid);
  EXPECT_EQ(intake.Report.BlankedCells, 2);
  EXPECT_NEAR(GetVolume(intake.Mesh), 25, VolumeTolerance);
}

TEST(TetrahedraIntake, LowerDimensionalCellsAreIgnoredAndCounted)
{
  CellPatch patch;
  patch.AddBoxes(VTK_HEXAHEDRON, 0, 0, 0, 2, 1, 1);
  auto grid = patch.MakeGrid(3, KeepPosition);
  const vtkIdType ids[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
  grid->InsertNextCell(VTK_VERTEX, 1, ids);
  grid->InsertNextCell(VTK_POLY_LINE, 3, ids);
  grid->InsertNextCell(VTK_QUAD, 4, ids);
  grid->InsertNextCell(VTK_QUADRATIC_TRIANGLE, 6, ids);
  grid->InsertNextCell(VTK_LAGRANGE_TRIANGLE, 6, ids);
  const TetrahedraIntake intake = TakeInTetrahedra(grid);
  EXPECT_EQ(intake.Report.LowerDimensionalCells, 5);
  EXPECT_EQ(intake.Report.GetNumberOfSkippedCells(), 0);
  EXPECT_NEAR(GetVolume(intake.Mesh), 2, VolumeTolerance);

  vtkNew<vtkImageData> plane;
  plane->SetDimensions(4, 5, 1);
  const TetrahedraIntake flat = TakeInTetrahedra(plane);
  EXPECT_EQ(flat.Error, "");
  EXPECT_EQ(flat.Report.LowerDimensionalCells, 12);
  EXPECT_EQ(flat.Mesh.GetNumberOfCells(), 0u);
}

TEST(TetrahedraIntake, CellsThatCannotBeSplitAreNamed)
{
  CellPatch patch;
  patch.AddBoxes(VTK_HEXAHEDRON, 0, 0, 0, 1, 1, 1);
  auto grid = patch.MakeGrid(3, KeepPosition);
  const vtkIdType ids[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
  vtkIdType many[27] = {};
  std::copy(std::begin(ids), std::end(ids), many);
  grid->InsertNextCell(VTK_LAGRANGE_HEXAHEDRON, 12, many);
  grid->InsertNextCell(VTK_LAGRANGE_HEXAHEDRON, 27, many);
  grid->InsertNextCell(VTK_BEZIER_TETRAHEDRON, 10, many);
  const TetrahedraIntake intake = TakeInTetrahedra(grid);
  EXPECT_EQ(intake.Report.GetNumberOfSkippedCells(), 3);
  EXPECT_EQ(intake.Report.DescribeSkippedCells(), "2 vtkLagrangeHexahedron, 1 vtkBezierTetra");
  EXPECT_NEAR(GetVolume(intake.Mesh), 1, VolumeTolerance);
  EXPECT_EQ(GetCellTypeName(200), "cell type 200");
}

TEST(TetrahedraIntake, LagrangeAndBezierCellsOfOrderOneAreLinear)
{
  struct Case
  {
    int Type;
    std::vector<CellPatch::Position> Corners;
    double Volume;
  };
  const std::vector<CellPatch::Position> turnedWedge = { Wedge[0], Wedge[2], Wedge[1], Wedge[3],
    Wedge[5], Wedge[4] };
  const double pyramid = 1.0 / 3;
  for (const Case& linear :
    { Case{ VTK_LAGRANGE_TETRAHEDRON, Tetrahedron, 1.0 / 6 },
      Case{ VTK_BEZIER_TETRAHEDRON, Tetrahedron, 1.0 / 6 }, Case{ VTK_LAGRANGE_HEXAHEDRON, Box, 1 },
      Case{ VTK_BEZIER_HEXAHEDRON, Box, 1 }, Case{ VTK_LAGRANGE_WEDGE, turnedWedge, 0.5 },
      Case{ VTK_BEZIER_WEDGE, turnedWedge, 0.5 }, Case{ VTK_LAGRANGE_PYRAMID, Pyramid, pyramid },
      Case{ VTK_BEZIER_PYRAMID, Pyramid, pyramid } })
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    std::vector<vtkIdType> ids;
    for (const CellPatch::Position& x : linear.Corners)
    {
      ids.push_back(points->InsertNextPoint(x.data()));
    }
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(points);
    grid->InsertNextCell(linear.Type, static_cast<vtkIdType>(ids.size()), ids.data());
    TetrahedraIntake intake = TakeInTetrahedra(grid);
    std::int64_t notPositive = 0;
    EXPECT_NEAR(GetVolume(intake.Mesh, &notPositive), linear.Volume, VolumeTolerance)
      << "type " << linear.Type;
    EXPECT_EQ(notPositive, 0) << "type " << linear.Type;
    EXPECT_EQ(intake.Report.CellsByType.at(linear.Type), 1);
    EXPECT_EQ(intake.Report.GetNumberOfSkippedCells(), 0);

    // With weights, a Bezier cell's scalars are quotients.
    vtkNew<vtkDoubleArray> weights;
    weights->SetName("Weights");
    weights->SetNumberOfTuples(grid->GetNumberOfPoints());
    weights->FillValue(1);
    grid->GetPointData()->SetRationalWeights(weights);
    intake = TakeInTetrahedra(grid);
    const bool isBezier = linear.Type >= VTK_BEZIER_CURVE;
    EXPECT_EQ(intake.Report.GetNumberOfSkippedCells(), isBezier ? 1 : 0) << linear.Type;
  }
}

TEST(TetrahedraIntake, CellsThatNamePointsThatDoNotExistAreCounted)
{
  CellPatch patch;
  patch.AddBoxes(VTK_TETRA, 0, 0, 0, 1, 1, 1);
  auto grid = patch.MakeGrid(3, KeepPosition);
  const vtkIdType beyond[4] = { 0, 1, 2, grid->GetNumberOfPoints() };
  const vtkIdType negative[4] = { 0, -1, 2, 3 };
  const vtkIdType tooFew[3] = { 0, 1, 2 };
  grid->InsertNextCell(VTK_TETRA, 4, beyond);
  grid->InsertNextCell(VTK_TETRA, 4, negative);
  grid->InsertNextCell(VTK_HEXAHEDRON, 4, beyond);
  grid->InsertNextCell(VTK_TETRA, 3, tooFew);
  const TetrahedraIntake intake = TakeInTetrahedra(grid);
  EXPECT_EQ(intake.Report.InvalidCells, 4);
  EXPECT_EQ(intake.Mesh.GetNumberOfCells(), 12u);
}

TEST(TetrahedraIntake, DamagedGridsAreRefused)
{
  const auto expectError = [](vtkDataObject* input, const std::string& text)
  {
    const TetrahedraIntake intake = TakeInTetrahedra(input);
    EXPECT_NE(intake.Error.find("damaged"), std::string::npos) << intake.Error;
    EXPECT_NE(intake.Error.find(text), std::string::npos) << intake.Error;
  };
  vtkNew<vtkDoubleArray> three;
  three->SetNumberOfTuples(3);
  three->FillValue(0);
  vtkNew<vtkRectilinearGrid> rectilinear;
  rectilinear->SetDimensions(3, 3, 4);
  rectilinear->SetXCoordinates(three);
  rectilinear->SetYCoordinates(three);
  rectilinear->SetZCoordinates(three);
  expectError(rectilinear, "4 planes along z, but 3 coordinates");
  rectilinear->SetExtent(VTK_INT_MAX, 5, 0, 2, 0, 2);
  expectError(rectilinear, "extent");

  vtkNew<vtkStructuredGrid> structured;
  structured->SetDimensions(2, 2, 2);
  structured->SetPoints(vtkNew<vtkPoints>());
  expectError(structured, "2 x 2 x 2 points has 0 of them");
  structured->SetExtent(0, VTK_INT_MAX - 1, 0, VTK_INT_MAX - 1, 0, VTK_INT_MAX - 1);
  expectError(structured, "2147483647 x 2147483647 x 2147483647 points has 0 of them");

  CellPatch patch;
  patch.AddBoxes(VTK_HEXAHEDRON, 0, 0, 0, 2, 1, 1);
  auto grid = patch.MakeGrid(1, KeepPosition);
  grid->GetCellTypesArray()->SetNumberOfValues(1);
  expectError(grid, "2 cells, but types for 1");
}

TEST(TetrahedraIntake, DamagedPolyhedraAreLeftOut)
{
  const std::vector<vtkIdType> cube = { 6, 4, 0, 2, 3, 1, 4, 4, 5, 7, 6, 4, 0, 1, 5, 4, 4, 2, 6, 7,
    3, 4, 0, 4, 6, 2, 4, 1, 3, 7, 5 };
  const auto countTetrahedra =
    [](const std::vector<vtkIdType>& faces, const std::vector<vtkIdType>& locations)
  {
    vtkNew<vtkPoints> points;
    for (int i = 0; i < 8; ++i)
    {
      points->InsertNextPoint(i & 1, i >> 1 & 1, i >> 2);
    }
    const auto makeArray = [](const std::vector<vtkIdType>& values)
    {
      auto array = vtkSmartPointer<vtkIdTypeArray>::New();
      for (const vtkIdType value : values)
      {
        array->InsertNextValue(value);
      }
      return array;
    };
    vtkNew<vtkCellArray> cells;
    cells->SetData(makeArray({ 0, 8 }), makeArray({ 0, 1, 2, 3, 4, 5, 6, 7 }));
    vtkNew<vtkUnsignedCharArray> types;
    types->InsertNextValue(VTK_POLYHEDRON);
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(points);
    grid->SetCells(types, cells, makeArray(locations), makeArray(faces));
    return TakeInTetrahedra(grid).Mesh.GetNumberOfCells();
  };
  const auto change = [&cube](std::size_t at, vtkIdType value)
  {
    std::vector<vtkIdType> faces = cube;
    faces[at] = value;
    return faces;
  };
  EXPECT_GT(countTetrahedra(cube, { 0 }), 4u);
  constexpr vtkIdType Beyond = 1000000000;
  for (const vtkIdType location : { vtkIdType(-2), vtkIdType(31), Beyond })
  {
    EXPECT_EQ(countTetrahedra(cube, { location }), 0u) << location;
  }
  EXPECT_EQ(countTetrahedra(cube, {}), 0u);
  EXPECT_EQ(countTetrahedra({}, { 0 }), 0u);
  EXPECT_EQ(countTetrahedra({ cube.begin(), cube.begin() + 9 }, { 0 }), 0u);
  EXPECT_EQ(countTetrahedra(change(0, -1), { 0 }), 0u);
  EXPECT_EQ(countTetrahedra(change(1, Beyond), { 0 }), 0u);
  EXPECT_EQ(countTetrahedra(change(6, VTK_ID_MAX), { 0 }), 0u);
  EXPECT_EQ(countTetrahedra(change(0, Beyond), { 0 }), countTetrahedra(cube, { 0 }));
}

TEST(TetrahedraIntake, CellsOutsideOfTheirArrayAreFound)
{
  const auto describe = [](vtkIdType offset)
  {
    CellPatch patch;
    patch.AddBoxes(VTK_HEXAHEDRON, 0, 0, 0, 3, 1, 1);
    auto grid = patch.MakeGrid(1, KeepPosition);
    grid->GetCells()->ConvertTo64BitStorage();
    vtkTypeInt64Array* offsets = grid->GetCells()->GetOffsetsArray64();
    offsets->SetValue(1, offset == -1 ? offsets->GetValue(1) : offset);
    return FindDamageOfCells(grid);
  };
  EXPECT_EQ(describe(-1), "");
  EXPECT_EQ(describe(-8), "the points of its cell 0 are not in its array of them");
  EXPECT_EQ(describe(17), "the points of its cell 1 are not in its array of them");
  EXPECT_EQ(describe(VTK_ID_MAX), "the points of its cell 0 are not in its array of them");
}

TEST(TetrahedraIntake, CollapsedHexahedronKeepsItsVolume)
{
  // A hexahedron whose edge 1-2 and edge 5-6 are points is a wedge of half the volume.
  vtkNew<vtkPoints> points;
  const double x[6][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 1 },
    { 0, 1, 1 } };
  for (const auto& point : x)
  {
    points->InsertNextPoint(point);
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  const vtkIdType ids[8] = { 0, 1, 1, 2, 3, 4, 4, 5 };
  grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
  const TetrahedraIntake intake = TakeInTetrahedra(grid);
  std::int64_t notPositive = 0;
  EXPECT_NEAR(GetVolume(intake.Mesh, &notPositive), 0.5, VolumeTolerance);
  EXPECT_EQ(notPositive, 0);
}

TEST(TetrahedraIntake, GridsSplitIntoFiveTetrahedraACell)
{
  vtkNew<vtkImageData> image;
  image->SetExtent(3, 6, -1, 3, 2, 4);
  image->SetSpacing(0.5, 1, 2);
  const double turned[9] = { 0, -1, 0, 1, 0, 0, 0, 0, 1 };
  image->SetDirectionMatrix(turned);

  vtkNew<vtkRectilinearGrid> rectilinear;
  rectilinear->SetDimensions(4, 5, 3);
  for (int axis = 0; axis < 3; ++axis)
  {
    vtkNew<vtkDoubleArray> coordinates;
    for (int i = 0; i < 5 - (axis != 1) - (axis == 2); ++i)
    {
      coordinates->InsertNextValue(0.5 * i * i);
    }
    axis == 0     ? rectilinear->SetXCoordinates(coordinates)
      : axis == 1 ? rectilinear->SetYCoordinates(coordinates)
                  : rectilinear->SetZCoordinates(coordinates);
  }

  const auto check = [](vtkDataSet* dataSet, double volume)
  {
    const TetrahedraIntake intake = TakeInTetrahedra(dataSet);
    ASSERT_EQ(intake.Error, "");
    EXPECT_EQ(intake.Mesh.GetNumberOfCells(), 5u * 3 * 4 * 2);
    EXPECT_EQ(intake.Report.CellsByType.at(VTK_VOXEL), 3 * 4 * 2);
    std::int64_t notPositive = 0;
    EXPECT_NEAR(GetVolume(intake.Mesh, &notPositive), volume, VolumeTolerance);
    EXPECT_EQ(notPositive, 0);
    const auto toBox = [](std::int64_t point) -> CellPatch::Position {
      return { double(point % 4), double(point / 4 % 5), double(point / 20) };
    };
    EXPECT_EQ(FindConformityProblem(intake.Mesh, toBox, { 3, 4, 2 }), "");
  };
  check(image, 3 * 4 * 2);
  check(rectilinear, 4.5 * 8 * 2);
}

TEST(TetrahedraIntake, NeighbouringPiecesOfAnImageCutTheirCommonFaceAlike)
{
  const auto edgesInPlane = [](int from, int to)
  {
    vtkNew<vtkImageData> image;
    image->SetExtent(from, to, 0, 4, 0, 4);
    const TetrahedraIntake intake = TakeInTetrahedra(image);
    std::set<std::pair<CellPatch::Position, CellPatch::Position>> edges;
    for (std::size_t i = 0; i < intake.Mesh.Cells.size(); ++i)
    {
      for (std::size_t j = i / 4 * 4; j < i / 4 * 4 + 4; ++j)
      {
        const double* a = &intake.Mesh.Points[3 * intake.Mesh.Cells[i]];
        const double* b = &intake.Mesh.Points[3 * intake.Mesh.Cells[j]];
        if (a[0] == 3 && b[0] == 3)
        {
          edges.insert({ { a[0], a[1], a[2] }, { b[0], b[1], b[2] } });
        }
      }
    }
    return edges;
  };
  EXPECT_EQ(edgesInPlane(0, 3), edgesInPlane(3, 5));
}

TEST(TetrahedraIntake, BlocksAreConcatenated)
{
  CellPatch hexahedra;
  hexahedra.AddBoxes(VTK_HEXAHEDRON, 0, 0, 0, 2, 1, 1);
  CellPatch quadratic;
  quadratic.AddBoxes(VTK_QUADRATIC_HEXAHEDRON, 0, 0, 0, 1, 1, 1);
  auto first = hexahedra.MakeGrid(1, KeepPosition);
  auto second = quadratic.MakeGrid(2, MapAffine);
  vtkNew<vtkImageData> third;
  third->SetDimensions(2, 2, 2);
  vtkNew<vtkTable> table;
  vtkNew<vtkPolyData> nothing;
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(0, second);
  inner->SetBlock(1, table);
  inner->SetBlock(2, third);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetNumberOfBlocks(4);
  blocks->SetBlock(0, nothing);
  blocks->SetBlock(1, first);
  blocks->SetBlock(3, inner); // block 2 is missing

  const TetrahedraIntake intake = TakeInTetrahedra(blocks);
  ASSERT_EQ(intake.Error, "");
  EXPECT_EQ(intake.Report.Blocks, 4);
  EXPECT_EQ(intake.Report.SkippedBlocks, 1);
  EXPECT_EQ(intake.Report.NumberOfPoints, 12 + 20 + 8);
  EXPECT_EQ(intake.Mesh.GetNumberOfPoints(), 12u + 20 + 8 + 1);
  EXPECT_EQ(intake.Mesh.OriginalPoints.back(), -1);
  EXPECT_EQ(
    std::set<std::int64_t>(intake.Mesh.OriginalCells.begin(), intake.Mesh.OriginalCells.end()),
    (std::set<std::int64_t>{ 0, 1, 2, 3 }));
  EXPECT_NEAR(GetVolume(intake.Mesh), 2 + GetAffineDeterminant() + 1, VolumeTolerance);
  for (std::int64_t source : intake.Mesh.AddedPoints.Sources)
  {
    EXPECT_GE(source, 12);
    EXPECT_LT(source, 32);
  }
}

TEST(TetrahedraIntake, EmptyInputsGiveEmptyMeshes)
{
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkStructuredGrid> structured;
  vtkNew<vtkImageData> image;
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (vtkDataObject* input : std::vector<vtkDataObject*>{ grid, structured, image, blocks })
  {
    const TetrahedraIntake intake = TakeInTetrahedra(input);
    EXPECT_EQ(intake.Error, "");
    EXPECT_EQ(intake.Mesh.GetNumberOfCells(), 0u);
  }
}

TEST(TetrahedraIntake, WhatIsNoDataSetIsRefused)
{
  vtkNew<vtkTable> table;
  EXPECT_EQ(TakeInTetrahedra(table).Error,
    "the input is a vtkTable, not a data set or a composite of data sets");
  EXPECT_EQ(TakeInTetrahedra(nullptr).Error, "there is no input");
}

TEST(TetrahedraIntake, InputsThatAreTooLargeAreRefusedBeforeAnyWork)
{
  vtkNew<vtkImageData> image; // without arrays it takes no memory
  image->SetDimensions(1300, 1300, 1300);
  EXPECT_EQ(TakeInTetrahedra(image).Error,
    "the input has 2197000000 points, counting those that splitting adds; at most 2147483647 are "
    "possible");
  image->SetDimensions(480, 480, 480);
  EXPECT_EQ(TakeInTetrahedra(image).Error,
    "the input splits into more than 536870911 tetrahedra, which is the most that is possible");
}

TEST(TetrahedraIntake, ProgressRisesAndAborts)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(101, 101, 101);
  std::vector<double> fractions;
  EXPECT_FALSE(TakeInTetrahedra(image,
    [&](double fraction)
    {
      fractions.push_back(fraction);
      return true;
    }).Aborted);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1);
  EXPECT_GT(fractions.size(), 1u);

  const TetrahedraIntake aborted = TakeInTetrahedra(image, [](double) { return false; });
  EXPECT_TRUE(aborted.Aborted);
  EXPECT_EQ(aborted.Mesh.GetNumberOfCells(), 0u);
}

TEST(TetrahedraIntake, TheNumberOfThreadsDoesNotMatter)
{
  CellPatch patch;
  patch.AddBoxes(VTK_HEXAHEDRON, 0, 0, 0, 20, 20, 20);
  patch.AddBoxes(VTK_QUADRATIC_PYRAMID, 20, 0, 0, 1, 20, 20);
  auto grid = patch.MakeGrid(5, MapWarped);
  TetrahedraIntake one;
  TetrahedraIntake four;
  vtkSMPTools::LocalScope(
    vtkSMPTools::Config(1, "Sequential", false), [&] { one = TakeInTetrahedra(grid); });
  vtkSMPTools::LocalScope(
    vtkSMPTools::Config(4, "STDThread", false), [&] { four = TakeInTetrahedra(grid); });
  EXPECT_EQ(one.Mesh.Points, four.Mesh.Points);
  EXPECT_EQ(one.Mesh.Cells, four.Mesh.Cells);
  EXPECT_EQ(one.Mesh.OriginalCells, four.Mesh.OriginalCells);
  EXPECT_EQ(one.Mesh.AddedPoints.Offsets, four.Mesh.AddedPoints.Offsets);
  EXPECT_EQ(one.Mesh.AddedPoints.Sources, four.Mesh.AddedPoints.Sources);
}
