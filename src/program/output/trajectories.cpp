// SPDX-License-Identifier: BSD-3-Clause
#include "program/output/trajectories.hpp"

#include <algorithm>
#include <cmath>

#include "program/library.hpp"
#include "program/output/output_file.hpp"

namespace cairn::program {

void Trajectories::add(double time, std::uint64_t number, const cairn_pose& pose,
                       const std::optional<cairn_pose>& truth) {
  times_.push_back(std::isnan(time) ? static_cast<double>(number) : time);
  online_.push_back(pose);
  truth_.push_back(truth);
}

void Trajectories::finish(const cairn_filter* filter) {
  std::uint64_t first = 0;
  check(cairn_filter_trajectory_range(filter, &first, nullptr, nullptr));
  if (first > 0) return;
  std::size_t count = 0;
  check(cairn_filter_trajectory(filter, 0, nullptr, 0, &count, nullptr));
  corrected_.resize(count);
  check(cairn_filter_trajectory(filter, 0, corrected_.data(), count, &count, nullptr));
}

std::optional<double> Trajectories::corrected_rmse() const {
  if (corrected_.empty()) return std::nullopt;
  double sum = 0;
  std::size_t scored = 0;
  for (std::size_t k = 0; k < truth_.size(); ++k) {
    if (!truth_[k]) continue;
    for (int i = 0; i < 3; ++i) sum += std::pow(truth_[k]->position[i] - corrected_[k].position[i], 2);
    ++scored;
  }
  if (scored == 0) return std::nullopt;
  return std::sqrt(sum / static_cast<double>(scored));
}

std::vector<Trajectories::Named> Trajectories::named() const {
  std::vector<Named> all = {
      {"trajectory_online", {}, {}}, {"trajectory_corrected", {}, {}}, {"trajectory_truth", {}, {}}};
  for (std::size_t k = 0; k < times_.size(); ++k) {
    all[0].add(times_[k], online_[k]);
    if (!corrected_.empty()) all[1].add(times_[k], corrected_[k]);
    if (truth_[k]) all[2].add(times_[k], *truth_[k]);
  }
  all.erase(std::remove_if(all.begin(), all.end(), [](const Named& one) { return one.poses.empty(); }), all.end());
  return all;
}

void Trajectories::write_tum(const std::string& folder, const std::string& prefix) const {
  for (const Named& one : named()) {
    OutputFile file(folder, prefix + one.name + ".tum", ' ');
    for (std::size_t k = 0; k < one.poses.size(); ++k) {
      const double* q = one.poses[k].quaternion;
      file.field(one.times[k]);
      file.fields(one.poses[k].position, 3);
      file.fields(q + 1, 3);
      file.field(q[0]);
      file.end();
    }
    file.close();
  }
}

void Trajectories::add_lines(GeoJson& file) const {
  for (const Named& one : named()) file.line(one.name, one.poses);
}

}  // namespace cairn::program
