// SPDX-License-Identifier: BSD-3-Clause
// Scenarios that drive the filter and its reference.
#include "reference_scenario.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::test {
namespace {

Vector3 noisy(Random& random, const Vector3& x, const Vector3& sigma) {
  return x + sigma.cwiseProduct(random.normal_vector<3>());
}

ReferenceFilter::Options reference_options(const FilterOptions<SE3>& o) {
  return {o.error == ErrorKind::invariant, o.iterations, o.iteration_tolerance, o.gate_probability,
          o.batch_gate_probability};
}

bool near(double a, double b) {
  return std::abs(a - b) <= 1e-8 * (1 + std::abs(b));
}

// z = l - p
std::int32_t compass_predict(void*, const double* pose, const double* l, double* z, double* J_pose,
                             double* J_landmark) {
  for (int i = 0; i < 3; ++i) {
    z[i] = l[i] - pose[i];
    for (int k = 0; k < 6; ++k) J_pose[6 * i + k] = k == i ? -1 : 0;
    for (int k = 0; k < 3; ++k) J_landmark[3 * i + k] = k == i ? 1 : 0;
  }
  return 1;
}

std::int32_t compass_place(void*, const double* pose, const double* z, double* l, double* J_pose, double* J_z) {
  for (int i = 0; i < 3; ++i) {
    l[i] = pose[i] + z[i];
    for (int k = 0; k < 6; ++k) J_pose[6 * i + k] = k == i ? 1 : 0;
    for (int k = 0; k < 3; ++k) J_z[3 * i + k] = k == i ? 1 : 0;
  }
  return 1;
}

}  // namespace

Pair::Pair(const FilterOptions<SE3>& options)
    : arena_(std::make_unique<Arena>(Filter<SE3>::arena_bytes(options))),
      filter_(std::make_unique<Filter<SE3>>(*arena_, options)),
      reference_(reference_options(options), options.initial_pose, options.initial_covariance) {}

int Pair::add(const Sensor<SE3>& sensor) {
  sensors_.push_back(&sensor);
  if (const auto* head = dynamic_cast<const StereoHead*>(&sensor)) return filter_->add(*head);
  if (const auto* camera = dynamic_cast<const StereoCamera*>(&sensor)) return filter_->add(*camera);
  if (const auto* point = dynamic_cast<const Cartesian<SE3>*>(&sensor)) return filter_->add(*point);
  return filter_->add(dynamic_cast<const CustomSensor<SE3>&>(sensor));
}

void Pair::set_noise(const TwistNoise& twist, const Wheels& wheels) {
  filter_->set_twist_noise(twist_noise_ = twist);
  filter_->set_wheels(wheels_ = wheels);
}

void Pair::predict_twist(const Vector3& v, const Vector3& w, double dt) {
  filter_->predict_twist(dt, v, w);
  reference_.predict_twist(v, w, dt, twist_noise_);
}

void Pair::predict_wheels(double left, double right, double dt) {
  filter_->predict_wheels(dt, left, right);
  reference_.predict_wheels(wheels_, left, right, dt);
}

void Pair::predict_increment(const SE3& T, const Matrix6& covariance) {
  filter_->propagate({T, covariance});
  reference_.predict_increment(T, covariance);
}

void Pair::remove(std::uint64_t id) {
  filter_->remove_landmark(id);
  reference_.remove(id);
}

bool Pair::update(int sensor, const std::vector<Seen>& frame) {
  std::vector<Observation> observations(frame.size());
  for (std::size_t i = 0; i < frame.size(); ++i) {
    Observation& o = observations[i];
    o = {frame[i].id, {}, {}};
    std::copy_n(frame[i].z.data(), 3, o.z);
    if (frame[i].noise != sensors_[static_cast<std::size_t>(sensor)]->noise())
      std::copy_n(frame[i].noise.data(), 9, o.covariance);
  }
  filter_->update(sensor, observations.data(), static_cast<Index>(frame.size()));
  const FrameResult expected = reference_.update_frame(*sensors_[static_cast<std::size_t>(sensor)], frame);
  bool same = filter_->report().iterations == expected.iterations && near(filter_->report().nis, expected.nis);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Match& match = filter_->matches()[i];
    same = same && (match.decision != Decision::rejected) == expected.taken[i];
    if (match.reason != Reason::batch_gate) same = same && near(match.distance, std::max(0.0, expected.distance[i]));
  }
  return same;
}

Difference Pair::difference() {
  Difference worst;
  const std::vector<std::uint64_t>& ids = reference_.ids();
  const ReferenceState& x = reference_.state();
  const auto note = [&](const Vector3& a, const Vector3& b) {
    worst.state = std::max(worst.state, (a - b).norm() / (1 + b.norm()));
  };
  note(filter_->pose().translation(), x.pose.translation());
  note((filter_->pose().rotation() * x.pose.rotation().inverse()).log(), Vector3::Zero());
  const Landmarks& landmarks = filter_->landmarks();
  if (landmarks.size() != ids.size()) return {1, 1};
  std::vector<std::size_t> indices(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (!landmarks.find(ids[i], indices[i])) return {1, 1};
    note(landmarks.position(indices[i]), x.landmarks[i]);
  }
  const Dynamic expected = reference_.ordinary_covariance();
  Dynamic actual(expected.rows(), expected.cols());
  filter_->pose_joint_covariance(indices.data(), indices.size(), actual.data());
  for (Eigen::Index c = 0; c < expected.cols(); ++c)
    for (Eigen::Index r = 0; r < expected.rows(); ++r) {
      const double scale = std::sqrt(expected(r, r) * expected(c, c)), off = std::abs(actual(r, c) - expected(r, c));
      worst.covariance = std::max(worst.covariance, off / (scale + 1e-15));
    }
  return worst;
}

StereoHead scenario_head(double encoder_sigma, bool per_frame) {
  StereoHeadParameters p;
  p.platform << 0.3, -0.1, 1.2;
  p.stick << 0.15, 0.05, 0.2;
  p.R_stick_camera = SO3::exp(Vector3(0.1, 0.2, -0.2));
  p.range_sigma = 0.3;
  p.azimuth_sigma = p.elevation_sigma = 0.02;
  p.pan_sigma = encoder_sigma;
  p.stick_sigma = 0.7 * encoder_sigma;
  p.encoder_per_frame = per_frame;
  StereoHead head(p);
  head.point(0.4, -0.15);
  return head;
}

StereoCamera scenario_camera() {
  StereoCameraParameters p;
  p.baseline = 0.4;
  p.T_body_camera = SE3(p.T_body_camera.rotation() * SO3::exp(Vector3(0.1, -0.3, 0.05)), Vector3(0.4, 0.1, 1.1));
  return StereoCamera(p);
}

Cartesian<SE3> scenario_points() {
  CartesianParameters<SE3> p;
  p.T_body_sensor = SE3(SO3::exp(Vector3(0.3, -0.5, 1.0)), Vector3(-0.2, 0.3, 0.8));
  p.sigma << 0.1, 0.2, 0.15;
  return Cartesian<SE3>(p);
}

CustomSensor<SE3> scenario_compass() {
  CustomParameters p;
  p.predict = compass_predict;
  p.place = compass_place;
  p.sigma << 0.2, 0.1, 0.3;
  return CustomSensor<SE3>(p);
}

Matrix6 random_covariance(Random& random, double metres, double radians) {
  Matrix6 A;
  for (int i = 0; i < 6; ++i) A.col(i) = random.normal_vector<6>();
  A.topRows<3>() *= metres / std::sqrt(6.0);
  A.bottomRows<3>() *= radians / std::sqrt(6.0);
  const Matrix6 square = A * A.transpose();
  return 0.5 * (square + square.transpose());
}

FilterOptions<SE3> random_options(ErrorKind error, Random& random) {
  FilterOptions<SE3> options;
  options.error = error;
  options.max_landmarks = 20;
  options.max_observations = 10;
  options.gate_probability = options.batch_gate_probability = 1;
  options.initial_pose = SE3{SO3::exp(random.normal_vector<3>()), 20 * random.normal_vector<3>()};
  const double metres = random.uniform(0.01, 1), radians = random.uniform(0.01, 0.1);
  options.initial_covariance = random_covariance(random, metres, radians);
  return options;
}

Drive::Drive(unsigned seed, const FilterOptions<SE3>& options, int landmarks)
    : random_(seed), truth_(options.initial_pose) {
  for (int i = 0; i < landmarks; ++i)
    landmarks_.push_back(truth_ * Vector3{random_.uniform(-5, 25), random_.uniform(-15, 15), random_.uniform(-4, 4)});
}

void Drive::move(Pair& pair) {
  const TwistNoise twist{Vector3(0.05, 0.02, 0.03), Vector3(0.01, 0.02, 0.015)};
  Wheels wheels;
  wheels.yaw_left_minus_right = random_.uniform(0, 1) < 0.5;
  pair.set_noise(twist, wheels);
  const int motions = 1 + static_cast<int>(random_.uniform(0, 4));
  for (int i = 0; i < motions; ++i) {
    const double dt = random_.uniform(0.1, 0.5), kind = random_.uniform(0, 3);
    Vector6 tau;
    tau << dt * random_.uniform(-1, 2), 0.1 * dt * random_.normal_vector<2>(), 0.2 * dt * random_.normal_vector<3>();
    if (kind < 1) {
      const Vector3 v = noisy(random_, tau.head<3>() / dt, twist.velocity_sigma);
      pair.predict_twist(v, noisy(random_, tau.tail<3>() / dt, twist.rate_sigma), dt);
    } else if (kind < 2) {  // no slip: the rates of the left and right wheels for this forward velocity and yaw rate
      const double forward = tau[0] / dt / wheels.radius;
      const double turn = (wheels.yaw_left_minus_right ? -0.5 : 0.5) * tau[5] / dt * wheels.track / wheels.radius;
      tau << tau[0], 0, 0, 0, 0, tau[5];
      pair.predict_wheels(forward - turn, forward + turn, dt);
    } else {
      const Matrix6 covariance = random_covariance(random_, 0.03, 0.01);
      const SE3 T = SE3::exp(tau);
      const SO3 R = SO3::exp(0.01 * random_.normal_vector<3>()) * T.rotation();
      pair.predict_increment(SE3(R, noisy(random_, T.translation(), Vector3::Constant(0.03))), covariance);
    }
    truth_ = truth_ * SE3::exp(tau);
  }
}

SE3 Drive::advance(const Vector6& tau) {
  truth_ = truth_ * SE3::exp(tau);
  return SE3::exp(tau);
}

std::vector<Seen> Drive::look(const Sensor<SE3>& sensor, std::size_t most, double scale, const Vector2& mount) {
  std::vector<Seen> frame;
  const std::size_t first = static_cast<std::size_t>(random_.uniform(0, static_cast<double>(landmarks_.size())));
  for (std::size_t k = 0; k < landmarks_.size() && frame.size() < most; ++k) {
    const std::size_t i = (first + k) % landmarks_.size();
    const double distance = (landmarks_[i] - truth_.translation()).norm();
    Prediction<SE3> seen;
    Placement<SE3> placed;
    if (distance < 2 || distance > 25 || !sensor.predict(truth_, landmarks_[i], mount, seen)) continue;
    Seen one{i + 100, seen.z, sensor.noise()};
    one.z = noisy(random_, seen.z, scale * Vector3(sensor.noise().diagonal().cwiseSqrt()));
    if (!sensor.place(truth_, one.z, mount, placed))
      continue;  // a point of the camera that is too far away to be useful
    // Nor points so near the edge of an image or the zenith that the steps of the differences lead beyond it.
    if (dynamic_cast<const StereoCamera*>(&sensor) != nullptr && (seen.z[0] < 0 || seen.z[0] > 640)) continue;
    if (dynamic_cast<const StereoHead*>(&sensor) != nullptr && std::abs(seen.z[2]) > 1.2) continue;
    if (random_.uniform(0, 1) < 0.2) {  // correlated noise of the observation replaces the noise of the sensor
      Matrix3 A = Matrix3::Identity();
      A(0, 1) = 0.3, A(2, 0) = -0.2;
      const Vector3 sigma = sensor.noise().diagonal().cwiseSqrt();
      const Matrix3 B = sigma.asDiagonal() * A, noise = B * B.transpose();
      one.noise = 0.5 * (noise + noise.transpose());
    }
    frame.push_back(one);
  }
  return frame;
}

}  // namespace cairn::test
