// SPDX-License-Identifier: BSD-3-Clause
// Covariances of a sparse map, recovered from its factor when they are asked for.
#pragma once

#include <cstdint>
#include <mutex>
#include <vector>

#include "map/join/sparse/sparse_state.hpp"

namespace cairn {

// Covariances of single landmarks, kept until the map changes. Queries may run at the same time.
template <class Pose>
class SparseCovariances {
 public:
  using PointSquare = typename Pose::Rotation::Matrix;

  // By selected inversion. Several landmarks together are cheaper.
  void prepare(const SparseState<Pose>& state, const std::vector<std::size_t>& indices);
  PointSquare of(const SparseState<Pose>& state, std::size_t index);
  // Of one landmark that is asked for alone: on its path to the crown, which is cheaper. The last bits differ, so that
  // each way keeps to its own results, and no answer depends on earlier queries.
  PointSquare alone(const SparseState<Pose>& state, std::size_t index);

 private:
  enum class By : std::uint8_t { nothing, path, inversion };
  struct Found {
    std::uint32_t change = 0;  // to which the covariance belongs
    By by = By::nothing;
    bool operator!=(const Found& other) const { return change != other.change || by != other.by; }
  };

  void resize(const SparseState<Pose>& state);
  void invert(const SparseState<Pose>& state, const std::vector<std::size_t>& indices);

  std::mutex mutex_;  // guards the members below, by landmark
  std::vector<PointSquare> covariances_;
  std::vector<Found> found_;
};

// GlobalMap::base_joint_covariance(); with `errors` the points of the systematic errors at the base follow the base.
template <class Pose>
void joint_covariance_of_base(const SparseState<Pose>& state, const std::size_t* indices, std::size_t count,
                              double* matrix, bool errors = false);
// GlobalMap::errors() and GlobalMap::joint_with_errors().
template <class Pose>
Eigen::VectorXd errors_of(const SparseState<Pose>& state);
template <class Pose>
Eigen::MatrixXd joint_with_errors_of(const SparseState<Pose>& state, const std::size_t* indices, std::size_t count);

extern template class SparseCovariances<SE2>;
extern template class SparseCovariances<SE3>;
extern template void joint_covariance_of_base(const SparseState<SE2>&, const std::size_t*, std::size_t, double*, bool);
extern template void joint_covariance_of_base(const SparseState<SE3>&, const std::size_t*, std::size_t, double*, bool);
extern template Eigen::VectorXd errors_of(const SparseState<SE2>&);
extern template Eigen::VectorXd errors_of(const SparseState<SE3>&);
extern template Eigen::MatrixXd joint_with_errors_of(const SparseState<SE2>&, const std::size_t*, std::size_t);
extern template Eigen::MatrixXd joint_with_errors_of(const SparseState<SE3>&, const std::size_t*, std::size_t);

}  // namespace cairn
