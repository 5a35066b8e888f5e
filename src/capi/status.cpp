// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>

#include "capi/guard.hpp"

#define CAIRN_TEXT_(x) #x
#define CAIRN_TEXT(x) CAIRN_TEXT_(x)

namespace cairn {
namespace capi {
namespace {

thread_local char message[320] = "";

// Lower Cholesky of a matrix scaled to unit diagonal; `slack` is added to that diagonal.
bool definite(const double* matrix, std::size_t size, double slack, double* L) {
  const Index n = static_cast<Index>(size);
  for (Index c = 0; c < n; ++c)
    for (Index r = c; r < n; ++r) {
      const double scale = std::sqrt(matrix[c * n + c]) * std::sqrt(matrix[r * n + r]);
      L[c * n + r] = scale > 0.0 ? matrix[r * n + c] / scale : 0.0;
      if (r == c) L[c * n + r] = 1.0 + slack;
    }
  return cholesky(L, n, n, L + n * n);
}

}  // namespace

void set_message(const char* text) noexcept {
  std::snprintf(message, sizeof message, "%s", text);
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
  }
  return CAIRN_ERROR_INTERNAL;
}

void check_pointer(const void* pointer, const char* name) {
  if (pointer == nullptr) throw Error(ErrorCode::argument, "%s is NULL; pass a valid pointer", name);
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

void check_covariance(const double* matrix, std::size_t size, bool semi, const char* name, double* workspace) {
  check_finite(matrix, size * size, name);
  for (std::size_t r = 0; r < size; ++r) {
    const double variance = matrix[r * size + r];
    if (semi ? variance < 0.0 : !(variance > 0.0))
      throw Error(ErrorCode::argument, "%s: the variance at [%zu][%zu] must be %s 0, and is %g", name, r, r,
                  semi ? ">=" : ">", variance);
  }
  for (std::size_t r = 0; r < size; ++r)
    for (std::size_t c = 0; c < r; ++c) {
      const double a = matrix[r * size + c], b = matrix[c * size + r];
      const double scale = std::sqrt(matrix[r * size + r]) * std::sqrt(matrix[c * size + c]);
      if (std::abs(a - b) > 1e-9 * scale)
        throw Error(ErrorCode::argument, "%s is not symmetric at [%zu][%zu]: %g and %g", name, r, c, a, b);
      if (std::abs(a) > scale * (1.0 + 1e-9))
        throw Error(ErrorCode::argument, "%s is not positive %sdefinite: see [%zu][%zu]", name, semi ? "semi" : "", r,
                    c);
    }
  // A semidefinite matrix may miss by rounding: 1e-9 of each variance.
  double fixed[36];
  if (!definite(matrix, size, semi ? 1e-9 : 0.0, size <= 6 ? fixed : workspace))
    throw Error(ErrorCode::argument, "%s is not positive %sdefinite", name, semi ? "semi" : "");
}

SO3 read_quaternion(const double* quaternion, const char* name) {
  check_pointer(quaternion, name);
  check_finite(quaternion, 4, name);
  double largest = 0.0;
  for (int i = 0; i < 4; ++i) largest = std::max(largest, std::abs(quaternion[i]));
  if (!(largest > 1e-100)) throw Error(ErrorCode::argument, "%s is zero; a rotation's quaternion has length 1", name);
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
    throw Error(ErrorCode::argument, "%s: a struct_size of %zu is no size of this struct; set it to sizeof it", name,
                size);
}

bool check_room(const void* buffer, std::size_t capacity, std::size_t count, std::size_t* needed, const char* name) {
  check_pointer(needed, "needed");
  if (buffer == nullptr && capacity > 0)
    throw Error(ErrorCode::argument, "%s is NULL, and its capacity %zu; pass NULL with 0 to ask for the size", name,
                capacity);
  *needed = count;
  if (buffer == nullptr) return false;
  if (capacity < count)
    throw Error(ErrorCode::buffer, "%s has room for %zu, and %zu are needed", name, capacity, count);
  return true;
}

}  // namespace capi
}  // namespace cairn

extern "C" {

const char* cairn_status_name(cairn_status status) {
  switch (status) {
    case CAIRN_OK:
      return "CAIRN_OK";
    case CAIRN_ERROR_ARGUMENT:
      return "CAIRN_ERROR_ARGUMENT";
    case CAIRN_ERROR_BUFFER:
      return "CAIRN_ERROR_BUFFER";
    case CAIRN_ERROR_CAPACITY:
      return "CAIRN_ERROR_CAPACITY";
    case CAIRN_ERROR_NOT_FOUND:
      return "CAIRN_ERROR_NOT_FOUND";
    case CAIRN_ERROR_NUMERICAL:
      return "CAIRN_ERROR_NUMERICAL";
    case CAIRN_ERROR_MEMORY:
      return "CAIRN_ERROR_MEMORY";
    case CAIRN_ERROR_STATE:
      return "CAIRN_ERROR_STATE";
    case CAIRN_ERROR_INTERNAL:
      return "CAIRN_ERROR_INTERNAL";
    default:
      return "unknown status";
  }
}

const char* cairn_last_message(void) {
  return cairn::capi::message;
}

const char* cairn_version(void) {
  return CAIRN_TEXT(CAIRN_VERSION_MAJOR) "." CAIRN_TEXT(CAIRN_VERSION_MINOR) "." CAIRN_TEXT(CAIRN_VERSION_PATCH);
}

const char* cairn_build(void) {
#if defined(__x86_64__) && defined(__AVX2__) && defined(__FMA__)
  return "x86-64-v3";
#elif defined(__x86_64__)
  return "x86-64";
#else
  return "generic";
#endif
}

}  // extern "C"
