// SPDX-License-Identifier: BSD-3-Clause
// A vehicle's view of its team. The mailbox gives out packets in an order that all vehicles agree on, and these packets
// update the filters of the chosen way of cooperating (docs/team.md).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "team/cooperation.hpp"
#include "team/mailbox.hpp"
#include "team/team_options.hpp"

namespace cairn {

class Team {
 public:
  explicit Team(const TeamOptions& options);
  const TeamOptions& options() const { return options_; }

  // --- members --- each throws with nothing changed
  void add(std::uint64_t vehicle);  // its start is solved from mutual sightings
  void add(std::uint64_t vehicle, const SE2& start, const Matrix3& covariance);
  void remove(std::uint64_t vehicle);
  std::vector<std::uint64_t> members() const { return mailbox_.members(); }  // this vehicle first

  // --- this vehicle --- each throws with nothing changed, and nothing sent
  void propagate(const Increment<SE2>& increment) { mailbox_.move(increment); }
  // Ends a step with the observations at `time`: the step becomes a packet, and all turns that are due are taken. If
  // the filter refuses this vehicle's scan, the reason is returned; the packet is sent to the team all the same.
  std::optional<Error> observe(double time, std::vector<Observation> landmarks, std::vector<Observation> vehicles);
  void leave();

  // --- packets ---
  // The next packet to be sent; null if there is none.
  const std::vector<std::uint8_t>* next_packet() const { return mailbox_.next_packet(); }
  void drop_packet() noexcept { mailbox_.drop_packet(); }
  // Throws with nothing changed.
  Arrival receive(const std::uint8_t* bytes, std::size_t size, PacketFault& fault);
  void ask();  // for all packets that are missing

  // --- queries ---
  // This vehicle's pose is the current one: it includes this vehicle's motions that no turn has taken yet.
  VehicleEstimate estimate(std::uint64_t vehicle) const;
  // Normalised error squared of this vehicle's pose; negative if its covariance is singular.
  double pose_nees(const SE2& truth) const;
  const Landmarks& landmarks() const { return cooperation_->filter().landmarks(); }
  const std::vector<Match>& matches() const {
    return cooperation_->matches();
  }                               // of this vehicle's scan that was taken last
  std::size_t unsettled() const;  // own steps that wait for teammates' packets
  const MailCounts& mail_counts() const { return mailbox_.counts(); }
  const ScanCounts& scan_counts() const { return cooperation_->counts(); }
  bool interrupted() const { return interrupted_; }  // memory ran out in a turn; the next call goes on with it

 private:
  void finish_turn();          // throws if there is still no memory
  void take_turns() noexcept;  // all that are due
  const Packet* untaken_own_step() const;

  TeamOptions options_;
  Mailbox mailbox_;
  std::unique_ptr<Cooperation> cooperation_;
  std::vector<Packet> packets_;  // of the turn
  bool interrupted_ = false;
  bool asking_ = false;  // a step of this vehicle asks for missing packets when all turns are taken
};

}  // namespace cairn
