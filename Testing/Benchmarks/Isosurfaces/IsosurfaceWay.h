// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_IsosurfaceWay_h
#define tetralux_IsosurfaceWay_h

#include "vtkType.h"

#include <string>

namespace tetralux
{

/// What changes from frame to frame, or what a frame shows beside the surface itself.
enum class IsosurfaceCase
{
  SameView,    ///< nothing changes
  NewIsovalue, ///< each frame has another isovalue than the one before
  NewStep,     ///< each frame has another array of scalars than the one before
  Shadows,     ///< nothing changes; the light casts shadows
  TwoLayers    ///< nothing changes; two translucent layers of the surface
};

/// Opacity of the surface with TwoLayers.
constexpr double LayerOpacity = 0.5;

/// Seconds of a frame.
struct IsosurfaceTimes
{
  double Extract = 0; ///< triangles of the surface
  double Build = 0;   ///< a hierarchy over the triangles
  double Draw = 0;    ///< the picture, with all that is not in the other two

  double GetSum() const { return this->Extract + this->Build + this->Draw; }
};

/// A way to draw an isosurface of a scene's grid. What is new in the grid, a way finds out by
/// itself: its active scalars are replaced by another array.
class IsosurfaceWay
{
public:
  IsosurfaceWay() = default;
  IsosurfaceWay(const IsosurfaceWay&) = delete;
  IsosurfaceWay& operator=(const IsosurfaceWay&) = delete;
  virtual ~IsosurfaceWay() = default;

  virtual std::string GetName() const = 0;

  virtual bool Takes(IsosurfaceCase which) const = 0;

  /// The case of all frames from now on; one that the way takes.
  virtual void SetCase(IsosurfaceCase which) = 0;

  virtual void SetIsovalue(double isovalue) = 0;

  /// Draws until the picture is there.
  virtual IsosurfaceTimes DrawFrame() = 0;

  /// Triangles of the last frame; 0: it has none.
  virtual vtkIdType GetNumberOfTriangles() const { return 0; }

  /// Pixels of the last frame that show the surface.
  virtual vtkIdType CountCoveredPixels() = 0;
};

} // namespace tetralux

#endif
