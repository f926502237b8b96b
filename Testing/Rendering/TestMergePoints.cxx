// SPDX-License-Identifier: BSD-3-Clause
// Points at the same place are taken as one: cells that touch become neighbours, whatever their
// type, and what must not be merged stays apart.
#include "Preparation/ScenePreparation.h"

#include "RayCastScene.h"

#include "vtkCell.h"
#include "vtkCellTypeSource.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace
{

using tetralux::PointMerging;

/// Largest difference of a channel of pictures of the same tetrahedra, which additions in another
/// order round differently.
constexpr double SameTetrahedra = 1e-6;

constexpr double Pi = 3.14159265358979323846;

double GetFieldAt(const double* x)
{
  return std::sin(1.3 * x[0] + 0.4 * x[1]) * std::cos(0.9 * x[1] - 0.7 * x[2]);
}

void SetField(vtkDataSet* grid)
{
  vtkNew<vtkDoubleArray> field;
  field->SetName("Field");
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    field->InsertNextValue(GetFieldAt(grid->GetPoint(p)));
  }
  grid->GetPointData()->SetScalars(field);
}

/// A box of 3 x 3 x 3 cells, bent so that cells of other diagonals are other cells.
vtkSmartPointer<vtkUnstructuredGrid> MakeSharedCells(int cellType)
{
  vtkNew<vtkCellTypeSource> source;
  source->SetCellType(cellType);
  source->SetBlocksDimensions(3, 3, 3);
  source->Update();
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType p = 0; p < source->GetOutput()->GetNumberOfPoints(); ++p)
  {
    double x[3];
    source->GetOutput()->GetPoint(p, x);
    points->InsertNextPoint(
      x[0] + 0.1 * std::sin(2 * x[1]), x[1] + 0.1 * std::sin(2 * x[2]), x[2] + 0.1 * x[0] * x[1]);
  }
  grid->SetPoints(points);
  grid->SetCells(source->GetOutput()->GetCellTypesArray(), source->GetOutput()->GetCells());
  SetField(grid);
  return grid;
}

/// The same cells, each with points of its own, in the order of the shared ids, so that diagonals
/// at the smallest id stay where they are.
vtkSmartPointer<vtkUnstructuredGrid> SeparateCells(vtkUnstructuredGrid* shared)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::vector<std::pair<vtkIdType, vtkIdType>> corners; // shared id, number in the connectivity
  std::vector<std::vector<vtkIdType>> cells(shared->GetNumberOfCells());
  vtkIdType numberOfCorners = 0;
  for (vtkIdType cell = 0; cell < shared->GetNumberOfCells(); ++cell)
  {
    vtkIdList* ids = shared->GetCell(cell)->GetPointIds();
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      corners.emplace_back(ids->GetId(i), numberOfCorners++);
      cells[cell].push_back(0);
    }
  }
  std::sort(corners.begin(), corners.end());
  std::vector<vtkIdType> newIds(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    newIds[corners[i].second] = points->InsertNextPoint(shared->GetPoint(corners[i].first));
  }
  grid->SetPoints(points);
  auto next = newIds.begin();
  for (vtkIdType cell = 0; cell < shared->GetNumberOfCells(); ++cell)
  {
    std::copy_n(next, cells[cell].size(), cells[cell].begin());
    next += static_cast<std::ptrdiff_t>(cells[cell].size());
    grid->InsertNextCell(
      shared->GetCellType(cell), static_cast<vtkIdType>(cells[cell].size()), cells[cell].data());
  }
  SetField(grid);
  return grid;
}

vtkDoubleArray* GetField(vtkDataSet* grid)
{
  return vtkDoubleArray::SafeDownCast(grid->GetPointData()->GetScalars());
}

class MergePoints : public testing::Test
{
protected:
  MergePoints()
    : Preparation(this->Source)
  {
    this->Settings.Table.Use = tetralux::TableUse::Never;
    vtkNew<vtkColorTransferFunction> color;
    color->AddRGBPoint(0, 1, 0, 0);
    color->AddRGBPoint(1, 0, 0, 1);
    vtkNew<vtkPiecewiseFunction> opacity;
    opacity->AddPoint(0, 0.1);
    opacity->AddPoint(1, 1);
    this->Property->SetColor(color);
    this->Property->SetScalarOpacity(opacity);
  }

  bool TryUpdate(vtkDataObject* data, const std::function<bool(double)>& progress)
  {
    tetralux::SceneInput input;
    input.Data = data;
    input.Property = this->Property;
    input.Matrix = this->Matrix;
    return this->Preparation.Update(this->Settings, input, progress);
  }

  /// Returns the stages that were made anew.
  std::vector<std::string> Update(vtkDataObject* data)
  {
    EXPECT_TRUE(this->TryUpdate(data, {}));
    return this->Preparation.GetLast().Rebuilt;
  }

  std::int64_t CountBoundaryFaces() const
  {
    return this->Preparation.Scene.Mesh.GetMesh()->GetNumberOfBoundaryFaces();
  }
  std::size_t CountMerged() const { return this->Preparation.GetNumberOfMergedPoints(); }

  vtkNew<vtkObject> Source;
  vtkNew<vtkVolumeProperty> Property;
  vtkNew<vtkMatrix4x4> Matrix;
  tetralux::MapperSettings Settings;
  tetralux::ScenePreparation Preparation;
};

TEST_F(MergePoints, MakeNeighboursOfCellsOfEveryType)
{
  for (const int type : { VTK_TETRA, VTK_HEXAHEDRON, VTK_WEDGE, VTK_PYRAMID, VTK_QUADRATIC_TETRA,
         VTK_QUADRATIC_HEXAHEDRON })
  {
    SCOPED_TRACE(type);
    const auto shared = MakeSharedCells(type);
    ASSERT_GT(shared->GetNumberOfCells(), 0);
    this->Update(shared);
    EXPECT_EQ(this->CountMerged(), 0U);
    const std::int64_t expected = this->CountBoundaryFaces();
    const std::int64_t tetrahedra = this->Preparation.Scene.Mesh.GetMesh()->GetNumberOfCells();
    const auto separate = SeparateCells(shared);
    this->Update(separate);
    EXPECT_GT(this->CountMerged(), 0U);
    EXPECT_EQ(this->CountBoundaryFaces(), expected);
    EXPECT_EQ(this->Preparation.Scene.Mesh.GetMesh()->GetNumberOfCells(), tetrahedra);
    EXPECT_TRUE(this->Update(separate).empty());

    this->Settings.Merging = PointMerging::Never;
    EXPECT_EQ(this->Update(separate), std::vector<std::string>({ "merged points", "scalars" }));
    EXPECT_EQ(this->CountMerged(), 0U);
    EXPECT_GT(this->CountBoundaryFaces(), expected);
    this->Settings.Merging = PointMerging::Automatic;
  }
}

TEST_F(MergePoints, JumpsOfTheFieldStay)
{
  const auto grid = SeparateCells(MakeSharedCells(VTK_HEXAHEDRON));
  const auto own = static_cast<std::size_t>(grid->GetNumberOfPoints());
  this->Update(grid);
  const std::size_t all = this->CountMerged();
  ASSERT_GT(all, own / 3);

  // One corner in the middle jumps: automatic keeps all points apart, on merges the others.
  vtkIdType middle = 0;
  while (grid->GetCell(13)->GetPointId(0) != middle)
  {
    ++middle;
  }
  GetField(grid)->SetValue(middle, GetField(grid)->GetValue(middle) + 0.5);
  GetField(grid)->Modified();
  EXPECT_EQ(this->Update(grid), std::vector<std::string>({ "merged points", "scalars" }));
  EXPECT_EQ(this->CountMerged(), 0U);
  this->Settings.Merging = PointMerging::Always;
  this->Update(grid);
  EXPECT_EQ(this->CountMerged(), all - 1);

  // What doubles round is no jump, what a float would is one.
  const double continuous = GetFieldAt(grid->GetPoint(middle));
  GetField(grid)->SetValue(middle, continuous * (1 + 2e-16));
  GetField(grid)->Modified();
  this->Update(grid);
  EXPECT_EQ(this->CountMerged(), all);
  GetField(grid)->SetValue(middle, continuous * (1 + 1e-7));
  GetField(grid)->Modified();
  this->Update(grid);
  EXPECT_EQ(this->CountMerged(), all - 1);
}

TEST_F(MergePoints, PointsThatComeApartAreNotMerged)
{
  const auto grid = SeparateCells(MakeSharedCells(VTK_HEXAHEDRON));
  this->Update(grid);
  const std::size_t all = this->CountMerged();
  const auto move = [&grid](vtkIdType p, double distance)
  {
    double x[3];
    grid->GetPoint(p, x);
    x[0] += distance;
    grid->GetPoints()->SetPoint(p, x);
    grid->GetPoints()->Modified();
  };
  // All move together: nothing but coordinates is made anew.
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    move(p, 0.25);
  }
  EXPECT_EQ(this->Update(grid), std::vector<std::string>({ "points" }));
  EXPECT_EQ(this->CountMerged(), all);
  // The first corner is one cell's alone, the one after it is not.
  move(0, -0.125);
  EXPECT_EQ(this->Update(grid), std::vector<std::string>({ "points" }));
  move(1, -0.125);
  EXPECT_EQ(this->Update(grid), std::vector<std::string>({ "mesh", "scalars" }));
  EXPECT_EQ(this->CountMerged(), all - 1);
}

TEST_F(MergePoints, AbortedMeshesLeaveNoPointsToMerge)
{
  const auto small = SeparateCells(MakeSharedCells(VTK_HEXAHEDRON));
  this->Update(small);
  const std::size_t all = this->CountMerged();
  // An input with ids that the first one does not have.
  vtkNew<vtkMultiBlockDataSet> large;
  for (int block = 0; block < 4; ++block)
  {
    large->SetBlock(block, small);
  }
  int calls = 0;
  for (int last = 1, aborted = true; aborted; ++last)
  {
    SCOPED_TRACE(last);
    calls = 0;
    aborted = !this->TryUpdate(large, [&calls, last](double) { return ++calls < last; });
    this->Update(small);
    EXPECT_EQ(this->CountMerged(), all);
  }
  EXPECT_GT(calls, 2) << "the mesh was made once only";
}

TEST_F(MergePoints, CellsThatOverlapStayApart)
{
  // A layer of cells twice, as ghost cells that nothing marks.
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (int block = 0; block < 2; ++block)
  {
    vtkNew<vtkImageData> image;
    image->SetExtent(0, 1, 0, 1, 2 * block, 3 + 2 * block);
    SetField(image);
    blocks->SetBlock(block, image);
  }
  this->Update(blocks);
  EXPECT_EQ(this->CountMerged(), 0U);
  EXPECT_EQ(this->Preparation.Scene.Mesh.GetMesh()->GetNumberOfCells(), 2 * 3 * 5);
  EXPECT_TRUE(this->Update(blocks).empty());
  this->Settings.Merging = PointMerging::Always;
  this->Update(blocks);
  EXPECT_EQ(this->CountMerged(), 8U);
  EXPECT_EQ(this->Preparation.Scene.Mesh.GetMesh()->GetNumberOfCells(), 5 * 5);
  EXPECT_EQ(this->Preparation.Scene.Mesh.GetMesh()->GetRemovedCells().Duplicates, 5);
  this->Settings.Merging = PointMerging::Automatic;
  this->Update(blocks);
  EXPECT_EQ(this->CountMerged(), 0U);
}

TEST_F(MergePoints, DefectsOfTheMeshDoNotKeepItApart)
{
  const auto grid = SeparateCells(MakeSharedCells(VTK_HEXAHEDRON));
  this->Update(grid);
  const std::size_t all = this->CountMerged();
  ASSERT_GT(all, 0U);
  // The same cell twice, by the same points.
  vtkNew<vtkIdList> ids;
  grid->GetCellPoints(5, ids);
  const vtkSmartPointer<vtkUnstructuredGrid> twice = vtkSmartPointer<vtkUnstructuredGrid>::New();
  twice->DeepCopy(grid);
  twice->InsertNextCell(VTK_HEXAHEDRON, ids);
  this->Update(twice);
  EXPECT_GT(this->Preparation.Scene.Mesh.GetMesh()->GetRemovedCells().Duplicates, 0);
  EXPECT_EQ(this->CountMerged(), all);
}

TEST_F(MergePoints, PointsThatComeTogetherAreMerged)
{
  const auto grid = SeparateCells(MakeSharedCells(VTK_HEXAHEDRON));
  double place[3];
  const vtkIdType moved = grid->GetNumberOfPoints() / 2;
  grid->GetPoint(moved, place);
  this->Settings.Merging = PointMerging::Never;
  grid->GetPoints()->SetPoint(moved, place[0] + 0.1, place[1], place[2]);
  this->Update(grid);
  this->Settings.Merging = PointMerging::Always;
  this->Update(grid);
  const std::size_t apart = this->CountMerged();
  this->Settings.Merging = PointMerging::Never;
  this->Update(grid);
  grid->GetPoints()->SetPoint(moved, place);
  grid->GetPoints()->Modified();
  this->Update(grid);
  this->Settings.Merging = PointMerging::Always;
  this->Update(grid);
  EXPECT_EQ(this->CountMerged(), apart + 1);
}

/// A ring whose first and last plane of points are at the same place, to rounding.
vtkSmartPointer<vtkStructuredGrid> MakeWrappedRing(int cellsAround)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 3; ++j)
    {
      for (int i = 0; i <= cellsAround; ++i)
      {
        const double angle = 2 * Pi * i / cellsAround;
        const double radius = 1 + 0.5 * j;
        points->InsertNextPoint(
          radius * std::cos(angle), radius * std::sin(angle), 0.4 * k + 0.1 * std::cos(angle));
      }
    }
  }
  grid->SetDimensions(cellsAround + 1, 3, 4);
  grid->SetPoints(points);
  SetField(grid);
  // The field is that of the first plane, as a solver writes it.
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); p += cellsAround + 1)
  {
    // Where terms cancel, the last bits of one are all that there is.
    const double lastBits = p % 2 == 0 ? 1e-16 : -1e-16;
    GetField(grid)->SetValue(p, p % 4 == 0 ? 0 : GetField(grid)->GetValue(p));
    GetField(grid)->SetValue(p + cellsAround, GetField(grid)->GetValue(p) + lastBits);
  }
  return grid;
}

TEST_F(MergePoints, SeamsOfRingsClose)
{
  for (const int cellsAround : { 12, 13 })
  {
    SCOPED_TRACE(cellsAround);
    const auto ring = MakeWrappedRing(cellsAround);
    double first[3], last[3];
    ring->GetPoint(0, first);
    ring->GetPoint(cellsAround, last);
    ASSERT_FALSE(std::equal(first, first + 3, last)) << "the test is about last bits";
    this->Update(ring);
    EXPECT_EQ(this->CountMerged(), 3U * 4);
    // Inner and outer side, top and bottom; no face of the seam.
    EXPECT_EQ(this->CountBoundaryFaces(), 2 * cellsAround * (2 * 3 + 2 * 2));
  }
}

/// The largest difference of a channel, where something is drawn.
double Compare(const std::vector<float>& a, const std::vector<float>& b)
{
  double largest = 0, covered = 0;
  for (std::size_t c = 0; c < a.size(); ++c)
  {
    largest = std::max(largest, std::abs(static_cast<double>(a[c]) - b[c]));
    covered = std::max(covered, static_cast<double>(b[c]));
  }
  EXPECT_GT(covered, 0.1);
  return largest;
}

std::vector<float> Render(vtkTetrahedraVolumeMapper* mapper, vtkDataObject* data, bool shade)
{
  RayCastScene scene(64, 64, { 0, 0, 0 }, 3);
  mapper->SetInputData(data);
  scene.Volume->SetMapper(mapper);
  scene.Volume->GetProperty()->SetShade(shade);
  scene.Window->Render();
  vtkImageData* image = mapper->GetOutputImage();
  const auto* colors = vtkFloatArray::SafeDownCast(image->GetPointData()->GetScalars());
  return { const_cast<vtkFloatArray*>(colors)->GetPointer(0),
    const_cast<vtkFloatArray*>(colors)->GetPointer(0) + colors->GetNumberOfValues() };
}

template <class MapperT>
void ExpectPictureOfShared()
{
  const auto shared = MakeSharedCells(VTK_HEXAHEDRON);
  const auto separate = SeparateCells(shared);
  for (const bool shade : { false, true })
  {
    SCOPED_TRACE(shade ? "shaded" : "unshaded");
    vtkNew<MapperT> mapper;
    const std::vector<float> expected = Render(mapper, shared, shade);
    vtkNew<MapperT> merging;
    EXPECT_LE(Compare(Render(merging, separate, shade), expected), SameTetrahedra);
    EXPECT_NE(merging->GetStatistics().find("\"merged_points\": 152"), std::string::npos)
      << merging->GetStatistics();
    vtkNew<MapperT> keeping;
    keeping->SetMergePointsToOff();
    const double apart = Compare(Render(keeping, separate, shade), expected);
    // Each cell has gradients of its own then.
    EXPECT_EQ(apart > 1e-3, shade);
  }
}

TEST(MergedPictures, RayCast) { ExpectPictureOfShared<vtkTetrahedraRayCastMapper>(); }

TEST(MergedPictures, Projection) { ExpectPictureOfShared<vtkTetrahedraProjectionMapper>(); }

} // namespace
