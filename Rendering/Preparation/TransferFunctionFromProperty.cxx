// SPDX-License-Identifier: BSD-3-Clause
#include "Preparation/TransferFunctionFromProperty.h"

#include "Preparation/FunctionChunks.h"
#include "Preparation/ValueCurve.h"
#include "Preparation/ValueInterpolant.h"

#include "vtkColorTransferFunction.h"
#include "vtkPiecewiseFunction.h"
#include "vtkSmartPointer.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace tetralux
{
namespace
{

using Value = TransferFunction::Value;

/// Offset from a break at which its one-sided limits are taken, in fractions of the interval and of
/// the scalar: beyond the rounding of VTK's logarithms, below that of single precision.
constexpr double LimitOffset = 1e-9;

/// The smallest step that is one, in fractions of the values around: the rounding of the tables,
/// which are in single precision, and more than a slope makes of LimitOffset.
constexpr double SmallestStep = 1e-7;

/// How often an interval is halved at most: down to the rounding of single precision.
constexpr int MaximumHalvings = 24;

/// Parts of an interval between which it is compared with the line through its ends, and with a
/// curve: S-shaped curves meet that line in the middle.
constexpr int Parts = 8;

/// After how many halvings every other of these places is enough for a line, and polynomials are no
/// longer tried: what is not smooth by then has a kink.
constexpr int SmoothHalvings = 3;

/// Of the error of a function, what colours take.
constexpr double ShareOfColors = 3. / 4;

/// Share of an error that a curve through a few values may be off by. There are two, one through
/// values of VTK and one through values of that; lines along the second one take the rest.
constexpr double ShareOfCurve = 1. / 16;
constexpr double ShareOfLines = 1 - 2 * ShareOfCurve;

/// More lines than that are not made of one curve; nor are more lines than parts where colours come
/// near 1 or are dark: kinks between two values, where VTK cuts colours off and where gamma curves
/// begin, are seen at none of them.
constexpr double MostLines = 64;
constexpr double DarkColor = 0.06; // sRGB's gamma curve begins at 0.04

/// Whether VTK interpolates between the logarithms of scalars.
bool IsLogarithmic(vtkColorTransferFunction* function)
{
  return function->GetScale() == VTK_CTF_LOG10 && function->GetRange()[0] > 0;
}

/// Colours taken of each interval in the one colour space that VTK searches a path through the
/// space for: at every call, for a tenth of a second.
constexpr int SearchedColors = 1024;

/// What is thicker than this is opaque long before; products of it with colours and lengths are
/// within single precision.
constexpr double LargestOpticalDepth = 1e15;

/// A function with linear intervals that goes through SearchedColors colours of each interval.
/// Paths begin and end near the colours of the nodes, not at them.
vtkSmartPointer<vtkColorTransferFunction> SearchOnce(vtkColorTransferFunction* function)
{
  auto result = vtkSmartPointer<vtkColorTransferFunction>::New();
  result->DeepCopy(function);
  result->RemoveAllPoints();
  result->SetColorSpaceToRGB();
  result->SetScaleToLinear();
  result->AllowDuplicateScalarsOn();
  const bool logarithmic = IsLogarithmic(function);
  std::vector<double> colors(3 * (SearchedColors + 1));
  double previous = 0;
  for (int i = 0; i < function->GetSize(); ++i)
  {
    double node[6];
    function->GetNodeValue(i, node);
    if (i > 0 && previous < node[0])
    {
      function->GetTable(previous, node[0], SearchedColors + 1, colors.data());
      result->AddRGBPoint(previous, colors[3], colors[4], colors[5]);
      for (int k = 1; k <= SearchedColors; ++k)
      {
        const double t = static_cast<double>(k) / SearchedColors;
        const double scalar = logarithmic ? previous * std::pow(node[0] / previous, t)
                                          : previous + t * (node[0] - previous);
        result->AddRGBPoint(scalar, colors[3 * k], colors[3 * k + 1], colors[3 * k + 2]);
      }
    }
    if (i == 0 || i == function->GetSize() - 1)
    {
      result->AddRGBPoint(node[0], node[1], node[2], node[3]); // seen outside of the range
    }
    previous = node[0];
  }
  return result;
}

/// A property's functions, evaluated as VTK does.
class PropertyFunctions
{
public:
  PropertyFunctions(vtkVolumeProperty* property, int component, double longestPath)
    : Opacity(property->GetScalarOpacity(component))
    , Color(property->GetColorChannels(component) == 3 ? property->GetRGBTransferFunction(component)
                                                       : nullptr)
    , Grey(this->Color ? nullptr : property->GetGrayTransferFunction(component))
    , UnitDistance(property->GetScalarOpacityUnitDistance(component))
    , LargestAttenuation(longestPath > 0 ? LargestOpticalDepth / longestPath
                                         : std::numeric_limits<double>::infinity())
  {
    if (!(this->UnitDistance > 0) || !std::isfinite(this->UnitDistance))
    {
      throw std::invalid_argument("ScalarOpacityUnitDistance is " +
        std::to_string(this->UnitDistance) + ", it must be a positive number");
    }
    if (this->Color && this->Color->GetColorSpace() == VTK_CTF_LAB_CIEDE2000)
    {
      this->Color = SearchOnce(this->Color);
    }
    this->OpacityChunks.emplace(this->Opacity, this->Opacity->GetUseLogScale());
    if (this->Color)
    {
      this->ColorChunks.emplace(this->Color.Get(), IsLogarithmic(this->Color));
    }
    else
    {
      this->GreyChunks.emplace(this->Grey, this->Grey->GetUseLogScale());
    }
  }

  Value Evaluate(double scalar) const
  {
    Value value;
    if (this->Color)
    {
      // There is no logarithm below 0: it is below the range, too.
      const double below = (1 - LimitOffset) * this->Color->GetRange()[0];
      const double x = IsLogarithmic(this->Color) ? std::max(scalar, below) : scalar;
      this->ColorChunks->Evaluate(x, value.Color);
    }
    else
    {
      this->GreyChunks->Evaluate(scalar, value.Color);
      value.Color[1] = value.Color[2] = value.Color[0];
    }
    double opacity = 0;
    this->OpacityChunks->Evaluate(scalar, &opacity);
    value.Attenuation =
      std::min(std::max(opacity, 0.) / this->UnitDistance, this->LargestAttenuation);
    if (!std::isfinite(value.Color[0]) || !std::isfinite(value.Color[1]) ||
      !std::isfinite(value.Color[2]) || !std::isfinite(opacity))
    {
      throw std::invalid_argument("colour or opacity of the volume property is not a finite number "
                                  "at scalar " +
        std::to_string(scalar));
    }
    for (const double channel : value.Color)
    {
      if (std::abs(channel) > LargestColor)
      {
        std::ostringstream error;
        error << "a colour of the volume property is " << channel << " at scalar " << scalar
              << ", and at most " << LargestColor << " can be drawn";
        throw std::invalid_argument(error.str());
      }
    }
    return value;
  }

  /// The limit at a break from the side of the neighbouring break: VTK's value at the break where
  /// that is continuous. at, far: VTK's values at both.
  Value GetLimit(double scalar, const Value& at, double neighbour, const Value& far) const
  {
    const double offset = LimitOffset * std::min(std::abs(neighbour - scalar), std::abs(scalar));
    const double next = std::nextafter(scalar, neighbour);
    const double x =
      neighbour > scalar ? std::max(scalar + offset, next) : std::min(scalar - offset, next);
    const Value beyond = this->Evaluate(x);
    // Where an interval has but few numbers, a slope goes a good way from one to the next.
    const double share = SmallestStep + 4 * (x - scalar) / (neighbour - scalar);
    const auto choose = [share](double a, double b, double c)
    {
      const double size = std::max({ std::abs(a), std::abs(b), std::abs(c) });
      return std::abs(a - b) > share * size ? b : a;
    };
    Value limit;
    for (int c = 0; c < 3; ++c)
    {
      limit.Color[c] = choose(at.Color[c], beyond.Color[c], far.Color[c]);
    }
    limit.Attenuation = choose(at.Attenuation, beyond.Attenuation, far.Attenuation);
    return limit;
  }

  /// Where the functions may bend or step, ascending, each once; at least one.
  std::vector<double> GetBreaks() const
  {
    std::vector<double> breaks;
    AddBreaks<4>(this->Opacity, this->Opacity->GetUseLogScale(), breaks);
    if (this->Color)
    {
      AddBreaks<6>(this->Color.Get(), IsLogarithmic(this->Color), breaks);
    }
    else
    {
      AddBreaks<4>(this->Grey, this->Grey->GetUseLogScale(), breaks);
    }
    if (breaks.empty())
    {
      breaks.push_back(0);
    }
    std::sort(breaks.begin(), breaks.end());
    breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
    return breaks;
  }

private:
  /// A function's nodes, and the midpoints between them that are not in the middle or are steps.
  template <int NodeSize, class Function>
  static void AddBreaks(Function* function, bool logarithmic, std::vector<double>& breaks)
  {
    std::array<double, NodeSize> node{};
    std::array<double, NodeSize> previous{};
    for (int i = 0; i < function->GetSize(); ++i)
    {
      function->GetNodeValue(i, node.data());
      if (!std::isfinite(node[0]))
      {
        throw std::invalid_argument(
          "a function of the volume property has a node whose scalar is not a finite number");
      }
      const double x0 = previous[0];
      const double x1 = node[0];
      if (i > 0 && x0 < x1)
      {
        const double midpoint = std::clamp(previous[NodeSize - 2], 0.00001, 0.99999); // as in VTK
        const double sharpness = previous[NodeSize - 1];
        if (midpoint != 0.5 || sharpness > 0)
        {
          breaks.push_back(x0 + midpoint * (x1 - x0));
          if (logarithmic && x0 > 0)
          {
            breaks.push_back(x0 * std::pow(x1 / x0, midpoint));
          }
        }
      }
      breaks.push_back(x1);
      previous = node;
    }
  }

  vtkPiecewiseFunction* Opacity;
  vtkSmartPointer<vtkColorTransferFunction> Color;
  vtkPiecewiseFunction* Grey;
  std::optional<FunctionChunks<vtkPiecewiseFunction>> OpacityChunks;
  std::optional<FunctionChunks<vtkColorTransferFunction>> ColorChunks;
  std::optional<FunctionChunks<vtkPiecewiseFunction>> GreyChunks;
  double UnitDistance;
  double LargestAttenuation;
};

/// How far an approximation may be off: an error c of the colour is one of at most c in the
/// picture; an attenuation that is off by a share s, and by a on top, changes an optical depth D by
/// s D + a longestPath, and the picture by at most s D exp(-D) + a longestPath < s / 2 + a
/// longestPath. Colours take most of it, as opacities mostly are lines.
struct Tolerance
{
  double Color;
  double AttenuationShare;
  double Attenuation;

  Tolerance(double maximumError, double longestPath)
    : Color(ShareOfColors * maximumError)
    , AttenuationShare((1 - ShareOfColors) * maximumError)
    , Attenuation((1 - ShareOfColors) * maximumError / 2 / longestPath)
  {
  }

  double GetOfColor(double color) const
  {
    return std::max(this->Color, SmallestStep * std::abs(color));
  }

  double GetOfAttenuation(double attenuation) const
  {
    return this->AttenuationShare * attenuation + this->Attenuation;
  }

  /// share: of the tolerance.
  bool Accepts(const Value& exact, const Value& approximation, double share = 1) const
  {
    if (std::abs(exact.Attenuation - approximation.Attenuation) >
      share * this->GetOfAttenuation(exact.Attenuation))
    {
      return false;
    }
    // No colour is seen where nothing attenuates.
    return (exact.Attenuation == 0 && approximation.Attenuation == 0) ||
      std::equal(exact.Color, exact.Color + 3, approximation.Color,
        [this, share](double a, double b)
        { return std::abs(a - b) <= share * this->GetOfColor(a); });
  }
};

Value Interpolate(const Value& a, const Value& b, double t)
{
  Value value;
  for (int c = 0; c < 3; ++c)
  {
    value.Color[c] = (1 - t) * a.Color[c] + t * b.Color[c];
  }
  value.Attenuation = (1 - t) * a.Attenuation + t * b.Attenuation;
  return value;
}

/// A property's functions where they are continuous, from one scalar to another one: their values
/// at both ends and between Parts.
struct Stretch
{
  double X[Parts + 1];
  Value At[Parts + 1];
  bool HasOdd = false; ///< values after an odd number of parts

  double GetBegin() const { return this->X[0]; }
  double GetEnd() const { return this->X[Parts]; }

  double GetScalar(double t) const
  {
    return this->GetBegin() + (this->GetEnd() - this->GetBegin()) * t;
  }

  double GetPlace(double x) const
  {
    return (x - this->GetBegin()) / (this->GetEnd() - this->GetBegin());
  }

  /// Without odd values.
  Stretch TakeHalf(int first) const
  {
    Stretch half;
    for (int part = 0; part <= Parts; part += 2)
    {
      half.X[part] = this->X[first + part / 2];
      half.At[part] = this->At[first + part / 2];
    }
    return half;
  }
};

/// Nodes between the ends of a stretch of a property's functions.
class Subdivision
{
public:
  Subdivision(const PropertyFunctions& functions, const Tolerance& tolerance,
    std::vector<TransferFunction::Node>& nodes)
    : Functions(functions)
    , Allowed(tolerance)
    , Nodes(nodes)
  {
  }

  /// Adds nodes inside of (x0, x1), ascending, until the function is linear between them. Returns
  /// whether any were needed.
  bool Add(double x0, const Value& value0, double x1, const Value& value1)
  {
    Stretch stretch;
    stretch.X[0] = x0;
    stretch.At[0] = value0;
    stretch.X[Parts] = x1;
    stretch.At[Parts] = value1;
    for (int part = 2; part < Parts; part += 2)
    {
      this->Fill(stretch, part, nullptr);
    }
    const std::size_t before = this->Nodes.size();
    this->Divide(stretch, nullptr, 0);
    return this->Nodes.size() > before;
  }

private:
  /// The polynomial through the values of a stretch.
  struct Model
  {
    explicit Model(const Stretch& stretch)
      : Begin(stretch.GetBegin())
      , End(stretch.GetEnd())
      , Polynomial(stretch.At)
      , Inside(std::all_of(stretch.At, stretch.At + Parts + 1,
          [](const Value& value) {
            return std::all_of(
              value.Color, value.Color + 3, [](double c) { return 0 <= c && c <= 1; });
          }))
    {
    }

    /// No error takes a colour out of 0..1 where VTK's are inside, or an attenuation below 0.
    Value Evaluate(double x) const
    {
      Value value = this->Polynomial.Evaluate((x - this->Begin) / (this->End - this->Begin));
      for (double& color : value.Color)
      {
        color = this->Inside ? std::clamp(color, 0., 1.) : color;
      }
      value.Attenuation = std::max(value.Attenuation, 0.);
      return value;
    }

    double Begin;
    double End;
    ValueInterpolant<Parts> Polynomial;
    bool Inside; ///< all colours are in 0..1
  };

  /// model: what is evaluated in place of VTK's functions; nullptr: these. Odd values of the
  /// stretch may not be there yet.
  void Divide(Stretch& stretch, const Model* model, int halvings)
  {
    const double middle = stretch.X[Parts / 2];
    const double share = model ? 1 - ShareOfCurve : 1;
    if (halvings == MaximumHalvings || middle <= stretch.GetBegin() || stretch.GetEnd() <= middle ||
      (halvings >= SmoothHalvings && this->IsLine(stretch, 2, share)))
    {
      return;
    }
    this->FillOdd(stretch, model);
    if (this->IsLine(stretch, 1, share))
    {
      return;
    }
    const ValueCurve curve(
      { stretch.At[0], stretch.At[2], stretch.At[4], stretch.At[6], stretch.At[8] });
    if (this->HasOddValues(stretch, curve, stretch) && this->Follow(stretch, curve))
    {
      return;
    }
    Stretch first = stretch.TakeHalf(0);
    Stretch second = stretch.TakeHalf(Parts / 2);
    std::optional<Model> own;
    if (!model && halvings < SmoothHalvings)
    {
      own.emplace(stretch);
      this->FillOdd(first, nullptr);
      this->FillOdd(second, nullptr);
      if (this->HasOddValues(stretch, own->Polynomial, first) &&
        this->HasOddValues(stretch, own->Polynomial, second))
      {
        model = &*own;
      }
    }
    this->Divide(first, model, halvings + 1);
    this->Nodes.push_back({ middle, stretch.At[Parts / 2], stretch.At[Parts / 2] });
    this->Divide(second, model, halvings + 1);
  }

  /// Whether the line from end to end is near enough, at every value or every other one.
  bool IsLine(const Stretch& stretch, int step, double share) const
  {
    const auto isNear = [&](int part)
    {
      const Value line =
        Interpolate(stretch.At[0], stretch.At[Parts], stretch.GetPlace(stretch.X[part]));
      return this->Allowed.Accepts(stretch.At[part], line, share);
    };
    // The middle first: there most are too far off.
    bool near = isNear(Parts / 2);
    for (int part = step; part < Parts && near; part += step)
    {
      near = part == Parts / 2 || isNear(part);
    }
    return near;
  }

  /// Whether a curve along a stretch has every other value of the stretch or of a half of it.
  template <class Curve>
  bool HasOddValues(const Stretch& whole, const Curve& curve, const Stretch& part) const
  {
    for (int k = 1; k < Parts; k += 2)
    {
      if (!this->Allowed.Accepts(
            part.At[k], curve.Evaluate(whole.GetPlace(part.X[k])), ShareOfCurve))
      {
        return false;
      }
    }
    return true;
  }

  void FillOdd(Stretch& stretch, const Model* model) const
  {
    for (int part = 1; part < Parts && !stretch.HasOdd; part += 2)
    {
      this->Fill(stretch, part, model);
    }
    stretch.HasOdd = true;
  }

  /// Those at the ends are limits, and next to them there may be no further scalar.
  void Fill(Stretch& stretch, int part, const Model* model) const
  {
    const double x = stretch.GetScalar(static_cast<double>(part) / Parts);
    stretch.X[part] = x;
    stretch.At[part] = x <= stretch.GetBegin() ? stretch.At[0]
      : x >= stretch.GetEnd()                  ? stretch.At[Parts]
      : model                                  ? model->Evaluate(x)
                                               : this->Functions.Evaluate(x);
  }

  /// Adds as many nodes on a curve, evenly apart, as it takes for lines between them to be near
  /// enough, unless they are too many.
  bool Follow(const Stretch& stretch, const ValueCurve& curve)
  {
    double low[ValueCurve::Channels];
    double high[ValueCurve::Channels];
    double lines = 0;
    double most = MostLines;
    for (int c = 0; c < ValueCurve::Channels; ++c)
    {
      const auto isLess = [c](const Value& a, const Value& b)
      { return ValueCurve::Get(a, c) < ValueCurve::Get(b, c); };
      const auto ends = std::minmax_element(stretch.At, stretch.At + Parts + 1, isLess);
      low[c] = ValueCurve::Get(*ends.first, c);
      high[c] = ValueCurve::Get(*ends.second, c);
      // Values in between may be somewhat nearer to 0.
      const double small = 0.5 * std::max({ low[c], -high[c], 0. });
      const double tolerance = ShareOfLines *
        (c < 3 ? this->Allowed.GetOfColor(small) : this->Allowed.GetOfAttenuation(small));
      const double bend = curve.GetLargestBend(c);
      lines = std::max(lines, std::sqrt(bend / (8 * tolerance)));
      const double beyond = bend / (8 * Parts * Parts); // values, in between
      most = c < 3 && (low[c] < DarkColor + beyond || 1 < high[c] + beyond) ? Parts : most;
    }
    lines = std::ceil(lines);
    if (!(lines <= most))
    {
      return false;
    }
    // No error of the curve takes a colour out of 0..1 where VTK's is inside.
    const auto getColor = [&](int c, double t)
    {
      const double color = curve.Evaluate(c, t);
      const double inside = std::clamp(color, 0., 1.);
      return 0 <= low[c] && high[c] <= 1 && std::abs(color - inside) <= this->Allowed.Color ? inside
                                                                                            : color;
    };
    for (double i = 1; i < lines; ++i)
    {
      const double t = i / lines;
      const double x = stretch.GetScalar(t);
      if (this->Nodes.back().Scalar < x && x < stretch.GetEnd())
      {
        const Value value{ { getColor(0, t), getColor(1, t), getColor(2, t) },
          std::max(curve.Evaluate(3, t), 0.) };
        this->Nodes.push_back({ x, value, value });
      }
    }
    return true;
  }

  const PropertyFunctions& Functions;
  const Tolerance& Allowed;
  std::vector<TransferFunction::Node>& Nodes;
};

/// Nodes of some intervals between breaks.
struct Block
{
  std::vector<TransferFunction::Node> Nodes; ///< the first one without its Left
  Value LastLeft{};                          ///< of the node after the last interval
  bool IsDivided = false;
  std::exception_ptr Failure;
};

/// Intervals of a block: their functions are evaluated some thousand times.
constexpr std::size_t BlockSize = 64;

/// begin, end: breaks from the first interval to the end of the last one.
Block MakeBlock(const PropertyFunctions& functions, const Tolerance& tolerance, const double* begin,
  const double* end)
{
  Block block;
  try
  {
    Subdivision subdivision(functions, tolerance, block.Nodes);
    Value at = functions.Evaluate(*begin);
    for (const double* x = begin; x != end; ++x)
    {
      const Value nextAt = functions.Evaluate(x[1]);
      const Value right = functions.GetLimit(x[0], at, x[1], nextAt);
      const Value nextLeft = functions.GetLimit(x[1], nextAt, x[0], at);
      block.Nodes.push_back({ x[0], block.LastLeft, right });
      block.IsDivided = subdivision.Add(x[0], right, x[1], nextLeft) || block.IsDivided;
      block.LastLeft = nextLeft;
      at = nextAt;
    }
  }
  catch (...)
  {
    block.Failure = std::current_exception(); // none may leave a parallel loop
  }
  return block;
}

} // namespace

PropertyTransferFunction TransferFunctionFromProperty(
  vtkVolumeProperty* property, double maximumError, double longestPath, int component)
{
  const PropertyFunctions functions(property, component, longestPath);
  const Tolerance tolerance(maximumError, longestPath);
  const std::vector<double> breaks = functions.GetBreaks();

  // VTK only reads its functions when they are evaluated.
  const std::size_t intervals = breaks.size() - 1;
  const auto count = static_cast<std::ptrdiff_t>((intervals + BlockSize - 1) / BlockSize);
  std::vector<Block> blocks(static_cast<std::size_t>(count));
#pragma omp parallel for schedule(dynamic) if (count > 1)
  for (std::ptrdiff_t k = 0; k < count; ++k)
  {
    const std::size_t first = static_cast<std::size_t>(k) * BlockSize;
    blocks[k] = MakeBlock(functions, tolerance, breaks.data() + first,
      breaks.data() + std::min(first + BlockSize, intervals));
  }

  PropertyTransferFunction result;
  std::vector<TransferFunction::Node>& nodes = result.Function.Nodes;
  std::size_t size = 1;
  for (const Block& block : blocks)
  {
    if (block.Failure)
    {
      std::rethrow_exception(block.Failure);
    }
    size += block.Nodes.size();
    result.Error = block.IsDivided ? maximumError : result.Error;
  }
  nodes.reserve(size);
  // Outside of all nodes functions are constant; a place there that logarithms can be taken of,
  // too.
  const double last = breaks.back();
  const auto margin = [](double x) { return x == 0 ? 1 : 1e-6 * std::abs(x); };
  Value left = functions.Evaluate(breaks.front() - margin(breaks.front()));
  for (Block& block : blocks)
  {
    block.Nodes.front().Left = left;
    nodes.insert(nodes.end(), block.Nodes.begin(), block.Nodes.end());
    block.Nodes = {}; // they may be millions
    left = block.LastLeft;
  }
  nodes.push_back({ last, left, functions.Evaluate(last + margin(last)) });
  return result;
}

void RemoveUnitDistance(TransferFunction& function, double unitDistance)
{
  for (TransferFunction::Node& node : function.Nodes)
  {
    node.Left.Attenuation *= unitDistance;
    node.Right.Attenuation *= unitDistance;
  }
}

} // namespace tetralux
