// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraIntake.h"

#include "CellSplit.h"
#include "FacetedCells.h"

#include "vtkArrayDispatch.h"
#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkCellTypes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArrayRange.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkRectilinearGrid.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <new>
#include <numeric>

namespace tetralux
{

namespace
{

constexpr std::int64_t MaximumPoints = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t MaximumTetrahedra = (std::int64_t(1) << 29) - 1;

/// Cells that one task splits before its results are put aside: enough to make the overhead of a
/// task vanish, few enough to share the work evenly.
constexpr vtkIdType ChunkSize = 8192;

/// Chunks between two reports of progress.
constexpr vtkIdType ChunksBetweenReports = 64;

enum class CellKind
{
  LowerDimensional,
  Tetrahedron,
  Voxel,
  Hexahedron,
  Wedge,
  Pyramid,
  Faceted,
  Polyhedron,
  ConvexPointSet,
  Unsupported
};

CellKind ClassifyCellType(int cellType)
{
  switch (cellType)
  {
    case VTK_TETRA:
      return CellKind::Tetrahedron;
    case VTK_VOXEL:
      return CellKind::Voxel;
    case VTK_HEXAHEDRON:
      return CellKind::Hexahedron;
    case VTK_WEDGE:
      return CellKind::Wedge;
    case VTK_PYRAMID:
      return CellKind::Pyramid;
    case VTK_POLYHEDRON:
      return CellKind::Polyhedron;
    case VTK_CONVEX_POINT_SET:
      return CellKind::ConvexPointSet;
    case VTK_EMPTY_CELL:
    case VTK_VERTEX:
    case VTK_POLY_VERTEX:
    case VTK_LINE:
    case VTK_POLY_LINE:
    case VTK_TRIANGLE:
    case VTK_TRIANGLE_STRIP:
    case VTK_POLYGON:
    case VTK_PIXEL:
    case VTK_QUAD:
    case VTK_QUADRATIC_EDGE:
    case VTK_QUADRATIC_TRIANGLE:
    case VTK_QUADRATIC_QUAD:
    case VTK_QUADRATIC_POLYGON:
    case VTK_BIQUADRATIC_QUAD:
    case VTK_QUADRATIC_LINEAR_QUAD:
    case VTK_BIQUADRATIC_TRIANGLE:
    case VTK_CUBIC_LINE:
    case VTK_PARAMETRIC_CURVE:
    case VTK_PARAMETRIC_SURFACE:
    case VTK_PARAMETRIC_TRI_SURFACE:
    case VTK_PARAMETRIC_QUAD_SURFACE:
    case VTK_HIGHER_ORDER_EDGE:
    case VTK_HIGHER_ORDER_TRIANGLE:
    case VTK_HIGHER_ORDER_QUAD:
    case VTK_HIGHER_ORDER_POLYGON:
    case VTK_LAGRANGE_CURVE:
    case VTK_LAGRANGE_TRIANGLE:
    case VTK_LAGRANGE_QUADRILATERAL:
    case VTK_BEZIER_CURVE:
    case VTK_BEZIER_TRIANGLE:
    case VTK_BEZIER_QUADRILATERAL:
      return CellKind::LowerDimensional;
    default:
      return GetFacetedCellType(cellType) ? CellKind::Faceted : CellKind::Unsupported;
  }
}

/// Points that a cell of a kind must have at least.
std::size_t GetRequiredPoints(CellKind kind, int cellType)
{
  switch (kind)
  {
    case CellKind::Tetrahedron:
    case CellKind::Polyhedron:
    case CellKind::ConvexPointSet:
      return 4;
    case CellKind::Pyramid:
      return 5;
    case CellKind::Wedge:
      return 6;
    case CellKind::Voxel:
    case CellKind::Hexahedron:
      return 8;
    case CellKind::Faceted:
      return GetFacetedCellType(cellType)->NumberOfPoints;
    case CellKind::LowerDimensional:
    case CellKind::Unsupported:
      break;
  }
  return 0;
}

/// A cell as a source hands it out.
struct Cell
{
  int Type = VTK_EMPTY_CELL;

  /// Ids within the block.
  std::vector<std::int64_t> Points;

  /// 0 or 1 in a cell of a structured grid with its points in the order of a hexahedron: whether
  /// i + j + k is odd; else -1.
  int Parity = -1;
};

/// Cells of a vtkUnstructuredGrid, read straight from its arrays.
template <class CellStateT>
class UnstructuredSource
{
public:
  static constexpr bool IsParallel = true;

  UnstructuredSource(vtkUnstructuredGrid* grid, CellStateT& state)
    : Grid(grid)
    , State(state)
    , Types(grid->GetCellTypesArray())
  {
  }

  void GetCell(vtkIdType cellId, Cell& cell) const
  {
    cell.Type = this->Types->GetValue(cellId);
    cell.Points.clear();
    const vtkIdType begin = this->State.GetBeginOffset(cellId);
    const vtkIdType end = this->State.GetEndOffset(cellId);
    auto* connectivity = this->State.GetConnectivity();
    if (0 <= begin && begin <= end && end <= connectivity->GetNumberOfValues())
    {
      const auto ids = vtk::DataArrayValueRange<1>(connectivity, begin, end);
      cell.Points.assign(ids.begin(), ids.end());
    }
  }

  /// Hands the faces of a polyhedron to addFace(ids, size).
  template <class AddFaceT>
  void GetFaces(vtkIdType cellId, AddFaceT&& addFace) const
  {
    vtkNew<vtkIdList> stream; // number of faces, then size and ids of each
    this->Grid->GetFaceStream(cellId, stream);
    vtkIdType next = 1;
    while (next < stream->GetNumberOfIds())
    {
      const vtkIdType size = stream->GetId(next++);
      if (size < 0 || next + size > stream->GetNumberOfIds())
      {
        return;
      }
      addFace(stream->GetPointer(next), size);
      next += size;
    }
  }

private:
  vtkUnstructuredGrid* Grid;
  CellStateT& State;
  vtkUnsignedCharArray* Types;
};

/// Cells of any data set through its virtual functions, which need not be thread-safe.
class DataSetSource
{
public:
  static constexpr bool IsParallel = false;

  explicit DataSetSource(vtkDataSet* dataSet)
    : DataSet(dataSet)
  {
  }

  void GetCell(vtkIdType cellId, Cell& cell) const
  {
    cell.Type = this->DataSet->GetCellType(cellId);
    this->DataSet->GetCellPoints(cellId, this->Ids);
    cell.Points.assign(this->Ids->begin(), this->Ids->end());
  }

  template <class AddFaceT>
  void GetFaces(vtkIdType cellId, AddFaceT&& addFace) const
  {
    vtkCell* cell = this->DataSet->GetCell(cellId);
    for (int i = 0; i < cell->GetNumberOfFaces(); ++i)
    {
      vtkIdList* ids = cell->GetFace(i)->GetPointIds();
      addFace(ids->GetPointer(0), ids->GetNumberOfIds());
    }
  }

private:
  vtkDataSet* DataSet;
  vtkNew<vtkIdList> Ids;
};

/// The layout of image data, rectilinear and structured grids.
struct StructuredLayout
{
  int Dimensions[3]; ///< points along each axis
  int Extent[6];
  int CellType;
};

/// Cells of a three-dimensional structured grid.
class StructuredSource
{
public:
  static constexpr bool IsParallel = true;

  explicit StructuredSource(const StructuredLayout& layout)
    : Layout(layout)
  {
  }

  void GetCell(vtkIdType cellId, Cell& cell) const
  {
    const std::int64_t pointsX = this->Layout.Dimensions[0];
    const std::int64_t pointsXY = pointsX * this->Layout.Dimensions[1];
    const std::int64_t cellsX = pointsX - 1;
    const std::int64_t cellsY = this->Layout.Dimensions[1] - 1;
    const std::int64_t i = cellId % cellsX;
    const std::int64_t j = cellId / cellsX % cellsY;
    const std::int64_t k = cellId / (cellsX * cellsY);
    const std::int64_t p = i + pointsX * j + pointsXY * k;
    const std::int64_t q = p + pointsXY;
    cell.Type = this->Layout.CellType;
    cell.Points = { p, p + 1, p + 1 + pointsX, p + pointsX, q, q + 1, q + 1 + pointsX,
      q + pointsX };
    // Counted in the whole extent, so that neighbouring pieces cut their common face alike.
    cell.Parity = static_cast<int>(
      (i + this->Layout.Extent[0] + j + this->Layout.Extent[2] + k + this->Layout.Extent[4]) & 1);
  }

  template <class AddFaceT>
  void GetFaces(vtkIdType, AddFaceT&&) const
  {
  }

private:
  StructuredLayout Layout;
};

/// What one task made of its cells.
struct Chunk
{
  std::vector<std::int32_t> Tetrahedra; ///< ids in the mesh, or -1 - k: point k added here
  std::vector<std::int64_t> Parents;    ///< ids of the block's cells
  std::vector<double> AddedCoordinates;
  std::vector<std::int64_t> AddedOffsets = { 0 };
  std::vector<std::int64_t> AddedSources; ///< ids in the mesh
  std::vector<double> AddedWeights;

  std::array<std::int64_t, 256> CellsByType = {};
  std::array<std::int64_t, 256> SkippedByType = {};
  std::int64_t GhostCells = 0;
  std::int64_t BlankedCells = 0;
  std::int64_t LowerDimensionalCells = 0;
  std::int64_t InvalidCells = 0;
};

/// What the tasks of a block have in common.
struct BlockContext
{
  DataSetBlock Block;
  std::int64_t NumberOfPoints = 0;
  const double* Coordinates = nullptr; ///< of the whole mesh, by its ids
  const unsigned char* CellGhosts = nullptr;
  const unsigned char* PointGhosts = nullptr;
};

/// Splits the cells of one chunk.
template <class SourceT>
class ChunkSplitter
{
public:
  ChunkSplitter(const SourceT& source, const BlockContext& context, Chunk& chunk)
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
    const int type = this->Current.Type & 0xff; // VTK keeps types in a byte
    ++this->Output.CellsByType[type];

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
            this->Faces.AddPolygon(this->Polygon.data(), this->Polygon.size());
          }
        });
    }
    std::vector<std::int64_t>& points = this->Current.Points;
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

    this->Tets.clear();
    this->SplitPoints(kind, type, cellId);
    for (std::size_t i = 0; i < this->Tets.size(); i += 4)
    {
      const std::int64_t* t = &this->Tets[i];
      const bool collapsed = t[0] == t[1] || t[0] == t[2] || t[0] == t[3] || t[1] == t[2] ||
        t[1] == t[3] || t[2] == t[3];
      // A tetrahedron with a repeated point is kept as it is: a defect of the mesh, for others to
      // count. In a larger cell it is the missing part of a collapsed cell.
      if (!collapsed || kind == CellKind::Tetrahedron)
      {
        this->Output.Tetrahedra.insert(this->Output.Tetrahedra.end(), t, t + 4);
        this->Output.Parents.push_back(cellId);
      }
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

  void SplitPoints(CellKind kind, int type, vtkIdType cellId)
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
        if (this->Current.Parity >= 0)
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
        this->SplitConvexPointSet(cellId);
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
      this->Faces.AddPolygon(this->Polygon.data(), this->Polygon.size());
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
    if (!this->Faces.ConeFromSmallestId(this->Context.Coordinates, this->Tets))
    {
      const std::vector<std::int64_t>& points = this->Faces.GetPoints();
      const std::vector<double> weights(points.size(), 1.0 / points.size());
      this->Faces.ConeFrom(this->AddPoint(points, weights), this->Tets);
    }
  }

  void SplitConvexPointSet(vtkIdType cellId)
  {
    if (!this->AnyCell)
    {
      this->AnyCell = vtkSmartPointer<vtkGenericCell>::New();
    }
    vtkNew<vtkIdList> ids;
    vtkNew<vtkPoints> coordinates;
    this->Context.Block.DataSet->GetCell(cellId, this->AnyCell);
    this->AnyCell->Triangulate(0, ids, coordinates);
    for (vtkIdType id : *ids)
    {
      this->Tets.push_back(id + this->Context.Block.FirstPoint);
    }
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
  Chunk& Output;
  Cell Current;
  FacetedCellSplitter Faces;
  std::vector<std::int64_t> Polygon;
  std::vector<std::int64_t> Tets;
  vtkSmartPointer<vtkGenericCell> AnyCell;
};

/// Copies the coordinates of a point array of any type.
struct CopyCoordinates
{
  template <class ArrayT>
  void operator()(ArrayT* array, double* out) const
  {
    const auto values = vtk::DataArrayValueRange<3>(array);
    vtkSMPTools::For(0, values.size(), 3 * ChunkSize,
      [&](vtkIdType begin, vtkIdType end)
      { std::copy(values.begin() + begin, values.begin() + end, out + begin); });
  }
};

void CopyPoints(vtkDataSet* dataSet, double* out)
{
  const vtkIdType numberOfPoints = dataSet->GetNumberOfPoints();
  if (numberOfPoints == 0)
  {
    return;
  }
  if (auto pointSet = vtkPointSet::SafeDownCast(dataSet))
  {
    vtkDataArray* array = pointSet->GetPoints()->GetData();
    CopyCoordinates worker;
    if (!vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::Reals>::Execute(
          array, worker, out))
    {
      worker(array, out);
    }
    return;
  }
  double x[3];
  dataSet->GetPoint(0, x); // lets image data prepare its transform before threads ask
  vtkSMPTools::For(0, numberOfPoints, ChunkSize,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType point = begin; point < end; ++point)
      {
        dataSet->GetPoint(point, out + 3 * point);
      }
    });
}

/// Fills layout where a data set is a structured grid.
bool GetStructuredLayout(vtkDataSet* dataSet, StructuredLayout& layout)
{
  if (auto image = vtkImageData::SafeDownCast(dataSet))
  {
    image->GetDimensions(layout.Dimensions);
    image->GetExtent(layout.Extent);
    layout.CellType = VTK_VOXEL;
    return true;
  }
  if (auto rectilinear = vtkRectilinearGrid::SafeDownCast(dataSet))
  {
    rectilinear->GetDimensions(layout.Dimensions);
    rectilinear->GetExtent(layout.Extent);
    layout.CellType = VTK_VOXEL;
    return true;
  }
  if (auto structured = vtkStructuredGrid::SafeDownCast(dataSet))
  {
    structured->GetDimensions(layout.Dimensions);
    structured->GetExtent(layout.Extent);
    layout.CellType = VTK_HEXAHEDRON;
    return true;
  }
  return false;
}

/// Reads the ids of a grid that has tetrahedra only, one after the other; false where a cell is
/// anything else or names a point that does not exist.
struct CopyTetrahedra
{
  template <class CellStateT>
  bool operator()(CellStateT& state, vtkUnstructuredGrid* grid, std::int32_t* out) const
  {
    using ValueType = typename CellStateT::ValueType;
    const vtkIdType numberOfCells = state.GetNumberOfCells();
    const auto numberOfPoints = static_cast<ValueType>(grid->GetNumberOfPoints());
    const auto types = vtk::DataArrayValueRange<1>(grid->GetCellTypesArray());
    const auto offsets = vtk::DataArrayValueRange<1>(state.GetOffsets());
    const auto ids = vtk::DataArrayValueRange<1>(state.GetConnectivity());
    std::atomic<bool> regular{ ids.size() == 4 * numberOfCells };
    vtkSMPTools::For(0, numberOfCells, ChunkSize,
      [&](vtkIdType begin, vtkIdType end)
      {
        if (!regular)
        {
          return;
        }
        bool good = true;
        for (vtkIdType cellId = begin; cellId < end; ++cellId)
        {
          good &=
            types[cellId] == VTK_TETRA && offsets[cellId] == static_cast<ValueType>(4 * cellId);
        }
        for (vtkIdType i = 4 * begin; i < 4 * end; ++i)
        {
          const ValueType id = ids[i];
          good &= 0 <= id && id < numberOfPoints;
          out[i] = static_cast<std::int32_t>(id);
        }
        if (!good)
        {
          regular = false;
        }
      });
    return regular;
  }
};

/// The tetrahedra that a structured grid without blanking gives, else 0: known before any work.
std::int64_t CountStructuredTetrahedra(vtkDataSet* dataSet)
{
  StructuredLayout layout;
  if (!GetStructuredLayout(dataSet, layout) || dataSet->GetCellGhostArray() ||
    dataSet->GetPointGhostArray() ||
    *std::min_element(layout.Dimensions, layout.Dimensions + 3) <= 1)
  {
    return 0;
  }
  return 5 * dataSet->GetNumberOfCells();
}

class Intake
{
public:
  Intake(TetrahedraIntake& result, const std::function<bool(double)>& progress)
    : Result(result)
    , Mesh(result.Mesh)
    , Report(result.Report)
    , Progress(progress)
  {
  }

  void Run(vtkDataObject* input)
  {
    const std::vector<DataSetBlock> blocks = CollectDataSets(input, &this->Report.SkippedBlocks);
    std::int64_t structuredTetrahedra = 0;
    for (const DataSetBlock& block : blocks)
    {
      this->Report.NumberOfPoints += block.DataSet->GetNumberOfPoints();
      this->Report.NumberOfCells += block.DataSet->GetNumberOfCells();
      structuredTetrahedra += CountStructuredTetrahedra(block.DataSet);
    }
    this->Report.Blocks = static_cast<std::int64_t>(blocks.size());
    if (blocks.empty() && !vtkCompositeDataSet::SafeDownCast(input))
    {
      this->Result.Error = input ? std::string("the input is a ") + input->GetClassName() +
          ", not a data set or a composite of data sets"
                                 : "there is no input";
      return;
    }
    if (this->Report.NumberOfPoints > MaximumPoints)
    {
      this->RefusePoints(this->Report.NumberOfPoints);
      return;
    }
    if (structuredTetrahedra > MaximumTetrahedra)
    {
      this->RefuseTetrahedra();
      return;
    }

    this->Mesh.Points.resize(3 * this->Report.NumberOfPoints);
    for (const DataSetBlock& block : blocks)
    {
      CopyPoints(block.DataSet, this->Mesh.Points.data() + 3 * block.FirstPoint);
    }
    if (blocks.size() == 1 && this->TakeTetrahedraAsTheyAre(blocks[0].DataSet))
    {
      return;
    }
    for (const DataSetBlock& block : blocks)
    {
      if (!this->SplitBlock(block))
      {
        return;
      }
    }
    this->Gather();
  }

private:
  void RefusePoints(std::int64_t count)
  {
    this->Result.Error = "the input has " + std::to_string(count) +
      " points, counting those that splitting adds; at most " + std::to_string(MaximumPoints) +
      " are possible";
  }

  void RefuseTetrahedra()
  {
    this->Result.Error = "the input splits into more than " + std::to_string(MaximumTetrahedra) +
      " tetrahedra, which is the most that is possible";
  }

  bool ReportProgress(double fraction)
  {
    if (this->Progress && !this->Progress(fraction))
    {
      this->Result.Aborted = true;
      return false;
    }
    return true;
  }

  /// The common case: nothing to split, nothing to leave out.
  bool TakeTetrahedraAsTheyAre(vtkDataSet* dataSet)
  {
    auto grid = vtkUnstructuredGrid::SafeDownCast(dataSet);
    if (!grid || grid->GetNumberOfCells() == 0 || grid->GetNumberOfCells() > MaximumTetrahedra ||
      grid->GetCellGhostArray() || grid->GetPointGhostArray())
    {
      return false;
    }
    this->Mesh.Cells.resize(4 * grid->GetNumberOfCells());
    if (!grid->GetCells()->Visit(CopyTetrahedra{}, grid, this->Mesh.Cells.data()))
    {
      this->Mesh.Cells = {};
      return false;
    }
    this->Report.CellsByType[VTK_TETRA] = grid->GetNumberOfCells();
    return true;
  }

  struct SplitUnstructured
  {
    template <class CellStateT>
    void operator()(CellStateT& state, vtkUnstructuredGrid* grid, Intake* self,
      const BlockContext& context, bool& good) const
    {
      good = self->SplitSource(UnstructuredSource<CellStateT>(grid, state), context);
    }
  };

  bool SplitBlock(const DataSetBlock& block)
  {
    BlockContext context;
    context.Block = block;
    context.NumberOfPoints = block.DataSet->GetNumberOfPoints();
    context.Coordinates = this->Mesh.Points.data();
    const vtkIdType numberOfCells = block.DataSet->GetNumberOfCells();
    vtkUnsignedCharArray* cellGhosts = block.DataSet->GetCellGhostArray();
    if (cellGhosts && cellGhosts->GetNumberOfValues() >= numberOfCells)
    {
      context.CellGhosts = cellGhosts->GetPointer(0);
    }
    vtkUnsignedCharArray* pointGhosts = block.DataSet->GetPointGhostArray();
    if (pointGhosts && pointGhosts->GetNumberOfValues() >= context.NumberOfPoints)
    {
      context.PointGhosts = pointGhosts->GetPointer(0);
    }

    StructuredLayout layout;
    if (GetStructuredLayout(block.DataSet, layout) &&
      *std::min_element(layout.Dimensions, layout.Dimensions + 3) > 1)
    {
      return this->SplitSource(StructuredSource(layout), context);
    }
    auto grid = vtkUnstructuredGrid::SafeDownCast(block.DataSet);
    if (grid && numberOfCells > 0)
    {
      bool good = false;
      grid->GetCells()->Visit(SplitUnstructured{}, grid, this, context, good);
      return good;
    }
    return this->SplitSource(DataSetSource(block.DataSet), context);
  }

  template <class SourceT>
  bool SplitSource(const SourceT& source, const BlockContext& context)
  {
    const vtkIdType numberOfCells = context.Block.DataSet->GetNumberOfCells();
    const vtkIdType numberOfChunks = (numberOfCells + ChunkSize - 1) / ChunkSize;
    const std::size_t firstChunk = this->Chunks.size();
    this->Chunks.resize(firstChunk + numberOfChunks);
    const auto splitChunks = [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        ChunkSplitter<SourceT>(source, context, this->Chunks[firstChunk + i])
          .Split(i * ChunkSize, std::min((i + 1) * ChunkSize, numberOfCells));
      }
    };
    for (vtkIdType begin = 0; begin < numberOfChunks; begin += ChunksBetweenReports)
    {
      const vtkIdType end = std::min(begin + ChunksBetweenReports, numberOfChunks);
      if (SourceT::IsParallel)
      {
        vtkSMPTools::For(begin, end, 1, splitChunks);
      }
      else
      {
        splitChunks(begin, end);
      }
      for (vtkIdType i = begin; i < end; ++i)
      {
        if (!this->Account(this->Chunks[firstChunk + i], context.Block.FirstCell))
        {
          return false;
        }
      }
      const double done =
        static_cast<double>(context.Block.FirstCell + std::min(end * ChunkSize, numberOfCells));
      if (!this->ReportProgress(done / this->Report.NumberOfCells))
      {
        return false;
      }
    }
    return true;
  }

  /// Adds a chunk to the counts; false where the mesh becomes too large.
  bool Account(Chunk& chunk, std::int64_t firstCell)
  {
    for (std::int64_t& parent : chunk.Parents)
    {
      parent += firstCell;
    }
    for (int type = 0; type < 256; ++type)
    {
      if (chunk.CellsByType[type])
      {
        this->Report.CellsByType[type] += chunk.CellsByType[type];
      }
      if (chunk.SkippedByType[type])
      {
        this->Report.SkippedByType[type] += chunk.SkippedByType[type];
      }
    }
    this->Report.GhostCells += chunk.GhostCells;
    this->Report.BlankedCells += chunk.BlankedCells;
    this->Report.LowerDimensionalCells += chunk.LowerDimensionalCells;
    this->Report.InvalidCells += chunk.InvalidCells;

    this->NumberOfTetrahedra += static_cast<std::int64_t>(chunk.Parents.size());
    this->NumberOfAddedPoints += static_cast<std::int64_t>(chunk.AddedOffsets.size()) - 1;
    if (this->NumberOfTetrahedra > MaximumTetrahedra)
    {
      this->RefuseTetrahedra();
      return false;
    }
    if (this->Report.NumberOfPoints + this->NumberOfAddedPoints > MaximumPoints)
    {
      this->RefusePoints(this->Report.NumberOfPoints + this->NumberOfAddedPoints);
      return false;
    }
    return true;
  }

  /// Puts the chunks together in their order, and frees them.
  void Gather()
  {
    const std::size_t numberOfChunks = this->Chunks.size();
    std::vector<std::int64_t> firstTetrahedron(numberOfChunks + 1, 0);
    std::vector<std::int64_t> firstAdded(numberOfChunks + 1, 0);
    std::vector<std::int64_t> firstSource(numberOfChunks + 1, 0);
    for (std::size_t i = 0; i < numberOfChunks; ++i)
    {
      const Chunk& chunk = this->Chunks[i];
      firstTetrahedron[i + 1] = firstTetrahedron[i] + chunk.Parents.size();
      firstAdded[i + 1] = firstAdded[i] + chunk.AddedOffsets.size() - 1;
      firstSource[i + 1] = firstSource[i] + chunk.AddedSources.size();
    }

    TetrahedralMesh& mesh = this->Mesh;
    const std::int64_t inputPoints = this->Report.NumberOfPoints;
    mesh.Cells.resize(4 * this->NumberOfTetrahedra);
    mesh.OriginalCells.resize(this->NumberOfTetrahedra);
    if (this->NumberOfAddedPoints > 0)
    {
      mesh.Points.resize(3 * (inputPoints + this->NumberOfAddedPoints));
      mesh.OriginalPoints.resize(inputPoints + this->NumberOfAddedPoints);
      std::iota(mesh.OriginalPoints.begin(), mesh.OriginalPoints.begin() + inputPoints, 0);
      for (std::int64_t k = 0; k < this->NumberOfAddedPoints; ++k)
      {
        mesh.OriginalPoints[inputPoints + k] = -1 - k;
      }
      mesh.AddedPoints.Offsets.resize(this->NumberOfAddedPoints + 1, 0);
      mesh.AddedPoints.Sources.resize(firstSource.back());
      mesh.AddedPoints.Weights.resize(firstSource.back());
    }

    vtkSMPTools::For(0, static_cast<vtkIdType>(numberOfChunks), 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          const Chunk chunk = std::move(this->Chunks[i]);
          const auto added = static_cast<std::int32_t>(inputPoints + firstAdded[i]);
          std::transform(chunk.Tetrahedra.begin(), chunk.Tetrahedra.end(),
            mesh.Cells.begin() + 4 * firstTetrahedron[i],
            [added](std::int32_t point) { return point >= 0 ? point : added + (-1 - point); });
          std::copy(chunk.Parents.begin(), chunk.Parents.end(),
            mesh.OriginalCells.begin() + firstTetrahedron[i]);
          std::copy(chunk.AddedCoordinates.begin(), chunk.AddedCoordinates.end(),
            mesh.Points.begin() + 3 * (inputPoints + firstAdded[i]));
          for (std::size_t k = 1; k < chunk.AddedOffsets.size(); ++k)
          {
            mesh.AddedPoints.Offsets[firstAdded[i] + k] = firstSource[i] + chunk.AddedOffsets[k];
          }
          std::copy(chunk.AddedSources.begin(), chunk.AddedSources.end(),
            mesh.AddedPoints.Sources.begin() + firstSource[i]);
          std::copy(chunk.AddedWeights.begin(), chunk.AddedWeights.end(),
            mesh.AddedPoints.Weights.begin() + firstSource[i]);
        }
      });
  }

  TetrahedraIntake& Result;
  TetrahedralMesh& Mesh;
  TetrahedraIntakeReport& Report;
  const std::function<bool(double)>& Progress;
  std::vector<Chunk> Chunks;
  std::int64_t NumberOfTetrahedra = 0;
  std::int64_t NumberOfAddedPoints = 0;
};

} // namespace

std::int64_t TetrahedraIntakeReport::GetNumberOfSkippedCells() const
{
  return std::accumulate(this->SkippedByType.begin(), this->SkippedByType.end(), std::int64_t(0),
    [](std::int64_t sum, const auto& entry) { return sum + entry.second; });
}

std::string TetrahedraIntakeReport::DescribeSkippedCells() const
{
  std::string text;
  for (const auto& [type, count] : this->SkippedByType)
  {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + GetCellTypeName(type);
  }
  return text;
}

std::string GetCellTypeName(int cellType)
{
  const std::string name = vtkCellTypes::GetClassNameFromTypeId(cellType);
  return name == "UnknownClass" ? "cell type " + std::to_string(cellType) : name;
}

std::vector<DataSetBlock> CollectDataSets(vtkDataObject* input, std::int64_t* skippedBlocks)
{
  std::vector<DataSetBlock> blocks;
  std::int64_t points = 0;
  std::int64_t cells = 0;
  std::int64_t skipped = 0;
  const auto add = [&](vtkDataObject* object)
  {
    if (auto dataSet = vtkDataSet::SafeDownCast(object))
    {
      blocks.push_back({ dataSet, points, cells });
      points += dataSet->GetNumberOfPoints();
      cells += dataSet->GetNumberOfCells();
    }
    else
    {
      ++skipped;
    }
  };

  if (auto composite = vtkCompositeDataSet::SafeDownCast(input))
  {
    auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    iterator->SkipEmptyNodesOn();
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      add(iterator->GetCurrentDataObject());
    }
  }
  else if (input)
  {
    add(input);
  }
  if (skippedBlocks)
  {
    *skippedBlocks = skipped;
  }
  return blocks;
}

TetrahedraIntake TakeInTetrahedra(vtkDataObject* input, const std::function<bool(double)>& progress)
{
  TetrahedraIntake result;
  try
  {
    Intake(result, progress).Run(input);
  }
  catch (const std::bad_alloc&)
  {
    result.Error = "there is not enough memory to split the input into tetrahedra";
  }
  if (!result.Error.empty() || result.Aborted)
  {
    result.Mesh = {};
  }
  return result;
}

} // namespace tetralux
