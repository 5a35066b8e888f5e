// SPDX-License-Identifier: BSD-3-Clause
// The state of a sparse map: bases, landmarks and submaps, and the factor of the problem that they make up.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <unordered_map>
#include <vector>

#include "geometry/embedding.hpp"
#include "map/global_map.hpp"
#include "map/join/sparse/elimination_tree.hpp"
#include "map/join/sparse/place_factor.hpp"
#include "map/join/sparse/sparse_anchors.hpp"
#include "map/join/sparse/submap_factor.hpp"

namespace cairn {

// Systematic errors that the submaps share are points, too: entries of `landmarks` that no caller sees, whose axes
// never turn (ErrorPoints says which numbers they hold). A copy is independent; it shares only data that never changes.
// A leaf is a submap, which leads from its base to its end, or a place: several submaps that became one. The end of a
// submap is the base of the next one. Numbers of leaves, bases and landmarks that nothing uses any more are given
// again.
template <class Pose>
struct SparseState {
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Point = typename Pose::Point;
  using Rotation = typename Pose::Rotation;
  using Square = typename Pose::Square;
  using Data = SubmapData<Pose>;
  using Factor = SubmapFactor<Pose>;
  using Place = PlaceFactor<Pose>;
  using Values = FactorValues<Pose>;
  using Number = std::uint32_t;
  static constexpr Number kNone = UINT32_MAX;

  struct Landmark {
    std::uint64_t id;
    std::uint64_t count;
    Point position;
    std::vector<Number> submaps;  // that hold it
    Number slot;                  // in `visible`, kNone once removed
    Number saved;                 // the change that saved it last
    bool error = false;           // it holds systematic errors
  };
  struct Base {
    Pose pose;
    Number leaves[2] = {kNone, kNone};  // that hold it
    Number saved = 0;                   // the change that saved it last

    int held() const { return (leaves[0] != kNone) + (leaves[1] != kNone); }
    void add(Number leaf) { (leaves[0] == kNone ? leaves[0] : leaves[1]) = leaf; }
  };
  struct Leaf {
    TreeKey key;
    Number submap = kNone;          // its number for callers; of a place that of the submap whose base it has
    std::vector<Number> poses;      // its base first; then the end of a submap, or other poses of a place
    std::vector<Number> landmarks;  // of the map, by the submap's; kNone: left out
    std::vector<Number> errors;     // points of systematic errors: constant, at the base, at the end
    // Of a submap; a place has only the last one, and all of its landmarks are variables.
    std::shared_ptr<const Data> data;
    std::shared_ptr<const Factor> factor;
    std::shared_ptr<const Place> place;
    std::vector<Variable> variables;  // ascending
    std::vector<Index> states;        // where each begins
    std::vector<Index> order;         // state of the variables by state of the factor
    // Relative to the base, when the tree took the leaf's information: the other poses, the shared landmarks, the
    // variables' axes.
    std::vector<Point> poses_then;
    std::vector<Point> landmarks_then;
    std::vector<Rotation> axes_then;
    double cost = 0.0;
    Eigen::VectorXd gradient;  // in the order of `variables`, in map axes when it was evaluated
    Rotation turned;           // turn since then, carried along with other leaves
    Number saved = 0;

    bool used() const { return data != nullptr || place != nullptr; }         // its number is not free
    bool fixed() const { return data != nullptr && data->base.has_value(); }  // there were fixes in the submap
    Number base() const { return poses[0]; }
    // The landmarks that are variables, and their states of the factor.
    Index shared_count() const {
      return place != nullptr ? static_cast<Index>(landmarks.size()) : factor->shared_count();
    }
    Number shared(Index i) const { return landmarks[place != nullptr ? i : factor->shared()[i]]; }
    Index state_of_shared(Index i) const { return static_cast<Index>(kDof * poses.size()) + kDim * i; }
  };
  // A submap, by its number for callers.
  struct Closed {
    Number leaf;
    Pose T_leaf_submap;  // its base, from the leaf's
  };
  // A change saves this whole part when it begins.
  struct Solution {
    Solution(const Pose& prior, const Square& covariance) : anchors(prior, covariance), base_covariance(covariance) {}

    SparseAnchors<Pose> anchors;
    EliminationTree<Pose> tree;
    Square base_covariance;
    // The units of a step: the smallest typical standard deviation of a landmark in its submap, and the turn that moves
    // the submap's farthest landmark by the same distance.
    double length_scale = std::numeric_limits<double>::infinity(), turn_scale = length_scale;
    double error_scale = length_scale;  // of points of systematic errors
    std::vector<Number> pending;        // leaves evaluated since the tree took their forces
    bool settled = true;                // whether the last optimisation converged
    std::vector<Number> stale;          // leaves to be linearised anew
    Number newest = 0;                  // base
    std::vector<Number> recent;         // leaves that may be fused with others, in the order of their closings
    std::vector<Number> grown;          // leaves that have become larger since others were compared with them
    std::size_t largest = 0;            // landmarks of a submap
    std::vector<Number> free_leaves, free_bases, free_landmarks;
  };

  explicit SparseState(const MapOptions<Pose>& map_options);

  MapOptions<Pose> options;
  ErrorPoints<Pose> error_points;
  std::vector<Number> constant_errors, walking_errors;  // points; those that walk, base by base
  Solution solution;
  std::vector<Base> bases;
  std::vector<Landmark> landmarks;
  std::vector<Leaf> leaves;
  std::vector<Closed> submaps;
  std::vector<Number> visible;  // landmarks, by the index that callers use
  std::unordered_map<std::uint64_t, Number> ids;
  Number change = 0;  // number of the last change

  bool find(std::uint64_t id, std::size_t& index) const;
  // Callers do not see the landmark of this name any more; the last visible one takes its index, which is returned. Its
  // factors stay.
  Number hide(std::unordered_map<std::uint64_t, Number>::const_iterator name) noexcept {
    const Number hidden = name->second, last = visible.back(), slot = landmarks[hidden].slot;
    visible[slot] = last;
    landmarks[last].slot = slot;
    landmarks[hidden].slot = kNone;
    visible.pop_back();
    ids.erase(name);
    return slot;
  }
  const Point& point(std::size_t index) const { return landmarks[visible[index]].position; }
  // Whether it is a variable. Private landmarks follow from the variables of their leaf.
  bool shared(Number landmark) const {
    const std::vector<Number>& holders = landmarks[landmark].submaps;
    return holders.size() > 1 || (holders.size() == 1 && leaves[holders[0]].place != nullptr);
  }
  const Pose& newest_base() const { return bases[solution.newest].pose; }
  Pose submap_base(std::size_t submap) const {
    const Leaf& leaf = leaves[submaps[submap].leaf];
    const Pose& base = bases[leaf.base()].pose;
    return leaf.submap == submap ? base : base * submaps[submap].T_leaf_submap;
  }
  const std::vector<std::uint64_t>& submap_ids(std::size_t submap) const {  // of a place all that it held when fused
    const Leaf& leaf = leaves[submaps[submap].leaf];
    return leaf.place != nullptr ? leaf.place->ids() : leaf.data->ids;
  }
  std::size_t leaf_count() const { return leaves.size() - solution.free_leaves.size(); }
  bool is_error(Variable v) const { return is_landmark(v) && landmarks[static_cast<Number>(v >> 1)].error; }
  // The points of a base: [constant; walking at the base].
  std::vector<Number> errors_at(Number base) const;
  Eigen::VectorXd error_values(const std::vector<Number>& points) const;
  double cost() const;
  std::size_t memory_bytes() const;

  // Variables. Each variable's error is in its own axes, see axes().
  static Index dimension(Variable v) { return cairn::dimension<Pose>(v); }
  const Rotation& axes(Variable v) const;
  const Point& place_of(Variable v) const {
    const auto number = static_cast<Number>(v >> 1);
    return is_landmark(v) ? landmarks[number].position : bases[number].pose.translation();
  }
  void to_map_axes(const std::vector<Variable>& variables, Eigen::MatrixXd& covariance) const;
  // From columns by errors in map axes to columns by errors in the variables' own axes.
  void by_own_axes(const std::vector<Variable>& variables, Eigen::MatrixXd& columns) const;
  void refresh_base_covariance();

  // Leaves
  Values values(const Leaf& leaf, const Factor& factor) const;  // of a submap
  Values values(Number leaf) const { return values(leaves[leaf], *leaves[leaf].factor); }
  PlaceValues<Pose> place_values(const Leaf& leaf) const;
  typename Rotation::Matrix landmark_information(const Leaf& leaf, Index shared_landmark) const;  // in map axes
  TreeKey key_of(Number leaf, Number base) const;
  void shape(Leaf& leaf) const;
  void evaluate(Number leaf);
  void place_private(Number leaf);
  Point force_on(const Leaf& leaf, Index shared_landmark) const;
  void note_linearisation(Number leaf);
  double strain(Number leaf) const;

 private:
  template <class Turn>
  void for_axes(const std::vector<Variable>& variables, Turn&& turn) const;
  void add_fixes(Leaf& leaf, const Pose& end, const std::vector<AbsoluteFix<Pose>>& fixes) const;
};

extern template struct SparseState<SE2>;
extern template struct SparseState<SE3>;

}  // namespace cairn
