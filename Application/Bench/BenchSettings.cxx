// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchSettings.h"

#include "Bench/BenchMappers.h"
#include "Bench/BenchOptions.h"
#include "Bench/BenchScene.h"
#include "CommandLine/CommandErrors.h"

#include "vtkImageData.h"

#include <algorithm>
#include <sstream>

namespace
{

using Assignments = std::vector<std::string>;

constexpr const char* ClosedForm = "Integration=closed-form";
constexpr const char* Table = "Integration=table";
constexpr const char* LinearLengths = "TableLengthScale=linear";
constexpr const char* LogarithmicLengths = "TableLengthScale=logarithmic";
constexpr const char* Format8Bit = "TableFormat=unorm8";
constexpr const char* Format16Bit = "TableFormat=unorm16";
constexpr const char* FormatHalf = "TableFormat=half";
constexpr const char* FormatFloat = "TableFormat=float";
constexpr const char* UniformScalars = "TableScalarAxis=uniform";
constexpr const char* ScalarsAtNodes = "TableScalarAxis=nodes";
constexpr const char* SinglePrecision = "Precision=single";
constexpr const char* DoublePrecision = "Precision=double";
constexpr const char* HalfBuffer = "ColorBuffer=half";
constexpr const char* EightBitBuffer = "ColorBuffer=unorm8";
constexpr const char* FloatBuffer = "ColorBuffer=float";
constexpr const char* ToTheEnd = "MaximumError=0";
constexpr const char* SlicesByError = "SampleDistanceByError=on";

/// Slices or samples of image data this far apart, units of the data.
std::string SetDistance(double distance)
{
  std::ostringstream text;
  text << "SampleDistance=" << distance;
  return text.str();
}

/// A table of given sizes, with further assignments.
Assignments MakeTable(int scalars, int lengths, const Assignments& others)
{
  Assignments assignments = { Table, "TableScalarSize=" + std::to_string(scalars),
    "TableLengthSize=" + std::to_string(lengths) };
  assignments.insert(assignments.end(), others.begin(), others.end());
  return assignments;
}

void AddErrorDial(std::vector<BenchSetting>& settings)
{
  const std::string group = "error asked for";
  for (const char* error : { "1e-2", "1e-3", "1e-4", "1e-5", "1e-6" })
  {
    settings.push_back({ std::string("error-") + error, group,
      std::string("MaximumError ") + error + ", all else automatic", "ray-cast",
      { std::string("MaximumError=") + error } });
  }
}

void AddArithmetic(std::vector<BenchSetting>& settings)
{
  const std::string group = "arithmetic and ends of rays";
  settings.push_back(
    { "single", group, "geometry in single precision", "ray-cast", { SinglePrecision } });
  settings.push_back(
    { "double", group, "geometry in double precision", "ray-cast", { DoublePrecision } });
  settings.push_back({ "no-termination", group,
    "early ray termination (Weiler 2003, section 3) switched off, in single precision", "ray-cast",
    { ClosedForm, SinglePrecision, ToTheEnd } });
}

void AddSampleDistances(std::vector<BenchSetting>& settings)
{
  const std::string group = "distance of rays";
  settings.push_back({ "sample-distance-2", group, "one ray for 2 x 2 pixels, interpolated",
    "ray-cast", { "ImageSampleDistance=2" } });
  settings.push_back({ "sample-distance-4", group, "one ray for 4 x 4 pixels, interpolated",
    "ray-cast", { "ImageSampleDistance=4" } });
}

/// Tables as in the papers, and with each of what they say is better switched off alone.
void AddTables(std::vector<BenchSetting>& settings)
{
  std::string group = "integral";
  settings.push_back({ "closed-form", group, "closed form between the nodes of the functions",
    "ray-cast", { ClosedForm } });
  settings.push_back({ "table", group, "table, its sizes and format by the error asked for",
    "ray-cast", { Table } });
  settings.push_back({ "table-1e-2", group, "the same for an error of 1e-2", "ray-cast",
    { Table, "MaximumError=1e-2" } });

  group = "table 256 x 256 x 16 (Kraus 2004)";
  settings.push_back(
    { "kraus", group, "as there: logarithmic lengths, 16 bit, uniform in the scalar", "ray-cast",
      MakeTable(256, 16, { LogarithmicLengths, Format16Bit, UniformScalars }) });
  settings.push_back({ "kraus-linear", group, "logarithmic lengths switched off", "ray-cast",
    MakeTable(256, 16, { LinearLengths, Format16Bit, UniformScalars }) });
  settings.push_back({ "kraus-8-bit", group, "more than 8 bit switched off", "ray-cast",
    MakeTable(256, 16, { LogarithmicLengths, Format8Bit, UniformScalars }) });
  settings.push_back({ "kraus-half", group, "half precision in place of 16 bit", "ray-cast",
    MakeTable(256, 16, { LogarithmicLengths, FormatHalf, UniformScalars }) });
  settings.push_back({ "kraus-float", group, "single precision in place of 16 bit", "ray-cast",
    MakeTable(256, 16, { LogarithmicLengths, FormatFloat, UniformScalars }) });
  settings.push_back({ "kraus-nodes", group, "scalars on the nodes of the functions, not uniform",
    "ray-cast", MakeTable(256, 16, { LogarithmicLengths, Format16Bit, ScalarsAtNodes }) });

  group = "table 128 x 128 x 256 (Weiler 2003)";
  settings.push_back({ "weiler", group, "as there: linear lengths, 8 bit, uniform in the scalar",
    "ray-cast", MakeTable(128, 256, { LinearLengths, Format8Bit, UniformScalars }) });
  settings.push_back({ "weiler-float", group, "single precision in place of 8 bit", "ray-cast",
    MakeTable(128, 256, { LinearLengths, FormatFloat, UniformScalars }) });

  group = "size of the table";
  for (const auto& [scalars, lengths] : { std::pair(32, 16), std::pair(64, 16), std::pair(128, 8),
         std::pair(128, 16), std::pair(128, 32), std::pair(256, 32) })
  {
    const std::string size = std::to_string(scalars) + "x" + std::to_string(lengths);
    settings.push_back({ "table-" + size, group,
      std::to_string(scalars) + " scalars on nodes, " + std::to_string(lengths) +
        " logarithmic lengths, single precision",
      "ray-cast",
      MakeTable(scalars, lengths, { LogarithmicLengths, FormatFloat, ScalarsAtNodes }) });
  }
}

void AddReentry(std::vector<BenchSetting>& settings)
{
  const std::string group = "how rays enter again";
  settings.push_back({ "reentry-hierarchy", group, "by a hierarchy of the boundary", "ray-cast",
    { "Reentry=boundary-hierarchy" } });
  settings.push_back({ "reentry-imaginary", group,
    "through imaginary cells of a convexified mesh (Weiler 2003, section 3.4)", "ray-cast",
    { "Reentry=imaginary-cells" } });
}

void AddGpuRayCast(std::vector<BenchSetting>& settings)
{
  const std::string group = "by OpenGL (Weiler 2003)";
  const std::string method = "gpu-ray-cast";
  settings.push_back({ method, group, "nothing set", method, {} });
  settings.push_back(
    { "gpu-no-termination", group, "early ray termination switched off", method, { ToTheEnd } });
  settings.push_back({ "gpu-imaginary", group, "through imaginary cells of a convexified mesh",
    method, { "Reentry=imaginary-cells" } });
  settings.push_back({ "gpu-layers", group, "by layers of the boundary, depth-peeled", method,
    { "Reentry=boundary-layers" } });
  settings.push_back({ "gpu-weiler", group,
    "table 128 x 128 x 256, linear lengths, 8 bit, uniform in the scalar, as in the paper", method,
    MakeTable(128, 256, { LinearLengths, Format8Bit, UniformScalars }) });
  settings.push_back({ "gpu-table-128x16", group,
    "table of 128 scalars on nodes, 16 logarithmic lengths, single precision", method,
    MakeTable(128, 16, { LogarithmicLengths, FormatFloat, ScalarsAtNodes }) });
}

/// With everything that the paper corrects switched off alone, and all of it at once.
void AddProjection(std::vector<BenchSetting>& settings)
{
  const std::string group = "projection (Kraus 2004)";
  const std::string method = "projection";
  const Assignments kraus = MakeTable(256, 16, { LogarithmicLengths, Format16Bit, UniformScalars });
  const auto with = [](Assignments assignments, const Assignments& others)
  {
    assignments.insert(assignments.end(), others.begin(), others.end());
    return assignments;
  };
  settings.push_back({ method, group, "nothing set: all corrections", method, {} });
  settings.push_back({ "projection-kraus", group,
    "as in the paper: table 256 x 256 x 16, logarithmic, 16 bit; 8-bit buffer with dithering",
    method, with(kraus, { EightBitBuffer }) });
  settings.push_back({ "projection-no-perspective", group, "perspective interpolation switched off",
    method, { "PerspectiveInterpolation=off" } });
  settings.push_back({ "projection-linear-table", group, "table with linear lengths, 16 bit",
    method, MakeTable(256, 16, { LinearLengths, Format16Bit, UniformScalars }) });
  settings.push_back({ "projection-8-bit-table", group, "table with 8 bit", method,
    MakeTable(256, 16, { LogarithmicLengths, Format8Bit, UniformScalars }) });
  settings.push_back(
    { "projection-float-buffer", group, "32-bit float buffer", method, { FloatBuffer } });
  settings.push_back(
    { "projection-half-buffer", group, "16-bit float buffer", method, { HalfBuffer } });
  settings.push_back({ "projection-8-bit-buffer", group, "8-bit buffer, no dithering", method,
    { EightBitBuffer, "AlphaDithering=off" } });
  settings.push_back(
    { "projection-dithered", group, "8-bit buffer, dithering", method, { EightBitBuffer } });
  settings.push_back({ "projection-mpvonc", group, "order across gaps guessed (MPVONC)", method,
    { "Order=non-convex" } });
  settings.push_back({ "projection-centroids", group, "order by distance of centroids", method,
    { "Order=centroid" } });
  settings.push_back({ "projection-plain", group,
    "all corrections off: linear interpolation, 8-bit table and buffer, order by centroids", method,
    with(MakeTable(256, 16, { LinearLengths, Format8Bit, UniformScalars }),
      { "PerspectiveInterpolation=off", EightBitBuffer, "AlphaDithering=off",
        "Order=centroid" }) });
}

void AddPeers(std::vector<BenchSetting>& settings)
{
  const std::string group = "mappers of VTK";
  settings.push_back({ "vtk-projected-tetrahedra", group, "vtkProjectedTetrahedraMapper",
    "vtk-projected-tetrahedra", {} });
  settings.push_back({ "vtk-bunyk", group,
    "vtkUnstructuredGridVolumeRayCastMapper (Bunyk) as it comes", "vtk-bunyk", {} });
  settings.push_back({ "vtk-bunyk-preintegration", group,
    "the same with vtkUnstructuredGridPreIntegration", "vtk-bunyk-preintegration", {} });
  settings.push_back({ "vtk-bunyk-closed-form", group,
    "the same with vtkTetrahedraRayIntegrator, the closed form", "vtk-bunyk-closed-form", {} });
}

/// What slices of image data are apart, beside the default of half a voxel and less.
void AddSliceDistances(double spacing, std::vector<BenchSetting>& settings)
{
  const std::string group = "distance of slices";
  for (const char* voxels : { "2", "1", "0.5", "0.25", "0.125" })
  {
    settings.push_back(
      { std::string("slices-") + voxels, group, std::string("slices ") + voxels + " voxels apart",
        "triangle-caster", { SetDistance(std::stod(voxels) * spacing) } });
  }
}

/// Ideas of Knittel 1999 and beyond, each switched on or off alone.
void AddTriangleCaster(std::vector<BenchSetting>& settings)
{
  const std::string method = "triangle-caster";
  std::string group = "error asked for";
  for (const char* error : { "1e-2", "1e-3", "1e-4" })
  {
    settings.push_back({ std::string("error-") + error, group,
      std::string("MaximumError ") + error + ", distance of slices by it", method,
      { SlicesByError, std::string("MaximumError=") + error } });
  }
  group = "ends of rays and empty space";
  settings.push_back({ "no-termination", group, "rays to their ends", method, { ToTheEnd } });
  settings.push_back({ "early-termination", group, "rays end at a translucency of 1/255", method,
    { "MaximumError=0.004" } });
  settings.push_back(
    { "no-empty-space", group, "empty space is sampled, too", method, { "SkipEmptySpace=off" } });
  group = "triangle caster (Knittel 1999)";
  settings.push_back(
    { "triangles", group, "tiles are cast in two triangles", method, { "CastTriangles=on" } });
  settings.push_back({ "shells", group, "shells in place of planes (section 1.1)", method,
    { "SliceShape=shells" } });
  settings.push_back({ "uncorrected", group,
    "opacity is that of a step along the normal of the planes (section 1.1)", method,
    { "CorrectOpacity=off" } });
  settings.push_back({ "slabs", group, "slabs from a pre-integration table (section 7)", method,
    { "PreIntegration=on" } });
  group = "distance of rays";
  settings.push_back({ "sample-distance-2", group, "one ray for 2 x 2 pixels, interpolated", method,
    { "ImageSampleDistance=2" } });
}

/// As they come but for the distance of slices, whose default is a world unit whatever the data.
void AddImagePeers(double spacing, std::vector<BenchSetting>& settings)
{
  const std::string group = "mappers of VTK";
  const struct
  {
    const char* Method;
    const char* Name;
  } peers[] = { { "vtk-fixed-point", "vtkFixedPointVolumeRayCastMapper" },
    { "vtk-gpu", "vtkGPUVolumeRayCastMapper" } };
  for (const auto& peer : peers)
  {
    for (const char* voxels : { "0.5", "0.125" })
    {
      settings.push_back({ std::string(peer.Method) + "-" + voxels, group,
        std::string(peer.Name) + ", samples " + voxels + " voxels apart", peer.Method,
        { SetDistance(std::stod(voxels) * spacing) } });
    }
  }
}

/// "Property=Value Property=Value", with a method before them or alone, as a setting of that name.
BenchSetting ReadSetting(const std::string& text)
{
  BenchSetting setting;
  setting.Name = text;
  setting.Group = "as asked for";
  std::istringstream words(text);
  bool first = true;
  for (std::string word; words >> word; first = false)
  {
    if (first && word.find('=') == std::string::npos)
    {
      setting.Method = word;
    }
    else
    {
      setting.Assignments.push_back(word);
    }
  }
  if (first)
  {
    throw UsageError("--setting: '" + text +
      "' is not Property=Value, or several with blanks between, with or without a method before "
      "them");
  }
  CheckSetting(setting);
  // A name of files, too.
  std::replace_if(
    setting.Name.begin(), setting.Name.end(),
    [](char c) { return c == ' ' || c == '/' || c == '='; }, '-');
  setting.Description = text;
  return setting;
}

/// The mean distance of points, units of the data.
double GetSpacing(vtkImageData* image)
{
  const double* spacing = image->GetSpacing();
  return (spacing[0] + spacing[1] + spacing[2]) / 3;
}

} // namespace

BenchSetting GetReferenceSetting(const BenchScene& scene)
{
  const std::string group = "reference";
  if (scene.IsOfImages())
  {
    return { ReferenceSettingName, group,
      "integral of the trilinear field along each ray, in double precision", "integral", {} };
  }
  return { ReferenceSettingName, group, "each cell's integral along each ray, in double precision",
    "integral", {} };
}

BenchData FindBenchData(const BenchOptions& options)
{
  BenchData data = BenchData::Any;
  std::string before;
  for (const std::string& text : options.Settings)
  {
    const BenchData found = RendersImages(ReadSetting(text)) ? BenchData::Images : BenchData::Cells;
    if (data != BenchData::Any && found != data)
    {
      throw UsageError("--setting: one of '" + before + "' and '" + text +
        "' renders image data, and the other one cells: a run has settings of one kind");
    }
    data = found;
    before = text;
  }
  return data;
}

std::vector<BenchSetting> ListSettings(const BenchOptions& options, const BenchScene& scene)
{
  std::vector<BenchSetting> settings;
  if (scene.IsOfImages())
  {
    settings.push_back({ DefaultSettingName, "default",
      "nothing set: slices at most half a voxel apart", "triangle-caster", {} });
  }
  else
  {
    settings.push_back({ DefaultSettingName, "default",
      "nothing set: an error of 1e-4, all else automatic", "ray-cast", {} });
  }
  for (const std::string& text : options.Settings)
  {
    settings.push_back(ReadSetting(text));
  }
  if (scene.IsOfImages())
  {
    const double spacing = GetSpacing(scene.Image);
    if (options.Settings.empty())
    {
      AddSliceDistances(spacing, settings);
      AddTriangleCaster(settings);
    }
    AddImagePeers(spacing, settings);
    return settings;
  }
  if (options.Settings.empty())
  {
    AddErrorDial(settings);
    AddArithmetic(settings);
    AddSampleDistances(settings);
    AddTables(settings);
    AddReentry(settings);
    AddGpuRayCast(settings);
    AddProjection(settings);
  }
  AddPeers(settings);
  return settings;
}
