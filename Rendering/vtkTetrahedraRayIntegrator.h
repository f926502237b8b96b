// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraRayIntegrator
 * @brief   the ray integral in closed form, for VTK's own ray casting of unstructured grids
 *
 * Give it to vtkUnstructuredGridVolumeRayCastMapper::SetRayIntegrator in place of VTK's
 * pre-integration tables. The transfer functions are taken exactly as vtkVolumeProperty defines
 * them (VTK's own integrators leave out nodes of the opacity where the colour has none), and what a
 * segment adds is evaluated in double precision, with a relative error below 1e-12 (see
 * RayIntegral.h; Weiler et al., Hardware-Based Ray Casting for Tetrahedral Meshes, 2003, section
 * 3.3). Attenuation is ScalarOpacity / ScalarOpacityUnitDistance, as in VTK's integrators.
 *
 * Scalars may have
 * - one component, of points or of cells;
 * - several independent components: clouds that share space, as in
 *   vtkUnstructuredGridLinearRayIntegrator: attenuations add up, colours are weighted by them where
 *   a function has a node and at the ends of the segment, and are linear in between;
 * - four that depend on each other, red, green, blue and opacity as they are, or two, grey and
 *   opacity, where vtkVolumeProperty::IndependentComponents is off.
 * Segments with a scalar that is not finite contribute nothing.
 *
 * What it cannot mend is on the side of VTK 9.1's mapper and its
 * vtkUnstructuredGridBunykRayCastFunction: rays go through the lower left corners of pixels; in
 * perspective, scalars are interpolated in the image plane, which is wrong by about the share of a
 * cell's depth in its distance; a ray exactly through an edge of the boundary passes the mesh
 * twice, so that its optical depth doubles; integer scalars are rounded on every face; rays end at
 * an opacity of 0.99; and the picture has 8 bits a channel, rounded down, and is stretched by a
 * pixel. vtkTetrahedraRayCastMapper has none of this.
 *
 * Integrate may be called from several threads at once, Initialize not at the same time.
 *
 * @sa vtkTetrahedraRayCastMapper, vtkUnstructuredGridPreIntegration
 */
#ifndef vtkTetrahedraRayIntegrator_h
#define vtkTetrahedraRayIntegrator_h

#include "TetraluxRenderingModule.h"
#include "vtkUnstructuredGridVolumeRayIntegrator.h"

#include <memory> // for std::unique_ptr

class TETRALUXRENDERING_EXPORT vtkTetrahedraRayIntegrator
  : public vtkUnstructuredGridVolumeRayIntegrator
{
public:
  static vtkTetrahedraRayIntegrator* New();
  vtkTypeMacro(vtkTetrahedraRayIntegrator, vtkUnstructuredGridVolumeRayIntegrator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set the largest error per premultiplied channel, 1e-9 to 1, up to which functions of the
   * property that are not piecewise linear (other colour spaces than RGB, sharpness, logarithmic
   * scale) are subdivided. Default 1e-5. Piecewise linear functions are exact. NaN is refused with
   * an error.
   */
  virtual void SetMaximumError(double error);
  vtkGetMacro(MaximumError, double);
  ///@}

  /**
   * Takes the functions of the volume's property, for scalars of that many components. Segments
   * contribute nothing after an error: about components that the property does not describe, a unit
   * distance that is not positive, or values that are not finite.
   */
  void Initialize(vtkVolume* volume, vtkDataArray* scalars) override;

  void Integrate(vtkDoubleArray* intersectionLengths, vtkDataArray* nearIntersections,
    vtkDataArray* farIntersections, float color[4]) override;

protected:
  vtkTetrahedraRayIntegrator();
  ~vtkTetrahedraRayIntegrator() override;

private:
  vtkTetrahedraRayIntegrator(const vtkTetrahedraRayIntegrator&) = delete;
  void operator=(const vtkTetrahedraRayIntegrator&) = delete;

  struct Optics;
  std::unique_ptr<Optics> Current;
  double MaximumError = 1e-5;
};

#endif
