// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SegmentWeightError_h
#define tetralux_SegmentWeightError_h

namespace tetralux
{

/// Largest error of a segment's weights in single precision, relative to its opacity: of the closed
/// form in SegmentIntegral.h, and of the shaders that mirror it.
constexpr double SegmentWeightError = 5e-7;

} // namespace tetralux

#endif
