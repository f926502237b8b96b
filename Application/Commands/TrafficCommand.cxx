// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/TrafficCommand.h"

#include "Bench/BenchOptions.h"
#include "BusTraffic/PaperTraffic.h"
#include "BusTraffic/TrafficFrame.h"
#include "BusTraffic/TrafficSimulator.h"
#include "CommandLine/CommandErrors.h"
#include "CommandLine/CommandOption.h"
#include "Files/ReadMesh.h"
#include "TriangleCaster/ImageVolume.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

namespace
{

using tetralux::GetTriangleRate;
using tetralux::ImageVolume;
using tetralux::PaperRow;
using tetralux::PaperScene;
using tetralux::TrafficCounts;
using tetralux::TrafficFrame;
using tetralux::TrafficOpacity;
using tetralux::TrafficOrder;
using tetralux::TrafficRun;

/// An image of unsigned 8-bit values, and what holds them.
struct ImageFile
{
  vtkSmartPointer<vtkDataObject> Data;
  ImageVolume Volume;
};

ImageFile ReadImage(const std::string& name)
{
  ImageFile file;
  file.Data = ReadMesh({ name, {}, {}, {} }).Data;
  auto* image = vtkImageData::SafeDownCast(file.Data);
  if (image == nullptr)
  {
    throw WorkError("'" + name + "': holds no image data");
  }
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  if (scalars == nullptr || scalars->GetDataType() != VTK_UNSIGNED_CHAR ||
    scalars->GetNumberOfComponents() != 1)
  {
    throw WorkError("'" + name + "': has no point scalars of one unsigned 8-bit value each");
  }
  image->GetDimensions(file.Volume.Dimensions);
  if (*std::min_element(file.Volume.Dimensions, file.Volume.Dimensions + 3) < 2)
  {
    throw WorkError("'" + name + "': has fewer than 2 points along an axis");
  }
  file.Volume.Type = tetralux::ImageScalar::UInt8;
  file.Volume.Values = scalars->GetVoidPointer(0);
  return file;
}

/// A row of the tables.
struct Measured
{
  PaperRow Paper; ///< its numbers are those of another volume where the scene is not the paper's
  TrafficCounts Counts;
  TrafficCounts WithoutFills; ///< with OP, where rays end
};

/// A cache of today's processors, in both orders.
struct ProcessorCache
{
  const char* Name;
  tetralux::TextureCacheKind Kind;
  TrafficCounts Triangles;
  TrafficCounts Planes;
};

struct MeasuredScene
{
  PaperScene Scene;
  bool IsPaper = true; ///< whether the paper's numbers are those of this volume
  int Planes = 0;
  std::int64_t DepthsOfPixels = 0;
  std::int64_t DepthsOfTriangles = 0;
  std::vector<Measured> Rows;
  std::vector<ProcessorCache> Processors;
};

std::vector<ProcessorCache> ListProcessorCaches()
{
  return { { "32 KB, 8 ways", { false, 32 << 10, 8 }, {}, {} },
    { "48 KB, 12 ways", { false, 48 << 10, 12 }, {}, {} },
    { "64 KB, 8 ways", { false, 64 << 10, 8 }, {}, {} } };
}

TrafficRun MakeRun(const PaperScene& scene, const PaperRow& row)
{
  TrafficRun run;
  run.Order = row.Order;
  run.Cache.Bytes = row.CacheBytes;
  run.EndTriangles = row.EndTriangles;
  run.Opacity = row.Opacity == TrafficOpacity::Opaque ? scene.Opaque : scene.Translucent;
  return run;
}

/// Adds the rows of the scene with pictures of one size.
void MeasureSize(const ImageVolume& volume, int size, MeasuredScene& result)
{
  const TrafficFrame frame = tetralux::MakeTrafficFrame(
    volume, result.Scene.View, result.Scene.HullThreshold, tetralux::PaperPlaneDistance, size);
  std::vector<TrafficRun> runs;
  for (const Measured& row : result.Rows)
  {
    if (row.Paper.Size == size)
    {
      runs.push_back(MakeRun(result.Scene, row.Paper));
      if (row.Paper.EndTriangles)
      {
        runs.push_back(runs.back());
        runs.back().SkipFills = true;
      }
    }
  }
  const bool processors = size == tetralux::PaperSize;
  if (processors)
  {
    for (const ProcessorCache& processor : result.Processors)
    {
      for (const TrafficOrder order : { TrafficOrder::Triangles, TrafficOrder::Planes })
      {
        TrafficRun run;
        run.Order = order;
        run.Cache = processor.Kind;
        runs.push_back(run);
      }
    }
  }
  const std::vector<TrafficCounts> counts = tetralux::SimulateTraffic(frame, runs);
  auto next = counts.begin();
  for (Measured& row : result.Rows)
  {
    if (row.Paper.Size == size)
    {
      row.Counts = *next++;
      if (row.Paper.EndTriangles)
      {
        row.WithoutFills = *next++;
      }
    }
  }
  if (processors)
  {
    for (ProcessorCache& processor : result.Processors)
    {
      processor.Triangles = *next++;
      processor.Planes = *next++;
    }
    result.Planes = frame.GetNumberOfPlanes();
    result.DepthsOfPixels = frame.GetDepthsOfPixels();
    result.DepthsOfTriangles = frame.GetDepthsOfTriangles();
  }
}

/// rows: name of the scene whose rows of the paper are measured.
MeasuredScene MeasureScene(
  const PaperScene& scene, const std::string& rows, const ImageVolume& volume)
{
  MeasuredScene result;
  result.Scene = scene;
  result.Processors = ListProcessorCaches();
  std::vector<int> sizes;
  for (const PaperRow& row : tetralux::MakePaperRows())
  {
    if (row.Scene == rows)
    {
      result.Rows.push_back({ row, {}, {} });
      if (std::find(sizes.begin(), sizes.end(), row.Size) == sizes.end())
      {
        sizes.push_back(row.Size);
      }
    }
  }
  for (const int size : sizes)
  {
    MeasureSize(volume, size, result);
  }
  return result;
}

std::vector<MeasuredScene> MeasureScenes(const BenchOptions& options)
{
  std::vector<MeasuredScene> results;
  const std::string& name = options.Scene.Input.Name;
  if (!name.empty())
  {
    const ImageFile file = ReadImage(name);
    PaperScene scene = tetralux::MakePaperEngine();
    const std::string rows = scene.Name;
    const int* points = file.Volume.Dimensions;
    scene.Name = std::filesystem::path(name).stem().string();
    scene.View.Extent *= *std::max_element(points, points + 3) / scene.VolumeSize;
    results.push_back(MeasureScene(scene, rows, file.Volume));
    results.back().IsPaper = false;
    return results;
  }
  const std::filesystem::path folder = GetDataFolder(options);
  for (const PaperScene& scene : { tetralux::MakePaperBrain(), tetralux::MakePaperEngine() })
  {
    const ImageFile file = ReadImage((folder / scene.FileName).string());
    results.push_back(MeasureScene(scene, scene.Name, file.Volume));
  }
  return results;
}

/// With a comma between thousands.
std::string FormatCount(std::int64_t count)
{
  std::string text = std::to_string(count);
  constexpr std::size_t Group = 3;
  for (std::size_t end = text.size(); end > Group; end -= Group)
  {
    text.insert(end - Group, ",");
  }
  return text;
}

std::string FormatNumber(const char* format, double number)
{
  char text[64];
  std::snprintf(text, sizeof(text), format, number);
  return text;
}

/// Widths of the tables' columns.
constexpr int LabelWidth = 34;
constexpr int WhoWidth = 6;
constexpr int NumberWidth = 14;

void PrintLine(
  const std::string& label, const std::string& who, const std::vector<std::string>& columns)
{
  const auto pad = [](const std::string& text, int width)
  { return std::string(std::max<int>(width - static_cast<int>(text.size()), 0), ' '); };
  std::cout << label << pad(label, LabelWidth) << who << pad(who, WhoWidth);
  for (const std::string& column : columns)
  {
    std::cout << pad(column, NumberWidth) << column;
  }
  std::cout << "\n";
}

std::string FormatLabel(const std::string& scene, const PaperRow& row)
{
  const std::string opacity = row.Opacity == TrafficOpacity::Opaque ? " opaque"
    : row.Opacity == TrafficOpacity::Translucent                    ? " translucent"
                                                                    : "";
  return scene + opacity + " " + std::to_string(row.Size) + ", " +
    std::to_string(row.CacheBytes >> 10) + " KB" + (row.EndTriangles ? ", TT" : "");
}

std::vector<std::string> FormatCounts(const TrafficCounts& counts, bool triangles)
{
  std::vector<std::string> columns;
  if (triangles)
  {
    columns = { FormatCount(counts.PTriangles), FormatCount(counts.STriangles) };
  }
  for (const std::int64_t count : { counts.Raypoints, counts.Hits, counts.Misses,
         counts.TextureBytes, counts.FrameBytesRead, counts.FrameBytesWritten })
  {
    columns.push_back(FormatCount(count));
  }
  columns.push_back(FormatNumber("%.0f", counts.GetBandwidth()));
  return columns;
}

void PrintTable1()
{
  constexpr int Counts[3] = { 256, 512, 1024 };
  constexpr int PaperRates[3][3] = { { 5, 20, 80 }, { 10, 40, 160 }, { 20, 80, 320 } };
  std::cout << "Table 1: millions of triangles a second at 10 frames a second, all planes over all "
               "of the picture\n";
  PrintLine("planes", "", { "256x256", "512x512", "1024x1024" });
  for (int i = 0; i < 3; ++i)
  {
    std::vector<std::string> paper, here;
    for (int k = 0; k < 3; ++k)
    {
      paper.push_back(std::to_string(PaperRates[i][k]));
      here.push_back(FormatNumber("%.1f", GetTriangleRate(Counts[i], Counts[k])));
    }
    PrintLine(std::to_string(Counts[i]), "paper", paper);
    PrintLine("", "here", here);
  }
}

void PrintTable(const std::vector<MeasuredScene>& scenes, TrafficOrder order)
{
  const bool triangles = order == TrafficOrder::Triangles;
  std::vector<std::string> names;
  if (triangles)
  {
    names = { "P-triangles", "S-triangles" };
  }
  names.insert(names.end(),
    { "raypoints", "hits", "misses", "texture bytes", "frame read", "frame written", "MB/s" });
  std::cout << (triangles
      ? "\nTable 2: all P-triangles of an S-triangle, then the next S-triangle\n"
      : "\nTable 3: one plane at a time, back to front\n");
  PrintLine("", "", names);
  for (const MeasuredScene& scene : scenes)
  {
    for (const Measured& row : scene.Rows)
    {
      if (row.Paper.Order != order)
      {
        continue;
      }
      const std::string label = FormatLabel(scene.Scene.Name, row.Paper);
      if (scene.IsPaper)
      {
        PrintLine(label, "paper", FormatCounts(row.Paper.Counts, triangles));
      }
      PrintLine(scene.IsPaper ? "" : label, "here", FormatCounts(row.Counts, triangles));
      if (row.Paper.EndTriangles)
      {
        PrintLine("", "OP", FormatCounts(row.WithoutFills, triangles));
      }
    }
  }
}

void PrintProcessors(const std::vector<MeasuredScene>& scenes)
{
  std::cout << "\nCaches of processors, lines of 64 bytes, voxels of 1 byte, rows along x; picture "
               "of 256 x 256\n";
  PrintLine("", "", { "voxels", "misses", "texture bytes", "MB/s" });
  for (const MeasuredScene& scene : scenes)
  {
    for (const ProcessorCache& processor : scene.Processors)
    {
      const auto print = [&](const char* order, const TrafficCounts& counts)
      {
        PrintLine(scene.Scene.Name + " " + order + ", " + processor.Name, "",
          { FormatCount(counts.Hits + counts.Misses), FormatCount(counts.Misses),
            FormatCount(counts.TextureBytes), FormatNumber("%.0f", 30e-6 * counts.TextureBytes) });
      };
      print("planes", processor.Planes);
      print("S-tri.", processor.Triangles);
    }
  }
}

/// The row of the scene with the same picture and cache but another order, or without end.
const Measured& FindRow(const MeasuredScene& scene, const PaperRow& like, TrafficOrder order)
{
  return *std::find_if(scene.Rows.begin(), scene.Rows.end(),
    [&](const Measured& row)
    {
      return row.Paper.Order == order && row.Paper.Size == like.Size &&
        row.Paper.CacheBytes == like.CacheBytes && !row.Paper.EndTriangles;
    });
}

double Divide(std::int64_t a, std::int64_t b)
{
  return static_cast<double>(a) / static_cast<double>(b);
}

void PrintSavings(const std::vector<MeasuredScene>& scenes)
{
  std::cout << "\nHow many times less than in table 3\n";
  PrintLine("", "", { "texture bytes", "all bytes" });
  for (const MeasuredScene& scene : scenes)
  {
    for (const Measured& row : scene.Rows)
    {
      if (row.Paper.Order == TrafficOrder::Triangles)
      {
        const Measured& planes = FindRow(scene, row.Paper, TrafficOrder::Planes);
        const auto format = [](const TrafficCounts& before, const TrafficCounts& after)
        {
          return std::vector<std::string>{ FormatNumber("%.2f",
                                             Divide(before.TextureBytes, after.TextureBytes)),
            FormatNumber("%.2f", Divide(before.GetBytes(), after.GetBytes())) };
        };
        const std::string label = FormatLabel(scene.Scene.Name, row.Paper);
        if (scene.IsPaper)
        {
          PrintLine(label, "paper", format(planes.Paper.Counts, row.Paper.Counts));
        }
        PrintLine(scene.IsPaper ? "" : label, "here", format(planes.Counts, row.Counts));
      }
    }
  }
}

void PrintScenes(const std::vector<MeasuredScene>& scenes)
{
  std::cout << "\nPictures of 256 x 256\n";
  for (const MeasuredScene& scene : scenes)
  {
    std::cout << scene.Scene.Name << ": planes " << scene.Planes;
    if (scene.IsPaper)
    {
      std::cout << " (paper " << scene.Scene.Planes << ")";
    }
    std::cout << "; depths read back: " << FormatCount(scene.DepthsOfPixels) << " by pixels, "
              << FormatCount(scene.DepthsOfTriangles) << " by S-triangles\n";
  }
}

void RunTraffic(const BenchOptions& options)
{
  if (options.Scene.Input.Name.empty() && GetDataFolder(options).empty())
  {
    throw UsageError(
      "bench: --traffic needs a FILE, or --data with the folder of brain.vti and engine.vti");
  }
  const std::vector<MeasuredScene> scenes = MeasureScenes(options);
  PrintTable1();
  PrintScenes(scenes);
  PrintTable(scenes, TrafficOrder::Triangles);
  PrintTable(scenes, TrafficOrder::Planes);
  PrintSavings(scenes);
  PrintProcessors(scenes);
}

} // namespace

std::function<bool()> AddTrafficOptions(CLI::App* command, const BenchOptions& options)
{
  CLI::Option* traffic = command->add_flag("--traffic",
    "Count, in place of pictures, what a texturing unit's caches read and write of memory: in the "
    "order of S-triangles and plane by plane (Knittel 1999). Of brain.vti and engine.vti in the "
    "folder of --data, with the paper's numbers, or of an image");
  return [command, traffic, &options]
  {
    if (traffic->count() == 0)
    {
      return false;
    }
    RefuseOtherOptions(command, { "--traffic", "--data", "IN" });
    RunTraffic(options);
    return true;
  };
}
