// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_WalkTextures_h
#define tetralux_WalkTextures_h

#include "Base/Cached.h"
#include "Mesh/Gradients.h"
#include "OpenGL/ContextResources.h"
#include "OpenGL/TextureBuffer.h"
#include "TetraluxRenderingModule.h"
#include "Walk/WalkMesh.h"
#include "Walk/WalkTexels.h"

#include <cstddef>
#include <cstdint>
#include <string>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkWindow;

namespace tetralux
{

/// A mesh on the graphics card: 32 bytes a tetrahedron, 16 a point, and about 40 a boundary face
/// for what rays come in by. Belongs to one window's context, the last one.
class TETRALUXRENDERING_EXPORT WalkTextures
{
public:
  WalkTextures();
  ~WalkTextures();

  bool HasFaces(vtkOpenGLRenderWindow* window, const CacheKey& key) const
  {
    return this->Context.Get() == window && this->FacesStamp.Has(key);
  }

  /// Sends what lies behind each face of the cells, unless it is there by this key.
  void UpdateFaces(vtkOpenGLRenderWindow* window, const WalkTables& tables, CacheKey key);

  /// Sends the boundary and the hierarchy over it, unless they are there by this key. positive:
  /// see MakeWalkTexels. Call it after UpdateFaces.
  void UpdateBoundary(vtkOpenGLRenderWindow* window, const WalkTables& tables,
    Span<const std::uint8_t> positive, CacheKey key);

  /// Sends points with their scalars, unless they are there by this key. Call it after
  /// UpdateFaces.
  void UpdatePoints(
    vtkOpenGLRenderWindow* window, Span<const WalkPoint<float>> points, CacheKey key);

  /// Sends gradients at points, unless they are there by this key; padded to the number of points.
  /// To be called after UpdatePoints.
  void UpdateGradients(
    vtkOpenGLRenderWindow* window, Span<const GradientRow> gradients, CacheKey key);

  /// What of a mesh would not fit on the graphics card of a window, one line; empty where all does.
  static std::string FindObstacle(
    vtkOpenGLRenderWindow* window, const WalkTables& tables, std::size_t numberOfPoints);

  /// For a program in use: the arrays that RayEntryFS.glsl, RayLayerFS.glsl or RayWalkFS.glsl
  /// reads, bound to texture units until Deactivate.
  ///@{
  void ActivateForEntry(vtkShaderProgram* program);
  void ActivateForWalk(vtkShaderProgram* program, bool gradients);
  void Deactivate();
  ///@}

  int GetNumberOfEntries() const { return this->NumberOfEntries; }

  /// On the graphics card.
  std::size_t GetNumberOfBytes() const;
  /// Of that, what grows with tetrahedra and points; the rest grows with boundary faces.
  std::size_t GetNumberOfCellAndPointBytes() const
  {
    return this->Faces.GetNumberOfBytes() + this->Points.GetNumberOfBytes();
  }
  /// Sent since the last reset.
  std::size_t GetUploadedBytes() const { return this->UploadedBytes; }
  void ResetUploadedBytes() { this->UploadedBytes = 0; }

  void ReleaseGraphicsResources(vtkWindow* window) { this->Context.Release(window); }

private:
  TextureBuffer Faces, Entries, Boxes, Links, Points, Gradients;
  std::size_t NumberOfPoints = 0;
  int NumberOfNodes = 0;
  int NumberOfEntries = 0;
  CacheStamp FacesStamp;
  CacheStamp BoundaryStamp;
  CacheStamp PointsStamp;
  CacheStamp GradientsStamp;
  std::size_t UploadedBytes = 0;
  ContextResources Context;
};

} // namespace tetralux

#endif
