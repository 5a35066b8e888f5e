// SPDX-License-Identifier: BSD-3-Clause
// Written by generate.py from api.json. Do not edit.
#ifndef CAIRN_CPP_TYPES_HPP
#define CAIRN_CPP_TYPES_HPP

#include <cairn/cairn.h>
#include <cairn/cpp/basic.hpp>
#include <array>
#include <cstddef>
#include <cstdint>

// clang-format off
namespace cairn {

static_assert(CAIRN_VERSION == 200,
              "cairn.hpp is of version 0.2.0, and the C headers are of another one: install both from one place");

/// The id that no landmark has.
inline constexpr std::uint64_t kIdNone = CAIRN_ID_NONE;

/// Version of these headers: 10000 major + 100 minor + patch.
inline constexpr std::uint32_t kHeaderVersion = CAIRN_VERSION;
inline constexpr std::uint32_t kHeaderVersionMajor = CAIRN_VERSION_MAJOR;
inline constexpr std::uint32_t kHeaderVersionMinor = CAIRN_VERSION_MINOR;
inline constexpr std::uint32_t kHeaderVersionPatch = CAIRN_VERSION_PATCH;

/// Status of every fallible call: 0 is success, a negative value an error. A value never changes its meaning. A refused
/// observation is not an error: its Match reports the refusal.
enum class Status : std::int32_t {
  /// success
  kOk = CAIRN_OK,
  /// an argument is none, not finite, out of range or not a covariance
  kErrorArgument = CAIRN_ERROR_ARGUMENT,
  /// the caller's buffer is too short; `needed` holds the size that is necessary
  kErrorBuffer = CAIRN_ERROR_BUFFER,
  /// a capacity set at creation is exhausted (landmarks, observations, sensors)
  kErrorCapacity = CAIRN_ERROR_CAPACITY,
  /// no landmark, sensor or vehicle has this id
  kErrorNotFound = CAIRN_ERROR_NOT_FOUND,
  /// a covariance would lose positive definiteness, or a result is not finite
  kErrorNumerical = CAIRN_ERROR_NUMERICAL,
  /// there is not enough memory
  kErrorMemory = CAIRN_ERROR_MEMORY,
  /// the handle is in a state that does not allow this call
  kErrorState = CAIRN_ERROR_STATE,
  /// a defect of the library; please report it
  kErrorInternal = CAIRN_ERROR_INTERNAL,
  /// a callback of the caller returned a negative value and so aborted the call
  kErrorCallback = CAIRN_ERROR_CALLBACK,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Status value) noexcept {
  switch (value) {
    case Status::kOk: return "CAIRN_OK";
    case Status::kErrorArgument: return "CAIRN_ERROR_ARGUMENT";
    case Status::kErrorBuffer: return "CAIRN_ERROR_BUFFER";
    case Status::kErrorCapacity: return "CAIRN_ERROR_CAPACITY";
    case Status::kErrorNotFound: return "CAIRN_ERROR_NOT_FOUND";
    case Status::kErrorNumerical: return "CAIRN_ERROR_NUMERICAL";
    case Status::kErrorMemory: return "CAIRN_ERROR_MEMORY";
    case Status::kErrorState: return "CAIRN_ERROR_STATE";
    case Status::kErrorInternal: return "CAIRN_ERROR_INTERNAL";
    case Status::kErrorCallback: return "CAIRN_ERROR_CALLBACK";
  }
  return "";
}

/// How a map holds the joint uncertainty of its landmarks. Only maps of the same kind can be merged.
enum class MapForm : std::int32_t {
  /// positions and their joint covariance: a single map, or densely joined submaps
  kDense = CAIRN_MAP_DENSE,
  /// submaps and the factor of their information: sparsely joined submaps
  kSparse = CAIRN_MAP_SPARSE,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(MapForm value) noexcept {
  switch (value) {
    case MapForm::kDense: return "CAIRN_MAP_DENSE";
    case MapForm::kSparse: return "CAIRN_MAP_SPARSE";
  }
  return "";
}

/// How Map::merge finds the landmarks that both maps hold, the common landmarks.
enum class MergeBy : std::int32_t {
  /// landmarks with the same id
  kId = CAIRN_MERGE_BY_ID,
  /// landmarks that lie in the same way relative to each other; ids are ignored
  kGeometry = CAIRN_MERGE_BY_GEOMETRY,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(MergeBy value) noexcept {
  switch (value) {
    case MergeBy::kId: return "CAIRN_MERGE_BY_ID";
    case MergeBy::kGeometry: return "CAIRN_MERGE_BY_GEOMETRY";
  }
  return "";
}

/// Sign of the yaw rate that follows from two wheel rates.
enum class Yaw : std::int32_t {
  /// z up: the vehicle turns left (positive yaw rate) when the right wheels turn faster; the default
  kRightMinusLeft = CAIRN_YAW_RIGHT_MINUS_LEFT,
  /// z down: eq. 1 as printed in the Mars paper
  kLeftMinusRight = CAIRN_YAW_LEFT_MINUS_RIGHT,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Yaw value) noexcept {
  switch (value) {
    case Yaw::kRightMinusLeft: return "CAIRN_YAW_RIGHT_MINUS_LEFT";
    case Yaw::kLeftMinusRight: return "CAIRN_YAW_LEFT_MINUS_RIGHT";
  }
  return "";
}

/// How the noise of the two encoders of a head enters (StereoHead).
enum class Encoder : std::int32_t {
  /// the head moves between observations: each has independent noise; the default
  kPerObservation = CAIRN_ENCODER_PER_OBSERVATION,
  /// the head stands still: all observations of a frame have the same encoder error
  kPerFrame = CAIRN_ENCODER_PER_FRAME,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Encoder value) noexcept {
  switch (value) {
    case Encoder::kPerObservation: return "CAIRN_ENCODER_PER_OBSERVATION";
    case Encoder::kPerFrame: return "CAIRN_ENCODER_PER_FRAME";
  }
  return "";
}

/// Loss of a residual at the distance d, in standard deviations (docs/update.md, "Robust losses").
enum class Loss : std::int32_t {
  /// d^2 / 2: least squares; the default
  kNone = CAIRN_LOSS_NONE,
  /// d^2 / 2 up to the width k, k d - k^2 / 2 beyond: the influence of an observation is bounded
  kHuber = CAIRN_LOSS_HUBER,
  /// c^2 / 2 log(1 + d^2 / c^2): the influence falls with the distance, and gross outliers have nearly none
  kCauchy = CAIRN_LOSS_CAUCHY,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Loss value) noexcept {
  switch (value) {
    case Loss::kNone: return "CAIRN_LOSS_NONE";
    case Loss::kHuber: return "CAIRN_LOSS_HUBER";
    case Loss::kCauchy: return "CAIRN_LOSS_CAUCHY";
  }
  return "";
}

/// Result of an observation.
enum class Result : std::int32_t {
  /// it updated the landmark
  kMatched = CAIRN_RESULT_MATCHED,
  /// it placed a new landmark, or placed a landmark again that had been placed wrongly; then `distance` and `threshold`
  /// are those of its test against the former place
  kNew = CAIRN_RESULT_NEW,
  /// it was refused and changed nothing; `reason` says why
  kRejected = CAIRN_RESULT_REJECTED,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Result value) noexcept {
  switch (value) {
    case Result::kMatched: return "CAIRN_RESULT_MATCHED";
    case Result::kNew: return "CAIRN_RESULT_NEW";
    case Result::kRejected: return "CAIRN_RESULT_REJECTED";
  }
  return "";
}

/// Why an observation was refused.
enum class Reason : std::int32_t {
  /// it was not refused
  kNone = CAIRN_REASON_NONE,
  /// its distance exceeds the threshold of the gate of one observation (chi-square)
  kGate = CAIRN_REASON_GATE,
  /// it passed its own gate, but was removed so that the whole batch passes the batch gate
  kBatchGate = CAIRN_REASON_BATCH_GATE,
  /// the estimated landmark cannot give an observation: behind the lens, too near, too steep
  kNoImage = CAIRN_REASON_NO_IMAGE,
  /// the observation cannot place a landmark: disparity or range too small, range too large beside its noise, or the
  /// sensor never places landmarks
  kNoPlace = CAIRN_REASON_NO_PLACE,
  /// unknown ids: it passed its own gate, but the best set of pairs does not contain it
  kAmbiguous = CAIRN_REASON_AMBIGUOUS,
  /// the observation could place a landmark, but the map is full
  kNoRoom = CAIRN_REASON_NO_ROOM,
  /// the observation could place a landmark, but most of what is seen contradicts the pose: nothing is placed until it
  /// is decided what is wrong.
  kContradicted = CAIRN_REASON_CONTRADICTED,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Reason value) noexcept {
  switch (value) {
    case Reason::kNone: return "CAIRN_REASON_NONE";
    case Reason::kGate: return "CAIRN_REASON_GATE";
    case Reason::kBatchGate: return "CAIRN_REASON_BATCH_GATE";
    case Reason::kNoImage: return "CAIRN_REASON_NO_IMAGE";
    case Reason::kNoPlace: return "CAIRN_REASON_NO_PLACE";
    case Reason::kAmbiguous: return "CAIRN_REASON_AMBIGUOUS";
    case Reason::kNoRoom: return "CAIRN_REASON_NO_ROOM";
    case Reason::kContradicted: return "CAIRN_REASON_CONTRADICTED";
  }
  return "";
}

/// Error of the state that the filter's covariance describes (docs/invariant_error.md).
enum class StateError : std::int32_t {
  /// right-invariant error on SE_{K+1}(3): consistent; the default
  kInvariant = CAIRN_STATE_ERROR_INVARIANT,
  /// separate errors of position, attitude and landmarks: standard EKF-SLAM, for comparison
  kStandard = CAIRN_STATE_ERROR_STANDARD,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(StateError value) noexcept {
  switch (value) {
    case StateError::kInvariant: return "CAIRN_STATE_ERROR_INVARIANT";
    case StateError::kStandard: return "CAIRN_STATE_ERROR_STANDARD";
  }
  return "";
}

/// Space in which the vehicle moves (docs/plane.md). The interface of a planar vehicle is the same as that of a spatial
/// one: the vehicle lies in z = 0 and turns about z. The filter reads only the rows and columns of x, y and yaw of
/// covariances and Jacobians that it gets. Covariances that it returns have zeros elsewhere.
enum class Vehicle : std::int32_t {
  /// six degrees of freedom; the default
  kSpatial = CAIRN_VEHICLE_SPATIAL,
  /// x, y and heading; landmarks x and y
  kPlanar = CAIRN_VEHICLE_PLANAR,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Vehicle value) noexcept {
  switch (value) {
    case Vehicle::kSpatial: return "CAIRN_VEHICLE_SPATIAL";
    case Vehicle::kPlanar: return "CAIRN_VEHICLE_PLANAR";
  }
  return "";
}

/// How a closed submap joins the map (docs/submaps.md).
enum class Join : std::int32_t {
  /// dense if max_landmarks is at most 100, sparse otherwise; the default
  kAuto = CAIRN_JOIN_AUTO,
  /// a filter with the covariance of the whole map: a closing costs O(n^2) for n states of the map
  kDense = CAIRN_JOIN_DENSE,
  /// solves for all submaps together on a sparse factor and relinearises them: the total cost is nearly linear
  kSparse = CAIRN_JOIN_SPARSE,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Join value) noexcept {
  switch (value) {
    case Join::kAuto: return "CAIRN_JOIN_AUTO";
    case Join::kDense: return "CAIRN_JOIN_DENSE";
    case Join::kSparse: return "CAIRN_JOIN_SPARSE";
  }
  return "";
}

/// How the filter finds the landmark of an observation (docs/association.md).
enum class Association : std::int32_t {
  /// by the id of the observation; the default
  kKnown = CAIRN_ASSOCIATION_KNOWN,
  /// nearest neighbour by Mahalanobis distance; each landmark is matched at most once in a frame. Ids of observations
  /// are ignored, and landmarks are numbered from 0 in the order in which they are placed
  kNearest = CAIRN_ASSOCIATION_NEAREST,
  /// the largest set of pairs that are jointly compatible (branch and bound); ids as for Association::kNearest
  kJoint = CAIRN_ASSOCIATION_JOINT,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Association value) noexcept {
  switch (value) {
    case Association::kKnown: return "CAIRN_ASSOCIATION_KNOWN";
    case Association::kNearest: return "CAIRN_ASSOCIATION_NEAREST";
    case Association::kJoint: return "CAIRN_ASSOCIATION_JOINT";
  }
  return "";
}

/// Distance by which Association::kNearest chooses among landmarks.
enum class Distance : std::int32_t {
  /// the squared Mahalanobis distance d^2; the default
  kMahalanobis = CAIRN_DISTANCE_MAHALANOBIS,
  /// d^2 + log det S, which is -2 log of the likelihood: if two landmarks have the same d^2, the better known one is
  /// chosen. The gates still use d^2
  kLikelihood = CAIRN_DISTANCE_LIKELIHOOD,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Distance value) noexcept {
  switch (value) {
    case Distance::kMahalanobis: return "CAIRN_DISTANCE_MAHALANOBIS";
    case Distance::kLikelihood: return "CAIRN_DISTANCE_LIKELIHOOD";
  }
  return "";
}

/// What becomes of the noise that the filter learns from its innovations (docs/trust.md).
enum class NoiseLearning : std::int32_t {
  /// Filter::health reports it; the default
  kReported = CAIRN_NOISE_REPORTED,
  /// from when it is known, it scales the stated noise of each sensor and of the motion
  kApplied = CAIRN_NOISE_APPLIED,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(NoiseLearning value) noexcept {
  switch (value) {
    case NoiseLearning::kReported: return "CAIRN_NOISE_REPORTED";
    case NoiseLearning::kApplied: return "CAIRN_NOISE_APPLIED";
  }
  return "";
}

/// Why a submap was closed.
enum class ClosedBy : std::int32_t {
  /// no submap was closed yet
  kNone = CAIRN_CLOSED_BY_NONE,
  /// Filter::close_submap
  kCaller = CAIRN_CLOSED_BY_CALLER,
  /// submap_landmarks
  kLandmarks = CAIRN_CLOSED_BY_LANDMARKS,
  /// submap_distance
  kDistance = CAIRN_CLOSED_BY_DISTANCE,
  /// submap_extent
  kExtent = CAIRN_CLOSED_BY_EXTENT,
  /// submap_sigma
  kSigma = CAIRN_CLOSED_BY_SIGMA,
  /// an absolute position, attitude or heading could not be taken in otherwise
  kFix = CAIRN_CLOSED_BY_FIX,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(ClosedBy value) noexcept {
  switch (value) {
    case ClosedBy::kNone: return "CAIRN_CLOSED_BY_NONE";
    case ClosedBy::kCaller: return "CAIRN_CLOSED_BY_CALLER";
    case ClosedBy::kLandmarks: return "CAIRN_CLOSED_BY_LANDMARKS";
    case ClosedBy::kDistance: return "CAIRN_CLOSED_BY_DISTANCE";
    case ClosedBy::kExtent: return "CAIRN_CLOSED_BY_EXTENT";
    case ClosedBy::kSigma: return "CAIRN_CLOSED_BY_SIGMA";
    case ClosedBy::kFix: return "CAIRN_CLOSED_BY_FIX";
  }
  return "";
}

/// The verdict on a filter.
enum class Verdict : std::int32_t {
  /// what is seen agrees with the estimate and with the stated noise
  kGood = CAIRN_VERDICT_GOOD,
  /// something does not agree; the reasons say what
  kDoubtful = CAIRN_VERDICT_DOUBTFUL,
  /// most of what is seen contradicts the estimate
  kLost = CAIRN_VERDICT_LOST,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Verdict value) noexcept {
  switch (value) {
    case Verdict::kGood: return "CAIRN_VERDICT_GOOD";
    case Verdict::kDoubtful: return "CAIRN_VERDICT_DOUBTFUL";
    case Verdict::kLost: return "CAIRN_VERDICT_LOST";
  }
  return "";
}

/// The reasons of a verdict, one bit each.
enum class Doubts : std::uint32_t {
  /// the normalised innovations of the window lie above their band
  kNis = CAIRN_DOUBT_NIS,
  /// the gates refuse more than they refuse of honest observations
  kRefusals = CAIRN_DOUBT_REFUSALS,
  /// the motion was widened, because most of what was seen contradicted it
  kWidened = CAIRN_DOUBT_WIDENED,
  /// a sensor's noise is more than 1.5 times what is stated
  kSensorNoise = CAIRN_DOUBT_SENSOR_NOISE,
  /// the motion's noise is clearly more than what is stated
  kMotionNoise = CAIRN_DOUBT_MOTION_NOISE,
  /// the corrections of the pose have a mean: the motion has a constant error
  kBias = CAIRN_DOUBT_BIAS,
  /// a frame contradicts the motion since the last frame: a slip, or another place
  kJump = CAIRN_DOUBT_JUMP,
  /// single landmarks contradict the rest: moved, or under a wrong id
  kLandmarks = CAIRN_DOUBT_LANDMARKS,
  /// a closed submap contradicted the map
  kClosing = CAIRN_DOUBT_CLOSING,
  /// directions of the pose about which the last frames say nothing
  kBlind = CAIRN_DOUBT_BLIND,
  /// the covariance of the pose is not positive semidefinite
  kDefinite = CAIRN_DOUBT_DEFINITE,
};

constexpr Doubts operator|(Doubts a, Doubts b) noexcept {
  return static_cast<Doubts>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
constexpr Doubts operator&(Doubts a, Doubts b) noexcept {
  return static_cast<Doubts>(static_cast<std::uint32_t>(a) & static_cast<std::uint32_t>(b));
}
/// Whether any bit is set.
constexpr bool any(Doubts value) noexcept { return value != Doubts{}; }

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Doubts value) noexcept {
  switch (value) {
    case Doubts::kNis: return "CAIRN_DOUBT_NIS";
    case Doubts::kRefusals: return "CAIRN_DOUBT_REFUSALS";
    case Doubts::kWidened: return "CAIRN_DOUBT_WIDENED";
    case Doubts::kSensorNoise: return "CAIRN_DOUBT_SENSOR_NOISE";
    case Doubts::kMotionNoise: return "CAIRN_DOUBT_MOTION_NOISE";
    case Doubts::kBias: return "CAIRN_DOUBT_BIAS";
    case Doubts::kJump: return "CAIRN_DOUBT_JUMP";
    case Doubts::kLandmarks: return "CAIRN_DOUBT_LANDMARKS";
    case Doubts::kClosing: return "CAIRN_DOUBT_CLOSING";
    case Doubts::kBlind: return "CAIRN_DOUBT_BLIND";
    case Doubts::kDefinite: return "CAIRN_DOUBT_DEFINITE";
  }
  return "";
}

/// Kinds of systematic errors.
enum class Systematic : std::int32_t {
  /// of the measured body velocity, m/s; components x, y, z
  kVelocityBias = CAIRN_SYSTEMATIC_VELOCITY_BIAS,
  /// of the measured body rate, rad/s; components x, y, z
  kRateBias = CAIRN_SYSTEMATIC_RATE_BIAS,
  /// of a wheel's measured rate; components left and right
  kWheelScale = CAIRN_SYSTEMATIC_WHEEL_SCALE,
  /// of a sensor against the body, m; components x, y, z
  kMountShift = CAIRN_SYSTEMATIC_MOUNT_SHIFT,
  /// of a sensor about the origin of the body: a rotation vector, rad
  kMountTurn = CAIRN_SYSTEMATIC_MOUNT_TURN,
  /// of the values of a sensor's observations, in their units
  kOffset = CAIRN_SYSTEMATIC_OFFSET,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Systematic value) noexcept {
  switch (value) {
    case Systematic::kVelocityBias: return "CAIRN_SYSTEMATIC_VELOCITY_BIAS";
    case Systematic::kRateBias: return "CAIRN_SYSTEMATIC_RATE_BIAS";
    case Systematic::kWheelScale: return "CAIRN_SYSTEMATIC_WHEEL_SCALE";
    case Systematic::kMountShift: return "CAIRN_SYSTEMATIC_MOUNT_SHIFT";
    case Systematic::kMountTurn: return "CAIRN_SYSTEMATIC_MOUNT_TURN";
    case Systematic::kOffset: return "CAIRN_SYSTEMATIC_OFFSET";
  }
  return "";
}

/// Mode: how a vehicle uses the packets of its teammates.
enum class TeamMode : std::int32_t {
  /// it ignores them; for comparison
  kMono = CAIRN_TEAM_MONO,
  /// extended observations with independent noise, as printed in the cooperative paper: overconfident, and more so with
  /// more landmarks
  kEoDiagonal = CAIRN_TEAM_EO_DIAGONAL,
  /// extended observations with the noise that all observations of a scan share through the sighting
  kEoFull = CAIRN_TEAM_EO_FULL,
  /// every vehicle runs the same filter over all poses and all landmarks; the default
  kJoint = CAIRN_TEAM_JOINT,
  /// every vehicle works in its own submaps, which are fused by their common landmarks; sightings between vehicles are
  /// not used
  kSubmaps = CAIRN_TEAM_SUBMAPS,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(TeamMode value) noexcept {
  switch (value) {
    case TeamMode::kMono: return "CAIRN_TEAM_MONO";
    case TeamMode::kEoDiagonal: return "CAIRN_TEAM_EO_DIAGONAL";
    case TeamMode::kEoFull: return "CAIRN_TEAM_EO_FULL";
    case TeamMode::kJoint: return "CAIRN_TEAM_JOINT";
    case TeamMode::kSubmaps: return "CAIRN_TEAM_SUBMAPS";
  }
  return "";
}

/// Result of a received packet.
enum class Packet : std::int32_t {
  /// it had its turn and is part of the estimate
  kTaken = CAIRN_PACKET_TAKEN,
  /// it waits for its turn
  kWaiting = CAIRN_PACKET_WAITING,
  /// a teammate misses own packets; they are queued to be sent again
  kRequest = CAIRN_PACKET_REQUEST,
  /// a teammate leaves the team when this packet has its turn
  kLeave = CAIRN_PACKET_LEAVE,
  /// it was received before
  kRepeated = CAIRN_PACKET_REPEATED,
  /// it is an own packet that came back
  kOwn = CAIRN_PACKET_OWN,
  /// the mode does not use it, or it is for another vehicle
  kIgnored = CAIRN_PACKET_IGNORED,
  /// its sender is not in the team
  kUnknown = CAIRN_PACKET_UNKNOWN,
  /// its time does not agree with its number
  kPast = CAIRN_PACKET_PAST,
  /// a different packet of this sender with this number was received before: two vehicles have the same number
  kConflict = CAIRN_PACKET_CONFLICT,
  /// max_waiting packets of this sender wait already
  kFull = CAIRN_PACKET_FULL,
  /// it is not a packet of a team
  kForeign = CAIRN_PACKET_FOREIGN,
  /// this library does not read its version
  kVersion = CAIRN_PACKET_VERSION,
  /// bytes are missing, or there are too many
  kCut = CAIRN_PACKET_CUT,
  /// its checksum is wrong
  kCorrupt = CAIRN_PACKET_CORRUPT,
  /// it is complete, but not a valid step: values that are not finite, noise that is not a covariance, an id or a
  /// number twice, numbers of absurd size
  kNonsense = CAIRN_PACKET_NONSENSE,
  /// its time is more than max_jump after that of the sender's packet before it. The next packet of the sender decides:
  /// if it agrees with this one, both are right, and this one can be received again
  kAhead = CAIRN_PACKET_AHEAD,
};

/// The name in C of a constant or, of any other value, "".
constexpr const char* constant_name(Packet value) noexcept {
  switch (value) {
    case Packet::kTaken: return "CAIRN_PACKET_TAKEN";
    case Packet::kWaiting: return "CAIRN_PACKET_WAITING";
    case Packet::kRequest: return "CAIRN_PACKET_REQUEST";
    case Packet::kLeave: return "CAIRN_PACKET_LEAVE";
    case Packet::kRepeated: return "CAIRN_PACKET_REPEATED";
    case Packet::kOwn: return "CAIRN_PACKET_OWN";
    case Packet::kIgnored: return "CAIRN_PACKET_IGNORED";
    case Packet::kUnknown: return "CAIRN_PACKET_UNKNOWN";
    case Packet::kPast: return "CAIRN_PACKET_PAST";
    case Packet::kConflict: return "CAIRN_PACKET_CONFLICT";
    case Packet::kFull: return "CAIRN_PACKET_FULL";
    case Packet::kForeign: return "CAIRN_PACKET_FOREIGN";
    case Packet::kVersion: return "CAIRN_PACKET_VERSION";
    case Packet::kCut: return "CAIRN_PACKET_CUT";
    case Packet::kCorrupt: return "CAIRN_PACKET_CORRUPT";
    case Packet::kNonsense: return "CAIRN_PACKET_NONSENSE";
    case Packet::kAhead: return "CAIRN_PACKET_AHEAD";
  }
  return "";
}

/// Pose of a frame b in a frame a: `p_a = R(quaternion) p_b + position`. SI units, Hamilton quaternion, w first.
///
/// The error of a pose is `[dp; dtheta]` (m, rad), both in the axes of the parent frame a: `position_true = position +
/// dp`, `R_true = Exp(dtheta) R`. Every 6x6 covariance of a pose in this interface is the covariance of this error,
/// row-major. Layout frozen.
struct CAIRN_CPP_SAME_BYTES Pose {
  using C = cairn_pose;
  /// origin of b in a, m
  std::array<double, 3> position{};
  /// rotation from b to a: w x y z, unit length
  std::array<double, 4> quaternion{{1.0, 0.0, 0.0, 0.0}};
};
static_assert(detail::same_layout<Pose, cairn_pose>);
static_assert(offsetof(Pose, position) == offsetof(cairn_pose, position) && sizeof(Pose::position) == sizeof(cairn_pose::position));
static_assert(offsetof(Pose, quaternion) == offsetof(cairn_pose, quaternion) && sizeof(Pose::quaternion) == sizeof(cairn_pose::quaternion));

/// A landmark. Layout frozen.
struct CAIRN_CPP_SAME_BYTES Landmark {
  using C = cairn_landmark;
  /// the caller's id, or the assigned one; it never changes
  std::uint64_t id{};
  /// observations that placed or updated it
  std::uint64_t observations{};
  /// in the map frame, m
  std::array<double, 3> position{};
  /// covariance of the position, 3x3 row-major, m^2
  std::array<double, 9> covariance{};
};
static_assert(detail::same_layout<Landmark, cairn_landmark>);
static_assert(offsetof(Landmark, id) == offsetof(cairn_landmark, id) && sizeof(Landmark::id) == sizeof(cairn_landmark::id));
static_assert(offsetof(Landmark, observations) == offsetof(cairn_landmark, observations) && sizeof(Landmark::observations) == sizeof(cairn_landmark::observations));
static_assert(offsetof(Landmark, position) == offsetof(cairn_landmark, position) && sizeof(Landmark::position) == sizeof(cairn_landmark::position));
static_assert(offsetof(Landmark, covariance) == offsetof(cairn_landmark, covariance) && sizeof(Landmark::covariance) == sizeof(cairn_landmark::covariance));

/// Options of Map::merge. Set them by MergeOptions::MergeOptions first.
struct CAIRN_CPP_SAME_BYTES MergeOptions {
  using C = cairn_merge_options;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_merge_options);
  /// MergeBy::kId or MergeBy::kGeometry; default MergeBy::kId
  MergeBy association{};
  /// probability that all common landmarks of a correct merge pass their own gates, in (0, 1]; default 0.9999
  double gate_probability{};
  /// probability that they pass the joint gate, in (0, 1]; default 0.9999
  double joint_gate_probability{};
  /// capacity of the merged map; 0, the default: no limit
  std::uint64_t max_landmarks{};
  /// by geometry, without has_transform: largest angle between the z axes of both frames, rad, 0 to pi; default pi
  double max_tilt{};
  /// 1: T_map_other is known beforehand, independently of both maps; default 0
  Bool has_transform{};
  /// leave it zero
  std::uint32_t reserved{};
  /// with has_transform: from the other's frame into the map's frame; default identity
  Pose T_map_other{};
  /// covariance of its error [dp; dtheta], 6x6 row-major, positive semidefinite; default 0: known exactly
  std::array<double, 36> covariance{};

  /// The defaults of the library.
  MergeOptions() { detail::fill_defaults<cairn_merge_options>(*this, cairn_merge_options_init); }
  /// A copy with another `association`.
  MergeOptions with_association(const MergeBy& value) const {
    MergeOptions copy = *this;
    copy.association = value;
    return copy;
  }
  /// A copy with another `gate_probability`.
  MergeOptions with_gate_probability(const double& value) const {
    MergeOptions copy = *this;
    copy.gate_probability = value;
    return copy;
  }
  /// A copy with another `joint_gate_probability`.
  MergeOptions with_joint_gate_probability(const double& value) const {
    MergeOptions copy = *this;
    copy.joint_gate_probability = value;
    return copy;
  }
  /// A copy with another `max_landmarks`.
  MergeOptions with_max_landmarks(const std::uint64_t& value) const {
    MergeOptions copy = *this;
    copy.max_landmarks = value;
    return copy;
  }
  /// A copy with another `max_tilt`.
  MergeOptions with_max_tilt(const double& value) const {
    MergeOptions copy = *this;
    copy.max_tilt = value;
    return copy;
  }
  /// A copy with another `has_transform`.
  MergeOptions with_has_transform(const Bool& value) const {
    MergeOptions copy = *this;
    copy.has_transform = value;
    return copy;
  }
  /// A copy with another `T_map_other`.
  MergeOptions with_T_map_other(const Pose& value) const {
    MergeOptions copy = *this;
    copy.T_map_other = value;
    return copy;
  }
  /// A copy with another `covariance`.
  MergeOptions with_covariance(const std::array<double, 36>& value) const {
    MergeOptions copy = *this;
    copy.covariance = value;
    return copy;
  }
};
static_assert(detail::same_layout<MergeOptions, cairn_merge_options>);
static_assert(offsetof(MergeOptions, struct_size) == offsetof(cairn_merge_options, struct_size) && sizeof(MergeOptions::struct_size) == sizeof(cairn_merge_options::struct_size));
static_assert(offsetof(MergeOptions, association) == offsetof(cairn_merge_options, association) && sizeof(MergeOptions::association) == sizeof(cairn_merge_options::association));
static_assert(offsetof(MergeOptions, gate_probability) == offsetof(cairn_merge_options, gate_probability) && sizeof(MergeOptions::gate_probability) == sizeof(cairn_merge_options::gate_probability));
static_assert(offsetof(MergeOptions, joint_gate_probability) == offsetof(cairn_merge_options, joint_gate_probability) && sizeof(MergeOptions::joint_gate_probability) == sizeof(cairn_merge_options::joint_gate_probability));
static_assert(offsetof(MergeOptions, max_landmarks) == offsetof(cairn_merge_options, max_landmarks) && sizeof(MergeOptions::max_landmarks) == sizeof(cairn_merge_options::max_landmarks));
static_assert(offsetof(MergeOptions, max_tilt) == offsetof(cairn_merge_options, max_tilt) && sizeof(MergeOptions::max_tilt) == sizeof(cairn_merge_options::max_tilt));
static_assert(offsetof(MergeOptions, has_transform) == offsetof(cairn_merge_options, has_transform) && sizeof(MergeOptions::has_transform) == sizeof(cairn_merge_options::has_transform));
static_assert(offsetof(MergeOptions, reserved) == offsetof(cairn_merge_options, reserved) && sizeof(MergeOptions::reserved) == sizeof(cairn_merge_options::reserved));
static_assert(offsetof(MergeOptions, T_map_other) == offsetof(cairn_merge_options, T_map_other) && sizeof(MergeOptions::T_map_other) == sizeof(cairn_merge_options::T_map_other));
static_assert(offsetof(MergeOptions, covariance) == offsetof(cairn_merge_options, covariance) && sizeof(MergeOptions::covariance) == sizeof(cairn_merge_options::covariance));

/// Report of Map::merge, also of a refused merge. Fields that the merge did not reach are 0.
struct CAIRN_CPP_SAME_BYTES MergeReport {
  using C = cairn_merge_report;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_merge_report);
  /// the one of the options
  MergeBy association{};
  /// landmarks that both maps hold
  std::uint64_t common{};
  /// landmarks that only the other holds
  std::uint64_t added{};
  /// degrees of freedom of `distance`: three for each common landmark; without has_transform six less
  std::uint64_t rows{};
  /// joint squared Mahalanobis distance of the common landmarks
  double distance{};
  /// its chi-square bound
  double threshold{};
  /// transforms points from the other's frame into the map's frame
  Pose T_map_other{};
  /// covariance of its error [dp; dtheta], 6x6 row-major
  std::array<double, 36> covariance{};
  /// id in the map of a common landmark that failed a test; kIdNone: none
  std::uint64_t broken_id{};
  /// id of the same landmark in the other map; kIdNone: none
  std::uint64_t broken_other_id{};
};
static_assert(detail::same_layout<MergeReport, cairn_merge_report>);
static_assert(offsetof(MergeReport, struct_size) == offsetof(cairn_merge_report, struct_size) && sizeof(MergeReport::struct_size) == sizeof(cairn_merge_report::struct_size));
static_assert(offsetof(MergeReport, association) == offsetof(cairn_merge_report, association) && sizeof(MergeReport::association) == sizeof(cairn_merge_report::association));
static_assert(offsetof(MergeReport, common) == offsetof(cairn_merge_report, common) && sizeof(MergeReport::common) == sizeof(cairn_merge_report::common));
static_assert(offsetof(MergeReport, added) == offsetof(cairn_merge_report, added) && sizeof(MergeReport::added) == sizeof(cairn_merge_report::added));
static_assert(offsetof(MergeReport, rows) == offsetof(cairn_merge_report, rows) && sizeof(MergeReport::rows) == sizeof(cairn_merge_report::rows));
static_assert(offsetof(MergeReport, distance) == offsetof(cairn_merge_report, distance) && sizeof(MergeReport::distance) == sizeof(cairn_merge_report::distance));
static_assert(offsetof(MergeReport, threshold) == offsetof(cairn_merge_report, threshold) && sizeof(MergeReport::threshold) == sizeof(cairn_merge_report::threshold));
static_assert(offsetof(MergeReport, T_map_other) == offsetof(cairn_merge_report, T_map_other) && sizeof(MergeReport::T_map_other) == sizeof(cairn_merge_report::T_map_other));
static_assert(offsetof(MergeReport, covariance) == offsetof(cairn_merge_report, covariance) && sizeof(MergeReport::covariance) == sizeof(cairn_merge_report::covariance));
static_assert(offsetof(MergeReport, broken_id) == offsetof(cairn_merge_report, broken_id) && sizeof(MergeReport::broken_id) == sizeof(cairn_merge_report::broken_id));
static_assert(offsetof(MergeReport, broken_other_id) == offsetof(cairn_merge_report, broken_other_id) && sizeof(MergeReport::broken_other_id) == sizeof(cairn_merge_report::broken_other_id));

/// Where a landmark of the other map is after a merge. Layout frozen.
struct CAIRN_CPP_SAME_BYTES MergedId {
  using C = cairn_merged_id;
  /// its id in the other map
  std::uint64_t other_id{};
  /// its id in the merged map
  std::uint64_t id{};
  /// 1: the map held this landmark before; 0: it was added
  Bool common{};
  /// leave it zero
  std::uint32_t reserved{};
};
static_assert(detail::same_layout<MergedId, cairn_merged_id>);
static_assert(offsetof(MergedId, other_id) == offsetof(cairn_merged_id, other_id) && sizeof(MergedId::other_id) == sizeof(cairn_merged_id::other_id));
static_assert(offsetof(MergedId, id) == offsetof(cairn_merged_id, id) && sizeof(MergedId::id) == sizeof(cairn_merged_id::id));
static_assert(offsetof(MergedId, common) == offsetof(cairn_merged_id, common) && sizeof(MergedId::common) == sizeof(cairn_merged_id::common));
static_assert(offsetof(MergedId, reserved) == offsetof(cairn_merged_id, reserved) && sizeof(MergedId::reserved) == sizeof(cairn_merged_id::reserved));

/// Four-wheel differential drive; both wheels of a side turn at the same rate (Mars paper, eq. 1): `v_x = r (w_left +
/// w_right) / 2`, `w_z = +-(r / B) (w_right - w_left)`. The model has no motion along y and z and no roll and pitch
/// rate. Noise is white; each call is one sample with the standard deviations below.
struct CAIRN_CPP_SAME_BYTES Wheels {
  using C = cairn_wheels;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_wheels);
  /// Yaw::kRightMinusLeft or Yaw::kLeftMinusRight; default Yaw::kRightMinusLeft
  Yaw yaw_sign{};
  /// r, m, > 0; default 0.3
  double radius{};
  /// B, distance between left and right wheels, m, > 0; default 1.0
  double track{};
  /// noise of each side's wheel rate, rad/s, >= 0; default 0.01
  double rate_sigma{};
  /// noise of each side's wheel rate in proportion to this rate, >= 0; default 0.02
  double slip_sigma{};
  /// side slip: noise of the velocity along y, m/s, >= 0; default 0.01
  double lateral_sigma{};
  /// noise of the velocity along z, m/s, >= 0; default 0.01
  double vertical_sigma{};
  /// noise of the roll rate, which is not measured, rad/s, >= 0; default 0.05
  double roll_rate_sigma{};
  /// noise of the pitch rate, which is not measured, rad/s, >= 0; default 0.05
  double pitch_rate_sigma{};

  /// The defaults of the library.
  Wheels() { detail::fill_defaults<cairn_wheels>(*this, cairn_wheels_init); }
  /// A copy with another `yaw_sign`.
  Wheels with_yaw_sign(const Yaw& value) const {
    Wheels copy = *this;
    copy.yaw_sign = value;
    return copy;
  }
  /// A copy with another `radius`.
  Wheels with_radius(const double& value) const {
    Wheels copy = *this;
    copy.radius = value;
    return copy;
  }
  /// A copy with another `track`.
  Wheels with_track(const double& value) const {
    Wheels copy = *this;
    copy.track = value;
    return copy;
  }
  /// A copy with another `rate_sigma`.
  Wheels with_rate_sigma(const double& value) const {
    Wheels copy = *this;
    copy.rate_sigma = value;
    return copy;
  }
  /// A copy with another `slip_sigma`.
  Wheels with_slip_sigma(const double& value) const {
    Wheels copy = *this;
    copy.slip_sigma = value;
    return copy;
  }
  /// A copy with another `lateral_sigma`.
  Wheels with_lateral_sigma(const double& value) const {
    Wheels copy = *this;
    copy.lateral_sigma = value;
    return copy;
  }
  /// A copy with another `vertical_sigma`.
  Wheels with_vertical_sigma(const double& value) const {
    Wheels copy = *this;
    copy.vertical_sigma = value;
    return copy;
  }
  /// A copy with another `roll_rate_sigma`.
  Wheels with_roll_rate_sigma(const double& value) const {
    Wheels copy = *this;
    copy.roll_rate_sigma = value;
    return copy;
  }
  /// A copy with another `pitch_rate_sigma`.
  Wheels with_pitch_rate_sigma(const double& value) const {
    Wheels copy = *this;
    copy.pitch_rate_sigma = value;
    return copy;
  }
};
static_assert(detail::same_layout<Wheels, cairn_wheels>);
static_assert(offsetof(Wheels, struct_size) == offsetof(cairn_wheels, struct_size) && sizeof(Wheels::struct_size) == sizeof(cairn_wheels::struct_size));
static_assert(offsetof(Wheels, yaw_sign) == offsetof(cairn_wheels, yaw_sign) && sizeof(Wheels::yaw_sign) == sizeof(cairn_wheels::yaw_sign));
static_assert(offsetof(Wheels, radius) == offsetof(cairn_wheels, radius) && sizeof(Wheels::radius) == sizeof(cairn_wheels::radius));
static_assert(offsetof(Wheels, track) == offsetof(cairn_wheels, track) && sizeof(Wheels::track) == sizeof(cairn_wheels::track));
static_assert(offsetof(Wheels, rate_sigma) == offsetof(cairn_wheels, rate_sigma) && sizeof(Wheels::rate_sigma) == sizeof(cairn_wheels::rate_sigma));
static_assert(offsetof(Wheels, slip_sigma) == offsetof(cairn_wheels, slip_sigma) && sizeof(Wheels::slip_sigma) == sizeof(cairn_wheels::slip_sigma));
static_assert(offsetof(Wheels, lateral_sigma) == offsetof(cairn_wheels, lateral_sigma) && sizeof(Wheels::lateral_sigma) == sizeof(cairn_wheels::lateral_sigma));
static_assert(offsetof(Wheels, vertical_sigma) == offsetof(cairn_wheels, vertical_sigma) && sizeof(Wheels::vertical_sigma) == sizeof(cairn_wheels::vertical_sigma));
static_assert(offsetof(Wheels, roll_rate_sigma) == offsetof(cairn_wheels, roll_rate_sigma) && sizeof(Wheels::roll_rate_sigma) == sizeof(cairn_wheels::roll_rate_sigma));
static_assert(offsetof(Wheels, pitch_rate_sigma) == offsetof(cairn_wheels, pitch_rate_sigma) && sizeof(Wheels::pitch_rate_sigma) == sizeof(cairn_wheels::pitch_rate_sigma));

/// Noise of measured body velocity and body rate (IMU, visual odometry). It is white, with a standard deviation per
/// sample and axis (x, y, z of the body). Mars paper, eq. 2, integrated on the group: `T <- T Exp([v; w] dt)`.
struct CAIRN_CPP_SAME_BYTES TwistNoise {
  using C = cairn_twist_noise;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_twist_noise);
  /// leave it zero
  std::uint32_t reserved{};
  /// m/s, >= 0; default 0.05 each
  std::array<double, 3> velocity_sigma{};
  /// rad/s, >= 0; default 0.005 each
  std::array<double, 3> rate_sigma{};

  /// The defaults of the library.
  TwistNoise() { detail::fill_defaults<cairn_twist_noise>(*this, cairn_twist_noise_init); }
  /// A copy with another `velocity_sigma`.
  TwistNoise with_velocity_sigma(const std::array<double, 3>& value) const {
    TwistNoise copy = *this;
    copy.velocity_sigma = value;
    return copy;
  }
  /// A copy with another `rate_sigma`.
  TwistNoise with_rate_sigma(const std::array<double, 3>& value) const {
    TwistNoise copy = *this;
    copy.rate_sigma = value;
    return copy;
  }
};
static_assert(detail::same_layout<TwistNoise, cairn_twist_noise>);
static_assert(offsetof(TwistNoise, struct_size) == offsetof(cairn_twist_noise, struct_size) && sizeof(TwistNoise::struct_size) == sizeof(cairn_twist_noise::struct_size));
static_assert(offsetof(TwistNoise, reserved) == offsetof(cairn_twist_noise, reserved) && sizeof(TwistNoise::reserved) == sizeof(cairn_twist_noise::reserved));
static_assert(offsetof(TwistNoise, velocity_sigma) == offsetof(cairn_twist_noise, velocity_sigma) && sizeof(TwistNoise::velocity_sigma) == sizeof(cairn_twist_noise::velocity_sigma));
static_assert(offsetof(TwistNoise, rate_sigma) == offsetof(cairn_twist_noise, rate_sigma) && sizeof(TwistNoise::rate_sigma) == sizeof(cairn_twist_noise::rate_sigma));

/// Stereo head on a pan and tilt mount (Mars paper, Figures 2 and 3, eq. 4). It observes range, azimuth and elevation.
///
/// A point `m_c` of the camera frame (x out of the lens, y left, z up) lies in the body frame at `m_b = d + Rz(pan)
/// Ry(stick) (s + R(q) m_c)`. The platform stands at `d`. It turns by `pan` about its z axis, and by `stick` about the
/// bolt, which is its y axis. The stick carries the camera at `s`, turned by `q`. The observation is `z = (range,
/// azimuth, elevation)` of `m_c`: `range = |m_c|` (m), `azimuth = atan2(y, x)` (rad, left positive), `elevation =
/// atan2(z, sqrt(x^2 + y^2))` (rad, up positive). A positive stick angle lowers the lens, so a stick that turns by
/// -elevation points the lens at the point. With the default mount the camera frame is the body frame.
struct CAIRN_CPP_SAME_BYTES StereoHead {
  using C = cairn_stereo_head;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_stereo_head);
  /// Encoder::kPerObservation or Encoder::kPerFrame; default Encoder::kPerObservation
  Encoder encoder_mode{};
  /// d: pan axis in the body frame, m; default 0
  std::array<double, 3> platform{};
  /// s: camera in the stick's frame, which has made both turns, m; default 0
  std::array<double, 3> stick{};
  /// q: camera axes in the stick's frame, w x y z; default identity
  std::array<double, 4> camera_quaternion{};
  /// m, > 0; default 1.0 (Table 1)
  double range_sigma{};
  /// rad, > 0; default 3 degrees (Table 1)
  double azimuth_sigma{};
  /// rad, > 0; default 3 degrees (Table 1)
  double elevation_sigma{};
  /// encoder noise of pan, rad, >= 0; default 0
  double pan_sigma{};
  /// encoder noise of the stick, rad, >= 0; default 0
  double stick_sigma{};
  /// an observation is refused if the predicted range, or the observed range of a new landmark, is below this, m, > 0;
  /// default 0.1
  double near_range{};
  /// an observation is also refused above this elevation, where the azimuth is nearly undefined, rad, in (0, pi/2);
  /// default 85 degrees
  double max_elevation{};

  /// The defaults of the library.
  StereoHead() { detail::fill_defaults<cairn_stereo_head>(*this, cairn_stereo_head_init); }
  /// A copy with another `encoder_mode`.
  StereoHead with_encoder_mode(const Encoder& value) const {
    StereoHead copy = *this;
    copy.encoder_mode = value;
    return copy;
  }
  /// A copy with another `platform`.
  StereoHead with_platform(const std::array<double, 3>& value) const {
    StereoHead copy = *this;
    copy.platform = value;
    return copy;
  }
  /// A copy with another `stick`.
  StereoHead with_stick(const std::array<double, 3>& value) const {
    StereoHead copy = *this;
    copy.stick = value;
    return copy;
  }
  /// A copy with another `camera_quaternion`.
  StereoHead with_camera_quaternion(const std::array<double, 4>& value) const {
    StereoHead copy = *this;
    copy.camera_quaternion = value;
    return copy;
  }
  /// A copy with another `range_sigma`.
  StereoHead with_range_sigma(const double& value) const {
    StereoHead copy = *this;
    copy.range_sigma = value;
    return copy;
  }
  /// A copy with another `azimuth_sigma`.
  StereoHead with_azimuth_sigma(const double& value) const {
    StereoHead copy = *this;
    copy.azimuth_sigma = value;
    return copy;
  }
  /// A copy with another `elevation_sigma`.
  StereoHead with_elevation_sigma(const double& value) const {
    StereoHead copy = *this;
    copy.elevation_sigma = value;
    return copy;
  }
  /// A copy with another `pan_sigma`.
  StereoHead with_pan_sigma(const double& value) const {
    StereoHead copy = *this;
    copy.pan_sigma = value;
    return copy;
  }
  /// A copy with another `stick_sigma`.
  StereoHead with_stick_sigma(const double& value) const {
    StereoHead copy = *this;
    copy.stick_sigma = value;
    return copy;
  }
  /// A copy with another `near_range`.
  StereoHead with_near_range(const double& value) const {
    StereoHead copy = *this;
    copy.near_range = value;
    return copy;
  }
  /// A copy with another `max_elevation`.
  StereoHead with_max_elevation(const double& value) const {
    StereoHead copy = *this;
    copy.max_elevation = value;
    return copy;
  }
};
static_assert(detail::same_layout<StereoHead, cairn_stereo_head>);
static_assert(offsetof(StereoHead, struct_size) == offsetof(cairn_stereo_head, struct_size) && sizeof(StereoHead::struct_size) == sizeof(cairn_stereo_head::struct_size));
static_assert(offsetof(StereoHead, encoder_mode) == offsetof(cairn_stereo_head, encoder_mode) && sizeof(StereoHead::encoder_mode) == sizeof(cairn_stereo_head::encoder_mode));
static_assert(offsetof(StereoHead, platform) == offsetof(cairn_stereo_head, platform) && sizeof(StereoHead::platform) == sizeof(cairn_stereo_head::platform));
static_assert(offsetof(StereoHead, stick) == offsetof(cairn_stereo_head, stick) && sizeof(StereoHead::stick) == sizeof(cairn_stereo_head::stick));
static_assert(offsetof(StereoHead, camera_quaternion) == offsetof(cairn_stereo_head, camera_quaternion) && sizeof(StereoHead::camera_quaternion) == sizeof(cairn_stereo_head::camera_quaternion));
static_assert(offsetof(StereoHead, range_sigma) == offsetof(cairn_stereo_head, range_sigma) && sizeof(StereoHead::range_sigma) == sizeof(cairn_stereo_head::range_sigma));
static_assert(offsetof(StereoHead, azimuth_sigma) == offsetof(cairn_stereo_head, azimuth_sigma) && sizeof(StereoHead::azimuth_sigma) == sizeof(cairn_stereo_head::azimuth_sigma));
static_assert(offsetof(StereoHead, elevation_sigma) == offsetof(cairn_stereo_head, elevation_sigma) && sizeof(StereoHead::elevation_sigma) == sizeof(cairn_stereo_head::elevation_sigma));
static_assert(offsetof(StereoHead, pan_sigma) == offsetof(cairn_stereo_head, pan_sigma) && sizeof(StereoHead::pan_sigma) == sizeof(cairn_stereo_head::pan_sigma));
static_assert(offsetof(StereoHead, stick_sigma) == offsetof(cairn_stereo_head, stick_sigma) && sizeof(StereoHead::stick_sigma) == sizeof(cairn_stereo_head::stick_sigma));
static_assert(offsetof(StereoHead, near_range) == offsetof(cairn_stereo_head, near_range) && sizeof(StereoHead::near_range) == sizeof(cairn_stereo_head::near_range));
static_assert(offsetof(StereoHead, max_elevation) == offsetof(cairn_stereo_head, max_elevation) && sizeof(StereoHead::max_elevation) == sizeof(cairn_stereo_head::max_elevation));

/// Rectified stereo camera: `z = (u_left, u_right, v)` in pixels of a point `(x, y, z)` of the left camera's frame (z
/// out of the lens, x right, y down): `u_left = fu x/z + cu`, `u_right = fu (x - baseline)/z + cu`, `v = fv y/z + cv`.
/// If both images give a row, pass the mean of both rows and half the variance of one.
struct CAIRN_CPP_SAME_BYTES StereoCamera {
  using C = cairn_stereo_camera;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_stereo_camera);
  /// leave it zero
  std::uint32_t reserved{};
  /// focal length in u, pixels, > 0; default 500
  double fu{};
  /// focal length in v, pixels, > 0; default 500
  double fv{};
  /// principal point, pixels; default 320
  double cu{};
  /// principal point, pixels; default 240
  double cv{};
  /// m, > 0; default 0.2
  double baseline{};
  /// left camera in the body; default: at the origin, looking along x
  Pose T_body_camera{};
  /// noise of u_left, u_right, v, pixels, > 0; default 1 each
  std::array<double, 3> sigma{};
  /// a landmark whose predicted depth is below this has no image, m, > 0; default 0.1
  double near_depth{};
  /// an observation places a landmark only if its disparity u_left - u_right is at least this, pixels, > 0; default 1
  double min_disparity{};
  /// and only if its disparity is at least this many of its standard deviations (from `sigma`), >= 0; default 2.5: the
  /// depth is known to 40 %. A landmark that is farther away is placed when it is seen from nearer
  double min_disparity_sigmas{};

  /// The defaults of the library.
  StereoCamera() { detail::fill_defaults<cairn_stereo_camera>(*this, cairn_stereo_camera_init); }
  /// A copy with another `fu`.
  StereoCamera with_fu(const double& value) const {
    StereoCamera copy = *this;
    copy.fu = value;
    return copy;
  }
  /// A copy with another `fv`.
  StereoCamera with_fv(const double& value) const {
    StereoCamera copy = *this;
    copy.fv = value;
    return copy;
  }
  /// A copy with another `cu`.
  StereoCamera with_cu(const double& value) const {
    StereoCamera copy = *this;
    copy.cu = value;
    return copy;
  }
  /// A copy with another `cv`.
  StereoCamera with_cv(const double& value) const {
    StereoCamera copy = *this;
    copy.cv = value;
    return copy;
  }
  /// A copy with another `baseline`.
  StereoCamera with_baseline(const double& value) const {
    StereoCamera copy = *this;
    copy.baseline = value;
    return copy;
  }
  /// A copy with another `T_body_camera`.
  StereoCamera with_T_body_camera(const Pose& value) const {
    StereoCamera copy = *this;
    copy.T_body_camera = value;
    return copy;
  }
  /// A copy with another `sigma`.
  StereoCamera with_sigma(const std::array<double, 3>& value) const {
    StereoCamera copy = *this;
    copy.sigma = value;
    return copy;
  }
  /// A copy with another `near_depth`.
  StereoCamera with_near_depth(const double& value) const {
    StereoCamera copy = *this;
    copy.near_depth = value;
    return copy;
  }
  /// A copy with another `min_disparity`.
  StereoCamera with_min_disparity(const double& value) const {
    StereoCamera copy = *this;
    copy.min_disparity = value;
    return copy;
  }
  /// A copy with another `min_disparity_sigmas`.
  StereoCamera with_min_disparity_sigmas(const double& value) const {
    StereoCamera copy = *this;
    copy.min_disparity_sigmas = value;
    return copy;
  }
};
static_assert(detail::same_layout<StereoCamera, cairn_stereo_camera>);
static_assert(offsetof(StereoCamera, struct_size) == offsetof(cairn_stereo_camera, struct_size) && sizeof(StereoCamera::struct_size) == sizeof(cairn_stereo_camera::struct_size));
static_assert(offsetof(StereoCamera, reserved) == offsetof(cairn_stereo_camera, reserved) && sizeof(StereoCamera::reserved) == sizeof(cairn_stereo_camera::reserved));
static_assert(offsetof(StereoCamera, fu) == offsetof(cairn_stereo_camera, fu) && sizeof(StereoCamera::fu) == sizeof(cairn_stereo_camera::fu));
static_assert(offsetof(StereoCamera, fv) == offsetof(cairn_stereo_camera, fv) && sizeof(StereoCamera::fv) == sizeof(cairn_stereo_camera::fv));
static_assert(offsetof(StereoCamera, cu) == offsetof(cairn_stereo_camera, cu) && sizeof(StereoCamera::cu) == sizeof(cairn_stereo_camera::cu));
static_assert(offsetof(StereoCamera, cv) == offsetof(cairn_stereo_camera, cv) && sizeof(StereoCamera::cv) == sizeof(cairn_stereo_camera::cv));
static_assert(offsetof(StereoCamera, baseline) == offsetof(cairn_stereo_camera, baseline) && sizeof(StereoCamera::baseline) == sizeof(cairn_stereo_camera::baseline));
static_assert(offsetof(StereoCamera, T_body_camera) == offsetof(cairn_stereo_camera, T_body_camera) && sizeof(StereoCamera::T_body_camera) == sizeof(cairn_stereo_camera::T_body_camera));
static_assert(offsetof(StereoCamera, sigma) == offsetof(cairn_stereo_camera, sigma) && sizeof(StereoCamera::sigma) == sizeof(cairn_stereo_camera::sigma));
static_assert(offsetof(StereoCamera, near_depth) == offsetof(cairn_stereo_camera, near_depth) && sizeof(StereoCamera::near_depth) == sizeof(cairn_stereo_camera::near_depth));
static_assert(offsetof(StereoCamera, min_disparity) == offsetof(cairn_stereo_camera, min_disparity) && sizeof(StereoCamera::min_disparity) == sizeof(cairn_stereo_camera::min_disparity));
static_assert(offsetof(StereoCamera, min_disparity_sigmas) == offsetof(cairn_stereo_camera, min_disparity_sigmas) && sizeof(StereoCamera::min_disparity_sigmas) == sizeof(cairn_stereo_camera::min_disparity_sigmas));

/// Radar, lidar or sonar of a planar vehicle: `z = (range, bearing)` of the landmark in the sensor's frame, m and rad,
/// positive to the left.
struct CAIRN_CPP_SAME_BYTES RangeBearing {
  using C = cairn_range_bearing;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_range_bearing);
  /// leave it zero
  std::uint32_t reserved{};
  /// sensor in the body, in the plane; default identity
  Pose T_body_sensor{};
  /// m, > 0; default 0.1
  double range_sigma{};
  /// rad, > 0; default 0.01
  double bearing_sigma{};
  /// an observation is refused if the predicted range, or the observed range of a new landmark, is below this, m, > 0;
  /// default 0.01
  double near_range{};

  /// The defaults of the library.
  RangeBearing() { detail::fill_defaults<cairn_range_bearing>(*this, cairn_range_bearing_init); }
  /// A copy with another `T_body_sensor`.
  RangeBearing with_T_body_sensor(const Pose& value) const {
    RangeBearing copy = *this;
    copy.T_body_sensor = value;
    return copy;
  }
  /// A copy with another `range_sigma`.
  RangeBearing with_range_sigma(const double& value) const {
    RangeBearing copy = *this;
    copy.range_sigma = value;
    return copy;
  }
  /// A copy with another `bearing_sigma`.
  RangeBearing with_bearing_sigma(const double& value) const {
    RangeBearing copy = *this;
    copy.bearing_sigma = value;
    return copy;
  }
  /// A copy with another `near_range`.
  RangeBearing with_near_range(const double& value) const {
    RangeBearing copy = *this;
    copy.near_range = value;
    return copy;
  }
};
static_assert(detail::same_layout<RangeBearing, cairn_range_bearing>);
static_assert(offsetof(RangeBearing, struct_size) == offsetof(cairn_range_bearing, struct_size) && sizeof(RangeBearing::struct_size) == sizeof(cairn_range_bearing::struct_size));
static_assert(offsetof(RangeBearing, reserved) == offsetof(cairn_range_bearing, reserved) && sizeof(RangeBearing::reserved) == sizeof(cairn_range_bearing::reserved));
static_assert(offsetof(RangeBearing, T_body_sensor) == offsetof(cairn_range_bearing, T_body_sensor) && sizeof(RangeBearing::T_body_sensor) == sizeof(cairn_range_bearing::T_body_sensor));
static_assert(offsetof(RangeBearing, range_sigma) == offsetof(cairn_range_bearing, range_sigma) && sizeof(RangeBearing::range_sigma) == sizeof(cairn_range_bearing::range_sigma));
static_assert(offsetof(RangeBearing, bearing_sigma) == offsetof(cairn_range_bearing, bearing_sigma) && sizeof(RangeBearing::bearing_sigma) == sizeof(cairn_range_bearing::bearing_sigma));
static_assert(offsetof(RangeBearing, near_range) == offsetof(cairn_range_bearing, near_range) && sizeof(RangeBearing::near_range) == sizeof(cairn_range_bearing::near_range));

/// Any sensor that gives a point: `z = (x, y, z)` of the landmark in the sensor's frame, m; for a planar vehicle `z =
/// (x, y)`.
struct CAIRN_CPP_SAME_BYTES Cartesian {
  using C = cairn_cartesian;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_cartesian);
  /// leave it zero
  std::uint32_t reserved{};
  /// sensor in the body; default identity
  Pose T_body_sensor{};
  /// noise of x, y, z, m, > 0; default 0.1 each
  std::array<double, 3> sigma{};

  /// The defaults of the library.
  Cartesian() { detail::fill_defaults<cairn_cartesian>(*this, cairn_cartesian_init); }
  /// A copy with another `T_body_sensor`.
  Cartesian with_T_body_sensor(const Pose& value) const {
    Cartesian copy = *this;
    copy.T_body_sensor = value;
    return copy;
  }
  /// A copy with another `sigma`.
  Cartesian with_sigma(const std::array<double, 3>& value) const {
    Cartesian copy = *this;
    copy.sigma = value;
    return copy;
  }
};
static_assert(detail::same_layout<Cartesian, cairn_cartesian>);
static_assert(offsetof(Cartesian, struct_size) == offsetof(cairn_cartesian, struct_size) && sizeof(Cartesian::struct_size) == sizeof(cairn_cartesian::struct_size));
static_assert(offsetof(Cartesian, reserved) == offsetof(cairn_cartesian, reserved) && sizeof(Cartesian::reserved) == sizeof(cairn_cartesian::reserved));
static_assert(offsetof(Cartesian, T_body_sensor) == offsetof(cairn_cartesian, T_body_sensor) && sizeof(Cartesian::T_body_sensor) == sizeof(cairn_cartesian::T_body_sensor));
static_assert(offsetof(Cartesian, sigma) == offsetof(cairn_cartesian, sigma) && sizeof(Cartesian::sigma) == sizeof(cairn_cartesian::sigma));

/// A sensor of the caller's own, whose model are two functions (Filter::add_custom).
struct CAIRN_CPP_SAME_BYTES Custom {
  using C = cairn_custom;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_custom);
  /// values of an observation, 1 to 3; for a planar vehicle 1 or 2; default 3
  std::uint32_t rows{};
  /// bit i is set: value i is an angle (rad) and its residual is wrapped to (-pi, pi]; default 0
  std::uint32_t angle_mask{};
  /// 1: z depends on pose and landmark only through the body point R^T (l - p), and the filter makes use of that;
  /// default 0: any function of both
  Bool relative{};
  /// noise of each value, > 0; default 1 each
  std::array<double, 3> sigma{};

  /// The defaults of the library.
  Custom() { detail::fill_defaults<cairn_custom>(*this, cairn_custom_init); }
  /// A copy with another `rows`.
  Custom with_rows(const std::uint32_t& value) const {
    Custom copy = *this;
    copy.rows = value;
    return copy;
  }
  /// A copy with another `angle_mask`.
  Custom with_angle_mask(const std::uint32_t& value) const {
    Custom copy = *this;
    copy.angle_mask = value;
    return copy;
  }
  /// A copy with another `relative`.
  Custom with_relative(const Bool& value) const {
    Custom copy = *this;
    copy.relative = value;
    return copy;
  }
  /// A copy with another `sigma`.
  Custom with_sigma(const std::array<double, 3>& value) const {
    Custom copy = *this;
    copy.sigma = value;
    return copy;
  }
};
static_assert(detail::same_layout<Custom, cairn_custom>);
static_assert(offsetof(Custom, struct_size) == offsetof(cairn_custom, struct_size) && sizeof(Custom::struct_size) == sizeof(cairn_custom::struct_size));
static_assert(offsetof(Custom, rows) == offsetof(cairn_custom, rows) && sizeof(Custom::rows) == sizeof(cairn_custom::rows));
static_assert(offsetof(Custom, angle_mask) == offsetof(cairn_custom, angle_mask) && sizeof(Custom::angle_mask) == sizeof(cairn_custom::angle_mask));
static_assert(offsetof(Custom, relative) == offsetof(cairn_custom, relative) && sizeof(Custom::relative) == sizeof(cairn_custom::relative));
static_assert(offsetof(Custom, sigma) == offsetof(cairn_custom, sigma) && sizeof(Custom::sigma) == sizeof(cairn_custom::sigma));

/// One observation of one landmark by one sensor. Layout frozen.
struct CAIRN_CPP_SAME_BYTES Observation {
  using C = cairn_observation;
  /// the caller's id of the landmark; not kIdNone; once in a frame. Any value if the filter's `association` is not
  /// Association::kKnown
  std::uint64_t id{};
  /// values in the sensor's units; a custom sensor of fewer rows uses the first
  std::array<double, 3> z{};
  /// noise of this observation, 3x3 row-major (custom: rows x rows, packed); all zero: the sensor's noise
  std::array<double, 9> covariance{};
};
static_assert(detail::same_layout<Observation, cairn_observation>);
static_assert(offsetof(Observation, id) == offsetof(cairn_observation, id) && sizeof(Observation::id) == sizeof(cairn_observation::id));
static_assert(offsetof(Observation, z) == offsetof(cairn_observation, z) && sizeof(Observation::z) == sizeof(cairn_observation::z));
static_assert(offsetof(Observation, covariance) == offsetof(cairn_observation, covariance) && sizeof(Observation::covariance) == sizeof(cairn_observation::covariance));

/// Match of one observation: what it was paired with, and whether it was used. Layout frozen.
struct CAIRN_CPP_SAME_BYTES Match {
  using C = cairn_match;
  /// landmark that the observation was compared with or that it placed; kIdNone if there is none
  std::uint64_t landmark{};
  /// Result::kMatched, Result::kNew or Result::kRejected
  Result result{};
  /// one of the CAIRN_REASON_ constants
  Reason reason{};
  /// squared Mahalanobis distance of the innovation (Reason::kBatchGate: that of the whole batch when this observation
  /// was removed); 0 if there is none
  double distance{};
  /// chi-square bound that `distance` was compared with (infinity at a gate probability of 1); 0 if there is none
  double threshold{};
};
static_assert(detail::same_layout<Match, cairn_match>);
static_assert(offsetof(Match, landmark) == offsetof(cairn_match, landmark) && sizeof(Match::landmark) == sizeof(cairn_match::landmark));
static_assert(offsetof(Match, result) == offsetof(cairn_match, result) && sizeof(Match::result) == sizeof(cairn_match::result));
static_assert(offsetof(Match, reason) == offsetof(cairn_match, reason) && sizeof(Match::reason) == sizeof(cairn_match::reason));
static_assert(offsetof(Match, distance) == offsetof(cairn_match, distance) && sizeof(Match::distance) == sizeof(cairn_match::distance));
static_assert(offsetof(Match, threshold) == offsetof(cairn_match, threshold) && sizeof(Match::threshold) == sizeof(cairn_match::threshold));

/// Options of Filter::Filter. Set them by FilterOptions::FilterOptions first.
struct CAIRN_CPP_SAME_BYTES FilterOptions {
  using C = cairn_filter_options;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_filter_options);
  /// Vehicle::kSpatial or Vehicle::kPlanar; default Vehicle::kSpatial
  Vehicle vehicle{};
  /// StateError::kInvariant or StateError::kStandard; default StateError::kInvariant
  StateError state_error{};
  /// capacity; default 1000. Single map or dense joining: 1 to 30000, the memory grows with the square of this number
  /// and is taken at creation. Sparse joining: 1 to 10000000, only a bound, memory is taken as the map grows
  std::uint32_t max_landmarks{};
  /// observations of one frame, 1 to 4096; default 64
  std::uint32_t max_observations{};
  /// sensors that can be added, 1 to 256; default 8
  std::uint32_t max_sensors{};
  /// body in the map frame at the start; default identity
  Pose initial_pose{};
  /// covariance of its error [dp; dtheta], symmetric, positive semidefinite; default 0: known exactly
  std::array<double, 36> initial_covariance{};
  /// linearisations of an update at most, 1 (plain EKF) to 50; default 3
  std::uint32_t iterations{};
  /// NoiseLearning::kReported or NoiseLearning::kApplied; default NoiseLearning::kReported
  NoiseLearning noise_learning{};
  /// the iteration ends when the linearisation error of the batch is smaller than this, > 0; it is measured in standard
  /// deviations of the observations, root of the sum of squares; default 0.1
  double iteration_tolerance{};
  /// chi-square gate of one observation, in (0, 1]; 1: no gate; default 0.999
  double gate_probability{};
  /// chi-square gate of a whole batch, in (0, 1]; 1: no gate; default 0.9999
  double batch_gate_probability{};
  /// number of consecutive observations of a landmark whose errors are fully correlated, 1 to 1000000: an update
  /// multiplies the covariance of an observation's noise by this; association, placing and the weights of a robust loss
  /// use the noise unchanged; default 1
  double error_persistence{};
  /// Association::kKnown, Association::kNearest or Association::kJoint; default Association::kKnown
  Association association{};
  /// Distance::kMahalanobis or Distance::kLikelihood; default Distance::kMahalanobis
  Distance association_distance{};
  /// joint tests of one frame at most, 1 to 1000000; after this number the best set found so far is used; default 2000
  std::uint32_t association_nodes{};
  /// a new landmark is deferred until it was observed this often, 1 to 1000: until then it is part of the estimate, but
  /// no map shows it; default 1
  std::uint32_t deferred_sightings{};
  /// a deferred landmark is removed if it is not observed often enough within this many frames, 1 to 1000000; default
  /// 20
  std::uint32_t deferred_frames{};
  /// a landmark is removed if it lay in a sensor's view (Filter::set_view), but was not seen, in this many consecutive
  /// frames of this sensor; 0, the default: never
  std::uint32_t missed_frames{};
  /// unknown ids: an observation places a new landmark only if its distance from each landmark exceeds the chi-square
  /// bound of this probability, in (0, 1). Landmarks that another observation of the frame is paired with do not count.
  /// A pair beyond this bound is never made. Default 0.9999
  double new_probability{};
  /// a submap is closed when it holds this many landmarks, up to 4096; 0, the default: no submaps, one single map
  std::uint32_t submap_landmarks{};
  /// Join::kAuto, Join::kDense or Join::kSparse; default Join::kAuto
  Join join{};
  /// loss of the landmarks that a closed submap shares with the map: Loss::kNone, Loss::kHuber or Loss::kCauchy;
  /// default Loss::kNone
  Loss join_loss{};
  /// newest poses that are kept for Filter::trajectory, 0 to 10000000; 0, the default: none. The memory is taken at
  /// creation, at most 600 bytes a pose
  std::uint32_t trajectory_poses{};
  /// where `join_loss` leaves the parabola, standard deviations, > 0; default 1.5
  double join_loss_width{};
  /// a submap is also closed when the vehicle has driven this far in it, m; 0, the default: no limit
  double submap_distance{};
  /// a submap is also closed when a landmark lies this far from its origin, m; 0, the default: no limit
  double submap_extent{};
  /// a submap is also closed when the largest standard deviation of the vehicle's position in it exceeds this, m; 0,
  /// the default: no limit
  double submap_sigma{};
  /// a constant error of the measured body velocity (x, y, z) is a state, with this standard deviation at the start,
  /// m/s, >= 0; 0, the default: no state. The velocity is the measured one minus the bias (docs/systematic_errors.md).
  /// A planar vehicle has only x and y
  std::array<double, 3> velocity_bias_sigma{};
  /// random walk of that error, m/s in the square root of a second, >= 0; it needs its velocity_bias_sigma; default 0:
  /// constant
  std::array<double, 3> velocity_bias_walk{};
  /// the same for the measured body rate, rad/s, >= 0; default 0. A planar vehicle has only z
  std::array<double, 3> rate_bias_sigma{};
  /// rad/s in the square root of a second, >= 0; default 0
  std::array<double, 3> rate_bias_walk{};
  /// the same for the scales of the left and the right wheels: a wheel turns at the measured rate times 1 + its scale,
  /// >= 0; default 0
  std::array<double, 2> wheel_scale_sigma{};
  /// in the square root of a second, >= 0; default 0
  std::array<double, 2> wheel_scale_walk{};
  /// numbers that Filter::calibrate_sensor makes states, over all sensors, 0 to 64; default 0
  std::uint32_t max_sensor_errors{};
  /// leave it zero
  std::uint32_t reserved{};

  /// The defaults of the library.
  FilterOptions() { detail::fill_defaults<cairn_filter_options>(*this, cairn_filter_options_init); }
  /// A copy with another `vehicle`.
  FilterOptions with_vehicle(const Vehicle& value) const {
    FilterOptions copy = *this;
    copy.vehicle = value;
    return copy;
  }
  /// A copy with another `state_error`.
  FilterOptions with_state_error(const StateError& value) const {
    FilterOptions copy = *this;
    copy.state_error = value;
    return copy;
  }
  /// A copy with another `max_landmarks`.
  FilterOptions with_max_landmarks(const std::uint32_t& value) const {
    FilterOptions copy = *this;
    copy.max_landmarks = value;
    return copy;
  }
  /// A copy with another `max_observations`.
  FilterOptions with_max_observations(const std::uint32_t& value) const {
    FilterOptions copy = *this;
    copy.max_observations = value;
    return copy;
  }
  /// A copy with another `max_sensors`.
  FilterOptions with_max_sensors(const std::uint32_t& value) const {
    FilterOptions copy = *this;
    copy.max_sensors = value;
    return copy;
  }
  /// A copy with another `initial_pose`.
  FilterOptions with_initial_pose(const Pose& value) const {
    FilterOptions copy = *this;
    copy.initial_pose = value;
    return copy;
  }
  /// A copy with another `initial_covariance`.
  FilterOptions with_initial_covariance(const std::array<double, 36>& value) const {
    FilterOptions copy = *this;
    copy.initial_covariance = value;
    return copy;
  }
  /// A copy with another `iterations`.
  FilterOptions with_iterations(const std::uint32_t& value) const {
    FilterOptions copy = *this;
    copy.iterations = value;
    return copy;
  }
  /// A copy with another `noise_learning`.
  FilterOptions with_noise_learning(const NoiseLearning& value) const {
    FilterOptions copy = *this;
    copy.noise_learning = value;
    return copy;
  }
  /// A copy with another `iteration_tolerance`.
  FilterOptions with_iteration_tolerance(const double& value) const {
    FilterOptions copy = *this;
    copy.iteration_tolerance = value;
    return copy;
  }
  /// A copy with another `gate_probability`.
  FilterOptions with_gate_probability(const double& value) const {
    FilterOptions copy = *this;
    copy.gate_probability = value;
    return copy;
  }
  /// A copy with another `batch_gate_probability`.
  FilterOptions with_batch_gate_probability(const double& value) const {
    FilterOptions copy = *this;
    copy.batch_gate_probability = value;
    return copy;
  }
  /// A copy with another `error_persistence`.
  FilterOptions with_error_persistence(const double& value) const {
    FilterOptions copy = *this;
    copy.error_persistence = value;
    return copy;
  }
  /// A copy with another `association`.
  FilterOptions with_association(const Association& value) const {
    FilterOptions copy = *this;
    copy.association = value;
    return copy;
  }
  /// A copy with another `association_distance`.
  FilterOptions with_association_distance(const Distance& value) const {
    FilterOptions copy = *this;
    copy.association_distance = value;
    return copy;
  }
  /// A copy with another `association_nodes`.
  FilterOptions with_association_nodes(const std::uint32_t& value) const {
    FilterOptions copy = *this;
    copy.association_nodes = value;
    return copy;
  }
  /// A copy with another `deferred_sightings`.
  FilterOptions with_deferred_sightings(const std::uint32_t& value) const {
    FilterOptions copy = *this;
    copy.deferred_sightings = value;
    return copy;
  }
  /// A copy with another `deferred_frames`.
  FilterOptions with_deferred_frames(const std::uint32_t& value) const {
    FilterOptions copy = *this;
    copy.deferred_frames = value;
    return copy;
  }
  /// A copy with another `missed_frames`.
  FilterOptions with_missed_frames(const std::uint32_t& value) const {
    FilterOptions copy = *this;
    copy.missed_frames = value;
    return copy;
  }
  /// A copy with another `new_probability`.
  FilterOptions with_new_probability(const double& value) const {
    FilterOptions copy = *this;
    copy.new_probability = value;
    return copy;
  }
  /// A copy with another `submap_landmarks`.
  FilterOptions with_submap_landmarks(const std::uint32_t& value) const {
    FilterOptions copy = *this;
    copy.submap_landmarks = value;
    return copy;
  }
  /// A copy with another `join`.
  FilterOptions with_join(const Join& value) const {
    FilterOptions copy = *this;
    copy.join = value;
    return copy;
  }
  /// A copy with another `join_loss`.
  FilterOptions with_join_loss(const Loss& value) const {
    FilterOptions copy = *this;
    copy.join_loss = value;
    return copy;
  }
  /// A copy with another `trajectory_poses`.
  FilterOptions with_trajectory_poses(const std::uint32_t& value) const {
    FilterOptions copy = *this;
    copy.trajectory_poses = value;
    return copy;
  }
  /// A copy with another `join_loss_width`.
  FilterOptions with_join_loss_width(const double& value) const {
    FilterOptions copy = *this;
    copy.join_loss_width = value;
    return copy;
  }
  /// A copy with another `submap_distance`.
  FilterOptions with_submap_distance(const double& value) const {
    FilterOptions copy = *this;
    copy.submap_distance = value;
    return copy;
  }
  /// A copy with another `submap_extent`.
  FilterOptions with_submap_extent(const double& value) const {
    FilterOptions copy = *this;
    copy.submap_extent = value;
    return copy;
  }
  /// A copy with another `submap_sigma`.
  FilterOptions with_submap_sigma(const double& value) const {
    FilterOptions copy = *this;
    copy.submap_sigma = value;
    return copy;
  }
  /// A copy with another `velocity_bias_sigma`.
  FilterOptions with_velocity_bias_sigma(const std::array<double, 3>& value) const {
    FilterOptions copy = *this;
    copy.velocity_bias_sigma = value;
    return copy;
  }
  /// A copy with another `velocity_bias_walk`.
  FilterOptions with_velocity_bias_walk(const std::array<double, 3>& value) const {
    FilterOptions copy = *this;
    copy.velocity_bias_walk = value;
    return copy;
  }
  /// A copy with another `rate_bias_sigma`.
  FilterOptions with_rate_bias_sigma(const std::array<double, 3>& value) const {
    FilterOptions copy = *this;
    copy.rate_bias_sigma = value;
    return copy;
  }
  /// A copy with another `rate_bias_walk`.
  FilterOptions with_rate_bias_walk(const std::array<double, 3>& value) const {
    FilterOptions copy = *this;
    copy.rate_bias_walk = value;
    return copy;
  }
  /// A copy with another `wheel_scale_sigma`.
  FilterOptions with_wheel_scale_sigma(const std::array<double, 2>& value) const {
    FilterOptions copy = *this;
    copy.wheel_scale_sigma = value;
    return copy;
  }
  /// A copy with another `wheel_scale_walk`.
  FilterOptions with_wheel_scale_walk(const std::array<double, 2>& value) const {
    FilterOptions copy = *this;
    copy.wheel_scale_walk = value;
    return copy;
  }
  /// A copy with another `max_sensor_errors`.
  FilterOptions with_max_sensor_errors(const std::uint32_t& value) const {
    FilterOptions copy = *this;
    copy.max_sensor_errors = value;
    return copy;
  }
};
static_assert(detail::same_layout<FilterOptions, cairn_filter_options>);
static_assert(offsetof(FilterOptions, struct_size) == offsetof(cairn_filter_options, struct_size) && sizeof(FilterOptions::struct_size) == sizeof(cairn_filter_options::struct_size));
static_assert(offsetof(FilterOptions, vehicle) == offsetof(cairn_filter_options, vehicle) && sizeof(FilterOptions::vehicle) == sizeof(cairn_filter_options::vehicle));
static_assert(offsetof(FilterOptions, state_error) == offsetof(cairn_filter_options, state_error) && sizeof(FilterOptions::state_error) == sizeof(cairn_filter_options::state_error));
static_assert(offsetof(FilterOptions, max_landmarks) == offsetof(cairn_filter_options, max_landmarks) && sizeof(FilterOptions::max_landmarks) == sizeof(cairn_filter_options::max_landmarks));
static_assert(offsetof(FilterOptions, max_observations) == offsetof(cairn_filter_options, max_observations) && sizeof(FilterOptions::max_observations) == sizeof(cairn_filter_options::max_observations));
static_assert(offsetof(FilterOptions, max_sensors) == offsetof(cairn_filter_options, max_sensors) && sizeof(FilterOptions::max_sensors) == sizeof(cairn_filter_options::max_sensors));
static_assert(offsetof(FilterOptions, initial_pose) == offsetof(cairn_filter_options, initial_pose) && sizeof(FilterOptions::initial_pose) == sizeof(cairn_filter_options::initial_pose));
static_assert(offsetof(FilterOptions, initial_covariance) == offsetof(cairn_filter_options, initial_covariance) && sizeof(FilterOptions::initial_covariance) == sizeof(cairn_filter_options::initial_covariance));
static_assert(offsetof(FilterOptions, iterations) == offsetof(cairn_filter_options, iterations) && sizeof(FilterOptions::iterations) == sizeof(cairn_filter_options::iterations));
static_assert(offsetof(FilterOptions, noise_learning) == offsetof(cairn_filter_options, noise_learning) && sizeof(FilterOptions::noise_learning) == sizeof(cairn_filter_options::noise_learning));
static_assert(offsetof(FilterOptions, iteration_tolerance) == offsetof(cairn_filter_options, iteration_tolerance) && sizeof(FilterOptions::iteration_tolerance) == sizeof(cairn_filter_options::iteration_tolerance));
static_assert(offsetof(FilterOptions, gate_probability) == offsetof(cairn_filter_options, gate_probability) && sizeof(FilterOptions::gate_probability) == sizeof(cairn_filter_options::gate_probability));
static_assert(offsetof(FilterOptions, batch_gate_probability) == offsetof(cairn_filter_options, batch_gate_probability) && sizeof(FilterOptions::batch_gate_probability) == sizeof(cairn_filter_options::batch_gate_probability));
static_assert(offsetof(FilterOptions, error_persistence) == offsetof(cairn_filter_options, error_persistence) && sizeof(FilterOptions::error_persistence) == sizeof(cairn_filter_options::error_persistence));
static_assert(offsetof(FilterOptions, association) == offsetof(cairn_filter_options, association) && sizeof(FilterOptions::association) == sizeof(cairn_filter_options::association));
static_assert(offsetof(FilterOptions, association_distance) == offsetof(cairn_filter_options, association_distance) && sizeof(FilterOptions::association_distance) == sizeof(cairn_filter_options::association_distance));
static_assert(offsetof(FilterOptions, association_nodes) == offsetof(cairn_filter_options, association_nodes) && sizeof(FilterOptions::association_nodes) == sizeof(cairn_filter_options::association_nodes));
static_assert(offsetof(FilterOptions, deferred_sightings) == offsetof(cairn_filter_options, deferred_sightings) && sizeof(FilterOptions::deferred_sightings) == sizeof(cairn_filter_options::deferred_sightings));
static_assert(offsetof(FilterOptions, deferred_frames) == offsetof(cairn_filter_options, deferred_frames) && sizeof(FilterOptions::deferred_frames) == sizeof(cairn_filter_options::deferred_frames));
static_assert(offsetof(FilterOptions, missed_frames) == offsetof(cairn_filter_options, missed_frames) && sizeof(FilterOptions::missed_frames) == sizeof(cairn_filter_options::missed_frames));
static_assert(offsetof(FilterOptions, new_probability) == offsetof(cairn_filter_options, new_probability) && sizeof(FilterOptions::new_probability) == sizeof(cairn_filter_options::new_probability));
static_assert(offsetof(FilterOptions, submap_landmarks) == offsetof(cairn_filter_options, submap_landmarks) && sizeof(FilterOptions::submap_landmarks) == sizeof(cairn_filter_options::submap_landmarks));
static_assert(offsetof(FilterOptions, join) == offsetof(cairn_filter_options, join) && sizeof(FilterOptions::join) == sizeof(cairn_filter_options::join));
static_assert(offsetof(FilterOptions, join_loss) == offsetof(cairn_filter_options, join_loss) && sizeof(FilterOptions::join_loss) == sizeof(cairn_filter_options::join_loss));
static_assert(offsetof(FilterOptions, trajectory_poses) == offsetof(cairn_filter_options, trajectory_poses) && sizeof(FilterOptions::trajectory_poses) == sizeof(cairn_filter_options::trajectory_poses));
static_assert(offsetof(FilterOptions, join_loss_width) == offsetof(cairn_filter_options, join_loss_width) && sizeof(FilterOptions::join_loss_width) == sizeof(cairn_filter_options::join_loss_width));
static_assert(offsetof(FilterOptions, submap_distance) == offsetof(cairn_filter_options, submap_distance) && sizeof(FilterOptions::submap_distance) == sizeof(cairn_filter_options::submap_distance));
static_assert(offsetof(FilterOptions, submap_extent) == offsetof(cairn_filter_options, submap_extent) && sizeof(FilterOptions::submap_extent) == sizeof(cairn_filter_options::submap_extent));
static_assert(offsetof(FilterOptions, submap_sigma) == offsetof(cairn_filter_options, submap_sigma) && sizeof(FilterOptions::submap_sigma) == sizeof(cairn_filter_options::submap_sigma));
static_assert(offsetof(FilterOptions, velocity_bias_sigma) == offsetof(cairn_filter_options, velocity_bias_sigma) && sizeof(FilterOptions::velocity_bias_sigma) == sizeof(cairn_filter_options::velocity_bias_sigma));
static_assert(offsetof(FilterOptions, velocity_bias_walk) == offsetof(cairn_filter_options, velocity_bias_walk) && sizeof(FilterOptions::velocity_bias_walk) == sizeof(cairn_filter_options::velocity_bias_walk));
static_assert(offsetof(FilterOptions, rate_bias_sigma) == offsetof(cairn_filter_options, rate_bias_sigma) && sizeof(FilterOptions::rate_bias_sigma) == sizeof(cairn_filter_options::rate_bias_sigma));
static_assert(offsetof(FilterOptions, rate_bias_walk) == offsetof(cairn_filter_options, rate_bias_walk) && sizeof(FilterOptions::rate_bias_walk) == sizeof(cairn_filter_options::rate_bias_walk));
static_assert(offsetof(FilterOptions, wheel_scale_sigma) == offsetof(cairn_filter_options, wheel_scale_sigma) && sizeof(FilterOptions::wheel_scale_sigma) == sizeof(cairn_filter_options::wheel_scale_sigma));
static_assert(offsetof(FilterOptions, wheel_scale_walk) == offsetof(cairn_filter_options, wheel_scale_walk) && sizeof(FilterOptions::wheel_scale_walk) == sizeof(cairn_filter_options::wheel_scale_walk));
static_assert(offsetof(FilterOptions, max_sensor_errors) == offsetof(cairn_filter_options, max_sensor_errors) && sizeof(FilterOptions::max_sensor_errors) == sizeof(cairn_filter_options::max_sensor_errors));
static_assert(offsetof(FilterOptions, reserved) == offsetof(cairn_filter_options, reserved) && sizeof(FilterOptions::reserved) == sizeof(cairn_filter_options::reserved));

/// Report of the last attempt to close a submap.
struct CAIRN_CPP_SAME_BYTES ClosingReport {
  using C = cairn_closing_report;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_closing_report);
  /// Status::kOk, or the error because of which the submap stayed open
  Status status{};
  /// CAIRN_CLOSED_BY_...
  ClosedBy reason{};
  /// submaps closed so far
  std::uint32_t submaps{};
  /// landmarks of the submap
  std::uint32_t landmarks{};
  /// landmarks of the submap that are new to the map
  std::uint32_t landmarks_new{};
  /// landmarks of the submap that the map knows, and that were fused with it
  std::uint32_t landmarks_fused{};
  /// landmarks of the submap that contradict the map's estimates, and that were left out
  std::uint32_t landmarks_refused{};
  /// unknown ids: landmarks of the submap that may be landmarks of the map, but no pair is certain: left out
  std::uint32_t landmarks_ambiguous{};
  /// degrees of freedom of `distance`
  std::uint32_t rows{};
  /// joint squared Mahalanobis distance between both estimates of the fused landmarks
  double distance{};
  /// its chi-square bound at batch_gate_probability
  double threshold{};
  /// largest movement of an older landmark of the map, m
  double moved_max{};
  /// root mean square of these movements, m
  double moved_rms{};
  /// most known landmarks of the submap contradicted the map and agreed on another pose of its origin: how far from the
  /// estimate, m; 0: they did not (docs/update.md, "Finding back")
  double widened_position{};
  /// the same of the attitude, rad
  double widened_attitude{};
  /// joint tests of the association with the map
  std::uint32_t association_nodes{};
  /// 1: it stopped at the bound `association_nodes` of the options
  Bool association_exhausted{};
  /// submaps linearised again (sparse)
  std::uint32_t relinearised{};
  /// blocks of the factor computed again (sparse)
  std::uint32_t refactored{};
  /// linear solutions
  std::uint32_t iterations{};
  /// leave it zero
  std::uint32_t reserved{};
  /// duration of the closing, s; it differs from run to run
  double seconds{};
};
static_assert(detail::same_layout<ClosingReport, cairn_closing_report>);
static_assert(offsetof(ClosingReport, struct_size) == offsetof(cairn_closing_report, struct_size) && sizeof(ClosingReport::struct_size) == sizeof(cairn_closing_report::struct_size));
static_assert(offsetof(ClosingReport, status) == offsetof(cairn_closing_report, status) && sizeof(ClosingReport::status) == sizeof(cairn_closing_report::status));
static_assert(offsetof(ClosingReport, reason) == offsetof(cairn_closing_report, reason) && sizeof(ClosingReport::reason) == sizeof(cairn_closing_report::reason));
static_assert(offsetof(ClosingReport, submaps) == offsetof(cairn_closing_report, submaps) && sizeof(ClosingReport::submaps) == sizeof(cairn_closing_report::submaps));
static_assert(offsetof(ClosingReport, landmarks) == offsetof(cairn_closing_report, landmarks) && sizeof(ClosingReport::landmarks) == sizeof(cairn_closing_report::landmarks));
static_assert(offsetof(ClosingReport, landmarks_new) == offsetof(cairn_closing_report, landmarks_new) && sizeof(ClosingReport::landmarks_new) == sizeof(cairn_closing_report::landmarks_new));
static_assert(offsetof(ClosingReport, landmarks_fused) == offsetof(cairn_closing_report, landmarks_fused) && sizeof(ClosingReport::landmarks_fused) == sizeof(cairn_closing_report::landmarks_fused));
static_assert(offsetof(ClosingReport, landmarks_refused) == offsetof(cairn_closing_report, landmarks_refused) && sizeof(ClosingReport::landmarks_refused) == sizeof(cairn_closing_report::landmarks_refused));
static_assert(offsetof(ClosingReport, landmarks_ambiguous) == offsetof(cairn_closing_report, landmarks_ambiguous) && sizeof(ClosingReport::landmarks_ambiguous) == sizeof(cairn_closing_report::landmarks_ambiguous));
static_assert(offsetof(ClosingReport, rows) == offsetof(cairn_closing_report, rows) && sizeof(ClosingReport::rows) == sizeof(cairn_closing_report::rows));
static_assert(offsetof(ClosingReport, distance) == offsetof(cairn_closing_report, distance) && sizeof(ClosingReport::distance) == sizeof(cairn_closing_report::distance));
static_assert(offsetof(ClosingReport, threshold) == offsetof(cairn_closing_report, threshold) && sizeof(ClosingReport::threshold) == sizeof(cairn_closing_report::threshold));
static_assert(offsetof(ClosingReport, moved_max) == offsetof(cairn_closing_report, moved_max) && sizeof(ClosingReport::moved_max) == sizeof(cairn_closing_report::moved_max));
static_assert(offsetof(ClosingReport, moved_rms) == offsetof(cairn_closing_report, moved_rms) && sizeof(ClosingReport::moved_rms) == sizeof(cairn_closing_report::moved_rms));
static_assert(offsetof(ClosingReport, widened_position) == offsetof(cairn_closing_report, widened_position) && sizeof(ClosingReport::widened_position) == sizeof(cairn_closing_report::widened_position));
static_assert(offsetof(ClosingReport, widened_attitude) == offsetof(cairn_closing_report, widened_attitude) && sizeof(ClosingReport::widened_attitude) == sizeof(cairn_closing_report::widened_attitude));
static_assert(offsetof(ClosingReport, association_nodes) == offsetof(cairn_closing_report, association_nodes) && sizeof(ClosingReport::association_nodes) == sizeof(cairn_closing_report::association_nodes));
static_assert(offsetof(ClosingReport, association_exhausted) == offsetof(cairn_closing_report, association_exhausted) && sizeof(ClosingReport::association_exhausted) == sizeof(cairn_closing_report::association_exhausted));
static_assert(offsetof(ClosingReport, relinearised) == offsetof(cairn_closing_report, relinearised) && sizeof(ClosingReport::relinearised) == sizeof(cairn_closing_report::relinearised));
static_assert(offsetof(ClosingReport, refactored) == offsetof(cairn_closing_report, refactored) && sizeof(ClosingReport::refactored) == sizeof(cairn_closing_report::refactored));
static_assert(offsetof(ClosingReport, iterations) == offsetof(cairn_closing_report, iterations) && sizeof(ClosingReport::iterations) == sizeof(cairn_closing_report::iterations));
static_assert(offsetof(ClosingReport, reserved) == offsetof(cairn_closing_report, reserved) && sizeof(ClosingReport::reserved) == sizeof(cairn_closing_report::reserved));
static_assert(offsetof(ClosingReport, seconds) == offsetof(cairn_closing_report, seconds) && sizeof(ClosingReport::seconds) == sizeof(cairn_closing_report::seconds));

/// Report of the last update.
struct CAIRN_CPP_SAME_BYTES UpdateReport {
  using C = cairn_update_report;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_update_report);
  /// observations that updated a landmark
  std::uint32_t matched{};
  /// observations that placed a new landmark
  std::uint32_t placed{};
  /// landmarks among `placed` that had been placed wrongly before (docs/update.md, "A landmark that was placed
  /// wrongly")
  std::uint32_t placed_again{};
  /// observations that were refused
  std::uint32_t rejected{};
  /// landmarks that do not count after the update: seen too rarely (`deferred_sightings`, or once while gross errors
  /// are many), or as many observations contradict them as agree
  std::uint32_t deferred{};
  /// landmarks removed after the update: missed too often, not seen again in time, or none of a full submap counted
  std::uint32_t removed{};
  /// rows of the batch after the gates: degrees of freedom of `nis`
  std::uint32_t rows{};
  /// normalised innovation squared of the batch at the prediction
  double nis{};
  /// 95 % band of `nis`: lower bound
  double nis_lower{};
  /// 95 % band of `nis`: upper bound
  double nis_upper{};
  /// most of what was seen contradicted the estimate: standard deviation by which the motion since the last agreement
  /// was widened, m; 0: it was not (docs/update.md, "Finding back")
  double widened_position{};
  /// the same of the attitude, rad
  double widened_attitude{};
  /// number of linearisations
  std::uint32_t iterations{};
  /// joint tests of the association
  std::uint32_t association_nodes{};
  /// 1: it stopped at the bound `association_nodes` of the options; a better set of pairs may exist
  Bool association_exhausted{};
  /// leave it zero
  std::uint32_t reserved{};
  /// duration of the association, s; it differs from run to run
  double association_seconds{};
};
static_assert(detail::same_layout<UpdateReport, cairn_update_report>);
static_assert(offsetof(UpdateReport, struct_size) == offsetof(cairn_update_report, struct_size) && sizeof(UpdateReport::struct_size) == sizeof(cairn_update_report::struct_size));
static_assert(offsetof(UpdateReport, matched) == offsetof(cairn_update_report, matched) && sizeof(UpdateReport::matched) == sizeof(cairn_update_report::matched));
static_assert(offsetof(UpdateReport, placed) == offsetof(cairn_update_report, placed) && sizeof(UpdateReport::placed) == sizeof(cairn_update_report::placed));
static_assert(offsetof(UpdateReport, placed_again) == offsetof(cairn_update_report, placed_again) && sizeof(UpdateReport::placed_again) == sizeof(cairn_update_report::placed_again));
static_assert(offsetof(UpdateReport, rejected) == offsetof(cairn_update_report, rejected) && sizeof(UpdateReport::rejected) == sizeof(cairn_update_report::rejected));
static_assert(offsetof(UpdateReport, deferred) == offsetof(cairn_update_report, deferred) && sizeof(UpdateReport::deferred) == sizeof(cairn_update_report::deferred));
static_assert(offsetof(UpdateReport, removed) == offsetof(cairn_update_report, removed) && sizeof(UpdateReport::removed) == sizeof(cairn_update_report::removed));
static_assert(offsetof(UpdateReport, rows) == offsetof(cairn_update_report, rows) && sizeof(UpdateReport::rows) == sizeof(cairn_update_report::rows));
static_assert(offsetof(UpdateReport, nis) == offsetof(cairn_update_report, nis) && sizeof(UpdateReport::nis) == sizeof(cairn_update_report::nis));
static_assert(offsetof(UpdateReport, nis_lower) == offsetof(cairn_update_report, nis_lower) && sizeof(UpdateReport::nis_lower) == sizeof(cairn_update_report::nis_lower));
static_assert(offsetof(UpdateReport, nis_upper) == offsetof(cairn_update_report, nis_upper) && sizeof(UpdateReport::nis_upper) == sizeof(cairn_update_report::nis_upper));
static_assert(offsetof(UpdateReport, widened_position) == offsetof(cairn_update_report, widened_position) && sizeof(UpdateReport::widened_position) == sizeof(cairn_update_report::widened_position));
static_assert(offsetof(UpdateReport, widened_attitude) == offsetof(cairn_update_report, widened_attitude) && sizeof(UpdateReport::widened_attitude) == sizeof(cairn_update_report::widened_attitude));
static_assert(offsetof(UpdateReport, iterations) == offsetof(cairn_update_report, iterations) && sizeof(UpdateReport::iterations) == sizeof(cairn_update_report::iterations));
static_assert(offsetof(UpdateReport, association_nodes) == offsetof(cairn_update_report, association_nodes) && sizeof(UpdateReport::association_nodes) == sizeof(cairn_update_report::association_nodes));
static_assert(offsetof(UpdateReport, association_exhausted) == offsetof(cairn_update_report, association_exhausted) && sizeof(UpdateReport::association_exhausted) == sizeof(cairn_update_report::association_exhausted));
static_assert(offsetof(UpdateReport, reserved) == offsetof(cairn_update_report, reserved) && sizeof(UpdateReport::reserved) == sizeof(cairn_update_report::reserved));
static_assert(offsetof(UpdateReport, association_seconds) == offsetof(cairn_update_report, association_seconds) && sizeof(UpdateReport::association_seconds) == sizeof(cairn_update_report::association_seconds));

/// The verdict after the last update, and what supports it. A window counts the last 20 updates or so; older updates
/// fade. A factor that is 1 with a standard deviation above 1 is not known.
struct CAIRN_CPP_SAME_BYTES Health {
  using C = cairn_health;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_health);
  /// Verdict::kGood, Verdict::kDoubtful or Verdict::kLost
  Verdict verdict{};
  /// bits CAIRN_DOUBT_...; 0 if the verdict is good
  Doubts reasons{};
  /// directions of the pose about which the window says nothing
  std::uint32_t blind_directions{};
  /// landmarks of the last frame whose observations contradict the rest
  std::uint32_t contradicting{};
  /// leave it zero
  std::uint32_t reserved{};
  /// updates so far
  std::uint64_t updates{};
  /// share of them with this verdict
  double good_share{};
  /// the same
  double doubtful_share{};
  /// the same
  double lost_share{};
  /// normalised innovation squared of the window, for each row; 1 is expected
  double nis_per_row{};
  /// its 95 % band: lower bound; 0 before the first row
  double nis_lower{};
  /// its 95 % band: upper bound; 0 before the first row
  double nis_upper{};
  /// of the window's observations that were compared with known landmarks
  double refused_share{};
  /// how often the motion was widened
  std::uint64_t widenings{};
  /// amount of the last one; 0: none
  double last_widening{};
  /// factor of the motion's stated standard deviations that explains what is seen
  double motion_scale{};
  /// its standard deviation
  double motion_scale_sigma{};
  /// mean of the pose's corrections in the window, worst axis, over its standard deviation
  double bias_sigmas{};
  /// how far the last frame contradicts the motion since the frame before
  double jump_sigmas{};
  /// smallest pivot of the pose's correlation matrix
  double pose_pivot{};
};
static_assert(detail::same_layout<Health, cairn_health>);
static_assert(offsetof(Health, struct_size) == offsetof(cairn_health, struct_size) && sizeof(Health::struct_size) == sizeof(cairn_health::struct_size));
static_assert(offsetof(Health, verdict) == offsetof(cairn_health, verdict) && sizeof(Health::verdict) == sizeof(cairn_health::verdict));
static_assert(offsetof(Health, reasons) == offsetof(cairn_health, reasons) && sizeof(Health::reasons) == sizeof(cairn_health::reasons));
static_assert(offsetof(Health, blind_directions) == offsetof(cairn_health, blind_directions) && sizeof(Health::blind_directions) == sizeof(cairn_health::blind_directions));
static_assert(offsetof(Health, contradicting) == offsetof(cairn_health, contradicting) && sizeof(Health::contradicting) == sizeof(cairn_health::contradicting));
static_assert(offsetof(Health, reserved) == offsetof(cairn_health, reserved) && sizeof(Health::reserved) == sizeof(cairn_health::reserved));
static_assert(offsetof(Health, updates) == offsetof(cairn_health, updates) && sizeof(Health::updates) == sizeof(cairn_health::updates));
static_assert(offsetof(Health, good_share) == offsetof(cairn_health, good_share) && sizeof(Health::good_share) == sizeof(cairn_health::good_share));
static_assert(offsetof(Health, doubtful_share) == offsetof(cairn_health, doubtful_share) && sizeof(Health::doubtful_share) == sizeof(cairn_health::doubtful_share));
static_assert(offsetof(Health, lost_share) == offsetof(cairn_health, lost_share) && sizeof(Health::lost_share) == sizeof(cairn_health::lost_share));
static_assert(offsetof(Health, nis_per_row) == offsetof(cairn_health, nis_per_row) && sizeof(Health::nis_per_row) == sizeof(cairn_health::nis_per_row));
static_assert(offsetof(Health, nis_lower) == offsetof(cairn_health, nis_lower) && sizeof(Health::nis_lower) == sizeof(cairn_health::nis_lower));
static_assert(offsetof(Health, nis_upper) == offsetof(cairn_health, nis_upper) && sizeof(Health::nis_upper) == sizeof(cairn_health::nis_upper));
static_assert(offsetof(Health, refused_share) == offsetof(cairn_health, refused_share) && sizeof(Health::refused_share) == sizeof(cairn_health::refused_share));
static_assert(offsetof(Health, widenings) == offsetof(cairn_health, widenings) && sizeof(Health::widenings) == sizeof(cairn_health::widenings));
static_assert(offsetof(Health, last_widening) == offsetof(cairn_health, last_widening) && sizeof(Health::last_widening) == sizeof(cairn_health::last_widening));
static_assert(offsetof(Health, motion_scale) == offsetof(cairn_health, motion_scale) && sizeof(Health::motion_scale) == sizeof(cairn_health::motion_scale));
static_assert(offsetof(Health, motion_scale_sigma) == offsetof(cairn_health, motion_scale_sigma) && sizeof(Health::motion_scale_sigma) == sizeof(cairn_health::motion_scale_sigma));
static_assert(offsetof(Health, bias_sigmas) == offsetof(cairn_health, bias_sigmas) && sizeof(Health::bias_sigmas) == sizeof(cairn_health::bias_sigmas));
static_assert(offsetof(Health, jump_sigmas) == offsetof(cairn_health, jump_sigmas) && sizeof(Health::jump_sigmas) == sizeof(cairn_health::jump_sigmas));
static_assert(offsetof(Health, pose_pivot) == offsetof(cairn_health, pose_pivot) && sizeof(Health::pose_pivot) == sizeof(cairn_health::pose_pivot));

/// What the observations of one sensor show.
struct CAIRN_CPP_SAME_BYTES SensorHealth {
  using C = cairn_sensor_health;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_sensor_health);
  /// leave it zero
  std::uint32_t reserved{};
  /// observations that were compared with known landmarks, so far
  std::uint64_t compared{};
  /// of these: refused
  std::uint64_t refused{};
  /// normalised innovation squared of the window, for each row; 1 is expected
  double nis_per_row{};
  /// its 95 % band: lower bound; 0 before the first row
  double nis_lower{};
  /// its 95 % band: upper bound; 0 before the first row
  double nis_upper{};
  /// factor of the sensor's stated standard deviations that explains what is seen
  double scale{};
  /// its standard deviation
  double scale_sigma{};
  /// correlation of a landmark's innovations with those of 1, 2, 3 and 4 sightings before
  std::array<double, 4> persistence{};
};
static_assert(detail::same_layout<SensorHealth, cairn_sensor_health>);
static_assert(offsetof(SensorHealth, struct_size) == offsetof(cairn_sensor_health, struct_size) && sizeof(SensorHealth::struct_size) == sizeof(cairn_sensor_health::struct_size));
static_assert(offsetof(SensorHealth, reserved) == offsetof(cairn_sensor_health, reserved) && sizeof(SensorHealth::reserved) == sizeof(cairn_sensor_health::reserved));
static_assert(offsetof(SensorHealth, compared) == offsetof(cairn_sensor_health, compared) && sizeof(SensorHealth::compared) == sizeof(cairn_sensor_health::compared));
static_assert(offsetof(SensorHealth, refused) == offsetof(cairn_sensor_health, refused) && sizeof(SensorHealth::refused) == sizeof(cairn_sensor_health::refused));
static_assert(offsetof(SensorHealth, nis_per_row) == offsetof(cairn_sensor_health, nis_per_row) && sizeof(SensorHealth::nis_per_row) == sizeof(cairn_sensor_health::nis_per_row));
static_assert(offsetof(SensorHealth, nis_lower) == offsetof(cairn_sensor_health, nis_lower) && sizeof(SensorHealth::nis_lower) == sizeof(cairn_sensor_health::nis_lower));
static_assert(offsetof(SensorHealth, nis_upper) == offsetof(cairn_sensor_health, nis_upper) && sizeof(SensorHealth::nis_upper) == sizeof(cairn_sensor_health::nis_upper));
static_assert(offsetof(SensorHealth, scale) == offsetof(cairn_sensor_health, scale) && sizeof(SensorHealth::scale) == sizeof(cairn_sensor_health::scale));
static_assert(offsetof(SensorHealth, scale_sigma) == offsetof(cairn_sensor_health, scale_sigma) && sizeof(SensorHealth::scale_sigma) == sizeof(cairn_sensor_health::scale_sigma));
static_assert(offsetof(SensorHealth, persistence) == offsetof(cairn_sensor_health, persistence) && sizeof(SensorHealth::persistence) == sizeof(cairn_sensor_health::persistence));

/// Systematic errors of one sensor. A standard deviation at the start that is 0 (the default) means: no state. A random
/// walk is that in the square root of a second; it needs its standard deviation. The sensor works as if the body were
/// at T_map_body E, E = (Exp(turn), shift); an observed value is the predicted one plus its offset.
struct CAIRN_CPP_SAME_BYTES Calibration {
  using C = cairn_calibration;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_calibration);
  /// leave it zero
  std::uint32_t reserved{};
  /// x, y, z, m, >= 0; default 0. A planar vehicle has only x and y
  std::array<double, 3> mount_shift_sigma{};
  /// >= 0; default 0
  std::array<double, 3> mount_shift_walk{};
  /// rotation vector, rad, >= 0; default 0. A planar vehicle has only z
  std::array<double, 3> mount_turn_sigma{};
  /// >= 0; default 0
  std::array<double, 3> mount_turn_walk{};
  /// of each value of an observation, in its unit, >= 0; default 0
  std::array<double, 3> offset_sigma{};
  /// >= 0; default 0
  std::array<double, 3> offset_walk{};

  /// The defaults of the library.
  Calibration() { detail::fill_defaults<cairn_calibration>(*this, cairn_calibration_init); }
  /// A copy with another `mount_shift_sigma`.
  Calibration with_mount_shift_sigma(const std::array<double, 3>& value) const {
    Calibration copy = *this;
    copy.mount_shift_sigma = value;
    return copy;
  }
  /// A copy with another `mount_shift_walk`.
  Calibration with_mount_shift_walk(const std::array<double, 3>& value) const {
    Calibration copy = *this;
    copy.mount_shift_walk = value;
    return copy;
  }
  /// A copy with another `mount_turn_sigma`.
  Calibration with_mount_turn_sigma(const std::array<double, 3>& value) const {
    Calibration copy = *this;
    copy.mount_turn_sigma = value;
    return copy;
  }
  /// A copy with another `mount_turn_walk`.
  Calibration with_mount_turn_walk(const std::array<double, 3>& value) const {
    Calibration copy = *this;
    copy.mount_turn_walk = value;
    return copy;
  }
  /// A copy with another `offset_sigma`.
  Calibration with_offset_sigma(const std::array<double, 3>& value) const {
    Calibration copy = *this;
    copy.offset_sigma = value;
    return copy;
  }
  /// A copy with another `offset_walk`.
  Calibration with_offset_walk(const std::array<double, 3>& value) const {
    Calibration copy = *this;
    copy.offset_walk = value;
    return copy;
  }
};
static_assert(detail::same_layout<Calibration, cairn_calibration>);
static_assert(offsetof(Calibration, struct_size) == offsetof(cairn_calibration, struct_size) && sizeof(Calibration::struct_size) == sizeof(cairn_calibration::struct_size));
static_assert(offsetof(Calibration, reserved) == offsetof(cairn_calibration, reserved) && sizeof(Calibration::reserved) == sizeof(cairn_calibration::reserved));
static_assert(offsetof(Calibration, mount_shift_sigma) == offsetof(cairn_calibration, mount_shift_sigma) && sizeof(Calibration::mount_shift_sigma) == sizeof(cairn_calibration::mount_shift_sigma));
static_assert(offsetof(Calibration, mount_shift_walk) == offsetof(cairn_calibration, mount_shift_walk) && sizeof(Calibration::mount_shift_walk) == sizeof(cairn_calibration::mount_shift_walk));
static_assert(offsetof(Calibration, mount_turn_sigma) == offsetof(cairn_calibration, mount_turn_sigma) && sizeof(Calibration::mount_turn_sigma) == sizeof(cairn_calibration::mount_turn_sigma));
static_assert(offsetof(Calibration, mount_turn_walk) == offsetof(cairn_calibration, mount_turn_walk) && sizeof(Calibration::mount_turn_walk) == sizeof(cairn_calibration::mount_turn_walk));
static_assert(offsetof(Calibration, offset_sigma) == offsetof(cairn_calibration, offset_sigma) && sizeof(Calibration::offset_sigma) == sizeof(cairn_calibration::offset_sigma));
static_assert(offsetof(Calibration, offset_walk) == offsetof(cairn_calibration, offset_walk) && sizeof(Calibration::offset_walk) == sizeof(cairn_calibration::offset_walk));

/// The estimate of one component of a systematic error. Layout frozen.
struct CAIRN_CPP_SAME_BYTES SystematicError {
  using C = cairn_systematic_error;
  /// Systematic::kVelocityBias and so on
  Systematic kind{};
  /// the sensor whose error it is; -1: of the motion
  std::int32_t sensor{};
  /// counted from 0
  std::int32_t component{};
  /// leave it zero
  std::int32_t reserved{};
  /// in the units of its kind
  double value{};
  /// its standard deviation now, in the same units
  double sigma{};
};
static_assert(detail::same_layout<SystematicError, cairn_systematic_error>);
static_assert(offsetof(SystematicError, kind) == offsetof(cairn_systematic_error, kind) && sizeof(SystematicError::kind) == sizeof(cairn_systematic_error::kind));
static_assert(offsetof(SystematicError, sensor) == offsetof(cairn_systematic_error, sensor) && sizeof(SystematicError::sensor) == sizeof(cairn_systematic_error::sensor));
static_assert(offsetof(SystematicError, component) == offsetof(cairn_systematic_error, component) && sizeof(SystematicError::component) == sizeof(cairn_systematic_error::component));
static_assert(offsetof(SystematicError, reserved) == offsetof(cairn_systematic_error, reserved) && sizeof(SystematicError::reserved) == sizeof(cairn_systematic_error::reserved));
static_assert(offsetof(SystematicError, value) == offsetof(cairn_systematic_error, value) && sizeof(SystematicError::value) == sizeof(cairn_systematic_error::value));
static_assert(offsetof(SystematicError, sigma) == offsetof(cairn_systematic_error, sigma) && sizeof(SystematicError::sigma) == sizeof(cairn_systematic_error::sigma));

/// Options of Team::eam. Set them by TeamOptions::TeamOptions first.
struct CAIRN_CPP_SAME_BYTES TeamOptions {
  using C = cairn_team_options;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_team_options);
  /// CAIRN_TEAM_...; default TeamMode::kJoint
  TeamMode mode{};
  /// number of this vehicle; unique in the team; not kIdNone; default 0
  std::uint64_t vehicle{};
  /// vehicles of the team, this one included, 1 to 256; default 8
  std::uint32_t max_vehicles{};
  /// 1: a second filter uses only this vehicle's data, for comparison by Team::score; default 0
  Bool baseline{};
  /// how long the team waits for a missing packet of a teammate, by the times of its own packets, s, > 0; default 30
  double max_lag{};
  /// packets whose times differ by at most this belong to the same time, s, >= 0; default 0.01
  double time_tolerance{};
  /// a step that follows the one before it by more than this, s, > 0, is refused until the next one confirms it;
  /// default 60
  double max_jump{};
  /// packets of one teammate that can wait for their turn, 1 to 1000000; default 4096. The one that the others wait for
  /// has room beside them
  std::uint32_t max_waiting{};
  /// own packets that are kept for teammates that miss them, 1 to 1000000; default 1024
  std::uint32_t history{};

  /// The defaults of the library.
  TeamOptions() { detail::fill_defaults<cairn_team_options>(*this, cairn_team_options_init); }
  /// A copy with another `mode`.
  TeamOptions with_mode(const TeamMode& value) const {
    TeamOptions copy = *this;
    copy.mode = value;
    return copy;
  }
  /// A copy with another `vehicle`.
  TeamOptions with_vehicle(const std::uint64_t& value) const {
    TeamOptions copy = *this;
    copy.vehicle = value;
    return copy;
  }
  /// A copy with another `max_vehicles`.
  TeamOptions with_max_vehicles(const std::uint32_t& value) const {
    TeamOptions copy = *this;
    copy.max_vehicles = value;
    return copy;
  }
  /// A copy with another `baseline`.
  TeamOptions with_baseline(const Bool& value) const {
    TeamOptions copy = *this;
    copy.baseline = value;
    return copy;
  }
  /// A copy with another `max_lag`.
  TeamOptions with_max_lag(const double& value) const {
    TeamOptions copy = *this;
    copy.max_lag = value;
    return copy;
  }
  /// A copy with another `time_tolerance`.
  TeamOptions with_time_tolerance(const double& value) const {
    TeamOptions copy = *this;
    copy.time_tolerance = value;
    return copy;
  }
  /// A copy with another `max_jump`.
  TeamOptions with_max_jump(const double& value) const {
    TeamOptions copy = *this;
    copy.max_jump = value;
    return copy;
  }
  /// A copy with another `max_waiting`.
  TeamOptions with_max_waiting(const std::uint32_t& value) const {
    TeamOptions copy = *this;
    copy.max_waiting = value;
    return copy;
  }
  /// A copy with another `history`.
  TeamOptions with_history(const std::uint32_t& value) const {
    TeamOptions copy = *this;
    copy.history = value;
    return copy;
  }
};
static_assert(detail::same_layout<TeamOptions, cairn_team_options>);
static_assert(offsetof(TeamOptions, struct_size) == offsetof(cairn_team_options, struct_size) && sizeof(TeamOptions::struct_size) == sizeof(cairn_team_options::struct_size));
static_assert(offsetof(TeamOptions, mode) == offsetof(cairn_team_options, mode) && sizeof(TeamOptions::mode) == sizeof(cairn_team_options::mode));
static_assert(offsetof(TeamOptions, vehicle) == offsetof(cairn_team_options, vehicle) && sizeof(TeamOptions::vehicle) == sizeof(cairn_team_options::vehicle));
static_assert(offsetof(TeamOptions, max_vehicles) == offsetof(cairn_team_options, max_vehicles) && sizeof(TeamOptions::max_vehicles) == sizeof(cairn_team_options::max_vehicles));
static_assert(offsetof(TeamOptions, baseline) == offsetof(cairn_team_options, baseline) && sizeof(TeamOptions::baseline) == sizeof(cairn_team_options::baseline));
static_assert(offsetof(TeamOptions, max_lag) == offsetof(cairn_team_options, max_lag) && sizeof(TeamOptions::max_lag) == sizeof(cairn_team_options::max_lag));
static_assert(offsetof(TeamOptions, time_tolerance) == offsetof(cairn_team_options, time_tolerance) && sizeof(TeamOptions::time_tolerance) == sizeof(cairn_team_options::time_tolerance));
static_assert(offsetof(TeamOptions, max_jump) == offsetof(cairn_team_options, max_jump) && sizeof(TeamOptions::max_jump) == sizeof(cairn_team_options::max_jump));
static_assert(offsetof(TeamOptions, max_waiting) == offsetof(cairn_team_options, max_waiting) && sizeof(TeamOptions::max_waiting) == sizeof(cairn_team_options::max_waiting));
static_assert(offsetof(TeamOptions, history) == offsetof(cairn_team_options, history) && sizeof(TeamOptions::history) == sizeof(cairn_team_options::history));

/// Report of a team.
struct CAIRN_CPP_SAME_BYTES TeamReport {
  using C = cairn_team_report;
  /// set by the constructor; leave it
  std::uint32_t struct_size = sizeof(cairn_team_report);
  /// own steps that still wait for teammates
  std::uint32_t unsettled{};
  /// 1: memory ran out while a submap was closed. The next call closes it first. Until then no further packet has its
  /// turn. Otherwise 0
  Bool interrupted{};
  /// leave it zero
  std::uint32_t reserved{};
  /// own steps that became packets
  std::uint64_t sent{};
  /// packets sent again because a teammate asked
  std::uint64_t resent{};
  /// requests sent
  std::uint64_t requested{};
  /// packets received
  std::uint64_t received{};
  /// received packets that are part of the estimate
  std::uint64_t taken{};
  /// received packets that arrived after a later packet of the same sender
  std::uint64_t reordered{};
  /// received packets that had been received before
  std::uint64_t repeated{};
  /// received packets that were own packets
  std::uint64_t own{};
  /// received packets that were not for this vehicle or its mode
  std::uint64_t ignored{};
  /// received packets whose sender is not in the team
  std::uint64_t unknown{};
  /// received packets whose time does not agree with their number
  std::uint64_t past{};
  /// received packets that were too far ahead
  std::uint64_t ahead{};
  /// received packets that contradict a packet that was received before
  std::uint64_t conflict{};
  /// received packets that found no room to wait
  std::uint64_t full{};
  /// received packets that were not packets of a team
  std::uint64_t foreign{};
  /// received packets of another version
  std::uint64_t version{};
  /// received packets with bytes missing, or too many
  std::uint64_t cut{};
  /// received packets with a wrong checksum
  std::uint64_t corrupt{};
  /// received packets that were complete, but not a valid step
  std::uint64_t nonsense{};
  /// packets that never arrived and were given up after max_lag
  std::uint64_t lost{};
  /// observations, own and teammates', that updated a landmark
  std::uint64_t matched{};
  /// observations that placed a new landmark
  std::uint64_t placed{};
  /// observations that were refused
  std::uint64_t rejected{};
  /// sightings of vehicles that were used
  std::uint64_t sightings_used{};
  /// sightings of vehicles that were refused: the pose of the seen vehicle is unknown, or it has no step at this time
  std::uint64_t sightings_refused{};
  /// starts solved from mutual sightings
  std::uint64_t vehicles_found{};
  /// motions and scans by which the filter could not be updated
  std::uint64_t failed{};
  /// calls of Team::score
  std::uint64_t scored{};
  /// scored steps with a covariance that is not singular (at a known start it is singular): the steps of
  /// `anees_per_dof`
  std::uint64_t scored_nees{};
  /// root mean square position error of this vehicle, m
  double position_rmse{};
  /// average NEES of its pose over the degrees of freedom: 1 for an honest covariance
  double anees_per_dof{};
  /// (||C_mono|| - ||C||) / ||C_mono||: Frobenius norms of the position's covariance, summed over all scored steps
  /// (cooperative paper, section 3); 0 without `baseline`
  double claimed_improvement{};
  /// 1 - MSE / MSE_mono of the position; 0 without `baseline`
  double true_improvement{};
};
static_assert(detail::same_layout<TeamReport, cairn_team_report>);
static_assert(offsetof(TeamReport, struct_size) == offsetof(cairn_team_report, struct_size) && sizeof(TeamReport::struct_size) == sizeof(cairn_team_report::struct_size));
static_assert(offsetof(TeamReport, unsettled) == offsetof(cairn_team_report, unsettled) && sizeof(TeamReport::unsettled) == sizeof(cairn_team_report::unsettled));
static_assert(offsetof(TeamReport, interrupted) == offsetof(cairn_team_report, interrupted) && sizeof(TeamReport::interrupted) == sizeof(cairn_team_report::interrupted));
static_assert(offsetof(TeamReport, reserved) == offsetof(cairn_team_report, reserved) && sizeof(TeamReport::reserved) == sizeof(cairn_team_report::reserved));
static_assert(offsetof(TeamReport, sent) == offsetof(cairn_team_report, sent) && sizeof(TeamReport::sent) == sizeof(cairn_team_report::sent));
static_assert(offsetof(TeamReport, resent) == offsetof(cairn_team_report, resent) && sizeof(TeamReport::resent) == sizeof(cairn_team_report::resent));
static_assert(offsetof(TeamReport, requested) == offsetof(cairn_team_report, requested) && sizeof(TeamReport::requested) == sizeof(cairn_team_report::requested));
static_assert(offsetof(TeamReport, received) == offsetof(cairn_team_report, received) && sizeof(TeamReport::received) == sizeof(cairn_team_report::received));
static_assert(offsetof(TeamReport, taken) == offsetof(cairn_team_report, taken) && sizeof(TeamReport::taken) == sizeof(cairn_team_report::taken));
static_assert(offsetof(TeamReport, reordered) == offsetof(cairn_team_report, reordered) && sizeof(TeamReport::reordered) == sizeof(cairn_team_report::reordered));
static_assert(offsetof(TeamReport, repeated) == offsetof(cairn_team_report, repeated) && sizeof(TeamReport::repeated) == sizeof(cairn_team_report::repeated));
static_assert(offsetof(TeamReport, own) == offsetof(cairn_team_report, own) && sizeof(TeamReport::own) == sizeof(cairn_team_report::own));
static_assert(offsetof(TeamReport, ignored) == offsetof(cairn_team_report, ignored) && sizeof(TeamReport::ignored) == sizeof(cairn_team_report::ignored));
static_assert(offsetof(TeamReport, unknown) == offsetof(cairn_team_report, unknown) && sizeof(TeamReport::unknown) == sizeof(cairn_team_report::unknown));
static_assert(offsetof(TeamReport, past) == offsetof(cairn_team_report, past) && sizeof(TeamReport::past) == sizeof(cairn_team_report::past));
static_assert(offsetof(TeamReport, ahead) == offsetof(cairn_team_report, ahead) && sizeof(TeamReport::ahead) == sizeof(cairn_team_report::ahead));
static_assert(offsetof(TeamReport, conflict) == offsetof(cairn_team_report, conflict) && sizeof(TeamReport::conflict) == sizeof(cairn_team_report::conflict));
static_assert(offsetof(TeamReport, full) == offsetof(cairn_team_report, full) && sizeof(TeamReport::full) == sizeof(cairn_team_report::full));
static_assert(offsetof(TeamReport, foreign) == offsetof(cairn_team_report, foreign) && sizeof(TeamReport::foreign) == sizeof(cairn_team_report::foreign));
static_assert(offsetof(TeamReport, version) == offsetof(cairn_team_report, version) && sizeof(TeamReport::version) == sizeof(cairn_team_report::version));
static_assert(offsetof(TeamReport, cut) == offsetof(cairn_team_report, cut) && sizeof(TeamReport::cut) == sizeof(cairn_team_report::cut));
static_assert(offsetof(TeamReport, corrupt) == offsetof(cairn_team_report, corrupt) && sizeof(TeamReport::corrupt) == sizeof(cairn_team_report::corrupt));
static_assert(offsetof(TeamReport, nonsense) == offsetof(cairn_team_report, nonsense) && sizeof(TeamReport::nonsense) == sizeof(cairn_team_report::nonsense));
static_assert(offsetof(TeamReport, lost) == offsetof(cairn_team_report, lost) && sizeof(TeamReport::lost) == sizeof(cairn_team_report::lost));
static_assert(offsetof(TeamReport, matched) == offsetof(cairn_team_report, matched) && sizeof(TeamReport::matched) == sizeof(cairn_team_report::matched));
static_assert(offsetof(TeamReport, placed) == offsetof(cairn_team_report, placed) && sizeof(TeamReport::placed) == sizeof(cairn_team_report::placed));
static_assert(offsetof(TeamReport, rejected) == offsetof(cairn_team_report, rejected) && sizeof(TeamReport::rejected) == sizeof(cairn_team_report::rejected));
static_assert(offsetof(TeamReport, sightings_used) == offsetof(cairn_team_report, sightings_used) && sizeof(TeamReport::sightings_used) == sizeof(cairn_team_report::sightings_used));
static_assert(offsetof(TeamReport, sightings_refused) == offsetof(cairn_team_report, sightings_refused) && sizeof(TeamReport::sightings_refused) == sizeof(cairn_team_report::sightings_refused));
static_assert(offsetof(TeamReport, vehicles_found) == offsetof(cairn_team_report, vehicles_found) && sizeof(TeamReport::vehicles_found) == sizeof(cairn_team_report::vehicles_found));
static_assert(offsetof(TeamReport, failed) == offsetof(cairn_team_report, failed) && sizeof(TeamReport::failed) == sizeof(cairn_team_report::failed));
static_assert(offsetof(TeamReport, scored) == offsetof(cairn_team_report, scored) && sizeof(TeamReport::scored) == sizeof(cairn_team_report::scored));
static_assert(offsetof(TeamReport, scored_nees) == offsetof(cairn_team_report, scored_nees) && sizeof(TeamReport::scored_nees) == sizeof(cairn_team_report::scored_nees));
static_assert(offsetof(TeamReport, position_rmse) == offsetof(cairn_team_report, position_rmse) && sizeof(TeamReport::position_rmse) == sizeof(cairn_team_report::position_rmse));
static_assert(offsetof(TeamReport, anees_per_dof) == offsetof(cairn_team_report, anees_per_dof) && sizeof(TeamReport::anees_per_dof) == sizeof(cairn_team_report::anees_per_dof));
static_assert(offsetof(TeamReport, claimed_improvement) == offsetof(cairn_team_report, claimed_improvement) && sizeof(TeamReport::claimed_improvement) == sizeof(cairn_team_report::claimed_improvement));
static_assert(offsetof(TeamReport, true_improvement) == offsetof(cairn_team_report, true_improvement) && sizeof(TeamReport::true_improvement) == sizeof(cairn_team_report::true_improvement));

}  // namespace cairn
// clang-format on

#endif
