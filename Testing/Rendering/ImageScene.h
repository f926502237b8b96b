// SPDX-License-Identifier: BSD-3-Clause
#ifndef ImageScene_h
#define ImageScene_h

#include "vtkCamera.h"
#include "vtkColorTransferFunction.h"
#include "vtkHeadlessRenderWindow.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkTriangleCasterMapper.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

/// Points of the scene's image along each axis.
constexpr std::array<int, 3> ImageSize = { 14, 11, 9 };

/// A smooth field over image data from (0, 0, 0) on with a spacing of 1, rounded to whole numbers
/// from 0 to 100, of a type of VTK.
vtkSmartPointer<vtkImageData> MakeImage(int type = VTK_FLOAT);

/// The same number at all points.
vtkSmartPointer<vtkImageData> MakeConstantImage(double value);

/// Image data in a window of their own.
class ImageScene
{
public:
  explicit ImageScene(int width = 96, int height = 72);

  /// The picture of the next frame, a copy.
  std::vector<float> Render();

  /// Distances of the last frame.
  std::vector<float> GetDepths();

  /// Red, green and blue of the window as it is, 0..255, lower row first.
  std::vector<int> Grab();

  /// A member of the statistics of the last frame, as JSON in one line.
  std::string Get(const std::string& name);

  /// Opaque geometry.
  void AddSphere(double x, double y, double z, double radius);

  vtkNew<vtkHeadlessRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkTriangleCasterMapper> Mapper;
  vtkNew<vtkColorTransferFunction> Color;
  vtkNew<vtkPiecewiseFunction> Opacity;
};

/// What vtkOpenGLGPUVolumeRayCastMapper shows of the input, the BlendMode and the property of a
/// scene's mapper, with its SampleDistance, as ImageScene::Grab has it.
std::vector<int> GrabOfVTK(ImageScene& scene);

/// Share of the channels of two pictures of 0..255, of which the second one shows something, that
/// differ by more than a tolerance.
double FindShareAbove(
  const std::vector<int>& picture, const std::vector<int>& expected, int tolerance);

/// The largest difference of two pictures, of which the second one shows something.
double FindDifference(const std::vector<float>& picture, const std::vector<float>& expected);

#endif
