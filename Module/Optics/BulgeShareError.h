// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_BulgeShareError_h
#define tetralux_BulgeShareError_h

namespace tetralux
{

/// Largest error of the weight that a colour of 4 w (1 - w) along a segment has, w from 0 to 1:
/// FindBulgeShare in SegmentIntegral.h, and the shaders that mirror it. Absolute.
constexpr double BulgeShareError = 4e-4;

} // namespace tetralux

#endif
