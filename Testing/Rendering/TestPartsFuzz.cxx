// SPDX-License-Identifier: BSD-3-Clause

// Random meshes made of parts that touch without sharing points, from random views, by every
// mapper, against the brute-force renderer of the same tetrahedra. The environment variable
// TETRALUX_PARTS_ROUNDS sets how many scenes are tried, TETRALUX_PARTS_FIRST the first one.
#include "RayCastScene.h"
#include "ReferenceGrazing.h"
#include "ReferenceRenderer.h"
#include "ReferenceScenes.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkTetrahedralizeCells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace
{

constexpr int DefaultRounds = 40;
constexpr std::uint64_t Seed = 271828;

/// Of a channel: by the ray caster, what its default MaximumError is; by the others, what a
/// display shows.
constexpr double RayCastTolerance = 1e-4;
constexpr double DisplayTolerance = 1. / 255;

constexpr int Width = 40;
constexpr int Height = 30;

int GetNumber(const char* variable, int otherwise)
{
  const char* text = std::getenv(variable);
  return text != nullptr ? std::atoi(text) : otherwise;
}

/// Cells of any linear types, by their corners.
struct MixedMesh
{
  struct Cell
  {
    int Type;
    std::vector<std::size_t> Points;
    std::vector<std::vector<std::size_t>> Faces; ///< of polyhedra
  };
  std::vector<Vector> Points;
  std::vector<Cell> Cells;
};

/// A mesh as a grid, with what the reference and the mappers draw of it.
struct PartsScene
{
  std::string Name;
  MixedMesh Mesh;
  bool CellScalars = false;
  bool Bends = false; ///< whether the field is not linear in space
  vtkSmartPointer<vtkUnstructuredGrid> Grid;
};

class PartsFuzzer
{
public:
  explicit PartsFuzzer(std::uint64_t seed)
    : Generator(seed)
  {
  }

  PartsScene MakeScene()
  {
    PartsScene scene;
    const bool tetrahedra = this->Chance(0.4);
    if (tetrahedra)
    {
      this->AddTetrahedra(scene);
    }
    else
    {
      this->AddMixedCells(scene);
    }
    scene.CellScalars = this->Chance(0.3);
    scene.Bends = tetrahedra;
    this->Separate(scene);
    this->Permute(scene);
    if (this->Chance(0.3))
    {
      this->MoveByLastBits(scene);
    }
    this->MakeGrid(scene);
    return scene;
  }

  /// Returns what kind of view it is.
  std::string SetView(RayCastScene& scene, const PartsScene& parts)
  {
    const Vector upwards = { this->Between(-0.3, 0.3), 1, this->Between(-0.3, 0.3) };
    const Vector middle = { this->Between(0.4, 0.6), this->Between(0.4, 0.6),
      this->Between(0.4, 0.6) };
    const MixedMesh& mesh = parts.Mesh;
    const std::vector<std::size_t>& corners = mesh.Cells[this->Below(mesh.Cells.size())].Points;
    const Vector &a = mesh.Points[corners[0]], &b = mesh.Points[corners[1]],
                 &c = mesh.Points[corners[2]];
    const auto mix = [&](double ofA, double ofB, double ofC)
    {
      Vector sum;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        sum[axis] = ofA * a[axis] + ofB * b[axis] + ofC * c[axis];
      }
      return sum;
    };
    const auto lookAlong = [&](Vector direction)
    {
      const double length = std::hypot(direction[0], direction[1], direction[2]);
      Vector position;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        position[axis] = middle[axis] - 3 * direction[axis] / length;
      }
      scene.Parallel = true;
      scene.ParallelScale = this->Between(0.3, 0.9);
      // Not along the view.
      const bool tilted = std::abs(direction[1]) > 0.8 * length;
      scene.SetCamera(position, middle, tilted ? Vector{ 1, 0, 0.1 } : upwards, Near);
    };
    const auto lookFrom = [&](const Vector& position, const Vector& at)
    {
      scene.Parallel = false;
      const Vector up =
        std::hypot(at[0] - position[0], at[2] - position[2]) < 0.1 ? Vector{ 1, 0, 0.1 } : upwards;
      scene.SetCamera(position, at, up, Near);
    };
    switch (this->Below(8))
    {
      case 0:
        lookAlong({ this->Between(-1, 1), this->Between(-1, 1), this->Between(-1, 1) });
        return "parallel";
      case 1:
      {
        Vector direction = { 0, 0, 0 };
        direction[this->Below(3)] = this->Chance(0.5) ? 1 : -1;
        lookAlong(direction);
        return "along an axis";
      }
      case 2:
        lookAlong(mix(-1, 1, 0));
        return "along an edge";
      case 3:
        lookAlong(mix(-1.3, 1, 0.3));
        return "along a face";
      case 4:
        lookFrom(a, middle);
        return "from a vertex";
      case 5:
        lookFrom(mix(6, -2, -3), middle);
        return "from the plane of a face";
      case 6:
        lookFrom({ this->Between(0.2, 0.8), this->Between(0.2, 0.8), this->Between(0.2, 0.8) },
          { this->Between(-1, 2), this->Between(-1, 2), this->Between(-1, 2) });
        return "from inside";
      default:
        lookFrom({ this->Between(1.5, 3), this->Between(-2, 2), this->Between(1.5, 3) }, middle);
        return "perspective";
    }
  }

private:
  static constexpr double Near = 1e-3;

  std::size_t Below(std::size_t n) { return this->Generator() % n; }
  bool Chance(double p) { return this->Between(0, 1) < p; }
  double Between(double lo, double hi)
  {
    return std::uniform_real_distribution<double>(lo, hi)(this->Generator);
  }

  void AddTetrahedra(PartsScene& scene)
  {
    const auto count = [this] { return 1 + static_cast<int>(this->Below(3)); };
    const double jitter = this->Chance(0.5) ? 0.15 : 0;
    const tetralux::TetrahedralMesh box = tetralux::MakeBox(
      count(), count(), count(), { 0, 0, 0 }, { 1, 1, 1 }, jitter, this->Generator());
    scene.Name = jitter > 0 ? "tetrahedra" : "tetrahedra of a lattice";
    for (std::size_t point = 0; point < box.GetNumberOfPoints(); ++point)
    {
      const double* x = &box.Points[3 * point];
      scene.Mesh.Points.push_back({ x[0], x[1], x[2] });
    }
    for (std::size_t cell = 0; cell < box.Cells.size(); cell += 4)
    {
      MixedMesh::Cell corners{ VTK_TETRA, {}, {} };
      for (std::size_t corner = cell; corner < cell + 4; ++corner)
      {
        corners.Points.push_back(static_cast<std::size_t>(box.Cells[corner]));
      }
      scene.Mesh.Cells.push_back(std::move(corners));
    }
  }

  /// Boxes of different sizes, sheared or not: their faces are planar to rounding. The diagonals
  /// by which neighbours are cut need not agree, so tetrahedra touch whose faces do not coincide.
  void AddMixedCells(PartsScene& scene)
  {
    MixedMesh& mesh = scene.Mesh;
    std::array<std::vector<double>, 3> planes;
    for (std::vector<double>& places : planes)
    {
      places = { 0, 1 };
      for (std::size_t count = this->Below(3); count > 0; --count)
      {
        places.push_back(this->Between(0.1, 0.9));
      }
      std::sort(places.begin(), places.end());
    }
    const bool sheared = this->Chance(0.6);
    scene.Name = sheared ? "sheared cells" : "upright cells";
    double shear[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    for (auto& row : shear)
    {
      for (double& entry : row)
      {
        entry += sheared ? this->Between(-0.2, 0.2) : 0;
      }
    }
    const auto addPoint = [&](const Vector& x)
    {
      Vector moved;
      for (std::size_t row = 0; row < 3; ++row)
      {
        moved[row] = shear[row][0] * x[0] + shear[row][1] * x[1] + shear[row][2] * x[2];
      }
      mesh.Points.push_back(moved);
      return mesh.Points.size() - 1;
    };
    const std::size_t sizes[] = { planes[0].size(), planes[1].size(), planes[2].size() };
    for (const double z : planes[2])
    {
      for (const double y : planes[1])
      {
        for (const double x : planes[0])
        {
          addPoint({ x, y, z });
        }
      }
    }
    for (std::size_t k = 0; k + 1 < sizes[2]; ++k)
    {
      for (std::size_t j = 0; j + 1 < sizes[1]; ++j)
      {
        for (std::size_t i = 0; i + 1 < sizes[0]; ++i)
        {
          const auto get = [&](std::size_t x, std::size_t y, std::size_t z)
          { return ((k + z) * sizes[1] + j + y) * sizes[0] + i + x; };
          const std::array<std::size_t, 8> corners = { get(0, 0, 0), get(1, 0, 0), get(1, 1, 0),
            get(0, 1, 0), get(0, 0, 1), get(1, 0, 1), get(1, 1, 1), get(0, 1, 1) };
          const auto middle = [&]
          {
            const auto half = [](const std::vector<double>& places, std::size_t n)
            { return 0.5 * (places[n] + places[n + 1]); };
            return addPoint({ half(planes[0], i), half(planes[1], j), half(planes[2], k) });
          };
          this->AddHexahedron(mesh, corners, sheared, middle);
        }
      }
    }
  }

  template <class Middle>
  void AddHexahedron(
    MixedMesh& mesh, const std::array<std::size_t, 8>& corners, bool sheared, const Middle& middle)
  {
    static const std::array<std::array<std::size_t, 4>, 6> faces = { { { 0, 3, 2, 1 },
      { 4, 5, 6, 7 }, { 0, 1, 5, 4 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 0, 4, 7 } } };
    const auto pick = [&](const std::vector<std::size_t>& places)
    {
      std::vector<std::size_t> picked;
      for (const std::size_t place : places)
      {
        picked.push_back(corners[place]);
      }
      return picked;
    };
    // Turned about its axis from corner 0 to corner 4.
    const std::size_t turn = this->Below(4);
    std::vector<std::size_t> turned;
    for (std::size_t place = 0; place < 8; ++place)
    {
      turned.push_back((place + turn) % 4 + place / 4 * 4);
    }
    switch (this->Below(5))
    {
      case 0:
        if (!sheared)
        {
          mesh.Cells.push_back({ VTK_VOXEL, pick({ 0, 1, 3, 2, 4, 5, 7, 6 }), {} });
          break;
        }
        [[fallthrough]];
      case 1:
        mesh.Cells.push_back({ VTK_HEXAHEDRON, pick(turned), {} });
        break;
      case 2:
        for (const std::size_t first : { 0, 2 })
        {
          const std::size_t p = turned[first], q = turned[first + 1], r = turned[(first + 2) % 4];
          mesh.Cells.push_back({ VTK_WEDGE, pick({ p, q, r, p + 4, q + 4, r + 4 }), {} });
        }
        break;
      case 3:
      {
        const std::size_t apex = middle();
        for (const auto& face : faces)
        {
          std::vector<std::size_t> points =
            pick({ face[turn], face[(turn + 1) % 4], face[(turn + 2) % 4], face[(turn + 3) % 4] });
          points.push_back(apex);
          mesh.Cells.push_back({ VTK_PYRAMID, points, {} });
        }
        break;
      }
      default:
      {
        MixedMesh::Cell cell{ VTK_POLYHEDRON, pick(turned), {} };
        for (const auto& face : faces)
        {
          cell.Faces.push_back(pick({ face[0], face[1], face[2], face[3] }));
        }
        mesh.Cells.push_back(cell);
        break;
      }
    }
  }

  /// Gives the cells of each part points of their own.
  void Separate(PartsScene& scene)
  {
    MixedMesh& mesh = scene.Mesh;
    const std::size_t kind = this->Below(4);
    static const char* const kinds[] = { "shared", "each its own", "pieces", "slabs" };
    scene.Name += std::string(", ") + kinds[kind];
    if (kind == 0)
    {
      return;
    }
    const std::size_t axis = this->Below(3);
    const double places[] = { this->Between(0.2, 0.5), this->Between(0.5, 0.8) };
    std::vector<Vector> points;
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> ids;
    for (std::size_t i = 0; i < mesh.Cells.size(); ++i)
    {
      MixedMesh::Cell& cell = mesh.Cells[i];
      std::size_t part = i;
      if (kind == 2)
      {
        part = this->Below(4);
      }
      else if (kind == 3)
      {
        double middle = 0;
        for (const std::size_t point : cell.Points)
        {
          middle += mesh.Points[point][axis] / static_cast<double>(cell.Points.size());
        }
        part = (middle > places[0] ? 1 : 0) + (middle > places[1] ? 1 : 0);
      }
      const auto separate = [&](std::size_t& point)
      {
        const auto [place, isNew] = ids.try_emplace({ part, point }, points.size());
        if (isNew)
        {
          points.push_back(mesh.Points[point]);
        }
        point = place->second;
      };
      std::for_each(cell.Points.begin(), cell.Points.end(), separate);
      for (auto& face : cell.Faces)
      {
        std::for_each(face.begin(), face.end(), separate);
      }
    }
    mesh.Points = std::move(points);
  }

  /// Cells and points in any order; tetrahedra's corners too.
  void Permute(PartsScene& scene)
  {
    MixedMesh& mesh = scene.Mesh;
    std::shuffle(mesh.Cells.begin(), mesh.Cells.end(), this->Generator);
    std::vector<std::size_t> places(mesh.Points.size());
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      places[i] = i;
    }
    std::shuffle(places.begin(), places.end(), this->Generator);
    std::vector<Vector> points(mesh.Points.size());
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      points[places[i]] = mesh.Points[i];
    }
    mesh.Points = std::move(points);
    const auto move = [&](std::size_t& point) { point = places[point]; };
    for (MixedMesh::Cell& cell : mesh.Cells)
    {
      std::for_each(cell.Points.begin(), cell.Points.end(), move);
      for (auto& face : cell.Faces)
      {
        std::for_each(face.begin(), face.end(), move);
      }
      if (cell.Type == VTK_TETRA)
      {
        std::shuffle(cell.Points.begin(), cell.Points.end(), this->Generator);
      }
    }
  }

  void MoveByLastBits(PartsScene& scene)
  {
    scene.Name += ", last bits";
    for (Vector& point : scene.Mesh.Points)
    {
      for (double& x : point)
      {
        const auto single = static_cast<float>(x);
        const float places[] = { single, std::nextafter(single, -9.F),
          std::nextafter(single, 9.F) };
        x = places[this->Below(3)];
      }
    }
  }

  void MakeGrid(PartsScene& scene)
  {
    scene.Grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkDoubleArray> field;
    field->SetName("Field");
    for (const Vector& x : scene.Mesh.Points)
    {
      points->InsertNextPoint(x.data());
      field->InsertNextValue(scene.Bends
          ? std::sin(5 * x[0] + 2 * x[1]) * std::cos(4 * x[1] - 3 * x[2])
          : 1.9 * x[0] - 1.3 * x[1] + 1.1 * x[2] - 0.9);
    }
    scene.Grid->SetPoints(points);
    scene.Grid->GetPointData()->SetScalars(field);
    vtkNew<vtkDoubleArray> ofCells;
    ofCells->SetName("OfCells");
    for (const MixedMesh::Cell& cell : scene.Mesh.Cells)
    {
      const std::vector<vtkIdType> ids(cell.Points.begin(), cell.Points.end());
      if (cell.Faces.empty())
      {
        scene.Grid->InsertNextCell(cell.Type, static_cast<vtkIdType>(ids.size()), ids.data());
      }
      else
      {
        std::vector<vtkIdType> faces;
        for (const auto& face : cell.Faces)
        {
          faces.push_back(static_cast<vtkIdType>(face.size()));
          faces.insert(faces.end(), face.begin(), face.end());
        }
        scene.Grid->InsertNextCell(cell.Type, static_cast<vtkIdType>(ids.size()), ids.data(),
          static_cast<vtkIdType>(cell.Faces.size()), faces.data());
      }
      ofCells->InsertNextValue(this->Between(-0.9, 0.7));
    }
    scene.Grid->GetCellData()->AddArray(ofCells);
  }

  std::mt19937_64 Generator;
};

/// Sets what the reference draws: the tetrahedra that the filter cuts the grid into.
void SetTetrahedra(RayCastScene& scene, const PartsScene& parts)
{
  vtkNew<vtkTetrahedralizeCells> split;
  split->SetInputData(parts.Grid);
  split->Update();
  vtkUnstructuredGrid* grid = split->GetOutput();
  scene.Grid = parts.Grid;
  scene.Mesh = {};
  scene.Scalars.clear();
  scene.CellScalars = parts.CellScalars;
  vtkDataArray* scalars = parts.CellScalars ? grid->GetCellData()->GetArray("OfCells")
                                            : grid->GetPointData()->GetArray("Field");
  for (vtkIdType point = 0; point < grid->GetNumberOfPoints(); ++point)
  {
    const double* x = grid->GetPoint(point);
    scene.Mesh.Points.insert(scene.Mesh.Points.end(), x, x + 3);
  }
  for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
  {
    scene.Scalars.push_back(scalars->GetTuple1(i));
  }
  vtkIdType size;
  const vtkIdType* ids;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    grid->GetCells()->GetCellAtId(cell, size, ids);
    scene.Mesh.Cells.insert(scene.Mesh.Cells.end(), ids, ids + 4);
  }
}

/// Largest error of a channel at the pixels that no silhouette grazes; how many of these are drawn
/// is added to covered.
double GetError(RayCastScene& scene, vtkTetrahedraVolumeMapper* mapper,
  const tetralux::ReferenceImage& reference, const std::vector<double>& grazing,
  std::size_t& covered)
{
  if (scene.CellScalars)
  {
    mapper->SetScalarModeToUseCellFieldData();
    mapper->SelectScalarArray("OfCells");
  }
  scene.Use(mapper);
  scene.Window->Render();
  const tetralux::ImageComparison comparison = tetralux::CompareWithReference(
    { scene.GetColors(), reference.Rgba.size() }, reference.Rgba, grazing);
  covered += comparison.Ungrazed.NumberOfPixels;
  return comparison.Ungrazed.Maximum;
}

TEST(PartsFuzz, AreDrawnAsTheReferenceDraws)
{
  const int rounds = GetNumber("TETRALUX_PARTS_ROUNDS", DefaultRounds);
  const int first = GetNumber("TETRALUX_PARTS_FIRST", 0);
  std::size_t covered = 0;
  double largest[3] = { 0, 0, 0 };
  RayCastScene scene(Width, Height);
  for (int round = first; round < first + rounds; ++round)
  {
    PartsFuzzer fuzzer(Seed + static_cast<std::uint64_t>(round));
    const PartsScene parts = fuzzer.MakeScene();
    SetTetrahedra(scene, parts);
    const std::string view = fuzzer.SetView(scene, parts);
    SCOPED_TRACE("round " + std::to_string(round) + ": " + parts.Name +
      (parts.CellScalars ? ", cell scalars, " : ", ") + view);

    const tetralux::ReferenceMesh mesh{ scene.Mesh.Points, scene.Mesh.Cells, scene.Scalars,
      scene.CellScalars };
    const tetralux::RayGrid rays = scene.MakeReferenceRays(Width, Height);
    const tetralux::RayLimits limits = scene.MakeReferenceLimits();
    const tetralux::ReferenceImage reference =
      tetralux::RenderReference(mesh, scene.Function, rays, limits);
    const std::vector<double> grazing =
      tetralux::MeasureGrazing(mesh, scene.Function, rays, limits, reference);

    vtkNew<vtkTetrahedraRayCastMapper> rayCast;
    rayCast->AutoAdjustSampleDistancesOff();
    vtkNew<vtkTetrahedraGPURayCastMapper> gpuRayCast;
    vtkNew<vtkTetrahedraProjectionMapper> projection;
    gpuRayCast->SetMaximumError(DisplayTolerance);
    projection->SetMaximumError(DisplayTolerance);
    vtkTetrahedraVolumeMapper* const mappers[] = { rayCast, gpuRayCast, projection };
    const char* const names[] = { "ray cast", "graphics card", "projection" };
    for (int i = 0; i < 3; ++i)
    {
      // Every other scene with cells that stay apart.
      mappers[i]->SetMergePoints(round % 2 == 0 ? vtkTetrahedraVolumeMapper::AUTOMATIC_MERGE
                                                : vtkTetrahedraVolumeMapper::MERGE_OFF);
      const double error = GetError(scene, mappers[i], reference, grazing, covered);
      EXPECT_LE(error, i == 0 ? RayCastTolerance : DisplayTolerance) << names[i];
      largest[i] = std::max(largest[i], error);
    }
  }
  std::cout << "largest errors " << largest[0] << " " << largest[1] << " " << largest[2] << ", "
            << covered << " pixels\n";
  // Where nothing is seen little is tested.
  EXPECT_GT(covered, static_cast<std::size_t>(rounds) * 3 * Width * Height / 5);
}

} // namespace
