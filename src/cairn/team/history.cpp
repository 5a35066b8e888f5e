// SPDX-License-Identifier: BSD-3-Clause
#include "team/history.hpp"

#include <algorithm>

namespace cairn {
namespace {

constexpr std::size_t kMostResent = 64;  // in answer to one request, so that an answer does not flood the radio

}  // namespace

void History::keep(std::uint64_t number, const std::vector<std::uint8_t>& bytes) {
  sent_[number] = bytes;
  if (sent_.size() > capacity_) sent_.erase(sent_.begin());
}

bool History::holds(std::uint64_t number, const std::uint8_t* bytes, std::size_t size) const {
  const auto sent = sent_.find(number);
  return sent != sent_.end() && std::equal(sent->second.begin(), sent->second.end(), bytes, bytes + size);
}

std::vector<const std::vector<std::uint8_t>*> History::range(std::uint64_t first, std::uint64_t count) const {
  const std::size_t most = count == 0 ? kMostResent : std::min<std::size_t>(count, kMostResent);
  std::vector<const std::vector<std::uint8_t>*> packets;
  for (auto entry = sent_.lower_bound(first); entry != sent_.end() && packets.size() < most; ++entry) {
    if (count != 0 && entry->first - first >= count) break;
    packets.push_back(&entry->second);
  }
  return packets;
}

}  // namespace cairn
