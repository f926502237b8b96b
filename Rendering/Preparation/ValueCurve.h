// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ValueCurve_h
#define tetralux_ValueCurve_h

#include "Optics/TransferFunction.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tetralux
{

/// Colour and attenuation as polynomials of degree four over an interval, t from 0 to 1: where a
/// function is smooth, what a few of its values say about all the others.
class ValueCurve
{
public:
  /// Colours, and the attenuation last.
  static constexpr int Channels = 4;

  /// Through five values, at quarters of the interval.
  explicit ValueCurve(const std::array<TransferFunction::Value, 5>& values)
  {
    for (int c = 0; c < Channels; ++c)
    {
      const double d1 = Get(values[1], c) - Get(values[0], c);
      const double d2 = Get(values[2], c) - Get(values[0], c);
      const double d3 = Get(values[3], c) - Get(values[0], c);
      const double d4 = Get(values[4], c) - Get(values[0], c);
      double* p = this->Coefficients[c];
      p[0] = Get(values[0], c);
      p[1] = 16 * d1 - 12 * d2 + 16. / 3 * d3 - d4;
      p[2] = -208. / 3 * d1 + 76 * d2 - 112. / 3 * d3 + 22. / 3 * d4;
      p[3] = 96 * d1 - 128 * d2 + 224. / 3 * d3 - 16 * d4;
      p[4] = -128. / 3 * d1 + 64 * d2 - 128. / 3 * d3 + 32. / 3 * d4;
    }
  }

  double Evaluate(int channel, double t) const
  {
    const double* p = this->Coefficients[channel];
    return p[0] + t * (p[1] + t * (p[2] + t * (p[3] + t * p[4])));
  }

  TransferFunction::Value Evaluate(double t) const
  {
    return { { this->Evaluate(0, t), this->Evaluate(1, t), this->Evaluate(2, t) },
      this->Evaluate(3, t) };
  }

  /// The largest second derivative of a channel in the interval, absolute: a line from end to end
  /// of a part of the interval is off by at most an eighth of it times the part's square.
  double GetLargestBend(int channel) const
  {
    const double* p = this->Coefficients[channel];
    const auto bend = [p](double t) { return std::abs(2 * p[2] + t * (6 * p[3] + t * 12 * p[4])); };
    // Where the derivative of the bend vanishes, if there.
    const double vertex = p[4] != 0 ? std::clamp(-p[3] / (4 * p[4]), 0., 1.) : 0;
    return std::max({ bend(0), bend(vertex), bend(1) });
  }

  static double Get(const TransferFunction::Value& value, int channel)
  {
    return channel < 3 ? value.Color[channel] : value.Attenuation;
  }

private:
  double Coefficients[Channels][5];
};

} // namespace tetralux

#endif
