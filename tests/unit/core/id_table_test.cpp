// SPDX-License-Identifier: BSD-3-Clause
// The hash table from ids to slots.
#include "core/id_table.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <unordered_map>
#include <vector>

using namespace cairn;

namespace {

struct Table {
  explicit Table(std::size_t capacity) : arena(bytes(capacity)), table(arena, capacity) {}
  static std::size_t bytes(std::size_t capacity) {
    Arena measure;
    const IdTable unused(measure, capacity);
    return measure.used();
  }
  Arena arena;
  IdTable table;
};

bool same(const IdTable& table, const std::unordered_map<std::uint64_t, std::int32_t>& expected,
          const std::vector<std::uint64_t>& ids) {
  for (std::uint64_t id : ids) {
    const auto at = expected.find(id);
    if (table.find(id) != (at == expected.end() ? IdTable::kAbsent : at->second)) return false;
  }
  return true;
}

// Random insertions, changes and removals of `ids`, never more than `capacity` ids at once.
void live(std::size_t capacity, const std::vector<std::uint64_t>& ids, int operations, unsigned seed) {
  CAPTURE(capacity);
  Table owner(capacity);
  IdTable& table = owner.table;
  std::unordered_map<std::uint64_t, std::int32_t> expected;
  std::mt19937_64 random(seed);
  std::size_t fullest = 0;
  for (int i = 0; i < operations; ++i) {
    const std::uint64_t id = ids[random() % ids.size()];
    const bool wanted = random() % 100 < 80;
    if (wanted && (expected.count(id) == 1 || expected.size() < capacity)) {
      const std::int32_t slot = static_cast<std::int32_t>(random() % 100000);
      table.set(id, slot);
      expected[id] = slot;
    } else {
      table.erase(id);  // also of an id that is absent
      expected.erase(id);
    }
    fullest = std::max(fullest, expected.size());
    if (i % 16 == 0 || ids.size() < 20) REQUIRE(same(table, expected, ids));
  }
  CHECK(same(table, expected, ids));
  CHECK(fullest == capacity);
  table.clear();
  CHECK(same(table, {}, ids));
}

}  // namespace

TEST_CASE("id table: equals std::unordered_map") {
  const std::uint64_t largest = UINT64_MAX;
  for (std::size_t capacity : {1, 2, 3, 7, 8, 50, 512}) {
    std::vector<std::uint64_t> small, wild;
    std::mt19937_64 random(5);
    for (std::size_t i = 0; i < capacity + capacity / 2 + 1; ++i) {
      small.push_back(i);  // neighbouring ids, 0 among them
      wild.push_back(i == 0 ? largest : random());
    }
    live(capacity, small, 4000, 1);
    live(capacity, wild, 4000, 2);
  }
}

TEST_CASE("id table: full of ids that hash to one place") {
  // Picks ids that a table with one id puts at the same place as the first id, so that clusters run around the end.
  for (unsigned seed : {1, 2, 3, 4}) {
    std::mt19937_64 random(seed);
    const std::uint64_t first = random();
    const auto home = [](std::uint64_t id) {  // for a table of 16 entries: the finaliser of MurmurHash3, as published
      id = (id ^ (id >> 33)) * 0xff51afd7ed558ccdULL;
      id = (id ^ (id >> 33)) * 0xc4ceb9fe1a85ec53ULL;
      return (id ^ (id >> 33)) % 16;
    };
    std::vector<std::uint64_t> ids;
    while (ids.size() < 12) {
      const std::uint64_t id = random();
      if (home(id) == home(first) || (ids.size() % 3 == 2 && home(id) == (home(first) + 1) % 16)) ids.push_back(id);
    }
    live(8, ids, 20000, seed);
  }
}

TEST_CASE("id table: erasing keeps the entries behind") {
  Table owner(4);
  for (std::uint64_t id = 0; id < 4; ++id) owner.table.set(id, static_cast<std::int32_t>(10 + id));
  owner.table.erase(2);
  CHECK(owner.table.find(2) == IdTable::kAbsent);
  for (std::uint64_t id : {0u, 1u, 3u}) CHECK(owner.table.find(id) == static_cast<std::int32_t>(10 + id));
  owner.table.set(0, 5);
  CHECK(owner.table.find(0) == 5);
}
