// SPDX-License-Identifier: BSD-3-Clause
#ifndef Render_h
#define Render_h

#include <array>
#include <optional>
#include <string>
#include <vector>

/// What the options of `tetralux render` say; what is not given is left to the scene.
struct RenderOptions
{
  using Vector = std::array<double, 3>;

  std::string Input;
  std::string Plot3dSolution;
  std::string Array;
  std::string Component;
  std::string Method = "auto";
  std::string TransferFile;
  std::optional<double> OpacityUnitDistance;
  std::vector<double> Isovalues; ///< empty: a volume, not surfaces
  bool Shade = false;            ///< lights the volume; surfaces are lit in any case

  std::optional<Vector> CameraPosition;
  std::optional<Vector> CameraFocalPoint;
  std::optional<Vector> CameraViewUp;
  std::optional<double> CameraViewAngle; ///< degrees, vertical
  std::optional<double> CameraParallelScale;

  int Width = 512;
  int Height = 512;
  Vector Background = { 0, 0, 0 };

  std::optional<double> MaximumError;
  int NumberOfThreads = 0;
  std::vector<std::string> Settings; ///< "Property=Value"

  bool PrintStatistics = false;
  std::string StatisticsFile;
  std::string Output;
};

/// The unit distance of opacity where none is given, as a fraction of the diagonal of the bounds.
constexpr double DefaultUnitDistanceFraction = 1.0 / 20;

/// Renders one picture. Throws UsageError before anything is read, WorkError after.
void RenderPicture(const RenderOptions& options);

#endif
