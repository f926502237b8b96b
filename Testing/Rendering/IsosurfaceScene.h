// SPDX-License-Identifier: BSD-3-Clause
#ifndef IsosurfaceScene_h
#define IsosurfaceScene_h

#include "Generate/GeneratedMesh.h"
#include "RayCastScene.h"

#include "vtkTetrahedraIsosurfaceMapper.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// Of a channel: what is composited and shaded in single precision.
constexpr double Rounding = 1e-5;

/// Traced isosurfaces of a box, one translucent and one opaque, and the ray caster's beside them.
class IsosurfaceScene : public RayCastScene
{
public:
  explicit IsosurfaceScene(int width = 96, int height = 72);

  /// Values and opacities, in ascending order.
  void SetSurfaces(const std::map<double, double>& surfaces);

  /// Shows another mesh, with surfaces at quarters of its range.
  void Show(const tetralux::GeneratedMesh& mesh);

  /// A copy of the colours, which the next frame leaves alone.
  std::vector<float> Render();

  /// The ray caster's picture of the same.
  std::vector<float> RenderByRays();

  /// Expects that no screen shows a difference between the two.
  void ExpectPictureOfRays(const std::string& name);

  void AddSphere(const Vector& center, double radius);

  /// Turns Shade on, with a distant light alone, which shines from there to the box's middle.
  void SetLight(const Vector& position);

  /// Where the depth buffer of the window says that a pixel of the viewport has its point, in world
  /// coordinates; false where it is empty.
  bool FindWindowPoint(int i, int j, double (&x)[3]);

  /// Where the mapper's picture, of one ray a pixel, says that it is.
  bool FindPicturePoint(int i, int j, double (&x)[3]);

  /// Pixels of the mapper's viewport in which the depth buffer is not empty.
  std::int64_t CountWindowDepths();

  /// A member of a section of the statistics of the last frame, as JSON in one line.
  std::string Get(const char* section, const char* name);

  vtkNew<vtkTetrahedraIsosurfaceMapper> Tracer;

private:
  void FindPoint(int i, int j, double depth, double (&x)[3]);
};

/// The largest amount by which a channel of one picture is above that of another.
double FindLargestExcess(const std::vector<float>& a, const std::vector<float>& b);

double Sum(const std::vector<float>& values);

#endif
