/* SPDX-License-Identifier: BSD-3-Clause */
/* The updates of timing.ts in C: prints the median duration of one update in microseconds. */
#define _POSIX_C_SOURCE 200809L
#include <cairn/cairn.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { LANDMARKS = 12, SEEN = 6, STEPS = 4000, WARM_UP = 1000 };

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return 1e6 * (double)time.tv_sec + 1e-3 * (double)time.tv_nsec;
}

static int ascending(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static void require(cairn_status status, const cairn_error *error) {
  if (status < 0) {
    fprintf(stderr, "%s\n", error->message);
    exit(1);
  }
}

int main(void) {
  cairn_error error = {sizeof error, CAIRN_OK, ""};
  cairn_filter_options options;
  cairn_cartesian points;
  cairn_filter *filter = NULL;
  int32_t sensor = 0;
  static double durations[STEPS];
  require(cairn_filter_options_init(&options, sizeof options, &error), &error);
  options.max_landmarks = LANDMARKS;
  options.vehicle = CAIRN_VEHICLE_PLANAR;
  require(cairn_filter_create(&options, &filter, &error), &error);
  require(cairn_cartesian_init(&points, sizeof points, &error), &error);
  require(cairn_filter_add_cartesian(filter, &points, &sensor, &error), &error);
  for (int step = 0; step < STEPS; ++step) {
    const double velocity[3] = {0.1, 0.0, 0.0}, rate[3] = {0.0, 0.0, 0.0};
    cairn_observation observations[SEEN] = {{0}};
    cairn_match matches[SEEN];
    require(cairn_filter_predict_twist(filter, 0.1, velocity, rate, &error), &error);
    for (int i = 0; i < SEEN; ++i) {
      const int id = (SEEN * step + i) % LANDMARKS;
      observations[i].id = (uint64_t)id;
      observations[i].z[0] = 2.0 * (id % 4) - 0.01 * (step + 1) + 0.001 * (step % 7);
      observations[i].z[1] = id / 4 - 1.0 + 0.001 * (step % 5);
    }
    const double start = now();
    require(cairn_filter_update(filter, sensor, observations, SEEN, matches, &error), &error);
    durations[step] = now() - start;
  }
  cairn_filter_destroy(filter);
  qsort(durations + WARM_UP, STEPS - WARM_UP, sizeof *durations, ascending);
  printf("%.3f\n", durations[WARM_UP + (STEPS - WARM_UP) / 2]);
  return 0;
}
