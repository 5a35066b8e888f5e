// SPDX-License-Identifier: BSD-3-Clause
// Monte Carlo test of systematic errors as states (docs/systematic_errors.md): a rover whose velocity, rate, wheels and
// head are wrong, in worlds of libcairn_sim. The errors of each world are drawn from the filter's prior. The same
// worlds without errors, and a filter that does not know about them, run beside it.
//
// The NEES of the pose, averaged over the worlds, has to lie in its 95 % band at most times, and the error must not be
// much larger than that of a rover without errors.
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
  bool wheels = false;  // wheels and gyro instead of velocity and rate
  bool check = false;
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
  double squares = 0.0;
  long steps = 0;
};

cairn_world_options world_of(const Options& o, int seed) {
  cairn_world_options w;
  CHECK(cairn_world_options_init(&w, sizeof w));
  CHECK(cairn_world_options_preset(&w, CAIRN_PRESET_ROW2, nullptr));
  w.seed = static_cast<uint64_t>(seed);
  if (o.wheels) w.drive = CAIRN_DRIVE_WHEELS_GYRO;
  return w;
}

void draw_errors(const Options& o, int seed, cairn_world_options& w) {
  consistency::Random random(static_cast<unsigned long long>(seed) * 7919 + 17);
  for (int i = 0; i < 3; ++i) {
    const double velocity = random.normal(kVelocity), rate = random.normal(kRate), turn = random.normal(kTurn);
    if (!o.wheels || i == 0) w.velocity_bias[i] = velocity;  // wheels measure no velocity to the side
    w.rate_bias[i] = rate;
    w.mount_turn[i] = turn;
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
    for (int i = 0; i < 3; ++i) f.rate_bias_sigma[i] = kRate;
    for (int i = 0; i < (o.wheels ? 1 : 3); ++i) f.velocity_bias_sigma[i] = kVelocity;
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
  if (variant.knows) {
    cairn_calibration calibration;
    CHECK(cairn_calibration_init(&calibration, sizeof calibration));
    std::fill_n(calibration.mount_turn_sigma, 3, kTurn);
    CHECK(cairn_filter_calibrate_sensor(filter, sensor, &calibration));
  }
  return filter;
}

void run(const Options& o, const Variant& variant, int seed, Score& score) {
  cairn_world_options w = world_of(o, seed);
  if (variant.wrong) draw_errors(o, seed, w);
  cairn_world* world = nullptr;
  CHECK(cairn_world_create(&w, &world));
  int32_t sensor = -1;
  cairn_filter* filter = filter_of(o, variant, world, sensor);
  std::size_t steps = 0;
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
    ++score.steps;
  }
  cairn_filter_destroy(filter);
  cairn_world_destroy(world);
}

Options read(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--check") == 0) {
      o.check = true;
    } else if (std::strcmp(argv[i], "--wheels") == 0) {
      o.wheels = true;
    } else if (i + 1 < argc && std::strcmp(argv[i], "--runs") == 0) {
      o.runs = std::max(1, std::atoi(argv[++i]));
    } else if (i + 1 < argc && std::strcmp(argv[i], "--seed") == 0) {
      o.seed = std::atoi(argv[++i]);
    } else {
      std::fprintf(stderr, "usage: %s [--wheels] [--runs N] [--seed N] [--check]\n", argv[0]);
      std::exit(2);
    }
  }
  return o;
}

}  // namespace

int main(int argc, char** argv) {
  const Options o = read(argc, argv);
  std::printf("%d worlds, %s\n", o.runs, o.wheels ? "wheels and gyro" : "velocity and rate");
  double clean = 0.0;
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
    if (clean == 0.0) clean = rmse;
    std::printf("%-40s pose RMSE %.3f m, ratio %.2f, ANEES/6 %.2f, in band %.0f %%\n", variant.name, rmse, rmse / clean,
                sum / static_cast<double>(counted), 100 * share);
    // A short run has a wide band, but few worlds: its share of times varies more.
    if (o.check && variant.knows && !(rmse <= 1.5 * clean && share >= (o.runs < 50 ? 0.75 : 0.90))) {
      std::fprintf(stderr, "FAILED: %s\n", variant.name);
      good = false;
    }
  }
  return good ? 0 : 1;
}
