/* SPDX-License-Identifier: BSD-3-Clause */
/* One timed update in C, for timing.py: it takes turns with the same update in Python on the same filter, so that both
 * see the same machine in the same state. */
#define _POSIX_C_SOURCE 199309L
#include <cairn/filter.h>
#include <time.h>

typedef cairn_status (*update_fn)(cairn_filter *filter, int32_t sensor, const cairn_observation *observations,
                                  size_t count, cairn_match *matches, cairn_error *error);

static double now(void) {
  struct timespec at;
  clock_gettime(CLOCK_MONOTONIC, &at);
  return 1e9 * (double)at.tv_sec + (double)at.tv_nsec;
}

/* Duration of one update, ns; negative if it failed. */
double timed_update(void *update, cairn_filter *filter, int32_t sensor, const cairn_observation *observations,
                    size_t count, cairn_match *matches) {
  cairn_error error = {sizeof error, CAIRN_OK, ""};
  update_fn function;
  *(void **)&function = update; /* C99 has no cast from an object to a function */
  const double start = now();
  const cairn_status status = function(filter, sensor, observations, count, matches, &error);
  const double end = now();
  return status == CAIRN_OK ? end - start : -1.0;
}
