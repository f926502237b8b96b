// SPDX-License-Identifier: BSD-3-Clause
#include "Projection/PerspectiveShift.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tetralux
{
namespace
{

double GetShift(const ScreenFrame& frame, const ScreenPoint& a, const ScreenPoint& b,
  const double* x, const double* y)
{
  if (!frame.IsInFront(a) || !frame.IsInFront(b))
  {
    return std::numeric_limits<double>::infinity();
  }
  const auto [least, most] = std::minmax(a.Depth, b.Depth);
  const double root = std::sqrt(most / least);
  return (root - 1) / (root + 1) * std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
}

} // namespace

double FindPerspectiveShift(const ScreenFrame& frame, Span<const ScreenPoint> points,
  const TetrahedralMesh& mesh, Span<const std::uint8_t> cells)
{
  constexpr int Edges[6][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 }, { 2, 3 } };
  double largest = 0;
  const auto count = static_cast<std::int64_t>(mesh.GetNumberOfCells());
#pragma omp parallel for schedule(static) reduction(max : largest)
  for (std::int64_t cell = 0; cell < count; ++cell)
  {
    if (!cells.empty() && cells[cell] == 0)
    {
      continue;
    }
    for (const auto& edge : Edges)
    {
      const std::int32_t a = mesh.Cells[4 * cell + edge[0]];
      const std::int32_t b = mesh.Cells[4 * cell + edge[1]];
      largest = std::max(largest,
        GetShift(frame, points[a], points[b], &mesh.Points[std::size_t{ 3 } * a],
          &mesh.Points[std::size_t{ 3 } * b]));
    }
  }
  return largest;
}

} // namespace tetralux
