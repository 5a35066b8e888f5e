// SPDX-License-Identifier: BSD-3-Clause
// The sensors of a filter, numbered from 0 in the order in which they were added, and their views.
#pragma once

#include <variant>

#include "core/arena.hpp"
#include "linear/robust_loss.hpp"
#include "linear/small_algebra.hpp"
#include "sensor/cartesian.hpp"
#include "sensor/custom.hpp"
#include "sensor/range_bearing.hpp"
#include "sensor/stereo_camera.hpp"
#include "sensor/stereo_head.hpp"

namespace cairn {

// Sensors that a vehicle can carry.
template <class Pose>
struct SensorKinds;
template <>
struct SensorKinds<SE3> {
  using Any = std::variant<StereoHead, StereoCamera, Cartesian<SE3>, CustomSensor<SE3>>;
};
template <>
struct SensorKinds<SE2> {
  using Any = std::variant<RangeBearing, Cartesian<SE2>, CustomSensor<SE2>, ExtendedObservation>;
};

// The region in which a sensor detects every landmark, as bounds on the predicted observation.
struct View {
  Vector3 lower, upper;
};

template <class Pose>
class SensorRack {
 public:
  using Any = typename SensorKinds<Pose>::Any;

  SensorRack(Arena& arena, Index max_sensors);
  ~SensorRack();
  SensorRack(const SensorRack&) = delete;
  SensorRack& operator=(const SensorRack&) = delete;

  int add(const Any& sensor);  // its number
  const Sensor<Pose>& at(int number);
  void check(int number) const;        // throws if there is no sensor of this number
  const View* view(int number) const;  // null: none was set
  void set_view(int number, const View& view);
  const RobustLoss& loss(int number) const { return places_[number].loss; }
  void set_loss(int number, const RobustLoss& loss);
  void point_head(int number, double pan, double stick);
  void set_sighting(int number, const MutualSighting& sighting);  // of an extended observation

 private:
  struct Place {
    alignas(Any) unsigned char sensor[sizeof(Any)];
    bool has_view;
    View view;
    RobustLoss loss;
  };
  Any& any(int number);

  Index max_sensors_;
  Place* places_;
  int count_ = 0;
};

extern template class SensorRack<SE2>;
extern template class SensorRack<SE3>;

}  // namespace cairn
