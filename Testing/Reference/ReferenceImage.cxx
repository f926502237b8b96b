// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceImage.h"

#include "GaussLegendre.h"
#include "ReferenceIntegral.h"
#include "ReferenceRays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace tetralux
{

using namespace reference;

namespace
{

constexpr Real Infinity = std::numeric_limits<Real>::infinity();
constexpr Real NaN = std::numeric_limits<Real>::quiet_NaN();

void Check(const ImageVolume& volume, const ImageOptics& optics)
{
  for (const int points : volume.Dimensions)
  {
    if (points < 2)
    {
      throw std::invalid_argument("the reference needs two points along each axis");
    }
  }
  if (optics.Function.Nodes.empty())
  {
    throw std::invalid_argument("the reference needs a function with nodes");
  }
  if (!(optics.UnitDistance > 0))
  {
    throw std::invalid_argument("the reference needs a unit distance above 0");
  }
}

Real GetScalar(const ImageVolume& volume, int i, int j, int k)
{
  const std::size_t index = i +
    static_cast<std::size_t>(volume.Dimensions[0]) *
      (j + static_cast<std::size_t>(volume.Dimensions[1]) * k);
  Real value = 0;
  switch (volume.Type)
  {
    case ImageScalar::Int8:
      value = static_cast<const std::int8_t*>(volume.Values)[index];
      break;
    case ImageScalar::UInt8:
      value = static_cast<const std::uint8_t*>(volume.Values)[index];
      break;
    case ImageScalar::Int16:
      value = static_cast<const std::int16_t*>(volume.Values)[index];
      break;
    case ImageScalar::UInt16:
      value = static_cast<const std::uint16_t*>(volume.Values)[index];
      break;
    case ImageScalar::Float:
      value = static_cast<const float*>(volume.Values)[index];
      break;
  }
  return volume.Offset + volume.Scale * value;
}

/// A cell's scalar: the sum of Terms[b] times those of x, y, z whose bit is in b, from the first
/// corner on. A constant scalar stays exactly what it is.
struct Trilinear
{
  std::array<int, 3> Cell;
  std::array<Real, 8> Terms;
  bool Empty = false;

  /// The cell at a point in the volume.
  Trilinear(const ImageVolume& volume, const Vector& point)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Cell[axis] =
        std::clamp(static_cast<int>(std::floor(point[axis])), 0, volume.Dimensions[axis] - 2);
    }
    for (int corner = 0; corner < 8; ++corner)
    {
      this->Terms[corner] = GetScalar(volume, this->Cell[0] + (corner & 1),
        this->Cell[1] + (corner >> 1 & 1), this->Cell[2] + (corner >> 2));
      this->Empty = this->Empty || !std::isfinite(this->Terms[corner]);
    }
    for (const int bit : { 1, 2, 4 })
    {
      for (int corner = 0; corner < 8; ++corner)
      {
        if (corner & bit)
        {
          this->Terms[corner] -= this->Terms[corner ^ bit];
        }
      }
    }
  }

  Real Evaluate(const Vector& point) const
  {
    Real sum = 0;
    for (int b = 0; b < 8; ++b)
    {
      Real term = this->Terms[b];
      for (int axis = 0; axis < 3; ++axis)
      {
        term *= (b >> axis & 1) != 0 ? point[axis] - this->Cell[axis] : 1;
      }
      sum += term;
    }
    return sum;
  }
};

/// NaN where there is nothing.
Real Interpolate(const ImageVolume& volume, const Vector& point)
{
  const Trilinear cell(volume, point);
  return cell.Empty ? NaN : cell.Evaluate(point);
}

Vector GetPoint(const ReferenceRay& ray, Real t)
{
  Vector point;
  for (int axis = 0; axis < 3; ++axis)
  {
    point[axis] = ray.Origin[axis] + t * ray.Direction[axis];
  }
  return point;
}

/// The parts of the ray that count.
ReferenceIntervals FindParts(
  const ImageVolume& volume, const ReferenceRay& ray, const RayLimits& limits, std::size_t pixel)
{
  Real begin = 0;
  Real end = Infinity;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Real last = volume.Dimensions[axis] - 1;
    if (ray.Direction[axis] == 0)
    {
      if (!(ray.Origin[axis] >= 0 && ray.Origin[axis] <= last))
      {
        return {};
      }
      continue;
    }
    const Real low = -ray.Origin[axis] / ray.Direction[axis];
    const Real high = (last - ray.Origin[axis]) / ray.Direction[axis];
    begin = std::max(begin, std::min(low, high));
    end = std::min(end, std::max(low, high));
  }
  return begin < end ? ApplyReferenceLimits(limits, ray, pixel, begin, end) : ReferenceIntervals();
}

void AddLengths(const ReferenceIntervals& parts, ReferencePixel& pixel)
{
  for (const auto& part : parts)
  {
    pixel.Length += static_cast<double>(part[1] - part[0]);
  }
}

//------------------------------------------------------------------------------------------------
// Slices

bool IsZero(const double v[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

bool IsParallel(const RayGrid& grid)
{
  return IsZero(grid.DirectionStepX) && IsZero(grid.DirectionStepY);
}

/// Slabs of a picture.
class Slabs
{
public:
  Slabs(const ImageVolume& volume, const RayGrid& grid, const ReferenceSlices& slices)
    : Distance(slices.Distance)
    , Shells(slices.Shape == SliceShape::Shells && !IsParallel(grid))
  {
    if (!(slices.Distance > 0))
    {
      throw std::invalid_argument("the reference needs a distance of slices above 0");
    }
    this->FindNormal(grid);
    this->FindOrigin(volume, grid);
  }

  /// What the depth grows by along a direction of length 1.
  Real GetSlope(const Vector& direction) const
  {
    return this->Shells ? 1 : Dot(this->Normal, direction);
  }

  /// The depth at which slab n begins.
  Real GetBegin(Real n) const { return this->Origin + n * this->Distance; }

  /// The slab that a depth is in; not below 0.
  Real Find(Real depth) const
  {
    return std::max<Real>(0, std::floor((depth - this->Origin) / this->Distance));
  }

private:
  void FindNormal(const RayGrid& grid)
  {
    const bool parallel = IsParallel(grid);
    const Vector direction = ToVector(grid.Direction);
    this->Normal = Cross(ToVector(parallel ? grid.OriginStepX : grid.DirectionStepX),
      ToVector(parallel ? grid.OriginStepY : grid.DirectionStepY));
    if (Dot(this->Normal, this->Normal) == 0)
    {
      this->Normal = direction; // of a single ray
    }
    const Real length = std::sqrt(Dot(this->Normal, this->Normal));
    const Real sign = Dot(this->Normal, direction) < 0 ? -1 : 1;
    for (Real& component : this->Normal)
    {
      component *= sign / length;
    }
  }

  void FindOrigin(const ImageVolume& volume, const RayGrid& grid)
  {
    // Relative to the eye, where the volume's first point is and where its axes lead to: the
    // inverse of MeshFromWorld, by Cramer's rule.
    const Vector rows[3] = { ToVector(grid.MeshFromWorld[0]), ToVector(grid.MeshFromWorld[1]),
      ToVector(grid.MeshFromWorld[2]) };
    const Vector eye = TransformPoint(grid.MeshFromWorld, ToVector(grid.Origin));
    Vector axes[3] = { Cross(rows[1], rows[2]), Cross(rows[2], rows[0]), Cross(rows[0], rows[1]) };
    const Real determinant = Dot(rows[0], axes[0]);
    Vector low{ Infinity, Infinity, Infinity };
    Vector high{ -Infinity, -Infinity, -Infinity };
    Real front = Infinity;
    for (int corner = 0; corner < 8; ++corner)
    {
      Vector point{ 0, 0, 0 };
      for (int axis = 0; axis < 3; ++axis)
      {
        const Real index = (corner >> axis & 1) != 0 ? volume.Dimensions[axis] - 1 : 0;
        for (int a = 0; a < 3; ++a)
        {
          point[a] += (index - eye[axis]) * axes[axis][a] / determinant;
        }
      }
      front = std::min(front, Dot(this->Normal, point));
      for (int a = 0; a < 3; ++a)
      {
        low[a] = std::min(low[a], point[a]);
        high[a] = std::max(high[a], point[a]);
      }
    }
    if (this->Shells)
    {
      Vector nearest;
      for (int a = 0; a < 3; ++a)
      {
        nearest[a] = std::clamp<Real>(0, low[a], high[a]);
      }
      front = std::sqrt(Dot(nearest, nearest));
    }
    this->Origin = std::max<Real>(0, front);
  }

  Real Distance;
  Real Origin = 0;
  bool Shells;
  Vector Normal{};
};

/// What a sample does to the ray behind it.
struct Sample
{
  Real Alpha = 0;
  TransferFunction::Value Value{};
};

Sample Classify(const ImageOptics& optics, Real scalar, Real length)
{
  if (std::isnan(scalar) || !(length > 0))
  {
    return {};
  }
  Sample sample;
  sample.Value = EvaluateReference(optics.Function, static_cast<double>(scalar));
  const Real a = sample.Value.Attenuation;
  const Real l = length / optics.UnitDistance;
  sample.Alpha = optics.Opacity == StepOpacity::Attenuation ? -std::expm1(-a * l)
    : a < 1                                                 ? -std::expm1(std::log1p(-a) * l)
                                                            : 1;
  return sample;
}

/// The largest change of a channel from one sample to the other, were they alone.
Real Compare(const Sample& a, const Sample& b)
{
  Real change = std::abs(a.Alpha - b.Alpha);
  for (int c = 0; c < 3; ++c)
  {
    change = std::max(change, std::abs(a.Alpha * a.Value.Color[c] - b.Alpha * b.Value.Color[c]));
  }
  return change;
}

/// How much a sample may change where it is off by the rounding. length and lengthError: of the
/// sample, in world units.
Real FindDoubt(const ImageVolume& volume, const ImageOptics& optics,
  const ReferenceRounding& rounding, const Vector& point, Real length, Real lengthError)
{
  const Real scalar = Interpolate(volume, point);
  Real low = scalar;
  Real high = scalar;
  bool maybeEmpty = std::isnan(scalar);
  for (int corner = 0; corner < 8; ++corner)
  {
    Vector displaced = point;
    for (int axis = 0; axis < 3; ++axis)
    {
      displaced[axis] = std::clamp<Real>(
        point[axis] + ((corner >> axis & 1) != 0 ? rounding.Position : -rounding.Position), 0,
        volume.Dimensions[axis] - 1);
    }
    const Real other = Interpolate(volume, displaced);
    maybeEmpty = maybeEmpty || std::isnan(other);
    low = std::fmin(low, other); // a number, if one of both is
    high = std::fmax(high, other);
  }
  if (std::isnan(low))
  {
    return 0;
  }
  low -= rounding.Scalar;
  high += rounding.Scalar;
  std::vector<Real> scalars{ low, high };
  for (const TransferFunction::Node& node : optics.Function.Nodes)
  {
    if (node.Scalar >= low && node.Scalar <= high)
    {
      // Both sides of a step.
      scalars.push_back(node.Scalar);
      scalars.push_back(std::nextafter(node.Scalar, -std::numeric_limits<double>::infinity()));
    }
  }
  const Sample sample = Classify(optics, scalar, length);
  Real doubt = maybeEmpty ? sample.Alpha : 0;
  for (const Real l : { length - lengthError, length, length + lengthError })
  {
    for (const Real s : scalars)
    {
      doubt = std::max(doubt, Compare(sample, Classify(optics, s, l)));
    }
  }
  return doubt;
}

//------------------------------------------------------------------------------------------------
// The integral

/// The scalar over a stretch of a ray within one cell, x = 0..1.
using Cubic = std::array<Real, 4>;

Real Evaluate(const Cubic& cubic, Real x)
{
  return cubic[0] + x * (cubic[1] + x * (cubic[2] + x * cubic[3]));
}

Cubic MakeCubic(const Trilinear& cell, const Vector& begin, const Vector& end)
{
  Cubic sum{};
  for (int b = 0; b < 8; ++b)
  {
    Cubic term{ cell.Terms[b], 0, 0, 0 };
    for (int axis = 0; axis < 3; ++axis)
    {
      if ((b >> axis & 1) != 0)
      {
        const Real constant = begin[axis] - cell.Cell[axis];
        const Real slope = end[axis] - begin[axis];
        for (int power = 3; power >= 0; --power)
        {
          term[power] = term[power] * constant + (power > 0 ? term[power - 1] * slope : 0);
        }
      }
    }
    for (int power = 0; power < 4; ++power)
    {
      sum[power] += term[power];
    }
  }
  return sum;
}

/// Where a cubic turns within 0..1, ascending, with 0 and 1 around them.
std::vector<Real> FindMonotoneEnds(const Cubic& cubic)
{
  std::vector<Real> ends{ 0, 1 };
  const auto add = [&](Real x)
  {
    if (x > 0 && x < 1)
    {
      ends.push_back(x);
    }
  };
  // c + 2 b x + a x^2, by the root that does not cancel.
  const Real a = 3 * cubic[3];
  const Real b = cubic[2];
  const Real c = cubic[1];
  const Real discriminant = b * b - a * c;
  if (discriminant >= 0)
  {
    const Real q = -(b + (b < 0 ? -1 : 1) * std::sqrt(discriminant));
    add(q / a); // infinite or undefined where there is no such root
    add(c / q);
  }
  std::sort(ends.begin(), ends.end());
  return ends;
}

/// Where a cubic that is monotone over low..high comes to a value between those at both ends.
Real Bisect(const Cubic& cubic, Real low, Real high, Real value)
{
  const bool rising = Evaluate(cubic, low) < value;
  for (int halving = 0; halving < std::numeric_limits<Real>::digits; ++halving)
  {
    const Real middle = (low + high) / 2;
    ((Evaluate(cubic, middle) < value) == rising ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// A stretch of a ray within which the function is linear and the scalar a cubic.
class Piece
{
public:
  /// from and to: in the range of the cubic; length: of all of that range, in unit distances.
  Piece(const ImageOptics& optics, const Cubic& cubic, Real from, Real to, Real length)
    : Opacity(optics.Opacity)
    , Scalar(cubic)
    , From(from)
    , Width(to - from)
    , Length(length * (to - from))
  {
    const auto& nodes = optics.Function.Nodes;
    const Real middle = Evaluate(cubic, (from + to) / 2);
    std::size_t k = 0;
    while (k < nodes.size() && nodes[k].Scalar <= middle)
    {
      ++k;
    }
    this->Lower = k == 0 ? nodes.front().Left : nodes[k - 1].Right;
    this->Upper = k == nodes.size() ? nodes.back().Right : nodes[k].Left;
    if (k > 0 && k < nodes.size())
    {
      this->Begin = nodes[k - 1].Scalar;
      this->Range = nodes[k].Scalar - this->Begin;
    }
  }

  Real GetLength() const { return this->Length; }

  /// Whether there is any attenuation, but perhaps at single points.
  bool IsVisible() const
  {
    return this->GetOpacity(0) > 0 || this->GetOpacity(1) > 0 || this->GetOpacity(0.5L) > 0;
  }

  /// Whether the attenuation is infinite all over it.
  bool IsOpaque() const
  {
    return this->Opacity == StepOpacity::Power && this->GetOpacity(0) >= 1 &&
      this->GetOpacity(0.5L) >= 1 && this->GetOpacity(1) >= 1;
  }

  /// At x = 0..1 of the piece, per unit distance.
  Real GetAttenuation(Real x) const
  {
    const Real a = this->GetOpacity(x);
    // Where it comes to 1, the integral of the logarithm is finite.
    return this->Opacity == StepOpacity::Attenuation
      ? a
      : -std::log(std::max(1 - a, std::numeric_limits<Real>::min()));
  }

  Real GetColor(Real x, int channel) const
  {
    return this->Mix(x, this->Lower.Color[channel], this->Upper.Color[channel]);
  }

private:
  Real GetOpacity(Real x) const
  {
    return this->Mix(x, this->Lower.Attenuation, this->Upper.Attenuation);
  }

  Real Mix(Real x, Real lower, Real upper) const
  {
    const Real s = Evaluate(this->Scalar, this->From + x * this->Width);
    return lower + (upper - lower) * std::clamp<Real>((s - this->Begin) / this->Range, 0, 1);
  }

  StepOpacity Opacity;
  const Cubic& Scalar;
  Real From;
  Real Width;
  Real Length;
  TransferFunction::Value Lower;
  TransferFunction::Value Upper;
  Real Begin = 0;
  Real Range = 1; ///< beyond the nodes both values are the same
};

/// What a ray gathers, piece by piece.
class Gatherer
{
public:
  void Add(const Piece& piece)
  {
    if (piece.IsOpaque())
    {
      const Gathered rest = { Infinity,
        { piece.GetColor(0, 0), piece.GetColor(0, 1), piece.GetColor(0, 2) } };
      this->Append(rest);
      return;
    }
    this->Add(piece, 0, 1, ApplyRule(piece, 0, 1), MostHalvings);
  }

  void GetRgba(double rgba[4]) const
  {
    for (int c = 0; c < 3; ++c)
    {
      rgba[c] = static_cast<double>(this->Sum.Color[c]);
    }
    rgba[3] = static_cast<double>(-std::expm1(-this->Sum.Depth));
  }

private:
  /// Optical depth of a stretch, and the colour of it that reaches its begin.
  struct Gathered
  {
    Real Depth = 0;
    Real Color[3] = { 0, 0, 0 };
  };

  /// Of a channel: where both ways of finding it differ by less, the finer one is right. The rays
  /// of the tests have some thousand pieces.
  static constexpr Real Tolerance = 1e-13L;
  /// What is seen through less is below the last bit of a double.
  static constexpr Real Negligible = 1e-20L;
  /// The attenuation is a logarithm at its end where the opacity comes to 1, or has any size.
  static constexpr int MostHalvings = 60;

  static Gathered ApplyRule(const Piece& piece, Real from, Real to)
  {
    static const GaussLegendre rule;
    constexpr int Order = GaussLegendre::Order;
    const Real length = piece.GetLength() * (to - from);
    std::array<Real, Order> depths; // of the points' own
    for (int i = 0; i < Order; ++i)
    {
      depths[i] = length * piece.GetAttenuation(from + (to - from) * rule.Points[i]);
    }
    Gathered gathered;
    for (int i = 0; i < Order; ++i)
    {
      Real front = 0;
      for (int k = 0; k < Order; ++k)
      {
        front += rule.Partial[i][k] * depths[k];
      }
      gathered.Depth += rule.Weights[i] * depths[i];
      for (int c = 0; c < 3; ++c)
      {
        gathered.Color[c] += rule.Weights[i] * depths[i] * std::exp(-front) *
          piece.GetColor(from + (to - from) * rule.Points[i], c);
      }
    }
    return gathered;
  }

  static Gathered Join(const Gathered& front, const Gathered& back)
  {
    Gathered both = front;
    both.Depth += back.Depth;
    for (int c = 0; c < 3; ++c)
    {
      both.Color[c] += std::exp(-front.Depth) * back.Color[c];
    }
    return both;
  }

  void Append(const Gathered& back) { this->Sum = Join(this->Sum, back); }

  void Add(const Piece& piece, Real from, Real to, const Gathered& whole, int halvings)
  {
    const Real middle = (from + to) / 2;
    const Gathered front = ApplyRule(piece, from, middle);
    const Gathered back = ApplyRule(piece, middle, to);
    const Gathered both = Join(front, back);
    Real error = std::abs(std::exp(-whole.Depth) - std::exp(-both.Depth));
    for (int c = 0; c < 3; ++c)
    {
      error = std::max(error, std::abs(whole.Color[c] - both.Color[c]));
    }
    const Real seen = std::exp(-this->Sum.Depth);
    // An interval of large depth would look black to both: all points are deep within it.
    if (halvings == 0 || seen < Negligible || (whole.Depth < 1 && seen * error < Tolerance))
    {
      this->Append(both);
      return;
    }
    this->Add(piece, from, middle, front, halvings - 1);
    this->Add(piece, middle, to, back, halvings - 1);
  }

  Gathered Sum;
};

/// The ends of a part, and where it passes planes of the grid between them.
std::vector<Real> FindGridPlanes(
  const ImageVolume& volume, const ReferenceRay& ray, const std::array<Real, 2>& part)
{
  std::vector<Real> ends{ part[0], part[1] };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int index = 0; index < volume.Dimensions[axis]; ++index)
    {
      const Real t = (index - ray.Origin[axis]) / ray.Direction[axis];
      if (t > part[0] && t < part[1])
      {
        ends.push_back(t);
      }
    }
  }
  std::sort(ends.begin(), ends.end());
  return ends;
}

/// The ends of 0..1, and where the function bends or the scalar turns between them.
std::vector<Real> FindPieces(const Cubic& cubic, const TransferFunction& function)
{
  const std::vector<Real> turns = FindMonotoneEnds(cubic);
  std::vector<Real> ends = turns;
  for (std::size_t k = 0; k + 1 < turns.size(); ++k)
  {
    const auto range = std::minmax({ Evaluate(cubic, turns[k]), Evaluate(cubic, turns[k + 1]) });
    for (const TransferFunction::Node& node : function.Nodes)
    {
      if (node.Scalar > range.first && node.Scalar < range.second)
      {
        ends.push_back(Bisect(cubic, turns[k], turns[k + 1], node.Scalar));
      }
    }
  }
  std::sort(ends.begin(), ends.end());
  return ends;
}

/// Pixels for which threads bring more than they cost.
constexpr std::size_t ManyPixels = 1024;

/// Calls render(i, j) for each pixel.
template <class RenderT>
std::vector<ReferencePixel> RenderPixels(const RayGrid& grid, const RenderT& render)
{
  std::vector<ReferencePixel> pixels(static_cast<std::size_t>(grid.Width) * grid.Height);
#pragma omp parallel for schedule(dynamic) if (pixels.size() >= ManyPixels)
  for (int j = 0; j < grid.Height; ++j)
  {
    for (int i = 0; i < grid.Width; ++i)
    {
      pixels[static_cast<std::size_t>(j) * grid.Width + i] = render(i, j);
    }
  }
  return pixels;
}

ReferencePixel SampleRay(const ImageVolume& volume, const ImageOptics& optics, const RayGrid& grid,
  const RayLimits& limits, const ReferenceSlices& slices, const Slabs& slabs, int i, int j)
{
  const ReferenceRay ray = MakeReferenceRay(grid, i, j);
  const ReferenceIntervals parts =
    FindParts(volume, ray, limits, static_cast<std::size_t>(j) * grid.Width + i);
  const Real slope = slabs.GetSlope(ray.WorldDirection);
  const Real lengthFactor = slices.CorrectOpacity ? 1 : slope;

  const ReferenceRounding& rounding = slices.Rounding;
  const Real lengthError = rounding.Length * slices.Distance;
  const bool rounded = rounding.Position > 0 || rounding.Scalar > 0 || rounding.Length > 0;

  ReferencePixel pixel;
  if (!(slope > 0))
  {
    return pixel;
  }
  AddLengths(parts, pixel);
  Real color[3] = { 0, 0, 0 };
  Real translucency = 1;
  Real doubt = 0;
  const auto find = [&](Real t, Real length)
  {
    return FindDoubt(
      volume, optics, rounding, GetPoint(ray, t), length, lengthFactor * lengthError);
  };
  for (const auto& part : parts)
  {
    Real n = slabs.Find(part[0] * slope);
    for (Real begin = part[0]; begin < part[1]; ++n)
    {
      begin = std::max(part[0], slabs.GetBegin(n) / slope);
      const Real end = std::min(part[1], slabs.GetBegin(n + 1) / slope);
      if (!(begin < end))
      {
        continue;
      }
      const Real middle = (begin + end) / 2;
      const Real length = lengthFactor * (end - begin);
      const Sample sample = Classify(optics, Interpolate(volume, GetPoint(ray, middle)), length);
      if (rounded)
      {
        doubt += translucency * find(middle, length);
        // A sample that is not there because the part just does not reach into its slab.
        if (begin == part[0] && n > 0 && begin - slabs.GetBegin(n) / slope < lengthError)
        {
          doubt += translucency * find(begin, 0);
        }
        if (end == part[1] && slabs.GetBegin(n + 1) / slope - end < lengthError)
        {
          doubt += translucency * find(end, 0);
        }
      }
      if (sample.Alpha > 0 && pixel.Depth < 0)
      {
        pixel.Depth = static_cast<double>(begin);
      }
      for (int c = 0; c < 3; ++c)
      {
        color[c] += translucency * sample.Alpha * sample.Value.Color[c];
      }
      translucency *= 1 - sample.Alpha;
    }
  }
  for (int c = 0; c < 3; ++c)
  {
    pixel.Rgba[c] = static_cast<double>(color[c]);
  }
  pixel.Rgba[3] = static_cast<double>(1 - translucency);
  pixel.Doubt = static_cast<double>(doubt);
  return pixel;
}

} // namespace

ReferencePixel SampleReferenceRay(const ImageVolume& volume, const ImageOptics& optics,
  const RayGrid& grid, const RayLimits& limits, const ReferenceSlices& slices, int i, int j)
{
  Check(volume, optics);
  const Slabs slabs(volume, grid, slices);
  return SampleRay(volume, optics, grid, limits, slices, slabs, i, j);
}

ReferencePixel IntegrateReferenceRay(const ImageVolume& volume, const ImageOptics& optics,
  const RayGrid& grid, const RayLimits& limits, int i, int j)
{
  Check(volume, optics);
  const ReferenceRay ray = MakeReferenceRay(grid, i, j);
  const ReferenceIntervals parts =
    FindParts(volume, ray, limits, static_cast<std::size_t>(j) * grid.Width + i);
  ReferencePixel pixel;
  AddLengths(parts, pixel);
  Gatherer gatherer;
  for (const auto& part : parts)
  {
    const std::vector<Real> planes = FindGridPlanes(volume, ray, part);
    for (std::size_t p = 0; p + 1 < planes.size(); ++p)
    {
      const Real begin = planes[p];
      const Real length = planes[p + 1] - begin;
      const Trilinear cell(volume, GetPoint(ray, begin + length / 2));
      if (!(length > 0) || cell.Empty)
      {
        continue;
      }
      const Cubic cubic = MakeCubic(cell, GetPoint(ray, begin), GetPoint(ray, planes[p + 1]));
      const std::vector<Real> ends = FindPieces(cubic, optics.Function);
      for (std::size_t k = 0; k + 1 < ends.size(); ++k)
      {
        if (!(ends[k] < ends[k + 1]))
        {
          continue;
        }
        const Piece piece(optics, cubic, ends[k], ends[k + 1], length / optics.UnitDistance);
        if (piece.IsVisible() && pixel.Depth < 0)
        {
          pixel.Depth = static_cast<double>(begin + ends[k] * length);
        }
        gatherer.Add(piece);
      }
    }
  }
  gatherer.GetRgba(pixel.Rgba);
  return pixel;
}

std::vector<ReferencePixel> SampleReferenceImage(const ImageVolume& volume,
  const ImageOptics& optics, const RayGrid& grid, const RayLimits& limits,
  const ReferenceSlices& slices)
{
  Check(volume, optics);
  const Slabs slabs(volume, grid, slices);
  return RenderPixels(grid,
    [&](int i, int j) { return SampleRay(volume, optics, grid, limits, slices, slabs, i, j); });
}

std::vector<ReferencePixel> IntegrateReferenceImage(const ImageVolume& volume,
  const ImageOptics& optics, const RayGrid& grid, const RayLimits& limits)
{
  Check(volume, optics);
  return RenderPixels(
    grid, [&](int i, int j) { return IntegrateReferenceRay(volume, optics, grid, limits, i, j); });
}

} // namespace tetralux
