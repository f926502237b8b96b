// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchFeatures.h"

#include "Bench/BenchMappers.h"
#include "Bench/BenchPictures.h"
#include "Bench/BenchResults.h"
#include "Bench/BenchScenes.h"
#include "Bench/BenchSetting.h"
#include "Bench/BenchTransferFunctions.h"
#include "Bench/BenchView.h"
#include "Setup/SceneOptions.h"
#include "vtkHeadlessRenderWindow.h"
#include "vtkTetrahedraVolumeMapper.h"

#include "vtkActor.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkColorTransferFunction.h"
#include "vtkContourValues.h"
#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPlane.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>

namespace
{

/// A colour or opacity that varies by this much needs the arithmetic of a varying one, and yields
/// the picture of a constant one.
constexpr double Hardly = 1e-6;

/// One of the three pictures of a feature.
struct Variant
{
  std::string Description; ///< empty: no such picture
  BenchScene Scene;
  std::vector<std::string> Assignments;
  std::function<void(BenchView&)> Adapt;
  std::string Method = "ray-cast"; ///< as --method takes it
};

struct Comparison
{
  std::string Name;
  Variant Plain;
  Variant Forced;
  Variant Used;
};

vtkTetrahedraVolumeMapper* GetMapper(BenchView& view)
{
  return vtkTetrahedraVolumeMapper::SafeDownCast(view.GetMapper());
}

/// Returns the scene with another transfer function. Over the range, red rises and blue falls by
/// color, and opacity rises by 0.4 opacity.
BenchScene WithVariation(const BenchScene& scene, double color, double opacity)
{
  double range[2];
  scene.Mesh->GetScalarRange(range);
  vtkNew<vtkColorTransferFunction> colors;
  vtkNew<vtkPiecewiseFunction> opacities;
  for (int end = 0; end < 2; ++end)
  {
    const double sign = end == 0 ? -0.5 : 0.5;
    colors->AddRGBPoint(range[end], 0.5 + sign * color, 0.5, 0.5 - sign * color);
    opacities->AddPoint(range[end], 0.2 + 0.4 * sign * opacity);
  }
  BenchScene varied = scene;
  varied.Property = vtkSmartPointer<vtkVolumeProperty>::New();
  varied.Property->DeepCopy(scene.Property);
  varied.Property->SetColor(colors);
  varied.Property->SetScalarOpacity(opacities);
  return varied;
}

Comparison CompareColorVariation(const BenchScene& ball)
{
  return { "colour variation",
    { "one colour, opacity that varies", WithVariation(ball, 0, 1), {}, {} },
    { "colours that differ by 1e-6", WithVariation(ball, Hardly, 1), {}, {} },
    { "colours that vary", WithVariation(ball, 1, 1), {}, {} } };
}

Comparison CompareOpacityVariation(const BenchScene& ball)
{
  return { "opacity variation",
    { "one opacity, colours that vary", WithVariation(ball, 1, 0), {}, {} },
    { "opacities that differ by 1e-6", WithVariation(ball, 1, Hardly), {}, {} },
    { "opacities that vary", WithVariation(ball, 1, 1), {}, {} } };
}

Comparison CompareTable(const BenchScene& ball)
{
  return { "3-D table", { "the integral in closed form", ball, { "Integration=closed-form" }, {} },
    {},
    { "from a table of 128 x 128 x 16", ball,
      { "Integration=table", "TableScalarSize=128", "TableLengthSize=16" }, {} } };
}

/// Sets five isovalues over the range of the scalars. The view's property must be its own.
void MakeIsosurfaces(BenchView& view)
{
  double range[2];
  vtkDataSet::SafeDownCast(view.GetMapper()->GetDataObjectInput())->GetScalarRange(range);
  vtkVolumeProperty* property = view.GetVolume()->GetProperty();
  for (int i = 0; i < 5; ++i)
  {
    property->GetIsoSurfaceValues()->SetValue(i, range[0] + (i + 1) * (range[1] - range[0]) / 6);
  }
}

/// Lights the isosurfaces: by ambient light to the given share, by the camera's light for the rest.
void Shade(BenchView& view, double ambient)
{
  MakeIsosurfaces(view);
  vtkVolumeProperty* property = view.GetVolume()->GetProperty();
  property->ShadeOn();
  property->SetAmbient(ambient);
  property->SetDiffuse(1 - ambient);
  property->SetSpecular(0.2 * (1 - ambient));
}

Comparison CompareShading(const BenchScene& ball)
{
  const std::vector<std::string> isosurface = { "BlendMode=isosurface" };
  return {
    "shading", { "five isosurfaces, flat", WithVariation(ball, 1, 1), isosurface, MakeIsosurfaces },
    { "shaded by ambient light alone", WithVariation(ball, 1, 1), isosurface,
      [](BenchView& view) { Shade(view, 1); } },
    { "shaded", WithVariation(ball, 1, 1), isosurface, [](BenchView& view) { Shade(view, 0.1); } }
  };
}

/// Traced isosurfaces, lit by the camera's light: without shadows, and with them. Nothing forces
/// shadows that do not show.
Comparison CompareShadows(const BenchScene& ball)
{
  const auto shade = [](BenchView& view) { Shade(view, 0.1); };
  return { "shadows of traced isosurfaces",
    { "five isosurfaces, lit", WithVariation(ball, 1, 1), {}, shade, "isosurface" }, {},
    { "with shadows", WithVariation(ball, 1, 1), { "Shadows=on" }, shade, "isosurface" } };
}

/// Isosurfaces by rays that walk from cell to cell, and traced.
Comparison CompareTracing(const BenchScene& ball)
{
  return { "isosurfaces traced",
    { "five flat isosurfaces, ray-cast", WithVariation(ball, 1, 1), { "BlendMode=isosurface" },
      MakeIsosurfaces },
    {}, { "traced", WithVariation(ball, 1, 1), {}, MakeIsosurfaces, "isosurface" } };
}

/// Compares an optical model with the full one. mode: as BlendMode takes it.
Comparison CompareModel(const BenchScene& ball, const std::string& name, const std::string& mode)
{
  return { name, { "emission and absorption", WithVariation(ball, 1, 1), {}, {} }, {},
    { name, WithVariation(ball, 1, 1), { "BlendMode=" + mode }, MakeIsosurfaces } };
}

Comparison CompareClipping(const BenchScene& ball)
{
  const double* bounds = ball.Mesh->GetBounds();
  const auto clip = [](double x)
  {
    return [x](BenchView& view)
    {
      vtkNew<vtkPlane> plane;
      plane->SetOrigin(x, 0, 0);
      plane->SetNormal(1, 0, 0);
      view.GetMapper()->AddClippingPlane(plane);
    };
  };
  return { "clipping", { "no planes", ball, {}, {} },
    { "a plane beside the mesh", ball, {}, clip(bounds[0] - 1) },
    { "a plane through the middle", ball, {}, clip(0.5 * (bounds[0] + bounds[1])) } };
}

Comparison CompareCropping(const BenchScene& ball)
{
  const double* bounds = ball.Mesh->GetBounds();
  const auto crop = [bounds](int flags)
  {
    return [bounds, flags](BenchView& view)
    {
      double planes[6];
      for (int axis = 0; axis < 3; ++axis)
      {
        const double quarter = 0.25 * (bounds[2 * axis + 1] - bounds[2 * axis]);
        planes[2 * axis] = bounds[2 * axis] + quarter;
        planes[2 * axis + 1] = bounds[2 * axis + 1] - quarter;
      }
      GetMapper(view)->CroppingOn();
      GetMapper(view)->SetCroppingRegionPlanes(planes);
      GetMapper(view)->SetCroppingRegionFlags(flags);
    };
  };
  constexpr int allRegions = 0x7ffffff;
  constexpr int outerRegions = 0x7ffdfff;
  return { "cropping", { "off", ball, {}, {} },
    { "on, with all 27 regions", ball, {}, crop(allRegions) },
    { "on, without the middle one", ball, {}, crop(outerRegions) } };
}

/// Adds a ball of a third of the scene's radius. It stands in the middle of the scene, moved along
/// the view by offset, in radii of the scene.
void AddGeometry(BenchView& view, double offset)
{
  const vtkBoundingBox box(view.GetMapper()->GetBounds());
  const double radius = 0.5 * box.GetDiagonalLength();
  double center[3], direction[3];
  box.GetCenter(center);
  vtkCamera* camera = view.GetRenderer()->GetActiveCamera();
  camera->GetDirectionOfProjection(direction);
  for (int axis = 0; axis < 3; ++axis)
  {
    center[axis] += offset * radius * direction[axis];
  }
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(center);
  sphere->SetRadius(radius / 3);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  view.GetRenderer()->AddActor(actor);
  double range[2];
  camera->GetClippingRange(range);
  camera->SetClippingRange(range[0], range[1] + 4 * radius);
}

Comparison CompareGeometry(const BenchScene& ball)
{
  return { "opaque geometry", { "none", ball, {}, {} },
    { "a sphere behind the mesh", ball, {}, [](BenchView& view) { AddGeometry(view, 2); } },
    { "the sphere in its middle", ball, {}, [](BenchView& view) { AddGeometry(view, 0); } } };
}

Comparison CompareNonConvexity(bool quick)
{
  const double cells = quick ? 6 : 24;
  const BenchScene whole = MakeGeneratedScene("random", { { "cells", cells }, { "removed", 0 } });
  const BenchScene holes =
    MakeGeneratedScene("random", { { "cells", cells }, { "removed", 0.05 } });
  return { "non-convexity", { "a cube of tetrahedra", whole, {}, {} },
    { "the same, as if it had imaginary cells", whole, { "Reentry=2" }, {} },
    { "without a twentieth of its tetrahedra", holes, {}, {} } };
}

Comparison CompareCellData(int cells)
{
  return { "cell data", { "scalars of points", MakeBallScene(cells, false), {}, {} }, {},
    { "scalars of cells", MakeBallScene(cells, true), {}, {} } };
}

Comparison ComparePrecision(const BenchScene& ball)
{
  return { "double precision", { "geometry in single precision", ball, { "Precision=single" }, {} },
    {}, { "in double precision", ball, { "Precision=double" }, {} } };
}

std::unique_ptr<BenchView> MakeView(const Variant& variant, const SceneOptions& view)
{
  if (variant.Description.empty())
  {
    return nullptr;
  }
  BenchSetting setting;
  setting.Method = variant.Method;
  setting.Assignments = variant.Assignments;
  auto made = std::make_unique<BenchView>(
    MakeBenchWindow(view), variant.Scene, MakeBenchMapper(setting, view.NumberOfThreads), view);
  if (variant.Adapt)
  {
    variant.Adapt(*made);
  }
  made->Render();
  return made;
}

/// Returns what the mapper left out of the last frame, with its reasons.
nlohmann::json GetLeftOut(const BenchView& view)
{
  return nlohmann::json::parse(view.GetStatistics()).at("left_out");
}

BenchFeature MeasureFeature(const Comparison& comparison, const SceneOptions& options, int frames)
{
  const Variant* variants[3] = { &comparison.Plain, &comparison.Forced, &comparison.Used };
  std::unique_ptr<BenchView> views[3];
  double seconds[3];
  for (int i = 0; i < 3; ++i)
  {
    views[i] = MakeView(*variants[i], options);
    seconds[i] = views[i] ? std::numeric_limits<double>::infinity() : NoNumber;
  }
  // In turns, so that other load on the machine hits all of them.
  for (int frame = 0; frame < frames; ++frame)
  {
    for (int i = 0; i < 3; ++i)
    {
      if (views[i])
      {
        seconds[i] = std::min(seconds[i], views[i]->Render());
      }
    }
  }
  const double difference = views[1]
    ? MeasureErrors(views[1]->GetFloatPicture(), views[0]->GetFloatPicture()).Maximum
    : NoNumber;
  const nlohmann::json plain = GetLeftOut(*views[0]);
  const nlohmann::json used = GetLeftOut(*views[2]);
  std::string leftOut;
  for (const auto& [name, reason] : plain.items())
  {
    if (!used.contains(name))
    {
      leftOut += (leftOut.empty() ? "" : ", ") + name + " (" + reason.get<std::string>() + ")";
    }
  }
  return { comparison.Name, variants[0]->Description, variants[1]->Description,
    variants[2]->Description, leftOut, seconds[0], seconds[1], seconds[2], difference };
}

} // namespace

std::vector<BenchFeature> MeasureFeatures(const SceneOptions& view, int frames, bool quick)
{
  const int cells = quick ? 8 : 40;
  const BenchScene ball = MakeBallScene(cells, false);
  std::vector<BenchFeature> features;
  for (const Comparison& comparison : { CompareColorVariation(ball), CompareOpacityVariation(ball),
         CompareTable(ball), CompareShading(ball), CompareClipping(ball), CompareCropping(ball),
         CompareGeometry(ball), CompareNonConvexity(quick), CompareCellData(cells),
         ComparePrecision(ball), CompareModel(ball, "emission only", "additive"),
         CompareModel(ball, "absorption only", "absorption"),
         CompareModel(ball, "maximum intensity", "maximum-intensity"),
         CompareModel(ball, "five flat isosurfaces", "isosurface"), CompareTracing(ball),
         CompareShadows(ball) })
  {
    features.push_back(MeasureFeature(comparison, view, frames));
  }
  return features;
}
