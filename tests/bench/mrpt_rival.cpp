// SPDX-License-Identifier: BSD-3-Clause
// Runs MRPT's range-bearing EKF-SLAM (CRangeBearingKFSLAM: position, quaternion, 3-D landmarks) over a neutral log,
// with the landmarks' ids known to it and the noise that the log was drawn with, and prints one line of JSON.
//
//   mrpt_rival LOG [--second-half-samples K]
//
// MRPT does not move the vehicle before it has a landmark, so the log should have observations at step 0. K ends the
// run after K steps of the second half. The errors are then those up to this step, and the JSON line says so.
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/slam/CRangeBearingKFSLAM.h>
#include <mrpt/version.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>

#include "log.hpp"
#include "samples.hpp"

namespace {

using bench::Noise;
using mrpt::poses::CPose3D;

CPose3D pose_of(const bench::Vector6& p) {
  return {p[0], p[1], p[2], p[5], p[4], p[3]};
}

// Step 0 has no increment: the vehicle has not moved, and this is known.
mrpt::obs::CActionCollection::Ptr action_of(const bench::Step& step) {
  mrpt::obs::CActionRobotMovement3D motion;
  motion.estimationMethod = mrpt::obs::CActionRobotMovement3D::emOdometry;
  motion.poseChange.cov.setZero();
  if (step.increment) {
    motion.poseChange.mean = pose_of(*step.increment);
    for (int i = 0; i < 6; ++i) {  // x y z yaw pitch roll
      const double sigma = i < 3 ? Noise::kIncrementMetres : Noise::kIncrementRadians;
      motion.poseChange.cov(i, i) = sigma * sigma;
    }
  }
  motion.rawOdometryIncrementReading = motion.poseChange.mean;
  auto actions = mrpt::obs::CActionCollection::Create();
  actions->insert(motion);
  return actions;
}

// The field of view of the sensor, estimated from the log. MRPT predicts only landmarks in this cone, and repeats a
// part of its work, with a warning, for a landmark that is seen outside.
struct Cone {
  explicit Cone(const bench::Log& log) {
    for (const bench::Step& step : log.steps) {
      for (const bench::Sighting& sighting : step.sightings) {
        range = std::max(range, sighting.z[0]);
        yaw = std::max(yaw, 2.0 * std::abs(sighting.z[1]));
        pitch = std::max(pitch, 2.0 * std::abs(sighting.z[2]));
      }
    }
  }
  double range = 0.0, yaw = 0.0, pitch = 0.0;
};

mrpt::obs::CSensoryFrame::Ptr frame_of(const bench::Step& step, const Cone& cone) {
  auto observation = mrpt::obs::CObservationBearingRange::Create();
  observation->maxSensorDistance = static_cast<float>(cone.range);
  observation->fieldOfView_yaw = static_cast<float>(cone.yaw);
  observation->fieldOfView_pitch = static_cast<float>(cone.pitch);
  observation->sensor_std_range = static_cast<float>(Noise::kRange);
  observation->sensor_std_yaw = observation->sensor_std_pitch = static_cast<float>(Noise::kAngle);
  for (const bench::Sighting& sighting : step.sightings) {
    mrpt::obs::CObservationBearingRange::TMeasurement z;
    z.range = static_cast<float>(sighting.z[0]);
    z.yaw = static_cast<float>(sighting.z[1]);
    z.pitch = static_cast<float>(-sighting.z[2]);  // MRPT's pitch is positive downwards
    z.landmarkID = static_cast<int32_t>(sighting.id);
    z.covariance.setZero();
    observation->sensedData.push_back(z);
  }
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(observation);
  return frame;
}

struct Result {
  bench::Samples times;
  bench::SquaredError pose;
  std::size_t steps = 0, landmarks = 0;
  double landmark_rmse = 0.0;
};

// MRPT starts at the identity with a known pose: its map is in the frame of the first true pose of the log.
double landmark_rmse(const mrpt::slam::CRangeBearingKFSLAM& slam, const CPose3D& start, const bench::Log& log,
                     std::size_t* count) {
  mrpt::poses::CPose3DQuatPDFGaussian pose;
  std::vector<mrpt::math::TPoint3D> points;
  std::map<unsigned int, mrpt::maps::CLandmark::TLandmarkID> ids;
  mrpt::math::CVectorDouble state;
  mrpt::math::CMatrixDouble covariance;
  slam.getCurrentState(pose, points, ids, state, covariance);
  bench::SquaredError error;
  *count = points.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto truth = log.landmarks.find(static_cast<std::uint64_t>(ids.at(static_cast<unsigned>(i))));
    if (truth == log.landmarks.end()) continue;
    error.add(start.composePoint(points[i]), truth->second);
  }
  return error.rms();
}

Result run(const bench::Log& log, std::size_t second_half_samples) {
  mrpt::slam::CRangeBearingKFSLAM slam;
  slam.options.std_sensor_range = static_cast<float>(Noise::kRange);
  slam.options.std_sensor_yaw = slam.options.std_sensor_pitch = static_cast<float>(Noise::kAngle);
  slam.setMinLoggingLevel(mrpt::system::LVL_ERROR);
  const CPose3D start = pose_of(log.steps.front().truth);
  const Cone cone(log);
  Result result;
  for (std::size_t k = 0; k < log.steps.size() && result.times.size() < second_half_samples; ++k) {
    const bench::Step& step = log.steps[k];
    auto action = action_of(step);
    auto frame = frame_of(step, cone);
    const bench::Stopwatch watch;
    slam.processActionObservation(action, frame);
    if (2 * k >= log.steps.size()) result.times.add(watch.milliseconds());
    const CPose3D pose = start + CPose3D(slam.getCurrentRobotPoseMean());
    result.pose.add(std::array<double, 3>{pose.x(), pose.y(), pose.z()}, step.truth);
    ++result.steps;
  }
  result.landmark_rmse = landmark_rmse(slam, start, log, &result.landmarks);
  return result;
}

}  // namespace

int main(int argc, char** argv) try {
  std::size_t samples = SIZE_MAX;
  const bool limited = argc == 4 && std::strcmp(argv[2], "--second-half-samples") == 0;
  if (limited) samples = std::strtoul(argv[3], nullptr, 10);
  if ((argc != 2 && !limited) || samples == 0) {
    std::fprintf(stderr, "usage: mrpt_rival LOG [--second-half-samples K]\n");
    return 2;
  }
  const bench::Log log = bench::read_log(argv[1]);
  const Result result = run(log, samples);
  std::printf("{\"program\": \"MRPT %x.%x.%x\", \"steps\": %zu, \"whole_log\": %s, \"landmarks\": %zu, ",
              MRPT_VERSION >> 8, MRPT_VERSION >> 4 & 15, MRPT_VERSION & 15, result.steps,
              result.steps == log.steps.size() ? "true" : "false", result.landmarks);
  std::printf("\"samples\": %zu, \"step_ms_mean\": %.6g, \"step_ms_median\": %.6g, ", result.times.size(),
              result.times.mean(), result.times.median());
  std::printf("\"pose_rmse_m\": %.6g, \"landmark_rmse_m\": %.6g}\n", result.pose.rms(), result.landmark_rmse);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "mrpt_rival: %s\n", error.what());
  return 2;
}
