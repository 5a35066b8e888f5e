/* SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L /* clock_gettime, nanosleep */
#include "radio.h"

#include <mosquitto.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST_DELAY_MS = 20, KEEP_ALIVE_S = 30, RETRY_MS = 50 };

/* A packet that is held back. */
typedef struct held {
  struct held* next;
  double due;
  size_t size;
  uint8_t packet[];
} held;

struct radio {
  struct mosquitto* mqtt;
  uint64_t vehicle, vehicles;
  double loss;
  uint64_t random;
  radio_handler handler;
  void* user;
  int connected;
  int done_mid; /* id of this boat's "done" message, once it was sent */
  int done_sent;
  unsigned char* done; /* by vehicle - 1 */
  held* waiting;
  radio_counts counts;
};

double radio_now(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void nap(long milliseconds) {
  const struct timespec time = {milliseconds / 1000, milliseconds % 1000 * 1000000};
  nanosleep(&time, NULL);
}

/* In [0, 1), by SplitMix64. */
static double draw(radio* r) {
  uint64_t z = r->random += 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return (double)((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
}

static void hold(radio* r, const uint8_t* packet, size_t size) {
  held* h = malloc(sizeof *h + size);
  if (!h) return; /* the packet is lost */
  h->due = radio_now() + 1e-3 * MOST_DELAY_MS * draw(r);
  h->size = size;
  memcpy(h->packet, packet, size);
  h->next = r->waiting;
  r->waiting = h;
}

static void hand_on_held(radio* r, double now) {
  for (held** at = &r->waiting; *at;) {
    held* h = *at;
    if (h->due > now) {
      at = &h->next;
      continue;
    }
    *at = h->next;
    r->handler(r->user, h->packet, h->size);
    free(h);
  }
}

static void on_message(struct mosquitto* mqtt, void* object, const struct mosquitto_message* message) {
  radio* r = object;
  unsigned long long vehicle = 0;
  (void)mqtt;
  if (sscanf(message->topic, "cairn/done/%llu", &vehicle) == 1) {
    if (vehicle >= 1 && vehicle <= r->vehicles) r->done[vehicle - 1] = 1;
    return;
  }
  const uint8_t* packet = message->payload;
  const size_t size = (size_t)message->payloadlen;
  /* Always three draws for each packet, so that a larger loss only adds faults. */
  const int dropped = draw(r) < r->loss, delayed = draw(r) < r->loss / 2, doubled = draw(r) < r->loss / 2;
  if (dropped) {
    ++r->counts.dropped;
    return;
  }
  if (doubled) {
    ++r->counts.doubled;
    hold(r, packet, size);
  }
  if (delayed) {
    ++r->counts.delayed;
    hold(r, packet, size);
  } else {
    r->handler(r->user, packet, size);
  }
}

/* Subscribes again after every connection, because the broker forgets subscriptions. */
static void on_connect(struct mosquitto* mqtt, void* object, int refused) {
  radio* r = object;
  if (refused) return;
  r->connected = 1;
  for (uint64_t other = 1; other <= r->vehicles; ++other) {
    char topic[64];
    if (other == r->vehicle) continue; /* the broker would send own packets back */
    snprintf(topic, sizeof topic, "cairn/team/%llu", (unsigned long long)other);
    mosquitto_subscribe(mqtt, NULL, topic, 0);
    snprintf(topic, sizeof topic, "cairn/done/%llu", (unsigned long long)other);
    mosquitto_subscribe(mqtt, NULL, topic, 1);
  }
}

static void on_disconnect(struct mosquitto* mqtt, void* object, int reason) {
  radio* r = object;
  (void)mqtt;
  (void)reason;
  r->connected = 0;
}

static void on_publish(struct mosquitto* mqtt, void* object, int mid) {
  radio* r = object;
  (void)mqtt;
  if (r->done_sent && mid == r->done_mid) r->done[r->vehicle - 1] = 1;
}

radio* radio_open(uint64_t vehicle, uint64_t vehicles, int port, double loss, uint64_t seed, radio_handler handler,
                  void* user) {
  radio* r = calloc(1, sizeof *r);
  if (!r) return NULL;
  signal(SIGPIPE, SIG_IGN); /* the program must survive a broker that stops */
  mosquitto_lib_init();
  r->vehicle = vehicle;
  r->vehicles = vehicles;
  r->loss = loss;
  r->random = seed * 1000003u + vehicle;
  r->handler = handler;
  r->user = user;
  r->done = calloc(vehicles, 1);
  r->mqtt = mosquitto_new(NULL, true, r);
  if (!r->done || !r->mqtt) {
    radio_close(r);
    return NULL;
  }
  mosquitto_int_option(r->mqtt, MOSQ_OPT_TCP_NODELAY, 1);
  mosquitto_connect_callback_set(r->mqtt, on_connect);
  mosquitto_disconnect_callback_set(r->mqtt, on_disconnect);
  mosquitto_message_callback_set(r->mqtt, on_message);
  mosquitto_publish_callback_set(r->mqtt, on_publish);
  mosquitto_connect(r->mqtt, "127.0.0.1", port, KEEP_ALIVE_S); /* if it fails, radio_listen tries again */
  return r;
}

void radio_close(radio* r) {
  if (!r) return;
  if (r->mqtt) {
    mosquitto_disconnect(r->mqtt);
    mosquitto_loop(r->mqtt, 1, 1); /* sends the last message */
    mosquitto_destroy(r->mqtt);
  }
  while (r->waiting) {
    held* h = r->waiting;
    r->waiting = h->next;
    free(h);
  }
  free(r->done);
  free(r);
  mosquitto_lib_cleanup();
}

void radio_send(radio* r, const uint8_t* packet, size_t size) {
  char topic[64];
  snprintf(topic, sizeof topic, "cairn/team/%llu", (unsigned long long)r->vehicle);
  if (mosquitto_publish(r->mqtt, NULL, topic, (int)size, packet, 0, false) == MOSQ_ERR_SUCCESS) ++r->counts.published;
}

void radio_listen(radio* r) {
  if (mosquitto_loop(r->mqtt, 1, 1) != MOSQ_ERR_SUCCESS) {
    r->connected = 0;
    nap(RETRY_MS);
    mosquitto_reconnect(r->mqtt);
  }
  hand_on_held(r, radio_now());
}

void radio_say_done(radio* r) {
  char topic[64];
  if (r->done_sent || !r->connected) return;
  snprintf(topic, sizeof topic, "cairn/done/%llu", (unsigned long long)r->vehicle);
  /* QoS 1 and retained: the message arrives, and boats that start later get it, too. */
  r->done_sent = mosquitto_publish(r->mqtt, &r->done_mid, topic, 4, "done", 1, true) == MOSQ_ERR_SUCCESS;
}

uint64_t radio_busy(const radio* r) {
  uint64_t busy = 0;
  for (uint64_t i = 0; i < r->vehicles; ++i) busy += !r->done[i];
  return busy;
}

int radio_is_busy(const radio* r, uint64_t vehicle) {
  return !r->done[vehicle - 1];
}

int radio_is_connected(const radio* r) {
  return r->connected;
}

radio_counts radio_counted(const radio* r) {
  return r->counts;
}
