// SPDX-License-Identifier: BSD-3-Clause

// What an order of cells that is not right does to the picture: vtkTetrahedraProjectionMapper,
// which is exact but for the order, against vtkTetrahedraRayCastMapper in double precision; see
// Documentation/Benchmarks.md. The blunt fin and the crushed can take part where the environment
// variable TETRALUX_DATA names their folder.

#include "ComparisonMeshes.h"
#include "ImageComparison.h"
#include "Intake/TetrahedraIntake.h"
#include "vtkHeadlessRenderWindow.h"
#include "vtkMeshedPolyhedraVisibilitySort.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"

#include "vtkCamera.h"
#include "vtkCellType.h"
#include "vtkColorTransferFunction.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace
{

using tetralux::ComparisonMesh;
using tetralux::MakeComparisonMesh;

constexpr int Size = 256; ///< pixels along an edge

vtkSmartPointer<vtkUnstructuredGrid> MakeGrid(const ComparisonMesh& mesh)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName("Field");
  for (std::size_t point = 0; point < mesh.Mesh.GetNumberOfPoints(); ++point)
  {
    points->InsertNextPoint(&mesh.Mesh.Points[3 * point]);
    scalars->InsertNextValue(mesh.Scalars[point]);
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(scalars);
  for (std::size_t i = 0; i < mesh.Mesh.Cells.size(); i += 4)
  {
    vtkIdType ids[4];
    std::copy_n(&mesh.Mesh.Cells[i], 4, ids);
    grid->InsertNextCell(VTK_TETRA, 4, ids);
  }
  return grid;
}

/// The can, whose boundary goes through itself, with a field that is linear in space.
std::vector<ComparisonMesh> ReadCan()
{
  const char* folder = std::getenv("TETRALUX_DATA");
  if (!folder)
  {
    return {};
  }
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((std::string(folder) + "/can.vtu").c_str());
  reader->Update();
  ComparisonMesh can;
  can.Mesh = tetralux::TakeInTetrahedra(reader->GetOutput()).Mesh;
  can.Name = "can " + std::to_string(can.Mesh.GetNumberOfCells());
  for (std::size_t i = 0; i < can.Mesh.Points.size(); i += 3)
  {
    can.Scalars.push_back(can.Mesh.Points[i + 2] + 0.3 * can.Mesh.Points[i]);
  }
  const auto [lowest, highest] = std::minmax_element(can.Scalars.begin(), can.Scalars.end());
  const double low = *lowest, range = *highest - *lowest;
  for (double& scalar : can.Scalars)
  {
    scalar = (scalar - low) / range;
  }
  return { can };
}

/// One mesh in a window, drawn by one mapper after the other.
class Scene
{
public:
  Scene(const ComparisonMesh& mesh, double opticalDepth)
    : Grid(MakeGrid(mesh))
  {
    // Red, green and blue in turns.
    vtkNew<vtkColorTransferFunction> color;
    vtkNew<vtkPiecewiseFunction> opacity;
    for (int node = 0; node <= 12; ++node)
    {
      color->AddRGBPoint(node / 12., node % 3 == 0, node % 3 == 1, node % 3 == 2);
      opacity->AddPoint(node / 12., node % 2 == 0 ? 0.1 : 1);
    }
    this->Volume->GetProperty()->SetColor(color);
    this->Volume->GetProperty()->SetScalarOpacity(opacity);
    this->Volume->GetProperty()->SetScalarOpacityUnitDistance(
      this->Grid->GetLength() / opticalDepth);
    this->Volume->GetProperty()->SetInterpolationTypeToLinear();
    this->Renderer->AddVolume(this->Volume);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Size, Size);
    this->Window->AddRenderer(this->Renderer);

    double center[3];
    this->Grid->GetCenter(center);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    const double distance = 1.2 * this->Grid->GetLength();
    camera->SetFocalPoint(center);
    camera->SetPosition(center[0] + 6. / 11 * distance, center[1] + 2. / 11 * distance,
      center[2] + 9. / 11 * distance);
    camera->SetViewUp(0, 1, 0);
    this->Renderer->ResetCameraClippingRange(this->Grid->GetBounds());
  }

  std::vector<float> Draw(vtkTetrahedraVolumeMapper* mapper)
  {
    mapper->SetInputDataObject(this->Grid);
    this->Volume->SetMapper(mapper);
    this->Window->Render();
    auto* rgba =
      vtkFloatArray::SafeDownCast(mapper->GetOutputImage()->GetPointData()->GetArray("RGBA"));
    return { rgba->GetPointer(0), rgba->GetPointer(0) + rgba->GetNumberOfValues() };
  }

private:
  vtkSmartPointer<vtkUnstructuredGrid> Grid;
  vtkNew<vtkHeadlessRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkVolume> Volume;
};

/// opticalDepth: across the whole mesh, where it is densest.
void PrintRow(const ComparisonMesh& mesh, double opticalDepth = 10)
{
  Scene scene(mesh, opticalDepth);
  vtkNew<vtkTetrahedraRayCastMapper> rays;
  rays->SetMaximumError(1e-6);
  rays->SetPrecisionToDouble();
  rays->AutoAdjustSampleDistancesOff();
  const std::vector<float> picture = scene.Draw(rays);
  const std::vector<double> reference(picture.begin(), picture.end());

  std::printf("| %s |", mesh.Name.c_str());
  using Sort = vtkMeshedPolyhedraVisibilitySort;
  for (const int order : { Sort::EXACT_ORDER, Sort::NON_CONVEX_ORDER, Sort::CENTROID_ORDER })
  {
    vtkNew<vtkTetrahedraProjectionMapper> mapper;
    mapper->SetOrder(order);
    const tetralux::ImageErrors errors =
      tetralux::CompareWithReference(scene.Draw(mapper), reference).Covered;
    std::printf(" %.1e / %.1e / %.2f %% |", errors.Maximum, errors.RootMeanSquare,
      100 * errors.ShareAbove1Of255);
  }
  std::printf("\n");
  std::fflush(stdout);
}

} // namespace

int main()
{
  std::printf("| mesh | exact | faces and a guess | centroids |\n|---|---|---|---|\n");
  for (const ComparisonMesh& fin : tetralux::ReadBluntFin())
  {
    PrintRow(fin);
  }
  PrintRow(MakeComparisonMesh("ring", { { "around", 100 }, { "across", 9 } }));
  PrintRow(MakeComparisonMesh("heat-sink", { { "cells", 2 }, { "length", 4 } }));
  PrintRow(MakeComparisonMesh("gear", { { "teeth", 24 }, { "across", 3 }, { "along", 3 } }));
  PrintRow(MakeComparisonMesh("boundary-layer", { { "cells", 24 }, { "layers", 24 } }));
  PrintRow(MakeComparisonMesh("random", { { "cells", 16 } }));
  PrintRow(MakeComparisonMesh("random", { { "cells", 16 }, { "removed", 0.5 } }));
  PrintRow(MakeComparisonMesh("schoenhardt", { { "cells", 2 } }));
  PrintRow(MakeComparisonMesh("cycle", { { "cells", 1 } }));
  for (const ComparisonMesh& can : ReadCan())
  {
    PrintRow(can);
    PrintRow(can, 100);
  }
  return 0;
}
