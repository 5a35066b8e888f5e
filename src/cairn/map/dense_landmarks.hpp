// SPDX-License-Identifier: BSD-3-Clause
// Landmarks that no filter changes any longer: positions and their joint covariance.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "map/merge/merge.hpp"

namespace cairn {

class DenseLandmarks final : public Landmarks {
 public:
  explicit DenseLandmarks(const Landmarks& source);
  // Merges two maps of space, in the frame of `map`: computes the estimate and its covariance from those of both maps.
  DenseLandmarks(const DenseLandmarks& map, const DenseLandmarks& other, const MergePlan& plan);

  std::size_t size() const override { return ids_.size(); }
  std::uint64_t id(std::size_t index) const override { return ids_[index]; }
  std::uint64_t observations(std::size_t index) const override { return counts_[index]; }
  Vector3 position(std::size_t index) const override { return positions_[index]; }
  Matrix3 covariance(std::size_t index) const override;
  bool find(std::uint64_t id, std::size_t& index) const override;
  void joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const override;
  bool planar() const override { return planar_; }

 private:
  bool planar_ = false;
  std::vector<std::uint64_t> ids_, counts_;
  std::vector<Vector3> positions_;
  Eigen::MatrixXd covariance_;  // both triangles
  std::unordered_map<std::uint64_t, std::size_t> slots_;
};

}  // namespace cairn
