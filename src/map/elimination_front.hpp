// SPDX-License-Identifier: BSD-3-Clause
// A front of the elimination tree. Included by the tree's own files alone.
#pragma once

#include "map/elimination_tree.hpp"

namespace cairn {

struct EliminationTree::Front {
  FrontPointer child[2];  // none: a leaf
  TreeKey key;            // of some leaf below
  int bit = TreeKey::kBits;
  bool absolute = false;             // whether a leaf below is
  std::vector<Variable> eliminated;  // in the order of elimination
  std::vector<Variable> boundary;    // ascending
  std::vector<std::int32_t> held;    // leaves below that hold a variable of the boundary
  Index e = 0, b = 0;                // states of both
  std::vector<double> factor;        // (e + b) x e, column-major: L_EE over L_BE
  std::vector<double> complement;    // packed lower triangle, b x b: what the boundary knows of what lies below

  bool leaf() const { return child[0] == nullptr; }
};

// Where the states of some of a front's variables (ascending) stand among its own: the eliminated ones, then the
// boundary.
std::vector<Index> state_map(const std::vector<Variable>& part, const EliminationTree::Front& front);

}  // namespace cairn
