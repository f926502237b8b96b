// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImagePreparation_h
#define tetralux_ImagePreparation_h

#include "Base/Cached.h"
#include "ImagePreparation/ImageMask.h"
#include "ImagePreparation/ImagePlacement.h"
#include "ImagePreparation/ImageScalars.h"
#include "Intake/ScalarExtraction.h"
#include "Report/Json.h"
#include "Report/OnceWarning.h"
#include "TetraluxRenderingModule.h"
#include "TriangleCaster/ImageCaster.h"
#include "TriangleCaster/ImageOptics.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkDataObject;
class vtkImageData;
class vtkMatrix4x4;
class vtkObject;
class vtkVolumeProperty;

namespace tetralux
{

/// What a caster is prepared from.
struct ImageInput
{
  vtkDataObject* Data = nullptr;
  vtkVolumeProperty* Property = nullptr;
  vtkMatrix4x4* Matrix = nullptr; ///< of the volume: world from data
  ScalarSelection Scalars;
  vtkImageData* Mask = nullptr; ///< may be nullptr
  MaskType Type = MaskType::Labels;
  double LabelShare = 1; ///< of ImageOptics
  ImageBlend Blend = ImageBlend::Composite;
  double AverageRange[2] = { 0, 0 }; ///< of ImageBlend::AverageIntensity
  StepOpacity Opacity = StepOpacity::Power;
  GradientNorm Norm = GradientNorm::Euclidean;
  double MaximumError = 1e-4; ///< of a channel, 0..1
};

/// Brings an ImageCaster up to date with image data and a property: each stage is done again only
/// if what it depends on has changed.
class TETRALUXRENDERING_EXPORT ImagePreparation
{
public:
  /// source: gives the warnings, once for each cause.
  explicit ImagePreparation(vtkObject* source);

  /// Throws std::invalid_argument, with one line, if the input or the property can't be rendered.
  void Update(const ImageInput& input);

  ImageCaster Caster;

  const ImagePlacement& GetPlacement() const { return this->Placement; }
  const ImageScalars& GetScalars() const { return this->Scalars; }
  const ImageOptics& GetOptics() const { return this->Optics; } ///< what the caster has

  /// The independent components behind the first one.
  const std::vector<ComponentOptics>& GetOtherComponents() const
  {
    return this->Optics.OtherComponents;
  }

  /// The largest channel of a colour of any function, of the table or of components that are
  /// colours, absolute.
  double GetLargestColor() const;

  /// Whether opacities depend on gradients.
  bool HasGradientOpacity() const
  {
    return !this->Optics.GradientOpacity.Nodes.empty() || !this->Optics.Table.Entries.empty();
  }

  /// Error of a channel by functions that are not piecewise linear.
  double GetFunctionError() const { return this->FunctionError; }

  /// Another one whenever a stage was made anew; 0: none yet.
  std::uint64_t GetVersion() const { return this->Version; }

  /// The last Update: which stages were made anew.
  const std::vector<std::string>& GetRebuilt() const { return this->Rebuilt; }

  // For the statistics.

  Json DescribeSeconds() const;
  Json DescribeInput() const;

private:
  void PrepareFunction(const ImageInput& input, const SelectedArray& selected);

  vtkObject* Source;
  ImagePlacement Placement;
  ImageScalars Scalars;
  ImageMask Mask;
  ImageOptics Optics;
  CacheStamp Function;
  double FunctionError = 0;
  double LargestChannel = 0; ///< of components that are colours, absolute
  OnceWarning UnusedWarning;
  std::vector<std::string> Rebuilt;
  std::uint64_t Version = 0;
  double ScalarsSeconds = 0;
  double FunctionSeconds = 0;
};

} // namespace tetralux

#endif
