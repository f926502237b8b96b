// SPDX-License-Identifier: BSD-3-Clause

// The property table against the classes that it describes.

#include "MapperPropertyAccess.h"
#include "Observer.h"

#include "vtkMeshedPolyhedraVisibilitySort.h"
#include "vtkNew.h"
#include "vtkPreIntegrationTableSource.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkTetrahedraRayIntegrator.h"
#include "vtkTriangleCasterMapper.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

using tetralux::MapperProperty;
using tetralux::NamedValue;
using tetralux::PropertyType;
using Mapper = vtkTetrahedraVolumeMapper;
using AnyMapper = vtkAbstractVolumeMapper;

namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

/// Collects what an object complains about.
class Errors
{
public:
  explicit Errors(vtkObject* object)
    : Sink(
        object, vtkCommand::ErrorEvent, [this](const char* text) { this->Texts.push_back(text); })
  {
  }

  std::vector<std::string> Texts;

private:
  Observer Sink;
};

/// The text behind "name: " on a line of its own, at the first indent.
std::string FindPrinted(vtkObject* object, const std::string& name)
{
  std::ostringstream all;
  object->Print(all);
  std::istringstream lines(all.str());
  const std::string start = "  " + name + ": ";
  for (std::string line; std::getline(lines, line);)
  {
    if (line.rfind(start, 0) == 0)
    {
      return line.substr(start.size());
    }
  }
  return "(not printed)";
}

class MapperProperties : public testing::Test
{
protected:
  /// Calls a function with each mapper and each property that it has.
  template <class FunctionT>
  void ForEach(const FunctionT& function)
  {
    for (AnyMapper* mapper : std::initializer_list<AnyMapper*>{
           this->RayCast, this->GPURayCast, this->Projection, this->Isosurface, this->Caster })
    {
      for (const MapperProperty& property : tetralux::GetMapperProperties())
      {
        if ((property.Kinds & tetralux::GetKind(mapper)) != 0)
        {
          SCOPED_TRACE(std::string(mapper->GetClassName()) + " " + property.Name);
          function(mapper, property);
        }
      }
    }
  }

  vtkNew<vtkTetrahedraRayCastMapper> RayCast;
  vtkNew<vtkTetrahedraGPURayCastMapper> GPURayCast;
  vtkNew<vtkTetrahedraProjectionMapper> Projection;
  vtkNew<vtkTetrahedraIsosurfaceMapper> Isosurface;
  vtkNew<vtkTriangleCasterMapper> Caster;
};

/// A value other than the default, if the mapper honours another one.
std::vector<double> ChooseOther(const MapperProperty& property, unsigned kind)
{
  if (property.Default.size() > 1)
  {
    std::vector<double> values = { -1, 2.5, 3, 4, 5, 6 };
    values.resize(property.Default.size());
    return values;
  }
  const double value = property.Default.front();
  if (property.Type == PropertyType::Enumeration)
  {
    return { static_cast<double>(GetNamedValues(property, kind).back().Number) };
  }
  return { property.Type == PropertyType::Boolean ? 1 - value
      : property.Type == PropertyType::Real       ? (value + property.Maximum) / 2
                                                  : property.Minimum + 2 };
}

} // namespace

TEST_F(MapperProperties, KindsAreThoseOfTheClasses)
{
  EXPECT_EQ(tetralux::GetKind(this->RayCast), tetralux::RayCastKind);
  EXPECT_EQ(tetralux::GetKind(this->GPURayCast), tetralux::GPURayCastKind);
  EXPECT_EQ(tetralux::GetKind(this->Projection), tetralux::ProjectionKind);
  EXPECT_EQ(tetralux::GetKind(this->Isosurface), tetralux::IsosurfaceKind);
  EXPECT_EQ(tetralux::GetKind(this->Caster), tetralux::TriangleCasterKind);
  EXPECT_EQ(tetralux::VolumeKinds | tetralux::IsosurfaceKind, tetralux::CellKinds);
  EXPECT_EQ(tetralux::CellKinds | tetralux::TriangleCasterKind, tetralux::AllKinds);
  EXPECT_EQ(tetralux::RayCastKind | tetralux::IsosurfaceKind | tetralux::TriangleCasterKind,
    tetralux::ProcessorKinds);
}

TEST_F(MapperProperties, DefaultsAreThoseOfTheClasses)
{
  this->ForEach([](AnyMapper* mapper, const MapperProperty& property)
    { EXPECT_EQ(GetPropertyValues(mapper, property), property.Default); });
}

TEST_F(MapperProperties, NumbersAreClampedToTheRange)
{
  this->ForEach(
    [](AnyMapper* mapper, const MapperProperty& property)
    {
      if (property.Type == PropertyType::Enumeration || property.Type == PropertyType::Boolean ||
        property.Default.size() > 1)
      {
        return;
      }
      const auto set = [&](double value)
      {
        SetPropertyValues(mapper, property, { value });
        return GetPropertyValues(mapper, property).front();
      };
      const bool real = property.Type == PropertyType::Real;
      const double step = real ? 0.01 : 1;
      EXPECT_FLOAT_EQ(set(property.Minimum), property.Minimum);
      EXPECT_FLOAT_EQ(set(property.Minimum - 3 * step), property.Minimum);
      EXPECT_FLOAT_EQ(set(property.Minimum + step), property.Minimum + step);
      EXPECT_FLOAT_EQ(set(property.Maximum), property.Maximum);
      if (property.Maximum < std::numeric_limits<int>::max() ||
        property.Type != PropertyType::Integer)
      {
        EXPECT_FLOAT_EQ(set(property.Maximum + step), property.Maximum);
      }
      for (const NamedValue& value : property.Values)
      {
        EXPECT_EQ(set(value.Number), value.Number);
      }
    });
}

TEST_F(MapperProperties, EnumerationsTakeTheNamedValuesAlone)
{
  constexpr int Beyond = 20; // of all numbers of all enumerations
  this->ForEach(
    [](AnyMapper* mapper, const MapperProperty& property)
    {
      if (property.Type != PropertyType::Enumeration)
      {
        return;
      }
      std::set<int> accepted;
      for (const NamedValue& value : GetNamedValues(property, tetralux::GetKind(mapper)))
      {
        accepted.insert(value.Number);
      }
      for (int number = -Beyond; number <= Beyond; ++number)
      {
        const std::vector<double> before = GetPropertyValues(mapper, property);
        const vtkMTimeType time = mapper->GetMTime();
        Errors errors(mapper);
        SetPropertyValues(mapper, property, { static_cast<double>(number) });
        if (accepted.count(number) > 0)
        {
          EXPECT_EQ(GetPropertyValues(mapper, property).front(), number);
          EXPECT_TRUE(errors.Texts.empty());
          continue;
        }
        EXPECT_EQ(GetPropertyValues(mapper, property), before) << number;
        EXPECT_EQ(mapper->GetMTime(), time);
        ASSERT_EQ(errors.Texts.size(), 1u) << number;
        for (const NamedValue& value : GetNamedValues(property, tetralux::GetKind(mapper)))
        {
          EXPECT_NE(errors.Texts[0].find(value.Name), std::string::npos) << errors.Texts[0];
        }
      }
    });
}

TEST_F(MapperProperties, NotANumberIsRefused)
{
  this->ForEach(
    [](AnyMapper* mapper, const MapperProperty& property)
    {
      if (property.Type != PropertyType::Real)
      {
        return;
      }
      std::vector<double> values = property.Default;
      values.back() = NaN;
      Errors errors(mapper);
      SetPropertyValues(mapper, property, values);
      EXPECT_EQ(GetPropertyValues(mapper, property), property.Default);
      ASSERT_EQ(errors.Texts.size(), 1u);
      EXPECT_NE(errors.Texts[0].find(property.Name), std::string::npos) << errors.Texts[0];
    });
}

TEST_F(MapperProperties, ModifyTheMapperOnceWhereTheyChange)
{
  this->ForEach(
    [](AnyMapper* mapper, const MapperProperty& property)
    {
      const vtkMTimeType time = mapper->GetMTime();
      SetPropertyValues(mapper, property, property.Default);
      EXPECT_EQ(mapper->GetMTime(), time);
      const std::vector<double> other = ChooseOther(property, tetralux::GetKind(mapper));
      SetPropertyValues(mapper, property, other);
      EXPECT_EQ(mapper->GetMTime() > time, other != property.Default);
    });
}

TEST_F(MapperProperties, ArePrinted)
{
  this->ForEach(
    [](AnyMapper* mapper, const MapperProperty& property)
    {
      EXPECT_EQ(FindPrinted(mapper, property.Name), FormatValues(property, property.Default));
      const std::vector<double> other = ChooseOther(property, tetralux::GetKind(mapper));
      SetPropertyValues(mapper, property, other);
      EXPECT_EQ(FindPrinted(mapper, property.Name), FormatValues(property, other));
    });
}

// Numbers in enumerations would pass the test above if the table printed them as numbers.
TEST_F(MapperProperties, ArePrintedAsAReaderWritesThem)
{
  this->RayCast->SetPrecisionToDouble();
  this->RayCast->SetReentryToImaginaryCells();
  this->RayCast->SetBlendModeToMaximumIntensity();
  this->RayCast->SetNumberOfThreads(3);
  this->RayCast->SetImageSampleDistance(0.3F);
  this->RayCast->SmoothShadingOff();
  this->RayCast->SetCroppingRegionPlanes(-1, 2.5, 0, 1, 0, 1e-7);
  EXPECT_EQ(FindPrinted(this->RayCast, "Precision"), "double");
  EXPECT_EQ(FindPrinted(this->RayCast, "Reentry"), "imaginary-cells");
  EXPECT_EQ(FindPrinted(this->RayCast, "BlendMode"), "maximum-intensity");
  EXPECT_EQ(FindPrinted(this->RayCast, "NumberOfThreads"), "3");
  EXPECT_EQ(FindPrinted(this->RayCast, "ImageSampleDistance"), "0.3");
  EXPECT_EQ(FindPrinted(this->RayCast, "SmoothShading"), "Off");
  EXPECT_EQ(FindPrinted(this->RayCast, "CroppingRegionPlanes"), "-1, 2.5, 0, 1, 0, 1e-07");
  EXPECT_EQ(FindPrinted(this->RayCast, "TableMaximumBytes"), "67108864");
  EXPECT_EQ(FindPrinted(this->RayCast, "ErrorEstimate"), "0");
  EXPECT_EQ(FindPrinted(this->Projection, "UsedOrder"), "none");
  EXPECT_EQ(FindPrinted(this->Projection, "Reentry"), "(not printed)");
  this->Isosurface->SetColorArrayName("Temperature");
  this->Isosurface->SetColorArrayComponent(2);
  this->Isosurface->SetShadowSoftness(2.5);
  EXPECT_EQ(FindPrinted(this->Isosurface, "ColorArrayName"), "Temperature");
  EXPECT_EQ(FindPrinted(this->Isosurface, "ColorArrayComponent"), "2");
  EXPECT_EQ(FindPrinted(this->Isosurface, "ShadowSoftness"), "2.5");
  EXPECT_EQ(FindPrinted(this->Isosurface, "TimeStepCacheBytes"), "268435456");
  EXPECT_EQ(FindPrinted(this->Isosurface, "AmbientOcclusionRadius"), "automatic");
  this->Isosurface->SetColorArrayName(nullptr);
  EXPECT_EQ(FindPrinted(this->Isosurface, "ColorArrayName"), "(none)");
  this->Caster->SetSliceShapeToShells();
  this->Caster->SetCroppingRegionPlanes(-1, 2.5, 0, 1, 0, 1e-7);
  EXPECT_EQ(FindPrinted(this->Caster, "SliceShape"), "shells");
  EXPECT_EQ(FindPrinted(this->Caster, "OpacityModel"), "power");
  EXPECT_EQ(FindPrinted(this->Caster, "SampleDistance"), "automatic");
  EXPECT_EQ(FindPrinted(this->Caster, "CroppingRegionPlanes"), "-1, 2.5, 0, 1, 0, 1e-07");
  EXPECT_EQ(FindPrinted(this->Caster, "ErrorEstimate"), "0");

  // Statistics are last, and indented.
  std::ostringstream text;
  this->GPURayCast->Print(text);
  EXPECT_NE(text.str().find("  SupportReason: "), std::string::npos);
  const std::string last = "  Statistics:\n    {}\n";
  ASSERT_GT(text.str().size(), last.size());
  EXPECT_NE(text.str().find(last), std::string::npos) << text.str();
  EXPECT_GT(text.str().find(last), text.str().find("SupportReason"));
}

// What the table says of a number is what the class means by it.
TEST_F(MapperProperties, NamesAreThoseOfTheEnumerators)
{
  using Sort = vtkMeshedPolyhedraVisibilitySort;
  using RayCastMapper = vtkTetrahedraRayCastMapper;
  using ProjectionMapper = vtkTetrahedraProjectionMapper;
  const auto expect =
    [](const char* property, const std::vector<std::pair<int, std::string>>& values)
  {
    EXPECT_EQ(tetralux::GetMapperProperty(property).Values.size(), values.size()) << property;
    for (const auto& [number, name] : values)
    {
      EXPECT_EQ(tetralux::GetValueName(property, number), name) << property;
    }
  };
  expect("BlendMode",
    { { Mapper::COMPOSITE_BLEND, "composite" },
      { Mapper::MAXIMUM_INTENSITY_BLEND, "maximum-intensity" },
      { vtkVolumeMapper::MINIMUM_INTENSITY_BLEND, "minimum-intensity" },
      { vtkVolumeMapper::AVERAGE_INTENSITY_BLEND, "average-intensity" },
      { Mapper::ADDITIVE_BLEND, "additive" }, { Mapper::ISOSURFACE_BLEND, "isosurface" },
      { vtkVolumeMapper::SLICE_BLEND, "slice" }, { Mapper::ABSORPTION_BLEND, "absorption" } });
  expect("Integration",
    { { Mapper::AUTOMATIC_INTEGRATION, "automatic" },
      { Mapper::CLOSED_FORM_INTEGRATION, "closed-form" }, { Mapper::TABLE_INTEGRATION, "table" } });
  expect("TableLengthScale",
    { { Mapper::AUTOMATIC_SCALE, "automatic" }, { Mapper::LINEAR_SCALE, "linear" },
      { Mapper::LOGARITHMIC_SCALE, "logarithmic" } });
  expect("TableScalarAxis",
    { { Mapper::AUTOMATIC_AXIS, "automatic" }, { Mapper::UNIFORM_AXIS, "uniform" },
      { Mapper::NODES_AXIS, "nodes" } });
  expect("TableFormat",
    { { Mapper::AUTOMATIC_FORMAT, "automatic" }, { Mapper::UNORM8_FORMAT, "unorm8" },
      { Mapper::UNORM16_FORMAT, "unorm16" }, { Mapper::HALF_FORMAT, "half" },
      { Mapper::FLOAT_FORMAT, "float" } });
  expect("VectorMode",
    { { Mapper::DISABLED_MODE, "disabled" }, { Mapper::MAGNITUDE_MODE, "magnitude" },
      { Mapper::COMPONENT_MODE, "component" } });
  expect("Reentry",
    { { Mapper::AUTOMATIC_REENTRY, "automatic" },
      { Mapper::BOUNDARY_HIERARCHY_REENTRY, "boundary-hierarchy" },
      { Mapper::IMAGINARY_CELLS_REENTRY, "imaginary-cells" },
      { Mapper::BOUNDARY_LAYERS_REENTRY, "boundary-layers" }, { Mapper::NO_REENTRY, "none" } });
  using Caster = vtkTriangleCasterMapper;
  expect("SliceShape", { { Caster::PLANE_SLICES, "planes" }, { Caster::SHELL_SLICES, "shells" } });
  expect("GradientNorm", { { Caster::EUCLIDEAN_NORM, "euclidean" }, { Caster::SUM_NORM, "sum" } });
  expect("GradientSource",
    { { Caster::ON_THE_FLY_GRADIENTS, "on-the-fly" }, { Caster::BYTE_GRADIENTS, "bytes" } });
  expect("LightSum",
    { { Caster::DIRECT_SUM, "direct" }, { Caster::NEAREST_ENTRY_SUM, "nearest-entry" },
      { Caster::INTERPOLATED_SUM, "interpolated" } });
  expect("OpacityModel",
    { { Caster::POWER_OPACITY, "power" }, { Caster::ATTENUATION_OPACITY, "attenuation" } });
  EXPECT_EQ(static_cast<int>(Caster::MAGNITUDE_MODE), static_cast<int>(Mapper::MAGNITUDE_MODE));
  EXPECT_EQ(static_cast<int>(Caster::COMPONENT_MODE), static_cast<int>(Mapper::COMPONENT_MODE));
  expect("Precision",
    { { RayCastMapper::AUTOMATIC_PRECISION, "automatic" },
      { RayCastMapper::SINGLE_PRECISION, "single" },
      { RayCastMapper::DOUBLE_PRECISION, "double" } });
  expect("ColorBuffer",
    { { ProjectionMapper::AUTOMATIC_BUFFER, "automatic" },
      { ProjectionMapper::FLOAT_BUFFER, "float" }, { ProjectionMapper::HALF_BUFFER, "half" },
      { ProjectionMapper::UNORM8_BUFFER, "unorm8" } });
  expect("Order",
    { { Sort::AUTOMATIC_ORDER, "automatic" }, { Sort::EXACT_ORDER, "exact" },
      { Sort::ACROSS_GAPS_ORDER, "across-gaps" }, { Sort::NON_CONVEX_ORDER, "non-convex" },
      { Sort::CENTROID_ORDER, "centroid" } });
}

TEST_F(MapperProperties, SayWhatAPanelNeeds)
{
  std::set<std::string> names;
  for (const MapperProperty& property : tetralux::GetMapperProperties())
  {
    SCOPED_TRACE(property.Name);
    EXPECT_TRUE(names.insert(property.Name).second);
    EXPECT_NE(std::string(property.Group), "");
    EXPECT_EQ(std::string(property.Meaning).back(), '.');
    EXPECT_EQ(property.Default.size() > 1, !std::string(property.Elements).empty());
    EXPECT_LT(property.Minimum, property.Maximum);
    EXPECT_TRUE(property.Type != PropertyType::Enumeration || property.Values.size() >= 2);
    for (const NamedValue& value : property.Values)
    {
      EXPECT_NE(std::string(value.Meaning), "") << value.Name;
      EXPECT_NE(value.Kinds & property.Kinds, 0u) << value.Name;
      EXPECT_EQ(FindNamedValue(property.Values, value.Name), &value);
    }
    if (std::string(property.Group) == "Pre-integration table")
    {
      EXPECT_TRUE(property.Advanced);
    }
  }
}

TEST_F(MapperProperties, NamesAreFoundInAnySpelling)
{
  const MapperProperty& integration = tetralux::GetMapperProperty("Integration");
  for (const char* name : { "closed-form", "CLOSED_FORM", "ClosedForm", "Closed-form" })
  {
    const NamedValue* value = FindNamedValue(integration.Values, name);
    ASSERT_NE(value, nullptr) << name;
    EXPECT_EQ(value->Number, Mapper::CLOSED_FORM_INTEGRATION);
  }
  EXPECT_EQ(FindNamedValue(integration.Values, "closed"), nullptr);
  EXPECT_EQ(tetralux::FindMapperProperty("Integrations"), nullptr);
}

// What a mapper can't do is refused when it is set, not in a frame.
TEST_F(MapperProperties, ReentryThatAMapperDoesNotHaveIsRefused)
{
  Errors errors(this->RayCast);
  this->RayCast->SetReentryToBoundaryLayers();
  EXPECT_EQ(this->RayCast->GetReentry(), Mapper::AUTOMATIC_REENTRY);
  ASSERT_EQ(errors.Texts.size(), 1u);
  EXPECT_NE(errors.Texts[0].find("Reentry: 3 is not automatic (0), boundary-hierarchy (1) or "
                                 "imaginary-cells (2)"),
    std::string::npos)
    << errors.Texts[0];

  Errors others(this->Projection);
  this->Projection->SetReentryToImaginaryCells();
  EXPECT_EQ(this->Projection->GetReentry(), Mapper::AUTOMATIC_REENTRY);
  ASSERT_EQ(others.Texts.size(), 1u);
  EXPECT_NE(others.Texts[0].find("no such property"), std::string::npos) << others.Texts[0];
}

// What integrates along rays is not there.
TEST_F(MapperProperties, IsosurfacesHaveNoneOfVolumes)
{
  for (const char* name :
    { "BlendMode", "Integration", "TableScalarSize", "TableLengthSize", "TableLengthScale",
      "TableScalarAxis", "TableFormat", "TableMaximumBytes", "Reentry", "Precision" })
  {
    EXPECT_EQ(tetralux::GetMapperProperty(name).Kinds & tetralux::IsosurfaceKind, 0u) << name;
    EXPECT_EQ(FindPrinted(this->Isosurface, name), "(not printed)");
  }
  Errors errors(this->Isosurface);
  this->Isosurface->SetIntegrationToTable();
  this->Isosurface->SetReentryToImaginaryCells();
  ASSERT_EQ(errors.Texts.size(), 2u);
  for (const std::string& text : errors.Texts)
  {
    EXPECT_NE(text.find("no such property"), std::string::npos) << text;
  }
}

// Image data have the blend modes of vtkVolumeMapper, and cells some of them and one more.
TEST_F(MapperProperties, BlendModesOfOtherMappersAreRefused)
{
  Errors errors(this->Caster);
  this->Caster->SetBlendMode(Mapper::ABSORPTION_BLEND);
  EXPECT_EQ(this->Caster->GetBlendMode(), vtkVolumeMapper::COMPOSITE_BLEND);
  ASSERT_EQ(errors.Texts.size(), 1u);
  EXPECT_NE(errors.Texts[0].find("BlendMode: 16 is not composite (0)"), std::string::npos)
    << errors.Texts[0];
  EXPECT_STREQ(this->Caster->GetBlendModeAsString(), "composite");

  Errors others(this->RayCast);
  this->RayCast->SetBlendMode(vtkVolumeMapper::SLICE_BLEND);
  EXPECT_EQ(this->RayCast->GetBlendMode(), Mapper::COMPOSITE_BLEND);
  ASSERT_EQ(others.Texts.size(), 1u);
  EXPECT_NE(others.Texts[0].find("BlendMode: 6 is not composite (0)"), std::string::npos)
    << others.Texts[0];
}

TEST_F(MapperProperties, DepthCuesRefuseWhatIsNotFinite)
{
  Errors errors(this->Caster);
  this->Caster->SetNearColor(1, NaN, 1);
  this->Caster->SetFarColor(1, 1, std::numeric_limits<double>::infinity());
  ASSERT_EQ(errors.Texts.size(), 2u);
  EXPECT_NE(errors.Texts[0].find("NearColor"), std::string::npos) << errors.Texts[0];
  EXPECT_NE(errors.Texts[1].find("FarColor"), std::string::npos) << errors.Texts[1];
  EXPECT_EQ(FindPrinted(this->Caster, "FarColor"), "1, 1, 1");
}

TEST_F(MapperProperties, AverageIPScalarRangeRefusesNaN)
{
  Errors errors(this->Caster);
  this->Caster->SetAverageIPScalarRange(2, NaN);
  ASSERT_EQ(errors.Texts.size(), 1u);
  EXPECT_NE(errors.Texts[0].find("AverageIPScalarRange: nan"), std::string::npos);
  this->Caster->SetAverageIPScalarRange(2, 3);
  EXPECT_EQ(FindPrinted(this->Caster, "AverageIPScalarRange"), "2, 3");
}

TEST(PropertiesOfOthers, TheTableSourceRefusesWhatItCannotTabulate)
{
  vtkNew<vtkPreIntegrationTableSource> source;
  Errors errors(source);
  source->SetFormat(Mapper::AUTOMATIC_FORMAT);
  source->SetScalarAxis(Mapper::AUTOMATIC_AXIS);
  source->SetLengthScale(Mapper::AUTOMATIC_SCALE);
  source->SetBlendMode(2);
  ASSERT_EQ(errors.Texts.size(), 4u);
  EXPECT_NE(errors.Texts[0].find("Format: 0 is not unorm8 (1)"), std::string::npos)
    << errors.Texts[0];
  EXPECT_EQ(FindPrinted(source, "Format"), "float");
  EXPECT_EQ(FindPrinted(source, "ScalarAxis"), "uniform");
  EXPECT_EQ(FindPrinted(source, "LengthScale"), "linear");
  EXPECT_EQ(FindPrinted(source, "BlendMode"), "composite");
  source->SetFormatToHalf();
  source->SetScalarAxisToNodes();
  source->SetLengthScaleToLogarithmic();
  source->SetBlendModeToIsoSurface();
  EXPECT_STREQ(source->GetFormatAsString(), "half");
  EXPECT_STREQ(source->GetScalarAxisAsString(), "nodes");
  EXPECT_STREQ(source->GetLengthScaleAsString(), "logarithmic");
  EXPECT_STREQ(source->GetBlendModeAsString(), "isosurface");
}

TEST(PropertiesOfOthers, TheRayIntegratorClampsAndRefusesNaN)
{
  vtkNew<vtkTetrahedraRayIntegrator> integrator;
  EXPECT_EQ(integrator->GetMaximumError(), 1e-5);
  integrator->SetMaximumError(0);
  EXPECT_EQ(integrator->GetMaximumError(), 1e-9);
  integrator->SetMaximumError(2);
  EXPECT_EQ(integrator->GetMaximumError(), 1);
  Errors errors(integrator);
  integrator->SetMaximumError(NaN);
  EXPECT_EQ(integrator->GetMaximumError(), 1);
  EXPECT_EQ(errors.Texts.size(), 1u);
}

TEST(PropertiesOfOthers, TheSortRefusesOtherOrders)
{
  vtkNew<vtkMeshedPolyhedraVisibilitySort> sort;
  Errors errors(sort);
  sort->SetOrderToCentroid();
  sort->SetOrder(5);
  ASSERT_EQ(errors.Texts.size(), 1u);
  EXPECT_NE(errors.Texts[0].find("across-gaps (2)"), std::string::npos) << errors.Texts[0];
  EXPECT_STREQ(sort->GetOrderAsString(), "centroid");
  EXPECT_EQ(FindPrinted(sort, "Order"), "centroid");
  EXPECT_EQ(FindPrinted(sort, "UsedOrder"), "automatic");
}
