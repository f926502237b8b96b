// SPDX-License-Identifier: BSD-3-Clause
#include "RayCast/BoundaryTiles.h"

#include "View/RayDisplacements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <omp.h>

namespace tetralux
{
namespace
{

using Vector = std::array<double, 3>;

/// How far from a ray, in radii of the mesh, a face may count for it: as far as rays are displaced,
/// and as far as projections are rounded and edges are near (ProjectionRounding), which is less.
constexpr double Reach = 2 * FarthestDisplacement;

/// What is added for the rounding of the projection here, in pixels. That is below 1e-9 where the
/// picture's rays differ at all in double precision.
constexpr double PixelRounding = 1. / 1024;

double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/// Pixels, both ends included; empty if X1 < X0 or Y1 < Y0.
struct PixelBounds
{
  std::int32_t X0, Y0, X1, Y1;

  bool IsEmpty() const { return this->X1 < this->X0 || this->Y1 < this->Y0; }
};

/// Where points of the tables are in the picture, in pixels.
class PixelMap
{
public:
  PixelMap(const WalkMesh& mesh, const RayGrid& grid)
    : Width(grid.Width)
    , Height(grid.Height)
  {
    const auto isZero = [](const double(&v)[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; };
    this->Perspective = !isZero(grid.DirectionStepX) || !isZero(grid.DirectionStepY);
    if (this->Perspective && !(isZero(grid.OriginStepX) && isZero(grid.OriginStepY)))
    {
      return;
    }
    // A point is origin + a step x + b step y + c direction. Pixels are a / c and b / c in a
    // perspective, else a and b.
    const auto& stepX = this->Perspective ? grid.DirectionStepX : grid.OriginStepX;
    const auto& stepY = this->Perspective ? grid.DirectionStepY : grid.OriginStepY;
    const Vector x = FindDirection(mesh, grid, stepX);
    const Vector y = FindDirection(mesh, grid, stepY);
    const Vector z = FindDirection(mesh, grid, grid.Direction);
    for (int a = 0; a < 3; ++a)
    {
      const double* row = grid.MeshFromWorld[a];
      this->Origin[a] = (row[0] * grid.Origin[0] + row[1] * grid.Origin[1] +
                          row[2] * grid.Origin[2] + row[3] - mesh.GetCenter()[a]) /
        mesh.GetRadius();
    }
    const double volume = Dot(x, Cross(y, z));
    const Vector rows[3] = { Cross(y, z), Cross(z, x), Cross(x, y) };
    double sum = 0;
    for (int i = 0; i < 3; ++i)
    {
      for (int a = 0; a < 3; ++a)
      {
        this->Rows[i][a] = rows[i][a] / volume;
        sum += std::abs(this->Rows[i][a]) + std::abs(this->Origin[a]);
      }
      this->Reaches[i] = Reach * std::sqrt(Dot(this->Rows[i], this->Rows[i]));
    }
    this->Usable =
      std::isfinite(sum) && volume != 0 && this->IsInFront(mesh) && this->HasPixels(mesh);
  }

  bool IsUsable() const { return this->Usable; }

  /// Pixels whose rays a triangle may count for.
  PixelBounds FindBounds(const WalkPoint<float>* points, const std::int32_t (&corners)[3]) const
  {
    double lower[2], upper[2];
    for (int k = 0; k < 3; ++k)
    {
      const WalkPoint<float>& p = points[corners[k]];
      double low[2], high[2];
      this->FindPlace({ p.X, p.Y, p.Z }, low, high);
      for (int i = 0; i < 2; ++i)
      {
        lower[i] = k == 0 ? low[i] : std::min(lower[i], low[i]);
        upper[i] = k == 0 ? high[i] : std::max(upper[i], high[i]);
      }
    }
    // By conversions, which are one instruction each on every processor.
    const auto round = [](
                         double low, double high, int size, std::int32_t& first, std::int32_t& last)
    {
      const double lowest = std::min(std::max(low, 0.), double(size));
      const double highest = std::min(std::max(high, -1.), size - 1.);
      first = static_cast<std::int32_t>(lowest);
      first += first < lowest ? 1 : 0;
      last = static_cast<std::int32_t>(highest);
      last -= highest < last ? 1 : 0;
    };
    PixelBounds bounds;
    round(lower[0], upper[0], this->Width, bounds.X0, bounds.X1);
    round(lower[1], upper[1], this->Height, bounds.Y0, bounds.Y1);
    return bounds;
  }

private:
  static Vector FindDirection(const WalkMesh& mesh, const RayGrid& grid, const double (&v)[3])
  {
    Vector result;
    for (int a = 0; a < 3; ++a)
    {
      const double* row = grid.MeshFromWorld[a];
      result[a] = (row[0] * v[0] + row[1] * v[1] + row[2] * v[2]) / mesh.GetRadius();
    }
    return result;
  }

  /// Where a point may be, in pixels.
  void FindPlace(const Vector& point, double (&low)[2], double (&high)[2]) const
  {
    const Vector d = { point[0] - this->Origin[0], point[1] - this->Origin[1],
      point[2] - this->Origin[2] };
    const double scale = this->Perspective ? 1 / Dot(this->Rows[2], d) : 1;
    for (int i = 0; i < 2; ++i)
    {
      const double pixel = Dot(this->Rows[i], d) * scale;
      // What the quotient changes by if the point moves.
      const double reach = PixelRounding +
        scale * (this->Reaches[i] + (this->Perspective ? std::abs(pixel) * this->Reaches[2] : 0.));
      low[i] = pixel - reach;
      high[i] = pixel + reach;
    }
  }

  static Vector GetCorner(const WalkMesh& mesh, int corner)
  {
    Vector point;
    for (int a = 0; a < 3; ++a)
    {
      const double half = mesh.GetHalfSize()[a] / mesh.GetRadius();
      point[a] = (corner >> a & 1) != 0 ? half : -half;
    }
    return point;
  }

  /// Whether all of the mesh's box is in pixels that doubles can tell.
  bool HasPixels(const WalkMesh& mesh) const
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      double low[2], high[2];
      this->FindPlace(GetCorner(mesh, corner), low, high);
      if (!std::isfinite(low[0] + high[0] + low[1] + high[1]))
      {
        return false;
      }
    }
    return true;
  }

  /// Whether the mesh's box is in front of the eye, by more than a face reaches.
  bool IsInFront(const WalkMesh& mesh) const
  {
    if (!this->Perspective)
    {
      return true;
    }
    for (int corner = 0; corner < 8; ++corner)
    {
      Vector d = GetCorner(mesh, corner);
      for (int a = 0; a < 3; ++a)
      {
        d[a] -= this->Origin[a];
      }
      if (!(Dot(this->Rows[2], d) > 2 * this->Reaches[2]))
      {
        return false;
      }
    }
    return true;
  }

  int Width, Height;
  bool Perspective = false;
  bool Usable = false;
  Vector Origin{}; ///< of the rays, in coordinates of the tables
  Vector Rows[3]{};
  double Reaches[3]{}; ///< of the products with the rows
};

/// Calls function(tile) for each tile with pixels of the bounds.
template <class Function>
void ForEachTileOf(const PixelBounds& bounds, int columns, const Function& function)
{
  for (int row = bounds.Y0 / RayTileSize; row <= bounds.Y1 / RayTileSize; ++row)
  {
    for (int column = bounds.X0 / RayTileSize; column <= bounds.X1 / RayTileSize; ++column)
    {
      function(row * columns + column);
    }
  }
}

/// The blocks of a tile with pixels of the bounds.
std::uint32_t FindBlocks(const PixelBounds& bounds, const TileGrid& grid, int tile)
{
  const int left = tile % grid.GetColumns() * RayTileSize;
  const int lower = tile / grid.GetColumns() * RayTileSize;
  const int first = (std::max(bounds.X0, left) - left) / BlockWidth;
  const int last = (std::min(bounds.X1, left + RayTileSize - 1) - left) / BlockWidth;
  const int firstRow = (std::max(bounds.Y0, lower) - lower) / BlockHeight;
  const int lastRow = (std::min(bounds.Y1, lower + RayTileSize - 1) - lower) / BlockHeight;
  const std::uint32_t row = (1u << (last + 1)) - (1u << first);
  std::uint32_t blocks = 0;
  for (int k = firstRow; k <= lastRow; ++k)
  {
    blocks |= row << (k * BlocksAcrossTile);
  }
  return blocks;
}

} // namespace

bool MakeBoundaryTiles(const WalkMesh& mesh, const WalkTables& tables, const RayGrid& grid,
  int threads, BoundaryTiles& tiles)
{
  const PixelMap map(mesh, grid);
  tiles.Grid = { grid.Width, grid.Height, RayTileSize };
  const auto count = static_cast<std::size_t>(tiles.Grid.GetCount());
  const auto faces = static_cast<std::int64_t>(tables.Entries.size());
  if (!map.IsUsable())
  {
    return false;
  }
  const int columns = tiles.Grid.GetColumns();
  RawVector<PixelBounds> bounds(tables.Entries.size());
  // Of each tile the number of faces that each thread has, then where they begin.
  std::vector<std::int64_t> begins(count * threads + 1, 0);
  std::int64_t total = 0;
  constexpr std::int64_t Most = std::numeric_limits<std::int32_t>::max();
  tiles.Begins.resize(count + 1);
#pragma omp parallel num_threads(threads)
  {
    const int thread = omp_get_thread_num();
    const int team = omp_get_num_threads();
    const std::int64_t first = faces * thread / team;
    const std::int64_t last = faces * (thread + 1) / team;
    for (std::int64_t b = first; b < last; ++b)
    {
      bounds[b] = map.FindBounds(mesh.GetPoints<float>(), tables.Entries[b].Points);
      // Most faces of a fine mesh are between the pixels.
      if (!bounds[b].IsEmpty())
      {
        ForEachTileOf(bounds[b], columns, [&](int tile) { ++begins[tile * threads + thread]; });
      }
    }
#pragma omp barrier
#pragma omp single
    {
      for (std::int64_t& begin : begins)
      {
        const std::int64_t number = begin;
        begin = total;
        total += number;
      }
      if (total <= Most)
      {
        for (std::size_t tile = 0; tile <= count; ++tile)
        {
          tiles.Begins[tile] = static_cast<std::int32_t>(begins[tile * threads]);
        }
        tiles.Faces.resize(static_cast<std::size_t>(total));
      }
    }
    for (std::int64_t b = total <= Most ? first : last; b < last; ++b)
    {
      if (!bounds[b].IsEmpty())
      {
        ForEachTileOf(bounds[b], columns,
          [&](int tile)
          {
            tiles.Faces[begins[tile * threads + thread]++] = { static_cast<std::int32_t>(b),
              FindBlocks(bounds[b], tiles.Grid, tile) };
          });
      }
    }
  }
  return total <= Most;
}

} // namespace tetralux
