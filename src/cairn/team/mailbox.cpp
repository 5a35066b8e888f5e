// SPDX-License-Identifier: BSD-3-Clause
#include "team/mailbox.hpp"

#include <algorithm>
#include <cmath>
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

Mailbox::Mailbox(const MailboxOptions& options)
    : options_(options), history_(options.history), outbox_(options.max_vehicles) {
  turns_.reserve(options.max_vehicles);
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
  const auto former = std::find_if(former_.begin(), former_.end(), [&](const Member& m) { return m.id() == vehicle; });
  members_.push_back(former != former_.end() ? *former : Member(vehicle));
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
  member->forget_waiting();
  drop(member);
}

std::vector<std::uint64_t> Mailbox::members() const {
  std::vector<std::uint64_t> ids;
  for (const Member& member : members_) ids.push_back(member.id());
  return ids;
}

void Mailbox::drop(std::list<Member>::iterator member) noexcept {
  const std::uint64_t id = member->id();
  former_.remove_if([&](const Member& former) { return former.id() == id; });
  former_.splice(former_.end(), members_, member);
  outbox_.forget_request(id);
}

// --- this vehicle ---

void Mailbox::move(const Increment<SE2>& increment) {
  constexpr double kTurnSquared = 39.478417604357432;  // (2 pi)^2
  if (!is_motion(increment) || increment.covariance(2, 2) > kTurnSquared)
    throw Error(ErrorCode::numerical,
                "prediction: a motion or its noise is not finite, longer than %g m or more than a whole turn; nothing "
                "was changed",
                kFarthest);
  if (pending_.size() == kMostOfPacket)
    throw Error(ErrorCode::capacity,
                "prediction: %zu motions since the last observation are too many; call cairn_team_observe in between",
                pending_.size());
  pending_.push_back(increment);
}

// A clock that is wrong once must not lock all later steps out: a step far ahead is refused, unless a later call
// confirms it.
void Mailbox::check_time(double time) {
  double known = -std::numeric_limits<double>::infinity();
  if (looked()) {
    if (!(time > newest_))
      throw Error(ErrorCode::argument, "time: %g is in the past; the last scan was at %g", time, newest_);
    known = newest_;
  } else {
    for (const Member& member : members_)
      if (!member.empty()) known = std::max(known, member.waiting().rbegin()->second.time);
  }
  const bool far = std::isfinite(known) && time - known > options_.max_jump;
  const bool confirmed = refused_time_ && time > *refused_time_ && time - *refused_time_ <= options_.max_jump;
  if (!far || confirmed) return;
  refused_time_ = time;
  throw Error(ErrorCode::argument,
              "time: %g is %g s after the last scan, and max_jump is %g s; if the clock is right, the next step will "
              "be taken",
              time, time - known, options_.max_jump);
}

void Mailbox::observe(double time, std::vector<Observation> landmarks, std::vector<Observation> vehicles) {
  if (left_) throw Error(ErrorCode::state, "team: the vehicle has left it; create another one to come back");
  check_names(landmarks, "observations");
  check_names(vehicles, "vehicles");
  for (const Observation& o : vehicles)
    if (o.id == options_.vehicle)
      throw Error(ErrorCode::argument, "vehicles: number %llu is this vehicle itself, which it cannot see",
                  static_cast<unsigned long long>(o.id));
  check_time(time);
  Packet packet;
  packet.vehicle = options_.vehicle;
  packet.number = own().end();
  packet.time = time;
  packet.motions = pending_;
  packet.landmarks = std::move(landmarks);
  packet.vehicles = std::move(vehicles);
  const Bytes bytes = std::make_shared<const std::vector<std::uint8_t>>(encode(packet));
  History::Entry sent(packet.number, bytes);
  Member::Entry step(std::move(packet));
  outbox_.make_room(1);

  outbox_.push(step.packet().number, bytes);
  history_.keep(std::move(sent));
  own().append(std::move(step));
  ++counts_.sent;
  pending_.clear();
  refused_time_.reset();
  newest_ = time;
}

void Mailbox::leave() {
  if (left_) throw Error(ErrorCode::state, "team: the vehicle has left it already");
  Packet packet;
  packet.kind = PacketKind::leave;
  packet.vehicle = options_.vehicle;
  packet.number = own().end();
  packet.time = newest_;
  const Bytes bytes = std::make_shared<const std::vector<std::uint8_t>>(encode(packet));
  History::Entry sent(packet.number, bytes);
  outbox_.make_room(1);

  outbox_.push(packet.number, bytes);
  history_.keep(std::move(sent));
  left_ = true;
}

// --- packets to be sent ---

// Requests the packets of a gap, and those that a silent teammate may have sent since its last one.
void Mailbox::ask() noexcept {
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
    counts_.requested += outbox_.request(request);
  }
}

void Mailbox::ask_if_missing() noexcept {
  const bool gap = std::any_of(members_.begin(), members_.end(),
                               [&](const Member& member) { return !is_own(member) && member.has_gap(); });
  if (gap || own().size() > 1) ask();
}

// --- packets that arrive ---

Arrival Mailbox::count(Arrival arrival) noexcept {
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
    case Arrival::ahead:
      ++counts_.ahead;
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
  Packet packet;
  fault = decode(bytes, size, packet);
  const auto nameless = [](const Observation& o) { return o.id == kNoId; };
  if (fault == PacketFault::none && options_.named &&
      std::any_of(packet.landmarks.begin(), packet.landmarks.end(), nameless))
    fault = PacketFault::content;
  if (fault == PacketFault::none && packet.kind == PacketKind::request) {
    if (packet.subject == options_.vehicle) outbox_.make_room(History::kMostResent);
    ++counts_.received;
    return count(answer(packet));
  }
  name = {packet.vehicle, packet.number, packet.kind};
  Member::Entry arrived(std::move(packet));

  ++counts_.received;
  if (fault != PacketFault::none) {
    ++counts_.faulty[static_cast<int>(fault)];
    return Arrival::refused;
  }
  if (name.vehicle == options_.vehicle)  // a transport's echo, or another vehicle with this vehicle's number
    return count(history_.holds(name.number, bytes, size) ? Arrival::own : Arrival::conflict);
  Member* const member = find(name.vehicle);
  if (member == nullptr) return count(Arrival::unknown);
  if (!options_.listens) return count(Arrival::ignored);
  bool late = false;
  const WaitingLimits limits = {options_.max_waiting, options_.max_jump, looked() ? &newest_ : nullptr};
  const Arrival arrival = member->insert(std::move(arrived), limits, late);
  if (late) ++counts_.reordered;
  return count(arrival);
}

Arrival Mailbox::answer(const Packet& request) noexcept {
  if (request.subject != options_.vehicle || find(request.vehicle) == nullptr) return Arrival::ignored;
  history_.for_each_absent(request.first, request.count, [&](std::uint64_t number, History::Sent& sent) {
    outbox_.push(number, sent.bytes);
    sent.waits = true;
    ++counts_.resent;
  });
  return Arrival::request;
}

Arrival Mailbox::outcome(const PacketName& name) {
  const Member* member = find(name.vehicle);
  if (member == nullptr) return Arrival::leave;
  if (member->waiting().count(name.number) != 0) return Arrival::waiting;
  return name.kind == PacketKind::leave ? Arrival::leave : Arrival::taken;
}

// --- turns ---

Mailbox::Readiness Mailbox::readiness(Member& member) noexcept {
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

std::optional<std::uint64_t> Mailbox::skip_overdue_gap() noexcept {
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

bool Mailbox::next_turn(std::vector<Packet>& packets) noexcept {
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
  if (options_.listens && !left_ && !(looked() && earliest <= newest_ + options_.time_tolerance)) return false;

  turns_.clear();
  for (Member& member : members_)
    if (member.ready() && !(member.first().time > earliest + options_.time_tolerance)) turns_.push_back(&member);
  std::sort(turns_.begin(), turns_.end(), [](const Member* a, const Member* b) { return a->id() < b->id(); });
  for (Member* member : turns_) {  // consumed, even if the packet is refused
    Packet packet = member->consume();
    if (!is_own(*member)) ++counts_.taken;
    if (packet.kind != PacketKind::leave) packets.push_back(std::move(packet));
  }
  return true;
}

std::optional<std::uint64_t> Mailbox::remove_departed() noexcept {
  const auto member = std::find_if(members_.begin(), members_.end(), [](const Member& m) { return m.left(); });
  if (member == members_.end()) return std::nullopt;
  const std::uint64_t id = member->id();
  drop(member);
  return id;
}

}  // namespace cairn
