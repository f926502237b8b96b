// SPDX-License-Identifier: BSD-3-Clause
#include "MapperPropertyAccess.h"

#include "Properties/PropertySetters.h"

#include "vtkTetrahedraCPUMapper.h"
#include "vtkTetrahedraGPURayCastMapper.h"
#include "vtkTetrahedraIsosurfaceMapper.h"
#include "vtkTetrahedraProjectionMapper.h"
#include "vtkTetrahedraRayCastMapper.h"
#include "vtkTriangleCasterMapper.h"

#include <functional>
#include <map>
#include <string>

namespace tetralux
{

namespace
{

struct Accessors
{
  std::function<std::vector<double>(vtkAbstractVolumeMapper*)> Get;
  std::function<void(vtkAbstractVolumeMapper*, const std::vector<double>&)> Set;
};

using AccessorMap = std::map<std::string, Accessors>;

/// Of a property with one number.
template <class MapperT, class NumberT>
Accessors MakeAccessors(NumberT (MapperT::*get)(), void (MapperT::*set)(NumberT))
{
  return { [get](vtkAbstractVolumeMapper* mapper) -> std::vector<double>
    { return { static_cast<double>((static_cast<MapperT*>(mapper)->*get)()) }; },
    [set](vtkAbstractVolumeMapper* mapper, const std::vector<double>& values)
    { (static_cast<MapperT*>(mapper)->*set)(static_cast<NumberT>(values.front())); } };
}

#define ACCESSORS(mapper, name)                                                                    \
  {                                                                                                \
#name, MakeAccessors(&mapper::Get##name, &mapper::Set##name)                                   \
  }

/// Of a property with several numbers, which are set as an array.
template <class MapperT>
Accessors MakeArrayAccessors(
  std::size_t size, double* (MapperT::*get)(), void (MapperT::*set)(const double*))
{
  return { [size, get](vtkAbstractVolumeMapper* mapper)
    {
      const double* values = (static_cast<MapperT*>(mapper)->*get)();
      return std::vector<double>(values, values + size);
    },
    [set](vtkAbstractVolumeMapper* mapper, const std::vector<double>& values)
    { (static_cast<MapperT*>(mapper)->*set)(values.data()); } };
}

/// What the base class of mappers of cells and the mapper of image data have, each on its own.
template <class MapperT>
AccessorMap MakeCommonAccessors()
{
  return {
    { "BlendMode",
      { [](vtkAbstractVolumeMapper* mapper) -> std::vector<double>
        { return { static_cast<double>(static_cast<MapperT*>(mapper)->GetBlendMode()) }; },
        [](vtkAbstractVolumeMapper* mapper, const std::vector<double>& values)
        { static_cast<MapperT*>(mapper)->SetBlendMode(static_cast<int>(values.front())); } } },
    { "CroppingRegionPlanes",
      MakeArrayAccessors<MapperT>(
        6, &MapperT::GetCroppingRegionPlanes, &MapperT::SetCroppingRegionPlanes) },
    ACCESSORS(MapperT, MaximumError),
    ACCESSORS(MapperT, VectorMode),
    ACCESSORS(MapperT, VectorComponent),
    ACCESSORS(MapperT, IntermixIntersectingGeometry),
    ACCESSORS(MapperT, Cropping),
    ACCESSORS(MapperT, CroppingRegionFlags),
    ACCESSORS(MapperT, ImageSampleDistance),
    ACCESSORS(MapperT, MinimumImageSampleDistance),
    ACCESSORS(MapperT, MaximumImageSampleDistance),
    ACCESSORS(MapperT, AutoAdjustSampleDistances),
  };
}

AccessorMap MakeCasterAccessors()
{
  using Caster = vtkTriangleCasterMapper;
  AccessorMap accessors = {
    { "AverageIPScalarRange",
      MakeArrayAccessors<Caster>(
        2, &Caster::GetAverageIPScalarRange, &Caster::SetAverageIPScalarRange) },
    { "NearColor", MakeArrayAccessors<Caster>(3, &Caster::GetNearColor, &Caster::SetNearColor) },
    { "FarColor", MakeArrayAccessors<Caster>(3, &Caster::GetFarColor, &Caster::SetFarColor) },
    ACCESSORS(Caster, NumberOfThreads),
    ACCESSORS(Caster, MaskType),
    ACCESSORS(Caster, MaskBlendFactor),
    ACCESSORS(Caster, GradientSource),
    ACCESSORS(Caster, LightSum),
    ACCESSORS(Caster, SampleDistance),
    ACCESSORS(Caster, SampleDistanceByError),
    ACCESSORS(Caster, InteractiveSampleDistance),
    ACCESSORS(Caster, SliceShape),
    ACCESSORS(Caster, OpacityModel),
    ACCESSORS(Caster, GradientNorm),
    ACCESSORS(Caster, PreIntegration),
    ACCESSORS(Caster, CorrectOpacity),
    ACCESSORS(Caster, EndTriangles),
    ACCESSORS(Caster, SkipPixels),
    ACCESSORS(Caster, SkipEmptySpace),
    ACCESSORS(Caster, TileSize),
    ACCESSORS(Caster, CastTriangles),
  };
  accessors.merge(MakeCommonAccessors<Caster>());
  return accessors;
}

AccessorMap MakeCellAccessors()
{
  using Base = vtkTetrahedraVolumeMapper;
  using Isosurface = vtkTetrahedraIsosurfaceMapper;
  using RayCast = vtkTetrahedraRayCastMapper;
  using GPURayCast = vtkTetrahedraGPURayCastMapper;
  using Projection = vtkTetrahedraProjectionMapper;
  AccessorMap accessors = {
    ACCESSORS(Base, Integration),
    ACCESSORS(Base, TableScalarSize),
    ACCESSORS(Base, TableLengthSize),
    ACCESSORS(Base, TableLengthScale),
    ACCESSORS(Base, TableScalarAxis),
    ACCESSORS(Base, TableFormat),
    ACCESSORS(Base, TableMaximumBytes),
    ACCESSORS(Base, SmoothShading),
    ACCESSORS(Base, MergePoints),
    ACCESSORS(Base, Reentry),
    ACCESSORS(vtkTetrahedraCPUMapper, NumberOfThreads),
    ACCESSORS(RayCast, Precision),
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
  accessors.merge(MakeCommonAccessors<Base>());
  return accessors;
}

const Accessors& GetAccessors(vtkAbstractVolumeMapper* mapper, const MapperProperty& property)
{
  static const AccessorMap ofCells = MakeCellAccessors();
  static const AccessorMap ofCaster = MakeCasterAccessors();
  return (GetKind(mapper) == TriangleCasterKind ? ofCaster : ofCells).at(property.Name);
}

#undef ACCESSORS

} // namespace

unsigned GetKind(vtkAbstractVolumeMapper* mapper) { return FindMapperKind(mapper); }

std::vector<double> GetPropertyValues(
  vtkAbstractVolumeMapper* mapper, const MapperProperty& property)
{
  return GetAccessors(mapper, property).Get(mapper);
}

void SetPropertyValues(vtkAbstractVolumeMapper* mapper, const MapperProperty& property,
  const std::vector<double>& values)
{
  GetAccessors(mapper, property).Set(mapper, values);
}

} // namespace tetralux
