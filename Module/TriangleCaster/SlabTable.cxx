// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/SlabTable.h"

#include "PreIntegration/PreIntegrationBuilder.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tetralux
{
namespace
{

/// A slab of this optical depth is opaque: it lets e^-40 through.
constexpr double OpaqueDepth = 40;

/// What taking an attenuation to be linear between two scalars may change of a slab's opacity, as a
/// share of it: of a picture less than a tenth of a step of 8 bits.
constexpr double LinearTolerance = 1e-3;

/// An opacity that no picture shows.
constexpr double Unseen = 1e-6;

/// The attenuation of StepOpacity::Power, a world unit.
double GetAttenuation(double opacity, double unitDistance, double length)
{
  const double most = OpaqueDepth / length;
  return opacity < 1 ? std::min(-std::log1p(-std::max(opacity, 0.)) / unitDistance, most) : most;
}

TransferFunction::Value Mix(
  const TransferFunction::Value& a, const TransferFunction::Value& b, double t)
{
  TransferFunction::Value value;
  for (int c = 0; c < 3; ++c)
  {
    value.Color[c] = a.Color[c] + t * (b.Color[c] - a.Color[c]);
  }
  value.Attenuation = a.Attenuation + t * (b.Attenuation - a.Attenuation);
  return value;
}

/// The function over which the table is built: its attenuation is one, not an opacity. Between
/// nodes the opacity is linear but the attenuation is not, so nodes are added.
TransferFunction MakeAttenuationFunction(const ImageOptics& optics, double length)
{
  TransferFunction function = optics.Function;
  if (optics.Opacity == StepOpacity::Attenuation)
  {
    for (TransferFunction::Node& node : function.Nodes)
    {
      node.Left.Attenuation /= optics.UnitDistance;
      node.Right.Attenuation /= optics.UnitDistance;
    }
    return function;
  }
  const auto convert = [&](TransferFunction::Value value)
  {
    value.Attenuation = GetAttenuation(value.Attenuation, optics.UnitDistance, length);
    return value;
  };
  const std::vector<TransferFunction::Node>& nodes = optics.Function.Nodes;
  std::vector<TransferFunction::Node> result;
  for (std::size_t k = 0; k < nodes.size(); ++k)
  {
    result.push_back({ nodes[k].Scalar, convert(nodes[k].Left), convert(nodes[k].Right) });
    if (k + 1 == nodes.size())
    {
      break;
    }
    // Halved until linear.
    constexpr int MostParts = 64;
    const TransferFunction::Value& a = nodes[k].Right;
    const TransferFunction::Value& b = nodes[k + 1].Left;
    int parts = 1;
    const auto isLinear = [&](int n)
    {
      for (int p = 0; p < n; ++p)
      {
        const double from = convert(Mix(a, b, static_cast<double>(p) / n)).Attenuation;
        const double to = convert(Mix(a, b, (p + 1.) / n)).Attenuation;
        const double middle = convert(Mix(a, b, (p + 0.5) / n)).Attenuation;
        // What is opaque already does not become more so.
        const double seen = length * std::exp(-length * std::min(from, to));
        const double opacity = -std::expm1(-length * middle);
        if (std::abs(0.5 * (from + to) - middle) * seen > LinearTolerance * opacity + Unseen)
        {
          return false;
        }
      }
      return true;
    };
    while (parts < MostParts && !isLinear(parts))
    {
      parts *= 2;
    }
    for (int p = 1; p < parts; ++p)
    {
      const double t = static_cast<double>(p) / parts;
      const double scalar = nodes[k].Scalar + t * (nodes[k + 1].Scalar - nodes[k].Scalar);
      if (result.back().Scalar < scalar && scalar < nodes[k + 1].Scalar)
      {
        const TransferFunction::Value value = convert(Mix(a, b, t));
        result.push_back({ scalar, value, value });
      }
    }
  }
  function.Nodes = result;
  return function;
}

} // namespace

void SlabTable::Update(const ImageOptics& optics, double slabLength, const double (&range)[2])
{
  constexpr double LengthsOfOctave = 4;
  const double length =
    std::exp2(std::round(LengthsOfOctave * std::log2(slabLength)) / LengthsOfOctave);
  if (length == this->Length)
  {
    return;
  }
  this->Length = 0; // until the table is there
  PreIntegrationSettings settings;
  settings.ScalarSize = Size;
  settings.LengthSize = 2;
  settings.Axis = ScalarAxis::Uniform;
  settings.ScalarRange[0] = range[0];
  settings.ScalarRange[1] = range[1];
  settings.LongestSegment = length;
  BuildPreIntegrationTable(MakeAttenuationFunction(optics, length), settings, this->Table);
  // Of length 0 there is nothing; what follows is of the whole length.
  this->Texels = reinterpret_cast<const float*>(this->Table.Texels.GetData()) +
    static_cast<std::size_t>(4) * Size * Size;
  const double extent = range[1] - range[0];
  this->Scale = extent > 0 ? (Size - 1) / extent : 0;
  this->Offset = -range[0] * this->Scale;
  this->Length = length;
}

} // namespace tetralux
