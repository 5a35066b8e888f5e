// SPDX-License-Identifier: BSD-3-Clause
// The caller's log of a filter: lines of text, silent by default.
#pragma once

#include "core/compiler.hpp"
#include "core/error.hpp"

namespace cairn {

class Log {
 public:
  using Function = void (*)(void* payload, const char* line);

  void set(Function function, void* payload) { function_ = function, payload_ = payload; }
  CAIRN_PRINTF(2, 3) void say(const char* format, ...) const;

  // Makes the call. A numerical error is also written to the log, because the caller may only look at the status.
  template <class Call>
  void watch(Call&& call) const {
    try {
      call();
    } catch (const Error& error) {
      if (error.code() == ErrorCode::numerical) say("%s", error.what());
      throw;
    }
  }

 private:
  Function function_ = nullptr;
  void* payload_ = nullptr;
};

}  // namespace cairn
