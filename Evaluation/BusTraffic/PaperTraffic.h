// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PaperTraffic_h
#define tetralux_PaperTraffic_h

// What Knittel 1999 measured: the scenes of its section 5, and its tables.

#include "Base/Span.h"
#include "BusTraffic/TrafficFrame.h"
#include "BusTraffic/TrafficSimulator.h"

#include <string>
#include <vector>

namespace tetralux
{

enum class TrafficOpacity
{
  Any, ///< rays do not end early, so all opacities have the same traffic
  Opaque,
  Translucent
};

/// A volume as the paper shows it. The paper gives neither the camera nor the threshold of the hull
/// nor the opacities. All of them are fitted: view and threshold to the numbers of planes,
/// S-triangles, P-triangles, raypoints, pixels read and written, and misses of both orders without
/// early ends; the opacities to the P-triangles that are left with early ends.
struct PaperScene
{
  std::string Name;
  std::string FileName;
  TrafficView View;
  double VolumeSize = 256; ///< largest number of points along an axis, that the view is for
  int HullThreshold = 0;   ///< as of MakeTrafficFrame
  OpacityTable Opaque;
  OpacityTable Translucent;
  int Planes = 0; ///< that the paper counts
};

constexpr double PaperPlaneDistance = 0.75; ///< voxels
constexpr int PaperSize = 256;              ///< of most pictures, pixels along an edge

PaperScene MakePaperBrain();
PaperScene MakePaperEngine();

/// A row of table 2 (order of S-triangles) or 3 (order of planes). Counts::Pixels is not among the
/// paper's columns, and in table 3 neither are P- and S-triangles; they are 0.
struct PaperRow
{
  std::string Scene; ///< PaperScene::Name
  TrafficOrder Order = TrafficOrder::Triangles;
  int Size = PaperSize;
  int CacheBytes = 1 << 10;
  bool EndTriangles = false;
  TrafficOpacity Opacity = TrafficOpacity::Any;
  TrafficCounts Counts;
};

/// All rows of tables 2 and 3.
std::vector<PaperRow> MakePaperRows();

/// Table 1: millions of triangles a second at 10 frames a second, if all planes cover all of a
/// picture and tiles have 8 x 8 pixels.
double GetTriangleRate(int planes, int size);

} // namespace tetralux

#endif
