// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraIsosurfaceRepresentation
 * @brief   isosurfaces of unstructured grids by the mapper of Tetralux
 *
 * Surfaces of the colour array, or of a contour array, coloured by the colour array and its map. If
 * there is no colour array, they have one colour.
 *
 * @sa vtkTetrahedraIsosurfaceMapper
 */
#ifndef vtkTetrahedraIsosurfaceRepresentation_h
#define vtkTetrahedraIsosurfaceRepresentation_h

#include "TetraluxRepresentationsModule.h" // For export macro
#include "vtkTetrahedraRepresentation.h"

#include <string> // For std::string

class vtkColorTransferFunction;
class vtkPiecewiseFunction;
class vtkTetrahedraIsosurfaceMapper;

class TETRALUXREPRESENTATIONS_EXPORT vtkTetrahedraIsosurfaceRepresentation
  : public vtkTetrahedraRepresentation
{
public:
  static vtkTetrahedraIsosurfaceRepresentation* New();
  vtkTypeMacro(vtkTetrahedraIsosurfaceRepresentation, vtkTetrahedraRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Set whether surfaces are of the contour array. Default off: they are of the colour array.
   */
  vtkSetMacro(UseContourArray, bool);
  vtkGetMacro(UseContourArray, bool);

  /**
   * Set the contour array, of points, by its name, the last argument. Default: none.
   */
  void SelectContourArray(int index, int port, int connection, int association, const char* name);

  /**
   * Set the opacity of all surfaces, 0 to 1. Default 1.
   */
  vtkSetClampMacro(Opacity, double, 0, 1);
  vtkGetMacro(Opacity, double);

  /**
   * Set whether surfaces have the opacities of the colour map instead. Default off.
   */
  vtkSetMacro(MapOpacity, bool);
  vtkGetMacro(MapOpacity, bool);

  /**
   * Set the colour of surfaces if there is no colour array. Default white.
   */
  vtkSetVector3Macro(SolidColor, double);
  vtkGetVector3Macro(SolidColor, double);

  ///@{
  /**
   * Set the colour map and its opacities.
   */
  void SetColorMap(vtkColorTransferFunction* colors);
  void SetOpacityMap(vtkPiecewiseFunction* opacities);
  ///@}

protected:
  vtkTetrahedraIsosurfaceRepresentation();
  ~vtkTetrahedraIsosurfaceRepresentation() override;

  vtkTetrahedraVolumeMapper* ChooseMapper(vtkRenderWindow* window) override;
  void UpdateMapper(vtkTetrahedraVolumeMapper* mapper, vtkDataObject* input) override;

private:
  vtkTetrahedraIsosurfaceRepresentation(const vtkTetrahedraIsosurfaceRepresentation&) = delete;
  void operator=(const vtkTetrahedraIsosurfaceRepresentation&) = delete;

  void UpdateProperty(bool colored);

  vtkNew<vtkTetrahedraIsosurfaceMapper> Mapper;
  vtkSmartPointer<vtkColorTransferFunction> ColorMap;
  vtkSmartPointer<vtkPiecewiseFunction> OpacityMap;
  vtkNew<vtkColorTransferFunction> Uniform; ///< SolidColor as a map
  vtkNew<vtkPiecewiseFunction> UniformOpacity;
  bool UseContourArray = false;
  std::string ContourArray;
  double Opacity = 1;
  bool MapOpacity = false;
  double SolidColor[3] = { 1, 1, 1 };
};

#endif
