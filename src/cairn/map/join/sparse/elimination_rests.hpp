// SPDX-License-Identifier: BSD-3-Clause
// The rests of an elimination tree: small motions and forces that a front keeps instead of passing them on to the
// fronts below.
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "map/join/sparse/elimination_front.hpp"

namespace cairn {

class TreeRests {
 public:
  struct Rest {
    FrontPointer front;
    Eigen::VectorXd motion;  // motion of its boundary that was not handed down; empty: none
    Eigen::VectorXd y;  // L_EE^-1 times the forces on its eliminated variables that caused no motion yet; empty: none
    Eigen::VectorXd force;  // force of both on the boundary
  };
  // Ordered by key and bit: sums must not depend on the addresses of fronts in memory.
  using ByPlace = std::map<std::pair<TreeKey, int>, std::shared_ptr<const Rest>>;

  void keep(const FrontPointer& front, Eigen::VectorXd motion, Eigen::VectorXd y);
  Rest take(const TreeFront& front);  // an empty one if there is none
  bool empty() const { return by_place_.empty(); }
  const ByPlace& all() const { return by_place_; }

  // Fronts with a child that was carried in the last step. The factor belongs to older linearisation points. With it
  // the rigid motion would cause a force that does not exist: the next step computes these fronts' forces anew.
  void note_carried(const TreeFront& front) { carried_.push_back({front.key, front.bit}); }
  void take_carried(std::vector<TreeTouch>& touches) {
    touches.insert(touches.end(), carried_.begin(), carried_.end());
    carried_.clear();
  }

 private:
  ByPlace by_place_;
  std::vector<TreeTouch> carried_;
};

}  // namespace cairn
