// SPDX-License-Identifier: BSD-3-Clause
// The sparse joining: solves for all submaps together by damped Gauss-Newton. Each submap is one dense observation of
// its base, its end and its landmarks. A closing changes only the affected part of the factor (docs/submaps.md).
#pragma once

#include <memory>

#include "map/global_map.hpp"
#include "map/join/sparse/sparse_queries.hpp"
#include "map/join/sparse/sparse_state.hpp"
#include "map/merge/merge.hpp"
#include "map/spatial_index.hpp"

namespace cairn {

template <class Pose>
class SparseMap final : public GlobalMap<Pose> {
 public:
  using Square = typename Pose::Square;

  explicit SparseMap(const MapOptions<Pose>& options);
  SparseMap(const SparseMap& other);
  SparseMap& operator=(const SparseMap&) = delete;

  std::unique_ptr<MapTransaction<Pose>> begin() override;
  void remove(std::uint64_t id) override;
  Pose base() const override { return state_.newest_base(); }
  Square base_covariance() const override { return state_.solution.base_covariance; }
  void base_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const override {
    joint_covariance_of_base(state_, indices, count, matrix);
  }
  Eigen::VectorXd errors() const override { return errors_of(state_); }
  Eigen::MatrixXd joint_with_errors(const std::size_t* indices, std::size_t count) const override {
    return joint_with_errors_of(state_, indices, count);
  }
  std::size_t submap_count() const override { return state_.submaps.size(); }
  Pose submap_base(std::size_t submap) const override { return state_.submap_base(submap); }
  const std::vector<std::uint64_t>& submap_ids(std::size_t submap) const override { return state_.submap_ids(submap); }

  // Landmarks
  std::size_t size() const override { return state_.visible.size(); }
  std::uint64_t id(std::size_t index) const override { return landmark(index).id; }
  std::uint64_t observations(std::size_t index) const override { return landmark(index).count; }
  Vector3 position(std::size_t index) const override { return Embedding<Pose>::up(state_.point(index)); }
  Matrix3 covariance(std::size_t index) const override { return Embedding<Pose>::up(covariances_.of(state_, index)); }
  Matrix3 covariance_alone(std::size_t index) const override {
    return Embedding<Pose>::up(covariances_.alone(state_, index));
  }
  bool find(std::uint64_t id, std::size_t& index) const override { return state_.find(id, index); }
  void joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const override;
  void prepare_covariances(const std::vector<std::size_t>& indices) const override {
    covariances_.prepare(state_, indices);
  }
  const SpatialIndex* spatial_index() const override { return &index_; }
  MapKind kind() const override { return MapKind::sparse; }
  std::unique_ptr<Landmarks> copy() const override { return std::make_unique<SparseMap>(*this); }

  std::size_t memory_bytes() const { return state_.memory_bytes(); }
  double cost() const { return state_.cost(); }  // half the sum of all squared normalised residuals

  // Appends another map of space, whose landmarks get these ids here; `plan` contains the common landmarks and the
  // transform between the frames (sparse_merger.hpp). A call that throws leaves the map as it was.
  void append(const SparseMap& other, const MergePlan& plan, const MergeOptions& options, MergeReport& report);

 private:
  const typename SparseState<Pose>::Landmark& landmark(std::size_t index) const {
    return state_.landmarks[state_.visible[index]];
  }

  SparseState<Pose> state_;
  SpatialIndex index_;
  mutable SparseCovariances<Pose> covariances_;
};

// Only maps of space are appended to each other.
template <>
void SparseMap<SE3>::append(const SparseMap& other, const MergePlan& plan, const MergeOptions& options,
                            MergeReport& report);

extern template class SparseMap<SE2>;
extern template class SparseMap<SE3>;

}  // namespace cairn
