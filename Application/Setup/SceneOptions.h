// SPDX-License-Identifier: BSD-3-Clause
#ifndef SceneOptions_h
#define SceneOptions_h

#include "Files/InputFile.h"

#include <array>
#include <optional>
#include <string>

/// What the options say about a scene: input, scalars, transfer function, camera and size of the
/// picture. An option that is not given leaves its member empty, and the scene decides.
struct SceneOptions
{
  using Vector = std::array<double, 3>;

  InputFile Input;
  std::string Array;
  std::string Component; ///< "magnitude" or a number counted from 0
  std::string TransferFile;
  std::optional<double> OpacityUnitDistance; ///< units of the data

  std::optional<Vector> CameraPosition;
  std::optional<Vector> CameraFocalPoint;
  std::optional<Vector> CameraViewUp;
  std::optional<double> CameraViewAngle;     ///< degrees, vertical
  std::optional<double> CameraParallelScale; ///< half of the picture's height, units of the data

  int Width = 512;
  int Height = 512;
  int NumberOfThreads = 0; ///< 0: one for each core
};

/// The unit distance of opacity if none is given, as a fraction of the diagonal of the bounds.
constexpr double DefaultUnitDistanceFraction = 1.0 / 20;

#endif
