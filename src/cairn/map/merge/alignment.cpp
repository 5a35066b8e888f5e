// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/alignment.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/chi_square.hpp"

namespace cairn {
namespace {

using Columns = Eigen::Matrix<double, Eigen::Dynamic, 6>;
using Dense = Eigen::MatrixXd;
using DenseVector = Eigen::VectorXd;
using Eigen::Index;

constexpr int kIterations = 100;
constexpr int kHalvings = 12;
constexpr double kShort = 1e-3;  // standard deviations

// How long the last step may be, in standard deviations of the transform. Where pairs contradict each other the steps
// shrink slowly, and the digits are worth nothing.
double converged(double distance, int dof) {
  const double misfit = 1 + distance / std::max(dof, 1);
  return std::min(1e-9 * misfit * misfit * misfit, 0.1);
}

Index at(std::size_t i) {
  return 3 * static_cast<Index>(i);
}

Eigen::Map<const Dense> matrix_of(const std::vector<double>& full, std::size_t k) {
  return {full.data(), at(k), at(k)};
}

// S = Sigma_a + R Sigma_b R^T, factored: in blocks as long as no pair is correlated with another.
class Weight {
 public:
  bool factor(const PairedPoints& pairs, const Matrix3& R) {
    const std::size_t k = pairs.size();
    full_ = !pairs.covariance_a.full.empty() || !pairs.covariance_b.full.empty();
    if (!full_) {
      blocks_.resize(k);
      for (std::size_t i = 0; i < k; ++i) {
        blocks_[i].compute(pairs.covariance_a.blocks[i] + R * pairs.covariance_b.blocks[i] * R.transpose());
        if (blocks_[i].info() != Eigen::Success) return false;
      }
      return true;
    }
    Dense S = Dense::Zero(at(k), at(k));
    if (!pairs.covariance_b.full.empty()) {
      S = matrix_of(pairs.covariance_b.full, k);
      for (std::size_t i = 0; i < k; ++i) S.middleRows<3>(at(i)) = (R * S.middleRows<3>(at(i))).eval();
      for (std::size_t i = 0; i < k; ++i) S.middleCols<3>(at(i)) = (S.middleCols<3>(at(i)) * R.transpose()).eval();
    } else {
      for (std::size_t i = 0; i < k; ++i)
        S.block<3, 3>(at(i), at(i)) = R * pairs.covariance_b.blocks[i] * R.transpose();
    }
    if (!pairs.covariance_a.full.empty()) {
      S += matrix_of(pairs.covariance_a.full, k);
    } else {
      for (std::size_t i = 0; i < k; ++i) S.block<3, 3>(at(i), at(i)) += pairs.covariance_a.blocks[i];
    }
    dense_.compute(S);
    return dense_.info() == Eigen::Success;
  }

  // X <- S^-1 X
  template <class Matrix>
  void solve(Matrix& X) const {
    if (full_) {
      dense_.solveInPlace(X);
    } else {
      for (std::size_t i = 0; i < blocks_.size(); ++i)
        X.template middleRows<3>(at(i)) = blocks_[i].solve(X.template middleRows<3>(at(i)).eval()).eval();
    }
  }

  bool full() const { return full_; }
  Dense inverse() const { return dense_.solve(Dense::Identity(dense_.rows(), dense_.cols())); }
  Matrix3 inverse_block(std::size_t i) const { return blocks_[i].solve(Matrix3::Identity()); }

 private:
  bool full_ = false;
  std::vector<Eigen::LLT<Matrix3>> blocks_;
  Eigen::LLT<Dense> dense_;
};

// The problem at one transform. J is the derivative of a - T b by [dq; dtheta], where dq moves the points' centre:
// far from the origin dp and dtheta would be all but the same.
struct Linearisation {
  Weight weight;
  DenseVector lambda;  // S^-1 (a - T b)
  Columns J, V;        // V = S^-1 J
  Vector3 centre;      // of R b
  Matrix6 to_ordinary() const {
    Matrix6 A = Matrix6::Identity();
    A.topRightCorner<3, 3>() = hat(centre);  // dp = dq - dtheta x centre
    return A;
  }
};

// False where S has no factor. `distance` is the points' part.
bool residuals(const PairedPoints& pairs, const SE3& T, Linearisation& at_T, double& distance) {
  const std::size_t k = pairs.size();
  if (!at_T.weight.factor(pairs, T.rotation().matrix())) return false;
  DenseVector r(at(k));
  for (std::size_t i = 0; i < k; ++i) r.segment<3>(at(i)) = pairs.a[i] - T * pairs.b[i];
  at_T.lambda = r;
  at_T.weight.solve(at_T.lambda);
  distance = r.dot(at_T.lambda);
  return std::isfinite(distance);
}

// The derivative is taken at the points b as the residuals correct them, b + Sigma_b R^T lambda: then J^T lambda is
// exactly half the gradient of the distance, though S turns with R.
void linearise(const PairedPoints& pairs, const SE3& T, Linearisation& at_T) {
  const std::size_t k = pairs.size();
  const Matrix3 R = T.rotation().matrix();
  DenseVector turned(at(k)), correction(at(k));
  for (std::size_t i = 0; i < k; ++i) turned.segment<3>(at(i)) = R.transpose() * at_T.lambda.segment<3>(at(i));
  if (!pairs.covariance_b.full.empty()) {
    correction.noalias() = matrix_of(pairs.covariance_b.full, k) * turned;
  } else {
    for (std::size_t i = 0; i < k; ++i)
      correction.segment<3>(at(i)) = pairs.covariance_b.blocks[i] * turned.segment<3>(at(i));
  }
  at_T.centre.setZero();
  for (const Vector3& b : pairs.b) at_T.centre += R * b / static_cast<double>(k);
  at_T.J.resize(at(k), 6);
  for (std::size_t i = 0; i < k; ++i) {
    const Vector3 arm = R * (pairs.b[i] + correction.segment<3>(at(i))) - at_T.centre;
    at_T.J.block<3, 3>(at(i), 0) = -Matrix3::Identity();
    at_T.J.block<3, 3>(at(i), 3) = hat(arm);
  }
  at_T.V = at_T.J;
  at_T.weight.solve(at_T.V);
}

// The iterate: without a prior the transform itself, with one also u in T = retract(prior, G u), where
// u ~ N(0, I) and G G^T is the prior's covariance, which may be singular.
struct Search {
  const TransformPrior* prior;
  Matrix6 G = Matrix6::Zero();
  SE3 T;
  Vector6 u = Vector6::Zero();

  explicit Search(const TransformPrior* given) : prior(given) {
    if (prior == nullptr) return;
    const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(prior->covariance);
    G = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
    T = prior->T_a_b;
  }

  // Derivative of T's error [dq; dtheta] by the unknowns.
  Matrix6 chain(const Linearisation& at_T) const {
    if (prior == nullptr) return Matrix6::Identity();
    const Vector6 error = G * u;
    Matrix6 to_T = Matrix6::Identity(), to_centre = Matrix6::Identity();
    to_T.bottomRightCorner<3, 3>() = SO3::left_jacobian(error.tail<3>());
    to_centre.topRightCorner<3, 3>() = -hat(at_T.centre);
    return to_centre * to_T * G;
  }

  Search moved(const Vector6& step, const Vector3& centre) const {
    Search next = *this;
    if (prior == nullptr) {
      const SO3 turn = SO3::exp(step.tail<3>());
      next.T = SE3(turn * T.rotation(), T.translation() + step.head<3>() + centre - turn * centre);
    } else {
      next.u += step;
      next.T = retract(prior->T_a_b, G * next.u);
    }
    return next;
  }
};

std::vector<double> weights_of(const PairedPoints& pairs) {
  const std::size_t k = pairs.size();
  const auto trace = [k](const PointsCovariance& covariance, std::size_t i) {
    if (covariance.full.empty()) return covariance.blocks[i].trace();
    return matrix_of(covariance.full, k).diagonal().segment<3>(at(i)).sum();
  };
  std::vector<double> weights;
  for (std::size_t i = 0; i < k; ++i)
    weights.push_back(1 / std::max(trace(pairs.covariance_a, i) + trace(pairs.covariance_b, i), 1e-100));
  return weights;
}

// Falls of all pairs: with M = S^-1 - V C V^T the fall is lambda_i^T M_ii^-1 lambda_i. What M_ii does not see, no pair
// but this one determines: nothing can fall there.
double fall_of(const Matrix3& M, const Vector3& lambda, double scale) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(M);
  double fall = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = eigen.eigenvectors().col(axis).dot(lambda);
    if (eigen.eigenvalues()[axis] > 1e-9 * scale) fall += along * along / eigen.eigenvalues()[axis];
  }
  return fall;
}

struct Solution {
  Alignment alignment;
  Linearisation at_T;
  Matrix6 centred;  // covariance of [dq; dtheta]
};

void solve(const PairedPoints& pairs, const TransformPrior* prior, const SE3* start, Solution& solution) {
  const std::size_t k = pairs.size();
  Alignment& result = solution.alignment;
  Linearisation& now = solution.at_T;
  result = Alignment{};
  if (k < (prior == nullptr ? 3u : 1u)) return;
  result.dof = 3 * static_cast<int>(k) - (prior == nullptr ? 6 : 0);

  Search search(prior);
  if (prior == nullptr) {
    result.status = AlignmentStatus::degenerate;
    if (start != nullptr) {
      search.T = *start;
    } else if (!align_by_weights(pairs.a, pairs.b, weights_of(pairs), search.T)) {
      return;
    }
  }
  double distance = 0;
  result.status = AlignmentStatus::singular;
  if (!residuals(pairs, search.T, now, distance)) return;
  result.status = AlignmentStatus::diverged;

  bool stalled = false;
  for (int i = 0; i < kIterations; ++i) {
    linearise(pairs, search.T, now);
    const Matrix6 chain = search.chain(now);
    Matrix6 A = chain.transpose() * (now.J.transpose() * now.V) * chain;
    Vector6 gradient = chain.transpose() * (now.J.transpose() * now.lambda);
    if (prior != nullptr) {
      A += Matrix6::Identity();
      gradient += search.u;
    }
    // Scaled to a unit diagonal, so that metres and radians weigh alike.
    const Vector6 scale = A.diagonal().cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(Matrix6(scale.asDiagonal() * A * scale.asDiagonal()));
    if (!(eigen.eigenvalues()[0] > 1e-12)) {
      result.status = AlignmentStatus::degenerate;
      return;
    }
    const Matrix6 root = scale.asDiagonal() * eigen.eigenvectors();
    const Matrix6 inverse = root * eigen.eigenvalues().cwiseInverse().asDiagonal() * root.transpose();
    const Vector6 step = -inverse * gradient;
    const double length = std::sqrt(step.dot(A * step));
    if (stalled || length <= converged(distance, result.dof)) {
      result.status = AlignmentStatus::ok;
      result.T_a_b = search.T;
      result.distance = distance + search.u.squaredNorm();
      solution.centred = chain * inverse * chain.transpose();
      result.covariance = now.to_ordinary() * solution.centred * now.to_ordinary().transpose();
      // A line of points, about which nothing can be said, still shows some breadth by its noise alone: of variance
      // one for each point and each of two directions, in units of its covariance. Twice that breadth is asked for.
      const double turn_variance =
          Eigen::SelfAdjointEigenSolver<Matrix3>(solution.centred.bottomRightCorner<3, 3>()).eigenvalues()[2];
      if (prior == nullptr && !(turn_variance * 4 * static_cast<double>(k) < 1))
        result.status = AlignmentStatus::degenerate;
      return;
    }
    double factor = 1;
    const double before = distance + search.u.squaredNorm();
    Search next = search;
    bool fell = false;
    for (int halving = 0; halving < kHalvings && !fell; ++halving, factor /= 2) {
      next = search.moved(factor * step, now.centre);
      // What rounding leaves of a distance must not stop the last steps.
      fell = residuals(pairs, next.T, now, distance) && distance + next.u.squaredNorm() <= before * (1 + 1e-12) + 1e-12;
    }
    if (!fell) {
      // In maps that have drifted far, S is ill-conditioned, and rounding hides what so short a step would gain.
      if (!(length <= kShort) || !residuals(pairs, search.T, now, distance)) return;
      stalled = true;
      continue;
    }
    search = next;
  }
}

void find_falls(const PairedPoints& pairs, Solution& solution) {
  const Linearisation& now = solution.at_T;
  const Dense S_inverse = now.weight.full() ? now.weight.inverse() : Dense();
  solution.alignment.falls.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Matrix3 own = now.weight.full() ? Matrix3(S_inverse.block<3, 3>(at(i), at(i))) : now.weight.inverse_block(i);
    const auto V = now.V.middleRows<3>(at(i));
    const Matrix3 M = own - V * solution.centred * V.transpose();
    solution.alignment.falls.push_back(fall_of(M, now.lambda.segment<3>(at(i)), own.trace()));
  }
}

std::size_t worst_of(const std::vector<double>& falls) {
  return static_cast<std::size_t>(std::max_element(falls.begin(), falls.end()) - falls.begin());
}

// The bounds of a compatible set: of its joint distance, and of the fall of each pair.
struct Bounds {
  double probability, of_pair;
  bool kept(double distance, int dof, double worst_fall) const {
    return worst_fall <= of_pair && distance <= chi_square_quantile(dof, probability);
  }
};

// Which pairs to leave out until the linearised problem is within the bounds: M and lambda without a pair by block
// inversion, as the update does it (docs/update.md). Not many before the next look at the problem itself: the transform
// moves when a gross error leaves.
std::vector<std::size_t> find_contradicting(const PairedPoints& pairs, const Solution& solution, const Bounds& bounds,
                                            std::size_t most) {
  const Linearisation& now = solution.at_T;
  const std::size_t k = pairs.size();
  Dense M = now.weight.inverse();
  const DenseVector own = M.diagonal();
  M.noalias() -= now.V * solution.centred * now.V.transpose();
  DenseVector lambda = now.lambda;
  double distance = solution.alignment.distance;
  int dof = solution.alignment.dof;
  std::vector<bool> out(k, false);
  std::vector<std::size_t> order;
  do {
    std::vector<double> falls(k, -1.0);
    for (std::size_t i = 0; i < k; ++i)
      if (!out[i])
        falls[i] = fall_of(M.block<3, 3>(at(i), at(i)), lambda.segment<3>(at(i)), own.segment<3>(at(i)).sum());
    const std::size_t worst = worst_of(falls);
    if (bounds.kept(distance, dof, falls[worst])) break;
    order.push_back(worst);
    out[worst] = true;
    distance -= falls[worst];
    dof -= 3;
    const Eigen::SelfAdjointEigenSolver<Matrix3> D(M.block<3, 3>(at(worst), at(worst)));
    if (!(D.eigenvalues()[0] > 1e-9 * own.segment<3>(at(worst)).sum())) break;  // no downdate: solve anew
    const Eigen::Matrix<double, Eigen::Dynamic, 3> B =
        M.middleCols<3>(at(worst)) * D.eigenvectors() * D.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal();
    const Vector3 part = D.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal() *
                         (D.eigenvectors().transpose() * lambda.segment<3>(at(worst)));
    lambda.noalias() -= B * part;
    M.noalias() -= B * B.transpose();
  } while (order.size() < most);
  return order;
}

}  // namespace

bool align_by_weights(const std::vector<Vector3>& a, const std::vector<Vector3>& b, const std::vector<double>& weights,
                      SE3& T_a_b) {
  if (a.size() < 3) return false;
  double sum = 0;
  Vector3 mean_a = Vector3::Zero(), mean_b = Vector3::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += weights[i];
    mean_a += weights[i] * a[i];
    mean_b += weights[i] * b[i];
  }
  mean_a /= sum;
  mean_b /= sum;
  Matrix3 H = Matrix3::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) H += (weights[i] / sum) * (a[i] - mean_a) * (b[i] - mean_b).transpose();
  const Eigen::JacobiSVD<Matrix3, Eigen::NoQRPreconditioner> svd(H, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (!(svd.singularValues()[1] > 1e-12 * svd.singularValues()[0])) return false;
  Vector3 signs = Vector3::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) signs.z() = -1;
  const SO3 R = SO3::from_matrix(svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose());
  T_a_b = SE3(R, mean_a - R * mean_b);
  return true;
}

PairedPoints select_pairs(const PairedPoints& pairs, const std::vector<std::size_t>& which) {
  PairedPoints selected;
  const auto select = [&](const PointsCovariance& from, PointsCovariance& to) {
    if (from.full.empty()) {
      for (std::size_t i : which) to.blocks.push_back(from.blocks[i]);
      return;
    }
    const auto all = matrix_of(from.full, pairs.size());
    to.full.resize(9 * which.size() * which.size());
    Eigen::Map<Dense> part(to.full.data(), at(which.size()), at(which.size()));
    for (std::size_t j = 0; j < which.size(); ++j)
      for (std::size_t i = 0; i < which.size(); ++i)
        part.block<3, 3>(at(i), at(j)) = all.block<3, 3>(at(which[i]), at(which[j]));
  };
  for (std::size_t i : which) {
    selected.a.push_back(pairs.a[i]);
    selected.b.push_back(pairs.b[i]);
  }
  select(pairs.covariance_a, selected.covariance_a);
  select(pairs.covariance_b, selected.covariance_b);
  return selected;
}

Alignment align(const PairedPoints& pairs, const TransformPrior* prior, bool with_falls, const SE3* start) {
  Solution solution;
  solve(pairs, prior, start, solution);
  if (with_falls && solution.alignment.ok()) find_falls(pairs, solution);
  return solution.alignment;
}

CompatibleAlignment align_compatible(const PairedPoints& pairs, double probability, double pair_probability,
                                     const TransformPrior* prior, const SE3* start) {
  const Bounds bounds{probability, chi_square_quantile(3, pair_probability)};
  const std::size_t least = prior == nullptr ? 3 : 1;
  CompatibleAlignment result;
  for (std::size_t i = 0; i < pairs.size(); ++i) result.kept.push_back(i);
  PairedPoints rest = pairs;
  Solution solution;
  SE3 last;
  for (;;) {
    solve(rest, prior, start, solution);
    result.alignment = solution.alignment;
    if (!solution.alignment.ok()) break;
    std::vector<std::size_t> leave;
    if (solution.at_T.weight.full()) {
      const std::size_t most = rest.size() > least ? std::min(rest.size() - least, 1 + rest.size() / 16) : 1;
      leave = find_contradicting(rest, solution, bounds, most);
    } else {  // so cheap that it is solved anew after each
      find_falls(rest, solution);
      const std::size_t worst = worst_of(solution.alignment.falls);
      if (!bounds.kept(solution.alignment.distance, solution.alignment.dof, solution.alignment.falls[worst]))
        leave.push_back(worst);
    }
    if (leave.empty()) return result;
    if (rest.size() <= least) break;
    for (std::size_t i : leave) result.left_out.push_back(result.kept[i]);
    std::vector<bool> out(rest.size(), false);
    for (std::size_t i : leave) out[i] = true;
    std::vector<std::size_t> stay, kept;
    for (std::size_t i = 0; i < rest.size(); ++i)
      if (!out[i]) {
        stay.push_back(i);
        kept.push_back(result.kept[i]);
      }
    rest = select_pairs(rest, stay);
    result.kept = kept;
    last = solution.alignment.T_a_b;
    start = &last;
  }
  result.kept.clear();
  return result;
}

}  // namespace cairn
