// SPDX-License-Identifier: BSD-3-Clause
// Association compared with exhaustive search, with joint distances from a dense factor of the whole covariance.
#include "association/association.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "association/frame_index.hpp"
#include "core/chi_square.hpp"
#include "numerical.hpp"

namespace {

using namespace cairn;
using cairn::test::Random;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// Observations z of predictions h with joint covariance P and independent noise R.
class Scene final : public Innovations {
 public:
  Index k = 1;  // rows
  Vector z, h;
  Matrix P, R;
  double probability = 0.99;
  std::vector<PairCandidate> candidates;

  Index observations() const { return z.size() / k; }
  Index landmarks() const { return h.size() / k; }
  Index rows() const override { return k; }
  void innovation(Index c, double* nu) const override {
    Eigen::Map<Vector>(nu, k) = nu_of(candidates[static_cast<std::size_t>(c)]);
  }
  void covariance(Index a, Index b, double* block) const override {
    Eigen::Map<Matrix>(block, k, k) =
        covariance_of(candidates[static_cast<std::size_t>(a)], candidates[static_cast<std::size_t>(b)]);
  }
  double threshold(Index rows_of_all) const override {
    return chi_square_quantile(static_cast<double>(rows_of_all), probability);
  }
  Vector nu_of(const PairCandidate& c) const { return z.segment(k * c.observation, k) - h.segment(k * c.landmark, k); }
  Matrix covariance_of(const PairCandidate& a, const PairCandidate& b) const {
    Matrix S = P.block(k * a.landmark, k * b.landmark, k, k);
    if (a.observation == b.observation) S += R;
    return S;
  }
  // All pairs that pass the individual gate, in the order of their numbers.
  void gate() {
    candidates.clear();
    for (Index o = 0; o < observations(); ++o)
      for (Index l = 0; l < landmarks(); ++l) {
        PairCandidate c{o, l, 0.0};
        c.distance = nu_of(c).dot(covariance_of(c, c).ldlt().solve(nu_of(c)));
        if (c.distance <= threshold(k)) candidates.push_back(c);
      }
  }
  double distance(const std::vector<Index>& set) const {
    const auto n = static_cast<Index>(set.size());
    Matrix S(k * n, k * n);
    Vector nu(k * n);
    for (Index i = 0; i < n; ++i) {
      const PairCandidate& a = candidates[static_cast<std::size_t>(set[static_cast<std::size_t>(i)])];
      nu.segment(k * i, k) = nu_of(a);
      for (Index j = 0; j < n; ++j)
        S.block(k * i, k * j, k, k) =
            covariance_of(a, candidates[static_cast<std::size_t>(set[static_cast<std::size_t>(j)])]);
    }
    return nu.dot(S.ldlt().solve(nu));
  }
};

struct Solver {
  explicit Solver(const Scene& scene)
      : arena(bytes(scene)), association(arena, capacity(scene)), count(static_cast<Index>(scene.candidates.size())) {}
  static Association::Capacity capacity(const Scene& scene) {
    return {scene.observations(), static_cast<Index>(scene.candidates.size()), scene.landmarks()};
  }
  static std::size_t bytes(const Scene& scene) {
    Arena measure;
    Association(measure, capacity(scene));
    return measure.used();
  }
  Arena arena;
  Association association;
  Index count;
};

// Every set that the rule allows, one after another.
struct Exhaustive {
  const Scene& scene;
  std::vector<Index> order, set, best;
  std::vector<char> taken;
  double best_distance = 0.0;

  explicit Exhaustive(const Scene& s) : scene(s), taken(static_cast<std::size_t>(s.landmarks()), 0) {
    std::vector<Index> counts(static_cast<std::size_t>(s.observations()), 0);
    for (const PairCandidate& c : s.candidates) ++counts[static_cast<std::size_t>(c.observation)];
    for (Index o = 0; o < s.observations(); ++o) order.push_back(o);
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
      return counts[static_cast<std::size_t>(a)] < counts[static_cast<std::size_t>(b)];
    });
    descend(0);
  }
  void descend(std::size_t depth) {
    if (depth == order.size()) {
      const double distance = set.empty() ? 0.0 : scene.distance(set);
      if (set.size() > best.size() || (set.size() == best.size() && distance < best_distance)) {
        best = set;
        best_distance = distance;
      }
      return;
    }
    for (std::size_t c = 0; c < scene.candidates.size(); ++c) {
      const PairCandidate& candidate = scene.candidates[c];
      if (candidate.observation != order[depth] || taken[static_cast<std::size_t>(candidate.landmark)] != 0) continue;
      set.push_back(static_cast<Index>(c));
      if (scene.distance(set) <= scene.threshold(scene.k * static_cast<Index>(set.size()))) {
        taken[static_cast<std::size_t>(candidate.landmark)] = 1;
        descend(depth + 1);
        taken[static_cast<std::size_t>(candidate.landmark)] = 0;
      }
      set.pop_back();
    }
    descend(depth + 1);
  }
};

// Landmarks close together. The error of the vehicle is common to all of them.
Scene crowd(unsigned seed, Index rows, Index observations, Index landmarks, double spread, double common) {
  Random random(seed);
  Scene scene;
  scene.k = rows;
  const Index n = rows * landmarks;
  const auto normals = [&](Index count) {
    Vector x(count);
    for (Index i = 0; i < count; ++i) x(i) = random.normal();
    return x;
  };
  scene.h = spread * normals(n);
  Matrix root(n, n + rows);
  for (Index c = 0; c < n; ++c) root.col(c) = 0.3 / std::sqrt(static_cast<double>(n)) * normals(n);
  root.rightCols(rows) = common * Matrix::Identity(rows, rows).replicate(landmarks, 1);
  scene.P = root * root.transpose();
  scene.R = 0.01 * Matrix::Identity(rows, rows);
  const Vector truth = scene.h + root * normals(n + rows);
  scene.z.resize(rows * observations);
  for (Index o = 0; o < observations; ++o) {
    const bool known = o < landmarks && o % 4 != 3;  // the others are new
    scene.z.segment(rows * o, rows) =
        (known ? Vector(truth.segment(rows * o, rows)) : Vector(spread * normals(rows))) + 0.1 * normals(rows);
  }
  scene.gate();
  return scene;
}

constexpr Index kPlenty = 1000000;

}  // namespace

TEST_CASE("association: pairs that pass alone but contradict each other are not both accepted") {
  Scene scene;
  scene.h = Eigen::Vector2d(0, 100);
  scene.P = (Matrix(2, 2) << 1, 0.99, 0.99, 1).finished();
  scene.R = Matrix::Zero(1, 1);
  scene.z = Eigen::Vector2d(2.5, 97.5);
  scene.gate();
  REQUIRE(scene.candidates.size() == 2);
  CHECK(scene.candidates[0].distance == doctest::Approx(6.25));
  Solver solver(scene);
  Association& association = solver.association;
  association.nearest_neighbour(scene.candidates.data(), 2, 2);
  CHECK(association.pairs() == 2);
  association.joint_compatibility(scene.candidates.data(), 2, 2, scene, kPlenty);
  CHECK(association.pairs() == 1);
  CHECK((association.chosen(0) == kUnpaired) != (association.chosen(1) == kUnpaired));
  CHECK(association.distance() == doctest::Approx(6.25));
  CHECK(scene.distance({0, 1}) > 1000.0);
}

TEST_CASE("association: joint compatibility finds what exhaustive search finds") {
  std::size_t ambiguous = 0, left_out = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    const Index rows = 1 + seed % 3;
    const Scene scene = crowd(seed, rows, 6, 8, rows == 1 ? 6.0 : 1.5, seed % 2 == 0 ? 0.8 : 0.1);
    Solver solver(scene);
    solver.association.joint_compatibility(scene.candidates.data(), solver.count, 6, scene, kPlenty);
    const Exhaustive reference(scene);
    std::vector<Index> chosen;
    for (const Index o : reference.order)
      if (solver.association.chosen(o) != kUnpaired) chosen.push_back(solver.association.chosen(o));
    CHECK(chosen == reference.best);
    CHECK(solver.association.pairs() == static_cast<Index>(reference.best.size()));
    CHECK(solver.association.distance() == doctest::Approx(reference.best_distance));
    CHECK(!solver.association.exhausted());
    ambiguous += solver.count > 8 ? 1 : 0;
    left_out += reference.best.size() < 6 ? 1 : 0;
  }
  CHECK(ambiguous > 20);
  CHECK(left_out > 20);
}

TEST_CASE("association: nearest neighbour matches a landmark at most once, with the nearest observation") {
  // Observations 0 and 1 are both nearest to landmark 0. Observation 1 gets it, 0 gets its second candidate, 2 gets
  // none.
  const std::vector<PairCandidate> candidates{{0, 0, 2.0}, {0, 1, 3.0}, {1, 0, 1.0}, {2, 1, 3.0}};
  Scene scene;
  scene.z = Vector::Zero(3);
  scene.h = Vector::Zero(2);
  scene.candidates = candidates;
  Solver solver(scene);
  solver.association.nearest_neighbour(candidates.data(), 4, 3);
  CHECK(solver.association.chosen(0) == 1);
  CHECK(solver.association.chosen(1) == 2);
  CHECK(solver.association.chosen(2) == kUnpaired);
  CHECK(solver.association.pairs() == 2);
  CHECK(solver.association.distance() == 4.0);
  CHECK(solver.association.nodes() == 0);
}

TEST_CASE("association: a search that hits the limit reports it and returns a compatible set") {
  std::size_t exhausted = 0, worse = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    const Scene scene = crowd(seed, 2, 14, 30, 0.7, 1.0);
    Solver solver(scene);
    Association& association = solver.association;
    association.joint_compatibility(scene.candidates.data(), solver.count, 14, scene, kPlenty);
    const Index most = association.pairs();
    for (const Index budget : {0, 10, 100, 1000}) {
      association.joint_compatibility(scene.candidates.data(), solver.count, 14, scene, budget);
      CHECK(association.pairs() <= most);
      // A descent that has begun is finished.
      CHECK(association.nodes() <= budget + solver.count);
      exhausted += association.exhausted() ? 1 : 0;
      worse += association.pairs() < most ? 1 : 0;
      std::vector<Index> chosen;
      std::vector<char> taken(30, 0);
      for (Index o = 0; o < 14; ++o) {
        const Index c = association.chosen(o);
        if (c == kUnpaired) continue;
        chosen.push_back(c);
        CHECK(scene.candidates[static_cast<std::size_t>(c)].observation == o);
        char& mark = taken[static_cast<std::size_t>(scene.candidates[static_cast<std::size_t>(c)].landmark)];
        CHECK(mark == 0);
        mark = 1;
      }
      CHECK(static_cast<Index>(chosen.size()) == association.pairs());
      if (chosen.empty()) continue;
      CHECK(scene.distance(chosen) == doctest::Approx(association.distance()));
      CHECK(association.distance() <= scene.threshold(2 * association.pairs()));
    }
  }
  CHECK(exhausted > 10);
  CHECK(worse > 0);
}

TEST_CASE("association: nothing to pair, and innovations without a covariance") {
  Scene scene;
  scene.z = Vector::Zero(3);
  scene.h = Vector::Zero(2);
  Solver none(scene);
  none.association.joint_compatibility(nullptr, 0, 3, scene, kPlenty);
  CHECK(none.association.pairs() == 0);
  CHECK(none.association.chosen(2) == kUnpaired);
  none.association.nearest_neighbour(nullptr, 0, 0);
  CHECK(none.association.pairs() == 0);

  scene.P = Matrix::Ones(2, 2);  // the second one adds no information: its pivot is zero
  scene.R = Matrix::Zero(1, 1);
  scene.candidates = {{0, 0, 0.0}, {1, 1, 0.0}};
  Solver singular(scene);
  singular.association.joint_compatibility(scene.candidates.data(), 2, 3, scene, kPlenty);
  CHECK(singular.association.pairs() == 1);
  scene.P(0, 0) = std::numeric_limits<double>::quiet_NaN();
  singular.association.joint_compatibility(scene.candidates.data(), 2, 3, scene, kPlenty);
  CHECK(singular.association.pairs() == 1);
  CHECK(singular.association.chosen(0) == kUnpaired);
}

TEST_CASE("association: the frame index finds the same observations as a scan") {
  Random random(11);
  Arena measure;
  const FrameIndex unused(measure, 40);
  Arena arena(measure.used());
  FrameIndex index(arena, 40);
  for (Index count : {0, 1, 2, 7, 40})
    for (int repeat = 0; repeat < 50; ++repeat) {
      std::vector<double> values;
      for (Index i = 0; i < count; ++i) values.push_back(std::floor(random.uniform(0, 20)));  // many equal values
      index.build(count, [&](Index i) { return values[static_cast<std::size_t>(i)]; });
      const double centre = std::floor(random.uniform(-2, 22));
      for (double reach : {0.0, 1.0, 3.5, std::numeric_limits<double>::infinity()}) {
        std::vector<Index> found, expected;
        index.near(centre, reach, [&](Index i) { found.push_back(i); });
        for (Index i = 0; i < count; ++i)
          if (std::abs(values[static_cast<std::size_t>(i)] - centre) <= reach) expected.push_back(i);
        std::sort(found.begin(), found.end());
        CHECK(found == expected);
      }
    }
}
