// SPDX-License-Identifier: BSD-3-Clause
// The names of a filter's points: which landmark or companion is in which slot, and how often it was seen.
//
// The slots are in three parts: companions, landmarks that count, deferred landmarks. A deferred landmark does not
// count yet, because it was not observed often enough. The table moves names only; LocalMap moves the values of the
// state in step.
#pragma once

#include <cstdint>
#include <optional>

#include "core/arena.hpp"
#include "core/id_table.hpp"
#include "linear/small_algebra.hpp"

namespace cairn {

class LandmarkTable {
 public:
  struct Sightings {             // of a landmark, by frames
    std::uint64_t placed, seen;  // numbers of frames
    Index missed;                // frames in a row
    bool in_view;                // LandmarkReview::prepare() has found it in the view
    std::uint64_t elsewhere;     // observations that agree on another place, if the landmark is contested
  };

  LandmarkTable(Arena& arena, Index slots, Index landmarks);

  // --- the parts ---
  Index size() const { return size_; }  // slots in use
  Index companions() const { return companions_; }
  Index landmarks() const { return size_ - companions_; }
  Index deferred() const { return deferred_; }
  Index counting() const { return landmarks() - deferred_; }
  Index first_deferred() const { return size_ - deferred_; }
  bool counts(Index slot) const { return slot < first_deferred(); }

  // --- names ---
  std::optional<Index> find(std::uint64_t id) const;            // slot of a landmark
  std::optional<Index> find_companion(std::uint64_t id) const;  // its number, which is its slot
  std::uint64_t id(Index slot) const { return ids_[slot]; }
  std::uint64_t vehicle() const { return vehicle_; }  // the active vehicle
  void name_vehicle(std::uint64_t id) { vehicle_ = id; }

  // --- sightings ---
  std::uint64_t observations(Index slot) const { return counts_[slot]; }
  void add_observations(Index slot, std::uint64_t count) { counts_[slot] += count; }
  Sightings& sightings(Index slot) { return sightings_[slot]; }
  std::uint64_t frame() const { return frames_; }  // number of the last frame
  void next_frame() { ++frames_; }

  // --- slots --- for LocalMap, which moves the state's values in step
  void clear();
  void append(std::uint64_t id, bool deferred);  // observed once
  // The last landmark moves there. Among the landmarks that count, only the last one may go.
  void remove(Index slot);
  void exchange(Index a, Index b);
  void count_first_deferred() { --deferred_; }
  void defer_last_counting() { ++deferred_; }
  void add_companion(std::uint64_t id);  // the first landmark moves behind the last one
  void remove_companion(Index number);   // the last companion gets the number, the last landmark becomes the first one
  void look_from(Index companion);       // the companion and the active vehicle change places

 private:
  void move(Index from, Index to);

  IdTable slots_;
  std::uint64_t* ids_;  // by slot: those of companions are of vehicles
  std::uint64_t* counts_;
  Sightings* sightings_;
  Index size_ = 0, companions_ = 0, deferred_ = 0;
  std::uint64_t frames_ = 0;
  std::uint64_t vehicle_ = 0;
};

}  // namespace cairn
