// SPDX-License-Identifier: BSD-3-Clause
#ifndef Observer_h
#define Observer_h

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkWeakPointer.h"

#include <deque>
#include <functional>
#include <initializer_list>
#include <string>
#include <utility>

/// Calls a function on an event of an object, with the text of the event, until one of
/// the two ends.
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

/// Keeps the messages of an object's errors, or of other events, instead of printing them.
class MessageObserver
{
public:
  explicit MessageObserver(
    vtkObject* object, std::initializer_list<unsigned long> events = { vtkCommand::ErrorEvent })
  {
    for (const unsigned long event : events)
    {
      this->Observers.emplace_back(
        object, event, [this](const char* message) { this->Text += message; });
    }
  }

  std::string Text;

private:
  std::deque<Observer> Observers;
};

#endif
