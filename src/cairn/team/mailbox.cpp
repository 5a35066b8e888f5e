// SPDX-License-Identifier: BSD-3-Clause
#include "team/mailbox.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"

namespace cairn {
namespace {

void check_names(const std::vector<Observation>& observations, const char* what) {
  std::uint64_t name = 0;
  if (named_twice(observations, name))
    throw Error(ErrorCode::argument, "%s: number %llu comes twice in one frame", what,
                static_cast<unsigned long long>(name));
}

}  // namespace

Mailbox::Mailbox(const MailboxOptions& options) : options_(options), history_(options.history) {
  add(options.vehicle);
}

// --- members ---

Member* Mailbox::find(std::uint64_t vehicle) {
  for (Member& member : members_)
    if (member.id() == vehicle) return &member;
  return nullptr;
}

// A former member's entry is kept until the member leaves once more, so that undo_add() loses nothing.
void Mailbox::add(std::uint64_t vehicle) {
  if (vehicle == kNoId) throw Error(ErrorCode::argument, "vehicle: CAIRN_ID_NONE is no vehicle's number");
  if (find(vehicle) != nullptr)
    throw Error(ErrorCode::argument, "vehicle: %llu is already in the team", static_cast<unsigned long long>(vehicle));
  if (members_.size() == options_.max_vehicles)
    throw Error(ErrorCode::capacity, "vehicle: the team has max_vehicles = %zu already", options_.max_vehicles);
  const auto former = former_.find(vehicle);
  members_.emplace_back(former != former_.end() ? former->second : Member(vehicle));
  members_.back().rejoin();
}

void Mailbox::remove(std::uint64_t vehicle) {
  const auto member =
      std::find_if(members_.begin(), members_.end(), [&](const Member& m) { return m.id() == vehicle; });
  if (member == members_.end())
    throw Error(ErrorCode::not_found, "vehicle: %llu is not in the team", static_cast<unsigned long long>(vehicle));
  if (is_own(*member))
    throw Error(ErrorCode::argument,
                "vehicle: %llu is this vehicle itself, which cannot be removed; use cairn_team_leave to leave the team",
                static_cast<unsigned long long>(vehicle));
  drop(member);
  former_.at(vehicle).forget_waiting();
}

std::vector<std::uint64_t> Mailbox::members() const {
  std::vector<std::uint64_t> ids;
  for (const Member& member : members_) ids.push_back(member.id());
  return ids;
}

void Mailbox::drop(std::deque<Member>::iterator member) {
  former_.insert_or_assign(member->id(), std::move(*member));
  members_.erase(member);
}

// --- this vehicle ---

void Mailbox::move(const Increment<SE2>& increment) {
  const SE2& T = increment.T_before_after;
  if (!T.translation().allFinite() || !increment.covariance.allFinite())
    throw Error(ErrorCode::numerical, "prediction: the motion is not finite; nothing was changed");
  if (pending_.size() == kMostOfPacket)
    throw Error(ErrorCode::capacity,
                "prediction: %zu motions since the last observation are too many; call cairn_team_observe in between",
                pending_.size());
  pending_.push_back(increment);
}

void Mailbox::observe(double time, std::vector<Observation> landmarks, std::vector<Observation> vehicles) {
  if (left_) throw Error(ErrorCode::state, "team: the vehicle has left it; create another one to come back");
  const bool first = !own().started() && own().empty();
  if (!first && !(time > newest_))
    throw Error(ErrorCode::argument, "time: %g is in the past; the last scan was at %g", time, newest_);
  check_names(landmarks, "observations");
  check_names(vehicles, "vehicles");
  for (const Observation& o : vehicles)
    if (o.id == options_.vehicle)
      throw Error(ErrorCode::argument, "vehicles: number %llu is this vehicle itself, which it cannot see",
                  static_cast<unsigned long long>(o.id));
  Packet packet;
  packet.vehicle = options_.vehicle;
  packet.number = own().end();
  packet.time = time;
  packet.motions = pending_;  // which are kept if sending fails
  packet.landmarks = std::move(landmarks);
  packet.vehicles = std::move(vehicles);
  send(packet);
  ++counts_.sent;
  pending_.clear();
  newest_ = time;
  own().append(std::move(packet));
}

void Mailbox::leave() {
  if (left_) throw Error(ErrorCode::state, "team: the vehicle has left it already");
  Packet packet;
  packet.kind = PacketKind::leave;
  packet.vehicle = options_.vehicle;
  packet.number = own().end();
  packet.time = newest_;
  send(packet);
  left_ = true;
}

// --- packets to be sent ---

void Mailbox::send(const Packet& packet) {
  std::vector<std::uint8_t> bytes = encode(packet);
  if (packet.kind != PacketKind::request) history_.keep(packet.number, bytes);
  outgoing_.push_back(std::move(bytes));
}

// Requests the packets of a gap, and those that a silent teammate may have sent since its last one.
void Mailbox::ask() {
  if (!options_.listens) return;
  for (const Member& member : members_) {
    if (is_own(member) || member.ready()) continue;
    const bool gap = member.has_gap();
    if (!gap && member.started() && !(member.time() < newest_ - options_.time_tolerance)) continue;
    Packet request;
    request.kind = PacketKind::request;
    request.vehicle = options_.vehicle;
    request.subject = member.id();
    request.first = member.next();
    request.count = gap ? member.gap() : 0;
    send(request);
    ++counts_.requested;
  }
}

void Mailbox::ask_if_missing() {
  const bool gap = std::any_of(members_.begin(), members_.end(),
                               [&](const Member& member) { return !is_own(member) && member.has_gap(); });
  if (gap || own().size() > 1) ask();
}

// --- packets that arrive ---

Arrival Mailbox::count(Arrival arrival) {
  switch (arrival) {
    case Arrival::repeated:
      ++counts_.repeated;
      break;
    case Arrival::own:
      ++counts_.own;
      break;
    case Arrival::unknown:
      ++counts_.unknown;
      break;
    case Arrival::past:
      ++counts_.past;
      break;
    case Arrival::conflict:
      ++counts_.conflict;
      break;
    case Arrival::ignored:
      ++counts_.ignored;
      break;
    case Arrival::full:
      ++counts_.full;
      break;
    case Arrival::taken:  // by its turn
    case Arrival::waiting:
    case Arrival::request:
    case Arrival::leave:
    case Arrival::refused:  // by its fault
      break;
  }
  return arrival;
}

Arrival Mailbox::receive(const std::uint8_t* bytes, std::size_t size, PacketFault& fault, PacketName& name) {
  ++counts_.received;
  Packet packet;
  fault = decode(bytes, size, packet);
  const auto nameless = [](const Observation& o) { return o.id == kNoId; };
  if (fault == PacketFault::none && options_.named &&
      std::any_of(packet.landmarks.begin(), packet.landmarks.end(), nameless))
    fault = PacketFault::content;
  if (fault != PacketFault::none) {
    ++counts_.faulty[static_cast<int>(fault)];
    return Arrival::refused;
  }
  if (packet.kind == PacketKind::request) return count(answer(packet));
  if (packet.vehicle == options_.vehicle)  // a transport's echo, or another vehicle with this vehicle's number
    return count(history_.holds(packet.number, bytes, size) ? Arrival::own : Arrival::conflict);
  if (find(packet.vehicle) == nullptr) return count(Arrival::unknown);
  if (!options_.listens) return count(Arrival::ignored);
  name = {packet.vehicle, packet.number, packet.kind};
  return count(store(std::move(packet)));
}

Arrival Mailbox::answer(const Packet& request) {
  if (request.subject != options_.vehicle || find(request.vehicle) == nullptr) return Arrival::ignored;
  for (const std::vector<std::uint8_t>* bytes : history_.range(request.first, request.count)) {
    outgoing_.push_back(*bytes);
    ++counts_.resent;
  }
  return Arrival::request;
}

Arrival Mailbox::store(Packet&& packet) {
  bool late = false;
  Member& member = *find(packet.vehicle);
  const Arrival arrival = member.insert(std::move(packet), options_.max_waiting, late);
  if (late) ++counts_.reordered;
  return arrival;
}

Arrival Mailbox::outcome(const PacketName& name) {
  const Member* member = find(name.vehicle);
  if (member == nullptr) return Arrival::leave;
  if (member->waiting().count(name.number) != 0) return Arrival::waiting;
  return name.kind == PacketKind::leave ? Arrival::leave : Arrival::taken;
}

// --- turns ---

Mailbox::Readiness Mailbox::readiness(Member& member) {
  if (!is_own(member) && !options_.listens) return Readiness::idle;
  if (member.ready()) return Readiness::ready;
  if (is_own(member)) return Readiness::idle;
  if (member.has_gap())
    return newest_ - member.first().time > options_.max_lag ? Readiness::overdue_gap : Readiness::awaited;
  // The member is silent. Only a waiting step of this vehicle has to wait for it, and only for max_lag.
  if (own().empty()) return Readiness::idle;
  const double since = member.silent_since(own().first().time);
  return newest_ - since > options_.max_lag ? Readiness::idle : Readiness::awaited;
}

std::optional<std::uint64_t> Mailbox::skip_overdue_gap() {
  for (Member& member : members_) {
    const Readiness state = readiness(member);
    if (state == Readiness::awaited) return std::nullopt;
    if (state != Readiness::overdue_gap) continue;
    counts_.lost += member.gap();
    member.skip_gap();
    return member.id();
  }
  return std::nullopt;
}

bool Mailbox::next_turn(std::vector<Packet>& packets) {
  packets.clear();
  double earliest = std::numeric_limits<double>::infinity();
  for (Member& member : members_) {
    const Readiness state = readiness(member);
    if (state == Readiness::awaited || state == Readiness::overdue_gap) return false;
    if (state == Readiness::ready) earliest = std::min(earliest, member.first().time);
  }
  if (earliest == std::numeric_limits<double>::infinity()) return false;
  // A teammate that is ahead waits for this vehicle's step, just as this vehicle's step waits for the teammate at every
  // other vehicle: otherwise the vehicles would take the packets in different orders.
  const bool looked = own().started() || !own().empty();
  if (options_.listens && !left_ && !(looked && earliest <= newest_ + options_.time_tolerance)) return false;

  std::vector<Member*> turns;
  for (Member& member : members_)
    if (member.ready() && !(member.first().time > earliest + options_.time_tolerance)) turns.push_back(&member);
  std::sort(turns.begin(), turns.end(), [](const Member* a, const Member* b) { return a->id() < b->id(); });
  packets.reserve(turns.size());
  for (Member* member : turns) {  // consumed, even if the packet is refused
    Packet packet = member->consume();
    if (!is_own(*member)) ++counts_.taken;
    if (packet.kind != PacketKind::leave) packets.push_back(std::move(packet));
  }
  return true;
}

std::optional<std::uint64_t> Mailbox::remove_departed() {
  const auto member = std::find_if(members_.begin(), members_.end(), [](const Member& m) { return m.left(); });
  if (member == members_.end()) return std::nullopt;
  const std::uint64_t id = member->id();
  drop(member);
  return id;
}

}  // namespace cairn
