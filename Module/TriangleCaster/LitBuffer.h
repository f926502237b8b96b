// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LitBuffer_h
#define tetralux_LitBuffer_h

#include "TriangleCaster/CompositingBuffer.h"
#include "TriangleCaster/GradientModel.h"

#include <type_traits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{

/// A buffer whose samples are lit by their gradients. Gradients: NoGradients, or GradientModel if
/// lights shine or opacity depends on gradients.
template <class Gradients>
class LitBuffer : public CompositingBuffer
{
public:
  static constexpr bool AtEnds = false;

  LitBuffer(const ImageKernelInput& in, const ImageRays& rays)
    : CompositingBuffer(in, rays)
    , Gradient(in, rays)
  {
  }

protected:
  static constexpr bool UsesGradients = !std::is_same_v<Gradients, NoGradients>;

  /// Composites what is visible, with its colour lit and cued. gradient: if UsesGradients.
  TETRALUX_INLINE void AddLit(const ImageKernelInput& in, const ImageSample& sample, Mask8 visible,
    const LaneVector& gradient, Float8 opacity, Float8 (&color)[3])
  {
    if constexpr (UsesGradients)
    {
      if (in.Lighting)
      {
        this->Gradient.Light(in, *in.Lighting, sample, gradient, color);
      }
    }
    Cue(in, sample, color);
    for (Float8& channel : color)
    {
      channel = Keep(visible, channel);
    }
    this->AddSample(sample, opacity, color);
  }

  Gradients Gradient;
};

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux

#endif
