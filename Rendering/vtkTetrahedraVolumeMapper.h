// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTetrahedraVolumeMapper
 * @brief   what all mappers have in common that render unstructured grids with a known error
 *
 * Accepts what vtkTetrahedralizeCells accepts: unstructured, structured, rectilinear and image
 * grids, any other vtkDataSet, and composites of these. Skips cells that can't be rendered and
 * counts them, see GetStatistics(); one warning names types that are not supported. Cells that
 * touch a scalar that is not a finite number are empty.
 *
 * A ray goes through connected cells (cells that share faces) until it leaves them, then comes in
 * at the next boundary face, in the order of the entries' distances. Parts that overlap thus
 * contribute each, one after the other, in the order in which the ray enters them. Cells that can't
 * be seen may be left out; they then connect nothing. The depth of a pixel is the nearest
 * contribution.
 *
 * Optical model: attenuation per world unit is the scalar opacity over the property's
 * ScalarOpacityUnitDistance. Radiance is the integral of attenuation x colour x exp(-optical
 * depth). VTK's own mappers of unstructured grids have the same model; its mappers of image data
 * have 1 - (1 - a)^(l / d). The property's colour (RGB in any colour space, or grey), scalar
 * opacity and unit distance of component 0 are used at the exact scalars of their nodes; those of
 * further components where SetVectorMode() says so. SetBlendMode() has the other models.
 *
 * If the property's Shade is on, lights of the renderer shine on composite volumes and isosurfaces
 * of scalars at points, from the side of the viewer: ambient, diffuse and specular (Blinn) as in
 * VTK's mappers of image data. What is lit is integrated along each ray, within a quarter of
 * MaximumError; by gradients of cells and under distant lights it is exact. Mappers that draw on
 * the graphics card take at most 8 lights, more are an error.
 *
 * Any vtkCamera, vtkVolume transform, viewport and tiled display; the camera may be inside. Opaque
 * geometry may be in front of, inside and behind the volume. Clipping planes of vtkAbstractMapper
 * are in world coordinates and keep their positive side, as in VTK's other mappers.
 *
 * What is built is cached: tetrahedra and their neighbours until points, cells or ghost flags of
 * the input change, scalars until the array or the choice of it changes, the transfer function
 * until the property changes. A new camera rebuilds nothing. Values that were changed in place
 * count once Modified() was called of their array, of the points or the cells, or of the input:
 * then what the input has is compared with what was built, and rebuilt where it differs.
 *
 * The superclass is that of VTK's own mappers of unstructured grids, since vtkVolumeMapper takes
 * only image data and rectilinear grids; vtkVolume and renderers treat both alike. Of
 * vtkVolumeMapper there are, by the same names and numbers, BlendMode (composite, maximum
 * intensity, additive, isosurface), Cropping, CroppingRegionPlanes and CroppingRegionFlags; of its
 * subclasses VectorMode and VectorComponent, ImageSampleDistance with its limits and
 * AutoAdjustSampleDistances. There are no minimum, average and slice blending, no masks and no
 * gradient opacity. There is no SampleDistance: rays are not sampled. Every call of
 * VTK's mappers of unstructured grids is there; Documentation/from_vtk.md has what it does.
 *
 * Mappers are created by name; there is no object factory behind them. Each cause of an error is
 * reported once; the volume is then not drawn. Setters clamp numbers to the range that is stated,
 * and refuse, with an error that names the right values, any other value of an enumeration and NaN.
 *
 * In a window with MultiSamples, where a ray is a pixel, pixels at edges are cast once for each
 * sample, through its own place and up to its own opaque depth: edges of opaque geometry, and
 * wherever colours change unevenly. What no ray through the middle of a pixel meets is not found.
 * GetOutputImage has one ray a pixel. A picture that light samples refine over several frames gets
 * its samples at edges with the last of them. In an interaction, only if there is time.
 *
 * @warning Gradient opacity is not used, nor is Shade with other blend modes or scalars at cells;
 * one warning says so.
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
class vtkRenderWindow;
class vtkUnstructuredGridVolumeRayCastFunction;
class vtkUnstructuredGridVolumeRayIntegrator;
class vtkVisibilitySort;

namespace tetralux
{
struct MapperFrame;
struct MapperSettings;
struct RayDistances;
class WalkMesh;
} // namespace tetralux

class TETRALUXRENDERING_EXPORT vtkTetrahedraVolumeMapper : public vtkUnstructuredGridVolumeMapper
{
public:
  vtkTypeMacro(vtkTetrahedraVolumeMapper, vtkUnstructuredGridVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Copy the input, the choice of the array, clipping planes, and of a mapper of this project all
   * properties that both have. Values that this mapper does not honour stay as they are. The data
   * are shared.
   */
  void ShallowCopy(vtkAbstractMapper* mapper) override;

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

  /**
   * Values of BlendMode beside COMPOSITE_BLEND and MAXIMUM_INTENSITY_BLEND of the superclass, with
   * the numbers of vtkVolumeMapper where it has them (Weiler et al. 2003, section 4).
   */
  enum FurtherBlendModes
  {
    ADDITIVE_BLEND = 4,
    ISOSURFACE_BLEND = 5,
    ABSORPTION_BLEND = 16
  };

  ///@{
  /**
   * Set what rays gather. Default COMPOSITE_BLEND. Any other number, such as vtkVolumeMapper's
   * MINIMUM_INTENSITY_BLEND and AVERAGE_INTENSITY_BLEND, is refused with an error.
   *
   * - COMPOSITE_BLEND (0): emission and absorption.
   * - MAXIMUM_INTENSITY_BLEND (1): colour and scalar opacity of the largest scalar along a ray.
   * - ADDITIVE_BLEND (4): emission without absorption; the picture has opacity 0.
   * - ISOSURFACE_BLEND (5): the surfaces of the property's IsoSurfaceValues, each with its colour
   *   and scalar opacity, composited front to back. If Shade is on, the lights of the renderer
   *   shine on them from both sides.
   * - ABSORPTION_BLEND (16): absorption without emission: dark smoke.
   *
   * @warning ISOSURFACE_BLEND needs scalars at points.
   */
  void SetBlendMode(int mode) override;
  const char* GetBlendModeAsString();
  void SetBlendModeToAdditive() { this->SetBlendMode(ADDITIVE_BLEND); }
  void SetBlendModeToIsoSurface() { this->SetBlendMode(ISOSURFACE_BLEND); }
  void SetBlendModeToAbsorption() { this->SetBlendMode(ABSORPTION_BLEND); }
  ///@}

  ///@{
  /**
   * Set the largest absolute error per premultiplied channel, 0 to 1. Default 1e-4. Rays end early,
   * arithmetic is in single precision, and a few parabolas stand for the colour function, each as
   * far as its share of this error allows (0: none). If the GetErrorEstimate() of a frame is above
   * it, one warning for each cause has both numbers.
   *
   * @warning Below 1e-6 the single precision of the picture limits the error, and no warning is
   * given.
   */
  virtual void SetMaximumError(double error);
  vtkGetMacro(MaximumError, double);
  ///@}

  enum IntegrationType
  {
    AUTOMATIC_INTEGRATION,
    CLOSED_FORM_INTEGRATION,
    TABLE_INTEGRATION
  };

  ///@{
  /**
   * Set how segments of composite blending are integrated. Default AUTOMATIC_INTEGRATION.
   *
   * - AUTOMATIC_INTEGRATION: a table if it is faster and its error is within a quarter of
   *   MaximumError, else the closed form.
   * - CLOSED_FORM_INTEGRATION: the closed form (Weiler et al. 2003, section 3.3).
   * - TABLE_INTEGRATION: the smallest table whose error is within a quarter of MaximumError. If
   *   none is, the best one within TableMaximumBytes; GetErrorEstimate() returns its error.
   *
   * Scalars at cells, constant colours, other blend modes and light that varies in cells use no
   * table: what is lit by gradients of points, or by positional lights, is integrated in closed
   * form.
   */
  virtual void SetIntegration(int integration);
  vtkGetMacro(Integration, int);
  const char* GetIntegrationAsString();
  void SetIntegrationToAutomatic() { this->SetIntegration(AUTOMATIC_INTEGRATION); }
  void SetIntegrationToClosedForm() { this->SetIntegration(CLOSED_FORM_INTEGRATION); }
  void SetIntegrationToTable() { this->SetIntegration(TABLE_INTEGRATION); }
  ///@}

  ///@{
  /**
   * Set the number of texels of a table along each of its two scalars and along the length of a
   * segment, 2 to 4096. Default 0: the smallest that MaximumError allows.
   */
  virtual void SetTableScalarSize(int size);
  vtkGetMacro(TableScalarSize, int);
  virtual void SetTableLengthSize(int size);
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
   * Set the spacing of a table's texels along the length of a segment: equal steps (Weiler et al.
   * 2003, section 4) or steps that double (Kraus et al. 2004, equation 1). Default AUTOMATIC_SCALE:
   * what MaximumError allows at the smallest size.
   */
  virtual void SetTableLengthScale(int scale);
  vtkGetMacro(TableLengthScale, int);
  const char* GetTableLengthScaleAsString();
  void SetTableLengthScaleToAutomatic() { this->SetTableLengthScale(AUTOMATIC_SCALE); }
  void SetTableLengthScaleToLinear() { this->SetTableLengthScale(LINEAR_SCALE); }
  void SetTableLengthScaleToLogarithmic() { this->SetTableLengthScale(LOGARITHMIC_SCALE); }
  ///@}

  enum TableScalarAxisType
  {
    AUTOMATIC_AXIS,
    UNIFORM_AXIS,
    NODES_AXIS
  };

  ///@{
  /**
   * Set the spacing of a table's texels along the scalars: equal steps, or on the nodes of the
   * transfer function. Default AUTOMATIC_AXIS: what MaximumError allows at the smallest size.
   */
  virtual void SetTableScalarAxis(int axis);
  vtkGetMacro(TableScalarAxis, int);
  const char* GetTableScalarAxisAsString();
  void SetTableScalarAxisToAutomatic() { this->SetTableScalarAxis(AUTOMATIC_AXIS); }
  void SetTableScalarAxisToUniform() { this->SetTableScalarAxis(UNIFORM_AXIS); }
  void SetTableScalarAxisToNodes() { this->SetTableScalarAxis(NODES_AXIS); }
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
   * Set the texture format that a table's texels are rounded to. Default AUTOMATIC_FORMAT: what
   * MaximumError allows at the smallest size. On the processor texels are rounded to the format, so
   * that its error can be studied, and rays read them in single precision.
   */
  virtual void SetTableFormat(int format);
  vtkGetMacro(TableFormat, int);
  const char* GetTableFormatAsString();
  void SetTableFormatToAutomatic() { this->SetTableFormat(AUTOMATIC_FORMAT); }
  void SetTableFormatToUNorm8() { this->SetTableFormat(UNORM8_FORMAT); }
  void SetTableFormatToUNorm16() { this->SetTableFormat(UNORM16_FORMAT); }
  void SetTableFormatToHalf() { this->SetTableFormat(HALF_FORMAT); }
  void SetTableFormatToFloat() { this->SetTableFormat(FLOAT_FORMAT); }
  ///@}

  ///@{
  /**
   * Set the largest size of a table in bytes, 65536 to 2^40. Default 67108864 (64 MiB).
   */
  virtual void SetTableMaximumBytes(vtkIdType bytes);
  vtkGetMacro(TableMaximumBytes, vtkIdType);
  ///@}

  ///@{
  /**
   * Set whether lighting, if the property's Shade is on, takes its normals from gradients that are
   * interpolated between points. The gradient of a point is the mean over its cells by volume. Off:
   * each cell has its own gradient, and facets show. Default on.
   */
  vtkSetMacro(SmoothShading, vtkTypeBool);
  vtkGetMacro(SmoothShading, vtkTypeBool);
  vtkBooleanMacro(SmoothShading, vtkTypeBool);
  ///@}

  enum MergePointsType
  {
    MERGE_OFF = 0,
    MERGE_ON = 1,
    AUTOMATIC_MERGE = 2
  };

  ///@{
  /**
   * Set whether points at the same place are taken as one, so that cells which touch without
   * sharing points become neighbours: pieces and blocks of a file, cells with points of their own,
   * seams of O-grids. Points are at the same place if their coordinates differ by no more than a
   * few roundings of the largest one, in the precision of the input's arrays. They are merged only
   * if their scalars agree to a few roundings of their array, so that jumps of a field stay.
   * Default AUTOMATIC_MERGE.
   *
   * - MERGE_OFF (0): points stay apart. Rays enter touching cells again, and the picture is the
   *   same if faces that touch are cut alike: those of hexahedra, wedges and pyramids by their
   *   smallest point id, which is another one on either side.
   * - MERGE_ON (1): all points are merged whose scalars agree. Cells that become the same by that
   *   count once.
   * - AUTOMATIC_MERGE (2): all points are merged or none: none if scalars at one place differ, or
   *   if cells become the same or three of them share a face, as where cells overlap.
   *
   * Points inside the mesh are not looked for, nor are further ones that come together after some
   * were merged, until cells change. It costs nothing to speak of where cells share their points;
   * else a frame that needs a new mesh makes it twice, or once if most points are not shared.
   */
  virtual void SetMergePoints(int merge);
  vtkGetMacro(MergePoints, int);
  const char* GetMergePointsAsString();
  void SetMergePointsToOff() { this->SetMergePoints(MERGE_OFF); }
  void SetMergePointsToOn() { this->SetMergePoints(MERGE_ON); }
  void SetMergePointsToAutomatic() { this->SetMergePoints(AUTOMATIC_MERGE); }
  ///@}

  enum VectorModeType
  {
    DISABLED_MODE = -1,
    MAGNITUDE_MODE = 0,
    COMPONENT_MODE = 1
  };

  ///@{
  /**
   * Set how an array of several components becomes the scalar, with the numbers of
   * vtkSmartVolumeMapper. Default DISABLED_MODE.
   *
   * - DISABLED_MODE (-1): what the property says. If its IndependentComponents is off, there must
   *   be two components, colour by the first and opacity by the last; or four, red, green, blue and
   *   opacity by the last. All functions are those of component 0. Else the VectorMode,
   *   VectorComponent and VectorSize of the property's colour function count, or those of the
   *   array's lookup table, if they are not the defaults of VTK. Else, if any component behind the
   *   first was given functions and there are at most four, each is drawn by functions of its own,
   *   and they are mixed as clouds of particles: attenuations add up. Else the first component.
   * - MAGNITUDE_MODE (0): the Euclidean norm.
   * - COMPONENT_MODE (1): component VectorComponent.
   *
   * @warning Several components at once are drawn by vtkTetrahedraRayCastMapper, with composite
   * blending, in double precision and without Shade. Elsewhere, dependent ones are an error, and
   * of independent ones the first is drawn, with one warning. ComponentWeight is not used, as in
   * VTK's mappers of unstructured grids.
   */
  virtual void SetVectorMode(int mode);
  vtkGetMacro(VectorMode, int);
  const char* GetVectorModeAsString();
  void SetVectorModeToDisabled() { this->SetVectorMode(DISABLED_MODE); }
  void SetVectorModeToMagnitude() { this->SetVectorMode(MAGNITUDE_MODE); }
  void SetVectorModeToComponent() { this->SetVectorMode(COMPONENT_MODE); }
  ///@}

  ///@{
  /**
   * Set the component that COMPONENT_MODE takes, counted from 0. Default 0.
   *
   * @warning A frame fails with an error if the array has no such component.
   */
  virtual void SetVectorComponent(int component);
  vtkGetMacro(VectorComponent, int);
  ///@}

  enum ReentryType
  {
    AUTOMATIC_REENTRY,
    BOUNDARY_HIERARCHY_REENTRY,
    IMAGINARY_CELLS_REENTRY,
    BOUNDARY_LAYERS_REENTRY,
    NO_REENTRY
  };

  ///@{
  /**
   * Set how rays that left the mesh find where they enter it again. Default AUTOMATIC_REENTRY. All
   * values decide by the same exact signs as the walk from cell to cell, and give the same picture.
   *
   * - AUTOMATIC_REENTRY: BOUNDARY_HIERARCHY_REENTRY. vtkTetrahedraGPURayCastMapper uses NO_REENTRY
   *   if the mesh is convex and no cell is left out.
   * - BOUNDARY_HIERARCHY_REENTRY: a hierarchy over the boundary faces.
   * - IMAGINARY_CELLS_REENTRY: imaginary cells between the mesh and its convex hull (Weiler et al.
   *   2003, section 3.4, see vtkConvexifyTetrahedra). The first frame that needs them makes them.
   *   Transparent cells are not left out. If the mesh can't be made convex, rays enter by its
   *   boundary, and one warning says why.
   * - BOUNDARY_LAYERS_REENTRY, vtkTetrahedraGPURayCastMapper only: boundary faces, depth-peeled.
   *   The hierarchy is used if the mesh reaches through the plane of the eye.
   * - NO_REENTRY, vtkTetrahedraGPURayCastMapper only: rays end where they leave the mesh.
   *
   * A value that the mapper does not have is refused with an error; vtkTetrahedraProjectionMapper
   * casts no rays and refuses all of them.
   *
   * @warning NO_REENTRY is exact for convex meshes only.
   */
  virtual void SetReentry(int reentry);
  vtkGetMacro(Reentry, int);
  const char* GetReentryAsString();
  void SetReentryToAutomatic() { this->SetReentry(AUTOMATIC_REENTRY); }
  void SetReentryToBoundaryHierarchy() { this->SetReentry(BOUNDARY_HIERARCHY_REENTRY); }
  void SetReentryToImaginaryCells() { this->SetReentry(IMAGINARY_CELLS_REENTRY); }
  void SetReentryToBoundaryLayers() { this->SetReentry(BOUNDARY_LAYERS_REENTRY); }
  void SetReentryToNone() { this->SetReentry(NO_REENTRY); }
  ///@}

  ///@{
  /**
   * Set whether rays end at opaque geometry that was drawn before, by the depth buffer. Off: the
   * volume is in front of all geometry. Default on.
   */
  vtkSetMacro(IntermixIntersectingGeometry, vtkTypeBool);
  vtkGetMacro(IntermixIntersectingGeometry, vtkTypeBool);
  vtkBooleanMacro(IntermixIntersectingGeometry, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Set whether only the regions of CroppingRegionFlags are rendered. Default off.
   */
  vtkSetMacro(Cropping, vtkTypeBool);
  vtkGetMacro(Cropping, vtkTypeBool);
  vtkBooleanMacro(Cropping, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Set the six planes that cut space into 27 regions: xmin, xmax, ymin, ymax, zmin, zmax, in
   * coordinates of the data. Default 0, 1, 0, 1, 0, 1. NaN is refused with an error.
   */
  virtual void SetCroppingRegionPlanes(
    double xMin, double xMax, double yMin, double yMax, double zMin, double zMax);
  virtual void SetCroppingRegionPlanes(const double planes[6]);
  vtkGetVector6Macro(CroppingRegionPlanes, double);
  ///@}

  ///@{
  /**
   * Set the regions that are rendered, 0 to 0x7ffffff: bit x + 3 y + 9 z is region x, y, z, each 0
   * below, 1 between and 2 above its two planes. Default 0x2000: between all planes. The numbers
   * are those of vtkVolumeMapper.
   */
  virtual void SetCroppingRegionFlags(int flags);
  vtkGetMacro(CroppingRegionFlags, int);
  void SetCroppingRegionFlagsToSubVolume() { this->SetCroppingRegionFlags(0x0002000); }
  void SetCroppingRegionFlagsToFence() { this->SetCroppingRegionFlags(0x2ebfeba); }
  void SetCroppingRegionFlagsToInvertedFence() { this->SetCroppingRegionFlags(0x5140145); }
  void SetCroppingRegionFlagsToCross() { this->SetCroppingRegionFlags(0x0417410); }
  void SetCroppingRegionFlagsToInvertedCross() { this->SetCroppingRegionFlags(0x7be8bef); }
  ///@}

  ///@{
  /**
   * Set the distance of rays in pixels, 0.1 to 100, for frames with AutoAdjustSampleDistances off.
   * Default 1: one ray through each pixel's centre. At 2 one ray covers 2 x 2 pixels, and the
   * picture is interpolated; at 0.5 a pixel is the mean of 4 rays. vtkTetrahedraProjectionMapper
   * casts no rays: it draws a picture of that many pixels.
   *
   * If it is above 1, GetErrorEstimate() includes the largest difference between colours of
   * neighbouring rays. No warning tells of it.
   */
  virtual void SetImageSampleDistance(float distance);
  vtkGetMacro(ImageSampleDistance, float);
  ///@}

  ///@{
  /**
   * Set the range of the automatic distance of rays in pixels, each 0.1 to 100. Default 1 and 10.
   */
  virtual void SetMinimumImageSampleDistance(float distance);
  vtkGetMacro(MinimumImageSampleDistance, float);
  virtual void SetMaximumImageSampleDistance(float distance);
  vtkGetMacro(MaximumImageSampleDistance, float);
  ///@}

  ///@{
  /**
   * Set whether the distance of rays follows from the time that the renderer allocates to the
   * volume and the time that a ray took in the last frame. Default on. During an interaction, it
   * changes only if the time asks for it. Without a desired update rate, as in still and off-screen
   * frames, that time is hours, and the distance is MinimumImageSampleDistance.
   */
  vtkSetMacro(AutoAdjustSampleDistances, vtkTypeBool);
  vtkGetMacro(AutoAdjustSampleDistances, vtkTypeBool);
  vtkBooleanMacro(AutoAdjustSampleDistances, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Return whether the mapper works in a window: whether that draws by OpenGL 3.2 or later, on a
   * graphics card or in software. Makes the window's context if there is none. GetSupportReason()
   * then says why not, or what draws in the window.
   */
  virtual bool IsSupported(vtkRenderWindow* window);
  std::string GetSupportReason();
  ///@}

  ///@{
  /**
   * Calls of VTK's ray casters of unstructured grids for which there is nothing to choose here:
   * rays go from cell to cell, segments are integrated as Integration says, and there are no lists
   * of pixels. A function or an integrator gives one warning, and is not kept.
   */
  void SetRayCastFunction(vtkUnstructuredGridVolumeRayCastFunction* function);
  vtkUnstructuredGridVolumeRayCastFunction* GetRayCastFunction() { return nullptr; }
  void SetRayIntegrator(vtkUnstructuredGridVolumeRayIntegrator* integrator);
  vtkUnstructuredGridVolumeRayIntegrator* GetRayIntegrator() { return nullptr; }
  void SetMaxPixelListSize(int) {}
  int GetMaxPixelListSize() { return 0; }
  ///@}

  ///@{
  /**
   * Calls of vtkProjectedTetrahedraMapper that change nothing where rays are cast: these need no
   * order of cells, and gather in single precision. vtkTetrahedraProjectionMapper has both.
   */
  virtual void SetVisibilitySort(vtkVisibilitySort*) {}
  virtual vtkVisibilitySort* GetVisibilitySort() { return nullptr; }
  virtual void SetUseFloatingPointFrameBuffer(bool) {}
  virtual bool GetUseFloatingPointFrameBuffer() { return true; }
  vtkBooleanMacro(UseFloatingPointFrameBuffer, bool);
  ///@}

  /**
   * The picture of the last frame as it was cast, before anything was done to it: one point for
   * each ray, bottom row first, over the viewport, or the part of it in the window. Point arrays
   * RGBA, the scalars: four floats, premultiplied, without any background; Depth: a float, distance
   * along the ray in world units, from the camera or in a parallel projection from the plane
   * through it, to the first contribution, -1 where there is none. Belongs to the mapper, which
   * overwrites it in the next frame. Empty before the first frame, during one, after one that
   * failed or was aborted, and once its window was closed or the volume was removed from the
   * renderer.
   */
  vtkImageData* GetOutputImage();

  /**
   * What the last frame was made of, as JSON: what was rebuilt, times in seconds, counts, memory,
   * the error estimate, what the scene did not need. "{}" before the first frame. Memory is in
   * bytes: "memory" has what each part of the mapper holds, parts on the graphics card as
   * "card_..."; "memory_peaks" what each has held at most; "process_peaks" the largest memory of
   * the process before the frame, by the end of each stage of its preparation, and by its end.
   * "kept" tells whether the picture of the frame before was composited as it is, since nothing
   * that it follows from had changed; counts are then those of the frame that made it.
   */
  std::string GetStatistics();

  /**
   * Estimated largest error of a channel in the last frame, absolute, 0..1. The sum of what
   * GetStatistics() has below "error": ending rays early, the integrals, adding segments up in
   * single precision or in the colour buffer, tables, rounding coordinates and scalars
   * ("geometry"), PerspectiveInterpolation off, a wrong order of cells, and colour functions that
   * are approximated.
   *
   * Tables and "geometry" are measured on some thousand rays through the mesh. Where "geometry" is
   * not 0, pixels that graze are not covered: those in which the exact picture itself changes by
   * more than the estimate where the ray moves across by 2^-22 of the mesh's radius. Their rays
   * touch the boundary, a face between cells of different constant scalars, or a surface along
   * which the transfer function jumps. They are some forty of a million. Rays that pass an edge of
   * the boundary within rounding are displaced by up to 2^-18 of the radius, most by 2^-20, so that
   * they go through one of the faces beside it where these do not share their points.
   *
   * Not covered either: interpolation between rays more than a pixel apart, isosurfaces, which
   * rays meet or miss, and nodes of the transfer function that are nearer to each other than 1e-6
   * of its range: they are rounded to 6e-8 of it.
   */
  double GetErrorEstimate();

  /**
   * Return whether GetErrorEstimate() is at most MaximumError; true if MaximumError is below 1e-6,
   * which single precision does not reach.
   */
  bool IsMaximumErrorKept();

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
   *
   * Observers may change input, properties and props: what is read is held until the frame ends.
   * VTK itself does not stand it if they take the renderer out of its window, destroy other props,
   * or leave the volume without a mapper. A frame that they ask of the same mapper is not drawn.
   */
  void Render(vtkRenderer* renderer, vtkVolume* volume) override;

  /**
   * WARNING: INTERNAL METHOD - NOT INTENDED FOR GENERAL USE
   *
   * Releases what is in the context of a window, and the picture; during a frame, when it has
   * ended.
   */
  void ReleaseGraphicsResources(vtkWindow* window) override;

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

  /**
   * Release what a subclass has in the context of a window.
   */
  virtual void ReleaseResources(vtkWindow* window) = 0;

  /**
   * Add to the settings of a frame what a subclass has beside the properties of this class.
   */
  virtual void AddSettings(tetralux::MapperSettings& settings);

  /**
   * Print properties, then what the last frame found: subclasses add theirs behind those of their
   * superclass. PrintSelf calls the first, then the second.
   */
  virtual void PrintProperties(ostream& os, vtkIndent indent);
  virtual void PrintResults(ostream& os, vtkIndent indent);

  /**
   * Warn once that a call of VTK's mappers is not used, and why.
   */
  void WarnOfCall(const std::string& property, const std::string& reason);

  /**
   * What GetSupportReason() returns.
   */
  void SetSupportReason(const std::string& reason);

  /**
   * Warn once if the mesh was to be made convex for IMAGINARY_CELLS_REENTRY and can't be.
   */
  void WarnOfReentry(const tetralux::WalkMesh& mesh);

  /**
   * ImageSampleDistance, its limits, and whether it is chosen.
   */
  tetralux::RayDistances GetRayDistances() const;

  double MaximumError = 1e-4;
  int Integration = AUTOMATIC_INTEGRATION;
  int TableScalarSize = 0;
  int TableLengthSize = 0;
  int TableLengthScale = AUTOMATIC_SCALE;
  int TableScalarAxis = AUTOMATIC_AXIS;
  int TableFormat = AUTOMATIC_FORMAT;
  vtkIdType TableMaximumBytes = 64 << 20;
  vtkTypeBool SmoothShading = 1;
  int MergePoints = AUTOMATIC_MERGE;
  int VectorMode = DISABLED_MODE;
  int VectorComponent = 0;
  int Reentry = AUTOMATIC_REENTRY;
  vtkTypeBool IntermixIntersectingGeometry = 1;
  vtkTypeBool Cropping = 0;
  double CroppingRegionPlanes[6] = { 0, 1, 0, 1, 0, 1 };
  int CroppingRegionFlags = 0x2000;
  float ImageSampleDistance = 1;
  float MinimumImageSampleDistance = 1;
  float MaximumImageSampleDistance = 10;
  vtkTypeBool AutoAdjustSampleDistances = 1;

private:
  vtkTetrahedraVolumeMapper(const vtkTetrahedraVolumeMapper&) = delete;
  void operator=(const vtkTetrahedraVolumeMapper&) = delete;

  class Internals;
  std::unique_ptr<Internals> Private;
};

#endif
