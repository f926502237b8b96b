// SPDX-License-Identifier: BSD-3-Clause

// Fills the space between meshes and their hulls, and prints what that takes; see
// Module/Convexification.md. Arguments: random rays for each mesh that are walked and compared with
// brute force (100,000), and the largest number of boundary faces of growing meshes (1,000,000).
// Real meshes take part where the environment variable TETRALUX_DATA names their folder.

#include "ComparisonMeshes.h"
#include "Convexify/Convexification.h"
#include "Intake/TetrahedraIntake.h"
#include "Mesh/FaceNeighbors.h"
#include "Mesh/MeshCleaning.h"
#include "ReferenceConvexity.h"

#include "vtkDataObject.h"
#include "vtkExodusIIReader.h"
#include "vtkNew.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>

namespace
{

using tetralux::ComparisonMesh;
using tetralux::Convexification;

struct Run
{
  tetralux::TetrahedralMesh Mesh;
  Convexification Result;
  double ProcessorSeconds;
};

Run Convexify(tetralux::TetrahedralMesh mesh)
{
  tetralux::RemoveUnusableCells(mesh);
  const tetralux::FaceNeighbors neighbors =
    tetralux::FindFaceNeighbors(mesh.Cells, mesh.GetNumberOfPoints());
  Run run;
  // The one that others on the machine disturbed the least.
  const int runs = neighbors.BoundaryFaces.size() > 50000 ? 1 : 3;
  for (int i = 0; i < runs; ++i)
  {
    const double begin = tetralux::GetProcessorTime();
    Convexification result = tetralux::Convexify(mesh, neighbors, tetralux::TouchingCells::Join);
    const double seconds = tetralux::GetProcessorTime() - begin;
    if (i == 0 || result.GetSeconds() < run.Result.GetSeconds())
    {
      run.Result = std::move(result);
      run.ProcessorSeconds = seconds;
    }
  }
  run.Mesh = std::move(mesh);
  return run;
}

void PrintRow(const std::string& name, tetralux::TetrahedralMesh mesh, std::int64_t numberOfRays)
{
  const Run run = Convexify(std::move(mesh));
  const Convexification& result = run.Result;
  if (!result.Refusal.empty())
  {
    std::printf("| %s | %lld | refused after %.2f s: %s |\n", name.c_str(),
      static_cast<long long>(result.BoundaryFaces), result.GetSeconds(), result.Refusal.c_str());
    std::fflush(stdout);
    return;
  }
  tetralux::ConvexifiedMesh whole = { run.Mesh.Points, run.Mesh.Cells, result.Cells };
  whole.Points.insert(whole.Points.end(), result.SteinerPoints.begin(), result.SteinerPoints.end());
  const tetralux::RayAgreement rays = tetralux::CompareRays(whole, numberOfRays, 1);
  std::printf("| %s | %lld | %lld | %lld | %lld | %lld | %.2f | %.2f | %.7g | %.7g | %.7g | %.0e | "
              "%lld of %lld |\n",
    name.c_str(), static_cast<long long>(result.BoundaryFaces),
    static_cast<long long>(result.MissingFaces), static_cast<long long>(result.GetNumberOfCells()),
    static_cast<long long>(result.GetNumberOfSteinerPoints()),
    static_cast<long long>(result.FlatPocketFaces), result.GetSeconds(), run.ProcessorSeconds,
    result.HullVolume, result.MeshVolume, result.ImaginaryVolume,
    result.Convex ? 0
                  : std::abs(result.HullVolume - result.MeshVolume - result.ImaginaryVolume) /
        result.HullVolume,
    static_cast<long long>(rays.Agreeing), static_cast<long long>(rays.Rays));
  std::fflush(stdout);
}

void PrintGrowth(const std::string& name, tetralux::TetrahedralMesh mesh)
{
  const Run run = Convexify(std::move(mesh));
  const Convexification& result = run.Result;
  const double size = static_cast<double>(result.BoundaryFaces);
  std::printf("| %s | %lld | %lld | %lld | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f | %.2f |%s\n",
    name.c_str(), static_cast<long long>(result.BoundaryFaces),
    static_cast<long long>(result.GetNumberOfCells()),
    static_cast<long long>(result.GetNumberOfSteinerPoints()), result.GetSeconds(),
    result.ConvexTestSeconds, result.TriangulationSeconds, result.PocketSeconds, result.FillSeconds,
    result.VerificationSeconds, 1e6 * run.ProcessorSeconds / (size * std::log2(size)),
    result.Refusal.empty() ? "" : (" " + result.Refusal).c_str());
  std::fflush(stdout);
}

tetralux::TetrahedralMesh TakeIn(vtkAlgorithm* reader)
{
  reader->Update();
  return tetralux::TakeInTetrahedra(reader->GetOutputDataObject(0)).Mesh;
}

tetralux::TetrahedralMesh Generate(
  const std::string& name, const std::map<std::string, double>& parameters = {})
{
  return tetralux::MakeComparisonMesh(name, parameters).Mesh;
}

} // namespace

int main(int argc, char* argv[])
{
  const std::int64_t numberOfRays = argc > 1 ? std::atoll(argv[1]) : 100000;
  const double largest = argc > 2 ? std::atof(argv[2]) : 1e6;

  std::printf(
    "| mesh | boundary faces | missing | imaginary cells | Steiner points | flat pockets | "
    "s | processor s | hull | mesh | imaginary | difference | rays agreeing |\n"
    "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const ComparisonMesh& fin : tetralux::ReadBluntFin())
  {
    PrintRow("blunt fin", fin.Mesh, numberOfRays);
  }
  if (const char* folder = std::getenv("TETRALUX_DATA"))
  {
    vtkNew<vtkExodusIIReader> disk;
    disk->SetFileName((std::string(folder) + "/disk_out_ref.ex2").c_str());
    PrintRow("disk_out_ref", TakeIn(disk), numberOfRays);
    vtkNew<vtkXMLUnstructuredGridReader> can;
    can->SetFileName((std::string(folder) + "/can.vtu").c_str());
    PrintRow("can", TakeIn(can), numberOfRays);
  }
  PrintRow("cylinder with hole",
    Generate("cylinder-with-hole", { { "across", 6 }, { "around", 48 }, { "along", 24 } }),
    numberOfRays);
  PrintRow("heat sink", Generate("heat-sink", { { "cells", 2 }, { "length", 4 } }), numberOfRays);
  PrintRow("gear of 64 teeth", Generate("gear", { { "across", 3 }, { "along", 3 } }), numberOfRays);
  PrintRow("helical gear", Generate("helical-gear", { { "teeth", 12 } }), numberOfRays);
  PrintRow("Schoenhardt's notch", Generate("schoenhardt", { { "cells", 1 } }), numberOfRays);
  PrintRow("cubes apart", Generate("cubes", { { "count", 2 }, { "cells", 4 } }), numberOfRays);
  PrintRow("cube with a cavity", Generate("cavity", { { "cells", 16 } }), numberOfRays);
  PrintRow("cubes that share an edge", Generate("shared-edge"), numberOfRays);
  PrintRow("checkerboard of cubes", Generate("checkerboard", { { "cells", 3 } }), numberOfRays);
  PrintRow("ring", Generate("ring", { { "around", 80 }, { "across", 8 } }), numberOfRays);
  PrintRow("bars in a cycle", Generate("cycle", { { "cells", 2 } }), numberOfRays);
  PrintRow("random, a tenth missing", Generate("random"), numberOfRays);
  PrintRow("random, half missing", Generate("random", { { "removed", 0.5 } }), numberOfRays);

  std::printf("\n| mesh | boundary faces | imaginary cells | Steiner points | s | test | "
              "triangulation | pockets | fill | verification | processor us / (n log2 n) |\n"
              "|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (double size = 1e4; size < 1.01 * largest; size *= std::sqrt(10))
  {
    // Four boundary faces for each hexahedron of a pipe with a thin wall, twelve for a cube.
    const double edge = 2 * std::round(std::sqrt(size / 16));
    PrintGrowth("pipe",
      Generate("cylinder-with-hole", { { "across", 1 }, { "around", edge }, { "along", edge } }));
    PrintGrowth("checkerboard",
      Generate("checkerboard", { { "blocks", std::round(std::cbrt(size / 6)) }, { "cells", 1 } }));
  }
  return 0;
}
