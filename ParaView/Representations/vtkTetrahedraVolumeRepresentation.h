// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraVolumeRepresentation
 * @brief   volumes of unstructured grids by the mappers of Tetralux
 *
 * @sa vtkTetrahedraRayCastMapper, vtkTetrahedraGPURayCastMapper, vtkTetrahedraProjectionMapper
 */
#ifndef vtkTetrahedraVolumeRepresentation_h
#define vtkTetrahedraVolumeRepresentation_h

#include "TetraluxRepresentationsModule.h" // For export macro
#include "vtkTetrahedraRepresentation.h"

class vtkTetrahedraGPURayCastMapper;
class vtkTetrahedraProjectionMapper;
class vtkTetrahedraRayCastMapper;

class TETRALUXREPRESENTATIONS_EXPORT vtkTetrahedraVolumeRepresentation
  : public vtkTetrahedraRepresentation
{
public:
  static vtkTetrahedraVolumeRepresentation* New();
  vtkTypeMacro(vtkTetrahedraVolumeRepresentation, vtkTetrahedraRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum MethodType
  {
    AUTOMATIC_METHOD,
    RAY_CASTING_METHOD,
    GRAPHICS_CARD_METHOD,
    PROJECTION_METHOD
  };

  ///@{
  /**
   * Set the method. Default AUTOMATIC_METHOD.
   *
   * - AUTOMATIC_METHOD: GRAPHICS_CARD_METHOD if the window is drawn by one on which that is faster
   *   and the mesh fits, else RAY_CASTING_METHOD.
   * - RAY_CASTING_METHOD: rays, on the processor.
   * - GRAPHICS_CARD_METHOD: rays, by OpenGL.
   * - PROJECTION_METHOD: projected tetrahedra, by OpenGL.
   */
  vtkSetClampMacro(Method, int, AUTOMATIC_METHOD, PROJECTION_METHOD);
  vtkGetMacro(Method, int);
  ///@}

protected:
  vtkTetrahedraVolumeRepresentation();
  ~vtkTetrahedraVolumeRepresentation() override;

  vtkTetrahedraVolumeMapper* ChooseMapper(vtkRenderWindow* window) override;

private:
  vtkTetrahedraVolumeRepresentation(const vtkTetrahedraVolumeRepresentation&) = delete;
  void operator=(const vtkTetrahedraVolumeRepresentation&) = delete;

  vtkNew<vtkTetrahedraRayCastMapper> RayCaster;
  vtkNew<vtkTetrahedraGPURayCastMapper> GPURayCaster;
  vtkNew<vtkTetrahedraProjectionMapper> Projection;
  int Method = AUTOMATIC_METHOD;
};

#endif
