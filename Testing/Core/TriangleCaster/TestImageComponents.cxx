// SPDX-License-Identifier: BSD-3-Clause
#include "ComponentScene.h"

#include "SampleFunctions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

namespace tetralux
{
namespace
{

constexpr ImageScalar AllTypes[] = { ImageScalar::Int8, ImageScalar::UInt8, ImageScalar::Int16,
  ImageScalar::UInt16, ImageScalar::Float };

/// Smooth shares of the range, different for each component.
std::vector<double> MakeShares(const std::array<int, 3>& dimensions, int components)
{
  std::vector<double> shares;
  for (int z = 0; z < dimensions[2]; ++z)
  {
    for (int y = 0; y < dimensions[1]; ++y)
    {
      for (int x = 0; x < dimensions[0]; ++x)
      {
        for (int c = 0; c < components; ++c)
        {
          shares.push_back(0.5 +
            0.45 * std::sin(0.5 * x + 1.3 * c) * std::cos(0.6 * y - 0.7 * c) *
              std::sin(0.4 * z + 1 + 0.3 * c));
        }
      }
    }
  }
  return shares;
}

/// Functions over scalars 0..1; the opaquer a sample, the more it counts if its label is mistaken.
TransferFunction MakeFunction(std::mt19937_64& generator, int nodes, double opacity)
{
  return MakeRandomFunction(generator, nodes, opacity, false);
}

/// A factor over gradients.
TransferFunction MakeGradientOpacity(double low, double high)
{
  const auto value = [](double a) { return TransferFunction::Value{ { 0, 0, 0 }, a }; };
  return { { { 0.02, value(low), value(low) }, { 0.2, value(high), value(high) } } };
}

Light MakeLight(double x, double y, double z)
{
  const double length = std::hypot(x, y, z);
  return { { x / length, y / length, z / length }, false, { 1, 0.9f, 0.8f }, { 0.9f, 1, 0.7f },
    { 0.5f, 0.6f, 1 } };
}

/// A picture of 19 x 17 pixels; several tiles, the last ones not whole.
void LookWithLights(ComponentScene& scene, bool parallel)
{
  scene.Look(parallel, 19, 17);
  scene.Options.SampleDistance = 0.37;
  scene.Options.Threshold = 0;
  scene.Options.NumberOfThreads = 1;
  scene.Options.Lights = { MakeLight(1, 2, 0.5), MakeLight(-1, 0.3, 2) };
  scene.Optics.UnitDistance = 1.3;
}

/// Depth cueing, of each channel in another way.
void CueDepth(ImageCasterOptions& options)
{
  const float nearColor[3] = { 1.2f, 0.9f, 0.1f };
  const float farColor[3] = { 0.2f, 0.4f, 1.f };
  std::copy(nearColor, nearColor + 3, options.NearColor);
  std::copy(farColor, farColor + 3, options.FarColor);
}

ComponentScene MakeIndependent(ImageScalar type, int components, bool gradients)
{
  std::mt19937_64 generator(17);
  ComponentScene scene;
  scene.SetValues(type, components, MakeShares(scene.Dimensions, components));
  LookWithLights(scene, components == 3);
  scene.Optics.Function = MakeFunction(generator, 5, 0.4);
  scene.Optics.Weight = 0.9;
  const int nodes[] = { 40, 12, 6 }; // one of each way of looking up
  const double weights[] = { 0.6, 1, 0.8 };
  for (int k = 0; k + 1 < components; ++k)
  {
    ComponentOptics other;
    other.Function = MakeFunction(generator, nodes[k], 0.3);
    other.UnitDistance = 0.8 + 0.5 * k;
    other.Weight = weights[k];
    other.Surface.Diffuse = 0.5f;
    other.Surface.Specular = 0.4f;
    other.Shaded = gradients && k != 1;
    if (gradients && k == 1)
    {
      other.GradientOpacity = MakeGradientOpacity(0.9, 0.2);
    }
    scene.Optics.OtherComponents.push_back(other);
  }
  if (gradients)
  {
    CueDepth(scene.Options);
    scene.Options.Shaded = components != 4;
    scene.Optics.GradientOpacity = MakeGradientOpacity(0.1, 1);
  }
  return scene;
}

ComponentScene MakeDependent(ImageScalar type, int components, bool gradients)
{
  std::mt19937_64 generator(23);
  ComponentScene scene;
  scene.SetValues(type, components, MakeShares(scene.Dimensions, components));
  LookWithLights(scene, components == 4);
  scene.Optics.Components = ImageComponents::Dependent;
  scene.Optics.Function = MakeFunction(generator, components == 2 ? 30 : 6, 0.5);
  for (int c = 0; c < 3; ++c)
  {
    scene.Optics.ColorScale[c] = 0.8 - 0.1 * c;
    scene.Optics.ColorOffset[c] = 0.1 * c;
  }
  if (gradients)
  {
    CueDepth(scene.Options);
    scene.Options.Shaded = true;
    scene.Optics.GradientOpacity = MakeGradientOpacity(0.3, 1);
  }
  return scene;
}

/// Five labels in balls and layers, of which three have functions.
ComponentScene MakeLabelled(ImageScalar type, double share, bool gradients)
{
  std::mt19937_64 generator(29);
  ComponentScene scene;
  scene.SetValues(type, 1, MakeShares(scene.Dimensions, 1));
  LookWithLights(scene, share < 1);
  for (int z = 0; z < scene.Dimensions[2]; ++z)
  {
    for (int y = 0; y < scene.Dimensions[1]; ++y)
    {
      for (int x = 0; x < scene.Dimensions[0]; ++x)
      {
        const bool inside = std::hypot(x - 4, y - 5, z - 4) < 3.5;
        scene.Labels.push_back(static_cast<unsigned char>(inside ? 1
            : x > 10                                             ? 77
            : y < 3                                              ? 2
            : z > 6                                              ? 3
                                                                 : 0));
      }
    }
  }
  // An opacity of 0.05 a sample: one whose label is mistaken at its border changes little.
  scene.Optics.Function = MakeFunction(generator, 4, 0.05);
  const int nodes[] = { 3, 50, 9 };
  for (int k = 0; k < 3; ++k)
  {
    LabelOptics label;
    label.Function = MakeFunction(generator, nodes[k], 0.05);
    for (TransferFunction::Node& node : label.Function.Nodes)
    {
      // Functions reach over different scalars.
      node.Scalar = 0.2 * k + 0.5 * node.Scalar;
    }
    if (gradients && k == 1)
    {
      label.GradientOpacity = MakeGradientOpacity(1, 0.3);
    }
    scene.Optics.Labels.push_back(label);
  }
  scene.Optics.LabelShare = share;
  if (gradients)
  {
    CueDepth(scene.Options);
    scene.Options.Shaded = true;
    scene.Optics.GradientOpacity = MakeGradientOpacity(0.4, 0.9);
  }
  return scene;
}

std::vector<unsigned char> MakeBytes(
  std::size_t count, double share, unsigned char some, unsigned char others)
{
  std::mt19937_64 generator(31);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<unsigned char> bytes(count);
  std::generate(
    bytes.begin(), bytes.end(), [&] { return unit(generator) < share ? some : others; });
  return bytes;
}

/// Hides some of a scene by all means.
void HideSome(ComponentScene& scene)
{
  const auto& n = scene.Dimensions;
  const std::size_t points = static_cast<std::size_t>(n[0]) * n[1] * n[2];
  const std::size_t cells = static_cast<std::size_t>(n[0] - 1) * (n[1] - 1) * (n[2] - 1);
  scene.Mask = MakeBytes(points, 0.2, 0, 255);
  // Other flags, of points that are elsewhere as well, hide nothing.
  scene.PointFlags = MakeBytes(points, 0.02, 2, 1);
  scene.CellFlags = MakeBytes(cells, 0.1, 33, 8);
}

/// All ways of casting a scene come to the picture of plain loops.
void ExpectLoops(ComponentScene scene)
{
  constexpr double Largest = 1. / 255; // of a channel
  // Single precision, over some 60 samples.
  constexpr double Usual = 1e-5;
  constexpr double UsualShare = 0.99; // of the channels
  const std::vector<double> expected = ShowByLoops(scene);
  constexpr double Seen = 0.1; // there is something to compare
  ASSERT_GT(*std::max_element(expected.begin(), expected.end()), Seen);
  for (const bool portable : { false, true })
  {
    SCOPED_TRACE(portable ? "portable" : "fastest");
    scene.Options.PortableKernels = portable;
    scene.Options.SkipEmptySpace = true;
    const ComponentPicture picture = CastScene(scene);
    std::size_t close = 0;
    double worst = 0;
    for (std::size_t k = 0; k < expected.size(); ++k)
    {
      const double difference = std::abs(picture.Colors[k] - expected[k]);
      close += difference <= Usual ? 1 : 0;
      worst = difference <= worst ? worst : difference;
    }
    EXPECT_LE(worst, Largest);
    EXPECT_GE(close, UsualShare * expected.size());

    scene.Options.SkipEmptySpace = false;
    EXPECT_TRUE(HasSameBits(picture, CastScene(scene)));
    scene.Options.NumberOfThreads = 3;
    EXPECT_TRUE(HasSameBits(picture, CastScene(scene)));
    scene.Options.NumberOfThreads = 1;
  }
}

std::string GetName(ImageScalar type, int components, bool gradients)
{
  return "type " + std::to_string(static_cast<int>(type)) + ", " + std::to_string(components) +
    " components" + (gradients ? ", gradients" : "");
}

} // namespace

TEST(ImageComponents, IndependentOnesAddUp)
{
  for (const ImageScalar type : AllTypes)
  {
    for (const int components : { 2, 3, 4 })
    {
      for (const bool gradients : { false, true })
      {
        SCOPED_TRACE(GetName(type, components, gradients));
        ExpectLoops(MakeIndependent(type, components, gradients));
      }
    }
  }
}

TEST(ImageComponents, DependentOnesAreColorAndOpacity)
{
  for (const ImageScalar type : AllTypes)
  {
    for (const int components : { 2, 4 })
    {
      for (const bool gradients : { false, true })
      {
        SCOPED_TRACE(GetName(type, components, gradients));
        ExpectLoops(MakeDependent(type, components, gradients));
      }
    }
  }
}

TEST(ImageComponents, BytesAreColorsOver255)
{
  ComponentScene scene = MakeDependent(ImageScalar::UInt8, 4, false);
  scene.Scale = 1;
  scene.Offset = 0;
  scene.Optics = ImageOptics();
  scene.Optics.Components = ImageComponents::Dependent;
  scene.Optics.Function = { { { 0, { { 0, 0, 0 }, 1 }, { { 0, 0, 0 }, 1 } } } };
  for (std::size_t k = 0; k < scene.Values.size(); ++k)
  {
    scene.Values[k] = static_cast<unsigned char>(50 + 50 * (k % 4));
  }
  const ComponentPicture picture = CastScene(scene);
  const std::size_t middle = 4 * (scene.GetNumberOfPixels() / 2);
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(picture.Colors[middle + c], (50 + 50 * c) / 255., 1e-6);
  }
  EXPECT_EQ(picture.Colors[middle + 3], 1);
}

// What has no weight is not there, and one component of weight 1 is as if it were alone.
TEST(ImageComponents, NoWeightIsNoComponent)
{
  ComponentScene scene = MakeIndependent(ImageScalar::UInt16, 3, true);
  scene.Optics.Weight = 1;
  scene.Optics.OtherComponents[0].Weight = 0;
  scene.Optics.OtherComponents[1].Weight = 0;
  const ComponentPicture picture = CastScene(scene);

  ComponentScene alone = scene;
  std::vector<double> shares;
  for (std::size_t k = 0; k < scene.Numbers.size(); k += 3)
  {
    shares.push_back(scene.Numbers[k] / std::numeric_limits<std::uint16_t>::max());
  }
  alone.SetValues(ImageScalar::UInt16, 1, shares);
  alone.Optics.OtherComponents.clear();
  const ComponentPicture expected = CastScene(alone);
  for (std::size_t k = 0; k < expected.Colors.size(); ++k)
  {
    // A division more of each sample.
    EXPECT_NEAR(picture.Colors[k], expected.Colors[k], 1e-6);
  }
  EXPECT_EQ(picture.Depths, expected.Depths);
}

// Weights below 1 may absorb more than all light, by the formula; it is all light then.
TEST(ImageComponents, NothingAbsorbsMoreThanAll)
{
  ComponentScene scene = MakeIndependent(ImageScalar::UInt8, 2, false);
  scene.Optics.Function = { { { 0, { { 1, 0, 0 }, 1 }, { { 1, 0, 0 }, 1 } } } };
  scene.Optics.Weight = 0.25;
  scene.Optics.OtherComponents[0].Weight = 0;
  ExpectLoops(scene);
  const ComponentPicture picture = CastScene(scene);
  const std::size_t middle = 4 * (scene.GetNumberOfPixels() / 2);
  EXPECT_EQ(picture.Colors[middle], 0.25f);
  EXPECT_EQ(picture.Colors[middle + 3], 1);
}

TEST(ImageComponents, WhatIsNotANumberIsEmpty)
{
  for (const int components : { 2, 4 })
  {
    for (const bool dependent : { false, true })
    {
      SCOPED_TRACE(std::to_string(components) + (dependent ? " dependent" : " independent"));
      ComponentScene scene = dependent ? MakeDependent(ImageScalar::Float, components, true)
                                       : MakeIndependent(ImageScalar::Float, components, true);
      const ComponentPicture whole = CastScene(scene);
      for (int c = 0; c < components; ++c)
      {
        // A plane of points.
        ComponentScene broken = scene;
        for (int y = 0; y < scene.Dimensions[1]; ++y)
        {
          for (int x = 0; x < scene.Dimensions[0]; ++x)
          {
            const float nan = std::numeric_limits<float>::quiet_NaN();
            const std::size_t at =
              ((4 * scene.Dimensions[1] + y) * scene.Dimensions[0] + x) * components + c;
            std::memcpy(&broken.Values[at * sizeof(float)], &nan, sizeof(float));
          }
        }
        const ComponentPicture picture = CastScene(broken);
        EXPECT_TRUE(std::all_of(picture.Colors.begin(), picture.Colors.end(),
          [](float color) { return std::isfinite(color); }));
        EXPECT_FALSE(HasSameBits(picture, whole));
        broken.Options.SkipEmptySpace = false;
        EXPECT_TRUE(HasSameBits(picture, CastScene(broken)));
      }
    }
  }
}

TEST(ImageComponents, LabelsChooseFunctions)
{
  for (const ImageScalar type : AllTypes)
  {
    for (const double share : { 1., 0.4, 0. })
    {
      for (const bool gradients : { false, true })
      {
        SCOPED_TRACE(GetName(type, 1, gradients) + ", share " + std::to_string(share));
        ExpectLoops(MakeLabelled(type, share, gradients));
      }
    }
  }
}

TEST(ImageComponents, LabelsWithoutFunctionsChangeNothing)
{
  ComponentScene scene = MakeLabelled(ImageScalar::Int16, 1, false);
  scene.Optics.Labels.clear();
  const ComponentPicture picture = CastScene(scene);
  scene.Labels.clear();
  EXPECT_TRUE(HasSameBits(picture, CastScene(scene)));
}

TEST(ImageComponents, MasksAndBlankedCellsHide)
{
  for (const ImageScalar type : AllTypes)
  {
    SCOPED_TRACE(GetName(type, 1, false));
    ComponentScene labelled = MakeLabelled(type, 1, false);
    HideSome(labelled);
    ExpectLoops(labelled);
    labelled.Optics.Labels.clear();
    ExpectLoops(labelled);
  }
  ComponentScene dependent = MakeDependent(ImageScalar::UInt8, 4, true);
  HideSome(dependent);
  // Whether a sample is hidden depends on rounding; such a one is not to show.
  for (TransferFunction::Node& node : dependent.Optics.Function.Nodes)
  {
    node.Left.Attenuation *= 0.2;
    node.Right.Attenuation *= 0.2;
  }
  ExpectLoops(dependent);
}

// The scalar of a slab with one function does not matter, but whether its middle is hidden does.
TEST(ImageComponents, SlabsAreMaskedInTheirMiddle)
{
  ComponentScene scene = MakeLabelled(ImageScalar::UInt8, 1, false);
  scene.Labels.clear();
  scene.Optics.Labels.clear();
  const TransferFunction::Value value = { { 0.9, 0.5, 0.2 }, 0.1 };
  scene.Optics.Function = { { { 0, value, value }, { 1, value, value } } };
  HideSome(scene);
  ExpectLoops(scene);
  const ComponentPicture samples = CastScene(scene);
  scene.Options.PreIntegrated = true;
  const ComponentPicture slabs = CastScene(scene);
  for (std::size_t k = 0; k < samples.Colors.size(); ++k)
  {
    // The table's rounding, over some 60 samples.
    EXPECT_NEAR(slabs.Colors[k], samples.Colors[k], 1e-5);
  }
  scene.Options.SkipEmptySpace = false;
  EXPECT_TRUE(HasSameBits(slabs, CastScene(scene)));
}

// Empty space is known by the functions of labels and components, and what is hidden.
TEST(ImageComponents, EmptySpaceIsSkipped)
{
  const auto countSamples = [](ComponentScene scene)
  {
    const ComponentPicture picture = CastScene(scene);
    scene.Options.SkipEmptySpace = false;
    const ComponentPicture all = CastScene(scene);
    EXPECT_TRUE(HasSameBits(picture, all));
    return std::array<double, 2>{ static_cast<double>(picture.Statistics.Samples),
      static_cast<double>(all.Statistics.Samples) };
  };
  const auto makeTransparent = [](TransferFunction& function)
  {
    for (TransferFunction::Node& node : function.Nodes)
    {
      node.Left.Attenuation = node.Right.Attenuation = 0;
    }
  };
  ComponentScene labelled = MakeLabelled(ImageScalar::UInt8, 1, false);
  const auto whole = countSamples(labelled);
  makeTransparent(labelled.Optics.Function);
  makeTransparent(labelled.Optics.Labels[1].Function);
  makeTransparent(labelled.Optics.Labels[2].Function);
  const auto onlyFirst = countSamples(labelled);
  EXPECT_LT(onlyFirst[0], whole[0]);
  EXPECT_GT(onlyFirst[0], 0);
  makeTransparent(labelled.Optics.Labels[0].Function);
  EXPECT_EQ(countSamples(labelled)[0], 0);

  // What unlabelled samples have shows in part where all samples are labelled.
  ComponentScene shared = MakeLabelled(ImageScalar::UInt8, 0.5, false);
  shared.Labels.assign(shared.Numbers.size(), 1);
  makeTransparent(shared.Optics.Labels[0].Function);
  EXPECT_GT(countSamples(shared)[0], 0);
  shared.Optics.LabelShare = 1;
  EXPECT_EQ(countSamples(shared)[0], 0);

  ComponentScene parts = MakeIndependent(ImageScalar::UInt8, 2, false);
  makeTransparent(parts.Optics.Function);
  EXPECT_GT(countSamples(parts)[0], 0);
  parts.Optics.OtherComponents[0].Weight = 0;
  EXPECT_EQ(countSamples(parts)[0], 0);

  ComponentScene masked = MakeDependent(ImageScalar::UInt8, 2, false);
  masked.Mask.assign(masked.Numbers.size() / 2, 0);
  EXPECT_EQ(countSamples(masked)[0], 0);
  masked.Mask.clear();
  masked.PointFlags.assign(masked.Numbers.size() / 2, 2);
  EXPECT_EQ(countSamples(masked)[0], 0);
}

TEST(ImageComponents, WhatHasNoMeaningIsRefused)
{
  const auto refuses = [](const ComponentScene& scene, const std::string& part)
  {
    try
    {
      CastScene(scene);
    }
    catch (const std::invalid_argument& error)
    {
      return std::string(error.what()).find(part) != std::string::npos;
    }
    return false;
  };
  ComponentScene scene = MakeIndependent(ImageScalar::UInt8, 3, false);
  scene.Components = 5;
  EXPECT_TRUE(refuses(scene, "5 components"));
  scene = MakeIndependent(ImageScalar::UInt8, 3, false);
  scene.Optics.OtherComponents.pop_back();
  EXPECT_TRUE(refuses(scene, "optics for 2"));
  scene = MakeIndependent(ImageScalar::UInt8, 3, false);
  scene.Optics.Components = ImageComponents::Dependent;
  EXPECT_TRUE(refuses(scene, "dependent components are 2 or 4"));
  scene = MakeIndependent(ImageScalar::UInt8, 3, false);
  scene.Labels.assign(scene.Numbers.size() / 3, 1);
  EXPECT_FALSE(refuses(scene, ""));
  scene.Optics.Labels = MakeLabelled(ImageScalar::UInt8, 1, false).Optics.Labels;
  EXPECT_TRUE(refuses(scene, "labels"));
  scene = MakeIndependent(ImageScalar::UInt8, 3, false);
  scene.Optics.OtherComponents[1].UnitDistance = 0;
  EXPECT_TRUE(refuses(scene, "unit distance"));
  scene = MakeIndependent(ImageScalar::UInt8, 3, false);
  scene.Optics.Weight = -1;
  EXPECT_TRUE(refuses(scene, "weight"));
  scene = MakeIndependent(ImageScalar::UInt8, 2, false);
  scene.Options.PreIntegrated = true;
  EXPECT_TRUE(refuses(scene, "slabs are of one function"));
  scene = MakeLabelled(ImageScalar::UInt8, 1, false);
  scene.Options.PreIntegrated = true;
  EXPECT_TRUE(refuses(scene, "slabs are of one function"));
  scene = MakeLabelled(ImageScalar::UInt8, 1, false);
  scene.Optics.LabelShare = 1.5;
  EXPECT_TRUE(refuses(scene, "share"));
}

TEST(ImageComponents, WhatOneFunctionHasIsRefused)
{
  const ComponentScene scenes[] = { MakeIndependent(ImageScalar::UInt8, 2, true),
    MakeDependent(ImageScalar::UInt8, 4, true), MakeLabelled(ImageScalar::UInt8, 1, true) };
  for (const ComponentScene& scene : scenes)
  {
    const auto refuses = [&](const auto& change)
    {
      ComponentScene changed = scene;
      change(changed.Optics, changed.Options);
      EXPECT_THROW(CastScene(changed), std::invalid_argument);
    };
    EXPECT_NO_THROW(CastScene(scene));
    for (const ImageBlend blend :
      { ImageBlend::MaximumIntensity, ImageBlend::MinimumIntensity, ImageBlend::AverageIntensity,
        ImageBlend::Additive, ImageBlend::Isosurfaces, ImageBlend::Slice })
    {
      refuses([&](ImageOptics& optics, ImageCasterOptions&) { optics.Blend = blend; });
    }
    refuses(
      [](ImageOptics& optics, ImageCasterOptions&)
      {
        optics.Table.Columns = optics.Table.Rows = 2;
        optics.Table.Entries.resize(4);
      });
    refuses(
      [](ImageOptics&, ImageCasterOptions& options) { options.Gradients = GradientSource::Bytes; });
    refuses([](ImageOptics&, ImageCasterOptions& options)
      { options.SumOfLights = LightSum::NearestEntry; });
  }
}

} // namespace tetralux
