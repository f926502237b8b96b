// SPDX-License-Identifier: BSD-3-Clause
#include "ProjectedCellDrawer.h"

#include "ProjectedCellFS.h"
#include "ProjectedCellVS.h"
#include "ScreenProgram.h"

#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkShaderProgram.h"
#include "vtk_glew.h"

#include <algorithm>
#include <stdexcept>

namespace tetralux
{
namespace
{

/// Distance of corners, bytes: attributes that belong to a whole cell are read as if they were the
/// first corner's, from where the other corners have room.
constexpr std::size_t CornerSize = sizeof(ProjectedCell) / 4;

constexpr std::size_t GradientSize = sizeof(ProjectedGradient) / 4;

struct Attribute
{
  const char* Name;
  std::size_t Offset;
  int Components;
};

constexpr Attribute CellAttributes[] = {
  { "corner", 0, 2 },
  { "cellBase", offsetof(ProjectedCell, First.Base), 3 },
  { "cellFace0", offsetof(ProjectedCell, First.Face0), 3 },
  { "cellFace1", offsetof(ProjectedCell, Second.Face1), 3 },
  { "cellFace2", offsetof(ProjectedCell, Second.Face2), 3 },
  { "cellScalar", offsetof(ProjectedCell, Third.Scalar), 3 },
  { "cellScalars", offsetof(ProjectedCell, Third.ScalarSlope), 3 },
  { "cellPlace", offsetof(ProjectedCell, Fourth.Reference), 3 },
  { "cellOwn", offsetof(ProjectedCell, Fourth.Own), 3 },
};

constexpr Attribute GradientAttributes[] = {
  { "cellGradient0", offsetof(ProjectedGradient, Base), 3 },
  { "cellGradient1", offsetof(ProjectedGradient, SlopeX), 3 },
  { "cellGradient2", offsetof(ProjectedGradient, SlopeY), 3 },
  { "cellGradient3", offsetof(ProjectedGradient, Slope), 3 },
};

} // namespace

ProjectedCellDrawer::ProjectedCellDrawer() = default;

ProjectedCellDrawer::~ProjectedCellDrawer() = default;

vtkShaderProgram* ProjectedCellDrawer::Use(vtkOpenGLRenderWindow* window, const Shader& shader)
{
  if (this->Window != window)
  {
    this->ReleaseGraphicsResources(this->Window);
    this->Window = window;
  }
  std::string vertex = ProjectedCellVS;
  vtkShaderProgram::Substitute(vertex, "//VTK::Projection::Dec", shader.Projection);
  std::string fragment = ProjectedCellFS;
  vtkShaderProgram::Substitute(fragment, "//VTK::Projection::Dec", shader.Projection);
  vtkShaderProgram::Substitute(fragment, "//VTK::Segment::Dec", shader.Segment);
  vtkShaderProgram::Substitute(fragment, "//VTK::Segment::Impl", shader.Output);
  vtkShaderProgram::Substitute(fragment, "//VTK::Dither::Impl", shader.Dither);
  for (std::string* source : { &vertex, &fragment })
  {
    vtkShaderProgram::Substitute(*source, "//VTK::System::Dec", "#version 150\n");
  }
  if (fragment != this->Source)
  {
    CheckShader("ProjectedCellVS", vertex, true);
    CheckShader("ProjectedCellFS", fragment, false);
    this->Source = fragment;
  }
  vtkShaderProgram* program =
    window->GetShaderCache()->ReadyShaderProgram(vertex.c_str(), fragment.c_str(), "");
  if (!program)
  {
    this->Source.clear();
    throw std::runtime_error("the shader program that draws projected cells could not be linked");
  }
  if (program != this->Program)
  {
    this->Attributes->ShaderProgramChanged();
    this->Program = program;
  }
  return program;
}

void ProjectedCellDrawer::Draw(const ProjectedCells& cells)
{
  if (cells.Triangles.empty())
  {
    return;
  }
  this->LargestBatch = std::max(this->LargestBatch,
    cells.Cells.size() * sizeof(ProjectedCell) + cells.Triangles.size() * sizeof(std::uint32_t) +
      cells.Gradients.size() * sizeof(ProjectedGradient) +
      cells.FaceScalars.size() * sizeof(FaceScalar));
  if (!cells.FaceScalars.empty())
  {
    constexpr std::size_t TexelsOfFace = 3;
    this->FaceScalars.Upload(this->Window, reinterpret_cast<const float*>(cells.FaceScalars.data()),
      TexelsOfFace * cells.FaceScalars.size(), 4, "scalars of faces");
  }
  this->Attributes->Bind();
  if (!this->Corners->Upload(
        cells.Cells.data(), cells.Cells.size(), vtkOpenGLBufferObject::ArrayBuffer) ||
    !this->Triangles->Upload(cells.Triangles, vtkOpenGLBufferObject::ElementArrayBuffer) ||
    (!cells.Gradients.empty() &&
      !this->Gradients->Upload(cells.Gradients, vtkOpenGLBufferObject::ArrayBuffer)))
  {
    this->Attributes->Release();
    throw std::runtime_error("projected cells could not be sent to the graphics card");
  }
  const auto add = [this](
                     const Attribute& attribute, vtkOpenGLBufferObject* buffer, std::size_t stride)
  {
    if (this->Program->IsAttributeUsed(attribute.Name))
    {
      this->Attributes->AddAttributeArray(this->Program, buffer, attribute.Name,
        static_cast<int>(attribute.Offset), stride, VTK_FLOAT, attribute.Components, false);
    }
  };
  for (const Attribute& attribute : CellAttributes)
  {
    add(attribute, this->Corners, CornerSize);
  }
  for (const Attribute& attribute : GradientAttributes)
  {
    if (!cells.Gradients.empty())
    {
      add(attribute, this->Gradients, GradientSize);
    }
  }
  if (!cells.FaceScalars.empty())
  {
    this->FaceScalars.Activate(this->Program, "faceScalars");
  }
  glDrawElements(
    GL_TRIANGLES, static_cast<GLsizei>(cells.Triangles.size()), GL_UNSIGNED_INT, nullptr);
  this->Attributes->Release();
  if (!cells.FaceScalars.empty())
  {
    this->FaceScalars.Deactivate();
  }
}

void ProjectedCellDrawer::ReleaseGraphicsResources(vtkWindow* window)
{
  if (!this->Window || window != this->Window)
  {
    return;
  }
  this->Attributes->ReleaseGraphicsResources();
  this->Corners->ReleaseGraphicsResources();
  this->Gradients->ReleaseGraphicsResources();
  this->Triangles->ReleaseGraphicsResources();
  this->FaceScalars.ReleaseGraphicsResources(window);
  this->Program = nullptr;
  this->Source.clear();
  this->Window = nullptr;
  this->LargestBatch = 0;
}

} // namespace tetralux
