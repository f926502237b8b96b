// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ImageChecks_h
#define tetralux_ImageChecks_h

// What the image caster refuses. Each check throws std::invalid_argument, with one line that says
// what is wrong.

#include "TriangleCaster/ImageCasterOptions.h"
#include "TriangleCaster/ImageOptics.h"
#include "TriangleCaster/ImageVolume.h"

namespace tetralux
{

/// Whether labels choose functions.
inline bool ShowsLabels(const ImageVolume& volume, const ImageOptics& optics)
{
  return volume.Labels && !optics.Labels.empty();
}

/// Whether colours change with depth.
bool HasCue(const ImageCasterOptions& options);

void CheckVolume(const ImageVolume& volume);
void CheckOptics(const ImageOptics& optics);

/// Whether optics are those of the volume's components.
void CheckMatch(const ImageVolume& volume, const ImageOptics& optics);

/// Whether volume and optics have what the options ask for.
void CheckOptions(
  const ImageVolume& volume, const ImageOptics& optics, const ImageCasterOptions& options);

} // namespace tetralux

#endif
