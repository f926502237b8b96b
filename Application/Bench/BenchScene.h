// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchScene_h
#define BenchScene_h

#include "vtkSmartPointer.h"

#include <string>

class vtkDataSet;
class vtkImageData;
class vtkUnstructuredGrid;
class vtkVolumeProperty;

/// What is rendered: tetrahedra or image data, the same with the same scalars by every method.
struct BenchScene
{
  std::string Name;        ///< of files and of --scene, as "blunt-fin-needle"
  std::string Description; ///< one line

  /// Tetrahedra with one active array of one component, of the points or of the cells; nullptr in a
  /// scene of image data.
  vtkSmartPointer<vtkUnstructuredGrid> Mesh;
  bool CellData = false;

  /// Image data with one active array of one component of the points; nullptr in a scene of cells.
  vtkSmartPointer<vtkImageData> Image;

  vtkDataSet* GetData() const;
  bool IsOfImages() const; ///< else of cells

  vtkSmartPointer<vtkVolumeProperty> Property;
};

#endif
