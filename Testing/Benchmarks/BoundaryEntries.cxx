// SPDX-License-Identifier: BSD-3-Clause

// Compares two ways to find where the rays of a perspective picture cross the boundary of a mesh:
//
// hierarchy  each packet of eight rays goes through the boundary's BVH.
// tiles      the boundary faces are sorted into tiles of the picture first (BoundaryTiles.h).
//
// Both decide by the same exact test, so pictures must be the same bits; that is checked. Prints
// processor milliseconds of one thread, the least of some runs that take turns: of finding the
// boundary, by pictures that end in front of it, and of whole pictures.

#include "ComparisonMeshes.h"
#include "RayCast/RayCaster.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <utility>
#include <vector>

namespace
{

using namespace tetralux;

constexpr int Runs = 7;

/// A picture of a mesh, in one of the ways.
struct Way
{
  BoundarySearch Search;
  std::vector<float> Colors, Depths;
  double Find = 1e9;  ///< least seconds
  double Whole = 1e9; ///< least seconds
};

void CompareOn(ComparisonMesh source, int size)
{
  VolumeScene scene;
  scene.Mesh.SetMesh(std::make_shared<WalkMesh>(std::move(source.Mesh)));
  const WalkMesh& mesh = *scene.Mesh.GetMesh();
  const PerspectiveView view(mesh.GetCenter(), mesh.GetRadius(), size);
  // The distance from the centre of the mesh: the picture must not matter to the comparison.
  std::vector<double> scalars;
  for (std::size_t p = 0; p < mesh.GetMesh().GetNumberOfPoints(); ++p)
  {
    const WalkPoint<float>& point = mesh.GetPoints<float>()[p];
    scalars.push_back(point.X * point.X + point.Y * point.Y + point.Z * point.Z);
  }
  scene.Mesh.SetPointScalars(std::move(scalars));
  TransferFunction function;
  const double density = 1 / mesh.GetRadius();
  function.Nodes = { { 0, { { 1, 0, 0 }, density }, { { 1, 0, 0 }, density } },
    { 1, { { 0, 0, 1 }, 0 }, { { 0, 0, 1 }, 0 } } };
  scene.Optics.SetTransferFunction(function);

  RayLimits inFront;
  inFront.Planes = { { view.Forward[0], view.Forward[1], view.Forward[2], 0 } };
  for (int a = 0; a < 3; ++a)
  {
    inFront.Planes[0][a] = -view.Forward[a];
    inFront.Planes[0][3] += view.Forward[a] * view.Position[a];
  }
  Way ways[] = { { BoundarySearch::Hierarchy, {}, {} }, { BoundarySearch::Tiles, {}, {} } };
  RayCastStatistics statistics;
  for (int run = 0; run <= Runs; ++run)
  {
    for (Way& way : ways)
    {
      RayCastOptions options;
      options.NumberOfThreads = 1;
      options.Boundary = way.Search;
      way.Colors.resize(4 * static_cast<std::size_t>(size) * size);
      way.Depths.resize(static_cast<std::size_t>(size) * size);
      const double begin = GetProcessorTime();
      CastRays(scene, view.Grid, inFront, options, way.Colors, way.Depths);
      const double found = GetProcessorTime();
      statistics = CastRays(scene, view.Grid, {}, options, way.Colors, way.Depths);
      const double whole = GetProcessorTime();
      if (run > 0) // the first one makes the tables
      {
        way.Find = std::min(way.Find, found - begin);
        way.Whole = std::min(way.Whole, whole - found);
      }
    }
  }
  const auto differs = [&](auto member)
  {
    const auto& a = ways[0].*member;
    return std::memcmp(a.data(), (ways[1].*member).data(), a.size() * sizeof(float)) != 0;
  };
  std::printf("%-24s %6d %9d %9lld %9s %9.1f %9.1f %9.1f %9.1f\n", source.Name.c_str(), size,
    mesh.GetNumberOfBoundaryFaces(), static_cast<long long>(statistics.Paths),
    differs(&Way::Colors) || differs(&Way::Depths) ? "different" : "same", 1e3 * ways[0].Find,
    1e3 * ways[1].Find, 1e3 * ways[0].Whole, 1e3 * ways[1].Whole);
  std::fflush(stdout);
}

} // namespace

int main()
{
  try
  {
    std::printf(
      "Boundary faces, entries, and processor ms\n\n%-24s %6s %9s %9s %9s %9s %9s %9s %9s\n", "",
      "pixels", "faces", "entries", "bits", "tree", "tiles", "tree: all", "tiles");
    for (const int size : { 512, 1024 })
    {
      for (ComparisonMesh& mesh : ReadBluntFin())
      {
        CompareOn(std::move(mesh), size);
      }
      using Parameters = std::map<std::string, double>;
      const std::pair<const char*, Parameters> generated[] = { { "ball", { { "cells", 34 } } },
        { "ball", { { "cells", 74 } } }, { "ring", { { "around", 130 }, { "across", 12 } } },
        { "ring", { { "around", 300 }, { "across", 26 } } } };
      for (const auto& [name, parameters] : generated)
      {
        CompareOn(MakeComparisonMesh(name, parameters), size);
      }
    }
  }
  catch (const std::exception& e)
  {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
