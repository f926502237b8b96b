// SPDX-License-Identifier: BSD-3-Clause
// Inputs without a cell: one warning, no error, and in all mappers a picture in which nothing is.
#include "AnyMapperScene.h"
#include "Observer.h"

#include "vtkCommand.h"
#include "vtkExplicitStructuredGrid.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <vector>

namespace
{

std::vector<vtkSmartPointer<vtkDataObject>> MakeEmptyInputs()
{
  const auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  blocks->SetBlock(0, vtkSmartPointer<vtkExplicitStructuredGrid>::New());
  return { vtkSmartPointer<vtkUnstructuredGrid>::New(),
    vtkSmartPointer<vtkExplicitStructuredGrid>::New(), vtkSmartPointer<vtkStructuredGrid>::New(),
    vtkSmartPointer<vtkRectilinearGrid>::New(), vtkSmartPointer<vtkImageData>::New(),
    vtkSmartPointer<vtkPolyData>::New(), vtkSmartPointer<vtkMultiBlockDataSet>::New(), blocks };
}

} // namespace

class EmptyInputs : public AnyMapper
{
};

INSTANTIATE_TEST_SUITE_P(Mappers, EmptyInputs,
  testing::Values("vtkTetrahedraRayCastMapper", "vtkTetrahedraGPURayCastMapper",
    "vtkTetrahedraProjectionMapper", "vtkTetrahedraIsosurfaceMapper"),
  NameAnyMapperTest);

TEST_P(EmptyInputs, AreSaidToBe)
{
  AnyMapperScene scene(MakeMapper(this->GetParam()));
  const std::vector<float> filled = scene.Render();
  for (const vtkSmartPointer<vtkDataObject>& input : MakeEmptyInputs())
  {
    SCOPED_TRACE(input->GetClassName());
    const vtkSmartPointer<vtkAbstractVolumeMapper> mapper = MakeMapper(this->GetParam());
    const MessageObserver warnings(mapper, { vtkCommand::WarningEvent });
    const MessageObserver errors(mapper);
    mapper->SetInputDataObject(input);
    scene.Use(mapper);
    scene.Window->Render();
    // VTK itself does not draw a volume without bounds.
    mapper->Render(scene.Renderer, scene.Volume);
    EXPECT_NE(warnings.Text.find("nothing is drawn"), std::string::npos) << warnings.Text;
    EXPECT_EQ(errors.Text, "");
    const std::vector<float> picture = GetPicture(mapper);
    ASSERT_EQ(picture.size(), filled.size());
    EXPECT_EQ(*std::max_element(picture.begin(), picture.end()), 0);
    EXPECT_EQ(*std::min_element(picture.begin(), picture.end()), -1); // distances
  }
}
