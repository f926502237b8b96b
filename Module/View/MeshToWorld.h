// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_MeshToWorld_h
#define tetralux_MeshToWorld_h

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetralux
{

/// How an affine map changes lengths: by factors from Smallest to Largest, its singular values.
struct Stretch
{
  double Smallest = 1;
  double Largest = 1;
};

/// rows: three of an affine map, of which the first three columns count. One-sided Jacobi
/// iteration, which keeps the relative accuracy of small singular values where columns differ in
/// length only. Columns are scaled first, so no square overflows. Not-a-number where an element is
/// not finite.
inline Stretch MeasureStretch(const double (*rows)[4])
{
  double a[3][3];
  double largest = 0;
  for (int i = 0; i < 3; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      a[i][k] = rows[i][k];
      largest = std::max(largest, std::abs(a[i][k]));
    }
  }
  if (!(largest > 0) || !std::isfinite(largest))
  {
    const double none = largest == 0 ? 0. : std::numeric_limits<double>::quiet_NaN();
    return { none, none };
  }
  for (auto& row : a)
  {
    for (double& x : row)
    {
      x /= largest;
    }
  }
  const auto dot = [&a](int p, int q)
  { return a[0][p] * a[0][q] + a[1][p] * a[1][q] + a[2][p] * a[2][q]; };
  // Quadratic convergence: five sweeps make columns of any 3 x 3 matrix orthogonal to rounding.
  constexpr int Sweeps = 8;
  for (int sweep = 0; sweep < Sweeps; ++sweep)
  {
    for (int p = 0; p < 2; ++p)
    {
      for (int q = p + 1; q < 3; ++q)
      {
        const double pq = dot(p, q);
        if (pq == 0)
        {
          continue;
        }
        const double zeta = (dot(q, q) - dot(p, p)) / (2 * pq);
        const double t = std::copysign(1., zeta) / (std::abs(zeta) + std::hypot(1., zeta));
        const double cosine = 1 / std::hypot(1., t);
        const double sine = cosine * t;
        for (auto& row : a)
        {
          const double x = row[p];
          row[p] = cosine * x - sine * row[q];
          row[q] = sine * x + cosine * row[q];
        }
      }
    }
  }
  const double norms[3] = { std::sqrt(dot(0, 0)), std::sqrt(dot(1, 1)), std::sqrt(dot(2, 2)) };
  return { largest * *std::min_element(norms, norms + 3),
    largest * *std::max_element(norms, norms + 3) };
}

/// How much longer a length of the mesh is in the world: the inverse of what meshFromWorld, of a
/// RayGrid, does. Infinite where that has no inverse.
inline Stretch MeasureMeshToWorld(const double (*meshFromWorld)[4])
{
  const Stretch inverse = MeasureStretch(meshFromWorld);
  return { 1 / inverse.Largest, 1 / inverse.Smallest };
}

} // namespace tetralux

#endif
