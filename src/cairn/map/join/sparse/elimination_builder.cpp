// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/elimination_builder.hpp"

#include <algorithm>

namespace cairn {

template <class Pose>
FrontPointer EliminationBuilder<Pose>::build(const FrontPointer& old, TouchIterator begin, TouchIterator end) {
  int bit = begin->key.split((end - 1)->key);
  TreeKey key = begin->key;
  if (old != nullptr) {
    key = old->key;
    bit = std::min({bit, old->bit, begin->key.split(key), (end - 1)->key.split(key)});
  }
  if (bit == TreeKey::kBits) return loses(begin->key) ? nullptr : leaf(begin->key);
  const TouchIterator middle = std::find_if(begin, end, [&](const TreeTouch& item) { return item.key.bit(bit); });
  FrontPointer child[2];
  for (int side = 0; side < 2; ++side) {
    const TouchIterator from = side == 0 ? begin : middle, to = side == 0 ? middle : end;
    FrontPointer before;
    if (old != nullptr) {
      if (bit == old->bit)
        before = old->child[side];
      else if (old->key.bit(bit) == (side == 1))
        before = old;
    }
    const bool touched = std::any_of(from, to, [&](const TreeTouch& item) {
      return item.bit == TreeKey::kBits || (before != nullptr && before->bit <= item.bit);
    });
    child[side] = touched ? build(before, from, to) : before;
    if (failed_) return nullptr;
  }
  // A front that has lost one side vanishes: the fronts above it eliminate what it would have eliminated.
  if (child[0] == nullptr || child[1] == nullptr) return child[0] != nullptr ? child[0] : child[1];
  return make(bit, key, child, 2);
}

template <class Pose>
bool EliminationBuilder<Pose>::loses(const TreeKey& key) const {
  return std::any_of(removed_.begin(), removed_.end(),
                     [&](const TreeKey& removed) { return removed.split(key) == TreeKey::kBits; });
}

template <class Pose>
FrontPointer EliminationBuilder<Pose>::crown(const FrontPointer& top) {
  const FrontPointer child[2] = {top, nullptr};
  return make(TreeFront::kCrown, top->key, child, 1);
}

template <class Pose>
FrontPointer EliminationBuilder<Pose>::leaf(const TreeKey& key) {
  auto front = std::make_shared<TreeFront>();
  front->key = key;
  front->boundary = source_.variables(key.leaf);
  front->held.assign(front->boundary.size(), 1);
  front->b = dimension<Pose>(front->boundary);
  front->absolute = source_.absolute(key.leaf);
  if (!source_.kept(key.leaf)) return front;
  request(*front);
  front->complement.reserve(static_cast<std::size_t>(front->b * (front->b + 1) / 2));
  for (Index c = 0; c < front->b; ++c)
    front->complement.insert(front->complement.end(), leaf_.begin() + c * front->b + c,
                             leaf_.begin() + (c + 1) * front->b);
  return front;
}

// Puts the leaf's information into `leaf_`.
template <class Pose>
void EliminationBuilder<Pose>::request(const TreeFront& leaf) {
  leaf_.assign(static_cast<std::size_t>(leaf.b * leaf.b), 0.0);
  source_.information(leaf.key.leaf, leaf_.data(), leaf.b);
  assembled_.push_back(leaf.key.leaf);
}

// Adds a child's complement to the front's matrix.
template <class Pose>
void EliminationBuilder<Pose>::assemble(const TreeFront& child, const TreeFront& front, Index n) {
  const std::vector<Index> map = state_map<Pose>(child.boundary, front);
  const double* from = child.complement.data();
  Index ld_from = 0;  // 0: packed
  if (child.leaf() && child.complement.empty()) {
    request(child);
    from = leaf_.data();
    ld_from = child.b;
  }
  // Rows that lie next to each other in both matrices are added together.
  struct Run {
    Index from, to, end;
  };
  std::vector<Run> runs;
  for (Index r = 0; r < child.b; ++r) {
    if (runs.empty() || map[r] != runs.back().to + (r - runs.back().from)) runs.push_back({r, map[r], r});
    runs.back().end = r + 1;
  }
  for (Index c = 0; c < child.b; ++c) {
    const double* column = ld_from != 0 ? from + c * ld_from : from - c;
    const Index to = map[c];
    for (const Run& run : runs) {
      const Index first = std::max(run.from, c);
      if (first >= run.end) continue;
      const Index row = run.to + first - run.from;
      if (row >= to) {
        double* target = matrix_.data() + to * n + row;
        for (Index r = first; r < run.end; ++r) target[r - first] += column[r];
      } else {
        double* target = matrix_.data() + row * n + to;
        for (Index r = first; r < run.end; ++r) target[(r - first) * n] += column[r];
      }
    }
    if (ld_from == 0) from += child.b - c;
  }
}

template <class Pose>
FrontPointer EliminationBuilder<Pose>::make(int bit, const TreeKey& key, const FrontPointer child[2], int children) {
  auto front = std::make_shared<TreeFront>();
  front->bit = bit;
  front->key = key;
  for (int i = 0; i < children; ++i) {
    front->child[i] = child[i];
    front->absolute = front->absolute || child[i]->absolute;
  }
  sort_variables(*front, children);
  const Index e = front->e = dimension<Pose>(front->eliminated), b = front->b = dimension<Pose>(front->boundary),
              n = e + b;
  matrix_.assign(static_cast<std::size_t>(n * n), 0.0);
  for (int i = 0; i < children; ++i) assemble(*child[i], *front, n);
  if (workspace_.size() < eliminate_workspace(n)) workspace_.resize(eliminate_workspace(n));
  if (!eliminate(matrix_.data(), n, n, e, workspace_.data())) {
    failed_ = true;
    return nullptr;
  }
  front->factor.assign(matrix_.begin(), matrix_.begin() + e * n);
  front->complement.reserve(static_cast<std::size_t>(b * (b + 1) / 2));
  for (Index c = 0; c < b; ++c) {
    const double* column = matrix_.data() + (e + c) * n + e;
    front->complement.insert(front->complement.end(), column + c, column + b);
  }
  for (const Variable v : front->eliminated) eliminated_at_[v] = static_cast<std::int16_t>(bit);
  ++made_;
  return front;
}

// A front eliminates the variables that no other leaf holds; the crown eliminates all remaining ones, in ascending
// order.
template <class Pose>
void EliminationBuilder<Pose>::sort_variables(TreeFront& front, int children) {
  const auto take = [&](Variable v, std::int32_t held) {
    if (front.bit == TreeFront::kCrown || held == degree_[v]) {
      front.eliminated.push_back(v);
    } else {
      front.boundary.push_back(v);
      front.held.push_back(held);
    }
  };
  const TreeFront& a = *front.child[0];
  if (children == 1) {
    for (std::size_t i = 0; i < a.boundary.size(); ++i) take(a.boundary[i], a.held[i]);
    // The covariance of the variable that comes last is the last pivot's.
    const auto last = std::find(front.eliminated.rbegin(), front.eliminated.rend(), last_);
    if (last != front.eliminated.rend()) std::rotate(front.eliminated.rbegin(), last, last + 1);
    return;
  }
  const TreeFront& c = *front.child[1];
  std::size_t i = 0, j = 0;
  while (i < a.boundary.size() || j < c.boundary.size()) {
    if (j == c.boundary.size() || (i < a.boundary.size() && a.boundary[i] < c.boundary[j])) {
      take(a.boundary[i], a.held[i]);
      ++i;
    } else if (i == a.boundary.size() || c.boundary[j] < a.boundary[i]) {
      take(c.boundary[j], c.held[j]);
      ++j;
    } else {
      take(a.boundary[i], a.held[i] + c.held[j]);
      ++i, ++j;
    }
  }
}

template class EliminationBuilder<SE2>;
template class EliminationBuilder<SE3>;

}  // namespace cairn
