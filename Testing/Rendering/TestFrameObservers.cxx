// SPDX-License-Identifier: BSD-3-Clause
// Observers that change the pipeline while a frame is drawn: what it reads is held until it ends.
#include "AnyMapperScene.h"
#include "Observer.h"

#include "vtkCommand.h"
#include "vtkFloatArray.h"
#include "vtkPlane.h"
#include "vtkPointData.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace
{

// What a program has of a scene; what it lets go is nobody's but the frame's.
struct Parts
{
  vtkHeadlessRenderWindow* Window;
  vtkSmartPointer<vtkRenderer> Renderer;
  vtkSmartPointer<vtkVolume> Volume;
  vtkSmartPointer<vtkAbstractVolumeMapper> Mapper;
  vtkSmartPointer<vtkImageData> Input;
};

using Change = std::pair<const char*, std::function<void(Parts&)>>;

const std::vector<Change>& GetChanges()
{
  static const std::vector<Change> changes = {
    { "empties the input", [](Parts& parts) { parts.Input->Initialize(); } },
    { "releases the input", [](Parts& parts) { parts.Input->ReleaseData(); } },
    { "sets other values",
      [](Parts& parts)
      {
        vtkNew<vtkFloatArray> values;
        values->SetNumberOfTuples(parts.Input->GetNumberOfPoints());
        values->FillValue(0.5);
        parts.Input->GetPointData()->Initialize();
        parts.Input->GetPointData()->SetScalars(values);
      } },
    { "takes the input away", [](Parts& parts) { parts.Mapper->SetInputDataObject(nullptr); } },
    { "sets another input",
      [](Parts& parts)
      {
        parts.Mapper->SetInputDataObject(MakeField());
        parts.Input = nullptr;
      } },
    { "sets another mapper",
      [](Parts& parts)
      {
        parts.Volume->SetMapper(MakeMapper(parts.Mapper->GetClassName()));
        parts.Mapper = nullptr;
        parts.Input = nullptr;
      } },
    { "sets another property",
      [](Parts& parts) { parts.Volume->SetProperty(vtkSmartPointer<vtkVolumeProperty>::New()); } },
    { "adds a clipping plane",
      [](Parts& parts) { parts.Mapper->AddClippingPlane(vtkSmartPointer<vtkPlane>::New()); } },
    { "removes the volume", [](Parts& parts) { parts.Renderer->RemoveVolume(parts.Volume); } },
    { "forgets the volume",
      [](Parts& parts)
      {
        parts.Renderer->RemoveVolume(parts.Volume);
        parts.Volume = nullptr;
        parts.Mapper = nullptr;
        parts.Input = nullptr;
      } },
    { "releases graphics resources",
      [](Parts& parts) { parts.Mapper->ReleaseGraphicsResources(parts.Window); } },
    { "asks for the picture", [](Parts& parts) { EXPECT_TRUE(GetPicture(parts.Mapper).empty()); } },
    { "renders the window", [](Parts& parts) { parts.Window->Render(); } },
  };
  return changes;
}

} // namespace

class FrameObservers : public AnyMapper
{
};

INSTANTIATE_TEST_SUITE_P(
  Mappers, FrameObservers, testing::ValuesIn(GetMapperClasses()), NameAnyMapperTest);

TEST_P(FrameObservers, MayChangeWhatIsDrawn)
{
  AnyMapperScene scene(MakeMapper(this->GetParam()));
  scene.Render();
  const std::vector<int> expected = scene.Grab();
  ASSERT_GT(*std::max_element(expected.begin(), expected.end()), 20);
  scene.Renderer->RemoveVolume(scene.Volume);
  vtkObject::GlobalWarningDisplayOff(); // of the frames that follow, without an input

  const bool ofImages = this->GetParam() == "vtkTriangleCasterMapper";
  for (const unsigned long event :
    { vtkCommand::VolumeMapperRenderProgressEvent, vtkCommand::ProgressEvent })
  {
    for (const auto& [name, change] : GetChanges())
    {
      if (event == vtkCommand::ProgressEvent && ofImages)
      {
        continue; // of meshes that are made
      }
      SCOPED_TRACE(std::string(name) + " on " + vtkCommand::GetStringFromEventId(event));
      Parts parts{ scene.Window, scene.Renderer.Get(), vtkSmartPointer<vtkVolume>::New(),
        MakeMapper(this->GetParam()), MakeField() };
      parts.Mapper->SetInputDataObject(parts.Input);
      parts.Volume->SetMapper(parts.Mapper);
      parts.Volume->SetProperty(scene.Volume->GetProperty());
      parts.Renderer->AddVolume(parts.Volume);
      bool drawing = false;
      bool done = false;
      const Observer start(parts.Mapper, vtkCommand::VolumeMapperRenderStartEvent,
        [&](const char*) { drawing = true; });
      // VTK, too, tells of progress, before the frame.
      const Observer progress(parts.Mapper, event,
        [&, &effect = change](const char*)
        {
          if (drawing && !std::exchange(done, true))
          {
            effect(parts);
          }
        });
      scene.Window->Render();
      EXPECT_TRUE(done);
      EXPECT_EQ(scene.Grab(), expected);
      scene.Window->Render(); // of what there is now
      scene.Renderer->RemoveAllViewProps();
    }
  }
  vtkObject::GlobalWarningDisplayOn();
}

// VTK updates a mapper for its bounds before the frame, too. Whoever forgets the volume then takes
// it away from vtkVolume itself, which VTK does not survive.
TEST_P(FrameObservers, MayChangeWhatIsUpdated)
{
  AnyMapperScene scene(MakeMapper(this->GetParam()));
  scene.Renderer->RemoveVolume(scene.Volume);
  vtkObject::GlobalWarningDisplayOff(); // of the frames that follow, without an input
  for (const unsigned long event :
    { vtkCommand::StartEvent, vtkCommand::ProgressEvent, vtkCommand::EndEvent })
  {
    for (const auto& [name, change] : GetChanges())
    {
      const std::string what = name;
      if (what == "forgets the volume" || what == "asks for the picture")
      {
        continue;
      }
      SCOPED_TRACE(what + " on " + vtkCommand::GetStringFromEventId(event));
      Parts parts{ scene.Window, scene.Renderer.Get(), vtkSmartPointer<vtkVolume>::New(),
        MakeMapper(this->GetParam()), MakeField() };
      parts.Mapper->SetInputDataObject(parts.Input);
      parts.Volume->SetMapper(parts.Mapper);
      parts.Volume->SetProperty(scene.Volume->GetProperty());
      parts.Renderer->AddVolume(parts.Volume);
      bool done = false;
      const Observer observer(parts.Mapper, event,
        [&, &effect = change](const char*)
        {
          if (!std::exchange(done, true))
          {
            effect(parts);
          }
        });
      scene.Window->Render();
      EXPECT_TRUE(done);
      scene.Window->Render(); // of what there is now
      scene.Renderer->RemoveAllViewProps();
    }
  }
  vtkObject::GlobalWarningDisplayOn();
}

TEST_P(FrameObservers, MayLetAnotherWindowOfTheMapperGo)
{
  const vtkSmartPointer<vtkAbstractVolumeMapper> mapper = MakeMapper(this->GetParam());
  AnyMapperScene scene(mapper);
  auto other = std::make_unique<AnyMapperScene>(mapper);
  other->Render();
  {
    const Observer progress(
      mapper, vtkCommand::VolumeMapperRenderProgressEvent, [&](const char*) { other = nullptr; });
    scene.Window->Render();
  }
  EXPECT_EQ(other, nullptr);
  const std::vector<float> picture = GetPicture(mapper);
  EXPECT_GT(*std::max_element(picture.begin(), picture.end()), 0.1);
  EXPECT_EQ(scene.Render(), picture);
}

TEST_P(FrameObservers, CannotDrawAFrameInAFrame)
{
  const vtkSmartPointer<vtkAbstractVolumeMapper> mapper = MakeMapper(this->GetParam());
  AnyMapperScene scene(mapper);
  AnyMapperScene other(mapper);
  const MessageObserver warnings(mapper, { vtkCommand::WarningEvent });
  {
    const Observer progress(mapper, vtkCommand::VolumeMapperRenderProgressEvent,
      [&](const char*) { other.Window->Render(); });
    scene.Window->Render();
    EXPECT_NE(warnings.Text.find("a frame that an observer asks for"), std::string::npos);
  }
  // What the observer drew into another context has not disturbed the frame.
  const std::vector<float> picture = GetPicture(mapper);
  EXPECT_GT(*std::max_element(picture.begin(), picture.end()), 0.1);
  EXPECT_EQ(other.Render(), picture);
  EXPECT_EQ(scene.Render(), picture);
}
