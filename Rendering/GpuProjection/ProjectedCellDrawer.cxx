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
#include <type_traits>

namespace tetralux
{
namespace
{

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
bool Send(Span<const Cell> cells, const Attribute (&attributes)[Size], vtkShaderProgram* program,
  vtkOpenGLBufferObject* buffer, vtkOpenGLVertexArrayObject* array)
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
        this->LargestPart = 0;
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

void ProjectedCellDrawer::Draw(const ProjectedCells& cells, std::int64_t part)
{
  const std::size_t begin = cells.PartBegins[part];
  const std::size_t indices = cells.PartBegins[part + 1] - begin;
  const auto first = static_cast<std::size_t>(part * ProjectedCells::PartSize);
  const std::size_t count = std::min<std::size_t>(
    ProjectedCells::PartSize, static_cast<std::size_t>(cells.GetNumberOfCells()) - first);
  std::size_t bytes = indices * sizeof(std::uint16_t);
  // What there is of the part: nothing of an array that is empty, one more than it has cells of
  // those whose last corner reaches into the next cell.
  const auto take = [&](const auto& values, std::size_t perCell, std::size_t more)
  {
    using Value = typename std::decay_t<decltype(values)>::value_type;
    const std::size_t size = values.empty() ? 0 : perCell * count + more;
    bytes += size * sizeof(Value);
    return Span<const Value>(values.data() + (values.empty() ? 0 : perCell * first), size);
  };
  const auto faceScalars = take(cells.FaceScalars, 4, 0);
  if (!faceScalars.empty())
  {
    constexpr std::size_t TexelsOfFace = 3;
    this->FaceScalars.Upload(this->Context.Get(),
      reinterpret_cast<const float*>(faceScalars.data()), TexelsOfFace * faceScalars.size(), 4,
      "scalars of faces");
  }
  this->Attributes->Bind();
  const auto send = [this](
                      const auto& values, const auto& attributes, vtkOpenGLBufferObject* buffer)
  { return Send(values, attributes, this->Program, buffer, this->Attributes); };
  if (!send(take(cells.Cells, 1, 1), CellAttributes, this->Corners) ||
    !send(take(cells.InterpolatedCells, 1, 1), InterpolatedAttributes, this->Corners) ||
    !send(take(cells.Gradients, 1, 1), GradientAttributes, this->Gradients) ||
    !this->Triangles->Upload(
      cells.Triangles.data() + begin, indices, vtkOpenGLBufferObject::ElementArrayBuffer))
  {
    this->Attributes->Release();
    throw std::runtime_error("projected cells could not be sent to the graphics card");
  }
  if (!faceScalars.empty())
  {
    this->FaceScalars.Activate(this->Program, "faceScalars");
  }
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(indices), GL_UNSIGNED_SHORT, nullptr);
  this->Attributes->Release();
  if (!faceScalars.empty())
  {
    this->FaceScalars.Deactivate();
  }
  this->LargestPart = std::max(this->LargestPart, bytes);
}

} // namespace tetralux
