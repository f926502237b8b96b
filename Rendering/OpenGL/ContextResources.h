// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ContextResources_h
#define tetralux_ContextResources_h

#include "TetraluxRenderingModule.h"

#include "vtkSmartPointer.h"

#include <functional>

class vtkOpenGLRenderWindow;
class vtkWindow;

namespace tetralux
{

/// The context, of a window, that has what an owner made on the graphics card. A context ends with
/// its window, or before it where the window is finalized. VTK then tells mappers of volumes in the
/// window, and no others; this tells any owner. A weak pointer would not do: it is null before the
/// window's destructor ends the context.
class TETRALUXRENDERING_EXPORT ContextResources
{
public:
  /// release: deletes and forgets what the owner made, while the context is current. Called once
  /// for each context that was set: by the window before the context ends, by Set before another
  /// one is set, by Release, and by the destructor. The owner declares it behind what release
  /// needs.
  explicit ContextResources(std::function<void(vtkOpenGLRenderWindow*)> release);
  ~ContextResources();
  ContextResources(const ContextResources&) = delete;
  ContextResources& operator=(const ContextResources&) = delete;

  /// To be called before anything is made; the window's context is current afterwards.
  void Set(vtkOpenGLRenderWindow* window);

  /// nullptr: there is nothing on the graphics card.
  vtkOpenGLRenderWindow* Get() const { return this->Window; }

  /// window: the one whose context ends; nothing is done for others.
  void Release(vtkWindow* window);

private:
  class Sentinel;

  void Forget();

  std::function<void(vtkOpenGLRenderWindow*)> ReleaseAll;
  vtkOpenGLRenderWindow* Window = nullptr; ///< lives as long as the sentinel is not called
  vtkSmartPointer<Sentinel> Told;          ///< registered with Window
};

} // namespace tetralux

#endif
