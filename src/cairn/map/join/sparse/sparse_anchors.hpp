// SPDX-License-Identifier: BSD-3-Clause
// The information that fixes a sparse map in its frame: the prior of its first base, and absolute fixes of the ends of
// its submaps, by leaf.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "sensor/absolute_fix.hpp"

namespace cairn {

template <class Pose>
class SparseAnchors {
 public:
  using Square = typename Pose::Square;
  using Fixes = std::vector<AbsoluteFix<Pose>>;

  SparseAnchors(const Pose& prior, const Square& covariance) : prior_(prior), prior_covariance_(covariance) {}

  const Pose& prior() const { return prior_; }
  const Square& prior_covariance() const { return prior_covariance_; }
  void set_prior(const Pose& prior, const Square& covariance) { prior_ = prior, prior_covariance_ = covariance; }
  Square prior_information() const;
  // Derivative of pose_error(base, prior) by the ordinary error of the base.
  Square prior_jacobian(const Pose& base) const { return pose_error_jacobian(base, prior_); }

  void add(std::uint32_t leaf, const AbsoluteFix<Pose>& fix) { fixes_[leaf].push_back(fix); }
  // Null if there is none.
  const Fixes* fixes_of(std::uint32_t leaf) const {
    const auto found = fixes_.find(leaf);
    return found != fixes_.end() ? &found->second : nullptr;
  }
  const std::map<std::uint32_t, Fixes>& fixes() const { return fixes_; }

 private:
  Pose prior_;
  Square prior_covariance_;
  std::map<std::uint32_t, Fixes> fixes_;
};

extern template class SparseAnchors<SE2>;
extern template class SparseAnchors<SE3>;

}  // namespace cairn
