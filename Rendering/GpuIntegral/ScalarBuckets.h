// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ScalarBuckets_h
#define tetralux_ScalarBuckets_h

#include "Base/Span.h"
#include "TetraluxRenderingModule.h"

#include <cstdint>
#include <vector>

namespace tetralux
{

/// For ScalarBucketsDec.glsl: of each bucket the interval at its begin. ends: where each interval
/// but the last one ends, ascending, of scalars mapped to -1..1. As many buckets as tell the ends
/// apart, from a thousand to what every graphics card holds: so the right interval is mostly the
/// first.
TETRALUXRENDERING_EXPORT std::vector<std::int32_t> MakeScalarBuckets(Span<const float> ends);

} // namespace tetralux

#endif
