// SPDX-License-Identifier: BSD-3-Clause
// The last packets that this vehicle sent, kept for teammates that miss some of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace cairn {

class History {
 public:
  explicit History(std::size_t capacity) : capacity_(capacity) {}

  // Beyond the capacity the packet with the lowest number is dropped.
  void keep(std::uint64_t number, const std::vector<std::uint8_t>& bytes);
  // Whether the packet with this number was sent with exactly these bytes.
  bool holds(std::uint64_t number, const std::uint8_t* bytes, std::size_t size) const;
  // The kept packets among `count` numbers from `first` on (count 0: all from there), 64 at most. The pointers are
  // valid until the next packet is kept.
  std::vector<const std::vector<std::uint8_t>*> range(std::uint64_t first, std::uint64_t count) const;

 private:
  std::size_t capacity_;
  std::map<std::uint64_t, std::vector<std::uint8_t>> sent_;  // by number
};

}  // namespace cairn
