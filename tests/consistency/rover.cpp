// SPDX-License-Identifier: BSD-3-Clause
// One drive of a rover with systematic errors.
//
// A turned mount is a turn of the whole map about the first pose, as long as velocity and rate are constant: biases
// take up the rest. So the error has two figures. The second is that of T_k' = (T_0 E)^-1 T_k E, the pose as the sensor
// sees it, relative to its first one, with the turn E of the mount. The turn of the map is not in it.
#include "rover.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include "tracker.hpp"

namespace consistency {
namespace {

struct Destroy {
  void operator()(cairn_world* world) const { cairn_world_destroy(world); }
  void operator()(cairn_filter* filter) const { cairn_filter_destroy(filter); }
};
using WorldHandle = std::unique_ptr<cairn_world, Destroy>;
using FilterHandle = std::unique_ptr<cairn_filter, Destroy>;

cairn_world_options world_options(const Rover& rover, int seed) {
  cairn_world_options w;
  CHECK(cairn_world_options_init(&w, sizeof w, nullptr));
  CHECK(cairn_world_options_preset(&w, rover.preset, nullptr, nullptr));
  w.seed = static_cast<uint64_t>(seed);
  if (rover.wheels) w.drive = CAIRN_DRIVE_WHEELS_GYRO;
  if (rover.laps > 0) w.laps = rover.laps;
  for (double* sigma : {&w.range_sigma, &w.azimuth_sigma, &w.stick_sigma, &w.image_sigma}) *sigma *= rover.camera_noise;
  return w;
}

void draw_errors(const Rover& rover, int seed, cairn_world_options& w) {
  Random random(static_cast<unsigned long long>(seed) * 7919 + 17);
  for (int i = 0; i < 3; ++i) {
    const double velocity = random.normal(rover.velocity), rate = random.normal(rover.rate),
                 turn = random.normal(kMountTurn);
    if (!rover.wheels || i == 0) w.velocity_bias[i] = velocity;  // wheels measure no velocity to the side
    w.rate_bias[i] = rate;
    if (!rover.known_mount) w.mount_turn[i] = turn;
  }
  for (double& scale : w.wheel_scale) scale = rover.wheels ? random.normal(kWheelScale) : 0.0;
}

void scale_drawn(double factor, cairn_world_options& w) {
  for (double* value : {&w.velocity_sigma, &w.rate_sigma, &w.wheel_rate_sigma, &w.wheel_slip_sigma, &w.range_sigma,
                        &w.azimuth_sigma, &w.stick_sigma, &w.image_sigma})
    *value *= factor;
  for (double* values : {w.velocity_bias, w.rate_bias, w.mount_turn})
    for (int i = 0; i < 3; ++i) values[i] *= factor;
  for (double& scale : w.wheel_scale) scale *= factor;
}

WorldHandle world_of(const cairn_world_options& options) {
  cairn_world* world = nullptr;
  CHECK(cairn_world_create(&options, &world, nullptr));
  return WorldHandle(world);
}

FilterHandle filter_of(const Rover& rover, const Follower& follower, const cairn_world* world, int32_t& sensor) {
  cairn_filter_options f;
  CHECK(cairn_filter_options_init(&f, sizeof f, nullptr));
  f.max_landmarks = 400;
  f.max_observations = 64;
  f.gate_probability = f.batch_gate_probability = 1;
  f.submap_landmarks = follower.submap_landmarks;
  f.join = follower.join;
  CHECK(cairn_world_pose(world, 0, &f.initial_pose, nullptr));
  if (follower.knows) {
    for (int i = 0; i < 3; ++i) f.rate_bias_sigma[i] = rover.rate;
    for (int i = 0; i < (rover.wheels ? 1 : 3); ++i) f.velocity_bias_sigma[i] = rover.velocity;
    for (double& sigma : f.wheel_scale_sigma) sigma = rover.wheels ? kWheelScale : 0.0;
    f.max_sensor_errors = 3;
  }
  cairn_filter* created = nullptr;
  CHECK(cairn_filter_create(&f, &created, nullptr));
  FilterHandle filter(created);
  cairn_stereo_head head;
  CHECK(cairn_stereo_head_init(&head, sizeof head, nullptr));
  CHECK(cairn_world_head(world, &head, nullptr));
  CHECK(cairn_filter_add_stereo_head(filter.get(), &head, &sensor, nullptr));
  cairn_wheels wheels;
  CHECK(cairn_wheels_init(&wheels, sizeof wheels, nullptr));
  CHECK(cairn_world_wheels(world, &wheels, nullptr));
  CHECK(cairn_filter_set_wheels(filter.get(), &wheels, nullptr));
  if (follower.knows && !rover.known_mount) {
    cairn_calibration calibration;
    CHECK(cairn_calibration_init(&calibration, sizeof calibration, nullptr));
    std::fill_n(calibration.mount_turn_sigma, 3, kMountTurn);
    CHECK(cairn_filter_calibrate_sensor(filter.get(), sensor, &calibration, nullptr));
  }
  return filter;
}

// (T_0 E)^-1 T E with E = Exp(turn).
cairn_pose seen_by_sensor(const cairn_pose& first, const cairn_pose& pose, const double turn[3]) {
  cairn_pose mount = {{0, 0, 0}, {1, 0, 0, 0}}, from, back, result;
  CHECK(cairn_quaternion_exp(turn, mount.quaternion, nullptr));
  CHECK(cairn_pose_compose(&first, &mount, &from, nullptr));
  CHECK(cairn_pose_inverse(&from, &back, nullptr));
  CHECK(cairn_pose_compose(&back, &pose, &from, nullptr));
  CHECK(cairn_pose_compose(&from, &mount, &result, nullptr));
  return result;
}

void estimated_turn(const cairn_filter* filter, double turn[3]) {
  cairn_systematic_error errors[16];
  size_t count = 0;
  CHECK(cairn_filter_systematic_errors(filter, errors, nullptr, 16, &count, nullptr));
  std::fill_n(turn, 3, 0.0);
  for (size_t i = 0; i < count; ++i)
    if (errors[i].kind == CAIRN_SYSTEMATIC_MOUNT_TURN) turn[errors[i].component] = errors[i].value;
}

double squared_distance(const cairn_pose& truth, const cairn_pose& pose) {
  double error[6];
  CHECK(cairn_pose_error(&truth, &pose, error, nullptr));
  return error[0] * error[0] + error[1] * error[1] + error[2] * error[2];
}

void predict(const Rover& rover, const std::vector<cairn_world_motion>& motions, cairn_filter* filter) {
  for (const cairn_world_motion& m : motions) {
    if (rover.wheels)
      CHECK(cairn_filter_predict_wheels_gyro(filter, m.dt, m.wheels[0], m.wheels[1], m.rate, nullptr));
    else
      CHECK(cairn_filter_predict_twist(filter, m.dt, m.velocity, m.rate, nullptr));
  }
}

// Tells the filter the noise of the motion that the world of the stated noise has in this step.
void state_noise(const cairn_world_step& step, cairn_filter* filter) {
  cairn_twist_noise noise;
  CHECK(cairn_twist_noise_init(&noise, sizeof noise, nullptr));
  std::copy_n(step.velocity_sigma, 3, noise.velocity_sigma);
  std::copy_n(step.rate_sigma, 3, noise.rate_sigma);
  CHECK(cairn_filter_set_twist_noise(filter, &noise, nullptr));
}

cairn_world_step next(cairn_world* world) {
  cairn_world_step step;
  step.struct_size = sizeof step;
  CHECK(cairn_world_next(world, &step, nullptr));
  return step;
}

// An array of the last step: `query` is the function that copies it, `count` its length.
template <class Element>
std::vector<Element> array_of(const cairn_world* world, std::uint64_t count,
                              cairn_status (*query)(const cairn_world*, Element*, std::size_t, std::size_t*,
                                                    cairn_error*)) {
  std::vector<Element> elements(count);
  std::size_t needed = 0;
  CHECK(query(world, elements.data(), elements.size(), &needed, nullptr));
  return elements;
}

}  // namespace

void drive(const Rover& rover, const Follower& follower, int seed, Score& score) {
  cairn_world_options options = world_options(rover, seed);
  if (follower.wrong) draw_errors(rover, seed, options);
  const WorldHandle stated = world_of(options);  // tells the filter its noise
  scale_drawn(follower.drawn, options);
  const WorldHandle world = world_of(options);
  int32_t sensor = -1;
  const FilterHandle filter = filter_of(rover, follower, stated.get(), sensor);
  cairn_pose first;
  std::size_t steps = 0;
  CHECK(cairn_world_pose(world.get(), 0, &first, nullptr));
  CHECK(cairn_world_steps(world.get(), &steps, nullptr));
  score.nees.resize(steps, 0.0);
  const double unit = 1.0 / (follower.drawn * follower.drawn);
  for (std::size_t k = 0; k < steps; ++k) {
    state_noise(next(stated.get()), filter.get());
    const cairn_world_step step = next(world.get());
    predict(rover, array_of(world.get(), step.motion_count, &cairn_world_motions), filter.get());
    const auto seen = array_of(world.get(), step.observation_count, &cairn_world_observations);
    if (!seen.empty()) CHECK(cairn_filter_update(filter.get(), sensor, seen.data(), seen.size(), nullptr, nullptr));
    if (k == 0) continue;
    double nees = 0.0, covariance[36], turn[3];
    cairn_pose pose;
    CHECK(cairn_filter_pose_nees(filter.get(), &step.truth, &nees, nullptr));
    CHECK(cairn_filter_pose(filter.get(), &pose, covariance, nullptr));
    estimated_turn(filter.get(), turn);
    score.nees[k] += unit * nees;
    score.squares += unit * squared_distance(step.truth, pose);
    score.sensor_squares += unit * squared_distance(seen_by_sensor(first, step.truth, options.mount_turn),
                                                    seen_by_sensor(first, pose, turn));
    score.variance += covariance[0] + covariance[7] + covariance[14];
    ++score.steps;
  }
}

}  // namespace consistency
