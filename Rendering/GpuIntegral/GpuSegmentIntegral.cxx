// SPDX-License-Identifier: BSD-3-Clause
#include "GpuIntegral/GpuSegmentIntegral.h"

#include "CellValuesDec.h"
#include "ClassifyLargestDec.h"
#include "GpuIntegral/ScalarBuckets.h"
#include "IntegrateCellClosedFormDec.h"
#include "IntegrateCellEmissionDec.h"
#include "IntegrateCellOpticalDepthDec.h"
#include "IntegrateClosedFormDec.h"
#include "IntegrateEmissionDec.h"
#include "IntegrateIsosurfacesDec.h"
#include "IntegrateOpticalDepthDec.h"
#include "IntegrateShadedIsosurfacesDec.h"
#include "IntegrateShadedSegmentDec.h"
#include "IntegrateVaryingLightDec.h"
#include "IsosurfacesDec.h"
#include "OneIntervalDec.h"
#include "PiecesDec.h"
#include "ScalarBucketsDec.h"
#include "Scene/IntegratorChoice.h"
#include "Scene/VolumeScene.h"
#include "SegmentWeightsDec.h"
#include "TransferIntervalsDec.h"

#include "vtkShaderProgram.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace tetralux
{
namespace
{

/// Four floats a texel.
constexpr std::size_t TexelsOfInterval = sizeof(IntervalTable::Interval) / (4 * sizeof(float));
constexpr std::size_t TexelsOfSurface = 2;

/// Optical depth that the thin form takes, see SegmentWeightsDec.glsl, but for rounding.
constexpr double ThinDepth = 1.4999;

/// As in TransferIntervalsDec.glsl.
constexpr float SmallestScalar = 1e-30f;

/// A node as shaders compare with it: no infinity, and 0 where it is that small.
float MakeNode(float scalar)
{
  constexpr float Largest = std::numeric_limits<float>::max();
  return std::abs(scalar) < SmallestScalar ? 0.f : std::clamp(scalar, -Largest, Largest);
}

/// Sends a buffer unless it has the key; an empty key is that of nothing.
template <class Upload>
void Refresh(
  CacheStamp& stamp, const TextureBuffer& buffer, const CacheKey& key, const Upload& upload)
{
  if (buffer.IsEmpty() || key == CacheKey() || !stamp.Has(key))
  {
    stamp.Reset();
    upload();
    stamp.Set(key);
  }
}

} // namespace

SegmentSource MakeSegmentSource(const VolumeScene& scene, Lighting lighting)
{
  SegmentSource source;
  source.Integrator = ChooseIntegrator(scene, lighting);
  source.Intervals = &scene.Optics.GetIntervalTable();
  if (scene.Optics.GetModel() == OpticalModel::EmissionAbsorption)
  {
    std::copy_n(scene.GetPlan().Color, 3, source.Color);
  }
  if (source.Integrator == Integrator::Isosurfaces)
  {
    const ScalarMap map = scene.GetScalarMap();
    source.Key = CacheKey::Of(scene.Optics.GetSurfacesVersion(), map.Offset, map.Scale);
    source.ShadedSurfaces = lighting != Lighting::None;
    source.Surfaces = scene.Optics.GetIsosurfaces();
    for (Isosurface& surface : source.Surfaces)
    {
      surface.Value = map.Map(surface.Value);
    }
    return source;
  }
  source.Key = CacheKey::Of(scene.Optics.GetFunctionVersion());
  source.Table = scene.Optics.GetTable();
  source.TableVersion = scene.Optics.GetTableVersion();
  source.CellValues = scene.GetCellValues();
  source.CellValuesVersion = scene.GetCellValuesVersion();
  return source;
}

GpuSegmentIntegral::GpuSegmentIntegral() = default;

GpuSegmentIntegral::~GpuSegmentIntegral() = default;

void GpuSegmentIntegral::Update(vtkOpenGLRenderWindow* window, const SegmentSource& source)
{
  this->Integrator = source.Integrator;
  this->Shaded = source.ShadedSurfaces || IsLit(source.Integrator);
  this->OfCells = !source.CellValues.empty();
  const bool emitsAndAbsorbs = source.Integrator == Integrator::ClosedForm ||
    source.Integrator == Integrator::LitClosedForm || source.Integrator == Integrator::VaryingLight;
  this->OnlyThin = emitsAndAbsorbs && source.Intervals &&
    source.Intervals->MaximumAttenuation * source.LongestSegment <= ThinDepth;
  this->Curved = source.Intervals && source.Intervals->Curved;
  for (int c = 0; c < 3; ++c)
  {
    this->Color[c] = static_cast<float>(source.Color[c]);
  }
  if (source.Integrator == Integrator::Isosurfaces)
  {
    Refresh(this->SurfacesStamp, this->Surfaces, source.Key,
      [&] { this->UploadSurfaces(window, source.Surfaces); });
  }
  else if (IsTabulated(source.Integrator))
  {
    this->Table.Update(window, *source.Table, source.TableVersion, source.FilterInShader);
  }
  else
  {
    Refresh(this->IntervalsStamp, this->Intervals, source.Key,
      [&] { this->UploadIntervals(window, *source.Intervals); });
  }
  if (this->OfCells &&
    (this->CellValues.IsEmpty() || this->CellValuesVersion != source.CellValuesVersion))
  {
    this->CellValues.Upload(window, &source.CellValues[0].Attenuation, source.CellValues.size(),
      static_cast<int>(sizeof(CellValue) / sizeof(float)), "the table of cell values");
    this->CellValuesVersion = source.CellValuesVersion;
  }
}

void GpuSegmentIntegral::UploadIntervals(vtkOpenGLRenderWindow* window, const IntervalTable& table)
{
  std::vector<IntervalTable::Interval> intervals = table.Intervals;
  for (IntervalTable::Interval& interval : intervals)
  {
    interval.Lo = MakeNode(interval.Lo);
    interval.Hi = MakeNode(interval.Hi);
    interval.Reference = MakeNode(interval.Reference);
  }
  std::vector<float> texels(4 * TexelsOfInterval * intervals.size());
  std::memcpy(texels.data(), intervals.data(), texels.size() * sizeof(float));
  this->Intervals.Upload(
    window, texels.data(), TexelsOfInterval * intervals.size(), 4, "the transfer function");
  std::vector<float> ends(intervals.size() - 1);
  std::transform(intervals.begin(), intervals.end() - 1, ends.begin(),
    [](const IntervalTable::Interval& interval) { return interval.Hi; });
  const std::vector<std::int32_t> buckets = MakeScalarBuckets(ends);
  this->Buckets.Upload(
    window, buckets.data(), buckets.size(), 1, "the search table of the transfer function");
}

void GpuSegmentIntegral::UploadSurfaces(
  vtkOpenGLRenderWindow* window, const std::vector<Isosurface>& surfaces)
{
  std::vector<float> texels;
  for (const Isosurface& surface : surfaces)
  {
    const float* c = surface.Color;
    texels.insert(texels.end(),
      { static_cast<float>(surface.Value), 0, 0, 0, c[0], c[1], c[2],
        std::clamp(surface.Opacity, 0.f, 1.f) });
  }
  this->NumberOfSurfaces = static_cast<int>(surfaces.size());
  this->Surfaces.Upload(
    window, texels.data(), TexelsOfSurface * surfaces.size(), 4, "the table of isosurfaces");
}

std::string GpuSegmentIntegral::GetDeclarations() const
{
  const char* shaded = this->Integrator == Integrator::Isosurfaces ? IntegrateShadedIsosurfacesDec
    : this->Integrator == Integrator::VaryingLight                 ? IntegrateVaryingLightDec
                                                                   : IntegrateShadedSegmentDec;
  return this->GetFlatDeclarations() + (this->Shaded ? shaded : "");
}

std::string GpuSegmentIntegral::GetFlatDeclarations() const
{
  if (IsTabulated(this->Integrator))
  {
    return this->Table.GetDeclarations();
  }
  std::string code;
  if (this->OfCells)
  {
    code += std::string(SegmentWeightsDec) + CellValuesDec;
  }
  else if (this->Integrator == Integrator::Isosurfaces)
  {
    return std::string(IsosurfacesDec) + IntegrateIsosurfacesDec;
  }
  else
  {
    code += this->OnlyThin ? "#define ONLY_THIN_SEGMENTS\n" : "";
    code += this->Curved ? "#define CURVED_COLORS\n" : "";
    code += std::string(SegmentWeightsDec) + PiecesDec + ScalarBucketsDec + TransferIntervalsDec;
  }
  if (this->Integrator == Integrator::Maximum)
  {
    code += this->OfCells ? std::string(PiecesDec) + ScalarBucketsDec + TransferIntervalsDec : "";
    return code + ClassifyLargestDec;
  }
  if (this->Integrator == Integrator::VaryingLight)
  {
    return code; // the shaded function integrates by itself
  }
  if (this->Integrator == Integrator::OpticalDepth)
  {
    return code + (this->OfCells ? IntegrateCellOpticalDepthDec : IntegrateOpticalDepthDec);
  }
  if (this->Integrator == Integrator::Emission)
  {
    return code + (this->OfCells ? IntegrateCellEmissionDec : IntegrateEmissionDec);
  }
  return code + (this->OfCells ? IntegrateCellClosedFormDec : IntegrateClosedFormDec);
}

bool GpuSegmentIntegral::HasPartDeclarations() const
{
  return !this->OfCells &&
    (this->Integrator == Integrator::ClosedForm || this->Integrator == Integrator::OpticalDepth ||
      this->Integrator == Integrator::Emission);
}

double GpuSegmentIntegral::GetLargestPartDepth() const
{
  return this->Integrator == Integrator::ClosedForm ? ThinDepth
                                                    : std::numeric_limits<double>::infinity();
}

std::string GpuSegmentIntegral::GetPartDeclarations() const
{
  std::string code =
    this->Integrator == Integrator::ClosedForm ? "#define ONLY_THIN_SEGMENTS\n" : "";
  code += this->Curved ? "#define CURVED_COLORS\n" : "";
  code += std::string(SegmentWeightsDec) + PiecesDec + OneIntervalDec;
  return code +
    (this->Integrator == Integrator::OpticalDepth  ? IntegrateOpticalDepthDec
        : this->Integrator == Integrator::Emission ? IntegrateEmissionDec
                                                   : IntegrateClosedFormDec);
}

void GpuSegmentIntegral::Activate(vtkShaderProgram* program)
{
  if (this->Integrator == Integrator::Isosurfaces)
  {
    this->Surfaces.Activate(program, "isosurfaces");
    program->SetUniformi("numberOfIsosurfaces", this->NumberOfSurfaces);
    return;
  }
  if (IsTabulated(this->Integrator))
  {
    this->Table.Activate(program);
    return;
  }
  if (this->OfCells)
  {
    this->CellValues.Activate(program, "cellValues");
  }
  if (!this->OfCells || this->Integrator == Integrator::Maximum)
  {
    this->Intervals.Activate(program, "transferIntervals");
    this->Buckets.Activate(program, "transferBuckets");
  }
  if (this->Integrator == Integrator::OpticalDepth)
  {
    program->SetUniform3f("constantColor", this->Color);
  }
}

void GpuSegmentIntegral::Deactivate()
{
  this->Table.Deactivate();
  this->Surfaces.Deactivate();
  this->CellValues.Deactivate();
  this->Intervals.Deactivate();
  this->Buckets.Deactivate();
}

std::size_t GpuSegmentIntegral::GetNumberOfBytes() const
{
  return this->Intervals.GetNumberOfBytes() + this->Buckets.GetNumberOfBytes() +
    this->Table.GetNumberOfBytes() + this->Surfaces.GetNumberOfBytes() +
    this->CellValues.GetNumberOfBytes();
}

void GpuSegmentIntegral::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Intervals.ReleaseGraphicsResources(window);
  this->Buckets.ReleaseGraphicsResources(window);
  this->Table.ReleaseGraphicsResources(window);
  this->Surfaces.ReleaseGraphicsResources(window);
  this->CellValues.ReleaseGraphicsResources(window);
}

} // namespace tetralux
