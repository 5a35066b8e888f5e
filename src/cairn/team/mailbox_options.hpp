// SPDX-License-Identifier: BSD-3-Clause
// The options of a mailbox.
#pragma once

#include <cstddef>
#include <cstdint>

namespace cairn {

struct MailboxOptions {
  std::uint64_t vehicle = 0;       // this vehicle's number
  std::size_t max_vehicles = 8;    // this vehicle among them
  std::size_t max_waiting = 4096;  // packets of one teammate that may wait for their turn
  std::size_t history = 1024;      // own packets that are kept for teammates that miss them
  double max_lag = 30.0;           // s: how long to wait for a teammate's missing packet
  double max_jump = 60.0;        // s: a step that follows the one before it by more has to be confirmed by the next one
  double time_tolerance = 0.01;  // s: packets that differ by no more count as of one time
  bool listens = true;           // teammates' packets are used
  bool named = true;             // landmarks have ids: a packet with a landmark without an id is refused
};

}  // namespace cairn
