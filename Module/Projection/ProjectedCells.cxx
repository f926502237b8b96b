// SPDX-License-Identifier: BSD-3-Clause
#include "Projection/ProjectedCells.h"

#include "Mesh/CellGradient.h"
#include "Projection/CellProjector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

namespace tetralux
{
namespace
{

/// How wide or high a cell may be on the picture, pixels.
double FindExtent(const ScreenFrame& frame, const ProjectionSettings& settings,
  Span<const ScreenPoint> points, const std::int32_t* cell)
{
  const ScreenPoint* const corners[4] = { &points[cell[0]], &points[cell[1]], &points[cell[2]],
    &points[cell[3]] };
  ScreenBox box = FindBox(frame, corners);
  return Clamp(box, settings) ? std::max(box.Hi[0] - box.Lo[0], box.Hi[1] - box.Lo[1]) : 0;
}

/// A number that looks random, 0..LargestCellKey (Wang's hash of integers).
std::uint32_t MakeKey(std::int32_t cell)
{
  auto key = static_cast<std::uint32_t>(cell);
  key = (key ^ 61u) ^ (key >> 16);
  key *= 9u;
  key ^= key >> 4;
  key *= 0x27d4eb2du;
  key ^= key >> 15;
  return key & LargestCellKey;
}

/// Own of a slice, see CellData::Division.
void SetSlice(const CellDivision::Slice& slice, ProjectedCell& result)
{
  const CellDivision::Part& part = slice.Of;
  result.Fourth.Own[0] = static_cast<float>(part.Interval);
  result.Fourth.Own[1] = static_cast<float>(part.OpenBelow + 2 * part.OpenAbove);
  result.Fourth.Own[2] = static_cast<float>(slice.Index + SliceBase * part.Slices);
}

/// The values of a projected cell's functions at its corners.
InterpolatedCell FindValues(const ProjectedCell& cell)
{
  const float* const places[4] = { &cell.First.X, &cell.Second.X, &cell.Third.X, &cell.Fourth.X };
  const float own[4][2] = { { cell.Third.ScalarSlope, cell.Fourth.Code },
    { cell.Third.ScalarRange[0], cell.Third.ScalarRange[1] },
    { cell.Fourth.Reference[0], cell.Fourth.Reference[1] },
    { cell.Fourth.Own[0], cell.Fourth.Own[1] } };
  InterpolatedCell result;
  for (int k = 0; k < 4; ++k)
  {
    const float x = places[k][0];
    const float y = places[k][1];
    const float dx = x - cell.Fourth.Reference[0];
    const float dy = y - cell.Fourth.Reference[1];
    const auto at = [&](const float f[3]) { return f[0] + f[1] * dx + f[2] * dy; };
    result.Corners[k] = { x, y, at(cell.Third.Scalar),
      { at(cell.First.Face0), at(cell.Second.Face1), at(cell.Second.Face2) }, at(cell.First.Base),
      { own[k][0], own[k][1] } };
  }
  return result;
}

/// The gradient of a field in a cell, of any length.
void FindGradient(Span<const double> coordinates, Span<const ScreenPoint> points,
  const std::int32_t* cell, double gradient[3])
{
  double edges[3][3];
  double rises[3];
  const double* first = &coordinates[3 * static_cast<std::size_t>(cell[0])];
  for (int i = 0; i < 3; ++i)
  {
    const double* p = &coordinates[3 * static_cast<std::size_t>(cell[i + 1])];
    std::transform(p, p + 3, first, edges[i], std::minus<double>());
    rises[i] = points[cell[i + 1]].Scalar - points[cell[0]].Scalar;
  }
  const CellGradient found(edges, rises);
  // A length of 1 keeps it in the range of single precision.
  const double* g = found.Weighted;
  const double length = std::max({ std::abs(g[0]), std::abs(g[1]), std::abs(g[2]) });
  const double scale = length > 0 ? 1 / length : 0;
  std::transform(g, g + 3, gradient, [scale](double x) { return scale * x; });
}

/// Gradients at the points of a cell as they are asked for.
void FindGradients(const CellData& data, Span<const ScreenPoint> points, const std::int32_t* cell,
  double gradients[4][3])
{
  for (int i = 0; i < 4; ++i)
  {
    if (data.Gradients == CellData::Gradient::Points)
    {
      const GradientRow& gradient = data.PointGradients[cell[i]];
      gradients[i][0] = gradient.X;
      gradients[i][1] = gradient.Y;
      gradients[i][2] = gradient.Z;
    }
    else if (i == 0)
    {
      FindGradient(data.Coordinates, points, cell, gradients[0]);
    }
    else
    {
      std::copy_n(gradients[0], 3, gradients[i]);
    }
  }
}

/// The functions of a cell's four faces, each one's points in ascending order. faces:
/// see CellProjector.
void FindFaceScalars(const ScreenFrame& frame, const ProjectionSettings& settings,
  Span<const ScreenPoint> points, const std::int32_t* cell, const std::array<int, 4>& faces,
  FaceScalar result[4])
{
  for (int slot = 0; slot < 4; ++slot)
  {
    const int opposite = faces[slot];
    std::int32_t ids[3] = { cell[(opposite + 1) % 4], cell[(opposite + 2) % 4],
      cell[(opposite + 3) % 4] };
    std::sort(ids, ids + 3);
    result[slot] = FindFaceScalar(frame, settings, points[ids[0]], points[ids[1]], points[ids[2]]);
  }
}

} // namespace

double FindShift(const ScreenFrame& frame, const ProjectionSettings& settings,
  Span<const ScreenPoint> points, Span<const std::int32_t> cells)
{
  // A side is off by a few roundings of 2^-25 times half of the extent.
  constexpr double ShiftOfExtent = 1. / (1 << 21);
  double largest = 0;
  const auto n = static_cast<std::int64_t>(cells.size() / 4);
#pragma omp parallel for schedule(static) reduction(max : largest)
  for (std::int64_t cell = 0; cell < n; ++cell)
  {
    largest = std::max(largest, FindExtent(frame, settings, points, &cells[4 * cell]));
  }
  return ShiftOfExtent * std::max(largest, 1.);
}

void ProjectCells(const ScreenFrame& frame, const ProjectionSettings& settings,
  Span<const ScreenPoint> points, Span<const std::int32_t> cells, Span<const std::int32_t> order,
  const CellData& data, ProjectedCells& result)
{
  // Blocks of cells are projected side by side, and pushed together behind that, on one thread:
  // threads that run out of work wait busily, at the cost of a rasteriser that runs beside them.
  constexpr std::int64_t BlockSize = 512;
  const auto n = static_cast<std::int64_t>(order.size());
  const std::int64_t blocks = (n + BlockSize - 1) / BlockSize;
  const CellDivision* division = data.Division;
  // Where there is room for each block, and how much of it is taken by what is seen.
  std::vector<std::int64_t> begins(blocks + 1, 0);
  std::vector<std::int64_t> counts(blocks);
#pragma omp parallel for schedule(static)
  for (std::int64_t block = 0; block < blocks; ++block)
  {
    const std::int64_t begin = block * BlockSize;
    const std::int64_t end = std::min(begin + BlockSize, n);
    begins[block + 1] = division ? 0 : end - begin;
    for (std::int64_t i = begin; division && i < end; ++i)
    {
      begins[block + 1] += division->GetNumberOfSlices(order[i]);
    }
  }
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  const std::int64_t room = begins[blocks];
  std::vector<std::uint8_t> corners(room);
  const bool interpolated = frame.IsPerspective() && !settings.Interpolate;
  result.Cells.resize(interpolated ? 0 : room + 1); // with the one behind all others
  result.InterpolatedCells.resize(interpolated ? room + 1 : 0);
  const bool withGradients = data.Gradients != CellData::Gradient::None;
  result.Gradients.resize(withGradients ? room + 1 : 0);
  result.FaceScalars.resize(data.FaceScalars ? 4 * room : 0);
  std::int64_t tetrahedra = 0;
#pragma omp parallel for schedule(dynamic) reduction(+ : tetrahedra)
  for (std::int64_t block = 0; block < blocks; ++block)
  {
    const std::int64_t begin = block * BlockSize;
    const std::int64_t end = std::min(begin + BlockSize, n);
    std::int64_t last = begins[block];
    CellProjector projector(frame, settings);
    std::vector<CellDivision::Slice> slices;
    for (std::int64_t i = begin; i < end; ++i)
    {
      const std::int32_t cell = order[i];
      const std::int32_t* p = &cells[4 * static_cast<std::size_t>(cell)];
      ProjectedCell own;
      if (division && division->GetParts(cell).empty())
      {
        continue;
      }
      ProjectedCell& projected = interpolated ? own : result.Cells[last];
      const ScreenPoint* const cellPoints[4] = { &points[p[0]], &points[p[1]], &points[p[2]],
        &points[p[3]] };
      const int count = projector.Project(cellPoints, projected);
      if (count == 0)
      {
        continue;
      }
      ++tetrahedra;
      if (data.Keys)
      {
        projected.Fourth.Code += static_cast<float>(8 * MakeKey(cell));
      }
      if (division)
      {
        division->FindOrder(cell, projector.GetEyeScalar(), data.FrontToBack, slices);
        for (const CellDivision::Slice& slice : slices)
        {
          ProjectedCell& part = result.Cells[last];
          part = projected;
          SetSlice(slice, part);
          corners[last++] = static_cast<std::uint8_t>(count);
        }
        continue;
      }
      if (withGradients)
      {
        double gradients[4][3];
        FindGradients(data, points, p, gradients);
        result.Gradients[last] = projector.Project(gradients);
      }
      if (data.FaceScalars)
      {
        FindFaceScalars(
          frame, settings, points, p, projector.GetFaces(), &result.FaceScalars[4 * last]);
      }
      if (data.Ids)
      {
        const std::int32_t high = cell / CellIdBase;
        projected.Fourth.Own[0] = static_cast<float>(high);
        projected.Fourth.Own[1] = static_cast<float>(cell % CellIdBase);
      }
      if (interpolated)
      {
        result.InterpolatedCells[last] = FindValues(projected);
      }
      corners[last++] = static_cast<std::uint8_t>(count);
    }
    counts[block] = last - begins[block];
  }
  result.NumberOfTetrahedra = tetrahedra;
  result.Triangles.clear();
  result.PartBegins.clear();
  std::int64_t seen = 0;
  for (std::int64_t block = 0; block < blocks; ++block)
  {
    const std::int64_t begin = begins[block];
    const std::int64_t end = begin + counts[block];
    const auto push = [&](auto& values, int perCell)
    {
      if (begin > seen && !values.empty())
      {
        const auto first = values.begin() + perCell * begin;
        std::copy(first, first + perCell * counts[block], values.begin() + perCell * seen);
      }
    };
    push(result.Cells, 1);
    push(result.InterpolatedCells, 1);
    push(result.Gradients, 1);
    push(result.FaceScalars, 4);
    for (std::int64_t i = begin; i < end; ++i, ++seen)
    {
      const std::int64_t place = seen % ProjectedCells::PartSize;
      if (place == 0)
      {
        result.PartBegins.push_back(result.Triangles.size());
      }
      const auto corner = static_cast<std::uint16_t>(4 * place);
      for (std::uint16_t k = 1; k + 1 < corners[i]; ++k)
      {
        for (const int added : { k + 0, k + 1, 0 })
        {
          result.Triangles.push_back(static_cast<std::uint16_t>(corner + added));
        }
      }
    }
  }
  result.PartBegins.push_back(result.Triangles.size());
  result.Cells.resize(interpolated ? 0 : seen + 1);
  result.InterpolatedCells.resize(interpolated ? seen + 1 : 0);
  result.Gradients.resize(withGradients ? seen + 1 : 0);
  result.FaceScalars.resize(data.FaceScalars ? 4 * seen : 0);
}

} // namespace tetralux
