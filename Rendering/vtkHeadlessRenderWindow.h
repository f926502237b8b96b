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

  struct CurrentContext;
  std::vector<CurrentContext> Pushed;

  // One report per cause, not one per frame.
  bool ContextFailed = false;
};

#endif
