// SPDX-License-Identifier: BSD-3-Clause
// Parallel rays exactly in the sides of a box, along its edges and through its corners: all methods
// take them as if they were beside their pixels' centres, as View/RayAcross.h says.
#include "RayCastScene.h"
#include "ReferenceScenes.h"

#include "vtkContourValues.h"
#include "vtkImageData.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraProjectionMapper.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace
{

/// A place of the picture, in pixels from the centre of one.
struct Place
{
  int X, Y;
};

/// The outline of a box: its corners, counter-clockwise, at centres of pixels.
using Outline = std::vector<Place>;

/// Whether a pixel is inside, by whole numbers; on a side by where ShiftSlope, 3 / 8, goes.
bool IsInside(const Outline& outline, int x, int y)
{
  for (std::size_t k = 0; k < outline.size(); ++k)
  {
    const Place& a = outline[k];
    const Place& b = outline[(k + 1) % outline.size()];
    const int across = (b.X - a.X) * (y - a.Y) - (b.Y - a.Y) * (x - a.X);
    const int shifted = 3 * (b.X - a.X) - 8 * (b.Y - a.Y);
    if (across < 0 || (across == 0 && shifted < 0))
    {
      return false;
    }
  }
  return true;
}

constexpr int WindowSize = 32;

/// The pixel that the camera looks at is to the upper right of the middle of the window.
constexpr int Middle = WindowSize / 2;

/// Largest difference of a channel between methods, which round each in its own way.
constexpr double ColorTolerance = 1e-5;

class SidesScene : public RayCastScene
{
public:
  /// A unit box around the origin, whose height is a number of pixels.
  explicit SidesScene(double pixels)
    : RayCastScene(WindowSize, WindowSize)
  {
    this->Parallel = true;
    this->ParallelScale = 0.5 * WindowSize / pixels;
    this->SetMesh(tetralux::MakeBox(4, 4, 4, { -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.5 }, 0));
    this->Precise->SetPrecisionToDouble();
    this->Isosurface->SetBlendModeToIsoSurface();
  }

  void SetMesh(tetralux::TetrahedralMesh mesh)
  {
    this->Mesh = std::move(mesh);
    this->Scalars = MakeField(this->Mesh, { -0.5, -0.5, -0.5 }, 1);
    this->Grid = MakeGrid(this->Mesh, this->Scalars);
  }

  /// Looks along a direction, with the box's centre at (Middle, Middle).
  void Look(const Vector& direction, const Vector& up)
  {
    this->Direction = direction;
    this->SetCamera({ -3 * direction[0], -3 * direction[1], -3 * direction[2] }, { 0, 0, 0 }, up);
    // Pixel (Middle, Middle) has its centre half a pixel beside that of the window.
    this->Renderer->GetActiveCamera()->SetWindowCenter(-1. / WindowSize, -1. / WindowSize);
  }

  void ExpectOutline(const Outline& outline)
  {
    std::vector<float> expected;
    const std::vector<std::pair<std::string, vtkTetrahedraVolumeMapper*>> mappers = {
      { "single", this->Mapper }, { "double", this->Precise }, { "graphics card", this->Card },
      { "projection", this->Projection }
    };
    for (const auto& [name, mapper] : mappers)
    {
      SCOPED_TRACE(name);
      const std::vector<float> colors = this->Render(mapper);
      this->ExpectInside(colors, outline);
      if (expected.empty())
      {
        expected = colors;
      }
      ExpectSamePicture(colors, expected, ColorTolerance, name.c_str());
    }
  }

  /// Of a surface across the rays, which ends at the sides.
  void ExpectOutlineOfSurface(const Outline& outline)
  {
    const std::vector<double> field = std::move(this->Scalars);
    this->Scalars.clear();
    for (std::size_t p = 0; p < this->Mesh.GetNumberOfPoints(); ++p)
    {
      const double* x = &this->Mesh.Points[3 * p];
      this->Scalars.push_back(
        x[0] * this->Direction[0] + x[1] * this->Direction[1] + x[2] * this->Direction[2]);
    }
    const vtkSmartPointer<vtkUnstructuredGrid> grid = this->Grid;
    this->Grid = MakeGrid(this->Mesh, this->Scalars);
    this->Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, 0.03);
    this->ExpectInside(this->Render(this->Isosurface), outline);
    this->Grid = grid;
    this->Scalars = field;
  }

private:
  std::vector<float> Render(vtkTetrahedraVolumeMapper* mapper)
  {
    this->Use(mapper);
    this->Window->Render();
    return { this->GetColors(), this->GetColors() + 4 * WindowSize * WindowSize };
  }

  void ExpectInside(const std::vector<float>& colors, const Outline& outline)
  {
    for (int j = 0; j < WindowSize; ++j)
    {
      for (int i = 0; i < WindowSize; ++i)
      {
        EXPECT_EQ(
          colors[4 * (j * WindowSize + i) + 3] > 0, IsInside(outline, i - Middle, j - Middle))
          << i - Middle << ", " << j - Middle;
      }
    }
  }

  Vector Direction = { 0, 0, 0 };
  vtkNew<vtkTetrahedraRayCastMapper> Precise;
  vtkNew<vtkTetrahedraGPURayCastMapper> Card;
  vtkNew<vtkTetrahedraProjectionMapper> Projection;
  vtkNew<vtkTetrahedraIsosurfaceMapper> Isosurface;
};

TEST(RaysThroughSides, OfABoxAlongTheAxes)
{
  SidesScene scene(16);
  const Outline outline = { { -8, -8 }, { 8, -8 }, { 8, 8 }, { -8, 8 } };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double side : { -1., 1. })
    {
      SCOPED_TRACE("axis " + std::to_string(axis) + ", side " + std::to_string(side));
      Vector direction = { 0, 0, 0 };
      Vector up = { 0, 0, 0 };
      direction[axis] = side;
      up[(axis + 1) % 3] = 1;
      scene.Look(direction, up);
      scene.ExpectOutline(outline);
      scene.ExpectOutlineOfSurface(outline);
    }
  }
}

TEST(RaysThroughSides, OfABoxAlongADiagonal)
{
  SidesScene scene(16 / std::sqrt(2.));
  // Two faces are seen, and an edge between them; above and below the box ends between pixels.
  const Outline outline = { { -8, -5 }, { 8, -5 }, { 8, 6 }, { -8, 6 } };
  scene.Look({ 1, 1, 0 }, { 0, 0, 1 });
  scene.ExpectOutline(outline);
  scene.Look({ 0, -1, 1 }, { 1, 0, 0 });
  scene.ExpectOutline(outline);
}

// By an angle whose sine is 3 / 5: corners and points of sides are at pixels' centres still, but
// for rounding.
TEST(RaysThroughSides, OfATurnedBox)
{
  SidesScene scene(20);
  tetralux::TetrahedralMesh mesh = scene.Mesh;
  for (std::size_t p = 0; p < mesh.GetNumberOfPoints(); ++p)
  {
    double* x = &mesh.Points[3 * p];
    const double turned[2] = { 0.8 * x[0] - 0.6 * x[1], 0.6 * x[0] + 0.8 * x[1] };
    std::copy_n(turned, 2, x);
  }
  scene.SetMesh(std::move(mesh));
  scene.Look({ 0, 0, -1 }, { 0, 1, 0 });
  const Outline outline = { { -2, -14 }, { 14, -2 }, { 2, 14 }, { -14, 2 } };
  scene.ExpectOutline(outline);
  scene.ExpectOutlineOfSurface(outline);
}

// A volume may be mirrored, and larger in one direction; the rule is of the picture.
TEST(RaysThroughSides, OfAMirroredAndStretchedVolume)
{
  SidesScene scene(16);
  scene.Look({ 0, 0, -1 }, { 0, 1, 0 });
  scene.Volume->SetScale(-0.5, 1, 2);
  const Outline narrow = { { -4, -8 }, { 4, -8 }, { 4, 8 }, { -4, 8 } };
  scene.ExpectOutline(narrow);
  scene.ExpectOutlineOfSurface(narrow);
  scene.Volume->SetScale(-1, 0.75, 1);
  scene.Volume->RotateZ(90);
  const Outline turned = { { -6, -8 }, { 6, -8 }, { 6, 8 }, { -6, 8 } };
  scene.ExpectOutline(turned);
  scene.ExpectOutlineOfSurface(turned);
}

} // namespace
