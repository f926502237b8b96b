// SPDX-License-Identifier: BSD-3-Clause
// Cells that touch without sharing points, which are not merged either, give the picture of the
// cells that share them: each cell with points of its own, as discontinuous finite elements and
// many exporters write it, and two pieces, as those of a parallel file.
#include "MeshParts.h"
#include "RayCastScene.h"

#include "vtkImageData.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace
{

using tetralux::TetrahedralMesh;

/// Largest difference of a channel between both pictures: by the ray caster, which differs by the
/// order of additions and MaximumError; by the others, what a display shows.
constexpr double RayCastTolerance = 1e-4;
constexpr double DisplayTolerance = 1. / 255;

TetrahedralMesh SeparateHalves(const TetrahedralMesh& mesh)
{
  std::vector<std::int64_t> sides;
  for (std::size_t cell = 0; cell < mesh.Cells.size(); cell += 4)
  {
    double x = 0;
    for (std::size_t corner = cell; corner < cell + 4; ++corner)
    {
      x += 0.25 * mesh.Points[3 * static_cast<std::size_t>(mesh.Cells[corner])];
    }
    sides.push_back(static_cast<std::int64_t>(x > 0.5));
  }
  return tetralux::SeparateParts(mesh, sides);
}

void SetMesh(RayCastScene& scene, TetrahedralMesh mesh)
{
  std::vector<double> scalars;
  for (const std::int64_t point : mesh.OriginalPoints)
  {
    scalars.push_back(scene.Scalars[point]);
  }
  scene.Grid = MakeGrid(mesh, scalars);
  scene.Mesh = std::move(mesh);
  scene.Scalars = std::move(scalars);
}

void SetView(RayCastScene& scene, int view)
{
  scene.Parallel = view == 1;
  switch (view)
  {
    case 0:
      scene.SetCamera({ 1.7, 2.3, 3.1 }, { 0.5, 0.5, 0.5 }, { 0, 1, 0 });
      break;
    case 1: // along the lattice; no ray is on the silhouette, where either answer is right
      scene.ParallelScale = 0.77;
      scene.SetCamera({ 0.5, 0.5, 3 }, { 0.5, 0.5, 0.5 }, { 0, 1, 0 });
      break;
    default: // inside
      scene.SetCamera({ 0.3, 0.4, 0.45 }, { 0.9, 0.6, 0.5 }, { 0, 1, 0 });
      break;
  }
}

std::vector<float> Render(RayCastScene& scene, vtkTetrahedraVolumeMapper* mapper)
{
  mapper->SetMergePointsToOff();
  scene.Use(mapper);
  scene.Window->Render();
  const std::size_t pixels = scene.GetMapper()->GetOutputImage()->GetNumberOfPoints();
  return { scene.GetColors(), scene.GetColors() + 4 * pixels };
}

void ExpectWholePicture(TetrahedralMesh (*separate)(const TetrahedralMesh&))
{
  for (int view = 0; view < 3; ++view)
  {
    SCOPED_TRACE("view " + std::to_string(view));
    RayCastScene scene;
    SetView(scene, view);
    vtkNew<vtkTetrahedraRayCastMapper> reference;
    reference->SetPrecisionToDouble();
    const std::vector<float> expected = Render(scene, reference);
    SetMesh(scene, separate(scene.Mesh));
    vtkNew<vtkTetrahedraRayCastMapper> rayCast;
    vtkNew<vtkTetrahedraGPURayCastMapper> gpuRayCast;
    vtkNew<vtkTetrahedraProjectionMapper> projection;
    ExpectSamePicture(Render(scene, rayCast), expected, RayCastTolerance, "ray cast");
    ExpectSamePicture(Render(scene, gpuRayCast), expected, DisplayTolerance, "graphics card");
    ExpectSamePicture(Render(scene, projection), expected, DisplayTolerance, "projection");
  }
}

TEST(PartsThatTouch, CellsWithPointsOfTheirOwn) { ExpectWholePicture(tetralux::SeparateCells); }

TEST(PartsThatTouch, TwoPieces) { ExpectWholePicture(SeparateHalves); }

} // namespace
