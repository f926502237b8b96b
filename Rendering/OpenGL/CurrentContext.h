// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CurrentContext_h
#define tetralux_CurrentContext_h

#include "TetraluxRenderingModule.h"

namespace tetralux
{

/// Whichever context of EGL or GLX is current in this thread, of whatever window, or none. EGL
/// refuses to make a context current to a thread that another one is current to through GLX, and
/// GLX ends the process in the other order: so whichever it is has to be left before.
class TETRALUXRENDERING_EXPORT CurrentContext
{
public:
  /// The one that is current now.
  CurrentContext();

  /// Makes it current again. Where there was none, a context stays current that no GLX can meet.
  void Restore() const;

  /// Makes none current where that one is of GLX.
  static void LeaveGlx();

  /// Makes none current where that one is of a vtkHeadlessRenderWindow: nobody else makes it
  /// current. Those of other windows may be current without a way back.
  static void LeaveHeadless();

  ///@{
  /// A context of EGL that is of a vtkHeadlessRenderWindow, until it ends.
  static void AddHeadless(void* context);
  static void RemoveHeadless(void* context);
  ///@}

private:
  // As EGL and GLX have them, whose headers define names of their own.
  void* EglDisplay;
  void* EglDraw;
  void* EglRead;
  void* EglContext;
  void* GlxDisplay = nullptr;
  void* GlxContext = nullptr;
  unsigned long GlxDraw = 0;
  unsigned long GlxRead = 0;
};

} // namespace tetralux

#endif
