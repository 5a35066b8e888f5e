// SPDX-License-Identifier: BSD-3-Clause
// Formats a line on the stack: nothing allocates.
#include "slam/log.hpp"

#include <cstdarg>
#include <cstdio>

namespace cairn {

void Log::say(const char* format, ...) const {
  if (function_ == nullptr) return;
  char line[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  function_(payload_, line);
}

}  // namespace cairn
