// SPDX-License-Identifier: BSD-3-Clause
#include "slam/systematic_errors.hpp"

#include <algorithm>

namespace cairn {

SystematicErrors::SystematicErrors(const SystematicOptions& options, bool submaps) {
  for (int number = 0; number < MotionErrors::kCount; ++number) {
    const double sigma = options.motion_sigma[number], walk = options.motion_walk[number];
    if (sigma > 0.0) errors_.push_back({number, sigma, walk, states_++, kNone});
  }
  if (submaps)
    for (Error& error : errors_)
      if (error.walk > 0.0) error.walked = states_++;
  motion_states_ = states_;
}

bool SystematicErrors::any_twist() const {
  return std::any_of(errors_.begin(), errors_.end(), [](const Error& e) { return e.number < MotionErrors::kScale; });
}

std::vector<double> SystematicErrors::initial_covariance() const {
  std::vector<double> covariance(errors_.size() * errors_.size(), 0.0);
  for (std::size_t i = 0; i < errors_.size(); ++i)
    covariance[i * (errors_.size() + 1)] = errors_[i].sigma * errors_[i].sigma;
  return covariance;
}

double SystematicErrors::sum(const double* covariance, Index ld, Index i, Index j) const {
  double sum = 0.0;
  const Numbers a = numbers(i), b = numbers(j);
  for (const Index row : {a.start, a.walked})
    for (const Index column : {b.start, b.walked})
      if (row != kNone && column != kNone) sum += covariance[column * ld + row];
  return sum;
}

template <class Pose>
void SystematicErrors::start(State<Pose>& state, const Pose& pose, const typename Pose::Square& covariance,
                             const std::vector<double>& values, const std::vector<double>& errors) const {
  const auto n = static_cast<std::size_t>(states_);
  std::vector<double> numbers(n, 0.0), walk(n, 0.0), joint(n * n, 0.0);
  for (std::size_t i = 0; i < errors_.size(); ++i) {
    const auto at = static_cast<std::size_t>(errors_[i].start);
    numbers[at] = values[i];
    walk[static_cast<std::size_t>(errors_[i].walked == kNone ? errors_[i].start : errors_[i].walked)] =
        errors_[i].walk * errors_[i].walk;
    for (std::size_t j = 0; j < errors_.size(); ++j)
      joint[at * n + static_cast<std::size_t>(errors_[j].start)] = errors[i * errors_.size() + j];
  }
  state.start(pose, covariance, {states_, motion_states_, numbers.data(), walk.data(), joint.data()});
}

template <class Pose>
double SystematicErrors::value(const State<Pose>& state, Index error) const {
  const Error& e = errors_[static_cast<std::size_t>(error)];
  return state.systematic(e.start) + (e.walked == kNone ? 0.0 : state.systematic(e.walked));
}

template <class Pose>
MotionErrors SystematicErrors::motion(const State<Pose>& state) const {
  MotionErrors motion;
  for (Index i = 0; i < count(); ++i) motion[number(i)] = value(state, i);
  return motion;
}

template <class Pose>
MotionCoupling<Pose> SystematicErrors::coupling(const CorrectedStep<Pose>& step, double dt) const {
  MotionCoupling<Pose> coupling;
  coupling.dt = dt;
  for (const Error& error : errors_) {
    coupling.J.col(error.start) = step.J_error.col(error.number);
    if (error.walked != kNone) coupling.J.col(error.walked) = step.J_error.col(error.number);
  }
  return coupling;
}

template void SystematicErrors::start(State<SE2>&, const SE2&, const SE2::Square&, const std::vector<double>&,
                                      const std::vector<double>&) const;
template void SystematicErrors::start(State<SE3>&, const SE3&, const SE3::Square&, const std::vector<double>&,
                                      const std::vector<double>&) const;
template double SystematicErrors::value(const State<SE2>&, Index) const;
template double SystematicErrors::value(const State<SE3>&, Index) const;
template MotionErrors SystematicErrors::motion(const State<SE2>&) const;
template MotionErrors SystematicErrors::motion(const State<SE3>&) const;
template MotionCoupling<SE2> SystematicErrors::coupling(const CorrectedStep<SE2>&, double) const;
template MotionCoupling<SE3> SystematicErrors::coupling(const CorrectedStep<SE3>&, double) const;

}  // namespace cairn
