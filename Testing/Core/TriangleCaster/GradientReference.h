// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GradientReference_h
#define tetralux_GradientReference_h

#include "ImageScene.h"

#include <vector>

namespace tetralux
{

/// A picture as ImageCaster::Cast makes it, by a plain loop in double precision: gradients,
/// their opacity, tables over both, lights and depth cueing. Without limits; values are numbers;
/// threshold 0.
std::vector<double> RenderWithGradients(const ImageScene& scene);

} // namespace tetralux

#endif
