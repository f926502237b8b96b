// SPDX-License-Identifier: BSD-3-Clause
#include "FrameStatistics.h"

#include "Report/Json.h"
#include "vtkOrderedVolume.h"

namespace tetralux
{

std::string MakeFrameStatistics(const std::string& ofMapper, vtkOrderedVolume* shown)
{
  if (shown->GetNumberOfBytes() == 0)
  {
    return ofMapper;
  }
  Json statistics = Json::parse(ofMapper);
  statistics["composited"] = {
    { "bytes", shown->GetNumberOfBytes() },
    { "seconds", shown->GetSeconds() },
  };
  statistics["distributed"] = { { "bytes", shown->GetNumberOfDistributedBytes() } };
  return statistics.dump();
}

} // namespace tetralux
