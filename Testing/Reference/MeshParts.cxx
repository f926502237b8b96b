// SPDX-License-Identifier: BSD-3-Clause
#include "MeshParts.h"

#include <array>
#include <map>
#include <numeric>
#include <random>
#include <utility>

namespace tetralux
{
namespace
{

using Place = std::array<double, 3>;

/// Cubes that share the points at their corners.
class CubeMesh
{
public:
  void AddCube(const Place& lower, double edge)
  {
    // Around the diagonal from corner 0 to 7: a corner has a bit for each axis.
    static constexpr int Tetrahedra[6][4] = { { 0, 1, 3, 7 }, { 0, 1, 5, 7 }, { 0, 2, 3, 7 },
      { 0, 2, 6, 7 }, { 0, 4, 5, 7 }, { 0, 4, 6, 7 } };
    for (const auto& tetrahedron : Tetrahedra)
    {
      for (const int corner : tetrahedron)
      {
        this->Mesh.Cells.push_back(this->GetPoint(GetCorner(lower, edge, corner)));
      }
    }
  }

  void AddEight(const Place& lower, double edge)
  {
    for (int octant = 0; octant < 8; ++octant)
    {
      this->AddCube(GetCorner(lower, edge, octant), edge);
    }
  }

  template <class RandomT>
  void AddTree(const Place& lower, double edge, int depth, RandomT& random)
  {
    if (depth == 0 || random() % 2 == 0)
    {
      this->AddCube(lower, edge);
      return;
    }
    for (int octant = 0; octant < 8; ++octant)
    {
      this->AddTree(GetCorner(lower, edge / 2, octant), edge / 2, depth - 1, random);
    }
  }

  static Place GetCorner(const Place& lower, double edge, int corner)
  {
    return { lower[0] + (corner & 1 ? edge : 0), lower[1] + (corner & 2 ? edge : 0),
      lower[2] + (corner & 4 ? edge : 0) };
  }

  TetrahedralMesh Mesh;

private:
  std::int32_t GetPoint(const Place& x)
  {
    const auto [place, isNew] =
      this->Ids.try_emplace(x, static_cast<std::int32_t>(this->Ids.size()));
    if (isNew)
    {
      this->Mesh.Points.insert(this->Mesh.Points.end(), x.begin(), x.end());
    }
    return place->second;
  }

  std::map<Place, std::int32_t> Ids;
};

} // namespace

void AddMesh(TetrahedralMesh& mesh, const TetrahedralMesh& other)
{
  const auto first = static_cast<std::int32_t>(mesh.GetNumberOfPoints());
  mesh.Points.insert(mesh.Points.end(), other.Points.begin(), other.Points.end());
  for (const std::int32_t point : other.Cells)
  {
    mesh.Cells.push_back(point + first);
  }
  mesh.OriginalPoints.clear();
  mesh.OriginalCells.clear();
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

TetrahedralMesh MakeOctree(int depth, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  CubeMesh cubes;
  for (int octant = 0; octant < 8; ++octant) // never one cube only
  {
    cubes.AddTree(CubeMesh::GetCorner({ 0, 0, 0 }, 0.5, octant), 0.5, depth - 1, random);
  }
  return cubes.Mesh;
}

TetrahedralMesh MakeNineCubes()
{
  CubeMesh cubes;
  cubes.AddCube({ 0, 0, 0 }, 0.5);
  cubes.AddEight({ 0.5, 0, 0 }, 0.25);
  return cubes.Mesh;
}

} // namespace tetralux
