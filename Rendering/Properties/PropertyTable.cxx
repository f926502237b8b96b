// SPDX-License-Identifier: BSD-3-Clause
#include "Properties/PropertyTable.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

namespace tetralux
{

namespace
{

constexpr double Unbounded = std::numeric_limits<double>::max();

/// Texels of a table along an axis; more than the second are not worth their memory.
constexpr double SmallestTableSize = 2;
constexpr double LargestTableSize = 4096;

/// Bytes of a table: 64 KiB, 1 TiB, and what leaves room for others in a small graphics memory.
constexpr double SmallestTableBytes = 65536;
constexpr double LargestTableBytes = 1099511627776;
constexpr double DefaultTableBytes = 67108864;

/// Bytes of what rays keep: a row of a small picture, 1 TiB, and a picture of 5,300 x 5,300 pixels.
constexpr double SmallestRayBytes = 4096;
constexpr double LargestRayBytes = 1099511627776;
constexpr double DefaultRayBytes = 1073741824;

/// The ends of AverageIPScalarRange, VTK_FLOAT_MAX.
constexpr double LargestAveraged = 1e38F;

constexpr const char* Quality = "Quality";
constexpr const char* Model = "Optical model";
constexpr const char* Table = "Pre-integration table";
constexpr const char* Cells = "Cells";
constexpr const char* Scalars = "Scalars";
constexpr const char* Rays = "Rays";
constexpr const char* Cropping = "Cropping";
constexpr const char* Projection = "Projection";
constexpr const char* Slices = "Slices";

MapperProperty MakeBoolean(
  const char* name, unsigned kinds, const char* group, bool advanced, bool on, const char* meaning)
{
  return { name, PropertyType::Boolean, kinds, group, advanced, {}, 0, 1, { on ? 1. : 0. }, "", "",
    meaning };
}

/// The first value is the default.
MapperProperty MakeEnumeration(const char* name, unsigned kinds, const char* group, bool advanced,
  const std::vector<NamedValue>& values, const char* meaning)
{
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end(),
    [](const NamedValue& a, const NamedValue& b) { return a.Number < b.Number; });
  return { name, PropertyType::Enumeration, kinds, group, advanced, values,
    static_cast<double>(lowest->Number), static_cast<double>(highest->Number),
    { static_cast<double>(values.front().Number) }, "", "", meaning };
}

MapperProperty MakeTableSize(const char* name, const char* meaning)
{
  return { name, PropertyType::Integer, VolumeKinds, Table, true,
    { { "automatic", 0, "the smallest that MaximumError allows" } }, SmallestTableSize,
    LargestTableSize, { 0 }, "", "texels", meaning };
}

MapperProperty MakeSampleDistance(const char* name, double value, const char* meaning)
{
  return { name, PropertyType::Real, AllKinds, Rays, true, {}, 0.1, 100, { value }, "", "pixels",
    meaning };
}

MapperProperty MakeColorFactors(const char* name, const char* meaning)
{
  return { name, PropertyType::Real, TriangleCasterKind, Model, true, {}, -Unbounded, Unbounded,
    { 1, 1, 1 }, "RED,GREEN,BLUE", "", meaning };
}

std::vector<MapperProperty> MakeProperties()
{
  return {
    MakeEnumeration("BlendMode", VolumeKinds | TriangleCasterKind, Model, false,
      { { "composite", 0, "emission and absorption" },
        { "maximum-intensity", 1, "colour and opacity of the largest scalar along a ray" },
        { "minimum-intensity", 2, "colour and opacity of the smallest scalar along a ray",
          TriangleCasterKind },
        { "average-intensity", 3, "mean of opacity times grey, over AverageIPScalarRange",
          TriangleCasterKind },
        { "additive", 4, "emission without absorption; of image data, of opacity times grey" },
        { "isosurface", 5, "the surfaces of the property's IsoSurfaceValues" },
        { "slice", 6, "colour and opacity on the plane of the property's SliceFunction",
          TriangleCasterKind },
        { "absorption", 16, "absorption without emission", VolumeKinds } },
      "What rays gather."),
    { "MaximumError", PropertyType::Real, AllKinds, Quality, false, {}, 0, 1, { 1e-4 }, "", "",
      "Largest absolute error of a premultiplied channel that is aimed at." },
    MakeEnumeration("Integration", VolumeKinds, Quality, true,
      { { "automatic", 0, "a table if it is faster and right enough, else the closed form" },
        { "closed-form", 1, "the closed form" }, { "table", 2, "a table in any case" } },
      "How segments of composite blending are integrated."),
    MakeTableSize("TableScalarSize", "Texels of a table along each of its two scalars."),
    MakeTableSize("TableLengthSize", "Texels of a table along the length of a segment."),
    MakeEnumeration("TableLengthScale", VolumeKinds, Table, true,
      { { "automatic", 0, "what MaximumError allows at the smallest size" },
        { "linear", 1, "equal steps (Weiler et al. 2003, section 4)" },
        { "logarithmic", 2, "steps that double (Kraus et al. 2004, section 3)" } },
      "Spacing of a table's texels along the length."),
    MakeEnumeration("TableScalarAxis", VolumeKinds, Table, true,
      { { "automatic", 0, "what MaximumError allows at the smallest size" },
        { "uniform", 1, "equal steps" }, { "nodes", 2, "on the nodes of the transfer function" } },
      "Spacing of a table's texels along the scalars."),
    MakeEnumeration("TableFormat", VolumeKinds, Table, true,
      { { "automatic", 0, "what MaximumError allows at the smallest size" },
        { "unorm8", 1, "8 bits a channel" }, { "unorm16", 2, "16 bits a channel" },
        { "half", 3, "16-bit floats" }, { "float", 4, "32-bit floats" } },
      "Format that a table's texels are rounded to."),
    { "TableMaximumBytes", PropertyType::Size, VolumeKinds, Table, true, {}, SmallestTableBytes,
      LargestTableBytes, { DefaultTableBytes }, "", "bytes", "Largest size of a table." },
    MakeBoolean("SmoothShading", CellKinds, Quality, false, true,
      "Take the normals of lighting from gradients that are interpolated between points."),
    MakeEnumeration("MergePoints", CellKinds, Cells, true,
      { { "automatic", 2, "all or none: none if scalars differ or cells overlap" },
        { "off", 0, "points stay apart" }, { "on", 1, "all whose scalars agree" } },
      "Whether points at the same place are taken as one."),
    MakeEnumeration("VectorMode", AllKinds, Scalars, false,
      { { "disabled", -1, "what the volume property says; of image data all of up to four" },
        { "magnitude", 0, "the Euclidean norm" }, { "component", 1, "component VectorComponent" } },
      "What of an array of several components is shown."),
    { "VectorComponent", PropertyType::Integer, AllKinds, Scalars, false, {}, 0,
      std::numeric_limits<int>::max(), { 0 }, "", "",
      "The component that VectorMode component takes, counted from 0." },
    MakeEnumeration("Reentry", RayCastKind | GPURayCastKind, Rays, true,
      { { "automatic", 0, "the fastest that is exact" },
        { "boundary-hierarchy", 1, "a hierarchy over the boundary faces" },
        { "imaginary-cells", 2,
          "cells between the mesh and its convex hull (Weiler et al. 2003, section 3.4)" },
        { "boundary-layers", 3, "depth-peeled boundary faces", GPURayCastKind },
        { "none", 4, "rays end where they leave: exact for convex meshes only", GPURayCastKind } },
      "How rays that left the mesh find where they enter it again."),
    MakeEnumeration("MaskType", TriangleCasterKind, Scalars, true,
      { { "label-map", 1, "which functions of labels a point has" },
        { "binary", 0, "there is nothing where it is 0" } },
      "What the MaskInput says."),
    { "MaskBlendFactor", PropertyType::Real, TriangleCasterKind, Scalars, true, {}, 0, 1, { 1 }, "",
      "", "Share of a label's functions in colour and opacity." },
    MakeBoolean("IntermixIntersectingGeometry", AllKinds, Rays, true, true,
      "End rays at opaque geometry that was drawn before."),
    MakeBoolean("Cropping", AllKinds, Cropping, false, false,
      "Render only the regions of CroppingRegionFlags."),
    { "CroppingRegionPlanes", PropertyType::Real, AllKinds, Cropping, false, {}, -Unbounded,
      Unbounded, { 0, 1, 0, 1, 0, 1 }, "XMIN,XMAX,YMIN,YMAX,ZMIN,ZMAX", "units of the data",
      "The six planes that cut space into 27 regions." },
    { "CroppingRegionFlags", PropertyType::Integer, AllKinds, Cropping, false,
      { { "sub-volume", 0x0002000, "between all planes" },
        { "fence", 0x2ebfeba, "all but the corners" },
        { "inverted-fence", 0x5140145, "the corners" },
        { "cross", 0x0417410, "between two pairs of planes at least" },
        { "inverted-cross", 0x7be8bef, "all others" } },
      0, 0x7ffffff, { 0x2000 }, "", "",
      "The regions that are rendered: bit x + 3 y + 9 z is region x, y, z." },
    MakeSampleDistance(
      "ImageSampleDistance", 1, "Distance of rays if AutoAdjustSampleDistances is off."),
    MakeSampleDistance(
      "MinimumImageSampleDistance", 1, "Smallest distance of rays that the adjustment chooses."),
    MakeSampleDistance(
      "MaximumImageSampleDistance", 10, "Largest distance of rays that the adjustment chooses."),
    MakeBoolean("AutoAdjustSampleDistances", AllKinds, Rays, true, true,
      "Adjust the distance of rays to the time that the renderer allocates."),

    { "NumberOfThreads", PropertyType::Integer, ProcessorKinds, Rays, true,
      { { "automatic", 0, "as many as OpenMP offers" } }, 1, 1024, { 0 }, "", "threads",
      "Threads that cast rays." },
    MakeEnumeration("Precision", RayCastKind, Quality, true,
      { { "automatic", 0, "single if MaximumError allows it, else double" },
        { "single", 1, "32-bit floats" }, { "double", 2, "64-bit floats" } },
      "Arithmetic of the geometry along rays."),

    { "ColorArrayComponent", PropertyType::Integer, IsosurfaceKind, Scalars, false,
      { { "magnitude", -1, "the Euclidean norm" } }, 0, std::numeric_limits<int>::max(), { -1 }, "",
      "", "Component of the array that surfaces are coloured by." },
    MakeBoolean("Shadows", IsosurfaceKind, Quality, false, false,
      "Surfaces block the light of lights, where Shade is on."),
    { "ShadowSoftness", PropertyType::Real, IsosurfaceKind, Quality, true, {}, 0, 90, { 0 }, "",
      "degrees", "Angle that lights are seen under from the centre of the data; 0: hard shadows." },
    MakeBoolean("AmbientOcclusion", IsosurfaceKind, Quality, false, false,
      "Surfaces block the light that comes from all around, where Shade is on."),
    { "AmbientOcclusionRadius", PropertyType::Real, IsosurfaceKind, Quality, true,
      { { "automatic", 0, "a tenth of the diameter of the data" } }, 0, Unbounded, { 0 }, "",
      "world units", "How far from a point surfaces block light for AmbientOcclusion." },
    { "SamplesPerFrame", PropertyType::Integer, IsosurfaceKind, Quality, true, {}, 1, 1000, { 4 },
      "", "samples",
      "Directions of AmbientOcclusion and points of soft lights that a frame takes." },
    { "MaximumSamples", PropertyType::Integer, IsosurfaceKind, Quality, true, {}, 1, 100000,
      { 256 }, "", "samples", "Samples after which a resting picture is not refined any more." },
    { "TimeStepCacheBytes", PropertyType::Size, IsosurfaceKind, Cells, true, {}, 0,
      LargestTableBytes, { 268435456 }, "", "bytes",
      "Largest size of the time steps that are kept beside the present one." },
    { "MaximumNumberOfPeels", PropertyType::Integer, IsosurfaceKind, Rays, true,
      { { "automatic", 0, "as many as MaximumError asks for" } }, 1, 1000, { 0 }, "", "surfaces",
      "Surfaces that a ray meets at most." },

    { "StepsPerPass", PropertyType::Integer, GPURayCastKind, Rays, true, {}, 1, 65535, { 128 }, "",
      "cells", "Cells that a ray passes in one draw call at most." },
    { "RayMaximumBytes", PropertyType::Size, GPURayCastKind, Rays, true, {}, SmallestRayBytes,
      LargestRayBytes, { DefaultRayBytes }, "", "bytes",
      "Largest size of what rays keep between draw calls; larger pictures are cast in bands." },
    MakeBoolean("CountFragments", GPURayCastKind, Rays, true, false,
      "Count the rays of every pass, which waits for each pass."),

    MakeBoolean("PerspectiveInterpolation", ProjectionKind, Projection, true, true,
      "Interpolate with perspective correction (Kraus et al. 2004, section 2)."),
    MakeEnumeration("ColorBuffer", ProjectionKind, Projection, true,
      { { "automatic", 0, "half if MaximumError allows it, else float" },
        { "float", 1, "32-bit floats" }, { "half", 2, "16-bit floats" },
        { "unorm8", 3, "8 bits a channel" } },
      "Format that colours are composited in (Kraus et al. 2004, section 4)."),
    MakeBoolean("AlphaDithering", ProjectionKind, Projection, true, true,
      "Round at random if ColorBuffer is unorm8 and that is better (Kraus et al. 2004, section "
      "4)."),
    MakeEnumeration("Order", ProjectionKind, Projection, true,
      { { "automatic", 0, "as exact, without a warning if it can't be" },
        { "exact", 1, "by common faces of the convexified mesh (Williams 1992)" },
        { "across-gaps", 2, "by common faces and all pairs of faces across empty space" },
        { "non-convex", 3, "by common faces, with a guess across empty space (MPVONC)" },
        { "centroid", 4, "by distance of centroids" } },
      "Visibility order that cells are composited in."),

    { "SampleDistance", PropertyType::Real, TriangleCasterKind, Slices, false,
      { { "automatic", 0, "half of the mean spacing of points, less for small volumes" } }, 0,
      Unbounded, { 0 }, "", "world units", "Distance of slices." },
    MakeBoolean("SampleDistanceByError", TriangleCasterKind, Slices, false, false,
      "Choose the distance of slices by MaximumError."),
    { "InteractiveSampleDistance", PropertyType::Real, TriangleCasterKind, Slices, true,
      { { "automatic", 0, "twice that of other frames" } }, 0, Unbounded, { 0 }, "", "world units",
      "Distance of slices in frames of an interaction, if AutoAdjustSampleDistances is on." },
    MakeEnumeration("SliceShape", TriangleCasterKind, Slices, true,
      { { "planes", 0, "parallel to the plane of the picture" },
        { "shells", 1, "spheres around the eye (Knittel 1999, section 1.1)" } },
      "What the volume is cut by."),
    MakeEnumeration("OpacityModel", TriangleCasterKind, Model, false,
      { { "power", 0, "1 - (1 - a)^(l / d), as VTK's mappers of image data" },
        { "attenuation", 1, "1 - exp(-a l / d), as mappers of unstructured grids" } },
      "Opacity of a length l by scalar opacity a and unit distance d."),
    MakeEnumeration("GradientNorm", TriangleCasterKind, Model, true,
      { { "euclidean", 0, "the Euclidean norm" },
        { "sum", 1, "the sum of its components (Knittel 1999, section 7)" } },
      "Length of a gradient, for gradient opacity."),
    MakeEnumeration("GradientSource", TriangleCasterKind, Quality, true,
      { { "on-the-fly", 0, "differences of values, for each sample" },
        { "bytes", 1, "stored at the points, 8 bits a component (Knittel 1999, section 7)" } },
      "Where gradients come from."),
    MakeEnumeration("LightSum", TriangleCasterKind, Quality, true,
      { { "direct", 0, "for each sample" },
        { "nearest-entry", 1, "for each direction of a map (Knittel 1999, section 7)" },
        { "interpolated", 2, "between four directions of that map" } },
      "How lights are summed up."),
    MakeColorFactors(
      "NearColor", "Factors of the colours at the front (Knittel 1999, section 2.2)."),
    MakeColorFactors("FarColor", "Factors of the colours at the back (Knittel 1999, section 2.2)."),
    { "AverageIPScalarRange", PropertyType::Real, TriangleCasterKind, Model, true, {}, -Unbounded,
      Unbounded, { -LargestAveraged, LargestAveraged }, "LEAST,LARGEST", "units of the scalars",
      "The scalars that BlendMode average-intensity averages." },
    MakeBoolean("PreIntegration", TriangleCasterKind, Quality, true, false,
      "Look up what is between two slices in a table over the scalars at both."),
    MakeBoolean("CorrectOpacity", TriangleCasterKind, Quality, true, true,
      "Take the opacity of each ray's own step instead of the distance of slices."),
    MakeBoolean("EndTriangles", TriangleCasterKind, Rays, true, true,
      "End triangles of the screen whose pixels are all opaque (Knittel 1999, section 3.2)."),
    MakeBoolean("SkipPixels", TriangleCasterKind, Rays, true, true,
      "Sample opaque pixels of other triangles no more (Knittel 1999, section 3.2)."),
    MakeBoolean("SkipEmptySpace", TriangleCasterKind, Rays, true, true,
      "Leave out what is transparent (Knittel 1999, section 2.1)."),
    { "TileSize", PropertyType::Integer, TriangleCasterKind, Rays, true, {}, 4, 64, { 8 }, "",
      "pixels", "Edge of the squares that the screen is cut into." },
    MakeBoolean("CastTriangles", TriangleCasterKind, Rays, true, false,
      "Cast each square of the screen in two triangles (Knittel 1999, section 2)."),
  };
}

/// Names that differ in case, '-' and '_' alone become the same.
std::string Normalize(const std::string& name)
{
  std::string result;
  for (const char c : name)
  {
    if (c != '-' && c != '_')
    {
      result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return result;
}

std::string FormatNumber(PropertyType type, double value)
{
  char text[32];
  // A float has at most seven significant digits.
  std::snprintf(text, sizeof(text), type == PropertyType::Real ? "%.7g" : "%.0f", value);
  return text;
}

} // namespace

const std::vector<MapperProperty>& GetMapperProperties()
{
  static const std::vector<MapperProperty> properties = MakeProperties();
  return properties;
}

const MapperProperty* FindMapperProperty(const std::string& name)
{
  for (const MapperProperty& property : GetMapperProperties())
  {
    if (property.Name == name)
    {
      return &property;
    }
  }
  return nullptr;
}

const MapperProperty& GetMapperProperty(const std::string& name)
{
  const MapperProperty* property = FindMapperProperty(name);
  if (!property)
  {
    throw std::out_of_range("no mapper has a property " + name);
  }
  return *property;
}

std::vector<NamedValue> GetNamedValues(const MapperProperty& property, unsigned kinds)
{
  std::vector<NamedValue> values;
  std::copy_if(property.Values.begin(), property.Values.end(), std::back_inserter(values),
    [kinds](const NamedValue& value) { return (value.Kinds & kinds) != 0; });
  return values;
}

const char* GetValueName(const char* property, int number)
{
  for (const NamedValue& value : GetMapperProperty(property).Values)
  {
    if (value.Number == number)
    {
      return value.Name;
    }
  }
  return "unknown";
}

const NamedValue* FindNamedValue(const std::vector<NamedValue>& values, const std::string& name)
{
  for (const NamedValue& value : values)
  {
    if (Normalize(value.Name) == Normalize(name))
    {
      return &value;
    }
  }
  return nullptr;
}

std::string DescribeValues(const MapperProperty& property, unsigned kinds)
{
  std::string names = DescribeValues(GetNamedValues(property, kinds));
  switch (property.Type)
  {
    case PropertyType::Boolean:
      return "on or off";
    case PropertyType::Enumeration:
      return names;
    default:
      break;
  }
  const std::string elements = property.Elements;
  std::string range = property.Type == PropertyType::Real ? "a number" : "an integer";
  if (!elements.empty())
  {
    range = elements + ", " + std::to_string(property.Default.size()) + " numbers";
  }
  if (property.Maximum < Unbounded)
  {
    range += " from " + FormatNumber(property.Type, property.Minimum) + " to " +
      FormatNumber(property.Type, property.Maximum);
  }
  return names.empty() ? range : range + ", or " + names;
}

std::string DescribeValues(const std::vector<NamedValue>& values)
{
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    text += (i == 0                      ? ""
                : i + 1 == values.size() ? " or "
                                         : ", ") +
      std::string(values[i].Name) + " (" + std::to_string(values[i].Number) + ")";
  }
  return text;
}

std::string FormatValues(const MapperProperty& property, const std::vector<double>& values)
{
  if (property.Type == PropertyType::Boolean)
  {
    return values.front() != 0 ? "On" : "Off";
  }
  std::string text;
  for (const double value : values)
  {
    for (const NamedValue& named : property.Values)
    {
      if (named.Number == value)
      {
        return named.Name;
      }
    }
    text += (text.empty() ? "" : ", ") + FormatNumber(property.Type, value);
  }
  return text;
}

} // namespace tetralux
