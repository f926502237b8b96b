// SPDX-License-Identifier: BSD-3-Clause

// Rays drawn through meshes, and what tables are estimated to be wrong by on them against whole
// pictures.

#include "Walk/MeshRays.h"

#include "Generate/GeneratedMeshes.h"
#include "PreIntegration/PreIntegrationBuilder.h"
#include "PreIntegration/PreIntegrationError.h"
#include "PreIntegration/TableChoice.h"
#include "RayScene.h"
#include "ThreadCounts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace
{

using namespace tetralux;

/// One coordinate of the points of a mesh, in the order of its tables.
std::vector<double> GetCoordinate(const WalkMesh& mesh, int axis)
{
  std::vector<double> x;
  for (std::size_t i = axis; i < mesh.GetMesh().Points.size(); i += 3)
  {
    x.push_back(mesh.GetMesh().Points[i]);
  }
  return x;
}

/// The coordinates as scalars tell where the segments are: straight on along a line, and as long as
/// they say.
TEST(MeshRays, AreStraightLines)
{
  for (const char* name : { "ball", "ring", "heat-sink", "boundary-layer" })
  {
    SCOPED_TRACE(name);
    std::map<std::string, double> parameters;
    if (std::string(name) == "ball")
    {
      parameters["cells"] = 8;
    }
    const WalkMesh mesh(GenerateMesh(name, parameters).Mesh);
    constexpr double Scale = 3;
    RaySample rays[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      rays[axis] = DrawMeshRays(mesh, GetCoordinate(mesh, axis), Scale);
    }
    ASSERT_GE(rays[0].Rays.size(), 64U);
    const double tolerance = 1e-6 * mesh.GetRadius();
    for (std::size_t i = 0; i < rays[0].Rays.size(); ++i)
    {
      ASSERT_FALSE(rays[0].Rays[i].empty()); // each goes through the cell it was drawn in
      std::array<double, 3> begin{}, end{};
      double last = -std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < rays[0].Rays[i].size(); ++k)
      {
        double length = 0, along = 0;
        for (int axis = 0; axis < 3; ++axis)
        {
          const RaySegment& segment = rays[axis].Rays[i][k];
          begin[axis] = k == 0 ? segment.Front : begin[axis];
          end[axis] = rays[axis].Rays[i].back().Back;
          length = std::hypot(length, segment.Back - segment.Front);
        }
        const double whole = std::hypot(end[0] - begin[0], end[1] - begin[1], end[2] - begin[2]);
        for (int axis = 0; axis < 3; ++axis)
        {
          along += (rays[axis].Rays[i][k].Front - begin[axis]) * (end[axis] - begin[axis]) / whole;
        }
        EXPECT_NEAR(rays[0].Rays[i][k].Length, Scale * length, Scale * tolerance);
        EXPECT_GT(rays[0].Rays[i][k].Length, 0);
        EXPECT_GE(along, last - tolerance);
        last = along + length; // gaps between parts of the mesh are none of the segments
      }
    }
  }
}

/// Through a convex mesh there are no gaps, and rays come from everywhere.
TEST(MeshRays, GoThroughAllOfTheMesh)
{
  const WalkMesh mesh(MakeBox(5, 5, 5, { 0, 0, 0 }, { 1, 1, 1 }, 0.1));
  const std::vector<double> x = GetCoordinate(mesh, 0);
  double lo = 1, hi = 0, mean = 0;
  const RaySample sample = DrawMeshRays(mesh, x, 1);
  for (const std::vector<RaySegment>& ray : sample.Rays)
  {
    double path = 0;
    for (std::size_t k = 0; k < ray.size(); ++k)
    {
      path += ray[k].Length;
      lo = std::min(lo, ray[k].Front);
      hi = std::max(hi, ray[k].Front);
      if (k > 0)
      {
        EXPECT_NEAR(ray[k].Front, ray[k - 1].Back, 1e-9);
      }
    }
    EXPECT_LE(path, 1.0001 * std::sqrt(3.));
    mean += path / static_cast<double>(sample.Rays.size());
  }
  EXPECT_LT(lo, 1e-3);
  EXPECT_GT(hi, 0.999);
  // Lines through random points in random directions: longer than the mean chord, 2/3.
  EXPECT_GT(mean, 0.8);
  EXPECT_LT(mean, 1.1);
}

TEST(MeshRays, LeaveOutWhatHasNoScalar)
{
  const WalkMesh mesh(MakeBox(3, 3, 3, { 0, 0, 0 }, { 1, 1, 1 }, 0));
  std::vector<double> scalars = GetCoordinate(mesh, 0);
  std::replace_if(
    scalars.begin(), scalars.end(), [](double s) { return s > 0.9; },
    std::numeric_limits<double>::quiet_NaN());
  for (const std::vector<RaySegment>& ray : DrawMeshRays(mesh, scalars, 1).Rays)
  {
    for (const RaySegment& segment : ray)
    {
      EXPECT_LE(std::max(segment.Front, segment.Back), 0.67);
    }
  }
  scalars.assign(scalars.size(), std::numeric_limits<double>::infinity());
  for (const std::vector<RaySegment>& ray : DrawMeshRays(mesh, scalars, 1).Rays)
  {
    EXPECT_TRUE(ray.empty());
  }
}

TEST(MeshRays, OfNoCellsAreNone)
{
  EXPECT_TRUE(DrawMeshRays(WalkMesh(TetrahedralMesh()), {}, 1).Rays.empty());
}

TEST(MeshRays, ThreadsDoNotMatter)
{
  const WalkMesh mesh(GenerateMesh("ball", { { "cells", 10 } }).Mesh);
  const std::vector<double> x = GetCoordinate(mesh, 0);
  const RaySample expected = DrawMeshRays(mesh, x, 1);
  ForEachThreadCount(
    [&]()
    {
      const RaySample found = DrawMeshRays(mesh, x, 1);
      ASSERT_EQ(found.Rays.size(), expected.Rays.size());
      for (std::size_t i = 0; i < found.Rays.size(); ++i)
      {
        EXPECT_TRUE(std::equal(found.Rays[i].begin(), found.Rays[i].end(), expected.Rays[i].begin(),
          expected.Rays[i].end(),
          [](const RaySegment& a, const RaySegment& b)
          { return a.Front == b.Front && a.Back == b.Back && a.Length == b.Length; }));
      }
    });
}

// ------------------------------------------------------------------------------------------------
// Estimates

struct NamedFunction
{
  const char* Name;
  TransferFunction Function; ///< over 0..1, of a mesh of radius 1
};

std::vector<NamedFunction> MakeFunctions()
{
  const auto make = [](const std::vector<std::array<double, 5>>& points)
  { return MakeLinearFunction(points); };
  return { { "smooth",
             make({ { 0, 0, 0, 1, 0 }, { 0.15, 0, 1, 1, 0.1 }, { 0.3, 0, 1, 0, 2 },
               { 0.45, 1, 1, 0, 0.2 }, { 1, 1, 0, 0, 4 } }) },
    { "peak",
      make({ { 0, 1, 0.8, 0.5, 0 }, { 0.44, 1, 0.8, 0.5, 0 }, { 0.45, 1, 0.8, 0.5, 200 },
        { 0.46, 0.3, 0.5, 1, 0 }, { 1, 0.3, 0.5, 1, 0 } }) },
    { "steps",
      make({ { 0, 0, 0, 1, 0 }, { 0.2999, 0, 0, 1, 0 }, { 0.3, 0, 1, 0, 2 }, { 0.4999, 0, 1, 0, 2 },
        { 0.5, 1, 0.5, 0, 0.3 }, { 1, 1, 1, 0, 3 } }) } };
}

/// A mesh with scalars from 0 to 1.
RayScene MakeScene(const std::string& name, const std::map<std::string, double>& parameters)
{
  const GeneratedMesh generated = GenerateMesh(name, parameters);
  const auto [lo, hi] = std::minmax_element(generated.Scalars.begin(), generated.Scalars.end());
  RayScene scene;
  scene.Mesh = generated.Mesh;
  for (const double s : generated.Scalars)
  {
    scene.Scalars.push_back((s - *lo) / (*hi - *lo));
  }
  return scene;
}

/// Largest error of a channel by a table, of pictures from three sides.
double MeasurePictures(
  VolumeScene& volume, RayScene& scene, const std::shared_ptr<const PreIntegrationTable>& table)
{
  RayCastOptions options;
  options.Arithmetic = Precision::Double;
  options.MaximumError = 1e-7;
  const WalkMesh& mesh = *volume.Mesh.GetMesh();
  double largest = 0;
  using Vector = std::array<double, 3>;
  for (const Vector& direction :
    { Vector{ 2.1, 1.6, 2.6 }, Vector{ -2, 3, -1.2 }, Vector{ 3.6, 0.02, 0.01 } })
  {
    Vector center{}, eye{};
    for (int axis = 0; axis < 3; ++axis)
    {
      center[axis] = mesh.GetCenter()[axis];
      eye[axis] = center[axis] + direction[axis] * mesh.GetRadius();
    }
    constexpr int Size = 128;
    scene.Grid = MakePerspectiveGrid(eye, center, { 0.1, 1, 0.2 }, 32, Size, Size);
    volume.Optics.SetTable(nullptr, 0);
    const RayPicture exact = Cast(volume, scene, options);
    volume.Optics.SetTable(table, 0);
    const RayPicture picture = Cast(volume, scene, options);
    for (std::size_t i = 0; i < exact.Colors.size(); ++i)
    {
      largest = std::max<double>(largest, std::abs(exact.Colors[i] - picture.Colors[i]));
    }
  }
  return largest;
}

/// Calls visit(name, scene, volume) for meshes and functions of all kinds.
template <class Visit>
void ForEachScene(const Visit& visit)
{
  struct Case
  {
    const char* Mesh;
    std::map<std::string, double> Parameters;
    double Density; ///< of the attenuation
  };
  const Case cases[] = { { "ball", { { "cells", 24 } }, 1 },
    { "ring", { { "around", 80 }, { "across", 6 } }, 1 },
    { "heat-sink", { { "fins", 5 }, { "cells", 2 } }, 1 },
    { "boundary-layer", { { "cells", 12 }, { "layers", 24 } }, 1 },
    { "boundary-layer", { { "cells", 12 }, { "layers", 24 } }, 1000 },
    { "random", { { "cells", 10 } }, 3 } };
  for (const Case& c : cases)
  {
    RayScene scene = MakeScene(c.Mesh, c.Parameters);
    for (const NamedFunction& named : MakeFunctions())
    {
      scene.Function = named.Function;
      VolumeScene volume = scene.MakeVolumeScene();
      for (TransferFunction::Node& node : scene.Function.Nodes)
      {
        node.Left.Attenuation *= c.Density / volume.Mesh.GetMesh()->GetRadius();
        node.Right.Attenuation *= c.Density / volume.Mesh.GetMesh()->GetRadius();
      }
      volume.Optics.SetTransferFunction(scene.Function);
      visit(std::string(c.Mesh) + ", " + named.Name, scene, volume);
    }
  }
}

TEST(TableEstimates, AreAsLargeAsTheErrorsOfPictures)
{
  struct Size
  {
    int Scalars, Lengths, Steps;
    ScalarAxis Axis;
    TexelFormat Format;
  };
  const Size sizes[] = { { 256, 16, 2, ScalarAxis::Uniform, TexelFormat::Float },
    { 64, 32, 0, ScalarAxis::Nodes, TexelFormat::Half },
    { 128, 49, 4, ScalarAxis::Nodes, TexelFormat::UNorm16 },
    { 64, 25, 2, ScalarAxis::Uniform, TexelFormat::UNorm8 } };
  std::vector<double> ratios; // of estimates to errors
  ForEachScene(
    [&](const std::string& name, RayScene& scene, VolumeScene& volume)
    {
      for (const Size& size : sizes)
      {
        PreIntegrationSettings settings;
        settings.ScalarSize = size.Scalars;
        settings.LengthSize = size.Lengths;
        settings.Scale = size.Steps > 0 ? LengthScale::Logarithmic : LengthScale::Linear;
        settings.StepsPerDoubling = std::max(size.Steps, 1);
        settings.Axis = size.Axis;
        settings.Format = size.Format;
        volume.Mesh.PrepareLongestEdge();
        settings.LongestSegment = volume.Mesh.GetLongestEdge();
        const auto table = std::make_shared<PreIntegrationTable>();
        BuildPreIntegrationTable(scene.Function, settings, *table);
        const double estimate =
          EstimatePictureError(scene.Function, *table, *volume.Mesh.DrawRays(1));
        const double error = MeasurePictures(volume, scene, table);
        ratios.push_back(estimate / error);
        EXPECT_GE(estimate, error / 3) << name << ", " << size.Scalars << " scalars";
        EXPECT_LE(estimate, 1);
      }
    });
  // Nearly all are as large as the errors. Next to steps the largest error is that of one segment,
  // which a few small pictures may miss: some are more than ten times as large.
  std::sort(ratios.begin(), ratios.end());
  const auto at = [&](double share)
  { return ratios[static_cast<std::size_t>(share * static_cast<double>(ratios.size()))]; };
  EXPECT_GE(at(0.05), 1);
  EXPECT_LE(at(0.5), 5);
  EXPECT_LE(at(0.9), 16);
}

TEST(TableEstimates, ChosenTablesAreRightEnough)
{
  int tables = 0;
  ForEachScene(
    [&](const std::string& name, RayScene& scene, VolumeScene& volume)
    {
      TableGoal goal;
      goal.MaximumError = 0.02;
      goal.MaximumBytes = std::size_t{ 1 } << 24;
      goal.LookupCost = 0;
      goal.Rays = volume.Mesh.DrawRays(1);
      volume.Mesh.PrepareLongestEdge();
      goal.LongestSegment = volume.Mesh.GetLongestEdge();
      const TableChoice choice = ChoosePreIntegrationTable(scene.Function, goal);
      if (choice.Table)
      {
        ++tables;
        EXPECT_LE(MeasurePictures(volume, scene, choice.Table), goal.MaximumError) << name;
      }
    });
  EXPECT_GE(tables, 8);
}

} // namespace
