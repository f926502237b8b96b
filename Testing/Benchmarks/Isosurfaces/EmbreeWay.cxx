// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurfaces/EmbreeWay.h"

#include "Base/Stopwatch.h"

#include "vtkPolyData.h"

namespace tetralux
{

EmbreeWay::EmbreeWay(vtkUnstructuredGrid* grid, const EmbreeView& view, RTCBuildQuality quality,
  ScalarTree tree, int threads)
  : Quality(quality)
  , Tree(tree)
  , Extraction(grid, tree)
  , Surface(quality, threads)
  , View(view)
{
}

std::string EmbreeWay::GetName() const
{
  return std::string("extraction + Embree, ") +
    (this->Quality == RTC_BUILD_QUALITY_LOW ? "low" : "medium") +
    (this->Tree == ScalarTree::On ? ", scalar tree" : "");
}

void EmbreeWay::SetCase(IsosurfaceCase which)
{
  this->View.Shadows = which == IsosurfaceCase::Shadows;
  this->View.TwoLayers = which == IsosurfaceCase::TwoLayers;
}

IsosurfaceTimes EmbreeWay::DrawFrame()
{
  IsosurfaceTimes times;
  times.Extract = this->Extraction.Update();
  Stopwatch stopwatch;
  vtkPolyData* triangles = this->Extraction.GetSurface();
  if (this->BuiltOf != triangles->GetMTime())
  {
    this->Surface.Build(triangles);
    this->BuiltOf = triangles->GetMTime();
  }
  times.Build = stopwatch.Lap();
  this->Surface.Trace(this->View, this->Picture);
  times.Draw = stopwatch.Lap();
  return times;
}

vtkIdType EmbreeWay::GetNumberOfTriangles() const
{
  return this->Extraction.GetSurface()->GetNumberOfPolys();
}

vtkIdType EmbreeWay::CountCoveredPixels()
{
  vtkIdType covered = 0;
  for (std::size_t alpha = 3; alpha < this->Picture.size(); alpha += 4)
  {
    covered += this->Picture[alpha] > 0;
  }
  return covered;
}

} // namespace tetralux
