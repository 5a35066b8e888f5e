/* SPDX-License-Identifier: BSD-3-Clause */
/* A rover drives a small circle among rocks. It measures how fast its wheels turn and where its stereo head sees each
 * rock. Cairn computes where the rover is, where the rocks are, and how far to trust both.
 *
 *   cc -std=c99 rover.c $(pkg-config --cflags --libs cairn) -lm */
#include <cairn/cairn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define DEGREE (3.14159265358979323846 / 180.0)

enum { ROCKS = 14, STEPS = 300 };

/* The true world, which the filter does not know: rocks (id, x, y, z) on flat ground, and the rover among them. */
static const struct {
  uint64_t id;
  double x, y, z;
} rocks[ROCKS] = {{101, 6.0, 1.0, 0.4},    {102, 9.0, 7.0, 0.2},   {103, 4.0, 11.0, 0.7},  {104, -3.0, 12.0, 0.3},
                  {105, -8.0, 8.0, 0.5},   {106, -9.0, 1.0, 0.1},  {107, -5.0, -4.0, 0.6}, {108, 1.0, -5.0, 0.3},
                  {109, 12.0, -2.0, 0.9},  {110, 15.0, 12.0, 1.2}, {111, 0.5, 4.5, 0.2},   {112, -14.0, 14.0, 0.8},
                  {113, -12.0, -6.0, 0.4}, {114, 7.0, -11.0, 0.5}};

static double true_x = 0.0, true_y = 0.0, true_yaw = 0.0;

/* Roughly normal noise, the same in every run. */
static double noise(double sigma) {
  static uint64_t state = 1;
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    sum += (double)(state >> 11) / 9007199254740992.0;
  }
  return sigma * sum;
}

/* Moves the true rover: wheels of 0.3 m radius, 1 m apart (the defaults of cairn_wheels_init). */
static void drive(double dt, double left_rad_per_s, double right_rad_per_s) {
  const double speed = 0.3 * (left_rad_per_s + right_rad_per_s) / 2.0;
  const double turn = 0.3 * (right_rad_per_s - left_rad_per_s) / 1.0;
  true_x += speed * dt * cos(true_yaw + turn * dt / 2.0);
  true_y += speed * dt * sin(true_yaw + turn * dt / 2.0);
  true_yaw += turn * dt;
}

/* Observations of the head: range, azimuth and elevation of every rock within 12 m and 60 degrees to either side. */
static size_t look(const cairn_stereo_head* head, cairn_observation observations[ROCKS]) {
  size_t count = 0;
  for (int i = 0; i < ROCKS; ++i) {
    const double dx = rocks[i].x - true_x, dy = rocks[i].y - true_y;
    const double forward = cos(true_yaw) * dx + sin(true_yaw) * dy, left = cos(true_yaw) * dy - sin(true_yaw) * dx;
    const double flat = sqrt(dx * dx + dy * dy), azimuth = atan2(left, forward);
    if (flat > 12.0 || flat < 1.0 || fabs(azimuth) > 60.0 * DEGREE) continue;
    cairn_observation observation = {0}; /* covariance 0: the noise of the head is used */
    observation.id = rocks[i].id;
    observation.z[0] = sqrt(flat * flat + rocks[i].z * rocks[i].z) + noise(head->range_sigma);
    observation.z[1] = azimuth + noise(head->azimuth_sigma);
    observation.z[2] = atan2(rocks[i].z, flat) + noise(head->elevation_sigma);
    observations[count++] = observation;
  }
  return count;
}

/* Every call returns a status. After a failure, the message says what was wrong and what to do about it. */
static void check(cairn_status status) {
  if (status == CAIRN_OK) return;
  fprintf(stderr, "%s: %s\n", cairn_status_name(status), cairn_last_message());
  exit(1);
}

int main(void) {
  cairn_filter_options options;
  check(cairn_filter_options_init(&options, sizeof options, NULL));
  options.max_landmarks = 100; /* all memory is taken at creation */

  cairn_filter* filter = NULL;
  check(cairn_filter_create(&options, &filter, NULL));

  cairn_stereo_head head; /* range, azimuth, elevation on a pan and tilt mount */
  check(cairn_stereo_head_init(&head, sizeof head, NULL));
  head.range_sigma = 0.1;
  head.azimuth_sigma = 1.0 * DEGREE;
  head.elevation_sigma = 1.0 * DEGREE;
  int32_t camera = -1;
  check(cairn_filter_add_stereo_head(filter, &head, &camera, NULL));

  unsigned matched = 0, placed = 0, rejected = 0;
  for (int step = 0; step < STEPS; ++step) {
    /* The wheels turn. The encoders measure the rates with a small error. */
    const double dt = 0.2, left_rad_per_s = 1.6, right_rad_per_s = 2.0;
    drive(dt, left_rad_per_s, right_rad_per_s);
    check(cairn_filter_predict_wheels(filter, dt, left_rad_per_s + noise(0.01), right_rad_per_s + noise(0.01), NULL));

    /* A frame: the filter gets all its observations together, and returns a match for each. */
    cairn_observation observations[ROCKS];
    cairn_match matches[ROCKS];
    const size_t count = look(&head, observations);
    check(cairn_filter_update(filter, camera, observations, count, matches, NULL));
    for (size_t i = 0; i < count; ++i) {
      if (matches[i].result == CAIRN_RESULT_MATCHED) ++matched;
      if (matches[i].result == CAIRN_RESULT_NEW) ++placed;
      if (matches[i].result == CAIRN_RESULT_REJECTED) ++rejected;
    }
  }

  cairn_pose pose;
  double covariance[36]; /* of [dp; dtheta], 6 x 6 */
  double roll, pitch, yaw;
  check(cairn_filter_pose(filter, &pose, covariance, NULL));
  check(cairn_quaternion_to_euler(pose.quaternion, &roll, &pitch, &yaw, NULL));
  printf("%d steps; %u observations matched, %u placed a rock, %u were rejected\n", STEPS, matched, placed, rejected);
  printf("pose    x %6.2f +- %.2f m   y %6.2f +- %.2f m   yaw %6.1f +- %.1f deg   (3 sigma)\n", pose.position[0],
         3.0 * sqrt(covariance[0]), pose.position[1], 3.0 * sqrt(covariance[7]), yaw / DEGREE,
         3.0 * sqrt(covariance[35]) / DEGREE);
  printf("truth   x %6.2f          y %6.2f          yaw %6.1f\n", true_x, true_y,
         atan2(sin(true_yaw), cos(true_yaw)) / DEGREE);

  /* The rocks within 30 m, nearest first. With NULL and capacity 0 a query returns only their number. */
  size_t count = 0;
  check(cairn_map_within(cairn_filter_map(filter), pose.position, 30.0, NULL, 0, &count, NULL));
  cairn_landmark* landmarks = malloc((count + 1) * sizeof *landmarks);
  if (!landmarks) return 1;
  check(cairn_map_within(cairn_filter_map(filter), pose.position, 30.0, landmarks, count, &count, NULL));
  for (size_t i = 0; i < count; ++i) {
    const cairn_landmark* rock = &landmarks[i];
    printf("rock %3d  x %6.2f +- %.2f m   y %6.2f +- %.2f m   z %5.2f +- %.2f m   seen %d times\n", (int)rock->id,
           rock->position[0], 3.0 * sqrt(rock->covariance[0]), rock->position[1], 3.0 * sqrt(rock->covariance[4]),
           rock->position[2], 3.0 * sqrt(rock->covariance[8]), (int)rock->observations);
  }
  free(landmarks);
  cairn_filter_destroy(filter);
  return 0;
}
