// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LeftOutCells_h
#define tetralux_LeftOutCells_h

#include "Intake/IntakeReport.h"
#include "Mesh/MeshCleaning.h"
#include "TetraluxFiltersModule.h"

#include <string>
#include <vector>

namespace tetralux
{

/// Cells that were left out for one reason although they should fill space. Ghost and blanked cells
/// and those below three dimensions are not among them: they are left out as they should be.
struct LeftOutCells
{
  std::string Reason; ///< as "cells with points that do not exist"
  std::string Count;  ///< a number, or numbers with names of cell types
};

/// The reasons that apply to an input's cells and to the tetrahedra that were made of them.
TETRALUXFILTERS_EXPORT std::vector<LeftOutCells> ListLeftOutCells(
  const TetrahedraIntakeReport& report, const RemovedCells& removed);

/// The same as one line, "left out: cells with points that do not exist: 3; ..."; empty where
/// nothing was left out.
TETRALUXFILTERS_EXPORT std::string DescribeLeftOutCells(
  const TetrahedraIntakeReport& report, const RemovedCells& removed);

/// What is there, but not right, as one line; empty where there is nothing.
TETRALUXFILTERS_EXPORT std::string DescribeFoldedCells(const TetrahedraIntakeReport& report);

} // namespace tetralux

#endif
