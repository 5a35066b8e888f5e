// SPDX-License-Identifier: BSD-3-Clause
// Written by generate.py from api.json. Do not edit.
#ifndef CAIRN_CPP_SIM_TYPES_HPP
#define CAIRN_CPP_SIM_TYPES_HPP

#include <cairn/cpp/types.hpp>
#include <cairn/sim.h>
#include <cairn/fleet.h>
#include <array>
#include <cstddef>
#include <cstdint>

// clang-format off
namespace cairn {

/// Courses. On each the rover has a constant speed over the xy plane of the map.
enum class Course : std::int32_t {
  /// the course of the paper: a circle, driven anticlockwise; the default
  kCircle = CAIRN_COURSE_CIRCLE,
  /// a wandering closed curve, driven several times
  kLaps = CAIRN_COURSE_LAPS,
  /// a long drive: a chain of circles, alternately left and right. Each circle is driven 1.25 times before the next one
  /// is entered where both touch. So each circle closes a loop, and a quarter of it is seen again
  kTraverse = CAIRN_COURSE_TRAVERSE,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Course value) noexcept {
  switch (value) {
    case Course::kCircle: return "CAIRN_COURSE_CIRCLE";
    case Course::kLaps: return "CAIRN_COURSE_LAPS";
    case Course::kTraverse: return "CAIRN_COURSE_TRAVERSE";
  }
  return "";
}

/// Ground.
enum class Terrain : std::int32_t {
  /// seeded smooth hills, shifted to `start_height` at (100, 20); the default
  kRolling = CAIRN_TERRAIN_ROLLING,
  /// z = sin(x / 15) + 0.8 cos(y / 12); the same for every seed; not shifted
  kWaves = CAIRN_TERRAIN_WAVES,
  /// z = 0
  kFlat = CAIRN_TERRAIN_FLAT,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Terrain value) noexcept {
  switch (value) {
    case Terrain::kRolling: return "CAIRN_TERRAIN_ROLLING";
    case Terrain::kWaves: return "CAIRN_TERRAIN_WAVES";
    case Terrain::kFlat: return "CAIRN_TERRAIN_FLAT";
  }
  return "";
}

/// How the rover stands on the ground. Seen from above, its x axis points along the course.
enum class Contact : std::int32_t {
  /// on four wheels; a differential averages the left and the right rocker. All four wheels touch the ground, and
  /// height and attitude are those of the chassis between them; the default
  kWheels = CAIRN_CONTACT_WHEELS,
  /// at one point; its z axis is the normal of the ground
  kPoint = CAIRN_CONTACT_POINT,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Contact value) noexcept {
  switch (value) {
    case Contact::kWheels: return "CAIRN_CONTACT_WHEELS";
    case Contact::kPoint: return "CAIRN_CONTACT_POINT";
  }
  return "";
}

/// Measurements that the motion samples of a step hold as `velocity` and `rate`.
enum class Drive : std::int32_t {
  /// body velocity and body rate from the IMU; the default
  kTwist = CAIRN_DRIVE_TWIST,
  /// forward velocity from the wheels (Mars paper, eq. 1), zero along y and z; body rate from the gyro
  kWheelsGyro = CAIRN_DRIVE_WHEELS_GYRO,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Drive value) noexcept {
  switch (value) {
    case Drive::kTwist: return "CAIRN_DRIVE_TWIST";
    case Drive::kWheelsGyro: return "CAIRN_DRIVE_WHEELS_GYRO";
  }
  return "";
}

/// Noise of the accelerometer. Table 1 of the paper gives it in m/s.
enum class Accelerometer : std::int32_t {
  /// white noise of the body velocity, m/s a sample; the default
  kVelocity = CAIRN_ACCELEROMETER_VELOCITY,
  /// white noise of the acceleration, m/s^2 a sample: the velocity comes from dead reckoning of specific force and rate
  /// from a known start, and drifts
  kAcceleration = CAIRN_ACCELEROMETER_ACCELERATION,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Accelerometer value) noexcept {
  switch (value) {
    case Accelerometer::kVelocity: return "CAIRN_ACCELEROMETER_VELOCITY";
    case Accelerometer::kAcceleration: return "CAIRN_ACCELEROMETER_ACCELERATION";
  }
  return "";
}

/// How the noise of the stick angle enters.
enum class Stick : std::int32_t {
  /// independent in each observation's elevation; the default
  kPerObservation = CAIRN_STICK_PER_OBSERVATION,
  /// all observations of a frame share one encoder error; the image adds noise of `image_sigma` to each elevation
  kPerFrame = CAIRN_STICK_PER_FRAME,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Stick value) noexcept {
  switch (value) {
    case Stick::kPerObservation: return "CAIRN_STICK_PER_OBSERVATION";
    case Stick::kPerFrame: return "CAIRN_STICK_PER_FRAME";
  }
  return "";
}

/// Worlds for measurements. In the rows, velocity and rate noise are those of a sample of 0.2 s. The rows use
/// Terrain::kWaves, Contact::kPoint and a radius of 101.98 m.
enum class Preset : std::int32_t {
  /// the defaults: Table 1 as printed
  kPaper = CAIRN_PRESET_PAPER,
  /// 0.002 m/s, 0.02 degrees/s, 1 lap in 400 s
  kRow1 = CAIRN_PRESET_ROW1,
  /// 0.05 m/s, 0.2 degrees/s, 1 lap in 400 s
  kRow2 = CAIRN_PRESET_ROW2,
  /// 0.05 m/s, 0.2 degrees/s, 2 laps in 400 s
  kRow3 = CAIRN_PRESET_ROW3,
  /// 0.2 m/s, 1 degree/s, 2 laps in 400 s
  kRow4 = CAIRN_PRESET_ROW4,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Preset value) noexcept {
  switch (value) {
    case Preset::kPaper: return "CAIRN_PRESET_PAPER";
    case Preset::kRow1: return "CAIRN_PRESET_ROW1";
    case Preset::kRow2: return "CAIRN_PRESET_ROW2";
    case Preset::kRow3: return "CAIRN_PRESET_ROW3";
    case Preset::kRow4: return "CAIRN_PRESET_ROW4";
  }
  return "";
}

/// Where the features are. Both layouts have the coast line, but the radars see only features.
enum class FleetLayout : std::int32_t {
  /// uniform in the square, on both sides of the coast line; the default
  kUniform = CAIRN_FLEET_UNIFORM,
  /// along the coast line, in a strip of width `coast_strip` south of it. The coast line runs north of the boats, from
  /// the western side of the square to the eastern side
  kCoast = CAIRN_FLEET_COAST,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(FleetLayout value) noexcept {
  switch (value) {
    case FleetLayout::kUniform: return "CAIRN_FLEET_UNIFORM";
    case FleetLayout::kCoast: return "CAIRN_FLEET_COAST";
  }
  return "";
}

/// Options of World::World. Set them by WorldOptions::WorldOptions first; the defaults are Table 1 of the paper, with
/// the open choices filled in.
struct CAIRN_CPP_SAME_BYTES WorldOptions {
  using C = cairn_world_options;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_world_options);
  /// CAIRN_COURSE_...; default Course::kCircle
  Course course{};
  /// seed of all random draws; default 1
  std::uint64_t seed{};
  /// number of landmarks, 1 to 10000000; default 200 (Table 1). The length of laps and traverse follows from it
  std::uint32_t landmarks{};
  /// CAIRN_TERRAIN_...; default Terrain::kRolling
  Terrain terrain{};
  /// CAIRN_CONTACT_...; default Contact::kWheels
  Contact contact{};
  /// CAIRN_DRIVE_...; default Drive::kTwist
  Drive drive{};
  /// CAIRN_ACCELEROMETER_...; default Accelerometer::kVelocity
  Accelerometer accelerometer{};
  /// CAIRN_STICK_...; default Stick::kPerObservation
  Stick stick_noise{};
  /// 1: step 0, the known start, has a frame, too; default 0: the first frame comes one frame period later
  Bool observe_at_start{};
  /// 1: the circles of the traverse lie on one big ring, and the drive ends with a round of the first circle; this
  /// needs at least 1600 landmarks at the default strip and area; default 0
  Bool traverse_closed{};
  /// speed over the xy plane, m/s, > 0; default 2 pi hypot(100, 20) / 400: the default circle in 400 s (Table 1)
  double speed{};
  /// rounds of circle and laps, > 0; 0, the default: 1 round of a circle, 2 rounds of laps. Not used by a traverse
  double laps{};
  /// centre of the circle, x and y, m; default the origin (not in the paper)
  std::array<double, 2> centre{};
  /// radius of the circle, m, > strip; 0, the default: hypot(100, 20) landmarks / 200. With it the default start is
  /// (100, 20) as in Table 1, and the density of landmarks does not depend on their number
  double radius{};
  /// azimuth of the start as seen from the centre of the circle, rad; default atan2(20, 100)
  double start_azimuth{};
  /// circumference of the circles of the traverse, m, > 0; default 1500. They are scaled so that all landmarks are used
  double round_length{};
  /// share by which the seed varies this length, [0, 0.3]; default 0.1
  double round_variation{};
  /// landmarks lie within this distance of the course, m, > 0; default 25
  double strip{};
  /// area of ground for each landmark of laps and traverse, m^2, > 0; default 160
  double landmark_area{};
  /// landmarks are between 0 and this height above the ground, m, >= 0; default 1.5
  double landmark_height{};
  /// largest slope of the rolling ground, rad, [0, 45 degrees]; default 15 degrees
  double max_slope{};
  /// shortest and longest wave of the rolling ground, m, > 0; default 25 and 150
  std::array<double, 2> wavelength{};
  /// height of the rolling ground at (100, 20), m; default -0.3174 (Table 1)
  double start_height{};
  /// m, > 0; default 0.3 (Table 1)
  double wheel_radius{};
  /// distance between left and right wheels, m, > 0; default 1.0 (not in the paper)
  double track{};
  /// distance between front and rear wheels, m, > 0; default 1.2 (not in the paper)
  double wheelbase{};
  /// white noise per sample and axis, m/s or m/s^2 (`accelerometer`), >= 0; default 2e-3 (Table 1)
  double velocity_sigma{};
  /// white noise of the gyro per sample and axis, rad/s, >= 0; default 0.02 degrees/s (Table 1)
  double rate_sigma{};
  /// m/s^2, >= 0; default 3.71. Only Accelerometer::kAcceleration uses it
  double gravity{};
  /// white noise of each side's wheel rate per sample, rad/s, >= 0; default 0.01
  double wheel_rate_sigma{};
  /// white noise of each side's wheel rate in proportion to this rate, >= 0; default 0.02
  double wheel_slip_sigma{};
  /// noise that a step states for the velocity along y, which wheels do not measure, m/s, >= 0; default 0.01
  double lateral_sigma{};
  /// the same along z, m/s, >= 0; default 0.01
  double vertical_sigma{};
  /// period of IMU and wheel samples, s, > 0; default 0.05: 20 Hz (Table 1)
  double imu_period{};
  /// period of the motion samples in a step, s: a multiple of imu_period. IMU samples are composed into one motion
  /// sample. Default 0.2, the sampling period of Table 1
  double motion_period{};
  /// period of the camera, s: a multiple of motion_period; default 2: 0.5 Hz (Table 1)
  double frame_period{};
  /// noise of a range, m, > 0; default 1 (Table 1)
  double range_sigma{};
  /// noise of an azimuth, rad, > 0; default 3 degrees (Table 1)
  double azimuth_sigma{};
  /// noise of the stick angle, rad, > 0; default 3 degrees (Table 1)
  double stick_sigma{};
  /// noise of each elevation with Stick::kPerFrame, rad, > 0; default 0.5 degrees
  double image_sigma{};
  /// shortest distance at which the camera sees a landmark, m, > 0; default 2 (not in the paper)
  double near_range{};
  /// longest such distance, m, > near_range; default 40 (not in the paper)
  double far_range{};
  /// largest azimuth from the axis of the camera, rad, (0, pi]; default 60 degrees (not in the paper)
  double half_azimuth{};
  /// the head scans: pan = amplitude sin(2 pi t / period), rad, [0, pi]; default 0: fixed forward
  double pan_amplitude{};
  /// s, > 0; default 20
  double pan_period{};
  /// the same for the stick, rad, [0, 60 degrees]; default 0
  double stick_amplitude{};
  /// s, > 0; default 26
  double stick_period{};
  /// d of StereoHead, m; default 0 (not in the paper)
  std::array<double, 3> platform{};
  /// s of StereoHead, m; default 0 (not in the paper)
  std::array<double, 3> stick{};
  /// systematic errors of the rover, which World::head and World::wheels do not tell (docs/systematic_errors.md). Added
  /// to the measured body velocity, m/s; default 0; the wheels turn faster by the first component
  std::array<double, 3> velocity_bias{};
  /// added to the rate of the gyro, rad/s; default 0
  std::array<double, 3> rate_bias{};
  /// left and right: a wheel turns at its measured rate times 1 + this, > -1; default 0
  std::array<double, 2> wheel_scale{};
  /// rotation vector by which the head is turned about the origin of the body, rad; default 0
  std::array<double, 3> mount_turn{};
  /// by which the head is shifted after that, m; default 0
  std::array<double, 3> mount_shift{};
  /// added to the observed range (m), azimuth and elevation (rad); default 0
  std::array<double, 3> value_offset{};

  /// The defaults of the library.
  WorldOptions() { detail::fill_defaults<cairn_world_options>(*this, cairn_world_options_init); }
  /// A copy with another `course`.
  WorldOptions with_course(const Course& value) const {
    WorldOptions copy = *this;
    copy.course = value;
    return copy;
  }
  /// A copy with another `seed`.
  WorldOptions with_seed(const std::uint64_t& value) const {
    WorldOptions copy = *this;
    copy.seed = value;
    return copy;
  }
  /// A copy with another `landmarks`.
  WorldOptions with_landmarks(const std::uint32_t& value) const {
    WorldOptions copy = *this;
    copy.landmarks = value;
    return copy;
  }
  /// A copy with another `terrain`.
  WorldOptions with_terrain(const Terrain& value) const {
    WorldOptions copy = *this;
    copy.terrain = value;
    return copy;
  }
  /// A copy with another `contact`.
  WorldOptions with_contact(const Contact& value) const {
    WorldOptions copy = *this;
    copy.contact = value;
    return copy;
  }
  /// A copy with another `drive`.
  WorldOptions with_drive(const Drive& value) const {
    WorldOptions copy = *this;
    copy.drive = value;
    return copy;
  }
  /// A copy with another `accelerometer`.
  WorldOptions with_accelerometer(const Accelerometer& value) const {
    WorldOptions copy = *this;
    copy.accelerometer = value;
    return copy;
  }
  /// A copy with another `stick_noise`.
  WorldOptions with_stick_noise(const Stick& value) const {
    WorldOptions copy = *this;
    copy.stick_noise = value;
    return copy;
  }
  /// A copy with another `observe_at_start`.
  WorldOptions with_observe_at_start(const Bool& value) const {
    WorldOptions copy = *this;
    copy.observe_at_start = value;
    return copy;
  }
  /// A copy with another `traverse_closed`.
  WorldOptions with_traverse_closed(const Bool& value) const {
    WorldOptions copy = *this;
    copy.traverse_closed = value;
    return copy;
  }
  /// A copy with another `speed`.
  WorldOptions with_speed(const double& value) const {
    WorldOptions copy = *this;
    copy.speed = value;
    return copy;
  }
  /// A copy with another `laps`.
  WorldOptions with_laps(const double& value) const {
    WorldOptions copy = *this;
    copy.laps = value;
    return copy;
  }
  /// A copy with another `centre`.
  WorldOptions with_centre(const std::array<double, 2>& value) const {
    WorldOptions copy = *this;
    copy.centre = value;
    return copy;
  }
  /// A copy with another `radius`.
  WorldOptions with_radius(const double& value) const {
    WorldOptions copy = *this;
    copy.radius = value;
    return copy;
  }
  /// A copy with another `start_azimuth`.
  WorldOptions with_start_azimuth(const double& value) const {
    WorldOptions copy = *this;
    copy.start_azimuth = value;
    return copy;
  }
  /// A copy with another `round_length`.
  WorldOptions with_round_length(const double& value) const {
    WorldOptions copy = *this;
    copy.round_length = value;
    return copy;
  }
  /// A copy with another `round_variation`.
  WorldOptions with_round_variation(const double& value) const {
    WorldOptions copy = *this;
    copy.round_variation = value;
    return copy;
  }
  /// A copy with another `strip`.
  WorldOptions with_strip(const double& value) const {
    WorldOptions copy = *this;
    copy.strip = value;
    return copy;
  }
  /// A copy with another `landmark_area`.
  WorldOptions with_landmark_area(const double& value) const {
    WorldOptions copy = *this;
    copy.landmark_area = value;
    return copy;
  }
  /// A copy with another `landmark_height`.
  WorldOptions with_landmark_height(const double& value) const {
    WorldOptions copy = *this;
    copy.landmark_height = value;
    return copy;
  }
  /// A copy with another `max_slope`.
  WorldOptions with_max_slope(const double& value) const {
    WorldOptions copy = *this;
    copy.max_slope = value;
    return copy;
  }
  /// A copy with another `wavelength`.
  WorldOptions with_wavelength(const std::array<double, 2>& value) const {
    WorldOptions copy = *this;
    copy.wavelength = value;
    return copy;
  }
  /// A copy with another `start_height`.
  WorldOptions with_start_height(const double& value) const {
    WorldOptions copy = *this;
    copy.start_height = value;
    return copy;
  }
  /// A copy with another `wheel_radius`.
  WorldOptions with_wheel_radius(const double& value) const {
    WorldOptions copy = *this;
    copy.wheel_radius = value;
    return copy;
  }
  /// A copy with another `track`.
  WorldOptions with_track(const double& value) const {
    WorldOptions copy = *this;
    copy.track = value;
    return copy;
  }
  /// A copy with another `wheelbase`.
  WorldOptions with_wheelbase(const double& value) const {
    WorldOptions copy = *this;
    copy.wheelbase = value;
    return copy;
  }
  /// A copy with another `velocity_sigma`.
  WorldOptions with_velocity_sigma(const double& value) const {
    WorldOptions copy = *this;
    copy.velocity_sigma = value;
    return copy;
  }
  /// A copy with another `rate_sigma`.
  WorldOptions with_rate_sigma(const double& value) const {
    WorldOptions copy = *this;
    copy.rate_sigma = value;
    return copy;
  }
  /// A copy with another `gravity`.
  WorldOptions with_gravity(const double& value) const {
    WorldOptions copy = *this;
    copy.gravity = value;
    return copy;
  }
  /// A copy with another `wheel_rate_sigma`.
  WorldOptions with_wheel_rate_sigma(const double& value) const {
    WorldOptions copy = *this;
    copy.wheel_rate_sigma = value;
    return copy;
  }
  /// A copy with another `wheel_slip_sigma`.
  WorldOptions with_wheel_slip_sigma(const double& value) const {
    WorldOptions copy = *this;
    copy.wheel_slip_sigma = value;
    return copy;
  }
  /// A copy with another `lateral_sigma`.
  WorldOptions with_lateral_sigma(const double& value) const {
    WorldOptions copy = *this;
    copy.lateral_sigma = value;
    return copy;
  }
  /// A copy with another `vertical_sigma`.
  WorldOptions with_vertical_sigma(const double& value) const {
    WorldOptions copy = *this;
    copy.vertical_sigma = value;
    return copy;
  }
  /// A copy with another `imu_period`.
  WorldOptions with_imu_period(const double& value) const {
    WorldOptions copy = *this;
    copy.imu_period = value;
    return copy;
  }
  /// A copy with another `motion_period`.
  WorldOptions with_motion_period(const double& value) const {
    WorldOptions copy = *this;
    copy.motion_period = value;
    return copy;
  }
  /// A copy with another `frame_period`.
  WorldOptions with_frame_period(const double& value) const {
    WorldOptions copy = *this;
    copy.frame_period = value;
    return copy;
  }
  /// A copy with another `range_sigma`.
  WorldOptions with_range_sigma(const double& value) const {
    WorldOptions copy = *this;
    copy.range_sigma = value;
    return copy;
  }
  /// A copy with another `azimuth_sigma`.
  WorldOptions with_azimuth_sigma(const double& value) const {
    WorldOptions copy = *this;
    copy.azimuth_sigma = value;
    return copy;
  }
  /// A copy with another `stick_sigma`.
  WorldOptions with_stick_sigma(const double& value) const {
    WorldOptions copy = *this;
    copy.stick_sigma = value;
    return copy;
  }
  /// A copy with another `image_sigma`.
  WorldOptions with_image_sigma(const double& value) const {
    WorldOptions copy = *this;
    copy.image_sigma = value;
    return copy;
  }
  /// A copy with another `near_range`.
  WorldOptions with_near_range(const double& value) const {
    WorldOptions copy = *this;
    copy.near_range = value;
    return copy;
  }
  /// A copy with another `far_range`.
  WorldOptions with_far_range(const double& value) const {
    WorldOptions copy = *this;
    copy.far_range = value;
    return copy;
  }
  /// A copy with another `half_azimuth`.
  WorldOptions with_half_azimuth(const double& value) const {
    WorldOptions copy = *this;
    copy.half_azimuth = value;
    return copy;
  }
  /// A copy with another `pan_amplitude`.
  WorldOptions with_pan_amplitude(const double& value) const {
    WorldOptions copy = *this;
    copy.pan_amplitude = value;
    return copy;
  }
  /// A copy with another `pan_period`.
  WorldOptions with_pan_period(const double& value) const {
    WorldOptions copy = *this;
    copy.pan_period = value;
    return copy;
  }
  /// A copy with another `stick_amplitude`.
  WorldOptions with_stick_amplitude(const double& value) const {
    WorldOptions copy = *this;
    copy.stick_amplitude = value;
    return copy;
  }
  /// A copy with another `stick_period`.
  WorldOptions with_stick_period(const double& value) const {
    WorldOptions copy = *this;
    copy.stick_period = value;
    return copy;
  }
  /// A copy with another `platform`.
  WorldOptions with_platform(const std::array<double, 3>& value) const {
    WorldOptions copy = *this;
    copy.platform = value;
    return copy;
  }
  /// A copy with another `stick`.
  WorldOptions with_stick(const std::array<double, 3>& value) const {
    WorldOptions copy = *this;
    copy.stick = value;
    return copy;
  }
  /// A copy with another `velocity_bias`.
  WorldOptions with_velocity_bias(const std::array<double, 3>& value) const {
    WorldOptions copy = *this;
    copy.velocity_bias = value;
    return copy;
  }
  /// A copy with another `rate_bias`.
  WorldOptions with_rate_bias(const std::array<double, 3>& value) const {
    WorldOptions copy = *this;
    copy.rate_bias = value;
    return copy;
  }
  /// A copy with another `wheel_scale`.
  WorldOptions with_wheel_scale(const std::array<double, 2>& value) const {
    WorldOptions copy = *this;
    copy.wheel_scale = value;
    return copy;
  }
  /// A copy with another `mount_turn`.
  WorldOptions with_mount_turn(const std::array<double, 3>& value) const {
    WorldOptions copy = *this;
    copy.mount_turn = value;
    return copy;
  }
  /// A copy with another `mount_shift`.
  WorldOptions with_mount_shift(const std::array<double, 3>& value) const {
    WorldOptions copy = *this;
    copy.mount_shift = value;
    return copy;
  }
  /// A copy with another `value_offset`.
  WorldOptions with_value_offset(const std::array<double, 3>& value) const {
    WorldOptions copy = *this;
    copy.value_offset = value;
    return copy;
  }
};
static_assert(detail::same_layout<WorldOptions, cairn_world_options>);
static_assert(offsetof(WorldOptions, struct_size) == offsetof(cairn_world_options, struct_size) && sizeof(WorldOptions::struct_size) == sizeof(cairn_world_options::struct_size));
static_assert(offsetof(WorldOptions, course) == offsetof(cairn_world_options, course) && sizeof(WorldOptions::course) == sizeof(cairn_world_options::course));
static_assert(offsetof(WorldOptions, seed) == offsetof(cairn_world_options, seed) && sizeof(WorldOptions::seed) == sizeof(cairn_world_options::seed));
static_assert(offsetof(WorldOptions, landmarks) == offsetof(cairn_world_options, landmarks) && sizeof(WorldOptions::landmarks) == sizeof(cairn_world_options::landmarks));
static_assert(offsetof(WorldOptions, terrain) == offsetof(cairn_world_options, terrain) && sizeof(WorldOptions::terrain) == sizeof(cairn_world_options::terrain));
static_assert(offsetof(WorldOptions, contact) == offsetof(cairn_world_options, contact) && sizeof(WorldOptions::contact) == sizeof(cairn_world_options::contact));
static_assert(offsetof(WorldOptions, drive) == offsetof(cairn_world_options, drive) && sizeof(WorldOptions::drive) == sizeof(cairn_world_options::drive));
static_assert(offsetof(WorldOptions, accelerometer) == offsetof(cairn_world_options, accelerometer) && sizeof(WorldOptions::accelerometer) == sizeof(cairn_world_options::accelerometer));
static_assert(offsetof(WorldOptions, stick_noise) == offsetof(cairn_world_options, stick_noise) && sizeof(WorldOptions::stick_noise) == sizeof(cairn_world_options::stick_noise));
static_assert(offsetof(WorldOptions, observe_at_start) == offsetof(cairn_world_options, observe_at_start) && sizeof(WorldOptions::observe_at_start) == sizeof(cairn_world_options::observe_at_start));
static_assert(offsetof(WorldOptions, traverse_closed) == offsetof(cairn_world_options, traverse_closed) && sizeof(WorldOptions::traverse_closed) == sizeof(cairn_world_options::traverse_closed));
static_assert(offsetof(WorldOptions, speed) == offsetof(cairn_world_options, speed) && sizeof(WorldOptions::speed) == sizeof(cairn_world_options::speed));
static_assert(offsetof(WorldOptions, laps) == offsetof(cairn_world_options, laps) && sizeof(WorldOptions::laps) == sizeof(cairn_world_options::laps));
static_assert(offsetof(WorldOptions, centre) == offsetof(cairn_world_options, centre) && sizeof(WorldOptions::centre) == sizeof(cairn_world_options::centre));
static_assert(offsetof(WorldOptions, radius) == offsetof(cairn_world_options, radius) && sizeof(WorldOptions::radius) == sizeof(cairn_world_options::radius));
static_assert(offsetof(WorldOptions, start_azimuth) == offsetof(cairn_world_options, start_azimuth) && sizeof(WorldOptions::start_azimuth) == sizeof(cairn_world_options::start_azimuth));
static_assert(offsetof(WorldOptions, round_length) == offsetof(cairn_world_options, round_length) && sizeof(WorldOptions::round_length) == sizeof(cairn_world_options::round_length));
static_assert(offsetof(WorldOptions, round_variation) == offsetof(cairn_world_options, round_variation) && sizeof(WorldOptions::round_variation) == sizeof(cairn_world_options::round_variation));
static_assert(offsetof(WorldOptions, strip) == offsetof(cairn_world_options, strip) && sizeof(WorldOptions::strip) == sizeof(cairn_world_options::strip));
static_assert(offsetof(WorldOptions, landmark_area) == offsetof(cairn_world_options, landmark_area) && sizeof(WorldOptions::landmark_area) == sizeof(cairn_world_options::landmark_area));
static_assert(offsetof(WorldOptions, landmark_height) == offsetof(cairn_world_options, landmark_height) && sizeof(WorldOptions::landmark_height) == sizeof(cairn_world_options::landmark_height));
static_assert(offsetof(WorldOptions, max_slope) == offsetof(cairn_world_options, max_slope) && sizeof(WorldOptions::max_slope) == sizeof(cairn_world_options::max_slope));
static_assert(offsetof(WorldOptions, wavelength) == offsetof(cairn_world_options, wavelength) && sizeof(WorldOptions::wavelength) == sizeof(cairn_world_options::wavelength));
static_assert(offsetof(WorldOptions, start_height) == offsetof(cairn_world_options, start_height) && sizeof(WorldOptions::start_height) == sizeof(cairn_world_options::start_height));
static_assert(offsetof(WorldOptions, wheel_radius) == offsetof(cairn_world_options, wheel_radius) && sizeof(WorldOptions::wheel_radius) == sizeof(cairn_world_options::wheel_radius));
static_assert(offsetof(WorldOptions, track) == offsetof(cairn_world_options, track) && sizeof(WorldOptions::track) == sizeof(cairn_world_options::track));
static_assert(offsetof(WorldOptions, wheelbase) == offsetof(cairn_world_options, wheelbase) && sizeof(WorldOptions::wheelbase) == sizeof(cairn_world_options::wheelbase));
static_assert(offsetof(WorldOptions, velocity_sigma) == offsetof(cairn_world_options, velocity_sigma) && sizeof(WorldOptions::velocity_sigma) == sizeof(cairn_world_options::velocity_sigma));
static_assert(offsetof(WorldOptions, rate_sigma) == offsetof(cairn_world_options, rate_sigma) && sizeof(WorldOptions::rate_sigma) == sizeof(cairn_world_options::rate_sigma));
static_assert(offsetof(WorldOptions, gravity) == offsetof(cairn_world_options, gravity) && sizeof(WorldOptions::gravity) == sizeof(cairn_world_options::gravity));
static_assert(offsetof(WorldOptions, wheel_rate_sigma) == offsetof(cairn_world_options, wheel_rate_sigma) && sizeof(WorldOptions::wheel_rate_sigma) == sizeof(cairn_world_options::wheel_rate_sigma));
static_assert(offsetof(WorldOptions, wheel_slip_sigma) == offsetof(cairn_world_options, wheel_slip_sigma) && sizeof(WorldOptions::wheel_slip_sigma) == sizeof(cairn_world_options::wheel_slip_sigma));
static_assert(offsetof(WorldOptions, lateral_sigma) == offsetof(cairn_world_options, lateral_sigma) && sizeof(WorldOptions::lateral_sigma) == sizeof(cairn_world_options::lateral_sigma));
static_assert(offsetof(WorldOptions, vertical_sigma) == offsetof(cairn_world_options, vertical_sigma) && sizeof(WorldOptions::vertical_sigma) == sizeof(cairn_world_options::vertical_sigma));
static_assert(offsetof(WorldOptions, imu_period) == offsetof(cairn_world_options, imu_period) && sizeof(WorldOptions::imu_period) == sizeof(cairn_world_options::imu_period));
static_assert(offsetof(WorldOptions, motion_period) == offsetof(cairn_world_options, motion_period) && sizeof(WorldOptions::motion_period) == sizeof(cairn_world_options::motion_period));
static_assert(offsetof(WorldOptions, frame_period) == offsetof(cairn_world_options, frame_period) && sizeof(WorldOptions::frame_period) == sizeof(cairn_world_options::frame_period));
static_assert(offsetof(WorldOptions, range_sigma) == offsetof(cairn_world_options, range_sigma) && sizeof(WorldOptions::range_sigma) == sizeof(cairn_world_options::range_sigma));
static_assert(offsetof(WorldOptions, azimuth_sigma) == offsetof(cairn_world_options, azimuth_sigma) && sizeof(WorldOptions::azimuth_sigma) == sizeof(cairn_world_options::azimuth_sigma));
static_assert(offsetof(WorldOptions, stick_sigma) == offsetof(cairn_world_options, stick_sigma) && sizeof(WorldOptions::stick_sigma) == sizeof(cairn_world_options::stick_sigma));
static_assert(offsetof(WorldOptions, image_sigma) == offsetof(cairn_world_options, image_sigma) && sizeof(WorldOptions::image_sigma) == sizeof(cairn_world_options::image_sigma));
static_assert(offsetof(WorldOptions, near_range) == offsetof(cairn_world_options, near_range) && sizeof(WorldOptions::near_range) == sizeof(cairn_world_options::near_range));
static_assert(offsetof(WorldOptions, far_range) == offsetof(cairn_world_options, far_range) && sizeof(WorldOptions::far_range) == sizeof(cairn_world_options::far_range));
static_assert(offsetof(WorldOptions, half_azimuth) == offsetof(cairn_world_options, half_azimuth) && sizeof(WorldOptions::half_azimuth) == sizeof(cairn_world_options::half_azimuth));
static_assert(offsetof(WorldOptions, pan_amplitude) == offsetof(cairn_world_options, pan_amplitude) && sizeof(WorldOptions::pan_amplitude) == sizeof(cairn_world_options::pan_amplitude));
static_assert(offsetof(WorldOptions, pan_period) == offsetof(cairn_world_options, pan_period) && sizeof(WorldOptions::pan_period) == sizeof(cairn_world_options::pan_period));
static_assert(offsetof(WorldOptions, stick_amplitude) == offsetof(cairn_world_options, stick_amplitude) && sizeof(WorldOptions::stick_amplitude) == sizeof(cairn_world_options::stick_amplitude));
static_assert(offsetof(WorldOptions, stick_period) == offsetof(cairn_world_options, stick_period) && sizeof(WorldOptions::stick_period) == sizeof(cairn_world_options::stick_period));
static_assert(offsetof(WorldOptions, platform) == offsetof(cairn_world_options, platform) && sizeof(WorldOptions::platform) == sizeof(cairn_world_options::platform));
static_assert(offsetof(WorldOptions, stick) == offsetof(cairn_world_options, stick) && sizeof(WorldOptions::stick) == sizeof(cairn_world_options::stick));
static_assert(offsetof(WorldOptions, velocity_bias) == offsetof(cairn_world_options, velocity_bias) && sizeof(WorldOptions::velocity_bias) == sizeof(cairn_world_options::velocity_bias));
static_assert(offsetof(WorldOptions, rate_bias) == offsetof(cairn_world_options, rate_bias) && sizeof(WorldOptions::rate_bias) == sizeof(cairn_world_options::rate_bias));
static_assert(offsetof(WorldOptions, wheel_scale) == offsetof(cairn_world_options, wheel_scale) && sizeof(WorldOptions::wheel_scale) == sizeof(cairn_world_options::wheel_scale));
static_assert(offsetof(WorldOptions, mount_turn) == offsetof(cairn_world_options, mount_turn) && sizeof(WorldOptions::mount_turn) == sizeof(cairn_world_options::mount_turn));
static_assert(offsetof(WorldOptions, mount_shift) == offsetof(cairn_world_options, mount_shift) && sizeof(WorldOptions::mount_shift) == sizeof(cairn_world_options::mount_shift));
static_assert(offsetof(WorldOptions, value_offset) == offsetof(cairn_world_options, value_offset) && sizeof(WorldOptions::value_offset) == sizeof(cairn_world_options::value_offset));

/// A motion sample: measured and true motion of the rover during `dt` seconds. Layout frozen.
struct CAIRN_CPP_SAME_BYTES WorldMotion {
  using C = cairn_world_motion;
  /// s
  double dt{};
  /// measured velocity, body axes, m/s (`drive`)
  std::array<double, 3> velocity{};
  /// measured rate, body axes, rad/s
  std::array<double, 3> rate{};
  /// measured turning rates of the left and the right wheels, rad/s: means over dt
  std::array<double, 2> wheels{};
  /// true velocity, m/s. With true_rate it leads from the true pose before to the true pose after: T <- T Exp([v; w]
  /// dt)
  std::array<double, 3> true_velocity{};
  /// true rate, rad/s
  std::array<double, 3> true_rate{};
  /// true turning rates, rad/s: those that follow from eq. 1 of the paper
  std::array<double, 2> true_wheels{};
};
static_assert(detail::same_layout<WorldMotion, cairn_world_motion>);
static_assert(offsetof(WorldMotion, dt) == offsetof(cairn_world_motion, dt) && sizeof(WorldMotion::dt) == sizeof(cairn_world_motion::dt));
static_assert(offsetof(WorldMotion, velocity) == offsetof(cairn_world_motion, velocity) && sizeof(WorldMotion::velocity) == sizeof(cairn_world_motion::velocity));
static_assert(offsetof(WorldMotion, rate) == offsetof(cairn_world_motion, rate) && sizeof(WorldMotion::rate) == sizeof(cairn_world_motion::rate));
static_assert(offsetof(WorldMotion, wheels) == offsetof(cairn_world_motion, wheels) && sizeof(WorldMotion::wheels) == sizeof(cairn_world_motion::wheels));
static_assert(offsetof(WorldMotion, true_velocity) == offsetof(cairn_world_motion, true_velocity) && sizeof(WorldMotion::true_velocity) == sizeof(cairn_world_motion::true_velocity));
static_assert(offsetof(WorldMotion, true_rate) == offsetof(cairn_world_motion, true_rate) && sizeof(WorldMotion::true_rate) == sizeof(cairn_world_motion::true_rate));
static_assert(offsetof(WorldMotion, true_wheels) == offsetof(cairn_world_motion, true_wheels) && sizeof(WorldMotion::true_wheels) == sizeof(cairn_world_motion::true_wheels));

/// A step: the motion samples since the previous step (World::motions), then one frame (World::observations).
struct CAIRN_CPP_SAME_BYTES WorldStep {
  using C = cairn_world_step;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_world_step);
  /// leave it zero
  std::uint32_t reserved{};
  /// counted from 0; step 0 is the start
  std::uint64_t number{};
  /// s, from 0
  double time{};
  /// true pose of the body in the map at the end of the step
  Pose truth{};
  /// noise of the `velocity` of each motion sample, for TwistNoise. The drift of an accelerometer is stated by its size
  /// at this time, as if it were white noise
  std::array<double, 3> velocity_sigma{};
  /// noise of the `rate` of each motion sample
  std::array<double, 3> rate_sigma{};
  /// pan angle of the head, from its encoder, rad
  double pan{};
  /// stick angle of the head, from its encoder, rad
  double stick{};
  /// motion samples of the step, for World::motions; 0 at step 0
  std::uint64_t motion_count{};
  /// observations of the frame, for World::observations
  std::uint64_t observation_count{};
};
static_assert(detail::same_layout<WorldStep, cairn_world_step>);
static_assert(offsetof(WorldStep, struct_size) == offsetof(cairn_world_step, struct_size) && sizeof(WorldStep::struct_size) == sizeof(cairn_world_step::struct_size));
static_assert(offsetof(WorldStep, reserved) == offsetof(cairn_world_step, reserved) && sizeof(WorldStep::reserved) == sizeof(cairn_world_step::reserved));
static_assert(offsetof(WorldStep, number) == offsetof(cairn_world_step, number) && sizeof(WorldStep::number) == sizeof(cairn_world_step::number));
static_assert(offsetof(WorldStep, time) == offsetof(cairn_world_step, time) && sizeof(WorldStep::time) == sizeof(cairn_world_step::time));
static_assert(offsetof(WorldStep, truth) == offsetof(cairn_world_step, truth) && sizeof(WorldStep::truth) == sizeof(cairn_world_step::truth));
static_assert(offsetof(WorldStep, velocity_sigma) == offsetof(cairn_world_step, velocity_sigma) && sizeof(WorldStep::velocity_sigma) == sizeof(cairn_world_step::velocity_sigma));
static_assert(offsetof(WorldStep, rate_sigma) == offsetof(cairn_world_step, rate_sigma) && sizeof(WorldStep::rate_sigma) == sizeof(cairn_world_step::rate_sigma));
static_assert(offsetof(WorldStep, pan) == offsetof(cairn_world_step, pan) && sizeof(WorldStep::pan) == sizeof(cairn_world_step::pan));
static_assert(offsetof(WorldStep, stick) == offsetof(cairn_world_step, stick) && sizeof(WorldStep::stick) == sizeof(cairn_world_step::stick));
static_assert(offsetof(WorldStep, motion_count) == offsetof(cairn_world_step, motion_count) && sizeof(WorldStep::motion_count) == sizeof(cairn_world_step::motion_count));
static_assert(offsetof(WorldStep, observation_count) == offsetof(cairn_world_step, observation_count) && sizeof(WorldStep::observation_count) == sizeof(cairn_world_step::observation_count));

/// Options of Fleet::Fleet. Set them by FleetOptions::FleetOptions first; the defaults are the figures of the paper,
/// with the open choices filled in.
struct CAIRN_CPP_SAME_BYTES FleetOptions {
  using C = cairn_fleet_options;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_fleet_options);
  /// CAIRN_FLEET_...; default FleetLayout::kUniform
  FleetLayout layout{};
  /// seed of all random draws; default 1
  std::uint64_t seed{};
  /// number of boats, 1 to 64; default 2 (paper)
  std::uint32_t vehicles{};
  /// number of features, 1 to 100000; default 10 (paper: 6, 10, 40)
  std::uint32_t features{};
  /// side of the square, m, > 0; default 10000 (paper)
  double area{};
  /// distance between neighbours at the start, m, > 0, at most half of `area`; default 1500 (not in the paper). Three
  /// or more boats may be closer: see Fleet::Fleet
  double separation{};
  /// circumference of each boat's circle, m, > 0, at most `area`; default 1700 (paper)
  double course_length{};
  /// duration of one round, which is the whole drive, s, > 0; default 1500 (paper)
  double duration{};
  /// period of the radars, s, > 0, at most `duration`; default 5 (not in the paper)
  double period{};
  /// range of the radars, m, > 0; default 5000 (paper)
  double radar_range{};
  /// noise of a range, m, >= 0; default 30 (not in the paper)
  double range_sigma{};
  /// noise of a bearing, rad, >= 0; default 0.3 degrees (not in the paper)
  double bearing_sigma{};
  /// difference between executed and commanded speed: white noise, one draw a period, m/s, >= 0; default 0.2 (not in
  /// the paper)
  double speed_sigma{};
  /// the same for the rate of turn, rad/s, >= 0; default 0.1 degrees/s (not in the paper)
  double rate_sigma{};
  /// distance of the mean coast line north of the origin, as a share of `area`, (0, 0.5]; default 0.35 (not in the
  /// paper)
  double coast_distance{};
  /// largest deviation of the coast line from its mean, as a share of `area`, [0, 0.5 - coast_distance]; default 0.05
  /// (not in the paper)
  double coast_relief{};
  /// width of the strip of water that holds the features, as a share of `area`, [0, 0.5]; default 0.03 (not in the
  /// paper). Only FleetLayout::kCoast uses it
  double coast_strip{};

  /// The defaults of the library.
  FleetOptions() { detail::fill_defaults<cairn_fleet_options>(*this, cairn_fleet_options_init); }
  /// A copy with another `layout`.
  FleetOptions with_layout(const FleetLayout& value) const {
    FleetOptions copy = *this;
    copy.layout = value;
    return copy;
  }
  /// A copy with another `seed`.
  FleetOptions with_seed(const std::uint64_t& value) const {
    FleetOptions copy = *this;
    copy.seed = value;
    return copy;
  }
  /// A copy with another `vehicles`.
  FleetOptions with_vehicles(const std::uint32_t& value) const {
    FleetOptions copy = *this;
    copy.vehicles = value;
    return copy;
  }
  /// A copy with another `features`.
  FleetOptions with_features(const std::uint32_t& value) const {
    FleetOptions copy = *this;
    copy.features = value;
    return copy;
  }
  /// A copy with another `area`.
  FleetOptions with_area(const double& value) const {
    FleetOptions copy = *this;
    copy.area = value;
    return copy;
  }
  /// A copy with another `separation`.
  FleetOptions with_separation(const double& value) const {
    FleetOptions copy = *this;
    copy.separation = value;
    return copy;
  }
  /// A copy with another `course_length`.
  FleetOptions with_course_length(const double& value) const {
    FleetOptions copy = *this;
    copy.course_length = value;
    return copy;
  }
  /// A copy with another `duration`.
  FleetOptions with_duration(const double& value) const {
    FleetOptions copy = *this;
    copy.duration = value;
    return copy;
  }
  /// A copy with another `period`.
  FleetOptions with_period(const double& value) const {
    FleetOptions copy = *this;
    copy.period = value;
    return copy;
  }
  /// A copy with another `radar_range`.
  FleetOptions with_radar_range(const double& value) const {
    FleetOptions copy = *this;
    copy.radar_range = value;
    return copy;
  }
  /// A copy with another `range_sigma`.
  FleetOptions with_range_sigma(const double& value) const {
    FleetOptions copy = *this;
    copy.range_sigma = value;
    return copy;
  }
  /// A copy with another `bearing_sigma`.
  FleetOptions with_bearing_sigma(const double& value) const {
    FleetOptions copy = *this;
    copy.bearing_sigma = value;
    return copy;
  }
  /// A copy with another `speed_sigma`.
  FleetOptions with_speed_sigma(const double& value) const {
    FleetOptions copy = *this;
    copy.speed_sigma = value;
    return copy;
  }
  /// A copy with another `rate_sigma`.
  FleetOptions with_rate_sigma(const double& value) const {
    FleetOptions copy = *this;
    copy.rate_sigma = value;
    return copy;
  }
  /// A copy with another `coast_distance`.
  FleetOptions with_coast_distance(const double& value) const {
    FleetOptions copy = *this;
    copy.coast_distance = value;
    return copy;
  }
  /// A copy with another `coast_relief`.
  FleetOptions with_coast_relief(const double& value) const {
    FleetOptions copy = *this;
    copy.coast_relief = value;
    return copy;
  }
  /// A copy with another `coast_strip`.
  FleetOptions with_coast_strip(const double& value) const {
    FleetOptions copy = *this;
    copy.coast_strip = value;
    return copy;
  }
};
static_assert(detail::same_layout<FleetOptions, cairn_fleet_options>);
static_assert(offsetof(FleetOptions, struct_size) == offsetof(cairn_fleet_options, struct_size) && sizeof(FleetOptions::struct_size) == sizeof(cairn_fleet_options::struct_size));
static_assert(offsetof(FleetOptions, layout) == offsetof(cairn_fleet_options, layout) && sizeof(FleetOptions::layout) == sizeof(cairn_fleet_options::layout));
static_assert(offsetof(FleetOptions, seed) == offsetof(cairn_fleet_options, seed) && sizeof(FleetOptions::seed) == sizeof(cairn_fleet_options::seed));
static_assert(offsetof(FleetOptions, vehicles) == offsetof(cairn_fleet_options, vehicles) && sizeof(FleetOptions::vehicles) == sizeof(cairn_fleet_options::vehicles));
static_assert(offsetof(FleetOptions, features) == offsetof(cairn_fleet_options, features) && sizeof(FleetOptions::features) == sizeof(cairn_fleet_options::features));
static_assert(offsetof(FleetOptions, area) == offsetof(cairn_fleet_options, area) && sizeof(FleetOptions::area) == sizeof(cairn_fleet_options::area));
static_assert(offsetof(FleetOptions, separation) == offsetof(cairn_fleet_options, separation) && sizeof(FleetOptions::separation) == sizeof(cairn_fleet_options::separation));
static_assert(offsetof(FleetOptions, course_length) == offsetof(cairn_fleet_options, course_length) && sizeof(FleetOptions::course_length) == sizeof(cairn_fleet_options::course_length));
static_assert(offsetof(FleetOptions, duration) == offsetof(cairn_fleet_options, duration) && sizeof(FleetOptions::duration) == sizeof(cairn_fleet_options::duration));
static_assert(offsetof(FleetOptions, period) == offsetof(cairn_fleet_options, period) && sizeof(FleetOptions::period) == sizeof(cairn_fleet_options::period));
static_assert(offsetof(FleetOptions, radar_range) == offsetof(cairn_fleet_options, radar_range) && sizeof(FleetOptions::radar_range) == sizeof(cairn_fleet_options::radar_range));
static_assert(offsetof(FleetOptions, range_sigma) == offsetof(cairn_fleet_options, range_sigma) && sizeof(FleetOptions::range_sigma) == sizeof(cairn_fleet_options::range_sigma));
static_assert(offsetof(FleetOptions, bearing_sigma) == offsetof(cairn_fleet_options, bearing_sigma) && sizeof(FleetOptions::bearing_sigma) == sizeof(cairn_fleet_options::bearing_sigma));
static_assert(offsetof(FleetOptions, speed_sigma) == offsetof(cairn_fleet_options, speed_sigma) && sizeof(FleetOptions::speed_sigma) == sizeof(cairn_fleet_options::speed_sigma));
static_assert(offsetof(FleetOptions, rate_sigma) == offsetof(cairn_fleet_options, rate_sigma) && sizeof(FleetOptions::rate_sigma) == sizeof(cairn_fleet_options::rate_sigma));
static_assert(offsetof(FleetOptions, coast_distance) == offsetof(cairn_fleet_options, coast_distance) && sizeof(FleetOptions::coast_distance) == sizeof(cairn_fleet_options::coast_distance));
static_assert(offsetof(FleetOptions, coast_relief) == offsetof(cairn_fleet_options, coast_relief) && sizeof(FleetOptions::coast_relief) == sizeof(cairn_fleet_options::coast_relief));
static_assert(offsetof(FleetOptions, coast_strip) == offsetof(cairn_fleet_options, coast_strip) && sizeof(FleetOptions::coast_strip) == sizeof(cairn_fleet_options::coast_strip));

/// Radar measurement of a feature or of a boat. Layout frozen.
struct CAIRN_CPP_SAME_BYTES FleetSighting {
  using C = cairn_fleet_sighting;
  /// number of the feature or of the boat; both count from 1
  std::uint64_t id{};
  /// m, > 0: noise that would make it 0 or less is drawn again
  double range{};
  /// in the frame of the boat that measures, rad
  double bearing{};
};
static_assert(detail::same_layout<FleetSighting, cairn_fleet_sighting>);
static_assert(offsetof(FleetSighting, id) == offsetof(cairn_fleet_sighting, id) && sizeof(FleetSighting::id) == sizeof(cairn_fleet_sighting::id));
static_assert(offsetof(FleetSighting, range) == offsetof(cairn_fleet_sighting, range) && sizeof(FleetSighting::range) == sizeof(cairn_fleet_sighting::range));
static_assert(offsetof(FleetSighting, bearing) == offsetof(cairn_fleet_sighting, bearing) && sizeof(FleetSighting::bearing) == sizeof(cairn_fleet_sighting::bearing));

/// A boat at the end of a step. Layout frozen.
struct CAIRN_CPP_SAME_BYTES FleetVehicle {
  using C = cairn_fleet_vehicle;
  /// commanded speed during the step, m/s: the input of a filter; 0 at step 0
  double speed{};
  /// commanded rate during the step, rad/s; 0 at step 0
  double rate{};
  /// true position, east, m
  double x{};
  /// true position, north, m
  double y{};
  /// true heading, rad
  double heading{};
  /// measured features, for Fleet::seen_features
  std::uint64_t feature_count{};
  /// measured other boats, for Fleet::seen_vehicles
  std::uint64_t vehicle_count{};
};
static_assert(detail::same_layout<FleetVehicle, cairn_fleet_vehicle>);
static_assert(offsetof(FleetVehicle, speed) == offsetof(cairn_fleet_vehicle, speed) && sizeof(FleetVehicle::speed) == sizeof(cairn_fleet_vehicle::speed));
static_assert(offsetof(FleetVehicle, rate) == offsetof(cairn_fleet_vehicle, rate) && sizeof(FleetVehicle::rate) == sizeof(cairn_fleet_vehicle::rate));
static_assert(offsetof(FleetVehicle, x) == offsetof(cairn_fleet_vehicle, x) && sizeof(FleetVehicle::x) == sizeof(cairn_fleet_vehicle::x));
static_assert(offsetof(FleetVehicle, y) == offsetof(cairn_fleet_vehicle, y) && sizeof(FleetVehicle::y) == sizeof(cairn_fleet_vehicle::y));
static_assert(offsetof(FleetVehicle, heading) == offsetof(cairn_fleet_vehicle, heading) && sizeof(FleetVehicle::heading) == sizeof(cairn_fleet_vehicle::heading));
static_assert(offsetof(FleetVehicle, feature_count) == offsetof(cairn_fleet_vehicle, feature_count) && sizeof(FleetVehicle::feature_count) == sizeof(cairn_fleet_vehicle::feature_count));
static_assert(offsetof(FleetVehicle, vehicle_count) == offsetof(cairn_fleet_vehicle, vehicle_count) && sizeof(FleetVehicle::vehicle_count) == sizeof(cairn_fleet_vehicle::vehicle_count));

/// A step: all boats move, then all boats scan.
struct CAIRN_CPP_SAME_BYTES FleetStep {
  using C = cairn_fleet_step;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_fleet_step);
  /// leave it zero
  std::uint32_t reserved{};
  /// counted from 0; step 0 is a scan at the start, before any motion
  std::uint64_t number{};
  /// s, from 0
  double time{};
  /// since the step before, s: `period`, or 0 at step 0
  double dt{};
  /// number of boats, for Fleet::vehicles
  std::uint64_t vehicle_count{};
};
static_assert(detail::same_layout<FleetStep, cairn_fleet_step>);
static_assert(offsetof(FleetStep, struct_size) == offsetof(cairn_fleet_step, struct_size) && sizeof(FleetStep::struct_size) == sizeof(cairn_fleet_step::struct_size));
static_assert(offsetof(FleetStep, reserved) == offsetof(cairn_fleet_step, reserved) && sizeof(FleetStep::reserved) == sizeof(cairn_fleet_step::reserved));
static_assert(offsetof(FleetStep, number) == offsetof(cairn_fleet_step, number) && sizeof(FleetStep::number) == sizeof(cairn_fleet_step::number));
static_assert(offsetof(FleetStep, time) == offsetof(cairn_fleet_step, time) && sizeof(FleetStep::time) == sizeof(cairn_fleet_step::time));
static_assert(offsetof(FleetStep, dt) == offsetof(cairn_fleet_step, dt) && sizeof(FleetStep::dt) == sizeof(cairn_fleet_step::dt));
static_assert(offsetof(FleetStep, vehicle_count) == offsetof(cairn_fleet_step, vehicle_count) && sizeof(FleetStep::vehicle_count) == sizeof(cairn_fleet_step::vehicle_count));

}  // namespace cairn
// clang-format on

#endif
