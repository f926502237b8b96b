// SPDX-License-Identifier: BSD-3-Clause
// An isosurface whose value is that of a layer of points: each ray crosses it once, whatever faces,
// edges and vertices of the layer it goes through, in every mapper.

#include "RayCastScene.h"
#include "ReferenceScenes.h"

#include "vtkContourValues.h"
#include "vtkImageData.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraProjectionMapper.h"

#include <algorithm>
#include <cmath>

namespace
{

constexpr double SurfaceOpacity = 0.7;

// Of the opacity: single precision.
constexpr double Tolerance = 1e-4;

using Factory = vtkSmartPointer<vtkTetrahedraVolumeMapper> (*)();

template <class Mapper>
vtkSmartPointer<vtkTetrahedraVolumeMapper> Make()
{
  return vtkSmartPointer<Mapper>::New();
}

class IsosurfaceLayers : public testing::TestWithParam<Factory>
{
};

// The scalar is the height, and eight layers of points are in the box, with the surface in one. No
// ray that the camera sees comes in or leaves at the height of the surface.
TEST_P(IsosurfaceLayers, AreCrossedOnce)
{
  const Vector positions[] = { { 0.5, 0.5, 4 }, { 0.5, 0.5, -3 }, { 1.1, 0.8, 3.4 },
    { 0.2, 1.3, -2.6 } };
  for (const int layers : { 8, 10 })
  {
    for (const bool parallel : { false, true })
    {
      for (const Vector& position : positions)
      {
        SCOPED_TRACE(std::to_string(layers) + (parallel ? " parallel " : " perspective ") +
          std::to_string(position[0]) + " " + std::to_string(position[2]));
        RayCastScene scene(160, 120);
        scene.Mesh = tetralux::MakeBox(layers, layers, layers, { 0, 0, 0 }, { 1, 1, 1 }, 0);
        scene.Scalars.clear();
        for (std::size_t p = 0; p < scene.Mesh.GetNumberOfPoints(); ++p)
        {
          scene.Scalars.push_back(scene.Mesh.Points[3 * p + 2]);
        }
        scene.Grid = MakeGrid(scene.Mesh, scene.Scalars);
        const double value = scene.Scalars[(layers / 2) * (layers + 1) * (layers + 1)];
        scene.Opacity->RemoveAllPoints();
        scene.Opacity->AddPoint(0, SurfaceOpacity);
        scene.Opacity->AddPoint(1, SurfaceOpacity);
        scene.Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, value);
        scene.Parallel = parallel;
        scene.ParallelScale = 0.25;
        scene.ViewAngle = 9;
        scene.SetCamera(position, { 0.5, 0.5, 0.5 }, { 0, 1, 0 });
        const vtkSmartPointer<vtkTetrahedraVolumeMapper> mapper = GetParam()();
        mapper->SetBlendModeToIsoSurface();
        scene.Use(mapper);
        scene.Window->Render();
        const vtkIdType pixels = mapper->GetOutputImage()->GetNumberOfPoints();
        ASSERT_EQ(pixels, 160 * 120);
        vtkIdType wrong = 0;
        double worst = 0;
        for (vtkIdType pixel = 0; pixel < pixels; ++pixel)
        {
          const double error = std::abs(scene.GetColors()[4 * pixel + 3] - SurfaceOpacity);
          wrong += !(error <= Tolerance);
          worst = std::max(worst, error);
        }
        EXPECT_EQ(wrong, 0) << "off by " << worst;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllMappers, IsosurfaceLayers,
  testing::Values(&Make<vtkTetrahedraRayCastMapper>, &Make<vtkTetrahedraGPURayCastMapper>,
    &Make<vtkTetrahedraProjectionMapper>, &Make<vtkTetrahedraIsosurfaceMapper>));

} // namespace
