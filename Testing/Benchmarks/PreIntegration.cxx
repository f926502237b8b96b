// SPDX-License-Identifier: BSD-3-Clause

// Pre-integration tables: how long they take beside vtkUnstructuredGridPreIntegration, beside
// computing each entry by itself and beside writing the memory; how wrong they are for each byte,
// by axis, scale and format; and what a lookup costs beside the closed form.

#include "IncrementalTable.h"
#include "Integral/RayIntegral.h"
#include "Integral/SegmentIntegral.h"
#include "ModelRays.h"
#include "PreIntegration/PreIntegrationBuilder.h"
#include "PreIntegration/PreIntegrationError.h"
#include "PreIntegration/TableChoice.h"
#include "Simd/InstructionSet.h"

#include "vtkCellArray.h"
#include "vtkColorTransferFunction.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"
#include "vtkUnstructuredGridPreIntegration.h"
#include "vtkUnstructuredGridVolumeMapper.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace
{

using namespace tetralux;
using Value = TransferFunction::Value;

constexpr int ScalarSize = 128;
constexpr int LengthSize = 256;
constexpr std::size_t Texels = std::size_t{ ScalarSize } * ScalarSize * LengthSize;

/// The longest segment, world units.
constexpr double Longest = 1;

/// Seconds: of one thread processor time, which others on the machine change little.
double Now()
{
  if (omp_get_max_threads() == 1)
  {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Milliseconds, the least of some runs.
double Time(int runs, const std::function<void()>& work)
{
  double least = 1e30;
  for (int i = 0; i < runs; ++i)
  {
    const double begin = Now();
    work();
    least = std::min(least, Now() - begin);
  }
  return 1e3 * least;
}

struct Function
{
  const char* Name;
  TransferFunction Nodes;
};

/// Attenuation up and down, colours from one side of the range to the other.
TransferFunction MakeWaves(int nodes, double attenuation)
{
  TransferFunction function;
  for (int k = 0; k < nodes; ++k)
  {
    const double x = static_cast<double>(k) / (nodes - 1);
    const Value value = { { x, 1 - x, 0.5 }, attenuation * (0.2 + 0.8 * (k % 2)) };
    function.Nodes.push_back({ x, value, value });
  }
  return function;
}

TransferFunction MakeNeedle(double halfWidth, double attenuation)
{
  const auto value = [](double tau) { return Value{ { 1, 0.5, 0.2 }, tau }; };
  constexpr double Center = 0.4;
  return { { { 0, value(0), value(0) }, { Center - halfWidth, value(0), value(0) },
    { Center, value(attenuation), value(attenuation) }, { Center + halfWidth, value(0), value(0) },
    { 1, value(0), value(0) } } };
}

TransferFunction MakeSteps(double attenuation)
{
  const Value a{ { 1, 0, 0 }, 0.1 * attenuation }, b{ { 0, 1, 0 }, attenuation },
    c{ { 0, 0, 1 }, 0.3 * attenuation };
  return { { { 0, a, a }, { 0.37, a, b }, { 0.71, b, c }, { 1, c, c } } };
}

/// Largest error of the table's entries; get(front, back, length, rgba).
template <class Get>
double GetEntryError(const TransferFunction& function, const Get& get)
{
  std::mt19937_64 generator(1);
  double worst = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const int f = static_cast<int>(generator() % ScalarSize);
    const int b = static_cast<int>(generator() % ScalarSize);
    const int r = static_cast<int>(generator() % LengthSize);
    float rgba[4];
    get(f, b, r, rgba);
    const SegmentRadiance exact =
      IntegrateEmissionAbsorption(function, static_cast<double>(f) / (ScalarSize - 1),
        static_cast<double>(b) / (ScalarSize - 1), Longest * r / (LengthSize - 1));
    worst = std::max(worst, std::abs(exact.Opacity - rgba[3]));
    for (int c = 0; c < 3; ++c)
    {
      worst = std::max(worst, std::abs(exact.Color[c] - rgba[c]));
    }
  }
  return worst;
}

/// All that VTK's table asks of a mapper: its input.
class InputOnlyMapper : public vtkUnstructuredGridVolumeMapper
{
public:
  static InputOnlyMapper* New() { VTK_STANDARD_NEW_BODY(InputOnlyMapper); }
  void Render(vtkRenderer*, vtkVolume*) override {}
};

/// VTK's table of a function.
class VtkTable
{
public:
  explicit VtkTable(const TransferFunction& function)
  {
    vtkNew<vtkPiecewiseFunction> opacity;
    vtkNew<vtkColorTransferFunction> color;
    for (const TransferFunction::Node& node : function.Nodes)
    {
      opacity->AddPoint(node.Scalar, node.Right.Attenuation);
      color->AddRGBPoint(
        node.Scalar, node.Right.Color[0], node.Right.Color[1], node.Right.Color[2]);
    }
    this->Property->SetScalarOpacity(opacity);
    this->Property->SetColor(color);
    // One cell with a bounding box whose diagonal is the longest segment.
    const double side = Longest / std::sqrt(3.);
    vtkNew<vtkPoints> points;
    points->InsertNextPoint(0, 0, 0);
    points->InsertNextPoint(side, 0, 0);
    points->InsertNextPoint(0, side, 0);
    points->InsertNextPoint(0, 0, side);
    vtkNew<vtkUnstructuredGrid> grid;
    grid->SetPoints(points);
    const vtkIdType ids[4] = { 0, 1, 2, 3 };
    grid->InsertNextCell(VTK_TETRA, 4, ids);
    this->Scalars->InsertNextValue(0);
    this->Scalars->InsertNextValue(1);
    vtkNew<InputOnlyMapper> mapper;
    mapper->SetInputData(grid);
    this->Volume->SetMapper(mapper);
    this->Volume->SetProperty(this->Property);
    this->Table->SetIntegrationTableScalarResolution(ScalarSize);
    this->Table->SetIntegrationTableLengthResolution(LengthSize);
    this->Build();
  }
  void Build()
  {
    this->Property->Modified();
    this->Table->Initialize(this->Volume, this->Scalars);
  }
  void Get(int f, int b, int r, float rgba[4])
  {
    std::copy_n(this->Table->GetIndexedTableEntry(f, b, r, 0), 4, rgba);
  }
  vtkUnstructuredGridPreIntegration* GetTable() { return this->Table; }

private:
  vtkNew<vtkVolumeProperty> Property;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkDoubleArray> Scalars;
  vtkNew<vtkUnstructuredGridPreIntegration> Table;
};

/// Each entry by itself, sampled at the step of the lengths, the distance at which increments add
/// up: samples of colour and opacity of one step from a table of 1024, in the middle of the steps.
void SampleEntries(const TransferFunction& function, std::vector<float>& table)
{
  constexpr int Samples = 1024;
  std::vector<float> steps(4 * Samples);
  for (int i = 0; i < Samples; ++i)
  {
    const double s = static_cast<double>(i) / (Samples - 1);
    const SegmentRadiance step =
      IntegrateEmissionAbsorption(function, s, s, Longest / (LengthSize - 1));
    std::copy_n(step.Color, 3, &steps[4 * i]);
    steps[4 * i + 3] = static_cast<float>(step.Opacity);
  }
  table.resize(4 * Texels);
#pragma omp parallel for schedule(dynamic)
  for (int row = LengthSize * ScalarSize - 1; row >= 0; --row) // the longest first
  {
    const int r = row / ScalarSize;
    const float back = static_cast<float>(row % ScalarSize) / (ScalarSize - 1);
    for (int f = 0; f < ScalarSize; ++f)
    {
      const float front = static_cast<float>(f) / (ScalarSize - 1);
      float color[4] = { 0, 0, 0, 0 };
      const float slope = r > 0 ? (back - front) / static_cast<float>(r) : 0.f;
      for (int k = 0; k < r; ++k)
      {
        const float s = front + (static_cast<float>(k) + 0.5f) * slope;
        const float place = s * (Samples - 1) + 0.5f; // of the nearest one, when cut off
        const float* step = &steps[4 * static_cast<int>(place)];
        const float behind = 1.f - color[3];
        for (int c = 0; c < 4; ++c)
        {
          color[c] += behind * step[c];
        }
      }
      std::copy_n(color, 4, &table[4 * (static_cast<std::size_t>(row) * ScalarSize + f)]);
    }
  }
}

/// Each entry by itself, by the closed form in double precision.
void IntegrateEntries(const TransferFunction& function, std::vector<float>& table)
{
  table.resize(4 * Texels);
#pragma omp parallel for schedule(dynamic)
  for (int row = 0; row < LengthSize * ScalarSize; ++row)
  {
    const double length = Longest * (row / ScalarSize) / (LengthSize - 1);
    const double back = static_cast<double>(row % ScalarSize) / (ScalarSize - 1);
    for (int f = 0; f < ScalarSize; ++f)
    {
      const SegmentRadiance entry = IntegrateEmissionAbsorption(
        function, static_cast<double>(f) / (ScalarSize - 1), back, length);
      float* texel = &table[4 * (static_cast<std::size_t>(row) * ScalarSize + f)];
      std::copy_n(entry.Color, 3, texel);
      texel[3] = static_cast<float>(entry.Opacity);
    }
  }
}

/// Writing the bytes of a table once: into new memory, and again.
void MeasureMemory(double& first, double& again)
{
  first = again = 1e30;
  const std::size_t bytes = 16 * Texels;
  for (int i = 0; i < 5; ++i)
  {
    TexelBuffer buffer;
    const double begin = Now();
    buffer.Resize(bytes);
    const auto write = [&](int value)
    {
      const int threads = omp_get_max_threads();
#pragma omp parallel for
      for (int t = 0; t < threads; ++t)
      {
        const std::size_t from = bytes / threads * t;
        std::memset(buffer.GetData() + from, value, bytes / threads);
      }
    };
    write(1);
    first = std::min(first, 1e3 * (Now() - begin));
    again = std::min(again, Time(3, [&]() { write(2); }));
  }
}

void CompareTimes()
{
  std::printf("Times of a table of %d x %d x %d in single precision, 67 MB, milliseconds\n\n",
    ScalarSize, ScalarSize, LengthSize);
  const Function functions[] = { { "5 nodes", MakeWaves(5, 3) }, { "20 nodes", MakeWaves(20, 3) },
    { "needle", MakeNeedle(0.01, 50) }, { "5 nodes, thick", MakeWaves(5, 100) },
    { "200 nodes", MakeWaves(200, 3) } };
  const int most = omp_get_max_threads();
  for (int threads = 1; threads <= most; ++threads)
  {
    omp_set_num_threads(threads);
    double first, again;
    MeasureMemory(first, again);
    std::printf("%d thread(s), %s time; writing the memory: new %.1f, again %.1f\n", threads,
      threads == 1 ? "processor" : "wall", first, again);
    std::printf("%-16s %-28s %9s %9s %9s %12s\n", "function", "method", "new", "again", "VTK/new",
      "entry error");
    for (const Function& function : functions)
    {
      VtkTable vtk(function.Nodes);
      const double vtkTime = Time(5, [&]() { vtk.Build(); });
      std::printf("%-16s %-28s %9.1f %9s %9s %12.1e\n", function.Name, "VTK, increments (1 thread)",
        vtkTime, "", "",
        GetEntryError(
          function.Nodes, [&](int f, int b, int r, float* rgba) { vtk.Get(f, b, r, rgba); }));
      for (const bool increments : { false, true })
      {
        PreIntegrationSettings settings;
        settings.Axis = ScalarAxis::Uniform;
        settings.LongestSegment = Longest;
        PreIntegrationTable table;
        const auto build = [&]()
        {
          (increments ? BuildIncrementalTable : BuildPreIntegrationTable)(
            function.Nodes, settings, table);
        };
        const double newTime = Time(5,
          [&]()
          {
            table = PreIntegrationTable();
            build();
          });
        std::printf("%-16s %-28s %9.1f %9.1f %9.1f %12.1e\n", function.Name,
          increments ? "increments" : "closed form", newTime, Time(5, build), vtkTime / newTime,
          GetEntryError(function.Nodes,
            [&](int f, int b, int r, float* rgba) { table.GetTexel(f, b, r, rgba); }));
      }
      if (&function == functions)
      {
        // Takes seconds; sampling does not depend on the function.
        std::vector<float> entries;
        const auto get = [&](int f, int b, int r, float* rgba)
        {
          std::copy_n(
            &entries[4 * ((static_cast<std::size_t>(r) * ScalarSize + b) * ScalarSize + f)], 4,
            rgba);
        };
        const double sampled = Time(1, [&]() { SampleEntries(function.Nodes, entries); });
        std::printf("%-16s %-28s %9.1f %9s %9.3f %12.1e\n", function.Name, "each entry, sampled",
          sampled, "", vtkTime / sampled, GetEntryError(function.Nodes, get));
        const double exact = Time(1, [&]() { IntegrateEntries(function.Nodes, entries); });
        std::printf("%-16s %-28s %9.1f %9s %9.3f %12.1e\n", function.Name,
          "each entry, closed, double", exact, "", vtkTime / exact,
          GetEntryError(function.Nodes, get));
      }
    }
    std::printf("\n");
  }
}

RaySample DrawRays()
{
  RayModel model;
  model.PathLength = 10 * Longest;
  model.LongestSegment = Longest;
  return DrawModelRays(model);
}

const Function* GetAccuracyFunctions(int& count)
{
  static const Function functions[] = { { "5 nodes", MakeWaves(5, 3) },
    { "20 nodes", MakeWaves(20, 3) }, { "needle 0.02", MakeNeedle(0.01, 50) },
    { "needle 0.002", MakeNeedle(0.001, 100) }, { "needle 0.0002", MakeNeedle(0.0001, 100) },
    { "steps", MakeSteps(3) } };
  count = static_cast<int>(std::size(functions));
  return functions;
}

void CompareAxes()
{
  std::printf("Scalar axes: largest error of a segment / of a picture of model rays; 65 lengths\n\n"
              "%-14s %-8s %17s %17s %17s %17s\n",
    "function", "axis", "32 (1.1 MB)", "64 (4.3 MB)", "128 (17 MB)", "256 (68 MB)");
  int count;
  const Function* functions = GetAccuracyFunctions(count);
  for (int k = 0; k < count; ++k)
  {
    for (const ScalarAxis axis : { ScalarAxis::Uniform, ScalarAxis::Nodes })
    {
      std::printf(
        "%-14s %-8s", functions[k].Name, axis == ScalarAxis::Uniform ? "uniform" : "nodes");
      for (const int size : { 32, 64, 128, 256 })
      {
        PreIntegrationSettings settings;
        settings.ScalarSize = size;
        settings.LengthSize = 65;
        settings.Axis = axis;
        settings.LongestSegment = Longest;
        PreIntegrationTable table;
        BuildPreIntegrationTable(functions[k].Nodes, settings, table);
        std::printf(" %8.1e/%8.1e", EstimatePreIntegrationError(functions[k].Nodes, table).Segment,
          EstimatePictureError(functions[k].Nodes, table, DrawRays()));
      }
      std::printf("\n");
    }
  }
  std::printf("\n");
}

void CompareScales()
{
  std::printf("Length scales, 128 scalars on the nodes: largest error of a segment / for each unit "
              "of its length / of a picture\n\n%-14s %-20s %8s %30s\n",
    "function", "scale", "MB", "error");
  struct Scale
  {
    const char* Name;
    int Lengths, Steps;
  };
  const Scale scales[] = { { "linear 16", 16, 0 }, { "linear 32", 32, 0 }, { "linear 256", 256, 0 },
    { "doubling 16", 16, 1 }, { "doubling / 2, 16", 16, 2 }, { "doubling / 4, 32", 32, 4 },
    { "doubling / 8, 64", 64, 8 } };
  const Function functions[] = { { "5 nodes", MakeWaves(5, 3) },
    { "5 nodes, thick", MakeWaves(5, 100) } };
  for (const Function& function : functions)
  {
    for (const Scale& scale : scales)
    {
      PreIntegrationSettings settings;
      settings.LengthSize = scale.Lengths;
      settings.Scale = scale.Steps > 0 ? LengthScale::Logarithmic : LengthScale::Linear;
      settings.StepsPerDoubling = std::max(scale.Steps, 1);
      settings.LongestSegment = Longest;
      PreIntegrationTable table;
      BuildPreIntegrationTable(function.Nodes, settings, table);
      const PreIntegrationError error = EstimatePreIntegrationError(function.Nodes, table);
      std::printf("%-14s %-20s %8.1f %10.1e %10.1e %10.1e\n", function.Name, scale.Name,
        1e-6 * static_cast<double>(table.GetNumberOfBytes()), error.Segment, error.PerLength,
        EstimatePictureError(function.Nodes, table, DrawRays()));
    }
  }
  std::printf("\n");
}

void CompareFormats()
{
  std::printf("Formats, 128 scalars on the nodes, 256 lengths: bytes, milliseconds, error of a "
              "texel, of a picture\n\n");
  const char* names[] = { "8 bits", "16 bits", "half", "float" };
  const TransferFunction function = MakeWaves(5, 3);
  for (int k = 0; k < 4; ++k)
  {
    PreIntegrationSettings settings;
    settings.Format = static_cast<TexelFormat>(k);
    settings.LongestSegment = Longest;
    PreIntegrationTable table;
    const double time = Time(5, [&]() { BuildPreIntegrationTable(function, settings, table); });
    std::printf("%-8s %6.1f MB %6.1f ms %10.1e %10.1e\n", names[k],
      1e-6 * static_cast<double>(table.GetNumberOfBytes()), time,
      EstimatePreIntegrationError(function, table).Rounding,
      EstimatePictureError(function, table, DrawRays()));
  }
  std::printf("\n");
}

void CompareChoices()
{
  std::printf("Tables chosen for a picture's error; at most 64 MB\n\n%-14s %8s %-34s %8s %9s %6s\n",
    "function", "asked", "chosen", "MB", "measured", "ms");
  int count;
  const Function* functions = GetAccuracyFunctions(count);
  for (int k = 0; k < count; ++k)
  {
    for (const double maximumError : { 1e-2, 1e-3, 1e-4 })
    {
      TableGoal goal;
      goal.MaximumError = maximumError;
      goal.LookupCost = 0;
      goal.Rays = std::make_shared<RaySample>(DrawRays());
      goal.LongestSegment = Longest;
      TableChoice choice;
      const double time =
        Time(1, [&]() { choice = ChoosePreIntegrationTable(functions[k].Nodes, goal); });
      const char* formats[] = { "8 bits", "16 bits", "half", "float" };
      char text[64] = "closed form";
      double size = 0;
      if (choice.Table)
      {
        const PreIntegrationSettings& s = choice.Table->Settings;
        std::snprintf(text, sizeof(text), "%d^2 x %d%s, %s, %s", s.ScalarSize, s.LengthSize,
          s.Scale == LengthScale::Logarithmic ? " log" : "",
          s.Axis == ScalarAxis::Nodes ? "nodes" : "uniform", formats[static_cast<int>(s.Format)]);
        size = 1e-6 * static_cast<double>(choice.Table->GetNumberOfBytes());
      }
      std::printf("%-14s %8.0e %-34s %8.2f %9.1e %6.0f\n", functions[k].Name, maximumError, text,
        size, choice.PictureError, time);
    }
  }
  std::printf("\n");
}

} // namespace

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// Trilinear interpolation of eight segments, as a kernel would do it.
void LookUp(const float* texels, int n, Float8 f, Float8 b, Float8 r, const int (&last)[3],
  Float8 (&result)[4])
{
  const auto split = [](Float8 u, int most, Int8& index, Float8& share)
  {
    const Float8 lower =
      Min(ToFloat(RoundToInt(u - Float8(0.5f))), Float8(static_cast<float>(most)));
    const Float8 bounded = Max(lower, Float8(0.f));
    index = RoundToInt(bounded);
    share = u - bounded;
  };
  Int8 fi, bi, ri;
  Float8 ft, bt, rt;
  split(f, last[0] - 1, fi, ft);
  split(b, last[1] - 1, bi, bt);
  split(r, last[2] - 1, ri, rt);
  // n is a power of two here.
  int shift = 0;
  while (1 << shift < n)
  {
    ++shift;
  }
  const Int8 base = ShiftLeft(ShiftLeft(ri, shift) + bi, shift) + fi;
  const auto row = [&](int offset, Float8(&v)[4])
  {
    Float8 upper[4];
    GatherRows(texels, base + Int8(offset), v[0], v[1], v[2], v[3]);
    GatherRows(texels, base + Int8(offset + 1), upper[0], upper[1], upper[2], upper[3]);
    for (int c = 0; c < 4; ++c)
    {
      v[c] = Fma(ft, upper[c] - v[c], v[c]);
    }
  };
  const auto slice = [&](int offset, Float8(&v)[4])
  {
    Float8 upper[4];
    row(offset, v);
    row(offset + n, upper);
    for (int c = 0; c < 4; ++c)
    {
      v[c] = Fma(bt, upper[c] - v[c], v[c]);
    }
  };
  Float8 upper[4];
  slice(0, result);
  slice(n * n, upper);
  for (int c = 0; c < 4; ++c)
  {
    result[c] = Fma(rt, upper[c] - result[c], result[c]);
  }
}

/// Nanoseconds of eight segments by table and by the closed form on one piece, with coordinates at
/// hand: of neighbouring rays, whose segments are alike, and of any.
void CompareLookups()
{
  std::printf("Eight segments by one thread, nanoseconds\n\n%-24s %10s %10s %10s %10s\n", "",
    "1 MB", "4.2 MB", "17 MB", "67 MB");
  constexpr int Packets = 4096;
  for (const bool alike : { true, false })
  {
    std::printf("%-24s", alike ? "lookup, rays alike" : "lookup, any segments");
    for (const int lengths : { 4, 16, 64, 256 })
    {
      PreIntegrationSettings settings;
      settings.LengthSize = lengths;
      settings.Axis = ScalarAxis::Uniform;
      PreIntegrationTable table;
      BuildPreIntegrationTable(MakeWaves(5, 3), settings, table);
      std::mt19937_64 generator(1);
      std::uniform_real_distribution<float> unit(0, 1);
      std::vector<float> u(3 * Packets * LaneCount);
      for (int p = 0; p < Packets; ++p)
      {
        const float sizes[3] = { ScalarSize - 1.f, ScalarSize - 1.f,
          static_cast<float>(lengths - 1) };
        for (int a = 0; a < 3; ++a)
        {
          const float center = unit(generator);
          for (int i = 0; i < LaneCount; ++i)
          {
            const float near = std::clamp(center + 0.01f * (unit(generator) - 0.5f), 0.f, 1.f);
            u[(3 * p + a) * LaneCount + i] = sizes[a] * (alike ? near : unit(generator));
          }
        }
      }
      const auto* texels = reinterpret_cast<const float*>(table.Texels.GetData());
      const int last[3] = { ScalarSize - 1, ScalarSize - 1, lengths - 1 };
      float sum = 0;
      const double time = Time(10,
        [&]()
        {
          Float8 total = 0.f;
          for (int p = 0; p < Packets; ++p)
          {
            Float8 rgba[4];
            LookUp(texels, ScalarSize, LoadFloat8(&u[3 * p * LaneCount]),
              LoadFloat8(&u[(3 * p + 1) * LaneCount]), LoadFloat8(&u[(3 * p + 2) * LaneCount]),
              last, rgba);
            total = total + rgba[0] + rgba[1] + rgba[2] + rgba[3];
          }
          sum += Lane(total, 0);
        });
      std::printf(" %10.1f", 1e6 * time / Packets);
      if (sum == 0)
      {
        std::printf("?");
      }
    }
    std::printf("\n");
  }
  std::mt19937_64 generator(2);
  std::uniform_real_distribution<float> unit(0, 1);
  for (const float depth : { 0.3f, 5.f })
  {
    std::vector<float> d(2 * Packets * LaneCount);
    for (float& x : d)
    {
      x = depth * unit(generator);
    }
    float sum = 0;
    const double time = Time(10,
      [&]()
      {
        Float8 total = 0.f;
        for (int p = 0; p < Packets; ++p)
        {
          const SegmentWeights w = IntegrateSegment(
            LoadFloat8(&d[2 * p * LaneCount]), LoadFloat8(&d[(2 * p + 1) * LaneCount]));
          total = total + w.Front + w.Back * w.Transmittance;
        }
        sum += Lane(total, 0);
      });
    std::printf("%-24s %10.1f%s\n", depth < 1 ? "closed form, thin" : "closed form, any depth",
      1e6 * time / Packets, sum == 0 ? "?" : "");
  }
  std::printf("\n");
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

int main()
{
#ifdef __AVX2__
  if (tetralux::GetInstructionSet() != tetralux::InstructionSet::Avx2)
  {
    std::fprintf(
      stderr, "this program was compiled for AVX2, which this processor does not have\n");
    return 1;
  }
#endif
  std::setvbuf(stdout, nullptr, _IOLBF, 0); // slow: show what there is
  try
  {
    CompareTimes();
    omp_set_num_threads(1);
    CompareAxes();
    CompareScales();
    CompareFormats();
    CompareChoices();
    tetralux::TETRALUX_ISA::CompareLookups();
  }
  catch (const std::exception& e)
  {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
