// SPDX-License-Identifier: BSD-3-Clause
// The C functions of cairn/status.h, and the check of covariances.
#include <cmath>
#include <cstring>

#include "capi/guard.hpp"

#define CAIRN_TEXT_(x) #x
#define CAIRN_TEXT(x) CAIRN_TEXT_(x)

namespace cairn {
namespace capi {

void check_covariance(const double* matrix, std::size_t size, bool semi, const char* name, double* workspace) {
  check_finite(matrix, size * size, name);
  for (std::size_t r = 0; r < size; ++r) {
    const double variance = matrix[r * size + r];
    if (semi ? variance < 0.0 : !(variance > 0.0))
      throw Error(ErrorCode::argument, "%s: the variance at [%zu][%zu] must be %s 0, and is %g", name, r, r,
                  semi ? ">=" : ">", variance);
    constexpr double kLeast = kLeastSigma * kLeastSigma, kLargest = kLargestSigma * kLargestSigma;
    if (variance > kLargest || (variance > 0.0 && variance < kLeast))
      throw Error(ErrorCode::argument, "%s: the variance at [%zu][%zu] must lie in [%g, %g]%s, and is %g", name, r, r,
                  kLeast, kLargest, semi ? " or be 0" : "", variance);
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
  double fixed[36];
  const double slack = semi ? kDefiniteSlack : 0.0;
  if (!positive_definite(matrix, static_cast<Index>(size), slack, size <= 6 ? fixed : workspace))
    throw Error(ErrorCode::argument, "%s is not positive %sdefinite", name, semi ? "semi" : "");
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
    case CAIRN_ERROR_CALLBACK:
      return "CAIRN_ERROR_CALLBACK";
    default:
      return "unknown status";
  }
}

const char* cairn_last_message(void) {
  return cairn::capi::last_message();
}

const char* cairn_version(void) {
  return CAIRN_TEXT(CAIRN_VERSION_MAJOR) "." CAIRN_TEXT(CAIRN_VERSION_MINOR) "." CAIRN_TEXT(CAIRN_VERSION_PATCH);
}

uint32_t cairn_version_number(void) {
  return CAIRN_VERSION;
}

cairn_bool cairn_has(const char* feature) {
  if (feature == nullptr) return 0;
  for (const char* name : {"sparse", "teams", "trajectory", "systematic", "robust", "health", "errors"})
    if (std::strcmp(feature, name) == 0) return 1;
  return 0;
}

uint64_t cairn_id_none(void) {
  return CAIRN_ID_NONE;
}

const char* cairn_build(void) {
#if defined(__x86_64__) && defined(__AVX2__) && defined(__FMA__)
  return "x86-64-v3";
#elif defined(__x86_64__) || defined(_M_X64)
  return "x86-64";
#else
  return "generic";
#endif
}

}  // extern "C"
