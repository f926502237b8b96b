// SPDX-License-Identifier: BSD-3-Clause
#include "MeshParts.h"

#include <map>
#include <numeric>
#include <utility>

namespace tetralux
{

void AddMesh(TetrahedralMesh& mesh, const TetrahedralMesh& other)
{
  const auto first = static_cast<std::int32_t>(mesh.GetNumberOfPoints());
  mesh.Points.insert(mesh.Points.end(), other.Points.begin(), other.Points.end());
  for (const std::int32_t point : other.Cells)
  {
    mesh.Cells.push_back(point + first);
  }
}

TetrahedralMesh SeparateParts(
  const TetrahedralMesh& mesh, const std::vector<std::int64_t>& partOfCell)
{
  TetrahedralMesh separated;
  std::map<std::pair<std::int64_t, std::int32_t>, std::int32_t> ids;
  for (std::size_t corner = 0; corner < mesh.Cells.size(); ++corner)
  {
    const std::int32_t point = mesh.Cells[corner];
    const auto [place, isNew] =
      ids.try_emplace({ partOfCell[corner / 4], point }, static_cast<std::int32_t>(ids.size()));
    separated.Cells.push_back(place->second);
    if (isNew)
    {
      const double* x = &mesh.Points[3 * static_cast<std::size_t>(point)];
      separated.Points.insert(separated.Points.end(), x, x + 3);
      separated.OriginalPoints.push_back(point);
    }
  }
  return separated;
}

TetrahedralMesh SeparateCells(const TetrahedralMesh& mesh)
{
  std::vector<std::int64_t> parts(mesh.GetNumberOfCells());
  std::iota(parts.begin(), parts.end(), 0);
  return SeparateParts(mesh, parts);
}

} // namespace tetralux
