// SPDX-License-Identifier: BSD-3-Clause
#include "Integral/IntegrationPlan.h"

#include "Integral/RayIntegral.h"
#include "Optics/IntervalTable.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace tetralux
{
namespace
{

using Value = TransferFunction::Value;

/// A linear part of a transfer function within the range of the scalars.
struct Ramp
{
  Value Begin, End;
};

std::vector<Ramp> GetRamps(const TransferFunction& function, const double scalarRange[2])
{
  const std::vector<TransferFunction::Node>& nodes = function.Nodes;
  const double lo = scalarRange[0];
  const double hi = scalarRange[1];
  // Adjoining constants or continuations are kept apart: that they are linear together is rare.
  std::vector<Ramp> ramps;
  Value begin = Evaluate(function, lo);
  for (const TransferFunction::Node& node : nodes)
  {
    if (lo < node.Scalar && node.Scalar <= hi)
    {
      ramps.push_back({ begin, node.Left });
      begin = node.Right;
    }
  }
  const bool endsOnNode = std::any_of(
    nodes.begin(), nodes.end(), [hi](const TransferFunction::Node& n) { return n.Scalar == hi; });
  const Value end = Evaluate(function, hi);
  const bool isStep = !ramps.empty() &&
    (ramps.back().End.Attenuation != end.Attenuation ||
      !std::equal(end.Color, end.Color + 3, ramps.back().End.Color));
  if (!endsOnNode || ramps.empty() || isStep)
  {
    ramps.push_back({ begin, end });
  }
  return ramps;
}

bool Contributes(const Ramp& ramp)
{
  return ramp.Begin.Attenuation > 0 || ramp.End.Attenuation > 0;
}

/// Whether all that contributes has one colour, and which.
bool FindConstantColor(const std::vector<Ramp>& ramps, double color[3])
{
  bool found = false;
  for (const Ramp& ramp : ramps)
  {
    for (const Value* value : { &ramp.Begin, &ramp.End })
    {
      if (!Contributes(ramp))
      {
        continue;
      }
      if (!found)
      {
        std::copy_n(value->Color, 3, color);
        found = true;
      }
      if (!std::equal(color, color + 3, value->Color))
      {
        return false;
      }
    }
  }
  return found;
}

void Check(const double scalarRange[2], int size)
{
  constexpr int LargestSize = 4096;
  if (!std::isfinite(scalarRange[0]) || !std::isfinite(scalarRange[1]) ||
    !(scalarRange[0] < scalarRange[1]))
  {
    throw std::invalid_argument("table: a scalar range from " + std::to_string(scalarRange[0]) +
      " to " + std::to_string(scalarRange[1]) + ", it must be finite and ascending");
  }
  if (size < 2 || size > LargestSize)
  {
    throw std::invalid_argument("table: a size of " + std::to_string(size) + ", it must be in 2.." +
      std::to_string(LargestSize));
  }
}

ScalarTable MakeTable(TableShape shape, const double scalarRange[2], int size)
{
  Check(scalarRange, size);
  ScalarTable table;
  table.Shape = shape;
  table.Size = size;
  std::copy_n(scalarRange, 2, table.ScalarRange);
  const std::size_t n = size;
  table.Texels.resize(4 * n * (shape == TableShape::Scalars ? n : 1));
  return table;
}

} // namespace

IntegrationPlan MakeIntegrationPlan(OpticalModel model, const TransferFunction& function,
  const double scalarRange[2], Span<const Isosurface> surfaces)
{
  IntegrationPlan plan;
  if (model == OpticalModel::Isosurfaces)
  {
    const auto isCrossed = [scalarRange](const Isosurface& surface)
    {
      return scalarRange[0] < surface.Value && surface.Value <= scalarRange[1] &&
        surface.Opacity > 0;
    };
    int crossed = 0;
    for (std::size_t k = 0; k < surfaces.size(); ++k)
    {
      crossed += isCrossed(surfaces[k]) ? 1 : 0;
    }
    plan.LargestNumberOfPieces = std::max(crossed, 1);
    plan.Transparent = crossed == 0;
    plan.Table = crossed > 1 ? TableShape::Scalars : TableShape::None;
    plan.Reason = crossed == 0 ? "no surface in the range of the scalars"
      : crossed == 1           ? "one surface: two comparisons"
                               : "surfaces depend on the two scalars of a segment only";
    return plan;
  }

  const std::vector<Ramp> ramps = GetRamps(function, scalarRange);
  plan.Transparent = std::none_of(ramps.begin(), ramps.end(), Contributes);
  plan.ConstantColor = FindConstantColor(ramps, plan.Color);
  plan.LargestNumberOfPieces = static_cast<int>(ramps.size());
  if (plan.Transparent)
  {
    plan.Reason = "nothing attenuates in the range of the scalars";
    return plan;
  }
  if (ramps.size() == 1)
  {
    plan.Reason = "one linear ramp: a segment is one piece";
    return plan;
  }
  switch (model)
  {
    case OpticalModel::EmissionAbsorption:
      plan.Table = plan.ConstantColor ? TableShape::Scalars : TableShape::ScalarsLength;
      plan.Reason = plan.ConstantColor
        ? "constant colour: the mean attenuation tells all"
        : "colours behind attenuation depend on both scalars and the length";
      break;
    case OpticalModel::EmissionOnly:
      plan.Table = TableShape::Scalars;
      plan.Reason = "emission is in proportion to the length";
      break;
    case OpticalModel::AbsorptionOnly:
      plan.Table = TableShape::Scalars;
      plan.Reason = "the mean attenuation tells all";
      break;
    case OpticalModel::MaximumIntensity:
      plan.Table = TableShape::Scalar;
      plan.Reason = "the transfer function at one scalar";
      break;
    case OpticalModel::Isosurfaces:
      break;
  }
  return plan;
}

ScalarTable MakeTransferTable(
  const TransferFunction& function, const double scalarRange[2], int size)
{
  ScalarTable table = MakeTable(TableShape::Scalar, scalarRange, size);
  for (int i = 0; i < size; ++i)
  {
    const SegmentRadiance value = ClassifyMaximum(function, table.GetScalar(i));
    float* texel = &table.Texels[4 * static_cast<std::size_t>(i)];
    std::copy_n(value.Color, 3, texel);
    texel[3] = static_cast<float>(value.Opacity);
  }
  return table;
}

ScalarTable MakeMeanTable(const TransferFunction& function, const double scalarRange[2], int size)
{
  ScalarTable table = MakeTable(TableShape::Scalars, scalarRange, size);
  // The mean attenuation is what a colour of one emits in a unit of length.
  TransferFunction white = function;
  for (TransferFunction::Node& node : white.Nodes)
  {
    std::fill_n(node.Left.Color, 3, 1.);
    std::fill_n(node.Right.Color, 3, 1.);
  }
#pragma omp parallel for schedule(dynamic)
  for (int b = 0; b < size; ++b)
  {
    for (int f = 0; f <= b; ++f)
    {
      // Means do not depend on which end is the front.
      const double sf = table.GetScalar(f);
      const double sb = table.GetScalar(b);
      const SegmentRadiance emission = IntegrateEmissionOnly(function, sf, sb, 1);
      const double attenuation = IntegrateEmissionOnly(white, sf, sb, 1).Color[0];
      for (const std::size_t texel :
        { static_cast<std::size_t>(b) * size + f, static_cast<std::size_t>(f) * size + b })
      {
        std::copy_n(emission.Color, 3, &table.Texels[4 * texel]);
        table.Texels[4 * texel + 3] = static_cast<float>(attenuation);
      }
    }
  }
  return table;
}

ScalarTable MakeIsosurfaceTable(
  Span<const Isosurface> surfaces, const double scalarRange[2], int size)
{
  ScalarTable table = MakeTable(TableShape::Scalars, scalarRange, size);
#pragma omp parallel for schedule(dynamic)
  for (int b = 0; b < size; ++b)
  {
    for (int f = 0; f < size; ++f)
    {
      const SegmentRadiance value =
        IntegrateIsosurfaces(surfaces, table.GetScalar(f), table.GetScalar(b));
      float* texel = &table.Texels[4 * (static_cast<std::size_t>(b) * size + f)];
      std::copy_n(value.Color, 3, texel);
      texel[3] = static_cast<float>(value.Opacity);
    }
  }
  return table;
}

} // namespace tetralux
