// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/correspondence.hpp"

#include "core/chi_square.hpp"
#include "map/merge/correspondence_search.hpp"
#include "map/merge/indexed_points.hpp"
#include "map/merge/point_pairing.hpp"

namespace cairn {

Correspondence match_points(const PointSet& a, const PointSet& b, const CorrespondenceOptions& options) {
  return CorrespondenceSearch(a, b, options).run();
}

Correspondence match_points_near(const PointSet& a, const PointSet& b, const TransformPrior& prior,
                                 const CorrespondenceOptions& options) {
  Correspondence result;
  result.reason = CorrespondenceReason::too_few;
  if (a.points.empty() || b.points.empty()) return result;
  const IndexedPoints points_a(a, false), points_b(b, false);
  const double gate = chi_square_quantile(3, options.gate_probability);
  const double reach = kPairingReach * points_a.median_spacing();
  const PointPairing pairing(points_a, points_b, gate, reach);
  if (pairing.pair(prior.T_a_b, prior.covariance).near == 0) {
    result.reason = CorrespondenceReason::too_vague;
    return result;
  }
  result.reason = CorrespondenceReason::nothing;
  Alignment alignment;
  alignment.T_a_b = prior.T_a_b;
  alignment.covariance = prior.covariance;
  IndexPairs pairs;
  if (!pairing.grow(&prior, pairs, alignment)) return result;
  pairing.keep_compatible(options.joint_probability, options.gate_probability, &prior, pairs, alignment);
  if (pairs.empty()) return result;
  result.reason = CorrespondenceReason::found;
  result.pairs = pairs;
  result.alignment = alignment;
  return result;
}

}  // namespace cairn
