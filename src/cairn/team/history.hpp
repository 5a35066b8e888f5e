// SPDX-License-Identifier: BSD-3-Clause
// The last packets that this vehicle sent, kept for teammates that miss some of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace cairn {

using Bytes = std::shared_ptr<const std::vector<std::uint8_t>>;

class History {
 public:
  static constexpr std::size_t kMostResent =
      64;  // in answer to one request, so that an answer does not flood the radio

  struct Sent {
    Bytes bytes;
    bool waits = true;  // it is in the outbox
  };
  // A packet that is not kept yet. Only its creation allocates.
  class Entry {
   public:
    Entry(std::uint64_t number, Bytes bytes) { one_.emplace(number, Sent{std::move(bytes), true}); }

   private:
    friend class History;
    std::map<std::uint64_t, Sent> one_;
  };

  explicit History(std::size_t capacity) : capacity_(capacity) {}

  // Beyond the capacity the packet with the lowest number is dropped. Never throws.
  void keep(Entry&& entry) noexcept;
  // Whether the packet with this number was sent with exactly these bytes.
  bool holds(std::uint64_t number, const std::uint8_t* bytes, std::size_t size) const;
  // The packet left the outbox. Never throws.
  void taken(std::uint64_t number) noexcept;
  // Visits the kept packets among `count` numbers from `first` on (count 0: all from there) that do not wait in the
  // outbox, 64 at most.
  template <class Function>
  void for_each_absent(std::uint64_t first, std::uint64_t count, Function&& function) {
    std::size_t visited = 0;
    for (auto entry = sent_.lower_bound(first); entry != sent_.end() && visited < kMostResent; ++entry) {
      if (count != 0 && entry->first - first >= count) return;
      if (entry->second.waits) continue;
      ++visited;
      function(entry->first, entry->second);
    }
  }

 private:
  std::size_t capacity_;
  std::map<std::uint64_t, Sent> sent_;  // by number
};

}  // namespace cairn
