// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/csv_output.hpp"

#include <algorithm>
#include <cmath>

#include "program/library.hpp"

namespace cairn::program {
namespace {

constexpr const char* kTrajectoryHeader =
    "step,t_s,x_m,y_m,z_m,qw,qx,qy,qz,roll_rad,pitch_rad,yaw_rad,"
    "true_x_m,true_y_m,true_z_m,true_qw,true_qx,true_qy,true_qz,true_roll_rad,true_pitch_rad,true_yaw_rad,"
    "error_x_m,error_y_m,error_z_m,error_dtheta_x_rad,error_dtheta_y_rad,error_dtheta_z_rad,"
    "sigma3_x_m,sigma3_y_m,sigma3_z_m,sigma3_dtheta_x_rad,sigma3_dtheta_y_rad,sigma3_dtheta_z_rad,nees,"
    "local_sigma_x_m,local_sigma_y_m,local_sigma_z_m,local_sigma_dtheta_x_rad,local_sigma_dtheta_y_rad,"
    "local_sigma_dtheta_z_rad\n";
constexpr const char* kInnovationsHeader = "step,id,result,reason,distance,threshold\n";
constexpr const char* kTimingHeader =
    "step,step_ms,landmarks,observations,nis,nis_rows,nis_lower,nis_upper,filter_landmarks,closing_ms\n";
constexpr const char* kLandmarksHeader =
    "id,x_m,y_m,z_m,cov_xx_m2,cov_xy_m2,cov_xz_m2,cov_yy_m2,cov_yz_m2,cov_zz_m2,observations,"
    "true_x_m,true_y_m,true_z_m,error_x_m,error_y_m,error_z_m,sigma3_x_m,sigma3_y_m,sigma3_z_m\n";
constexpr const char* kSubmapsHeader =
    "submap,step,reason,landmarks,new,fused,refused,seconds,moved_max_m,x,y,z,qw,qx,qy,qz\n";
constexpr int kTerrainCells = 200;     // of the longer side
constexpr double kTerrainMargin = 10;  // m

const char* result_name(std::int32_t result) {
  switch (result) {
    case CAIRN_RESULT_MATCHED:
      return "matched";
    case CAIRN_RESULT_NEW:
      return "new";
    case CAIRN_RESULT_REJECTED:
      return "rejected";
    default:
      return "unknown";
  }
}

const char* reason_name(std::int32_t reason) {
  switch (reason) {
    case CAIRN_REASON_NONE:
      return "none";
    case CAIRN_REASON_GATE:
      return "gate";
    case CAIRN_REASON_BATCH_GATE:
      return "batch_gate";
    case CAIRN_REASON_NO_IMAGE:
      return "no_image";
    case CAIRN_REASON_NO_PLACE:
      return "no_place";
    case CAIRN_REASON_AMBIGUOUS:
      return "ambiguous";
    case CAIRN_REASON_NO_ROOM:
      return "no_room";
    case CAIRN_REASON_CONTRADICTED:
      return "contradicted";
    default:
      return "unknown";
  }
}

const char* closing_name(std::int32_t reason) {
  switch (reason) {
    case CAIRN_CLOSED_BY_CALLER:
      return "caller";
    case CAIRN_CLOSED_BY_LANDMARKS:
      return "landmarks";
    case CAIRN_CLOSED_BY_DISTANCE:
      return "distance";
    case CAIRN_CLOSED_BY_EXTENT:
      return "extent";
    case CAIRN_CLOSED_BY_SIGMA:
      return "sigma";
    case CAIRN_CLOSED_BY_FIX:
      return "fix";
    default:
      return "unknown";
  }
}

double sigma3(double variance) {
  return 3 * std::sqrt(std::max(variance, 0.0));
}

void write_pose(OutputFile& file, const cairn_pose& pose) {
  double euler[3] = {};
  cairn_quaternion_to_euler(pose.quaternion, &euler[0], &euler[1], &euler[2], nullptr);
  file.fields(pose.position, 3);
  file.fields(pose.quaternion, 4);
  file.fields(euler, 3);
}

// Members are made in order: the folder is created before the first file.
const std::string& created(const std::string& folder) {
  create_folder(folder);
  return folder;
}

}  // namespace

CsvOutput::CsvOutput(const Drive& drive, const std::string& folder)
    : drive_(drive),
      folder_(created(folder)),
      trajectory_(folder, "trajectory.csv"),
      innovations_(folder, "innovations.csv"),
      timing_(folder, "timing.csv"),
      health_(folder) {
  trajectory_.text(kTrajectoryHeader);
  innovations_.text(kInnovationsHeader);
  timing_.text(kTimingHeader);
}

void CsvOutput::add(const DriveStep& step, const StepResult& result, const std::optional<PoseScore>& score) {
  add_trajectory(step, result, score);
  add_innovations(step, result);
  add_timing(step, result);
  health_.add(step, result);
  if (result.closing) closed_.push_back({step.number, *result.closing});
  last_step_ = step.number;
}

void CsvOutput::add_trajectory(const DriveStep& step, const StepResult& result, const std::optional<PoseScore>& score) {
  trajectory_.field(step.number);
  trajectory_.field(step.time);
  write_pose(trajectory_, result.pose);
  if (score) {
    write_pose(trajectory_, *step.truth);
    trajectory_.fields(score->error, 6);
  } else {
    trajectory_.empty(16);
  }
  for (int i = 0; i < 6; ++i) trajectory_.field(sigma3(result.covariance[i * 7]));
  if (score && score->nees) {
    trajectory_.field(*score->nees);
  } else {
    trajectory_.empty(1);
  }
  for (int i = 0; i < 6; ++i) trajectory_.field(std::sqrt(std::max(result.local_covariance[i * 7], 0.0)));
  trajectory_.end();
}

void CsvOutput::add_innovations(const DriveStep& step, const StepResult& result) {
  for (std::size_t i = 0; i < result.matches.size(); ++i) {
    const cairn_match& match = result.matches[i];
    innovations_.field(step.number);
    innovations_.field(step.observations[i].id);
    innovations_.field(result_name(match.result));
    innovations_.field(reason_name(match.reason));
    innovations_.field(match.distance);
    innovations_.field(match.threshold);
    innovations_.end();
  }
}

void CsvOutput::add_timing(const DriveStep& step, const StepResult& result) {
  timing_.field(step.number);
  timing_.field(1e3 * result.seconds);
  timing_.field(std::uint64_t{result.landmarks});
  timing_.field(std::uint64_t{result.matches.size()});
  timing_.field(result.report.nis);
  timing_.field(std::uint64_t{result.report.rows});
  timing_.field(result.report.nis_lower);
  timing_.field(result.report.nis_upper);
  timing_.field(std::uint64_t{result.filter_landmarks});
  if (result.closing) {
    timing_.field(1e3 * result.closing->seconds);
  } else {
    timing_.empty(1);
  }
  timing_.end();
}

void CsvOutput::finish(const cairn_filter* filter, const std::optional<cairn_closing_report>& last_closing,
                       const Summary& summary) {
  trajectory_.close();
  innovations_.close();
  timing_.close();
  health_.close();
  if (last_closing) closed_.push_back({last_step_, *last_closing});
  write_landmarks(filter, summary);
  write_submaps(filter);
  if (drive_.world() != nullptr) write_terrain(drive_.world());
  OutputFile file(folder_, "summary.json");
  file.text(json(summary.figures()) + "\n");
  file.close();
}

void CsvOutput::write_landmarks(const cairn_filter* filter, const Summary& summary) {
  OutputFile file(folder_, "landmarks.csv");
  file.text(kLandmarksHeader);
  for (const cairn_landmark& landmark : map_landmarks(filter)) {
    const double* covariance = landmark.covariance;
    file.field(landmark.id);
    file.fields(landmark.position, 3);
    for (const int index : {0, 1, 2, 4, 5, 8}) file.field(covariance[index]);
    file.field(landmark.observations);
    double truth[3];
    if (drive_.true_landmark(summary.name_of(landmark.id), truth)) {
      file.fields(truth, 3);
      for (std::size_t i = 0; i < 3; ++i) file.field(truth[i] - landmark.position[i]);
    } else {
      file.empty(6);
    }
    for (int i = 0; i < 3; ++i) file.field(sigma3(covariance[i * 4]));
    file.end();
  }
  file.close();
}

void CsvOutput::write_submaps(const cairn_filter* filter) {
  OutputFile submaps(folder_, "submaps.csv"), members(folder_, "submap_landmarks.csv");
  submaps.text(kSubmapsHeader);
  members.text("submap,id\n");
  std::vector<std::uint64_t> ids;
  for (std::size_t i = 0; i < closed_.size(); ++i) {
    const cairn_closing_report& report = closed_[i].report;
    cairn_pose base;
    std::size_t count = 0;
    check(cairn_filter_submap(filter, i, &base, nullptr, 0, &count, nullptr));
    ids.resize(count);
    check(cairn_filter_submap(filter, i, &base, ids.data(), count, &count, nullptr));
    submaps.field(std::uint64_t{i});
    submaps.field(closed_[i].step);
    submaps.field(closing_name(report.reason));
    for (const std::uint32_t number :
         {report.landmarks, report.landmarks_new, report.landmarks_fused, report.landmarks_refused}) {
      submaps.field(std::uint64_t{number});
    }
    submaps.field(report.seconds);
    submaps.field(report.moved_max);
    submaps.fields(base.position, 3);
    submaps.fields(base.quaternion, 4);
    submaps.end();
    for (const std::uint64_t id : ids) {
      members.field(std::uint64_t{i});
      members.field(id);
      members.end();
    }
  }
  submaps.close();
  members.close();
}

void CsvOutput::write_terrain(const cairn_world* world) {
  double lower[2], upper[2];
  check_sim(cairn_world_extent(world, lower, upper, nullptr));
  for (int i = 0; i < 2; ++i) {
    lower[i] -= kTerrainMargin;
    upper[i] += kTerrainMargin;
  }
  const double cell = std::max(upper[0] - lower[0], upper[1] - lower[1]) / kTerrainCells;
  const int columns = static_cast<int>(std::ceil((upper[0] - lower[0]) / cell));
  const int rows = static_cast<int>(std::ceil((upper[1] - lower[1]) / cell));
  OutputFile file(folder_, "terrain.csv");
  file.text("x,y,z\n");
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      double point[3] = {lower[0] + column * cell, lower[1] + row * cell, 0};
      check_sim(cairn_world_height(world, point[0], point[1], &point[2], nullptr));
      file.fields(point, 3);
      file.end();
    }
  }
  file.close();
}

}  // namespace cairn::program
