// SPDX-License-Identifier: BSD-3-Clause
// Frames in which nothing changed composite the picture of the frame before; whatever the picture
// follows from makes it anew.
#include "AnyMapperScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkContourValues.h"
#include "vtkFloatArray.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPointData.h"
#include "vtkPolyDataMapper.h"
#include "vtkSphereSource.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraVolumeMapper.h"
#include "vtkTriangleCasterMapper.h"

#include <functional>
#include <utility>
#include <vector>

namespace
{

// A lit volume with opaque geometry before a part of it.
class StillScene : public AnyMapperScene
{
public:
  explicit StillScene(const std::string& mapperClass)
    : AnyMapperScene(MakeMapper(mapperClass))
  {
    this->Volume->GetProperty()->ShadeOn();
    vtkNew<vtkSphereSource> source;
    source->SetRadius(0.8);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    this->Sphere->SetMapper(mapper);
    this->Sphere->SetPosition(2, 2, 3);
    this->Renderer->AddActor(this->Sphere);
  }

  vtkImageData* GetInput()
  {
    return vtkImageData::SafeDownCast(this->GetMapper()->GetDataObjectInput());
  }

  vtkNew<vtkActor> Sphere;
};

using Change = std::pair<const char*, std::function<void(StillScene&)>>;

void SetIntermixing(vtkAbstractVolumeMapper* mapper, bool on)
{
  if (auto* ofCells = vtkTetrahedraVolumeMapper::SafeDownCast(mapper))
  {
    ofCells->SetIntermixIntersectingGeometry(on);
  }
  else
  {
    vtkTriangleCasterMapper::SafeDownCast(mapper)->SetIntermixIntersectingGeometry(on);
  }
}

// Each changes the picture.
const std::vector<Change>& GetChanges()
{
  static const std::vector<Change> changes = {
    { "camera", [](StillScene& scene) { scene.Renderer->GetActiveCamera()->Azimuth(3); } },
    { "clipping range",
      [](StillScene& scene)
      {
        const double* range = scene.Renderer->GetActiveCamera()->GetClippingRange();
        scene.Renderer->GetActiveCamera()->SetClippingRange(0.5 * (range[0] + range[1]), range[1]);
      } },
    { "clipping range as it was",
      [](StillScene& scene) { scene.Renderer->ResetCameraClippingRange(); } },
    { "light",
      [](StillScene& scene)
      {
        auto* light = vtkLight::SafeDownCast(scene.Renderer->GetLights()->GetItemAsObject(0));
        light->SetIntensity(0.5 * light->GetIntensity());
      } },
    { "material", [](StillScene& scene) { scene.Volume->GetProperty()->SetAmbient(0.4); } },
    { "clipping plane",
      [](StillScene& scene)
      {
        vtkNew<vtkPlane> plane;
        plane->SetNormal(1, 0, 0);
        plane->SetOrigin(1.5, 0, 0);
        scene.GetMapper()->AddClippingPlane(plane);
      } },
    { "clipping plane in place",
      [](StillScene& scene)
      { scene.GetMapper()->GetClippingPlanes()->GetItem(0)->SetOrigin(0.7, 0, 0); } },
    { "colours", [](StillScene& scene) { scene.Color->AddRGBPoint(0.2, 1, 1, 0); } },
    { "opacities", [](StillScene& scene) { scene.Opacity->AddPoint(0.2, 0.9); } },
    { "surface",
      [](StillScene& scene)
      {
        scene.Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, 0.1);
        scene.Opacity->AddPoint(0.1, 0.2);
      } },
    { "property",
      [](StillScene& scene)
      {
        vtkNew<vtkVolumeProperty> property;
        property->DeepCopy(scene.Volume->GetProperty());
        property->GetRGBTransferFunction()->AddRGBPoint(0.1, 1, 0, 1);
        property->GetIsoSurfaceValues()->SetValue(0, 0.1);
        scene.Volume->SetProperty(property);
      } },
    { "values",
      [](StillScene& scene)
      {
        auto* values = vtkFloatArray::SafeDownCast(scene.GetInput()->GetPointData()->GetScalars());
        for (vtkIdType id = 0; id < values->GetNumberOfTuples(); ++id)
        {
          values->SetValue(id, 0.8f * values->GetValue(id));
        }
        values->Modified();
      } },
    { "spacing", [](StillScene& scene) { scene.GetInput()->SetSpacing(1.2, 1, 1); } },
    { "input", [](StillScene& scene) { scene.GetMapper()->SetInputDataObject(MakeField()); } },
    { "matrix", [](StillScene& scene) { scene.Volume->SetPosition(0.4, 0, 0); } },
    { "viewport", [](StillScene& scene) { scene.Renderer->SetViewport(0, 0, 0.9, 1); } },
    { "window", [](StillScene& scene) { scene.Window->SetSize(40, 30); } },
    { "opaque geometry", [](StillScene& scene) { scene.Sphere->AddPosition(0.5, 0, 0); } },
    { "no opaque geometry", [](StillScene& scene) { scene.Sphere->VisibilityOff(); } },
    { "opaque geometry again", [](StillScene& scene) { scene.Sphere->VisibilityOn(); } },
    { "property of the mapper",
      [](StillScene& scene) { SetIntermixing(scene.GetMapper(), false); } },
  };
  return changes;
}

} // namespace

class KeptPictures : public AnyMapper
{
};

INSTANTIATE_TEST_SUITE_P(
  Mappers, KeptPictures, testing::ValuesIn(GetMapperClasses()), NameAnyMapperTest);

TEST_P(KeptPictures, OfAnUnchangedScene)
{
  StillScene scene(this->GetParam());
  const std::vector<float> picture = scene.Render();
  const std::vector<int> window = scene.Grab();
  ASSERT_FALSE(picture.empty());
  EXPECT_EQ(scene.Get("kept"), "false");
  const std::string rays = scene.Get("width");
  const double seconds = scene.GetMapper()->GetTimeToDraw();
  EXPECT_GT(seconds, 0);
  for (int frame = 0; frame < 2; ++frame)
  {
    EXPECT_EQ(scene.Render(), picture);
    EXPECT_EQ(scene.Grab(), window);
    EXPECT_EQ(scene.Get("kept"), "true");
    EXPECT_EQ(scene.Get("width"), rays);
    // By which VTK tells what another picture costs.
    EXPECT_EQ(scene.GetMapper()->GetTimeToDraw(), seconds);
  }
  // None of these is in the picture.
  scene.Renderer->SetBackground(0.2, 0.3, 0.4);
  scene.Renderer->GetActiveCamera()->Modified();
  EXPECT_EQ(scene.Render(), picture);
  EXPECT_NE(scene.Grab(), window);
  EXPECT_EQ(scene.Get("kept"), "true");
}

TEST_P(KeptPictures, UnlessWhatTheyFollowFromChanges)
{
  StillScene scene(this->GetParam());
  std::vector<float> before = scene.Render();
  for (const auto& [name, change] : GetChanges())
  {
    SCOPED_TRACE(name);
    change(scene);
    const std::vector<float> picture = scene.Render();
    EXPECT_EQ(scene.Get("kept"), "false");
    EXPECT_NE(picture, before);
    const std::vector<int> window = scene.Grab();
    scene.Render();
    EXPECT_EQ(scene.Get("kept"), "true");
    EXPECT_EQ(scene.Grab(), window);
    scene.GetMapper()->Modified();
    EXPECT_EQ(scene.Render(), picture);
    EXPECT_EQ(scene.Get("kept"), "false");
    before = picture;
  }
}

TEST_P(KeptPictures, ButNotOfFailedOrAbortedFrames)
{
  StillScene scene(this->GetParam());
  const std::vector<float> picture = scene.Render();
  const double scale = scene.Volume->GetScale()[0];
  scene.GetMapper()->SetGlobalWarningDisplay(0);
  scene.Volume->SetScale(0.); // there are no rays through that
  EXPECT_TRUE(scene.Render().empty());
  scene.GetMapper()->SetGlobalWarningDisplay(1);
  scene.Volume->SetScale(scale);
  EXPECT_EQ(scene.Render(), picture);
  scene.Window->Finalize();
  EXPECT_TRUE(GetPicture(scene.GetMapper()).empty());
  EXPECT_EQ(scene.Render(), picture);
  EXPECT_EQ(scene.Get("kept"), "false");
}

// What frames refine is kept once it is done.
TEST(KeptPicturesOfLight, OnceTheyAreRefined)
{
  const auto mapper = vtkSmartPointer<vtkTetrahedraIsosurfaceMapper>::New();
  mapper->AmbientOcclusionOn();
  mapper->SetSamplesPerFrame(4);
  mapper->SetMaximumSamples(8);
  AnyMapperScene scene(mapper);
  scene.Volume->GetProperty()->ShadeOn();
  const std::vector<float> first = scene.Render();
  EXPECT_EQ(scene.Get("kept"), "false");
  const std::vector<float> second = scene.Render();
  EXPECT_EQ(scene.Get("kept"), "false");
  EXPECT_NE(second, first);
  EXPECT_EQ(scene.Render(), second);
  EXPECT_EQ(scene.Get("kept"), "true");
}
