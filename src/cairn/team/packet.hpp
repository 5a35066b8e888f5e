// SPDX-License-Identifier: BSD-3-Clause
// Packets: the messages between the vehicles of a team, as bytes that any transport may carry. Little-endian;
// docs/team.md has the layout.
#pragma once

#include <cstdint>
#include <vector>

#include "motion/motion.hpp"
#include "slam/filter.hpp"

namespace cairn {

enum class PacketKind : std::uint16_t {
  data = 1,     // one step of the sender: its motions since its last packet, then what it saw
  request = 2,  // the sender misses packets of `subject`: `count` from number `first` on, 0: all from there
  leave = 3     // the sender's farewell; its number follows that of its last step
};

struct Packet {
  PacketKind kind = PacketKind::data;
  std::uint64_t vehicle = 0;  // the sender
  std::uint64_t number = 0;   // counted by the sender from 0; `vehicle` and `number` name the packet
  double time = 0.0;          // s
  std::vector<Increment<SE2>> motions;
  std::vector<Observation> landmarks;  // range and bearing, as measured
  std::vector<Observation> vehicles;   // sightings of other vehicles, likewise
  std::uint64_t subject = 0, first = 0, count = 0;
  std::uint32_t checksum = 0;  // of the bytes that it was decoded from
};

enum class PacketFault {
  none,
  foreign,    // these bytes are no packet
  version,    // this library does not read its version
  short_cut,  // bytes are missing, or there are too many
  checksum,
  content  // complete, but not a valid step: a value is not finite, noise is no covariance, a name comes twice
};

constexpr std::uint16_t kPacketVersion = 1;
constexpr std::size_t kMostOfPacket = 65535;  // motions in one packet; likewise landmarks, vehicles
constexpr std::size_t kRequestSize = 64;      // bytes

// Greater numbers are mistakes, not measurements. Inside these limits no product of a filter's numbers overflows. A
// range may be any number: a range beyond kFarthest is no sighting, and only this sighting is not used.
constexpr double kFarthest = 1e9;       // m, of a motion, of a sighting and of a motion's noise
constexpr double kLargestTurn = 100.0;  // rad, of a motion's noise; a filter refuses less
constexpr double kLeastVariance = 1e-100, kLargestVariance = 1e100;  // of a sighting

// Whether a motion is one: finite, inside the limits, and its noise is a covariance.
bool is_motion(const Increment<SE2>& motion);

// The first writes into `out`; it allocates nothing if the capacity of `out` is large enough.
void encode(const Packet& packet, std::vector<std::uint8_t>& out);
std::vector<std::uint8_t> encode(const Packet& packet);
// Writes `packet` only if the answer is `none`.
PacketFault decode(const std::uint8_t* bytes, std::size_t size, Packet& packet);

// Whether two observations have the same id, and which id that is. Observations without an id do not count.
bool named_twice(const std::vector<Observation>& observations, std::uint64_t& name);

// CRC-32 as in ISO 3309 (reflected, polynomial 0xEDB88320).
std::uint32_t crc32(const std::uint8_t* bytes, std::size_t size);

}  // namespace cairn
