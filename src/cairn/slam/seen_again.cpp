// SPDX-License-Identifier: BSD-3-Clause
#include "slam/seen_again.hpp"

#include <numeric>
#include <utility>

#include "core/chi_square.hpp"
#include "core/error.hpp"
#include "geometry/embedding.hpp"

namespace cairn {
namespace {

// Without the landmarks that are not `left`; both matrices have further rows behind those of the landmarks.
template <class Pose>
void keep_only(const std::vector<Eigen::Index>& left, CommonPlaces<Pose>& common) {
  const auto behind = static_cast<Eigen::Index>(Pose::kDof + Pose::kDim * common.in_map.size());
  const auto keep_points = [&](std::vector<typename Pose::Point>& points) {
    std::vector<typename Pose::Point> kept;
    for (const Eigen::Index i : left) kept.push_back(points[static_cast<std::size_t>(i)]);
    points = std::move(kept);
  };
  const auto keep_rows = [&](Eigen::MatrixXd& matrix) {
    std::vector<Eigen::Index> rows(Pose::kDof);
    std::iota(rows.begin(), rows.end(), Eigen::Index{0});
    const std::vector<Eigen::Index> of_left = point_rows<Pose>(left, Pose::kDof);
    rows.insert(rows.end(), of_left.begin(), of_left.end());
    for (Eigen::Index row = behind; row < matrix.rows(); ++row) rows.push_back(row);
    matrix = Eigen::MatrixXd(matrix(rows, rows));
  };
  keep_points(common.in_map);
  keep_points(common.in_submap);
  keep_rows(common.P);
  keep_rows(common.Sigma);
  if (!common.fixed) return;
  std::vector<Eigen::Index> rows(Pose::kDof);
  std::iota(rows.begin(), rows.end(), Eigen::Index{0});
  const std::vector<Eigen::Index> of_left = point_rows<Pose>(left, Pose::kDof);
  rows.insert(rows.end(), of_left.begin(), of_left.end());
  common.gain = Eigen::MatrixXd(common.gain(rows, Eigen::all));
}

template <class Pose>
SubmapInnovation<Pose> innovation_at(const Pose& base, const CommonPlaces<Pose>& common) {
  const Eigen::Index m = common.Sigma.rows() - Pose::kDof;
  SubmapInnovation<Pose> innovation;
  innovation.sigma = common.Sigma.bottomRightCorner(m, m);
  if (common.fixed) innovation.use(*common.fixed, common.gain.bottomRows(m));
  innovation.linearise(base, common.in_map, common.in_submap);
  innovation.spread(common.P);
  return innovation;
}

}  // namespace

template <class Pose>
SeenAgain<Pose>::SeenAgain(const FilterOptions<Pose>& options)
    : options_(options), single_gate_(chi_square_quantile(kDim, options.gate_probability)) {}

template <class Pose>
typename SeenAgain<Pose>::Given SeenAgain<Pose>::given(const GlobalMap<Pose>& map, const State<Pose>& open,
                                                       const Commons& landmarks, const std::size_t* indices,
                                                       std::size_t count, const std::optional<FixedBase<Pose>>& fixed) {
  CommonPlaces<Pose> common;
  std::vector<Index> slots;
  for (const CommonLandmark& landmark : landmarks) {
    slots.push_back(landmark.slot);
    common.in_map.push_back(Embedding<Pose>::down(map.position(landmark.index)));
    common.in_submap.push_back(open.landmark(landmark.slot));
  }
  const auto size = static_cast<Eigen::Index>(kDof + kDim * slots.size()),
             rest = static_cast<Eigen::Index>(kDim * count);
  common.P = joint(map, landmarks, indices, count);
  Given given{map.base(), open.pose(), Matrix::Zero(2 * kDof + rest, 2 * kDof + rest)};
  given.covariance.bottomRightCorner(rest, rest) = common.P.bottomRightCorner(rest, rest);
  if (fixed) {
    common.fixed = fixed;
    gather_given_base(open, slots, common);
    fixed->correct(given.base, common.in_map, common.P);
  } else {
    common.Sigma.resize(size, size);
    open.gather_ordinary(slots.data(), static_cast<Index>(slots.size()), common.Sigma.data(), size);
  }
  given.covariance.template topLeftCorner<kDof, kDof>() = common.P.template topLeftCorner<kDof, kDof>();
  given.covariance.template block<kDof, kDof>(kDof, kDof) = common.Sigma.template topLeftCorner<kDof, kDof>();
  given.covariance.bottomLeftCorner(rest, kDof) = common.P.bottomLeftCorner(rest, kDof);
  given.covariance.topRightCorner(kDof, rest) = common.P.topRightCorner(kDof, rest);
  if (fixed) correct(common, given);
  if (!landmarks.empty()) condition(std::move(common), given);
  return given;
}

// The part of the open submap, given the error of its base.
template <class Pose>
void SeenAgain<Pose>::gather_given_base(const State<Pose>& open, const std::vector<Index>& slots,
                                        CommonPlaces<Pose>& common) const {
  const auto count = static_cast<Index>(slots.size()), first = kDof + open.systematic();
  Matrix joint(first + kDim * count, first + kDim * count);
  open.gather_systematic(slots.data(), count, joint.data(), joint.rows(), true);
  std::vector<Index> rows;
  for (Index row = 0; row < joint.rows(); ++row)
    if (row < kDof || row >= first) rows.push_back(row);
  const Matrix cross = joint.middleCols<kDof>(first - kDof)(rows, Eigen::all);
  common.gain = common.fixed->gain(cross);
  common.Sigma = joint(rows, rows) - common.gain * cross.transpose();
}

// The vehicle in the submap moves with the base.
template <class Pose>
void SeenAgain<Pose>::correct(const CommonPlaces<Pose>& common, Given& given) const {
  const FixedBase<Pose>& fixed = *common.fixed;
  const Vector moved = common.gain.template topRows<kDof>() * (fixed.error(given.base) - fixed.value);
  given.vehicle = retract(given.vehicle, typename Pose::Tangent(moved));
  const Square A = vehicle_by_base(common, given.base);
  Matrix& covariance = given.covariance;
  const Index rest = covariance.rows() - 2 * kDof;
  const Square P = covariance.template topLeftCorner<kDof, kDof>();
  covariance.template block<kDof, kDof>(kDof, 0) = A * P;
  covariance.template block<kDof, kDof>(0, kDof) = P * A.transpose();
  covariance.template block<kDof, kDof>(kDof, kDof) += A * P * A.transpose();
  covariance.block(kDof, 2 * kDof, kDof, rest) = A * covariance.topRightCorner(kDof, rest);
  covariance.block(2 * kDof, kDof, rest, kDof) = covariance.block(kDof, 2 * kDof, kDof, rest).transpose();
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
// y_i = R_S^T (l_i - p_S) with the noise Sigma_DD (docs/submaps.md, eq. P1). Where the gates refuse as many as they
// keep, or more, the closing may find back; until then the common landmarks say nothing.
template <class Pose>
void SeenAgain<Pose>::condition(CommonPlaces<Pose> common, Given& given) const {
  SubmapInnovation<Pose> innovation = innovation_at(given.base, common);
  const std::vector<Eigen::Index> left = accepted(innovation);
  if (2 * left.size() <= common.in_map.size()) return;
  given.agrees = true;
  if (left.size() < common.in_map.size()) {
    keep_only(left, common);
    innovation = innovation_at(given.base, common);
  }
  Eigen::LLT<Matrix> factor;
  Vector weights;
  if (iterate(given.base, common, innovation, factor, weights)) correct(common, innovation, factor, weights, given);
}

// The common landmarks that pass the gates of a closing; none if S is not definite.
template <class Pose>
std::vector<Eigen::Index> SeenAgain<Pose>::accepted(const SubmapInnovation<Pose>& innovation) const {
  InnovationBatch<Pose> batch(innovation);
  const auto bound = [&](Eigen::Index rows) {
    return chi_square_quantile(static_cast<double>(rows), options_.batch_gate_probability);
  };
  try {
    gate_blocks(batch, kDim, single_gate_, bound, [](Gate, Eigen::Index, double, double) {});
  } catch (const Error&) {
    return {};
  }
  return batch.numbers();
}

// Linearises until the linear model agrees with the true one at the new estimate of base and landmarks, as a frame does
// (docs/update.md). Gets the factor of S and S^-1 nu. Returns false if S is not definite.
template <class Pose>
bool SeenAgain<Pose>::iterate(const Pose& base, const CommonPlaces<Pose>& common, SubmapInnovation<Pose>& innovation,
                              Eigen::LLT<Matrix>& factor, Vector& weights) const {
  const Eigen::Index known = innovation.cross.cols() + kDof;  // states of [base; common landmarks]
  const double tolerance = options_.iteration_tolerance * options_.iteration_tolerance;
  Vector nu = innovation.residual;  // for errors of zero
  for (int i = 1;; ++i) {
    factor.compute(innovation.S);
    if (factor.info() != Eigen::Success) return false;
    weights = factor.solve(nu);
    if (i >= options_.iterations) return true;
    const Vector e = innovation.cross.topRows(known) * weights;
    const Vector foreseen = nu - innovation.change(e);
    std::vector<Point> points = common.in_map;
    for (std::size_t a = 0; a < points.size(); ++a)
      points[a] += e.template segment<kDim>(static_cast<Eigen::Index>(kDof + kDim * a));
    const typename Pose::Tangent e_base = e.template head<kDof>();
    innovation.linearise(retract(base, e_base), points, common.in_submap);
    const Vector miss = innovation.residual - foreseen;
    if ((miss.array().square() <= tolerance * innovation.sigma.diagonal().array()).all()) return true;
    // By errors of the estimate before the update, not of the iterate.
    const auto turn = Pose::Rotation::left_jacobian(e_base.template tail<kTurn>());
    for (auto& by_base : innovation.by_base)
      by_base.template rightCols<kTurn>() = (by_base.template rightCols<kTurn>() * turn).eval();
    nu = innovation.residual + innovation.change(e);
    innovation.spread(common.P);
  }
}

// docs/submaps.md, eq. P2. The submap's own estimates enter nu with a minus. The landmarks that were asked for stay.
template <class Pose>
void SeenAgain<Pose>::correct(const CommonPlaces<Pose>& common, const SubmapInnovation<Pose>& innovation,
                              const Eigen::LLT<Matrix>& factor, const Vector& weights, Given& given) const {
  const Eigen::Index m = weights.size(), rest = given.covariance.rows() - 2 * kDof;
  Matrix C(2 * kDof + rest, m);
  C.template topRows<kDof>() = innovation.cross.template topRows<kDof>();
  C.template middleRows<kDof>(kDof) = -common.Sigma.topRightCorner(kDof, m);
  if (common.fixed)
    C.template middleRows<kDof>(kDof) += vehicle_by_base(common, given.base) * C.template topRows<kDof>();
  C.bottomRows(rest) = innovation.cross.bottomRows(rest);
  const typename Pose::Tangent e_base = C.template topRows<kDof>() * weights,
                               e_vehicle = C.template middleRows<kDof>(kDof) * weights;
  const Matrix whitened = factor.matrixL().solve(C.transpose());
  Matrix covariance = given.covariance - whitened.transpose() * whitened;
  covariance.bottomRightCorner(rest, rest) = given.covariance.bottomRightCorner(rest, rest);
  if (!e_base.allFinite() || !e_vehicle.allFinite() || !covariance.allFinite()) return;
  given.base = retract(given.base, e_base);
  given.vehicle = retract(given.vehicle, e_vehicle);
  given.covariance = 0.5 * (covariance + covariance.transpose());
}

template class SeenAgain<SE2>;
template class SeenAgain<SE3>;

}  // namespace cairn
