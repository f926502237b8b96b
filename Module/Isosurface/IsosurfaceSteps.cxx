// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurface/IsosurfaceSteps.h"

#include "Base/Digest.h"
#include "Base/Stopwatch.h"
#include "Isosurface/TracedScene.h"

#include <algorithm>
#include <set>

namespace tetralux
{
namespace
{

/// Cells of a leaf. Measured on the blunt fin and a ring of 3 million cells.
constexpr int LeafSize = 8;

CacheKey MakeNumbersKey(const std::vector<double>& numbers)
{
  Digester digester;
  digester.Add(numbers.data(), numbers.size() * sizeof(double));
  return CacheKey::Of(digester.Get()[0], digester.Get()[1]);
}

std::size_t GetBytes(const MinMaxTree& tree)
{
  return tree.Nodes.size() * sizeof(MinMaxTree::Node) + tree.Cells.size() * sizeof(std::int32_t);
}

} // namespace

const IsosurfaceStep& IsosurfaceSteps::Update(VolumeScene& scene, const IsosurfaceOptions& options,
  int threads, IsosurfaceStatistics& statistics)
{
  this->ChooseStep(scene, options, threads, statistics);
  this->UpdatePolygons(scene, options, threads, statistics);
  this->Forget(options.StepCacheBytes);

  const IsosurfaceStep& step = this->Entries.front().Step;
  const auto cells = static_cast<double>(
    std::max<std::size_t>(1, scene.Mesh.GetMesh()->GetMesh().GetNumberOfCells()));
  statistics.Nodes = static_cast<std::int64_t>(step.Tree->Nodes.size());
  statistics.TreeBytes = static_cast<double>(GetBytes(*step.Tree)) / cells;
  statistics.StepBytes = static_cast<double>(step.Ranges.Nodes.size() * sizeof(MinMaxTree::Range) +
                           scene.Mesh.GetScalars().size() * sizeof(double)) /
    cells;
  statistics.Steps = static_cast<int>(this->Entries.size());
  std::set<const MinMaxTree*> trees;
  for (const Entry& entry : this->Entries)
  {
    statistics.AllStepsBytes += entry.Step.GetBytes();
    if (trees.insert(entry.Step.Tree.get()).second)
    {
      statistics.AllTreesBytes += GetBytes(*entry.Step.Tree);
    }
  }
  return step;
}

/// Brings the entry of the scene's numbers to the front, or makes one there.
void IsosurfaceSteps::ChooseStep(const VolumeScene& scene, const IsosurfaceOptions& options,
  int threads, IsosurfaceStatistics& statistics)
{
  const Stopwatch stopwatch;
  CacheKey cells = CacheKey::Of(scene.Mesh.GetCellsVersion(), options.Build);
  if (!this->Cells.Has(cells))
  {
    this->Cells.Set(std::move(cells));
    this->Entries.clear();
    this->Numbers.Reset();
  }
  CacheKey numbers = CacheKey::Of(scene.Mesh.GetPointsVersion(), scene.Mesh.GetScalarsVersion());
  if (this->Numbers.Has(numbers))
  {
    return;
  }
  this->Numbers.Reset(); // what follows may run out of memory
  this->Points.Update(CacheKey::Of(scene.Mesh.GetPointsVersion()),
    [&] { return MakeNumbersKey(scene.Mesh.GetMesh()->GetMesh().Points); });
  Entry entry;
  entry.PointsKey = this->Points.Get();
  entry.Key = MakeNumbersKey(scene.Mesh.GetScalars());
  const auto found = std::find_if(this->Entries.begin(), this->Entries.end(),
    [&](const Entry& other)
    { return other.Key == entry.Key && other.PointsKey == entry.PointsKey; });
  statistics.RangesSeconds += stopwatch.GetSeconds();
  if (found != this->Entries.end())
  {
    this->Entries.splice(this->Entries.begin(), this->Entries, found);
  }
  else
  {
    this->MakeStep(entry, scene, options, threads, statistics);
    this->Entries.push_front(std::move(entry));
  }
  this->Numbers.Set(std::move(numbers));
}

/// Makes the tree and the ranges of an entry that has its keys. Takes from the entries what depends
/// on points or scalars alone that did not change.
void IsosurfaceSteps::MakeStep(Entry& entry, const VolumeScene& scene,
  const IsosurfaceOptions& options, int threads, IsosurfaceStatistics& statistics)
{
  const WalkMesh& walk = *scene.Mesh.GetMesh();
  const TetrahedralMesh& mesh = walk.GetMesh();
  const Stopwatch treeStopwatch;
  std::shared_ptr<MinMaxTree> other;
  bool hasRanges = false;
  for (const Entry& before : this->Entries)
  {
    if (before.PointsKey == entry.PointsKey)
    {
      entry.Step.Tree = before.Step.Tree;
    }
    if (!hasRanges && before.Key == entry.Key)
    {
      entry.Step.Ranges = before.Step.Ranges;
      hasRanges = true;
    }
    other = other ? other : before.Step.Tree;
  }
  if (options.StepCacheBytes == 0)
  {
    this->Entries.clear();
  }
  if (!entry.Step.Tree && other)
  {
    const bool isShared = other.use_count() > 1; // by a step that is kept
    entry.Step.Tree = isShared ? std::make_shared<MinMaxTree>(*other) : other;
    RefitMinMaxTree(*entry.Step.Tree, mesh, walk.GetCenter(), walk.GetRadius(), threads);
    statistics.Rebuilt.emplace_back("boxes");
  }
  else if (!entry.Step.Tree)
  {
    MinMaxTreeOptions build;
    build.Build = options.Build;
    build.LeafSize = LeafSize;
    build.NumberOfThreads = threads;
    entry.Step.Tree = std::make_shared<MinMaxTree>(
      BuildMinMaxTree(mesh, walk.GetCenter(), walk.GetRadius(), build));
    statistics.Rebuilt.emplace_back("tree");
  }
  statistics.TreeSeconds = treeStopwatch.GetSeconds();
  if (hasRanges)
  {
    return;
  }
  const Stopwatch rangesStopwatch;
  entry.Step.Ranges = MakeMinMaxRanges(*entry.Step.Tree, mesh, scene.Mesh.GetScalars(), threads);
  statistics.Rebuilt.emplace_back("ranges");
  statistics.RangesSeconds += rangesStopwatch.GetSeconds();
}

void IsosurfaceSteps::UpdatePolygons(VolumeScene& scene, const IsosurfaceOptions& options,
  int threads, IsosurfaceStatistics& statistics)
{
  const Stopwatch stopwatch;
  IsosurfaceStep& step = this->Entries.front().Step;
  step.Values.clear();
  CacheKey values;
  for (const Isosurface& surface : ListVisible(scene))
  {
    step.Values.push_back(surface.Value);
    values.Add(surface.Value);
  }
  if (options.Polygons == Isopolygons::OnTheFly)
  {
    step.Active.Reset();
  }
  const IsopolygonSource source = MakeIsopolygonSource(scene, step.Values);
  const auto update = [&](auto& cached, CacheKey key, const char* name, const auto& build)
  {
    if (cached.Update(std::move(key), build))
    {
      statistics.Rebuilt.emplace_back(name);
    }
  };
  const bool precomputed = options.Polygons == Isopolygons::Precomputed;
  if (precomputed)
  {
    update(step.Active, values, "isopolygons",
      [&](ActiveTree old) {
        return MakeActiveTree(*step.Tree, step.Ranges, source, threads, std::move(old.Polygons));
      });
  }
  const bool lit = IsLit(scene, options);
  if (precomputed && lit && options.SmoothShading)
  {
    update(step.Gradients, CacheKey::Of(step.Active.GetVersion()), "gradients",
      [&]
      {
        scene.Mesh.PreparePointGradients();
        return MakeGradientFields(
          step.Active.Get(), source, scene.Mesh.GetPointGradients().data(), threads);
      });
  }
  if (precomputed && lit && !options.SmoothShading)
  {
    update(step.CellGradients, CacheKey::Of(step.Active.GetVersion()), "gradients",
      [&](RawVector<GradientRow> old)
      {
        const WalkMesh& mesh = *scene.Mesh.GetMesh();
        return MakePolygonGradients(step.Active.Get(), mesh.GetMesh(), scene.Mesh.GetScalars(),
          mesh.GetRadius(), scene.Mesh.GetGradientUnit(), threads, std::move(old));
      });
  }
  const std::vector<double>& colors = scene.Mesh.GetColorScalars();
  if (precomputed && !colors.empty())
  {
    update(step.Colors, CacheKey::Of(step.Active.GetVersion(), scene.Mesh.GetColorScalarsVersion()),
      "colours",
      [&] { return MakeScalarFields(step.Active.Get(), source, colors.data(), threads); });
  }
  statistics.PolygonsSeconds = stopwatch.GetSeconds();
}

void IsosurfaceSteps::Forget(std::size_t bytes)
{
  std::size_t sum = 0;
  std::set<const MinMaxTree*> trees;
  auto entry = this->Entries.begin();
  for (; entry != this->Entries.end(); ++entry)
  {
    sum += entry->Step.GetBytes();
    if (trees.insert(entry->Step.Tree.get()).second)
    {
      sum += GetBytes(*entry->Step.Tree);
    }
    if (entry != this->Entries.begin() && sum > bytes)
    {
      break;
    }
  }
  this->Entries.erase(entry, this->Entries.end());
}

} // namespace tetralux
