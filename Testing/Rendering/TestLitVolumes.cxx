// SPDX-License-Identifier: BSD-3-Clause
// Volumes under lights, against a reference that integrates the light along each ray by itself: by
// gradients of points and of cells, under three kinds of light. The scenes are those of the
// benchmark, with fewer cells.
#include "Frame/RendererLights.h"
#include "Generate/GeneratedMeshes.h"
#include "RayCastScene.h"
#include "ReferenceGrazing.h"
#include "ReferenceRenderer.h"
#include "ReferenceScenes.h"

#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace
{

using Node = std::array<double, 5>; ///< place in the range, red, green, blue, opacity

/// Largest difference of a channel: by the ray caster, and what a display shows.
constexpr double RayCastTolerance = 1e-4;
constexpr double DisplayTolerance = 1. / 255;

/// Pixels that a silhouette grazes, which are not compared; of those that see anything.
constexpr double GrazedShare = 0.05;

struct LitCase
{
  const char* Name;
  const char* Mesh;
  std::map<std::string, double> Parameters;
  std::vector<Node> Nodes;
  double UnitDistance; ///< of the bounds' diagonal
};

const std::vector<Node> Smooth = { { 0, 0, 0, 1, 0 }, { 0.13, 0, 1, 1, 0.02 },
  { 0.21, 0, 1, 0, 0.3 }, { 0.38, 1, 1, 0, 0.05 }, { 0.7, 1, 0.5, 0, 0.3 }, { 1, 1, 0, 0, 1 } };
const std::vector<Node> Needle = { { 0, 0.3, 0.4, 1, 0.01 }, { 0.3 - 0.001, 0.3, 0.4, 1, 0.01 },
  { 0.3, 1, 0.9, 0.2, 1 }, { 0.3 + 0.001, 0.3, 0.9, 0.5, 0.01 }, { 1, 1, 0.3, 0.2, 0.02 } };
const std::vector<Node> Opaque = { { 0, 0.2, 0.3, 0.9, 0 }, { 0.2, 0.2, 0.7, 0.9, 0 },
  { 0.3, 0.9, 0.8, 0.3, 1 }, { 1, 0.9, 0.2, 0.1, 1 } };

std::ostream& operator<<(std::ostream& stream, const LitCase& value)
{
  return stream << value.Name;
}

class LitVolumes : public ::testing::TestWithParam<LitCase>
{
protected:
  LitVolumes()
    : Scene(64, 64)
  {
    const LitCase& lit = GetParam();
    const tetralux::GeneratedMesh generated = tetralux::GenerateMesh(lit.Mesh, lit.Parameters);
    this->Scene.Mesh = generated.Mesh;
    this->Scene.Scalars = generated.Scalars;
    this->Scene.Grid = MakeGrid(this->Scene.Mesh, this->Scene.Scalars);
    const auto [low, high] =
      std::minmax_element(this->Scene.Scalars.begin(), this->Scene.Scalars.end());
    const double range = *high - *low;
    const double unit = lit.UnitDistance * this->Scene.Grid->GetLength();
    std::vector<Node> linear;
    this->Scene.Color->RemoveAllPoints();
    this->Scene.Opacity->RemoveAllPoints();
    for (const Node& node : lit.Nodes)
    {
      const double scalar = *low + node[0] * range;
      this->Scene.Color->AddRGBPoint(scalar, node[1], node[2], node[3]);
      this->Scene.Opacity->AddPoint(scalar, node[4]);
      linear.push_back({ scalar, node[1], node[2], node[3], node[4] / unit });
    }
    this->Optics.Function = tetralux::MakeLinearFunction(linear);
    vtkVolumeProperty* property = this->Scene.Volume->GetProperty();
    property->SetScalarOpacityUnitDistance(unit);
    property->ShadeOn();
    property->SetAmbient(0.2);
    property->SetDiffuse(0.7);
    property->SetSpecular(0.3);
    property->SetSpecularPower(20);
    double bounds[6];
    this->Scene.Grid->GetBounds(bounds);
    Vector focus, position;
    for (int a = 0; a < 3; ++a)
    {
      focus[a] = (bounds[2 * a] + bounds[2 * a + 1]) / 2;
    }
    const double size = this->Scene.Grid->GetLength();
    position = { focus[0] + 0.9 * size, focus[1] + 0.5 * size, focus[2] + 1.5 * size };
    this->Scene.SetCamera(position, focus, { 0.1, 1, 0 }, 0.1 * size, 4 * size);
    this->Focus = focus;
    this->Length = size;
  }

  /// A light at the viewer, as a renderer has it by default; two distant ones of colours; a near
  /// one that fades with distance, inside the mesh's bounds, and a spot.
  static std::vector<std::string> GetKinds() { return { "viewer", "distant", "near" }; }

  void SetLights(const std::string& kind)
  {
    vtkRenderer* renderer = this->Scene.Renderer;
    renderer->RemoveAllLights();
    renderer->SetAutomaticLightCreation(kind == "viewer");
    renderer->SetLightFollowCamera(true);
    if (kind == "viewer")
    {
      return; // made by the renderer
    }
    const auto add = [&](const Vector& place, const Vector& color)
    {
      vtkNew<vtkLight> light;
      light->SetLightTypeToSceneLight();
      light->SetPosition(this->Focus[0] + place[0] * this->Length,
        this->Focus[1] + place[1] * this->Length, this->Focus[2] + place[2] * this->Length);
      light->SetFocalPoint(this->Focus.data());
      light->SetColor(color[0], color[1], color[2]);
      light->SetPositional(kind == "near");
      light->SetConeAngle(90);
      renderer->AddLight(light);
      return vtkSmartPointer<vtkLight>(light);
    };
    vtkSmartPointer<vtkLight> first = add({ 0.4, 0.1, 0.3 }, { 1, 0.9, 0.6 });
    vtkSmartPointer<vtkLight> second = add({ -0.6, 0.7, 0.2 }, { 0.5, 0.6, 0.9 });
    if (kind == "near")
    {
      first->SetAttenuationValues(0.5, 0, 2 / (this->Length * this->Length));
      second->SetConeAngle(20);
      second->SetExponent(2);
    }
  }

  tetralux::ReferenceMesh GetMesh() const
  {
    return { this->Scene.Mesh.Points, this->Scene.Mesh.Cells, this->Scene.Scalars, false };
  }

  void ExpectReference(const std::string& name, const tetralux::ReferenceImage& expected,
    vtkTetrahedraVolumeMapper* mapper, double tolerance)
  {
    SCOPED_TRACE(name);
    this->Scene.Window->Render();
    const std::size_t pixels = expected.Depth.size();
    std::vector<double> errors(pixels, 0);
    std::vector<std::uint8_t> off(pixels, 0);
    double covered = 0;
    for (std::size_t k = 0; k < 4 * pixels; ++k)
    {
      const double error = std::abs(this->Scene.GetColors()[k] - expected.Rgba[k]);
      errors[k / 4] = std::max(errors[k / 4], error);
      covered += k % 4 == 3 && expected.Rgba[k] > 0 ? 1 : 0;
    }
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
    {
      off[pixel] = errors[pixel] > std::min(tolerance, mapper->GetErrorEstimate()) ? 1 : 0;
    }
    const std::vector<double> grazing = tetralux::MeasureGrazing(
      this->GetMesh(), this->Optics, this->Rays, this->Scene.MakeReferenceLimits(), expected, off);
    double worst = 0;
    double grazed = 0;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel)
    {
      if (off[pixel] && grazing[pixel] > tetralux::GrazingThreshold)
      {
        ++grazed;
        continue;
      }
      worst = std::max(worst, errors[pixel]);
    }
    std::cout << name << ": worst " << worst << ", estimate " << mapper->GetErrorEstimate() << ", "
              << grazed << " grazed of " << covered << '\n';
    EXPECT_GT(covered, 0.1 * static_cast<double>(pixels));
    EXPECT_LE(grazed, GrazedShare * covered);
    EXPECT_LE(worst, tolerance);
    EXPECT_LE(worst, mapper->GetErrorEstimate());
  }

  RayCastScene Scene;
  tetralux::ReferenceOptics Optics;
  tetralux::RayGrid Rays;
  Vector Focus;
  double Length = 1;
  vtkNew<vtkTetrahedraRayCastMapper> RayCast;
  vtkNew<vtkTetrahedraGPURayCastMapper> Gpu;
  vtkNew<vtkTetrahedraProjectionMapper> Projection;
};

TEST_P(LitVolumes, AgreeWithTheIntegratedLight)
{
  this->Rays = this->Scene.MakeReferenceRays(64, 64);
  this->Optics.Shaded = true;
  this->Optics.Surface = tetralux::GetMaterial(this->Scene.Volume->GetProperty());
  this->RayCast->AutoAdjustSampleDistancesOff();
  for (const std::string& kind : this->GetKinds())
  {
    this->SetLights(kind);
    this->Scene.Window->Render(); // makes the light at the viewer
    this->Optics.Lights = tetralux::GetRendererLights(this->Scene.Renderer);
    for (const bool smooth : { true, false })
    {
      this->Optics.SmoothShading = smooth;
      const tetralux::ReferenceImage expected = tetralux::RenderReference(
        this->GetMesh(), this->Optics, this->Rays, this->Scene.MakeReferenceLimits());
      const std::string lighting = kind + (smooth ? ", smooth, " : ", of cells, ");
      const auto expect =
        [&](vtkTetrahedraVolumeMapper* mapper, const std::string& name, double tolerance)
      {
        this->Scene.Use(mapper);
        mapper->SetSmoothShading(smooth);
        this->ExpectReference(lighting + name, expected, mapper, tolerance);
      };
      expect(this->RayCast, "ray-cast", RayCastTolerance);
      expect(this->Gpu, "gpu-ray-cast", DisplayTolerance);
      expect(this->Projection, "projection", DisplayTolerance);
    }
  }
}

// Cropping that keeps all regions cuts rays and changes nothing else.
TEST_P(LitVolumes, CutCellsLookLikeWholeOnes)
{
  constexpr int AllRegions = (1 << 27) - 1;
  double bounds[6];
  this->Scene.Grid->GetBounds(bounds);
  double planes[6];
  for (int a = 0; a < 3; ++a)
  {
    planes[2 * a] = bounds[2 * a] + 0.37 * (bounds[2 * a + 1] - bounds[2 * a]);
    planes[2 * a + 1] = bounds[2 * a] + 0.58 * (bounds[2 * a + 1] - bounds[2 * a]);
  }
  this->RayCast->AutoAdjustSampleDistancesOff();
  for (const std::string& kind : this->GetKinds())
  {
    this->SetLights(kind);
    for (const bool smooth : { true, false })
    {
      for (vtkTetrahedraVolumeMapper* mapper :
        { static_cast<vtkTetrahedraVolumeMapper*>(this->RayCast),
          static_cast<vtkTetrahedraVolumeMapper*>(this->Gpu),
          static_cast<vtkTetrahedraVolumeMapper*>(this->Projection) })
      {
        this->Scene.Use(mapper);
        mapper->SetSmoothShading(smooth);
        mapper->CroppingOff();
        this->Scene.Window->Render();
        const std::vector<float> whole(
          this->Scene.GetColors(), this->Scene.GetColors() + std::size_t(4) * 64 * 64);
        mapper->CroppingOn();
        mapper->SetCroppingRegionFlags(AllRegions);
        mapper->SetCroppingRegionPlanes(planes);
        this->Scene.Window->Render();
        const std::vector<float> cut(
          this->Scene.GetColors(), this->Scene.GetColors() + std::size_t(4) * 64 * 64);
        ExpectSamePicture(cut, whole, std::min(2 * mapper->GetErrorEstimate(), DisplayTolerance),
          (kind + (smooth ? ", smooth, " : ", of cells, ") + mapper->GetClassName()).c_str());
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, LitVolumes,
  ::testing::Values(
    LitCase{ "Ring", "ring", { { "around", 40 }, { "across", 6 } }, Smooth, 1. / 30 },
    LitCase{ "Needle", "ring", { { "around", 40 }, { "across", 6 } }, Needle, 1. / 300 },
    LitCase{ "Ball", "ball", { { "cells", 7 } }, Smooth, 1. / 30 },
    LitCase{ "OpaqueBall", "ball", { { "cells", 6 } }, Opaque, 1. / 2000 },
    LitCase{ "Layers", "boundary-layer", { { "cells", 6 }, { "layers", 10 } }, Smooth, 1. / 30 },
    LitCase{ "Random", "random", { { "cells", 6 } }, Smooth, 1. / 30 }),
  [](const auto& info) { return std::string(info.param.Name); });

} // namespace
