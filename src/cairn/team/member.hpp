// SPDX-License-Identifier: BSD-3-Clause
// The packets of one vehicle of the team, in the order of their numbers: which one is next, which ones wait, and enough
// of those that were consumed to recognise a repetition.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>

#include "team/packet.hpp"

namespace cairn {

// The outcome of a packet that arrived.
enum class Arrival {
  taken,
  waiting,
  request,
  leave,
  repeated,
  own,
  unknown,
  past,
  ahead,
  conflict,
  ignored,
  full,
  refused
};

// Limits of the packets that wait.
struct WaitingLimits {
  std::size_t packets;   // that wait at most
  double max_jump;       // s, by which a packet may follow the one before it
  const double* newest;  // time of this vehicle's last step; null: it made none
};

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

  // A packet that does not wait yet. Only its creation allocates.
  class Entry {
   public:
    explicit Entry(Packet&& packet) {
      const std::uint64_t number = packet.number;
      one_.emplace(number, std::move(packet));
    }
    const Packet& packet() const { return one_.begin()->second; }

   private:
    friend class Member;
    std::map<std::uint64_t, Packet> one_;
  };
  // Sorts a packet in that arrived; `waiting`, or the reason against it. `late`: a packet with a higher number already
  // waits. Never throws.
  Arrival insert(Entry&& entry, const WaitingLimits& limits, bool& late) noexcept;
  // Adds this vehicle's newest packet, which has the number end(). Never throws.
  void append(Entry&& entry) noexcept;
  // Removes the next packet, which has to be here, and counts it as consumed. Never throws.
  Packet consume() noexcept;
  // Gives up the packets that are missing before the first one that waits.
  void skip_gap();

  // The time since when this vehicle waits for the member: the time of the member's last packet or, if it sent none,
  // `now` of the first call.
  double silent_since(double now);

  // --- membership ---
  void forget_waiting() {
    waiting_.clear();
    suspect_.reset();
  }
  void rejoin() { left_ = false; }

 private:
  bool repeats(const Packet& packet) const;
  bool fits_after(const Packet& packet, double time) const;
  bool fits_before(const Packet& packet, const Packet& later) const;
  Arrival judge_time(const Packet& packet, const WaitingLimits& limits) noexcept;
  bool agrees_with_suspect(const Packet& packet, double max_jump) const;
  void forget_waiting_before(const Packet& packet) noexcept;

  std::uint64_t id_;
  std::uint64_t next_ = 0;
  bool started_ = false;
  bool left_ = false;
  double time_ = 0.0;
  std::optional<double> waited_from_;        // if nothing ever arrived: time of this vehicle's step that waited first
  std::map<std::uint64_t, Packet> waiting_;  // by number; none below next_
  // The last packet that was refused because of its time. The next one decides which time was wrong.
  struct Suspect {
    std::uint64_t number;
    double time;
  };
  std::optional<Suspect> suspect_;
  // Checksums of the packets that were consumed last, each in the place of its number.
  static constexpr std::size_t kChecksums = 256;
  std::array<std::uint32_t, kChecksums> checksums_{};
  std::size_t kept_ = 0;
};

}  // namespace cairn
