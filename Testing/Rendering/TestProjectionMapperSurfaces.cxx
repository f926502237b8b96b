// SPDX-License-Identifier: BSD-3-Clause
// Isosurfaces of the projection mapper are watertight: every ray meets each of many surfaces as
// often as a ray of the ray caster in double precision does, which goes from cell to cell and
// carries the scalar on from face to face.
#include "RayCastScene.h"

#include "ReferenceScenes.h"

#include "vtkContourValues.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkTetrahedraProjectionMapper.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <vector>

namespace
{

/// Opacity of each surface: what a ray gathers is nearly this times the number of
/// surfaces it meets.
constexpr double Opacity = 1. / 65536;

/// Surfaces are at multiples of this, between -1 and 1.
constexpr double Spacing = 1. / 64;

/// Scalars within -1..1 come out of the projection with at most this error: some roundings of
/// 2^-24, and rays that pass beside the centres of pixels.
constexpr double ScalarError = 2e-6;

/// The share of the rays that may be open within ScalarError, see IsOpen.
constexpr double OpenShare = 2e-4;

/// Differences of pictures below this, in numbers of surfaces, are rounding.
constexpr double Tolerance = 0.1;

/// Waves in all directions, -1..1, both of which are reached.
std::vector<double> MakeWaves(const tetralux::TetrahedralMesh& mesh, unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  constexpr int Waves = 8;
  double waves[Waves][4];
  for (auto& wave : waves)
  {
    for (double& w : wave)
    {
      w = 4 * normal(random);
    }
  }
  std::vector<double> field;
  for (std::size_t p = 0; p < mesh.GetNumberOfPoints(); ++p)
  {
    const double* x = &mesh.Points[3 * p];
    double sum = 0;
    for (const auto& wave : waves)
    {
      sum += std::sin(wave[0] * x[0] + wave[1] * x[1] + wave[2] * x[2] + wave[3]);
    }
    field.push_back(sum);
  }
  const auto [least, largest] = std::minmax_element(field.begin(), field.end());
  const double lo = *least;
  const double hi = *largest;
  for (double& s : field)
  {
    s = std::clamp(2 * (s - lo) / (hi - lo) - 1, -1., 1.);
  }
  return field;
}

/// What a ray gathers, in numbers of surfaces: all, and weighted by the red and green
/// of their colours.
struct Gathered
{
  double Number, Red, Green;
};

double GetRed(double value) { return 0.5 * (value + 1); }

double GetGreen(double value) { return GetRed(value) * GetRed(value); }

bool AreEqual(const Gathered& a, const Gathered& b)
{
  return std::abs(a.Number - b.Number) < Tolerance && std::abs(a.Red - b.Red) < Tolerance &&
    std::abs(a.Green - b.Green) < Tolerance;
}

/// Whether two rays differ by one surface that one of them meets so many times more often.
bool DifferByOneSurface(const Gathered& a, const Gathered& b, int times, double& value)
{
  const double number = a.Number - b.Number;
  const double red = (a.Red - b.Red) / number;
  const double green = (a.Green - b.Green) / number;
  value = Spacing * std::round((2 * red - 1) / Spacing);
  return std::abs(std::abs(number) - times) < Tolerance &&
    std::abs(red - GetRed(value)) < Tolerance * Spacing &&
    std::abs(green - GetGreen(value)) < Tolerance * Spacing;
}

/// Whether what a ray was found to gather differs from the scalars at the ends of its parts only in
/// what the error of scalars leaves open: a surface on which it begins or ends, or one that it
/// touches at the face between two parts, where the scalar has its largest or least value.
bool IsOpen(const Gathered& found, const Gathered& exact, const std::vector<double>& scalars)
{
  double value;
  const std::size_t size = scalars.size();
  const auto isNear = [&](double s) { return std::abs(s - value) <= ScalarError; };
  bool atEnd = false;
  bool touching = false;
  if (DifferByOneSurface(found, exact, 1, value))
  {
    atEnd = isNear(scalars.front()) || isNear(scalars.back());
    for (std::size_t k = 1; k + 1 < size; k += 2)
    {
      const bool cut = std::abs(scalars[k] - scalars[k + 1]) > ScalarError;
      atEnd = atEnd || (cut && (isNear(scalars[k]) || isNear(scalars[k + 1])));
    }
  }
  else if (DifferByOneSurface(found, exact, 2, value))
  {
    for (std::size_t k = 1; k + 1 < size; k += 2)
    {
      const bool extreme = (scalars[k] - scalars[k - 1]) * (scalars[k + 2] - scalars[k]) <= 0;
      touching = touching || (extreme && isNear(scalars[k]));
    }
  }
  return atEnd || touching;
}

class SurfacesScene : public RayCastScene
{
public:
  explicit SurfacesScene(double jitter = 0.15)
    : RayCastScene(Size, Size)
  {
    this->Mesh = tetralux::MakeBox(20, 20, 20, { 0, 0, 0 }, { 1, 1, 1 }, jitter);
    this->SetField(MakeWaves(this->Mesh, 1));
    this->Mapper->SetPrecisionToDouble();
    for (vtkTetrahedraVolumeMapper* mapper : this->GetMappers())
    {
      mapper->SetMaximumError(1e-6);
      mapper->SetBlendModeToIsoSurface();
    }
    this->Color->RemoveAllPoints();
    this->Opacity->RemoveAllPoints();
    this->Opacity->AddPoint(-1, ::Opacity);
    this->Opacity->AddPoint(1, ::Opacity);
    int surface = 0;
    for (double value = -1 + Spacing; value < 1; value += Spacing)
    {
      this->Color->AddRGBPoint(value, GetRed(value), GetGreen(value), 1);
      this->Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(surface++, value);
    }
  }

  std::array<vtkTetrahedraVolumeMapper*, 2> GetMappers()
  {
    return { this->Mapper.Get(), this->Projection.Get() };
  }

  void SetField(const std::vector<double>& field)
  {
    this->Scalars = field;
    this->Grid = MakeGrid(this->Mesh, field);
  }

  void SetCamera(const Vector& position, const Vector& focalPoint, const Vector& viewUp)
  {
    this->RayCastScene::SetCamera(position, focalPoint, viewUp, Near);
  }

  /// Compares the mappers. Where they differ, either the projection is right by brute force (the
  /// ray caster leaves out what a ray meets twice in no distance), or the ray only touches a
  /// surface, or begins or ends on it, within the error of scalars.
  void ExpectSameCrossings()
  {
    const std::vector<Gathered> expected = this->Render(this->Mapper);
    const std::vector<Gathered> found = this->Render(this->Projection);
    int met = 0;
    int twice = 0;
    int open = 0;
    for (int pixel = 0; pixel < Size * Size; ++pixel)
    {
      met += expected[pixel].Number > 0;
      if (AreEqual(found[pixel], expected[pixel]))
      {
        continue;
      }
      const std::vector<double> scalars = this->FindScalars(pixel % Size, pixel / Size);
      const Gathered exact = Gather(scalars);
      if (AreEqual(found[pixel], exact))
      {
        ++twice;
        continue;
      }
      EXPECT_TRUE(IsOpen(found[pixel], exact, scalars))
        << pixel << ": " << found[pixel].Number << " instead of " << exact.Number;
      ++open;
    }
    std::cout << met << " rays meet surfaces, " << twice << " of them twice in no distance, "
              << open << " are open\n";
    EXPECT_GT(met, Size * Size / 4);
    EXPECT_LE(open, OpenShare * met);
  }

  std::vector<Gathered> Render(vtkTetrahedraVolumeMapper* mapper)
  {
    this->Use(mapper);
    this->Window->Render();
    mapper->GetOutputImage();
    std::vector<Gathered> result;
    for (int pixel = 0; pixel < Size * Size; ++pixel)
    {
      const float* color = this->GetColors() + 4 * pixel;
      result.push_back({ color[3] / ::Opacity, color[0] / ::Opacity, color[1] / ::Opacity });
    }
    return result;
  }

  vtkNew<vtkTetrahedraProjectionMapper> Projection;

private:
  static constexpr int Size = 200;
  static constexpr double Near = 0.01;

  /// Of pairs of scalars, at both ends of the parts of a ray, front to back. What is behind others
  /// counts a little less.
  static Gathered Gather(const std::vector<double>& scalars)
  {
    Gathered result = { 0, 0, 0 };
    for (std::size_t k = 0; k < scalars.size(); k += 2)
    {
      const double front = scalars[k];
      const double back = scalars[k + 1];
      for (int surface = 1; surface * Spacing < 2; ++surface)
      {
        const double value = front < back ? -1 + surface * Spacing : 1 - surface * Spacing;
        if ((front < value) != (back < value))
        {
          const double share = 1 - ::Opacity * result.Number;
          result.Number += share;
          result.Red += share * GetRed(value);
          result.Green += share * GetGreen(value);
        }
      }
    }
    return result;
  }

  /// Scalars at both ends of all parts of a ray that are in one cell and one region of the
  /// cropping, in double precision: each cell is cut with the ray by itself.
  std::vector<double> FindScalars(int i, int j) const
  {
    const Ray ray = this->MakeRay(i, j);
    std::vector<Part> parts;
    for (std::size_t cell = 0; cell < this->Mesh.GetNumberOfCells(); ++cell)
    {
      this->AddParts(ray, &this->Mesh.Cells[4 * cell], parts);
    }
    std::sort(parts.begin(), parts.end(),
      [](const Part& p, const Part& q) { return p.Begin + p.End < q.Begin + q.End; });
    std::vector<double> scalars;
    for (const Part& part : parts)
    {
      scalars.insert(scalars.end(), { part.Front, part.Back });
    }
    return scalars;
  }

  struct Ray
  {
    Vector Origin;
    Vector Direction;           ///< of length 1
    double Begin;               ///< distance of the near plane
    std::vector<Vector> Points; ///< of the mesh: across the ray in two directions, and along it
  };

  struct Part
  {
    double Begin, End; ///< distances
    double Front, Back;
  };

  Ray MakeRay(int i, int j) const
  {
    const tetralux::RayGrid rays = this->MakeReferenceRays(Size, Size);
    Ray ray;
    for (int c = 0; c < 3; ++c)
    {
      ray.Origin[c] = rays.Origin[c] + i * rays.OriginStepX[c] + j * rays.OriginStepY[c];
      ray.Direction[c] =
        rays.Direction[c] + i * rays.DirectionStepX[c] + j * rays.DirectionStepY[c];
    }
    vtkMath::Normalize(ray.Direction.data());
    Vector axis = { rays.Direction[0], rays.Direction[1], rays.Direction[2] };
    for (int c = 0; c < 3; ++c)
    {
      axis[c] +=
        0.5 * (Size - 1) * (rays.DirectionStepX[c] + rays.DirectionStepY[c]); // of the middle
    }
    vtkMath::Normalize(axis.data());
    ray.Begin = Near / vtkMath::Dot(axis.data(), ray.Direction.data());
    Vector across[2];
    vtkMath::Perpendiculars(ray.Direction.data(), across[0].data(), across[1].data(), 0);
    for (std::size_t p = 0; p < this->Mesh.GetNumberOfPoints(); ++p)
    {
      Vector x;
      vtkMath::Subtract(&this->Mesh.Points[3 * p], ray.Origin.data(), x.data());
      ray.Points.push_back({ vtkMath::Dot(x.data(), across[0].data()),
        vtkMath::Dot(x.data(), across[1].data()), vtkMath::Dot(x.data(), ray.Direction.data()) });
    }
    return ray;
  }

  /// Distance and scalar where a ray goes through a face; false where it does not.
  bool FindCut(const Ray& ray, const std::array<std::int32_t, 3>& face, double& z, double& s) const
  {
    double weights[3];
    for (int k = 0; k < 3; ++k)
    {
      const Vector& p = ray.Points[face[(k + 1) % 3]];
      const Vector& q = ray.Points[face[(k + 2) % 3]];
      weights[k] = p[0] * q[1] - p[1] * q[0];
    }
    const bool left = weights[0] > 0 && weights[1] > 0 && weights[2] > 0;
    const bool right = weights[0] < 0 && weights[1] < 0 && weights[2] < 0;
    // Relative to one of the points, so that what is constant comes out as it is.
    const double sum = weights[0] + weights[1] + weights[2];
    z = 0;
    s = this->Scalars[face[0]];
    for (int k = 0; k < 3; ++k)
    {
      z += weights[k] / sum * ray.Points[face[k]][2];
      s += weights[k] / sum * (this->Scalars[face[k]] - this->Scalars[face[0]]);
    }
    return left || right;
  }

  void AddParts(const Ray& ray, const std::int32_t* cell, std::vector<Part>& parts) const
  {
    std::vector<std::array<double, 2>> ends; // distance, scalar
    for (int opposite = 0; opposite < 4; ++opposite)
    {
      std::array<std::int32_t, 3> face;
      std::remove_copy(cell, cell + 4, face.begin(), cell[opposite]);
      std::sort(face.begin(), face.end());
      double z, s;
      if (this->FindCut(ray, face, z, s))
      {
        ends.push_back({ z, s });
      }
    }
    std::sort(ends.begin(), ends.end());
    if (ends.size() < 2 || ends.back()[0] <= ray.Begin)
    {
      return;
    }
    const auto [z0, s0] = ends.front();
    const auto [z1, s1] = ends.back();
    std::vector<double> cuts = { std::max(z0, ray.Begin), z1 };
    for (int plane = 0; plane < 6 && this->Mapper->GetCropping(); ++plane)
    {
      const double cut = (this->Mapper->GetCroppingRegionPlanes()[plane] - ray.Origin[plane / 2]) /
        ray.Direction[plane / 2];
      if (cut > cuts.front() && cut < z1)
      {
        cuts.push_back(cut);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 1; k < cuts.size(); ++k)
    {
      const auto interpolate = [&, begin = z0, length = z1 - z0, front = s0, change = s1 - s0](
                                 double z) { return front + (z - begin) / length * change; };
      if (this->IsKept(ray, 0.5 * (cuts[k - 1] + cuts[k])))
      {
        parts.push_back({ cuts[k - 1], cuts[k], cuts[k - 1] == z0 ? s0 : interpolate(cuts[k - 1]),
          cuts[k] == z1 ? s1 : interpolate(cuts[k]) });
      }
    }
  }

  bool IsKept(const Ray& ray, double z) const
  {
    int region = 0;
    for (int axis = 2; axis >= 0; --axis)
    {
      const double x = ray.Origin[axis] + z * ray.Direction[axis];
      const double* planes = this->Mapper->GetCroppingRegionPlanes() + 2 * axis;
      region = 3 * region + (x >= planes[0]) + (x >= planes[1]);
    }
    return !this->Mapper->GetCropping() ||
      ((this->Mapper->GetCroppingRegionFlags() >> region) & 1) != 0;
  }
};

TEST(ProjectionMapperSurfaces, Perspective)
{
  SurfacesScene scene;
  scene.ExpectSameCrossings();
  // From inside: cells around the eye.
  scene.ViewAngle = 90;
  scene.SetCamera({ 0.31, 0.42, 0.53 }, { 0.9, 0.8, 0.2 }, { 0, 1, 0 });
  scene.ExpectSameCrossings();
}

TEST(ProjectionMapperSurfaces, ParallelProjection)
{
  SurfacesScene scene;
  scene.Parallel = true;
  scene.SetCamera({ 1.9, 1.4, 2.6 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0 });
  scene.ExpectSameCrossings();
}

// Many faces are seen exactly from the side.
TEST(ProjectionMapperSurfaces, AlongTheAxesOfAGrid)
{
  SurfacesScene scene(0);
  scene.Parallel = true;
  scene.ParallelScale = 0.45;
  scene.SetCamera({ 0.5, 0.5, 3 }, { 0.5, 0.5, 0.5 }, { 0, 1, 0 });
  scene.ExpectSameCrossings();
  scene.Parallel = false;
  scene.SetCamera({ 0.5, 0.5, 3 }, { 0.5, 0.5, 0.5 }, { 0, 1, 0 });
  scene.ExpectSameCrossings();
}

TEST(ProjectionMapperSurfaces, RegionsThatHaveTheValueExactly)
{
  SurfacesScene scene;
  std::vector<double> field = scene.Scalars;
  for (double& s : field)
  {
    s = std::abs(s) < 0.25 ? 0 : s;
  }
  scene.SetField(field);
  scene.ExpectSameCrossings();
  scene.Parallel = true;
  scene.SetCamera({ 1.9, 1.4, 2.6 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0 });
  scene.ExpectSameCrossings();
}

// Cells ten thousand times thinner than wide.
TEST(ProjectionMapperSurfaces, ThinLayers)
{
  SurfacesScene scene;
  std::vector<double> field = scene.Scalars;
  for (std::size_t p = 0; p < scene.Mesh.GetNumberOfPoints(); ++p)
  {
    double& z = scene.Mesh.Points[3 * p + 2];
    z = 0.5 + 1e-4 * (z - 0.5);
  }
  scene.SetField(field);
  scene.ExpectSameCrossings();
}

// Lights that leave colours as they are.
TEST(ProjectionMapperSurfaces, Lit)
{
  SurfacesScene scene;
  vtkVolumeProperty* property = scene.Volume->GetProperty();
  property->ShadeOn();
  property->SetAmbient(1);
  property->SetDiffuse(0);
  property->SetSpecular(0);
  scene.ExpectSameCrossings();
}

// Parts of cells: what rays are cut off by is within them.
TEST(ProjectionMapperSurfaces, Cropped)
{
  SurfacesScene scene;
  for (vtkTetrahedraVolumeMapper* mapper : scene.GetMappers())
  {
    mapper->CroppingOn();
    mapper->SetCroppingRegionPlanes(0.2, 0.7, 0.35, 0.8, 0.3, 0.6);
    mapper->SetCroppingRegionFlagsToFence();
  }
  scene.ExpectSameCrossings();
}

// Other scalars on faces, that is to say other surfaces, but not many.
TEST(ProjectionMapperSurfaces, WithoutPerspectiveInterpolation)
{
  SurfacesScene scene;
  const std::vector<Gathered> exact = scene.Render(scene.Projection);
  scene.Projection->PerspectiveInterpolationOff();
  const std::vector<Gathered> linear = scene.Render(scene.Projection);
  double sum = 0;
  double differences = 0;
  for (std::size_t pixel = 0; pixel < exact.size(); ++pixel)
  {
    sum += exact[pixel].Number;
    differences += std::abs(linear[pixel].Number - exact[pixel].Number);
  }
  EXPECT_GT(differences, 0);
  EXPECT_LT(differences, 0.02 * sum);
}

// The distance of the first surface.
TEST(ProjectionMapperSurfaces, Depths)
{
  SurfacesScene scene;
  std::vector<std::vector<float>> depths;
  for (vtkTetrahedraVolumeMapper* mapper : scene.GetMappers())
  {
    scene.Use(mapper);
    scene.Window->Render();
    const vtkIdType size = mapper->GetOutputImage()->GetNumberOfPoints();
    depths.emplace_back(scene.GetDepths(), scene.GetDepths() + size);
  }
  double largest = 0;
  for (std::size_t pixel = 0; pixel < depths[0].size(); ++pixel)
  {
    largest = std::max(largest, std::abs(static_cast<double>(depths[0][pixel]) - depths[1][pixel]));
  }
  EXPECT_LT(largest, 1e-3);
}

} // namespace
