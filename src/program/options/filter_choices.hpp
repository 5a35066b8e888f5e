// SPDX-License-Identifier: BSD-3-Clause
// How the command line wants the filter.
#pragma once

#include <cairn/cairn.h>

#include <cstdint>
#include <optional>

namespace cairn::program {

constexpr std::uint32_t kUsualSubmap = 60;  // landmarks

// What is not set stays as the library has it.
struct FilterChoices {
  std::int32_t error = CAIRN_ERROR_INVARIANT;
  std::optional<std::uint32_t> submap_landmarks;  // 0: a single map
  double submap_distance = 0;                     // m; 0: no matter
  double submap_extent = 0;                       // m; 0: no matter
  double submap_sigma = 0;                        // m; 0: no matter
  std::int32_t join = CAIRN_JOIN_AUTO;
  std::int32_t association = CAIRN_ASSOCIATION_KNOWN;
  std::int32_t association_distance = CAIRN_DISTANCE_MAHALANOBIS;
  std::optional<std::uint32_t> deferred_sightings, deferred_frames;
  std::uint64_t forget_after = 0;  // frames; 0: never
  std::optional<double> error_persistence;
  std::optional<double> gate;
  std::optional<double> batch_gate;
  std::optional<std::uint32_t> iterations;
  std::optional<std::uint32_t> max_landmarks;

  // But for what the drive has a say in: capacities and submaps.
  void apply(cairn_filter_options& options) const {
    options.error = error;
    options.iterations = iterations.value_or(options.iterations);
    options.gate_probability = gate.value_or(options.gate_probability);
    options.batch_gate_probability = batch_gate.value_or(options.batch_gate_probability);
    options.error_persistence = error_persistence.value_or(options.error_persistence);
    options.association = association;
    options.association_distance = association_distance;
    options.deferred_sightings = deferred_sightings.value_or(options.deferred_sightings);
    options.deferred_frames = deferred_frames.value_or(options.deferred_frames);
  }
  bool names_known() const { return association == CAIRN_ASSOCIATION_KNOWN; }
};

}  // namespace cairn::program
