// SPDX-License-Identifier: BSD-3-Clause
// The blocks of a state, and those of an update's window, cover every state exactly once.
#include "ekf/state_layout.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"
#include "sensor/sensor.hpp"

using namespace cairn;

namespace {

template <class Pose>
StateLayout<Pose> layout_of(Index companions, Index points, Index errors = 0) {
  StateLayout<Pose> layout;
  layout.clear(errors);
  for (Index k = 0; k < companions; ++k) layout.add_companion();
  layout.add_points(points);
  return layout;
}

// The number of blocks to which each state belongs; blocks that reach outside are ignored.
class Cover {
 public:
  explicit Cover(Index states) : times_(static_cast<std::size_t>(states), 0) {}
  void add(Index offset, Index size) {
    inside_ = inside_ && size > 0 && offset >= 0 && offset + size <= static_cast<Index>(times_.size());
    for (Index i = offset; inside_ && i < offset + size; ++i) ++times_[static_cast<std::size_t>(i)];
  }
  bool exact() const {
    return inside_ && std::all_of(times_.begin(), times_.end(), [](int times) { return times == 1; });
  }

 private:
  bool inside_ = true;
  std::vector<int> times_;
};

bool same(const Block& a, const Block& b) {
  return a.offset == b.offset && a.size == b.size && a.retraction == b.retraction && a.number == b.number;
}

}  // namespace

TEST_CASE_TEMPLATE("state layout: the blocks tile the states", Pose, SE2, SE3) {
  using Layout = StateLayout<Pose>;
  for (Index companions = 0; companions <= 3; ++companions)
    for (Index points = 0; points <= 5; ++points) {
      CAPTURE(companions);
      CAPTURE(points);
      const Layout layout = layout_of<Pose>(companions, points);
      CHECK(layout.companions() == companions);
      CHECK(layout.points() == points);
      CHECK(layout.states() == Pose::kDof + Pose::kTurn * companions + Pose::kDim * points);
      CHECK(layout.states() == Layout::states(companions, points));
      REQUIRE(layout.blocks() == 1 + companions + points);

      Cover cover(layout.states());
      Index end = 0;
      for (Index b = 0; b < layout.blocks(); ++b) {
        const Block block = layout.block(b);
        CHECK(block.offset == end);  // blocks are in the order of their numbers
        end = block.offset + block.size;
        cover.add(block.offset, block.size);
      }
      CHECK(cover.exact());
      CHECK(end == layout.states());

      CHECK(same(layout.block(0), {0, Pose::kDof, Retraction::pose, 0}));
      CHECK(same(layout.block(0), Layout::pose()));
      for (Index k = 0; k < companions; ++k) {
        const Block block = layout.block(1 + k);
        CHECK(same(block, layout.attitude(k)));
        CHECK(block.size == Pose::kTurn);
        CHECK((block.retraction == Retraction::attitude && block.number == k));
      }
      for (Index slot = 0; slot < points; ++slot) {
        const Block block = layout.block(1 + companions + slot);
        CHECK(same(block, layout.point(slot)));
        CHECK(block.size == Pose::kDim);
        CHECK((block.retraction == Retraction::point && block.number == slot));
      }
      CHECK(layout.lead() == layout.point(0).offset);
    }
}

TEST_CASE_TEMPLATE("state layout: adding and removing in any order gives the same blocks", Pose, SE2, SE3) {
  StateLayout<Pose> layout = layout_of<Pose>(3, 5);
  layout.remove_last_companion();
  layout.remove_last_point();
  layout.add_points(2);
  layout.remove_last_companion();
  layout.remove_last_point();
  layout.remove_last_point();
  const StateLayout<Pose> expected = layout_of<Pose>(1, 4);
  REQUIRE(layout.blocks() == expected.blocks());
  for (Index b = 0; b < layout.blocks(); ++b) CHECK(same(layout.block(b), expected.block(b)));
  layout.clear();
  CHECK(layout.blocks() == 1);
  CHECK(layout.states() == Pose::kDof);
}

TEST_CASE_TEMPLATE("state layout: the blocks tile an update's window", Pose, SE2, SE3) {
  for (const Index mount : {Index(0), Index(kMountErrors<Pose>)})
    for (Index points = 0; points <= 5; ++points) {
      const Index errors = points % 3;
      CAPTURE(mount);
      CAPTURE(points);
      const WindowLayout<Pose> window(errors, mount, points);
      CHECK(window.mount_size() == mount);
      CHECK(window.points() == points);
      CHECK(window.moving() == Pose::kDof + errors);
      CHECK(window.columns() == Pose::kDof + errors + mount + Pose::kDim * points);
      Cover cover(window.columns());
      cover.add(StateLayout<Pose>::pose().offset, Pose::kDof);
      if (errors > 0) cover.add(Pose::kDof, errors);
      if (mount > 0) cover.add(window.mount(), mount);
      for (Index a = 0; a < points; ++a) cover.add(window.point(a), Pose::kDim);
      CHECK(cover.exact());
    }
}

TEST_CASE_TEMPLATE("state layout: systematic errors follow the pose", Pose, SE2, SE3) {
  const StateLayout<Pose> layout = layout_of<Pose>(2, 4, 5);
  CHECK(layout.systematic() == 5);
  CHECK(layout.moving() == Pose::kDof + 5);
  CHECK(layout.states() == StateLayout<Pose>::states(2, 4, 5));
  REQUIRE(layout.blocks() == 1 + 1 + 2 + 4);
  CHECK(same(layout.block(1), {Pose::kDof, 5, Retraction::number, 0}));
  CHECK(same(layout.block(2), layout.attitude(0)));
  CHECK(same(layout.block(4), layout.point(0)));
  Index end = 0;
  for (Index b = 0; b < layout.blocks(); ++b) {
    CHECK(layout.block(b).offset == end);
    end += layout.block(b).size;
  }
  CHECK(end == layout.states());
}
