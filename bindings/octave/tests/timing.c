/* SPDX-License-Identifier: BSD-3-Clause */
/* The sequence of timing.m in C: prints the median of an update, and the bits of the final pose. */
#define _POSIX_C_SOURCE 199309L
#include <cairn/cairn.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { kFrames = 2000, kCount = 12 };

static int ascending(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static uint64_t bits(double value) {
  uint64_t word;
  memcpy(&word, &value, sizeof word);
  return word;
}

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int main(void) {
  static double times[kFrames];
  const double velocity[3] = {1, 0, 0}, rate[3] = {0, 0, 0.1};
  cairn_error error = {sizeof error, CAIRN_OK, ""};
  cairn_filter_options options;
  cairn_cartesian cartesian;
  cairn_filter *filter = NULL;
  cairn_pose pose;
  int32_t sensor = -1;
  cairn_status status = cairn_filter_options_init(&options, sizeof options, &error);
  options.max_landmarks = 100;
  options.gate_probability = options.batch_gate_probability = 1;
  if (status == CAIRN_OK) status = cairn_filter_create(&options, &filter, &error);
  if (status == CAIRN_OK) status = cairn_cartesian_init(&cartesian, sizeof cartesian, &error);
  if (status == CAIRN_OK) status = cairn_filter_add_cartesian(filter, &cartesian, &sensor, &error);
  for (int k = 0; k < kFrames && status == CAIRN_OK; ++k) {
    cairn_observation observations[kCount];
    cairn_match matches[kCount];
    memset(observations, 0, sizeof observations);
    status = cairn_filter_predict_twist(filter, 0.1, velocity, rate, &error);
    for (int i = 0; i < kCount; ++i) {
      const double noise = (7 * k + 3 * i) % 11 - 5;
      observations[i].id = (uint64_t)((k + i) % 20);
      observations[i].z[0] = 3 + i + 0.001 * noise;
      observations[i].z[1] = i - 6 + 0.001 * noise;
      observations[i].z[2] = 0.25 * i;
    }
    const double start = seconds();
    if (status == CAIRN_OK) status = cairn_filter_update(filter, sensor, observations, kCount, matches, &error);
    times[k] = seconds() - start;
  }
  if (status == CAIRN_OK) status = cairn_filter_pose(filter, &pose, NULL, &error);
  cairn_filter_destroy(filter);
  if (status != CAIRN_OK) {
    fprintf(stderr, "%s\n", error.message);
    return 1;
  }
  qsort(times, kFrames, sizeof *times, ascending);
  printf("microseconds %.3f\nx %016" PRIx64 "\nqz %016" PRIx64 "\n", 1e6 * times[kFrames / 2], bits(pose.position[0]),
         bits(pose.quaternion[3]));
  return 0;
}
