// SPDX-License-Identifier: BSD-3-Clause
// The dense merge against a batch solution that does not use its closed form; ids, gates and refusals.
#include "map/merge/merge.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "map/dense_landmarks.hpp"
#include "map/join/dense/dense_map.hpp"
#include "map/join/sparse/sparse_map.hpp"
#include "map/owned_map.hpp"
#include "numerical.hpp"

using namespace cairn;
using cairn::test::Random;

namespace {

using Eigen::Index;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

Index at(std::size_t i) {
  return 3 * static_cast<Index>(i);
}

struct Plain final : Landmarks {
  std::vector<std::uint64_t> ids;
  std::vector<Vector3> points;
  Matrix P;
  std::size_t size() const override { return ids.size(); }
  std::uint64_t id(std::size_t i) const override { return ids[i]; }
  std::uint64_t observations(std::size_t i) const override { return 10 + i; }
  Vector3 position(std::size_t i) const override { return points[i]; }
  Matrix3 covariance(std::size_t i) const override { return P.block<3, 3>(at(i), at(i)); }
  bool find(std::uint64_t wanted, std::size_t& index) const override {
    for (index = 0; index < ids.size(); ++index)
      if (ids[index] == wanted) return true;
    return false;
  }
  void joint_covariance(const std::size_t* indices, std::size_t count, double* matrix) const override {
    for (std::size_t c = 0; c < count; ++c)
      for (std::size_t r = 0; r < count; ++r)
        Eigen::Map<Matrix>(matrix, at(count), at(count)).block<3, 3>(at(r), at(c)) =
            P.block<3, 3>(at(indices[r]), at(indices[c]));
  }
};

// A map of these points, with common errors (an uncertain frame) and with independent errors.
Plain map_of(Random& random, const std::vector<std::uint64_t>& ids, const std::vector<Vector3>& truth, double own,
             double common) {
  Plain map;
  map.ids = ids;
  const Index n = at(ids.size());
  Matrix root = Matrix::Zero(n, n + 6);
  for (Index i = 0; i < n; i += 3) {
    for (Index c = 0; c < 3; ++c) root.block<3, 1>(i, i + c) = own * random.normal_vector<3>();
    root.block<3, 3>(i, n) = common * Matrix3::Identity();
    root.block<3, 3>(i, n + 3) = 0.02 * common * hat(truth[static_cast<std::size_t>(i / 3)]);
  }
  map.P = root * root.transpose() + 1e-3 * own * own * Matrix::Identity(n, n);
  Vector noise(n);
  for (Index i = 0; i < n; ++i) noise[i] = random.normal();
  noise = map.P.llt().matrixL() * noise;
  for (std::size_t i = 0; i < ids.size(); ++i) map.points.push_back(truth[i] + noise.segment<3>(at(i)));
  return map;
}

struct Scene {
  SE3 T_map_other;
  Plain map, other;
  std::vector<Vector3> truth_map, truth_other;  // each in its own frame

  Scene(unsigned seed, std::size_t only_map, std::size_t common, std::size_t only_other) {
    Random random(seed);
    T_map_other = SE3(SO3::exp(2.0 * random.normal_vector<3>().normalized()), 20 * random.normal_vector<3>());
    std::vector<std::uint64_t> in_map, in_other;
    for (std::size_t i = 0; i < only_map + common + only_other; ++i) {
      const Vector3 x(15 * random.normal(), 15 * random.normal(), 4 * random.normal());
      if (i < only_map + common) in_map.push_back(100 - i), truth_map.push_back(x);
      if (i >= only_map) in_other.push_back(100 - i), truth_other.push_back(T_map_other.inverse() * x);
    }
    map = map_of(random, in_map, truth_map, 0.05, 0.1);
    other = map_of(random, in_other, truth_other, 0.05, 0.1);
  }
};

// Gauss-Newton on [all landmarks in the map's frame; T] with both maps as observations and the prior as a third.
struct Batch {
  std::vector<std::uint64_t> ids;
  Vector x;
  SE3 T;
  Matrix covariance;  // of [x; T]

  Batch(const Plain& map, const Plain& other, const SE3& start, const TransformPrior* prior) : T(start) {
    ids = map.ids;
    for (const std::uint64_t id : other.ids)
      if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
    const Index n = at(ids.size()), a = at(map.size()), b = at(other.size());
    x.resize(n);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      std::size_t j = 0;
      if (map.find(ids[i], j))
        x.segment<3>(at(i)) = map.points[j];
      else if (other.find(ids[i], j))
        x.segment<3>(at(i)) = T * other.points[j];
    }
    Matrix W = Matrix::Zero(a + b, a + b);
    W.topLeftCorner(a, a) = map.P.llt().solve(Matrix::Identity(a, a));
    W.bottomRightCorner(b, b) = other.P.llt().solve(Matrix::Identity(b, b));
    for (int iteration = 0; iteration < 30; ++iteration) {
      Matrix J = Matrix::Zero(a + b, n + 6);
      Vector r(a + b);
      for (std::size_t i = 0; i < ids.size(); ++i) {
        const Vector3 p = x.segment<3>(at(i));
        std::size_t j = 0;
        if (map.find(ids[i], j)) {
          J.block<3, 3>(at(j), at(i)).setIdentity();
          r.segment<3>(at(j)) = map.points[j] - p;
        }
        if (other.find(ids[i], j)) {
          const Matrix3 R = T.rotation().matrix();
          J.block<3, 3>(a + at(j), at(i)) = R.transpose();
          J.block<3, 3>(a + at(j), n) = -R.transpose();
          J.block<3, 3>(a + at(j), n + 3) = R.transpose() * hat(Vector3(p - T.translation()));
          r.segment<3>(a + at(j)) = other.points[j] - T.inverse() * p;
        }
      }
      Matrix H = J.transpose() * W * J;
      Vector g = J.transpose() * W * r;
      if (prior != nullptr) {
        const Vector6 e = pose_error(T, prior->T_a_b);
        Matrix6 by_T = Matrix6::Identity();
        by_T.bottomRightCorner<3, 3>() = SO3::left_jacobian_inverse(e.tail<3>());
        const Matrix6 information = prior->covariance.inverse();
        H.bottomRightCorner<6, 6>() += by_T.transpose() * information * by_T;
        g.tail<6>() -= by_T.transpose() * information * e;
      }
      const Eigen::LDLT<Matrix> solver(H);
      const Vector step = solver.solve(g);
      x += step.head(n);
      T = retract(T, Vector6(step.tail<6>()));
      covariance = solver.solve(Matrix::Identity(n + 6, n + 6));
    }
  }
};

void compare(const Scene& scene, const TransformPrior* prior) {
  MergeOptions options;
  options.gate_probability = options.joint_gate_probability = 1.0;
  if (prior != nullptr) options.prior = *prior;
  MergeReport report;
  const OwnedMap map(scene.map, {1});
  const OwnedMap merged(map, scene.other, {2}, options, report);
  const Landmarks& both = *merged.landmarks;
  const Batch batch(scene.map, scene.other, scene.T_map_other, prior);
  REQUIRE(both.size() == batch.ids.size());
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < batch.ids.size(); ++i) {
    std::size_t j = 0;
    REQUIRE(both.find(batch.ids[i], j));
    indices.push_back(j);
    CHECK((both.position(j) - batch.x.segment<3>(at(i))).norm() < 1e-9);
  }
  const Index n = at(both.size());
  Matrix P(n, n);
  both.joint_covariance(indices.data(), indices.size(), P.data());
  const Matrix expected = batch.covariance.topLeftCorner(n, n);
  CHECK((P - expected).norm() < 1e-9 * expected.norm());
  CHECK(P == P.transpose());
  CHECK(pose_error(batch.T, report.T_map_other).norm() < 1e-9);
  const Matrix6 C = batch.covariance.bottomRightCorner<6, 6>();
  CHECK((report.covariance - C).norm() < 1e-9 * C.norm());
}

ErrorCode refusal(const Scene& scene, const MergeOptions& options, MergeReport& report) {
  const OwnedMap map(scene.map, {1});
  try {
    const OwnedMap merged(map, scene.other, {2}, options, report);
  } catch (const Error& error) {
    return error.code();
  }
  FAIL("merged");
  return ErrorCode::state;
}

}  // namespace

TEST_CASE("dense merge: equal to the batch solution of both maps, the transform unknown") {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    CAPTURE(seed);
    compare(Scene(seed, 3 + seed, 3 + 2 * seed, seed), nullptr);
  }
  compare(Scene(7, 0, 6, 5), nullptr);  // no landmark that only the map holds
  compare(Scene(8, 5, 6, 0), nullptr);  // no landmark to add
}

TEST_CASE("dense merge: equal to the batch solution of both maps, the transform known in part") {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    const Scene scene(20 + seed, 4, seed, 4);  // sometimes fewer common landmarks than the transform needs
    Random random(40 + seed);
    Matrix6 root = 0.1 * Matrix6::Identity();
    for (int c = 0; c < 6; ++c) root.col(c) += 0.05 * random.normal_vector<6>();
    const TransformPrior prior{retract(scene.T_map_other, Vector6(root * random.normal_vector<6>())),
                               root * root.transpose()};
    compare(scene, &prior);
  }
}

TEST_CASE("dense merge: a transform that is known exactly moves nothing of itself") {
  const Scene scene(30, 4, 2, 4);
  MergeOptions options;
  options.prior = TransformPrior{scene.T_map_other, Matrix6::Zero()};
  MergeReport report;
  const OwnedMap map(scene.map, {1});
  const OwnedMap merged(map, scene.other, {2}, options, report);
  CHECK(pose_error(scene.T_map_other, report.T_map_other).norm() == 0.0);
  CHECK(report.rows == 6);
  CHECK(report.common == 2);
  CHECK(report.added == 4);
  CHECK(merged.landmarks->size() == 10);
}

TEST_CASE("merge: a landmark that moved is named, and by how far it breaks which bound") {
  Scene scene(50, 5, 12, 5);
  scene.other.points[4] += Vector3(0, 0, 3);
  MergeReport report;
  CHECK(refusal(scene, MergeOptions(), report) == ErrorCode::numerical);
  CHECK(report.broken_id == scene.other.ids[4]);
  CHECK(report.broken_other_id == scene.other.ids[4]);
  CHECK(report.distance > report.threshold);
  CHECK(report.common == 12);
  CHECK(report.rows == 30);
}

TEST_CASE("merge: too few common landmarks, and such on a line") {
  MergeReport report;
  CHECK(refusal(Scene(60, 5, 0, 5), MergeOptions(), report) == ErrorCode::not_found);
  CHECK(refusal(Scene(61, 5, 2, 5), MergeOptions(), report) == ErrorCode::not_found);
  CHECK(report.common == 2);
  Scene line(62, 0, 6, 0);
  for (std::size_t i = 0; i < 6; ++i) {
    line.map.points[i] = Vector3(static_cast<double>(i), 0, 0) + 0.2 * (line.map.points[i] - line.truth_map[i]);
    line.other.points[i] = Vector3(static_cast<double>(i), 0, 0) + 0.2 * (line.other.points[i] - line.truth_other[i]);
  }
  CHECK(refusal(line, MergeOptions(), report) == ErrorCode::numerical);
  MergeOptions small;
  small.max_landmarks = 14;
  CHECK(refusal(Scene(63, 5, 5, 5), small, report) == ErrorCode::capacity);
}

TEST_CASE("merge by geometry: paired ones take the map's id, others keep theirs or get a free one") {
  Scene scene(70, 10, 25, 10);
  // The ids of the other map: the map uses some of them for other landmarks, and one is the largest possible id.
  std::vector<std::uint64_t> before = scene.other.ids;
  for (std::size_t j = 0; j < before.size(); ++j) scene.other.ids[j] = 1000 + j;
  scene.other.ids[26] = 100, scene.other.ids[33] = 99;
  for (const bool at_the_end : {false, true}) {
    if (at_the_end) scene.other.ids[28] = UINT64_MAX - 1;
    MergeOptions options;
    options.by_geometry = true;
    MergeReport report;
    const OwnedMap map(scene.map, {1});
    const OwnedMap merged(map, scene.other, {2}, options, report);
    REQUIRE(report.common == 25);
    CHECK(merged.landmarks->size() == 45);
    REQUIRE(merged.merged.size() == 35);
    for (const MergedId& m : merged.merged) {
      std::size_t j = 0, found = 0;
      REQUIRE(scene.other.find(m.other_id, j));
      CHECK(m.common == (j < 25));
      REQUIRE(merged.landmarks->find(m.id, found));
      if (m.common) CHECK(m.id == before[j]);
      if (j == 33) CHECK(m.id == (at_the_end ? 0 : 1035));  // 99 comes before 100
      if (j == 26) CHECK(m.id == (at_the_end ? 1 : 1036));
      if (j >= 25 && j != 26 && j != 33) CHECK(m.id == m.other_id);
      const Vector3 truth = scene.T_map_other * scene.truth_other[j];
      CHECK((merged.landmarks->position(found) - truth).norm() < 1.5);
    }
  }
}

TEST_CASE("merge by geometry: a regular planting says nothing of which landmark is which") {
  Scene lattice(80, 0, 36, 0);
  for (std::size_t i = 0; i < 36; ++i) {
    const Vector3 x(5.0 * static_cast<double>(i % 6), 5.0 * static_cast<double>(i / 6), 0);
    lattice.map.points[i] = x + 0.1 * (lattice.map.points[i] - lattice.truth_map[i]);
    lattice.other.points[i] = x + 0.1 * (lattice.other.points[i] - lattice.truth_other[i]);
  }
  MergeOptions options;
  options.by_geometry = true;
  MergeReport report;
  CHECK(refusal(lattice, options, report) == ErrorCode::numerical);
  const OwnedMap map(lattice.map, {1});
  CHECK_THROWS_WITH(OwnedMap(map, lattice.other, {2}, options, report), doctest::Contains("two transforms fit alike"));
}

TEST_CASE("merge: pairs beyond those that are tested jointly are tested each by itself") {
  Scene scene(90, 5, 40, 5);
  MergeReport report;
  const MergePlan all = plan_merge(scene.map, scene.other, MergeOptions(), 1000, report);
  const MergePlan some = plan_merge(scene.map, scene.other, MergeOptions(), 10, report);
  CHECK(report.rows == 24);
  CHECK(report.common == 40);
  CHECK(some.pairs == all.pairs);
  CHECK(some.ids == all.ids);
  const Vector6 apart = pose_error(some.alignment.T_a_b, all.alignment.T_a_b);
  CHECK(apart.dot(some.alignment.covariance.ldlt().solve(apart)) < 30.0);
  CHECK(apart.norm() > 0.0);
  // The draw takes the pairs 0, 4, 8, 13, 17, 21, ... of the 40 by ascending id. This pair is number 19.
  scene.other.points[20] += Vector3(5, 0, 0);
  CHECK_THROWS_AS(plan_merge(scene.map, scene.other, MergeOptions(), 10, report), Error);
  CHECK(report.broken_id == scene.other.ids[20]);
  CHECK(report.rows == 24);
}

namespace {

// A map of one submap.
std::unique_ptr<SparseMap<SE3>> sparse(const std::vector<std::uint64_t>& ids, const std::vector<Vector3>& points,
                                       double sigma) {
  auto map = std::make_unique<SparseMap<SE3>>(MapOptions<SE3>());
  Submap<SE3> submap;
  submap.error = ErrorKind::standard;
  submap.T_base_end = SE3(SO3(), Vector3(1, 2, 3));
  submap.ids = ids;
  submap.counts.assign(ids.size(), 1);
  submap.landmarks = points;
  const auto n = 6 + at(ids.size());
  submap.covariance = sigma * sigma * Matrix::Identity(n, n);
  map->join(submap);
  return map;
}

}  // namespace

TEST_CASE("sparse merge: what the test of the pairs lets pass, the growth of the cost tells") {
  const Scene scene(95, 4, 30, 4);
  std::vector<Vector3> moved;
  for (const Vector3& x : scene.truth_other) moved.push_back(x);
  const auto a = sparse(scene.map.ids, scene.truth_map, 0.1);
  for (const bool wrong : {false, true}) {
    if (wrong) moved[21] += Vector3(0, 2, 0);  // not drawn
    const auto b = sparse(scene.other.ids, moved, 0.1);
    MergeOptions options;
    options.gate_probability = 1.0;  // so that only the drawn pairs are tested
    MergeReport report;
    const MergePlan plan = plan_merge(*a, *b, options, 10, report);
    CHECK(report.distance < 1e-9);
    SparseMap<SE3> both(*a);
    if (!wrong) {
      both.append(*b, plan, options, report);
      CHECK(report.rows == 84);
      CHECK(report.distance < 1e-6);
      CHECK(both.size() == 38);
      for (std::size_t j = 0; j < scene.truth_other.size(); ++j) {
        std::size_t index = 0;
        REQUIRE(both.find(scene.other.ids[j], index));
        CHECK((both.position(index) - scene.T_map_other * scene.truth_other[j]).norm() < 1e-6);
      }
    } else {
      CHECK_THROWS_AS(both.append(*b, plan, options, report), Error);
      CHECK(both.size() == a->size());
      CHECK(both.submap_count() == a->submap_count());
      CHECK(both.cost() == a->cost());
      for (std::size_t i = 0; i < a->size(); ++i) {
        CHECK(both.position(i) == a->position(i));
        CHECK(both.observations(i) == a->observations(i));
      }
      CHECK(report.broken_id == scene.other.ids[21]);
      CHECK(report.rows == 84);
      CHECK(report.distance > 180.0);  // 2 m at 0.14 m, less the part that the transform absorbs
      CHECK(report.distance < 200.0);
    }
    CHECK(a->size() == 34);
  }
}

TEST_CASE("merge: maps of the plane are copied, and not merged") {
  Submap<SE2> submap;
  submap.T_base_end = SE2(SO2::from_angle(0.3), Vector2(1, 2));
  submap.ids = {5, 7, 9};
  submap.counts = {1, 2, 3};
  submap.landmarks = {Vector2(4, 1), Vector2(-3, 6), Vector2(8, -2)};
  submap.covariance = 0.01 * Matrix::Identity(9, 9);
  SparseMap<SE2> sparse{MapOptions<SE2>()};
  DenseMap<SE2> dense{MapOptions<SE2>()};
  sparse.join(submap);
  dense.join(submap);
  Random random(96);
  const Plain space = map_of(random, submap.ids, {Vector3(4, 1, 0), Vector3(-3, 6, 0), Vector3(8, -2, 1)}, 0.1, 0.1);
  for (const Landmarks* source : {static_cast<const Landmarks*>(&sparse), static_cast<const Landmarks*>(&dense)}) {
    const OwnedMap copy(*source, {1}), of_space(space, {2});
    const Landmarks& own = *copy.landmarks;
    CHECK((own.kind() == MapKind::sparse) == (source == &sparse));
    CHECK(own.planar());
    CHECK(!of_space.landmarks->planar());
    REQUIRE(own.size() == 3);
    const std::size_t all[] = {0, 1, 2};
    Matrix before(9, 9), after(9, 9);
    source->joint_covariance(all, 3, before.data());
    own.joint_covariance(all, 3, after.data());
    CHECK(before == after);
    CHECK(before.block<2, 2>(3, 0).norm() > 0.0);  // all three begin at one base
    for (std::size_t i = 0; i < 3; ++i) {
      std::size_t index = 0;
      REQUIRE(own.find(submap.ids[i], index));
      CHECK(index == i);
      CHECK(own.observations(i) == i + 1);
      CHECK(own.position(i) == source->position(i));
      CHECK((own.position(i) - Vector3(submap.landmarks[i].x(), submap.landmarks[i].y(), 0)).norm() <= 1e-12);
    }
    MergeReport report;
    const auto refusal = doctest::Contains("maps of the plane can't be merged");
    CHECK_THROWS_WITH(OwnedMap(copy, *source, {2}, MergeOptions(), report), refusal);
    CHECK_THROWS_WITH(OwnedMap(copy, space, {2}, MergeOptions(), report), refusal);
    CHECK_THROWS_WITH(OwnedMap(of_space, *source, {1}, MergeOptions(), report), refusal);
  }
}
