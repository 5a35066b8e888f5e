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

void write_points(const std::vector<Vector2>& points, double* out, std::size_t capacity, std::size_t* needed,
                  const char* name) {
  if (!check_room(out, capacity, points.size(), needed, name)) return;
  for (std::size_t i = 0; i < points.size(); ++i) std::copy_n(points[i].data(), 2, out + 2 * i);
}

}  // namespace

extern "C" {

cairn_status cairn_fleet_options_init(cairn_fleet_options* options, size_t struct_size) {
  return guard([&] { init_options(options, struct_size, sim::default_fleet_options(), "options"); });
}

cairn_status cairn_fleet_create(const cairn_fleet_options* options, cairn_fleet** fleet) {
  return guard([&] {
    const cairn_fleet_options checked = sim::read_fleet_options(options);
    check_pointer(fleet, "fleet");
    *fleet = new cairn_fleet(checked);
  });
}

void cairn_fleet_destroy(cairn_fleet* fleet) {
  delete fleet;
}

cairn_status cairn_fleet_next(cairn_fleet* fleet, cairn_fleet_step* step) {
  return guard([&] {
    sim::Fleet& f = read_fleet(fleet);
    sim::write_next_step(f, step);
  });
}

cairn_status cairn_fleet_rewind(cairn_fleet* fleet) {
  return guard([&] { read_fleet(fleet).rewind(); });
}

cairn_status cairn_fleet_steps(const cairn_fleet* fleet, size_t* steps) {
  return guard([&] {
    const sim::Fleet& f = read_fleet(fleet);
    check_pointer(steps, "steps");
    *steps = f.steps();
  });
}

cairn_status cairn_fleet_features(const cairn_fleet* fleet, double* positions, size_t capacity, size_t* needed) {
  return guard([&] { write_points(read_fleet(fleet).scene().features, positions, capacity, needed, "positions"); });
}

cairn_status cairn_fleet_coast(const cairn_fleet* fleet, double* points, size_t capacity, size_t* needed) {
  return guard([&] { write_points(read_fleet(fleet).scene().coast, points, capacity, needed, "points"); });
}

}  // extern "C"
