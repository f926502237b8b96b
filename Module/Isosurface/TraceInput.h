// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_TraceInput_h
#define tetralux_TraceInput_h

// What the kernels of the isosurface tracer read and count: plain pointers.

#include "Hierarchy/MinMaxTree.h"
#include "Isosurface/Isopolygon.h"
#include "Isosurface/RayFrame.h"
#include "Isosurface/RayPacket.h"

#include <cstdint>

namespace tetralux
{

/// Which part of space has surfaces, in the mesh's frame.
struct TraceLimits
{
  /// Half-spaces (a, b, c, d): what has a x + b y + c z + d >= 0 is kept. None of them keeps the
  /// whole mesh.
  const double (*Planes)[4] = nullptr;
  int NumberOfPlanes = 0;

  /// As in RayLimits.
  ///@{
  bool Cropping = false;
  double CroppingPlanes[6] = { 0, 0, 0, 0, 0, 0 };
  std::uint32_t CroppingFlags = 0;
  ///@}
};

/// What packets are traced through: a hierarchy, over isopolygons that are there already (an
/// ActiveTree), or over the cells that they are made of as a packet meets them.
struct TraceTree
{
  const MinMaxTree::Node* Nodes; ///< nullptr: there is nothing to hit
  const Isopolygon* Polygons;    ///< of the leaves; nullptr: they are made of cells

  // Where polygons are made of cells.
  const MinMaxTree::Range* Ranges; ///< one a node
  const std::int32_t* LeafCells;   ///< MinMaxTree::Cells
  const std::int32_t* ValueSteps;  ///< MinMaxRanges::GetStep of each value
  IsopolygonSource Source;
};

/// What packets did, in the terms of table 4 of Wald et al. 2007.
struct TraceCounts
{
  std::int64_t Packets = 0;
  std::int64_t RangeTests = 0;      ///< nodes whose range was looked at
  std::int64_t NodeTests = 0;       ///< nodes that were tested against a packet's frustum
  std::int64_t NodeMisses = 0;      ///< of them, those that the frustum misses
  std::int64_t Polygons = 0;        ///< tested against the frustum of a packet, or of a block
  std::int64_t PolygonMisses = 0;   ///< of them, those that the frustum misses
  std::int64_t PolygonCovers = 0;   ///< of them, those that cover the whole packet
  std::int64_t Extractions = 0;     ///< isopolygons made of cells
  std::int64_t RayPolygonTests = 0; ///< LaneCount for each chunk

  void Add(const TraceCounts& other)
  {
    this->Packets += other.Packets;
    this->RangeTests += other.RangeTests;
    this->NodeTests += other.NodeTests;
    this->NodeMisses += other.NodeMisses;
    this->Polygons += other.Polygons;
    this->PolygonMisses += other.PolygonMisses;
    this->PolygonCovers += other.PolygonCovers;
    this->Extractions += other.Extractions;
    this->RayPolygonTests += other.RayPolygonTests;
  }
};

} // namespace tetralux

#endif
