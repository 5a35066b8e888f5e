// SPDX-License-Identifier: BSD-3-Clause
// Makes the fronts that an update of the elimination tree changes: assembles their matrices and factors them.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"
#include "map/join/sparse/elimination_front.hpp"
#include "map/join/sparse/elimination_visitors.hpp"

namespace cairn {

// The builder of one update. A touch names fronts that are made anew, down to its bit (included).
template <class Pose>
class EliminationBuilder {
 public:
  using TouchIterator = std::vector<TreeTouch>::const_iterator;
  static constexpr std::int16_t kNever = std::numeric_limits<std::int16_t>::max();  // of a variable: not eliminated

  // The number of leaves that hold each variable, the variable that is eliminated last, and the leaves that the tree
  // loses; the place where each variable is eliminated, which is updated; and the list to which the leaves are added
  // whose information was requested.
  EliminationBuilder(const LeafSource& source, const std::vector<std::int32_t>& degree, Variable last,
                     const std::vector<TreeKey>& removed, std::vector<std::int16_t>& eliminated_at,
                     std::vector<std::uint32_t>& assembled)
      : source_(source),
        degree_(degree),
        last_(last),
        removed_(removed),
        eliminated_at_(eliminated_at),
        assembled_(assembled) {}

  // The subtree of these touches, sorted by key, in place of the old one. Null if it lost all of its leaves, or if a
  // pivot failed.
  FrontPointer build(const FrontPointer& old, TouchIterator begin, TouchIterator end);
  // The front above the whole tree.
  FrontPointer crown(const FrontPointer& top);
  bool failed() const { return failed_; }  // a pivot was not positive
  std::size_t made() const { return made_; }

 private:
  bool loses(const TreeKey& key) const;
  FrontPointer leaf(const TreeKey& key);
  void request(const TreeFront& leaf);
  void assemble(const TreeFront& child, const TreeFront& front, Index n);
  FrontPointer make(int bit, const TreeKey& key, const FrontPointer child[2], int children);
  void sort_variables(TreeFront& front, int children);

  const LeafSource& source_;
  const std::vector<std::int32_t>& degree_;
  Variable last_;
  const std::vector<TreeKey>& removed_;
  std::vector<std::int16_t>& eliminated_at_;
  std::vector<std::uint32_t>& assembled_;
  std::vector<double> matrix_, leaf_, workspace_;
  std::size_t made_ = 0;
  bool failed_ = false;
};

extern template class EliminationBuilder<SE2>;
extern template class EliminationBuilder<SE3>;

}  // namespace cairn
