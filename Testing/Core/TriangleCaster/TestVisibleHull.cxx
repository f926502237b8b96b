// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleCaster/HullDepths.h"
#include "TriangleCaster/VisibleHull.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using tetralux::DepthRange;
using tetralux::HullDepths;
using tetralux::HullFace;
using tetralux::RayGrid;
using tetralux::SlicePlanes;
using tetralux::SliceShape;
using tetralux::VisibleHull;

using Point = std::array<double, 3>;

/// Depths of rays are computed twice in double precision, from coordinates of some hundred.
constexpr double DepthTolerance = 1e-9;

struct Cells
{
  int Counts[3];
  std::vector<std::uint8_t> Visible;

  std::size_t GetIndex(int x, int y, int z) const
  {
    return (static_cast<std::size_t>(z) * this->Counts[1] + y) * this->Counts[0] + x;
  }
  bool IsVisible(int x, int y, int z) const
  {
    const bool inside = x >= 0 && y >= 0 && z >= 0 && x < this->Counts[0] && y < this->Counts[1] &&
      z < this->Counts[2];
    return inside && this->Visible[this->GetIndex(x, y, z)] != 0;
  }

  /// Calls visit(x, y, z) for each visible cell.
  template <class VisitT>
  void ForEachVisible(const VisitT& visit) const
  {
    for (int z = 0; z < this->Counts[2]; ++z)
    {
      for (int y = 0; y < this->Counts[1]; ++y)
      {
        for (int x = 0; x < this->Counts[0]; ++x)
        {
          if (this->IsVisible(x, y, z))
          {
            visit(x, y, z);
          }
        }
      }
    }
  }
};

Cells MakeRandomCells(int x, int y, int z, double share, int seed)
{
  Cells cells = { { x, y, z }, {} };
  std::mt19937 generator(seed);
  std::bernoulli_distribution visible(share);
  cells.Visible.resize(static_cast<std::size_t>(x) * y * z);
  for (std::uint8_t& v : cells.Visible)
  {
    v = visible(generator) ? 1 : 0;
  }
  return cells;
}

using FaceKey = std::array<int, 6>;

FaceKey GetKey(const HullFace& face)
{
  return { face.Low[0], face.Low[1], face.Low[2], face.High[0], face.High[1], face.High[2] };
}

std::set<FaceKey> FindFaces(const Cells& cells)
{
  std::set<FaceKey> faces;
  cells.ForEachVisible(
    [&](int x, int y, int z)
    {
      const int cell[3] = { x, y, z };
      for (int axis = 0; axis < 3; ++axis)
      {
        for (const int side : { -1, 1 })
        {
          int other[3] = { x, y, z };
          other[axis] += side;
          if (!cells.IsVisible(other[0], other[1], other[2]))
          {
            FaceKey key;
            for (int a = 0; a < 3; ++a)
            {
              key[a] = cell[a] + (a == axis && side > 0 ? 1 : 0);
              key[3 + a] = a == axis ? key[a] : cell[a] + 1;
            }
            EXPECT_TRUE(faces.insert(key).second);
          }
        }
      }
    });
  return faces;
}

TEST(VisibleHull, TightHullHasEachFaceOnce)
{
  for (const double share : { 0., 0.05, 0.5, 1. })
  {
    const Cells cells = MakeRandomCells(7, 4, 9, share, 3);
    const VisibleHull hull = tetralux::MakeVisibleHull(cells.Counts, cells.Visible, 1);
    std::set<FaceKey> faces;
    for (const HullFace& face : hull.Faces)
    {
      EXPECT_TRUE(faces.insert(GetKey(face)).second);
      for (int a = 0; a < 3; ++a)
      {
        EXPECT_GE(face.Low[a], hull.Low[a]);
        EXPECT_LE(face.High[a], hull.High[a]);
      }
    }
    EXPECT_EQ(faces, FindFaces(cells));
    EXPECT_EQ(hull.GetNumberOfTriangles(), 2 * hull.Faces.size());
    EXPECT_EQ(hull.Low[0] > hull.High[0], faces.empty());
  }
}

TEST(VisibleHull, BlocksEndWhereTheVolumeDoes)
{
  Cells cells = MakeRandomCells(7, 4, 9, 0, 1);
  cells.Visible[cells.GetIndex(6, 3, 8)] = 1;
  const VisibleHull hull = tetralux::MakeVisibleHull(cells.Counts, cells.Visible, 4);
  ASSERT_EQ(hull.Faces.size(), 6u);
  EXPECT_EQ(hull.BlockSize, 4);
  const int low[3] = { 4, 0, 8 }, high[3] = { 7, 4, 9 };
  for (int a = 0; a < 3; ++a)
  {
    EXPECT_EQ(hull.Low[a], low[a]);
    EXPECT_EQ(hull.High[a], high[a]);
  }
}

TEST(VisibleHull, CoarseHullHasTheSmallestBlocks)
{
  const Cells cells = MakeRandomCells(33, 17, 20, 0.02, 5);
  for (const std::size_t most : { 100000u, 2000u, 500u, 100u, 12u, 1u })
  {
    const VisibleHull hull = tetralux::MakeCoarseHull(cells.Counts, cells.Visible, most);
    EXPECT_EQ(hull.GetNumberOfTriangles(),
      tetralux::MakeVisibleHull(cells.Counts, cells.Visible, hull.BlockSize)
        .GetNumberOfTriangles());
    if (most >= 12)
    {
      EXPECT_LE(hull.GetNumberOfTriangles(), most);
    }
    else
    {
      EXPECT_EQ(hull.GetNumberOfTriangles(), 12u); // one block
    }
    if (hull.BlockSize > 1)
    {
      EXPECT_GT(tetralux::MakeVisibleHull(cells.Counts, cells.Visible, hull.BlockSize / 2)
                  .GetNumberOfTriangles(),
        most);
    }
  }
}

TEST(VisibleHull, MaterialsHaveTheCellsOfTheirCorners)
{
  const Cells cells = MakeRandomCells(6, 5, 4, 0.5, 8);
  std::mt19937 generator(2);
  std::vector<std::uint8_t> labels(7 * 6 * 5);
  for (std::uint8_t& label : labels)
  {
    label = generator() % 8 == 0 ? static_cast<std::uint8_t>(1 + generator() % 3) : 0;
  }
  for (const std::uint8_t label : { 0, 1, 2, 3, 4 })
  {
    const std::vector<std::uint8_t> selected =
      tetralux::SelectMaterial(cells.Counts, cells.Visible, labels, label);
    std::vector<std::uint8_t> expected(cells.Visible.size());
    cells.ForEachVisible(
      [&](int x, int y, int z)
      {
        for (int corner = 0; corner < 8; ++corner)
        {
          const int i = x + (corner & 1), j = y + (corner >> 1 & 1), k = z + (corner >> 2);
          if (labels[(k * 6 + j) * 7 + i] == label)
          {
            expected[cells.GetIndex(x, y, z)] = 1;
          }
        }
      });
    EXPECT_EQ(selected, expected);
  }
}

TEST(VisibleHull, WrongNumbersAreRefused)
{
  const Cells cells = MakeRandomCells(3, 3, 3, 0.5, 1);
  const std::vector<std::uint8_t> few(26), labels(63);
  EXPECT_THROW(tetralux::MakeVisibleHull(cells.Counts, few, 1), std::invalid_argument);
  EXPECT_THROW(tetralux::MakeVisibleHull(cells.Counts, cells.Visible, 0), std::invalid_argument);
  EXPECT_THROW(
    tetralux::SelectMaterial(cells.Counts, cells.Visible, labels, 0), std::invalid_argument);
}

// Pictures.

Point Add(const Point& a, double factor, const Point& b)
{
  return { a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2] };
}

double Dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point ToPoint(const double (&v)[3]) { return { v[0], v[1], v[2] }; }

/// A camera in the world, which is the volume scaled and moved.
struct Picture
{
  std::string Name;
  RayGrid Grid;
  SlicePlanes Planes;
  int TileSize;

  static constexpr double Scales[3] = { 1.5, 0.75, 1.25 }; ///< world from volume
  static constexpr double Offsets[3] = { -3, 5, 10 };

  static Point ToWorld(const Point& p)
  {
    return { Scales[0] * p[0] + Offsets[0], Scales[1] * p[1] + Offsets[1],
      Scales[2] * p[2] + Offsets[2] };
  }
  static Point ToVolume(const Point& p)
  {
    return { (p[0] - Offsets[0]) / Scales[0], (p[1] - Offsets[1]) / Scales[1],
      (p[2] - Offsets[2]) / Scales[2] };
  }

  void GetRay(double x, double y, Point& origin, Point& direction) const
  {
    const RayGrid& g = this->Grid;
    origin = Add(Add(ToPoint(g.Origin), x, ToPoint(g.OriginStepX)), y, ToPoint(g.OriginStepY));
    direction =
      Add(Add(ToPoint(g.Direction), x, ToPoint(g.DirectionStepX)), y, ToPoint(g.DirectionStepY));
  }

  double GetDepth(const Point& world) const
  {
    const Point v = Add(world, -1, ToPoint(this->Grid.Origin));
    return this->Planes.Shape == SliceShape::Planes ? Dot(v, ToPoint(this->Planes.Normal))
                                                    : std::sqrt(Dot(v, v));
  }

  /// Where a point in front of the camera is seen, pixels; the camera's axes are orthogonal.
  std::array<double, 2> Project(const Point& world, bool& inFront) const
  {
    const RayGrid& g = this->Grid;
    const Point v = Add(world, -1, ToPoint(g.Origin));
    const Point normal = ToPoint(this->Planes.Normal);
    const double along = Dot(v, normal);
    inFront = along > 0;
    const bool parallel =
      g.DirectionStepX[0] == 0 && g.DirectionStepX[1] == 0 && g.DirectionStepX[2] == 0;
    const Point stepX = ToPoint(parallel ? g.OriginStepX : g.DirectionStepX);
    const Point stepY = ToPoint(parallel ? g.OriginStepY : g.DirectionStepY);
    // On the plane of pixels: without the part of pixel (0, 0).
    const Point direction = ToPoint(g.Direction);
    const Point onPlane = parallel
      ? Add(v, -along / Dot(direction, normal), direction)
      : Add(Add({ 0, 0, 0 }, Dot(direction, normal) / along, v), -1, direction);
    return { Dot(onPlane, stepX) / Dot(stepX, stepX), Dot(onPlane, stepY) / Dot(stepY, stepY) };
  }
};

Point Normalize(const Point& v) { return Add({ 0, 0, 0 }, 1 / std::sqrt(Dot(v, v)), v); }

Point Cross(const Point& a, const Point& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/// eye, target: in the volume. step: between rays, at the eye in the world or at distance 1.
Picture MakePicture(const std::string& name, const Cells& cells, const Point& eye,
  const Point& target, bool parallel, double step, int tileSize, SliceShape shape)
{
  Picture picture;
  picture.Name = name;
  picture.TileSize = tileSize;
  RayGrid& grid = picture.Grid;
  grid.Width = 45;
  grid.Height = 38;
  const Point from = Picture::ToWorld(eye);
  const Point ahead = Normalize(Add(Picture::ToWorld(target), -1, from));
  const Point right = Normalize(Cross(ahead, { 0.1, 0.2, 1 }));
  const Point up = Cross(right, ahead);
  // The middle of the picture is beside the target, and the first ray away from the middle.
  const Point corner =
    Add(Add({ 0, 0, 0 }, -0.5 * step * grid.Width, right), -0.47 * step * grid.Height, up);
  for (int a = 0; a < 3; ++a)
  {
    grid.Origin[a] = from[a] + (parallel ? corner[a] : 0);
    grid.Direction[a] = ahead[a] + (parallel ? 0 : corner[a]);
    (parallel ? grid.OriginStepX : grid.DirectionStepX)[a] = step * right[a];
    (parallel ? grid.OriginStepY : grid.DirectionStepY)[a] = step * up[a];
    grid.MeshFromWorld[a][a] = 1 / Picture::Scales[a];
    grid.MeshFromWorld[a][3] = -Picture::Offsets[a] / Picture::Scales[a];
    for (int b = 0; b < 3; ++b)
    {
      grid.MeshFromWorld[a][b] = a == b ? 1 / Picture::Scales[a] : 0;
    }
  }
  tetralux::ImageVolume volume;
  for (int a = 0; a < 3; ++a)
  {
    volume.Dimensions[a] = cells.Counts[a] + 1;
  }
  picture.Planes = tetralux::MakeSlicePlanes(volume, grid, shape, 0.75);
  return picture;
}

std::vector<Picture> MakePictures(const Cells& cells)
{
  const Point middle = { 0.5 * cells.Counts[0], 0.5 * cells.Counts[1], 0.5 * cells.Counts[2] };
  const Point outside = { -20, 31, 24 };
  const Point inside = { middle[0] + 0.3, middle[1] - 0.2, middle[2] + 1.4 };
  constexpr SliceShape Planes = SliceShape::Planes;
  return { MakePicture("perspective", cells, outside, middle, false, 0.012, 8, Planes),
    MakePicture("parallel", cells, outside, middle, true, 0.5, 8, Planes),
    MakePicture("tiles of 5", cells, outside, middle, false, 0.02, 5, Planes),
    MakePicture("shells", cells, outside, middle, false, 0.015, 8, SliceShape::Shells),
    MakePicture("from inside", cells, inside, outside, false, 0.05, 8, Planes),
    MakePicture("shells from inside", cells, inside, outside, false, 0.05, 8, SliceShape::Shells),
    MakePicture("parallel from inside", cells, inside, outside, true, 0.1, 8, Planes) };
}

bool IsFromInside(const Picture& picture)
{
  return picture.Name.find("inside") != std::string::npos;
}

/// First and last meeting of a ray with the visible cells, in units of direction, each cell on its
/// own. start, direction: in the volume.
DepthRange MeetCells(const Cells& cells, const Point& start, const Point& direction)
{
  DepthRange met;
  cells.ForEachVisible(
    [&](int x, int y, int z)
    {
      const int low[3] = { x, y, z };
      double t0 = 0;
      double t1 = std::numeric_limits<double>::infinity();
      for (int a = 0; a < 3; ++a)
      {
        const double u = (low[a] - start[a]) / direction[a];
        const double v = (low[a] + 1 - start[a]) / direction[a];
        t0 = std::max(t0, std::min(u, v));
        t1 = std::min(t1, std::max(u, v));
      }
      if (t0 <= t1)
      {
        met.Add(t0, t1);
      }
    });
  return met;
}

TEST(HullDepths, OfRaysAreThoseOfCells)
{
  const Cells cells = MakeRandomCells(12, 14, 9, 0.03, 11);
  const VisibleHull hull = tetralux::MakeVisibleHull(cells.Counts, cells.Visible, 1);
  for (const Picture& picture : MakePictures(cells))
  {
    if (IsFromInside(picture))
    {
      continue; // rays start in the box around the hull: their fronts are only bounds
    }
    const testing::ScopedTrace trace(__FILE__, __LINE__, picture.Name);
    const RayGrid& grid = picture.Grid;
    const HullDepths depths =
      tetralux::FindDepthsOfRays({ &hull, 1 }, grid, picture.Planes, picture.TileSize, 1);
    const int columns = (grid.Width + picture.TileSize - 1) / picture.TileSize;
    std::vector<DepthRange> expected(depths.Triangles.size());
    for (int y = 0; y < grid.Height; ++y)
    {
      for (int x = 0; x < grid.Width; ++x)
      {
        Point origin, direction;
        picture.GetRay(x, y, origin, direction);
        const Point start = Picture::ToVolume(origin);
        const DepthRange met =
          MeetCells(cells, start, Add(Picture::ToVolume(Add(origin, 1, direction)), -1, start));
        if (!met.IsEmpty())
        {
          const int tile = y / picture.TileSize * columns + x / picture.TileSize;
          const int half = x % picture.TileSize >= y % picture.TileSize ? 0 : 1;
          expected[2 * tile + half].Add(picture.GetDepth(Add(origin, met.Front, direction)),
            picture.GetDepth(Add(origin, met.Back, direction)));
        }
      }
    }
    int filled = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      ASSERT_EQ(depths.Triangles[i].IsEmpty(), expected[i].IsEmpty()) << i;
      if (!expected[i].IsEmpty())
      {
        ++filled;
        EXPECT_NEAR(depths.Triangles[i].Front, expected[i].Front, DepthTolerance);
        EXPECT_NEAR(depths.Triangles[i].Back, expected[i].Back, DepthTolerance);
      }
    }
    EXPECT_GT(filled, 10);
    EXPECT_LT(filled, static_cast<int>(expected.size()));
  }
}

/// Calls visit(range of an S-triangle, its number) for all S-triangles of which a pixel's square,
/// grown by margin, has the place.
template <class VisitT>
void ForTrianglesAt(
  const Picture& picture, const std::array<double, 2>& place, double margin, const VisitT& visit)
{
  const int size = picture.TileSize;
  const int columns = (picture.Grid.Width + size - 1) / size;
  std::set<int> triangles;
  const auto first = [&](int axis)
  { return static_cast<int>(std::ceil(place[axis] - 0.5 - margin)); };
  const auto last = [&](int axis)
  { return static_cast<int>(std::floor(place[axis] + 0.5 + margin)); };
  for (int y = std::max(first(1), 0); y <= std::min(last(1), picture.Grid.Height - 1); ++y)
  {
    for (int x = std::max(first(0), 0); x <= std::min(last(0), picture.Grid.Width - 1); ++x)
    {
      triangles.insert(2 * (y / size * columns + x / size) + (x % size >= y % size ? 0 : 1));
    }
  }
  for (const int triangle : triangles)
  {
    visit(triangle);
  }
}

/// Far from any pixel, so that no projection is in doubt.
bool IsPlausible(const std::array<double, 2>& place)
{
  return std::abs(place[0]) < 1e6 && std::abs(place[1]) < 1e6;
}

TEST(HullDepths, OfPixelsContainCellsAndLittleElse)
{
  const Cells cells = MakeRandomCells(12, 14, 9, 0.03, 11);
  const VisibleHull tight = tetralux::MakeVisibleHull(cells.Counts, cells.Visible, 1);
  const VisibleHull coarse = tetralux::MakeCoarseHull(cells.Counts, cells.Visible, 300);
  ASSERT_GT(coarse.BlockSize, 1);
  // Points of a cell's edge, 0 and 1 among them.
  constexpr int Points = 9;
  for (const Picture& picture : MakePictures(cells))
  {
    const testing::ScopedTrace trace(__FILE__, __LINE__, picture.Name);
    const HullDepths tightDepths = tetralux::FindDepthsOfPixels(
      { &tight, 1 }, picture.Grid, picture.Planes, picture.TileSize, 1);
    const HullDepths coarseDepths = tetralux::FindDepthsOfPixels(
      { &coarse, 1 }, picture.Grid, picture.Planes, picture.TileSize, 1);
    std::vector<DepthRange> widest(tightDepths.Triangles.size());
    int seen = 0;
    cells.ForEachVisible(
      [&](int x, int y, int z)
      {
        for (int point = 0; point < Points * Points * Points; ++point)
        {
          const Point world = Picture::ToWorld({ x + double(point % Points) / (Points - 1),
            y + double(point / Points % Points) / (Points - 1),
            z + double(point / Points / Points) / (Points - 1) });
          bool inFront = false;
          const std::array<double, 2> place = picture.Project(world, inFront);
          if (!inFront || !IsPlausible(place))
          {
            continue;
          }
          const double depth = picture.GetDepth(world);
          ForTrianglesAt(picture, place, 0,
            [&](int i)
            {
              ++seen;
              for (const HullDepths* depths : { &tightDepths, &coarseDepths })
              {
                ASSERT_LE(depths->Triangles[i].Front, depth) << x << " " << y << " " << z;
                ASSERT_GE(depths->Triangles[i].Back, depth) << x << " " << y << " " << z;
              }
            });
          // A pixel, and some more for what lies between the points.
          ForTrianglesAt(picture, place, 1.5, [&](int i) { widest[i].Add(depth, depth); });
        }
      });
    EXPECT_GT(seen, 1000);
    if (!IsFromInside(picture))
    {
      // Points are less than this apart, and tiles of shells less curved.
      constexpr double Gap = 2 * 1.5 / (Points - 1);
      for (std::size_t i = 0; i < widest.size(); ++i)
      {
        if (widest[i].IsEmpty())
        {
          EXPECT_TRUE(tightDepths.Triangles[i].IsEmpty()) << i;
        }
        else if (!tightDepths.Triangles[i].IsEmpty())
        {
          EXPECT_GE(tightDepths.Triangles[i].Front, widest[i].Front - Gap) << i;
          EXPECT_LE(tightDepths.Triangles[i].Back, widest[i].Back + Gap) << i;
        }
      }
    }
  }
}

TEST(HullDepths, OfPixelsContainThoseOfRays)
{
  const Cells cells = MakeRandomCells(12, 14, 9, 0.03, 12);
  const VisibleHull hull = tetralux::MakeVisibleHull(cells.Counts, cells.Visible, 1);
  for (const Picture& picture : MakePictures(cells))
  {
    const testing::ScopedTrace trace(__FILE__, __LINE__, picture.Name);
    const HullDepths rays =
      tetralux::FindDepthsOfRays({ &hull, 1 }, picture.Grid, picture.Planes, picture.TileSize, 1);
    const HullDepths pixels =
      tetralux::FindDepthsOfPixels({ &hull, 1 }, picture.Grid, picture.Planes, picture.TileSize, 1);
    for (std::size_t i = 0; i < rays.Triangles.size(); ++i)
    {
      if (!rays.Triangles[i].IsEmpty())
      {
        EXPECT_LE(pixels.Triangles[i].Front, rays.Triangles[i].Front) << i;
        EXPECT_GE(pixels.Triangles[i].Back, rays.Triangles[i].Back) << i;
      }
    }
  }
}

TEST(HullDepths, InsideAVolumeTheFrontIsAtTheCamera)
{
  const Cells cells = MakeRandomCells(12, 14, 9, 1, 1);
  const VisibleHull hull = tetralux::MakeVisibleHull(cells.Counts, cells.Visible, 1);
  for (const Picture& picture : MakePictures(cells))
  {
    if (!IsFromInside(picture))
    {
      continue;
    }
    const testing::ScopedTrace trace(__FILE__, __LINE__, picture.Name);
    for (const auto& find : { tetralux::FindDepthsOfRays, tetralux::FindDepthsOfPixels })
    {
      const HullDepths depths =
        find({ &hull, 1 }, picture.Grid, picture.Planes, picture.TileSize, 1);
      int filled = 0;
      for (const DepthRange& range : depths.Triangles)
      {
        if (!range.IsEmpty())
        {
          ++filled;
          EXPECT_EQ(range.Front, 0);
          EXPECT_GT(range.Back, 1);
        }
      }
      EXPECT_GT(filled, 10);
    }
  }
}

TEST(HullDepths, SeveralHullsAreBoundedTogether)
{
  const Cells cells = MakeRandomCells(12, 14, 9, 0.03, 13);
  const Cells others = MakeRandomCells(12, 14, 9, 0.01, 14);
  const VisibleHull hulls[2] = { tetralux::MakeVisibleHull(cells.Counts, cells.Visible, 1),
    tetralux::MakeVisibleHull(others.Counts, others.Visible, 1) };
  const Picture picture = MakePictures(cells)[0];
  for (const auto& find : { tetralux::FindDepthsOfRays, tetralux::FindDepthsOfPixels })
  {
    const HullDepths both = find({ hulls, 2 }, picture.Grid, picture.Planes, picture.TileSize, 1);
    const HullDepths first =
      find({ &hulls[0], 1 }, picture.Grid, picture.Planes, picture.TileSize, 1);
    const HullDepths second =
      find({ &hulls[1], 1 }, picture.Grid, picture.Planes, picture.TileSize, 1);
    for (std::size_t i = 0; i < both.Triangles.size(); ++i)
    {
      EXPECT_EQ(
        both.Triangles[i].Front, std::min(first.Triangles[i].Front, second.Triangles[i].Front));
      EXPECT_EQ(
        both.Triangles[i].Back, std::max(first.Triangles[i].Back, second.Triangles[i].Back));
    }
  }
}

TEST(HullDepths, ThreadsChangeNothing)
{
  const Cells cells = MakeRandomCells(12, 14, 9, 0.1, 15);
  const VisibleHull hull = tetralux::MakeVisibleHull(cells.Counts, cells.Visible, 1);
  const Picture picture = MakePictures(cells)[0];
  for (const auto& find : { tetralux::FindDepthsOfRays, tetralux::FindDepthsOfPixels })
  {
    const HullDepths one = find({ &hull, 1 }, picture.Grid, picture.Planes, picture.TileSize, 1);
    for (const int threads : { 2, 3, 7 })
    {
      const HullDepths more =
        find({ &hull, 1 }, picture.Grid, picture.Planes, picture.TileSize, threads);
      for (std::size_t i = 0; i < one.Triangles.size(); ++i)
      {
        EXPECT_EQ(one.Triangles[i].Front, more.Triangles[i].Front);
        EXPECT_EQ(one.Triangles[i].Back, more.Triangles[i].Back);
      }
    }
  }
}

TEST(HullDepths, ATileIsCutIntoThirtySixAndTwentyEightPixels)
{
  int counts[2] = { 0, 0 };
  for (int pixel = 0; pixel < 64; ++pixel)
  {
    ++counts[tetralux::GetTriangleOfPixel(pixel % 8, pixel / 8)];
  }
  EXPECT_EQ(counts[0], 36);
  EXPECT_EQ(counts[1], 28);
}

TEST(HullDepths, RaysInAPlaneAreRefused)
{
  const Cells cells = MakeRandomCells(4, 4, 4, 1, 1);
  const VisibleHull hull = tetralux::MakeVisibleHull(cells.Counts, cells.Visible, 1);
  Picture picture = MakePictures(cells)[1];
  std::fill_n(picture.Grid.OriginStepY, 3, 0.);
  for (const auto& find : { tetralux::FindDepthsOfRays, tetralux::FindDepthsOfPixels })
  {
    EXPECT_THROW(find({ &hull, 1 }, picture.Grid, picture.Planes, 8, 1), std::invalid_argument);
  }
}

} // namespace
