// SPDX-License-Identifier: BSD-3-Clause
// A recording of several robots in the plane: a folder of the UTIAS multi-robot set (MRCLAM). Its files are plain text,
// one record a line, fields separated by blanks; # begins a comment. A robot without a truth file has no true pose.
//   Barcodes.dat               subject, barcode: what each robot and each landmark carries
//   Landmark_Groundtruth.dat   subject, x, y, standard deviations of x and y (m)
//   RobotN_Odometry.dat        time (s), forward speed (m/s), rate of turn (rad/s)
//   RobotN_Measurement.dat     time (s), barcode, range (m), bearing (rad)
//   RobotN_Groundtruth.dat     time (s), x, y (m), heading (rad)
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace cairn::program::logs {

struct MrclamLog {
  struct Odometry {
    double time;   // s, on the clock that all robots share
    double speed;  // m/s, held until the next record
    double rate;   // rad/s, anticlockwise
  };
  struct Measurement {
    double time;
    std::uint64_t subject;  // a robot's id, or a landmark's
    double range;           // m, > 0
    double bearing;         // rad, from the robot's x axis, anticlockwise, as the file has it
  };
  struct Truth {
    double time;
    double x, y;     // m
    double heading;  // rad, anticlockwise, as the file has it
  };
  struct Robot {
    std::uint64_t id;
    std::vector<Odometry> odometry;  // these three are in order of time, equal times allowed; never empty
    std::vector<Measurement> measurements;
    std::vector<Truth> truth;
  };

  std::string format;                                        // for people
  std::vector<std::string> notes;                            // what the reader left out or sorted
  std::vector<Robot> robots;                                 // by ascending id; never empty
  std::map<std::uint64_t, std::array<double, 2>> landmarks;  // true positions, m
};

// Whether `path` is a folder that holds a Barcodes.dat.
bool is_mrclam(const std::string& path);

// Reads such a folder, with every robot that has a file. Measurements of an unknown subject are left out, and lines are
// sorted by time; the notes count both. Throws LogError.
MrclamLog read_mrclam(const std::string& path);

// A robot's true pose at a time, interpolated between two records along the straight line and the shorter turn; heading
// in (-pi, pi]. False before the first record and after the last one. O(log records).
bool truth_at(const MrclamLog::Robot& robot, double time, MrclamLog::Truth& pose);

}  // namespace cairn::program::logs
