// SPDX-License-Identifier: BSD-3-Clause
#include "GlslEvaluator.h"

#include "OpenGL/LoadedFunctions.h"

#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"

#include <stdexcept>

namespace
{

constexpr int Width = 256;

constexpr const char* Begin = R"(//VTK::System::Dec
//VTK::Output::Dec
uniform samplerBuffer evaluatorInputs;
uniform vec2 evaluatorSize;
in vec2 texCoord;
)";

constexpr const char* Main = R"(
void main()
{
  ivec2 pixel = ivec2(texCoord * evaluatorSize);
  int evaluatorCase = pixel.x + int(evaluatorSize.x) * pixel.y;
  vec4 a = texelFetch(evaluatorInputs, 2 * evaluatorCase);
  vec4 b = texelFetch(evaluatorInputs, 2 * evaluatorCase + 1);
  gl_FragData[0] = )";

} // namespace

GlslEvaluator::GlslEvaluator()
{
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(32, 32);
  this->Window->AddRenderer(this->Renderer);
  this->Window->Render();
}

std::vector<GlslEvaluator::Result> GlslEvaluator::Evaluate(const std::string& declarations,
  const std::string& expression, const std::vector<Arguments>& cases,
  const std::function<void(vtkShaderProgram*)>& prepare, const std::function<void()>& finish)
{
  const int height = static_cast<int>((cases.size() + Width - 1) / Width);
  std::vector<Arguments> padded = cases;
  padded.resize(static_cast<std::size_t>(Width) * height);
  this->Inputs.Upload(this->Window, padded.front().data(), 2 * padded.size(), 4, "inputs");
  tetralux::FloatTarget::Settings settings;
  settings.Width = Width;
  settings.Height = height;
  this->Target.Prepare(this->Window, settings);

  const std::string source = Begin + declarations + Main + expression + ";\n}\n";
  vtkOpenGLQuadHelper quad(this->Window, nullptr, source.c_str(), "");
  if (!quad.Program || !this->Window->GetShaderCache()->ReadyShaderProgram(quad.Program))
  {
    throw std::runtime_error("the shader did not compile");
  }
  vtkOpenGLState* state = this->Window->GetState();
  {
    const tetralux::FloatTarget::Use use(this->Target);
    const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
    const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
    const vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
    state->vtkglDisable(GL_BLEND);
    state->vtkglDisable(GL_DEPTH_TEST);
    state->vtkglDisable(GL_SCISSOR_TEST);
    this->Inputs.Activate(quad.Program, "evaluatorInputs");
    const float size[2] = { static_cast<float>(Width), static_cast<float>(height) };
    quad.Program->SetUniform2f("evaluatorSize", size);
    if (prepare)
    {
      prepare(quad.Program);
    }
    quad.Render();
    if (finish)
    {
      finish();
    }
    this->Inputs.Deactivate();
  }
  std::vector<Result> results(padded.size());
  this->Target.Read(0, { results.front().data(), 4 * results.size() });
  results.resize(cases.size());
  return results;
}
