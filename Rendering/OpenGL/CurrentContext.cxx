// SPDX-License-Identifier: BSD-3-Clause
#include "OpenGL/CurrentContext.h"

#include <EGL/egl.h>
#include <dlfcn.h>

#include <cstdlib>
#include <initializer_list>
#include <mutex>
#include <set>
#include <type_traits>

namespace tetralux
{
namespace
{

/// GLX, where the process has it.
struct Glx
{
  using Drawable = unsigned long; // as X has it

  void* (*GetCurrentContext)() = nullptr;
  void* (*GetCurrentDisplay)() = nullptr;
  Drawable (*GetCurrentDrawable)() = nullptr;
  Drawable (*GetCurrentReadDrawable)() = nullptr;
  int (*MakeContextCurrent)(void* display, Drawable draw, Drawable read, void* context) = nullptr;

  Glx()
  {
    void* library = nullptr;
    for (const char* name : { "libGLX.so.0", "libGL.so.1" })
    {
      library = library ? library : dlopen(name, RTLD_LAZY | RTLD_NOLOAD);
    }
    const auto find = [library](const char* name, auto& function)
    {
      using Function = std::remove_reference_t<decltype(function)>;
      function = library ? reinterpret_cast<Function>(dlsym(library, name)) : nullptr;
      return function != nullptr;
    };
    this->Found = find("glXGetCurrentContext", this->GetCurrentContext) &&
      find("glXGetCurrentDisplay", this->GetCurrentDisplay) &&
      find("glXGetCurrentDrawable", this->GetCurrentDrawable) &&
      find("glXGetCurrentReadDrawable", this->GetCurrentReadDrawable) &&
      find("glXMakeContextCurrent", this->MakeContextCurrent);
    // The library stays loaded as long as who loaded it.
    if (library)
    {
      dlclose(library);
    }
  }

  explicit operator bool() const { return this->Found; }

private:
  bool Found = false;
};

/// Contexts of windows without a display.
std::mutex HeadlessMutex;
std::set<void*> Headless;

/// Whether a window of this process may have its context through GLX.
bool HasDisplay()
{
  const char* name = std::getenv("DISPLAY");
  return name && *name != '\0';
}

} // namespace

CurrentContext::CurrentContext()
  : EglDisplay(eglGetCurrentDisplay())
  , EglDraw(eglGetCurrentSurface(EGL_DRAW))
  , EglRead(eglGetCurrentSurface(EGL_READ))
  , EglContext(eglGetCurrentContext())
{
  const Glx glx;
  if (this->EglContext == EGL_NO_CONTEXT && glx && glx.GetCurrentContext())
  {
    this->GlxContext = glx.GetCurrentContext();
    this->GlxDisplay = glx.GetCurrentDisplay();
    this->GlxDraw = glx.GetCurrentDrawable();
    this->GlxRead = glx.GetCurrentReadDrawable();
  }
}

void CurrentContext::Restore() const
{
  if (this->EglContext != EGL_NO_CONTEXT)
  {
    if (this->EglContext != eglGetCurrentContext())
    {
      LeaveGlx();
      eglMakeCurrent(this->EglDisplay, this->EglDraw, this->EglRead, this->EglContext);
    }
    return;
  }
  if (this->GlxContext || HasDisplay())
  {
    LeaveHeadless();
  }
  if (this->GlxContext)
  {
    Glx().MakeContextCurrent(this->GlxDisplay, this->GlxDraw, this->GlxRead, this->GlxContext);
  }
}

void CurrentContext::LeaveGlx()
{
  const Glx glx;
  if (glx && glx.GetCurrentContext())
  {
    glx.MakeContextCurrent(glx.GetCurrentDisplay(), 0, 0, nullptr);
  }
}

void CurrentContext::LeaveHeadless()
{
  const std::lock_guard<std::mutex> lock(HeadlessMutex);
  if (Headless.count(eglGetCurrentContext()) > 0)
  {
    eglMakeCurrent(eglGetCurrentDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
}

void CurrentContext::AddHeadless(void* context)
{
  const std::lock_guard<std::mutex> lock(HeadlessMutex);
  Headless.insert(context);
}

void CurrentContext::RemoveHeadless(void* context)
{
  const std::lock_guard<std::mutex> lock(HeadlessMutex);
  Headless.erase(context);
}

} // namespace tetralux
