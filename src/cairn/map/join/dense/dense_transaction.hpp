// SPDX-License-Identifier: BSD-3-Clause
// One change of a dense map: a submap is gated, fused and composed, and the new base may get a fix. A change that is
// not committed is taken back.
#pragma once

#include <optional>

#include "ekf/ekf_update.hpp"
#include "map/contradictions.hpp"
#include "map/join/dense/dense_map.hpp"

namespace cairn {

template <class Pose>
class DenseTransaction final : public MapTransaction<Pose> {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Point = typename Pose::Point;
  using Rotation = typename Pose::Rotation;

  explicit DenseTransaction(DenseMap<Pose>& map) : map_(map) {}
  ~DenseTransaction() override;

  JoinReport join(const Submap<Pose>& submap) override;
  FixReport fix(const AbsoluteFix<Pose>& fix, double threshold) override;
  JoinReport commit() override;

 private:
  // A landmark of the submap that the map knows.
  struct Pair {
    Eigen::Index local;  // in the submap
    Index slot;          // in the map
  };
  class FusingUpdate;

  // A submap given the systematic errors and the error of its base, with the errors of the map's landmarks ordinary.
  GivenErrors split_errors(const Submap<Pose>& submap) const;
  void learn_errors(const Submap<Pose>& submap);
  void give_way(const Submap<Pose>& submap, const std::vector<Fusing>& fusing);
  typename State<Pose>::Handover split_rest(const Submap<Pose>& submap, const GivenErrors& given) const;
  void hand_over(const Submap<Pose>& submap, typename State<Pose>::Handover& handover, const Eigen::VectorXd& shift);

  DenseMap<Pose>& map_;
  std::optional<typename State<Pose>::Backup> backup_;  // the old values of the changed parts of the map
  std::vector<Pair> pairs_;                             // that passed the gates
  std::vector<Eigen::Index> fresh_;                     // landmarks of the submap that the map does not know
  std::vector<std::uint64_t> fresh_ids_, fresh_counts_, pair_counts_;
  std::vector<std::size_t> wrong_;  // landmarks of the map that give way, in rising order
  std::vector<Point> before_;       // the old positions of the map's landmarks
  std::optional<typename DenseMap<Pose>::Closed> closed_;
  JoinReport report_;
};

extern template class DenseTransaction<SE2>;
extern template class DenseTransaction<SE3>;

}  // namespace cairn
