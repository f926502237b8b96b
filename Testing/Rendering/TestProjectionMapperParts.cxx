// SPDX-License-Identifier: BSD-3-Clause
// Cells that are drawn once for each interval that they have part in, beside cells that are drawn
// whole and look intervals up: the same function with so many more nodes that parts do not pay.
#include "Observer.h"
#include "RayCastScene.h"
#include "Statistics.h"

#include "vtkCommand.h"
#include "vtkImageData.h"
#include "vtkPlane.h"
#include "vtkTetrahedraProjectionMapper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace
{

/// Of a channel: roundings of single precision, of a hundred pieces that a ray may cross.
constexpr double Rounding = 1e-5;

class PartsScene : public RayCastScene
{
public:
  PartsScene()
  {
    this->Use(this->Projection);
    this->Projection->SetMaximumError(0); // or nodes on a line would be left out
    this->Projection->AutoAdjustSampleDistancesOff();
  }

  /// Draws the same picture both ways.
  void Expect(const char* name)
  {
    SCOPED_TRACE(name);
    const std::vector<float> parts = this->Render(1);
    const int cells = this->Count("tetrahedra_drawn");
    EXPECT_GT(this->Count("parts_drawn"), cells);
    const std::vector<float> whole = this->Render(100);
    EXPECT_EQ(this->Count("tetrahedra_drawn"), cells);
    EXPECT_EQ(this->Count("parts_drawn"), cells);
    ExpectSamePicture(parts, whole, Rounding, name);
  }

  /// steps: from each node to the next.
  std::vector<float> Render(int steps)
  {
    constexpr int Size = 6; // scalar, red, green, blue, opacity, and none
    const std::vector<std::array<double, Size>> nodes = { { -0.6, 0.1, 0.2, 0.9, 0.1 },
      { 2, 1, 0.8, 0.5, 0.9 } };
    this->Color->RemoveAllPoints();
    this->Opacity->RemoveAllPoints();
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
    {
      for (int step = 0; step <= steps; ++step)
      {
        double at[Size];
        for (int c = 0; c < Size; ++c)
        {
          at[c] = nodes[k][c] + (nodes[k + 1][c] - nodes[k][c]) * step / steps;
        }
        this->Color->AddRGBPoint(at[0], at[1], at[2], at[3]);
        this->Opacity->AddPoint(at[0], at[4]);
      }
    }
    return this->Render();
  }

  /// With the function as it is; nothing after an abort.
  std::vector<float> Render()
  {
    this->Window->Render();
    const vtkIdType size = 4 * this->Projection->GetOutputImage()->GetNumberOfPoints();
    return size == 0 ? std::vector<float>()
                     : std::vector<float>(this->GetColors(), this->GetColors() + size);
  }

  int Count(const char* name) { return std::stoi(GetStatistic(this->Projection, name)); }

  void SetUnitDistance(double distance)
  {
    this->Volume->GetProperty()->SetScalarOpacityUnitDistance(distance);
  }

  vtkNew<vtkTetrahedraProjectionMapper> Projection;
};

TEST(ProjectionMapperParts, Views)
{
  PartsScene scene;
  scene.Expect("perspective");
  scene.SetCamera({ 0.5, 0.45, 0.55 }, { 0.9, 0.3, 0.1 }, { 0, 1, 0 });
  scene.ViewAngle = 90;
  scene.Expect("from inside");
  scene.SetCamera({ -2, 0.6, 0.3 }, { 0.5, 0.5, 0.5 }, { 0, 0, 1 });
  scene.ViewAngle = 30;
  scene.Expect("along an axis");
}

TEST(ProjectionMapperParts, ParallelView)
{
  PartsScene scene;
  scene.Parallel = true;
  scene.SetCamera({ 2, 1.5, 3 }, { 0.5, 0.5, 0.5 }, { 0, 1, 0 });
  scene.Expect("parallel");
}

TEST(ProjectionMapperParts, ThickCellsAreSliced)
{
  PartsScene scene;
  scene.Render(1);
  const int thin = scene.Count("parts_drawn");
  scene.SetUnitDistance(0.17);
  scene.Expect("thick");
  scene.Render(1);
  EXPECT_GT(scene.Count("parts_drawn"), thin);
  // Slices of cells as thick as this would be too many: they are drawn whole.
  scene.SetUnitDistance(1e-4);
  scene.Render(1);
  EXPECT_EQ(scene.Count("parts_drawn"), scene.Count("tetrahedra_drawn"));
}

// Cropping leaves several stretches of a ray in a cell, and slices would be those of each.
TEST(ProjectionMapperParts, ThickCellsAreNotSlicedWhereTheyAreCropped)
{
  PartsScene scene;
  scene.SetUnitDistance(0.17);
  scene.Projection->CroppingOn();
  scene.Projection->SetCroppingRegionPlanes(-10, 10, -10, 10, 0.4, 0.6);
  scene.Projection->SetCroppingRegionFlags(0x7FFFFFF & ~(1 << 13)); // all but the middle
  scene.Render(1);
  EXPECT_EQ(scene.Count("parts_drawn"), scene.Count("tetrahedra_drawn"));
  EXPECT_NE(GetStatistic(scene.Projection, "cells in parts").find("cropped"), std::string::npos);
  scene.SetUnitDistance(2);
  scene.Expect("thin and cropped");
  scene.Render(1);
  EXPECT_EQ(GetStatistic(scene.Projection, "cells in parts"), "no statistic cells in parts");
}

TEST(ProjectionMapperParts, OpticalModels)
{
  PartsScene scene;
  scene.Projection->SetBlendModeToAdditive();
  scene.Expect("emission alone");
  scene.Projection->SetBlendModeToComposite();
  scene.SetUnitDistance(2);
  scene.Expect("thin");
}

TEST(ProjectionMapperParts, LimitedRays)
{
  PartsScene scene;
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0.5, 0.5, 0.5);
  plane->SetNormal(0.3, -0.2, -1);
  scene.Projection->AddClippingPlane(plane);
  scene.Expect("clipped");
  scene.Projection->CroppingOn();
  scene.Projection->SetCroppingRegionPlanes(0.2, 0.7, 0.3, 0.6, 0.25, 0.8);
  scene.Projection->SetCroppingRegionFlagsToCross();
  scene.Expect("cropped");
}

// A frame that is aborted while cells are divided leaves nothing of them: neither of what they were
// divided for before nor of what they were to be divided for.
TEST(ProjectionMapperParts, AnAbortWhileCellsAreDividedLeavesNothing)
{
  constexpr double Thick = 0.17; // where cells are sliced
  constexpr double Thin = 2;
  for (const bool crops : { false, true }) // else another function
  {
    SCOPED_TRACE(crops ? "cropping" : "another function");
    const auto render = [&](PartsScene& scene, bool other)
    {
      scene.Projection->SetCropping(crops && other);
      scene.Projection->SetCroppingRegionPlanes(0, 0.6, 0, 1, 0, 1);
      scene.SetUnitDistance(other && !crops ? Thick : Thin);
      return scene.Render();
    };
    PartsScene never;
    never.Render(1);
    const std::vector<float> before = render(never, false);
    const std::vector<float> after = render(never, true);
    ASSERT_NE(before, after);

    PartsScene scene;
    scene.Render(1);
    int asked = 0;
    int last = 0; // 0: no abort
    const Observer progress(scene.Projection, vtkCommand::VolumeMapperRenderProgressEvent,
      [&](const char*) { scene.Window->SetAbortRender(++asked == last); });
    int whileDivided = 0;
    bool aborted = true;
    for (int question = 1; aborted; ++question)
    {
      SCOPED_TRACE(question);
      EXPECT_EQ(render(scene, false), before);
      asked = 0;
      last = question;
      render(scene, true);
      last = 0;
      aborted = GetStatistic(scene.Projection, "aborted") == "true";
      whileDivided += aborted && scene.Count("triangles") == 0;
      for (const bool other : { question % 2 == 0, true })
      {
        EXPECT_EQ(render(scene, other), other ? after : before);
        EXPECT_GT(scene.Count("parts_drawn"), scene.Count("tetrahedra_drawn"));
      }
    }
    // The end of each of three passes is told at least.
    EXPECT_GE(whileDivided, 3);
  }
}

} // namespace
