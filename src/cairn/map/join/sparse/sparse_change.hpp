// SPDX-License-Identifier: BSD-3-Clause
// One change of a sparse map's state: it saves everything that it touches, and takes everything back unless it is kept.
#pragma once

#include <utility>
#include <vector>

#include "map/join/sparse/sparse_state.hpp"
#include "map/spatial_index.hpp"

namespace cairn {

// Saves each existing value at most once. New bases, landmarks and leaves get numbers that are free, or are appended
// after the old ones and need no copy.
template <class Pose>
class SparseChange {
 public:
  using State = SparseState<Pose>;
  using Number = typename State::Number;
  using Point = typename Pose::Point;
  using Rotation = typename Pose::Rotation;

  SparseChange(SparseState<Pose>& state, SpatialIndex& index);
  ~SparseChange();  // takes back a change that was not kept
  SparseChange(const SparseChange&) = delete;
  SparseChange& operator=(const SparseChange&) = delete;

  // To be called before a landmark or a base moves, and before a leaf changes.
  void save_landmark(Number landmark);
  void save_base(Number base);
  void save_leaf(Number leaf);
  void save_turn(Number leaf);  // if only Leaf::turned changes

  Number add_base(const Pose& base);           // which nothing holds yet
  Number add_landmark(const Point& position);  // without an id, which callers do not see
  // The points of systematic errors that walk, at the newest base.
  void add_errors(const Eigen::VectorXd& values);
  void show_landmark(Number landmark, std::uint64_t id);
  // Once the change is kept: callers do not see an existing landmark any more; they see `next` under its id.
  void hide_landmark(Number landmark) { hidden_.emplace_back(landmark, State::kNone); }
  void supersede_landmark(Number landmark, Number next) { hidden_.emplace_back(landmark, next); }
  // Adds a leaf that holds these poses, as the next submap. Its landmarks, errors and factor are still missing.
  Number add_leaf(std::vector<Number> poses);
  // The numbers are free; nothing may be added later in this change. Nothing holds the pose or the landmark any more,
  // and another leaf has taken all that the leaf held.
  void remove_leaf(Number leaf);
  void free_base(Number base);
  void free_landmark(Number landmark);
  // To be called before a landmark gets other holders than by extend(), and not in a change that has extended it.
  void save_holders(Number landmark);
  // The submap lies in another leaf now.
  void move_submap(Number submap, Number leaf, const Pose& T_leaf_submap);
  // Another submap holds an existing landmark, with this number of observations.
  void extend(Number landmark, Number submap, std::uint64_t count);
  // To be called before extend(): notes what changes with the landmark: its only submap so far, or the fronts that
  // eliminated it.
  void note_held_again(Number landmark, std::vector<Number>& reshaped, TreeChanges& changes) const;

  std::size_t old_visible() const { return visible_; }
  double cost_growth() const;
  // Computes the values that follow from the solution, and reports how far landmarks moved.
  void prepare(JoinReport& report);
  void keep() noexcept;

 private:
  void roll_back() noexcept;
  void note_moves() noexcept;
  void hide() noexcept;

  State& state_;
  SpatialIndex& index_;
  bool kept_ = false;
  Number number_;
  Number landmarks_;  // how many of each there were
  std::size_t leaf_count_, base_count_, submap_count_, visible_, walking_;
  typename State::Solution solution_;
  std::vector<std::pair<Number, Point>> positions_;
  std::vector<std::pair<Number, typename State::Base>> bases_;
  std::vector<std::pair<Number, typename State::Leaf>> leaves_;
  std::vector<Number> again_;                                    // landmarks that got a free number
  std::vector<std::pair<Number, std::vector<Number>>> holders_;  // landmarks, and the leaves that held them, in order
  std::vector<std::pair<Number, typename State::Closed>> submaps_;
  std::vector<std::pair<Number, Rotation>> turned_;         // leaves that were carried before they were saved, in order
  std::vector<std::pair<Number, std::uint64_t>> extended_;  // landmarks, and the observations added
  std::vector<std::pair<Number, Number>> hidden_;           // landmarks, and those that supersede them
};

extern template class SparseChange<SE2>;
extern template class SparseChange<SE3>;

}  // namespace cairn
