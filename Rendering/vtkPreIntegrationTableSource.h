// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPreIntegrationTableSource
 * @brief   what ray segments add to a picture, tabulated as an image
 *
 * A source without input. It makes, from a vtkVolumeProperty (component 0), a range of scalars and
 * a longest segment, the table by which segments of rays are integrated (Weiler et al.,
 * Hardware-Based Ray Casting for Tetrahedral Meshes, 2003, section 4; Kraus et al., Projecting
 * Tetrahedra without Rendering Artifacts, 2004, section 3), so that it can be saved, looked at and
 * compared in any pipeline.
 *
 * The output is a vtkImageData with the point scalars "RGBA": premultiplied colour and opacity of a
 * segment over its front scalar (x), its back scalar (y) and its length (z). A point is a texel's
 * centre; the first and the last ones are the ends of the axes. Blend modes other than composite
 * need fewer dimensions; their tables are in single precision with equal steps, whatever else is
 * set:
 *
 *   composite          3-D
 *   additive           2-D, emission (RGB) and optical depth (A) for each unit of length
 *   absorption         the same
 *   maximum intensity  1-D, premultiplied colour and opacity of the largest scalar
 *   isosurface         2-D, the flat surfaces that a segment crosses: the property's
 *                      IsoSurfaceValues with colour and opacity of their scalars
 *
 * Origin and Spacing are those of the scalars and lengths where texels have equal steps, else 0 and
 * 1; FieldData says in any case where they are (world units, units of the scalars):
 *
 *   ScalarTexels           scalar of each texel; equal ones are the two sides of a step
 *   LengthTexels           length of each texel (3-D)
 *   DeltaLength            Kraus' delta l, or a step of a linear scale (3-D)
 *   StepsPerDoubling       0 with a linear scale (3-D)
 *   ScalarAxisIntervals    Lo, Hi, Coordinate, Slope: the texel's coordinate of x = (s - Offset) /
 *                          Scale is Coordinate + Slope (x - Lo) in Lo..Hi (3-D)
 *   ScalarOffsetAndScale   Offset and Scale (3-D)
 *   ErrorBound             of a segment, by interpolation: largest, largest for each unit of
 *                          length; then by rounding: no segment exceeds them (3-D)
 *   ErrorEstimate          the same, measured (3-D)
 *   FunctionError          of a colour channel, by approximating functions that are not piecewise
 *                          linear
 *
 * Fails, with an error, without a property and on settings that it can't do.
 *
 * @sa vtkTetrahedraRayCastMapper, vtkUnstructuredGridPreIntegration
 */
#ifndef vtkPreIntegrationTableSource_h
#define vtkPreIntegrationTableSource_h

#include "TetraluxRenderingModule.h"
#include "vtkImageAlgorithm.h"
#include "vtkSmartPointer.h"           // for members
#include "vtkTetrahedraVolumeMapper.h" // for the values of enumerations

class vtkVolumeProperty;

class TETRALUXRENDERING_EXPORT vtkPreIntegrationTableSource : public vtkImageAlgorithm
{
public:
  static vtkPreIntegrationTableSource* New();
  vtkTypeMacro(vtkPreIntegrationTableSource, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Set the property that colour, scalar opacity and unit distance are of. Default nullptr.
   */
  void SetVolumeProperty(vtkVolumeProperty* property);
  vtkVolumeProperty* GetVolumeProperty();
  ///@}

  ///@{
  /**
   * Set the range of the segments' scalars. Default 1, 0: a first value above the second stands for
   * the range from the first node of the property's functions to the last.
   */
  vtkSetVector2Macro(ScalarRange, double);
  vtkGetVector2Macro(ScalarRange, double);
  ///@}

  ///@{
  /**
   * Set the length of the longest segment in world units, above 0: the longest edge of all cells.
   * Default 1.
   */
  vtkSetMacro(LongestSegment, double);
  vtkGetMacro(LongestSegment, double);
  ///@}

  ///@{
  /**
   * Set the integral that is tabulated: a BlendMode of vtkTetrahedraVolumeMapper. Default
   * COMPOSITE_BLEND. Any other number is refused with an error.
   */
  virtual void SetBlendMode(int mode);
  vtkGetMacro(BlendMode, int);
  const char* GetBlendModeAsString();
  void SetBlendModeToComposite() { this->SetBlendMode(vtkTetrahedraVolumeMapper::COMPOSITE_BLEND); }
  void SetBlendModeToMaximumIntensity()
  {
    this->SetBlendMode(vtkTetrahedraVolumeMapper::MAXIMUM_INTENSITY_BLEND);
  }
  void SetBlendModeToAdditive() { this->SetBlendMode(vtkTetrahedraVolumeMapper::ADDITIVE_BLEND); }
  void SetBlendModeToIsoSurface()
  {
    this->SetBlendMode(vtkTetrahedraVolumeMapper::ISOSURFACE_BLEND);
  }
  void SetBlendModeToAbsorption()
  {
    this->SetBlendMode(vtkTetrahedraVolumeMapper::ABSORPTION_BLEND);
  }
  ///@}

  ///@{
  /**
   * Set the number of texels along each scalar, 2 to 4096. Default 128.
   */
  vtkSetMacro(ScalarSize, int);
  vtkGetMacro(ScalarSize, int);
  ///@}

  ///@{
  /**
   * Set the number of texels along the length, 2 to 4096. Default 256.
   */
  vtkSetMacro(LengthSize, int);
  vtkGetMacro(LengthSize, int);
  ///@}

  ///@{
  /**
   * Set the spacing of texels along the length: LINEAR_SCALE, equal steps, or LOGARITHMIC_SCALE,
   * with StepsPerDoubling steps up to delta l and for every doubling (Kraus et al. 2004, equation
   * 1). Values are those of vtkTetrahedraVolumeMapper::TableLengthScaleType; AUTOMATIC_SCALE is
   * refused with an error. Default LINEAR_SCALE.
   */
  virtual void SetLengthScale(int scale);
  vtkGetMacro(LengthScale, int);
  const char* GetLengthScaleAsString();
  void SetLengthScaleToLinear() { this->SetLengthScale(vtkTetrahedraVolumeMapper::LINEAR_SCALE); }
  void SetLengthScaleToLogarithmic()
  {
    this->SetLengthScale(vtkTetrahedraVolumeMapper::LOGARITHMIC_SCALE);
  }
  ///@}

  ///@{
  /**
   * Set the number of steps per doubling of LOGARITHMIC_SCALE, a power of 2 below LengthSize.
   * Default 1.
   */
  vtkSetMacro(StepsPerDoubling, int);
  vtkGetMacro(StepsPerDoubling, int);
  ///@}

  ///@{
  /**
   * Set the spacing of texels along the scalars: UNIFORM_AXIS, equal steps, or NODES_AXIS, on the
   * nodes of the functions and denser next to them. Values are those of
   * vtkTetrahedraVolumeMapper::TableScalarAxisType; AUTOMATIC_AXIS is refused with an error.
   * Default UNIFORM_AXIS.
   */
  virtual void SetScalarAxis(int axis);
  vtkGetMacro(ScalarAxis, int);
  const char* GetScalarAxisAsString();
  void SetScalarAxisToUniform() { this->SetScalarAxis(vtkTetrahedraVolumeMapper::UNIFORM_AXIS); }
  void SetScalarAxisToNodes() { this->SetScalarAxis(vtkTetrahedraVolumeMapper::NODES_AXIS); }
  ///@}

  ///@{
  /**
   * Set the format of the texels. Values are those of vtkTetrahedraVolumeMapper::TableFormatType;
   * AUTOMATIC_FORMAT is refused with an error. Default FLOAT_FORMAT.
   *
   * - UNORM8_FORMAT: unsigned char, 255 for 1.
   * - UNORM16_FORMAT: unsigned short, 65535 for 1.
   * - HALF_FORMAT: float, rounded to half precision (VTK has no such type).
   * - FLOAT_FORMAT: float.
   */
  virtual void SetFormat(int format);
  vtkGetMacro(Format, int);
  const char* GetFormatAsString();
  void SetFormatToUNorm8() { this->SetFormat(vtkTetrahedraVolumeMapper::UNORM8_FORMAT); }
  void SetFormatToUNorm16() { this->SetFormat(vtkTetrahedraVolumeMapper::UNORM16_FORMAT); }
  void SetFormatToHalf() { this->SetFormat(vtkTetrahedraVolumeMapper::HALF_FORMAT); }
  void SetFormatToFloat() { this->SetFormat(vtkTetrahedraVolumeMapper::FLOAT_FORMAT); }
  ///@}

  /**
   * Return the time of the last change of this source, its property or the property's functions.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkPreIntegrationTableSource();
  ~vtkPreIntegrationTableSource() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkPreIntegrationTableSource(const vtkPreIntegrationTableSource&) = delete;
  void operator=(const vtkPreIntegrationTableSource&) = delete;

  struct Plan;
  Plan MakePlan();

  vtkSmartPointer<vtkVolumeProperty> VolumeProperty;
  double ScalarRange[2] = { 1, 0 };
  double LongestSegment = 1;
  int BlendMode = vtkTetrahedraVolumeMapper::COMPOSITE_BLEND;
  int ScalarSize = 128;
  int LengthSize = 256;
  int LengthScale = vtkTetrahedraVolumeMapper::LINEAR_SCALE;
  int StepsPerDoubling = 1;
  int ScalarAxis = vtkTetrahedraVolumeMapper::UNIFORM_AXIS;
  int Format = vtkTetrahedraVolumeMapper::FLOAT_FORMAT;
};

#endif
