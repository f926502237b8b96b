// SPDX-License-Identifier: BSD-3-Clause

// Visibility orders: nanoseconds a cell of each method, beside vtkCellCenterDepthSort, and how
// many pairs of cells they get wrong; see Documentation/Benchmarks.md. Argument: the largest
// number of tetrahedra (1,200,000). The blunt fin takes part where the environment variable
// TETRALUX_DATA names its folder.

#include "ComparisonMeshes.h"
#include "ReferenceOcclusion.h"
#include "Visibility/VisibilityOrder.h"
#include "Walk/WalkMesh.h"

#include "vtkCamera.h"
#include "vtkCellCenterDepthSort.h"
#include "vtkCellType.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string>
#include <vector>

namespace
{

using tetralux::ComparisonMesh;
using tetralux::MakeComparisonMesh;
using tetralux::VisibilityDirection;
using tetralux::VisibilityMethod;
using tetralux::VisibilityOrder;
using tetralux::VisibilityView;
using tetralux::WalkMesh;

constexpr int Runs = 5;

/// Along no axis or diagonal of a lattice.
constexpr std::array<double, 3> TowardsViewer = { 6. / 11, 2. / 11, 9. / 11 };

/// distance: from the centre of the mesh, in radii.
VisibilityView MakeView(const WalkMesh& mesh, double distance)
{
  VisibilityView view;
  for (int axis = 0; axis < 3; ++axis)
  {
    view.Eye[axis] = mesh.GetCenter()[axis] + distance * mesh.GetRadius() * TowardsViewer[axis];
  }
  return view;
}

double MeasureVtk(const WalkMesh& mesh, const VisibilityView& view)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (std::size_t i = 0; i < mesh.GetMesh().Points.size(); i += 3)
  {
    points->InsertNextPoint(&mesh.GetMesh().Points[i]);
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  for (std::size_t i = 0; i < mesh.GetMesh().Cells.size(); i += 4)
  {
    vtkIdType ids[4];
    std::copy_n(&mesh.GetMesh().Cells[i], 4, ids);
    grid->InsertNextCell(VTK_TETRA, 4, ids);
  }
  vtkNew<vtkCamera> camera;
  camera->SetPosition(view.Eye.data());
  camera->SetFocalPoint(mesh.GetCenter());
  vtkNew<vtkCellCenterDepthSort> sort;
  sort->SetInput(grid);
  sort->SetCamera(camera);
  return tetralux::MeasureBest(Runs,
    [&]
    {
      sort->InitTraversal();
      while (sort->GetNextCells() != nullptr)
      {
      }
    });
}

void PrintSpeed(const ComparisonMesh& source, bool withVtk)
{
  WalkMesh mesh(source.Mesh);
  const double cells = mesh.GetNumberOfCells();
  const VisibilityView view = MakeView(mesh, 3);
  const auto measure = [&](VisibilityOrder& order, VisibilityMethod method)
  {
    return 1e9 / cells *
      tetralux::MeasureBest(
        Runs, [&] { order.Sort(view, method, VisibilityDirection::BackToFront); });
  };
  const double prepare =
    1e9 / cells * tetralux::MeasureBest(1, [&] { VisibilityOrder order(mesh, false); });
  VisibilityOrder plain(mesh, false);
  const double nonConvex = measure(plain, VisibilityMethod::MeshedNonConvex);
  const double centroids = measure(plain, VisibilityMethod::CentroidDistance);
  const double acrossGaps = measure(plain, VisibilityMethod::MeshedAcrossGaps);
  const bool tooMany = plain.GetUsedMethod() != VisibilityMethod::MeshedAcrossGaps;
  const double convexify = 1e3 * tetralux::MeasureBest(1, [&] { mesh.MakeConvex(); });
  VisibilityOrder order(mesh);
  const double meshed = measure(order, VisibilityMethod::Meshed);
  std::printf("| %s | %.0f | %.0f | %s | %.0f | %.0f | %s | %lld | %.0f | %.0f |\n",
    source.Name.c_str(), prepare, meshed,
    tooMany ? "too many" : std::to_string(std::lround(acrossGaps)).c_str(), nonConvex, centroids,
    withVtk ? std::to_string(std::lround(1e9 / cells * MeasureVtk(mesh, view))).c_str() : "",
    static_cast<long long>(mesh.GetConvexification()->GetNumberOfCells()), convexify,
    static_cast<double>(order.GetSize()) / cells);
  std::fflush(stdout);
}

void PrintErrors(const ComparisonMesh& source)
{
  WalkMesh mesh(source.Mesh);
  mesh.MakeConvex();
  VisibilityOrder exact(mesh);
  VisibilityOrder plain(mesh, false);
  std::size_t pairs = 0;
  std::size_t wrong[5] = {};
  std::int64_t cycles = 0;
  // From outside and from inside.
  for (const double distance : { 3.0, 1.2, 0.4 })
  {
    const VisibilityView view = MakeView(mesh, distance);
    const auto occluded = tetralux::FindOccludedPairs(mesh.GetMesh(), view, 2, 1);
    pairs += occluded.size();
    int column = 0;
    const auto count = [&](VisibilityOrder& order, VisibilityMethod method)
    {
      wrong[column++] += tetralux::FindWrongPairs(
        occluded, order.Sort(view, method, VisibilityDirection::FrontToBack))
                           .size();
    };
    count(exact, VisibilityMethod::Meshed);
    cycles += exact.GetCycles().GetNumberOfCycles();
    count(plain, VisibilityMethod::MeshedAcrossGaps);
    count(plain, VisibilityMethod::MeshedNonConvex);
    count(plain, VisibilityMethod::Meshed);
    count(plain, VisibilityMethod::CentroidDistance);
  }
  std::printf("| %s | %zu | %zu | %zu | %zu | %zu | %zu | %lld |\n", source.Name.c_str(), pairs,
    wrong[0], wrong[1], wrong[2], wrong[3], wrong[4], static_cast<long long>(cycles));
  std::fflush(stdout);
}

} // namespace

int main(int argc, char* argv[])
{
  const double largest = argc > 1 ? std::atof(argv[1]) : 1.2e6;
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  std::printf("| mesh | prepared | faces, made convex | faces and gaps | faces and a guess | "
              "centroids | VTK | "
              "imaginary cells | ms to make them | bytes a cell "
              "|\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const ComparisonMesh& fin : tetralux::ReadBluntFin())
  {
    PrintSpeed(fin, true);
  }
  for (const double cells : { 16., 34., 75., 160. })
  {
    if (2.5 * cells * cells * cells <= largest)
    {
      PrintSpeed(MakeComparisonMesh("ball", { { "cells", cells } }), cells < 100);
    }
  }
  PrintSpeed(MakeComparisonMesh("ring"), true);
  PrintSpeed(MakeComparisonMesh("boundary-layer"), true);
  PrintSpeed(MakeComparisonMesh("random"), true);

  omp_set_num_threads(threads);
  std::printf(
    "\n| mesh | pairs | faces, made convex | faces and gaps | faces and a guess | faces alone | "
    "centroids | cycles |\n|---|---|---|---|---|---|---|---|\n");
  for (const ComparisonMesh& mesh : { MakeComparisonMesh("ball", { { "cells", 10 } }),
         MakeComparisonMesh("random", { { "cells", 7 } }),
         MakeComparisonMesh("random", { { "cells", 7 }, { "removed", 0.5 } }),
         MakeComparisonMesh("ring", { { "around", 60 }, { "across", 3 } }),
         MakeComparisonMesh("heat-sink", { { "cells", 1 }, { "fins", 5 } }),
         MakeComparisonMesh("gear", { { "teeth", 12 }, { "across", 2 }, { "along", 2 } }),
         MakeComparisonMesh("cubes", { { "cells", 2 } }),
         MakeComparisonMesh("cycle", { { "cells", 1 }, { "bars", 6 } }),
         MakeComparisonMesh("schoenhardt", { { "cells", 2 } }),
         MakeComparisonMesh("boundary-layer", { { "cells", 8 }, { "layers", 12 } }) })
  {
    PrintErrors(mesh);
  }
  return 0;
}
