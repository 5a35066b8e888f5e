// SPDX-License-Identifier: BSD-3-Clause
#include "program/drives/world_drive.hpp"

#include <algorithm>

#include "program/library.hpp"
#include "program/usage_error.hpp"

namespace cairn::program {

WorldDrive::WorldDrive(const cairn_world_options& options, bool by_wheels, bool scales_wheels)
    : landmarks_(options.landmarks),
      by_wheels_(by_wheels),
      by_gyro_(scales_wheels && options.drive == CAIRN_DRIVE_WHEELS_GYRO) {
  cairn_world* world = nullptr;
  const cairn_status status = cairn_world_create(&options, &world, nullptr);
  if (status == CAIRN_ERROR_ARGUMENT) throw UsageError(cairn_sim_last_message());  // options that contradict each other
  check_sim(status);
  world_.reset(world);
  check_sim(cairn_world_steps(world, &steps_, nullptr));
}

cairn_pose WorldDrive::start() const {
  cairn_pose pose;
  check_sim(cairn_world_pose(world_.get(), 0, &pose, nullptr));
  return pose;
}

std::size_t WorldDrive::largest_frame() const {
  std::size_t count = 0;
  check_sim(cairn_world_most_observations(world_.get(), &count, nullptr));
  return std::max<std::size_t>(1, count);
}

std::int32_t WorldDrive::equip(cairn_filter* filter) const {
  cairn_stereo_head head;
  check(cairn_stereo_head_init(&head, sizeof head, nullptr));
  check_sim(cairn_world_head(world_.get(), &head, nullptr));
  cairn_wheels wheels;
  check(cairn_wheels_init(&wheels, sizeof wheels, nullptr));
  check_sim(cairn_world_wheels(world_.get(), &wheels, nullptr));
  std::int32_t sensor = -1;
  check(cairn_filter_add_stereo_head(filter, &head, &sensor, nullptr));
  check(cairn_filter_set_wheels(filter, &wheels, nullptr));
  return sensor;
}

bool WorldDrive::next(DriveStep& step) {
  if (next_ == steps_) return false;
  cairn_world_step simulated;
  simulated.struct_size = sizeof simulated;
  check_sim(cairn_world_next(world_.get(), &simulated, nullptr));
  step.index = next_++;
  step.number = simulated.number;
  step.time = simulated.time;
  step.twists.clear();
  step.wheel_turns.clear();
  read_sim_array(motions_, [&](cairn_world_motion* motions, std::size_t capacity, std::size_t* needed) {
    return cairn_world_motions(world_.get(), motions, capacity, needed, nullptr);
  });
  read_sim_array(observations_, [&](cairn_observation* observations, std::size_t capacity, std::size_t* needed) {
    return cairn_world_observations(world_.get(), observations, capacity, needed, nullptr);
  });
  for (const cairn_world_motion& motion : motions_) {
    if (by_wheels_) {
      step.wheel_turns.push_back({motion.dt, motion.wheels[0], motion.wheels[1], std::nullopt});
    } else if (by_gyro_) {
      step.wheel_turns.push_back({motion.dt, motion.wheels[0], motion.wheels[1], std::array<double, 3>{}});
      std::copy_n(motion.rate, 3, step.wheel_turns.back().rate->begin());
    } else {
      logs::Twist twist{motion.dt, {}, {}};
      std::copy_n(motion.velocity, 3, twist.velocity.begin());
      std::copy_n(motion.rate, 3, twist.rate.begin());
      step.twists.push_back(twist);
    }
  }
  cairn_twist_noise noise;
  check(cairn_twist_noise_init(&noise, sizeof noise, nullptr));
  std::copy_n(simulated.velocity_sigma, 3, noise.velocity_sigma);
  std::copy_n(simulated.rate_sigma, 3, noise.rate_sigma);
  step.noise = noise;
  step.pan = simulated.pan;
  step.stick = simulated.stick;
  step.observations = observations_.data();
  step.count = observations_.size();
  step.truth = simulated.truth;
  return true;
}

bool WorldDrive::true_landmark(std::uint64_t id, double position[3]) const {
  return cairn_world_landmark(world_.get(), id, position, nullptr) == CAIRN_OK;
}

}  // namespace cairn::program
