/* SPDX-License-Identifier: BSD-3-Clause */
/* Arguments that are mostly good, so that calls reach the mathematics, and the custom sensors. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"

bool fuzz_wild = true, fuzz_fickle;

bool fuzz_bad(void) {
  return fuzz_one_in(fuzz_wild ? 12 : 25);
}
double fuzz_number(double scale) {
  if (!fuzz_bad()) return fuzz_uniform(-scale, scale);
  return fuzz_wild && fuzz_one_in(2) ? fuzz_any_size() : fuzz_garbage();
}
double fuzz_positive(double scale) {
  if (!fuzz_bad()) return fuzz_uniform(1e-3, 1) * scale;
  return fuzz_wild && fuzz_one_in(2) ? fabs(fuzz_any_size()) : fuzz_garbage();
}
void fuzz_numbers(double* out, size_t count, double scale) {
  const bool all_good = !fuzz_one_in(4);
  for (size_t i = 0; i < count; ++i) out[i] = all_good ? fuzz_uniform(-scale, scale) : fuzz_number(scale);
}
void fuzz_pose(cairn_pose* out) {
  fuzz_numbers(out->position, 3, 5);
  fuzz_numbers(out->quaternion, 4, 1);
}
/* A A^T plus a small diagonal, sometimes corrupted. Some are zero and, for wild filters, nearly singular. */
void fuzz_covariance(double* out, size_t n, double scale) {
  double a[36];
  const double floor = fuzz_one_in(8) && fuzz_wild ? 0 : scale / 10;
  if (n > 6) {
    for (size_t i = 0; i < n * n; ++i) out[i] = i % (n + 1) == 0 ? fuzz_uniform(0.1, 1) * scale : 0;
  } else {
    for (size_t i = 0; i < n * n; ++i) a[i] = fuzz_uniform(-1, 1) * sqrt(scale);
    for (size_t i = 0; i < n; ++i)
      for (size_t j = 0; j < n; ++j) {
        out[n * i + j] = i == j ? floor : 0;
        for (size_t k = 0; k < n; ++k) out[n * i + j] += a[n * i + k] * a[n * j + k];
      }
  }
  if (fuzz_one_in(20)) memset(out, 0, n * n * sizeof *out);
  if (fuzz_wild && fuzz_one_in(12)) { /* of another size, as a whole or in one row */
    const size_t row = fuzz_below(n), all = fuzz_below(2);
    const double factor = sqrt(fabs(fuzz_any_size()));
    for (size_t i = 0; i < n; ++i)
      for (size_t j = 0; j < n; ++j)
        out[n * i + j] *= (all != 0 || i == row ? factor : 1) * (all != 0 || j == row ? factor : 1);
  }
  if (fuzz_bad()) out[fuzz_below(n * n)] = fuzz_garbage();
}
const void* fuzz_maybe(const void* pointer) {
  return fuzz_one_in(80) ? NULL : pointer;
}
void* fuzz_maybe_out(void* pointer) {
  return fuzz_one_in(80) ? NULL : pointer;
}

/* A struct of options in a buffer of exactly the stated size. */
void* fuzz_resized(const void* exact, size_t size) {
  const uint32_t stated = fuzz_struct_size(size);
  const size_t room = stated > 4096 ? size : stated < 4 ? 4 : stated;
  unsigned char* buffer = malloc(room);
  /* What the library does not know is mostly zero, as it has to be. */
  const bool known_bytes_only = !fuzz_one_in(8);
  for (size_t i = 0; i < room; ++i) buffer[i] = known_bytes_only ? 0 : (unsigned char)fuzz_bits();
  memcpy(buffer, exact, room < size ? room : size);
  memcpy(buffer, &stated, sizeof stated);
  return buffer;
}

/* The custom sensor: correct, refusing, or with bad values. At the same place it behaves the same unless it is fickle.
 * */
static bool whim(const cairn_pose* T, const double* x, uint64_t salt, uint64_t n) {
  uint64_t bits[3], mixed = salt;
  if (fuzz_fickle) return fuzz_one_in(n);
  memcpy(&bits[0], &T->position[0], 8), memcpy(&bits[1], &x[0], 8), memcpy(&bits[2], &T->quaternion[1], 8);
  for (int i = 0; i < 3; ++i) mixed = (mixed ^ bits[i]) * UINT64_C(0x9E3779B97F4A7C15), mixed ^= mixed >> 29;
  return mixed % n == 0;
}
int32_t fuzz_custom_predict(void* user, const cairn_pose* T, const double l[3], double* z, double* jp, double* jl) {
  (void)user;
  for (int i = 0; i < 3; ++i) z[i] = l[i] - T->position[i];
  for (int i = 0; i < 9; ++i) jl[i] = i % 4 == 0;
  for (int i = 0; i < 18; ++i) jp[i] = i % 7 == 0 ? -1 : 0;
  if (whim(T, l, 1, 200)) jp[fuzz_below(18)] = fuzz_garbage();
  if (whim(T, l, 2, 200)) jl[fuzz_below(9)] = fuzz_garbage();
  if (whim(T, l, 3, 200)) z[fuzz_below(3)] = fuzz_garbage();
  return whim(T, l, 4, 50) ? fuzz_int() : 1;
}
int32_t fuzz_custom_place(void* user, const cairn_pose* T, const double* z, double l[3], double* jp, double* jz) {
  (void)user;
  for (int i = 0; i < 3; ++i) l[i] = T->position[i] + z[i];
  for (int i = 0; i < 9; ++i) jz[i] = i % 4 == 0;
  for (int i = 0; i < 18; ++i) jp[i] = i % 7 == 0;
  if (whim(T, z, 5, 200)) jp[fuzz_below(18)] = fuzz_garbage();
  if (whim(T, z, 6, 200)) l[fuzz_below(3)] = fuzz_garbage();
  return whim(T, z, 7, 50) ? fuzz_int() : 1;
}
/* One row: Jacobians of exactly one row, so that a sanitizer detects wrong buffer sizes of the sensor. */
int32_t fuzz_range_predict(void* user, const cairn_pose* T, const double l[3], double* z, double* jp, double* jl) {
  double d[3], square = 0;
  (void)user;
  for (int i = 0; i < 3; ++i) d[i] = l[i] - T->position[i], square += d[i] * d[i];
  z[0] = sqrt(square);
  if (!(z[0] > 0)) return 0;
  for (int i = 0; i < 3; ++i) jl[i] = d[i] / z[0], jp[i] = -d[i] / z[0], jp[3 + i] = 0;
  return 1;
}
