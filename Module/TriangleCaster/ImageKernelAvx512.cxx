// SPDX-License-Identifier: BSD-3-Clause

// The kernels of the common case for AVX-512, with 16 lanes; this file is compiled for it, and
// called where it exists.
#ifdef __clang__ // tables over gradients come with the model, and are not of this case
#pragma clang diagnostic ignored "-Wunneeded-internal-declaration"
#endif

#include "TriangleCaster/CompositeModel.h"
#include "TriangleCaster/TileCasting.h"
#include "TriangleCaster/VoxelBoxesAvx512.h"

namespace tetralux
{

ImageKernel GetImageKernelAvx512(const ImageKernelInput& in)
{
  const bool looksUp = in.Blend == ImageBlend::Composite && !in.Slab.Texels && !in.Table.Entries;
  if (!looksUp || in.Lighting || in.GradientTransfer.Count > 0)
  {
    return nullptr;
  }
  return TETRALUX_ISA::ChooseType(in,
    [&](auto value) -> ImageKernel
    {
      using namespace TETRALUX_ISA;
      using Value = decltype(value);
      return in.Transfer.Count <= TransferLookup::MostFew
        ? &CastTile<Value, PlainComposite<Value, FewIntervals<TransferLookup::MostFew>>,
            ScalarsAhead<Value>>
        : &CastTile<Value, PlainComposite<Value, ManyIntervals>, ScalarsAhead<Value>>;
    });
}

} // namespace tetralux
