// SPDX-License-Identifier: BSD-3-Clause
#include "OpenGL/ScreenProgram.h"
#include "OpenGL/LoadedFunctions.h"

#include "CoverScreenVS.h"

#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"

#include <stdexcept>

namespace tetralux
{

void CheckShader(const std::string& name, const std::string& source, bool ofVertices)
{
  vtkNew<vtkShader> shader;
  shader->SetType(ofVertices ? vtkShader::Vertex : vtkShader::Fragment);
  shader->SetSource(source);
  const bool compiled = shader->Compile();
  const std::string log = shader->GetError();
  shader->Cleanup();
  if (!compiled)
  {
    throw std::runtime_error("the shader " + name + " does not compile: " + log);
  }
}

ScreenProgram::ScreenProgram()
  : Context(
      [this](vtkOpenGLRenderWindow*)
      {
        this->Empty->ReleaseGraphicsResources();
        this->Program = nullptr;
        this->Source.clear();
      })
{
}

ScreenProgram::~ScreenProgram() = default;

vtkShaderProgram* ScreenProgram::Use(vtkOpenGLRenderWindow* window, const std::string& name,
  const std::string& source, const std::string& vertexSource)
{
  this->Context.Set(window);
  if (source != this->Source)
  {
    CheckShader(name, source, false);
    if (!vertexSource.empty())
    {
      CheckShader(name, vertexSource, true);
    }
    this->Source = source;
    this->Program = window->GetShaderCache()->ReadyShaderProgram(
      vertexSource.empty() ? CoverScreenVS : vertexSource.c_str(), source.c_str(), "");
  }
  if (!this->Program || !window->GetShaderCache()->ReadyShaderProgram(this->Program))
  {
    this->Source.clear();
    throw std::runtime_error("the shader program " + name + " could not be linked");
  }
  return this->Program;
}

void ScreenProgram::Draw(int numberOfVertices)
{
  this->Empty->Bind();
  glDrawArrays(GL_TRIANGLES, 0, numberOfVertices);
  this->Empty->Release();
}

} // namespace tetralux
