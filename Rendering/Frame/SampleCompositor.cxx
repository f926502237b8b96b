// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/SampleCompositor.h"
#include "OpenGL/LoadedFunctions.h"

#include "SamplePixelsFS.h"
#include "SamplePixelsVS.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"

#include <string>

namespace tetralux
{
namespace
{

/// Two triangles.
constexpr int VerticesOfPixel = 6;

std::string MakeSource(const char* shader, const std::string& defines)
{
  std::string source = shader;
  vtkShaderProgram::Substitute(source, "//VTK::System::Dec", "#version 150\n" + defines);
  return source;
}

/// While one lives, one sample of each pixel is drawn into at a time.
class OneSample
{
public:
  OneSample()
    : Before(glIsEnabled(GL_SAMPLE_MASK))
  {
    glGetIntegeri_v(GL_SAMPLE_MASK_VALUE, 0, &this->Mask);
    glEnable(GL_SAMPLE_MASK);
  }
  ~OneSample()
  {
    glSampleMaski(0, static_cast<GLbitfield>(this->Mask));
    if (this->Before == GL_FALSE)
    {
      glDisable(GL_SAMPLE_MASK);
    }
  }
  OneSample(const OneSample&) = delete;
  OneSample& operator=(const OneSample&) = delete;

  void Choose(int sample) { glSampleMaski(0, GLbitfield{ 1 } << sample); }

private:
  GLboolean Before;
  GLint Mask = 0;
};

} // namespace

SampleCompositor::SampleCompositor()
  : Context(
      [this](vtkOpenGLRenderWindow* window)
      {
        this->ColorProgram.ReleaseGraphicsResources(window);
        this->DepthProgram.ReleaseGraphicsResources(window);
        this->Pixels.ReleaseGraphicsResources(window);
        this->Colors.ReleaseGraphicsResources(window);
        this->Depths.ReleaseGraphicsResources(window);
      })
{
}

SampleCompositor::~SampleCompositor() = default;

void SampleCompositor::Composite(
  vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle, const PixelSamples& samples)
{
  this->Context.Set(window);
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglActiveTexture unit(state);
  this->Pixels.Upload(window, samples.Pixels.data(), samples.Pixels.size(), 1, "pixels at edges");
  this->Colors.Upload(
    window, samples.Colors.data(), samples.Colors.size() / 4, 4, "samples of edges");

  const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglEnableDisable cullFace(state, GL_CULL_FACE);
  const vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  const vtkOpenGLState::ScopedglDepthMask depthMask(state);
  const vtkOpenGLState::ScopedglDepthFunc depthFunction(state);
  const vtkOpenGLState::ScopedglColorMask colorMask(state);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  const vtkOpenGLState::ScopedglViewport viewport(state);
  state->vtkglDisable(GL_CULL_FACE);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglViewport(rectangle.X, rectangle.Y, rectangle.Width, rectangle.Height);
  if (!samples.Depths.empty())
  {
    this->Depths.Upload(window, samples.Depths.data(), samples.Depths.size(), 1, "depths of edges");
    state->vtkglDisable(GL_BLEND);
    state->vtkglEnable(GL_DEPTH_TEST);
    state->vtkglDepthFunc(GL_LEQUAL);
    state->vtkglDepthMask(GL_TRUE);
    state->vtkglColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    this->Draw(this->DepthProgram, true, rectangle, samples, this->Depths);
    state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }
  state->vtkglEnable(GL_BLEND);
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  this->Draw(this->ColorProgram, false, rectangle, samples, this->Colors);
}

/// Draws colours or depths, sample by sample.
void SampleCompositor::Draw(ScreenProgram& screen, bool depths, const PixelRectangle& rectangle,
  const PixelSamples& samples, TextureBuffer& values)
{
  vtkShaderProgram* program = screen.Use(this->Context.Get(), "SamplePixelsFS",
    MakeSource(SamplePixelsFS, depths ? "#define WRITE_DEPTH\n" : ""),
    MakeSource(SamplePixelsVS, ""));
  this->Pixels.Activate(program, "pixels");
  values.Activate(program, "values");
  const int size[2] = { rectangle.Width, rectangle.Height };
  program->SetUniform2i("pictureSize", size);
  const auto count = static_cast<int>(samples.Pixels.size());
  OneSample one;
  for (int sample = 0; sample < samples.Samples; ++sample)
  {
    one.Choose(sample);
    program->SetUniformi("firstValue", sample * count);
    screen.Draw(VerticesOfPixel * count);
  }
  values.Deactivate();
  this->Pixels.Deactivate();
}

} // namespace tetralux
