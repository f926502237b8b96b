// SPDX-License-Identifier: BSD-3-Clause

// Each type of cell, alone and among others.

#include "Intake/TetrahedraIntake.h"

#include "CellPatch.h"
#include "Intake/DataSetCheck.h"
#include "Intake/LeftOutCells.h"
#include "Intake/ScalarExtraction.h"
#include "IntakeChecks.h"

#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

using namespace tetralux;

namespace
{

/// The largest error of a field of values up to 150 that is interpolated from 20 points at most.
constexpr double FieldTolerance = 1e-12;

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
