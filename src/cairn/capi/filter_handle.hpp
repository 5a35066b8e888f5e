// SPDX-License-Identifier: BSD-3-Clause
// Helpers that the files behind cairn/filter.h share.
#pragma once

#include <type_traits>
#include <vector>

#include "capi/guard.hpp"
#include "geometry/embedding.hpp"

namespace cairn {
namespace capi {

// Calls function(filter) for a filter of either kind; PoseOf<decltype(filter)> tells which kind it is.
template <class Handle, class Function>
void with_filter(Handle* filter, Function&& function) {
  check_pointer(filter, "filter");
  std::visit(function, filter->filter);
}
template <class AnyFilter>
using PoseOf = typename std::decay_t<AnyFilter>::PoseType;

// The C interface is spatial for both kinds of vehicle. A vehicle in the plane uses the part that lies in the plane.
template <class Pose>
typename AbsoluteFix<Pose>::PointSquare read_point_covariance(const double* covariance, const char* name) {
  check_pointer(covariance, name);
  const Eigen::Map<const Matrix3> whole(covariance);
  const typename AbsoluteFix<Pose>::PointSquare part = whole.topLeftCorner<Pose::kDim, Pose::kDim>();
  check_covariance(part.data(), Pose::kDim, false, name);
  return part;
}
template <class Pose>
typename Pose::Square read_pose_covariance(const double* covariance, const char* name) {
  check_pointer(covariance, name);
  const Matrix6 whole = Eigen::Map<const Matrix6>(covariance);
  const typename Pose::Square part = Embedding<Pose>::down(whole);
  check_covariance(part.data(), Pose::kDof, true, name);
  return part;
}

template <class Pose>
void write_estimate(const Pose& pose, const typename Pose::Square& covariance, cairn_pose* pose_out,
                    double* covariance_out) {
  if (covariance_out != nullptr) write_square<6>(Embedding<Pose>::up(covariance), covariance_out);
  if (pose_out != nullptr) write_pose(Embedding<Pose>::up(pose), pose_out);
}

// Indices of landmarks by their ids. An unknown id and a repeated id are refused.
std::vector<std::size_t> read_ids(const Landmarks& map, const std::uint64_t* ids, std::size_t count);

}  // namespace capi
}  // namespace cairn
