/* SPDX-License-Identifier: BSD-3-Clause */
/* The filters that api_fuzz calls: random creation, random sensors, and the checks of their state. */
#ifndef CAIRN_TESTS_FUZZ_FILTERS_H
#define CAIRN_TESTS_FUZZ_FILTERS_H

#include "fuzz.h"

typedef struct slot {
  cairn_filter* filter;
  bool wild, planar;
  bool fixed; /* an absolute observation was given */
  uint32_t max_landmarks, max_observations;
  int32_t sensors;
  uint32_t rows[64]; /* number of values of an observation, by sensor */
} slot;

extern slot* now;                                        /* the slot of the current call */
extern bool loose;                                       /* do not check the numbers of wild filters */
extern unsigned long long states_without_positive_pivot; /* of wild filters */

#define HOLDS_OF_NUMBERS(s, condition, value)              \
  do {                                                     \
    if (!loose || !(s)->wild) HOLDS((condition), (value)); \
  } while (0)
void check_numbers(const slot* s, const double* values, size_t count);
/* Conditions that a filter must meet after any call. `whole` checks all landmarks and the covariance too. */
void check_state(const slot* s, bool whole);

/* Mostly good ids and sensor numbers of the current filter. */
uint64_t random_id(void);
int32_t random_sensor(void);

/* Creates a filter with random options in `s`. If the creation fails, the old filter stays. */
void create_filter(slot* s);
void add_sensor(slot* s);

#endif
