/* SPDX-License-Identifier: BSD-3-Clause */
/* The sequence of TimingTest.java in C: how long an update takes, and where it leads. */
#include <cairn/cairn.h>
#include <time.h>

enum { LANDMARKS = 12, OBSERVATIONS = 4 };

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return 1e9 * (double)time.tv_sec + (double)time.tv_nsec;
}

static void frame_of(int number, cairn_observation *frame) {
  for (int i = 0; i < OBSERVATIONS; ++i) {
    const int landmark = (5 * number + i) % LANDMARKS;
    cairn_observation *observation = &frame[i];
    observation->id = (uint64_t)landmark + 1;
    observation->z[0] = 1.0 + landmark % 10 + 0.001 * (number % 7);
    observation->z[1] = landmark * 0.25 - 7.0 - 0.002 * (number % 5);
    observation->z[2] = landmark % 4 - 1.5;
  }
}

/* Writes the nanoseconds of each update, and the position and its first variance at the end. Returns the status. */
int cairn_test_time_updates(int frames, double *nanoseconds, double *result) {
  cairn_filter_options options;
  cairn_cartesian cartesian;
  cairn_filter *filter = NULL;
  cairn_observation frame[OBSERVATIONS] = {{0}};
  cairn_match matches[OBSERVATIONS];
  int32_t sensor = -1;
  const double velocity[3] = {0}, rate[3] = {0};
  cairn_filter_options_init(&options, sizeof options, NULL);
  cairn_cartesian_init(&cartesian, sizeof cartesian, NULL);
  cairn_status status = cairn_filter_create(&options, &filter, NULL);
  if (status == CAIRN_OK) status = cairn_filter_add_cartesian(filter, &cartesian, &sensor, NULL);
  for (int i = 0; i < frames && status == CAIRN_OK; ++i) {
    status = cairn_filter_predict_twist(filter, 0.1, velocity, rate, NULL);
    if (status != CAIRN_OK) break;
    frame_of(i, frame);
    const double start = now();
    status = cairn_filter_update(filter, sensor, frame, OBSERVATIONS, matches, NULL);
    nanoseconds[i] = now() - start;
  }
  cairn_pose pose;
  double covariance[36];
  if (status == CAIRN_OK) status = cairn_filter_pose(filter, &pose, covariance, NULL);
  if (status == CAIRN_OK) {
    for (int i = 0; i < 3; ++i) result[i] = pose.position[i];
    result[3] = covariance[0];
  }
  cairn_filter_destroy(filter);
  return status;
}
