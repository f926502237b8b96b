// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurfaces/WindowWays.h"

#include "Isosurfaces/IsosurfaceWindow.h"
#include "Isosurfaces/SurfaceExtraction.h"
#include "Setup/SceneOptions.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraRayCastMapper.h"

#include "vtkActor.h"
#include "vtkColorTransferFunction.h"
#include "vtkContourValues.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <nlohmann/json.hpp>

#include <array>

namespace tetralux
{
namespace
{

constexpr std::array<double, 3> SurfaceColor = { 1, 0.9, 0.8 };

/// What the ways in a window have in common.
class WindowWay : public IsosurfaceWay
{
public:
  WindowWay(vtkUnstructuredGrid* grid, const SceneOptions& options)
    : Window(options, grid->GetBounds())
  {
  }

  vtkIdType CountCoveredPixels() override { return this->Window.CountCoveredPixels(); }

protected:
  IsosurfaceWindow Window;
};

//----------------------------------------------------------------------------
class EmptyWay : public WindowWay
{
public:
  using WindowWay::WindowWay;

  std::string GetName() const override { return "empty frame"; }
  bool Takes(IsosurfaceCase which) const override { return which == IsosurfaceCase::SameView; }
  void SetCase(IsosurfaceCase) override {}
  void SetIsovalue(double) override {}
  IsosurfaceTimes DrawFrame() override { return { 0, 0, this->Window.DrawFrame() }; }
};

//----------------------------------------------------------------------------
class RasteriserWay : public WindowWay
{
public:
  RasteriserWay(vtkUnstructuredGrid* grid, const SceneOptions& options)
    : WindowWay(grid, options)
    , Extraction(grid, ScalarTree::Off)
  {
    this->Mapper->ScalarVisibilityOff();
    this->Actor->SetMapper(this->Mapper);
    this->Actor->GetProperty()->SetColor(SurfaceColor[0], SurfaceColor[1], SurfaceColor[2]);
    this->Window.GetRenderer()->AddActor(this->Actor);
  }

  std::string GetName() const override { return "extraction + rasteriser"; }
  bool Takes(IsosurfaceCase) const override { return true; }

  void SetCase(IsosurfaceCase which) override
  {
    const bool layers = which == IsosurfaceCase::TwoLayers;
    this->Actor->GetProperty()->SetOpacity(layers ? LayerOpacity : 1);
    vtkRenderer* renderer = this->Window.GetRenderer();
    renderer->SetUseDepthPeeling(layers);
    renderer->SetMaximumNumberOfPeels(1); // each takes the nearest and the farthest layer
    renderer->SetOcclusionRatio(0);
    this->Window.SetShadows(which == IsosurfaceCase::Shadows);
  }

  void SetIsovalue(double isovalue) override { this->Extraction.SetIsovalue(isovalue); }

  IsosurfaceTimes DrawFrame() override
  {
    IsosurfaceTimes times;
    times.Extract = this->Extraction.Update();
    this->Mapper->SetInputData(this->Extraction.GetSurface());
    times.Draw = this->Window.DrawFrame();
    return times;
  }

  vtkIdType GetNumberOfTriangles() const override
  {
    return this->Extraction.GetSurface()->GetNumberOfPolys();
  }

private:
  SurfaceExtraction Extraction;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
};

//----------------------------------------------------------------------------
/// A volume with one lit surface, drawn by a mapper of this project.
template <class MapperT>
class VolumeWay : public WindowWay
{
public:
  VolumeWay(vtkUnstructuredGrid* grid, const SceneOptions& options)
    : WindowWay(grid, options)
  {
    this->Mapper->SetNumberOfThreads(options.NumberOfThreads);
    this->Mapper->AutoAdjustSampleDistancesOff(); // as for still pictures
    this->Mapper->SetBlendModeToIsoSurface();
    this->Mapper->SetInputData(grid);
    this->Color->AddRGBPoint(0, SurfaceColor[0], SurfaceColor[1], SurfaceColor[2]);
    this->Property->SetColor(this->Color);
    this->Property->SetScalarOpacity(this->Opacity);
    this->Property->ShadeOn();
    this->Property->SetAmbient(0);
    this->Property->SetDiffuse(1);
    this->Property->SetSpecular(0);
    this->Volume->SetMapper(this->Mapper);
    this->Volume->SetProperty(this->Property);
    this->Window.GetRenderer()->AddVolume(this->Volume);
  }

  void SetCase(IsosurfaceCase which) override
  {
    this->Opacity->RemoveAllPoints();
    this->Opacity->AddPoint(0, which == IsosurfaceCase::TwoLayers ? LayerOpacity : 1);
  }

  void SetIsovalue(double isovalue) override
  {
    this->Property->GetIsoSurfaceValues()->SetValue(0, isovalue);
  }

  IsosurfaceTimes DrawFrame() override { return { 0, 0, this->Window.DrawFrame() }; }

protected:
  vtkNew<MapperT> Mapper;

private:
  vtkNew<vtkColorTransferFunction> Color;
  vtkNew<vtkPiecewiseFunction> Opacity;
  vtkNew<vtkVolumeProperty> Property;
  vtkNew<vtkVolume> Volume;
};

class RayCasterWay : public VolumeWay<vtkTetrahedraRayCastMapper>
{
public:
  using VolumeWay::VolumeWay;

  std::string GetName() const override { return "ray caster"; }
  bool Takes(IsosurfaceCase which) const override { return which != IsosurfaceCase::Shadows; }
};

/// Its normals are those of cells, as those of the triangles of the other ways.
class TracerWay : public VolumeWay<vtkTetrahedraIsosurfaceMapper>
{
public:
  TracerWay(vtkUnstructuredGrid* grid, const SceneOptions& options)
    : VolumeWay(grid, options)
  {
    this->Mapper->SmoothShadingOff();
  }

  std::string GetName() const override { return "isosurface mapper"; }
  bool Takes(IsosurfaceCase) const override { return true; }

  void SetCase(IsosurfaceCase which) override
  {
    VolumeWay::SetCase(which);
    this->Mapper->SetShadows(which == IsosurfaceCase::Shadows);
    this->Mapper->SetMaximumNumberOfPeels(which == IsosurfaceCase::TwoLayers ? 2 : 0);
  }
};

/// The same without the window: what it takes to have the picture in memory.
class TracerAloneWay : public TracerWay
{
public:
  using TracerWay::TracerWay;

  std::string GetName() const override { return "isosurface mapper alone"; }

  IsosurfaceTimes DrawFrame() override
  {
    TracerWay::DrawFrame();
    const auto seconds = nlohmann::json::parse(this->Mapper->GetStatistics()).at("seconds");
    const auto get = [&seconds](const char* name)
    { return seconds.at(name).template get<double>(); };
    return { get("isopolygons"), get("hierarchy") + get("ranges"), get("trace") };
  }
};

} // namespace

//----------------------------------------------------------------------------
std::unique_ptr<IsosurfaceWay> MakeEmptyWay(vtkUnstructuredGrid* grid, const SceneOptions& options)
{
  return std::make_unique<EmptyWay>(grid, options);
}

std::unique_ptr<IsosurfaceWay> MakeRasteriserWay(
  vtkUnstructuredGrid* grid, const SceneOptions& options)
{
  return std::make_unique<RasteriserWay>(grid, options);
}

std::unique_ptr<IsosurfaceWay> MakeRayCasterWay(
  vtkUnstructuredGrid* grid, const SceneOptions& options)
{
  return std::make_unique<RayCasterWay>(grid, options);
}

std::unique_ptr<IsosurfaceWay> MakeTracerWay(vtkUnstructuredGrid* grid, const SceneOptions& options)
{
  return std::make_unique<TracerWay>(grid, options);
}

std::unique_ptr<IsosurfaceWay> MakeTracerAloneWay(
  vtkUnstructuredGrid* grid, const SceneOptions& options)
{
  return std::make_unique<TracerAloneWay>(grid, options);
}

} // namespace tetralux
