// SPDX-License-Identifier: BSD-3-Clause

// Cell-to-cell ray casting of packets of rays (Garrity 1990; Weiler et al. 2003, section 3),
// by two-dimensional edge tests that carry the entry face along.
//
// Each ray sees the mesh in a frame of its own: x and y across the ray, z along it, the ray at
// x = y = 0. A cell is entered through the triangle a b c, whose projections surround the origin.
// The cell's fourth point p replaces one of them: the ray leaves through the one triangle of p and
// two of a, b, c that surrounds the origin, and the signs of the three determinants det(p, a),
// det(p, b), det(p, c) tell which. The next cell is then known together with its fourth point
// (WalkFace), so that a step reads 8 bytes of topology and one point.
//
// Why no ray is lost or counted twice, in single precision too:
// * A projection is rounded, but it is the same whichever cell asks: it moves points of the mesh by
//   an ulp, the same way for all cells around them.
// * The determinants of the rounded projections have exact signs (DifferenceOfProducts). A
//   determinant of exactly zero, a ray through an edge or a vertex, is decided as if the ray were
//   displaced by e (1, -ShiftSlope) + e^2 (0, 1), e infinitely small (simulation of simplicity,
//   Edelsbrunner and Muecke 1990); RayAcross.h says where that is in the picture. So each edge
//   passes each ray on one side, for every cell that has the edge.
// * Whatever a tetrahedron became in the projection - flat, inverted - the origin is inside none or
//   two of its four triangles. Steps are thus a pairing of faces: a walk that starts at a boundary
//   face visits no cell twice and ends at another boundary face.
//
// What does not share points is not projected alike: where faces touch that are not the same, rays
// that pass edges of the boundary within rounding are displaced, see RayDisplacements.h.
//
// Boundary crossings are found by the same determinants, so they come in pairs, too: walking from
// the nearest one strikes off the one where the walk ends, and the next one left is a re-entry.

#include "RayCast/RayCastComponents.h"
#include "RayCast/RayCastCrossings.h"
#include "RayCast/RayCastIsosurfaces.h"
#include "RayCast/RayCastLimits.h"
#include "RayCast/RayCastMaximum.h"
#include "RayCast/RayCastModels.h"
#include "RayCast/RayCastTable.h"
#include "RayCast/RayCastVaryingLight.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <type_traits>

namespace tetralux
{
namespace TETRALUX_ISA
{
namespace
{
/// Bits of the blocks of a tile.
constexpr std::uint32_t AllBlocks = ~0u;

/// The depth of a pixel whose ray meets nothing.
constexpr float NoDepth = -1;

/// Whether packets are cast two by two: where the processor has registers for it.
template <class Real>
constexpr bool InPairs = sizeof(Real) == sizeof(float) && LaneCount == MostLanes;

/// In place of what a model does not need.
struct Nothing
{
};

/// What rays have of the cells of one step.
template <class Real, class Model>
struct PartsOfCells
{
  using V = typename LanesOf<Real>::Type;
  Mask8 Valid; ///< rays that have a part of their cell
  Int8 Cell;
  V Z0, S0; ///< distance and scalar where that begins
  V Z1, S1; ///< and where it ends

  // On the cell's faces, nearer first, for models that need it.
  struct Faces
  {
    V Z0, Z1;
  };
  struct Gradients
  {
    LaneVector G0, G1;
  };
  struct Components
  {
    ComponentLanes C0, C1;
  };
  std::conditional_t<Model::NeedsGradients || Model::NeedsComponents, Faces, Nothing> OfFaces;
  std::conditional_t<Model::NeedsGradients, Gradients, Nothing> OfGradients;
  std::conditional_t<Model::NeedsComponents, Components, Nothing> OfComponents;
};

/// Rays of neighbouring pixels on their way through the mesh.
///
/// The rays that are in the mesh take one cell each in every step.
template <class Real, class Model, bool CellData>
class Packet
{
public:
  using V = typename LanesOf<Real>::Type;

  /// The rays of the pixels from (x, y), those of them below (x1, y1).
  Packet(const KernelInput& in, const PacketFaces& faces, int x, int y, int x1, int y1,
    CrossingBuffer& buffer, KernelCounts& counts)
    : In(in)
    , Faces(faces)
    , Buffer(buffer)
    , Counts(counts)
    , PixelX(x)
    , PixelY(y)
    , World(MakeWorldRays(*in.Grid, x, y))
    , Ray(MakeRays<Real>(in, World))
    , Limits(LimitRays(in, x, y, World, Ray.Start))
    , Gathered(World, Ray.Start)
  {
    for (int i = 0; i < LaneCount; ++i)
    {
      this->Inside |= static_cast<unsigned>(x + GetLaneColumn(i) < x1 && y + GetLaneRow(i) < y1)
        << i;
    }
  }

  void Cast()
  {
    this->BeginPart();
    this->Finish();
  }

  /// Casts the rays of two packets, a step of each by turns: while one waits for what it loads and
  /// for what follows from that, the processor goes on with the other.
  static void CastBoth(Packet& a, Packet& b)
  {
    a.BeginPart();
    b.BeginPart();
    while (a.Running != 0 && b.Running != 0)
    {
      CellParts partsOfA{}, partsOfB{};
      const Exit exitOfA = a.FindExit();
      const Exit exitOfB = b.FindExit();
      a.Leave(exitOfA);
      a.Step(partsOfA);
      b.Leave(exitOfB);
      b.Step(partsOfB);
      a.Integrate(partsOfA);
      b.Integrate(partsOfB);
    }
    a.Finish();
    b.Finish();
  }

private:
  using CellParts = PartsOfCells<Real, Model>;

  /// Casts the rays until they all end.
  TETRALUX_NOINLINE void Finish()
  {
    do
    {
      while (this->Running != 0)
      {
        CellParts parts{};
        this->Leave(this->FindExit());
        this->Step(parts);
        this->Integrate(parts);
      }
      ++this->Part;
      this->BeginPart();
    } while (this->Running != 0);
    this->Counts.Lanes += static_cast<std::int64_t>(LaneCount) * this->Steps;
    this->Counts.Segments += this->Segments;
    this->WritePixels();
  }

  /// The fourth point of the cell of each ray, and on which sides of its edges to the corners of
  /// the face of entry the ray passes.
  struct Exit
  {
    Corner<Real> P;
    V PA, PB, PC;              ///< det(p, a), det(p, b), det(p, c), without their signs
    Mask8 ASide, BSide, CSide; ///< where those count as positive
  };

  TETRALUX_INLINE Exit FindExit() const
  {
    const Corner<Real> p = LoadCorner<Real>(this->Ray, this->In.Points, this->Point);
    const V pa = Det(p, this->A);
    const V pb = Det(p, this->B);
    const V pc = Det(p, this->C);
    const V zero = Real(0);
    Mask8 aSide = zero < pa;
    Mask8 bSide = zero < pb;
    Mask8 cSide = zero < pc;
    const V sizeA = Abs(pa);
    const V sizeB = Abs(pb);
    const V sizeC = Abs(pc);
    if (Any(Min(Min(sizeA, sizeB), sizeC) <= zero))
    {
      aSide = IsPositive(pa, p, this->A);
      bSide = IsPositive(pb, p, this->B);
      cSide = IsPositive(pc, p, this->C);
    }
    return { p, sizeA, sizeB, sizeC, aSide, bSide, cSide };
  }

  /// Moves each ray from the face a b c of its cell to the face through which it leaves the cell.
  TETRALUX_INLINE void Leave(const Exit& exit)
  {
    const Corner<Real>& p = exit.P;
    const V pa = exit.PA;
    const V pb = exit.PB;
    const V pc = exit.PC;
    const Mask8 aSide = exit.ASide;
    const Mask8 bSide = exit.BSide;
    const Mask8 cSide = exit.CSide;
    const Mask8 dropA = AndNot(bSide, cSide);
    const Mask8 dropB = AndNot(cSide, aSide);
    const Mask8 keepC = dropA | dropB;

    // The exit face is opposite to the dropped point, whose place among the cell's ascending ids
    // is the number of smaller ones.
    const Int8 dropped = Select(dropA, this->A.Id, Select(dropB, this->B.Id, this->C.Id));
    this->A.Id = Select(dropA, p.Id, this->A.Id);
    this->B.Id = Select(dropB, p.Id, this->B.Id);
    this->C.Id = Select(keepC, this->C.Id, p.Id);
    const Int8 face = (ShiftLeft(this->Cell, 2) + IsSmaller(this->A.Id, dropped)) +
      (IsSmaller(this->B.Id, dropped) + IsSmaller(this->C.Id, dropped));
    this->CellBefore = this->Cell;
    GatherPairs(
      reinterpret_cast<const std::int32_t*>(this->In.Faces), face, this->Cell, this->Point);
    TETRALUX_CHECK(this->IsOnItsWay());

    // det(p, x) is the weight of the corner across; the replaced corner keeps its weight for p.
    this->WA = Select(dropA, this->WA, Select(dropB, pc, pb));
    this->WB = Select(dropB, this->WB, Select(dropA, pc, pa));
    this->WC = Select(keepC, Select(dropA, pb, pa), this->WC);
    Replace(this->A, dropA, p);
    Replace(this->B, dropB, p);
    Replace(this->C, AndNot(MaskFromBits(AllLanes), keepC), p);
  }

  /// Tells what rays have of the cells of the last Leave. Ends rays that are past their end or left
  /// the mesh, or lets them enter it again.
  TETRALUX_INLINE void Step(CellParts& parts)
  {
    const V z0 = this->Z;
    const V s0 = this->S;
    this->Interpolate();
    TETRALUX_CHECK(this->HasWeights());
    const V z1 = this->Z;
    const V s1 = this->S;
    const Mask8 running = MaskFromBits(this->Running);
    Mask8 valid = running;
    if (this->In.NumberOfWalkCells != this->In.NumberOfCells)
    {
      valid = valid & this->IsReal();
    }
    V zFrom = z0;
    V zTo = z1;
    V sFrom = s0;
    V sTo = s1;
    const Mask8 forward = Model::NeedsLength ? z0 < z1 : z0 <= z1;
    Mask8 whole = forward;
    if (this->Limited)
    {
      whole = whole & (this->Near <= z0) & (z1 <= this->Far);
    }
    if (Any(AndNot(running, whole)))
    {
      const Mask8 backward = z1 < z0;
      // A ray passes an inverted cell from its far side to its near side. It is drawn as any other.
      const V zNear = Min(z0, z1);
      const V zFar = Max(z0, z1);
      zFrom = Max(zNear, this->Near);
      zTo = Min(zFar, this->Far);
      // Distances that are not numbers contribute nothing.
      valid = valid & (zNear <= zFar) & (Model::NeedsLength ? zFrom < zTo : zFrom <= zTo);
      if constexpr (!CellData)
      {
        const V sNear = Select(backward, s1, s0);
        const V sFar = Select(backward, s0, s1);
        // By shares of the cell: a slope may overflow.
        const V ds = sFar - sNear;
        const V dz = zFar - zNear;
        sFrom = Select(zNear < this->Near, Fma((zFrom - zNear) / dz, ds, sNear), sNear);
        sTo = Select(this->Far < zFar, Fma((zTo - zNear) / dz, ds, sNear), sFar);
      }
    }
    parts.Valid = valid;
    parts.Cell = this->CellBefore;
    parts.Z0 = zFrom;
    parts.S0 = sFrom;
    parts.Z1 = zTo;
    parts.S1 = sTo;
    if constexpr (Model::NeedsGradients)
    {
      if (this->In.Lighting)
      {
        this->TellGradients(z0, z1, z1 < z0, parts);
      }
    }
    if constexpr (Model::NeedsComponents)
    {
      parts.OfFaces = { z0, z1 };
      parts.OfComponents.C0 = this->Scalars;
      this->InterpolateComponents();
      parts.OfComponents.C1 = this->Scalars;
    }
    ++this->Steps;
    this->Segments += __builtin_popcount(this->Running);

    const Mask8 outside = Int8(0) > this->Cell;
    const unsigned pastBits = this->Limited ? Bits(this->Far <= z1) & this->Running : 0;
    const unsigned outsideBits = Bits(outside) & this->Running;
    const Int8 exits = this->Cell;
    // Lanes at rest go on from cell to cell without effect. What they load must exist.
    this->Cell = Select(outside, Int8(0), this->Cell);
    if ((pastBits | outsideBits) != 0)
    {
      this->LeaveMesh(exits, outsideBits, this->KeepDone(pastBits));
    }
  }

  /// Integrates over what Step told. Ends rays that are opaque.
  TETRALUX_INLINE void Integrate(const CellParts& parts)
  {
    if constexpr (Model::NeedsGradients)
    {
      if (this->In.Lighting)
      {
        this->Gathered.EnterCell(
          parts.OfFaces.Z0, parts.OfFaces.Z1, parts.OfGradients.G0, parts.OfGradients.G1);
      }
    }
    if constexpr (Model::NeedsComponents)
    {
      this->Gathered.EnterComponents(
        parts.OfFaces.Z0, parts.OfFaces.Z1, parts.OfComponents.C0, parts.OfComponents.C1);
    }
    if constexpr (CellData)
    {
      // Imaginary cells have no values. Every lane loads some.
      const Int8 cell = Select(parts.Valid, parts.Cell, Int8(0));
      this->Gathered.AddCell(this->In, parts.Valid, cell, parts.Z0, parts.Z1);
    }
    else
    {
      this->Gathered.AddPoints(
        this->In, parts.Valid, parts.Cell, parts.Z0, parts.S0, parts.Z1, parts.S1);
    }
    this->Running &= ~Bits(this->Gathered.IsDone(this->In));
  }

  /// Tells the gradients on the faces of the cells of the last Leave.
  TETRALUX_INLINE void TellGradients(V z0, V z1, Mask8 backward, CellParts& parts)
  {
    parts.OfFaces = { Min(z0, z1), Max(z0, z1) };
    const KernelLighting& lighting = *this->In.Lighting;
    if (!lighting.OfPoints)
    {
      parts.OfGradients.G0 = LoadGradient(lighting, this->CellBefore);
      parts.OfGradients.G1 = parts.OfGradients.G0;
      return;
    }
    const LaneVector gradient0 = this->Gradient;
    this->InterpolateGradient();
    parts.OfGradients.G0 = Select(backward, this->Gradient, gradient0);
    parts.OfGradients.G1 = Select(backward, gradient0, this->Gradient);
  }

  /// The gradient where each ray goes through its triangle.
  TETRALUX_INLINE void InterpolateGradient()
  {
    const KernelLighting& lighting = *this->In.Lighting;
    const V scale = V(Real(1)) / (this->WA + this->WB + this->WC);
    const Float8 b = ToFloat(this->WB * scale);
    const Float8 c = ToFloat(this->WC * scale);
    const LaneVector a = LoadGradient(lighting, this->A.Id);
    this->Gradient = Fma(
      LoadGradient(lighting, this->B.Id) - a, b, Fma(LoadGradient(lighting, this->C.Id) - a, c, a));
  }

  /// The scalars where each ray goes through its triangle.
  TETRALUX_INLINE void InterpolateComponents()
  {
    const V scale = V(Real(1)) / (this->WA + this->WB + this->WC);
    const V wb = this->WB * scale;
    const V wc = this->WC * scale;
    const double* rows = this->In.Components->Rows;
    ComponentLanes a, b, c;
    GatherRows(rows, this->A.Id, a.S[0], a.S[1], a.S[2], a.S[3]);
    GatherRows(rows, this->B.Id, b.S[0], b.S[1], b.S[2], b.S[3]);
    GatherRows(rows, this->C.Id, c.S[0], c.S[1], c.S[2], c.S[3]);
    for (int k = 0; k < MostComponents; ++k)
    {
      this->Scalars.S[k] = Blend(wb, wc, a.S[k], b.S[k], c.S[k]);
    }
  }

  /// Of rays past their end those that meet no cells before it that they have still to enter: cells
  /// that overlap with the ones they are in. The others go on without effect until they leave.
  unsigned KeepDone(unsigned pastBits) const
  {
    for (int place = 0; place < this->Crossings.Count && pastBits != 0; ++place)
    {
      FaceCrossing& crossing = this->Buffer.Crossings[place];
      const Mask8 before = LoadLanes(GetDistances<Real>(crossing)) <= this->Far;
      pastBits &= ~(crossing.Lanes & Bits(before));
    }
    return pastBits;
  }

  /// Imaginary cells come after those of the mesh, and contribute nothing.
  TETRALUX_INLINE Mask8 IsReal() const { return Int8(this->In.NumberOfCells) > this->CellBefore; }

  // For checks.

  /// All lanes, those at rest too, are in cells of the mesh and before points of it, or at its end.
  /// Where a ray leaves the mesh, a negative cell tells the entry.
  bool IsOnItsWay() const
  {
    const Mask8 ended = Int8(0) > this->Cell;
    const Mask8 inside = AndNot(MaskFromBits(AllLanes), ended);
    return AreBelow(inside, this->Cell, this->In.NumberOfWalkCells) &&
      AreBelow(inside, this->Point, this->In.NumberOfPoints) &&
      AreBelow(
        ended & MaskFromBits(this->Running), Int8(-1) - this->Cell, this->In.NumberOfEntries);
  }

  /// No ray is in a triangle without area: points that coincide in the projection have signs with
  /// which no ray passes their triangle (TieIsPositive). The weights are not numbers if the frame
  /// of the ray is beyond the range of Real.
  bool HasWeights() const
  {
    const V sum = this->WA + this->WB + this->WC;
    return !Any(MaskFromBits(this->Running) & (sum <= V(Real(0))));
  }

  static TETRALUX_INLINE void Replace(Corner<Real>& corner, Mask8 m, const Corner<Real>& p)
  {
    corner.X = Select(m, p.X, corner.X);
    corner.Y = Select(m, p.Y, corner.Y);
    corner.Z = Select(m, p.Z, corner.Z);
    corner.S = Select(m, p.S, corner.S);
  }

  /// Distance and scalar where each ray goes through its triangle.
  TETRALUX_INLINE void Interpolate()
  {
    // Weights are areas as large as 2^84: made shares first, so that no product overflows.
    const V scale = V(Real(1)) / (this->WA + this->WB + this->WC);
    const V b = this->WB * scale;
    const V c = this->WC * scale;
    this->Z = Blend(b, c, this->A.Z, this->B.Z, this->C.Z);
    if constexpr (!CellData)
    {
      this->S = Blend(b, c, this->A.S, this->B.S, this->C.S);
    }
  }

  /// Starts the next part of the rays in which any ray meets the mesh, if there is one.
  void BeginPart()
  {
    for (; this->Part < this->Limits.Count; ++this->Part)
    {
      const Double8 begin = this->Limits.Begin[this->Part];
      const Double8 end = this->Limits.End[this->Part];
      unsigned active = this->Inside & Bits(begin < end) & ~Bits(this->Gathered.IsDone(this->In));
      // Walking strikes crossings off, so each part of the rays finds them anew.
      FindClearCrossings(
        this->In, this->Faces, this->Ray, MaskFromBits(active), this->Buffer, this->Crossings);
      this->Running = 0;
      active &= ~this->LeaveOutInexact(active);
      const unsigned hit = Bits(this->Crossings.Left > Int8(0));
      if constexpr (sizeof(Real) == sizeof(float))
      {
        this->Near = ToFloat(begin);
        this->Far = ToFloat(end);
      }
      else
      {
        this->Near = begin;
        this->Far = end;
      }
      constexpr double Infinity = std::numeric_limits<double>::infinity();
      this->Limited =
        Any(MaskFromBits(active) & ((Double8(-Infinity) < begin) | (end < Double8(Infinity))));
      // Lanes without a ray rest in any cell; lanes with one are put where they start.
      this->Cell = 0;
      this->Point = 0;
      if (active & hit)
      {
        this->A = this->B = this->C = LoadCorner<Real>(this->Ray, this->In.Points, Int8(0));
        this->WA = this->WB = this->WC = Real(1);
        this->Z = this->S = Real(0);
        this->Enter(active & hit);
      }
      if (this->Running)
      {
        return;
      }
    }
  }

  /// Marks the blocks in which rounding may change rays by more than is allowed, and returns their
  /// lanes: they are not cast here.
  unsigned LeaveOutInexact(unsigned rays)
  {
    const Float8 errors = this->Crossings.ShiftError;
    const Float8 noted = static_cast<float>(this->Counts.ShiftError);
    if (!Any(MaskFromBits(rays) & (noted < errors)))
    {
      return 0;
    }
    float errorOf[LaneCount];
    Store(errorOf, errors);
    unsigned left = 0;
    for (int block = 0; block < BlocksOfPacket; ++block)
    {
      const unsigned lanes = GetLanesOfBlock(block) & rays;
      float largest = 0;
      for (unsigned bits = lanes; bits != 0; bits &= bits - 1)
      {
        largest = std::max(largest, errorOf[FindFirstLane(bits)]);
      }
      if (this->In.InexactBlocks && largest > this->In.LargestShiftError)
      {
        const int y = this->PixelY + block * BlockHeight;
        this->In.InexactBlocks[GetBlockPlace(this->In.Grid->Width, this->PixelX, y)] = 1;
        left |= GetLanesOfBlock(block);
      }
      else if (largest > this->Counts.ShiftError)
      {
        this->Counts.ShiftError = largest;
      }
    }
    this->Inside &= ~left;
    return left;
  }

  /// Puts the rays of some lanes at their next entry into the mesh, if they have one: the nearest
  /// crossing that no walk began or ended at.
  void Enter(unsigned lanes)
  {
    const NearestCrossings<Real> nearest = FindNearest<Real>(this->Buffer, this->Crossings, lanes);
    const V infinity = std::numeric_limits<Real>::infinity();
    lanes &= Bits((nearest.Distance <= this->Far) & (nearest.Distance < infinity));
    if (lanes == 0)
    {
      return;
    }
    std::int32_t places[LaneCount];
    std::int32_t cells[LaneCount] = {}, opposites[LaneCount] = {}, corners[3][LaneCount] = {};
    Store(places, nearest.Place);
    for (unsigned left = lanes; left != 0; left &= left - 1)
    {
      const int lane = FindFirstLane(left);
      FaceCrossing& crossing = this->Buffer.Crossings[places[lane]];
      TETRALUX_CHECK(crossing.Entry < this->In.NumberOfEntries);
      const WalkEntry& entry = this->In.Entries[crossing.Entry];
      for (int k = 0; k < 3; ++k)
      {
        corners[k][lane] = entry.Points[k];
      }
      cells[lane] = entry.Cell;
      opposites[lane] = entry.Opposite;
      crossing.Lanes &= ~(1u << lane);
      ++this->Counts.Paths;
    }
    const Mask8 start = MaskFromBits(lanes);
    this->Crossings.Left = this->Crossings.Left - Ones(start);
    const Corner<Real> p = LoadCorner<Real>(this->Ray, this->In.Points, LoadInt8(corners[0]));
    const Corner<Real> q = LoadCorner<Real>(this->Ray, this->In.Points, LoadInt8(corners[1]));
    const Corner<Real> r = LoadCorner<Real>(this->Ray, this->In.Points, LoadInt8(corners[2]));
    const TriangleHit<Real> t = TestTriangle(p, q, r);
    // Counter-clockwise from here on: a step replaces one corner and keeps the others' places.
    this->A = Select(start, p, this->A);
    this->B = Select(start, Select(t.Clockwise, r, q), this->B);
    this->C = Select(start, Select(t.Clockwise, q, r), this->C);
    this->WA = Select(start, Abs(t.BC), this->WA);
    this->WB = Select(start, Abs(Select(t.Clockwise, t.AB, t.CA)), this->WB);
    this->WC = Select(start, Abs(Select(t.Clockwise, t.CA, t.AB)), this->WC);
    this->Cell = Select(start, LoadInt8(cells), this->Cell);
    this->Point = Select(start, LoadInt8(opposites), this->Point);
    this->Interpolate();
    if constexpr (Model::NeedsGradients)
    {
      if (this->In.Lighting && this->In.Lighting->OfPoints)
      {
        this->InterpolateGradient();
      }
    }
    if constexpr (Model::NeedsComponents)
    {
      this->InterpolateComponents();
    }
    this->Running |= lanes;
  }

  /// Ends or re-enters the rays that left the mesh, ends those that are done.
  void LeaveMesh(Int8 exits, unsigned outsideBits, unsigned doneBits)
  {
    this->Running &= ~(doneBits | outsideBits);
    const Mask8 leaving = MaskFromBits(outsideBits & ~doneBits);
    this->Crossings.Left = this->Crossings.Left - Ones(leaving);
    const unsigned others = Bits(leaving & (this->Crossings.Left > Int8(0)));
    if (others != 0)
    {
      // A boundary face b is told as ~b.
      StrikeExits(this->Buffer, this->Crossings, others, Int8(-1) - exits);
      this->Enter(others);
    }
  }

  void WritePixels()
  {
    ColorsOfLanes colors;
    Real first[LaneCount];
    double start[LaneCount];
    this->Gathered.GetColors(this->In, colors);
    Store(first, this->Gathered.First.Distance);
    Store(start, this->Ray.Start);
    for (int i = 0; i < LaneCount; ++i)
    {
      if (!((this->Inside >> i) & 1u))
      {
        continue;
      }
      const std::int64_t pixel =
        static_cast<std::int64_t>(this->PixelY + GetLaneRow(i)) * this->In.Grid->Width +
        this->PixelX + GetLaneColumn(i);
      float* color = this->In.Colors + 4 * pixel;
      for (int c = 0; c < 4; ++c)
      {
        color[c] = colors[c][i];
      }
      const bool contributed = first[i] < std::numeric_limits<Real>::infinity();
      this->In.Depths[pixel] =
        contributed ? static_cast<float>(start[i] + static_cast<double>(first[i])) : NoDepth;
    }
  }

  const KernelInput& In;
  PacketFaces Faces;
  CrossingBuffer& Buffer;
  KernelCounts& Counts;

  // The rays and what is left to do for them.
  int PixelX, PixelY;
  unsigned Inside = 0;       ///< lanes with a pixel that is not left to double precision
  unsigned Running = 0;      ///< lanes whose ray is in the mesh
  int Steps = 0;             ///< taken by the packet; 32 bits, so that both counts stay scalar
  std::int64_t Segments = 0; ///< cells walked through, over all rays
  WorldRays World;
  Rays<Real> Ray;
  Intervals Limits;
  int Part = 0; ///< of the limits
  PacketCrossings Crossings;

  // Where the rays are: in a cell, on the triangle A B C through which they entered it.
  V Near, Far;  ///< ends of the part
  bool Limited; ///< whether any ray's part has an end
  Corner<Real> A, B, C;
  V WA, WB, WC; ///< weights of the corners at the ray, twice the areas across; not normalised
  V Z, S;       ///< distance and scalar there
  LaneVector Gradient;    ///< there, in coordinates of the mesh, where the model needs it
  ComponentLanes Scalars; ///< there, where the model needs them
  Int8 Cell, CellBefore;
  Int8 Point; ///< the cell's fourth point

  Model Gathered;
};

/// Writes what a packet without a crossing has: pixels from (x, y), those of them below (x1, y1).
inline void ClearPixels(const KernelInput& in, int x, int y, int x1, int y1)
{
  for (int row = y; row < y + PacketHeight && row < y1; ++row)
  {
    for (int column = x; column < x + PacketWidth && column < x1; ++column)
    {
      const std::int64_t pixel = static_cast<std::int64_t>(row) * in.Grid->Width + column;
      for (int c = 0; c < 4; ++c)
      {
        in.Colors[4 * pixel + c] = 0;
      }
      in.Depths[pixel] = NoDepth;
    }
  }
}

/// Bits of the blocks of a packet in its tile.
constexpr std::uint32_t FindBlocks(int x, int y)
{
  const int first = y % RayTileSize / BlockHeight * BlocksAcrossTile + x % RayTileSize / BlockWidth;
  std::uint32_t blocks = 0;
  for (int block = 0; block < BlocksOfPacket; ++block)
  {
    blocks |= 1u << (first + block * BlocksAcrossTile);
  }
  return blocks;
}

template <class Real, class Model, bool CellData>
void CastRays(const KernelInput& in, int x0, int y0, int x1, int y1, const CrossingBuffers& buffers,
  KernelCounts& counts)
{
  using PacketOfRays = Packet<Real, Model, CellData>;
  std::optional<PacketOfRays> first;
  PacketFaces faces{};
  std::uint32_t met = AllBlocks;
  if (in.TileFaces)
  {
    const int tile = y0 / RayTileSize * in.TileColumns + x0 / RayTileSize;
    faces.Begin = in.TileFaces + in.TileBegins[tile];
    faces.End = in.TileFaces + in.TileBegins[tile + 1];
    met = 0;
    for (const TileFace* face = faces.Begin; face != faces.End; ++face)
    {
      met |= face->Blocks;
    }
  }
  for (int y = y0; y < y1; y += PacketHeight)
  {
    for (int x = x0; x < x1; x += PacketWidth)
    {
      faces.Blocks = FindBlocks(x, y);
      if ((met & faces.Blocks) == 0)
      {
        ClearPixels(in, x, y, x1, y1);
        continue;
      }
      if constexpr (!InPairs<Real>)
      {
        PacketOfRays(in, faces, x, y, x1, y1, *buffers[0], counts).Cast();
      }
      else if (!first)
      {
        first.emplace(in, faces, x, y, x1, y1, *buffers[0], counts);
      }
      else
      {
        PacketOfRays second(in, faces, x, y, x1, y1, *buffers[1], counts);
        PacketOfRays::CastBoth(*first, second);
        first.reset();
      }
    }
  }
  if (first)
  {
    first->Cast();
  }
}

template <template <class Real> class Model, bool CellData>
constexpr RayCastKernels::Pair MakePair()
{
  if constexpr (LaneCount == MostLanes)
  {
    return { &CastRays<float, Model<float>, CellData>, nullptr };
  }
  else
  {
    return { &CastRays<float, Model<float>, CellData>, &CastRays<double, Model<double>, CellData> };
  }
}

RayCastKernels MakeRayCastKernels()
{
  RayCastKernels kernels;
  const auto set = [&kernels](
                     Integrator integrator, RayCastKernels::Pair points, RayCastKernels::Pair cells)
  {
    kernels.Points[static_cast<int>(integrator)] = points;
    kernels.Cells[static_cast<int>(integrator)] = cells;
  };
  set(Integrator::ClosedForm, MakePair<ClosedForm, false>(), MakePair<ClosedForm, true>());
  set(Integrator::LitClosedForm, MakePair<LitClosedForm, false>(), {});
  set(Integrator::VaryingLight, MakePair<VaryingLight, false>(), {});
  set(Integrator::Table, MakePair<Table, false>(), {});
  set(Integrator::LitTable, MakePair<LitTable, false>(), {});
  set(Integrator::OpticalDepth, MakePair<OpticalDepth, false>(), MakePair<OpticalDepth, true>());
  set(Integrator::Emission, MakePair<Emission, false>(), MakePair<Emission, true>());
  set(Integrator::Maximum, MakePair<Maximum, false>(), MakePair<Maximum, true>());
  set(Integrator::Isosurfaces, MakePair<Isosurfaces, false>(), {});
  if constexpr (LaneCount < MostLanes)
  {
    set(Integrator::Components, { nullptr, &CastRays<double, Components, false> }, {});
  }
  return kernels;
}

} // namespace
} // namespace TETRALUX_ISA
} // namespace tetralux
