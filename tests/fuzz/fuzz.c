/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks and random choices that the fuzz programs share. */
#include "fuzz.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint64_t first_state, state;
static double largest;

const char *fuzz_program = "", *fuzz_operation = "";
unsigned long long fuzz_call, fuzz_counts[10];

void fuzz_seed(uint64_t seed, double limit) {
  first_state = state = seed;
  largest = limit;
}

void fuzz_fail(const char* what, double value) {
  fprintf(stderr, "%s: seed %llu, call %llu, %s: %s (%g)\n  last message: %s\n", fuzz_program,
          (unsigned long long)first_state, fuzz_call, fuzz_operation, what, value, cairn_last_message());
  exit(1);
}

void fuzz_check_status(cairn_status status) {
  /* CAIRN_ERROR_INTERNAL is a defect by its definition. */
  HOLDS((status <= 0 && status >= CAIRN_ERROR_STATE) || status == CAIRN_ERROR_CALLBACK, status);
  ++fuzz_counts[-status];
  if (status == CAIRN_OK) return;
  const char* line = cairn_last_message();
  HOLDS(line != NULL && line[0] != '\0' && strchr(line, '\n') == NULL, status);
}

uint64_t fuzz_bits(void) { /* splitmix64 */
  uint64_t z = (state += UINT64_C(0x9E3779B97F4A7C15));
  z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
  z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
  return z ^ (z >> 31);
}

uint64_t fuzz_below(uint64_t bound) {
  return bound == 0 ? 0 : fuzz_bits() % bound;
}
bool fuzz_one_in(uint64_t n) {
  return fuzz_below(n) == 0;
}
double fuzz_uniform(double lower, double upper) {
  return lower + (upper - lower) * (double)(fuzz_bits() >> 11) / 9007199254740992.0;
}

static double garbage(bool wild) {
  static const double plain[] = {NAN, INFINITY, -INFINITY, 0.0, -0.0, -1.0};
  static const double extreme[] = {DBL_MAX, -DBL_MAX, 1e300, -1e300,  1e200,  1e154,   1e100,  1e30,   -1e30, 1e15,
                                   1e8,     1e6,      -1e6,  DBL_MIN, 5e-324, -5e-324, 1e-300, 1e-160, 1e-30, 1e-12};
  if (wild && fuzz_one_in(2)) return extreme[fuzz_below(sizeof extreme / sizeof extreme[0])];
  if (wild && fuzz_one_in(4)) { /* any bit pattern */
    const uint64_t bits = fuzz_bits();
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
  }
  return plain[fuzz_below(sizeof plain / sizeof plain[0])];
}

double fuzz_garbage(void) {
  for (;;) {
    const double value = garbage(fuzz_wild), size = fabs(value);
    if (!isfinite(value) || size == 0 || (size <= largest && size >= 1 / largest)) return value;
  }
}

double fuzz_any_size(void) {
  const double most = log10(fmin(largest, DBL_MAX)), size = fuzz_uniform(fmax(-most, -323), most);
  return (fuzz_one_in(2) ? 1 : -1) * pow(10, size);
}

uint64_t fuzz_id(void) {
  static const uint64_t ids[] = {0, UINT64_MAX, UINT64_MAX - 1, UINT64_C(1) << 63, UINT64_C(1) << 32};
  return fuzz_one_in(2) ? fuzz_bits() : ids[fuzz_below(sizeof ids / sizeof ids[0])];
}

int32_t fuzz_int(void) {
  static const int32_t values[] = {-1, 2, 99, INT32_MAX, INT32_MIN, 1 << 20};
  return values[fuzz_below(sizeof values / sizeof values[0])];
}

uint32_t fuzz_struct_size(size_t size) {
  static const uint32_t odd[] = {0, 1, 3, 4, 7, UINT32_C(1) << 31, UINT32_MAX, 70000};
  if (fuzz_one_in(2)) return (uint32_t)size;
  if (fuzz_one_in(3)) return odd[fuzz_below(sizeof odd / sizeof odd[0])];
  return (uint32_t)(8 + fuzz_below(size + 64));
}

void fuzz_shadow_take(fuzz_shadow* shadow, const cairn_filter* filter) {
  const double origin[3] = {0, 0, 0};
  const cairn_map* map = cairn_filter_map(filter);
  size_t needed;
  memset(shadow, 0, sizeof *shadow);
  shadow->report.struct_size = sizeof shadow->report;
  if (cairn_filter_pose(filter, &shadow->pose, shadow->covariance, NULL) != CAIRN_OK ||
      cairn_filter_last_update(filter, &shadow->report, NULL) != CAIRN_OK ||
      cairn_map_size(map, &shadow->landmarks, NULL) != CAIRN_OK ||
      cairn_map_nearest(map, origin, 4, shadow->first, 4, &needed, NULL) != CAIRN_OK)
    abort();
}

static void numbers(double* out, size_t count) {
  for (size_t i = 0; i < count; ++i) out[i] = fuzz_one_in(12) ? fuzz_garbage() : fuzz_uniform(-4, 4);
}

void fuzz_helpers(void (*check)(cairn_status)) {
  cairn_pose a, b, out;
  double p[3], q[4], v[3], e[6], angles[3];
  const bool alias = fuzz_one_in(3);
  numbers(a.position, 3), numbers(a.quaternion, 4), numbers(b.position, 3), numbers(b.quaternion, 4), numbers(p, 3);
  check(cairn_pose_error(&a, &b, e, NULL));
  check(cairn_pose_apply(&a, p, alias ? p : v, NULL));
  check(cairn_pose_inverse(&a, alias ? &a : &out, NULL));
  check(cairn_pose_compose(&a, fuzz_one_in(50) ? NULL : &b, alias ? &b : &out, NULL));
  numbers(angles, 3), numbers(q, 4);
  check(cairn_quaternion_to_euler(q, &v[0], &v[1], &v[2], NULL));
  check(cairn_quaternion_log(q, v, NULL));
  check(cairn_quaternion_exp(angles, q, NULL));
  check(cairn_quaternion_from_euler(angles[0], angles[1], angles[2], q, NULL));
  check(cairn_pose_identity(fuzz_one_in(50) ? NULL : &out, NULL));
  if (cairn_status_name((cairn_status)fuzz_bits()) == NULL || cairn_version() == NULL || cairn_build() == NULL) abort();

  /* _init of every struct, into a buffer of exactly the stated size. */
  static const size_t sizes[] = {sizeof(cairn_filter_options), sizeof(cairn_stereo_head), sizeof(cairn_stereo_camera),
                                 sizeof(cairn_cartesian),      sizeof(cairn_custom),      sizeof(cairn_wheels),
                                 sizeof(cairn_twist_noise)};
  for (size_t kind = 0; kind < sizeof sizes / sizeof sizes[0]; ++kind) {
    const uint32_t size = fuzz_struct_size(sizes[kind]);
    void* buffer = malloc(size > 4096 ? 1 : size + (size == 0));
    switch (kind) {
      case 0:
        check(cairn_filter_options_init(buffer, size, NULL));
        break;
      case 1:
        check(cairn_stereo_head_init(buffer, size, NULL));
        break;
      case 2:
        check(cairn_stereo_camera_init(buffer, size, NULL));
        break;
      case 3:
        check(cairn_cartesian_init(buffer, size, NULL));
        break;
      case 4:
        check(cairn_custom_init(buffer, size, NULL));
        break;
      case 5:
        check(cairn_wheels_init(buffer, size, NULL));
        break;
      default:
        check(cairn_twist_noise_init(buffer, size, NULL));
        break;
    }
    free(buffer);
  }
}
