// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SceneOptics_h
#define tetralux_SceneOptics_h

#include "Base/Cached.h"
#include "Optics/ComponentFunctions.h"
#include "Optics/IntervalTable.h"
#include "Optics/OpticalModel.h"
#include "Optics/TransferFunction.h"
#include "PreIntegration/PreIntegrationTable.h"
#include "TetraluxCoreModule.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace tetralux
{

/// What rays gather, whatever the mesh: an optical model, a transfer function or isosurfaces, and a
/// pre-integration table of the function.
class TETRALUXCORE_EXPORT SceneOptics
{
public:
  /// At first emission and absorption.
  void SetModel(OpticalModel model) { this->Model = model; }
  OpticalModel GetModel() const { return this->Model; }

  /// Replaces the function, and removes the table. error: of a channel, if the function
  /// approximates another one. tolerance: for the intervals, which stand for it along rays. Throws
  /// std::invalid_argument as MakeIntervalTable does. Isosurfaces need no function.
  void SetTransferFunction(
    TransferFunction function, double error = 0, const RunTolerance& tolerance = {});
  const TransferFunction& GetTransferFunction() const { return this->Function; }
  const IntervalTable& GetIntervalTable() const { return this->Intervals; }

  /// Sets the tolerance alone. Returns whether other intervals follow from it: then it is as if the
  /// function were another one.
  bool SetRunTolerance(const RunTolerance& tolerance);

  /// What a channel of a picture is off by, by both.
  double GetFunctionError() const { return this->FunctionError; }

  /// Sets functions of several scalars, in place of the one of SetTransferFunction, of which the
  /// first one is the scalar: for OpticalModel::EmissionAbsorption. Without functions: of the one
  /// scalar. Throws std::invalid_argument as SetTransferFunction, and if their number is wrong.
  void SetComponents(ComponentFunctions components);
  const ComponentFunctions& GetComponents() const { return this->Components; }
  const std::vector<IntervalTable>& GetComponentIntervals() const
  {
    return this->ComponentIntervals;
  }

  /// Whether there are functions of several scalars.
  bool HasComponents() const { return !this->Components.Functions.empty(); }

  /// Sets what OpticalModel::Isosurfaces shows, in any order; of equal values the last one counts.
  /// Throws std::invalid_argument if a value or a colour is not finite.
  void SetIsosurfaces(std::vector<Isosurface> surfaces);
  /// Ascending in value.
  const std::vector<Isosurface>& GetIsosurfaces() const { return this->Surfaces; }

  /// Sets a table of the present function to look segments up in, in place of the closed form: for
  /// OpticalModel::EmissionAbsorption of scalars at points. pictureError: what pictures by it are
  /// expected to be wrong by. nullptr: no table.
  void SetTable(std::shared_ptr<const PreIntegrationTable> table, double pictureError);
  const PreIntegrationTable* GetTable() const { return this->Table.get(); }
  double GetTableError() const { return this->TableError; }

  /// Versions of the functions, of surfaces and of the table; 0: never set.
  ///@{
  std::uint64_t GetFunctionVersion() const { return this->FunctionVersion; }
  std::uint64_t GetSurfacesVersion() const { return this->SurfacesVersion; }
  std::uint64_t GetTableVersion() const { return this->TableVersion; }
  ///@}

  /// Brings the texels of the table in single precision up to date.
  void PrepareFloatTexels();

  /// In the order of PreIntegrationTable; nullptr without a table. After PrepareFloatTexels.
  const float* GetFloatTexels() const;

private:
  void SetIntervals(IntervalTable intervals, const RunTolerance& tolerance);
  void SetFunctionError(const RunTolerance& tolerance);

  OpticalModel Model = OpticalModel::EmissionAbsorption;
  TransferFunction Function;
  IntervalTable Intervals;
  ComponentFunctions Components;
  std::vector<IntervalTable> ComponentIntervals;
  std::vector<Isosurface> Surfaces;
  std::shared_ptr<const PreIntegrationTable> Table;
  double TableError = 0;
  double ApproximationError = 0; ///< of Function
  double FunctionError = 0;
  std::uint64_t FunctionVersion = 0;
  std::uint64_t SurfacesVersion = 0;
  std::uint64_t TableVersion = 0;
  Cached<std::vector<float>> Texels; ///< of a table that has another format
};

} // namespace tetralux

#endif
