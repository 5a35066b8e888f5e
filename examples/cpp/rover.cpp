// SPDX-License-Identifier: BSD-3-Clause
// A simulated rover drives among landmarks and maps them: the twelve lines of README.md in C++.
//
//   c++ -std=c++17 rover.cpp $(pkg-config --cflags --libs cairn cairn-sim)
#include <cairn/cairn.hpp>
#include <cairn/sim.hpp>
#include <cmath>
#include <cstdio>

int main() try {
  cairn::WorldOptions scene;  // a simulated rover; or your own
  scene.seed = 3;
  cairn::World world(scene);

  cairn::FilterOptions options;
  options.submap_landmarks = 60;  // close a submap when it holds this many
  options.max_observations = static_cast<std::uint32_t>(world.most_observations());
  options.initial_pose = world.pose(0.0);
  cairn::Filter rover(options);
  const std::int32_t camera = rover.add_stereo_head(world.head());  // range, azimuth, elevation on a pan and tilt mount

  for (cairn::WorldStep step; world.next(step);) {
    for (const cairn::WorldMotion& motion : world.motions())
      rover.predict_twist(motion.dt, motion.velocity, motion.rate);
    rover.point_head(camera, step.pan, step.stick);
    rover.update(camera, world.observations());
  }

  const auto [pose, covariance] = rover.pose();
  const auto landmarks = rover.map().within(pose.position, 30.0);  // nearest first
  std::printf("x %.3f +- %.3f m, y %.3f +- %.3f m, %zu landmarks within 30 m\n", pose.position[0],
              std::sqrt(covariance[0]), pose.position[1], std::sqrt(covariance[7]), landmarks.size());
  return 0;
} catch (const cairn::Error& error) {
  std::fprintf(stderr, "%s: %s\n", cairn::status_name(error.status()), error.what());
  return 1;
}
