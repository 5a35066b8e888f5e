// SPDX-License-Identifier: BSD-3-Clause
#include "team/member.hpp"

#include <iterator>
#include <utility>

namespace cairn {
namespace {

constexpr std::size_t kChecksumsKept = 256;

}  // namespace

// Whether the vehicle sent the same packet with this number before. Checksums of old packets are not kept: an old
// packet counts as the same.
bool Member::repeats(const Packet& packet) const {
  const auto known = waiting_.find(packet.number);
  if (known != waiting_.end()) return known->second.checksum == packet.checksum;
  const std::uint64_t age = next_ - packet.number;
  return age > last_checksums_.size() || last_checksums_[last_checksums_.size() - age] == packet.checksum;
}

// Times rise with the numbers; a farewell has the time of the last step.
bool Member::fits_in_time(const Packet& packet) const {
  const auto after = waiting_.upper_bound(packet.number);
  const bool data = packet.kind == PacketKind::data;
  bool ordered = !started_ || (data ? packet.time > time_ : packet.time >= time_);
  if (after != waiting_.begin()) {
    const double before = std::prev(after)->second.time;
    ordered = ordered && (data ? packet.time > before : packet.time >= before);
  }
  if (after != waiting_.end()) {
    const bool farewell = after->second.kind == PacketKind::leave;
    const double later = after->second.time;
    ordered = ordered && (farewell ? packet.time <= later : packet.time < later);
  }
  return ordered;
}

Arrival Member::insert(Packet&& packet, std::size_t capacity, bool& late) {
  const std::uint64_t number = packet.number;
  if (number < next_ || waiting_.count(number) != 0) return repeats(packet) ? Arrival::repeated : Arrival::conflict;
  if (!fits_in_time(packet)) return Arrival::past;
  if (waiting_.size() >= capacity) return Arrival::full;
  late = waiting_.upper_bound(number) != waiting_.end();
  append(std::move(packet));
  return Arrival::waiting;
}

void Member::append(Packet&& packet) {
  const std::uint64_t number = packet.number;
  waiting_[number] = std::move(packet);
}

Packet Member::consume() {
  const auto first = waiting_.begin();
  last_checksums_.push_back(first->second.checksum);
  if (last_checksums_.size() > kChecksumsKept) last_checksums_.pop_front();
  Packet packet = std::move(first->second);
  waiting_.erase(first);
  ++next_;
  time_ = packet.time;
  started_ = true;
  left_ = packet.kind == PacketKind::leave;
  return packet;
}

void Member::skip_gap() {
  next_ = waiting_.begin()->first;
  last_checksums_.clear();
}

double Member::silent_since(double now) {
  if (!waited_from_) waited_from_ = now;
  return started_ ? time_ : *waited_from_;
}

}  // namespace cairn
