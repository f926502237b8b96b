// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FloatTarget_h
#define tetralux_FloatTarget_h

#include "Base/Span.h"
#include "OpenGL/ContextResources.h"
#include "TetraluxRenderingModule.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace tetralux
{

/// What a channel of a picture on the graphics card is stored as.
enum class ChannelFormat
{
  UNorm8, ///< 0..255 for 0..1
  Half,   ///< IEEE 754 binary16
  Float   ///< IEEE 754 binary32
};

/// Pictures on the graphics card to draw into: one or several textures of the same size, and a
/// depth and stencil buffer where one is asked for. Belongs to one window's context, the last one.
class TETRALUXRENDERING_EXPORT FloatTarget
{
public:
  struct Picture
  {
    int Components = 4; ///< 1, 2 or 4
    ChannelFormat Format = ChannelFormat::Float;
    bool operator==(const Picture& other) const
    {
      return this->Components == other.Components && this->Format == other.Format;
    }
  };

  struct Settings
  {
    int Width = 1;
    int Height = 1;
    /// What the shader's gl_FragData has, in its order.
    std::vector<Picture> Pictures = std::vector<Picture>(1);
    /// 24 bits of depth, 8 of stencil.
    bool DepthStencil = false;
    bool operator==(const Settings& other) const
    {
      return this->Width == other.Width && this->Height == other.Height &&
        this->Pictures == other.Pictures && this->DepthStencil == other.DepthStencil;
    }
  };

  FloatTarget();
  ~FloatTarget();
  FloatTarget(const FloatTarget&) = delete;
  FloatTarget& operator=(const FloatTarget&) = delete;

  /// Makes the pictures, unless they are there already; what they show is then undefined. Throws
  /// OutOfGraphicsMemory, and std::runtime_error, with one line, where the graphics card cannot
  /// draw into such ones.
  void Prepare(vtkOpenGLRenderWindow* window, const Settings& settings);

  const Settings& GetSettings() const { return this->Made; }
  std::size_t GetNumberOfBytes() const;

  /// While one lives, drawing goes into the pictures, all of each, and reading comes from them. The
  /// frame buffers and the viewport that were set before are set again when it ends.
  class TETRALUXRENDERING_EXPORT Use
  {
  public:
    explicit Use(FloatTarget& target);
    ~Use();
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

    /// Of the first pictures, so many; all at first.
    void DrawInto(int numberOfPictures);

  private:
    FloatTarget& Target;
    int Viewport[4];
  };

  /// To be read by shaders; not while it is drawn into.
  vtkTextureObject* GetTexture(int picture) const;

  /// Copies a picture, lower row first, into width x height x components values. Leaves OpenGL's
  /// state as it was.
  void Read(int picture, Span<float> values);

  void ReleaseGraphicsResources(vtkWindow* window) { this->Context.Release(window); }

private:
  void Allocate(vtkOpenGLRenderWindow* window, const Settings& settings);

  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  std::vector<vtkSmartPointer<vtkTextureObject>> Textures;
  vtkSmartPointer<vtkTextureObject> DepthTexture;
  Settings Made;
  ContextResources Context;
};

} // namespace tetralux

#endif
