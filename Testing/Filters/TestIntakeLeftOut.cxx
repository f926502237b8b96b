// SPDX-License-Identifier: BSD-3-Clause

// Cells that are hidden, of no use or damaged, and what is told about them.

#include "Intake/TetrahedraIntake.h"

#include "GhostArray.h"
#include "Intake/DataSetCheck.h"
#include "Intake/LeftOutCells.h"
#include "IntakeChecks.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkRectilinearGrid.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredGrid.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

using namespace tetralux;

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
