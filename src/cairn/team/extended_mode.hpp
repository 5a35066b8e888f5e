// SPDX-License-Identifier: BSD-3-Clause
// Extended observations: a teammate's scan, seen through the mutual sighting, updates the filter of this vehicle
// (cooperative paper, section 2.1). The teammate is not in the state: only its sighting and its scan are used.
#pragma once

#include "team/cooperation.hpp"

namespace cairn {

class ExtendedMode final : public Cooperation {
 public:
  explicit ExtendedMode(const TeamOptions& options);

  const Filter<SE2>& filter() const override { return own_.filter(); }

 private:
  bool take_turn(std::vector<Packet>& packets) noexcept override;
  void take_teammate(const Packet& own, const Packet& teammate);

  bool full_;  // with the noise that all observations of a scan share through the sighting
  VehicleFilter own_;
  int extended_sensor_;
};

}  // namespace cairn
