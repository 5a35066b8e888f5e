// SPDX-License-Identifier: BSD-3-Clause
// The final result of the filter. If the problem is linear and Gaussian, it must be the least-squares solution over all
// measurements, with all positions of the vehicle as unknowns. After a long drive the covariance must still be positive
// definite.
#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <vector>

#include "reference_scenario.hpp"

using namespace cairn;
using namespace cairn::test;

namespace {

constexpr Eigen::Index kSteps = 30, kLandmarks = 12;
constexpr Eigen::Index kUnknowns = 3 * (kSteps + 1 + kLandmarks);

// Sum of squares of everything measured, in information form.
struct LeastSquares {
  Dynamic information = Dynamic::Zero(kUnknowns, kUnknowns);
  DynamicVector weighted = DynamicVector::Zero(kUnknowns);

  // z = x_b - x_a + noise; x_a is absent if a < 0.
  void add(Eigen::Index a, Eigen::Index b, const Vector3& z, const Matrix3& covariance) {
    Eigen::Matrix<double, 3, Eigen::Dynamic> J = Eigen::Matrix<double, 3, Eigen::Dynamic>::Zero(3, kUnknowns);
    J.middleCols<3>(3 * b).setIdentity();
    if (a >= 0) J.middleCols<3>(3 * a) = -Matrix3::Identity();
    const Matrix3 W = covariance.inverse();
    information += J.transpose() * W * J;
    weighted += J.transpose() * (W * z);
  }
};

Matrix3 random_covariance_of_points(Random& random, double sigma) {
  Matrix3 A = Matrix3::Identity();
  for (int i = 0; i < 3; ++i) A.col(i) += 0.5 * random.normal_vector<3>();
  const Matrix3 square = sigma * sigma * A * A.transpose();
  return 0.5 * (square + square.transpose());
}

}  // namespace

TEST_CASE("ekf: equals least squares over the whole drive where the problem is linear") {
  for (ErrorKind error : {ErrorKind::invariant, ErrorKind::standard}) {
    CAPTURE(static_cast<int>(error));
    Random random(17);
    FilterOptions<SE3> options;
    options.error = error;
    options.max_landmarks = kLandmarks;
    options.max_observations = kLandmarks;
    options.gate_probability = options.batch_gate_probability = 1;
    // Any attitude, but exactly known: no noise on it at the start or on the way.
    const SO3 R = SO3::exp(Vector3(0.4, -0.8, 1.3));
    options.initial_pose = SE3(R, Vector3(12, -7, 3));
    const Matrix3 start = random_covariance_of_points(random, 0.8);
    options.initial_covariance.topLeftCorner<3, 3>() = start;
    Arena arena(Filter<SE3>::arena_bytes(options));
    Filter<SE3> filter(arena, options);
    const CartesianParameters<SE3> parameters;
    const int sensor = filter.add(Cartesian<SE3>(parameters));

    LeastSquares squares;
    squares.add(-1, 0, options.initial_pose.translation(), start);
    Vector3 truth = options.initial_pose.translation() + start.llt().matrixL() * random.normal_vector<3>();
    std::vector<Vector3> landmarks;
    for (Eigen::Index i = 0; i < kLandmarks; ++i) landmarks.push_back(truth + 10 * random.normal_vector<3>());

    for (Eigen::Index k = 0; k < kSteps; ++k) {
      const Vector3 step = random.normal_vector<3>();
      truth += R * step;
      Increment<SE3> increment;
      const Matrix3 Q = random_covariance_of_points(random, 0.1);
      const Vector3 measured = step + Q.llt().matrixL() * random.normal_vector<3>();
      increment.T_before_after = SE3(SO3(), measured);
      increment.covariance.topLeftCorner<3, 3>() = Q;
      filter.propagate(increment);
      squares.add(k, k + 1, R * measured, R.matrix() * Q * R.matrix().transpose());

      if (k % 4 == 3) {  // a position fix
        const Matrix3 covariance = random_covariance_of_points(random, 0.5);
        const Vector3 z = truth + covariance.llt().matrixL() * random.normal_vector<3>();
        filter.update_position(z, covariance, Vector3::Zero());
        squares.add(-1, k + 1, z, covariance);
      }
      if (k % 3 == 1) continue;  // two steps before the next frame
      std::vector<Observation> frame;
      for (Eigen::Index i = 0; i < kLandmarks; ++i) {
        if (random.uniform(0, 1) < 0.5) continue;
        const Matrix3 noise = random_covariance_of_points(random, 0.3);
        const Vector3 z = R.inverse() * (landmarks[static_cast<std::size_t>(i)] - truth) +
                          noise.llt().matrixL() * random.normal_vector<3>();
        Observation o{};
        o.id = static_cast<std::uint64_t>(i);
        Eigen::Map<Vector3>(o.z) = z;
        Eigen::Map<Matrix3>(o.covariance) = noise;
        frame.push_back(o);
        squares.add(k + 1, kSteps + 1 + i, R * z, R.matrix() * noise * R.matrix().transpose());
      }
      filter.update(sensor, frame.data(), static_cast<Index>(frame.size()));
      CHECK(filter.report().rejected == 0);
    }
    REQUIRE(filter.landmarks().size() == static_cast<std::size_t>(kLandmarks));

    const Eigen::LLT<Dynamic> factor(squares.information);
    REQUIRE(factor.info() == Eigen::Success);
    const DynamicVector best = factor.solve(squares.weighted);
    const Dynamic all = factor.solve(Dynamic::Identity(kUnknowns, kUnknowns));
    constexpr Eigen::Index kLast = 3 * kSteps;  // the last position, then the map
    const Dynamic expected = all.bottomRightCorner(3 + 3 * kLandmarks, 3 + 3 * kLandmarks);

    CHECK((filter.pose().translation() - best.segment<3>(kLast)).norm() < 1e-10 * best.norm());
    CHECK((filter.pose().rotation() * R.inverse()).log().norm() < 1e-14);
    std::vector<std::size_t> indices(static_cast<std::size_t>(kLandmarks));
    for (std::size_t i = 0; i < indices.size(); ++i) {
      REQUIRE(filter.landmarks().find(i, indices[i]));
      const Vector3 x = best.segment<3>(kLast + 3 + 3 * static_cast<Eigen::Index>(i));
      CHECK((filter.landmarks().position(indices[i]) - x).norm() < 1e-10 * best.norm());
    }
    Dynamic joint(6 + 3 * kLandmarks, 6 + 3 * kLandmarks);
    filter.pose_joint_covariance(indices.data(), indices.size(), joint.data());
    CHECK(joint.middleRows(3, 3).norm() == 0);  // the attitude stays known, to the bit
    Dynamic actual(3 + 3 * kLandmarks, 3 + 3 * kLandmarks);
    const auto from = [](Eigen::Index i) { return i < 3 ? i : i + 3; };
    for (Eigen::Index c = 0; c < actual.cols(); ++c)
      for (Eigen::Index r = 0; r < actual.rows(); ++r) actual(r, c) = joint(from(r), from(c));
    CHECK((actual - expected).norm() < 1e-10 * expected.norm());
  }
}

TEST_CASE("ekf: the covariance stays positive definite over a long drive") {
  for (ErrorKind error : {ErrorKind::invariant, ErrorKind::standard}) {
    Random random(9);
    const FilterOptions<SE3> options = random_options(error, random);
    Arena arena(Filter<SE3>::arena_bytes(options));
    Filter<SE3> filter(arena, options);
    const StereoHead head = scenario_head(0.01, true);
    const int number = filter.add(head);
    SE3 truth = options.initial_pose;
    for (int step = 0; step < 3000; ++step) {
      // A circle of 4 m, so that every landmark is seen again and again.
      const Vector3 v(1, 0, 0), w(0, 0, 0.25);
      for (int i = 0; i < 2; ++i) {
        truth = truth * SE3::exp((Vector6() << 0.2 * v, 0.2 * w).finished());
        const Vector3 measured = v + 0.05 * random.normal_vector<3>();
        filter.predict_twist(0.2, measured, w + 0.005 * random.normal_vector<3>());
      }
      std::vector<Observation> frame;
      for (std::uint64_t id = 0; id < 20 && frame.size() < 8; ++id) {
        const double azimuth = 0.314 * static_cast<double>(id);
        const Vector3 l = options.initial_pose * Vector3(12 * std::cos(azimuth), 4 + 12 * std::sin(azimuth), 1);
        Prediction<SE3> seen;
        if ((truth.rotation().inverse() * (l - truth.translation())).x() < 3) continue;
        REQUIRE(head.predict(truth, l, Vector2::Zero(), seen));
        seen.z += head.noise().diagonal().cwiseSqrt().cwiseProduct(random.normal_vector<3>());
        frame.push_back({id, {seen.z[0], seen.z[1], seen.z[2]}, {}});
      }
      filter.update(number, frame.data(), static_cast<Index>(frame.size()));
      if (step % 100 == 99) CHECK(filter.smallest_pivot() > 1e-9);
    }
    CHECK(filter.landmarks().size() == 20);
    CHECK(filter.pose_nees(truth) < 30);  // chi-square of 6: 4e-5
  }
}
