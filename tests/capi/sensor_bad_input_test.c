/* SPDX-License-Identifier: BSD-3-Clause */
/* Sensor descriptions that filters refuse, and structs of other versions. */
#include "support.h"

typedef union description {
  uint32_t struct_size;
  cairn_stereo_head head;
  cairn_stereo_camera camera;
  cairn_cartesian cartesian;
  cairn_custom custom;
} description;

static cairn_status init(int kind, void* d, size_t size) {
  if (kind == HEAD) return cairn_stereo_head_init(d, size, NULL);
  if (kind == CAMERA) return cairn_stereo_camera_init(d, size, NULL);
  if (kind == CARTESIAN) return cairn_cartesian_init(d, size, NULL);
  return cairn_custom_init(d, size, NULL);
}

static cairn_status add(cairn_filter* filter, int kind, const void* d, int32_t* sensor) {
  if (kind == HEAD) return cairn_filter_add_stereo_head(filter, d, sensor, NULL);
  if (kind == CAMERA) return cairn_filter_add_stereo_camera(filter, d, sensor, NULL);
  if (kind == CARTESIAN) return cairn_filter_add_cartesian(filter, d, sensor, NULL);
  return cairn_filter_add_custom(filter, d, point_predict, point_place, NULL, NULL, sensor, NULL);
}

enum { KINDS = POINT + 1 };
static const char* const names[KINDS] = {"head", "camera", "cartesian", "custom"};
static const size_t sizes[KINDS] = {sizeof(cairn_stereo_head), sizeof(cairn_stereo_camera), sizeof(cairn_cartesian),
                                    sizeof(cairn_custom)};

static description good(int kind) {
  description d;
  memset(&d, 0, sizeof d);
  assert_ok(init(kind, &d, sizes[kind]));
  return d;
}

/* A bench with room for one more sensor, so that no refusal is due to the capacity. */
static int roomy_setup(void** state) {
  bench* b = malloc(sizeof *b);
  cairn_filter_options options = test_options();
  assert_non_null(b);
  options.max_sensors = SENSORS + 1;
  bench_open(b, &options, 12);
  *state = b;
  return 0;
}

static void refuse(bench* b, int kind, const description* d, const char* name) {
  int32_t sensor = 4711;
  assert_refused(b, CAIRN_ERROR_ARGUMENT, name, add(b->main.filter, kind, d, &sensor));
  assert_int_equal(sensor, 4711);
}

enum { POSITIVE, NOT_NEGATIVE, FINITE };
typedef struct field {
  const char* name;
  int kind;
  int rule;
  size_t offset;
  int count;
} field;
#define FIELD(kind, type, member, rule, count) \
  { #member, kind, rule, offsetof(type, member), count }
static const field fields[] = {
    FIELD(HEAD, cairn_stereo_head, platform, FINITE, 3),
    FIELD(HEAD, cairn_stereo_head, stick, FINITE, 3),
    FIELD(HEAD, cairn_stereo_head, camera_quaternion, FINITE, 4),
    FIELD(HEAD, cairn_stereo_head, range_sigma, POSITIVE, 1),
    FIELD(HEAD, cairn_stereo_head, azimuth_sigma, POSITIVE, 1),
    FIELD(HEAD, cairn_stereo_head, elevation_sigma, POSITIVE, 1),
    FIELD(HEAD, cairn_stereo_head, pan_sigma, NOT_NEGATIVE, 1),
    FIELD(HEAD, cairn_stereo_head, stick_sigma, NOT_NEGATIVE, 1),
    FIELD(HEAD, cairn_stereo_head, near_range, POSITIVE, 1),
    FIELD(HEAD, cairn_stereo_head, max_elevation, POSITIVE, 1),
    FIELD(CAMERA, cairn_stereo_camera, fu, POSITIVE, 1),
    FIELD(CAMERA, cairn_stereo_camera, fv, POSITIVE, 1),
    FIELD(CAMERA, cairn_stereo_camera, cu, FINITE, 1),
    FIELD(CAMERA, cairn_stereo_camera, cv, FINITE, 1),
    FIELD(CAMERA, cairn_stereo_camera, baseline, POSITIVE, 1),
    FIELD(CAMERA, cairn_stereo_camera, T_body_camera, FINITE, 7),
    FIELD(CAMERA, cairn_stereo_camera, sigma, POSITIVE, 3),
    FIELD(CAMERA, cairn_stereo_camera, near_depth, POSITIVE, 1),
    FIELD(CAMERA, cairn_stereo_camera, min_disparity, POSITIVE, 1),
    FIELD(CAMERA, cairn_stereo_camera, min_disparity_sigmas, NOT_NEGATIVE, 1),
    FIELD(CARTESIAN, cairn_cartesian, T_body_sensor, FINITE, 7),
    FIELD(CARTESIAN, cairn_cartesian, sigma, POSITIVE, 3),
    FIELD(POINT, cairn_custom, sigma, POSITIVE, 3),
};

static void bad_numbers_are_refused_by_field(void** state) {
  bench* b = *state;
  for (size_t k = 0; k < LENGTH(fields); ++k) {
    const field* f = &fields[k];
    const double bad[] = {NAN, INFINITY, -INFINITY, -1e-9, 0.0};
    const int count = f->rule == POSITIVE ? 5 : f->rule == NOT_NEGATIVE ? 4 : 3;
    for (int i = 0; i < f->count; ++i)
      for (int n = 0; n < count; ++n) {
        description d = good(f->kind);
        ((double*)(void*)((unsigned char*)&d + f->offset))[i] = bad[n];
        refuse(b, f->kind, &d, f->name);
      }
  }
}

static void zero_quaternions_and_ranges_of_choices_are_refused(void** state) {
  bench* b = *state;
  static const double elevations[] = {PI / 2, 2, 100};
  static const int32_t modes[] = {-1, 2, INT32_MIN, INT32_MAX};
  static const uint32_t rows[] = {0, 4, UINT32_MAX};
  description d = good(HEAD);
  memset(d.head.camera_quaternion, 0, sizeof d.head.camera_quaternion);
  refuse(b, HEAD, &d, "camera_quaternion");
  d = good(CAMERA);
  memset(d.camera.T_body_camera.quaternion, 0, sizeof d.camera.T_body_camera.quaternion);
  refuse(b, CAMERA, &d, "T_body_camera");
  d = good(CARTESIAN);
  memset(d.cartesian.T_body_sensor.quaternion, 0, sizeof d.cartesian.T_body_sensor.quaternion);
  refuse(b, CARTESIAN, &d, "T_body_sensor");
  for (size_t n = 0; n < LENGTH(elevations); ++n) {
    d = good(HEAD);
    d.head.max_elevation = elevations[n];
    refuse(b, HEAD, &d, "max_elevation");
  }
  for (size_t n = 0; n < LENGTH(modes); ++n) {
    d = good(HEAD);
    d.head.encoder_mode = modes[n];
    refuse(b, HEAD, &d, "encoder_mode");
  }
  for (size_t n = 0; n < LENGTH(rows); ++n) {
    d = good(POINT);
    d.custom.rows = rows[n];
    refuse(b, POINT, &d, "rows");
  }
  for (uint32_t few = 1; few < 3; ++few) { /* two rows do not determine the position of a landmark */
    d = good(POINT);
    d.custom.rows = few;
    refuse(b, POINT, &d, "place");
  }
  d = good(POINT);
  d.custom.relative = 2;
  refuse(b, POINT, &d, "relative");
  {
    own_sensor own = test_point();
    int32_t sensor = 4711;
    own.predict = NULL;
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "predict", add_own(b->main.filter, &own, &sensor));
    assert_int_equal(sensor, 4711);
  }
}

static void nulls_are_refused_by_name(void** state) {
  bench* b = *state;
  for (int kind = 0; kind < KINDS; ++kind) {
    const description d = good(kind);
    int32_t sensor = 4711;
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter", add(NULL, kind, &d, &sensor));
    refuse(b, kind, NULL, names[kind]);
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "sensor", add(b->main.filter, kind, &d, NULL));
    assert_int_equal(sensor, 4711);
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, names[kind], init(kind, NULL, sizes[kind]));
  }
}

/* After a refusal there is still room for exactly one sensor. */
static void a_full_filter_accepts_no_sensor(void** state) {
  bench* b = *state;
  for (int kind = 0; kind < KINDS; ++kind) {
    const description d = good(kind);
    int32_t sensor = -1;
    if (kind == 0) {
      assert_ok(add(b->main.filter, kind, &d, &sensor));
      assert_int_equal(sensor, SENSORS);
      assert_ok(add(b->shadow.filter, kind, &d, &sensor));
    }
    sensor = 4711;
    assert_refused(b, CAIRN_ERROR_CAPACITY, "max_sensors", add(b->main.filter, kind, &d, &sensor));
    assert_int_equal(sensor, 4711);
  }
}

static void too_small_sizes_are_refused(void** state) {
  bench* b = *state;
  static const uint32_t none[] = {0, 1, 3, (uint32_t)1 << 31, UINT32_MAX};
  static const size_t wide[] = {(size_t)1 << 32, SIZE_MAX};
  for (int kind = 0; kind < KINDS; ++kind) {
    description canary, kept;
    memset(&canary, 0x5a, sizeof canary);
    kept = canary;
    for (size_t n = 0; n < LENGTH(none); ++n) {
      description d = good(kind);
      d.struct_size = none[n];
      refuse(b, kind, &d, "struct_size");
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "struct_size", init(kind, &canary, none[n]));
    }
    for (size_t n = 0; n < LENGTH(wide); ++n)
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "struct_size", init(kind, &canary, wide[n]));
    assert_memory_equal(&canary, &kept, sizeof kept);
  }
}

/* Every size from the first fields to beyond the last one: _init writes no more bytes than the given size, and they
 * begin with the defaults. */
static void init_fills_at_most_what_it_is_given(void** state) {
  (void)state;
  for (int kind = 0; kind < KINDS; ++kind) {
    description whole;
    unsigned char expected[sizeof(description)];
    memset(&whole, 0, sizeof whole);
    assert_ok(init(kind, &whole, sizes[kind]));
    memcpy(expected, &whole, sizes[kind]);
    for (size_t size = 8; size < sizes[kind] + 24; ++size) {
      struct {
        description known;
        unsigned char later[32];
      } given;
      unsigned char bytes[sizeof given];
      memset(&given, 0x5a, sizeof given);
      assert_ok(init(kind, &given.known, size));
      memcpy(bytes, &given, sizeof bytes);
      assert_int_equal(given.known.struct_size, size);
      assert_memory_equal(bytes + 4, expected + 4, (size < sizes[kind] ? size : sizes[kind]) - 4);
      for (size_t i = size; i < sizeof bytes; ++i) assert_int_equal(bytes[i], 0x5a);
    }
  }
}

/* A cartesian sensor of a caller without the field `sigma`, and of a caller with more fields than the library: both
 * behave like the exact one. */
static void structs_of_other_versions_work(void** state) {
  struct {
    cairn_cartesian now;
    double later[3];
  } future;
  cairn_cartesian exact = test_cartesian(), old;
  snapshot a = {0, NULL}, c = {0, NULL};
  (void)state;
  exact.T_body_sensor.position[0] = 0.4;
  memset(&old, 0xff, sizeof old); /* as sigma: NaN */
  assert_ok(cairn_cartesian_init(&old, offsetof(cairn_cartesian, sigma), NULL));
  old.T_body_sensor.position[0] = 0.4;
  memset(&future, 0, sizeof future); /* what this library does not know must be zero */
  future.now = exact;
  future.now.struct_size = sizeof future;
  const cairn_cartesian* all[] = {&exact, &old, &future.now};
  for (size_t k = 0; k < LENGTH(all); ++k) {
    const cairn_filter_options options = test_options();
    cairn_filter* filter = NULL;
    cairn_observation o = {3, {4, 5, 6}, {0}};
    int32_t sensor;
    assert_ok(cairn_filter_create(&options, &filter, NULL));
    assert_ok(cairn_filter_add_cartesian(filter, all[k], &sensor, NULL));
    assert_ok(cairn_filter_update(filter, sensor, &o, 1, NULL, NULL));
    snapshot_take(k == 0 ? &a : &c, filter);
    if (k > 0) assert_true(snapshot_same(&a, &c));
    cairn_filter_destroy(filter);
  }
  snapshot_free(&a);
  snapshot_free(&c);
}

static void point_head_refuses(void** state) {
  bench* b = *state;
  cairn_filter* f = b->main.filter;
  const int32_t head = b->main.sensors[HEAD];
  static const int32_t unknown[] = {-1, SENSORS, 99, INT32_MAX, INT32_MIN};
  assert_refused(b, CAIRN_ERROR_ARGUMENT, "filter", cairn_filter_point_head(NULL, head, 0.1, 0.1, NULL));
  for (size_t n = 0; n < LENGTH(unknown); ++n)
    assert_refused(b, CAIRN_ERROR_NOT_FOUND, "sensor", cairn_filter_point_head(f, unknown[n], 0.1, 0.1, NULL));
  for (int kind = CAMERA; kind < SENSORS; ++kind)
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "sensor",
                   cairn_filter_point_head(f, b->main.sensors[kind], 0.1, 0.1, NULL));
  for (size_t n = 0; n < LENGTH(not_finite); ++n) {
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "pan", cairn_filter_point_head(f, head, not_finite[n], 0.1, NULL));
    assert_refused(b, CAIRN_ERROR_ARGUMENT, "stick", cairn_filter_point_head(f, head, 0.1, not_finite[n], NULL));
  }
}

static int32_t blind_predict(void* user, const cairn_pose* pose, const double landmark[3], double* z,
                             double* jacobian_pose, double* jacobian_landmark) {
  (void)user, (void)pose, (void)landmark, (void)z, (void)jacobian_pose, (void)jacobian_landmark;
  return 0;
}

static void custom_check_refuses(void** state) {
  const cairn_pose pose = pose_at(1, 2, 3, 0.1, 0.2, 0.3);
  const double landmark[3] = {5, 6, 7};
  own_sensor custom = test_point();
  double worst = 4711;
  (void)state;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "custom",
                 cairn_custom_check(NULL, point_predict, point_place, NULL, &pose, landmark, &worst, NULL));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "pose", check_own(&custom, NULL, landmark, &worst));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmark", check_own(&custom, &pose, NULL, &worst));
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "worst", check_own(&custom, &pose, landmark, NULL));
  for (int i = 0; i < 7; ++i)
    for (size_t n = 0; n < LENGTH(not_finite); ++n) {
      cairn_pose bad = pose;
      double where[3] = {5, 6, 7};
      *(i < 3 ? &bad.position[i] : &bad.quaternion[i - 3]) = not_finite[n];
      where[i % 3] = not_finite[n];
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "pose", check_own(&custom, &bad, landmark, &worst));
      assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmark", check_own(&custom, &pose, where, &worst));
    }
  custom.model.rows = 4;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "rows", check_own(&custom, &pose, landmark, &worst));
  custom = test_point();
  custom.model.struct_size = 3;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "struct_size", check_own(&custom, &pose, landmark, &worst));
  custom = test_point();
  custom.predict = NULL;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "predict", check_own(&custom, &pose, landmark, &worst));
  custom.predict = blind_predict;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "landmark", check_own(&custom, &pose, landmark, &worst));
  assert_true(worst == 4711);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(bad_numbers_are_refused_by_field, roomy_setup, bench_teardown),
      cmocka_unit_test_setup_teardown(zero_quaternions_and_ranges_of_choices_are_refused, roomy_setup, bench_teardown),
      cmocka_unit_test_setup_teardown(nulls_are_refused_by_name, roomy_setup, bench_teardown),
      cmocka_unit_test_setup_teardown(a_full_filter_accepts_no_sensor, roomy_setup, bench_teardown),
      cmocka_unit_test_setup_teardown(too_small_sizes_are_refused, roomy_setup, bench_teardown),
      cmocka_unit_test(init_fills_at_most_what_it_is_given),
      cmocka_unit_test(structs_of_other_versions_work),
      cmocka_unit_test_setup_teardown(point_head_refuses, roomy_setup, bench_teardown),
      cmocka_unit_test(custom_check_refuses),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
