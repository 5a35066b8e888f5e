// SPDX-License-Identifier: BSD-3-Clause
// The C structs of cairn/sensor.h: defaults and checks of all sensors, and cairn_custom_check.
#include <cstddef>

#include "capi/convert.hpp"
#include "capi/guard.hpp"
#include "geometry/embedding.hpp"

namespace cairn {
namespace capi {
namespace {

cairn_stereo_head default_stereo_head() {
  const StereoHeadParameters d;
  cairn_stereo_head head = {};
  head.struct_size = sizeof head;
  head.encoder_mode = CAIRN_ENCODER_PER_OBSERVATION;
  std::copy_n(d.platform.data(), 3, head.platform);
  std::copy_n(d.stick.data(), 3, head.stick);
  write_quaternion(d.R_stick_camera, head.camera_quaternion);
  head.range_sigma = d.range_sigma;
  head.azimuth_sigma = d.azimuth_sigma;
  head.elevation_sigma = d.elevation_sigma;
  head.pan_sigma = d.pan_sigma;
  head.stick_sigma = d.stick_sigma;
  head.near_range = d.near_range;
  head.max_elevation = d.max_elevation;
  return head;
}

cairn_stereo_camera default_stereo_camera() {
  const StereoCameraParameters d;
  cairn_stereo_camera camera = {};
  camera.struct_size = sizeof camera;
  camera.fu = d.fu;
  camera.fv = d.fv;
  camera.cu = d.cu;
  camera.cv = d.cv;
  camera.baseline = d.baseline;
  write_pose(d.T_body_camera, &camera.T_body_camera);
  std::copy_n(d.sigma.data(), 3, camera.sigma);
  camera.near_depth = d.near_depth;
  camera.min_disparity = d.min_disparity;
  camera.min_disparity_sigmas = d.min_disparity_sigmas;
  return camera;
}

cairn_cartesian default_cartesian() {
  const CartesianParameters<SE3> d;
  cairn_cartesian cartesian = {};
  cartesian.struct_size = sizeof cartesian;
  write_pose(d.T_body_sensor, &cartesian.T_body_sensor);
  std::copy_n(d.sigma.data(), 3, cartesian.sigma);
  return cartesian;
}

cairn_range_bearing default_range_bearing() {
  const RangeBearingParameters d;
  cairn_range_bearing radar = {};
  radar.struct_size = sizeof radar;
  write_pose(Embedding<SE2>::up(d.T_body_sensor), &radar.T_body_sensor);
  radar.range_sigma = d.range_sigma;
  radar.bearing_sigma = d.bearing_sigma;
  radar.near_range = d.near_range;
  return radar;
}

cairn_custom default_custom() {
  const CustomParameters d;
  cairn_custom custom = {};
  custom.struct_size = sizeof custom;
  custom.rows = static_cast<std::uint32_t>(d.rows);
  std::copy_n(d.sigma.data(), 3, custom.sigma);
  return custom;
}

}  // namespace

StereoHead read_stereo_head(const cairn_stereo_head* user) {
  const cairn_stereo_head h = read_options(user, default_stereo_head(), "head");
  if (h.encoder_mode != CAIRN_ENCODER_PER_OBSERVATION && h.encoder_mode != CAIRN_ENCODER_PER_FRAME)
    throw Error(ErrorCode::argument, "head.encoder_mode = %d is none of the CAIRN_ENCODER_ constants; use one of them",
                h.encoder_mode);
  check_position(h.platform, 3, "head.platform");
  check_position(h.stick, 3, "head.stick");
  check_sigma(h.range_sigma, "head.range_sigma");
  check_sigma(h.azimuth_sigma, "head.azimuth_sigma");
  check_sigma(h.elevation_sigma, "head.elevation_sigma");
  check_sigma_or_zero(h.pan_sigma, "head.pan_sigma");
  check_sigma_or_zero(h.stick_sigma, "head.stick_sigma");
  check_positive(h.near_range, "head.near_range");
  check_positive(h.max_elevation, "head.max_elevation");
  check_range(h.max_elevation, 0.0, 1.57079, "head.max_elevation");
  StereoHeadParameters parameters;
  parameters.platform = Vector3(h.platform);
  parameters.stick = Vector3(h.stick);
  parameters.R_stick_camera = read_quaternion(h.camera_quaternion, "head.camera_quaternion");
  parameters.range_sigma = h.range_sigma;
  parameters.azimuth_sigma = h.azimuth_sigma;
  parameters.elevation_sigma = h.elevation_sigma;
  parameters.pan_sigma = h.pan_sigma;
  parameters.stick_sigma = h.stick_sigma;
  parameters.encoder_per_frame = h.encoder_mode == CAIRN_ENCODER_PER_FRAME;
  parameters.near_range = h.near_range;
  parameters.max_elevation = h.max_elevation;
  return StereoHead(parameters);
}

StereoCamera read_stereo_camera(const cairn_stereo_camera* user) {
  const cairn_stereo_camera c = read_options(user, default_stereo_camera(), "camera");
  check_reserved(c.reserved, "camera.reserved");
  check_positive(c.fu, "camera.fu");
  check_positive(c.fv, "camera.fv");
  check_finite(c.cu, "camera.cu");
  check_finite(c.cv, "camera.cv");
  check_positive(c.baseline, "camera.baseline");
  check_sigma(c.sigma, 3, "camera.sigma");
  check_positive(c.near_depth, "camera.near_depth");
  check_positive(c.min_disparity, "camera.min_disparity");
  check_not_negative(c.min_disparity_sigmas, "camera.min_disparity_sigmas");
  StereoCameraParameters parameters;
  parameters.fu = c.fu;
  parameters.fv = c.fv;
  parameters.cu = c.cu;
  parameters.cv = c.cv;
  parameters.baseline = c.baseline;
  parameters.T_body_camera = read_pose_of<SE3>(&c.T_body_camera, "camera.T_body_camera");
  parameters.sigma = Vector3(c.sigma);
  parameters.near_depth = c.near_depth;
  parameters.min_disparity = c.min_disparity;
  parameters.min_disparity_sigmas = c.min_disparity_sigmas;
  return StereoCamera(parameters);
}

RangeBearingParameters read_range_bearing(const cairn_range_bearing* user) {
  const cairn_range_bearing r = read_options(user, default_range_bearing(), "radar");
  check_reserved(r.reserved, "radar.reserved");
  check_sigma(r.range_sigma, "radar.range_sigma");
  check_sigma(r.bearing_sigma, "radar.bearing_sigma");
  check_positive(r.near_range, "radar.near_range");
  return {read_pose_of<SE2>(&r.T_body_sensor, "radar.T_body_sensor"), r.range_sigma, r.bearing_sigma, r.near_range};
}

template <class Pose>
Cartesian<Pose> read_cartesian(const cairn_cartesian* user) {
  const cairn_cartesian c = read_options(user, default_cartesian(), "cartesian");
  check_reserved(c.reserved, "cartesian.reserved");
  check_sigma(c.sigma, Pose::kDim, "cartesian.sigma");
  CartesianParameters<Pose> parameters;
  parameters.T_body_sensor = read_pose_of<Pose>(&c.T_body_sensor, "cartesian.T_body_sensor");
  parameters.sigma = Embedding<Pose>::down(Vector3(c.sigma));
  return Cartesian<Pose>(parameters);
}
template Cartesian<SE2> read_cartesian<SE2>(const cairn_cartesian*);
template Cartesian<SE3> read_cartesian<SE3>(const cairn_cartesian*);

// The core passes a pose to the caller's functions as seven doubles with the memory layout of cairn_pose.
static_assert(sizeof(cairn_pose) == 7 * sizeof(double) && offsetof(cairn_pose, quaternion) == 3 * sizeof(double),
              "position, then quaternion w x y z");

template <class Pose>
CustomSensor<Pose> read_custom(const cairn_custom* description, cairn_custom_predict_fn predict,
                               cairn_custom_place_fn place, void* user) {
  constexpr std::uint32_t kDim = Pose::kDim;
  const cairn_custom c = read_options(description, default_custom(), "custom");
  if (c.rows < 1 || c.rows > kDim)
    throw Error(ErrorCode::argument, "custom.rows must lie in [1, %u], and is %u", kDim, c.rows);
  if (predict == nullptr) throw Error(ErrorCode::argument, "predict is NULL; a sensor must predict");
  if (c.angle_mask >> c.rows != 0)
    throw Error(ErrorCode::argument, "custom.angle_mask = %u has bits beyond custom.rows = %u", c.angle_mask, c.rows);
  if (place != nullptr && c.rows < kDim)
    throw Error(ErrorCode::argument, "place is given, but %u values cannot place a landmark; leave it NULL", c.rows);
  check_sigma(c.sigma, c.rows, "custom.sigma");
  CustomParameters parameters;
  parameters.rows = static_cast<int>(c.rows);
  parameters.predict = reinterpret_cast<CustomPredict>(predict);
  parameters.place = reinterpret_cast<CustomPlace>(place);
  parameters.user = user;
  parameters.angle_mask = c.angle_mask;
  parameters.relative = read_bool(c.relative, "custom.relative");
  for (std::uint32_t i = 0; i < c.rows; ++i) parameters.sigma(i) = c.sigma[i];
  return CustomSensor<Pose>(parameters);
}
template CustomSensor<SE2> read_custom<SE2>(const cairn_custom*, cairn_custom_predict_fn, cairn_custom_place_fn, void*);
template CustomSensor<SE3> read_custom<SE3>(const cairn_custom*, cairn_custom_predict_fn, cairn_custom_place_fn, void*);

}  // namespace capi
}  // namespace cairn

using namespace cairn;
using namespace cairn::capi;

extern "C" {

cairn_status cairn_stereo_head_init(cairn_stereo_head* head, size_t struct_size, cairn_error* error) {
  return guard(error, [&] { init_options(head, struct_size, default_stereo_head(), "head"); });
}

cairn_status cairn_stereo_camera_init(cairn_stereo_camera* camera, size_t struct_size, cairn_error* error) {
  return guard(error, [&] { init_options(camera, struct_size, default_stereo_camera(), "camera"); });
}

cairn_status cairn_range_bearing_init(cairn_range_bearing* radar, size_t struct_size, cairn_error* error) {
  return guard(error, [&] { init_options(radar, struct_size, default_range_bearing(), "radar"); });
}

cairn_status cairn_cartesian_init(cairn_cartesian* cartesian, size_t struct_size, cairn_error* error) {
  return guard(error, [&] { init_options(cartesian, struct_size, default_cartesian(), "cartesian"); });
}

cairn_status cairn_custom_init(cairn_custom* custom, size_t struct_size, cairn_error* error) {
  return guard(error, [&] { init_options(custom, struct_size, default_custom(), "custom"); });
}

cairn_status cairn_custom_check(const cairn_custom* custom, cairn_custom_predict_fn predict,
                                cairn_custom_place_fn place, void* user, const cairn_pose* pose,
                                const double landmark[3], double* worst, cairn_error* error) {
  return guard(error, [&] {
    const CustomSensor<SE3> sensor = read_custom<SE3>(custom, predict, place, user);
    const SE3 T = read_pose(pose, "pose");
    check_pointer(landmark, "landmark");
    check_finite(landmark, 3, "landmark");
    check_pointer(worst, "worst");
    double found = 0.0;
    if (!check_custom(sensor, T, Vector3(landmark), found))
      throw Error(
          ErrorCode::argument,
          "landmark: the sensor refuses this point, or a point next to it, at this pose; choose a point that it sees");
    *worst = found;
  });
}

}  // extern "C"
