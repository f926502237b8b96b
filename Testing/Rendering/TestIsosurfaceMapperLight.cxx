// SPDX-License-Identifier: BSD-3-Clause
// What blocks light of traced isosurfaces: shadows, ambient occlusion, and how
// pictures are refined.
#include "IsosurfaceScene.h"
#include "Statistics.h"

#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkPlane.h"

#include <string>
#include <vector>

namespace
{

TEST(IsosurfaceMapperLight, ShadowsDarken)
{
  IsosurfaceScene scene;
  scene.SetLight({ -3, 4, 1 });
  const std::vector<float> lit = scene.Render();
  EXPECT_NE(scene.Tracer->GetStatistics().find("\"shadows\": \"they are off\""), std::string::npos);
  scene.Tracer->ShadowsOn();
  const std::vector<float> dark = scene.Render();
  EXPECT_EQ(scene.Tracer->GetStatistics().find("they are off"), std::string::npos);
  EXPECT_LE(FindLargestExcess(dark, lit), 0);
  EXPECT_GT(FindLargestExcess(lit, dark), 0.2);
  // A light that is off casts none, and VTK makes no other one.
  scene.Renderer->AutomaticLightCreationOff();
  scene.Renderer->GetLights()->InitTraversal();
  scene.Renderer->GetLights()->GetNextItem()->SwitchOff();
  const std::vector<float> unlit = scene.Render();
  scene.Tracer->ShadowsOff();
  EXPECT_EQ(scene.Render(), unlit);
  // Without Shade there is no light to block.
  scene.Volume->GetProperty()->ShadeOff();
  const std::vector<float> flat = scene.Render();
  scene.Tracer->ShadowsOn();
  EXPECT_EQ(scene.Render(), flat);
}

TEST(IsosurfaceMapperLight, LightAtTheCameraCastsNoShadows)
{
  for (const bool parallel : { false, true })
  {
    IsosurfaceScene scene;
    vtkNew<vtkLight> light;
    light->SetLightTypeToHeadlight();
    light->SetPositional(!parallel);
    light->SetConeAngle(90);
    scene.Renderer->AddLight(light);
    scene.Volume->GetProperty()->ShadeOn();
    scene.SetSurfaces({ { -0.4, 1 }, { 0.3, 1 } });
    scene.Renderer->GetActiveCamera()->SetParallelProjection(parallel);
    const std::vector<float> lit = scene.Render();
    scene.Tracer->ShadowsOn();
    EXPECT_EQ(scene.Render(), lit) << parallel;
    EXPECT_GT(Sum(lit), 1000) << parallel;
  }
}

TEST(IsosurfaceMapperLight, RestingPicturesAreRefined)
{
  const auto turnOn = [](IsosurfaceScene& scene, bool occlusion)
  {
    scene.SetLight({ -3, 4, 1 });
    scene.Tracer->SetMaximumSamples(16);
    scene.Tracer->SetAmbientOcclusion(occlusion);
    scene.Tracer->SetAmbientOcclusionRadius(0.5);
    scene.Tracer->SetShadows(!occlusion);
    scene.Tracer->SetShadowSoftness(occlusion ? 0 : 30);
  };
  for (const bool occlusion : { true, false })
  {
    SCOPED_TRACE(occlusion ? "ambient occlusion" : "soft shadows");
    IsosurfaceScene scene;
    scene.SetLight({ -3, 4, 1 });
    const std::vector<float> lit = scene.Render();
    EXPECT_EQ(scene.Get("rays", "light_samples"), "0");
    turnOn(scene, occlusion);
    std::vector<std::vector<float>> pictures;
    for (const int samples : { 4, 8, 12, 16, 16, 16 })
    {
      pictures.push_back(scene.Render());
      EXPECT_EQ(scene.Get("rays", "light_samples"), std::to_string(samples));
      EXPECT_LE(FindLargestExcess(pictures.back(), lit), Rounding);
      const bool isComplete = pictures.size() > 4;
      EXPECT_EQ(GetStatistic(scene.Tracer, "kept"), isComplete ? "true" : "false");
    }
    EXPECT_GT(FindLargestExcess(lit, pictures[0]), 0.1);
    EXPECT_NE(pictures[0], pictures[1]);
    EXPECT_NE(pictures[2], pictures[3]);
    EXPECT_EQ(pictures[3], pictures[4]);
    EXPECT_EQ(pictures[3], pictures[5]);

    // The same again, by another mapper.
    IsosurfaceScene other;
    turnOn(other, occlusion);
    for (int frame = 0; frame < 4; ++frame)
    {
      EXPECT_EQ(other.Render(), pictures[frame]) << frame;
    }

    // The first samples of a view that is new, and of the old one.
    vtkCamera* camera = scene.Renderer->GetActiveCamera();
    const Vector position = { camera->GetPosition()[0], camera->GetPosition()[1],
      camera->GetPosition()[2] };
    camera->SetPosition(position[0] + 0.1, position[1], position[2]);
    EXPECT_NE(scene.Render(), pictures[0]);
    EXPECT_EQ(scene.Get("rays", "light_samples"), "4");
    camera->SetPosition(position.data());
    EXPECT_EQ(scene.Render(), pictures[0]);
    EXPECT_EQ(scene.Render(), pictures[1]);
    // Whatever the picture follows from starts anew.
    scene.Volume->GetProperty()->SetAmbient(0.3);
    scene.Render();
    EXPECT_EQ(scene.Get("rays", "light_samples"), "4");
    scene.Tracer->SetSamplesPerFrame(16);
    scene.Render();
    EXPECT_EQ(scene.Get("rays", "light_samples"), "16");
  }
}

// A change of anything that the light follows from gives the picture of a fresh mapper.
TEST(IsosurfaceMapperLight, ChangesStartAnew)
{
  IsosurfaceScene scene;
  scene.SetLight({ -3, 4, 1 });
  scene.Tracer->ShadowsOn();
  scene.Tracer->SetShadowSoftness(20);
  scene.Tracer->AmbientOcclusionOn();
  const auto expectAnew = [&scene](const char* what)
  {
    vtkNew<vtkTetrahedraIsosurfaceMapper> fresh;
    fresh->AutoAdjustSampleDistancesOff();
    fresh->ShadowsOn();
    fresh->SetShadowSoftness(scene.Tracer->GetShadowSoftness());
    fresh->AmbientOcclusionOn();
    fresh->SetAmbientOcclusionRadius(scene.Tracer->GetAmbientOcclusionRadius());
    fresh->SetSmoothShading(scene.Tracer->GetSmoothShading());
    fresh->SetClippingPlanes(scene.Tracer->GetClippingPlanes());
    const std::vector<float> picture = scene.Render();
    EXPECT_EQ(scene.Get("rays", "light_samples"), "4") << what;
    scene.Render();
    EXPECT_EQ(scene.Get("rays", "light_samples"), "8") << what;
    scene.Use(fresh);
    EXPECT_EQ(scene.Render(), picture) << what;
    scene.Use(scene.Tracer);
  };
  expectAnew("first frame");
  scene.Renderer->GetLights()->InitTraversal();
  vtkLight* light = scene.Renderer->GetLights()->GetNextItem();
  light->SetPosition(-3, 4, 2);
  expectAnew("place of the light");
  light->SetIntensity(0.7);
  expectAnew("intensity of the light");
  scene.Renderer->SetAmbient(0.2, 0.2, 0.2);
  expectAnew("ambient light");
  scene.Volume->GetProperty()->SetDiffuse(0.5);
  expectAnew("material");
  scene.Color->AddRGBPoint(0.3, 1, 1, 1);
  expectAnew("colours");
  scene.SetSurfaces({ { -0.2, 0.5 }, { 0.3, 1 } });
  expectAnew("values");
  scene.Tracer->SetShadowSoftness(10);
  expectAnew("softness");
  scene.Tracer->SetAmbientOcclusionRadius(0.3);
  expectAnew("radius");
  scene.Tracer->SmoothShadingOff();
  expectAnew("shading");
  scene.Volume->SetScale(1.1, 0.9, 1);
  expectAnew("place of the volume");
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0.5, 0.5, 0.5);
  plane->SetNormal(1, 2, -3);
  scene.Tracer->AddClippingPlane(plane);
  expectAnew("clipping plane");
  scene.AddSphere({ 1, 0.8, 1.3 }, 0.25);
  expectAnew("geometry in front");
  scene.Window->SetSize(90, 80);
  expectAnew("size");
}

TEST(IsosurfaceMapperLight, FartherSurfacesOccludeMore)
{
  IsosurfaceScene scene;
  scene.SetLight({ 2, 3, 4 });
  scene.Tracer->AmbientOcclusionOn();
  scene.Tracer->SetSamplesPerFrame(32);
  double before = 0;
  for (const double radius : { 2., 0.5, 0.1, 1e-6 })
  {
    scene.Tracer->SetAmbientOcclusionRadius(radius);
    const double sum = Sum(scene.Render());
    EXPECT_GT(sum, before) << radius;
    before = sum;
  }
  scene.Tracer->AmbientOcclusionOff();
  EXPECT_NEAR(Sum(scene.Render()), before, 1e-3 * before);
}

} // namespace
