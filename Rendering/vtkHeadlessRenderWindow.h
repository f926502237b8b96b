// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHeadlessRenderWindow
 * @brief   OpenGL render window that needs neither a display nor an X server
 *
 * Owns an OpenGL context made through EGL and renders into VTK's own frame buffers, from which
 * vtkWindowToImageFilter reads. The context is made on the first call that needs it: on a GPU
 * where a driver offers one, else by Mesa in software. Any number of windows may live at once.
 *
 * DeviceIndex is the device of EGL that renders, counted from 0 in EGL's order. With a negative
 * one, default -1, it is the first hardware device that works, else Mesa in software. It takes
 * effect when the context is made.
 *
 * Windows with a display may live beside it. Where there may be one, which the environment variable
 * DISPLAY says, the context stays current from MakeCurrent() to the next call that renders or reads
 * pixels, and from PushContext() to PopContext(), and no longer: a window whose context is made
 * current by GLX would end the process.
 *
 * If no context can be made, one error says what to install, and Render() does nothing;
 * SupportsOpenGL() asks beforehand.
 *
 * Works with any build of VTK. Prefer vtkEGLRenderWindow or vtkOSOpenGLRenderWindow if VTK was
 * built for EGL or OSMesa, where vtkRenderWindow::New() makes them; VTK 9.4 and later choose at run
 * time.
 *
 * Registers VTK's OpenGL classes with the object factory, so that vtkRenderer::New() works in a
 * program that initialises no VTK modules itself.
 */
#ifndef vtkHeadlessRenderWindow_h
#define vtkHeadlessRenderWindow_h

#include "TetraluxRenderingModule.h" // For export macro
#include "vtkGenericOpenGLRenderWindow.h"

#include <memory> // For std::unique_ptr
#include <vector> // For std::vector

namespace tetralux
{
class CurrentContext;
} // namespace tetralux

class TETRALUXRENDERING_EXPORT vtkHeadlessRenderWindow : public vtkGenericOpenGLRenderWindow
{
public:
  static vtkHeadlessRenderWindow* New();
  vtkTypeMacro(vtkHeadlessRenderWindow, vtkGenericOpenGLRenderWindow);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * As in vtkRenderWindow; each makes the context if there is none yet.
   */
  void Initialize() override;
  void Render() override;
  void MakeCurrent() override;
  int SupportsOpenGL() override;
  ///@}

  bool IsCurrent() override;

  ///@{
  /**
   * Makes the window's context current, and again the one that was before. To be called in pairs.
   */
  void PushContext() override;
  void PopContext() override;
  ///@}

  /**
   * Releases every graphics resource and the context. A later Render() makes a new one.
   */
  void Finalize() override;

  void OpenGLInitContext() override;

  ///@{
  /**
   * As in vtkOpenGLRenderWindow.
   */
  unsigned char* GetPixelData(int x, int y, int x2, int y2, int front, int right) override;
  int GetPixelData(
    int x, int y, int x2, int y2, int front, vtkUnsignedCharArray* data, int right) override;
  float* GetRGBAPixelData(int x, int y, int x2, int y2, int front, int right = 0) override;
  int GetRGBAPixelData(
    int x, int y, int x2, int y2, int front, vtkFloatArray* data, int right = 0) override;
  unsigned char* GetRGBACharPixelData(
    int x, int y, int x2, int y2, int front, int right = 0) override;
  int GetRGBACharPixelData(
    int x, int y, int x2, int y2, int front, vtkUnsignedCharArray* data, int right = 0) override;
  float* GetZbufferData(int x1, int y1, int x2, int y2) override;
  int GetZbufferData(int x1, int y1, int x2, int y2, float* z) override;
  int GetZbufferData(int x1, int y1, int x2, int y2, vtkFloatArray* buffer) override;
  ///@}

  /**
   * Bits of red, green, blue and alpha in the frame buffers that VTK renders into, and their sum;
   * there are no others that could be asked. vtkHardwareSelector wants to know.
   */
  int GetColorBufferSizes(int* rgba) override;

protected:
  vtkHeadlessRenderWindow();
  ~vtkHeadlessRenderWindow() override;

private:
  vtkHeadlessRenderWindow(const vtkHeadlessRenderWindow&) = delete;
  void operator=(const vtkHeadlessRenderWindow&) = delete;

  class EglContext;
  std::unique_ptr<EglContext> Context;

  class ContextScope;
  std::vector<tetralux::CurrentContext> Pushed;
  std::unique_ptr<tetralux::CurrentContext> Before; ///< MakeCurrent was called
  int Scopes = 0;                                   ///< that live

  // One report per cause, not one per frame.
  bool ContextFailed = false;
};

#endif
