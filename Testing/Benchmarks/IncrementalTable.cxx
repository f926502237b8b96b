// SPDX-License-Identifier: BSD-3-Clause
#include "IncrementalTable.h"

#include "PreIntegration/PreIntegrationBuilder.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace tetralux
{
namespace
{

/// Where a segment is split: between two texels along the scalars.
struct Split
{
  int Index;
  float Share;
};

/// The splits of segments to one scalar at the back, a share of the way from each scalar at the
/// front.
void FindSplits(const std::vector<double>& texels, int back, double share, Split* splits)
{
  // Splits ascend with the front's scalar.
  int index = 0;
  const int last = static_cast<int>(texels.size()) - 2;
  for (std::size_t front = 0; front < texels.size(); ++front)
  {
    const double split = (1 - share) * texels[front] + share * texels[back];
    while (index < last && texels[index + 1] <= split)
    {
      ++index;
    }
    const double t = (split - texels[index]) / (texels[index + 1] - texels[index]);
    splits[front] = { index, static_cast<float>(std::clamp(t, 0., 1.)) };
  }
}

/// For one scalar at the back and the n scalars at the front. front: the slice of the front parts'
/// length. back: the row of the back scalar in the slice of the back parts' length.
void JoinSegments(const float* front, const float* back, int n, const Split* splits, float* result)
{
  for (int f = 0; f < n; ++f)
  {
    const float t = splits[f].Share;
    const float* f0 = front + 4 * (static_cast<std::ptrdiff_t>(splits[f].Index) * n + f);
    const float* f1 = f0 + 4 * static_cast<std::ptrdiff_t>(n);
    const float* b0 = back + 4 * static_cast<std::ptrdiff_t>(splits[f].Index);
    float* sum = result + 4 * static_cast<std::ptrdiff_t>(f);
    float first[4];
    for (int c = 0; c < 4; ++c)
    {
      first[c] = f0[c] + t * (f1[c] - f0[c]);
    }
    const float behind = 1.f - first[3];
    for (int c = 0; c < 4; ++c)
    {
      const float second = b0[c] + t * (b0[4 + c] - b0[c]);
      sum[c] = first[c] + behind * second;
    }
    sum[3] = std::min(sum[3], 1.f);
  }
}

} // namespace

void BuildIncrementalTable(const TransferFunction& function, const PreIntegrationSettings& settings,
  PreIntegrationTable& table)
{
  table.Settings = settings;
  table.Scalars = MakeScalarAxis(function, settings);
  table.Lengths = MakeLengthAxis(settings);
  const int n = table.Scalars.GetSize();
  const std::size_t slice = std::size_t{ 4 } * n * n;
  table.Texels.Resize(slice * table.Lengths.Size * sizeof(float));
  auto* values = reinterpret_cast<float*>(table.Texels.GetData());

  // The lengths 0 and that of a step.
  PreIntegrationSettings shortest = settings;
  shortest.LengthSize = 2;
  shortest.LongestSegment = table.Lengths.Delta;
  PreIntegrationTable step;
  BuildPreIntegrationTable(function, shortest, step);
  std::memcpy(values, step.Texels.GetData(), step.Texels.GetSize());

#pragma omp parallel
  {
    std::vector<Split> splits(n);
    for (int row = 2; row < table.Lengths.Size; ++row)
    {
#pragma omp for schedule(static)
      for (int back = 0; back < n; ++back)
      {
        const std::size_t place = std::size_t{ 4 } * n * back;
        FindSplits(table.Scalars.Texels, back, 1. / row, splits.data());
        JoinSegments(values + slice, values + (row - 1) * slice + place, n, splits.data(),
          values + row * slice + place);
      }
    }
  }
}

} // namespace tetralux
