// SPDX-License-Identifier: BSD-3-Clause
// What common landmarks say about base and vehicle, against a slow solution for all errors at once.
#include "slam/seen_again.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <optional>

#include "map/join/dense/dense_map.hpp"
#include "numerical.hpp"
#include "slam/local_map.hpp"
#include "submap_ring.hpp"

namespace {

using namespace cairn;
using namespace cairn::test;

// A map of two submaps, and an open submap that has seen some of its landmarks. The base is far from where the map has
// it, so that the first linearisation is not enough.
template <class Pose>
class Scene {
 public:
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Point = typename Pose::Point;
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;
  using Given = typename SeenAgain<Pose>::Given;

  Scene(unsigned seed, ErrorKind error)
      : random(seed), options(with(error)), arena(bytes(options)), open(arena, options) {
    Ring<Pose> ring(seed, error, 8, 20.0, {0.3, 0.1});
    MapOptions<Pose> of_map = ring.options();
    of_map.gate_probability = of_map.joint_gate_probability = 1.0;
    map.emplace(of_map);
    for (int i = 0; i < 2; ++i) map->join(ring.submap(i));
    open.start(Pose::exp(0.5 * random.normal_vector<kDof>()), square<kDof>(0.1));
  }

  // The open submap sees the first `count` landmarks of the map from a base that is `motion` away from the map's; one
  // of them lies `wrong` beside its place.
  void see(std::size_t count, const typename Pose::Tangent& motion, std::size_t one, double wrong) {
    const Pose base = retract(map->base(), motion);
    for (std::size_t index = 0; index < count; ++index) {
      Point at = base.inverse() * Embedding<Pose>::down(map->position(index)) + 0.05 * random.normal_vector<kDim>();
      if (index == one) at += wrong * Point::UnitX();
      Eigen::Matrix<double, kDim, kDof> by_pose;
      for (Index i = 0; i < by_pose.size(); ++i) by_pose.data()[i] = random.normal();
      EkfUpdate<Pose> update = open.state().begin({});
      REQUIRE(update.place(at, by_pose, nullptr, square<kDim>(0.1), false));
      open.name_placed(map->id(index));
      common.push_back({open.state().size() - 1, index});
    }
  }

  Given given(const std::vector<std::size_t>& asked) {
    return SeenAgain<Pose>(options).given(*map, open.state(), common, asked.data(), asked.size());
  }

  // Gauss-Newton for [base; landmarks; asked for; vehicle; seen], with x = R_S^T (l - p_S) as a constraint whose
  // Jacobian is numerical.
  Given slow(const std::vector<std::size_t>& asked) {
    std::vector<std::size_t> indices;
    std::vector<Index> slots;
    for (const CommonLandmark& landmark : common) indices.push_back(landmark.index), slots.push_back(landmark.slot);
    indices.insert(indices.end(), asked.begin(), asked.end());
    const auto m = static_cast<Index>(kDim * common.size()), rest = static_cast<Index>(kDim * asked.size()),
               in_map = kDof + m + rest, in_submap = kDof + m, n = in_map + in_submap;
    Matrix C = Matrix::Zero(n, n), P(in_map, in_map), Sigma(in_submap, in_submap);
    map->base_joint_covariance(indices.data(), indices.size(), P.data());
    open.state().gather_ordinary(slots.data(), static_cast<Index>(slots.size()), Sigma.data(), in_submap);
    C.topLeftCorner(in_map, in_map) = P;
    C.bottomRightCorner(in_submap, in_submap) = Sigma;
    const auto differences = [&](const Vector& z) {
      Vector g(m);
      const Pose base = retract(map->base(), typename Pose::Tangent(z.head<kDof>()));
      for (std::size_t a = 0; a < common.size(); ++a) {
        const auto at = static_cast<Index>(kDim * a);
        const Point l = Embedding<Pose>::down(map->position(common[a].index)) + Point(z.segment<kDim>(kDof + at));
        const Point x = open.state().landmark(common[a].slot) + Point(z.segment<kDim>(in_map + kDof + at));
        g.segment<kDim>(at) = x - base.inverse() * l;
      }
      return g;
    };
    Vector z = Vector::Zero(n);
    Matrix G(m, n);
    for (int i = 0; i < 300; ++i) {
      for (Index c = 0; c < n; ++c) {
        const Vector step = 1e-5 * Vector::Unit(n, c);
        G.col(c) = (differences(z + step) - differences(z - step)) / 2e-5;
      }
      z = C * G.transpose() * Matrix(G * C * G.transpose()).ldlt().solve(Vector(G * z - differences(z)));
    }
    const Matrix after = C - C * G.transpose() * Matrix(G * C * G.transpose()).ldlt().solve(Matrix(G * C));
    std::vector<Index> rows;
    for (Index d = 0; d < kDof; ++d) rows.push_back(d);
    for (Index d = 0; d < kDof; ++d) rows.push_back(in_map + d);
    for (Index d = 0; d < rest; ++d) rows.push_back(kDof + m + d);
    Given given{retract(map->base(), typename Pose::Tangent(z.head<kDof>())),
                retract(open.state().pose(), typename Pose::Tangent(z.segment<kDof>(in_map))), after(rows, rows)};
    given.covariance.bottomRightCorner(rest, rest) = P.bottomRightCorner(rest, rest);
    return given;
  }

  Random random;
  FilterOptions<Pose> options;
  Arena arena;
  LocalMap<Pose> open;
  std::optional<DenseMap<Pose>> map;
  std::vector<CommonLandmark> common;

 private:
  static FilterOptions<Pose> with(ErrorKind error) {
    FilterOptions<Pose> options;
    options.error = error;
    options.max_landmarks = 20;
    options.submap_landmarks = 20;
    options.max_observations = 8;
    options.iterations = 300;
    options.iteration_tolerance = 1e-13;
    return options;
  }
  static std::size_t bytes(const FilterOptions<Pose>& options) {
    Arena measure;
    const LocalMap<Pose> unused(measure, options);
    return measure.used();
  }
  template <int n>
  Eigen::Matrix<double, n, n> square(double size) {
    Eigen::Matrix<double, n, n> root;
    for (Index i = 0; i < root.size(); ++i) root.data()[i] = size * random.normal();
    return root * root.transpose() + 0.01 * size * size * Eigen::Matrix<double, n, n>::Identity();
  }
};

template <class Pose>
void check_same(const typename SeenAgain<Pose>::Given& a, const typename SeenAgain<Pose>::Given& b, double tolerance) {
  CHECK(pose_error(a.base, b.base).norm() < tolerance);
  CHECK(pose_error(a.vehicle, b.vehicle).norm() < tolerance);
  CHECK((a.covariance - b.covariance).norm() < tolerance * b.covariance.norm());
  CHECK(a.covariance == a.covariance.transpose());
}

constexpr std::size_t kNone = 1000;

}  // namespace

TEST_CASE_TEMPLATE("seen again: the solution for all errors at once", Pose, SE2, SE3) {
  for (const ErrorKind error : kKinds)
    for (unsigned seed = 1; seed <= 5; ++seed) {
      CAPTURE(seed);
      Scene<Pose> scene(seed, error);
      scene.options.gate_probability = scene.options.batch_gate_probability = 1.0;
      const typename Pose::Tangent motion = Pose::Tangent::Constant(0.4);
      scene.see(6, motion, kNone, 0.0);
      for (const std::vector<std::size_t>& asked : {std::vector<std::size_t>{}, {7, 2}}) {
        const auto slow = scene.slow(asked);
        CHECK(pose_error(slow.base, scene.map->base()).template tail<Pose::kTurn>().norm() > 0.1);  // is far away
        check_same<Pose>(scene.given(asked), slow, 1e-5);
      }
    }
}

TEST_CASE_TEMPLATE("seen again: what the gates refuse says nothing", Pose, SE2, SE3) {
  for (const ErrorKind error : kKinds) {
    Scene<Pose> scene(6, error);
    scene.see(6, Pose::Tangent::Zero(), 2, 50.0);
    const auto all = scene.given({7});
    scene.common.erase(scene.common.begin() + 2);
    check_same<Pose>(all, scene.slow({7}), 1e-5);
    // Most of them contradict: base and vehicle stay as they are, and independent of each other.
    Scene<Pose> lost(7, error);
    lost.see(6, 30.0 * Pose::Tangent::Unit(0), kNone, 0.0);
    const auto given = lost.given({});
    CHECK(pose_error(given.base, lost.map->base()).norm() == 0.0);
    CHECK(pose_error(given.vehicle, lost.open.state().pose()).norm() == 0.0);
    CHECK(given.covariance.topRightCorner(Pose::kDof, Pose::kDof).norm() == 0.0);
    CHECK((given.covariance.topLeftCorner(Pose::kDof, Pose::kDof) - lost.map->base_covariance()).norm() == 0.0);
  }
}

TEST_CASE("seen again: the joint covariance of the map is asked for again when the map has changed") {
  Scene<SE3> scene(8, ErrorKind::invariant);
  scene.options.gate_probability = scene.options.batch_gate_probability = 1.0;
  scene.see(5, SE3::Tangent::Constant(0.02), kNone, 0.0);
  SeenAgain<SE3> seen_again(scene.options);
  const auto given = [&] { return seen_again.given(*scene.map, scene.open.state(), scene.common, nullptr, 0); };
  const auto before = given();
  CHECK(given().covariance == before.covariance);
  scene.map->fix(
      AbsoluteFix<SE3>::position(scene.map->base().translation(), 1e-6 * Matrix3::Identity(), Vector3::Zero()), 1e9);
  check_same<SE3>(given(), scene.slow({}), 1e-5);
  CHECK((given().covariance - before.covariance).norm() > 1e-3 * before.covariance.norm());
}
