// SPDX-License-Identifier: BSD-3-Clause
#ifndef WriteBytes_h
#define WriteBytes_h

#include <string>

/// Each function throws WorkError with the system's own reason, such as a full disk. path: where to
/// write. name: what the error calls the file.
///@{
/// Writes a file.
void WriteText(const std::string& text, const std::string& path, const std::string& name);

/// Copies a file to a pipe or a device; an empty path is standard output.
void CopyToStream(const std::string& file, const std::string& path, const std::string& name);

/// Copies a pipe to a file; an empty path is standard input. name is that of the pipe.
void CopyFromStream(const std::string& path, const std::string& file, const std::string& name);
///@}

/// Returns why the system does not let a file grow, for writers of libraries, which only tell that
/// it did not; empty: it does. Writes to the file, and makes it if the writer has removed it.
std::string FindWriteObstacle(const std::string& path);

#endif
