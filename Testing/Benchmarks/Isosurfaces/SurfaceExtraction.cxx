// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurfaces/SurfaceExtraction.h"

#include "Base/Stopwatch.h"

#include "vtkAlgorithm.h"
#include "vtkContour3DLinearGrid.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

namespace tetralux
{

SurfaceExtraction::SurfaceExtraction(vtkUnstructuredGrid* grid, ScalarTree tree)
{
  this->Filter->SetInputData(grid);
  this->Filter->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  this->Filter->SetUseScalarTree(tree == ScalarTree::On);
}

SurfaceExtraction::~SurfaceExtraction() = default;

void SurfaceExtraction::SetIsovalue(double isovalue) { this->Filter->SetValue(0, isovalue); }

double SurfaceExtraction::Update()
{
  const Stopwatch stopwatch;
  this->Filter->Update();
  return stopwatch.GetSeconds();
}

vtkPolyData* SurfaceExtraction::GetSurface() const
{
  return vtkPolyData::SafeDownCast(this->Filter->GetOutputDataObject(0));
}

} // namespace tetralux
