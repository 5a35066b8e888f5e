// SPDX-License-Identifier: BSD-3-Clause
// iSAM's text form of a planar problem: one record a line, metres and radians, fields separated by blanks.
//   EDGE2 i j dx dy dtheta r11 r12 r13 r22 r23 r33     pose j in the frame of pose i, as measured
//   LANDMARK i l dx dy r11 r12 r22                     landmark l in the frame of pose i, as measured
// R is upper triangular, the square root of the information: R^T R is the inverse of the covariance of an additive
// error of the measured values. The records may come in any order. NAME_groundtruth.EXT beside NAME.EXT has the same
// form; its values are the true ones.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <system_error>

#include "program/logs/log.hpp"
#include "program/logs/planar.hpp"
#include "program/logs/text_file.hpp"

namespace cairn::program::logs {
namespace {

using PosePair = std::pair<std::uint64_t, std::uint64_t>;  // the lower number first

struct Edge {
  PlanarPose motion;                      // the later pose in the frame of the earlier one
  std::array<double, 9> covariance = {};  // of an additive error of x, y, heading
};

// The content of a file.
struct Graph {
  std::map<PosePair, Edge> edges;
  std::map<std::uint64_t, std::vector<cairn_observation>> sightings;  // by pose, as the file has them
  std::set<std::uint64_t> poses;
  std::size_t edges_again = 0, sightings_again = 0;  // left out, because the file has one of the same two
  std::vector<std::string> notes;
};

// The error of an inverse: with T = (p, h), T^-1 = (-R^T p, -h), so that dp' = -R^T dp + G R^T p dh and dh' = -dh.
Edge inverse(const Edge& edge) {
  const double c = std::cos(edge.motion.heading), s = std::sin(edge.motion.heading);
  const std::array<double, 2> p = PlanarPose{0, 0, -edge.motion.heading}.apply(edge.motion.x, edge.motion.y);
  const double J[9] = {-c, -s, -p[1], s, -c, p[0], 0, 0, -1};
  Edge out{edge.motion.inverse(), {}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
          out.covariance[3 * i + j] += J[3 * i + a] * edge.covariance[3 * a + b] * J[3 * j + b];
  return out;
}

class Reader {
 public:
  Reader(const std::string& path, const std::string& text) : lines_(path, text) {}

  Graph read() {
    while (lines_.next()) {
      const std::string_view name = lines_.field(0);
      if (name == "EDGE2") {
        read_edge();
      } else if (name == "LANDMARK") {
        read_sighting();
      } else if (name == "VERTEX2") {
        lines_.fail(
            "record VERTEX2 is of a TORO file, whose EDGE2 have another matrix: this program reads iSAM's form");
      } else {
        lines_.fail("unknown record " + TextLines::quoted(name) + ", expected EDGE2 or LANDMARK");
      }
    }
    lines_.note_missing_end(graph_.notes);
    return std::move(graph_);
  }

 private:
  void expect_fields(std::size_t count) const {
    if (lines_.size() == count) return;
    lines_.fail("record " + std::string(lines_.field(0)) + " has " + std::to_string(lines_.size()) +
                " fields, expected " + std::to_string(count));
  }

  // (R^T R)^-1 = U U^T with U = R^-1, both upper triangular; R begins at field `first`.
  template <std::size_t kSize>
  std::array<double, kSize * kSize> read_covariance(std::size_t first) const {
    std::array<double, kSize * kSize> R{}, U{}, covariance{};
    for (std::size_t i = 0; i < kSize; ++i)
      for (std::size_t j = i; j < kSize; ++j)
        R[kSize * i + j] = lines_.number(first++, "square root of the information");
    for (std::size_t j = 0; j < kSize; ++j) {
      U[kSize * j + j] = 1 / R[kSize * j + j];
      for (std::size_t i = j; i-- > 0;) {
        double sum = 0;
        for (std::size_t k = i + 1; k <= j; ++k) sum += R[kSize * i + k] * U[kSize * k + j];
        U[kSize * i + j] = -sum / R[kSize * i + i];
      }
    }
    for (std::size_t i = 0; i < kSize; ++i)
      for (std::size_t j = 0; j < kSize; ++j)
        for (std::size_t k = std::max(i, j); k < kSize; ++k)
          covariance[kSize * i + j] += U[kSize * i + k] * U[kSize * j + k];
    for (std::size_t i = 0; i < kSize; ++i) {
      const double variance = covariance[kSize * i + i];
      if (!(variance > 0) || !std::isfinite(variance))
        lines_.fail("the square root of the information gives no finite, positive covariance");
    }
    return covariance;
  }

  void read_edge() {
    expect_fields(12);
    const std::uint64_t from = lines_.whole(1, "pose"), to = lines_.whole(2, "pose");
    if (from == to) lines_.fail("an edge from pose " + std::to_string(from) + " to itself");
    Edge edge{{lines_.number(3, "dx"), lines_.number(4, "dy"), lines_.number(5, "dtheta")}, read_covariance<3>(6)};
    graph_.poses.insert({from, to});
    if (to < from) edge = inverse(edge);
    graph_.edges_again += !graph_.edges.emplace(PosePair(std::min(from, to), std::max(from, to)), edge).second;
  }

  void read_sighting() {
    expect_fields(8);
    const std::uint64_t pose = lines_.whole(1, "pose");
    cairn_observation observation{};
    observation.id = lines_.identity(2, "landmark");
    observation.z[0] = lines_.number(3, "dx");
    observation.z[1] = lines_.number(4, "dy");
    const std::array<double, 4> covariance = read_covariance<2>(5);
    std::copy(covariance.begin(), covariance.end(), observation.covariance);
    graph_.poses.insert(pose);
    if (seen_.insert({pose, observation.id}).second) {
      graph_.sightings[pose].push_back(observation);
    } else {
      ++graph_.sightings_again;
    }
  }

  TextLines lines_;
  Graph graph_;
  std::set<PosePair> seen_;  // pose and landmark
};

// The increment's error is additive in the axes of the body before, as the library takes it.
Increment increment_of(const Edge& edge) {
  constexpr std::size_t kAxis[3] = {0, 1, 5};  // x, y, yaw
  Increment increment{edge.motion.pose(), {}};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) increment.covariance[6 * kAxis[i] + kAxis[j]] = edge.covariance[3 * i + j];
  return increment;
}

// The chain of poses, each moved to from the one with the next lower number.
std::vector<Step> steps_of(const std::string& path, const Graph& graph) {
  std::vector<Step> steps;
  for (const std::uint64_t pose : graph.poses) {
    Step step;
    step.number = pose;
    if (!steps.empty()) {
      const std::uint64_t before = steps.back().number;
      const auto edge = graph.edges.find({before, pose});
      if (edge == graph.edges.end())
        throw LogError(path + ": no record EDGE2 leads from pose " + std::to_string(before) + " to pose " +
                       std::to_string(pose));
      step.increment = increment_of(edge->second);
    }
    const auto seen = graph.sightings.find(pose);
    if (seen != graph.sightings.end()) step.observations = seen->second;
    steps.push_back(std::move(step));
  }
  return steps;
}

std::string truth_path(const std::string& path) {
  const std::size_t dot = path.find_last_of("./");
  const std::size_t end = dot == std::string::npos || path[dot] == '/' ? path.size() : dot;
  return path.substr(0, end) + "_groundtruth" + path.substr(end);
}

// Adds up the true motions from the first pose on, and places each landmark from its first true sighting.
void add_truth(const Graph& truth, Log& log) {
  PlanarPose pose;
  for (Step& step : log.steps) {
    if (&step != &log.steps.front()) {
      const auto edge = truth.edges.find({(&step - 1)->number, step.number});
      if (edge == truth.edges.end()) return;
      pose = pose.compose(edge->second.motion);
    }
    step.truth = pose.pose();
    const auto seen = truth.sightings.find(step.number);
    if (seen == truth.sightings.end()) continue;
    for (const cairn_observation& sighting : seen->second) {
      const std::array<double, 2> p = pose.apply(sighting.z[0], sighting.z[1]);
      log.landmarks.emplace(sighting.id, std::array<double, 3>{p[0], p[1], 0});
    }
  }
}

void note_left_out(Log& log, std::size_t count, const std::string& what) {
  if (count > 0) log.notes.push_back("left out " + std::to_string(count) + " " + what);
}

}  // namespace

Log read_isam_log(const std::string& path, const std::string& text) {
  const Graph graph = Reader(path, text).read();
  Log log;
  log.format = "iSAM text log";
  log.planar = true;
  log.sensor = SensorKind::kCartesian;
  cairn_cartesian_init(&log.cartesian, sizeof log.cartesian, nullptr);
  log.steps = steps_of(path, graph);
  log.notes = graph.notes;
  // Earlier poses are no part of a filter's state.
  note_left_out(log, graph.edges.size() - (log.steps.size() - 1), "EDGE2 between poses that do not follow each other");
  note_left_out(log, graph.edges_again, "EDGE2 between two poses that already have one");
  note_left_out(log, graph.sightings_again, "LANDMARK of a landmark that the pose already has");
  const std::string beside = truth_path(path);
  std::error_code ignored;
  if (std::filesystem::exists(beside, ignored)) add_truth(Reader(beside, read_file(beside)).read(), log);
  return log;
}

}  // namespace cairn::program::logs
