// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_VolumeScene_h
#define tetralux_VolumeScene_h

#include "Base/Cached.h"
#include "Integral/IntegrationPlan.h"
#include "Scene/EightBitError.h"
#include "Scene/GeometryError.h"
#include "Scene/MeshScene.h"
#include "Scene/SceneOptics.h"
#include "TetraluxCoreModule.h"
#include "Walk/WalkTables.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// What a method needs of a scene beyond the plan and, of scalars at cells, their values.
struct SceneNeeds
{
  bool SinglePoints = false;   ///< GetPoints<float>()
  bool DoublePoints = false;   ///< GetPoints<double>()
  bool VisibleCells = false;   ///< GetVisibleCells()
  bool VisibleTables = false;  ///< GetVisibleTables(), and GetVisibleCells()
  bool PointGradients = false; ///< MeshScene::GetPointGradients()
  bool CellGradients = false;  ///< MeshScene::GetCellGradients()
  bool LongestEdge = false;    ///< MeshScene::GetLongestEdge()
  bool FloatTexels = false;    ///< SceneOptics::GetFloatTexels()
  bool ComponentRows = false;  ///< GetComponentRows()
};

/// Scalars in the tables that are rendered from are x = (s - Offset) / Scale: those of the transfer
/// function's intervals, and for isosurfaces the range of the scalars from -1 to 1.
struct ScalarMap
{
  double Offset = 0;
  double Scale = 1;
  double Map(double scalar) const { return (scalar - this->Offset) / this->Scale; }
};

/// The scalars of a point, each as the table of its function maps it; 0 behind the last one.
struct alignas(4 * sizeof(double)) ComponentRow
{
  double Scalars[MostComponents];
};
static_assert(MostComponents == 4, "a row is loaded at once");

/// What is rendered, the same for every method: a mesh with scalars, what rays gather in it, and
/// what is visible of both. Prepare makes what follows from what was set; getters only read.
class TETRALUXCORE_EXPORT VolumeScene
{
public:
  MeshScene Mesh;
  SceneOptics Optics;

  /// Throws std::invalid_argument, with one line, if something is missing, or if isosurfaces are
  /// asked for of scalars at cells.
  void CheckComplete() const;

  /// Brings up to date what is needed, and nothing else; what is up to date costs nothing. Call it
  /// after any change of Mesh or Optics and before the getters below. The mesh must be set.
  void Prepare(const SceneNeeds& needs);

  /// Whether rays gather several scalars.
  bool HasComponents() const;

  /// How segments are integrated for the present model, function and scalars, table aside.
  const IntegrationPlan& GetPlan() const { return this->Plan.Get(); }

  ScalarMap GetScalarMap() const;

  /// The mesh's points with their mapped scalars, 0 if scalars are at cells. Real: float or double.
  template <class Real>
  const WalkPoint<Real>* GetPoints() const
  {
    return this->Mesh.GetMesh()->template GetPoints<Real>();
  }

  /// Attenuation and colour of each cell of scalars at cells (0 if the scalar is not finite); for
  /// OpticalModel::MaximumIntensity the mapped scalar in place of the attenuation, not-a-number if
  /// it is not finite. Empty for scalars at points.
  const std::vector<CellValue>& GetCellValues() const { return this->CellValues.Get(); }

  /// Of several scalars at points, one for each point of the tables that rays are walked through.
  const std::vector<ComponentRow>& GetComponentRows() const { return this->ComponentRows.Get(); }

  /// For each cell 1 if it contributes anything, 0 if it is fully transparent; empty: all may
  /// contribute.
  const std::vector<std::uint8_t>& GetVisibleCells() const { return this->Visible.Get().Cells; }
  std::int64_t GetNumberOfTransparentCells() const
  {
    return this->Visible.Get().NumberOfTransparent;
  }

  /// The topology of the visible cells alone; nullptr if leaving the others out would not pay.
  const WalkTables* GetVisibleTables() const
  {
    return this->VisibleTables.Faces.empty() ? nullptr : &this->VisibleTables;
  }

  /// Versions of what the getters return, for copies of it; 0: not made yet.
  ///@{
  std::uint64_t GetPointsVersion() const { return this->SinglePoints.GetVersion(); }
  std::uint64_t GetCellValuesVersion() const { return this->CellValues.GetVersion(); }
  std::uint64_t GetVisibleTablesVersion() const { return this->VisibleTopology.GetVersion(); }
  ///@}

  /// Throws std::invalid_argument, with one line, if a mesh of that radius, world units, is so
  /// small or so large that attenuations which make it visible leave the range of single precision.
  static void CheckWorldRadius(double worldRadius);

  /// Estimated error of a channel by rounding coordinates and scalars, see GeometryError.h and, of
  /// the largest scalar, LargestScalarError.h; of isosurfaces 0. Infinite if the mesh is so small
  /// or so large that distances in it leave the range of single precision. worldRadius: of the
  /// mesh, world units. Measured once for what it depends on, on a sample of the mesh's rays. After
  /// Prepare.
  double EstimateGeometryError(double worldRadius, const GeometryRounding& rounding);

  /// The same where values are taken from up to shift radii beside the ray, instead of by rounding;
  /// at most 1. Measured once for each doubling of the shift's fourth power.
  double EstimateShiftError(double worldRadius, double shift);

  /// EstimateOrderError of emission and absorption; 0 of other models. Measured once, as above.
  double EstimateOrderError(double worldRadius);

  /// EstimateEightBitErrors of models that are composited cell by cell; 0 of others. Measured once,
  /// as above. Lights are left out.
  EightBitErrors EstimateEightBitErrors(double worldRadius);

  /// EstimateLargestChannel. Measured once, as above.
  double EstimateLargestChannel(double worldRadius);

  /// Pieces on which the function is linear, or one of its runs, that a segment of a ray is cut
  /// into: the mean over a sample of the mesh's rays, at least 1. Measured once, as above.
  double EstimatePieces();

private:
  struct VisibleCellFlags
  {
    std::vector<std::uint8_t> Cells;
    std::int64_t NumberOfTransparent = 0;
  };

  CellValue MakeCellValue(std::size_t cell) const;
  void PreparePlan();
  void PrepareCellValues();
  template <class Real>
  void PreparePoints(CacheStamp& stamp);
  void PrepareComponentRows();
  void PrepareVisibleCells();
  void PrepareVisibleTables();
  double GetLargestMappedScalar() const;
  double EstimateRounding(
    double worldRadius, const GeometryRounding& rounding, Cached<double>& result);

  Cached<IntegrationPlan> Plan;
  Cached<std::vector<CellValue>> CellValues;
  CacheStamp SinglePoints, DoublePoints; ///< of the mesh's tables
  Cached<std::vector<ComponentRow>> ComponentRows;
  Cached<VisibleCellFlags> Visible;
  WalkTables VisibleTables; ///< empty: rays are walked through all cells
  CacheStamp VisibleTopology;
  Cached<double> GeometryError;
  Cached<double> ShiftError;
  Cached<double> OrderError;
  Cached<EightBitErrors> EightBits;
  Cached<double> LargestChannel;
  Cached<double> Pieces;                  ///< of a segment
  std::uint64_t VisiblePointsVersion = 0; ///< of the mesh that the boxes of VisibleTables are of
};

} // namespace tetralux

#endif
