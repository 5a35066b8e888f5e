/* SPDX-License-Identifier: BSD-3-Clause */
/* The boats' radio: MQTT, made as bad as asked for. Packets go out by QoS 0, unacknowledged: what is lost is the team's
 * own business. Besides, boats tell each other that they are done, by retained messages that nothing happens to. */
#ifndef RADIO_H
#define RADIO_H

#include <stddef.h>
#include <stdint.h>

typedef struct radio radio;

/* Gets every packet that comes through. */
typedef void (*radio_handler)(void *user, const uint8_t *packet, size_t size);

typedef struct radio_counts {
  uint64_t published; /* packets given to the broker */
  uint64_t dropped;   /* packets that came and were thrown away */
  uint64_t delayed;   /* ... held back until later ones had come */
  uint64_t doubled;   /* ... handed on twice */
} radio_counts;

/* Boats are numbered from 1 to `vehicles`. Of what comes in, the share `loss` is dropped, half as much is delayed and
 * half as much is doubled. NULL where memory is short. Nobody needs to be there yet, not even the broker. */
radio *radio_open(uint64_t vehicle, uint64_t vehicles, int port, double loss, uint64_t seed, radio_handler handler,
                  void *user);
void radio_close(radio *r);

/* To all others. Not while the broker is away: such a packet is one more that is lost. */
void radio_send(radio *r, const uint8_t *packet, size_t size);

/* Waits a millisecond at most for something to come, and hands it on. */
void radio_listen(radio *r);

/* Tells all others that this boat is done; again and again is no harm. */
void radio_say_done(radio *r);

/* How many boats are not known to be done, the own among them until the broker has it. */
uint64_t radio_busy(const radio *r);
int radio_is_busy(const radio *r, uint64_t vehicle);
int radio_is_connected(const radio *r);

radio_counts radio_counted(const radio *r);

/* Seconds of a clock that never goes back. */
double radio_now(void);

#endif
