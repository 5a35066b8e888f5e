// SPDX-License-Identifier: BSD-3-Clause
// The only exception type of the library. Its text names the argument or variable, the cause and the remedy in one
// line.
#pragma once

#include <cstdarg>
#include <cstdio>
#include <exception>

#include "core/compiler.hpp"

namespace cairn {

enum class ErrorCode { argument, buffer, capacity, not_found, numerical, state, callback };

class Error : public std::exception {
 public:
  CAIRN_PRINTF(3, 4) Error(ErrorCode code, const char* format, ...) : code_(code) {
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text_, sizeof text_, format, arguments);
    va_end(arguments);
  }
  ErrorCode code() const { return code_; }
  const char* what() const noexcept override { return text_; }

 private:
  ErrorCode code_;
  char text_[256];
};

}  // namespace cairn
