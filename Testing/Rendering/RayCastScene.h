// SPDX-License-Identifier: BSD-3-Clause
#ifndef RayCastScene_h
#define RayCastScene_h

#include "ImageComparison.h"
#include "Mesh/TetrahedralMesh.h"
#include "Optics/TransferFunction.h"
#include "TestGrid.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include "vtkCamera.h"
#include "vtkColorTransferFunction.h"
#include "vtkHeadlessRenderWindow.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

using Vector = std::array<double, 3>;

/// Expects that something is drawn, and that no channel differs by more than a tolerance.
void ExpectSamePicture(const std::vector<float>& picture, const std::vector<float>& expected,
  double tolerance, const char* name);

/// A volume in a window of its own, and what the reference renderer needs to know about it.
class RayCastScene
{
public:
  /// A box of jittered cells from a lower corner on, with MakeField on it; a linear transfer
  /// function with positive opacities; a perspective camera in front of it, for which the box fills
  /// the image.
  explicit RayCastScene(
    int width = 96, int height = 72, const Vector& lower = { 0, 0, 0 }, double size = 1);

  /// In units of the box, from its lower corner.
  void SetCamera(const Vector& position, const Vector& focalPoint, const Vector& viewUp,
    double nearDistance = 0.01, double farDistance = 100);

  /// The rays of the camera and its clipping range, from what SetCamera was told and the size of
  /// the viewport; nothing is asked of vtkCamera or the mapper.
  tetralux::RayGrid MakeReferenceRays(int width, int height) const;
  tetralux::RayLimits MakeReferenceLimits() const;

  /// Renders the window and compares colours and depths of the mapper's picture with the reference
  /// renderer, at every pixel that no silhouette grazes.
  void ExpectReference(const tetralux::RayGrid& rays, const tetralux::RayLimits& limits);

  /// With the mapper's own viewport filling the window.
  void ExpectReference();

  /// Renders with another mapper instead of Mapper.
  void Use(vtkTetrahedraVolumeMapper* mapper);

  /// The one that the volume has.
  vtkTetrahedraVolumeMapper* GetMapper() const { return this->Used; }

  const float* GetColors() const;
  const float* GetDepths() const;

  vtkNew<vtkHeadlessRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkTetrahedraRayCastMapper> Mapper;
  vtkNew<vtkColorTransferFunction> Color;
  vtkNew<vtkPiecewiseFunction> Opacity;
  tetralux::TetrahedralMesh Mesh;
  std::vector<double> Scalars;
  bool CellScalars = false;
  vtkSmartPointer<vtkUnstructuredGrid> Grid;
  tetralux::TransferFunction Function;
  Vector Lower;
  double Size;
  bool Parallel = false;
  double ParallelScale = 0.8; ///< in units of the box
  double ViewAngle = 30;      ///< degrees

private:
  Vector ToWorld(const Vector& x) const;

  vtkSmartPointer<vtkTetrahedraVolumeMapper> Used;
  Vector Position;
  Vector FocalPoint;
  Vector ViewUp;
  double NearDistance = 0;
  double FarDistance = 0;
};

#endif
