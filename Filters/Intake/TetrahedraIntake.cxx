// SPDX-License-Identifier: BSD-3-Clause
#include "Intake/TetrahedraIntake.h"

#include "Intake/CellSources.h"
#include "Intake/ChunkSplitter.h"
#include "Intake/DataSetBlocks.h"
#include "Intake/DataSetCheck.h"
#include "Intake/IntakeChunk.h"
#include "Intake/PlainCopies.h"
#include "Intake/StructuredLayout.h"
#include "Mesh/MeshLimits.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <new>
#include <numeric>

namespace tetralux
{

namespace
{

/// Chunks between two reports of progress.
constexpr vtkIdType ChunksBetweenReports = 64;

class Intake
{
public:
  Intake(TetrahedraIntake& result, const std::function<bool(double)>& progress,
    const CoincidentPoints& merged)
    : Result(result)
    , Mesh(result.Mesh)
    , Report(result.Report)
    , Progress(progress)
    , Merged(merged)
  {
  }

  void Run(vtkDataObject* input)
  {
    const std::vector<DataSetBlock> blocks = CollectDataSets(input, &this->Report.SkippedBlocks);
    std::int64_t structuredTetrahedra = 0;
    for (const DataSetBlock& block : blocks)
    {
      this->Result.Error = FindDamage(block.DataSet);
      if (!this->Result.Error.empty())
      {
        this->Result.Error = "the input is damaged: " + this->Result.Error;
        return;
      }
      this->Report.NumberOfPoints += block.DataSet->GetNumberOfPoints();
      this->Report.NumberOfCells += block.DataSet->GetNumberOfCells();
      structuredTetrahedra += CountStructuredTetrahedra(block.DataSet);
    }
    this->Report.Blocks = static_cast<std::int64_t>(blocks.size());
    if (!vtkDataSet::SafeDownCast(input) && !vtkCompositeDataSet::SafeDownCast(input))
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
    if (this->Report.NumberOfCells > MaximumInputCells)
    {
      this->Result.Error = "the input has " + std::to_string(this->Report.NumberOfCells) +
        " cells; at most " + std::to_string(MaximumInputCells) + " are possible";
      return;
    }
    if (structuredTetrahedra > MaximumCells)
    {
      this->RefuseTetrahedra();
      return;
    }

    this->Mesh.Points.resize(3 * this->Report.NumberOfPoints);
    for (const DataSetBlock& block : blocks)
    {
      CopyPoints(block.DataSet, this->Mesh.Points.data() + 3 * block.FirstPoint);
    }
    if (!this->Merged.Points.empty())
    {
      this->FirstPoints.resize(this->Report.NumberOfPoints);
      std::iota(this->FirstPoints.begin(), this->FirstPoints.end(), 0);
      for (std::size_t i = 0; i < this->Merged.Points.size(); ++i)
      {
        this->FirstPoints[this->Merged.Points[i]] =
          static_cast<std::int32_t>(this->Merged.Firsts[i]);
      }
      this->Alternates = this->MergesAlternateAlike(blocks);
    }
    else if (blocks.size() == 1 && this->TakeTetrahedraAsTheyAre(blocks[0].DataSet))
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
    GatherChunks(this->Chunks, this->Mesh);
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
    this->Result.Error = "the input splits into more than " + std::to_string(MaximumCells) +
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

  /// Whether all merged points are of structured grids and have the parity of those that they are
  /// merged into: diagonals of faces join points of one parity.
  bool MergesAlternateAlike(const std::vector<DataSetBlock>& blocks) const
  {
    std::vector<StructuredLayout> layouts;
    for (const DataSetBlock& block : blocks)
    {
      StructuredLayout layout;
      if (!GetStructuredLayout(block.DataSet, layout))
      {
        return false;
      }
      layouts.push_back(layout);
    }
    const auto getParity = [&](std::int64_t point)
    {
      const auto next = std::upper_bound(blocks.begin(), blocks.end(), point,
        [](std::int64_t id, const DataSetBlock& block) { return id < block.FirstPoint; });
      const auto block = next - 1;
      return layouts[block - blocks.begin()].GetParityOfPoint(point - block->FirstPoint);
    };
    for (std::size_t i = 0; i < this->Merged.Points.size(); ++i)
    {
      if (getParity(this->Merged.Points[i]) != getParity(this->Merged.Firsts[i]))
      {
        return false;
      }
    }
    return true;
  }

  /// The common case: nothing to split, nothing to leave out.
  bool TakeTetrahedraAsTheyAre(vtkDataSet* dataSet)
  {
    auto grid = vtkUnstructuredGrid::SafeDownCast(dataSet);
    if (!grid || grid->GetNumberOfCells() == 0 || grid->GetNumberOfCells() > MaximumCells ||
      grid->GetCellGhostArray() || grid->GetPointGhostArray())
    {
      return false;
    }
    this->Mesh.Cells.resize(4 * grid->GetNumberOfCells());
    if (!CopyTetrahedra(grid, this->Mesh.Cells.data()))
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

    context.Alternates = this->Alternates;
    context.FirstPoints = this->FirstPoints.empty() ? nullptr : this->FirstPoints.data();
    context.HasRationalWeights = block.DataSet->GetPointData()->GetRationalWeights() != nullptr;

    StructuredLayout layout;
    if (GetStructuredLayout(block.DataSet, layout) && layout.IsThreeDimensional())
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
  bool Account(IntakeChunk& chunk, std::int64_t firstCell)
  {
    for (std::int64_t& parent : chunk.Parents)
    {
      parent += firstCell;
    }
    AddCounts(chunk, this->Report);

    this->NumberOfTetrahedra += static_cast<std::int64_t>(chunk.Parents.size());
    this->NumberOfAddedPoints += static_cast<std::int64_t>(chunk.AddedOffsets.size()) - 1;
    if (this->NumberOfTetrahedra > MaximumCells)
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

  TetrahedraIntake& Result;
  TetrahedralMesh& Mesh;
  TetrahedraIntakeReport& Report;
  const std::function<bool(double)>& Progress;
  const CoincidentPoints& Merged;
  std::vector<std::int32_t> FirstPoints; ///< see BlockContext; empty where nothing is merged
  bool Alternates = true;                ///< see BlockContext
  std::vector<IntakeChunk> Chunks;
  std::int64_t NumberOfTetrahedra = 0;
  std::int64_t NumberOfAddedPoints = 0;
};

} // namespace

TetrahedraIntake TakeInTetrahedra(
  vtkDataObject* input, const std::function<bool(double)>& progress, const CoincidentPoints& merged)
{
  TetrahedraIntake result;
  try
  {
    Intake(result, progress, merged).Run(input);
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
