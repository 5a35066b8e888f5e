// SPDX-License-Identifier: BSD-3-Clause
// No cooperation: one filter of this vehicle, to compare with.
#pragma once

#include "team/cooperation.hpp"

namespace cairn {

class MonoMode final : public Cooperation {
 public:
  explicit MonoMode(const TeamOptions& options)
      : Cooperation(options), own_(options.filter, options.mail.vehicle, options.radar) {}

  const Filter<SE2>& filter() const override { return own_.filter(); }

 private:
  bool take_turn(std::vector<Packet>& packets) noexcept override {
    if (const Packet* own = own_packet(packets)) move_and_scan(own_, *own);
    return true;
  }

  VehicleFilter own_;
};

}  // namespace cairn
