// SPDX-License-Identifier: BSD-3-Clause
#include "PreIntegration/PreIntegrationBuilder.h"

#include "Integral/SegmentIntegral.h"
#include "Optics/IntervalTable.h"
#include "PreIntegration/PreIntegrationError.h"
#include "PreIntegration/PreIntegrationKernel.h"
#include "Simd/InstructionSet.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <stdexcept>
#include <vector>

namespace tetralux
{
namespace
{

PreIntegrationKernels GetKernels()
{
#ifdef TETRALUX_HAVE_AVX2_KERNEL
  if (GetInstructionSet() == InstructionSet::Avx2)
  {
    return GetPreIntegrationKernelsAvx2();
  }
#endif
  return GetPreIntegrationKernelsGeneric();
}

// ------------------------------------------------------------------------------------------------
// Which lengths the closed form is computed at

/// A smooth function of the length l, with T the optical depth of the part of a segment up to some
/// place per unit of l: a channel is the integral of tau c l exp(-l T), and divided by l it is
/// interpolated at Chebyshev points of [0, l1], of [l1, 2 l1], [2 l1, 4 l1] and so on, where l1 is
/// an optical depth of FirstDepth at most. With K points and h half the width, the error is
///
///   on the first panel   l tau c 2 (h tau / 2)^K / K!     <= 2e-8 of colours up to 1,
///   on the others        2 (l / l1') (h / 2 l1')^K        <= 3e-7, l1' the panel's begin,
///
/// the first from the K-th derivative of exp(-l T), at most tau^K; the second from its integral over
/// T, at most K! / l1'^(K + 1). Both hold for every segment, since they know but the largest
/// attenuation.
constexpr int PointsPerPanel = 12;
constexpr double FirstDepth = 4;

struct LengthPanels
{
  /// How often the longest segment is halved until its optical depth is at most FirstDepth.
  int Halvings = 0;

  int GetNumberOfPoints() const { return PointsPerPanel * (this->Halvings + 1); }
};

LengthPanels GetPanels(double largestDepth)
{
  LengthPanels panels;
  if (largestDepth > FirstDepth)
  {
    panels.Halvings = static_cast<int>(
      std::ceil(std::log2(std::min(largestDepth, LargestSingleDepth) / FirstDepth)));
  }
  return panels;
}

/// The lengths, in fractions of the longest, and how the texels of a table follow from values there.
struct LengthSamples
{
  struct Panel
  {
    int FirstRow, EndRow;       ///< texels along the length
    int FirstPoint;             ///< index of its first point
    std::vector<float> Weights; ///< PointsPerPanel for each row
  };

  std::vector<float> Lengths; ///< padded to a multiple of LaneCount
  int Count = 0;
  std::vector<Panel> Panels; ///< empty: point k is texel k + 1 itself

  LengthSamples(const LengthAxisMap& axis, double largestDepth)
  {
    const LengthPanels panels = GetPanels(largestDepth);
    const double longest = axis.GetLength(axis.Size - 1);
    if (panels.GetNumberOfPoints() < axis.Size - 1)
    {
      int row = 1;
      for (int p = 0; p <= panels.Halvings; ++p)
      {
        const double begin = p == 0 ? 0 : std::ldexp(1, p - 1 - panels.Halvings);
        const double end = std::ldexp(1, p - panels.Halvings);
        row = this->AddPanel(axis, longest, begin, end, row, p == panels.Halvings);
      }
    }
    else
    {
      for (int r = 1; r < axis.Size; ++r)
      {
        this->Lengths.push_back(static_cast<float>(axis.GetLength(r) / longest));
      }
    }
    this->Count = static_cast<int>(this->Lengths.size());
    while (this->Lengths.size() % LaneCount != 0)
    {
      this->Lengths.push_back(this->Lengths.back());
    }
  }

private:
  int AddPanel(
    const LengthAxisMap& axis, double longest, double begin, double end, int firstRow, bool last)
  {
    Panel panel;
    panel.FirstRow = firstRow;
    panel.FirstPoint = static_cast<int>(this->Lengths.size());
    const double pi = std::acos(-1.);
    const double middle = 0.5 * (begin + end);
    const double half = 0.5 * (end - begin);
    double points[PointsPerPanel], factors[PointsPerPanel];
    for (int k = 0; k < PointsPerPanel; ++k)
    {
      // Of the first kind: none is at length 0.
      const double point = middle - half * std::cos((k + 0.5) * pi / PointsPerPanel);
      this->Lengths.push_back(static_cast<float>(point));
      points[k] = static_cast<double>(this->Lengths.back());
    }
    // Weights of the barycentric formula.
    for (int k = 0; k < PointsPerPanel; ++k)
    {
      double product = 1;
      for (int j = 0; j < PointsPerPanel; ++j)
      {
        product *= j == k ? 1 : 2 * (points[k] - points[j]) / half;
      }
      factors[k] = 1 / product;
    }
    int row = firstRow;
    for (; row < axis.Size && (last || axis.GetLength(row) / longest <= end); ++row)
    {
      const double length = axis.GetLength(row) / longest;
      double terms[PointsPerPanel];
      double sum = 0;
      int exact = -1;
      for (int k = 0; k < PointsPerPanel; ++k)
      {
        const double difference = length - points[k];
        exact = difference == 0 ? k : exact;
        terms[k] = factors[k] / difference;
        sum += terms[k];
      }
      for (int k = 0; k < PointsPerPanel; ++k)
      {
        const double weight = exact >= 0 ? (k == exact ? 1 : 0) : terms[k] / sum;
        panel.Weights.push_back(static_cast<float>(weight * (length / points[k])));
      }
    }
    panel.EndRow = row;
    this->Panels.push_back(std::move(panel));
    return row;
  }
};

// ------------------------------------------------------------------------------------------------
// The parts of a segment on which the transfer function is linear

class SegmentPieces
{
public:
  SegmentPieces(const TransferFunction& function, const ScalarAxisMap& axis, double longest)
    : Nodes(function.Nodes)
    , Texels(axis.Texels)
    , Longest(longest)
  {
    for (std::size_t i = 0; i < this->Texels.size(); ++i)
    {
      const bool left = i + 1 < this->Texels.size() && this->Texels[i] == this->Texels[i + 1];
      const double s = this->Texels[i];
      // The number of nodes below: of a scalar on a node, with the node's left or right side.
      const auto next = left
        ? std::lower_bound(this->Nodes.begin(), this->Nodes.end(), s,
            [](const TransferFunction::Node& node, double scalar) { return node.Scalar < scalar; })
        : std::upper_bound(this->Nodes.begin(), this->Nodes.end(), s,
            [](double scalar, const TransferFunction::Node& node) { return scalar < node.Scalar; });
      this->Intervals.push_back(static_cast<std::size_t>(next - this->Nodes.begin()));
    }
  }

  /// From one texel's scalar to another's, front to back; pieces that attenuate.
  void Find(int front, int back, std::vector<SegmentPiece>& pieces) const
  {
    pieces.clear();
    const double s0 = this->Texels[front];
    const double s1 = this->Texels[back];
    std::size_t k = this->Intervals[front];
    const std::size_t last = this->Intervals[back];
    if (s0 == s1)
    {
      // Constant; from one side of a step to the other, half of each.
      const double share = k == last ? 1 : 0.5;
      this->Add(k, s0, s0, share, pieces);
      if (k != last)
      {
        this->Add(last, s0, s0, share, pieces);
      }
      return;
    }
    const double range = s1 - s0;
    double s = s0;
    while (true)
    {
      double next = s1;
      std::size_t nextInterval = k;
      if (s0 < s1 && k < this->Nodes.size() && this->Nodes[k].Scalar < s1)
      {
        next = this->Nodes[k].Scalar;
        nextInterval = k + 1;
      }
      else if (s1 < s0 && k > 0 && this->Nodes[k - 1].Scalar > s1)
      {
        next = this->Nodes[k - 1].Scalar;
        nextInterval = k - 1;
      }
      if (next != s)
      {
        this->Add(k, s, next, (next - s) / range, pieces);
      }
      if (nextInterval == k)
      {
        return;
      }
      s = next;
      k = nextInterval;
    }
  }

private:
  void Add(std::size_t interval, double s0, double s1, double share,
    std::vector<SegmentPiece>& pieces) const
  {
    const TransferFunction::Value values[2] = { this->Evaluate(interval, s0),
      this->Evaluate(interval, s1) };
    if (!(values[0].Attenuation > 0 || values[1].Attenuation > 0))
    {
      return;
    }
    SegmentPiece piece;
    const double largest = std::max(values[0].Attenuation, values[1].Attenuation);
    const double length = std::min(share * this->Longest, LargestSingleDepth / largest);
    for (int end = 0; end < 2; ++end)
    {
      piece.Depth[end] = static_cast<float>(values[end].Attenuation * length);
      for (int c = 0; c < 3; ++c)
      {
        piece.Color[end][c] = static_cast<float>(values[end].Color[c]);
      }
    }
    pieces.push_back(piece);
  }

  /// The function continued from the interval with so many nodes below it.
  TransferFunction::Value Evaluate(std::size_t interval, double s) const
  {
    if (interval == 0)
    {
      return this->Nodes.front().Left;
    }
    if (interval == this->Nodes.size())
    {
      return this->Nodes.back().Right;
    }
    const TransferFunction::Node& a = this->Nodes[interval - 1];
    const TransferFunction::Node& b = this->Nodes[interval];
    const double t = (s - a.Scalar) / (b.Scalar - a.Scalar);
    TransferFunction::Value value;
    value.Attenuation = (1 - t) * a.Right.Attenuation + t * b.Left.Attenuation;
    for (int c = 0; c < 3; ++c)
    {
      value.Color[c] = (1 - t) * a.Right.Color[c] + t * b.Left.Color[c];
    }
    return value;
  }

  const std::vector<TransferFunction::Node>& Nodes;
  const std::vector<double>& Texels;
  double Longest;
  std::vector<std::size_t> Intervals;
};

// ------------------------------------------------------------------------------------------------
// Texels

/// The texels of a row, of one scalar at the back, that are to be computed: all but [First, Second).
struct RowParts
{
  int First, Second;
};

double GetLargestAttenuation(const TransferFunction& function)
{
  double largest = 0;
  for (const TransferFunction::Node& node : function.Nodes)
  {
    largest = std::max({ largest, node.Left.Attenuation, node.Right.Attenuation });
  }
  return largest;
}

bool HasNegativeColors(const TransferFunction& function)
{
  return std::any_of(function.Nodes.begin(), function.Nodes.end(),
    [](const TransferFunction::Node& node)
    {
      return std::any_of(node.Left.Color, node.Left.Color + 3, [](double c) { return c < 0; }) ||
        std::any_of(node.Right.Color, node.Right.Color + 3, [](double c) { return c < 0; });
    });
}

/// Fills the texels of a table whose axes and memory are there.
class Filler
{
public:
  Filler(const TransferFunction& function, PreIntegrationTable& table)
    : Table(table)
    , Size(table.Scalars.GetSize())
    , TexelSize(GetTexelSize(table.Settings.Format))
    , Longest(table.Settings.LongestSegment)
    , Pieces(function, table.Scalars, this->Longest)
    , Samples(table.Lengths, GetLargestAttenuation(function) * this->Longest)
    , KeepNegative(HasNegativeColors(function))
    , Kernels(GetKernels())
  {
  }

  void Fill(const std::vector<RowParts>& rows)
  {
    if (this->Table.Settings.Method == PreIntegrationMethod::Incremental)
    {
      this->FillByIncrements(rows);
    }
    else
    {
      this->FillByClosedForm(rows);
    }
  }

private:
  std::uint8_t* GetTexels(int length, int back, int front)
  {
    const std::size_t n = this->Size;
    return this->Table.Texels.GetData() +
      ((static_cast<std::size_t>(length) * n + back) * n + front) * this->TexelSize;
  }

  /// Calls function(begin, end) for the parts of a row.
  template <class Function>
  void ForEachPart(const RowParts& row, const Function& function) const
  {
    if (row.First > 0)
    {
      function(0, row.First);
    }
    if (row.Second < this->Size)
    {
      function(row.Second, this->Size);
    }
  }

  void FillByClosedForm(const std::vector<RowParts>& rows)
  {
    const int stride = 4 * this->Size;
#pragma omp parallel
    {
      std::vector<float> values(this->Samples.Lengths.size() * stride);
      std::vector<float> texels;
      std::vector<SegmentPiece> pieces;
#pragma omp for schedule(dynamic)
      for (int back = 0; back < this->Size; ++back)
      {
        this->ForEachPart(rows[back],
          [&](int begin, int end)
          {
            for (int front = begin; front < end; ++front)
            {
              this->Pieces.Find(front, back, pieces);
              this->Kernels.IntegrateLengths(pieces.data(), static_cast<int>(pieces.size()),
                this->Samples.Lengths.data(), static_cast<int>(this->Samples.Lengths.size()),
                values.data() + 4 * static_cast<std::ptrdiff_t>(front), stride);
            }
            this->WriteLengths(values, back, begin, end, texels);
          });
      }
    }
  }

  /// From the closed form at the samples' lengths to the texels of one scalar at the back.
  void WriteLengths(
    const std::vector<float>& values, int back, int begin, int end, std::vector<float>& texels)
  {
    const int stride = 4 * this->Size;
    const int first = 4 * begin;
    const int count = 4 * (end - begin);
    std::memset(this->GetTexels(0, back, begin), 0, (end - begin) * this->TexelSize);
    if (this->Samples.Panels.empty())
    {
      for (int row = 1; row < this->Table.Lengths.Size; ++row)
      {
        this->Kernels.EncodeChannels(this->Table.Settings.Format,
          values.data() + static_cast<std::ptrdiff_t>(row - 1) * stride + first, count,
          this->GetTexels(row, back, begin));
      }
      return;
    }
    for (const LengthSamples::Panel& panel : this->Samples.Panels)
    {
      const float* points =
        values.data() + static_cast<std::ptrdiff_t>(panel.FirstPoint) * stride + first;
      const int rows = panel.EndRow - panel.FirstRow;
      if (this->Table.Settings.Format == TexelFormat::Float && rows > 0)
      {
        this->Kernels.CombineRows(points, stride, PointsPerPanel, panel.Weights.data(), rows,
          this->KeepNegative,
          reinterpret_cast<float*>(this->GetTexels(panel.FirstRow, back, begin)),
          static_cast<long long>(stride) * this->Size, count);
        continue;
      }
      texels.resize(static_cast<std::size_t>(rows) * count);
      this->Kernels.CombineRows(points, stride, PointsPerPanel, panel.Weights.data(), rows,
        this->KeepNegative, texels.data(), count, count);
      for (int row = 0; row < rows; ++row)
      {
        this->Kernels.EncodeChannels(this->Table.Settings.Format,
          texels.data() + static_cast<std::ptrdiff_t>(row) * count, count,
          this->GetTexels(panel.FirstRow + row, back, begin));
      }
    }
  }

  /// Of which two lengths of the table a longer one is the sum.
  void GetParts(int row, int& front, int& back) const
  {
    const LengthAxisMap& axis = this->Table.Lengths;
    const bool halves = axis.Scale == LengthScale::Logarithmic && row >= 2 * axis.StepsPerDoubling;
    front = halves ? row - axis.StepsPerDoubling : 1;
    back = halves ? front : row - 1;
  }

  void FillByIncrements(const std::vector<RowParts>& rows)
  {
    const std::size_t n = this->Size;
    const std::size_t slice = 4 * n * n;
    const LengthAxisMap& axis = this->Table.Lengths;
    const std::vector<double>& texels = this->Table.Scalars.Texels;
    const TexelFormat format = this->Table.Settings.Format;
    // In single precision whatever the format: what is added up is not rounded on the way.
    TexelBuffer separate;
    if (format != TexelFormat::Float)
    {
      separate.Resize(slice * axis.Size * sizeof(float));
    }
    auto* values = reinterpret_cast<float*>(
      format == TexelFormat::Float ? this->Table.Texels.GetData() : separate.GetData());
    const float firstLength = static_cast<float>(axis.GetLength(1) / this->Longest);
    const std::vector<float> lengths(8, firstLength);

#pragma omp parallel
    {
      std::vector<SegmentPiece> pieces;
      std::vector<float> eight(32);
      std::vector<int> indices(n);
      std::vector<float> shares(n);
      for (int row = 0; row < axis.Size; ++row)
      {
#pragma omp for schedule(static)
        for (int back = 0; back < this->Size; ++back)
        {
          float* target = values + row * slice + back * 4 * n;
          this->ForEachPart(rows[back],
            [&](int begin, int end)
            {
              if (row == 0)
              {
                std::fill(target + 4 * begin, target + 4 * end, 0.f);
              }
              else if (row == 1)
              {
                for (int front = begin; front < end; ++front)
                {
                  this->Pieces.Find(front, back, pieces);
                  this->Kernels.IntegrateLengths(pieces.data(), static_cast<int>(pieces.size()),
                    lengths.data(), 8, eight.data(), 4);
                  std::copy_n(eight.data(), 4, target + 4 * static_cast<std::ptrdiff_t>(front));
                }
              }
              else
              {
                int frontRow, backRow;
                this->GetParts(row, frontRow, backRow);
                const double share = axis.GetLength(frontRow) / axis.GetLength(row);
                FindSplits(texels, back, begin, end, share, indices.data(), shares.data());
                this->Kernels.JoinSegments(values + frontRow * slice,
                  values + backRow * slice + back * 4 * n, this->Size, indices.data(),
                  shares.data(), begin, end, target);
              }
              if (format != TexelFormat::Float)
              {
                this->Kernels.EncodeChannels(format,
                  target + 4 * static_cast<std::ptrdiff_t>(begin), 4 * (end - begin),
                  this->GetTexels(row, back, begin));
              }
            });
        }
      }
    }
  }

  /// Texel coordinates of the scalars a share of the way from the front to the back.
  static void FindSplits(const std::vector<double>& texels, int back, int begin, int end,
    double share, int* indices, float* shares)
  {
    // Splits ascend with the front's scalar.
    int index = 0;
    const int last = static_cast<int>(texels.size()) - 2;
    for (int front = begin; front < end; ++front)
    {
      const double split = (1 - share) * texels[front] + share * texels[back];
      while (index < last && texels[index + 1] <= split)
      {
        ++index;
      }
      const double width = texels[index + 1] - texels[index];
      const double t = width > 0 ? (split - texels[index]) / width : 0;
      indices[front] = index;
      shares[front] = static_cast<float>(std::clamp(t, 0., 1.));
    }
  }

  PreIntegrationTable& Table;
  int Size;
  std::size_t TexelSize;
  double Longest;
  SegmentPieces Pieces;
  LengthSamples Samples;
  bool KeepNegative;
  PreIntegrationKernels Kernels;
};

void CheckColors(const TransferFunction& function, TexelFormat format)
{
  if (format != TexelFormat::UNorm8 && format != TexelFormat::UNorm16)
  {
    return;
  }
  for (const TransferFunction::Node& node : function.Nodes)
  {
    for (int c = 0; c < 3; ++c)
    {
      for (const double color : { node.Left.Color[c], node.Right.Color[c] })
      {
        if (!(0 <= color && color <= 1))
        {
          throw std::invalid_argument("pre-integration table: a colour of " +
            std::to_string(color) + ", integer texels hold 0..1; half and float hold others");
        }
      }
    }
  }
}

bool IsEqual(const TransferFunction::Value& a, const TransferFunction::Value& b)
{
  return a.Attenuation == b.Attenuation && std::equal(a.Color, a.Color + 3, b.Color);
}

/// Scalars from one to another.
struct Extent
{
  double Begin, End;
};

/// Where two functions with the same node scalars differ.
std::vector<Extent> FindDifferences(const TransferFunction& a, const TransferFunction& b)
{
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  std::vector<Extent> result;
  const std::size_t n = a.Nodes.size();
  for (std::size_t k = 0; k < n; ++k)
  {
    const double s = a.Nodes[k].Scalar;
    if (!IsEqual(a.Nodes[k].Left, b.Nodes[k].Left))
    {
      result.push_back({ k > 0 ? a.Nodes[k - 1].Scalar : -Infinity, s });
    }
    if (!IsEqual(a.Nodes[k].Right, b.Nodes[k].Right))
    {
      result.push_back({ s, k + 1 < n ? a.Nodes[k + 1].Scalar : Infinity });
    }
  }
  return result;
}

} // namespace

void BuildPreIntegrationTable(const TransferFunction& function,
  const PreIntegrationSettings& settings, PreIntegrationTable& table)
{
  ScalarAxisMap scalars = MakeScalarAxis(function, settings);
  const LengthAxisMap lengths = MakeLengthAxis(settings);
  CheckColors(function, settings.Format);
  const std::size_t n = scalars.GetSize();
  table.Texels.Resize(n * n * lengths.Size * GetTexelSize(settings.Format));
  table.Settings = settings;
  table.Scalars = std::move(scalars);
  table.Lengths = lengths;
  table.Bound = BoundPreIntegrationError(function, table);
  Filler(function, table)
    .Fill(std::vector<RowParts>(n, { static_cast<int>(n), static_cast<int>(n) }));
}

std::int64_t UpdatePreIntegrationTable(
  const TransferFunction& before, const TransferFunction& after, PreIntegrationTable& table)
{
  const PreIntegrationSettings settings = table.Settings;
  ScalarAxisMap scalars = MakeScalarAxis(after, settings);
  CheckColors(after, settings.Format);
  const int n = scalars.GetSize();
  const double longest = settings.LongestSegment;
  // Increments need the values of texels that stay, which only single precision still holds.
  const bool complete =
    settings.Method == PreIntegrationMethod::ClosedForm || settings.Format == TexelFormat::Float;
  const bool sameNodes = before.Nodes.size() == after.Nodes.size() &&
    std::equal(before.Nodes.begin(), before.Nodes.end(), after.Nodes.begin(),
      [](const TransferFunction::Node& a, const TransferFunction::Node& b)
      { return a.Scalar == b.Scalar; });
  if (!complete || !sameNodes || scalars.Texels != table.Scalars.Texels ||
    HasNegativeColors(before) != HasNegativeColors(after) ||
    GetPanels(GetLargestAttenuation(before) * longest).Halvings !=
      GetPanels(GetLargestAttenuation(after) * longest).Halvings)
  {
    BuildPreIntegrationTable(after, settings, table);
    return static_cast<std::int64_t>(n) * n * table.Lengths.Size;
  }

  // A segment meets a changed scalar where its ends do not lie on one side of it.
  std::vector<RowParts> rows(n, { 0, n });
  std::int64_t count = 0;
  for (const Extent& extent : FindDifferences(before, after))
  {
    const std::vector<double>& texels = scalars.Texels;
    const int notBelow = static_cast<int>(
      std::lower_bound(texels.begin(), texels.end(), extent.Begin) - texels.begin());
    const int above =
      static_cast<int>(std::upper_bound(texels.begin(), texels.end(), extent.End) - texels.begin());
    for (int back = 0; back < n; ++back)
    {
      if (back >= notBelow)
      {
        rows[back].First = std::max(rows[back].First, above);
      }
      if (back < above)
      {
        rows[back].Second = std::min(rows[back].Second, notBelow);
      }
    }
  }
  for (RowParts& row : rows)
  {
    if (row.First >= row.Second)
    {
      row = { n, n };
    }
    count += row.First + (n - row.Second);
  }
  table.Bound = BoundPreIntegrationError(after, table);
  Filler(after, table).Fill(rows);
  return count * table.Lengths.Size;
}

PreIntegrationSettings GetCoarseSettings(const PreIntegrationSettings& settings, std::size_t bytes)
{
  constexpr int SmallestScalarSize = 16;
  constexpr int SmallestLengthSize = 8;
  PreIntegrationSettings coarse = settings;
  const auto getBytes = [&coarse]() {
    return GetTexelSize(coarse.Format) * coarse.ScalarSize * coarse.ScalarSize * coarse.LengthSize;
  };
  while (getBytes() > bytes)
  {
    // Lengths of a linear scale cost most and give least. A logarithmic one has few already, and
    // without doublings it would begin at longer ones.
    const bool fewerLengths =
      coarse.Scale == LengthScale::Linear && coarse.LengthSize / 2 >= SmallestLengthSize;
    const bool fewerScalars = coarse.ScalarSize / 2 >= SmallestScalarSize;
    if (!fewerLengths && !fewerScalars)
    {
      break;
    }
    if (fewerLengths && (!fewerScalars || coarse.LengthSize > coarse.ScalarSize / 2))
    {
      coarse.LengthSize /= 2;
    }
    else
    {
      coarse.ScalarSize /= 2;
    }
  }
  return coarse;
}

} // namespace tetralux
