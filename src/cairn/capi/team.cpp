// SPDX-License-Identifier: BSD-3-Clause
// Teams.
#include "capi/convert.hpp"
#include "capi/filter_handle.hpp"
#include "capi/read_observation.hpp"
#include "capi/team_handle.hpp"

using namespace cairn;
using namespace cairn::capi;

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

std::vector<Observation> read_observations(const cairn_observation* observations, std::size_t count, bool named,
                                           const char* array) {
  if (count > 0) check_pointer(observations, array);
  std::vector<Observation> out(count);
  for (std::size_t i = 0; i < count; ++i) {
    read_observation(observations[i], array, i, 2, named, out[i]);
    if (!(observations[i].z[0] >= 0.0))
      throw Error(ErrorCode::argument, "%s[%zu].z: the range is %g, and must not be negative", array, i,
                  observations[i].z[0]);
    if (!named) out[i].id = kNoId;  // teammates do not get the id
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
    case Arrival::ahead:
      return CAIRN_PACKET_AHEAD;
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

cairn_status cairn_team_create(const cairn_team_options* options, const cairn_filter_options* filter,
                               const cairn_range_bearing* radar, cairn_team** team, cairn_error* error) {
  return guard(error, [&] {
    const cairn_team_options own = read_team_options(options);
    const TeamOptions checked = team_options(own, filter, radar);
    check_pointer(team, "team");
    *team = new cairn_team(checked, own.baseline != 0);
  });
}

void cairn_team_destroy(cairn_team* team) {
  delete team;
}

cairn_status cairn_team_add(cairn_team* team, uint64_t vehicle, const cairn_pose* start, const double covariance[36],
                            cairn_error* error) {
  return guard(error, [&] {
    Team& t = read_team(team);
    if (start == nullptr) return t.add(vehicle);
    const SE2 pose = read_pose_of<SE2>(start, "start");
    const Matrix3 known = Matrix3::Zero();
    t.add(vehicle, pose, covariance != nullptr ? read_pose_covariance<SE2>(covariance, "covariance") : known);
  });
}

cairn_status cairn_team_remove(cairn_team* team, uint64_t vehicle, cairn_error* error) {
  return guard(error, [&] { read_team(team).remove(vehicle); });
}

cairn_status cairn_team_members(const cairn_team* team, uint64_t* vehicles, size_t capacity, size_t* needed,
                                cairn_error* error) {
  return guard(error, [&] {
    const std::vector<std::uint64_t> members = read_team(team).members();
    if (check_room(vehicles, capacity, members.size(), needed, "vehicles"))
      std::copy(members.begin(), members.end(), vehicles);
  });
}

cairn_status cairn_team_predict_increment(cairn_team* team, const cairn_pose* T_before_after,
                                          const double covariance[36], cairn_error* error) {
  return guard(error, [&] {
    cairn_team& handle = read_handle(team);
    const SE2 pose = read_pose_of<SE2>(T_before_after, "T_before_after");
    propagate(handle, {pose, read_pose_covariance<SE2>(covariance, "covariance")});
  });
}

cairn_status cairn_team_predict_twist(cairn_team* team, double dt, const double velocity[3], const double rate[3],
                                      const cairn_twist_noise* noise, cairn_error* error) {
  return guard(error, [&] {
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
                                size_t landmark_count, const cairn_observation* vehicles, size_t vehicle_count,
                                cairn_error* error) {
  return guard(error, [&] {
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

cairn_status cairn_team_decisions(const cairn_team* team, cairn_match* matches, size_t capacity, size_t* needed,
                                  cairn_error* error) {
  return guard(error, [&] {
    const std::vector<Match>& own = read_team(team).matches();
    if (!check_room(matches, capacity, own.size(), needed, "matches")) return;
    for (std::size_t i = 0; i < own.size(); ++i) write_match(own[i], matches + i);
  });
}

cairn_status cairn_team_leave(cairn_team* team, cairn_error* error) {
  return guard(error, [&] { read_team(team).leave(); });
}

cairn_status cairn_team_take_packet(cairn_team* team, uint8_t* packet, size_t capacity, size_t* needed,
                                    cairn_error* error) {
  return guard(error, [&] {
    Team& t = read_team(team);
    const std::vector<std::uint8_t>* next = t.next_packet();
    if (!check_room(packet, capacity, next != nullptr ? next->size() : 0, needed, "packet") || next == nullptr) return;
    std::copy(next->begin(), next->end(), packet);
    t.drop_packet();
  });
}

cairn_status cairn_team_ask(cairn_team* team, cairn_error* error) {
  return guard(error, [&] { read_team(team).ask(); });
}

cairn_status cairn_team_receive(cairn_team* team, const uint8_t* packet, size_t size, int32_t* result,
                                cairn_error* error) {
  return guard(error, [&] {
    Team& t = read_team(team);
    check_pointer(packet, "packet");
    PacketFault fault = PacketFault::none;
    const Arrival arrival = t.receive(packet, size, fault);
    if (result != nullptr) *result = result_of(arrival, fault);
  });
}

cairn_status cairn_team_pose(const cairn_team* team, uint64_t vehicle, cairn_pose* pose, double covariance[36],
                             cairn_error* error) {
  return guard(error, [&] {
    const Team& t = read_team(team);
    const VehicleEstimate now = t.estimate(vehicle);
    write_estimate(now.pose, now.covariance, pose, covariance);
  });
}

cairn_status cairn_team_pose_nees(const cairn_team* team, const cairn_pose* truth, double* nees, cairn_error* error) {
  return guard(error, [&] {
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

cairn_status cairn_team_score(cairn_team* team, const cairn_pose* truth, cairn_error* error) {
  return guard(error, [&] {
    cairn_team& handle = read_handle(team);
    const SE2 pose = read_pose_of<SE2>(truth, "truth");
    handle.score.add(handle.team, handle.baseline ? &*handle.baseline : nullptr, pose);
  });
}

cairn_status cairn_team_last_report(const cairn_team* team, cairn_team_report* report, cairn_error* error) {
  return guard(error, [&] {
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
    out.ahead = mail.ahead;
    out.interrupted = t.interrupted() ? 1 : 0;
    write_report(out, report);
  });
}

}  // extern "C"
