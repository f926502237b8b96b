// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ValueInterpolant_h
#define tetralux_ValueInterpolant_h

#include "Optics/TransferFunction.h"
#include "Preparation/ValueCurve.h"

#include <algorithm>

namespace tetralux
{

/// Colour and attenuation over an interval, t from 0 to 1, as the polynomial through their values
/// between Parts equal parts: in place of a function that takes long, where it is smooth.
template <int Parts>
class ValueInterpolant
{
public:
  explicit ValueInterpolant(const TransferFunction::Value (&values)[Parts + 1])
  {
    for (int c = 0; c < ValueCurve::Channels; ++c)
    {
      double* d = this->Differences[c];
      std::transform(values, values + Parts + 1, d,
        [c](const TransferFunction::Value& value) { return ValueCurve::Get(value, c); });
      for (int order = 1; order <= Parts; ++order)
      {
        for (int k = Parts; k >= order; --k)
        {
          d[k] -= d[k - 1];
        }
      }
    }
  }

  TransferFunction::Value Evaluate(double t) const
  {
    return { { this->Evaluate(0, t), this->Evaluate(1, t), this->Evaluate(2, t) },
      this->Evaluate(3, t) };
  }

private:
  /// Newton's forward differences.
  double Evaluate(int channel, double t) const
  {
    const double* d = this->Differences[channel];
    double value = d[Parts];
    for (int k = Parts; k-- > 0;)
    {
      value = d[k] + value * (t * Parts - k) / (k + 1);
    }
    return value;
  }

  double Differences[ValueCurve::Channels][Parts + 1];
};

} // namespace tetralux

#endif
