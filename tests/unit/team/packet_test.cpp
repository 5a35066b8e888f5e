// SPDX-License-Identifier: BSD-3-Clause
// Packets as bytes: decoding returns the encoded values to the bit; the layout as documented; and limits.
#include "team/packet.hpp"

#include <doctest/doctest.h>

#include <cstring>
#include <limits>

#include "numerical.hpp"

using namespace cairn;
using namespace cairn::test;

namespace {

std::uint64_t bits(double value) {
  std::uint64_t out;
  std::memcpy(&out, &value, sizeof out);
  return out;
}

Increment<SE2> random_motion(Random& random) {
  Increment<SE2> motion;
  motion.T_before_after = SE2(SO2::from_angle(random.uniform(-3.2, 3.2)), Vector2(random.normal_vector<2>()));
  Matrix3 A = Matrix3::Identity();
  for (int i = 0; i < 3; ++i) A.col(i) += 0.3 * random.normal_vector<3>();
  const Matrix3 C = 0.01 * A * A.transpose();
  motion.covariance = 0.5 * (C + C.transpose());
  return motion;
}

Observation random_sight(Random& random, std::uint64_t id) {
  Observation o{};
  o.id = id;
  o.z[0] = random.uniform(0, 5000), o.z[1] = random.uniform(-3.2, 3.2);
  if (random.uniform(0, 1) < 0.5) {
    o.covariance[0] = random.uniform(1, 900), o.covariance[3] = random.uniform(1e-6, 1e-3);
    o.covariance[1] = o.covariance[2] = 0.5 * random.uniform(-1, 1) * std::sqrt(o.covariance[0] * o.covariance[3]);
  }
  return o;
}

Packet any_packet(Random& random, std::size_t motions, std::size_t landmarks, std::size_t vehicles) {
  Packet packet;
  packet.vehicle = 0x0102030405060708u, packet.number = 0x1112131415161718u, packet.time = random.uniform(-1e9, 1e9);
  for (std::size_t i = 0; i < motions; ++i) packet.motions.push_back(random_motion(random));
  for (std::size_t i = 0; i < landmarks; ++i) packet.landmarks.push_back(random_sight(random, 3 * i));
  for (std::size_t i = 0; i < vehicles; ++i) packet.vehicles.push_back(random_sight(random, i));
  return packet;
}

bool same(const std::vector<Observation>& a, const std::vector<Observation>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].id != b[i].id) return false;
    for (int k = 0; k < 3; ++k)
      if (bits(a[i].z[k]) != bits(b[i].z[k])) return false;
    for (int k = 0; k < 9; ++k)
      if (bits(a[i].covariance[k]) != bits(b[i].covariance[k])) return false;
  }
  return true;
}

bool same(const Packet& a, const Packet& b) {
  if (a.kind != b.kind || a.vehicle != b.vehicle || a.number != b.number || bits(a.time) != bits(b.time)) return false;
  if (a.subject != b.subject || a.first != b.first || a.count != b.count) return false;
  if (a.motions.size() != b.motions.size()) return false;
  for (std::size_t i = 0; i < a.motions.size(); ++i) {
    const SE2 &A = a.motions[i].T_before_after, &B = b.motions[i].T_before_after;
    const Matrix2 RA = A.rotation().matrix(), RB = B.rotation().matrix();
    for (int k = 0; k < 2; ++k)
      if (bits(A.translation()[k]) != bits(B.translation()[k]) || bits(RA(k, 0)) != bits(RB(k, 0))) return false;
    for (int k = 0; k < 9; ++k)
      if (bits(a.motions[i].covariance(k)) != bits(b.motions[i].covariance(k))) return false;
  }
  return same(a.landmarks, b.landmarks) && same(a.vehicles, b.vehicles);
}

std::uint64_t number_at(const std::vector<std::uint8_t>& bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value |= static_cast<std::uint64_t>(bytes[at + i]) << (8 * i);
  return value;
}

PacketFault fault_of(const std::vector<std::uint8_t>& bytes) {
  Packet unused;
  return decode(bytes.data(), bytes.size(), unused);
}

}  // namespace

TEST_CASE("packet: the checksum's check value") {
  const char* check = "123456789";
  CHECK(crc32(reinterpret_cast<const std::uint8_t*>(check), 9) == 0xCBF43926u);
  CHECK(crc32(nullptr, 0) == 0);
}

TEST_CASE("packet: what goes in comes out, to the bit") {
  Random random(1);
  const std::size_t counts[] = {0, 1, 2, 17};
  for (std::size_t motions : counts)
    for (std::size_t landmarks : counts)
      for (std::size_t vehicles : counts) {
        const Packet packet = any_packet(random, motions, landmarks, vehicles);
        const std::vector<std::uint8_t> bytes = encode(packet);
        CHECK(bytes.size() == 36 + 12 + 80 * motions + 48 * (landmarks + vehicles) + 4);
        Packet back;
        REQUIRE(decode(bytes.data(), bytes.size(), back) == PacketFault::none);
        CHECK(same(packet, back));
        CHECK(encode(back) == bytes);
      }
}

TEST_CASE("packet: requests and farewells") {
  Packet packet;
  packet.kind = PacketKind::request;
  packet.vehicle = UINT64_MAX - 1, packet.number = 3, packet.time = -0.0;
  packet.subject = 5, packet.first = UINT64_MAX, packet.count = 1u << 31;
  Packet back;
  std::vector<std::uint8_t> bytes = encode(packet);
  CHECK(bytes.size() == 36 + 24 + 4);
  REQUIRE(decode(bytes.data(), bytes.size(), back) == PacketFault::none);
  CHECK(same(packet, back));
  packet = Packet();
  packet.kind = PacketKind::leave;
  packet.vehicle = 4, packet.number = 9, packet.time = 12.5;
  bytes = encode(packet);
  REQUIRE(decode(bytes.data(), bytes.size(), back) == PacketFault::none);
  CHECK(same(packet, back));
}

TEST_CASE("packet: the layout, little-endian") {
  Random random(2);
  const Packet packet = any_packet(random, 1, 1, 1);
  const std::vector<std::uint8_t> bytes = encode(packet);
  CHECK(std::memcmp(bytes.data(), "CRNP", 4) == 0);
  CHECK(number_at(bytes, 4, 2) == kPacketVersion);
  CHECK(number_at(bytes, 6, 2) == 1);
  CHECK(number_at(bytes, 8, 4) == bytes.size());
  CHECK(number_at(bytes, 12, 8) == packet.vehicle);
  CHECK(bytes[12] == 0x08);
  CHECK(number_at(bytes, 20, 8) == packet.number);
  CHECK(number_at(bytes, 28, 8) == bits(packet.time));
  for (std::size_t i = 0; i < 3; ++i) CHECK(number_at(bytes, 36 + 4 * i, 4) == 1);
  const Increment<SE2>& motion = packet.motions[0];
  const Vector2 u = motion.T_before_after.rotation().matrix().col(0);
  const Matrix3& C = motion.covariance;
  const double values[10] = {motion.T_before_after.translation().x(),
                             motion.T_before_after.translation().y(),
                             u.x(),
                             u.y(),
                             C(0, 0),
                             C(1, 0),
                             C(2, 0),
                             C(1, 1),
                             C(2, 1),
                             C(2, 2)};
  for (std::size_t i = 0; i < 10; ++i) CHECK(number_at(bytes, 48 + 8 * i, 8) == bits(values[i]));
  CHECK(number_at(bytes, 128, 8) == packet.landmarks[0].id);
  CHECK(number_at(bytes, 136, 8) == bits(packet.landmarks[0].z[0]));
  CHECK(number_at(bytes, 176, 8) == packet.vehicles[0].id);
  CHECK(number_at(bytes, bytes.size() - 4, 4) == crc32(bytes.data(), bytes.size() - 4));
}

TEST_CASE("packet: two of different content differ in what tells them apart") {
  // The CRC over a packet together with its own checksum is the same number for all packets. Only the CRC of the rest
  // distinguishes packets.
  Random random(3);
  const std::vector<std::uint8_t> a = encode(any_packet(random, 1, 2, 1)), b = encode(any_packet(random, 1, 2, 1));
  CHECK(crc32(a.data(), a.size()) == crc32(b.data(), b.size()));
  CHECK(crc32(a.data(), a.size() - 4) != crc32(b.data(), b.size() - 4));
}

TEST_CASE("packet: as much as it has room for, and no more") {
  Random random(4);
  Packet packet = any_packet(random, 0, 0, 0);
  const Increment<SE2> motion = random_motion(random);
  const Observation sight = random_sight(random, 0);
  const auto with = [&](std::size_t motions, std::size_t landmarks, std::size_t vehicles) {
    packet.motions.assign(motions, motion);
    packet.landmarks.assign(landmarks, sight);
    packet.vehicles.assign(vehicles, sight);
    for (std::size_t i = 0; i < landmarks; ++i) packet.landmarks[i].id = i;
    for (std::size_t i = 0; i < vehicles; ++i) packet.vehicles[i].id = i;
    return fault_of(encode(packet));
  };
  CHECK(with(kMostOfPacket, 0, 0) == PacketFault::none);
  CHECK(with(kMostOfPacket + 1, 0, 0) == PacketFault::content);
  CHECK(with(0, kMostOfPacket, 0) == PacketFault::none);
  CHECK(with(0, kMostOfPacket + 1, 0) == PacketFault::content);
  CHECK(with(0, 0, kMostOfPacket) == PacketFault::none);
  CHECK(with(0, 0, kMostOfPacket + 1) == PacketFault::content);
  CHECK(with(kMostOfPacket, kMostOfPacket, kMostOfPacket) == PacketFault::none);
}

TEST_CASE("packet: what is refused leaves the packet as it was") {
  Random random(5);
  const Packet good = any_packet(random, 2, 2, 1);
  const std::vector<std::uint8_t> bytes = encode(good);
  Packet kept = any_packet(random, 1, 1, 1);
  const Packet before = kept;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::vector<std::uint8_t> spoilt = bytes;
    spoilt[i] ^= 0x10;
    CHECK(decode(spoilt.data(), spoilt.size(), kept) != PacketFault::none);
    CHECK(decode(bytes.data(), i, kept) != PacketFault::none);
  }
  CHECK(same(kept, before));
}

TEST_CASE("packet: noise of few directions is noise") {
  Random random(6);
  int refused = 0;
  for (int n = 0; n < 3000; ++n) {
    Packet packet = any_packet(random, 1, 0, 0);
    Matrix3 C = Matrix3::Zero();
    for (int rank = 0; rank < n % 3; ++rank) {
      Vector3 g = random.normal_vector<3>();
      for (int i = 0; i < 3; ++i) g[i] *= std::pow(10.0, random.uniform(-4, 1));
      if (n % 5 == 0) g[n % 2] = 0;
      C += g * g.transpose();
    }
    packet.motions[0].covariance = C;
    refused += fault_of(encode(packet)) != PacketFault::none;
  }
  CHECK(refused == 0);
}

TEST_CASE("packet: numbers that end in nothing") {
  Random random(7);
  Packet packet = any_packet(random, 1, 1, 1);
  packet.landmarks[0].z[0] = 0.0, packet.landmarks[0].z[1] = -0.0;
  packet.vehicles[0].z[0] = std::numeric_limits<double>::denorm_min();
  packet.time = std::numeric_limits<double>::max();
  Packet back;
  const std::vector<std::uint8_t> bytes = encode(packet);
  REQUIRE(decode(bytes.data(), bytes.size(), back) == PacketFault::none);
  CHECK(same(packet, back));
  packet.time = std::numeric_limits<double>::infinity();
  CHECK(fault_of(encode(packet)) == PacketFault::content);
}

// Finite numbers that would overflow in a filter.
TEST_CASE("packet: numbers of absurd size") {
  Random random(8);
  const auto fault_of = [](const Packet& packet) {
    const std::vector<std::uint8_t> bytes = encode(packet);
    Packet unused;
    return decode(bytes.data(), bytes.size(), unused);
  };
  const Packet good = any_packet(random, 1, 1, 1);
  REQUIRE(fault_of(good) == PacketFault::none);
  const auto with_variance = [&](int axis, double variance) {
    Packet packet = good;
    packet.motions[0].covariance = Matrix3(1e-4 * Matrix3::Identity());
    packet.motions[0].covariance(axis, axis) = variance;
    return fault_of(packet);
  };
  CHECK(with_variance(0, 1e18) == PacketFault::none);
  CHECK(with_variance(2, 1e4) == PacketFault::none);
  for (int axis = 0; axis < 3; ++axis) CHECK(with_variance(axis, 1e308) == PacketFault::content);
  CHECK(with_variance(2, 1.1e4) == PacketFault::content);
  Packet far = good;
  far.motions[0].T_before_after = SE2(SO2(), Vector2(0.0, -1e308));
  CHECK(fault_of(far) == PacketFault::content);
  for (const double variance : {1e308, 1e-308, 1e101}) {
    Packet noisy = good;
    noisy.landmarks[0].covariance[0] = noisy.landmarks[0].covariance[3] = variance;
    noisy.landmarks[0].covariance[1] = noisy.landmarks[0].covariance[2] = 0.0;
    CHECK(fault_of(noisy) == PacketFault::content);
  }
  Packet nothing = good;  // the range of a radar that got no echo costs the packet nothing
  nothing.landmarks[0].z[0] = nothing.vehicles[0].z[0] = std::numeric_limits<double>::max();
  CHECK(fault_of(nothing) == PacketFault::none);
}
