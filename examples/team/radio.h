/* SPDX-License-Identifier: BSD-3-Clause */
/* The radio of a boat: MQTT with artificial faults. Packets are sent by QoS 0, without acknowledgement, because the
 * team itself handles lost packets. The boats also tell each other that they are done, by retained messages without
 * faults. */
#ifndef RADIO_H
#define RADIO_H

#include <stddef.h>
#include <stdint.h>

typedef struct radio radio;

/* Gets every packet that arrives. */
typedef void (*radio_handler)(void *user, const uint8_t *packet, size_t size);

typedef struct radio_counts {
  uint64_t published; /* packets given to the broker */
  uint64_t dropped;   /* packets that arrived and were dropped */
  uint64_t delayed;   /* ... that were held back until later ones had arrived */
  uint64_t doubled;   /* ... that were passed on twice */
} radio_counts;

/* Boats are numbered from 1 to `vehicles`. The share `loss` of all arriving packets is dropped, half as many are
 * delayed, and half as many are doubled. Returns NULL if there is not enough memory. Neither the other boats nor the
 * broker need to run yet. */
radio *radio_open(uint64_t vehicle, uint64_t vehicles, int port, double loss, uint64_t seed, radio_handler handler,
                  void *user);
void radio_close(radio *r);

/* Sends a packet to all others. While there is no broker the packet is lost. */
void radio_send(radio *r, const uint8_t *packet, size_t size);

/* Waits at most a millisecond for packets and passes them to the handler. */
void radio_listen(radio *r);

/* Tells all others that this boat is done. It may be called repeatedly. */
void radio_say_done(radio *r);

/* Number of boats that are not known to be done. This boat counts until the broker has its message. */
uint64_t radio_busy(const radio *r);
int radio_is_busy(const radio *r, uint64_t vehicle);
int radio_is_connected(const radio *r);

radio_counts radio_counted(const radio *r);

/* Seconds of a monotonic clock. */
double radio_now(void);

#endif
