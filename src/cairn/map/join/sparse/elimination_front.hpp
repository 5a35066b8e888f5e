// SPDX-License-Identifier: BSD-3-Clause
// A front of the elimination tree. Included by the tree's own files alone.
#pragma once

#include "map/join/sparse/elimination_tree.hpp"

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
  std::vector<double> complement;    // packed lower triangle, b x b: what the boundary knows of what lies below

  bool leaf() const { return child[0] == nullptr; }
};

// Where the states of some of a front's variables (ascending) stand among its own: the eliminated ones, then the
// boundary.
template <class Pose>
std::vector<Index> state_map(const std::vector<Variable>& part, const TreeFront& front) {
  std::vector<Index> map;
  map.reserve(part.size() * 3);
  const auto add = [&](Variable v, Index at) {
    for (Index d = 0; d < dimension<Pose>(v); ++d) map.push_back(at + d);
  };
  const std::vector<Variable>&first = front.eliminated, &second = front.boundary;
  if (front.bit == TreeFront::kCrown) {
    for (const Variable v : part) {
      Index at = 0;
      for (std::size_t i = 0; first[i] != v; ++i) at += dimension<Pose>(first[i]);
      add(v, at);
    }
    return map;
  }
  std::size_t i = 0, j = 0;  // all three lists are ascending
  Index at_i = 0, at_j = front.e;
  for (const Variable v : part) {
    while (i < first.size() && first[i] < v) at_i += dimension<Pose>(first[i++]);
    while (j < second.size() && second[j] < v) at_j += dimension<Pose>(second[j++]);
    add(v, i < first.size() && first[i] == v ? at_i : at_j);
  }
  return map;
}

}  // namespace cairn
