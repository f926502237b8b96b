// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchFront.h"

#include "Bench/BenchResults.h"
#include "Bench/BenchSettings.h"

#include <algorithm>

namespace
{

bool IsRanked(const BenchRow& row)
{
  return row.Failure.empty() && row.Setting.Name != ReferenceSettingName;
}

bool Beats(const BenchRow& row, const BenchRow& other)
{
  return row.Errors.Maximum <= other.Errors.Maximum && row.BestSeconds <= other.BestSeconds &&
    (row.Errors.Maximum < other.Errors.Maximum || row.BestSeconds < other.BestSeconds);
}

} // namespace

void MarkFront(BenchSceneResult& result)
{
  for (BenchRow& row : result.Rows)
  {
    row.OnFront = IsRanked(row) &&
      std::none_of(result.Rows.begin(), result.Rows.end(),
        [&row](const BenchRow& other) { return IsRanked(other) && Beats(other, row); });
  }
}
