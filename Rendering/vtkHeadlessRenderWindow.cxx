// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHeadlessRenderWindow.h"

#include "OpenGL/CurrentContext.h"
#include "OpenGL/LoadedFunctions.h"

#include "vtkAutoInit.h"
#include "vtkObjectFactory.h"
#include "vtkVersionMacros.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

VTK_MODULE_INIT(vtkRenderingOpenGL2)

namespace
{

// EGL hands out one display for each device and process, and terminating it ends every context on
// it: the last window to leave does that.
std::mutex DisplayMutex;
std::map<EGLDisplay, int> DisplayUsers;

bool AcquireDisplay(EGLDisplay display)
{
  const std::lock_guard<std::mutex> lock(DisplayMutex);
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr))
  {
    return false;
  }
  ++DisplayUsers[display];
  return true;
}

void ReleaseDisplay(EGLDisplay display)
{
  const std::lock_guard<std::mutex> lock(DisplayMutex);
  if (--DisplayUsers[display] == 0)
  {
    DisplayUsers.erase(display);
    eglTerminate(display);
  }
}

bool HasExtension(const char* extensions, const char* name)
{
  const std::size_t length = std::strlen(name);
  for (const char* at = extensions; at && (at = std::strstr(at, name)); at += length)
  {
    if ((at == extensions || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0'))
    {
      return true;
    }
  }
  return false;
}

std::vector<EGLDeviceEXT> GetDevices()
{
  const auto queryDevices =
    reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  EGLint count = 0;
  if (!queryDevices || !queryDevices(0, nullptr, &count))
  {
    return {};
  }
  std::vector<EGLDeviceEXT> devices(count);
  if (!queryDevices(count, devices.data(), &count))
  {
    return {};
  }
  devices.resize(count);
  return devices;
}

bool IsSoftware(EGLDeviceEXT device)
{
  const auto queryString =
    reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(eglGetProcAddress("eglQueryDeviceStringEXT"));
  return queryString &&
    HasExtension(queryString(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

// The displays to try, in this order.
std::vector<EGLDisplay> GetDisplays(int deviceIndex)
{
  const auto getPlatformDisplay = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
    eglGetProcAddress("eglGetPlatformDisplayEXT"));
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!getPlatformDisplay || !HasExtension(extensions, "EGL_EXT_platform_base"))
  {
    return {};
  }
  const std::vector<EGLDeviceEXT> devices = GetDevices();
  if (deviceIndex >= static_cast<int>(devices.size()))
  {
    throw std::runtime_error("DeviceIndex is " + std::to_string(deviceIndex) + ", EGL has " +
      std::to_string(devices.size()) + " devices, counted from 0");
  }
  if (deviceIndex >= 0)
  {
    return { getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[deviceIndex], nullptr) };
  }
  std::vector<EGLDisplay> displays;
  for (EGLDeviceEXT device : devices)
  {
    if (!IsSoftware(device))
    {
      displays.push_back(getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
  }
  if (HasExtension(extensions, "EGL_MESA_platform_surfaceless"))
  {
    displays.push_back(
      getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  }
  return displays;
}

// The newest core profile that VTK can make use of, down to the oldest that it can live with.
EGLContext CreateContext(EGLDisplay display)
{
  const EGLint configAttributes[] = { EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
    EGL_OPENGL_BIT, EGL_NONE };
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!HasExtension(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context") ||
    !eglBindAPI(EGL_OPENGL_API) ||
    !eglChooseConfig(display, configAttributes, &config, 1, &count) || count == 0)
  {
    return EGL_NO_CONTEXT;
  }
  const EGLint versions[][2] = { { 4, 5 }, { 4, 3 }, { 4, 1 }, { 3, 3 }, { 3, 2 } };
  for (const auto& version : versions)
  {
    const EGLint contextAttributes[] = { EGL_CONTEXT_MAJOR_VERSION, version[0],
      EGL_CONTEXT_MINOR_VERSION, version[1], EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE };
    const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, contextAttributes);
    if (context != EGL_NO_CONTEXT)
    {
      return context;
    }
  }
  return EGL_NO_CONTEXT;
}

} // namespace

// A context that is current without a surface: VTK renders into frame buffer objects of its own.
class vtkHeadlessRenderWindow::EglContext
{
public:
  // Throws std::runtime_error with one line that says what is missing.
  explicit EglContext(int deviceIndex)
  {
    for (EGLDisplay display : GetDisplays(deviceIndex))
    {
      if (!AcquireDisplay(display))
      {
        continue;
      }
      this->Display = display;
      this->Context = CreateContext(display);
      if (this->Context != EGL_NO_CONTEXT && this->MakeCurrent())
      {
        tetralux::CurrentContext::AddHeadless(this->Context);
        return;
      }
      this->Destroy();
    }
    throw std::runtime_error(
      "no OpenGL 3.2 context without a display: install Mesa's EGL (on Debian: apt-get install "
      "libegl1 libegl-mesa0 libgl1-mesa-dri) or a GPU driver that has EGL");
  }

  ~EglContext() { this->Destroy(); }

  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  bool MakeCurrent() const
  {
    if (this->IsCurrent())
    {
      return true;
    }
    tetralux::CurrentContext::LeaveGlx();
    return eglMakeCurrent(this->Display, EGL_NO_SURFACE, EGL_NO_SURFACE, this->Context);
  }

  bool IsCurrent() const { return eglGetCurrentContext() == this->Context; }

private:
  void Destroy()
  {
    if (this->Context != EGL_NO_CONTEXT)
    {
      if (this->IsCurrent())
      {
        eglMakeCurrent(this->Display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      }
      eglDestroyContext(this->Display, this->Context);
      tetralux::CurrentContext::RemoveHeadless(this->Context);
      this->Context = EGL_NO_CONTEXT;
    }
    ReleaseDisplay(this->Display);
  }

  EGLDisplay Display = EGL_NO_DISPLAY;
  EGLContext Context = EGL_NO_CONTEXT;
};

/// While one lives, the window's context may be current. Then that is again which was before, also
/// before MakeCurrent was called, as by those who read pixels.
class vtkHeadlessRenderWindow::ContextScope
{
public:
  explicit ContextScope(vtkHeadlessRenderWindow* window)
    : Window(window)
  {
    ++window->Scopes;
    if (window->Before && window->IsCurrent())
    {
      this->Before = *window->Before;
    }
    window->Before.reset();
  }
  ~ContextScope()
  {
    --this->Window->Scopes;
    this->Before.Restore();
  }
  ContextScope(const ContextScope&) = delete;
  ContextScope& operator=(const ContextScope&) = delete;

private:
  vtkHeadlessRenderWindow* Window;
  tetralux::CurrentContext Before;
};

vtkStandardNewMacro(vtkHeadlessRenderWindow);

//------------------------------------------------------------------------------------------------
vtkHeadlessRenderWindow::vtkHeadlessRenderWindow()
{
  this->SetSize(300, 300); // as VTK's other windows
  this->SetOffScreenRendering(1);
  this->SetMapped(1);
  this->SetIsDirect(1);
  this->SetOwnContext(0);
  this->SetFrameBlitModeToNoBlit();
  this->DeviceIndex = -1;
}

//------------------------------------------------------------------------------------------------
vtkHeadlessRenderWindow::~vtkHeadlessRenderWindow() { this->Finalize(); }

//------------------------------------------------------------------------------------------------
void vtkHeadlessRenderWindow::Initialize()
{
  if (this->Context || this->ContextFailed)
  {
    return;
  }
  const ContextScope scope(this);
  try
  {
    this->Context = std::make_unique<EglContext>(this->DeviceIndex);
  }
  catch (const std::exception& error)
  {
    this->ContextFailed = true;
    this->SetReadyForRendering(false);
    vtkErrorMacro(<< error.what());
    return;
  }
  this->SetReadyForRendering(true);
  this->OpenGLInit();
}

//------------------------------------------------------------------------------------------------
void vtkHeadlessRenderWindow::OpenGLInitContext()
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
  // GLAD asks the library of X or of the system, unless it is told.
  this->SetOpenGLSymbolLoader(
    [](void*, const char* name) { return eglGetProcAddress(name); }, nullptr);
#else
  // A GLEW that was built for X loads every entry point first, and only then finds that there is
  // no X display: for a context made through EGL that is success. The superclass would refuse it.
  if (!this->Initialized)
  {
    glewExperimental = GL_TRUE;
    const GLenum result = glewInit();
    if (result == GLEW_ERROR_NO_GLX_DISPLAY && GLEW_VERSION_3_2)
    {
      this->ContextCreationTime.Modified();
      this->GlewInitValid = true;
      this->Initialized = true;
      GLfloat range[2] = { 1, 1 };
      glGetFloatv(GL_ALIASED_LINE_WIDTH_RANGE, range);
      this->MaximumHardwareLineWidth = range[1];
      return;
    }
  }
#endif
  this->Superclass::OpenGLInitContext();
}

//------------------------------------------------------------------------------------------------
void vtkHeadlessRenderWindow::Render()
{
  const ContextScope scope(this);
  this->Initialize();
  if (this->Context)
  {
    this->Superclass::Render();
  }
}

//------------------------------------------------------------------------------------------------
void vtkHeadlessRenderWindow::MakeCurrent()
{
  this->Initialize();
  if (this->Scopes == 0 && this->Pushed.empty() && !this->IsCurrent())
  {
    this->Before = std::make_unique<tetralux::CurrentContext>();
  }
  if (this->Context && !this->Context->MakeCurrent())
  {
    vtkErrorMacro("eglMakeCurrent failed with error " << eglGetError());
  }
}

//------------------------------------------------------------------------------------------------
bool vtkHeadlessRenderWindow::IsCurrent() { return this->Context && this->Context->IsCurrent(); }

//------------------------------------------------------------------------------------------------
void vtkHeadlessRenderWindow::PushContext()
{
  this->Pushed.emplace_back();
  this->MakeCurrent();
}

//------------------------------------------------------------------------------------------------
void vtkHeadlessRenderWindow::PopContext()
{
  if (this->Pushed.empty())
  {
    return;
  }
  const tetralux::CurrentContext before = this->Pushed.back();
  this->Pushed.pop_back();
  before.Restore();
}

//------------------------------------------------------------------------------------------------
unsigned char* vtkHeadlessRenderWindow::GetPixelData(
  int x, int y, int x2, int y2, int front, int right)
{
  const ContextScope scope(this);
  return this->Superclass::GetPixelData(x, y, x2, y2, front, right);
}

//------------------------------------------------------------------------------------------------
int vtkHeadlessRenderWindow::GetPixelData(
  int x, int y, int x2, int y2, int front, vtkUnsignedCharArray* data, int right)
{
  const ContextScope scope(this);
  return this->Superclass::GetPixelData(x, y, x2, y2, front, data, right);
}

//------------------------------------------------------------------------------------------------
float* vtkHeadlessRenderWindow::GetRGBAPixelData(int x, int y, int x2, int y2, int front, int right)
{
  const ContextScope scope(this);
  return this->Superclass::GetRGBAPixelData(x, y, x2, y2, front, right);
}

//------------------------------------------------------------------------------------------------
int vtkHeadlessRenderWindow::GetRGBAPixelData(
  int x, int y, int x2, int y2, int front, vtkFloatArray* data, int right)
{
  const ContextScope scope(this);
  return this->Superclass::GetRGBAPixelData(x, y, x2, y2, front, data, right);
}

//------------------------------------------------------------------------------------------------
unsigned char* vtkHeadlessRenderWindow::GetRGBACharPixelData(
  int x, int y, int x2, int y2, int front, int right)
{
  const ContextScope scope(this);
  return this->Superclass::GetRGBACharPixelData(x, y, x2, y2, front, right);
}

//------------------------------------------------------------------------------------------------
int vtkHeadlessRenderWindow::GetRGBACharPixelData(
  int x, int y, int x2, int y2, int front, vtkUnsignedCharArray* data, int right)
{
  const ContextScope scope(this);
  return this->Superclass::GetRGBACharPixelData(x, y, x2, y2, front, data, right);
}

//------------------------------------------------------------------------------------------------
float* vtkHeadlessRenderWindow::GetZbufferData(int x1, int y1, int x2, int y2)
{
  const ContextScope scope(this);
  return this->Superclass::GetZbufferData(x1, y1, x2, y2);
}

//------------------------------------------------------------------------------------------------
int vtkHeadlessRenderWindow::GetZbufferData(int x1, int y1, int x2, int y2, float* z)
{
  const ContextScope scope(this);
  return this->Superclass::GetZbufferData(x1, y1, x2, y2, z);
}

//------------------------------------------------------------------------------------------------
int vtkHeadlessRenderWindow::GetZbufferData(int x1, int y1, int x2, int y2, vtkFloatArray* buffer)
{
  const ContextScope scope(this);
  return this->Superclass::GetZbufferData(x1, y1, x2, y2, buffer);
}

//------------------------------------------------------------------------------------------------
int vtkHeadlessRenderWindow::SupportsOpenGL()
{
  const ContextScope scope(this);
  this->Initialize();
  return this->Context && this->Initialized ? 1 : 0;
}

//------------------------------------------------------------------------------------------------
void vtkHeadlessRenderWindow::Finalize()
{
  if (this->Context)
  {
    const ContextScope scope(this);
    this->MakeCurrent();
    this->Superclass::Finalize();
    this->Initialized = false;
    this->Context.reset();
  }
  this->ContextFailed = false;
}

//------------------------------------------------------------------------------------------------
int vtkHeadlessRenderWindow::GetColorBufferSizes(int* rgba)
{
  constexpr int Bits = 8;
  std::fill_n(rgba, 4, Bits);
  return 4 * Bits;
}

//------------------------------------------------------------------------------------------------
void vtkHeadlessRenderWindow::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DeviceIndex: " << this->DeviceIndex << "\n";
  os << indent << "Context: " << (this->Context ? "EGL" : "none") << "\n";
}
