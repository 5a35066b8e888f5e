// SPDX-License-Identifier: BSD-3-Clause
// The frame of the reference filter: gates by exhaustive search, and placing of new landmarks.
#include <Eigen/Cholesky>
#include <algorithm>
#include <stdexcept>

#include "core/chi_square.hpp"
#include "reference_filter.hpp"

namespace cairn::test {
namespace {

using Eigen::Index;

Vector2 mount_of(const ReferenceState& x) {
  return x.mount.empty() ? Vector2(0, 0) : Vector2(x.mount[0], x.mount[1]);
}

double squared_distance(const DynamicVector& r, const Dynamic& S) {
  return r.dot(S.llt().solve(r));
}

// The rows of some observations from the rows of all.
Dynamic choose(const std::vector<std::size_t>& which, Index rows, std::size_t all) {
  Dynamic select = Dynamic::Zero(rows * static_cast<Index>(which.size()), rows * static_cast<Index>(all));
  for (std::size_t i = 0; i < which.size(); ++i)
    for (Index r = 0; r < rows; ++r)
      select(rows * static_cast<Index>(i) + r, rows * static_cast<Index>(which[i]) + r) = 1;
  return select;
}

}  // namespace

bool ReferenceFilter::compare(const Sensor<SE3>& sensor, const Seen& seen, const ReferenceState& x,
                              Vector3& residual) const {
  Prediction<SE3> prediction;
  const std::size_t landmark = static_cast<std::size_t>(find(seen.id));
  if (!sensor.predict(x.pose, x.landmarks[landmark], mount_of(x), prediction)) return false;
  residual = sensor.residual(seen.z, prediction.z);
  return true;
}

ReferenceFilter::Residual ReferenceFilter::frame_residual(const Sensor<SE3>& sensor,
                                                          const std::vector<Seen>& frame) const {
  return [this, &sensor, frame](const ReferenceState& x, DynamicVector& out) {
    const Index rows = sensor.rows();
    out.resize(rows * static_cast<Index>(frame.size()));
    for (std::size_t i = 0; i < frame.size(); ++i) {
      Vector3 r;
      if (!compare(sensor, frame[i], x, r)) return false;
      out.segment(rows * static_cast<Index>(i), rows) = r.head(rows);
    }
    return true;
  };
}

// Noise of the observations, plus the noise of the mount angles if each observation has its own.
Dynamic ReferenceFilter::frame_noise(const Sensor<SE3>& sensor, const std::vector<Seen>& frame,
                                     const ReferenceState& x) const {
  const Index rows = sensor.rows(), m = rows * static_cast<Index>(frame.size());
  Dynamic R = Dynamic::Zero(m, m);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    Dynamic noise = frame[i].noise.topLeftCorner(rows, rows);
    if (sensor.mount_noise_mode() == MountNoise::per_observation) {
      const Vector3& l = x.landmarks[static_cast<std::size_t>(find(frame[i].id))];
      Prediction<SE3> at, moved;
      sensor.predict(x.pose, l, Vector2::Zero(), at);
      const Dynamic J = differentiate(
          [&](const DynamicVector& angles) {
            sensor.predict(x.pose, l, angles, moved);
            return DynamicVector(sensor.residual(moved.z, at.z).head(rows));
          },
          2);
      noise += J * sensor.mount_noise() * J.transpose();
    }
    R.block(rows * static_cast<Index>(i), rows * static_cast<Index>(i), rows, rows) = noise;
  }
  return R;
}

// Each observation is tested by itself, then all together. While the joint test fails, the observation is removed
// without which the others fit best.
void ReferenceFilter::gate(const Sensor<SE3>& sensor, const std::vector<Seen>& known, std::vector<std::size_t>& kept,
                           std::vector<double>& distance) const {
  kept.clear();
  if (known.empty()) return;
  const Index rows = sensor.rows();
  const Residual residual = frame_residual(sensor, known);
  DynamicVector r;
  residual(state_, r);
  const Dynamic H = differentiate(
      [&](const DynamicVector& error) {
        DynamicVector moved;
        residual(retract(state_, error), moved);
        return DynamicVector(-moved);
      },
      state_.size());
  const Dynamic S = H * P_ * H.transpose() + frame_noise(sensor, known, state_);
  const auto distance_of = [&](const std::vector<std::size_t>& which) {
    const Dynamic select = choose(which, rows, known.size());
    return squared_distance(select * r, select * S * select.transpose());
  };
  for (std::size_t i = 0; i < known.size(); ++i) {
    distance[i] = distance_of({i});
    if (options_.gate >= 1 || distance[i] <= chi_square_quantile(static_cast<double>(rows), options_.gate))
      kept.push_back(i);
  }
  if (options_.batch_gate >= 1) return;
  while (!kept.empty() &&
         distance_of(kept) >
             chi_square_quantile(static_cast<double>(rows) * static_cast<double>(kept.size()), options_.batch_gate)) {
    std::vector<std::size_t> best;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      std::vector<std::size_t> without = kept;
      without.erase(without.begin() + static_cast<std::ptrdiff_t>(i));
      if (i == 0 || (!without.empty() && distance_of(without) < distance_of(best))) best = without;
    }
    kept = best;
  }
}

// Error of a new landmark as a function of everything it depends on: the whole state, and the noise of the observation.
bool ReferenceFilter::place(const Sensor<SE3>& sensor, const Seen& seen) {
  const Index rows = sensor.rows();
  const bool own_mount = sensor.mount_noise_mode() == MountNoise::per_observation;
  const auto placed = [&](const ReferenceState& x, const DynamicVector& noise, ReferenceState& out) {
    Vector3 z = seen.z;
    z.head(rows) += noise.head(rows);
    Vector2 mount = mount_of(x);
    if (own_mount) mount += noise.tail<2>();
    Placement<SE3> placement;
    if (!sensor.place(x.pose, z, mount, placement)) return false;
    out = x;
    out.landmarks.push_back(placement.landmark);
    return true;
  };
  const Index noises = rows + (own_mount ? 2 : 0), n = state_.size(), at = n - static_cast<Index>(state_.mount.size());
  ReferenceState next;
  if (!placed(state_, DynamicVector::Zero(noises), next)) return false;
  const auto error_of = [&](const ReferenceState& x, const DynamicVector& noise) {
    ReferenceState moved;
    if (!placed(x, noise, moved)) throw std::runtime_error("no place beside the placement");
    return local(next, moved);
  };
  const Dynamic F = differentiate(
      [&](const DynamicVector& error) { return error_of(retract(state_, error), DynamicVector::Zero(noises)); }, n);
  const Dynamic G = differentiate([&](const DynamicVector& noise) { return error_of(state_, noise); }, noises);
  Dynamic Q = Dynamic::Zero(noises, noises);
  Q.topLeftCorner(rows, rows) = seen.noise.topLeftCorner(rows, rows);
  if (own_mount) Q.bottomRightCorner(2, 2) = sensor.mount_noise();
  P_ = (F * P_ * F.transpose() + G * Q * G.transpose()).eval();
  state_ = next;
  ids_.insert(ids_.begin() + (at - 6) / 3, seen.id);
  return true;
}

FrameResult ReferenceFilter::update_frame(const Sensor<SE3>& sensor, const std::vector<Seen>& frame) {
  FrameResult result;
  std::vector<std::size_t> number, fresh, kept;
  std::vector<Seen> known, taken;
  Vector3 ignored;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (find(frame[i].id) < 0) {
      fresh.push_back(i);
    } else if (compare(sensor, frame[i], state_, ignored)) {
      known.push_back(frame[i]);
      number.push_back(i);
    }
  }
  if (sensor.mount_noise_mode() == MountNoise::per_frame) {
    const Index n = state_.size();
    Dynamic P = Dynamic::Zero(n + 2, n + 2);
    P.topLeftCorner(n, n) = P_;
    P.bottomRightCorner(2, 2) = sensor.mount_noise();
    P_ = P;
    state_.mount = {0, 0};
  }

  std::vector<double> distance(known.size(), -1);
  gate(sensor, known, kept, distance);
  for (std::size_t i : kept) taken.push_back(known[i]);
  if (!taken.empty())
    result = update(
        frame_residual(sensor, taken), [&](const ReferenceState& x) { return frame_noise(sensor, taken, x); },
        sensor.relative() ? 1 : 2, options_.iterations);
  result.distance.assign(frame.size(), -1);
  result.taken.assign(frame.size(), false);
  for (std::size_t i = 0; i < known.size(); ++i) result.distance[number[i]] = distance[i];
  for (std::size_t i : kept) result.taken[number[i]] = true;
  for (std::size_t i : fresh) result.taken[i] = place(sensor, frame[i]);

  const Index n = state_.size() - static_cast<Index>(state_.mount.size());
  P_ = P_.topLeftCorner(n, n).eval();
  state_.mount.clear();
  return result;
}

}  // namespace cairn::test
