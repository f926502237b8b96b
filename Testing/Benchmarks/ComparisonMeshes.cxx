// SPDX-License-Identifier: BSD-3-Clause
#include "ComparisonMeshes.h"

#include "Generate/GeneratedMeshes.h"
#include "Intake/TetrahedraIntake.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiBlockPLOT3DReader.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <stdexcept>

namespace tetralux
{
namespace
{

void MapToUnitRange(std::vector<double>& scalars)
{
  const auto [lo, hi] = std::minmax_element(scalars.begin(), scalars.end());
  const double lowest = *lo;
  const double range = *hi - lowest;
  for (double& s : scalars)
  {
    s = (s - lowest) / range;
  }
}

} // namespace

ComparisonMesh MakeComparisonMesh(
  const std::string& generator, const std::map<std::string, double>& parameters)
{
  GeneratedMesh generated = GenerateMesh(generator, parameters);
  ComparisonMesh result;
  result.Name = generator + " " + std::to_string(generated.Mesh.GetNumberOfCells());
  result.Mesh = std::move(generated.Mesh);
  result.Scalars = std::move(generated.Scalars);
  MapToUnitRange(result.Scalars);
  return result;
}

std::vector<ComparisonMesh> ReadBluntFin()
{
  const char* folder = std::getenv("TETRALUX_DATA");
  if (!folder)
  {
    std::cerr << "without the blunt fin: TETRALUX_DATA is not set\n";
    return {};
  }
  const std::string prefix = std::string(folder) + "/bluntfin";
  vtkNew<vtkMultiBlockPLOT3DReader> reader;
  reader->SetXYZFileName((prefix + "xyz.bin").c_str());
  reader->SetQFileName((prefix + "q.bin").c_str());
  reader->SetScalarFunctionNumber(100);
  reader->Update();
  auto* grid = vtkDataSet::SafeDownCast(reader->GetOutput()->GetBlock(0));
  vtkDataArray* density = grid ? grid->GetPointData()->GetArray("Density") : nullptr;
  if (!density)
  {
    throw std::runtime_error(prefix + "xyz.bin and q.bin could not be read");
  }
  TetrahedraIntake intake = TakeInTetrahedra(grid);
  ComparisonMesh result;
  result.Name = "blunt fin " + std::to_string(intake.Mesh.GetNumberOfCells());
  result.Mesh = std::move(intake.Mesh);
  for (vtkIdType p = 0; p < density->GetNumberOfTuples(); ++p)
  {
    result.Scalars.push_back(density->GetComponent(p, 0));
  }
  MapToUnitRange(result.Scalars);
  return { result };
}

std::vector<double> MapScalars(const TetrahedralMesh& mesh, const std::vector<double>& original)
{
  if (mesh.OriginalPoints.empty())
  {
    return original;
  }
  std::vector<double> scalars;
  for (const std::int64_t p : mesh.OriginalPoints)
  {
    scalars.push_back(original[p]);
  }
  return scalars;
}

PerspectiveView::PerspectiveView(const double center[3], double radius, int size)
{
  const double angle = std::atan(1.) / 3; // half of 30 degrees
  const double distance = radius / std::sin(angle);
  // Orthonormal, and along no axis or diagonal of a lattice.
  this->Forward = { -6. / 11, -6. / 11, -7. / 11 };
  this->Right = { 9. / 11, -2. / 11, -6. / 11 };
  this->Up = { 2. / 11, -9. / 11, 6. / 11 };
  this->Pixel = 2 * std::tan(angle) / size;
  this->Grid.Width = this->Grid.Height = size;
  for (int a = 0; a < 3; ++a)
  {
    this->Position[a] = center[a] - distance * this->Forward[a];
    this->Grid.Origin[a] = this->Position[a];
    this->Grid.DirectionStepX[a] = this->Pixel * this->Right[a];
    this->Grid.DirectionStepY[a] = this->Pixel * this->Up[a];
    this->Grid.Direction[a] = this->Forward[a] +
      0.5 * (1 - size) * (this->Grid.DirectionStepX[a] + this->Grid.DirectionStepY[a]);
  }
}

double GetProcessorTime()
{
  timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace tetralux
