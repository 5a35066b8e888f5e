// SPDX-License-Identifier: BSD-3-Clause
// Which points are near: k-d trees (nanoflann) over points that come in batches, move a little, and go.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "geometry/types.hpp"

namespace cairn {

// The points live with the owner, who tells of every change; what a query returns holds for where they are now. Trees
// are built by the first query that needs them. Queries may run side by side; a change may run beside nothing.
class SpatialIndex {
 public:
  // Where the point of an index is now; finite. Queries call it, from any thread.
  using Position = std::function<Vector3(std::size_t)>;
  struct Hit {
    double distance;
    std::size_t index;
  };
  // As queries measure: compiled once, for where sums of products are fused the last bit depends on who inlines them.
  static double distance(const Vector3& a, const Vector3& b);

  explicit SpatialIndex(Position position);
  ~SpatialIndex();
  SpatialIndex(const SpatialIndex&) = delete;
  SpatialIndex& operator=(const SpatialIndex&) = delete;

  std::size_t size() const { return size_; }
  bool contains(std::size_t index) const { return index < places_.size() && places_[index].tree != kNowhere; }

  // Adding one that is there, and removing one that isn't, does no harm. An index may be used again.
  void add(std::size_t index);
  void remove(std::size_t index);
  void clear();
  // After the move. moved_all() costs nothing until the next query, which then looks at every point once.
  void moved(std::size_t index);
  void moved_all();

  // All with distance <= radius, nearest first, ties by index.
  void within(const Vector3& centre, double radius, std::vector<Hit>& hits) const;
  // The `count` nearest and whoever is as far as the last of them, nearest first, ties by index: who breaks ties by
  // something else sorts and cuts.
  void nearest(const Vector3& point, std::size_t count, std::vector<Hit>& hits) const;
  // All in the closed box, by index; sides may be infinite.
  void in_box(const Vector3& lower, const Vector3& upper, std::vector<std::size_t>& indices) const;

  std::size_t memory_bytes() const;  // about

 private:
  struct Tree;
  struct Nearest;
  // Where a point is found: in the tree of this number, or, by a scan, in the list of loose points.
  struct Place {
    std::uint32_t tree, entry;
  };
  static constexpr std::uint32_t kNowhere = UINT32_MAX, kLoose = UINT32_MAX - 1;

  void prepare() const;
  void look_at_all() const;
  void rebuild() const;
  void leave(std::size_t index) const;
  void follow(std::size_t index) const;
  Tree& tree(std::uint32_t number) const;
  template <class Visit>
  void visit_near(const Tree& tree, const Vector3& centre, double radius, const Visit& visit) const;

  Position position_;
  std::size_t size_ = 0;
  // Below: what a query may bring up to date.
  mutable std::mutex mutex_;
  mutable std::atomic<bool> outdated_{false};
  mutable bool all_moved_ = false;
  mutable std::vector<Place> places_;
  mutable std::vector<std::uint32_t> loose_;
  mutable std::vector<std::unique_ptr<Tree>> trees_;
  mutable std::uint32_t next_tree_ = 0;
};

}  // namespace cairn
