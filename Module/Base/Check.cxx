// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Check.h"

#include <cstdio>
#include <cstdlib>

namespace tetralux
{

void FailCheck(const char* condition, const char* file, int line)
{
  std::fprintf(stderr, "%s:%d: check failed: %s\n", file, line, condition);
  std::abort();
}

} // namespace tetralux
