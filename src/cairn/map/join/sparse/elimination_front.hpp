// SPDX-License-Identifier: BSD-3-Clause
// A front of the elimination tree: a dense matrix over the variables that it eliminates and those of its boundary.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "map/join/sparse/tree_key.hpp"
#include "map/join/sparse/variable.hpp"

namespace cairn {

struct TreeFront {
  static constexpr int kCrown = -1;  // as its bit

  std::shared_ptr<const TreeFront> child[2];  // none: a leaf
  TreeKey key;                                // of some leaf below
  int bit = TreeKey::kBits;
  bool absolute = false;             // whether a leaf below is
  std::vector<Variable> eliminated;  // in the order of elimination
  std::vector<Variable> boundary;    // ascending
  std::vector<std::int32_t> held;    // leaves below that hold a variable of the boundary
  Index e = 0, b = 0;                // states of both
  std::vector<double> factor;        // (e + b) x e, column-major: L_EE over L_BE
  // Packed lower triangle, b x b: information of the leaves below on the boundary. Of a leaf only if its source says
  // so.
  std::vector<double> complement;

  bool leaf() const { return child[0] == nullptr; }
  using Block = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  Block eliminated_block() const { return Block(factor.data(), e, e, Eigen::OuterStride<>(e + b)); }    // L_EE
  Block boundary_block() const { return Block(factor.data() + e, b, e, Eigen::OuterStride<>(e + b)); }  // L_BE
};
using FrontPointer = std::shared_ptr<const TreeFront>;

// Memory of a front and all fronts below it.
std::size_t memory_bytes(const TreeFront& front);

// The offsets of the states of some of a front's variables (ascending) among all its states: the eliminated ones, then
// the boundary.
template <class Pose>
std::vector<Index> state_map(const std::vector<Variable>& part, const TreeFront& front);

}  // namespace cairn
