/* SPDX-License-Identifier: BSD-3-Clause */
/* Boats that exchange the packets of a whole voyage through a post that delays, loses, repeats and shuffles packets. */
#ifndef CAIRN_TESTS_CAPI_TEAM_CREW_H
#define CAIRN_TESTS_CAPI_TEAM_CREW_H

#include "teams.h"

static inline cairn_observation sight(uint64_t id, double range, double bearing, double sigma_range,
                                      double sigma_bearing) {
  cairn_observation o;
  memset(&o, 0, sizeof o);
  o.id = id, o.z[0] = range, o.z[1] = bearing;
  o.covariance[0] = sigma_range * sigma_range, o.covariance[3] = sigma_bearing * sigma_bearing;
  return o;
}

typedef struct crew {
  voyage v;
  size_t boats;
  cairn_team* teams[BOATS];
} crew;

static inline void crew_open(crew* c, size_t boats, uint64_t seed, double max_lag, int32_t mode) {
  voyage_record(&c->v, (uint32_t)boats, seed);
  c->boats = boats;
  for (size_t b = 0; b < boats; ++b) {
    cairn_team_options options = team_options(mode, b + 1);
    options.max_lag = max_lag;
    c->teams[b] = boat_open(&c->v, &options);
    for (size_t other = 0; other < boats; ++other)
      if (other != b) boat_add(c->teams[b], &c->v, other + 1);
  }
}

static inline void crew_close(crew* c) {
  for (size_t b = 0; b < c->boats; ++b) cairn_team_destroy(c->teams[b]);
}

typedef struct weather {
  size_t most_delay;     /* steps */
  double lost, repeated; /* shares of all packets */
  bool shuffled;
} weather;

/* Delivers the packets that are due by `step` to all boats except the sender. */
static inline void deliver_due(crew* c, post* p, size_t step, const weather* w, generator* random) {
  for (size_t i = p->count; w->shuffled && i > 1; --i) {
    const size_t j = (size_t)(random_bits(random) % i);
    const letter kept = p->letters[i - 1];
    p->letters[i - 1] = p->letters[j], p->letters[j] = kept;
  }
  size_t left = 0;
  for (size_t i = 0; i < p->count; ++i) {
    const letter l = p->letters[i];
    if (l.due > step) {
      p->letters[left++] = l;
      continue;
    }
    for (size_t b = 0; b < c->boats; ++b) {
      if (sender_of(&l) == b + 1) continue;
      if (random_uniform(random, 0, 1) < w->lost) continue;
      (void)hand_over(c->teams[b], &l);
      if (random_uniform(random, 0, 1) < w->repeated) (void)hand_over(c->teams[b], &l);
    }
    free(l.bytes);
  }
  p->count = left;
}

static inline void collect_all(crew* c, post* p, size_t step, const weather* w, generator* random) {
  for (size_t b = 0; b < c->boats; ++b) {
    const size_t before = p->count;
    (void)post_collect(p, c->teams[b], step);
    for (size_t i = before; i < p->count; ++i)
      if (w->most_delay > 0) p->letters[i].due += (size_t)(random_bits(random) % (w->most_delay + 1));
  }
}

/* The whole voyage; at the end all lost packets are requested. */
static inline void crew_sail(crew* c, const weather* w, uint64_t seed) {
  const weather fair = {0, 0, 0, false};
  generator random = {seed};
  post p = {NULL, 0, 0};
  for (size_t k = 0; k < STEPS; ++k) {
    for (size_t b = 0; b < c->boats; ++b) boat_step(c->teams[b], &c->v, b + 1, k);
    collect_all(c, &p, k, w, &random);
    deliver_due(c, &p, k, w, &random);
  }
  for (int round = 0; round < 30; ++round) {
    for (size_t b = 0; b < c->boats; ++b) assert_ok(cairn_team_ask(c->teams[b], NULL));
    collect_all(c, &p, 0, &fair, &random);
    deliver_due(c, &p, SIZE_MAX, &fair, &random);
  }
  post_free(&p);
}

static inline void assert_replicas_agree(const crew* c, double tolerance) {
  for (size_t other = 1; other < c->boats; ++other)
    for (size_t b = 0; b < c->boats; ++b) {
      cairn_pose pa, pb;
      double ca[36], cb[36], error[6];
      assert_ok(cairn_team_pose(c->teams[0], b + 1, &pa, ca, NULL));
      assert_ok(cairn_team_pose(c->teams[other], b + 1, &pb, cb, NULL));
      assert_ok(cairn_pose_error(&pa, &pb, error, NULL));
      for (int i = 0; i < 6; ++i) assert_near(error[i], 0, tolerance);
      for (int i = 0; i < 36; ++i)
        assert_near(ca[i], cb[i], tolerance * sqrt(ca[7 * (i / 6)] * ca[7 * (i % 6)]) + 1e-12);
    }
  cairn_landmark la[2 * FEATURES], lb[2 * FEATURES];
  size_t na = 0, nb = 0;
  assert_ok(cairn_map_landmarks(cairn_team_map(c->teams[0]), la, LENGTH(la), &na, NULL));
  assert_true(na > 3);
  for (size_t other = 1; other < c->boats; ++other) {
    assert_ok(cairn_map_landmarks(cairn_team_map(c->teams[other]), lb, LENGTH(lb), &nb, NULL));
    assert_int_equal(na, nb);
    for (size_t i = 0; i < na; ++i) {
      assert_int_equal(la[i].id, lb[i].id);
      assert_int_equal(la[i].observations, lb[i].observations);
      for (int k = 0; k < 2; ++k) assert_near(la[i].position[k], lb[i].position[k], tolerance);
      for (int k = 0; k < 2; ++k)
        assert_near(la[i].covariance[4 * k], lb[i].covariance[4 * k], tolerance * la[i].covariance[4 * k]);
    }
  }
}

#endif
