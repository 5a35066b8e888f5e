// SPDX-License-Identifier: BSD-3-Clause
#include "slam/systematic_errors.hpp"

#include <algorithm>

namespace cairn {

SystematicErrors::SystematicErrors(const SystematicOptions& options, bool submaps) : submaps_(submaps) {
  for (int number = 0; number < MotionErrors::kCount; ++number) {
    const double sigma = options.motion_sigma[number], walk = options.motion_walk[number];
    if (sigma > 0.0) errors_.push_back({kMotion, number, sigma, walk, states_++, kNone});
  }
  if (submaps)
    for (Error& error : errors_)
      if (error.walk > 0.0) error.walked = states_++;
  motion_states_ = states_;
  make_room();
}

void SystematicErrors::make_room() {
  const auto n = static_cast<std::size_t>(states_ + kBase);
  numbers_.resize(n);
  walks_.resize(n);
  joint_.resize(n * n);
}

bool SystematicErrors::any_twist() const {
  return std::any_of(errors_.begin(), errors_.end(),
                     [](const Error& e) { return e.sensor == kMotion && e.number < MotionErrors::kScale; });
}

void SystematicErrors::add(int sensor, int number, double sigma, double walk) {
  errors_.reserve(errors_.size() + 1);
  Error error{sensor, number, sigma, walk, states_, kNone};
  if (submaps_ && walk > 0.0) error.walked = states_ + 1;
  states_ += error.walked == kNone ? 1 : 2;
  errors_.push_back(error);
  make_room();
}

bool SystematicErrors::calibrates(int sensor) const {
  return std::any_of(errors_.begin(), errors_.end(), [&](const Error& e) { return e.sensor == sensor; });
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
                             const double* values, const double* errors, const typename Pose::Square* base) {
  static_assert(Pose::kDof <= kBase);
  const Index states = states_ + (base != nullptr ? Pose::kDof : 0);
  const auto n = static_cast<std::size_t>(states);
  std::fill(numbers_.begin(), numbers_.end(), 0.0);
  std::fill(walks_.begin(), walks_.end(), 0.0);
  std::fill(joint_.begin(), joint_.end(), 0.0);
  for (std::size_t i = 0; i < errors_.size(); ++i) {
    const auto at = static_cast<std::size_t>(errors_[i].start);
    numbers_[at] = values[i];
    walks_[static_cast<std::size_t>(errors_[i].walked == kNone ? errors_[i].start : errors_[i].walked)] =
        errors_[i].walk * errors_[i].walk;
    for (std::size_t j = 0; j < errors_.size(); ++j)
      joint_[at * n + static_cast<std::size_t>(errors_[j].start)] = errors[i * errors_.size() + j];
  }
  if (base != nullptr)
    Eigen::Map<Eigen::MatrixXd>(joint_.data(), states, states).template bottomRightCorner<Pose::kDof, Pose::kDof>() =
        *base;
  state.start(pose, covariance, {states, motion_states_, numbers_.data(), walks_.data(), joint_.data()});
}

template <class Pose>
double SystematicErrors::value(const State<Pose>& state, Index error) const {
  const Error& e = errors_[static_cast<std::size_t>(error)];
  return state.systematic(e.start) + (e.walked == kNone ? 0.0 : state.systematic(e.walked));
}

template <class Pose>
MotionErrors SystematicErrors::motion(const State<Pose>& state) const {
  MotionErrors motion;
  for (Index i = 0; i < count(); ++i)
    if (sensor(i) == kMotion) motion[number(i)] = value(state, i);
  return motion;
}

template <class Pose>
MotionCoupling<Pose> SystematicErrors::coupling(const CorrectedStep<Pose>& step, double dt) const {
  MotionCoupling<Pose> coupling;
  coupling.dt = dt;
  for (const Error& error : errors_) {
    if (error.sensor != kMotion) continue;
    coupling.J.col(error.start) = step.J_error.col(error.number);
    if (error.walked != kNone) coupling.J.col(error.walked) = step.J_error.col(error.number);
  }
  return coupling;
}

template void SystematicErrors::start(State<SE2>&, const SE2&, const SE2::Square&, const double*, const double*,
                                      const SE2::Square*);
template void SystematicErrors::start(State<SE3>&, const SE3&, const SE3::Square&, const double*, const double*,
                                      const SE3::Square*);
template double SystematicErrors::value(const State<SE2>&, Index) const;
template double SystematicErrors::value(const State<SE3>&, Index) const;
template MotionErrors SystematicErrors::motion(const State<SE2>&) const;
template MotionErrors SystematicErrors::motion(const State<SE3>&) const;
template MotionCoupling<SE2> SystematicErrors::coupling(const CorrectedStep<SE2>&, double) const;
template MotionCoupling<SE3> SystematicErrors::coupling(const CorrectedStep<SE3>&, double) const;

}  // namespace cairn
