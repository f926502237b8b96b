// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedralizeCells.h"

#include "CellPatch.h"
#include "GhostArray.h"
#include "Observer.h"

#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace
{

CellPatch::Position KeepPosition(const CellPatch::Position& x) { return x; }

vtkSmartPointer<vtkUnstructuredGrid> MakeGrid(int type)
{
  CellPatch patch;
  patch.AddBoxes(type, 0, 0, 0, 2, 2, 2);
  auto grid = patch.MakeGrid(9, KeepPosition);
  vtkNew<vtkDoubleArray> height;
  height->SetName("Height");
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    height->InsertNextValue(grid->GetPoint(i)[2]);
  }
  grid->GetPointData()->SetScalars(height);
  vtkNew<vtkIntArray> cells;
  cells->SetName("Number");
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    cells->InsertNextValue(static_cast<int>(10 * i));
  }
  grid->GetCellData()->SetScalars(cells);
  return grid;
}

} // namespace

TEST(TetrahedralizeCells, CarriesPointAndCellData)
{
  for (int type :
    { VTK_TETRA, VTK_HEXAHEDRON, VTK_QUADRATIC_HEXAHEDRON, VTK_TRIQUADRATIC_HEXAHEDRON })
  {
    auto grid = MakeGrid(type);
    vtkNew<vtkTetrahedralizeCells> filter;
    filter->SetInputData(grid);
    filter->Update();
    vtkUnstructuredGrid* output = filter->GetOutput();
    const vtkIdType added = type == VTK_QUADRATIC_HEXAHEDRON ? 8 : 0;
    EXPECT_EQ(filter->GetNumberOfAddedPoints(), added);
    ASSERT_EQ(output->GetNumberOfPoints(), grid->GetNumberOfPoints() + added);
    ASSERT_GT(output->GetNumberOfCells(), 0);

    vtkDataArray* height = output->GetPointData()->GetScalars();
    ASSERT_NE(height, nullptr);
    EXPECT_STREQ(height->GetName(), "Height");
    vtkDataArray* originalPoints = output->GetPointData()->GetArray("OriginalPointIds");
    ASSERT_NE(originalPoints, nullptr);
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      EXPECT_NEAR(height->GetTuple1(i), output->GetPoint(i)[2], 1e-12);
      EXPECT_EQ(originalPoints->GetTuple1(i), i < grid->GetNumberOfPoints() ? i : -1);
    }
    vtkDataArray* numbers = output->GetCellData()->GetScalars();
    vtkDataArray* originalCells = output->GetCellData()->GetArray("OriginalCellIds");
    ASSERT_NE(numbers, nullptr);
    ASSERT_NE(originalCells, nullptr);
    for (vtkIdType i = 0; i < output->GetNumberOfCells(); ++i)
    {
      EXPECT_EQ(output->GetCellType(i), VTK_TETRA);
      EXPECT_EQ(numbers->GetTuple1(i), 10 * originalCells->GetTuple1(i));
    }
  }
}

TEST(TetrahedralizeCells, OriginalIdsAreOptional)
{
  vtkNew<vtkTetrahedralizeCells> filter;
  filter->SetInputData(MakeGrid(VTK_HEXAHEDRON));
  EXPECT_TRUE(filter->GetPassOriginalIds());
  filter->PassOriginalIdsOff();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetArray("OriginalPointIds"), nullptr);
  EXPECT_EQ(filter->GetOutput()->GetCellData()->GetArray("OriginalCellIds"), nullptr);
}

TEST(TetrahedralizeCells, CountsAndNamesWhatItLeavesOut)
{
  auto grid = MakeGrid(VTK_HEXAHEDRON);
  const vtkIdType ids[12] = { 0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3 };
  const vtkIdType beyond[4] = { 0, 1, 2, 1000 };
  grid->InsertNextCell(VTK_LAGRANGE_HEXAHEDRON, 12, ids);
  grid->InsertNextCell(VTK_TRIANGLE, 3, ids);
  grid->InsertNextCell(VTK_TETRA, 4, beyond);
  grid->GetCellData()->AddArray(MakeGhostArray(
    11, { { 0, vtkDataSetAttributes::DUPLICATECELL }, { 1, vtkDataSetAttributes::HIDDENCELL } }));
  grid->GetCellData()->RemoveArray("Number");

  vtkNew<vtkTetrahedralizeCells> filter;
  MessageObserver messages(filter, { vtkCommand::ErrorEvent, vtkCommand::WarningEvent });
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfSkippedCells(), 1);
  EXPECT_STREQ(filter->GetSkippedCellTypes(), "1 vtkLagrangeHexahedron");
  EXPECT_EQ(filter->GetNumberOfLowerDimensionalCells(), 1);
  EXPECT_EQ(filter->GetNumberOfInvalidCells(), 1);
  EXPECT_EQ(filter->GetNumberOfGhostCells(), 1);
  EXPECT_EQ(filter->GetNumberOfBlankedCells(), 1);
  EXPECT_NE(messages.Text.find("1 vtkLagrangeHexahedron"), std::string::npos);
  EXPECT_EQ(
    filter->GetOutput()->GetCellData()->GetArray(vtkDataSetAttributes::GhostArrayName()), nullptr);
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("NumberOfGhostCells: 1"), std::string::npos);
}

TEST(TetrahedralizeCells, CompositesKeepTheArraysThatAllBlocksHave)
{
  auto first = MakeGrid(VTK_QUADRATIC_HEXAHEDRON);
  auto second = MakeGrid(VTK_WEDGE);
  second->GetCellData()->RemoveArray("Number");
  vtkNew<vtkUnstructuredGrid> empty;
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, empty);
  blocks->SetBlock(1, first);
  blocks->SetBlock(2, second);
  vtkNew<vtkTetrahedralizeCells> filter;
  filter->SetInputData(blocks);
  filter->Update();
  vtkUnstructuredGrid* output = filter->GetOutput();
  EXPECT_EQ(
    output->GetNumberOfPoints(), first->GetNumberOfPoints() + second->GetNumberOfPoints() + 8);
  vtkDataArray* height = output->GetPointData()->GetArray("Height");
  ASSERT_NE(height, nullptr);
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    EXPECT_NEAR(height->GetTuple1(i), output->GetPoint(i)[2], 1e-12);
  }
  EXPECT_EQ(output->GetCellData()->GetArray("Number"), nullptr);
}

TEST(TetrahedralizeCells, KeepsThePrecisionOfThePoints)
{
  for (int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    auto grid = MakeGrid(VTK_HEXAHEDRON);
    vtkNew<vtkPoints> points;
    points->SetDataType(type);
    points->DeepCopy(grid->GetPoints());
    grid->SetPoints(points);
    vtkNew<vtkTetrahedralizeCells> filter;
    filter->SetInputData(grid);
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetPoints()->GetDataType(), type);
  }
}

TEST(TetrahedralizeCells, AnErrorLeavesAnEmptyOutput)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(480, 480, 480);
  vtkNew<vtkTetrahedralizeCells> filter;
  MessageObserver messages(filter);
  MessageObserver executiveMessages(filter->GetExecutive());
  filter->SetInputData(image);
  filter->Update();
  EXPECT_NE(messages.Text.find("more than 536870911 tetrahedra"), std::string::npos);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
}

TEST(TetrahedralizeCells, AbortsOnRequest)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(101, 101, 101);
  vtkNew<vtkTetrahedralizeCells> filter;
  filter->SetInputData(image);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkTetrahedralizeCells*>(caller)->SetAbortExecute(1); });
  filter->AddObserver(vtkCommand::ProgressEvent, abort);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
}
