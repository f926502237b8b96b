// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ColorMaps_h
#define tetralux_ColorMaps_h

// Colour maps as people use them, over scalars of 0..1.

#include "Optics/TransferFunction.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace tetralux
{

struct ColorMap
{
  std::string Name;
  TransferFunction Function;
};

/// A channel of sRGB of a linear one.
inline double EncodeColor(double linear)
{
  const double bounded = std::clamp(linear, 0., 1.);
  return bounded <= 0.0031308 ? 12.92 * bounded : 1.055 * std::pow(bounded, 1 / 2.4) - 0.055;
}

/// ParaView's cool to warm (Moreland 2009): from blue by white to red, in polar coordinates of
/// CIELAB.
inline void EvaluateCoolToWarm(double t, double (&rgb)[3])
{
  constexpr double White = 88;
  constexpr double Magnitude = 80;
  constexpr double Saturation = 1.08;
  constexpr double CoolHue = -1.1;
  constexpr double WarmHue = 0.5;
  constexpr double Spin = 0.561; // of the hue, where there is no saturation
  const double w = std::abs(2 * t - 1);
  const double m = White + w * (Magnitude - White);
  const double s = w * Saturation;
  const double h = t < 0.5 ? CoolHue - (1 - w) * Spin : WarmHue + (1 - w) * Spin;
  const double l = m * std::cos(s);
  const double a = m * std::sin(s) * std::cos(h);
  const double b = m * std::sin(s) * std::sin(h);
  const double fy = (l + 16) / 116;
  const auto expand = [](double f)
  { return f > 6. / 29 ? f * f * f : 3 * (6. / 29) * (6. / 29) * (f - 4. / 29); };
  const double x = 0.9505 * expand(fy + a / 500);
  const double y = expand(fy);
  const double z = 1.089 * expand(fy - b / 200);
  rgb[0] = EncodeColor(3.2406 * x - 1.5372 * y - 0.4986 * z);
  rgb[1] = EncodeColor(-0.9689 * x + 1.8758 * y + 0.0415 * z);
  rgb[2] = EncodeColor(0.0557 * x - 0.2040 * y + 1.0570 * z);
}

/// Colours at equal steps, with an attenuation that has bends of its own.
template <class Evaluate>
TransferFunction SampleColors(int nodes, double attenuation, const Evaluate& evaluate)
{
  const std::vector<std::pair<double, double>> bends = { { 0, 0 }, { 0.15, 0 }, { 0.3, 0.6 },
    { 0.45, 0.05 }, { 0.8, 0.3 }, { 1, 1 } };
  std::vector<double> places;
  for (int k = 0; k < nodes; ++k)
  {
    places.push_back(static_cast<double>(k) / (nodes - 1));
  }
  for (const auto& bend : bends)
  {
    places.push_back(bend.first);
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  TransferFunction function;
  for (const double s : places)
  {
    TransferFunction::Value value{};
    evaluate(s, value.Color);
    std::size_t k = 1;
    while (k + 1 < bends.size() && bends[k].first < s)
    {
      ++k;
    }
    const double f = (s - bends[k - 1].first) / (bends[k].first - bends[k - 1].first);
    value.Attenuation = attenuation * ((1 - f) * bends[k - 1].second + f * bends[k].second);
    function.Nodes.push_back({ s, value, value });
  }
  return function;
}

/// Colours of 3, 6 and 256 nodes and cool to warm, which has as many as its subdivision makes.
/// attenuation: the largest one, per world unit.
inline std::vector<ColorMap> MakeColorMaps(double attenuation)
{
  const auto mix = [](const std::vector<std::vector<double>>& colors)
  {
    return [colors](double t, double(&rgb)[3])
    {
      const double place = t * static_cast<double>(colors.size() - 1);
      const std::size_t k = std::min(static_cast<std::size_t>(place), colors.size() - 2);
      const double f = place - static_cast<double>(k);
      for (int c = 0; c < 3; ++c)
      {
        rgb[c] = (1 - f) * colors[k][c] + f * colors[k + 1][c];
      }
    };
  };
  // Like Viridis: dark violet, blue, green, yellow.
  const auto green = [](double t, double(&rgb)[3])
  {
    rgb[0] = std::clamp(0.27 + t * (0.1 + t * (-2.2 + 2.83 * t)), 0., 1.);
    rgb[1] = std::clamp(0.9 * std::sin(1.45 * t), 0., 1.);
    rgb[2] = std::clamp(0.33 + t * (1.3 - t * (2.9 - 1.4 * t)), 0., 1.);
  };
  constexpr int NodesOfPreset = 256;
  constexpr int NodesOfDiverging = 581;
  return { { "3 nodes",
             SampleColors(3, attenuation, mix({ { 0, 0, 1 }, { 1, 1, 1 }, { 1, 0, 0 } })) },
    { "6 nodes",
      SampleColors(6, attenuation,
        mix({ { 0, 0, 1 }, { 0, 1, 1 }, { 0, 1, 0 }, { 1, 1, 0 }, { 1, 0.5, 0 }, { 1, 0, 0 } })) },
    { "256 nodes", SampleColors(NodesOfPreset, attenuation, green) },
    { "diverging", SampleColors(NodesOfDiverging, attenuation, EvaluateCoolToWarm) } };
}

} // namespace tetralux

#endif
