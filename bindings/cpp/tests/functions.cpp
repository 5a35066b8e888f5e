// SPDX-License-Identifier: BSD-3-Clause
// Every function of C by the public interface of C++.
#include "replayer.hpp"

namespace replayer {
namespace {

using namespace cairn;

template <class Options>
void defaults(Call& call, const char* name) {
  call.give(name, Options());
}

void add_custom(Call& call) {
  const auto custom = call.in<Custom>("custom");
  const auto payload = call.payload(custom);
  Filter& filter = call.filter();
  call.give("sensor", call.has("place") ? filter.add_custom(custom, predict_of(payload), place_of(payload))
                                        : filter.add_custom(custom, predict_of(payload)));
}

void check_custom(Call& call) {
  const auto custom = call.in<Custom>("custom");
  const auto payload = call.payload(custom);
  const auto pose = call.in<Pose>("pose");
  const auto landmark = call.list("landmark");
  call.give("worst", call.has("place") ? custom_check(custom, predict_of(payload), place_of(payload), pose, landmark)
                                       : custom_check(custom, predict_of(payload), NoPlace(), pose, landmark));
}

void set_log(Call& call) {
  if (!call.has("log")) return call.filter().clear_log();
  if (call.text("log") != "collect") throw Failure("there is no such log");
  call.filter().set_log([lines = &call.scenario.lines](const char* line) { lines->emplace_back(line); });
}

void merge(Call& call) {
  Map& map = call.scenario.get<Map>(call.text("map"));
  call.give("report", call.has("options") ? map.merge(call.map("other"), call.in<MergeOptions>("options"))
                                          : map.merge(call.map("other")));
}

void add_teammate(Call& call) {
  if (!call.has("start")) return call.team().add(call.id("vehicle"));
  call.team().add(call.id("vehicle"), call.in<Pose>("start"), call.list("covariance"));
}

void team_twist(Call& call) {
  const auto velocity = call.list("velocity"), rate = call.list("rate");
  if (!call.has("noise")) return call.team().predict_twist(call.number("dt"), velocity, rate);
  call.team().predict_twist(call.number("dt"), velocity, rate, call.in<TwistNoise>("noise"));
}

using Observations = std::vector<Observation>;
using Ids = std::vector<std::uint64_t>;
using Bytes = std::vector<std::uint8_t>;

std::map<std::string, Function> library() {
  return {
      {"cairn_status_name", [](Call& c) { c.give_text(status_name(c.in<Status>("status"))); }},
      {"cairn_version", [](Call& c) { c.give_text(version()); }},
      {"cairn_version_number", [](Call& c) { c.give("return", version_number()); }},
      {"cairn_has", [](Call& c) { c.give("return", Bool(has(c.text("feature")))); }},
      {"cairn_build", [](Call& c) { c.give_text(build()); }},
      {"cairn_id_none", [](Call& c) { c.give("return", id_none()); }},
      {"cairn_verdict_text", [](Call& c) { c.give_text(verdict_text(c.in<Verdict>("verdict"))); }},
      {"cairn_doubt_text", [](Call& c) { c.give_text(doubt_text(c.in<Doubts>("reason"))); }},
      {"cairn_pose_identity", [](Call& c) { c.give("pose", pose_identity()); }},
      {"cairn_pose_compose", [](Call& c) { c.give("result", c.in<Pose>("T_a_b") * c.in<Pose>("T_b_c")); }},
      {"cairn_pose_inverse", [](Call& c) { c.give("result", inverse(c.in<Pose>("T_a_b"))); }},
      {"cairn_pose_apply", [](Call& c) { c.give("point_a", transform(c.in<Pose>("T_a_b"), c.list("point_b"))); }},
      {"cairn_pose_error",
       [](Call& c) { c.give("difference", pose_error(c.in<Pose>("truth"), c.in<Pose>("estimate"))); }},
      {"cairn_quaternion_from_euler",
       [](Call& c) {
         c.give("quaternion", quaternion_from_euler(c.number("roll"), c.number("pitch"), c.number("yaw")));
       }},
      {"cairn_quaternion_to_euler",
       [](Call& c) {
         const EulerAngles angles = quaternion_to_euler(c.list("quaternion"));
         c.give("roll", angles.roll), c.give("pitch", angles.pitch), c.give("yaw", angles.yaw);
       }},
      {"cairn_quaternion_exp", [](Call& c) { c.give("quaternion", quaternion_exp(c.list("rotation_vector"))); }},
      {"cairn_quaternion_log", [](Call& c) { c.give("rotation_vector", quaternion_log(c.list("quaternion"))); }},
      {"cairn_merge_options_init", [](Call& c) { defaults<MergeOptions>(c, "options"); }},
      {"cairn_wheels_init", [](Call& c) { defaults<Wheels>(c, "wheels"); }},
      {"cairn_twist_noise_init", [](Call& c) { defaults<TwistNoise>(c, "noise"); }},
      {"cairn_stereo_head_init", [](Call& c) { defaults<StereoHead>(c, "head"); }},
      {"cairn_stereo_camera_init", [](Call& c) { defaults<StereoCamera>(c, "camera"); }},
      {"cairn_range_bearing_init", [](Call& c) { defaults<RangeBearing>(c, "radar"); }},
      {"cairn_cartesian_init", [](Call& c) { defaults<Cartesian>(c, "cartesian"); }},
      {"cairn_custom_init", [](Call& c) { defaults<Custom>(c, "custom"); }},
      {"cairn_filter_options_init", [](Call& c) { defaults<FilterOptions>(c, "options"); }},
      {"cairn_calibration_init", [](Call& c) { defaults<Calibration>(c, "calibration"); }},
      {"cairn_team_options_init", [](Call& c) { defaults<TeamOptions>(c, "options"); }},
      {"cairn_world_options_init", [](Call& c) { defaults<WorldOptions>(c, "options"); }},
      {"cairn_fleet_options_init", [](Call& c) { defaults<FleetOptions>(c, "options"); }},
      {"cairn_custom_check", check_custom},
  };
}

std::map<std::string, Function> maps() {
  return {
      {"cairn_map_size", [](Call& c) { c.give_size("count", c.map().size()); }},
      {"cairn_map_landmark", [](Call& c) { c.give("landmark", c.map().landmark(c.id("id"))); }},
      {"cairn_map_landmarks", [](Call& c) { c.give("landmarks", c.map().landmarks()); }},
      {"cairn_map_within", [](Call& c) { c.give("landmarks", c.map().within(c.list("centre"), c.number("radius"))); }},
      {"cairn_map_nearest",
       [](Call& c) { c.give("landmarks", c.map().nearest(c.list("point"), c.in<std::size_t>("count"))); }},
      {"cairn_map_in_box", [](Call& c) { c.give("landmarks", c.map().in_box(c.list("lower"), c.list("upper"))); }},
      {"cairn_map_joint_covariance", [](Call& c) { c.give("matrix", c.map().joint_covariance(c.in<Ids>("ids"))); }},
      {"cairn_map_kind", [](Call& c) { c.give("kind", c.map().kind()); }},
      {"cairn_map_merged_ids", [](Call& c) { c.give("merged", c.map().merged_ids()); }},
      {"cairn_map_copy", [](Call& c) { c.give_created("copy", c.map().copy()); }},
      {"cairn_map_destroy", [](Call& c) { c.close<Map>("map"); }},
      {"cairn_map_merge", merge},
  };
}

std::map<std::string, Function> filters() {
  return {
      {"cairn_filter_required_bytes",
       [](Call& c) { c.give_size("bytes", required_bytes(c.in<FilterOptions>("options"))); }},
      {"cairn_filter_create", [](Call& c) { c.give_created("filter", Filter(c.in<FilterOptions>("options"))); }},
      {"cairn_filter_destroy", [](Call& c) { c.close<Filter>("filter"); }},
      {"cairn_filter_set_log", set_log},
      {"cairn_filter_add_stereo_head",
       [](Call& c) { c.give("sensor", c.filter().add_stereo_head(c.in<StereoHead>("head"))); }},
      {"cairn_filter_add_stereo_camera",
       [](Call& c) { c.give("sensor", c.filter().add_stereo_camera(c.in<StereoCamera>("camera"))); }},
      {"cairn_filter_add_range_bearing",
       [](Call& c) { c.give("sensor", c.filter().add_range_bearing(c.in<RangeBearing>("radar"))); }},
      {"cairn_filter_add_cartesian",
       [](Call& c) { c.give("sensor", c.filter().add_cartesian(c.in<Cartesian>("cartesian"))); }},
      {"cairn_filter_add_custom", add_custom},
      {"cairn_filter_point_head",
       [](Call& c) { c.filter().point_head(c.sensor(), c.number("pan"), c.number("stick")); }},
      {"cairn_filter_set_loss",
       [](Call& c) { c.filter().set_loss(c.sensor(), c.in<Loss>("loss"), c.number("width")); }},
      {"cairn_filter_set_view", [](Call& c) { c.filter().set_view(c.sensor(), c.list("lower"), c.list("upper")); }},
      {"cairn_filter_set_wheels", [](Call& c) { c.filter().set_wheels(c.in<Wheels>("wheels")); }},
      {"cairn_filter_set_twist_noise", [](Call& c) { c.filter().set_twist_noise(c.in<TwistNoise>("noise")); }},
      {"cairn_filter_predict_wheels",
       [](Call& c) {
         c.filter().predict_wheels(c.number("dt"), c.number("left_rad_per_s"), c.number("right_rad_per_s"));
       }},
      {"cairn_filter_predict_wheels_gyro",
       [](Call& c) {
         c.filter().predict_wheels_gyro(c.number("dt"), c.number("left_rad_per_s"), c.number("right_rad_per_s"),
                                        c.list("rate"));
       }},
      {"cairn_filter_predict_twist",
       [](Call& c) { c.filter().predict_twist(c.number("dt"), c.list("velocity"), c.list("rate")); }},
      {"cairn_filter_predict_increment",
       [](Call& c) { c.filter().predict_increment(c.in<Pose>("T_before_after"), c.list("covariance")); }},
      {"cairn_filter_update",
       [](Call& c) { c.give("matches", c.filter().update(c.sensor(), c.in<Observations>("observations"))); }},
      {"cairn_filter_update_linear",
       [](Call& c) {
         c.give("match", c.filter().update_linear(c.list("residual"), c.list("covariance"), c.list("jacobian_pose"),
                                                  c.in<Ids>("landmarks"), c.list("jacobian_landmarks")));
       }},
      {"cairn_filter_update_position",
       [](Call& c) {
         c.give("match", c.filter().update_position(c.list("position"), c.list("covariance"), c.list("lever_arm")));
       }},
      {"cairn_filter_update_attitude",
       [](Call& c) { c.give("match", c.filter().update_attitude(c.list("quaternion"), c.list("covariance"))); }},
      {"cairn_filter_update_heading",
       [](Call& c) { c.give("match", c.filter().update_heading(c.number("heading"), c.number("sigma"))); }},
      {"cairn_filter_remove_landmark", [](Call& c) { c.filter().remove_landmark(c.id("id")); }},
      {"cairn_filter_merge_landmarks",
       [](Call& c) { c.give("match", c.filter().merge_landmarks(c.id("id"), c.id("other"))); }},
      {"cairn_filter_split_landmark",
       [](Call& c) { c.filter().split_landmark(c.id("id"), c.id("fresh"), c.list("covariance")); }},
      {"cairn_filter_close_submap", [](Call& c) { c.filter().close_submap(); }},
      {"cairn_filter_last_closing", [](Call& c) { c.give("report", c.filter().last_closing()); }},
      {"cairn_filter_local_pose", [](Call& c) { c.give_estimate(c.filter().local_pose()); }},
      {"cairn_filter_base_pose", [](Call& c) { c.give_estimate(c.filter().base_pose()); }},
      {"cairn_filter_pose", [](Call& c) { c.give_estimate(c.filter().pose()); }},
      {"cairn_filter_submap_count", [](Call& c) { c.give_size("count", c.filter().submap_count()); }},
      {"cairn_filter_submap",
       [](Call& c) {
         const ClosedSubmap submap = c.filter().submap(c.in<std::size_t>("index"));
         c.give("base", submap.base), c.give("ids", submap.ids);
       }},
      {"cairn_filter_last_update", [](Call& c) { c.give("report", c.filter().last_update()); }},
      {"cairn_filter_joint_covariance",
       [](Call& c) { c.give("matrix", c.filter().joint_covariance(c.in<Ids>("ids"))); }},
      {"cairn_filter_local_map", [](Call& c) { c.give_lent(c.filter().local_map()); }},
      {"cairn_filter_map", [](Call& c) { c.give_lent(c.filter().map()); }},
      {"cairn_filter_pose_nees", [](Call& c) { c.give("nees", c.filter().pose_nees(c.in<Pose>("truth"))); }},
      {"cairn_filter_audit", [](Call& c) { c.give("min_pivot", c.filter().audit()); }},
      {"cairn_filter_health", [](Call& c) { c.give("health", c.filter().health()); }},
      {"cairn_filter_sensor_health", [](Call& c) { c.give("health", c.filter().sensor_health(c.sensor())); }},
      {"cairn_filter_calibrate_sensor",
       [](Call& c) { c.filter().calibrate_sensor(c.sensor(), c.in<Calibration>("calibration")); }},
      {"cairn_filter_systematic_errors",
       [](Call& c) {
         const SystematicErrors errors = c.filter().systematic_errors();
         c.give("errors", errors.errors), c.give("covariance", errors.covariance);
       }},
      {"cairn_filter_keep_pose", [](Call& c) { c.give("number", c.filter().keep_pose()); }},
      {"cairn_filter_trajectory_range",
       [](Call& c) {
         const PoseNumbers numbers = c.filter().trajectory_range();
         c.give("first", numbers.first), c.give("end", numbers.end);
       }},
      {"cairn_filter_trajectory", [](Call& c) { c.give("poses", c.filter().trajectory(c.id("first"))); }},
  };
}

std::map<std::string, Function> teams() {
  return {
      {"cairn_team_create",
       [](Call& c) {
         c.give_created("team",
                        Team(c.in<TeamOptions>("options"), c.in<FilterOptions>("filter"), c.in<RangeBearing>("radar")));
       }},
      {"cairn_team_destroy", [](Call& c) { c.close<Team>("team"); }},
      {"cairn_team_add", add_teammate},
      {"cairn_team_remove", [](Call& c) { c.team().remove(c.id("vehicle")); }},
      {"cairn_team_members", [](Call& c) { c.give("vehicles", c.team().members()); }},
      {"cairn_team_predict_increment",
       [](Call& c) { c.team().predict_increment(c.in<Pose>("T_before_after"), c.list("covariance")); }},
      {"cairn_team_predict_twist", team_twist},
      {"cairn_team_observe",
       [](Call& c) {
         c.team().observe(c.number("time"), c.in<Observations>("landmarks"), c.in<Observations>("vehicles"));
       }},
      {"cairn_team_decisions", [](Call& c) { c.give("matches", c.team().decisions()); }},
      {"cairn_team_leave", [](Call& c) { c.team().leave(); }},
      {"cairn_team_take_packet", [](Call& c) { c.give("packet", c.team().take_packet()); }},
      {"cairn_team_ask", [](Call& c) { c.team().ask(); }},
      {"cairn_team_receive", [](Call& c) { c.give("result", c.team().receive(c.in<Bytes>("packet"))); }},
      {"cairn_team_pose", [](Call& c) { c.give_estimate(c.team().pose(c.id("vehicle"))); }},
      {"cairn_team_pose_nees", [](Call& c) { c.give("nees", c.team().pose_nees(c.in<Pose>("truth"))); }},
      {"cairn_team_map", [](Call& c) { c.give_lent(c.team().map()); }},
      {"cairn_team_score", [](Call& c) { c.team().score(c.in<Pose>("truth")); }},
      {"cairn_team_last_report", [](Call& c) { c.give("report", c.team().last_report()); }},
  };
}

std::map<std::string, Function> simulators() {
  return {
      {"cairn_world_options_preset",
       [](Call& c) {
         auto options = c.in<WorldOptions>("options");
         c.give("submap_landmarks", set_preset(options, c.in<Preset>("preset")));
         c.give("options", options);
       }},
      {"cairn_world_create", [](Call& c) { c.give_created("world", World(c.in<WorldOptions>("options"))); }},
      {"cairn_world_destroy", [](Call& c) { c.close<World>("world"); }},
      {"cairn_world_next", [](Call& c) { c.give("step", c.world().next()); }},
      {"cairn_world_motions", [](Call& c) { c.give("motions", c.world().motions()); }},
      {"cairn_world_observations", [](Call& c) { c.give("observations", c.world().observations()); }},
      {"cairn_world_rewind", [](Call& c) { c.world().rewind(); }},
      {"cairn_world_steps", [](Call& c) { c.give_size("steps", c.world().steps()); }},
      {"cairn_world_most_observations", [](Call& c) { c.give_size("count", c.world().most_observations()); }},
      {"cairn_world_head", [](Call& c) { c.give("head", c.world().head()); }},
      {"cairn_world_wheels", [](Call& c) { c.give("wheels", c.world().wheels()); }},
      {"cairn_world_pose", [](Call& c) { c.give("pose", c.world().pose(c.number("time"))); }},
      {"cairn_world_contacts", [](Call& c) { c.give("points", c.world().contacts(c.number("time"))); }},
      {"cairn_world_height", [](Call& c) { c.give("height", c.world().height(c.number("x"), c.number("y"))); }},
      {"cairn_world_extent",
       [](Call& c) {
         const Extent extent = c.world().extent();
         c.give("lower", extent.lower), c.give("upper", extent.upper);
       }},
      {"cairn_world_landmark", [](Call& c) { c.give("position", c.world().landmark(c.id("id"))); }},
      {"cairn_world_landmarks", [](Call& c) { c.give("positions", c.world().landmarks()); }},
      {"cairn_fleet_create", [](Call& c) { c.give_created("fleet", Fleet(c.in<FleetOptions>("options"))); }},
      {"cairn_fleet_destroy", [](Call& c) { c.close<Fleet>("fleet"); }},
      {"cairn_fleet_next", [](Call& c) { c.give("step", c.fleet().next()); }},
      {"cairn_fleet_vehicles", [](Call& c) { c.give("vehicles", c.fleet().vehicles()); }},
      {"cairn_fleet_seen_features", [](Call& c) { c.give("features", c.fleet().seen_features(c.id("vehicle"))); }},
      {"cairn_fleet_seen_vehicles", [](Call& c) { c.give("vehicles", c.fleet().seen_vehicles(c.id("vehicle"))); }},
      {"cairn_fleet_rewind", [](Call& c) { c.fleet().rewind(); }},
      {"cairn_fleet_steps", [](Call& c) { c.give_size("steps", c.fleet().steps()); }},
      {"cairn_fleet_features", [](Call& c) { c.give("positions", c.fleet().features()); }},
      {"cairn_fleet_coast", [](Call& c) { c.give("points", c.fleet().coast()); }},
  };
}

}  // namespace

const std::map<std::string, Function>& functions() {
  static const std::map<std::string, Function> all = [] {
    std::map<std::string, Function> result;
    for (auto part : {library(), maps(), filters(), teams(), simulators()}) result.merge(part);
    return result;
  }();
  return all;
}

}  // namespace replayer
