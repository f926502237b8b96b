// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchSetting.h"

#include <algorithm>

bool IsPeer(const BenchSetting& setting) { return setting.Method.rfind("vtk-", 0) == 0; }

bool RendersImages(const BenchSetting& setting)
{
  const std::string& method = setting.Method;
  return method == "triangle-caster" || method == "vtk-fixed-point" || method == "vtk-gpu";
}

bool HasFloatPicture(const BenchSetting& setting)
{
  const bool coarse = std::any_of(setting.Assignments.begin(), setting.Assignments.end(),
    [](const std::string& text) { return text.rfind("ImageSampleDistance=", 0) == 0; });
  return !IsPeer(setting) && !coarse;
}
