/* SPDX-License-Identifier: BSD-3-Clause */
/* One boat of a team that maps buoys together. Each boat is a process of its own and exchanges packets with the others
 * over MQTT. All boats create the same simulated sea from the seed, and each uses only its own commands and its own
 * radar. run.sh starts a team. README.md has the details.
 *
 *   boat NUMBER BOATS FEATURES SEED STEPS PORT LOSS OUTPUT [joint|eo_full|eo_diagonal|mono] */
#include <cairn/cairn.h>
#include <cairn/fleet.h>
#include <cairn/team.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "radio.h"

enum { MOST_AHEAD = 4 }; /* steps that a boat may make while older ones still wait for teammates */

static const double step_every = 0.005; /* s between steps, faster than real time; longer for a boat that is ahead */
static const double ask_after = 0.03;   /* s without packets, after which a waiting boat asks for missing packets */
static const double time_limit = 60.0;  /* s, for everything */

static unsigned long long me;

static void die(const char* format, ...) {
  va_list arguments;
  fprintf(stderr, "boat %llu: ", me);
  va_start(arguments, format);
  vfprintf(stderr, format, arguments);
  va_end(arguments);
  fputc('\n', stderr);
  exit(1);
}

static void check(cairn_status status) {
  if (status != CAIRN_OK) die("%s: %s", cairn_status_name(status), cairn_last_message());
}

static void* must_have(void* memory) {
  if (!memory) die("out of memory");
  return memory;
}

typedef struct boat {
  cairn_fleet* fleet; /* the sea */
  cairn_fleet_options sea;
  cairn_fleet_step now;
  cairn_fleet_vehicle* boats; /* all boats now */
  cairn_fleet_sighting* seen; /* room for what this boat sees */
  cairn_team* team;           /* this boat's view of the team */
  cairn_observation *landmarks, *vehicles;
  uint8_t* packet;
  size_t packet_capacity;
  radio* radio;
} boat;

static void sail_on(boat* b) {
  b->now.struct_size = sizeof b->now;
  check(cairn_fleet_next(b->fleet, &b->now, NULL));
  size_t needed = 0;
  check(cairn_fleet_vehicles(b->fleet, b->boats, b->sea.vehicles, &needed, NULL));
}

static cairn_pose place(const cairn_fleet_vehicle* vehicle) {
  cairn_pose pose = {{vehicle->x, vehicle->y, 0.0}, {1.0, 0.0, 0.0, 0.0}};
  check(cairn_quaternion_from_euler(0.0, 0.0, vehicle->heading, pose.quaternion, NULL));
  return pose;
}

/* All boats know the start of each boat, and nothing else about each other. */
static void join_team(boat* b, int32_t mode, uint32_t steps) {
  cairn_filter_options filter;
  check(cairn_filter_options_init(&filter, sizeof filter, NULL));
  filter.vehicle = CAIRN_VEHICLE_PLANAR;
  filter.max_landmarks = b->sea.features;
  filter.max_observations = b->sea.features + b->sea.vehicles;
  filter.initial_pose = place(&b->boats[me - 1]);

  cairn_range_bearing radar;
  check(cairn_range_bearing_init(&radar, sizeof radar, NULL));
  radar.range_sigma = b->sea.range_sigma;
  radar.bearing_sigma = b->sea.bearing_sigma;

  cairn_team_options options;
  check(cairn_team_options_init(&options, sizeof options, NULL));
  options.mode = mode;
  options.vehicle = me;
  options.max_vehicles = b->sea.vehicles;
  options.history = steps;
  options.max_lag = 2.0 * b->sea.duration; /* no packet is ever given up, so that all maps are equal in the end */
  check(cairn_team_create(&options, &filter, &radar, &b->team, NULL));
  for (uint32_t other = 1; other <= b->sea.vehicles; ++other) {
    if (other == me) continue;
    const cairn_pose start = place(&b->boats[other - 1]);
    check(cairn_team_add(b->team, other, &start, NULL, NULL));
  }
}

static void convert(const cairn_fleet_sighting* sightings, size_t count, cairn_observation* observations) {
  memset(observations, 0, count * sizeof *observations); /* covariance 0: the noise of the radar is used */
  for (size_t i = 0; i < count; ++i) {
    observations[i].id = sightings[i].id;
    observations[i].z[0] = sightings[i].range;
    observations[i].z[1] = sightings[i].bearing;
  }
}

/* This boat's part of a step: the commanded motion, then the scan of the radar. */
static void tell_step(boat* b) {
  const cairn_fleet_vehicle* own = &b->boats[me - 1];
  const size_t most = (size_t)b->sea.features + b->sea.vehicles;
  size_t features = 0, vehicles = 0;
  if (b->now.dt > 0.0) {
    const double velocity[3] = {own->speed, 0.0, 0.0}, rate[3] = {0.0, 0.0, own->rate};
    cairn_twist_noise noise;
    check(cairn_twist_noise_init(&noise, sizeof noise, NULL));
    noise.velocity_sigma[0] = b->sea.speed_sigma;
    noise.velocity_sigma[1] = 0.0; /* these boats have no leeway */
    noise.rate_sigma[2] = b->sea.rate_sigma;
    check(cairn_team_predict_twist(b->team, b->now.dt, velocity, rate, &noise, NULL));
  }
  check(cairn_fleet_seen_features(b->fleet, me, b->seen, most, &features, NULL));
  convert(b->seen, features, b->landmarks);
  check(cairn_fleet_seen_vehicles(b->fleet, me, b->seen, most, &vehicles, NULL));
  convert(b->seen, vehicles, b->vehicles);
  check(cairn_team_observe(b->team, b->now.time, b->landmarks, features, b->vehicles, vehicles, NULL));
}

/* Own steps, repetitions and requests. The radio need not distinguish them. */
static void send_packets(boat* b) {
  for (;;) {
    size_t size = 0;
    check(cairn_team_take_packet(b->team, NULL, 0, &size, NULL));
    if (size == 0) return;
    if (size > b->packet_capacity) {
      b->packet = must_have(realloc(b->packet, size));
      b->packet_capacity = size;
    }
    check(cairn_team_take_packet(b->team, b->packet, b->packet_capacity, &size, NULL));
    radio_send(b->radio, b->packet, size);
  }
}

static void take_packet(void* user, const uint8_t* packet, size_t size) {
  boat* b = user;
  check(cairn_team_receive(b->team, packet, size, NULL, NULL)); /* the team counts refused packets */
}

static cairn_team_report report_of(const boat* b) {
  cairn_team_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  check(cairn_team_last_report(b->team, &report, NULL));
  return report;
}

static void give_up(const boat* b, unsigned long steps_done) {
  if (!radio_is_connected(b->radio)) die("no broker on that port within %g s", time_limit);
  fprintf(stderr, "boat %llu: not all done after %g s: %lu steps sailed, %u of them wait for teammates; not done:", me,
          time_limit, steps_done, (unsigned)report_of(b).unsettled);
  for (uint32_t other = 1; other <= b->sea.vehicles; ++other)
    if (other != me && radio_is_busy(b->radio, other)) fprintf(stderr, " %u", (unsigned)other);
  fputc('\n', stderr);
  exit(1);
}

/* Moves, sends and listens until all boats have all packets. A boat that is done still answers the others. */
static void run(boat* b, unsigned long steps) {
  const double start = radio_now();
  double next_step = start, news = start;
  unsigned long done = 0;
  uint64_t known = 0; /* teammates' packets that are part of the estimate */
  while (radio_busy(b->radio) > 0) {
    const double now = radio_now();
    if (now - start > time_limit) give_up(b, done);
    cairn_team_report report = report_of(b);
    if (done < steps && report.unsettled < MOST_AHEAD && now >= next_step) {
      if (done > 0) sail_on(b);
      tell_step(b);
      ++done;
      next_step = now + step_every * (1.0 + 2.0 * report.unsettled);
    }
    radio_listen(b->radio);

    report = report_of(b);
    if (report.taken != known || report.unsettled == 0) {
      known = report.taken;
      news = now;
    }
    /* The team asks by itself at every own step. A boat that waits, or is at its end, makes no steps and must ask. */
    if (now - news > ask_after) {
      check(cairn_team_ask(b->team, NULL));
      news = now;
    }
    if (done == steps && report.unsettled == 0) radio_say_done(b->radio);
    send_packets(b);
  }
}

static void write_results(const boat* b, const char* path) {
  FILE* out = fopen(path, "w");
  if (!out) die("cannot write %s", path);
  const cairn_team_report r = report_of(b);
  const radio_counts c = radio_counted(b->radio);
  const struct {
    const char* name;
    uint64_t value;
  } counters[] = {{"published", c.published},
                  {"dropped", c.dropped},
                  {"delayed", c.delayed},
                  {"doubled", c.doubled},
                  {"sent", r.sent},
                  {"resent", r.resent},
                  {"requested", r.requested},
                  {"received", r.received},
                  {"taken", r.taken},
                  {"reordered", r.reordered},
                  {"repeated", r.repeated},
                  {"ignored", r.ignored},
                  {"lost", r.lost},
                  {"matched", r.matched},
                  {"placed", r.placed},
                  {"rejected", r.rejected},
                  {"sightings_used", r.sightings_used},
                  {"sightings_refused", r.sightings_refused},
                  {"failed", r.failed},
                  {"refused", r.own + r.unknown + r.past + r.conflict + r.full + r.foreign + r.version + r.cut +
                                  r.corrupt + r.nonsense}};
  for (size_t i = 0; i < sizeof counters / sizeof *counters; ++i)
    fprintf(out, "counter,%s,%llu\n", counters[i].name, (unsigned long long)counters[i].value);

  size_t count = 0, features = 0;
  check(cairn_map_size(cairn_team_map(b->team), &count, NULL));
  check(cairn_fleet_features(b->fleet, NULL, 0, &features, NULL));
  cairn_landmark* map = must_have(malloc((count + 1) * sizeof *map));
  double* truth = must_have(malloc((features + 1) * 2 * sizeof *truth));
  check(cairn_map_landmarks(cairn_team_map(b->team), map, count, &count, NULL));
  check(cairn_fleet_features(b->fleet, truth, features, &features, NULL));
  fprintf(out, "# landmark,id,x,y,variance_x,covariance_xy,variance_y,true_x,true_y\n");
  for (size_t i = 0; i < count; ++i) {
    const double* true_place = &truth[2 * (map[i].id - 1)];
    fprintf(out, "landmark,%llu,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", (unsigned long long)map[i].id,
            map[i].position[0], map[i].position[1], map[i].covariance[0], map[i].covariance[1], map[i].covariance[4],
            true_place[0], true_place[1]);
  }
  free(truth);
  free(map);
  if (fclose(out) != 0) die("cannot write %s", path);
}

static unsigned long long whole(const char* text, const char* name, unsigned long long least, unsigned long long most) {
  char* end;
  const unsigned long long value = strtoull(text, &end, 10);
  if (*text < '0' || *text > '9' || *end != '\0' || value < least || value > most)
    die("%s: %s is no number from %llu to %llu", name, text, least, most);
  return value;
}

static int32_t mode_of(const char* name) {
  if (strcmp(name, "joint") == 0) return CAIRN_TEAM_JOINT;
  if (strcmp(name, "eo_full") == 0) return CAIRN_TEAM_EO_FULL;
  if (strcmp(name, "eo_diagonal") == 0) return CAIRN_TEAM_EO_DIAGONAL;
  if (strcmp(name, "mono") == 0) return CAIRN_TEAM_MONO;
  die("mode: %s is none of joint, eo_full, eo_diagonal, mono", name);
  return -1;
}

int main(int argc, char** argv) {
  if (argc != 9 && argc != 10) {
    fprintf(stderr, "usage: boat NUMBER BOATS FEATURES SEED STEPS PORT LOSS OUTPUT [joint|eo_full|eo_diagonal|mono]\n");
    return 2;
  }
  boat b;
  memset(&b, 0, sizeof b);
  check(cairn_fleet_options_init(&b.sea, sizeof b.sea, NULL));
  b.sea.vehicles = (uint32_t)whole(argv[2], "BOATS", 1, 64);
  me = whole(argv[1], "NUMBER", 1, b.sea.vehicles);
  b.sea.features = (uint32_t)whole(argv[3], "FEATURES", 1, 1000);
  b.sea.seed = whole(argv[4], "SEED", 0, UINT64_MAX);
  check(cairn_fleet_create(&b.sea, &b.fleet, NULL));
  size_t most_steps = 0;
  check(cairn_fleet_steps(b.fleet, &most_steps, NULL));
  const uint32_t steps = (uint32_t)whole(argv[5], "STEPS", 1, most_steps);
  const int port = (int)whole(argv[6], "PORT", 1, 65535);
  char* end;
  const double loss = strtod(argv[7], &end);
  if (end == argv[7] || *end != '\0' || !(loss >= 0.0 && loss < 1.0)) die("LOSS: %s is not in [0, 1)", argv[7]);
  const int32_t mode = argc == 10 ? mode_of(argv[9]) : CAIRN_TEAM_JOINT;

  b.landmarks = must_have(malloc(b.sea.features * sizeof *b.landmarks));
  b.vehicles = must_have(malloc(b.sea.vehicles * sizeof *b.vehicles));
  b.boats = must_have(malloc(b.sea.vehicles * sizeof *b.boats));
  b.seen = must_have(malloc(((size_t)b.sea.features + b.sea.vehicles) * sizeof *b.seen));
  sail_on(&b); /* the step at the start, before any motion */
  join_team(&b, mode, steps);
  b.radio = must_have(radio_open(me, b.sea.vehicles, port, loss, b.sea.seed, take_packet, &b));
  run(&b, steps);
  write_results(&b, argv[8]);

  radio_close(b.radio);
  cairn_team_destroy(b.team);
  cairn_fleet_destroy(b.fleet);
  free(b.packet);
  free(b.seen);
  free(b.boats);
  free(b.vehicles);
  free(b.landmarks);
  return 0;
}
