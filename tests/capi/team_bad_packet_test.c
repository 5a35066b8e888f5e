/* SPDX-License-Identifier: BSD-3-Clause */
/* Packets that a team refuses: anybody may send them. The estimate must stay the same to the bit after every packet. */
#include "team_stage.h"

/* Passes a copy in a buffer of exactly its size; returns the outcome. */
static int32_t give(stage* s, const uint8_t* bytes, size_t size) {
  int32_t result = 0;
  uint8_t* exact = malloc(size + (size == 0));
  assert_non_null(exact);
  memcpy(exact, bytes, size);
  assert_ok(cairn_team_receive(s->a, exact, size, &result, NULL));
  free(exact);
  return result;
}

static void write_number(uint8_t* at, uint64_t value, size_t bytes) {
  for (size_t i = 0; i < bytes; ++i) at[i] = (uint8_t)(value >> (8 * i));
}
static void write_real(uint8_t* at, double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  write_number(at, bits, 8);
}

static void packets_cut_short(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  for (size_t size = 0; size < s.next.size; ++size)
    assert_int_equal(give(&s, s.next.bytes, size), size < 4 ? CAIRN_PACKET_FOREIGN : CAIRN_PACKET_CUT);
  uint8_t* longer = calloc(1, s.next.size + 8);
  assert_non_null(longer);
  memcpy(longer, s.next.bytes, s.next.size);
  for (size_t more = 1; more <= 8; ++more) assert_int_equal(give(&s, longer, s.next.size + more), CAIRN_PACKET_CUT);
  free(longer);
  const cairn_team_report r = report_of(s.a);
  assert_int_equal(r.foreign, 4);
  assert_int_equal(r.cut, s.next.size - 4 + 8);
  unchanged(&s);
  /* Truncated packets with a size and a checksum that fit the remaining bytes. */
  for (size_t size = 16; size < s.next.size; ++size) {
    uint8_t* cut = malloc(size);
    assert_non_null(cut);
    memcpy(cut, s.next.bytes, size);
    write_number(cut + AT_SIZE, size, 4);
    seal(cut, size);
    assert_int_equal(give(&s, cut, size), CAIRN_PACKET_NONSENSE);
    free(cut);
  }
  stage_close(&s);
}

static void every_byte_flipped(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  for (size_t i = 0; i < s.next.size; ++i)
    for (int bit = 0; bit < 9; ++bit) {
      const uint8_t good = s.next.bytes[i];
      s.next.bytes[i] ^= (uint8_t)(bit < 8 ? 1 << bit : 0xff);
      const int32_t expected = i < 4            ? CAIRN_PACKET_FOREIGN
                               : i < AT_KIND    ? CAIRN_PACKET_VERSION
                               : i < AT_SIZE    ? CAIRN_PACKET_CORRUPT
                               : i < AT_VEHICLE ? CAIRN_PACKET_CUT
                                                : CAIRN_PACKET_CORRUPT;
      assert_int_equal(give(&s, s.next.bytes, s.next.size), expected);
      s.next.bytes[i] = good;
    }
  stage_close(&s);
}

static void foreign_bytes(void** state) {
  stage s;
  generator random = {3};
  uint8_t bytes[300];
  (void)state;
  stage_open(&s);
  assert_int_equal(give(&s, bytes, 0), CAIRN_PACKET_FOREIGN);
  for (int n = 0; n < 2000; ++n) {
    const size_t size = (size_t)(random_bits(&random) % sizeof bytes);
    for (size_t i = 0; i < size; ++i) bytes[i] = (uint8_t)random_bits(&random);
    if (n % 2 == 0 && size >= 8) { /* a good beginning */
      memcpy(bytes, s.next.bytes, 8);
      if (size >= 12) write_number(bytes + AT_SIZE, size, 4);
      if (size >= 16 && n % 4 == 0) seal(bytes, size);
    }
    assert_true(give(&s, bytes, size) >= CAIRN_PACKET_UNKNOWN);
  }
  const cairn_team_report r = report_of(s.a);
  assert_int_equal(r.taken, UNDER_WAY);
  assert_int_equal(r.received, UNDER_WAY + 2001);
  stage_close(&s);
}

/* A good packet is changed and gets a new checksum: a broken or malicious sender could send it. */
static int32_t give_changed(stage* s, size_t at, uint64_t value, size_t bytes) {
  uint8_t* copy = malloc(s->next.size);
  assert_non_null(copy);
  memcpy(copy, s->next.bytes, s->next.size);
  write_number(copy + at, value, bytes);
  seal(copy, s->next.size);
  const int32_t result = give(s, copy, s->next.size);
  free(copy);
  return result;
}
static int32_t give_real(stage* s, size_t at, double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  return give_changed(s, at, bits, 8);
}

static void heads_that_do_not_fit(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  const uint64_t number = number_of(&s.next);
  assert_int_equal(number, UNDER_WAY);
  assert_int_equal(give_changed(&s, AT_VERSION, 0, 2), CAIRN_PACKET_VERSION);
  assert_int_equal(give_changed(&s, AT_VERSION, 2, 2), CAIRN_PACKET_VERSION);
  assert_int_equal(give_changed(&s, AT_VERSION, 0xffff, 2), CAIRN_PACKET_VERSION);
  assert_int_equal(give_changed(&s, AT_KIND, 0, 2), CAIRN_PACKET_NONSENSE);
  assert_int_equal(give_changed(&s, AT_KIND, 4, 2), CAIRN_PACKET_NONSENSE);
  assert_int_equal(give_changed(&s, AT_KIND, REQUEST, 2), CAIRN_PACKET_NONSENSE); /* too long for a packet */
  assert_int_equal(give_changed(&s, AT_VEHICLE, 3, 8), CAIRN_PACKET_UNKNOWN);
  assert_int_equal(give_changed(&s, AT_VEHICLE, CAIRN_ID_NONE, 8), CAIRN_PACKET_UNKNOWN);
  unchanged(&s);
  /* With this vehicle's number: another vehicle with the same number. (Its sighting of 1 would be of itself and is
     refused first.) */
  const int32_t own = give_changed(&s, AT_VEHICLE, 1, 8);
  assert_true(own == CAIRN_PACKET_CONFLICT || own == CAIRN_PACKET_NONSENSE);
  /* Numbers that arrived before, with another content. */
  for (uint64_t n = 0; n < number; ++n) assert_int_equal(give_changed(&s, AT_NUMBER, n, 8), CAIRN_PACKET_CONFLICT);
  /* Times that are out of order. */
  const double past[] = {-1e300, -1, 0, s.v.time[UNDER_WAY - 1]};
  for (size_t i = 0; i < LENGTH(past); ++i) assert_int_equal(give_real(&s, AT_TIME, past[i]), CAIRN_PACKET_PAST);
  for (size_t i = 0; i < LENGTH(not_finite); ++i)
    assert_int_equal(give_real(&s, AT_TIME, not_finite[i]), CAIRN_PACKET_NONSENSE);
  for (size_t i = 0; i < s.old.count; ++i)
    assert_int_equal(give(&s, s.old.letters[i].bytes, s.old.letters[i].size), CAIRN_PACKET_REPEATED);
  const cairn_team_report r = report_of(s.a);
  assert_int_equal(r.version, 3);
  assert_int_equal(r.unknown, 2);
  assert_int_equal(r.conflict, UNDER_WAY + (own == CAIRN_PACKET_CONFLICT));
  assert_int_equal(r.past, LENGTH(past));
  assert_int_equal(r.repeated, UNDER_WAY);
  assert_int_equal(r.nonsense, 3 + LENGTH(not_finite) + (own == CAIRN_PACKET_NONSENSE));
  stage_close(&s);
}

/* Two boats that both have number 2: the first boat's packets are kept. */
static void two_vehicles_of_one_number(void** state) {
  stage s;
  voyage other;
  (void)state;
  stage_open(&s);
  voyage_record(&other, 2, 22);
  const cairn_team_options options = team_options(CAIRN_TEAM_JOINT, 2);
  cairn_team* impostor = boat_open(&other, &options);
  for (size_t k = 0; k < UNDER_WAY; ++k) {
    boat_step(impostor, &other, 2, k);
    letter l = take_one(impostor);
    assert_int_equal(hand_over(s.a, &l), CAIRN_PACKET_CONFLICT);
    free(l.bytes);
  }
  assert_int_equal(report_of(s.a).conflict, UNDER_WAY);
  cairn_team_destroy(impostor);
  /* And a boat with this vehicle's number. */
  const cairn_team_options own = team_options(CAIRN_TEAM_JOINT, 1);
  impostor = boat_open(&other, &own);
  boat_step(impostor, &other, 1, 0);
  letter l = take_one(impostor);
  assert_int_equal(hand_over(s.a, &l), CAIRN_PACKET_CONFLICT);
  free(l.bytes);
  cairn_team_destroy(impostor);
  stage_close(&s);
}

/* Waiting packets may contradict each other, too, and the room for them is limited. */
static void packets_that_wait(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  post later = {NULL, 0, 0};
  for (size_t k = UNDER_WAY + 1; k < UNDER_WAY + 8; ++k) boat_step(s.b, &s.v, 2, k);
  (void)post_collect(&later, s.b, 0);
  assert_int_equal(later.count, 7);
  for (size_t i = 0; i < later.count; ++i)
    assert_int_equal(give(&s, later.letters[i].bytes, later.letters[i].size),
                     i < 5 ? CAIRN_PACKET_WAITING : CAIRN_PACKET_FULL);
  for (size_t i = 0; i < 5; ++i) {
    letter* l = &later.letters[i];
    assert_int_equal(give(&s, l->bytes, l->size), CAIRN_PACKET_REPEATED);
    write_real(l->bytes + AT_TIME, s.v.time[number_of(l)] + 0.5);
    seal(l->bytes, l->size);
    assert_int_equal(give(&s, l->bytes, l->size), CAIRN_PACKET_CONFLICT);
  }
  /* A new number between those of waiting packets, at a time that is not between theirs. */
  assert_int_equal(give_real(&s, AT_TIME, s.v.time[UNDER_WAY + 3]), CAIRN_PACKET_PAST);
  const cairn_team_report r = report_of(s.a);
  assert_true(r.full == 2 && r.conflict == 5 && r.repeated == 5 && r.past == 1);
  unchanged(&s);
  post_free(&later);
  cairn_team_destroy(s.a), cairn_team_destroy(s.b);
  free(s.next.bytes);
  post_free(&s.old);
  snapshot_free(&s.before), snapshot_free(&s.after);
}

/* --- content --- built by hand: [head] counts, motions of 10, sightings of 6 words */

typedef struct content {
  uint8_t bytes[4096];
  size_t size;
} content;

static void put(content* c, uint64_t value, size_t bytes) {
  assert_true(c->size + bytes <= sizeof c->bytes);
  write_number(c->bytes + c->size, value, bytes);
  c->size += bytes;
}
static void put_real(content* c, double value) {
  uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  put(c, bits, 8);
}

typedef struct sighting {
  uint64_t id;
  double values[5]; /* range, bearing, covariance 00 01 11 */
} sighting;

static int32_t give_content(stage* s, uint32_t motion_count, const double (*motion)[10], uint32_t landmark_count,
                            const sighting* landmarks, uint32_t vehicle_count, const sighting* vehicles) {
  content c;
  c.size = 0;
  memcpy(c.bytes, s->next.bytes, AT_BODY);
  c.size = AT_BODY;
  put(&c, motion_count, 4), put(&c, landmark_count, 4), put(&c, vehicle_count, 4);
  for (uint32_t i = 0; i < motion_count; ++i)
    for (int k = 0; k < 10; ++k) put_real(&c, motion[i][k]);
  for (uint32_t i = 0; i < landmark_count + vehicle_count; ++i) {
    const sighting* one = i < landmark_count ? &landmarks[i] : &vehicles[i - landmark_count];
    put(&c, one->id, 8);
    for (int k = 0; k < 5; ++k) put_real(&c, one->values[k]);
  }
  c.size += 4;
  write_number(c.bytes + AT_SIZE, c.size, 4);
  seal(c.bytes, c.size);
  return give(s, c.bytes, c.size);
}

static void nonsense_with_the_right_checksum(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  const double good_motion[10] = {5, 0.1, 0.8, 0.6, 1, 0.1, 0.01, 1, 0.02, 1e-3};
  const sighting landmarks[2] = {{1, {1000, 0.1, 100, 0.1, 1e-3}}, {2, {1000, 0.2, 0, 0, 0}}};
  const sighting vehicles[1] = {{1, {1500, 3, 0, 0, 0}}};
  double motion[1][10];
  sighting l[2], v[2];
#define RESET memcpy(motion[0], good_motion, sizeof good_motion), memcpy(l, landmarks, sizeof l), v[0] = vehicles[0]
#define NONSENSE() assert_int_equal(give_content(&s, 1, (const double(*)[10])motion, 2, l, 1, v), CAIRN_PACKET_NONSENSE)
  for (size_t n = 0; n < LENGTH(not_finite); ++n) {
    for (int k = 0; k < 10; ++k) RESET, motion[0][k] = not_finite[n], NONSENSE();
    for (int k = 0; k < 5; ++k) {
      RESET, l[0].values[k] = not_finite[n], NONSENSE();
      RESET, l[1].values[k] = not_finite[n], NONSENSE();
      RESET, v[0].values[k] = not_finite[n], NONSENSE();
    }
  }
  RESET, motion[0][2] = 0.9, NONSENSE(); /* not a rotation: the vector's length is not 1 */
  RESET, motion[0][2] = motion[0][3] = 0, NONSENSE();
  RESET, motion[0][4] = -1e-9, NONSENSE(); /* variances below zero */
  RESET, motion[0][7] = -1, NONSENSE();
  RESET, motion[0][9] = -1e-12, NONSENSE();
  RESET, motion[0][5] = 1.1, NONSENSE(); /* correlations beyond 1 */
  RESET, motion[0][6] = 0.1, NONSENSE();
  RESET, motion[0][8] = -0.1, NONSENSE();
  RESET, motion[0][4] = 0, NONSENSE(); /* covariances of a component without variance */
  RESET, motion[0][5] = 0.9, motion[0][6] = 0.9 * sqrt(1e-3), motion[0][8] = -0.9 * sqrt(1e-3), NONSENSE();
  RESET, l[0].values[0] = -1, NONSENSE(); /* ranges below zero */
  RESET, v[0].values[0] = -1e-300, NONSENSE();
  RESET, l[0].values[2] = -1, NONSENSE(); /* noise that is no covariance, or not definite */
  RESET, l[0].values[4] = 0, NONSENSE();
  RESET, l[0].values[4] = -1e-3, NONSENSE();
  RESET, l[0].values[3] = 1, NONSENSE();
  RESET, l[1].values[3] = 1e-9, NONSENSE();
  RESET, v[0].values[2] = 1, NONSENSE();
  RESET, l[1].id = 1, NONSENSE(); /* an id twice */
  RESET, v[0].id = 2, NONSENSE(); /* itself */
  RESET, v[0].id = CAIRN_ID_NONE, NONSENSE();
  RESET, v[1] = v[0];
  assert_int_equal(give_content(&s, 0, NULL, 0, NULL, 2, v), CAIRN_PACKET_NONSENSE);
#undef NONSENSE
  unchanged(&s);
  const cairn_team_report r = report_of(s.a);
  assert_int_equal(r.nonsense, 3 * 25 + 22);
  assert_int_equal(r.taken, UNDER_WAY);
  /* The unchanged packet is accepted, so that each of the others was refused because of its content. */
  RESET;
  assert_int_equal(give_content(&s, 1, (const double(*)[10])motion, 2, l, 1, v), CAIRN_PACKET_TAKEN);
#undef RESET
  cairn_team_destroy(s.a), cairn_team_destroy(s.b);
  free(s.next.bytes);
  post_free(&s.old);
  snapshot_free(&s.before), snapshot_free(&s.after);
}

/* Landmarks without an id although ids are used. */
static void nameless_landmarks(void** state) {
  stage s;
  const sighting l[1] = {{CAIRN_ID_NONE, {1000, 0.1, 0, 0, 0}}};
  size_t before = 0, after = 0;
  (void)state;
  stage_open(&s);
  assert_ok(cairn_map_size(cairn_team_map(s.a), &before, NULL));
  const int32_t result = give_content(&s, 0, NULL, 1, l, 0, NULL);
  assert_ok(cairn_map_size(cairn_team_map(s.a), &after, NULL));
  assert_int_equal(before, after); /* no landmark may have this id */
  cairn_landmark landmark;
  assert_status(cairn_map_landmark(cairn_team_map(s.a), CAIRN_ID_NONE, &landmark, NULL), CAIRN_ERROR_NOT_FOUND);
  assert_true(result == CAIRN_PACKET_NONSENSE || report_of(s.a).failed > 0);
  cairn_team_destroy(s.a), cairn_team_destroy(s.b);
  free(s.next.bytes);
  post_free(&s.old);
  snapshot_free(&s.before), snapshot_free(&s.after);
}

/* Counts that are larger than the packet, up to values that would overflow a product. */
static void counts_that_lie(void** state) {
  stage s;
  (void)state;
  stage_open(&s);
  const uint64_t lies[] = {0, 1, 7, 65535, 65536, 0x7fffffff, 0x80000000, 0xffffffff};
  for (size_t n = 0; n < LENGTH(lies); ++n)
    for (size_t at = 0; at < 3; ++at) {
      if (read_number(s.next.bytes + AT_BODY + 4 * at, 4) == lies[n]) continue;
      assert_int_equal(give_changed(&s, AT_BODY + 4 * at, lies[n], 4), CAIRN_PACKET_NONSENSE);
    }
  stage_close(&s);
}

/* Requests for packets, reasonable or not, never change the estimate. The answer contains the kept packets. */
static void requests(void** state) {
  const uint64_t from[] = {0, 2, UNDER_WAY, UNDER_WAY + 1, UINT64_MAX}, counts[] = {0, 1, 3, UINT64_MAX};
  stage s;
  (void)state;
  stage_open(&s);
  for (size_t f = 0; f < LENGTH(from); ++f)
    for (size_t n = 0; n < LENGTH(counts); ++n)
      for (uint64_t subject = 1; subject <= 2; ++subject)
        for (uint64_t sender = 2; sender <= 3; ++sender) {
          content c;
          post answers = {NULL, 0, 0};
          memcpy(c.bytes, s.next.bytes, AT_BODY);
          write_number(c.bytes + AT_KIND, REQUEST, 2);
          write_number(c.bytes + AT_VEHICLE, sender, 8);
          c.size = AT_BODY;
          put(&c, subject, 8), put(&c, from[f], 8), put(&c, counts[n], 8);
          c.size += 4;
          write_number(c.bytes + AT_SIZE, c.size, 4);
          seal(c.bytes, c.size);
          const bool for_it = subject == 1 && sender == 2;
          assert_int_equal(give(&s, c.bytes, c.size), for_it ? CAIRN_PACKET_REQUEST : CAIRN_PACKET_IGNORED);
          const size_t there = from[f] > UNDER_WAY ? 0 : UNDER_WAY + 1 - from[f];
          const size_t expected = !for_it ? 0 : counts[n] == 0 || counts[n] > there ? there : counts[n];
          assert_int_equal(post_collect(&answers, s.a, 0), expected);
          for (size_t i = 0; i < answers.count; ++i) assert_int_equal(number_of(&answers.letters[i]), from[f] + i);
          post_free(&answers);
        }
  stage_close(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(packets_cut_short),
      cmocka_unit_test(every_byte_flipped),
      cmocka_unit_test(foreign_bytes),
      cmocka_unit_test(heads_that_do_not_fit),
      cmocka_unit_test(two_vehicles_of_one_number),
      cmocka_unit_test(packets_that_wait),
      cmocka_unit_test(nonsense_with_the_right_checksum),
      cmocka_unit_test(nameless_landmarks),
      cmocka_unit_test(counts_that_lie),
      cmocka_unit_test(requests),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
