// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ScenePreparation_h
#define tetralux_ScenePreparation_h

#include "Intake/TetrahedraIntake.h"
#include "Preparation/InputSignature.h"
#include "Preparation/SegmentTable.h"
#include "Report/JsonObject.h"
#include "Report/OnceWarning.h"
#include "Scene/VolumeScene.h"

#include <functional>
#include <string>
#include <vector>

class vtkDataObject;
class vtkTetrahedraVolumeMapper;
class vtkVolume;
class vtkVolumeProperty;

namespace tetralux
{

/// Makes a VolumeScene of a mapper's input, its properties and those of the volume, and keeps it:
/// each stage is done again only where what it depends on has changed. Reports what was done.
class ScenePreparation
{
public:
  explicit ScenePreparation(vtkTetrahedraVolumeMapper* mapper);

  /// Brings the scene up to date. progress: told the share that is done, 0..1, while the mesh is built;
  /// where it returns false, so does Update. Throws std::invalid_argument, with one line, where the
  /// input or the property can't be rendered.
  bool Update(vtkVolume* volume, const std::function<bool(double)>& progress);

  VolumeScene Scene;
  TetrahedraIntakeReport Intake;

  /// Whether the property's Shade counts: for isosurfaces and for emission with absorption, where
  /// scalars at points have a gradient.
  bool IsShaded(vtkVolumeProperty* property) const;

  /// Error of a channel by approximating the property's functions.
  double GetFunctionError() const { return this->FunctionError; }

  // Statistics, of the last Update where it is about time.

  const std::vector<std::string>& GetRebuilt() const { return this->Rebuilt; }
  void WriteSeconds(JsonObject& seconds) const;
  JsonObject DescribeInput() const;
  JsonObject DescribeTables() const;
  JsonObject DescribeSegments(const std::string& integration);

private:
  bool PrepareMesh(vtkDataObject* input, const std::function<bool(double)>& progress);
  void PrepareScalars(vtkDataObject* input);
  void PrepareFunction(vtkVolume* volume);
  void PrepareTable(vtkVolume* volume);
  void WarnOfMesh();
  void WarnOfShade(vtkVolumeProperty* property);
  std::string GetIntegrationReason();

  vtkTetrahedraVolumeMapper* Mapper;

  // What was built, and from what.
  Signature MeshSignature;
  Signature ScalarsSignature;
  Signature FunctionSignature;
  double FunctionMaximumError = 0;
  double FunctionLongestPath = 0;
  std::string ArrayName;
  double FunctionError = 0;
  SegmentTable Table;
  bool TableSet = false; ///< the scene has Table
  OnceWarning ShadeWarning;
  OnceWarning MeshWarning;

  // The last Update.
  std::vector<std::string> Rebuilt;
  double IntakeSeconds = 0;
  double MeshSeconds = 0;
  double ScalarsSeconds = 0;
  double FunctionSeconds = 0;
  double TableSeconds = 0;
};

} // namespace tetralux

#endif
