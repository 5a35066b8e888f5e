// SPDX-License-Identifier: BSD-3-Clause
#include "slam/seen_again.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "core/chi_square.hpp"
#include "core/error.hpp"
#include "geometry/embedding.hpp"

namespace cairn {
namespace {

template <class Pose>
std::vector<typename Pose::Point> places_in_map(const GlobalMap<Pose>& map, const std::vector<CommonLandmark>& common) {
  std::vector<typename Pose::Point> points;
  for (const CommonLandmark& landmark : common) points.push_back(Embedding<Pose>::down(map.position(landmark.index)));
  return points;
}

template <class Pose>
std::vector<typename Pose::Point> places_in_submap(const State<Pose>& open, const std::vector<CommonLandmark>& common) {
  std::vector<typename Pose::Point> points;
  for (const CommonLandmark& landmark : common) points.push_back(open.landmark(landmark.slot));
  return points;
}

// Rows of [pose; landmarks; rest] that stay if only these landmarks stay of `count`.
template <class Pose>
std::vector<Eigen::Index> rows_left(const std::vector<Eigen::Index>& landmarks, std::size_t count, Eigen::Index size) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 0; row < Pose::kDof; ++row) rows.push_back(row);
  for (const Eigen::Index i : landmarks)
    for (Eigen::Index d = 0; d < Pose::kDim; ++d) rows.push_back(Pose::kDof + Pose::kDim * i + d);
  for (auto row = static_cast<Eigen::Index>(Pose::kDof + Pose::kDim * count); row < size; ++row) rows.push_back(row);
  return rows;
}

}  // namespace

template <class Pose>
SeenAgain<Pose>::SeenAgain(const FilterOptions<Pose>& options)
    : options_(options), single_gate_(chi_square_quantile(kDim, options.gate_probability)) {}

template <class Pose>
typename SeenAgain<Pose>::Given SeenAgain<Pose>::given(const GlobalMap<Pose>& map, const State<Pose>& open,
                                                       const Commons& common, const std::size_t* indices,
                                                       std::size_t count) {
  const auto m = static_cast<Eigen::Index>(kDim * common.size()), rest = static_cast<Eigen::Index>(kDim * count);
  const Matrix P = joint(map, common, indices, count);
  std::vector<Index> slots;
  for (const CommonLandmark& landmark : common) slots.push_back(landmark.slot);
  Matrix local(kDof + m, kDof + m);
  open.gather_ordinary(slots.data(), static_cast<Index>(slots.size()), local.data(), kDof + m);

  Given given{map.base(), open.pose(), Matrix::Zero(2 * kDof + rest, 2 * kDof + rest)};
  given.covariance.template topLeftCorner<kDof, kDof>() = P.template topLeftCorner<kDof, kDof>();
  given.covariance.template block<kDof, kDof>(kDof, kDof) = local.template topLeftCorner<kDof, kDof>();
  given.covariance.bottomLeftCorner(rest, kDof) = P.bottomLeftCorner(rest, kDof);
  given.covariance.topRightCorner(kDof, rest) = P.topRightCorner(kDof, rest);
  given.covariance.bottomRightCorner(rest, rest) = P.bottomRightCorner(rest, rest);
  if (!common.empty()) solve(map, open, common, P, local, given);
  return given;
}

// The joint covariance of [base; common landmarks; landmarks that were asked for]. The map does not change while a
// submap is open, and the common landmarks change seldom: the part without those that were asked for is kept.
template <class Pose>
typename SeenAgain<Pose>::Matrix SeenAgain<Pose>::joint(const GlobalMap<Pose>& map, const Commons& common,
                                                        const std::size_t* indices, std::size_t count) {
  std::vector<std::size_t> landmarks;
  for (const CommonLandmark& landmark : common) landmarks.push_back(landmark.index);
  const auto gather = [&] {
    const auto size = static_cast<Eigen::Index>(kDof + kDim * landmarks.size());
    Matrix P(size, size);
    map.base_joint_covariance(landmarks.data(), landmarks.size(), P.data());
    return P;
  };
  if (count > 0) {
    landmarks.insert(landmarks.end(), indices, indices + count);
    return gather();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (P_.size() == 0 || revision_ != map.revision() || landmarks_ != landmarks) {
    P_ = gather();
    revision_ = map.revision();
    landmarks_ = landmarks;
  }
  return P_;
}

// The same update as that of a closing, for base and vehicle alone: the common landmarks are one batch of observations
// y_i = R_S^T (l_i - p_S) with the noise Sigma_DD (docs/submaps.md, "The pose" and "Fusing"). Sigma is correlated with the
// vehicle's pose in the submap, so that its error is estimated, too. Where the landmarks that the gates refuse outnumber
// the others, the closing may find back; until then they say nothing.
template <class Pose>
void SeenAgain<Pose>::solve(const GlobalMap<Pose>& map, const State<Pose>& open, const Commons& common,
                            const Matrix& P_all, const Matrix& local_all, Given& given) const {
  const Pose base = given.base;
  SubmapInnovation<Pose> innovation;
  innovation.sigma = local_all.bottomRightCorner(local_all.rows() - kDof, local_all.cols() - kDof);
  innovation.linearise(base, places_in_map(map, common), places_in_submap(open, common));
  innovation.spread(P_all);
  InnovationBatch<Pose> batch(innovation);
  const auto bound = [&](Eigen::Index rows) {
    return chi_square_quantile(static_cast<double>(rows), options_.batch_gate_probability);
  };
  try {
    gate_blocks(batch, kDim, single_gate_, bound, [](Gate, Eigen::Index, double, double) {});
  } catch (const Error&) {  // S is not definite: numbers without meaning say nothing
    return;
  }
  const std::vector<Eigen::Index> left = batch.numbers();
  if (2 * left.size() <= common.size() || left.empty()) return;

  Commons kept;
  for (const Eigen::Index i : left) kept.push_back(common[static_cast<std::size_t>(i)]);
  const bool all = kept.size() == common.size();
  const std::vector<Eigen::Index> rows = rows_left<Pose>(left, common.size(), P_all.rows());
  const std::vector<Eigen::Index> local_rows = rows_left<Pose>(left, common.size(), local_all.rows());
  const Matrix P = all ? P_all : Matrix(P_all(rows, rows));
  const Matrix local = all ? local_all : Matrix(local_all(local_rows, local_rows));
  const auto m = static_cast<Eigen::Index>(kDim * kept.size()), rest = given.covariance.rows() - 2 * kDof;
  const std::vector<Point> places = places_in_map(map, kept), seen = places_in_submap(open, kept);
  innovation.sigma = local.bottomRightCorner(m, m);

  // Iterated as in docs/update.md: the residual of the linear model at the new estimate of base and landmarks must be
  // that of the true one.
  Vector e = Vector::Zero(kDof + m), weights;
  Eigen::LLT<Matrix> factor;
  std::vector<Point> points = places;
  innovation.linearise(base, points, seen);
  for (int i = 1;; ++i) {
    const typename Pose::Tangent e_base = e.template head<kDof>();
    const auto turn = Pose::Rotation::left_jacobian(e_base.template tail<kTurn>());
    Vector linear = innovation.residual;  // of the landmarks, for errors of zero
    for (Eigen::Index a = 0; a < innovation.count(); ++a) {
      auto& by_base = innovation.by_base[static_cast<std::size_t>(a)];
      by_base.template rightCols<kTurn>() = (by_base.template rightCols<kTurn>() * turn).eval();
      linear.template segment<kDim>(kDim * a) +=
          by_base * e_base + innovation.by_point * e.template segment<kDim>(kDof + kDim * a);
    }
    innovation.spread(P);
    factor.compute(innovation.S);
    if (factor.info() != Eigen::Success) return;
    weights = factor.solve(linear);
    e = innovation.cross.topRows(kDof + m) * weights;
    if (i >= options_.iterations) break;
    for (std::size_t a = 0; a < places.size(); ++a)
      points[a] = places[a] + e.template segment<kDim>(static_cast<Eigen::Index>(kDof + kDim * a));
    Vector foreseen = linear;
    for (Eigen::Index a = 0; a < innovation.count(); ++a)
      foreseen.template segment<kDim>(kDim * a) -=
          innovation.by_base[static_cast<std::size_t>(a)] * e.template head<kDof>() +
          innovation.by_point * e.template segment<kDim>(kDof + kDim * a);
    innovation.linearise(retract(base, typename Pose::Tangent(e.template head<kDof>())), points, seen);
    const Vector miss = innovation.residual - foreseen;
    if ((miss.array().square() <=
         options_.iteration_tolerance * options_.iteration_tolerance * innovation.sigma.diagonal().array())
            .all())
      break;
  }
  // [base; vehicle; asked for] with nu: the submap's landmarks enter nu with a minus.
  Matrix cross(2 * kDof + rest, m);
  cross.template topRows<kDof>() = innovation.cross.template topRows<kDof>();
  cross.template middleRows<kDof>(kDof) = -local.topRightCorner(kDof, m);
  cross.bottomRows(rest) = innovation.cross.bottomRows(rest);
  const typename Pose::Tangent e_base = cross.template topRows<kDof>() * weights,
                               e_vehicle = cross.template middleRows<kDof>(kDof) * weights;
  const Matrix whitened = factor.matrixL().solve(cross.transpose());
  Matrix covariance = given.covariance - whitened.transpose() * whitened;
  covariance.bottomRightCorner(rest, rest) = given.covariance.bottomRightCorner(rest, rest);
  if (!e_base.allFinite() || !e_vehicle.allFinite() || !covariance.allFinite()) return;
  given.base = retract(base, e_base);
  given.vehicle = retract(given.vehicle, e_vehicle);
  given.covariance = 0.5 * (covariance + covariance.transpose());
}

template class SeenAgain<SE2>;
template class SeenAgain<SE3>;

}  // namespace cairn
