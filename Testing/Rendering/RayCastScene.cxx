// SPDX-License-Identifier: BSD-3-Clause
#include "RayCastScene.h"

#include "ReferenceGrazing.h"
#include "ReferenceRenderer.h"
#include "ReferenceScenes.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace
{

/// Per channel, absolute.
constexpr double ColorTolerance = 1e-4;

/// Of a channel: an estimate holds for cameras anywhere, so it may be more than a picture needs.
constexpr double LargestEstimate = 4 * ColorTolerance;

/// Of a distance, in sizes of the box: where a ray enters is found in single precision.
constexpr double DepthTolerance = 1e-5;

} // namespace

void ExpectSamePicture(const std::vector<float>& picture, const std::vector<float>& expected,
  double tolerance, const char* name)
{
  SCOPED_TRACE(name);
  ASSERT_EQ(picture.size(), expected.size());
  double largest = 0;
  double covered = 0;
  for (std::size_t c = 0; c < picture.size(); ++c)
  {
    largest = std::max(largest, std::abs(static_cast<double>(picture[c]) - expected[c]));
    covered = std::max(covered, static_cast<double>(expected[c]));
  }
  EXPECT_GT(covered, 0.1);
  EXPECT_LE(largest, tolerance);
}

RayCastScene::RayCastScene(int width, int height, const Vector& lower, double size)
  : Lower(lower)
  , Size(size)
{
  this->Mesh =
    tetralux::MakeBox(5, 4, 3, lower, { lower[0] + size, lower[1] + size, lower[2] + size }, 0.15);
  this->Scalars = MakeField(this->Mesh, lower, size);
  this->Grid = MakeGrid(this->Mesh, this->Scalars);
  this->Use(this->Mapper);
  // Pictures do not depend on how fast the machine is.
  this->Mapper->AutoAdjustSampleDistancesOff();

  // Scalar, red, green, blue, opacity.
  const std::vector<std::array<double, 5>> nodes = { { -0.9, 0.1, 0.2, 0.9, 0.05 },
    { -0.2, 0.2, 0.9, 0.5, 0.3 }, { 0.1, 1, 0.9, 0.1, 0.1 }, { 0.7, 1, 0.2, 0, 0.9 } };
  const double unitDistance = 0.25 * size;
  std::vector<std::array<double, 5>> linear;
  for (const auto& node : nodes)
  {
    this->Color->AddRGBPoint(node[0], node[1], node[2], node[3]);
    this->Opacity->AddPoint(node[0], node[4]);
    linear.push_back({ node[0], node[1], node[2], node[3], node[4] / unitDistance });
  }
  this->Function = tetralux::MakeLinearFunction(linear);
  this->Volume->GetProperty()->SetColor(this->Color);
  this->Volume->GetProperty()->SetScalarOpacity(this->Opacity);
  this->Volume->GetProperty()->SetScalarOpacityUnitDistance(unitDistance);

  this->Renderer->AddVolume(this->Volume);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(width, height);
  this->Window->AddRenderer(this->Renderer);
  this->SetCamera({ 1.9, 1.4, 2.6 }, { 0.5, 0.5, 0.5 }, { 0.1, 1, 0 });
}

void RayCastScene::Use(vtkTetrahedraVolumeMapper* mapper)
{
  mapper->SetInputData(this->Grid);
  this->Volume->SetMapper(mapper);
  this->Used = mapper;
}

Vector RayCastScene::ToWorld(const Vector& x) const
{
  return { this->Lower[0] + this->Size * x[0], this->Lower[1] + this->Size * x[1],
    this->Lower[2] + this->Size * x[2] };
}

void RayCastScene::SetCamera(const Vector& position, const Vector& focalPoint, const Vector& viewUp,
  double nearDistance, double farDistance)
{
  this->Position = this->ToWorld(position);
  this->FocalPoint = this->ToWorld(focalPoint);
  this->ViewUp = viewUp;
  this->NearDistance = nearDistance * this->Size;
  this->FarDistance = farDistance * this->Size;
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  // Only its direction counts, and vtkCamera moves a focal point that is nearer than 1e-20.
  Vector direction;
  vtkMath::Subtract(this->FocalPoint.data(), this->Position.data(), direction.data());
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  const double factor = std::max(1., 1e-19 / length);
  camera->SetPosition(this->Position.data());
  camera->SetFocalPoint(this->Position[0] + factor * direction[0],
    this->Position[1] + factor * direction[1], this->Position[2] + factor * direction[2]);
  camera->SetViewUp(viewUp.data());
  camera->SetViewAngle(this->ViewAngle);
  camera->SetParallelProjection(this->Parallel);
  camera->SetParallelScale(this->ParallelScale * this->Size);
  camera->SetClippingRange(this->NearDistance, this->FarDistance);
}

tetralux::RayGrid RayCastScene::MakeReferenceRays(int width, int height) const
{
  return this->Parallel ? tetralux::MakeParallelGrid(this->Position, this->FocalPoint, this->ViewUp,
                            this->ParallelScale * this->Size, width, height)
                        : tetralux::MakePerspectiveGrid(this->Position, this->FocalPoint,
                            this->ViewUp, this->ViewAngle, width, height);
}

tetralux::RayLimits RayCastScene::MakeReferenceLimits() const
{
  tetralux::RayLimits limits;
  tetralux::AddClippingRange(
    limits, this->Position, this->FocalPoint, this->NearDistance, this->FarDistance);
  return limits;
}

const float* RayCastScene::GetColors() const
{
  return vtkFloatArray::SafeDownCast(this->Used->GetOutputImage()->GetPointData()->GetArray("RGBA"))
    ->GetPointer(0);
}

const float* RayCastScene::GetDepths() const
{
  return vtkFloatArray::SafeDownCast(
    this->Used->GetOutputImage()->GetPointData()->GetArray("Depth"))
    ->GetPointer(0);
}

void RayCastScene::ExpectReference()
{
  const int* size = this->Window->GetActualSize();
  this->ExpectReference(this->MakeReferenceRays(size[0], size[1]), this->MakeReferenceLimits());
}

void RayCastScene::ExpectReference(const tetralux::RayGrid& rays, const tetralux::RayLimits& limits)
{
  this->Window->Render();
  const int* dimensions = this->Used->GetOutputImage()->GetDimensions();
  ASSERT_EQ(dimensions[0], rays.Width);
  ASSERT_EQ(dimensions[1], rays.Height);

  const tetralux::ReferenceMesh mesh{ this->Mesh.Points, this->Mesh.Cells, this->Scalars,
    this->CellScalars };
  const tetralux::ReferenceImage reference =
    tetralux::RenderReference(mesh, this->Function, rays, limits);
  const std::vector<double> grazing =
    tetralux::MeasureGrazing(mesh, this->Function, rays, limits, reference);
  const std::size_t pixels = reference.Depth.size();
  const tetralux::ImageComparison comparison =
    tetralux::CompareWithReference({ this->GetColors(), 4 * pixels }, reference.Rgba, grazing);
  std::cout << comparison;

  // The scene is there, most of it is compared, and it is right.
  EXPECT_GT(comparison.Covered.NumberOfPixels, pixels / 20);
  EXPECT_GT(comparison.Ungrazed.NumberOfPixels, 0.7 * comparison.Covered.NumberOfPixels);
  EXPECT_LE(comparison.Ungrazed.Maximum, ColorTolerance);
  EXPECT_GE(this->Used->GetErrorEstimate(), comparison.Ungrazed.Maximum);
  EXPECT_LE(this->Used->GetErrorEstimate(), LargestEstimate);

  double largestDepthError = 0;
  std::size_t unequal = 0;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
  {
    if (grazing[pixel] <= tetralux::GrazingThreshold)
    {
      const double depth = this->GetDepths()[pixel];
      unequal += (depth == -1) != (reference.Depth[pixel] == -1);
      largestDepthError =
        std::max(largestDepthError, std::abs(depth - reference.Depth[pixel]) / this->Size);
    }
  }
  EXPECT_EQ(unequal, 0u);
  EXPECT_LE(largestDepthError, DepthTolerance);
}
