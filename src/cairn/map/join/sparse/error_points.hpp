// SPDX-License-Identifier: BSD-3-Clause
// Systematic errors as variables of a sparse map (docs/systematic_errors.md).
#pragma once

#include <vector>

#include "map/submap.hpp"

namespace cairn {

// How the variables of the systematic errors hold the errors: in points of kDim numbers. Errors that do not walk have
// the same points in all submaps; those that walk have points at each base. An error counts in units of its standard
// deviation at the start. Numbers of a point that hold no error are zero.
template <class Pose>
class ErrorPoints {
 public:
  ErrorPoints() = default;
  explicit ErrorPoints(const SharedErrorOptions& options);

  Eigen::Index count() const { return static_cast<Eigen::Index>(at_.size()); }  // errors
  Eigen::Index constant() const { return constant_; }                           // points
  Eigen::Index walking() const { return walking_; }                             // points at a base
  Eigen::Index size() const { return Pose::kDim * (constant_ + walking_); }     // numbers of [constant; at one base]
  // Of a factor: [constant; walking at the base; walking at the end].
  Eigen::Index factor_points() const { return constant_ + 2 * walking_; }
  Eigen::Index at(Eigen::Index error) const { return at_[static_cast<std::size_t>(error)]; }  // among these numbers
  Eigen::Index from_base_to_end() const { return Pose::kDim * walking_; }  // distance of the numbers of one error
  double unit(Eigen::Index error) const { return unit_[static_cast<std::size_t>(error)]; }
  const std::vector<Eigen::Index>& walkers() const { return walkers_; }
  bool used(Eigen::Index number) const;

 private:
  std::vector<double> unit_;
  std::vector<Eigen::Index> at_, walkers_;
  Eigen::Index constant_ = 0, walking_ = 0;
};

// What a submap tells about systematic errors, in the numbers of ErrorPoints at its base; and, if it had fixes, about
// the error of its base, which then follows these numbers.
struct FactorErrors {
  Eigen::VectorXd value;   // at which K was computed
  Eigen::MatrixXd K;       // of [end; landmarks; walked]
  Eigen::VectorXd walked;  // estimate, of the errors that walk
  ErrorRows found;         // what the submap found out about the errors themselves
};

// From the errors of a submap to these numbers; in `given` the rows of what the errors walked.
template <class Pose>
FactorErrors factor_errors(const SubmapErrors& errors, const ErrorPoints<Pose>& points, GivenErrors& given);

extern template class ErrorPoints<SE2>;
extern template class ErrorPoints<SE3>;

}  // namespace cairn
