// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferenceRenderer_h
#define tetralux_ReferenceRenderer_h

#include "Base/Span.h"
#include "Optics/OpticalModel.h"
#include "Optics/TransferFunction.h"
#include "ReferenceMesh.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace tetralux
{

/// What rays gather. A transfer function alone stands for emission and absorption.
struct ReferenceOptics
{
  ReferenceOptics() = default;
  ReferenceOptics(TransferFunction function, OpticalModel model = OpticalModel::EmissionAbsorption)
    : Function(std::move(function))
    , Model(model)
  {
  }

  TransferFunction Function; ///< of all models but Isosurfaces
  OpticalModel Model = OpticalModel::EmissionAbsorption;

  /// Of the model Isosurfaces: strictly ascending in Value.
  std::vector<Isosurface> Isosurfaces;

  /// Whether lights shine on surfaces, and on what emits and absorbs: there the light of every
  /// point of the ray, and nothing is clamped.
  bool Shaded = false;
  bool SmoothShading = false; ///< by means of the cells' gradients at points, weighted by volume
  Material Surface;
  std::vector<Light> Lights;
};

struct ReferenceImage
{
  std::vector<double> Rgba; ///< premultiplied, four for each pixel, lower row first

  /// World distance along the ray to the nearest contribution; -1: nowhere. That is where the
  /// attenuation first is more than zero, where the largest scalar is met first, if its opacity is
  /// more than zero, or the first surface whose opacity is.
  /// Negative behind the begin of the ray, which only planes of the limits cut off.
  std::vector<double> Depth;

  /// World length of the ray inside the cells, after all limits; of cells that overlap, of each.
  std::vector<double> Length;

  std::int64_t NumberOfSegments = 0; ///< cells that rays passed through, before the limits
};

/// The oracle for every other method: each ray is clipped by every tetrahedron on its own, in
/// extended precision; nothing is known about neighbours but the ids of their points, nothing is
/// tabulated, no ray ends early.
/// See ReferenceIntegral.h for the integral over a segment, ReferenceShading.h for lit surfaces.
///
/// - Cells with point ids out of range, with infinite or undefined coordinates or scalars add
///   nothing; cells of zero volume add nothing. Duplicated cells count twice: clean a mesh first.
/// - A ray exactly through a vertex, an edge or a face is taken as a ray that passes it at an
///   infinitesimal distance, always on the same side. So each point of a ray in a conforming mesh
///   is in exactly one cell; a ray along the outer boundary is either inside or outside.
/// - Segments composite in the order in which the ray goes through the cells. A ray goes through
///   connected cells (cells that share faces) until it leaves them, then comes in at the next
///   boundary face, in the order of the entries' distances. Parts that overlap thus contribute
///   each, one after the other, in the order in which the ray enters them. See ReferenceRuns.h. The
///   parts of a ray that cropping keeps come one after the other.
/// - A ray in a cropping plane belongs to the middle region, as in VTK.
/// - A surface is met in a cell where the scalar is below its value at one end of what is kept of
///   the ray there, and not below it at the other: one that lies in faces of the mesh is met once.
///
/// pixels: Width x Height, other than 0 where a pixel is wanted; empty: all. Unwanted pixels stay
/// empty. The picture does not depend on the number of threads.
/// Throws std::invalid_argument where sizes do not fit together, and for Isosurfaces of cell
/// scalars.
ReferenceImage RenderReference(const ReferenceMesh& mesh, const ReferenceOptics& optics,
  const RayGrid& rays, const RayLimits& limits = {}, Span<const std::uint8_t> pixels = {});

} // namespace tetralux

#endif
