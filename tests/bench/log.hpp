// SPDX-License-Identifier: BSD-3-Clause
// Reader of the neutral log for the benchmark programs. One record per line, SI units, radians, in order of time:
//   T k t x y z roll pitch yaw           true pose at step k
//   O k dx dy dz droll dpitch dyaw       measured motion from step k-1 to k, in the body of k-1
//   Z k id range azimuth elevation       measured landmark, in the body of k
//   L id x y z                           true landmark
// Empty lines and lines that begin with # are skipped. All other lines are refused.
#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace bench {

using Vector3 = std::array<double, 3>;
using Vector6 = std::array<double, 6>;  // x y z roll pitch yaw

struct Sighting {
  std::uint64_t id;
  Vector3 z;  // range, azimuth, elevation
};

struct Step {
  double time = 0.0;
  Vector6 truth{};
  std::optional<Vector6> increment;
  std::vector<Sighting> sightings;
};

struct Log {
  std::vector<Step> steps;
  std::map<std::uint64_t, Vector3> landmarks;
};

// The noise with which the logs were made. Every driver gives it to its filter.
struct Noise {
  static constexpr double kDegree = 0.017453292519943295;
  static constexpr double kIncrementMetres = 0.02, kIncrementRadians = 0.1 * kDegree;
  static constexpr double kRange = 0.1, kAngle = 0.5 * kDegree;
};

class LogReader {
 public:
  explicit LogReader(const std::string& path) : path_(path), stream_(path) {
    if (!stream_) throw std::runtime_error(path + ": cannot be opened");
  }

  Log read() {
    std::string text;
    while (std::getline(stream_, text)) {
      ++line_;
      if (!text.empty() && text[0] != '#') record(text);
    }
    if (log_.steps.empty()) fail("there is no step");
    return std::move(log_);
  }

 private:
  void record(const std::string& text) {
    std::istringstream fields(text);
    std::string kind;
    fields >> kind;
    if (kind == "T") {
      Step& current = step(fields);
      current.time = numbers<1>(fields)[0];
      current.truth = numbers<6>(fields);
    } else if (kind == "O") {
      Step& current = step(fields);  // read first: the right side of an assignment is evaluated before the left side
      current.increment = numbers<6>(fields);
    } else if (kind == "Z") {
      Step& current = step(fields);
      const std::uint64_t id = whole(fields);
      current.sightings.push_back({id, numbers<3>(fields)});
    } else if (kind == "L") {
      const std::uint64_t id = whole(fields);
      log_.landmarks[id] = numbers<3>(fields);
    } else {
      fail("unknown record '" + kind + "'");
    }
  }

  // The step that the record names. It is created if it is the next one.
  Step& step(std::istringstream& fields) {
    const std::uint64_t number = whole(fields);
    if (number == log_.steps.size()) log_.steps.emplace_back();
    if (number + 1 != log_.steps.size()) fail("step " + std::to_string(number) + " is out of order");
    return log_.steps.back();
  }

  std::uint64_t whole(std::istringstream& fields) {
    std::uint64_t number = 0;
    if (!(fields >> number)) fail("a whole number is missing");
    return number;
  }

  template <std::size_t count>
  std::array<double, count> numbers(std::istringstream& fields) {
    std::array<double, count> values{};
    for (double& value : values) {
      if (!(fields >> value)) fail("a number is missing");
    }
    return values;
  }

  [[noreturn]] void fail(const std::string& cause) {
    throw std::runtime_error(path_ + ":" + std::to_string(line_) + ": " + cause);
  }

  std::string path_;
  std::ifstream stream_;
  std::size_t line_ = 0;
  Log log_;
};

inline Log read_log(const std::string& path) {
  return LogReader(path).read();
}

}  // namespace bench
