// SPDX-License-Identifier: BSD-3-Clause
#ifndef AnyMapperScene_h
#define AnyMapperScene_h

#include "vtkAbstractVolumeMapper.h"
#include "vtkColorTransferFunction.h"
#include "vtkHeadlessRenderWindow.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

/// What is the same for mappers of cells and of image data.

/// The classes of all mappers.
const std::vector<std::string>& GetMapperClasses();

vtkSmartPointer<vtkAbstractVolumeMapper> MakeMapper(const std::string& className);

vtkImageData* GetOutputImage(vtkAbstractVolumeMapper* mapper);

std::string GetStatistics(vtkAbstractVolumeMapper* mapper);

/// Image data, which all mappers take, with a smooth field from -1 to 1.
vtkSmartPointer<vtkImageData> MakeField();

/// Image data in a window of their own, by any mapper.
class AnyMapperScene
{
public:
  explicit AnyMapperScene(vtkAbstractVolumeMapper* mapper, int width = 48, int height = 36);

  /// Shows the input of another mapper.
  void Use(vtkAbstractVolumeMapper* mapper);

  vtkAbstractVolumeMapper* GetMapper() const { return this->Mapper; }

  /// The next frame: colours and distances of the picture, copies; empty if there is no picture.
  std::vector<float> Render();

  /// Red, green and blue of the window as it is, 0..255.
  std::vector<int> Grab();

  /// A statistic of the last frame, as JSON in one line.
  std::string Get(const std::string& name) const;

  vtkNew<vtkHeadlessRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkColorTransferFunction> Color;
  vtkNew<vtkPiecewiseFunction> Opacity;

private:
  vtkSmartPointer<vtkAbstractVolumeMapper> Mapper;
};

/// Colours and distances of a mapper's picture, copies; empty if there is none.
std::vector<float> GetPicture(vtkAbstractVolumeMapper* mapper);

/// A test of each mapper, with the name of its class.
class AnyMapper : public testing::TestWithParam<std::string>
{
};

std::string NameAnyMapperTest(const testing::TestParamInfo<std::string>& info);

#endif
