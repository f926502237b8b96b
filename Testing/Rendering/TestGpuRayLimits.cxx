// SPDX-License-Identifier: BSD-3-Clause
// Rays and their limits in shaders against those in double precision.

#include "Frame/CameraRays.h"
#include "Frame/OpaqueEnds.h"
#include "GlslEvaluator.h"
#include "GpuRayCast/GpuRayLimits.h"
#include "OpenGLSnapshot.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkPolyDataMapper.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{

using Arguments = GlslEvaluator::Arguments;
using Result = GlslEvaluator::Result;
using Vector = std::array<double, 3>;

struct Interval
{
  double Begin, End;
};

/// A ray in double precision, and what limits keep of it: by sampling regions between sorted cuts.
struct ReferenceRay
{
  Vector Origin, Direction;         ///< in the world
  Vector MeshOrigin, MeshDirection; ///< of the mesh's coordinates, for a world unit

  ReferenceRay(const tetralux::RayGrid& grid, int i, int j)
  {
    double length = 0;
    for (int a = 0; a < 3; ++a)
    {
      this->Origin[a] = grid.Origin[a] + i * grid.OriginStepX[a] + j * grid.OriginStepY[a];
      this->Direction[a] =
        grid.Direction[a] + i * grid.DirectionStepX[a] + j * grid.DirectionStepY[a];
      length = std::hypot(length, this->Direction[a]);
    }
    for (double& component : this->Direction)
    {
      component /= length;
    }
    for (int a = 0; a < 3; ++a)
    {
      const double* row = grid.MeshFromWorld[a];
      this->MeshOrigin[a] = row[3];
      this->MeshDirection[a] = 0;
      for (int b = 0; b < 3; ++b)
      {
        this->MeshOrigin[a] += row[b] * this->Origin[b];
        this->MeshDirection[a] += row[b] * this->Direction[b];
      }
    }
  }

  std::vector<Interval> GetParts(const tetralux::RayLimits& limits, double farthest) const
  {
    double begin = -1e300;
    double end = farthest;
    for (const auto& plane : limits.Planes)
    {
      double height = plane[3];
      double slope = 0;
      for (int a = 0; a < 3; ++a)
      {
        height += plane[a] * this->Origin[a];
        slope += plane[a] * this->Direction[a];
      }
      (slope > 0 ? begin : end) =
        slope > 0 ? std::max(begin, -height / slope) : std::min(end, -height / slope);
    }
    std::vector<double> cuts = { begin, end };
    if (limits.Cropping)
    {
      for (int p = 0; p < 6; ++p)
      {
        const double t =
          (limits.CroppingPlanes[p] - this->MeshOrigin[p / 2]) / this->MeshDirection[p / 2];
        if (begin < t && t < end)
        {
          cuts.push_back(t);
        }
      }
    }
    std::sort(cuts.begin(), cuts.end());
    std::vector<Interval> parts;
    for (std::size_t k = 0; k + 1 < cuts.size() && begin < end; ++k)
    {
      const double middle = 0.5 * (cuts[k] + cuts[k + 1]);
      int region = 0;
      int weight = 1;
      for (int a = 0; a < 3; ++a, weight *= 3)
      {
        const double x = this->MeshOrigin[a] + middle * this->MeshDirection[a];
        region +=
          weight * ((x >= limits.CroppingPlanes[2 * a]) + (x >= limits.CroppingPlanes[2 * a + 1]));
      }
      if (limits.Cropping && !((limits.CroppingFlags >> region) & 1u))
      {
        continue;
      }
      if (!parts.empty() && parts.back().End == cuts[k])
      {
        parts.back().End = cuts[k + 1];
      }
      else
      {
        parts.push_back({ cuts[k], cuts[k + 1] });
      }
    }
    return parts;
  }
};

class GpuRayLimitsTest : public testing::Test
{
public:
  void SetUp() override
  {
    this->Evaluator.Window->SetSize(40, 30);
    vtkCamera* camera = this->Evaluator.Renderer->GetActiveCamera();
    camera->SetPosition(4, 3, 9);
    camera->SetFocalPoint(0.3, 0.2, 0.1);
    camera->SetClippingRange(0.5, 40);
  }

  void Draw()
  {
    this->Evaluator.Window->Render();
    this->Evaluator.Window->GetRenderFramebuffer()->Bind();
  }

  std::vector<float> ReadDistances(const tetralux::CameraRays& rays)
  {
    return tetralux::FindOpaqueDistances(
      rays, tetralux::ReadOpaqueDepths(this->Opaque, this->Evaluator.Window, rays));
  }

  /// An opaque ball, in front of a part of the mesh.
  void AddBall()
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(this->Center.data());
    sphere->SetRadius(0.7 * this->Radius);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(sphere->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Evaluator.Renderer->AddActor(actor);
  }

  /// All parts of all rays within a tolerance, in radii of the mesh in the world.
  void Expect(bool opaque, double tolerance = 2e-6, double sampleDistance = 1)
  {
    this->Draw();
    const tetralux::CameraRays rays(this->Evaluator.Renderer, sampleDistance);
    tetralux::RayGrid grid = rays.GetGrid();
    std::copy_n(&this->MeshFromWorld[0][0], 12, &grid.MeshFromWorld[0][0]);
    tetralux::RayLimits limits = this->Limits;
    rays.AddClippingRange(limits);
    const std::vector<float> distances = opaque ? this->ReadDistances(rays) : std::vector<float>();
    const OpenGLSnapshot before = TakeOpenGLSnapshot(this->Evaluator.Window);
    const tetralux::GpuRayLimits::OpaqueGeometry geometry = { rays.GetDepthPlaces(),
      rays.GetVisible(), {} };
    this->GpuLimits.Update(this->Evaluator.Window, grid, limits, opaque ? &geometry : nullptr,
      this->Center.data(), this->Radius);
    EXPECT_EQ(FindDifferences(before, TakeOpenGLSnapshot(this->Evaluator.Window)), "");

    std::vector<Arguments> cases;
    for (int j = 0; j < grid.Height; ++j)
    {
      for (int i = 0; i < grid.Width; ++i)
      {
        cases.push_back({ i + 0.5f, j + 0.5f });
      }
    }
    const auto evaluate = [&](const std::string& expression)
    {
      return this->Evaluator.Evaluate(
        this->GpuLimits.GetDeclarations(), expression, cases,
        [this](vtkShaderProgram* program) { this->GpuLimits.Activate(program); },
        [this] { this->GpuLimits.Deactivate(); });
    };
    std::vector<std::vector<Result>> parts;
    for (int part = 0; part < this->GpuLimits.GetNumberOfParts(); ++part)
    {
      parts.push_back(evaluate("vec4(GetRayPart(GetRay(a.xy), a.xy, " + std::to_string(part) +
        "), GetRay(a.xy).Distance, 0.0) * rayLengthUnit"));
    }
    EXPECT_EQ(FindDifferences(before, TakeOpenGLSnapshot(this->Evaluator.Window)), "");
    double worst = 0;
    std::size_t kept = 0;
    std::size_t limited = 0;
    for (std::size_t pixel = 0; pixel < cases.size(); ++pixel)
    {
      const int i = static_cast<int>(pixel) % grid.Width;
      const int j = static_cast<int>(pixel) / grid.Width;
      const double farthest =
        distances.empty() ? std::numeric_limits<double>::infinity() : distances[pixel];
      limited += std::isfinite(farthest);
      std::vector<Interval> expected = ReferenceRay(grid, i, j).GetParts(limits, farthest);
      // What is too short for single precision may be there or not.
      const auto isShort = [&](const Interval& part)
      { return part.End - part.Begin < 2 * tolerance * this->WorldRadius; };
      const bool anyShort = std::any_of(expected.begin(), expected.end(), isShort);
      if (anyShort)
      {
        continue;
      }
      kept += expected.size();
      for (std::size_t part = 0; part < parts.size(); ++part)
      {
        const Result& result = parts[part][pixel];
        if (part >= expected.size())
        {
          EXPECT_GE(result[0], result[1]) << i << " " << j << " part " << part;
          continue;
        }
        const double begin = static_cast<double>(result[0]) + result[2];
        const double end = static_cast<double>(result[1]) + result[2];
        worst = std::max({ worst, std::abs(begin - expected[part].Begin) / this->WorldRadius,
          std::abs(end - expected[part].End) / this->WorldRadius });
      }
      EXPECT_LE(expected.size(), parts.size());
    }
    std::cout << "error " << worst << " radii, " << kept << " parts, " << limited
              << " rays end at geometry\n";
    EXPECT_LE(worst, tolerance);
    EXPECT_GT(kept, cases.size() / 4);
    EXPECT_EQ(limited > 0, opaque);
  }

  GlslEvaluator Evaluator;
  tetralux::GpuRayLimits GpuLimits;
  tetralux::OpaqueDepth Opaque;
  tetralux::RayLimits Limits;
  Vector Center = { 0.3, 0.2, 0.1 };
  double Radius = 1.5;
  double WorldRadius = 1.5;
  double MeshFromWorld[3][4] = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } };
};

TEST_F(GpuRayLimitsTest, NearAndFarPlane)
{
  this->Evaluator.Renderer->GetActiveCamera()->SetClippingRange(8, 12);
  this->Expect(false);
}

TEST_F(GpuRayLimitsTest, ParallelProjection)
{
  this->Evaluator.Renderer->GetActiveCamera()->ParallelProjectionOn();
  this->Evaluator.Renderer->GetActiveCamera()->SetParallelScale(2);
  this->Evaluator.Renderer->GetActiveCamera()->SetClippingRange(8, 12);
  this->Limits.Planes.push_back({ 0.3, -0.8, 0.1, 0.2 });
  this->Expect(false);
}

TEST_F(GpuRayLimitsTest, ClippingPlanes)
{
  this->Limits.Planes = { { 1, 0.2, 0.1, 0.3 }, { -0.3, 1, 0.2, 0.4 }, { 0.1, 0.2, -1, 0.9 } };
  this->Expect(false, 1e-5); // the far plane is at 30 radii
}

TEST_F(GpuRayLimitsTest, CroppingOfOneRegion)
{
  this->Limits.Cropping = true;
  const double planes[6] = { -0.5, 0.9, -0.4, 0.8, -0.6, 0.7 };
  std::copy_n(planes, 6, this->Limits.CroppingPlanes);
  this->Evaluator.Renderer->GetActiveCamera()->SetViewAngle(12);
  this->Expect(false);
}

TEST_F(GpuRayLimitsTest, CroppingOfManyRegions)
{
  this->Limits.Cropping = true;
  const double planes[6] = { -0.5, 0.9, -0.4, 0.8, -0.6, 0.7 };
  std::copy_n(planes, 6, this->Limits.CroppingPlanes);
  this->Evaluator.Renderer->GetActiveCamera()->SetClippingRange(6, 14);
  for (const std::uint32_t flags : { 0x5555555u, 0x2aaaaaau, 0x7ebfdffu, 0x7ffffffu })
  {
    this->Limits.CroppingFlags = flags;
    this->Expect(false, 5e-6);
  }
}

TEST_F(GpuRayLimitsTest, OpaqueGeometry)
{
  this->AddBall();
  this->Evaluator.Renderer->GetActiveCamera()->SetClippingRange(5, 14);
  this->Expect(true);
}

TEST_F(GpuRayLimitsTest, OpaqueGeometryOfALargeClippingRange)
{
  this->AddBall();
  this->Evaluator.Renderer->GetActiveCamera()->SetClippingRange(0.01, 14);
  // Three steps of the depth buffer, each 3e-4: depths are rounded to single precision.
  this->Expect(true, 1e-3);
}

TEST_F(GpuRayLimitsTest, OpaqueGeometryWithFewerRays)
{
  this->AddBall();
  this->Evaluator.Renderer->GetActiveCamera()->SetClippingRange(5, 14);
  this->Expect(true, 2e-6, 2.5);
}

TEST_F(GpuRayLimitsTest, OpaqueGeometryInAViewportAndParallel)
{
  this->AddBall();
  this->Evaluator.Renderer->SetViewport(0.25, 0.1, 0.9, 1);
  this->Evaluator.Renderer->GetActiveCamera()->SetClippingRange(5, 14);
  this->Evaluator.Renderer->GetActiveCamera()->ParallelProjectionOn();
  this->Evaluator.Renderer->GetActiveCamera()->SetParallelScale(2);
  this->Expect(true);
}

TEST_F(GpuRayLimitsTest, OpaqueGeometryOfAMultisampledWindow)
{
  this->AddBall();
  this->Evaluator.Window->SetMultiSamples(4);
  this->Evaluator.Renderer->GetActiveCamera()->SetClippingRange(5, 14);
  this->Draw();
  const tetralux::CameraRays rays(this->Evaluator.Renderer, 1);
  const std::vector<float> distances = this->ReadDistances(rays);
  this->Draw();
  const tetralux::GpuRayLimits::OpaqueGeometry geometry = { rays.GetDepthPlaces(),
    rays.GetVisible(), {} };
  this->GpuLimits.Update(this->Evaluator.Window, rays.GetGrid(), this->Limits, &geometry,
    this->Center.data(), this->Radius);
  std::vector<Arguments> cases;
  for (int pixel = 0; pixel < 40 * 30; ++pixel)
  {
    cases.push_back({ pixel % 40 + 0.5f, pixel / 40 + 0.5f });
  }
  const std::vector<Result> results = this->Evaluator.Evaluate(
    this->GpuLimits.GetDeclarations(),
    "vec4(GetRayPart(GetRay(a.xy), a.xy, 0), GetRay(a.xy).Distance, 0.0) * rayLengthUnit", cases,
    [this](vtkShaderProgram* program) { this->GpuLimits.Activate(program); },
    [this] { this->GpuLimits.Deactivate(); });
  std::size_t differing = 0;
  std::size_t limited = 0;
  for (std::size_t pixel = 0; pixel < cases.size(); ++pixel)
  {
    const bool ends = results[pixel][1] < 1e30f;
    limited += ends;
    differing += ends != std::isfinite(distances[pixel]) ||
      (ends && std::abs(results[pixel][1] + results[pixel][2] - distances[pixel]) > 1e-3);
  }
  EXPECT_GT(limited, 50u);
  EXPECT_LE(differing, 0u); // resolved alike
}

TEST_F(GpuRayLimitsTest, FarFromTheOriginWithTheMeshTurnedAndStretched)
{
  // A mesh of 1e-3 at 1e3, its coordinates turned by 90 degrees and doubled.
  const double x = 1000;
  const double rows[3][4] = { { 0, 2, 0, 1 }, { -2, 0, 0, -3 }, { 0, 0, 2, 5 } };
  std::copy_n(&rows[0][0], 12, &this->MeshFromWorld[0][0]);
  const Vector center = { x, 0.5 * x, -x };
  this->Center = { 2 * center[1] + 1, -2 * center[0] - 3, 2 * center[2] + 5 };
  this->Radius = 2e-3;
  this->WorldRadius = 1e-3;
  vtkCamera* camera = this->Evaluator.Renderer->GetActiveCamera();
  camera->SetFocalPoint(center.data());
  camera->SetPosition(center[0] + 3e-3, center[1] + 4e-3, center[2] + 2e-3);
  camera->SetClippingRange(3e-3, 8e-3);
  this->Limits.Cropping = true;
  for (int a = 0; a < 3; ++a)
  {
    this->Limits.CroppingPlanes[2 * a] = this->Center[a] - 0.4e-3 * (a + 1);
    this->Limits.CroppingPlanes[2 * a + 1] = this->Center[a] + 0.7e-3;
  }
  this->Limits.CroppingFlags = 0x5555555u;
  this->Expect(false, 1e-5);
}

TEST_F(GpuRayLimitsTest, InAnyUnitOfLength)
{
  const Vector center = this->Center;
  for (const double unit : { 1e-19, 3.1e21, 1e30 })
  {
    SCOPED_TRACE(unit);
    this->Radius = this->WorldRadius = 1.5 * unit;
    vtkCamera* camera = this->Evaluator.Renderer->GetActiveCamera();
    camera->SetPosition(4 * unit, 3 * unit, 9 * unit);
    camera->SetFocalPoint(0.3 * unit, 0.2 * unit, 0.1 * unit);
    camera->SetClippingRange(8 * unit, 11 * unit);
    this->Limits.Cropping = true;
    for (int a = 0; a < 3; ++a)
    {
      this->Center[a] = unit * center[a];
      this->Limits.CroppingPlanes[2 * a] = this->Center[a] - 0.4 * unit;
      this->Limits.CroppingPlanes[2 * a + 1] = this->Center[a] + 0.7 * unit;
    }
    this->Limits.CroppingFlags = 0x5555555u;
    this->Expect(false, 1e-5);
  }
}

TEST_F(GpuRayLimitsTest, FromInsideTheMesh)
{
  vtkCamera* camera = this->Evaluator.Renderer->GetActiveCamera();
  camera->SetPosition(this->Center[0] + 0.2, this->Center[1], this->Center[2] + 0.1);
  camera->SetFocalPoint(0, 2, 0);
  camera->SetViewAngle(80);
  camera->SetClippingRange(0.01, 4);
  this->Limits.Cropping = true;
  const double planes[6] = { -0.5, 0.9, -0.4, 0.8, -0.6, 0.7 };
  std::copy_n(planes, 6, this->Limits.CroppingPlanes);
  this->Limits.CroppingFlags = 0x2aaaaaau;
  this->Expect(false, 1e-5);
}

} // namespace
