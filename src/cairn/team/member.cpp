// SPDX-License-Identifier: BSD-3-Clause
#include "team/member.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace cairn {

// Whether the vehicle sent the same packet with this number before. Checksums of old packets are not kept: an old
// packet counts as the same.
bool Member::repeats(const Packet& packet) const {
  const auto known = waiting_.find(packet.number);
  if (known != waiting_.end()) return known->second.checksum == packet.checksum;
  return next_ - packet.number > kept_ || checksums_[packet.number % kChecksums] == packet.checksum;
}

// Times rise with the numbers; a farewell has the time of the last step.
bool Member::fits_after(const Packet& packet, double time) const {
  return packet.kind == PacketKind::leave ? packet.time >= time : packet.time > time;
}
bool Member::fits_before(const Packet& packet, const Packet& later) const {
  return later.kind == PacketKind::leave ? packet.time <= later.time : packet.time < later.time;
}

// The packet and the last one that was refused for its time are neighbours: either of them makes the other credible.
bool Member::agrees_with_suspect(const Packet& packet, double max_jump) const {
  if (!suspect_ || suspect_->number == packet.number) return false;
  const double since = packet.number > suspect_->number ? packet.time - suspect_->time : suspect_->time - packet.time;
  return since > 0.0 && since <= max_jump;
}

void Member::forget_waiting_before(const Packet& packet) noexcept {
  for (auto entry = waiting_.begin(); entry != waiting_.end() && entry->first < packet.number;)
    entry = fits_after(packet, entry->second.time) ? std::next(entry) : waiting_.erase(entry);
}

// A clock that is wrong once must not lock the vehicle out. A packet that is far ahead of the one before it is refused,
// and so is one that is behind a packet that waits. If the next packet agrees with the refused one, they are right.
Arrival Member::judge_time(const Packet& packet, const WaitingLimits& limits) noexcept {
  const auto after = waiting_.upper_bound(packet.number);
  if (started_ && !fits_after(packet, time_)) return Arrival::past;
  if (after != waiting_.end() && !fits_before(packet, after->second)) return Arrival::past;

  const double* before = after != waiting_.begin() ? &std::prev(after)->second.time : nullptr;
  const bool behind = before != nullptr && !fits_after(packet, *before);
  if (before == nullptr) before = started_ ? &time_ : limits.newest;
  const bool ahead = after == waiting_.end() && before != nullptr && packet.time - *before > limits.max_jump;
  if ((behind || ahead) && !agrees_with_suspect(packet, limits.max_jump)) {
    suspect_ = Suspect{packet.number, packet.time};
    return behind ? Arrival::past : Arrival::ahead;
  }
  return Arrival::waiting;
}

Arrival Member::insert(Entry&& entry, const WaitingLimits& limits, bool& late) noexcept {
  const Packet& packet = entry.packet();
  const std::uint64_t number = packet.number;
  if (number < next_ || waiting_.count(number) != 0) return repeats(packet) ? Arrival::repeated : Arrival::conflict;
  const Arrival by_time = judge_time(packet, limits);
  if (by_time != Arrival::waiting) return by_time;
  // The packet that all others wait for always has room: it lets them have their turn.
  if (waiting_.size() >= limits.packets && number != next_) return Arrival::full;
  suspect_.reset();
  forget_waiting_before(packet);
  late = waiting_.upper_bound(number) != waiting_.end();
  append(std::move(entry));
  return Arrival::waiting;
}

void Member::append(Entry&& entry) noexcept {
  waiting_.insert(entry.one_.extract(entry.one_.begin()));
}

Packet Member::consume() noexcept {
  const auto first = waiting_.begin();
  Packet packet = std::move(first->second);
  waiting_.erase(first);
  checksums_[next_ % kChecksums] = packet.checksum;
  kept_ = std::min(kept_ + 1, kChecksums);
  ++next_;
  time_ = packet.time;
  started_ = true;
  left_ = packet.kind == PacketKind::leave;
  return packet;
}

void Member::skip_gap() {
  next_ = waiting_.begin()->first;
  kept_ = 0;
}

double Member::silent_since(double now) {
  if (!waited_from_) waited_from_ = now;
  return started_ ? time_ : *waited_from_;
}

}  // namespace cairn
