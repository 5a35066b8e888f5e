/* SPDX-License-Identifier: BSD-3-Clause */
/* Rules of the boundary that hold for every function: errors in the caller's memory, bytes that nobody knows, sizes of
 * arrays, answers of callbacks, and who frees what. */
#include "support.h"

static cairn_filter* open_filter(void) {
  const cairn_filter_options options = test_options();
  cairn_filter* filter = NULL;
  assert_ok(cairn_filter_create(&options, &filter, NULL));
  return filter;
}

/* --- errors --- */

static void a_failure_fills_in_the_callers_error(void** state) {
  cairn_filter* filter = open_filter();
  cairn_error error = {sizeof error, 77, "before"}, other = {sizeof other, 77, "before"};
  (void)state;
  assert_status(cairn_filter_predict_wheels(filter, -1, 0, 0, &error), CAIRN_ERROR_ARGUMENT);
  assert_int_equal(error.status, CAIRN_ERROR_ARGUMENT);
  assert_string_equal(error.message, cairn_last_message());
  assert_non_null(strstr(error.message, "dt"));
  assert_int_equal(error.struct_size, sizeof error);
  /* The next failure is another one's. */
  assert_status(cairn_filter_remove_landmark(filter, 4711, &other), CAIRN_ERROR_NOT_FOUND);
  assert_int_equal(other.status, CAIRN_ERROR_NOT_FOUND);
  assert_non_null(strstr(other.message, "4711"));
  assert_non_null(strstr(error.message, "dt"));
  /* A success leaves it as it is. */
  assert_ok(cairn_filter_predict_wheels(filter, 0.1, 1, 1, &error));
  assert_int_equal(error.status, CAIRN_ERROR_ARGUMENT);
  assert_non_null(strstr(error.message, "dt"));
  cairn_filter_destroy(filter);
}

/* Every size of the struct: no byte beyond it is written, and the text always ends inside it. */
static void an_error_of_any_size_is_not_overrun(void** state) {
  cairn_filter* filter = open_filter();
  cairn_error whole = {sizeof whole, 0, ""};
  (void)state;
  assert_status(cairn_filter_predict_wheels(filter, -1, 0, 0, &whole), CAIRN_ERROR_ARGUMENT);
  for (size_t size = 0; size < sizeof(cairn_error) + 32; ++size) {
    union {
      cairn_error error;
      unsigned char bytes[sizeof(cairn_error) + 64];
    } u;
    const size_t text = offsetof(cairn_error, message);
    const size_t known = size < sizeof(cairn_error) ? size : sizeof(cairn_error);
    memset(&u, 0xa5, sizeof u);
    u.error.struct_size = (uint32_t)size;
    assert_status(cairn_filter_predict_wheels(filter, -1, 0, 0, &u.error), CAIRN_ERROR_ARGUMENT);
    for (size_t i = known < 4 ? 4 : known; i < sizeof u; ++i) assert_int_equal(u.bytes[i], 0xa5);
    if (size >= text) assert_int_equal(u.error.status, CAIRN_ERROR_ARGUMENT);
    if (size <= text) continue;
    const size_t room = known - text, length = strlen(whole.message);
    assert_non_null(memchr(u.error.message, 0, room));
    assert_int_equal(strlen(u.error.message), length < room ? length : room - 1);
    assert_memory_equal(u.error.message, whole.message, strlen(u.error.message));
  }
  cairn_filter_destroy(filter);
}

/* --- bytes that this library does not know --- */

#define REFUSES_RESERVED(type, init, field, call, word)       \
  do {                                                        \
    type given;                                               \
    assert_ok(init(&given, sizeof given, NULL));              \
    given.field = 1;                                          \
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, word, (call)); \
    given.field = 0;                                          \
    assert_ok(call);                                          \
  } while (0)

static void reserved_fields_must_be_zero(void** state) {
  cairn_filter* filter = open_filter();
  int32_t sensor = -1;
  size_t bytes = 0;
  (void)state;
  REFUSES_RESERVED(cairn_filter_options, cairn_filter_options_init, reserved,
                   cairn_filter_required_bytes(&given, &bytes, NULL), "options.reserved");
  REFUSES_RESERVED(cairn_stereo_camera, cairn_stereo_camera_init, reserved,
                   cairn_filter_add_stereo_camera(filter, &given, &sensor, NULL), "camera.reserved");
  REFUSES_RESERVED(cairn_cartesian, cairn_cartesian_init, reserved,
                   cairn_filter_add_cartesian(filter, &given, &sensor, NULL), "cartesian.reserved");
  REFUSES_RESERVED(cairn_twist_noise, cairn_twist_noise_init, reserved,
                   cairn_filter_set_twist_noise(filter, &given, NULL), "noise.reserved");
  REFUSES_RESERVED(cairn_calibration, cairn_calibration_init, reserved,
                   cairn_filter_calibrate_sensor(filter, sensor, &given, NULL), "calibration.reserved");
  cairn_filter_destroy(filter);
}

static void the_radars_reserved_field_must_be_zero(void** state) {
  cairn_filter_options options = test_options();
  cairn_filter* filter = NULL;
  int32_t sensor = -1;
  (void)state;
  options.vehicle = CAIRN_VEHICLE_PLANAR;
  options.initial_pose = pose_at(0, 0, 0, 0, 0, 0);
  assert_ok(cairn_filter_create(&options, &filter, NULL));
  REFUSES_RESERVED(cairn_range_bearing, cairn_range_bearing_init, reserved,
                   cairn_filter_add_range_bearing(filter, &given, &sensor, NULL), "radar.reserved");
  cairn_filter_destroy(filter);
}

/* A newer caller whose new fields are zero is served, one that asks for something new is told so. */
static void unknown_bytes_must_be_zero(void** state) {
  struct {
    cairn_filter_options options;
    unsigned char newer[24];
  } given;
  size_t bytes = 0;
  (void)state;
  memset(&given, 0xa5, sizeof given);
  assert_ok(cairn_filter_options_init(&given.options, sizeof given, NULL));
  for (size_t i = 0; i < sizeof given.newer; ++i) assert_int_equal(given.newer[i], 0);
  assert_ok(cairn_filter_required_bytes(&given.options, &bytes, NULL));
  for (size_t i = 0; i < sizeof given.newer; ++i) {
    given.newer[i] = 1;
    assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "options", cairn_filter_required_bytes(&given.options, &bytes, NULL));
    assert_non_null(strstr(cairn_last_message(), "older"));
    given.newer[i] = 0;
  }
}

/* --- arrays --- */

static void capacity_zero_asks_with_any_pointer(void** state) {
  bench b;
  cairn_filter_options options = test_options();
  cairn_landmark landmark;
  size_t needed = 0, asked = 0;
  (void)state;
  options.max_landmarks = WORLD_LANDMARKS + 1;
  bench_open(&b, &options, 12);
  memset(&landmark, 0x5a, sizeof landmark);
  const cairn_map* map = cairn_filter_map(b.main.filter);
  assert_ok(cairn_map_landmarks(map, NULL, 0, &needed, NULL));
  assert_true(needed > 1);
  assert_ok(cairn_map_landmarks(map, &landmark, 0, &asked, NULL));
  assert_int_equal(asked, needed);
  assert_int_equal(landmark.id, UINT64_C(0x5a5a5a5a5a5a5a5a));
  assert_status(cairn_map_landmarks(map, &landmark, 1, &asked, NULL), CAIRN_ERROR_BUFFER);
  assert_int_equal(asked, needed);
  assert_status(cairn_map_landmarks(map, NULL, 1, &asked, NULL), CAIRN_ERROR_ARGUMENT);
  bench_close(&b);
}

/* --- callbacks --- */

/* A sensor that leaves one of its outputs unwritten, or answers something that is no answer. */
typedef struct lazy {
  int skip; /* 0 to 2: a value of z, 3: of the Jacobian by the pose, 4: by the landmark, 5: nothing */
  int32_t answer;
} lazy;

static int32_t lazy_predict(void* user, const cairn_pose* pose, const double landmark[3], double* z,
                            double* jacobian_pose, double* jacobian_landmark) {
  const lazy* l = user;
  double own_z[3], own_pose[18], own_landmark[9];
  (void)point_predict(NULL, pose, landmark, own_z, own_pose, own_landmark);
  for (int i = 0; i < 3; ++i)
    if (l->skip != i) z[i] = own_z[i];
  for (int i = 0; i < 18; ++i)
    if (l->skip != 3 || i != 7) jacobian_pose[i] = own_pose[i];
  for (int i = 0; i < 9; ++i)
    if (l->skip != 4 || i != 4) jacobian_landmark[i] = own_landmark[i];
  return l->answer;
}

static void what_a_callback_leaves_out_is_not_taken_for_zero(void** state) {
  (void)state;
  for (int skip = 0; skip < 6; ++skip) {
    bench b;
    cairn_filter_options options = test_options();
    lazy l = {skip, 1};
    own_sensor own = test_point();
    int32_t sensor = -1;
    cairn_match match;
    cairn_observation seen;
    options.max_sensors = SENSORS + 1, options.max_landmarks = WORLD_LANDMARKS + 1;
    bench_open(&b, &options, 12);
    own.predict = lazy_predict, own.user = &l;
    assert_ok(add_own(b.main.filter, &own, &sensor));
    memset(&seen, 0, sizeof seen);
    seen.id = 1;
    to_body(&b.world.truth, b.world.landmarks[0], seen.z);
    assert_ok(cairn_filter_update(b.main.filter, sensor, &seen, 1, &match, NULL));
    assert_int_equal(match.result, skip < 5 ? CAIRN_RESULT_REJECTED : CAIRN_RESULT_MATCHED);
    if (skip < 5) assert_int_equal(match.reason, CAIRN_REASON_NO_IMAGE);
    l.skip = 5, l.answer = 2; /* neither yes, nor no, nor stop */
    assert_refused(NULL, CAIRN_ERROR_CALLBACK, "custom.predict returned 2",
                   cairn_filter_update(b.main.filter, sensor, &seen, 1, &match, NULL));
    bench_close(&b);
  }
}

static void count_release(void* user) {
  ++*(int*)user;
}

static void ignore_line(void* payload, const char* line) {
  (void)payload, (void)line;
}

/* The library gives each pointer back once: when the filter goes, or when the log is replaced. A call that fails takes
 * nothing. */
static void payloads_go_back_once(void** state) {
  cairn_filter_options options = test_options();
  cairn_filter* filter = NULL;
  const own_sensor own = test_point();
  int first = 0, second = 0, log = 0, other_log = 0, refused = 0;
  int32_t sensor = -1;
  (void)state;
  options.max_sensors = 2;
  assert_ok(cairn_filter_create(&options, &filter, NULL));
  assert_ok(cairn_filter_add_custom(filter, &own.model, own.predict, own.place, &first, count_release, &sensor, NULL));
  assert_ok(cairn_filter_add_custom(filter, &own.model, own.predict, own.place, &second, count_release, &sensor, NULL));
  assert_status(
      cairn_filter_add_custom(filter, &own.model, own.predict, own.place, &refused, count_release, &sensor, NULL),
      CAIRN_ERROR_CAPACITY);
  assert_status(cairn_filter_add_custom(filter, &own.model, NULL, own.place, &refused, count_release, &sensor, NULL),
                CAIRN_ERROR_ARGUMENT);
  assert_status(cairn_filter_set_log(NULL, ignore_line, &refused, count_release, NULL), CAIRN_ERROR_ARGUMENT);
  assert_ok(cairn_filter_set_log(filter, ignore_line, &log, count_release, NULL));
  assert_int_equal(log, 0);
  assert_ok(cairn_filter_set_log(filter, ignore_line, &other_log, count_release, NULL));
  assert_int_equal(log, 1);
  assert_int_equal(other_log, 0);
  assert_int_equal(first + second, 0);
  cairn_filter_destroy(filter);
  assert_int_equal(first, 1);
  assert_int_equal(second, 1);
  assert_int_equal(log, 1);
  assert_int_equal(other_log, 1);
  assert_int_equal(refused, 0);
}

/* --- versions and features --- */

static void version_numbers_agree(void** state) {
  unsigned major = 0, minor = 0, patch = 0;
  (void)state;
  assert_int_equal(sscanf(cairn_version(), "%u.%u.%u", &major, &minor, &patch), 3);
  assert_int_equal(cairn_version_number(), 10000 * major + 100 * minor + patch);
  assert_int_equal(cairn_version_number(), CAIRN_VERSION);
  assert_true(cairn_id_none() == CAIRN_ID_NONE);
}

static void features_have_names(void** state) {
  static const char* const known[] = {"sparse", "teams", "trajectory", "systematic", "robust", "health", "errors"};
  static const char* const unknown[] = {"", "Sparse", "sparse ", "time travel"};
  (void)state;
  for (size_t i = 0; i < LENGTH(known); ++i) assert_int_equal(cairn_has(known[i]), 1);
  for (size_t i = 0; i < LENGTH(unknown); ++i) assert_int_equal(cairn_has(unknown[i]), 0);
  assert_int_equal(cairn_has(NULL), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_failure_fills_in_the_callers_error),
      cmocka_unit_test(an_error_of_any_size_is_not_overrun),
      cmocka_unit_test(reserved_fields_must_be_zero),
      cmocka_unit_test(the_radars_reserved_field_must_be_zero),
      cmocka_unit_test(unknown_bytes_must_be_zero),
      cmocka_unit_test(capacity_zero_asks_with_any_pointer),
      cmocka_unit_test(what_a_callback_leaves_out_is_not_taken_for_zero),
      cmocka_unit_test(payloads_go_back_once),
      cmocka_unit_test(version_numbers_agree),
      cmocka_unit_test(features_have_names),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
