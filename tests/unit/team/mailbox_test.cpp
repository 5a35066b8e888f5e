// SPDX-License-Identifier: BSD-3-Clause
// The mailbox without any filter: turns by time and number, gaps, farewells, returns, and answers to requests.
#include "team/mailbox.hpp"

#include <doctest/doctest.h>

#include "core/error.hpp"

using namespace cairn;

namespace {

MailboxOptions options_of(std::uint64_t vehicle) {
  MailboxOptions options;
  options.vehicle = vehicle;
  options.max_lag = 10.0;
  return options;
}

Packet step_of(std::uint64_t vehicle, std::uint64_t number, double time) {
  Packet packet;
  packet.vehicle = vehicle, packet.number = number, packet.time = time;
  return packet;
}

Packet farewell_of(std::uint64_t vehicle, std::uint64_t number, double time) {
  Packet packet = step_of(vehicle, number, time);
  packet.kind = PacketKind::leave;
  return packet;
}

Arrival give(Mailbox& mailbox, const Packet& packet) {
  const std::vector<std::uint8_t> bytes = encode(packet);
  PacketFault fault = PacketFault::none;
  PacketName name;
  return mailbox.receive(bytes.data(), bytes.size(), fault, name);
}

// The next packet to be sent, decoded.
Packet sent(Mailbox& mailbox) {
  Packet packet;
  REQUIRE(mailbox.next_packet() != nullptr);
  REQUIRE(decode(mailbox.next_packet()->data(), mailbox.next_packet()->size(), packet) == PacketFault::none);
  mailbox.drop_packet();
  return packet;
}

// Vehicles of the next turn; empty if there is none.
std::vector<std::uint64_t> turn(Mailbox& mailbox) {
  std::vector<Packet> packets;
  std::vector<std::uint64_t> vehicles;
  if (mailbox.next_turn(packets))
    for (const Packet& packet : packets) vehicles.push_back(packet.vehicle);
  return vehicles;
}

using Vehicles = std::vector<std::uint64_t>;

}  // namespace

TEST_CASE("mailbox: packets of one time come out together, by the vehicles' numbers") {
  Mailbox mailbox(options_of(5));
  mailbox.add(9);
  mailbox.add(2);
  mailbox.observe(1.0, {}, {});
  CHECK(give(mailbox, step_of(9, 0, 1.005)) == Arrival::waiting);
  CHECK(turn(mailbox).empty());  // vehicle 2 was not heard of
  CHECK(give(mailbox, step_of(2, 0, 0.5)) == Arrival::waiting);
  CHECK(turn(mailbox) == Vehicles{2});
  CHECK(turn(mailbox).empty());
  CHECK(mailbox.unsettled() == 1);
  CHECK(give(mailbox, step_of(2, 1, 1.0)) == Arrival::waiting);
  CHECK(turn(mailbox) == Vehicles{2, 5, 9});
  CHECK(mailbox.unsettled() == 0);
  CHECK(mailbox.counts().taken == 3);
}

TEST_CASE("mailbox: a teammate that is ahead waits for this vehicle's step") {
  Mailbox mailbox(options_of(1));
  mailbox.add(2);
  give(mailbox, step_of(2, 0, 1.0));
  CHECK(turn(mailbox).empty());
  mailbox.observe(1.0, {}, {});
  CHECK(turn(mailbox) == Vehicles{1, 2});
}

TEST_CASE("mailbox: a gap is given up after max_lag, and told once") {
  Mailbox mailbox(options_of(1));
  mailbox.add(2);
  give(mailbox, step_of(2, 3, 1.0));
  mailbox.observe(11.0, {}, {});
  CHECK_FALSE(mailbox.skip_overdue_gap());
  CHECK(turn(mailbox).empty());
  mailbox.observe(11.1, {}, {});
  CHECK(mailbox.skip_overdue_gap() == std::optional<std::uint64_t>(2));
  CHECK_FALSE(mailbox.skip_overdue_gap());
  CHECK(mailbox.counts().lost == 3);
  CHECK(turn(mailbox) == Vehicles{2});
}

TEST_CASE("mailbox: whoever is waited for comes before an overdue gap of a later member") {
  Mailbox mailbox(options_of(1));
  mailbox.add(2);
  mailbox.add(3);
  give(mailbox, step_of(3, 1, 0.0));
  give(mailbox, step_of(2, 1, 8.0));
  mailbox.observe(12.0, {}, {});
  CHECK_FALSE(mailbox.skip_overdue_gap());  // the gap of vehicle 2 is not overdue
  CHECK(mailbox.counts().lost == 0);
}

TEST_CASE("mailbox: a farewell has its turn, and the vehicle is no member after it") {
  Mailbox mailbox(options_of(1));
  mailbox.add(2);
  CHECK(give(mailbox, farewell_of(2, 1, 1.0)) == Arrival::waiting);
  CHECK(give(mailbox, step_of(2, 0, 1.0)) == Arrival::waiting);
  mailbox.observe(1.0, {}, {});
  CHECK(turn(mailbox) == Vehicles{1, 2});
  CHECK_FALSE(mailbox.remove_departed());
  std::vector<Packet> packets;
  CHECK(mailbox.next_turn(packets));
  CHECK(packets.empty());
  CHECK(mailbox.remove_departed() == std::optional<std::uint64_t>(2));
  CHECK_FALSE(mailbox.remove_departed());
  CHECK(mailbox.members() == Vehicles{1});
  CHECK(give(mailbox, step_of(2, 2, 2.0)) == Arrival::unknown);
}

TEST_CASE("mailbox: what was consumed once is not taken again after a return") {
  Mailbox mailbox(options_of(1));
  mailbox.add(2);
  give(mailbox, step_of(2, 0, 1.0));
  mailbox.observe(1.0, {}, {});
  CHECK(turn(mailbox) == Vehicles{1, 2});
  give(mailbox, step_of(2, 2, 3.0));
  mailbox.remove(2);
  CHECK_THROWS_AS(mailbox.remove(2), Error);
  CHECK_THROWS_AS(mailbox.remove(1), Error);
  for (int round = 0; round < 2; ++round) {
    mailbox.add(2);
    if (round == 0) mailbox.undo_add();  // which forgets nothing
  }
  CHECK_THROWS_AS(mailbox.add(2), Error);
  CHECK(give(mailbox, step_of(2, 0, 1.0)) == Arrival::repeated);
  CHECK(give(mailbox, step_of(2, 0, 1.5)) == Arrival::conflict);
  CHECK(give(mailbox, step_of(2, 2, 3.0)) == Arrival::waiting);  // the waiting packets were forgotten
  CHECK(mailbox.counts().conflict == 1);
}

TEST_CASE("mailbox: requests name what is missing, and are answered from the history") {
  MailboxOptions options = options_of(1);
  options.history = 3;
  Mailbox asking(options_of(2)), answering(options);
  asking.add(1);
  answering.add(2);
  for (int k = 0; k < 5; ++k) answering.observe(k, {}, {});
  std::vector<Packet> steps;
  for (int k = 0; k < 5; ++k) steps.push_back(sent(answering));
  give(asking, steps[4]);
  asking.ask_if_missing();
  const Packet request = sent(asking);
  CHECK(request.kind == PacketKind::request);
  CHECK((request.subject == 1 && request.first == 0 && request.count == 4));
  CHECK(give(answering, request) == Arrival::request);
  CHECK(sent(answering).number == 2);  // numbers 0 and 1 are no longer kept
  CHECK(sent(answering).number == 3);
  CHECK(answering.next_packet() == nullptr);
  CHECK(answering.counts().resent == 2);
}

TEST_CASE("mailbox: this vehicle's packet that comes back is told from another vehicle's") {
  Mailbox mailbox(options_of(1));
  mailbox.observe(1.0, {}, {});
  CHECK(give(mailbox, step_of(1, 0, 1.0)) == Arrival::own);
  CHECK(give(mailbox, step_of(1, 0, 2.0)) == Arrival::conflict);
  CHECK(give(mailbox, step_of(1, 1, 2.0)) == Arrival::conflict);
}

TEST_CASE("mailbox: motions are unsettled until their turn") {
  Mailbox mailbox(options_of(1));
  mailbox.add(2);
  const auto unsettled = [&] {
    std::vector<double> moved;
    mailbox.for_each_unsettled_motion(
        [&](const Increment<SE2>& motion) { moved.push_back(motion.T_before_after.translation().x()); });
    return moved;
  };
  for (int k = 1; k <= 3; ++k) {
    mailbox.move({SE2(SO2(), Vector2(k, 0.0)), Matrix3::Zero()});
    if (k < 3) mailbox.observe(k, {}, {});
  }
  CHECK(unsettled() == std::vector<double>{1, 2, 3});
  give(mailbox, step_of(2, 0, 1.0));
  CHECK(turn(mailbox) == Vehicles{1, 2});
  CHECK(unsettled() == std::vector<double>{2, 3});
  mailbox.leave();
  CHECK_THROWS_AS(mailbox.observe(9.0, {}, {}), Error);
  CHECK_THROWS_AS(mailbox.leave(), Error);
}

TEST_CASE("mailbox: requests do not fill the outbox") {
  MailboxOptions options = options_of(1);
  options.history = 100;
  Mailbox mailbox(options);
  mailbox.add(2);
  for (int k = 0; k < 5; ++k) mailbox.observe(k, {}, {});
  Packet request = step_of(2, 0, 0.0);
  request.kind = PacketKind::request;
  request.subject = 1;
  const auto ask_often = [&] {
    for (int k = 0; k < 1000; ++k) CHECK(give(mailbox, request) == Arrival::request);
  };
  ask_often();  // the steps themselves still wait
  for (int k = 0; k < 5; ++k) CHECK(sent(mailbox).number == static_cast<std::uint64_t>(k));
  CHECK(mailbox.next_packet() == nullptr);
  ask_often();
  CHECK(mailbox.counts().resent == 5);
  for (int k = 0; k < 5; ++k) CHECK(sent(mailbox).number == static_cast<std::uint64_t>(k));
  CHECK(mailbox.next_packet() == nullptr);
}

TEST_CASE("mailbox: one request to each teammate waits, and it is the newest one") {
  Mailbox mailbox(options_of(1));
  mailbox.add(2);
  mailbox.add(3);
  mailbox.observe(1.0, {}, {});
  CHECK(sent(mailbox).kind == PacketKind::data);
  give(mailbox, step_of(2, 3, 1.0));
  for (int k = 0; k < 100; ++k) mailbox.ask();
  give(mailbox, step_of(2, 2, 0.5));
  mailbox.ask();
  CHECK(mailbox.counts().requested == 2);
  const Packet first = sent(mailbox);
  CHECK((first.subject == 2 && first.count == 2));
  CHECK(sent(mailbox).subject == 3);
  CHECK(mailbox.next_packet() == nullptr);
  mailbox.ask();
  mailbox.remove(2);  // nobody asks for its packets any more
  CHECK(sent(mailbox).subject == 3);
  CHECK(mailbox.next_packet() == nullptr);
}

TEST_CASE("mailbox: an own time that is far ahead is refused until the next one confirms it") {
  Mailbox mailbox(options_of(1));
  const auto observe = [&](double time) { mailbox.observe(time, {}, {}); };
  observe(1.0);
  CHECK_THROWS_AS(observe(1e9), Error);
  CHECK_THROWS_AS(observe(1e9), Error);  // the same time confirms nothing
  CHECK(mailbox.counts().sent == 1);
  observe(2.0);
  CHECK_THROWS_AS(observe(500.0), Error);  // a long pause
  CHECK_THROWS_AS(observe(600.0), Error);
  observe(601.0);
  CHECK(mailbox.counts().sent == 3);
  CHECK_THROWS_AS(observe(601.0), Error);
}

TEST_CASE("mailbox: the first own time is compared with those of the teammates") {
  Mailbox mailbox(options_of(1));
  mailbox.add(2);
  give(mailbox, step_of(2, 0, 100.0));
  CHECK_THROWS_AS(mailbox.observe(1e9, {}, {}), Error);
  mailbox.observe(100.0, {}, {});
  CHECK(turn(mailbox) == Vehicles{1, 2});
}

TEST_CASE("mailbox: a teammate's packet that is far ahead locks out no later one") {
  Mailbox mailbox(options_of(1));
  mailbox.add(2);
  mailbox.observe(1.0, {}, {});
  CHECK(give(mailbox, step_of(2, 0, 1.0)) == Arrival::waiting);
  CHECK(turn(mailbox) == Vehicles{1, 2});
  for (int k = 0; k < 2; ++k) CHECK(give(mailbox, step_of(2, 1, 1e9)) == Arrival::ahead);
  CHECK(give(mailbox, step_of(2, 2, 3.0)) == Arrival::waiting);
  CHECK(mailbox.counts().ahead == 2);
  mailbox.observe(20.0, {}, {});  // more than max_lag later the wrong packet is given up
  CHECK(mailbox.skip_overdue_gap() == std::optional<std::uint64_t>(2));
  CHECK(turn(mailbox) == Vehicles{2});
}

TEST_CASE("mailbox: two packets that agree are right, and the first one can come again") {
  Mailbox mailbox(options_of(1));
  mailbox.add(2);
  mailbox.observe(1.0, {}, {});
  CHECK(give(mailbox, step_of(2, 0, 1.0)) == Arrival::waiting);
  CHECK(give(mailbox, step_of(2, 1, 500.0)) == Arrival::ahead);
  CHECK(give(mailbox, step_of(2, 2, 501.0)) == Arrival::waiting);
  CHECK(give(mailbox, step_of(2, 1, 500.0)) == Arrival::waiting);
}

// The first packet of a teammate has nothing to be compared with before this vehicle made a step.
TEST_CASE("mailbox: a first packet with a wrong time is dropped when two later ones agree") {
  Mailbox mailbox(options_of(1));
  mailbox.add(2);
  CHECK(give(mailbox, step_of(2, 0, 1e9)) == Arrival::waiting);
  CHECK(give(mailbox, step_of(2, 1, 2.0)) == Arrival::past);
  CHECK(give(mailbox, step_of(2, 2, 3.0)) == Arrival::waiting);
  CHECK(give(mailbox, step_of(2, 1, 2.0)) == Arrival::waiting);
  CHECK(give(mailbox, step_of(2, 0, 1e9)) == Arrival::past);
}

TEST_CASE("mailbox: a motion beyond any vehicle's is refused") {
  Mailbox mailbox(options_of(1));
  const auto move = [&](double x, double variance, double turn) {
    Matrix3 C = Vector3(variance, variance, turn).asDiagonal();
    mailbox.move({SE2(SO2(), Vector2(x, 0.0)), C});
  };
  move(1e9, 1e18, 39.0);
  CHECK_THROWS_AS(move(1e10, 1.0, 0.1), Error);
  CHECK_THROWS_AS(move(1.0, 1e308, 0.1), Error);
  CHECK_THROWS_AS(move(1.0, 1.0, 40.0), Error);
}
