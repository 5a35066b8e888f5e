// SPDX-License-Identifier: BSD-3-Clause
// What vehicles of a team tell each other, as bytes that any transport may carry. Little-endian; docs/team.md has the
// layout.
#pragma once

#include <cstdint>
#include <vector>

#include "motion/motion.hpp"
#include "slam/filter.hpp"

namespace cairn {

enum class PacketKind : std::uint16_t {
  data = 1,     // one step of the sender: how it moved since its last packet, then what it saw
  request = 2,  // packets of `subject` that the sender misses: `count` from `first` on, 0: all from there
  leave = 3     // the sender's last one; its number follows that of its last data
};

struct Packet {
  PacketKind kind = PacketKind::data;
  std::uint64_t vehicle = 0;  // the sender
  std::uint64_t number = 0;   // counted by the sender from 0: with `vehicle` the name of this datum
  double time = 0.0;          // s
  std::vector<Increment<SE2>> motions;
  std::vector<Observation> landmarks;  // range and bearing, raw
  std::vector<Observation> vehicles;   // the same of other vehicles
  std::uint64_t subject = 0, first = 0, count = 0;
  std::uint32_t checksum = 0;  // that it came with
};

enum class PacketFault {
  none,
  foreign,    // no packet of Cairn
  version,    // of a version that this library does not read
  short_cut,  // bytes are missing, or there are too many
  checksum,
  content  // whole, and yet no step of a vehicle: values not finite, no covariance, a name twice
};

constexpr std::uint16_t kPacketVersion = 1;
constexpr std::size_t kMostOfPacket = 65535;  // motions, landmarks, vehicles

std::vector<std::uint8_t> encode(const Packet& packet);
// `packet` is written where the answer is none.
PacketFault decode(const std::uint8_t* bytes, std::size_t size, Packet& packet);

// Whether two of them have one name, and which; those without a name do not count.
bool named_twice(const std::vector<Observation>& observations, std::uint64_t& name);

// CRC-32 as in ISO 3309 (reflected, polynomial 0xEDB88320).
std::uint32_t crc32(const std::uint8_t* bytes, std::size_t size);

}  // namespace cairn
