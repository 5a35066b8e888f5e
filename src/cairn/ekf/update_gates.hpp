// SPDX-License-Identifier: BSD-3-Clause
// The interface between an update's batch and gate_blocks(): blocks of `rows` rows that are kept or removed in place.
#pragma once

#include "ekf/ekf_update.hpp"

namespace cairn {

// A class that knows more about its blocks derives from this one and hides the functions that it replaces.
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
    return count() == 0 || update_.nis() <= bound(update_.batch().rows());  // a batch without rows has no bound
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
