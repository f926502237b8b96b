// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_EightBitError_h
#define tetralux_EightBitError_h

// What compositing cells in 8 bits a channel does to a picture (Kraus et al. 2004, section 4.2), as
// a sample of the mesh's rays tells: each ray is composited as the graphics card does, which rounds
// what a cell adds, and rounds what it blends that with.
//
// Rounding at random makes what a cell adds right on the average. It cannot reach the second
// rounding: a cell of opacity 1/255 takes nothing from a colour below 0.5, whatever is random. So
// in a volume of thin cells and some opacity random rounding makes all too bright, while rounding
// to the nearest leaves the thinnest cells out on both sides. Which is better depends on the scene.
// Where nothing is taken away, in pure emission, random rounding is right on the average.

#include "Integral/RaySegments.h"
#include "Optics/OpticalModel.h"
#include "Optics/TransferFunction.h"
#include "TetraluxCoreModule.h"

namespace tetralux
{

/// Of a channel, absolute.
struct EightBitError
{
  double MeanSquare = 0; ///< over the channels of a picture, of the mean of eight pixels
  double Largest = 0;    ///< estimated: WorstOfPicture times what one ray in a thousand exceeds
};

struct EightBitErrors
{
  EightBitError Nearest; ///< each cell's share rounded to the nearest
  EightBitError Random;  ///< rounded up or down at random

  /// Whether random rounding is clearly better: it also brings noise.
  bool IsRandomBetter() const { return 2 * this->Random.MeanSquare < this->Nearest.MeanSquare; }
};

/// rays: DrawMeshRays. lengthScale: world length of a unit of RaySegment::Length. model: emission,
/// absorption or both. Random rounding is that of AlphaDitherDec.glsl: of opacities, with which
/// colours are scaled; without absorption, of colours. Parallel, the same for any number of
/// threads. Throws std::invalid_argument for other models.
TETRALUXCORE_EXPORT EightBitErrors EstimateEightBitErrors(
  const RaySample& rays, double lengthScale, const TransferFunction& function, OpticalModel model);

} // namespace tetralux

#endif
