// SPDX-License-Identifier: BSD-3-Clause
// The information that the submaps of a sparse map add to its elimination tree.
#pragma once

#include "map/join/sparse/sparse_state.hpp"

namespace cairn {

// A submap's factor at the state, with the prior or the fixes of its bases.
template <class Pose>
class LeafInformation final : public LeafSource {
 public:
  explicit LeafInformation(const SparseState<Pose>& state) : state_(state) {}

  const std::vector<Variable>& variables(std::uint32_t leaf) const override { return state_.leaves[leaf].variables; }
  void information(std::uint32_t leaf, double* H, Index ld) const override;
  bool kept(std::uint32_t leaf) const override { return state_.leaves[leaf].place != nullptr; }
  bool absolute(std::uint32_t leaf) const override {
    return leaf == 0 || state_.leaves[leaf].fixed() || state_.solution.anchors.fixes_of(leaf) != nullptr;
  }

 private:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Rotation = typename Pose::Rotation;

  const SparseState<Pose>& state_;
};

extern template class LeafInformation<SE2>;
extern template class LeafInformation<SE3>;

}  // namespace cairn
