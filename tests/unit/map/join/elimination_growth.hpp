// SPDX-License-Identifier: BSD-3-Clause
// An elimination tree that grows by random leaves, and its comparison with a dense inverse.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>
#include <vector>

#include "map/join/elimination_leaves.hpp"
#include "map/join/elimination_springs.hpp"
#include "numerical.hpp"

namespace cairn::test {

template <class Pose>
class Growth {
 public:
  explicit Growth(unsigned seed) : random_(seed) {}

  Leaves<Pose> leaves;
  EliminationTree<Pose> tree;
  std::size_t refactored = 0;
  Springs<Pose>* springs = nullptr;  // settled before each change, if given
  double foreseen = 0.0;             // fall of the cost that the last relax() predicted

  // Adds a leaf with its two bases, `known` landmarks of other leaves and `fresh` new landmarks. With
  // `one_of_an_old_leaf`, the leaf also shares a landmark that only one older leaf had before.
  void add(const Vector3& place, int known, int fresh, bool one_of_an_old_leaf) {
    const auto number = static_cast<std::uint32_t>(leaves.blocks.size());
    TreeChanges changes;
    std::vector<Variable> variables{base_variable(number), base_variable(number + 1)};
    const auto hold = [&](Variable v) {
      if (std::find(variables.begin(), variables.end(), v) == variables.end()) variables.push_back(v);
    };
    for (int i = 0; i < known && landmarks_ > 0; ++i) hold(landmark_variable(below(landmarks_)));
    for (int i = 0; i < fresh; ++i) hold(landmark_variable(landmarks_++));
    if (one_of_an_old_leaf && number > 0) {
      LeafBlock& old = leaves.blocks[below(number)];
      const Variable v = landmark_variable(landmarks_++);
      hold(v);
      old.variables.push_back(v);
      std::sort(old.variables.begin(), old.variables.end());
      old.information = information(old.variables);
      changes.leaves.push_back(old.key);
    }
    std::sort(variables.begin(), variables.end());
    for (const Variable v : variables)
      for (const LeafBlock& block : leaves.blocks)
        if (std::binary_search(block.variables.begin(), block.variables.end(), v)) {
          changes.variables.emplace_back(v, block.key);
          break;
        }
    leaves.blocks.push_back({TreeKey(place, number), variables, information(variables)});
    changes.leaves.push_back(leaves.blocks.back().key);
    for (const Variable v : variables) tree.set_degree(v, leaves.degree(v));
    tree.set_degree(base_variable(number + 1), 2);  // the next leaf begins there
    tree.set_last(base_variable(number + 1));
    std::vector<std::uint32_t> assembled;
    if (springs != nullptr) {
      tree.settle(changes, *springs);
      for (const TreeKey& key : changes.leaves) springs->visited.push_back(key.leaf);
      for (const auto& [v, key] : changes.variables) springs->visited.push_back(key.leaf);
    }
    REQUIRE(tree.update(leaves, changes, refactored, assembled));
    CHECK(std::find(assembled.begin(), assembled.end(), number) != assembled.end());
  }

  // Removes an older leaf, and with it what no other leaf holds.
  void remove(std::uint32_t number) {
    LeafBlock& block = leaves.blocks[number];
    const std::vector<Variable> variables = block.variables;
    TreeChanges changes;
    changes.removed.push_back(block.key);
    block.variables.clear();
    block.information.resize(0, 0);
    for (const Variable v : variables) {
      const std::int32_t degree = leaves.degree(v);
      if (degree > 0)
        tree.set_degree(v, degree);
      else
        tree.forget(v);
    }
    std::vector<std::uint32_t> assembled;
    REQUIRE(tree.update(leaves, changes, refactored, assembled));
  }

  // One step from all leaves that were evaluated or changed since the last step. Returns the number of visited leaves.
  std::size_t relax() {
    std::vector<TreeTouch> touches;
    for (const std::uint32_t leaf : springs->visited) touches.push_back(tree.touch(leaves.blocks[leaf].key));
    springs->visited.clear();
    foreseen = tree.relax(touches, *springs);
    return springs->visited.size();
  }

  Matrix information(const std::vector<Variable>& variables) {
    const Index n = dimension<Pose>(variables);
    Matrix J(n + 2, n);
    for (Eigen::Index i = 0; i < J.size(); ++i) J.data()[i] = random_.normal();
    Matrix all = J.transpose() * J + 0.1 * Matrix::Identity(n, n);
    if (!leaves.relative || leaves.blocks.empty()) return all;
    const Matrix shift = shifts<Pose>(variables);
    const Matrix differences =
        Matrix::Identity(n, n) - shift * shift.transpose() / static_cast<double>(variables.size());
    return differences * all * differences;
  }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_.uniform(0, static_cast<double>(n))); }
  Vector3 anywhere(double extent) {
    return Vector3(random_.uniform(-extent, extent), random_.uniform(-extent, extent), random_.uniform(-2, 2));
  }
  Matrix columns(Eigen::Index n, Eigen::Index count) {
    Matrix b(n, count);
    for (Eigen::Index i = 0; i < b.size(); ++i) b.data()[i] = random_.normal();
    return b;
  }

 private:
  Random random_;
  std::size_t landmarks_ = 0;
};

// Compares all answers of a tree with the dense inverse of its leaves.
template <class Pose>
void check_tree(const EliminationTree<Pose>& tree, const Leaves<Pose>& leaves, Growth<Pose>& growth) {
  const Matrix inverse = leaves.inverse();
  const auto states = leaves.states();
  std::vector<TreeKey> keys;
  for (const LeafBlock& block : leaves.blocks)
    if (!block.variables.empty()) keys.push_back(block.key);

  // Combinations of the variables of three leaves and of single variables, which may be those of one leaf, too; in an
  // order that is not that of the tree.
  std::vector<TreeCombinations> combinations;
  std::vector<Matrix> dense;
  for (int i = 0; i < 6; ++i) {
    const LeafBlock& block = leaves.blocks[keys[growth.below(keys.size())].leaf];
    TreeCombinations own{tree.touch(block.key), block.variables, {}};
    if (i % 2 == 1) {  // touched only where the variable was eliminated
      const Variable v = block.variables[growth.below(block.variables.size())];
      own.variables = {v};
      own.touch = tree.touch(v, block.key);
    }
    own.weights = growth.columns(dimension<Pose>(own.variables), 1 + i % 3);
    Matrix weights = Matrix::Zero(inverse.rows(), own.weights.cols());
    Eigen::Index row = 0;
    for (const Variable v : own.variables) {
      const Index d = dimension<Pose>(v);
      weights.middleRows(states.at(v), d) = own.weights.middleRows(row, d);
      row += d;
    }
    dense.push_back(weights);
    combinations.push_back(std::move(own));
  }
  const Matrix joint = tree.covariance(combinations);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < dense.size(); ++i) {
    Eigen::Index column = 0;
    for (std::size_t k = 0; k < dense.size(); ++k) {
      const Matrix expected = dense[i].transpose() * inverse * dense[k];
      CHECK((joint.block(row, column, expected.rows(), expected.cols()) - expected).norm() <=
            1e-9 * dense[i].norm() * dense[k].norm() * inverse.norm());
      column += expected.cols();
    }
    row += dense[i].cols();
  }
  CHECK(joint == joint.transpose());
  CHECK(Eigen::SelfAdjointEigenSolver<Matrix>(joint).eigenvalues()(0) > -1e-12 * joint.norm());

  Blocks<Pose> blocks;
  tree.covariances(keys, blocks);
  REQUIRE(blocks.of.size() == keys.size());
  for (const TreeKey& key : keys) {
    const std::vector<Eigen::Index> own = leaves.states_of(leaves.blocks[key.leaf]);
    CHECK(difference(blocks.of.at(key.leaf), inverse(own, own)) <= 1e-9);
  }
  Blocks<Pose> alone;
  const TreeKey& key = keys[growth.below(keys.size())];
  tree.covariances({key}, alone);
  REQUIRE(alone.of.size() == 1);
  CHECK(alone.of.begin()->second == blocks.of.at(key.leaf));  // independent of the other requests

  const Eigen::Index newest = states.at(base_variable(leaves.blocks.size()));
  CHECK(difference(tree.last_covariance(), inverse.block<Pose::kDof, Pose::kDof>(newest, newest)) <= 1e-9);
}

}  // namespace cairn::test
