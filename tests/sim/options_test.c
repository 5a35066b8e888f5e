/* SPDX-License-Identifier: BSD-3-Clause */
/* Options of a world: defaults, presets, structs of other versions, and refused values. */
#include "support.h"

static void defaults_equal_table_1(void** state) {
  const cairn_world_options o = default_options();
  (void)state;
  assert_int_equal(o.struct_size, sizeof o);
  assert_int_equal(o.landmarks, 200);
  assert_near(o.wheel_radius, 0.3, 0);
  assert_near(o.velocity_sigma, 2e-3, 0);
  assert_near(o.rate_sigma, 0.02 * DEGREE, 1e-18);
  assert_near(o.range_sigma, 1, 0);
  assert_near(o.azimuth_sigma, 3 * DEGREE, 1e-16);
  assert_near(o.stick_sigma, 3 * DEGREE, 1e-16);
  assert_near(1 / o.imu_period, 20, 1e-12);
  assert_near(o.motion_period, 0.2, 0);
  assert_near(1 / o.frame_period, 0.5, 0);
  assert_near(o.start_height, -0.3174, 0);
  assert_near(2 * PI * hypot(100, 20) / o.speed, 400, 1e-9);
}

static void presets(void** state) {
  static const struct {
    double velocity, rate, laps;
    uint32_t submap;
  } rows[] = {{0.002, 0.02, 1, 40}, {0.05, 0.2, 1, 40}, {0.05, 0.2, 2, 20}, {0.2, 1, 2, 20}};
  cairn_world_options o = default_options();
  uint32_t submap = 0;
  int i;
  (void)state;
  o.seed = 77;
  for (i = 0; i < 4; ++i) {
    o.landmark_height = 9; /* a preset must overwrite all of this */
    assert_ok(cairn_world_options_preset(&o, CAIRN_PRESET_ROW1 + i, &submap, NULL));
    assert_int_equal(submap, rows[i].submap);
    assert_near(o.velocity_sigma, rows[i].velocity, 0);
    assert_near(o.rate_sigma, rows[i].rate * DEGREE, 1e-15);
    assert_near(o.laps, rows[i].laps, 0);
    assert_near(2 * PI * 101.98 * o.laps / o.speed, 400, 1e-9);
    assert_near(o.imu_period, 0.2, 0);
    assert_near(o.landmark_height, 1.5, 0);
    assert_int_equal(o.terrain, CAIRN_TERRAIN_WAVES);
    assert_int_equal(o.contact, CAIRN_CONTACT_POINT);
    assert_int_equal(o.seed, 77);
  }
  assert_ok(cairn_world_options_preset(&o, CAIRN_PRESET_PAPER, &submap, NULL));
  assert_int_equal(submap, 40);
  o.seed = 1;
  {
    const cairn_world_options d = default_options();
    assert_memory_equal(&o, &d, sizeof o);
  }
  assert_refused(cairn_world_options_preset(&o, 5, NULL, NULL), CAIRN_ERROR_ARGUMENT, "preset");
  assert_refused(cairn_world_options_preset(&o, -1, NULL, NULL), CAIRN_ERROR_ARGUMENT, "preset");
  assert_refused(cairn_world_options_preset(NULL, 0, NULL, NULL), CAIRN_ERROR_ARGUMENT, "options");
}

/* No byte beyond the caller's struct is written, and fields that an older caller lacks have their defaults. */
static void other_sizes(void** state) {
  unsigned char bytes[sizeof(cairn_world_options) + 64];
  const size_t old = offsetof(cairn_world_options, landmarks) + sizeof(uint32_t);
  cairn_world_options* o = (cairn_world_options*)(void*)malloc(sizeof bytes);
  cairn_world* world = NULL;
  size_t i;
  double position[3];
  (void)state;
  assert_non_null(o);
  memset(o, 0xa5, sizeof bytes);
  assert_ok(cairn_world_options_init(o, old, NULL));
  for (i = old; i < sizeof bytes; ++i) assert_int_equal(((unsigned char*)o)[i], 0xa5);
  o->landmarks = 31;
  assert_ok(cairn_world_options_preset(o, CAIRN_PRESET_ROW4, NULL, NULL));
  for (i = old; i < sizeof bytes; ++i) assert_int_equal(((unsigned char*)o)[i], 0xa5);
  o->landmarks = 31;
  assert_ok(cairn_world_create(o, &world, NULL));
  assert_ok(cairn_world_landmark(world, 30, position, NULL));
  assert_refused(cairn_world_landmark(world, 31, position, NULL), CAIRN_ERROR_NOT_FOUND, "id 31");
  cairn_world_destroy(world);
  memset(o, 0xa5, sizeof bytes);
  assert_ok(cairn_world_options_init(o, sizeof bytes, NULL)); /* a newer caller */
  assert_int_equal(((unsigned char*)o)[sizeof bytes - 1], 0);
  world = open_world(o);
  cairn_world_destroy(world);
  free(o);
  assert_refused(cairn_world_options_init(NULL, 100, NULL), CAIRN_ERROR_ARGUMENT, "options");
  assert_refused(cairn_world_options_init((cairn_world_options*)(void*)bytes, 4, NULL), CAIRN_ERROR_ARGUMENT,
                 "struct_size");
}

#define REFUSE(field, value)                                                                \
  do {                                                                                      \
    cairn_world_options bad = default_options();                                            \
    cairn_world* none = NULL;                                                               \
    bad.field = (value);                                                                    \
    assert_refused(cairn_world_create(&bad, &none, NULL), CAIRN_ERROR_ARGUMENT, "options"); \
    assert_null(none);                                                                      \
  } while (0)

static void bad_options(void** state) {
  const double not_positive[] = {0, -1, NAN, INFINITY}, negative[] = {-1e-9, NAN, INFINITY};
  size_t i;
  (void)state;
  REFUSE(course, 3);
  REFUSE(course, -1);
  REFUSE(terrain, 3);
  REFUSE(contact, 2);
  REFUSE(drive, 2);
  REFUSE(accelerometer, 2);
  REFUSE(stick_noise, 2);
  REFUSE(observe_at_start, 2);
  REFUSE(traverse_closed, 2);
  REFUSE(landmarks, 0);
  REFUSE(landmarks, 10000001);
  REFUSE(struct_size, 3);
  for (i = 0; i < LENGTH(not_positive); ++i) {
    const double v = not_positive[i];
    REFUSE(speed, v);
    REFUSE(round_length, v);
    REFUSE(strip, v);
    REFUSE(landmark_area, v);
    REFUSE(wavelength[0], v);
    REFUSE(wavelength[1], v);
    REFUSE(wheel_radius, v);
    REFUSE(track, v);
    REFUSE(wheelbase, v);
    REFUSE(imu_period, v);
    REFUSE(motion_period, v);
    REFUSE(frame_period, v);
    REFUSE(range_sigma, v);
    REFUSE(azimuth_sigma, v);
    REFUSE(stick_sigma, v);
    REFUSE(image_sigma, v);
    REFUSE(near_range, v);
    REFUSE(far_range, v);
    REFUSE(half_azimuth, v);
    REFUSE(pan_period, v);
    REFUSE(stick_period, v);
  }
  for (i = 0; i < LENGTH(negative); ++i) {
    const double v = negative[i];
    REFUSE(laps, v);
    REFUSE(radius, v);
    REFUSE(round_variation, v);
    REFUSE(landmark_height, v);
    REFUSE(max_slope, v);
    REFUSE(velocity_sigma, v);
    REFUSE(rate_sigma, v);
    REFUSE(gravity, v);
    REFUSE(wheel_rate_sigma, v);
    REFUSE(wheel_slip_sigma, v);
    REFUSE(lateral_sigma, v);
    REFUSE(vertical_sigma, v);
    REFUSE(pan_amplitude, v);
    REFUSE(stick_amplitude, v);
  }
  REFUSE(centre[1], NAN);
  REFUSE(start_azimuth, INFINITY);
  REFUSE(start_height, NAN);
  REFUSE(platform[2], NAN);
  REFUSE(stick[0], INFINITY);
  REFUSE(round_variation, 0.31);
  REFUSE(max_slope, 46 * DEGREE);
  REFUSE(half_azimuth, 3.2);
  REFUSE(stick_amplitude, 61 * DEGREE);
}

static void contradictions(void** state) {
  cairn_world_options o = default_options();
  cairn_world* world = NULL;
  (void)state;
  REFUSE(radius, 25);          /* not larger than the strip */
  REFUSE(far_range, 1.5);      /* below near_range */
  REFUSE(wavelength[0], 151);  /* above the longest wavelength */
  REFUSE(motion_period, 0.12); /* not a multiple of 0.05 */
  REFUSE(frame_period, 2.1);
  REFUSE(laps, 1e300);
  o.course = CAIRN_COURSE_TRAVERSE;
  o.traverse_closed = 1;
  assert_refused(cairn_world_create(&o, &world, NULL), CAIRN_ERROR_ARGUMENT, "traverse_closed");
  assert_refused(cairn_world_create(NULL, &world, NULL), CAIRN_ERROR_ARGUMENT, "options");
  o = default_options();
  assert_refused(cairn_world_create(&o, NULL, NULL), CAIRN_ERROR_ARGUMENT, "world");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_equal_table_1),
      cmocka_unit_test(presets),
      cmocka_unit_test(other_sizes),
      cmocka_unit_test(bad_options),
      cmocka_unit_test(contradictions),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
