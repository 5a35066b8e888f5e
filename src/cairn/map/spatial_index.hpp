// SPDX-License-Identifier: BSD-3-Clause
// Finds near points: k-d trees (nanoflann) over points that are added in batches, move a little, and are removed.
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

// The owner stores the points and reports every change. Queries use the current positions. The first query that needs a
// tree builds it. Queries may run at the same time; a change must not run at the same time as any other call.
class SpatialIndex {
 public:
  // The current position of the point of an index; finite. Queries call it, from any thread.
  using Position = std::function<Vector3(std::size_t)>;
  struct Hit {
    double distance;
    std::size_t index;
  };
  // The distance that queries compare. It is compiled once: with fused multiply-adds the last bit depends on the
  // function into which it is inlined.
  static double distance(const Vector3& a, const Vector3& b);

  explicit SpatialIndex(Position position);
  ~SpatialIndex();
  SpatialIndex(const SpatialIndex&) = delete;
  SpatialIndex& operator=(const SpatialIndex&) = delete;

  std::size_t size() const { return size_; }
  bool contains(std::size_t index) const { return index < places_.size() && places_[index].tree != kNowhere; }

  // Adding an index that is present and removing one that is absent have no effect. An index may be used again.
  void add(std::size_t index);
  void remove(std::size_t index);
  void clear();
  // After the move. moved_all() costs nothing until the next query, which then looks at every point once.
  void moved(std::size_t index);
  void moved_all();

  // All points with distance <= radius, nearest first, ties by index.
  void within(const Vector3& centre, double radius, std::vector<Hit>& hits) const;
  // The `count` nearest points and all points at the distance of the last one, nearest first, ties by index. A caller
  // that breaks ties by something else sorts and cuts the result.
  void nearest(const Vector3& point, std::size_t count, std::vector<Hit>& hits) const;
  // All points in the closed box, by index; sides may be infinite.
  void in_box(const Vector3& lower, const Vector3& upper, std::vector<std::size_t>& indices) const;

  std::size_t memory_bytes() const;  // about

 private:
  struct Tree;
  struct Nearest;
  // The place of a point: in the tree of this number, or in the list of loose points, which is scanned.
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
  // A query may update the members below.
  mutable std::mutex mutex_;
  mutable std::atomic<bool> outdated_{false};
  mutable bool all_moved_ = false;
  mutable std::vector<Place> places_;
  mutable std::vector<std::uint32_t> loose_;
  mutable std::vector<std::unique_ptr<Tree>> trees_;
  mutable std::uint32_t next_tree_ = 0;
};

}  // namespace cairn
