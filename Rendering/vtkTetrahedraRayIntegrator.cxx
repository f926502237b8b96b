// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTetrahedraRayIntegrator.h"

#include "Integral/RayIntegral.h"
#include "Optics/IntervalTable.h"
#include "Preparation/TransferFunctionFromProperty.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkDoubleArray.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkTimeStamp.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkTetrahedraRayIntegrator);

namespace
{

using tetralux::SegmentRadiance;
using tetralux::TransferFunction;

/// Memory that one call of Integrate uses again for each segment.
struct Scratch
{
  std::vector<double> Near;
  std::vector<double> Far;
  std::vector<double> Cuts;
  TransferFunction Line;
};

/// Adds a segment on which colour and attenuation are linear.
void AddLinear(const TransferFunction::Value& front, const TransferFunction::Value& back,
  double length, TransferFunction& line, SegmentRadiance& radiance)
{
  line.Nodes.resize(2);
  line.Nodes[0] = { 0, front, front };
  line.Nodes[1] = { 1, back, back };
  radiance.AddBehind(tetralux::IntegrateEmissionAbsorption(line, 0, 1, length));
}

/// Colour and attenuation, neither of them ever negative, of linear functions at 0 or 1 from their
/// values at 1/3 and 2/3.
TransferFunction::Value Extrapolate(
  const TransferFunction::Value& near, const TransferFunction::Value& beyond)
{
  TransferFunction::Value value;
  for (int c = 0; c < 3; ++c)
  {
    value.Color[c] = 2 * near.Color[c] - beyond.Color[c];
  }
  value.Attenuation = std::max(0., 2 * near.Attenuation - beyond.Attenuation);
  return value;
}

/// Adds a cloud that shares the space of others.
void Mix(const TransferFunction::Value& cloud, TransferFunction::Value& mixture)
{
  const double sum = mixture.Attenuation + cloud.Attenuation;
  const double share = sum > 0 ? cloud.Attenuation / sum : 0;
  for (int c = 0; c < 3; ++c)
  {
    mixture.Color[c] += share * (cloud.Color[c] - mixture.Color[c]);
  }
  mixture.Attenuation = sum;
}

/// Adds a segment of clouds that share space, a function for each.
void AddMixture(const std::vector<TransferFunction>& functions, double length, Scratch& s,
  SegmentRadiance& radiance)
{
  s.Cuts.assign({ 0, 1 });
  for (std::size_t j = 0; j < functions.size(); ++j)
  {
    for (const TransferFunction::Node& node : functions[j].Nodes)
    {
      if ((node.Scalar < s.Near[j]) != (node.Scalar < s.Far[j]))
      {
        s.Cuts.push_back((node.Scalar - s.Near[j]) / (s.Far[j] - s.Near[j]));
      }
    }
  }
  std::sort(s.Cuts.begin(), s.Cuts.end());
  for (std::size_t k = 0; k + 1 < s.Cuts.size(); ++k)
  {
    const double width = s.Cuts[k + 1] - s.Cuts[k];
    TransferFunction::Value front{};
    TransferFunction::Value back{};
    for (std::size_t j = 0; j < functions.size(); ++j)
    {
      // Inside of the piece, where no step is.
      const auto evaluate = [&](double share)
      {
        const double w = s.Cuts[k] + share * width;
        return tetralux::Evaluate(functions[j], (1 - w) * s.Near[j] + w * s.Far[j]);
      };
      const TransferFunction::Value first = evaluate(1. / 3);
      const TransferFunction::Value second = evaluate(2. / 3);
      Mix(Extrapolate(first, second), front);
      Mix(Extrapolate(second, first), back);
    }
    AddLinear(front, back, width * length, s.Line, radiance);
  }
}

/// Grey or red, green and blue as they are, and an opacity.
TransferFunction::Value ToValue(const std::vector<double>& scalars, double unitDistance)
{
  const bool grey = scalars.size() == 2;
  return { { scalars[0], scalars[grey ? 0 : 1], scalars[grey ? 0 : 2] },
    std::max(0., scalars.back()) / unitDistance };
}

/// The property that has the functions of one component as its only ones.
vtkSmartPointer<vtkVolumeProperty> SelectComponent(vtkVolumeProperty* property, int component)
{
  auto selected = vtkSmartPointer<vtkVolumeProperty>::New();
  if (property->GetColorChannels(component) == 3)
  {
    selected->SetColor(property->GetRGBTransferFunction(component));
  }
  else
  {
    selected->SetColor(property->GetGrayTransferFunction(component));
  }
  selected->SetScalarOpacity(property->GetScalarOpacity(component));
  selected->SetScalarOpacityUnitDistance(property->GetScalarOpacityUnitDistance(component));
  return selected;
}

/// Length of the longest ray through a volume, in world units; 1 where its bounds are not known.
double GetLongestPath(vtkVolume* volume)
{
  const double* bounds = volume->GetMapper() ? volume->GetBounds() : nullptr;
  const double path = bounds && vtkMath::AreBoundsInitialized(bounds)
    ? std::hypot(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4])
    : 0;
  return path > 0 && std::isfinite(path) ? path : 1;
}

} // namespace

struct vtkTetrahedraRayIntegrator::Optics
{
  /// Of which all the rest was made; only compared.
  const vtkVolumeProperty* Property = nullptr;
  vtkTimeStamp Time;
  int Components = 0;
  double LongestPath = 0;
  double MaximumError = 0;

  /// One for each independent component; empty where components depend on each other, and after an
  /// error.
  std::vector<TransferFunction> Functions;

  /// Where components depend on each other; 0 else.
  double UnitDistance = 0;

  bool IsFor(vtkVolumeProperty* property, int components, double longestPath, double maximumError)
  {
    return this->Property == property && this->Time > property->GetMTime() &&
      this->Components == components && this->LongestPath == longestPath &&
      this->MaximumError == maximumError;
  }

  /// Throws std::invalid_argument, with one line.
  void Make(vtkVolumeProperty* property, int components, double longestPath, double maximumError)
  {
    this->Property = property;
    this->Time.Modified();
    this->Components = components;
    this->LongestPath = longestPath;
    this->MaximumError = maximumError;
    this->Functions.clear();
    this->UnitDistance = 0;
    if (!property->GetIndependentComponents())
    {
      if (components != 2 && components != 4)
      {
        throw std::invalid_argument(
          "components that depend on each other must be 2 or 4, not " + std::to_string(components));
      }
      const double unitDistance = property->GetScalarOpacityUnitDistance();
      if (!(unitDistance > 0) || !std::isfinite(unitDistance))
      {
        throw std::invalid_argument("ScalarOpacityUnitDistance is " + std::to_string(unitDistance) +
          ", it must be a positive number");
      }
      this->UnitDistance = unitDistance;
      return;
    }
    if (components < 1 || components > VTK_MAX_VRCOMP)
    {
      throw std::invalid_argument("the scalars have " + std::to_string(components) +
        " components, a volume property describes at most " + std::to_string(VTK_MAX_VRCOMP));
    }
    std::vector<TransferFunction> functions;
    functions.reserve(components);
    for (int i = 0; i < components; ++i)
    {
      functions.push_back(tetralux::TransferFunctionFromProperty(
        SelectComponent(property, i), maximumError, longestPath)
                            .Function);
    }
    this->Functions = std::move(functions);
  }

  /// Adds a segment between scratch.Near and scratch.Far; nothing after an error.
  void Add(double length, Scratch& scratch, SegmentRadiance& radiance) const
  {
    if (this->Functions.size() == 1)
    {
      radiance.AddBehind(tetralux::IntegrateEmissionAbsorption(
        this->Functions[0], scratch.Near[0], scratch.Far[0], length));
    }
    else if (!this->Functions.empty())
    {
      AddMixture(this->Functions, length, scratch, radiance);
    }
    else if (this->UnitDistance > 0)
    {
      AddLinear(ToValue(scratch.Near, this->UnitDistance), ToValue(scratch.Far, this->UnitDistance),
        length, scratch.Line, radiance);
    }
  }
};

//----------------------------------------------------------------------------
vtkTetrahedraRayIntegrator::vtkTetrahedraRayIntegrator()
  : Current(new Optics)
{
}

//----------------------------------------------------------------------------
vtkTetrahedraRayIntegrator::~vtkTetrahedraRayIntegrator() = default;

//----------------------------------------------------------------------------
void vtkTetrahedraRayIntegrator::Initialize(vtkVolume* volume, vtkDataArray* scalars)
{
  vtkVolumeProperty* property = volume->GetProperty();
  const int components = scalars->GetNumberOfComponents();
  const double longestPath = GetLongestPath(volume);
  if (this->Current->IsFor(property, components, longestPath, this->MaximumError))
  {
    return;
  }
  try
  {
    this->Current->Make(property, components, longestPath, this->MaximumError);
  }
  catch (const std::invalid_argument& error)
  {
    vtkErrorMacro(<< error.what());
  }
}

//----------------------------------------------------------------------------
void vtkTetrahedraRayIntegrator::Integrate(vtkDoubleArray* intersectionLengths,
  vtkDataArray* nearIntersections, vtkDataArray* farIntersections, float color[4])
{
  const auto components = static_cast<std::size_t>(this->Current->Components);
  Scratch scratch;
  scratch.Near.resize(components);
  scratch.Far.resize(components);
  // All segments together, before the colours are rounded.
  SegmentRadiance radiance{ { color[0], color[1], color[2] }, color[3], 1. - color[3] };
  for (vtkIdType i = 0; i < intersectionLengths->GetNumberOfTuples(); ++i)
  {
    const double length = intersectionLengths->GetValue(i);
    bool usable = std::isfinite(length) && length > 0;
    for (std::size_t j = 0; j < components; ++j)
    {
      scratch.Near[j] = nearIntersections->GetComponent(i, static_cast<int>(j));
      scratch.Far[j] = farIntersections->GetComponent(i, static_cast<int>(j));
      usable = usable && std::isfinite(scratch.Near[j]) && std::isfinite(scratch.Far[j]);
    }
    if (usable)
    {
      this->Current->Add(length, scratch, radiance);
    }
  }
  for (int c = 0; c < 3; ++c)
  {
    color[c] = static_cast<float>(radiance.Color[c]);
  }
  color[3] = static_cast<float>(radiance.Opacity);
}

//----------------------------------------------------------------------------
void vtkTetrahedraRayIntegrator::SetMaximumError(double error)
{
  if (std::isnan(error))
  {
    vtkErrorMacro("MaximumError: nan is not a number from 1e-09 to 1");
    return;
  }
  const double accepted = std::clamp(error, 1e-9, 1.);
  if (this->MaximumError != accepted)
  {
    this->MaximumError = accepted;
    this->Modified();
  }
}

//----------------------------------------------------------------------------
void vtkTetrahedraRayIntegrator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumError: " << this->MaximumError << "\n";
}
