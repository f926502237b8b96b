// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ScreenProgram_h
#define tetralux_ScreenProgram_h

#include "OpenGL/ContextResources.h"
#include "TetraluxRenderingModule.h"

#include "vtkNew.h"

#include <string>

class vtkOpenGLRenderWindow;
class vtkOpenGLVertexArrayObject;
class vtkShaderProgram;
class vtkWindow;

namespace tetralux
{

/// Compiles a shader by itself, since VTK's cache prints a program that does not compile line by
/// line and keeps the compiler's words to itself. Throws std::runtime_error with what the compiler
/// says.
TETRALUXRENDERING_EXPORT void CheckShader(
  const std::string& name, const std::string& source, bool ofVertices);

/// A fragment shader that is run for each pixel of the viewport, which it tells by gl_FragCoord, or
/// for the triangles that a vertex shader makes of the numbers of their vertices. Belongs to one
/// window's context, the last one.
class TETRALUXRENDERING_EXPORT ScreenProgram
{
public:
  ScreenProgram();
  ~ScreenProgram();
  ScreenProgram(const ScreenProgram&) = delete;
  ScreenProgram& operator=(const ScreenProgram&) = delete;

  /// The program of a source, which begins with its version, in use; compiled only where the source
  /// changed. Outputs are fragOutput0, fragOutput1, ...; the source has to mention gl_FragData[0],
  /// gl_FragData[1], ... for each of them, as VTK counts them by that. Throws std::runtime_error
  /// with what the compiler says.
  /// vertexSource: empty for one triangle that covers the viewport.
  vtkShaderProgram* Use(vtkOpenGLRenderWindow* window, const std::string& name,
    const std::string& source, const std::string& vertexSource = {});

  /// Runs it, for all pixels of the viewport, whose depth is 1, or for a number of vertices.
  void Draw(int numberOfVertices = 3);

  void ReleaseGraphicsResources(vtkWindow* window) { this->Context.Release(window); }

private:
  std::string Source;
  vtkShaderProgram* Program = nullptr; ///< belongs to the window's cache
  vtkNew<vtkOpenGLVertexArrayObject> Empty;
  ContextResources Context;
};

} // namespace tetralux

#endif
