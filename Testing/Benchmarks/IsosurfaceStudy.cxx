// SPDX-License-Identifier: BSD-3-Clause

// What Wald, Friedrich, Knoll and Hansen measured in Interactive Isosurface Ray Tracing of
// Time-Varying Tetrahedral Volumes, 2007, section 8, for one mesh and the isosurface tracer of this
// library, without a window. Prints CSV, one row for each number.
// Testing/Benchmarks/isosurface_study.py runs it for several meshes and sets the numbers beside
// those of the paper.

#include "Base/Stopwatch.h"
#include "CommandLine/CommandErrors.h"
#include "CommandLine/CommandOption.h"
#include "CommandLine/OptionValues.h"
#include "Hierarchy/MinMaxTree.h"
#include "Intake/TetrahedraIntake.h"
#include "Isosurfaces/IsosurfaceScene.h"
#include "Isosurfaces/StudyCase.h"
#include "PaperTraversal.h"

#include "vtkDoubleArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <omp.h>
#include <sys/resource.h>

using namespace tetralux;

namespace
{

constexpr int LargestNumberOfFrames = 1000;
constexpr int LargestSize = 8192;
constexpr int LargestNumberOfBuilds = 3; ///< of a tree, whose median counts

constexpr double Gigabyte = 1 << 30;

/// What a tetrahedron takes at least, with its mesh and trees, bytes.
constexpr double LeastBytesOfCell = 150;

/// TetrahedralMesh has fewer.
constexpr double LimitOfCells = 1 << 29;

constexpr int PaperLeafSize = 12; ///< section 5.1 of the paper
constexpr int LeafSizes[] = { 4, 8, 12, 16 };

constexpr int PaperPacketEdge = 16;
constexpr int PacketEdges[] = { 2, 4, 8, 16, 32 };

constexpr int Sizes[] = { 256, 512, 1024, 2048 };
constexpr int NumbersOfCopies[] = { 1, 2, 4, 8, 16 }; ///< along each axis

constexpr float Translucent = 0.5f;
constexpr int PaperLayers = 2; ///< that transparency shows by default (section 8.4)

/// Angle that a light of soft shadows is seen under, radians: six degrees.
constexpr double Softness = 0.1;

struct StudyOptions
{
  std::string Mesh;
  std::string Array;
  std::string Isovalue;
  std::string SecondIsovalue;
  std::vector<std::string> Parts;
  int Frames = 5;
  int Size = 1024;
  int Threads = 0;
  double Zoom = 1.2;
  double Memory = 4;
};

/// The present mesh, with what each row says of it.
struct Study
{
  const StudyOptions& Options;
  StudyMesh Mesh;
  ComparisonMesh Source; ///< in the order of its file

  void Print(const char* part, const std::string& name, const char* quantity, double value) const
  {
    this->Print(part, name, quantity, value, this->Options.Size, this->Options.Threads);
  }

  void Print(const char* part, const std::string& name, const char* quantity, double value,
    int size, int threads) const
  {
    std::printf("\"%s\",%d,%d,%d,%s,\"%s\",%s,%.9g\n", this->Options.Mesh.c_str(),
      this->Mesh.Mesh->GetNumberOfCells(), size, threads, part, name.c_str(), quantity, value);
    std::fflush(stdout);
  }

  /// A setting with the number of threads that was asked for.
  StudySettings MakeSettings(const std::string& name) const
  {
    StudySettings settings;
    settings.Name = name;
    settings.Options.NumberOfThreads = this->Options.Threads;
    // As the paper does by default (section 7).
    settings.Options.SmoothShading = false;
    // So that each frame traces its light, however many are measured.
    settings.Options.MaximumSamples = std::numeric_limits<int>::max();
    return settings;
  }

  std::unique_ptr<StudyCase> MakeCase(const StudySettings& settings) const
  {
    return std::make_unique<StudyCase>(
      this->Mesh, settings, this->Options.Size, this->Options.Zoom);
  }

  void MeasureAndPrint(const char* part, const StudyCases& cases) const
  {
    const std::vector<double> seconds = MeasureFrames(cases, this->Options.Frames);
    for (std::size_t c = 0; c < cases.size(); ++c)
    {
      const RayGrid& grid = cases[c]->GetGrid();
      const IsosurfaceStatistics& statistics = cases[c]->GetStatistics();
      const auto print = [&](const char* quantity, double value)
      {
        this->Print(
          part, cases[c]->GetName(), quantity, value, grid.Width, statistics.NumberOfThreads);
      };
      print("frames_per_second", 1 / seconds[c]);
      print("hits", static_cast<double>(statistics.Hits));
    }
  }
};

const char* GetName(TreeBuild build) { return build == TreeBuild::SpatialMedian ? "BIH" : "SAH"; }

const char* GetName(Isopolygons polygons)
{
  return polygons == Isopolygons::Precomputed ? "precomputed" : "on the fly";
}

constexpr TreeBuild Builds[] = { TreeBuild::SpatialMedian, TreeBuild::SurfaceArea };
constexpr Isopolygons PolygonWays[] = { Isopolygons::Precomputed, Isopolygons::OnTheFly };

//----------------------------------------------------------------------------
/// A tree with ranges, apart from the tracer.
struct StudyTree
{
  MinMaxTree Tree;
  MinMaxRanges Ranges;
};

MinMaxTree BuildTree(const StudyMesh& mesh, TreeBuild build, int leafSize, int threads)
{
  MinMaxTreeOptions options;
  options.Build = build;
  options.LeafSize = leafSize;
  options.NumberOfThreads = threads;
  return BuildMinMaxTree(
    mesh.Mesh->GetMesh(), mesh.Mesh->GetCenter(), mesh.Mesh->GetRadius(), options);
}

StudyTree MakeTree(const StudyMesh& mesh, TreeBuild build, int leafSize)
{
  StudyTree result;
  result.Tree = BuildTree(mesh, build, leafSize, 0);
  result.Ranges = MakeMinMaxRanges(result.Tree, mesh.Mesh->GetMesh(), mesh.Scalars, 0);
  return result;
}

PaperCounts Count(const StudyMesh& mesh, const StudyTree& tree, const RayGrid& grid, int edge,
  const PaperIdeas& ideas)
{
  const TetrahedralMesh& cells = mesh.Mesh->GetMesh();
  IsopolygonSource source;
  std::copy_n(mesh.Mesh->GetCenter(), 3, source.Frame.Center);
  source.Frame.Radius = mesh.Mesh->GetRadius();
  source.Points = cells.Points.data();
  source.Cells = cells.Cells.data();
  source.Scalars = mesh.Scalars.data();
  source.Values = &mesh.Isovalue;
  source.NumberOfValues = 1;
  return TraceAsPaper(tree.Tree, tree.Ranges, source, grid, edge, ideas);
}

void PrintCounts(
  const Study& study, const char* part, const std::string& name, const PaperCounts& counts)
{
  const std::pair<const char*, std::int64_t> quantities[] = {
    { "packets", counts.Packets },
    { "ray_box_tests", counts.RayBoxTests },
    { "ray_polygon_tests", counts.RayPolygonTests },
    { "node_range_tests", counts.NodeRangeTests },
    { "cell_range_tests", counts.CellRangeTests },
    { "extractions", counts.Extractions },
    { "box_frustum_tests", counts.BoxFrustumTests },
    { "box_frustum_misses", counts.BoxFrustumMisses },
    { "polygon_frustum_tests", counts.PolygonFrustumTests },
    { "polygon_frustum_misses", counts.PolygonFrustumMisses },
    { "hits", counts.Hits },
  };
  for (const auto& [quantity, value] : quantities)
  {
    study.Print(part, name, quantity, static_cast<double>(value));
  }
}

//----------------------------------------------------------------------------
/// Table 1: both ways to build a tree, and sizes of leaves. The tracer has one size; what the
/// others are worth is counted.
void StudyBuilds(const Study& study)
{
  StudyCases cases;
  for (const TreeBuild build : Builds)
  {
    for (const Isopolygons polygons : PolygonWays)
    {
      StudySettings settings =
        study.MakeSettings(std::string(GetName(build)) + ", " + GetName(polygons));
      settings.Options.Build = build;
      settings.Options.Polygons = polygons;
      cases.push_back(study.MakeCase(settings));
    }
  }
  study.MeasureAndPrint("build", cases);
  const RayGrid grid = cases.front()->GetGrid();
  cases.clear();

  std::vector<int> numbersOfThreads = { 1 };
  if (study.Options.Threads > 1)
  {
    numbersOfThreads.push_back(study.Options.Threads);
  }
  for (const TreeBuild build : Builds)
  {
    for (const int leafSize : LeafSizes)
    {
      const std::string name =
        std::string(GetName(build)) + ", leaves of " + std::to_string(leafSize);
      for (const int threads : numbersOfThreads)
      {
        std::vector<double> seconds;
        const int builds = std::min(study.Options.Frames, LargestNumberOfBuilds);
        for (int i = 0; i < builds; ++i)
        {
          const Stopwatch stopwatch;
          BuildTree(study.Mesh, build, leafSize, threads);
          seconds.push_back(stopwatch.GetSeconds());
        }
        study.Print("build", name, "build_milliseconds", 1000 * FindMedian(seconds),
          study.Options.Size, threads);
      }
      const StudyTree tree = MakeTree(study.Mesh, build, leafSize);
      study.Print("build", name, "nodes", static_cast<double>(tree.Tree.Nodes.size()));
      PrintCounts(study, "build", name, Count(study.Mesh, tree, grid, PaperPacketEdge, {}));
    }
  }
}

/// Table 2: frames of the mesh.
void StudyFrames(const Study& study)
{
  StudyCases cases;
  for (const Isopolygons polygons : PolygonWays)
  {
    StudySettings settings = study.MakeSettings(GetName(polygons));
    settings.Options.Polygons = polygons;
    cases.push_back(study.MakeCase(settings));
  }
  study.MeasureAndPrint("frames", cases);
}

/// The largest memory that this process had, bytes.
double GetPeakMemory()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1024. * static_cast<double>(usage.ru_maxrss);
}

/// Table 3: copies of the mesh, as many as the memory holds, by what fewer copies took.
void StudyCopies(Study& study)
{
  const StudyMesh first = study.Mesh;
  const double before = GetPeakMemory();
  const auto cells = static_cast<double>(study.Source.Mesh.GetNumberOfCells());
  double bytesOfCell = LeastBytesOfCell;
  for (const int count : NumbersOfCopies)
  {
    const double copied = cells * count * count * count;
    const double bytes = before + bytesOfCell * copied;
    const std::string name = std::to_string(count) + "^3";
    if (copied >= LimitOfCells || bytes > study.Options.Memory * Gigabyte)
    {
      std::cerr << study.Options.Mesh << ": " << name << " copies are left out, " << copied
                << " tetrahedra in about " << bytes / Gigabyte << " GB\n";
      break;
    }
    {
      ComparisonMesh copies = MakeCopies(study.Source, count);
      study.Mesh =
        MakeStudyMesh(std::move(copies.Mesh), copies.Scalars, first.Isovalue, first.SecondIsovalue);
    }
    // One after the other: each has a tree of its own.
    for (const Isopolygons polygons : PolygonWays)
    {
      StudySettings settings = study.MakeSettings(name + ", " + GetName(polygons));
      settings.Options.Polygons = polygons;
      StudyCases cases;
      cases.push_back(study.MakeCase(settings));
      study.MeasureAndPrint("copies", cases);
    }
    const double peak = GetPeakMemory();
    study.Print("copies", name, "peak_bytes", peak);
    bytesOfCell = std::max(LeastBytesOfCell, (peak - before) / copied);
  }
  study.Mesh = first;
}

/// Table 4: what the paper's traversal counts, and what the tracer does.
void StudyTraversal(const Study& study)
{
  StudyCases cases;
  for (const Isopolygons polygons : PolygonWays)
  {
    StudySettings settings = study.MakeSettings(std::string("tracer, ") + GetName(polygons));
    settings.Options.Polygons = polygons;
    settings.Options.PlaceOnce = false; // each packet by itself, as in the paper
    cases.push_back(study.MakeCase(settings));
    cases.back()->DrawFrame();
  }
  for (const auto& one : cases)
  {
    const TraceCounts& counts = one->GetStatistics().Primary;
    const std::pair<const char*, std::int64_t> quantities[] = {
      { "packets", counts.Packets },
      { "ray_polygon_tests", counts.RayPolygonTests },
      { "node_range_tests", counts.RangeTests },
      { "extractions", counts.Extractions },
      { "box_frustum_tests", counts.NodeTests },
      { "box_frustum_misses", counts.NodeMisses },
      { "polygon_frustum_tests", counts.Polygons },
      { "polygon_frustum_misses", counts.PolygonMisses },
      { "polygon_frustum_covers", counts.PolygonCovers },
      { "hits", one->GetStatistics().Hits },
    };
    for (const auto& [quantity, value] : quantities)
    {
      study.Print("traversal", one->GetName(), quantity, static_cast<double>(value));
    }
  }

  const RayGrid& grid = cases.front()->GetGrid();
  const StudyTree tree = MakeTree(study.Mesh, TreeBuild::SpatialMedian, PaperLeafSize);
  const auto count = [&](const std::string& name, int edge, const PaperIdeas& ideas)
  { PrintCounts(study, "traversal", name, Count(study.Mesh, tree, grid, edge, ideas)); };
  const auto nameSquare = [](int edge)
  { return std::to_string(edge) + "x" + std::to_string(edge); };

  PaperIdeas plain;
  plain.SpeculativeDescent = plain.FrustumTest = plain.FirstActiveRay = false;
  count("2x2 without II to IV", 2, plain);
  for (const int edge : PacketEdges)
  {
    count(nameSquare(edge), edge, {});
  }
  const std::pair<const char*, bool PaperIdeas::*> ideas[] = {
    { "I", &PaperIdeas::Bifurcations },
    { "II", &PaperIdeas::SpeculativeDescent },
    { "III", &PaperIdeas::FrustumTest },
    { "IV", &PaperIdeas::FirstActiveRay },
    { "V", &PaperIdeas::CellRanges },
  };
  for (const auto& [name, idea] : ideas)
  {
    PaperIdeas others;
    others.*idea = false;
    count(nameSquare(PaperPacketEdge) + " without " + name, PaperPacketEdge, others);
  }
}

/// Figure 8: effects, one after the other.
void StudyEffects(const Study& study)
{
  StudySettings settings = study.MakeSettings("a: one surface");
  StudyCases cases;
  cases.push_back(study.MakeCase(settings));
  settings.Name = "b: with shadows";
  settings.Options.Shadows = true;
  cases.push_back(study.MakeCase(settings));
  settings.Name = "c: with a second surface and a clip box";
  settings.SecondSurface = settings.ClipBox = true;
  cases.push_back(study.MakeCase(settings));
  settings.Name = "d: with transparency";
  settings.Opacity = Translucent;
  settings.Options.MaximumLayers = PaperLayers;
  cases.push_back(study.MakeCase(settings));
  study.MeasureAndPrint("effects", cases);
}

/// What each effect takes when it is on, alone.
void StudyCosts(const Study& study)
{
  std::vector<StudySettings> all;
  const auto add = [&](const char* name) -> StudySettings&
  {
    all.push_back(study.MakeSettings(name));
    return all.back();
  };
  add("flat");
  add("smooth").Options.SmoothShading = true;
  add("shadows").Options.Shadows = true;
  StudySettings& soft = add("soft shadows");
  soft.Options.Shadows = true;
  soft.Options.ShadowSoftness = Softness;
  add("ambient occlusion").Options.AmbientOcclusion = true;
  add("colour by another array").ColorArray = true;
  add("second surface").SecondSurface = true;
  StudySettings& translucent = add("second surface, translucent");
  translucent.SecondSurface = true;
  translucent.Opacity = Translucent;
  add("clip plane").ClipPlane = true;
  add("cropping").ClipBox = true;
  add("window depth").WindowDepths = true;
  StudyCases cases;
  for (const StudySettings& settings : all)
  {
    cases.push_back(study.MakeCase(settings));
  }
  study.MeasureAndPrint("costs", cases);
}

/// Section 8.2: speed over threads.
void StudyThreads(const Study& study)
{
  StudyCases cases;
  for (int threads = 1; threads <= study.Options.Threads; threads = threads == study.Options.Threads
         ? threads + 1
         : std::min(2 * threads, study.Options.Threads))
  {
    StudySettings settings = study.MakeSettings(std::to_string(threads) + " threads");
    settings.Options.NumberOfThreads = threads;
    cases.push_back(study.MakeCase(settings));
  }
  study.MeasureAndPrint("threads", cases);
}

/// The same: speed over pixels.
void StudySizes(const Study& study)
{
  StudyCases cases;
  for (const int size : Sizes)
  {
    cases.push_back(std::make_unique<StudyCase>(study.Mesh,
      study.MakeSettings(std::to_string(size) + "^2 pixels"), size, study.Options.Zoom));
  }
  study.MeasureAndPrint("pixels", cases);
}

struct Part
{
  const char* Name;
  void (*Run)(Study& study);
};

constexpr Part Parts[] = {
  { "build", [](Study& study) { StudyBuilds(study); } },
  { "frames", [](Study& study) { StudyFrames(study); } },
  { "copies", [](Study& study) { StudyCopies(study); } },
  { "traversal", [](Study& study) { StudyTraversal(study); } },
  { "effects", [](Study& study) { StudyEffects(study); } },
  { "costs", [](Study& study) { StudyCosts(study); } },
  { "threads", [](Study& study) { StudyThreads(study); } },
  { "pixels", [](Study& study) { StudySizes(study); } },
};

std::vector<std::string> ListParts()
{
  std::vector<std::string> names;
  for (const Part& part : Parts)
  {
    names.emplace_back(part.Name);
  }
  return names;
}

//----------------------------------------------------------------------------
ComparisonMesh ReadStudyMesh(const StudyOptions& options)
{
  const IsosurfaceScene scene =
    MakeIsosurfaceScene(options.Mesh, options.Array, ParseNumber("--isovalue", options.Isovalue));
  TetrahedraIntake intake = TakeInTetrahedra(scene.Grid);
  ComparisonMesh result;
  result.Name = options.Mesh;
  result.Mesh = std::move(intake.Mesh);
  vtkDoubleArray* scalars = scene.Steps.front();
  result.Scalars.resize(scalars->GetNumberOfValues());
  for (std::size_t p = 0; p < result.Scalars.size(); ++p)
  {
    result.Scalars[p] = scalars->GetValue(static_cast<vtkIdType>(p));
  }
  return result;
}

void Measure(const StudyOptions& options)
{
  ComparisonMesh source = ReadStudyMesh(options);
  StudyMesh mesh =
    MakeStudyMesh(source.Mesh, source.Scalars, ParseNumber("--isovalue", options.Isovalue),
      ParseNumber("--second-isovalue", options.SecondIsovalue));
  Study study{ options, std::move(mesh), std::move(source) };
  std::printf("mesh,tetrahedra,size,threads,part,case,quantity,value\n");
  for (const Part& part : Parts)
  {
    const auto& wanted = options.Parts;
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), part.Name) != wanted.end())
    {
      part.Run(study);
    }
  }
}

void AddOptions(CLI::App& app, StudyOptions& options)
{
  app
    .add_option("MESH", options.Mesh,
      "A generator with its parameters, as ring:around=600,across=32, or a file as tetralux render "
      "reads it")
    ->required()
    ->type_name("");
  app.add_option("--isovalue", options.Isovalue, "Scalar of the surface")
    ->required()
    ->type_name("V");
  app.add_option("--second-isovalue", options.SecondIsovalue, "Scalar of a second surface")
    ->required()
    ->type_name("V");
  app.add_option("--array", options.Array, "Array of a file's points")->type_name("NAME");
  app.add_option("--parts", options.Parts, "What is measured; default: all")
    ->delimiter(',')
    ->check(CLI::IsMember(ListParts()));
  AddOption(&app, "--frames", "Frames measured of each case; default: 5",
    [&options](const std::string& name, const std::string& text)
    { options.Frames = ParseInteger(name, text, 1, LargestNumberOfFrames); })
    ->type_name("N");
  AddOption(&app, "--size", "Pixels along an edge; default: 1024",
    [&options](const std::string& name, const std::string& text)
    { options.Size = ParseInteger(name, text, 1, LargestSize); })
    ->type_name("N");
  AddOption(&app, "--threads", "Threads; default: one for each processor",
    [&options](const std::string& name, const std::string& text)
    { options.Threads = ParseInteger(name, text, 1, omp_get_num_procs()); })
    ->type_name("N");
  AddOption(&app, "--zoom", "1 shows the whole bounding sphere; default: 1.2",
    [&options](const std::string& name, const std::string& text)
    { options.Zoom = ParsePositive(name, text); })
    ->type_name("Z");
  AddOption(&app, "--memory", "Gigabytes that copies of the mesh may take; default: 4",
    [&options](const std::string& name, const std::string& text)
    { options.Memory = ParsePositive(name, text); })
    ->type_name("GB");
}

} // namespace

int main(int argc, char* argv[])
try
{
  CLI::App app("Numbers of a paper on isosurfaces of tetrahedra, made anew", "IsosurfaceStudy");
  StudyOptions options;
  AddOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  if (options.Threads == 0)
  {
    options.Threads = omp_get_num_procs();
  }
  Measure(options);
  return 0;
}
catch (const std::exception& error)
{
  std::cerr << "IsosurfaceStudy: " << error.what() << "\n";
  return 1;
}
