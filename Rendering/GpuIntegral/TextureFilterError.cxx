// SPDX-License-Identifier: BSD-3-Clause
#include "GpuIntegral/TextureFilterError.h"

#include "FilterErrorFS.h"
#include "GpuIntegral/TexelTextureFormat.h"
#include "OpenGL/FloatTarget.h"
#include "OpenGL/LoadedFunctions.h"

#include "vtkNew.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace tetralux
{

double MeasureTextureFilterError(vtkOpenGLRenderWindow* window, TexelFormat format)
{
  // Shares between two texels that are tested: some for each step of weights of eight bits.
  constexpr int Shares = 1024;
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglActiveTexture unit(state);
  const vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglEnableDisable stencilTest(state, GL_STENCIL_TEST);
  const vtkOpenGLState::ScopedglEnableDisable cullFace(state, GL_CULL_FACE);
  const vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  for (const GLenum capability :
    { GL_BLEND, GL_DEPTH_TEST, GL_STENCIL_TEST, GL_CULL_FACE, GL_SCISSOR_TEST })
  {
    state->vtkglDisable(capability);
  }

  vtkNew<vtkTextureObject> texture;
  texture->SetContext(window);
  texture->SetInternalFormat(GetInternalFormat(format));
  texture->SetFormat(GL_RGBA);
  texture->SetDataType(GL_FLOAT);
  texture->SetMinificationFilter(vtkTextureObject::Linear);
  texture->SetMagnificationFilter(vtkTextureObject::Linear);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  texture->SetWrapR(vtkTextureObject::ClampToEdge);
  // Dark and bright texels by turns along the first axis.
  std::vector<float> texels;
  for (int k = 0; k < 2 * 2 * 2; ++k)
  {
    texels.insert(texels.end(), 4, static_cast<float>(k & 1));
  }
  FloatTarget target;
  FloatTarget::Settings settings;
  settings.Width = Shares;
  settings.Pictures.front().Components = 1;
  target.Prepare(window, settings);
  vtkOpenGLQuadHelper quad(window, nullptr, FilterErrorFS, "");
  if (!texture->Create3DFromRaw(2, 2, 2, 4, VTK_FLOAT, texels.data()) || !quad.Program ||
    !window->GetShaderCache()->ReadyShaderProgram(quad.Program))
  {
    throw std::runtime_error("the graphics card's interpolation could not be measured");
  }
  std::vector<float> errors(Shares);
  {
    const FloatTarget::Use use(target);
    texture->Activate();
    quad.Program->SetUniformi("texels", texture->GetTextureUnit());
    quad.Render();
    texture->Deactivate();
  }
  target.Read(0, errors);
  target.ReleaseGraphicsResources(window);
  return *std::max_element(errors.begin(), errors.end());
}

} // namespace tetralux
