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

/// What the components of a point are to each other.
enum class ImageComponents
{
  /// Each has functions of its own, and what they show is added up by their weights. With alpha the
  /// opacity of a component's step and w its weight, a sample emits the sum of w alpha color, and
  /// absorbs the sum of alpha^2 over that of w alpha, at most 1; components of no weight are not
  /// there. As in vtkGPUVolumeRayCastMapper.
  Independent,

  /// Of two components, the first one has the colour and the last one the opacity of the one
  /// function. Of four, the first three are red, green and blue, and the last one has the opacity.
  /// Gradients are those of the last one. Of three there is no such meaning.
  Dependent
};

/// How one of several independent components is shown.
struct ComponentOptics
{
  /// As those of ImageOptics.
  ///@{
  TransferFunction Function;
  double UnitDistance = 1;
  TransferFunction GradientOpacity;
  double Weight = 1;
  ///@}
  bool Shaded = false; ///< by the lights of ImageCasterOptions
  Material Surface;
};

/// How samples of a label are shown. Unlike in VTK 9.1, the opacity of a step follows from its
/// length as that of other samples does.
struct LabelOptics
{
  TransferFunction Function;        ///< as that of ImageOptics
  TransferFunction GradientOpacity; ///< as that of ImageOptics; without nodes there is none
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
  /// round; in between the scalar is taken for linear. Next to a hidden sample there is none.
  /// The depth is that of the first surface that is not transparent.
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

  // Several components: ImageBlend::Composite only, and without Table.
  ImageComponents Components = ImageComponents::Independent;
  double Weight = 1; ///< of the first component, at least 0; in VTK at most 1
  /// The components behind the first one, if they are independent. The first one has what stands
  /// above, and is shaded by ImageCasterOptions.
  std::vector<ComponentOptics> OtherComponents;
  /// Of four dependent ones: a channel is ColorOffset + ColorScale s, with s the scalar of its
  /// component. By default that is bytes over 255. vtkGPUVolumeRayCastMapper has 1 / 65535 for 16
  /// bits without a sign, 1 / 32767 with one, and 1 for floats.
  ///@{
  double ColorScale[3] = { 1. / 255, 1. / 255, 1. / 255 };
  double ColorOffset[3] = { 0, 0, 0 };
  ///@}

  /// Of a volume of one component with labels: how labels 1, 2 and so on are shown. Label 0, and
  /// labels that are not here, have what stands above. ImageBlend::Composite only, and without
  /// Table.
  std::vector<LabelOptics> Labels;
  /// How much of a labelled sample's colour and opacity is that of its label, 0..1; the rest is
  /// what it would have without. Both are mixed before the colour is multiplied by opacity.
  double LabelShare = 1;
};

} // namespace tetralux

#endif
