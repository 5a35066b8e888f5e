// SPDX-License-Identifier: BSD-3-Clause
#include "map/join/sparse/elimination_front.hpp"

#include "geometry/se2.hpp"
#include "geometry/se3.hpp"

namespace cairn {

template <class Pose>
std::vector<Index> state_map(const std::vector<Variable>& part, const TreeFront& front) {
  std::vector<Index> map;
  map.reserve(part.size() * 3);
  const auto add = [&](Variable v, Index at) {
    for (Index d = 0; d < dimension<Pose>(v); ++d) map.push_back(at + d);
  };
  const std::vector<Variable>&first = front.eliminated, &second = front.boundary;
  if (front.bit == TreeFront::kCrown) {
    for (const Variable v : part) {
      Index at = 0;
      for (std::size_t i = 0; first[i] != v; ++i) at += dimension<Pose>(first[i]);
      add(v, at);
    }
    return map;
  }
  std::size_t i = 0, j = 0;  // all three lists are ascending
  Index at_i = 0, at_j = front.e;
  for (const Variable v : part) {
    while (i < first.size() && first[i] < v) at_i += dimension<Pose>(first[i++]);
    while (j < second.size() && second[j] < v) at_j += dimension<Pose>(second[j++]);
    add(v, i < first.size() && first[i] == v ? at_i : at_j);
  }
  return map;
}

std::size_t memory_bytes(const TreeFront& front) {
  std::size_t bytes = sizeof front + sizeof(double) * (front.factor.capacity() + front.complement.capacity()) +
                      4 * (front.eliminated.capacity() + front.boundary.capacity() + front.held.capacity());
  for (const auto& child : front.child)
    if (child != nullptr) bytes += memory_bytes(*child);
  return bytes;
}

template std::vector<Index> state_map<SE2>(const std::vector<Variable>&, const TreeFront&);
template std::vector<Index> state_map<SE3>(const std::vector<Variable>&, const TreeFront&);

}  // namespace cairn
