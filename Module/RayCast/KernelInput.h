// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_KernelInput_h
#define tetralux_KernelInput_h

// From a scene to what the kernels of the ray caster read.

#include "RayCast/RayCastKernel.h"
#include "RayCast/RayCastOptions.h"
#include "Scene/VolumeScene.h"

#include <array>
#include <vector>

namespace tetralux
{

/// How the rays of a picture are cast.
struct CastChoices
{
  Integrator Method = Integrator::ClosedForm;
  bool CellData = false;      ///< scalars are at cells
  bool Lit = false;           ///< lights shine on what rays gather
  bool SmoothShading = false; ///< by gradients of points; else of cells
  bool DoublePrecision = false;
  double WorldRadius = 0;             ///< of the mesh, where the world stretches it most
  double Brightness = 1;              ///< FindLargestBrightness
  double LightError = 0;              ///< of light that varies in cells
  double GeometryError = 0;           ///< what rounding geometry may change
  double TerminationError = 0;        ///< what may be lost behind a ray's early end; 0: rays go on
  const WalkTables* Tables = nullptr; ///< what rays are walked through
};

/// What the kernels read, with the memory that neither the scene nor the caller owns.
struct OwningKernelInput : KernelInput
{
  std::vector<std::array<float, 2>> NeighborsOfSurfaces;
  std::vector<float> ColorsOfSurfaces;
  KernelLighting Light{};
  std::vector<KernelLight> Lights;
  KernelTable Lookup{};
  IntervalColumns FewIntervals{};
  KernelComponents SeveralScalars{};

  OwningKernelInput()
    : KernelInput{}
  {
  }
  // The base points into this object.
  OwningKernelInput(const OwningKernelInput&) = delete;
  OwningKernelInput& operator=(const OwningKernelInput&) = delete;
};

/// Fills all of in but Colors and Depths, from a scene that is prepared for the choices. What is
/// passed must outlive in.
void FillKernelInput(const VolumeScene& scene, const RayGrid& grid, const RayLimits& limits,
  const RayCastOptions& options, const CastChoices& choices, OwningKernelInput& in);

} // namespace tetralux

#endif
