// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_ReferenceVector_h
#define tetralux_ReferenceVector_h

#include <array>

namespace tetralux
{
namespace reference
{

/// What the oracle computes in.
using Real = long double;
using Vector = std::array<Real, 3>;

inline Vector ToVector(const double v[3]) { return { v[0], v[1], v[2] }; }

inline Real Dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/// By an affine matrix, without its last column.
inline Vector TransformDirection(const double matrix[3][4], const Vector& v)
{
  Vector result;
  for (int row = 0; row < 3; ++row)
  {
    result[row] = matrix[row][0] * v[0] + matrix[row][1] * v[1] + matrix[row][2] * v[2];
  }
  return result;
}

inline Vector TransformPoint(const double matrix[3][4], const Vector& v)
{
  Vector result = TransformDirection(matrix, v);
  for (int row = 0; row < 3; ++row)
  {
    result[row] += matrix[row][3];
  }
  return result;
}

} // namespace reference
} // namespace tetralux

#endif
