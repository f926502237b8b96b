// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPreIntegrationTable
 * @brief   what ray segments add to a picture, tabulated as an image
 *
 * A source without input: from a vtkVolumeProperty (component 0), a range of scalars and a longest
 * segment to the table by which segments of rays are integrated (Weiler et al., Hardware-Based Ray
 * Casting for Tetrahedral Meshes, 2003, section 4; Kraus et al., Projecting Tetrahedra without
 * Rendering Artifacts, 2004, section 3), so that it can be saved, looked at and compared in any
 * pipeline.
 *
 * The output is a vtkImageData with the point scalars "RGBA": premultiplied colour and opacity of a
 * segment over its front scalar (x), its back scalar (y) and its length (z). A point is a texel's
 * centre; the first and the last ones are the ends of the axes. Optical models but the first need
 * fewer dimensions:
 *
 *   EmissionAbsorption  3-D
 *   EmissionOnly        2-D, emission (RGB) and optical depth (A) for each unit of length
 *   AbsorptionOnly      the same
 *   MaximumIntensity    1-D, premultiplied colour and opacity of the largest scalar
 *   Isosurfaces         2-D, the flat surfaces that a segment crosses: the property's
 *                       IsoSurfaceValues with colour and opacity of their scalars
 *
 * These are in single precision with equal steps, whatever else is set.
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
 *   ErrorBound             of a segment, by interpolation: largest, largest for each unit of length;
 *                          then by rounding: no segment exceeds them, see PreIntegrationError.h (3-D)
 *   ErrorEstimate          the same, measured (3-D)
 *   FunctionError          of a colour channel, by approximating functions that are not piecewise
 *                          linear
 *
 * Fails, with an error, without a property and on settings that it can't do.
 *
 * It stands among the mappers since vtkVolumeProperty does.
 *
 * @sa vtkTetrahedraRayCastMapper, vtkUnstructuredGridPreIntegration
 */
#ifndef vtkPreIntegrationTable_h
#define vtkPreIntegrationTable_h

#include "TetraluxRenderingModule.h"
#include "vtkImageAlgorithm.h"
#include "vtkSmartPointer.h" // for members

class vtkVolumeProperty;

class TETRALUXRENDERING_EXPORT vtkPreIntegrationTable : public vtkImageAlgorithm
{
public:
  static vtkPreIntegrationTable* New();
  vtkTypeMacro(vtkPreIntegrationTable, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Colour, scalar opacity and unit distance. None by default.
   */
  void SetVolumeProperty(vtkVolumeProperty* property);
  vtkVolumeProperty* GetVolumeProperty();
  ///@}

  ///@{
  /**
   * Scalars of the segments, in the units of the scalars. Where the first is larger than the second
   * (the default, 1 and 0), from the first node of the property's functions to the last.
   */
  vtkSetVector2Macro(ScalarRange, double);
  vtkGetVector2Macro(ScalarRange, double);
  ///@}

  ///@{
  /**
   * Longest segment, in world units: the longest edge of all cells. Default 1.
   */
  vtkSetMacro(LongestSegment, double);
  vtkGetMacro(LongestSegment, double);
  ///@}

  /// Numbers for OpticalModel.
  enum
  {
    EMISSION_ABSORPTION = 0,
    EMISSION_ONLY = 1,
    ABSORPTION_ONLY = 2,
    MAXIMUM_INTENSITY = 3,
    ISOSURFACES = 4
  };

  ///@{
  /**
   * Which integral is tabulated. Default EMISSION_ABSORPTION.
   */
  vtkSetClampMacro(OpticalModel, int, EMISSION_ABSORPTION, ISOSURFACES);
  vtkGetMacro(OpticalModel, int);
  ///@}

  ///@{
  /**
   * Texels along each scalar, 2..4096 (default 128), and along the length, 2..4096 (default 256).
   */
  vtkSetMacro(ScalarSize, int);
  vtkGetMacro(ScalarSize, int);
  vtkSetMacro(LengthSize, int);
  vtkGetMacro(LengthSize, int);
  ///@}

  ///@{
  /**
   * How texels lie along the length: 1, linear, with equal steps (default), or 2, logarithmic, with
   * StepsPerDoubling (a power of 2 below LengthSize, default 1) steps up to delta l and for every
   * doubling. The numbers are those of vtkTetrahedraRayCastMapper.
   */
  vtkSetClampMacro(LengthScale, int, 1, 2);
  vtkGetMacro(LengthScale, int);
  vtkSetMacro(StepsPerDoubling, int);
  vtkGetMacro(StepsPerDoubling, int);
  ///@}

  ///@{
  /**
   * How texels lie along the scalars: 1, uniform, with equal steps (default), or 2, on the nodes of
   * the functions and denser next to them.
   */
  vtkSetClampMacro(ScalarAxis, int, 1, 2);
  vtkGetMacro(ScalarAxis, int);
  ///@}

  ///@{
  /**
   * 1: unsigned char, 255 for 1; 2: unsigned short, 65535 for 1; 3: float, rounded to half precision
   * (VTK has no such type); 4: float (default).
   */
  vtkSetClampMacro(Format, int, 1, 4);
  vtkGetMacro(Format, int);
  ///@}

  /**
   * Also that of the property and its functions.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkPreIntegrationTable();
  ~vtkPreIntegrationTable() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkPreIntegrationTable(const vtkPreIntegrationTable&) = delete;
  void operator=(const vtkPreIntegrationTable&) = delete;

  struct Plan;
  Plan MakePlan();

  vtkSmartPointer<vtkVolumeProperty> VolumeProperty;
  double ScalarRange[2] = { 1, 0 };
  double LongestSegment = 1;
  int OpticalModel = EMISSION_ABSORPTION;
  int ScalarSize = 128;
  int LengthSize = 256;
  int LengthScale = 1;
  int StepsPerDoubling = 1;
  int ScalarAxis = 1;
  int Format = 4;
};

#endif
