/* SPDX-License-Identifier: BSD-3-Clause */
/* Two boats under way, for tests that change the packets for one of them. */
#ifndef CAIRN_TESTS_CAPI_TEAM_STAGE_H
#define CAIRN_TESTS_CAPI_TEAM_STAGE_H

#include "teams.h"

/* Boats 1 and 2 under way, both with many packets. The tests change the packets for boat 1. */
typedef struct stage {
  voyage v;
  cairn_team *a, *b;
  letter next; /* of boat 2, that boat 1 takes */
  post old;    /* of boat 2, that boat 1 took */
  snapshot before, after;
} stage;

#define UNDER_WAY 6

static inline void stage_open(stage* s) {
  memset(s, 0, sizeof *s);
  voyage_record(&s->v, 2, 21);
  cairn_team_options options = team_options(CAIRN_TEAM_JOINT, 1);
  options.max_vehicles = 3, options.max_waiting = 5;
  s->a = boat_open(&s->v, &options);
  options.vehicle = 2, options.max_waiting = 4096;
  s->b = boat_open(&s->v, &options);
  boat_add(s->a, &s->v, 2);
  for (size_t k = 0; k < UNDER_WAY; ++k) {
    boat_step(s->a, &s->v, 1, k);
    boat_step(s->b, &s->v, 2, k);
    const letter own = take_one(s->a);
    free(own.bytes);
    (void)post_collect(&s->old, s->b, 0);
    assert_int_equal(hand_over(s->a, &s->old.letters[k]), CAIRN_PACKET_TAKEN);
  }
  boat_step(s->a, &s->v, 1, UNDER_WAY);
  boat_step(s->b, &s->v, 2, UNDER_WAY);
  s->next = take_one(s->b);
  post p = {NULL, 0, 0};
  (void)post_collect(&p, s->a, 0);
  post_free(&p);
  team_snapshot(&s->before, s->a);
}

/* After all refused packets the next good packet is taken. */
static inline void stage_close(stage* s) {
  team_snapshot(&s->after, s->a);
  assert_true(snapshot_same(&s->before, &s->after));
  assert_int_equal(hand_over(s->a, &s->next), CAIRN_PACKET_TAKEN);
  team_snapshot(&s->after, s->a);
  assert_false(snapshot_same(&s->before, &s->after));
  assert_int_equal(report_of(s->a).failed, 0);
  cairn_team_destroy(s->a);
  cairn_team_destroy(s->b);
  free(s->next.bytes);
  post_free(&s->old);
  snapshot_free(&s->before);
  snapshot_free(&s->after);
}

static inline void unchanged(stage* s) {
  team_snapshot(&s->after, s->a);
  if (!snapshot_same(&s->before, &s->after)) fail_msg("the estimate has changed");
}

#endif
