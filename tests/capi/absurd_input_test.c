/* SPDX-License-Identifier: BSD-3-Clause */
/* Descriptions and places of astronomic size are refused by name. */
#include "points_ahead.h"

/* Sigmas whose square overflows or vanishes, and places that no map has, are refused by name. */
static void absurd_descriptions_are_refused(void** state) {
  static const double sigmas[] = {1e154, 1e308, 1e51, 1e-51, 1e-160, 5e-324};
  (void)state;
  for (size_t k = 0; k < LENGTH(sigmas); ++k) {
    const cairn_filter_options o = options_of(CAIRN_VEHICLE_SPATIAL, CAIRN_STATE_ERROR_INVARIANT);
    cairn_filter* f = create(&o);
    int32_t sensor = -1;
    double covariance[36];
    const double here[3] = {0, 0, 0};
    for (int field = 0; field < 5; ++field) {
      static const char* const names[] = {"head.range_sigma", "head.azimuth_sigma", "head.elevation_sigma",
                                          "head.pan_sigma", "head.stick_sigma"};
      cairn_stereo_head head;
      assert_ok(cairn_stereo_head_init(&head, sizeof head, NULL));
      double* const fields[] = {&head.range_sigma, &head.azimuth_sigma, &head.elevation_sigma, &head.pan_sigma,
                                &head.stick_sigma};
      *fields[field] = sigmas[k];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, names[field], cairn_filter_add_stereo_head(f, &head, &sensor, NULL));
    }
    for (int i = 0; i < 3; ++i) {
      cairn_stereo_camera camera;
      cairn_cartesian cartesian;
      own_sensor custom = test_point();
      cairn_twist_noise noise;
      assert_ok(cairn_stereo_camera_init(&camera, sizeof camera, NULL));
      assert_ok(cairn_cartesian_init(&cartesian, sizeof cartesian, NULL));
      assert_ok(cairn_twist_noise_init(&noise, sizeof noise, NULL));
      camera.sigma[i] = cartesian.sigma[i] = custom.model.sigma[i] = sigmas[k];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "camera.sigma",
                     cairn_filter_add_stereo_camera(f, &camera, &sensor, NULL));
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "cartesian.sigma",
                     cairn_filter_add_cartesian(f, &cartesian, &sensor, NULL));
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "custom.sigma", add_own(f, &custom, &sensor));
      noise.velocity_sigma[i] = sigmas[k];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "noise.velocity_sigma", cairn_filter_set_twist_noise(f, &noise, NULL));
      noise.velocity_sigma[i] = 0, noise.rate_sigma[i] = sigmas[k];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "noise.rate_sigma", cairn_filter_set_twist_noise(f, &noise, NULL));
    }
    for (int field = 0; field < 6; ++field) {
      static const char* const names[] = {"wheels.rate_sigma",     "wheels.slip_sigma",      "wheels.lateral_sigma",
                                          "wheels.vertical_sigma", "wheels.roll_rate_sigma", "wheels.pitch_rate_sigma"};
      cairn_wheels wheels;
      assert_ok(cairn_wheels_init(&wheels, sizeof wheels, NULL));
      double* const fields[] = {&wheels.rate_sigma,     &wheels.slip_sigma,      &wheels.lateral_sigma,
                                &wheels.vertical_sigma, &wheels.roll_rate_sigma, &wheels.pitch_rate_sigma};
      *fields[field] = sigmas[k];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, names[field], cairn_filter_set_wheels(f, &wheels, NULL));
    }
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "sigma", cairn_filter_update_heading(f, 0, sigmas[k], NULL, NULL));
    diagonal(covariance, 3, sigmas[k] < 1e150 ? sigmas[k] * sigmas[k] : sigmas[k]);
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "covariance",
                   cairn_filter_update_position(f, here, covariance, NULL, NULL, NULL));
    cairn_filter_destroy(f);
  }
}

static void absurd_places_are_refused(void** state) {
  static const double places[] = {1.1e12, -1e13, 1e100, 1.7e308};
  (void)state;
  for (size_t k = 0; k < LENGTH(places); ++k)
    for (int i = 0; i < 3; ++i) {
      cairn_filter_options o = options_of(CAIRN_VEHICLE_SPATIAL, CAIRN_STATE_ERROR_INVARIANT);
      cairn_filter *f = create(&o), *none = NULL;
      cairn_stereo_head head;
      cairn_stereo_camera camera;
      cairn_cartesian cartesian;
      double at[3] = {0, 0, 0}, noise[9];
      int32_t sensor = -1;
      at[i] = places[k];
      diagonal(noise, 3, 1);
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "position[",
                     cairn_filter_update_position(f, at, noise, NULL, NULL, NULL));
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "lever_arm[",
                     cairn_filter_update_position(f, noise + 1, noise, at, NULL, NULL));
      assert_ok(cairn_stereo_head_init(&head, sizeof head, NULL));
      head.platform[i] = places[k];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "head.platform[",
                     cairn_filter_add_stereo_head(f, &head, &sensor, NULL));
      head.platform[i] = 0, head.stick[i] = places[k];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "head.stick[", cairn_filter_add_stereo_head(f, &head, &sensor, NULL));
      assert_ok(cairn_stereo_camera_init(&camera, sizeof camera, NULL));
      camera.T_body_camera.position[i] = places[k];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "camera.T_body_camera.position[",
                     cairn_filter_add_stereo_camera(f, &camera, &sensor, NULL));
      assert_ok(cairn_cartesian_init(&cartesian, sizeof cartesian, NULL));
      cartesian.T_body_sensor.position[i] = places[k];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "cartesian.T_body_sensor.position[",
                     cairn_filter_add_cartesian(f, &cartesian, &sensor, NULL));
      o.initial_pose.position[i] = places[k];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "initial_pose.position[", cairn_filter_create(&o, &none, NULL));
      o.initial_pose.position[i] = 0, o.initial_covariance[7 * i] = 1.1e18;
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "initial_covariance", cairn_filter_create(&o, &none, NULL));
      o.initial_covariance[7 * i] = 0, o.initial_covariance[7 * (i + 3)] = 1.1e4;
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "initial_covariance", cairn_filter_create(&o, &none, NULL));
      cairn_filter_destroy(f);
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(absurd_descriptions_are_refused),
      cmocka_unit_test(absurd_places_are_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
