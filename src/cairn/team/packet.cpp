// SPDX-License-Identifier: BSD-3-Clause
#include "team/packet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "linear/small_algebra.hpp"

namespace cairn {
namespace {

constexpr std::uint8_t kMagic[4] = {'C', 'R', 'N', 'P'};
constexpr std::size_t kHeader = 4 + 2 + 2 + 4, kChecksum = 4;

class Writer {
 public:
  explicit Writer(std::vector<std::uint8_t>& out) : out_(out) { out_.clear(); }

  void bytes(const std::uint8_t* from, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) out_.push_back(from[i]);
  }
  template <class Number>
  void number(Number value) {
    for (std::size_t i = 0; i < sizeof value; ++i)
      out_.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i)));
  }
  void real(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    number(bits);
  }
  std::vector<std::uint8_t>& out() { return out_; }

 private:
  std::vector<std::uint8_t>& out_;
};

class Reader {
 public:
  Reader(const std::uint8_t* bytes, std::size_t size) : at_(bytes), left_(size) {}

  template <class Number>
  Number number() {
    std::uint64_t value = 0;
    if (left_ < sizeof(Number)) {
      whole_ = false;
      left_ = 0;
      return 0;
    }
    for (std::size_t i = 0; i < sizeof(Number); ++i) value |= static_cast<std::uint64_t>(at_[i]) << (8 * i);
    at_ += sizeof(Number);
    left_ -= sizeof(Number);
    return static_cast<Number>(value);
  }
  double real() {
    const auto bits = number<std::uint64_t>();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    finite_ = finite_ && std::isfinite(value);
    return value;
  }
  bool whole() const { return whole_; }  // nothing was asked for beyond the end
  bool finite() const { return finite_; }
  std::size_t left() const { return left_; }

 private:
  const std::uint8_t* at_;
  std::size_t left_;
  bool whole_ = true, finite_ = true;
};

constexpr std::size_t kMotion = 10 * sizeof(double), kSight = sizeof(std::uint64_t) + 5 * sizeof(double);

void write_motion(const Increment<SE2>& motion, Writer& to) {
  const SE2& T = motion.T_before_after;
  const Vector2 u = T.rotation().matrix().col(0);  // the rotation in its stored form: the same bits at every vehicle
  const Matrix3& C = motion.covariance;
  for (const double value : {T.translation().x(), T.translation().y(), u.x(), u.y()}) to.real(value);
  for (const double value : {C(0, 0), C(1, 0), C(2, 0), C(1, 1), C(2, 1)}) to.real(value);
  to.real(C(2, 2));
}

Increment<SE2> read_motion(Reader& from) {
  double v[10];
  for (double& value : v) value = from.real();
  Increment<SE2> motion;
  motion.T_before_after = SE2(SO2::from_unit(Vector2(v[2], v[3])), Vector2(v[0], v[1]));
  motion.covariance << v[4], v[5], v[6], v[5], v[7], v[8], v[6], v[8], v[9];
  return motion;
}

void write_sight(const Observation& o, Writer& to) {
  to.number(o.id);
  for (const double value : {o.z[0], o.z[1], o.covariance[0], o.covariance[1], o.covariance[3]}) to.real(value);
}

Observation read_sight(Reader& from) {
  Observation o{};
  o.id = from.number<std::uint64_t>();
  double v[5];
  for (double& value : v) value = from.real();
  o.z[0] = v[0], o.z[1] = v[1];
  // Two rows, packed.
  o.covariance[0] = v[2], o.covariance[1] = o.covariance[2] = v[3], o.covariance[3] = v[4];
  return o;
}

// The test of the C interface for a caller's matrices, or (`semi`) a weaker one, which every matrix that passed there
// passes.
template <int n>
bool is_covariance(const Eigen::Matrix<double, n, n>& C, bool semi) {
  for (int k = 0; k < n; ++k) {
    if (semi ? !(C(k, k) >= 0.0) : !(C(k, k) > 0.0)) return false;
    if (C(k, k) == 0.0 && !C.col(k).isZero(0.0)) return false;  // a component with zero variance has zero covariances
  }
  double L[n * n];
  return positive_definite(C.data(), n, semi ? kDefiniteSlack : 0.0, L);
}

bool is_noise(const Matrix2& C) {
  for (int k = 0; k < 2; ++k)
    if (!(C(k, k) >= kLeastVariance && C(k, k) <= kLargestVariance)) return false;
  return is_covariance<2>(C, false);
}

bool is_sensible(const std::vector<Observation>& sights) {
  for (const Observation& o : sights) {
    if (!(o.z[0] >= 0.0)) return false;
    const Matrix2 C = Eigen::Map<const Matrix2>(o.covariance);
    if (!C.isZero(0.0) && !is_noise(C)) return false;
  }
  std::uint64_t unused = 0;
  return !named_twice(sights, unused);
}

bool is_sensible(const Packet& packet) {
  for (const Increment<SE2>& motion : packet.motions)
    if (!is_motion(motion)) return false;
  for (const Observation& o : packet.vehicles)
    if (o.id == packet.vehicle || o.id == kNoId) return false;
  return is_sensible(packet.landmarks) && is_sensible(packet.vehicles);
}

}  // namespace

bool is_motion(const Increment<SE2>& motion) {
  const SE2& T = motion.T_before_after;
  const Matrix3& C = motion.covariance;
  const double turned = T.rotation().matrix().col(0).squaredNorm();
  return std::abs(turned - 1.0) < 1e-9 && T.translation().cwiseAbs().maxCoeff() <= kFarthest &&
         C.diagonal().head<2>().maxCoeff() <= kFarthest * kFarthest && C(2, 2) <= kLargestTurn * kLargestTurn &&
         is_covariance<3>(C, true);
}

bool named_twice(const std::vector<Observation>& observations, std::uint64_t& name) {
  std::vector<std::uint64_t> ids;
  for (const Observation& o : observations)
    if (o.id != kNoId) ids.push_back(o.id);
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end()) name = *twice;
  return twice != ids.end();
}

std::uint32_t crc32(const std::uint8_t* bytes, std::size_t size) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1u) != 0 ? 0xEDB88320u : 0u);
      t[i] = value;
    }
    return t;
  }();
  std::uint32_t crc = 0xFFFFFFFFu;
  for (std::size_t i = 0; i < size; ++i) crc = (crc >> 8) ^ table[(crc ^ bytes[i]) & 0xFFu];
  return ~crc;
}

void encode(const Packet& packet, std::vector<std::uint8_t>& out) {
  Writer to(out);
  to.bytes(kMagic, sizeof kMagic);
  to.number(kPacketVersion);
  to.number(static_cast<std::uint16_t>(packet.kind));
  to.number(std::uint32_t{0});  // the size, filled in below
  to.number(packet.vehicle);
  to.number(packet.number);
  to.real(packet.time);
  if (packet.kind == PacketKind::request) {
    to.number(packet.subject);
    to.number(packet.first);
    to.number(packet.count);
  } else {
    to.number(static_cast<std::uint32_t>(packet.motions.size()));
    to.number(static_cast<std::uint32_t>(packet.landmarks.size()));
    to.number(static_cast<std::uint32_t>(packet.vehicles.size()));
    for (const Increment<SE2>& motion : packet.motions) write_motion(motion, to);
    for (const Observation& o : packet.landmarks) write_sight(o, to);
    for (const Observation& o : packet.vehicles) write_sight(o, to);
  }
  const auto size = static_cast<std::uint32_t>(to.out().size() + kChecksum);
  for (std::size_t i = 0; i < 4; ++i) to.out()[8 + i] = static_cast<std::uint8_t>(size >> (8 * i));
  to.number(crc32(to.out().data(), to.out().size()));
}

std::vector<std::uint8_t> encode(const Packet& packet) {
  std::vector<std::uint8_t> out;
  encode(packet, out);
  return out;
}

PacketFault decode(const std::uint8_t* bytes, std::size_t size, Packet& packet) {
  if (size < sizeof kMagic || std::memcmp(bytes, kMagic, sizeof kMagic) != 0) return PacketFault::foreign;
  if (size < kHeader) return PacketFault::short_cut;
  Reader header(bytes + sizeof kMagic, kHeader - sizeof kMagic);
  if (header.number<std::uint16_t>() != kPacketVersion) return PacketFault::version;
  const auto kind = header.number<std::uint16_t>();
  if (header.number<std::uint32_t>() != size || size < kHeader + kChecksum) return PacketFault::short_cut;
  Reader checksum(bytes + size - kChecksum, kChecksum);
  Packet read;
  read.checksum = checksum.number<std::uint32_t>();
  if (crc32(bytes, size - kChecksum) != read.checksum) return PacketFault::checksum;
  if (kind < 1 || kind > 3) return PacketFault::content;

  Reader from(bytes + kHeader, size - kHeader - kChecksum);
  read.kind = static_cast<PacketKind>(kind);
  read.vehicle = from.number<std::uint64_t>();
  read.number = from.number<std::uint64_t>();
  read.time = from.real();
  if (read.kind == PacketKind::request) {
    read.subject = from.number<std::uint64_t>();
    read.first = from.number<std::uint64_t>();
    read.count = from.number<std::uint64_t>();
  } else {
    const std::size_t motions = from.number<std::uint32_t>(), landmarks = from.number<std::uint32_t>(),
                      vehicles = from.number<std::uint32_t>();
    if (std::max({motions, landmarks, vehicles}) > kMostOfPacket) return PacketFault::content;
    if (from.left() != motions * kMotion + (landmarks + vehicles) * kSight) return PacketFault::content;
    for (std::size_t i = 0; i < motions; ++i) read.motions.push_back(read_motion(from));
    for (std::size_t i = 0; i < landmarks; ++i) read.landmarks.push_back(read_sight(from));
    for (std::size_t i = 0; i < vehicles; ++i) read.vehicles.push_back(read_sight(from));
  }
  if (!from.whole() || from.left() != 0 || !from.finite() || !is_sensible(read)) return PacketFault::content;
  packet = std::move(read);
  return PacketFault::none;
}

}  // namespace cairn
