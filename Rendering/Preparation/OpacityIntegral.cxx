// SPDX-License-Identifier: BSD-3-Clause
#include "Preparation/OpacityIntegral.h"

#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkTetra.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>
#include <vector>

namespace tetralux
{

namespace
{

/// NaN is not above 0 either.
double CutOff(double opacity) { return opacity > 0 ? opacity : 0; }

/// Weights of a tetrahedron's points at the four places of a Gauss rule: one large, three small.
const double Small = (5 - std::sqrt(5.)) / 20;
const double Large = 1 - 3 * Small;

} // namespace

double IntegrateOpacity(vtkUnstructuredGrid* tetrahedra, vtkDataArray* array, bool ofCells,
  const std::function<double(const double*)>& opacity)
{
  const int components = array->GetNumberOfComponents();
  std::vector<double> tuples(4 * static_cast<std::size_t>(components));
  std::vector<double> inside(components);
  vtkNew<vtkIdList> ids;
  double sum = 0;
  for (vtkIdType cell = 0; cell < tetrahedra->GetNumberOfCells(); ++cell)
  {
    if (tetrahedra->GetCellType(cell) != VTK_TETRA)
    {
      continue;
    }
    tetrahedra->GetCellPoints(cell, ids);
    double points[4][3];
    for (int i = 0; i < 4; ++i)
    {
      tetrahedra->GetPoint(ids->GetId(i), points[i]);
    }
    const double volume =
      std::abs(vtkTetra::ComputeVolume(points[0], points[1], points[2], points[3]));
    if (ofCells)
    {
      array->GetTuple(cell, inside.data());
      sum += volume * CutOff(opacity(inside.data()));
      continue;
    }
    for (int i = 0; i < 4; ++i)
    {
      array->GetTuple(ids->GetId(i), tuples.data() + static_cast<std::size_t>(i) * components);
    }
    for (int place = 0; place < 4; ++place)
    {
      for (int k = 0; k < components; ++k)
      {
        inside[k] = 0;
        for (int i = 0; i < 4; ++i)
        {
          inside[k] += (i == place ? Large : Small) * tuples[i * components + k];
        }
      }
      sum += 0.25 * volume * CutOff(opacity(inside.data()));
    }
  }
  return sum;
}

double IntegrateOpacity(
  vtkImageData* image, vtkDataArray* array, const std::function<double(const double*)>& opacity)
{
  std::vector<double> tuple(array->GetNumberOfComponents());
  double sum = 0;
  const vtkIdType count = array->GetNumberOfTuples();
  for (vtkIdType i = 0; i < count; ++i)
  {
    array->GetTuple(i, tuple.data());
    sum += CutOff(opacity(tuple.data()));
  }
  int dimensions[3];
  image->GetDimensions(dimensions);
  double volume = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    volume *= image->GetSpacing()[axis] * (dimensions[axis] - 1);
  }
  return count > 0 ? sum / count * std::abs(volume) : 0;
}

double FindUnitDistance(double opacityIntegral, const double bounds[6])
{
  const double x = bounds[1] - bounds[0];
  const double y = bounds[3] - bounds[2];
  const double z = bounds[5] - bounds[4];
  // The mean of what a convex body's random rays integrate: 4 times the integral over the volume,
  // by the surface.
  const double surface = 2 * (x * y + y * z + z * x);
  return surface > 0 && opacityIntegral > 0 ? 4 * opacityIntegral / surface : 0;
}

} // namespace tetralux
