// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ProjectedCellDrawer_h
#define tetralux_ProjectedCellDrawer_h

#include "OpenGL/ContextResources.h"
#include "OpenGL/TextureBuffer.h"
#include "Projection/ProjectedCells.h"

#include "vtkNew.h"

#include <cstddef>
#include <string>

class vtkOpenGLBufferObject;
class vtkOpenGLRenderWindow;
class vtkOpenGLVertexArrayObject;
class vtkShaderProgram;
class vtkWindow;

namespace tetralux
{

/// Draws projected cells in their order, into whatever is bound: the shader program and the
/// buffers. Holds graphics resources of one window at a time, the last one.
class ProjectedCellDrawer
{
public:
  ProjectedCellDrawer();
  ~ProjectedCellDrawer();
  ProjectedCellDrawer(const ProjectedCellDrawer&) = delete;
  ProjectedCellDrawer& operator=(const ProjectedCellDrawer&) = delete;

  /// What the fragment shader, ProjectedCellFS.glsl, is made of.
  struct Shader
  {
    std::string Projection; ///< VTK::Projection::Dec: defines, of the vertex shader, too
    std::string Segment;    ///< VTK::Segment::Dec: functions
    std::string Output;     ///< VTK::Segment::Impl: returns what front, back and len add
    std::string Dither;     ///< VTK::Dither::Impl: changes color
  };

  /// Makes the program ready, in use. Throws std::runtime_error, with one line and the compiler's
  /// log, where there is none.
  vtkShaderProgram* Use(vtkOpenGLRenderWindow* window, const Shader& shader);

  /// Sends and draws one part of the cells; the program that Use returned is in use. Throws
  /// std::runtime_error, with one line, where the graphics card has no room for it.
  void Draw(const ProjectedCells& cells, std::int64_t part);

  /// Bytes on the graphics card of the largest part since the last release.
  std::size_t GetNumberOfBytes() const { return this->LargestPart; }

  /// window: the one that goes away.
  void ReleaseGraphicsResources(vtkWindow* window) { this->Context.Release(window); }

private:
  vtkNew<vtkOpenGLVertexArrayObject> Attributes;
  vtkNew<vtkOpenGLBufferObject> Corners;
  vtkNew<vtkOpenGLBufferObject> Gradients;
  vtkNew<vtkOpenGLBufferObject> Triangles;
  TextureBuffer FaceScalars;
  vtkShaderProgram* Program = nullptr; ///< the cache's
  std::string Source;                  ///< of the fragment shader that was found to compile
  std::size_t LargestPart = 0;
  ContextResources Context;
};

} // namespace tetralux

#endif
