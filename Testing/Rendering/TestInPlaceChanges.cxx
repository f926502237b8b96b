// SPDX-License-Identifier: BSD-3-Clause
// Values that programs change in arrays that say nothing of it, and the input that says so.
#include "ImageScene.h"
#include "RayCastScene.h"
#include "Statistics.h"

#include "vtkContourValues.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraProjectionMapper.h"

#include <algorithm>
#include <vector>

namespace
{

using Picture = std::vector<float>;

template <class MapperT>
vtkSmartPointer<vtkTetrahedraVolumeMapper> Make()
{
  return vtkSmartPointer<MapperT>::New();
}

/// A scene of small pictures, with a surface for who shows surfaces.
class SmallScene : public RayCastScene
{
public:
  explicit SmallScene(const vtkSmartPointer<vtkTetrahedraVolumeMapper>& mapper)
    : RayCastScene(32, 24)
  {
    this->Volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, 0.2);
    this->Use(mapper);
  }

  Picture Render()
  {
    this->Window->Render();
    const vtkIdType size = 4 * this->GetMapper()->GetOutputImage()->GetNumberOfPoints();
    return { this->GetColors(), this->GetColors() + size };
  }
};

struct NamedMapper
{
  const char* Name;
  vtkSmartPointer<vtkTetrahedraVolumeMapper> (*Make)();
};

class InPlaceChanges : public testing::TestWithParam<NamedMapper>
{
};

TEST_P(InPlaceChanges, CountOnceTheInputSaysSo)
{
  SmallScene scene(GetParam().Make());
  const Picture before = scene.Render();
  EXPECT_GT(*std::max_element(before.begin(), before.end()), 0);

  auto* field = vtkDoubleArray::SafeDownCast(scene.Grid->GetPointData()->GetScalars());
  std::for_each(field->GetPointer(0), field->GetPointer(0) + field->GetNumberOfValues(),
    [](double& value) { value = 0.3 - value; });
  scene.Grid->Modified();
  const Picture scalars = scene.Render();
  EXPECT_NE(scalars, before);

  auto* points = vtkDoubleArray::SafeDownCast(scene.Grid->GetPoints()->GetData());
  ASSERT_NE(points, nullptr);
  std::for_each(points->GetPointer(0), points->GetPointer(0) + points->GetNumberOfValues(),
    [](double& value) { value = 0.8 * value + 0.1; });
  scene.Grid->Modified();
  const Picture moved = scene.Render();
  EXPECT_NE(moved, scalars);
  scene.Grid->Modified();
  EXPECT_EQ(scene.Render(), moved);
  EXPECT_EQ(GetStatistic(scene.GetMapper(), "rebuilt"), "[]");

  // As who sees the input for the first time.
  scene.Use(GetParam().Make());
  EXPECT_EQ(scene.Render(), moved);

  // In a composite, which says so itself.
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(0, scene.Grid);
  vtkNew<vtkMultiBlockDataSet> outer;
  outer->SetBlock(0, inner);
  const vtkSmartPointer<vtkTetrahedraVolumeMapper> mapper = GetParam().Make();
  scene.Use(mapper);
  mapper->SetInputData(static_cast<vtkDataObject*>(outer));
  EXPECT_EQ(scene.Render(), moved);
  for (vtkObject* said : { static_cast<vtkObject*>(outer), static_cast<vtkObject*>(inner),
         static_cast<vtkObject*>(scene.Grid->GetPointData()) })
  {
    std::for_each(field->GetPointer(0), field->GetPointer(0) + field->GetNumberOfValues(),
      [](double& value) { value = 0.9 * value; });
    const Picture last = scene.Render();
    said->Modified();
    EXPECT_NE(scene.Render(), last) << said->GetClassName();
  }
}

INSTANTIATE_TEST_SUITE_P(Mappers, InPlaceChanges,
  testing::Values(NamedMapper{ "RayCast", &Make<vtkTetrahedraRayCastMapper> },
    NamedMapper{ "GPURayCast", &Make<vtkTetrahedraGPURayCastMapper> },
    NamedMapper{ "Projection", &Make<vtkTetrahedraProjectionMapper> },
    NamedMapper{ "Isosurface", &Make<vtkTetrahedraIsosurfaceMapper> }),
  [](const auto& info) { return info.param.Name; });

TEST(InPlaceChangesOfImages, CountOnceTheInputSaysSo)
{
  ImageScene scene(32, 24);
  const vtkSmartPointer<vtkImageData> image = MakeImage();
  scene.Mapper->SetInputData(image);
  const Picture before = scene.Render();
  EXPECT_GT(*std::max_element(before.begin(), before.end()), 0);
  auto* values = static_cast<float*>(image->GetScalarPointer());
  std::for_each(
    values, values + image->GetNumberOfPoints(), [](float& value) { value = 100 - value; });
  image->Modified();
  const Picture changed = scene.Render();
  EXPECT_NE(changed, before);
  ImageScene fresh(32, 24);
  fresh.Mapper->SetInputData(image);
  EXPECT_EQ(changed, fresh.Render());
}

} // namespace
