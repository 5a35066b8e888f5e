// SPDX-License-Identifier: BSD-3-Clause
// The state of a filter: one pose, systematic errors, many points (landmarks and companions), and their covariance, of
// which this class is the only owner. ErrorModel defines which error the covariance describes. StateLayout defines the
// offset of each variable.
//
// Only the lower triangle of P is kept. Motion between two updates costs O(1): PendingMotion holds it back until the
// next update. begin() makes an update (ekf_update.hpp).
//
// Companions are other vehicles. A companion's position is a point, in one of the first slots; its attitude is a block
// of its own. The filter's pose is that of one vehicle, the active one; activate() changes which vehicle this is.
#pragma once

#include <vector>

#include "core/arena.hpp"
#include "ekf/error_model.hpp"
#include "ekf/pending_motion.hpp"
#include "ekf/state_layout.hpp"
#include "ekf/update_workspace.hpp"
#include "linear/lower_triangle.hpp"
#include "motion/motion.hpp"
#include "sensor/sensor.hpp"

namespace cairn {

template <class Pose>
class EkfUpdate;

template <class Pose>
class State {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  static constexpr int kMount = kMountErrors<Pose>;  // errors of a sensor's mount that a frame may have in common
  using Rotation = typename Pose::Rotation;
  using Point = typename Pose::Point;
  using Tangent = typename Pose::Tangent;
  using Square = typename Pose::Square;
  using PointSquare = Eigen::Matrix<double, kDim, kDim>;
  using PointByPose = Eigen::Matrix<double, kDim, kDof>;
  using PointByMount = Eigen::Matrix<double, kDim, kMount>;
  using Capacity = StateCapacity<Pose>;

  State(Arena& arena, ErrorKind error, const Capacity& capacity);

  // The systematic errors at a start: numbers that are independent of the pose. Motion depends on the first ones.
  struct SystematicStart {
    Index count = 0, motion = 0;
    const double* values = nullptr;
    const double* walk = nullptr;        // variance by which each walks in one second
    const double* covariance = nullptr;  // count x count, symmetric
  };
  // Forgets everything. `covariance` is the covariance of the ordinary error [dp; dtheta].
  void start(const Pose& pose, const Square& ordinary_covariance, const SystematicStart& systematic = {});

  // --- estimates ---
  const ErrorModel<Pose>& model() const { return model_; }
  Pose pose() const { return Pose(pose_.rotation(), pose_.translation() + origin_); }
  Index size() const { return layout_.points(); }  // slots: companions, then landmarks
  Index states() const { return layout_.states(); }
  Point landmark(Index slot) const { return local(slot) + origin_; }
  Index systematic() const { return layout_.systematic(); }
  double systematic(Index number) const { return systematic_[number]; }

  // --- propagate --- O(1), and O(n^2) where the origin moves. Returns false, with nothing changed, if a result is not
  // finite.
  bool propagate(const Increment<Pose>& increment, const MotionCoupling<Pose>* coupling = nullptr);
  // Adds an independent error of the pose, with this covariance of the ordinary error, to the motion that is held back.
  bool widen(const Square& ordinary_covariance);
  // Moves the vehicle by this ordinary error. The covariance of the state's own errors stays.
  void shift(const Tangent& ordinary_error) { pose_ = retract(pose_, ordinary_error); }
  // What widen() and shift() change.
  struct Held {
    Pose pose;
    typename PendingMotion<Pose>::Snapshot motion;
  };
  Held held() const { return {pose_, motion_.snapshot()}; }
  void restore(const Held& held) {
    pose_ = held.pose;
    motion_.restore(held.motion);
  }

  // --- update --- of the pose, of a mount if `mount_noise` is given, and of the chosen points; O(states window).
  struct Window {
    const Index* slots = nullptr;
    Index count = 0;
    const MountSquare<Pose>* mount_noise = nullptr;  // of a mount whose error a whole frame has in common
  };
  EkfUpdate<Pose> begin(const Window& window);
  double* scratch() { return workspace_.scratch; }  // m^2 + cholesky_workspace(m) doubles, m = rows(), between updates

  // --- marginals ---
  // Joint covariance of the pose and `count` points, both triangles, in the state's own error coordinates.
  void gather(const Index* slots, Index count, double* out, Index ld) const;
  // The same with the systematic errors behind the pose: [pose; systematic errors; points]. `ordinary`: of the ordinary
  // errors of pose and points. Allocates.
  void gather_systematic(const Index* slots, Index count, double* out, Index ld, bool ordinary = false) const;
  // Covariance of the systematic errors, both triangles.
  void systematic_covariance(double* out) const;
  // The same as gather() in ordinary errors.
  void gather_ordinary(const Index* slots, Index count, double* out, Index ld) const;
  // Covariance of e_l - e_p - turn(l - p) e_R, the only error that affects a sensor of R^T (l - p). With the invariant
  // error it is the covariance of xi_l - xi_p.
  PointSquare relative_covariance(Index slot) const;
  Square pose_covariance() const;  // ordinary
  PointSquare landmark_covariance(Index slot) const;
  // Normalised error squared of the pose in the state's own coordinates; negative if its covariance is singular.
  double pose_nees(const Pose& truth) const;
  // The same of any estimate with an ordinary covariance; the invariant error counts positions from `origin`.
  static double nees(ErrorKind error, const Point& origin, const Pose& truth, const Pose& estimate,
                     const Square& ordinary_covariance);
  // Smallest pivot of the Cholesky factor of P scaled to unit diagonal; uses the upper triangle as scratch.
  double smallest_pivot();

  // --- points ---
  // A mount whose error the last update estimated together with the state.
  struct SharedMount {
    const MountSquare<Pose>& covariance;
    double* cross;  // of every state with it; gets the new point's rows
  };
  // Appends a landmark that depends on the pose (ordinary Jacobian), on a shared mount (J_mount and `mount` may be
  // null), on systematic errors (`errors` may be null), and on independent noise. Returns false, with nothing changed,
  // if a result is not finite. The caller checks the capacity.
  bool augment(const Point& position, const PointByPose& J_pose, const PointSquare& noise, bool relative,
               const PointByMount* J_mount = nullptr, const SharedMount* mount = nullptr,
               const ErrorColumns<kDim>* errors = nullptr);
  // Removes a landmark; the last one moves into its slot.
  void remove(Index slot);
  // Two landmarks change slots.
  void exchange_landmarks(Index a, Index b);
  // Appends a landmark at the position of another one, with an additional independent error. The caller checks the
  // capacity.
  void duplicate(Index slot, const PointSquare& noise);

  // --- companions --- numbered from 0, by the slots of their positions
  Index companions() const { return layout_.companions(); }
  Pose companion(Index k) const { return Pose(attitudes_[k], landmark(k)); }
  Square companion_covariance(Index k) const;  // ordinary
  // Adds a companion. Its ordinary error is J_pose times that of the state's pose, plus independent noise. J_pose is
  // zero if the companion's pose was given and not observed. The landmark that had the companion's slot moves behind
  // the last one. The caller checks the capacity. Returns false, with nothing changed, if a result is not finite.
  bool add_companion(const Pose& pose, const Square& J_pose, const Square& noise);
  void remove_companion(Index k);  // the last companion becomes number k, the last landmark the first one
  // Exchanges two vehicles: companion k's pose becomes the state's pose, and the vehicle that had the state's pose
  // becomes companion k. O(n^2) with the invariant error, whose arms then depend on another vehicle's attitude; O(n)
  // with the standard error.
  void activate(Index k);

  // The part of a submap that is composed after the fusion. The submap began at the pose, and an update has already
  // fused its landmarks that the state knows.
  struct Handover {
    Pose T_base_end;
    const Index* fused;  // their slots
    Index fused_count;
    const Point* fresh;  // landmarks not known here, in the submap's frame
    Index fresh_count;
    // Error (of the error model) of [end pose; what walked; fresh landmarks] in the submap: K y + w. w has covariance
    // W, and y is the ordinary error of [systematic errors; base, if by_base; fused landmarks].
    Eigen::MatrixXd K, W;
    bool by_base = false;
    const Index* walking = nullptr;  // systematic errors that walked in the submap
    Index walking_count = 0;
    Eigen::VectorXd walked;  // how far
  };
  // The end pose becomes the state's pose, and the fresh landmarks are appended. The caller checks the capacity.
  // Allocates.
  void compose(const Handover& handover);

  // A copy of everything that an update and a composition change. Allocates.
  struct Backup {
    Pose pose;
    Point origin;
    std::vector<double> points, triangle, systematic;
    std::vector<Rotation> attitudes;
    typename PendingMotion<Pose>::Snapshot motion;
  };
  Backup backup() const;
  void restore(const Backup& backup);  // no landmark may have been removed in between

 private:
  friend class EkfUpdate<Pose>;

  Point local(Index slot) const { return Eigen::Map<const Point>(points_ + kDim * slot); }
  Eigen::Map<Point> place_of(Index slot) { return Eigen::Map<Point>(points_ + kDim * slot); }
  Square pose_block() const { return motion_.pose_block(P_); }  // with the motion held back
  void apply_pending();
  using PointByMotion = Eigen::Matrix<double, kDim, kMotionStates>;
  struct PendingTurn {
    Eigen::Matrix<double, kTurn, kDof> with_pose;
    Eigen::Matrix<double, kTurn, kTurn> own;
  };
  PointByMotion with_motion_states(Index row) const;  // covariance of a point with the motion's systematic errors
  PendingTurn pending_turn() const;
  PointSquare covariance_by(const ErrorColumns<kDim>& errors, const PointByPose& J) const;
  PointSquare relative_change(Index row, const PointByPose& J) const;
  void restore_lost_digits(const double* scale);
  // P <- P_now - W W^T over `rank` columns of W, the pending motion's noise added in the same pass. `columns` are those
  // of the pose and the systematic errors.
  void write_covariance(Index rank, const double* columns);
  void move(const double* error);  // every variable by its retraction
  bool far_from_origin() const;
  void move_origin();  // to the vehicle
  // Raises ordinary variances that a double cannot hold. `before`: the variances of P, state by state, before it
  // changed; `turn`: the sum of those of the attitude.
  void raise_variances(const double* before, double turn);

  ErrorModel<Pose> model_;
  StateLayout<Pose> layout_;
  Index ld_;  // of P and of every array with one row for each state
  // All positions below are relative to the origin: the start position, until the vehicle is far from it. The arms G(x)
  // of the invariant error reach from the origin to x. With an origin far away, the arms would be long and the
  // covariance would lose its digits to rounding.
  Point origin_ = Point::Zero();
  Pose pose_;
  double* points_;
  Rotation* attitudes_;  // of the companions
  double* systematic_;
  double* walk_;  // of the systematic errors, variance in one second
  LowerTriangle P_;
  PendingMotion<Pose> motion_;
  UpdateWorkspace<Pose> workspace_;
};

extern template class State<SE2>;
extern template class State<SE3>;

}  // namespace cairn
