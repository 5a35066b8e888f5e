// SPDX-License-Identifier: BSD-3-Clause
// A simulated world with a rover (libcairn_sim).
#ifndef CAIRN_CPP_WORLD_HPP
#define CAIRN_CPP_WORLD_HPP

#include <cairn/cpp/handle.hpp>
#include <cairn/cpp/sim_types.hpp>

namespace cairn {
namespace detail {

struct WorldKind {
  using Handle = cairn_world;
  static constexpr const char* name = "world";
  //~ cairn_world_destroy
  /// Destroys a world.
  ///
  /// Complexity: O(memory).
  static void destroy(Handle* handle) noexcept { cairn_world_destroy(handle); }
};

}  // namespace detail

//~ cairn_sim_last_message
/// One line about the last call of this library that failed in this thread, like last_message for libcairn.
///
/// Complexity: O(1).
inline std::string sim_last_message() {
  return cairn_sim_last_message();
}

/// The rectangle that contains a world, m.
struct Extent {
  std::array<double, 2> lower{}, upper{};
};

//~ cairn_world_options_preset
/// `submap_landmarks` gets the size of submaps that belongs to the preset: 40, or 20 for rows 3 and 4.
///
/// Throws Error: Status::kErrorArgument.
///
/// Complexity: O(1).
//! Returns the size of submaps.
inline std::uint32_t set_preset(WorldOptions& options, Preset preset) {
  std::uint32_t submap_landmarks = 0;
  detail::call([&](cairn_error* error) {
    return cairn_world_options_preset(detail::as_c(&options), static_cast<cairn_preset>(preset), &submap_landmarks,
                                      error);
  });
  return submap_landmarks;
}

/// A simulated rover among landmarks, and the truth about both.
class World : public detail::Owner<detail::WorldKind> {
 public:
  //~ cairn_world_create
  /// Creates a world before its first step.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorMemory; Status::kErrorNumerical (the ground is too rough for
  /// four wheels).
  ///
  /// Complexity: O(n log n) for n landmarks; memory: 40 bytes for each landmark.
  explicit World(const WorldOptions& options = {})
      : Owner([&](cairn_world** world, cairn_error* error) {
          return cairn_world_create(detail::as_c(&options), world, error);
        }) {}

  //~ cairn_world_next
  /// Returns the next step. Nothing is stored, so memory does not grow with the drive.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorState (there are no more steps); Status::kErrorNumerical (the
  /// ground is too rough for four wheels).
  ///
  /// Complexity: O(motions + landmarks in range).
  WorldStep next() {
    WorldStep step;
    change(cairn_world_next, detail::as_c(&step));
    return step;
  }

  /// The next step, or false after the last one: `for (WorldStep step; world.next(step);)`.
  bool next(WorldStep& step) {
    step = WorldStep{};
    bool ended = false;
    change([&](cairn_world* world, cairn_error* error) {
      const cairn_status status = cairn_world_next(world, detail::as_c(&step), error);
      ended = status == CAIRN_ERROR_STATE;
      return ended ? CAIRN_OK : status;
    });
    return !ended;
  }

  //~ cairn_world_motions
  /// The motion samples of the last step, in order; none before the first step.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorBuffer.
  ///
  /// Complexity: O(n).
  std::vector<WorldMotion> motions() const { return list<WorldMotion>(cairn_world_motions); }

  //~ cairn_world_observations
  /// The observations of the last step's frame, by ascending id, z as StereoHead defines it, covariance zero; none
  /// before the first step.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorBuffer.
  ///
  /// Complexity: O(n).
  std::vector<Observation> observations() const { return list<Observation>(cairn_world_observations); }

  //~ cairn_world_rewind
  /// Goes back to before the first step. The same drive follows, bit for bit.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  void rewind() { change(cairn_world_rewind); }

  //~ cairn_world_steps
  /// Number of steps, including the start.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  std::size_t steps() const { return get<std::size_t>(cairn_world_steps); }

  //~ cairn_world_most_observations
  /// Upper bound of the number of observations in a frame, for FilterOptions.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(n).
  std::size_t most_observations() const { return get<std::size_t>(cairn_world_most_observations); }

  //~ cairn_world_head
  /// The stereo head of the world, to be added to a filter: mount, noise, encoder mode.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  StereoHead head() const { return get<StereoHead>(cairn_world_head); }

  //~ cairn_world_wheels
  /// The wheels of the rover, for Filter::set_wheels, with the noise of the wheel rates of one motion sample. The noise
  /// of rates that wheels do not measure is that of Wheels::Wheels.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  Wheels wheels() const { return get<Wheels>(cairn_world_wheels); }

  //~ cairn_world_pose
  /// True pose of the body in the map at `time` (s, 0 to the end of the drive). The origin of the body lies on the
  /// ground in the middle between the wheels.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  Pose pose(double time) const { return get<Pose>(cairn_world_pose, time); }

  //~ cairn_world_contacts
  /// Points at which the wheels touch the ground at `time`: front left, front right, rear left, rear right, x y z each,
  /// in the map, m.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorState (Contact::kPoint).
  ///
  /// Complexity: O(1).
  std::array<double, 12> contacts(double time) const {
    std::array<double, 12> points{};
    query(cairn_world_contacts, time, points.data());
    return points;
  }

  //~ cairn_world_height
  /// Height of the ground at x, y (m), m.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  double height(double x, double y) const { return get<double>(cairn_world_height, x, y); }

  //~ cairn_world_extent
  /// The rectangle in the xy plane that contains the course and all landmarks, m.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  Extent extent() const {
    Extent extent;
    query(cairn_world_extent, extent.lower.data(), extent.upper.data());
    return extent;
  }

  //~ cairn_world_landmark
  /// True position (m) of the landmark `id`, 0 to the number of landmarks minus 1.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNotFound.
  ///
  /// Complexity: O(1).
  std::array<double, 3> landmark(std::uint64_t id) const {
    std::array<double, 3> position{};
    query(cairn_world_landmark, id, position.data());
    return position;
  }

  //~ cairn_world_landmarks
  /// True positions of all landmarks, x y z each, m, by ascending id.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorBuffer.
  ///
  /// Complexity: O(n).
  std::vector<double> landmarks() const { return list_of_rows<double>(3, cairn_world_landmarks); }
};

}  // namespace cairn

#endif
