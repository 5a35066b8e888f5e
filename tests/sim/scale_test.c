/* SPDX-License-Identifier: BSD-3-Clause */
/* A large world: it opens and streams, and its memory is proportional to its landmarks. */
#include <sys/resource.h>

#include "support.h"

static double peak_mib(void) {
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return (double)usage.ru_maxrss / 1024;
}

static void a_hundred_thousand_landmarks(void** state) {
  static const uint32_t closed[] = {0, 1};
  size_t c, k;
  (void)state;
  for (c = 0; c < 2; ++c) {
    cairn_world_options o = default_options();
    cairn_world* w;
    const double before = peak_mib();
    double opened = 0;
    size_t steps, seen = 0;
    o.course = CAIRN_COURSE_TRAVERSE;
    o.landmarks = 100000;
    o.traverse_closed = closed[c];
    w = open_world(&o);
    opened = peak_mib();
    steps = steps_of(w);
    assert_between((double)steps * 2 * o.speed / 1000, 380, 450); /* 320 km of circles, driven 1.25 times */
    for (k = 0; k < 2000; ++k) seen += next_step(w).observation_count;
    assert_between((double)seen / 2000, 8, 11.5);
#ifndef __SANITIZE_ADDRESS__ /* the allocator keeps freed memory */
    assert_between(opened - before, 0, 30);
    assert_between(peak_mib() - opened, 0, 1);
#else
    (void)before, (void)opened;
#endif
    cairn_world_destroy(w);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_hundred_thousand_landmarks)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
