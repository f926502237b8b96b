// SPDX-License-Identifier: BSD-3-Clause
#include "CellProjection.h"

#include "LocalScreen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tetralux
{
namespace
{

/// Volumes below this times the product of three edges are rounding alone.
constexpr double SmallestRelativeVolume = 1e-15;

/// Slopes of a face in z beyond this belong to one that is seen exactly from the side: no pixel's
/// centre lies on it. Their products with pixels stay in the range of single precision.
constexpr double LargestSlope = 1e30;

/// What a face has in place of its function where it never limits a ray.
constexpr float Never = 1e37f;

/// A widened corner may move by this many margins; sharper ones get a rectangle around all.
constexpr double LongestMiter = 64;

/// Corners farther from the picture than this, in pixels, would cost a rasteriser its accuracy.
constexpr double LargestPosition = 16384;

/// A linear function of the pixel, relative to a cell's reference.
struct Linear
{
  double Value, SlopeX, SlopeY;
};

Linear operator-(const Linear& a, const Linear& b)
{
  return { a.Value - b.Value, a.SlopeX - b.SlopeX, a.SlopeY - b.SlopeY };
}

void Store(const Linear& f, double factor, float result[3])
{
  result[0] = static_cast<float>(factor * f.Value);
  result[1] = static_cast<float>(factor * f.SlopeX);
  result[2] = static_cast<float>(factor * f.SlopeY);
}

struct Place
{
  double X, Y;
};

/// Cuts off what is beyond the picture; false where no pixel's centre is left.
bool Clamp(ScreenBox& box, const ProjectionSettings& settings)
{
  const double size[2] = { static_cast<double>(settings.Width),
    static_cast<double>(settings.Height) };
  for (int a = 0; a < 2; ++a)
  {
    box.Lo[a] = Bound(box.Lo[a], -1, size[a] + 1);
    box.Hi[a] = Bound(box.Hi[a], -2, size[a]);
    if (!(-Floor(settings.Margin - box.Lo[a]) <= Floor(box.Hi[a] + settings.Margin)))
    {
      return false;
    }
  }
  return box.Lo[0] < size[0] && box.Lo[1] < size[1] && box.Hi[0] > -1 && box.Hi[1] > -1;
}

/// A convex polygon, each edge moved outwards; false where a corner is too sharp for that.
bool Widen(Place* corners, int n, double margin)
{
  double area = 0;
  for (int k = 0; k < n; ++k)
  {
    const Place& a = corners[k];
    const Place& b = corners[(k + 1) % n];
    area +=
      (a.X - corners[0].X) * (b.Y - corners[0].Y) - (a.Y - corners[0].Y) * (b.X - corners[0].X);
  }
  Place normals[4]; // of the edge from each corner on, outwards
  for (int k = 0; k < n; ++k)
  {
    const double dx = corners[(k + 1) % n].X - corners[k].X;
    const double dy = corners[(k + 1) % n].Y - corners[k].Y;
    const double scale = (area < 0 ? -1 : 1) / std::sqrt(dx * dx + dy * dy);
    normals[k] = { dy * scale, -dx * scale };
  }
  for (int k = 0; k < n; ++k)
  {
    const Place& before = normals[(k + n - 1) % n];
    const Place& after = normals[k];
    const double sum = 1 + before.X * after.X + before.Y * after.Y; // 2 cos^2 of half the angle
    if (!(sum >= 2 / (LongestMiter * LongestMiter)))
    {
      return false;
    }
    corners[k].X += margin * (before.X + after.X) / sum;
    corners[k].Y += margin * (before.Y + after.Y) / sum;
  }
  return true;
}

/// A rectangle around all points, along the longest edge between them.
void FindRectangle(const ScreenPoint* const points[4], double margin, Place corners[4])
{
  double longest = 0;
  Place along = { 1, 0 };
  for (int i = 0; i < 4; ++i)
  {
    for (int k = 0; k < i; ++k)
    {
      const double dx = points[i]->X - points[k]->X;
      const double dy = points[i]->Y - points[k]->Y;
      const double length = std::sqrt(dx * dx + dy * dy);
      if (length > longest)
      {
        longest = length;
        along = { dx / length, dy / length };
      }
    }
  }
  ScreenBox box; // along and across
  for (int i = 0; i < 4; ++i)
  {
    const double dx = points[i]->X - points[0]->X;
    const double dy = points[i]->Y - points[0]->Y;
    box.Add(dx * along.X + dy * along.Y, dy * along.X - dx * along.Y);
  }
  for (int k = 0; k < 4; ++k)
  {
    const double u = k == 0 || k == 3 ? box.Lo[0] - margin : box.Hi[0] + margin;
    const double v = k < 2 ? box.Lo[1] - margin : box.Hi[1] + margin;
    corners[k] = { points[0]->X + u * along.X - v * along.Y,
      points[0]->Y + u * along.Y + v * along.X };
  }
}

/// The silhouette by the classes of the paper's figure 1. front: of each face, opposite to the
/// point of that number. Returns its number of corners, 0 where it is of no class.
int FindSilhouette(const ScreenPoint* const points[4], const bool front[4], Place corners[4])
{
  const int fronts = front[0] + front[1] + front[2] + front[3];
  int order[4];
  int n = 0;
  if (fronts == 1 || fronts == 3)
  {
    // Class 1: the triangle of the one face that looks the other way.
    for (int i = 0; i < 4; ++i)
    {
      if (front[i] != (fronts == 1))
      {
        order[n++] = i;
      }
    }
  }
  else if (fronts == 2)
  {
    // Class 2: the edge between the front faces joins the points that back faces are opposite to,
    // and crosses the edge between the back faces.
    int first = 0;
    int second = 1;
    for (int i = 0; i < 4; ++i)
    {
      if (front[i])
      {
        order[first] = i;
        first += 2;
      }
      else
      {
        order[second] = i;
        second += 2;
      }
    }
    n = 4;
  }
  for (int k = 0; k < n; ++k)
  {
    corners[k] = { points[order[k]]->X, points[order[k]]->Y };
  }
  return n;
}

/// The tetrahedron whose faces and field become linear functions of the pixel, relative to a
/// reference pixel: of (x t, y t, t) with the eye in the origin, or of (x, y, t).
class LocalCell
{
public:
  LocalCell(const ScreenFrame& frame, const ScreenPoint* const points[4], bool homogeneous,
    double referenceX, double referenceY)
    : Homogeneous(homogeneous)
  {
    for (int i = 0; i < 4; ++i)
    {
      const ScreenPoint& p = *points[i];
      this->Points[i] = homogeneous ? GetHomogeneous(frame, p, referenceX, referenceY)
                                    : Vector{ p.X - referenceX, p.Y - referenceY, p.Depth };
    }
    const Vector a = this->Points[1] - this->Points[0];
    const Vector b = this->Points[2] - this->Points[0];
    const Vector c = this->Points[3] - this->Points[0];
    this->Normals[1] = Cross(b, c);
    this->Normals[2] = Cross(c, a);
    this->Normals[3] = Cross(a, b);
    this->Volume = Dot(this->Normals[1], a);
    this->HasVolume = this->Volume * this->Volume >
      SmallestRelativeVolume * SmallestRelativeVolume * (Dot(a, a) * Dot(b, b) * Dot(c, c));
    Vector& rest = this->Normals[0];
    rest = { 0, 0, 0 };
    this->Heights[0] = -this->Volume;
    for (int i = 1; i < 4; ++i)
    {
      const Vector& normal = this->Normals[i];
      rest = rest - normal;
      this->Heights[i] = Dot(normal, this->Points[0]);
      this->Heights[0] -= this->Heights[i];
    }
  }

  /// Whether there is anything inside, beyond rounding.
  bool HasVolume;

  /// z on a face, and whether rays enter by it; false where it is seen from the side.
  bool FindFace(int i, Linear& face, bool& front) const
  {
    const Vector& normal = this->Normals[i];
    if (this->Homogeneous)
    {
      const double height = this->Heights[i];
      const double inverse = 1 / height;
      face = { normal.Z * inverse, normal.X * inverse, normal.Y * inverse };
      front = (height > 0) == (this->Volume > 0);
    }
    else
    {
      const double inverse = 1 / normal.Z;
      face = { -this->Heights[i] * inverse, normal.X * inverse, normal.Y * inverse };
      front = (normal.Z > 0) == (this->Volume > 0);
    }
    return std::abs(face.Value) + std::abs(face.SlopeX) + std::abs(face.SlopeY) <= LargestSlope;
  }

  /// Of a face that is seen from the side: more than any z in front of it, less behind it.
  Linear FindSide(int i) const
  {
    const Vector& normal = this->Normals[i];
    const double size = std::max(std::abs(normal.X), std::abs(normal.Y));
    if (!(size > 0))
    {
      return { Never, 0, 0 };
    }
    const double scale = (this->Volume > 0 ? LargestSlope : -LargestSlope) / size;
    // In the plane of (x t, y t, t) that the eye is in, or of a direction without depth.
    const double constant = this->Homogeneous ? normal.Z : -this->Heights[i];
    return { scale * constant, scale * normal.X, scale * normal.Y };
  }

  /// A value that is linear in the cell, from those at its points: at z = base + something, times z
  /// where homogeneous, on base and for something.
  void FindField(const double values[4], const Linear& base, Linear& onBase, double& slope) const
  {
    Vector gradient = { 0, 0, 0 };
    const double inverse = 1 / this->Volume;
    for (int i = 1; i < 4; ++i)
    {
      const double share = (values[i] - values[0]) * inverse;
      gradient.X += share * this->Normals[i].X;
      gradient.Y += share * this->Normals[i].Y;
      gradient.Z += share * this->Normals[i].Z;
    }
    const double origin = values[0] - Dot(gradient, this->Points[0]);
    if (this->Homogeneous)
    {
      // value z = origin z + gradient . (x, y, 1)
      slope = origin;
      onBase = { gradient.Z, gradient.X, gradient.Y };
    }
    else
    {
      // value = origin + gradient . (x, y, -z)
      slope = -gradient.Z;
      onBase = { origin, gradient.X, gradient.Y };
    }
    onBase.Value += slope * base.Value;
    onBase.SlopeX += slope * base.SlopeX;
    onBase.SlopeY += slope * base.SlopeY;
  }

private:
  bool Homogeneous;
  Vector Points[4];
  Vector Normals[4]; ///< of each face, opposite to the point of that number; inwards for Volume > 0
  double Heights[4]; ///< normal . face
  double Volume;     ///< six times that of the cell, signed
};

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

/// ProjectCell, with gradients where gradient is not nullptr. faceOrder: the face that is the base,
/// and those of Faces, each by the point opposite to it.
int Project(const ScreenFrame& frame, const ProjectionSettings& settings,
  const std::array<const ScreenPoint*, 4>& cellPoints, ProjectedCell& result,
  const double (*gradients)[3], ProjectedGradient* gradient, int (&faceOrder)[4])
{
  const ScreenPoint* const points[4] = { cellPoints[0], cellPoints[1], cellPoints[2],
    cellPoints[3] };
  const ScreenPoint& a = *points[0];
  const ScreenPoint& b = *points[1];
  const ScreenPoint& c = *points[2];
  const ScreenPoint& d = *points[3];
  const bool allInFront =
    frame.IsInFront(a) && frame.IsInFront(b) && frame.IsInFront(c) && frame.IsInFront(d);
  ScreenBox box = FindBox(frame, points);
  const ScreenBox whole = box;
  if (!Clamp(box, settings) || (!allInFront && !settings.Interpolate))
  {
    return 0;
  }
  const double referenceX = Floor(0.5 * (box.Lo[0] + box.Hi[0]));
  const double referenceY = Floor(0.5 * (box.Lo[1] + box.Hi[1]));
  const LocalCell cell(frame, points, frame.IsPerspective() && settings.Interpolate,
    referenceX + settings.Shift, referenceY + ShiftSlope * settings.Shift);
  double scalarLo = a.Scalar;
  double scalarHi = a.Scalar;
  double scalarSum = 0;
  for (const ScreenPoint* point : points)
  {
    scalarLo = std::min(scalarLo, point->Scalar);
    scalarHi = std::max(scalarHi, point->Scalar);
    scalarSum += point->Scalar;
  }
  if (!cell.HasVolume || !std::isfinite(scalarSum))
  {
    return 0;
  }

  Linear faces[4];
  bool seen[4];
  bool front[4];
  int base = -1;
  double leastSlope = std::numeric_limits<double>::max();
  bool allSeen = true;
  for (int i = 0; i < 4; ++i)
  {
    seen[i] = cell.FindFace(i, faces[i], front[i]);
    allSeen = allSeen && seen[i];
    const double slope = faces[i].SlopeX * faces[i].SlopeX + faces[i].SlopeY * faces[i].SlopeY;
    if (seen[i] && slope < leastSlope)
    {
      leastSlope = slope;
      base = i;
    }
  }
  if (base < 0)
  {
    return 0;
  }

  // The silhouette.
  Place corners[4];
  int n = 0;
  const bool near = allInFront && whole.Lo[0] > -LargestPosition &&
    whole.Lo[1] > -LargestPosition && whole.Hi[0] < LargestPosition &&
    whole.Hi[1] < LargestPosition;
  if (near && allSeen)
  {
    n = FindSilhouette(points, front, corners);
  }
  if (n == 0 || !Widen(corners, n, settings.Margin))
  {
    n = 4;
    if (near)
    {
      FindRectangle(points, settings.Margin, corners);
    }
    else
    {
      const double m = settings.Margin;
      corners[0] = { box.Lo[0] - m, box.Lo[1] - m };
      corners[1] = { box.Hi[0] + m, box.Lo[1] - m };
      corners[2] = { box.Hi[0] + m, box.Hi[1] + m };
      corners[3] = { box.Lo[0] - m, box.Hi[1] + m };
    }
  }
  constexpr double Half = 0.5; // from pixels to the coordinates of gl_FragCoord
  const auto place = [&](int k, float& x, float& y)
  {
    x = static_cast<float>(corners[k].X + Half);
    y = static_cast<float>(corners[k].Y + Half);
  };
  place(0, result.First.X, result.First.Y);
  place(1, result.Second.X, result.Second.Y);
  place(2, result.Third.X, result.Third.Y);
  place(n == 4 ? 3 : 0, result.Fourth.X, result.Fourth.Y);

  // The faces, those of the side of the base first, and with them those that are seen from the
  // side.
  const double sign = front[base] ? 1 : -1;
  float* slots[3] = { result.First.Face0, result.Second.Face1, result.Second.Face2 };
  int entries = 0;
  int exits = 0;
  faceOrder[0] = base;
  for (int i = 0; i < 4; ++i)
  {
    if (i != base)
    {
      const bool entry = !seen[i] || front[i] == front[base];
      const int slot = entry ? entries++ : 2 - exits++;
      faceOrder[slot + 1] = i;
      if (seen[i])
      {
        Store(faces[i] - faces[base], sign, slots[slot]);
      }
      else
      {
        Store(cell.FindSide(i), 1, slots[slot]);
      }
    }
  }
  if (exits == 0 && allInFront)
  {
    return 0; // rounding left nothing of it
  }
  Store(faces[base], 1, result.First.Base);

  Linear scalar;
  double slope;
  const double scalars[4] = { a.Scalar, b.Scalar, c.Scalar, d.Scalar };
  cell.FindField(scalars, faces[base], scalar, slope);
  Store(scalar, 1, result.Third.Scalar);
  result.Third.ScalarSlope = static_cast<float>(sign * slope);
  result.Third.ScalarRange[0] = static_cast<float>(scalarLo);
  result.Third.ScalarRange[1] = static_cast<float>(scalarHi);
  result.Fourth.Reference[0] = static_cast<float>(referenceX + Half);
  result.Fourth.Reference[1] = static_cast<float>(referenceY + Half);
  result.Fourth.Code = static_cast<float>(entries + (sign < 0 ? 4 : 0));
  for (int component = 0; gradient && component < 3; ++component)
  {
    const double values[4] = { gradients[0][component], gradients[1][component],
      gradients[2][component], gradients[3][component] };
    Linear field;
    cell.FindField(values, faces[base], field, slope);
    gradient->Base[component] = static_cast<float>(field.Value);
    gradient->SlopeX[component] = static_cast<float>(field.SlopeX);
    gradient->SlopeY[component] = static_cast<float>(field.SlopeY);
    gradient->Slope[component] = static_cast<float>(sign * slope);
  }
  return n;
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
  const auto subtract = [&](int i)
  {
    const double* p = &coordinates[3 * static_cast<std::size_t>(cell[i])];
    const double* q = &coordinates[3 * static_cast<std::size_t>(cell[0])];
    return Vector{ p[0] - q[0], p[1] - q[1], p[2] - q[2] };
  };
  const Vector a = subtract(1);
  const Vector b = subtract(2);
  const Vector c = subtract(3);
  const Vector normals[3] = { Cross(b, c), Cross(c, a), Cross(a, b) };
  const double sign = Dot(normals[0], a) < 0 ? -1 : 1;
  Vector sum = { 0, 0, 0 };
  for (int i = 0; i < 3; ++i)
  {
    const double change = sign * (points[cell[i + 1]].Scalar - points[cell[0]].Scalar);
    sum = { sum.X + change * normals[i].X, sum.Y + change * normals[i].Y,
      sum.Z + change * normals[i].Z };
  }
  // A length of 1 keeps it in the range of single precision.
  const double length = std::max({ std::abs(sum.X), std::abs(sum.Y), std::abs(sum.Z) });
  const double scale = length > 0 ? 1 / length : 0;
  gradient[0] = scale * sum.X;
  gradient[1] = scale * sum.Y;
  gradient[2] = scale * sum.Z;
}

/// Gradients at the points of a cell as they are asked for.
void FindGradients(const CellData& data, Span<const ScreenPoint> points, const std::int32_t* cell,
  double gradients[4][3])
{
  for (int i = 0; i < 4; ++i)
  {
    if (data.Gradients == CellData::Gradient::Points)
    {
      const PointGradient& gradient = data.PointGradients[cell[i]];
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

/// The functions of a cell's four faces, each one's points in ascending order. faces: see Project.
void FindFaceScalars(const ScreenFrame& frame, const ProjectionSettings& settings,
  Span<const ScreenPoint> points, const std::int32_t* cell, const int (&faces)[4],
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

int ProjectCell(const ScreenFrame& frame, const ProjectionSettings& settings, const ScreenPoint& a,
  const ScreenPoint& b, const ScreenPoint& c, const ScreenPoint& d, ProjectedCell& result)
{
  int faces[4];
  return Project(frame, settings, { &a, &b, &c, &d }, result, nullptr, nullptr, faces);
}

int ProjectCell(const ScreenFrame& frame, const ProjectionSettings& settings, const ScreenPoint& a,
  const ScreenPoint& b, const ScreenPoint& c, const ScreenPoint& d, ProjectedCell& result,
  const double gradients[4][3], ProjectedGradient& gradient)
{
  int faces[4];
  return Project(frame, settings, { &a, &b, &c, &d }, result, gradients, &gradient, faces);
}

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
  // Blocks of cells are projected side by side, and pushed together behind that, on one thread: threads
  // that run out of work wait busily, at the cost of a rasteriser that runs beside them.
  constexpr std::int64_t BlockSize = 512;
  const auto n = static_cast<std::int64_t>(order.size());
  const std::int64_t blocks = (n + BlockSize - 1) / BlockSize;
  std::vector<std::int64_t> counts(blocks); // of the cells that are seen
  std::vector<std::uint8_t> corners(n);
  const bool interpolated = frame.IsPerspective() && !settings.Interpolate;
  result.Cells.resize(interpolated ? 0 : n);
  result.InterpolatedCells.resize(interpolated ? n : 0);
  const bool withGradients = data.Gradients != CellData::Gradient::None;
  result.Gradients.resize(withGradients ? n : 0);
  result.FaceScalars.resize(data.FaceScalars ? 4 * n : 0);
#pragma omp parallel for schedule(dynamic)
  for (std::int64_t block = 0; block < blocks; ++block)
  {
    const std::int64_t begin = block * BlockSize;
    const std::int64_t end = std::min(begin + BlockSize, n);
    std::int64_t last = begin;
    for (std::int64_t i = begin; i < end; ++i)
    {
      const std::int32_t cell = order[i];
      const std::int32_t* p = &cells[4 * static_cast<std::size_t>(cell)];
      ProjectedCell own;
      ProjectedCell& projected = interpolated ? own : result.Cells[last];
      double gradients[4][3];
      if (withGradients)
      {
        FindGradients(data, points, p, gradients);
      }
      int faces[4];
      const int count =
        Project(frame, settings, { &points[p[0]], &points[p[1]], &points[p[2]], &points[p[3]] },
          projected, gradients, withGradients ? &result.Gradients[last] : nullptr, faces);
      if (count == 0)
      {
        continue;
      }
      if (data.FaceScalars)
      {
        FindFaceScalars(frame, settings, points, p, faces, &result.FaceScalars[4 * last]);
      }
      if (data.Keys)
      {
        projected.Fourth.Code += static_cast<float>(8 * MakeKey(cell));
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
    counts[block] = last - begin;
  }
  result.Triangles.clear();
  std::int64_t seen = 0;
  for (std::int64_t block = 0; block < blocks; ++block)
  {
    const std::int64_t begin = block * BlockSize;
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
      const auto corner = static_cast<std::uint32_t>(4 * seen);
      for (std::uint32_t k = 1; k + 1 < corners[i]; ++k)
      {
        result.Triangles.insert(result.Triangles.end(), { corner + k, corner + k + 1, corner });
      }
    }
  }
  result.Cells.resize(interpolated ? 0 : seen + 1);
  result.InterpolatedCells.resize(interpolated ? seen + 1 : 0);
  result.Gradients.resize(withGradients ? seen + 1 : 0);
  result.FaceScalars.resize(data.FaceScalars ? 4 * seen : 0);
}

} // namespace tetralux
