// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GpuSegmentTable_h
#define tetralux_GpuSegmentTable_h

#include "OpenGL/ContextResources.h"
#include "OpenGL/TextureBuffer.h"
#include "PreIntegration/PreIntegrationTable.h"

#include "vtkNew.h"

#include <cstddef>
#include <cstdint>
#include <string>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;

namespace tetralux
{

/// A pre-integration table as a texture of its own format, and the GLSL function IntegrateSegment
/// that looks it up, see GpuSegmentIntegral.
class GpuSegmentTable
{
public:
  GpuSegmentTable();
  ~GpuSegmentTable();

  /// Sends the table to the graphics card, unless it has this version of it. Texels are
  /// interpolated by the graphics card where that is as right as the texels themselves, see
  /// MeasureTextureFilterError; else, or where inShader is true, in the shader. Throws
  /// std::runtime_error, with one line, where there is no room for the table.
  void Update(vtkOpenGLRenderWindow* window, const PreIntegrationTable& table,
    std::uint64_t version, bool inShader);

  std::string GetDeclarations() const;

  void Activate(vtkShaderProgram* program);
  void Deactivate();

  std::size_t GetNumberOfBytes() const
  {
    return this->Bytes + this->Axis.GetNumberOfBytes() + this->Buckets.GetNumberOfBytes();
  }

  void ReleaseGraphicsResources(vtkWindow* window) { this->Context.Release(window); }

private:
  bool IsFilterExact(vtkOpenGLRenderWindow* window, TexelFormat format);
  void UploadTexels(vtkOpenGLRenderWindow* window, const PreIntegrationTable& table);

  vtkNew<vtkTextureObject> Texture;
  TextureBuffer Axis;
  TextureBuffer Buckets;
  std::size_t Bytes = 0; ///< 0: there is no texture
  std::uint64_t Version = 0;
  TexelFormat Format = TexelFormat::Float;
  bool UniformAxis = false;
  bool Logarithmic = false;
  bool HardwareFiltering = false;
  double FilterErrors[4] = { -1, -1, -1, -1 }; ///< of each format; negative: not measured yet
  float FirstInterval[4] = { 0, 0, 0, 0 };
  float Size[3] = { 0, 0, 0 };
  float InverseDelta = 1;
  float StepsPerDoubling = 1;
  ContextResources Context;
};

} // namespace tetralux

#endif
