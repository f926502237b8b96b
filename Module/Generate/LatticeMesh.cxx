// SPDX-License-Identifier: BSD-3-Clause
#include "Generate/LatticeMesh.h"

#include "Mesh/CellSplit.h"
#include "Mesh/MeshLimits.h"

#include <cstdint>
#include <sstream>
#include <stdexcept>

namespace tetralux
{
namespace
{

/// The corners of a cell in VTK's order.
constexpr int Corners[8][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 1 },
  { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } };

/// The points of a lattice in the order of their indices, i running fastest.
class LatticePoints
{
public:
  explicit LatticePoints(const Lattice& lattice)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Size[axis] = lattice.Cells[axis] + (lattice.IsPeriodic[axis] ? 0 : 1);
    }
  }

  std::int64_t GetCount() const
  {
    return std::int64_t{ this->Size[0] } * this->Size[1] * this->Size[2];
  }

  std::int64_t GetNumber(int i, int j, int k) const
  {
    return (k % this->Size[2] * std::int64_t{ this->Size[1] } + j % this->Size[1]) * this->Size[0] +
      i % this->Size[0];
  }

  template <class Visit>
  void ForEach(const Visit& visit) const
  {
    for (int k = 0; k < this->Size[2]; ++k)
    {
      for (int j = 0; j < this->Size[1]; ++j)
      {
        for (int i = 0; i < this->Size[0]; ++i)
        {
          visit(i, j, k);
        }
      }
    }
  }

private:
  int Size[3];
};

template <class Visit>
void ForEachKeptCell(const Lattice& lattice, const Visit& visit)
{
  for (int k = 0; k < lattice.Cells[2]; ++k)
  {
    for (int j = 0; j < lattice.Cells[1]; ++j)
    {
      for (int i = 0; i < lattice.Cells[0]; ++i)
      {
        if (!lattice.IsKept || lattice.IsKept(i, j, k))
        {
          visit(i, j, k);
        }
      }
    }
  }
}

} // namespace

//----------------------------------------------------------------------------
void CheckNumberOfTetrahedra(double count)
{
  if (count > static_cast<double>(MaximumCells))
  {
    std::ostringstream message;
    message.precision(0);
    message << std::fixed << "this asks for up to " << count
            << " tetrahedra, but a mesh has at most " << MaximumCells << ": take fewer cells";
    throw std::invalid_argument(message.str());
  }
}

//----------------------------------------------------------------------------
void AddLattice(const Lattice& lattice, TetrahedralMesh& mesh)
{
  bool hasParity = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    hasParity = hasParity && !(lattice.IsPeriodic[axis] && lattice.Cells[axis] % 2 != 0);
  }
  const int tetrahedraPerCell = hasParity ? 5 : 6;
  const double numberOfLatticeCells =
    static_cast<double>(lattice.Cells[0]) * lattice.Cells[1] * lattice.Cells[2];
  CheckNumberOfTetrahedra(
    static_cast<double>(mesh.GetNumberOfCells()) + tetrahedraPerCell * numberOfLatticeCells);

  // Only points of kept cells get an id.
  const LatticePoints latticePoints(lattice);
  std::vector<std::int32_t> ids(latticePoints.GetCount(), -1);
  ForEachKeptCell(lattice,
    [&](int i, int j, int k)
    {
      for (const auto& corner : Corners)
      {
        ids[latticePoints.GetNumber(i + corner[0], j + corner[1], k + corner[2])] = 0;
      }
    });
  latticePoints.ForEach(
    [&](int i, int j, int k)
    {
      std::int32_t& id = ids[latticePoints.GetNumber(i, j, k)];
      if (id == 0)
      {
        id = static_cast<std::int32_t>(mesh.GetNumberOfPoints());
        const std::array<double, 3> position = lattice.Place(i, j, k);
        mesh.Points.insert(mesh.Points.end(), position.begin(), position.end());
      }
    });

  ForEachKeptCell(lattice,
    [&](int i, int j, int k)
    {
      std::int64_t corners[8];
      for (int corner = 0; corner < 8; ++corner)
      {
        const int(&step)[3] = Corners[corner];
        corners[corner] = ids[latticePoints.GetNumber(i + step[0], j + step[1], k + step[2])];
      }
      std::int64_t tets[6 * 4];
      const int count = hasParity ? SplitStructuredHexahedron(corners, (i + j + k) % 2 != 0, tets)
                                  : SplitHexahedron(corners, tets);
      mesh.Cells.insert(mesh.Cells.end(), tets, tets + 4 * count);
    });
}

} // namespace tetralux
