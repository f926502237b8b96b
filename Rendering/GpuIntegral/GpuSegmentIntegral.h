// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_GpuSegmentIntegral_h
#define tetralux_GpuSegmentIntegral_h

// What a segment of a ray adds to a picture, in shaders: the GLSL functions, the arrays that they
// read, and their uniforms. For both mappers that draw on the graphics card.

#include "Base/Cached.h"
#include "Base/Span.h"
#include "GpuIntegral/GpuSegmentTable.h"
#include "Integral/Integrator.h"
#include "OpenGL/TextureBuffer.h"
#include "Optics/IntervalTable.h"
#include "Optics/LightSteps.h"
#include "Optics/OpticalModel.h"
#include "TetraluxRenderingModule.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkWindow;

namespace tetralux
{

class VolumeScene;

/// What segments are integrated of.
struct SegmentSource
{
  tetralux::Integrator Integrator = tetralux::Integrator::ClosedForm;

  /// Of Integrator::OpticalDepth: what contributes has this colour; absorption alone has none, 0.
  double Color[3] = { 0, 0, 0 };

  /// What intervals and surfaces were made from; empty: they may differ from those of the last
  /// source.
  CacheKey Key;

  /// The transfer function; of no use to Isosurfaces. Scalars at points are mapped as in this
  /// table.
  const IntervalTable* Intervals = nullptr;

  /// Isosurfaces: ascending in value, their values mapped as the scalars are.
  std::vector<Isosurface> Surfaces;

  /// Of tabulated integrators: the table. Another version tells that it changed.
  const PreIntegrationTable* Table = nullptr;
  std::uint64_t TableVersion = 0;

  /// Interpolate in the table by the shader even where the graphics card is right enough: for tests
  /// and measurements of it.
  bool FilterInShader = false;

  /// No segment is longer, world units. Where all of them are thin, the shader is without what
  /// thick ones need.
  double LongestSegment = std::numeric_limits<double>::infinity();

  /// Whether isosurfaces are lit; of volumes the integrator tells.
  bool ShadedSurfaces = false;

  /// Scalars at cells: one value for each; empty where scalars are at points. Another version tells
  /// that they changed.
  Span<const CellValue> CellValues;
  std::uint64_t CellValuesVersion = 0;
};

/// Of a scene that is prepared, as long as it does not change; its segments of any length.
/// lighting: of what can be lit.
TETRALUXRENDERING_EXPORT SegmentSource MakeSegmentSource(
  const VolumeScene& scene, Lighting lighting);

/// GLSL 1.50 functions for what a source asks for; all colours are premultiplied.
///
///   vec4 IntegrateSegment(float front, float back, float len)
///
/// red, green, blue and opacity of a segment along which the mapped scalar runs linearly from front
/// to back, len world units long: emission and absorption, in closed form, by table, or by optical
/// depth where the colour is constant; absorption alone (colour 0); emission alone (opacity 0; it
/// may exceed 1); flat isosurfaces. A scalar that is not a number makes the segment contribute
/// nothing. The opacity keeps its relative accuracy where it is tiny: gather opacities, not
/// transmittances.
///
///   vec4 IntegrateShadedSegment(float front, float back, float len, vec3 frontGradient,
///     vec3 backGradient, vec3 frontPoint, vec3 backPoint, vec3 direction)
///
/// the same with light, where it is asked for, after the functions of GpuLighting: of a volume the
/// integral of what is lit, of a surface the light where it is crossed. Gradients at both
/// ends, equal ones for those of cells, are in coordinates of the mesh and of any length; points
/// and the direction are those of Ray in RayGridDec.glsl.
///
///   vec4 IntegrateCell(int cell, float len)
///
/// the same for scalars at cells.
///
///   vec4 ClassifyLargest(float largest)
///
/// for MaximumIntensity, colour and opacity at the largest scalar of the whole ray, which the
/// caller gathers; for scalars at cells from GetCellScalar(int cell). Below -1e30 there was none.
///
/// Errors: single precision throughout; of a segment's channels at most SegmentWeightError of its
/// opacity for each piece between nodes, tested against double precision over the stability cases;
/// by table those of the table, see PreIntegrationTable::Bound.
class TETRALUXRENDERING_EXPORT GpuSegmentIntegral
{
public:
  GpuSegmentIntegral();
  ~GpuSegmentIntegral();

  /// Sends to the graphics card what changed. Throws std::runtime_error, with one line, where there
  /// is no room for it.
  void Update(vtkOpenGLRenderWindow* window, const SegmentSource& source);

  /// The functions, to be put into a shader before its own; they change only where the name does.
  std::string GetDeclarations() const;

  /// The same functions for cells that are drawn once for each interval that they have part in, see
  /// CellDivision.h, where there are such functions. The numbers of the interval are those of
  /// OneIntervalDec.glsl, from a vertex shader that reads transferIntervals. No part is thicker
  /// than GetLargestPartDepth.
  ///@{
  bool HasPartDeclarations() const;
  double GetLargestPartDepth() const;
  std::string GetPartDeclarations() const;
  bool IsCurved() const { return this->Curved; }
  ///@}

  /// How segments are integrated: that of the last source.
  tetralux::Integrator GetIntegrator() const { return this->Integrator; }

  /// For a program that has the declarations and is in use: its uniforms, and the arrays bound to
  /// texture units until Deactivate.
  ///@{
  void Activate(vtkShaderProgram* program);
  void Deactivate();
  ///@}

  /// On the graphics card.
  std::size_t GetNumberOfBytes() const;

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  std::string GetFlatDeclarations() const;
  void UploadIntervals(vtkOpenGLRenderWindow* window, const IntervalTable& table);
  void UploadSurfaces(vtkOpenGLRenderWindow* window, const std::vector<Isosurface>& surfaces);

  tetralux::Integrator Integrator = tetralux::Integrator::ClosedForm;
  bool OfCells = false;
  bool Shaded = false;
  bool OnlyThin = false;
  bool Curved = false; ///< IntervalTable::Curved
  float Color[3] = { 0, 0, 0 };

  TextureBuffer Intervals;
  CacheStamp IntervalsStamp;
  TextureBuffer Buckets;
  GpuSegmentTable Table;
  TextureBuffer Surfaces;
  CacheStamp SurfacesStamp;
  int NumberOfSurfaces = 0;
  TextureBuffer CellValues;
  std::uint64_t CellValuesVersion = 0;
};

} // namespace tetralux

#endif
