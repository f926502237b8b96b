// SPDX-License-Identifier: BSD-3-Clause
#include "vtkConvexifyTetrahedra.h"

#include "Generate/GeneratedMeshes.h"
#include "GhostArray.h"
#include "Observer.h"
#include "ReferenceConvexity.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataSetAttributes.h"
#include "vtkDelaunay3D.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStringArray.h"
#include "vtkTetra.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace
{

/// A generated mesh with arrays of several kinds.
void MakeGrid(const std::string& name, const std::map<std::string, double>& parameters,
  int pointType, vtkUnstructuredGrid* grid)
{
  const tetralux::TetrahedralMesh mesh = tetralux::GenerateMesh(name, parameters).Mesh;
  vtkNew<vtkPoints> points;
  points->SetDataType(pointType);
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    points->InsertNextPoint(&mesh.Points[i]);
  }
  grid->SetPoints(points);
  vtkNew<vtkCellArray> cells;
  for (std::size_t i = 0; i < mesh.Cells.size(); i += 4)
  {
    const vtkIdType ids[4] = { mesh.Cells[i], mesh.Cells[i + 1], mesh.Cells[i + 2],
      mesh.Cells[i + 3] };
    cells->InsertNextCell(4, ids);
  }
  grid->SetCells(VTK_TETRA, cells);

  vtkNew<vtkDoubleArray> velocity;
  velocity->SetName("velocity");
  velocity->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    velocity->InsertNextTuple3(i, -1. - i, 0.5);
  }
  grid->GetPointData()->SetVectors(velocity);
  vtkNew<vtkFloatArray> pressure;
  pressure->SetName("pressure");
  vtkNew<vtkStringArray> names;
  names->SetName("names");
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("ids");
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    pressure->InsertNextValue(static_cast<float>(i) + 1);
    names->InsertNextValue("cell " + std::to_string(i));
    ids->InsertNextValue(2 * i);
  }
  grid->GetCellData()->SetScalars(pressure);
  grid->GetCellData()->AddArray(names);
  grid->GetCellData()->SetGlobalIds(ids);
  grid->GetFieldData()->AddArray(pressure);
}

/// The largest relative error of a volume that is a sum over cells of its surface or its inside:
/// each of up to some thousand terms is rounded by 1e-16 of its size.
constexpr double VolumeRounding = 1e-12;

double GetVolume(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  double p[4][3];
  for (int i = 0; i < 4; ++i)
  {
    grid->GetPoint(grid->GetCell(cell)->GetPointId(i), p[i]);
  }
  return vtkTetra::ComputeVolume(p[0], p[1], p[2], p[3]);
}

/// Faces that only one of the first cells has.
std::set<std::set<vtkIdType>> FindOpenFaces(vtkUnstructuredGrid* grid, vtkIdType numberOfCells)
{
  std::set<std::set<vtkIdType>> open;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < numberOfCells; ++cell)
  {
    grid->GetCellPoints(cell, ids);
    for (int i = 0; i < 4; ++i)
    {
      std::set<vtkIdType> face(ids->begin(), ids->end());
      face.erase(ids->GetId(i));
      if (!open.insert(face).second)
      {
        open.erase(face);
      }
    }
  }
  return open;
}

/// What must hold of an output: the input comes first, as it was.
void CheckOutput(vtkUnstructuredGrid* input, vtkConvexifyTetrahedra* filter)
{
  vtkUnstructuredGrid* output = filter->GetOutput();
  ASSERT_EQ(
    output->GetNumberOfPoints(), input->GetNumberOfPoints() + filter->GetNumberOfSteinerPoints());
  ASSERT_EQ(
    output->GetNumberOfCells(), input->GetNumberOfCells() + filter->GetNumberOfImaginaryCells());
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    double expected[3];
    double actual[3];
    input->GetPoint(i, expected);
    output->GetPoint(i, actual);
    EXPECT_TRUE(std::equal(expected, expected + 3, actual));
    EXPECT_EQ(output->GetPointData()->GetVectors("velocity")->GetComponent(i, 1), -1. - i);
  }
  for (vtkIdType i = input->GetNumberOfPoints(); i < output->GetNumberOfPoints(); ++i)
  {
    EXPECT_EQ(output->GetPointData()->GetVectors("velocity")->GetComponent(i, 2), 0.5);
  }

  auto marks = vtkUnsignedCharArray::SafeDownCast(output->GetCellData()->GetArray("Imaginary"));
  ASSERT_TRUE(marks);
  auto names = vtkStringArray::SafeDownCast(output->GetCellData()->GetAbstractArray("names"));
  double volume = 0;
  std::set<double> globalIds;
  for (vtkIdType i = 0; i < output->GetNumberOfCells(); ++i)
  {
    const bool isImaginary = i >= input->GetNumberOfCells();
    EXPECT_EQ(marks->GetValue(i), isImaginary);
    EXPECT_EQ(output->GetCellType(i), VTK_TETRA);
    EXPECT_EQ(output->GetCellData()->GetScalars("pressure")->GetComponent(i, 0),
      isImaginary ? 0. : static_cast<double>(i) + 1);
    EXPECT_EQ(names->GetValue(i), isImaginary ? "" : "cell " + std::to_string(i));
    globalIds.insert(
      vtkArrayDownCast<vtkDataArray>(output->GetCellData()->GetGlobalIds())->GetTuple1(i));
    if (isImaginary)
    {
      EXPECT_GT(GetVolume(output, i), 0);
      volume += GetVolume(output, i);
      continue;
    }
    vtkNew<vtkIdList> expected;
    vtkNew<vtkIdList> actual;
    input->GetCellPoints(i, expected);
    output->GetCellPoints(i, actual);
    EXPECT_TRUE(std::equal(expected->begin(), expected->end(), actual->begin(), actual->end()));
  }
  EXPECT_EQ(globalIds.size(), static_cast<std::size_t>(output->GetNumberOfCells()));
  EXPECT_TRUE(output->GetFieldData()->GetArray("pressure"));
  EXPECT_NEAR(volume, filter->GetImaginaryVolume(), VolumeRounding * volume);
  EXPECT_NEAR(filter->GetHullVolume(), filter->GetMeshVolume() + filter->GetImaginaryVolume(),
    VolumeRounding * filter->GetHullVolume());
  EXPECT_EQ(filter->GetNumberOfBoundaryFaces(),
    static_cast<vtkIdType>(FindOpenFaces(input, input->GetNumberOfCells()).size()));
}

} // namespace

TEST(ConvexifyTetrahedra, KeepsTheInputFirst)
{
  for (const int pointType : { VTK_FLOAT, VTK_DOUBLE })
  {
    vtkNew<vtkUnstructuredGrid> grid;
    MakeGrid("cavity", { { "cells", 4 } }, pointType, grid);
    vtkNew<vtkConvexifyTetrahedra> filter;
    filter->SetInputData(grid);
    filter->Update();
    CheckOutput(grid, filter);
    EXPECT_FALSE(filter->GetInputIsConvex());
    EXPECT_GT(filter->GetNumberOfImaginaryCells(), 0);
    EXPECT_NEAR(filter->GetHullVolume(), 1, VolumeRounding);
    EXPECT_NEAR(filter->GetMeshVolume(), 0.875, VolumeRounding);
    EXPECT_GT(filter->GetConvexTestSeconds() + filter->GetTriangulationSeconds() +
        filter->GetPocketSeconds() + filter->GetFillSeconds() + filter->GetVerificationSeconds(),
      0);
    // The cube's own faces are all that is open.
    EXPECT_EQ(FindOpenFaces(filter->GetOutput(), filter->GetOutput()->GetNumberOfCells()).size(),
      2u * 6 * 4 * 4);
    std::ostringstream text;
    filter->Print(text);
    EXPECT_NE(text.str().find(
                "NumberOfImaginaryCells: " + std::to_string(filter->GetNumberOfImaginaryCells())),
      std::string::npos);
  }
}

TEST(ConvexifyTetrahedra, AddsPointsWhereItMust)
{
  vtkNew<vtkUnstructuredGrid> grid;
  MakeGrid("helical-gear", { { "teeth", 5 }, { "across", 2 }, { "along", 10 } }, VTK_FLOAT, grid);
  vtkNew<vtkConvexifyTetrahedra> filter;
  filter->SetInputData(grid);
  filter->Update();
  CheckOutput(grid, filter);
  EXPECT_EQ(filter->GetOutput()->GetPoints()->GetDataType(),
    filter->GetNumberOfSteinerPoints() > 0 ? VTK_DOUBLE : VTK_FLOAT);
}

TEST(ConvexifyTetrahedra, GlobalIdsGoOnAfterTheLargestOne)
{
  // Far above 2^53, where a double no longer tells neighbouring integers apart.
  constexpr vtkIdType largest = (vtkIdType(1) << 60) + 5;
  vtkNew<vtkUnstructuredGrid> grid;
  MakeGrid("shared-edge", { { "cells", 1 } }, VTK_DOUBLE, grid);
  const vtkIdType count = grid->GetNumberOfCells();
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("ids");
  for (vtkIdType i = 0; i < count; ++i)
  {
    ids->InsertNextValue(largest - (i + 3) % count); // the largest is not the last
  }
  grid->GetCellData()->SetGlobalIds(ids);
  vtkNew<vtkConvexifyTetrahedra> filter;
  filter->SetInputData(grid);
  filter->Update();
  auto result = vtkIdTypeArray::SafeDownCast(filter->GetOutput()->GetCellData()->GetGlobalIds());
  ASSERT_TRUE(result);
  ASSERT_GT(result->GetNumberOfValues(), count);
  for (vtkIdType i = 0; i < result->GetNumberOfValues(); ++i)
  {
    EXPECT_EQ(result->GetValue(i), i < count ? ids->GetValue(i) : largest + 1 + i - count);
  }
}

TEST(ConvexifyTetrahedra, GlobalIdsWithoutRoomAreLeftOut)
{
  // Bytes, of which the last new one is 255, or would be 256.
  vtkNew<vtkUnstructuredGrid> grid;
  MakeGrid("shared-edge", { { "cells", 1 } }, VTK_DOUBLE, grid);
  for (const bool fits : { true, false })
  {
    vtkNew<vtkConvexifyTetrahedra> filter;
    filter->SetInputData(grid);
    filter->Update();
    const vtkIdType added = filter->GetNumberOfImaginaryCells();
    vtkNew<vtkUnsignedCharArray> ids;
    ids->SetName("ids");
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
    {
      ids->InsertNextValue(static_cast<unsigned char>(255 - added - i + (fits ? 0 : 1)));
    }
    grid->GetCellData()->SetGlobalIds(ids);
    filter->Modified();
    filter->Update();
    vtkDataArray* result =
      vtkArrayDownCast<vtkDataArray>(filter->GetOutput()->GetCellData()->GetGlobalIds());
    ASSERT_EQ(result != nullptr, fits);
    EXPECT_TRUE(!fits || result->GetTuple1(result->GetNumberOfTuples() - 1) == 255);
  }
}

TEST(ConvexifyTetrahedra, ConvexAgain)
{
  vtkNew<vtkUnstructuredGrid> grid;
  MakeGrid("shared-edge", { { "cells", 2 } }, VTK_DOUBLE, grid);
  vtkNew<vtkConvexifyTetrahedra> first;
  first->SetInputData(grid);
  vtkNew<vtkConvexifyTetrahedra> second;
  second->SetInputConnection(first->GetOutputPort());
  second->Update();
  EXPECT_TRUE(second->GetInputIsConvex());
  EXPECT_EQ(second->GetNumberOfImaginaryCells(), 0);
  vtkUnstructuredGrid* output = second->GetOutput();
  ASSERT_EQ(output->GetNumberOfCells(), first->GetOutput()->GetNumberOfCells());
  EXPECT_EQ(output->GetPoints(), first->GetOutput()->GetPoints());
  // What was imaginary stays so.
  double range[2];
  output->GetCellData()->GetArray("Imaginary")->GetRange(range);
  EXPECT_EQ(range[1], 1);
  EXPECT_EQ(output->GetCellData()->GetArray("Imaginary")->GetComponent(0, 0), 0);
}

TEST(ConvexifyTetrahedra, OtherCells)
{
  // Lines are kept and don't matter; what is blanked is empty space; prisms are refused.
  vtkNew<vtkUnstructuredGrid> grid;
  MakeGrid("shared-edge", { { "cells", 1 } }, VTK_DOUBLE, grid);
  const vtkIdType numberOfTetrahedra = grid->GetNumberOfCells();
  const vtkIdType ids[6] = { 0, 1, 2, 3, 4, 5 };
  grid->InsertNextCell(VTK_LINE, 2, ids);
  vtkNew<vtkUnstructuredGrid> blanked;
  blanked->ShallowCopy(grid);
  blanked->GetCellData()->Initialize();
  blanked->GetCellData()->AddArray(
    MakeGhostArray(grid->GetNumberOfCells(), { { 0, vtkDataSetAttributes::HIDDENCELL } }));
  vtkNew<vtkConvexifyTetrahedra> filter;
  filter->SetInputData(blanked);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetCellType(numberOfTetrahedra), VTK_LINE);
  EXPECT_GT(filter->GetNumberOfImaginaryCells(), 0);
  EXPECT_NEAR(filter->GetMeshVolume(), 2 - std::abs(GetVolume(grid, 0)), VolumeRounding);
  EXPECT_NEAR(filter->GetHullVolume(), 3, VolumeRounding);

  grid->InsertNextCell(VTK_WEDGE, 6, ids);
  MessageObserver filterErrors(filter);
  MessageObserver executiveErrors(filter->GetExecutive());
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_NE(filterErrors.Text.find("vtkWedge"), std::string::npos) << filterErrors.Text;
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(filter->GetNumberOfBoundaryFaces(), 0);
}

TEST(ConvexifyTetrahedra, SaysWhyNot)
{
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  const double coordinates[8][3] = { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, { 0, 0, 2 },
    { 0.5, 0.5, -1 }, { 0.6, 0.5, -1 }, { 0.5, 0.6, -1 }, { 0.5, 0.5, 5 } };
  for (const auto& position : coordinates)
  {
    points->InsertNextPoint(position);
  }
  grid->SetPoints(points);
  const vtkIdType ids[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
  grid->InsertNextCell(VTK_VERTEX, 1, ids);
  grid->InsertNextCell(VTK_TETRA, 4, ids);
  grid->InsertNextCell(VTK_TETRA, 4, ids + 4);
  vtkNew<vtkConvexifyTetrahedra> filter;
  MessageObserver filterErrors(filter);
  MessageObserver executiveErrors(filter->GetExecutive());
  filter->SetInputData(grid);
  filter->Update();
  const std::string refusal = filter->GetRefusal();
  EXPECT_NE(refusal.find("intersects itself"), std::string::npos);
  // The grid's own ids: the vertex comes first.
  EXPECT_NE(refusal.find("cell 1"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("cell 2"), std::string::npos) << refusal;
  EXPECT_NE(filterErrors.Text.find(refusal), std::string::npos);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
}

/// Random subsets of the cells of random Delaunay meshes: filled and right, or refused
/// with a reason.
TEST(ConvexifyTetrahedra, SubsetsOfDelaunayMeshes)
{
  int filled = 0;
  for (unsigned seed = 1; seed <= 40; ++seed)
  {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    const int numberOfPoints = 10 + static_cast<int>(190 * unit(random));
    for (int p = 0; p < numberOfPoints; ++p)
    {
      points->InsertNextPoint(unit(random), unit(random), unit(random));
    }
    vtkNew<vtkUnstructuredGrid> cloud;
    cloud->SetPoints(points);
    vtkNew<vtkDelaunay3D> delaunay;
    delaunay->SetInputData(cloud);
    delaunay->Update();

    const double kept = 0.2 + 0.7 * unit(random);
    vtkNew<vtkUnstructuredGrid> subset;
    subset->SetPoints(delaunay->GetOutput()->GetPoints());
    subset->AllocateExact(delaunay->GetOutput()->GetNumberOfCells(), 4);
    for (vtkIdType cell = 0; cell < delaunay->GetOutput()->GetNumberOfCells(); ++cell)
    {
      if (unit(random) < kept)
      {
        subset->InsertNextCell(VTK_TETRA, delaunay->GetOutput()->GetCell(cell)->GetPointIds());
      }
    }

    vtkNew<vtkConvexifyTetrahedra> convexify;
    MessageObserver errors(convexify);
    convexify->SetInputData(subset);
    convexify->Update();
    SCOPED_TRACE("seed " + std::to_string(seed));
    vtkUnstructuredGrid* output = convexify->GetOutput();
    if (!errors.Text.empty())
    {
      EXPECT_NE(errors.Text.find(convexify->GetRefusal()), std::string::npos) << errors.Text;
      EXPECT_STRNE(convexify->GetRefusal(), "");
      continue;
    }
    ++filled;
    tetralux::ConvexifiedMesh mesh;
    for (vtkIdType p = 0; p < output->GetNumberOfPoints(); ++p)
    {
      const double* x = output->GetPoint(p);
      mesh.Points.insert(mesh.Points.end(), x, x + 3);
    }
    auto* imaginary =
      vtkUnsignedCharArray::SafeDownCast(output->GetCellData()->GetArray("Imaginary"));
    ASSERT_TRUE(imaginary);
    for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
    {
      std::vector<std::int32_t>& cells =
        imaginary->GetValue(cell) ? mesh.ImaginaryCells : mesh.Cells;
      for (vtkIdType k = 0; k < 4; ++k)
      {
        cells.push_back(static_cast<std::int32_t>(output->GetCell(cell)->GetPointId(k)));
      }
    }
    EXPECT_EQ(
      tetralux::CheckConvexity(mesh, static_cast<std::int32_t>(subset->GetNumberOfPoints())), "");
    const tetralux::RayAgreement rays = tetralux::CompareRays(mesh, 200, seed);
    EXPECT_EQ(rays.Agreeing, rays.Rays);
  }
  EXPECT_GE(filled, 36) << "nearly all of them can be filled";
}

TEST(ConvexifyTetrahedra, EmptyInput)
{
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkConvexifyTetrahedra> filter;
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_TRUE(filter->GetInputIsConvex());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
}

TEST(ConvexifyTetrahedra, BlocksEachForThemselves)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkNew<vtkUnstructuredGrid> cavity;
  MakeGrid("cavity", { { "cells", 3 } }, VTK_DOUBLE, cavity);
  vtkNew<vtkUnstructuredGrid> edge;
  MakeGrid("shared-edge", { { "cells", 1 } }, VTK_DOUBLE, edge);
  blocks->SetBlock(0, cavity);
  blocks->SetBlock(2, edge);
  vtkNew<vtkConvexifyTetrahedra> filter;
  filter->SetInputDataObject(blocks);
  filter->Update();
  auto output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_TRUE(output);
  ASSERT_EQ(output->GetNumberOfBlocks(), 3u);
  EXPECT_FALSE(output->GetBlock(1));
  for (const unsigned int block : { 0u, 2u })
  {
    auto grid = vtkUnstructuredGrid::SafeDownCast(output->GetBlock(block));
    ASSERT_TRUE(grid);
    double volume = 0;
    for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
    {
      volume += std::abs(GetVolume(grid, i));
    }
    EXPECT_NEAR(volume, block == 0 ? 1 : 3, VolumeRounding);
  }
}

TEST(ConvexifyTetrahedra, ProgressAndAbort)
{
  vtkNew<vtkUnstructuredGrid> grid;
  MakeGrid("cavity", { { "cells", 4 } }, VTK_DOUBLE, grid);
  vtkNew<vtkConvexifyTetrahedra> filter;
  filter->SetInputData(grid);
  double last = -1;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&last);
  command->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      *static_cast<double*>(data) = static_cast<vtkAlgorithm*>(caller)->GetProgress();
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    });
  const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, command);
  filter->Update();
  EXPECT_GT(last, -1);
  EXPECT_LT(last, 0.5);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  filter->RemoveObserver(tag);
  filter->SetAbortExecute(0);
  filter->Modified();
  filter->Update();
  CheckOutput(grid, filter);
}
