// SPDX-License-Identifier: BSD-3-Clause
// The packets of one vehicle of the team, in the order of their numbers: which one is next, which ones wait, and enough
// of those that were consumed to recognise a repetition.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>

#include "team/packet.hpp"

namespace cairn {

// The outcome of a packet that arrived.
enum class Arrival { taken, waiting, request, leave, repeated, own, unknown, past, conflict, ignored, full, refused };

class Member {
 public:
  explicit Member(std::uint64_t id) : id_(id) {}

  std::uint64_t id() const { return id_; }
  std::uint64_t next() const { return next_; }          // number of the packet to be consumed next
  std::uint64_t end() const { return next_ + size(); }  // next free number, if no packet is missing
  bool started() const { return started_; }             // a packet was consumed
  bool left() const { return left_; }                   // its farewell was consumed
  double time() const { return time_; }                 // of the packet that was consumed last

  // --- packets that wait ---
  std::size_t size() const { return waiting_.size(); }
  bool empty() const { return waiting_.empty(); }
  const std::map<std::uint64_t, Packet>& waiting() const { return waiting_; }
  const Packet& first() const { return waiting_.begin()->second; }  // there has to be one
  bool ready() const { return waiting_.count(next_) != 0; }         // the next packet is here
  bool has_gap() const { return !waiting_.empty() && !ready(); }
  std::uint64_t gap() const { return waiting_.begin()->first - next_; }  // number of packets that are missing

  // Sorts a packet in that arrived; `waiting`, or the reason against it. `late`: a packet with a higher number already
  // waits.
  Arrival insert(Packet&& packet, std::size_t capacity, bool& late);
  // Adds this vehicle's newest packet, which has the number end().
  void append(Packet&& packet);
  // Removes the next packet, which has to be here, and counts it as consumed.
  Packet consume();
  // Gives up the packets that are missing before the first one that waits.
  void skip_gap();

  // The time since when this vehicle waits for the member: the time of the member's last packet or, if it sent none,
  // `now` of the first call.
  double silent_since(double now);

  // --- membership ---
  void forget_waiting() { waiting_.clear(); }
  void rejoin() { left_ = false; }

 private:
  bool repeats(const Packet& packet) const;
  bool fits_in_time(const Packet& packet) const;

  std::uint64_t id_;
  std::uint64_t next_ = 0;
  bool started_ = false;
  bool left_ = false;
  double time_ = 0.0;
  std::optional<double> waited_from_;         // if nothing ever arrived: time of this vehicle's step that waited first
  std::map<std::uint64_t, Packet> waiting_;   // by number; none below next_
  std::deque<std::uint32_t> last_checksums_;  // of the packets that were consumed last
};

}  // namespace cairn
