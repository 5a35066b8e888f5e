// SPDX-License-Identifier: BSD-3-Clause
#include "team/history.hpp"

#include <algorithm>

namespace cairn {

void History::keep(Entry&& entry) noexcept {
  sent_.insert(entry.one_.extract(entry.one_.begin()));
  if (sent_.size() > capacity_) sent_.erase(sent_.begin());
}

bool History::holds(std::uint64_t number, const std::uint8_t* bytes, std::size_t size) const {
  const auto sent = sent_.find(number);
  if (sent == sent_.end()) return false;
  const std::vector<std::uint8_t>& own = *sent->second.bytes;
  return std::equal(own.begin(), own.end(), bytes, bytes + size);
}

void History::taken(std::uint64_t number) noexcept {
  const auto sent = sent_.find(number);
  if (sent != sent_.end()) sent->second.waits = false;
}

}  // namespace cairn
