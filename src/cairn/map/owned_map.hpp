// SPDX-License-Identifier: BSD-3-Clause
// A map that belongs to no filter: dense or sparse, and the filters whose landmarks it holds.
#pragma once

#include <memory>
#include <vector>

#include "map/merge/merge.hpp"

namespace cairn {

struct OwnedMap {
  // Copies the landmarks; `origins` are the filters that made them.
  OwnedMap(const Landmarks& source, std::vector<std::uint64_t> origins_of_source);
  // Merges two maps, in the frame of `map`. Throws if they cannot be merged; planar maps never can. `report` then
  // contains the results up to the failure.
  OwnedMap(const OwnedMap& map, const Landmarks& other, const std::vector<std::uint64_t>& origins_of_other,
           const MergeOptions& options, MergeReport& report);

  std::unique_ptr<const Landmarks> landmarks;
  std::vector<std::uint64_t> origins;  // ascending
  std::vector<MergedId> merged;        // of the last merge
};

}  // namespace cairn
