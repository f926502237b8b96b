// SPDX-License-Identifier: BSD-3-Clause
#ifndef WriteSeries_h
#define WriteSeries_h

#include "Files/FileSeries.h"

#include <string>
#include <vector>

/// Writes a .pvd file, ParaView's list of the files of time steps, whose names are relative to it.
/// path: where to write. name: what the error calls the file. Throws WorkError.
void WritePvd(
  const std::vector<SeriesStep>& steps, const std::string& path, const std::string& name);

#endif
