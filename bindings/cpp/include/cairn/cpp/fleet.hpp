// SPDX-License-Identifier: BSD-3-Clause
// A simulated fleet of planar vehicles (libcairn_sim).
#ifndef CAIRN_CPP_FLEET_HPP
#define CAIRN_CPP_FLEET_HPP

#include <cairn/cpp/handle.hpp>
#include <cairn/cpp/sim_types.hpp>

namespace cairn {
namespace detail {

struct FleetKind {
  using Handle = cairn_fleet;
  static constexpr const char* name = "fleet";
  //~ cairn_fleet_destroy
  /// Destroys a fleet.
  ///
  /// Complexity: O(memory).
  static void destroy(Handle* handle) noexcept { cairn_fleet_destroy(handle); }
};

}  // namespace detail

/// Simulated vehicles with radars, and the truth about them.
class Fleet : public detail::Owner<detail::FleetKind> {
 public:
  //~ cairn_fleet_create
  /// Creates a fleet before its first step.
  ///
  /// Each boat is commanded once around a circle of radius R = course_length / (2 pi), anticlockwise, at the constant
  /// speed course_length / duration and rate 2 pi / duration. It starts at the southernmost point of the circle,
  /// heading east. The centres of the circles are `separation` apart. The centre of a single boat is the origin. The
  /// centres of two boats are (-separation / 2, 0) and (separation / 2, 0). The centres of more boats form a square
  /// grid about the origin, with as many columns as rows or one more. They are numbered from west to east and row by
  /// row from the south; a last row that is not full is centred. A grid wider than half of `area` is shrunk to that.
  /// With FleetLayout::kCoast all circles must lie south of the coast line.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorMemory.
  ///
  /// Complexity: O(features).
  explicit Fleet(const FleetOptions& options = {})
      : Owner([&](cairn_fleet** fleet, cairn_error* error) {
          return cairn_fleet_create(detail::as_c(&options), fleet, error);
        }) {}

  //~ cairn_fleet_next
  /// Returns the next step. During a period each boat keeps its executed speed and rate, and its true pose is their
  /// exact integral. Then each boat measures all features and all other boats within `radar_range` (true distance, not
  /// 0). Each measurement has its own noise: two boats that see each other have independent errors. Nothing is stored,
  /// so memory does not grow with the drive.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorState (there are no more steps); Status::kErrorMemory (the
  /// next call returns the same step).
  ///
  /// Complexity: O(vehicles (features + vehicles)).
  FleetStep next() {
    FleetStep step;
    change(cairn_fleet_next, detail::as_c(&step));
    return step;
  }

  //~ cairn_fleet_vehicles
  /// The boats at the end of the last step, boat 1 first; none before the first step.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorBuffer.
  ///
  /// Complexity: O(n).
  std::vector<FleetVehicle> vehicles() const { return list<FleetVehicle>(cairn_fleet_vehicles); }

  //~ cairn_fleet_seen_features
  /// The features that boat `vehicle` (counted from 1) measured in the last step, by ascending id; none before the
  /// first step.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNotFound (boat); Status::kErrorBuffer.
  ///
  /// Complexity: O(n).
  std::vector<FleetSighting> seen_features(std::uint64_t vehicle) const {
    return list<FleetSighting>(cairn_fleet_seen_features, vehicle);
  }

  //~ cairn_fleet_seen_vehicles
  /// The other boats that boat `vehicle` (counted from 1) measured in the last step, by ascending id; none before the
  /// first step.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorNotFound (boat); Status::kErrorBuffer.
  ///
  /// Complexity: O(n).
  std::vector<FleetSighting> seen_vehicles(std::uint64_t vehicle) const {
    return list<FleetSighting>(cairn_fleet_seen_vehicles, vehicle);
  }

  //~ cairn_fleet_rewind
  /// Goes back to before the first step. The same steps follow, bit for bit.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  void rewind() { change(cairn_fleet_rewind); }

  //~ cairn_fleet_steps
  /// Number of steps: 1 plus the number of whole periods in the duration.
  ///
  /// Throws Error: Status::kErrorArgument.
  ///
  /// Complexity: O(1).
  std::size_t steps() const { return get<std::size_t>(cairn_fleet_steps); }

  //~ cairn_fleet_features
  /// True positions of all features, x y each, m; the feature with id 1 is the first.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorBuffer.
  ///
  /// Complexity: O(n).
  std::vector<double> features() const { return list_of_rows<double>(2, cairn_fleet_features); }

  //~ cairn_fleet_coast
  /// The coast line from west to east: a polyline, x y each, m. The land is north of it.
  ///
  /// Throws Error: Status::kErrorArgument; Status::kErrorBuffer.
  ///
  /// Complexity: O(n).
  std::vector<double> coast() const { return list_of_rows<double>(2, cairn_fleet_coast); }
};

}  // namespace cairn

#endif
