// SPDX-License-Identifier: BSD-3-Clause
// An update's batch as gate_blocks() sees it: blocks of `rows` rows that are kept or removed where they stand.
#pragma once

#include "ekf/ekf_update.hpp"

namespace cairn {

// A class that knows more of its blocks derives from this one and hides what it does otherwise.
template <class Pose>
class UpdateGates {
 public:
  UpdateGates(EkfUpdate<Pose>& update, Index rows) : update_(update), rows_(rows) {}

  Index count() const { return update_.batch().rows() / rows_; }
  double distance(Index block) { return update_.distance(block, rows_); }
  void keep(const Index* blocks, Index count) { update_.keep(blocks, count, rows_); }
  template <class Bound>
  bool consistent(Bound&& bound) {
    update_.factor();
    return update_.nis() <= bound(update_.batch().rows());
  }
  InverseInnovation invert() { return update_.invert(); }
  void refactor() { update_.factor(); }
  Index* kept() { return update_.kept(); }
  bool* refused() { return update_.refused(); }

 protected:
  EkfUpdate<Pose>& update_;
  Index rows_;
};

}  // namespace cairn
