// SPDX-License-Identifier: BSD-3-Clause
// Names of slots under random changes, against a plain list of names for each of the three parts.
#include "slam/landmark_table.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "numerical.hpp"

using namespace cairn;
using namespace cairn::test;

namespace {

constexpr Index kSlots = 24, kLandmarks = 20;

// The expected content of a table, in any order within a part.
struct Names {
  std::vector<std::uint64_t> companions, counting, deferred;
};

void check(const LandmarkTable& table, const Names& names) {
  REQUIRE(table.companions() == static_cast<Index>(names.companions.size()));
  REQUIRE(table.counting() == static_cast<Index>(names.counting.size()));
  REQUIRE(table.deferred() == static_cast<Index>(names.deferred.size()));
  const auto part = [&](Index from, Index to) {
    std::vector<std::uint64_t> ids;
    for (Index slot = from; slot < to; ++slot) ids.push_back(table.id(slot));
    std::sort(ids.begin(), ids.end());
    return ids;
  };
  const auto sorted = [](std::vector<std::uint64_t> ids) {
    std::sort(ids.begin(), ids.end());
    return ids;
  };
  CHECK(part(0, table.companions()) == sorted(names.companions));
  CHECK(part(table.companions(), table.first_deferred()) == sorted(names.counting));
  CHECK(part(table.first_deferred(), table.size()) == sorted(names.deferred));
  for (Index slot = table.companions(); slot < table.size(); ++slot) {
    REQUIRE(table.find(table.id(slot)).has_value());
    CHECK(*table.find(table.id(slot)) == slot);
    CHECK(table.observations(slot) == table.id(slot));  // travels with the name, see add()
  }
}

void erase(std::vector<std::uint64_t>& ids, std::uint64_t id) {
  ids.erase(std::find(ids.begin(), ids.end(), id));
}

std::size_t arena_bytes() {
  Arena measure;
  const LandmarkTable unused(measure, kSlots, kLandmarks);
  return measure.used();
}

}  // namespace

TEST_CASE("landmark table: slots stay in three parts, and names stay with what belongs to them") {
  Arena arena(arena_bytes());
  LandmarkTable table(arena, kSlots, kLandmarks);
  Names names;
  Random random(5);
  std::uint64_t next = 1;
  // The same order of calls as in LocalMap, which exchanges the values of the state in the same places.
  for (int step = 0; step < 3000; ++step) {
    const double kind = random.uniform(0, 1);
    if (kind < 0.45 && table.landmarks() < kLandmarks) {
      // A landmark that counts is added only while no landmark is deferred: otherwise it would stand behind the
      // deferred ones.
      const bool deferred = table.deferred() > 0 || random.uniform(0, 1) < 0.5;
      table.append(next, deferred);
      table.add_observations(table.size() - 1, next - 1);
      (deferred ? names.deferred : names.counting).push_back(next++);
    } else if (kind < 0.6 && table.deferred() > 0) {
      const Index slot = table.first_deferred() + static_cast<Index>(random.uniform(0, 1) * table.deferred());
      const std::uint64_t id = table.id(slot);
      if (slot != table.first_deferred()) table.exchange(slot, table.first_deferred());
      table.count_first_deferred();
      erase(names.deferred, id);
      names.counting.push_back(id);
    } else if (kind < 0.8 && table.landmarks() > 0) {
      Index slot = table.companions() + static_cast<Index>(random.uniform(0, 1) * table.landmarks());
      const std::uint64_t id = table.id(slot);
      erase(table.counts(slot) ? names.counting : names.deferred, id);
      if (table.counts(slot)) {
        if (slot != table.first_deferred() - 1) table.exchange(slot, table.first_deferred() - 1);
        slot = table.first_deferred() - 1;
      }
      table.remove(slot);
      CHECK(!table.find(id));
    } else if (kind < 0.9 && table.companions() < kSlots - kLandmarks) {
      table.add_companion(next);
      if (table.deferred() > 0 && table.counting() > 0 && table.size() != table.first_deferred())
        table.exchange(table.size() - 1, table.first_deferred() - 1);
      names.companions.push_back(next++);
    } else if (table.companions() > 0) {
      const Index k = static_cast<Index>(random.uniform(0, 1) * table.companions());
      erase(names.companions, table.id(k));
      table.remove_companion(k);
      if (table.deferred() > 0 && table.companions() != table.first_deferred())
        table.exchange(table.companions(), table.first_deferred());
    }
    check(table, names);
  }
}

TEST_CASE("landmark table: the vehicle looked from changes places with a companion") {
  Arena arena(arena_bytes());
  LandmarkTable table(arena, kSlots, kLandmarks);
  table.name_vehicle(7);
  table.add_companion(8);
  table.append(7, false);  // a landmark may have a vehicle's name
  table.look_from(*table.find_companion(8));
  CHECK(table.vehicle() == 8);
  REQUIRE(table.find_companion(7).has_value());
  CHECK(*table.find_companion(7) == 0);
  CHECK(!table.find_companion(8));
  CHECK(*table.find(7) == 1);
}

TEST_CASE("landmark table: a cleared table knows no name") {
  Arena arena(arena_bytes());
  LandmarkTable table(arena, kSlots, kLandmarks);
  table.append(3, true);
  table.next_frame();
  table.clear();
  CHECK(table.size() == 0);
  CHECK(table.deferred() == 0);
  CHECK(!table.find(3));
  table.append(3, false);
  CHECK(table.sightings(0).placed == 1);  // the number of the frame goes on
}
