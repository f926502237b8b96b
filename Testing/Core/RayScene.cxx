// SPDX-License-Identifier: BSD-3-Clause
#include "RayScene.h"
#include "ReferenceGrazing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace tetralux
{

RayLimits RayScene::GetLimits() const
{
  RayLimits limits = this->Limits;
  limits.MaximumDistances =
    this->MaximumDistances.empty() ? nullptr : this->MaximumDistances.data();
  return limits;
}

ReferenceMesh RayScene::GetReferenceMesh() const
{
  return { this->Mesh.Points, this->Mesh.Cells, this->Scalars, this->CellScalars };
}

ReferenceOptics RayScene::GetReferenceOptics() const
{
  ReferenceOptics optics(this->Function, this->Model);
  optics.Isosurfaces = this->Isosurfaces;
  optics.Shaded = this->Shaded;
  optics.SmoothShading = this->SmoothShading;
  optics.Lights = this->Lights;
  return optics;
}

ReferenceImage RayScene::RenderReference() const
{
  return tetralux::RenderReference(
    this->GetReferenceMesh(), this->GetReferenceOptics(), this->Grid, this->GetLimits());
}

std::vector<double> RayScene::MeasureGrazing(
  const ReferenceImage& image, Span<const std::uint8_t> pixels) const
{
  return tetralux::MeasureGrazing(this->GetReferenceMesh(), this->GetReferenceOptics(), this->Grid,
    this->GetLimits(), image, pixels);
}

VolumeScene RayScene::MakeVolumeScene() const
{
  VolumeScene volume;
  const auto walkMesh = std::make_shared<WalkMesh>(this->Mesh);
  volume.Mesh.SetMesh(walkMesh);
  const TetrahedralMesh& mesh = walkMesh->GetMesh();
  const auto& originals = this->CellScalars ? mesh.OriginalCells : mesh.OriginalPoints;
  std::vector<double> scalars;
  scalars.reserve(originals.size());
  for (const std::int64_t id : originals)
  {
    scalars.push_back(this->Scalars[id]);
  }
  if (this->CellScalars)
  {
    volume.Mesh.SetCellScalars(std::move(scalars));
  }
  else
  {
    volume.Mesh.SetPointScalars(std::move(scalars));
  }
  volume.Optics.SetTransferFunction(this->Function);
  volume.Optics.SetModel(this->Model);
  volume.Optics.SetIsosurfaces(this->Isosurfaces);
  return volume;
}

std::optional<InstructionSet> ChooseKernels(bool portable)
{
  return portable ? std::optional<InstructionSet>(InstructionSet::Generic) : std::nullopt;
}

RayPicture Cast(VolumeScene& volume, const RayScene& scene, const RayCastOptions& options)
{
  const std::size_t pixels = static_cast<std::size_t>(scene.Grid.Width) * scene.Grid.Height;
  RayPicture picture;
  // Whatever is not written is noticed.
  picture.Colors.assign(4 * pixels, std::numeric_limits<float>::quiet_NaN());
  picture.Depths.assign(pixels, std::numeric_limits<float>::quiet_NaN());
  RayCastOptions lit = options;
  lit.Shaded = scene.Shaded;
  lit.SmoothShading = scene.SmoothShading;
  lit.Lights = scene.Lights;
  picture.Statistics =
    CastRays(volume, scene.Grid, scene.GetLimits(), lit, picture.Colors, picture.Depths);
  return picture;
}

std::vector<double> MakeSmoothField(const TetrahedralMesh& mesh)
{
  double lo[3], hi[3];
  std::fill_n(lo, 3, std::numeric_limits<double>::infinity());
  std::fill_n(hi, 3, -std::numeric_limits<double>::infinity());
  const std::size_t numberOfPoints = mesh.GetNumberOfPoints();
  for (std::size_t i = 0; i < 3 * numberOfPoints; ++i)
  {
    lo[i % 3] = std::min(lo[i % 3], mesh.Points[i]);
    hi[i % 3] = std::max(hi[i % 3], mesh.Points[i]);
  }
  std::vector<double> field(numberOfPoints);
  for (std::size_t p = 0; p < numberOfPoints; ++p)
  {
    double x[3];
    for (int a = 0; a < 3; ++a)
    {
      x[a] = (mesh.Points[3 * p + a] - lo[a]) / (hi[a] - lo[a]);
    }
    field[p] = 0.5 + 0.25 * std::sin(5 * x[0] + 2 * x[1]) * std::cos(4 * x[2] - x[0]) +
      0.25 * std::sin(3 * x[1] + 7 * x[2] * x[0]);
  }
  return field;
}

TransferFunction MakeColorfulFunction(double largestAttenuation)
{
  const double k = largestAttenuation;
  return MakeLinearFunction(
    { { 0.1, 0, 0, 1, 0 }, { 0.3, 0, 1, 1, 0.1 * k }, { 0.35, 0, 1, 1, 0 }, { 0.45, 1, 0, 1, 0 },
      { 0.6, 0, 1, 0, 0.5 * k }, { 0.7, 1, 1, 0, 0.05 * k }, { 0.95, 1, 0, 0, k } });
}

} // namespace tetralux
