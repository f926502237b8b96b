// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraIsosurfaceMapper
 * @brief   isosurfaces of unstructured grids, traced on the processor
 *
 * Renders the surfaces of the property's IsoSurfaceValues, each with its colour and scalar opacity,
 * by tracing packets of rays through a hierarchy over all values of the data (Wald, Friedrich,
 * Knoll and Hansen, Interactive Isosurface Ray Tracing of Time-Varying Tetrahedral Volumes, 2007).
 * A surface is planar in each tetrahedron, as vtkContourFilter extracts it, without holes. Values
 * change at little cost, and so do time steps: new scalars refit ranges, moved points refit boxes.
 *
 * Accepts what vtkTetrahedraVolumeMapper accepts, with scalars at points; scalars at cells are an
 * error. BlendMode is ISOSURFACE_BLEND, and no other. If the property's Shade is on, the lights of
 * the renderer shine on surfaces from both sides; with Shadows surfaces block them. Transparent
 * surfaces are composited in exact order. The picture does not depend on the number of threads.
 *
 * GetStatistics() says what was rebuilt for a frame, and counts what packets did ("traversal").
 * Properties of pre-integration and Reentry are not used.
 *
 * @sa vtkTetrahedraVolumeMapper, vtkContour3DLinearGrid
 */
#ifndef vtkTetrahedraIsosurfaceMapper_h
#define vtkTetrahedraIsosurfaceMapper_h

#include "TetraluxRenderingModule.h" // For export macro
#include "vtkTetrahedraCPUMapper.h"

#include <memory> // For std::unique_ptr

class TETRALUXRENDERING_EXPORT vtkTetrahedraIsosurfaceMapper : public vtkTetrahedraCPUMapper
{
public:
  static vtkTetrahedraIsosurfaceMapper* New();
  vtkTypeMacro(vtkTetrahedraIsosurfaceMapper, vtkTetrahedraCPUMapper);

  /**
   * Accept ISOSURFACE_BLEND, and refuse any other mode with an error.
   */
  void SetBlendMode(int mode) override;

  /**
   * The same with ColorArrayName.
   */
  void ShallowCopy(vtkAbstractMapper* mapper) override;

  ///@{
  /**
   * Set whether surfaces block the light of the renderer's lights, where the property's Shade is on
   * (section 7 of the paper). Default off. Translucent surfaces block light as opaque ones do. What
   * is clipped or cropped away, and geometry of other props, blocks nothing.
   */
  vtkSetMacro(Shadows, vtkTypeBool);
  vtkGetMacro(Shadows, vtkTypeBool);
  vtkBooleanMacro(Shadows, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Set the name of an array of point data that surfaces are coloured by: at each of their points
   * by the property's colour and scalar opacity at the array's value there, interpolated in the
   * cell. Default nullptr: a surface has the colour and opacity of its value. Where the array is
   * not a number, a surface is transparent.
   */
  vtkSetStringMacro(ColorArrayName);
  vtkGetStringMacro(ColorArrayName);
  ///@}

  ///@{
  /**
   * Set the component of the array of ColorArrayName, from 0 up. Default -1: the magnitude of an
   * array of several components.
   */
  virtual void SetColorArrayComponent(int component);
  vtkGetMacro(ColorArrayComponent, int);
  ///@}

  ///@{
  /**
   * Set the angle in degrees that lights are seen under from the centre of the data, 0 to 90.
   * Default 0: hard shadows.
   */
  virtual void SetShadowSoftness(double angle);
  vtkGetMacro(ShadowSoftness, double);
  ///@}

  ///@{
  /**
   * Set whether surfaces block the light that comes from all around a point, where the property's
   * Shade is on: ambient and diffuse light are multiplied by the share that comes through. Default
   * off.
   */
  vtkSetMacro(AmbientOcclusion, vtkTypeBool);
  vtkGetMacro(AmbientOcclusion, vtkTypeBool);
  vtkBooleanMacro(AmbientOcclusion, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Set how far from a point surfaces block light for AmbientOcclusion, in world units, 0 or more.
   * Default 0: a tenth of the diameter of the data.
   */
  virtual void SetAmbientOcclusionRadius(double radius);
  vtkGetMacro(AmbientOcclusionRadius, double);
  ///@}

  ///@{
  /**
   * Set the directions of AmbientOcclusion, and the points of a light with ShadowSoftness, that a
   * frame takes, 1 to 1000. Default 4. The same picture comes out each time; frames in which
   * nothing else changes take further samples, up to MaximumSamples, and show the mean of all.
   */
  virtual void SetSamplesPerFrame(int samples);
  vtkGetMacro(SamplesPerFrame, int);
  ///@}

  ///@{
  /**
   * Set the samples after which a picture is not refined any more, 1 to 100000. Default 256.
   * Further frames trace neither shadows nor occlusion.
   */
  virtual void SetMaximumSamples(int samples);
  vtkGetMacro(MaximumSamples, int);
  ///@}

  ///@{
  /**
   * Set the largest number of bytes for time steps that are kept beside the present one. Default
   * 256 MiB. A step that comes back, known by its points and scalars, rebuilds nothing. 0: none is
   * kept, and the boxes of one hierarchy are refitted in place.
   */
  virtual void SetTimeStepCacheBytes(vtkIdType bytes);
  vtkGetMacro(TimeStepCacheBytes, vtkIdType);
  ///@}

  ///@{
  /**
   * Set how many surfaces a ray meets at most, 0 to 1000. Default 0: as many as MaximumError asks
   * for. What a ray may miss by it is in the error estimate.
   */
  virtual void SetMaximumNumberOfPeels(int peels);
  vtkGetMacro(MaximumNumberOfPeels, int);
  ///@}

protected:
  vtkTetrahedraIsosurfaceMapper();
  ~vtkTetrahedraIsosurfaceMapper() override;

  tetralux::PixelRectangle MakePicture(
    tetralux::MapperFrame& frame, const tetralux::PictureTask& picture) override;
  void AddSettings(tetralux::MapperSettings& settings) override;
  void PrintProperties(ostream& os, vtkIndent indent) override;

  char* ColorArrayName = nullptr;
  int ColorArrayComponent = -1;
  vtkTypeBool Shadows = 0;
  double ShadowSoftness = 0;
  vtkTypeBool AmbientOcclusion = 0;
  double AmbientOcclusionRadius = 0;
  int SamplesPerFrame = 4;
  int MaximumSamples = 256;
  vtkIdType TimeStepCacheBytes = 256 << 20;
  int MaximumNumberOfPeels = 0;

private:
  vtkTetrahedraIsosurfaceMapper(const vtkTetrahedraIsosurfaceMapper&) = delete;
  void operator=(const vtkTetrahedraIsosurfaceMapper&) = delete;

  class Internals;
  std::unique_ptr<Internals> Private;
};

#endif
