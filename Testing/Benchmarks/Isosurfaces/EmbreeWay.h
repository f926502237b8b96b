// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_EmbreeWay_h
#define tetralux_EmbreeWay_h

#include "Isosurfaces/EmbreeSurface.h"
#include "Isosurfaces/IsosurfaceWay.h"
#include "Isosurfaces/SurfaceExtraction.h"

#include <vector>

namespace tetralux
{

/// Extracts triangles, builds Embree's hierarchy over them if they are new, and traces rays. The
/// picture stays in memory: nothing is put into a window.
class EmbreeWay : public IsosurfaceWay
{
public:
  EmbreeWay(vtkUnstructuredGrid* grid, const EmbreeView& view, RTCBuildQuality quality,
    ScalarTree tree, int threads);

  std::string GetName() const override;
  bool Takes(IsosurfaceCase) const override { return true; }
  void SetCase(IsosurfaceCase which) override;
  void SetIsovalue(double isovalue) override { this->Extraction.SetIsovalue(isovalue); }
  IsosurfaceTimes DrawFrame() override;
  vtkIdType GetNumberOfTriangles() const override;
  vtkIdType CountCoveredPixels() override;

private:
  RTCBuildQuality Quality;
  ScalarTree Tree;
  SurfaceExtraction Extraction;
  EmbreeSurface Surface;
  EmbreeView View;
  vtkMTimeType BuiltOf = 0; ///< modification time of the triangles
  std::vector<float> Picture;
};

} // namespace tetralux

#endif
