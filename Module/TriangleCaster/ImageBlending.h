// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageBlending_h
#define tetralux_ImageBlending_h

#include "TriangleCaster/ImageKernel.h"
#include "TriangleCaster/ImageOptics.h"
#include "TriangleCaster/ImageVolume.h"

#include <vector>

namespace tetralux
{

/// What SurfaceLookup points to.
struct SurfaceTable
{
  struct alignas(16) Optics
  {
    float Color[3], Opacity;
  };
  std::vector<float> Bounds;
  std::vector<Optics> Rows;
};

/// Throws std::invalid_argument, with one line, if the blend mode's own values are not valid.
void CheckBlending(const ImageOptics& optics);

/// Fills what kernels know of the blend mode, but for the plane of slices. surfaces must stay as
/// long as in.
void FillBlending(const ImageVolume& volume, const ImageOptics& optics, SurfaceTable& surfaces,
  ImageKernelInput& in);

} // namespace tetralux

#endif
