// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FacetedCells_h
#define tetralux_FacetedCells_h

#include <array>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// Cells that are given by their faces: prisms, quadratic cells, polyhedra,
/// convex point sets. They are cut by cutting
/// the faces into triangles, by a rule that both sides of a face follow, and joining the triangles
/// with one apex.

/// The faces of a cell type with a fixed number of points, in the numbering of the cell's points.
struct FacetedCellType
{
  int NumberOfPoints = 0;

  /// Planar polygons whose union is the cell's surface, seen counter-clockwise from outside. A
  /// curved face is several polygons: a quadratic triangle four triangles; a quadratic
  /// quadrilateral its four corners and what is left of it; a biquadratic face a fan about its
  /// centre; a quadratic-linear quadrilateral its two halves.
  std::vector<std::vector<int>> Polygons;

  /// The point that lies on no face, or -1.
  int MiddlePoint = -1;

  /// Interpolation weights of the points at the cell's parametric centre.
  std::vector<double> MiddleWeights;

  /// Whether one of the corners may be the apex: not in a quadratic cell, where polygons that a
  /// corner is not part of lie in one plane with it.
  bool ApexAtCorner = false;
};

/// The faces of a cell type as VTK's own cell class gives them; nullptr for a type that is not
/// among the prisms and quadratic cells. Safe to call from any thread.
const FacetedCellType* GetFacetedCellType(int cellType);

/// The volume of a tetrahedron, positive in VTK's order of its points.
double GetSignedVolume(const double* a, const double* b, const double* c, const double* d);

/// Cuts cells given by their faces. Holds scratch memory: one for each thread.
class FacetedCellSplitter
{
public:
  /// Starts a cell.
  void Clear();

  /// Adds a face: point ids, seen counter-clockwise from outside (see OrientOutward). points:
  /// coordinates by point id.
  void AddPolygon(const std::int64_t* ids, std::size_t size, const double* points);

  /// Turns all faces around if they enclose a negative volume. points: coordinates by point id.
  void OrientOutward(const double* points);

  /// Cones from the smallest point id if that gives only positive tetrahedra.
  /// tets receives four ids for each tetrahedron; returns whether it did.
  bool ConeFromSmallestId(const double* points, std::vector<std::int64_t>& tets) const;

  /// Cones from any apex id that is on no face.
  void ConeFrom(std::int64_t apex, std::vector<std::int64_t>& tets) const;

  /// The ids of all faces, ascending, each once.
  const std::vector<std::int64_t>& GetPoints();

  /// Finds a point that sees all faces from inside: the mean of the corners, if that does. weights:
  /// of GetPoints, whose mean it is; not negative where it sees all faces. Returns whether one was
  /// found; else it is the mean of the corners.
  bool FindMiddle(const double* points, std::vector<double>& weights);

  /// Cuts tetrahedra off the cell until a point sees all faces of the rest, or until nothing is
  /// left: GetPoints, weights and ConeFrom are of the rest then. Returns whether it did; else the
  /// cell stays. points, weights: as for FindMiddle.
  bool CutToStar(
    const double* points, std::vector<std::int64_t>& tets, std::vector<double>& weights);

private:
  /// A plane of a face with the cell below it: Normal . x <= Height, of length 1.
  struct Plane
  {
    std::array<double, 3> Normal;
    double Height;
  };

  double SignedVolume(const double* points) const;
  void AddTriangle(std::int64_t a, std::int64_t b, std::int64_t c);
  std::vector<Plane> FindPlanes(const double* points) const;
  /// Cuts a polygon that is bent inwards, from its smallest id on.
  void ClipEars(std::vector<std::int64_t> polygon, const double* points);
  void AddWeights(const double* points, const std::array<double, 3>& x, std::size_t corner,
    double share, std::vector<double>& weights) const;

  std::vector<std::int64_t> Triangles; // three ids each
  std::vector<std::int64_t> Points;
};

} // namespace tetralux

#endif
