// SPDX-License-Identifier: BSD-3-Clause
// Motion, measurements and observations of a rover.
#include "sim/world.hpp"

#include <algorithm>
#include <cmath>

#include "capi/boundary.hpp"
#include "geometry/angle.hpp"
#include "sim/random.hpp"

namespace cairn::sim {
namespace {

Vector3 normal3(Random& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return Vector3(x, y, z);
}

LandmarkField place_landmarks(const cairn_world_options& o, const Terrain& terrain, const Course& course) {
  Random random(o.seed, Stream::landmark), lift(o.seed, Stream::landmark, 1);
  std::vector<Vector3> positions;
  positions.reserve(o.landmarks);
  for (const Vector2& place : course.scatter(random, o.landmarks)) {
    positions.emplace_back(place.x(), place.y(),
                           terrain.height(place.x(), place.y()) + lift.uniform(0, o.landmark_height));
  }
  return LandmarkField(std::move(positions), o.far_range);
}

double scan(double amplitude, double period, double time) {
  return amplitude == 0 ? 0 : amplitude * std::sin(2 * kPi * time / period);
}

}  // namespace

World::World(const cairn_world_options& options)
    : options_(options),
      terrain_(options),
      course_(make_course(options)),
      landmarks_(place_landmarks(options, terrain_, *course_)),
      samples_per_motion_(static_cast<int>(std::lround(options.motion_period / options.imu_period))),
      motions_per_frame_(static_cast<int>(std::lround(options.frame_period / options.motion_period))) {
  const double frames = course_->length() / options.speed / options.frame_period;
  constexpr double kMostFrames = 1e12;
  if (!(frames < kMostFrames))
    throw Error(ErrorCode::argument, "options: this drive would have %g frames; use fewer laps or a higher speed",
                frames);
  steps_ = static_cast<std::size_t>(frames + 1e-9) + 1;
  rewind();
}

Stance World::stance(double time) const {
  const Place place = course_->at(std::min(time * options_.speed, course_->length()));
  if (options_.contact == CAIRN_CONTACT_POINT) return stand_on_point(terrain_, place);
  return stand_on_wheels(terrain_, place, options_.track, options_.wheelbase);
}

SE3 World::pose(std::int64_t sample) const {
  return stance(static_cast<double>(sample) * options_.imu_period).T_map_body;
}

void World::extent(Vector2& lower, Vector2& upper) const {
  lower = upper = Vector2(course_->at(0).x, course_->at(0).y);
  const auto include = [&](const Vector2& p) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  };
  for (const Vector3& p : landmarks_.positions()) include(p.head<2>());
  constexpr double kSpacing = 5,
                   kMost = 1e6;  // m; with wider spacing the course has many laps and passes each place repeatedly
  const double length = course_->length(), spacing = std::max(kSpacing, length / kMost);
  for (double s = 0; s < length; s += spacing) {
    const Place place = course_->at(s);
    include(Vector2(place.x, place.y));
  }
}

void World::rewind() {
  step_ = 0;
  motions_.clear();
  observations_.clear();
  sample_ = 0;
  pose_ = pose(0);
  strapdown_.R_map_body = pose_.rotation();
  strapdown_.velocity = strapdown_.true_velocity = (pose(1).translation() - pose_.translation()) / options_.imu_period;
}

void World::next(cairn_world_step& step) {
  if (step_ >= steps_)
    throw Error(ErrorCode::state, "all %zu steps of the world were handed out; rewind it or create another one",
                steps_);
  // If anything fails, the state is restored.
  const std::int64_t sample = sample_;
  const SE3 pose_before = pose_;
  const Strapdown strapdown = strapdown_;
  motions_.swap(spare_motions_);
  observations_.swap(spare_observations_);
  try {
    move();
    look(pose_);
  } catch (...) {
    sample_ = sample, pose_ = pose_before, strapdown_ = strapdown;
    motions_.swap(spare_motions_);
    observations_.swap(spare_observations_);
    throw;
  }
  step.number = step_;
  step.time = static_cast<double>(step_) * options_.frame_period;
  capi::write_pose(pose_, &step.truth);
  write_noise(step);
  step.pan = scan(options_.pan_amplitude, options_.pan_period, step.time);
  step.stick = scan(options_.stick_amplitude, options_.stick_period, step.time);
  step.motion_count = motions_.size();
  step.observation_count = observations_.size();
  ++step_;
}

// Drives from the previous frame to this one.
void World::move() {
  motions_.clear();
  if (step_ == 0) return;
  for (int m = 0; m < motions_per_frame_; ++m) {
    const SE3 before = pose_;
    samples_.clear();
    for (int i = 0; i < samples_per_motion_; ++i) {
      const SE3 after = pose(sample_ + 1);
      samples_.push_back(measure(pose_, after));
      pose_ = after;
      ++sample_;
    }
    motions_.push_back(compose(samples_, before.inverse() * pose_));
  }
}

World::Sample World::measure(const SE3& before, const SE3& after) {
  const cairn_world_options& o = options_;
  const Vector6 tau = (before.inverse() * after).log() / o.imu_period;
  Sample sample;
  sample.true_velocity = tau.head<3>();
  sample.true_rate = tau.tail<3>();
  sample.true_wheels = wheel_rates(tau[0], tau[5], o.wheel_radius, o.track);
  Random random(o.seed, Stream::motion, static_cast<std::uint64_t>(sample_));
  const Vector3 noise = o.velocity_sigma * normal3(random);
  sample.rate = sample.true_rate + o.rate_sigma * normal3(random) + Vector3(o.rate_bias);
  const Vector2 turning = wheel_rates(tau[0] + o.velocity_bias[0], tau[5], o.wheel_radius, o.track);
  for (int side = 0; side < 2; ++side) {
    const double rate = turning[side] / (1.0 + o.wheel_scale[side]);
    sample.wheels[side] = rate + std::hypot(o.wheel_rate_sigma, o.wheel_slip_sigma * rate) * random.normal();
  }
  if (o.drive == CAIRN_DRIVE_WHEELS_GYRO) {
    // (Mars paper, eq. 1)
    sample.velocity = Vector3(o.wheel_radius * sample.wheels.sum() / 2, o.velocity_bias[1], o.velocity_bias[2]);
  } else if (o.accelerometer == CAIRN_ACCELEROMETER_ACCELERATION) {
    sample.velocity = reckon(before, after, noise, sample.rate) + Vector3(o.velocity_bias);
  } else {
    sample.velocity = sample.true_velocity + noise + Vector3(o.velocity_bias);
  }
  return sample;
}

// Body velocity by integration of the measured specific force and rate. Without noise it equals the true velocity.
Vector3 World::reckon(const SE3& before, const SE3& after, const Vector3& noise, const Vector3& rate) {
  const double dt = options_.imu_period;
  const Vector3 g(0, 0, -options_.gravity);
  const Vector3 true_velocity = (after.translation() - before.translation()) / dt;
  const Vector3 acceleration = (true_velocity - strapdown_.true_velocity) / dt;
  const Vector3 force = before.rotation().inverse() * Vector3(acceleration - g) + noise;
  strapdown_.true_velocity = true_velocity;
  strapdown_.velocity += (strapdown_.R_map_body * force + g) * dt;
  const Vector3 velocity =
      SO3::translation_jacobian_inverse(rate * dt) * (strapdown_.R_map_body.inverse() * strapdown_.velocity);
  strapdown_.R_map_body = strapdown_.R_map_body * SO3::exp(rate * dt);
  return velocity;
}

// Integrates the samples of one motion on the group and returns the constant twist that gives the same displacement.
cairn_world_motion World::compose(const std::vector<Sample>& samples, const SE3& T_before_after) const {
  cairn_world_motion motion = {};
  motion.dt = options_.motion_period;
  Vector6 twist;
  Vector2 wheels = Vector2::Zero();
  if (samples.size() == 1) {
    twist << samples[0].velocity, samples[0].rate;
    wheels = samples[0].wheels;
  } else {
    SE3 T;
    for (const Sample& sample : samples) {
      Vector6 tau;
      tau << sample.velocity, sample.rate;
      T = T * SE3::exp(tau * options_.imu_period);
      wheels += sample.wheels / static_cast<double>(samples.size());
    }
    twist = T.log() / motion.dt;
  }
  const Vector6 true_twist = T_before_after.log() / motion.dt;
  const Vector2 true_wheels = wheel_rates(true_twist[0], true_twist[5], options_.wheel_radius, options_.track);
  std::copy_n(twist.data(), 3, motion.velocity);
  std::copy_n(twist.data() + 3, 3, motion.rate);
  std::copy_n(wheels.data(), 2, motion.wheels);
  std::copy_n(true_twist.data(), 3, motion.true_velocity);
  std::copy_n(true_twist.data() + 3, 3, motion.true_rate);
  std::copy_n(true_wheels.data(), 2, motion.true_wheels);
  return motion;
}

void World::write_noise(cairn_world_step& step) const {
  const cairn_world_options& o = options_;
  const double mean =
      1 / std::sqrt(static_cast<double>(samples_per_motion_));  // factor of the noise of a mean of white samples
  std::fill_n(step.rate_sigma, 3, o.rate_sigma * mean);
  if (o.drive == CAIRN_DRIVE_WHEELS_GYRO) {
    double variance = 0;  // of the forward velocity, at the mean rates of the wheels
    for (int side = 0; side < 2; ++side) {
      double rate = 0;
      for (const cairn_world_motion& motion : motions_) rate += std::abs(motion.wheels[side]);
      rate /= static_cast<double>(std::max<std::size_t>(1, motions_.size()));
      variance += std::pow(o.wheel_radius / 2 * mean, 2) *
                  (std::pow(o.wheel_rate_sigma, 2) + std::pow(o.wheel_slip_sigma * rate, 2));
    }
    step.velocity_sigma[0] = std::sqrt(variance);
    step.velocity_sigma[1] = o.lateral_sigma;
    step.velocity_sigma[2] = o.vertical_sigma;
  } else if (o.accelerometer == CAIRN_ACCELEROMETER_ACCELERATION) {
    // The integrated noise of the force, and gravity multiplied by the integrated noise of the rate.
    const double t = static_cast<double>(step.number) * o.frame_period, dt = o.imu_period;
    const double direct = o.velocity_sigma * std::sqrt(dt * t);
    const double leaked = o.gravity * o.rate_sigma * std::sqrt(dt * t * t * t / 3);
    std::fill_n(step.velocity_sigma, 3, std::hypot(direct, leaked));
  } else {
    std::fill_n(step.velocity_sigma, 3, o.velocity_sigma * mean);
  }
}

void World::look(const SE3& T_map_body) {
  observations_.clear();
  const cairn_world_options& o = options_;
  if (step_ == 0 && o.observe_at_start == 0) return;
  const bool per_frame = o.stick_noise == CAIRN_STICK_PER_FRAME;
  const double time = static_cast<double>(step_) * o.frame_period;
  Random frame(o.seed, Stream::frame, step_);
  const double pan = scan(o.pan_amplitude, o.pan_period, time);
  const double stick = scan(o.stick_amplitude, o.stick_period, time) + (per_frame ? o.stick_sigma * frame.normal() : 0);
  // (Mars paper, eq. 4)
  const SO3 R_body_platform = SO3::exp(Vector3(0, 0, pan)), R_platform_stick = SO3::exp(Vector3(0, stick, 0));
  const SE3 mount(SO3::exp(Vector3(o.mount_turn)), Vector3(o.mount_shift));  // (docs/systematic_errors.md, eq. 10)
  const SE3 T_body_camera = mount * SE3(R_body_platform, Vector3(o.platform)) * SE3(R_platform_stick, Vector3::Zero()) *
                            SE3(SO3(), Vector3(o.stick));
  const SE3 T_map_camera = T_map_body * T_body_camera, T_camera_map = T_map_camera.inverse();
  const double elevation_sigma = per_frame ? o.image_sigma : o.stick_sigma;
  landmarks_.near(T_map_camera.translation().x(), T_map_camera.translation().y(), [&](std::uint32_t id) {
    const Vector3 m = T_camera_map * landmarks_[id];
    const double range = m.norm(), azimuth = std::atan2(m.y(), m.x());
    if (range < o.near_range || range > o.far_range || std::abs(azimuth) > o.half_azimuth) return;
    Random random(o.seed, Stream::observation, static_cast<std::uint64_t>(step_) << 24 | id);
    const Vector3 noise = normal3(random);
    cairn_observation seen = {};
    seen.id = id;
    seen.z[0] = range + o.range_sigma * noise[0] + o.value_offset[0];
    seen.z[1] = wrap_angle(azimuth + o.azimuth_sigma * noise[1] + o.value_offset[1]);
    seen.z[2] = std::atan2(m.z(), std::hypot(m.x(), m.y())) + elevation_sigma * noise[2] + o.value_offset[2];
    observations_.push_back(seen);
  });
  std::sort(observations_.begin(), observations_.end(),
            [](const cairn_observation& a, const cairn_observation& b) { return a.id < b.id; });
}

}  // namespace cairn::sim
