// SPDX-License-Identifier: BSD-3-Clause

// vtkMeshedPolyhedraVisibilitySort against brute force, by itself and in VTK's own mapper.

#include "vtkMeshedPolyhedraVisibilitySort.h"

#include "Generate/GeneratedMeshes.h"
#include "RayCastScene.h"
#include "ReferenceOcclusion.h"
#include "ReferenceRenderer.h"
#include "ReferenceScenes.h"

#include "vtkAutoInit.h"
#include "vtkCallbackCommand.h"
#include "vtkCellCenterDepthSort.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"
#include "vtkProjectedTetrahedraMapper.h"
#include "vtkTransform.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <numeric>

// VTK's own mapper.
VTK_MODULE_INIT(vtkRenderingVolumeOpenGL2)

namespace
{

using namespace tetralux;
using Sort = vtkMeshedPolyhedraVisibilitySort;

/// All cells, and a check of how they are handed over.
std::vector<std::int32_t> GetCells(Sort* sort)
{
  std::vector<std::int32_t> cells;
  sort->InitTraversal();
  while (vtkIdTypeArray* next = sort->GetNextCells())
  {
    EXPECT_GT(next->GetNumberOfTuples(), 0);
    EXPECT_LE(next->GetNumberOfTuples(), sort->GetMaxCellsReturned());
    for (vtkIdType i = 0; i < next->GetNumberOfTuples(); ++i)
    {
      cells.push_back(static_cast<std::int32_t>(next->GetValue(i)));
    }
  }
  EXPECT_EQ(sort->GetNextCells(), nullptr);
  return cells;
}

void ExpectEachOnce(std::vector<std::int32_t> cells, std::int64_t numberOfCells)
{
  std::sort(cells.begin(), cells.end());
  std::vector<std::int32_t> expected(numberOfCells);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(cells, expected);
}

vtkSmartPointer<vtkUnstructuredGrid> MakeGridWithoutField(const TetrahedralMesh& mesh)
{
  return MakeGrid(mesh, std::vector<double>(mesh.GetNumberOfPoints(), 0));
}

/// Counts errors instead of printing them.
class ErrorCounter
{
public:
  explicit ErrorCounter(vtkObject* object)
  {
    this->Command->SetClientData(&this->Count);
    this->Command->SetCallback(
      [](vtkObject*, unsigned long, void* count, void*) { ++*static_cast<int*>(count); });
    object->AddObserver("ErrorEvent", this->Command);
  }
  int Count = 0;

private:
  vtkNew<vtkCallbackCommand> Command;
};

TEST(MeshedPolyhedraVisibilitySort, IsExactInTheWorld)
{
  const TetrahedralMesh mesh = GenerateMesh("random", { { "cells", 5 }, { "removed", 0.5 } }).Mesh;
  vtkNew<vtkTransform> transform;
  transform->Translate(3, -2, 5);
  transform->RotateWXYZ(50, 1, 2, 3);
  transform->Scale(2, -1, 0.5); // turned inside out
  TetrahedralMesh moved = mesh;
  for (std::size_t i = 0; i < moved.Points.size(); i += 3)
  {
    transform->TransformPoint(&mesh.Points[i], &moved.Points[i]);
  }
  double middle[3] = { 0.5, 0.5, 0.5 };
  transform->TransformPoint(middle, middle);

  const auto grid = MakeGridWithoutField(mesh);
  vtkNew<Sort> sort;
  vtkNew<vtkCamera> camera;
  sort->SetInput(grid);
  sort->SetCamera(camera);
  sort->SetModelTransform(transform->GetMatrix());
  sort->SetMaxCellsReturned(7);
  sort->SetOrderToExact();
  EXPECT_EQ(sort->GetDirection(), vtkVisibilitySort::BACK_TO_FRONT);
  camera->SetFocalPoint(middle);
  for (const bool parallel : { false, true })
  {
    camera->SetParallelProjection(parallel);
    for (const double distance : { 5.0, 0.1 })
    {
      VisibilityView view;
      view.Parallel = parallel;
      const double direction[3] = { 0.6, 0.7, 0.4 };
      for (int axis = 0; axis < 3; ++axis)
      {
        view.Eye[axis] = middle[axis] + distance * direction[axis];
        view.Direction[axis] = -direction[axis];
      }
      camera->SetPosition(view.Eye.data());
      const auto pairs = FindOccludedPairs(moved, view, 2, 1);
      EXPECT_GT(pairs.size(), 1000U);

      sort->SetDirectionToBackToFront();
      std::vector<std::int32_t> back = GetCells(sort);
      ExpectEachOnce(back, grid->GetNumberOfCells());
      sort->SetDirectionToFrontToBack();
      const std::vector<std::int32_t> front = GetCells(sort);
      std::reverse(back.begin(), back.end());
      EXPECT_EQ(front, back);
      EXPECT_EQ(FindWrongPairs(pairs, front).size(), 0U);
      EXPECT_EQ(sort->GetUsedOrder(), Sort::EXACT_ORDER);
      EXPECT_EQ(sort->GetNumberOfCycles(), 0);
      EXPECT_STREQ(sort->GetRefusal(), "");

      sort->SetOrderToAcrossGaps();
      EXPECT_EQ(FindWrongPairs(pairs, GetCells(sort)).size(), 0U);
      EXPECT_EQ(sort->GetUsedOrder(), Sort::ACROSS_GAPS_ORDER);
      sort->SetOrderToAutomatic();
      EXPECT_EQ(FindWrongPairs(pairs, GetCells(sort)).size(), 0U);

      // The others are less exact, but not without sense.
      sort->SetOrderToNonConvex();
      const auto nonConvex = GetCells(sort);
      ExpectEachOnce(nonConvex, grid->GetNumberOfCells());
      EXPECT_LT(FindWrongPairs(pairs, nonConvex).size(), pairs.size() / 5);
      sort->SetOrderToCentroid();
      const auto centroids = GetCells(sort);
      ExpectEachOnce(centroids, grid->GetNumberOfCells());
      EXPECT_LT(FindWrongPairs(pairs, centroids).size(), pairs.size() / 20);
      EXPECT_EQ(sort->GetUsedOrder(), Sort::CENTROID_ORDER);
      sort->SetOrderToExact();
    }
  }
}

TEST(MeshedPolyhedraVisibilitySort, ReturnsTheTetrahedraOfAGrid)
{
  // A vertex, a tetrahedron whose last point does not exist, and a ghost are left out.
  const TetrahedralMesh mesh = MakeBox(1, 1, 1, { 0, 0, 0 }, { 1, 1, 1 });
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(MakeGridWithoutField(mesh)->GetPoints());
  const vtkIdType vertex[1] = { 0 };
  grid->InsertNextCell(VTK_VERTEX, 1, vertex);
  const vtkIdType invalid[4] = { 0, 1, 2, 100 };
  grid->InsertNextCell(VTK_TETRA, 4, invalid);
  for (std::size_t cell = 0; cell < mesh.Cells.size(); cell += 4)
  {
    const vtkIdType ids[4] = { mesh.Cells[cell], mesh.Cells[cell + 1], mesh.Cells[cell + 2],
      mesh.Cells[cell + 3] };
    grid->InsertNextCell(VTK_TETRA, 4, ids);
  }
  vtkUnsignedCharArray* ghosts = grid->AllocateCellGhostArray();
  ghosts->SetValue(3, vtkDataSetAttributes::DUPLICATECELL);
  vtkNew<Sort> sort;
  sort->SetInput(grid);
  std::vector<std::int32_t> cells = GetCells(sort);
  std::sort(cells.begin(), cells.end());
  EXPECT_EQ(cells, (std::vector<std::int32_t>{ 2, 4, 5, 6 }));
}

TEST(MeshedPolyhedraVisibilitySort, FollowsItsInput)
{
  const TetrahedralMesh two = MakeBox(1, 1, 2, { 0, 0, 0 }, { 1, 1, 2 });
  const auto grid = MakeGridWithoutField(two);
  vtkNew<Sort> sort;
  sort->SetInput(grid); // and no camera: from above
  const std::vector<std::int32_t> order = GetCells(sort);
  ASSERT_EQ(order.size(), 10U);
  EXPECT_LT(order.front(), 5);
  EXPECT_GE(order.back(), 5);
  for (vtkIdType point = 0; point < grid->GetNumberOfPoints(); ++point)
  {
    double x[3];
    grid->GetPoint(point, x);
    x[2] = -x[2];
    grid->GetPoints()->SetPoint(point, x);
  }
  grid->GetPoints()->Modified();
  const std::vector<std::int32_t> turned = GetCells(sort);
  EXPECT_GE(turned.front(), 5);
  EXPECT_LT(turned.back(), 5);
}

TEST(MeshedPolyhedraVisibilitySort, NamesTheCellsOfCycles)
{
  const auto grid = MakeGridWithoutField(MakeCyclicTetrahedra(3));
  vtkNew<Sort> sort;
  sort->SetInput(grid);
  ExpectEachOnce(GetCells(sort), 3);
  ASSERT_EQ(sort->GetNumberOfCycles(), 1);
  EXPECT_GT(sort->GetNumberOfIgnoredFaces(), 0);
  EXPECT_GT(sort->GetIgnoredArea(), 0);
  vtkNew<vtkIdList> cells;
  sort->GetCycle(0, cells);
  ASSERT_EQ(cells->GetNumberOfIds(), 3);
  for (vtkIdType cell = 0; cell < 3; ++cell)
  {
    EXPECT_GE(cells->IsId(cell), 0);
  }
  const ErrorCounter errors(sort);
  sort->GetCycle(1, cells);
  EXPECT_EQ(cells->GetNumberOfIds(), 0);
  EXPECT_EQ(errors.Count, 1);
}

TEST(MeshedPolyhedraVisibilitySort, ReportsWhatCanNotBeSorted)
{
  vtkNew<Sort> sort;
  const ErrorCounter errors(sort);
  EXPECT_TRUE(GetCells(sort).empty());
  EXPECT_EQ(errors.Count, 1);

  const auto grid = MakeGridWithoutField(MakeBox(1, 1, 1, { 0, 0, 0 }, { 1, 1, 1 }));
  sort->SetInput(grid);
  vtkNew<vtkMatrix4x4> flat;
  flat->SetElement(2, 2, 0);
  sort->SetModelTransform(flat);
  EXPECT_TRUE(GetCells(sort).empty());
  EXPECT_EQ(errors.Count, 2);
  vtkNew<vtkMatrix4x4> identity;
  sort->SetModelTransform(identity);
  ExpectEachOnce(GetCells(sort), 5);

  // Cells that would be returned in parts.
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 2, 2);
  sort->SetInput(image);
  EXPECT_TRUE(GetCells(sort).empty());
  EXPECT_EQ(errors.Count, 3);

  // Two cells that cut each other can't be made convex.
  TetrahedralMesh crossing;
  crossing.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.2, 0.2, -0.5, 0.3, 0.2, -0.5, 0.2, 0.3,
    -0.5, 0.2, 0.2, 0.5 };
  crossing.Cells = { 0, 1, 2, 3, 4, 5, 6, 7 };
  const auto crossingGrid = MakeGridWithoutField(crossing);
  sort->SetInput(crossingGrid);
  ExpectEachOnce(GetCells(sort), 2);
  EXPECT_EQ(sort->GetUsedOrder(), Sort::ACROSS_GAPS_ORDER);
  EXPECT_STREQ(sort->GetRefusal(), ""); // which was not tried
  sort->SetOrderToExact();
  ExpectEachOnce(GetCells(sort), 2);
  EXPECT_EQ(sort->GetUsedOrder(), Sort::ACROSS_GAPS_ORDER);
  EXPECT_STRNE(sort->GetRefusal(), "");
  EXPECT_EQ(errors.Count, 3);
}

/// The mean error of a channel of the picture of VTK's mapper: of slanted cells that are much wider
/// than high, each of one colour and nearly opaque, so that hardly anything but the order counts.
double MeasureError(vtkVisibilitySort* sort)
{
  constexpr int size = 128;
  RayCastScene scene(size, size);
  scene.Mesh = MakeBox(2, 2, 40, { 0, 0, 0 }, { 1, 1, 1 });
  for (std::size_t i = 0; i < scene.Mesh.Points.size(); i += 3)
  {
    scene.Mesh.Points[i + 2] += scene.Mesh.Points[i] - 0.5;
  }
  vtkNew<vtkDoubleArray> array;
  scene.Scalars.clear();
  for (std::size_t cell = 0; cell < scene.Mesh.GetNumberOfCells(); ++cell)
  {
    scene.Scalars.push_back(std::sin(static_cast<double>(cell)));
    array->InsertNextValue(scene.Scalars.back());
  }
  const auto grid = MakeGridWithoutField(scene.Mesh);
  grid->GetPointData()->Initialize();
  grid->GetCellData()->SetScalars(array);
  constexpr double opacityFactor = 40;
  scene.Volume->GetProperty()->SetScalarOpacityUnitDistance(
    scene.Volume->GetProperty()->GetScalarOpacityUnitDistance() / opacityFactor);
  for (auto& node : scene.Function.Nodes)
  {
    node.Left.Attenuation *= opacityFactor;
    node.Right.Attenuation *= opacityFactor;
  }
  vtkNew<vtkProjectedTetrahedraMapper> mapper;
  mapper->SetInputData(grid);
  mapper->SetVisibilitySort(sort);
  scene.Volume->SetMapper(mapper);
  scene.Window->Render(); // VTK's mapper draws nothing into a new window
  scene.Window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  scene.Window->GetPixelData(0, 0, size - 1, size - 1, 0, pixels, 0);

  ReferenceMesh mesh;
  mesh.Points = scene.Mesh.Points;
  mesh.Cells = scene.Mesh.Cells;
  mesh.Scalars = scene.Scalars;
  mesh.CellScalars = true;
  const ReferenceImage image = RenderReference(
    mesh, scene.Function, scene.MakeReferenceRays(size, size), scene.MakeReferenceLimits());
  double sum = 0;
  for (vtkIdType pixel = 0; pixel < size * size; ++pixel)
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      sum +=
        std::abs(pixels->GetValue(3 * pixel + channel) / 255.0 - image.Rgba[4 * pixel + channel]);
    }
  }
  return sum / (3 * size * size);
}

TEST(MeshedPolyhedraVisibilitySort, ServesTheMapperOfVtk)
{
  vtkNew<vtkCellCenterDepthSort> centers;
  vtkNew<Sort> exact;
  const double withCenters = MeasureError(centers);
  const double withExact = MeasureError(exact);
  // What is left are the errors of the mapper itself.
  EXPECT_LT(withExact, 0.5 * withCenters);
}

} // namespace
