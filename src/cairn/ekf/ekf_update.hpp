// SPDX-License-Identifier: BSD-3-Clause
// One update of a state by one batch of rows (docs/update.md). The state makes it: `EkfUpdate update =
// state.begin(window)`. Its calls have one legal order, and any other order throws std::logic_error:
//
//   begin -> linearise -> gates (distance, keep, gate) -> iterate (or factor) -> commit -> place
//
// Nothing of the state changes before commit(), and an update that is dropped leaves no trace. After a factor() or a
// commit() that threw, the batch must be linearised again.
#pragma once

#include "ekf/state.hpp"
#include "linear/joint_gate.hpp"

namespace cairn {

// When an iterated update ends.
struct Iterations {
  int most = 3;
  double tolerance = 0.1;  // of EkfUpdate::misfit()
  bool relative = true;    // all rows depend on the pose only through points R^T (l - p)
  // Noise that depends on the iterate (robust losses): points to whether the last linearisation left it as it was.
  const bool* settled = nullptr;
};

template <class Pose>
class EkfUpdate {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof, kMount = kMountErrors<Pose>;
  using Point = typename Pose::Point;
  using Tangent = typename Pose::Tangent;
  using PointSquare = typename State<Pose>::PointSquare;
  using PointByPose = typename State<Pose>::PointByPose;
  using PointByMount = typename State<Pose>::PointByMount;

  EkfUpdate(State<Pose>& state, const typename State<Pose>::Window& window);  // State::begin()
  EkfUpdate(const EkfUpdate&) = delete;
  EkfUpdate& operator=(const EkfUpdate&) = delete;

  // --- the iterate --- where the batch is linearised; it begins at the estimate
  bool iterating() const { return iterating_; }  // the iterate has left the estimate
  Pose pose() const { return Pose(pose_.rotation(), pose_.translation() + state_.origin_); }
  Point landmark(Index number) const { return local(number) + state_.origin_; }  // by its number in the window
  MountError<Pose> mount() const { return mount_; }
  double systematic(Index number) const {
    return state_.systematic(number) + (iterating_ ? workspace_.error_window[kDof + number] : 0.0);
  }

  // --- linearise --- `fill(nullptr)` fills the batch at the iterate; `fill(residual)` writes only its residual there.
  // Both return false if a row has no residual. Forms H P and S.
  template <class Fill>
  void linearise(Fill&& fill) {
    require(stage_ != Stage::committed, "linearise");
    if (!fill(nullptr))
      throw Error(ErrorCode::numerical,
                  "sensor: it refused a landmark that it had accepted earlier in this update; nothing was changed");
    compute_innovation();
  }
  Batch& batch() { return workspace_.batch; }
  const Batch& batch() const { return workspace_.batch; }
  // Add blocks to rows that the batch already has. The Jacobians are with respect to ordinary errors. Add the pose's
  // block first, then the blocks of the landmarks that the rows depend on (numbers in the window); pass each of them
  // the return value of the pose's call. `relative`: the rows depend on the pose only through points R^T (l - p), so
  // that the attitude's columns of the invariant error are exactly zero.
  struct PoseBlock {
    double* value;
    bool turns;  // it has columns for the attitude
  };
  template <class JPose>
  PoseBlock add_pose_block(Index row, Index rows, const JPose& J_pose, bool relative);
  template <class JLandmark>
  void add_landmark_block(Index row, Index rows, const JLandmark& J_landmark, Index number, const PoseBlock& pose);
  template <class JMount>
  void add_mount_block(Index row, Index rows, const JMount& J_mount);
  // By `count` systematic errors, from number `first` on.
  template <class JErrors>
  void add_systematic_block(Index row, Index rows, const JErrors& J_errors, Index first, Index count);

  // --- gates ---
  // Squared Mahalanobis distance of one block of `rows` rows by itself; infinity if its S is not positive definite.
  double distance(Index block, Index rows) const;
  // Keeps only these blocks of `rows` rows, in rising order, and their S; the window stays.
  void keep(const Index* blocks, Index count, Index rows);
  void form_innovation();      // S once more, from the current H P
  InverseInnovation invert();  // of the current S; throws if it is not positive definite
  Index* kept() { return workspace_.kept; }
  bool* refused() { return workspace_.refused; }
  // S = L L^T, and nis(). Throws if S is not positive definite.
  void factor() {
    if (!try_factor()) throw_not_definite();
  }
  double nis() const { return nis_; }  // r^T S^-1 r of the last factor()
  // S from its entry (row, row) on; leading dimension batch().rows(). Before factor().
  const double* covariance(Index row) const { return workspace_.S + row * (batch().rows() + 1); }
  // After factor(): x <- L^-1 x, and L^-1 r.
  void whiten(double* x) const;
  const double* innovation() const { return workspace_.innovation; }

  // --- iterate --- Gauss-Newton on the factored batch (iterated EKF, Bell and Cathey 1993); returns how often the
  // batch was linearised. It ends when the linear model predicts the residual. Rows that are not relative have
  // Jacobians that change with the position, and the residual does not show this change: they are linearised at least
  // twice.
  template <class Fill>
  int iterate(const Iterations& end, Fill&& fill) {
    int i = 1;
    for (;; ++i) {
      solve();
      if (i >= end.most) break;
      step();
      // If a landmark loses its image on the way, the last linearisation is used.
      if (!fill(workspace_.residual)) break;
      const bool settled = end.settled == nullptr || *end.settled;
      if (settled && (end.relative || i > 1) && !(misfit(workspace_.residual) > end.tolerance)) break;
      linearise(fill);
      factor();
    }
    return i;
  }
  void solve();                                 // the iterate's error against the estimate
  void step();                                  // iterate <- estimate retracted by that error
  double misfit(const double* residual) const;  // misfit of the linear model at the iterate, sigmas
  // The pose and the mount's error that the commit will give, up to rounding.
  Pose solved_pose() const;
  MountError<Pose> solved_mount() const;

  // --- commit --- P and every variable. Throws, with nothing changed, if a variance of P would not stay positive or
  // a value not finite. This check costs O(n m) and finds most updates after which P is not definite;
  // State::smallest_pivot() is a full test.
  void commit() {
    if (!try_commit()) throw_not_definite();
  }

  // --- place --- after the commit, or if the batch is empty: appends a new landmark that depends on the pose, on
  // the window's mount (J_mount may be null), on systematic errors (`errors` may be null) and on independent noise.
  // Returns false, with nothing changed, if a result is not finite. The caller checks the capacity.
  bool place(const Point& position, const PointByPose& J_pose, const PointByMount* J_mount, const PointSquare& noise,
             bool relative, const ErrorColumns<kDim>* errors = nullptr);

 private:
  static constexpr double kLeast = 1e-14;      // a variance after an update, relative to the variance before it
  static constexpr double kFarthest = 1e12;    // m by which an update may move a point
  static constexpr double kHardlyKnown = 1e8;  // m^2, variance of a position

  enum class Stage { open, linearised, factored, solved, committed };
  void require(bool legal, const char* call) const;
  Point local(Index number) const { return Eigen::Map<const Point>(workspace_.iterate_points + kDim * number); }
  Eigen::Map<Point> place_of(Index number) { return Eigen::Map<Point>(workspace_.iterate_points + kDim * number); }
  void gather_columns();
  void compute_innovation();
  bool try_factor();
  bool try_commit();
  bool pose_alone() const { return state_.size() == 0 && window_.mount_size() == 0; }
  bool commit_pose_alone();
  void correlate_mount();

  State<Pose>& state_;
  UpdateWorkspace<Pose>& workspace_;
  WindowLayout<Pose> window_;
  Stage stage_ = Stage::open;
  bool iterating_ = false;
  Pose pose_;
  MountError<Pose> mount_ = MountError<Pose>::Zero();
  MountSquare<Pose> mount_covariance_ = MountSquare<Pose>::Zero();
  double nis_ = 0.0;
};

template <class Pose>
EkfUpdate<Pose> State<Pose>::begin(const Window& window) {
  return EkfUpdate<Pose>(*this, window);
}

template <class Pose>
template <class JPose>
typename EkfUpdate<Pose>::PoseBlock EkfUpdate<Pose>::add_pose_block(Index row, Index rows, const JPose& J_pose,
                                                                    bool relative) {
  // With e_x = xi_x + G(x) xi_R the columns of p and l stay, and those of R become J_theta + J_p G(p) + J_l G(l).
  const bool turns = !(relative && state_.model_.invariant());
  const Index columns = turns ? kDof : kDim;
  double* block = batch().add_jacobian(row, rows, StateLayout<Pose>::pose().offset, columns);
  for (Index c = 0; c < columns; ++c)
    for (Index r = 0; r < rows; ++r) block[c * rows + r] = J_pose(r, c);
  if (turns) state_.model_.add_turn(rows, J_pose, pose_.translation(), block);
  return {block, turns};
}

template <class Pose>
template <class JLandmark>
void EkfUpdate<Pose>::add_landmark_block(Index row, Index rows, const JLandmark& J_landmark, Index number,
                                         const PoseBlock& pose) {
  double* block = batch().add_jacobian(row, rows, window_.point(number), kDim);
  for (Index c = 0; c < kDim; ++c)
    for (Index r = 0; r < rows; ++r) block[c * rows + r] = J_landmark(r, c);
  if (pose.turns) state_.model_.add_turn(rows, J_landmark, local(number), pose.value);
}

template <class Pose>
template <class JMount>
void EkfUpdate<Pose>::add_mount_block(Index row, Index rows, const JMount& J_mount) {
  double* block = batch().add_jacobian(row, rows, window_.mount(), kMount);
  for (Index c = 0; c < kMount; ++c)
    for (Index r = 0; r < rows; ++r) block[c * rows + r] = J_mount(r, c);
}

template <class Pose>
template <class JErrors>
void EkfUpdate<Pose>::add_systematic_block(Index row, Index rows, const JErrors& J_errors, Index first, Index count) {
  double* block = batch().add_jacobian(row, rows, kDof + first, count);
  for (Index c = 0; c < count; ++c)
    for (Index r = 0; r < rows; ++r) block[c * rows + r] = J_errors(r, c);
}

extern template class EkfUpdate<SE2>;
extern template class EkfUpdate<SE3>;

}  // namespace cairn
