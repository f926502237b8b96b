// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/PointExtraction.h"

#include "Intake/CellKind.h"
#include "Intake/DataSetBlocks.h"
#include "Intake/FacetedCells.h"
#include "Intake/PlainCopies.h"

#include "vtkDataSet.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <limits>

namespace tetralux
{
namespace
{

/// Roundings that the coordinates of a point may have behind them: an angle that wraps around, its
/// sine, and the product with a radius.
constexpr double Roundings = 4;

/// Points that one task of vtkSMPTools takes.
constexpr vtkIdType Grain = 16384;

} // namespace

std::vector<double> ExtractPoints(vtkDataObject* input, const TetrahedralMesh& mesh)
{
  const std::vector<DataSetBlock> blocks = CollectDataSets(input);
  const std::int64_t count =
    blocks.empty() ? 0 : blocks.back().FirstPoint + blocks.back().DataSet->GetNumberOfPoints();
  std::vector<double> given(3 * count);
  for (const DataSetBlock& block : blocks)
  {
    CopyPoints(block.DataSet, given.data() + 3 * block.FirstPoint);
  }
  if (mesh.OriginalPoints.empty())
  {
    return given;
  }
  std::vector<double> points(mesh.Points.size());
  vtkSMPTools::For(0, static_cast<vtkIdType>(mesh.GetNumberOfPoints()), Grain,
    [&](vtkIdType begin, vtkIdType end)
    {
      const auto& added = mesh.AddedPoints;
      for (vtkIdType i = begin; i < end; ++i)
      {
        const std::int64_t original = mesh.OriginalPoints[i];
        if (original >= 0)
        {
          std::copy_n(&given[3 * original], 3, &points[3 * i]);
          continue;
        }
        for (std::int64_t j = added.Offsets[-1 - original]; j < added.Offsets[-original]; ++j)
        {
          for (int axis = 0; axis < 3; ++axis)
          {
            points[3 * i + axis] += added.Weights[j] * given[3 * added.Sources[j] + axis];
          }
        }
      }
    });
  return points;
}

bool DependsOnPoints(const TetrahedraIntakeReport& report)
{
  return std::any_of(report.CellsByType.begin(), report.CellsByType.end(),
    [](const auto& entry)
    {
      const CellKind kind = ClassifyCellType(entry.first);
      return kind == CellKind::Polyhedron || kind == CellKind::ConvexPointSet ||
        (kind == CellKind::Faceted && GetFacetedCellType(entry.first)->ApexAtCorner);
    });
}

double GetPointTolerance(vtkDataObject* input)
{
  double epsilon = std::numeric_limits<double>::epsilon();
  for (const DataSetBlock& block : CollectDataSets(input))
  {
    auto* grid = vtkPointSet::SafeDownCast(block.DataSet);
    if (grid && grid->GetPoints() && grid->GetPoints()->GetDataType() == VTK_FLOAT)
    {
      epsilon = std::numeric_limits<float>::epsilon();
    }
  }
  return Roundings * epsilon;
}

} // namespace tetralux
