// SPDX-License-Identifier: BSD-3-Clause
// Life, sensors and queries of a filter. Motion: motion.cpp; observations: filter_update.cpp.
#include "capi/convert.hpp"
#include "capi/filter_handle.hpp"

using namespace cairn;
using namespace cairn::capi;

namespace cairn {
namespace capi {
namespace {

// A pose whose position is not absurd.
SE3 read_place(const cairn_pose* pose, const char* name) {
  const SE3 T = read_pose(pose, name);
  char part[96];
  std::snprintf(part, sizeof part, "%s.position", name);
  check_position(pose->position, 3, part);
  return T;
}

// A sensor that a vehicle of this kind can carry, or a refusal.
template <class AnyFilter, class AnySensor>
void add_sensor(AnyFilter& filter, const AnySensor& sensor, std::int32_t* number) {
  check_pointer(number, "sensor");
  if constexpr (std::is_constructible_v<typename SensorKinds<PoseOf<AnyFilter>>::Any, AnySensor>)
    *number = filter.add(sensor);
  else if constexpr (PoseOf<AnyFilter>::kDim == 2)
    throw Error(ErrorCode::argument, "filter: its vehicle is planar, and this sensor is spatial");
  else
    throw Error(ErrorCode::argument,
                "filter: it is of a vehicle in space, and this sensor sees in the plane; create the filter with "
                "options.vehicle = CAIRN_VEHICLE_PLANAR");
}

}  // namespace

template <>
SE3 read_pose_of<SE3>(const cairn_pose* pose, const char* name) {
  return read_place(pose, name);
}
template <>
SE2 read_pose_of<SE2>(const cairn_pose* pose, const char* name) {
  constexpr double kLevel = 1e-9;  // m, rad: allows for rounding in the caller's conversions
  const SE3 T = read_place(pose, name);
  if (std::abs(T.translation().z()) > kLevel || T.rotation().quaternion().vec().head<2>().norm() > 0.5 * kLevel)
    throw Error(ErrorCode::argument, "%s lies outside of the plane: z must be 0, and the rotation must be about z only",
                name);
  return Embedding<SE2>::down(T);
}

}  // namespace capi
}  // namespace cairn

extern "C" {

cairn_status cairn_filter_required_bytes(const cairn_filter_options* options, size_t* bytes, cairn_error* error) {
  return guard(error, [&] {
    const auto checked = read_filter_options(options);
    check_pointer(bytes, "bytes");
    std::visit(
        [&](const auto& o) {
          *bytes = sizeof(cairn_filter) + Filter<PoseOf<decltype(o)>>::required_bytes(o) +
                   cairn_filter::buffer_bytes(o.max_observations) + Arena::kAlignment;
        },
        checked);
  });
}

cairn_status cairn_filter_create(const cairn_filter_options* options, cairn_filter** filter, cairn_error* error) {
  return guard(error, [&] {
    const auto checked = read_filter_options(options);
    check_pointer(filter, "filter");
    std::visit([&](const auto& o) { *filter = new cairn_filter(o); }, checked);
  });
}

void cairn_filter_destroy(cairn_filter* filter) {
  delete filter;
}

cairn_status cairn_filter_set_log(cairn_filter* filter, cairn_log_fn log, void* payload, cairn_release_fn release,
                                  cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) { f.set_log(log, payload); });
    filter->log = Payload(payload, release);
  });
}

cairn_status cairn_filter_add_stereo_head(cairn_filter* filter, const cairn_stereo_head* head, int32_t* sensor,
                                          cairn_error* error) {
  return guard(error, [&] { with_filter(filter, [&](auto& f) { add_sensor(f, read_stereo_head(head), sensor); }); });
}

cairn_status cairn_filter_add_stereo_camera(cairn_filter* filter, const cairn_stereo_camera* camera, int32_t* sensor,
                                            cairn_error* error) {
  return guard(error,
               [&] { with_filter(filter, [&](auto& f) { add_sensor(f, read_stereo_camera(camera), sensor); }); });
}

cairn_status cairn_filter_add_range_bearing(cairn_filter* filter, const cairn_range_bearing* radar, int32_t* sensor,
                                            cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) { add_sensor(f, RangeBearing(read_range_bearing(radar)), sensor); });
  });
}

cairn_status cairn_filter_add_cartesian(cairn_filter* filter, const cairn_cartesian* cartesian, int32_t* sensor,
                                        cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) { add_sensor(f, read_cartesian<PoseOf<decltype(f)>>(cartesian), sensor); });
  });
}

cairn_status cairn_filter_add_custom(cairn_filter* filter, const cairn_custom* custom, cairn_custom_predict_fn predict,
                                     cairn_custom_place_fn place, void* user, cairn_release_fn release, int32_t* sensor,
                                     cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      const auto model = read_custom<PoseOf<decltype(f)>>(custom, predict, place, user);
      filter->custom.reserve(filter->custom.size() + 1);  // nothing fails after the sensor was added
      add_sensor(f, model, sensor);
    });
    filter->custom.emplace_back(user, release);
  });
}

cairn_status cairn_filter_point_head(cairn_filter* filter, int32_t sensor, double pan, double stick,
                                     cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      check_finite(pan, "pan");
      check_finite(stick, "stick");
      f.point_head(sensor, pan, stick);
    });
  });
}

cairn_status cairn_filter_set_loss(cairn_filter* filter, int32_t sensor, int32_t loss, double width,
                                   cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      if (loss == CAIRN_LOSS_NONE) return f.set_loss(sensor, RobustLoss());
      if (loss != CAIRN_LOSS_HUBER && loss != CAIRN_LOSS_CAUCHY)
        throw Error(ErrorCode::argument, "loss is %d, and no CAIRN_LOSS_ constant", static_cast<int>(loss));
      if (!(width > 0.0 && width <= 1e6))
        throw Error(ErrorCode::argument, "width is %g, and must be above 0, at most 1e6", width);
      f.set_loss(sensor, RobustLoss(loss == CAIRN_LOSS_HUBER ? LossKind::huber : LossKind::cauchy, width));
    });
  });
}

cairn_status cairn_filter_set_view(cairn_filter* filter, int32_t sensor, const double lower[3], const double upper[3],
                                   cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      const int rows = f.sensor_rows(sensor);
      check_pointer(lower, "lower");
      check_pointer(upper, "upper");
      for (int i = 0; i < rows; ++i)
        if (!(lower[i] < upper[i]))
          throw Error(ErrorCode::argument, "lower[%d] is %g, and must be below upper[%d], %g", i, lower[i], i,
                      upper[i]);
      f.set_view(sensor, Vector3(lower), Vector3(upper));
    });
  });
}

cairn_status cairn_filter_remove_landmark(cairn_filter* filter, uint64_t id, cairn_error* error) {
  return guard(error, [&] { with_filter(filter, [&](auto& f) { f.remove_landmark(id); }); });
}

cairn_status cairn_filter_split_landmark(cairn_filter* filter, uint64_t id, uint64_t fresh, const double covariance[9],
                                         cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      if (fresh == CAIRN_ID_NONE) throw Error(ErrorCode::argument, "fresh is CAIRN_ID_NONE, which no landmark has");
      const auto apart = read_point_covariance<PoseOf<decltype(f)>>(covariance, "covariance");
      check_range(apart.diagonal().maxCoeff(), 0.0, kLargestPositionSigma * kLargestPositionSigma, "covariance");
      f.split_landmark(id, fresh, apart);
    });
  });
}

cairn_status cairn_filter_pose(const cairn_filter* filter, cairn_pose* pose, double covariance[36],
                               cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](const auto& f) {
      const auto vehicle = f.vehicle();
      write_estimate(vehicle.pose, vehicle.covariance, pose, covariance);
    });
  });
}

cairn_status cairn_filter_joint_covariance(const cairn_filter* filter, const uint64_t* ids, size_t count,
                                           double* matrix, size_t capacity, size_t* needed, cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](const auto& f) {
      const std::vector<std::size_t> indices = read_ids(f.landmarks(), ids, count);
      const std::size_t size = 6 + 3 * count;
      if (check_room(matrix, capacity, size * size, needed, "matrix"))
        f.pose_joint_covariance(indices.data(), count, matrix);
    });
  });
}

const cairn_map* cairn_filter_map(const cairn_filter* filter) {
  return filter != nullptr ? &filter->map : nullptr;
}

cairn_status cairn_filter_pose_nees(const cairn_filter* filter, const cairn_pose* truth, double* nees,
                                    cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](const auto& f) {
      const auto pose = read_pose_of<PoseOf<decltype(f)>>(truth, "truth");
      check_pointer(nees, "nees");
      const double value = f.pose_nees(pose);
      if (!(value >= 0.0))
        throw Error(ErrorCode::numerical, "pose covariance is singular: part of the pose is known exactly");
      *nees = value;
    });
  });
}

cairn_status cairn_filter_audit(cairn_filter* filter, double* min_pivot, cairn_error* error) {
  return guard(error, [&] {
    with_filter(filter, [&](auto& f) {
      check_pointer(min_pivot, "min_pivot");
      *min_pivot = f.smallest_pivot();
    });
  });
}

}  // extern "C"
