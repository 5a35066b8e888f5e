// SPDX-License-Identifier: BSD-3-Clause
#include "team/outbox.hpp"

#include <algorithm>

namespace cairn {

Outbox::Outbox(std::size_t max_vehicles) : requests_(max_vehicles) {
  for (Request& request : requests_) request.bytes.reserve(kRequestSize);
}

void Outbox::make_room(std::size_t packets) {
  if (first_ > queue_.size() / 2) {
    queue_.erase(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(first_));
    first_ = 0;
  }
  const std::size_t needed = queue_.size() + packets;
  if (needed > queue_.capacity()) queue_.reserve(std::max(needed, 2 * queue_.capacity()));
}

bool Outbox::request(const Packet& request) noexcept {
  std::size_t place = 0;
  while (place < requested_ && requests_[place].vehicle != request.subject) ++place;
  const bool fresh = place == requested_;
  requested_ += fresh;
  requests_[place].vehicle = request.subject;
  encode(request, requests_[place].bytes);
  return fresh;
}

void Outbox::forget_request(std::uint64_t vehicle) noexcept {
  for (std::size_t place = 0; place < requested_; ++place)
    if (requests_[place].vehicle == vehicle) return drop_request(place);
}

const std::vector<std::uint8_t>* Outbox::next() const {
  if (first_ < queue_.size()) return queue_[first_].bytes.get();
  return requested_ > 0 ? &requests_.front().bytes : nullptr;
}

void Outbox::drop(History& history) noexcept {
  if (first_ == queue_.size()) return drop_request(0);
  history.taken(queue_[first_].number);
  queue_[first_++].bytes.reset();
  if (first_ < queue_.size()) return;
  queue_.clear();
  first_ = 0;
}

void Outbox::drop_request(std::size_t place) noexcept {
  const auto at = requests_.begin() + static_cast<std::ptrdiff_t>(place);
  std::rotate(at, at + 1, requests_.begin() + static_cast<std::ptrdiff_t>(requested_));
  --requested_;
}

}  // namespace cairn
