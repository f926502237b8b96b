// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/MeshScene.h"

#include "Mesh/CellVolumes.h"
#include "Walk/MeshRays.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace tetralux
{

void MeshScene::SetMesh(std::shared_ptr<WalkMesh> mesh)
{
  this->Mesh = std::move(mesh);
  this->Scalars.clear();
  this->OtherScalars.clear();
  this->CellsVersion = MakeVersion();
  this->PointsVersion = MakeVersion();
  this->ScalarsVersion = 0;
  this->ColorScalars.clear();
  this->ColorScalarsVersion = 0;
}

bool MeshScene::SetPoints(const std::vector<double>& points)
{
  if (!this->Mesh || !this->Mesh->SetPoints(points))
  {
    return false;
  }
  this->PointsVersion = MakeVersion();
  return true;
}

void MeshScene::SetPointScalars(std::vector<double> scalars)
{
  this->SetScalars(std::move(scalars), false);
}

void MeshScene::SetCellScalars(std::vector<double> scalars)
{
  this->SetScalars(std::move(scalars), true);
}

void MeshScene::SetScalars(std::vector<double> scalars, bool ofCells)
{
  if (!this->Mesh)
  {
    throw std::invalid_argument("the mesh must be set before its scalars");
  }
  const TetrahedralMesh& mesh = this->Mesh->GetMesh();
  const std::size_t expected = ofCells ? mesh.GetNumberOfCells() : mesh.GetNumberOfPoints();
  if (scalars.size() != expected)
  {
    throw std::invalid_argument(std::to_string(scalars.size()) + " scalars were given for " +
      std::to_string(expected) + (ofCells ? " cells" : " points"));
  }
  this->Scalars = std::move(scalars);
  this->OtherScalars.clear();
  this->ScalarsOfCells = ofCells;
  this->ScalarsVersion = MakeVersion();

  bool allFinite = true;
  bool any = false;
  for (double s : this->Scalars)
  {
    if (!std::isfinite(s))
    {
      allFinite = false;
      continue;
    }
    this->ScalarRange[0] = any ? std::min(this->ScalarRange[0], s) : s;
    this->ScalarRange[1] = any ? std::max(this->ScalarRange[1], s) : s;
    any = true;
  }
  if (!any)
  {
    this->ScalarRange[0] = this->ScalarRange[1] = 0;
  }
  this->NumberOfBlankCells = 0;
  if (!allFinite)
  {
    this->CountBlankCells();
  }
}

void MeshScene::SetOtherScalars(std::vector<std::vector<double>> scalars)
{
  for (const std::vector<double>& other : scalars)
  {
    if (other.size() != this->Scalars.size())
    {
      throw std::invalid_argument(std::to_string(other.size()) +
        " further scalars were given for " + std::to_string(this->Scalars.size()));
    }
  }
  this->OtherScalars = std::move(scalars);
  this->ScalarsVersion = MakeVersion();
}

void MeshScene::SetColorScalars(std::vector<double> scalars)
{
  const std::size_t points = this->Mesh ? this->Mesh->GetMesh().GetNumberOfPoints() : 0;
  if (!scalars.empty() && scalars.size() != points)
  {
    throw std::invalid_argument(std::to_string(scalars.size()) +
      " scalars to colour by were given for " + std::to_string(points) + " points");
  }
  this->ColorScalars = std::move(scalars);
  this->ColorScalarsVersion = MakeVersion();
}

void MeshScene::CountBlankCells()
{
  const std::vector<std::int32_t>& cells = this->Mesh->GetMesh().Cells;
  const std::int64_t n = static_cast<std::int64_t>(cells.size() / 4);
  for (std::int64_t t = 0; t < n; ++t)
  {
    const std::int32_t* p = &cells[4 * t];
    const bool finite = this->ScalarsOfCells
      ? std::isfinite(this->Scalars[t])
      : std::all_of(p, p + 4, [this](std::int32_t id) { return std::isfinite(this->Scalars[id]); });
    this->NumberOfBlankCells += !finite;
  }
}

bool MeshScene::IsComplete() const
{
  if (!this->Mesh)
  {
    return false;
  }
  const TetrahedralMesh& mesh = this->Mesh->GetMesh();
  return this->Scalars.size() ==
    (this->ScalarsOfCells ? mesh.GetNumberOfCells() : mesh.GetNumberOfPoints());
}

void MeshScene::PrepareLongestEdge()
{
  this->LongestEdge.Update(CacheKey::Of(this->PointsVersion),
    [this] { return MeasureCells(this->Mesh->GetMesh()).LongestEdge; });
}

void MeshScene::PreparePointGradients()
{
  this->PointGradients.Update(CacheKey::Of(this->PointsVersion, this->ScalarsVersion),
    [this]
    {
      return MakePointGradients(
        this->Mesh->GetMesh(), this->Scalars, this->Mesh->GetRadius(), this->GetGradientUnit());
    });
}

void MeshScene::PrepareCellGradients()
{
  this->CellGradients.Update(CacheKey::Of(this->PointsVersion, this->ScalarsVersion),
    [this]
    {
      return MakeCellGradients(
        this->Mesh->GetMesh(), this->Scalars, this->Mesh->GetRadius(), this->GetGradientUnit());
    });
}

double MeshScene::GetGradientUnit() const
{
  const double range = 0.5 * this->ScalarRange[1] - 0.5 * this->ScalarRange[0];
  return range > 0 ? range : 1;
}

std::shared_ptr<const RaySample> MeshScene::DrawRays(double scale)
{
  this->Rays.Update(CacheKey::Of(this->PointsVersion, this->ScalarsVersion),
    [this]
    {
      return std::make_shared<const RaySample>(
        DrawMeshRays(*this->Mesh, this->Scalars, 1, this->ScalarsOfCells));
    });
  if (scale == 1)
  {
    return this->Rays.Get();
  }
  this->ScaledRays.Update(CacheKey::Of(this->Rays.GetVersion(), scale),
    [&]
    {
      auto scaled = std::make_shared<RaySample>(*this->Rays.Get());
      for (std::vector<RaySegment>& ray : scaled->Rays)
      {
        for (RaySegment& segment : ray)
        {
          segment.Length *= scale;
        }
      }
      return std::shared_ptr<const RaySample>(std::move(scaled));
    });
  return this->ScaledRays.Get();
}

} // namespace tetralux
