// SPDX-License-Identifier: BSD-3-Clause

// Whole inputs: grids, blocks, merged points, precision, progress and threads.

#include "Intake/TetrahedraIntake.h"

#include "Intake/DataSetCheck.h"
#include "Intake/LeftOutCells.h"
#include "IntakeChecks.h"

#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkSMPTools.h"
#include "vtkStructuredGrid.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <vector>

using namespace tetralux;

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
