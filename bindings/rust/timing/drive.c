/* SPDX-License-Identifier: BSD-3-Clause */
/* The drive of src/main.rs in C: the same calls, and the seconds of each update. */
#define _POSIX_C_SOURCE 199309L
#include <cairn/cairn.h>
#include <cairn/sim.h>
#include <stdlib.h>
#include <time.h>

typedef struct frame {
  const cairn_world_motion *motions;
  size_t motion_count;
  const cairn_observation *observations;
  size_t observation_count;
} frame;

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Returns 0, or the status of the call that failed. `seconds` has room for `count` values. */
cairn_status cairn_timing_drive(uint32_t max_observations, const cairn_pose *start, const frame *frames, size_t count,
                                double *seconds, cairn_pose *end);
cairn_status cairn_timing_drive(uint32_t max_observations, const cairn_pose *start, const frame *frames, size_t count,
                                double *seconds, cairn_pose *end) {
  cairn_error error = {sizeof error, CAIRN_OK, ""};
  cairn_filter_options options;
  cairn_filter_options_init(&options, sizeof options, &error);
  options.submap_landmarks = 60;
  options.max_observations = max_observations;
  options.initial_pose = *start;
  cairn_stereo_head head;
  cairn_stereo_head_init(&head, sizeof head, &error);
  cairn_filter *filter = NULL;
  int32_t camera = -1;
  cairn_match *matches = malloc(max_observations * sizeof *matches);
  cairn_status status = matches ? cairn_filter_create(&options, &filter, &error) : CAIRN_ERROR_MEMORY;
  if (status == CAIRN_OK) status = cairn_filter_add_stereo_head(filter, &head, &camera, &error);
  for (size_t i = 0; i < count && status == CAIRN_OK; ++i) {
    for (size_t j = 0; j < frames[i].motion_count && status == CAIRN_OK; ++j) {
      const cairn_world_motion *motion = &frames[i].motions[j];
      status = cairn_filter_predict_twist(filter, motion->dt, motion->velocity, motion->rate, &error);
    }
    if (status != CAIRN_OK) break;
    const double before = now();
    status = cairn_filter_update(filter, camera, frames[i].observations, frames[i].observation_count, matches, &error);
    seconds[i] = now() - before;
  }
  if (status == CAIRN_OK) status = cairn_filter_pose(filter, end, NULL, &error);
  cairn_filter_destroy(filter);
  free(matches);
  return status;
}
