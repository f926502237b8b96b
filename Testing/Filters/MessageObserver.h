// SPDX-License-Identifier: BSD-3-Clause
#ifndef MessageObserver_h
#define MessageObserver_h

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkObject.h"

#include <initializer_list>
#include <string>

/// Keeps what an object says on its error events, or on others, instead of printing it.
class MessageObserver
{
public:
  explicit MessageObserver(
    vtkObject* object, std::initializer_list<unsigned long> events = { vtkCommand::ErrorEvent })
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long, void* self, void* message)
      { static_cast<MessageObserver*>(self)->Text += static_cast<const char*>(message); });
    for (const unsigned long event : events)
    {
      object->AddObserver(event, this->Command);
    }
  }

  std::string Text;

private:
  vtkNew<vtkCallbackCommand> Command;
};

#endif
