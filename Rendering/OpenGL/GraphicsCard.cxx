// SPDX-License-Identifier: BSD-3-Clause
#include "OpenGL/GraphicsCard.h"
#include "OpenGL/LoadedFunctions.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace tetralux
{
namespace
{

/// Mesa's three, Google's, Microsoft's two and Apple's.
constexpr const char* SoftwareNames[] = { "llvmpipe", "softpipe", "software rasterizer",
  "swiftshader", "swr", "basic render driver", "gdi generic", "apple software renderer" };

bool HasExtension(const std::string& name)
{
  GLint count = 0;
  glGetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLint i = 0; i < count; ++i)
  {
    const auto* extension =
      reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i)));
    if (extension && name == extension)
    {
      return true;
    }
  }
  return false;
}

// Not all loaders of functions know these.
constexpr GLenum CurrentAvailableMemoryNVX = 0x9049;
constexpr GLenum TextureFreeMemoryATI = 0x87FC;

/// Free memory of the graphics card, bytes; -1 where it does not tell.
std::int64_t GetFreeBytes()
{
  constexpr std::int64_t Kibibyte = 1024;
  std::array<GLint, 4> kibibytes{};
  if (HasExtension("GL_NVX_gpu_memory_info"))
  {
    glGetIntegerv(CurrentAvailableMemoryNVX, kibibytes.data());
    return kibibytes[0] * Kibibyte;
  }
  if (HasExtension("GL_ATI_meminfo"))
  {
    glGetIntegerv(TextureFreeMemoryATI, kibibytes.data());
    return kibibytes[0] * Kibibyte;
  }
  return -1;
}

} // namespace

GraphicsCard DescribeGraphicsCard(vtkOpenGLRenderWindow* window)
{
  GraphicsCard card;
  const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  card.Renderer = renderer ? renderer : "unknown";
  card.Software = IsSoftwareRenderer(card.Renderer);
  glGetIntegerv(GL_MAJOR_VERSION, &card.Version[0]);
  glGetIntegerv(GL_MINOR_VERSION, &card.Version[1]);
  int texels = 0;
  window->GetState()->vtkglGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
  card.Limits.MaximumTexels = texels;
  card.Limits.FreeBytes = GetFreeBytes();
  return card;
}

bool IsSoftwareRenderer(std::string renderer)
{
  std::transform(renderer.begin(), renderer.end(), renderer.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::any_of(std::begin(SoftwareNames), std::end(SoftwareNames),
    [&renderer](const char* name) { return renderer.find(name) != std::string::npos; });
}

} // namespace tetralux
