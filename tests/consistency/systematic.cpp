// SPDX-License-Identifier: BSD-3-Clause
// Monte Carlo test of systematic errors as states (docs/systematic_errors.md): a rover whose velocity, rate, wheels and
// head are wrong, in worlds of libcairn_sim. The errors of each world are drawn from the filter's prior. The same
// worlds without errors, and a filter that does not know about them, run beside it.
//
// The NEES of the pose, averaged over the worlds, has to lie in its 95 % band at most times, and the error must not be
// much larger than that of a rover without errors.
//
// A turned mount is a turn of the whole map about the first pose, as long as velocity and rate are constant: biases
// take up the rest. So the error has two figures. The second is that of T_k' = (T_0 E)^-1 T_k E, the pose as the sensor
// sees it, relative to its first one, with the turn E of the mount. The turn of the map is not in it.
#include <cairn/cairn.h>
#include <cairn/sim.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "tracker.hpp"

namespace {

using consistency::kTwoSided95;
using consistency::quantile;

constexpr double kDegree = 3.14159265358979323846 / 180;
// Standard deviations of the errors, which are the filter's priors, too.
constexpr double kVelocity = 0.15, kRate = 2e-3, kScale = 0.02, kTurn = 1.0 * kDegree;

struct Options {
  int runs = 50, seed = 1;
  bool wheels = false;       // wheels and gyro instead of velocity and rate
  bool known_mount = false;  // the mount is not turned and is no state
  double check = 0;          // bound of the ratio to a rover without errors; 0: no check
  int32_t preset = CAIRN_PRESET_ROW2;
  double laps = 0;          // 0: that of the preset
  double camera_noise = 1;  // times that of the preset
  double rate = kRate, velocity = kVelocity;
};

struct Variant {
  const char* name;
  bool wrong, knows;  // the rover has errors; the filter estimates them
  uint32_t submap_landmarks;
  int32_t join;
};
constexpr Variant kVariants[] = {{"clean, single map", false, false, 0, CAIRN_JOIN_AUTO},
                                 {"clean, submaps of 40", false, false, 40, CAIRN_JOIN_SPARSE},
                                 {"errors ignored", true, false, 0, CAIRN_JOIN_AUTO},
                                 {"errors as states, single map", true, true, 0, CAIRN_JOIN_AUTO},
                                 {"errors as states, dense submaps of 40", true, true, 40, CAIRN_JOIN_DENSE},
                                 {"errors as states, sparse submaps of 40", true, true, 40, CAIRN_JOIN_SPARSE}};

struct Score {
  std::vector<double> nees;  // by step, summed over the runs
  double squares = 0.0, sensor_squares = 0.0;
  long steps = 0;
};

cairn_world_options world_of(const Options& o, int seed) {
  cairn_world_options w;
  CHECK(cairn_world_options_init(&w, sizeof w));
  CHECK(cairn_world_options_preset(&w, o.preset, nullptr));
  w.seed = static_cast<uint64_t>(seed);
  if (o.wheels) w.drive = CAIRN_DRIVE_WHEELS_GYRO;
  if (o.laps > 0) w.laps = o.laps;
  for (double* sigma : {&w.range_sigma, &w.azimuth_sigma, &w.stick_sigma, &w.image_sigma}) *sigma *= o.camera_noise;
  return w;
}

void draw_errors(const Options& o, int seed, cairn_world_options& w) {
  consistency::Random random(static_cast<unsigned long long>(seed) * 7919 + 17);
  for (int i = 0; i < 3; ++i) {
    const double velocity = random.normal(o.velocity), rate = random.normal(o.rate), turn = random.normal(kTurn);
    if (!o.wheels || i == 0) w.velocity_bias[i] = velocity;  // wheels measure no velocity to the side
    w.rate_bias[i] = rate;
    if (!o.known_mount) w.mount_turn[i] = turn;
  }
  for (double& scale : w.wheel_scale) scale = o.wheels ? random.normal(kScale) : 0.0;
}

cairn_filter* filter_of(const Options& o, const Variant& variant, const cairn_world* world, int32_t& sensor) {
  cairn_filter_options f;
  CHECK(cairn_filter_options_init(&f, sizeof f));
  f.max_landmarks = 400;
  f.max_observations = 64;
  f.gate_probability = f.batch_gate_probability = 1;
  f.submap_landmarks = variant.submap_landmarks;
  f.join = variant.join;
  CHECK(cairn_world_pose(world, 0, &f.initial_pose));
  if (variant.knows) {
    for (int i = 0; i < 3; ++i) f.rate_bias_sigma[i] = o.rate;
    for (int i = 0; i < (o.wheels ? 1 : 3); ++i) f.velocity_bias_sigma[i] = o.velocity;
    for (double& sigma : f.wheel_scale_sigma) sigma = o.wheels ? kScale : 0.0;
    f.max_sensor_errors = 3;
  }
  cairn_filter* filter = nullptr;
  CHECK(cairn_filter_create(&f, &filter));
  cairn_stereo_head head;
  CHECK(cairn_stereo_head_init(&head, sizeof head));
  CHECK(cairn_world_head(world, &head));
  CHECK(cairn_filter_add_stereo_head(filter, &head, &sensor));
  cairn_wheels wheels;
  CHECK(cairn_wheels_init(&wheels, sizeof wheels));
  CHECK(cairn_world_wheels(world, &wheels));
  CHECK(cairn_filter_set_wheels(filter, &wheels));
  if (variant.knows && !o.known_mount) {
    cairn_calibration calibration;
    CHECK(cairn_calibration_init(&calibration, sizeof calibration));
    std::fill_n(calibration.mount_turn_sigma, 3, kTurn);
    CHECK(cairn_filter_calibrate_sensor(filter, sensor, &calibration));
  }
  return filter;
}

// (T_0 E)^-1 T E with E = Exp(turn).
cairn_pose seen_by_sensor(const cairn_pose& first, const cairn_pose& pose, const double turn[3]) {
  cairn_pose mount = {{0, 0, 0}, {1, 0, 0, 0}}, from, back, result;
  CHECK(cairn_quaternion_exp(turn, mount.quaternion));
  CHECK(cairn_pose_compose(&first, &mount, &from));
  CHECK(cairn_pose_inverse(&from, &back));
  CHECK(cairn_pose_compose(&back, &pose, &from));
  CHECK(cairn_pose_compose(&from, &mount, &result));
  return result;
}

void estimated_turn(const cairn_filter* filter, double turn[3]) {
  cairn_systematic_error errors[16];
  size_t count = 0;
  CHECK(cairn_filter_systematic_errors(filter, errors, nullptr, 16, &count));
  std::fill_n(turn, 3, 0.0);
  for (size_t i = 0; i < count; ++i)
    if (errors[i].kind == CAIRN_SYSTEMATIC_MOUNT_TURN) turn[errors[i].component] = errors[i].value;
}

void run(const Options& o, const Variant& variant, int seed, Score& score) {
  cairn_world_options w = world_of(o, seed);
  if (variant.wrong) draw_errors(o, seed, w);
  cairn_world* world = nullptr;
  CHECK(cairn_world_create(&w, &world));
  int32_t sensor = -1;
  cairn_filter* filter = filter_of(o, variant, world, sensor);
  std::size_t steps = 0;
  cairn_pose first;
  CHECK(cairn_world_pose(world, 0, &first));
  CHECK(cairn_world_steps(world, &steps));
  score.nees.resize(steps, 0.0);
  for (std::size_t k = 0; k < steps; ++k) {
    cairn_world_step step;
    step.struct_size = sizeof step;
    CHECK(cairn_world_next(world, &step));
    cairn_twist_noise noise;
    CHECK(cairn_twist_noise_init(&noise, sizeof noise));
    std::copy_n(step.velocity_sigma, 3, noise.velocity_sigma);
    std::copy_n(step.rate_sigma, 3, noise.rate_sigma);
    CHECK(cairn_filter_set_twist_noise(filter, &noise));
    for (std::size_t i = 0; i < step.motion_count; ++i) {
      const cairn_world_motion& m = step.motions[i];
      if (o.wheels)
        CHECK(cairn_filter_predict_wheels_gyro(filter, m.dt, m.wheels[0], m.wheels[1], m.rate));
      else
        CHECK(cairn_filter_predict_twist(filter, m.dt, m.velocity, m.rate));
    }
    if (step.observation_count > 0)
      CHECK(cairn_filter_update(filter, sensor, step.observations, step.observation_count, nullptr));
    if (k == 0) continue;
    double nees = 0, error[6];
    cairn_pose pose;
    CHECK(cairn_filter_pose_nees(filter, &step.truth, &nees));
    CHECK(cairn_filter_pose(filter, &pose, nullptr));
    CHECK(cairn_pose_error(&step.truth, &pose, error));
    score.nees[k] += nees;
    score.squares += error[0] * error[0] + error[1] * error[1] + error[2] * error[2];
    double turn[3];
    estimated_turn(filter, turn);
    const cairn_pose truth = seen_by_sensor(first, step.truth, w.mount_turn);
    const cairn_pose estimate = seen_by_sensor(first, pose, turn);
    CHECK(cairn_pose_error(&truth, &estimate, error));
    score.sensor_squares += error[0] * error[0] + error[1] * error[1] + error[2] * error[2];
    ++score.steps;
  }
  cairn_filter_destroy(filter);
  cairn_world_destroy(world);
}

Options read(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    if (i + 1 < argc && std::strcmp(argv[i], "--check") == 0) {
      o.check = std::atof(argv[++i]);
    } else if (std::strcmp(argv[i], "--wheels") == 0) {
      o.wheels = true;
    } else if (std::strcmp(argv[i], "--known-mount") == 0) {
      o.known_mount = true;
    } else if (i + 1 < argc && std::strcmp(argv[i], "--runs") == 0) {
      o.runs = std::max(1, std::atoi(argv[++i]));
    } else if (i + 1 < argc && std::strcmp(argv[i], "--preset") == 0) {
      o.preset = std::atoi(argv[++i]);
    } else if (i + 1 < argc && std::strcmp(argv[i], "--laps") == 0) {
      o.laps = std::atof(argv[++i]);
    } else if (i + 1 < argc && std::strcmp(argv[i], "--camera-noise") == 0) {
      o.camera_noise = std::atof(argv[++i]);
    } else if (i + 1 < argc && std::strcmp(argv[i], "--rate-bias") == 0) {
      o.rate = std::atof(argv[++i]);
    } else if (i + 1 < argc && std::strcmp(argv[i], "--velocity-bias") == 0) {
      o.velocity = std::atof(argv[++i]);
    } else if (i + 1 < argc && std::strcmp(argv[i], "--seed") == 0) {
      o.seed = std::atoi(argv[++i]);
    } else {
      std::fprintf(stderr,
                   "usage: %s [--wheels] [--known-mount] [--rate-bias R] [--velocity-bias V] [--preset N] [--laps N] "
                   "[--camera-noise TIMES] [--runs N] [--seed N] [--check RATIO]\n",
                   argv[0]);
      std::exit(2);
    }
  }
  return o;
}

}  // namespace

int main(int argc, char** argv) {
  const Options o = read(argc, argv);
  std::printf("%d worlds, %s\n", o.runs, o.wheels ? "wheels and gyro" : "velocity and rate");
  double clean = 0.0, clean_sensor = 0.0, ignored = 0.0;
  bool good = true;
  for (const Variant& variant : kVariants) {
    Score score;
    for (int run_number = 0; run_number < o.runs; ++run_number) run(o, variant, o.seed + run_number, score);
    const double dof = 6.0 * o.runs;
    long inside = 0, counted = 0;
    double sum = 0.0;
    for (std::size_t k = 1; k < score.nees.size(); ++k) {
      ++counted;
      sum += score.nees[k] / dof;
      if (score.nees[k] >= quantile(dof, -kTwoSided95) && score.nees[k] <= quantile(dof, kTwoSided95)) ++inside;
    }
    const double rmse = std::sqrt(score.squares / static_cast<double>(score.steps));
    const double share = static_cast<double>(inside) / static_cast<double>(counted);
    const double sensor = std::sqrt(score.sensor_squares / static_cast<double>(score.steps));
    if (clean == 0.0) clean = rmse, clean_sensor = sensor;
    std::printf(
        "%-40s pose RMSE %.3f m, ratio %.2f, as the sensor sees it %.3f m, ratio %.2f, ANEES/6 %.2f, in band "
        "%.0f %%\n",
        variant.name, rmse, rmse / clean, sensor, sensor / clean_sensor, sum / static_cast<double>(counted),
        100 * share);
    if (variant.wrong && !variant.knows) ignored = rmse;
    // A short run has a wide band, but few worlds: its share of times varies more. To know the errors has to be worth
    // much: a third of the error without states at most.
    if (o.check > 0 && variant.knows &&
        !(rmse <= o.check * clean && rmse <= ignored / 3 && share >= (o.runs < 50 ? 0.75 : 0.90))) {
      std::fprintf(stderr, "FAILED: %s\n", variant.name);
      good = false;
    }
  }
  return good ? 0 : 1;
}
