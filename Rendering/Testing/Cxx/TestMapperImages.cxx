// SPDX-License-Identifier: BSD-3-Clause
// One scene by one method: --scene NAME --method NAME [--window], and vtkTesting's command line.
// Without --window or -I, the window needs no display. All methods draw the same picture, so each
// scene has one baseline.
#include "PipeScene.h"
#include "TestedWindow.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace
{

// Thresholds are in whole pixels, see ImageTester. The baselines are pictures by the processor's
// mapper. Every mapper is within 1e-4 of a channel of them, which the tolerance of rounding covers,
// so what a threshold is for depends on the OpenGL alone. By Mesa's llvmpipe all of them measure 0.

// OpenGL draws only what is opaque: the rims of spheres may fall on other pixels. By Mesa's other
// rasterizer, softpipe, that is 0.3; graphics cards are given three times as much.
constexpr double RayCastThreshold = 1;

// Shaders may be rounded otherwise, so rays beside an edge of the outline may miss the mesh; the
// volume is faint there.
constexpr double GPURayCastThreshold = 2 * RayCastThreshold;

// Kernels for other processors are rounded otherwise, so rays at the edge of a surface or a shadow
// may fall on its other side.
constexpr double IsosurfaceThreshold = 2 * RayCastThreshold;

// OpenGL decides which pixels a cell covers, too.
constexpr double ProjectionThreshold = 3 * RayCastThreshold;

// Of a channel: half of what one of 255 steps is, so that rounding covers it.
constexpr double TableError = 0.5 / 255;

using MapperPointer = vtkSmartPointer<vtkTetrahedraVolumeMapper>;

template <class Mapper>
vtkSmartPointer<Mapper> Make()
{
  return vtkSmartPointer<Mapper>::New();
}

// Pictures do not depend on how fast the machine is.
template <>
vtkSmartPointer<vtkTetrahedraRayCastMapper> Make()
{
  auto mapper = vtkSmartPointer<vtkTetrahedraRayCastMapper>::New();
  mapper->AutoAdjustSampleDistancesOff();
  return mapper;
}

template <>
vtkSmartPointer<vtkTetrahedraIsosurfaceMapper> Make()
{
  auto mapper = vtkSmartPointer<vtkTetrahedraIsosurfaceMapper>::New();
  mapper->AutoAdjustSampleDistancesOff();
  return mapper;
}

template <class Mapper>
MapperPointer MakeDefault()
{
  return Make<Mapper>();
}

template <class Mapper>
MapperPointer MakeWithTable()
{
  const auto mapper = Make<Mapper>();
  mapper->SetIntegrationToTable();
  mapper->SetMaximumError(TableError);
  return mapper;
}

template <class Mapper>
MapperPointer MakeWithImaginaryCells()
{
  const auto mapper = Make<Mapper>();
  mapper->SetReentryToImaginaryCells();
  return mapper;
}

MapperPointer MakeWithBoundaryLayers()
{
  const auto mapper = Make<vtkTetrahedraGPURayCastMapper>();
  mapper->SetReentryToBoundaryLayers();
  return mapper;
}

// Rays four pixels apart, interpolated between.
MapperPointer MakeWithCoarseRays()
{
  const auto mapper = Make<vtkTetrahedraRayCastMapper>();
  mapper->SetImageSampleDistance(4);
  return mapper;
}

MapperPointer MakeWithShadows()
{
  const auto mapper = Make<vtkTetrahedraIsosurfaceMapper>();
  mapper->ShadowsOn();
  return mapper;
}

struct Method
{
  std::string Name;
  MapperPointer (*MakeMapper)();
  double Threshold; ///< whole pixels
};

const Method* FindMethod(const std::string& name)
{
  using RayCast = vtkTetrahedraRayCastMapper;
  using GPURayCast = vtkTetrahedraGPURayCastMapper;
  using Projection = vtkTetrahedraProjectionMapper;
  using Isosurface = vtkTetrahedraIsosurfaceMapper;
  static const std::vector<Method> methods = {
    { "RayCast", MakeDefault<RayCast>, RayCastThreshold },
    { "RayCastCoarse", MakeWithCoarseRays, RayCastThreshold },
    { "RayCastImaginaryCells", MakeWithImaginaryCells<RayCast>, RayCastThreshold },
    { "RayCastTable", MakeWithTable<RayCast>, RayCastThreshold },
    { "GPURayCast", MakeDefault<GPURayCast>, GPURayCastThreshold },
    { "GPURayCastBoundaryLayers", MakeWithBoundaryLayers, GPURayCastThreshold },
    { "GPURayCastImaginaryCells", MakeWithImaginaryCells<GPURayCast>, GPURayCastThreshold },
    { "GPURayCastTable", MakeWithTable<GPURayCast>, GPURayCastThreshold },
    { "Isosurface", MakeDefault<Isosurface>, IsosurfaceThreshold },
    { "IsosurfaceShadows", MakeWithShadows, IsosurfaceThreshold },
    { "Projection", MakeDefault<Projection>, ProjectionThreshold },
    { "ProjectionTable", MakeWithTable<Projection>, ProjectionThreshold },
  };
  const auto found = std::find_if(
    methods.begin(), methods.end(), [&name](const Method& method) { return method.Name == name; });
  return found == methods.end() ? nullptr : &*found;
}

std::string GetArgument(vtkTesting* tester, const char* name)
{
  return std::unique_ptr<char[]>(tester->GetArgument(name)).get();
}

} // namespace

int TestMapperImages(int argc, char* argv[])
{
  vtkNew<ImageTester> tester;
  tester->AddArguments(argc, argv);
  const std::string sceneName = GetArgument(tester, "--scene");
  const std::string methodName = GetArgument(tester, "--method");
  const Method* method = FindMethod(methodName);
  if (!method)
  {
    std::cerr << "no method is called " << methodName << "\n";
    return EXIT_FAILURE;
  }

  const vtkSmartPointer<vtkRenderWindow> window = MakeTestedWindow(tester);
  PipeScene scene(window, method->MakeMapper());
  if (!scene.Vary(sceneName))
  {
    std::cerr << "no scene is called " << sceneName << "\n";
    return EXIT_FAILURE;
  }
  return TestWindow(tester, window, method->Threshold);
}
