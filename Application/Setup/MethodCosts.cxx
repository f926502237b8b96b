// SPDX-License-Identifier: BSD-3-Clause
#include "Setup/MethodCosts.h"

#include "Intake/DataSetBlocks.h"

#include "vtkDataSet.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace
{

/// Seconds. What is drawn was measured on software OpenGL.
struct MethodCosts
{
  const char* Method;
  double DrawBase;    ///< of any picture
  double DrawCell;    ///< of each tetrahedron
  double DrawStep;    ///< of each tetrahedron at each pixel
  double DrawPath;    ///< of each time that a ray enters the mesh
  double PrepareCell; ///< of each tetrahedron, by the processor before the first picture is drawn
};

// Fitted by Testing/Benchmarks/when_ray_casting_pays.py, see Documentation/Benchmarks.md: llvmpipe
// with two threads. A frame is missed by a factor of 1.3 and 1.5.
constexpr MethodCosts Costs[] = {
  { "gpu-ray-cast", 0.0048, 1.6e-08, 9.1e-09, 4.6e-07, 3.3e-07 },
  { "projection", 0.006, 2.7e-07, 1.5e-08, 0, 5.4e-07 },
};

/// How many times faster than llvmpipe a graphics card draws. An assumption: no card was measured.
/// A larger number is for gpu-ray-cast, since projection leaves more work to the processor.
constexpr double CardSpeed = 100;

/// Tetrahedra behind a pixel of the picture over the cube root of their number: measured were 0.65
/// of heat sinks, 0.67 of the blunt fin, 1.0 of plates and 4.9 of bars seen from their end.
constexpr double RelativeDepth = 0.7;

/// A hexahedron is split into five or six tetrahedra.
constexpr std::int64_t TetrahedraOfCell = 5;
constexpr int PointsOfTetrahedron = 4;

std::string FormatMilliseconds(double seconds)
{
  std::ostringstream text;
  text << std::setprecision(2) << 1e3 * seconds;
  return 1e3 * seconds < 100 ? text.str() + " ms"
                             : std::to_string(std::lround(1e3 * seconds)) + " ms";
}

} // namespace

std::int64_t EstimateTetrahedra(vtkDataObject* data)
{
  std::int64_t tetrahedra = 0;
  for (const tetralux::DataSetBlock& block : tetralux::CollectDataSets(data))
  {
    const bool areSplit = block.DataSet->GetMaxCellSize() > PointsOfTetrahedron;
    tetrahedra += (areSplit ? TetrahedraOfCell : 1) * block.DataSet->GetNumberOfCells();
  }
  return tetrahedra;
}

double PredictSeconds(const std::string& method, const PictureWork& work)
{
  for (const MethodCosts& costs : Costs)
  {
    if (costs.Method != method)
    {
      continue;
    }
    const auto cells = static_cast<double>(work.Tetrahedra);
    const double paths = static_cast<double>(work.Width) * work.Height;
    const double steps = paths * RelativeDepth * std::cbrt(cells);
    const double drawing =
      costs.DrawBase + costs.DrawCell * cells + costs.DrawStep * steps + costs.DrawPath * paths;
    return costs.PrepareCell * cells + drawing / CardSpeed;
  }
  throw std::logic_error("no costs are known of the method '" + method + "'");
}

void RankMethods(const PictureWork& work, std::vector<MethodChoice>& methods)
{
  const auto find = [&methods](const char* name)
  {
    return std::find_if(methods.begin(), methods.end(),
      [name](const MethodChoice& choice) { return choice.Method == name; });
  };
  const auto rayCast = find("gpu-ray-cast");
  const auto projection = find("projection");
  if (rayCast == methods.end() || projection == methods.end())
  {
    return;
  }
  const double rayCastSeconds = PredictSeconds(rayCast->Method, work);
  const double projectionSeconds = PredictSeconds(projection->Method, work);
  const std::string times = ": predicted are " + FormatMilliseconds(rayCastSeconds) +
    " by gpu-ray-cast and " + FormatMilliseconds(projectionSeconds) + " by projection";
  rayCast->Reason += times;
  projection->Reason += times;
  if ((projectionSeconds < rayCastSeconds) != (projection < rayCast))
  {
    std::iter_swap(projection, rayCast);
  }
}
