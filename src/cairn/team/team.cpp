// SPDX-License-Identifier: BSD-3-Clause
// Members, packets and their order. What is made of them: team_modes.cpp.
#include "team/team.hpp"

#include <algorithm>

#include "team/box.hpp"

namespace cairn {
namespace {

constexpr std::size_t kChecksumsKept = 256, kMostResent = 64;

// What the filter that runs beside cannot take is its own affair.
template <class Function>
void quietly(Function&& function) {
  try {
    function();
  } catch (const Error&) {
  }
}

void check_names(const std::vector<Observation>& observations, const char* what) {
  std::uint64_t name = 0;
  if (named_twice(observations, name))
    throw Error(ErrorCode::argument, "%s: number %llu comes twice in one frame", what,
                static_cast<unsigned long long>(name));
}

}  // namespace

Team::Team(const TeamOptions& options) : options_(options) {
  const bool submaps = options.mode == TeamMode::submaps;
  if (submaps == options.filter.single_map())
    throw Error(ErrorCode::argument, submaps ? "options.submap_landmarks is 0; a team that fuses submaps needs some"
                                             : "options.submap_landmarks: this team's filter holds a single map");
  if (submaps) {
    MapOptions<SE2> map = map_options(options.filter);
    map.max_companions = static_cast<std::size_t>(options.max_vehicles - 1);
    fleet_ = std::make_unique<Fleet>(map);
    fleet_->map.name_vehicle(options.vehicle);
    box_ = fleet_->join(options.vehicle, options);
  } else {
    FilterOptions<SE2> filter = options.filter;
    if (options.mode == TeamMode::joint) filter.max_companions = options.max_vehicles - 1;
    box_ = std::make_unique<Box>(filter, options.vehicle, options.radar);
    if (options.mode == TeamMode::eo_diagonal || options.mode == TeamMode::eo_full)  // kExtended
      box_->filter.add(ExtendedObservation(options.radar, {}, options.mode == TeamMode::eo_full));
  }
  if (options.baseline) {
    FilterOptions<SE2> alone = options.filter;
    alone.submap_landmarks = 0;
    baseline_ = std::make_unique<Box>(alone, options.vehicle, options.radar);
  }
  add_member(options.vehicle).known = true;
}

Team::~Team() = default;

Filter<SE2>& Team::filter() {
  return box_->filter;
}
const Filter<SE2>& Team::filter() const {
  return box_->filter;
}

Team::Member* Team::find(std::uint64_t vehicle) {
  for (Member& member : members_)
    if (member.id == vehicle) return &member;
  return nullptr;
}

Team::Member& Team::add_member(std::uint64_t vehicle) {
  if (vehicle == kNoId) throw Error(ErrorCode::argument, "vehicle: CAIRN_ID_NONE is no vehicle's number");
  if (find(vehicle) != nullptr)
    throw Error(ErrorCode::argument, "vehicle: %llu is of the team already", static_cast<unsigned long long>(vehicle));
  if (static_cast<Index>(members_.size()) == options_.max_vehicles)
    throw Error(ErrorCode::capacity, "vehicle: the team has max_vehicles = %td already", options_.max_vehicles);
  const auto former = former_.find(vehicle);
  members_.emplace_back(former != former_.end() ? former->second : Member());
  members_.back().id = vehicle;
  members_.back().left = members_.back().known = false;
  if (former != former_.end()) former_.erase(former);
  return members_.back();
}

void Team::add(std::uint64_t vehicle) {
  if (options_.mode == TeamMode::submaps)
    throw Error(ErrorCode::state, "start: a team that fuses submaps has to know where a teammate started");
  add_member(vehicle);
}

void Team::add(std::uint64_t vehicle, const SE2& start, const Matrix3& covariance) {
  Member& member = add_member(vehicle);
  try {
    if (options_.mode == TeamMode::joint) box_->filter.add_vehicle(vehicle, start, covariance);
    if (options_.mode == TeamMode::submaps) {
      auto box = fleet_->join(vehicle, options_);
      fleet_->map.add_vehicle(vehicle, start, covariance);
      fleet_->teammates[vehicle] = std::move(box);
    }
  } catch (...) {
    members_.pop_back();
    throw;
  }
  member.known = true;
}

void Team::remove(std::uint64_t vehicle) {
  Member* member = find(vehicle);
  if (member == nullptr)
    throw Error(ErrorCode::not_found, "vehicle: %llu is not of the team", static_cast<unsigned long long>(vehicle));
  if (vehicle == options_.vehicle) throw Error(ErrorCode::argument, "vehicle: the own one cannot be removed");
  lose_sight(*member);
  member->waiting.clear();
  former_[vehicle] = *member;
  members_.erase(std::find_if(members_.begin(), members_.end(), [&](const Member& m) { return m.id == vehicle; }));
  settle();  // nobody waits for it any more
}

std::vector<std::uint64_t> Team::members() const {
  std::vector<std::uint64_t> ids;
  for (const Member& member : members_) ids.push_back(member.id);
  return ids;
}

std::size_t Team::unsettled() const {
  return members_.front().waiting.size();
}

void Team::propagate(const Increment<SE2>& increment) {
  const SE2& T = increment.T_before_after;
  if (!T.translation().allFinite() || !increment.covariance.allFinite())
    throw Error(ErrorCode::numerical, "prediction: the motion is not finite; nothing was changed");
  if (pending_.size() == kMostOfPacket)
    throw Error(ErrorCode::capacity, "prediction: %zu motions since the last observation; tell of one in between",
                pending_.size());
  pending_.push_back(increment);
  if (baseline_) quietly([&] { baseline_->filter.propagate(increment); });
}

void Team::send(const Packet& packet) {
  std::vector<std::uint8_t> bytes = encode(packet);
  if (packet.kind != PacketKind::request) {
    history_[packet.number] = bytes;
    if (history_.size() > options_.history) history_.erase(history_.begin());
  }
  outgoing_.push_back(std::move(bytes));
}

void Team::observe(double time, std::vector<Observation> landmarks, std::vector<Observation> vehicles) {
  if (left_) throw Error(ErrorCode::state, "team: the vehicle has left it; create another one to come back");
  Member& self = own();
  const bool first = !self.started && self.waiting.empty();
  if (!first && !(time > self.heard))
    throw Error(ErrorCode::argument, "time: %g lies in the past, the last scan was of %g", time, self.heard);
  const auto most = static_cast<std::size_t>(options_.filter.max_observations);
  if (landmarks.size() + vehicles.size() > most)
    throw Error(ErrorCode::capacity, "count: %zu observations, and max_observations is %zu",
                landmarks.size() + vehicles.size(), most);
  check_names(landmarks, "observations");
  check_names(vehicles, "vehicles");
  for (const Observation& o : vehicles)
    if (o.id == options_.vehicle)
      throw Error(ErrorCode::argument, "vehicles: number %llu is the own one", static_cast<unsigned long long>(o.id));
  Packet packet;
  packet.vehicle = self.id;
  packet.number = self.next + self.waiting.size();
  packet.time = time;
  packet.motions = pending_;  // which stay where sending fails
  packet.landmarks = std::move(landmarks);
  packet.vehicles = std::move(vehicles);
  send(packet);
  ++counts_.sent;
  pending_.clear();
  self.heard = time;
  const std::uint64_t number = packet.number;
  self.waiting[number] = std::move(packet);
  own_error_.reset();
  if (baseline_)
    quietly([&] {
      const std::vector<Observation>& scan = self.waiting[number].landmarks;
      baseline_->filter.update(0, scan.data(), static_cast<Index>(scan.size()));
    });
  settle();
  const bool gap = std::any_of(members_.begin(), members_.end(), [&](const Member& member) {
    return &member != &self && !member.waiting.empty() && member.waiting.begin()->first > member.next;
  });
  if (gap || self.waiting.size() > 1) ask();
  if (own_error_) throw Error(*own_error_);
}

void Team::leave() {
  if (left_) throw Error(ErrorCode::state, "team: the vehicle has left it already");
  Packet packet;
  packet.kind = PacketKind::leave;
  packet.vehicle = own().id;
  packet.number = own().next + own().waiting.size();
  packet.time = own().heard;
  send(packet);
  left_ = true;
  settle();  // no own step is waited for any more
}

// What is between two packets that are there, and what a silent teammate may have sent since.
void Team::ask() {
  if (!uses_teammates()) return;
  for (const Member& member : members_) {
    if (member.id == options_.vehicle || member.waiting.count(member.next) != 0) continue;
    const bool gap = !member.waiting.empty();
    if (!gap && member.started && !(member.time < own().heard - options_.time_tolerance)) continue;
    Packet request;
    request.kind = PacketKind::request;
    request.vehicle = options_.vehicle;
    request.subject = member.id;
    request.first = member.next;
    request.count = gap ? member.waiting.begin()->first - member.next : 0;
    send(request);
    ++counts_.requested;
  }
}

void Team::resend(const Packet& request) {
  std::size_t left = request.count == 0 ? kMostResent : std::min<std::size_t>(request.count, kMostResent);
  for (auto entry = history_.lower_bound(request.first); entry != history_.end() && left > 0; ++entry, --left) {
    if (request.count != 0 && entry->first - request.first >= request.count) break;
    outgoing_.push_back(entry->second);
    ++counts_.resent;
  }
}

Arrival Team::receive(const std::uint8_t* bytes, std::size_t size, PacketFault& fault) {
  ++counts_.received;
  Packet packet;
  fault = decode(bytes, size, packet);
  if (fault != PacketFault::none) {
    ++counts_.faulty[static_cast<int>(fault)];
    return Arrival::refused;
  }
  const bool named = options_.filter.association == AssociationKind::known;
  if (named && std::any_of(packet.landmarks.begin(), packet.landmarks.end(),
                           [](const Observation& o) { return o.id == kNoId; })) {
    fault = PacketFault::content;
    ++counts_.faulty[static_cast<int>(fault)];
    return Arrival::refused;
  }
  if (packet.kind == PacketKind::request) {
    if (packet.subject != options_.vehicle || find(packet.vehicle) == nullptr) {
      ++counts_.ignored;
      return Arrival::ignored;
    }
    resend(packet);
    return Arrival::request;
  }
  if (packet.vehicle == options_.vehicle) {  // a transport's echo, or another vehicle by the own name
    const auto sent = history_.find(packet.number);
    const bool echo =
        sent != history_.end() && std::equal(sent->second.begin(), sent->second.end(), bytes, bytes + size);
    ++(echo ? counts_.own : counts_.conflict);
    return echo ? Arrival::own : Arrival::conflict;
  }
  if (find(packet.vehicle) == nullptr) {
    ++counts_.unknown;
    return Arrival::unknown;
  }
  if (!uses_teammates()) {
    ++counts_.ignored;
    return Arrival::ignored;
  }
  const std::uint64_t vehicle = packet.vehicle, number = packet.number;
  const bool leaves = packet.kind == PacketKind::leave;
  const Arrival stored = store(std::move(packet));
  if (stored != Arrival::waiting) return stored;
  settle();
  const Member* member = find(vehicle);
  if (member == nullptr) return Arrival::leave;
  if (member->waiting.count(number) != 0) return Arrival::waiting;
  return leaves ? Arrival::leave : Arrival::taken;
}

// Among those that wait for their turn; or what speaks against it.
Arrival Team::store(Packet&& packet) {
  Member& member = *find(packet.vehicle);
  const auto known = member.waiting.find(packet.number);
  if (packet.number < member.next || known != member.waiting.end()) {
    bool same = true;  // of those long gone nobody can tell
    if (known != member.waiting.end()) {
      same = known->second.checksum == packet.checksum;
    } else if (member.next - packet.number <= member.checksums.size()) {
      same = member.checksums[member.checksums.size() - (member.next - packet.number)] == packet.checksum;
    }
    ++(same ? counts_.repeated : counts_.conflict);
    return same ? Arrival::repeated : Arrival::conflict;
  }
  // Times rise with the numbers; a leave has that of the last step.
  const auto after = member.waiting.upper_bound(packet.number);
  const bool data = packet.kind == PacketKind::data;
  bool ordered = !member.started || (data ? packet.time > member.time : packet.time >= member.time);
  if (after != member.waiting.begin()) {
    const double before = std::prev(after)->second.time;
    ordered = ordered && (data ? packet.time > before : packet.time >= before);
  }
  if (after != member.waiting.end()) {
    const bool farewell = after->second.kind == PacketKind::leave;
    const double later = after->second.time;
    ordered = ordered && (farewell ? packet.time <= later : packet.time < later);
  }
  if (!ordered) {
    ++counts_.past;
    return Arrival::past;
  }
  if (member.waiting.size() >= options_.max_waiting) {
    ++counts_.full;
    return Arrival::full;
  }
  if (after != member.waiting.end()) ++counts_.reordered;
  member.heard = std::max(member.heard, packet.time);
  const std::uint64_t number = packet.number;
  member.waiting[number] = std::move(packet);
  return Arrival::waiting;
}

// The packets that lie between are given up.
void Team::skip_gap(Member& member) {
  const std::uint64_t first = member.waiting.begin()->first;
  counts_.lost += first - member.next;
  member.next = first;
  member.checksums.clear();
  lose_sight(member);
}

// Whose packets are of the earliest time for which all are there; they are not in the turns yet. False where somebody
// is still to be waited for.
bool Team::next_turns(std::vector<Turn>& turns) {
  turns.clear();
  const double newest = own().heard;
  double earliest = std::numeric_limits<double>::infinity();
  const auto head = [](Member& m) { return m.waiting.find(m.next); };
  for (Member& member : members_) {
    const bool teammate = member.id != options_.vehicle;
    if (teammate && !uses_teammates()) continue;
    if (head(member) == member.waiting.end()) {
      if (!teammate) continue;
      if (!member.waiting.empty()) {
        if (!(newest - member.waiting.begin()->second.time > options_.max_lag)) return false;
        skip_gap(member);
      } else {
        // Silent: waited for, but not for ever.
        const Member& self = own();
        if (self.waiting.empty()) continue;
        if (!member.waited_from) member.waited_from = self.waiting.begin()->second.time;
        const double since = member.started ? member.time : *member.waited_from;
        if (!(newest - since > options_.max_lag)) return false;
        continue;
      }
    }
    earliest = std::min(earliest, head(member)->second.time);
  }
  if (earliest == std::numeric_limits<double>::infinity()) return false;
  // A teammate that is ahead waits for the own step, as that one's waits for it at every other vehicle: without, each
  // would take things in in an order of its own.
  const bool looked = own().started || !own().waiting.empty();
  if (uses_teammates() && !left_ && !(looked && earliest <= newest + options_.time_tolerance)) return false;
  for (Member& member : members_) {
    const auto packet = head(member);
    if (packet == member.waiting.end() || packet->second.time > earliest + options_.time_tolerance) continue;
    turns.push_back({&member, {}});
  }
  std::sort(turns.begin(), turns.end(), [](const Turn& a, const Turn& b) { return a.member->id < b.member->id; });
  return true;
}

void Team::settle() {
  std::vector<Turn> turns;
  while (next_turns(turns)) {
    for (Turn& turn : turns) {  // consumed, whatever becomes of it
      Member& member = *turn.member;
      const auto packet = member.waiting.begin();
      member.checksums.push_back(packet->second.checksum);
      if (member.checksums.size() > kChecksumsKept) member.checksums.pop_front();
      turn.packet = std::move(packet->second);
      member.waiting.erase(packet);
      ++member.next;
      member.time = turn.packet.time;
      member.started = true;
      if (member.id != options_.vehicle) ++counts_.taken;
      member.left = turn.packet.kind == PacketKind::leave;
    }
    turns.erase(std::remove_if(turns.begin(), turns.end(), [](const Turn& turn) { return turn.member->left; }),
                turns.end());
    take_in(turns);
    for (Member& member : members_)
      if (member.left) {
        lose_sight(member);
        former_[member.id] = member;
      }
    members_.erase(std::remove_if(members_.begin(), members_.end(), [](const Member& m) { return m.left; }),
                   members_.end());
  }
}

const Filter<SE2>& Team::filter_of(std::uint64_t vehicle) const {
  if (fleet_ == nullptr || vehicle == options_.vehicle) return box_->filter;
  const auto teammate = fleet_->teammates.find(vehicle);
  return teammate != fleet_->teammates.end() ? teammate->second->filter : box_->filter;
}

Team::Estimate Team::estimate(std::uint64_t vehicle) const {
  const Filter<SE2>& filter = filter_of(vehicle);
  Estimate now{filter.vehicle_pose(vehicle), filter.vehicle_covariance(vehicle)};
  if (vehicle != options_.vehicle) return now;
  const auto move = [&](const Increment<SE2>& motion) {
    now.covariance = ProductJacobians(now.pose, motion.T_before_after).covariance(now.covariance, motion.covariance);
    now.pose = now.pose * motion.T_before_after;
  };
  for (const auto& entry : members_.front().waiting)
    std::for_each(entry.second.motions.begin(), entry.second.motions.end(), move);
  std::for_each(pending_.begin(), pending_.end(), move);
  return now;
}

void Team::score(const SE2& truth) {
  const Estimate now = estimate(options_.vehicle);
  ++score_.steps;
  score_.claimed += now.covariance.topLeftCorner<2, 2>().norm();
  score_.squared_error += (truth.translation() - now.pose.translation()).squaredNorm();
  const double nees = State<SE2>::nees(options_.filter.error, options_.filter.initial_pose.translation(), truth, now.pose,
                                     now.covariance);
  if (nees >= 0.0) {
    ++score_.nees_steps;
    score_.nees += nees;
  }
  if (!baseline_) return;
  score_.claimed_alone += baseline_->filter.pose_covariance().topLeftCorner<2, 2>().norm();
  score_.squared_alone += (truth.translation() - baseline_->filter.pose().translation()).squaredNorm();
}

}  // namespace cairn
