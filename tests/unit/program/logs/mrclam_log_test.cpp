// SPDX-License-Identifier: BSD-3-Clause
// Reading MRCLAM folders: a small one, each way to spoil it, and the recorded one where it is at hand.
#include "program/logs/mrclam_log.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "program/logs/log.hpp"

using namespace cairn::program::logs;

namespace {

constexpr double kPi = 3.14159265358979323846;

// Two robots, of which the second carries the larger number, and two landmarks.
const std::map<std::string, std::string> kGood = {
    {"Barcodes.dat", "# Subject #    Barcode #\n  1 \t   5\n  12 \t  14\n\n 20 \t 63\n 21 \t 7\n"},
    {"Landmark_Groundtruth.dat", "# x y\n 20 \t 0.5 \t -4.25 \t 0.0001 \t 0.0002\n 21 3 +1e0 0 0\r\n"},
    {"Robot1_Odometry.dat",
     "# Time\n1248446188.323 \t 0.086 \t -0.398\n1248446188.882 0.086 -0.398\n"
     "1248446188.882 0.085 0.1\n"},
    {"Robot1_Measurement.dat", "1248446189.249 14 1.682 0.032\n1248446189.249 63 1.648 -0.133\n1248446190 7 2.5 3.2\n"},
    {"Robot1_Groundtruth.dat", "10 1 2 3\n12 3 1 -3\n12 4 1 -3\n20 4 1 1\n"},
    {"Robot12_Odometry.dat", "5 0 0\n"},
    {"Robot12_Measurement.dat", "# sees nothing\n"},
    {"Robot12_Groundtruth.dat", "7 1 2 3\n"},
    {"Readme.txt", "not read"},
    {"Robot7.dat", "not read"},
};

class Folder {
 public:
  explicit Folder(const std::map<std::string, std::string>& files) {
    char name[] = "/tmp/cairn_mrclam_XXXXXX";
    REQUIRE(mkdtemp(name) != nullptr);
    path_ = name;
    for (const auto& [file, text] : files) std::ofstream(path_ + "/" + file, std::ios::binary) << text;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// The good folder with one file replaced, or with none of that name.
std::map<std::string, std::string> with(const std::string& file, const std::string& text) {
  std::map<std::string, std::string> files = kGood;
  files[file] = text;
  return files;
}
std::map<std::string, std::string> without(const std::string& file) {
  std::map<std::string, std::string> files = kGood;
  REQUIRE(files.erase(file) == 1);
  return files;
}

// One line, which begins with the folder and holds all of `words`.
void check_refused(const std::map<std::string, std::string>& files, const std::string& place,
                   const std::string& words) {
  const Folder folder(files);
  std::string message = "it was read";
  try {
    read_mrclam(folder.path());
  } catch (const LogError& error) {
    message = error.what();
  }
  CAPTURE(place);
  CAPTURE(message);
  CHECK(message.compare(0, folder.path().size(), folder.path()) == 0);
  CHECK(message.substr(std::min(folder.path().size(), message.size())).compare(0, place.size(), place) == 0);
  CHECK(message.find(words) != std::string::npos);
  CHECK(message.find('\n') == std::string::npos);
}

}  // namespace

TEST_CASE("mrclam: a small folder") {
  const Folder folder(kGood);
  REQUIRE(is_mrclam(folder.path()));
  const MrclamLog log = read_mrclam(folder.path());
  CHECK(log.format == "MRCLAM folder");
  CHECK(log.notes.empty());
  REQUIRE(log.landmarks.size() == 2);
  CHECK(log.landmarks.at(20) == std::array<double, 2>{0.5, -4.25});
  CHECK(log.landmarks.at(21) == std::array<double, 2>{3, 1});
  REQUIRE(log.robots.size() == 2);
  const MrclamLog::Robot& one = log.robots[0];
  CHECK(one.id == 1);
  REQUIRE(one.odometry.size() == 3);
  CHECK(one.odometry[0].time == 1248446188.323);
  CHECK(one.odometry[0].speed == 0.086);
  CHECK(one.odometry[0].rate == -0.398);
  CHECK(one.odometry[2].speed == 0.085);
  REQUIRE(one.measurements.size() == 3);
  CHECK(one.measurements[0].time == 1248446189.249);
  CHECK(one.measurements[0].subject == 12);
  CHECK(one.measurements[0].range == 1.682);
  CHECK(one.measurements[0].bearing == 0.032);
  CHECK(one.measurements[1].subject == 20);
  CHECK(one.measurements[2].subject == 21);
  CHECK(one.measurements[2].bearing == 3.2);
  REQUIRE(one.truth.size() == 4);
  CHECK(one.truth[1].x == 3);
  CHECK(one.truth[1].y == 1);
  CHECK(one.truth[1].heading == -3);
  CHECK(log.robots[1].id == 12);
  CHECK(log.robots[1].odometry.size() == 1);
  CHECK(log.robots[1].measurements.empty());
}

TEST_CASE("mrclam: robots by ascending number, however their files are listed; one will do") {
  std::map<std::string, std::string> files = kGood;
  for (const char* ending : {"_Odometry.dat", "_Measurement.dat", "_Groundtruth.dat"})
    for (const char* robot : {"Robot3", "Robot100"})
      files[robot + std::string(ending)] = kGood.at("Robot12" + std::string(ending));
  const Folder many(files);
  const MrclamLog log = read_mrclam(many.path());
  REQUIRE(log.robots.size() == 4);
  CHECK(log.robots[1].id == 3);
  CHECK(log.robots[2].id == 12);
  CHECK(log.robots[3].id == 100);
  files = kGood;
  for (const char* ending : {"_Odometry.dat", "_Measurement.dat", "_Groundtruth.dat"})
    files.erase("Robot12" + std::string(ending));
  const Folder one(files);
  const MrclamLog alone = read_mrclam(one.path());
  REQUIRE(alone.robots.size() == 1);
  CHECK(alone.robots[0].measurements.size() == 2);  // robot 12 is nobody now
  REQUIRE(alone.notes.size() == 1);
  CHECK(alone.notes[0] ==
        "Robot1_Measurement.dat: left out 1 measurement of subjects that are neither a robot nor a landmark");
}

TEST_CASE("mrclam: what is left out is counted") {
  const Folder folder(with("Robot1_Measurement.dat", "1 99 1 0\n2 14 1 0\n3 5 1 0\n4 99 1 0\n5 5 1 0\n5 98 2 0\n"));
  const MrclamLog log = read_mrclam(folder.path());
  REQUIRE(log.robots[0].measurements.size() == 1);
  CHECK(log.robots[0].measurements[0].time == 2);
  REQUIRE(log.notes.size() == 2);
  CHECK(log.notes[0] == "Robot1_Measurement.dat: left out 3 measurements of barcodes that no subject has");
  CHECK(log.notes[1] == "Robot1_Measurement.dat: left out 2 measurements of the robot's own barcode");
}

TEST_CASE("mrclam: which folders are") {
  const Folder folder(without("Barcodes.dat")), bare({});
  CHECK_FALSE(is_mrclam(folder.path()));
  CHECK_FALSE(is_mrclam(folder.path() + "/Readme.txt"));
  CHECK_FALSE(is_mrclam(folder.path() + "/absent"));
  std::filesystem::create_directory(bare.path() + "/Barcodes.dat");
  CHECK_FALSE(is_mrclam(bare.path()));
}

TEST_CASE("mrclam: files that are missing") {
  check_refused(without("Barcodes.dat"), "/Barcodes.dat: ", "No such file");
  check_refused(without("Landmark_Groundtruth.dat"), "/Landmark_Groundtruth.dat: ", "No such file");
  for (const char* name : {"Robot1_Odometry.dat", "Robot1_Measurement.dat"})
    check_refused(without(name), "/" + std::string(name) + ": ", "No such file");
  check_refused(with("Robot3_Groundtruth.dat", "1 2 3 4\n"), "/Robot3_Odometry.dat: ", "No such file");
  check_refused({{"Barcodes.dat", "1 5\n"}}, ": ", "no robot's files");
  CHECK_THROWS_AS(read_mrclam("/nowhere/at all"), LogError);
}

TEST_CASE("mrclam: lines that are no records") {
  check_refused(with("Barcodes.dat", "# a\n1 5\n12\n"), "/Barcodes.dat:3: ", "1 fields, expected 2: subject, barcode");
  check_refused(with("Barcodes.dat", "1 5 7\n"), "/Barcodes.dat:1: ", "3 fields");
  check_refused(with("Landmark_Groundtruth.dat", "20 1 2 3\n"), "/Landmark_Groundtruth.dat:1: ", "4 fields");
  check_refused(with("Robot1_Odometry.dat", "1 2 3\n\n2 2\n"), "/Robot1_Odometry.dat:3: ", "2 fields");
  check_refused(with("Robot1_Measurement.dat", "1 5 1\n"), "/Robot1_Measurement.dat:1: ", "3 fields");
  check_refused(with("Robot12_Groundtruth.dat", "1 5 1\n"), "/Robot12_Groundtruth.dat:1: ", "3 fields");
  check_refused(with("Robot1_Odometry.dat", "1 2 3\n2 2"), "/Robot1_Odometry.dat:2: ", "2 fields");
  check_refused(with("Robot1_Odometry.dat", ""), "/Robot1_Odometry.dat:1: ", "no odometry");
}

TEST_CASE("mrclam: a last line without an end is read, with a note") {
  const Folder folder(with("Robot1_Odometry.dat", "1 2 3\n2 2 3.5"));
  const MrclamLog log = read_mrclam(folder.path());
  REQUIRE(log.robots[0].odometry.size() == 2);
  CHECK(log.robots[0].odometry[1].rate == 3.5);
  REQUIRE(log.notes.size() == 1);
  CHECK(log.notes[0].find("Robot1_Odometry.dat: the last line has no end") != std::string::npos);
}

TEST_CASE("mrclam: robots without truth") {
  for (const auto& files : {without("Robot12_Groundtruth.dat"), with("Robot12_Groundtruth.dat", "# a\n# b\n")}) {
    const Folder folder(files);
    const MrclamLog log = read_mrclam(folder.path());
    CHECK(log.notes.empty());
    REQUIRE(log.robots.size() == 2);
    CHECK(log.robots[0].truth.size() == 4);
    CHECK(log.robots[1].id == 12);
    CHECK(log.robots[1].odometry.size() == 1);
    CHECK(log.robots[1].truth.empty());
    MrclamLog::Truth pose{};
    CHECK_FALSE(truth_at(log.robots[1], 7, pose));
  }
}

TEST_CASE("mrclam: fields that are no numbers") {
  check_refused(with("Barcodes.dat", "1.5 5\n"), "/Barcodes.dat:1: ", "subject '1.5' is not a whole number");
  check_refused(with("Barcodes.dat", "1 -5\n"), "/Barcodes.dat:1: ", "barcode '-5'");
  check_refused(with("Barcodes.dat", "18446744073709551615 5\n"), "/Barcodes.dat:1: ", "reserved");
  check_refused(with("Barcodes.dat", "1 \x1b[31mx\n"), "/Barcodes.dat:1: ", "'?[31mx'");
  check_refused(with("Landmark_Groundtruth.dat", "20 1 x 0 0\n"), "/Landmark_Groundtruth.dat:1: ", "y 'x'");
  check_refused(with("Landmark_Groundtruth.dat", "20 1 2 0 nan\n"), "/Landmark_Groundtruth.dat:1: ", "y deviation");
  for (const char* bad : {"nan", "inf", "-inf", "1e999", "1,5", "0.1x", "--1", "+-1", "word"}) {
    const std::string is_bad = "'" + std::string(bad) + "' is not a finite number", b = bad;
    check_refused(with("Robot1_Odometry.dat", "1 2 3\n" + b + " 2 3\n"), "/Robot1_Odometry.dat:2: ", "time " + is_bad);
    check_refused(with("Robot1_Odometry.dat", "1 " + b + " 3\n"), "/Robot1_Odometry.dat:1: ", "speed " + is_bad);
    check_refused(with("Robot1_Odometry.dat", "1 2 " + b + "\n"), "/Robot1_Odometry.dat:1: ", "rate " + is_bad);
    check_refused(with("Robot1_Measurement.dat", "1 5 " + b + " 0\n"),
                  "/Robot1_Measurement.dat:1: ", "range " + is_bad);
    // Even of those that would be left out.
    check_refused(with("Robot1_Measurement.dat", "1 99 1 " + b + "\n"),
                  "/Robot1_Measurement.dat:1: ", "bearing " + is_bad);
    check_refused(with("Robot1_Groundtruth.dat", "1 2 3 " + b + "\n"),
                  "/Robot1_Groundtruth.dat:1: ", "heading " + is_bad);
  }
  check_refused(with("Robot1_Measurement.dat", "1 14 -0.5 0\n"),
                "/Robot1_Measurement.dat:1: ", "range '-0.5' is not positive");
  check_refused(with("Robot1_Measurement.dat", "1 14 0 0\n"),
                "/Robot1_Measurement.dat:1: ", "range '0' is not positive");
}

TEST_CASE("mrclam: lines out of time order are sorted, with a note") {
  std::map<std::string, std::string> files = kGood;
  files["Robot1_Odometry.dat"] = "2 1 0\n1.9 2 0\n2 3 0\n1.5 4 0\n";
  files["Robot1_Measurement.dat"] = "2 14 1 0\n2 63 2 0\n1 7 3 0\n";
  files["Robot12_Groundtruth.dat"] = "2 5 1 0\n1 6 1 0\n";
  const Folder folder(files);
  const MrclamLog log = read_mrclam(folder.path());
  const MrclamLog::Robot& one = log.robots[0];
  REQUIRE(one.odometry.size() == 4);
  constexpr double kTimes[] = {1.5, 1.9, 2, 2}, kSpeeds[] = {4, 2, 1, 3};  // equal times keep their order
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(one.odometry[i].time == kTimes[i]);
    CHECK(one.odometry[i].speed == kSpeeds[i]);
  }
  REQUIRE(one.measurements.size() == 3);
  constexpr double kRanges[] = {3, 1, 2};
  for (std::size_t i = 0; i < 3; ++i) CHECK(one.measurements[i].range == kRanges[i]);
  REQUIRE(log.robots[1].truth.size() == 2);
  CHECK(log.robots[1].truth[0].x == 6);
  CHECK(log.robots[1].truth[1].x == 5);
  CHECK(log.robots[0].truth.size() == 4);
  REQUIRE(log.notes.size() == 3);
  const auto noted = [&log](const std::string& note) {
    return std::count(log.notes.begin(), log.notes.end(), note) == 1;
  };
  CHECK(noted("Robot1_Odometry.dat: sorted by time, because of 2 lines earlier than the line before"));
  CHECK(noted("Robot1_Measurement.dat: sorted by time, because of 1 line earlier than the line before"));
  CHECK(noted("Robot12_Groundtruth.dat: sorted by time, because of 1 line earlier than the line before"));
}

TEST_CASE("mrclam: names given twice") {
  check_refused(with("Barcodes.dat", "1 5\n2 5\n"), "/Barcodes.dat:2: ", "barcode 5 a second time: subject 1");
  check_refused(with("Barcodes.dat", "1 5\n1 6\n"), "/Barcodes.dat:2: ", "subject 1 a second time");
  check_refused(with("Landmark_Groundtruth.dat", "20 1 2 0 0\n20 1 2 0 0\n"),
                "/Landmark_Groundtruth.dat:2: ", "landmark 20 a second time");
  check_refused(with("Landmark_Groundtruth.dat", "12 1 2 0 0\n"),
                "/Landmark_Groundtruth.dat:1: ", "landmark 12 is a robot");
}

TEST_CASE("mrclam: the truth between its records") {
  const Folder folder(kGood);
  const MrclamLog log = read_mrclam(folder.path());
  MrclamLog::Truth pose{};
  REQUIRE(truth_at(log.robots[0], 10, pose));
  CHECK(pose.x == 1);
  CHECK(pose.heading == doctest::Approx(3).epsilon(1e-15));
  REQUIRE(truth_at(log.robots[0], 11.5, pose));
  CHECK(pose.time == 11.5);
  CHECK(pose.x == doctest::Approx(2.5).epsilon(1e-15));
  CHECK(pose.y == doctest::Approx(1.25).epsilon(1e-15));
  // From 3 to -3 by the shorter way, over pi: three quarters of it.
  CHECK(pose.heading == doctest::Approx(3 + 0.75 * (2 * kPi - 6) - 2 * kPi).epsilon(1e-14));
  REQUIRE(truth_at(log.robots[0], 10.5, pose));
  CHECK(pose.heading == doctest::Approx(3 + 0.25 * (2 * kPi - 6)).epsilon(1e-14));
  REQUIRE(truth_at(log.robots[0], 12, pose));  // two records of that time: the last one
  CHECK(pose.x == 4);
  REQUIRE(truth_at(log.robots[0], 20, pose));
  CHECK(pose.heading == 1);
  for (const double outside : {9.999, 20.001, std::nan(""), -HUGE_VAL, HUGE_VAL})
    CHECK_FALSE(truth_at(log.robots[0], outside, pose));
  CHECK(pose.heading == 1);  // untouched
  REQUIRE(truth_at(log.robots[1], 7, pose));
  CHECK(pose.y == 2);
  CHECK_FALSE(truth_at(log.robots[1], 7.001, pose));
}

TEST_CASE("mrclam: the recorded folder") {
  const char* data = std::getenv("CAIRN_DATA_DIR");
  if (data == nullptr || *data == 0) {
    MESSAGE("skipped: CAIRN_DATA_DIR is not set");
    return;
  }
  const MrclamLog log = read_mrclam(std::string(data) + "/mrclam7");
  constexpr std::size_t kOdometry[] = {58598, 60936, 55085, 62207, 59787};
  constexpr std::size_t kMeasurements[] = {3228, 4518, 5399 - 9, 2377, 4760};
  constexpr std::size_t kTruth[] = {58389, 56529, 53545, 63081, 58414};
  CHECK(log.landmarks.size() == 15);
  CHECK(log.landmarks.at(6)[1] == -4.28209684);
  REQUIRE(log.robots.size() == 5);
  REQUIRE(log.notes.size() == 1);
  CHECK(log.notes[0] == "Robot3_Measurement.dat: left out 9 measurements of barcodes that no subject has");
  for (std::size_t i = 0; i < 5; ++i) {
    const MrclamLog::Robot& robot = log.robots[i];
    CHECK(robot.id == i + 1);
    CHECK(robot.odometry.size() == kOdometry[i]);
    CHECK(robot.measurements.size() == kMeasurements[i]);
    CHECK(robot.truth.size() == kTruth[i]);
    // Measurements are what the truth says, by the conventions of the header: most within 0.3 m and 6 degrees.
    std::size_t close = 0, all = 0;
    for (const MrclamLog::Measurement& m : robot.measurements) {
      MrclamLog::Truth here{}, there{};
      if (!truth_at(robot, m.time, here)) continue;
      if (m.subject > 5) {
        there.x = log.landmarks.at(m.subject)[0], there.y = log.landmarks.at(m.subject)[1];
      } else if (!truth_at(log.robots[m.subject - 1], m.time, there)) {
        continue;
      }
      const double dx = there.x - here.x, dy = there.y - here.y;
      ++all;
      close += std::abs(std::hypot(dx, dy) - m.range) < 0.3 &&
               std::abs(std::remainder(std::atan2(dy, dx) - here.heading - m.bearing, 2 * kPi)) < 0.1;
    }
    CAPTURE(close);
    CAPTURE(all);
    CHECK(all > 2000);
    CHECK(static_cast<double>(close) > 0.8 * static_cast<double>(all));
  }
}
