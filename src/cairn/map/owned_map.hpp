// SPDX-License-Identifier: BSD-3-Clause
// A map that belongs to no filter, dense or sparse. It also holds the numbers of the filters that made its landmarks.
#pragma once

#include <memory>
#include <vector>

#include "map/merge/merge.hpp"

namespace cairn {

struct OwnedMap {
  // Copies the landmarks; `origins_of_source` are the numbers of the filters that made them.
  OwnedMap(const Landmarks& source, std::vector<std::uint64_t> origins_of_source);
  // Merges two maps, in the frame of `map`. Throws if they cannot be merged; maps of the plane never can. `report` then
  // says how far the merge got.
  OwnedMap(const OwnedMap& map, const Landmarks& other, const std::vector<std::uint64_t>& origins_of_other,
           const MergeOptions& options, MergeReport& report);

  std::unique_ptr<const Landmarks> landmarks;
  std::vector<std::uint64_t> origins;  // ascending
  std::vector<MergedId> merged;        // of the last merge
};

}  // namespace cairn
