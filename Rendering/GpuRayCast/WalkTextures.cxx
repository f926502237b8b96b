// SPDX-License-Identifier: BSD-3-Clause
#include "GpuRayCast/WalkTextures.h"

#include "OpenGL/GraphicsCard.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

#include <utility>
#include <vector>

namespace tetralux
{

WalkTextures::WalkTextures()
  : Context(
      [this](vtkOpenGLRenderWindow* window)
      {
        for (TextureBuffer* buffer : { &this->Points, &this->Faces, &this->Entries, &this->Boxes,
               &this->Links, &this->Gradients })
        {
          buffer->ReleaseGraphicsResources(window);
        }
        for (CacheStamp* stamp :
          { &this->FacesStamp, &this->BoundaryStamp, &this->PointsStamp, &this->GradientsStamp })
        {
          stamp->Reset();
        }
      })
{
}

WalkTextures::~WalkTextures() = default;

void WalkTextures::UpdateFaces(
  vtkOpenGLRenderWindow* window, const WalkTables& tables, CacheKey key)
{
  if (this->HasFaces(window, key))
  {
    return;
  }
  this->Context.Set(window);
  this->FacesStamp.Reset();
  this->Faces.Upload(window, reinterpret_cast<const std::int32_t*>(tables.Faces.data()),
    tables.Faces.size(), 2, "the table of faces");
  this->UploadedBytes += this->Faces.GetNumberOfBytes();
  this->FacesStamp.Set(std::move(key));
}

void WalkTextures::UpdateBoundary(vtkOpenGLRenderWindow* window, const WalkTables& tables,
  Span<const std::uint8_t> positive, CacheKey key)
{
  if (this->BoundaryStamp.Has(key))
  {
    return;
  }
  this->BoundaryStamp.Reset();
  const WalkTexels texels = MakeWalkTexels(tables, positive);
  this->Entries.Upload(
    window, texels.Entries.data(), texels.Entries.size() / 4, 4, "the table of boundary faces");
  this->Boxes.Upload(
    window, texels.Boxes.data(), texels.Boxes.size() / 4, 4, "the hierarchy over the boundary");
  this->Links.Upload(
    window, texels.Links.data(), texels.Links.size() / 2, 2, "the hierarchy over the boundary");
  this->NumberOfNodes = static_cast<int>(texels.Links.size() / 2);
  this->NumberOfEntries = static_cast<int>(tables.Entries.size());
  this->UploadedBytes += this->Entries.GetNumberOfBytes() + this->Boxes.GetNumberOfBytes() +
    this->Links.GetNumberOfBytes();
  this->BoundaryStamp.Set(std::move(key));
}

void WalkTextures::UpdatePoints(
  vtkOpenGLRenderWindow* window, Span<const WalkPoint<float>> points, CacheKey key)
{
  if (this->PointsStamp.Has(key))
  {
    return;
  }
  this->PointsStamp.Reset();
  this->Points.Upload(
    window, reinterpret_cast<const float*>(points.data()), points.size(), 4, "the table of points");
  this->UploadedBytes += this->Points.GetNumberOfBytes();
  this->NumberOfPoints = points.size();
  this->PointsStamp.Set(std::move(key));
}

void WalkTextures::UpdateGradients(
  vtkOpenGLRenderWindow* window, Span<const GradientRow> gradients, CacheKey key)
{
  if (this->GradientsStamp.Has(key))
  {
    return;
  }
  this->GradientsStamp.Reset();
  std::vector<GradientRow> padded(gradients.begin(), gradients.end());
  padded.resize(this->NumberOfPoints, GradientRow{ 0, 0, 0, 0 });
  this->Gradients.Upload(window, &padded.data()->X, padded.size(), 4, "the table of gradients");
  this->UploadedBytes += this->Gradients.GetNumberOfBytes();
  this->GradientsStamp.Set(std::move(key));
}

std::string WalkTextures::FindObstacle(
  vtkOpenGLRenderWindow* window, const WalkTables& tables, std::size_t numberOfPoints)
{
  const auto count = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  return tetralux::FindObstacle(
    { { "faces", count(tables.Faces.size()), 8 }, { "points", count(numberOfPoints), 16 },
      { "boundary faces", count(tables.Entries.size()), 16 },
      { "boxes around boundary faces", count(2 * tables.Bvh.Nodes.size()), 16 },
      { "links between boxes", count(tables.Bvh.Nodes.size()), 8 } },
    DescribeGraphicsCard(window).Limits);
}

void WalkTextures::ActivateForEntry(vtkShaderProgram* program)
{
  this->Points.Activate(program, "walkPoints");
  this->Entries.Activate(program, "boundaryEntries");
  this->Boxes.Activate(program, "boundaryBoxes");
  this->Links.Activate(program, "boundaryLinks");
  program->SetUniformi("numberOfBoundaryNodes", this->NumberOfNodes);
}

void WalkTextures::ActivateForWalk(vtkShaderProgram* program, bool gradients)
{
  this->Points.Activate(program, "walkPoints");
  this->Faces.Activate(program, "walkFaces");
  if (gradients)
  {
    this->Gradients.Activate(program, "pointGradients");
  }
  this->Entries.Activate(program, "boundaryEntries");
}

void WalkTextures::Deactivate()
{
  for (TextureBuffer* buffer :
    { &this->Points, &this->Faces, &this->Entries, &this->Boxes, &this->Links, &this->Gradients })
  {
    buffer->Deactivate();
  }
}

std::size_t WalkTextures::GetNumberOfBytes() const
{
  return this->Points.GetNumberOfBytes() + this->Faces.GetNumberOfBytes() +
    this->Entries.GetNumberOfBytes() + this->Boxes.GetNumberOfBytes() +
    this->Links.GetNumberOfBytes() + this->Gradients.GetNumberOfBytes();
}

} // namespace tetralux
