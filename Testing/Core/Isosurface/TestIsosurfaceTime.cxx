// SPDX-License-Identifier: BSD-3-Clause

// What a tracer keeps between two pictures, and what it makes anew.

#include "Generate/GeneratedMeshes.h"
#include "Isosurface/IsosurfaceTracer.h"
#include "IsosurfacePictures.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace tetralux
{
namespace
{

using Names = std::vector<std::string>;

/// A moment of the swinging ball, with the points and scalars of the input.
RayScene MakeScene(double time, bool shaded)
{
  RayScene scene = MakeIsosurfaceScene("swinging-ball", { { "cells", 10 }, { "time", time } });
  scene.Isosurfaces = { { 0.3, { 1, 0.5f, 0 }, 0.6f }, { 0.6, { 0, 0.5f, 1 }, 0.6f } };
  scene.Grid = MakeOuterGrid(scene.Mesh, false, 37, 29);
  scene.Shaded = shaded;
  scene.SmoothShading = true;
  scene.Lights = MakeIsosurfaceLights(scene.Mesh);
  return scene;
}

/// The same with other scalars: those of the ball swing with its points.
RayScene WithOtherScalars(RayScene scene)
{
  for (double& scalar : scene.Scalars)
  {
    scalar = 0.9 * scalar + 0.05;
  }
  return scene;
}

/// A tracer and a volume that are kept, while mesh and scalars of a scene change.
class KeptTracer
{
public:
  KeptTracer(const RayScene& scene, Isopolygons polygons)
    : Scene(scene)
    , Volume(scene.MakeVolumeScene())
  {
    this->Options.Polygons = polygons;
    this->Options.Shadows = true;
    this->Options.StepCacheBytes = 0;
  }

  void SetScalars(const RayScene& scene)
  {
    this->Scene.Scalars = scene.Scalars;
    this->Volume.Mesh.SetPointScalars(this->Sort(scene.Scalars, 1));
  }
  void SetPoints(const RayScene& scene)
  {
    this->Scene.Mesh.Points = scene.Mesh.Points;
    ASSERT_TRUE(this->Volume.Mesh.SetPoints(this->Sort(scene.Mesh.Points, 3)));
  }

  /// Draws a picture that must be that of a new tracer, and must rebuild what is named.
  void Expect(const Names& rebuilt)
  {
    const TracedPicture picture =
      TracePicture(this->Tracer, this->Volume, this->Scene, this->Options);
    EXPECT_EQ(picture.Statistics.Rebuilt, rebuilt);
    EXPECT_GT(picture.Statistics.Hits, 100);
    EXPECT_TRUE(IsSame(picture, TracePicture(this->Scene, this->Options)));
  }

  RayScene Scene;
  VolumeScene Volume;
  IsosurfaceOptions Options;

private:
  /// In the order of the mesh that is traced.
  std::vector<double> Sort(const std::vector<double>& values, int components) const
  {
    std::vector<double> sorted;
    for (const std::int64_t id : this->Volume.Mesh.GetMesh()->GetMesh().OriginalPoints)
    {
      sorted.insert(sorted.end(), &values[components * id], &values[components * id] + components);
    }
    return sorted;
  }

  IsosurfaceTracer Tracer;
};

TEST(IsosurfaceTime, RebuildsPrecomputedPolygons)
{
  const RayScene first = MakeScene(0.1, false);
  const RayScene second = MakeScene(0.35, false);
  ASSERT_EQ(first.Mesh.Cells, second.Mesh.Cells);
  ASSERT_NE(first.Mesh.Points, second.Mesh.Points);
  const RayScene other = WithOtherScalars(first);
  KeptTracer tracer(first, Isopolygons::Precomputed);
  tracer.Expect({ "tree", "ranges", "isopolygons" });
  tracer.Expect({});
  tracer.SetScalars(other);
  tracer.Expect({ "ranges", "isopolygons" });
  tracer.SetPoints(second);
  tracer.Expect({ "boxes", "isopolygons" });
  tracer.SetPoints(first);
  tracer.SetScalars(first);
  tracer.Expect({ "boxes", "ranges", "isopolygons" });
  tracer.Expect({});

  // Another view, other colours and other values.
  tracer.Scene.Grid = MakeOuterGrid(first.Mesh, true, 20, 30);
  tracer.Expect({});
  tracer.Scene.Isosurfaces[0].Opacity = 0.9f;
  tracer.Scene.Isosurfaces[1].Color[0] = 0.9f;
  tracer.Volume.Optics.SetIsosurfaces(tracer.Scene.Isosurfaces);
  tracer.Expect({});
  tracer.Scene.Isosurfaces[0].Value = 0.4;
  tracer.Volume.Optics.SetIsosurfaces(tracer.Scene.Isosurfaces);
  tracer.Expect({ "isopolygons" });
}

TEST(IsosurfaceTime, RebuildsGradients)
{
  const RayScene first = MakeScene(0.1, true);
  const RayScene second = MakeScene(0.35, true);
  const RayScene other = WithOtherScalars(first);
  KeptTracer tracer(first, Isopolygons::Precomputed);
  tracer.Expect({ "tree", "ranges", "isopolygons", "gradients" });
  tracer.Expect({});
  tracer.SetScalars(other);
  tracer.Expect({ "ranges", "isopolygons", "gradients" });
  tracer.SetPoints(second);
  tracer.Expect({ "boxes", "isopolygons", "gradients" });
  tracer.Scene.SmoothShading = false;
  tracer.Expect({ "gradients" });
}

TEST(IsosurfaceTime, KeepsSteps)
{
  const RayScene first = MakeScene(0.1, true);
  const RayScene second = WithOtherScalars(MakeScene(0.35, true));
  KeptTracer tracer(first, Isopolygons::Precomputed);
  tracer.Options.StepCacheBytes = std::size_t{ 64 } << 20;
  tracer.Expect({ "tree", "ranges", "isopolygons", "gradients" });
  tracer.SetScalars(second);
  tracer.Expect({ "ranges", "isopolygons", "gradients" });
  tracer.SetPoints(second);
  tracer.Expect({ "boxes", "isopolygons", "gradients" });
  // Each comes back, in any order.
  tracer.SetPoints(first);
  tracer.Expect({});
  tracer.SetScalars(first);
  tracer.Expect({});
  tracer.SetPoints(second);
  tracer.SetScalars(second);
  tracer.Expect({});
  // Not those that there was no room for.
  tracer.Options.StepCacheBytes = 1;
  tracer.Expect({});
  tracer.SetScalars(first);
  tracer.Expect({ "ranges", "isopolygons", "gradients" });
  tracer.SetScalars(second);
  tracer.Expect({ "ranges", "isopolygons", "gradients" });
}

TEST(IsosurfaceTime, KeepsNoPolygonsOnTheFly)
{
  const RayScene first = MakeScene(0.1, true);
  const RayScene second = MakeScene(0.35, true);
  KeptTracer tracer(first, Isopolygons::OnTheFly);
  tracer.Expect({ "tree", "ranges" });
  tracer.Expect({});
  tracer.SetPoints(second);
  tracer.Expect({ "boxes" });
  tracer.Scene.Isosurfaces[0].Value = 0.4;
  tracer.Volume.Optics.SetIsosurfaces(tracer.Scene.Isosurfaces);
  tracer.Expect({});
  tracer.SetScalars(WithOtherScalars(second));
  tracer.Expect({ "ranges" });
}

TEST(IsosurfaceTime, RebuildsTrees)
{
  KeptTracer tracer(MakeScene(0.1, false), Isopolygons::Precomputed);
  tracer.Expect({ "tree", "ranges", "isopolygons" });
  tracer.Options.Build = TreeBuild::SurfaceArea;
  tracer.Expect({ "tree", "ranges", "isopolygons" });

  // Other cells.
  tracer.Scene = MakeIsosurfaceScene("random", { { "cells", 8 } });
  tracer.Scene.Grid = MakeOuterGrid(tracer.Scene.Mesh, false, 37, 29);
  tracer.Volume.Mesh.SetMesh(std::make_shared<WalkMesh>(tracer.Scene.Mesh));
  tracer.SetScalars(tracer.Scene);
  tracer.Volume.Optics.SetIsosurfaces(tracer.Scene.Isosurfaces);
  tracer.Expect({ "tree", "ranges", "isopolygons" });
}

TEST(IsosurfaceTime, GoesBetweenBothKindsOfPolygons)
{
  KeptTracer tracer(MakeScene(0.1, true), Isopolygons::Precomputed);
  tracer.Expect({ "tree", "ranges", "isopolygons", "gradients" });
  tracer.Options.Polygons = Isopolygons::OnTheFly;
  tracer.Expect({});
  tracer.SetScalars(WithOtherScalars(MakeScene(0.35, true)));
  tracer.Expect({ "ranges" });
  tracer.Options.Polygons = Isopolygons::Precomputed;
  tracer.Expect({ "isopolygons", "gradients" });
}

TEST(IsosurfaceTime, RefusesWhatItCannotDraw)
{
  RayScene scene = MakeScene(0.1, false);
  VolumeScene volume = scene.MakeVolumeScene();
  IsosurfaceTracer tracer;
  std::vector<float> colors(4 * 37 * 29), depths(37 * 29);
  std::vector<float> few(7);
  EXPECT_THROW(tracer.Trace(volume, scene.Grid, {}, {}, few, depths), std::invalid_argument);
  EXPECT_THROW(tracer.Trace(volume, scene.Grid, {}, {}, colors, few), std::invalid_argument);
  RayGrid sheet = scene.Grid; // all rays in a plane
  std::copy_n(sheet.DirectionStepX, 3, sheet.DirectionStepY);
  EXPECT_THROW(tracer.Trace(volume, sheet, {}, {}, colors, depths), std::invalid_argument);
  RayGrid neither = scene.Grid; // of no common origin or direction
  neither.OriginStepX[0] = 1;
  EXPECT_THROW(tracer.Trace(volume, neither, {}, {}, colors, depths), std::invalid_argument);
  volume.Mesh.SetCellScalars(std::vector<double>(volume.Mesh.GetMesh()->GetNumberOfCells(), 1.));
  EXPECT_THROW(tracer.Trace(volume, scene.Grid, {}, {}, colors, depths), std::invalid_argument);
}

TEST(IsosurfaceTime, StopsWhereItIsAsked)
{
  RayScene scene = MakeScene(0.1, false);
  scene.Grid = MakeOuterGrid(scene.Mesh, false, 200, 200);
  IsosurfaceOptions options;
  options.NumberOfThreads = 1; // it reports after its first packets, with no others to wait for
  options.Progress = [](double) { return false; };
  EXPECT_TRUE(TracePicture(scene, options).Statistics.Aborted);
  options.Progress = [](double share) { return 0 <= share && share <= 1; };
  EXPECT_FALSE(TracePicture(scene, options).Statistics.Aborted);
}

} // namespace
} // namespace tetralux
