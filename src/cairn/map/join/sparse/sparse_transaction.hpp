// SPDX-License-Identifier: BSD-3-Clause
// A transaction of a sparse map: a submap joins, a fix is applied.
#pragma once

#include <optional>

#include "map/join/sparse/sparse_change.hpp"
#include "map/join/sparse/sparse_gate.hpp"

namespace cairn {

template <class Pose>
class SparseTransaction final : public MapTransaction<Pose> {
 public:
  SparseTransaction(SparseState<Pose>& state, SpatialIndex& index);

  // Two tries: the first one fuses all known landmarks. If some landmark may not fit, the second one fuses only the
  // landmarks that pass the exact gates.
  JoinReport join(const Submap<Pose>& submap) override;
  FixReport fix(const AbsoluteFix<Pose>& fix, double threshold) override;
  JoinReport commit() override;

 private:
  using State = SparseState<Pose>;
  using Number = typename State::Number;
  static constexpr int kDim = Pose::kDim, kDof = Pose::kDof;
  using PointSquare = typename Pose::Rotation::Matrix;

  Number try_join(const Submap<Pose>& submap, const std::vector<Fusing>& fusing);
  Number append(const Submap<Pose>& submap, const std::vector<Fusing>& fusing);
  void add_landmarks(const Submap<Pose>& submap, const std::vector<Fusing>& fusing, Number leaf, const Pose& base,
                     TreeChanges& changes, std::vector<Number>& reshaped);
  void hold_errors(Number leaf);
  void set_error_degree(Number point);
  void set_scales(const Submap<Pose>& submap, const SubmapData<Pose>& data);
  void fix_prior(const Eigen::VectorXd& r, const Eigen::MatrixXd& J, const Eigen::MatrixXd& S,
                 const Eigen::MatrixXd& R);

  State& state_;
  SpatialIndex& index_;
  std::optional<SparseChange<Pose>> change_;
  JoinReport report_;
  bool solved_ = false;  // whether the problem was solved anew, so that dependent values must be computed
};

extern template class SparseTransaction<SE2>;
extern template class SparseTransaction<SE3>;

}  // namespace cairn
