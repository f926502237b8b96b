// SPDX-License-Identifier: BSD-3-Clause
// Cells that touch but do not share all points of their faces: where cells meet cells of half their
// size, and where two lattices slide along each other. They fill a box with a linear scalar, so
// that the picture is that of the box, whatever fills it: at every pixel, of cameras too that look
// along the faces and through the points.
#include "MeshParts.h"
#include "RayCastScene.h"
#include "ReferenceRenderer.h"
#include "ReferenceScenes.h"

#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace
{

using tetralux::ReferenceImage;
using tetralux::TetrahedralMesh;

/// Largest difference of a channel: by the ray caster, and what a display shows.
constexpr double RayCastTolerance = 1e-4;
constexpr double DisplayTolerance = 1. / 255;

/// Pixels along an edge of a picture: odd, so that the middle one looks at the focal point.
constexpr int PictureSize = 33;

/// Of a pixel at the focal point: a third of the smallest cube's edge, so that rays go through
/// points and along faces.
constexpr double PixelPitch = 1. / 24;

/// Pixels: on either side of a silhouette the picture is what it is there, and on it either.
constexpr double SilhouetteWidth = 1e-3;

Vector Add(const Vector& a, double factor, const Vector& b)
{
  return { a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2] };
}

/// About an axis, degrees.
Vector Turn(const Vector& v, const Vector& axis, double degrees)
{
  Vector unit = axis;
  vtkMath::Normalize(unit.data());
  const double angle = vtkMath::RadiansFromDegrees(degrees);
  Vector across;
  vtkMath::Cross(unit.data(), v.data(), across.data());
  const double along = vtkMath::Dot(unit.data(), v.data()) * (1 - std::cos(angle));
  Vector turned;
  for (int k = 0; k < 3; ++k)
  {
    turned[k] = std::cos(angle) * v[k] + std::sin(angle) * across[k] + along * unit[k];
  }
  return turned;
}

/// How the whole scene stands in space: as it is made, or by a turn after which no coordinate of a
/// plane or a direction of view is a round number.
Vector Stand(const Vector& v, bool turned)
{
  return turned ? Turn(Turn(v, { 1, 2, 3 }, 37), { 3, -1, 1 }, 11) : v;
}

struct View
{
  std::string Name;
  bool Parallel;
  Vector Position;
  Vector FocalPoint;
  Vector ViewUp;
  double ViewAngle;
};

/// Cameras that look at places in faces, or from within them.
std::vector<View> MakeViews()
{
  std::vector<View> views;
  const auto add = [&views](const std::string& name, const Vector& from, const Vector& focalPoint,
                     const Vector& viewUp, double viewAngle)
  {
    const Vector direction = Add(focalPoint, -1, from);
    for (const double roll : { 0., 40. })
    {
      for (const bool parallel : { true, false })
      {
        if (parallel && viewAngle > 0)
        {
          continue;
        }
        const double distance = std::sqrt(vtkMath::Dot(direction.data(), direction.data()));
        const double angle = viewAngle > 0
          ? viewAngle
          : 2 * vtkMath::DegreesFromRadians(std::atan(0.5 * PictureSize * PixelPitch / distance));
        views.push_back(
          { name + (parallel ? ", parallel" : ", perspective") + (roll > 0 ? ", rolled" : ""),
            parallel, from, focalPoint, Turn(viewUp, direction, roll), angle });
      }
    }
  };
  const Vector middle = { 0.5, 0.25, 0.25 };
  for (int axis = 0; axis < 3; ++axis)
  {
    Vector along = { 0, 0, 0 };
    Vector up = { 0, 0, 0 };
    along[axis] = 1;
    up[(axis + 1) % 3] = 1;
    const std::string name(1, static_cast<char>('x' + axis));
    add(name + " in planes", Add(middle, 3, along), middle, up, 0);
    const Vector beside = Add(middle, 0.125, Vector{ 1, 1, 1 });
    add(name + " near", Add(beside, 1.5, along), Add(beside, 0.5, along), up, 0);
    add(name + " inside", middle, Add(middle, 1, along), up, 70);
  }
  add("diagonal of cubes", { 2.5, 2.25, 2.25 }, middle, { 0, 1, 0 }, 0);
  add("diagonal of faces", { 2.5, 2.25, 0.25 }, middle, { 0, 0, 1 }, 0);
  add("slanted in a plane", { 2.5, 0.25, 1.25 }, middle, { 0, 1, 0 }, 0);
  return views;
}

/// The box that is filled, in the scene.
struct Content
{
  TetrahedralMesh Mesh;
  Vector Upper;
};

class HangingNodes : public ::testing::Test
{
protected:
  HangingNodes()
    : Scene(PictureSize, PictureSize)
  {
    this->RayCast->SetPrecisionToSingle();
    this->Double->SetPrecisionToDouble();
    this->Gpu->SetReentryToBoundaryHierarchy();
    this->Layers->SetReentryToBoundaryLayers();
  }

  /// The picture of a content is that of a box, in every view.
  void ExpectBox(const Content& content)
  {
    for (const bool turned : { false, true })
    {
      this->Scene.Mesh = Place(content.Mesh, turned);
      this->Scene.Scalars = MakeScalars(content.Mesh);
      this->Scene.Grid = MakeGrid(this->Scene.Mesh, this->Scene.Scalars);
      const TetrahedralMesh box = tetralux::MakeBox(1, 1, 1, { 0, 0, 0 }, content.Upper);
      const TetrahedralMesh placed = Place(box, turned);
      const std::vector<double> scalars = MakeScalars(box);
      for (const View& view : MakeViews())
      {
        SCOPED_TRACE(view.Name + (turned ? ", turned" : ""));
        this->SetView(view, turned);
        this->FindExpected({ placed.Points, placed.Cells, scalars, false });
        this->Compare("ray cast, single", this->RayCast, RayCastTolerance);
        this->Compare("ray cast, double", this->Double, RayCastTolerance);
        this->Compare("graphics card", this->Gpu, DisplayTolerance);
        this->Compare("graphics card, layers", this->Layers, DisplayTolerance);
        this->Compare("projection", this->Projection, DisplayTolerance);
      }
    }
    for (const auto& [name, off] : this->PixelsOff)
    {
      std::cout << name << ": " << off.first << " pixels off, worst " << off.second << '\n';
    }
  }

private:
  static TetrahedralMesh Place(const TetrahedralMesh& mesh, bool turned)
  {
    TetrahedralMesh placed = mesh;
    for (std::size_t p = 0; p < mesh.Points.size(); p += 3)
    {
      const Vector x = Stand({ mesh.Points[p], mesh.Points[p + 1], mesh.Points[p + 2] }, turned);
      std::copy(x.begin(), x.end(), placed.Points.begin() + static_cast<std::ptrdiff_t>(p));
    }
    return placed;
  }

  /// Linear, over the range of the scene's function.
  static std::vector<double> MakeScalars(const TetrahedralMesh& mesh)
  {
    std::vector<double> scalars;
    for (std::size_t p = 0; p < mesh.Points.size(); p += 3)
    {
      scalars.push_back(
        0.8 * mesh.Points[p] + 0.5 * mesh.Points[p + 1] + 0.3 * mesh.Points[p + 2] - 0.85);
    }
    return scalars;
  }

  void SetView(const View& view, bool turned)
  {
    this->Scene.Parallel = view.Parallel;
    this->Scene.ParallelScale = 0.5 * PictureSize * PixelPitch;
    this->Scene.ViewAngle = view.ViewAngle;
    this->Scene.SetCamera(
      Stand(view.Position, turned), Stand(view.FocalPoint, turned), Stand(view.ViewUp, turned));
  }

  void FindExpected(const tetralux::ReferenceMesh& box)
  {
    const tetralux::RayGrid rays = this->Scene.MakeReferenceRays(PictureSize, PictureSize);
    const tetralux::RayLimits limits = this->Scene.MakeReferenceLimits();
    this->Expected = tetralux::RenderReference(box, this->Scene.Function, rays, limits);
    this->Silhouette.assign(this->Expected.Length.size(), false);
    for (const double x : { -SilhouetteWidth, SilhouetteWidth })
    {
      for (const double y : { -SilhouetteWidth, SilhouetteWidth })
      {
        tetralux::RayGrid beside = rays;
        for (int axis = 0; axis < 3; ++axis)
        {
          beside.Origin[axis] += x * rays.OriginStepX[axis] + y * rays.OriginStepY[axis];
          beside.Direction[axis] += x * rays.DirectionStepX[axis] + y * rays.DirectionStepY[axis];
        }
        const ReferenceImage image =
          tetralux::RenderReference(box, this->Scene.Function, beside, limits);
        for (std::size_t pixel = 0; pixel < image.Length.size(); ++pixel)
        {
          if ((image.Length[pixel] > 0) != (this->Expected.Length[pixel] > 0))
          {
            this->Silhouette[pixel] = true;
          }
        }
      }
    }
  }

  void Compare(const std::string& name, vtkTetrahedraVolumeMapper* mapper, double tolerance)
  {
    SCOPED_TRACE(name);
    this->Scene.Use(mapper);
    this->Scene.Window->Render();
    double largest = 0;
    double covered = 0;
    int off = 0;
    for (std::size_t pixel = 0; pixel < this->Silhouette.size(); ++pixel)
    {
      double difference = 0;
      for (std::size_t k = 4 * pixel; k < 4 * pixel + 4; ++k)
      {
        covered = std::max(covered, this->Expected.Rgba[k]);
        difference =
          std::max(difference, std::abs(this->Scene.GetColors()[k] - this->Expected.Rgba[k]));
      }
      if (!this->Silhouette[pixel])
      {
        largest = std::max(largest, difference);
        off += difference > tolerance ? 1 : 0;
      }
    }
    EXPECT_GT(covered, 0.1);
    EXPECT_LE(largest, tolerance) << off << " pixels";
    auto& [pixels, worst] = this->PixelsOff[name];
    pixels += off;
    worst = std::max(worst, largest);
  }

  RayCastScene Scene;
  vtkNew<vtkTetrahedraRayCastMapper> RayCast;
  vtkNew<vtkTetrahedraRayCastMapper> Double;
  vtkNew<vtkTetrahedraGPURayCastMapper> Gpu;
  vtkNew<vtkTetrahedraGPURayCastMapper> Layers;
  vtkNew<vtkTetrahedraProjectionMapper> Projection;
  ReferenceImage Expected;
  std::vector<bool> Silhouette;
  std::map<std::string, std::pair<int, double>> PixelsOff;
};

TEST_F(HangingNodes, NineCubes) { this->ExpectBox({ tetralux::MakeNineCubes(), { 1, 0.5, 0.5 } }); }

TEST_F(HangingNodes, Octree) { this->ExpectBox({ tetralux::MakeOctree(3, 1), { 1, 1, 1 } }); }

TEST_F(HangingNodes, OtherOctree) { this->ExpectBox({ tetralux::MakeOctree(3, 2), { 1, 1, 1 } }); }

/// Two lattices that share the corners of the plane between them and no other point.
TEST_F(HangingNodes, SlideLine)
{
  TetrahedralMesh mesh = tetralux::MakeBox(4, 4, 2, { 0, 0, 0 }, { 1, 1, 0.25 }, 0.15);
  tetralux::AddMesh(mesh, tetralux::MakeBox(7, 5, 3, { 0, 0, 0.25 }, { 1, 1, 1 }, 0.15));
  this->ExpectBox({ mesh, { 1, 1, 1 } });
}

} // namespace
