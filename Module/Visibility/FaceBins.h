// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FaceBins_h
#define tetralux_FaceBins_h

#include "Base/Span.h"
#include "Visibility/VisibilityView.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace tetralux
{

/// Faces by where they are on the picture of a view: in a grid of bins, each face in all bins that
/// the box around it meets. Finds the faces that one face may have behind it or in front of it.
class FaceBins
{
public:
  using Corner = std::array<double, 3>;
  using Face = std::array<Corner, 3>;

  /// view: in the coordinates of the faces, which are at most 1 from the origin. binned: one flag
  /// for each face, whether ForEach finds it. Parallel but for filling the bins.
  FaceBins(const VisibilityView& view, Span<const Face> faces, Span<const std::uint8_t> binned);

  /// False if some face is beside or behind the viewer, or if faces are too long for bins of their
  /// size. ForEach finds nothing then.
  bool IsUsable() const { return this->Resolution > 0; }

  /// Calls visit(other) for each binned face that may share a place on the picture with a face:
  /// whose box meets that one's, but for a margin far beyond rounding. Each once, in an order that
  /// depends on the faces alone. Returns how many faces were looked at.
  template <class Visit>
  std::int64_t ForEach(std::int64_t face, const Visit& visit) const
  {
    const Box& box = this->Boxes[face];
    const Range range = this->FindRange(box);
    std::int64_t looked = 0;
    for (std::int32_t row = range.Lo[1]; row <= range.Hi[1]; ++row)
    {
      for (std::int32_t column = range.Lo[0]; column <= range.Hi[0]; ++column)
      {
        const std::int32_t bin = row * this->Resolution + column;
        looked += this->Begins[bin + 1] - this->Begins[bin];
        for (std::int32_t i = this->Begins[bin]; i < this->Begins[bin + 1]; ++i)
        {
          const std::int32_t other = this->Faces[i];
          const Box& otherBox = this->Boxes[other];
          const bool meets = box.Lo[0] <= otherBox.Hi[0] && otherBox.Lo[0] <= box.Hi[0] &&
            box.Lo[1] <= otherBox.Hi[1] && otherBox.Lo[1] <= box.Hi[1];
          // In the bin where what both boxes share begins, so that each comes once.
          if (meets && this->FindBin(std::max(box.Lo[0], otherBox.Lo[0]), 0) == column &&
            this->FindBin(std::max(box.Lo[1], otherBox.Lo[1]), 1) == row)
          {
            visit(other);
          }
        }
      }
    }
    return looked;
  }

private:
  struct Box
  {
    double Lo[2], Hi[2];
  };
  struct Range
  {
    std::int32_t Lo[2], Hi[2]; ///< bins
  };

  bool FindBoxes(const VisibilityView& view, Span<const Face> faces);
  void Fill(Span<const std::uint8_t> binned);

  std::int32_t FindBin(double place, int axis) const
  {
    const double bin = (place - this->Origin[axis]) * this->BinsPerLength[axis];
    return static_cast<std::int32_t>(std::clamp(bin, 0., this->Resolution - 1.));
  }
  Range FindRange(const Box& box) const
  {
    return { { this->FindBin(box.Lo[0], 0), this->FindBin(box.Lo[1], 1) },
      { this->FindBin(box.Hi[0], 0), this->FindBin(box.Hi[1], 1) } };
  }

  std::int32_t Resolution = 0; ///< bins along each axis
  double Origin[2] = { 0, 0 };
  double BinsPerLength[2] = { 0, 0 };
  std::vector<Box> Boxes;
  std::vector<std::int32_t> Begins; ///< of each bin in Faces, and the end of the last one
  std::vector<std::int32_t> Faces;
};

} // namespace tetralux

#endif
