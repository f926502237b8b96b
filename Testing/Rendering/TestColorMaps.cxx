// SPDX-License-Identifier: BSD-3-Clause
// Pictures of colour maps beside those in which nothing stands for the map, by the same mapper.
#include "Preparation/FunctionChunks.h"
#include "RayCastScene.h"
#include "Statistics.h"

#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraProjectionMapper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace
{

constexpr int Width = 64;
constexpr int Height = 48;

/// Rounding of the same sums in another order, by OpenGL, of a channel.
constexpr double SumRounding = 5e-6;

const std::vector<std::string> Maps = { "3 nodes", "6 nodes", "256 nodes", "diverging" };

void SetColors(vtkColorTransferFunction* colors, const std::string& map, double low, double high)
{
  colors->RemoveAllPoints();
  colors->SetColorSpaceToRGB();
  const auto add = [&](double t, double red, double green, double blue)
  { colors->AddRGBPoint(low + t * (high - low), red, green, blue); };
  if (map == "3 nodes")
  {
    add(0, 0, 0, 1);
    add(0.5, 1, 1, 1);
    add(1, 1, 0, 0);
  }
  else if (map == "6 nodes")
  {
    const double nodes[6][3] = { { 0, 0, 1 }, { 0, 1, 1 }, { 0, 1, 0 }, { 1, 1, 0 }, { 1, 0.5, 0 },
      { 1, 0, 0 } };
    for (int k = 0; k < 6; ++k)
    {
      add(k / 5., nodes[k][0], nodes[k][1], nodes[k][2]);
    }
  }
  else if (map == "256 nodes")
  {
    for (int k = 0; k < 256; ++k)
    {
      const double t = k / 255.;
      add(t, std::clamp(0.27 + t * (0.1 + t * (-2.2 + 2.83 * t)), 0., 1.), 0.9 * std::sin(1.45 * t),
        std::clamp(0.33 + t * (1.3 - t * (2.9 - 1.4 * t)), 0., 1.));
    }
  }
  else
  {
    colors->SetColorSpaceToDiverging();
    add(0, 0.231373, 0.298039, 0.752941);
    add(0.5, 0.865, 0.865, 0.865);
    add(1, 0.705882, 0.0156863, 0.14902);
  }
}

class ColorMapScene : public RayCastScene
{
public:
  ColorMapScene()
    : RayCastScene(Width, Height)
  {
    const auto [low, high] = std::minmax_element(this->Scalars.begin(), this->Scalars.end());
    this->Low = *low;
    this->High = *high;
    this->Opacity->RemoveAllPoints();
    const double nodes[6][2] = { { 0, 0 }, { 0.2, 0.05 }, { 0.35, 0.7 }, { 0.5, 0.1 }, { 0.8, 0.4 },
      { 1, 0.95 } };
    for (const double(&node)[2] : nodes)
    {
      this->Opacity->AddPoint(this->Low + node[0] * (this->High - this->Low), node[1]);
    }
    this->Volume->GetProperty()->SetScalarOpacityUnitDistance(0.3);
    this->Mapper->AutoAdjustSampleDistancesOff();
  }

  void SetMap(const std::string& map) { SetColors(this->Color, map, this->Low, this->High); }

  std::vector<float> Render(double error)
  {
    this->GetMapper()->SetMaximumError(error);
    this->Window->Render();
    return { this->GetColors(), this->GetColors() + std::size_t(4) * Width * Height };
  }

  double Low = 0, High = 1;
};

double Compare(const std::vector<float>& a, const std::vector<float>& b)
{
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    largest = std::max<double>(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

enum class Method
{
  RayCast,
  GPURayCast,
  Projection
};

class ColorMaps : public testing::TestWithParam<Method>
{
protected:
  ColorMaps()
  {
    if (this->GetParam() == Method::GPURayCast)
    {
      this->Scene.Use(vtkSmartPointer<vtkTetrahedraGPURayCastMapper>::New());
    }
    if (this->GetParam() == Method::Projection)
    {
      this->Scene.Use(vtkSmartPointer<vtkTetrahedraProjectionMapper>::New());
    }
  }

  /// Expects each map to be within each error, and returns the largest share of an error.
  void ExpectWithinError(const std::string& name)
  {
    this->Scene.GetMapper()->SetIntegrationToClosedForm();
    for (const std::string& map : Maps)
    {
      SCOPED_TRACE(name + ", " + map);
      this->Scene.SetMap(map);
      const std::vector<float> exact = this->Scene.Render(0);
      ASSERT_GT(*std::max_element(exact.begin(), exact.end()), 0.1f);
      const int intervals = this->GetNumberOfIntervals();
      for (const double error : { 1e-2, 1e-3, 1e-4 })
      {
        EXPECT_LE(Compare(this->Scene.Render(error), exact), error + SumRounding) << error;
        EXPECT_LE(this->GetNumberOfIntervals(), intervals);
        // Pictures are made of few intervals, but for errors as small as the map's kinks.
        constexpr double KinksOfMaps = 1e-4;
        constexpr int Many = 200;
        constexpr int Few = 50;
        EXPECT_TRUE(error <= KinksOfMaps || intervals < Many || this->GetNumberOfIntervals() <= Few)
          << this->GetNumberOfIntervals() << " of " << intervals;
      }
    }
  }

  int GetNumberOfIntervals()
  {
    return std::stoi(GetStatistic(this->Scene.GetMapper(), "transfer_function_intervals"));
  }

  ColorMapScene Scene;
};

TEST_P(ColorMaps, AreWithinTheError)
{
  this->ExpectWithinError("composite");
  this->Scene.GetMapper()->SetBlendModeToAdditive();
  this->Scene.Volume->GetProperty()->SetScalarOpacityUnitDistance(3); // below 1
  this->ExpectWithinError("additive");
}

TEST_P(ColorMaps, AreWithinTheErrorUnderLight)
{
  this->Scene.Volume->GetProperty()->ShadeOn();
  this->Scene.Volume->GetProperty()->SetSpecular(0.3);
  this->Scene.Volume->GetProperty()->SetSpecularPower(20);
  for (const bool smooth : { false, true })
  {
    this->Scene.GetMapper()->SetSmoothShading(smooth);
    this->ExpectWithinError(smooth ? "smooth" : "of cells");
  }
}

// The largest scalar, and cells of one value, are looked up once: exactly.
TEST_P(ColorMaps, AreExactWhereThatCostsNoMore)
{
  this->Scene.SetMap("diverging");
  this->Scene.GetMapper()->SetBlendModeToMaximumIntensity();
  this->Scene.Render(1e-3);
  const int nodes = std::stoi(GetStatistic(this->Scene.GetMapper(), "transfer_function_nodes"));
  EXPECT_EQ(this->GetNumberOfIntervals(), nodes + 1);
}

std::string GetName(const testing::TestParamInfo<Method>& info)
{
  return info.param == Method::RayCast ? "RayCast"
    : info.param == Method::GPURayCast ? "GPURayCast"
                                       : "Projection";
}

INSTANTIATE_TEST_SUITE_P(Methods, ColorMaps,
  testing::Values(Method::RayCast, Method::GPURayCast, Method::Projection), GetName);

// Edits of a map of many nodes choose no table.
TEST(ColorMapEdits, TryNoTable)
{
  ColorMapScene scene;
  scene.SetMap("diverging");
  scene.Render(1e-4);
  scene.Opacity->AddPoint(0.5 * (scene.Low + scene.High), 0.6);
  scene.Render(1e-4);
  EXPECT_EQ(GetStatistic(scene.Mapper, "reason"),
    "\"closed form: a segment has few pieces, a lookup takes longer\"");
}

/// Scalars at all nodes, between them, and beyond both ends.
std::vector<double> MakeScalars(const std::vector<double>& nodes)
{
  // No logarithms of negative numbers.
  std::vector<double> scalars = { 0.5 * nodes.front(), nodes.back() + 1 };
  for (std::size_t k = 0; k < nodes.size(); ++k)
  {
    scalars.push_back(nodes[k]);
    if (k > 0)
    {
      scalars.push_back(0.3 * nodes[k - 1] + 0.7 * nodes[k]);
    }
  }
  return scalars;
}

/// Ascending, some of them twice or three times.
std::vector<double> MakeNodes(std::mt19937_64& random)
{
  std::vector<double> nodes;
  double place = 0.5;
  for (int k = 0; k < 300; ++k)
  {
    place += random() % 4 == 0 ? 0 : 0.01 + 1e-3 * static_cast<double>(random() % 100);
    nodes.push_back(place);
  }
  return nodes;
}

TEST(FunctionChunks, HaveTheValuesOfTheWholeFunction)
{
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const int space : { VTK_CTF_RGB, VTK_CTF_HSV, VTK_CTF_LAB, VTK_CTF_DIVERGING })
  {
    for (const bool logarithmic : { false, true })
    {
      vtkNew<vtkColorTransferFunction> colors;
      colors->SetColorSpace(space);
      colors->SetAllowDuplicateScalars(1);
      colors->SetScale(logarithmic ? VTK_CTF_LOG10 : VTK_CTF_LINEAR);
      vtkNew<vtkPiecewiseFunction> opacity;
      opacity->SetAllowDuplicateScalars(true);
      opacity->SetUseLogScale(logarithmic);
      const std::vector<double> nodes = MakeNodes(random);
      for (const double x : nodes)
      {
        colors->AddRGBPoint(x, unit(random), unit(random), unit(random), unit(random),
          random() % 2 ? 0 : unit(random));
        opacity->AddPoint(x, unit(random), unit(random), random() % 2 ? 0 : unit(random));
      }
      const tetralux::FunctionChunks<vtkColorTransferFunction> ofColors(colors, logarithmic);
      const tetralux::FunctionChunks<vtkPiecewiseFunction> ofOpacity(opacity, logarithmic);
      for (const double x : MakeScalars(nodes))
      {
        double expected[3], actual[3];
        colors->GetTable(x, x, 1, expected);
        ofColors.Evaluate(x, actual);
        for (int c = 0; c < 3; ++c)
        {
          ASSERT_EQ(actual[c], expected[c]) << "space " << space << ", at " << x;
        }
        opacity->GetTable(x, x, 1, expected);
        ofOpacity.Evaluate(x, actual);
        ASSERT_EQ(actual[0], expected[0]) << "at " << x;
      }
    }
  }
}

} // namespace
