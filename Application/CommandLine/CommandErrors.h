// SPDX-License-Identifier: BSD-3-Clause
#ifndef CommandErrors_h
#define CommandErrors_h

#include <stdexcept>

/// The command line is wrong: exit status 2. The text is one line that names the option and says
/// what would be right.
class UsageError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The command line is right, but the work could not be done: exit status 1. The text is one line
/// that names the file and says what is wrong with it.
class WorkError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

#endif
