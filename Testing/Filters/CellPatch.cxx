// SPDX-License-Identifier: BSD-3-Clause
#include "CellPatch.h"

#include "Mesh/FaceNeighbors.h"

#include "vtkCell.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace
{

CellPatch::Position Mean(
  const std::vector<CellPatch::Position>& points, const std::vector<int>& ids)
{
  CellPatch::Position mean = { 0, 0, 0 };
  for (int id : ids)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      mean[axis] += points[id][axis] / static_cast<double>(ids.size());
    }
  }
  return mean;
}

/// Rounds a node to the grid of PartsOfUnit, so that means that are taken in another order agree.
CellPatch::Position Snap(CellPatch::Position x)
{
  for (double& value : x)
  {
    value = std::round(value * CellPatch::PartsOfUnit) / CellPatch::PartsOfUnit;
  }
  return x;
}

} // namespace

std::int64_t CellPatch::AddPoint(const Position& x)
{
  const auto inserted =
    this->IdOfPosition.emplace(Snap(x), static_cast<std::int64_t>(this->Points.size()));
  if (inserted.second)
  {
    this->Points.push_back(Snap(x));
  }
  return inserted.first->second;
}

void CellPatch::AddCell(int type, const std::vector<Position>& corners)
{
  if (type == VTK_CONVEX_POINT_SET)
  {
    CellEntry entry = { type, {}, {} };
    for (const Position& corner : corners)
    {
      entry.Ids.push_back(this->AddPoint(corner));
    }
    this->Cells.push_back(entry);
    return;
  }
  auto cell = vtkSmartPointer<vtkCell>::Take(vtkGenericCell::InstantiateCell(type));
  const auto numberOfNodes = static_cast<int>(cell->GetNumberOfPoints());
  const auto numberOfCorners = static_cast<int>(corners.size());
  for (int i = 0; i < numberOfNodes; ++i)
  {
    cell->GetPointIds()->SetId(i, i);
  }

  // First the middle, then faces, then edges, each overwriting what lies on its boundary.
  std::vector<int> all(numberOfCorners);
  std::iota(all.begin(), all.end(), 0);
  std::vector<Position> nodes(numberOfNodes, Mean(corners, all));
  std::copy(corners.begin(), corners.end(), nodes.begin());
  const auto place = [&](vtkCell* part)
  {
    std::vector<int> partCorners;
    for (vtkIdType id : *part->GetPointIds())
    {
      if (id < numberOfCorners)
      {
        partCorners.push_back(static_cast<int>(id));
      }
    }
    for (vtkIdType id : *part->GetPointIds())
    {
      if (id >= numberOfCorners)
      {
        nodes[id] = Mean(corners, partCorners);
      }
    }
  };
  for (int i = 0; i < cell->GetNumberOfFaces(); ++i)
  {
    place(cell->GetFace(i));
  }
  for (int i = 0; i < cell->GetNumberOfEdges(); ++i)
  {
    place(cell->GetEdge(i));
  }

  CellEntry entry = { type, {}, {} };
  for (const Position& node : nodes)
  {
    entry.Ids.push_back(this->AddPoint(node));
  }
  this->Cells.push_back(entry);
}

void CellPatch::AddPolyhedron(
  const std::vector<Position>& points, const std::vector<std::vector<int>>& faces)
{
  CellEntry entry = { VTK_POLYHEDRON, {}, {} };
  for (const Position& point : points)
  {
    entry.Ids.push_back(this->AddPoint(point));
  }
  for (const std::vector<int>& face : faces)
  {
    entry.Faces.emplace_back();
    for (int point : face)
    {
      entry.Faces.back().push_back(entry.Ids[point]);
    }
  }
  this->Cells.push_back(entry);
}

void CellPatch::AddBoxes(int type, int x, int y, int z, int countX, int countY, int countZ)
{
  const std::vector<std::vector<int>> faces = { { 0, 4, 7, 3 }, { 1, 2, 6, 5 }, { 0, 1, 5, 4 },
    { 3, 7, 6, 2 }, { 0, 3, 2, 1 }, { 4, 5, 6, 7 } };
  for (int k = z; k < z + countZ; ++k)
  {
    for (int j = y; j < y + countY; ++j)
    {
      for (int i = x; i < x + countX; ++i)
      {
        std::vector<Position> corners;
        for (const std::array<int, 3>& c :
          std::vector<std::array<int, 3>>{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 },
            { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } })
        {
          corners.push_back({ double(i + c[0]), double(j + c[1]), double(k + c[2]) });
        }
        const auto pick = [&](const std::vector<int>& ids)
        {
          std::vector<Position> picked;
          for (int id : ids)
          {
            picked.push_back(corners[id]);
          }
          return picked;
        };
        const Position center = Mean(corners, { 0, 1, 2, 3, 4, 5, 6, 7 });
        switch (type)
        {
          case VTK_TETRA:
          case VTK_QUADRATIC_TETRA:
            // The diagonal of a face from its corner with the smallest coordinates, on both sides.
            for (const std::vector<int>& face : faces)
            {
              std::vector<int> ring = face;
              std::rotate(ring.begin(),
                std::min_element(
                  ring.begin(), ring.end(), [&](int a, int b) { return corners[a] < corners[b]; }),
                ring.end());
              for (int half : { 1, 2 })
              {
                std::vector<Position> tet = pick({ ring[0], ring[half + 1], ring[half] });
                tet.push_back(center);
                this->AddCell(type, tet);
              }
            }
            break;
          case VTK_PYRAMID:
          case VTK_QUADRATIC_PYRAMID:
          case VTK_TRIQUADRATIC_PYRAMID:
            for (const std::vector<int>& face : faces)
            {
              std::vector<Position> pyramid = pick({ face[0], face[3], face[2], face[1] });
              pyramid.push_back(center);
              this->AddCell(type, pyramid);
            }
            break;
          case VTK_WEDGE:
          case VTK_QUADRATIC_WEDGE:
          case VTK_QUADRATIC_LINEAR_WEDGE:
          case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
            this->AddCell(type, pick({ 0, 3, 1, 4, 7, 5 }));
            this->AddCell(type, pick({ 2, 1, 3, 6, 5, 7 }));
            break;
          case VTK_VOXEL:
            this->AddCell(type, pick({ 0, 1, 3, 2, 4, 5, 7, 6 }));
            break;
          case VTK_POLYHEDRON:
            this->AddPolyhedron(corners, faces);
            break;
          default:
            this->AddCell(type, corners);
        }
      }
    }
  }
}

vtkSmartPointer<vtkUnstructuredGrid> CellPatch::MakeGrid(
  std::uint64_t seed, const std::function<Position(const Position&)>& map) const
{
  std::mt19937_64 random(seed);
  std::vector<vtkIdType> newId(this->Points.size());
  std::iota(newId.begin(), newId.end(), 0);
  std::shuffle(newId.begin(), newId.end(), random);

  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(this->Points.size()));
  vtkNew<vtkDoubleArray> unmapped;
  unmapped->SetName("Unmapped");
  unmapped->SetNumberOfComponents(3);
  unmapped->SetNumberOfTuples(static_cast<vtkIdType>(this->Points.size()));
  for (std::size_t i = 0; i < this->Points.size(); ++i)
  {
    points->SetPoint(newId[i], map(this->Points[i]).data());
    unmapped->SetTuple(newId[i], this->Points[i].data());
  }

  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(unmapped);
  for (const CellEntry& cell : this->Cells)
  {
    std::vector<vtkIdType> ids;
    if (cell.Type == VTK_POLYHEDRON)
    {
      for (const std::vector<std::int64_t>& face : cell.Faces)
      {
        ids.push_back(static_cast<vtkIdType>(face.size()));
        for (std::int64_t id : face)
        {
          ids.push_back(newId[id]);
        }
      }
      grid->InsertNextCell(VTK_POLYHEDRON, static_cast<vtkIdType>(cell.Faces.size()), ids.data());
      continue;
    }
    for (std::int64_t id : cell.Ids)
    {
      ids.push_back(newId[id]);
    }
    grid->InsertNextCell(cell.Type, static_cast<vtkIdType>(ids.size()), ids.data());
  }
  return grid;
}

CellPatch::Position MapAffine(const CellPatch::Position& x)
{
  return { 100 + 1.1 * x[0] + 0.2 * x[1] - 0.1 * x[2], 0.3 * x[0] + 0.9 * x[1] + 0.15 * x[2],
    -0.2 * x[0] + 0.1 * x[1] + 0.7 * x[2] - 20 };
}

double GetAffineDeterminant()
{
  return 1.1 * (0.9 * 0.7 - 0.15 * 0.1) - 0.2 * (0.3 * 0.7 + 0.15 * 0.2) -
    0.1 * (0.3 * 0.1 + 0.9 * 0.2);
}

CellPatch::Position MapWarped(const CellPatch::Position& x)
{
  return { x[0] + 0.08 * std::sin(3 * x[1] * x[2]), x[1] + 0.08 * std::cos(2 * x[0] * x[2]),
    x[2] + 0.08 * std::sin(2.5 * x[0] * x[1]) };
}

double GetVolume(const tetralux::TetrahedralMesh& mesh, std::int64_t* notPositive)
{
  double total = 0;
  for (std::size_t i = 0; i < mesh.GetNumberOfCells(); ++i)
  {
    double edge[3][3];
    const double* origin = &mesh.Points[3 * mesh.Cells[4 * i]];
    for (int corner = 0; corner < 3; ++corner)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        edge[corner][axis] = mesh.Points[3 * mesh.Cells[4 * i + 1 + corner] + axis] - origin[axis];
      }
    }
    double volume = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int next = (axis + 1) % 3;
      const int last = (axis + 2) % 3;
      volume += edge[2][axis] * (edge[0][next] * edge[1][last] - edge[0][last] * edge[1][next]) / 6;
    }
    total += volume;
    if (notPositive && !(volume > 0))
    {
      ++*notPositive;
    }
  }
  return total;
}

std::string FindConformityProblem(const tetralux::TetrahedralMesh& mesh,
  const std::function<CellPatch::Position(std::int64_t)>& toBox, const std::array<int, 3>& size)
{
  const tetralux::FaceNeighbors faces =
    tetralux::FindFaceNeighbors(mesh.Cells, mesh.GetNumberOfPoints());
  if (faces.NumberOfNonManifoldFaces != 0)
  {
    return std::to_string(faces.NumberOfNonManifoldFaces) + " faces are shared by three cells";
  }
  if (faces.NumberOfComponents != 1)
  {
    return std::to_string(faces.NumberOfComponents) + " components";
  }
  for (std::int32_t face : faces.BoundaryFaces)
  {
    // Half of what nodes of different places are apart; rounding is far below.
    constexpr double nearPlane = 0.5 / CellPatch::PartsOfUnit;
    bool inPlane[3][2] = { { true, true }, { true, true }, { true, true } };
    for (int corner = 0; corner < 4; ++corner)
    {
      if (corner != face % 4)
      {
        const CellPatch::Position x = toBox(mesh.Cells[face / 4 * 4 + corner]);
        for (int axis = 0; axis < 3; ++axis)
        {
          inPlane[axis][0] = inPlane[axis][0] && std::abs(x[axis]) < nearPlane;
          inPlane[axis][1] = inPlane[axis][1] && std::abs(x[axis] - size[axis]) < nearPlane;
        }
      }
    }
    if (!std::any_of(&inPlane[0][0], &inPlane[0][0] + 6, [](bool in) { return in; }))
    {
      return "face " + std::to_string(face % 4) + " of tetrahedron " + std::to_string(face / 4) +
        " is on the boundary, but lies inside";
    }
  }
  return {};
}
