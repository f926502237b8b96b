// SPDX-License-Identifier: BSD-3-Clause
// A shallow copy of a mapper draws what the mapper draws.
#include "AnyMapperScene.h"

#include "MapperPropertyAccess.h"

#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkTriangleCasterMapper.h"

#include <algorithm>
#include <vector>

namespace
{

// A value beside the default, of each number of a property.
std::vector<double> MakeOtherValues(
  const tetralux::MapperProperty& property, vtkAbstractVolumeMapper* mapper)
{
  std::vector<double> values = property.Default;
  const auto named = tetralux::GetNamedValues(property, tetralux::GetKind(mapper));
  switch (property.Type)
  {
    case tetralux::PropertyType::Boolean:
      values[0] = 1 - values[0];
      break;
    case tetralux::PropertyType::Enumeration:
      values[0] = named.back().Number;
      break;
    default:
      for (double& value : values)
      {
        value = std::clamp(value == 0 ? 2 : 0.5 * value, property.Minimum, property.Maximum);
      }
  }
  return values;
}

} // namespace

class ShallowCopies : public AnyMapper
{
};

INSTANTIATE_TEST_SUITE_P(
  Mappers, ShallowCopies, testing::ValuesIn(GetMapperClasses()), NameAnyMapperTest);

TEST_P(ShallowCopies, HaveAllProperties)
{
  const vtkSmartPointer<vtkAbstractVolumeMapper> mapper = MakeMapper(this->GetParam());
  mapper->SetInputDataObject(MakeField());
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectScalarArray("field");
  vtkNew<vtkPlane> plane;
  mapper->AddClippingPlane(plane);
  int count = 0;
  for (const tetralux::MapperProperty& property : tetralux::GetMapperProperties())
  {
    if ((property.Kinds & tetralux::GetKind(mapper)) != 0)
    {
      tetralux::SetPropertyValues(mapper, property, MakeOtherValues(property, mapper));
      EXPECT_NE(tetralux::GetPropertyValues(mapper, property), property.Default) << property.Name;
      ++count;
    }
  }
  EXPECT_GT(count, 10);

  const vtkSmartPointer<vtkAbstractVolumeMapper> copy = MakeMapper(this->GetParam());
  copy->ShallowCopy(mapper);
  for (const tetralux::MapperProperty& property : tetralux::GetMapperProperties())
  {
    if ((property.Kinds & tetralux::GetKind(mapper)) != 0)
    {
      EXPECT_EQ(
        tetralux::GetPropertyValues(copy, property), tetralux::GetPropertyValues(mapper, property))
        << property.Name;
    }
  }
  EXPECT_EQ(copy->GetDataObjectInput(), mapper->GetDataObjectInput());
  EXPECT_EQ(copy->GetScalarMode(), mapper->GetScalarMode());
  EXPECT_EQ(copy->GetArrayAccessMode(), mapper->GetArrayAccessMode());
  EXPECT_STREQ(copy->GetArrayName(), "field");
  EXPECT_EQ(copy->GetClippingPlanes()->GetItem(0), plane);
}

TEST(ShallowCopy, HasWhatIsNoNumber)
{
  vtkNew<vtkTetrahedraIsosurfaceMapper> surfaces;
  surfaces->SetColorArrayName("color");
  vtkNew<vtkTetrahedraIsosurfaceMapper> copiedSurfaces;
  copiedSurfaces->ShallowCopy(surfaces);
  EXPECT_STREQ(copiedSurfaces->GetColorArrayName(), "color");

  vtkNew<vtkTriangleCasterMapper> image;
  vtkNew<vtkImageData> mask;
  image->SetMaskInput(mask);
  vtkNew<vtkTriangleCasterMapper> copiedImage;
  copiedImage->ShallowCopy(image);
  EXPECT_EQ(copiedImage->GetMaskInput(), mask);
}

// Of another class: what both have, and no value that the copy refuses.
TEST(ShallowCopy, OfAnotherMapperHasWhatBothHave)
{
  vtkNew<vtkTetrahedraGPURayCastMapper> mapper;
  mapper->SetMaximumError(0.01);
  mapper->SetReentryToBoundaryLayers();
  mapper->SetInputDataObject(MakeField());
  vtkNew<vtkTetrahedraRayCastMapper> copy;
  copy->ShallowCopy(mapper);
  EXPECT_EQ(copy->GetMaximumError(), 0.01);
  EXPECT_STREQ(copy->GetReentryAsString(), "automatic");
  EXPECT_EQ(copy->GetDataObjectInput(), mapper->GetDataObjectInput());
}
