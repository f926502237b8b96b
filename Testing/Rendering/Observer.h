// SPDX-License-Identifier: BSD-3-Clause
#ifndef Observer_h
#define Observer_h

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkWeakPointer.h"

#include <functional>
#include <utility>

/// Calls a function on an event of an object, as long as it lives, with what comes along as text.
class Observer
{
public:
  Observer(vtkObject* object, unsigned long event, std::function<void(const char*)> function)
    : Object(object)
    , Function(std::move(function))
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long, void* self, void* data)
      { static_cast<Observer*>(self)->Function(static_cast<const char*>(data)); });
    object->AddObserver(event, this->Command);
  }
  ~Observer()
  {
    if (this->Object)
    {
      this->Object->RemoveObserver(this->Command);
    }
  }
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;

private:
  vtkWeakPointer<vtkObject> Object;
  std::function<void(const char*)> Function;
  vtkNew<vtkCallbackCommand> Command;
};

#endif
