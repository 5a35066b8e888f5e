// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/paired_points.hpp"

namespace cairn {

Eigen::Map<const Eigen::MatrixXd> PointsCovariance::matrix(std::size_t count) const {
  return {full.data(), row_of_point(count), row_of_point(count)};
}

PairedPoints select_pairs(const PairedPoints& pairs, const std::vector<std::size_t>& which) {
  PairedPoints selected;
  const auto select = [&](const PointsCovariance& from, PointsCovariance& to) {
    if (from.full.empty()) {
      for (std::size_t i : which) to.blocks.push_back(from.blocks[i]);
      return;
    }
    const auto all = from.matrix(pairs.size());
    to.full.resize(9 * which.size() * which.size());
    Eigen::Map<Eigen::MatrixXd> part(to.full.data(), row_of_point(which.size()), row_of_point(which.size()));
    for (std::size_t j = 0; j < which.size(); ++j)
      for (std::size_t i = 0; i < which.size(); ++i)
        part.block<3, 3>(row_of_point(i), row_of_point(j)) =
            all.block<3, 3>(row_of_point(which[i]), row_of_point(which[j]));
  };
  for (std::size_t i : which) {
    selected.a.push_back(pairs.a[i]);
    selected.b.push_back(pairs.b[i]);
  }
  select(pairs.covariance_a, selected.covariance_a);
  select(pairs.covariance_b, selected.covariance_b);
  return selected;
}

}  // namespace cairn
