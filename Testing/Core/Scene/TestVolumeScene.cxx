// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/VolumeScene.h"

#include "RayScene.h"
#include "ReferenceScenes.h"
#include "Scene/IntegratorChoice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace tetralux
{
namespace
{

/// Transparent below the scalar, and one colour above.
TransferFunction MakeStep(double scalar)
{
  TransferFunction function;
  const TransferFunction::Value none = { { 1, 1, 1 }, 0 };
  const TransferFunction::Value some = { { 1, 1, 1 }, 1 };
  function.Nodes = { { 0, none, none }, { scalar, none, some }, { 1, some, some } };
  return function;
}

/// A box whose scalar at points runs from 0 to 1 along x.
VolumeScene MakeScene(TetrahedralMesh mesh = MakeBox(6, 4, 4, { 0, 0, 0 }, { 1, 1, 1 }))
{
  VolumeScene scene;
  scene.Mesh.SetMesh(std::make_shared<WalkMesh>(std::move(mesh)));
  const TetrahedralMesh& ordered = scene.Mesh.GetMesh()->GetMesh();
  std::vector<double> scalars;
  for (std::size_t p = 0; p < ordered.GetNumberOfPoints(); ++p)
  {
    scalars.push_back(ordered.Points[3 * p]);
  }
  scene.Mesh.SetPointScalars(std::move(scalars));
  scene.Optics.SetTransferFunction(MakeStep(0.75));
  return scene;
}

SceneNeeds NeedAll()
{
  SceneNeeds needs;
  needs.SinglePoints = needs.DoublePoints = needs.VisibleTables = needs.PointGradients =
    needs.LongestEdge = true;
  return needs;
}

/// What Prepare makes.
struct Versions
{
  std::uint64_t Points, VisibleTables;
  const GradientRow* Gradients;

  explicit Versions(const VolumeScene& scene)
    : Points(scene.GetPointsVersion())
    , VisibleTables(scene.GetVisibleTablesVersion())
    , Gradients(scene.Mesh.GetPointGradients().data())
  {
  }
};

TEST(VolumeScene, PreparesOnceAndOnlyWhatIsNeeded)
{
  VolumeScene scene = MakeScene();
  scene.Prepare({});
  EXPECT_TRUE(scene.GetPlan().ConstantColor);
  EXPECT_EQ(scene.GetPointsVersion(), 0u);
  EXPECT_EQ(scene.GetVisibleTablesVersion(), 0u);
  EXPECT_TRUE(scene.GetVisibleCells().empty());

  scene.Prepare(NeedAll());
  ASSERT_NE(scene.GetVisibleTables(), nullptr);
  EXPECT_GT(scene.GetNumberOfTransparentCells(), 0);
  const Versions first(scene);
  scene.Prepare(NeedAll());
  const Versions second(scene);
  EXPECT_EQ(first.Points, second.Points);
  EXPECT_EQ(first.VisibleTables, second.VisibleTables);
  EXPECT_EQ(first.Gradients, second.Gradients);
}

TEST(VolumeScene, NewScalarsChangeWhatDependsOnThem)
{
  VolumeScene scene = MakeScene();
  scene.Prepare(NeedAll());
  const Versions before(scene);
  const std::uint64_t cells = scene.Mesh.GetCellsVersion();
  const std::uint64_t points = scene.Mesh.GetPointsVersion();
  std::vector<double> scalars = scene.Mesh.GetScalars();
  for (double& s : scalars)
  {
    s = 1 - s;
  }
  scene.Mesh.SetPointScalars(std::move(scalars));
  scene.Prepare(NeedAll());
  EXPECT_EQ(scene.Mesh.GetCellsVersion(), cells);
  EXPECT_EQ(scene.Mesh.GetPointsVersion(), points);
  EXPECT_NE(Versions(scene).Points, before.Points);
  EXPECT_NE(Versions(scene).VisibleTables, before.VisibleTables);
}

TEST(VolumeScene, NewFunctionsChangeWhatDependsOnThem)
{
  VolumeScene scene = MakeScene();
  scene.Prepare(NeedAll());
  const Versions before(scene);
  scene.Optics.SetTransferFunction(MakeStep(0.5));
  scene.Prepare(NeedAll());
  EXPECT_NE(Versions(scene).VisibleTables, before.VisibleTables);
  EXPECT_EQ(Versions(scene).Gradients, before.Gradients);
  // The map of the scalars is that of the function's range, which is the same.
  EXPECT_EQ(Versions(scene).Points, before.Points);

  const std::uint64_t table = scene.Optics.GetTableVersion();
  scene.Optics.SetTable(nullptr, 0);
  EXPECT_NE(scene.Optics.GetTableVersion(), table);
}

TEST(VolumeScene, CellValuesFollowTheFunction)
{
  TetrahedralMesh mesh;
  mesh.Points = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2 };
  mesh.Cells = { 0, 1, 2, 3 };
  VolumeScene scene;
  scene.Mesh.SetMesh(std::make_shared<WalkMesh>(std::move(mesh)));
  scene.Mesh.SetCellScalars({ 0.5 });
  TransferFunction function;
  function.Nodes = { { 0, { { 1, 1, 1 }, 0 }, { { 1, 1, 1 }, 0 } },
    { 1, { { 1, 1, 1 }, 1 }, { { 1, 1, 1 }, 1 } } };
  scene.Optics.SetTransferFunction(function);
  scene.Prepare({});
  const std::uint64_t first = scene.GetCellValuesVersion();
  scene.Prepare({});
  EXPECT_EQ(scene.GetCellValuesVersion(), first);
  function.Nodes[1].Right.Attenuation = function.Nodes[1].Left.Attenuation = 2;
  scene.Optics.SetTransferFunction(function);
  scene.Prepare({});
  EXPECT_EQ(scene.GetCellValues()[0].Attenuation, 1);
  EXPECT_NE(scene.GetCellValuesVersion(), first);
}

TEST(VolumeScene, IntegratorFollowsModelColourLightAndTable)
{
  VolumeScene scene = MakeScene();
  scene.Prepare({});
  EXPECT_EQ(ChooseIntegrator(scene, Lighting::None), Integrator::OpticalDepth);
  EXPECT_EQ(ChooseIntegrator(scene, Lighting::Even), Integrator::LitClosedForm);
  EXPECT_EQ(ChooseIntegrator(scene, Lighting::Varying), Integrator::VaryingLight);
  TransferFunction colorful = MakeStep(0.5);
  colorful.Nodes.back().Left.Color[1] = 0;
  scene.Optics.SetTransferFunction(colorful);
  scene.Prepare({});
  EXPECT_EQ(ChooseIntegrator(scene, Lighting::None), Integrator::ClosedForm);
  scene.Optics.SetTable(std::make_shared<PreIntegrationTable>(), 0);
  EXPECT_EQ(ChooseIntegrator(scene, Lighting::None), Integrator::Table);
  EXPECT_EQ(ChooseIntegrator(scene, Lighting::Even), Integrator::LitTable);
  EXPECT_EQ(ChooseIntegrator(scene, Lighting::Varying), Integrator::VaryingLight);
  scene.Optics.SetModel(OpticalModel::EmissionOnly);
  EXPECT_EQ(ChooseIntegrator(scene, Lighting::Varying), Integrator::Emission);
  scene.Optics.SetModel(OpticalModel::AbsorptionOnly);
  EXPECT_EQ(ChooseIntegrator(scene, Lighting::Varying), Integrator::OpticalDepth);
  scene.Optics.SetModel(OpticalModel::MaximumIntensity);
  EXPECT_EQ(ChooseIntegrator(scene, Lighting::None), Integrator::Maximum);
  scene.Optics.SetModel(OpticalModel::Isosurfaces);
  EXPECT_EQ(ChooseIntegrator(scene, Lighting::Varying), Integrator::Isosurfaces);
}

/// A scene of rays whose points are moved, and the same scene made from the moved points.
struct MovedScene
{
  RayScene Scene;
  VolumeScene Volume; ///< of Scene before it was moved

  MovedScene()
  {
    this->Scene.Mesh = MakeBox(9, 9, 9, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, 3);
    this->Scene.Scalars = MakeSmoothField(this->Scene.Mesh);
    // So much is transparent that leaving it out pays.
    this->Scene.Function =
      MakeLinearFunction({ { 0.6, 1, 0, 0, 0 }, { 0.7, 0, 1, 0, 3 }, { 1, 0, 0, 1, 6 } });
    this->Scene.Grid =
      MakePerspectiveGrid({ 2.5, 2, 3 }, { 0.6, 0.6, 0.5 }, { 0, 1, 0 }, 35, 48, 48);
    this->Volume = this->Scene.MakeVolumeScene();
  }

  void Move()
  {
    std::vector<double>& points = this->Scene.Mesh.Points;
    for (std::size_t p = 0; p < points.size(); p += 3)
    {
      const double x = points[p];
      points[p] = 1.4 * x + 0.2 * points[p + 1];
      points[p + 1] += 0.2 * std::sin(3 * x);
      points[p + 2] -= 0.1 * x * x;
    }
  }

  /// In the order of the mesh that is cast.
  std::vector<double> GetOrderedPoints() const
  {
    const auto& originals = this->Volume.Mesh.GetMesh()->GetMesh().OriginalPoints;
    std::vector<double> ordered;
    for (const std::int64_t id : originals)
    {
      ordered.insert(
        ordered.end(), &this->Scene.Mesh.Points[3 * id], &this->Scene.Mesh.Points[3 * id] + 3);
    }
    return ordered;
  }
};

/// Largest difference of two pictures; not-a-number counts as infinite.
double GetLargestDifference(const RayPicture& a, const RayPicture& b)
{
  double largest = 0;
  for (std::size_t i = 0; i < a.Colors.size(); ++i)
  {
    const double difference = std::abs(static_cast<double>(a.Colors[i]) - b.Colors[i]);
    largest = std::max(largest, std::isnan(difference) ? 1 / 0. : difference);
  }
  return largest;
}

TEST(VolumeScene, MovedPointsGiveThePictureOfANewMesh)
{
  MovedScene moved;
  for (const Precision precision : { Precision::Single, Precision::Double })
  {
    SCOPED_TRACE(precision == Precision::Double ? "double" : "single");
    RayCastOptions options;
    options.Arithmetic = precision;
    options.MaximumError = 0;
    const RayPicture before = Cast(moved.Volume, moved.Scene, options);
    const std::uint64_t cells = moved.Volume.Mesh.GetCellsVersion();
    const std::uint64_t scalars = moved.Volume.Mesh.GetScalarsVersion();
    const std::uint64_t visible = moved.Volume.GetVisibleTablesVersion();
    ASSERT_NE(moved.Volume.GetVisibleTables(), nullptr) << "the tables of visible cells are tested";

    moved.Move();
    ASSERT_TRUE(moved.Volume.Mesh.SetPoints(moved.GetOrderedPoints()));
    const RayPicture after = Cast(moved.Volume, moved.Scene, options);
    EXPECT_EQ(moved.Volume.Mesh.GetCellsVersion(), cells);
    EXPECT_EQ(moved.Volume.Mesh.GetScalarsVersion(), scalars);
    EXPECT_EQ(moved.Volume.GetVisibleTablesVersion(), visible) << "only its boxes change";
    EXPECT_GT(GetLargestDifference(before, after), 0.1);

    VolumeScene fresh = moved.Scene.MakeVolumeScene();
    // Other ids of points, so other roundings: a few units in the last place of a colour.
    constexpr double Rounding = 1e-5;
    EXPECT_LE(GetLargestDifference(after, Cast(fresh, moved.Scene, options)), Rounding);
  }
}

TEST(VolumeScene, MovedPointsThroughImaginaryCells)
{
  MovedScene moved;
  RayCastOptions options;
  options.ReentryBy = Reentry::Imaginary;
  Cast(moved.Volume, moved.Scene, options);
  moved.Move();
  ASSERT_TRUE(moved.Volume.Mesh.SetPoints(moved.GetOrderedPoints()));
  EXPECT_EQ(moved.Volume.Mesh.GetMesh()->GetConvexification(), nullptr);
  const RayPicture picture = Cast(moved.Volume, moved.Scene, options);
  VolumeScene fresh = moved.Scene.MakeVolumeScene();
  constexpr double Rounding = 1e-5;
  EXPECT_LE(GetLargestDifference(picture, Cast(fresh, moved.Scene, options)), Rounding);
}

TEST(VolumeScene, PointsThatChangeTheCellsAreNotTaken)
{
  VolumeScene scene = MakeScene();
  const std::uint64_t version = scene.Mesh.GetPointsVersion();
  std::vector<double> points = scene.Mesh.GetMesh()->GetMesh().Points;
  EXPECT_THROW(scene.Mesh.SetPoints({ 1, 2, 3 }), std::invalid_argument);
  points[5] = std::nan("");
  EXPECT_FALSE(scene.Mesh.SetPoints(points));
  EXPECT_EQ(scene.Mesh.GetPointsVersion(), version);

  // Cells were removed, and might have to come back.
  TetrahedralMesh mesh = MakeBox(2, 2, 2, { 0, 0, 0 }, { 1, 1, 1 });
  mesh.Points[0] = std::nan("");
  VolumeScene holed = MakeScene(std::move(mesh));
  EXPECT_FALSE(holed.Mesh.SetPoints(holed.Mesh.GetMesh()->GetMesh().Points));
}

} // namespace
} // namespace tetralux
