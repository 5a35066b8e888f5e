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

  // For each of the submap's `size` landmarks, of which `known` are in the map. `in_map(i)` and `in_submap(i)` are the
  // observations of landmark i.
  template <class InMap, class InSubmap>
  std::vector<Fusing> decide(Index size, Index known, InMap&& in_map, InSubmap&& in_submap) const {
    // Where most landmarks contradict, the pose of the submap may be what is wrong. A landmark that was seen once says
    // nothing about it.
    Index against = 0;
    for (const Refused& refused : refused_)
      against += in_map(refused.landmark) > 1 && in_submap(refused.landmark) > 1 ? 1 : 0;
    const bool agrees = known - static_cast<Index>(refused_.size()) > against;
    std::vector<Fusing> fusing(static_cast<std::size_t>(size), Fusing::fuse);
    for (const auto& [i, gross] : refused_)
      fusing[static_cast<std::size_t>(i)] = agrees ? weigh(in_map(i), in_submap(i), gross) : Fusing::leave_out;
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
