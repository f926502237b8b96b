// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GradientVoxels_h
#define tetralux_GradientVoxels_h

#include "Base/RawVector.h"
#include "TriangleCaster/ImageVolume.h"

namespace tetralux
{

/// Gradients at the points of a volume, in 8 bits a component (Knittel 1999, section 7): central
/// differences, one-sided ones at the border. A word of 32 bits a point has, from its lowest byte
/// on, signed components along x, y and z, and for a volume of unsigned bytes the value.
class GradientVoxels
{
public:
  /// The most that a component has.
  static constexpr int Largest = 127;

  /// threads: at least 1. A difference that is not finite counts as 0.
  void Build(const ImageVolume& volume, int threads);

  /// The words, x fastest. They are floats for the kernels, which load floats in pairs; only their
  /// bits mean anything.
  const RawVector<float>& GetWords() const { return this->Words; }

  /// A component of 1 in values for a step to the next point along its axis.
  float GetScale() const { return this->Scale; }

private:
  RawVector<float> Words;
  float Scale = 0;
};

} // namespace tetralux

#endif
