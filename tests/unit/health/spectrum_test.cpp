// SPDX-License-Identifier: BSD-3-Clause
// Eigenvalues and components against Eigen's solver, by functions of the matrix.
#include "health/spectrum.hpp"

#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <random>

using namespace cairn;

namespace {

// Of b^T f(A) b, for f(x) = 1, x, x^2 and 1 / (1 + x), and of the eigenvalues.
template <class Square>
void compare(const Square& A, const typename Spectrum<Square>::Vector& b) {
  const Spectrum<Square> spectrum(A, b);
  const Eigen::SelfAdjointEigenSolver<Square> eigen(A);
  typename Spectrum<Square>::Vector sorted = spectrum.values;
  std::sort(sorted.data(), sorted.data() + sorted.size());
  const double size = 1e-300 + eigen.eigenvalues().cwiseAbs().maxCoeff();
  CHECK((sorted - eigen.eigenvalues()).norm() <= 1e-13 * size);
  const auto squares = spectrum.along.cwiseAbs2().eval();
  CHECK(squares.sum() == doctest::Approx(b.squaredNorm()).epsilon(1e-12));
  CHECK(std::abs(squares.dot(spectrum.values) - b.dot(A * b)) <= 1e-12 * size * b.squaredNorm());
  CHECK(std::abs(squares.dot(spectrum.values.cwiseAbs2()) - (A * b).squaredNorm()) <=
        1e-12 * size * size * b.squaredNorm());
  const Square shifted = Square::Identity() + A;
  const double inverse = b.dot(shifted.ldlt().solve(b));
  const auto by_inverse = squares.cwiseQuotient((spectrum.values.array() + 1.0).matrix()).sum();
  // Rounding moves each eigenvalue by a part of the largest one, as in Eigen's solver.
  CHECK(std::abs(by_inverse - inverse) <= 1e-13 * (1.0 + size) * b.squaredNorm());
}

template <int n>
void sweep() {
  using Square = Eigen::Matrix<double, n, n>;
  std::mt19937_64 engine(11);
  const auto normal = [&] { return std::normal_distribution<double>()(engine); };
  for (int k = 0; k < 200; ++k) {
    Square B;
    Eigen::Matrix<double, n, 1> b;
    for (int c = 0; c < n; ++c) {
      b(c) = normal();
      for (int r = 0; r < n; ++r) B(r, c) = normal();
    }
    const int rank = k % (n + 1);  // from none to full
    for (int c = rank; c < n; ++c) B.col(c).setZero();
    compare<Square>(B * B.transpose(), b);
    compare<Square>(B.transpose() * B, b);  // zero rows
    for (int c = 0; c < n; ++c) B.col(c) *= std::pow(10.0, 2 * c - 6);
    compare<Square>(B * B.transpose(), b);
    compare<Square>(Square(B.col(0).asDiagonal()), b);
  }
  compare<Square>(Square::Zero(), Eigen::Matrix<double, n, 1>::Ones());
  compare<Square>(3.0 * Square::Identity(), Eigen::Matrix<double, n, 1>::Ones());
  compare<Square>(Square::Ones(), Eigen::Matrix<double, n, 1>::LinSpaced(1, 2));
}

}  // namespace

TEST_CASE("spectrum: values and components, for every rank, and for values of different size") {
  sweep<3>();
  sweep<6>();
}

TEST_CASE("spectrum: a matrix that is not finite ends") {
  const Spectrum<Matrix6> spectrum(Matrix6::Constant(std::nan("")), Vector6::Ones());
  CHECK_FALSE(spectrum.values.allFinite());
}
