// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraVolumeMapper
 * @brief   what all mappers have in common that render unstructured grids with a known error
 *
 * Accepts whatever vtkTetrahedraFilter accepts: unstructured, structured, rectilinear and image
 * grids, any other vtkDataSet, and composites of these. Cells that can't be rendered are left out
 * and counted, see GetStatistics(), with one warning where their types are not supported. A point
 * or cell whose scalar is not a finite number leaves the cells that touch it empty.
 *
 * Optical model: attenuation per world unit is the scalar opacity over the property's
 * ScalarOpacityUnitDistance, radiance is the integral of attenuation x colour x exp(-optical
 * depth). That is the model of VTK's own mappers of unstructured grids, not the 1 - (1 - a)^(l / d)
 * of its mappers of image data. The property's colour (RGB in any colour space, or grey), scalar
 * opacity and unit distance of component 0 are used at the exact scalars of their nodes. Other
 * BlendModes are below. Where the property's Shade is on, lights of the renderer shine on composite
 * volumes and isosurfaces of scalars at points, from the side of the viewer: ambient, diffuse and
 * specular (Blinn) as in VTK's mappers of image data. Gradient opacity, and Shade elsewhere, are not
 * used, and one warning says so.
 *
 * Any vtkCamera, vtkVolume transform, viewport and tiled display; the camera may be inside. Opaque
 * geometry may be in front of, inside and behind the volume. Clipping planes of vtkAbstractMapper
 * are in world coordinates and keep their positive side, as in VTK's other mappers.
 *
 * What is built is kept: tetrahedra and their neighbours until points, cells or ghost flags of the
 * input change, scalars until the array or the choice of it changes, the transfer function until
 * the property changes. A new camera rebuilds nothing.
 *
 * Mappers are created by name, there is no object factory behind them. Errors are reported once for
 * each cause; the volume is then not drawn.
 *
 * @sa vtkTetrahedraRayCastMapper, vtkTetrahedraGPURayCastMapper, vtkTetrahedraProjectionMapper
 */
#ifndef vtkTetrahedraVolumeMapper_h
#define vtkTetrahedraVolumeMapper_h

#include "TetraluxRenderingModule.h" // For export macro
#include "vtkUnstructuredGridVolumeMapper.h"

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkDataObject;
class vtkImageData;

namespace tetralux
{
struct MapperFrame;
} // namespace tetralux

class TETRALUXRENDERING_EXPORT vtkTetrahedraVolumeMapper : public vtkUnstructuredGridVolumeMapper
{
public:
  vtkTypeMacro(vtkTetrahedraVolumeMapper, vtkUnstructuredGridVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The input, where it does not come through SetInputConnection. GetInput() of the superclass
   * returns it only if it is an unstructured grid, GetDataObjectInput() always.
   */
  void SetInputData(vtkUnstructuredGridBase* input) override;
  void SetInputData(vtkDataSet* input) override;
  virtual void SetInputData(vtkDataObject* input);
  ///@}

  ///@{
  /**
   * Bounds of the input, of a composite those of all its blocks.
   */
  double* GetBounds() VTK_SIZEHINT(6) override;
  using Superclass::GetBounds;
  ///@}

  ///@{
  /**
   * Error aimed at, of each premultiplied colour channel and of the opacity, absolute, 0..1.
   * Default 1e-4. Rays end where what is behind can't matter, arithmetic is single or double
   * precision, and colour functions that are not piecewise linear are subdivided, each as far as
   * this allows. Where a frame's GetErrorEstimate() is above it, one warning for each cause has
   * both numbers; below 1e-6 there is none, since the single precision of the result is the limit.
   */
  vtkSetClampMacro(MaximumError, double, 0.0, 1.0);
  vtkGetMacro(MaximumError, double);
  ///@}

  /**
   * What BlendMode may be beside COMPOSITE_BLEND (default) and MAXIMUM_INTENSITY_BLEND, with the
   * numbers of vtkVolumeMapper where it has them (Weiler et al. 2003, section 4).
   *
   * MAXIMUM_INTENSITY_BLEND: colour and scalar opacity of the largest scalar along a ray.
   * ADDITIVE_BLEND: light adds up and nothing is absorbed; the opacity of the picture is 0.
   * ISOSURFACE_BLEND: the surfaces of the property's IsoSurfaceValues, each with its colour and
   * scalar opacity, composited front to back; where Shade is on, lit by the lights of the renderer
   * from both sides. Scalars must be at points.
   * ABSORPTION_BLEND: dark smoke, without colour, that hides what is behind.
   */
  enum FurtherBlendModes
  {
    ADDITIVE_BLEND = 4,
    ISOSURFACE_BLEND = 5,
    ABSORPTION_BLEND = 16
  };
  void SetBlendModeToAdditive() { this->SetBlendMode(ADDITIVE_BLEND); }
  void SetBlendModeToIsoSurface() { this->SetBlendMode(ISOSURFACE_BLEND); }
  void SetBlendModeToAbsorption() { this->SetBlendMode(ABSORPTION_BLEND); }

  enum IntegrationType
  {
    AUTOMATIC_INTEGRATION,
    CLOSED_FORM,
    TABLE
  };

  ///@{
  /**
   * How segments of composite blending are integrated. Automatic (default): by a table where that is
   * faster and right enough for a quarter of MaximumError, else in closed form, which is exact.
   * TABLE: by a table in any case, the smallest that is right enough or else the best within
   * TableMaximumBytes; GetErrorEstimate() says how right. Scalars at cells, constant colours and
   * other blend modes need no table and have none.
   */
  vtkSetClampMacro(Integration, int, AUTOMATIC_INTEGRATION, TABLE);
  vtkGetMacro(Integration, int);
  void SetIntegrationToAutomatic() { this->SetIntegration(AUTOMATIC_INTEGRATION); }
  void SetIntegrationToClosedForm() { this->SetIntegration(CLOSED_FORM); }
  void SetIntegrationToTable() { this->SetIntegration(TABLE); }
  ///@}

  ///@{
  /**
   * Texels of a table along each of the two scalars and along the length of a segment, 2..4096; 0
   * (default): chosen by MaximumError.
   */
  vtkSetClampMacro(TableScalarSize, int, 0, 4096);
  vtkGetMacro(TableScalarSize, int);
  vtkSetClampMacro(TableLengthSize, int, 0, 4096);
  vtkGetMacro(TableLengthSize, int);
  ///@}

  enum TableLengthScaleType
  {
    AUTOMATIC_SCALE,
    LINEAR_SCALE,
    LOGARITHMIC_SCALE
  };

  ///@{
  /**
   * How texels lie along the length: in equal steps (Weiler et al. 2003), or in steps that double
   * (Kraus et al. 2004, equation 1). Automatic by default.
   */
  vtkSetClampMacro(TableLengthScale, int, AUTOMATIC_SCALE, LOGARITHMIC_SCALE);
  vtkGetMacro(TableLengthScale, int);
  ///@}

  enum TableScalarAxisType
  {
    AUTOMATIC_AXIS,
    UNIFORM_AXIS,
    NODES_AXIS
  };

  ///@{
  /**
   * How texels lie along the scalars: in equal steps, or on the nodes of the transfer function.
   * Automatic by default.
   */
  vtkSetClampMacro(TableScalarAxis, int, AUTOMATIC_AXIS, NODES_AXIS);
  vtkGetMacro(TableScalarAxis, int);
  ///@}

  enum TableFormatType
  {
    AUTOMATIC_FORMAT,
    UNORM8_FORMAT,
    UNORM16_FORMAT,
    HALF_FORMAT,
    FLOAT_FORMAT
  };

  ///@{
  /**
   * What texels are rounded to; automatic by default. The formats of textures: on the graphics
   * card texels have them; on the processor, where their error can so be studied, rays read texels in
   * single precision in any case, and only that needs no copy of them.
   */
  vtkSetClampMacro(TableFormat, int, AUTOMATIC_FORMAT, FLOAT_FORMAT);
  vtkGetMacro(TableFormat, int);
  ///@}

  ///@{
  /**
   * The most bytes that a table may take, default 64 MiB.
   */
  vtkSetClampMacro(TableMaximumBytes, vtkIdType, 65536, VTK_ID_MAX);
  vtkGetMacro(TableMaximumBytes, vtkIdType);
  ///@}

  ///@{
  /**
   * Whether lighting, where the property's Shade is on, takes its normals from gradients that are
   * interpolated between the points, each the mean of its cells' gradients by volume: smooth. Off, each
   * cell has its own gradient, and facets show. On by default.
   */
  vtkSetMacro(SmoothShading, vtkTypeBool);
  vtkGetMacro(SmoothShading, vtkTypeBool);
  vtkBooleanMacro(SmoothShading, vtkTypeBool);
  ///@}

  enum VectorModeType
  {
    DISABLED = -1,
    MAGNITUDE = 0,
    COMPONENT = 1
  };

  ///@{
  /**
   * How an array of several components becomes the scalar, as in vtkSmartVolumeMapper: DISABLED
   * (default), the first component; MAGNITUDE, the Euclidean norm; COMPONENT, component
   * VectorComponent, counted from 0, which is 0 by default and must exist.
   */
  vtkSetClampMacro(VectorMode, int, DISABLED, COMPONENT);
  vtkGetMacro(VectorMode, int);
  vtkSetClampMacro(VectorComponent, int, 0, VTK_INT_MAX);
  vtkGetMacro(VectorComponent, int);
  ///@}

  ///@{
  /**
   * Whether rays end at opaque geometry that was drawn before, by the depth buffer. On by default;
   * off, the volume is in front of all geometry.
   */
  vtkSetMacro(IntermixIntersectingGeometry, vtkTypeBool);
  vtkGetMacro(IntermixIntersectingGeometry, vtkTypeBool);
  vtkBooleanMacro(IntermixIntersectingGeometry, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether only some of the 27 regions are rendered that CroppingRegionPlanes (xmin, xmax, ymin,
   * ymax, zmin, zmax, in coordinates of the data; default 0, 1, 0, 1, 0, 1) cut space into. As in
   * vtkVolumeMapper. Off by default.
   */
  vtkSetMacro(Cropping, vtkTypeBool);
  vtkGetMacro(Cropping, vtkTypeBool);
  vtkBooleanMacro(Cropping, vtkTypeBool);
  vtkSetVector6Macro(CroppingRegionPlanes, double);
  vtkGetVector6Macro(CroppingRegionPlanes, double);
  ///@}

  ///@{
  /**
   * Which regions are rendered: bit x + 3 y + 9 z is that of region x, y, z, each 0 below, 1
   * between and 2 above its two planes. Default: the subvolume between the planes, 0x2000.
   */
  vtkSetClampMacro(CroppingRegionFlags, int, 0x0, 0x7ffffff);
  vtkGetMacro(CroppingRegionFlags, int);
  void SetCroppingRegionFlagsToSubVolume() { this->SetCroppingRegionFlags(0x0002000); }
  void SetCroppingRegionFlagsToFence() { this->SetCroppingRegionFlags(0x2ebfeba); }
  void SetCroppingRegionFlagsToInvertedFence() { this->SetCroppingRegionFlags(0x5140145); }
  void SetCroppingRegionFlagsToCross() { this->SetCroppingRegionFlags(0x0417410); }
  void SetCroppingRegionFlagsToInvertedCross() { this->SetCroppingRegionFlags(0x7be8bef); }
  ///@}

  /**
   * The picture of the last frame as it was cast, before anything was done to it: one point for
   * each ray, bottom row first, over the viewport, or the part of it in the window. Point arrays
   * RGBA, the scalars: four floats, premultiplied, without any background; Depth: a float, distance
   * along the ray in world units, from the camera or in a parallel projection from the plane
   * through it, to the first contribution, -1 where there is none. Empty before the first frame and
   * after one that failed; incomplete after one that was aborted. Belongs to the mapper, which
   * overwrites it in the next frame.
   */
  vtkImageData* GetOutputImage();

  /**
   * What the last frame was made of, as JSON: what was rebuilt, times in seconds, counts, the error
   * estimate, what the scene did not need. "{}" before the first frame.
   */
  std::string GetStatistics();

  /**
   * Estimated largest error of a channel in the last frame, absolute, 0..1. The sum of what
   * GetStatistics() has below "error": ending rays early, the integrals, adding segments up in
   * single precision or in the colour buffer, tables, rounding coordinates and scalars
   * ("geometry"), a wrong order of cells, and colour functions that were subdivided.
   *
   * Tables and "geometry" are measured on some thousand rays through the mesh. Where "geometry" is
   * not 0, pixels that graze are not covered: those in which the exact picture itself changes by
   * more than the estimate where the ray moves across by 2^-22 of the mesh's radius. Their rays
   * touch the boundary, a face between cells of different constant scalars, or a surface along
   * which the transfer function jumps. They are some forty of a million.
   *
   * Not covered either: interpolation between rays more than a pixel apart,
   * PerspectiveInterpolation off, isosurfaces, which rays meet or miss, and nodes of the transfer
   * function that are nearer to each other than 1e-6 of its range: they are rounded to 6e-8 of it.
   */
  double GetErrorEstimate();

  ///@{
  /**
   * Of the last mesh: cells of types that can't be rendered; tetrahedra taken out because they are
   * duplicated, repeat a point or have one that is no number; tetrahedra left empty because they
   * touch a scalar that is not finite.
   */
  vtkIdType GetNumberOfSkippedCells();
  vtkIdType GetNumberOfRemovedCells();
  vtkIdType GetNumberOfBlankCells();
  ///@}

  /**
   * WARNING: INTERNAL METHOD - NOT INTENDED FOR GENERAL USE
   *
   * Draws one frame. Invokes VolumeMapperRenderStartEvent, VolumeMapperRenderProgressEvent
   * with a double 0..1, and VolumeMapperRenderEndEvent; while the mesh is built, ProgressEvent.
   * Each time the render window is asked whether to abort: an aborted frame is not drawn. Draws
   * nothing where a vtkHardwareSelector looks for what is under the cursor: volumes have no ids.
   */
  void Render(vtkRenderer* renderer, vtkVolume* volume) override;

protected:
  vtkTetrahedraVolumeMapper();
  ~vtkTetrahedraVolumeMapper() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;

  /**
   * Draws a frame whose scene is prepared, into the window and, unless it is read later, into the
   * picture; fills what the frame tells about itself, also where it was aborted. What it throws
   * becomes an error of one line.
   */
  virtual void DrawFrame(tetralux::MapperFrame& frame) = 0;

  double MaximumError = 1e-4;
  int Integration = AUTOMATIC_INTEGRATION;
  int TableScalarSize = 0;
  int TableLengthSize = 0;
  int TableLengthScale = AUTOMATIC_SCALE;
  int TableScalarAxis = AUTOMATIC_AXIS;
  int TableFormat = AUTOMATIC_FORMAT;
  vtkIdType TableMaximumBytes = 64 << 20;
  vtkTypeBool SmoothShading = 1;
  int VectorMode = DISABLED;
  int VectorComponent = 0;
  vtkTypeBool IntermixIntersectingGeometry = 1;
  vtkTypeBool Cropping = 0;
  double CroppingRegionPlanes[6] = { 0, 1, 0, 1, 0, 1 };
  int CroppingRegionFlags = 0x2000;

private:
  vtkTetrahedraVolumeMapper(const vtkTetrahedraVolumeMapper&) = delete;
  void operator=(const vtkTetrahedraVolumeMapper&) = delete;

  class Internals;
  std::unique_ptr<Internals> Private;
};

#endif
