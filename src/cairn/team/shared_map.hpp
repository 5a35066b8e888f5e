// SPDX-License-Identifier: BSD-3-Clause
// One vehicle's view of the dense map that the submaps of a whole team join.
#pragma once

#include "map/join/dense/dense_map.hpp"

namespace cairn {

// Queries that need more than the vehicle's own pose activate this vehicle in the shared map, and so change the map:
// two vehicles' views of one map must not be queried at the same time.
class SharedMap final : public GlobalMap<SE2> {
 public:
  SharedMap(DenseMap<SE2>& map, std::uint64_t vehicle) : map_(map), vehicle_(vehicle) {}

  std::unique_ptr<MapTransaction<SE2>> begin() override {
    map_.look_from(vehicle_);
    return map_.begin();
  }
  void remove(std::uint64_t id) override { map_.remove(id); }
  SE2 base() const override { return map_.vehicle_base(vehicle_); }
  Matrix3 base_covariance() const override { return map_.vehicle_base_covariance(vehicle_); }
  void base_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const override {
    map_.look_from(vehicle_);
    map_.base_joint_covariance(indices, count, matrix);
  }
  Eigen::VectorXd errors() const override { return map_.errors(); }
  Eigen::MatrixXd joint_with_errors(const std::size_t* indices, std::size_t count) const override {
    map_.look_from(vehicle_);
    return map_.joint_with_errors(indices, count);
  }
  std::size_t submap_count() const override { return map_.submap_count(); }
  SE2 submap_base(std::size_t submap) const override { return map_.submap_base(submap); }
  const std::vector<std::uint64_t>& submap_ids(std::size_t submap) const override { return map_.submap_ids(submap); }

  std::size_t size() const override { return map_.size(); }
  std::uint64_t id(std::size_t index) const override { return map_.id(index); }
  std::uint64_t observations(std::size_t index) const override { return map_.observations(index); }
  Vector3 position(std::size_t index) const override { return map_.position(index); }
  Matrix3 covariance(std::size_t index) const override { return map_.covariance(index); }
  bool find(std::uint64_t id, std::size_t& index) const override { return map_.find(id, index); }
  void joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const override {
    map_.joint_covariance(indices, count, matrix);
  }

 private:
  DenseMap<SE2>& map_;
  std::uint64_t vehicle_;
};

}  // namespace cairn
