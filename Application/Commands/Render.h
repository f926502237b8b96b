// SPDX-License-Identifier: BSD-3-Clause
#ifndef Render_h
#define Render_h

#include "Setup/SceneOptions.h"

#include <optional>
#include <string>
#include <vector>

/// What the options of `tetralux render` say.
struct RenderOptions
{
  SceneOptions Scene;

  std::string Method = "auto";
  std::vector<double> SlicePlane; ///< a point and the normal of BlendMode=slice; may be empty
  std::vector<double> Isovalues;  ///< empty: a volume, not surfaces
  std::string ColorArray;         ///< empty: a surface has the colour of its value
  bool Shade = false;             ///< lights the volume; surfaces are always lit
  SceneOptions::Vector Background = { 0, 0, 0 }; ///< red, green, blue, 0..1
  std::optional<double> MaximumError;            ///< of a colour channel, 0..1
  std::vector<std::string> Settings;             ///< "Property=Value"

  bool PrintStatistics = false;
  std::string StatisticsFile; ///< empty: none
  std::string Output;
};

/// Renders one picture. Throws UsageError before anything is read, WorkError after.
void RenderPicture(const RenderOptions& options);

#endif
