// SPDX-License-Identifier: BSD-3-Clause
// Submaps with known truth, and the complete problem that they define: all bases and all landmarks at once, dense,
// solved anew each time.
#pragma once

#include <Eigen/Cholesky>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include "geometry/embedding.hpp"
#include "map/global_map.hpp"
#include "map/join/sparse/submap_factor.hpp"
#include "map/join/submap_hessian.hpp"
#include "numerical.hpp"

namespace cairn::test {

using Ids = std::vector<std::uint64_t>;

inline constexpr ErrorKind kKinds[] = {ErrorKind::invariant, ErrorKind::standard};

struct Noise {
  double position, turn;
};

// Submaps around a ring of bases. Their estimates are drawn from the covariance that they state.
template <class Pose>
class Ring {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Point = typename Pose::Point;
  using Rotation = typename Pose::Rotation;

  Ring(unsigned seed, ErrorKind error, int bases, double radius, Noise noise)
      : random_(seed), error_(error), bases_(bases), radius_(radius), noise_(noise) {
    for (int i = 0; i < bases; ++i)
      for (int k = 0; k < 5; ++k)
        landmarks.push_back(base(i).translation() +
                            Space::down(Vector3(6, 6, 2)).cwiseProduct(random_.template normal_vector<kDim>()));
  }

  std::vector<Point> landmarks;  // in the map frame; five at each place

  Pose base(int i) const {
    const double angle = 6.283185307179586 * i / bases_;
    return Space::down(SE3(SO3::exp(Vector3(0, 0, angle)) * SO3::exp(Vector3(0.1, 0.05 * std::sin(i), 0)),
                           radius_ * Vector3(std::cos(angle), std::sin(angle), 0.1 * std::cos(2 * angle))));
  }
  // The submap that begins at base(i): landmarks of its own place, and some of the places before and after it.
  Submap<Pose> submap(int i) {
    Ids ids;
    const int before = (i + bases_ - 1) % bases_, here = i % bases_, after = (i + 1) % bases_;
    for (const int k : {3, 4}) ids.push_back(static_cast<std::uint64_t>(5 * before + k));
    for (const int k : {0, 2, 3, 4}) ids.push_back(static_cast<std::uint64_t>(5 * here + k));
    ids.push_back(static_cast<std::uint64_t>(5 * after));
    return draw(base(i), base(i + 1), ids);
  }
  Submap<Pose> draw(const Pose& from, const Pose& to, const Ids& ids) {
    Submap<Pose> out;
    out.error = error_;
    out.ids = ids;
    out.counts.assign(ids.size(), 2);
    const auto n = static_cast<Eigen::Index>(kDof + kDim * ids.size());
    Eigen::MatrixXd root(n, n + 3);
    for (Eigen::Index k = 0; k < root.size(); ++k) root.data()[k] = random_.normal() / std::sqrt(n + 3.0);
    for (Eigen::Index r = 0; r < n; ++r) root.row(r) *= r >= kDim && r < kDof ? noise_.turn : noise_.position;
    out.covariance = root * root.transpose();
    Eigen::VectorXd draws(n + 3);
    for (Eigen::Index k = 0; k < draws.size(); ++k) draws(k) = random_.normal();
    const Eigen::VectorXd xi = root * draws;
    const typename Rotation::Tangent turn = xi.segment<kTurn>(kDim);
    // Truth = Exp(xi) estimate.
    const auto estimate = [&](const Point& truth, const Point& e) -> Point {
      if (error_ == ErrorKind::standard) return truth - e;
      return Rotation::exp(-turn) * Point(truth - Rotation::translation_jacobian(turn) * e);
    };
    const Pose T = from.inverse() * to;
    out.T_base_end = Pose(Rotation::exp(-turn) * T.rotation(), estimate(T.translation(), xi.head<kDim>()));
    for (std::size_t k = 0; k < ids.size(); ++k)
      out.landmarks.push_back(
          estimate(from.inverse() * landmarks[ids[k]], xi.segment<kDim>(kDof + kDim * static_cast<Eigen::Index>(k))));
    return out;
  }
  MapOptions<Pose> options() const {
    MapOptions<Pose> options;
    options.cost_tolerance = 0.0;
    options.step_tolerance = 1e-6;  // by default small motions are passed down later, and the cost is not up to date
    options.error = error_;
    options.fuse = false;  // the reference solves for all submaps
    options.gate_probability = options.joint_gate_probability = 1.0 - 1e-9;
    options.initial_pose = base(0);
    options.initial_covariance.diagonal().template head<kDim>().setConstant(1e-2);
    options.initial_covariance.diagonal().template tail<kTurn>().setConstant(1e-4);
    return options;
  }

 private:
  using Space = Embedding<Pose>;

  Random random_;
  ErrorKind error_;
  int bases_;
  double radius_;
  Noise noise_;
};

template <class Map>
Vector3 position_of(const Map& map, std::uint64_t id) {
  std::size_t index = 0;
  REQUIRE(map.find(id, index));
  return map.position(index);
}

// The submap without its landmark of this number.
template <class Pose>
Submap<Pose> without_landmark(Submap<Pose> submap, Eigen::Index landmark) {
  std::vector<Eigen::Index> kept;
  const Eigen::Index first = Pose::kDof + Pose::kDim * landmark;
  for (Eigen::Index k = 0; k < submap.covariance.rows(); ++k)
    if (k < first || k >= first + Pose::kDim) kept.push_back(k);
  submap.covariance = Eigen::MatrixXd(submap.covariance(kept, kept));
  submap.ids.erase(submap.ids.begin() + landmark);
  submap.counts.erase(submap.counts.begin() + landmark);
  submap.landmarks.erase(submap.landmarks.begin() + landmark);
  return submap;
}

// All bases, then all landmarks by ascending id.
template <class Pose>
struct Reference {
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Tangent = typename Pose::Tangent;
  using Square = typename Pose::Square;

  explicit Reference(const MapOptions<Pose>& o, const std::vector<Submap<Pose>>& submaps) : options(o) {
    bases.push_back(o.initial_pose);
    for (const Submap<Pose>& submap : submaps) {
      std::vector<Eigen::Index> all;
      for (Eigen::Index i = 0; i < submap.size(); ++i) {
        all.push_back(i);
        landmarks.emplace(submap.ids[i], bases.back() * submap.landmarks[i]);
      }
      factors.emplace_back(std::make_shared<SubmapData<Pose>>(submap), all);
      bases.push_back(bases.back() * submap.T_base_end);
    }
    Eigen::Index at = states_of_bases();
    for (const auto& [id, position] : landmarks) {
      states[id] = at;
      at += kDim;
    }
  }
  Eigen::Index states_of_bases() const { return static_cast<Eigen::Index>(kDof * bases.size()); }
  Eigen::Index size() const { return states_of_bases() + static_cast<Eigen::Index>(kDim * landmarks.size()); }
  FactorValues<Pose> values(std::size_t i) const {
    FactorValues<Pose> out{bases[i], bases[i + 1], {}};
    for (const std::uint64_t id : factors[i].data().ids) out.shared.push_back(landmarks.at(id));
    return out;
  }
  double cost() const {
    const Tangent e = pose_error(bases[0], options.initial_pose);
    double sum = 0.5 * e.dot(Tangent(options.initial_covariance.ldlt().solve(e)));
    for (std::size_t i = 0; i < factors.size(); ++i) sum += factors[i].evaluate(values(i)).cost;
    return sum;
  }
  void linearise(Eigen::MatrixXd& H, Eigen::VectorXd& g) const {
    H = Eigen::MatrixXd::Zero(size(), size());
    g = Eigen::VectorXd::Zero(size());
    const Tangent e = pose_error(bases[0], options.initial_pose);
    const Square prior = options.initial_covariance.inverse();
    Square J = Square::Identity();
    J.template bottomRightCorner<kTurn, kTurn>() = Pose::Rotation::left_jacobian_inverse(e.template tail<kTurn>());
    H.topLeftCorner<kDof, kDof>() += J.transpose() * prior * J;
    g.head<kDof>() += J.transpose() * prior * e;
    for (std::size_t i = 0; i < factors.size(); ++i) {
      std::vector<Eigen::Index> at;
      for (Eigen::Index d = 0; d < 2 * kDof; ++d) at.push_back(static_cast<Eigen::Index>(kDof * i) + d);
      for (const std::uint64_t id : factors[i].data().ids)
        for (Eigen::Index d = 0; d < kDim; ++d) at.push_back(states.at(id) + d);
      H(at, at) += whole_hessian(factors[i], values(i));
      g(at) += factors[i].evaluate(values(i)).gradient;
    }
  }
  void step(const Eigen::VectorXd& x) {
    for (std::size_t i = 0; i < bases.size(); ++i)
      bases[i] = retract(bases[i], Tangent(x.segment<kDof>(static_cast<Eigen::Index>(kDof * i))));
    for (auto& [id, position] : landmarks) position += x.segment<kDim>(states.at(id));
  }
  // Levenberg-Marquardt.
  void solve() {
    double damping = 1e-3;
    for (int i = 0; i < 200; ++i) {
      Eigen::MatrixXd H;
      Eigen::VectorXd g;
      linearise(H, g);
      const Reference before = *this;
      Eigen::MatrixXd damped = H;
      damped.diagonal() += damping * H.diagonal();
      const Eigen::VectorXd x = damped.ldlt().solve(-g);
      step(x);
      if (cost() <= before.cost() * (1 + 1e-14)) {
        damping *= 0.1;
        if (x.norm() < 1e-10 * (1 + std::sqrt(static_cast<double>(size())))) return;
      } else {
        *this = before;
        damping *= 10;
        if (damping > 1e12) return;
      }
    }
  }
  Eigen::MatrixXd covariance() const {
    Eigen::MatrixXd H;
    Eigen::VectorXd g;
    linearise(H, g);
    return H.ldlt().solve(Eigen::MatrixXd::Identity(size(), size()));
  }

  MapOptions<Pose> options;
  std::vector<Pose> bases;
  std::map<std::uint64_t, typename Pose::Point> landmarks;
  std::map<std::uint64_t, Eigen::Index> states;
  std::vector<SubmapFactor<Pose>> factors;
};

inline double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / (1e-300 + b.norm());
}

}  // namespace cairn::test
