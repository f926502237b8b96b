// SPDX-License-Identifier: BSD-3-Clause
#include "GpuProjection/ProjectedCellDrawer.h"

#include "OpenGL/LoadedFunctions.h"
#include "OpenGL/ScreenProgram.h"
#include "ProjectedCellFS.h"
#include "ProjectedCellVS.h"
#include "ProjectedCellVaryingsDec.h"

#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <stdexcept>

namespace tetralux
{
namespace
{

template <class Value>
std::size_t GetBytes(const std::vector<Value>& values)
{
  return values.size() * sizeof(Value);
}

/// Of corners, which are a quarter of a cell's bytes apart: attributes that belong to a whole cell
/// are read as if they were the first corner's, from where the other corners have room.
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

using InterpolatedCorner = InterpolatedCell::Corner;
constexpr std::size_t InterpolatedSize = sizeof(InterpolatedCorner);

constexpr Attribute InterpolatedAttributes[] = {
  { "corner", 0, 2 },
  { "cornerValues", offsetof(InterpolatedCorner, Scalar), 4 },
  { "cornerBase", offsetof(InterpolatedCorner, Base), 1 },
  { "cellOwn0", offsetof(InterpolatedCorner, Own), 2 },
  { "cellOwn1", offsetof(InterpolatedCorner, Own) + InterpolatedSize, 2 },
  { "cellOwn2", offsetof(InterpolatedCorner, Own) + 2 * InterpolatedSize, 2 },
  { "cellOwn3", offsetof(InterpolatedCorner, Own) + 3 * InterpolatedSize, 2 },
};

constexpr Attribute GradientAttributes[] = {
  { "cellGradient0", offsetof(ProjectedGradient, Base), 3 },
  { "cellGradient1", offsetof(ProjectedGradient, SlopeX), 3 },
  { "cellGradient2", offsetof(ProjectedGradient, SlopeY), 3 },
  { "cellGradient3", offsetof(ProjectedGradient, Slope), 3 },
};

/// Sends what there is of cells, and tells the program's attributes where it is; false where it
/// can't be sent.
template <class Cell, std::size_t Size>
bool Send(const std::vector<Cell>& cells, const Attribute (&attributes)[Size],
  vtkShaderProgram* program, vtkOpenGLBufferObject* buffer, vtkOpenGLVertexArrayObject* array)
{
  if (cells.empty())
  {
    return true;
  }
  if (!buffer->Upload(cells.data(), cells.size(), vtkOpenGLBufferObject::ArrayBuffer))
  {
    return false;
  }
  constexpr std::size_t CornerSize = sizeof(Cell) / 4;
  for (const Attribute& attribute : attributes)
  {
    if (program->IsAttributeUsed(attribute.Name))
    {
      array->AddAttributeArray(program, buffer, attribute.Name, static_cast<int>(attribute.Offset),
        CornerSize, VTK_FLOAT, attribute.Components, false);
    }
  }
  return true;
}

} // namespace

ProjectedCellDrawer::ProjectedCellDrawer()
  : Context(
      [this](vtkOpenGLRenderWindow* window)
      {
        this->Attributes->ReleaseGraphicsResources();
        this->Corners->ReleaseGraphicsResources();
        this->Gradients->ReleaseGraphicsResources();
        this->Triangles->ReleaseGraphicsResources();
        this->FaceScalars.ReleaseGraphicsResources(window);
        this->Program = nullptr;
        this->Source.clear();
        this->LargestBatch = 0;
      })
{
}

ProjectedCellDrawer::~ProjectedCellDrawer() = default;

vtkShaderProgram* ProjectedCellDrawer::Use(vtkOpenGLRenderWindow* window, const Shader& shader)
{
  this->Context.Set(window);
  std::string vertex = ProjectedCellVS;
  vtkShaderProgram::Substitute(vertex, "//VTK::Projection::Dec", shader.Projection);
  std::string fragment = ProjectedCellFS;
  vtkShaderProgram::Substitute(fragment, "//VTK::Projection::Dec", shader.Projection);
  const std::string varyings = ProjectedCellVaryingsDec;
  vtkShaderProgram::Substitute(vertex, "//VTK::Varyings::Dec", "#define VARYING out\n" + varyings);
  vtkShaderProgram::Substitute(fragment, "//VTK::Varyings::Dec", "#define VARYING in\n" + varyings);
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
    GetBytes(cells.Cells) + GetBytes(cells.InterpolatedCells) + GetBytes(cells.Gradients) +
      GetBytes(cells.FaceScalars) + GetBytes(cells.Triangles));
  if (!cells.FaceScalars.empty())
  {
    constexpr std::size_t TexelsOfFace = 3;
    this->FaceScalars.Upload(this->Context.Get(),
      reinterpret_cast<const float*>(cells.FaceScalars.data()),
      TexelsOfFace * cells.FaceScalars.size(), 4, "scalars of faces");
  }
  this->Attributes->Bind();
  const auto send = [this](
                      const auto& values, const auto& attributes, vtkOpenGLBufferObject* buffer)
  { return Send(values, attributes, this->Program, buffer, this->Attributes); };
  if (!send(cells.Cells, CellAttributes, this->Corners) ||
    !send(cells.InterpolatedCells, InterpolatedAttributes, this->Corners) ||
    !send(cells.Gradients, GradientAttributes, this->Gradients) ||
    !this->Triangles->Upload(cells.Triangles, vtkOpenGLBufferObject::ElementArrayBuffer))
  {
    this->Attributes->Release();
    throw std::runtime_error("projected cells could not be sent to the graphics card");
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

} // namespace tetralux
