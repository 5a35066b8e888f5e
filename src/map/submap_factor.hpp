// SPDX-License-Identifier: BSD-3-Clause
// A closed submap as one observation of its base, its end and its landmarks: the submap's estimate is the value, its
// covariance the noise, whole (docs/submaps.md).
//
// Landmarks that no other submap holds are private: given the others, they can always stand where they leave no
// residual, so that eliminating them leaves the covariance of the others as it is. Only base, end and shared landmarks
// enter the factor; the private ones follow from them.
#pragma once

#include <memory>
#include <vector>

#include "map/packed.hpp"
#include "map/submap.hpp"

namespace cairn {

// What never changes. Shared between copies of a map.
struct SubmapData {
  explicit SubmapData(const Submap<SE3>& submap);

  ErrorKind error;
  SE3 T_base_end;
  std::vector<std::uint64_t> ids;
  std::vector<Vector3> landmarks;  // in the frame of the base
  Packed covariance;               // of [end; landmarks], own error coordinates
};

// Values of what a factor depends on.
struct FactorValues {
  SE3 base, end;
  std::vector<Vector3> shared;  // in the map frame, in the order of the factor's shared landmarks
};

// The factor for one choice of shared landmarks.
class SubmapFactor {
 public:
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;

  // `shared`: numbers of landmarks in the submap, ascending. Throws where the covariance can't be inverted.
  SubmapFactor(std::shared_ptr<const SubmapData> data, std::vector<Eigen::Index> shared);

  const SubmapData& data() const { return *data_; }
  const std::vector<Eigen::Index>& shared() const { return shared_; }
  Eigen::Index rows() const { return information_.size(); }         // 6 + 3 shared
  Eigen::Index columns() const { return 12 + 3 * shared_count(); }  // base, end, shared: ordinary errors in map axes
  Eigen::Index shared_count() const { return static_cast<Eigen::Index>(shared_.size()); }

  // The error xi of the submap's estimate against the values; that of its turn comes at 3 to 5.
  Vector residual(const FactorValues& values) const;
  Vector weighted(const Vector& residual) const;  // Sigma^-1 xi
  struct Evaluation {
    double cost = 0.0;  // xi^T Sigma^-1 xi / 2
    Vector gradient;    // of the cost, columns()
  };
  Evaluation evaluate(const FactorValues& values) const;
  // J^T Sigma^-1 J, lower triangle, its diagonal 3-blocks whole; by errors in the given axes of base, end and shared
  // landmarks.
  Matrix hessian(const FactorValues& values, const std::vector<Matrix3>& axes) const;
  // Block of the information of a single shared landmark, in map axes.
  Matrix3 landmark_information(Eigen::Index i, const SO3& base) const;

  // Where each of the submap's landmarks leaves no residual of its own, a column each, in the map frame.
  Eigen::Matrix3Xd place_private(const FactorValues& values, const Vector& residual, const Vector& weighted) const;
  // Landmarks of the submap by their number, as e = A [base; end; shared] + w with ordinary errors in map axes, w of
  // covariance W: joint of all that are asked for. Shared landmarks are not to be asked for.
  void express_private(const std::vector<Eigen::Index>& landmarks, const FactorValues& values, Matrix& A,
                       Matrix& W) const;

  std::size_t memory_bytes() const { return information_.memory_bytes() + data_->covariance.memory_bytes(); }

 private:
  struct Jacobian;
  Jacobian jacobian(const FactorValues& values, const Vector& residual) const;
  std::vector<Eigen::Index> states() const;
  Matrix dense_jacobian(const FactorValues& values) const;

  std::shared_ptr<const SubmapData> data_;
  std::vector<Eigen::Index> shared_;
  Packed information_;  // Sigma^-1 of [end; shared]
};

}  // namespace cairn
