// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageOptics_h
#define tetralux_ImageOptics_h

#include "Optics/OpticalModel.h"
#include "Optics/TransferFunction.h"
#include "TriangleCaster/TransferTable.h"

#include <array>
#include <limits>
#include <vector>

namespace tetralux
{

/// How the opacity of a step follows from the scalar opacity a of the transfer function, 0..1, and
/// the step's length l in unit distances.
enum class StepOpacity
{
  Power,      ///< 1 - (1 - a)^l: the model of VTK's mappers of image data
  Attenuation ///< 1 - exp(-a l): that of mappers of unstructured grids
};

/// How long a gradient is.
enum class GradientNorm
{
  Euclidean, ///< L2
  Sum        ///< L1, the sum of its components: less to compute (Knittel 1999, section 7)
};

/// How the samples of a ray become a pixel: the blend modes of vtkVolumeMapper, as
/// vtkGPUVolumeRayCastMapper shows them. Scalar opacity is that of the transfer function.
enum class ImageBlend
{
  /// What emits and absorbs, composited front to back.
  Composite,

  /// Colour and scalar opacity of the largest or smallest scalar, however long its stretch. The
  /// depth of the pixel is that of the sample, of the first one of several.
  ///@{
  MaximumIntensity,
  MinimumIntensity,
  ///@}

  /// Mean of scalar opacity times grey of those samples whose scalar is in AverageRange, weighted
  /// by the lengths of their stretches; opaque if there is any. The depth is that of the first one.
  AverageIntensity,

  /// Sum of scalar opacity times grey times length in unit distances, at most 1; opaque wherever a
  /// ray goes through anything of the volume. The depth is that of the first stretch that adds
  /// anything.
  Additive,

  /// Surfaces of constant scalar, composited front to back. They are where the scalar of one sample
  /// is below a value and that of the next one of the same part of the ray is not, or the other way
  /// round; in between the scalar is taken for linear. The depth is that of the first surface that
  /// is not transparent.
  Isosurfaces,

  /// Colour and scalar opacity at the point that a ray has on a plane.
  Slice
};

/// What the rays gather in an image volume. Scalars that are not finite are empty.
struct ImageOptics
{
  ImageBlend Blend = ImageBlend::Composite;

  /// Colours, and the scalar opacity a in place of the attenuation: 0..1, or for
  /// StepOpacity::Attenuation at least 0.
  TransferFunction Function;
  StepOpacity Opacity = StepOpacity::Power;
  double UnitDistance = 1; ///< world units, above 0

  /// ImageBlend::Composite: a factor of the scalar opacity, 0..1, in place of the attenuation, over
  /// the length of the scalar's gradient times GradientLength. Without nodes there is none.
  TransferFunction GradientOpacity;
  double GradientLength = 1; ///< world units, above 0; VTK has the mean spacing of points
  GradientNorm Norm = GradientNorm::Euclidean;

  /// In place of Function and GradientOpacity; ImageBlend::Composite only. Without entries there is
  /// none.
  TransferTable Table;

  /// ImageBlend::AverageIntensity: scalars that count, both ends included.
  double AverageRange[2] = { -std::numeric_limits<double>::max(),
    std::numeric_limits<double>::max() };

  /// ImageBlend::AverageIntensity and Additive: the scalars of grey 0 and 1, different. Grey is
  /// linear between them and constant beyond. In VTK they are the ends of the volume's range.
  double GreyRange[2] = { 0, 1 };

  /// ImageBlend::Isosurfaces: in any order. Of several with the same value the first one is in
  /// front where scalars ascend along the ray, and the last one where they descend.
  std::vector<Isosurface> Surfaces;

  /// ImageBlend::Slice: world points with a x + b y + c z + d = 0.
  std::array<double, 4> SlicePlane{ 0, 0, 1, 0 };
};

} // namespace tetralux

#endif
