// SPDX-License-Identifier: BSD-3-Clause
// The C boundary of libcairn_sim.
#include <cairn/sim.h>

#include <cmath>

#include "capi/boundary.hpp"
#include "motion/motion.hpp"
#include "sensor/stereo_head.hpp"
#include "sim/checks.hpp"
#include "sim/world.hpp"
#include "sim/world_options.hpp"

using namespace cairn;
using namespace cairn::capi;
using cairn::sim::write_struct;

struct cairn_world {
  explicit cairn_world(const cairn_world_options& options) : world(options) {}
  sim::World world;
};

namespace {

sim::World& read_world(cairn_world* world) {
  check_pointer(world, "world");
  return world->world;
}

const sim::World& read_world(const cairn_world* world) {
  check_pointer(world, "world");
  return world->world;
}

void check_time(const sim::World& world, double time) {
  check_range(time, 0, world.duration(), "time");
}

}  // namespace

extern "C" {

cairn_status cairn_world_options_init(cairn_world_options* options, size_t struct_size, cairn_error* error) {
  return guard(error, [&] { init_options(options, struct_size, sim::default_world_options(), "options"); });
}

cairn_status cairn_world_options_preset(cairn_world_options* options, int32_t preset, uint32_t* submap_landmarks,
                                        cairn_error* error) {
  return guard(error, [&] {
    check_pointer(options, "options");
    std::uint32_t size_of_submap = 0;
    cairn_world_options values = sim::preset_world_options(preset, size_of_submap);
    values.seed = read_options(options, values, "options").seed;
    write_struct(values, options, "options");
    if (submap_landmarks != nullptr) *submap_landmarks = size_of_submap;
  });
}

cairn_status cairn_world_create(const cairn_world_options* options, cairn_world** world, cairn_error* error) {
  return guard(error, [&] {
    const cairn_world_options checked = sim::read_world_options(options);
    check_pointer(world, "world");
    *world = new cairn_world(checked);
  });
}

void cairn_world_destroy(cairn_world* world) {
  delete world;
}

cairn_status cairn_world_next(cairn_world* world, cairn_world_step* step, cairn_error* error) {
  return guard(error, [&] {
    sim::World& w = read_world(world);
    sim::write_next_step(w, step);
  });
}

cairn_status cairn_world_motions(const cairn_world* world, cairn_world_motion* motions, size_t capacity, size_t* needed,
                                 cairn_error* error) {
  return guard(error, [&] {
    const std::vector<cairn_world_motion>& from = read_world(world).motions();
    sim::write_array(from.data(), from.size(), motions, capacity, needed, "motions");
  });
}

cairn_status cairn_world_observations(const cairn_world* world, cairn_observation* observations, size_t capacity,
                                      size_t* needed, cairn_error* error) {
  return guard(error, [&] {
    const std::vector<cairn_observation>& from = read_world(world).observations();
    sim::write_array(from.data(), from.size(), observations, capacity, needed, "observations");
  });
}

cairn_status cairn_world_rewind(cairn_world* world, cairn_error* error) {
  return guard(error, [&] { read_world(world).rewind(); });
}

cairn_status cairn_world_steps(const cairn_world* world, size_t* steps, cairn_error* error) {
  return guard(error, [&] {
    const sim::World& w = read_world(world);
    check_pointer(steps, "steps");
    *steps = w.steps();
  });
}

cairn_status cairn_world_most_observations(const cairn_world* world, size_t* count, cairn_error* error) {
  return guard(error, [&] {
    const sim::World& w = read_world(world);
    check_pointer(count, "count");
    *count = w.landmarks().most_near();
  });
}

cairn_status cairn_world_head(const cairn_world* world, cairn_stereo_head* head, cairn_error* error) {
  return guard(error, [&] {
    const cairn_world_options& o = read_world(world).options();
    const bool per_frame = o.stick_noise == CAIRN_STICK_PER_FRAME;
    const StereoHeadParameters d;
    cairn_stereo_head value = {};
    value.encoder_mode = per_frame ? CAIRN_ENCODER_PER_FRAME : CAIRN_ENCODER_PER_OBSERVATION;
    std::copy_n(o.platform, 3, value.platform);
    std::copy_n(o.stick, 3, value.stick);
    value.camera_quaternion[0] = 1;
    value.range_sigma = o.range_sigma;
    value.azimuth_sigma = o.azimuth_sigma;
    value.elevation_sigma = per_frame ? o.image_sigma : o.stick_sigma;
    value.stick_sigma = per_frame ? o.stick_sigma : 0;
    value.near_range = d.near_range;
    value.max_elevation = d.max_elevation;
    write_struct(value, head, "head");
  });
}

cairn_status cairn_world_wheels(const cairn_world* world, cairn_wheels* wheels, cairn_error* error) {
  return guard(error, [&] {
    const sim::World& w = read_world(world);
    const cairn_world_options& o = w.options();
    const double mean = 1 / std::sqrt(static_cast<double>(w.samples_per_motion()));
    const Wheels d;
    cairn_wheels value = {};
    value.yaw_sign = CAIRN_YAW_RIGHT_MINUS_LEFT;
    value.radius = o.wheel_radius;
    value.track = o.track;
    value.rate_sigma = o.wheel_rate_sigma * mean;
    value.slip_sigma = o.wheel_slip_sigma * mean;
    value.lateral_sigma = o.lateral_sigma;
    value.vertical_sigma = o.vertical_sigma;
    value.roll_rate_sigma = d.roll_rate_sigma;
    value.pitch_rate_sigma = d.pitch_rate_sigma;
    write_struct(value, wheels, "wheels");
  });
}

cairn_status cairn_world_pose(const cairn_world* world, double time, cairn_pose* pose, cairn_error* error) {
  return guard(error, [&] {
    const sim::World& w = read_world(world);
    check_time(w, time);
    check_pointer(pose, "pose");
    write_pose(w.stance(time).T_map_body, pose);
  });
}

cairn_status cairn_world_contacts(const cairn_world* world, double time, double points[12], cairn_error* error) {
  return guard(error, [&] {
    const sim::World& w = read_world(world);
    check_time(w, time);
    check_pointer(points, "points");
    if (w.options().contact == CAIRN_CONTACT_POINT)
      throw Error(ErrorCode::state,
                  "the rover of this world has no wheels: options.contact is CAIRN_CONTACT_POINT; create a world with "
                  "CAIRN_CONTACT_WHEELS");
    const sim::Stance stance = w.stance(time);
    for (int i = 0; i < 4; ++i) std::copy_n(stance.contacts[i].data(), 3, points + 3 * i);
  });
}

cairn_status cairn_world_height(const cairn_world* world, double x, double y, double* height, cairn_error* error) {
  return guard(error, [&] {
    const sim::World& w = read_world(world);
    check_finite(x, "x");
    check_finite(y, "y");
    check_pointer(height, "height");
    *height = w.terrain().height(x, y);
  });
}

cairn_status cairn_world_extent(const cairn_world* world, double lower[2], double upper[2], cairn_error* error) {
  return guard(error, [&] {
    const sim::World& w = read_world(world);
    check_pointer(lower, "lower");
    check_pointer(upper, "upper");
    Vector2 low, high;
    w.extent(low, high);
    std::copy_n(low.data(), 2, lower);
    std::copy_n(high.data(), 2, upper);
  });
}

cairn_status cairn_world_landmark(const cairn_world* world, uint64_t id, double position[3], cairn_error* error) {
  return guard(error, [&] {
    const sim::LandmarkField& landmarks = read_world(world).landmarks();
    check_pointer(position, "position");
    if (id >= landmarks.size())
      throw Error(ErrorCode::not_found, "id %llu is unknown: the landmarks of this world have the ids 0 to %zu",
                  static_cast<unsigned long long>(id), landmarks.size() - 1);
    std::copy_n(landmarks[id].data(), 3, position);
  });
}

cairn_status cairn_world_landmarks(const cairn_world* world, double* positions, size_t capacity, size_t* needed,
                                   cairn_error* error) {
  return guard(error, [&] {
    const sim::LandmarkField& landmarks = read_world(world).landmarks();
    if (!check_room(positions, capacity, landmarks.size(), needed, "positions")) return;
    for (std::size_t i = 0; i < landmarks.size(); ++i) std::copy_n(landmarks[i].data(), 3, positions + 3 * i);
  });
}

const char* cairn_sim_last_message(void) {
  return last_message();
}

}  // extern "C"
