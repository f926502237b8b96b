// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FrameStatistics_h
#define tetralux_FrameStatistics_h

#include <string>

class vtkOrderedVolume;

namespace tetralux
{

/// The statistics of a mapper, as JSON, and what compositing took if several processes drew.
std::string MakeFrameStatistics(const std::string& ofMapper, vtkOrderedVolume* shown);

} // namespace tetralux

#endif
