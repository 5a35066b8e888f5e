// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/compatible_alignment.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "core/chi_square.hpp"
#include "map/merge/alignment_solver.hpp"
#include "map/merge/distance_falls.hpp"

namespace cairn {
namespace {

std::size_t worst_of(const std::vector<double>& falls) {
  return static_cast<std::size_t>(std::max_element(falls.begin(), falls.end()) - falls.begin());
}

// The bounds of a compatible set: of its joint distance, and of the fall of each pair.
struct Bounds {
  double probability, of_pair;
  bool kept(double distance, int dof, double worst_fall) const {
    return worst_fall <= of_pair && distance <= chi_square_quantile(dof, probability);
  }
};

// The pairs to remove until the linearised problem is within the bounds, at most `most`. M and lambda without a pair
// come from a block inversion, like in the update (docs/update.md). The number is limited because the transform moves
// when a gross error leaves: the problem must then be solved again.
std::vector<std::size_t> find_contradicting(const PairedPoints& pairs, const AlignmentSolution& solution,
                                            const Bounds& bounds, std::size_t most) {
  const LinearisedPairs& now = solution.linearised;
  const std::size_t k = pairs.size();
  const auto at = row_of_point;
  Eigen::MatrixXd M = now.covariance().inverse();
  const Eigen::VectorXd own = M.diagonal();
  M.noalias() -= now.V() * solution.centred_covariance * now.V().transpose();
  Eigen::VectorXd lambda = now.lambda();
  double distance = solution.alignment.distance;
  int dof = solution.alignment.dof;
  std::vector<bool> out(k, false);
  std::vector<std::size_t> order;
  do {
    std::vector<double> falls(k, -1.0);
    for (std::size_t i = 0; i < k; ++i)
      if (!out[i])
        falls[i] = fall_of(M.block<3, 3>(at(i), at(i)), lambda.segment<3>(at(i)), own.segment<3>(at(i)).sum());
    const std::size_t worst = worst_of(falls);
    if (bounds.kept(distance, dof, falls[worst])) break;
    order.push_back(worst);
    out[worst] = true;
    distance -= falls[worst];
    dof -= 3;
    const Eigen::SelfAdjointEigenSolver<Matrix3> D(M.block<3, 3>(at(worst), at(worst)));
    if (!(D.eigenvalues()[0] > 1e-9 * own.segment<3>(at(worst)).sum())) break;  // no block inversion: solve again
    const Eigen::Matrix<double, Eigen::Dynamic, 3> B =
        M.middleCols<3>(at(worst)) * D.eigenvectors() * D.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal();
    const Vector3 part = D.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal() *
                         (D.eigenvectors().transpose() * lambda.segment<3>(at(worst)));
    lambda.noalias() -= B * part;
    M.noalias() -= B * B.transpose();
  } while (order.size() < most);
  return order;
}

}  // namespace

CompatibleAlignment align_compatible(const PairedPoints& pairs, double probability, double pair_probability,
                                     const TransformPrior* prior, const SE3* start) {
  const Bounds bounds{probability, chi_square_quantile(3, pair_probability)};
  const std::size_t least = prior == nullptr ? 3 : 1;
  CompatibleAlignment result;
  for (std::size_t i = 0; i < pairs.size(); ++i) result.kept.push_back(i);
  PairedPoints rest = pairs;
  AlignmentSolution solution;
  SE3 last;
  for (;;) {
    solve_alignment(rest, prior, start, solution);
    result.alignment = solution.alignment;
    if (!solution.alignment.ok()) break;
    std::vector<std::size_t> leave;
    if (solution.linearised.covariance().full()) {
      const std::size_t most = rest.size() > least ? std::min(rest.size() - least, 1 + rest.size() / 16) : 1;
      leave = find_contradicting(rest, solution, bounds, most);
    } else {
      // Independent points are cheap: the problem is solved again after each removal.
      find_falls(rest, solution);
      const std::size_t worst = worst_of(solution.alignment.falls);
      if (!bounds.kept(solution.alignment.distance, solution.alignment.dof, solution.alignment.falls[worst]))
        leave.push_back(worst);
    }
    if (leave.empty()) return result;
    if (rest.size() <= least) break;
    for (std::size_t i : leave) result.left_out.push_back(result.kept[i]);
    std::vector<bool> out(rest.size(), false);
    for (std::size_t i : leave) out[i] = true;
    std::vector<std::size_t> stay, kept;
    for (std::size_t i = 0; i < rest.size(); ++i)
      if (!out[i]) {
        stay.push_back(i);
        kept.push_back(result.kept[i]);
      }
    rest = select_pairs(rest, stay);
    result.kept = kept;
    last = solution.alignment.T_a_b;
    start = &last;
  }
  result.kept.clear();
  return result;
}

}  // namespace cairn
