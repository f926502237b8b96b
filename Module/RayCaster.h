// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayCaster_h
#define tetralux_RayCaster_h

#include "IntegrationPlan.h"
#include "IntervalTable.h"
#include "OpticalModel.h"
#include "PreIntegrationTable.h"
#include "RayGrid.h"
#include "RayLimits.h"
#include "Span.h"
#include "TetraluxCoreModule.h"
#include "TransferFunction.h"
#include "WalkMesh.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tetralux
{

/// Arithmetic of the geometry along a ray. Integrals are always evaluated in single precision,
/// whose error there is SegmentWeightError.
enum class Precision
{
  Automatic, ///< single where EstimateGeometryError stays within the error that is asked for
  Single,    ///< single; double all the same where the mesh's world radius is beyond its range
  Double
};

/// How rays that left the mesh find where they enter it again.
enum class Reentry
{
  Automatic, ///< whichever is faster, see RayCaster::Cast
  Boundary,  ///< by a hierarchy over the boundary's faces
  Imaginary  ///< through imaginary cells between the mesh and its hull (Weiler et al. 2003, section
             ///< 3.4); by the boundary where the mesh can't be made convex
};

struct RayCastOptions
{
  /// Largest error of a colour channel or of the opacity that is aimed at, 0..1. Rays end early
  /// where what is behind could not change a channel by half of it.
  double MaximumError = 1e-4;

  Precision Arithmetic = Precision::Automatic;

  /// How surfaces of OpticalModel::Isosurfaces look: flat, or shaded by lights.
  bool Shaded = false;
  std::vector<Light> Lights;
  Material Surface;

  Reentry ReentryBy = Reentry::Automatic;

  int NumberOfThreads = 0; ///< 0: as many as OpenMP offers

  /// Use the kernels that run on any processor even where there are faster ones; the pictures
  /// differ by rounding. For tests of those kernels.
  bool PortableKernels = false;

  /// Called every few milliseconds, by the calling thread only, with the share that is done, 0..1;
  /// returns false to abort. The last call is with 1, when nothing is left to abort. May be empty.
  std::function<bool(double)> Progress;
};

struct RayCastStatistics
{
  bool Aborted = false;
  bool DoublePrecision = false;
  std::string InstructionSet;
  /// How rays were integrated: "closed form", "table", "optical depth", "emission", "largest scalar"
  /// or "isosurfaces".
  std::string Integration;
  int NumberOfThreads = 0;
  std::int64_t Rays = 0;
  std::int64_t Segments = 0;         ///< cells walked through, over all rays
  std::int64_t Paths = 0;            ///< entries into the mesh, over all rays
  bool ImaginaryCells = false;       ///< whether rays went through imaginary cells
  std::int64_t TransparentCells = 0; ///< left out of the walk; 0 where that would not pay
  double LaneUse = 0;                ///< share of vector lanes that carried a ray, 0..1
  double ErrorEstimate = 0;          ///< sum of the five below
  double TerminationError = 0;       ///< at most, by ending rays early
  double IntegralError = 0;          ///< at most, by the weights of segments
  double SummationError = 0;         ///< estimated, by adding segments up; of a path of mean length
  double TableError = 0;             ///< estimated, by interpolation in a table
  double GeometryError = 0;          ///< estimated, by rounding coordinates and scalars; not that
                                     ///< of pixels where a ray grazes a surface or a step
};

/// Cell-to-cell ray casting on the CPU (Garrity 1990; Weiler et al. 2003): packets of eight rays,
/// tiles of the image over OpenMP threads. The picture does not depend on the number of threads.
/// What is set stays valid until it is set again; nothing is rebuilt by Cast.
class TETRALUXCORE_EXPORT RayCaster
{
public:
  /// The mesh; scalars must be set after it.
  void SetMesh(std::shared_ptr<WalkMesh> mesh);
  const WalkMesh* GetMesh() const { return this->Mesh.get(); }

  /// How segments are integrated for the present model, function and scalars, table aside.
  const IntegrationPlan& GetPlan();

  /// One scalar for each point, or for each cell, of WalkMesh::GetMesh(); any values, those that
  /// are not finite make the cells that touch them contribute nothing. Throws
  /// std::invalid_argument where their number is wrong.
  ///@{
  void SetPointScalars(std::vector<double> scalars);
  void SetCellScalars(std::vector<double> scalars);
  ///@}

  /// Least and largest finite scalar; 0 and 0 where there is none.
  const double* GetScalarRange() const { return this->ScalarRange; }

  bool HasCellScalars() const { return this->ScalarsOfCells; }

  /// Cells that touch a scalar which is not finite.
  std::int64_t GetNumberOfBlankCells() const { return this->NumberOfBlankCells; }

  /// What rays gather; at first emission and absorption.
  void SetOpticalModel(OpticalModel model);

  /// Throws std::invalid_argument as MakeIntervalTable does. Isosurfaces need none.
  void SetTransferFunction(const TransferFunction& function);

  /// A table to look segments up in, of the present transfer function, instead of the closed form:
  /// for OpticalModel::EmissionAbsorption of scalars at points; a constant colour needs none. Texels
  /// are read in single precision, whatever they are stored in. pictureError: what pictures by it
  /// are expected to be wrong by. nullptr: none, as it is at first and after SetTransferFunction.
  void SetTable(std::shared_ptr<const PreIntegrationTable> table, double pictureError);

  /// What OpticalModel::Isosurfaces shows, in any order; values that are repeated count once, the
  /// last one. Throws std::invalid_argument where a value or a colour is not finite.
  void SetIsosurfaces(std::vector<Isosurface> surfaces);

  /// Casts all rays of the grid. Throws std::invalid_argument where something is missing, or where
  /// isosurfaces are asked for of scalars at cells. colors: four floats a pixel, premultiplied red, green, blue and
  /// opacity; depths: one float a pixel, the distance along the ray to the first contribution in
  /// world units, -1 where there is none; both lower row first. After an abort they are incomplete.
  RayCastStatistics Cast(const RayGrid& grid, const RayLimits& limits,
    const RayCastOptions& options, Span<float> colors, Span<float> depths);

  /// Estimated error of a channel by single precision coordinates and scalars: their rounding moves
  /// every face along a ray by about meshRadius 2^-23 and every scalar by scalar 2^-24, which
  /// matters as far as the attenuation changes over that. worldRadius: radius of the mesh in world
  /// units; largestScalar: as mapped by the table, at least 1.
  static double EstimateGeometryError(
    const IntervalTable& table, double worldRadius, double largestScalar);

private:
  /// Scalars in the tables are x = (s - Offset) / Scale.
  struct ScalarMap
  {
    double Offset = 0;
    double Scale = 0; ///< 0: the table has no scalars yet
    bool operator==(const ScalarMap& other) const
    {
      return this->Offset == other.Offset && this->Scale == other.Scale;
    }
  };

  void SetScalars(std::vector<double> scalars, bool ofCells);
  void CountBlankCells();
  ScalarMap GetScalarMap() const;
  double GetLargestMappedScalar() const;
  double EstimateGeometryError(double worldRadius) const;
  void UpdatePointScalars(bool doublePrecision);
  void UpdateCellValues();
  void UpdateVisibleTables();
  const WalkTables& ChooseTables(const RayCastOptions& options, RayCastStatistics& statistics);

  std::shared_ptr<WalkMesh> Mesh;
  std::vector<double> Scalars;
  bool ScalarsOfCells = false;
  double ScalarRange[2] = { 0, 0 }; ///< of the finite ones
  std::int64_t NumberOfBlankCells = 0;
  OpticalModel Model = OpticalModel::EmissionAbsorption;
  TransferFunction Function;
  IntervalTable Table;
  IntegrationPlan Plan; ///< of model, function and scalars
  std::shared_ptr<const PreIntegrationTable> SegmentTable;
  std::vector<float> Texels; ///< of SegmentTable, where it has not the format of the kernels
  double SegmentTableError = 0;
  std::vector<Isosurface> Surfaces; ///< ascending in value
  std::vector<CellValue> CellValues;
  WalkTables VisibleTables; ///< empty where rays are walked through all cells
  std::int64_t NumberOfTransparentCells = 0;
  ScalarMap FloatScalars, DoubleScalars; ///< of the mesh's tables
  bool CellValuesValid = false;
  bool PlanValid = false;
  bool VisibleTablesValid = false;
};

} // namespace tetralux

#endif
