// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PlacedTree_h
#define tetralux_PlacedTree_h

namespace tetralux
{

/// What the rays of a frame see of a node or of a polygon: its least u and v, minus its largest u
/// and v, and minus its largest key, rounded outward; the rest is 0. All are infinite where no ray
/// hits anything.
struct alignas(32) PlacedBounds
{
  float Values[8];
};

/// A TraceTree of isopolygons as the rays of one frame see it: each polygon is prepared once for
/// all packets, and boxes are rectangles of u and v.
struct PlacedTree
{
  PlacedBounds* Nodes;
  PlacedBounds* Bounds; ///< of the polygons
  void* Polygons;       ///< PlacedPolygonBytes each: what the kernel keeps of them
};

/// Bytes of what a kernel keeps of a polygon, at most.
constexpr int PlacedPolygonBytes = 256;

} // namespace tetralux

#endif
