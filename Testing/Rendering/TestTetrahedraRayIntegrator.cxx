// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraRayIntegrator.h"

#include "Observer.h"
#include "ReferenceGrazing.h"
#include "ReferenceIntegral.h"
#include "ReferenceRenderer.h"
#include "ReferenceScenes.h"

#include "vtkAutoInit.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkColorTransferFunction.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkHeadlessRenderWindow.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"
#include "vtkUnstructuredGridBunykRayCastFunction.h"
#include "vtkUnstructuredGridHomogeneousRayIntegrator.h"
#include "vtkUnstructuredGridLinearRayIntegrator.h"
#include "vtkUnstructuredGridPartialPreIntegration.h"
#include "vtkUnstructuredGridPreIntegration.h"
#include "vtkUnstructuredGridVolumeRayCastIterator.h"
#include "vtkUnstructuredGridVolumeRayCastMapper.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <random>
#include <string>
#include <vector>

// How VTK draws what its own mapper casts.
VTK_MODULE_INIT(vtkRenderingVolumeOpenGL2)

namespace
{

using namespace tetralux;
using Vector = std::array<double, 3>;

/// A peak and a colour for everything, the same as a property and by itself. The colour has a node
/// wherever the opacity has one: VTK's integrators see only those.
struct Functions
{
  vtkNew<vtkVolumeProperty> Property;
  TransferFunction Exact;

  explicit Functions(double unitDistance = 0.5)
  {
    // Scalar, red, green, blue, opacity.
    std::vector<std::array<double, 5>> nodes{ { -1, 0, 0, 1, 0 }, { -0.1, 0.9, 0.2, 0.1, 0.1 },
      { 0, 1, 0.25, 0, 4 }, { 0.1, 0.9, 0.4, 0, 0.2 }, { 1, 0.5, 1, 0, 0.8 } };
    vtkNew<vtkColorTransferFunction> color;
    vtkNew<vtkPiecewiseFunction> opacity;
    for (auto& node : nodes)
    {
      color->AddRGBPoint(node[0], node[1], node[2], node[3]);
      opacity->AddPoint(node[0], node[4]);
      node[4] /= unitDistance;
    }
    this->Property->SetColor(color);
    this->Property->SetScalarOpacity(opacity);
    this->Property->SetScalarOpacityUnitDistance(unitDistance);
    this->Exact = MakeLinearFunction(nodes);
  }
};

/// What an integrator is given, for scalars of any number of components.
struct Segments
{
  vtkNew<vtkDoubleArray> Lengths;
  vtkNew<vtkDoubleArray> Near;
  vtkNew<vtkDoubleArray> Far;

  explicit Segments(int components)
  {
    this->Near->SetNumberOfComponents(components);
    this->Far->SetNumberOfComponents(components);
  }
  void Add(const std::vector<double>& near, const std::vector<double>& far, double length)
  {
    this->Lengths->InsertNextValue(length);
    this->Near->InsertNextTuple(near.data());
    this->Far->InsertNextTuple(far.data());
  }
  void Integrate(vtkUnstructuredGridVolumeRayIntegrator* integrator, vtkVolumeProperty* property,
    float color[4]) const
  {
    vtkNew<vtkVolume> volume;
    volume->SetProperty(property);
    integrator->Initialize(volume, this->Near);
    integrator->Integrate(this->Lengths, this->Near, this->Far, color);
  }
};

/// What the oracle makes of segments of one component behind a colour.
void AddReference(const TransferFunction& function, const Segments& segments, double color[4])
{
  for (vtkIdType i = 0; i < segments.Lengths->GetNumberOfValues(); ++i)
  {
    const ReferenceSegment part = IntegrateReference(function, segments.Near->GetValue(i),
      segments.Far->GetValue(i), segments.Lengths->GetValue(i));
    const double transmittance = 1 - color[3];
    for (int c = 0; c < 3; ++c)
    {
      color[c] += transmittance * part.Color[c];
    }
    color[3] += transmittance * part.Alpha;
  }
}

/// Single precision colours, twice rounded.
constexpr double ColorRounding = 1.2e-7;

} // namespace

TEST(TetrahedraRayIntegrator, AgreesWithTheReferenceInFrontToBackOrder)
{
  const Functions functions;
  vtkNew<vtkTetrahedraRayIntegrator> integrator;
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 300; ++trial)
  {
    // In front is what earlier calls left.
    Segments segments(1);
    const int count = trial % 5;
    for (int i = 0; i < count; ++i)
    {
      segments.Add({ 1.2 * unit(generator) }, { 1.2 * unit(generator) },
        std::pow(10, 2 * unit(generator) - 1.5));
    }
    const double front = 0.5 + 0.5 * unit(generator);
    float color[4];
    double expected[4];
    for (int c = 0; c < 4; ++c)
    {
      color[c] = static_cast<float>(c == 3 ? front : front * std::abs(unit(generator)));
      expected[c] = color[c];
    }
    AddReference(functions.Exact, segments, expected);
    segments.Integrate(integrator, functions.Property, color);
    for (int c = 0; c < 4; ++c)
    {
      EXPECT_NEAR(color[c], expected[c], ColorRounding);
    }
  }
}

TEST(TetrahedraRayIntegrator, NoticesWhatChangesInTheProperty)
{
  const Functions functions;
  vtkNew<vtkTetrahedraRayIntegrator> integrator;
  Segments segments(1);
  segments.Add({ 0.5 }, { 0.5 }, 1);
  const auto getOpacity = [&]
  {
    float color[4] = { 0, 0, 0, 0 };
    segments.Integrate(integrator, functions.Property, color);
    return color[3];
  };
  const double attenuation = 0.2 + 0.6 * 4 / 9; // per 0.5
  EXPECT_NEAR(getOpacity(), -std::expm1(-2 * attenuation), ColorRounding);
  functions.Property->SetScalarOpacityUnitDistance(1);
  EXPECT_NEAR(getOpacity(), -std::expm1(-attenuation), ColorRounding);
  functions.Property->GetScalarOpacity()->AddPoint(0.5, 3);
  EXPECT_NEAR(getOpacity(), -std::expm1(-3), ColorRounding);
  // Also across that node, which the colour does not have.
  segments.Near->SetValue(0, 0.1);
  segments.Far->SetValue(0, 1);
  EXPECT_NEAR(getOpacity(), -std::expm1(-(0.4 * 1.6 + 0.5 * 1.9) / 0.9), ColorRounding);
}

TEST(TetrahedraRayIntegrator, ComponentsThatDependOnEachOtherAreColoursThemselves)
{
  const Functions functions(0.5);
  functions.Property->IndependentComponentsOff();
  vtkNew<vtkTetrahedraRayIntegrator> integrator;
  const TransferFunction colors =
    MakeLinearFunction({ { 0, 0.1, 0.5, 0.9, 3 }, { 1, 0.7, 0.2, 0.4, 0.4 } });
  Segments four(4);
  four.Add({ 0.1, 0.5, 0.9, 1.5 }, { 0.7, 0.2, 0.4, 0.2 }, 0.8);
  float color[4] = { 0, 0, 0, 0 };
  four.Integrate(integrator, functions.Property, color);
  const ReferenceSegment expected = IntegrateReference(colors, 0, 1, 0.8);
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(color[c], expected.Color[c], ColorRounding);
  }
  EXPECT_NEAR(color[3], expected.Alpha, ColorRounding);

  Segments two(2);
  two.Add({ 0.1, 1.5 }, { 0.7, 0.2 }, 0.8);
  float grey[4] = { 0, 0, 0, 0 };
  two.Integrate(integrator, functions.Property, grey);
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_EQ(grey[c], color[0]);
  }
  EXPECT_EQ(grey[3], color[3]);
}

TEST(TetrahedraRayIntegrator, IndependentComponentsMixAsInVtk)
{
  // The clouds of both components, as VTK's integrator mixes them, in single precision inside.
  const Functions functions;
  vtkNew<vtkColorTransferFunction> otherColor;
  otherColor->AddRGBPoint(0, 0, 1, 1);
  otherColor->AddRGBPoint(1.7, 0.2, 0.3, 1);
  otherColor->AddRGBPoint(3, 1, 0, 1);
  vtkNew<vtkPiecewiseFunction> otherOpacity;
  otherOpacity->AddPoint(0, 0.5);
  otherOpacity->AddPoint(1.7, 0);
  otherOpacity->AddPoint(3, 2);
  functions.Property->SetColor(1, otherColor);
  functions.Property->SetScalarOpacity(1, otherOpacity);
  functions.Property->SetScalarOpacityUnitDistance(1, 0.8);
  vtkNew<vtkTetrahedraRayIntegrator> integrator;
  vtkNew<vtkUnstructuredGridLinearRayIntegrator> vtkIntegrator;
  std::mt19937_64 generator(17);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 200; ++trial)
  {
    Segments segments(2);
    const auto getScalars = [&] {
      return std::vector<double>{ 1.9 * unit(generator) - 0.95, 3 * unit(generator) };
    };
    const std::vector<double> near = getScalars();
    segments.Add(near, getScalars(), unit(generator));
    float color[4] = { 0, 0, 0, 0 };
    float expected[4] = { 0, 0, 0, 0 };
    segments.Integrate(integrator, functions.Property, color);
    // Initialize asks for the range of the scalars, which the arrays of one segment do not have.
    Segments range(2);
    range.Add({ -1, 0 }, { -1, 0 }, 0);
    range.Add({ 1, 3 }, { 1, 3 }, 0);
    float nothing[4] = { 0, 0, 0, 0 };
    range.Integrate(vtkIntegrator, functions.Property, nothing);
    vtkIntegrator->Integrate(segments.Lengths, segments.Near, segments.Far, expected);
    for (int c = 0; c < 4; ++c)
    {
      EXPECT_NEAR(color[c], expected[c], 2e-5) << "trial " << trial;
    }
  }

  // Two clouds of the same kind are one that is twice as dense.
  functions.Property->SetColor(1, functions.Property->GetRGBTransferFunction(0));
  functions.Property->SetScalarOpacity(1, functions.Property->GetScalarOpacity(0));
  functions.Property->SetScalarOpacityUnitDistance(1, 0.5);
  Segments twice(2);
  twice.Add({ -0.9, -0.9 }, { 0.8, 0.8 }, 0.5);
  float color[4] = { 0, 0, 0, 0 };
  twice.Integrate(integrator, functions.Property, color);
  const ReferenceSegment expected = IntegrateReference(functions.Exact, -0.9, 0.8, 1);
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(color[c], expected.Color[c], ColorRounding);
  }
  EXPECT_NEAR(color[3], expected.Alpha, ColorRounding);
}

TEST(TetrahedraRayIntegrator, WhatIsNotFiniteContributesNothing)
{
  const Functions functions;
  vtkNew<vtkTetrahedraRayIntegrator> integrator;
  Segments segments(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  segments.Add({ nan }, { 0.5 }, 1);
  segments.Add({ 0.5 }, { -infinity }, 1);
  segments.Add({ 0.5 }, { 0.5 }, nan);
  segments.Add({ 0.5 }, { 0.5 }, infinity);
  segments.Add({ 0.5 }, { 0.5 }, -1);
  float color[4] = { 0.25f, 0.25f, 0.25f, 0.5f };
  segments.Integrate(integrator, functions.Property, color);
  EXPECT_EQ(color[0], 0.25f);
  EXPECT_EQ(color[3], 0.5f);
}

TEST(TetrahedraRayIntegrator, RefusesWhatThePropertyDoesNotDescribe)
{
  const struct
  {
    int Components;
    bool Independent;
    double UnitDistance;
    const char* Message;
  } examples[] = { { 3, false, 1, "must be 2 or 4, not 3" }, { 5, true, 1, "at most 4" },
    { 1, true, 0, "ScalarOpacityUnitDistance" }, { 4, false, 0, "ScalarOpacityUnitDistance" } };
  for (const auto& example : examples)
  {
    const Functions functions;
    functions.Property->SetIndependentComponents(example.Independent);
    functions.Property->SetScalarOpacityUnitDistance(example.UnitDistance);
    vtkNew<vtkTetrahedraRayIntegrator> integrator;
    std::string errors;
    const Observer observer(
      integrator, vtkCommand::ErrorEvent, [&](const char* text) { errors += text; });
    Segments segments(example.Components);
    const std::vector<double> scalars(example.Components, 0.5);
    segments.Add(scalars, scalars, 1);
    float color[4] = { 0, 0, 0, 0 };
    segments.Integrate(integrator, functions.Property, color);
    EXPECT_NE(errors.find(example.Message), std::string::npos) << errors;
    EXPECT_EQ(color[3], 0);
  }
}

//------------------------------------------------------------------------------------------------
// Under VTK's mapper
//------------------------------------------------------------------------------------------------

namespace
{

constexpr int Width = 72;
constexpr int Height = 60;

/// A small box of jittered cells in perspective, cast by VTK's mapper.
class VtkScene
{
public:
  VtkScene(bool cellScalars, bool parallel)
    : CellScalars(cellScalars)
    , Parallel(parallel)
  {
    this->Mesh = MakeBox(6, 5, 6, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, 9);
    const auto field = [](const double* p)
    { return std::sin(5 * p[0] + 3 * p[1]) * std::cos(4 * p[2] - p[0]); };
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (std::size_t i = 0; i < this->Mesh.Points.size(); i += 3)
    {
      points->InsertNextPoint(&this->Mesh.Points[i]);
    }
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(points);
    vtkNew<vtkDoubleArray> scalars;
    scalars->SetName("Field");
    for (std::size_t i = 0; i < this->Mesh.Cells.size(); i += 4)
    {
      const std::int32_t* c = &this->Mesh.Cells[i];
      const vtkIdType ids[4] = { c[0], c[1], c[2], c[3] };
      grid->InsertNextCell(VTK_TETRA, 4, ids);
      if (cellScalars)
      {
        scalars->InsertNextValue(field(&this->Mesh.Points[3 * static_cast<std::size_t>(c[0])]));
      }
    }
    for (std::size_t i = 0; i < this->Mesh.Points.size() && !cellScalars; i += 3)
    {
      scalars->InsertNextValue(field(&this->Mesh.Points[i]));
    }
    this->Scalars.assign(
      scalars->GetPointer(0), scalars->GetPointer(0) + scalars->GetNumberOfValues());
    if (cellScalars)
    {
      grid->GetCellData()->SetScalars(scalars);
    }
    else
    {
      grid->GetPointData()->SetScalars(scalars);
    }
    this->Mapper->SetInputData(grid);
    this->Mapper->SetRayCastFunction(this->RayCastFunction);
    this->Mapper->AutoAdjustSampleDistancesOff();
    this->Volume->SetMapper(this->Mapper);
    this->Volume->SetProperty(this->Colors.Property);
    this->Renderer->AddVolume(this->Volume);
    this->Window->AddRenderer(this->Renderer);
    this->Window->SetSize(Width, Height);
    // VTK 9.1 may take the aspect of an earlier renderer for its own.
    this->Renderer->SetAspect(static_cast<double>(Width) / Height, 1);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(this->Position.data());
    camera->SetFocalPoint(this->FocalPoint.data());
    camera->SetViewUp(this->ViewUp.data());
    camera->SetViewAngle(ViewAngle);
    camera->SetParallelProjection(parallel);
    camera->SetParallelScale(ParallelScale);
    this->Renderer->ResetCameraClippingRange();
  }

  /// The colours that the mapper makes with an integrator, before they are rounded to 8 bits.
  std::vector<float> Cast(vtkUnstructuredGridVolumeRayIntegrator* integrator)
  {
    this->Mapper->SetRayIntegrator(integrator);
    this->Window->Render();
    vtkNew<vtkDoubleArray> scalars;
    scalars->SetArray(this->Scalars.data(), static_cast<vtkIdType>(this->Scalars.size()), 1);
    integrator->Initialize(this->Volume, scalars);
    vtkDataArray* pointScalars = this->CellScalars ? nullptr : scalars.Get();
    this->RayCastFunction->Initialize(this->Renderer, this->Volume);
    auto iterator = vtkSmartPointer<vtkUnstructuredGridVolumeRayCastIterator>::Take(
      this->RayCastFunction->NewIterator());
    vtkNew<vtkDoubleArray> lengths;
    vtkNew<vtkDoubleArray> near;
    vtkNew<vtkDoubleArray> far;
    vtkNew<vtkIdList> cells;
    std::vector<float> colors(4 * Width * Height, 0.f);
    for (int pixel = 0; pixel < Width * Height; ++pixel)
    {
      iterator->Initialize(pixel % Width, pixel / Width);
      while (iterator->GetNextIntersections(cells, lengths, pointScalars, near, far) > 0)
      {
        if (this->CellScalars)
        {
          near->SetNumberOfValues(cells->GetNumberOfIds());
          for (vtkIdType i = 0; i < cells->GetNumberOfIds(); ++i)
          {
            near->SetValue(i, this->Scalars[cells->GetId(i)]);
          }
        }
        integrator->Integrate(lengths, near, this->CellScalars ? near : far, &colors[4 * pixel]);
      }
    }
    this->RayCastFunction->Finalize();
    return colors;
  }

  /// The largest error in pixels that no silhouette grazes.
  double GetError(const std::vector<float>& colors)
  {
    if (this->Reference.Rgba.empty())
    {
      RayGrid rays = this->Parallel ? MakeParallelGrid(this->Position, this->FocalPoint,
                                        this->ViewUp, ParallelScale, Width, Height)
                                    : MakePerspectiveGrid(this->Position, this->FocalPoint,
                                        this->ViewUp, ViewAngle, Width, Height);
      // Through the lower left corners of the pixels.
      for (int axis = 0; axis < 3; ++axis)
      {
        rays.Origin[axis] -= 0.5 * (rays.OriginStepX[axis] + rays.OriginStepY[axis]);
        rays.Direction[axis] -= 0.5 * (rays.DirectionStepX[axis] + rays.DirectionStepY[axis]);
      }
      const ReferenceMesh mesh{ this->Mesh.Points, this->Mesh.Cells, this->Scalars,
        this->CellScalars };
      this->Reference = RenderReference(mesh, this->Colors.Exact, rays);
      this->Grazing = MeasureGrazing(mesh, this->Colors.Exact, rays, {}, this->Reference);
    }
    double largest = 0;
    int compared = 0;
    for (std::size_t pixel = 0; pixel < this->Grazing.size(); ++pixel)
    {
      if (this->Grazing[pixel] <= GrazingThreshold && this->Reference.Rgba[4 * pixel + 3] > 0)
      {
        ++compared;
        for (std::size_t k = 4 * pixel; k < 4 * pixel + 4; ++k)
        {
          largest = std::max(largest, std::abs(colors[k] - this->Reference.Rgba[k]));
        }
      }
    }
    EXPECT_GT(compared, Width * Height / 4);
    return largest;
  }

  vtkNew<vtkUnstructuredGridVolumeRayCastMapper> Mapper;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkHeadlessRenderWindow> Window;
  ReferenceImage Reference;

private:
  /// From afar: the Bunyk function interpolates scalars in the image plane, which is wrong by the
  /// share of a cell's depth in its distance.
  static constexpr double ViewAngle = 0.3; ///< degrees
  static constexpr double ParallelScale = 0.7;
  Vector Position{ 160.5, 110.5, 220.5 };
  Vector FocalPoint{ 0.5, 0.5, 0.5 };
  Vector ViewUp{ 0.1, 1, 0 };
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkUnstructuredGridBunykRayCastFunction> RayCastFunction;
  Functions Colors;
  TetrahedralMesh Mesh;
  std::vector<double> Scalars;
  bool CellScalars;
  bool Parallel;
  std::vector<double> Grazing;
};

} // namespace

TEST(TetrahedraRayIntegrator, IsMoreExactThanVtkInItsOwnRayCaster)
{
  for (const bool parallel : { false, true })
  {
    VtkScene scene(false, parallel);
    vtkNew<vtkTetrahedraRayIntegrator> closedForm;
    vtkNew<vtkUnstructuredGridPreIntegration> table;
    vtkNew<vtkUnstructuredGridPartialPreIntegration> partialTable;
    vtkNew<vtkUnstructuredGridLinearRayIntegrator> linear;
    const double error = scene.GetError(scene.Cast(closedForm));
    const double tableError = scene.GetError(scene.Cast(table));
    const double partialTableError = scene.GetError(scene.Cast(partialTable));
    const double linearError = scene.GetError(scene.Cast(linear));
    std::cout << (parallel ? "parallel" : "perspective") << ": largest error of the closed form "
              << error << ", of VTK's pre-integration " << tableError
              << ", partial pre-integration " << partialTableError << ", linear integrator "
              << linearError << '\n';
    EXPECT_LT(error, parallel ? 1e-5 : 1e-3);
    EXPECT_GT(tableError, 10 * error);
    EXPECT_LT(error, partialTableError);
  }
}

TEST(TetrahedraRayIntegrator, CellScalarsInVtkRayCaster)
{
  for (const bool parallel : { false, true })
  {
    VtkScene scene(true, parallel);
    vtkNew<vtkTetrahedraRayIntegrator> closedForm;
    vtkNew<vtkUnstructuredGridHomogeneousRayIntegrator> homogeneous;
    const double error = scene.GetError(scene.Cast(closedForm));
    const double homogeneousError = scene.GetError(scene.Cast(homogeneous));
    std::cout << (parallel ? "parallel" : "perspective") << ": largest error of the closed form "
              << error << ", of VTK's homogeneous integrator " << homogeneousError << '\n';
    EXPECT_LT(error, 1e-6);
    EXPECT_GT(homogeneousError, 10 * error);
  }
}

TEST(TetrahedraRayIntegrator, PictureInTheWindow)
{
  // The picture as users see it: by threads, in 8 bits, from rays that end early, and drawn as a
  // texture that VTK stretches by a pixel.
  VtkScene scene(false, true);
  vtkNew<vtkTetrahedraRayIntegrator> closedForm;
  scene.Mapper->SetNumberOfThreads(3);
  const std::vector<float> colors = scene.Cast(closedForm);
  vtkNew<vtkUnsignedCharArray> pixels;
  scene.Window->GetPixelData(0, 0, Width - 1, Height - 1, 0, pixels, 0);
  ASSERT_EQ(pixels->GetNumberOfTuples(), Width * Height);
  double sum = 0;
  double expected = 0;
  double difference = 0;
  for (vtkIdType pixel = 0; pixel < Width * Height; ++pixel)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double value = pixels->GetComponent(pixel, c) / 255;
      sum += value;
      expected += colors[4 * pixel + c];
      difference += std::abs(value - colors[4 * pixel + c]);
    }
  }
  EXPECT_NEAR(sum, expected, 0.04 * expected);
  EXPECT_LT(difference, 0.06 * expected);
}
