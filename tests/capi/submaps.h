/* SPDX-License-Identifier: BSD-3-Clause */
/* Shared by the tests of submaps: a ring of landmarks that a vehicle drives around while it sees only near ones, and
 * snapshots of everything that a filter with submaps tells. */
#ifndef CAIRN_TESTS_CAPI_SUBMAPS_H
#define CAIRN_TESTS_CAPI_SUBMAPS_H

#include "support.h"

#define RING_LANDMARKS 24
#define RING_STEPS 60 /* of one lap */
#define RING_SEEN 8   /* the most landmarks of one frame */

typedef struct ring {
  generator random;
  cairn_pose truth; /* of the body in the map */
  unsigned step;
} ring;

typedef struct ring_frame {
  cairn_pose increment;
  double covariance[36];
  cairn_observation seen[RING_SEEN]; /* by a cartesian sensor at the body; landmark i has the id i + 1 */
  size_t count;
} ring_frame;

void ring_init(ring* r, uint64_t seed);
void ring_landmark(unsigned i, double point[3]);
void ring_next(ring* r, ring_frame* f);
/* Submaps of `landmarks`, room for the ring, gates that accept ordinary noise, a moderate start covariance. */
cairn_filter_options ring_options(const ring* r, uint32_t landmarks, int32_t join);
/* A filter with the cartesian sensor as number 0. */
cairn_filter* ring_filter(const cairn_filter_options* options);
cairn_status ring_take(cairn_filter* filter, const ring_frame* f);
/* Drives `count` filters with the same next steps of the ring. */
void ring_drive(ring* r, cairn_filter* const* filters, size_t count, unsigned steps);

/* Report of the last closing. */
cairn_closing_report last_closing(const cairn_filter* filter);

/* Everything that a filter tells about its submaps and about its map, as bytes. */
void submaps_take(snapshot* s, const cairn_filter* filter); /* frees what `s` held */

#endif
