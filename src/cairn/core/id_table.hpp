// SPDX-License-Identifier: BSD-3-Clause
// Hash table from landmark ids to slots: open addressing with linear probing in a fixed block. It never allocates and
// never rehashes after construction. The same operations in the same order give the same table.
#pragma once

#include <cstdint>

#include "core/arena.hpp"

namespace cairn {

class IdTable {
 public:
  static constexpr std::int32_t kAbsent = -1;

  IdTable(Arena& arena, std::size_t capacity) {
    std::size_t size = 4;
    while (size < 2 * capacity) size *= 2;
    mask_ = size - 1;
    ids_ = arena.take<std::uint64_t>(size);
    slots_ = arena.take<std::int32_t>(size);
    if (!arena.measuring()) clear();
  }

  void clear() {
    for (std::size_t i = 0; i <= mask_; ++i) slots_[i] = kAbsent;
  }

  std::int32_t find(std::uint64_t id) const {
    for (std::size_t i = home(id); slots_[i] != kAbsent; i = (i + 1) & mask_)
      if (ids_[i] == id) return slots_[i];
    return kAbsent;
  }

  // Inserts an id, or changes the slot of an id.
  void set(std::uint64_t id, std::int32_t slot) {
    std::size_t i = home(id);
    while (slots_[i] != kAbsent && ids_[i] != id) i = (i + 1) & mask_;
    ids_[i] = id;
    slots_[i] = slot;
  }

  void erase(std::uint64_t id) {
    std::size_t hole = home(id);
    while (slots_[hole] != kAbsent && ids_[hole] != id) hole = (hole + 1) & mask_;
    if (slots_[hole] == kAbsent) return;
    // Close the gap: an entry moves into the hole unless its home lies behind the hole.
    for (std::size_t i = (hole + 1) & mask_; slots_[i] != kAbsent; i = (i + 1) & mask_) {
      if (((i - home(ids_[i])) & mask_) < ((i - hole) & mask_)) continue;
      ids_[hole] = ids_[i];
      slots_[hole] = slots_[i];
      hole = i;
    }
    slots_[hole] = kAbsent;
  }

 private:
  std::size_t home(std::uint64_t id) const {
    id ^= id >> 33;  // finaliser of MurmurHash3 spreads neighbouring ids over the table
    id *= 0xff51afd7ed558ccdULL;
    id ^= id >> 33;
    id *= 0xc4ceb9fe1a85ec53ULL;
    id ^= id >> 33;
    return static_cast<std::size_t>(id) & mask_;
  }

  std::uint64_t* ids_ = nullptr;
  std::int32_t* slots_ = nullptr;
  std::size_t mask_ = 0;
};

}  // namespace cairn
