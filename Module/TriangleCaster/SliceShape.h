// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SliceShape_h
#define tetralux_SliceShape_h

namespace tetralux
{

/// What a volume is cut by (Knittel 1999, sections 1.1 and 2).
enum class SliceShape
{
  Planes, ///< parallel to the plane of the picture: under perspective, oblique rays have longer
          ///< steps
  Shells  ///< spheres around the eye: all rays have the same step. Planes in a parallel projection.
};

} // namespace tetralux

#endif
