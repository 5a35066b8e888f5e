// SPDX-License-Identifier: BSD-3-Clause
// The C boundary, which all libraries of the project share: each call runs inside guard(), and a check refuses a bad
// argument by name. It does not depend on the handles.
#pragma once

#include <cairn/pose.h>
#include <cairn/status.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "core/error.hpp"
#include "geometry/se3.hpp"

namespace cairn {
namespace capi {

const char* last_message() noexcept;  // of this thread
cairn_status status_of(ErrorCode code) noexcept;
// Keeps the text as this thread's message and writes it to the caller's error, which may be NULL. Returns the status.
cairn_status fail(cairn_status status, const char* text, cairn_error* error) noexcept;

template <class Function>
cairn_status guard(cairn_error* error, Function&& function) noexcept {
  try {
    function();
    return CAIRN_OK;
  } catch (const Error& thrown) {
    return fail(status_of(thrown.code()), thrown.what(), error);
  } catch (const std::bad_alloc&) {
    return fail(CAIRN_ERROR_MEMORY, "out of memory; create the handle with smaller capacities", error);
  } catch (const std::exception& thrown) {
    return fail(CAIRN_ERROR_INTERNAL, thrown.what(), error);
  } catch (...) {
    return fail(CAIRN_ERROR_INTERNAL, "an exception of unknown type: this is a defect of the library", error);
  }
}

// --- checks --- Each throws an Error that names the argument.
void check_pointer(const void* pointer, const char* name);
bool all_finite(const double* values, std::size_t count);
void check_finite(double value, const char* name);
void check_finite(const double* values, std::size_t count, const char* name);
void check_positive(double value, const char* name);
void check_positive(const double* values, std::size_t count, const char* name);
void check_not_negative(double value, const char* name);
void check_not_negative(const double* values, std::size_t count, const char* name);
void check_range(double value, double lower, double upper, const char* name);  // [lower, upper]
void check_probability(double value, const char* name);                        // (0, 1]
bool read_bool(cairn_bool value, const char* name);                            // 0 or 1
void check_reserved(std::uint32_t value, const char* name);                    // 0

// Numbers beyond these limits are mistakes. Inside them no product of a filter's numbers overflows or underflows.
constexpr double kFarthest = 1e12;                           // m, of a position
constexpr double kLeastSigma = 1e-50, kLargestSigma = 1e50;  // in the units of the value
constexpr double kLargestPositionSigma = 1e9;                // m, of a pose or a landmark
constexpr double kLargestAttitudeSigma = 100.0;              // rad
void check_position(const double* values, std::size_t count, const char* name);
void check_sigma(double value, const char* name);  // > 0
void check_sigma(const double* values, std::size_t count, const char* name);
void check_sigma_or_zero(double value, const char* name);
void check_sigma_or_zero(const double* values, std::size_t count, const char* name);

// --- conversions --- Reading checks the values.
SO3 read_quaternion(const double* quaternion, const char* name);
SE3 read_pose(const cairn_pose* pose, const char* name);
void write_pose(const SE3& pose, cairn_pose* out);
void write_quaternion(const SO3& rotation, double* out);
template <int n>
void write_square(const Eigen::Matrix<double, n, n>& symmetric, double* out) {
  std::copy_n(symmetric.data(), n * n, out);
}

// --- options --- The caller's struct may be older or newer than the struct of the library.
constexpr std::size_t kSmallestStruct = 8, kLargestStruct = 1 << 16;
void check_struct_size(std::size_t size, const char* name);

// Writes the defaults, at most struct_size bytes. Bytes that only a newer caller has are set to zero.
template <class Options>
void init_options(Options* options, std::size_t struct_size, const Options& defaults, const char* name) {
  check_pointer(options, name);
  check_struct_size(struct_size, "struct_size");
  std::memset(static_cast<void*>(options), 0, struct_size);
  std::memcpy(static_cast<void*>(options), &defaults, std::min(struct_size, sizeof(Options)));
  options->struct_size = static_cast<std::uint32_t>(struct_size);
}

// A byte of the caller's struct that this library does not know must be zero: it asks for something new.
void check_unknown_bytes(const void* options, std::size_t size, std::size_t known, const char* name);

// The caller's options over the defaults. The smaller of both struct sizes is copied.
template <class Options>
Options read_options(const Options* options, const Options& defaults, const char* name) {
  check_pointer(options, name);
  std::uint32_t size = 0;
  std::memcpy(&size, options, sizeof size);  // a caller's older struct may be shorter than ours
  check_struct_size(size, name);
  check_unknown_bytes(options, size, sizeof(Options), name);
  Options merged = defaults;
  std::memcpy(static_cast<void*>(&merged), options, std::min<std::size_t>(size, sizeof(Options)));
  return merged;
}

// Writes a report: the smaller of both struct sizes is copied. Bytes that only a newer caller has stay unchanged.
template <class Report>
void write_report(Report& from, Report* to, const char* name = "report") {
  check_pointer(to, name);
  std::uint32_t size = 0;
  std::memcpy(&size, to, sizeof size);
  check_struct_size(size, name);
  from.struct_size = size;
  std::memcpy(static_cast<void*>(to), &from, std::min<std::size_t>(size, sizeof from));
}

// --- arrays --- Sets `needed` to `count`. Returns true if the buffer has room, false if the caller asks for the size
// only, by capacity 0. A buffer that is too short is an error.
bool check_room(const void* buffer, std::size_t capacity, std::size_t count, std::size_t* needed, const char* name);

}  // namespace capi
}  // namespace cairn
