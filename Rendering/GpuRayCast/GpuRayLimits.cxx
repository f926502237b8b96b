// SPDX-License-Identifier: BSD-3-Clause
#include "GpuRayCast/GpuRayLimits.h"

#include "GpuRayCast/RayTargets.h"
#include "RayGridDec.h"
#include "RayLimitsDec.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cmath>

namespace tetralux
{
namespace
{

/// The most parts that six cropping planes can leave of a ray.
constexpr int MostParts = 4;
static_assert(MostParts <= RayTargets::MostParts);

/// Homogeneous coordinates relative to a position in the world, times a factor, in the coordinates
/// of rays: radii of the mesh from its centre.
void TransformPoint(const RayGrid& grid, const double position[3], const double center[3],
  double radius, double factor, const double point[4], float result[4])
{
  for (int a = 0; a < 3; ++a)
  {
    const double* row = grid.MeshFromWorld[a];
    const double origin =
      row[0] * position[0] + row[1] * position[1] + row[2] * position[2] + row[3] - center[a];
    const double sum =
      row[0] * point[0] + row[1] * point[1] + row[2] * point[2] + origin * point[3];
    result[a] = static_cast<float>(factor * sum / radius);
  }
  result[3] = static_cast<float>(factor * point[3]);
}

} // namespace

GpuRayLimits::GpuRayLimits() = default;

GpuRayLimits::~GpuRayLimits() = default;

void GpuRayLimits::Update(vtkOpenGLRenderWindow* window, const RayGrid& grid,
  const RayLimits& limits, const OpaqueGeometry* opaque, const double center[3], double radius)
{
  this->Rays.emplace(grid, limits, center, radius);
  this->Opaque = opaque != nullptr;
  this->Hides = opaque && opaque->Depths.size() > 0;
  if (opaque)
  {
    if (this->Hides)
    {
      this->Depth.Upload(window, grid.Width, grid.Height, opaque->Depths);
    }
    else
    {
      this->Depth.Copy(window, opaque->Rectangle);
    }
    vtkTextureObject* depths = this->Depth.GetTexture();
    this->OpaquePixels[0] = static_cast<float>(depths->GetWidth()) / static_cast<float>(grid.Width);
    this->OpaquePixels[1] =
      static_cast<float>(depths->GetHeight()) / static_cast<float>(grid.Height);
    DepthPlaces places = opaque->Places;
    // In the middle of the picture instead of in its lower left pixel.
    places.Shift(0.5 * (grid.Width - 1), 0.5 * (grid.Height - 1));
    // Made so that the last coordinate is about 1: in any unit of the world, all are in range.
    const double factor = 1 / std::max(std::abs(places.Farthest[3]), std::abs(places.Nearer[3]));
    const auto transform = [&](const double point[4], float result[4])
    { TransformPoint(grid, places.Position, center, radius, factor, point, result); };
    transform(places.Farthest, this->OpaqueFar[0]);
    transform(places.FarthestStepX, this->OpaqueFar[1]);
    transform(places.FarthestStepY, this->OpaqueFar[2]);
    transform(places.Nearer, this->OpaqueNearer);
  }
  this->Cropping = limits.Cropping;
  for (int a = 0; a < 3; ++a)
  {
    for (int side = 0; side < 2; ++side)
    {
      this->CroppingPlanes[side][a] =
        static_cast<float>((limits.CroppingPlanes[2 * a + side] - center[a]) / radius);
    }
  }
  this->CroppingFlags = static_cast<int>(limits.CroppingFlags);
}

bool GpuRayLimits::HasDepthOf(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle)
{
  return this->Depth.IsSame(window, rectangle);
}

int GpuRayLimits::GetNumberOfParts() const { return this->Cropping ? MostParts : 1; }

std::string GpuRayLimits::GetDeclarations() const
{
  std::string defines = this->Rays->GetDefines();
  defines += "#define NUMBER_OF_PARTS " + std::to_string(this->GetNumberOfParts()) + "\n";
  if (this->Opaque)
  {
    defines += "#define OPAQUE_GEOMETRY\n";
  }
  if (this->Cropping)
  {
    defines += "#define CROPPING\n";
  }
  return defines + RayGridDec + RayLimitsDec;
}

void GpuRayLimits::Activate(vtkShaderProgram* program)
{
  this->Rays->Set(program);
  if (this->Opaque)
  {
    vtkTextureObject* texture = this->Depth.GetTexture();
    const vtkOpenGLState::ScopedglActiveTexture unit(texture->GetContext()->GetState());
    texture->Activate();
    program->SetUniformi("opaqueDepth", texture->GetTextureUnit());
    program->SetUniform2f("opaquePixels", this->OpaquePixels);
    program->SetUniform4fv("opaqueFar", 3, this->OpaqueFar);
    program->SetUniform4f("opaqueNearer", this->OpaqueNearer);
  }
  if (this->Cropping)
  {
    program->SetUniform3fv("croppingPlanes", 2, this->CroppingPlanes);
    program->SetUniformi("croppingFlags", this->CroppingFlags);
  }
}

void GpuRayLimits::Deactivate()
{
  if (this->Opaque)
  {
    vtkTextureObject* texture = this->Depth.GetTexture();
    const vtkOpenGLState::ScopedglActiveTexture unit(texture->GetContext()->GetState());
    texture->Deactivate();
  }
}

void GpuRayLimits::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Depth.ReleaseGraphicsResources(window);
}

} // namespace tetralux
