// SPDX-License-Identifier: BSD-3-Clause
// One filter over the poses of all vehicles and all landmarks. Every vehicle runs the same filter, and each measurement
// is used in it once.
#pragma once

#include "team/cooperation.hpp"

namespace cairn {

class JointMode final : public Cooperation {
 public:
  explicit JointMode(const TeamOptions& options);

  using Cooperation::add;  // a teammate without a start is placed by a mutual sighting
  void add(std::uint64_t vehicle, const SE2& start, const Matrix3& covariance) override;
  void lose_sight(std::uint64_t vehicle) noexcept override;
  const Filter<SE2>& filter() const override { return team_.filter(); }

 private:
  bool take_turn(std::vector<Packet>& packets) noexcept override;
  void move_all(const std::vector<Packet>& packets);
  void find_teammates(std::vector<Packet>& packets);
  bool find_teammate(Packet& lost, Packet& from);
  void drop_unusable_sightings(Packet& packet, const std::vector<Packet>& packets);

  VehicleFilter team_;
  std::vector<std::size_t> at_once_;  // by packet of the turn: landmarks that do not wait; the others follow them
};

}  // namespace cairn
