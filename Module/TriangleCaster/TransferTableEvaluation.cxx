// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/TransferTableEvaluation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace tetralux
{
namespace
{

bool Ascends(double first, double last)
{
  return std::isfinite(first) && std::isfinite(last) && first < last;
}

void CheckSize(int columns, int rows)
{
  if (columns < 2 || rows < 2)
  {
    throw std::invalid_argument(
      "a table over scalars and gradients has fewer than 2 columns or rows");
  }
}

bool IsValid(const TransferTable::Entry& entry)
{
  return std::isfinite(entry.Color[0]) && std::isfinite(entry.Color[1]) &&
    std::isfinite(entry.Color[2]) && std::isfinite(entry.Opacity) && entry.Opacity >= 0;
}

/// Where a number lies among count entries, and between which two.
struct Place
{
  int Cell;
  double Share; ///< of the second

  Place(double x, double first, double last, int count)
  {
    const double position = std::clamp((x - first) / (last - first) * (count - 1), 0., count - 1.);
    this->Cell = std::min(static_cast<int>(position), count - 2);
    this->Share = position - this->Cell;
  }
};

double GetNumber(double first, double last, int k, int count)
{
  return first + (last - first) * k / (count - 1);
}

} // namespace

void CheckTable(const TransferTable& table)
{
  CheckSize(table.Columns, table.Rows);
  if (table.Entries.size() != static_cast<std::size_t>(table.Columns) * table.Rows)
  {
    throw std::invalid_argument(
      "a table over scalars and gradients has not as many entries as columns times rows");
  }
  if (!Ascends(table.FirstScalar, table.LastScalar) ||
    !Ascends(table.FirstLength, table.LastLength))
  {
    throw std::invalid_argument(
      "the scalars or lengths of a table over scalars and gradients do not ascend");
  }
  if (!std::all_of(table.Entries.begin(), table.Entries.end(), IsValid))
  {
    throw std::invalid_argument("a table over scalars and gradients has a colour or opacity that "
                                "is not finite or is negative");
  }
}

TransferTable::Entry Evaluate(const TransferTable& table, double scalar, double length)
{
  const Place x(scalar, table.FirstScalar, table.LastScalar, table.Columns);
  const Place y(length, table.FirstLength, table.LastLength, table.Rows);
  const TransferTable::Entry* corner =
    table.Entries.data() + static_cast<std::size_t>(y.Cell) * table.Columns + x.Cell;
  const TransferTable::Entry* corners[2] = { corner, corner + table.Columns };
  const auto interpolate = [&](const auto& get)
  {
    double ofRow[2];
    for (int j = 0; j < 2; ++j)
    {
      ofRow[j] = (1 - x.Share) * get(corners[j][0]) + x.Share * get(corners[j][1]);
    }
    return static_cast<float>((1 - y.Share) * ofRow[0] + y.Share * ofRow[1]);
  };
  TransferTable::Entry entry;
  for (int c = 0; c < 3; ++c)
  {
    entry.Color[c] = interpolate([c](const TransferTable::Entry& e) { return e.Color[c]; });
  }
  entry.Opacity = interpolate([](const TransferTable::Entry& e) { return e.Opacity; });
  return entry;
}

TransferTable Resample(const TransferTable& table, int columns, int rows)
{
  CheckTable(table);
  CheckSize(columns, rows);
  TransferTable result = table;
  result.Columns = columns;
  result.Rows = rows;
  result.Entries.clear();
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      result.Entries.push_back(
        Evaluate(table, GetNumber(table.FirstScalar, table.LastScalar, i, columns),
          GetNumber(table.FirstLength, table.LastLength, j, rows)));
    }
  }
  return result;
}

TransferFunction FindVisibleScalars(const TransferTable& table)
{
  std::vector<bool> columns(table.Columns, false);
  for (int entry = 0; entry < table.Columns * table.Rows; ++entry)
  {
    columns[entry % table.Columns] =
      columns[entry % table.Columns] || table.Entries[entry].Opacity > 0;
  }
  TransferFunction function;
  const int last = table.Columns - 1;
  for (int i = 0; i <= last; ++i)
  {
    const bool left = columns[i] || (i > 0 && columns[i - 1]);
    const bool right = columns[i] || (i < last && columns[i + 1]);
    if (i == 0 || i == last || left != right)
    {
      function.Nodes.push_back({ GetNumber(table.FirstScalar, table.LastScalar, i, table.Columns),
        { { 0, 0, 0 }, left ? 1. : 0. }, { { 0, 0, 0 }, right ? 1. : 0. } });
    }
  }
  return function;
}

} // namespace tetralux
