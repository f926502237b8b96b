// SPDX-License-Identifier: BSD-3-Clause
// Scenes are prepared without any mapper, and a time step rebuilds what it changes.
#include "Preparation/ScenePreparation.h"

#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkCellTypeSource.h"
#include "vtkColorTransferFunction.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolumeProperty.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace
{

using Stages = std::vector<std::string>;

/// Cells of one type; the scalars run from 0 to 1 along x.
vtkSmartPointer<vtkUnstructuredGrid> MakeCells(int cellType)
{
  vtkNew<vtkCellTypeSource> source;
  source->SetCellType(cellType);
  source->SetBlocksDimensions(3, 3, 3);
  source->Update();
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(source->GetOutput()->GetPoints());
  grid->SetCells(source->GetOutput()->GetCellTypesArray(), source->GetOutput()->GetCells());
  vtkNew<vtkDoubleArray> field;
  field->SetName("Field");
  for (vtkIdType p = 0; p < grid->GetNumberOfPoints(); ++p)
  {
    field->InsertNextValue(grid->GetPoint(p)[0] / 3);
  }
  grid->GetPointData()->SetScalars(field);
  return grid;
}

/// As readers of time series make the next step: every array is a new one.
template <class DataT>
vtkSmartPointer<DataT> CopyAll(DataT* data)
{
  auto copy = vtkSmartPointer<DataT>::New();
  copy->DeepCopy(data);
  return copy;
}

class ScenePreparationTest : public testing::Test
{
protected:
  ScenePreparationTest()
    : Preparation(this->Source)
  {
    vtkNew<vtkColorTransferFunction> color;
    color->AddRGBPoint(0, 1, 0, 0);
    color->AddRGBPoint(1, 0, 0, 1);
    vtkNew<vtkPiecewiseFunction> opacity;
    opacity->AddPoint(0, 0);
    opacity->AddPoint(1, 1);
    this->Property->SetColor(color);
    this->Property->SetScalarOpacity(opacity);
    this->Settings.Table.Use = tetralux::TableUse::Never;
  }

  Stages Update(vtkDataObject* data)
  {
    tetralux::SceneInput input;
    input.Data = data;
    input.Property = this->Property;
    input.Matrix = this->Matrix;
    EXPECT_TRUE(this->Preparation.Update(this->Settings, input, {}));
    return this->Preparation.GetLast().Rebuilt;
  }

  const std::vector<double>& GetPoints() const
  {
    return this->Preparation.Scene.Mesh.GetMesh()->GetMesh().Points;
  }

  vtkNew<vtkObject> Source;
  vtkNew<vtkVolumeProperty> Property;
  vtkNew<vtkMatrix4x4> Matrix;
  tetralux::MapperSettings Settings;
  tetralux::ScenePreparation Preparation;
};

TEST_F(ScenePreparationTest, TimeStepsRebuildWhatTheyChange)
{
  for (const int type : { VTK_TETRA, VTK_HEXAHEDRON, VTK_WEDGE, VTK_PYRAMID, VTK_QUADRATIC_TETRA,
         VTK_QUADRATIC_HEXAHEDRON })
  {
    SCOPED_TRACE(type);
    vtkSmartPointer<vtkUnstructuredGrid> step = MakeCells(type);
    ASSERT_GT(step->GetNumberOfCells(), 0);
    EXPECT_EQ(this->Update(step).front(), "mesh");
    EXPECT_EQ(this->Update(step), Stages());

    step = CopyAll(step.Get());
    EXPECT_EQ(this->Update(step), Stages({ "scalars" }))
      << "new arrays, of which values may differ";
    step = CopyAll(step.Get());
    auto* field = vtkDoubleArray::SafeDownCast(step->GetPointData()->GetScalars());
    field->SetValue(3, 0.4);
    EXPECT_EQ(this->Update(step), Stages({ "scalars" }));

    step = CopyAll(step.Get());
    for (vtkIdType p = 0; p < step->GetNumberOfPoints(); ++p)
    {
      double x[3];
      step->GetPoint(p, x);
      x[1] += 0.1 * std::sin(2 * x[0]);
      step->GetPoints()->SetPoint(p, x);
    }
    EXPECT_EQ(this->Update(step), Stages({ "points", "scalars" }));
    // Added points, too, are where a new mesh has them.
    const std::vector<double> moved = this->GetPoints();
    const auto originals = this->Preparation.Scene.Mesh.GetMesh()->GetMesh().OriginalPoints;
    const tetralux::TetrahedralMesh fresh = tetralux::TakeInTetrahedra(step).Mesh;
    for (std::size_t p = 0; p < originals.size(); ++p)
    {
      const std::size_t id = originals[p] >= 0
        ? static_cast<std::size_t>(originals[p])
        : static_cast<std::size_t>(step->GetNumberOfPoints() - 1 - originals[p]);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        ASSERT_EQ(moved[3 * p + axis], fresh.Points[3 * id + axis]);
      }
    }

    step = CopyAll(step.Get());
    vtkNew<vtkIdList> points;
    step->GetCellPoints(0, points);
    step->GetCells()->ReplaceCellAtId(1, points); // the same cell twice
    EXPECT_EQ(this->Update(step), Stages({ "mesh", "scalars" }));
  }
}

TEST_F(ScenePreparationTest, WhatChangedInPlaceIsFoundOnceTheInputSaysSo)
{
  vtkSmartPointer<vtkUnstructuredGrid> grid = MakeCells(VTK_TETRA);
  this->Update(grid);
  grid->Modified();
  EXPECT_EQ(this->Update(grid), Stages()) << "nothing changed";

  auto* field = vtkDoubleArray::SafeDownCast(grid->GetPointData()->GetScalars());
  *field->GetPointer(3) = 0.4;
  EXPECT_EQ(this->Update(grid), Stages()) << "nobody said so";
  grid->Modified();
  EXPECT_EQ(this->Update(grid), Stages({ "scalars" }));
  *field->GetPointer(3) = std::nan("");
  grid->GetPointData()->Modified();
  EXPECT_EQ(this->Update(grid), Stages({ "scalars" }));
  grid->Modified();
  EXPECT_EQ(this->Update(grid), Stages()) << "what is no number is the same number";

  // Of vtkPoints that are floats or doubles.
  vtkDataArray* points = grid->GetPoints()->GetData();
  points->GetDataType() == VTK_FLOAT
    ? void(*static_cast<float*>(points->GetVoidPointer(1)) -= 0.1f)
    : void(*static_cast<double*>(points->GetVoidPointer(1)) -= 0.1);
  grid->Modified();
  EXPECT_EQ(this->Update(grid), Stages({ "points" }));

  vtkNew<vtkIdList> first;
  grid->GetCellPoints(0, first);
  vtkCellArray* cells = grid->GetCells();
  ASSERT_TRUE(cells->IsStorage64Bit());
  for (vtkIdType k = 0; k < first->GetNumberOfIds(); ++k)
  {
    *cells->GetConnectivityArray64()->GetPointer(4 + k) = first->GetId(k); // the same cell twice
  }
  grid->Modified();
  EXPECT_EQ(this->Update(grid), Stages({ "mesh", "scalars" }));
  EXPECT_EQ(this->Preparation.Scene.Mesh.GetMesh()->GetRemovedCells().Duplicates, 1);
}

TEST_F(ScenePreparationTest, CellsThatDependOnPointsAreTakenInAnew)
{
  this->Settings.Merging = tetralux::PointMerging::Never; // the source's prisms touch
  for (const int type : { VTK_POLYHEDRON, VTK_CONVEX_POINT_SET, VTK_HEXAGONAL_PRISM })
  {
    SCOPED_TRACE(type);
    vtkSmartPointer<vtkUnstructuredGrid> step = MakeCells(VTK_HEXAHEDRON);
    if (type == VTK_HEXAGONAL_PRISM)
    {
      step = MakeCells(type);
    }
    else
    {
      vtkNew<vtkUnstructuredGrid> one;
      one->SetPoints(step->GetPoints());
      one->GetPointData()->SetScalars(step->GetPointData()->GetScalars());
      vtkNew<vtkIdList> points;
      step->GetCellPoints(0, points);
      if (type == VTK_POLYHEDRON)
      {
        vtkNew<vtkIdList> faces; // their number, then of each the number of points and these
        faces->InsertNextId(step->GetCell(0)->GetNumberOfFaces());
        for (int f = 0; f < step->GetCell(0)->GetNumberOfFaces(); ++f)
        {
          vtkIdList* face = step->GetCell(0)->GetFace(f)->GetPointIds();
          faces->InsertNextId(face->GetNumberOfIds());
          for (vtkIdType k = 0; k < face->GetNumberOfIds(); ++k)
          {
            faces->InsertNextId(face->GetId(k));
          }
        }
        one->InsertNextCell(type, faces);
      }
      else
      {
        one->InsertNextCell(type, points);
      }
      step = CopyAll(one.GetPointer());
    }
    ASSERT_GT(step->GetNumberOfCells(), 0);
    this->Update(step);
    step->Modified();
    EXPECT_EQ(this->Update(step), Stages()) << "nothing changed";
    step = CopyAll(step.Get());
    double x[3];
    step->GetPoint(0, x);
    x[0] += 0.01;
    step->GetPoints()->SetPoint(0, x);
    EXPECT_EQ(this->Update(step), Stages({ "mesh", "scalars" }));
  }
}

TEST_F(ScenePreparationTest, ImagesAndBlocksMove)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 4, 5);
  image->AllocateScalars(VTK_DOUBLE, 1);
  auto* values = static_cast<double*>(image->GetScalarPointer());
  std::fill_n(values, image->GetNumberOfPoints(), 0.5);
  values[0] = 0;
  this->Update(image);
  image->SetOrigin(1, 2, 3);
  EXPECT_EQ(this->Update(image), Stages({ "points" }));
  image->SetDimensions(3, 5, 4);
  EXPECT_EQ(this->Update(image), Stages({ "mesh", "scalars" }));

  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakeCells(VTK_TETRA));
  blocks->SetBlock(1, MakeCells(VTK_HEXAHEDRON));
  this->Update(blocks);
  auto moved = CopyAll(blocks.GetPointer());
  vtkUnstructuredGrid::SafeDownCast(moved->GetBlock(1))->GetPoints()->SetPoint(0, -0.5, 0, 0);
  EXPECT_EQ(this->Update(moved), Stages({ "points", "scalars" }));
  moved = CopyAll(moved.Get());
  moved->SetBlock(1, nullptr);
  EXPECT_EQ(this->Update(moved), Stages({ "mesh", "scalars" }));
}

TEST_F(ScenePreparationTest, PointsThatAreNoNumbersRemoveCells)
{
  vtkSmartPointer<vtkUnstructuredGrid> step = MakeCells(VTK_TETRA);
  this->Update(step);
  step = CopyAll(step.Get());
  step->GetPoints()->SetPoint(0, std::nan(""), 0, 0);
  EXPECT_EQ(this->Update(step), Stages({ "mesh", "scalars" }));
  const auto& removed = this->Preparation.Scene.Mesh.GetMesh()->GetRemovedCells();
  EXPECT_GT(removed.NonFiniteCoordinates, 0);
  // And they come back.
  step = CopyAll(step.Get());
  step->GetPoints()->SetPoint(0, 0, 0, 0);
  EXPECT_EQ(this->Update(step), Stages({ "mesh", "scalars" }));
  EXPECT_EQ(this->Preparation.Scene.Mesh.GetMesh()->GetRemovedCells().NonFiniteCoordinates, 0);
}

TEST_F(ScenePreparationTest, SameCellsByAnyNumberOfIdBits)
{
  vtkSmartPointer<vtkUnstructuredGrid> step = MakeCells(VTK_TETRA);
  this->Update(step);
  step = CopyAll(step.Get());
  step->GetCells()->ConvertTo32BitStorage();
  // Other bits: taken for other cells, which costs time and nothing else.
  EXPECT_EQ(this->Update(step), Stages({ "mesh", "scalars" }));
}

TEST_F(ScenePreparationTest, SettingsAreKeysOfTheirOwn)
{
  vtkSmartPointer<vtkUnstructuredGrid> grid = MakeCells(VTK_TETRA);
  this->Update(grid);
  this->Settings.Model = tetralux::OpticalModel::EmissionOnly;
  EXPECT_EQ(this->Update(grid), Stages({ "transfer function" }));
  this->Settings.Model = tetralux::OpticalModel::EmissionAbsorption;
  EXPECT_EQ(this->Update(grid), Stages({ "transfer function" }));
  this->Settings.Table.Use = tetralux::TableUse::Always;
  EXPECT_EQ(this->Update(grid), Stages({ "table" }));
  ASSERT_NE(this->Preparation.Scene.Optics.GetTable(), nullptr);
  EXPECT_EQ(this->Update(grid), Stages());
  this->Settings.Table.Use = tetralux::TableUse::Never;
  EXPECT_EQ(this->Update(grid), Stages());
  EXPECT_EQ(this->Preparation.Scene.Optics.GetTable(), nullptr);
  this->Settings.Table.Use = tetralux::TableUse::Always;
  EXPECT_EQ(this->Update(grid), Stages());
  EXPECT_NE(this->Preparation.Scene.Optics.GetTable(), nullptr);
}

} // namespace
