// SPDX-License-Identifier: BSD-3-Clause
// A property's functions become nodes that agree with VTK's own evaluation at any scalar.
#include "Preparation/TransferFunctionFromProperty.h"

#include "Optics/IntervalTable.h"

#include "vtkColorTransferFunction.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkVolumeProperty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

constexpr double MaximumError = 1e-5;
constexpr double LongestPath = 8;
constexpr double UnitDistance = 0.5;

/// Shares of MaximumError that colours and opacities may be off by, see Tolerance in
/// TransferFunctionFromProperty.cxx.
constexpr double ShareOfColors = 3. / 4;
constexpr double ShareOfOpacities = 1. / 4;

/// More than that, as a share: nodes are placed by an interval's values at some places only.
constexpr double BetweenPlaces = 1.05;

/// Limits at steps are taken at a distance of 1e-9 of the intervals, from slopes up to 3.
constexpr double LimitRounding = 3e-9;

class TransferFunctionFromProperty : public testing::Test
{
protected:
  TransferFunctionFromProperty()
  {
    this->Opacity->AddPoint(-3, 0.2);
    this->Opacity->AddPoint(7, 0.8);
    this->Color->AddRGBPoint(0.3, 0.9, 0.1, 0.2);
    this->Color->AddRGBPoint(1.7, 0.1, 0.3, 0.8);
    this->Color->AddRGBPoint(4, 0.2, 0.9, 0.4);
    this->Property->SetColor(this->Color);
    this->Property->SetScalarOpacity(this->Opacity);
    this->Property->SetScalarOpacityUnitDistance(UnitDistance);
  }

  // Gives node i of the colours a midpoint and a sharpness.
  void Shape(int i, double midpoint, double sharpness)
  {
    double node[6];
    this->Color->GetNodeValue(i, node);
    node[4] = midpoint;
    node[5] = sharpness;
    this->Color->SetNodeValue(i, node);
  }

  // Compares with VTK at random scalars around all nodes; returns the number of nodes.
  std::size_t ExpectAgreement(bool exact, double smallestScalar = -5)
  {
    const tetralux::PropertyTransferFunction result =
      tetralux::TransferFunctionFromProperty(this->Property, MaximumError, LongestPath);
    EXPECT_EQ(result.Error, exact ? 0 : MaximumError);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> scalars(smallestScalar, 9);
    double largestColorError = 0;
    double largestOpacityError = 0;
    for (int i = 0; i < 20000; ++i)
    {
      const double s = scalars(random);
      const tetralux::TransferFunction::Value value = tetralux::Evaluate(result.Function, s);
      double color[3];
      if (this->Property->GetColorChannels() == 3)
      {
        this->Color->GetColor(s, color);
      }
      else
      {
        color[0] = color[1] = color[2] = this->Property->GetGrayTransferFunction()->GetValue(s);
      }
      for (int c = 0; c < 3; ++c)
      {
        largestColorError = std::max(largestColorError, std::abs(value.Color[c] - color[c]));
      }
      const double opacity = std::max(0., this->Opacity->GetValue(s));
      const double ofOpacity = exact ? 0 : ShareOfOpacities * MaximumError * opacity;
      largestOpacityError = std::max(
        largestOpacityError, std::abs(value.Attenuation * UnitDistance - opacity) - ofOpacity);
    }
    EXPECT_LE(
      largestColorError, exact ? LimitRounding : BetweenPlaces * ShareOfColors * MaximumError);
    EXPECT_LE(largestOpacityError,
      exact ? LimitRounding : ShareOfOpacities / 2 * MaximumError * UnitDistance / LongestPath);
    return result.Function.Nodes.size();
  }

  vtkNew<vtkPiecewiseFunction> Opacity;
  vtkNew<vtkColorTransferFunction> Color;
  vtkNew<vtkVolumeProperty> Property;
};

TEST_F(TransferFunctionFromProperty, LinearFunctionsKeepTheirNodes)
{
  EXPECT_EQ(this->ExpectAgreement(true), 5u);
  const tetralux::TransferFunction function =
    tetralux::TransferFunctionFromProperty(this->Property, MaximumError, LongestPath).Function;
  const double scalars[] = { -3, 0.3, 1.7, 4, 7 };
  for (int i = 0; i < 5; ++i)
  {
    EXPECT_EQ(function.Nodes[i].Scalar, scalars[i]);
  }
  EXPECT_EQ(function.Nodes[1].Left.Color[0], 0.9);
  EXPECT_EQ(function.Nodes[1].Right.Color[0], 0.9);
  EXPECT_EQ(function.Nodes[4].Left.Attenuation, 1.6);
}

TEST_F(TransferFunctionFromProperty, ZeroStaysZero)
{
  this->Opacity->RemoveAllPoints();
  this->Opacity->AddPoint(0, 0);
  this->Opacity->AddPoint(1, 0);
  this->Opacity->AddPoint(2, 1);
  const tetralux::TransferFunction function =
    tetralux::TransferFunctionFromProperty(this->Property, MaximumError, LongestPath).Function;
  for (const tetralux::TransferFunction::Node& node : function.Nodes)
  {
    EXPECT_EQ(node.Left.Attenuation == 0, node.Scalar <= 1);
    EXPECT_EQ(node.Right.Attenuation == 0, node.Scalar <= 1);
  }
}

TEST_F(TransferFunctionFromProperty, ColorSpaces)
{
  this->Color->SetColorSpaceToHSV();
  this->Color->HSVWrapOn();
  EXPECT_GT(this->ExpectAgreement(false), 20u);
  this->Color->HSVWrapOff();
  this->ExpectAgreement(false);
  this->Color->SetColorSpaceToLab();
  this->ExpectAgreement(false);
  this->Color->SetColorSpaceToDiverging();
  this->ExpectAgreement(false);
  this->Color->SetColorSpaceToStep();
  EXPECT_LE(this->ExpectAgreement(true), 8u);
}

/// Colours of many nodes, between which they are interpolated in a colour space.
void SetManyNodes(vtkColorTransferFunction* colors, int nodes, bool smooth)
{
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> data;
  for (int k = 0; k < nodes; ++k)
  {
    const double t = static_cast<double>(k) / (nodes - 1);
    data.push_back(-4 + 11 * t);
    for (int c = 0; c < 3; ++c)
    {
      data.push_back(smooth ? 0.5 + 0.4 * std::sin(4 * t + c) : unit(random));
    }
  }
  colors->FillFromDataPointer(nodes, data.data());
}

constexpr int ColorSpaces[] = { VTK_CTF_RGB, VTK_CTF_HSV, VTK_CTF_LAB, VTK_CTF_DIVERGING };

// Several blocks of intervals, and all kinks that random colours make.
TEST_F(TransferFunctionFromProperty, ManyNodes)
{
  constexpr int Nodes = 400;
  for (const int space : ColorSpaces)
  {
    SCOPED_TRACE(space);
    this->Color->SetColorSpace(space);
    SetManyNodes(this->Color, Nodes, false);
    const bool isLinear = space == VTK_CTF_RGB;
    const std::size_t nodes = this->ExpectAgreement(isLinear);
    EXPECT_EQ(nodes == Nodes + 1, isLinear) << "and the first one of the opacity";
    // Lines along curves whose second derivatives are about 5 for a step of colours.
    constexpr double Bend = 5;
    const double lines = std::sqrt(Bend / (8 * ShareOfColors * MaximumError));
    EXPECT_LE(nodes, 1.5 * lines * Nodes);
    const tetralux::TransferFunction function =
      tetralux::TransferFunctionFromProperty(this->Property, MaximumError, LongestPath).Function;
    EXPECT_FALSE(tetralux::HasNegativeColors(function));
    EXPECT_LE(tetralux::GetLargestColor(function), 1 + MaximumError);
  }
}

// Where nodes are dense, curves between them are lines.
TEST_F(TransferFunctionFromProperty, DenseNodesAreAlmostAll)
{
  constexpr int Nodes = 2000;
  for (const int space : ColorSpaces)
  {
    SCOPED_TRACE(space);
    this->Color->SetColorSpace(space);
    SetManyNodes(this->Color, Nodes, true);
    const tetralux::TransferFunction function =
      tetralux::TransferFunctionFromProperty(this->Property, MaximumError, LongestPath).Function;
    EXPECT_LE(function.Nodes.size(), 1.3 * Nodes) << "some have kinks in between";
  }
}

// What is wrong in any block is said, of the first one.
TEST_F(TransferFunctionFromProperty, ManyNodesOfWhichSomeAreWrong)
{
  SetManyNodes(this->Color, 400, true);
  double node[6];
  for (const int k : { 350, 250 })
  {
    this->Color->GetNodeValue(k, node);
    node[2] = std::numeric_limits<double>::infinity();
    this->Color->SetNodeValue(k, node);
  }
  try
  {
    tetralux::TransferFunctionFromProperty(this->Property, MaximumError, LongestPath);
    FAIL() << "nothing is thrown";
  }
  catch (const std::invalid_argument& error)
  {
    this->Color->GetNodeValue(250, node);
    const std::string scalar = "at scalar " + std::to_string(node[0]);
    EXPECT_NE(std::string(error.what()).find(scalar), std::string::npos) << error.what();
  }
}

// Too slow for as many comparisons.
TEST_F(TransferFunctionFromProperty, SearchedColorSpace)
{
  this->Color->SetColorSpaceToLabCIEDE2000();
  const tetralux::TransferFunction function =
    tetralux::TransferFunctionFromProperty(this->Property, MaximumError, LongestPath).Function;
  for (const double s : { -1., 0.77, 1.23456, 1.6, 2.5, 3.21, 5. })
  {
    double color[3];
    this->Color->GetColor(s, color);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(tetralux::Evaluate(function, s).Color[c], color[c], 1e-3);
    }
  }
}

TEST_F(TransferFunctionFromProperty, LogarithmicColors)
{
  this->Color->SetScaleToLog10();
  this->ExpectAgreement(false, 1e-3); // VTK has no colour where there is no logarithm
  this->Shape(1, 0.2, 1);             // a step, on the logarithmic scale
  this->ExpectAgreement(false, 1e-3);
  const tetralux::TransferFunction function =
    tetralux::TransferFunctionFromProperty(this->Property, MaximumError, LongestPath).Function;
  EXPECT_EQ(tetralux::Evaluate(function, -4).Color[0], 0.9);
}

TEST_F(TransferFunctionFromProperty, LogarithmicOpacity)
{
  this->Opacity->RemoveAllPoints();
  this->Opacity->AddPoint(0.01, 0.05);
  this->Opacity->AddPoint(7, 0.8);
  this->Opacity->UseLogScaleOn();
  this->ExpectAgreement(false);
}

TEST_F(TransferFunctionFromProperty, MidpointsAndSharpness)
{
  this->Shape(0, 0.3, 0); // a kink
  EXPECT_EQ(this->ExpectAgreement(true), 6u);
  this->Shape(1, 0.6, 1); // a step
  EXPECT_EQ(this->ExpectAgreement(true), 7u);
  this->Shape(1, 0.6, 0.4); // a curve
  this->ExpectAgreement(false);

  this->Opacity->AddPoint(1, 0.4, 0.2, 0);
  this->Opacity->AddPoint(3, 0, 0.7, 0.5);
  this->Opacity->AddPoint(5, 0.5, 0.5, 1);
  this->ExpectAgreement(false);
}

TEST_F(TransferFunctionFromProperty, StepsAtDuplicatedScalars)
{
  this->Color->AllowDuplicateScalarsOn();
  this->Opacity->AllowDuplicateScalarsOn();
  this->Color->AddRGBPoint(1.7, 1, 1, 0);
  this->Opacity->AddPoint(2, 0.9);
  this->Opacity->AddPoint(2, 0.1);
  EXPECT_EQ(this->ExpectAgreement(true), 6u);
}

TEST_F(TransferFunctionFromProperty, OutsideOfTheRange)
{
  this->Color->ClampingOff();
  EXPECT_EQ(this->ExpectAgreement(true), 5u);
  this->Color->ClampingOn();
  this->Color->UseBelowRangeColorOn();
  this->Color->SetBelowRangeColor(1, 0.5, 0.25);
  this->Color->UseAboveRangeColorOn();
  this->Color->SetAboveRangeColor(0.25, 0.5, 1);
  this->ExpectAgreement(true);
  this->Opacity->ClampingOff();
  this->ExpectAgreement(true);

  const tetralux::TransferFunction function =
    tetralux::TransferFunctionFromProperty(this->Property, MaximumError, LongestPath).Function;
  EXPECT_EQ(function.Nodes.front().Left.Attenuation, 0);
  EXPECT_EQ(function.Nodes.back().Right.Attenuation, 0);
}

/// Curves through a few values leave 0..1 by as little as they are off, which tables of integers
/// can't hold, and which would be negative light.
TEST_F(TransferFunctionFromProperty, ColorsStayInZeroToOne)
{
  constexpr int Corners = 8; // of the cube of colours
  const auto add = [this](double x, int corner)
  { this->Color->AddRGBPoint(x, corner & 1, corner >> 1 & 1, corner >> 2 & 1); };
  for (const int space : { VTK_CTF_LAB, VTK_CTF_DIVERGING })
  {
    this->Color->SetColorSpace(space);
    for (int pair = 0; pair < Corners * Corners; ++pair)
    {
      this->Color->RemoveAllPoints();
      add(0, pair % Corners);
      add(1, pair / Corners);
      for (const double error : { 1e-3, 2.5e-4, 1e-4 })
      {
        const tetralux::TransferFunction function =
          tetralux::TransferFunctionFromProperty(this->Property, error, LongestPath).Function;
        for (const tetralux::TransferFunction::Node& node : function.Nodes)
        {
          for (const double color : node.Left.Color)
          {
            ASSERT_TRUE(0 <= color && color <= 1) << space << ", " << pair << ": " << color;
          }
        }
      }
    }
  }
}

TEST_F(TransferFunctionFromProperty, Grey)
{
  vtkNew<vtkPiecewiseFunction> grey;
  grey->AddPoint(-1, 0.2);
  grey->AddPoint(2, 0.9, 0.3, 0.3);
  grey->AddPoint(3, 0.1);
  this->Property->SetColor(grey);
  this->ExpectAgreement(false);
}

TEST_F(TransferFunctionFromProperty, NegativeOpacityIsNone)
{
  this->Opacity->AddPoint(0, -0.5);
  this->ExpectAgreement(false);
}

TEST_F(TransferFunctionFromProperty, FunctionsWithoutNodesAreBlack)
{
  this->Color->RemoveAllPoints();
  this->Opacity->RemoveAllPoints();
  EXPECT_EQ(this->ExpectAgreement(true), 1u);
}

TEST_F(TransferFunctionFromProperty, LargeScalars)
{
  this->Color->RemoveAllPoints();
  this->Opacity->RemoveAllPoints();
  this->Color->AddRGBPoint(1e12, 1, 0, 0);
  this->Color->AddRGBPoint(1e12 + 1, 0, 0, 1);
  this->Opacity->AddPoint(1e12 + 0.5, 0);
  this->Opacity->AddPoint(1e12 + 2, 1);
  const tetralux::PropertyTransferFunction result =
    tetralux::TransferFunctionFromProperty(this->Property, MaximumError, LongestPath);
  EXPECT_EQ(result.Error, 0);
  ASSERT_EQ(result.Function.Nodes.size(), 4u);
  EXPECT_NEAR(result.Function.Nodes[1].Left.Color[0], 0.5, 1e-12);
}

// Below what single precision holds, in shaders too.
TEST_F(TransferFunctionFromProperty, OpticalDepthsAreBounded)
{
  this->Opacity->AddPoint(7, 1e300);
  for (const double unitDistance : { UnitDistance, 1e-300 })
  {
    this->Property->SetScalarOpacityUnitDistance(unitDistance);
    const tetralux::PropertyTransferFunction result =
      tetralux::TransferFunctionFromProperty(this->Property, MaximumError, LongestPath);
    EXPECT_EQ(result.Function.Nodes.back().Left.Attenuation, 1e15 / LongestPath) << unitDistance;
  }
}

// Rounding of large colours is no curve.
TEST_F(TransferFunctionFromProperty, LargeColorsKeepTheirNodes)
{
  this->Color->RemoveAllPoints();
  this->Color->AddRGBPoint(0, 0.3, 0.7e20, 0.1);
  this->Color->AddRGBPoint(1. / 3, 0.9e20, 0.1e20, 0.3);
  this->Color->AddRGBPoint(1, 0.7, 0.3e20, 1e20);
  const tetralux::PropertyTransferFunction result =
    tetralux::TransferFunctionFromProperty(this->Property, MaximumError, LongestPath);
  EXPECT_EQ(result.Function.Nodes.size(), 5u);
  this->Color->AddRGBPoint(1, 0.7, 0.3e20, 1.1e20);
  EXPECT_THROW(tetralux::TransferFunctionFromProperty(this->Property, MaximumError, LongestPath),
    std::invalid_argument);
}

TEST_F(TransferFunctionFromProperty, RefusesWhatMakesNoSense)
{
  for (const double distance : { 0., -1., std::numeric_limits<double>::quiet_NaN() })
  {
    this->Property->SetScalarOpacityUnitDistance(distance);
    EXPECT_THROW(tetralux::TransferFunctionFromProperty(this->Property, MaximumError, LongestPath),
      std::invalid_argument);
  }
  this->Property->SetScalarOpacityUnitDistance(1);
  this->Opacity->AddPoint(2, std::numeric_limits<double>::infinity());
  EXPECT_THROW(tetralux::TransferFunctionFromProperty(this->Property, MaximumError, LongestPath),
    std::invalid_argument);
}

} // namespace
