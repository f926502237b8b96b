// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_RayScene_h
#define tetralux_RayScene_h

#include "RayCast/RayCaster.h"
#include "ReferenceRenderer.h"
#include "ReferenceScenes.h"

#include <optional>
#include <vector>

namespace tetralux
{

/// All that makes a picture, in terms of the input: the ray caster and the reference render it.
struct RayScene
{
  TetrahedralMesh Mesh;
  std::vector<double> Scalars; ///< one for each point, or for each cell
  bool CellScalars = false;
  TransferFunction Function;
  OpticalModel Model = OpticalModel::EmissionAbsorption;
  std::vector<Isosurface> Isosurfaces; ///< ascending in value
  bool Shaded = false;
  bool SmoothShading = false;
  std::vector<Light> Lights;
  RayGrid Grid;
  RayLimits Limits;
  std::vector<float> MaximumDistances; ///< empty: none

  RayLimits GetLimits() const;
  ReferenceMesh GetReferenceMesh() const;
  ReferenceOptics GetReferenceOptics() const;
  ReferenceImage RenderReference() const;

  /// How much the given pixels are grazed, see MeasureGrazing.
  std::vector<double> MeasureGrazing(
    const ReferenceImage& image, Span<const std::uint8_t> pixels) const;

  /// A ray caster with the mesh, the scalars in its order, and what rays gather.
  VolumeScene MakeVolumeScene() const;
};

struct RayPicture
{
  std::vector<float> Colors;
  std::vector<float> Depths;
  RayCastStatistics Statistics;
};

RayPicture Cast(VolumeScene& volume, const RayScene& scene, const RayCastOptions& options = {});

/// The kernels for any processor, or else the widest.
std::optional<InstructionSet> ChooseKernels(bool portable);

/// A field between 0 and 1 over the box of a mesh, smooth and without symmetry.
std::vector<double> MakeSmoothField(const TetrahedralMesh& mesh);

/// Colours and attenuations over 0..1, up to the given attenuation per world unit.
TransferFunction MakeColorfulFunction(double largestAttenuation);

} // namespace tetralux

#endif
