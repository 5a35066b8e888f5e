// SPDX-License-Identifier: BSD-3-Clause
// The systematic errors that a filter estimates: which number of the state each one is (docs/systematic_errors.md).
//
// A filter with submaps keeps an error that walks as two numbers of the open submap: its value when the submap began,
// and what it has walked since then. The map knows the first one and gets their sum.
//
// Those of the motion come first. Those of sensors are added after the filter was created, before it does anything.
#pragma once

#include <vector>

#include "ekf/state.hpp"
#include "sensor/calibrated_sensor.hpp"
#include "slam/filter_options.hpp"

namespace cairn {

class SystematicErrors {
 public:
  SystematicErrors(const SystematicOptions& options, bool submaps);

  Index count() const { return static_cast<Index>(errors_.size()); }
  bool any() const { return !errors_.empty(); }
  bool any_twist() const;  // a bias of the twist, which a motion without a duration cannot be corrected by
  // One number of a sensor's calibration (CalibratedSensor). The caller checks the capacity.
  void add(int sensor, int number, double sigma, double walk);
  bool calibrates(int sensor) const;
  Index states() const { return states_; }  // of the open submap or the single map
  Index motion_states() const { return motion_states_; }
  // The sensor of an error, or kMotion; and its number in the sensor's calibration or in MotionErrors.
  static constexpr int kMotion = -1;
  int sensor(Index error) const { return errors_[static_cast<std::size_t>(error)].sensor; }
  int number(Index error) const { return errors_[static_cast<std::size_t>(error)].number; }
  double sigma(Index error) const { return errors_[static_cast<std::size_t>(error)].sigma; }

  // Values and covariance (count() x count()) of the errors at the start of a filter.
  std::vector<double> initial_values() const { return std::vector<double>(errors_.size(), 0.0); }
  std::vector<double> initial_covariance() const;

  // Starts a state with these values and this covariance (count() x count()) of the errors. With `base`, the error of
  // the submap's base [dp; dtheta] is a state, too, behind the others: it is zero, independent of them, and has this
  // covariance. Allocates nothing.
  template <class Pose>
  void start(State<Pose>& state, const Pose& pose, const typename Pose::Square& covariance, const double* values,
             const double* errors, const typename Pose::Square* base = nullptr);
  // The estimate of one error, and of all errors of the motion.
  template <class Pose>
  double value(const State<Pose>& state, Index error) const;
  template <class Pose>
  MotionErrors motion(const State<Pose>& state) const;
  // The calibration of a sensor; `value(i)` is the state's number i.
  template <class Pose, class Value>
  Calibration<Pose> calibration(int sensor, Value&& value) const {
    Calibration<Pose> numbers = Calibration<Pose>::Zero();
    for (const Error& error : errors_)
      if (error.sensor == sensor)
        numbers[error.number] = value(error.start) + (error.walked == kNone ? 0.0 : value(error.walked));
    return numbers;
  }
  // The columns of a Jacobian by a sensor's calibration, as columns by the state's numbers, which follow each other.
  template <class J>
  ErrorColumns<J::RowsAtCompileTime> columns(int sensor, const J& by_calibration) const {
    ErrorColumns<J::RowsAtCompileTime> out;
    for (const Error& error : errors_) {
      if (error.sensor != sensor) continue;
      if (out.count == 0) out.first = error.start;
      out.J.col(out.count++) = by_calibration.col(error.number);
      if (error.walked != kNone) out.J.col(out.count++) = by_calibration.col(error.number);
    }
    return out;
  }
  // Derivative of the step by the state's errors.
  template <class Pose>
  MotionCoupling<Pose> coupling(const CorrectedStep<Pose>& step, double dt) const;
  // The state's numbers whose sum is an error: its value at the start, and what it has walked.
  struct Numbers {
    Index start;
    Index walked;  // kNone: none
  };
  static constexpr Index kNone = -1;
  // The covariance of errors i and j from that of the state's numbers.
  double sum(const double* covariance, Index ld, Index i, Index j) const;
  Numbers numbers(Index error) const {
    const Error& e = errors_[static_cast<std::size_t>(error)];
    return {e.start, e.walked};
  }

 private:
  struct Error {
    int sensor;  // kMotion: of the motion
    int number;  // in the sensor's calibration or in MotionErrors
    double sigma, walk;
    Index start, walked;
  };
  void make_room();

  std::vector<Error> errors_;
  static constexpr Index kBase = 6;              // states of a base at most
  std::vector<double> numbers_, walks_, joint_;  // scratch of start()
  bool submaps_;
  Index states_ = 0, motion_states_ = 0;
};

}  // namespace cairn
