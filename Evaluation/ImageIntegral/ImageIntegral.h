// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageIntegral_h
#define tetralux_ImageIntegral_h

#include "TriangleCaster/ImageOptics.h"
#include "TriangleCaster/ImageVolume.h"
#include "View/RayGrid.h"

#include <vector>

namespace tetralux
{

/// What ImageIntegral is off by in a channel, at most: quadrature in double precision, and rays end
/// where less than a tenth of it can be added.
constexpr double ImageIntegralError = 1e-7;

/// The picture that ImageCaster approaches as the distance of slices goes to 0: the integral of
/// emission and absorption along each ray through the trilinear field, in double precision. In each
/// cell the scalar along a ray is a cubic polynomial; stretches are divided where it meets a node
/// of the function, and halved until Gauss-Legendre on both halves agrees with that on the whole.
/// The attenuation is a / UnitDistance, or for StepOpacity::Power -ln(1 - a) / UnitDistance. Cells
/// with a value that is not finite are empty.
///
/// Returns four channels a pixel: premultiplied red, green, blue and opacity, lowest row first.
/// grid.MeshFromWorld leads to indices of points. The pixels do not depend on the number of
/// threads; 0: as many as OpenMP offers.
///
/// Throws std::invalid_argument, with one line, for what is not such an integral: several
/// components, labels, masks or flags, gradient opacity, tables and blend modes other than
/// ImageBlend::Composite.
std::vector<double> IntegrateImage(
  const ImageVolume& volume, const ImageOptics& optics, const RayGrid& grid, int threads);

} // namespace tetralux

#endif
