// SPDX-License-Identifier: BSD-3-Clause
#include "team/team.hpp"

#include <algorithm>
#include <new>

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
    : options_(options), mailbox_(mailbox_options(options)), cooperation_(Cooperation::create(options)) {
  packets_.reserve(options.mail.max_vehicles);
}

void Team::add(std::uint64_t vehicle) {
  finish_turn();
  cooperation_->add(vehicle);
  mailbox_.add(vehicle);
}

void Team::add(std::uint64_t vehicle, const SE2& start, const Matrix3& covariance) {
  finish_turn();
  mailbox_.add(vehicle);
  try {
    cooperation_->add(vehicle, start, covariance);
  } catch (...) {
    mailbox_.undo_add();
    throw;
  }
}

void Team::remove(std::uint64_t vehicle) {
  finish_turn();
  mailbox_.remove(vehicle);
  cooperation_->lose_sight(vehicle);
  take_turns();  // nobody waits for this vehicle any longer
}

std::optional<Error> Team::observe(double time, std::vector<Observation> landmarks, std::vector<Observation> vehicles) {
  const std::size_t count = landmarks.size() + vehicles.size();
  if (count > static_cast<std::size_t>(options_.filter.max_observations))
    throw Error(ErrorCode::capacity, "count: %zu observations, and max_observations is %td", count,
                options_.filter.max_observations);
  finish_turn();
  mailbox_.observe(time, std::move(landmarks), std::move(vehicles));
  cooperation_->forget_own_error();
  asking_ = true;
  take_turns();
  return cooperation_->own_error();
}

void Team::leave() {
  finish_turn();
  mailbox_.leave();
  take_turns();  // teammates' packets no longer wait for a step of this vehicle
}

Arrival Team::receive(const std::uint8_t* bytes, std::size_t size, PacketFault& fault) {
  finish_turn();
  PacketName name;
  const Arrival stored = mailbox_.receive(bytes, size, fault, name);
  if (stored != Arrival::waiting) return stored;
  take_turns();
  return mailbox_.outcome(name);
}

void Team::ask() {
  finish_turn();
  mailbox_.ask();
}

// Memory ran out in a turn. Nothing may happen before the rest of it was taken.
void Team::finish_turn() {
  if (!interrupted_) return;
  take_turns();
  if (interrupted_) throw std::bad_alloc();
}

void Team::take_turns() noexcept {
  for (;;) {
    if (!interrupted_) {
      while (const auto lost = mailbox_.skip_overdue_gap()) cooperation_->lose_sight(*lost);
      if (!mailbox_.next_turn(packets_)) break;
    }
    interrupted_ = !(interrupted_ ? cooperation_->resume(packets_) : cooperation_->take(packets_));
    if (interrupted_) return;
    while (const auto left = mailbox_.remove_departed()) cooperation_->lose_sight(*left);
  }
  if (asking_) mailbox_.ask_if_missing();
  asking_ = false;
}

const Packet* Team::untaken_own_step() const {
  for (std::size_t t = cooperation_->taken(); interrupted_ && t < packets_.size(); ++t)
    if (packets_[t].vehicle == options_.mail.vehicle) return &packets_[t];
  return nullptr;
}

std::size_t Team::unsettled() const {
  return mailbox_.unsettled() + (untaken_own_step() != nullptr);
}

VehicleEstimate Team::estimate(std::uint64_t vehicle) const {
  VehicleEstimate now = cooperation_->estimate(vehicle);
  if (vehicle != options_.mail.vehicle) return now;
  const auto move = [&](const Increment<SE2>& motion) {
    now.covariance = ProductJacobians(now.pose, motion.T_before_after).covariance(now.covariance, motion.covariance);
    now.pose = now.pose * motion.T_before_after;
  };
  if (const Packet* step = untaken_own_step())
    for (const Increment<SE2>& motion : step->motions) move(motion);
  mailbox_.for_each_unsettled_motion(move);
  return now;
}

double Team::pose_nees(const SE2& truth) const {
  const VehicleEstimate now = estimate(options_.mail.vehicle);
  return State<SE2>::nees(options_.filter.error, options_.filter.initial_pose.translation(), truth, now.pose,
                          now.covariance);
}

}  // namespace cairn
