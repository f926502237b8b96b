// SPDX-License-Identifier: BSD-3-Clause
// Several components, masks, labels and hidden cells of the mapper of image data, beside VTK's. The
// caster itself has tests of its own.
#include "ImageScene.h"
#include "Observer.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace
{

/// Distance of slices at which what VTK's mapper counts for the first and the last sample of a ray
/// is no more than the tolerance.
constexpr double Distance = 0.02;

/// Of 255 steps: both pictures are rounded, and tables and textures of VTK's are.
constexpr int Tolerance = 3;

/// Share of channels that may differ by more: pixels at the border between labels, whose samples
/// VTK's mapper takes the label of by a texture with other roundings.
constexpr double BorderShare = 0.01;

/// The scene's image with several components, each a wave of its own between 0 and 255.
vtkSmartPointer<vtkImageData> MakeComponents(int components, int type = VTK_UNSIGNED_CHAR)
{
  vtkSmartPointer<vtkImageData> image = MakeImage();
  const auto values = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  values->SetName("Field");
  values->SetNumberOfComponents(components);
  values->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p)
  {
    const double* x = image->GetPoint(p);
    for (int c = 0; c < components; ++c)
    {
      const double wave =
        std::sin((0.4 + 0.1 * c) * x[0] + c) + std::cos(0.5 * x[1] - 0.3 * c * x[2]);
      values->SetComponent(p, c, std::round(127 + 63 * wave));
    }
  }
  // VTK's mapper looks components up over their ranges.
  for (int c = 0; c < components; ++c)
  {
    values->SetComponent(0, c, 0);
    values->SetComponent(1, c, 255);
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

/// Functions of a component over 0..255, which VTK's mapper takes for the range of its tables.
void SetFunctions(vtkVolumeProperty* property, int component)
{
  const double c = component;
  vtkNew<vtkColorTransferFunction> color;
  color->AddRGBPoint(0, 0.1 + 0.2 * c, 0.9 - 0.2 * c, 0.3);
  color->AddRGBPoint(255, 0.8 - 0.2 * c, 0.2, 0.1 + 0.25 * c);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(0, 0);
  opacity->AddPoint(60 + 20 * c, 0);
  opacity->AddPoint(255, 0.3 - 0.05 * c);
  property->SetColor(component, color);
  property->SetScalarOpacity(component, opacity);
  property->SetScalarOpacityUnitDistance(component, 2 + c);
}

struct ComponentCase
{
  const char* Name;
  std::function<void(ImageScene&)> SetUp;
  double Share; ///< of channels that may differ by more than the tolerance
};

void PrintTo(const ComponentCase& scene, std::ostream* os) { *os << scene.Name; }

void SetIndependent(ImageScene& scene, int components)
{
  scene.Mapper->SetInputData(MakeComponents(components));
  for (int c = 0; c < components; ++c)
  {
    SetFunctions(scene.Volume->GetProperty(), c);
    scene.Volume->GetProperty()->SetComponentWeight(c, 1 - 0.2 * c);
  }
}

void SetDependent(ImageScene& scene, int components, int type = VTK_UNSIGNED_CHAR)
{
  scene.Mapper->SetInputData(MakeComponents(components, type));
  SetFunctions(scene.Volume->GetProperty(), 0);
  scene.Volume->GetProperty()->IndependentComponentsOff();
  // Of the one function; VTK's mapper takes that of the last component.
  scene.Volume->GetProperty()->SetScalarOpacityUnitDistance(components - 1, 2);
}

/// Labels 0, 1 and 2 in parts of the scene's image.
vtkSmartPointer<vtkImageData> MakeMask(int type = VTK_UNSIGNED_CHAR)
{
  auto mask = vtkSmartPointer<vtkImageData>::New();
  mask->SetDimensions(ImageSize.data());
  mask->AllocateScalars(type, 1);
  for (vtkIdType p = 0; p < mask->GetNumberOfPoints(); ++p)
  {
    const double* x = mask->GetPoint(p);
    mask->GetPointData()->GetScalars()->SetTuple1(p, x[0] < 5 ? 0 : x[1] < 6 ? 1 : 2);
  }
  return mask;
}

void SetLabels(ImageScene& scene)
{
  vtkVolumeProperty* property = scene.Volume->GetProperty();
  // VTK's mapper takes opacities of labels as they are, however short the distance of samples is.
  property->SetScalarOpacityUnitDistance(Distance);
  scene.Opacity->RemoveAllPoints();
  scene.Opacity->AddPoint(30, 0);
  scene.Opacity->AddPoint(100, 0.006);
  vtkNew<vtkColorTransferFunction> color;
  color->AddRGBPoint(0, 1, 1, 0);
  color->AddRGBPoint(100, 0, 0, 1);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(0, 0.004);
  opacity->AddPoint(100, 0);
  property->SetLabelColor(1, color);
  property->SetLabelScalarOpacity(1, opacity);
  property->SetLabelColor(2, color); // with the opacity of the property
  scene.Mapper->SetMaskInput(MakeMask());
}

const std::vector<ComponentCase> ComponentCases = {
  { "TwoIndependent", [](ImageScene& scene) { SetIndependent(scene, 2); }, 0 },
  { "ThreeIndependent", [](ImageScene& scene) { SetIndependent(scene, 3); }, 0 },
  { "FourIndependent", [](ImageScene& scene) { SetIndependent(scene, 4); }, 0 },
  { "TwoDependent", [](ImageScene& scene) { SetDependent(scene, 2); }, 0 },
  { "FourDependent", [](ImageScene& scene) { SetDependent(scene, 4); }, 0 },
  { "BinaryMask",
    [](ImageScene& scene)
    {
      scene.Mapper->SetMaskInput(MakeMask());
      scene.Mapper->SetMaskTypeToBinary();
    },
    BorderShare },
  { "Labels", SetLabels, BorderShare },
  { "HalfOfLabels",
    [](ImageScene& scene)
    {
      SetLabels(scene);
      scene.Mapper->SetMaskBlendFactor(0.5);
    },
    BorderShare },
};

class Components : public testing::TestWithParam<ComponentCase>
{
};

TEST_P(Components, PictureIsThatOfVTK)
{
  ImageScene scene;
  scene.Mapper->SetSampleDistance(Distance);
  GetParam().SetUp(scene);
  const MessageObserver messages(
    scene.Mapper, { vtkCommand::ErrorEvent, vtkCommand::WarningEvent });
  scene.Window->Render();
  EXPECT_EQ(messages.Text, "");
  EXPECT_EQ(scene.Get("copied_bytes"), "0");
  const std::vector<int> picture = scene.Grab();
  const std::vector<int> expected = GrabOfVTK(scene);
  EXPECT_LE(FindShareAbove(picture, expected, Tolerance), GetParam().Share);
}

INSTANTIATE_TEST_SUITE_P(TriangleCasterMapper, Components, testing::ValuesIn(ComponentCases),
  [](const testing::TestParamInfo<ComponentCase>& info) { return std::string(info.param.Name); });

/// What a scene complains of, in one frame.
std::string RenderMessages(ImageScene& scene, unsigned long event = vtkCommand::ErrorEvent)
{
  const MessageObserver messages(scene.Mapper, { event });
  scene.Mapper->Render(scene.Renderer, scene.Volume);
  return messages.Text;
}

// Of a second component with no weight nothing is seen.
TEST(TriangleCasterMapperComponents, WeightsAreOfComponents)
{
  constexpr double Rounding = 1e-6; // of a channel
  ImageScene scene;
  SetIndependent(scene, 2);
  vtkVolumeProperty* property = scene.Volume->GetProperty();
  const std::vector<float> both = scene.Render();
  property->SetComponentWeight(1, 0);
  const std::vector<float> first = scene.Render();
  EXPECT_GT(FindDifference(first, both), 0.05);
  scene.Mapper->SetVectorModeToComponent();
  EXPECT_LE(FindDifference(scene.Render(), first), Rounding);
  EXPECT_EQ(scene.Get("components"), "1");
}

// Each component has a function of gradients and lights of its own.
TEST(TriangleCasterMapperComponents, ComponentsAreShadedEach)
{
  ImageScene scene;
  SetIndependent(scene, 2);
  vtkVolumeProperty* property = scene.Volume->GetProperty();
  std::vector<float> last = scene.Render();
  const auto expectAnother = [&](const char* name)
  {
    std::vector<float> picture = scene.Render();
    EXPECT_GT(FindDifference(picture, last), 0.01) << name;
    last = std::move(picture);
  };
  property->SetShade(1, 1);
  expectAnother("the second one is shaded");
  property->SetAmbient(1, 0.5);
  expectAnother("by its own material");
  property->SetShade(0, 1);
  expectAnother("the first one is shaded");
  vtkNew<vtkPiecewiseFunction> gradients;
  gradients->AddPoint(0, 0);
  gradients->AddPoint(60, 1);
  property->SetGradientOpacity(1, gradients);
  expectAnother("with gradient opacity");
  gradients->AddPoint(20, 1);
  expectAnother("another one");
}

// Types that are copied, and channels by the range of the type.
TEST(TriangleCasterMapperComponents, TypesOfDependentComponents)
{
  constexpr double Rounding = 1e-4; // of a channel: channels of 0..255 out of 255 or 1
  ImageScene scene;
  SetDependent(scene, 4);
  const std::vector<float> expected = scene.Render();
  const vtkSmartPointer<vtkImageData> image = MakeComponents(4, VTK_DOUBLE);
  vtkDataArray* values = image->GetPointData()->GetScalars();
  for (vtkIdType p = 0; p < image->GetNumberOfPoints(); ++p)
  {
    for (int c = 0; c < 3; ++c)
    {
      values->SetComponent(p, c, values->GetComponent(p, c) / 255);
    }
  }
  scene.Mapper->SetInputData(image);
  EXPECT_LE(FindDifference(scene.Render(), expected), Rounding);
  EXPECT_EQ(
    scene.Get("copied_bytes"), std::to_string(4 * sizeof(float) * image->GetNumberOfPoints()));
}

TEST(TriangleCasterMapperComponents, MasksOfOtherTypes)
{
  ImageScene scene;
  SetLabels(scene);
  const std::vector<float> expected = scene.Render();
  scene.Mapper->SetMaskInput(MakeMask(VTK_INT));
  EXPECT_EQ(scene.Render(), expected);
  scene.Mapper->SetMaskTypeToBinary();
  const std::vector<float> binary = scene.Render();
  EXPECT_GT(FindDifference(binary, expected), 0.05);
  scene.Mapper->SetMaskInput(MakeMask());
  EXPECT_EQ(scene.Render(), binary);
  scene.Mapper->SetMaskInput(nullptr);
  EXPECT_GT(FindDifference(scene.Render(), binary), 0.05);
}

// A change of what a mask or the function of a label says is seen.
TEST(TriangleCasterMapperComponents, LabelsThatChange)
{
  ImageScene scene;
  SetLabels(scene);
  const std::vector<float> before = scene.Render();
  scene.Volume->GetProperty()->GetLabelScalarOpacity(1)->AddPoint(50, 0.02);
  const std::vector<float> after = scene.Render();
  EXPECT_GT(FindDifference(after, before), 0.05);
  vtkImageData* mask = scene.Mapper->GetMaskInput();
  mask->GetPointData()->GetScalars()->Fill(0);
  mask->GetPointData()->GetScalars()->Modified();
  EXPECT_GT(FindDifference(scene.Render(), after), 0.05);
}

// What is hidden is as if it were cropped.
TEST(TriangleCasterMapperComponents, HiddenCellsAndPointsAreEmpty)
{
  constexpr double Step = 0.005; // of a channel: a sample more or less where cells end
  ImageScene scene;
  scene.Mapper->SetSampleDistance(Distance);
  const std::vector<float> whole = scene.Render();
  scene.Mapper->CroppingOn();
  scene.Mapper->SetCroppingRegionPlanes(-1, 7, -1, 100, -1, 100);
  const std::vector<float> expected = scene.Render();
  scene.Mapper->CroppingOff();
  const auto expectHidden = [&](vtkDataSetAttributes* attributes, vtkIdType count, int size,
                              int first, unsigned char flag, const char* name)
  {
    vtkNew<vtkUnsignedCharArray> flags;
    flags->SetName(vtkDataSetAttributes::GhostArrayName());
    for (vtkIdType i = 0; i < count; ++i)
    {
      flags->InsertNextValue(i % size >= first ? flag : 0);
    }
    attributes->AddArray(flags);
    EXPECT_LE(FindDifference(scene.Render(), expected), Step) << name;
    attributes->RemoveArray(vtkDataSetAttributes::GhostArrayName());
    EXPECT_EQ(scene.Render(), whole) << name;
  };
  auto* image = vtkImageData::SafeDownCast(scene.Mapper->GetDataObjectInput());
  expectHidden(image->GetCellData(), image->GetNumberOfCells(), ImageSize[0] - 1, 7,
    vtkDataSetAttributes::HIDDENCELL, "cells");
  expectHidden(image->GetPointData(), image->GetNumberOfPoints(), ImageSize[0], 8,
    vtkDataSetAttributes::HIDDENPOINT, "points");
}

TEST(TriangleCasterMapperComponents, RefuseWhatTheyLack)
{
  using SetUp = std::function<void(ImageScene&)>;
  const SetUp setTwo = [](ImageScene& scene) { SetIndependent(scene, 2); };
  const auto with = [](const SetUp& first, const SetUp& second) -> SetUp
  {
    return [first, second](ImageScene& scene)
    {
      first(scene);
      second(scene);
    };
  };
  const std::vector<std::pair<const char*, SetUp>> cases = {
    { "dependent components are 2 or 4", [](ImageScene& scene) { SetDependent(scene, 3); } },
    { "other blend modes",
      with(setTwo, [](ImageScene& scene) { scene.Mapper->SetBlendModeToMaximumIntensity(); }) },
    { "one component", with(setTwo, [](ImageScene& scene) { scene.Mapper->PreIntegrationOn(); }) },
    { "stored gradients and maps of light need",
      with(setTwo, [](ImageScene& scene) { scene.Mapper->SetGradientSourceToBytes(); }) },
    { "labels are shown of one component", with(setTwo, SetLabels) },
    { "those of the image data are 14 x 11 x 9",
      [](ImageScene& scene)
      {
        SetLabels(scene);
        scene.Mapper->GetMaskInput()->SetDimensions(14, 9, 11);
      } },
    { "scalars of one component",
      [](ImageScene& scene)
      {
        SetLabels(scene);
        scene.Mapper->GetMaskInput()->GetPointData()->Initialize();
      } },
    { "labels are from 0 to 255",
      [](ImageScene& scene)
      {
        SetLabels(scene);
        scene.Mapper->SetMaskInput(MakeMask(VTK_SHORT));
        scene.Mapper->GetMaskInput()->GetPointData()->GetScalars()->SetTuple1(7, 256);
      } },
    { "functions of label 300",
      [](ImageScene& scene)
      {
        SetLabels(scene);
        scene.Volume->GetProperty()->SetLabelScalarOpacity(300, scene.Opacity);
      } },
    { "array of ghosts",
      [](ImageScene& scene)
      {
        vtkNew<vtkUnsignedCharArray> flags;
        flags->SetName(vtkDataSetAttributes::GhostArrayName());
        flags->InsertNextValue(0);
        vtkImageData::SafeDownCast(scene.Mapper->GetDataObjectInput())
          ->GetCellData()
          ->AddArray(flags);
      } },
  };
  for (const auto& [text, setUp] : cases)
  {
    ImageScene scene;
    scene.Window->Render();
    setUp(scene);
    const std::string message = RenderMessages(scene);
    EXPECT_NE(message.find(text), std::string::npos) << text << ": " << message;
    EXPECT_EQ(scene.Mapper->GetOutputImage()->GetNumberOfPoints(), 0) << text;
  }
}

TEST(TriangleCasterMapperComponents, WarnOfWhatIsNotUsed)
{
  ImageScene scene;
  scene.Window->Render();
  SetLabels(scene);
  EXPECT_EQ(RenderMessages(scene, vtkCommand::WarningEvent), "");
  scene.Mapper->SetMaskTypeToBinary();
  EXPECT_NE(
    RenderMessages(scene, vtkCommand::WarningEvent).find("need a MaskInput"), std::string::npos);
  scene.Mapper->SetInputData(MakeComponents(5));
  EXPECT_NE(RenderMessages(scene, vtkCommand::WarningEvent).find("more than 4"), std::string::npos);
}

} // namespace
