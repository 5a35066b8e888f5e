// SPDX-License-Identifier: BSD-3-Clause
// Motion since the last update. It is held back, so that a motion step costs O(1): P_now = F P F^T + U N U^T.
//
// F turns only the pose block, and only with the standard error. N is the noise of the pose. With the invariant error
// it reaches the point x through U_x = [0, -G(x)]: a landmark's part of P changes by products of rank kTurn, which the
// next update adds in the same pass as its own downdate.
#pragma once

#include "core/arena.hpp"
#include "ekf/error_model.hpp"
#include "ekf/state_layout.hpp"
#include "linear/lower_triangle.hpp"
#include "linear/triangle.hpp"
#include "motion/motion.hpp"

namespace cairn {

template <class Pose>
class PendingMotion {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Square = typename Pose::Square;
  using Point = typename Pose::Point;

  // The columns have `ld` rows.
  PendingMotion(Arena& arena, const ErrorModel<Pose>& model, Index ld);

  void clear();
  // Motion from `before` to `next`. Returns false, with nothing changed, if a result is not finite.
  bool add(const Pose& before, const Pose& next, const Increment<Pose>& increment);

  // Adds an independent error of the pose, with this covariance of the state's own error. Returns false, with nothing
  // changed, if the result is not finite.
  bool widen(const Square& covariance);

  bool any() const { return any_; }
  // The noise reaches the landmarks.
  bool reaches_points() const { return any_ && model_.invariant(); }
  const Square& F() const { return F_; }
  const Square& N() const { return N_; }
  Square pose_block(const LowerTriangle& P) const;  // of P_now

  // U N and U as columns, with one row for each state. prepare() fills them, the functions below read them. The pose's
  // rows are zero, because its columns of P are written completely. Each has rank() columns, which is 0 with the
  // standard error.
  void prepare(const StateLayout<Pose>& layout, const double* points);
  Index rank() const { return rank_; }
  const double* left() const { return left_; }    // U N
  const double* right() const { return right_; }  // U
  // y += columns weights over the points' rows; `columns` is left() or right(), the weights lie `stride` apart.
  void add_noise(const double* columns, const double* weights, Index stride, Index n, double* y) const;
  // The pose's columns of P_now, all n rows: P F^T + U N. `out` has the leading dimension of the columns.
  void pose_columns(const LowerTriangle& P, Index n, double* out) const;
  TriangleTerm term() const { return {left_, ld_, right_, ld_, rank_, 1.0}; }  // U N U^T over the points
  // The memory of both sets of columns, for code that needs 2 kTurn columns while no motion is pending.
  double* scratch_left() { return left_; }
  double* scratch_right() { return right_; }

  struct Snapshot {
    bool any;
    Square F, N;
  };
  Snapshot snapshot() const { return {any_, F_, N_}; }
  void restore(const Snapshot& snapshot) { any_ = snapshot.any, F_ = snapshot.F, N_ = snapshot.N; }

 private:
  ErrorModel<Pose> model_;
  Index ld_;
  bool any_ = false;
  Square F_ = Square::Identity(), N_ = Square::Zero();
  Index rank_ = 0;
  double* left_;
  double* right_;
};

extern template class PendingMotion<SE2>;
extern template class PendingMotion<SE3>;

}  // namespace cairn
