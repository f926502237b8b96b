// SPDX-License-Identifier: BSD-3-Clause
#include "Stability/StabilityCases.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace tetralux
{
namespace
{

using Value = TransferFunction::Value;
using Node = TransferFunction::Node;

/// Colours that differ in every channel from node to node.
Value MakeValue(double attenuation, int index)
{
  static constexpr double colors[][3] = { { 1, 0, 0.25 }, { 0, 1, 0.5 }, { 0.75, 0.125, 1 },
    { 0.25, 0.5, 0 } };
  const double(&color)[3] = colors[index % 4];
  return { { color[0], color[1], color[2] }, attenuation };
}

/// Continuous and linear between pairs of scalar and attenuation.
TransferFunction MakeLinear(const std::vector<std::pair<double, double>>& nodes)
{
  TransferFunction function;
  for (std::size_t k = 0; k < nodes.size(); ++k)
  {
    const Value value = MakeValue(nodes[k].second, static_cast<int>(k));
    function.Nodes.push_back({ nodes[k].first, value, value });
  }
  return function;
}

/// The scalar some representable numbers further up, or down.
double Step(double scalar, int steps)
{
  const double towards =
    steps > 0 ? std::numeric_limits<double>::max() : std::numeric_limits<double>::lowest();
  for (int i = 0; i < std::abs(steps); ++i)
  {
    scalar = std::nextafter(scalar, towards);
  }
  return scalar;
}

StabilityGroup MakeOpticalDepths()
{
  StabilityGroup group{ "optical depth 1e-12..1e6", {} };
  for (int k = -24; k <= 12; ++k)
  {
    const double depth = std::pow(10, 0.5 * k);
    for (const double share : { 0., 1e-9, 0.1, 0.4, 0.4999999, 0.5, 0.7, 0.999, 1. })
    {
      const TransferFunction function =
        MakeLinear({ { 0, 2 * depth * share }, { 1, 2 * depth * (1 - share) } });
      group.Cases.push_back({ function, 0, 1, 1 });
      group.Cases.push_back({ function, 0.25, 0.5, 4 });
    }
  }
  return group;
}

StabilityGroup MakeSlopes()
{
  StabilityGroup group{ "attenuation slope -1e6..1e6", {} };
  for (int k = -12; k <= 12; ++k)
  {
    const double slope = std::pow(10, 0.5 * k);
    for (const double base : { 0., 1e-3, 1. })
    {
      const TransferFunction rising = MakeLinear({ { 0, base }, { 1, base + slope } });
      const TransferFunction falling = MakeLinear({ { 0, base + slope }, { 1, base } });
      for (const TransferFunction& function : { rising, falling })
      {
        group.Cases.push_back({ function, 0, 1, 1 });
        group.Cases.push_back({ function, 1, 0, 1 });
        group.Cases.push_back({ function, 0.25, 0.75, 1 });
        group.Cases.push_back({ function, 0.999, 0.001, 1 });
      }
    }
  }
  return group;
}

StabilityGroup MakeEqualEnds()
{
  StabilityGroup group{ "front scalar near back scalar", {} };
  TransferFunction step = MakeLinear({ { 0, 1 }, { 0.5, 2 }, { 1, 0 } });
  step.Nodes[1].Right = MakeValue(5, 3);
  const TransferFunction functions[] = { MakeLinear({ { 0, 0 }, { 1, 4 } }),
    MakeLinear({ { 0, 0 }, { 0.2999, 0 }, { 0.3, 1e6 }, { 0.3001, 0 }, { 1, 1 } }), step };
  for (const TransferFunction& function : functions)
  {
    for (const double scalar : { 0., 0.3, 0.5, 0.7, 1. })
    {
      for (const double length : { 1e-3, 1., 100. })
      {
        for (const int ulps : { -3, -1, 0, 1, 3 })
        {
          group.Cases.push_back({ function, scalar, Step(scalar, ulps), length });
        }
        for (const double difference : { 1e-15, 1e-12, 1e-9, 1e-6, 1e-3 })
        {
          group.Cases.push_back({ function, scalar, scalar + difference, length });
          group.Cases.push_back({ function, scalar + difference, scalar - difference, length });
        }
      }
    }
  }
  return group;
}

StabilityGroup MakeSteps()
{
  StabilityGroup group{ "steps", {} };
  TransferFunction function;
  function.Nodes = { { 0.25, MakeValue(0, 0), MakeValue(1, 1) },
    { 0.5, MakeValue(2, 2), MakeValue(1e6, 3) }, { 0.75, MakeValue(1e6, 0), MakeValue(1e-6, 1) } };
  const double scalars[] = { 0, Step(0.25, -1), 0.25, Step(0.25, 1), 0.4, 0.5, 0.6, 0.75, 1 };
  for (const double front : scalars)
  {
    for (const double back : scalars)
    {
      for (const double length : { 1e-6, 1e-3, 1., 1e3 })
      {
        group.Cases.push_back({ function, front, back, length });
      }
    }
  }
  return group;
}

StabilityGroup MakeNeedles()
{
  StabilityGroup group{ "needle peak, width 1e-2..1e-12", {} };
  constexpr double Center = 0.3;
  for (int k = 2; k <= 12; ++k)
  {
    const double width = std::pow(10, -k);
    for (const double height : { 1., 1 / width, 1e6 })
    {
      for (const double base : { 0., 1e-3 })
      {
        const TransferFunction function = MakeLinear({ { 0, base }, { Center - width, base },
          { Center, height }, { Center + width, base }, { 1, base } });
        const std::pair<double, double> ends[] = { { 0, 1 }, { 1, 0 }, { Center, 1 },
          { 0.2, Center }, { Center - 0.5 * width, Center + 0.75 * width },
          { Center + 1e-3, Center - 1e-3 } };
        for (const auto& [front, back] : ends)
        {
          group.Cases.push_back({ function, front, back, 1 });
        }
      }
    }
  }
  return group;
}

StabilityGroup MakeOpaque()
{
  StabilityGroup group{ "opacity 1", {} };
  // Attenuation is opacity / unit distance.
  for (int k = 0; k <= 12; ++k)
  {
    const double attenuation = std::pow(10, k);
    const TransferFunction functions[] = { MakeLinear({ { 0, attenuation }, { 1, attenuation } }),
      MakeLinear({ { 0, 0 }, { 1, attenuation } }),
      MakeLinear({ { 0, 0 }, { 0.5, 0 }, { 0.5000001, attenuation }, { 1, attenuation } }) };
    for (const TransferFunction& function : functions)
    {
      group.Cases.push_back({ function, 0, 1, 1 });
      group.Cases.push_back({ function, 1, 0, 1 });
      group.Cases.push_back({ function, 0.4, 0.6, 1e-3 });
    }
  }
  return group;
}

StabilityGroup MakeScalarRanges()
{
  StabilityGroup group{ "scalar range 1e-300..1e300", {} };
  for (const double scale : { 1e-300, 1e-30, 1e-6, 1e6, 1e30, 1e300 })
  {
    for (const double offset : { 0., 1., 1e6 })
    {
      const auto place = [&](double x) { return scale * (offset + x); };
      const TransferFunction function =
        MakeLinear({ { place(0), 0 }, { place(0.3), 3 }, { place(0.4), 0.1 }, { place(1), 5 } });
      const std::pair<double, double> ends[] = { { 0, 1 }, { 1, 0 }, { 0.2, 0.21 }, { -1, 2 },
        { 0.35, 0.35 }, { 0.4, 0.4 }, { 3, 2 } };
      for (const auto& [front, back] : ends)
      {
        group.Cases.push_back({ function, place(front), place(back), 1 });
      }
    }
  }
  return group;
}

StabilityGroup MakeConstantFields()
{
  StabilityGroup group{ "constant field", {} };
  for (const double scalar : { 0., 1e-30, -1., 1. / 3, 1e6, -1e30 })
  {
    for (const double attenuation : { 1e-12, 1e-3, 1., 1e6 })
    {
      const TransferFunction one = MakeLinear({ { scalar, attenuation } });
      TransferFunction step = one;
      step.Nodes[0].Right = MakeValue(2 * attenuation, 1);
      const double width = scalar == 0 ? 1 : 0.5 * std::abs(scalar);
      const TransferFunction ramp =
        MakeLinear({ { scalar - width, 0 }, { scalar, attenuation }, { scalar + width, 0 } });
      for (const TransferFunction& function : { one, step, ramp })
      {
        group.Cases.push_back({ function, scalar, scalar, 1 });
        group.Cases.push_back({ function, scalar, scalar, 1e-3 });
      }
    }
  }
  return group;
}

StabilityGroup MakeLengths()
{
  StabilityGroup group{ "length 1e-9..1", {} };
  for (int k = -18; k <= 0; ++k)
  {
    const double length = std::pow(10, 0.5 * k);
    for (const double attenuation : { 1., 1e3, 1e9 })
    {
      const TransferFunction function =
        MakeLinear({ { 0, 0 }, { 0.3, attenuation }, { 0.6, 0.01 * attenuation }, { 1, 0 } });
      group.Cases.push_back({ function, 0, 1, length });
      group.Cases.push_back({ function, 0.9, 0.1, length });
      group.Cases.push_back({ function, 0.31, 0.32, length });
    }
  }
  return group;
}

/// Draws cases that combine what the other groups have one by one. It takes nothing but the bits of
/// the generator: the distributions of the C++ library differ from one implementation to the next.
class RandomCases
{
public:
  explicit RandomCases(std::uint64_t seed)
    : Generator(seed)
  {
  }

  StabilityCase Draw()
  {
    StabilityCase result{};
    const double scale = this->Choose({ 1e-30, 1e-3, 1, 1e3, 1e30 });
    const double offset = scale * this->Choose({ 0, 0, -0.5, 1, 1e3 });
    const double depth = this->Power(-12, 6);
    result.Length = this->Power(-9, 0);

    std::vector<double> places;
    for (int count = 1 + static_cast<int>(this->Generator() % 5); count > 0; --count)
    {
      places.push_back(this->Unit());
    }
    const bool needle = this->Unit() < 0.3;
    const double center = this->Unit();
    if (needle)
    {
      const double width = this->Power(-12, -2);
      places.insert(places.end(), { center - width, center, center + width });
    }
    std::vector<double> scalars(places.size());
    std::transform(places.begin(), places.end(), scalars.begin(),
      [&](double place) { return offset + scale * place; });
    std::sort(scalars.begin(), scalars.end());
    scalars.erase(std::unique(scalars.begin(), scalars.end()), scalars.end());
    for (const double scalar : scalars)
    {
      const Value left = this->DrawValue(depth / result.Length);
      const Value right = this->Unit() < 0.3 ? this->DrawValue(depth / result.Length) : left;
      result.Function.Nodes.push_back({ scalar, left, right });
    }

    result.FrontScalar = this->DrawScalar(scalars, offset, scale);
    switch (this->Generator() % 6)
    {
      case 0:
        result.BackScalar = result.FrontScalar;
        break;
      case 1:
        result.BackScalar = Step(result.FrontScalar, static_cast<int>(this->Generator() % 9) - 4);
        break;
      case 2:
        result.BackScalar = result.FrontScalar + scale * this->Power(-15, -3);
        break;
      default:
        result.BackScalar = this->DrawScalar(scalars, offset, scale);
        break;
    }
    return result;
  }

private:
  double Unit() { return std::ldexp(static_cast<double>(this->Generator() >> 11), -53); }

  double Power(double lowest, double highest)
  {
    return std::pow(10, lowest + (highest - lowest) * this->Unit());
  }

  double Choose(const std::vector<double>& values)
  {
    return values[this->Generator() % values.size()];
  }

  /// Of the order of an attenuation, 0, or far from it.
  Value DrawValue(double attenuation)
  {
    Value value{ { this->Unit(), this->Unit(), this->Unit() }, attenuation * this->Unit() };
    switch (this->Generator() % 6)
    {
      case 0:
        value.Attenuation = 0;
        break;
      case 1:
        value.Attenuation *= this->Power(-6, 3);
        break;
      default:
        break;
    }
    return value;
  }

  /// At a node, beside one, or anywhere.
  double DrawScalar(const std::vector<double>& scalars, double offset, double scale)
  {
    const double node = scalars[this->Generator() % scalars.size()];
    switch (this->Generator() % 4)
    {
      case 0:
        return node;
      case 1:
        return Step(node, static_cast<int>(this->Generator() % 9) - 4);
      default:
        return offset + scale * (1.4 * this->Unit() - 0.2);
    }
  }

  std::mt19937_64 Generator;
};

} // namespace

std::vector<StabilityGroup> MakeStabilityGroups(std::uint64_t seed, int numberOfRandomCases)
{
  std::vector<StabilityGroup> groups{ MakeOpticalDepths(), MakeSlopes(), MakeEqualEnds(),
    MakeSteps(), MakeNeedles(), MakeOpaque(), MakeScalarRanges(), MakeConstantFields(),
    MakeLengths(), { "random combinations", {} } };
  RandomCases random(seed);
  for (int i = 0; i < numberOfRandomCases; ++i)
  {
    groups.back().Cases.push_back(random.Draw());
  }
  return groups;
}

} // namespace tetralux
