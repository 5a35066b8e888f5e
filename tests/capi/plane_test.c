/* SPDX-License-Identifier: BSD-3-Clause */
/* A planar vehicle's filter. It must equal the spatial filter of a vehicle that has no noise out of the plane. The
 * motion and the covariance of the planar filter are also compared with truth. */
#include "plane.h"

static cairn_wheels level_wheels(void) {
  cairn_wheels wheels;
  assert_ok(cairn_wheels_init(&wheels, sizeof wheels, NULL));
  wheels.vertical_sigma = wheels.roll_rate_sigma = wheels.pitch_rate_sigma = 0;
  wheels.lateral_sigma = 0.02;
  return wheels;
}

static void planar_equals_spatial_without_noise_out_of_the_plane(void** state) {
  (void)state;
  for (int32_t error = CAIRN_STATE_ERROR_INVARIANT; error <= CAIRN_STATE_ERROR_STANDARD; ++error) {
    const cairn_filter_options in_the_plane = plane_options(CAIRN_VEHICLE_PLANAR, error),
                               in_space = plane_options(CAIRN_VEHICLE_SPATIAL, error);
    cairn_filter* filters[2] = {plane_filter(&in_the_plane), plane_filter(&in_space)};
    cairn_cartesian points;
    const cairn_wheels wheels = level_wheels();
    cairn_twist_noise noise;
    generator random = {5};
    cairn_pose truth = in_the_plane.initial_pose;
    int32_t sensor = -1;
    assert_ok(cairn_cartesian_init(&points, sizeof points, NULL));
    points.T_body_sensor = pose_at(0.4, -0.1, 0, 0, 0, 0.7);
    points.sigma[0] = 0.05, points.sigma[1] = 0.08;
    assert_ok(cairn_twist_noise_init(&noise, sizeof noise, NULL));
    noise.velocity_sigma[2] = noise.rate_sigma[0] = noise.rate_sigma[1] = 0;
    for (int k = 0; k < 2; ++k) {
      assert_ok(cairn_filter_add_cartesian(filters[k], &points, &sensor, NULL));
      assert_ok(cairn_filter_set_wheels(filters[k], &wheels, NULL));
      assert_ok(cairn_filter_set_twist_noise(filters[k], &noise, NULL));
    }
    for (int step = 0; step < 60; ++step) {
      const double v[3] = {0.6, 0.05, 0}, w[3] = {0, 0, 0.12};
      cairn_pose moved = pose_at(0.6, 0.05, 0, 0, 0, 0.12), sensor_pose;
      double covariance[36], z[3];
      cairn_observation o[POINTS];
      cairn_match m[2][POINTS];
      size_t count = 0;
      assert_ok(cairn_pose_compose(&truth, &moved, &truth, NULL));
      assert_ok(cairn_pose_compose(&truth, &points.T_body_sensor, &sensor_pose, NULL));
      diagonal(covariance, 6, 0);
      covariance[0] = 1e-3, covariance[7] = 2e-3, covariance[35] = 1e-4;
      covariance[5] = covariance[30] = 1e-4;
      for (size_t l = 0; l < POINTS; ++l) {
        double body[3];
        to_body(&sensor_pose, plane_points[l], body);
        if ((l + (size_t)step) % 3 == 0) continue;
        o[count] = sighting(l + 1, body[0] + random_normal(&random, 0.05), body[1] + random_normal(&random, 0.08));
        ++count;
      }
      for (int k = 0; k < 2; ++k) {
        cairn_filter* f = filters[k];
        cairn_match match;
        if (step % 3 == 0) assert_ok(cairn_filter_predict_twist(f, 1.0, v, w, NULL));
        if (step % 3 == 1) assert_ok(cairn_filter_predict_increment(f, &moved, covariance, NULL));
        if (step % 3 == 2) assert_ok(cairn_filter_predict_wheels(f, 1.0, 1.8, 2.2, NULL));
        if (k == 0) plane_compare(f, f, 0); /* a query while motion is still pending */
        assert_ok(cairn_filter_update(f, sensor, o, count, m[k], NULL));
        double small[9] = {0.04, 0.01, 0, 0.01, 0.05, 0, 0, 0, 0.04};
        const double lever[3] = {0.3, -0.2, 0};
        to_map(&truth, lever, z);
        z[0] += 0.1 * ((step % 5) - 2), z[1] -= 0.05 * ((step % 7) - 3);
        if (step % 4 == 1)
          assert_ok(cairn_filter_update_position(f, z, small, step % 8 == 1 ? lever : NULL, &match, NULL));
        diagonal(small, 3, 2e-3);
        if (step % 4 == 2) assert_ok(cairn_filter_update_attitude(f, truth.quaternion, small, &match, NULL));
        if (step % 4 == 3) {
          double roll, pitch, yaw;
          assert_ok(cairn_quaternion_to_euler(truth.quaternion, &roll, &pitch, &yaw, NULL));
          assert_ok(cairn_filter_update_heading(f, yaw + 0.02, 0.05, &match, NULL));
        }
        if (step % 4 == 0 && step > 4) {
          const uint64_t ids[2] = {3, 8};
          const double r[2] = {0.05, -0.03}, noise2[4] = {0.02, 0.005, 0.005, 0.03};
          double jp[12] = {0}, jl[12] = {0};
          jp[0] = 1, jp[1] = 0.3, jp[5] = -2, jp[6] = 0.4, jp[7] = 1, jp[11] = 0.7;
          jl[0] = -1, jl[1] = 0.2, jl[3] = 0.5, jl[6] = 0.1, jl[7] = -0.6, jl[10] = 1;
          if (k == 0) jp[2] = jp[3] = jl[2] = jl[11] = 5; /* columns that do not exist in the plane */
          assert_ok(cairn_filter_update_linear(f, r, 2, noise2, jp, ids, 2, jl, &match, NULL));
          assert_int_equal(match.result, CAIRN_RESULT_MATCHED);
        }
      }
      for (size_t i = 0; i < count; ++i) {
        assert_int_equal(m[0][i].result, m[1][i].result);
        assert_int_equal(m[0][i].landmark, m[1][i].landmark);
      }
      plane_compare(filters[0], filters[1], 1e-9);
      if (step == 30)
        for (int k = 0; k < 2; ++k) assert_ok(cairn_filter_remove_landmark(filters[k], 4, NULL));
    }
    for (int k = 0; k < 2; ++k) {
      double pivot = 0;
      assert_ok(cairn_filter_audit(filters[k], &pivot, NULL));
      assert_true(pivot > 0);
      cairn_filter_destroy(filters[k]);
    }
  }
}

static void wheels_drive_an_arc(void** state) {
  const cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_STATE_ERROR_INVARIANT);
  cairn_filter* f = plane_filter(&options);
  cairn_wheels wheels;
  cairn_pose pose;
  double error[6];
  (void)state;
  assert_ok(cairn_wheels_init(&wheels, sizeof wheels, NULL));
  wheels.radius = 0.25, wheels.track = 0.8;
  assert_ok(cairn_filter_set_wheels(f, &wheels, NULL));
  assert_ok(cairn_filter_predict_wheels(f, 2.0, 3.0, 4.0, NULL));
  const double v = 0.25 * 3.5, rate = 0.25 / 0.8 * 1.0, turn = 2 * rate, r = v / rate, yaw = 0.1;
  const cairn_pose expected =
      pose_at(0.3 + r * (sin(yaw + turn) - sin(yaw)), -0.2 - r * (cos(yaw + turn) - cos(yaw)), 0, 0, 0, yaw + turn);
  assert_ok(cairn_filter_pose(f, &pose, NULL, NULL));
  assert_ok(cairn_pose_error(&pose, &expected, error, NULL));
  for (int i = 0; i < 6; ++i) assert_near(error[i], 0, 1e-12);
  cairn_filter_destroy(f);
}

/* Without rotation the filter is linear. Two scalar Kalman filters, written by hand, give the expected values. */
static void the_linear_case_is_a_kalman_filter(void** state) {
  cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_STATE_ERROR_INVARIANT);
  double P[2] = {0.5, 0.8}, x[2] = {3, -2}, c[36], noise[9];
  generator random = {12};
  (void)state;
  options.initial_pose = pose_at(x[0], x[1], 0, 0, 0, 0);
  memset(options.initial_covariance, 0, sizeof options.initial_covariance);
  options.initial_covariance[0] = P[0], options.initial_covariance[7] = P[1];
  cairn_filter* f = plane_filter(&options);
  for (int step = 0; step < 50; ++step) {
    const double d[2] = {random_normal(&random, 1), random_normal(&random, 1)};
    const double q[2] = {0.1, 0.02 * (1 + step % 3)}, r[2] = {0.3, 0.5};
    const cairn_pose moved = pose_at(d[0], d[1], 0, 0, 0, 0);
    const double z[3] = {x[0] + d[0] + random_normal(&random, 0.5), x[1] + d[1] + random_normal(&random, 0.5), 99};
    cairn_pose pose;
    diagonal(c, 6, 0);
    c[0] = q[0], c[7] = q[1];
    c[14] = 7, c[21] = 8; /* z and roll: ignored in the plane */
    assert_ok(cairn_filter_predict_increment(f, &moved, c, NULL));
    diagonal(noise, 3, 0);
    noise[0] = r[0], noise[4] = r[1], noise[8] = 1;
    assert_ok(cairn_filter_update_position(f, z, noise, NULL, NULL, NULL));
    for (int i = 0; i < 2; ++i) {
      const double before = P[i] + q[i], gain = before / (before + r[i]);
      x[i] += d[i];
      x[i] += gain * (z[i] - x[i]);
      P[i] = (1 - gain) * before;
    }
    assert_ok(cairn_filter_pose(f, &pose, c, NULL));
    for (int i = 0; i < 2; ++i) {
      assert_near(pose.position[i], x[i], 1e-12);
      assert_near(c[7 * i], P[i], 1e-14);
    }
    assert_true(c[1] == 0 && c[35] == 0);
  }
  cairn_filter_destroy(f);
}

/* If the filter is consistent, the sum of the NEES over 50 runs is chi-square with 150 degrees of freedom. 99.9 % of
 * that distribution lies within 150 [0.66, 1.43]. Each look is tested by itself. The sum of all looks is tested with
 * narrower bounds. */
static void the_covariance_is_consistent(void** state) {
  enum { RUNS = 50, LOOKS = 6, STEPS = 10 };
  double sums[LOOKS] = {0}, all = 0;
  (void)state;
  for (int run = 0; run < RUNS; ++run) {
    cairn_filter_options options = plane_options(CAIRN_VEHICLE_PLANAR, CAIRN_STATE_ERROR_INVARIANT);
    const cairn_range_bearing radar = plane_radar();
    generator random = {UINT64_C(900) + (uint64_t)run};
    cairn_pose truth;
    int32_t sensor;
    memset(options.initial_covariance, 0, sizeof options.initial_covariance);
    options.initial_covariance[0] = options.initial_covariance[7] = 0.04, options.initial_covariance[35] = 4e-4;
    options.initial_pose = pose_at(0, 0, 0, 0, 0, 0);
    truth = pose_at(random_normal(&random, 0.2), random_normal(&random, 0.2), 0, 0, 0, random_normal(&random, 0.02));
    cairn_filter* f = plane_filter(&options);
    assert_ok(cairn_filter_add_range_bearing(f, &radar, &sensor, NULL));
    for (int step = 1; step <= LOOKS * STEPS; ++step) {
      const double d[3] = {0.5, 0, 0.1}, sigma[3] = {0.05, 0.02, 0.01};
      const cairn_pose told = pose_at(d[0], d[1], 0, 0, 0, d[2]);
      const cairn_pose moved = pose_at(d[0] + random_normal(&random, sigma[0]), d[1] + random_normal(&random, sigma[1]),
                                       0, 0, 0, d[2] + random_normal(&random, sigma[2]));
      cairn_observation o[POINTS];
      double c[36], nees = 0;
      size_t count = 0;
      assert_ok(cairn_pose_compose(&truth, &moved, &truth, NULL));
      diagonal(c, 6, 0);
      c[0] = sigma[0] * sigma[0], c[7] = sigma[1] * sigma[1], c[35] = sigma[2] * sigma[2];
      assert_ok(cairn_filter_predict_increment(f, &told, c, NULL));
      for (size_t l = 0; l < POINTS; ++l) {
        double range, bearing;
        plane_polar(&truth, plane_points[l], &range, &bearing);
        if (range > 9 || range < 1) continue;
        o[count++] = sighting(l, range + random_normal(&random, 0.1), bearing + random_normal(&random, 0.01));
      }
      assert_ok(cairn_filter_update(f, sensor, o, count, NULL, NULL));
      if (step % STEPS != 0) continue;
      assert_ok(cairn_filter_pose_nees(f, &truth, &nees, NULL));
      sums[step / STEPS - 1] += nees;
      all += nees;
    }
    cairn_filter_destroy(f);
  }
  for (int look = 0; look < LOOKS; ++look) {
    assert_true(sums[look] / (3 * RUNS) > 0.66);
    assert_true(sums[look] / (3 * RUNS) < 1.43);
  }
  assert_true(all / (3 * RUNS * LOOKS) > 0.8 && all / (3 * RUNS * LOOKS) < 1.25);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(planar_equals_spatial_without_noise_out_of_the_plane),
      cmocka_unit_test(wheels_drive_an_arc),
      cmocka_unit_test(the_linear_case_is_a_kalman_filter),
      cmocka_unit_test(the_covariance_is_consistent),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
