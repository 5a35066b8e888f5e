/* SPDX-License-Identifier: BSD-3-Clause */
/* Statuses, messages, version and build. */
#include <pthread.h>

#include "support.h"

static void names_equal_the_header(void** state) {
  static const struct {
    cairn_status status;
    int32_t pinned;
    const char* name;
  } all[] = {
      {CAIRN_OK, 0, "CAIRN_OK"},
      {CAIRN_ERROR_ARGUMENT, -1, "CAIRN_ERROR_ARGUMENT"},
      {CAIRN_ERROR_BUFFER, -2, "CAIRN_ERROR_BUFFER"},
      {CAIRN_ERROR_CAPACITY, -3, "CAIRN_ERROR_CAPACITY"},
      {CAIRN_ERROR_NOT_FOUND, -4, "CAIRN_ERROR_NOT_FOUND"},
      {CAIRN_ERROR_NUMERICAL, -5, "CAIRN_ERROR_NUMERICAL"},
      {CAIRN_ERROR_MEMORY, -6, "CAIRN_ERROR_MEMORY"},
      {CAIRN_ERROR_STATE, -7, "CAIRN_ERROR_STATE"},
      {CAIRN_ERROR_INTERNAL, -8, "CAIRN_ERROR_INTERNAL"},
      {CAIRN_ERROR_CALLBACK, -9, "CAIRN_ERROR_CALLBACK"},
  };
  (void)state;
  for (size_t i = 0; i < LENGTH(all); ++i) {
    assert_int_equal(all[i].status, all[i].pinned);
    assert_string_equal(cairn_status_name(all[i].status), all[i].name);
  }
}

static void an_unknown_status_has_a_name_too(void** state) {
  static const cairn_status none[] = {1, -10, 100, INT32_MAX, INT32_MIN};
  (void)state;
  for (size_t i = 0; i < LENGTH(none); ++i) assert_string_equal(cairn_status_name(none[i]), "unknown status");
}

static void version_equals_the_header(void** state) {
  char expected[32];
  (void)state;
  snprintf(expected, sizeof expected, "%d.%d.%d", CAIRN_VERSION_MAJOR, CAIRN_VERSION_MINOR, CAIRN_VERSION_PATCH);
  assert_string_equal(cairn_version(), expected);
}

static void enumerations_are_pinned(void** state) {
  (void)state;
  assert_int_equal(CAIRN_RESULT_MATCHED, 1);
  assert_int_equal(CAIRN_RESULT_NEW, 2);
  assert_int_equal(CAIRN_RESULT_REJECTED, 3);
  assert_int_equal(CAIRN_REASON_NO_PLACE, 4);
  assert_int_equal(CAIRN_REASON_NO_ROOM, 6);
  assert_int_equal(CAIRN_REASON_CONTRADICTED, 7);
  assert_int_equal(sizeof(cairn_landmark), 16 + 12 * 8);
  assert_int_equal(sizeof(cairn_observation), 8 + 12 * 8);
  assert_int_equal(sizeof(cairn_match), 32);
  assert_int_equal(offsetof(cairn_match, distance), 16);
  assert_int_equal(sizeof(cairn_pose), 7 * 8);
}

/* Each registration of this test sets CAIRN_TEST_BUILD to the name of the library that must be loaded. */
static void the_expected_build_is_loaded(void** state) {
  const char* expected = getenv("CAIRN_TEST_BUILD");
  const char* build = cairn_build();
  (void)state;
  assert_true(strcmp(build, "x86-64") == 0 || strcmp(build, "x86-64-v3") == 0 || strcmp(build, "generic") == 0);
#if defined(__x86_64__) && defined(__GNUC__)
  if (expected != NULL && strcmp(expected, "best") == 0) {
    const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
    expected = v3 ? "x86-64-v3" : "x86-64";
  }
#endif
  if (expected != NULL) assert_string_equal(build, expected);
}

static void a_failure_leaves_one_line_until_the_next_failure(void** state) {
  cairn_pose pose;
  char kept[512];
  (void)state;
  assert_refused(NULL, CAIRN_ERROR_ARGUMENT, "pose", cairn_pose_identity(NULL, NULL));
  snprintf(kept, sizeof kept, "%s", cairn_last_message());
  assert_true(strlen(kept) > strlen("pose")); /* the message has the cause, not only the name */
  assert_ok(cairn_pose_identity(&pose, NULL));
  assert_string_equal(cairn_last_message(), kept);
}

typedef struct visitor {
  char first[16];
  char own[512];
  const char* buffer;
} visitor;

static void* visit(void* argument) {
  visitor* v = argument;
  double rest[3];
  snprintf(v->first, sizeof v->first, "%s", cairn_last_message());
  (void)cairn_quaternion_log(NULL, rest, NULL);
  v->buffer = cairn_last_message();
  snprintf(v->own, sizeof v->own, "%s", v->buffer);
  return NULL;
}

static void each_thread_has_its_own_message(void** state) {
  visitor v;
  pthread_t thread;
  char before[512];
  (void)state;
  assert_int_equal(cairn_pose_identity(NULL, NULL), CAIRN_ERROR_ARGUMENT);
  snprintf(before, sizeof before, "%s", cairn_last_message());
  assert_int_equal(pthread_create(&thread, NULL, visit, &v), 0);
  assert_int_equal(pthread_join(thread, NULL), 0);
  assert_string_equal(v.first, "");
  assert_non_null(strstr(v.own, "quaternion"));
  assert_string_equal(cairn_last_message(), before);
  assert_ptr_not_equal(v.buffer, cairn_last_message());
}

static void a_fresh_thread_has_an_empty_message_that_is_never_null(void** state) {
  visitor v;
  pthread_t thread;
  (void)state;
  for (int i = 0; i < 8; ++i) {
    memset(&v, 'x', sizeof v);
    assert_int_equal(pthread_create(&thread, NULL, visit, &v), 0);
    assert_int_equal(pthread_join(thread, NULL), 0);
    assert_string_equal(v.first, "");
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(names_equal_the_header),
      cmocka_unit_test(an_unknown_status_has_a_name_too),
      cmocka_unit_test(version_equals_the_header),
      cmocka_unit_test(enumerations_are_pinned),
      cmocka_unit_test(the_expected_build_is_loaded),
      cmocka_unit_test(a_failure_leaves_one_line_until_the_next_failure),
      cmocka_unit_test(each_thread_has_its_own_message),
      cmocka_unit_test(a_fresh_thread_has_an_empty_message_that_is_never_null),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
