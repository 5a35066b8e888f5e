/* SPDX-License-Identifier: BSD-3-Clause */
/* Random arguments of every kind, from a seed. */
#ifndef CAIRN_TESTS_FUZZ_H
#define CAIRN_TESTS_FUZZ_H

#include <cairn/cairn.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A condition that must hold after a call. If it does not, the program ends and prints seed and call. */
#define HOLDS(condition, value)                               \
  do {                                                        \
    if (!(condition)) fuzz_fail(#condition, (double)(value)); \
  } while (0)
extern const char *fuzz_program, *fuzz_operation;
extern unsigned long long fuzz_call;
void fuzz_fail(const char* what, double value);
/* A status must be one of the pinned set and not an internal error, and each failure must have a one-line message.
 * Statuses are counted. */
extern unsigned long long fuzz_counts[10];
void fuzz_check_status(cairn_status status);

/* `limit`: the size and the inverse size of all numbers except 0, NaN and the infinities are below it. */
void fuzz_seed(uint64_t seed, double limit);
uint64_t fuzz_bits(void);
uint64_t fuzz_below(uint64_t bound);
bool fuzz_one_in(uint64_t n);
double fuzz_uniform(double lower, double upper);
/* A number that no caller should pass. Unless fuzz_wild it is not finite, 0 or -1. */
double fuzz_garbage(void);
/* A finite number of any size: every power of ten between the denormals and DBL_MAX, within the limit. */
double fuzz_any_size(void);
extern bool fuzz_wild;
uint64_t fuzz_id(void);
int32_t fuzz_int(void);
/* A struct_size near the right one: mostly right, sometimes older, newer, zero or absurd. */
uint32_t fuzz_struct_size(size_t size);

/* Arguments: mostly good, sometimes bad. */
bool fuzz_bad(void);
double fuzz_number(double scale);
double fuzz_positive(double scale);
void fuzz_numbers(double* out, size_t count, double scale);
void fuzz_pose(cairn_pose* out);
void fuzz_covariance(double* out, size_t n, double scale);
const void* fuzz_maybe(const void* pointer); /* or NULL */
void* fuzz_maybe_out(void* pointer);
/* A struct of options in a buffer of exactly the stated size; the caller frees it. */
void* fuzz_resized(const void* exact, size_t size);

/* Custom sensors with three rows and with one row. A fickle sensor changes its behaviour from call to call. */
extern bool fuzz_fickle;
int32_t fuzz_custom_predict(void* user, const cairn_pose* T, const double l[3], double* z, double* jp, double* jl);
int32_t fuzz_custom_place(void* user, const cairn_pose* T, const double* z, double l[3], double* jp, double* jz);
int32_t fuzz_range_predict(void* user, const cairn_pose* T, const double l[3], double* z, double* jp, double* jl);

/* The values that a failed call must not change. They are cheap enough to compare around every call. */
typedef struct fuzz_shadow {
  cairn_pose pose;
  double covariance[36];
  cairn_update_report report;
  size_t landmarks;
  cairn_landmark first[4];
} fuzz_shadow;
void fuzz_shadow_take(fuzz_shadow* shadow, const cairn_filter* filter);

/* The functions that need no handle. `check` gets each status. */
void fuzz_helpers(void (*check)(cairn_status));

#endif
