// SPDX-License-Identifier: BSD-3-Clause
#ifndef FileChecks_h
#define FileChecks_h

#include <string>
#include <vector>

/// What is looked at before a reader gets a file, because VTK's readers crash, or print many lines
/// of their own, at a file of another format. Each function throws WorkError with the file's name.
///@{
/// The file is there and is no folder.
void CheckReadable(const std::string& fileName);

/// The file begins with one of some texts. format names what it should be, as "an Exodus file".
void CheckBeginning(const std::string& fileName, const std::vector<std::string>& beginnings,
  const std::string& format);

/// One of some words, in capitals, is among the first lines, in letters of any size.
void CheckWords(
  const std::string& fileName, const std::vector<std::string>& words, const std::string& format);

/// A text file, if it is one, closes as many parentheses as it opens.
void CheckParentheses(const std::string& fileName);

/// An AVS UCD file, not one of Abaqus, which has the same extension.
void CheckUcd(const std::string& fileName);

/// A VTK XML file that is adaptively refined numbers its levels, and the data sets in each.
void CheckAmrLevels(const std::string& fileName);
///@}

#endif
