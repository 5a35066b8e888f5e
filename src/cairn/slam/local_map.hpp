// SPDX-License-Identifier: BSD-3-Clause
// The landmarks of the open submap, or of the single map: the state, and the names of its points. Every change of slots
// goes through this class, so that values and names move in step.
#pragma once

#include <vector>

#include "ekf/ekf_update.hpp"
#include "geometry/embedding.hpp"
#include "map/landmarks.hpp"
#include "slam/filter_options.hpp"
#include "slam/landmark_table.hpp"
#include "slam/systematic_errors.hpp"

namespace cairn {

// The interface Landmarks shows the landmarks that count. It is spatial for a vehicle in the plane, too.
template <class Pose>
class LocalMap final : public Landmarks {
 public:
  static constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  using Square = typename Pose::Square;
  using PointSquare = typename State<Pose>::PointSquare;

  LocalMap(Arena& arena, const FilterOptions<Pose>& options);
  std::uint64_t starts() const { return starts_; }         // how often it has started
  void start(const Pose& pose, const Square& covariance);  // forgets all landmarks, companions and systematic errors
  // The same, with these values and this covariance of the systematic errors, and of the error of the submap's base if
  // `base` is given. Allocates nothing.
  void start(const Pose& pose, const Square& covariance, const double* values, const double* errors,
             const Square* base = nullptr);
  // Whether the error of the submap's base is a state; its numbers follow those of the systematic errors.
  bool knows_base() const { return state_.systematic() > systematic_.states(); }

  State<Pose>& state() { return state_; }
  const State<Pose>& state() const { return state_; }
  const SystematicErrors& systematic() const { return systematic_; }
  // Adds an error of a sensor before anything was estimated; start() has to follow.
  void use_errors(const SystematicErrors& errors) { systematic_ = errors; }
  void add_error(int sensor, int number, double sigma, double walk) { systematic_.add(sensor, number, sigma, walk); }
  LandmarkTable& table() { return table_; }
  const LandmarkTable& table() const { return table_; }

  // --- landmarks ---
  // Names the landmark that the state got last. If the observation is in doubt, the landmark does not count before
  // another one agrees with it.
  void name_placed(std::uint64_t id, bool in_doubt = false);
  void count_from_now(Index deferred_slot);
  // So many observations agree on another place: the landmark does not count before more of them agree with it.
  void contest(Index slot, std::uint64_t elsewhere);
  void forget(Index slot);
  // Places a landmark `fresh` at the position of `id`, with an additional independent error.
  void split(std::uint64_t id, std::uint64_t fresh, const PointSquare& covariance);
  Index slot_at(std::uint64_t id) const;  // throws if there is none

  // --- vehicles --- by the caller's names for them
  bool has_vehicle(std::uint64_t id) const;
  Index companion_at(std::uint64_t id) const;  // throws if there is none
  // The companion's ordinary error is J_pose times that of the active vehicle, plus noise.
  void add_vehicle(std::uint64_t id, const Pose& pose, const Square& J_pose, const Square& noise);
  void remove_vehicle(std::uint64_t id);  // not the active one
  void look_from(std::uint64_t id);

  // Covariance of [pose; landmarks that count], ordinary errors, kDof + kDim count on a side, both triangles.
  void pose_joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const;

  // --- Landmarks ---
  std::size_t size() const override { return static_cast<std::size_t>(table_.counting()); }
  std::uint64_t id(std::size_t index) const override { return table_.id(slot_of(index)); }
  std::uint64_t observations(std::size_t index) const override { return table_.observations(slot_of(index)); }
  Vector3 position(std::size_t index) const override { return Embedding<Pose>::up(state_.landmark(slot_of(index))); }
  Matrix3 covariance(std::size_t index) const override {
    return Embedding<Pose>::up(state_.landmark_covariance(slot_of(index)));
  }
  bool find(std::uint64_t id, std::size_t& index) const override;
  void joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const override;
  bool planar() const override { return kDim == 2; }

 private:
  Index slot_of(std::size_t landmark) const { return table_.companions() + static_cast<Index>(landmark); }
  void exchange(Index a, Index b);

  const FilterOptions<Pose>& options_;
  SystematicErrors systematic_;
  State<Pose> state_;
  LandmarkTable table_;
  std::uint64_t starts_ = 0;
};

extern template class LocalMap<SE2>;
extern template class LocalMap<SE3>;

}  // namespace cairn
