// SPDX-License-Identifier: BSD-3-Clause
// Parts of a mesh that overlap. A ray goes through connected cells until it leaves them, then comes
// in at the next boundary face, in the order of the entries' distances: parts contribute each, one
// after the other, in the order in which the ray enters them.
#include "MeshParts.h"
#include "RayCastScene.h"
#include "ReferenceRenderer.h"
#include "ReferenceScenes.h"

#include "vtkContourValues.h"
#include "vtkImageData.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace
{

using tetralux::ReferenceImage;
using tetralux::TetrahedralMesh;

/// Largest difference of a channel: by the ray caster, and what a display shows.
constexpr double RayCastTolerance = 1e-4;
constexpr double DisplayTolerance = 1. / 255;

/// Of a distance, in edges of the box: where the scalar is flat its rounding moves a surface.
constexpr double DepthTolerance = 1e-4;

/// Around which the scalars of each part are.
constexpr double ScalarsOfParts[] = { -0.7, -0.1, 0.5 };

/// A box, a long one through it, and one that both of them contain a part of; each of another
/// colour.
class OverlappingCells : public ::testing::Test
{
protected:
  OverlappingCells()
  {
    this->Scene.Mesh = {};
    this->Scene.Scalars.clear();
    this->AddPart(tetralux::MakeBox(3, 4, 3, { 0, 0, 0 }, { 1, 1, 1 }, 0.15), ScalarsOfParts[0]);
    this->AddPart(tetralux::MakeBox(2, 2, 6, { 0.31, 0.23, -0.42 }, { 0.64, 0.58, 1.37 }, 0.15),
      ScalarsOfParts[1]);
    this->AddPart(tetralux::MakeBox(3, 2, 2, { 0.52, 0.37, 0.46 }, { 1.35, 0.84, 0.93 }, 0.15),
      ScalarsOfParts[2]);
    this->Scene.Grid = MakeGrid(this->Scene.Mesh, this->Scene.Scalars);
    this->Double->SetPrecisionToDouble();
  }

  /// Colours of a part around a scalar; a little varied, so that cells of the part differ.
  void AddPart(const TetrahedralMesh& part, double scalar)
  {
    for (const double bend : MakeField(part, { 0, 0, 0 }, 1))
    {
      this->Scene.Scalars.push_back(scalar + 0.1 * bend);
    }
    tetralux::AddMesh(this->Scene.Mesh, part);
  }

  static std::vector<std::string> GetViews()
  {
    return { "outside", "parallel", "from behind", "inside of all", "cut in front and behind" };
  }

  void SetView(std::size_t view)
  {
    this->Scene.Parallel = view == 1;
    switch (view)
    {
      case 0:
        this->Scene.SetCamera({ 1.9, 1.4, 2.6 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0 });
        break;
      case 1:
        this->Scene.SetCamera({ 2.1, 0.3, -1.7 }, { 0.55, 0.45, 0.5 }, { 0.1, 1, 0 });
        break;
      case 2:
        this->Scene.SetCamera({ 0.41, 0.57, -2.9 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0 });
        break;
      case 3:
        this->Scene.SetCamera({ 0.58, 0.44, 0.71 }, { 0.1, 0.5, 0.3 }, { 0.1, 1, 0 });
        break;
      default: // most rays end in overlapping parts, in which they began
        this->Scene.SetCamera({ 1.9, 1.4, 2.6 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0 }, 2.2, 2.65);
        break;
    }
  }

  std::vector<vtkTetrahedraVolumeMapper*> GetMappers()
  {
    return { this->RayCast, this->Double, this->Gpu, this->Projection };
  }

  ReferenceImage FindExpected(
    const tetralux::ReferenceOptics& optics, tetralux::RayLimits limits = {}) const
  {
    limits.Planes = this->Scene.MakeReferenceLimits().Planes;
    const int* size = this->Scene.Window->GetSize();
    const tetralux::ReferenceMesh mesh{ this->Scene.Mesh.Points, this->Scene.Mesh.Cells,
      this->Scene.Scalars, false };
    return tetralux::RenderReference(
      mesh, optics, this->Scene.MakeReferenceRays(size[0], size[1]), limits);
  }

  /// firstChannel: 3 to compare opacities only.
  void Compare(const std::string& name, vtkTetrahedraVolumeMapper* mapper,
    const ReferenceImage& expected, double tolerance, std::size_t firstChannel = 0)
  {
    SCOPED_TRACE(name);
    this->Scene.Use(mapper);
    this->Scene.Window->Render();
    double largest = 0;
    double largestDepth = 0;
    double covered = 0;
    int off = 0;
    for (std::size_t pixel = 0; pixel < expected.Depth.size(); ++pixel)
    {
      double difference = 0;
      for (std::size_t k = 4 * pixel + firstChannel; k < 4 * pixel + 4; ++k)
      {
        covered = std::max(covered, expected.Rgba[k]);
        difference = std::max(difference, std::abs(this->Scene.GetColors()[k] - expected.Rgba[k]));
      }
      off += difference > tolerance ? 1 : 0;
      largest = std::max(largest, difference);
      largestDepth =
        std::max(largestDepth, std::abs(this->Scene.GetDepths()[pixel] - expected.Depth[pixel]));
    }
    std::cout << name << ": " << off << " pixels off, worst " << largest << '\n';
    EXPECT_GT(covered, 0.3);
    EXPECT_LE(largest, tolerance) << off << " pixels";
    // The graphics card keeps the segment that begins nearest, not its surface.
    if (mapper != this->Gpu.Get() ||
      mapper->GetBlendMode() != vtkTetrahedraVolumeMapper::ISOSURFACE_BLEND)
    {
      EXPECT_LE(largestDepth, DepthTolerance);
    }
  }

  RayCastScene Scene;
  vtkNew<vtkTetrahedraRayCastMapper> RayCast;
  vtkNew<vtkTetrahedraRayCastMapper> Double;
  vtkNew<vtkTetrahedraGPURayCastMapper> Gpu;
  vtkNew<vtkTetrahedraProjectionMapper> Projection;
};

TEST_F(OverlappingCells, ContributeInTheOrderOfEntries)
{
  for (std::size_t view = 0; view < GetViews().size(); ++view)
  {
    SCOPED_TRACE(GetViews()[view]);
    this->SetView(view);
    const ReferenceImage expected = this->FindExpected(this->Scene.Function);
    this->Compare("ray cast, single", this->RayCast, expected, RayCastTolerance);
    this->Compare("ray cast, double", this->Double, expected, RayCastTolerance);
    this->Compare("graphics card", this->Gpu, expected, DisplayTolerance);
    // Its order is one for the whole picture: what all parts hide together is right.
    this->Compare("projection", this->Projection, expected, DisplayTolerance, 3);
  }
}

TEST_F(OverlappingCells, ContributeInEachPartOfARay)
{
  const double planes[6] = { 0.2, 0.7, 0.3, 0.5, 0.1, 0.8 };
  constexpr int Flags = 0x5f7ffdf;
  tetralux::RayLimits cropping;
  cropping.Cropping = true;
  cropping.CroppingFlags = Flags;
  std::copy_n(planes, 6, cropping.CroppingPlanes);
  for (vtkTetrahedraVolumeMapper* mapper : this->GetMappers())
  {
    mapper->CroppingOn();
    mapper->SetCroppingRegionPlanes(planes);
    mapper->SetCroppingRegionFlags(Flags);
  }
  for (std::size_t view = 0; view < GetViews().size(); ++view)
  {
    SCOPED_TRACE(GetViews()[view]);
    this->SetView(view);
    const ReferenceImage expected = this->FindExpected(this->Scene.Function, cropping);
    this->Compare("ray cast, single", this->RayCast, expected, RayCastTolerance);
    this->Compare("ray cast, double", this->Double, expected, RayCastTolerance);
    this->Compare("graphics card", this->Gpu, expected, DisplayTolerance);
    this->Compare("projection", this->Projection, expected, DisplayTolerance, 3);
  }
}

TEST_F(OverlappingCells, SurfacesAreMetInTheOrderOfEntries)
{
  // So many that hardly a cell has none: those without any are left out where that pays, and divide
  // the parts.
  constexpr int SurfacesOfPart = 6;
  constexpr double Opacity = 0.2;
  tetralux::ReferenceOptics optics;
  optics.Model = tetralux::OpticalModel::Isosurfaces;
  this->Scene.Color->RemoveAllPoints();
  this->Scene.Opacity->RemoveAllPoints();
  vtkContourValues* values = this->Scene.Volume->GetProperty()->GetIsoSurfaceValues();
  for (int surface = 0; surface < 3 * SurfacesOfPart; ++surface)
  {
    const int part = surface / SurfacesOfPart;
    const double value = ScalarsOfParts[part] - 0.08 + 0.03 * (surface % SurfacesOfPart);
    float color[3] = { 0, 0, 0 };
    color[part] = 1;
    optics.Isosurfaces.push_back(
      { value, { color[0], color[1], color[2] }, static_cast<float>(Opacity) });
    this->Scene.Color->AddRGBPoint(value, color[0], color[1], color[2]);
    this->Scene.Opacity->AddPoint(value, Opacity);
    values->SetValue(surface, value);
  }
  for (vtkTetrahedraVolumeMapper* mapper : this->GetMappers())
  {
    mapper->SetBlendModeToIsoSurface();
  }
  for (std::size_t view = 0; view < GetViews().size(); ++view)
  {
    SCOPED_TRACE(GetViews()[view]);
    this->SetView(view);
    const ReferenceImage expected = this->FindExpected(optics);
    this->Compare("ray cast, single", this->RayCast, expected, RayCastTolerance);
    this->Compare("ray cast, double", this->Double, expected, RayCastTolerance);
    this->Compare("graphics card", this->Gpu, expected, DisplayTolerance);
    this->Compare("projection", this->Projection, expected, DisplayTolerance, 3);
  }
}

} // namespace
