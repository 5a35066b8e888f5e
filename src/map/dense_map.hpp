// SPDX-License-Identifier: BSD-3-Clause
// The dense joining: one filter over the base and all landmarks (Mars paper, eq. 17-32, corrected). Equal to a filter
// that never heard of submaps where all is linear and Gaussian. Takes all its memory at creation, but for the workspace
// of a joining.
#pragma once

#include "core/id_table.hpp"
#include "map/global_map.hpp"

namespace cairn {

class DenseMap final : public GlobalMap<SE3> {
 public:
  explicit DenseMap(const MapOptions<SE3>& options);
  static std::size_t required_bytes(const MapOptions<SE3>& options);

  JoinReport join_and_fix(const Submap<SE3>& submap, FixRequest<SE3>* fix) override;
  FixReport fix(const AbsoluteFix<SE3>& fix, double threshold) override;
  void remove(std::uint64_t id) override;
  SE3 base() const override { return ekf_.pose(); }
  Matrix6 base_covariance() const override { return ekf_.pose_covariance(); }
  void base_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const override;
  std::size_t submap_count() const override { return closed_.size(); }
  SE3 submap_base(std::size_t submap) const override { return closed_[submap].base; }
  const std::vector<std::uint64_t>& submap_ids(std::size_t submap) const override { return closed_[submap].ids; }

  // Landmarks
  std::size_t size() const override { return static_cast<std::size_t>(ekf_.size()); }
  std::uint64_t id(std::size_t index) const override { return ids_[index]; }
  std::uint64_t observations(std::size_t index) const override { return counts_[index]; }
  Vector3 position(std::size_t index) const override { return ekf_.landmark(static_cast<Index>(index)); }
  Matrix3 covariance(std::size_t index) const override { return ekf_.landmark_covariance(static_cast<Index>(index)); }
  bool find(std::uint64_t id, std::size_t& index) const override;
  void joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const override;

 private:
  struct Pair {
    Eigen::Index local;  // in the submap
    Index slot;          // in the map
  };
  struct Closed {
    SE3 base;  // as it was known then
    std::vector<std::uint64_t> ids;
  };

  DenseMap(const MapOptions<SE3>& options, std::size_t bytes);
  void open(const std::vector<Pair>& pairs);
  bool linearise(const Submap<SE3>& submap, const std::vector<Pair>& pairs, const Eigen::MatrixXd& noise,
                 double* residual_only);
  void gate(const Submap<SE3>& submap, std::vector<Pair>& pairs, const Eigen::MatrixXd& noise, JoinReport& report);

  void fuse_and_compose(const Submap<SE3>& submap, const std::vector<Pair>& pairs, const Eigen::MatrixXd& joint,
                        const std::vector<Index>& slots, std::vector<Vector3>& landmarks, Ekf<SE3>::Handover& handover,
                        JoinReport& report);

  MapOptions<SE3> options_;
  Arena arena_;
  Ekf<SE3> ekf_;
  IdTable slots_;
  std::uint64_t* ids_;
  std::uint64_t* counts_;
  std::vector<Closed> closed_;
};

}  // namespace cairn
