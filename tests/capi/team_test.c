/* SPDX-License-Identifier: BSD-3-Clause */
/* Teams: that one vehicle alone is the ordinary filter, that all vehicles come to one estimate whatever the post does
 * to their packets, who is known and who is waited for, and the figures that tell what a team is worth. */
#include "teams.h"

/* --- a team of one --- */

#define ALONE_LANDMARKS 9
#define ALONE_STEPS 30

/* A boat that drives in a ring of landmarks; every fourth scan has something in it that is no landmark. */
typedef struct alone {
  generator random;
  cairn_pose truth, odometry[4];
  double noise[4][36], dt;
  size_t motions;
  cairn_observation seen[ALONE_LANDMARKS];
  size_t count;
  unsigned step;
} alone;

static void alone_next(alone* a) {
  a->motions = a->step == 0 ? 0 : 1 + a->step % 4;
  for (size_t i = 0; i < a->motions; ++i) {
    const double d[3] = {0.5, random_normal(&a->random, 0.02), 0.05 + random_normal(&a->random, 0.01)};
    const cairn_pose moved = pose_at(d[0], d[1], 0, 0, 0, d[2]);
    a->odometry[i] = pose_at(d[0] + random_normal(&a->random, 0.02), d[1] + random_normal(&a->random, 0.02), 0, 0, 0,
                             d[2] + random_normal(&a->random, 0.01));
    diagonal(a->noise[i], 6, 4e-4);
    a->noise[i][35] = 1e-4, a->noise[i][1] = a->noise[i][6] = 1e-4, a->noise[i][5] = a->noise[i][30] = -5e-5;
    assert_ok(cairn_pose_compose(&a->truth, &moved, &a->truth));
  }
  a->count = 0;
  for (size_t l = 0; l < ALONE_LANDMARKS; ++l) {
    const double point[3] = {6 * cos(0.7 * (double)l), 4 + 6 * sin(0.7 * (double)l), 0};
    double body[3];
    to_body(&a->truth, point, body);
    if (hypot(body[0], body[1]) > 11) continue;
    cairn_observation* o = &a->seen[a->count++];
    memset(o, 0, sizeof *o);
    o->id = 100 - l;
    o->z[0] = hypot(body[0], body[1]) + random_normal(&a->random, 0.05);
    o->z[1] = atan2(body[1], body[0]) + random_normal(&a->random, 0.01);
    if (l % 3 == 0) o->covariance[0] = 4e-3, o->covariance[1] = o->covariance[2] = 1e-5, o->covariance[3] = 2e-4;
    if (a->step % 4 == 3 && a->count == 2) o->z[0] += 3;
  }
  ++a->step;
}

/* Pose, map and their joint covariances, bit for bit. */
static void compare_with_filter(const cairn_team* team, const cairn_filter* filter) {
  cairn_pose pa, pb;
  double ca[36], cb[36];
  cairn_landmark la[ALONE_LANDMARKS], lb[ALONE_LANDMARKS];
  uint64_t ids[ALONE_LANDMARKS];
  double ja[9 * ALONE_LANDMARKS * ALONE_LANDMARKS], jb[9 * ALONE_LANDMARKS * ALONE_LANDMARKS];
  size_t na = 0, nb = 0, needed = 0;
  assert_ok(cairn_team_pose(team, 7, &pa, ca));
  assert_ok(cairn_filter_pose(filter, &pb, cb));
  assert_memory_equal(&pa, &pb, sizeof pa);
  assert_memory_equal(ca, cb, sizeof ca);
  assert_ok(cairn_map_landmarks(cairn_team_map(team), la, ALONE_LANDMARKS, &na));
  assert_ok(cairn_map_landmarks(cairn_filter_map(filter), lb, ALONE_LANDMARKS, &nb));
  assert_int_equal(na, nb);
  assert_memory_equal(la, lb, na * sizeof la[0]);
  for (size_t i = 0; i < na; ++i) ids[i] = la[i].id;
  assert_ok(cairn_map_joint_covariance(cairn_team_map(team), ids, na, ja, LENGTH(ja), &needed));
  assert_ok(cairn_map_joint_covariance(cairn_filter_map(filter), ids, nb, jb, LENGTH(jb), &needed));
  assert_memory_equal(ja, jb, needed * sizeof ja[0]);
}

static void one_vehicle_alone_is_the_ordinary_filter(void** state) {
  static const int32_t modes[] = {CAIRN_TEAM_MONO, CAIRN_TEAM_EO_DIAGONAL, CAIRN_TEAM_EO_FULL, CAIRN_TEAM_JOINT};
  (void)state;
  for (size_t m = 0; m < LENGTH(modes); ++m)
    for (int32_t error = CAIRN_ERROR_INVARIANT; error <= CAIRN_ERROR_STANDARD; ++error) {
      const cairn_pose start = pose_at(0.5, -1, 0, 0, 0, 0.3);
      cairn_filter_options options = planar_options(&start);
      cairn_range_bearing radar;
      cairn_team_options own = team_options(modes[m], 7);
      cairn_filter* filter = NULL;
      cairn_team* team = NULL;
      int32_t sensor;
      size_t rejected = 0, placed = 0, matched = 0;
      options.error = error;
      options.initial_covariance[0] = options.initial_covariance[7] = 0.01, options.initial_covariance[35] = 1e-3;
      assert_ok(cairn_range_bearing_init(&radar, sizeof radar));
      radar.range_sigma = 0.05;
      own.baseline = 1;
      assert_ok(cairn_team_create(&own, &options, &radar, &team));
      assert_ok(cairn_filter_create(&options, &filter));
      assert_ok(cairn_filter_add_range_bearing(filter, &radar, &sensor));
      alone a;
      memset(&a, 0, sizeof a);
      a.random.state = 11, a.truth = start;
      for (int step = 0; step < ALONE_STEPS; ++step) {
        cairn_match told[ALONE_LANDMARKS], expected[ALONE_LANDMARKS];
        size_t needed = 0;
        alone_next(&a);
        for (size_t i = 0; i < a.motions; ++i) {
          assert_ok(cairn_team_predict_increment(team, &a.odometry[i], a.noise[i]));
          assert_ok(cairn_filter_predict_increment(filter, &a.odometry[i], a.noise[i]));
        }
        assert_ok(cairn_team_observe(team, 0.5 * step, a.seen, a.count, NULL, 0));
        assert_ok(cairn_filter_update(filter, sensor, a.seen, a.count, expected));
        compare_with_filter(team, filter);
        assert_ok(cairn_team_decisions(team, told, LENGTH(told), &needed));
        assert_int_equal(needed, a.count);
        for (size_t i = 0; i < a.count; ++i) {
          assert_int_equal(told[i].landmark, expected[i].landmark);
          assert_int_equal(told[i].result, expected[i].result);
          assert_int_equal(told[i].reason, expected[i].reason);
          assert_true(told[i].distance == expected[i].distance && told[i].threshold == expected[i].threshold);
          rejected += expected[i].result == CAIRN_REJECTED;
          placed += expected[i].result == CAIRN_NEW;
          matched += expected[i].result == CAIRN_MATCHED;
        }
      }
      assert_true(rejected >= 5 && placed >= 7 && matched >= 60);
      const cairn_team_report report = report_of(team);
      assert_true(report.rejected == rejected && report.placed == placed && report.matched == matched);
      assert_int_equal(report.sent, ALONE_STEPS);
      assert_int_equal(report.unsettled, 0);
      cairn_team_destroy(team);
      cairn_filter_destroy(filter);
    }
}

/* Motion by twist is the filter's, too. */
static void a_twist_moves_a_team_as_it_moves_a_filter(void** state) {
  const cairn_pose start = pose_at(2, 3, 0, 0, 0, 2);
  const cairn_filter_options options = planar_options(&start);
  const cairn_range_bearing radar = fleet_radar();
  const cairn_team_options own = team_options(CAIRN_TEAM_JOINT, 7);
  const cairn_twist_noise noise = fleet_noise();
  const double velocity[3] = {1.5, 0.2, 0}, rate[3] = {0, 0, 0.3};
  cairn_filter* filter = NULL;
  cairn_team* team = NULL;
  (void)state;
  for (int with = 0; with < 2; ++with) {
    assert_ok(cairn_team_create(&own, &options, &radar, &team));
    assert_ok(cairn_filter_create(&options, &filter));
    if (with) assert_ok(cairn_filter_set_twist_noise(filter, &noise));
    for (int i = 0; i < 3; ++i) {
      assert_ok(cairn_team_predict_twist(team, 0.5, velocity, rate, with ? &noise : NULL));
      assert_ok(cairn_filter_predict_twist(filter, 0.5, velocity, rate));
    }
    assert_ok(cairn_team_observe(team, 1.5, NULL, 0, NULL, 0));
    compare_with_filter(team, filter);
    cairn_team_destroy(team);
    cairn_filter_destroy(filter);
  }
}

/* What waits for teammates is told of the own pose as far as it is motion. */
static void the_own_pose_is_as_of_now(void** state) {
  const cairn_pose start = pose_at(0.5, -1, 0, 0, 0, 0.3);
  cairn_filter_options options = planar_options(&start);
  cairn_range_bearing radar;
  cairn_team_options own = team_options(CAIRN_TEAM_JOINT, 7);
  cairn_filter* filter = NULL;
  cairn_team* team = NULL;
  size_t size = 7;
  (void)state;
  options.initial_covariance[0] = options.initial_covariance[7] = 0.01, options.initial_covariance[35] = 1e-3;
  assert_ok(cairn_range_bearing_init(&radar, sizeof radar));
  assert_ok(cairn_team_create(&own, &options, &radar, &team));
  assert_ok(cairn_filter_create(&options, &filter));
  assert_ok(cairn_team_add(team, 8, &start, NULL)); /* which is never heard of */
  alone a;
  memset(&a, 0, sizeof a);
  a.random.state = 11, a.truth = start;
  for (int step = 0; step < 6; ++step) {
    cairn_pose pa, pb;
    double ca[36], cb[36], error[6];
    alone_next(&a);
    for (size_t i = 0; i <= a.motions; ++i) { /* between motions, too */
      assert_ok(cairn_team_pose(team, 7, &pa, ca));
      assert_ok(cairn_filter_pose(filter, &pb, cb));
      assert_ok(cairn_pose_error(&pa, &pb, error));
      for (int k = 0; k < 6; ++k) assert_near(error[k], 0, 1e-12);
      for (int k = 0; k < 36; ++k) assert_near(ca[k], cb[k], 1e-12);
      if (i == a.motions) break;
      assert_ok(cairn_team_predict_increment(team, &a.odometry[i], a.noise[i]));
      assert_ok(cairn_filter_predict_increment(filter, &a.odometry[i], a.noise[i]));
    }
    assert_ok(cairn_team_observe(team, 0.5 * step, a.seen, a.count, NULL, 0));
    assert_int_equal(report_of(team).unsettled, step + 1);
    assert_ok(cairn_map_size(cairn_team_map(team), &size));
    assert_int_equal(size, 0);
  }
  assert_ok(cairn_team_remove(team, 8)); /* nobody is waited for now */
  assert_int_equal(report_of(team).unsettled, 0);
  assert_ok(cairn_map_size(cairn_team_map(team), &size));
  assert_true(size > 3);
  cairn_team_destroy(team);
  cairn_filter_destroy(filter);
}

static cairn_observation sight(uint64_t id, double range, double bearing, double sigma_range, double sigma_bearing) {
  cairn_observation o;
  memset(&o, 0, sizeof o);
  o.id = id, o.z[0] = range, o.z[1] = bearing;
  o.covariance[0] = sigma_range * sigma_range, o.covariance[3] = sigma_bearing * sigma_bearing;
  return o;
}

/* --- boats that tell each other --- */

typedef struct crew {
  voyage v;
  size_t boats;
  cairn_team* teams[BOATS];
} crew;

static void crew_open(crew* c, size_t boats, uint64_t seed, double max_lag, int32_t mode) {
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

static void crew_close(crew* c) {
  for (size_t b = 0; b < c->boats; ++b) cairn_team_destroy(c->teams[b]);
}

typedef struct weather {
  size_t most_delay;     /* steps */
  double lost, repeated; /* shares of all packets */
  bool shuffled;
} weather;

/* Delivers what is due by `step`, to all but its sender. */
static void deliver_due(crew* c, post* p, size_t step, const weather* w, generator* random) {
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

static void collect_all(crew* c, post* p, size_t step, const weather* w, generator* random) {
  for (size_t b = 0; b < c->boats; ++b) {
    const size_t before = p->count;
    (void)post_collect(p, c->teams[b], step);
    for (size_t i = before; i < p->count; ++i)
      if (w->most_delay > 0) p->letters[i].due += (size_t)(random_bits(random) % (w->most_delay + 1));
  }
}

/* The whole voyage; in the end all that was lost is asked for. */
static void crew_sail(crew* c, const weather* w, uint64_t seed) {
  const weather fair = {0, 0, 0, false};
  generator random = {seed};
  post p = {NULL, 0, 0};
  for (size_t k = 0; k < STEPS; ++k) {
    for (size_t b = 0; b < c->boats; ++b) boat_step(c->teams[b], &c->v, b + 1, k);
    collect_all(c, &p, k, w, &random);
    deliver_due(c, &p, k, w, &random);
  }
  for (int round = 0; round < 30; ++round) {
    for (size_t b = 0; b < c->boats; ++b) assert_ok(cairn_team_ask(c->teams[b]));
    collect_all(c, &p, 0, &fair, &random);
    deliver_due(c, &p, SIZE_MAX, &fair, &random);
  }
  post_free(&p);
}

static void assert_replicas_agree(const crew* c, double tolerance) {
  for (size_t other = 1; other < c->boats; ++other)
    for (size_t b = 0; b < c->boats; ++b) {
      cairn_pose pa, pb;
      double ca[36], cb[36], error[6];
      assert_ok(cairn_team_pose(c->teams[0], b + 1, &pa, ca));
      assert_ok(cairn_team_pose(c->teams[other], b + 1, &pb, cb));
      assert_ok(cairn_pose_error(&pa, &pb, error));
      for (int i = 0; i < 6; ++i) assert_near(error[i], 0, tolerance);
      for (int i = 0; i < 36; ++i)
        assert_near(ca[i], cb[i], tolerance * sqrt(ca[7 * (i / 6)] * ca[7 * (i % 6)]) + 1e-12);
    }
  cairn_landmark la[2 * FEATURES], lb[2 * FEATURES];
  size_t na = 0, nb = 0;
  assert_ok(cairn_map_landmarks(cairn_team_map(c->teams[0]), la, LENGTH(la), &na));
  assert_true(na > 3);
  for (size_t other = 1; other < c->boats; ++other) {
    assert_ok(cairn_map_landmarks(cairn_team_map(c->teams[other]), lb, LENGTH(lb), &nb));
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

static void all_vehicles_come_to_one_estimate(void** state) {
  const weather fair = {0, 0, 0, false};
  (void)state;
  for (size_t boats = 2; boats <= BOATS; ++boats) {
    crew c;
    crew_open(&c, boats, 3, 1e9, CAIRN_TEAM_JOINT);
    crew_sail(&c, &fair, 1);
    assert_replicas_agree(&c, 1e-6);
    for (size_t b = 0; b < boats; ++b) {
      const cairn_team_report r = report_of(c.teams[b]);
      cairn_pose pose;
      double covariance[36], error[6];
      assert_int_equal(r.sent, STEPS);
      assert_int_equal(r.taken, STEPS * (boats - 1));
      assert_int_equal(r.unsettled, 0);
      assert_true(r.sightings_used == STEPS * boats * (boats - 1) && r.sightings_refused == 0);
      assert_true(r.failed == 0 && r.lost == 0 && r.nonsense == 0 && r.conflict == 0);
      assert_ok(cairn_team_pose(c.teams[b], b + 1, &pose, covariance));
      assert_ok(cairn_pose_error(&c.v.boats[b][STEPS - 1].truth, &pose, error));
      for (int i = 0; i < 6; ++i) assert_near(error[i], 0, 4 * sqrt(covariance[7 * i]));
    }
    crew_close(&c);
  }
}

/* The order of taking in does not know what the post did: the same bits. */
static void the_post_does_not_matter(void** state) {
  static const weather bad[] = {{3, 0, 0, false},   {0, 0, 0.5, false},  {4, 0, 0, true},
                                {0, 0.3, 0, false}, {4, 0.3, 0.3, true}, {0, 0.6, 0.2, true}};
  const weather fair = {0, 0, 0, false};
  (void)state;
  for (size_t boats = 2; boats <= BOATS; ++boats) {
    crew undisturbed;
    crew_open(&undisturbed, boats, 5, 1e9, CAIRN_TEAM_JOINT);
    crew_sail(&undisturbed, &fair, 1);
    for (size_t n = 0; n < LENGTH(bad); ++n) {
      crew c;
      uint64_t reordered = 0, repeated = 0, resent = 0, requested = 0;
      crew_open(&c, boats, 5, 1e9, CAIRN_TEAM_JOINT);
      crew_sail(&c, &bad[n], 100 + n);
      for (size_t b = 0; b < boats; ++b) {
        const cairn_team_report r = report_of(c.teams[b]);
        assert_int_equal(r.unsettled, 0);
        assert_int_equal(r.taken, STEPS * (boats - 1));
        assert_true(r.lost == 0 && r.conflict == 0 && r.past == 0);
        assert_same_estimate(c.teams[b], undisturbed.teams[b]);
        reordered += r.reordered, repeated += r.repeated, resent += r.resent, requested += r.requested;
      }
      if (bad[n].shuffled) assert_true(reordered > 0); /* it was what it says */
      if (bad[n].repeated > 0) assert_true(repeated > 5);
      if (bad[n].lost > 0) assert_true(resent > 5 && requested > 5);
      crew_close(&c);
    }
    crew_close(&undisturbed);
  }
}

/* A teammate may be the first to look: its packet comes before the own scan of the same time. */
static void a_packet_that_comes_before_the_own_scan_waits_for_it(void** state) {
  const weather fair = {0, 0, 0, false};
  crew expected, c;
  (void)state;
  crew_open(&expected, 2, 5, 1e9, CAIRN_TEAM_JOINT);
  crew_sail(&expected, &fair, 1);
  crew_open(&c, 2, 5, 1e9, CAIRN_TEAM_JOINT);
  for (size_t k = 0; k < STEPS; ++k)
    for (size_t turn = 0; turn < 2; ++turn) {
      const size_t b = (k + turn) % 2;
      boat_step(c.teams[b], &c.v, b + 1, k);
      post p = {NULL, 0, 0};
      (void)post_collect(&p, c.teams[b], 0);
      for (size_t i = 0; i < p.count; ++i) {
        const int32_t result = hand_over(c.teams[1 - b], &p.letters[i]);
        if (kind_of(&p.letters[i]) == DATA)
          assert_int_equal(result, turn == 0 ? CAIRN_PACKET_WAITING : CAIRN_PACKET_TAKEN);
      }
      post_free(&p);
    }
  for (size_t b = 0; b < 2; ++b) {
    assert_int_equal(report_of(c.teams[b]).sightings_refused, 0);
    assert_same_estimate(c.teams[b], expected.teams[b]);
  }
  crew_close(&expected);
  crew_close(&c);
}

/* The same of extended observations, which need the own sighting of that time. */
static void extended_observations_wait_for_the_own_scan(void** state) {
  (void)state;
  for (int32_t mode = CAIRN_TEAM_EO_DIAGONAL; mode <= CAIRN_TEAM_EO_FULL; ++mode) {
    crew expected, c;
    crew_open(&expected, 2, 5, 1e9, mode);
    crew_open(&c, 2, 5, 1e9, mode);
    for (size_t k = 0; k < 10; ++k) {
      boat_step(expected.teams[0], &c.v, 1, k);
      boat_step(expected.teams[1], &c.v, 2, k);
      letter to = take_one(expected.teams[0]), from = take_one(expected.teams[1]);
      assert_int_equal(hand_over(expected.teams[1], &to), CAIRN_PACKET_TAKEN);
      assert_int_equal(hand_over(expected.teams[0], &from), CAIRN_PACKET_TAKEN);
      (void)hand_over(c.teams[0], &from);
      boat_step(c.teams[0], &c.v, 1, k);
      free(to.bytes), free(from.bytes);
    }
    assert_int_equal(report_of(expected.teams[0]).sightings_used, 20);
    assert_int_equal(report_of(c.teams[0]).sightings_used, 20);
    assert_same_estimate(expected.teams[0], c.teams[0]);
    crew_close(&expected);
    crew_close(&c);
  }
}

/* Without names all vehicles number the same landmarks alike, for they take in the same in one order. */
static void names_are_not_needed(void** state) {
  static const int32_t ways[] = {CAIRN_ASSOCIATION_NEAREST, CAIRN_ASSOCIATION_JOINT};
  const weather fair = {0, 0, 0, false}, bad = {3, 0.3, 0.3, true};
  (void)state;
  for (size_t n = 0; n < LENGTH(ways); ++n) {
    crew c;
    size_t size = 0;
    voyage_record(&c.v, 2, 5);
    c.boats = 2;
    for (size_t b = 0; b < 2; ++b) {
      cairn_team_options options = team_options(CAIRN_TEAM_JOINT, b + 1);
      cairn_filter_options filter = planar_options(&c.v.boats[b][0].truth);
      const cairn_range_bearing radar = fleet_radar();
      options.max_lag = 1e9, filter.association = ways[n];
      c.teams[b] = NULL;
      assert_ok(cairn_team_create(&options, &filter, &radar, &c.teams[b]));
      boat_add(c.teams[b], &c.v, 2 - b);
      for (size_t k = 0; k < STEPS; ++k)
        for (size_t i = 0; i < c.v.boats[b][k].feature_count; ++i) c.v.boats[b][k].features[i].id = CAIRN_ID_NONE;
    }
    crew_sail(&c, n == 0 ? &fair : &bad, 3);
    assert_replicas_agree(&c, 1e-6);
    assert_ok(cairn_map_size(cairn_team_map(c.teams[0]), &size));
    assert_true(size >= 6 && size <= FEATURES);
    crew_close(&c);
  }
}

/* Of two that see a new landmark the nearer one places it, whoever is the first by number. */
static void the_nearest_places_a_landmark(void** state) {
  const cairn_pose starts[2] = {pose_at(0, 0, 0, 0, 0, 0), pose_at(900, 0, 0, 0, 0, 0)};
  const cairn_observation looks[2][2] = {{sight(11, 1000, 0, 30, 0.005), sight(12, 200, 0, 30, 0.005)},
                                         {sight(11, 100, 0, 30, 0.005), sight(12, 700, PI, 30, 0.005)}};
  const cairn_range_bearing radar = fleet_radar();
  cairn_team* teams[2];
  letter letters[2];
  (void)state;
  for (size_t b = 0; b < 2; ++b) {
    const cairn_team_options options = team_options(CAIRN_TEAM_JOINT, b + 1);
    const cairn_filter_options filter = planar_options(&starts[b]);
    teams[b] = NULL;
    assert_ok(cairn_team_create(&options, &filter, &radar, &teams[b]));
    assert_ok(cairn_team_add(teams[b], 2 - b, &starts[1 - b], NULL));
    assert_ok(cairn_team_observe(teams[b], 0, looks[b], 2, NULL, 0));
    letters[b] = take_one(teams[b]);
  }
  for (size_t b = 0; b < 2; ++b) {
    cairn_match m[2];
    size_t count = 0;
    assert_int_equal(hand_over(teams[b], &letters[1 - b]), CAIRN_PACKET_TAKEN);
    assert_ok(cairn_team_decisions(teams[b], m, 2, &count));
    assert_int_equal(count, 2);
    for (size_t i = 0; i < 2; ++i) { /* 12 lies near boat 1, 11 near boat 2 */
      const bool near = m[i].landmark == (b == 0 ? 12 : 11);
      assert_int_equal(m[i].result, near ? CAIRN_NEW : CAIRN_MATCHED);
    }
  }
  for (size_t b = 0; b < 2; ++b) {
    free(letters[b].bytes);
    cairn_team_destroy(teams[b]);
  }
}

/* Teammates by packets cannot make worse what a filter of a vehicle alone has: what each mode claims. */
static void whoever_is_told_more_claims_more(void** state) {
  static const int32_t modes[] = {CAIRN_TEAM_MONO, CAIRN_TEAM_EO_FULL, CAIRN_TEAM_JOINT};
  const weather fair = {0, 0, 0, false};
  double claimed[3];
  (void)state;
  for (size_t m = 0; m < LENGTH(modes); ++m) {
    crew c;
    double covariance[36];
    crew_open(&c, 2, 5, 1e9, modes[m]);
    crew_sail(&c, &fair, 1);
    assert_ok(cairn_team_pose(c.teams[0], 1, NULL, covariance));
    claimed[m] = covariance[0] + covariance[7];
    const cairn_team_report r = report_of(c.teams[0]);
    assert_int_equal(r.ignored, modes[m] == CAIRN_TEAM_MONO ? STEPS : 0);
    if (modes[m] != CAIRN_TEAM_JOINT)
      assert_status(cairn_team_pose(c.teams[0], 2, NULL, covariance), CAIRN_ERROR_NOT_FOUND);
    crew_close(&c);
  }
  assert_true(claimed[1] < 0.98 * claimed[0]);
  assert_true(claimed[2] < 0.98 * claimed[1]);
}

/* --- who is known, and who is waited for --- */

/* A teammate that never says a word is waited for once, not anew at every step. */
static void whoever_is_never_heard_of_is_given_up(void** state) {
  crew c;
  (void)state;
  crew_open(&c, 2, 7, 12.0, CAIRN_TEAM_JOINT);
  for (size_t k = 0; k < 10; ++k) {
    boat_step(c.teams[0], &c.v, 1, k);
    assert_int_equal(report_of(c.teams[0]).unsettled, c.v.time[k] > 12 ? 0 : k + 1);
  }
  crew_close(&c);
}

/* The own scan does not fit, and the caller hears of it, though a teammate's later packet shows a gap. */
static void an_own_scan_that_fails_is_told(void** state) {
  (void)state;
  for (int gap = 0; gap < 2; ++gap) {
    crew c;
    crew_open(&c, 2, 7, 1e9, CAIRN_TEAM_JOINT);
    cairn_team_destroy(c.teams[0]);
    const cairn_team_options options = team_options(CAIRN_TEAM_JOINT, 1);
    cairn_filter_options filter = planar_options(&c.v.boats[0][0].truth);
    const cairn_range_bearing radar = fleet_radar();
    const log_entry* e = &c.v.boats[0][0];
    filter.max_landmarks = 1;
    c.teams[0] = NULL;
    assert_ok(cairn_team_create(&options, &filter, &radar, &c.teams[0]));
    boat_add(c.teams[0], &c.v, 2);
    post p = {NULL, 0, 0};
    for (size_t k = 0; k < 3; ++k) boat_step(c.teams[1], &c.v, 2, k);
    (void)post_collect(&p, c.teams[1], 0);
    for (size_t i = 0; i < p.count; ++i)
      if (kind_of(&p.letters[i]) == DATA && (number_of(&p.letters[i]) == 0 || (gap && number_of(&p.letters[i]) == 2)))
        (void)hand_over(c.teams[0], &p.letters[i]);
    assert_true(e->feature_count > 1);
    assert_status(cairn_team_observe(c.teams[0], c.v.time[0], e->features, e->feature_count, NULL, 0),
                  CAIRN_ERROR_CAPACITY);
    assert_true(report_of(c.teams[0]).failed > 0 && report_of(c.teams[0]).sent == 1); /* and told to the team */
    post_free(&p);
    crew_close(&c);
  }
}

/* One packet of boat 2 never comes, nor does any repetition. */
static void what_is_lost_for_good_is_given_up(void** state) {
  const uint64_t gone = 9;
  crew c;
  cairn_pose pose;
  double covariance[36], error[6];
  bool unknown = false;
  (void)state;
  crew_open(&c, 2, 7, 12.0, CAIRN_TEAM_JOINT);
  for (size_t k = 0; k < STEPS; ++k) {
    /* Nobody sees the other from step 8 to 19: so boat 2 stays unknown for a while. */
    for (size_t b = 0; b < 2; ++b) {
      boat_move(c.teams[b], &c.v, b + 1, k);
      boat_look(c.teams[b], &c.v, b + 1, k, k >= 8 && k < 20 ? LOOK_AT_FEATURES : LOOK_AT_ALL);
    }
    post p = {NULL, 0, 0};
    for (int round = 0; round < 3; ++round) {
      for (size_t b = 0; b < 2; ++b) (void)post_collect(&p, c.teams[b], 0);
      for (size_t i = 0; i < p.count; ++i) {
        if (sender_of(&p.letters[i]) == 1) (void)hand_over(c.teams[1], &p.letters[i]);
        if (sender_of(&p.letters[i]) == 2 && !(kind_of(&p.letters[i]) == DATA && number_of(&p.letters[i]) == gone))
          (void)hand_over(c.teams[0], &p.letters[i]);
      }
      post_free(&p);
    }
    const cairn_team_report r = report_of(c.teams[0]);
    const cairn_status status = cairn_team_pose(c.teams[0], 2, &pose, covariance);
    /* Number 10, of 50 s, waits in vain until 62 s are over: step 13. */
    assert_int_equal(r.lost, k < 13 ? 0 : 1);
    assert_int_equal(r.unsettled, k < 9 || k >= 13 ? 0 : k - 8);
    assert_int_equal(status, k < 13 || k >= 20 ? CAIRN_OK : CAIRN_ERROR_NOT_FOUND);
    unknown = unknown || status != CAIRN_OK;
    assert_int_equal(r.vehicles_found, k >= 20);
    assert_ok(cairn_team_pose(c.teams[0], 1, NULL, NULL));
  }
  assert_true(unknown && report_of(c.teams[0]).requested > 2);
  assert_int_equal(report_of(c.teams[1]).lost, 0);
  for (uint64_t b = 1; b <= 2; ++b) {
    assert_ok(cairn_team_pose(c.teams[0], b, &pose, covariance));
    assert_ok(cairn_pose_error(&c.v.boats[b - 1][STEPS - 1].truth, &pose, error));
    for (int i = 0; i < 6; ++i) assert_near(error[i], 0, 4 * sqrt(covariance[7 * i]));
  }
  crew_close(&c);
}

/* p_b = p + r u(phi + theta), phi_b = phi + theta - theta' + pi: pose and covariance by hand, the own pose uncertain.
 */
static void a_teammate_is_found_where_both_see_it(void** state) {
  const double x = 10, y = -4, phi = 0.7, r = 200, theta = 0.4, back = -1.1;
  const double s_r = 2, s_t = 0.01, b_r = 1, b_t = 0.02; /* there, and back */
  const double P[3] = {0.5, 0.3, 2e-4};                  /* own x, y, heading */
  const cairn_pose start = pose_at(x, y, 0, 0, 0, phi);
  cairn_filter_options options = planar_options(&start);
  const cairn_range_bearing radar = fleet_radar();
  const cairn_team_options one = team_options(CAIRN_TEAM_JOINT, 1), two = team_options(CAIRN_TEAM_JOINT, 2);
  cairn_team *a = NULL, *b = NULL;
  cairn_pose pose;
  double covariance[36], error[6], expected[9], J[3][7] = {{0}};
  (void)state;
  options.initial_covariance[0] = P[0], options.initial_covariance[7] = P[1], options.initial_covariance[35] = P[2];
  assert_ok(cairn_team_create(&one, &options, &radar, &a));
  assert_ok(cairn_team_create(&two, &options, &radar, &b));
  assert_ok(cairn_team_add(a, 2, NULL, NULL));
  assert_status(cairn_team_pose(a, 2, &pose, covariance), CAIRN_ERROR_NOT_FOUND);
  const double s_rt = 0.3 * s_r * s_t, b_rt = -0.4 * b_r * b_t; /* ranges and bearings err together */
  cairn_observation there = sight(2, r + 1.5, theta, s_r, s_t), here = sight(1, r - 0.5, back, b_r, b_t);
  there.covariance[1] = there.covariance[2] = s_rt, here.covariance[1] = here.covariance[2] = b_rt;
  assert_ok(cairn_team_observe(a, 3.0, NULL, 0, &there, 1));
  assert_ok(cairn_team_observe(b, 3.0, NULL, 0, &here, 1));
  letter l = take_one(b);
  assert_int_equal(hand_over(a, &l), CAIRN_PACKET_TAKEN);
  free(l.bytes);
  assert_int_equal(report_of(a).vehicles_found, 1);
  assert_ok(cairn_team_pose(a, 2, &pose, covariance));

  const double w = b_r * b_r / (s_r * s_r + b_r * b_r), range = w * (r + 1.5) + (1 - w) * (r - 0.5), at = phi + theta;
  const cairn_pose place = pose_at(x + range * cos(at), y + range * sin(at), 0, 0, 0, phi + theta - back + PI);
  assert_ok(cairn_pose_error(&place, &pose, error));
  for (int i = 0; i < 6; ++i) assert_near(error[i], 0, 1e-9);
  /* By own x, y, heading; range and bearing there; range and bearing back. */
  J[0][0] = J[1][1] = J[2][2] = 1;
  J[0][2] = J[0][4] = -range * sin(at), J[1][2] = J[1][4] = range * cos(at);
  J[0][3] = w * cos(at), J[1][3] = w * sin(at), J[0][5] = (1 - w) * cos(at), J[1][5] = (1 - w) * sin(at);
  J[2][4] = 1, J[2][6] = -1;
  const double variances[7] = {P[0], P[1], P[2], s_r * s_r, s_t * s_t, b_r * b_r, b_t * b_t};
  for (int i = 0; i < 9; ++i) {
    expected[i] = 0;
    for (int k = 0; k < 7; ++k) expected[i] += J[i / 3][k] * variances[k] * J[i % 3][k];
    expected[i] += s_rt * (J[i / 3][3] * J[i % 3][4] + J[i / 3][4] * J[i % 3][3]);
    expected[i] += b_rt * (J[i / 3][5] * J[i % 3][6] + J[i / 3][6] * J[i % 3][5]);
  }
  static const int axes[3] = {0, 1, 5};
  for (int i = 0; i < 9; ++i) assert_near(covariance[6 * axes[i / 3] + axes[i % 3]], expected[i], 1e-8);
  cairn_team_destroy(a);
  cairn_team_destroy(b);
}

/* A start that nobody knows is found at the first step, through a third vehicle where need be. */
static void unknown_starts_are_found(void** state) {
  crew c;
  (void)state;
  voyage_record(&c.v, 3, 9);
  c.boats = 3;
  for (uint64_t b = 1; b <= 3; ++b) {
    cairn_team_options options = team_options(CAIRN_TEAM_JOINT, b);
    options.max_lag = 1e9;
    c.teams[b - 1] = boat_open(&c.v, &options);
  }
  /* Boat 1 knows nobody's start and does not look at 3, which 2 sees. */
  for (size_t k = 0; k < STEPS; ++k)
    for (size_t i = 0; i < c.v.boats[0][k].vehicle_count; ++i)
      if (c.v.boats[0][k].vehicles[i].id == 3) {
        c.v.boats[0][k].vehicles[i] = c.v.boats[0][k].vehicles[--c.v.boats[0][k].vehicle_count];
        break;
      }
  assert_ok(cairn_team_add(c.teams[0], 2, NULL, NULL));
  assert_ok(cairn_team_add(c.teams[0], 3, NULL, NULL));
  for (size_t k = 0; k < STEPS; ++k) {
    for (size_t b = 0; b < 3; ++b) boat_step(c.teams[b], &c.v, b + 1, k);
    for (size_t b = 0; b < 3; ++b) {
      post p = {NULL, 0, 0};
      (void)post_collect(&p, c.teams[b], 0);
      for (size_t i = 0; i < p.count && b > 0; ++i) (void)hand_over(c.teams[0], &p.letters[i]);
      post_free(&p);
    }
    assert_int_equal(report_of(c.teams[0]).vehicles_found, 2);
  }
  for (uint64_t b = 1; b <= 3; ++b) {
    cairn_pose pose;
    double covariance[36], error[6];
    assert_ok(cairn_team_pose(c.teams[0], b, &pose, covariance));
    assert_ok(cairn_pose_error(&c.v.boats[b - 1][STEPS - 1].truth, &pose, error));
    for (int i = 0; i < 6; ++i) assert_near(error[i], 0, 4 * sqrt(covariance[7 * i]));
  }
  crew_close(&c);
}

static void assert_members(const cairn_team* team, const uint64_t* expected, size_t count) {
  uint64_t members[8];
  size_t needed = 0;
  assert_ok(cairn_team_members(team, NULL, 0, &needed));
  assert_int_equal(needed, count);
  assert_ok(cairn_team_members(team, members, LENGTH(members), &needed));
  assert_int_equal(needed, count);
  for (size_t i = 0; i < count; ++i) assert_int_equal(members[i], expected[i]);
}

static void whoever_leaves_is_waited_for_no_more(void** state) {
  static const uint64_t both[] = {1, 2}, one[] = {1};
  crew c;
  size_t before = 0, after = 0;
  post p = {NULL, 0, 0};
  (void)state;
  crew_open(&c, 2, 5, 1e9, CAIRN_TEAM_JOINT);
  assert_members(c.teams[0], both, 2);
  for (size_t k = 0; k < 10; ++k)
    for (size_t b = 0; b < 2; ++b) boat_step(c.teams[b], &c.v, b + 1, k);
  assert_ok(cairn_team_leave(c.teams[1]));
  (void)post_collect(&p, c.teams[1], 0);
  size_t leave = p.count;
  for (size_t i = 0; i < p.count; ++i)
    if (kind_of(&p.letters[i]) == LEAVE) leave = i;
  assert_true(leave < p.count);
  assert_int_equal(number_of(&p.letters[leave]), 10);
  /* The farewell comes first, and has its turn when all else has come. */
  assert_int_equal(hand_over(c.teams[0], &p.letters[leave]), CAIRN_PACKET_WAITING);
  assert_members(c.teams[0], both, 2);
  for (size_t i = 0; i < p.count; ++i)
    if (kind_of(&p.letters[i]) == DATA) (void)hand_over(c.teams[0], &p.letters[i]);
  assert_members(c.teams[0], one, 1);
  assert_int_equal(report_of(c.teams[0]).unsettled, 0);
  assert_status(cairn_team_pose(c.teams[0], 2, NULL, NULL), CAIRN_ERROR_NOT_FOUND);
  assert_int_equal(hand_over(c.teams[0], &p.letters[leave]), CAIRN_PACKET_UNKNOWN);
  assert_ok(cairn_map_size(cairn_team_map(c.teams[0]), &before));
  boat_step(c.teams[0], &c.v, 1, 10);
  assert_int_equal(report_of(c.teams[0]).unsettled, 0);
  assert_ok(cairn_map_size(cairn_team_map(c.teams[0]), &after)); /* what it taught stays */
  assert_true(before > 3 && after >= before);
  post_free(&p);
  crew_close(&c);
}

/* With its packets in order the farewell is told as such. */
static void a_farewell_is_told(void** state) {
  crew c;
  (void)state;
  crew_open(&c, 2, 5, 1e9, CAIRN_TEAM_JOINT);
  for (size_t b = 0; b < 2; ++b) boat_step(c.teams[b], &c.v, b + 1, 0);
  letter l = take_one(c.teams[1]);
  assert_int_equal(hand_over(c.teams[0], &l), CAIRN_PACKET_TAKEN);
  free(l.bytes);
  assert_ok(cairn_team_leave(c.teams[1]));
  l = take_one(c.teams[1]);
  assert_int_equal(kind_of(&l), LEAVE);
  assert_int_equal(hand_over(c.teams[0], &l), CAIRN_PACKET_LEAVE);
  free(l.bytes);
  crew_close(&c);
}

/* A farewell is the last packet: what came after it would go by its number. */
static void nothing_follows_a_farewell(void** state) {
  crew c;
  (void)state;
  crew_open(&c, 2, 5, 1e9, CAIRN_TEAM_JOINT);
  boat_step(c.teams[1], &c.v, 2, 0);
  assert_ok(cairn_team_leave(c.teams[1]));
  const log_entry* e = &c.v.boats[1][1];
  const cairn_status status = cairn_team_observe(c.teams[1], c.v.time[1], e->features, e->feature_count, NULL, 0);
  post p = {NULL, 0, 0};
  (void)post_collect(&p, c.teams[1], 0);
  for (size_t i = 0; i < p.count; ++i)
    for (size_t j = 0; j < i; ++j)
      if (kind_of(&p.letters[i]) != REQUEST && kind_of(&p.letters[j]) != REQUEST)
        assert_int_not_equal(number_of(&p.letters[i]), number_of(&p.letters[j]));
  assert_true(status == CAIRN_OK || status == CAIRN_ERROR_STATE);
  post_free(&p);
  crew_close(&c);
}

/* What a vehicle taught before it was removed is not learnt once more when it is of the team again. */
static void nothing_is_taken_in_twice_over_a_return(void** state) {
  crew c;
  post p = {NULL, 0, 0};
  snapshot before = {0, NULL}, after = {0, NULL};
  cairn_pose pose;
  (void)state;
  crew_open(&c, 2, 5, 1e9, CAIRN_TEAM_JOINT);
  for (size_t k = 0; k < 5; ++k)
    for (size_t b = 0; b < 2; ++b) boat_step(c.teams[b], &c.v, b + 1, k);
  (void)post_collect(&p, c.teams[1], 0);
  for (size_t i = 0; i < p.count; ++i)
    if (kind_of(&p.letters[i]) == DATA) (void)hand_over(c.teams[0], &p.letters[i]);
  assert_int_equal(report_of(c.teams[0]).taken, 5);
  assert_ok(cairn_team_pose(c.teams[0], 2, &pose, NULL));
  assert_ok(cairn_team_remove(c.teams[0], 2));
  assert_ok(cairn_team_add(c.teams[0], 2, &pose, NULL));
  team_snapshot(&before, c.teams[0]);
  for (size_t i = 0; i < p.count; ++i)
    if (kind_of(&p.letters[i]) == DATA) (void)hand_over(c.teams[0], &p.letters[i]); /* the post's late copies */
  team_snapshot(&after, c.teams[0]);
  assert_int_equal(report_of(c.teams[0]).taken, 5);
  assert_true(snapshot_same(&before, &after));
  snapshot_free(&before), snapshot_free(&after);
  post_free(&p);
  crew_close(&c);
}

/* Boat 2 joins when boat 1 is long on its way, and both come to one estimate. */
static void join_late(const double* start_covariance) {
  const size_t late = 15;
  crew c;
  voyage_record(&c.v, 2, 5);
  c.boats = 2;
  for (uint64_t b = 1; b <= 2; ++b) {
    cairn_team_options options = team_options(CAIRN_TEAM_JOINT, b);
    options.max_lag = 1e9;
    if (b == 1) {
      c.teams[0] = boat_open(&c.v, &options);
    } else {
      cairn_filter_options filter = planar_options(&c.v.boats[1][late].truth);
      const cairn_range_bearing radar = fleet_radar();
      if (start_covariance != NULL)
        memcpy(filter.initial_covariance, start_covariance, sizeof filter.initial_covariance);
      c.teams[1] = NULL;
      assert_ok(cairn_team_create(&options, &filter, &radar, &c.teams[1]));
    }
  }
  for (size_t k = 0; k < late; ++k) {
    boat_step(c.teams[0], &c.v, 1, k);
    assert_int_equal(report_of(c.teams[0]).unsettled, 0);
  }
  assert_ok(cairn_team_add(c.teams[0], 2, &c.v.boats[1][late].truth, start_covariance));
  boat_add(c.teams[1], &c.v, 1); /* where it stood before its first packet, which is asked for */
  for (size_t k = late; k < STEPS; ++k) {
    boat_step(c.teams[0], &c.v, 1, k);
    if (k > late) boat_move(c.teams[1], &c.v, 2, k);
    boat_look(c.teams[1], &c.v, 2, k, LOOK_AT_ALL);
    post p = {NULL, 0, 0};
    for (int round = 0; round < 3; ++round) {
      for (size_t b = 0; b < 2; ++b) (void)post_collect(&p, c.teams[b], 0);
      for (size_t i = 0; i < p.count; ++i) (void)hand_over(c.teams[sender_of(&p.letters[i]) == 1], &p.letters[i]);
      post_free(&p);
    }
  }
  for (size_t b = 0; b < 2; ++b) assert_int_equal(report_of(c.teams[b]).unsettled, 0);
  assert_int_equal(report_of(c.teams[1]).taken, STEPS);
  assert_int_equal(report_of(c.teams[0]).taken, STEPS - late);
  for (size_t b = 0; b < 2; ++b) assert_int_equal(report_of(c.teams[b]).failed, 0);
  assert_replicas_agree(&c, 1e-6);
  crew_close(&c);
}

static void joining_late(void** state) {
  double covariance[36];
  (void)state;
  diagonal(covariance, 6, 0);
  covariance[0] = covariance[7] = 25, covariance[35] = 1e-4;
  join_late(covariance);
}

/* No covariance of its own beside an uncertain heading: every difference of the two is one of rounding. */
static void joining_late_from_a_place_known_exactly(void** state) {
  (void)state;
  join_late(NULL);
}

/* Whatever motion a vehicle may tell its own team of, its teammates take, however few directions its noise has. */
static void noise_of_any_rank_is_told(void** state) {
  generator random = {77};
  (void)state;
  for (int n = 0; n < 400; ++n) {
    const cairn_pose start = pose_at(0, 0, 0, 0, 0, random_uniform(&random, -3, 3));
    const cairn_filter_options options = planar_options(&start);
    const cairn_range_bearing radar = fleet_radar();
    const cairn_team_options one = team_options(CAIRN_TEAM_JOINT, 1), two = team_options(CAIRN_TEAM_JOINT, 2);
    cairn_team *a = NULL, *b = NULL;
    assert_ok(cairn_team_create(&one, &options, &radar, &a));
    assert_ok(cairn_team_create(&two, &options, &radar, &b));
    assert_ok(cairn_team_add(a, 2, &start, NULL));
    cairn_twist_noise noise;
    assert_ok(cairn_twist_noise_init(&noise, sizeof noise));
    for (int i = 0; i < 3; ++i) noise.velocity_sigma[i] = noise.rate_sigma[i] = 0;
    if ((n & 1) != 0) noise.velocity_sigma[0] = random_uniform(&random, 1e-3, 1);
    if ((n & 2) != 0) noise.velocity_sigma[1] = random_uniform(&random, 1e-3, 1);
    if ((n & 4) != 0) noise.rate_sigma[2] = random_uniform(&random, 1e-4, 0.1);
    const double velocity[3] = {random_uniform(&random, -3, 3), random_uniform(&random, -1, 1), 0};
    const double rate[3] = {0, 0, random_uniform(&random, -1, 1)};
    assert_ok(cairn_team_predict_twist(b, random_uniform(&random, 0.01, 5), velocity, rate, &noise));
    if (n % 3 == 0) { /* given as a matrix of rank one */
      double g[3], covariance[36] = {0};
      static const int axes[3] = {0, 1, 5};
      for (int i = 0; i < 3; ++i) g[i] = random_normal(&random, 0.1);
      for (int i = 0; i < 9; ++i) covariance[6 * axes[i / 3] + axes[i % 3]] = g[i / 3] * g[i % 3];
      assert_ok(cairn_team_predict_increment(b, &start, covariance));
    }
    assert_ok(cairn_team_observe(b, 1, NULL, 0, NULL, 0));
    assert_ok(cairn_team_observe(a, 1, NULL, 0, NULL, 0));
    letter l = take_one(b);
    assert_int_equal(hand_over(a, &l), CAIRN_PACKET_TAKEN);
    free(l.bytes);
    cairn_team_destroy(a);
    cairn_team_destroy(b);
  }
}

/* --- figures --- */

static double frobenius(const double covariance[36]) {
  return sqrt(covariance[0] * covariance[0] + 2 * covariance[1] * covariance[1] + covariance[7] * covariance[7]);
}

static void scores_are_what_they_say(void** state) {
  (void)state;
  crew c;
  double claimed = 0, claimed_alone = 0, squared = 0, squared_alone = 0, nees_alone = 0;
  crew_open(&c, 2, 5, 1e9, CAIRN_TEAM_JOINT);
  cairn_team_destroy(c.teams[0]);
  cairn_team_options options = team_options(CAIRN_TEAM_JOINT, 1);
  options.baseline = 1;
  c.teams[0] = boat_open(&c.v, &options);
  boat_add(c.teams[0], &c.v, 2);
  /* Two of boat 1 alone: one by a team of one, whose figures are known, one by a filter. */
  options.mode = CAIRN_TEAM_MONO;
  cairn_team* mono = boat_open(&c.v, &options);
  cairn_filter* filter = NULL;
  const cairn_filter_options lone = planar_options(&c.v.boats[0][0].truth);
  const cairn_range_bearing radar = fleet_radar();
  const cairn_twist_noise noise = fleet_noise();
  int32_t sensor;
  assert_ok(cairn_filter_create(&lone, &filter));
  assert_ok(cairn_filter_add_range_bearing(filter, &radar, &sensor));
  assert_ok(cairn_filter_set_twist_noise(filter, &noise));
  assert_int_equal(report_of(c.teams[0]).scored, 0);
  assert_true(report_of(c.teams[0]).position_rmse == 0 && report_of(c.teams[0]).claimed_improvement == 0);
  size_t steps = 0, nees_steps = 0;
  for (size_t k = 0; k < STEPS; ++k) {
    const log_entry* e = &c.v.boats[0][k];
    const double velocity[3] = {e->speed, 0, 0}, rate[3] = {0, 0, e->rate};
    cairn_pose pose;
    double covariance[36], nees = 0;
    for (size_t b = 0; b < 2; ++b) boat_step(c.teams[b], &c.v, b + 1, k);
    boat_step(mono, &c.v, 1, k);
    post p = {NULL, 0, 0};
    (void)post_collect(&p, c.teams[1], 0);
    for (size_t i = 0; i < p.count; ++i) (void)hand_over(c.teams[0], &p.letters[i]);
    post_free(&p);
    (void)post_collect(&p, c.teams[0], 0);
    for (size_t i = 0; i < p.count; ++i) (void)hand_over(c.teams[1], &p.letters[i]);
    post_free(&p);
    if (k > 0) assert_ok(cairn_filter_predict_twist(filter, c.v.dt[k], velocity, rate));
    assert_ok(cairn_filter_update(filter, sensor, e->features, e->feature_count, NULL));
    assert_ok(cairn_team_score(c.teams[0], &e->truth));
    assert_ok(cairn_team_score(mono, &e->truth));
    ++steps;
    assert_ok(cairn_team_pose(c.teams[0], 1, &pose, covariance));
    claimed += frobenius(covariance);
    squared += pow(pose.position[0] - e->truth.position[0], 2) + pow(pose.position[1] - e->truth.position[1], 2);
    assert_ok(cairn_filter_pose(filter, &pose, covariance));
    claimed_alone += frobenius(covariance);
    squared_alone += pow(pose.position[0] - e->truth.position[0], 2) + pow(pose.position[1] - e->truth.position[1], 2);
    if (cairn_filter_pose_nees(filter, &e->truth, &nees) == CAIRN_OK) nees_alone += nees, ++nees_steps;
  }
  const cairn_team_report joint = report_of(c.teams[0]), single = report_of(mono);
  assert_int_equal(joint.scored, steps);
  assert_near(joint.position_rmse, sqrt(squared / (double)steps), 1e-9);
  assert_near(joint.claimed_improvement, 1 - claimed / claimed_alone, 1e-9);
  assert_near(joint.true_improvement, 1 - squared / squared_alone, 1e-9);
  assert_true(joint.claimed_improvement > 0.05);
  assert_near(single.position_rmse, sqrt(squared_alone / (double)steps), 1e-9);
  assert_near(single.claimed_improvement, 0, 1e-12);
  assert_near(single.true_improvement, 0, 1e-12);
  assert_near(single.anees_per_dof, nees_alone / (3 * (double)nees_steps), 1e-6);
  assert_true(nees_steps >= STEPS - 4); /* the start is known exactly, and the first noise has two directions */
  cairn_filter_destroy(filter);
  cairn_team_destroy(mono);
  crew_close(&c);
}

/* Both sides of the comparison are as of now: motion that no scan has followed yet is not the team's fault, nor are
 * steps that wait for teammates. */
static void a_score_between_scans_compares_like_with_like(void** state) {
  (void)state;
  voyage v;
  voyage_record(&v, 1, 5);
  cairn_team_options options = team_options(CAIRN_TEAM_MONO, 1);
  options.baseline = 1;
  cairn_team* team = boat_open(&v, &options);
  for (size_t k = 0; k < 20; ++k) {
    boat_move(team, &v, 1, k);
    if (k % 2 == 1) boat_look(team, &v, 1, k, LOOK_AT_FEATURES);
    assert_ok(cairn_team_score(team, &v.boats[0][k].truth));
  }
  assert_near(report_of(team).claimed_improvement, 0, 1e-12);
  assert_near(report_of(team).true_improvement, 0, 1e-12);
  cairn_team_destroy(team);
}

static void counters_count(void** state) {
  crew c;
  (void)state;
  crew_open(&c, 2, 5, 1e9, CAIRN_TEAM_JOINT);
  post own = {NULL, 0, 0}, mates = {NULL, 0, 0};
  for (size_t k = 0; k < 4; ++k)
    for (size_t b = 0; b < 2; ++b) boat_step(c.teams[b], &c.v, b + 1, k);
  (void)post_collect(&own, c.teams[0], 0);
  (void)post_collect(&mates, c.teams[1], 0);
  const letter* by_number[4] = {NULL, NULL, NULL, NULL};
  for (size_t i = 0; i < mates.count; ++i)
    if (kind_of(&mates.letters[i]) == DATA) by_number[number_of(&mates.letters[i])] = &mates.letters[i];
  cairn_team* team = c.teams[0];
  assert_int_equal(hand_over(team, by_number[1]), CAIRN_PACKET_WAITING);
  assert_int_equal(hand_over(team, by_number[1]), CAIRN_PACKET_REPEATED);
  assert_int_equal(report_of(team).reordered, 0);
  assert_int_equal(hand_over(team, by_number[0]), CAIRN_PACKET_TAKEN);
  assert_int_equal(report_of(team).reordered, 1);
  assert_int_equal(report_of(team).unsettled, 2);
  assert_int_equal(hand_over(team, by_number[0]), CAIRN_PACKET_REPEATED);
  assert_int_equal(hand_over(team, &own.letters[0]), CAIRN_PACKET_OWN);
  for (size_t i = 0; i < mates.count; ++i)
    if (kind_of(&mates.letters[i]) == REQUEST) {
      assert_int_equal(hand_over(team, &mates.letters[i]), CAIRN_PACKET_REQUEST);
      break;
    }
  post again = {NULL, 0, 0};
  (void)post_collect(&again, team, 0);
  const cairn_team_report r = report_of(team);
  assert_int_equal(r.sent, 4);
  assert_int_equal(r.taken, 2);
  assert_int_equal(r.repeated, 2);
  assert_int_equal(r.own, 1);
  assert_int_equal(r.received, 6);
  assert_int_equal(r.resent, 4);
  assert_int_equal(again.count, 4);
  assert_true(r.requested > 0);
  assert_true(r.matched + r.placed + r.rejected > 10);
  post_free(&own), post_free(&mates), post_free(&again);
  crew_close(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_vehicle_alone_is_the_ordinary_filter),
      cmocka_unit_test(a_twist_moves_a_team_as_it_moves_a_filter),
      cmocka_unit_test(the_own_pose_is_as_of_now),
      cmocka_unit_test(all_vehicles_come_to_one_estimate),
      cmocka_unit_test(the_post_does_not_matter),
      cmocka_unit_test(a_packet_that_comes_before_the_own_scan_waits_for_it),
      cmocka_unit_test(extended_observations_wait_for_the_own_scan),
      cmocka_unit_test(names_are_not_needed),
      cmocka_unit_test(the_nearest_places_a_landmark),
      cmocka_unit_test(whoever_is_told_more_claims_more),
      cmocka_unit_test(whoever_is_never_heard_of_is_given_up),
      cmocka_unit_test(an_own_scan_that_fails_is_told),
      cmocka_unit_test(what_is_lost_for_good_is_given_up),
      cmocka_unit_test(a_teammate_is_found_where_both_see_it),
      cmocka_unit_test(unknown_starts_are_found),
      cmocka_unit_test(whoever_leaves_is_waited_for_no_more),
      cmocka_unit_test(a_farewell_is_told),
      cmocka_unit_test(nothing_follows_a_farewell),
      cmocka_unit_test(nothing_is_taken_in_twice_over_a_return),
      cmocka_unit_test(joining_late),
      cmocka_unit_test(joining_late_from_a_place_known_exactly),
      cmocka_unit_test(noise_of_any_rank_is_told),
      cmocka_unit_test(scores_are_what_they_say),
      cmocka_unit_test(a_score_between_scans_compares_like_with_like),
      cmocka_unit_test(counters_count),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
