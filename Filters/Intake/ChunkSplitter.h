// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ChunkSplitter_h
#define tetralux_ChunkSplitter_h

#include "Intake/CellKind.h"
#include "Intake/CellSources.h"
#include "Intake/ConvexFaces.h"
#include "Intake/DataSetBlocks.h"
#include "Intake/FacetedCells.h"
#include "Intake/IntakeChunk.h"
#include "Mesh/CellSplit.h"

#include "vtkDataSetAttributes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace tetralux
{

/// What the tasks of a block have in common.
struct BlockContext
{
  DataSetBlock Block;
  std::int64_t NumberOfPoints = 0;
  const double* Coordinates = nullptr; ///< of the whole mesh, by its ids
  const unsigned char* CellGhosts = nullptr;
  const unsigned char* PointGhosts = nullptr;
  bool HasRationalWeights = false;           ///< whether Bezier cells are rational ones
  const std::int32_t* FirstPoints = nullptr; ///< for each point the one that is taken; none: itself
  bool Alternates = true; ///< whether cells of structured grids are cut by their parity
};

/// Share of a tetrahedron's volume below which a point lies on a face of it: above the rounding of
/// coordinates in single precision.
constexpr double OnFace = 1e-6;

/// Splits the cells of one chunk.
template <class SourceT>
class ChunkSplitter
{
public:
  ChunkSplitter(const SourceT& source, const BlockContext& context, IntakeChunk& chunk)
    : Source(source)
    , Context(context)
    , Output(chunk)
  {
  }

  void Split(vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType cellId = begin; cellId < end; ++cellId)
    {
      this->SplitCell(cellId);
    }
  }

private:
  void SplitCell(vtkIdType cellId)
  {
    this->Source.GetCell(cellId, this->Current);
    std::vector<std::int64_t>& points = this->Current.Points;
    const int givenType = this->Current.Type & 0xff; // VTK keeps types in a byte
    const int type = GetLinearType(givenType, points.size(), this->Context.HasRationalWeights);
    ++this->Output.CellsByType[givenType];

    const unsigned char ghost = this->Context.CellGhosts ? this->Context.CellGhosts[cellId] : 0;
    if (ghost & vtkDataSetAttributes::DUPLICATECELL)
    {
      ++this->Output.GhostCells;
      return;
    }
    if (ghost & (vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL))
    {
      ++this->Output.BlankedCells;
      return;
    }

    const CellKind kind = ClassifyCellType(type);
    if (kind == CellKind::LowerDimensional)
    {
      ++this->Output.LowerDimensionalCells;
      return;
    }
    if (kind == CellKind::Unsupported)
    {
      ++this->Output.SkippedByType[type];
      return;
    }

    this->Faces.Clear();
    bool valid = true;
    if (kind == CellKind::Polyhedron)
    {
      this->Source.GetFaces(cellId,
        [&](const vtkIdType* ids, vtkIdType size)
        {
          this->Polygon.assign(ids, ids + size);
          valid = valid && this->MakeGlobal(this->Polygon);
          if (valid)
          {
            this->Merge(this->Polygon);
            this->Faces.AddPolygon(
              this->Polygon.data(), this->Polygon.size(), this->Context.Coordinates);
          }
        });
    }
    if (!valid || points.size() < GetRequiredPoints(kind, type) || !this->MakeGlobal(points))
    {
      ++this->Output.InvalidCells;
      return;
    }
    if (this->Context.PointGhosts &&
      std::any_of(points.begin(), points.end(),
        [this](std::int64_t point)
        {
          return this->Context.PointGhosts[point - this->Context.Block.FirstPoint] &
            vtkDataSetAttributes::HIDDENPOINT;
        }))
    {
      ++this->Output.BlankedCells;
      return;
    }

    const bool repeatsPoint = kind == CellKind::Tetrahedron && RepeatsPoint(points.data());
    this->Merge(points);
    if (kind == CellKind::Wedge && IsTurnedWedge(givenType))
    {
      std::swap(points[1], points[2]);
      std::swap(points[4], points[5]);
    }
    this->Tets.clear();
    this->SplitPoints(kind, type);
    const std::size_t before = this->Output.Parents.size();
    for (std::size_t i = 0; i < this->Tets.size(); i += 4)
    {
      const std::int64_t* t = &this->Tets[i];
      // A tetrahedron with a repeated point is kept as it is: a defect of the mesh, for others to
      // count. In a larger cell it is the missing part of a collapsed cell.
      if (repeatsPoint || !RepeatsPoint(t))
      {
        this->Output.Tetrahedra.insert(this->Output.Tetrahedra.end(), t, t + 4);
        this->Output.Parents.push_back(cellId);
      }
    }
    if (this->Output.Parents.size() == before)
    {
      ++this->Output.InvalidCells;
    }
  }

  /// From ids within the block to those of the mesh; false where one does not exist.
  bool MakeGlobal(std::vector<std::int64_t>& points) const
  {
    for (std::int64_t& point : points)
    {
      if (point < 0 || point >= this->Context.NumberOfPoints)
      {
        return false;
      }
      point += this->Context.Block.FirstPoint;
    }
    return true;
  }

  /// From points that coincide to the one that is taken.
  void Merge(std::vector<std::int64_t>& points) const
  {
    if (this->Context.FirstPoints)
    {
      for (std::int64_t& point : points)
      {
        point = this->Context.FirstPoints[point];
      }
    }
  }

  static bool RepeatsPoint(const std::int64_t* t)
  {
    return t[0] == t[1] || t[0] == t[2] || t[0] == t[3] || t[1] == t[2] || t[1] == t[3] ||
      t[2] == t[3];
  }

  void SplitPoints(CellKind kind, int type)
  {
    std::vector<std::int64_t>& points = this->Current.Points;
    std::int64_t tets[6 * 4];
    int count = 0;
    switch (kind)
    {
      case CellKind::Tetrahedron:
        this->Tets.assign(points.begin(), points.begin() + 4);
        return;
      case CellKind::Pyramid:
        count = SplitPyramid(points.data(), tets);
        break;
      case CellKind::Wedge:
        count = SplitWedge(points.data(), tets);
        break;
      case CellKind::Voxel:
      case CellKind::Hexahedron:
        if (this->Current.Parity >= 0 && this->Context.Alternates)
        {
          count = SplitStructuredHexahedron(points.data(), this->Current.Parity == 1, tets);
          break;
        }
        if (kind == CellKind::Voxel)
        {
          std::swap(points[2], points[3]);
          std::swap(points[6], points[7]);
        }
        count = SplitHexahedron(points.data(), tets);
        break;
      case CellKind::Faceted:
        this->SplitFaceted(*GetFacetedCellType(type));
        return;
      case CellKind::Polyhedron:
        this->SplitPolyhedron();
        return;
      case CellKind::ConvexPointSet:
        this->SplitConvexPointSet();
        return;
      case CellKind::LowerDimensional:
      case CellKind::Unsupported:
        return;
    }
    this->Tets.assign(tets, tets + 4 * count);
  }

  void SplitFaceted(const FacetedCellType& type)
  {
    const std::vector<std::int64_t>& points = this->Current.Points;
    for (const std::vector<int>& polygon : type.Polygons)
    {
      this->Polygon.clear();
      for (int point : polygon)
      {
        this->Polygon.push_back(points[point]);
      }
      this->Faces.AddPolygon(this->Polygon.data(), this->Polygon.size(), this->Context.Coordinates);
    }
    if (type.MiddlePoint >= 0)
    {
      this->Faces.ConeFrom(points[type.MiddlePoint], this->Tets);
    }
    else if (!type.ApexAtCorner ||
      !this->Faces.ConeFromSmallestId(this->Context.Coordinates, this->Tets))
    {
      this->Faces.ConeFrom(this->AddPoint(points, type.MiddleWeights), this->Tets);
    }
  }

  void SplitPolyhedron()
  {
    this->Faces.OrientOutward(this->Context.Coordinates);
    this->ConeFromCornerOrMiddle();
  }

  void SplitConvexPointSet()
  {
    if (!FindConvexFaces(this->Current.Points, this->Context.Coordinates, this->Hull))
    {
      return;
    }
    for (const std::vector<std::int64_t>& polygon : this->Hull.Polygons)
    {
      this->Faces.AddPolygon(polygon.data(), polygon.size(), this->Context.Coordinates);
    }
    this->ConeFromCornerOrMiddle();
    for (std::int64_t point : this->Hull.Others)
    {
      this->SplitAt(point);
    }
  }

  void ConeFromCornerOrMiddle()
  {
    if (!this->Faces.ConeFromSmallestId(this->Context.Coordinates, this->Tets))
    {
      std::vector<double> weights;
      if (!this->Faces.FindMiddle(this->Context.Coordinates, weights) &&
        !this->Faces.CutToStar(this->Context.Coordinates, this->Tets, weights))
      {
        this->Faces.FindMiddle(this->Context.Coordinates, weights); // the mean
        ++this->Output.FoldedCells;
      }
      if (!this->Faces.GetPoints().empty())
      {
        this->Faces.ConeFrom(this->AddPoint(this->Faces.GetPoints(), weights), this->Tets);
      }
    }
  }

  /// Splits the tetrahedra that a point lies in: several where it lies on a face or an edge.
  void SplitAt(std::int64_t point)
  {
    std::vector<std::int64_t> split;
    for (std::size_t i = 0; i < this->Tets.size(); i += 4)
    {
      const std::int64_t* tet = &this->Tets[i];
      const double volume = this->GetVolume({ tet[0], tet[1], tet[2], tet[3] });
      std::array<bool, 4> isAbove = {};
      bool isInside = volume > 0;
      for (int corner = 0; corner < 4; ++corner)
      {
        std::array<std::int64_t, 4> part = { tet[0], tet[1], tet[2], tet[3] };
        part[corner] = point;
        const double share = this->GetVolume(part) / volume;
        isInside = isInside && share > -OnFace;
        isAbove[corner] = share > OnFace;
      }
      if (!isInside)
      {
        split.insert(split.end(), tet, tet + 4);
        continue;
      }
      for (int corner = 0; corner < 4; ++corner)
      {
        if (isAbove[corner])
        {
          split.insert(split.end(), tet, tet + 4);
          split[split.size() - 4 + corner] = point;
        }
      }
    }
    this->Tets = std::move(split);
  }

  double GetVolume(const std::array<std::int64_t, 4>& tet) const
  {
    return GetSignedVolume(this->GetPosition(tet[0]), this->GetPosition(tet[1]),
      this->GetPosition(tet[2]), this->GetPosition(tet[3]));
  }

  /// Of a point of the mesh, or of one that was added here.
  const double* GetPosition(std::int64_t point) const
  {
    return point >= 0 ? this->Context.Coordinates + 3 * point
                      : &this->Output.AddedCoordinates[3 * (-1 - point)];
  }

  std::int64_t AddPoint(const std::vector<std::int64_t>& points, const std::vector<double>& weights)
  {
    double x[3] = { 0, 0, 0 };
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      if (weights[i] != 0)
      {
        this->Output.AddedSources.push_back(points[i]);
        this->Output.AddedWeights.push_back(weights[i]);
        for (int axis = 0; axis < 3; ++axis)
        {
          x[axis] += weights[i] * this->Context.Coordinates[3 * points[i] + axis];
        }
      }
    }
    this->Output.AddedOffsets.push_back(
      static_cast<std::int64_t>(this->Output.AddedSources.size()));
    this->Output.AddedCoordinates.insert(this->Output.AddedCoordinates.end(), x, x + 3);
    return -static_cast<std::int64_t>(this->Output.AddedCoordinates.size() / 3);
  }

  const SourceT& Source;
  const BlockContext& Context;
  IntakeChunk& Output;
  SourceCell Current;
  FacetedCellSplitter Faces;
  std::vector<std::int64_t> Polygon;
  std::vector<std::int64_t> Tets;
  ConvexFaces Hull;
};

} // namespace tetralux

#endif
