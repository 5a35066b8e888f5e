// SPDX-License-Identifier: BSD-3-Clause
// The C boundary of fleets (cairn/fleet.h).
#include <cairn/fleet.h>

#include "sim/checks.hpp"
#include "sim/fleet.hpp"
#include "sim/fleet_options.hpp"

using namespace cairn;
using namespace cairn::capi;

struct cairn_fleet {
  explicit cairn_fleet(const cairn_fleet_options& options) : fleet(options) {}
  sim::Fleet fleet;
};

namespace {

sim::Fleet& read_fleet(cairn_fleet* fleet) {
  check_pointer(fleet, "fleet");
  return fleet->fleet;
}

const sim::Fleet& read_fleet(const cairn_fleet* fleet) {
  check_pointer(fleet, "fleet");
  return fleet->fleet;
}

// The number of a boat, counted from 0.
std::size_t read_boat(const sim::Fleet& fleet, std::uint64_t vehicle) {
  if (vehicle < 1 || vehicle > fleet.vehicles().size())
    throw Error(ErrorCode::not_found, "vehicle %llu is unknown: the boats of this fleet have the numbers 1 to %zu",
                static_cast<unsigned long long>(vehicle), fleet.vehicles().size());
  return static_cast<std::size_t>(vehicle - 1);
}

void write_points(const std::vector<Vector2>& points, double* out, std::size_t capacity, std::size_t* needed,
                  const char* name) {
  if (!check_room(out, capacity, points.size(), needed, name)) return;
  for (std::size_t i = 0; i < points.size(); ++i) std::copy_n(points[i].data(), 2, out + 2 * i);
}

}  // namespace

extern "C" {

cairn_status cairn_fleet_options_init(cairn_fleet_options* options, size_t struct_size, cairn_error* error) {
  return guard(error, [&] { init_options(options, struct_size, sim::default_fleet_options(), "options"); });
}

cairn_status cairn_fleet_create(const cairn_fleet_options* options, cairn_fleet** fleet, cairn_error* error) {
  return guard(error, [&] {
    const cairn_fleet_options checked = sim::read_fleet_options(options);
    check_pointer(fleet, "fleet");
    *fleet = new cairn_fleet(checked);
  });
}

void cairn_fleet_destroy(cairn_fleet* fleet) {
  delete fleet;
}

cairn_status cairn_fleet_next(cairn_fleet* fleet, cairn_fleet_step* step, cairn_error* error) {
  return guard(error, [&] {
    sim::Fleet& f = read_fleet(fleet);
    sim::write_next_step(f, step);
  });
}

cairn_status cairn_fleet_vehicles(const cairn_fleet* fleet, cairn_fleet_vehicle* vehicles, size_t capacity,
                                  size_t* needed, cairn_error* error) {
  return guard(error, [&] {
    const sim::Fleet& f = read_fleet(fleet);
    sim::write_array(f.vehicles().data(), f.started() ? f.vehicles().size() : 0, vehicles, capacity, needed,
                     "vehicles");
  });
}

cairn_status cairn_fleet_seen_features(const cairn_fleet* fleet, uint64_t vehicle, cairn_fleet_sighting* features,
                                       size_t capacity, size_t* needed, cairn_error* error) {
  return guard(error, [&] {
    const sim::Fleet& f = read_fleet(fleet);
    const std::size_t boat = read_boat(f, vehicle);
    const std::size_t count = f.started() ? f.vehicles()[boat].feature_count : 0;
    sim::write_array(f.features_of(boat), count, features, capacity, needed, "features");
  });
}

cairn_status cairn_fleet_seen_vehicles(const cairn_fleet* fleet, uint64_t vehicle, cairn_fleet_sighting* vehicles,
                                       size_t capacity, size_t* needed, cairn_error* error) {
  return guard(error, [&] {
    const sim::Fleet& f = read_fleet(fleet);
    const std::size_t boat = read_boat(f, vehicle);
    const std::size_t count = f.started() ? f.vehicles()[boat].vehicle_count : 0;
    sim::write_array(f.vehicles_of(boat), count, vehicles, capacity, needed, "vehicles");
  });
}

cairn_status cairn_fleet_rewind(cairn_fleet* fleet, cairn_error* error) {
  return guard(error, [&] { read_fleet(fleet).rewind(); });
}

cairn_status cairn_fleet_steps(const cairn_fleet* fleet, size_t* steps, cairn_error* error) {
  return guard(error, [&] {
    const sim::Fleet& f = read_fleet(fleet);
    check_pointer(steps, "steps");
    *steps = f.steps();
  });
}

cairn_status cairn_fleet_features(const cairn_fleet* fleet, double* positions, size_t capacity, size_t* needed,
                                  cairn_error* error) {
  return guard(error,
               [&] { write_points(read_fleet(fleet).scene().features, positions, capacity, needed, "positions"); });
}

cairn_status cairn_fleet_coast(const cairn_fleet* fleet, double* points, size_t capacity, size_t* needed,
                               cairn_error* error) {
  return guard(error, [&] { write_points(read_fleet(fleet).scene().coast, points, capacity, needed, "points"); });
}

}  // extern "C"
