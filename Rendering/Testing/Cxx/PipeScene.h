// SPDX-License-Identifier: BSD-3-Clause
#ifndef PipeScene_h
#define PipeScene_h

#include "vtkColorTransferFunction.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkTetrahedraVolumeMapper.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <string>

/// A pipe with a field on it in a window of 200 x 200 pixels, and the variations on it that have a
/// baseline. The pipe is not convex, so that rays enter it twice.
class PipeScene
{
public:
  PipeScene(vtkRenderWindow* window, vtkTetrahedraVolumeMapper* mapper);

  /// Makes the scene that a name stands for. Returns false if there is none of this name.
  bool Vary(const std::string& name);

private:
  void LookFromInside();
  void AddViewport();
  void ClipAndCrop();
  void UseCellData();
  void UseHsvColors();
  void TransformVolume();
  void ShowIsosurfaces();
  void CastShadows();

  vtkNew<vtkColorTransferFunction> Color;
  vtkNew<vtkPiecewiseFunction> Opacity;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkRenderer> Renderer;
  vtkSmartPointer<vtkUnstructuredGrid> Grid;
  vtkSmartPointer<vtkRenderWindow> Window;
  vtkSmartPointer<vtkTetrahedraVolumeMapper> Mapper;
};

#endif
