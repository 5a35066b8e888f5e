// SPDX-License-Identifier: BSD-3-Clause
#include "program/logs/mrclam_log.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>

#include "program/logs/log.hpp"
#include "program/logs/text_table.hpp"

namespace cairn::program::logs {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr const char* kBarcodes = "Barcodes.dat";
constexpr const char* kLandmarks = "Landmark_Groundtruth.dat";
constexpr const char* kOdometry = "_Odometry.dat";
constexpr const char* kMeasurements = "_Measurement.dat";
constexpr const char* kTruth = "_Groundtruth.dat";

double wrapped(double angle) {
  const double turned = std::remainder(angle, 2 * kPi);
  return turned <= -kPi ? kPi : turned;
}

bool exists(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

class Reader {
 public:
  explicit Reader(const std::string& folder) : folder_(folder) {}

  MrclamLog read() {
    log_.format = "MRCLAM folder";
    const std::set<std::uint64_t> robots = find_robots();
    for (const std::uint64_t id : robots) log_.robots.push_back({id, {}, {}, {}});
    read_barcodes();
    read_landmarks(robots);
    for (MrclamLog::Robot& robot : log_.robots) {
      read_odometry(robot);
      read_measurements(robot, robots);
      read_truth(robot);
    }
    return std::move(log_);
  }

 private:
  std::string file(const std::string& name) const { return folder_ + "/" + name; }
  static std::string robot_file(const MrclamLog::Robot& robot, const char* ending) {
    return "Robot" + std::to_string(robot.id) + ending;
  }

  // Robots that have one of the three files.
  std::set<std::uint64_t> find_robots() const {
    std::error_code cause;
    const std::filesystem::directory_iterator folder(folder_, cause);
    if (cause) throw LogError(folder_ + ": " + cause.message());
    std::set<std::uint64_t> robots;
    for (const std::filesystem::directory_entry& entry : folder) {
      const std::string name = entry.path().filename().string();
      constexpr std::string_view kStart = "Robot";
      if (name.substr(0, kStart.size()) != kStart) continue;
      std::uint64_t id = 0;
      const char* first = name.data() + kStart.size();
      if (std::from_chars(first, name.data() + name.size(), id).ec != std::errc() || id == CAIRN_ID_NONE) continue;
      for (const char* ending : {kOdometry, kMeasurements, kTruth})
        if (name == robot_file({id, {}, {}, {}}, ending)) robots.insert(id);
    }
    if (robots.empty()) throw LogError(folder_ + ": no robot's files; a MRCLAM folder has Robot1" + kOdometry);
    return robots;
  }

  void read_barcodes() {
    TextTable table(file(kBarcodes), {"subject", "barcode"});
    std::set<std::uint64_t> subjects;
    while (table.next()) {
      const std::uint64_t subject = table.identity(0), barcode = table.whole(1);
      if (!subjects.insert(subject).second) table.fail("subject " + std::to_string(subject) + " a second time");
      const auto [known, added] = subjects_.emplace(barcode, subject);
      if (!added)
        table.fail("barcode " + std::to_string(barcode) + " a second time: subject " + std::to_string(known->second) +
                   " has it");
    }
  }

  void read_landmarks(const std::set<std::uint64_t>& robots) {
    TextTable table(file(kLandmarks), {"subject", "x", "y", "x deviation", "y deviation"});
    while (table.next()) {
      const std::uint64_t id = table.identity(0);
      const std::array<double, 2> position = {table.number(1), table.number(2)};
      table.number(3), table.number(4);
      if (robots.count(id) > 0) table.fail("landmark " + std::to_string(id) + " is a robot, too");
      if (!log_.landmarks.emplace(id, position).second) table.fail("landmark " + std::to_string(id) + " a second time");
    }
  }

  void read_odometry(MrclamLog::Robot& robot) {
    TextTable table(file(robot_file(robot, kOdometry)), {"time", "speed", "rate"});
    while (table.next()) {
      const double time = table.time();
      robot.odometry.push_back({time, table.number(1), table.number(2)});
    }
    if (robot.odometry.empty()) table.fail("no odometry: the robot cannot be followed");
    sort(table, robot_file(robot, kOdometry), robot.odometry);
  }

  void read_measurements(MrclamLog::Robot& robot, const std::set<std::uint64_t>& robots) {
    const std::string name = robot_file(robot, kMeasurements);
    TextTable table(file(name), {"time", "barcode", "range", "bearing"});
    std::size_t strange = 0, nobody = 0, own = 0;
    while (table.next()) {
      MrclamLog::Measurement m{};
      m.time = table.time();
      const auto found = subjects_.find(table.whole(1));
      m.range = table.positive(2);
      m.bearing = table.number(3);
      if (found == subjects_.end()) {
        ++strange;
        continue;
      }
      m.subject = found->second;
      if (m.subject == robot.id) {
        ++own;
      } else if (robots.count(m.subject) == 0 && log_.landmarks.count(m.subject) == 0) {
        ++nobody;
      } else {
        robot.measurements.push_back(m);
      }
    }
    sort(table, name, robot.measurements);
    note(name, strange, "of barcodes that no subject has");
    note(name, nobody, "of subjects that are neither a robot nor a landmark");
    note(name, own, "of the robot's own barcode");
  }

  // Sorts records of a table that was read to its end.
  template <class Record>
  void sort(const TextTable& table, const std::string& name, std::vector<Record>& records) {
    table.note_missing_end(log_.notes);
    if (table.late_lines() == 0) return;
    std::stable_sort(records.begin(), records.end(), [](const Record& a, const Record& b) { return a.time < b.time; });
    log_.notes.push_back(name + ": sorted by time, because of " + std::to_string(table.late_lines()) +
                         (table.late_lines() == 1 ? " line" : " lines") + " earlier than the line before");
  }

  void note(const std::string& name, std::size_t count, const char* what) {
    if (count == 0) return;
    log_.notes.push_back(name + ": left out " + std::to_string(count) +
                         (count == 1 ? " measurement " : " measurements ") + what);
  }

  // A robot may be without truth: without the file, or with an empty one.
  void read_truth(MrclamLog::Robot& robot) {
    const std::string name = robot_file(robot, kTruth);
    if (!exists(file(name))) return;
    TextTable table(file(name), {"time", "x", "y", "heading"});
    while (table.next()) {
      const double time = table.time();
      robot.truth.push_back({time, table.number(1), table.number(2), table.number(3)});
    }
    sort(table, name, robot.truth);
  }

  const std::string& folder_;
  MrclamLog log_;
  std::map<std::uint64_t, std::uint64_t> subjects_;  // by barcode
};

}  // namespace

bool is_mrclam(const std::string& path) {
  return exists(path + "/" + kBarcodes);
}

MrclamLog read_mrclam(const std::string& path) {
  return Reader(path).read();
}

bool truth_at(const MrclamLog::Robot& robot, double time, MrclamLog::Truth& pose) {
  const std::vector<MrclamLog::Truth>& truth = robot.truth;
  if (truth.empty() || !(time >= truth.front().time && time <= truth.back().time)) return false;
  const auto after = std::upper_bound(truth.begin(), truth.end(), time,
                                      [](double t, const MrclamLog::Truth& record) { return t < record.time; });
  // The last record of this time counts. A record stands before it, because the first record is not later.
  const MrclamLog::Truth& a = *(after - 1);
  const MrclamLog::Truth& b = after == truth.end() ? a : *after;
  const double share = b.time > a.time ? (time - a.time) / (b.time - a.time) : 0;
  pose.time = time;
  pose.x = a.x + share * (b.x - a.x);
  pose.y = a.y + share * (b.y - a.y);
  pose.heading = wrapped(a.heading + share * wrapped(b.heading - a.heading));
  return true;
}

}  // namespace cairn::program::logs
