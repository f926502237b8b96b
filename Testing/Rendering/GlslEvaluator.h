// SPDX-License-Identifier: BSD-3-Clause
#ifndef GlslEvaluator_h
#define GlslEvaluator_h

#include "OpenGL/FloatTarget.h"
#include "OpenGL/TextureBuffer.h"

#include "vtkHeadlessRenderWindow.h"
#include "vtkNew.h"
#include "vtkRenderer.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

class vtkShaderProgram;

/// Evaluates GLSL functions on arrays of arguments: draws a quad with a pixel for each case into a
/// float target of a window without a display.
class GlslEvaluator
{
public:
  GlslEvaluator();

  /// Eight arguments of a case.
  using Arguments = std::array<float, 8>;
  using Result = std::array<float, 4>;

  /// declarations: put before main. expression: a vec4 of the arguments a.x, a.y, a.z, a.w, b.x,
  /// b.y, b.z, b.w. prepare: called with the program in use, before drawing; finish: after it.
  std::vector<Result> Evaluate(const std::string& declarations, const std::string& expression,
    const std::vector<Arguments>& cases, const std::function<void(vtkShaderProgram*)>& prepare = {},
    const std::function<void()>& finish = {});

  vtkNew<vtkHeadlessRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;

private:
  tetralux::FloatTarget Target;
  tetralux::TextureBuffer Inputs;
};

#endif
