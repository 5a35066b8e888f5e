// SPDX-License-Identifier: BSD-3-Clause
// The neutral text log: one record a line, SI units, fields separated by blanks.
//   N sdx sdy sdz sdroll sdpitch sdyaw srange sazimuth selevation   standard deviations, of the records that follow
//   T k t x y z roll pitch yaw                                      true pose at step k
//   O k dx dy dz droll dpitch dyaw                                  measured increment from step k-1 to k, body frame
//   Z k id range azimuth elevation                                  observation of a landmark, in the body frame
//   L id x y z                                                      true landmark
// The same in the plane; N comes first:
//   N sdx sdy sdheading srange sbearing
//   T k t x y heading
//   O k dx dy dheading
//   Z k id range bearing
//   L id x y
// Empty lines are skipped, and # begins a comment.
#include <cmath>
#include <limits>
#include <unordered_set>

#include "program/logs/log.hpp"
#include "program/logs/neutral_form.hpp"
#include "program/logs/text_file.hpp"

namespace cairn::program::logs {
namespace {

class Reader {
 public:
  Reader(const std::string& path, const std::string& text) : lines_(path, text) {}

  Log read() {
    while (lines_.next()) {
      if (!form_) begin();
      read_record();
    }
    if (log_.steps.empty()) fail("no record T, O or Z: the log has no steps");
    finish_step();
    lines_.note_missing_end(log_.notes);
    return std::move(log_);
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const { lines_.fail(cause); }
  std::string text(std::size_t index) const { return std::string(lines_.field(index)); }
  double number(std::size_t index, const char* name) const { return lines_.number(index, name); }
  std::uint64_t identity(std::size_t index) const { return lines_.identity(index, "id"); }

  void begin() {
    form_ = NeutralForm::of(lines_);
    form_->equip(log_);
    noise_ = form_->usual_noise();
  }

  void read_record() {
    const std::string_view letter = lines_.field(0);
    const std::size_t fields = form_->fields(letter);
    if (fields == 0) fail("unknown record " + TextLines::quoted(letter) + ", expected N, T, O, Z or L");
    if (lines_.size() != fields)
      fail("record " + text(0) + " has " + std::to_string(lines_.size()) + " fields, expected " +
           std::to_string(fields));
    if (letter == "T") {
      read_truth();
    } else if (letter == "O") {
      read_increment();
    } else if (letter == "Z") {
      read_observation();
    } else if (letter == "L") {
      read_landmark();
    } else {
      read_noise();
    }
  }

  // The values from field `first` on.
  std::vector<double> values(std::size_t first, const std::vector<const char*>& names) const {
    std::vector<double> out;
    for (const char* name : names) out.push_back(number(first++, name));
    return out;
  }

  // Goes to the step that field 1 names: the current one, or the next.
  Step& enter_step() {
    const std::uint64_t k = lines_.whole(1, "step");
    if (log_.steps.empty()) {
      // Without a true pose the log may begin with the first motion: the step before it is the start.
      if (lines_.field(0) == "O" && k > 0) add_step(k - 1);
    } else {
      const std::uint64_t current = log_.steps.back().number;
      if (k == current) return log_.steps.back();
      if (k < current) fail("step " + std::to_string(k) + " comes after step " + std::to_string(current));
      if (k - current > 1) {
        fail("step " + std::to_string(k) + " follows step " + std::to_string(current) + ": steps are missing");
      }
      finish_step();
    }
    return add_step(k);
  }

  Step& add_step(std::uint64_t number) {
    log_.steps.emplace_back();
    log_.steps.back().number = number;
    seen_.clear();
    return log_.steps.back();
  }

  void finish_step() const {
    const Step& step = log_.steps.back();
    if (log_.steps.size() > 1 && !step.increment) {
      fail("step " + std::to_string(step.number) + " ends here without an increment (O)");
    }
  }

  void read_noise() {
    NeutralNoise noise{values(1, form_->increment()), values(1 + form_->increment().size(), form_->observation())};
    for (const double sigma : noise.increment)
      if (!(sigma >= 0) || !std::isfinite(sigma * sigma)) fail("noise of an increment is negative or too large");
    for (const double sigma : noise.observation)
      if (!(sigma > 0 && sigma * sigma > 0) || !std::isfinite(sigma * sigma))
        fail("noise of an observation is not positive, or too large or too small");
    noise_ = noise;
    told_ = true;
  }

  void read_truth() {
    Step& step = enter_step();
    if (step.truth) fail("second true pose of step " + std::to_string(step.number));
    if (&step != &log_.steps.front() && !log_.steps.front().truth)
      fail("true pose of step " + std::to_string(step.number) + ", but step " +
           std::to_string(log_.steps.front().number) + ", the first one, has none: the start is unknown");
    step.time = number(2, "time");
    if (step.time <= last_time_) fail("time " + text(2) + " does not increase");
    last_time_ = step.time;
    step.truth = form_->make_pose(values(3, form_->pose()).data());
  }

  void read_increment() {
    Step& step = enter_step();
    if (log_.steps.size() == 1) fail("increment (O) to the first step: there is none before it");
    if (step.increment) fail("second increment of step " + std::to_string(step.number));
    step.increment = form_->make_increment(values(2, form_->increment()).data(), *noise_);
  }

  void read_observation() {
    Step& step = enter_step();
    cairn_observation observation{};
    observation.id = identity(2);
    const std::vector<double> z = values(3, form_->observation());
    std::copy(z.begin(), z.end(), observation.z);
    if (!(observation.z[0] > 0)) fail("range " + text(3) + " is not positive");
    for (std::size_t i = 0; told_ && i < z.size(); ++i)
      observation.covariance[(z.size() + 1) * i] = noise_->observation[i] * noise_->observation[i];
    if (!seen_.insert(observation.id).second) {
      fail("landmark " + std::to_string(observation.id) + " twice in step " + std::to_string(step.number));
    }
    step.observations.push_back(observation);
  }

  void read_landmark() {
    const std::uint64_t id = identity(1);
    std::vector<double> position = values(2, form_->position());
    position.resize(3, 0);
    if (!log_.landmarks.emplace(id, std::array<double, 3>{position[0], position[1], position[2]}).second)
      fail("landmark " + std::to_string(id) + " a second time");
  }

  TextLines lines_;
  Log log_;
  std::optional<NeutralForm> form_;
  std::optional<NeutralNoise> noise_;
  bool told_ = false;                       // the log tells its noise
  std::unordered_set<std::uint64_t> seen_;  // ids of the current step
  double last_time_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

Log read_neutral_log(const std::string& path, const std::string& text) {
  return Reader(path, text).read();
}

}  // namespace cairn::program::logs
