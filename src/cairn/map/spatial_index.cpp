// SPDX-License-Identifier: BSD-3-Clause
// Trees of doubling sizes (Bentley and Saxe 1980): a batch becomes a tree, which absorbs trees that are not much
// larger. A point is copied O(log n) times. A tree stores the positions of its points at its construction, and the
// largest movement of any of them since then. A query extends its radius by that movement, and judges by the present
// positions. A point that moves too far leaves its tree.
#include "map/spatial_index.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <utility>

#include "core/compiler.hpp"

namespace cairn {
namespace {

constexpr std::size_t kMaxLoose = 48;  // points; a scan of so many is much faster than building a tree
constexpr std::size_t kLeaf = 12;      // points
constexpr double kSlack = 0.25;        // of the mean spacing: how far a point of a tree may move

// The square of a bound, enlarged so that rounding cannot exclude a point. Never zero: nanoflann compares by `<`.
double search_bound(double radius) {
  const double reach = radius * (1 + 1e-9);
  return std::max(reach * reach, DBL_MIN);
}

bool nearer(const SpatialIndex::Hit& a, const SpatialIndex::Hit& b) {
  return a.distance != b.distance ? a.distance < b.distance : a.index < b.index;
}

// nanoflann's result set for all entries within a radius.
template <class Visit>
struct Ball {
  double bound;
  const Visit& visit;
  std::size_t size() const { return 0; }
  bool full() const { return true; }
  bool empty() const { return false; }
  void sort() {}
  double worstDist() const { return bound; }
  bool addPoint(double, std::uint32_t entry) {
    visit(entry);
    return true;
  }
};

}  // namespace

struct SpatialIndex::Tree {
  using KdTree =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Tree>, Tree, 3, std::uint32_t>;

  std::uint32_t number;
  std::vector<std::uint32_t> indices;  // of the entries
  std::vector<Vector3> points;         // positions at the construction
  std::size_t live;                    // points that have not left
  double slack = 0, margin = 0;        // largest permitted movement, largest movement so far
  Vector3 lower, upper;
  std::unique_ptr<KdTree> kd;

  Tree(std::uint32_t tree_number, std::vector<std::uint32_t> members, const Position& position)
      : number(tree_number), indices(std::move(members)), live(indices.size()) {
    points.reserve(indices.size());
    for (std::uint32_t index : indices) points.push_back(position(index));
    lower = upper = points.front();
    for (const Vector3& p : points) {
      lower = lower.cwiseMin(p);
      upper = upper.cwiseMax(p);
    }
    const Vector3 side = upper - lower;
    const double count = static_cast<double>(live);
    const double area = side.x() * side.y() + side.y() * side.z() + side.z() * side.x();
    slack = kSlack * std::max(std::sqrt(area / count), side.sum() / count);
    kd = std::make_unique<KdTree>(3, *this, nanoflann::KDTreeSingleIndexAdaptorParams(kLeaf));
  }

  bool wasteful() const { return 2 * live < indices.size(); }

  // The interface that nanoflann requires.
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t entry, std::size_t axis) const {
    return points[entry][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

// The nearest points of all trees so far; nanoflann's result set for one tree.
struct SpatialIndex::Nearest {
  const SpatialIndex& index;
  const Vector3& point;
  std::size_t count;
  const Tree* tree = nullptr;
  std::vector<Hit> heap = {};  // the worst in front

  void offer(std::size_t i) {
    const Hit hit{distance(index.position_(i), point), i};
    if (heap.size() == count) {
      if (!nearer(hit, heap.front())) return;
      std::pop_heap(heap.begin(), heap.end(), nearer);
      heap.pop_back();
    }
    heap.push_back(hit);
    std::push_heap(heap.begin(), heap.end(), nearer);
  }
  std::size_t size() const { return heap.size(); }
  bool full() const { return heap.size() == count; }
  bool empty() const { return heap.empty(); }
  void sort() {}
  double worstDist() const {
    return full() ? search_bound(heap.front().distance + tree->margin) : std::numeric_limits<double>::infinity();
  }
  bool addPoint(double, std::uint32_t entry) {
    const std::uint32_t i = tree->indices[entry];
    if (index.places_[i].tree == tree->number) offer(i);
    return true;
  }
};

CAIRN_NEVER_INLINE double SpatialIndex::distance(const Vector3& a, const Vector3& b) {
  return (a - b).norm();
}

SpatialIndex::SpatialIndex(Position position) : position_(std::move(position)) {}
SpatialIndex::~SpatialIndex() = default;

void SpatialIndex::add(std::size_t index) {
  if (contains(index)) return moved(index);
  if (index >= places_.size()) places_.resize(index + 1, Place{kNowhere, 0});
  loose_.push_back(static_cast<std::uint32_t>(index));
  places_[index] = {kLoose, static_cast<std::uint32_t>(loose_.size() - 1)};
  ++size_;
  outdated_ = true;
}

void SpatialIndex::remove(std::size_t index) {
  if (!contains(index)) return;
  leave(index);
  places_[index].tree = kNowhere;
  --size_;
  outdated_ = true;  // its tree may have become wasteful
}

void SpatialIndex::clear() {
  places_.clear();
  loose_.clear();
  trees_.clear();
  size_ = 0;
  all_moved_ = false;
  outdated_ = false;
}

void SpatialIndex::moved(std::size_t index) {
  if (contains(index)) follow(index);
}

void SpatialIndex::moved_all() {
  all_moved_ = true;
  outdated_ = true;
}

SpatialIndex::Tree& SpatialIndex::tree(std::uint32_t number) const {
  // About log(number of points) trees, the largest first.
  return **std::find_if(trees_.begin(), trees_.end(), [&](const auto& tree) { return tree->number == number; });
}

// Removes a point from its tree or from the loose points. The caller sets its new place.
void SpatialIndex::leave(std::size_t index) const {
  const Place place = places_[index];
  if (place.tree == kLoose) {
    loose_[place.entry] = loose_.back();
    places_[loose_.back()].entry = place.entry;
    loose_.pop_back();
  } else {
    --tree(place.tree).live;
  }
}

void SpatialIndex::follow(std::size_t index) const {
  Place& place = places_[index];
  if (place.tree == kLoose) return;
  Tree& home = tree(place.tree);
  const double strayed = (position_(index) - home.points[place.entry]).norm();
  if (strayed <= home.slack) {
    home.margin = std::max(home.margin, strayed);
  } else {
    loose_.push_back(static_cast<std::uint32_t>(index));  // may throw, so it comes first
    --home.live;
    place = {kLoose, static_cast<std::uint32_t>(loose_.size() - 1)};
    outdated_ = true;
  }
}

void SpatialIndex::look_at_all() const {
  for (const auto& tree : trees_) tree->margin = 0;  // some points may have moved back
  for (std::size_t i = 0; i < places_.size(); ++i)
    if (places_[i].tree != kNowhere) follow(i);
}

// Nothing changes before the new tree is complete.
void SpatialIndex::rebuild() const {
  std::vector<std::uint32_t> members = loose_;
  std::vector<bool> swallowed(trees_.size(), false);
  for (bool again = true; again;) {
    again = false;
    for (std::size_t t = 0; t < trees_.size(); ++t) {
      const Tree& old = *trees_[t];
      if (swallowed[t] || (!old.wasteful() && old.live > 2 * members.size())) continue;
      for (std::uint32_t index : old.indices)
        if (places_[index].tree == old.number) members.push_back(index);
      swallowed[t] = again = true;
    }
  }
  std::sort(members.begin(), members.end());
  trees_.reserve(trees_.size() + 1);
  std::unique_ptr<Tree> made;
  if (!members.empty()) made = std::make_unique<Tree>(next_tree_++, std::move(members), position_);

  for (std::size_t t = 0; t < swallowed.size(); ++t)
    if (swallowed[t]) trees_[t].reset();
  trees_.erase(std::remove(trees_.begin(), trees_.end(), nullptr), trees_.end());
  loose_.clear();
  if (made == nullptr) return;
  for (std::size_t entry = 0; entry < made->indices.size(); ++entry)
    places_[made->indices[entry]] = {made->number, static_cast<std::uint32_t>(entry)};
  trees_.push_back(std::move(made));
  std::sort(trees_.begin(), trees_.end(), [](const auto& a, const auto& b) { return a->live > b->live; });
}

void SpatialIndex::prepare() const {
  if (!outdated_.load(std::memory_order_acquire)) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!outdated_.load(std::memory_order_relaxed)) return;
  if (all_moved_) look_at_all();
  all_moved_ = false;
  if (loose_.size() > kMaxLoose ||
      std::any_of(trees_.begin(), trees_.end(), [](const auto& tree) { return tree->wasteful(); }))
    rebuild();
  outdated_.store(false, std::memory_order_release);
}

template <class Visit>
void SpatialIndex::visit_near(const Tree& tree, const Vector3& centre, double radius, const Visit& visit) const {
  const auto if_here = [&](std::uint32_t entry) {
    const std::uint32_t index = tree.indices[entry];
    if (places_[index].tree == tree.number) visit(index);
  };
  Ball<decltype(if_here)> ball{search_bound(radius + tree.margin), if_here};
  tree.kd->findNeighbors(ball, centre.data(), {});
}

void SpatialIndex::within(const Vector3& centre, double radius, std::vector<Hit>& hits) const {
  prepare();
  hits.clear();
  if (!(radius >= 0)) return;
  const auto take = [&](std::uint32_t index) {
    const double away = distance(position_(index), centre);
    if (away <= radius) hits.push_back({away, index});
  };
  for (std::uint32_t index : loose_) take(index);
  for (const auto& tree : trees_) visit_near(*tree, centre, radius, take);
  std::sort(hits.begin(), hits.end(), nearer);
}

void SpatialIndex::nearest(const Vector3& point, std::size_t count, std::vector<Hit>& hits) const {
  prepare();
  hits.clear();
  if (count == 0 || size_ == 0) return;
  double radius = std::numeric_limits<double>::infinity();
  if (count < size_) {
    Nearest best{*this, point, count};
    best.heap.reserve(count + 1);
    for (std::uint32_t index : loose_) best.offer(index);
    for (const auto& tree : trees_) {
      best.tree = tree.get();
      tree->kd->findNeighbors(best, point.data(), {});
    }
    radius = best.heap.front().distance;
  }
  within(point, radius, hits);
}

void SpatialIndex::in_box(const Vector3& lower, const Vector3& upper, std::vector<std::size_t>& indices) const {
  constexpr int kHalvings = 7;
  struct Box {
    Vector3 lower, upper;
    int halvings;
  };
  prepare();
  indices.clear();
  if (!(lower.array() <= upper.array()).all()) return;
  const auto take = [&](std::uint32_t index) {
    const Vector3 p = position_(index);
    if ((p.array() >= lower.array()).all() && (p.array() <= upper.array()).all()) indices.push_back(index);
  };
  for (std::uint32_t index : loose_) take(index);
  std::vector<Box> boxes;
  for (const auto& tree : trees_) {
    // The part of the box where the tree has points, in pieces that are not much smaller than the balls around them.
    const Vector3 margin = Vector3::Constant(tree->margin);
    boxes.push_back({lower.cwiseMax(tree->lower - margin), upper.cwiseMin(tree->upper + margin), 0});
    while (!boxes.empty()) {
      const Box box = boxes.back();
      boxes.pop_back();
      const Vector3 side = box.upper - box.lower, centre = box.lower + 0.5 * side;
      if (side.minCoeff() < 0) continue;
      Eigen::Index longest = 0;
      const double length = side.maxCoeff(&longest);
      Vector3 others = side;
      others[longest] = 0;
      if (length > 1.5 * others.maxCoeff() && box.halvings < kHalvings) {
        Box low = box, high = box;
        low.upper[longest] = high.lower[longest] = centre[longest];
        low.halvings = high.halvings = box.halvings + 1;
        boxes.push_back(low);
        boxes.push_back(high);
      } else {
        visit_near(*tree, centre, 0.5 * side.norm() + 1e-9 * (box.lower.norm() + box.upper.norm()), take);
      }
    }
  }
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
}

std::size_t SpatialIndex::memory_bytes() const {
  std::size_t sum = places_.capacity() * sizeof(Place) + loose_.capacity() * sizeof(std::uint32_t);
  for (const auto& tree : trees_)
    sum += tree->points.capacity() * sizeof(Vector3) + tree->indices.capacity() * sizeof(std::uint32_t) +
           tree->kd->usedMemory(*tree->kd);
  return sum;
}

}  // namespace cairn
