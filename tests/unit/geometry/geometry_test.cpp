// SPDX-License-Identifier: BSD-3-Clause
// Rotations and poses: group laws, exponentials, Jacobians, Euler angles.
#include <doctest/doctest.h>

#include <cmath>

#include "geometry/angle.hpp"
#include "geometry/euler.hpp"
#include "geometry/se2.hpp"
#include "geometry/se3.hpp"
#include "numerical.hpp"

using namespace cairn;

namespace {

// A few roundings of numbers of order one, or of order ten.
constexpr double kRounding = 1e-14;
// Error of the five-point differences of numerical.hpp for functions of order one to ten.
constexpr double kDifference = 1e-10;

template <class Pose>
std::vector<typename Pose::Tangent> tangents(unsigned seed) {
  test::Random random(seed);
  std::vector<typename Pose::Tangent> all;
  for (const auto& turn : test::awkward_turns<Pose::kTurn>(seed + 1)) {
    typename Pose::Tangent tau;
    tau << 3 * random.normal_vector<Pose::kDim>(), turn;
    all.push_back(tau);
  }
  return all;
}

template <class Pose>
double distance(const Pose& a, const Pose& b) {
  return (a.translation() - b.translation()).norm() + (a.rotation().matrix() - b.rotation().matrix()).norm();
}

// Matrix exponential by its series after repeated halving. It does not use angles.
template <int N>
Eigen::Matrix<double, N, N> series_exp(const Eigen::Matrix<double, N, N>& A) {
  Eigen::Matrix<double, N, N> small = A / 1024, term = Eigen::Matrix<double, N, N>::Identity(), sum = term;
  for (int k = 1; k < 12; ++k) sum += term = (term * small / k).eval();
  for (int k = 0; k < 10; ++k) sum = (sum * sum).eval();
  return sum;
}

}  // namespace

TEST_CASE("SO3: exp is the matrix exponential") {
  for (const Vector3& theta : test::awkward_turns<3>(1)) {
    // Ten squarings of the series multiply its rounding error by a thousand.
    CHECK((SO3::exp(theta).matrix() - series_exp<3>(hat(theta))).norm() < 1e-12);
  }
  CHECK((SO3::exp(Vector3(0, 0, kPi / 2)) * Vector3(1, 0, 0) - Vector3(0, 1, 0)).norm() < kRounding);
}

TEST_CASE("SO3: log inverts exp, with length at most pi") {
  for (const Vector3& theta : test::awkward_turns<3>(2)) {
    const Vector3 back = SO3::exp(theta).log();
    CHECK(back.norm() <= kPi * (1 + 4e-16));  // the norm rounds
    // A half turn is the same rotation about both directions of its axis.
    const double difference = std::min((back - theta).norm(), theta.norm() > 3.14159265 ? (back + theta).norm() : 10.0);
    CHECK(difference <= kRounding * theta.norm());
  }
  CHECK((SO3::exp(Vector3(0, 4, 0)).log() - Vector3(0, 4 - 2 * kPi, 0)).norm() < kRounding);
  CHECK(SO3().log() == Vector3::Zero());
}

TEST_CASE("SO3: quaternions are Hamilton, w first, and normalised") {
  const SO3 quarter = SO3::from_quaternion(10, 0, 0, 10);
  CHECK((quarter * Vector3(1, 0, 0) - Vector3(0, 1, 0)).norm() < kRounding);
  CHECK(std::abs(quarter.quaternion().w() - std::sqrt(0.5)) < kRounding);
  CHECK((SO3::from_quaternion(-2e-200, 0, 0, -2e-200).matrix() - quarter.matrix()).norm() < kRounding);
  for (const Vector3& theta : test::awkward_turns<3>(3)) {
    const SO3 R = SO3::exp(theta);
    CHECK((SO3::from_matrix(R.matrix()).matrix() - R.matrix()).norm() < kRounding);
  }
}

TEST_CASE("SO3: a long product stays a rotation") {
  const SO3 step = SO3::exp(Vector3(0.1, -0.2, 0.3));
  SO3 product;
  for (int i = 0; i < 100000; ++i) product = product * step;
  CHECK(std::abs(product.quaternion().norm() - 1) < kRounding);
}

TEST_CASE("SO2: angle, exp and log") {
  for (const Vector1& theta : test::awkward_turns<1>(4)) {
    const double back = SO2::exp(theta).log()[0];
    CHECK(std::abs(std::abs(back) - std::abs(theta[0])) <= kRounding * std::abs(theta[0]));
    CHECK((SO2::exp(theta).matrix() - SO3::exp(Vector3(0, 0, theta[0])).matrix().topLeftCorner<2, 2>()).norm() <
          kRounding);
  }
  CHECK((SO2::from_angle(kPi / 2) * Vector2(1, 0) - Vector2(0, 1)).norm() < kRounding);
  CHECK((SO2::from_matrix(SO2::from_angle(2).matrix()).matrix() - SO2::from_angle(2).matrix()).norm() < kRounding);
  SO2 product;
  for (int i = 0; i < 100000; ++i) product = product * SO2::from_angle(0.1);
  CHECK(std::abs(product.matrix().determinant() - 1) < kRounding);
}

TEST_CASE_TEMPLATE("rotations: left Jacobian and its inverse, turn", Pose, SE2, SE3) {
  using Rotation = typename Pose::Rotation;
  constexpr int n = Pose::kTurn;
  for (const auto& theta : test::awkward_turns<n>(5)) {
    const auto f = [&](const typename Rotation::Tangent& t) {
      return typename Rotation::Tangent((Rotation::exp(t) * Rotation::exp(theta).inverse()).log());
    };
    CHECK((Rotation::left_jacobian(theta) - test::jacobian<n>(f, theta)).norm() < kDifference);
    CHECK((Rotation::left_jacobian(theta) * Rotation::left_jacobian_inverse(theta) - Rotation::Jacobian::Identity())
              .norm() < kRounding);
    CHECK((Rotation::translation_jacobian(theta) * Rotation::translation_jacobian_inverse(theta) -
           Rotation::Matrix::Identity())
              .norm() < kRounding);
  }
  const typename Pose::Point x = test::Random(6).normal_vector<Pose::kDim>();
  const auto turned = [&](const typename Rotation::Tangent& t) { return typename Pose::Point(Rotation::exp(t) * x); };
  CHECK((Rotation::turn(x) - test::jacobian_at_zero<n>(turned)).norm() < kDifference);
}

TEST_CASE_TEMPLATE("rotations: what turns do to points and forces, and how long they are", Pose, SE2, SE3) {
  using Rotation = typename Pose::Rotation;
  test::Random random(41);
  for (const typename Rotation::Tangent& theta : test::awkward_turns<Pose::kTurn>(42)) {
    const Rotation R = Rotation::exp(theta);
    CHECK(R.chord() == doctest::Approx(2 * std::sin(theta.norm() / 2)).epsilon(1e-13).scale(1e-15));
    const typename Rotation::Tangent other = random.normal_vector<Pose::kTurn>();
    CHECK((R.adjoint(other) - R.adjoint() * other).norm() <= kRounding);
    const typename Pose::Point x = random.normal_vector<Pose::kDim>(), f = random.normal_vector<Pose::kDim>();
    const typename Rotation::Turn T = Rotation::turn(x);
    CHECK((Rotation::swing(other, x) - T * other).norm() <= kRounding);
    CHECK((Rotation::moment(x, f) - T.transpose() * f).norm() <= kRounding);
    CHECK((Rotation::inertia(x) - T.transpose() * T).norm() <= 10 * kRounding);
  }
}

TEST_CASE("SE3: exp is the matrix exponential") {
  for (const Vector6& tau : tangents<SE3>(7)) {
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    A.topLeftCorner<3, 3>() = hat(tau.tail<3>());
    A.topRightCorner<3, 1>() = tau.head<3>();
    const Eigen::Matrix4d T = series_exp<4>(A);
    CHECK((SE3::exp(tau).rotation().matrix() - T.topLeftCorner<3, 3>()).norm() < 1e-12);
    CHECK((SE3::exp(tau).translation() - T.topRightCorner<3, 1>()).norm() < 1e-11);
  }
}

TEST_CASE_TEMPLATE("poses: the laws of a group", Pose, SE2, SE3) {
  const std::vector<typename Pose::Tangent> taus = tangents<Pose>(8);
  for (std::size_t i = 0; i + 2 < taus.size(); ++i) {
    const Pose A = Pose::exp(taus[i]), B = Pose::exp(taus[i + 1]), C = Pose::exp(taus[i + 2]);
    const typename Pose::Point x = taus[i].template head<Pose::kDim>();
    CHECK(distance(A * A.inverse(), Pose()) < 10 * kRounding);
    CHECK(distance(A.inverse() * A, Pose()) < 10 * kRounding);
    CHECK(distance((A * B) * C, A * (B * C)) < 10 * kRounding);
    CHECK(distance(A * Pose(), A) < kRounding);
    CHECK(((A * B) * x - A * (B * x)).norm() < 10 * kRounding);
    CHECK((A * x - (A.rotation().matrix() * x + A.translation())).norm() < 10 * kRounding);
  }
}

TEST_CASE_TEMPLATE("poses: log undoes exp", Pose, SE2, SE3) {
  for (const typename Pose::Tangent& tau : tangents<Pose>(9)) {
    const Pose T = Pose::exp(tau);
    CHECK(distance(Pose::exp(T.log()), T) < 10 * kRounding);
    if (tau.template tail<Pose::kTurn>().norm() < 3.1415926) CHECK((T.log() - tau).norm() < 10 * kRounding);
  }
}

TEST_CASE_TEMPLATE("poses: left Jacobian, its inverse, and the adjoint", Pose, SE2, SE3) {
  using Tangent = typename Pose::Tangent;
  for (const Tangent& tau : tangents<Pose>(10)) {
    const Pose T = Pose::exp(tau);
    const auto f = [&](const Tangent& t) { return Tangent((Pose::exp(t) * T.inverse()).log()); };
    CHECK((Pose::left_jacobian(tau) - test::jacobian<Pose::kDof>(f, tau)).norm() < 10 * kDifference);
    CHECK((Pose::left_jacobian(tau) * Pose::left_jacobian_inverse(tau) - Pose::Square::Identity()).norm() <
          100 * kRounding);
    Tangent small = Tangent::LinSpaced(-0.4, 0.7);
    CHECK(distance(T * Pose::exp(small), Pose::exp(T.adjoint() * small) * T) < 100 * kRounding);
  }
}

TEST_CASE_TEMPLATE("poses: retract and the ordinary error", Pose, SE2, SE3) {
  const std::vector<typename Pose::Tangent> taus = tangents<Pose>(11);
  for (std::size_t i = 0; i + 1 < taus.size(); ++i) {
    const Pose truth = Pose::exp(taus[i]), estimate = Pose::exp(taus[i + 1]);
    const typename Pose::Tangent error = pose_error(truth, estimate);
    CHECK(distance(retract(estimate, error), truth) < 10 * kRounding);
    CHECK((error.template head<Pose::kDim>() - (truth.translation() - estimate.translation())).norm() < kRounding);
  }
}

TEST_CASE_TEMPLATE("poses: the ordinary error of a product", Pose, SE2, SE3) {
  using Tangent = typename Pose::Tangent;
  using Square = typename Pose::Square;
  test::Random random(15);
  const std::vector<Tangent> first = tangents<Pose>(16), second = tangents<Pose>(18);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const Pose T_a = Pose::exp(first[i]), T_b = Pose::exp(second[second.size() - 1 - i]), product = T_a * T_b;
    const ProductJacobians J(T_a, T_b);
    const auto error_of = [&](const Pose& moved) { return pose_error(moved, product); };
    const Square by_a = test::pose_jacobian([&](const Pose& X) { return error_of(X * T_b); }, T_a);
    const Square by_b = test::pose_jacobian([&](const Pose& X) { return error_of(T_a * X); }, T_b);
    CHECK((J.by_a - by_a).norm() < 10 * kDifference);
    CHECK((J.by_b - by_b).norm() < 10 * kDifference);
    Square A, B;
    for (int c = 0; c < Pose::kDof; ++c) {
      A.col(c) = random.normal_vector<Pose::kDof>();
      B.col(c) = random.normal_vector<Pose::kDof>();
    }
    const Square P_a = A * A.transpose(), P_b = B * B.transpose();
    const Square expected = by_a * P_a * by_a.transpose() + by_b * P_b * by_b.transpose();
    const Square covariance = J.covariance(P_a, P_b);
    CHECK((covariance - expected).norm() < 1e-8 * expected.norm());
    CHECK(covariance == covariance.transpose());
  }
}

TEST_CASE("SE2 is SE3 in the plane") {
  for (const Vector3& tau : tangents<SE2>(12)) {
    Vector6 spatial = Vector6::Zero();
    spatial << tau[0], tau[1], 0, 0, 0, tau[2];
    const int rows[] = {0, 1, 5};
    CHECK((SE2::exp(tau).translation() - SE3::exp(spatial).translation().head<2>()).norm() < 10 * kRounding);
    CHECK((SE2::left_jacobian(tau) - SE3::left_jacobian(spatial)(rows, rows)).norm() < 10 * kRounding);
    CHECK((SE2::exp(tau).adjoint() - SE3::exp(spatial).adjoint()(rows, rows)).norm() < 10 * kRounding);
  }
}

TEST_CASE("Stumpff functions: the series and the closed form meet") {
  const Stumpff below(std::nextafter(1.0, 0.0)), above(1.0);
  CHECK(std::abs(below.c0 - above.c0) < 1e-15);
  CHECK(std::abs(below.c1 - above.c1) < 1e-15);
  CHECK(std::abs(below.c2 - above.c2) < 1e-15);
  CHECK(std::abs(below.c3 - above.c3) < 1e-15);
  CHECK(std::abs(below.c4 - above.c4) < 1e-15);
  CHECK(std::abs(below.c5 - above.c5) < 1e-15);
}

TEST_CASE("Euler angles: yaw, then pitch, then roll") {
  const double c = std::cos(0.3), s = std::sin(0.3);
  Matrix3 Rx, Ry, Rz;
  Rx << 1, 0, 0, 0, c, -s, 0, s, c;
  Ry << c, 0, s, 0, 1, 0, -s, 0, c;
  Rz << c, -s, 0, s, c, 0, 0, 0, 1;
  CHECK((from_euler({0.3, 0.3, 0.3}).matrix() - Rz * Ry * Rx).norm() < kRounding);

  test::Random random(13);
  for (int i = 0; i < 1000; ++i) {
    const Euler in{random.uniform(-kPi, kPi), random.uniform(-1.5, 1.5), random.uniform(-kPi, kPi)};
    const Euler out = to_euler(from_euler(in));
    // Roll and yaw lose as many digits as cos(1.5) = 0.07 is below one.
    CHECK(std::abs(out.roll - in.roll) < 1e-13);
    CHECK(std::abs(out.pitch - in.pitch) < 1e-13);
    CHECK(std::abs(out.yaw - in.yaw) < 1e-13);
  }
}

TEST_CASE("Euler angles: at and near a pitch of a quarter turn") {
  for (double sign : {-1.0, 1.0}) {
    for (double off : {0.0, 1e-15, 1e-9, 1e-5}) {
      const SO3 R = from_euler({0.4, sign * (kPi / 2 - off), -2});
      const Euler angles = to_euler(R);
      CHECK(std::abs(angles.pitch) <= kPi / 2);
      CHECK((from_euler(angles).matrix() - R.matrix()).norm() < 10 * kRounding);
      if (off == 0) CHECK(angles.roll == 0);
    }
  }
}

TEST_CASE("wrap_angle: to (-pi, pi]") {
  CHECK(wrap_angle(kPi) == kPi);
  CHECK(wrap_angle(-kPi) == kPi);
  CHECK(wrap_angle(0.5) == 0.5);
  CHECK(std::abs(wrap_angle(7) - (7 - 2 * kPi)) < kRounding);
  CHECK(std::abs(wrap_angle(-101 * kPi) - kPi) < 1e-12);
}
