// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_StudyCase_h
#define tetralux_StudyCase_h

#include "ComparisonMeshes.h"
#include "Isosurface/IsosurfaceTracer.h"
#include "Mesh/TetrahedralMesh.h"
#include "Scene/VolumeScene.h"
#include "Walk/WalkMesh.h"

#include <memory>
#include <string>
#include <vector>

namespace tetralux
{

/// A mesh that pictures are made of, shared by all cases.
struct StudyMesh
{
  std::shared_ptr<WalkMesh> Mesh;
  std::vector<double> Scalars; ///< of its points, in its order
  double Isovalue;
  double SecondIsovalue;
};

/// scalars: of the points of the mesh.
StudyMesh MakeStudyMesh(
  TetrahedralMesh mesh, const std::vector<double>& scalars, double isovalue, double second);

/// count^3 copies of a mesh side by side, each with points and cells of its own.
ComparisonMesh MakeCopies(const ComparisonMesh& mesh, int count);

/// What is beside what the tracer draws by default: one opaque surface, lit by gradients of cells.
struct StudySettings
{
  std::string Name;
  IsosurfaceOptions Options;
  bool SecondSurface = false;
  bool ColorArray = false;
  bool ClipPlane = false; ///< through the middle; what has smaller x is away
  bool ClipBox = false;   ///< the eighth of the mesh that is next to the camera is away
  bool WindowDepths = false;
  float Opacity = 1;
};

/// A setting with all that a tracer keeps from frame to frame.
class StudyCase
{
public:
  /// size: pixels along an edge. zoom: 1 shows the whole bounding sphere.
  StudyCase(const StudyMesh& mesh, const StudySettings& settings, int size, double zoom);

  const std::string& GetName() const { return this->Name; }
  const RayGrid& GetGrid() const { return this->Grid; }

  /// Seconds of a frame in memory.
  double DrawFrame();
  const IsosurfaceStatistics& GetStatistics() const { return this->Statistics; }

private:
  std::string Name;
  IsosurfaceOptions Options;
  VolumeScene Scene;
  RayGrid Grid;
  RayLimits Limits;
  IsosurfaceTracer Tracer;
  std::vector<float> Colors, Depths, WindowDepths;
  IsosurfaceStatistics Statistics;
};

using StudyCases = std::vector<std::unique_ptr<StudyCase>>;

/// Median seconds of a frame of each case. They take turns; the first frame, which makes what is
/// kept, is left out.
std::vector<double> MeasureFrames(const StudyCases& cases, int frames);

double FindMedian(std::vector<double> values);

} // namespace tetralux

#endif
