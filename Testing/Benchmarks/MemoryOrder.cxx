// SPDX-License-Identifier: BSD-3-Clause

// What the order of points and cells in memory does to ray casting: the order of the source, a
// random one, and that of OrderSpatially. The packet kernel is run on tables that are built here,
// since WalkMesh always orders. Prints processor nanoseconds of a segment (a cell that a ray goes
// through), one thread.

#include "ComparisonMeshes.h"
#include "Mesh/FaceNeighbors.h"
#include "Mesh/MeshCleaning.h"
#include "Mesh/SpatialOrder.h"
#include "OwnedCrossings.h"
#include "RayCast/RayCastKernel.inl"
#include "Walk/WalkTables.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <numeric>
#include <random>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

constexpr int ImageSize = 512;
constexpr int TileSize = 16; ///< as in RayCaster.cxx
constexpr int Runs = 6;

/// A mesh in any order as the kernel reads it.
struct OrderedMesh
{
  std::vector<WalkPoint<float>> Points;
  WalkTables Tables;
  double Center[3];
  double Radius = 0;
};

OrderedMesh MakeOrderedMesh(TetrahedralMesh mesh, const std::vector<double>& scalars)
{
  for (std::size_t t = 0; t < mesh.GetNumberOfCells(); ++t)
  {
    std::sort(&mesh.Cells[4 * t], &mesh.Cells[4 * t] + 4);
  }
  OrderedMesh result;
  const std::size_t n = mesh.GetNumberOfPoints();
  for (int a = 0; a < 3; ++a)
  {
    double lo = std::numeric_limits<double>::max();
    double hi = std::numeric_limits<double>::lowest();
    for (std::size_t p = 0; p < n; ++p)
    {
      lo = std::min(lo, mesh.Points[3 * p + a]);
      hi = std::max(hi, mesh.Points[3 * p + a]);
    }
    result.Center[a] = 0.5 * (lo + hi);
    result.Radius = std::hypot(result.Radius, 0.5 * (hi - lo));
  }
  for (std::size_t p = 0; p < n; ++p)
  {
    float x[3];
    for (int a = 0; a < 3; ++a)
    {
      x[a] = static_cast<float>((mesh.Points[3 * p + a] - result.Center[a]) / result.Radius);
    }
    // The medium's scalars are -1..1.
    result.Points.push_back({ x[0], x[1], x[2], static_cast<float>(2 * scalars[p] - 1) });
  }
  const FaceNeighbors neighbors = FindFaceNeighbors(mesh.Cells, n);
  RawVector<WalkFace> faces;
  for (std::size_t f = 0; f < neighbors.Neighbors.size(); ++f)
  {
    const std::int32_t cell = neighbors.Neighbors[f];
    const std::size_t behind = 4 * static_cast<std::size_t>(cell) + neighbors.NeighborFaces[f];
    faces.push_back({ cell, cell < 0 ? 0 : mesh.Cells[behind] });
  }
  result.Tables = MakeWalkTables(std::move(faces), mesh.Cells, result.Points);
  return result;
}

/// A medium that lets all rays through, in which attenuation and colour change everywhere.
IntervalTable MakeMedium(double radius)
{
  TransferFunction function;
  for (int k = 0; k < 5; ++k)
  {
    const double x = 0.25 * k;
    const TransferFunction::Value value = { { x, 1 - x, 0.5 }, (0.1 + 0.4 * (k % 2)) / radius };
    function.Nodes.push_back({ 2 * x - 1, value, value });
  }
  return MakeIntervalTable(function);
}

/// Renders a mesh in one order and keeps the least time.
class OrderRun
{
public:
  OrderRun(const TetrahedralMesh& mesh, const std::vector<double>& scalars)
    : Mesh(MakeOrderedMesh(mesh, scalars))
    , View(this->Mesh.Center, this->Mesh.Radius, ImageSize)
    , Medium(MakeMedium(this->Mesh.Radius))
    , Colors(4 * ImageSize * ImageSize)
    , Depths(ImageSize * ImageSize)
  {
    this->In.Points = this->Mesh.Points.data();
    this->In.Faces = this->Mesh.Tables.Faces.data();
    this->In.Entries = this->Mesh.Tables.Entries.data();
    this->In.Nodes = this->Mesh.Tables.Bvh.Nodes.data();
    this->In.Triangles = this->Mesh.Tables.Bvh.Triangles.data();
    this->In.NumberOfCells = static_cast<std::int32_t>(mesh.GetNumberOfCells());
    std::copy_n(this->Mesh.Center, 3, this->In.Center);
    this->In.Radius = this->Mesh.Radius;
    this->In.Intervals = this->Medium.Intervals.data();
    this->In.Grid = &this->View.Grid;
    this->In.MaximumOpacity = 1;
    this->In.Colors = this->Colors.data();
    this->In.Depths = this->Depths.data();
  }
  OrderRun(const OrderRun&) = delete;
  OrderRun& operator=(const OrderRun&) = delete;

  void Render()
  {
    const RayCastKernel kernel =
      MakeRayCastKernels().Points[static_cast<int>(Integrator::ClosedForm)].Single;
    KernelCounts counts;
    const double seconds = MeasureBest(1,
      [&]
      {
        for (int y = 0; y < ImageSize; y += TileSize)
        {
          for (int x = 0; x < ImageSize; x += TileSize)
          {
            kernel(this->In, x, y, x + TileSize, y + TileSize, { &this->Buffer, nullptr }, counts);
          }
        }
      });
    this->Seconds = std::min(this->Seconds, seconds);
    this->Segments = counts.Segments;
  }

  double GetNanosecondsOfSegment() const
  {
    return 1e9 * this->Seconds / static_cast<double>(this->Segments);
  }
  std::int64_t GetSegments() const { return this->Segments; }

private:
  OrderedMesh Mesh;
  PerspectiveView View;
  IntervalTable Medium;
  std::vector<float> Colors, Depths;
  KernelInput In{};
  OwnedCrossings Buffer;
  double Seconds = std::numeric_limits<double>::infinity();
  std::int64_t Segments = 0;
};

/// Points and cells in random order.
void Shuffle(ComparisonMesh& mesh)
{
  std::mt19937_64 random(1);
  const std::size_t n = mesh.Mesh.GetNumberOfPoints();
  std::vector<std::int32_t> place(n);
  std::iota(place.begin(), place.end(), 0);
  std::shuffle(place.begin(), place.end(), random);
  const ComparisonMesh source = mesh;
  for (std::size_t p = 0; p < n; ++p)
  {
    std::copy_n(&source.Mesh.Points[3 * p], 3, &mesh.Mesh.Points[3 * std::size_t(place[p])]);
    mesh.Scalars[place[p]] = source.Scalars[p];
  }
  std::vector<std::size_t> cells(mesh.Mesh.GetNumberOfCells());
  std::iota(cells.begin(), cells.end(), std::size_t(0));
  std::shuffle(cells.begin(), cells.end(), random);
  for (std::size_t t = 0; t < cells.size(); ++t)
  {
    for (int i = 0; i < 4; ++i)
    {
      mesh.Mesh.Cells[4 * t + i] = place[source.Mesh.Cells[4 * cells[t] + i]];
    }
  }
}

void MeasureOrders(ComparisonMesh mesh)
{
  OrderRun source(mesh.Mesh, mesh.Scalars);
  Shuffle(mesh);
  OrderRun shuffled(mesh.Mesh, mesh.Scalars);
  RemoveUnusableCells(mesh.Mesh);
  OrderSpatially(mesh.Mesh);
  OrderRun spatial(mesh.Mesh, MapScalars(mesh.Mesh, mesh.Scalars));
  // In turns, so that what disturbs the machine for a while disturbs all of them.
  for (int i = 0; i < Runs; ++i)
  {
    source.Render();
    shuffled.Render();
    spatial.Render();
  }
  std::printf("%-20s %10lld %10.1f %10.1f %10.1f\n", mesh.Name.c_str(),
    static_cast<long long>(spatial.GetSegments()), source.GetNanosecondsOfSegment(),
    shuffled.GetNanosecondsOfSegment(), spatial.GetNanosecondsOfSegment());
  std::fflush(stdout);
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

int main()
{
  using namespace tetralux;
  try
  {
    std::printf("Processor nanoseconds of a segment, in a picture of 512 x 512\n\n"
                "%-20s %10s %10s %10s %10s\n",
      "", "segments", "source", "shuffled", "spatial");
    for (ComparisonMesh& mesh : ReadBluntFin())
    {
      TETRALUX_ISA::MeasureOrders(std::move(mesh));
    }
    for (const double cells : { 40., 74., 160. })
    {
      TETRALUX_ISA::MeasureOrders(MakeComparisonMesh("ball", { { "cells", cells } }));
    }
  }
  catch (const std::exception& e)
  {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
