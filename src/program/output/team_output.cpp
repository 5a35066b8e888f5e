// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/team_output.hpp"

#include <cmath>
#include <limits>

#include "program/output/tool_files.hpp"

namespace cairn::program {
namespace {

double heading_of(const cairn_pose& pose) {
  return 2 * std::atan2(pose.quaternion[3], pose.quaternion[0]);
}

const std::string& made(const std::string& folder) {
  create_folder(folder);
  return folder;
}

}  // namespace

TeamOutput::TeamOutput(const TeamDrive& drive, std::int32_t mode, const OutputPlace& place)
    : drive_(drive),
      place_(place),
      trajectories_(made(place.folder), "team_trajectories.csv"),
      of_vehicles_(drive.vehicles().size()) {
  trajectories_.text("step,time,vehicle,x,y,heading,sigma3_x,sigma3_y,sigma3_heading,true_x,true_y,true_heading\n");
  steps_.begin_run(drive.landmarks(), mode, drive.vehicles());
}

void TeamOutput::begin_alone() {
  steps_.begin_run(drive_.landmarks(), CAIRN_TEAM_MONO, drive_.vehicles());
}

void TeamOutput::add_alone(const TeamStep& step, const std::vector<VehicleEstimate>& estimates) {
  steps_.add(step.time, estimates);
}

void TeamOutput::add(const TeamStep& step, const std::vector<VehicleEstimate>& estimates) {
  for (std::size_t v = 0; v < estimates.size(); ++v) {
    const VehicleEstimate& own = estimates[v];
    trajectories_.field(step_);
    trajectories_.field(step.time);
    trajectories_.field(drive_.vehicles()[v]);
    const double values[] = {own.pose.position[0],
                             own.pose.position[1],
                             std::remainder(heading_of(own.pose), 2 * 3.14159265358979323846),
                             3 * std::sqrt(own.covariance[0]),
                             3 * std::sqrt(own.covariance[7]),
                             3 * std::sqrt(own.covariance[35])};
    trajectories_.fields(values, 6);
    if (step.vehicles[v].truth) {
      const cairn_pose& truth = *step.vehicles[v].truth;
      const double true_values[] = {truth.position[0], truth.position[1],
                                    std::remainder(heading_of(truth), 2 * 3.14159265358979323846)};
      trajectories_.fields(true_values, 3);
    } else {
      trajectories_.empty(3);
    }
    trajectories_.end();
    of_vehicles_[v].add(step.time, step_, own.pose, step.vehicles[v].truth);
  }
  steps_.add(step.time, estimates);
  ++step_;
}

void TeamOutput::finish(const TeamRunner& runner, const std::vector<Figure>& figures) {
  trajectories_.close();
  steps_.write(place_.folder);
  OutputFile landmarks(place_.folder, "team_landmarks.csv");
  landmarks.text("vehicle,id,x,y,sigma3_x,sigma3_y,cov_xy,observations,true_x,true_y\n");
  for (std::size_t v = 0; v < drive_.vehicles().size(); ++v) {
    const std::vector<cairn_landmark> map = runner.map(v);
    write_tool_files(place_, "vehicle_" + std::to_string(drive_.vehicles()[v]) + "_", map, of_vehicles_[v]);
    for (const cairn_landmark& landmark : map) {
      landmarks.field(drive_.vehicles()[v]);
      landmarks.field(landmark.id);
      const double values[] = {landmark.position[0], landmark.position[1], 3 * std::sqrt(landmark.covariance[0]),
                               3 * std::sqrt(landmark.covariance[4]), landmark.covariance[1]};
      landmarks.fields(values, 5);
      landmarks.field(landmark.observations);
      double truth[2];
      if (drive_.true_landmark(landmark.id, truth))
        landmarks.fields(truth, 2);
      else
        landmarks.empty(2);
      landmarks.end();
    }
  }
  landmarks.close();
  OutputFile summary(place_.folder, "summary.json");
  summary.text(json(figures) + "\n");
  summary.close();
}

}  // namespace cairn::program
