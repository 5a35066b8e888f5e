// SPDX-License-Identifier: BSD-3-Clause
#include "map/naming.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "association/association.hpp"
#include "association/doubt.hpp"
#include "core/chi_square.hpp"
#include "sensor/sensor.hpp"

namespace cairn {
namespace {

constexpr std::size_t kNearest = 12;  // of the map's landmarks that one of the submap is compared with

class Naming final : public Innovations {
 public:
  Naming(const GlobalMap<SE3>& map, const NamingOptions& options, const Submap<SE3>& submap)
      : map_(map),
        options_(options),
        submap_(submap),
        gate_(chi_square_quantile(3, std::min(options.gate_probability, options.new_probability))),
        new_(chi_square_quantile(3, options.new_probability)),
        noise_(submap.covariance) {
    std::vector<Index> all;
    for (Index i = 0; i < submap.size(); ++i) all.push_back(i);
    to_ordinary(submap, all, noise_);
    nearest_.assign(submap.landmarks.size(), std::numeric_limits<double>::infinity());
    find_known();
    find_candidates();
  }

  // By landmark of the submap: index in the map, or kUnpaired.
  std::vector<Index> choose(NamingReport& report) {
    const Index count = submap_.size();
    Arena measure;
    const Association::Capacity capacity{count, static_cast<Index>(candidates_.size()),
                                         static_cast<Index>(known_.size())};
    const Association unused(measure, capacity);
    Arena arena(measure.used());
    Association association(arena, capacity);
    if (options_.joint)
      association.joint_compatibility(candidates_.data(), capacity.candidates, count, *this, options_.nodes);
    else
      association.nearest_neighbour(candidates_.data(), capacity.candidates, count);
    report.nodes = association.nodes();
    report.exhausted = association.exhausted();

    std::vector<Index> chosen(submap_.landmarks.size(), kUnpaired);
    std::vector<std::size_t> doubtful;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const Index pair = association.chosen(static_cast<Index>(i));
      if (pair == kUnpaired) continue;
      chosen[i] = static_cast<Index>(known_[candidates_[pair].landmark].index);
      if (confusable(candidates_[pair])) doubtful.push_back(i);
    }
    if (static_cast<Index>(doubtful.size()) < options_.support)
      for (const std::size_t i : doubtful) chosen[i] = kUnpaired;
    return chosen;
  }
  // Whether a landmark without a pair is far enough from all that the map knows.
  bool fresh(std::size_t i) const { return nearest_[i] > new_; }

  Index rows() const override { return 3; }
  double threshold(Index rows) const override {
    return chi_square_quantile(static_cast<double>(rows), options_.joint_gate_probability);
  }
  void innovation(Index a, double* nu) const override {
    Eigen::Map<Vector3> out(nu);
    out = residual(candidates_[a]);
  }
  void covariance(Index a, Index b, double* block) const override {
    const PairCandidate &p = candidates_[a], &q = candidates_[b];
    Eigen::Map<Matrix3> out(block);
    out = across(p.landmark, q.landmark) + noise(p.observation, q.observation);
  }

 private:
  struct Known {
    std::size_t index;
    Prediction<SE3> prediction;  // as a point seen from the base
  };

  Vector3 residual(const PairCandidate& pair) const {
    return submap_.landmarks[pair.observation] - known_[pair.landmark].prediction.z;
  }
  Matrix3 noise(Index i, Index j) const { return noise_.block<3, 3>(6 + 3 * i, 6 + 3 * j); }
  // J_k P J_l^T of two known landmarks.
  Matrix3 across(Index k, Index l) const {
    return image_covariance(P_, known_[k].prediction, k, known_[l].prediction, l);
  }

  // Landmarks of the map that those of the submap may be, and their joint covariance with the base. What the map knew
  // before the base is known no worse than the base as a rule: the base's uncertainty counts for both.
  void find_known() {
    const SE3 T = map_.base();
    const Matrix6 P = map_.base_covariance();
    std::unordered_map<std::size_t, Index> numbers;
    near_.resize(submap_.landmarks.size());
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < submap_.landmarks.size(); ++i) {
      const Vector3 arm = T.rotation() * submap_.landmarks[i];
      Eigen::Matrix<double, 3, 6> J;
      J << Matrix3::Identity(), SO3::turn(arm);
      const double base = std::sqrt((J * P * J.transpose()).trace());
      const double own = std::sqrt(noise(static_cast<Index>(i), static_cast<Index>(i)).trace());
      std::vector<std::size_t> found = within(map_, T.translation() + arm, std::sqrt(new_) * (2.0 * base + own));
      if (found.size() > kNearest) found.resize(kNearest);
      for (const std::size_t index : found) {
        const auto [entry, is_new] = numbers.emplace(index, static_cast<Index>(known_.size()));
        if (is_new) {
          Known known{index, {}};
          map_jacobians(T, map_.position(index), Matrix3::Identity(), known.prediction);
          known.prediction.z = T.inverse() * map_.position(index);
          known_.push_back(known);
          indices.push_back(index);
        }
        near_[i].push_back(entry->second);
      }
    }
    const auto n = static_cast<Index>(6 + 3 * indices.size());
    P_.resize(n, n);
    map_.base_joint_covariance(indices.data(), indices.size(), P_.data());
  }

  void find_candidates() {
    std::vector<Matrix3> predicted;
    for (std::size_t k = 0; k < known_.size(); ++k)
      predicted.push_back(across(static_cast<Index>(k), static_cast<Index>(k)));
    for (std::size_t i = 0; i < near_.size(); ++i)
      for (const Index k : near_[i]) {
        PairCandidate pair{static_cast<Index>(i), k, 0.0};
        const Matrix3 S = predicted[k] + noise(pair.observation, pair.observation);
        const Vector3 nu = residual(pair);
        if (!within_bound(nu, S, 3, new_)) continue;
        pair.distance = squared_distance(nu.data(), S.data(), 3, 3);
        nearest_[i] = std::min(nearest_[i], pair.distance);
        if (pair.distance <= gate_) candidates_.push_back(pair);
      }
  }

  bool confusable(const PairCandidate& pair) const {
    const Matrix3 own = noise(pair.observation, pair.observation), S = across(pair.landmark, pair.landmark) + own;
    const Doubt doubt(S, own, 3, new_);
    if (!doubt.stale()) return false;
    const Vector3& predicted = known_[pair.landmark].prediction.z;
    for (std::size_t k = 0; k < known_.size(); ++k)
      if (static_cast<Index>(k) != pair.landmark && doubt.confuses(known_[k].prediction.z - predicted)) return true;
    for (std::size_t i = 0; i < submap_.landmarks.size(); ++i)
      if (static_cast<Index>(i) != pair.observation && doubt.confuses(submap_.landmarks[i] - predicted)) return true;
    return false;
  }

  const GlobalMap<SE3>& map_;
  const NamingOptions& options_;
  const Submap<SE3>& submap_;
  double gate_, new_;
  Eigen::MatrixXd noise_, P_;
  std::vector<Known> known_;
  std::vector<std::vector<Index>> near_;  // by landmark of the submap: numbers in known_, nearest first
  std::vector<double> nearest_;           // by landmark of the submap: squared distance, where it is within the bound
  std::vector<PairCandidate> candidates_;
};

}  // namespace

NamingReport name_landmarks(const GlobalMap<SE3>& map, const NamingOptions& options, Submap<SE3>& submap) {
  NamingReport report;
  Naming naming(map, options, submap);
  const std::vector<Index> chosen = naming.choose(report);
  std::vector<Index> states{0, 1, 2, 3, 4, 5};
  std::size_t kept = 0;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i] == kUnpaired && !naming.fresh(i)) {
      ++report.ambiguous;
      continue;
    }
    if (chosen[i] != kUnpaired) {
      submap.ids[i] = map.id(static_cast<std::size_t>(chosen[i]));
      ++report.named;
    }
    submap.ids[kept] = submap.ids[i];
    submap.counts[kept] = submap.counts[i];
    submap.landmarks[kept] = submap.landmarks[i];
    ++kept;
    for (Index d = 0; d < 3; ++d) states.push_back(6 + 3 * static_cast<Index>(i) + d);
  }
  if (report.ambiguous == 0) return report;
  submap.ids.resize(kept);
  submap.counts.resize(kept);
  submap.landmarks.resize(kept);
  submap.covariance = submap.covariance(states, states).eval();
  return report;
}

}  // namespace cairn
