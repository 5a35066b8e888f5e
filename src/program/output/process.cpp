// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/process.hpp"

#if defined(_WIN32)
#include <windows.h>
// psapi.h needs windows.h before it, and io.h is independent of both.
#include <io.h>
#include <psapi.h>

#include <cstdio>
#else
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace cairn::program {

#if defined(_WIN32)

bool stderr_is_terminal() {
  return _isatty(_fileno(stderr)) != 0;
}

double peak_rss_mib() {
  PROCESS_MEMORY_COUNTERS counters{};
  GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters);
  return static_cast<double>(counters.PeakWorkingSetSize) / (1024 * 1024);
}

#else

bool stderr_is_terminal() {
  return isatty(STDERR_FILENO) == 1;
}

double peak_rss_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#if defined(__APPLE__)
  constexpr double kUnit = 1;  // bytes
#else
  constexpr double kUnit = 1024;
#endif
  return static_cast<double>(usage.ru_maxrss) * kUnit / (1024 * 1024);
}

#endif

}  // namespace cairn::program
