// SPDX-License-Identifier: BSD-3-Clause
// Keys, and the tree's factorisation.
#include "map/join/sparse/elimination_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linear/triangle.hpp"
#include "map/join/sparse/elimination_front.hpp"
#include "map/join/sparse/elimination_solve.hpp"

namespace cairn {
namespace {

constexpr int kCells = 21;  // bits of a coordinate
constexpr std::int16_t kNever = std::numeric_limits<std::int16_t>::max();
constexpr int kCrown = TreeFront::kCrown;

// Every third bit from bit 0 on.
std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x001f00000000ffffULL;
  x = (x | x << 16) & 0x001f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2) & 0x1249249249249249ULL;
}

std::uint64_t cell(double offset) {
  // The origin stands a third of the way through cells of every size, so that no large cell's wall comes near it.
  constexpr double kOrigin = (1 << kCells) / 3.0;
  constexpr double kLast = (1 << kCells) - 1;
  const double c = std::floor(offset + kOrigin);
  return static_cast<std::uint64_t>(c > 0.0 ? std::min(c, kLast) : 0.0);
}

int leading_zeros(std::uint64_t x) {
  return x == 0 ? 64 : __builtin_clzll(x);
}

}  // namespace

TreeKey::TreeKey(const Vector3& offset, std::uint32_t leaf_number)
    : place((spread(cell(offset.x())) << 2 | spread(cell(offset.y())) << 1 | spread(cell(offset.z()))) << 1),
      leaf(leaf_number) {}

int TreeKey::split(const TreeKey& other) const {
  if (place != other.place) return leading_zeros(place ^ other.place);
  return 32 + leading_zeros(leaf ^ other.leaf);  // 96 where both are equal
}

namespace {

struct Item {
  TreeKey key;
  int bit;  // fronts on the key's path down to and with this bit are to be made anew
  bool operator<(const Item& other) const { return key < other.key; }
};
using Items = std::vector<Item>;
using ItemIterator = Items::const_iterator;

using Front = TreeFront;
using FrontPointer = std::shared_ptr<const Front>;

// Makes the fronts of one update.
template <class Pose>
class Builder {
 public:
  Builder(const LeafSource& source, const std::vector<std::int32_t>& degree, std::vector<std::int16_t>& eliminated_at,
          std::vector<std::uint32_t>& assembled)
      : source_(source), degree_(degree), eliminated_at_(eliminated_at), assembled_(assembled) {}

  // Items of one subtree, sorted by key. Null where a pivot failed.
  FrontPointer build(const FrontPointer& old, ItemIterator begin, ItemIterator end) {
    int bit = begin->key.split((end - 1)->key);
    TreeKey key = begin->key;
    if (old != nullptr) {
      key = old->key;
      bit = std::min({bit, old->bit, begin->key.split(key), (end - 1)->key.split(key)});
    }
    if (bit == TreeKey::kBits) return leaf(begin->key);
    const ItemIterator middle = std::find_if(begin, end, [&](const Item& item) { return item.key.bit(bit); });
    FrontPointer child[2];
    for (int side = 0; side < 2; ++side) {
      const ItemIterator from = side == 0 ? begin : middle, to = side == 0 ? middle : end;
      FrontPointer before;
      if (old != nullptr) {
        if (bit == old->bit)
          before = old->child[side];
        else if (old->key.bit(bit) == (side == 1))
          before = old;
      }
      const bool touched = std::any_of(from, to, [&](const Item& item) {
        return item.bit == TreeKey::kBits || (before != nullptr && before->bit <= item.bit);
      });
      child[side] = touched ? build(before, from, to) : before;
      if (child[side] == nullptr) return nullptr;
    }
    return make(bit, key, child, 2);
  }

  FrontPointer crown(const FrontPointer& top) {
    const FrontPointer child[2] = {top, nullptr};
    return make(kCrown, top->key, child, 1);
  }

  std::size_t made() const { return made_; }

 private:
  FrontPointer leaf(const TreeKey& key) {
    auto front = std::make_shared<Front>();
    front->key = key;
    front->boundary = source_.variables(key.leaf);
    front->held.assign(front->boundary.size(), 1);
    front->b = dimension<Pose>(front->boundary);
    front->absolute = source_.absolute(key.leaf);
    return front;
  }

  // Adds a child's complement to the front's matrix.
  void assemble(const Front& child, const Front& front, Index n) {
    const std::vector<Index> map = state_map<Pose>(child.boundary, front);
    const double* from = child.complement.data();
    Index ld_from = 0;  // 0: packed
    if (child.leaf()) {
      leaf_.assign(static_cast<std::size_t>(child.b * child.b), 0.0);
      source_.information(child.key.leaf, leaf_.data(), child.b);
      assembled_.push_back(child.key.leaf);
      from = leaf_.data();
      ld_from = child.b;
    }
    for (Index c = 0; c < child.b; ++c) {
      const double* column = ld_from != 0 ? from + c * ld_from : from - c;
      const Index to = map[c];
      for (Index r = c; r < child.b; ++r) {
        const Index row = map[r];
        matrix_[row >= to ? to * n + row : row * n + to] += column[r];
      }
      if (ld_from == 0) from += child.b - c;
    }
  }

  FrontPointer make(int bit, const TreeKey& key, const FrontPointer child[2], int children) {
    auto front = std::make_shared<Front>();
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
    const std::size_t workspace =
        std::max({cholesky_workspace(e), solve_workspace(e), update_triangle_workspace(b, e)});
    if (workspace_.size() < workspace) workspace_.resize(workspace);
    if (!cholesky(matrix_.data(), n, e, workspace_.data())) return nullptr;
    if (b > 0 && e > 0) {
      solve_right_transposed(matrix_.data(), n, e, matrix_.data() + e, n, b, workspace_.data());
      const TriangleTerm term{matrix_.data() + e, n, matrix_.data() + e, n, e, -1.0};
      update_triangle(matrix_.data() + e * (n + 1), n, b, &term, 1, workspace_.data());
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

  // What no leaf elsewhere holds is eliminated; the crown eliminates the rest, in ascending order.
  void sort_variables(Front& front, int children) {
    const auto take = [&](Variable v, std::int32_t held) {
      if (front.bit == kCrown || held == degree_[v]) {
        front.eliminated.push_back(v);
      } else {
        front.boundary.push_back(v);
        front.held.push_back(held);
      }
    };
    const Front& a = *front.child[0];
    if (children == 1) {
      for (std::size_t i = 0; i < a.boundary.size(); ++i) take(a.boundary[i], a.held[i]);
      // The newest base comes last: its covariance is then the last pivot's.
      const auto newest =
          std::find_if(front.eliminated.rbegin(), front.eliminated.rend(), [](Variable v) { return !is_landmark(v); });
      if (newest != front.eliminated.rend()) std::rotate(front.eliminated.rbegin(), newest, newest + 1);
      return;
    }
    const Front& c = *front.child[1];
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

  const LeafSource& source_;
  const std::vector<std::int32_t>& degree_;
  std::vector<std::int16_t>& eliminated_at_;
  std::vector<std::uint32_t>& assembled_;
  std::vector<double> matrix_, leaf_, workspace_;
  std::size_t made_ = 0;
};

std::size_t bytes_below(const Front& front) {
  std::size_t bytes = sizeof front + sizeof(double) * (front.factor.capacity() + front.complement.capacity()) +
                      4 * (front.eliminated.capacity() + front.boundary.capacity() + front.held.capacity());
  for (const auto& child : front.child)
    if (child != nullptr) bytes += bytes_below(*child);
  return bytes;
}

}  // namespace

template <class Pose>
void EliminationTree<Pose>::set_degree(Variable v, std::int32_t degree) {
  if (static_cast<std::size_t>(v) >= degree_.size()) {
    degree_.resize(static_cast<std::size_t>(v) + 1, 0);
    eliminated_at_.resize(static_cast<std::size_t>(v) + 1, kNever);
  }
  degree_[v] = degree;
}

template <class Pose>
bool EliminationTree<Pose>::update(const LeafSource& source, const Changes& changes, std::size_t& refactored,
                                   std::vector<std::uint32_t>& assembled) {
  Items items;
  for (const TreeKey& key : changes.leaves) items.push_back({key, TreeKey::kBits});
  for (const auto& [v, key] : changes.variables)
    if (eliminated_at(v) != kNever) items.push_back({key, eliminated_at(v)});
  if (items.empty()) return true;
  std::stable_sort(items.begin(), items.end());
  std::vector<std::int16_t> eliminated_at = eliminated_at_;
  assembled.clear();
  Builder<Pose> builder(source, degree_, eliminated_at, assembled);
  const FrontPointer top = builder.build(crown_ != nullptr ? crown_->child[0] : nullptr, items.begin(), items.end());
  const FrontPointer crown = top != nullptr ? builder.crown(top) : nullptr;
  if (crown == nullptr) return false;
  crown_ = crown;
  eliminated_at_ = std::move(eliminated_at);
  refactored = builder.made();
  return true;
}

template <class Pose>
Eigen::MatrixXd EliminationTree<Pose>::last_covariance() const {
  const Front& front = *crown_;
  const Index d = dimension<Pose>(front.eliminated.back()), n = front.e;
  Eigen::MatrixXd inverse(d, d);
  inverse_from_cholesky(front.factor.data() + (n - d) * (n + 1), n, d, inverse.data(), d);
  return inverse;
}

template <class Pose>
std::size_t EliminationTree<Pose>::memory_bytes() const {
  return crown_ != nullptr ? bytes_below(*crown_) : 0;
}

template class EliminationTree<SE2>;
template class EliminationTree<SE3>;

}  // namespace cairn
