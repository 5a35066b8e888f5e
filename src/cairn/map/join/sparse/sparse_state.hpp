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
#include "map/join/sparse/sparse_anchors.hpp"
#include "map/join/sparse/submap_factor.hpp"

namespace cairn {

// Systematic errors that the submaps share are points, too: entries of `landmarks` that no caller sees, whose axes
// never turn (ErrorPoints says which numbers they hold). A copy is independent; it shares only data that never changes.
// Submap j, the leaf j of the tree, leads from base j to base j + 1.
template <class Pose>
struct SparseState {
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Point = typename Pose::Point;
  using Rotation = typename Pose::Rotation;
  using Square = typename Pose::Square;
  using Data = SubmapData<Pose>;
  using Factor = SubmapFactor<Pose>;
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
  struct Leaf {
    TreeKey key;
    std::shared_ptr<const Data> data;
    std::vector<Number> landmarks;  // of the map, by the submap's; kNone: left out
    std::vector<Number> errors;     // points of systematic errors: constant, at the base, at the end
    std::shared_ptr<const Factor> factor;
    std::vector<Variable> variables;  // ascending
    std::vector<Index> states;        // where each begins
    std::vector<Index> order;         // state of the variables by state of the factor
    // Relative to the base, when the tree took the leaf's information: the end, the shared landmarks, the variables'
    // axes.
    Pose end_then;
    std::vector<Point> landmarks_then;
    std::vector<Rotation> axes_then;
    double cost = 0.0;
    Eigen::VectorXd gradient;  // in the order of `variables`, in map axes when it was evaluated
    Rotation turned;           // turn since then, carried along with other leaves
    Number saved = 0;
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
  };

  explicit SparseState(const MapOptions<Pose>& map_options);

  MapOptions<Pose> options;
  ErrorPoints<Pose> error_points;
  std::vector<Number> constant_errors, walking_errors;  // points; those that walk, base by base
  Solution solution;
  std::vector<Pose> bases;
  std::vector<Number> base_saved;  // by base: the change that saved it last
  std::vector<Landmark> landmarks;
  std::vector<Leaf> leaves;
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
  bool shared(Number landmark) const { return landmarks[landmark].submaps.size() > 1; }
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
    return is_landmark(v) ? landmarks[number].position : bases[number].translation();
  }
  void to_map_axes(const std::vector<Variable>& variables, Eigen::MatrixXd& covariance) const;
  // From columns by errors in map axes to columns by errors in the variables' own axes.
  void by_own_axes(const std::vector<Variable>& variables, Eigen::MatrixXd& columns) const;
  void refresh_base_covariance();

  // Leaves
  Values values(Number leaf) const;
  TreeKey key_of(Number leaf) const;
  void shape(Leaf& leaf, Number number) const;
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
