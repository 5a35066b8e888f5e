// SPDX-License-Identifier: BSD-3-Clause
// Systematic errors that the open submap shares with the map.
#include <Eigen/Cholesky>
#include <new>

#include "slam/submap_keeper.hpp"

namespace cairn {

// The prior of the systematic errors is what the map knows of them. The closing takes exactly this prior out again
// (docs/systematic_errors.md, eq. 12), so that it may be as narrow as it is.
template <class Pose>
void SubmapKeeper<Pose>::open() {
  if (!shares_errors()) return local_.start(Pose(), Square::Zero());  // deferred landmarks have to be found again
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
  local_.start(Pose(), Square::Zero(), prior_.data(), prior_covariance_.data());
}

template <class Pose>
SubmapErrors SubmapKeeper<Pose>::take_errors(const std::vector<Index>& slots) const {
  const SystematicErrors& errors = local_.systematic();
  const State<Pose>& state = local_.state();
  const auto count = static_cast<Index>(slots.size());
  const Index states = state.systematic(), g = errors.count(), n = kDof + states + kDim * count;
  Eigen::MatrixXd joint(n, n);
  state.gather_systematic(slots.data(), count, joint.data(), n);
  std::vector<Index> of_errors, of_rest;
  for (Index i = 0; i < g; ++i) of_errors.push_back(kDof + errors.numbers(i).start);
  for (Index i = 0; i < g; ++i)
    if (errors.numbers(i).walked != SystematicErrors::kNone) of_errors.push_back(kDof + errors.numbers(i).walked);
  for (Index i = 0; i < n; ++i)
    if (i < kDof || i >= kDof + states) of_rest.push_back(i);
  SubmapErrors out{prior_, prior_covariance_, {}, {}, joint(of_rest, of_errors), joint(of_errors, of_errors)};
  out.value.resize(g);
  out.walked.resize(static_cast<Index>(of_errors.size()) - g);
  for (std::size_t i = 0; i < of_errors.size(); ++i) {
    const double value = state.systematic(of_errors[i] - kDof);
    const auto at = static_cast<Index>(i);
    (at < g ? out.value(at) : out.walked(at - g)) = value;
  }
  return out;
}

// The map's joint estimate of base and systematic errors s, corrected by what the open submap found out about s; then
// the body in the submap given s (docs/systematic_errors.md, eq. 14).
template <class Pose>
typename SubmapKeeper<Pose>::Place SubmapKeeper<Pose>::place_with_errors(const std::size_t* indices,
                                                                            std::size_t count) const {
  const Index g = local_.systematic().count(), moving = kDof + g, landmarks = kDim * static_cast<Index>(count);
  const SubmapErrors errors = take_errors({});
  const ErrorModel<Pose>& model = local_.state().model();
  const ErrorRows found = found_out(errors);
  Eigen::MatrixXd joint = map_->joint_with_errors(indices, count);
  Eigen::VectorXd s = map_->errors(), correction = Eigen::VectorXd::Zero(moving);
  if (found.rows.rows() > 0) {
    const Eigen::MatrixXd cross = joint.middleCols(kDof, g) * found.rows.transpose();
    const Eigen::MatrixXd S =
        found.rows * cross.middleRows(kDof, g) + Eigen::MatrixXd::Identity(found.rows.rows(), found.rows.rows());
    const Eigen::MatrixXd gain = S.ldlt().solve(cross.transpose()).transpose();
    correction = gain.topRows(moving) * (found.values - found.rows * s);
    joint -= gain * cross.transpose();
  }
  const Pose base = retract(map_->base(), typename Pose::Tangent(correction.head<kDof>()));
  s += correction.tail(g);

  Square own;
  local_.state().gather(nullptr, 0, own.data(), kDof);
  GivenErrors given = given_errors(own, errors);
  Pose local = local_.state().pose();
  model.retract(given.K.topRows<kDof>() * (s - errors.value), local);
  Square to_ordinary = Square::Identity();
  if (model.invariant()) to_ordinary.template topRightCorner<kDim, kTurn>() = model.arm(local.translation());
  const ProductJacobians J(base, local);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(kDof + landmarks, moving + landmarks);
  A.topLeftCorner(kDof, kDof) = J.by_a;
  A.block(0, kDof, kDof, g) = J.by_b * to_ordinary * given.K.topRows<kDof>();
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
template SubmapKeeper<SE2>::Place SubmapKeeper<SE2>::place_with_errors(const std::size_t*, std::size_t) const;
template void SubmapKeeper<SE2>::systematic(double*, double*) const;
template void SubmapKeeper<SE3>::open();
template SubmapErrors SubmapKeeper<SE3>::take_errors(const std::vector<Index>&) const;
template SubmapKeeper<SE3>::Place SubmapKeeper<SE3>::place_with_errors(const std::size_t*, std::size_t) const;
template void SubmapKeeper<SE3>::systematic(double*, double*) const;

}  // namespace cairn
