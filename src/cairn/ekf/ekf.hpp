// SPDX-License-Identifier: BSD-3-Clause
// Extended Kalman filter of one pose and many landmarks: the one owner of their covariance.
//
// The error of the state is one of two (docs/invariant_error.md):
//   invariant  X = Exp(xi) X_hat on SE_{K+1}: R = Exp(xi_R) R_hat, x = Exp(xi_R) x_hat + J_l(xi_R) xi_x for the
//   position
//              and every landmark x. Propagation is the identity (theory of the right-invariant EKF).
//   standard   the ordinary one: R = Exp(theta) R_hat, x = x_hat + e_x.
// To first order e_x = xi_x + G(x_hat) xi_R with G = Rotation::turn: what F, U and the retraction below follow from.
//
// States stand as [xi_p; xi_R; xi_1; xi_2; ...]; only the lower triangle of P is kept. Motion between two updates costs
// O(1): it is held back as P_now = F P F^T + U N U^T, where F turns the pose block alone (standard error), and N is the
// noise of the pose, which reaches landmark i through U_i = [0, -G(x_i)] (invariant error).
//
// There may be companions: poses of other vehicles. A companion's position is a landmark, in one of the first slots,
// and its attitude a state of its own between pose and landmarks: [xi_p; xi_R; theta_1; theta_2; ...; xi_1; ...], theta
// the ordinary error of the attitude with either error. The filter looks at the world from one vehicle, and activate()
// makes that another one.
#pragma once

#include <vector>

#include "core/arena.hpp"
#include "ekf/batch.hpp"
#include "geometry/se2.hpp"
#include "geometry/se3.hpp"
#include "motion/motion.hpp"
#include "sensor/sensor.hpp"

namespace cairn {

enum class ErrorKind { invariant, standard };

template <class Pose>
class Ekf {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  static constexpr int kMount = kMountErrors<Pose>;  // of a sensor's mount that a frame may have in common
  using Rotation = typename Pose::Rotation;
  using Point = typename Pose::Point;
  using Tangent = typename Pose::Tangent;
  using Square = typename Pose::Square;
  using PointSquare = Eigen::Matrix<double, kDim, kDim>;
  using PointByPose = Eigen::Matrix<double, kDim, kDof>;
  using PointByMount = Eigen::Matrix<double, kDim, kMount>;

  struct Capacity {
    Index landmarks;     // companions among them
    Index observations;  // landmarks that one batch may touch
    Index companions = 0;
    Index rows() const { return std::max<Index>(kDim * observations, kDof); }
    Index window() const { return kDof + kMount + kDim * observations; }
    Index states() const { return kDof + kTurn * companions + kDim * landmarks; }
  };

  Ekf(Arena& arena, ErrorKind error, const Capacity& capacity);

  // Forgets everything; the covariance is that of the ordinary error [dp; dtheta].
  void start(const Pose& pose, const Square& ordinary_covariance);

  // --- estimates ---
  Pose pose() const { return Pose(pose_.rotation(), pose_.translation() + origin_); }
  Index size() const { return size_; }  // slots: companions, then landmarks
  Index states() const { return lead() + kDim * size_; }
  Point landmark(Index slot) const { return local(slot) + origin_; }

  // --- propagate --- O(1). False, with nothing changed, where a result is not finite.
  bool propagate(const Increment<Pose>& increment);

  // --- marginals ---
  // Joint covariance of the pose and `count` landmarks, both triangles, in the filter's own error coordinates.
  void gather(const Index* slots, Index count, double* out, Index ld) const;
  // The same in ordinary errors.
  void gather_ordinary(const Index* slots, Index count, double* out, Index ld) const;
  // Of the ordinary error of l - p less what turning the pose does to it, e_l - e_p - turn(l - p) e_R: all that a
  // sensor of R^T (l - p) feels of pose and landmark. By invariant errors it is that of xi_l - xi_p.
  PointSquare relative_covariance(Index slot) const;
  Square pose_covariance() const;  // ordinary
  PointSquare landmark_covariance(Index slot) const;
  // Normalised error squared of the pose in the filter's own coordinates; negative where its covariance is singular.
  double pose_nees(const Pose& truth) const;
  // The same of any estimate with an ordinary covariance; `origin` is where the invariant error counts positions from.
  static double nees(ErrorKind error, const Point& origin, const Pose& truth, const Pose& estimate,
                     const Square& ordinary_covariance);
  // Smallest pivot of the Cholesky factor of P scaled to unit diagonal; uses the upper triangle as scratch.
  double smallest_pivot();

  double* scratch() { return scratch_; }  // m^2 + cholesky_workspace(m) doubles for m = rows(), free between calls

  // --- update --- open, then fill the batch, then (innovation, factor, solve) as often as wanted, then commit.
  // The window: the pose, the mount's angles, the chosen landmarks; its iterate starts at the estimate.
  void open(const Index* slots, Index count, const Eigen::Matrix<double, kMount, kMount>* mount_noise);
  Batch& batch() { return batch_; }
  bool iterating() const { return iterating_; }  // the iterate has left the estimate
  Pose iterate_pose() const { return Pose(iterate_pose_.rotation(), iterate_pose_.translation() + origin_); }
  Point iterate_landmark(Index a) const { return local_iterate(a) + origin_; }
  Eigen::Matrix<double, kMount, 1> iterate_mount() const { return iterate_mount_; }
  Index landmark_column(Index a) const { return kDof + mount_ + kDim * a; }

  // Add blocks given Jacobians by ordinary errors, of rows that the batch has: first the pose's, then those of the
  // landmarks (numbers in the window) that the rows depend on, each handed what the pose's gave. `relative`: the rows
  // see points R^T (l - p) alone, so that the attitude's column of the invariant error is zero exactly, not but for
  // rounding.
  struct PoseBlock {
    double* value;
    bool turns;  // it has columns for the attitude
  };
  template <class JPose>
  PoseBlock add_pose_block(Index row, Index rows, const JPose& J_pose, bool relative);
  template <class JLandmark>
  void add_landmark_block(Index row, Index rows, const JLandmark& J_landmark, Index a, const PoseBlock& pose);
  template <class JMount>
  void add_mount_block(Index row, Index rows, const JMount& J_mount);

  void compute_innovation();  // H P and S of the batch
  void form_innovation();     // S once more, from the H P that stands
  // Leaves these of the batch's blocks of `rows` rows, in rising order, and their S; the window stays.
  void keep(const Index* blocks, Index count, Index rows);
  const double* innovation() const { return S_; }  // column-major, lower triangle, leading dimension rows()
  // Full S^-1, column-major, or null where S is not positive definite; only before factor().
  double* inverse_innovation();
  // After it: u = S^-1 r and r^T u.
  double distance_by_inverse(double* u) const;
  bool factor();                       // S = L L^T; false where S is not positive definite
  double nis() const { return nis_; }  // r^T S^-1 r of the last factor()
  void solve();                        // the iterate's error against the estimate
  void step();                         // iterate <- Exp(error) estimate
  double misfit(
      const double* residual) const;  // how far residuals at the iterate are from what solve() foresaw, sigmas
  // Takes in the batch: W, P, state. False, with nothing changed, where a variance of P would not stay positive or a
  // value not finite: what tells, at the cost of O(n m), that P would lose definiteness. smallest_pivot() tells surely.
  bool commit();

  // --- augment and remove ---
  // Appends a landmark that depends on the pose (ordinary Jacobian), on the mount of the window last committed, and on
  // noise of its own. False, with nothing changed, where a result is not finite. The caller minds the capacity.
  bool augment(const Point& position, const PointByPose& J_pose, const PointByMount* J_mount, const PointSquare& noise,
               bool relative);
  // Takes a landmark out; the last one moves into its slot.
  void remove(Index slot);
  // Two landmarks change slots.
  void exchange_landmarks(Index a, Index b);
  // Appends one that stands where a landmark does, but for an error of its own. The caller minds the capacity.
  void duplicate(Index slot, const PointSquare& noise);

  // --- companions --- numbered from 0, by the slots of their positions
  Index companions() const { return companions_; }
  Pose companion(Index k) const { return Pose(companion_rotations_[k], landmark(k)); }
  Square companion_covariance(Index k) const;  // ordinary
  // One more, whose ordinary error is J_pose times that of the filter's pose (zero where it was told, not seen) and a
  // noise of its own; the landmark that had its slot moves behind the last one. The caller minds the capacity. False,
  // with nothing changed, where a result is not finite.
  bool add_companion(const Pose& pose, const Square& J_pose, const Square& noise);
  void remove_companion(Index k);  // the last companion becomes number k, the last landmark the first one
  // The filter's pose is companion k's from now on, and companion k is the vehicle that was the filter's. O(n^2) with
  // the invariant error, whose arms turn about another vehicle then; O(n) with the standard one.
  void activate(Index k);

  // A submap that began at the pose and whose landmarks known here were fused (an update) hands over the rest.
  struct Handover {
    Pose T_base_end;
    const Index* fused;  // their slots
    Index fused_count;
    const Point* fresh;  // landmarks not known here, in the submap's frame
    Index fresh_count;
    // Own error of [end pose; fresh landmarks] in the submap: K y + w, w of covariance W, y the ordinary error of the
    // fused ones.
    Eigen::MatrixXd K, W;
  };
  // The end becomes the pose, the fresh landmarks are appended. The caller minds the capacity. Allocates.
  void compose(const Handover& handover);

  // What an update and a composition change, kept aside. Allocates.
  struct Backup {
    Pose pose;
    std::vector<double> landmarks, triangle;
    std::vector<Rotation> rotations;  // of the companions
    bool pending;
    Square F, N;
  };
  Backup backup() const;
  void restore(const Backup& backup);  // no landmark may have been removed in between

 private:
  Point local(Index slot) const { return Eigen::Map<const Point>(landmarks_ + kDim * slot); }
  Point local_iterate(Index a) const { return Eigen::Map<const Point>(iterate_landmarks_ + kDim * a); }
  double& P(Index row, Index column) { return P_[column * ld_ + row]; }
  double P(Index row, Index column) const { return P_[column * ld_ + row]; }
  double symmetric(Index row, Index column) const { return row >= column ? P(row, column) : P(column, row); }
  Index lead() const { return kDof + kTurn * companions_; }
  Index state(Index slot) const { return lead() + kDim * slot; }
  static Index heading(Index companion) { return kDof + kTurn * companion; }
  void exchange(Index a, Index b);                      // two states
  void move_states(Index from, Index count, Index by);  // along the diagonal, upwards or downwards
  // block(:, R) += J_point G(x) in invariant coordinates.
  template <class JPoint>
  void add_turn(Index rows, const JPoint& J_point, const Point& x, double* block) const;
  // Exp(xi_R) x + J_l(xi_R) xi_x of every landmark of one update, or x + e_x.
  struct Mover {
    Mover(ErrorKind error, const typename Rotation::Tangent& turn) : invariant(error == ErrorKind::invariant) {
      if (!invariant) return;
      R = Rotation::exp(turn).matrix();
      V = Rotation::translation_jacobian(turn);
    }
    Point operator()(const Point& x, const Point& error) const {
      if (!invariant) return x + error;
      return R * x + V * error;
    }
    bool invariant;
    PointSquare R, V;
  };

  Square pose_block() const;  // with the motion held back
  static double normalised(Square covariance, Tangent error);
  void to_ordinary(const Index* slots, Index count, double* matrix, Index ld) const;
  void retract(const Tangent& error, Pose& pose) const;
  void pending_pose_columns(double* out) const;  // of P_now, all rows
  void prepare_pending();
  void add_noise(const double* columns, const double* weights, Index stride, Index n, double* y) const;
  void gather_columns();  // the window's columns of P_now, all rows
  void write_covariance(Index rank, const double* pose_columns);
  void apply_pending();
  void clear_pending();

  ErrorKind error_;
  Capacity capacity_;
  Index ld_;  // of P and of everything with a row a state

  // Everything below counts from the position at the start. The arms G(x) of the invariant error reach from the origin
  // to x: from an origin far away they would drown the covariance's digits in their length.
  Point origin_ = Point::Zero();
  Pose pose_;
  Index size_ = 0, companions_ = 0;
  double* landmarks_;
  Rotation* companion_rotations_;
  double* P_;

  bool pending_ = false;
  Square F_ = Square::Identity();
  Square N_ = Square::Zero();

  // Window and workspace of an update.
  Index* slots_;
  Index slot_count_ = 0;
  Index mount_ = 0;  // kMount or 0
  Index window_ = 0;
  bool iterating_ = false;
  Pose iterate_pose_;
  Eigen::Matrix<double, kMount, 1> iterate_mount_ = Eigen::Matrix<double, kMount, 1>::Zero();
  double* iterate_landmarks_;
  Batch batch_;
  double* HP_;  // the window's columns of H P
  double* S_;   // innovation covariance, then its factor
  double* S_inverse_;
  double* innovation_;  // r + H xi at the last linearisation, then L^-1 of it
  double* weights_;     // S^-1 (r + H xi)
  double* error_window_;
  double* foreseen_;      // residual that solve() foresees at its own iterate
  double* columns_;       // the window's columns of P_now, a row a state, then one for each angle of the mount
  Index noise_rank_ = 0;  // columns of U N and U of the motion held back
  double* noise_left_;
  double* noise_right_;
  double* W_;  // P H^T of the batch, with commit() times L^-T; rows as those of columns_
  double* error_state_;
  double* shrunk_;  // what an update takes off the diagonal
  double* diagonal_;
  double* mount_cross_;  // covariance of every state with the mount's angles after the commit
  Eigen::Matrix<double, kMount, kMount> mount_covariance_ = Eigen::Matrix<double, kMount, kMount>::Zero();
  double* scratch_;
  double nis_ = 0.0;
};

template <class Pose>
template <class JPose>
typename Ekf<Pose>::PoseBlock Ekf<Pose>::add_pose_block(Index row, Index rows, const JPose& J_pose, bool relative) {
  // With e_x = xi_x + G(x) xi_R the columns of p and l stay and those of R become J_theta + J_p G(p) + J_l G(l).
  const bool turns = !(relative && error_ == ErrorKind::invariant);
  double* block = batch_.add_jacobian(row, rows, 0, turns ? kDof : kDim);
  for (Index c = 0; c < (turns ? kDof : kDim); ++c)
    for (Index r = 0; r < rows; ++r) block[c * rows + r] = J_pose(r, c);
  if (turns) add_turn(rows, J_pose, iterate_pose_.translation(), block);
  return {block, turns};
}

template <class Pose>
template <class JLandmark>
void Ekf<Pose>::add_landmark_block(Index row, Index rows, const JLandmark& J_landmark, Index a, const PoseBlock& pose) {
  double* block = batch_.add_jacobian(row, rows, landmark_column(a), kDim);
  for (Index c = 0; c < kDim; ++c)
    for (Index r = 0; r < rows; ++r) block[c * rows + r] = J_landmark(r, c);
  if (pose.turns) add_turn(rows, J_landmark, local_iterate(a), pose.value);
}

template <class Pose>
template <class JMount>
void Ekf<Pose>::add_mount_block(Index row, Index rows, const JMount& J_mount) {
  double* block = batch_.add_jacobian(row, rows, kDof, kMount);
  for (Index c = 0; c < kMount; ++c)
    for (Index r = 0; r < rows; ++r) block[c * rows + r] = J_mount(r, c);
}

template <class Pose>
template <class JPoint>
void Ekf<Pose>::add_turn(Index rows, const JPoint& J_point, const Point& x, double* block) const {
  if (error_ == ErrorKind::standard) return;
  const auto G = Rotation::turn(x);
  for (Index c = 0; c < kTurn; ++c)
    for (Index d = 0; d < kDim; ++d)
      for (Index r = 0; r < rows; ++r) block[(kDim + c) * rows + r] += J_point(r, d) * G(d, c);
}

extern template class Ekf<SE2>;
extern template class Ekf<SE3>;

}  // namespace cairn
