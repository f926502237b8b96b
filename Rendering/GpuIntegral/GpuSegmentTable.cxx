// SPDX-License-Identifier: BSD-3-Clause
#include "GpuIntegral/GpuSegmentTable.h"

#include "GpuIntegral/ScalarBuckets.h"
#include "GpuIntegral/TexelTextureFormat.h"
#include "GpuIntegral/TextureFilterError.h"
#include "IntegrateTableDec.h"
#include "OpenGL/LoadedFunctions.h"
#include "ScalarBucketsDec.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace tetralux
{
namespace
{

GLenum GetType(TexelFormat format)
{
  switch (format)
  {
    case TexelFormat::UNorm8:
      return GL_UNSIGNED_BYTE;
    case TexelFormat::UNorm16:
      return GL_UNSIGNED_SHORT;
    case TexelFormat::Half:
      return GL_HALF_FLOAT;
    case TexelFormat::Float:
      break;
  }
  return GL_FLOAT;
}

/// The last place of a texel of 1: weights that are off by no more leave lookups as right as
/// texels.
double GetLastPlace(TexelFormat format)
{
  switch (format)
  {
    case TexelFormat::UNorm8:
      return 2. / 255; // texels of 8 bits are interpolated in 8 bits, and rounded twice
    case TexelFormat::UNorm16:
      return 1. / 65535;
    case TexelFormat::Half:
      return 1. / 2048;
    case TexelFormat::Float:
      break;
  }
  return 1. / (1 << 20); // of what coordinates are rounded to in a table of hundreds of texels
}

} // namespace

GpuSegmentTable::GpuSegmentTable()
  : Context(
      [this](vtkOpenGLRenderWindow* window)
      {
        this->Texture->ReleaseGraphicsResources(window);
        std::fill_n(this->FilterErrors, 4, -1.);
        this->Axis.ReleaseGraphicsResources(window);
        this->Buckets.ReleaseGraphicsResources(window);
        this->Bytes = 0;
      })
{
}

GpuSegmentTable::~GpuSegmentTable() = default;

bool GpuSegmentTable::IsFilterExact(vtkOpenGLRenderWindow* window, TexelFormat format)
{
  double& error = this->FilterErrors[static_cast<int>(format)];
  if (error < 0)
  {
    error = MeasureTextureFilterError(window, format);
  }
  return error <= GetLastPlace(format);
}

void GpuSegmentTable::Update(vtkOpenGLRenderWindow* window, const PreIntegrationTable& table,
  std::uint64_t version, bool inShader)
{
  this->Context.Set(window);
  this->HardwareFiltering = !inShader && this->IsFilterExact(window, table.Settings.Format);
  const int filter = this->HardwareFiltering ? vtkTextureObject::Linear : vtkTextureObject::Nearest;
  this->Texture->SetMinificationFilter(filter);
  this->Texture->SetMagnificationFilter(filter);
  if (this->Bytes > 0 && version == this->Version)
  {
    return;
  }
  const std::vector<ScalarAxisMap::Interval>& intervals = table.Scalars.Intervals;
  this->UploadTexels(window, table);
  this->UniformAxis = intervals.size() == 1;
  if (!this->UniformAxis)
  {
    std::vector<float> ends(intervals.size() - 1);
    std::transform(intervals.begin(), intervals.end() - 1, ends.begin(),
      [](const ScalarAxisMap::Interval& interval) { return interval.Hi; });
    const std::vector<std::int32_t> buckets = MakeScalarBuckets(ends);
    this->Buckets.Upload(
      window, buckets.data(), buckets.size(), 1, "the search table of the pre-integration table");
    this->Axis.Upload(
      window, &intervals.front().Lo, intervals.size(), 4, "the axis of the pre-integration table");
  }
  const ScalarAxisMap::Interval& first = intervals.front();
  const float interval[4] = { first.Lo, first.Hi, first.Coordinate, first.Slope };
  std::copy_n(interval, 4, this->FirstInterval);
  this->InverseDelta = table.Lengths.InverseDelta;
  this->Logarithmic = table.Lengths.Scale == LengthScale::Logarithmic;
  this->StepsPerDoubling = static_cast<float>(table.Lengths.StepsPerDoubling);
  this->Version = version;
}

void GpuSegmentTable::UploadTexels(vtkOpenGLRenderWindow* window, const PreIntegrationTable& table)
{
  const int size[3] = { table.Scalars.GetSize(), table.Scalars.GetSize(), table.Lengths.Size };
  const TexelFormat format = table.Settings.Format;
  const std::string what = "a pre-integration table of " + std::to_string(size[0]) + " x " +
    std::to_string(size[1]) + " x " + std::to_string(size[2]) + " texels";
  vtkOpenGLState* state = window->GetState();
  int largest = 0;
  state->vtkglGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &largest);
  if (std::max(size[0], size[2]) > largest)
  {
    throw std::runtime_error(what + " is more than this graphics card takes, " +
      std::to_string(largest) + " along an axis");
  }
  while (glGetError() != GL_NO_ERROR) // of others
  {
  }
  const vtkOpenGLState::ScopedglActiveTexture unit(state);
  const bool same = this->Bytes > 0 && format == this->Format &&
    std::equal(
      size, size + 3, this->Size, [](int a, float b) { return static_cast<float>(a) == b; });
  this->Bytes = 0;
  if (!same)
  {
    this->Texture->ReleaseGraphicsResources(window);
    this->Texture->SetContext(window);
    this->Texture->SetInternalFormat(GetInternalFormat(format));
    this->Texture->SetFormat(GL_RGBA);
    this->Texture->SetDataType(GetType(format));
    this->Texture->SetWrapS(vtkTextureObject::ClampToEdge);
    this->Texture->SetWrapT(vtkTextureObject::ClampToEdge);
    this->Texture->SetWrapR(vtkTextureObject::ClampToEdge);
    if (!this->Texture->Allocate3D(size[0], size[1], size[2], 4, VTK_FLOAT))
    {
      throw std::runtime_error("the graphics card has no room for " + what);
    }
  }
  this->Texture->Activate();
  state->vtkglPixelStorei(GL_UNPACK_ALIGNMENT, 4); // no texel is smaller
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, 0, size[0], size[1], size[2], GL_RGBA, GetType(format),
    table.Texels.GetData());
  const bool uploaded = glGetError() == GL_NO_ERROR;
  this->Texture->Deactivate();
  if (!uploaded)
  {
    throw std::runtime_error("the graphics card has no room for " + what);
  }
  this->Format = format;
  std::transform(size, size + 3, this->Size, [](int n) { return static_cast<float>(n); });
  this->Bytes = table.GetNumberOfBytes();
}

std::string GpuSegmentTable::GetDeclarations() const
{
  std::string defines;
  defines += this->UniformAxis ? "#define UNIFORM_AXIS\n" : "";
  defines += this->Logarithmic ? "#define LOGARITHMIC_LENGTHS\n" : "";
  defines += this->HardwareFiltering ? "#define HARDWARE_FILTERING\n" : "";
  return defines + (this->UniformAxis ? "" : ScalarBucketsDec) + IntegrateTableDec;
}

void GpuSegmentTable::Activate(vtkShaderProgram* program)
{
  const vtkOpenGLState::ScopedglActiveTexture unit(this->Context.Get()->GetState());
  this->Texture->Activate();
  program->SetUniformi("segmentTable", this->Texture->GetTextureUnit());
  program->SetUniform3f("tableSize", this->Size);
  const float inverse[3] = { 1 / this->Size[0], 1 / this->Size[1], 1 / this->Size[2] };
  program->SetUniform3f("tableInverseSize", inverse);
  program->SetUniformf("tableInverseDelta", this->InverseDelta);
  if (this->Logarithmic)
  {
    program->SetUniformf("tableStepsPerDoubling", this->StepsPerDoubling);
  }
  if (this->UniformAxis)
  {
    program->SetUniform4f("tableAxis", this->FirstInterval);
  }
  else
  {
    this->Axis.Activate(program, "tableAxis");
    this->Buckets.Activate(program, "tableBuckets");
  }
}

void GpuSegmentTable::Deactivate()
{
  if (this->Context.Get())
  {
    const vtkOpenGLState::ScopedglActiveTexture unit(this->Context.Get()->GetState());
    this->Texture->Deactivate();
    this->Axis.Deactivate();
    this->Buckets.Deactivate();
  }
}

} // namespace tetralux
