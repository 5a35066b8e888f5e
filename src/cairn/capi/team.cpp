// SPDX-License-Identifier: BSD-3-Clause
// Teams.
#include "team/team.hpp"

#include <optional>

#include "capi/convert.hpp"
#include "capi/filter_handle.hpp"
#include "capi/read_observation.hpp"
#include "team/score.hpp"

using namespace cairn;
using namespace cairn::capi;

struct cairn_team {
  cairn_team(const TeamOptions& options, bool with_baseline)
      : team(options), number(next_filter_number()), map{&team.landmarks(), number, nullptr} {
    if (with_baseline) baseline.emplace(options);
  }
  Team team;
  std::optional<Baseline> baseline;
  Score score;
  std::uint64_t number;
  cairn_map map;
};

namespace cairn {
namespace capi {
namespace {

cairn_team& read_handle(cairn_team* team) {
  check_pointer(team, "team");
  return *team;
}
Team& read_team(cairn_team* team) {
  return read_handle(team).team;
}
const Team& read_team(const cairn_team* team) {
  check_pointer(team, "team");
  return team->team;
}

cairn_team_options default_options() {
  const MailboxOptions d;
  cairn_team_options options = {};
  options.struct_size = sizeof options;
  options.mode = CAIRN_TEAM_JOINT;
  options.max_vehicles = static_cast<std::uint32_t>(d.max_vehicles);
  options.max_lag = d.max_lag;
  options.time_tolerance = d.time_tolerance;
  options.max_waiting = static_cast<std::uint32_t>(d.max_waiting);
  options.history = static_cast<std::uint32_t>(d.history);
  return options;
}

TeamMode read_mode(std::int32_t mode) {
  switch (mode) {
    case CAIRN_TEAM_MONO:
      return TeamMode::mono;
    case CAIRN_TEAM_EO_DIAGONAL:
      return TeamMode::eo_diagonal;
    case CAIRN_TEAM_EO_FULL:
      return TeamMode::eo_full;
    case CAIRN_TEAM_JOINT:
      return TeamMode::joint;
    case CAIRN_TEAM_SUBMAPS:
      return TeamMode::submaps;
    default:
      throw Error(ErrorCode::argument, "options.mode is %d, none of the CAIRN_TEAM_ constants", mode);
  }
}

TeamOptions read_team_options(const cairn_team_options& o, const cairn_filter_options* filter,
                              const cairn_range_bearing* radar) {
  TeamOptions options;
  options.mode = read_mode(o.mode);
  if (o.vehicle == CAIRN_ID_NONE) throw Error(ErrorCode::argument, "options.vehicle is CAIRN_ID_NONE");
  if (o.baseline > 1) throw Error(ErrorCode::argument, "options.baseline must be 0 or 1, and is %u", o.baseline);
  check_range(o.max_vehicles, 1, 256, "options.max_vehicles");
  check_positive(o.max_lag, "options.max_lag");
  check_not_negative(o.time_tolerance, "options.time_tolerance");
  check_range(o.max_waiting, 1, 1000000, "options.max_waiting");
  check_range(o.history, 1, 1000000, "options.history");
  options.mail.vehicle = o.vehicle;
  options.mail.max_vehicles = o.max_vehicles;
  options.mail.max_lag = o.max_lag;
  options.mail.time_tolerance = o.time_tolerance;
  options.mail.max_waiting = o.max_waiting;
  options.mail.history = o.history;
  const auto filter_options = read_filter_options(filter);
  const auto* planar = std::get_if<FilterOptions<SE2>>(&filter_options);
  if (planar == nullptr)
    throw Error(ErrorCode::argument, "filter: its vehicle is spatial; a team's is CAIRN_VEHICLE_PLANAR");
  options.filter = *planar;
  options.filter.max_sensors = 2;
  options.radar = read_range_bearing(radar);
  const bool extended = options.mode == TeamMode::eo_diagonal || options.mode == TeamMode::eo_full;
  const SE2& mount = options.radar.T_body_sensor;
  if (extended && (!mount.translation().isZero(0.0) || mount.rotation().angle() != 0.0))
    throw Error(ErrorCode::argument, "radar.T_body_sensor: extended observations want the radar at the body's origin");
  return options;
}

std::vector<Observation> read_observations(const cairn_observation* observations, std::size_t count, bool named,
                                           const char* array) {
  if (count > 0) check_pointer(observations, array);
  std::vector<Observation> out(count);
  for (std::size_t i = 0; i < count; ++i) {
    read_observation(observations[i], array, i, 2, named, out[i]);
    if (!(observations[i].z[0] >= 0.0))
      throw Error(ErrorCode::argument, "%s[%zu].z: the range is %g, and must not be negative", array, i,
                  observations[i].z[0]);
    if (!named) out[i].id = kNoId;  // nobody is told
  }
  return out;
}

// The comparison filter makes every motion that the team took.
void propagate(cairn_team& handle, const Increment<SE2>& increment) {
  handle.team.propagate(increment);
  if (handle.baseline) handle.baseline->propagate(increment);
}

std::int32_t result_of(Arrival arrival, PacketFault fault) {
  switch (arrival) {
    case Arrival::taken:
      return CAIRN_PACKET_TAKEN;
    case Arrival::waiting:
      return CAIRN_PACKET_WAITING;
    case Arrival::request:
      return CAIRN_PACKET_REQUEST;
    case Arrival::leave:
      return CAIRN_PACKET_LEAVE;
    case Arrival::repeated:
      return CAIRN_PACKET_REPEATED;
    case Arrival::own:
      return CAIRN_PACKET_OWN;
    case Arrival::unknown:
      return CAIRN_PACKET_UNKNOWN;
    case Arrival::past:
      return CAIRN_PACKET_PAST;
    case Arrival::conflict:
      return CAIRN_PACKET_CONFLICT;
    case Arrival::ignored:
      return CAIRN_PACKET_IGNORED;
    case Arrival::full:
      return CAIRN_PACKET_FULL;
    case Arrival::refused:
      break;
  }
  switch (fault) {
    case PacketFault::version:
      return CAIRN_PACKET_VERSION;
    case PacketFault::short_cut:
      return CAIRN_PACKET_CUT;
    case PacketFault::checksum:
      return CAIRN_PACKET_CORRUPT;
    case PacketFault::content:
      return CAIRN_PACKET_NONSENSE;
    default:
      return CAIRN_PACKET_FOREIGN;
  }
}

}  // namespace
}  // namespace capi
}  // namespace cairn

extern "C" {

cairn_status cairn_team_options_init(cairn_team_options* options, size_t struct_size) {
  return guard([&] { init_options(options, struct_size, capi::default_options(), "options"); });
}

cairn_status cairn_team_create(const cairn_team_options* options, const cairn_filter_options* filter,
                               const cairn_range_bearing* radar, cairn_team** team) {
  return guard([&] {
    const cairn_team_options own = read_options(options, default_options(), "options");
    const TeamOptions checked = read_team_options(own, filter, radar);
    check_pointer(team, "team");
    *team = new cairn_team(checked, own.baseline != 0);
  });
}

void cairn_team_destroy(cairn_team* team) {
  delete team;
}

cairn_status cairn_team_add(cairn_team* team, uint64_t vehicle, const cairn_pose* start, const double covariance[36]) {
  return guard([&] {
    Team& t = read_team(team);
    if (start == nullptr) return t.add(vehicle);
    const SE2 pose = read_pose_of<SE2>(start, "start");
    const Matrix3 known = Matrix3::Zero();
    t.add(vehicle, pose, covariance != nullptr ? read_pose_covariance<SE2>(covariance, "covariance") : known);
  });
}

cairn_status cairn_team_remove(cairn_team* team, uint64_t vehicle) {
  return guard([&] { read_team(team).remove(vehicle); });
}

cairn_status cairn_team_members(const cairn_team* team, uint64_t* vehicles, size_t capacity, size_t* needed) {
  return guard([&] {
    const std::vector<std::uint64_t> members = read_team(team).members();
    if (check_room(vehicles, capacity, members.size(), needed, "vehicles"))
      std::copy(members.begin(), members.end(), vehicles);
  });
}

cairn_status cairn_team_predict_increment(cairn_team* team, const cairn_pose* T_before_after,
                                          const double covariance[36]) {
  return guard([&] {
    cairn_team& handle = read_handle(team);
    const SE2 pose = read_pose_of<SE2>(T_before_after, "T_before_after");
    propagate(handle, {pose, read_pose_covariance<SE2>(covariance, "covariance")});
  });
}

cairn_status cairn_team_predict_twist(cairn_team* team, double dt, const double velocity[3], const double rate[3],
                                      const cairn_twist_noise* noise) {
  return guard([&] {
    cairn_team& handle = read_handle(team);
    check_positive(dt, "dt");
    check_pointer(velocity, "velocity");
    check_finite(velocity, 3, "velocity");
    check_pointer(rate, "rate");
    check_finite(rate, 3, "rate");
    const TwistNoise sigma = noise != nullptr ? read_twist_noise(noise) : TwistNoise();
    propagate(handle, integrate_twist<SE2>(Vector3(velocity), Vector3(rate), dt, sigma));
  });
}

cairn_status cairn_team_observe(cairn_team* team, double time, const cairn_observation* landmarks,
                                size_t landmark_count, const cairn_observation* vehicles, size_t vehicle_count) {
  return guard([&] {
    cairn_team& handle = read_handle(team);
    Team& t = handle.team;
    check_finite(time, "time");
    const bool named = t.options().filter.association == AssociationKind::known;
    const std::size_t most = static_cast<std::size_t>(t.options().filter.max_observations);
    if (landmark_count > most || vehicle_count > most - landmark_count)
      throw Error(ErrorCode::capacity, "count: %zu and %zu observations, and max_observations is %zu", landmark_count,
                  vehicle_count, most);
    const std::vector<Observation> scan = read_observations(landmarks, landmark_count, named, "landmarks");
    const std::optional<Error> refusal =
        t.observe(time, scan, read_observations(vehicles, vehicle_count, true, "vehicles"));
    if (handle.baseline) handle.baseline->observe(scan);
    if (refusal) throw Error(*refusal);
  });
}

cairn_status cairn_team_decisions(const cairn_team* team, cairn_match* matches, size_t capacity, size_t* needed) {
  return guard([&] {
    const std::vector<Match>& own = read_team(team).matches();
    if (!check_room(matches, capacity, own.size(), needed, "matches")) return;
    for (std::size_t i = 0; i < own.size(); ++i) write_match(own[i], matches + i);
  });
}

cairn_status cairn_team_leave(cairn_team* team) {
  return guard([&] { read_team(team).leave(); });
}

cairn_status cairn_team_take_packet(cairn_team* team, uint8_t* packet, size_t capacity, size_t* needed) {
  return guard([&] {
    Team& t = read_team(team);
    const std::vector<std::uint8_t>* next = t.next_packet();
    if (!check_room(packet, capacity, next != nullptr ? next->size() : 0, needed, "packet") || next == nullptr) return;
    std::copy(next->begin(), next->end(), packet);
    t.drop_packet();
  });
}

cairn_status cairn_team_ask(cairn_team* team) {
  return guard([&] { read_team(team).ask(); });
}

cairn_status cairn_team_receive(cairn_team* team, const uint8_t* packet, size_t size, int32_t* result) {
  return guard([&] {
    Team& t = read_team(team);
    check_pointer(packet, "packet");
    PacketFault fault = PacketFault::none;
    const Arrival arrival = t.receive(packet, size, fault);
    if (result != nullptr) *result = result_of(arrival, fault);
  });
}

cairn_status cairn_team_pose(const cairn_team* team, uint64_t vehicle, cairn_pose* pose, double covariance[36]) {
  return guard([&] {
    const Team& t = read_team(team);
    const VehicleEstimate now = t.estimate(vehicle);
    write_estimate(now.pose, now.covariance, pose, covariance);
  });
}

cairn_status cairn_team_pose_nees(const cairn_team* team, const cairn_pose* truth, double* nees) {
  return guard([&] {
    const Team& t = read_team(team);
    const SE2 pose = read_pose_of<SE2>(truth, "truth");
    check_pointer(nees, "nees");
    const double value = t.pose_nees(pose);
    if (!(value >= 0.0))
      throw Error(ErrorCode::numerical, "pose covariance is singular: part of the pose is known exactly");
    *nees = value;
  });
}

const cairn_map* cairn_team_map(const cairn_team* team) {
  return team != nullptr ? &team->map : nullptr;
}

cairn_status cairn_team_score(cairn_team* team, const cairn_pose* truth) {
  return guard([&] {
    cairn_team& handle = read_handle(team);
    const SE2 pose = read_pose_of<SE2>(truth, "truth");
    handle.score.add(handle.team, handle.baseline ? &*handle.baseline : nullptr, pose);
  });
}

cairn_status cairn_team_last_report(const cairn_team* team, cairn_team_report* report) {
  return guard([&] {
    const Team& t = read_team(team);
    const MailCounts& mail = t.mail_counts();
    const ScanCounts& scans = t.scan_counts();
    const Score& score = team->score;
    const auto faulty = [&](PacketFault fault) { return mail.faulty[static_cast<int>(fault)]; };
    cairn_team_report out = {};
    out.unsettled = static_cast<std::uint32_t>(t.unsettled());
    out.sent = mail.sent;
    out.resent = mail.resent;
    out.requested = mail.requested;
    out.received = mail.received;
    out.taken = mail.taken;
    out.reordered = mail.reordered;
    out.repeated = mail.repeated;
    out.own = mail.own;
    out.ignored = mail.ignored;
    out.unknown = mail.unknown;
    out.past = mail.past;
    out.conflict = mail.conflict;
    out.full = mail.full;
    out.foreign = faulty(PacketFault::foreign);
    out.version = faulty(PacketFault::version);
    out.cut = faulty(PacketFault::short_cut);
    out.corrupt = faulty(PacketFault::checksum);
    out.nonsense = faulty(PacketFault::content);
    out.lost = mail.lost;
    out.matched = scans.matched;
    out.placed = scans.placed;
    out.rejected = scans.rejected;
    out.sightings_used = scans.sightings_used;
    out.sightings_refused = scans.sightings_refused;
    out.vehicles_found = scans.vehicles_found;
    out.failed = scans.failed;
    out.scored = score.steps();
    out.scored_nees = score.nees_steps();
    out.position_rmse = score.position_rmse();
    out.anees_per_dof = score.anees_per_dof();
    out.claimed_improvement = score.claimed_improvement();
    out.true_improvement = score.true_improvement();
    write_report(out, report);
  });
}

}  // extern "C"
