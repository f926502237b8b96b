// SPDX-License-Identifier: BSD-3-Clause
#include "ComponentScene.h"

#include "Optics/IntervalTable.h"
#include "PlainRays.h"
#include "ReferenceScenes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace tetralux
{
namespace
{

using Vector = PlainVector;

template <class Value>
void Store(const std::vector<double>& shares, ComponentScene& scene)
{
  constexpr bool Integer = std::numeric_limits<Value>::is_integer;
  const double low = Integer ? static_cast<double>(std::numeric_limits<Value>::min()) : -3;
  const double high = Integer ? static_cast<double>(std::numeric_limits<Value>::max()) : 5;
  std::vector<Value> values;
  scene.Numbers.clear();
  for (const double share : shares)
  {
    const double number = low + share * (high - low);
    values.push_back(static_cast<Value>(Integer ? std::round(number) : number));
    scene.Numbers.push_back(static_cast<double>(values.back()));
  }
  scene.Values.resize(values.size() * sizeof(Value));
  std::memcpy(scene.Values.data(), values.data(), scene.Values.size());
  scene.Scale = 1 / (high - low);
  scene.Offset = -low / (high - low);
}

class Loops
{
public:
  explicit Loops(const ComponentScene& scene)
    : Scene(scene)
    , Planes(MakeSlicePlanes(
        scene.GetVolume(), scene.Grid, scene.Options.Shape, scene.Options.SampleDistance))
  {
  }

  std::array<double, 4> Show(int i, int j) const
  {
    const PlainRay ray = MakePlainRay(this->Scene.Grid, this->Planes, i, j);
    std::array<double, 4> pixel{};
    double translucency = 1;
    for (const PlainSlab& slab : FindPlainSlabs(this->Scene.Dimensions, this->Planes, ray))
    {
      const Gathered gathered = this->Gather(ray, slab);
      const double depth = slab.GetMiddle() * ray.DepthOfDirection;
      const double cue = (depth - this->Planes.Origin) / (this->Planes.Back - this->Planes.Origin);
      const ImageCasterOptions& options = this->Scene.Options;
      for (int c = 0; c < 3; ++c)
      {
        const double factor =
          options.NearColor[c] + cue * (options.FarColor[c] - options.NearColor[c]);
        pixel[c] += translucency * factor * gathered.Emitted[c];
      }
      translucency *= 1 - gathered.Absorbed;
    }
    pixel[3] = 1 - translucency;
    return pixel;
  }

private:
  struct Gathered
  {
    double Emitted[3] = { 0, 0, 0 };
    double Absorbed = 0;
  };

  /// Colour and opacity of a step.
  struct Shown
  {
    Vector Color = { 0, 0, 0 };
    double Alpha = 0;
  };

  std::size_t GetIndex(int x, int y, int z) const
  {
    const auto& n = this->Scene.Dimensions;
    return (static_cast<std::size_t>(z) * n[1] + y) * n[0] + x;
  }

  double GetNumber(int component, int x, int y, int z) const
  {
    return this->Scene.Numbers[this->GetIndex(x, y, z) * this->Scene.Components + component];
  }

  double GetScalar(int component, const PlainPlace& place) const
  {
    const double number = place.Interpolate([&](const std::array<int, 3>& at)
      { return this->GetNumber(component, at[0], at[1], at[2]); });
    return this->Scene.Offset + this->Scene.Scale * number;
  }

  /// The gradient of the scalar in the world.
  Vector GetGradient(int component, const PlainPlace& place) const
  {
    return ToWorld(this->Scene.Grid,
      place.FindGradient(this->Scene.Dimensions,
        [&](const std::array<int, 3>& at)
        { return this->Scene.Scale * this->GetNumber(component, at[0], at[1], at[2]); }));
  }

  double GetAlpha(double scalarOpacity, double length) const
  {
    return this->Scene.Optics.Opacity == StepOpacity::Power
      ? 1 - std::pow(1 - scalarOpacity, length)
      : -std::expm1(-scalarOpacity * length);
  }

  double GetGradientFactor(const TransferFunction& function, const Vector& gradient) const
  {
    const double length = std::hypot(gradient[0], gradient[1], gradient[2]);
    return function.Nodes.empty()
      ? 1
      : Evaluate(function, length * this->Scene.Optics.GradientLength).Attenuation;
  }

  bool IsHidden(const PlainPlace& place) const
  {
    const auto& n = this->Scene.Dimensions;
    const auto& cell = place.Cell;
    if (!this->Scene.CellFlags.empty() &&
      (this->Scene
          .CellFlags[(static_cast<std::size_t>(cell[2]) * (n[1] - 1) + cell[1]) * (n[0] - 1) +
            cell[0]] &
        32) != 0)
    {
      return true;
    }
    bool hidden = false;
    for (int corner = 0; !this->Scene.PointFlags.empty() && corner < 8; ++corner)
    {
      const std::size_t at = this->GetIndex(
        cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2));
      hidden = hidden || (this->Scene.PointFlags[at] & 2) != 0;
    }
    return hidden;
  }

  Shown ShowLabel(double scalar, const TransferFunction& function,
    const TransferFunction& gradientOpacity, const Vector& gradient, double length) const
  {
    const TransferFunction::Value value = Evaluate(function, scalar);
    Shown shown;
    std::copy(value.Color, value.Color + 3, shown.Color.begin());
    shown.Alpha = this->GetAlpha(
      value.Attenuation * this->GetGradientFactor(gradientOpacity, gradient), length);
    return shown;
  }

  /// Of one function at each sample.
  Shown ShowOne(const PlainPlace& place, std::size_t nearest, double length) const
  {
    const ImageOptics& optics = this->Scene.Optics;
    const int last = this->Scene.Components - 1;
    const double scalar = this->GetScalar(last, place);
    const Vector gradient = this->GetGradient(last, place);
    Shown shown =
      this->ShowLabel(scalar, optics.Function, optics.GradientOpacity, gradient, length);
    if (this->Scene.Components == 2)
    {
      const TransferFunction::Value value = Evaluate(optics.Function, this->GetScalar(0, place));
      std::copy(value.Color, value.Color + 3, shown.Color.begin());
    }
    for (int c = 0; this->Scene.Components == 4 && c < 3; ++c)
    {
      shown.Color[c] = optics.ColorOffset[c] + optics.ColorScale[c] * this->GetScalar(c, place);
    }
    const std::size_t label = this->Scene.Labels.empty() ? 0 : this->Scene.Labels[nearest];
    if (label > 0 && label <= optics.Labels.size())
    {
      const LabelOptics& own = optics.Labels[label - 1];
      const Shown ofLabel =
        this->ShowLabel(scalar, own.Function, own.GradientOpacity, gradient, length);
      const double share = optics.LabelShare;
      for (int c = 0; c < 3; ++c)
      {
        shown.Color[c] =
          (shown.Alpha > 0 ? (1 - share) * shown.Color[c] : 0) + share * ofLabel.Color[c];
      }
      shown.Alpha = (1 - share) * shown.Alpha + share * ofLabel.Alpha;
    }
    return shown;
  }

  Gathered Gather(const PlainRay& ray, const PlainSlab& slab) const
  {
    const ComponentScene& scene = this->Scene;
    const ImageOptics& optics = scene.Optics;
    const double length = slab.GetLength();
    const Vector index = ray.GetIndex(slab.GetMiddle());
    const PlainPlace place(scene.Dimensions, index);
    std::array<int, 3> near;
    for (int a = 0; a < 3; ++a)
    {
      near[a] = static_cast<int>(std::floor(index[a] + 0.5));
    }
    const auto light = [&](const Material& surface, const Vector& gradient, Vector& color)
    {
      const Vector point = ray.GetPoint(slab.GetMiddle());
      color = Shine(scene.Options.Lights, surface, color, gradient, point, ray.Direction);
    };
    const std::size_t nearest = this->GetIndex(near[0], near[1], near[2]);
    Gathered gathered;
    if ((!scene.Mask.empty() && scene.Mask[nearest] == 0) || this->IsHidden(place))
    {
      return gathered;
    }
    if (scene.Components == 1 || optics.Components == ImageComponents::Dependent)
    {
      Shown shown = this->ShowOne(place, nearest, length / optics.UnitDistance);
      if (shown.Alpha > 0 && scene.Options.Shaded)
      {
        light(scene.Options.Surface, this->GetGradient(scene.Components - 1, place), shown.Color);
      }
      for (int c = 0; c < 3 && shown.Alpha > 0; ++c)
      {
        gathered.Emitted[c] = shown.Alpha * shown.Color[c];
      }
      gathered.Absorbed = shown.Alpha > 0 ? shown.Alpha : 0;
      return gathered;
    }
    double weighted = 0;
    double squares = 0;
    for (int k = 0; k < scene.Components; ++k)
    {
      ComponentOptics part{ optics.Function, optics.UnitDistance, optics.GradientOpacity,
        optics.Weight, scene.Options.Shaded, scene.Options.Surface };
      if (k > 0)
      {
        part = optics.OtherComponents[k - 1];
      }
      const Vector gradient = this->GetGradient(k, place);
      Shown shown = this->ShowLabel(this->GetScalar(k, place), part.Function, part.GradientOpacity,
        gradient, length / part.UnitDistance);
      if (!(part.Weight > 0) || !(shown.Alpha > 0))
      {
        continue;
      }
      if (part.Shaded)
      {
        light(part.Surface, gradient, shown.Color);
      }
      weighted += part.Weight * shown.Alpha;
      squares += shown.Alpha * shown.Alpha;
      for (int c = 0; c < 3; ++c)
      {
        gathered.Emitted[c] += part.Weight * shown.Alpha * shown.Color[c];
      }
    }
    gathered.Absorbed = weighted > 0 ? std::min(squares / weighted, 1.) : 0;
    return gathered;
  }

  const ComponentScene& Scene;
  SlicePlanes Planes;
};

} // namespace

void ComponentScene::SetValues(ImageScalar type, int components, const std::vector<double>& shares)
{
  this->Type = type;
  this->Components = components;
  switch (type)
  {
    case ImageScalar::Int8:
      Store<std::int8_t>(shares, *this);
      break;
    case ImageScalar::UInt8:
      Store<std::uint8_t>(shares, *this);
      break;
    case ImageScalar::Int16:
      Store<std::int16_t>(shares, *this);
      break;
    case ImageScalar::UInt16:
      Store<std::uint16_t>(shares, *this);
      break;
    case ImageScalar::Float:
      Store<float>(shares, *this);
      break;
  }
}

void ComponentScene::Look(bool parallel, int width, int height)
{
  const double spacing[3] = { 1.1, 0.8, 1.4 };
  const double turns[3][3] = { { 9. / 11, -6. / 11, 2. / 11 }, { 6. / 11, 7. / 11, -6. / 11 },
    { 2. / 11, 6. / 11, 9. / 11 } };
  double worldFromMesh[3][4];
  double size = 0;
  for (int a = 0; a < 3; ++a)
  {
    worldFromMesh[a][3] = 0;
    for (int b = 0; b < 3; ++b)
    {
      worldFromMesh[a][b] = spacing[b] * turns[a][b];
      worldFromMesh[a][3] -= worldFromMesh[a][b] * 0.5 * (this->Dimensions[b] - 1);
    }
    size = std::hypot(size, (this->Dimensions[a] - 1) * spacing[a]);
  }
  const Vector eye = { 1.2 * size, 0.9 * size, 1.3 * size };
  const Vector middle = { 0, 0, 0 };
  const Vector up = { 0.1, 1, 0.2 };
  this->Grid = parallel ? MakeParallelGrid(eye, middle, up, 0.4 * size, width, height)
                        : MakePerspectiveGrid(eye, middle, up, 27, width, height);
  PlaceMesh(this->Grid, worldFromMesh);
}

ImageVolume ComponentScene::GetVolume() const
{
  const auto get = [](const std::vector<unsigned char>& bytes)
  { return bytes.empty() ? nullptr : bytes.data(); };
  ImageVolume volume;
  std::copy(this->Dimensions.begin(), this->Dimensions.end(), volume.Dimensions);
  volume.Type = this->Type;
  volume.Components = this->Components;
  volume.Values = this->Values.data();
  volume.Scale = this->Scale;
  volume.Offset = this->Offset;
  volume.Labels = get(this->Labels);
  volume.Mask = get(this->Mask);
  volume.PointFlags = get(this->PointFlags);
  volume.CellFlags = get(this->CellFlags);
  return volume;
}

ComponentPicture CastScene(const ComponentScene& scene)
{
  ComponentPicture picture;
  // Whatever is not written is noticed.
  picture.Colors.assign(4 * scene.GetNumberOfPixels(), std::numeric_limits<float>::quiet_NaN());
  picture.Depths.assign(scene.GetNumberOfPixels(), std::numeric_limits<float>::quiet_NaN());
  ImageCaster caster;
  caster.SetVolume(scene.GetVolume());
  caster.SetOptics(scene.Optics);
  picture.Statistics =
    caster.Cast(scene.Grid, RayLimits(), scene.Options, picture.Colors, picture.Depths);
  return picture;
}

bool HasSameBits(const ComponentPicture& a, const ComponentPicture& b)
{
  return a.Colors.size() == b.Colors.size() &&
    std::memcmp(a.Colors.data(), b.Colors.data(), a.Colors.size() * sizeof(float)) == 0 &&
    std::memcmp(a.Depths.data(), b.Depths.data(), a.Depths.size() * sizeof(float)) == 0;
}

std::vector<double> ShowByLoops(const ComponentScene& scene)
{
  const Loops loops(scene);
  std::vector<double> colors;
  for (int j = 0; j < scene.Grid.Height; ++j)
  {
    for (int i = 0; i < scene.Grid.Width; ++i)
    {
      const std::array<double, 4> pixel = loops.Show(i, j);
      colors.insert(colors.end(), pixel.begin(), pixel.end());
    }
  }
  return colors;
}

} // namespace tetralux
