// SPDX-License-Identifier: BSD-3-Clause
#include "Convexify/Convexification.h"

#include "Generate/GeneratedMeshes.h"
#include "Mesh/FaceNeighbors.h"
#include "Mesh/MeshCleaning.h"
#include "MeshParts.h"
#include "ReferenceConvexity.h"
#include "ThreadCounts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace
{

using tetralux::AddMesh;
using tetralux::Convexification;
using tetralux::TetrahedralMesh;

Convexification Fill(TetrahedralMesh& mesh, const std::function<bool(double)>& progress = {})
{
  tetralux::RemoveUnusableCells(mesh);
  return tetralux::Convexify(mesh,
    tetralux::FindFaceNeighbors(mesh.Cells, mesh.GetNumberOfPoints()),
    tetralux::TouchingCells::Join, progress);
}

tetralux::ConvexifiedMesh Join(const TetrahedralMesh& mesh, const Convexification& result)
{
  tetralux::ConvexifiedMesh whole = { mesh.Points, mesh.Cells, result.Cells };
  whole.Points.insert(whole.Points.end(), result.SteinerPoints.begin(), result.SteinerPoints.end());
  return whole;
}

/// Runs and checks everything that must hold of a mesh that can be convexified.
Convexification FillAndCheck(TetrahedralMesh mesh, int numberOfRays = 300)
{
  Convexification result = Fill(mesh);
  EXPECT_EQ(result.Refusal, "");
  EXPECT_FALSE(result.Convex);
  EXPECT_GT(result.GetNumberOfCells(), 0);
  EXPECT_NEAR(
    result.HullVolume, result.MeshVolume + result.ImaginaryVolume, 1e-9 * result.HullVolume);
  const tetralux::ConvexifiedMesh whole = Join(mesh, result);
  EXPECT_EQ(
    tetralux::CheckConvexity(whole, static_cast<std::int32_t>(mesh.GetNumberOfPoints())), "");
  const tetralux::RayAgreement rays = tetralux::CompareRays(whole, numberOfRays, 7);
  EXPECT_EQ(rays.Agreeing, rays.Rays);
  EXPECT_TRUE(rays.Crossings > 0 || numberOfRays == 0);
  return result;
}

TetrahedralMesh Generate(
  const std::string& name, const std::map<std::string, double>& parameters = {})
{
  return tetralux::GenerateMesh(name, parameters).Mesh;
}

/// Moves and stretches all points.
void Transform(
  TetrahedralMesh& mesh, const std::array<double, 9>& matrix, const std::array<double, 3>& shift)
{
  for (std::size_t p = 0; p < mesh.Points.size(); p += 3)
  {
    const double x = mesh.Points[p], y = mesh.Points[p + 1], z = mesh.Points[p + 2];
    for (int a = 0; a < 3; ++a)
    {
      mesh.Points[p + a] =
        matrix[3 * a] * x + matrix[3 * a + 1] * y + matrix[3 * a + 2] * z + shift[a];
    }
  }
}

} // namespace

TEST(Convexification, NamedMeshes)
{
  const std::pair<const char*, std::map<std::string, double>> meshes[] = {
    { "ball", { { "cells", 8 } } }, // rough: not convex
    { "ring", { { "around", 24 }, { "across", 3 } } },
    { "cylinder-with-hole", { { "across", 2 }, { "around", 24 }, { "along", 6 } } },
    { "heat-sink", { { "fins", 3 }, { "cells", 2 }, { "length", 3 } } },
    { "gear", { { "teeth", 8 }, { "across", 3 }, { "along", 3 } } },
    { "cubes", { { "count", 2 }, { "cells", 2 } } },
    { "cavity", { { "cells", 6 } } },
    { "shared-edge", { { "cells", 3 } } },
    { "checkerboard", { { "blocks", 3 }, { "cells", 2 } } },
    { "cycle", { { "cells", 1 } } },
    { "random", { { "cells", 5 }, { "removed", 0.3 } } },
  };
  for (const auto& [name, parameters] : meshes)
  {
    SCOPED_TRACE(name);
    FillAndCheck(Generate(name, parameters));
  }
}

TEST(Convexification, PocketsThatGetStuck)
{
  // A twisted gear, and a notch that can't be filled without a point of its own.
  FillAndCheck(Generate("helical-gear", { { "teeth", 3 }, { "across", 2 }, { "along", 8 } }));
  for (const int cells : { 1, 2 })
  {
    SCOPED_TRACE(cells);
    FillAndCheck(Generate("schoenhardt", { { "cells", static_cast<double>(cells) } }));
  }
}

TEST(Convexification, ConvexMeshIsLeftAlone)
{
  for (TetrahedralMesh mesh : { Generate("boundary-layer", { { "cells", 4 }, { "layers", 8 } }),
         Generate("random", { { "cells", 4 }, { "removed", 0 } }), TetrahedralMesh{} })
  {
    const Convexification result = Fill(mesh);
    EXPECT_TRUE(result.Convex);
    EXPECT_EQ(result.Refusal, "");
    EXPECT_EQ(result.GetNumberOfCells(), 0);
    EXPECT_EQ(result.GetNumberOfSteinerPoints(), 0);
  }
  TetrahedralMesh cell{ { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 }, { 0, 2, 1, 3 }, {}, {}, {} };
  EXPECT_TRUE(Fill(cell).Convex);
}

TEST(Convexification, OneMissingCell)
{
  // Coplanar, collinear and cocircular points all around.
  TetrahedralMesh mesh = Generate("random", { { "cells", 3 }, { "jitter", 0 }, { "removed", 0 } });
  for (const std::size_t missing : { 22u, 60u, 62u, 66u, 69u })
  {
    SCOPED_TRACE(missing);
    TetrahedralMesh holed = mesh;
    holed.Cells.erase(holed.Cells.begin() + static_cast<std::ptrdiff_t>(4 * missing),
      holed.Cells.begin() + static_cast<std::ptrdiff_t>(4 * missing + 4));
    const Convexification result = FillAndCheck(holed);
    EXPECT_NEAR(result.ImaginaryVolume, 1 - result.MeshVolume, 1e-12);
  }
}

TEST(Convexification, FarAwayStretchedAndTurned)
{
  const TetrahedralMesh cavity = Generate("cavity", { { "cells", 4 } });
  const TetrahedralMesh cubes = Generate("cubes", { { "count", 2 }, { "cells", 2 } });
  for (const TetrahedralMesh* source : { &cavity, &cubes })
  {
    TetrahedralMesh far = *source;
    Transform(far, { 1e-3, 0, 0, 0, 1e-3, 0, 0, 0, 1e-3 }, { 1e7, -1e7, 1e7 });
    FillAndCheck(far, 0);

    // Areas over twelve orders of magnitude.
    TetrahedralMesh stretched = *source;
    Transform(stretched, { 1e6, 0, 0, 0, 1, 0, 0, 0, 1e-6 }, { 0, 0, 0 });
    FillAndCheck(stretched, 0);

    TetrahedralMesh turned = *source;
    Transform(turned, { 0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6 }, { 0.1, 0.2, 0.3 });
    FillAndCheck(turned);
  }
}

TEST(Convexification, PartsThatTouchInAPoint)
{
  TetrahedralMesh mesh = { { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, -1, 0, 0, 0, -1, 0, 0, 0, -1 },
    { 0, 1, 2, 3, 0, 5, 4, 6 }, {}, {}, {} };
  FillAndCheck(mesh);
}

TEST(Convexification, PartsAtTheSamePlaceAreOne)
{
  // Two boxes side by side with points of their own, as the blocks of a composite come.
  TetrahedralMesh mesh = Generate("cavity", { { "cells", 4 } });
  TetrahedralMesh other = mesh;
  Transform(other, { -1, 0, 0, 0, 1, 0, 0, 0, 1 }, { 0, 0, 0 });
  AddMesh(mesh, other);
  const Convexification result = FillAndCheck(mesh);
  EXPECT_NEAR(result.HullVolume, 2, 1e-12);
}

TEST(Convexification, OrderOfPointsDoesNotMatter)
{
  TetrahedralMesh mesh = Generate("ring", { { "around", 12 }, { "across", 2 } });
  const Convexification expected = FillAndCheck(mesh);
  std::mt19937_64 random(3);
  for (std::size_t cell = 0; cell < mesh.Cells.size(); cell += 4)
  {
    std::shuffle(&mesh.Cells[cell], &mesh.Cells[cell] + 4, random);
  }
  const Convexification result = FillAndCheck(mesh);
  EXPECT_EQ(result.GetNumberOfCells(), expected.GetNumberOfCells());
}

TEST(Convexification, FlatCells)
{
  // A flat cell lies on the boundary and turns the diagonal of a square of it.
  TetrahedralMesh mesh = { { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, 1, 3, 0.5, 2 },
    { 0, 1, 2, 4, 0, 2, 3, 4, 0, 1, 2, 3, 1, 2, 4, 5 }, {}, {}, {} };
  FillAndCheck(mesh);
}

TEST(Convexification, CollapsedCells)
{
  // Of a pyramid of two cells and one that is collapsed, since two of its points are at the same
  // place, as along the axis of a structured grid that runs around it.
  TetrahedralMesh mesh = { { 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 1, 2, 1, 1, 2, 3, 1, 4 },
    { 0, 1, 2, 4, 0, 2, 4, 5, 0, 2, 3, 5, 1, 2, 4, 6 }, {}, {}, {} };
  FillAndCheck(mesh);
}

TEST(Convexification, SameForAnyNumberOfThreads)
{
  TetrahedralMesh mesh = Generate("gear", { { "teeth", 6 }, { "across", 2 }, { "along", 4 } });
  const Convexification expected = Fill(mesh);
  ForEachThreadCount(
    [&]
    {
      const Convexification result = Fill(mesh);
      EXPECT_EQ(result.Cells, expected.Cells);
      EXPECT_EQ(result.SteinerPoints, expected.SteinerPoints);
    });
}

TEST(Convexification, RefusesWhatMeetsItself)
{
  // A box that another one sticks into, and one that lies inside of it.
  const std::pair<double, double> cases[] = { { 0.55, 0.8 }, { 0.25, 0.5 } };
  for (const auto& [shift, size] : cases)
  {
    SCOPED_TRACE(shift);
    TetrahedralMesh mesh = Generate("random", { { "cells", 3 }, { "removed", 0 } });
    TetrahedralMesh other = mesh;
    Transform(other, { size, 0, 0, 0, size, 0, 0, 0, size }, { shift, shift, shift });
    AddMesh(mesh, other);
    const Convexification result = Fill(mesh);
    EXPECT_NE(result.Refusal, "");
    EXPECT_EQ(result.GetNumberOfCells(), 0);
    EXPECT_EQ(result.GetNumberOfSteinerPoints(), 0);
    for (const double x : result.RefusalPoint)
    {
      EXPECT_GE(x, 0);
      EXPECT_LE(x, 1.35);
    }
  }

  // Two cells through each other: which ones is said, too.
  TetrahedralMesh crossing = { { 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2, 0.5, 0.5, -1, 0.6, 0.5, -1,
                                 0.5, 0.6, -1, 0.5, 0.5, 5 },
    { 0, 1, 2, 3, 4, 5, 6, 7 }, {}, {}, {} };
  const Convexification result = Fill(crossing);
  EXPECT_NE(result.Refusal.find("intersects itself"), std::string::npos) << result.Refusal;
  EXPECT_EQ(std::minmax(result.RefusalCells[0], result.RefusalCells[1]), std::minmax(0, 1));
}

TEST(Convexification, RefusesFlatMeshes)
{
  TetrahedralMesh flat = { { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0 }, { 0, 1, 2, 3 }, {}, {}, {} };
  EXPECT_NE(Fill(flat).Refusal, "");
  TetrahedralMesh line = { { 0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0 }, { 0, 1, 2, 3 }, {}, {}, {} };
  EXPECT_NE(Fill(line).Refusal, "");
}

TEST(Convexification, ProgressAndAbort)
{
  TetrahedralMesh mesh = Generate("cavity", { { "cells", 5 } });
  std::vector<double> fractions;
  Fill(mesh,
    [&fractions](double fraction)
    {
      fractions.push_back(fraction);
      return true;
    });
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  ASSERT_FALSE(fractions.empty());
  EXPECT_EQ(fractions.back(), 1);
  const std::size_t numberOfCalls = fractions.size();
  for (std::size_t last = 0; last + 1 < numberOfCalls; ++last)
  {
    std::size_t calls = 0;
    const Convexification result = Fill(mesh, [&](double) { return calls++ < last; });
    EXPECT_TRUE(result.Aborted);
    EXPECT_EQ(result.Refusal, "");
    EXPECT_EQ(result.GetNumberOfCells(), 0);
    EXPECT_EQ(calls, last + 1);
  }
}

/// Random subsets of the cells of a lattice whose points moved: any non-convex, non-manifold shape.
TEST(Convexification, RandomSubsets)
{
  int filled = 0;
  for (int seed = 1; seed <= 40; ++seed)
  {
    SCOPED_TRACE(seed);
    TetrahedralMesh mesh = Generate("random",
      { { "cells", 1. + seed % 4 }, { "jitter", 0.25 * (seed % 5) },
        { "removed", 0.1 + 0.2 * (seed % 4) }, { "seed", static_cast<double>(seed) } });
    if (mesh.Cells.empty())
    {
      continue;
    }
    const Convexification result = Fill(mesh);
    EXPECT_EQ(result.Refusal, "");
    if (result.Refusal.empty() && !result.Convex)
    {
      ++filled;
      EXPECT_EQ(tetralux::CheckConvexity(
                  Join(mesh, result), static_cast<std::int32_t>(mesh.GetNumberOfPoints())),
        "");
    }
  }
  EXPECT_GT(filled, 25);
}

/// Cells of random points, whatever they overlap with: filled and right, or refused with a reason.
TEST(Convexification, AnyInput)
{
  int refused = 0;
  for (int seed = 1; seed <= 300; ++seed)
  {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    // Few distinct coordinates make points coincide and planes common; few cells may be all right.
    const int values = 2 + static_cast<int>(random() % 20);
    const int numberOfPoints = 5 + static_cast<int>(random() % 12);
    const int numberOfCells = 1 + static_cast<int>(random() % (seed % 3 == 0 ? 20 : 3));
    TetrahedralMesh mesh;
    for (int i = 0; i < 3 * numberOfPoints; ++i)
    {
      mesh.Points.push_back(static_cast<double>(random() % values));
    }
    for (int i = 0; i < 4 * numberOfCells; ++i)
    {
      mesh.Cells.push_back(static_cast<std::int32_t>(random() % numberOfPoints));
    }
    const Convexification result = Fill(mesh);
    if (!result.Refusal.empty())
    {
      ++refused;
      EXPECT_EQ(result.GetNumberOfCells(), 0);
    }
    else if (!result.Convex)
    {
      EXPECT_EQ(tetralux::CheckConvexity(
                  Join(mesh, result), static_cast<std::int32_t>(mesh.GetNumberOfPoints())),
        "");
    }
  }
  EXPECT_GT(refused, 10);
  EXPECT_LT(refused, 290);
}

TEST(Convexification, HugeAndTinyCoordinates)
{
  for (const double scale : { 1e-300, 1e-150, 1e150, 1e300 })
  {
    SCOPED_TRACE(scale);
    TetrahedralMesh mesh = Generate("shared-edge", { { "cells", 1 } });
    Transform(mesh, { scale, 0, 0, 0, scale, 0, 0, 0, scale }, { 0, 0, 0 });
    const Convexification result = Fill(mesh);
    EXPECT_TRUE(!result.Refusal.empty() || result.GetNumberOfCells() > 0);
  }
}
