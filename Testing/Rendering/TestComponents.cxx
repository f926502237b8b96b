// SPDX-License-Identifier: BSD-3-Clause
// Arrays of several components: what of them is shown, and what a mapper that can't says.
#include "Observer.h"
#include "RayCastScene.h"
#include "ReferenceComponents.h"
#include "Statistics.h"

#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkPointData.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace
{

using Picture = std::vector<float>;

/// Of a channel: half of MaximumError, and what the steps of the reference leave.
constexpr double ErrorGoal = 1e-4;

template <class ArrayT>
vtkSmartPointer<ArrayT> MakeArray(const std::vector<std::vector<double>>& components)
{
  auto array = vtkSmartPointer<ArrayT>::New();
  array->SetName("Several");
  array->SetNumberOfComponents(static_cast<int>(components.size()));
  array->SetNumberOfTuples(static_cast<vtkIdType>(components.front().size()));
  for (std::size_t c = 0; c < components.size(); ++c)
  {
    for (std::size_t i = 0; i < components[c].size(); ++i)
    {
      array->SetComponent(static_cast<vtkIdType>(i), static_cast<int>(c), components[c][i]);
    }
  }
  return array;
}

/// The scene of RayCastScene, small, with four fields.
class SeveralScene : public RayCastScene
{
public:
  SeveralScene()
    : RayCastScene(24, 18)
  {
    for (int c = 0; c < 4; ++c)
    {
      this->Fields.emplace_back();
      for (std::size_t p = 0; p < this->Mesh.GetNumberOfPoints(); ++p)
      {
        const double* x = &this->Mesh.Points[3 * p];
        this->Fields.back().push_back(
          c == 0 ? this->Scalars[p] : std::sin(4 * x[c % 3] + 2 * x[(c + 1) % 3] + c));
      }
    }
  }

  /// The first fields as one array of points.
  void Show(int components)
  {
    this->Fields.resize(components);
    this->Grid->GetPointData()->SetScalars(MakeArray<vtkDoubleArray>(this->Fields));
  }

  Picture Render()
  {
    this->Window->Render();
    const vtkIdType size = 4 * this->GetMapper()->GetOutputImage()->GetNumberOfPoints();
    return { this->GetColors(), this->GetColors() + size };
  }

  void ExpectComponents(
    const std::vector<std::vector<double>>& fields, const tetralux::ComponentFunctions& components)
  {
    const Picture picture = this->Render();
    const int* size = this->Window->GetActualSize();
    const tetralux::ReferenceMesh mesh{ this->Mesh.Points, this->Mesh.Cells, fields[0],
      this->CellScalars };
    const std::vector<double> expected = tetralux::RenderComponents(mesh, fields, components,
      this->MakeReferenceRays(size[0], size[1]), this->MakeReferenceLimits());
    ASSERT_EQ(picture.size(), expected.size());
    EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 0.5);
    for (std::size_t i = 0; i < picture.size(); ++i)
    {
      ASSERT_NEAR(picture[i], expected[i], ErrorGoal) << "channel " << i;
    }
    EXPECT_EQ(GetStatistic(this->GetMapper(), "components"), std::to_string(fields.size()));
    EXPECT_LE(this->GetMapper()->GetErrorEstimate(), ErrorGoal);
  }

  std::vector<std::vector<double>> Fields;
};

/// The attenuation of a function alone, or its colour alone.
tetralux::TransferFunction Keep(tetralux::TransferFunction function, bool colors)
{
  for (tetralux::TransferFunction::Node& node : function.Nodes)
  {
    for (tetralux::TransferFunction::Value* value : { &node.Left, &node.Right })
    {
      value->Attenuation = colors ? 0 : value->Attenuation;
      std::for_each(
        value->Color, value->Color + 3, [&](double& channel) { channel = colors ? channel : 0; });
    }
  }
  return function;
}

/// The scalar over largest as a channel.
tetralux::TransferFunction MakeChannel(int channel, double largest)
{
  tetralux::TransferFunction::Value low{}, high{};
  low.Color[channel] = -1000 / largest;
  high.Color[channel] = 1000 / largest;
  return { { { -1000, low, low }, { 1000, high, high } } };
}

TEST(RayCastMapperComponents, Dependent)
{
  SeveralScene scene;
  scene.Volume->GetProperty()->IndependentComponentsOff();
  scene.Show(2);
  tetralux::ComponentFunctions components;
  components.Dependent = true;
  components.Functions = { Keep(scene.Function, true), Keep(scene.Function, false) };
  scene.ExpectComponents(scene.Fields, components);

  // Red, green and blue from 0 to 1, or bytes; the last one through the opacity function.
  const SeveralScene fresh;
  std::vector<std::vector<double>> fields = fresh.Fields;
  for (int c = 0; c < 3; ++c)
  {
    std::for_each(
      fields[c].begin(), fields[c].end(), [](double& value) { value = 0.5 + 0.5 * value; });
  }
  scene.Grid->GetPointData()->SetScalars(MakeArray<vtkDoubleArray>(fields));
  components.Functions = { MakeChannel(0, 1), MakeChannel(1, 1), MakeChannel(2, 1),
    Keep(scene.Function, false) };
  scene.ExpectComponents(fields, components);

  for (std::vector<double>& field : fields)
  {
    std::for_each(
      field.begin(), field.end(), [](double& value) { value = std::floor(std::abs(120 * value)); });
  }
  scene.Opacity->RemoveAllPoints();
  scene.Opacity->AddPoint(20, 0);
  scene.Opacity->AddPoint(110, 0.8);
  const double attenuation = 0.8 / scene.Volume->GetProperty()->GetScalarOpacityUnitDistance();
  scene.Grid->GetPointData()->SetScalars(MakeArray<vtkUnsignedCharArray>(fields));
  components.Functions = { MakeChannel(0, 255), MakeChannel(1, 255), MakeChannel(2, 255),
    tetralux::TransferFunction{
      { { 20, {}, {} }, { 110, { { 0, 0, 0 }, attenuation }, { { 0, 0, 0 }, attenuation } } } } };
  scene.ExpectComponents(fields, components);
}

TEST(RayCastMapperComponents, Independent)
{
  SeveralScene scene;
  scene.Show(3);
  vtkVolumeProperty* property = scene.Volume->GetProperty();
  // Components without functions of their own are not shown.
  const Picture first = scene.Render();
  EXPECT_EQ(GetStatistic(scene.GetMapper(), "components"), "1");
  // Of the second and the third.
  vtkNew<vtkPiecewiseFunction> grey;
  grey->AddPoint(-1, 0.2);
  grey->AddPoint(1, 1);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(-0.5, 0);
  opacity->AddPoint(0.5, 1.2);
  property->SetColor(1, grey);
  property->SetScalarOpacity(1, opacity);
  property->SetScalarOpacityUnitDistance(1, 0.4);
  property->SetColor(2, scene.Color);
  property->SetScalarOpacity(2, scene.Opacity);
  property->SetScalarOpacityUnitDistance(2, 0.5);
  const auto at = [](double scalar, double value, double attenuation)
  {
    const tetralux::TransferFunction::Value node = { { value, value, value }, attenuation };
    return tetralux::TransferFunction::Node{ scalar, node, node };
  };
  tetralux::ComponentFunctions components;
  components.Functions = { scene.Function,
    { { at(-1, 0.2, 0), at(-0.5, 0.4, 0), at(0.5, 0.8, 3), at(1, 1, 3) } }, scene.Function };
  for (tetralux::TransferFunction::Node& node : components.Functions[2].Nodes)
  {
    node.Left.Attenuation *= 0.5; // twice the unit distance
    node.Right.Attenuation *= 0.5;
  }
  scene.ExpectComponents(scene.Fields, components);
  EXPECT_NE(scene.Render(), first);

  // A function of a component is one of the picture, and so are its scalars.
  const Picture before = scene.Render();
  opacity->AddPoint(0, 1);
  const Picture after = scene.Render();
  EXPECT_NE(after, before);
  scene.Mapper->SetVectorModeToComponent();
  EXPECT_EQ(scene.Render(), first);
}

TEST(RayCastMapperComponents, OfCells)
{
  SeveralScene scene;
  scene.CellScalars = true;
  std::vector<std::vector<double>> fields(2);
  for (std::size_t cell = 0; cell < scene.Mesh.GetNumberOfCells(); ++cell)
  {
    fields[0].push_back(scene.Fields[0][scene.Mesh.Cells[4 * cell]]);
    fields[1].push_back(scene.Fields[1][scene.Mesh.Cells[4 * cell]]);
  }
  scene.Grid->GetCellData()->SetScalars(MakeArray<vtkDoubleArray>(fields));
  scene.Mapper->SetScalarModeToUseCellData();
  scene.Volume->GetProperty()->IndependentComponentsOff();
  tetralux::ComponentFunctions components;
  components.Dependent = true;
  components.Functions = { Keep(scene.Function, true), Keep(scene.Function, false) };
  scene.ExpectComponents(fields, components);
}

template <class MapperT>
void ExpectMessages()
{
  SeveralScene scene;
  vtkNew<MapperT> mapper;
  SCOPED_TRACE(mapper->GetClassName());
  scene.Use(mapper);
  std::vector<std::string> errors, warnings;
  const Observer onErrors(
    mapper, vtkCommand::ErrorEvent, [&](const char* text) { errors.emplace_back(text); });
  const Observer onWarnings(
    mapper, vtkCommand::WarningEvent, [&](const char* text) { warnings.emplace_back(text); });
  scene.Show(2);
  scene.Render();
  EXPECT_TRUE(errors.empty() && warnings.empty());
  vtkVolumeProperty* property = scene.Volume->GetProperty();
  property->SetScalarOpacity(1, scene.Opacity);
  scene.Render();
  scene.Render();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("vtkTetrahedraRayCastMapper"), std::string::npos) << warnings[0];
  property->IndependentComponentsOff();
  scene.Window->Render();
  scene.Window->Render();
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].find("IndependentComponents is off"), std::string::npos) << errors[0];
  EXPECT_NE(errors[0].find("vtkTetrahedraRayCastMapper"), std::string::npos) << errors[0];
  EXPECT_EQ(mapper->GetOutputImage()->GetNumberOfPoints(), 0);
}

TEST(MapperComponents, WhoDoesNotDrawThemSaysSo)
{
  ExpectMessages<vtkTetrahedraGPURayCastMapper>();
  ExpectMessages<vtkTetrahedraProjectionMapper>();
  ExpectMessages<vtkTetrahedraIsosurfaceMapper>();
}

TEST(MapperComponents, WhatCanNotBeDrawnIsSaid)
{
  SeveralScene scene;
  std::vector<std::string> errors, warnings;
  const Observer onErrors(
    scene.Mapper, vtkCommand::ErrorEvent, [&](const char* text) { errors.emplace_back(text); });
  const Observer onWarnings(
    scene.Mapper, vtkCommand::WarningEvent, [&](const char* text) { warnings.emplace_back(text); });
  vtkVolumeProperty* property = scene.Volume->GetProperty();
  property->IndependentComponentsOff();
  scene.Show(3);
  scene.Window->Render();
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].find("array 'Several' has 3 components"), std::string::npos) << errors[0];
  scene.Show(2);
  scene.Mapper->SetBlendModeToMaximumIntensity();
  scene.Window->Render();
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_NE(errors[1].find("composite"), std::string::npos) << errors[1];
  scene.Mapper->SetBlendModeToComposite();
  property->ShadeOn();
  scene.Window->Render();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("Shade"), std::string::npos) << warnings[0];
  property->ShadeOff();
  property->IndependentComponentsOn();
  scene.Color->SetVectorModeToRGBColors();
  scene.Window->Render();
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[1].find("RGBColors"), std::string::npos) << warnings[1];
  EXPECT_EQ(errors.size(), 2u);

  SeveralScene bright;
  const Observer onBright(
    bright.Mapper, vtkCommand::ErrorEvent, [&](const char* text) { errors.emplace_back(text); });
  bright.Volume->GetProperty()->IndependentComponentsOff();
  bright.Fields[2][0] = 1e30;
  bright.Show(4);
  bright.Window->Render();
  ASSERT_EQ(errors.size(), 3u);
  EXPECT_NE(errors[2].find("1e+30"), std::string::npos) << errors[2];
}

template <class MapperT>
void ExpectVectorModes()
{
  SeveralScene scene;
  vtkNew<MapperT> mapper;
  SCOPED_TRACE(mapper->GetClassName());
  scene.Use(mapper);
  scene.Show(3);
  const Picture first = scene.Render();
  mapper->SetVectorModeToComponent();
  mapper->SetVectorComponent(2);
  const Picture last = scene.Render();
  mapper->SetVectorModeToMagnitude();
  const Picture magnitude = scene.Render();
  EXPECT_NE(first, last);
  EXPECT_NE(first, magnitude);
  // Ours holds, whatever the function says.
  scene.Color->SetVectorModeToComponent();
  scene.Color->SetVectorComponent(1);
  EXPECT_EQ(scene.Render(), magnitude);
  mapper->SetVectorModeToDisabled();
  const Picture second = scene.Render();
  EXPECT_NE(second, first);
  scene.Color->SetVectorComponent(7); // that of the last one, as in VTK
  EXPECT_EQ(scene.Render(), last);
  scene.Color->SetVectorModeToMagnitude();
  EXPECT_EQ(scene.Render(), magnitude);
  scene.Color->SetVectorComponent(2);
  scene.Color->SetVectorSize(1);
  EXPECT_EQ(scene.Render(), last);

  // That of the array, if the function has VTK's default.
  vtkNew<vtkLookupTable> table;
  table->SetVectorModeToComponent();
  table->SetVectorComponent(1);
  scene.Grid->GetPointData()->GetScalars()->SetLookupTable(table);
  EXPECT_EQ(scene.Render(), last);
  scene.Color->SetVectorModeToComponent();
  scene.Color->SetVectorComponent(0);
  EXPECT_EQ(scene.Render(), second);
  table->SetVectorModeToMagnitude();
  EXPECT_EQ(scene.Render(), magnitude);
}

TEST(MapperComponents, VectorModesOfFunctionsAndTablesHold)
{
  ExpectVectorModes<vtkTetrahedraRayCastMapper>();
  ExpectVectorModes<vtkTetrahedraGPURayCastMapper>();
  ExpectVectorModes<vtkTetrahedraProjectionMapper>();
}

TEST(MapperComponents, SomeOfAVectorHaveAMagnitude)
{
  SeveralScene scene;
  scene.Show(4);
  scene.Color->SetVectorModeToMagnitude();
  scene.Color->SetVectorComponent(1);
  scene.Color->SetVectorSize(2);
  const Picture picture = scene.Render();
  std::vector<double> magnitude;
  for (std::size_t p = 0; p < scene.Fields[0].size(); ++p)
  {
    magnitude.push_back(
      std::sqrt(scene.Fields[1][p] * scene.Fields[1][p] + scene.Fields[2][p] * scene.Fields[2][p]));
  }
  scene.Grid->GetPointData()->SetScalars(MakeArray<vtkDoubleArray>({ magnitude }));
  EXPECT_EQ(scene.Render(), picture);
}

} // namespace
