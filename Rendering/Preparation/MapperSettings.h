// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MapperSettings_h
#define tetralux_MapperSettings_h

#include "Frame/FrameSettings.h"
#include "Intake/ScalarExtraction.h"
#include "Optics/OpticalModel.h"
#include "PreIntegration/PreIntegrationTable.h"

#include <cstddef>
#include <optional>

namespace tetralux
{

/// Whether segments are looked up in a table.
enum class TableUse
{
  Automatic, ///< if it is faster, and right enough
  Never,
  Always
};

/// What a table has to be like. What has no value, and a size of 0, is chosen by MaximumError.
struct TableWishes
{
  TableUse Use = TableUse::Automatic;
  int ScalarSize = 0;
  int LengthSize = 0;
  std::optional<LengthScale> Scale;
  std::optional<ScalarAxis> Axis;
  std::optional<TexelFormat> Format;
  std::size_t MaximumBytes = std::size_t{ 64 } << 20;
};

/// Whether points at the same place are taken as one.
enum class PointMerging
{
  Never,
  Always,   ///< where their scalars agree
  Automatic ///< all of them, if the cells then fit together and all scalars agree
};

/// What a mapper's properties say, as plain values: preparation and frames know no mapper class.
struct MapperSettings
{
  double MaximumError = 1e-4; ///< of a channel, 0..1
  OpticalModel Model = OpticalModel::EmissionAbsorption;
  ScalarSelection Scalars;
  bool DrawsComponents = false;          ///< several of an array, with composite blending
  std::optional<ScalarSelection> Colors; ///< what isosurfaces are coloured by, if not by Scalars
  PointMerging Merging = PointMerging::Automatic;
  TableWishes Table;
  FrameSettings Frame;
};

} // namespace tetralux

#endif
