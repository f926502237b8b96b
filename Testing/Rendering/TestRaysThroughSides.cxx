// SPDX-License-Identifier: BSD-3-Clause
// Parallel rays exactly in the sides of a box, along its edges and through its corners: all methods
// take them as if they were to the right of their pixels' centres, and less below them.
#include "RayCastScene.h"
#include "ReferenceScenes.h"

#include "vtkImageData.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraProjectionMapper.h"

#include <string>
#include <utility>
#include <vector>

namespace
{

/// Powers of two, so that no place of a ray is rounded.
constexpr int WindowSize = 16;

/// Pixels from the centre of one that is in a side of the box to that of one in the opposite side.
constexpr int BoxSize = 8;

TEST(RaysThroughSides, AreHalfOpenInAllMethods)
{
  RayCastScene scene(WindowSize, WindowSize);
  scene.Mesh = tetralux::MakeBox(4, 4, 4, { 0, 0, 0 }, { 1, 1, 1 }, 0);
  scene.Scalars = MakeField(scene.Mesh, { 0, 0, 0 }, 1);
  scene.Grid = MakeGrid(scene.Mesh, scene.Scalars);
  scene.Parallel = true;
  scene.ParallelScale = 0.5 * WindowSize / BoxSize;
  vtkNew<vtkTetrahedraRayCastMapper> precise;
  precise->SetPrecisionToDouble();
  vtkNew<vtkTetrahedraGPURayCastMapper> cards;
  vtkNew<vtkTetrahedraProjectionMapper> projection;
  const std::vector<std::pair<std::string, vtkTetrahedraVolumeMapper*>> mappers = {
    { "single", scene.Mapper }, { "double", precise }, { "graphics card", cards },
    { "projection", projection }
  };
  // Half a pixel beside the middle of the box.
  constexpr double Middle = 0.5 + 0.5 / BoxSize;
  const Vector middle = { Middle, Middle, Middle };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double side : { -1., 1. })
    {
      Vector position = middle;
      position[axis] += 3 * side;
      Vector up = { 0, 0, 0 };
      up[(axis + 1) % 3] = 1;
      scene.SetCamera(position, middle, up);
      std::vector<float> expected;
      for (const auto& [name, mapper] : mappers)
      {
        SCOPED_TRACE(name + ", axis " + std::to_string(axis) + ", side " + std::to_string(side));
        scene.Use(mapper);
        scene.Window->Render();
        const std::vector<float> colors(
          scene.GetColors(), scene.GetColors() + 4 * WindowSize * WindowSize);
        constexpr int Lowest = (WindowSize - BoxSize) / 2 - 1;
        const int first = side > 0 ? Lowest + 1 : Lowest; // from the left
        for (int j = 0; j < WindowSize; ++j)
        {
          for (int i = 0; i < WindowSize; ++i)
          {
            const bool inside =
              first <= i && i < first + BoxSize && Lowest < j && j <= Lowest + BoxSize;
            EXPECT_EQ(colors[4 * (j * WindowSize + i) + 3] > 0, inside) << i << ", " << j;
          }
        }
        if (expected.empty())
        {
          expected = colors;
        }
        ExpectSamePicture(colors, expected, 1e-5, name.c_str());
      }
    }
  }
}

} // namespace
