// SPDX-License-Identifier: BSD-3-Clause
// Windows with several samples a pixel, beside windows so much larger that their pixels are the
// samples: with opaque geometry before, in and behind the volume.
#include "AnyMapperScene.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCubeSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraVolumeMapper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace
{

constexpr int Samples = 4;

/// The pixels of a window that is this much larger, along each edge, have the samples of software
/// OpenGL in their middles.
constexpr int Enlargement = 4;

constexpr int Width = 80;
constexpr int Height = 60;

/// Steps of 255: what 8 bits round of a sample and of the mean of four, and where the colour bends
/// within a pixel.
constexpr double LargestStep = 4;

/// As large as it was without samples of their own.
constexpr double UnsampledStep = 50;

/// Of 4,800 pixels.
constexpr int MostRounded = 5;

/// A volume with unlit geometry around, of which VTK itself draws the samples.
class SampledScene : public AnyMapperScene
{
public:
  SampledScene(const std::string& mapperClass, int enlargement)
    : AnyMapperScene(MakeMapper(mapperClass), enlargement * Width, enlargement * Height)
  {
    this->Window->SetMultiSamples(enlargement == 1 ? Samples : 0);
    this->Renderer->SetBackground(0.2, 0.3, 0.2);
    this->AddSphere(1.1, 1.3, 3.6, { 1, 1, 1 });
    this->AddSphere(3.7, 2.4, 2.1, { 1, 0.6, 0 });
    this->AddSphere(2.2, 3.1, -1.3, { 0, 1, 1 });
    vtkNew<vtkCubeSource> cube;
    cube->SetXLength(3);
    cube->SetYLength(0.4);
    cube->SetZLength(0.6);
    this->Add(cube, 3.5, 0.9, 2.9, { 1, 0, 1 });
  }

  void Add(
    vtkPolyDataAlgorithm* source, double x, double y, double z, const std::array<double, 3>& color)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->SetPosition(x, y, z);
    actor->RotateZ(20);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetColor(color[0], color[1], color[2]);
    this->Renderer->AddActor(actor);
  }

  void AddSphere(double x, double y, double z, const std::array<double, 3>& color)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetRadius(0.7);
    sphere->SetThetaResolution(31);
    sphere->SetPhiResolution(29);
    this->Add(sphere, x, y, z, color);
  }
};

/// Means of the pixels of a large window that are the samples of a small one.
std::vector<double> Average(const std::vector<int>& large)
{
  // Of software OpenGL.
  constexpr int Places[Samples][2] = { { 1, 0 }, { 3, 1 }, { 0, 2 }, { 2, 3 } };
  std::vector<double> means;
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      for (int c = 0; c < 3; ++c)
      {
        double sum = 0;
        for (const auto& place : Places)
        {
          const int i = Enlargement * x + place[0];
          const int j = Enlargement * y + place[1];
          sum += large[3 * (static_cast<std::size_t>(j) * Enlargement * Width + i) + c];
        }
        means.push_back(sum / Samples);
      }
    }
  }
  return means;
}

/// Pixels that are off by more than a number of steps, of those in which the windows agreed without
/// the volume.
int CountDifferences(const std::vector<int>& window, const std::vector<double>& expected,
  const std::vector<bool>& agreed, double steps)
{
  int count = 0;
  for (std::size_t k = 0; k < window.size(); k += 3)
  {
    bool differs = false;
    for (std::size_t c = k; c < k + 3; ++c)
    {
      differs = differs || std::abs(window[c] - expected[c]) > steps;
    }
    count += agreed[k / 3] && differs ? 1 : 0;
  }
  return count;
}

/// VTK alone: edges through a sample are rounded in each size of window.
std::vector<bool> FindAgreement(const std::vector<int>& window, const std::vector<double>& expected)
{
  std::vector<bool> agreed(window.size() / 3, true);
  for (std::size_t k = 0; k < window.size(); ++k)
  {
    agreed[k / 3] = agreed[k / 3] && std::abs(window[k] - expected[k]) <= 1;
  }
  return agreed;
}

class Multisampling : public testing::TestWithParam<std::string>
{
};

} // namespace

INSTANTIATE_TEST_SUITE_P(
  Mappers, Multisampling, testing::ValuesIn(GetMapperClasses()), NameAnyMapperTest);

TEST_P(Multisampling, SamplesEdges)
{
  // Ends of surfaces that are thinner than a pixel, between the rays through middles.
  const int mostMissed = this->GetParam() == "vtkTetrahedraIsosurfaceMapper" ? 5 : 0;
  for (const bool parallel : { false, true })
  {
    SCOPED_TRACE(parallel ? "parallel" : "perspective");
    SampledScene scene(this->GetParam(), 1);
    SampledScene large(this->GetParam(), Enlargement);
    for (SampledScene* each : { &scene, &large })
    {
      each->Renderer->GetActiveCamera()->SetParallelProjection(parallel ? 1 : 0);
      each->Renderer->ResetCameraClippingRange();
      each->Volume->VisibilityOff();
      each->Window->Render();
    }
    const std::vector<bool> agreed = FindAgreement(scene.Grab(), Average(large.Grab()));
    ASSERT_LE(std::count(agreed.begin(), agreed.end(), false), MostRounded);

    scene.Volume->VisibilityOn();
    large.Volume->VisibilityOn();
    scene.Render();
    large.Render();
    const std::vector<double> expected = Average(large.Grab());
    const std::vector<int> window = scene.Grab();
    EXPECT_LE(CountDifferences(window, expected, agreed, LargestStep), mostMissed);
    EXPECT_GT(std::stoi(scene.Get("pixels_at_edges")), 100);

    scene.Render();
    EXPECT_EQ(scene.Get("kept"), "true");
    EXPECT_EQ(scene.Grab(), window);

    scene.Window->SetMultiSamples(0);
    scene.Render();
    EXPECT_EQ(scene.Get("kept"), "false");
    EXPECT_GT(CountDifferences(scene.Grab(), expected, agreed, UnsampledStep), 20);
  }
}

TEST_P(Multisampling, FollowsWhatIsBehindTheEdges)
{
  SampledScene scene(this->GetParam(), 1);
  scene.Render();
  const std::vector<int> before = scene.Grab();
  auto* actor = vtkActor::SafeDownCast(scene.Renderer->GetActors()->GetItemAsObject(0));
  actor->AddPosition(0.004, 0, 0); // less than from a pixel to the next one
  scene.Render();
  EXPECT_EQ(scene.Get("kept"), "false");
  EXPECT_NE(scene.Grab(), before);
}

TEST_P(Multisampling, LeavesThePictureOfPixels)
{
  AnyMapperScene sampled(MakeMapper(this->GetParam()));
  sampled.Window->SetMultiSamples(Samples);
  AnyMapperScene plain(MakeMapper(this->GetParam()));
  const std::vector<float> picture = plain.Render();
  EXPECT_EQ(sampled.Render(), picture);
  sampled.Window->SetMultiSamples(0);
  EXPECT_EQ(sampled.Render(), picture);
  EXPECT_EQ(sampled.Grab(), plain.Grab());
}

// Rays gather by other means in each blend mode: the largest scalar is looked for in a pass apart.
TEST(MultisampledBlendModes, SampleEdges)
{
  for (const char* mapperClass :
    { "vtkTetrahedraGPURayCastMapper", "vtkTetrahedraProjectionMapper" })
  {
    for (const int mode : { 1, 4, 5 })
    {
      SCOPED_TRACE(std::string(mapperClass) + ", blend mode " + std::to_string(mode));
      std::vector<int> windows[2];
      for (const bool onTheProcessor : { false, true })
      {
        SampledScene scene(onTheProcessor ? "vtkTetrahedraRayCastMapper" : mapperClass, 1);
        vtkTetrahedraVolumeMapper::SafeDownCast(scene.GetMapper())->SetBlendMode(mode);
        scene.Render();
        EXPECT_GT(std::stoi(scene.Get("pixels_at_edges")), 100);
        windows[onTheProcessor ? 1 : 0] = scene.Grab();
      }
      const std::vector<bool> all(windows[0].size() / 3, true);
      const std::vector<double> expected(windows[1].begin(), windows[1].end());
      // Edges that single precision finds in one picture and not in the other.
      EXPECT_LE(CountDifferences(windows[0], expected, all, 1), 5);
    }
  }
}

// Where nothing is lit, there is nothing to refine.
TEST(MultisampledPictures, AreCompleteWithoutLight)
{
  SampledScene scene("vtkTetrahedraIsosurfaceMapper", 1);
  vtkTetrahedraIsosurfaceMapper::SafeDownCast(scene.GetMapper())->AmbientOcclusionOn();
  scene.Render();
  EXPECT_GT(std::stoi(scene.Get("pixels_at_edges")), 100);
  scene.Render();
  EXPECT_EQ(scene.Get("kept"), "true");
}

// One that frames refine gets its samples when it is complete.
TEST(MultisampledPictures, SampleEdgesOfSoftShadows)
{
  SampledScene scene("vtkTetrahedraIsosurfaceMapper", 1);
  SampledScene large("vtkTetrahedraIsosurfaceMapper", Enlargement);
  for (SampledScene* each : { &scene, &large })
  {
    auto* mapper = vtkTetrahedraIsosurfaceMapper::SafeDownCast(each->GetMapper());
    each->Volume->GetProperty()->ShadeOn();
    mapper->AmbientOcclusionOn();
    mapper->SetSamplesPerFrame(32);
    mapper->SetMaximumSamples(64);
    each->Volume->VisibilityOff();
    each->Window->Render();
  }
  const std::vector<bool> agreed = FindAgreement(scene.Grab(), Average(large.Grab()));
  for (SampledScene* each : { &scene, &large })
  {
    each->Volume->VisibilityOn();
    each->Render();
  }
  EXPECT_EQ(scene.Get("pixels_at_edges"), "no statistic pixels_at_edges");
  const std::vector<int> unsampled = scene.Grab();
  scene.Render();
  large.Render();
  EXPECT_GT(std::stoi(scene.Get("pixels_at_edges")), 100);
  const std::vector<double> expected = Average(large.Grab());
  const std::vector<int> window = scene.Grab();
  // Samples of light differ from pixel to pixel.
  constexpr double LightSteps = 12;
  EXPECT_LE(CountDifferences(window, expected, agreed, LightSteps), 10);
  EXPECT_GT(CountDifferences(unsampled, expected, agreed, LightSteps), 40);
  scene.Render();
  EXPECT_EQ(scene.Get("kept"), "true");
  EXPECT_EQ(scene.Grab(), window);
}
