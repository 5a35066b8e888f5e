// SPDX-License-Identifier: BSD-3-Clause
#include "cli/csv_output.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

namespace cairn::cli {
namespace {

constexpr const char* kTrajectoryHeader =
    "step,t_s,x_m,y_m,z_m,qw,qx,qy,qz,roll_rad,pitch_rad,yaw_rad,"
    "true_x_m,true_y_m,true_z_m,true_qw,true_qx,true_qy,true_qz,true_roll_rad,true_pitch_rad,true_yaw_rad,"
    "error_x_m,error_y_m,error_z_m,error_dtheta_x_rad,error_dtheta_y_rad,error_dtheta_z_rad,"
    "sigma3_x_m,sigma3_y_m,sigma3_z_m,sigma3_dtheta_x_rad,sigma3_dtheta_y_rad,sigma3_dtheta_z_rad,nees\n";
constexpr const char* kInnovationsHeader = "step,id,result,reason,distance,threshold\n";
constexpr const char* kTimingHeader = "step,step_ms,landmarks,observations,nis,nis_rows,nis_lower,nis_upper\n";
constexpr const char* kLandmarksHeader =
    "id,x_m,y_m,z_m,cov_xx_m2,cov_xy_m2,cov_xz_m2,cov_yy_m2,cov_yz_m2,cov_zz_m2,observations,"
    "true_x_m,true_y_m,true_z_m,error_x_m,error_y_m,error_z_m,sigma3_x_m,sigma3_y_m,sigma3_z_m\n";

const char* result_name(std::int32_t result) {
  switch (result) {
    case CAIRN_MATCHED:
      return "matched";
    case CAIRN_NEW:
      return "new";
    case CAIRN_REJECTED:
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
    default:
      return "unknown";
  }
}

double sigma3(double variance) {
  return 3 * std::sqrt(std::max(variance, 0.0));
}

void create_folder(const std::string& folder) {
  if (mkdir(folder.c_str(), 0777) == 0) return;
  const int cause = errno;
  struct stat status {};
  if (cause == EEXIST && stat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) return;
  throw UsageError("can't create the folder " + folder + ": " + std::strerror(cause));
}

void write_pose(OutputFile& file, const cairn_pose& pose) {
  double euler[3] = {};
  cairn_quaternion_to_euler(pose.quaternion, &euler[0], &euler[1], &euler[2]);
  file.fields(pose.position, 3);
  file.fields(pose.quaternion, 4);
  file.fields(euler, 3);
}

// The folder has to be there before the first of its files.
const std::string& created(const std::string& folder) {
  create_folder(folder);
  return folder;
}

}  // namespace

OutputFile::OutputFile(const std::string& folder, const char* name)
    : path_(folder + "/" + name), file_(std::fopen(path_.c_str(), "w"), &std::fclose) {
  if (!file_) fail();
}

void OutputFile::fail() const {
  throw UsageError("can't write " + path_ + ": " + std::strerror(errno));
}

void OutputFile::text(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail();
}

void OutputFile::field(const std::string& value) {
  text(row_begun_ ? "," + value : value);
  row_begun_ = true;
}

// The fewest digits that read back as the same number.
void OutputFile::field(double value) {
  char buffer[32];
  const char* end = std::isnan(value) ? buffer : std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  field(std::string(static_cast<const char*>(buffer), end));
}

void OutputFile::fields(const double* values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) field(values[i]);
}

void OutputFile::empty(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) field("");
}

void OutputFile::end() {
  text("\n");
  row_begun_ = false;
}

void OutputFile::close() {
  if (std::fclose(file_.release()) != 0) fail();
}

CsvOutput::CsvOutput(const io::Log& log, const std::string& folder)
    : log_(log),
      folder_(created(folder)),
      trajectory_(folder, "trajectory.csv"),
      innovations_(folder, "innovations.csv"),
      timing_(folder, "timing.csv") {
  trajectory_.text(kTrajectoryHeader);
  innovations_.text(kInnovationsHeader);
  timing_.text(kTimingHeader);
}

void CsvOutput::add(const StepResult& result, const std::optional<PoseScore>& score) {
  const io::Step& step = log_.steps[result.index];
  add_trajectory(step, result, score);
  add_innovations(step, result);
  add_timing(step, result);
}

void CsvOutput::add_trajectory(const io::Step& step, const StepResult& result, const std::optional<PoseScore>& score) {
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
  trajectory_.end();
}

void CsvOutput::add_innovations(const io::Step& step, const StepResult& result) {
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

void CsvOutput::add_timing(const io::Step& step, const StepResult& result) {
  timing_.field(step.number);
  timing_.field(1e3 * result.seconds);
  timing_.field(std::uint64_t{result.landmarks});
  timing_.field(std::uint64_t{result.matches.size()});
  timing_.field(result.report.nis);
  timing_.field(std::uint64_t{result.report.rows});
  timing_.field(result.report.nis_lower);
  timing_.field(result.report.nis_upper);
  timing_.end();
}

void CsvOutput::finish(const cairn_filter* filter, const Summary& summary) {
  trajectory_.close();
  innovations_.close();
  timing_.close();
  write_landmarks(filter);
  OutputFile json(folder_, "summary.json");
  json.text(summary.json());
  json.close();
}

void CsvOutput::write_landmarks(const cairn_filter* filter) {
  OutputFile file(folder_, "landmarks.csv");
  file.text(kLandmarksHeader);
  for (const cairn_landmark& landmark : map_landmarks(filter)) {
    const double* covariance = landmark.covariance;
    file.field(landmark.id);
    file.fields(landmark.position, 3);
    for (const int index : {0, 1, 2, 4, 5, 8}) file.field(covariance[index]);
    file.field(landmark.observations);
    const auto truth = log_.landmarks.find(landmark.id);
    if (truth == log_.landmarks.end()) {
      file.empty(6);
    } else {
      file.fields(truth->second.data(), 3);
      for (std::size_t i = 0; i < 3; ++i) file.field(truth->second[i] - landmark.position[i]);
    }
    for (int i = 0; i < 3; ++i) file.field(sigma3(covariance[i * 4]));
    file.end();
  }
  file.close();
}

}  // namespace cairn::cli
