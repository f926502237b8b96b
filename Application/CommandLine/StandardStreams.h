// SPDX-License-Identifier: BSD-3-Clause
#ifndef StandardStreams_h
#define StandardStreams_h

#include <string>

/// Opens those of the standard streams that the caller has closed, so that no file of the tool gets
/// their numbers. Reading and writing them fails as before.
void OpenStandardStreams();

/// Replaces control characters, such as line breaks in file names, by what C writes for them.
std::string EscapeControls(const std::string& text);

/// Prints one line, "tetralux: message", on standard error, with control characters escaped.
void PrintMessage(const std::string& message);

/// Throws WorkError if anything written to standard output did not get there.
void CheckStandardOutput();

#endif
