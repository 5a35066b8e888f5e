// SPDX-License-Identifier: BSD-3-Clause
// A vehicle's mailbox: its own steps become packets, its teammates' packets wait for their turn, and all packets of one
// time come out together, in an order that is the same at every vehicle. The mailbox handles packets and does not know
// filters.
#pragma once

#include <list>
#include <optional>
#include <vector>

#include "team/history.hpp"
#include "team/mailbox_options.hpp"
#include "team/member.hpp"
#include "team/outbox.hpp"
#include "team/packet.hpp"

namespace cairn {

struct MailCounts {
  std::uint64_t sent = 0, resent = 0, requested = 0;
  // Packets that arrived, by what became of them; `faulty` by PacketFault.
  std::uint64_t received = 0, taken = 0, reordered = 0, repeated = 0, own = 0, unknown = 0, past = 0, ahead = 0,
                conflict = 0, ignored = 0, full = 0, faulty[6] = {};
  std::uint64_t lost = 0;  // packets that were given up after max_lag
};

// A packet that was stored: sender and number are its name.
struct PacketName {
  std::uint64_t vehicle = 0, number = 0;
  PacketKind kind = PacketKind::data;
};

class Mailbox {
 public:
  explicit Mailbox(const MailboxOptions& options);

  // Everything that allocates comes before the first change of a call. Turns and requests allocate nothing.

  // --- members --- each throws with nothing changed
  void add(std::uint64_t vehicle);
  void undo_add() noexcept { members_.pop_back(); }  // of the member that was added last, before anything else happened
  void remove(std::uint64_t vehicle);
  std::vector<std::uint64_t> members() const;  // this vehicle first

  // --- this vehicle --- each throws with nothing changed
  void move(const Increment<SE2>& increment);
  // Ends a step: the motions since the last step and the observations become a packet.
  void observe(double time, std::vector<Observation> landmarks, std::vector<Observation> vehicles);
  void leave();
  std::size_t unsettled() const { return members_.front().size(); }  // own steps that wait for teammates' packets
  // This vehicle's motions that no turn has given out yet, in their order.
  template <class Function>
  void for_each_unsettled_motion(Function&& function) const {
    for (const auto& entry : members_.front().waiting())
      for (const Increment<SE2>& motion : entry.second.motions) function(motion);
    for (const Increment<SE2>& motion : pending_) function(motion);
  }

  // --- packets to be sent ---
  // The next one; null if there is none.
  const std::vector<std::uint8_t>* next_packet() const { return outbox_.next(); }
  void drop_packet() noexcept { outbox_.drop(history_); }
  void ask() noexcept;             // for all packets that are missing
  void ask_if_missing() noexcept;  // the same, but only if a gap or a waiting own step shows that something is missing

  // --- packets that arrive ---
  // `waiting` if the packet was stored under `name`: then turns may be due, and outcome() returns the packet's
  // outcome. Throws with nothing changed.
  Arrival receive(const std::uint8_t* bytes, std::size_t size, PacketFault& fault, PacketName& name);
  Arrival outcome(const PacketName& name);

  // --- turns ---
  // Gives up the packets of one teammate for which the mailbox waited in vain. Returns the teammate's number, or
  // nothing if no gap is overdue. To be called until it returns nothing, before next_turn().
  std::optional<std::uint64_t> skip_overdue_gap() noexcept;
  // Moves the packets of the earliest time into `packets`, ordered by the vehicles' numbers, without farewells. Returns
  // false if the mailbox has to wait for a teammate, or if no packet waits. `packets` has the capacity max_vehicles.
  bool next_turn(std::vector<Packet>& packets) noexcept;
  // Removes one vehicle whose farewell was consumed. Returns its number, or nothing if there is none. To be called
  // until it returns nothing, after each turn.
  std::optional<std::uint64_t> remove_departed() noexcept;

  const MailCounts& counts() const { return counts_; }

 private:
  // The state of a member for the next turn: its next packet can be taken, the turn does not need the member, the turn
  // waits for the member, or the member's gap is overdue.
  enum class Readiness { ready, idle, awaited, overdue_gap };

  Member* find(std::uint64_t vehicle);
  Member& own() { return members_.front(); }
  const Member& own() const { return members_.front(); }
  bool is_own(const Member& member) const { return &member == &members_.front(); }
  void drop(std::list<Member>::iterator member) noexcept;
  Readiness readiness(Member& member) noexcept;
  bool looked() const { return own().started() || !own().empty(); }  // this vehicle made a step
  void check_time(double time);
  Arrival count(Arrival arrival) noexcept;
  Arrival answer(const Packet& request) noexcept;

  MailboxOptions options_;
  std::list<Member> members_;            // this vehicle first
  std::list<Member> former_;             // removed or left: packets that were consumed once are not taken again
  std::vector<Member*> turns_;           // scratch
  std::vector<Increment<SE2>> pending_;  // own motions since the last packet
  double newest_ = 0.0;                  // time of the newest own step
  std::optional<double> refused_time_;   // of an own step that came too far ahead
  bool left_ = false;                    // this vehicle sent its farewell
  History history_;                      // own packets
  Outbox outbox_;
  MailCounts counts_;
};

}  // namespace cairn
