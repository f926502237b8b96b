// SPDX-License-Identifier: BSD-3-Clause
#include "PreIntegration/PreIntegrationBuilder.h"

#include "Base/Check.h"
#include "PreIntegration/LengthSamples.h"
#include "PreIntegration/PreIntegrationError.h"
#include "PreIntegration/PreIntegrationKernel.h"
#include "PreIntegration/SegmentPieces.h"
#include "Simd/InstructionSet.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
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

/// The texels of a row, of one scalar at the back, that Filler computes: all but [First, Second).
struct RowParts
{
  int First, Second;
};

/// Fills the texels of a table that has its axes and memory.
class Filler
{
public:
  Filler(const TransferFunction& function, PreIntegrationTable& table)
    : Table(table)
    , Size(table.Scalars.GetSize())
    , TexelSize(GetTexelSize(table.Settings.Format))
    , Pieces(function, table.Scalars, table.Settings.LongestSegment)
    , Samples(table.Lengths, GetLargestAttenuation(function) * table.Settings.LongestSegment)
    , KeepNegative(HasNegativeColors(function))
    , Kernels(GetKernels())
  {
  }

  void Fill(const std::vector<RowParts>& rows)
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

private:
  std::uint8_t* GetTexels(int length, int back, int front)
  {
    TETRALUX_CHECK(0 <= length && length < this->Table.Lengths.Size);
    TETRALUX_CHECK(0 <= back && back < this->Size && 0 <= front && front < this->Size);
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
        this->Kernels.CombineRows(points, stride, LengthSamples::PointsPerPanel,
          panel.Weights.data(), rows, this->KeepNegative,
          reinterpret_cast<float*>(this->GetTexels(panel.FirstRow, back, begin)),
          static_cast<long long>(stride) * this->Size, count);
        continue;
      }
      texels.resize(static_cast<std::size_t>(rows) * count);
      this->Kernels.CombineRows(points, stride, LengthSamples::PointsPerPanel, panel.Weights.data(),
        rows, this->KeepNegative, texels.data(), count, count);
      for (int row = 0; row < rows; ++row)
      {
        this->Kernels.EncodeChannels(this->Table.Settings.Format,
          texels.data() + static_cast<std::ptrdiff_t>(row) * count, count,
          this->GetTexels(panel.FirstRow + row, back, begin));
      }
    }
  }

  PreIntegrationTable& Table;
  int Size;
  std::size_t TexelSize;
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
  const bool sameNodes = before.Nodes.size() == after.Nodes.size() &&
    std::equal(before.Nodes.begin(), before.Nodes.end(), after.Nodes.begin(),
      [](const TransferFunction::Node& a, const TransferFunction::Node& b)
      { return a.Scalar == b.Scalar; });
  if (!sameNodes || scalars.Texels != table.Scalars.Texels ||
    HasNegativeColors(before) != HasNegativeColors(after) ||
    LengthSamples::GetHalvings(GetLargestAttenuation(before) * longest) !=
      LengthSamples::GetHalvings(GetLargestAttenuation(after) * longest))
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

} // namespace tetralux
