// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/scene_output.hpp"

#include <cmath>
#include <memory>
#include <vector>

#include "program/library.hpp"
#include "program/output/output_file.hpp"

namespace cairn::program {
namespace {

using Fleet = std::unique_ptr<cairn_fleet, void (*)(cairn_fleet*)>;
using Points = cairn_status (*)(const cairn_fleet*, double*, std::size_t, std::size_t*, cairn_error*);

class Scene {
 public:
  explicit Scene(const std::string& folder) : file_(folder, "team_scene.csv") { file_.text("kind,id,x,y,radius\n"); }

  void point(const char* kind, std::uint64_t id, double x, double y) {
    begin(kind, id, x, y);
    file_.empty(1);
    file_.end();
  }
  void circle(const char* kind, std::uint64_t id, double x, double y, double radius) {
    begin(kind, id, x, y);
    file_.field(radius);
    file_.end();
  }
  void points(const char* kind, Points query, const cairn_fleet* fleet) {
    std::size_t count = 0;
    check_sim(query(fleet, nullptr, 0, &count, nullptr));
    std::vector<double> xy(2 * count);
    check_sim(query(fleet, xy.data(), count, &count, nullptr));
    for (std::size_t i = 0; i < count; ++i) point(kind, i + 1, xy[2 * i], xy[2 * i + 1]);
  }
  void close() { file_.close(); }

 private:
  void begin(const char* kind, std::uint64_t id, double x, double y) {
    file_.field(kind);
    file_.field(id);
    file_.field(x);
    file_.field(y);
  }

  OutputFile file_;
};

}  // namespace

void write_scene(const cairn_fleet_options& options, const std::string& folder) {
  cairn_fleet* created = nullptr;
  check_sim(cairn_fleet_create(&options, &created, nullptr));
  const Fleet fleet(created, &cairn_fleet_destroy);
  Scene scene(folder);
  scene.points("coast", &cairn_fleet_coast, fleet.get());
  scene.points("feature", &cairn_fleet_features, fleet.get());

  const double turn = options.course_length / (2 * std::acos(-1.0));  // radius of a course; boats turn to the left
  cairn_fleet_step step{};
  step.struct_size = sizeof step;
  std::vector<cairn_fleet_vehicle> boats;
  std::size_t steps = 0;
  check_sim(cairn_fleet_steps(fleet.get(), &steps, nullptr));
  for (std::size_t k = 0; k < steps; ++k) {
    check_sim(cairn_fleet_next(fleet.get(), &step, nullptr));
    read_sim_array(boats, [&](cairn_fleet_vehicle* vehicles, std::size_t capacity, std::size_t* needed) {
      return cairn_fleet_vehicles(fleet.get(), vehicles, capacity, needed, nullptr);
    });
    for (std::size_t v = 0; v < boats.size(); ++v) {
      const cairn_fleet_vehicle& boat = boats[v];
      if (k == 0) {
        scene.circle("course", v + 1, boat.x - turn * std::sin(boat.heading), boat.y + turn * std::cos(boat.heading),
                     turn);
        scene.circle("radar", v + 1, boat.x, boat.y, options.radar_range);
      }
      scene.point("drive", v + 1, boat.x, boat.y);
    }
  }
  scene.close();
}

}  // namespace cairn::program
