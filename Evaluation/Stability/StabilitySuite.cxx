// SPDX-License-Identifier: BSD-3-Clause
#include "Stability/StabilitySuite.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace tetralux
{
namespace
{

using Reference = ExtendedRadiance<Extended>;

Reference Integrate(const StabilityCase& segment)
{
  return IntegrateExtended<Extended>(
    segment.Function, segment.FrontScalar, segment.BackScalar, segment.Length);
}

struct Errors
{
  double Channels = 0; ///< of the three colours and the opacity
  double Behind = 0;   ///< of the transmittance
  double Size = 0;     ///< the opacity, or what stands for it
};

Errors Compare(const SegmentRadiance& result, const Reference& reference, OpticalModel model)
{
  const bool emissionOnly = model == OpticalModel::EmissionOnly;
  const Extended opacity = emissionOnly ? Extended(0) : reference.Opacity;
  Errors errors;
  errors.Size = static_cast<double>(emissionOnly ? reference.Depth : reference.Opacity);
  errors.Channels = static_cast<double>(std::abs(result.Opacity - opacity));
  for (int c = 0; c < 3; ++c)
  {
    const Extended& exact = emissionOnly ? reference.Emission[c] : reference.Color[c];
    errors.Channels =
      std::max(errors.Channels, static_cast<double>(std::abs(result.Color[c] - exact)));
  }
  errors.Behind = static_cast<double>(std::abs(result.Transmittance - (1 - opacity)));
  return errors;
}

void AddCase(StabilityRow& row, const StabilityForm& form, const StabilityCase& segment,
  const Reference& reference)
{
  const std::optional<StabilityResult> result = form.Integrate(segment);
  if (!result)
  {
    return;
  }
  ++row.NumberOfCases;
  const SegmentRadiance& r = result->Radiance;
  const double channels[] = { r.Color[0], r.Color[1], r.Color[2], r.Opacity, r.Transmittance };
  const auto any = [&](auto is)
  { return std::any_of(std::begin(channels), std::end(channels), is); };
  row.NotFinite += any([](double x) { return !std::isfinite(x); });
  row.Negative += any([](double x) { return x < 0; });
  row.AboveOne += r.Opacity > 1 || r.Transmittance > 1;

  const Errors errors = Compare(r, reference, form.Model);
  row.AbsoluteError = std::max(row.AbsoluteError, errors.Channels);
  if (errors.Size >= SmallestOpacity)
  {
    row.RelativeError = std::max(row.RelativeError, errors.Channels / errors.Size);
    row.ShareOfPromise = std::max({ row.ShareOfPromise,
      errors.Channels / (result->RelativeLimit * errors.Size + result->AbsoluteLimit),
      errors.Behind / (result->RelativeLimit + result->AbsoluteLimit) });
  }
}

} // namespace

std::vector<StabilityRow> MeasureStability(
  Span<const StabilityGroup> groups, Span<const StabilityForm> forms)
{
  std::vector<StabilityRow> rows;
  for (const StabilityForm& form : forms)
  {
    for (const StabilityGroup& group : groups)
    {
      StabilityRow row;
      row.Form = form.Name;
      row.Group = group.Name;
      rows.push_back(row);
    }
  }
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    for (const StabilityCase& segment : groups[g].Cases)
    {
      const Reference reference = Integrate(segment);
      for (std::size_t f = 0; f < forms.size(); ++f)
      {
        AddCase(rows[f * groups.size() + g], forms[f], segment, reference);
      }
    }
  }
  return rows;
}

} // namespace tetralux
