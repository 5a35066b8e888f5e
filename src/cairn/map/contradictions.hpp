// SPDX-License-Identifier: BSD-3-Clause
// What becomes of the landmarks of a submap that contradict the map, in both joinings (docs/update.md, "A landmark that
// was placed wrongly").
#pragma once

#include <vector>

#include "core/chi_square.hpp"
#include "map/landmarks.hpp"
#include "map/refusals.hpp"

namespace cairn {

// What becomes of a landmark of a submap whose id the map knows.
enum class Fusing : char {
  fuse,
  leave_out,   // it contradicts the map
  supersede,   // it contradicts a young landmark of the map, and more observations support it: it takes its id
  remove_both  // it contradicts a young landmark of the map, and nothing says which of them is wrong
};

class Contradictions {
 public:
  explicit Contradictions(int dimension) : gross_(chi_square_quantile(dimension, 1.0 - kGrossChance)) {}

  // Hears each refusal of gate_blocks(), with the landmark's number in the submap.
  void add(Gate gate, Index landmark, double distance, double bound) {
    refused_.push_back({landmark, gate == Gate::single && distance > gross_});
    refusals_.add(gate, distance, bound);
  }
  double worst() const { return refusals_.worst(); }

  // For each landmark of the submap; `known` of them are in the map. The landmark was observed in_map(i) times there
  // and in_submap[i] times in the submap.
  template <class InMap>
  std::vector<Fusing> decide(Index known, InMap&& in_map, const std::vector<std::uint64_t>& in_submap) const {
    // Where most landmarks contradict, the pose of the submap may be what is wrong. A landmark that was seen once says
    // nothing about it.
    Index against = 0;
    for (const auto& [i, gross] : refused_)
      against += in_map(i) > 1 && in_submap[static_cast<std::size_t>(i)] > 1 ? 1 : 0;
    const bool agrees = known - static_cast<Index>(refused_.size()) > against;
    std::vector<Fusing> fusing(in_submap.size(), Fusing::fuse);
    for (const auto& [i, gross] : refused_) {
      const auto at = static_cast<std::size_t>(i);
      fusing[at] = agrees ? weigh(in_map(i), in_submap[at], gross) : Fusing::leave_out;
    }
    return fusing;
  }

 private:
  struct Refused {
    Index landmark;
    bool gross;
  };

  // A landmark that was placed wrongly contradicts every later submap.
  static Fusing weigh(std::uint64_t in_map, std::uint64_t in_submap, bool gross) {
    if (in_map >= kGrownUp || in_submap < in_map) return Fusing::leave_out;
    if (in_submap > in_map) return Fusing::supersede;
    return gross ? Fusing::remove_both : Fusing::leave_out;
  }

  double gross_;
  std::vector<Refused> refused_;
  Refusals refusals_;
};

}  // namespace cairn
