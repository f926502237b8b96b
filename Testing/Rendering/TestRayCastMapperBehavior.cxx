// SPDX-License-Identifier: BSD-3-Clause
// What the mapper rebuilds, how it composites, adjusts, aborts and refuses.
#include "Observer.h"
#include "OpenGL/LoadedFunctions.h"
#include "RayCastScene.h"
#include "Statistics.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkCommand.h"
#include "vtkContourValues.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkHardwareSelector.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPlane.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

namespace
{

// Errors or warnings of a mapper, which are then not printed.
class Messages
{
public:
  Messages(vtkObject* object, unsigned long event)
    : Watcher(object, event, [this](const char* text) { this->Texts.emplace_back(text); })
  {
  }

  std::vector<std::string> Texts;

private:
  Observer Watcher;
};

std::vector<float> CopyColors(const RayCastScene& scene)
{
  const vtkIdType size = 4 * scene.Mapper->GetOutputImage()->GetNumberOfPoints();
  return { scene.GetColors(), scene.GetColors() + size };
}

// Voxels that fill the box, five tetrahedra each.
vtkSmartPointer<vtkImageData> MakeImage()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(5, 4, 3);
  image->SetSpacing(0.25, 1. / 3, 0.5);
  vtkNew<vtkDoubleArray> field;
  field->SetName("Field");
  for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p)
  {
    field->InsertNextValue(std::sin(static_cast<double>(p)));
  }
  image->GetPointData()->SetScalars(field);
  return image;
}

std::string RenderAndGetRebuilt(RayCastScene& scene)
{
  scene.Window->Render();
  return GetStatistic(scene.Mapper, "rebuilt");
}

const char* const Nothing = "[]";
const char* const Scalars = "[\"scalars\"]";
const char* const Function = "[\"transfer function\"]";
const char* const Points = "[\"points\"]";
const char* const MeshAndScalars = "[\"mesh\",\"scalars\"]";

TEST(RayCastMapperCaching, RebuildsWhatChanged)
{
  RayCastScene scene;
  EXPECT_EQ(RenderAndGetRebuilt(scene), "[\"mesh\",\"scalars\",\"transfer function\"]");

  // Nothing that frames differ in.
  scene.Renderer->GetActiveCamera()->Azimuth(10);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);
  scene.Window->SetSize(80, 90);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);
  scene.Volume->SetScale(1.01, 1, 1);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);
  vtkNew<vtkPlane> plane;
  scene.Mapper->AddClippingPlane(plane);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);
  scene.Mapper->SetMaximumError(1e-3);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);

  // Scalars.
  auto* field = vtkDoubleArray::SafeDownCast(scene.Grid->GetPointData()->GetScalars());
  field->SetValue(0, 0.3);
  field->Modified();
  EXPECT_EQ(RenderAndGetRebuilt(scene), Scalars);
  vtkNew<vtkDoubleArray> other;
  other->DeepCopy(field);
  other->SetName("Other");
  scene.Grid->GetPointData()->AddArray(other);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);
  scene.Grid->GetPointData()->SetActiveScalars("Other");
  EXPECT_EQ(RenderAndGetRebuilt(scene), Scalars);
  scene.Mapper->SetVectorMode(vtkTetrahedraRayCastMapper::MAGNITUDE_MODE);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Scalars);

  // Transfer function.
  scene.Opacity->AddPoint(0.5, 0.2);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Function);
  scene.Color->AddRGBPoint(0.5, 1, 1, 1);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Function);
  scene.Volume->GetProperty()->SetScalarOpacityUnitDistance(0.1);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Function);
  scene.Volume->GetProperty()->SetAmbient(0.3);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);

  // A new grid of the same points and cells, as pipelines make them.
  vtkNew<vtkUnstructuredGrid> copy;
  copy->ShallowCopy(scene.Grid);
  scene.Mapper->SetInputData(copy);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);

  // Mesh.
  scene.Grid->GetPoints()->SetPoint(0, -0.1, -0.1, -0.1);
  scene.Grid->GetPoints()->Modified();
  EXPECT_EQ(RenderAndGetRebuilt(scene), Points);
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(copy->GetNumberOfCells());
  ghosts->Fill(0);
  copy->GetCellData()->AddArray(ghosts);
  EXPECT_EQ(RenderAndGetRebuilt(scene), MeshAndScalars);
  ghosts->SetValue(3, vtkDataSetAttributes::DUPLICATECELL);
  ghosts->Modified();
  EXPECT_EQ(RenderAndGetRebuilt(scene), MeshAndScalars);
  EXPECT_EQ(GetStatistic(scene.Mapper, "ghost_cells"), "1");
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);
}

TEST(RayCastMapperCaching, ApproximatedFunctionFollowsMaximumError)
{
  RayCastScene scene;
  scene.Color->SetColorSpaceToLab();
  scene.Mapper->SetIntegrationToClosedForm();
  scene.Window->Render();
  const double fine = scene.Mapper->GetErrorEstimate();
  scene.Volume->SetScale(1.01, 1, 1); // not twice the size
  EXPECT_EQ(RenderAndGetRebuilt(scene), Nothing);
  scene.Volume->SetScale(10, 1, 1);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Function);
  scene.Mapper->SetMaximumError(1e-2);
  EXPECT_EQ(RenderAndGetRebuilt(scene), Function);
  EXPECT_GT(scene.Mapper->GetErrorEstimate(), 10 * fine);
  EXPECT_LE(scene.Mapper->GetErrorEstimate(), 1e-2);
}

TEST(RayCastMapperCaching, ChangedInputGivesTheSamePictureAsAFreshOne)
{
  RayCastScene scene;
  scene.Window->Render();
  const std::vector<float> before = CopyColors(scene);
  auto* field = vtkDoubleArray::SafeDownCast(scene.Grid->GetPointData()->GetScalars());
  for (vtkIdType i = 0; i < field->GetNumberOfValues(); ++i)
  {
    field->SetValue(i, -field->GetValue(i));
    scene.Scalars[i] = field->GetValue(i);
  }
  field->Modified();
  scene.ExpectReference();
  EXPECT_NE(CopyColors(scene), before);
}

TEST(RayCastMapperBehavior, PictureDoesNotDependOnThreads)
{
  RayCastScene scene;
  scene.Mapper->SetNumberOfThreads(1);
  scene.Window->Render();
  const std::vector<float> one = CopyColors(scene);
  for (const int threads : { 2, 3, 8 })
  {
    scene.Mapper->SetNumberOfThreads(threads);
    scene.Window->Render();
    EXPECT_EQ(GetStatistic(scene.Mapper, "threads"), std::to_string(threads));
    EXPECT_EQ(std::memcmp(one.data(), scene.GetColors(), one.size() * sizeof(float)), 0);
  }
}

// The window shows the picture over the background, rounded to 8 bits.
TEST(RayCastMapperBehavior, CompositesOverTheBackground)
{
  RayCastScene scene(120, 100);
  scene.Renderer->SetViewport(0.2, 0.2, 0.9, 1);
  const double background[3] = { 0.2, 0.6, 0.4 };
  scene.Renderer->SetBackground(background[0], background[1], background[2]);
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(scene.Window);
  grab->Update();
  const int* size = scene.Mapper->GetOutputImage()->GetDimensions();
  ASSERT_EQ(size[0], 84);
  ASSERT_EQ(size[1], 80);
  double largest = 0;
  for (int j = 0; j < 80; ++j)
  {
    for (int i = 0; i < 84; ++i)
    {
      const float* rgba = scene.GetColors() + 4 * (84 * j + i);
      for (int c = 0; c < 3; ++c)
      {
        const double expected = rgba[c] + (1 - rgba[3]) * std::round(background[c] * 255) / 255;
        const double shown = grab->GetOutput()->GetScalarComponentAsDouble(24 + i, 20 + j, 0, c);
        largest = std::max(largest, std::abs(shown - 255 * expected));
      }
    }
  }
  // Half a step each by rounding what is blended and the result, and as much by blending in 8 bits.
  EXPECT_LE(largest, 1.5);
}

TEST(RayCastMapperBehavior, LeavesOpenGLAsItWas)
{
  RayCastScene scene;
  scene.Window->Render(); // makes the context
  const auto getState = []()
  {
    std::vector<GLint> state;
    for (const GLenum name :
      { GL_BLEND, GL_DEPTH_TEST, GL_SCISSOR_TEST, GL_CULL_FACE, GL_DEPTH_WRITEMASK,
        GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_BLEND_SRC_ALPHA, GL_BLEND_DST_ALPHA, GL_VIEWPORT,
        GL_DRAW_FRAMEBUFFER_BINDING, GL_READ_FRAMEBUFFER_BINDING, GL_TEXTURE_BINDING_2D })
    {
      GLint values[4] = { 0, 0, 0, 0 };
      glGetIntegerv(name, values);
      state.insert(state.end(), values, values + 4);
    }
    return state;
  };
  std::vector<GLint> before;
  std::vector<GLint> after;
  const Observer start(scene.Mapper, vtkCommand::VolumeMapperRenderStartEvent,
    [&](const char*) { before = getState(); });
  const Observer end(
    scene.Mapper, vtkCommand::VolumeMapperRenderEndEvent, [&](const char*) { after = getState(); });
  scene.Renderer->PreserveDepthBufferOn(); // so that depths are read
  scene.Window->Render();
  ASSERT_FALSE(before.empty());
  EXPECT_EQ(before, after);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

// Pictures made of tiles, as vtkWindowToImageFilter does for prints.
TEST(RayCastMapperBehavior, TilesMakeOnePicture)
{
  RayCastScene scene(60, 50);
  scene.Renderer->SetBackground(0.2, 0.3, 0.4);
  vtkNew<vtkWindowToImageFilter> tiles;
  tiles->SetInput(scene.Window);
  tiles->SetScale(2);
  tiles->Update();
  scene.Window->SetSize(120, 100);
  vtkNew<vtkWindowToImageFilter> whole;
  whole->SetInput(scene.Window);
  whole->Update();
  ASSERT_EQ(tiles->GetOutput()->GetNumberOfPoints(), whole->GetOutput()->GetNumberOfPoints());
  const auto* a = static_cast<const unsigned char*>(tiles->GetOutput()->GetScalarPointer());
  const auto* b = static_cast<const unsigned char*>(whole->GetOutput()->GetScalarPointer());
  int largest = 0;
  for (vtkIdType i = 0; i < 3 * whole->GetOutput()->GetNumberOfPoints(); ++i)
  {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  EXPECT_LE(largest, 1);
}

TEST(RayCastMapperBehavior, SampleDistance)
{
  RayCastScene scene(80, 60);
  scene.Mapper->SetImageSampleDistance(2);
  scene.Window->Render();
  const int* size = scene.Mapper->GetOutputImage()->GetDimensions();
  EXPECT_EQ(size[0], 40);
  EXPECT_EQ(size[1], 30);
  // As the picture of a window of that size.
  const std::vector<float> coarse = CopyColors(scene);
  scene.Mapper->SetImageSampleDistance(1);
  scene.Window->SetSize(40, 30);
  scene.Window->Render();
  const std::vector<float> small = CopyColors(scene);
  ASSERT_EQ(coarse.size(), small.size());
  for (std::size_t i = 0; i < small.size(); ++i)
  {
    ASSERT_NEAR(coarse[i], small[i], 1e-6);
  }
}

TEST(RayCastMapperBehavior, AdjustsSampleDistanceToTheUpdateRate)
{
  RayCastScene scene(80, 60);
  scene.Mapper->AutoAdjustSampleDistancesOn();
  scene.Mapper->SetMaximumImageSampleDistance(5);
  for (int frame = 0; frame < 2; ++frame)
  {
    scene.Window->Render();
    EXPECT_EQ(GetStatistic(scene.Mapper, "sample_distance"), "1.0");
  }
  scene.Window->SetDesiredUpdateRate(1e9);
  scene.Window->Render();
  EXPECT_EQ(GetStatistic(scene.Mapper, "sample_distance"), "5.0");
  EXPECT_EQ(scene.Mapper->GetOutputImage()->GetDimensions()[0], 16);
  scene.Window->SetDesiredUpdateRate(1e-4);
  scene.Window->Render();
  EXPECT_EQ(GetStatistic(scene.Mapper, "sample_distance"), "1.0");
}

TEST(RayCastMapperBehavior, AbortedFramesAreNotDrawn)
{
  RayCastScene scene;
  scene.Renderer->SetBackground(0, 0, 1);
  int events = 0;
  const Observer progress(scene.Mapper, vtkCommand::VolumeMapperRenderProgressEvent,
    [&](const char*)
    {
      ++events;
      scene.Window->SetAbortRender(1);
    });
  scene.Mapper->SetNumberOfThreads(1); // which reports every tile
  scene.Window->Render();
  EXPECT_EQ(events, 1);
  EXPECT_EQ(GetStatistic(scene.Mapper, "aborted"), "true");

  // Nothing but the background.
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(scene.Window);
  grab->ShouldRerenderOff();
  grab->ReadFrontBufferOff();
  grab->Update();
  for (int c = 0; c < 3; ++c)
  {
    double range[2];
    grab->GetOutput()->GetPointData()->GetScalars()->GetRange(range, c);
    EXPECT_EQ(range[0], c == 2 ? 255 : 0);
    EXPECT_EQ(range[1], c == 2 ? 255 : 0);
  }
}

TEST(RayCastMapperBehavior, AbortedWhileTheMeshIsBuilt)
{
  RayCastScene scene;
  const vtkSmartPointer<vtkImageData> image = MakeImage();
  scene.Mapper->SetInputData(image);
  int events = 0;
  int casts = 0;
  const Observer progress(scene.Mapper, vtkCommand::ProgressEvent,
    [&](const char*)
    {
      // The pipeline's own update reports twice.
      if (++events == 3)
      {
        scene.Window->SetAbortRender(1);
      }
    });
  const Observer casting(
    scene.Mapper, vtkCommand::VolumeMapperRenderProgressEvent, [&](const char*) { ++casts; });
  scene.Mapper->SetNumberOfThreads(1); // which reports every tile
  scene.Window->Render();
  EXPECT_EQ(events, 3);
  EXPECT_EQ(casts, 0);
  EXPECT_EQ(scene.Mapper->GetOutputImage()->GetNumberOfPoints(), 0);

  // The next frame is complete.
  scene.Window->Render();
  EXPECT_GT(casts, 0);
  EXPECT_EQ(GetStatistic(scene.Mapper, "tetrahedra"), "120");
  EXPECT_EQ(GetStatistic(scene.Mapper, "aborted"), "false");
}

TEST(RayCastMapperBehavior, ReportsProgress)
{
  RayCastScene scene;
  std::vector<double> fractions;
  const Observer progress(scene.Mapper, vtkCommand::VolumeMapperRenderProgressEvent,
    [&](const char* data)
    {
      double fraction;
      std::memcpy(&fraction, data, sizeof(fraction));
      fractions.push_back(fraction);
    });
  scene.Mapper->SetNumberOfThreads(1);
  scene.Window->Render();
  ASSERT_GT(fractions.size(), 1u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_DOUBLE_EQ(fractions.back(), 1);
}

TEST(RayCastMapperBehavior, ReportsAnErrorOnce)
{
  RayCastScene scene;
  Messages errors(scene.Mapper, vtkCommand::ErrorEvent);
  scene.Mapper->SetScalarModeToUsePointFieldData();
  scene.Mapper->SelectScalarArray("Pressure");
  scene.Window->Render();
  scene.Window->Render();
  ASSERT_EQ(errors.Texts.size(), 1u);
  EXPECT_NE(errors.Texts[0].find("Pressure"), std::string::npos) << errors.Texts[0];
  EXPECT_NE(errors.Texts[0].find("Field"), std::string::npos) << errors.Texts[0];
  EXPECT_EQ(scene.Mapper->GetOutputImage()->GetNumberOfPoints(), 0);
  EXPECT_EQ(scene.Mapper->GetStatistics(), "{}");

  scene.Mapper->SelectScalarArray("Field");
  scene.ExpectReference();
  EXPECT_EQ(errors.Texts.size(), 1u);
}

TEST(RayCastMapperBehavior, RefusesWhatCannotBeDrawn)
{
  const auto expectError =
    [](const std::string& text, const std::function<void(RayCastScene&)>& spoil)
  {
    RayCastScene scene;
    spoil(scene);
    Messages errors(scene.Mapper, vtkCommand::ErrorEvent);
    scene.Window->Render();
    ASSERT_EQ(errors.Texts.size(), 1u) << text;
    EXPECT_NE(errors.Texts[0].find(text), std::string::npos) << errors.Texts[0];
  };
  expectError("ScalarOpacityUnitDistance is 0",
    [](RayCastScene& scene) { scene.Volume->GetProperty()->SetScalarOpacityUnitDistance(0); });
  expectError(
    "matrix has no inverse", [](RayCastScene& scene) { scene.Volume->SetScale(1, 0, 1); });
  expectError("has no IsoSurfaceValues",
    [](RayCastScene& scene)
    {
      scene.Mapper->SetBlendModeToIsoSurface();
      scene.Volume->GetProperty()->GetIsoSurfaceValues()->SetNumberOfContours(0);
    });
  expectError(
    "point arrays: none", [](RayCastScene& scene) { scene.Grid->GetPointData()->Initialize(); });
}

// At once during an interaction, right when there is time; and only then.
TEST(RayCastMapperBehavior, TablesAreCoarseDuringInteraction)
{
  RayCastScene scene;
  scene.Mapper->SetIntegrationToTable();
  scene.Mapper->SetMaximumError(1e-2);
  scene.Mapper->AutoAdjustSampleDistancesOff();
  scene.Window->SetDesiredUpdateRate(30);
  scene.Window->Render();
  EXPECT_EQ(GetStatistic(scene.Mapper, "table_is_coarse"), "true");
  const double coarse = scene.Mapper->GetErrorEstimate();
  scene.Window->SetDesiredUpdateRate(1e-4);
  scene.Window->Render();
  EXPECT_EQ(GetStatistic(scene.Mapper, "table_is_coarse"), "false");
  EXPECT_LT(scene.Mapper->GetErrorEstimate(), coarse);

  // What is right stays during the next interaction, until the function changes.
  scene.Window->SetDesiredUpdateRate(30);
  scene.Window->Render();
  EXPECT_EQ(GetStatistic(scene.Mapper, "table_is_coarse"), "false");
  scene.Opacity->AddPoint(0.05, 0.9);
  scene.Window->Render();
  EXPECT_EQ(GetStatistic(scene.Mapper, "table_is_coarse"), "true");
}

TEST(RayCastMapperBehavior, TablesHaveTheSizesThatAreSet)
{
  RayCastScene scene;
  scene.Mapper->SetIntegrationToTable();
  scene.Mapper->SetTableScalarSize(48);
  scene.Mapper->SetTableLengthSize(24);
  scene.Mapper->SetTableLengthScale(vtkTetrahedraRayCastMapper::LOGARITHMIC_SCALE);
  scene.Mapper->SetTableScalarAxis(vtkTetrahedraRayCastMapper::UNIFORM_AXIS);
  scene.Mapper->SetTableFormat(vtkTetrahedraRayCastMapper::UNORM16_FORMAT);
  scene.Window->Render();
  EXPECT_EQ(GetStatistic(scene.Mapper, "table_scalar_size"), "48");
  EXPECT_EQ(GetStatistic(scene.Mapper, "table_length_size"), "24");
  EXPECT_EQ(GetStatistic(scene.Mapper, "table_length_scale"), "\"logarithmic\"");
  EXPECT_EQ(GetStatistic(scene.Mapper, "table_scalar_axis"), "\"uniform\"");
  EXPECT_EQ(GetStatistic(scene.Mapper, "table_format"), "\"16-bit\"");
  EXPECT_EQ(GetStatistic(scene.Mapper, "table_bytes"), std::to_string(8 * 48 * 48 * 24));

  scene.Mapper->SetTableScalarSize(1024);
  scene.Mapper->SetTableMaximumBytes(1 << 20);
  Messages errors(scene.Mapper, vtkCommand::ErrorEvent);
  scene.Window->Render();
  ASSERT_EQ(errors.Texts.size(), 1u);
  EXPECT_NE(errors.Texts[0].find("TableMaximumBytes"), std::string::npos) << errors.Texts[0];
}

TEST(RayCastMapperBehavior, WarnsOfWhatIsLeftOut)
{
  RayCastScene scene;
  Messages warnings(scene.Mapper, vtkCommand::WarningEvent);
  const vtkIdType ids[12] = { 0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3 };
  scene.Grid->InsertNextCell(VTK_LAGRANGE_HEXAHEDRON, 12, ids);
  const vtkIdType missing[4] = { 0, 1, 2, scene.Grid->GetNumberOfPoints() };
  scene.Grid->InsertNextCell(VTK_TETRA, 4, missing);
  const vtkIdType repeated[4] = { 0, 1, 1, 2 };
  scene.Grid->InsertNextCell(VTK_TETRA, 4, repeated);
  scene.Volume->GetProperty()->ShadeOn();
  scene.Mapper->SetBlendModeToMaximumIntensity();
  scene.Window->Render();
  scene.Window->Render();
  ASSERT_EQ(warnings.Texts.size(), 2u);
  EXPECT_NE(
    warnings.Texts[0].find("1 vtkLagrangeHexahedron; cells with missing or unusable points: "
                           "1; tetrahedra with a repeated point: 1"),
    std::string::npos)
    << warnings.Texts[0];
  EXPECT_NE(warnings.Texts[1].find("Shade"), std::string::npos) << warnings.Texts[1];
  EXPECT_EQ(scene.Mapper->GetNumberOfSkippedCells(), 1);
}

TEST(RayCastMapperBehavior, EmptyGridsAreBlankAndSaidToBe)
{
  RayCastScene scene;
  vtkNew<vtkUnstructuredGrid> empty;
  scene.Mapper->SetInputData(empty);
  Messages warnings(scene.Mapper, vtkCommand::WarningEvent);
  Messages errors(scene.Mapper, vtkCommand::ErrorEvent);
  // VTK itself does not draw a volume without bounds.
  scene.Mapper->Render(scene.Renderer, scene.Volume);
  EXPECT_EQ(warnings.Texts.size(), 1u);
  EXPECT_EQ(errors.Texts.size(), 0u);
  const std::vector<float> colors = CopyColors(scene);
  ASSERT_FALSE(colors.empty());
  EXPECT_TRUE(std::all_of(colors.begin(), colors.end(), [](float value) { return value == 0; }));
}

TEST(RayCastMapperBehavior, ScalarsThatAreNoNumbersLeaveCellsEmpty)
{
  RayCastScene scene;
  auto* field = vtkDoubleArray::SafeDownCast(scene.Grid->GetPointData()->GetScalars());
  field->SetValue(30, std::numeric_limits<double>::quiet_NaN());
  scene.Scalars[30] = std::numeric_limits<double>::quiet_NaN();
  scene.ExpectReference();
  const vtkIdType touching = std::count(scene.Mesh.Cells.begin(), scene.Mesh.Cells.end(), 30);
  EXPECT_GT(touching, 0);
  EXPECT_EQ(scene.Mapper->GetNumberOfBlankCells(), touching);
}

TEST(RayCastMapperBehavior, Composites)
{
  RayCastScene scene;
  vtkNew<vtkUnstructuredGrid> moved;
  moved->DeepCopy(scene.Grid);
  for (vtkIdType p = 0; p < moved->GetNumberOfPoints(); ++p)
  {
    double x[3];
    moved->GetPoint(p, x);
    moved->GetPoints()->SetPoint(p, x[0] + 1.5, x[1], x[2]);
  }
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, scene.Grid);
  blocks->SetBlock(2, moved);
  scene.Mapper->SetInputData(blocks);
  const double* bounds = scene.Mapper->GetBounds();
  EXPECT_EQ(bounds[0], 0);
  EXPECT_EQ(bounds[1], 2.5);
  EXPECT_EQ(scene.Mapper->GetInput(), nullptr);

  const std::size_t points = scene.Mesh.GetNumberOfPoints();
  const std::size_t ids = scene.Mesh.Cells.size();
  for (std::size_t p = 0; p < points; ++p)
  {
    for (int c = 0; c < 3; ++c)
    {
      scene.Mesh.Points.push_back(scene.Mesh.Points[3 * p + c] + (c == 0 ? 1.5 : 0));
    }
    scene.Scalars.push_back(scene.Scalars[p]);
  }
  for (std::size_t i = 0; i < ids; ++i)
  {
    scene.Mesh.Cells.push_back(scene.Mesh.Cells[i] + static_cast<std::int32_t>(points));
  }
  scene.ExpectReference();
}

TEST(RayCastMapperBehavior, ImageData)
{
  RayCastScene scene;
  const vtkSmartPointer<vtkImageData> image = MakeImage();
  scene.Mapper->SetInputData(image);
  scene.Window->Render();
  EXPECT_EQ(GetStatistic(scene.Mapper, "tetrahedra"), std::to_string(5 * 4 * 3 * 2));
  const std::vector<float> colors = CopyColors(scene);
  EXPECT_GT(*std::max_element(colors.begin(), colors.end()), 0.5);
}

// One volume in two windows, one of which goes away and another comes.
TEST(RayCastMapperBehavior, SeveralWindows)
{
  RayCastScene scene;
  scene.Window->Render();
  const std::vector<float> first = CopyColors(scene);
  const auto renderElsewhere = [&]()
  {
    vtkNew<vtkRenderer> renderer;
    renderer->AddVolume(scene.Volume);
    renderer->SetActiveCamera(scene.Renderer->GetActiveCamera());
    vtkNew<vtkHeadlessRenderWindow> window;
    window->SetMultiSamples(0);
    window->SetSize(96, 72);
    window->AddRenderer(renderer);
    window->Render();
    EXPECT_EQ(CopyColors(scene), first);
    vtkNew<vtkWindowToImageFilter> grab;
    grab->SetInput(window);
    grab->Update();
    double range[2];
    grab->GetOutput()->GetPointData()->GetScalars()->GetRange(range, 0);
    EXPECT_GT(range[1], 100);
  };
  renderElsewhere();
  scene.Window->Render();
  EXPECT_EQ(CopyColors(scene), first);
  renderElsewhere();
  scene.Window->Finalize();
  renderElsewhere();
  scene.Window->Render();
  EXPECT_EQ(CopyColors(scene), first);
}

// A plane behind the volume is found through it.
TEST(RayCastMapperBehavior, DoesNotDisturbSelection)
{
  RayCastScene scene;
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-2, -2, -1);
  plane->SetPoint1(3, -2, -1);
  plane->SetPoint2(-2, 3, -1);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  scene.Renderer->AddActor(actor);
  scene.Window->Render();
  const std::vector<float> before = CopyColors(scene);
  EXPECT_GT(before[4 * (36 * 96 + 48) + 3], 0.1); // there is volume in the middle

  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.Renderer);
  selector->SetArea(47, 35, 49, 37);
  const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  ASSERT_EQ(selection->GetNumberOfNodes(), 1u);
  EXPECT_EQ(selection->GetNode(0)->GetProperties()->Get(vtkSelectionNode::PROP()), actor.Get());
  EXPECT_EQ(CopyColors(scene), before);
}

// Properties are looked at in TestMapperProperties.
TEST(RayCastMapperBehavior, PrintsWhatTheLastFrameFound)
{
  RayCastScene scene;
  scene.Window->Render();
  std::ostringstream text;
  scene.Mapper->Print(text);
  std::ostringstream estimate;
  estimate << "  ErrorEstimate: " << scene.Mapper->GetErrorEstimate() << "\n";
  EXPECT_GT(scene.Mapper->GetErrorEstimate(), 0);
  EXPECT_NE(text.str().find(estimate.str()), std::string::npos) << text.str();
  EXPECT_NE(
    text.str().find("  Statistics:\n    {\n      \"method\": \"ray-cast\""), std::string::npos)
    << text.str();
}

} // namespace
