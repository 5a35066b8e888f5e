// SPDX-License-Identifier: BSD-3-Clause
// Messages, checks and conversions of the C boundary.
#include "capi/boundary.hpp"

#include <cmath>
#include <cstddef>
#include <cstdio>

namespace cairn {
namespace capi {
namespace {

thread_local char message[sizeof(cairn_error::message)] = "";

// Copies a text of UTF-8 and ends it by a zero. A text that is too long is cut between two characters.
void copy_text(const char* text, char* out, std::size_t room) noexcept {
  std::size_t length = std::strlen(text);
  if (length >= room) {
    length = room - 1;
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0u) == 0x80u) --length;
  }
  std::memcpy(out, text, length);
  out[length] = '\0';
}

}  // namespace

cairn_status fail(cairn_status status, const char* text, cairn_error* error) noexcept {
  copy_text(text, message, sizeof message);
  if (error == nullptr) return status;
  constexpr std::size_t kText = offsetof(cairn_error, message);
  const std::size_t size = std::min<std::size_t>(error->struct_size, sizeof *error);
  if (size >= kText) error->status = status;
  if (size > kText) copy_text(text, error->message, size - kText);
  return status;
}

const char* last_message() noexcept {
  return message;
}

cairn_status status_of(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::argument:
      return CAIRN_ERROR_ARGUMENT;
    case ErrorCode::buffer:
      return CAIRN_ERROR_BUFFER;
    case ErrorCode::capacity:
      return CAIRN_ERROR_CAPACITY;
    case ErrorCode::not_found:
      return CAIRN_ERROR_NOT_FOUND;
    case ErrorCode::numerical:
      return CAIRN_ERROR_NUMERICAL;
    case ErrorCode::state:
      return CAIRN_ERROR_STATE;
    case ErrorCode::callback:
      return CAIRN_ERROR_CALLBACK;
  }
  return CAIRN_ERROR_INTERNAL;
}

void check_pointer(const void* pointer, const char* name) {
  if (pointer == nullptr) throw Error(ErrorCode::argument, "%s is NULL; pass a valid pointer", name);
}

bool all_finite(const double* values, std::size_t count) {
  return std::all_of(values, values + count, [](double value) { return std::isfinite(value); });
}

void check_finite(double value, const char* name) {
  if (!std::isfinite(value)) throw Error(ErrorCode::argument, "%s is not finite (%g)", name, value);
}

void check_finite(const double* values, std::size_t count, const char* name) {
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isfinite(values[i])) throw Error(ErrorCode::argument, "%s[%zu] is not finite (%g)", name, i, values[i]);
}

void check_positive(double value, const char* name) {
  check_finite(value, name);
  if (!(value > 0.0)) throw Error(ErrorCode::argument, "%s must be > 0, and is %g", name, value);
}

void check_positive(const double* values, std::size_t count, const char* name) {
  check_finite(values, count, name);
  for (std::size_t i = 0; i < count; ++i)
    if (!(values[i] > 0.0)) throw Error(ErrorCode::argument, "%s[%zu] must be > 0, and is %g", name, i, values[i]);
}

void check_not_negative(double value, const char* name) {
  check_finite(value, name);
  if (value < 0.0) throw Error(ErrorCode::argument, "%s must be >= 0, and is %g", name, value);
}

void check_not_negative(const double* values, std::size_t count, const char* name) {
  check_finite(values, count, name);
  for (std::size_t i = 0; i < count; ++i)
    if (values[i] < 0.0) throw Error(ErrorCode::argument, "%s[%zu] must be >= 0, and is %g", name, i, values[i]);
}

void check_range(double value, double lower, double upper, const char* name) {
  check_finite(value, name);
  if (value < lower || value > upper)
    throw Error(ErrorCode::argument, "%s must lie in [%g, %g], and is %g", name, lower, upper, value);
}

void check_probability(double value, const char* name) {
  check_finite(value, name);
  if (!(value > 0.0 && value <= 1.0)) throw Error(ErrorCode::argument, "%s must lie in (0, 1], and is %g", name, value);
}

bool read_bool(cairn_bool value, const char* name) {
  if (value != 0 && value != 1) throw Error(ErrorCode::argument, "%s must be 0 or 1, and is %d", name, value);
  return value == 1;
}

void check_reserved(std::uint32_t value, const char* name) {
  if (value != 0) throw Error(ErrorCode::argument, "%s must be 0, and is %u", name, value);
}

void check_position(const double* values, std::size_t count, const char* name) {
  check_finite(values, count, name);
  for (std::size_t i = 0; i < count; ++i)
    if (std::abs(values[i]) > kFarthest)
      throw Error(ErrorCode::argument, "%s[%zu] lies beyond %g m, and is %g", name, i, kFarthest, values[i]);
}

void check_sigma(double value, const char* name) {
  check_positive(value, name);
  check_range(value, kLeastSigma, kLargestSigma, name);
}

void check_sigma(const double* values, std::size_t count, const char* name) {
  check_positive(values, count, name);
  for (std::size_t i = 0; i < count; ++i) check_range(values[i], kLeastSigma, kLargestSigma, name);
}

void check_sigma_or_zero(double value, const char* name) {
  check_not_negative(value, name);
  if (value > 0.0) check_range(value, kLeastSigma, kLargestSigma, name);
}

void check_sigma_or_zero(const double* values, std::size_t count, const char* name) {
  check_not_negative(values, count, name);
  for (std::size_t i = 0; i < count; ++i) check_sigma_or_zero(values[i], name);
}

SO3 read_quaternion(const double* quaternion, const char* name) {
  check_pointer(quaternion, name);
  check_finite(quaternion, 4, name);
  double largest = 0.0;
  for (int i = 0; i < 4; ++i) largest = std::max(largest, std::abs(quaternion[i]));
  if (!(largest > 1e-100))
    throw Error(ErrorCode::argument, "%s is zero; the quaternion of a rotation has length 1", name);
  return SO3::from_quaternion(quaternion[0] / largest, quaternion[1] / largest, quaternion[2] / largest,
                              quaternion[3] / largest);
}

SE3 read_pose(const cairn_pose* pose, const char* name) {
  check_pointer(pose, name);
  char part[96];
  std::snprintf(part, sizeof part, "%s.position", name);
  check_finite(pose->position, 3, part);
  std::snprintf(part, sizeof part, "%s.quaternion", name);
  return SE3(read_quaternion(pose->quaternion, part), Vector3(pose->position));
}

void write_quaternion(const SO3& rotation, double* out) {
  const Eigen::Quaterniond& q = rotation.quaternion();
  out[0] = q.w(), out[1] = q.x(), out[2] = q.y(), out[3] = q.z();
}

void write_pose(const SE3& pose, cairn_pose* out) {
  for (int i = 0; i < 3; ++i) out->position[i] = pose.translation()(i);
  write_quaternion(pose.rotation(), out->quaternion);
}

void check_struct_size(std::size_t size, const char* name) {
  if (size < kSmallestStruct || size > kLargestStruct)
    throw Error(ErrorCode::argument, "%s: struct_size is %zu; set it to the sizeof of the struct", name, size);
}

void check_unknown_bytes(const void* options, std::size_t size, std::size_t known, const char* name) {
  const auto* bytes = static_cast<const unsigned char*>(options);
  for (std::size_t i = known; i < size; ++i)
    if (bytes[i] != 0)
      throw Error(ErrorCode::argument,
                  "%s: byte %zu is not zero, and this library knows only %zu bytes of the struct; it is older than the "
                  "caller's header",
                  name, i, known);
}

bool check_room(const void* buffer, std::size_t capacity, std::size_t count, std::size_t* needed, const char* name) {
  check_pointer(needed, "needed");
  if (buffer == nullptr && capacity > 0)
    throw Error(ErrorCode::argument, "%s is NULL and its capacity is %zu; pass capacity 0 to ask for the size", name,
                capacity);
  *needed = count;
  if (capacity == 0) return false;
  if (capacity < count)
    throw Error(ErrorCode::buffer, "%s has room for %zu values, and %zu are needed", name, capacity, count);
  return true;
}

}  // namespace capi
}  // namespace cairn
