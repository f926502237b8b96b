// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_PreIntegrationTable_h
#define tetralux_PreIntegrationTable_h

// What a segment of a ray adds to a picture, tabulated over the scalars at its front and back end
// and its length (Weiler et al. 2003, sections 3.3 and 4; Kraus et al. 2004, section 3).

#include "Optics/TransferFunction.h"
#include "TetraluxCoreModule.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace tetralux
{

/// How texels lie along the length.
enum class LengthScale
{
  /// Equal steps from 0 to the longest segment (Weiler et al. 2003).
  Linear,

  /// Equal steps from 0 to delta l, then the same number of steps for every doubling (Kraus et al.
  /// 2004, equation 1, which has one). Between texels the scale is linear in the length, not in its
  /// logarithm: segments whose contribution is in proportion to their length stay exact (by the
  /// logarithm they come out up to 6.1 % too opaque, all of them), and no logarithm is taken: the
  /// coordinate is read off the bits of a floating point number.
  Logarithmic
};

/// How texels lie along both scalars.
enum class ScalarAxis
{
  /// Equal steps from one end of the scalar range to the other.
  Uniform,

  /// A texel on every node of the transfer function, two where it has a step (one for each side),
  /// as long as there are enough; the others where the function bends or steps nearby, denser
  /// towards the node.
  Nodes
};

/// What a texel's four channels are stored as.
enum class TexelFormat
{
  UNorm8,  ///< 0..255 for 0..1; colours of the transfer function must be in 0..1
  UNorm16, ///< 0..65535 for 0..1; colours of the transfer function must be in 0..1
  Half,    ///< IEEE 754 binary16
  Float    ///< IEEE 754 binary32
};

/// Bytes of a texel: 4, 8, 8 or 16.
TETRALUXCORE_EXPORT std::size_t GetTexelSize(TexelFormat format);

/// What a table is to be.
struct PreIntegrationSettings
{
  /// Texels along each of the two scalars, 2..4096. With ScalarAxis::Nodes at most as many: there
  /// are fewer if single precision cannot tell more apart.
  int ScalarSize = 128;

  /// Texels along the length, 2..4096.
  int LengthSize = 256;

  LengthScale Scale = LengthScale::Linear;

  /// With LengthScale::Logarithmic: steps for each doubling, a power of 2 in 1..256; LengthSize has
  /// to be larger.
  int StepsPerDoubling = 1;

  ScalarAxis Axis = ScalarAxis::Nodes;
  TexelFormat Format = TexelFormat::Float;

  /// Scalars of the segments, in the units of the transfer function, finite, ascending (equal ends
  /// count as a range that holds them). Scalars outside are looked up as the nearest end.
  double ScalarRange[2] = { 0, 1 };

  /// Longest segment, world units, finite, more than 0: the longest edge of all cells. Longer ones
  /// are looked up as this long.
  double LongestSegment = 1;
};

/// Texel coordinate of a scalar: piecewise linear in x = (s - Offset) / Scale, the same x that
/// IntervalTable has for the transfer function.
struct ScalarAxisMap
{
  /// Coordinate + Slope (min(max(x, Lo), Hi) - Lo), evaluated in single precision; 16 bytes, one
  /// row of four. Ascending; Lo of one is Hi of the one before it. At Hi the coordinate is that of
  /// the next interval's Lo, or one less at a step of the transfer function.
  struct alignas(16) Interval
  {
    float Lo, Hi, Coordinate, Slope;
  };

  /// At least one, and with ScalarAxis::Uniform exactly one. A scalar belongs to the first interval
  /// with x < Hi, or else to the last one.
  std::vector<Interval> Intervals;
  double Offset = 0;
  double Scale = 1;

  /// Scalar of each texel's centre, ascending; equal ones at a step, the left side first.
  std::vector<double> Texels;

  int GetSize() const { return static_cast<int>(this->Texels.size()); }

  /// Coordinate, 0 at the centre of the first texel and GetSize() - 1 at that of the last one.
  TETRALUXCORE_EXPORT float GetCoordinate(float x) const;
};

/// Texel coordinate of a length, with y = length * InverseDelta in single precision:
///
///   LengthScale::Linear       min(y, Size - 1)
///   LengthScale::Logarithmic  min(StepsPerDoubling min(y, 1) + b / 2^(23 - m), Size - 1)
///
/// where StepsPerDoubling = 2^m and b = bits of max(y, 1) - bits of 1.f, as integers: the exponent
/// counts doublings, the mantissa is the way through one.
struct LengthAxisMap
{
  LengthScale Scale = LengthScale::Linear;
  int Size = 0;
  int StepsPerDoubling = 1;
  double Delta = 1; ///< delta l, world units: a step with Linear, 2^m steps with Logarithmic
  float InverseDelta = 1;

  /// Length at the centre of a texel, world units.
  TETRALUXCORE_EXPORT double GetLength(int texel) const;

  /// Coordinate, 0 at the centre of the first texel (length 0), Size - 1 at that of the last one.
  TETRALUXCORE_EXPORT float GetCoordinate(float length) const;
};

/// How wrong a lookup is; of the channels of a segment, absolute, premultiplied, where the colours
/// of the transfer function are in 0..1 (in proportion where they are larger).
struct PreIntegrationError
{
  /// Largest error of a segment of any length by interpolation between texels.
  double Segment = 0;

  /// Largest error by interpolation divided by the length of the segment, 1 / world unit: short
  /// segments are wrong by little.
  double PerLength = 0;

  /// Largest error of a segment by rounding, of the format and of the texels' computation. Does not
  /// shrink with the length.
  double Rounding = 0;
};

/// Memory that is not written before it is used, at a multiple of 64 bytes.
class TETRALUXCORE_EXPORT TexelBuffer
{
public:
  /// Keeps its memory, and what is in it, where the size stays the same.
  void Resize(std::size_t bytes);
  std::size_t GetSize() const { return this->Size; }
  std::uint8_t* GetData() { return this->Data.get(); }
  const std::uint8_t* GetData() const { return this->Data.get(); }

private:
  struct Deleter
  {
    void operator()(std::uint8_t* data) const;
  };
  std::unique_ptr<std::uint8_t[], Deleter> Data;
  std::size_t Size = 0;
};

/// A table: texels and how they are found. Each texel comes from the closed form of the integral
/// (SegmentIntegral.h), exact to PreIntegrationError::Rounding. In a table of many lengths texels
/// are interpolated between the closed form at a few dozen of them (LengthSamples.h).
///
/// Texel (f, b, r) is at ((r n + b) n + f) texel sizes from the start, n = Scalars.GetSize(): front
/// scalar fastest, length slowest. Its four channels are premultiplied red, green, blue and the
/// opacity of a segment from scalar Scalars.Texels[f] (front) to Scalars.Texels[b] (back) of length
/// Lengths.GetLength(r). First and last texels' centres are the ends of the axes: the coordinate of
/// a texture lookup is (coordinate + 0.5) / size.
struct PreIntegrationTable
{
  PreIntegrationSettings Settings; ///< what was asked for
  ScalarAxisMap Scalars;           ///< of both scalars
  LengthAxisMap Lengths;
  TexelBuffer Texels;

  /// What no segment exceeds; see PreIntegrationError.h.
  PreIntegrationError Bound;

  std::size_t GetNumberOfBytes() const { return this->Texels.GetSize(); }

  /// The four channels of a texel.
  TETRALUXCORE_EXPORT void GetTexel(int front, int back, int length, float rgba[4]) const;

  /// What a segment of a ray adds: trilinear interpolation as a kernel has to do it, all in single
  /// precision. With i = min(int(u), size - 2) and t = u - i on each axis, a + t (b - a) along the
  /// front scalar, then the back scalar, then the length. Never negative, opacity never above 1.
  /// Scalars in the units of the transfer function, length in world units.
  TETRALUXCORE_EXPORT void Lookup(
    double frontScalar, double backScalar, double length, float rgba[4]) const;

  /// The same between texels from elsewhere: getTexel(front, back, length, rgba).
  template <class GetTexelFunction>
  void Interpolate(double frontScalar, double backScalar, double length, float rgba[4],
    const GetTexelFunction& getTexel) const;

private:
  /// Where to interpolate on an axis.
  struct Place
  {
    int Index;
    float Share;
  };
  TETRALUXCORE_EXPORT void FindPlaces(
    double frontScalar, double backScalar, double length, Place places[3]) const;
};

template <class GetTexelFunction>
void PreIntegrationTable::Interpolate(double frontScalar, double backScalar, double length,
  float rgba[4], const GetTexelFunction& getTexel) const
{
  Place places[3];
  this->FindPlaces(frontScalar, backScalar, length, places);
  float corners[8][4];
  for (int k = 0; k < 8; ++k)
  {
    getTexel(places[0].Index + (k & 1), places[1].Index + (k >> 1 & 1), places[2].Index + (k >> 2),
      corners[k]);
  }
  // Along the front scalar, then the back scalar, then the length.
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int k = 0; k < 4 >> axis; ++k)
    {
      for (int c = 0; c < 4; ++c)
      {
        const float from = corners[2 * k][c];
        corners[k][c] = from + places[axis].Share * (corners[2 * k + 1][c] - from);
      }
    }
  }
  for (int c = 0; c < 4; ++c)
  {
    rgba[c] = corners[0][c];
  }
}

} // namespace tetralux

#endif
