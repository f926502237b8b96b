// SPDX-License-Identifier: BSD-3-Clause
#ifndef FileSeries_h
#define FileSeries_h

#include <string>
#include <vector>

/// One time step of a series of files.
struct SeriesStep
{
  double Time = 0;
  std::vector<std::string> Files; ///< the parts of the step
};

/// Whether a file lists other files: .pvd, and .series as in mesh.vtu.series.
bool IsSeries(const std::string& fileName);

/// The extensions of such files.
const std::vector<std::string>& GetSeriesExtensions();

/// The steps of a series, by ascending time; at least one. Throws WorkError with the file's name.
std::vector<SeriesStep> ReadSeries(const std::string& fileName);

/// Files of Exodus that were written by several processes: mesh.e.4.0 ... mesh.e.4.3. Returns all
/// pieces for the name of any; the file alone for any other name. Throws WorkError for one that is
/// missing.
std::vector<std::string> ListPieces(const std::string& fileName);

/// The extension that decides about the format: ".e" also of mesh.e.4.0 and mesh.e-s002.
std::string GetFormatExtension(const std::string& fileName);

#endif
