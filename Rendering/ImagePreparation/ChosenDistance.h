// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ChosenDistance_h
#define tetralux_ChosenDistance_h

#include "Base/Cached.h"
#include "TriangleCaster/ImageCaster.h"
#include "TriangleCaster/ImageCasterOptions.h"
#include "View/RayGrid.h"
#include "View/RayLimits.h"

namespace tetralux
{

/// What ChooseSampleDistance returned last, for as long as nothing changes that it depends on.
class ChosenDistance
{
public:
  /// Brings the distance up to date; returns whether it was chosen anew. As ChooseSampleDistance.
  bool Update(ImageCaster& caster, const RayGrid& grid, const RayLimits& limits,
    const ImageCasterOptions& options, double maximumError);

  double Get() const { return this->Distance.Get(); }

  /// To be called when the caster has another volume or other optics.
  void Reset() { this->Distance.Reset(); }

private:
  Cached<double> Distance;
};

} // namespace tetralux

#endif
