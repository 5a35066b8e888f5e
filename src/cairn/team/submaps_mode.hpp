// SPDX-License-Identifier: BSD-3-Clause
// Each vehicle has its own submaps, and closed submaps join one map through the landmarks that they have in common.
// Submaps share no information: sightings of vehicles would correlate them, and are left out (cooperative paper,
// section 1).
#pragma once

#include <map>

#include "team/cooperation.hpp"
#include "team/shared_map.hpp"

namespace cairn {

class SubmapsMode final : public Cooperation {
 public:
  explicit SubmapsMode(const TeamOptions& options);

  void add(std::uint64_t vehicle) override;
  void add(std::uint64_t vehicle, const SE2& start, const Matrix3& covariance) override;
  void lose_sight(std::uint64_t vehicle) noexcept override;
  VehicleEstimate estimate(std::uint64_t vehicle) const override;
  const Filter<SE2>& filter() const override { return own_->filter(); }
  std::size_t taken() const override { return taken_; }

 private:
  struct Teammate {
    std::unique_ptr<VehicleFilter> filter;
    bool in_sight = true;  // its packets are used
  };

  bool take_turn(std::vector<Packet>& packets) noexcept override;
  bool close_open() noexcept;
  VehicleFilter* filter_of(const Packet& packet);
  std::unique_ptr<VehicleFilter> make_filter(std::uint64_t vehicle);

  DenseMap<SE2> map_;  // of the whole team
  std::unique_ptr<VehicleFilter> own_;
  std::map<std::uint64_t, Teammate> teammates_;
  std::size_t taken_ = 0;          // packets of a turn that is not finished
  VehicleFilter* open_ = nullptr;  // its submap could not be closed, because memory ran out
};

}  // namespace cairn
