// SPDX-License-Identifier: BSD-3-Clause
// Motion since the last update. It is held back, so that a motion step costs O(1): P_now = F P F^T + U N U^T.
//
// F turns only the pose block, and only with the standard error. N is the noise of the pose. With the invariant error
// it reaches the point x through U_x = [0, -G(x)]: a landmark's part of P changes by products of rank kTurn, which the
// next update adds in the same pass as its own downdate.
//
// Systematic errors of the motion (a bias) are states s. They add C s to the error of the pose, and what C adds to
// xi_R reaches the points through U as the noise does (docs/systematic_errors.md, eq. 5 to 8).
#pragma once

#include "core/arena.hpp"
#include "ekf/error_model.hpp"
#include "ekf/state_layout.hpp"
#include "linear/lower_triangle.hpp"
#include "linear/triangle.hpp"
#include "motion/motion.hpp"

namespace cairn {

// Systematic errors that motion depends on; they are the first ones of the state.
constexpr Index kMotionStates = 16;

// How a motion step depends on the first systematic errors: a column for each, the ordinary error of the increment.
template <class Pose>
struct MotionCoupling {
  Eigen::Matrix<double, Pose::kDof, kMotionStates> J = Eigen::Matrix<double, Pose::kDof, kMotionStates>::Zero();
  double dt = 0.0;  // for which the systematic errors walk, s
};

template <class Pose>
class PendingMotion {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Square = typename Pose::Square;
  using Point = typename Pose::Point;
  using Coupling = Eigen::Matrix<double, kDof, kMotionStates>;

  // The columns have `ld` rows. There may be up to `systematic` systematic errors.
  PendingMotion(Arena& arena, const ErrorModel<Pose>& model, Index ld, Index systematic = 0);

  // The systematic errors: how many, how many of them motion depends on, and the variance by which each walks in one
  // second (the array has to stay). No motion may be pending.
  void set_systematic(Index count, Index motion, const double* walk);
  void clear();
  // Motion from `before` to `next`. Returns false, with nothing changed, if a result is not finite.
  bool add(const Pose& before, const Pose& next, const Increment<Pose>& increment,
           const MotionCoupling<Pose>* coupling = nullptr);

  // Adds an independent error of the pose, with this covariance of the state's own error. Returns false, with nothing
  // changed, if the result is not finite.
  bool widen(const Square& covariance);

  bool any() const { return any_; }
  // The noise reaches the landmarks.
  bool reaches_points() const { return any_ && model_.invariant(); }
  const Square& F() const { return F_; }
  const Square& N() const { return N_; }
  const Coupling& C() const { return C_; }  // of the first motion() systematic errors; zero elsewhere
  Index motion() const { return motion_; }
  Square pose_block(const LowerTriangle& P) const;                           // of P_now
  double walked(Index i) const { return any_ ? walk_[i] * elapsed_ : 0.0; }  // variance by the walk since then
  // Rows of systematic error i of P_now, with [pose; systematic errors].
  void systematic_row(const LowerTriangle& P, Index i, double* row) const;
  // xi_R and a systematic error change together: what reaches the points depends on P.
  bool turns() const { return turns_; }
  // Covariance of D s with [pose; systematic errors], both now, plus the noise of xi_R: what reaches the points, one
  // row for each turn, column-major, kTurn x (kDof + systematic). D is the part of C for xi_R.
  void turn_rows(const LowerTriangle& P, double* out) const;

  // U N and U as columns, with one row for each state. prepare() fills them, the functions below read them. The rows of
  // the pose and the systematic errors are zero, because their columns of P are written completely. Each has rank()
  // columns, which is 0 with the standard error.
  void prepare(const StateLayout<Pose>& layout, const double* points, const LowerTriangle& P);
  Index rank() const { return rank_; }
  const double* left() const { return left_; }    // U N, or V + U M / 2 if turns()
  const double* right() const { return right_; }  // U
  // y += columns weights over the points' rows; `columns` is left() or right(), the weights lie `stride` apart.
  void add_noise(const double* columns, const double* weights, Index stride, Index n, double* y) const;
  // y += the column of row `from` of the change of P over the points' rows: U N U^T, or U V^T + V U^T + U M U^T.
  void add_change(Index from, Index n, double* y) const;
  // The columns of P_now of the pose and the systematic errors, all n rows: P F^T + U N. `out` has the leading
  // dimension of the columns.
  void moving_columns(const LowerTriangle& P, Index n, double* out) const;
  // The change over the points, as two terms; the second one may be empty.
  TriangleTerm term() const { return {left_, ld_, right_, ld_, rank_, 1.0}; }
  TriangleTerm second_term() const { return {right_, ld_, left_, ld_, turns_ ? rank_ : 0, 1.0}; }
  // The memory of both sets of columns, for code that needs 2 kTurn columns while no motion is pending.
  double* scratch_left() { return left_; }
  double* scratch_right() { return right_; }

  struct Snapshot {
    bool any, turns;
    double elapsed;
    Square F, N;
    Coupling C, N_cross;
  };
  Snapshot snapshot() const { return {any_, turns_, elapsed_, F_, N_, C_, N_cross_}; }
  void restore(const Snapshot& s) {
    any_ = s.any, turns_ = s.turns, elapsed_ = s.elapsed, F_ = s.F, N_ = s.N, C_ = s.C, N_cross_ = s.N_cross;
  }

 private:
  Index moving() const { return kDof + count_; }
  // Covariance of systematic error i, without its walk, with [pose; systematic errors].
  double plain(const LowerTriangle& P, Index i, Index column) const;
  void prepare_turn(Index n, const LowerTriangle& P);

  ErrorModel<Pose> model_;
  Index ld_;
  bool any_ = false, turns_ = false;
  Square F_ = Square::Identity(), N_ = Square::Zero();
  Coupling C_ = Coupling::Zero(), N_cross_ = Coupling::Zero();  // N_cross: noise of the pose with that of the walk
  double elapsed_ = 0.0;                                        // for which the systematic errors walked, s
  Index count_ = 0, motion_ = 0;
  const double* walk_ = nullptr;
  Index rank_ = 0;
  double* left_;
  double* right_;
  double* turn_rows_;
};

extern template class PendingMotion<SE2>;
extern template class PendingMotion<SE3>;

}  // namespace cairn
