// SPDX-License-Identifier: BSD-3-Clause
#include "map/naming.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <unordered_map>

#include "association/association.hpp"
#include "association/doubt.hpp"
#include "core/chi_square.hpp"
#include "geometry/embedding.hpp"
#include "map/fixed_base.hpp"
#include "sensor/sensor.hpp"

namespace cairn {
namespace {

constexpr std::size_t kNearest = 12;  // landmarks of the map that a landmark of the submap is compared with

template <class Pose>
class Naming final : public Innovations {
 public:
  Naming(const GlobalMap<Pose>& map, const NamingOptions& options, const Submap<Pose>& submap)
      : map_(map),
        options_(options),
        submap_(submap),
        gate_(chi_square_quantile(kDim, std::min(options.gate_probability, options.new_probability))),
        new_(chi_square_quantile(kDim, options.new_probability)),
        noise_(submap.covariance) {
    std::vector<Index> all;
    for (Index i = 0; i < submap.size(); ++i) all.push_back(i);
    to_ordinary(submap, all, noise_);
    if (submap.base) use_fixes(all);
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

    association.demand_support(options_.support, [&](Index, Index pair) { return confusable(candidates_[pair]); });

    std::vector<Index> chosen(submap_.landmarks.size(), kUnpaired);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const Index pair = association.chosen(static_cast<Index>(i));
      if (pair != kUnpaired) chosen[i] = static_cast<Index>(known_[candidates_[pair].landmark].index);
    }
    return chosen;
  }
  // Whether a landmark without a pair is far enough from all landmarks of the map.
  bool fresh(std::size_t i) const { return nearest_[i] > new_; }

  Index rows() const override { return kDim; }
  double threshold(Index rows) const override {
    return chi_square_quantile(static_cast<double>(rows), options_.joint_gate_probability);
  }
  void innovation(Index a, double* nu) const override {
    Eigen::Map<Point> out(nu);
    out = residual(candidates_[a]).template head<kDim>();
  }
  void covariance(Index a, Index b, double* block) const override {
    const PairCandidate &p = candidates_[a], &q = candidates_[b];
    Eigen::Map<PointSquare> out(block);
    out = (across(p, q) + noise(p.observation, q.observation)).template topLeftCorner<kDim, kDim>();
  }

 private:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Point = typename Pose::Point;
  using PointSquare = typename Pose::Rotation::Matrix;
  using Space = Embedding<Pose>;

  struct Known {
    std::size_t index;
    Prediction<Pose> prediction;  // of the landmark, seen from the base
  };

  // Three values, as class Doubt takes them: in the plane the last one is zero.
  Vector3 seen(std::size_t i) const { return Space::up(submap_.landmarks[i]); }
  Vector3 residual(const PairCandidate& pair) const {
    return seen(static_cast<std::size_t>(pair.observation)) - known_[pair.landmark].prediction.z;
  }
  Matrix3 noise(Index i, Index j) const {
    return Space::up(PointSquare(noise_.block<kDim, kDim>(kDof + kDim * i, kDof + kDim * j)));
  }
  // The prediction of a known landmark as landmark i of the submap, whose estimate may move with the base.
  Prediction<Pose> prediction(Index i, Index k) const {
    Prediction<Pose> out = known_[k].prediction;
    if (gain_.rows() > 0) out.J_z_pose.template topRows<kDim>() -= gain_.middleRows<kDim>(kDof + kDim * i);
    return out;
  }
  // J_a P J_b^T of two pairs, J by the errors of base and landmarks.
  Matrix3 across(const PairCandidate& a, const PairCandidate& b) const {
    return image_covariance(P_, prediction(a.observation, a.landmark), a.landmark,
                            prediction(b.observation, b.landmark), b.landmark);
  }
  Matrix3 covariance_of(const PairCandidate& a) const { return across(a, a) + noise(a.observation, a.observation); }

  // What the fixes told about the base moves the base, and the map around it.
  void use_fixes(const std::vector<Index>& all) {
    fixed_.emplace(*submap_.base, submap_.errors);
    Eigen::MatrixXd cross = submap_.errors.cross.template middleCols<kDof>(submap_.errors.count() - kDof);
    rows_to_ordinary(submap_, all, cross);
    gain_ = fixed_->gain(cross);
    noise_ -= gain_ * cross.transpose();
    gain_ *= pose_error_jacobian(map_.base(), fixed_->at);
  }

  // Finds the candidates for each landmark of the submap among the landmarks of the map, and their joint covariance
  // with the base. Usually the landmarks of the map are at least as certain as the base, so the search radius uses the
  // uncertainty of the base for both.
  void find_known() {
    Pose T = map_.base();
    Eigen::MatrixXd P = map_.base_covariance();
    std::vector<Point> places;
    if (fixed_) fixed_->correct(T, places, P);
    std::unordered_map<std::size_t, Index> numbers;
    near_.resize(submap_.landmarks.size());
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < submap_.landmarks.size(); ++i) {
      const Point arm = T.rotation() * submap_.landmarks[i];
      Eigen::Matrix<double, kDim, kDof> J;
      J << PointSquare::Identity(), Pose::Rotation::turn(arm);
      const double base = std::sqrt((J * P * J.transpose()).trace());
      const double own = std::sqrt(noise(static_cast<Index>(i), static_cast<Index>(i)).trace());
      std::vector<std::size_t> found =
          within(map_, Space::up(Point(T.translation() + arm)), std::sqrt(new_) * (2.0 * base + own));
      if (found.size() > kNearest) found.resize(kNearest);
      for (const std::size_t index : found) {
        const auto [entry, is_new] = numbers.emplace(index, static_cast<Index>(known_.size()));
        if (is_new) {
          Known known{index, {}};
          places.push_back(Space::down(map_.position(index)));
          known_.push_back(known);
          indices.push_back(index);
        }
        near_[i].push_back(entry->second);
      }
    }
    const auto n = static_cast<Index>(kDof + kDim * indices.size());
    P_.resize(n, n);
    map_.base_joint_covariance(indices.data(), indices.size(), P_.data());
    T = map_.base();
    if (fixed_) fixed_->correct(T, places, P_);
    for (std::size_t k = 0; k < known_.size(); ++k) {
      Prediction<Pose>& prediction = known_[k].prediction;
      map_jacobians(T, places[k], Prediction<Pose>::ByLandmark::Identity(), prediction);
      prediction.z = Space::up(Point(T.inverse() * places[k]));
    }
  }

  void find_candidates() {
    for (std::size_t i = 0; i < near_.size(); ++i)
      for (const Index k : near_[i]) {
        PairCandidate pair{static_cast<Index>(i), k, 0.0};
        const Matrix3 S = covariance_of(pair);
        const Vector3 nu = residual(pair);
        if (!within_bound(nu, S, kDim, new_)) continue;
        pair.distance = squared_distance(nu.data(), S.data(), 3, kDim);
        nearest_[i] = std::min(nearest_[i], pair.distance);
        if (pair.distance <= gate_) candidates_.push_back(pair);
      }
  }

  bool confusable(const PairCandidate& pair) const {
    const Matrix3 own = noise(pair.observation, pair.observation), S = covariance_of(pair);
    const Doubt doubt(S, own, kDim, new_);
    if (!doubt.stale()) return false;
    const Vector3& predicted = known_[pair.landmark].prediction.z;
    for (std::size_t k = 0; k < known_.size(); ++k)
      if (static_cast<Index>(k) != pair.landmark && doubt.confuses(known_[k].prediction.z - predicted)) return true;
    for (std::size_t i = 0; i < submap_.landmarks.size(); ++i)
      if (static_cast<Index>(i) != pair.observation && doubt.confuses(seen(i) - predicted)) return true;
    return false;
  }

  const GlobalMap<Pose>& map_;
  const NamingOptions& options_;
  const Submap<Pose>& submap_;
  double gate_, new_;
  Eigen::MatrixXd noise_, P_;
  std::optional<FixedBase<Pose>> fixed_;  // if there were fixes in the submap
  Eigen::MatrixXd gain_;                  // of the submap's estimates, by the ordinary error of the base
  std::vector<Known> known_;
  std::vector<std::vector<Index>> near_;  // by landmark of the submap: numbers in known_, nearest first
  std::vector<double> nearest_;           // by landmark of the submap: squared distance, if it is within the bound
  std::vector<PairCandidate> candidates_;
};

}  // namespace

template <class Pose>
NamingReport name_landmarks(const GlobalMap<Pose>& map, const NamingOptions& options, Submap<Pose>& submap) {
  NamingReport report;
  Naming<Pose> naming(map, options, submap);
  const std::vector<Index> chosen = naming.choose(report);
  constexpr Index kDim = Pose::kDim, kDof = Pose::kDof;
  std::vector<Index> states;
  for (Index d = 0; d < kDof; ++d) states.push_back(d);
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
    for (Index d = 0; d < kDim; ++d) states.push_back(kDof + kDim * static_cast<Index>(i) + d);
  }
  if (report.ambiguous == 0) return report;
  submap.ids.resize(kept);
  submap.counts.resize(kept);
  submap.landmarks.resize(kept);
  submap.covariance = submap.covariance(states, states).eval();
  if (submap.errors.count() > 0) submap.errors.cross = submap.errors.cross(states, Eigen::all).eval();
  return report;
}

template NamingReport name_landmarks(const GlobalMap<SE2>&, const NamingOptions&, Submap<SE2>&);
template NamingReport name_landmarks(const GlobalMap<SE3>&, const NamingOptions&, Submap<SE3>&);

}  // namespace cairn
