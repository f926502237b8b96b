// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayTargets_h
#define tetralux_RayTargets_h

#include "OpenGL/ContextResources.h"
#include "TetraluxRenderingModule.h"

#include "vtkNew.h"

#include <cstddef>
#include <cstdint>
#include <string>

class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace tetralux
{

class FloatTarget;

/// What rays of a band have come to between passes, twice, so that a pass reads the one and writes
/// the other (Weiler et al. 2003, section 5.1), and the depth buffer that keeps out the rays that
/// are done. What no ray reads again is kept once only, in a RayPicture. Belongs to one window's
/// context, the last one.
class TETRALUXRENDERING_EXPORT RayTargets
{
public:
  /// The textures of a set, see RayWalkFS.glsl.
  enum Texture
  {
    States, ///< two integers, packed as RayStatesDec.glsl says
    Sums,   ///< two floats
    NumberOfTextures
  };

  RayTargets();
  ~RayTargets();
  RayTargets(const RayTargets&) = delete;
  RayTargets& operator=(const RayTargets&) = delete;

  /// What packed states have room for; more boundary faces than MakeWalkTexels has.
  static constexpr int MostDisplacements = 16;
  static constexpr int MostParts = 4;
  static constexpr int MostFaces = (1 << 28) - 2; ///< of tetrahedra, four each

  /// Why the states of rays have no room for a mesh: one line; empty where they have.
  static std::string FindObstacle(std::int64_t tetrahedra);

  /// Bytes that are needed for each pixel of a band.
  static std::size_t GetPixelSize(bool layers);

  /// Makes the textures of a band, unless they are there already. layers: whether OfLayer can be
  /// drawn into. Throws OutOfGraphicsMemory, and std::runtime_error, with one line, where the
  /// graphics card cannot draw into such ones.
  void Prepare(vtkOpenGLRenderWindow* window, int width, int rows, bool layers);

  /// For all that follows up to EndDrawing, the frame buffers and the viewport that were set before
  /// are set aside.
  ///@{
  void BeginDrawing();
  void EndDrawing();
  ///@}

  /// The band that is drawn next: pictures of a RayPicture, not larger than what was prepared.
  void SetBand(const FloatTarget& band);

  /// What can be drawn into: the sets with all pictures of the band, the texture of entries that
  /// rays come in by next, and the band's colours; each with the depth buffer; and that texture
  /// with a depth buffer of its own. Nothing that is drawn into may be read.
  enum Framebuffer
  {
    OfSet0,
    OfSet1,
    OfNextEntries,
    OfColors,
    OfLayer,
    NumberOfFramebuffers
  };

  void DrawInto(int framebuffer);

  /// An empty layer: no entry, farthest depth.
  void ClearLayer();

  /// The first set and the band's pictures as they are before the first pass, no ray done. largest:
  /// whether the first sum is the largest scalar; else opacity.
  void Clear(bool largest);

  /// What is drawn into the pictures of the band by a pass is added to them, as RayWalkFS.glsl
  /// says. The blending function has to be set back by the caller.
  ///@{
  void BeginAdding();
  void EndAdding();
  ///@}

  vtkTextureObject* GetTexture(int set, Texture texture) const
  {
    return this->Textures[set][texture];
  }
  vtkTextureObject* GetNextEntries() const { return this->NextEntries; }

  std::size_t GetNumberOfBytes() const;

  void ReleaseGraphicsResources(vtkWindow* window) { this->Context.Release(window); }

private:
  void Allocate(vtkOpenGLRenderWindow* window, int width, int rows, bool layers);

  unsigned int Framebuffers[NumberOfFramebuffers] = { 0, 0, 0, 0, 0 };
  int NumberOfPictures = 0; ///< of the band
  vtkNew<vtkTextureObject> Textures[2][NumberOfTextures];
  vtkNew<vtkTextureObject> NextEntries;
  vtkNew<vtkTextureObject> Depth;
  vtkNew<vtkTextureObject> LayerDepth;
  int Size[2] = { 0, 0 };
  bool Layers = false;
  int Viewport[4] = { 0, 0, 0, 0 }; ///< of others
  ContextResources Context;
};

} // namespace tetralux

#endif
