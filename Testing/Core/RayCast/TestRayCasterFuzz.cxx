// SPDX-License-Identifier: BSD-3-Clause

// The ray caster under whatever input comes along: it ends, and what it draws is a picture. The
// environment variable TETRALUX_FUZZ_ROUNDS sets how many scenes are tried.

#include "RayScene.h"

#include <gtest/gtest.h>

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{

using namespace tetralux;

constexpr std::uint64_t Seed = 6021023;
#if defined(__SANITIZE_ADDRESS__)
constexpr int DefaultRounds = 600; // each takes six times as long
#else
constexpr int DefaultRounds = 4000;
#endif

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Rounding of a sum of segments, in a colour channel.
constexpr double ColorTolerance = 1e-4;

/// What is left around the picture's arrays, to see writes beside them.
constexpr std::size_t Guard = 64;
constexpr float GuardValue = -12345.f;

int GetNumberOfRounds()
{
  const char* text = std::getenv("TETRALUX_FUZZ_ROUNDS");
  const int rounds = text ? std::atoi(text) : 0;
  return rounds > 0 ? rounds : DefaultRounds;
}

class Fuzzer
{
public:
  explicit Fuzzer(std::uint64_t seed)
    : Generator(seed)
  {
  }

  RayScene MakeScene()
  {
    RayScene scene;
    this->MakeMesh(scene.Mesh);
    this->MakeFunction(scene.Function);
    this->MakeScalars(scene);
    this->MakeRays(scene);
    this->MakeLimits(scene);
    return scene;
  }

  RayCastOptions MakeOptions()
  {
    RayCastOptions options;
    const Precision all[] = { Precision::Automatic, Precision::Single, Precision::Double };
    options.Arithmetic = all[this->Below(3)];
    options.Kernels = ChooseKernels(this->Chance(0.3));
    options.NumberOfThreads = this->Chance(0.1) ? 3 : 1;
    options.MaximumError = this->Chance(0.1) ? 0 : std::pow(10, this->Between(-7, 0));
    return options;
  }

private:
  std::size_t Below(std::size_t n) { return this->Generator() % n; }
  bool Chance(double p) { return this->Between(0, 1) < p; }
  double Between(double lo, double hi)
  {
    return std::uniform_real_distribution<double>(lo, hi)(this->Generator);
  }
  double Magnitude(double lowest, double highest)
  {
    return std::pow(10, this->Between(lowest, highest)) * (this->Chance(0.5) ? 1 : -1);
  }
  /// A number that nobody expects.
  double Odd()
  {
    const double numbers[] = { NaN, Infinity, -Infinity, 0, -0., 1e300, -1e300, 1e-310, 1, -1 };
    return numbers[this->Below(std::size(numbers))];
  }

  void MakeMesh(TetrahedralMesh& mesh)
  {
    switch (this->Below(4))
    {
      case 0:
        mesh = MakeBox(1 + this->Size(5), 1 + this->Size(5), 1 + this->Size(5), { 0, 0, 0 },
          { 1, 1, 1 }, this->Between(0, 0.5), this->Generator());
        break;
      case 1: // any points, any cells
        this->AddPoints(mesh, 4 + this->Below(40), 0);
        this->AddCells(mesh, this->Below(300));
        break;
      case 2: // points of a lattice: flat cells, cells in line, and all of them overlap
        this->AddPoints(mesh, 4 + this->Below(40), 3);
        this->AddCells(mesh, this->Below(300));
        break;
      default:
        this->AddPoints(mesh, 4 + this->Below(3), 0);
        this->AddCells(mesh, this->Below(3));
        break;
    }
    if (this->Chance(0.6))
    {
      this->AddDefects(mesh);
    }
    this->ScalePoints(mesh);
  }

  int Size(int n) { return static_cast<int>(this->Below(static_cast<std::size_t>(n))); }

  void AddPoints(TetrahedralMesh& mesh, std::size_t count, int steps)
  {
    for (std::size_t i = 0; i < 3 * count; ++i)
    {
      mesh.Points.push_back(
        steps ? static_cast<double>(this->Size(steps)) / steps : this->Between(0, 1));
    }
  }

  void AddCells(TetrahedralMesh& mesh, std::size_t count)
  {
    for (std::size_t i = 0; i < 4 * count; ++i)
    {
      mesh.Cells.push_back(static_cast<std::int32_t>(this->Below(mesh.GetNumberOfPoints())));
    }
  }

  void AddDefects(TetrahedralMesh& mesh)
  {
    const std::size_t cells = mesh.GetNumberOfCells();
    const std::size_t points = mesh.GetNumberOfPoints();
    for (std::size_t defects = this->Below(12); cells > 0 && defects > 0; --defects)
    {
      const std::size_t cell = this->Below(cells);
      std::int32_t* corners = &mesh.Cells[4 * cell];
      double* point = &mesh.Points[3 * this->Below(points)];
      const double* other = &mesh.Points[3 * this->Below(points)];
      switch (this->Below(8))
      {
        case 0: // inverted
          std::swap(corners[0], corners[1]);
          break;
        case 1: // repeated id
          corners[this->Below(4)] = corners[this->Below(4)];
          break;
        case 2: // no such point
        {
          const std::int32_t ids[] = { -1, static_cast<std::int32_t>(points),
            std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max() };
          corners[this->Below(4)] = ids[this->Below(4)];
          break;
        }
        case 3: // duplicate
          mesh.Cells.insert(mesh.Cells.end(), { corners[2], corners[0], corners[3], corners[1] });
          break;
        case 4: // points that coincide
          std::copy_n(other, 3, point);
          break;
        case 5: // a third cell at a face, which overlaps another
          mesh.Cells.insert(mesh.Cells.end(),
            { corners[0], corners[1], corners[2], static_cast<std::int32_t>(this->Below(points)) });
          break;
        case 6:
          point[this->Below(3)] = this->Odd();
          break;
        default: // far from all the others, or nearly at the origin
          point[this->Below(3)] = this->Magnitude(-30, 30);
          break;
      }
    }
  }

  void ScalePoints(TetrahedralMesh& mesh)
  {
    double scale[3] = { 1, 1, 1 };
    if (this->Chance(0.3))
    {
      scale[0] = scale[1] = scale[2] = this->Magnitude(-30, 30);
    }
    else if (this->Chance(0.2))
    {
      for (double& s : scale)
      {
        s = this->Magnitude(-30, 30);
      }
    }
    const double offset = this->Chance(0.2) ? this->Magnitude(-3, 8) : 0;
    for (std::size_t i = 0; i < mesh.Points.size(); ++i)
    {
      mesh.Points[i] = offset + scale[i % 3] * mesh.Points[i];
    }
    this->WorldSize = std::abs(scale[0]);
  }

  TransferFunction::Value MakeValue()
  {
    TransferFunction::Value value{};
    for (double& c : value.Color)
    {
      c = this->Between(0, 1);
    }
    switch (this->Below(4))
    {
      case 0:
        value.Attenuation = 0;
        break;
      case 1:
        value.Attenuation = std::abs(this->Magnitude(-30, 30));
        break;
      default: // something to be seen
        value.Attenuation = std::abs(this->Magnitude(-2, 3)) / this->WorldSize;
        break;
    }
    return value;
  }

  void MakeFunction(TransferFunction& function)
  {
    this->ScalarSize = this->Chance(0.3) ? std::abs(this->Magnitude(-30, 30)) : 1;
    double scalar = this->ScalarSize * this->Between(-1, 0.5);
    for (std::size_t nodes = 1 + this->Below(8); nodes > 0; --nodes)
    {
      const TransferFunction::Value left = this->MakeValue();
      function.Nodes.push_back({ scalar, left, this->Chance(0.5) ? left : this->MakeValue() });
      const double step =
        this->ScalarSize * (this->Chance(0.3) ? std::pow(10, this->Between(-12, 0)) : 0.3);
      scalar = std::max(scalar + step, std::nextafter(scalar, Infinity));
    }
  }

  void MakeScalars(RayScene& scene)
  {
    scene.CellScalars = this->Chance(0.3);
    const std::size_t count =
      scene.CellScalars ? scene.Mesh.GetNumberOfCells() : scene.Mesh.GetNumberOfPoints();
    const std::size_t kind = this->Below(5);
    const auto& nodes = scene.Function.Nodes;
    for (std::size_t i = 0; i < count; ++i)
    {
      double s = this->ScalarSize * this->Between(-1, 2);
      switch (kind)
      {
        case 0: // at nodes
          s = nodes[this->Below(nodes.size())].Scalar;
          break;
        case 1: // constant
          s = nodes.back().Scalar;
          break;
        case 2:
          s = this->Chance(0.1) ? this->Odd() : s;
          break;
        case 3:
          s = this->Chance(0.1) ? this->Magnitude(-30, 30) : s;
          break;
        default:
          break;
      }
      scene.Scalars.push_back(s);
    }
  }

  void MakeRays(RayScene& scene)
  {
    const int width = 1 + this->Size(20);
    const int height = 1 + this->Size(20);
    const std::vector<double>& points = scene.Mesh.Points;
    std::array<double, 3> target = { 0, 0, 0 };
    const auto pickPoint = [&](std::array<double, 3>& p)
    { std::copy_n(&points[3 * this->Below(points.size() / 3)], 3, p.begin()); };
    pickPoint(target);
    std::array<double, 3> eye;
    switch (this->Below(4))
    {
      case 0: // at a point of the mesh
        pickPoint(eye);
        break;
      case 1: // along an axis
        eye = target;
        eye[this->Below(3)] += this->WorldSize * (this->Chance(0.5) ? 3 : -3);
        break;
      default:
        for (int a = 0; a < 3; ++a)
        {
          eye[a] = target[a] + this->WorldSize * this->Between(-3, 3);
        }
        break;
    }
    scene.Grid = this->Chance(0.5)
      ? MakePerspectiveGrid(eye, target, { 0.1, 0.2, 0.9 }, this->Between(1, 170), width, height)
      : MakeParallelGrid(eye, target, { 0.1, 0.2, 0.9 },
          this->WorldSize * std::abs(this->Magnitude(-1, 1)), width, height);
    if (this->Chance(0.2))
    {
      const double scale = std::abs(this->Magnitude(-3, 3));
      double worldFromMesh[3][4];
      for (auto& row : worldFromMesh)
      {
        for (double& m : row)
        {
          m = scale * this->Between(-1, 1);
        }
      }
      PlaceMesh(scene.Grid, worldFromMesh);
    }
    if (this->Chance(0.05)) // no rays at all, or none that make sense
    {
      double* numbers[] = { scene.Grid.Origin, scene.Grid.Direction, scene.Grid.DirectionStepX,
        scene.Grid.OriginStepY, scene.Grid.MeshFromWorld[0], scene.Grid.MeshFromWorld[2] };
      double* row = numbers[this->Below(std::size(numbers))];
      row[this->Below(3)] = this->Odd();
      if (this->Chance(0.3))
      {
        std::fill_n(row, 3, 0.);
      }
    }
  }

  void MakeLimits(RayScene& scene)
  {
    for (std::size_t planes = this->Chance(0.3) ? this->Below(4) : 0; planes > 0; --planes)
    {
      std::array<double, 4> plane;
      for (double& p : plane)
      {
        p = this->Chance(0.1) ? this->Odd() : this->Between(-1, 1);
      }
      plane[3] *= this->WorldSize;
      scene.Limits.Planes.push_back(plane);
    }
    if (this->Chance(0.3))
    {
      scene.Limits.Cropping = true;
      scene.Limits.CroppingFlags = static_cast<std::uint32_t>(this->Generator());
      for (double& p : scene.Limits.CroppingPlanes)
      {
        p = this->Chance(0.05) ? this->Odd() : this->WorldSize * this->Between(-0.5, 1.5);
      }
    }
    if (this->Chance(0.2))
    {
      for (int pixel = scene.Grid.Width * scene.Grid.Height; pixel > 0; --pixel)
      {
        scene.MaximumDistances.push_back(static_cast<float>(
          this->Chance(0.1) ? this->Odd() : this->WorldSize * this->Between(0, 6)));
      }
    }
  }

  std::mt19937_64 Generator;
  double WorldSize = 1;
  double ScalarSize = 1;
};

/// Casts the scene and checks what came out; returns the number of pixels that show anything.
int CheckScene(const RayScene& scene, const RayCastOptions& options)
{
  VolumeScene volume = scene.MakeVolumeScene();
  const std::size_t pixels = static_cast<std::size_t>(scene.Grid.Width) * scene.Grid.Height;
  std::vector<float> colors(4 * pixels + 2 * Guard, GuardValue);
  std::vector<float> depths(pixels + 2 * Guard, GuardValue);
  const RayCastStatistics statistics = CastRays(volume, scene.Grid, scene.GetLimits(), options,
    Span<float>(colors.data() + Guard, 4 * pixels), Span<float>(depths.data() + Guard, pixels));

  EXPECT_FALSE(std::isnan(statistics.ErrorEstimate));
  EXPECT_GE(statistics.ErrorEstimate, 0);
  EXPECT_GE(statistics.LaneUse, 0);
  EXPECT_LE(statistics.LaneUse, 1);
  for (std::size_t i = 0; i < Guard; ++i)
  {
    EXPECT_EQ(colors[i], GuardValue);
    EXPECT_EQ(colors[colors.size() - 1 - i], GuardValue);
    EXPECT_EQ(depths[i], GuardValue);
    EXPECT_EQ(depths[depths.size() - 1 - i], GuardValue);
  }
  const double largestColor = GetLargestColor(scene.Function);
  int covered = 0;
  for (std::size_t p = 0; p < pixels; ++p)
  {
    const float* color = &colors[Guard + 4 * p];
    const float alpha = color[3];
    const float depth = depths[Guard + p];
    covered += alpha > 0;
    // Negated, so that what is not a number fails.
    const bool isAlpha = alpha >= 0 && alpha <= 1;
    EXPECT_TRUE(isAlpha) << "pixel " << p << ": opacity " << alpha;
    EXPECT_FALSE(std::isnan(depth)) << "pixel " << p; // infinite beyond the numbers of the array
    for (int c = 0; c < 3; ++c)
    {
      const bool isColor = color[c] >= -ColorTolerance &&
        color[c] <= largestColor * static_cast<double>(alpha) + ColorTolerance;
      EXPECT_TRUE(isColor) << "pixel " << p << ": colour " << color[c] << ", opacity " << alpha;
    }
    if (testing::Test::HasFailure())
    {
      break;
    }
  }
  return covered;
}

TEST(RayCasterFuzz, DrawsPicturesOfWhateverComes)
{
  const int rounds = GetNumberOfRounds();
  std::cout << "seed " << Seed << ", " << rounds << " rounds\n";
  std::int64_t covered = 0;
  int withPicture = 0;
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1); // for meshes as small as these threads cost more than they bring
  for (int round = 0; round < rounds; ++round)
  {
    SCOPED_TRACE("round " + std::to_string(round) + " of seed " + std::to_string(Seed));
    Fuzzer fuzzer(Seed + static_cast<std::uint64_t>(round));
    const RayScene scene = fuzzer.MakeScene();
    const int pixels = CheckScene(scene, fuzzer.MakeOptions());
    covered += pixels;
    withPicture += pixels > 0;
    if (HasFailure())
    {
      break;
    }
  }
  omp_set_num_threads(threads);
  std::cout << withPicture << " pictures with " << covered << " pixels in all\n";
  // Rounds in which nothing is seen test little.
  EXPECT_GT(withPicture, rounds / 5);
}

} // namespace
