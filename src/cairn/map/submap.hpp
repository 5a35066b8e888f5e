// SPDX-License-Identifier: BSD-3-Clause
// A closed submap: the estimates of the vehicle's end pose and of the landmarks, in the frame of the submap's base,
// which is the pose at which the submap began. The base is the origin and is known exactly, so a submap is independent
// of all other submaps, given the systematic errors that they share. Absolute fixes tell where the base is in the map:
// of a submap that had some, the error of the base is one of the shared errors (docs/submaps.md, "Fixes").
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "ekf/error_model.hpp"
#include "map/shared_errors.hpp"

namespace cairn {

template <class Pose>
struct Submap {
  ErrorKind error = ErrorKind::invariant;
  Pose T_base_end;
  std::vector<std::uint64_t> ids;  // in the order in which they were placed
  std::vector<std::uint64_t> counts;
  std::vector<typename Pose::Point> landmarks;
  Eigen::MatrixXd covariance;  // of [end pose; landmarks], in the filter's own error coordinates
  SubmapErrors errors;         // none if the filter estimates no systematic errors and had no fixes
  // Where the base lay in the map when the submap began, if there were fixes: the last kDof of `errors` are the base's
  // ordinary error against this pose.
  std::optional<Pose> base;

  Eigen::Index size() const { return static_cast<Eigen::Index>(ids.size()); }
};

// The rows of these points, given by number, in a matrix whose first point begins at row `first`.
template <class Pose>
std::vector<Eigen::Index> point_rows(const std::vector<Eigen::Index>& numbers, Eigen::Index first) {
  std::vector<Eigen::Index> rows;
  rows.reserve(static_cast<std::size_t>(Pose::kDim) * numbers.size());
  for (const Eigen::Index i : numbers)
    for (Eigen::Index d = 0; d < Pose::kDim; ++d) rows.push_back(first + Pose::kDim * i + d);
  return rows;
}

// Converts the errors of these landmarks of a submap to ordinary errors, e_l = xi_l + G(l) xi_R: changes their rows and
// columns of the covariance. All other rows and columns stay in the filter's error coordinates. The second function
// converts the rows of a matrix whose columns are no errors of poses or landmarks.
template <class Pose>
void to_ordinary(const Submap<Pose>& submap, const std::vector<Eigen::Index>& landmarks, Eigen::MatrixXd& covariance);
template <class Pose>
void rows_to_ordinary(const Submap<Pose>& submap, const std::vector<Eigen::Index>& landmarks, Eigen::MatrixXd& rows);

}  // namespace cairn
