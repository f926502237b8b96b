// SPDX-License-Identifier: BSD-3-Clause

// What each idea of the triangle caster brings (Knittel 1999): each switched off alone, with the
// processor time of a picture and its error; the size of tiles; how far texture coordinates drift
// that are found by increments (equations 1 and 2); and what the precision of the compositing
// buffer costs (sections 1.2 and 3.2). Prints CSV. Takes the size of the picture, 512 by default.
// The data sets are in the folder that the environment variable TETRALUX_DATA names.

#include "TriangleCaster/HullDepths.h"
#include "TriangleCaster/ImageCaster.h"
#include "TriangleCaster/ImageError.h"
#include "TriangleCaster/VisibleHull.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSLCReader.h"
#include "vtkSmartPointer.h"
#include "vtkVolume16Reader.h"
#include "vtkXMLImageDataReader.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace tetralux;

namespace
{

constexpr int DefaultSize = 512;
constexpr int NumberOfPictures = 7;         ///< whose median counts
constexpr double SlicesPerVoxel = 1 / 0.75; ///< the paper's distance of planes
constexpr double ViewAngle = 30;            ///< degrees
constexpr double Pi = 3.14159265358979323846;

/// Scalars and opacities.
using Ramp = std::vector<std::pair<double, double>>;

struct DataSet
{
  std::string Name;
  vtkSmartPointer<vtkImageData> Image;
  Ramp Opaque, Translucent;
};

std::vector<DataSet> ReadDataSets(const std::string& folder)
{
  const auto readXml = [&](const char* name)
  {
    vtkNew<vtkXMLImageDataReader> reader;
    reader->SetFileName((folder + "/" + name).c_str());
    reader->Update();
    return vtkSmartPointer<vtkImageData>(reader->GetOutput());
  };
  vtkNew<vtkVolume16Reader> head;
  head->SetDataDimensions(64, 64);
  head->SetImageRange(1, 93);
  head->SetDataByteOrderToLittleEndian();
  head->SetFilePrefix((folder + "/headsq/quarter").c_str());
  head->SetDataSpacing(3.2, 3.2, 1.5);
  head->Update();
  vtkNew<vtkSLCReader> protein;
  protein->SetFileName((folder + "/neghip.slc").c_str());
  protein->Update();
  return {
    { "head", head->GetOutput(), { { 500, 0 }, { 1150, 0.85 }, { 1300, 1 } },
      { { 500, 0 }, { 1000, 0.02 }, { 1150, 0.1 } } },
    { "engine", readXml("engine.vti"), { { 70, 0 }, { 110, 0.9 } },
      { { 60, 0 }, { 110, 0.03 }, { 220, 0.15 } } },
    { "brain", readXml("brain.vti"), { { 60, 0 }, { 100, 0.9 } },
      { { 30, 0 }, { 90, 0.03 }, { 200, 0.1 } } },
    { "protein", protein->GetOutput(), { { 80, 0 }, { 120, 0.9 } }, { { 20, 0 }, { 255, 0.2 } } },
  };
}

/// A volume with its camera.
struct Scene
{
  ImageVolume Volume;
  RayGrid Grid;
  double Spacing; ///< mean one
};

Scene MakeScene(vtkImageData* image, int size)
{
  Scene scene;
  image->GetDimensions(scene.Volume.Dimensions);
  scene.Volume.Values = image->GetScalarPointer();
  scene.Volume.Type =
    image->GetScalarType() == VTK_UNSIGNED_CHAR ? ImageScalar::UInt8 : ImageScalar::UInt16;
  double spacing[3];
  image->GetSpacing(spacing);
  scene.Spacing = (spacing[0] + spacing[1] + spacing[2]) / 3;
  RayGrid& grid = scene.Grid;
  grid.Width = grid.Height = size;
  double center[3];
  double diagonal = 0;
  for (int a = 0; a < 3; ++a)
  {
    std::fill(grid.MeshFromWorld[a], grid.MeshFromWorld[a] + 4, 0.);
    grid.MeshFromWorld[a][a] = 1 / spacing[a];
    center[a] = 0.5 * spacing[a] * (scene.Volume.Dimensions[a] - 1);
    diagonal = std::hypot(diagonal, 2 * center[a]);
  }
  // An oblique view of three sides.
  const double length = std::sqrt(0.25 + 0.49 + 0.16);
  const double view[3] = { 0.5 / length, 0.7 / length, -0.4 / length };
  const double across = std::hypot(view[0], view[1]);
  const double right[3] = { view[1] / across, -view[0] / across, 0 };
  const double up[3] = { right[1] * view[2] - right[2] * view[1],
    right[2] * view[0] - right[0] * view[2], right[0] * view[1] - right[1] * view[0] };
  const double distance = 0.55 * diagonal / std::sin(ViewAngle * Pi / 360);
  const double step = 2 * std::tan(ViewAngle * Pi / 360) / size;
  for (int a = 0; a < 3; ++a)
  {
    grid.Origin[a] = center[a] - distance * view[a];
    grid.DirectionStepX[a] = step * right[a];
    grid.DirectionStepY[a] = step * up[a];
    grid.Direction[a] = view[a] - 0.5 * step * (size - 1) * (right[a] + up[a]);
  }
  return scene;
}

ImageOptics MakeOptics(const Ramp& ramp, double unitDistance)
{
  ImageOptics optics;
  for (const auto& [scalar, opacity] : ramp)
  {
    const double t = (scalar - ramp.front().first) / (ramp.back().first - ramp.front().first);
    const TransferFunction::Value value{ { 0.9, 0.3 + 0.6 * t, 0.2 + 0.7 * t }, opacity };
    optics.Function.Nodes.push_back({ scalar, value, value });
  }
  optics.UnitDistance = unitDistance;
  return optics;
}

double GetProcessorSeconds()
{
  timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// One row: median time of a picture by one thread, samples, and the error by EstimateImageError.
void Measure(const std::string& scene, const std::string& variant, ImageCaster& caster,
  const RayGrid& grid, const ImageCasterOptions& options)
{
  const std::size_t pixels = static_cast<std::size_t>(grid.Width) * grid.Height;
  std::vector<float> colors(4 * pixels);
  std::vector<float> depths(pixels);
  std::vector<double> seconds;
  ImageCastStatistics statistics;
  caster.Cast(grid, {}, options, colors, depths); // what is kept is made
  for (int i = 0; i < NumberOfPictures; ++i)
  {
    const double start = GetProcessorSeconds();
    statistics = caster.Cast(grid, {}, options, colors, depths);
    seconds.push_back(GetProcessorSeconds() - start);
  }
  std::sort(seconds.begin(), seconds.end());
  ImageCasterOptions exact = options;
  exact.PreIntegrated = false;
  exact.CorrectOpacity = true;
  const ImageError error = EstimateImageError(caster, grid, {}, exact, Span<const float>(colors));
  std::printf("%s,%s,%.2f,%.3f,%lld,%.5f,%.6f\n", scene.c_str(), variant.c_str(),
    1e3 * seconds[seconds.size() / 2], 1e-6 * static_cast<double>(statistics.Samples),
    static_cast<long long>(statistics.Triangles), error.Largest, error.Mean);
  std::fflush(stdout);
}

/// One byte a cell: whether a corner has an opacity.
template <class Value>
std::vector<std::uint8_t> FindVisibleCells(const ImageVolume& volume, double lowest)
{
  const int* size = volume.Dimensions;
  const auto* values = static_cast<const Value*>(volume.Values);
  std::vector<std::uint8_t> visible;
  for (int k = 0; k + 1 < size[2]; ++k)
  {
    for (int j = 0; j + 1 < size[1]; ++j)
    {
      for (int i = 0; i + 1 < size[0]; ++i)
      {
        bool any = false;
        for (int corner = 0; corner < 8; ++corner)
        {
          const std::size_t at =
            (static_cast<std::size_t>(k + (corner >> 2)) * size[1] + j + (corner >> 1 & 1)) *
              size[0] +
            i + (corner & 1);
          any = any || static_cast<double>(values[at]) > lowest;
        }
        visible.push_back(any ? 1 : 0);
      }
    }
  }
  return visible;
}

/// Hulls in place of blocks: what making and rasterising them takes, and the picture.
void StudyHulls(const std::string& name, const Scene& scene, const Ramp& ramp, ImageCaster& caster,
  const ImageCasterOptions& options)
{
  constexpr std::size_t FewTriangles = 500; // the paper's several hundred
  const int* size = scene.Volume.Dimensions;
  const int cells[3] = { size[0] - 1, size[1] - 1, size[2] - 1 };
  const std::vector<std::uint8_t> visible = scene.Volume.Type == ImageScalar::UInt8
    ? FindVisibleCells<std::uint8_t>(scene.Volume, ramp.front().first)
    : FindVisibleCells<std::uint16_t>(scene.Volume, ramp.front().first);
  const SlicePlanes planes =
    MakeSlicePlanes(scene.Volume, scene.Grid, options.Shape, options.SampleDistance);
  for (const bool tight : { true, false })
  {
    const double start = GetProcessorSeconds();
    const VisibleHull hull =
      tight ? MakeVisibleHull(cells, visible, 1) : MakeCoarseHull(cells, visible, FewTriangles);
    const double made = GetProcessorSeconds();
    const HullDepths depths = FindDepthsOfPixels(
      Span<const VisibleHull>(&hull, 1), scene.Grid, planes, options.TileSize, 1);
    const double rasterised = GetProcessorSeconds();
    const std::string variant = tight ? "tight hull" : "coarse hull";
    std::printf("%s,%s of %zu triangles: made; rasterised,%.2f,%.2f,,,\n", name.c_str(),
      variant.c_str(), hull.GetNumberOfTriangles(), 1e3 * (made - start),
      1e3 * (rasterised - made));
    ImageCasterOptions hulls = options;
    hulls.SkipEmptySpace = false;
    hulls.Hulls = &depths;
    Measure(name, variant, caster, scene.Grid, hulls);
  }
}

void StudyIdeas(const std::string& name, const Scene& scene, const Ramp& ramp)
{
  ImageCaster caster;
  caster.SetVolume(scene.Volume);
  caster.SetOptics(MakeOptics(ramp, scene.Spacing));
  ImageCasterOptions options;
  options.SampleDistance = scene.Spacing / SlicesPerVoxel;
  options.NumberOfThreads = 1;
  using Change = std::function<void(ImageCasterOptions&)>;
  const std::vector<std::pair<std::string, Change>> changes = {
    { "all", [](ImageCasterOptions&) {} },
    { "no empty space", [](ImageCasterOptions& o) { o.SkipEmptySpace = false; } },
    { "no OP", [](ImageCasterOptions& o) { o.SkipPixels = false; } },
    { "no OP; no TT", [](ImageCasterOptions& o) { o.SkipPixels = o.EndTriangles = false; } },
    { "no early end", [](ImageCasterOptions& o) { o.Threshold = 0; } },
    { "triangles", [](ImageCasterOptions& o) { o.Triangles = true; } },
    { "tiles of 4", [](ImageCasterOptions& o) { o.TileSize = 4; } },
    { "tiles of 16", [](ImageCasterOptions& o) { o.TileSize = 16; } },
    { "tiles of 32", [](ImageCasterOptions& o) { o.TileSize = 32; } },
    { "tiles of 64", [](ImageCasterOptions& o) { o.TileSize = 64; } },
    { "shells", [](ImageCasterOptions& o) { o.Shape = SliceShape::Shells; } },
    { "uncorrected planes", [](ImageCasterOptions& o) { o.CorrectOpacity = false; } },
    { "slabs", [](ImageCasterOptions& o) { o.PreIntegrated = true; } },
  };
  for (const auto& [variant, change] : changes)
  {
    ImageCasterOptions changed = options;
    change(changed);
    Measure(name, variant, caster, scene.Grid, changed);
  }
  StudyHulls(name, scene, ramp, caster, options);
}

/// Voxels that texture coordinates are off after a number of additions in single precision, where
/// they begin at 0 and go through a volume of so many voxels: the largest over directions.
void StudyDrift()
{
  constexpr int NumberOfDirections = 1000;
  for (const int voxels : { 256, 512, 1024 })
  {
    double increments = 0;
    double products = 0;
    double blocks = 0;
    const int slices = static_cast<int>(voxels * SlicesPerVoxel);
    for (int d = 0; d < NumberOfDirections; ++d)
    {
      const double exactStep = (0.5 + 0.5 * d / NumberOfDirections) / SlicesPerVoxel;
      const auto step = static_cast<float>(exactStep);
      float sum = 0;
      for (int n = 1; n <= slices; ++n)
      {
        sum += step;
        const double exact = n * exactStep;
        // From the last of every 16 slices, found in double precision.
        const double corner = std::floor((n & ~15) * exactStep);
        const auto base = static_cast<float>((n & ~15) * exactStep - corner);
        const float within = std::fma(step, static_cast<float>(n & 15), base);
        increments = std::max(increments, std::abs(sum - exact));
        products =
          std::max(products, std::abs(static_cast<double>(step * static_cast<float>(n)) - exact));
        blocks = std::max(blocks, std::abs(within + corner - exact));
      }
    }
    std::printf("drift of %d voxels,additions;products;blocks of 16,%.2e,%.2e,%.2e,,\n", voxels,
      increments, products, blocks);
  }
}

/// The largest error of a pixel that composites equal samples in a buffer of so many bits, over
/// opacities from 1/1000 to 1: front to back with a translucency, and back to front without.
void StudyBuffer()
{
  for (const int bits : { 8, 16, 24 })
  {
    const double steps = std::exp2(bits) - 1;
    const auto round = [steps](double x) { return std::floor(x * steps + 0.5) / steps; };
    double front = 0;
    double back = 0;
    for (int i = 0; i <= 60; ++i)
    {
      const double opacity = std::pow(10., -3 + i / 20.);
      for (const int samples : { 64, 256, 1024 })
      {
        const double exact = -std::expm1(samples * std::log1p(-std::min(opacity, 1 - 1e-12)));
        double color = 0;
        double translucency = 1;
        double behind = 0;
        for (int n = 0; n < samples; ++n)
        {
          color = round(color + translucency * opacity);
          translucency = round(translucency - translucency * opacity);
          behind = round(behind + (1 - behind) * opacity);
        }
        front = std::max(front, std::abs(color - exact));
        back = std::max(back, std::abs(behind - exact));
      }
    }
    std::printf("buffer of %d bits,front to back;back to front,%.2e,%.2e,,,\n", bits, front, back);
  }
}

} // namespace

int main(int argc, char** argv)
{
  try
  {
    const char* folder = std::getenv("TETRALUX_DATA");
    if (!folder)
    {
      std::fprintf(stderr, "TETRALUX_DATA has to name the folder of the data sets\n");
      return 2;
    }
    const int size = argc > 1 ? std::atoi(argv[1]) : DefaultSize;
    if (size < 1)
    {
      std::fprintf(stderr, "usage: ImageStudy [pixels along an edge]\n");
      return 2;
    }
    std::printf("scene,variant,milliseconds,million samples,triangles,largest error,mean error\n");
    StudyDrift();
    StudyBuffer();
    for (const DataSet& set : ReadDataSets(folder))
    {
      const Scene scene = MakeScene(set.Image, size);
      StudyIdeas(set.Name + " opaque", scene, set.Opaque);
      StudyIdeas(set.Name + " translucent", scene, set.Translucent);
    }
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
