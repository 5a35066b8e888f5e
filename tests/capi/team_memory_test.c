/* SPDX-License-Identifier: BSD-3-Clause */
/* A team allocates memory in its calls. Whichever request of a session fails: a call that fails leaves the team as it
 * was, to the bit, a repeated call goes on as if nothing had happened, and each packet number is used once. In mode
 * CAIRN_TEAM_SUBMAPS a closing that fails is made up for by the next call. The twin makes the same calls with memory.
 */
#include "interposer.h"
#include "teams.h"

enum { SHORT = 14, OWN = 1, SECOND = 2, THIRD = 3, LATE = 4 };

static const int32_t modes[] = {CAIRN_TEAM_MONO, CAIRN_TEAM_EO_DIAGONAL, CAIRN_TEAM_EO_FULL, CAIRN_TEAM_JOINT,
                                CAIRN_TEAM_SUBMAPS};

typedef struct session {
  const voyage* v;
  cairn_team *team, *twin, *second, *third;
  post sent, twin_sent, from_second, from_third;
  int32_t mode;
  size_t refused, interrupted;
} session;

/* One call of the session, of the team or of its twin. */
typedef struct call {
  const session* s;
  size_t k;
  const letter* packet;
} call;
typedef cairn_status (*caller)(cairn_team* team, const call* c);

static cairn_team* open_boat(const voyage* v, int32_t mode, uint64_t vehicle) {
  cairn_team_options options = team_options(mode, vehicle);
  options.max_lag = 4 * (v->time[1] - v->time[0]);
  options.max_vehicles = 5, options.history = 6, options.baseline = mode != CAIRN_TEAM_SUBMAPS;
  cairn_filter_options filter = planar_options(&v->boats[vehicle - 1][0].truth);
  filter.submap_landmarks = 0;
  if (mode == CAIRN_TEAM_SUBMAPS) filter.submap_landmarks = 2, filter.join = CAIRN_JOIN_DENSE;
  const cairn_range_bearing radar = fleet_radar();
  cairn_team* team = NULL;
  assert_ok(cairn_team_create(&options, &filter, &radar, &team, NULL));
  return team;
}

static void compare(const session* s, const char* what, size_t k) {
  snapshot a = {0, NULL}, b = {0, NULL};
  team_snapshot(&a, s->team), team_snapshot(&b, s->twin);
  cairn_team_report ra = report_of(s->team);
  const cairn_team_report rb = report_of(s->twin);
  if (s->interrupted > 0) ra.requested = rb.requested; /* a request that comes late may be one more or one less */
  if (!snapshot_same(&a, &b)) fail_msg("mode %d, step %zu: %s: the estimates differ", (int)s->mode, k, what);
  if (memcmp(&ra, &rb, sizeof ra) != 0) fail_msg("mode %d, step %zu: %s: the reports differ", (int)s->mode, k, what);
  snapshot_free(&a), snapshot_free(&b);
}

static const letter* next_of(const post* p, size_t* i, bool steps_only) {
  while (steps_only && *i < p->count && kind_of(&p->letters[*i]) == REQUEST) ++*i;
  return *i < p->count ? &p->letters[(*i)++] : NULL;
}

/* A request may be late after a closing that was made up for. */
static void compare_packets(const session* s) {
  size_t a = 0, b = 0;
  for (;;) {
    const letter *own = next_of(&s->sent, &a, s->interrupted > 0),
                 *other = next_of(&s->twin_sent, &b, s->interrupted > 0);
    assert_true((own == NULL) == (other == NULL));
    if (own == NULL) return;
    assert_int_equal(own->size, other->size);
    assert_memory_equal(own->bytes, other->bytes, own->size);
  }
}

/* The call of the team, during which requests may fail, then that of the twin. A call that fails is repeated. */
static void make(session* s, const char* what, caller function, const call* c) {
  const bool failed_before = counter.failed;
  counter.armed = true;
  cairn_status status = function(s->team, c);
  counter.armed = false;
  if (counter.failed && !failed_before) {
    counter.fail_at = 0;
    ++s->refused;
    if (status == CAIRN_ERROR_MEMORY) {
      compare(s, what, c->k);
      status = function(s->team, c);
    } else if (report_of(s->team).interrupted != 0) {
      assert_int_equal(s->mode, CAIRN_TEAM_SUBMAPS);
      ++s->interrupted;
    }
  }
  assert_int_equal(status, function(s->twin, c));
}

static cairn_status move(cairn_team* team, const call* c) {
  const log_entry* e = &c->s->v->boats[OWN - 1][c->k];
  const double velocity[3] = {e->speed, 0, 0}, rate[3] = {0, 0, e->rate};
  const double dt = c->s->v->dt[c->k];
  return dt > 0 ? cairn_team_predict_twist(team, dt, velocity, rate, NULL, NULL) : CAIRN_OK;
}
static cairn_status look(cairn_team* team, const call* c) {
  const log_entry* e = &c->s->v->boats[OWN - 1][c->k];
  return cairn_team_observe(team, c->s->v->time[c->k], e->features, e->feature_count, e->vehicles, e->vehicle_count,
                            NULL);
}
static cairn_status take_in(cairn_team* team, const call* c) {
  return cairn_team_receive(team, c->packet->bytes, c->packet->size, NULL, NULL);
}
static cairn_status add_late(cairn_team* team, const call* c) {
  return cairn_team_add(team, LATE, &c->s->v->boats[OWN - 1][0].truth, NULL, NULL);
}
static cairn_status remove_late(cairn_team* team, const call* c) {
  (void)c;
  return cairn_team_remove(team, LATE, NULL);
}
static cairn_status ask(cairn_team* team, const call* c) {
  (void)c;
  return cairn_team_ask(team, NULL);
}
static cairn_status leave(cairn_team* team, const call* c) {
  (void)c;
  return cairn_team_leave(team, NULL);
}

static void receive_all(session* s, post* from, size_t due) {
  size_t left = 0;
  for (size_t i = 0; i < from->count; ++i) {
    const letter l = from->letters[i];
    if (l.due > due) {
      from->letters[left++] = l;
      continue;
    }
    const call c = {s, due, &l};
    make(s, "cairn_team_receive", take_in, &c);
    free(l.bytes);
  }
  from->count = left;
}

/* The third boat's packets come late, and some are lost: they are requested again, and so are own packets. */
static void sail(session* s) {
  const voyage* v = s->v;
  for (size_t k = 0; k < SHORT; ++k) {
    const call c = {s, k, NULL};
    if (k == 1) make(s, "cairn_team_add", add_late, &c);
    if (k == 9) make(s, "cairn_team_remove", remove_late, &c);
    if (k == 5 || k == SHORT - 1) make(s, "cairn_team_ask", ask, &c);
    make(s, "cairn_team_predict_twist", move, &c);
    make(s, "cairn_team_observe", look, &c);
    (void)post_collect(&s->sent, s->team, k), (void)post_collect(&s->twin_sent, s->twin, k);
    for (size_t i = 0; i < s->twin_sent.count; ++i)
      if (kind_of(&s->twin_sent.letters[i]) == REQUEST && s->twin_sent.letters[i].due == k)
        (void)hand_over(s->third, &s->twin_sent.letters[i]);
    boat_step(s->second, v, SECOND, k);
    boat_step(s->third, v, THIRD, k);
    (void)post_collect(&s->from_second, s->second, k);
    const size_t before = s->from_third.count;
    (void)post_collect(&s->from_third, s->third, k + 1);
    if (k % 5 == 3 && s->from_third.count > before) free(s->from_third.letters[--s->from_third.count].bytes);
    if (k == 6) { /* the third boat heard nothing yet, and asks for everything */
      assert_ok(cairn_team_ask(s->third, NULL));
      (void)post_collect(&s->from_third, s->third, k);
    }
    receive_all(s, &s->from_second, k);
    receive_all(s, &s->from_third, k);
    if (s->refused == 0) continue;
    if (report_of(s->team).interrupted == 0) compare(s, "afterwards", k);
  }
  const call c = {s, SHORT - 1, NULL};
  make(s, "cairn_team_leave", leave, &c);
  make(s, "cairn_team_leave", leave, &c); /* refused: it has left. A closing that is due is made up for */
  (void)post_collect(&s->sent, s->team, SHORT), (void)post_collect(&s->twin_sent, s->twin, SHORT);
  compare(s, "at the end", SHORT);
  compare_packets(s);
}

/* Lets request number `at` of a whole session fail, with `for_good` also all later ones of the same call. Returns
 * whether there were so many requests. */
static bool session_with_failure(const voyage* v, int32_t mode, size_t at, bool for_good, size_t* interrupted) {
  session s;
  memset(&s, 0, sizeof s);
  s.v = v, s.mode = mode;
  s.team = open_boat(v, mode, OWN), s.twin = open_boat(v, mode, OWN);
  s.second = open_boat(v, CAIRN_TEAM_MONO, SECOND), s.third = open_boat(v, CAIRN_TEAM_JOINT, THIRD);
  boat_add(s.team, v, SECOND), boat_add(s.team, v, THIRD), boat_add(s.twin, v, SECOND), boat_add(s.twin, v, THIRD);
  boat_add(s.third, v, OWN);
  arm_to_fail(at, for_good);
  counter.armed = false;
  sail(&s);
  const cairn_team_report report = report_of(s.team);
  assert_true(report.taken > 0 || mode == CAIRN_TEAM_MONO);
  assert_true(report.resent > 0 && report.matched + report.placed > 0);
  *interrupted += s.interrupted;
  cairn_team_destroy(s.team), cairn_team_destroy(s.twin), cairn_team_destroy(s.second), cairn_team_destroy(s.third);
  post_free(&s.sent), post_free(&s.twin_sent), post_free(&s.from_second), post_free(&s.from_third);
  return counter.failed;
}

static void each_request_of_a_session_may_fail(void** state) {
  (void)state;
  static voyage v;
  voyage_record(&v, BOATS, 5);
  for (size_t m = 0; m < LENGTH(modes); ++m) {
    /* Closings make thousands of requests: the test takes every seventh. */
    const size_t step = modes[m] == CAIRN_TEAM_SUBMAPS ? 7 : 1;
    size_t failures = 0, interrupted = 0;
    for (size_t at = 1; session_with_failure(&v, modes[m], at, at % 2 == 0, &interrupted); at += step) ++failures;
    print_message("mode %d: %zu requests failed, %zu closings were made up for\n", (int)modes[m], failures,
                  interrupted);
    assert_true(failures > 150);
    assert_true((interrupted > 20) == (modes[m] == CAIRN_TEAM_SUBMAPS));
  }
}

/* A team that cannot be created does not exist, and nothing is left of it. */
static void a_team_without_memory_is_not_created(void** state) {
  (void)state;
  static voyage v;
  voyage_record(&v, BOATS, 5);
  const cairn_range_bearing radar = fleet_radar();
  for (size_t m = 0; m < LENGTH(modes); ++m) {
    const cairn_team_options options = team_options(modes[m], OWN);
    cairn_filter_options filter = planar_options(&v.boats[0][0].truth);
    filter.submap_landmarks = modes[m] == CAIRN_TEAM_SUBMAPS ? 5 : 0;
    cairn_team* team = NULL;
    size_t refused = 0;
    for (size_t at = 1; team == NULL; ++at) {
      arm_to_fail(at, false);
      const cairn_status status = cairn_team_create(&options, &filter, &radar, &team, NULL);
      counter.armed = false;
      refused += counter.failed;
      assert_int_equal(status, counter.failed ? CAIRN_ERROR_MEMORY : CAIRN_OK);
      assert_true(counter.failed == (team == NULL));
    }
    assert_true(refused > 5);
    cairn_team_destroy(team);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_request_of_a_session_may_fail),
      cmocka_unit_test(a_team_without_memory_is_not_created),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
