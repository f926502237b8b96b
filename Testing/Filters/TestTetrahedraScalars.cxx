// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/ScalarExtraction.h"

#include "CellPatch.h"
#include "Intake/TetrahedraIntake.h"
#include "Mesh/MeshCleaning.h"
#include "Mesh/SpatialOrder.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace tetralux;

namespace
{

// vtkMapper's VTK_SCALAR_MODE_... and vtkAbstractMapper's VTK_GET_ARRAY_BY_...
constexpr int UsePointData = 1;
constexpr int UseCellData = 2;
constexpr int UsePointFieldData = 3;
constexpr int UseCellFieldData = 4;
constexpr int UseFieldData = 5;
constexpr int ById = 0;
constexpr int ByName = 1;

ScalarSelection Select(int scalarMode, const std::string& name)
{
  ScalarSelection selection;
  selection.ScalarMode = scalarMode;
  selection.ArrayAccessMode = ByName;
  selection.ArrayName = name;
  return selection;
}

double LinearField(const double* x) { return 3 + 2 * x[0] - x[1] + 0.5 * x[2]; }

/// Quadratic hexahedra with a linear point field, a vector field and the cell ids.
vtkSmartPointer<vtkUnstructuredGrid> MakeGrid()
{
  CellPatch patch;
  patch.AddBoxes(VTK_QUADRATIC_HEXAHEDRON, 0, 0, 0, 3, 2, 2);
  auto grid = patch.MakeGrid(11, MapAffine);
  grid->GetPointData()->RemoveArray("Unmapped");
  vtkNew<vtkDoubleArray> field;
  field->SetName("Field");
  vtkNew<vtkFloatArray> vectors;
  vectors->SetName("Vectors");
  vectors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    field->InsertNextValue(LinearField(grid->GetPoint(i)));
    vectors->InsertNextTuple3(i, 2, -i);
  }
  grid->GetPointData()->AddArray(vectors);
  grid->GetPointData()->AddArray(field);
  vtkNew<vtkIntArray> cellIds;
  cellIds->SetName("CellIds");
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    cellIds->InsertNextValue(static_cast<int>(i));
  }
  grid->GetCellData()->AddArray(cellIds);
  return grid;
}

} // namespace

TEST(TetrahedraScalars, ALinearFieldStaysLinearAtAddedPoints)
{
  auto grid = MakeGrid();
  TetrahedraIntake intake = TakeInTetrahedra(grid);
  ASSERT_FALSE(intake.Mesh.AddedPoints.Offsets.empty());
  const auto check = [&]
  {
    const ExtractedScalars scalars =
      ExtractScalars(grid, intake.Mesh, Select(UsePointFieldData, "Field"));
    ASSERT_EQ(scalars.Error, "");
    EXPECT_FALSE(scalars.CellData);
    EXPECT_EQ(scalars.ArrayName, "Field");
    ASSERT_EQ(scalars.Values.size(), intake.Mesh.GetNumberOfPoints());
    for (std::size_t i = 0; i < scalars.Values.size(); ++i)
    {
      EXPECT_NEAR(scalars.Values[i], LinearField(&intake.Mesh.Points[3 * i]), 1e-10);
    }
  };
  check();
  RemoveUnusableCells(intake.Mesh);
  OrderSpatially(intake.Mesh);
  check();
}

TEST(TetrahedraScalars, CellValuesFollowTheirTetrahedra)
{
  auto grid = MakeGrid();
  const TetrahedraIntake intake = TakeInTetrahedra(grid);
  const ExtractedScalars scalars =
    ExtractScalars(grid, intake.Mesh, Select(UseCellFieldData, "CellIds"));
  ASSERT_EQ(scalars.Error, "");
  EXPECT_TRUE(scalars.CellData);
  ASSERT_EQ(scalars.Values.size(), intake.Mesh.GetNumberOfCells());
  for (std::size_t i = 0; i < scalars.Values.size(); ++i)
  {
    EXPECT_EQ(scalars.Values[i], static_cast<double>(intake.Mesh.OriginalCells[i]));
  }
}

TEST(TetrahedraScalars, ModesChooseAsEveryMapperDoes)
{
  auto grid = MakeGrid();
  const TetrahedraIntake intake = TakeInTetrahedra(grid);
  ScalarSelection selection;
  EXPECT_NE(ExtractScalars(grid, intake.Mesh, selection).Error, "");
  grid->GetCellData()->SetActiveScalars("CellIds");
  EXPECT_EQ(ExtractScalars(grid, intake.Mesh, selection).ArrayName, "CellIds");
  grid->GetPointData()->SetActiveScalars("Field");
  EXPECT_EQ(ExtractScalars(grid, intake.Mesh, selection).ArrayName, "Field");
  selection.ScalarMode = UseCellData;
  EXPECT_EQ(ExtractScalars(grid, intake.Mesh, selection).ArrayName, "CellIds");
  selection.ScalarMode = UsePointData;
  EXPECT_EQ(ExtractScalars(grid, intake.Mesh, selection).ArrayName, "Field");
  selection.ScalarMode = UsePointFieldData;
  selection.ArrayAccessMode = ById;
  selection.ArrayId = 0;
  EXPECT_EQ(ExtractScalars(grid, intake.Mesh, selection).ArrayName, "Vectors");
}

TEST(TetrahedraScalars, ComponentsAndMagnitude)
{
  auto grid = MakeGrid();
  const TetrahedraIntake intake = TakeInTetrahedra(grid);
  ScalarSelection selection = Select(UsePointFieldData, "Vectors");
  EXPECT_EQ(ExtractScalars(grid, intake.Mesh, selection).Values[5], 5);
  selection.VectorMode = 0;
  EXPECT_NEAR(ExtractScalars(grid, intake.Mesh, selection).Values[5], std::sqrt(54.0), 1e-12);
  selection.VectorMode = 1;
  selection.VectorComponent = 2;
  EXPECT_EQ(ExtractScalars(grid, intake.Mesh, selection).Values[5], -5);
  selection.VectorComponent = 3;
  EXPECT_EQ(ExtractScalars(grid, intake.Mesh, selection).Error,
    "array 'Vectors' has no component 3; it has 3, counted from 0");

  // The magnitude of a single component is the component, sign and all, as in VTK's mappers.
  selection = Select(UsePointFieldData, "Field");
  selection.VectorMode = 0;
  EXPECT_EQ(ExtractScalars(grid, intake.Mesh, selection).Values[5],
    grid->GetPointData()->GetArray("Field")->GetTuple1(5));
}

TEST(TetrahedraScalars, EveryNumericType)
{
  auto grid = MakeGrid();
  const TetrahedraIntake intake = TakeInTetrahedra(grid);
  for (int type : { VTK_CHAR, VTK_SIGNED_CHAR, VTK_UNSIGNED_CHAR, VTK_SHORT, VTK_UNSIGNED_SHORT,
         VTK_INT, VTK_UNSIGNED_INT, VTK_LONG, VTK_UNSIGNED_LONG, VTK_LONG_LONG,
         VTK_UNSIGNED_LONG_LONG, VTK_ID_TYPE, VTK_FLOAT, VTK_DOUBLE })
  {
    auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
    array->SetName("Any");
    array->SetNumberOfTuples(grid->GetNumberOfPoints());
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    {
      array->SetTuple1(i, static_cast<double>(i % 100));
    }
    grid->GetPointData()->AddArray(array);
    const ExtractedScalars scalars =
      ExtractScalars(grid, intake.Mesh, Select(UsePointFieldData, "Any"));
    ASSERT_EQ(scalars.Error, "") << "type " << type;
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    {
      ASSERT_EQ(scalars.Values[i], static_cast<double>(i % 100)) << "type " << type;
    }
  }
}

TEST(TetrahedraScalars, ErrorsNameWhatIsMissingAndWhatThereIs)
{
  auto grid = MakeGrid();
  const TetrahedraIntake intake = TakeInTetrahedra(grid);
  const std::string there =
    "; there are point arrays: Vectors (3 components), Field; cell arrays: CellIds";
  const auto errorOf = [&](const ScalarSelection& selection)
  {
    const ExtractedScalars scalars = ExtractScalars(grid, intake.Mesh, selection);
    EXPECT_TRUE(scalars.Values.empty());
    return scalars.Error;
  };
  EXPECT_EQ(errorOf(Select(UsePointFieldData, "Fild")),
    "the input has no point array named 'Fild'" + there);
  EXPECT_EQ(errorOf(Select(UseCellFieldData, "Field")),
    "the input has no cell array named 'Field'" + there);
  EXPECT_EQ(errorOf(ScalarSelection()), "the input has no active point or cell scalars" + there);
  ScalarSelection selection;
  selection.ScalarMode = UsePointFieldData;
  selection.ArrayId = 7;
  EXPECT_EQ(errorOf(selection), "the input has no point array number 7" + there);
  selection.ScalarMode = UseFieldData;
  EXPECT_NE(errorOf(selection), "");

  vtkNew<vtkFloatArray> tooShort;
  tooShort->SetName("Short");
  tooShort->SetNumberOfTuples(3);
  grid->GetCellData()->AddArray(tooShort);
  EXPECT_EQ(errorOf(Select(UseCellFieldData, "Short")), "array 'Short' has 3 values for 12 cells");
}

TEST(TetrahedraScalars, ABlockWithoutTheArrayHasNoNumbers)
{
  auto first = MakeGrid();
  auto second = MakeGrid();
  auto third = MakeGrid();
  second->GetPointData()->RemoveArray("Field");
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, first);
  blocks->SetBlock(1, second);
  blocks->SetBlock(2, third);
  const TetrahedraIntake intake = TakeInTetrahedra(blocks);
  const ExtractedScalars scalars =
    ExtractScalars(blocks, intake.Mesh, Select(UsePointFieldData, "Field"));
  ASSERT_EQ(scalars.Error, "");
  const auto count = static_cast<std::size_t>(first->GetNumberOfPoints());
  for (std::size_t i = 0; i < count; ++i)
  {
    EXPECT_EQ(scalars.Values[i], scalars.Values[2 * count + i]);
    EXPECT_TRUE(std::isnan(scalars.Values[count + i]));
  }
}
