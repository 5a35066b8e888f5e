// SPDX-License-Identifier: BSD-3-Clause
// The sparse map against Gauss-Newton over all bases and all landmarks at once, dense, with nothing left out and
// nothing kept from before; and what it does when a submap does not fit.
#include "map/sparse_map.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "numerical.hpp"
#include "submap_hessian.hpp"

namespace {

using namespace cairn;
using cairn::test::Random;
using cairn::test::whole_hessian;
using Eigen::Index;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using Ids = std::vector<std::uint64_t>;

constexpr ErrorKind kKinds[] = {ErrorKind::invariant, ErrorKind::standard};

struct Noise {
  double position, turn;
};

// Submaps round a ring of bases, their estimates drawn from the covariance that they claim.
class Ring {
 public:
  Ring(unsigned seed, ErrorKind error, int bases, double radius, Noise noise)
      : random_(seed), error_(error), bases_(bases), radius_(radius), noise_(noise) {
    for (int i = 0; i < bases; ++i)
      for (int k = 0; k < 5; ++k)
        landmarks.push_back(base(i).translation() + Vector3(6, 6, 2).cwiseProduct(random_.normal_vector<3>()));
  }

  std::vector<Vector3> landmarks;  // in the map frame; five of each place

  SE3 base(int i) const {
    const double angle = 6.283185307179586 * i / bases_;
    return SE3(SO3::exp(Vector3(0, 0, angle)) * SO3::exp(Vector3(0.1, 0.05 * std::sin(i), 0)),
               radius_ * Vector3(std::cos(angle), std::sin(angle), 0.1 * std::cos(2 * angle)));
  }
  // The submap that begins at base(i): landmarks of its own place and some of the one before and of the one after.
  Submap submap(int i) {
    Ids ids;
    const int before = (i + bases_ - 1) % bases_, here = i % bases_, after = (i + 1) % bases_;
    for (const int k : {3, 4}) ids.push_back(static_cast<std::uint64_t>(5 * before + k));
    for (const int k : {0, 2, 3, 4}) ids.push_back(static_cast<std::uint64_t>(5 * here + k));
    ids.push_back(static_cast<std::uint64_t>(5 * after));
    return draw(base(i), base(i + 1), ids);
  }
  Submap draw(const SE3& from, const SE3& to, const Ids& ids) {
    Submap out;
    out.error = error_;
    out.ids = ids;
    out.counts.assign(ids.size(), 2);
    const auto n = static_cast<Index>(6 + 3 * ids.size());
    Matrix root(n, n + 3);
    for (Index k = 0; k < root.size(); ++k) root.data()[k] = random_.normal() / std::sqrt(n + 3.0);
    for (Index r = 0; r < n; ++r) root.row(r) *= r >= 3 && r < 6 ? noise_.turn : noise_.position;
    out.covariance = root * root.transpose();
    Vector draws(n + 3);
    for (Index k = 0; k < draws.size(); ++k) draws(k) = random_.normal();
    const Vector xi = root * draws;
    const Vector3 turn = xi.segment<3>(3);
    // Truth = Exp(xi) estimate.
    const auto estimate = [&](const Vector3& truth, const Vector3& e) -> Vector3 {
      if (error_ == ErrorKind::standard) return truth - e;
      return SO3::exp(-turn) * Vector3(truth - SO3::left_jacobian(turn) * e);
    };
    const SE3 T = from.inverse() * to;
    out.T_base_end = SE3(SO3::exp(-turn) * T.rotation(), estimate(T.translation(), xi.head<3>()));
    for (std::size_t k = 0; k < ids.size(); ++k)
      out.landmarks.push_back(
          estimate(from.inverse() * landmarks[ids[k]], xi.segment<3>(6 + 3 * static_cast<Index>(k))));
    return out;
  }
  MapOptions options() const {
    MapOptions options;
    options.cost_tolerance = 0.0;
    options.step_tolerance = 1e-6;  // by default small motions are not handed down, and the cost is that of a while ago
    options.error = error_;
    options.gate_probability = options.joint_gate_probability = 1.0 - 1e-9;
    options.initial_pose = base(0);
    options.initial_covariance.diagonal() << 1e-2, 1e-2, 1e-2, 1e-4, 1e-4, 1e-4;
    return options;
  }

 private:
  Random random_;
  ErrorKind error_;
  int bases_;
  double radius_;
  Noise noise_;
};

// All bases, then all landmarks by ascending id.
struct Reference {
  explicit Reference(const MapOptions& o, const std::vector<Submap>& submaps) : options(o) {
    bases.push_back(o.initial_pose);
    for (const Submap& submap : submaps) {
      std::vector<Index> all;
      for (Index i = 0; i < submap.size(); ++i) {
        all.push_back(i);
        landmarks.emplace(submap.ids[i], bases.back() * submap.landmarks[i]);
      }
      factors.emplace_back(std::make_shared<SubmapData>(submap), all);
      bases.push_back(bases.back() * submap.T_base_end);
    }
    Index at = states_of_bases();
    for (const auto& [id, position] : landmarks) {
      states[id] = at;
      at += 3;
    }
  }
  Index states_of_bases() const { return static_cast<Index>(6 * bases.size()); }
  Index size() const { return states_of_bases() + static_cast<Index>(3 * landmarks.size()); }
  FactorValues values(std::size_t i) const {
    FactorValues out{bases[i], bases[i + 1], {}};
    for (const std::uint64_t id : factors[i].data().ids) out.shared.push_back(landmarks.at(id));
    return out;
  }
  double cost() const {
    const Vector6 e = pose_error(bases[0], options.initial_pose);
    double sum = 0.5 * e.dot(Vector6(options.initial_covariance.ldlt().solve(e)));
    for (std::size_t i = 0; i < factors.size(); ++i) sum += factors[i].evaluate(values(i)).cost;
    return sum;
  }
  void linearise(Matrix& H, Vector& g) const {
    H = Matrix::Zero(size(), size());
    g = Vector::Zero(size());
    const Vector6 e = pose_error(bases[0], options.initial_pose);
    const Matrix6 prior = options.initial_covariance.inverse();
    Matrix6 J = Matrix6::Identity();
    J.bottomRightCorner<3, 3>() = SO3::left_jacobian_inverse(e.tail<3>());
    H.topLeftCorner<6, 6>() += J.transpose() * prior * J;
    g.head<6>() += J.transpose() * prior * e;
    for (std::size_t i = 0; i < factors.size(); ++i) {
      std::vector<Index> at;
      for (Index d = 0; d < 12; ++d) at.push_back(static_cast<Index>(6 * i) + d);
      for (const std::uint64_t id : factors[i].data().ids)
        for (Index d = 0; d < 3; ++d) at.push_back(states.at(id) + d);
      H(at, at) += whole_hessian(factors[i], values(i));
      g(at) += factors[i].evaluate(values(i)).gradient;
    }
  }
  void step(const Vector& x) {
    for (std::size_t i = 0; i < bases.size(); ++i)
      bases[i] = retract(bases[i], Vector6(x.segment<6>(static_cast<Index>(6 * i))));
    for (auto& [id, position] : landmarks) position += x.segment<3>(states.at(id));
  }
  // Levenberg-Marquardt.
  void solve() {
    double damping = 1e-3;
    for (int i = 0; i < 200; ++i) {
      Matrix H;
      Vector g;
      linearise(H, g);
      const Reference before = *this;
      Matrix damped = H;
      damped.diagonal() += damping * H.diagonal();
      const Vector x = damped.ldlt().solve(-g);
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
  Matrix covariance() const {
    Matrix H;
    Vector g;
    linearise(H, g);
    return H.ldlt().solve(Matrix::Identity(size(), size()));
  }

  MapOptions options;
  std::vector<SE3> bases;
  std::map<std::uint64_t, Vector3> landmarks;
  std::map<std::uint64_t, Index> states;
  std::vector<SubmapFactor> factors;
};

double difference(const Matrix& a, const Matrix& b) {
  return (a - b).norm() / (1e-300 + b.norm());
}

Vector3 position_of(const SparseMap& map, std::uint64_t id) {
  std::size_t index = 0;
  REQUIRE(map.find(id, index));
  return map.position(index);
}

// All that a map shows, to the bit.
std::vector<double> everything(const SparseMap& map) {
  std::vector<double> out{static_cast<double>(map.size()), static_cast<double>(map.submap_count()), map.cost()};
  const auto add = [&](const auto& values) { out.insert(out.end(), values.data(), values.data() + values.size()); };
  const auto add_pose = [&](const SE3& pose) {
    add(pose.translation());
    add(pose.rotation().quaternion().coeffs());
  };
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < map.size(); ++i) {
    all.push_back(i);
    out.push_back(static_cast<double>(map.id(i)));
    out.push_back(static_cast<double>(map.observations(i)));
    add(map.position(i));
    std::size_t index = 0;
    CHECK(map.find(map.id(i), index));
    CHECK(index == i);
  }
  map.prepare_covariances(all);
  for (const std::size_t i : all) add(map.covariance(i));
  Matrix joint(6 + 3 * map.size(), 6 + 3 * map.size());
  map.base_joint_covariance(all.data(), all.size(), joint.data());
  add(joint);
  add_pose(map.base());
  add(map.base_covariance());
  for (std::size_t i = 0; i < map.submap_count(); ++i) add_pose(map.submap_base(i));
  for (const std::size_t i : within(map, Vector3(5, 5, 0), 15)) out.push_back(static_cast<double>(i));
  return out;
}

}  // namespace

TEST_CASE("sparse map: the minimum of the whole problem") {
  for (const ErrorKind error : kKinds)
    for (const bool rough : {false, true}) {
      CAPTURE(rough);
      Ring ring(11, error, 8, 12, rough ? Noise{0.4, 0.06} : Noise{0.05, 0.004});
      SparseMap map(ring.options());
      std::vector<Submap> submaps;
      for (int i = 0; i < 18; ++i) {  // more than twice round
        submaps.push_back(ring.submap(i));
        const JoinReport report = map.join(submaps.back());
        CHECK(report.refused == 0);
        CHECK(report.fused + report.fresh == 7);
        CHECK(report.rows == 3 * report.fused);
        if (i != 6 && i != 11 && i != 17) continue;
        Reference reference(map.submap_count() > 0 ? ring.options() : MapOptions(), submaps);
        reference.solve();
        const double least = reference.cost();
        CHECK(map.cost() == doctest::Approx(least).epsilon(1e-6));
        REQUIRE(map.size() == reference.landmarks.size());
        for (const auto& [id, position] : reference.landmarks)
          CHECK((position_of(map, id) - position).norm() <= (rough ? 4e-3 : 5e-4));
        for (std::size_t k = 0; k < submaps.size(); ++k)
          CHECK((map.submap_base(k).translation() - reference.bases[k].translation()).norm() <= (rough ? 4e-3 : 5e-4));
      }
    }
}

TEST_CASE("sparse map: a loop closed far from its start") {
  for (const ErrorKind error : kKinds) {
    Ring ring(12, error, 24, 150, {0.1, 0.015});
    SparseMap map(ring.options());
    std::vector<Submap> submaps;
    double drift = 0.0;
    for (int i = 0; i < 34; ++i) {
      if (i == 23) drift = (map.base().translation() - ring.base(23).translation()).norm();
      submaps.push_back(ring.submap(i));
      const JoinReport report = map.join(submaps.back());
      CHECK(report.refused == 0);
      if (i == 23) CHECK(report.moved_max > 0.3 * drift);  // the start's landmarks are seen again
      if (i != 24 && i != 33) continue;
      // A closing may leave some of the way to the next one; not much, and not for good.
      Reference reference(ring.options(), submaps);
      reference.solve();
      const double settled = i == 33 ? 1e-6 : 1e-2;
      CHECK(map.cost() == doctest::Approx(reference.cost()).epsilon(settled));
      const double sigma = std::sqrt(reference.covariance().block<3, 3>(6 * i + 6, 6 * i + 6).trace());
      CHECK((map.base().translation() - reference.bases.back().translation()).norm() <= (i == 33 ? 0.01 : 0.2) * sigma);
      if (i != 33) continue;
      const Matrix P = reference.covariance();
      const Index newest = reference.states_of_bases() - 6;
      CHECK(difference(map.base_covariance(), P.block<6, 6>(newest, newest)) <= 0.1);  // of older linearisations
    }
    CHECK(drift > 1.0);
  }
}

TEST_CASE("sparse map: what is carried along in a long loop lands where it would be led step by step") {
  for (const ErrorKind error : kKinds) {
    Ring ring(19, error, 160, 300, {0.05, 0.004});
    MapOptions options = ring.options(), exact = options;
    options.step_tolerance = MapOptions().step_tolerance;
    options.cost_tolerance = MapOptions().cost_tolerance;
    exact.most_iterations = 30;
    SparseMap map(options), twin(options), reference(exact);
    std::size_t carried = 0;
    double moved = 0.0;
    for (int i = 0; i < 200; ++i) {
      const Submap submap = ring.submap(i);
      Submap wrong = submap, without = submap;
      if (i >= 160 && i % 8 == 0) {  // is taken in, then taken back, then taken in without the one that does not fit
        wrong.landmarks[2] += Vector3(0, 0, 5);
        without = wrong;
        constexpr std::ptrdiff_t at = 2;
        without.ids.erase(without.ids.begin() + at);
        without.counts.erase(without.counts.begin() + at);
        without.landmarks.erase(without.landmarks.begin() + at);
        std::vector<Index> kept;
        for (Index k = 0; k < submap.covariance.rows(); ++k)
          if (k < 12 || k >= 15) kept.push_back(k);
        without.covariance = submap.covariance(kept, kept);
      }
      const JoinReport report = map.join(wrong);
      CHECK(report.refused == (wrong.landmarks == submap.landmarks ? 0 : 1));
      twin.join(without);
      reference.join(without);
      carried += report.carried;
      moved = std::max(moved, report.moved_max);
    }
    CHECK(carried > 1000);
    CHECK(moved > 5.0);
    const double sigma = std::sqrt(reference.base_covariance().topLeftCorner<3, 3>().trace());
    CAPTURE(sigma);
    for (std::size_t k = 0; k <= 200; k += 10) {
      CHECK((map.submap_base(k).translation() - twin.submap_base(k).translation()).norm() <= 1e-9);
      CHECK((map.submap_base(k).translation() - reference.submap_base(k).translation()).norm() <= 0.01 * sigma);
    }
    for (std::size_t i = 0; i < map.size(); ++i) {
      CHECK((map.position(i) - position_of(twin, map.id(i))).norm() <= 1e-9);
      CHECK((map.position(i) - position_of(reference, map.id(i))).norm() <= 0.01 * sigma);
    }
  }
}

TEST_CASE("sparse map: covariances are the whole problem's") {
  for (const ErrorKind error : kKinds) {
    Ring ring(13, error, 8, 12, {0.01, 4e-4});
    MapOptions options = ring.options();
    options.initial_covariance *= 1e-4;
    SparseMap map(options);
    std::vector<Submap> submaps;
    for (int i = 0; i < 12; ++i) {
      submaps.push_back(ring.submap(i));
      map.join(submaps.back());
      if (i != 0 && i != 5 && i != 11) continue;
      Reference reference(options, submaps);
      reference.solve();
      const Matrix P = reference.covariance();
      std::vector<std::size_t> indices;
      std::vector<Index> at;
      const Index newest = reference.states_of_bases() - 6;
      for (Index d = 0; d < 6; ++d) at.push_back(newest + d);
      for (std::size_t k = 0; k < map.size(); k += 2) {  // private ones and shared ones
        indices.push_back(map.size() - 1 - k);
        for (Index d = 0; d < 3; ++d) at.push_back(reference.states.at(map.id(indices.back())) + d);
      }
      const Matrix expected = P(at, at);
      Matrix joint(expected.rows(), expected.cols());
      map.base_joint_covariance(indices.data(), indices.size(), joint.data());
      CHECK(difference(joint, expected) <= 5e-3);
      CHECK(joint == Matrix(joint.transpose()));
      CHECK(difference(map.base_covariance(), expected.topLeftCorner<6, 6>()) <= 5e-3);
      Matrix landmarks(expected.rows() - 6, expected.cols() - 6);
      map.joint_covariance(indices.data(), indices.size(), landmarks.data());
      CHECK(landmarks == Matrix(joint.bottomRightCorner(landmarks.rows(), landmarks.cols())));
      for (std::size_t k = 0; k < indices.size(); ++k) {
        const auto row = static_cast<Index>(6 + 3 * k);
        CHECK(difference(map.covariance(indices[k]), joint.block<3, 3>(row, row)) <= 1e-9);
      }
    }
  }
}

TEST_CASE("sparse map: a landmark that contradicts the map is left out, and it alone") {
  for (const ErrorKind error : kKinds) {
    Ring ring(14, error, 8, 12, {0.05, 0.004});
    SparseMap map(ring.options());
    for (int i = 0; i < 9; ++i) map.join(ring.submap(i));
    SparseMap without(map);
    Submap good = ring.submap(9), bad = good, poor;
    const std::uint64_t liar = bad.ids[3];
    bad.landmarks[3] += Vector3(2, -1, 1);
    const Vector3 before = position_of(map, liar);
    const JoinReport report = map.join(bad);
    CHECK(report.refused == 1);
    CHECK(report.fused == 6);
    CHECK(report.rows == 18);
    CHECK(report.distance <= report.threshold);
    CHECK((position_of(map, liar) - before).norm() <= 0.05);
    // Equal to a submap that never saw it.
    poor = good;
    std::vector<Index> kept;
    for (Index k = 0; k < 6 + 21; ++k)
      if (k < 6 + 9 || k >= 6 + 12) kept.push_back(k);
    poor.covariance = Matrix(good.covariance(kept, kept));
    poor.ids.erase(poor.ids.begin() + 3);
    poor.counts.erase(poor.counts.begin() + 3);
    poor.landmarks.erase(poor.landmarks.begin() + 3);
    CHECK(without.join(poor).refused == 0);
    CHECK(map.cost() == doctest::Approx(without.cost()).epsilon(1e-6));
    for (std::size_t k = 0; k < map.size(); ++k)
      CHECK((map.position(k) - position_of(without, map.id(k))).norm() <= 1e-4);
    CHECK(map.join(ring.submap(10)).refused == 0);  // and the map goes on
  }
}

TEST_CASE("sparse map: a submap that can't be taken in changes nothing") {
  for (const ErrorKind error : kKinds) {
    Ring ring(15, error, 8, 12, {0.05, 0.004});
    MapOptions options = ring.options();
    options.max_landmarks = 40;
    SparseMap map(options), twin(options);
    for (int i = 0; i < 11; ++i) {
      const Submap submap = ring.submap(i);
      const std::vector<double> before = everything(map);
      Submap crowd = submap;  // more than there is room for
      Ring strangers(16, error, 24, 12, {0.05, 0.004});
      Ids ids = submap.ids;
      for (std::uint64_t id = 60; id < 101; ++id) ids.push_back(id);
      crowd = strangers.draw(ring.base(i), ring.base(i + 1), ids);
      CHECK_THROWS_AS(map.join(crowd), Error);
      CHECK(everything(map) == before);
      Submap broken = submap;
      broken.covariance(1, 1) = -1;
      CHECK_THROWS_AS(map.join(broken), Error);
      CHECK(everything(map) == before);
      map.join(submap);
      twin.join(submap);
      CHECK(everything(map) == everything(twin));  // the same bits as if nothing had been
    }
  }
}

TEST_CASE("sparse map: a copy is a map of its own") {
  Ring ring(17, ErrorKind::invariant, 8, 12, {0.05, 0.004});
  SparseMap map(ring.options());
  for (int i = 0; i < 6; ++i) map.join(ring.submap(i));
  const std::vector<double> before = everything(map);
  SparseMap copy(map);
  CHECK(everything(copy) == before);
  const Submap next = ring.submap(6);
  copy.join(next);
  CHECK(everything(map) == before);
  map.join(next);
  CHECK(everything(map) == everything(copy));
}

TEST_CASE("sparse map: a landmark removed is gone, and what it taught stays") {
  Ring ring(18, ErrorKind::invariant, 8, 12, {0.05, 0.004});
  SparseMap map(ring.options());
  for (int i = 0; i < 9; ++i) map.join(ring.submap(i));
  const std::size_t size = map.size();
  const double cost = map.cost();
  const std::uint64_t gone[] = {map.id(3), map.id(size - 1)};
  std::size_t index = 0;
  REQUIRE(map.find(map.id(5), index));
  const Matrix3 kept = map.covariance(index);
  const std::uint64_t witness = map.id(5);
  for (const std::uint64_t id : gone) map.remove(id);
  map.remove(4711);
  CHECK(map.size() == size - 2);
  CHECK(map.cost() == cost);
  for (const std::uint64_t id : gone) CHECK(!map.find(id, index));
  REQUIRE(map.find(witness, index));
  CHECK(map.covariance(index) == kept);
  everything(map);  // checks that ids and indices agree
  CHECK(within(map, Vector3::Zero(), 1e6).size() == size - 2);
  // Seen again it is a new landmark.
  const JoinReport report = map.join(ring.submap(9));
  CHECK(report.refused == 0);
  CHECK(report.fresh + report.fused == 7);
  everything(map);
}
