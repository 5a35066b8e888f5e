// SPDX-License-Identifier: BSD-3-Clause
// What the open submap shares with the map: systematic errors, and the error of its base, of which absolute fixes tell.
#include <Eigen/Cholesky>
#include <new>

#include "ekf/fix_rows.hpp"
#include "slam/submap_keeper.hpp"

namespace cairn {

// The prior of the systematic errors, and of the base once there are fixes, is what the map knows of them. The closing
// takes exactly this prior out again (docs/systematic_errors.md, eq. 12), so that it may be as narrow as it is.
template <class Pose>
void SubmapKeeper<Pose>::open() {
  fixes_ = 0;
  if (gets_fixes_) {
    base_ = map_->base();
    base_covariance_ = map_->base_covariance();
    // A base that is known exactly counts as known to a micrometre and to a tenth of a microradian.
    for (int d = 0; d < kDof; ++d) base_covariance_(d, d) += d < kDim ? 1e-12 : 1e-14;
  }
  const Square* base = gets_fixes_ ? &base_covariance_ : nullptr;
  if (!shares_errors())  // deferred landmarks have to be found again
    return local_.start(Pose(), Square::Zero(), nullptr, nullptr, base);
  try {
    const Index g = local_.systematic().count();
    const Eigen::MatrixXd joint = map_->joint_with_errors(nullptr, 0);
    next_prior_ = map_->errors();
    next_covariance_ = joint.block(kDof, kDof, g, g);
  } catch (const std::bad_alloc&) {
    // What the last submap knew is a prior, too: every prior is taken out again.
  }
  prior_.swap(next_prior_);
  prior_covariance_.swap(next_covariance_);
  local_.start(Pose(), Square::Zero(), prior_.data(), prior_covariance_.data(), base);
}

// The systematic errors, then the error of the base if the submap had fixes.
template <class Pose>
SubmapErrors SubmapKeeper<Pose>::take_errors(const std::vector<Index>& slots) const {
  const SystematicErrors& errors = local_.systematic();
  const State<Pose>& state = local_.state();
  const auto count = static_cast<Index>(slots.size());
  const Index states = state.systematic(), g = errors.count(), n = kDof + states + kDim * count;
  const Index shared = g + (fixed() ? kDof : 0);
  Eigen::MatrixXd joint(n, n);
  state.gather_systematic(slots.data(), count, joint.data(), n);
  std::vector<Index> of_errors, of_rest;
  for (Index i = 0; i < g; ++i) of_errors.push_back(kDof + errors.numbers(i).start);
  for (Index d = 0; d < shared - g; ++d) of_errors.push_back(kDof + errors.states() + d);
  for (Index i = 0; i < g; ++i)
    if (errors.numbers(i).walked != SystematicErrors::kNone) of_errors.push_back(kDof + errors.numbers(i).walked);
  for (Index i = 0; i < n; ++i)
    if (i < kDof || i >= kDof + states) of_rest.push_back(i);
  SubmapErrors out{
      Eigen::VectorXd::Zero(shared), Eigen::MatrixXd::Zero(shared, shared), {}, {}, joint(of_rest, of_errors),
      joint(of_errors, of_errors)};
  out.prior.head(g) = prior_.head(g);
  out.prior_covariance.topLeftCorner(g, g) = prior_covariance_.topLeftCorner(g, g);
  if (fixed()) out.prior_covariance.template bottomRightCorner<kDof, kDof>() = base_covariance_;
  out.value.resize(shared);
  out.walked.resize(static_cast<Index>(of_errors.size()) - shared);
  for (std::size_t i = 0; i < of_errors.size(); ++i) {
    const double value = state.systematic(of_errors[i] - kDof);
    const auto at = static_cast<Index>(i);
    (at < shared ? out.value(at) : out.walked(at - shared)) = value;
  }
  return out;
}

template <class Pose>
FixedBase<Pose> SubmapKeeper<Pose>::fixed_base() const {
  return FixedBase<Pose>(base_, take_errors({}));
}

// Whether the error of the base is a state, and a fix of the vehicle is linear in it: where the base was as far from its
// estimate as the map had it when the submap began, the second order moves the residual by less than a small part of the
// fix's noise. It grows with the way from the base. It is the same for all fixes of a submap, so the part has to be
// small against 1 / sqrt(their number).
template <class Pose>
bool SubmapKeeper<Pose>::takes(const AbsoluteFix<Pose>& fix) const {
  if (map_ == nullptr || !local_.knows_base()) return false;
  constexpr double kMost = 0.005;  // standard deviations
  const Eigen::Index rows = fix.rows();
  const Pose local = local_.state().pose(), T = base_ * local;
  const ProductJacobians J(base_, local);
  const Eigen::MatrixXd by_base = fix.jacobian(T).topRows(rows) * J.by_a;
  const Eigen::LLT<Eigen::MatrixXd> noise(fix.covariance().topLeftCorner(rows, rows));
  const Eigen::LLT<Square> known(base_covariance_);
  if (known.info() != Eigen::Success || noise.info() != Eigen::Success) return false;
  const Square spread = known.matrixL();
  for (int d = 0; d < kDof; ++d)
    for (const double sign : {-1.0, 1.0}) {
      const typename Pose::Tangent error = sign * spread.col(d);
      const Pose moved = retract(base_, error) * local;
      if (!fix.defined(moved)) return false;
      const Eigen::VectorXd change = (fix.residual(moved) - fix.residual(T)).head(rows);
      if (!(noise.matrixL().solve(change + by_base * error).norm() <= kMost)) return false;
    }
  return true;
}

template <class Pose>
bool SubmapKeeper<Pose>::fill_fix(EkfUpdate<Pose>& update, const AbsoluteFix<Pose>& fix, double* residual_only) const {
  return cairn::fill_fix(update, fix, base_, local_.systematic().states(), residual_only);
}

template <class Pose>
Pose SubmapKeeper<Pose>::base() const {
  typename Pose::Tangent error;
  for (Index d = 0; d < kDof; ++d) error(d) = local_.state().systematic(local_.systematic().states() + d);
  return retract(base_, error);
}

// The map's joint estimate of base and systematic errors s, corrected by what the open submap found out about both;
// then the body in the submap given them (docs/systematic_errors.md, eq. 14).
template <class Pose>
typename SubmapKeeper<Pose>::Place SubmapKeeper<Pose>::place_with_errors(const std::size_t* indices,
                                                                         std::size_t count) const {
  const Index g = local_.systematic().count(), moving = kDof + g, landmarks = kDim * static_cast<Index>(count);
  const SubmapErrors errors = take_errors({});
  const ErrorModel<Pose>& model = local_.state().model();
  const ErrorRows found = found_out(errors);
  Eigen::MatrixXd joint = map_->joint_with_errors(indices, count);
  Eigen::VectorXd s = map_->errors(), correction = Eigen::VectorXd::Zero(moving);
  // Of shared errors, in the order of `errors`, by the errors of [base; s].
  Eigen::MatrixXd shared = Eigen::MatrixXd::Zero(errors.count(), moving);
  shared.topRightCorner(g, g).setIdentity();
  const auto values = [&](const Pose& base) {
    Eigen::VectorXd all(errors.count());
    all.head(g) = s;
    if (fixed()) all.template tail<kDof>() = pose_error(base, base_);
    return all;
  };
  if (fixed()) shared.template bottomLeftCorner<kDof, kDof>() = pose_error_jacobian(map_->base(), base_);
  if (found.rows.rows() > 0) {
    const Eigen::MatrixXd rows = found.rows * shared, cross = joint.leftCols(moving) * rows.transpose();
    const Eigen::MatrixXd S =
        rows * cross.topRows(moving) + Eigen::MatrixXd::Identity(found.rows.rows(), found.rows.rows());
    const Eigen::MatrixXd gain = S.ldlt().solve(cross.transpose()).transpose();
    correction = gain.topRows(moving) * (found.values - found.rows * values(map_->base()));
    joint -= gain * cross.transpose();
  }
  const Pose base = retract(map_->base(), typename Pose::Tangent(correction.head<kDof>()));
  s += correction.tail(g);

  Square own;
  local_.state().gather(nullptr, 0, own.data(), kDof);
  GivenErrors given = given_errors(own, errors);
  Pose local = local_.state().pose();
  model.retract(given.K.topRows<kDof>() * (values(base) - errors.value), local);
  Square to_ordinary = Square::Identity();
  if (model.invariant()) to_ordinary.template topRightCorner<kDim, kTurn>() = model.arm(local.translation());
  const ProductJacobians J(base, local);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(kDof + landmarks, moving + landmarks);
  A.topLeftCorner(kDof, kDof) = J.by_a;
  A.topLeftCorner(kDof, moving) += J.by_b * to_ordinary * given.K.topRows<kDof>() * shared;
  A.bottomRightCorner(landmarks, landmarks).setIdentity();
  const Square noise = J.by_b * to_ordinary * given.covariance.topLeftCorner<kDof, kDof>() * to_ordinary.transpose() *
                       J.by_b.transpose();
  Place out{base * local, A * joint * A.transpose()};
  out.joint.template topLeftCorner<kDof, kDof>() += noise;
  out.joint = (0.5 * (out.joint + out.joint.transpose())).eval();
  return out;
}

template <class Pose>
void SubmapKeeper<Pose>::systematic(double* values, double* covariance) const {
  const SystematicErrors& errors = local_.systematic();
  const State<Pose>& state = local_.state();
  const Index n = errors.count(), states = state.systematic();
  std::vector<double> joint(static_cast<std::size_t>(states * states));
  state.systematic_covariance(joint.data());
  for (Index i = 0; i < n; ++i) {
    values[i] = errors.value(state, i);
    for (Index j = 0; j < n; ++j) covariance[i * n + j] = errors.sum(joint.data(), states, i, j);
  }
}

template void SubmapKeeper<SE2>::open();
template SubmapErrors SubmapKeeper<SE2>::take_errors(const std::vector<Index>&) const;
template FixedBase<SE2> SubmapKeeper<SE2>::fixed_base() const;
template bool SubmapKeeper<SE2>::takes(const AbsoluteFix<SE2>&) const;
template bool SubmapKeeper<SE2>::fill_fix(EkfUpdate<SE2>&, const AbsoluteFix<SE2>&, double*) const;
template SE2 SubmapKeeper<SE2>::base() const;
template SubmapKeeper<SE2>::Place SubmapKeeper<SE2>::place_with_errors(const std::size_t*, std::size_t) const;
template void SubmapKeeper<SE2>::systematic(double*, double*) const;
template void SubmapKeeper<SE3>::open();
template SubmapErrors SubmapKeeper<SE3>::take_errors(const std::vector<Index>&) const;
template FixedBase<SE3> SubmapKeeper<SE3>::fixed_base() const;
template bool SubmapKeeper<SE3>::takes(const AbsoluteFix<SE3>&) const;
template bool SubmapKeeper<SE3>::fill_fix(EkfUpdate<SE3>&, const AbsoluteFix<SE3>&, double*) const;
template SE3 SubmapKeeper<SE3>::base() const;
template SubmapKeeper<SE3>::Place SubmapKeeper<SE3>::place_with_errors(const std::size_t*, std::size_t) const;
template void SubmapKeeper<SE3>::systematic(double*, double*) const;

}  // namespace cairn
