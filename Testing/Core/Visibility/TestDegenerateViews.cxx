// SPDX-License-Identifier: BSD-3-Clause

// Visibility orders where nothing is left to rounding: viewers exactly at points, on edges and in
// planes of faces, cells a millionth as thick as wide, cells with points of their own, and those
// off by their last bits. All meshes here are Delaunay triangulations, or affine to one, or two of
// them on both sides of a plane. In these no viewer sees a cycle (Edelsbrunner, An Acyclicity
// Theorem for Cell Complexes, 1990): any that is reported is none.

#include "Visibility/VisibilityOrder.h"

#include "Generate/GeneratedMeshes.h"
#include "MeshParts.h"
#include "ReferenceOcclusion.h"
#include "ReferenceScenes.h"
#include "Walk/WalkMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace tetralux;

using Vector = std::array<double, 3>;

VisibilityView LookFrom(const Vector& eye)
{
  VisibilityView view;
  view.Eye = eye;
  return view;
}

VisibilityView LookAlong(const Vector& direction)
{
  VisibilityView view;
  view.Parallel = true;
  view.Direction = direction;
  return view;
}

/// A box of layers of 3 x 3 hexahedra, three of which are that thick, and sheared by 0.3, so that
/// no coordinate is exact.
TetrahedralMesh MakeThinLayers(double thickness)
{
  const double heights[] = { 0, 0.3, 0.3 + thickness, 0.3 + 2 * thickness, 0.3 + 3 * thickness,
    0.6 };
  TetrahedralMesh mesh = MakeBox(3, 3, 5, { 0, 0, 0 }, { 1, 1, 5 });
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i + 2] = heights[std::lround(mesh.Points[i + 2])];
    mesh.Points[i] += 0.3 * mesh.Points[i + 2];
  }
  return mesh;
}

/// Two boxes on an oblique plane, on which their faces do not match.
TetrahedralMesh MakeSlideLine()
{
  TetrahedralMesh mesh = MakeBox(2, 2, 2, { 0, 0, 0 }, { 1, 1, 0.5 });
  AddMesh(mesh, MakeBox(3, 3, 2, { -0.1, -0.1, 0.5 }, { 1, 1, 1 }));
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    mesh.Points[i] += 0.2 * mesh.Points[i + 1];
    mesh.Points[i + 2] += 0.3 * mesh.Points[i] - 0.1 * mesh.Points[i + 1];
  }
  return mesh;
}

TetrahedralMesh SeparatePieces(const TetrahedralMesh& mesh)
{
  std::mt19937_64 random(7);
  std::vector<std::int64_t> pieces(mesh.GetNumberOfCells());
  for (std::int64_t& piece : pieces)
  {
    piece = static_cast<std::int64_t>(random() % 5);
  }
  return SeparateParts(mesh, pieces);
}

/// The views from, along and inside of what five cells are made of; points as in the given mesh.
std::vector<VisibilityView> MakeDegenerateViews(const TetrahedralMesh& mesh)
{
  std::mt19937_64 random(3);
  std::vector<VisibilityView> views;
  for (int i = 0; i < 5; ++i)
  {
    const std::size_t cell = random() % mesh.GetNumberOfCells();
    const auto mix = [&](const std::array<double, 4>& weights)
    {
      Vector sum = { 0, 0, 0 };
      for (std::size_t corner = 0; corner < 4; ++corner)
      {
        const std::size_t point = static_cast<std::size_t>(mesh.Cells[4 * cell + corner]);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          sum[axis] += weights[corner] * mesh.Points[3 * point + axis];
        }
      }
      return sum;
    };
    views.push_back(LookFrom(mix({ 1, 0, 0, 0 })));         // a point
    views.push_back(LookFrom(mix({ 0.5, 0.5, 0, 0 })));     // an edge
    views.push_back(LookFrom(mix({ 3, -2, 0, 0 })));        // its line, beyond
    views.push_back(LookFrom(mix({ 0.25, 0.5, 0.25, 0 }))); // a face
    views.push_back(LookFrom(mix({ 3, -1, -1, 0 })));       // its plane, beyond
    views.push_back(LookAlong(mix({ -1, 1, 0, 0 })));       // an edge
    views.push_back(LookAlong(mix({ -2, 1, 1, 0 })));       // a face
  }
  return views;
}

std::vector<VisibilityView> MakePlainViews()
{
  return { LookFrom({ 2.3, 3.1, 4.2 }), LookFrom({ 0.33, -1.7, 0.9 }),
    LookFrom({ 0.37, 0.41, 0.53 }), LookAlong({ -0.3, 0.5, 0.8 }), LookAlong({ 0, 0, 1 }),
    LookAlong({ 1, 0, 0 }), LookAlong({ 1, 1, 0 }) };
}

/// shortestPart: as in FindOccludedPairs.
void ExpectExact(const TetrahedralMesh& input, const std::vector<VisibilityView>& views,
  double shortestPart = 1e-9)
{
  const WalkMesh mesh(input);
  VisibilityOrder order(mesh, false);
  int number = 0;
  for (const VisibilityView& view : views)
  {
    SCOPED_TRACE("view " + std::to_string(++number));
    const auto pairs = FindOccludedPairs(mesh.GetMesh(), view, 1, number, shortestPart);
    EXPECT_GT(pairs.size(), 50U);
    const auto& front =
      order.Sort(view, VisibilityMethod::MeshedAcrossGaps, VisibilityDirection::FrontToBack);
    EXPECT_EQ(order.GetUsedMethod(), VisibilityMethod::MeshedAcrossGaps);
    EXPECT_EQ(FindWrongPairs(pairs, front).size(), 0U);
    EXPECT_EQ(order.GetCycles().GetNumberOfCycles(), 0);
  }
}

std::vector<std::pair<std::string, TetrahedralMesh>> MakeMeshes()
{
  return { { "random", GenerateMesh("random", { { "cells", 3 }, { "removed", 0 } }).Mesh },
    { "with holes",
      GenerateMesh("random", { { "cells", 3 }, { "removed", 0.3 }, { "seed", 2 } }).Mesh },
    { "lattice", MakeBox(3, 3, 3, { 0, 0, 0 }, { 1, 1, 1 }) }, { "slide line", MakeSlideLine() },
    { "layers of 1e-6", MakeThinLayers(1e-6) }, { "layers of 1e-8", MakeThinLayers(1e-8) } };
}

TEST(DegenerateViews, OfSharedPoints)
{
  for (const auto& [name, mesh] : MakeMeshes())
  {
    SCOPED_TRACE(name);
    ExpectExact(mesh, MakeDegenerateViews(mesh));
  }
}

TEST(DegenerateViews, OfCellsWithPointsOfTheirOwn)
{
  for (const auto& [name, mesh] : MakeMeshes())
  {
    SCOPED_TRACE(name);
    ExpectExact(SeparateCells(mesh), MakeDegenerateViews(mesh));
    ExpectExact(SeparateCells(mesh), MakePlainViews());
  }
}

TEST(DegenerateViews, OfPieces)
{
  for (const auto& [name, mesh] : MakeMeshes())
  {
    SCOPED_TRACE(name);
    ExpectExact(SeparatePieces(mesh), MakeDegenerateViews(mesh));
  }
}

/// Off by a unit in the last place of single precision, so that cells reach into each other.
TEST(DegenerateViews, OfPointsThatDifferInTheLastBits)
{
  const auto meshes = MakeMeshes();
  for (std::size_t i = 0; i < 4; ++i) // others are too thin
  {
    SCOPED_TRACE(meshes[i].first);
    for (const double offset : { 0., 10. })
    {
      SCOPED_TRACE("offset " + std::to_string(offset));
      TetrahedralMesh mesh = SeparateCells(meshes[i].second);
      std::mt19937_64 random(5);
      for (double& x : mesh.Points)
      {
        const auto single = static_cast<float>(x + offset);
        const float places[] = { single, std::nextafter(single, 0.F),
          std::nextafter(single, 100.F) };
        x = places[random() % 3];
      }
      std::vector<VisibilityView> views = MakePlainViews();
      for (VisibilityView& view : views)
      {
        for (double& x : view.Eye)
        {
          x += offset;
        }
      }
      // Longer than what cells have in common; by rays that are not along faces.
      ExpectExact(mesh, views, offset > 0 ? 5e-5 : 4e-6);
    }
  }
}

} // namespace
