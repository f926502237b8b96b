// SPDX-License-Identifier: BSD-3-Clause
#ifndef OptionValues_h
#define OptionValues_h

#include <string>
#include <utility>
#include <vector>

/// Each function reads the value of an option. It throws UsageError if the text has anything else
/// in it, or a number that is not finite. The error names the option, repeats the text and says
/// what would be right. Integers may be hexadecimal, as 0x2000.
///@{
double ParseNumber(const std::string& option, const std::string& text);

/// A number above 0.
double ParsePositive(const std::string& option, const std::string& text);

int ParseInteger(const std::string& option, const std::string& text, int minimum, int maximum);

/// One number or more, with commas between.
std::vector<double> ParseNumbers(const std::string& option, const std::string& text);

/// count numbers with commas between; shape shows them in the error, as "X,Y,Z".
std::vector<double> ParseNumbers(
  const std::string& option, const std::string& text, std::size_t count, const std::string& shape);

/// "Name=Value", with a name that is not empty.
std::pair<std::string, std::string> ParseAssignment(
  const std::string& option, const std::string& text);
///@}

/// Returns the extension of a file name in small letters with its dot, as ".vtu"; empty: none.
std::string GetExtension(const std::string& fileName);

/// Formats a number with at most six digits, without zeros at its end.
std::string FormatNumber(double value);

/// Returns "a, b and c".
std::string JoinNames(const std::vector<std::string>& names);

#endif
