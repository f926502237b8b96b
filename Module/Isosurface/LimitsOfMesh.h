// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LimitsOfMesh_h
#define tetralux_LimitsOfMesh_h

#include "Isosurface/RayFrame.h"
#include "Isosurface/TraceInput.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <algorithm>
#include <array>
#include <vector>

namespace tetralux
{

/// Half-spaces and cropping in the mesh's frame, with the memory of the planes.
class LimitsOfMesh
{
public:
  LimitsOfMesh(const RayLimits& limits, const RayGrid& grid, const RayFrame& frame,
    const MeshFrame& mesh, const std::vector<MinMaxTree::Node>& nodes)
  {
    const double* steps[3] = { frame.Parallel ? grid.OriginStepX : grid.DirectionStepX,
      frame.Parallel ? grid.OriginStepY : grid.DirectionStepY, grid.Direction };
    const auto dot = [](const double* a, const double* b)
    { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    for (std::size_t p = 0; p < limits.Planes.size(); ++p)
    {
      const std::array<double, 4>& plane = limits.Planes[p];
      std::array<double, 4> result = { 0, 0, 0, dot(plane.data(), grid.Origin) + plane[3] };
      for (int r = 0; r < 3; ++r)
      {
        const double along = dot(plane.data(), steps[r]);
        for (int a = 0; a < 4; ++a)
        {
          result[a] += along * frame.Rows[r][a];
        }
      }
      if (!KeepsAll(result, nodes))
      {
        this->Planes.push_back(result);
        this->NumberOfCameraPlanes += p < static_cast<std::size_t>(limits.NumberOfCameraPlanes);
      }
    }
    this->Result.Cropping = limits.Cropping;
    this->Result.CroppingFlags = limits.CroppingFlags;
    for (int i = 0; i < 6; ++i)
    {
      this->Result.CroppingPlanes[i] =
        (limits.CroppingPlanes[i] - mesh.Center[i / 2]) / mesh.Radius;
    }
  }
  LimitsOfMesh(const LimitsOfMesh&) = delete;
  LimitsOfMesh& operator=(const LimitsOfMesh&) = delete;

  TraceLimits Get() const
  {
    TraceLimits result = this->Result;
    static_assert(sizeof(std::array<double, 4>) == sizeof(double[4]), "rows of four");
    result.Planes = reinterpret_cast<const double(*)[4]>(this->Planes.data());
    result.NumberOfPlanes = static_cast<int>(this->Planes.size());
    return result;
  }

  /// The same for light: without the camera's planes.
  TraceLimits GetForLight() const
  {
    TraceLimits result = this->Get();
    result.Planes += this->NumberOfCameraPlanes;
    result.NumberOfPlanes -= this->NumberOfCameraPlanes;
    return result;
  }

private:
  /// Whether a half-space holds the whole mesh: the box of the first node.
  static bool KeepsAll(
    const std::array<double, 4>& plane, const std::vector<MinMaxTree::Node>& nodes)
  {
    double least = plane[3];
    for (int a = 0; a < 3 && !nodes.empty(); ++a)
    {
      const MinMaxTree::Node& box = nodes.front();
      least += std::min(plane[a] * box.Lower[a], plane[a] * box.Upper[a]);
    }
    return nodes.empty() || least > 0;
  }

  std::vector<std::array<double, 4>> Planes;
  int NumberOfCameraPlanes = 0;
  TraceLimits Result;
};

} // namespace tetralux

#endif
