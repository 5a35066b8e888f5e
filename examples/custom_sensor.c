/* SPDX-License-Identifier: BSD-3-Clause */
/* A sensor that Cairn does not have: a radio that measures only the distance to beacons. First a lidar surveys the
 * beacons while the vehicle stands still. Then the vehicle drives with only the radio.
 *
 *   cc -std=c99 custom_sensor.c $(pkg-config --cflags --libs cairn) -lm */
#include <cairn/cairn.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { BEACONS = 4, STEPS = 100 };
static const double beacons[BEACONS][3] = {{20, 5, 3}, {4, 18, 2}, {-12, -6, 4}, {10, -15, 1}};

typedef struct radio {
  double antenna[3]; /* in the body frame, m */
} radio;

/* z = |landmark - antenna in the map|, with the antenna at p + R a. Let u be the unit vector from the antenna to the
 * landmark, and s = R a. Then dz/dlandmark = u and dz/dp = -u. A rotation dtheta (R <- Exp(dtheta) R) moves the antenna
 * by dtheta x s, so dz/dtheta = -(s x u). */
static int32_t predict_range(void* user, const cairn_pose* pose, const double landmark[3], double* z,
                             double* jacobian_pose, double* jacobian_landmark) {
  const radio* r = user;
  double antenna[3], s[3], u[3];
  if (cairn_pose_apply(pose, r->antenna, antenna, NULL) != CAIRN_OK) return 0;
  double squared = 0.0;
  for (int i = 0; i < 3; ++i) {
    s[i] = antenna[i] - pose->position[i];
    u[i] = landmark[i] - antenna[i];
    squared += u[i] * u[i];
  }
  const double range = sqrt(squared);
  if (!(range > 0.5)) return 0; /* too near for a direction: the observation is refused */
  for (int i = 0; i < 3; ++i) {
    u[i] /= range;
    jacobian_pose[i] = -u[i];
    jacobian_landmark[i] = u[i];
  }
  jacobian_pose[3] = -(s[1] * u[2] - s[2] * u[1]);
  jacobian_pose[4] = -(s[2] * u[0] - s[0] * u[2]);
  jacobian_pose[5] = -(s[0] * u[1] - s[1] * u[0]);
  z[0] = range;
  return 1;
}

static void check(cairn_status status) {
  if (status == CAIRN_OK) return;
  fprintf(stderr, "%s: %s\n", cairn_status_name(status), cairn_last_message());
  exit(1);
}

/* Roughly normal noise, the same in every run. */
static double noise(double sigma) {
  static uint64_t state = 7;
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    sum += (double)(state >> 11) / 9007199254740992.0;
  }
  return sigma * sum;
}

/* Prints the estimated position beside the true one. */
static void report(const cairn_filter* filter, const char* when, const cairn_pose* truth) {
  cairn_pose pose;
  double covariance[36];
  check(cairn_filter_pose(filter, &pose, covariance, NULL));
  printf("%-14s x %6.2f +- %.2f m   y %6.2f +- %.2f m   (3 sigma)   truth %6.2f %6.2f\n", when, pose.position[0],
         3.0 * sqrt(covariance[0]), pose.position[1], 3.0 * sqrt(covariance[7]), truth->position[0],
         truth->position[1]);
}

int main(void) {
  radio mine = {{0.3, 0.0, 0.8}};
  cairn_custom sensor;
  check(cairn_custom_init(&sensor, sizeof sensor, NULL));
  sensor.rows = 1;
  sensor.sigma[0] = 0.1;

  /* First check the Jacobians: compare them with numerical ones at a pose that is not special. */
  const double rotation_vector[3] = {0.2, -0.3, 0.9};
  cairn_pose somewhere = {{1.0, -2.0, 0.5}, {1.0, 0.0, 0.0, 0.0}};
  check(cairn_quaternion_exp(rotation_vector, somewhere.quaternion, NULL));
  double worst = 0.0;
  check(cairn_custom_check(&sensor, predict_range, NULL, &mine, &somewhere, beacons[0], &worst, NULL));
  printf("Jacobians differ from numerical ones by %.1e at most\n", worst);
  if (!(worst < 1e-5)) return 1;

  cairn_filter_options options;
  check(cairn_filter_options_init(&options, sizeof options, NULL));
  cairn_filter* filter = NULL;
  check(cairn_filter_create(&options, &filter, NULL));
  cairn_cartesian lidar;
  check(cairn_cartesian_init(&lidar, sizeof lidar, NULL));
  int32_t lidar_number = -1, radio_number = -1;
  check(cairn_filter_add_cartesian(filter, &lidar, &lidar_number, NULL));
  /* One distance cannot place a landmark: the sensor has no second function. The filter does not own `mine`. */
  check(cairn_filter_add_custom(filter, &sensor, predict_range, NULL, &mine, NULL, &radio_number, NULL));

  /* The survey: the lidar places the beacons. The vehicle stands at the origin: body frame and map frame are equal. */
  cairn_observation observations[BEACONS] = {{0}};
  for (int frame = 0; frame < 10; ++frame) {
    for (int i = 0; i < BEACONS; ++i) {
      observations[i].id = (uint64_t)i;
      for (int j = 0; j < 3; ++j) observations[i].z[j] = beacons[i][j] + noise(lidar.sigma[j]);
    }
    check(cairn_filter_update(filter, lidar_number, observations, BEACONS, NULL, NULL));
  }

  /* The drive: a gentle left turn, with the radio only. */
  cairn_pose truth;
  check(cairn_pose_identity(&truth, NULL));
  const double dt = 0.2, velocity[3] = {0.6, 0.0, 0.0}, rate[3] = {0.0, 0.0, 0.05};
  double yaw = 0.0;
  cairn_twist_noise twist;
  check(cairn_twist_noise_init(&twist, sizeof twist, NULL));
  unsigned rejected = 0;
  for (int step = 0; step < STEPS; ++step) {
    truth.position[0] += velocity[0] * dt * cos(yaw + rate[2] * dt / 2.0);
    truth.position[1] += velocity[0] * dt * sin(yaw + rate[2] * dt / 2.0);
    yaw += rate[2] * dt;
    check(cairn_quaternion_from_euler(0.0, 0.0, yaw, truth.quaternion, NULL));
    double measured_velocity[3], measured_rate[3];
    for (int i = 0; i < 3; ++i) {
      measured_velocity[i] = velocity[i] + noise(twist.velocity_sigma[i]);
      measured_rate[i] = rate[i] + noise(twist.rate_sigma[i]);
    }
    check(cairn_filter_predict_twist(filter, dt, measured_velocity, measured_rate, NULL));

    cairn_match matches[BEACONS];
    for (int i = 0; i < BEACONS; ++i) {
      double unused[6];
      predict_range(&mine, &truth, beacons[i], observations[i].z, unused, unused);
      observations[i].z[0] += noise(sensor.sigma[0]);
    }
    check(cairn_filter_update(filter, radio_number, observations, BEACONS, matches, NULL));
    for (int i = 0; i < BEACONS; ++i) rejected += matches[i].result == CAIRN_RESULT_REJECTED;
    if (step == 0) report(filter, "at the start", &truth);
  }
  report(filter, "at the end", &truth);
  printf("%u of %d distances were rejected\n", rejected, BEACONS * STEPS);
  cairn_filter_destroy(filter);
  return 0;
}
