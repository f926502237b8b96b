// SPDX-License-Identifier: BSD-3-Clause
#include "Frame/SampleDepths.h"
#include "OpenGL/LoadedFunctions.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace tetralux
{
namespace
{

/// Samples in a picture of the target: as many as it has channels.
constexpr int SamplesOfPicture = 4;

int CountPictures(int samples) { return (samples + SamplesOfPicture - 1) / SamplesOfPicture; }

/// One output for four samples; what is beyond the last sample is the last one again.
std::string MakeShader(int samples)
{
  std::string source = "#version 150\n//VTK::Output::Dec\nuniform sampler2DMS depths;\n"
                       "void main()\n{\n  ivec2 pixel = ivec2(gl_FragCoord.xy);\n";
  for (int picture = 0; picture < CountPictures(samples); ++picture)
  {
    source += "  gl_FragData[" + std::to_string(picture) + "] = vec4(";
    for (int k = 0; k < SamplesOfPicture; ++k)
    {
      const int sample = std::min(SamplesOfPicture * picture + k, samples - 1);
      source += (k > 0 ? ", " : "");
      source += "texelFetch(depths, pixel, " + std::to_string(sample) + ").r";
    }
    source += ");\n";
  }
  return source + "}\n";
}

} // namespace

std::vector<std::array<double, 2>> FindSamplePlaces()
{
  GLint samples = 0;
  glGetIntegerv(GL_SAMPLES, &samples);
  std::vector<std::array<double, 2>> places;
  for (GLint k = 0; samples > 1 && k < samples; ++k)
  {
    GLfloat place[2] = { 0, 0 };
    glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(k), place);
    places.push_back({ place[0], place[1] });
  }
  return places;
}

SampleDepths::SampleDepths()
  : Context(
      [this](vtkOpenGLRenderWindow* window)
      {
        this->Framebuffer->ReleaseGraphicsResources(window);
        this->Texture->ReleaseGraphicsResources(window);
        this->Target.ReleaseGraphicsResources(window);
        this->Program.ReleaseGraphicsResources(window);
      })
{
}

SampleDepths::~SampleDepths() = default;

/// Copies the depths into the texture: what is drawn into can't be read by shaders.
void SampleDepths::Copy(vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle, int samples)
{
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  state->vtkglDisable(GL_SCISSOR_TEST);
  GLint source = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &source);
  state->PushFramebufferBindings();
  state->vtkglBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<unsigned int>(source));
  const DepthFormat format = FindDepthFormat(source == 0);
  // Samples are copied only between the same places.
  const int width = rectangle.X + rectangle.Width;
  const int height = rectangle.Y + rectangle.Height;
  const bool changed = this->Texture->GetHandle() == 0 || !(format == this->Format) ||
    static_cast<int>(this->Texture->GetSamples()) != samples ||
    static_cast<int>(this->Texture->GetWidth()) != width ||
    static_cast<int>(this->Texture->GetHeight()) != height;
  if (changed)
  {
    AllocateDepths(this->Texture, window, format, width, height, samples);
    this->Format = format;
  }
  this->Framebuffer->SetContext(window);
  this->Framebuffer->Bind(GL_DRAW_FRAMEBUFFER);
  if (changed)
  {
    AttachDepths(this->Texture, format);
    unsigned int none = GL_NONE;
    state->vtkglDrawBuffers(1, &none);
  }
  glBlitFramebuffer(rectangle.X, rectangle.Y, width, height, rectangle.X, rectangle.Y, width,
    height, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  state->PopFramebufferBindings();
}

std::vector<float> SampleDepths::Read(
  vtkOpenGLRenderWindow* window, const PixelRectangle& rectangle, int samples)
{
  this->Context.Set(window);
  while (glGetError() != GL_NO_ERROR) // of others
  {
  }
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglActiveTexture unit(state);
  this->Copy(window, rectangle, samples);

  FloatTarget::Settings settings;
  settings.Width = static_cast<int>(this->Texture->GetWidth());
  settings.Height = static_cast<int>(this->Texture->GetHeight());
  settings.Pictures.assign(static_cast<std::size_t>(CountPictures(samples)), {});
  this->Target.Prepare(window, settings);
  {
    const FloatTarget::Use use(this->Target);
    const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
    const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
    const vtkOpenGLState::ScopedglEnableDisable cullFace(state, GL_CULL_FACE);
    const vtkOpenGLState::ScopedglEnableDisable scissorTest(state, GL_SCISSOR_TEST);
    const vtkOpenGLState::ScopedglScissor scissor(state);
    state->vtkglDisable(GL_BLEND);
    state->vtkglDisable(GL_DEPTH_TEST);
    state->vtkglDisable(GL_CULL_FACE);
    state->vtkglEnable(GL_SCISSOR_TEST);
    state->vtkglScissor(rectangle.X, rectangle.Y, rectangle.Width, rectangle.Height);
    vtkShaderProgram* program = this->Program.Use(window, "SampleDepthsFS", MakeShader(samples));
    this->Texture->Activate();
    program->SetUniformi("depths", this->Texture->GetTextureUnit());
    this->Program.Draw();
    this->Texture->Deactivate();
  }
  if (glGetError() != GL_NO_ERROR)
  {
    throw std::runtime_error("the samples of the depth buffer could not be read");
  }

  const std::size_t size = static_cast<std::size_t>(rectangle.Width) * rectangle.Height;
  std::vector<float> depths(samples * size);
  std::vector<float> values(
    static_cast<std::size_t>(SamplesOfPicture) * settings.Width * settings.Height);
  for (int picture = 0; picture < CountPictures(samples); ++picture)
  {
    this->Target.Read(picture, values);
    const int first = SamplesOfPicture * picture;
    for (int sample = first; sample < std::min(first + SamplesOfPicture, samples); ++sample)
    {
      float* out = depths.data() + sample * size;
      for (int y = 0; y < rectangle.Height; ++y)
      {
        const float* row = values.data() + sample - first +
          SamplesOfPicture *
            (static_cast<std::size_t>(rectangle.Y + y) * settings.Width + rectangle.X);
        for (int x = 0; x < rectangle.Width; ++x)
        {
          *out++ = row[SamplesOfPicture * x];
        }
      }
    }
  }
  return depths;
}

} // namespace tetralux
