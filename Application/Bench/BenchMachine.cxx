// SPDX-License-Identifier: BSD-3-Clause
#include "Bench/BenchMachine.h"

#include "vtkVersion.h"

#include <thread>

#include <sys/utsname.h>

namespace
{

/// "x86_64 with AVX2 and FMA"
std::string GetProcessorClass()
{
  utsname names;
  std::string text = uname(&names) == 0 ? names.machine : "unknown";
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx512f"))
  {
    text += " with AVX-512";
  }
  else if (__builtin_cpu_supports("avx2"))
  {
    text += " with AVX2";
  }
#endif
  return text;
}

std::string GetCompiler()
{
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "GCC " __VERSION__;
#else
  return "unknown";
#endif
}

} // namespace

std::vector<std::pair<std::string, std::string>> DescribeMachine(
  const std::string& openGLRenderer, int numberOfThreads)
{
  const unsigned cores = std::thread::hardware_concurrency();
  return {
    { "Tetralux", TETRALUX_VERSION },
    { "Processor", GetProcessorClass() },
    { "Cores", std::to_string(cores) },
    { "Threads of our methods",
      numberOfThreads > 0 ? std::to_string(numberOfThreads)
                          : "one for "
                            "each core" },
    { "OpenGL", openGLRenderer },
    { "VTK", vtkVersion::GetVTKVersion() },
    { "CGAL", TETRALUX_CGAL_VERSION },
    { "Compiler", GetCompiler() },
  };
}
