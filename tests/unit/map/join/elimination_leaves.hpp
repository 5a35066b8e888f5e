// SPDX-License-Identifier: BSD-3-Clause
// Leaves of an elimination tree with a dense inverse, and a receiver of the tree's covariances.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "map/join/sparse/elimination_tree.hpp"

namespace cairn::test {

using Matrix = Eigen::MatrixXd;

struct LeafBlock {
  TreeKey key;
  std::vector<Variable> variables;  // ascending; none once it was removed
  Matrix information;
};

// Leaves of the tree, and the information of all leaves in one dense matrix.
template <class Pose>
class Leaves final : public LeafSource {
 public:
  std::vector<LeafBlock> blocks;
  bool relative = false;  // all leaves but the first know only differences

  bool absolute(std::uint32_t leaf) const override { return !relative || leaf == 0; }
  const std::vector<Variable>& variables(std::uint32_t leaf) const override { return blocks[leaf].variables; }
  void information(std::uint32_t leaf, double* H, Index ld) const override {
    const Matrix& own = blocks[leaf].information;
    for (Eigen::Index c = 0; c < own.cols(); ++c)
      for (Eigen::Index r = c; r < own.rows(); ++r) H[c * ld + r] = own(r, c);
  }
  std::map<Variable, Eigen::Index> states() const {
    std::map<Variable, Eigen::Index> at;
    for (const LeafBlock& block : blocks)
      for (const Variable v : block.variables) at[v] = 0;
    Eigen::Index next = 0;
    for (auto& [v, state] : at) {
      state = next;
      next += dimension<Pose>(v);
    }
    return at;
  }
  std::vector<Eigen::Index> states_of(const LeafBlock& block) const {
    const auto at = states();
    std::vector<Eigen::Index> out;
    for (const Variable v : block.variables)
      for (Index d = 0; d < dimension<Pose>(v); ++d) out.push_back(at.at(v) + d);
    return out;
  }
  Matrix inverse() const {
    const auto at = states();
    const Eigen::Index n = at.rbegin()->second + dimension<Pose>(at.rbegin()->first);
    Matrix H = Matrix::Zero(n, n);
    for (const LeafBlock& block : blocks) {
      const std::vector<Eigen::Index> own = states_of(block);
      H(own, own) += block.information;
    }
    return H.ldlt().solve(Matrix::Identity(n, n));
  }
  std::int32_t degree(Variable v) const {
    std::int32_t count = 0;
    for (const LeafBlock& block : blocks)
      count += std::binary_search(block.variables.begin(), block.variables.end(), v) ? 1 : 0;
    return count;
  }
};

template <class Pose>
class Blocks final : public EliminationTree<Pose>::Covariances {
 public:
  void leaf(std::uint32_t leaf, const Matrix& covariance) override { CHECK(of.emplace(leaf, covariance).second); }
  std::map<std::uint32_t, Matrix> of;
};

// The motion of all variables under a shift of the map: a column for each direction.
template <class Pose>
Matrix shifts(const std::vector<Variable>& variables) {
  Matrix columns = Matrix::Zero(dimension<Pose>(variables), Pose::kDim);
  Index row = 0;
  for (const Variable v : variables) {
    columns.middleRows<Pose::kDim>(row).setIdentity();
    row += dimension<Pose>(v);
  }
  return columns;
}

// Relative to b.
inline double difference(const Matrix& a, const Matrix& b) {
  return (a - b).norm() / (1e-300 + b.norm());
}

}  // namespace cairn::test
