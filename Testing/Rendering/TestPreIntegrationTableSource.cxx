// SPDX-License-Identifier: BSD-3-Clause
// vtkPreIntegrationTable: what is in the image, and where.
#include "vtkPreIntegrationTable.h"

#include "Integral/RayIntegral.h"
#include "Preparation/TransferFunctionFromProperty.h"

#include "vtkColorTransferFunction.h"
#include "vtkCommand.h"
#include "vtkContourValues.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkVolumeProperty.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace
{

constexpr double UnitDistance = 0.5;

/// Keeps the last error's text instead of printing it.
class ErrorKeeper : public vtkCommand
{
public:
  static ErrorKeeper* New() { return new ErrorKeeper; }
  void Execute(vtkObject*, unsigned long, void* text) override
  {
    this->Text += static_cast<const char*>(text);
  }
  std::string Text;
};

class PreIntegrationTableSource : public testing::Test
{
protected:
  PreIntegrationTableSource()
  {
    this->Opacity->AddPoint(10, 0.1);
    this->Opacity->AddPoint(14, 0.9);
    this->Opacity->AddPoint(20, 0.3);
    this->Color->AddRGBPoint(10, 1, 0.2, 0);
    this->Color->AddRGBPoint(17, 0, 0.4, 1);
    this->Color->AddRGBPoint(20, 0.5, 0.6, 0.7);
    this->Property->SetColor(this->Color);
    this->Property->SetScalarOpacity(this->Opacity);
    this->Property->SetScalarOpacityUnitDistance(UnitDistance);
    this->Table->SetVolumeProperty(this->Property);
    this->Table->SetScalarSize(24);
    this->Table->SetLengthSize(20);
    this->Table->SetLongestSegment(2);
    this->Table->AddObserver(vtkCommand::ErrorEvent, this->Errors);
    this->Table->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Errors);
  }

  double GetField(const char* name, vtkIdType index = 0)
  {
    vtkDataArray* array = this->Table->GetOutput()->GetFieldData()->GetArray(name);
    EXPECT_TRUE(array) << name;
    return array ? array->GetVariantValue(index).ToDouble() : 0;
  }

  // Texels against the closed form; scale: of a component that stands for 1.
  void ExpectIntegral(double scale)
  {
    vtkImageData* image = this->Table->GetOutput();
    const tetralux::TransferFunction function =
      tetralux::TransferFunctionFromProperty(this->Property, 1e-5, 200).Function;
    int n[3];
    image->GetDimensions(n);
    const double rounding = this->GetField("ErrorBound", 2);
    for (int k = 0; k < n[2]; ++k)
    {
      for (int j = 0; j < n[1]; j += 3)
      {
        for (int i = 0; i < n[0]; i += 2)
        {
          const double sf = this->GetField("ScalarTexels", i);
          const double sb = this->GetField("ScalarTexels", j);
          const double length = this->GetField("LengthTexels", k);
          const tetralux::SegmentRadiance exact =
            tetralux::IntegrateEmissionAbsorption(function, sf, sb, length);
          for (int c = 0; c < 4; ++c)
          {
            EXPECT_NEAR(image->GetScalarComponentAsDouble(i, j, k, c) / scale,
              c < 3 ? exact.Color[c] : exact.Opacity, rounding);
          }
        }
      }
    }
  }

  vtkNew<vtkPiecewiseFunction> Opacity;
  vtkNew<vtkColorTransferFunction> Color;
  vtkNew<vtkVolumeProperty> Property;
  vtkNew<vtkPreIntegrationTable> Table;
  vtkNew<ErrorKeeper> Errors;
};

TEST_F(PreIntegrationTableSource, TexelsAreTheIntegralInEveryFormat)
{
  const int types[] = { VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT, VTK_FLOAT, VTK_FLOAT };
  const double scales[] = { 255, 65535, 1, 1 };
  for (int format = 1; format <= 4; ++format)
  {
    this->Table->SetFormat(format);
    this->Table->Update();
    vtkImageData* image = this->Table->GetOutput();
    EXPECT_EQ(image->GetScalarType(), types[format - 1]);
    EXPECT_EQ(image->GetNumberOfScalarComponents(), 4);
    EXPECT_STREQ(image->GetPointData()->GetScalars()->GetName(), "RGBA");
    this->ExpectIntegral(scales[format - 1]);
  }
}

TEST_F(PreIntegrationTableSource, AxesAreInTheImage)
{
  this->Table->Update();
  vtkImageData* image = this->Table->GetOutput();
  double bounds[6];
  image->GetBounds(bounds);
  // The range is that of the nodes.
  const double expected[6] = { 10, 20, 10, 20, 0, 2 };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], expected[i], 1e-12);
  }
  EXPECT_NEAR(this->GetField("DeltaLength"), 2. / 19, 1e-15);
  EXPECT_EQ(this->GetField("StepsPerDoubling"), 0);
  EXPECT_EQ(this->GetField("FunctionError"), 0);

  this->Table->SetScalarRange(5, 25);
  this->Table->SetScalarAxis(2);
  this->Table->SetLengthScale(2);
  this->Table->SetStepsPerDoubling(2);
  this->Table->Update();
  int n[3];
  image->GetDimensions(n);
  EXPECT_EQ(n[0], 24);
  EXPECT_EQ(n[2], 20);
  EXPECT_EQ(image->GetSpacing()[0], 1);
  EXPECT_EQ(image->GetSpacing()[2], 1);
  EXPECT_EQ(this->GetField("StepsPerDoubling"), 2);
  EXPECT_EQ(this->GetField("ScalarTexels", 0), 5);
  EXPECT_EQ(this->GetField("ScalarTexels", 23), 25);
  EXPECT_NEAR(this->GetField("LengthTexels", 19), 2, 1e-14);
  this->ExpectIntegral(1);
}

TEST_F(PreIntegrationTableSource, ErrorsAreInTheImage)
{
  this->Table->Update();
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_GT(this->GetField("ErrorEstimate", k), 0);
    EXPECT_GE(this->GetField("ErrorBound", k), this->GetField("ErrorEstimate", k));
  }
  const double coarse = this->GetField("ErrorEstimate");
  this->Table->SetScalarSize(96);
  this->Table->SetLengthSize(80);
  this->Table->Update();
  EXPECT_LT(this->GetField("ErrorEstimate"), 0.7 * coarse);
}

TEST_F(PreIntegrationTableSource, FollowsTheProperty)
{
  this->Table->Update();
  vtkImageData* image = this->Table->GetOutput();
  const double before = image->GetScalarComponentAsDouble(9, 9, 19, 3);
  const vtkMTimeType time = image->GetMTime();
  this->Table->Update();
  EXPECT_EQ(image->GetMTime(), time);
  this->Opacity->AddPoint(14, 0.2);
  this->Table->Update();
  EXPECT_LT(image->GetScalarComponentAsDouble(9, 9, 19, 3), before);
  this->ExpectIntegral(1);
}

TEST_F(PreIntegrationTableSource, OtherModelsNeedFewerDimensions)
{
  const tetralux::TransferFunction function =
    tetralux::TransferFunctionFromProperty(this->Property, 1e-5, 200).Function;
  const auto at = [this](int i, int j, int c)
  { return this->Table->GetOutput()->GetScalarComponentAsDouble(i, j, 0, c); };
  const auto scalar = [](int i) { return 10 + 10. * i / 23; };
  for (const int model :
    { vtkPreIntegrationTable::EMISSION_ONLY, vtkPreIntegrationTable::ABSORPTION_ONLY })
  {
    this->Table->SetOpticalModel(model);
    this->Table->Update();
    EXPECT_EQ(this->Table->GetOutput()->GetDataDimension(), 2);
    const auto emission = tetralux::IntegrateEmissionOnly(function, scalar(3), scalar(20), 1.5);
    const auto smoke = tetralux::IntegrateAbsorptionOnly(function, scalar(3), scalar(20), 1.5);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(1.5 * at(3, 20, c), emission.Color[c], 1e-6);
    }
    EXPECT_NEAR(1 - std::exp(-1.5 * at(3, 20, 3)), smoke.Opacity, 1e-6);
  }

  this->Table->SetOpticalModel(vtkPreIntegrationTable::MAXIMUM_INTENSITY);
  this->Table->Update();
  EXPECT_EQ(this->Table->GetOutput()->GetDataDimension(), 1);
  EXPECT_NEAR(at(23, 0, 3), 0.3, 1e-6); // opacity itself, not for each unit distance
  EXPECT_NEAR(at(23, 0, 0), 0.15, 1e-6);

  this->Property->GetIsoSurfaceValues()->SetValue(0, 15);
  this->Property->GetIsoSurfaceValues()->SetValue(1, 12);
  this->Table->SetOpticalModel(vtkPreIntegrationTable::ISOSURFACES);
  this->Table->Update();
  EXPECT_EQ(at(0, 2, 3), 0);
  EXPECT_NEAR(at(0, 6, 3), 0.5, 1e-6);                  // past 12
  EXPECT_NEAR(at(0, 23, 3), 1 - 0.5 * (1 - 0.8), 1e-6); // past 12 and 15
  EXPECT_NEAR(at(23, 0, 3), 1 - 0.5 * (1 - 0.8), 1e-6);
}

TEST_F(PreIntegrationTableSource, RefusesWhatItCannotDo)
{
  const auto expectError = [this](const std::string& word)
  {
    this->Errors->Text.clear();
    this->Table->Update();
    EXPECT_NE(this->Errors->Text.find(word), std::string::npos) << this->Errors->Text;
  };
  this->Table->SetScalarSize(1);
  expectError("scalar size");
  this->Table->SetScalarSize(24);
  this->Table->SetLongestSegment(-1);
  expectError("longest segment");
  this->Table->SetLongestSegment(2);
  this->Table->SetLengthScale(2);
  this->Table->SetStepsPerDoubling(3);
  expectError("power of 2");
  this->Table->SetLengthScale(1);
  this->Property->SetScalarOpacityUnitDistance(0);
  expectError("UnitDistance");
  this->Property->SetScalarOpacityUnitDistance(1);
  this->Color->AddRGBPoint(12, 3, 0, 0);
  this->Table->SetFormat(1);
  expectError("colour");
  this->Table->SetVolumeProperty(nullptr);
  expectError("VolumeProperty");
  EXPECT_EQ(this->Table->GetOutput()->GetNumberOfPoints(), 0);
}

} // namespace
