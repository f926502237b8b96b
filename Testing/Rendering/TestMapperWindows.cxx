// SPDX-License-Identifier: BSD-3-Clause
// Mappers that live longer than their window, or are in several: what is on the graphics card
// belongs to a context, and is known to be gone with it.
#include "AnyMapperScene.h"
#include "Observer.h"

#include "MapperPropertyAccess.h"

#include "vtkActor.h"
#include "vtkCommand.h"
#include "vtkPolyDataMapper.h"
#include "vtkSphereSource.h"

#include <algorithm>

namespace
{

void AddSphere(vtkRenderer* renderer)
{
  vtkNew<vtkSphereSource> source;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
}

} // namespace

INSTANTIATE_TEST_SUITE_P(
  Mappers, AnyMapper, testing::ValuesIn(GetMapperClasses()), NameAnyMapperTest);

TEST_P(AnyMapper, OutlivesItsWindow)
{
  AnyMapperScene other(MakeMapper(this->GetParam()));
  const std::vector<float> expected = other.Render();
  const std::vector<int> window = other.Grab();
  ASSERT_FALSE(expected.empty());
  ASSERT_GT(*std::max_element(window.begin(), window.end()), 20);

  const vtkSmartPointer<vtkAbstractVolumeMapper> mapper = MakeMapper(this->GetParam());
  for (const char* end : { "deleted", "taken off", "finalized", "finalized when taken off" })
  {
    SCOPED_TRACE(end);
    const std::string how = end;
    AnyMapperScene next(mapper);
    {
      AnyMapperScene scene(mapper);
      EXPECT_EQ(scene.Render(), expected);
      if (how == "taken off" || how == "finalized when taken off")
      {
        scene.Use(MakeMapper(this->GetParam()));
      }
      if (how == "finalized" || how == "finalized when taken off")
      {
        scene.Window->Finalize();
        EXPECT_TRUE(GetPicture(mapper).empty());
        scene.Use(mapper);
        EXPECT_EQ(scene.Render(), expected);
        EXPECT_EQ(scene.Grab(), window);
      }
    }
    EXPECT_TRUE(GetPicture(mapper).empty());
    EXPECT_EQ(next.Render(), expected);
    EXPECT_EQ(next.Grab(), window);
  }
}

TEST_P(AnyMapper, DrawsInTwoWindowsByTurns)
{
  AnyMapperScene other(MakeMapper(this->GetParam()));
  const std::vector<float> expected = other.Render();
  const std::vector<int> window = other.Grab();
  const vtkSmartPointer<vtkAbstractVolumeMapper> mapper = MakeMapper(this->GetParam());
  AnyMapperScene stays(mapper);
  {
    AnyMapperScene goes(mapper);
    for (AnyMapperScene* scene : { &goes, &stays, &goes, &stays })
    {
      EXPECT_EQ(scene->Render(), expected);
      EXPECT_EQ(scene->Grab(), window);
    }
  }
  EXPECT_EQ(GetPicture(mapper), expected); // of the window that stays
  EXPECT_EQ(stays.Render(), expected);
  EXPECT_EQ(stays.Grab(), window);
}

TEST_P(AnyMapper, KeepsThePictureOfAnInputThatHasGone)
{
  AnyMapperScene other(MakeMapper(this->GetParam()));
  AnyMapperScene scene(MakeMapper(this->GetParam()));
  const std::vector<float> expected = other.Render();
  scene.Window->Render();
  scene.GetMapper()->SetInputDataObject(nullptr);
  EXPECT_EQ(GetPicture(scene.GetMapper()), expected);
}

TEST_P(AnyMapper, LeavesNoPictureOfAnAbortedFrame)
{
  AnyMapperScene scene(MakeMapper(this->GetParam()));
  const tetralux::MapperProperty& threads = tetralux::GetMapperProperty("NumberOfThreads");
  if ((threads.Kinds & tetralux::GetKind(scene.GetMapper())) != 0)
  {
    // Else other threads may have finished before the calling one asks whether to go on.
    tetralux::SetPropertyValues(scene.GetMapper(), threads, { 1 });
  }
  {
    const Observer abort(scene.GetMapper(), vtkCommand::VolumeMapperRenderProgressEvent,
      [&](const char*) { scene.Window->SetAbortRender(1); });
    EXPECT_TRUE(scene.Render().empty());
    EXPECT_EQ(scene.Get("aborted"), "true");
  }
  const std::vector<float> picture = scene.Render();
  EXPECT_EQ(scene.Get("aborted"), "false");
  EXPECT_FALSE(picture.empty());
}

// What a mapper deletes is in its own context, whichever is current.
TEST_P(AnyMapper, LeavesOtherContextsAlone)
{
  AnyMapperScene beside(MakeMapper(this->GetParam()));
  AddSphere(beside.Renderer);
  beside.Render();
  const std::vector<int> expected = beside.Grab();
  {
    const vtkSmartPointer<vtkAbstractVolumeMapper> mapper = MakeMapper(this->GetParam());
    {
      AnyMapperScene scene(mapper);
      scene.Render();
      scene.Use(MakeMapper(this->GetParam()));
      beside.Window->MakeCurrent();
    }
    AnyMapperScene next(mapper);
    next.Render();
    next.Use(MakeMapper(this->GetParam()));
    beside.Window->MakeCurrent();
  }
  beside.Render();
  EXPECT_EQ(beside.Grab(), expected);
}
