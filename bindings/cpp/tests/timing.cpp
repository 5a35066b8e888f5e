// SPDX-License-Identifier: BSD-3-Clause
// One drive by C and by C++: the same calls, the same bits, and what an update of C++ takes over C.
//   timing         medians of one run in turns
//   timing c|cpp   drives once; for callgrind, which counts the instructions of drive_c or drive_cpp
#include <algorithm>
#include <cairn/cairn.hpp>
#include <cairn/sim.hpp>
#include <chrono>
#include <cstdio>
#include <cstring>

namespace {

struct Frame {
  std::vector<cairn::WorldMotion> motions;
  std::vector<cairn::Observation> observations;
};

struct Drive {
  cairn::FilterOptions options;
  cairn::StereoHead head;
  std::vector<Frame> frames;
};

Drive record() {
  cairn::WorldOptions scene;
  scene.seed = 3;
  cairn::World world(scene);
  Drive drive;
  drive.options.submap_landmarks = 60;
  drive.options.max_observations = static_cast<std::uint32_t>(world.most_observations());
  drive.options.initial_pose = world.pose(0.0);
  drive.head = world.head();
  for (cairn::WorldStep step; world.next(step);) drive.frames.push_back({world.motions(), world.observations()});
  return drive;
}

double now() {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void require(cairn_status status) {
  if (status != CAIRN_OK) throw cairn::Error(static_cast<cairn::Status>(status), cairn_last_message());
}

}  // namespace

// Times of the updates in microseconds; the pose at the end.
extern "C" __attribute__((noinline)) void drive_c(const Drive& drive, double* times, cairn_pose* end) {
  cairn_error error;
  error.struct_size = sizeof error;
  const auto* options = reinterpret_cast<const cairn_filter_options*>(&drive.options);
  cairn_filter* filter = nullptr;
  std::int32_t camera = -1;
  require(cairn_filter_create(options, &filter, &error));
  require(
      cairn_filter_add_stereo_head(filter, reinterpret_cast<const cairn_stereo_head*>(&drive.head), &camera, &error));
  std::vector<cairn_match> matches(drive.options.max_observations);
  for (const Frame& frame : drive.frames) {
    for (const cairn::WorldMotion& motion : frame.motions)
      require(cairn_filter_predict_twist(filter, motion.dt, motion.velocity.data(), motion.rate.data(), &error));
    const auto* observations = reinterpret_cast<const cairn_observation*>(frame.observations.data());
    const double start = now();
    require(cairn_filter_update(filter, camera, observations, frame.observations.size(), matches.data(), &error));
    *times++ = now() - start;
  }
  require(cairn_filter_pose(filter, end, nullptr, &error));
  cairn_filter_destroy(filter);
}

extern "C" __attribute__((noinline)) void drive_cpp(const Drive& drive, double* times, cairn_pose* end) {
  cairn::Filter filter(drive.options);
  const std::int32_t camera = filter.add_stereo_head(drive.head);
  for (const Frame& frame : drive.frames) {
    for (const cairn::WorldMotion& motion : frame.motions)
      filter.predict_twist(motion.dt, motion.velocity, motion.rate);
    const double start = now();
    filter.update(camera, frame.observations);
    *times++ = now() - start;
  }
  const cairn::Pose pose = filter.pose().pose;
  std::memcpy(end, &pose, sizeof pose);
}

int main(int argc, char** argv) try {
  const Drive drive = record();
  std::vector<double> c(drive.frames.size()), cpp(drive.frames.size());
  cairn_pose c_end, cpp_end;
  if (argc == 2) {
    std::strcmp(argv[1], "c") == 0 ? drive_c(drive, c.data(), &c_end) : drive_cpp(drive, cpp.data(), &cpp_end);
    return 0;
  }
  constexpr std::size_t kRounds = 15;
  std::vector<std::vector<double>> by_c(c.size()), by_cpp(c.size());
  for (std::size_t round = 0; round < kRounds; ++round) {
    const bool c_first = round % 2 == 0;
    if (c_first) drive_c(drive, c.data(), &c_end);
    drive_cpp(drive, cpp.data(), &cpp_end);
    if (!c_first) drive_c(drive, c.data(), &c_end);
    if (std::memcmp(&c_end, &cpp_end, sizeof c_end) != 0) {
      std::printf("C and C++ end at different poses\n");
      return 1;
    }
    for (std::size_t i = 0; i < c.size(); ++i) by_c[i].push_back(c[i]), by_cpp[i].push_back(cpp[i]);
  }
  // The sum over the frames of each frame's median: other work of the machine hits single updates.
  const auto sum_of_medians = [](std::vector<std::vector<double>>& frames) {
    double sum = 0.0;
    for (auto& times : frames) {
      std::nth_element(times.begin(), times.begin() + kRounds / 2, times.end());
      sum += times[kRounds / 2];
    }
    return sum / static_cast<double>(frames.size());
  };
  const double c_time = sum_of_medians(by_c), cpp_time = sum_of_medians(by_cpp);
  std::printf("an update: %.2f us in C, %.2f us in C++, ratio %.4f (%zu updates, medians of %zu rounds)\n", c_time,
              cpp_time, cpp_time / c_time, c.size(), kRounds);
  return 0;
} catch (const cairn::Error& error) {
  std::fprintf(stderr, "timing: %s\n", error.what());
  return 1;
}
