// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraRayCastMapper
 * @brief   direct volume rendering of unstructured grids by cell-to-cell ray casting on the CPU
 *
 * Renders the cells of a data set as a volume with a known error. The integral over each cell is
 * evaluated in closed form, never sampled. The picture does not depend on the number of threads.
 * See vtkTetrahedraVolumeMapper for the input, the optical models and their properties. Reentry is
 * AUTOMATIC_REENTRY, BOUNDARY_HIERARCHY_REENTRY or IMAGINARY_CELLS_REENTRY; the hierarchy was
 * faster in every scene that was measured.
 *
 * @sa vtkTetrahedralizeCells, vtkUnstructuredGridVolumeRayCastMapper
 */
#ifndef vtkTetrahedraRayCastMapper_h
#define vtkTetrahedraRayCastMapper_h

#include "TetraluxRenderingModule.h" // For export macro
#include "vtkTetrahedraCPUMapper.h"

class TETRALUXRENDERING_EXPORT vtkTetrahedraRayCastMapper : public vtkTetrahedraCPUMapper
{
public:
  static vtkTetrahedraRayCastMapper* New();
  vtkTypeMacro(vtkTetrahedraRayCastMapper, vtkTetrahedraCPUMapper);

  enum PrecisionType
  {
    AUTOMATIC_PRECISION,
    SINGLE_PRECISION,
    DOUBLE_PRECISION
  };

  ///@{
  /**
   * Set the arithmetic of the geometry along rays. Default AUTOMATIC_PRECISION: single if its
   * estimated error is within a quarter of MaximumError, else double. Double precision takes 32
   * bytes a point more. Several components at once are always cast in double precision.
   */
  virtual void SetPrecision(int precision);
  vtkGetMacro(Precision, int);
  const char* GetPrecisionAsString();
  void SetPrecisionToAutomatic() { this->SetPrecision(AUTOMATIC_PRECISION); }
  void SetPrecisionToSingle() { this->SetPrecision(SINGLE_PRECISION); }
  void SetPrecisionToDouble() { this->SetPrecision(DOUBLE_PRECISION); }
  ///@}

protected:
  vtkTetrahedraRayCastMapper();
  ~vtkTetrahedraRayCastMapper() override;

  tetralux::PixelRectangle MakePicture(
    tetralux::MapperFrame& frame, const tetralux::PictureTask& picture) override;
  void AddSettings(tetralux::MapperSettings& settings) override;
  void PrintProperties(ostream& os, vtkIndent indent) override;

  int Precision = AUTOMATIC_PRECISION;

private:
  vtkTetrahedraRayCastMapper(const vtkTetrahedraRayCastMapper&) = delete;
  void operator=(const vtkTetrahedraRayCastMapper&) = delete;
};

#endif
