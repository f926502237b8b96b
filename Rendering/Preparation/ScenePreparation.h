// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ScenePreparation_h
#define tetralux_ScenePreparation_h

#include "Base/Cached.h"
#include "Intake/TetrahedraIntake.h"
#include "Optics/OpticalModel.h"
#include "Preparation/ComponentsFromProperty.h"
#include "Preparation/InputSignature.h"
#include "Preparation/MapperSettings.h"
#include "Preparation/PointMerger.h"
#include "Preparation/SegmentTable.h"
#include "Preparation/TransferFunctionFromProperty.h"
#include "Report/OnceWarning.h"
#include "Scene/VolumeScene.h"
#include "TetraluxRenderingModule.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class vtkDataObject;
class vtkMatrix4x4;
class vtkVolumeProperty;

namespace tetralux
{

/// What a scene is made of.
struct SceneInput
{
  vtkDataObject* Data = nullptr;
  vtkVolumeProperty* Property = nullptr;
  vtkMatrix4x4* Matrix = nullptr; ///< of the volume: world from mesh
  bool Interactive = false;       ///< a frame that has to be there soon: a coarse table will do
  bool LightVaries = false;       ///< in cells, where anything is lit: no table will do
  const std::vector<Light>* Lights = nullptr; ///< nullptr: nothing is lit
  const Material* Surface = nullptr;          ///< nullptr: nothing is lit
};

/// Makes a VolumeScene of a data set and a property, and keeps it: each stage is done again only if
/// what it depends on has changed. Cells, points, scalars, transfer function and table are a stage
/// each, so that a new time step rebuilds what it changes.
class TETRALUXRENDERING_EXPORT ScenePreparation
{
public:
  /// source: gives the warnings, once for each cause.
  explicit ScenePreparation(vtkObject* source);

  /// Brings the scene up to date, with what FindComponentUse says is shown
  /// of the array. progress: told the share that is done, 0..1, while the mesh is built;
  /// where it returns false, so does Update. Throws std::invalid_argument, with one line, if the
  /// input or the property can't be rendered.
  bool Update(const MapperSettings& wanted, const SceneInput& input,
    const std::function<bool(double)>& progress);

  VolumeScene Scene;
  TetrahedraIntakeReport Intake;

  /// Whether the property's Shade counts: for isosurfaces and for emission with absorption, if
  /// scalars at points have a gradient.
  bool IsShaded(vtkVolumeProperty* property) const;

  /// Points of the input that were merged into others.
  std::size_t GetNumberOfMergedPoints() const { return this->Merger.GetMerged().Points.size(); }

  const std::string& GetArrayName() const { return this->ArrayName; }
  int GetNumberOfComponents() const { return this->Components.Components; } ///< that are shown
  const SegmentTable& GetTable() const { return this->Table; }
  TableUse GetTableUse() const { return this->Use; }

  /// The last Update: which stages were made anew, and seconds that they took.
  struct Record
  {
    std::vector<std::string> Rebuilt;
    double IntakeSeconds = 0;
    double MeshSeconds = 0;
    double ScalarsSeconds = 0;
    double FunctionSeconds = 0;
    double TableSeconds = 0;

    /// The largest memory that the process has held up to the end of each stage, bytes.
    std::vector<std::pair<const char*, std::int64_t>> Peaks;
  };
  const Record& GetLast() const { return this->Last; }

private:
  /// What an input is told from others by.
  struct InputKeys
  {
    CacheKey Cells;
    CacheKey Points;
    CacheKey Scalars;
    CacheKey Colors;
  };

  bool IsOf(const InputKeys& keys) const;
  bool PrepareMesh(const MapperSettings& settings, vtkDataObject* input, const InputKeys& keys,
    const std::function<bool(double)>& progress);
  bool MovePoints(vtkDataObject* input);
  bool MergePoints(const MapperSettings& settings, vtkDataObject* input, const CacheKey& scalars,
    const std::function<bool(double)>& progress);
  bool UseMerged(const MapperSettings& settings, vtkDataObject* input,
    const CoincidentPoints& merged, const std::function<bool(double)>& progress, bool& used);
  void SetMesh(std::shared_ptr<WalkMesh> mesh, TetrahedraIntakeReport report);
  void ChooseComponents(const MapperSettings& settings, const std::vector<DataSetBlock>& blocks,
    vtkVolumeProperty* property);
  CoincidentPoints ChooseMerged(const MapperSettings& settings, vtkDataObject* input) const;
  void PrepareScalars(vtkDataObject* input, const CacheKey& key);
  ExtractedScalars Extract(vtkDataObject* input, int component);
  void PrepareColors(
    vtkDataObject* input, const CacheKey& key, const std::optional<ScalarSelection>& selection);
  void PrepareFunction(const MapperSettings& settings, const SceneInput& input);
  PropertyTransferFunction MakeFunctions(
    const SceneInput& input, double maximumError, double longestPath);
  void PrepareTable(const MapperSettings& settings, const SceneInput& input);
  void WarnOfMesh();
  void WarnOfShade(vtkVolumeProperty* property);

  vtkObject* Source;

  // What the stages were made from.
  vtkMTimeType InputTime = 0;      ///< GetInputTime at the last Update that came to its end
  vtkMTimeType AttributesTime = 0; ///< GetAttributesTime at that Update
  bool Touched = true;             ///< since then: all may have changed in place
  bool ValuesTouched = true;       ///< since then: values of arrays may have
  ComponentUse Components;
  CacheKey CellsKey;
  Digest Cells{};
  Digest Points{};
  CacheKey PointsKey;
  CacheStamp Merging;
  PointMerger Merger;
  CacheStamp Scalars;
  CacheStamp Colors;
  CacheStamp Function;
  double PropertyError = 0; ///< 0: the function does not depend on the error that is allowed
  CacheStamp Tolerance;     ///< of the runs of the function

  std::string ArrayName;
  SegmentTable Table;
  TableUse Use = TableUse::Automatic;
  std::uint64_t TableOfFunction = 0; ///< version of the function that the scene has Table for
  OnceWarning ShadeWarning;
  OnceWarning ComponentsWarning;
  OnceWarning MeshWarning;
  Record Last;
};

} // namespace tetralux

#endif
