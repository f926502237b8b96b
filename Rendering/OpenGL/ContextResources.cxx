// SPDX-License-Identifier: BSD-3-Clause
#include "OpenGL/ContextResources.h"

#include "OpenGL/EnteredContext.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkTextureObject.h"

#include <utility>

namespace tetralux
{

//------------------------------------------------------------------------------------------------
// A texture without texels: VTK's own objects are told that a context ends, and the class by which
// they are is not among its installed headers.
class ContextResources::Sentinel : public vtkTextureObject
{
public:
  static Sentinel* New();
  vtkTypeMacro(Sentinel, vtkTextureObject);
  Sentinel(const Sentinel&) = delete;
  void operator=(const Sentinel&) = delete;

  void ReleaseGraphicsResources(vtkWindow* window) override
  {
    if (ContextResources* const owner = std::exchange(this->Owner, nullptr))
    {
      owner->Forget();
    }
    this->Superclass::ReleaseGraphicsResources(window);
  }

  ContextResources* Owner = nullptr; ///< until it was told

protected:
  Sentinel() = default;
  ~Sentinel() override = default;
};

vtkStandardNewMacro(ContextResources::Sentinel);

//------------------------------------------------------------------------------------------------
ContextResources::ContextResources(std::function<void(vtkOpenGLRenderWindow*)> release)
  : ReleaseAll(std::move(release))
{
}

ContextResources::~ContextResources() { this->Release(this->Window); }

void ContextResources::Set(vtkOpenGLRenderWindow* window)
{
  if (this->Window == window)
  {
    return;
  }
  this->Release(this->Window);
  this->Told = vtkSmartPointer<Sentinel>::New();
  this->Told->SetContext(window);
  this->Told->Owner = this;
  this->Window = window;
  window->MakeCurrent(); // not all windows have a way back from the context that Release entered
}

void ContextResources::Release(vtkWindow* window)
{
  if (!this->Window || window != this->Window)
  {
    return;
  }
  vtkOpenGLRenderWindow* const last = this->Window;
  const EnteredContext context(last);
  this->Told->ReleaseGraphicsResources(last);
}

/// Called by the sentinel, which therefore stays, while the context is current.
void ContextResources::Forget() { this->ReleaseAll(std::exchange(this->Window, nullptr)); }

} // namespace tetralux
