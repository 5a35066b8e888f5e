// SPDX-License-Identifier: BSD-3-Clause
// The exception of a call that failed, and what the loaded library says of itself.
#ifndef CAIRN_CPP_ERROR_HPP
#define CAIRN_CPP_ERROR_HPP

#include <cairn/cpp/types.hpp>
#include <stdexcept>
#include <string>

namespace cairn {

/// A call failed and changed nothing. `what()` is the message of the library: one line of UTF-8 that says what was
/// wrong, with which value, and what to do about it.
class Error : public std::runtime_error {
 public:
  Error(Status status, const std::string& message) : std::runtime_error(message), status_(status) {}
  Status status() const noexcept { return status_; }

 private:
  Status status_;
};

//~ cairn_status_name
/// Name of a status, for example "Status::kErrorArgument"; "unknown status" for any other value.
///
/// Complexity: O(1).
inline const char* status_name(Status status) noexcept {
  return cairn_status_name(static_cast<cairn_status>(status));
}

//~ cairn_last_message
/// The message of the last call of this thread that failed, for programs in C: the line that Error would have got, in
/// UTF-8. It is empty before the first failure and stays until the next failure. The library owns the buffer; each
/// thread has its own. A language whose runtime moves calls between threads passes a Error instead.
///
/// Complexity: O(1).
inline std::string last_message() {
  return cairn_last_message();
}

//~ cairn_version
/// Version of the loaded library, for example "0.2.0".
///
/// Complexity: O(1).
inline const char* version() noexcept {
  return cairn_version();
}

//~ cairn_version_number
/// Version of the loaded library as a number, as CAIRN_VERSION is that of the header: 10000 major + 100 minor + patch.
///
/// Complexity: O(1).
inline std::uint32_t version_number() noexcept {
  return cairn_version_number();
}

//~ cairn_has
/// Whether the loaded library has a feature: 1 or 0. Features have names that never change their meaning: "sparse"
/// (sparse joining), "teams", "trajectory", "systematic" (estimated systematic errors), "robust" (robust losses),
/// "health" (verdicts), "errors" (messages in a Error).
///
/// Complexity: O(1).
inline bool has(const std::string& feature) noexcept {
  return cairn_has(feature.c_str()) != 0;
}

//~ cairn_build
/// Instruction set that the loaded library was compiled for: "x86-64" or "x86-64-v3" (on other machines: "generic").
///
/// Complexity: O(1).
inline const char* build() noexcept {
  return cairn_build();
}

//~ cairn_id_none
/// kIdNone, for languages that cannot read a macro.
///
/// Complexity: O(1).
inline std::uint64_t id_none() noexcept {
  return cairn_id_none();
}

//~ cairn_verdict_text
/// A verdict in one word: "good", "doubtful" or "lost"; "unknown" for any other value.
///
/// Complexity: O(1).
inline const char* verdict_text(Verdict verdict) noexcept {
  return cairn_verdict_text(static_cast<cairn_verdict>(verdict));
}

//~ cairn_doubt_text
/// A reason in words, for example "single landmarks contradict the rest". `reason` is one bit; anything else gives
/// "unknown".
///
/// Complexity: O(1).
inline const char* doubt_text(Doubts reason) noexcept {
  return cairn_doubt_text(static_cast<cairn_doubts>(reason));
}

namespace detail {

inline std::string version_text(std::uint32_t number) {
  return std::to_string(number / 10000) + '.' + std::to_string(number / 100 % 100) + '.' + std::to_string(number % 100);
}

/// Before 1.0 a minor version may change every struct, so no call may be made to another one.
inline void require_library() {
  static const bool checked = [] {
    const std::uint32_t loaded = cairn_version_number();
    if (loaded / 100 != kHeaderVersion / 100)
      throw Error(Status::kErrorState, "cairn.hpp " + version_text(kHeaderVersion) + " needs libcairn " +
                                           std::to_string(kHeaderVersionMajor) + '.' +
                                           std::to_string(kHeaderVersionMinor) + ", and libcairn " +
                                           version_text(loaded) + " is loaded");
    return true;
  }();
  static_cast<void>(checked);
}

struct CallError : cairn_error {
  CallError() noexcept { struct_size = sizeof(cairn_error); }  // the message is written by a call that fails
};

[[noreturn]] inline void fail(cairn_status status, const cairn_error& error) {
  throw Error(static_cast<Status>(status), error.message);
}

/// Calls a function without a handle: `function(cairn_error*)`.
template <class Function>
void call(Function function) {
  CallError error;
  const cairn_status status = function(&error);
  if (status != CAIRN_OK) fail(status, error);
}

}  // namespace detail
}  // namespace cairn

#endif
