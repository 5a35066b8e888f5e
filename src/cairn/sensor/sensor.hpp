// SPDX-License-Identifier: BSD-3-Clause
// Interface between the filter and a sensor that observes landmarks, in space or in the plane. A sensor gives values
// and Jacobians. It has no state except its calibration.
#pragma once

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"
#include "geometry/types.hpp"

namespace cairn {

// The largest number of values of an observation, in space and in the plane. Vectors and Jacobians have room for all of
// them; only the first rows() are used.
constexpr int kMostRows = 3;

// Number of errors of a sensor's mount, which the observations of a frame may share. In space: the two angles of a
// stereo head. In the plane: range, bearing and orientation of the mount.
template <class Pose>
constexpr int kMountErrors = Pose::kDim == 3 ? 2 : 3;

template <class Pose>
using MountError = Eigen::Matrix<double, kMountErrors<Pose>, 1>;
template <class Pose>
using MountSquare = Eigen::Matrix<double, kMountErrors<Pose>, kMountErrors<Pose>>;

// The predicted observation of one landmark. J_z_pose is the Jacobian by the ordinary error [dp; dtheta] in the axes of
// the map (docs/notation.md), J_z_mount the Jacobian by the error of the mount.
template <class Pose>
struct Prediction {
  using ByPose = Eigen::Matrix<double, kMostRows, Pose::kDof>;
  using ByLandmark = Eigen::Matrix<double, kMostRows, Pose::kDim>;
  using ByMount = Eigen::Matrix<double, kMostRows, kMountErrors<Pose>>;
  Vector3 z = Vector3::Zero();
  ByPose J_z_pose = ByPose::Zero();
  ByLandmark J_z_landmark = ByLandmark::Zero();
  ByMount J_z_mount = ByMount::Zero();
};

// The landmark that one observation places, and its Jacobians.
template <class Pose>
struct Placement {
  using ByPose = Eigen::Matrix<double, Pose::kDim, Pose::kDof>;
  using ByObservation = Eigen::Matrix<double, Pose::kDim, kMostRows>;
  using ByMount = Eigen::Matrix<double, Pose::kDim, kMountErrors<Pose>>;
  typename Pose::Point landmark = Pose::Point::Zero();
  ByPose J_landmark_pose = ByPose::Zero();
  ByObservation J_landmark_z = ByObservation::Zero();
  ByMount J_landmark_mount = ByMount::Zero();
};

// Whether the mount has noise, and whether its error is the same for all observations of a frame.
enum class MountNoise { none, per_observation, per_frame };

template <class Pose>
class Sensor {
 public:
  using Point = typename Pose::Point;
  using Mount = MountError<Pose>;

  virtual ~Sensor() = default;

  virtual int rows() const { return Pose::kDim; }
  // True if the observation depends on pose and landmark only through the point y = R^T (l - p) in the body frame.
  virtual bool relative() const { return true; }
  // Number of a value whose residual() is a plain difference, not a wrapped angle; negative if there is none.
  // Association sorts observations by this value.
  virtual int plain_row() const { return 0; }
  // Whether predict() and place() may throw. Then a frame calls them only before it changes the state.
  virtual bool may_abort() const { return false; }
  // Default noise of an observation. Only the upper left rows() x rows() block is used.
  virtual const Matrix3& noise() const = 0;
  virtual MountNoise mount_noise_mode() const { return MountNoise::none; }
  virtual MountSquare<Pose> mount_noise() const { return MountSquare<Pose>::Zero(); }

  // Returns false if the landmark cannot be observed from this pose: behind the lens, too near, too steep.
  // `mount` is the assumed error of the mount. It is zero except while an update iterates over a per-frame mount error.
  virtual bool predict(const Pose& T_map_body, const Point& p_map, const Mount& mount, Prediction<Pose>& out) const = 0;

  // Returns false if the observation cannot place a landmark.
  virtual bool place(const Pose& T_map_body, const Vector3& z, const Mount& mount, Placement<Pose>& out) const = 0;

  // z - predicted, angles wrapped to (-pi, pi].
  virtual Vector3 residual(const Vector3& z, const Vector3& predicted) const { return z - predicted; }

  // Whether the stated noise is all the noise. Otherwise larger residuals than stated say nothing about the motion.
  virtual bool bears_witness() const { return true; }
};

// J_p P J_q^T: covariance between the predicted observations of two landmarks, which are number k and l in the joint
// covariance P of [pose; landmarks].
template <class Pose>
Matrix3 image_covariance(const Eigen::Ref<const Eigen::MatrixXd>& P, const Prediction<Pose>& p, Eigen::Index k,
                         const Prediction<Pose>& q, Eigen::Index l) {
  constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  const Eigen::Index row = kDof + kDim * k, column = kDof + kDim * l;
  const typename Prediction<Pose>::ByPose by_pose =
      p.J_z_pose * P.topLeftCorner<kDof, kDof>() + p.J_z_landmark * P.block<kDim, kDof>(row, 0);
  const typename Prediction<Pose>::ByLandmark by_landmark =
      p.J_z_pose * P.block<kDof, kDim>(0, column) + p.J_z_landmark * P.block<kDim, kDim>(row, column);
  return by_pose * q.J_z_pose.transpose() + by_landmark * q.J_z_landmark.transpose();
}

// Chain rule for a sensor that observes the point y = R^T (l - p) in the body frame, given J_z_y at y.
template <class Pose>
void map_jacobians(const Pose& T_map_body, const typename Pose::Point& p_map,
                   const typename Prediction<Pose>::ByLandmark& J_z_y, Prediction<Pose>& out) {
  const typename Prediction<Pose>::ByLandmark J_z_l = J_z_y * T_map_body.rotation().matrix().transpose();
  out.J_z_landmark = J_z_l;
  out.J_z_pose.template leftCols<Pose::kDim>() = -J_z_l;
  // R = Exp(dtheta) R_hat: dy = -R^T turn(l - p) dtheta
  out.J_z_pose.template rightCols<Pose::kTurn>() = -J_z_l * Pose::Rotation::turn(p_map - T_map_body.translation());
}

// The landmark l = p + R y of a point y in the body frame, given J_y_z.
template <class Pose>
void place_body_point(const Pose& T_map_body, const typename Pose::Point& y,
                      const typename Placement<Pose>::ByObservation& J_y_z, Placement<Pose>& out) {
  const typename Pose::Rotation::Matrix R = T_map_body.rotation().matrix();
  const typename Pose::Point arm = R * y;
  out.landmark = T_map_body.translation() + arm;
  out.J_landmark_pose.template leftCols<Pose::kDim>().setIdentity();
  out.J_landmark_pose.template rightCols<Pose::kTurn>() = Pose::Rotation::turn(arm);
  out.J_landmark_z = R * J_y_z;
}

}  // namespace cairn
