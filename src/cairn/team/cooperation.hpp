// SPDX-License-Identifier: BSD-3-Clause
// A way of cooperating: the filters that a vehicle runs, and how its teammates' packets update them (docs/team.md).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "team/packet.hpp"
#include "team/team_options.hpp"
#include "team/vehicle_filter.hpp"

namespace cairn {

struct ScanCounts {
  std::uint64_t matched = 0, placed = 0, rejected = 0;
  std::uint64_t sightings_used = 0, sightings_refused = 0;  // of other vehicles: no pose known, or not of one time
  std::uint64_t vehicles_found = 0;                         // whose start was solved from mutual sightings
  std::uint64_t failed = 0;                                 // motions and scans that the filter refused
};

struct VehicleEstimate {
  SE2 pose;
  Matrix3 covariance;
};

class Cooperation {
 public:
  static std::unique_ptr<Cooperation> create(const TeamOptions& options);
  virtual ~Cooperation() = default;

  // --- teammates --- add throws with nothing changed
  virtual void add(std::uint64_t /*vehicle*/) {}  // its start pose is unknown
  virtual void add(std::uint64_t /*vehicle*/, const SE2& /*start*/, const Matrix3& /*covariance*/) {}
  // A teammate's motion was missed, or the teammate left: its pose is unknown.
  virtual void lose_sight(std::uint64_t /*vehicle*/) noexcept {}

  // --- packets --- Takes the packets of one time, ordered by the vehicles' numbers. Refusals by a filter are counted;
  // own_error() returns the refusal of this vehicle's own packet. Allocates nothing, except for the closing of a
  // submap: returns false if memory ran out in one. Then resume() goes on there, with the same packets.
  bool take(std::vector<Packet>& packets) noexcept;
  bool resume(std::vector<Packet>& packets) noexcept { return take_turn(packets); }
  // How many of the packets were taken, while a turn is not finished.
  virtual std::size_t taken() const { return 0; }
  void forget_own_error() { own_error_.reset(); }
  const std::optional<Error>& own_error() const { return own_error_; }

  // --- queries ---
  // The pose at the vehicle's last packet that was taken; throws not_found for a teammate whose pose is unknown.
  virtual VehicleEstimate estimate(std::uint64_t vehicle) const;
  virtual const Filter<SE2>& filter() const = 0;                      // whose map the caller sees
  const std::vector<Match>& matches() const { return own_matches_; }  // of this vehicle's scan that was taken last
  const ScanCounts& counts() const { return counts_; }

 protected:
  explicit Cooperation(const TeamOptions& options);

  virtual bool take_turn(std::vector<Packet>& packets) noexcept = 0;

  const TeamOptions& options() const { return options_; }
  bool is_own(const Packet& packet) const { return packet.vehicle == options_.mail.vehicle; }
  const Packet* own_packet(const std::vector<Packet>& packets) const;  // null if there is none
  // Moves the filter's vehicle by the motions of the packet.
  void move(Filter<SE2>& filter, const Packet& packet);
  // Updates the filter by a scan; the matches of an own scan are kept.
  void scan(VehicleFilter& filter, int sensor, const Scan& scan, bool own);
  // Moves and scans with this vehicle's radar.
  void move_and_scan(VehicleFilter& filter, const Packet& packet);
  ScanCounts& tally() { return counts_; }

  // A refusal of this vehicle's packet is reported to the caller; a refusal of a teammate's packet is only counted.
  template <class Function>
  bool attempt(bool own, Function&& function) noexcept {
    try {
      function();
      return true;
    } catch (const Error& error) {
      ++counts_.failed;
      if (own) own_error_.emplace(error);
      return false;
    }
  }

 private:
  TeamOptions options_;
  std::vector<Match> own_matches_;
  std::optional<Error> own_error_;
  ScanCounts counts_;
};

}  // namespace cairn
