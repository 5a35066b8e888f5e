// SPDX-License-Identifier: BSD-3-Clause
#include "map/merge/triangles.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

// The smallest height of a triangle, in standard deviations of a side, and in parts of its longest side. The plane of a
// flatter triangle is too uncertain to lay another triangle onto it.
constexpr double kLeastHeight = 4, kLeastShape = 0.15;
// In parts of the median: triangles with a larger variance are left out, because they would widen every search.
constexpr double kMostVariance = 9;

// Variances of the distances between `members`, [i][j], from the joint covariance if there is one.
class SideVariances {
 public:
  SideVariances(const PointSet& set, const std::vector<std::size_t>& members) : set_(set), members_(members) {
    if (!set.joint) return;
    joint_.resize(9 * members.size() * members.size());
    set.joint(members.data(), members.size(), joint_.data());
  }
  double operator()(std::size_t i, std::size_t j) const {
    const Vector3 u = (set_.points[members_[i]] - set_.points[members_[j]]).normalized();
    if (!set_.joint) return u.dot((set_.covariances[members_[i]] + set_.covariances[members_[j]]) * u);
    const Matrix3 cross = block(i, j);
    return u.dot((block(i, i) + block(j, j) - cross - cross.transpose()) * u);
  }

 private:
  Matrix3 block(std::size_t i, std::size_t j) const {
    const auto n = 3 * static_cast<Eigen::Index>(members_.size());
    return Eigen::Map<const Eigen::MatrixXd>(joint_.data(), n, n)
        .block<3, 3>(3 * static_cast<Eigen::Index>(i), 3 * static_cast<Eigen::Index>(j));
  }
  const PointSet& set_;
  const std::vector<std::size_t>& members_;
  std::vector<double> joint_;
};

}  // namespace

Triangles make_triangles(const PointSet& set, const SpatialIndex& index, std::size_t corners, std::size_t neighbours,
                         std::size_t most) {
  Triangles result;
  const std::size_t n = set.points.size();
  std::vector<SpatialIndex::Hit> hits;
  std::vector<double> nearest;
  result.neighbours.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    index.nearest(set.points[i], neighbours + 1, hits);
    for (const SpatialIndex::Hit& hit : hits)
      if (hit.index != i) result.neighbours[i].push_back(static_cast<std::uint32_t>(hit.index));
    if (hits.size() > 1) nearest.push_back(hits[1].distance);
  }
  if (nearest.empty()) return result;
  std::nth_element(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2), nearest.end());
  result.spacing = nearest[nearest.size() / 2];

  for (std::size_t i = 0; i < n; ++i) {
    const std::vector<std::uint32_t>& around = result.neighbours[i];
    std::vector<std::size_t> members{i};
    for (std::size_t k = 0; k < std::min(corners, around.size()); ++k) members.push_back(around[k]);
    const SideVariances variance(set, members);
    for (std::size_t j = 1; j < members.size(); ++j)
      for (std::size_t k = j + 1; k < members.size(); ++k) {
        // Each triangle appears at each of its points. The point with the lowest index that has the others as
        // neighbours makes it.
        const auto makes = [&](std::size_t maker, std::size_t p, std::size_t q) {
          const auto& list = result.neighbours[maker];
          const auto end = list.begin() + static_cast<std::ptrdiff_t>(std::min(corners, list.size()));
          return std::find(list.begin(), end, p) != end && std::find(list.begin(), end, q) != end;
        };
        const std::size_t a = members[j], b = members[k];
        if ((a < i && makes(a, i, b)) || (b < i && makes(b, i, a))) continue;
        const std::array<std::size_t, 3> local{0, j, k};
        std::array<int, 3> order{0, 1, 2};
        Vector3 sides, variances;
        for (std::size_t s = 0; s < 3; ++s) {
          const std::size_t p = local[(s + 1) % 3], q = local[(s + 2) % 3];
          sides[static_cast<int>(s)] = (set.points[members[p]] - set.points[members[q]]).norm();
          variances[static_cast<int>(s)] = std::max(variance(p, q), 0.0);
        }
        std::sort(order.begin(), order.end(), [&](int x, int y) { return sides[x] < sides[y]; });
        Triangle triangle;
        for (int s = 0; s < 3; ++s) {
          triangle.points[static_cast<std::size_t>(s)] =
              static_cast<std::uint32_t>(members[local[static_cast<std::size_t>(order[static_cast<std::size_t>(s)])]]);
          triangle.sides[s] = sides[order[static_cast<std::size_t>(s)]];
          triangle.variances[s] = variances[order[static_cast<std::size_t>(s)]];
        }
        const Vector3 u = set.points[a] - set.points[i], v = set.points[b] - set.points[i];
        const double height = u.cross(v).norm() / triangle.sides[2];
        if (!(height > kLeastShape * triangle.sides[2] &&
              height > kLeastHeight * std::sqrt(triangle.variances.maxCoeff())))
          continue;
        result.triangles.push_back(triangle);
      }
  }
  std::vector<double> spread;
  for (const Triangle& triangle : result.triangles) spread.push_back(triangle.variances.maxCoeff());
  if (spread.empty()) return result;
  std::nth_element(spread.begin(), spread.begin() + static_cast<std::ptrdiff_t>(spread.size() / 2), spread.end());
  const double bound = kMostVariance * spread[spread.size() / 2];
  auto& all = result.triangles;
  all.erase(std::remove_if(all.begin(), all.end(), [&](const Triangle& t) { return t.variances.maxCoeff() > bound; }),
            all.end());
  if (all.size() > most) {  // evenly through the map
    for (std::size_t i = 0; i < most; ++i) all[i] = all[i * all.size() / most];
    all.resize(most);
  }
  return result;
}

std::vector<Matrix3> local_covariances(const PointSet& set, const SpatialIndex& index, std::size_t neighbours) {
  constexpr double kMostLeverage = 0.7;
  if (!set.joint || set.points.size() < 6) return set.covariances;  // too few to separate common and own errors
  std::vector<Matrix3> result;
  std::vector<SpatialIndex::Hit> hits;
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    index.nearest(set.points[i], neighbours + 1, hits);
    members.assign(1, i);
    for (const SpatialIndex::Hit& hit : hits)
      if (hit.index != i) members.push_back(hit.index);
    const auto n = 3 * static_cast<Eigen::Index>(members.size());
    Eigen::MatrixXd Sigma(n, n);
    set.joint(members.data(), members.size(), Sigma.data());
    // The rigid motions of the neighbourhood, an orthonormal basis of them, and the rest of point i's error.
    Eigen::Matrix<double, Eigen::Dynamic, 6> motions(n, 6);
    for (Eigen::Index m = 0; m < n; m += 3)
      motions.middleRows<3>(m) << Matrix3::Identity(),
          -hat(set.points[members[static_cast<std::size_t>(m / 3)]] - set.points[i]);
    const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, 6>> qr(motions);
    const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(n, qr.rank());
    Eigen::Matrix<double, 3, Eigen::Dynamic> rest = -Q.topRows<3>() * Q.transpose();
    const double leverage = std::min(-rest.leftCols<3>().trace() / 3, kMostLeverage);
    rest.leftCols<3>() += Matrix3::Identity();
    // The projected motion was estimated from this point, too. This reduces its error, which the factor corrects.
    const Matrix3 local = rest * Sigma * rest.transpose() / (1 - leverage);
    result.push_back(0.5 * (local + local.transpose()) + 1e-9 * set.covariances[i].trace() * Matrix3::Identity());
  }
  return result;
}

SE3 lay_onto(const std::array<Vector3, 3>& a, const std::array<Vector3, 3>& b) {
  const auto axes = [](const std::array<Vector3, 3>& p) {
    Matrix3 A;
    A.col(0) = (p[1] - p[0]).normalized();
    A.col(2) = A.col(0).cross(p[2] - p[0]).normalized();
    A.col(1) = A.col(2).cross(A.col(0));
    return A;
  };
  const SO3 R = SO3::from_matrix(axes(a) * axes(b).transpose());
  return SE3(R, (a[0] + a[1] + a[2]) / 3 - R * ((b[0] + b[1] + b[2]) / 3));
}

}  // namespace cairn
