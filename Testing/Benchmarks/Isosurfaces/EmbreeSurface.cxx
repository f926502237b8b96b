// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurfaces/EmbreeSurface.h"

#include "Base/ParallelTiles.h"
#include "Isosurfaces/IsosurfaceWay.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetralux
{
namespace
{

constexpr int PacketEdge = 4; ///< pixels
constexpr int PacketSize = PacketEdge * PacketEdge;
constexpr int TileEdge = 16; ///< pixels

/// By how much a ray that goes on, or to the light, begins behind the hit, as a share of its
/// distance: some roundings of single precision, in which hits are.
constexpr float HitMargin = 1e-5f;

struct alignas(64) Packet
{
  RTCRayHit16 Rays;
  int Valid[PacketSize]; ///< -1: yes
};

/// Shares of the light at the hits of a packet, 0..1.
using Shades = std::array<float, PacketSize>;

bool IsHit(const Packet& packet, int i)
{
  return packet.Valid[i] != 0 && packet.Rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
}

void FillPacket(const RayGrid& grid, int x0, int y0, Packet& packet)
{
  RTCRay16& ray = packet.Rays.ray;
  for (int i = 0; i < PacketSize; ++i)
  {
    const int x = x0 + i % PacketEdge;
    const int y = y0 + i / PacketEdge;
    const auto getOrigin = [&](int a) {
      return static_cast<float>(grid.Origin[a] + x * grid.OriginStepX[a] + y * grid.OriginStepY[a]);
    };
    const auto getDirection = [&](int a)
    {
      return static_cast<float>(
        grid.Direction[a] + x * grid.DirectionStepX[a] + y * grid.DirectionStepY[a]);
    };
    ray.org_x[i] = getOrigin(0);
    ray.org_y[i] = getOrigin(1);
    ray.org_z[i] = getOrigin(2);
    ray.dir_x[i] = getDirection(0);
    ray.dir_y[i] = getDirection(1);
    ray.dir_z[i] = getDirection(2);
    ray.tnear[i] = 0;
    ray.tfar[i] = std::numeric_limits<float>::infinity();
    ray.time[i] = 0;
    ray.mask[i] = -1;
    ray.id[i] = 0;
    ray.flags[i] = 0;
    packet.Rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.Rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    packet.Valid[i] = x < grid.Width && y < grid.Height ? -1 : 0;
  }
}

/// Lets rays go on behind their hits; others end.
void ContinueBehindHits(Packet& packet)
{
  RTCRay16& ray = packet.Rays.ray;
  for (int i = 0; i < PacketSize; ++i)
  {
    packet.Valid[i] = IsHit(packet, i) ? -1 : 0;
    ray.tnear[i] = ray.tfar[i] * (1 + HitMargin);
    ray.tfar[i] = std::numeric_limits<float>::infinity();
    packet.Rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
}

RTCIntersectContext MakeContext()
{
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

/// Lambert's law, from both sides.
Shades ShadeHits(RTCScene scene, const EmbreeView& view, const Packet& packet)
{
  const RTCRay16& ray = packet.Rays.ray;
  const RTCHit16& hit = packet.Rays.hit;
  Shades shades;
  alignas(64) RTCRay16 shadow;
  alignas(64) int valid[PacketSize];
  for (int i = 0; i < PacketSize; ++i)
  {
    shadow.org_x[i] = ray.org_x[i] + ray.tfar[i] * ray.dir_x[i];
    shadow.org_y[i] = ray.org_y[i] + ray.tfar[i] * ray.dir_y[i];
    shadow.org_z[i] = ray.org_z[i] + ray.tfar[i] * ray.dir_z[i];
    shadow.dir_x[i] = static_cast<float>(view.Light[0]) - shadow.org_x[i];
    shadow.dir_y[i] = static_cast<float>(view.Light[1]) - shadow.org_y[i];
    shadow.dir_z[i] = static_cast<float>(view.Light[2]) - shadow.org_z[i];
    shadow.tnear[i] = HitMargin; // the light is some radii away
    shadow.tfar[i] = 1;
    shadow.time[i] = 0;
    shadow.mask[i] = -1;
    shadow.id[i] = 0;
    shadow.flags[i] = 0;
    valid[i] = IsHit(packet, i) ? -1 : 0;
    const float product =
      hit.Ng_x[i] * shadow.dir_x[i] + hit.Ng_y[i] * shadow.dir_y[i] + hit.Ng_z[i] * shadow.dir_z[i];
    const float lengths =
      (hit.Ng_x[i] * hit.Ng_x[i] + hit.Ng_y[i] * hit.Ng_y[i] + hit.Ng_z[i] * hit.Ng_z[i]) *
      (shadow.dir_x[i] * shadow.dir_x[i] + shadow.dir_y[i] * shadow.dir_y[i] +
        shadow.dir_z[i] * shadow.dir_z[i]);
    shades[i] = std::abs(product) / std::sqrt(lengths);
  }
  if (view.Shadows)
  {
    RTCIntersectContext context = MakeContext();
    rtcOccluded16(valid, scene, &context, &shadow);
    for (int i = 0; i < PacketSize; ++i)
    {
      shades[i] = shadow.tfar[i] < 0 ? 0 : shades[i]; // how Embree marks what is occluded
    }
  }
  return shades;
}

/// Puts hits behind what their pixels have already.
void AddLayer(const Packet& packet, const Shades& shades, float opacity, int width, int x0, int y0,
  std::vector<float>& rgba)
{
  for (int i = 0; i < PacketSize; ++i)
  {
    if (IsHit(packet, i))
    {
      const std::size_t pixel =
        static_cast<std::size_t>(y0 + i / PacketEdge) * width + x0 + i % PacketEdge;
      float* color = &rgba[4 * pixel];
      const float weight = (1 - color[3]) * opacity;
      color[0] += weight * shades[i];
      color[1] += weight * shades[i];
      color[2] += weight * shades[i];
      color[3] += weight;
    }
  }
}

/// For vtkCellArray::Visit: point ids of all triangles, in their order.
struct CopyCorners
{
  template <class State>
  void operator()(State& state, unsigned int* corners) const
  {
    auto* ids = state.GetConnectivity();
    std::transform(
      ids->Begin(), ids->End(), corners, [](auto id) { return static_cast<unsigned int>(id); });
  }
};

} // namespace

//----------------------------------------------------------------------------
EmbreeSurface::EmbreeSurface(RTCBuildQuality quality, int threads)
  : Quality(quality)
  , Threads(threads)
  , Device(rtcNewDevice(("threads=" + std::to_string(threads)).c_str()))
{
}

EmbreeSurface::~EmbreeSurface()
{
  if (this->Scene)
  {
    rtcReleaseScene(this->Scene);
  }
  rtcReleaseDevice(this->Device);
}

void EmbreeSurface::Build(vtkPolyData* triangles)
{
  if (this->Scene)
  {
    rtcReleaseScene(this->Scene);
  }
  this->Scene = rtcNewScene(this->Device);
  rtcSetSceneBuildQuality(this->Scene, this->Quality);
  const vtkIdType numberOfTriangles = triangles->GetNumberOfPolys();
  if (numberOfTriangles > 0)
  {
    RTCGeometry geometry = rtcNewGeometry(this->Device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, this->Quality);
    auto* points = vtkFloatArray::SafeDownCast(triangles->GetPoints()->GetData());
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX,
      0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), points->GetNumberOfTuples()));
    std::copy_n(points->GetPointer(0), points->GetNumberOfValues(), vertices);
    auto* corners = static_cast<unsigned int*>(rtcSetNewGeometryBuffer(geometry,
      RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned int), numberOfTriangles));
    triangles->GetPolys()->Visit(CopyCorners(), corners);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(this->Scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(this->Scene);
}

void EmbreeSurface::Trace(const EmbreeView& view, std::vector<float>& rgba) const
{
  const RayGrid& grid = view.Rays;
  rgba.assign(4 * static_cast<std::size_t>(grid.Width) * grid.Height, 0);
  const float opacity = view.TwoLayers ? static_cast<float>(LayerOpacity) : 1;
  const auto tracePacket = [&](int x, int y)
  {
    RTCIntersectContext context = MakeContext();
    Packet packet;
    FillPacket(grid, x, y, packet);
    for (int layer = 0; layer < (view.TwoLayers ? 2 : 1); ++layer)
    {
      if (layer > 0)
      {
        ContinueBehindHits(packet);
      }
      rtcIntersect16(packet.Valid, this->Scene, &context, &packet.Rays);
      const Shades shades = ShadeHits(this->Scene, view, packet);
      AddLayer(packet, shades, opacity, grid.Width, x, y, rgba);
    }
  };
  ForEachTile({ grid.Width, grid.Height, TileEdge }, this->Threads, {},
    [&](const Tile& tile, int)
    {
      for (int y = tile.Y0; y < tile.Y1; y += PacketEdge)
      {
        for (int x = tile.X0; x < tile.X1; x += PacketEdge)
        {
          tracePacket(x, y);
        }
      }
    });
}

} // namespace tetralux
