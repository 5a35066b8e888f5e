// SPDX-License-Identifier: BSD-3-Clause
// Poses of other vehicles in a filter's state, against a dense filter of ordinary errors (dense_state.hpp).
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <vector>

#include "ekf/dense_state.hpp"
#include "ekf/ekf_update.hpp"
#include "numerical.hpp"

using namespace cairn;
using namespace cairn::test;

namespace {

using Dynamic = Eigen::MatrixXd;

template <int N>
Eigen::Matrix<double, N, N> random_covariance(Random& random, double sigma) {
  Eigen::Matrix<double, N, N> A = Eigen::Matrix<double, N, N>::Identity();
  for (int i = 0; i < N; ++i) A.col(i) += 0.4 * random.normal_vector<N>();
  return sigma * sigma * A * A.transpose();
}

// The filter and the reference, and the numbers of the reference: the active vehicle, companions and landmarks by slot.
template <class Pose>
struct Both {
  static constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Point = typename Pose::Point;
  using Square = typename Pose::Square;
  using PointByPose = Eigen::Matrix<double, kDim, kDof>;

  static typename State<Pose>::Capacity capacity() {
    typename State<Pose>::Capacity c;
    c.landmarks = 14, c.observations = 5, c.companions = 4;
    return c;
  }
  static std::size_t bytes() {
    Arena measure;
    const State<Pose> unused(measure, ErrorKind::standard, capacity());
    return measure.used();
  }

  // `noise` scales all uncertainties and all residuals.
  Both(ErrorKind error, unsigned seed, double noise_scale)
      : random(seed), scale(noise_scale), arena(bytes()), state(arena, error, capacity()) {
    const Pose start = random_pose();
    const Square P = random_covariance<kDof>(random, 0.05 * scale);
    state.start(start, P);
    dense.poses.push_back(start);
    dense.P = P;
  }

  Pose random_pose() {
    return Pose(Pose::Rotation::exp(random.normal_vector<kTurn>()), Point(10 * random.normal_vector<kDim>()));
  }
  std::size_t any(std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(random.uniform(0, static_cast<double>(count))));
  }

  void propagate() {
    Increment<Pose> increment;
    increment.T_before_after =
        Pose(Pose::Rotation::exp(0.2 * random.normal_vector<kTurn>()), Point(random.normal_vector<kDim>()));
    increment.covariance = random_covariance<kDof>(random, 0.02 * scale);
    REQUIRE(state.propagate(increment));
    dense.propagate(active, increment);
  }
  void activate() {
    if (companions.empty()) return;
    const std::size_t k = any(companions.size());
    state.activate(static_cast<Index>(k));
    std::swap(active, companions[k]);
  }
  void add_companion() {
    if (static_cast<Index>(companions.size()) == capacity().companions || state.size() == capacity().landmarks) return;
    const Pose pose = random_pose();
    Square J = Square::Zero();
    if (random.uniform(0, 1) < 0.7)
      for (int i = 0; i < kDof; ++i) J.col(i) = random.template normal_vector<kDof>();
    const Square noise = random_covariance<kDof>(random, 0.05 * scale);
    REQUIRE(state.add_companion(pose, J, noise));
    dense.add_pose(pose, active, J, noise);
    companions.push_back(dense.poses.size() - 1);
    if (!landmarks.empty()) {  // the first one moves behind the last
      landmarks.push_back(landmarks.front());
      landmarks.erase(landmarks.begin());
    }
  }
  void remove_companion() {
    if (companions.empty()) return;
    const std::size_t k = any(companions.size()), gone = companions[k];
    state.remove_companion(static_cast<Index>(k));
    companions[k] = companions.back();
    companions.pop_back();
    if (!landmarks.empty()) {
      landmarks.insert(landmarks.begin(), landmarks.back());
      landmarks.pop_back();
    }
    dense.remove_pose(gone);
    for (std::size_t& c : companions) c -= c > gone;
    active -= active > gone;
  }
  void augment() {
    if (state.size() == capacity().landmarks) return;
    const Point body = 5 * random.template normal_vector<kDim>(), arm = dense.poses[active].rotation() * body;
    const bool relative = random.uniform(0, 1) < 0.5;
    PointByPose J;
    J.template leftCols<kDim>().setIdentity();
    J.template rightCols<kTurn>() = Pose::Rotation::turn(arm);
    if (!relative)
      for (int i = 0; i < kDof; ++i) J.col(i) += 0.3 * random.template normal_vector<kDim>();
    const Point point = dense.poses[active].translation() + arm;
    const auto noise = random_covariance<kDim>(random, 0.1 * scale);
    REQUIRE(state.augment(point, J, noise, relative));
    dense.add_point(point, active, J, noise);
    landmarks.push_back(dense.points.size() - 1);
  }
  void remove_landmark() {
    if (landmarks.empty()) return;
    const std::size_t k = any(landmarks.size()), gone = landmarks[k];
    state.remove(static_cast<Index>(companions.size() + k));
    landmarks[k] = landmarks.back();
    landmarks.pop_back();
    dense.remove_point(gone);
    for (std::size_t& l : landmarks) l -= l > gone;
  }
  // Sightings of some slots, companions' or landmarks', by any Jacobian.
  void update() {
    const auto all = static_cast<std::size_t>(state.size());
    if (all == 0) return;
    std::vector<Index> slots;
    for (std::size_t s = any(all); s < all && slots.size() < 5; s += 1 + any(2)) slots.push_back(static_cast<Index>(s));
    const auto rows = static_cast<Index>(kDim * slots.size());
    Dynamic H = Dynamic::Zero(rows, dense.P.rows()), noise = Dynamic::Zero(rows, rows);
    Eigen::VectorXd residual(rows);
    EkfUpdate<Pose> update = state.begin({slots.data(), static_cast<Index>(slots.size())});
    update.linearise([&](double*) {
      for (std::size_t a = 0; a < slots.size(); ++a) {
        PointByPose J_pose;
        for (int i = 0; i < kDof; ++i) J_pose.col(i) = random.template normal_vector<kDim>();
        Eigen::Matrix<double, kDim, kDim> J_point;
        for (int i = 0; i < kDim; ++i) J_point.col(i) = random.template normal_vector<kDim>();
        const auto R = random_covariance<kDim>(random, 0.1 * scale);
        const Point r = 0.1 * scale * random.template normal_vector<kDim>();
        const Index row = update.batch().add_rows(kDim), slot = slots[a];
        const auto pose = update.add_pose_block(row, kDim, J_pose, false);
        update.add_landmark_block(row, kDim, J_point, static_cast<Index>(a), pose);
        Eigen::Map<Eigen::Matrix<double, kDim, kDim>>(update.batch().add_noise(row, kDim)) = R;
        Eigen::Map<Point>(update.batch().residual() + row) = r;
        const bool companion = slot < state.companions();
        const Index column = companion ? dense.pose_at(companions[static_cast<std::size_t>(slot)])
                                       : dense.point_at(landmarks[static_cast<std::size_t>(slot - state.companions())]);
        H.block(row, dense.pose_at(active), kDim, kDof) += J_pose;
        H.block(row, column, kDim, kDim) += J_point;
        noise.block(row, row, kDim, kDim) = R;
        residual.segment(row, kDim) = r;
      }
      return true;
    });
    REQUIRE_NOTHROW(update.factor());
    update.solve();
    REQUIRE_NOTHROW(update.commit());
    dense.update(H, residual, noise);
  }

  void any_step(bool updates) {
    const double what = random.uniform(0, updates ? 9 : 7);
    if (what < 2) return propagate();
    if (what < 3.5) return activate();
    if (what < 4.3) return add_companion();
    if (what < 4.7) return remove_companion();
    if (what < 6.6) return augment();
    if (what < 7) return remove_landmark();
    update();
  }

  // The reference's rows of the active pose and then of every slot's position.
  std::vector<Index> rows() const {
    std::vector<Index> out;
    for (Index i = 0; i < kDof; ++i) out.push_back(dense.pose_at(active) + i);
    for (std::size_t c : companions)
      for (Index i = 0; i < kDim; ++i) out.push_back(dense.pose_at(c) + i);
    for (std::size_t l : landmarks)
      for (Index i = 0; i < kDim; ++i) out.push_back(dense.point_at(l) + i);
    return out;
  }

  Dynamic ordinary() const {
    std::vector<Index> slots;
    for (Index s = 0; s < state.size(); ++s) slots.push_back(s);
    const Index n = kDof + kDim * state.size();
    Dynamic out(n, n);
    state.gather_ordinary(slots.data(), state.size(), out.data(), n);
    return out;
  }

  // Largest differences: for a state relative to its size or to its standard deviation in `scale`, for an entry of the
  // covariance relative to the standard deviations of its two states.
  double worst_state() const {
    double worst = 0;
    const auto of_pose = [&](const Pose& a, const Pose& b) {
      worst = std::max(worst, pose_error(a, b).norm() / (1 + b.translation().norm()));
    };
    REQUIRE(state.companions() == static_cast<Index>(companions.size()));
    REQUIRE(state.size() == static_cast<Index>(companions.size() + landmarks.size()));
    of_pose(state.pose(), dense.poses[active]);
    for (std::size_t k = 0; k < companions.size(); ++k)
      of_pose(state.companion(static_cast<Index>(k)), dense.poses[companions[k]]);
    for (std::size_t l = 0; l < landmarks.size(); ++l) {
      const Point& x = dense.points[landmarks[l]];
      worst = std::max(worst, (state.landmark(state.companions() + static_cast<Index>(l)) - x).norm() / (1 + x.norm()));
    }
    return worst / scale;
  }
  static double relative(const Dynamic& a, const Dynamic& b) {
    const Eigen::VectorXd sigma = b.diagonal().cwiseSqrt().cwiseInverse();
    return (sigma.asDiagonal() * (a - b) * sigma.asDiagonal()).cwiseAbs().maxCoeff();
  }
  double worst_covariance() const {
    const std::vector<Index> all = rows();
    double worst = relative(ordinary(), dense.P(all, all));
    for (std::size_t k = 0; k < companions.size(); ++k) {
      const Index at = dense.pose_at(companions[k]);
      worst = std::max(worst,
                       relative(state.companion_covariance(static_cast<Index>(k)), dense.P.block(at, at, kDof, kDof)));
    }
    return std::max(worst, worst_relative());
  }
  // The error that affects a sensor of R^T (l - p), relative to the size of the two states of the difference.
  double worst_relative() const {
    double worst = 0;
    const Index pose = dense.pose_at(active);
    for (std::size_t l = 0; l < landmarks.size(); ++l) {
      const Index point = dense.point_at(landmarks[l]);
      Dynamic J = Dynamic::Zero(kDim, dense.P.rows());
      J.block(0, pose, kDim, kDim) = -Dynamic::Identity(kDim, kDim);
      J.block(0, pose + kDim, kDim, kTurn) =
          -Pose::Rotation::turn(dense.points[landmarks[l]] - dense.poses[active].translation());
      J.block(0, point, kDim, kDim).setIdentity();
      const Dynamic parts = J.cwiseAbs() * dense.P.cwiseAbs() * J.cwiseAbs().transpose();
      const Dynamic D = J * dense.P * J.transpose();
      worst = std::max(
          worst, (state.relative_covariance(state.companions() + static_cast<Index>(l)) - D).norm() / parts.norm());
    }
    return worst;
  }

  Random random;
  double scale;
  Arena arena;
  State<Pose> state;
  DenseState<Pose> dense;
  std::size_t active = 0;
  std::vector<std::size_t> companions, landmarks;  // in the reference, by slot
};

constexpr ErrorKind kBothErrors[] = {ErrorKind::invariant, ErrorKind::standard};

template <class Pose>
void standard_error_is_the_dense_filter() {
  std::size_t most = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    Both<Pose> both(ErrorKind::standard, seed, 1.0);
    for (int step = 0; step < 80; ++step) {
      CAPTURE(step);
      both.any_step(true);
      CHECK(both.worst_state() < 1e-9);
      CHECK(both.worst_covariance() < 1e-9);
      most = std::max(most, both.companions.size());
    }
    CHECK(both.state.smallest_pivot() > 0);
  }
  CHECK(most == 4);
}

// Every call except an update is linear in either error, at the same estimates.
template <class Pose>
void invariant_error_without_updates_is_the_dense_filter() {
  for (unsigned seed = 31; seed <= 42; ++seed) {
    CAPTURE(seed);
    Both<Pose> both(ErrorKind::invariant, seed, 1.0);
    for (int step = 0; step < 60; ++step) {
      CAPTURE(step);
      both.any_step(false);
      CHECK(both.worst_state() < 1e-12);
      CHECK(both.worst_covariance() < 1e-9);
    }
    CHECK(both.state.smallest_pivot() > 0);
  }
}

// An update moves the two filters apart by a product of two errors. With small noise this product is the only
// difference.
template <class Pose>
void invariant_error_agrees_where_noise_is_small() {
  for (const double scale : {1e-3, 1e-5}) {
    double state = 0, covariance = 0;
    for (unsigned seed = 61; seed <= 66; ++seed) {
      CAPTURE(seed);
      Both<Pose> both(ErrorKind::invariant, seed, scale);
      for (int step = 0; step < 60; ++step) {
        both.any_step(true);
        state = std::max(state, both.worst_state());
        covariance = std::max(covariance, both.worst_covariance());
      }
      CHECK(both.state.smallest_pivot() > 0);
    }
    CAPTURE(scale);
    CHECK(state < 30 * scale);
    CHECK(covariance < 100 * scale);
  }
}

template <class Pose>
void looking_from_another_changes_no_ordinary_covariance() {
  for (ErrorKind error : kBothErrors)
    for (unsigned seed = 81; seed <= 86; ++seed) {
      CAPTURE(static_cast<int>(error));
      CAPTURE(seed);
      Both<Pose> both(error, seed, 1.0);
      both.add_companion();
      for (int step = 0; step < 40; ++step) both.any_step(true);
      if (both.companions.empty()) both.add_companion();
      if (seed % 2 == 0) both.propagate();  // motion held back
      State<Pose>& state = both.state;
      const Index k = state.companions() - 1;
      const Dynamic before = both.ordinary();
      const typename Pose::Square own = state.pose_covariance(), other = state.companion_covariance(k);
      const Pose own_pose = state.pose(), other_pose = state.companion(k);
      state.activate(k);
      CHECK(Both<Pose>::relative(state.pose_covariance(), other) < 1e-8);
      CHECK(Both<Pose>::relative(state.companion_covariance(k), own) < 1e-8);
      CHECK(pose_error(state.pose(), other_pose).norm() < 1e-12);
      CHECK(pose_error(state.companion(k), own_pose).norm() < 1e-12);
      // The landmarks among themselves.
      const Index from = Pose::kDof + Pose::kDim * state.companions(), n = before.rows() - from;
      if (n > 0)
        CHECK(Both<Pose>::relative(both.ordinary().bottomRightCorner(n, n), before.bottomRightCorner(n, n)) < 1e-8);
      CHECK(state.smallest_pivot() > 0);
      state.activate(k);
      CHECK(Both<Pose>::relative(both.ordinary(), before) < 1e-8);
      CHECK(Both<Pose>::relative(state.companion_covariance(k), other) < 1e-8);
      CHECK(state.smallest_pivot() > 0);
    }
}

// A companion is seen from this vehicle, then driven. The expected values are computed by hand, without the reference.
template <class Pose>
void a_companion_that_was_seen() {
  constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  using Square = typename Pose::Square;
  for (ErrorKind error : kBothErrors) {
    Random random(7);
    Arena arena(Both<Pose>::bytes());
    State<Pose> state(arena, error, Both<Pose>::capacity());
    const Pose start(Pose::Rotation::exp(random.normal_vector<kTurn>()),
                     typename Pose::Point(3 * random.normal_vector<kDim>()));
    const Square P = random_covariance<kDof>(random, 0.1), Q = random_covariance<kDof>(random, 0.05),
                 N = random_covariance<kDof>(random, 0.2);
    state.start(start, P);
    Increment<Pose> step{Pose(Pose::Rotation::exp(0.3 * random.normal_vector<kTurn>()),
                              typename Pose::Point(random.normal_vector<kDim>())),
                         Q};
    REQUIRE(state.propagate(step));  // held back when the companion is added
    const Pose after = start * step.T_before_after;
    Square F = Square::Identity(), B = Square::Zero();
    F.template topRightCorner<kDim, kTurn>() = Pose::Rotation::turn(after.translation() - start.translation());
    B.template topLeftCorner<kDim, kDim>() = start.rotation().matrix();
    B.template bottomRightCorner<kTurn, kTurn>() = start.rotation().adjoint();
    const Square moved = F * P * F.transpose() + B * Q * B.transpose();

    // It stands at T d: e_p' = e_p + G(R d) e_R, e_R' = e_R.
    const Pose d(Pose::Rotation::exp(random.normal_vector<kTurn>()),
                 typename Pose::Point(5 * random.normal_vector<kDim>()));
    const Pose there = after * d;
    Square J = Square::Identity();
    J.template topRightCorner<kDim, kTurn>() = Pose::Rotation::turn(there.translation() - after.translation());
    REQUIRE(state.add_companion(there, J, N));
    CHECK(Both<Pose>::relative(state.pose_covariance(), moved) < 1e-12);
    CHECK(Both<Pose>::relative(state.companion_covariance(0), J * moved * J.transpose() + N) < 1e-12);
    Index slot = 0;
    Eigen::Matrix<double, kDof + kDim, kDof + kDim> joint;
    state.gather_ordinary(&slot, 1, joint.data(), kDof + kDim);
    CHECK((joint.template bottomLeftCorner<kDim, kDof>() - (J * moved).template topRows<kDim>()).norm() <
          1e-12 * moved.norm() * J.norm());

    // This vehicle moves on: the companion's pose and its covariance do not change.
    const Square seen = state.companion_covariance(0);
    REQUIRE(state.propagate(step));
    CHECK(Both<Pose>::relative(state.companion_covariance(0), seen) < 1e-12);
    CHECK(pose_error(state.companion(0), there).norm() < 1e-13);
    // Now the companion moves; activating it applies this vehicle's pending motion.
    const Pose own = state.pose();
    const Square own_covariance = state.pose_covariance();
    state.activate(0);
    REQUIRE(state.propagate(step));
    CHECK(Both<Pose>::relative(state.companion_covariance(0), own_covariance) < 1e-12);
    CHECK(pose_error(state.companion(0), own).norm() < 1e-13);
    Square F_there = Square::Identity(), B_there = Square::Zero();
    F_there.template topRightCorner<kDim, kTurn>() =
        Pose::Rotation::turn(there.rotation() * step.T_before_after.translation());
    B_there.template topLeftCorner<kDim, kDim>() = there.rotation().matrix();
    B_there.template bottomRightCorner<kTurn, kTurn>() = there.rotation().adjoint();
    CHECK(Both<Pose>::relative(state.pose_covariance(),
                               F_there * seen * F_there.transpose() + B_there * Q * B_there.transpose()) < 1e-12);
  }
}

// A companion is added with an exactly known pose, while this vehicle's heading is unknown. The companion can be
// activated, and its observations are used.
template <class Pose>
void a_companion_that_is_known_exactly() {
  constexpr int kDim = Pose::kDim, kTurn = Pose::kTurn, kDof = Pose::kDof;
  for (ErrorKind error : kBothErrors)
    for (unsigned seed = 1; seed <= 30; ++seed) {
      CAPTURE(static_cast<int>(error));
      CAPTURE(seed);
      Both<Pose> both(error, seed, 1.0);
      State<Pose>& state = both.state;
      for (int i = 0; i < 6; ++i) both.augment(), both.propagate();
      const Pose pose = both.random_pose();
      REQUIRE(state.add_companion(pose, Pose::Square::Zero(), Pose::Square::Zero()));
      both.landmarks.push_back(both.landmarks.front());
      both.landmarks.erase(both.landmarks.begin());
      both.dense.add_pose(pose, 0, Pose::Square::Zero(), Pose::Square::Zero());
      both.companions.push_back(1);
      state.activate(0);
      std::swap(both.active, both.companions[0]);
      CHECK(state.pose_covariance().norm() < 1e-9);
      const Index slot = 2;
      Eigen::Matrix<double, kDim, kDof> J_pose;
      J_pose << -Eigen::Matrix<double, kDim, kDim>::Identity(),
          -Pose::Rotation::turn(state.landmark(slot) - pose.translation());
      EkfUpdate<Pose> update = state.begin({&slot, 1});
      update.linearise([&](double*) {
        const Index row = update.batch().add_rows(kDim);
        const auto block = update.add_pose_block(row, kDim, J_pose, false);
        update.add_landmark_block(row, kDim, Eigen::Matrix<double, kDim, kDim>::Identity(), 0, block);
        Eigen::Map<Eigen::Matrix<double, kDim, kDim>>(update.batch().add_noise(row, kDim)).setIdentity();
        Eigen::Map<typename Pose::Point>(update.batch().residual()).setConstant(0.1);
        return true;
      });
      REQUIRE_NOTHROW(update.factor());
      update.solve();
      CHECK_NOTHROW(update.commit());
      CHECK(state.pose_covariance().norm() < 1e-9);
      CHECK((state.pose().translation() - pose.translation()).norm() < 1e-9);
    }
  (void)kTurn;
}

}  // namespace

TEST_CASE("companions: the standard error is the dense filter's") {
  standard_error_is_the_dense_filter<SE2>();
  standard_error_is_the_dense_filter<SE3>();
}

TEST_CASE("companions: motion, new and removed states by the invariant error") {
  invariant_error_without_updates_is_the_dense_filter<SE2>();
  invariant_error_without_updates_is_the_dense_filter<SE3>();
}

TEST_CASE("companions: both errors agree where noise is small") {
  invariant_error_agrees_where_noise_is_small<SE2>();
  invariant_error_agrees_where_noise_is_small<SE3>();
}

TEST_CASE("companions: looking from another vehicle changes no ordinary covariance, and back is where it was") {
  looking_from_another_changes_no_ordinary_covariance<SE2>();
  looking_from_another_changes_no_ordinary_covariance<SE3>();
}

TEST_CASE("companions: one that was seen, by hand") {
  a_companion_that_was_seen<SE2>();
  a_companion_that_was_seen<SE3>();
}

TEST_CASE("companions: one that is known exactly") {
  a_companion_that_is_known_exactly<SE2>();
  a_companion_that_is_known_exactly<SE3>();
}
