// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferenceIntegral_h
#define tetralux_ReferenceIntegral_h

#include "Optics/OpticalModel.h"
#include "Optics/TransferFunction.h"
#include "ReferenceShading.h"

#include <functional>

namespace tetralux
{

/// What one ray segment adds to a picture.
struct ReferenceSegment
{
  double Color[3] = { 0, 0, 0 }; ///< red, green, blue, premultiplied
  double Alpha = 0;              ///< 1 - exp(-OpticalDepth); 0 where nothing is absorbed
  double OpticalDepth = 0;       ///< the integral of the attenuation, whatever the model

  /// Where along the segment, 0..1, the first piece with any attenuation begins; -1: nowhere.
  double FirstContribution = -1;
};

/// Emission, absorption or both along a segment of a ray over which the scalar goes linearly from
/// s0 to s1, in front of nothing. length: world units, at least 0. Throws std::invalid_argument for
/// the models that are no integrals.
///
/// Numerical quadrature, independent of any closed form: split at the nodes of the transfer
/// function, then at every unit of optical depth, then Gauss-Legendre. The relative error is below
/// 1e-12 at any optical depth; what lies behind an optical depth of 42 is left out (below 1e-18).
///
/// A constant scalar that equals a node's takes the node's Right value.
ReferenceSegment IntegrateReference(const TransferFunction& function, double s0, double s1,
  double length, OpticalModel model = OpticalModel::EmissionAbsorption);

/// The same of EmissionAbsorption under lights. light: at a share of the segment, 0..1, may jump.
/// sharpest: the share about which it may change within so little of the segment that no quadrature
/// would notice; intervals end there. Each interval is halved until both halves add what it did, to
/// 1e-10, and light goes on to its ends as between points of the rule, or until it is 2^-40 long.
ReferenceSegment IntegrateLitReference(const TransferFunction& function, double s0, double s1,
  double length, const std::function<ReferenceLight(double share)>& light, double sharpest = 0);

/// The function at a scalar; at a node the Right value.
TransferFunction::Value EvaluateReference(const TransferFunction& function, double s);

} // namespace tetralux

#endif
