// SPDX-License-Identifier: BSD-3-Clause
// A relaxation of an elimination tree whose minimum is known.
#pragma once

#include <doctest/doctest.h>

#include <map>
#include <utility>
#include <vector>

#include "map/join/elimination_leaves.hpp"

namespace cairn::test {

// A nonlinear problem in small: each leaf pulls its variables towards a target. Holds the values of all variables, and
// the force of each leaf at the values where the leaf was evaluated last.
template <class Pose>
class Springs final : public EliminationTree<Pose>::Relaxation {
 public:
  using RigidMotion = typename EliminationTree<Pose>::RigidMotion;

  explicit Springs(const Leaves<Pose>& leaves) : leaves_(leaves) {}

  double tolerance = 0.0;
  std::map<Variable, Matrix> values;
  std::vector<std::uint32_t> visited;
  std::size_t carried = 0;  // leaves

  void pull(std::uint32_t leaf, Matrix target) {
    targets_[leaf] = std::move(target);
    for (const Variable v : leaves_.blocks[leaf].variables) values.emplace(v, Matrix::Zero(dimension<Pose>(v), 1));
    evaluate(leaf);
  }
  Matrix at(std::uint32_t leaf) const {
    const LeafBlock& block = leaves_.blocks[leaf];
    Matrix x(dimension<Pose>(block.variables), 1);
    Index row = 0;
    for (const Variable v : block.variables) {
      x.middleRows(row, dimension<Pose>(v)) = values.at(v);
      row += dimension<Pose>(v);
    }
    return x;
  }
  void evaluate(std::uint32_t leaf) {
    forces_[leaf] = leaves_.blocks[leaf].information * (targets_.at(leaf) - at(leaf));
  }
  double cost() const {
    double sum = 0.0;
    for (const auto& [leaf, target] : targets_) {
      const Matrix stretch = target - at(leaf);
      sum += 0.5 * (stretch.transpose() * leaves_.blocks[leaf].information * stretch).value();
    }
    return sum;
  }
  Matrix solution() const {
    const auto states = leaves_.states();
    const Matrix inverse = leaves_.inverse();
    Matrix b = Matrix::Zero(inverse.rows(), 1);
    for (const auto& [leaf, target] : targets_)
      b(leaves_.states_of(leaves_.blocks[leaf]), Eigen::all) += leaves_.blocks[leaf].information * target;
    return inverse * b;
  }
  Matrix value() const {
    Matrix x(leaves_.inverse().rows(), 1);
    for (const auto& [v, state] : leaves_.states()) x.middleRows(state, dimension<Pose>(v)) = values.at(v);
    return x;
  }

  void right_hand_side(Variable v, double* b) const override {
    for (const auto& [leaf, force] : forces_) {
      Index at = 0;
      for (const Variable u : leaves_.blocks[leaf].variables) {
        if (u == v)
          for (Index d = 0; d < dimension<Pose>(v); ++d) b[d] += force(at + d);
        at += dimension<Pose>(u);
      }
    }
  }
  void solution(Variable v, const double* x) override {
    values.at(v) += Eigen::Map<const Matrix>(x, dimension<Pose>(v), 1);
  }
  bool matters(Variable v, const double* x) const override {
    return Eigen::Map<const Matrix>(x, dimension<Pose>(v), 1).norm() >= tolerance;
  }
  // A rigid motion is only a shift here: there is no geometry.
  RigidMotion take_rigid(const std::vector<Variable>& variables, Eigen::VectorXd& motion) const override {
    using Point = typename Pose::Point;
    RigidMotion rigid{Point::Zero(), Point::Zero(), Pose::Rotation::Tangent::Zero()};
    const Matrix shift = shifts<Pose>(variables);
    rigid.move = shift.transpose() * motion / static_cast<double>(variables.size());
    motion -= shift * rigid.move;
    return rigid;
  }
  void carry(Variable v, const RigidMotion& motion) override {
    values.at(v).template topRows<Pose::kDim>() += motion.move;
  }
  void carry_leaf(std::uint32_t leaf, const RigidMotion&) override {
    CHECK(!leaves_.absolute(leaf));
    ++carried;
  }
  void visit(std::uint32_t leaf) override {
    evaluate(leaf);
    visited.push_back(leaf);
  }

 private:
  const Leaves<Pose>& leaves_;
  std::map<std::uint32_t, Matrix> targets_, forces_;
};

}  // namespace cairn::test
