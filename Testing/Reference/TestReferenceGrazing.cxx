// SPDX-License-Identifier: BSD-3-Clause
// Which pixels a silhouette grazes.
#include "ReferenceGrazing.h"
#include "ReferencePictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace
{

using namespace tetralux;
using namespace tetralux::reference_pictures;

TEST(Reference, GrazingFindsSilhouettesAndOnlyThem)
{
  // One column of pixels straddles the side of a box, seen along its faces, at half the
  // displacement; a second box is seen obliquely, so that the picture kinks at its edges.
  const Scene box =
    MakeLinearScene(MakeBox(3, 3, 3, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, 3), { 0.5, 0.3, 0.2 }, 0);
  const TransferFunction smooth =
    MakeLinearFunction({ { 0, 1, 0, 0.2, 0.6 }, { 0.5, 0, 1, 0, 2 }, { 1, 1, 1, 0, 1 } });
  const int size = 32;
  const double pixel = 1.5 / size;
  const double center = pixel * (size / 2.0 - 0.5 + 5e-4); // column 0 is at x = 5e-4 pixel
  const RayGrid grid =
    MakeParallelGrid({ center, 0.7, 3 }, { center, 0.7, 0 }, { 0, 1, 0 }, 0.75, size, size);
  const ReferenceImage image = box.Render(smooth, grid);
  const std::vector<double> grazing = MeasureGrazing(box.View(), smooth, grid, {}, image);
  for (int j = 0; j < size; ++j)
  {
    for (int i = 0; i < size; ++i)
    {
      const double y = 0.7 + pixel * (j + 0.5 - size / 2.0);
      EXPECT_EQ(grazing[size * j + i] > GrazingThreshold, i == 0 && y > 0 && y < 1)
        << i << ' ' << j << ' ' << grazing[size * j + i];
    }
  }

  const RayGrid oblique =
    MakePerspectiveGrid({ 1.5, 1.9, 2.3 }, { 0.5, 0.5, 0.5 }, { 0, 1, 0 }, 30, 64, 64);
  const ReferenceImage obliqueImage = box.Render(smooth, oblique);
  const std::vector<double> measure = MeasureGrazing(box.View(), smooth, oblique, {}, obliqueImage);
  const auto grazed = std::count_if(
    measure.begin(), measure.end(), [](double value) { return value > GrazingThreshold; });
  EXPECT_LT(grazed, 10);
  EXPECT_TRUE(MeasureGrazing(box.View(), smooth, oblique, {}, obliqueImage,
                std::vector<std::uint8_t>(64 * 64, 0)) == std::vector<double>(64 * 64, 0.0));
}

} // namespace
