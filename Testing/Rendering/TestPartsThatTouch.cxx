// SPDX-License-Identifier: BSD-3-Clause
// Cells that touch without sharing points give the picture of the cells that share them: each cell
// with points of its own, as discontinuous finite elements and many exporters write it, and two
// pieces, as those of a parallel file.
#include "RayCastScene.h"

#include "vtkImageData.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
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

/// Gives each part of the cells points of its own. getPart: of a cell.
template <class GetPart>
void Separate(RayCastScene& scene, const GetPart& getPart)
{
  const TetrahedralMesh shared = scene.Mesh;
  TetrahedralMesh mesh;
  std::vector<double> scalars;
  std::map<std::pair<std::int64_t, std::int32_t>, std::int32_t> ids;
  for (std::size_t corner = 0; corner < shared.Cells.size(); ++corner)
  {
    const std::int32_t point = shared.Cells[corner];
    const auto id = static_cast<std::int32_t>(scalars.size());
    const auto [place, isNew] = ids.try_emplace({ getPart(shared, corner / 4), point }, id);
    mesh.Cells.push_back(place->second);
    if (isNew)
    {
      const double* x = &shared.Points[3 * static_cast<std::size_t>(point)];
      mesh.Points.insert(mesh.Points.end(), x, x + 3);
      scalars.push_back(scene.Scalars[point]);
    }
  }
  scene.Mesh = std::move(mesh);
  scene.Scalars = std::move(scalars);
  scene.Grid = MakeGrid(scene.Mesh, scene.Scalars);
}

std::int64_t GetCell(const TetrahedralMesh&, std::size_t cell)
{
  return static_cast<std::int64_t>(cell);
}

/// On which side of the middle of the box a cell is.
std::int64_t GetSide(const TetrahedralMesh& mesh, std::size_t cell)
{
  double x = 0;
  for (std::size_t corner = 4 * cell; corner < 4 * cell + 4; ++corner)
  {
    x += 0.25 * mesh.Points[3 * static_cast<std::size_t>(mesh.Cells[corner])];
  }
  return static_cast<std::int64_t>(x > 0.5);
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
  scene.Use(mapper);
  scene.Window->Render();
  const std::size_t pixels = scene.GetMapper()->GetOutputImage()->GetNumberOfPoints();
  return { scene.GetColors(), scene.GetColors() + 4 * pixels };
}

void ExpectSamePicture(const std::vector<float>& picture, const std::vector<float>& expected,
  double tolerance, const char* name)
{
  SCOPED_TRACE(name);
  ASSERT_EQ(picture.size(), expected.size());
  double largest = 0;
  double covered = 0;
  for (std::size_t c = 0; c < picture.size(); ++c)
  {
    largest = std::max(largest, std::abs(static_cast<double>(picture[c]) - expected[c]));
    covered = std::max(covered, static_cast<double>(expected[c]));
  }
  EXPECT_GT(covered, 0.1);
  EXPECT_LE(largest, tolerance);
}

template <class GetPart>
void ExpectWholePicture(const GetPart& getPart)
{
  for (int view = 0; view < 3; ++view)
  {
    SCOPED_TRACE("view " + std::to_string(view));
    RayCastScene scene;
    SetView(scene, view);
    vtkNew<vtkTetrahedraRayCastMapper> reference;
    reference->SetPrecisionToDouble();
    const std::vector<float> expected = Render(scene, reference);
    Separate(scene, getPart);
    vtkNew<vtkTetrahedraRayCastMapper> rayCast;
    vtkNew<vtkTetrahedraGPURayCastMapper> gpuRayCast;
    vtkNew<vtkTetrahedraProjectionMapper> projection;
    ExpectSamePicture(Render(scene, rayCast), expected, RayCastTolerance, "ray cast");
    ExpectSamePicture(Render(scene, gpuRayCast), expected, DisplayTolerance, "graphics card");
    ExpectSamePicture(Render(scene, projection), expected, DisplayTolerance, "projection");
  }
}

TEST(PartsThatTouch, CellsWithPointsOfTheirOwn) { ExpectWholePicture(GetCell); }

TEST(PartsThatTouch, TwoPieces) { ExpectWholePicture(GetSide); }

} // namespace
