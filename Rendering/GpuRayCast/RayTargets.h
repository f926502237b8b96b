// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayTargets_h
#define tetralux_RayTargets_h

#include "TetraluxRenderingModule.h"

#include "vtkNew.h"
#include "vtkWeakPointer.h"

#include <cstddef>

class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace tetralux
{

/// What rays have come to between passes, twice, so that a pass reads the one and writes the other
/// (Weiler et al. 2003, section 5.1), and the depth buffer that keeps out the rays that are done.
/// Belongs to one window's context, the last one.
class TETRALUXRENDERING_EXPORT RayTargets
{
public:
  /// The textures of a set, see RayWalkFS.glsl.
  enum Texture
  {
    States,  ///< four integers
    Entries, ///< four integers
    Colors,  ///< four floats
    Firsts,  ///< four floats
    NumberOfTextures
  };

  RayTargets();
  ~RayTargets();
  RayTargets(const RayTargets&) = delete;
  RayTargets& operator=(const RayTargets&) = delete;

  /// Makes the textures, unless they are there already. Throws std::runtime_error, with one line,
  /// where the graphics card cannot draw into such ones.
  void Prepare(vtkOpenGLRenderWindow* window, int width, int height);

  /// For all that follows up to EndDrawing, the frame buffers and the viewport that were set before
  /// are set aside.
  ///@{
  void BeginDrawing();
  void EndDrawing();
  ///@}

  /// What can be drawn into: the sets, the texture of entries that rays come in by next, and
  /// nothing; each with the depth buffer; and that texture with a depth buffer of its own. Nothing
  /// that is drawn into may be read.
  enum Framebuffer
  {
    OfSet0,
    OfSet1,
    OfNextEntries,
    OfDepth,
    OfLayer,
    NumberOfFramebuffers
  };

  void DrawInto(int framebuffer);

  /// An empty layer: no entry, farthest depth.
  void ClearLayer();

  /// Both sets as they are before the first pass, no ray done.
  void Clear(float firstColor);

  vtkTextureObject* GetTexture(int set, Texture texture) const
  {
    return this->Textures[set][texture];
  }
  vtkTextureObject* GetNextEntries() const { return this->NextEntries; }

  std::size_t GetNumberOfBytes() const;

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void Allocate(vtkOpenGLRenderWindow* window, int width, int height);

  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  unsigned int Framebuffers[NumberOfFramebuffers] = { 0, 0, 0, 0, 0 };
  vtkNew<vtkTextureObject> Textures[2][NumberOfTextures];
  vtkNew<vtkTextureObject> NextEntries;
  vtkNew<vtkTextureObject> Depth;
  vtkNew<vtkTextureObject> LayerDepth;
  int Size[2] = { 0, 0 };
  int Viewport[4] = { 0, 0, 0, 0 }; ///< of others
};

} // namespace tetralux

#endif
