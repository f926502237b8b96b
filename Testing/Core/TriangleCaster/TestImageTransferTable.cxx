// SPDX-License-Identifier: BSD-3-Clause

// Tables over scalars and gradients.

#include "GradientScene.h"
#include "TriangleCaster/TransferTableEvaluation.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

namespace tetralux
{
namespace
{

TEST(ImageTransferTable, IsBilinear)
{
  const int sizes[][2] = { { 2, 2 }, { 5, 3 }, { 2, 40 }, { 64, 32 }, { 300, 2 } };
  for (const auto& size : sizes)
  {
    for (const ImageScalar type : Types)
    {
      for (const bool portable : { false, true })
      {
        SCOPED_TRACE(testing::Message() << size[0] << " x " << size[1] << ", type "
                                        << static_cast<int>(type) << ", portable " << portable);
        ImageScene scene = MakeScene(type);
        scene.Optics.Function.Nodes.clear(); // is not looked at
        scene.Optics.Table = MakeRandomTable(size[0], size[1]);
        scene.Optics.Norm = size[1] == 3 ? GradientNorm::Sum : GradientNorm::Euclidean;
        scene.Options.PortableKernels = portable;
        ExpectGradientReference(scene, TableRounding * (size[0] + size[1]));
      }
    }
  }
}

TEST(ImageTransferTable, HasProductsOfFunctions)
{
  // Both are linear between entries, so the table is their product.
  ImageScene scene = MakeGradientScene(ImageScalar::UInt16);
  const CastPicture product = Cast(scene);
  scene.Optics.GradientOpacity.Nodes[1].Scalar = 0.135;
  scene.Optics.GradientOpacity.Nodes[1].Left.Attenuation = 0.6;
  const CastPicture moved = Cast(scene);
  EXPECT_GT(FindDifference(product, moved), 10 * GradientRounding);
  scene.Optics.Table = MakeProductTable(scene.Optics, 3, 3);
  EXPECT_LE(FindDifference(Cast(scene), moved), GradientRounding);
}

TEST(ImageTransferTable, MayHaveReducedPrecision)
{
  // Between 32 entries over a node, opacity is off by a quarter of what its slope changes in a
  // cell, of some samples.
  constexpr double FiveBitError = 5e-3;
  for (const GradientSource source : Sources)
  {
    ImageScene scene = MakeGradientScene(ImageScalar::UInt8);
    scene.Options.Gradients = source;
    scene.Optics.Table = MakeProductTable(scene.Optics, 1024, 1024);
    const CastPicture full = Cast(scene);
    scene.Optics.Table = Resample(scene.Optics.Table, 32, 32);
    const CastPicture reduced = Cast(scene);
    EXPECT_LE(FindDifference(reduced, full), FiveBitError);
    EXPECT_GT(FindDifference(reduced, full), GradientRounding);
  }
}

TEST(ImageTransferTable, StaysWhenResampled)
{
  const TransferTable table = MakeRandomTable(5, 4);
  const TransferTable finer = Resample(table, 17, 31);
  for (const double scalar : { 0., 0.2, 0.31, 0.5, 0.8, 3. })
  {
    for (const double length : { -1., 0.03, 0.0623, 0.2, 1. })
    {
      const TransferTable::Entry a = Evaluate(table, scalar, length);
      const TransferTable::Entry b = Evaluate(finer, scalar, length);
      EXPECT_NEAR(a.Opacity, b.Opacity, ConstantError);
      EXPECT_NEAR(a.Color[2], b.Color[2], ConstantError);
    }
  }
  EXPECT_THROW(Resample(table, 1, 5), std::invalid_argument);
}

TEST(ImageTransferTable, LeavesOutWhatIsEmpty)
{
  // Columns that have opacity for some gradients, for none, and for all.
  ImageScene scene = MakeScene(ImageScalar::Float);
  scene.Options.SampleDistance = 0.2;
  TransferTable& table = scene.Optics.Table = MakeRandomTable(9, 4);
  for (std::size_t k = 0; k < table.Entries.size(); ++k)
  {
    const bool visible = k % 9 == 8 || (k % 9 == 6 && k / 9 == 2);
    table.Entries[k].Opacity = visible ? 0.5f : 0.f;
  }
  ExpectGradientReference(scene, GradientRounding);
  const CastPicture picture = Cast(scene);
  scene.Options.SkipEmptySpace = false;
  const CastPicture all = Cast(scene);
  EXPECT_TRUE(IsSame(picture, all));
  EXPECT_LT(picture.Statistics.Samples, all.Statistics.Samples);
}

TEST(ImageTransferTable, IsChecked)
{
  const std::function<void(TransferTable&)> faults[] = { [](TransferTable& t) { t.Columns = 1; },
    [](TransferTable& t) { t.Rows = 5; }, [](TransferTable& t) { t.Entries.pop_back(); },
    [](TransferTable& t) { t.LastScalar = t.FirstScalar; },
    [](TransferTable& t) { t.FirstScalar = NaN; }, [](TransferTable& t) { t.LastLength = -1; },
    [](TransferTable& t) { t.Entries[3].Opacity = -0.1f; },
    [](TransferTable& t) { t.Entries[2].Color[1] = NaN; } };
  const TransferTable valid = MakeRandomTable(4, 4);
  EXPECT_NO_THROW(CheckTable(valid));
  for (std::size_t k = 0; k < std::size(faults); ++k)
  {
    ImageOptics optics;
    optics.Table = valid;
    faults[k](optics.Table);
    EXPECT_THROW(ImageCaster().SetOptics(optics), std::invalid_argument) << k;
  }
}

} // namespace
} // namespace tetralux
