// SPDX-License-Identifier: BSD-3-Clause
// A slow, dense filter as a reference.
#include "reference_filter.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cairn::test {
namespace {

Vector3 piece(const DynamicVector& x, std::size_t at) {
  return x.segment<3>(static_cast<Eigen::Index>(at));
}

// sum of hat(theta)^k / (k + 1)!: the factor of the translations in an exponential of SE_{K+1}(3).
Matrix3 series(const Vector3& theta) {
  Matrix3 sum = Matrix3::Identity(), term = Matrix3::Identity();
  for (int k = 1; k < 30; ++k) {
    term = (term * hat(theta) / (k + 1)).eval();
    sum += term;
  }
  return sum;
}

Dynamic inverse(const Dynamic& S) {
  const Eigen::LLT<Dynamic> factor(S);
  if (factor.info() != Eigen::Success) throw std::runtime_error("the reference's S is not positive definite");
  return factor.solve(Dynamic::Identity(S.rows(), S.cols()));
}

}  // namespace

Dynamic differentiate(const std::function<DynamicVector(const DynamicVector&)>& f, Eigen::Index inputs) {
  constexpr double kStep = 1.0 / 128;
  constexpr double kWeights[4] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  Dynamic J;
  for (Eigen::Index i = 0; i < inputs; ++i) {
    DynamicVector slope;
    for (int k = 1; k <= 4; ++k) {
      DynamicVector x = DynamicVector::Zero(inputs);
      x[i] = k * kStep;
      const DynamicVector above = f(x), below = f(-x), part = kWeights[k - 1] / kStep * (above - below);
      slope = k == 1 ? part : DynamicVector(slope + part);
    }
    if (i == 0) J.resize(slope.size(), inputs);
    J.col(i) = slope;
  }
  return J;
}

ReferenceFilter::ReferenceFilter(const Options& options, const SE3& pose, const Matrix6& ordinary_covariance)
    : options_(options) {
  state_.pose = pose;
  const Dynamic B = ordinary_by_own().inverse();
  P_ = B * ordinary_covariance * B.transpose();
}

int ReferenceFilter::find(std::uint64_t id) const {
  const auto at = std::find(ids_.begin(), ids_.end(), id);
  return at == ids_.end() ? -1 : static_cast<int>(at - ids_.begin());
}

// R = Exp(xi_R) R_hat. Position and landmarks: invariant x = Exp(xi_R) x_hat + J(xi_R) xi_x, which is the exponential
// of SE_{K+1}(3) times the state; standard x = x_hat + e_x (docs/invariant_error.md).
ReferenceState ReferenceFilter::retract(const ReferenceState& state, const DynamicVector& error) const {
  const Vector3 turn = piece(error, 3);
  const SO3 R = SO3::exp(turn);
  const Matrix3 V = options_.invariant ? series(turn) : Matrix3(Matrix3::Identity());
  const auto move = [&](const Vector3& x, const Vector3& e) {
    return Vector3((options_.invariant ? R * x : x) + V * e);
  };
  ReferenceState result = state;
  result.pose = SE3(R * state.pose.rotation(), move(state.pose.translation(), piece(error, 0)));
  for (std::size_t i = 0; i < state.landmarks.size(); ++i)
    result.landmarks[i] = move(state.landmarks[i], piece(error, 6 + 3 * i));
  for (std::size_t i = 0; i < state.mount.size(); ++i)
    result.mount[i] += error[static_cast<Eigen::Index>(6 + 3 * state.landmarks.size() + i)];
  return result;
}

DynamicVector ReferenceFilter::local(const ReferenceState& from, const ReferenceState& to) const {
  const SO3 R = to.pose.rotation() * from.pose.rotation().inverse();
  const Vector3 turn = R.log();
  const Matrix3 V_inverse = options_.invariant ? Matrix3(series(turn).inverse()) : Matrix3(Matrix3::Identity());
  const auto error = [&](const Vector3& a, const Vector3& b) {
    return Vector3(V_inverse * (b - (options_.invariant ? R * a : a)));
  };
  DynamicVector result(from.size());
  result.head<3>() = error(from.pose.translation(), to.pose.translation());
  result.segment<3>(3) = turn;
  for (std::size_t i = 0; i < from.landmarks.size(); ++i)
    result.segment<3>(static_cast<Eigen::Index>(6 + 3 * i)) = error(from.landmarks[i], to.landmarks[i]);
  for (std::size_t i = 0; i < from.mount.size(); ++i)
    result[static_cast<Eigen::Index>(6 + 3 * from.landmarks.size() + i)] = to.mount[i] - from.mount[i];
  return result;
}

// Derivative of the ordinary error by the filter's own error.
Dynamic ReferenceFilter::ordinary_by_own() const {
  return differentiate(
      [&](const DynamicVector& error) {
        const ReferenceState moved = retract(state_, error);
        DynamicVector e(state_.size());
        e.head<3>() = moved.pose.translation() - state_.pose.translation();
        e.segment<3>(3) = (moved.pose.rotation() * state_.pose.rotation().inverse()).log();
        for (std::size_t i = 0; i < state_.landmarks.size(); ++i)
          e.segment<3>(static_cast<Eigen::Index>(6 + 3 * i)) = moved.landmarks[i] - state_.landmarks[i];
        return e;
      },
      state_.size());
}

Dynamic ReferenceFilter::ordinary_covariance() const {
  const Dynamic A = ordinary_by_own();
  return A * P_ * A.transpose();
}

void ReferenceFilter::predict(const Motion& motion, const Dynamic& noise_covariance) {
  const auto after = [&](const ReferenceState& before, const DynamicVector& noise) {
    ReferenceState result = before;
    result.pose = motion(before.pose, noise);
    return result;
  };
  const Eigen::Index noises = noise_covariance.rows();
  const DynamicVector none = DynamicVector::Zero(noises);
  const ReferenceState next = after(state_, none);
  const Dynamic F = differentiate(
      [&](const DynamicVector& error) { return local(next, after(retract(state_, error), none)); }, state_.size());
  const Dynamic G =
      differentiate([&](const DynamicVector& noise) { return local(next, after(state_, noise)); }, noises);
  P_ = (F * P_ * F.transpose() + G * noise_covariance * G.transpose()).eval();
  state_ = next;
}

void ReferenceFilter::predict_twist(const Vector3& v, const Vector3& w, double dt, const TwistNoise& noise) {
  Vector6 twist, sigma;
  twist << v, w;
  sigma << noise.velocity_sigma, noise.rate_sigma;
  predict([&](const SE3& T, const DynamicVector& n) { return T * SE3::exp(Vector6(dt * (twist + n))); },
          Matrix6(sigma.cwiseAbs2().asDiagonal()));
}

// (Mars paper, eq. 1): noise of the left and right rates, then of the components that wheels do not measure.
void ReferenceFilter::predict_wheels(const Wheels& wheels, double left, double right, double dt) {
  const auto twist = [&](const DynamicVector& n) {
    const double l = left + n[0], r = right + n[1];
    const double yaw = wheels.radius / wheels.track * (wheels.yaw_left_minus_right ? l - r : r - l);
    Vector6 t;
    t << wheels.radius * (l + r) / 2, n[2], n[3], n[4], n[5], yaw;
    return t;
  };
  Vector6 sigma;
  sigma << std::hypot(wheels.rate_sigma, wheels.slip_sigma * left),
      std::hypot(wheels.rate_sigma, wheels.slip_sigma * right), wheels.lateral_sigma, wheels.vertical_sigma,
      wheels.roll_rate_sigma, wheels.pitch_rate_sigma;
  predict([&](const SE3& T, const DynamicVector& n) { return T * SE3::exp(Vector6(dt * twist(n))); },
          Matrix6(sigma.cwiseAbs2().asDiagonal()));
}

void ReferenceFilter::predict_increment(const SE3& T_before_after, const Matrix6& covariance) {
  predict(
      [&](const SE3& T, const DynamicVector& n) {
        return T * SE3(SO3::exp(piece(n, 3)) * T_before_after.rotation(), T_before_after.translation() + piece(n, 0));
      },
      covariance);
}

// Gauss-Newton. P stays in the coordinates of the prior: xi <- P H^T S^-1 (r + H xi), H by the error at the iterate
// (docs/update.md).
FrameResult ReferenceFilter::update(const Residual& residual, const Noise& noise, int least, int iterations) {
  FrameResult result;
  const Eigen::Index n = state_.size();
  ReferenceState iterate = state_;
  DynamicVector xi = DynamicVector::Zero(n), r, r_next;
  Dynamic H, R, K;
  if (!residual(iterate, r)) throw std::runtime_error("the reference has no residual at its prediction");
  for (int i = 1;; ++i) {
    H = -differentiate(
        [&](const DynamicVector& error) {
          DynamicVector moved;
          if (!residual(retract(iterate, error), moved)) throw std::runtime_error("no residual beside the iterate");
          return moved;
        },
        n);
    R = noise(iterate);
    const Dynamic S_inverse = inverse(H * P_ * H.transpose() + R);
    if (i == 1) result.nis = r.dot(S_inverse * r);
    K = P_ * H.transpose() * S_inverse;
    const DynamicVector y = r + H * xi;
    xi = K * y;
    result.iterations = i;
    if (i >= iterations) break;
    const ReferenceState next = retract(state_, xi);
    if (!residual(next, r_next)) break;
    const DynamicVector foreseen = y - H * xi;
    if (i >= least &&
        (r_next - foreseen).cwiseQuotient(DynamicVector(R.diagonal().cwiseSqrt())).norm() <= options_.tolerance)
      break;
    iterate = next;
    r = r_next;
  }
  const Dynamic L = Dynamic::Identity(n, n) - K * H;
  P_ = (L * P_ * L.transpose() + K * R * K.transpose()).eval();  // Joseph's form
  state_ = retract(state_, xi);
  return result;
}

FrameResult ReferenceFilter::update_position(const Vector3& position, const Matrix3& covariance,
                                             const Vector3& lever_arm) {
  const auto residual = [&](const ReferenceState& x, DynamicVector& out) {
    return out = position - x.pose * lever_arm, true;
  };
  return update(
      residual, [&](const ReferenceState&) { return covariance; }, 2, options_.iterations);
}

FrameResult ReferenceFilter::update_attitude(const SO3& attitude, const Matrix3& covariance) {
  const auto residual = [&](const ReferenceState& x, DynamicVector& out) {
    return out = (attitude * x.pose.rotation().inverse()).log(), true;
  };
  return update(
      residual, [&](const ReferenceState&) { return covariance; }, 2, options_.iterations);
}

FrameResult ReferenceFilter::update_heading(double heading, double sigma) {
  const auto residual = [&](const ReferenceState& x, DynamicVector& out) {
    const Vector3 forward = x.pose.rotation() * Vector3::UnitX();
    return out.setConstant(1,
                           std::remainder(heading - std::atan2(forward.y(), forward.x()), 2 * 3.14159265358979323846)),
           true;
  };
  // The second order of a tilt is noise: (a_z^2 / c^2 times the largest variance of the tilt)^2 (docs/sensors.md).
  const Vector3 a = state_.pose.rotation() * Vector3::UnitX();
  const Eigen::Matrix2d tilt = ordinary_covariance().block<2, 2>(3, 3);
  const double level = a.x() * a.x() + a.y() * a.y();
  const double second = a.z() * a.z() / level * Eigen::JacobiSVD<Eigen::Matrix2d>(tilt).singularValues()(0);
  const double variance = sigma * sigma + second * second;
  return update(
      residual, [&](const ReferenceState&) { return Dynamic::Constant(1, 1, variance); }, 2, options_.iterations);
}

FrameResult ReferenceFilter::update_linear(const DynamicVector& residual, const Dynamic& covariance,
                                           const Dynamic& J_pose, const std::vector<std::uint64_t>& ids,
                                           const Dynamic& J_landmarks) {
  Dynamic J = Dynamic::Zero(residual.size(), state_.size());
  J.leftCols(6) = J_pose;
  for (std::size_t i = 0; i < ids.size(); ++i)
    J.middleCols(6 + 3 * find(ids[i]), 3) = J_landmarks.middleCols(static_cast<Eigen::Index>(3 * i), 3);
  const Dynamic H = J * ordinary_by_own();
  const ReferenceState prior = state_;
  const auto linear = [&](const ReferenceState& x, DynamicVector& out) {
    return out = residual - H * local(prior, x), true;
  };
  return update(
      linear, [&](const ReferenceState&) { return covariance; }, 1, 1);
}

void ReferenceFilter::remove(std::uint64_t id) {
  const Eigen::Index gone = find(id), n = state_.size();
  Dynamic select = Dynamic::Zero(n - 3, n);
  for (Eigen::Index i = 0; i < n - 3; ++i) select(i, i < 6 + 3 * gone ? i : i + 3) = 1;
  P_ = (select * P_ * select.transpose()).eval();
  state_.landmarks.erase(state_.landmarks.begin() + gone);
  ids_.erase(ids_.begin() + gone);
}

}  // namespace cairn::test
