// SPDX-License-Identifier: BSD-3-Clause

// Structured grids that close on themselves, with a seam whose points are not shared: an O-grid
// goes once around a cylinder, a C-grid around an airfoil and back along its wake. Drawn and put in
// order as if the points were shared.
#include "Observer.h"
#include "RayCastScene.h"
#include "ReferenceConvexity.h"
#include "ReferenceOcclusion.h"

#include "vtkCellArray.h"
#include "vtkConvexifyTetrahedra.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkMeshedPolyhedraVisibilitySort.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkTetrahedralizeCells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace
{

using tetralux::TetrahedralMesh;

/// Largest difference of a channel between both pictures: by the ray caster, which differs by the
/// order of additions and MaximumError; by the others, what a display shows.
constexpr double RayCastTolerance = 1e-4;
constexpr double DisplayTolerance = 1. / 255;

/// Points closer than that, in units of the grids, are one.
constexpr double MergeDistance = 1e-5;

const double Pi = std::acos(-1.);

/// How the coordinates on both sides of a seam compare.
enum class Seam
{
  Exact,
  LastBits,       ///< as sines of 0 and of a whole turn differ
  SinglePrecision ///< the same, in single precision
};

struct GridSize
{
  int Outwards, Around, Along;
};

/// A place of the plane for each pair of layers outwards and around.
using PlanePlace = std::function<std::array<double, 2>(int, int)>;

vtkSmartPointer<vtkStructuredGrid> MakeStructuredGrid(
  const GridSize& size, const PlanePlace& place, Seam seam)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(size.Outwards + 1, size.Around + 1, size.Along + 1);
  vtkNew<vtkPoints> points;
  points->SetDataType(seam == Seam::SinglePrecision ? VTK_FLOAT : VTK_DOUBLE);
  vtkNew<vtkDoubleArray> field;
  field->SetName("Field");
  for (int k = 0; k <= size.Along; ++k)
  {
    for (int j = 0; j <= size.Around; ++j)
    {
      for (int i = 0; i <= size.Outwards; ++i)
      {
        const std::array<double, 2> xy = place(i, j);
        const double z = 0.5 * k;
        points->InsertNextPoint(xy[0], xy[1], z);
        field->InsertNextValue(std::sin(3 * xy[0] + xy[1]) * std::cos(2 * xy[1] - 3 * z));
      }
    }
  }
  grid->SetPoints(points);
  grid->GetPointData()->SetScalars(field);
  return grid;
}

/// The angle of a layer around.
double GetAngle(int layer, int layers, Seam seam)
{
  if (seam == Seam::Exact)
  {
    return 2 * Pi * (layer % layers) / layers;
  }
  const double angle = 2 * Pi * layer / layers;
  return seam == Seam::SinglePrecision ? static_cast<float>(angle) : angle;
}

/// From a cylinder to a larger one. inner: 0 makes a solid cylinder of it.
vtkSmartPointer<vtkStructuredGrid> MakeRoundGrid(const GridSize& size, double inner, Seam seam)
{
  return MakeStructuredGrid(
    size,
    [=](int i, int j)
    {
      const double angle = GetAngle(j, size.Around, seam);
      const double radius = inner + (1 - inner) * i / size.Outwards;
      return std::array<double, 2>{ radius * std::cos(angle), radius * std::sin(angle) };
    },
    seam);
}

/// From a cylinder to a box around it.
vtkSmartPointer<vtkStructuredGrid> MakeGridInBox(const GridSize& size, Seam seam)
{
  return MakeStructuredGrid(
    size,
    [=](int i, int j)
    {
      const double angle = GetAngle(j, size.Around, seam);
      const double x = std::cos(angle), y = std::sin(angle);
      const double onBox = 1 / std::max(std::abs(x), std::abs(y));
      const double radius = 0.4 + (onBox - 0.4) * i / size.Outwards;
      return std::array<double, 2>{ radius * x, radius * y };
    },
    seam);
}

/// Along the lower side of a wake, around a wing, and back along the upper side.
vtkSmartPointer<vtkStructuredGrid> MakeWakeGrid(int outwards, int alongWake, int around, Seam seam)
{
  constexpr double trailingEdge = 0.25;
  const int size = 2 * alongWake + around;
  const double lastBits = seam == Seam::Exact ? 0 : trailingEdge * std::sin(2 * Pi);
  return MakeStructuredGrid(
    { outwards, size, 2 },
    [=](int i, int j)
    {
      std::array<double, 2> wall, outer;
      if (j <= alongWake || j >= size - alongWake)
      {
        const bool upper = j > alongWake;
        const int behind = upper ? j - (size - alongWake) : alongWake - j;
        wall = { trailingEdge + 1.2 * behind / alongWake, upper ? lastBits : 0. };
        outer = { wall[0], upper ? 1. : -1. };
      }
      else
      {
        const double part = static_cast<double>(j - alongWake) / around;
        const double u = std::abs(1 - 2 * part); // 1 at the trailing edge, 0 at the leading edge
        const double thickness = (part < 0.5 ? -0.35 : 0.35) * u * (1 - u);
        wall = { trailingEdge - 1 + u * u, thickness };
        const double angle = -Pi * (0.5 + part);
        outer = { trailingEdge + 1.25 * std::cos(angle), std::sin(angle) };
      }
      const double t = static_cast<double>(i) / outwards;
      return std::array<double, 2>{ wall[0] + t * (outer[0] - wall[0]),
        wall[1] + t * (outer[1] - wall[1]) };
    },
    seam);
}

struct SeamCase
{
  std::string Name;
  std::function<vtkSmartPointer<vtkStructuredGrid>()> Make;
  bool Conforms;   ///< faces on both sides of the seam are at the same places
  bool Alternates; ///< diagonals of both sides agree, to the last bits
};

void PrintTo(const SeamCase& seamCase, std::ostream* stream) { *stream << seamCase.Name; }

std::vector<SeamCase> MakeCases()
{
  std::vector<SeamCase> cases;
  const auto add = [&](const char* shape, bool conforms, bool alternates, const auto& make)
  {
    for (const Seam seam : { Seam::Exact, Seam::LastBits, Seam::SinglePrecision })
    {
      const char* const suffix = seam == Seam::Exact ? "Exact"
        : seam == Seam::LastBits                     ? "LastBits"
                                                     : "SinglePrecision";
      cases.push_back({ std::string(shape) + suffix, [make, seam] { return make(seam); },
        conforms && seam == Seam::Exact, alternates });
    }
  };
  add("Round", true, true, [](Seam seam) { return MakeRoundGrid({ 3, 12, 2 }, 0.3, seam); });
  // Where it closes the diagonals of both sides do not agree.
  add("RoundOdd", false, false, [](Seam seam) { return MakeRoundGrid({ 3, 11, 2 }, 0.3, seam); });
  // The points of the axis become one.
  add("Solid", true, false, [](Seam seam) { return MakeRoundGrid({ 3, 12, 2 }, 0, seam); });
  add("InBox", true, true, [](Seam seam) { return MakeGridInBox({ 3, 16, 2 }, seam); });
  add("Wake", true, true, [](Seam seam) { return MakeWakeGrid(3, 4, 8, seam); });
  return cases;
}

/// The tetrahedra that the filter makes of a grid, and the field on them.
TetrahedralMesh Tetrahedralize(vtkStructuredGrid* grid, std::vector<double>& scalars)
{
  vtkNew<vtkTetrahedralizeCells> split;
  split->SetInputData(grid);
  split->Update();
  vtkUnstructuredGrid* output = split->GetOutput();
  TetrahedralMesh mesh;
  vtkDataArray* field = output->GetPointData()->GetArray("Field");
  for (vtkIdType point = 0; point < output->GetNumberOfPoints(); ++point)
  {
    const double* x = output->GetPoint(point);
    mesh.Points.insert(mesh.Points.end(), x, x + 3);
    scalars.push_back(field->GetTuple1(point));
  }
  vtkIdType size;
  const vtkIdType* ids;
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    output->GetCells()->GetCellAtId(cell, size, ids);
    mesh.Cells.insert(mesh.Cells.end(), ids, ids + 4);
  }
  return mesh;
}

/// The same cells by the first of all points at a place, without those that name one twice.
TetrahedralMesh MergePoints(TetrahedralMesh mesh)
{
  std::map<std::array<std::int64_t, 3>, std::int32_t> firsts;
  std::vector<std::int32_t> merged;
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    std::array<std::int64_t, 3> place;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      place[axis] = std::llround(mesh.Points[i + axis] / MergeDistance);
    }
    merged.push_back(firsts.try_emplace(place, static_cast<std::int32_t>(i / 3)).first->second);
  }
  std::vector<std::int32_t> cells;
  for (std::size_t cell = 0; cell < mesh.Cells.size(); cell += 4)
  {
    std::set<std::int32_t> corners;
    for (std::size_t corner = cell; corner < cell + 4; ++corner)
    {
      corners.insert(merged[static_cast<std::size_t>(mesh.Cells[corner])]);
    }
    if (corners.size() == 4)
    {
      cells.insert(cells.end(), corners.begin(), corners.end());
    }
  }
  mesh.Cells = std::move(cells);
  return mesh;
}

constexpr int NumberOfViews = 6;

void SetView(RayCastScene& scene, int view)
{
  scene.Parallel = view == 1 || view == 2 || view == 5;
  scene.ParallelScale = 1.1;
  switch (view)
  {
    case 0:
      scene.SetCamera({ 3.1, 1.7, 4.2 }, { 0.1, 0, 0.5 }, { 0, 1, 0 });
      break;
    case 1: // along the axis
      scene.SetCamera({ 0.03, 0.02, 5 }, { 0.03, 0.02, 0 }, { 0, 1, 0 });
      break;
    case 2: // along the seam; no ray is in it
      scene.SetCamera({ 5, 0.01, 0.52 }, { 0, 0.01, 0.52 }, { 0, 1, 0.1 });
      break;
    case 3: // inside, beside the seam
      scene.SetCamera({ 0.5, 0.13, 0.3 }, { 0.7, -0.6, 0.6 }, { 0, 0, 1 });
      break;
    case 4: // in the plane of the seam, far from it
      scene.SetCamera({ 5, 0, 1.7 }, { 0.2, 0.1, 0.5 }, { 0, 1, 0 });
      break;
    default: // across the seam
      scene.SetCamera({ 0.7, -4, 0.9 }, { 0.7, 0, 0.45 }, { 0.1, 0, 1 });
      break;
  }
}

std::vector<float> Render(
  RayCastScene& scene, vtkTetrahedraVolumeMapper* mapper, vtkDataObject* input = nullptr)
{
  scene.Use(mapper);
  if (input != nullptr)
  {
    mapper->SetInputData(input);
  }
  scene.Window->Render();
  const std::size_t pixels = scene.GetMapper()->GetOutputImage()->GetNumberOfPoints();
  return { scene.GetColors(), scene.GetColors() + 4 * pixels };
}

class Seams : public testing::TestWithParam<SeamCase>
{
};

TEST_P(Seams, AreNotSeen)
{
  RayCastScene scene(48, 36);
  const auto structured = GetParam().Make();
  std::vector<double> scalars;
  const TetrahedralMesh mesh = Tetrahedralize(structured, scalars);
  const auto separate = MakeGrid(mesh, scalars);
  const auto merged = MakeGrid(MergePoints(mesh), scalars);
  for (int view = 0; view < NumberOfViews; ++view)
  {
    SCOPED_TRACE("view " + std::to_string(view));
    SetView(scene, view);
    const int merging = view % 2 == 0 ? vtkTetrahedraVolumeMapper::MERGE_OFF
                                      : vtkTetrahedraVolumeMapper::AUTOMATIC_MERGE;
    vtkNew<vtkTetrahedraRayCastMapper> reference;
    reference->SetPrecisionToDouble();
    scene.Grid = merged;
    const std::vector<float> expected = Render(scene, reference);
    scene.Grid = separate;
    for (vtkDataObject* input :
      { static_cast<vtkDataObject*>(separate), static_cast<vtkDataObject*>(structured) })
    {
      SCOPED_TRACE(input->GetClassName());
      // Where diagonals do not agree, a merged structured grid is cut otherwise.
      const int merge = input == structured && !GetParam().Alternates
        ? vtkTetrahedraVolumeMapper::MERGE_OFF
        : merging;
      vtkNew<vtkTetrahedraRayCastMapper> rayCast;
      rayCast->SetMergePoints(merge);
      rayCast->AutoAdjustSampleDistancesOff();
      vtkNew<vtkTetrahedraGPURayCastMapper> gpuRayCast;
      gpuRayCast->SetMergePoints(merge);
      gpuRayCast->SetMaximumError(DisplayTolerance);
      vtkNew<vtkTetrahedraProjectionMapper> projection;
      projection->SetMergePoints(merge);
      projection->SetMaximumError(DisplayTolerance);
      ExpectSamePicture(Render(scene, rayCast, input), expected, RayCastTolerance, "ray cast");
      ExpectSamePicture(
        Render(scene, gpuRayCast, input), expected, DisplayTolerance, "graphics card");
      ExpectSamePicture(Render(scene, projection, input), expected, DisplayTolerance, "projection");

      // By imaginary cells, whether the mesh can be made convex or that is refused.
      const MessageObserver ofRayCast(rayCast, { vtkCommand::WarningEvent });
      const MessageObserver ofGraphicsCard(gpuRayCast, { vtkCommand::WarningEvent });
      rayCast->SetReentryToImaginaryCells();
      gpuRayCast->SetReentryToImaginaryCells();
      ExpectSamePicture(
        Render(scene, rayCast, input), expected, RayCastTolerance, "ray cast, imaginary cells");
      ExpectSamePicture(Render(scene, gpuRayCast, input), expected, DisplayTolerance,
        "graphics card, imaginary cells");
    }
  }
}

TEST_P(Seams, ArePutInOrder)
{
  RayCastScene scene;
  std::vector<double> scalars;
  const TetrahedralMesh mesh = Tetrahedralize(GetParam().Make(), scalars);
  const auto grid = MakeGrid(mesh, scalars);
  vtkNew<vtkMeshedPolyhedraVisibilitySort> sort;
  sort->SetInput(grid);
  sort->SetCamera(scene.Renderer->GetActiveCamera());
  sort->SetDirectionToFrontToBack();
  for (int number = 0; number < NumberOfViews; ++number)
  {
    SCOPED_TRACE("view " + std::to_string(number));
    SetView(scene, number);
    vtkCamera* camera = scene.Renderer->GetActiveCamera();
    tetralux::VisibilityView view;
    view.Parallel = camera->GetParallelProjection() != 0;
    std::copy_n(camera->GetPosition(), 3, view.Eye.begin());
    std::copy_n(camera->GetDirectionOfProjection(), 3, view.Direction.begin());
    std::vector<std::int32_t> order;
    sort->InitTraversal();
    while (vtkIdTypeArray* next = sort->GetNextCells())
    {
      for (vtkIdType i = 0; i < next->GetNumberOfTuples(); ++i)
      {
        order.push_back(static_cast<std::int32_t>(next->GetValue(i)));
      }
    }
    ASSERT_EQ(order.size(), mesh.GetNumberOfCells());
    // Longer than what cells at the seam have in common.
    const auto pairs = tetralux::FindOccludedPairs(mesh, view, 1, 1, 1e-6);
    EXPECT_GT(pairs.size(), 300U);
    EXPECT_EQ(tetralux::FindWrongPairs(pairs, order).size(), 0U);
    EXPECT_EQ(sort->GetNumberOfCycles(), 0);
  }
}

/// Points at the same place count as one. Where cells reach into each other, or faces that touch do
/// not coincide, the filter either fills what is between them or says where that is not possible.
TEST_P(Seams, AreInTheConvexMeshOrRefused)
{
  std::vector<double> scalars;
  const TetrahedralMesh mesh = Tetrahedralize(GetParam().Make(), scalars);
  const auto grid = MakeGrid(mesh, scalars);
  vtkNew<vtkConvexifyTetrahedra> convexify;
  convexify->SetInputData(grid);
  const MessageObserver errors(convexify);
  const MessageObserver failures(convexify->GetExecutive());
  convexify->Update();
  vtkUnstructuredGrid* output = convexify->GetOutput();
  const std::string refusal = convexify->GetRefusal();
  if (!refusal.empty())
  {
    EXPECT_FALSE(GetParam().Conforms) << refusal;
    EXPECT_NE(refusal.find("intersects itself, near ("), std::string::npos) << refusal;
    EXPECT_NE(errors.Text.find(refusal), std::string::npos);
    EXPECT_EQ(output->GetNumberOfCells(), 0);
    return;
  }
  EXPECT_EQ(errors.Text, "");
  tetralux::ConvexifiedMesh convex;
  for (vtkIdType point = 0; point < output->GetNumberOfPoints(); ++point)
  {
    const double* x = output->GetPoint(point);
    convex.Points.insert(convex.Points.end(), x, x + 3);
  }
  vtkIdType size;
  const vtkIdType* ids;
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    output->GetCells()->GetCellAtId(cell, size, ids);
    auto& cells = cell < grid->GetNumberOfCells() ? convex.Cells : convex.ImaginaryCells;
    cells.insert(cells.end(), ids, ids + 4);
  }
  EXPECT_EQ(convex.Cells.size(), mesh.Cells.size());
  EXPECT_EQ(
    tetralux::CheckConvexity(convex, static_cast<std::int32_t>(grid->GetNumberOfPoints())), "");
}

INSTANTIATE_TEST_SUITE_P(Grids, Seams, testing::ValuesIn(MakeCases()),
  [](const testing::TestParamInfo<SeamCase>& info) { return info.param.Name; });

} // namespace
