// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceConvexity.h"

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <tuple>

namespace tetralux
{
namespace
{

using Vector = std::array<double, 3>;
using Face = std::array<std::int32_t, 3>;

Vector operator-(const Vector& p, const Vector& q)
{
  return { p[0] - q[0], p[1] - q[1], p[2] - q[2] };
}

Vector Cross(const Vector& p, const Vector& q)
{
  return { p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0] };
}

double Dot(const Vector& p, const Vector& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

/// The whole with one id for all points at the same place and without cells that collapse by that;
/// for each face the cells that have it.
class Whole
{
public:
  explicit Whole(const ConvexifiedMesh& mesh)
    : Points(mesh.Points)
  {
    std::map<Vector, std::int32_t> places;
    std::vector<std::int32_t> first(mesh.Points.size() / 3);
    for (std::size_t i = 0; i < first.size(); ++i)
    {
      first[i] =
        places
          .try_emplace(this->GetPoint(static_cast<std::int32_t>(i)), static_cast<std::int32_t>(i))
          .first->second;
    }
    for (const auto* cells : { &mesh.Cells, &mesh.ImaginaryCells })
    {
      for (std::size_t i = 0; i < cells->size(); i += 4)
      {
        std::array<std::int32_t, 4> cell;
        for (int j = 0; j < 4; ++j)
        {
          cell[j] = first[(*cells)[i + j]];
        }
        std::array<std::int32_t, 4> sorted = cell;
        std::sort(sorted.begin(), sorted.end());
        if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end())
        {
          this->Cells.push_back(cell);
        }
      }
      if (cells == &mesh.Cells)
      {
        this->NumberOfReal = static_cast<std::int32_t>(this->Cells.size());
      }
    }

    std::vector<std::tuple<Face, std::int32_t>> faces; // and 4 * cell + face
    for (std::size_t cell = 0; cell < this->Cells.size(); ++cell)
    {
      for (int i = 0; i < 4; ++i)
      {
        Face face = this->GetFace(static_cast<std::int32_t>(4 * cell + i));
        std::sort(face.begin(), face.end());
        faces.emplace_back(face, static_cast<std::int32_t>(4 * cell + i));
      }
    }
    std::sort(faces.begin(), faces.end());
    this->Neighbors.assign(4 * this->Cells.size(), None);
    for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end)
    {
      for (end = begin; end < faces.size() && std::get<0>(faces[end]) == std::get<0>(faces[begin]);)
      {
        ++end;
      }
      // What the mesh itself overlaps with is not the question.
      if (std::any_of(faces.begin() + static_cast<std::ptrdiff_t>(begin),
            faces.begin() + static_cast<std::ptrdiff_t>(end),
            [this](const auto& entry) { return !this->IsReal(std::get<1>(entry)); }))
      {
        this->MostCells = std::max<std::size_t>(this->MostCells, end - begin);
      }
      if (end - begin == 2)
      {
        this->Neighbors[std::get<1>(faces[begin])] = std::get<1>(faces[begin + 1]);
        this->Neighbors[std::get<1>(faces[begin + 1])] = std::get<1>(faces[begin]);
      }
    }
  }

  Vector GetPoint(std::int32_t id) const
  {
    const double* p = &this->Points[3 * static_cast<std::size_t>(id)];
    return { p[0], p[1], p[2] };
  }
  /// The points of face 4 * cell + i, which is opposite to point i.
  Face GetFace(std::int32_t face) const
  {
    const auto& cell = this->Cells[face / 4];
    return { cell[(face + 1) % 4], cell[(face + 2) % 4], cell[(face + 3) % 4] };
  }
  bool IsReal(std::int32_t face) const { return face / 4 < this->NumberOfReal; }
  /// A face of the mesh's boundary, seen from the mesh.
  bool IsBoundary(std::int32_t face) const
  {
    return this->IsReal(face) &&
      (this->Neighbors[face] == None || !this->IsReal(this->Neighbors[face]));
  }
  int GetSign(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const
  {
    return GetReferenceSign(&this->Points[3 * static_cast<std::size_t>(a)],
      &this->Points[3 * static_cast<std::size_t>(b)],
      &this->Points[3 * static_cast<std::size_t>(c)],
      &this->Points[3 * static_cast<std::size_t>(d)]);
  }

  static constexpr std::int32_t None = -1;

  const std::vector<double>& Points;
  std::vector<std::array<std::int32_t, 4>> Cells; ///< the mesh's, then the imaginary ones
  std::int32_t NumberOfReal = 0;
  std::vector<std::int32_t> Neighbors; ///< for each 4 * cell + face that of the other cell
  std::size_t MostCells = 0;           ///< that a face with an imaginary one has
};

/// A directed line through two points.
struct Line
{
  Vector From, To;

  /// 1 or -1 where it goes through a triangle, by the side that it comes from; 0 where it does not.
  int Cross(const Whole& whole, const Face& face) const
  {
    const auto at = [&](int i) { return &whole.Points[3 * static_cast<std::size_t>(face[i])]; };
    const int sign0 = GetReferenceSign(this->From.data(), this->To.data(), at(0), at(1));
    const int sign1 = GetReferenceSign(this->From.data(), this->To.data(), at(1), at(2));
    if (sign0 != sign1)
    {
      return 0;
    }
    const int sign2 = GetReferenceSign(this->From.data(), this->To.data(), at(2), at(0));
    return sign2 == sign0 ? sign0 : 0;
  }

  /// Where it goes through a triangle: 0 at From, 1 at To.
  double GetParameter(const Whole& whole, const Face& face) const
  {
    const Vector a = whole.GetPoint(face[0]);
    const Vector normal = tetralux::Cross(whole.GetPoint(face[1]) - a, whole.GetPoint(face[2]) - a);
    return Dot(normal, a - this->From) / Dot(normal, this->To - this->From);
  }
};

struct BoundingBall
{
  Vector Center;
  double Radius;
};

BoundingBall GetBall(const Whole& whole, const std::int32_t* ids, std::size_t count)
{
  Vector low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vector p = whole.GetPoint(ids[i]);
    for (int a = 0; a < 3; ++a)
    {
      low[a] = std::min(low[a], p[a]);
      high[a] = std::max(high[a], p[a]);
    }
  }
  BoundingBall ball;
  for (int a = 0; a < 3; ++a)
  {
    ball.Center[a] = low[a] + 0.5 * (high[a] - low[a]);
  }
  const Vector diagonal = high - low;
  ball.Radius = 0.5 * std::sqrt(Dot(diagonal, diagonal));
  return ball;
}

BoundingBall GetBall(const Whole& whole)
{
  std::vector<std::int32_t> ids;
  for (const auto& cell : whole.Cells)
  {
    ids.insert(ids.end(), cell.begin(), cell.end());
  }
  return GetBall(whole, ids.data(), ids.size());
}

} // namespace

//----------------------------------------------------------------------------
int GetReferenceSign(const double* a, const double* b, const double* c, const double* d)
{
  double p[3][3];
  double size[3];
  for (int i = 0; i < 3; ++i)
  {
    const double* from = i == 0 ? b : i == 1 ? c : d;
    size[i] = 0;
    for (int k = 0; k < 3; ++k)
    {
      p[i][k] = from[k] - a[k];
      size[i] += std::abs(p[i][k]);
    }
  }
  const double determinant = p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
    p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
    p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
  // Twenty roundings are more than any of its terms goes through.
  const double bound =
    20 * std::numeric_limits<double>::epsilon() * size[0] * size[1] * size[2] + 1e-280;
  if (std::abs(determinant) > bound)
  {
    return determinant > 0 ? 1 : -1;
  }
  // All coordinates as whole numbers of the smallest unit that any of them has.
  using Integer = boost::multiprecision::cpp_int;
  constexpr int digits = std::numeric_limits<double>::digits;
  int unit = std::numeric_limits<int>::max();
  for (const double* point : { a, b, c, d })
  {
    for (int k = 0; k < 3; ++k)
    {
      int exponent;
      if (std::frexp(point[k], &exponent) != 0)
      {
        unit = std::min(unit, exponent - digits);
      }
    }
  }
  const auto toInteger = [unit](double x)
  {
    int exponent;
    const double fraction = std::frexp(x, &exponent);
    Integer integer = static_cast<std::int64_t>(std::ldexp(fraction, digits));
    return fraction == 0 ? integer : integer << (exponent - digits - unit);
  };
  Integer q[3][3];
  for (int i = 0; i < 3; ++i)
  {
    const double* from = i == 0 ? b : i == 1 ? c : d;
    for (int k = 0; k < 3; ++k)
    {
      q[i][k] = toInteger(from[k]) - toInteger(a[k]);
    }
  }
  const Integer exact = q[0][0] * (q[1][1] * q[2][2] - q[1][2] * q[2][1]) +
    q[0][1] * (q[1][2] * q[2][0] - q[1][0] * q[2][2]) +
    q[0][2] * (q[1][0] * q[2][1] - q[1][1] * q[2][0]);
  return exact.sign();
}

//----------------------------------------------------------------------------
std::string CheckConvexity(const ConvexifiedMesh& mesh, std::int32_t minimumSteinerPoint)
{
  const Whole whole(mesh);
  const auto numberOfCells = static_cast<std::int32_t>(whole.Cells.size());
  if (whole.MostCells > 2)
  {
    return "a face has " + std::to_string(whole.MostCells) + " cells";
  }
  const BoundingBall ball = GetBall(whole);
  const double tolerance = 1e-12 *
    (ball.Radius + std::abs(ball.Center[0]) + std::abs(ball.Center[1]) + std::abs(ball.Center[2]));

  double realVolume = 0;
  double imaginaryVolume = 0;
  double hullVolume = 0;
  std::vector<Face> outerFaces;
  for (std::int32_t cell = 0; cell < numberOfCells; ++cell)
  {
    const auto& ids = whole.Cells[cell];
    const bool isReal = cell < whole.NumberOfReal;
    const int sign = whole.GetSign(ids[0], ids[1], ids[2], ids[3]);
    if (!isReal && sign <= 0)
    {
      return "imaginary cell " + std::to_string(cell - whole.NumberOfReal) + " has sign " +
        std::to_string(sign);
    }
    const Vector origin = whole.GetPoint(ids[0]);
    const Vector u = whole.GetPoint(ids[1]) - origin;
    const Vector v = whole.GetPoint(ids[2]) - origin;
    const Vector w = whole.GetPoint(ids[3]) - origin;
    (isReal ? realVolume : imaginaryVolume) += std::abs(Dot(Cross(u, v), w)) / 6;
    for (std::int32_t i = 4 * cell; i < 4 * cell + 4; ++i)
    {
      const Face face = whole.GetFace(i);
      const std::int32_t other = whole.Neighbors[i];
      if (other == Whole::None)
      {
        outerFaces.push_back(face);
        continue;
      }
      const int side = whole.GetSign(face[0], face[1], face[2], ids[i % 4]);
      const int otherSide =
        whole.GetSign(face[0], face[1], face[2], whole.Cells[other / 4][other % 4]);
      if (!(isReal && whole.IsReal(other)) && side * otherSide > 0)
      {
        return "two cells on the same side of a face";
      }
    }
  }

  std::vector<std::int32_t> outerPoints;
  for (const Face& face : outerFaces)
  {
    outerPoints.insert(outerPoints.end(), face.begin(), face.end());
  }
  std::sort(outerPoints.begin(), outerPoints.end());
  outerPoints.erase(std::unique(outerPoints.begin(), outerPoints.end()), outerPoints.end());
  // The middle of points of the hull is inside of it.
  Vector middle = { 0, 0, 0 };
  for (const std::int32_t point : outerPoints)
  {
    const Vector p = whole.GetPoint(point);
    for (int a = 0; a < 3; ++a)
    {
      middle[a] += (p[a] - ball.Center[a]) / static_cast<double>(outerPoints.size());
    }
  }
  for (int a = 0; a < 3; ++a)
  {
    middle[a] += ball.Center[a];
  }
  // All against all takes too long where there are very many.
  const std::size_t step = 1 + outerPoints.size() * outerFaces.size() / 20000000;
  for (const Face& face : outerFaces)
  {
    const Vector a = whole.GetPoint(face[0]);
    const Vector normal = Cross(whole.GetPoint(face[1]) - a, whole.GetPoint(face[2]) - a);
    hullVolume += std::abs(Dot(normal, middle - a)) / 6;
    const double length = std::sqrt(Dot(normal, normal));
    if (length <= tolerance * ball.Radius)
    {
      continue; // has no plane to speak of
    }
    double lowest = 0;
    double highest = 0;
    for (std::size_t i = 0; i < outerPoints.size(); i += step)
    {
      const double height = Dot(normal, whole.GetPoint(outerPoints[i]) - a) / length;
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
    // A small triangle far away knows its plane only so well.
    const double limit = tolerance * (1 + ball.Radius * ball.Radius / length);
    if (lowest < -limit && highest > limit)
    {
      return "a face of one cell is not on the hull: points from " + std::to_string(lowest) +
        " to " + std::to_string(highest);
    }
  }
  if (!(std::abs(realVolume + imaginaryVolume - hullVolume) <= 1e-9 * hullVolume))
  {
    return "volumes: mesh " + std::to_string(realVolume) + ", imaginary " +
      std::to_string(imaginaryVolume) + ", hull " + std::to_string(hullVolume);
  }

  const auto numberOfPoints = static_cast<std::int32_t>(mesh.Points.size() / 3);
  for (std::int32_t point = minimumSteinerPoint; point < numberOfPoints; ++point)
  {
    for (std::int32_t cell = 0; cell < whole.NumberOfReal; ++cell)
    {
      const auto& ids = whole.Cells[cell];
      const int sign = whole.GetSign(ids[0], ids[1], ids[2], ids[3]);
      if (sign != 0 && sign * whole.GetSign(point, ids[1], ids[2], ids[3]) >= 0 &&
        sign * whole.GetSign(ids[0], point, ids[2], ids[3]) >= 0 &&
        sign * whole.GetSign(ids[0], ids[1], point, ids[3]) >= 0 &&
        sign * whole.GetSign(ids[0], ids[1], ids[2], point) >= 0)
      {
        return "a Steiner point is in cell " + std::to_string(cell) + " of the mesh";
      }
    }
  }
  return {};
}

//----------------------------------------------------------------------------
RayAgreement CompareRays(const ConvexifiedMesh& mesh, std::int64_t numberOfRays, std::uint64_t seed)
{
  const Whole whole(mesh);
  const BoundingBall ball = GetBall(whole);
  const auto numberOfFaces = static_cast<std::int32_t>(4 * whole.Cells.size());
  struct Target
  {
    std::int32_t Face;
    BoundingBall Ball;
  };
  std::vector<Target>
    targets; // what brute force tries: the boundary, and where the whole is entered
  for (std::int32_t face = 0; face < numberOfFaces; ++face)
  {
    if (whole.IsBoundary(face) || whole.Neighbors[face] == Whole::None)
    {
      const Face ids = whole.GetFace(face);
      targets.push_back({ face, GetBall(whole, ids.data(), 3) });
    }
  }

  std::int64_t agreeing = 0;
  std::int64_t crossings = 0;
#pragma omp parallel for schedule(dynamic, 64) reduction(+ : agreeing, crossings)
  for (std::int64_t ray = 0; ray < numberOfRays; ++ray)
  {
    std::mt19937_64 random(seed + static_cast<std::uint64_t>(ray));
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(-1, 1);
    Line line;
    double length = 0;
    Vector direction;
    for (double& d : direction)
    {
      d = normal(random);
      length = std::hypot(length, d);
    }
    for (int a = 0; a < 3; ++a)
    {
      // Through the inner part of the ball, where there is something to meet.
      const double middle = ball.Center[a] + 0.6 * ball.Radius * uniform(random);
      line.From[a] = middle - 3 * ball.Radius * direction[a] / length;
      line.To[a] = middle + 3 * ball.Radius * direction[a] / length;
    }

    std::vector<std::pair<double, std::int32_t>> expected;
    std::vector<std::pair<double, std::int32_t>> entries;
    const Vector along = line.To - line.From;
    for (const Target& target : targets)
    {
      const Vector offset = Cross(target.Ball.Center - line.From, along);
      // A margin for rounding; what is wrongly tried costs time only.
      const double reach = 1.001 * target.Ball.Radius + 1e-9 * ball.Radius;
      if (Dot(offset, offset) > reach * reach * Dot(along, along))
      {
        continue;
      }
      const Face ids = whole.GetFace(target.Face);
      if (line.Cross(whole, ids) != 0)
      {
        const double parameter = line.GetParameter(whole, ids);
        if (whole.IsBoundary(target.Face))
        {
          expected.emplace_back(parameter, target.Face);
        }
        if (whole.Neighbors[target.Face] == Whole::None)
        {
          entries.emplace_back(parameter, target.Face);
        }
      }
    }
    std::sort(expected.begin(), expected.end());
    std::sort(entries.begin(), entries.end());

    std::vector<std::pair<double, std::int32_t>> walked;
    const auto pass = [&](std::int32_t face)
    {
      if (whole.IsBoundary(face))
      {
        walked.emplace_back(line.GetParameter(whole, whole.GetFace(face)), face);
      }
    };
    bool isComplete = entries.size() <= 2;
    if (!entries.empty())
    {
      std::int32_t face = entries[0].second;
      pass(face);
      for (std::size_t steps = 0; face != Whole::None; ++steps)
      {
        std::int32_t exit = Whole::None;
        for (std::int32_t i = face / 4 * 4; i < face / 4 * 4 + 4; ++i)
        {
          if (i != face && line.Cross(whole, whole.GetFace(i)) != 0)
          {
            exit = i;
          }
        }
        if (exit == Whole::None || steps > whole.Cells.size())
        {
          isComplete = false;
          break;
        }
        pass(exit);
        face = whole.Neighbors[exit];
        if (face != Whole::None && !whole.IsBoundary(exit))
        {
          pass(face);
        }
      }
    }

    // In the same order, but for faces at the same place to rounding.
    bool isSame = isComplete && walked.size() == expected.size();
    for (std::size_t i = 0; i + 1 < walked.size(); ++i)
    {
      isSame = isSame && walked[i].first <= walked[i + 1].first + 1e-12;
    }
    const auto byFace = [](const auto& pair0, const auto& pair1)
    { return pair0.second < pair1.second; };
    std::sort(walked.begin(), walked.end(), byFace);
    std::sort(expected.begin(), expected.end(), byFace);
    isSame = isSame &&
      std::equal(walked.begin(), walked.end(), expected.begin(), expected.end(),
        [](const auto& pair0, const auto& pair1) { return pair0.second == pair1.second; });
    agreeing += isSame;
    crossings += static_cast<std::int64_t>(expected.size());
  }
  return { numberOfRays, agreeing, crossings };
}

} // namespace tetralux
