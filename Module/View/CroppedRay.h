// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_CroppedRay_h
#define tetralux_CroppedRay_h

#include <cstdint>

namespace tetralux
{

/// The most parts that six cropping planes can leave of a ray.
constexpr int MostCroppedParts = 4;

/// The parts of a ray that the 27 regions of RayLimits keep.
struct CroppedRay
{
  int Count = 0;
  double Begin[MostCroppedParts], End[MostCroppedParts]; ///< ascending
};

/// Cuts [begin, end] of the ray origin + t direction. Either end may be infinite. A point on a
/// plane belongs to the region above it.
inline CroppedRay CropRay(const double (&planes)[6], std::uint32_t flags, const double (&origin)[3],
  const double (&direction)[3], double begin, double end)
{
  // Where the ray crosses the planes, ascending.
  double cuts[8];
  int n = 0;
  cuts[n++] = begin;
  for (int p = 0; p < 6; ++p)
  {
    const int a = p / 2;
    const double t = (planes[p] - origin[a]) / direction[a];
    if (begin < t && t < end)
    {
      int i = n++;
      for (; i > 1 && cuts[i - 1] > t; --i)
      {
        cuts[i] = cuts[i - 1];
      }
      cuts[i] = t;
    }
  }
  cuts[n] = end;
  CroppedRay parts;
  bool open = false;
  for (int i = 0; i < n; ++i)
  {
    if (!(cuts[i] < cuts[i + 1]))
    {
      continue;
    }
    // The region of the middle; beyond the largest number there is no middle, but also no mesh.
    constexpr double Far = 1e150;
    const double lo = cuts[i] > -Far ? cuts[i] : -Far;
    const double hi = cuts[i + 1] < Far ? cuts[i + 1] : Far;
    const double t = lo + 0.5 * (hi - lo);
    int region = 0;
    int weight = 1;
    for (int a = 0; a < 3; ++a)
    {
      const double x = origin[a] + t * direction[a];
      region += weight * ((x >= planes[2 * a] ? 1 : 0) + (x >= planes[2 * a + 1] ? 1 : 0));
      weight *= 3;
    }
    if ((flags >> region & 1u) == 0)
    {
      open = false;
    }
    else if (open)
    {
      parts.End[parts.Count - 1] = cuts[i + 1];
    }
    else if (parts.Count < MostCroppedParts)
    {
      open = true;
      parts.Begin[parts.Count] = cuts[i];
      parts.End[parts.Count++] = cuts[i + 1];
    }
  }
  return parts;
}

} // namespace tetralux

#endif
