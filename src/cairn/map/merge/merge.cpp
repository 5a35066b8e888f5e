// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/merge.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_set>

#include "core/chi_square.hpp"
#include "core/error.hpp"
#include "map/merge/correspondence.hpp"

namespace cairn {
namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

unsigned long long number(std::uint64_t id) {
  return id;
}

Pairs pairs_by_id(const Landmarks& map, const Landmarks& other) {
  Pairs pairs;
  for (std::size_t i = 0; i < map.size(); ++i) {
    std::size_t j = 0;
    if (other.find(map.id(i), j)) pairs.emplace_back(i, j);
  }
  return pairs;
}

PointSet points_of(const Landmarks& map) {
  PointSet set;
  std::vector<std::size_t> all(map.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  map.prepare_covariances(all);
  for (const std::size_t i : all) {
    set.points.push_back(map.position(i));
    set.covariances.push_back(map.covariance(i));
  }
  set.joint = [&map](const std::size_t* indices, std::size_t count, double* matrix) {
    map.joint_covariance(indices, count, matrix);
  };
  return set;
}

Pairs pairs_by_geometry(const Landmarks& map, const Landmarks& other, const MergeOptions& options) {
  CorrespondenceOptions how;
  how.max_tilt = options.max_tilt;
  const PointSet a = points_of(map), b = points_of(other);
  const Correspondence found = options.prior ? match_points_near(a, b, *options.prior, how) : match_points(a, b, how);
  switch (found.reason) {
    case CorrespondenceReason::found:
      break;
    case CorrespondenceReason::too_few:
      throw Error(
          ErrorCode::not_found,
          "other: too few landmarks of a shape to tell by how they lie (map %zu, other %zu); merge by id, or say "
          "by has_transform how the frames lie",
          map.size(), other.size());
    case CorrespondenceReason::nothing:
      throw Error(ErrorCode::not_found, "other: nothing in common with the map beyond what chance makes alike");
    case CorrespondenceReason::ambiguous:
      throw Error(
          ErrorCode::numerical,
          "other: two transforms fit alike (%zu landmarks pair by the second); say by has_transform how the frames "
          "lie",
          found.rivals);
    case CorrespondenceReason::budget:
      throw Error(ErrorCode::numerical,
                  "other: more transforms may fit than can be looked at; say by has_transform how the frames lie");
    case CorrespondenceReason::too_vague:
      throw Error(
          ErrorCode::numerical,
          "options.covariance: T_map_other is too vague beside the distances between landmarks; leave has_transform "
          "0");
  }
  return found.pairs;
}

// Up to `most` numbers below `count`, evenly drawn, including the first and the last.
std::vector<std::size_t> drawn(std::size_t count, std::size_t most) {
  std::vector<std::size_t> which(std::min(count, most));
  for (std::size_t i = 0; i < which.size(); ++i)
    which[i] = which.size() == count ? i : i * (count - 1) / (which.size() - 1);
  return which;
}

PairedPoints joint_points(const Landmarks& map, const Landmarks& other, const Pairs& pairs,
                          const std::vector<std::size_t>& which) {
  PairedPoints points;
  std::vector<std::size_t> in_map, in_other;
  for (const std::size_t i : which) {
    in_map.push_back(pairs[i].first);
    in_other.push_back(pairs[i].second);
    points.a.push_back(map.position(in_map.back()));
    points.b.push_back(other.position(in_other.back()));
  }
  const std::size_t k = which.size();
  points.covariance_a.full.resize(9 * k * k);
  points.covariance_b.full.resize(9 * k * k);
  map.joint_covariance(in_map.data(), k, points.covariance_a.full.data());
  other.joint_covariance(in_other.data(), k, points.covariance_b.full.data());
  return points;
}

[[noreturn]] void throw_misaligned(AlignmentStatus status, std::size_t common) {
  switch (status) {
    case AlignmentStatus::too_few:
      throw Error(ErrorCode::not_found,
                  "other: %zu landmarks are in common; where its frame lies takes three of them, or has_transform",
                  common);
    case AlignmentStatus::degenerate:
      throw Error(
          ErrorCode::numerical,
          "other: the %zu common landmarks lie on a line, as far as their uncertainty tells; say by has_transform "
          "how the frames lie",
          common);
    case AlignmentStatus::singular:
      throw Error(ErrorCode::numerical, "other: the common landmarks' joint covariance is not positive definite");
    default:
      throw Error(ErrorCode::numerical, "other: no transform brings the common landmarks together");
  }
}

// Squared distance of a pair that was not drawn, under the transform from the drawn pairs.
double distance_of(const Landmarks& map, const Landmarks& other, const std::pair<std::size_t, std::size_t>& pair,
                   const Alignment& alignment) {
  const Matrix3 R = alignment.T_a_b.rotation().matrix();
  const Vector3 b = other.position(pair.second), r = map.position(pair.first) - alignment.T_a_b * b;
  Matrix36 J;
  J << Matrix3::Identity(), -hat(Vector3(R * b));
  const Matrix3 S = map.covariance(pair.first) + R * other.covariance(pair.second) * R.transpose() +
                    J * alignment.covariance * J.transpose();
  return r.dot(S.ldlt().solve(r));
}

void name(const Landmarks& map, const Landmarks& other, const MergeOptions& options, MergePlan& plan) {
  std::vector<char> common(other.size(), 0);
  plan.ids.resize(other.size());
  std::unordered_set<std::uint64_t> used;
  std::uint64_t largest = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    used.insert(map.id(i));
    largest = std::max(largest, map.id(i));
  }
  for (std::size_t j = 0; j < other.size(); ++j) largest = std::max(largest, other.id(j));
  for (const auto& [i, j] : plan.pairs) {
    plan.ids[j] = map.id(i);
    common[j] = 1;
  }
  std::vector<std::size_t> homeless;
  for (std::size_t j = 0; j < other.size(); ++j) {
    if (common[j] != 0) continue;
    plan.ids[j] = other.id(j);
    if (options.by_geometry && used.count(other.id(j)) != 0) homeless.push_back(j);
  }
  for (std::size_t j = 0; j < other.size(); ++j)
    if (common[j] == 0) used.insert(plan.ids[j]);
  std::sort(homeless.begin(), homeless.end(), [&](std::size_t a, std::size_t b) { return other.id(a) < other.id(b); });
  std::uint64_t next = largest;
  for (const std::size_t j : homeless) {
    do ++next;  // the largest possible id is followed by 0
    while (next == MergeReport::kNone || used.count(next) != 0);
    plan.ids[j] = next;
    used.insert(next);
  }
}

}  // namespace

void throw_contradiction(std::uint64_t id, std::uint64_t other_id, MergeReport& report) {
  report.broken_id = id;
  report.broken_other_id = other_id;
  throw Error(ErrorCode::numerical,
              "other: its landmark %llu contradicts landmark %llu of the map, given all other common ones (%zu; joint "
              "distance %g, bound %g)",
              number(other_id), number(id), report.common, report.distance, report.threshold);
}

MergePlan plan_merge(const Landmarks& map, const Landmarks& other, const MergeOptions& options,
                     std::size_t joint_at_most, MergeReport& report) {
  if (map.size() == 0) throw Error(ErrorCode::not_found, "map: it holds no landmark; copy the other instead");
  if (other.size() == 0) throw Error(ErrorCode::not_found, "other: it holds no landmark");
  MergePlan plan;
  plan.pairs = options.by_geometry ? pairs_by_geometry(map, other, options) : pairs_by_id(map, other);
  std::sort(plan.pairs.begin(), plan.pairs.end(),
            [&](const auto& a, const auto& b) { return map.id(a.first) < map.id(b.first); });
  report.common = plan.pairs.size();
  report.added = other.size() - plan.pairs.size();
  if (options.max_landmarks > 0 && map.size() + report.added > options.max_landmarks)
    throw Error(ErrorCode::capacity, "options.max_landmarks is %zu, and the merged map would hold %zu",
                options.max_landmarks, map.size() + report.added);

  const TransformPrior* prior = options.prior ? &*options.prior : nullptr;
  const std::vector<std::size_t> which = drawn(plan.pairs.size(), joint_at_most);
  plan.alignment = align(joint_points(map, other, plan.pairs, which), prior, true);
  const Alignment& alignment = plan.alignment;
  if (!alignment.ok()) throw_misaligned(alignment.status, plan.pairs.size());
  report.T_map_other = alignment.T_a_b;
  report.covariance = alignment.covariance;
  report.distance = alignment.distance;
  report.rows = static_cast<std::size_t>(alignment.dof);
  report.threshold = alignment.dof > 0 ? chi_square_quantile(alignment.dof, options.joint_gate_probability) : 0.0;

  // The bound of a pair is such that all pairs pass with the given probability (Bonferroni).
  const double miss = (1.0 - options.gate_probability) / static_cast<double>(plan.pairs.size());
  const double bound =
      options.gate_probability < 1.0 ? chi_square_quantile(3, 1.0 - miss) : std::numeric_limits<double>::infinity();
  std::size_t worst = which[0];
  double most = -1.0;
  for (std::size_t i = 0; i < which.size(); ++i)
    if (alignment.falls[i] > most) most = alignment.falls[i], worst = which[i];
  const auto refuse = [&](std::size_t i) {
    throw_contradiction(map.id(plan.pairs[i].first), other.id(plan.pairs[i].second), report);
  };
  if (most > bound || (alignment.dof > 0 && !(alignment.distance <= report.threshold))) refuse(worst);
  if (which.size() < plan.pairs.size()) {
    std::vector<std::size_t> in_map, in_other;
    for (const auto& [i, j] : plan.pairs) in_map.push_back(i), in_other.push_back(j);
    map.prepare_covariances(in_map);
    other.prepare_covariances(in_other);
    for (std::size_t i = 0; i < plan.pairs.size(); ++i)
      if (!(distance_of(map, other, plan.pairs[i], alignment) <= bound)) refuse(i);
  }
  name(map, other, options, plan);
  return plan;
}

std::vector<MergedId> merged_ids(const Landmarks& other, const MergePlan& plan) {
  std::vector<char> common(other.size(), 0);
  for (const auto& pair : plan.pairs) common[pair.second] = 1;
  std::vector<MergedId> merged;
  for (std::size_t j = 0; j < other.size(); ++j) merged.push_back({other.id(j), plan.ids[j], common[j] != 0});
  std::sort(merged.begin(), merged.end(), [](const MergedId& a, const MergedId& b) { return a.other_id < b.other_id; });
  return merged;
}

}  // namespace cairn
