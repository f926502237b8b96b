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

/// Rays of PacketEdge x PacketEdge pixels, row by row, and what they have gathered.
struct alignas(64) Packet
{
  RTCRayHit16 Rays;
  int Valid[PacketSize];   ///< -1: yes
  float Shade[PacketSize]; ///< light, premultiplied with opacity
  float Alpha[PacketSize]; ///< opacity
};

/// Rays in the precision that Embree has.
struct FloatRays
{
  explicit FloatRays(const RayGrid& grid)
    : Width(grid.Width)
    , Height(grid.Height)
  {
    for (int a = 0; a < 3; ++a)
    {
      this->Origin[a] = static_cast<float>(grid.Origin[a]);
      this->OriginX[a] = static_cast<float>(grid.OriginStepX[a]);
      this->OriginY[a] = static_cast<float>(grid.OriginStepY[a]);
      this->Direction[a] = static_cast<float>(grid.Direction[a]);
      this->DirectionX[a] = static_cast<float>(grid.DirectionStepX[a]);
      this->DirectionY[a] = static_cast<float>(grid.DirectionStepY[a]);
    }
  }

  int Width, Height;
  float Origin[3], OriginX[3], OriginY[3];
  float Direction[3], DirectionX[3], DirectionY[3];
};

void FillPacket(const FloatRays& rays, int x0, int y0, Packet& packet)
{
  RTCRay16& ray = packet.Rays.ray;
  float* const origins[3] = { ray.org_x, ray.org_y, ray.org_z };
  float* const directions[3] = { ray.dir_x, ray.dir_y, ray.dir_z };
  alignas(64) float x[PacketSize];
  alignas(64) float y[PacketSize];
  for (int i = 0; i < PacketSize; ++i)
  {
    x[i] = static_cast<float>(x0 + i % PacketEdge);
    y[i] = static_cast<float>(y0 + i / PacketEdge);
  }
  for (int a = 0; a < 3; ++a)
  {
#pragma omp simd
    for (int i = 0; i < PacketSize; ++i)
    {
      origins[a][i] = rays.Origin[a] + x[i] * rays.OriginX[a] + y[i] * rays.OriginY[a];
      directions[a][i] = rays.Direction[a] + x[i] * rays.DirectionX[a] + y[i] * rays.DirectionY[a];
    }
  }
#pragma omp simd
  for (int i = 0; i < PacketSize; ++i)
  {
    ray.tnear[i] = 0;
    ray.tfar[i] = std::numeric_limits<float>::infinity();
    ray.time[i] = 0;
    ray.mask[i] = -1;
    ray.id[i] = 0;
    ray.flags[i] = 0;
    packet.Rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.Rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    packet.Valid[i] =
      x0 + i % PacketEdge < rays.Width && y0 + i / PacketEdge < rays.Height ? -1 : 0;
    packet.Shade[i] = 0;
    packet.Alpha[i] = 0;
  }
}

/// Leaves only rays with a hit valid. Returns whether there are any.
bool KeepHits(Packet& packet)
{
  int any = 0;
#pragma omp simd reduction(| : any)
  for (int i = 0; i < PacketSize; ++i)
  {
    packet.Valid[i] = packet.Rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID ? 0 : packet.Valid[i];
    any |= packet.Valid[i];
  }
  return any != 0;
}

/// Lets rays go on behind their hits.
void ContinueBehindHits(Packet& packet)
{
  RTCRay16& ray = packet.Rays.ray;
#pragma omp simd
  for (int i = 0; i < PacketSize; ++i)
  {
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

/// Puts the hits of valid rays behind what they have gathered, by Lambert's law from both sides,
/// black where the light is on the other side than the viewer.
void ShadeHits(RTCScene scene, const EmbreeView& view, float opacity, Packet& packet)
{
  const RTCRay16& ray = packet.Rays.ray;
  const RTCHit16& hit = packet.Rays.hit;
  const float light[3] = { static_cast<float>(view.Light[0]), static_cast<float>(view.Light[1]),
    static_cast<float>(view.Light[2]) };
  alignas(64) RTCRay16 toLight;
  alignas(64) float shades[PacketSize];
  alignas(64) int isLit[PacketSize]; // -1: yes
#pragma omp simd
  for (int i = 0; i < PacketSize; ++i)
  {
    toLight.org_x[i] = ray.org_x[i] + ray.tfar[i] * ray.dir_x[i];
    toLight.org_y[i] = ray.org_y[i] + ray.tfar[i] * ray.dir_y[i];
    toLight.org_z[i] = ray.org_z[i] + ray.tfar[i] * ray.dir_z[i];
    toLight.dir_x[i] = light[0] - toLight.org_x[i];
    toLight.dir_y[i] = light[1] - toLight.org_y[i];
    toLight.dir_z[i] = light[2] - toLight.org_z[i];
    toLight.tnear[i] = HitMargin; // the light is some radii away
    toLight.tfar[i] = 1;
    toLight.time[i] = 0;
    toLight.mask[i] = -1;
    toLight.id[i] = 0;
    toLight.flags[i] = 0;
    const float product = hit.Ng_x[i] * toLight.dir_x[i] + hit.Ng_y[i] * toLight.dir_y[i] +
      hit.Ng_z[i] * toLight.dir_z[i];
    const float normal =
      hit.Ng_x[i] * hit.Ng_x[i] + hit.Ng_y[i] * hit.Ng_y[i] + hit.Ng_z[i] * hit.Ng_z[i];
    const float distance = toLight.dir_x[i] * toLight.dir_x[i] +
      toLight.dir_y[i] * toLight.dir_y[i] + toLight.dir_z[i] * toLight.dir_z[i];
    const float away =
      hit.Ng_x[i] * ray.dir_x[i] + hit.Ng_y[i] * ray.dir_y[i] + hit.Ng_z[i] * ray.dir_z[i];
    isLit[i] = product * away < 0 ? packet.Valid[i] : 0;
    shades[i] = isLit[i] != 0 ? std::abs(product) / std::sqrt(normal * distance) : 0;
  }
  if (view.Shadows)
  {
    RTCIntersectContext context = MakeContext();
    rtcOccluded16(isLit, scene, &context, &toLight);
#pragma omp simd
    for (int i = 0; i < PacketSize; ++i)
    {
      shades[i] = toLight.tfar[i] < 0 ? 0 : shades[i]; // how Embree marks what is occluded
    }
  }
#pragma omp simd
  for (int i = 0; i < PacketSize; ++i)
  {
    const float weight = packet.Valid[i] != 0 ? (1 - packet.Alpha[i]) * opacity : 0;
    packet.Shade[i] += weight * shades[i];
    packet.Alpha[i] += weight;
  }
}

void StorePacket(const FloatRays& rays, int x0, int y0, const Packet& packet, float* rgba)
{
  const int columns = std::min(PacketEdge, rays.Width - x0);
  const int rows = std::min(PacketEdge, rays.Height - y0);
  for (int row = 0; row < rows; ++row)
  {
    float* color = rgba + 4 * (static_cast<std::size_t>(y0 + row) * rays.Width + x0);
    for (int column = 0; column < columns; ++column, color += 4)
    {
      const int i = row * PacketEdge + column;
      color[0] = color[1] = color[2] = packet.Shade[i];
      color[3] = packet.Alpha[i];
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
  const FloatRays rays(view.Rays);
  rgba.resize(4 * static_cast<std::size_t>(rays.Width) * rays.Height);
  const float opacity = view.TwoLayers ? static_cast<float>(LayerOpacity) : 1;
  const auto tracePacket = [&](int x, int y)
  {
    RTCIntersectContext context = MakeContext();
    Packet packet;
    FillPacket(rays, x, y, packet);
    rtcIntersect16(packet.Valid, this->Scene, &context, &packet.Rays);
    if (KeepHits(packet))
    {
      ShadeHits(this->Scene, view, opacity, packet);
      if (view.TwoLayers)
      {
        ContinueBehindHits(packet);
        rtcIntersect16(packet.Valid, this->Scene, &context, &packet.Rays);
        if (KeepHits(packet))
        {
          ShadeHits(this->Scene, view, opacity, packet);
        }
      }
    }
    StorePacket(rays, x, y, packet, rgba.data());
  };
  ForEachTile({ rays.Width, rays.Height, TileEdge }, this->Threads, {},
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
