// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/elimination_rests.hpp"

#include "map/join/sparse/packed.hpp"

namespace cairn {

void TreeRests::keep(const FrontPointer& front, Eigen::VectorXd motion, Eigen::VectorXd y) {
  if (motion.isZero(0.0)) motion.resize(0);
  if (y.isZero(0.0)) y.resize(0);
  if (motion.size() == 0 && y.size() == 0) return;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(front->b);
  if (motion.size() > 0) add_packed_product(front->complement.data(), front->b, -1.0, motion.data(), force.data());
  if (y.size() > 0) force.noalias() -= front->boundary_block() * y;
  by_place_[{front->key, front->bit}] =
      std::make_shared<const Rest>(Rest{front, std::move(motion), std::move(y), std::move(force)});
}

TreeRests::Rest TreeRests::take(const TreeFront& front) {
  const auto found = by_place_.find({front.key, front.bit});
  if (found == by_place_.end()) return Rest();
  Rest rest = *found->second;
  by_place_.erase(found);
  return rest;
}

}  // namespace cairn
