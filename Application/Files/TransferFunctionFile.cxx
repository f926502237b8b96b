// SPDX-License-Identifier: BSD-3-Clause
#include "Files/TransferFunctionFile.h"

#include "CommandLine/CommandErrors.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <vector>

namespace
{

using Json = nlohmann::json;

/// Returns the numbers of a member, four for each node; empty if there is no such member.
std::vector<double> GetNodes(
  const Json& preset, const char* member, const std::string& shape, const std::string& where)
{
  const auto found = preset.find(member);
  if (found == preset.end())
  {
    return {};
  }
  std::vector<double> values;
  bool good = found->is_array() && !found->empty() && found->size() % 4 == 0;
  for (std::size_t i = 0; good && i < found->size(); ++i)
  {
    const Json& value = (*found)[i];
    good = value.is_number() && std::isfinite(value.get<double>());
    if (good)
    {
      values.push_back(value.get<double>());
      // All numbers but the scalar are fractions.
      good = i % 4 == 0 || (values.back() >= 0 && values.back() <= 1);
    }
  }
  if (!good)
  {
    throw WorkError(where + member + " must be a list of " + shape +
      " for each node, numbers that are from 0 to 1 but for x");
  }
  for (std::size_t i = 4; i < values.size(); i += 4)
  {
    if (values[i] < values[i - 4])
    {
      throw WorkError(where + member + " must be in ascending order of x");
    }
  }
  return values;
}

void SetColorSpace(const Json& preset, const std::string& where, vtkColorTransferFunction* color)
{
  const auto found = preset.find("ColorSpace");
  const std::string space = found == preset.end() ? "RGB"
    : found->is_string()                          ? found->get<std::string>()
                                                  : found->dump();
  if (space == "RGB")
  {
    color->SetColorSpaceToRGB();
  }
  else if (space == "HSV")
  {
    color->SetColorSpaceToHSV();
    color->SetHSVWrap(preset.value("HSVWrap", 0));
  }
  else if (space == "Lab" || space == "CIELAB")
  {
    color->SetColorSpaceToLab();
  }
  else if (space == "Lab/CIEDE2000")
  {
    color->SetColorSpaceToLabCIEDE2000();
  }
  else if (space == "Diverging")
  {
    color->SetColorSpaceToDiverging();
  }
  else if (space == "Step")
  {
    color->SetColorSpaceToStep();
  }
  else
  {
    throw WorkError(where + "ColorSpace '" + space +
      "' is none of RGB, HSV, Lab, Lab/CIEDE2000, Diverging, Step");
  }
}

void SetCoolToWarm(const double range[2], vtkColorTransferFunction* color)
{
  color->SetColorSpaceToDiverging();
  color->AddRGBPoint(range[0], 0.231373, 0.298039, 0.752941);
  color->AddRGBPoint(0.5 * (range[0] + range[1]), 0.865003, 0.865003, 0.865003);
  color->AddRGBPoint(range[1], 0.705882, 0.0156863, 0.14902);
}

void SetRamp(const double range[2], vtkPiecewiseFunction* opacity)
{
  opacity->AddPoint(range[0], 0);
  opacity->AddPoint(range[1], 1);
}

} // namespace

void ReadTransferFunction(const std::string& fileName, ColorAndOpacity& functions)
{
  const std::string where = "transfer function '" + fileName + "': ";
  std::ifstream file(fileName);
  if (!file)
  {
    throw WorkError("cannot read '" + fileName + "': " + std::strerror(errno));
  }
  try
  {
    const Json document = Json::parse(file);
    if (document.is_array() && document.empty())
    {
      throw WorkError(where + "the list of presets is empty");
    }
    const Json& preset = document.is_array() ? document.front() : document;
    if (!preset.is_object())
    {
      throw WorkError(where + "it is no preset, which is an object with RGBPoints and Points");
    }
    if (preset.value("UseLogScale", 0) != 0)
    {
      throw WorkError(where + "logarithmic colour maps (UseLogScale) are not supported");
    }
    const std::vector<double> colors = GetNodes(preset, "RGBPoints", "x, r, g, b", where);
    const std::vector<double> opacities =
      GetNodes(preset, "Points", "x, opacity, midpoint, sharpness", where);
    if (colors.empty() && opacities.empty())
    {
      throw WorkError(where + "it has neither RGBPoints nor Points");
    }

    const std::vector<double>& ranged = colors.empty() ? opacities : colors;
    const double range[2] = { ranged.front(), ranged[ranged.size() - 4] };
    functions.Color->AllowDuplicateScalarsOn(); // two nodes at one scalar are a step
    functions.Opacity->AllowDuplicateScalarsOn();
    if (colors.empty())
    {
      SetCoolToWarm(range, functions.Color);
    }
    else
    {
      SetColorSpace(preset, where, functions.Color);
    }
    for (std::size_t i = 0; i < colors.size(); i += 4)
    {
      functions.Color->AddRGBPoint(colors[i], colors[i + 1], colors[i + 2], colors[i + 3]);
    }
    if (opacities.empty())
    {
      SetRamp(range, functions.Opacity);
    }
    for (std::size_t i = 0; i < opacities.size(); i += 4)
    {
      functions.Opacity->AddPoint(
        opacities[i], opacities[i + 1], opacities[i + 2], opacities[i + 3]);
    }
  }
  catch (const Json::parse_error& error)
  {
    throw WorkError(where + "it is not JSON (at byte " + std::to_string(error.byte) + ")");
  }
  catch (const Json::exception& error)
  {
    throw WorkError(where + error.what());
  }
}

void MakeDefaultTransferFunction(const double range[2], ColorAndOpacity& functions)
{
  const double half = range[0] == range[1] ? std::max(std::abs(range[0]), 1.0) / 2 : 0;
  const double widened[2] = { range[0] - half, range[1] + half };
  SetCoolToWarm(widened, functions.Color);
  SetRamp(widened, functions.Opacity);
}
