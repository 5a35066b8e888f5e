// SPDX-License-Identifier: BSD-3-Clause
// Names of landmarks and companions by slot, and slots by name.
#include "slam/landmark_table.hpp"

#include <utility>

namespace cairn {

LandmarkTable::LandmarkTable(Arena& arena, Index slots, Index landmarks)
    : slots_(arena, static_cast<std::size_t>(landmarks)),
      ids_(arena.take<std::uint64_t>(static_cast<std::size_t>(slots))),
      counts_(arena.take<std::uint64_t>(static_cast<std::size_t>(slots))),
      sightings_(arena.take<Sightings>(static_cast<std::size_t>(slots))) {}

std::optional<Index> LandmarkTable::find(std::uint64_t id) const {
  const std::int32_t slot = slots_.find(id);
  if (slot == IdTable::kAbsent) return std::nullopt;
  return slot;
}

std::optional<Index> LandmarkTable::find_companion(std::uint64_t id) const {
  for (Index k = 0; k < companions_; ++k)
    if (ids_[k] == id) return k;
  return std::nullopt;
}

void LandmarkTable::clear() {
  slots_.clear();
  size_ = companions_ = deferred_ = 0;
}

void LandmarkTable::move(Index from, Index to) {
  ids_[to] = ids_[from];
  counts_[to] = counts_[from];
  sightings_[to] = sightings_[from];
  slots_.set(ids_[to], static_cast<std::int32_t>(to));
}

void LandmarkTable::append(std::uint64_t id, bool deferred) {
  const Index slot = size_++;
  ids_[slot] = id;
  counts_[slot] = 1;
  sightings_[slot] = {frames_, frames_, 0, false, 0};
  slots_.set(id, static_cast<std::int32_t>(slot));
  if (deferred) ++deferred_;
}

void LandmarkTable::remove(Index slot) {
  if (!counts(slot)) --deferred_;
  const Index last = --size_;
  slots_.erase(ids_[slot]);
  if (slot != last) move(last, slot);
}

void LandmarkTable::exchange(Index a, Index b) {
  std::swap(ids_[a], ids_[b]);
  std::swap(counts_[a], counts_[b]);
  std::swap(sightings_[a], sightings_[b]);
  slots_.set(ids_[a], static_cast<std::int32_t>(a));
  slots_.set(ids_[b], static_cast<std::int32_t>(b));
}

void LandmarkTable::add_companion(std::uint64_t id) {
  const Index k = companions_++, last = size_++;
  if (last > k) move(k, last);
  ids_[k] = id;
  counts_[k] = 0;
}

void LandmarkTable::remove_companion(Index number) {
  const Index last = --companions_, end = --size_;
  ids_[number] = ids_[last];
  counts_[number] = counts_[last];
  if (end > last) move(end, last);
}

void LandmarkTable::look_from(Index companion) {
  std::swap(ids_[companion], vehicle_);
}

}  // namespace cairn
