// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_LinearProgram_h
#define tetralux_LinearProgram_h

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace tetralux
{

/// Normal . x <= Limit.
template <int Dimension>
struct HalfSpace
{
  std::array<double, Dimension> Normal;
  double Limit;
};

/// Half the width of the box in which x is looked for, in the units of x: ten times as far as the
/// callers' own half spaces let x go, so that it never decides.
constexpr double LinearProgramReach = 1e3;

/// How much Normal . x may exceed Limit, and how small a coefficient of a normal counts
/// as 0. Normals have about unit length and x is up to about 100: some roundings of
/// that size, 1e-14 each.
constexpr double LinearProgramRounding = 1e-13;

/// Finds the x in all half spaces with the largest objective . x. Returns false if there is none.
///
/// Normals must have about unit length, and the half spaces must bound x to about 100 in each
/// coordinate, best by a box that comes first. They are added one by one (Seidel, Small-Dimensional
/// Linear Programming and Convex Hulls Made Easy, 1991), in linear expected time if their order is
/// random. Rounded: callers check the result.
template <int Dimension>
bool SolveLinearProgram(const std::vector<HalfSpace<Dimension>>& halfSpaces,
  const std::array<double, Dimension>& objective, std::array<double, Dimension>& x)
{
  if constexpr (Dimension == 1)
  {
    double low = -std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::max();
    for (const auto& halfSpace : halfSpaces)
    {
      const double normal = halfSpace.Normal[0];
      if (std::abs(normal) < LinearProgramRounding)
      {
        if (halfSpace.Limit < -LinearProgramRounding)
        {
          return false;
        }
        continue;
      }
      (normal > 0 ? high : low) = normal > 0 ? std::min(high, halfSpace.Limit / normal)
                                             : std::max(low, halfSpace.Limit / normal);
    }
    x[0] = objective[0] > 0 ? high : low;
    return low <= high + LinearProgramRounding;
  }
  else
  {
    // The box decides where it starts.
    for (int d = 0; d < Dimension; ++d)
    {
      x[d] = objective[d] > 0 ? LinearProgramReach : -LinearProgramReach;
    }
    for (std::size_t i = 0; i < halfSpaces.size(); ++i)
    {
      const auto& normal = halfSpaces[i].Normal;
      double value = -halfSpaces[i].Limit;
      int pivot = 0;
      for (int d = 0; d < Dimension; ++d)
      {
        value += normal[d] * x[d];
        pivot = std::abs(normal[d]) > std::abs(normal[pivot]) ? d : pivot;
      }
      if (value <= LinearProgramRounding)
      {
        continue;
      }
      if (std::abs(normal[pivot]) < LinearProgramRounding)
      {
        return false;
      }
      // The optimum is on the plane of this one: x[pivot] = limit - slope . others.
      std::array<double, Dimension> slope;
      for (int d = 0; d < Dimension; ++d)
      {
        slope[d] = normal[d] / normal[pivot];
      }
      const double limit = halfSpaces[i].Limit / normal[pivot];
      std::vector<HalfSpace<Dimension - 1>> others(i);
      const auto drop = [&](const std::array<double, Dimension>& from)
      {
        std::array<double, Dimension - 1> to;
        for (int d = 0, e = 0; d < Dimension; ++d)
        {
          if (d != pivot)
          {
            to[e++] = from[d] - from[pivot] * slope[d];
          }
        }
        return to;
      };
      for (std::size_t j = 0; j < i; ++j)
      {
        others[j] = { drop(halfSpaces[j].Normal),
          halfSpaces[j].Limit - halfSpaces[j].Normal[pivot] * limit };
      }
      // The start of the box in the smaller space is a bound, too.
      for (int e = 0; e < Dimension - 1; ++e)
      {
        std::array<double, Dimension - 1> side{};
        side[e] = 1;
        others.push_back({ side, LinearProgramReach });
        side[e] = -1;
        others.push_back({ side, LinearProgramReach });
      }
      std::array<double, Dimension - 1> y;
      if (!SolveLinearProgram<Dimension - 1>(others, drop(objective), y))
      {
        return false;
      }
      x[pivot] = limit;
      for (int d = 0, e = 0; d < Dimension; ++d)
      {
        if (d != pivot)
        {
          x[d] = y[e++];
          x[pivot] -= slope[d] * x[d];
        }
      }
    }
    return true;
  }
}

} // namespace tetralux

#endif
