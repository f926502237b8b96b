// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SlabTable_h
#define tetralux_SlabTable_h

#include "PreIntegration/PreIntegrationTable.h"
#include "TetraluxCoreModule.h"
#include "TriangleCaster/ImageOptics.h"

namespace tetralux
{

/// What a slab between two slices adds, over the scalars at its front and at its back, between
/// which the scalar is taken to run linearly (Knittel 1999, section 7; Engel et al. 2001): a plane
/// of a PreIntegrationTable. Slabs of other lengths are looked up as this one, and their
/// opacity follows from its optical depth.
class TETRALUXCORE_EXPORT SlabTable
{
public:
  /// Texels along each scalar: one a value of 8-bit data, and 1 MiB in all.
  static constexpr int Size = 256;

  /// slabLength: world units. range: smallest and largest scalar of the volume. The table's
  /// own slabs have the nearest length out of four an octave, within a tenth: a table serves
  /// distances that change a little, and does not depend on those that came before. Does nothing
  /// where nothing changed but the length, and not that of the table. Throws as
  /// BuildPreIntegrationTable.
  void Update(const ImageOptics& optics, double slabLength, const double (&range)[2]);

  /// To be called when optics or range change.
  void Invalidate() { this->Length = 0; }

  /// Size x Size texels of four floats, front scalar fastest: premultiplied colour and opacity.
  const float* GetTexels() const { return this->Texels; }
  double GetLength() const { return this->Length; } ///< of its slabs, world units

  /// The texel of a scalar s, between 0 and Size - 1: scale s + offset.
  ///@{
  double GetScale() const { return this->Scale; }
  double GetOffset() const { return this->Offset; }
  ///@}

private:
  PreIntegrationTable Table;
  const float* Texels = nullptr;
  double Length = 0; ///< 0: there is no table
  double Scale = 1;
  double Offset = 0;
};

} // namespace tetralux

#endif
