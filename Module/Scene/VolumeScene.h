// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_VolumeScene_h
#define tetralux_VolumeScene_h

#include "Integral/IntegrationPlan.h"
#include "Mesh/PointGradients.h"
#include "Optics/IntervalTable.h"
#include "Optics/OpticalModel.h"
#include "Optics/TransferFunction.h"
#include "PreIntegration/PreIntegrationTable.h"
#include "Scene/GeometryError.h"
#include "TetraluxCoreModule.h"
#include "View/RayGrid.h"
#include "Walk/MeshRays.h"
#include "Walk/WalkMesh.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace tetralux
{

/// What is rendered, the same for every method: a mesh, its scalars, an optical model and what the
/// model needs. What is set stays valid until it is set again; what follows from it is made when it
/// is first asked for, and kept.
class TETRALUXCORE_EXPORT VolumeScene
{
public:
  /// The mesh; scalars must be set after it.
  void SetMesh(std::shared_ptr<WalkMesh> mesh);
  WalkMesh* GetMesh() const { return this->Mesh.get(); }

  /// Counts the changes of the mesh, for what was made of it.
  std::uint64_t GetMeshVersion() const { return this->MeshVersion; }

  /// One scalar for each point, or for each cell, of WalkMesh::GetMesh(); any values, those that
  /// are not finite make the cells that touch them contribute nothing. Throws
  /// std::invalid_argument where their number is wrong.
  ///@{
  void SetPointScalars(std::vector<double> scalars);
  void SetCellScalars(std::vector<double> scalars);
  ///@}
  const std::vector<double>& GetScalars() const { return this->Scalars; }
  bool HasCellScalars() const { return this->ScalarsOfCells; }

  /// Least and largest finite scalar; 0 and 0 where there is none.
  const double* GetScalarRange() const { return this->ScalarRange; }

  /// Cells that touch a scalar which is not finite.
  std::int64_t GetNumberOfBlankCells() const { return this->NumberOfBlankCells; }

  /// What rays gather; at first emission and absorption.
  void SetOpticalModel(OpticalModel model);
  OpticalModel GetOpticalModel() const { return this->Model; }

  /// Throws std::invalid_argument as MakeIntervalTable does. Isosurfaces need none.
  void SetTransferFunction(const TransferFunction& function);
  const TransferFunction& GetTransferFunction() const { return this->Function; }
  const IntervalTable& GetIntervalTable() const { return this->Intervals; }

  /// A table to look segments up in, of the present transfer function, instead of the closed form:
  /// for OpticalModel::EmissionAbsorption of scalars at points; a constant colour needs none.
  /// pictureError: what pictures by it are expected to be wrong by. nullptr: none, as it is at first
  /// and after SetTransferFunction.
  void SetTable(std::shared_ptr<const PreIntegrationTable> table, double pictureError);
  const PreIntegrationTable* GetTable() const { return this->Table.get(); }

  /// Counts the changes of what GetTable and GetCellValues return, for copies of it.
  ///@{
  std::uint64_t GetTableVersion() const { return this->TableVersion; }
  std::uint64_t GetCellValuesVersion() const { return this->CellValuesVersion; }
  ///@}

  double GetTableError() const { return this->TableError; }

  /// The texels of the table in single precision, as PreIntegrationTable has them; nullptr without a
  /// table.
  const float* GetFloatTexels();

  /// What OpticalModel::Isosurfaces shows, in any order; values that are repeated count once, the
  /// last one. Throws std::invalid_argument where a value or a colour is not finite.
  void SetIsosurfaces(std::vector<Isosurface> surfaces);
  /// Ascending in value.
  const std::vector<Isosurface>& GetIsosurfaces() const { return this->Surfaces; }

  /// How segments are integrated for the present model, function and scalars, table aside.
  const IntegrationPlan& GetPlan();

  /// Throws std::invalid_argument, with one line, where something is missing, or where isosurfaces
  /// are asked for of scalars at cells.
  void CheckComplete() const;

  /// Scalars in the tables that are rendered from are x = (s - Offset) / Scale: those of the
  /// transfer function's intervals, and for isosurfaces the range of the scalars from -1 to 1.
  struct ScalarMap
  {
    double Offset = 0;
    double Scale = 0; ///< 0: the table has no scalars yet
    double Map(double scalar) const { return (scalar - this->Offset) / this->Scale; }
    bool operator==(const ScalarMap& other) const
    {
      return this->Offset == other.Offset && this->Scale == other.Scale;
    }
  };
  ScalarMap GetScalarMap() const;

  /// Fills the mesh's points with their mapped scalars, unless that is done already; with 0 where
  /// scalars are at cells. real: float or double.
  ///@{
  template <class Real>
  const WalkPoint<Real>* GetPoints();
  ///@}

  /// Counts the changes of what GetPoints<float>() returns; 0 before the first. For copies of it.
  std::uint64_t GetPointsVersion() const { return this->PointsVersion; }

  /// Attenuation and colour of each cell of scalars at cells (0 where the scalar is not finite); for
  /// OpticalModel::MaximumIntensity the mapped scalar in place of the attenuation, not-a-number
  /// where it is not finite.
  const std::vector<CellValue>& GetCellValues();

  /// Gradients of scalars at points, for smooth lighting: MakePointGradients in units of the mesh's
  /// radius and of half of the scalars' range.
  const std::vector<PointGradient>& GetPointGradients();

  /// For each cell 1 where it contributes anything, 0 where it is fully transparent; empty where all
  /// do, as far as is known.
  const std::vector<std::uint8_t>& GetVisibleCells();
  std::int64_t GetNumberOfTransparentCells();

  /// The topology of the visible cells alone; nullptr where leaving the others out would not pay.
  const WalkTables* GetVisibleTables();

  /// Counts the changes of what GetVisibleTables() returns; 0 before the first. For copies of it.
  std::uint64_t GetVisibleTablesVersion() const { return this->VisibleTablesVersion; }

  /// Of the mesh, in its units; measured once.
  double GetLongestEdge();

  /// No segment of a ray is longer, world units: the longest edge, where it is stretched most.
  double GetLongestSegment(const RayGrid& grid);

  /// DrawMeshRays, of scalars at points: the same until the mesh, the scalars or the scale change.
  std::shared_ptr<const RaySample> GetRaySample(double scale);

  /// Radius of the mesh in the world, world units: along its longest extent, where MeshFromWorld of
  /// the grid stretches it.
  double GetWorldRadius(const RayGrid& grid) const;

  /// Estimated error of a channel by rounding coordinates and scalars, see GeometryError.h; of
  /// isosurfaces 0. Infinite where the mesh is so small or so large that distances in it leave the
  /// range of single precision. worldRadius: GetWorldRadius. Measured once for what it depends on.
  double EstimateGeometryError(double worldRadius, const GeometryRounding& rounding);

  /// EstimateOrderError of emission and absorption; 0 of other models. worldRadius: GetWorldRadius.
  /// Measured once.
  double EstimateOrderError(double worldRadius);

private:
  void SetScalars(std::vector<double> scalars, bool ofCells);
  void CountBlankCells();
  double GetLargestMappedScalar() const;
  double EstimateRounding(double worldRadius, const GeometryRounding& rounding);

  /// Rays to estimate errors by, and the world length of a unit of theirs.
  std::pair<const RaySample&, double> GetAnyRays(double worldRadius);
  void Invalidate();

  std::shared_ptr<WalkMesh> Mesh;
  std::vector<double> Scalars;
  bool ScalarsOfCells = false;
  double ScalarRange[2] = { 0, 0 }; ///< of the finite ones
  std::int64_t NumberOfBlankCells = 0;
  OpticalModel Model = OpticalModel::EmissionAbsorption;
  TransferFunction Function;
  IntervalTable Intervals;
  IntegrationPlan Plan; ///< of model, function and scalars
  std::shared_ptr<const PreIntegrationTable> Table;
  std::vector<float> Texels; ///< of Table, where it has another format
  double TableError = 0;
  std::vector<Isosurface> Surfaces; ///< ascending in value
  std::vector<CellValue> CellValues;
  std::vector<PointGradient> PointGradients;
  std::vector<std::uint8_t> VisibleCells;
  WalkTables VisibleTables; ///< empty where rays are walked through all cells
  std::int64_t NumberOfTransparentCells = 0;
  ScalarMap FloatScalars, DoubleScalars; ///< of the mesh's tables
  std::uint64_t MeshVersion = 0;
  double LongestEdge = -1;                      ///< of the mesh; negative: not measured yet
  std::shared_ptr<const RaySample> SampledRays; ///< nullptr: not drawn yet
  double ScaleOfRays = 0;
  double GeometryError = -1; ///< negative: not measured yet
  double GeometryErrorRadius = 0;
  GeometryRounding GeometryErrorRounding = { 0, 0 };
  double OrderError = -1; ///< negative: not measured yet
  double OrderErrorRadius = 0;
  std::uint64_t PointsVersion = 0;
  std::uint64_t TableVersion = 0;
  std::uint64_t CellValuesVersion = 0;
  std::uint64_t VisibleTablesVersion = 0;
  bool CellValuesValid = false;
  bool PointGradientsValid = false;
  bool PlanValid = false;
  bool VisibleCellsValid = false;
  bool VisibleTablesValid = false;
};

} // namespace tetralux

#endif
