// SPDX-License-Identifier: BSD-3-Clause

// The optical models of the ray caster against the reference renderer.

#include "RayScene.h"
#include "ReferenceGrazing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using namespace tetralux;

/// The largest error of a channel, of the brightest one in the picture where that is above 1.
constexpr double ErrorGoal = 1e-4;

/// Pixels on silhouettes, which may differ: their share of all.
constexpr double GrazedShare = 0.02;

/// Depths, relative to the largest: a face met at a slant moves along the ray by more than the
/// rounding of coordinates, 2^-24 of the radius.
constexpr double DepthError = 1e-5;

/// Pixels whose depth may be off by more: the first contribution is in a cell that another one only
/// just does not hide, or the largest scalar is nearly met twice.
constexpr double DepthOutlierShare = 0.01;

constexpr int ImageSize = 64;

RayScene MakeScene(OpticalModel model)
{
  RayScene scene;
  scene.Mesh = MakeBox(9, 9, 9, { 0, 0, 0 }, { 1, 1, 1 }, 0.15);
  scene.Scalars = MakeSmoothField(scene.Mesh);
  scene.Function = MakeColorfulFunction(20);
  scene.Model = model;
  scene.Grid = MakePerspectiveGrid(
    { 3.1, 2.2, 2.7 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0.2 }, 30, ImageSize, ImageSize);
  if (model == OpticalModel::MaximumIntensity)
  {
    scene.Function = MakeColorfulFunction(1); // its attenuations are opacities
  }
  if (model == OpticalModel::Isosurfaces)
  {
    scene.Isosurfaces = { { 0.3, { 1, 0.2f, 0.1f }, 0.3f }, { 0.45, { 0.2f, 1, 0.1f }, 0.5f },
      { 0.5, { 1, 1, 1 }, 0 }, { 0.7, { 0.2f, 0.3f, 1 }, 0.9f } };
  }
  return scene;
}

std::vector<Light> MakeLights()
{
  Light distant;
  distant.Positional = false;
  distant.Position[0] = 0.6;
  distant.Position[1] = 0.8;
  distant.Position[2] = 0;
  Light spot;
  spot.Positional = true;
  spot.Position[0] = 3;
  spot.Position[1] = 2;
  spot.Position[2] = 3;
  const double axis = -1 / std::sqrt(3.);
  spot.Axis[0] = spot.Axis[1] = spot.Axis[2] = axis;
  spot.ConeCosine = 0.9;
  spot.Exponent = 3;
  spot.Attenuation[1] = 0.1;
  for (Light* light : { &distant, &spot })
  {
    for (int c = 0; c < 3; ++c)
    {
      light->Ambient[c] = 0.5f;
      light->Diffuse[c] = 0.4f + 0.2f * c;
      light->Specular[c] = 0.9f - 0.2f * c;
    }
  }
  return { distant, spot };
}

struct NamedScene
{
  std::string Name;
  RayScene (*Make)();
};

std::ostream& operator<<(std::ostream& stream, const NamedScene& scene)
{
  return stream << scene.Name;
}

RayScene Cells(RayScene scene)
{
  scene.CellScalars = true;
  scene.Scalars.clear();
  const std::vector<double> points = MakeSmoothField(scene.Mesh);
  for (std::size_t t = 0; t < scene.Mesh.GetNumberOfCells(); ++t)
  {
    scene.Scalars.push_back(points[scene.Mesh.Cells[4 * t]]);
  }
  return scene;
}

RayScene Clipped(RayScene scene)
{
  scene.Limits.Planes.push_back({ -1, 0.3, -0.5, 0.7 });
  scene.Limits.Cropping = true;
  scene.Limits.CroppingFlags = 0x7ffdfff;
  const double planes[6] = { 0.2, 0.7, 0.3, 0.8, 0.1, 0.6 };
  std::copy_n(planes, 6, scene.Limits.CroppingPlanes);
  return scene;
}

RayScene OneColor(RayScene scene)
{
  for (TransferFunction::Node& node : scene.Function.Nodes)
  {
    for (TransferFunction::Value* value : { &node.Left, &node.Right })
    {
      value->Color[0] = 0.9;
      value->Color[1] = 0.5;
      value->Color[2] = 0.1;
    }
  }
  return scene;
}

RayScene Shaded(RayScene scene)
{
  scene.Shaded = true;
  scene.Lights = MakeLights();
  return scene;
}

/// A light so far away that squares of its distance are beyond single precision.
RayScene LitFromFar(RayScene scene)
{
  scene.Shaded = true;
  scene.Lights = { MakeLights()[0] };
  Light& light = scene.Lights[0];
  light.Positional = true;
  for (double& x : light.Position)
  {
    x *= 1e20;
  }
  return scene;
}

/// A spot from so far away that its cone's cosine is 1 in single precision. The cone is as wide as
/// a few cells.
RayScene LitByNarrowSpot(RayScene scene)
{
  constexpr double Distance = 2000;
  scene.Shaded = true;
  scene.Lights = { MakeLights()[1] };
  Light& light = scene.Lights[0];
  light.Attenuation[1] = 0;
  for (int a = 0; a < 3; ++a)
  {
    light.Position[a] = 0.5 - Distance * light.Axis[a];
  }
  light.ConeCosine = std::cos(0.3 / Distance);
  return scene;
}

RayScene Smoothly(RayScene scene)
{
  scene.SmoothShading = true;
  return scene;
}

/// The mesh placed in the world by scaling, shear and mirroring: gradients turn other than edges.
RayScene Sheared(RayScene scene)
{
  const double worldFromMesh[3][4] = { { 2, 0.7, 0, 10 }, { 0, 0.5, 0.3, -20 },
    { 0.4, 0, -1.5, 5 } };
  scene.Grid = MakePerspectiveGrid(
    { 16, -16, 12 }, { 11.35, -19.6, 4.45 }, { 0, 1, 0 }, 22, ImageSize, ImageSize);
  PlaceMesh(scene.Grid, worldFromMesh);
  return scene;
}

/// Surfaces that lie in faces of the mesh, and rays through vertices and along grid lines, but none
/// within the hull's faces: it may be inside or outside.
RayScene SurfacesInFaces()
{
  RayScene scene;
  scene.Mesh = MakeBox(8, 8, 8, { 0, 0, 0 }, { 1, 1, 1 });
  for (std::size_t p = 0; p < scene.Mesh.GetNumberOfPoints(); ++p)
  {
    scene.Scalars.push_back(scene.Mesh.Points[3 * p + 2]);
  }
  scene.Model = OpticalModel::Isosurfaces;
  scene.Function = MakeColorfulFunction(20);
  scene.Isosurfaces = { { 0.25, { 1, 0, 0 }, 0.5f }, { 0.5, { 0, 1, 0 }, 0.5f },
    { 1, { 0, 0, 1 }, 0.5f } };
  constexpr int Rays = 15; // from 1/16 to 15/16
  scene.Grid =
    MakeParallelGrid({ 0.5, 0.5, 5 }, { 0.5, 0.5, 0 }, { 0, 1, 0 }, 0.5 * Rays / 16, Rays, Rays);
  return scene;
}

class Models : public ::testing::TestWithParam<NamedScene>
{
};

TEST_P(Models, AgreeWithReference)
{
  const RayScene scene = GetParam().Make();
  const ReferenceImage reference = scene.RenderReference();
  const std::size_t pixels = reference.Depth.size();
  double brightest = 1;
  std::size_t covered = 0;
  double depthScale = 0;
  for (std::size_t p = 0; p < pixels; ++p)
  {
    for (std::size_t i = 4 * p; i < 4 * p + 4; ++i)
    {
      brightest = std::max(brightest, reference.Rgba[i]);
    }
    if (reference.Depth[p] != -1)
    {
      ++covered;
      depthScale = std::max(depthScale, std::abs(reference.Depth[p]));
    }
  }
  ASSERT_GT(covered, pixels / 20) << "a scene without a picture";

  VolumeScene volume = scene.MakeVolumeScene();
  for (const bool portable : { false, true })
  {
    for (const Precision precision : { Precision::Automatic, Precision::Single, Precision::Double })
    {
      RayCastOptions options;
      options.Kernels = ChooseKernels(portable);
      options.Arithmetic = precision;
      const RayPicture picture = Cast(volume, scene, options);
      SCOPED_TRACE(std::string(portable ? "portable, " : "") + "integrator " +
        std::to_string(static_cast<int>(picture.Statistics.Integration)) +
        (picture.Statistics.DoublePrecision ? ", double" : ", single"));

      std::vector<double> errors(pixels, 0);
      std::vector<std::uint8_t> isOff(pixels, 0);
      std::size_t depthOutliers = 0;
      for (std::size_t p = 0; p < pixels; ++p)
      {
        for (std::size_t i = 4 * p; i < 4 * p + 4; ++i)
        {
          const double error = std::abs(picture.Colors[i] - reference.Rgba[i]);
          errors[p] = std::isnan(error) ? std::numeric_limits<double>::infinity()
                                        : std::max(errors[p], error);
        }
        isOff[p] = errors[p] > ErrorGoal * brightest;
        depthOutliers +=
          !(std::abs(picture.Depths[p] - reference.Depth[p]) <= DepthError * depthScale);
      }
      const std::vector<double> grazing = scene.MeasureGrazing(reference, isOff);
      std::size_t grazed = 0;
      for (std::size_t p = 0; p < pixels; ++p)
      {
        if (isOff[p] && grazing[p] > GrazingThreshold)
        {
          ++grazed;
        }
        else
        {
          EXPECT_LE(errors[p], ErrorGoal * brightest) << "pixel " << p;
        }
      }
      EXPECT_LE(grazed, GrazedShare * static_cast<double>(covered));
      EXPECT_LE(depthOutliers, DepthOutlierShare * static_cast<double>(covered));
    }
  }
}

TEST_P(Models, VectorKernelsGiveTheSameBits)
{
  if (GetWidestInstructionSet() != InstructionSet::Avx512)
  {
    GTEST_SKIP() << "this processor has no AVX-512";
  }
  const RayScene scene = this->GetParam().Make();
  VolumeScene volume = scene.MakeVolumeScene();
  for (const Precision precision : { Precision::Single, Precision::Double })
  {
    RayCastOptions options;
    options.Arithmetic = precision;
    options.Kernels = InstructionSet::Avx2;
    const RayPicture expected = Cast(volume, scene, options);
    options.Kernels = InstructionSet::Avx512;
    const RayPicture picture = Cast(volume, scene, options);
    EXPECT_EQ(expected.Statistics.InstructionSet, "AVX2");
    EXPECT_EQ(picture.Statistics.InstructionSet, "AVX-512");
    EXPECT_TRUE(picture.Colors == expected.Colors);
    EXPECT_TRUE(picture.Depths == expected.Depths);
  }
}

// Packets of 16 rays, also where some of their blocks are left to double precision.
TEST_P(Models, WideKernelsGiveTheSameBits)
{
  if (!HasFastWideLanes())
  {
    GTEST_SKIP() << "this processor has no fast lanes of 16";
  }
  const RayScene scene = this->GetParam().Make();
  VolumeScene volume = scene.MakeVolumeScene();
  for (const Precision precision : { Precision::Single, Precision::Automatic })
  {
    RayCastOptions options;
    options.Arithmetic = precision;
    const RayPicture picture = Cast(volume, scene, options);
    options.WideKernels = false;
    const RayPicture expected = Cast(volume, scene, options);
    EXPECT_EQ(picture.Statistics.InstructionSet, "AVX-512");
    EXPECT_TRUE(picture.Colors == expected.Colors);
    EXPECT_TRUE(picture.Depths == expected.Depths);
    EXPECT_EQ(picture.Statistics.Segments, expected.Statistics.Segments);
    EXPECT_EQ(picture.Statistics.Paths, expected.Statistics.Paths);
    EXPECT_EQ(picture.Statistics.DoubleRays, expected.Statistics.DoubleRays);
    EXPECT_EQ(picture.Statistics.ErrorEstimate, expected.Statistics.ErrorEstimate);
    EXPECT_LE(picture.Statistics.LaneUse, 1);
  }
}

constexpr auto Emission = OpticalModel::EmissionOnly;
constexpr auto Absorption = OpticalModel::AbsorptionOnly;
constexpr auto Largest = OpticalModel::MaximumIntensity;
constexpr auto Surfaces = OpticalModel::Isosurfaces;
constexpr auto Emitter = OpticalModel::EmissionAbsorption;

INSTANTIATE_TEST_SUITE_P(RayCaster, Models,
  ::testing::Values(NamedScene{ "Emission", [] { return MakeScene(Emission); } },
    NamedScene{ "EmissionOfCells", [] { return Cells(MakeScene(Emission)); } },
    NamedScene{ "EmissionClipped", [] { return Clipped(MakeScene(Emission)); } },
    NamedScene{ "Absorption", [] { return MakeScene(Absorption); } },
    NamedScene{ "AbsorptionOfCells", [] { return Cells(MakeScene(Absorption)); } },
    NamedScene{ "OneColor", [] { return OneColor(MakeScene(Emitter)); } },
    NamedScene{ "OneColorOfCells", [] { return Cells(OneColor(MakeScene(Emitter))); } },
    NamedScene{ "OneColorClipped", [] { return Clipped(OneColor(MakeScene(Emitter))); } },
    NamedScene{ "Largest", [] { return MakeScene(Largest); } },
    NamedScene{ "LargestOfCells", [] { return Cells(MakeScene(Largest)); } },
    NamedScene{ "LargestClipped", [] { return Clipped(MakeScene(Largest)); } },
    NamedScene{ "Surfaces", [] { return MakeScene(Surfaces); } },
    NamedScene{ "SurfacesClipped", [] { return Clipped(MakeScene(Surfaces)); } },
    NamedScene{ "SurfacesInFaces", &SurfacesInFaces },
    NamedScene{ "ShadedSurfaces", [] { return Shaded(MakeScene(Surfaces)); } },
    NamedScene{ "ShadedSurfacesSheared", [] { return Sheared(Shaded(MakeScene(Surfaces))); } },
    NamedScene{ "Lit", [] { return Shaded(MakeScene(Emitter)); } },
    NamedScene{ "LitSheared", [] { return Sheared(Shaded(MakeScene(Emitter))); } },
    NamedScene{ "LitClipped", [] { return Clipped(Shaded(MakeScene(Emitter))); } },
    NamedScene{ "LitOneColor", [] { return Shaded(OneColor(MakeScene(Emitter))); } },
    NamedScene{ "LitFromFar", [] { return LitFromFar(MakeScene(Emitter)); } },
    NamedScene{ "LitByNarrowSpot", [] { return LitByNarrowSpot(MakeScene(Emitter)); } },
    NamedScene{ "LitSmoothly", [] { return Smoothly(Shaded(MakeScene(Emitter))); } },
    NamedScene{
      "LitSmoothlySheared", [] { return Sheared(Smoothly(Shaded(MakeScene(Emitter)))); } },
    NamedScene{ "SurfacesLitSmoothly", [] { return Smoothly(Shaded(MakeScene(Surfaces))); } },
    NamedScene{ "CellsShineByThemselves", [] { return Cells(Shaded(MakeScene(Emitter))); } }),
  [](const auto& info) { return info.param.Name; });

// Intervals are looked up in registers, as many as these are needed for, or gathered.
TEST(RayCasterModels, WideKernelsGiveTheSameBitsOfAnyNumberOfIntervals)
{
  if (!HasFastWideLanes())
  {
    GTEST_SKIP() << "this processor has no fast lanes of 16";
  }
  RayScene scene = MakeScene(Emitter);
  for (const int nodes : { 15, 16, 31, 32, 47, 48, 63, 64, 200 })
  {
    scene.Function.Nodes.clear();
    for (int k = 0; k < nodes; ++k)
    {
      // Bends that no run of intervals leaves out.
      const TransferFunction::Value value = { { k % 3 / 2., k % 5 / 4., k % 7 / 6. },
        1. + k % 2 * 3 };
      scene.Function.Nodes.push_back({ k / (nodes - 1.), value, value });
    }
    VolumeScene volume = scene.MakeVolumeScene();
    RayCastOptions options;
    options.Arithmetic = Precision::Single;
    const RayPicture picture = Cast(volume, scene, options);
    EXPECT_EQ(volume.Optics.GetIntervalTable().Intervals.size(), nodes + 1u);
    options.WideKernels = false;
    EXPECT_TRUE(picture.Colors == Cast(volume, scene, options).Colors) << nodes << " nodes";
  }
}

TEST(RayCasterModels, ConstantColorIsIntegratedByOpticalDepth)
{
  const auto getIntegration = [](const RayScene& scene)
  {
    VolumeScene volume = scene.MakeVolumeScene();
    return Cast(volume, scene).Statistics.Integration;
  };
  EXPECT_EQ(getIntegration(MakeScene(Emitter)), Integrator::ClosedForm);
  EXPECT_EQ(getIntegration(OneColor(MakeScene(Emitter))), Integrator::OpticalDepth);

  // Colours where nothing is attenuated do not count.
  RayScene scene = OneColor(MakeScene(Emitter));
  scene.Function.Nodes.front().Left.Color[0] = 0;
  ASSERT_EQ(scene.Function.Nodes.front().Left.Attenuation, 0);
  EXPECT_EQ(getIntegration(scene), Integrator::OpticalDepth);
  scene.Function.Nodes.back().Right.Color[0] = 0;
  ASSERT_GT(scene.Function.Nodes.back().Right.Attenuation, 0);
  EXPECT_EQ(getIntegration(scene), Integrator::ClosedForm);
}

TEST(RayCasterModels, SurfacesLeaveCellsOutThatTheyDoNotCross)
{
  RayScene scene = MakeScene(Surfaces);
  scene.Isosurfaces = { { 0.9, { 1, 1, 1 }, 0.5f } };
  VolumeScene volume = scene.MakeVolumeScene();
  const RayPicture picture = Cast(volume, scene);
  EXPECT_GT(picture.Statistics.TransparentCells, 0);

  // Other surfaces, other cells.
  scene.Isosurfaces = MakeScene(Surfaces).Isosurfaces;
  volume.Optics.SetIsosurfaces(scene.Isosurfaces);
  VolumeScene fresh = scene.MakeVolumeScene();
  EXPECT_EQ(Cast(volume, scene).Colors, Cast(fresh, scene).Colors);
}

TEST(RayCasterModels, SwitchingModelsLeavesNothingBehind)
{
  RayScene scene = MakeScene(Emitter);
  scene.Isosurfaces = MakeScene(Surfaces).Isosurfaces;
  VolumeScene volume = scene.MakeVolumeScene();
  for (const OpticalModel model :
    { Emitter, Surfaces, Largest, Emission, Surfaces, Absorption, Emitter })
  {
    scene.Model = model;
    volume.Optics.SetModel(model);
    VolumeScene fresh = scene.MakeVolumeScene();
    EXPECT_EQ(Cast(volume, scene).Colors, Cast(fresh, scene).Colors);
  }
}

TEST(RayCasterModels, RefusesSurfacesOfCellsAndOfNoNumber)
{
  RayScene scene = Cells(MakeScene(Surfaces));
  VolumeScene volume = scene.MakeVolumeScene();
  EXPECT_THROW(Cast(volume, scene), std::invalid_argument);
  EXPECT_THROW(
    volume.Optics.SetIsosurfaces({ { std::numeric_limits<double>::quiet_NaN(), { 1, 1, 1 }, 1 } }),
    std::invalid_argument);
}

} // namespace
