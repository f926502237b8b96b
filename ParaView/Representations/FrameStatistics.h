// SPDX-License-Identifier: BSD-3-Clause
#ifndef tetralux_FrameStatistics_h
#define tetralux_FrameStatistics_h

#include <string>

class vtkOrderedVolume;

namespace tetralux
{

/// The statistics of a mapper, as JSON. If several processes drew, also what compositing took and
/// how much of the data had been distributed anew.
std::string MakeFrameStatistics(const std::string& ofMapper, vtkOrderedVolume* shown);

} // namespace tetralux

#endif
