// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_SampleFunctions_h
#define tetralux_SampleFunctions_h

// Transfer functions over scalars of 0..1 that are hard for tables.

#include "Optics/TransferFunction.h"

#include <random>

namespace tetralux
{

/// Bends of all sizes, colours that change, steps at some nodes.
inline TransferFunction MakeRandomFunction(
  std::mt19937_64& generator, int nodes, double attenuation, bool steps)
{
  std::uniform_real_distribution<double> unit(0, 1);
  const auto value = [&]()
  {
    const double tau = unit(generator) < 0.3 ? 0 : attenuation * unit(generator);
    return TransferFunction::Value{ { unit(generator), unit(generator), unit(generator) }, tau };
  };
  TransferFunction function;
  double s = 0;
  for (int k = 0; k < nodes; ++k)
  {
    const TransferFunction::Value left = value();
    const bool step = steps && unit(generator) < 0.5;
    function.Nodes.push_back({ s, left, step ? value() : left });
    s += 0.02 + unit(generator);
  }
  for (TransferFunction::Node& node : function.Nodes)
  {
    node.Scalar /= function.Nodes.back().Scalar;
  }
  return function;
}

/// A peak of attenuation over 0..1.
inline TransferFunction MakeNeedle(double center, double halfWidth, double attenuation)
{
  const auto value = [](double tau) { return TransferFunction::Value{ { 1, 0.5, 0.2 }, tau }; };
  return { { { 0, value(0), value(0) }, { center - halfWidth, value(0), value(0) },
    { center, value(attenuation), value(attenuation) }, { center + halfWidth, value(0), value(0) },
    { 1, value(0), value(0) } } };
}

} // namespace tetralux

#endif
