// SPDX-License-Identifier: BSD-3-Clause
// The two forms of the neutral text log, in space and in the plane: the values of its records, and their noise.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "program/logs/log.hpp"
#include "program/logs/text_file.hpp"

namespace cairn::program::logs {

// Standard deviations: of the values of an increment, and of an observation.
struct NeutralNoise {
  std::vector<double> increment, observation;
};

// Values of a record are in the order of their names.
class NeutralForm {
 public:
  // The form of the log whose first record is that of `lines`: a planar log begins with its noise.
  static NeutralForm of(const TextLines& lines);

  bool planar() const { return planar_; }
  // Fields of a record, with its letter; 0 if no record has this letter.
  std::size_t fields(std::string_view letter) const;
  // Names of the values of a record.
  const std::vector<const char*>& pose() const { return pose_; }
  const std::vector<const char*>& increment() const { return increment_; }
  const std::vector<const char*>& observation() const { return observation_; }
  const std::vector<const char*>& position() const { return position_; }

  cairn_pose make_pose(const double* values) const;
  Increment make_increment(const double* values, const NeutralNoise& noise) const;
  // The noise of a log that does not tell it; empty in the plane.
  std::optional<NeutralNoise> usual_noise() const;
  // The sensor, with the usual noise.
  void equip(Log& log) const;

 private:
  explicit NeutralForm(bool planar);

  bool planar_;
  std::vector<const char*> pose_, increment_, observation_, position_;
};

}  // namespace cairn::program::logs
