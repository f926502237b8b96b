// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTriangleCasterMapper
 * @brief   renders image data in tiles, composited where the cache is
 *
 * The triangle caster of Knittel (1999), on the processor: the screen is cut into small triangles
 * or squares, and all slices of the volume behind one of them are composited, front to back, before
 * the next one begins. The picture does not depend on the number of threads.
 *
 * Takes vtkImageData with scalars at points, of any type, origin, spacing, extent and direction
 * matrix, with at least 2 points along each axis. Arrays of 8 or 16 bit integers or of floats are
 * read where they are. One component of several is copied; other types are copied to floats
 * relative to the middle of the array's range. The copy is kept until the array changes.
 *
 * What is computed: in each slab between two slices a ray has one sample, at the middle of its way
 * through what of the slab is in the volume and not clipped, cropped or hidden. There the scalar is
 * interpolated trilinearly, whatever the property's InterpolationType is, and colour and scalar
 * opacity follow from it. Samples that meet a scalar that is not a finite number are empty. The
 * opacity of a sample is by OpacityModel that of its own length, so a constant volume is exact. The
 * picture approaches the integral along the ray as SampleDistance becomes smaller.
 *
 * If the property's Shade is on, lights of the renderer shine on the samples, or on isosurfaces, by
 * gradients as normals, from the side of the viewer: ambient, diffuse and specular (Blinn).
 * Gradient opacity is a factor of the scalar opacity. A TransferFunction2D of the property takes
 * the place of all its functions if its TransferFunctionMode is TF_2D; its opacities are those of
 * the unit distance.
 *
 * Any vtkCamera, vtkVolume transform, viewport and tiled display; the camera may be inside. Opaque
 * geometry may be in front of, inside and behind the volume. Clipping planes of vtkAbstractMapper
 * are in world coordinates and keep their positive side. CroppingRegionPlanes are in coordinates of
 * the data; they are refused if the direction matrix turns the axes of the image.
 *
 * Setters clamp numbers to the range that is stated, and refuse, with an error that names the right
 * values, any other value of an enumeration and NaN. Each cause of an error is reported once; the
 * volume is then not drawn.
 *
 * Of up to 4 components, independent ones have functions, weights and shading of their own, and
 * what they show is added up. Of 2 dependent ones, the first one has the colour and the second one
 * the opacity; of 4, the first three are red, green and blue. Functions and unit distance of
 * dependent ones are those of component 0. Blanked points and hidden cells are empty, and so is
 * what a binary mask hides.
 *
 * @warning There are errors for: rectilinear grids, scalars at cells, more than 2^31 - 1 values, 3
 * dependent components; and with several components or labels for any BlendMode but
 * COMPOSITE_BLEND, TF_2D, PreIntegration, BYTE_GRADIENTS and maps of light. TF_2D is of
 * COMPOSITE_BLEND only. Warnings say what of the property is not used.
 *
 * In a window with MultiSamples, pixels at edges are cast once for each sample, as
 * vtkTetrahedraVolumeMapper says.
 *
 * @sa vtkFixedPointVolumeRayCastMapper, vtkTetrahedraRayCastMapper
 */
#ifndef vtkTriangleCasterMapper_h
#define vtkTriangleCasterMapper_h

#include "TetraluxRenderingModule.h" // For export macro
#include "vtkSmartPointer.h"         // For vtkSmartPointer
#include "vtkVolumeMapper.h"

#include <memory> // For std::unique_ptr
#include <string> // For std::string

class vtkImageData;

class TETRALUXRENDERING_EXPORT vtkTriangleCasterMapper : public vtkVolumeMapper
{
public:
  static vtkTriangleCasterMapper* New();
  vtkTypeMacro(vtkTriangleCasterMapper, vtkVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Copy the input, the choice of the array, clipping planes, and of a mapper of this project all
   * properties that both have, with MaskInput. Values that this mapper does not honour stay as they
   * are. The data are shared.
   */
  void ShallowCopy(vtkAbstractMapper* mapper) override;

  ///@{
  /**
   * Set what rays gather, as vtkGPUVolumeRayCastMapper shows it. Default COMPOSITE_BLEND.
   *
   * - COMPOSITE_BLEND (0): what emits and absorbs.
   * - MAXIMUM_INTENSITY_BLEND (1), MINIMUM_INTENSITY_BLEND (2): colour and scalar opacity of the
   *   largest or smallest scalar.
   * - AVERAGE_INTENSITY_BLEND (3): mean of scalar opacity times grey of what has its scalar in
   *   AverageIPScalarRange. Grey is 0 at the least scalar of the volume and 1 at the largest one.
   * - ADDITIVE_BLEND (4): sum of scalar opacity times grey times length over
   *   ScalarOpacityUnitDistance, at most 1.
   * - ISOSURFACE_BLEND (5): the surfaces of the property's IsoSurfaceValues.
   * - SLICE_BLEND (6): colour and scalar opacity on the plane of the property's SliceFunction, in
   *   world coordinates. A frame fails with an error if that is no vtkPlane.
   *
   * @warning Light is of COMPOSITE_BLEND and ISOSURFACE_BLEND only, gradient opacity and
   * PreIntegration are of COMPOSITE_BLEND only. A warning says that others do not use Shade and
   * gradient opacity.
   */
  void SetBlendMode(int mode) override;
  const char* GetBlendModeAsString();
  ///@}

  ///@{
  /**
   * As in the superclass: the scalars that AVERAGE_INTENSITY_BLEND averages, both ends included.
   * Default -1e38 and 1e38. NaN is refused with an error.
   */
  void SetAverageIPScalarRange(double least, double largest) override;
  void SetAverageIPScalarRange(const double range[2]);
  ///@}

  ///@{
  /**
   * Set the largest absolute error per premultiplied channel, 0 to 1, of what approximates the
   * slices: rays end early, arithmetic is in single precision, and colour functions that are not
   * piecewise linear are subdivided. Default 1e-4. If the GetErrorEstimate() of a frame is above
   * it, one warning for each cause has both numbers.
   *
   * With SampleDistanceByError on, slices are as far apart as it allows, too.
   *
   * @warning Below 1e-6 the single precision of the picture limits the error, and no warning is
   * given.
   */
  virtual void SetMaximumError(double error);
  vtkGetMacro(MaximumError, double);
  ///@}

  ///@{
  /**
   * Set the distance of slices in world units, 0 or more. Default 0: half of the mean distance of
   * points, less for volumes of fewer than 100^3 points, as VTK's mappers of image data choose it
   * with LockSampleDistanceToInputSpacing on. GetStatistics() has the distance that was used.
   */
  virtual void SetSampleDistance(double distance);
  vtkGetMacro(SampleDistance, double);
  ///@}

  ///@{
  /**
   * Set the extent of the whole image of which the input is a part, for parts that are rendered
   * each on its own and then composited: they have the slices of the whole. Default empty (0, -1,
   * 0, -1, 0, -1): the input is the whole.
   */
  vtkSetVector6Macro(WholeExtent, int);
  vtkGetVector6Macro(WholeExtent, int);
  ///@}

  ///@{
  /**
   * Set whether the distance of slices follows from MaximumError: out of those from 4 times
   * SampleDistance on, each half of the one before, down to a 16th of SampleDistance, the first at
   * which about 1,000 rays differ by no more than 3/8 of MaximumError from the next one. It is kept
   * until anything changes that it depends on. Frames of an interaction have their own distance.
   * What slices are off by is then measured in each frame, and a warning is given where it is too
   * much. Default off.
   */
  vtkSetMacro(SampleDistanceByError, vtkTypeBool);
  vtkGetMacro(SampleDistanceByError, vtkTypeBool);
  vtkBooleanMacro(SampleDistanceByError, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Set the same for frames of an interaction, those that the renderer allocates less than a second
   * to, if AutoAdjustSampleDistances is on. Default 0: twice the distance of other frames.
   */
  virtual void SetInteractiveSampleDistance(double distance);
  vtkGetMacro(InteractiveSampleDistance, double);
  ///@}

  enum SliceShapeType
  {
    PLANE_SLICES,
    SHELL_SLICES
  };

  ///@{
  /**
   * Set what the volume is cut by. Default PLANE_SLICES.
   *
   * - PLANE_SLICES (0): planes parallel to that of the picture.
   * - SHELL_SLICES (1): spheres around the eye, so that all rays of a perspective have the same
   *   step (Knittel 1999, section 1.1). Planes in a parallel projection.
   */
  virtual void SetSliceShape(int shape);
  vtkGetMacro(SliceShape, int);
  const char* GetSliceShapeAsString();
  void SetSliceShapeToPlanes() { this->SetSliceShape(PLANE_SLICES); }
  void SetSliceShapeToShells() { this->SetSliceShape(SHELL_SLICES); }
  ///@}

  enum OpacityModelType
  {
    POWER_OPACITY,
    ATTENUATION_OPACITY
  };

  ///@{
  /**
   * Set the opacity of a length l of scalar opacity a and ScalarOpacityUnitDistance d. Default
   * POWER_OPACITY.
   *
   * - POWER_OPACITY (0): 1 - (1 - a)^(l / d), as VTK's mappers of image data have it.
   * - ATTENUATION_OPACITY (1): 1 - exp(-a l / d), as mappers of unstructured grids have it.
   */
  virtual void SetOpacityModel(int model);
  vtkGetMacro(OpacityModel, int);
  const char* GetOpacityModelAsString();
  void SetOpacityModelToPower() { this->SetOpacityModel(POWER_OPACITY); }
  void SetOpacityModelToAttenuation() { this->SetOpacityModel(ATTENUATION_OPACITY); }
  ///@}

  enum GradientNormType
  {
    EUCLIDEAN_NORM,
    SUM_NORM
  };

  ///@{
  /**
   * Set what length of a gradient the property's gradient opacity is a function of: over the mean
   * distance of points, as in VTK's mappers. Default EUCLIDEAN_NORM.
   *
   * - EUCLIDEAN_NORM (0): the Euclidean norm.
   * - SUM_NORM (1): the sum of the components' absolute values (Knittel 1999, section 7).
   */
  virtual void SetGradientNorm(int norm);
  vtkGetMacro(GradientNorm, int);
  const char* GetGradientNormAsString();
  void SetGradientNormToEuclidean() { this->SetGradientNorm(EUCLIDEAN_NORM); }
  void SetGradientNormToSum() { this->SetGradientNorm(SUM_NORM); }
  ///@}

  enum GradientSourceType
  {
    ON_THE_FLY_GRADIENTS,
    BYTE_GRADIENTS
  };

  ///@{
  /**
   * Set where gradients of light and gradient opacity come from (Knittel 1999, section 7). Default
   * ON_THE_FLY_GRADIENTS.
   *
   * - ON_THE_FLY_GRADIENTS (0): differences of values, for each sample.
   * - BYTE_GRADIENTS (1): central differences at the points, stored in 8 bits a component, and 4
   *   bytes a point. What that rounds is in no error estimate.
   */
  virtual void SetGradientSource(int source);
  vtkGetMacro(GradientSource, int);
  const char* GetGradientSourceAsString();
  void SetGradientSourceToOnTheFly() { this->SetGradientSource(ON_THE_FLY_GRADIENTS); }
  void SetGradientSourceToBytes() { this->SetGradientSource(BYTE_GRADIENTS); }
  ///@}

  enum LightSumType
  {
    DIRECT_SUM,
    NEAREST_ENTRY_SUM,
    INTERPOLATED_SUM
  };

  ///@{
  /**
   * Set how the lights of Shade are summed up (Knittel 1999, section 7). Default DIRECT_SUM.
   *
   * - DIRECT_SUM (0): for each sample.
   * - NEAREST_ENTRY_SUM (1): once for each direction of a map of 5 bits, from the viewing direction
   *   of the picture's centre. What that rounds is in no error estimate.
   * - INTERPOLATED_SUM (2): between four directions of that map.
   *
   * @warning A frame fails with an error if a map is to be made with a positional light.
   */
  virtual void SetLightSum(int sum);
  vtkGetMacro(LightSum, int);
  const char* GetLightSumAsString();
  void SetLightSumToDirect() { this->SetLightSum(DIRECT_SUM); }
  void SetLightSumToNearestEntry() { this->SetLightSum(NEAREST_ENTRY_SUM); }
  void SetLightSumToInterpolated() { this->SetLightSum(INTERPOLATED_SUM); }
  ///@}

  ///@{
  /**
   * Set factors of the colours, red, green and blue, at the front and at the back of the volume, or
   * at the camera where that is inside: depth cueing (Knittel 1999, section 2.2). They are linear
   * in the depth of the slices, and for COMPOSITE_BLEND. Default 1, 1, 1, each. Numbers that are
   * not finite are refused with an error.
   *
   * @warning A frame fails with an error if another color is set with PreIntegration.
   */
  void SetNearColor(double red, double green, double blue);
  void SetNearColor(const double color[3]);
  vtkGetVector3Macro(NearColor, double);
  void SetFarColor(double red, double green, double blue);
  void SetFarColor(const double color[3]);
  vtkGetVector3Macro(FarColor, double);
  ///@}

  ///@{
  /**
   * Set whether what is between two slices is looked up in a table over the scalars at both, so
   * that thin features of the transfer function are not missed (Knittel 1999, section 7). Default
   * off.
   *
   * @warning A frame of COMPOSITE_BLEND fails with an error if it is on with Shade, gradient
   * opacity or TF_2D.
   */
  vtkSetMacro(PreIntegration, vtkTypeBool);
  vtkGetMacro(PreIntegration, vtkTypeBool);
  vtkBooleanMacro(PreIntegration, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Set whether the opacity of a sample is that of its own ray's step. Off: that of a step along
   * the normal of the slices, so oblique rays are too transparent (Knittel 1999, section 1.1).
   * Default on.
   */
  vtkSetMacro(CorrectOpacity, vtkTypeBool);
  vtkGetMacro(CorrectOpacity, vtkTypeBool);
  vtkBooleanMacro(CorrectOpacity, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Set whether triangles of the screen end where all their pixels are opaque (TT), whether opaque
   * pixels of others are sampled no more (OP, Knittel 1999, section 3.2), and whether transparent
   * parts are left out (section 2.1). Opaque is what hides all behind it but a share that
   * MaximumError allows. Default on, each.
   */
  vtkSetMacro(EndTriangles, vtkTypeBool);
  vtkGetMacro(EndTriangles, vtkTypeBool);
  vtkBooleanMacro(EndTriangles, vtkTypeBool);
  vtkSetMacro(SkipPixels, vtkTypeBool);
  vtkGetMacro(SkipPixels, vtkTypeBool);
  vtkBooleanMacro(SkipPixels, vtkTypeBool);
  vtkSetMacro(SkipEmptySpace, vtkTypeBool);
  vtkGetMacro(SkipEmptySpace, vtkTypeBool);
  vtkBooleanMacro(SkipEmptySpace, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Set the edge of the squares that the screen is cut into, in pixels, 4 to 64. Default 8. And
   * whether each is cast in two triangles (Knittel 1999, section 2), default off. The picture does
   * not depend on them.
   */
  virtual void SetTileSize(int size);
  vtkGetMacro(TileSize, int);
  vtkSetMacro(CastTriangles, vtkTypeBool);
  vtkGetMacro(CastTriangles, vtkTypeBool);
  vtkBooleanMacro(CastTriangles, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Set the number of threads, 1 to 1024. Default 0: as many as OpenMP offers. The picture does not
   * depend on it.
   */
  virtual void SetNumberOfThreads(int threads);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /**
   * Set the distance of rays in pixels, 0.1 to 100, for frames with AutoAdjustSampleDistances off.
   * Default 1: one ray through each pixel's centre. At 2 one ray covers 2 x 2 pixels, and the
   * picture is interpolated; at 0.5 a pixel is the mean of 4 rays.
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
   * volume and the time that a ray took in the last frame. Default on. Without a desired update
   * rate, as in still and off-screen frames, that time is hours, and the distance is
   * MinimumImageSampleDistance.
   */
  vtkSetMacro(AutoAdjustSampleDistances, vtkTypeBool);
  vtkGetMacro(AutoAdjustSampleDistances, vtkTypeBool);
  vtkBooleanMacro(AutoAdjustSampleDistances, vtkTypeBool);
  ///@}

  enum VectorModeType
  {
    DISABLED_MODE = -1,
    MAGNITUDE_MODE = 0,
    COMPONENT_MODE = 1
  };

  ///@{
  /**
   * Set what of an array of several components is shown, with the numbers of
   * vtkSmartVolumeMapper. Default DISABLED_MODE.
   *
   * - DISABLED_MODE (-1): all of up to 4 components, as the property's IndependentComponents says,
   *   whatever VectorMode the colour function has, as in VTK's mappers of image data.
   *   Of more it is the first one, and a warning says so.
   * - MAGNITUDE_MODE (0): the Euclidean norm.
   * - COMPONENT_MODE (1): component VectorComponent.
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

  ///@{
  /**
   * Set a mask, as vtkGPUVolumeRayCastMapper has it: image data with a scalar for each point of the
   * input. Default nullptr: none. A sample has the scalar of the nearest point.
   *
   * @warning A frame fails with an error if it has another number of points, or labels that are not
   * from 0 to 255.
   */
  virtual void SetMaskInput(vtkImageData* mask);
  virtual vtkImageData* GetMaskInput();
  ///@}

  enum
  {
    BinaryMaskType = 0,
    LabelMapMaskType
  };

  ///@{
  /**
   * Set what the mask says. Default LabelMapMaskType.
   *
   * - BinaryMaskType (0): there is nothing where it is 0.
   * - LabelMapMaskType (1): labels, which have the property's LabelColor, LabelScalarOpacity and
   *   LabelGradientOpacity. Of an array of one component, and for COMPOSITE_BLEND. Unlike in VTK
   *   9.1, opacities of labels are those of a length, too.
   */
  virtual void SetMaskType(int type);
  vtkGetMacro(MaskType, int);
  const char* GetMaskTypeAsString();
  void SetMaskTypeToBinary() { this->SetMaskType(BinaryMaskType); }
  void SetMaskTypeToLabelMap() { this->SetMaskType(LabelMapMaskType); }
  ///@}

  ///@{
  /**
   * Set how much of a labelled sample's colour and opacity is that of its label, 0 to 1. Default 1.
   */
  virtual void SetMaskBlendFactor(float factor);
  vtkGetMacro(MaskBlendFactor, float);
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
   * As in the superclass; NaN is refused with an error.
   */
  void SetCroppingRegionPlanes(
    double xMin, double xMax, double yMin, double yMax, double zMin, double zMax) override;
  void SetCroppingRegionPlanes(const double planes[6]) override;
  ///@}

  /**
   * Why the input can't be rendered with the present choice of an array, in one line; empty if it
   * can. The input must be up to date.
   */
  std::string GetObstacle();

  /**
   * The picture of the last frame as it was cast, before anything was done to it: one point for
   * each ray, bottom row first, over the viewport, or the part of it in the window. Point arrays
   * RGBA, the scalars: four floats, premultiplied, without any background; Depth: a float, distance
   * along the ray in world units, from the camera or in a parallel projection from the plane
   * through it, to the near end of the first slab that contributes, -1 where there is none. Belongs
   * to the mapper, which overwrites it in the next frame. Empty before the first frame, during one,
   * after one that failed or was aborted, and once its window was closed or the volume was removed
   * from the renderer.
   */
  vtkImageData* GetOutputImage();

  /**
   * What the last frame was made of, as JSON: what was rebuilt, times in seconds, counts, the error
   * estimate, what the scene did not need. "{}" before the first frame. "kept" tells whether the
   * picture of the frame before was composited as it is, since nothing that it follows from had
   * changed; counts are then those of the frame that made it.
   */
  std::string GetStatistics();

  /**
   * Estimated largest error of a channel in the last frame, absolute, 0..1, against the integral
   * along each ray. The sum of what GetStatistics() has below "error": ending rays early, adding
   * samples up in single precision, colour functions that were subdivided; and of what is between
   * slices, by about 1,000 rays that are cast again with slices an eighth as far apart. The latter
   * is measured when it is asked for, once a frame, unless SampleDistanceByError is on. It is left
   * out if the input has changed since the frame.
   *
   * Not covered: rays between those; rounding places and scalars to single precision; interpolation
   * between rays more than a pixel apart.
   */
  double GetErrorEstimate();

  /**
   * Return whether GetErrorEstimate() is at most MaximumError; true if MaximumError is below 1e-6,
   * which single precision does not reach.
   */
  bool IsMaximumErrorKept();

  ///@{
  /**
   * Bounds of the input. There are none without an input, or if an observer of the update lets the
   * mapper go.
   */
  double* GetBounds() VTK_SIZEHINT(6) override;
  using Superclass::GetBounds;
  ///@}

  /**
   * WARNING: INTERNAL METHOD - NOT INTENDED FOR GENERAL USE
   *
   * Draws one frame. Invokes VolumeMapperRenderStartEvent, VolumeMapperRenderProgressEvent
   * with a double 0..1, and VolumeMapperRenderEndEvent. Each time the render window is asked
   * whether to abort: an aborted frame is not drawn. Draws nothing where a vtkHardwareSelector
   * looks for what is under the cursor: volumes have no ids.
   */
  void Render(vtkRenderer* renderer, vtkVolume* volume) override;

  /**
   * WARNING: INTERNAL METHOD - NOT INTENDED FOR GENERAL USE
   */
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkTriangleCasterMapper();
  ~vtkTriangleCasterMapper() override;

  double MaximumError = 1e-4;
  double SampleDistance = 0;
  int WholeExtent[6] = { 0, -1, 0, -1, 0, -1 };
  vtkTypeBool SampleDistanceByError = 0;
  double InteractiveSampleDistance = 0;
  int SliceShape = PLANE_SLICES;
  int OpacityModel = POWER_OPACITY;
  int GradientNorm = EUCLIDEAN_NORM;
  int GradientSource = ON_THE_FLY_GRADIENTS;
  int LightSum = DIRECT_SUM;
  double NearColor[3] = { 1, 1, 1 };
  double FarColor[3] = { 1, 1, 1 };
  vtkTypeBool PreIntegration = 0;
  vtkTypeBool CorrectOpacity = 1;
  vtkTypeBool EndTriangles = 1;
  vtkTypeBool SkipPixels = 1;
  vtkTypeBool SkipEmptySpace = 1;
  int TileSize = 8;
  vtkTypeBool CastTriangles = 0;
  int NumberOfThreads = 0;
  float ImageSampleDistance = 1;
  float MinimumImageSampleDistance = 1;
  float MaximumImageSampleDistance = 10;
  vtkTypeBool AutoAdjustSampleDistances = 1;
  int VectorMode = DISABLED_MODE;
  int VectorComponent = 0;
  vtkSmartPointer<vtkImageData> MaskInput;
  int MaskType = LabelMapMaskType;
  float MaskBlendFactor = 1;
  vtkTypeBool IntermixIntersectingGeometry = 1;

private:
  vtkTriangleCasterMapper(const vtkTriangleCasterMapper&) = delete;
  void operator=(const vtkTriangleCasterMapper&) = delete;

  class Internals;
  std::unique_ptr<Internals> Private;
};

#endif
