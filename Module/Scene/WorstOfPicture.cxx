// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/WorstOfPicture.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace tetralux
{

double FindOneInThousand(const std::vector<double>& errors, const std::vector<double>& weights)
{
  std::vector<std::size_t> order(errors.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [&errors](std::size_t a, std::size_t b) { return errors[a] > errors[b]; });
  const double allowed = std::accumulate(weights.begin(), weights.end(), 0.) / 1000;
  double sum = 0;
  for (const std::size_t i : order)
  {
    sum += weights[i];
    if (sum > allowed)
    {
      return errors[i];
    }
  }
  return 0;
}

} // namespace tetralux
