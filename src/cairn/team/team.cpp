// SPDX-License-Identifier: BSD-3-Clause
#include "team/team.hpp"

#include <algorithm>

#include "ekf/state.hpp"

namespace cairn {
namespace {

MailboxOptions mailbox_options(const TeamOptions& options) {
  MailboxOptions mail = options.mail;
  mail.listens = options.mode != TeamMode::mono;
  mail.named = options.filter.association == AssociationKind::known;
  return mail;
}

}  // namespace

Team::Team(const TeamOptions& options)
    : options_(options), mailbox_(mailbox_options(options)), cooperation_(Cooperation::create(options)) {}

void Team::add(std::uint64_t vehicle) {
  cooperation_->add(vehicle);
  mailbox_.add(vehicle);
}

void Team::add(std::uint64_t vehicle, const SE2& start, const Matrix3& covariance) {
  mailbox_.add(vehicle);
  try {
    cooperation_->add(vehicle, start, covariance);
  } catch (...) {
    mailbox_.undo_add();
    throw;
  }
}

void Team::remove(std::uint64_t vehicle) {
  mailbox_.remove(vehicle);
  cooperation_->lose_sight(vehicle);
  take_turns();  // nobody waits for this vehicle any longer
}

std::optional<Error> Team::observe(double time, std::vector<Observation> landmarks, std::vector<Observation> vehicles) {
  const std::size_t count = landmarks.size() + vehicles.size();
  if (count > static_cast<std::size_t>(options_.filter.max_observations))
    throw Error(ErrorCode::capacity, "count: %zu observations, and max_observations is %td", count,
                options_.filter.max_observations);
  mailbox_.observe(time, std::move(landmarks), std::move(vehicles));
  cooperation_->forget_own_error();
  take_turns();
  mailbox_.ask_if_missing();
  return cooperation_->own_error();
}

void Team::leave() {
  mailbox_.leave();
  take_turns();  // teammates' packets no longer wait for a step of this vehicle
}

Arrival Team::receive(const std::uint8_t* bytes, std::size_t size, PacketFault& fault) {
  PacketName name;
  const Arrival stored = mailbox_.receive(bytes, size, fault, name);
  if (stored != Arrival::waiting) return stored;
  take_turns();
  return mailbox_.outcome(name);
}

void Team::take_turns() {
  std::vector<Packet> packets;
  for (;;) {
    while (const auto lost = mailbox_.skip_overdue_gap()) cooperation_->lose_sight(*lost);
    if (!mailbox_.next_turn(packets)) return;
    cooperation_->take(packets);
    while (const auto left = mailbox_.remove_departed()) cooperation_->lose_sight(*left);
  }
}

VehicleEstimate Team::estimate(std::uint64_t vehicle) const {
  VehicleEstimate now = cooperation_->estimate(vehicle);
  if (vehicle != options_.mail.vehicle) return now;
  mailbox_.for_each_unsettled_motion([&](const Increment<SE2>& motion) {
    now.covariance = ProductJacobians(now.pose, motion.T_before_after).covariance(now.covariance, motion.covariance);
    now.pose = now.pose * motion.T_before_after;
  });
  return now;
}

double Team::pose_nees(const SE2& truth) const {
  const VehicleEstimate now = estimate(options_.mail.vehicle);
  return State<SE2>::nees(options_.filter.error, options_.filter.initial_pose.translation(), truth, now.pose,
                          now.covariance);
}

}  // namespace cairn
