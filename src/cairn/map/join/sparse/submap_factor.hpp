// SPDX-License-Identifier: BSD-3-Clause
// A closed submap as one observation of its base, its end and its landmarks: the value is the submap's estimate, the
// noise its whole covariance (docs/submaps.md).
//
// Landmarks that no other submap holds are private. For any values of the other variables a private landmark has a
// position without residual, so that its elimination does not change the covariance of the others. Only base, end and
// shared landmarks enter the factor; the private landmarks follow from them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "map/join/sparse/error_points.hpp"
#include "map/join/sparse/packed.hpp"
#include "map/submap.hpp"

namespace cairn {

// The part of a factor that never changes. Copies of a map share it.
template <class Pose>
struct SubmapData {
  explicit SubmapData(const Submap<Pose>& submap, const ErrorPoints<Pose>& error_points = {});
  // The same submap for a map with another frame: what its fixes told about the base is left out, and what they told
  // about the way stays. Without systematic errors.
  SubmapData without_base() const;

  ErrorKind error;
  Pose T_base_end;
  std::vector<std::uint64_t> ids;
  std::vector<typename Pose::Point> landmarks;  // in the frame of the base
  ErrorPoints<Pose> points;
  FactorErrors errors;
  std::optional<Pose> base;  // against which its error counts, if the submap had fixes
  Packed covariance;         // of [end; landmarks; walked] given the shared errors, own error coordinates

  bool shares() const { return points.count() > 0 || base.has_value(); }
};

// Values of the variables of a factor.
template <class Pose>
struct FactorValues {
  Pose base, end;
  std::vector<typename Pose::Point> shared;  // in the map frame, in the order of the factor's shared landmarks
  Eigen::VectorXd errors = {};               // of the factor's points
};

// The factor for one choice of shared landmarks.
template <class Pose>
class SubmapFactor {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;
  using Rotation = typename Pose::Rotation;
  using PointSquare = typename Rotation::Matrix;
  using Square = typename Pose::Square;
  using Points = Eigen::Matrix<double, kDim, Eigen::Dynamic>;
  using Data = SubmapData<Pose>;
  using Values = FactorValues<Pose>;

  // `shared`: numbers of landmarks in the submap, ascending. Throws if the covariance can't be inverted.
  SubmapFactor(std::shared_ptr<const Data> data, std::vector<Eigen::Index> shared);

  const Data& data() const { return *data_; }
  const std::vector<Eigen::Index>& shared() const { return shared_; }
  Eigen::Index rows() const { return information_.size(); }  // kDof + kDim shared + walked
  // Columns of the Jacobian: base, end, shared landmarks, points of systematic errors; ordinary errors in map axes.
  Eigen::Index columns() const { return column(shared_count() + data_->points.factor_points()); }
  static Eigen::Index column(Eigen::Index shared_landmark) { return 2 * kDof + kDim * shared_landmark; }
  Eigen::Index shared_count() const { return static_cast<Eigen::Index>(shared_.size()); }

  // The error xi of the submap's estimate, given the errors that it shares with the map, against the values.
  Vector residual(const Values& values) const;
  Vector weighted(const Vector& residual) const;  // Sigma^-1 xi
  struct Evaluation {
    double cost = 0.0;  // xi^T Sigma^-1 xi / 2
    Vector gradient;    // of the cost, columns()
  };
  Evaluation evaluate(const Values& values) const;
  // J^T Sigma^-1 J, lower triangle, with complete diagonal blocks of poses and of landmarks; by errors in the given
  // axes of base, end and shared landmarks.
  Matrix hessian(const Values& values, const std::vector<Rotation>& axes) const;
  // Block of the information of a single shared landmark, in map axes.
  PointSquare landmark_information(Eigen::Index i, const Rotation& base) const;

  // The positions at which the submap's landmarks have no residual: one column each, in the map frame.
  Points place_private(const Values& values, const Vector& residual, const Vector& weighted) const;
  // The errors of landmarks of the submap, given by number: e = A [base; end; shared] + w with ordinary errors in map
  // axes, w of covariance W, jointly for all requested landmarks. Shared landmarks must not be requested.
  void express_private(const std::vector<Eigen::Index>& landmarks, const Values& values, Matrix& A, Matrix& W) const;

  std::size_t memory_bytes() const { return information_.memory_bytes() + data_->covariance.memory_bytes(); }

 private:
  using Point = typename Pose::Point;
  using Tangent = typename Rotation::Tangent;

  struct Jacobian;
  // The error of the estimate as it is; that of its turn comes from kDim on.
  Vector whole_error(const Values& values) const;
  Jacobian jacobian(const Values& values, const Vector& whole_error) const;
  std::vector<Eigen::Index> states() const;
  Eigen::Index error_columns() const { return kDim * data_->points.factor_points(); }
  Vector error_values(const Values& values) const;  // of the errors that the submap shares with the map
  Vector error_shift(const Values& values) const;   // of these errors, from where K was computed
  Matrix K() const;                                 // of the rows of the factor
  // Of the error of the base, by the base, in a submap that had fixes.
  Square base_jacobian(const Values& values) const { return pose_error_jacobian(values.base, *data_->base); }
  bool uses(Eigen::Index number) const;  // a number of the factor's points holds an error
  Matrix error_jacobian() const;         // of the residual, by the factor's points
  void add_error_hessian(const Matrix& information, const Matrix& weighted_poses,
                         const std::vector<PointSquare>& landmark_axes, Matrix& H) const;
  void add_base_hessian(const Square& error_by_base, Matrix& H) const;
  Matrix dense_jacobian(const Values& values) const;

  std::shared_ptr<const Data> data_;
  std::vector<Eigen::Index> shared_;
  Packed information_;  // Sigma^-1 of [end; shared]
};

extern template struct SubmapData<SE2>;
extern template struct SubmapData<SE3>;
extern template class SubmapFactor<SE2>;
extern template class SubmapFactor<SE3>;

}  // namespace cairn
