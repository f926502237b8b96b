// SPDX-License-Identifier: BSD-3-Clause
#include "ImageIntegral/ImageIntegral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include <omp.h>

namespace tetralux
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Both halves of a stretch and the whole agree to this. Gauss-Legendre's error falls by 2^8 with
/// each halving, so what is added is off by far less; some hundred stretches of a ray add up.
constexpr double StretchError = 1e-10;

/// Rays end at a translucency of this.
constexpr double LeastTranslucency = 0.1 * ImageIntegralError;

/// A stretch of a cell that was divided as often is a point: what is left of it is below rounding.
constexpr int MostDivisions = 40;

/// Gauss-Legendre of four points on 0..1.
struct FourPoints
{
  static constexpr int Count = 4;
  std::array<double, Count> Places;
  std::array<double, Count> Weights;
  /// The integral from 0 to place i of the cubic polynomial through values at all places is the sum
  /// of Partial[i][j] times value j.
  std::array<std::array<double, Count>, Count> Partial;

  FourPoints()
  {
    const double inner = std::sqrt(3. / 7 - 2. / 7 * std::sqrt(6. / 5));
    const double outer = std::sqrt(3. / 7 + 2. / 7 * std::sqrt(6. / 5));
    const double innerWeight = (18 + std::sqrt(30.)) / 72;
    const double outerWeight = (18 - std::sqrt(30.)) / 72;
    this->Places = { 0.5 - 0.5 * outer, 0.5 - 0.5 * inner, 0.5 + 0.5 * inner, 0.5 + 0.5 * outer };
    this->Weights = { outerWeight, innerWeight, innerWeight, outerWeight };
    for (int i = 0; i < Count; ++i)
    {
      for (int j = 0; j < Count; ++j)
      {
        this->Partial[i][j] = 0;
        for (int k = 0; k < Count; ++k)
        {
          this->Partial[i][j] += this->Places[i] * this->Weights[k] *
            this->FindBase(j, this->Places[i] * this->Places[k]);
        }
      }
    }
  }

private:
  /// The polynomial that is 1 at place j and 0 at the others.
  double FindBase(int j, double x) const
  {
    double product = 1;
    for (int k = 0; k < Count; ++k)
    {
      product *= k == j ? 1 : (x - this->Places[k]) / (this->Places[j] - this->Places[k]);
    }
    return product;
  }
};

const FourPoints Rule;

/// A cubic polynomial over 0..1 in Bernstein form: it is within the range of its coefficients.
using Cubic = std::array<double, 4>;

/// What is in front of x and behind it (de Casteljau).
void Divide(const Cubic& whole, double x, Cubic& front, Cubic& back)
{
  const auto mix = [x](double a, double b) { return a + x * (b - a); };
  const double ab = mix(whole[0], whole[1]);
  const double bc = mix(whole[1], whole[2]);
  const double cd = mix(whole[2], whole[3]);
  const double abc = mix(ab, bc);
  const double bcd = mix(bc, cd);
  const double middle = mix(abc, bcd);
  front = { whole[0], ab, abc, middle };
  back = { middle, bcd, cd, whole[3] };
}

double Evaluate(const Cubic& cubic, double x)
{
  const double y = 1 - x;
  return y * y * (y * cubic[0] + 3 * x * cubic[1]) + x * x * (3 * y * cubic[2] + x * cubic[3]);
}

/// Divides a monotone one where it has a value between those of its ends.
double DivideAt(const Cubic& whole, double value, Cubic& front, Cubic& back)
{
  const bool ascends = whole[0] < whole[3];
  double low = 0;
  double high = 1;
  for (double x = 0.5; x > low && x < high; x = 0.5 * (low + high))
  {
    ((Evaluate(whole, x) < value) == ascends ? low : high) = x;
  }
  Divide(whole, low, front, back);
  // Not past the value by rounding.
  for (double& coefficient : front)
  {
    coefficient = ascends ? std::min(coefficient, value) : std::max(coefficient, value);
  }
  for (double& coefficient : back)
  {
    coefficient = ascends ? std::max(coefficient, value) : std::min(coefficient, value);
  }
  front[3] = back[0] = value;
  return low;
}

/// Colour, and the attenuation of a unit distance.
struct Optics
{
  std::array<double, 3> Color;
  double Attenuation;
};

/// The transfer function.
class Function
{
public:
  explicit Function(const ImageOptics& optics)
    : Nodes(optics.Function.Nodes)
    , Power(optics.Opacity == StepOpacity::Power)
  {
  }

  /// The scalar of the middle one of the nodes between two scalars, and not at either; not a number
  /// if there is none.
  double FindBend(double low, double high) const
  {
    const auto first = std::upper_bound(this->Nodes.begin(), this->Nodes.end(), low,
      [](double scalar, const TransferFunction::Node& node) { return scalar < node.Scalar; });
    const auto last = std::lower_bound(first, this->Nodes.end(), high,
      [](const TransferFunction::Node& node, double scalar) { return node.Scalar < scalar; });
    return first < last ? (first + (last - first) / 2)->Scalar
                        : std::numeric_limits<double>::quiet_NaN();
  }

  /// Whether a scalar from low to high is opaque in any way.
  bool IsVisible(double low, double high) const
  {
    if (this->GetOpacity(low) > 0 || this->GetOpacity(high) > 0)
    {
      return true;
    }
    return std::any_of(this->Nodes.begin(), this->Nodes.end(),
      [&](const TransferFunction::Node& node)
      {
        return low <= node.Scalar && node.Scalar <= high &&
          (node.Left.Attenuation > 0 || node.Right.Attenuation > 0);
      });
  }

  Optics Get(double scalar) const
  {
    const TransferFunction::Value value = this->Interpolate(scalar);
    const double opacity = value.Attenuation;
    return { { value.Color[0], value.Color[1], value.Color[2] },
      !this->Power    ? opacity
        : opacity < 1 ? -std::log1p(-opacity)
                      : Infinity };
  }

private:
  TransferFunction::Value Interpolate(double scalar) const
  {
    const auto above = std::upper_bound(this->Nodes.begin(), this->Nodes.end(), scalar,
      [](double s, const TransferFunction::Node& node) { return s < node.Scalar; });
    if (above == this->Nodes.begin())
    {
      return above->Left;
    }
    const TransferFunction::Node& below = *(above - 1);
    if (above == this->Nodes.end())
    {
      return below.Right;
    }
    const double t = (scalar - below.Scalar) / (above->Scalar - below.Scalar);
    TransferFunction::Value value = below.Right;
    for (int c = 0; c < 3; ++c)
    {
      value.Color[c] += t * (above->Left.Color[c] - value.Color[c]);
    }
    value.Attenuation += t * (above->Left.Attenuation - value.Attenuation);
    return value;
  }
  double GetOpacity(double scalar) const { return this->Interpolate(scalar).Attenuation; }

  const std::vector<TransferFunction::Node>& Nodes;
  bool Power;
};

/// What a stretch emits and absorbs.
struct Gathered
{
  std::array<double, 3> Color = { 0, 0, 0 };
  double Depth = 0;

  void Append(const Gathered& back)
  {
    const double translucency = std::exp(-this->Depth);
    for (int c = 0; c < 3; ++c)
    {
      this->Color[c] += translucency * back.Color[c];
    }
    this->Depth += back.Depth;
  }
};

/// length: unit distances.
Gathered ApplyRule(const Function& function, const Cubic& scalars, double length)
{
  std::array<Optics, FourPoints::Count> optics;
  for (int i = 0; i < FourPoints::Count; ++i)
  {
    optics[i] = function.Get(Evaluate(scalars, Rule.Places[i]));
    if (optics[i].Attenuation == Infinity)
    {
      // What is opaque in any length is so from its begin on.
      return { function.Get(Evaluate(scalars, 0)).Color, Infinity };
    }
  }
  Gathered gathered;
  for (int i = 0; i < FourPoints::Count; ++i)
  {
    double front = 0;
    for (int j = 0; j < FourPoints::Count; ++j)
    {
      front += Rule.Partial[i][j] * optics[j].Attenuation;
    }
    const double depth = length * Rule.Weights[i] * optics[i].Attenuation;
    const double seen = depth * std::exp(-length * front);
    for (int c = 0; c < 3; ++c)
    {
      gathered.Color[c] += seen * optics[i].Color[c];
    }
    gathered.Depth += depth;
  }
  return gathered;
}

/// The largest difference of a channel.
double Compare(const Gathered& a, const Gathered& b)
{
  double error = std::abs(std::exp(-a.Depth) - std::exp(-b.Depth));
  for (int c = 0; c < 3; ++c)
  {
    error = std::max(error, std::abs(a.Color[c] - b.Color[c]));
  }
  return error;
}

/// Adds a stretch of a ray within one cell.
void Integrate(
  const Function& function, const Cubic& scalars, double length, int divisions, Gathered& ray)
{
  const auto [low, high] = std::minmax_element(scalars.begin(), scalars.end());
  const double translucency = std::exp(-ray.Depth);
  if (!function.IsVisible(*low, *high) || translucency < LeastTranslucency)
  {
    return;
  }
  Cubic front, back;
  const double bend = function.FindBend(*low, *high);
  const bool monotone = std::is_sorted(scalars.begin(), scalars.end()) ||
    std::is_sorted(scalars.rbegin(), scalars.rend());
  if (!std::isnan(bend) && monotone && divisions > 0)
  {
    const double place = DivideAt(scalars, bend, front, back);
    Integrate(function, front, place * length, divisions - 1, ray);
    Integrate(function, back, (1 - place) * length, divisions - 1, ray);
    return;
  }
  Divide(scalars, 0.5, front, back);
  if (divisions == 0 || std::isnan(bend))
  {
    Gathered halves = ApplyRule(function, front, 0.5 * length);
    halves.Append(ApplyRule(function, back, 0.5 * length));
    const Gathered whole = ApplyRule(function, scalars, length);
    // Of a large depth all points could be deep within it.
    const bool thin = whole.Depth <= 1 || whole.Depth == Infinity;
    if (divisions == 0 || (thin && translucency * Compare(whole, halves) <= StretchError))
    {
      ray.Append(halves);
      return;
    }
  }
  Integrate(function, front, 0.5 * length, divisions - 1, ray);
  Integrate(function, back, 0.5 * length, divisions - 1, ray);
}

/// A volume's scalars along rays.
class Field
{
public:
  explicit Field(const ImageVolume& volume)
    : Volume(volume)
  {
  }

  /// The scalars on the way from one point of a cell to another, in coordinates of the volume.
  /// Returns whether the cell has any.
  bool FindScalars(const std::array<int, 3>& cell, const std::array<double, 3>& from,
    const std::array<double, 3>& to, Cubic& scalars) const
  {
    // The polynomial's polar form: coefficient b is the mean, over the ways to take b of the three
    // axes at the end and the others at the begin, of the trilinear scalar.
    double corners[8];
    for (int corner = 0; corner < 8; ++corner)
    {
      corners[corner] = this->GetScalar(
        cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2));
      if (!std::isfinite(corners[corner]))
      {
        return false;
      }
    }
    scalars = { 0, 0, 0, 0 };
    for (int ends = 0; ends < 8; ++ends)
    {
      double values[8];
      std::copy(corners, corners + 8, values);
      int count = 0;
      for (int a = 2, size = 4; a >= 0; --a, size /= 2)
      {
        const bool atEnd = (ends >> a & 1) != 0;
        count += atEnd ? 1 : 0;
        const double place = std::clamp((atEnd ? to[a] : from[a]) - cell[a], 0., 1.);
        for (int k = 0; k < size; ++k)
        {
          values[k] += place * (values[k + size] - values[k]);
        }
      }
      scalars[count] += count == 0 || count == 3 ? values[0] : values[0] / 3;
    }
    // No scalar of the cell is beyond those of its corners, by rounding neither: what is opaque in
    // any length would begin there.
    const auto [low, high] = std::minmax_element(corners, corners + 8);
    for (double& scalar : scalars)
    {
      scalar = std::clamp(scalar, *low, *high);
    }
    return true;
  }

private:
  double GetScalar(int i, int j, int k) const
  {
    const int* size = this->Volume.Dimensions;
    const std::size_t at = i + size[0] * (j + static_cast<std::size_t>(size[1]) * k);
    const void* values = this->Volume.Values;
    double value = 0;
    switch (this->Volume.Type)
    {
      case ImageScalar::Int8:
        value = static_cast<const std::int8_t*>(values)[at];
        break;
      case ImageScalar::UInt8:
        value = static_cast<const std::uint8_t*>(values)[at];
        break;
      case ImageScalar::Int16:
        value = static_cast<const std::int16_t*>(values)[at];
        break;
      case ImageScalar::UInt16:
        value = static_cast<const std::uint16_t*>(values)[at];
        break;
      case ImageScalar::Float:
        value = static_cast<const float*>(values)[at];
        break;
    }
    return this->Volume.Offset + this->Volume.Scale * value;
  }

  const ImageVolume& Volume;
};

/// The ray of a pixel in coordinates of the volume: Start + t Step, t in world units.
struct Ray
{
  std::array<double, 3> Start, Step;

  Ray(const RayGrid& grid, int i, int j)
  {
    double start[3], direction[3];
    for (int a = 0; a < 3; ++a)
    {
      start[a] = grid.Origin[a] + i * grid.OriginStepX[a] + j * grid.OriginStepY[a];
      direction[a] = grid.Direction[a] + i * grid.DirectionStepX[a] + j * grid.DirectionStepY[a];
    }
    const double length = std::hypot(direction[0], direction[1], direction[2]);
    for (int a = 0; a < 3; ++a)
    {
      const double* row = grid.MeshFromWorld[a];
      this->Start[a] = row[3];
      this->Step[a] = 0;
      for (int b = 0; b < 3; ++b)
      {
        this->Start[a] += row[b] * start[b];
        this->Step[a] += row[b] * direction[b] / length;
      }
    }
  }

  std::array<double, 3> GetPoint(double t) const
  {
    return { this->Start[0] + t * this->Step[0], this->Start[1] + t * this->Step[1],
      this->Start[2] + t * this->Step[2] };
  }
};

Gathered IntegrateRay(
  const ImageVolume& volume, const Function& function, double unitDistance, const Ray& ray)
{
  double begin = 0;
  double end = Infinity;
  for (int a = 0; a < 3; ++a)
  {
    const double last = volume.Dimensions[a] - 1;
    const double low = -ray.Start[a] / ray.Step[a];
    const double high = (last - ray.Start[a]) / ray.Step[a];
    if (ray.Step[a] != 0)
    {
      begin = std::max(begin, std::min(low, high));
      end = std::min(end, std::max(low, high));
    }
    else if (ray.Start[a] < 0 || ray.Start[a] > last)
    {
      end = begin;
    }
  }
  const Field field(volume);
  Gathered gathered;
  std::array<double, 3> point = ray.GetPoint(begin);
  std::array<int, 3> cell;
  for (int a = 0; a < 3 && begin < end; ++a)
  {
    // On a plane between two cells the ray goes into the next one.
    const double place = ray.Step[a] < 0 ? std::ceil(point[a]) - 1 : std::floor(point[a]);
    cell[a] = static_cast<int>(std::clamp<double>(place, 0, volume.Dimensions[a] - 2));
  }
  for (double t = begin; t < end && std::exp(-gathered.Depth) >= LeastTranslucency;)
  {
    double next = end;
    int axis = -1;
    for (int a = 0; a < 3; ++a)
    {
      const double plane = cell[a] + (ray.Step[a] > 0 ? 1 : 0);
      const double crossing = (plane - ray.Start[a]) / ray.Step[a];
      if (ray.Step[a] != 0 && crossing < next)
      {
        next = crossing;
        axis = a;
      }
    }
    if (next > t)
    {
      const std::array<double, 3> to = ray.GetPoint(next);
      Cubic scalars;
      if (field.FindScalars(cell, point, to, scalars))
      {
        Integrate(function, scalars, (next - t) / unitDistance, MostDivisions, gathered);
      }
      point = to;
      t = next;
    }
    if (axis < 0)
    {
      break;
    }
    cell[axis] += ray.Step[axis] > 0 ? 1 : -1;
    if (cell[axis] < 0 || cell[axis] > volume.Dimensions[axis] - 2)
    {
      break;
    }
  }
  return gathered;
}

void Check(const ImageVolume& volume, const ImageOptics& optics)
{
  if (volume.Components != 1 || volume.Labels || volume.Mask || volume.PointFlags ||
    volume.CellFlags)
  {
    throw std::invalid_argument("the integral is one of a single component that nothing hides");
  }
  if (optics.Blend != ImageBlend::Composite || !optics.GradientOpacity.Nodes.empty() ||
    !optics.Table.Entries.empty() || optics.Function.Nodes.empty())
  {
    throw std::invalid_argument(
      "the integral is one of what emits and absorbs, by a function of the scalar");
  }
}

} // namespace

std::vector<double> IntegrateImage(
  const ImageVolume& volume, const ImageOptics& optics, const RayGrid& grid, int threads)
{
  Check(volume, optics);
  const Function function(optics);
  std::vector<double> pixels(4 * static_cast<std::size_t>(grid.Width) * grid.Height);
  const int used = threads > 0 ? threads : omp_get_max_threads();
#pragma omp parallel for num_threads(used) schedule(dynamic)
  for (int j = 0; j < grid.Height; ++j)
  {
    for (int i = 0; i < grid.Width; ++i)
    {
      const Gathered gathered =
        IntegrateRay(volume, function, optics.UnitDistance, Ray(grid, i, j));
      double* pixel = &pixels[4 * (static_cast<std::size_t>(j) * grid.Width + i)];
      std::copy(gathered.Color.begin(), gathered.Color.end(), pixel);
      pixel[3] = -std::expm1(-gathered.Depth);
    }
  }
  return pixels;
}

} // namespace tetralux
