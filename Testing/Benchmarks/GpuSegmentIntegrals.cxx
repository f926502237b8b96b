// SPDX-License-Identifier: BSD-3-Clause

// What a segment's integral costs in a shader, nanoseconds each: closed form, optical depth,
// tables. Of each pixel's 64 segments, neighbouring pixels see nearly the same scalars, as in a
// picture. Wall time of the graphics card's answer and time of all of this process's threads, which
// is what counts with software OpenGL; the best of some runs. Prints a table, takes no arguments.

#include "GpuIntegral/GpuSegmentIntegral.h"
#include "OpenGL/FloatTarget.h"
#include "OpenGL/LoadedFunctions.h"
#include "Optics/IntervalTable.h"
#include "PreIntegration/PreIntegrationBuilder.h"

#include "vtkHeadlessRenderWindow.h"
#include "vtkNew.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <string>

namespace
{

using namespace tetralux;

constexpr int Size = 256;
constexpr int Segments = 64;
constexpr int Runs = 8;

constexpr const char* Begin = R"(//VTK::System::Dec
//VTK::Output::Dec
in vec2 texCoord;
)";

constexpr const char* Main = R"(
uniform float cellSize; // of the scalar range
uniform float len;
void main()
{
  vec4 gathered = vec4(0.0);
  float front = 0.0;
  for (int segment = 0; segment < 64; ++segment)
  {
    float w = float(segment);
    float back = sin(w * cellSize * 3.0 + 5.0 * texCoord.x) *
      cos(w * cellSize * 2.0 + 3.0 * texCoord.y);
    vec4 part = IntegrateSegment(front, back, len);
    gathered += (1.0 - gathered.a) * part;
    front = back;
  }
  gl_FragData[0] = gathered;
}
)";

/// Nodes at equal distances, with all colours different.
TransferFunction MakeFunction(int nodes)
{
  TransferFunction function;
  for (int k = 0; k < nodes; ++k)
  {
    const double u = static_cast<double>(k) / (nodes - 1);
    const TransferFunction::Value value{ { u, 1 - u, k % 2 ? 0.8 : 0.2 }, 1 + std::sin(7 * u + 1) };
    function.Nodes.push_back({ -1 + 2 * u, value, value });
  }
  return function;
}

void Measure(vtkHeadlessRenderWindow* window, const std::string& name, const SegmentSource& source,
  float cellSize, float length)
{
  GpuSegmentIntegral integral;
  integral.Update(window, source);
  FloatTarget target;
  FloatTarget::Settings settings;
  settings.Width = settings.Height = Size;
  target.Prepare(window, settings);
  const std::string code = Begin + integral.GetDeclarations() + Main;
  vtkOpenGLQuadHelper quad(window, nullptr, code.c_str(), "");
  window->GetShaderCache()->ReadyShaderProgram(quad.Program);
  const FloatTarget::Use use(target);
  window->GetState()->vtkglDisable(GL_BLEND);
  window->GetState()->vtkglDisable(GL_DEPTH_TEST);
  integral.Activate(quad.Program);
  quad.Program->SetUniformf("cellSize", cellSize);
  quad.Program->SetUniformf("len", length);
  double wall = 1e30;
  double processor = 1e30;
  for (int run = 0; run < Runs; ++run)
  {
    glFinish();
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t clocks = std::clock();
    quad.Render();
    glFinish();
    processor = std::min(processor, static_cast<double>(std::clock() - clocks) / CLOCKS_PER_SEC);
    wall = std::min(
      wall, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  integral.Deactivate();
  integral.ReleaseGraphicsResources(window);
  target.ReleaseGraphicsResources(window);
  constexpr double Count = static_cast<double>(Size) * Size * Segments;
  std::printf(
    "| %-40s | %8.2f | %8.2f |\n", name.c_str(), 1e9 * wall / Count, 1e9 * processor / Count);
  std::fflush(stdout);
}

} // namespace

int main()
{
  vtkNew<vtkHeadlessRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  window->AddRenderer(renderer);
  window->Render();
  std::printf("%s\n", reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
  std::printf("| %-40s | wall, ns | processor, ns |\n|---|---|---|\n", "segment");
  for (const int nodes : { 2, 5, 20 })
  {
    const TransferFunction function = MakeFunction(nodes);
    const IntervalTable intervals = MakeIntervalTable(function);
    for (const float cellSize : { 0.03f, 0.2f })
    {
      const std::string suffix =
        ", " + std::to_string(nodes) + " nodes, cells " + std::to_string(cellSize).substr(0, 4);
      SegmentSource source;
      source.Intervals = &intervals;
      Measure(window, "closed form" + suffix, source, cellSize, 0.05f);
      source.LongestSegment = 0.5; // of an optical depth of 1 at most
      Measure(window, "closed form, only thin" + suffix, source, cellSize, 0.05f);
      source.LongestSegment = std::numeric_limits<double>::infinity();
      Measure(window, "closed form, thick" + suffix, source, cellSize, 5);
      source.Integrator = tetralux::Integrator::OpticalDepth;
      Measure(window, "optical depth" + suffix, source, cellSize, 0.05f);
      source.Integrator = tetralux::Integrator::ClosedForm;
      std::uint64_t version = 0;
      for (const TexelFormat format : { TexelFormat::Float, TexelFormat::UNorm8 })
      {
        for (const ScalarAxis axis : { ScalarAxis::Nodes, ScalarAxis::Uniform })
        {
          PreIntegrationSettings table;
          table.ScalarSize = 64;
          table.LengthSize = 32;
          table.Axis = axis;
          table.Format = format;
          table.ScalarRange[0] = -1;
          table.LongestSegment = 5;
          PreIntegrationTable texels;
          BuildPreIntegrationTable(function, table, texels);
          source.Integrator = tetralux::Integrator::Table;
          source.Table = &texels;
          source.TableVersion = ++version;
          for (const bool filtering : { false, true })
          {
            source.FilterInShader = !filtering;
            Measure(window,
              std::string("table ") + (format == TexelFormat::Float ? "float" : "8 bit") +
                (axis == ScalarAxis::Nodes ? " nodes" : " uniform") +
                (filtering ? " filtered" : "") + suffix,
              source, cellSize, 0.05f);
          }
        }
      }
    }
  }
  return 0;
}
