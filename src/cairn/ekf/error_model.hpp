// SPDX-License-Identifier: BSD-3-Clause
// The error that a filter's covariance speaks of, and how it relates to the ordinary error [dp; dtheta]
// (docs/invariant_error.md). The relation stands here and nowhere else.
//
//   invariant  X = Exp(xi) X_hat on SE_{K+1}: R = Exp(xi_R) R_hat, x = Exp(xi_R) x_hat + J_l(xi_R) xi_x for the
//              vehicle's position and for every landmark x. Propagation is the identity.
//   standard   the ordinary error: R = Exp(theta) R_hat, x = x_hat + e_x.
//
// To first order e_x = xi_x + G(x_hat) xi_R for every point x. G(x) is the *arm* of the invariant error:
// G(x) theta = theta x x, the turn of x about the origin.
#pragma once

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"
#include "linear/small_algebra.hpp"

namespace cairn {

enum class ErrorKind { invariant, standard };

template <class Pose>
class ErrorModel {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Rotation = typename Pose::Rotation;
  using Point = typename Pose::Point;
  using Tangent = typename Pose::Tangent;
  using Square = typename Pose::Square;
  using PointSquare = Eigen::Matrix<double, kDim, kDim>;
  using Arm = typename Rotation::Turn;

  explicit ErrorModel(ErrorKind kind) : kind_(kind) {}
  ErrorKind kind() const { return kind_; }
  bool invariant() const { return kind_ == ErrorKind::invariant; }

  // G(x). With the standard error a point has no arm: ask invariant() first.
  static Arm arm(const Point& x) { return Rotation::turn(x); }

  // Moves `pose` to the pose whose own error against it is `error`.
  void retract(const Tangent& error, Pose& pose) const;

  // The invariant retraction of a point: Exp(xi_R) x + J_l(xi_R) xi_x. `R` is the rotation Exp(xi_R) or its matrix, `V`
  // the translation Jacobian of xi_R.
  template <class AnyRotation>
  static Point move_point(const AnyRotation& R, const PointSquare& V, const Point& x, const Point& error) {
    return R * x + V * error;
  }

  // The retraction of points, for all points of one update: `turn` is the pose's xi_R.
  class PointRetraction {
   public:
    PointRetraction(const ErrorModel& model, const typename Rotation::Tangent& turn);
    Point operator()(const Point& x, const Point& error) const {
      if (!invariant_) return x + error;
      return move_point(R_, V_, x, error);
    }

   private:
    bool invariant_;
    PointSquare R_, V_;
  };

  // The filter's own error of an estimate. Both poses are counted from the filter's origin.
  Tangent error(const Pose& truth, const Pose& estimate) const {
    Tangent error = (truth * estimate.inverse()).log();
    if (!invariant()) error.template head<kDim>() = truth.translation() - estimate.translation();
    return error;
  }

  // Covariance of the filter's own error of a pose that stands at `position`, from that of the ordinary error:
  // xi_p = e_p - G(p) e_R.
  Square own(const Square& ordinary, const Point& position) const {
    if (!invariant()) return ordinary;
    Square J = Square::Identity();
    J.template topRightCorner<kDim, kTurn>() = -arm(position);
    return J * ordinary * J.transpose();
  }

  // The filter's own error after a motion from `before` to `next`, by the ordinary error of the increment in the axes
  // of the body: e_p += R dp, e_R += R dtheta, and xi_p = e_p - G(p) e_R at the new position.
  Square by_increment(const Pose& before, const Pose& next) const {
    Square B = Pose::turn_axes(before.rotation());
    if (invariant())
      B.template topRightCorner<kDim, kTurn>() =
          -arm(next.translation()) * B.template bottomRightCorner<kTurn, kTurn>();
    return B;
  }

  // The columns of xi_R of a Jacobian's rows, for rows that depend on the point x by J_point: block(:, R) += J_point
  // G(x). `block` is column-major, `rows` rows a column, its first column that of xi_p.
  template <class JPoint>
  void add_turn(Index rows, const JPoint& J_point, const Point& x, double* block) const {
    if (!invariant()) return;
    const auto G = arm(x);
    for (Index c = 0; c < kTurn; ++c)
      for (Index d = 0; d < kDim; ++d)
        for (Index r = 0; r < rows; ++r) block[(kDim + c) * rows + r] += J_point(r, d) * G(d, c);
  }

  // A M A^T for e = A xi, in place: M is the covariance of [pose; points], both triangles, leading dimension `ld`.
  // Point number i stands at point(i); number -1 is the vehicle itself.
  template <class PointOf>
  void to_ordinary(Index points, PointOf&& point, double* matrix, Index ld) const {
    if (!invariant()) return;
    const Index size = kDof + kDim * points;
    for (Index x = -1; x < points; ++x) {
      const Index at = x < 0 ? 0 : kDof + kDim * x;
      const Arm G = arm(point(x));
      for (Index c = 0; c < size; ++c)
        for (Index r = 0; r < kDim; ++r)
          for (Index t = 0; t < kTurn; ++t) matrix[c * ld + at + r] += G(r, t) * matrix[c * ld + kDim + t];
      for (Index r = 0; r < size; ++r)
        for (Index c = 0; c < kDim; ++c)
          for (Index t = 0; t < kTurn; ++t) matrix[(at + c) * ld + r] += G(c, t) * matrix[(kDim + t) * ld + r];
    }
    for (Index c = 0; c < size; ++c)  // both triangles, bit for bit
      for (Index r = c + 1; r < size; ++r) matrix[r * ld + c] = matrix[c * ld + r];
  }

  // The same for one point of a larger covariance: its rows and columns, from `at` on, become those of the ordinary
  // error; all others stay. xi_R has the rows from kDim on.
  template <class Matrix>
  void to_ordinary_point(const Point& x, Index at, Matrix& covariance) const {
    if (!invariant()) return;
    const Arm G = arm(x);
    covariance.template middleRows<kDim>(at) += G * covariance.template middleRows<kTurn>(kDim);
    covariance.template middleCols<kDim>(at) += covariance.template middleCols<kTurn>(kDim) * G.transpose();
  }

 private:
  ErrorKind kind_;
};

extern template class ErrorModel<SE2>;
extern template class ErrorModel<SE3>;

}  // namespace cairn
