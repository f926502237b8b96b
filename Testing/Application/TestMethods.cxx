// SPDX-License-Identifier: BSD-3-Clause
// Which methods are tried, and in which order.

#include "Setup/MethodCosts.h"
#include "Setup/Methods.h"

#include "vtkCellType.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace
{

std::vector<std::string> GetNames(const std::vector<MethodChoice>& methods)
{
  std::vector<std::string> names;
  for (const MethodChoice& choice : methods)
  {
    names.push_back(choice.Method);
  }
  return names;
}

/// What is listed on a graphics card, ranked.
std::vector<MethodChoice> Rank(const PictureWork& work)
{
  std::vector<MethodChoice> methods = { { "gpu-ray-cast", "a card" }, { "projection", "a card" },
    { "ray-cast", "a card" } };
  RankMethods(work, methods);
  return methods;
}

using Names = std::vector<std::string>;

constexpr PictureWork FewCells = { 5000, 2048, 2048 };
constexpr PictureWork ManyCells = { 1000000, 256, 256 };

} // namespace

TEST(Methods, AreTheOneThatIsNamed)
{
  const std::vector<MethodChoice> methods = ListMethods("projection", nullptr, 0, {});
  ASSERT_EQ(methods.size(), 1u);
  EXPECT_EQ(methods[0].Method, "projection");
  EXPECT_EQ(methods[0].Reason, "");
}

TEST(Methods, AreTheProcessorsWithoutAGraphicsCard)
{
  const std::vector<MethodChoice> methods = ListMethods("auto", nullptr, 0, {});
  EXPECT_EQ(GetNames(methods), Names{ "ray-cast" });
  EXPECT_EQ(methods[0].Reason, "the window is not one of OpenGL");
}

TEST(Methods, AreTheProcessorsWithThreads)
{
  const std::vector<MethodChoice> methods = ListMethods("auto", nullptr, 2, {});
  EXPECT_EQ(GetNames(methods), Names{ "ray-cast" });
  EXPECT_EQ(methods[0].Reason, "a number of threads is set");
}

TEST(Methods, LeaveOutThoseWithoutAProperty)
{
  const std::string none = ListMethods("auto", nullptr, 0, { "Precision=double" }).front().Reason;
  EXPECT_EQ(none, "gpu-ray-cast has no property Precision, projection has no property Precision");
  const std::string one = ListMethods("auto", nullptr, 0, { "Reentry=none" }).front().Reason;
  EXPECT_EQ(one, "the window is not one of OpenGL, projection has no property Reentry");
}

TEST(Methods, TraceIsosurfaces)
{
  // With threads and without, and whatever the window is.
  for (const int threads : { 0, 2 })
  {
    const std::vector<MethodChoice> methods =
      ListMethods("auto", nullptr, threads, { "Shadows=on" }, true);
    EXPECT_EQ(GetNames(methods), Names{ "isosurface" });
    EXPECT_EQ(methods[0].Reason, "isosurfaces are traced");
  }
  EXPECT_EQ(GetNames(ListMethods("ray-cast", nullptr, 0, {}, true)), Names{ "ray-cast" });
  // What tracing has not is set.
  EXPECT_EQ(
    GetNames(ListMethods("auto", nullptr, 0, { "Precision=double" }, true)), Names{ "ray-cast" });
  EXPECT_EQ(GetNames(ListMethods("auto", nullptr, 0, { "BlendMode=isosurface" }, true)),
    Names{ "ray-cast" });
}

TEST(Methods, TakeTheirSettings)
{
  EXPECT_TRUE(TakesSettings("triangle-caster", 2, { "SliceShape=shells", "SampleDistance=0.5" }));
  EXPECT_FALSE(TakesSettings("ray-cast", 2, { "SliceShape=shells" }));
  // A property that it has, with a value that it has not.
  EXPECT_TRUE(TakesSettings("ray-cast", 0, { "BlendMode=additive" }));
  EXPECT_FALSE(TakesSettings("triangle-caster", 0, { "BlendMode=absorption" }));
  // No threads to set.
  EXPECT_FALSE(TakesSettings("projection", 2, {}));
}

TEST(Methods, ProjectFewCellsOntoManyPixels)
{
  const std::vector<MethodChoice> methods = Rank(FewCells);
  EXPECT_EQ(GetNames(methods), (Names{ "projection", "gpu-ray-cast", "ray-cast" }));
}

TEST(Methods, CastRaysThroughManyCells)
{
  const std::vector<MethodChoice> methods = Rank(ManyCells);
  EXPECT_EQ(GetNames(methods), (Names{ "gpu-ray-cast", "projection", "ray-cast" }));
}

TEST(Methods, DoNotDependOnTheOrderInWhichTheyAreRanked)
{
  for (const PictureWork& work : { FewCells, ManyCells })
  {
    std::vector<MethodChoice> methods = Rank(work);
    const Names expected = GetNames(methods);
    std::swap(methods[0], methods[1]);
    RankMethods(work, methods);
    EXPECT_EQ(GetNames(methods), expected);
  }
}

TEST(Methods, GiveTheirTimesAsAReasonOfOneLine)
{
  const std::vector<MethodChoice> methods = Rank(FewCells);
  for (int k = 0; k < 2; ++k)
  {
    const std::string& reason = methods[k].Reason;
    EXPECT_EQ(reason.rfind("a card: predicted are ", 0), 0u) << reason;
    EXPECT_NE(reason.find(" ms by gpu-ray-cast and "), std::string::npos) << reason;
    EXPECT_NE(reason.find(" ms by projection"), std::string::npos) << reason;
    EXPECT_EQ(reason.find('\n'), std::string::npos) << reason;
  }
  EXPECT_EQ(methods[2].Reason, "a card");
}

TEST(Methods, AreNotRankedAlone)
{
  std::vector<MethodChoice> methods = { { "projection", "a card" }, { "ray-cast", "a card" } };
  RankMethods(ManyCells, methods);
  EXPECT_EQ(GetNames(methods), (Names{ "projection", "ray-cast" }));
  EXPECT_EQ(methods[0].Reason, "a card");
}

TEST(Methods, TakeLongerForMoreCellsAndMorePixels)
{
  for (const char* method : { "gpu-ray-cast", "projection" })
  {
    const double seconds = PredictSeconds(method, { 10000, 512, 512 });
    EXPECT_GT(seconds, 0);
    EXPECT_GT(PredictSeconds(method, { 20000, 512, 512 }), seconds);
    EXPECT_GT(PredictSeconds(method, { 10000, 1024, 512 }), seconds);
    EXPECT_GT(PredictSeconds(method, { 10000, 512, 1024 }), seconds);
  }
  EXPECT_THROW(PredictSeconds("ray-cast", { 10000, 512, 512 }), std::logic_error);
}

TEST(Methods, CountTetrahedraThatCellsAreSplitInto)
{
  vtkNew<vtkImageData> voxels;
  voxels->SetDimensions(4, 3, 2);
  EXPECT_EQ(EstimateTetrahedra(voxels), 5 * 3 * 2);

  vtkNew<vtkUnstructuredGrid> tetrahedron;
  vtkNew<vtkPoints> points;
  for (int k = 0; k < 4; ++k)
  {
    points->InsertNextPoint(k == 1, k == 2, k == 3);
  }
  tetrahedron->SetPoints(points);
  const vtkIdType ids[] = { 0, 1, 2, 3 };
  tetrahedron->InsertNextCell(VTK_TETRA, 4, ids);
  EXPECT_EQ(EstimateTetrahedra(tetrahedron), 1);

  vtkNew<vtkMultiBlockDataSet> both;
  both->SetBlock(0, voxels);
  both->SetBlock(2, tetrahedron);
  EXPECT_EQ(EstimateTetrahedra(both), 5 * 3 * 2 + 1);
}
