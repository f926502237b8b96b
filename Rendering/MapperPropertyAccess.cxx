// SPDX-License-Identifier: BSD-3-Clause
#include "MapperPropertyAccess.h"

#include "Properties/PropertySetters.h"

#include "vtkTetrahedraCPUMapper.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"

#include <functional>
#include <map>
#include <string>

namespace tetralux
{

namespace
{

struct Accessors
{
  std::function<std::vector<double>(vtkTetrahedraVolumeMapper*)> Get;
  std::function<void(vtkTetrahedraVolumeMapper*, const std::vector<double>&)> Set;
};

/// Of a property with one number.
template <class MapperT, class NumberT>
Accessors MakeAccessors(NumberT (MapperT::*get)(), void (MapperT::*set)(NumberT))
{
  return { [get](vtkTetrahedraVolumeMapper* mapper) -> std::vector<double>
    { return { static_cast<double>((static_cast<MapperT*>(mapper)->*get)()) }; },
    [set](vtkTetrahedraVolumeMapper* mapper, const std::vector<double>& values)
    { (static_cast<MapperT*>(mapper)->*set)(static_cast<NumberT>(values.front())); } };
}

#define ACCESSORS(mapper, name)                                                                    \
  {                                                                                                \
#name, MakeAccessors(&mapper::Get##name, &mapper::Set##name)                                   \
  }

const std::map<std::string, Accessors>& GetAccessors()
{
  using Base = vtkTetrahedraVolumeMapper;
  using CPU = vtkTetrahedraCPUMapper;
  using Isosurface = vtkTetrahedraIsosurfaceMapper;
  using RayCast = vtkTetrahedraRayCastMapper;
  using GPURayCast = vtkTetrahedraGPURayCastMapper;
  using Projection = vtkTetrahedraProjectionMapper;
  static const std::map<std::string, Accessors> accessors = {
    { "BlendMode",
      { [](Base* mapper) -> std::vector<double>
        { return { static_cast<double>(mapper->GetBlendMode()) }; },
        [](Base* mapper, const std::vector<double>& values)
        { mapper->SetBlendMode(static_cast<int>(values.front())); } } },
    ACCESSORS(Base, MaximumError),
    ACCESSORS(Base, Integration),
    ACCESSORS(Base, TableScalarSize),
    ACCESSORS(Base, TableLengthSize),
    ACCESSORS(Base, TableLengthScale),
    ACCESSORS(Base, TableScalarAxis),
    ACCESSORS(Base, TableFormat),
    ACCESSORS(Base, TableMaximumBytes),
    ACCESSORS(Base, SmoothShading),
    ACCESSORS(Base, MergePoints),
    ACCESSORS(Base, VectorMode),
    ACCESSORS(Base, VectorComponent),
    ACCESSORS(Base, Reentry),
    ACCESSORS(Base, IntermixIntersectingGeometry),
    ACCESSORS(Base, Cropping),
    { "CroppingRegionPlanes",
      { [](Base* mapper)
        {
          const double* planes = mapper->GetCroppingRegionPlanes();
          return std::vector<double>(planes, planes + 6);
        },
        [](Base* mapper, const std::vector<double>& values)
        { mapper->SetCroppingRegionPlanes(values.data()); } } },
    ACCESSORS(Base, CroppingRegionFlags),
    ACCESSORS(CPU, NumberOfThreads),
    ACCESSORS(RayCast, Precision),
    ACCESSORS(CPU, ImageSampleDistance),
    ACCESSORS(CPU, MinimumImageSampleDistance),
    ACCESSORS(CPU, MaximumImageSampleDistance),
    ACCESSORS(CPU, AutoAdjustSampleDistances),
    ACCESSORS(Isosurface, ColorArrayComponent),
    ACCESSORS(Isosurface, Shadows),
    ACCESSORS(Isosurface, ShadowSoftness),
    ACCESSORS(Isosurface, AmbientOcclusion),
    ACCESSORS(Isosurface, AmbientOcclusionRadius),
    ACCESSORS(Isosurface, SamplesPerFrame),
    ACCESSORS(Isosurface, MaximumSamples),
    ACCESSORS(Isosurface, TimeStepCacheBytes),
    ACCESSORS(Isosurface, MaximumNumberOfPeels),
    ACCESSORS(GPURayCast, StepsPerPass),
    ACCESSORS(GPURayCast, RayMaximumBytes),
    ACCESSORS(GPURayCast, CountFragments),
    ACCESSORS(Projection, PerspectiveInterpolation),
    ACCESSORS(Projection, ColorBuffer),
    ACCESSORS(Projection, AlphaDithering),
    ACCESSORS(Projection, Order),
  };
  return accessors;
}

#undef ACCESSORS

} // namespace

unsigned GetKind(vtkTetrahedraVolumeMapper* mapper) { return FindMapperKind(mapper); }

std::vector<double> GetPropertyValues(
  vtkTetrahedraVolumeMapper* mapper, const MapperProperty& property)
{
  return GetAccessors().at(property.Name).Get(mapper);
}

void SetPropertyValues(vtkTetrahedraVolumeMapper* mapper, const MapperProperty& property,
  const std::vector<double>& values)
{
  GetAccessors().at(property.Name).Set(mapper, values);
}

} // namespace tetralux
