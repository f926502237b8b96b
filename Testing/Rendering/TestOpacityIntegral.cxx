// SPDX-License-Identifier: BSD-3-Clause
// Unit distances that data ask for, against closed forms.
#include "Preparation/OpacityIntegral.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <limits>

using tetralux::FindUnitDistance;
using tetralux::IntegrateOpacity;

namespace
{

constexpr double Tolerance = 1e-12; // relative, of sums in double precision

/// The corner tetrahedron of a cube, of edge 2, with a scalar at each point.
struct Corner
{
  explicit Corner(const double (&values)[4])
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->InsertNextPoint(0, 0, 0);
    points->InsertNextPoint(2, 0, 0);
    points->InsertNextPoint(0, 2, 0);
    points->InsertNextPoint(0, 0, 2);
    this->Grid->SetPoints(points);
    const vtkIdType ids[4] = { 0, 1, 2, 3 };
    this->Grid->InsertNextCell(VTK_TETRA, 4, ids);
    for (const double value : values)
    {
      this->Array->InsertNextValue(value);
    }
    this->Grid->GetPointData()->AddArray(this->Array);
  }

  vtkNew<vtkUnstructuredGrid> Grid;
  vtkNew<vtkDoubleArray> Array;
};

constexpr double CornerVolume = 8. / 6;

} // namespace

TEST(OpacityIntegral, QuadraticFunctionsOfACellAreExact)
{
  const Corner corner({ 1, 2, 3, 5 });
  const auto square = [](const double* tuple) { return tuple[0] * tuple[0]; };
  // Of a linear field in a tetrahedron: volume times (sum of squares + square of the sum) by 20.
  const double expected = CornerVolume * (39 + 121) / 20;
  EXPECT_NEAR(IntegrateOpacity(corner.Grid, corner.Array, false, square) / expected, 1, Tolerance);
}

TEST(OpacityIntegral, CellsHaveTheirOwnScalar)
{
  const Corner corner({ 0, 0, 0, 0 });
  vtkNew<vtkDoubleArray> array;
  array->InsertNextValue(0.25);
  const auto same = [](const double* tuple) { return tuple[0]; };
  EXPECT_NEAR(IntegrateOpacity(corner.Grid, array, true, same), 0.25 * CornerVolume, Tolerance);
}

TEST(OpacityIntegral, WhatIsNotAboveZeroCountsNothing)
{
  const Corner corner({ 0, 0, 0, 0 });
  for (const double opacity : { -1., std::numeric_limits<double>::quiet_NaN() })
  {
    const auto constant = [=](const double*) { return opacity; };
    EXPECT_EQ(IntegrateOpacity(corner.Grid, corner.Array, false, constant), 0);
  }
}

TEST(OpacityIntegral, ImagesHaveTheMeanOfTheirPoints)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 2, 2);
  image->SetSpacing(0.5, 2, 4);
  vtkNew<vtkDoubleArray> array;
  for (int i = 0; i < 12; ++i)
  {
    array->InsertNextValue(i);
  }
  const auto same = [](const double* tuple) { return tuple[0]; };
  EXPECT_NEAR(IntegrateOpacity(image, array, same), 5.5 * (1 * 2 * 4), Tolerance);
}

TEST(OpacityIntegral, UnitDistanceIsThatOfAMeanChord)
{
  // A cube of edge 3 has a mean chord of 2: 4 volumes by the surface.
  const double bounds[6] = { -1, 2, 0, 3, 5, 8 };
  EXPECT_NEAR(FindUnitDistance(0.5 * 27, bounds), 0.5 * 2, Tolerance);
  EXPECT_EQ(FindUnitDistance(0, bounds), 0);
  const double flat[6] = { 0, 1, 0, 0, 0, 0 };
  EXPECT_EQ(FindUnitDistance(1, flat), 0);
}
