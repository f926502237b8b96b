// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraNeighbors.h"

#include "CellPatch.h"
#include "GhostArray.h"
#include "Observer.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSignedCharArray.h"
#include "vtkTable.h"
#include "vtkTetra.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <utility>

namespace
{

using Face = std::array<vtkIdType, 3>;
using Cell = std::array<vtkIdType, 4>;

Cell GetPoints(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  grid->GetCellPoints(cell, ids);
  return { ids->GetId(0), ids->GetId(1), ids->GetId(2), ids->GetId(3) };
}

Face GetFace(const Cell& cell, int face)
{
  Face points;
  int count = 0;
  for (int i = 0; i < 4; ++i)
  {
    if (i != face)
    {
      points[count++] = cell[i];
    }
  }
  std::sort(points.begin(), points.end());
  return points;
}

/// Some cells of a block of tetrahedra, in any order and any orientation: holes, separate parts,
/// parts that touch in points and edges.
vtkSmartPointer<vtkUnstructuredGrid> MakeRandomGrid(std::uint64_t seed, double share)
{
  CellPatch patch;
  patch.AddBoxes(VTK_TETRA, 0, 0, 0, 3, 4, 3);
  auto whole = patch.MakeGrid(seed, MapWarped);
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Cell> cells;
  for (vtkIdType i = 0; i < whole->GetNumberOfCells(); ++i)
  {
    if (unit(generator) < share)
    {
      cells.push_back(GetPoints(whole, i));
      std::shuffle(cells.back().begin(), cells.back().end(), generator);
    }
  }
  std::shuffle(cells.begin(), cells.end(), generator);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(whole->GetPoints());
  for (const Cell& cell : cells)
  {
    grid->InsertNextCell(VTK_TETRA, 4, cell.data());
  }
  return grid;
}

/// All cells that have a face, in brute force.
std::map<Face, std::vector<std::pair<vtkIdType, int>>> CollectFaces(vtkUnstructuredGrid* grid)
{
  std::map<Face, std::vector<std::pair<vtkIdType, int>>> faces;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    for (int face = 0; face < 4; ++face)
    {
      faces[GetFace(GetPoints(grid, cell), face)].push_back({ cell, face });
    }
  }
  return faces;
}

vtkIdType GetNeighbor(vtkDataObject* output, vtkIdType cell, int face)
{
  auto array = vtkIdTypeArray::SafeDownCast(
    vtkUnstructuredGrid::SafeDownCast(output)->GetCellData()->GetArray("Neighbors"));
  return array->GetTypedComponent(cell, face);
}

int GetNeighborFace(vtkDataObject* output, vtkIdType cell, int face)
{
  auto array = vtkSignedCharArray::SafeDownCast(
    vtkUnstructuredGrid::SafeDownCast(output)->GetCellData()->GetArray("NeighborFaces"));
  return array->GetTypedComponent(cell, face);
}

/// Positive where the points are in VTK's order.
double GetSixfoldVolume(vtkUnstructuredGrid* grid, const Cell& cell)
{
  double x[4][3];
  double edges[3][3];
  for (int i = 0; i < 4; ++i)
  {
    grid->GetPoint(cell[i], x[i]);
  }
  for (int i = 0; i < 3; ++i)
  {
    vtkMath::Subtract(x[i + 1], x[0], edges[i]);
  }
  return vtkMath::Determinant3x3(edges);
}

/// One cell, its points as given.
vtkSmartPointer<vtkUnstructuredGrid> MakeSingleCell()
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(1, 0, 0);
  points->InsertNextPoint(0, 1, 0);
  points->InsertNextPoint(0, 0, 1);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  const vtkIdType ids[4] = { 0, 1, 2, 3 };
  grid->InsertNextCell(VTK_TETRA, 4, ids);
  return grid;
}

void MarkCell(vtkUnstructuredGrid* grid, vtkIdType cell, unsigned char bits)
{
  grid->GetCellData()->AddArray(MakeGhostArray(grid->GetNumberOfCells(), { { cell, bits } }));
}

} // namespace

TEST(TetrahedraNeighbors, AgreesWithBruteForce)
{
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
  {
    auto grid = MakeRandomGrid(seed, 0.08 * seed);
    vtkNew<vtkTetrahedraNeighbors> filter;
    filter->SetInputData(grid);
    filter->Update();
    vtkUnstructuredGrid* output = filter->GetOutput();
    ASSERT_EQ(output->GetNumberOfCells(), grid->GetNumberOfCells());
    vtkIdType outside = 0;
    for (const auto& face : CollectFaces(grid))
    {
      const auto& sides = face.second;
      ASSERT_LE(sides.size(), 2u);
      outside += sides.size() == 1;
      for (std::size_t i = 0; i < sides.size(); ++i)
      {
        const auto& [cell, side] = sides[i];
        const vtkIdType neighbor = sides.size() == 2 ? sides[1 - i].first : -1;
        const int neighborFace = sides.size() == 2 ? sides[1 - i].second : -1;
        EXPECT_EQ(GetNeighbor(output, cell, side), neighbor);
        EXPECT_EQ(GetNeighborFace(output, cell, side), neighborFace);
      }
    }
    EXPECT_EQ(filter->GetNumberOfBoundaryFaces(), outside);
    EXPECT_EQ(filter->GetBoundary()->GetNumberOfPolys(), outside);
    EXPECT_EQ(filter->GetNumberOfNonManifoldFaces(), 0);
    vtkIdType inverted = 0;
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      inverted += GetSixfoldVolume(grid, GetPoints(grid, cell)) < 0;
    }
    EXPECT_EQ(filter->GetNumberOfInvertedCells(), inverted);
    EXPECT_GT(inverted, 0);
  }
}

TEST(TetrahedraNeighbors, BoundaryEnclosesTheMesh)
{
  for (std::uint64_t seed = 21; seed <= 26; ++seed)
  {
    auto grid = MakeRandomGrid(seed, 0.6);
    vtkNew<vtkTetrahedraNeighbors> filter;
    filter->SetInputData(grid);
    filter->Update();
    vtkPolyData* boundary = filter->GetBoundary();
    auto cells = vtkIdTypeArray::SafeDownCast(boundary->GetCellData()->GetArray("CellIds"));
    auto faces = vtkSignedCharArray::SafeDownCast(boundary->GetCellData()->GetArray("FaceIds"));
    ASSERT_NE(cells, nullptr);
    ASSERT_NE(faces, nullptr);
    EXPECT_EQ(boundary->GetNumberOfPoints(), grid->GetNumberOfPoints());

    // Sixfold volumes of the pyramids from the origin over the triangles.
    double enclosed = 0;
    for (vtkIdType i = 0; i < boundary->GetNumberOfCells(); ++i)
    {
      vtkNew<vtkIdList> ids;
      boundary->GetCellPoints(i, ids);
      ASSERT_EQ(ids->GetNumberOfIds(), 3);
      const Cell cell = GetPoints(grid, cells->GetValue(i));
      Face triangle = { ids->GetId(0), ids->GetId(1), ids->GetId(2) };
      // The point across is behind the triangle.
      EXPECT_LT(
        GetSixfoldVolume(grid, { triangle[0], triangle[1], triangle[2], cell[faces->GetValue(i)] }),
        0);
      std::sort(triangle.begin(), triangle.end());
      EXPECT_EQ(triangle, GetFace(cell, faces->GetValue(i)));
      double corners[3][3];
      for (int k = 0; k < 3; ++k)
      {
        boundary->GetPoint(ids->GetId(k), corners[k]);
      }
      enclosed += vtkMath::Determinant3x3(corners);
    }
    double volume = 0;
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      volume += std::abs(GetSixfoldVolume(grid, GetPoints(grid, cell)));
    }
    EXPECT_NEAR(enclosed, volume, 1e-10 * volume);
  }
}

TEST(TetrahedraNeighbors, KeepsTheInputAndItsData)
{
  auto grid = MakeRandomGrid(3, 0.5);
  vtkNew<vtkDoubleArray> height;
  height->SetName("Height");
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    height->InsertNextValue(grid->GetPoint(i)[2]);
  }
  grid->GetPointData()->SetScalars(height);
  vtkNew<vtkIdTypeArray> number;
  number->SetName("Number");
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    number->InsertNextValue(7 * i);
  }
  grid->GetCellData()->AddArray(number);
  vtkNew<vtkDoubleArray> stale;
  stale->SetName("Neighbors");
  stale->SetNumberOfTuples(grid->GetNumberOfCells());
  grid->GetCellData()->AddArray(stale);

  vtkNew<vtkTetrahedraNeighbors> filter;
  filter->SetInputData(grid);
  filter->Update();
  vtkUnstructuredGrid* output = filter->GetOutput();
  EXPECT_EQ(output->GetPoints(), grid->GetPoints());
  EXPECT_EQ(output->GetCells(), grid->GetCells());
  EXPECT_EQ(output->GetPointData()->GetScalars(), height);
  EXPECT_EQ(output->GetCellData()->GetArray("Number"), number);
  EXPECT_EQ(output->GetCellData()->GetNumberOfArrays(), 3);
  EXPECT_NE(vtkIdTypeArray::SafeDownCast(output->GetCellData()->GetArray("Neighbors")), nullptr);

  vtkPolyData* boundary = filter->GetBoundary();
  EXPECT_EQ(boundary->GetPointData()->GetScalars(), height);
  vtkDataArray* cells = boundary->GetCellData()->GetArray("CellIds");
  vtkDataArray* faces = boundary->GetCellData()->GetArray("FaceIds");
  vtkDataArray* numbers = boundary->GetCellData()->GetArray("Number");
  ASSERT_NE(numbers, nullptr);
  ASSERT_EQ(numbers->GetNumberOfTuples(), boundary->GetNumberOfCells());
  for (vtkIdType i = 0; i < boundary->GetNumberOfCells(); ++i)
  {
    EXPECT_EQ(numbers->GetTuple1(i), 7 * cells->GetTuple1(i));
    if (i > 0)
    {
      EXPECT_LT(4 * cells->GetTuple1(i - 1) + faces->GetTuple1(i - 1),
        4 * cells->GetTuple1(i) + faces->GetTuple1(i));
    }
  }
}

TEST(TetrahedraNeighbors, CountsDefectsAndLeavesUnusableCellsOut)
{
  auto grid = MakeSingleCell();
  vtkPoints* points = grid->GetPoints();
  points->InsertNextPoint(1, 1, 1);                                        // 4
  points->InsertNextPoint(-1, -1, -1);                                     // 5
  points->InsertNextPoint(std::numeric_limits<double>::quiet_NaN(), 0, 0); // 6
  points->InsertNextPoint(0.3, 0.3, 0);                                    // 7
  points->InsertNextPoint(5, 5, 5);                                        // 8
  const auto add = [&](int type, const std::vector<vtkIdType>& ids)
  { grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data()); };
  add(VTK_TETRA, { 4, 1, 2, 3 });  // 1: inverted, behind face 0 of cell 0
  add(VTK_TETRA, { 5, 1, 2, 3 });  // 2: a third one at that face
  add(VTK_TRIANGLE, { 0, 1, 2 });  // 3
  add(VTK_TETRA, { 3, 2, 1, 0 });  // 4: cell 0 again
  add(VTK_TETRA, { 0, 1, 2, 6 });  // 5: not a number
  add(VTK_TETRA, { 0, 1, 1, 3 });  // 6: collapsed
  add(VTK_TETRA, { 0, 1, 2, 99 }); // 7: no such point
  add(VTK_TETRA, { 0, 1, 7, 2 });  // 8: flat, behind face 3 of cell 0
  add(VTK_TETRA, { 0, 1, 2, 8 });  // 9: blanked
  MarkCell(grid, 9, vtkDataSetAttributes::HIDDENCELL);

  vtkNew<vtkTetrahedraNeighbors> filter;
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfNonManifoldFaces(), 1);
  EXPECT_EQ(filter->GetNumberOfComponents(), 3);
  EXPECT_EQ(filter->GetNumberOfInvertedCells(), 1);
  EXPECT_EQ(filter->GetNumberOfZeroVolumeCells(), 1);
  EXPECT_EQ(filter->GetNumberOfLowerDimensionalCells(), 1);
  EXPECT_EQ(filter->GetNumberOfDuplicateCells(), 1);
  EXPECT_EQ(filter->GetNumberOfNonFiniteCells(), 1);
  EXPECT_EQ(filter->GetNumberOfCollapsedCells(), 1);
  EXPECT_EQ(filter->GetNumberOfInvalidCells(), 1);
  EXPECT_EQ(filter->GetNumberOfBlankedCells(), 1);
  EXPECT_EQ(filter->GetNumberOfGhostCells(), 0);
  // Four cells, of which two share a face.
  EXPECT_EQ(filter->GetNumberOfBoundaryFaces(), 14);
  vtkUnstructuredGrid* output = filter->GetOutput();
  for (vtkIdType cell : { 3, 4, 5, 6, 7, 9 })
  {
    for (int face = 0; face < 4; ++face)
    {
      EXPECT_EQ(GetNeighbor(output, cell, face), vtkTetrahedraNeighbors::LEFT_OUT);
      EXPECT_EQ(GetNeighborFace(output, cell, face), -1);
    }
  }
  EXPECT_EQ(GetNeighbor(output, 0, 0), vtkTetrahedraNeighbors::OUTSIDE);
  EXPECT_EQ(GetNeighbor(output, 1, 0), vtkTetrahedraNeighbors::OUTSIDE);
  EXPECT_EQ(GetNeighbor(output, 0, 3), 8);
  EXPECT_EQ(GetNeighborFace(output, 0, 3), 2);
  EXPECT_EQ(GetNeighbor(output, 8, 2), 0);
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("NumberOfCollapsedCells: 1"), std::string::npos);
  EXPECT_NE(text.str().find("NumberOfBoundaryFaces: 14"), std::string::npos);
}

TEST(TetrahedraNeighbors, GhostCellsAreNeighborsWithoutTriangles)
{
  auto grid = MakeSingleCell();
  grid->GetPoints()->InsertNextPoint(1, 1, 1);
  const vtkIdType ids[4] = { 1, 2, 3, 4 };
  grid->InsertNextCell(VTK_TETRA, 4, ids);
  MarkCell(grid, 1, vtkDataSetAttributes::DUPLICATECELL);
  vtkNew<vtkTetrahedraNeighbors> filter;
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfGhostCells(), 1);
  EXPECT_EQ(GetNeighbor(filter->GetOutput(), 0, 0), 1);
  EXPECT_EQ(GetNeighbor(filter->GetOutput(), 1, 3), 0);
  EXPECT_EQ(filter->GetNumberOfBoundaryFaces(), 3);
  vtkDataArray* cells = filter->GetBoundary()->GetCellData()->GetArray("CellIds");
  EXPECT_EQ(cells->GetRange()[1], 0);
}

TEST(TetrahedraNeighbors, HiddenPointsBlankTheirCells)
{
  auto grid = MakeSingleCell();
  grid->GetPointData()->AddArray(MakeGhostArray(4, { { 2, vtkDataSetAttributes::HIDDENPOINT } }));
  vtkNew<vtkTetrahedraNeighbors> filter;
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfBlankedCells(), 1);
  EXPECT_EQ(filter->GetNumberOfBoundaryFaces(), 0);
}

TEST(TetrahedraNeighbors, EachBlockOfACompositeOnItsOwn)
{
  auto first = MakeRandomGrid(5, 0.5);
  auto second = MakeSingleCell();
  vtkNew<vtkTable> table;
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(1, second);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetNumberOfBlocks(4);
  blocks->SetBlock(0, first);
  blocks->SetBlock(2, inner);
  blocks->SetBlock(3, table);
  vtkNew<vtkTetrahedraNeighbors> alone;
  alone->SetInputData(first);
  alone->Update();

  vtkNew<vtkTetrahedraNeighbors> filter;
  filter->SetInputDataObject(blocks);
  filter->Update();
  EXPECT_EQ(filter->GetOutput(), nullptr);
  EXPECT_EQ(filter->GetBoundary(), nullptr);
  auto grids = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  auto boundaries = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(1));
  ASSERT_NE(grids, nullptr);
  ASSERT_NE(boundaries, nullptr);
  ASSERT_EQ(grids->GetNumberOfBlocks(), 4u);
  EXPECT_EQ(grids->GetBlock(1), nullptr);
  EXPECT_EQ(grids->GetBlock(3), nullptr);
  auto boundary = vtkPolyData::SafeDownCast(boundaries->GetBlock(0));
  ASSERT_NE(boundary, nullptr);
  EXPECT_EQ(boundary->GetNumberOfCells(), alone->GetNumberOfBoundaryFaces());
  for (vtkIdType cell = 0; cell < first->GetNumberOfCells(); ++cell)
  {
    for (int face = 0; face < 4; ++face)
    {
      EXPECT_EQ(
        GetNeighbor(grids->GetBlock(0), cell, face), GetNeighbor(alone->GetOutput(), cell, face));
    }
  }
  auto innerGrids = vtkMultiBlockDataSet::SafeDownCast(grids->GetBlock(2));
  ASSERT_NE(innerGrids, nullptr);
  EXPECT_EQ(GetNeighbor(innerGrids->GetBlock(1), 0, 2), -1);
  EXPECT_EQ(filter->GetNumberOfBoundaryFaces(), alone->GetNumberOfBoundaryFaces() + 4);
  EXPECT_EQ(filter->GetNumberOfComponents(), alone->GetNumberOfComponents() + 1);

  // From a composite to a grid and back to another kind of composite.
  filter->SetInputData(second);
  filter->Update();
  ASSERT_NE(filter->GetOutput(), nullptr);
  EXPECT_EQ(filter->GetBoundary()->GetNumberOfCells(), 4);
  EXPECT_EQ(filter->GetNumberOfBoundaryFaces(), 4);
  vtkNew<vtkPartitionedDataSet> partitions;
  partitions->SetNumberOfPartitions(1);
  partitions->SetPartition(0, second);
  filter->SetInputDataObject(partitions);
  filter->Update();
  auto output = vtkPartitionedDataSet::SafeDownCast(filter->GetOutputDataObject(1));
  ASSERT_NE(output, nullptr);
  EXPECT_EQ(output->GetPartition(0)->GetNumberOfCells(), 4);
}

TEST(TetrahedraNeighbors, EmptyInputs)
{
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkTetrahedraNeighbors> filter;
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(filter->GetBoundary()->GetNumberOfCells(), 0);
  EXPECT_EQ(filter->GetNumberOfComponents(), 0);
  ASSERT_NE(filter->GetOutput()->GetCellData()->GetArray("Neighbors"), nullptr);

  vtkNew<vtkMultiBlockDataSet> blocks;
  filter->SetInputDataObject(blocks);
  filter->Update();
  EXPECT_NE(vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0)), nullptr);
}

TEST(TetrahedraNeighbors, RefusesOtherCellsAndGrids)
{
  CellPatch patch;
  patch.AddBoxes(VTK_HEXAHEDRON, 0, 0, 0, 1, 1, 1);
  auto hexahedra = patch.MakeGrid(1, MapAffine);
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 3);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeSingleCell());
  blocks->SetBlock(1, image);
  const struct
  {
    vtkDataObject* Input;
    const char* Name;
  } examples[] = { { hexahedra, "vtkHexahedron" }, { blocks, "vtkImageData" } };
  for (const auto& example : examples)
  {
    vtkNew<vtkTetrahedraNeighbors> filter;
    filter->SetInputData(MakeSingleCell());
    filter->Update();
    EXPECT_EQ(filter->GetNumberOfBoundaryFaces(), 4);
    MessageObserver errors(filter);
    MessageObserver executiveErrors(filter->GetExecutive());
    filter->SetInputDataObject(example.Input);
    filter->Update();
    EXPECT_NE(errors.Text.find(example.Name), std::string::npos) << errors.Text;
    EXPECT_NE(errors.Text.find("vtkTetrahedralizeCells"), std::string::npos);
    EXPECT_EQ(filter->GetNumberOfBoundaryFaces(), 0);
    for (int port = 0; port < 2; ++port)
    {
      EXPECT_EQ(filter->GetOutputDataObject(port)->GetNumberOfElements(vtkDataObject::CELL), 0);
    }
  }
}

TEST(TetrahedraNeighbors, ReportsProgressAndAborts)
{
  auto grid = MakeRandomGrid(8, 0.9);
  struct Report
  {
    double Last = 0;
    int Count = 0;
    double AbortAt = 2;
  } report;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&report);
  observer->SetCallback(
    [](vtkObject* caller, unsigned long, void* client, void* fraction)
    {
      auto self = static_cast<Report*>(client);
      EXPECT_GE(*static_cast<double*>(fraction), self->Last);
      self->Last = *static_cast<double*>(fraction);
      ++self->Count;
      if (self->Last >= self->AbortAt)
      {
        static_cast<vtkTetrahedraNeighbors*>(caller)->SetAbortExecute(1);
      }
    });
  vtkNew<vtkTetrahedraNeighbors> filter;
  filter->AddObserver(vtkCommand::ProgressEvent, observer);
  filter->SetInputData(grid);
  filter->Update();
  EXPECT_EQ(report.Last, 1);
  EXPECT_GE(report.Count, 4);
  EXPECT_GT(filter->GetNumberOfBoundaryFaces(), 0);

  report = { 0, 0, 0.3 };
  filter->Modified();
  filter->Update();
  EXPECT_LT(report.Last, 1);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  EXPECT_EQ(filter->GetBoundary()->GetNumberOfCells(), 0);
  EXPECT_EQ(filter->GetNumberOfBoundaryFaces(), 0);
}
