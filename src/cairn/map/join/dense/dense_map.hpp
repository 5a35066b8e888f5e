// SPDX-License-Identifier: BSD-3-Clause
// The dense joining: one filter over the base and all landmarks (Mars paper, eq. 17-32, corrected). If all models are
// linear and Gaussian, the result equals that of a filter without submaps. The map takes all its memory at creation,
// except the workspace of a joining.
#pragma once

#include "core/id_table.hpp"
#include "ekf/state.hpp"
#include "geometry/embedding.hpp"
#include "map/global_map.hpp"

namespace cairn {

template <class Pose>
class DenseTransaction;

template <class Pose>
class DenseMap final : public GlobalMap<Pose> {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;

  explicit DenseMap(const MapOptions<Pose>& options);
  static std::size_t required_bytes(const MapOptions<Pose>& options);

  std::unique_ptr<MapTransaction<Pose>> begin() override;
  void remove(std::uint64_t id) override;
  Pose base() const override { return state_.pose(); }
  typename Pose::Square base_covariance() const override { return state_.pose_covariance(); }
  void base_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const override;
  Eigen::VectorXd errors() const override;
  Eigen::MatrixXd joint_with_errors(const std::size_t* indices, std::size_t count) const override;
  std::size_t submap_count() const override { return closed_.size(); }
  Pose submap_base(std::size_t submap) const override { return closed_[submap].base; }
  const std::vector<std::uint64_t>& submap_ids(std::size_t submap) const override { return closed_[submap].ids; }

  // Submaps of several vehicles: the base is that of the active vehicle, at first the map's first vehicle. Others are
  // added before the first submap.
  void name_vehicle(std::uint64_t id) { vehicle_ = id; }
  void add_vehicle(std::uint64_t id, const Pose& pose, const typename Pose::Square& covariance);
  void look_from(std::uint64_t id);
  Pose vehicle_base(std::uint64_t id) const { return id == vehicle_ ? base() : state_.companion(companion(id)); }
  typename Pose::Square vehicle_base_covariance(std::uint64_t id) const {
    return id == vehicle_ ? base_covariance() : state_.companion_covariance(companion(id));
  }

  // Landmarks, counted from 0 behind the slots of companions
  std::size_t size() const override { return static_cast<std::size_t>(state_.size() - state_.companions()); }
  std::uint64_t id(std::size_t index) const override { return ids_[index]; }
  std::uint64_t observations(std::size_t index) const override { return counts_[index]; }
  Vector3 position(std::size_t index) const override { return Embedding<Pose>::up(state_.landmark(slot_of(index))); }
  Matrix3 covariance(std::size_t index) const override {
    return Embedding<Pose>::up(state_.landmark_covariance(slot_of(index)));
  }
  bool find(std::uint64_t id, std::size_t& index) const override;
  void joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const override;

 private:
  friend class DenseTransaction<Pose>;

  struct Closed {
    Pose base;  // as it was estimated then
    std::vector<std::uint64_t> ids;
  };

  DenseMap(const MapOptions<Pose>& options, std::size_t bytes);
  Index slot_of(std::size_t index) const { return state_.companions() + static_cast<Index>(index); }
  Index companion(std::uint64_t id) const;
  void append(std::uint64_t id, std::uint64_t count, std::size_t index);
  void remove_at(std::size_t index);  // its id may have another landmark already

  MapOptions<Pose> options_;
  Arena arena_;
  State<Pose> state_;
  IdTable indices_;
  std::uint64_t* ids_;
  std::uint64_t* counts_;
  std::vector<Closed> closed_;
  std::uint64_t vehicle_ = 0;              // looked from
  std::vector<std::uint64_t> companions_;  // by number
};

extern template class DenseMap<SE2>;
extern template class DenseMap<SE3>;

}  // namespace cairn
