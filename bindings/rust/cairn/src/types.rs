// SPDX-License-Identifier: BSD-3-Clause
// Written by generate.py from api.json. Do not edit.
use cairn_sys as sys;
use std::fmt;
use std::mem::{size_of, zeroed};

/// Version of the C interface that this crate was made for: 10000 major + 100 minor + patch.
pub const VERSION: u32 = sys::CAIRN_VERSION as u32;

/// The id that no landmark has.
pub const ID_NONE: u64 = sys::CAIRN_ID_NONE;

/// Status of every fallible call: 0 is success, a negative value an error. A value never changes its meaning. A refused
/// observation is not an error: its [`Match`](crate::Match) reports the refusal.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Status(
    /// The value in C.
    pub i32,
);

impl Status {
    /// success
    pub const OK: Status = Status(0);
    /// an argument is `None`, not finite, out of range or not a covariance
    pub const ERROR_ARGUMENT: Status = Status(-1);
    /// the caller's buffer is too short; `needed` holds the size that is necessary
    pub const ERROR_BUFFER: Status = Status(-2);
    /// a capacity set at creation is exhausted (landmarks, observations, sensors)
    pub const ERROR_CAPACITY: Status = Status(-3);
    /// no landmark, sensor or vehicle has this id
    pub const ERROR_NOT_FOUND: Status = Status(-4);
    /// a covariance would lose positive definiteness, or a result is not finite
    pub const ERROR_NUMERICAL: Status = Status(-5);
    /// there is not enough memory
    pub const ERROR_MEMORY: Status = Status(-6);
    /// the handle is in a state that does not allow this call
    pub const ERROR_STATE: Status = Status(-7);
    /// a defect of the library; please report it
    pub const ERROR_INTERNAL: Status = Status(-8);
    /// a callback of the caller returned a negative value and so aborted the call
    pub const ERROR_CALLBACK: Status = Status(-9);
}

impl fmt::Debug for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Status", self.0, &[(0, "OK"), (-1, "ERROR_ARGUMENT"), (-2, "ERROR_BUFFER"), (-3, "ERROR_CAPACITY"), (-4, "ERROR_NOT_FOUND"), (-5, "ERROR_NUMERICAL"), (-6, "ERROR_MEMORY"), (-7, "ERROR_STATE"), (-8, "ERROR_INTERNAL"), (-9, "ERROR_CALLBACK")])
    }
}

/// How a map holds the joint uncertainty of its landmarks. Only maps of the same kind can be merged.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct MapForm(
    /// The value in C.
    pub i32,
);

impl MapForm {
    /// positions and their joint covariance: a single map, or densely joined submaps
    pub const DENSE: MapForm = MapForm(0);
    /// submaps and the factor of their information: sparsely joined submaps
    pub const SPARSE: MapForm = MapForm(1);
}

impl fmt::Debug for MapForm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "MapForm", self.0, &[(0, "DENSE"), (1, "SPARSE")])
    }
}

/// How [`MapCopy::merge`](crate::MapCopy::merge) finds the landmarks that both maps hold, the common landmarks.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct MergeBy(
    /// The value in C.
    pub i32,
);

impl MergeBy {
    /// landmarks with the same id
    pub const ID: MergeBy = MergeBy(0);
    /// landmarks that lie in the same way relative to each other; ids are ignored
    pub const GEOMETRY: MergeBy = MergeBy(1);
}

impl fmt::Debug for MergeBy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "MergeBy", self.0, &[(0, "ID"), (1, "GEOMETRY")])
    }
}

/// Sign of the yaw rate that follows from two wheel rates.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Yaw(
    /// The value in C.
    pub i32,
);

impl Yaw {
    /// z up: the vehicle turns left (positive yaw rate) when the right wheels turn faster; the default
    pub const RIGHT_MINUS_LEFT: Yaw = Yaw(0);
    /// z down: eq. 1 as printed in the Mars paper
    pub const LEFT_MINUS_RIGHT: Yaw = Yaw(1);
}

impl fmt::Debug for Yaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Yaw", self.0, &[(0, "RIGHT_MINUS_LEFT"), (1, "LEFT_MINUS_RIGHT")])
    }
}

/// How the noise of the two encoders of a head enters ([`StereoHead`](crate::StereoHead)).
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Encoder(
    /// The value in C.
    pub i32,
);

impl Encoder {
    /// the head moves between observations: each has independent noise; the default
    pub const PER_OBSERVATION: Encoder = Encoder(0);
    /// the head stands still: all observations of a frame have the same encoder error
    pub const PER_FRAME: Encoder = Encoder(1);
}

impl fmt::Debug for Encoder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Encoder", self.0, &[(0, "PER_OBSERVATION"), (1, "PER_FRAME")])
    }
}

/// Loss of a residual at the distance d, in standard deviations (docs/update.md, "Robust losses").
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Loss(
    /// The value in C.
    pub i32,
);

impl Loss {
    /// d^2 / 2: least squares; the default
    pub const NONE: Loss = Loss(0);
    /// d^2 / 2 up to the width k, k d - k^2 / 2 beyond: the influence of an observation is bounded
    pub const HUBER: Loss = Loss(1);
    /// c^2 / 2 log(1 + d^2 / c^2): the influence falls with the distance, and gross outliers have nearly none
    pub const CAUCHY: Loss = Loss(2);
}

impl fmt::Debug for Loss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Loss", self.0, &[(0, "NONE"), (1, "HUBER"), (2, "CAUCHY")])
    }
}

/// Result of an observation.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct MatchResult(
    /// The value in C.
    pub i32,
);

impl MatchResult {
    /// it updated the landmark
    pub const MATCHED: MatchResult = MatchResult(1);
    /// it placed a new landmark, or placed a landmark again that had been placed wrongly; then `distance` and
    /// `threshold` are those of its test against the former place
    pub const NEW: MatchResult = MatchResult(2);
    /// it was refused and changed nothing; `reason` says why
    pub const REJECTED: MatchResult = MatchResult(3);
}

impl fmt::Debug for MatchResult {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "MatchResult", self.0, &[(1, "MATCHED"), (2, "NEW"), (3, "REJECTED")])
    }
}

/// Why an observation was refused.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Reason(
    /// The value in C.
    pub i32,
);

impl Reason {
    /// it was not refused
    pub const NONE: Reason = Reason(0);
    /// its distance exceeds the threshold of the gate of one observation (chi-square)
    pub const GATE: Reason = Reason(1);
    /// it passed its own gate, but was removed so that the whole batch passes the batch gate
    pub const BATCH_GATE: Reason = Reason(2);
    /// the estimated landmark cannot give an observation: behind the lens, too near, too steep
    pub const NO_IMAGE: Reason = Reason(3);
    /// the observation cannot place a landmark: disparity or range too small, range too large beside its noise, or the
    /// sensor never places landmarks
    pub const NO_PLACE: Reason = Reason(4);
    /// unknown ids: it passed its own gate, but the best set of pairs does not contain it
    pub const AMBIGUOUS: Reason = Reason(5);
    /// the observation could place a landmark, but the map is full
    pub const NO_ROOM: Reason = Reason(6);
    /// the observation could place a landmark, but most of what is seen contradicts the pose: nothing is placed until
    /// it is decided what is wrong.
    pub const CONTRADICTED: Reason = Reason(7);
}

impl fmt::Debug for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Reason", self.0, &[(0, "NONE"), (1, "GATE"), (2, "BATCH_GATE"), (3, "NO_IMAGE"), (4, "NO_PLACE"), (5, "AMBIGUOUS"), (6, "NO_ROOM"), (7, "CONTRADICTED")])
    }
}

/// Error of the state that the filter's covariance describes (docs/invariant_error.md).
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct StateError(
    /// The value in C.
    pub i32,
);

impl StateError {
    /// right-invariant error on SE_{K+1}(3): consistent; the default
    pub const INVARIANT: StateError = StateError(0);
    /// separate errors of position, attitude and landmarks: standard EKF-SLAM, for comparison
    pub const STANDARD: StateError = StateError(1);
}

impl fmt::Debug for StateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "StateError", self.0, &[(0, "INVARIANT"), (1, "STANDARD")])
    }
}

/// Space in which the vehicle moves (docs/plane.md). The interface of a planar vehicle is the same as that of a spatial
/// one: the vehicle lies in z = 0 and turns about z. The filter reads only the rows and columns of x, y and yaw of
/// covariances and Jacobians that it gets. Covariances that it returns have zeros elsewhere.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Vehicle(
    /// The value in C.
    pub i32,
);

impl Vehicle {
    /// six degrees of freedom; the default
    pub const SPATIAL: Vehicle = Vehicle(0);
    /// x, y and heading; landmarks x and y
    pub const PLANAR: Vehicle = Vehicle(1);
}

impl fmt::Debug for Vehicle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Vehicle", self.0, &[(0, "SPATIAL"), (1, "PLANAR")])
    }
}

/// How a closed submap joins the map (docs/submaps.md).
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Join(
    /// The value in C.
    pub i32,
);

impl Join {
    /// dense if max_landmarks is at most 100, sparse otherwise; the default
    pub const AUTO: Join = Join(0);
    /// a filter with the covariance of the whole map: a closing costs O(n^2) for n states of the map
    pub const DENSE: Join = Join(1);
    /// solves for all submaps together on a sparse factor and relinearises them: the total cost is nearly linear
    pub const SPARSE: Join = Join(2);
}

impl fmt::Debug for Join {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Join", self.0, &[(0, "AUTO"), (1, "DENSE"), (2, "SPARSE")])
    }
}

/// How the filter finds the landmark of an observation (docs/association.md).
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Association(
    /// The value in C.
    pub i32,
);

impl Association {
    /// by the id of the observation; the default
    pub const KNOWN: Association = Association(0);
    /// nearest neighbour by Mahalanobis distance; each landmark is matched at most once in a frame. Ids of observations
    /// are ignored, and landmarks are numbered from 0 in the order in which they are placed
    pub const NEAREST: Association = Association(1);
    /// the largest set of pairs that are jointly compatible (branch and bound); ids as for
    /// [`Association::NEAREST`](crate::Association::NEAREST)
    pub const JOINT: Association = Association(2);
}

impl fmt::Debug for Association {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Association", self.0, &[(0, "KNOWN"), (1, "NEAREST"), (2, "JOINT")])
    }
}

/// Distance by which [`Association::NEAREST`](crate::Association::NEAREST) chooses among landmarks.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Distance(
    /// The value in C.
    pub i32,
);

impl Distance {
    /// the squared Mahalanobis distance d^2; the default
    pub const MAHALANOBIS: Distance = Distance(0);
    /// d^2 + log det S, which is -2 log of the likelihood: if two landmarks have the same d^2, the better known one is
    /// chosen. The gates still use d^2
    pub const LIKELIHOOD: Distance = Distance(1);
}

impl fmt::Debug for Distance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Distance", self.0, &[(0, "MAHALANOBIS"), (1, "LIKELIHOOD")])
    }
}

/// What becomes of the noise that the filter learns from its innovations (docs/trust.md).
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct NoiseLearning(
    /// The value in C.
    pub i32,
);

impl NoiseLearning {
    /// [`Filter::health`](crate::Filter::health) reports it; the default
    pub const REPORTED: NoiseLearning = NoiseLearning(0);
    /// from when it is known, it scales the stated noise of each sensor and of the motion
    pub const APPLIED: NoiseLearning = NoiseLearning(1);
}

impl fmt::Debug for NoiseLearning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "NoiseLearning", self.0, &[(0, "REPORTED"), (1, "APPLIED")])
    }
}

/// Why a submap was closed.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct ClosedBy(
    /// The value in C.
    pub i32,
);

impl ClosedBy {
    /// no submap was closed yet
    pub const NONE: ClosedBy = ClosedBy(0);
    /// [`Filter::close_submap`](crate::Filter::close_submap)
    pub const CALLER: ClosedBy = ClosedBy(1);
    /// submap_landmarks
    pub const LANDMARKS: ClosedBy = ClosedBy(2);
    /// submap_distance
    pub const DISTANCE: ClosedBy = ClosedBy(3);
    /// submap_extent
    pub const EXTENT: ClosedBy = ClosedBy(4);
    /// submap_sigma
    pub const SIGMA: ClosedBy = ClosedBy(5);
    /// an absolute position, attitude or heading could not be taken in otherwise
    pub const FIX: ClosedBy = ClosedBy(6);
}

impl fmt::Debug for ClosedBy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "ClosedBy", self.0, &[(0, "NONE"), (1, "CALLER"), (2, "LANDMARKS"), (3, "DISTANCE"), (4, "EXTENT"), (5, "SIGMA"), (6, "FIX")])
    }
}

/// The verdict on a filter.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Verdict(
    /// The value in C.
    pub i32,
);

impl Verdict {
    /// what is seen agrees with the estimate and with the stated noise
    pub const GOOD: Verdict = Verdict(0);
    /// something does not agree; the reasons say what
    pub const DOUBTFUL: Verdict = Verdict(1);
    /// most of what is seen contradicts the estimate
    pub const LOST: Verdict = Verdict(2);
}

impl fmt::Debug for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Verdict", self.0, &[(0, "GOOD"), (1, "DOUBTFUL"), (2, "LOST")])
    }
}

/// The reasons of a verdict, one bit each.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Doubts(
    /// The value in C.
    pub u32,
);

impl Doubts {
    /// the normalised innovations of the window lie above their band
    pub const NIS: Doubts = Doubts(1);
    /// the gates refuse more than they refuse of honest observations
    pub const REFUSALS: Doubts = Doubts(2);
    /// the motion was widened, because most of what was seen contradicted it
    pub const WIDENED: Doubts = Doubts(4);
    /// a sensor's noise is more than 1.5 times what is stated
    pub const SENSOR_NOISE: Doubts = Doubts(8);
    /// the motion's noise is clearly more than what is stated
    pub const MOTION_NOISE: Doubts = Doubts(16);
    /// the corrections of the pose have a mean: the motion has a constant error
    pub const BIAS: Doubts = Doubts(32);
    /// a frame contradicts the motion since the last frame: a slip, or another place
    pub const JUMP: Doubts = Doubts(64);
    /// single landmarks contradict the rest: moved, or under a wrong id
    pub const LANDMARKS: Doubts = Doubts(128);
    /// a closed submap contradicted the map
    pub const CLOSING: Doubts = Doubts(256);
    /// directions of the pose about which the last frames say nothing
    pub const BLIND: Doubts = Doubts(512);
    /// the covariance of the pose is not positive semidefinite
    pub const DEFINITE: Doubts = Doubts(1024);
}

impl fmt::Debug for Doubts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_bits(f, "Doubts", self.0, &[(1, "NIS"), (2, "REFUSALS"), (4, "WIDENED"), (8, "SENSOR_NOISE"), (16, "MOTION_NOISE"), (32, "BIAS"), (64, "JUMP"), (128, "LANDMARKS"), (256, "CLOSING"), (512, "BLIND"), (1024, "DEFINITE")])
    }
}

impl std::ops::BitOr for Doubts {
    type Output = Doubts;
    fn bitor(self, other: Doubts) -> Doubts {
        Doubts(self.0 | other.0)
    }
}

/// Kinds of systematic errors.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Systematic(
    /// The value in C.
    pub i32,
);

impl Systematic {
    /// of the measured body velocity, m/s; components x, y, z
    pub const VELOCITY_BIAS: Systematic = Systematic(0);
    /// of the measured body rate, rad/s; components x, y, z
    pub const RATE_BIAS: Systematic = Systematic(1);
    /// of a wheel's measured rate; components left and right
    pub const WHEEL_SCALE: Systematic = Systematic(2);
    /// of a sensor against the body, m; components x, y, z
    pub const MOUNT_SHIFT: Systematic = Systematic(3);
    /// of a sensor about the origin of the body: a rotation vector, rad
    pub const MOUNT_TURN: Systematic = Systematic(4);
    /// of the values of a sensor's observations, in their units
    pub const OFFSET: Systematic = Systematic(5);
}

impl fmt::Debug for Systematic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Systematic", self.0, &[(0, "VELOCITY_BIAS"), (1, "RATE_BIAS"), (2, "WHEEL_SCALE"), (3, "MOUNT_SHIFT"), (4, "MOUNT_TURN"), (5, "OFFSET")])
    }
}

/// Mode: how a vehicle uses the packets of its teammates.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct TeamMode(
    /// The value in C.
    pub i32,
);

impl TeamMode {
    /// it ignores them; for comparison
    pub const MONO: TeamMode = TeamMode(0);
    /// extended observations with independent noise, as printed in the cooperative paper: overconfident, and more so
    /// with more landmarks
    pub const EO_DIAGONAL: TeamMode = TeamMode(1);
    /// extended observations with the noise that all observations of a scan share through the sighting
    pub const EO_FULL: TeamMode = TeamMode(2);
    /// every vehicle runs the same filter over all poses and all landmarks; the default
    pub const JOINT: TeamMode = TeamMode(3);
    /// every vehicle works in its own submaps, which are fused by their common landmarks; sightings between vehicles
    /// are not used
    pub const SUBMAPS: TeamMode = TeamMode(4);
}

impl fmt::Debug for TeamMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "TeamMode", self.0, &[(0, "MONO"), (1, "EO_DIAGONAL"), (2, "EO_FULL"), (3, "JOINT"), (4, "SUBMAPS")])
    }
}

/// Result of a received packet.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Packet(
    /// The value in C.
    pub i32,
);

impl Packet {
    /// it had its turn and is part of the estimate
    pub const TAKEN: Packet = Packet(1);
    /// it waits for its turn
    pub const WAITING: Packet = Packet(2);
    /// a teammate misses own packets; they are queued to be sent again
    pub const REQUEST: Packet = Packet(3);
    /// a teammate leaves the team when this packet has its turn
    pub const LEAVE: Packet = Packet(4);
    /// it was received before
    pub const REPEATED: Packet = Packet(5);
    /// it is an own packet that came back
    pub const OWN: Packet = Packet(6);
    /// the mode does not use it, or it is for another vehicle
    pub const IGNORED: Packet = Packet(7);
    /// its sender is not in the team
    pub const UNKNOWN: Packet = Packet(8);
    /// its time does not agree with its number
    pub const PAST: Packet = Packet(9);
    /// a different packet of this sender with this number was received before: two vehicles have the same number
    pub const CONFLICT: Packet = Packet(10);
    /// max_waiting packets of this sender wait already
    pub const FULL: Packet = Packet(11);
    /// it is not a packet of a team
    pub const FOREIGN: Packet = Packet(12);
    /// this library does not read its version
    pub const VERSION: Packet = Packet(13);
    /// bytes are missing, or there are too many
    pub const CUT: Packet = Packet(14);
    /// its checksum is wrong
    pub const CORRUPT: Packet = Packet(15);
    /// it is complete, but not a valid step: values that are not finite, noise that is not a covariance, an id or a
    /// number twice, numbers of absurd size
    pub const NONSENSE: Packet = Packet(16);
    /// its time is more than max_jump after that of the sender's packet before it. The next packet of the sender
    /// decides: if it agrees with this one, both are right, and this one can be received again
    pub const AHEAD: Packet = Packet(17);
}

impl fmt::Debug for Packet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Packet", self.0, &[(1, "TAKEN"), (2, "WAITING"), (3, "REQUEST"), (4, "LEAVE"), (5, "REPEATED"), (6, "OWN"), (7, "IGNORED"), (8, "UNKNOWN"), (9, "PAST"), (10, "CONFLICT"), (11, "FULL"), (12, "FOREIGN"), (13, "VERSION"), (14, "CUT"), (15, "CORRUPT"), (16, "NONSENSE"), (17, "AHEAD")])
    }
}

#[cfg(feature = "sim")]
/// Courses. On each the rover has a constant speed over the xy plane of the map.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
#[cfg(feature = "sim")]
pub struct Course(
    /// The value in C.
    pub i32,
);

#[cfg(feature = "sim")]
impl Course {
    /// the course of the paper: a circle, driven anticlockwise; the default
    pub const CIRCLE: Course = Course(0);
    /// a wandering closed curve, driven several times
    pub const LAPS: Course = Course(1);
    /// a long drive: a chain of circles, alternately left and right. Each circle is driven 1.25 times before the next
    /// one is entered where both touch. So each circle closes a loop, and a quarter of it is seen again
    pub const TRAVERSE: Course = Course(2);
}

#[cfg(feature = "sim")]
impl fmt::Debug for Course {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Course", self.0, &[(0, "CIRCLE"), (1, "LAPS"), (2, "TRAVERSE")])
    }
}

#[cfg(feature = "sim")]
/// Ground.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
#[cfg(feature = "sim")]
pub struct Terrain(
    /// The value in C.
    pub i32,
);

#[cfg(feature = "sim")]
impl Terrain {
    /// seeded smooth hills, shifted to `start_height` at (100, 20); the default
    pub const ROLLING: Terrain = Terrain(0);
    /// z = sin(x / 15) + 0.8 cos(y / 12); the same for every seed; not shifted
    pub const WAVES: Terrain = Terrain(1);
    /// z = 0
    pub const FLAT: Terrain = Terrain(2);
}

#[cfg(feature = "sim")]
impl fmt::Debug for Terrain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Terrain", self.0, &[(0, "ROLLING"), (1, "WAVES"), (2, "FLAT")])
    }
}

#[cfg(feature = "sim")]
/// How the rover stands on the ground. Seen from above, its x axis points along the course.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
#[cfg(feature = "sim")]
pub struct Contact(
    /// The value in C.
    pub i32,
);

#[cfg(feature = "sim")]
impl Contact {
    /// on four wheels; a differential averages the left and the right rocker. All four wheels touch the ground, and
    /// height and attitude are those of the chassis between them; the default
    pub const WHEELS: Contact = Contact(0);
    /// at one point; its z axis is the normal of the ground
    pub const POINT: Contact = Contact(1);
}

#[cfg(feature = "sim")]
impl fmt::Debug for Contact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Contact", self.0, &[(0, "WHEELS"), (1, "POINT")])
    }
}

#[cfg(feature = "sim")]
/// Measurements that the motion samples of a step hold as `velocity` and `rate`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
#[cfg(feature = "sim")]
pub struct Drive(
    /// The value in C.
    pub i32,
);

#[cfg(feature = "sim")]
impl Drive {
    /// body velocity and body rate from the IMU; the default
    pub const TWIST: Drive = Drive(0);
    /// forward velocity from the wheels (Mars paper, eq. 1), zero along y and z; body rate from the gyro
    pub const WHEELS_GYRO: Drive = Drive(1);
}

#[cfg(feature = "sim")]
impl fmt::Debug for Drive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Drive", self.0, &[(0, "TWIST"), (1, "WHEELS_GYRO")])
    }
}

#[cfg(feature = "sim")]
/// Noise of the accelerometer. Table 1 of the paper gives it in m/s.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
#[cfg(feature = "sim")]
pub struct Accelerometer(
    /// The value in C.
    pub i32,
);

#[cfg(feature = "sim")]
impl Accelerometer {
    /// white noise of the body velocity, m/s a sample; the default
    pub const VELOCITY: Accelerometer = Accelerometer(0);
    /// white noise of the acceleration, m/s^2 a sample: the velocity comes from dead reckoning of specific force and
    /// rate from a known start, and drifts
    pub const ACCELERATION: Accelerometer = Accelerometer(1);
}

#[cfg(feature = "sim")]
impl fmt::Debug for Accelerometer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Accelerometer", self.0, &[(0, "VELOCITY"), (1, "ACCELERATION")])
    }
}

#[cfg(feature = "sim")]
/// How the noise of the stick angle enters.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
#[cfg(feature = "sim")]
pub struct Stick(
    /// The value in C.
    pub i32,
);

#[cfg(feature = "sim")]
impl Stick {
    /// independent in each observation's elevation; the default
    pub const PER_OBSERVATION: Stick = Stick(0);
    /// all observations of a frame share one encoder error; the image adds noise of `image_sigma` to each elevation
    pub const PER_FRAME: Stick = Stick(1);
}

#[cfg(feature = "sim")]
impl fmt::Debug for Stick {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Stick", self.0, &[(0, "PER_OBSERVATION"), (1, "PER_FRAME")])
    }
}

#[cfg(feature = "sim")]
/// Worlds for measurements. In the rows, velocity and rate noise are those of a sample of 0.2 s. The rows use
/// [`Terrain::WAVES`](crate::Terrain::WAVES), [`Contact::POINT`](crate::Contact::POINT) and a radius of 101.98 m.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
#[cfg(feature = "sim")]
pub struct Preset(
    /// The value in C.
    pub i32,
);

#[cfg(feature = "sim")]
impl Preset {
    /// the defaults: Table 1 as printed
    pub const PAPER: Preset = Preset(0);
    /// 0.002 m/s, 0.02 degrees/s, 1 lap in 400 s
    pub const ROW1: Preset = Preset(1);
    /// 0.05 m/s, 0.2 degrees/s, 1 lap in 400 s
    pub const ROW2: Preset = Preset(2);
    /// 0.05 m/s, 0.2 degrees/s, 2 laps in 400 s
    pub const ROW3: Preset = Preset(3);
    /// 0.2 m/s, 1 degree/s, 2 laps in 400 s
    pub const ROW4: Preset = Preset(4);
}

#[cfg(feature = "sim")]
impl fmt::Debug for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "Preset", self.0, &[(0, "PAPER"), (1, "ROW1"), (2, "ROW2"), (3, "ROW3"), (4, "ROW4")])
    }
}

#[cfg(feature = "sim")]
/// Where the features are. Both layouts have the coast line, but the radars see only features.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
#[cfg(feature = "sim")]
pub struct FleetLayout(
    /// The value in C.
    pub i32,
);

#[cfg(feature = "sim")]
impl FleetLayout {
    /// uniform in the square, on both sides of the coast line; the default
    pub const UNIFORM: FleetLayout = FleetLayout(0);
    /// along the coast line, in a strip of width `coast_strip` south of it. The coast line runs north of the boats,
    /// from the western side of the square to the eastern side
    pub const COAST: FleetLayout = FleetLayout(1);
}

#[cfg(feature = "sim")]
impl fmt::Debug for FleetLayout {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        debug_value(f, "FleetLayout", self.0, &[(0, "UNIFORM"), (1, "COAST")])
    }
}

/// Pose of a frame b in a frame a: `p_a = R(quaternion) p_b + position`. SI units, Hamilton quaternion, w first.
///
/// The error of a pose is `[dp; dtheta]` (m, rad), both in the axes of the parent frame a: `position_true = position +
/// dp`, `R_true = Exp(dtheta) R`. Every 6x6 covariance of a pose in this interface is the covariance of this error,
/// row-major. Layout frozen.
#[derive(Clone, Debug, PartialEq, Copy)]
#[repr(C)]
pub struct Pose {
    /// origin of b in a, m
    pub position: [f64; 3],
    /// rotation from b to a: w x y z, unit length
    pub quaternion: [f64; 4],
}

impl Pose {
    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_pose) -> Self {
        Pose {
            position: c.position,
            quaternion: c.quaternion,
        }
    }

    pub(crate) fn c_value(&self) -> sys::cairn_pose {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_pose = unsafe { zeroed() };
        c.position = self.position;
        c.quaternion = self.quaternion;
        c
    }
}

/// A landmark. Layout frozen.
#[derive(Clone, Debug, PartialEq, Copy)]
#[repr(C)]
pub struct Landmark {
    /// the caller's id, or the assigned one; it never changes
    pub id: u64,
    /// observations that placed or updated it
    pub observations: u64,
    /// in the map frame, m
    pub position: [f64; 3],
    /// covariance of the position, 3x3 row-major, m^2
    pub covariance: [f64; 9],
}

impl Landmark {
    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_landmark) -> Self {
        Landmark {
            id: c.id,
            observations: c.observations,
            position: c.position,
            covariance: c.covariance,
        }
    }
}

/// Options of [`MapCopy::merge`](crate::MapCopy::merge). Set them by
/// [`MergeOptions::default`](crate::MergeOptions::default) first.
#[derive(Clone, Debug, PartialEq)]
pub struct MergeOptions {
    /// [`MergeBy::ID`](crate::MergeBy::ID) or [`MergeBy::GEOMETRY`](crate::MergeBy::GEOMETRY); default
    /// [`MergeBy::ID`](crate::MergeBy::ID)
    pub association: MergeBy,
    /// probability that all common landmarks of a correct merge pass their own gates, in (0, 1\]; default 0.9999
    pub gate_probability: f64,
    /// probability that they pass the joint gate, in (0, 1\]; default 0.9999
    pub joint_gate_probability: f64,
    /// capacity of the merged map; 0, the default: no limit
    pub max_landmarks: u64,
    /// by geometry, without has_transform: largest angle between the z axes of both frames, rad, 0 to pi; default pi
    pub max_tilt: f64,
    /// 1: T_map_other is known beforehand, independently of both maps; default 0
    pub has_transform: bool,
    /// with has_transform: from the other's frame into the map's frame; default identity
    pub t_map_other: Pose,
    /// covariance of its error \[dp; dtheta\], 6x6 row-major, positive semidefinite; default 0: known exactly
    pub covariance: [f64; 36],
}

impl MergeOptions {
    pub(crate) fn empty_c() -> sys::cairn_merge_options {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_merge_options = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_merge_options>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_merge_options) -> Self {
        MergeOptions {
            association: MergeBy(c.association),
            gate_probability: c.gate_probability,
            joint_gate_probability: c.joint_gate_probability,
            max_landmarks: c.max_landmarks,
            max_tilt: c.max_tilt,
            has_transform: c.has_transform != 0,
            t_map_other: Pose::from_c(&c.T_map_other),
            covariance: c.covariance,
        }
    }

    pub(crate) fn c_value(&self) -> sys::cairn_merge_options {
        let mut c = Self::empty_c();
        c.association = self.association.0;
        c.gate_probability = self.gate_probability;
        c.joint_gate_probability = self.joint_gate_probability;
        c.max_landmarks = self.max_landmarks;
        c.max_tilt = self.max_tilt;
        c.has_transform = i32::from(self.has_transform);
        c.T_map_other = self.t_map_other.c_value();
        c.covariance = self.covariance;
        c
    }
}

impl Default for MergeOptions {
    /// The defaults of the library.
    fn default() -> Self {
        let mut c = Self::empty_c();
        // SAFETY: the library writes at most the size that it gets. It fails only for NULL.
        unsafe {
            sys::cairn_merge_options_init(&mut c, size_of::<sys::cairn_merge_options>(), std::ptr::null_mut());
        }
        Self::from_c(&c)
    }
}

/// Report of [`MapCopy::merge`](crate::MapCopy::merge), also of a refused merge. Fields that the merge did not reach
/// are 0.
#[derive(Clone, Debug, PartialEq)]
pub struct MergeReport {
    /// the one of the options
    pub association: MergeBy,
    /// landmarks that both maps hold
    pub common: u64,
    /// landmarks that only the other holds
    pub added: u64,
    /// degrees of freedom of `distance`: three for each common landmark; without has_transform six less
    pub rows: u64,
    /// joint squared Mahalanobis distance of the common landmarks
    pub distance: f64,
    /// its chi-square bound
    pub threshold: f64,
    /// transforms points from the other's frame into the map's frame
    pub t_map_other: Pose,
    /// covariance of its error \[dp; dtheta\], 6x6 row-major
    pub covariance: [f64; 36],
    /// id in the map of a common landmark that failed a test; [`ID_NONE`](crate::ID_NONE): none
    pub broken_id: u64,
    /// id of the same landmark in the other map; [`ID_NONE`](crate::ID_NONE): none
    pub broken_other_id: u64,
}

impl MergeReport {
    pub(crate) fn empty_c() -> sys::cairn_merge_report {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_merge_report = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_merge_report>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_merge_report) -> Self {
        MergeReport {
            association: MergeBy(c.association),
            common: c.common,
            added: c.added,
            rows: c.rows,
            distance: c.distance,
            threshold: c.threshold,
            t_map_other: Pose::from_c(&c.T_map_other),
            covariance: c.covariance,
            broken_id: c.broken_id,
            broken_other_id: c.broken_other_id,
        }
    }
}

impl Default for MergeReport {
    /// Zeros.
    fn default() -> Self {
        let c = Self::empty_c();
        Self::from_c(&c)
    }
}

/// Where a landmark of the other map is after a merge. Layout frozen.
#[derive(Clone, Debug, PartialEq, Eq, Copy)]
pub struct MergedId {
    /// its id in the other map
    pub other_id: u64,
    /// its id in the merged map
    pub id: u64,
    /// 1: the map held this landmark before; 0: it was added
    pub common: bool,
}

impl MergedId {
    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_merged_id) -> Self {
        MergedId {
            other_id: c.other_id,
            id: c.id,
            common: c.common != 0,
        }
    }
}

/// Four-wheel differential drive; both wheels of a side turn at the same rate (Mars paper, eq. 1): `v_x = r (w_left +
/// w_right) / 2`, `w_z = +-(r / B) (w_right - w_left)`. The model has no motion along y and z and no roll and pitch
/// rate. Noise is white; each call is one sample with the standard deviations below.
#[derive(Clone, Debug, PartialEq)]
pub struct Wheels {
    /// [`Yaw::RIGHT_MINUS_LEFT`](crate::Yaw::RIGHT_MINUS_LEFT) or
    /// [`Yaw::LEFT_MINUS_RIGHT`](crate::Yaw::LEFT_MINUS_RIGHT); default
    /// [`Yaw::RIGHT_MINUS_LEFT`](crate::Yaw::RIGHT_MINUS_LEFT)
    pub yaw_sign: Yaw,
    /// r, m, > 0; default 0.3
    pub radius: f64,
    /// B, distance between left and right wheels, m, > 0; default 1.0
    pub track: f64,
    /// noise of each side's wheel rate, rad/s, >= 0; default 0.01
    pub rate_sigma: f64,
    /// noise of each side's wheel rate in proportion to this rate, >= 0; default 0.02
    pub slip_sigma: f64,
    /// side slip: noise of the velocity along y, m/s, >= 0; default 0.01
    pub lateral_sigma: f64,
    /// noise of the velocity along z, m/s, >= 0; default 0.01
    pub vertical_sigma: f64,
    /// noise of the roll rate, which is not measured, rad/s, >= 0; default 0.05
    pub roll_rate_sigma: f64,
    /// noise of the pitch rate, which is not measured, rad/s, >= 0; default 0.05
    pub pitch_rate_sigma: f64,
}

impl Wheels {
    pub(crate) fn empty_c() -> sys::cairn_wheels {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_wheels = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_wheels>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_wheels) -> Self {
        Wheels {
            yaw_sign: Yaw(c.yaw_sign),
            radius: c.radius,
            track: c.track,
            rate_sigma: c.rate_sigma,
            slip_sigma: c.slip_sigma,
            lateral_sigma: c.lateral_sigma,
            vertical_sigma: c.vertical_sigma,
            roll_rate_sigma: c.roll_rate_sigma,
            pitch_rate_sigma: c.pitch_rate_sigma,
        }
    }

    pub(crate) fn c_value(&self) -> sys::cairn_wheels {
        let mut c = Self::empty_c();
        c.yaw_sign = self.yaw_sign.0;
        c.radius = self.radius;
        c.track = self.track;
        c.rate_sigma = self.rate_sigma;
        c.slip_sigma = self.slip_sigma;
        c.lateral_sigma = self.lateral_sigma;
        c.vertical_sigma = self.vertical_sigma;
        c.roll_rate_sigma = self.roll_rate_sigma;
        c.pitch_rate_sigma = self.pitch_rate_sigma;
        c
    }
}

impl Default for Wheels {
    /// The defaults of the library.
    fn default() -> Self {
        let mut c = Self::empty_c();
        // SAFETY: the library writes at most the size that it gets. It fails only for NULL.
        unsafe {
            sys::cairn_wheels_init(&mut c, size_of::<sys::cairn_wheels>(), std::ptr::null_mut());
        }
        Self::from_c(&c)
    }
}

/// Noise of measured body velocity and body rate (IMU, visual odometry). It is white, with a standard deviation per
/// sample and axis (x, y, z of the body). Mars paper, eq. 2, integrated on the group: `T <- T Exp([v; w] dt)`.
#[derive(Clone, Debug, PartialEq)]
pub struct TwistNoise {
    /// m/s, >= 0; default 0.05 each
    pub velocity_sigma: [f64; 3],
    /// rad/s, >= 0; default 0.005 each
    pub rate_sigma: [f64; 3],
}

impl TwistNoise {
    pub(crate) fn empty_c() -> sys::cairn_twist_noise {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_twist_noise = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_twist_noise>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_twist_noise) -> Self {
        TwistNoise {
            velocity_sigma: c.velocity_sigma,
            rate_sigma: c.rate_sigma,
        }
    }

    pub(crate) fn c_value(&self) -> sys::cairn_twist_noise {
        let mut c = Self::empty_c();
        c.velocity_sigma = self.velocity_sigma;
        c.rate_sigma = self.rate_sigma;
        c
    }
}

impl Default for TwistNoise {
    /// The defaults of the library.
    fn default() -> Self {
        let mut c = Self::empty_c();
        // SAFETY: the library writes at most the size that it gets. It fails only for NULL.
        unsafe {
            sys::cairn_twist_noise_init(&mut c, size_of::<sys::cairn_twist_noise>(), std::ptr::null_mut());
        }
        Self::from_c(&c)
    }
}

/// Stereo head on a pan and tilt mount (Mars paper, Figures 2 and 3, eq. 4). It observes range, azimuth and elevation.
///
/// A point `m_c` of the camera frame (x out of the lens, y left, z up) lies in the body frame at `m_b = d + Rz(pan)
/// Ry(stick) (s + R(q) m_c)`. The platform stands at `d`. It turns by `pan` about its z axis, and by `stick` about the
/// bolt, which is its y axis. The stick carries the camera at `s`, turned by `q`. The observation is `z = (range,
/// azimuth, elevation)` of `m_c`: `range = |m_c|` (m), `azimuth = atan2(y, x)` (rad, left positive), `elevation =
/// atan2(z, sqrt(x^2 + y^2))` (rad, up positive). A positive stick angle lowers the lens, so a stick that turns by
/// -elevation points the lens at the point. With the default mount the camera frame is the body frame.
#[derive(Clone, Debug, PartialEq)]
pub struct StereoHead {
    /// [`Encoder::PER_OBSERVATION`](crate::Encoder::PER_OBSERVATION) or
    /// [`Encoder::PER_FRAME`](crate::Encoder::PER_FRAME); default
    /// [`Encoder::PER_OBSERVATION`](crate::Encoder::PER_OBSERVATION)
    pub encoder_mode: Encoder,
    /// d: pan axis in the body frame, m; default 0
    pub platform: [f64; 3],
    /// s: camera in the stick's frame, which has made both turns, m; default 0
    pub stick: [f64; 3],
    /// q: camera axes in the stick's frame, w x y z; default identity
    pub camera_quaternion: [f64; 4],
    /// m, > 0; default 1.0 (Table 1)
    pub range_sigma: f64,
    /// rad, > 0; default 3 degrees (Table 1)
    pub azimuth_sigma: f64,
    /// rad, > 0; default 3 degrees (Table 1)
    pub elevation_sigma: f64,
    /// encoder noise of pan, rad, >= 0; default 0
    pub pan_sigma: f64,
    /// encoder noise of the stick, rad, >= 0; default 0
    pub stick_sigma: f64,
    /// an observation is refused if the predicted range, or the observed range of a new landmark, is below this, m, >
    /// 0; default 0.1
    pub near_range: f64,
    /// an observation is also refused above this elevation, where the azimuth is nearly undefined, rad, in (0, pi/2);
    /// default 85 degrees
    pub max_elevation: f64,
}

impl StereoHead {
    pub(crate) fn empty_c() -> sys::cairn_stereo_head {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_stereo_head = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_stereo_head>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_stereo_head) -> Self {
        StereoHead {
            encoder_mode: Encoder(c.encoder_mode),
            platform: c.platform,
            stick: c.stick,
            camera_quaternion: c.camera_quaternion,
            range_sigma: c.range_sigma,
            azimuth_sigma: c.azimuth_sigma,
            elevation_sigma: c.elevation_sigma,
            pan_sigma: c.pan_sigma,
            stick_sigma: c.stick_sigma,
            near_range: c.near_range,
            max_elevation: c.max_elevation,
        }
    }

    pub(crate) fn c_value(&self) -> sys::cairn_stereo_head {
        let mut c = Self::empty_c();
        c.encoder_mode = self.encoder_mode.0;
        c.platform = self.platform;
        c.stick = self.stick;
        c.camera_quaternion = self.camera_quaternion;
        c.range_sigma = self.range_sigma;
        c.azimuth_sigma = self.azimuth_sigma;
        c.elevation_sigma = self.elevation_sigma;
        c.pan_sigma = self.pan_sigma;
        c.stick_sigma = self.stick_sigma;
        c.near_range = self.near_range;
        c.max_elevation = self.max_elevation;
        c
    }
}

impl Default for StereoHead {
    /// The defaults of the library.
    fn default() -> Self {
        let mut c = Self::empty_c();
        // SAFETY: the library writes at most the size that it gets. It fails only for NULL.
        unsafe {
            sys::cairn_stereo_head_init(&mut c, size_of::<sys::cairn_stereo_head>(), std::ptr::null_mut());
        }
        Self::from_c(&c)
    }
}

/// Rectified stereo camera: `z = (u_left, u_right, v)` in pixels of a point `(x, y, z)` of the left camera's frame (z
/// out of the lens, x right, y down): `u_left = fu x/z + cu`, `u_right = fu (x - baseline)/z + cu`, `v = fv y/z + cv`.
/// If both images give a row, pass the mean of both rows and half the variance of one.
#[derive(Clone, Debug, PartialEq)]
pub struct StereoCamera {
    /// focal length in u, pixels, > 0; default 500
    pub fu: f64,
    /// focal length in v, pixels, > 0; default 500
    pub fv: f64,
    /// principal point, pixels; default 320
    pub cu: f64,
    /// principal point, pixels; default 240
    pub cv: f64,
    /// m, > 0; default 0.2
    pub baseline: f64,
    /// left camera in the body; default: at the origin, looking along x
    pub t_body_camera: Pose,
    /// noise of u_left, u_right, v, pixels, > 0; default 1 each
    pub sigma: [f64; 3],
    /// a landmark whose predicted depth is below this has no image, m, > 0; default 0.1
    pub near_depth: f64,
    /// an observation places a landmark only if its disparity u_left - u_right is at least this, pixels, > 0; default 1
    pub min_disparity: f64,
    /// and only if its disparity is at least this many of its standard deviations (from `sigma`), >= 0; default 2.5:
    /// the depth is known to 40 %. A landmark that is farther away is placed when it is seen from nearer
    pub min_disparity_sigmas: f64,
}

impl StereoCamera {
    pub(crate) fn empty_c() -> sys::cairn_stereo_camera {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_stereo_camera = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_stereo_camera>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_stereo_camera) -> Self {
        StereoCamera {
            fu: c.fu,
            fv: c.fv,
            cu: c.cu,
            cv: c.cv,
            baseline: c.baseline,
            t_body_camera: Pose::from_c(&c.T_body_camera),
            sigma: c.sigma,
            near_depth: c.near_depth,
            min_disparity: c.min_disparity,
            min_disparity_sigmas: c.min_disparity_sigmas,
        }
    }

    pub(crate) fn c_value(&self) -> sys::cairn_stereo_camera {
        let mut c = Self::empty_c();
        c.fu = self.fu;
        c.fv = self.fv;
        c.cu = self.cu;
        c.cv = self.cv;
        c.baseline = self.baseline;
        c.T_body_camera = self.t_body_camera.c_value();
        c.sigma = self.sigma;
        c.near_depth = self.near_depth;
        c.min_disparity = self.min_disparity;
        c.min_disparity_sigmas = self.min_disparity_sigmas;
        c
    }
}

impl Default for StereoCamera {
    /// The defaults of the library.
    fn default() -> Self {
        let mut c = Self::empty_c();
        // SAFETY: the library writes at most the size that it gets. It fails only for NULL.
        unsafe {
            sys::cairn_stereo_camera_init(&mut c, size_of::<sys::cairn_stereo_camera>(), std::ptr::null_mut());
        }
        Self::from_c(&c)
    }
}

/// Radar, lidar or sonar of a planar vehicle: `z = (range, bearing)` of the landmark in the sensor's frame, m and rad,
/// positive to the left.
#[derive(Clone, Debug, PartialEq)]
pub struct RangeBearing {
    /// sensor in the body, in the plane; default identity
    pub t_body_sensor: Pose,
    /// m, > 0; default 0.1
    pub range_sigma: f64,
    /// rad, > 0; default 0.01
    pub bearing_sigma: f64,
    /// an observation is refused if the predicted range, or the observed range of a new landmark, is below this, m, >
    /// 0; default 0.01
    pub near_range: f64,
}

impl RangeBearing {
    pub(crate) fn empty_c() -> sys::cairn_range_bearing {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_range_bearing = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_range_bearing>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_range_bearing) -> Self {
        RangeBearing {
            t_body_sensor: Pose::from_c(&c.T_body_sensor),
            range_sigma: c.range_sigma,
            bearing_sigma: c.bearing_sigma,
            near_range: c.near_range,
        }
    }

    pub(crate) fn c_value(&self) -> sys::cairn_range_bearing {
        let mut c = Self::empty_c();
        c.T_body_sensor = self.t_body_sensor.c_value();
        c.range_sigma = self.range_sigma;
        c.bearing_sigma = self.bearing_sigma;
        c.near_range = self.near_range;
        c
    }
}

impl Default for RangeBearing {
    /// The defaults of the library.
    fn default() -> Self {
        let mut c = Self::empty_c();
        // SAFETY: the library writes at most the size that it gets. It fails only for NULL.
        unsafe {
            sys::cairn_range_bearing_init(&mut c, size_of::<sys::cairn_range_bearing>(), std::ptr::null_mut());
        }
        Self::from_c(&c)
    }
}

/// Any sensor that gives a point: `z = (x, y, z)` of the landmark in the sensor's frame, m; for a planar vehicle `z =
/// (x, y)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Cartesian {
    /// sensor in the body; default identity
    pub t_body_sensor: Pose,
    /// noise of x, y, z, m, > 0; default 0.1 each
    pub sigma: [f64; 3],
}

impl Cartesian {
    pub(crate) fn empty_c() -> sys::cairn_cartesian {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_cartesian = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_cartesian>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_cartesian) -> Self {
        Cartesian {
            t_body_sensor: Pose::from_c(&c.T_body_sensor),
            sigma: c.sigma,
        }
    }

    pub(crate) fn c_value(&self) -> sys::cairn_cartesian {
        let mut c = Self::empty_c();
        c.T_body_sensor = self.t_body_sensor.c_value();
        c.sigma = self.sigma;
        c
    }
}

impl Default for Cartesian {
    /// The defaults of the library.
    fn default() -> Self {
        let mut c = Self::empty_c();
        // SAFETY: the library writes at most the size that it gets. It fails only for NULL.
        unsafe {
            sys::cairn_cartesian_init(&mut c, size_of::<sys::cairn_cartesian>(), std::ptr::null_mut());
        }
        Self::from_c(&c)
    }
}

/// A sensor of the caller's own, whose model are two functions ([`Filter::add_custom`](crate::Filter::add_custom)).
#[derive(Clone, Debug, PartialEq)]
pub struct Custom {
    /// values of an observation, 1 to 3; for a planar vehicle 1 or 2; default 3
    pub rows: u32,
    /// bit i is set: value i is an angle (rad) and its residual is wrapped to (-pi, pi\]; default 0
    pub angle_mask: u32,
    /// 1: z depends on pose and landmark only through the body point R^T (l - p), and the filter makes use of that;
    /// default 0: any function of both
    pub relative: bool,
    /// noise of each value, > 0; default 1 each
    pub sigma: [f64; 3],
}

impl Custom {
    pub(crate) fn empty_c() -> sys::cairn_custom {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_custom = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_custom>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_custom) -> Self {
        Custom {
            rows: c.rows,
            angle_mask: c.angle_mask,
            relative: c.relative != 0,
            sigma: c.sigma,
        }
    }

    pub(crate) fn c_value(&self) -> sys::cairn_custom {
        let mut c = Self::empty_c();
        c.rows = self.rows;
        c.angle_mask = self.angle_mask;
        c.relative = i32::from(self.relative);
        c.sigma = self.sigma;
        c
    }
}

impl Default for Custom {
    /// The defaults of the library.
    fn default() -> Self {
        let mut c = Self::empty_c();
        // SAFETY: the library writes at most the size that it gets. It fails only for NULL.
        unsafe {
            sys::cairn_custom_init(&mut c, size_of::<sys::cairn_custom>(), std::ptr::null_mut());
        }
        Self::from_c(&c)
    }
}

/// One observation of one landmark by one sensor. Layout frozen.
#[derive(Clone, Debug, PartialEq, Copy)]
#[repr(C)]
pub struct Observation {
    /// the caller's id of the landmark; not [`ID_NONE`](crate::ID_NONE); once in a frame. Any value if the filter's
    /// `association` is not [`Association::KNOWN`](crate::Association::KNOWN)
    pub id: u64,
    /// values in the sensor's units; a custom sensor of fewer rows uses the first
    pub z: [f64; 3],
    /// noise of this observation, 3x3 row-major (custom: rows x rows, packed); all zero: the sensor's noise
    pub covariance: [f64; 9],
}

impl Observation {
    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_observation) -> Self {
        Observation {
            id: c.id,
            z: c.z,
            covariance: c.covariance,
        }
    }
}

/// Match of one observation: what it was paired with, and whether it was used. Layout frozen.
#[derive(Clone, Debug, PartialEq, Copy)]
#[repr(C)]
pub struct Match {
    /// landmark that the observation was compared with or that it placed; [`ID_NONE`](crate::ID_NONE) if there is none
    pub landmark: u64,
    /// [`MatchResult::MATCHED`](crate::MatchResult::MATCHED), [`MatchResult::NEW`](crate::MatchResult::NEW) or
    /// [`MatchResult::REJECTED`](crate::MatchResult::REJECTED)
    pub result: MatchResult,
    /// one of the `CAIRN_REASON_` constants
    pub reason: Reason,
    /// squared Mahalanobis distance of the innovation ([`Reason::BATCH_GATE`](crate::Reason::BATCH_GATE): that of the
    /// whole batch when this observation was removed); 0 if there is none
    pub distance: f64,
    /// chi-square bound that `distance` was compared with (infinity at a gate probability of 1); 0 if there is none
    pub threshold: f64,
}

impl Match {
    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_match) -> Self {
        Match {
            landmark: c.landmark,
            result: MatchResult(c.result),
            reason: Reason(c.reason),
            distance: c.distance,
            threshold: c.threshold,
        }
    }
}

/// Options of [`Filter::new`](crate::Filter::new). Set them by
/// [`FilterOptions::default`](crate::FilterOptions::default) first.
#[derive(Clone, Debug, PartialEq)]
pub struct FilterOptions {
    /// [`Vehicle::SPATIAL`](crate::Vehicle::SPATIAL) or [`Vehicle::PLANAR`](crate::Vehicle::PLANAR); default
    /// [`Vehicle::SPATIAL`](crate::Vehicle::SPATIAL)
    pub vehicle: Vehicle,
    /// [`StateError::INVARIANT`](crate::StateError::INVARIANT) or
    /// [`StateError::STANDARD`](crate::StateError::STANDARD); default
    /// [`StateError::INVARIANT`](crate::StateError::INVARIANT)
    pub state_error: StateError,
    /// capacity; default 1000. Single map or dense joining: 1 to 30000, the memory grows with the square of this number
    /// and is taken at creation. Sparse joining: 1 to 10000000, only a bound, memory is taken as the map grows
    pub max_landmarks: u32,
    /// observations of one frame, 1 to 4096; default 64
    pub max_observations: u32,
    /// sensors that can be added, 1 to 256; default 8
    pub max_sensors: u32,
    /// body in the map frame at the start; default identity
    pub initial_pose: Pose,
    /// covariance of its error \[dp; dtheta\], symmetric, positive semidefinite; default 0: known exactly
    pub initial_covariance: [f64; 36],
    /// linearisations of an update at most, 1 (plain EKF) to 50; default 3
    pub iterations: u32,
    /// [`NoiseLearning::REPORTED`](crate::NoiseLearning::REPORTED) or
    /// [`NoiseLearning::APPLIED`](crate::NoiseLearning::APPLIED); default
    /// [`NoiseLearning::REPORTED`](crate::NoiseLearning::REPORTED)
    pub noise_learning: NoiseLearning,
    /// the iteration ends when the linearisation error of the batch is smaller than this, > 0; it is measured in
    /// standard deviations of the observations, root of the sum of squares; default 0.1
    pub iteration_tolerance: f64,
    /// chi-square gate of one observation, in (0, 1\]; 1: no gate; default 0.999
    pub gate_probability: f64,
    /// chi-square gate of a whole batch, in (0, 1\]; 1: no gate; default 0.9999
    pub batch_gate_probability: f64,
    /// number of consecutive observations of a landmark whose errors are fully correlated, 1 to 1000000: an update
    /// multiplies the covariance of an observation's noise by this; association, placing and the weights of a robust
    /// loss use the noise unchanged; default 1
    pub error_persistence: f64,
    /// [`Association::KNOWN`](crate::Association::KNOWN), [`Association::NEAREST`](crate::Association::NEAREST) or
    /// [`Association::JOINT`](crate::Association::JOINT); default [`Association::KNOWN`](crate::Association::KNOWN)
    pub association: Association,
    /// [`Distance::MAHALANOBIS`](crate::Distance::MAHALANOBIS) or
    /// [`Distance::LIKELIHOOD`](crate::Distance::LIKELIHOOD); default
    /// [`Distance::MAHALANOBIS`](crate::Distance::MAHALANOBIS)
    pub association_distance: Distance,
    /// joint tests of one frame at most, 1 to 1000000; after this number the best set found so far is used; default
    /// 2000
    pub association_nodes: u32,
    /// a new landmark is deferred until it was observed this often, 1 to 1000: until then it is part of the estimate,
    /// but no map shows it; default 1
    pub deferred_sightings: u32,
    /// a deferred landmark is removed if it is not observed often enough within this many frames, 1 to 1000000; default
    /// 20
    pub deferred_frames: u32,
    /// a landmark is removed if it lay in a sensor's view ([`Filter::set_view`](crate::Filter::set_view)), but was not
    /// seen, in this many consecutive frames of this sensor; 0, the default: never
    pub missed_frames: u32,
    /// unknown ids: an observation places a new landmark only if its distance from each landmark exceeds the chi-square
    /// bound of this probability, in (0, 1). Landmarks that another observation of the frame is paired with do not
    /// count. A pair beyond this bound is never made. Default 0.9999
    pub new_probability: f64,
    /// a submap is closed when it holds this many landmarks, up to 4096; 0, the default: no submaps, one single map
    pub submap_landmarks: u32,
    /// [`Join::AUTO`](crate::Join::AUTO), [`Join::DENSE`](crate::Join::DENSE) or [`Join::SPARSE`](crate::Join::SPARSE);
    /// default [`Join::AUTO`](crate::Join::AUTO)
    pub join: Join,
    /// loss of the landmarks that a closed submap shares with the map: [`Loss::NONE`](crate::Loss::NONE),
    /// [`Loss::HUBER`](crate::Loss::HUBER) or [`Loss::CAUCHY`](crate::Loss::CAUCHY); default
    /// [`Loss::NONE`](crate::Loss::NONE)
    pub join_loss: Loss,
    /// newest poses that are kept for [`Filter::trajectory`](crate::Filter::trajectory), 0 to 10000000; 0, the default:
    /// none. The memory is taken at creation, at most 600 bytes a pose
    pub trajectory_poses: u32,
    /// where `join_loss` leaves the parabola, standard deviations, > 0; default 1.5
    pub join_loss_width: f64,
    /// a submap is also closed when the vehicle has driven this far in it, m; 0, the default: no limit
    pub submap_distance: f64,
    /// a submap is also closed when a landmark lies this far from its origin, m; 0, the default: no limit
    pub submap_extent: f64,
    /// a submap is also closed when the largest standard deviation of the vehicle's position in it exceeds this, m; 0,
    /// the default: no limit
    pub submap_sigma: f64,
    /// a constant error of the measured body velocity (x, y, z) is a state, with this standard deviation at the start,
    /// m/s, >= 0; 0, the default: no state. The velocity is the measured one minus the bias
    /// (docs/systematic_errors.md). A planar vehicle has only x and y
    pub velocity_bias_sigma: [f64; 3],
    /// random walk of that error, m/s in the square root of a second, >= 0; it needs its velocity_bias_sigma; default
    /// 0: constant
    pub velocity_bias_walk: [f64; 3],
    /// the same for the measured body rate, rad/s, >= 0; default 0. A planar vehicle has only z
    pub rate_bias_sigma: [f64; 3],
    /// rad/s in the square root of a second, >= 0; default 0
    pub rate_bias_walk: [f64; 3],
    /// the same for the scales of the left and the right wheels: a wheel turns at the measured rate times 1 + its
    /// scale, >= 0; default 0
    pub wheel_scale_sigma: [f64; 2],
    /// in the square root of a second, >= 0; default 0
    pub wheel_scale_walk: [f64; 2],
    /// numbers that [`Filter::calibrate_sensor`](crate::Filter::calibrate_sensor) makes states, over all sensors, 0 to
    /// 64; default 0
    pub max_sensor_errors: u32,
}

impl FilterOptions {
    pub(crate) fn empty_c() -> sys::cairn_filter_options {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_filter_options = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_filter_options>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_filter_options) -> Self {
        FilterOptions {
            vehicle: Vehicle(c.vehicle),
            state_error: StateError(c.state_error),
            max_landmarks: c.max_landmarks,
            max_observations: c.max_observations,
            max_sensors: c.max_sensors,
            initial_pose: Pose::from_c(&c.initial_pose),
            initial_covariance: c.initial_covariance,
            iterations: c.iterations,
            noise_learning: NoiseLearning(c.noise_learning),
            iteration_tolerance: c.iteration_tolerance,
            gate_probability: c.gate_probability,
            batch_gate_probability: c.batch_gate_probability,
            error_persistence: c.error_persistence,
            association: Association(c.association),
            association_distance: Distance(c.association_distance),
            association_nodes: c.association_nodes,
            deferred_sightings: c.deferred_sightings,
            deferred_frames: c.deferred_frames,
            missed_frames: c.missed_frames,
            new_probability: c.new_probability,
            submap_landmarks: c.submap_landmarks,
            join: Join(c.join),
            join_loss: Loss(c.join_loss),
            trajectory_poses: c.trajectory_poses,
            join_loss_width: c.join_loss_width,
            submap_distance: c.submap_distance,
            submap_extent: c.submap_extent,
            submap_sigma: c.submap_sigma,
            velocity_bias_sigma: c.velocity_bias_sigma,
            velocity_bias_walk: c.velocity_bias_walk,
            rate_bias_sigma: c.rate_bias_sigma,
            rate_bias_walk: c.rate_bias_walk,
            wheel_scale_sigma: c.wheel_scale_sigma,
            wheel_scale_walk: c.wheel_scale_walk,
            max_sensor_errors: c.max_sensor_errors,
        }
    }

    pub(crate) fn c_value(&self) -> sys::cairn_filter_options {
        let mut c = Self::empty_c();
        c.vehicle = self.vehicle.0;
        c.state_error = self.state_error.0;
        c.max_landmarks = self.max_landmarks;
        c.max_observations = self.max_observations;
        c.max_sensors = self.max_sensors;
        c.initial_pose = self.initial_pose.c_value();
        c.initial_covariance = self.initial_covariance;
        c.iterations = self.iterations;
        c.noise_learning = self.noise_learning.0;
        c.iteration_tolerance = self.iteration_tolerance;
        c.gate_probability = self.gate_probability;
        c.batch_gate_probability = self.batch_gate_probability;
        c.error_persistence = self.error_persistence;
        c.association = self.association.0;
        c.association_distance = self.association_distance.0;
        c.association_nodes = self.association_nodes;
        c.deferred_sightings = self.deferred_sightings;
        c.deferred_frames = self.deferred_frames;
        c.missed_frames = self.missed_frames;
        c.new_probability = self.new_probability;
        c.submap_landmarks = self.submap_landmarks;
        c.join = self.join.0;
        c.join_loss = self.join_loss.0;
        c.trajectory_poses = self.trajectory_poses;
        c.join_loss_width = self.join_loss_width;
        c.submap_distance = self.submap_distance;
        c.submap_extent = self.submap_extent;
        c.submap_sigma = self.submap_sigma;
        c.velocity_bias_sigma = self.velocity_bias_sigma;
        c.velocity_bias_walk = self.velocity_bias_walk;
        c.rate_bias_sigma = self.rate_bias_sigma;
        c.rate_bias_walk = self.rate_bias_walk;
        c.wheel_scale_sigma = self.wheel_scale_sigma;
        c.wheel_scale_walk = self.wheel_scale_walk;
        c.max_sensor_errors = self.max_sensor_errors;
        c
    }
}

impl Default for FilterOptions {
    /// The defaults of the library.
    fn default() -> Self {
        let mut c = Self::empty_c();
        // SAFETY: the library writes at most the size that it gets. It fails only for NULL.
        unsafe {
            sys::cairn_filter_options_init(&mut c, size_of::<sys::cairn_filter_options>(), std::ptr::null_mut());
        }
        Self::from_c(&c)
    }
}

/// Report of the last attempt to close a submap.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosingReport {
    /// [`Status::OK`](crate::Status::OK), or the error because of which the submap stayed open
    pub status: Status,
    /// `CAIRN_CLOSED_BY_`...
    pub reason: ClosedBy,
    /// submaps closed so far
    pub submaps: u32,
    /// landmarks of the submap
    pub landmarks: u32,
    /// landmarks of the submap that are new to the map
    pub landmarks_new: u32,
    /// landmarks of the submap that the map knows, and that were fused with it
    pub landmarks_fused: u32,
    /// landmarks of the submap that contradict the map's estimates, and that were left out
    pub landmarks_refused: u32,
    /// unknown ids: landmarks of the submap that may be landmarks of the map, but no pair is certain: left out
    pub landmarks_ambiguous: u32,
    /// degrees of freedom of `distance`
    pub rows: u32,
    /// joint squared Mahalanobis distance between both estimates of the fused landmarks
    pub distance: f64,
    /// its chi-square bound at batch_gate_probability
    pub threshold: f64,
    /// largest movement of an older landmark of the map, m
    pub moved_max: f64,
    /// root mean square of these movements, m
    pub moved_rms: f64,
    /// most known landmarks of the submap contradicted the map and agreed on another pose of its origin: how far from
    /// the estimate, m; 0: they did not (docs/update.md, "Finding back")
    pub widened_position: f64,
    /// the same of the attitude, rad
    pub widened_attitude: f64,
    /// joint tests of the association with the map
    pub association_nodes: u32,
    /// 1: it stopped at the bound `association_nodes` of the options
    pub association_exhausted: bool,
    /// submaps linearised again (sparse)
    pub relinearised: u32,
    /// blocks of the factor computed again (sparse)
    pub refactored: u32,
    /// linear solutions
    pub iterations: u32,
    /// duration of the closing, s; it differs from run to run
    pub seconds: f64,
}

impl ClosingReport {
    pub(crate) fn empty_c() -> sys::cairn_closing_report {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_closing_report = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_closing_report>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_closing_report) -> Self {
        ClosingReport {
            status: Status(c.status),
            reason: ClosedBy(c.reason),
            submaps: c.submaps,
            landmarks: c.landmarks,
            landmarks_new: c.landmarks_new,
            landmarks_fused: c.landmarks_fused,
            landmarks_refused: c.landmarks_refused,
            landmarks_ambiguous: c.landmarks_ambiguous,
            rows: c.rows,
            distance: c.distance,
            threshold: c.threshold,
            moved_max: c.moved_max,
            moved_rms: c.moved_rms,
            widened_position: c.widened_position,
            widened_attitude: c.widened_attitude,
            association_nodes: c.association_nodes,
            association_exhausted: c.association_exhausted != 0,
            relinearised: c.relinearised,
            refactored: c.refactored,
            iterations: c.iterations,
            seconds: c.seconds,
        }
    }
}

impl Default for ClosingReport {
    /// Zeros.
    fn default() -> Self {
        let c = Self::empty_c();
        Self::from_c(&c)
    }
}

/// Report of the last update.
#[derive(Clone, Debug, PartialEq)]
pub struct UpdateReport {
    /// observations that updated a landmark
    pub matched: u32,
    /// observations that placed a new landmark
    pub placed: u32,
    /// landmarks among `placed` that had been placed wrongly before (docs/update.md, "A landmark that was placed
    /// wrongly")
    pub placed_again: u32,
    /// observations that were refused
    pub rejected: u32,
    /// landmarks that do not count after the update: seen too rarely (`deferred_sightings`, or once while gross errors
    /// are many), or as many observations contradict them as agree
    pub deferred: u32,
    /// landmarks removed after the update: missed too often, not seen again in time, or none of a full submap counted
    pub removed: u32,
    /// rows of the batch after the gates: degrees of freedom of `nis`
    pub rows: u32,
    /// normalised innovation squared of the batch at the prediction
    pub nis: f64,
    /// 95 % band of `nis`: lower bound
    pub nis_lower: f64,
    /// 95 % band of `nis`: upper bound
    pub nis_upper: f64,
    /// most of what was seen contradicted the estimate: standard deviation by which the motion since the last agreement
    /// was widened, m; 0: it was not (docs/update.md, "Finding back")
    pub widened_position: f64,
    /// the same of the attitude, rad
    pub widened_attitude: f64,
    /// number of linearisations
    pub iterations: u32,
    /// joint tests of the association
    pub association_nodes: u32,
    /// 1: it stopped at the bound `association_nodes` of the options; a better set of pairs may exist
    pub association_exhausted: bool,
    /// duration of the association, s; it differs from run to run
    pub association_seconds: f64,
}

impl UpdateReport {
    pub(crate) fn empty_c() -> sys::cairn_update_report {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_update_report = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_update_report>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_update_report) -> Self {
        UpdateReport {
            matched: c.matched,
            placed: c.placed,
            placed_again: c.placed_again,
            rejected: c.rejected,
            deferred: c.deferred,
            removed: c.removed,
            rows: c.rows,
            nis: c.nis,
            nis_lower: c.nis_lower,
            nis_upper: c.nis_upper,
            widened_position: c.widened_position,
            widened_attitude: c.widened_attitude,
            iterations: c.iterations,
            association_nodes: c.association_nodes,
            association_exhausted: c.association_exhausted != 0,
            association_seconds: c.association_seconds,
        }
    }
}

impl Default for UpdateReport {
    /// Zeros.
    fn default() -> Self {
        let c = Self::empty_c();
        Self::from_c(&c)
    }
}

/// The verdict after the last update, and what supports it. A window counts the last 20 updates or so; older updates
/// fade. A factor that is 1 with a standard deviation above 1 is not known.
#[derive(Clone, Debug, PartialEq)]
pub struct Health {
    /// [`Verdict::GOOD`](crate::Verdict::GOOD), [`Verdict::DOUBTFUL`](crate::Verdict::DOUBTFUL) or
    /// [`Verdict::LOST`](crate::Verdict::LOST)
    pub verdict: Verdict,
    /// bits `CAIRN_DOUBT_`...; 0 if the verdict is good
    pub reasons: Doubts,
    /// directions of the pose about which the window says nothing
    pub blind_directions: u32,
    /// landmarks of the last frame whose observations contradict the rest
    pub contradicting: u32,
    /// updates so far
    pub updates: u64,
    /// share of them with this verdict
    pub good_share: f64,
    /// the same
    pub doubtful_share: f64,
    /// the same
    pub lost_share: f64,
    /// normalised innovation squared of the window, for each row; 1 is expected
    pub nis_per_row: f64,
    /// its 95 % band: lower bound; 0 before the first row
    pub nis_lower: f64,
    /// its 95 % band: upper bound; 0 before the first row
    pub nis_upper: f64,
    /// of the window's observations that were compared with known landmarks
    pub refused_share: f64,
    /// how often the motion was widened
    pub widenings: u64,
    /// amount of the last one; 0: none
    pub last_widening: f64,
    /// factor of the motion's stated standard deviations that explains what is seen
    pub motion_scale: f64,
    /// its standard deviation
    pub motion_scale_sigma: f64,
    /// mean of the pose's corrections in the window, worst axis, over its standard deviation
    pub bias_sigmas: f64,
    /// how far the last frame contradicts the motion since the frame before
    pub jump_sigmas: f64,
    /// smallest pivot of the pose's correlation matrix
    pub pose_pivot: f64,
}

impl Health {
    pub(crate) fn empty_c() -> sys::cairn_health {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_health = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_health>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_health) -> Self {
        Health {
            verdict: Verdict(c.verdict),
            reasons: Doubts(c.reasons),
            blind_directions: c.blind_directions,
            contradicting: c.contradicting,
            updates: c.updates,
            good_share: c.good_share,
            doubtful_share: c.doubtful_share,
            lost_share: c.lost_share,
            nis_per_row: c.nis_per_row,
            nis_lower: c.nis_lower,
            nis_upper: c.nis_upper,
            refused_share: c.refused_share,
            widenings: c.widenings,
            last_widening: c.last_widening,
            motion_scale: c.motion_scale,
            motion_scale_sigma: c.motion_scale_sigma,
            bias_sigmas: c.bias_sigmas,
            jump_sigmas: c.jump_sigmas,
            pose_pivot: c.pose_pivot,
        }
    }
}

impl Default for Health {
    /// Zeros.
    fn default() -> Self {
        let c = Self::empty_c();
        Self::from_c(&c)
    }
}

/// What the observations of one sensor show.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorHealth {
    /// observations that were compared with known landmarks, so far
    pub compared: u64,
    /// of these: refused
    pub refused: u64,
    /// normalised innovation squared of the window, for each row; 1 is expected
    pub nis_per_row: f64,
    /// its 95 % band: lower bound; 0 before the first row
    pub nis_lower: f64,
    /// its 95 % band: upper bound; 0 before the first row
    pub nis_upper: f64,
    /// factor of the sensor's stated standard deviations that explains what is seen
    pub scale: f64,
    /// its standard deviation
    pub scale_sigma: f64,
    /// correlation of a landmark's innovations with those of 1, 2, 3 and 4 sightings before
    pub persistence: [f64; 4],
}

impl SensorHealth {
    pub(crate) fn empty_c() -> sys::cairn_sensor_health {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_sensor_health = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_sensor_health>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_sensor_health) -> Self {
        SensorHealth {
            compared: c.compared,
            refused: c.refused,
            nis_per_row: c.nis_per_row,
            nis_lower: c.nis_lower,
            nis_upper: c.nis_upper,
            scale: c.scale,
            scale_sigma: c.scale_sigma,
            persistence: c.persistence,
        }
    }
}

impl Default for SensorHealth {
    /// Zeros.
    fn default() -> Self {
        let c = Self::empty_c();
        Self::from_c(&c)
    }
}

/// Systematic errors of one sensor. A standard deviation at the start that is 0 (the default) means: no state. A random
/// walk is that in the square root of a second; it needs its standard deviation. The sensor works as if the body were
/// at T_map_body E, E = (Exp(turn), shift); an observed value is the predicted one plus its offset.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// x, y, z, m, >= 0; default 0. A planar vehicle has only x and y
    pub mount_shift_sigma: [f64; 3],
    /// >= 0; default 0
    pub mount_shift_walk: [f64; 3],
    /// rotation vector, rad, >= 0; default 0. A planar vehicle has only z
    pub mount_turn_sigma: [f64; 3],
    /// >= 0; default 0
    pub mount_turn_walk: [f64; 3],
    /// of each value of an observation, in its unit, >= 0; default 0
    pub offset_sigma: [f64; 3],
    /// >= 0; default 0
    pub offset_walk: [f64; 3],
}

impl Calibration {
    pub(crate) fn empty_c() -> sys::cairn_calibration {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_calibration = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_calibration>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_calibration) -> Self {
        Calibration {
            mount_shift_sigma: c.mount_shift_sigma,
            mount_shift_walk: c.mount_shift_walk,
            mount_turn_sigma: c.mount_turn_sigma,
            mount_turn_walk: c.mount_turn_walk,
            offset_sigma: c.offset_sigma,
            offset_walk: c.offset_walk,
        }
    }

    pub(crate) fn c_value(&self) -> sys::cairn_calibration {
        let mut c = Self::empty_c();
        c.mount_shift_sigma = self.mount_shift_sigma;
        c.mount_shift_walk = self.mount_shift_walk;
        c.mount_turn_sigma = self.mount_turn_sigma;
        c.mount_turn_walk = self.mount_turn_walk;
        c.offset_sigma = self.offset_sigma;
        c.offset_walk = self.offset_walk;
        c
    }
}

impl Default for Calibration {
    /// The defaults of the library.
    fn default() -> Self {
        let mut c = Self::empty_c();
        // SAFETY: the library writes at most the size that it gets. It fails only for NULL.
        unsafe {
            sys::cairn_calibration_init(&mut c, size_of::<sys::cairn_calibration>(), std::ptr::null_mut());
        }
        Self::from_c(&c)
    }
}

/// The estimate of one component of a systematic error. Layout frozen.
#[derive(Clone, Debug, PartialEq, Copy)]
pub struct SystematicError {
    /// [`Systematic::VELOCITY_BIAS`](crate::Systematic::VELOCITY_BIAS) and so on
    pub kind: Systematic,
    /// the sensor whose error it is; -1: of the motion
    pub sensor: i32,
    /// counted from 0
    pub component: i32,
    /// in the units of its kind
    pub value: f64,
    /// its standard deviation now, in the same units
    pub sigma: f64,
}

impl SystematicError {
    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_systematic_error) -> Self {
        SystematicError {
            kind: Systematic(c.kind),
            sensor: c.sensor,
            component: c.component,
            value: c.value,
            sigma: c.sigma,
        }
    }
}

/// Options of [`Team::new`](crate::Team::new). Set them by [`TeamOptions::default`](crate::TeamOptions::default) first.
#[derive(Clone, Debug, PartialEq)]
pub struct TeamOptions {
    /// `CAIRN_TEAM_`...; default [`TeamMode::JOINT`](crate::TeamMode::JOINT)
    pub mode: TeamMode,
    /// number of this vehicle; unique in the team; not [`ID_NONE`](crate::ID_NONE); default 0
    pub vehicle: u64,
    /// vehicles of the team, this one included, 1 to 256; default 8
    pub max_vehicles: u32,
    /// 1: a second filter uses only this vehicle's data, for comparison by [`Team::score`](crate::Team::score); default
    /// 0
    pub baseline: bool,
    /// how long the team waits for a missing packet of a teammate, by the times of its own packets, s, > 0; default 30
    pub max_lag: f64,
    /// packets whose times differ by at most this belong to the same time, s, >= 0; default 0.01
    pub time_tolerance: f64,
    /// a step that follows the one before it by more than this, s, > 0, is refused until the next one confirms it;
    /// default 60
    pub max_jump: f64,
    /// packets of one teammate that can wait for their turn, 1 to 1000000; default 4096. The one that the others wait
    /// for has room beside them
    pub max_waiting: u32,
    /// own packets that are kept for teammates that miss them, 1 to 1000000; default 1024
    pub history: u32,
}

impl TeamOptions {
    pub(crate) fn empty_c() -> sys::cairn_team_options {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_team_options = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_team_options>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_team_options) -> Self {
        TeamOptions {
            mode: TeamMode(c.mode),
            vehicle: c.vehicle,
            max_vehicles: c.max_vehicles,
            baseline: c.baseline != 0,
            max_lag: c.max_lag,
            time_tolerance: c.time_tolerance,
            max_jump: c.max_jump,
            max_waiting: c.max_waiting,
            history: c.history,
        }
    }

    pub(crate) fn c_value(&self) -> sys::cairn_team_options {
        let mut c = Self::empty_c();
        c.mode = self.mode.0;
        c.vehicle = self.vehicle;
        c.max_vehicles = self.max_vehicles;
        c.baseline = i32::from(self.baseline);
        c.max_lag = self.max_lag;
        c.time_tolerance = self.time_tolerance;
        c.max_jump = self.max_jump;
        c.max_waiting = self.max_waiting;
        c.history = self.history;
        c
    }
}

impl Default for TeamOptions {
    /// The defaults of the library.
    fn default() -> Self {
        let mut c = Self::empty_c();
        // SAFETY: the library writes at most the size that it gets. It fails only for NULL.
        unsafe {
            sys::cairn_team_options_init(&mut c, size_of::<sys::cairn_team_options>(), std::ptr::null_mut());
        }
        Self::from_c(&c)
    }
}

/// Report of a team.
#[derive(Clone, Debug, PartialEq)]
pub struct TeamReport {
    /// own steps that still wait for teammates
    pub unsettled: u32,
    /// 1: memory ran out while a submap was closed. The next call closes it first. Until then no further packet has its
    /// turn. Otherwise 0
    pub interrupted: bool,
    /// own steps that became packets
    pub sent: u64,
    /// packets sent again because a teammate asked
    pub resent: u64,
    /// requests sent
    pub requested: u64,
    /// packets received
    pub received: u64,
    /// received packets that are part of the estimate
    pub taken: u64,
    /// received packets that arrived after a later packet of the same sender
    pub reordered: u64,
    /// received packets that had been received before
    pub repeated: u64,
    /// received packets that were own packets
    pub own: u64,
    /// received packets that were not for this vehicle or its mode
    pub ignored: u64,
    /// received packets whose sender is not in the team
    pub unknown: u64,
    /// received packets whose time does not agree with their number
    pub past: u64,
    /// received packets that were too far ahead
    pub ahead: u64,
    /// received packets that contradict a packet that was received before
    pub conflict: u64,
    /// received packets that found no room to wait
    pub full: u64,
    /// received packets that were not packets of a team
    pub foreign: u64,
    /// received packets of another version
    pub version: u64,
    /// received packets with bytes missing, or too many
    pub cut: u64,
    /// received packets with a wrong checksum
    pub corrupt: u64,
    /// received packets that were complete, but not a valid step
    pub nonsense: u64,
    /// packets that never arrived and were given up after max_lag
    pub lost: u64,
    /// observations, own and teammates', that updated a landmark
    pub matched: u64,
    /// observations that placed a new landmark
    pub placed: u64,
    /// observations that were refused
    pub rejected: u64,
    /// sightings of vehicles that were used
    pub sightings_used: u64,
    /// sightings of vehicles that were refused: the pose of the seen vehicle is unknown, or it has no step at this time
    pub sightings_refused: u64,
    /// starts solved from mutual sightings
    pub vehicles_found: u64,
    /// motions and scans by which the filter could not be updated
    pub failed: u64,
    /// calls of [`Team::score`](crate::Team::score)
    pub scored: u64,
    /// scored steps with a covariance that is not singular (at a known start it is singular): the steps of
    /// `anees_per_dof`
    pub scored_nees: u64,
    /// root mean square position error of this vehicle, m
    pub position_rmse: f64,
    /// average NEES of its pose over the degrees of freedom: 1 for an honest covariance
    pub anees_per_dof: f64,
    /// (||C_mono|| - ||C||) / ||C_mono||: Frobenius norms of the position's covariance, summed over all scored steps
    /// (cooperative paper, section 3); 0 without `baseline`
    pub claimed_improvement: f64,
    /// 1 - MSE / MSE_mono of the position; 0 without `baseline`
    pub true_improvement: f64,
}

impl TeamReport {
    pub(crate) fn empty_c() -> sys::cairn_team_report {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_team_report = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_team_report>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_team_report) -> Self {
        TeamReport {
            unsettled: c.unsettled,
            interrupted: c.interrupted != 0,
            sent: c.sent,
            resent: c.resent,
            requested: c.requested,
            received: c.received,
            taken: c.taken,
            reordered: c.reordered,
            repeated: c.repeated,
            own: c.own,
            ignored: c.ignored,
            unknown: c.unknown,
            past: c.past,
            ahead: c.ahead,
            conflict: c.conflict,
            full: c.full,
            foreign: c.foreign,
            version: c.version,
            cut: c.cut,
            corrupt: c.corrupt,
            nonsense: c.nonsense,
            lost: c.lost,
            matched: c.matched,
            placed: c.placed,
            rejected: c.rejected,
            sightings_used: c.sightings_used,
            sightings_refused: c.sightings_refused,
            vehicles_found: c.vehicles_found,
            failed: c.failed,
            scored: c.scored,
            scored_nees: c.scored_nees,
            position_rmse: c.position_rmse,
            anees_per_dof: c.anees_per_dof,
            claimed_improvement: c.claimed_improvement,
            true_improvement: c.true_improvement,
        }
    }
}

impl Default for TeamReport {
    /// Zeros.
    fn default() -> Self {
        let c = Self::empty_c();
        Self::from_c(&c)
    }
}

#[cfg(feature = "sim")]
/// Options of [`World::new`](crate::World::new). Set them by [`WorldOptions::default`](crate::WorldOptions::default)
/// first; the defaults are Table 1 of the paper, with the open choices filled in.
#[derive(Clone, Debug, PartialEq)]
#[cfg(feature = "sim")]
pub struct WorldOptions {
    /// `CAIRN_COURSE_`...; default [`Course::CIRCLE`](crate::Course::CIRCLE)
    pub course: Course,
    /// seed of all random draws; default 1
    pub seed: u64,
    /// number of landmarks, 1 to 10000000; default 200 (Table 1). The length of laps and traverse follows from it
    pub landmarks: u32,
    /// `CAIRN_TERRAIN_`...; default [`Terrain::ROLLING`](crate::Terrain::ROLLING)
    pub terrain: Terrain,
    /// `CAIRN_CONTACT_`...; default [`Contact::WHEELS`](crate::Contact::WHEELS)
    pub contact: Contact,
    /// `CAIRN_DRIVE_`...; default [`Drive::TWIST`](crate::Drive::TWIST)
    pub drive: Drive,
    /// `CAIRN_ACCELEROMETER_`...; default [`Accelerometer::VELOCITY`](crate::Accelerometer::VELOCITY)
    pub accelerometer: Accelerometer,
    /// `CAIRN_STICK_`...; default [`Stick::PER_OBSERVATION`](crate::Stick::PER_OBSERVATION)
    pub stick_noise: Stick,
    /// 1: step 0, the known start, has a frame, too; default 0: the first frame comes one frame period later
    pub observe_at_start: bool,
    /// 1: the circles of the traverse lie on one big ring, and the drive ends with a round of the first circle; this
    /// needs at least 1600 landmarks at the default strip and area; default 0
    pub traverse_closed: bool,
    /// speed over the xy plane, m/s, > 0; default 2 pi hypot(100, 20) / 400: the default circle in 400 s (Table 1)
    pub speed: f64,
    /// rounds of circle and laps, > 0; 0, the default: 1 round of a circle, 2 rounds of laps. Not used by a traverse
    pub laps: f64,
    /// centre of the circle, x and y, m; default the origin (not in the paper)
    pub centre: [f64; 2],
    /// radius of the circle, m, > strip; 0, the default: hypot(100, 20) landmarks / 200. With it the default start is
    /// (100, 20) as in Table 1, and the density of landmarks does not depend on their number
    pub radius: f64,
    /// azimuth of the start as seen from the centre of the circle, rad; default atan2(20, 100)
    pub start_azimuth: f64,
    /// circumference of the circles of the traverse, m, > 0; default 1500. They are scaled so that all landmarks are
    /// used
    pub round_length: f64,
    /// share by which the seed varies this length, \[0, 0.3\]; default 0.1
    pub round_variation: f64,
    /// landmarks lie within this distance of the course, m, > 0; default 25
    pub strip: f64,
    /// area of ground for each landmark of laps and traverse, m^2, > 0; default 160
    pub landmark_area: f64,
    /// landmarks are between 0 and this height above the ground, m, >= 0; default 1.5
    pub landmark_height: f64,
    /// largest slope of the rolling ground, rad, \[0, 45 degrees\]; default 15 degrees
    pub max_slope: f64,
    /// shortest and longest wave of the rolling ground, m, > 0; default 25 and 150
    pub wavelength: [f64; 2],
    /// height of the rolling ground at (100, 20), m; default -0.3174 (Table 1)
    pub start_height: f64,
    /// m, > 0; default 0.3 (Table 1)
    pub wheel_radius: f64,
    /// distance between left and right wheels, m, > 0; default 1.0 (not in the paper)
    pub track: f64,
    /// distance between front and rear wheels, m, > 0; default 1.2 (not in the paper)
    pub wheelbase: f64,
    /// white noise per sample and axis, m/s or m/s^2 (`accelerometer`), >= 0; default 2e-3 (Table 1)
    pub velocity_sigma: f64,
    /// white noise of the gyro per sample and axis, rad/s, >= 0; default 0.02 degrees/s (Table 1)
    pub rate_sigma: f64,
    /// m/s^2, >= 0; default 3.71. Only [`Accelerometer::ACCELERATION`](crate::Accelerometer::ACCELERATION) uses it
    pub gravity: f64,
    /// white noise of each side's wheel rate per sample, rad/s, >= 0; default 0.01
    pub wheel_rate_sigma: f64,
    /// white noise of each side's wheel rate in proportion to this rate, >= 0; default 0.02
    pub wheel_slip_sigma: f64,
    /// noise that a step states for the velocity along y, which wheels do not measure, m/s, >= 0; default 0.01
    pub lateral_sigma: f64,
    /// the same along z, m/s, >= 0; default 0.01
    pub vertical_sigma: f64,
    /// period of IMU and wheel samples, s, > 0; default 0.05: 20 Hz (Table 1)
    pub imu_period: f64,
    /// period of the motion samples in a step, s: a multiple of imu_period. IMU samples are composed into one motion
    /// sample. Default 0.2, the sampling period of Table 1
    pub motion_period: f64,
    /// period of the camera, s: a multiple of motion_period; default 2: 0.5 Hz (Table 1)
    pub frame_period: f64,
    /// noise of a range, m, > 0; default 1 (Table 1)
    pub range_sigma: f64,
    /// noise of an azimuth, rad, > 0; default 3 degrees (Table 1)
    pub azimuth_sigma: f64,
    /// noise of the stick angle, rad, > 0; default 3 degrees (Table 1)
    pub stick_sigma: f64,
    /// noise of each elevation with [`Stick::PER_FRAME`](crate::Stick::PER_FRAME), rad, > 0; default 0.5 degrees
    pub image_sigma: f64,
    /// shortest distance at which the camera sees a landmark, m, > 0; default 2 (not in the paper)
    pub near_range: f64,
    /// longest such distance, m, > near_range; default 40 (not in the paper)
    pub far_range: f64,
    /// largest azimuth from the axis of the camera, rad, (0, pi\]; default 60 degrees (not in the paper)
    pub half_azimuth: f64,
    /// the head scans: pan = amplitude sin(2 pi t / period), rad, \[0, pi\]; default 0: fixed forward
    pub pan_amplitude: f64,
    /// s, > 0; default 20
    pub pan_period: f64,
    /// the same for the stick, rad, \[0, 60 degrees\]; default 0
    pub stick_amplitude: f64,
    /// s, > 0; default 26
    pub stick_period: f64,
    /// d of [`StereoHead`](crate::StereoHead), m; default 0 (not in the paper)
    pub platform: [f64; 3],
    /// s of [`StereoHead`](crate::StereoHead), m; default 0 (not in the paper)
    pub stick: [f64; 3],
    /// systematic errors of the rover, which [`World::head`](crate::World::head) and
    /// [`World::wheels`](crate::World::wheels) do not tell (docs/systematic_errors.md). Added to the measured body
    /// velocity, m/s; default 0; the wheels turn faster by the first component
    pub velocity_bias: [f64; 3],
    /// added to the rate of the gyro, rad/s; default 0
    pub rate_bias: [f64; 3],
    /// left and right: a wheel turns at its measured rate times 1 + this, > -1; default 0
    pub wheel_scale: [f64; 2],
    /// rotation vector by which the head is turned about the origin of the body, rad; default 0
    pub mount_turn: [f64; 3],
    /// by which the head is shifted after that, m; default 0
    pub mount_shift: [f64; 3],
    /// added to the observed range (m), azimuth and elevation (rad); default 0
    pub value_offset: [f64; 3],
}

#[cfg(feature = "sim")]
impl WorldOptions {
    pub(crate) fn empty_c() -> sys::cairn_world_options {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_world_options = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_world_options>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_world_options) -> Self {
        WorldOptions {
            course: Course(c.course),
            seed: c.seed,
            landmarks: c.landmarks,
            terrain: Terrain(c.terrain),
            contact: Contact(c.contact),
            drive: Drive(c.drive),
            accelerometer: Accelerometer(c.accelerometer),
            stick_noise: Stick(c.stick_noise),
            observe_at_start: c.observe_at_start != 0,
            traverse_closed: c.traverse_closed != 0,
            speed: c.speed,
            laps: c.laps,
            centre: c.centre,
            radius: c.radius,
            start_azimuth: c.start_azimuth,
            round_length: c.round_length,
            round_variation: c.round_variation,
            strip: c.strip,
            landmark_area: c.landmark_area,
            landmark_height: c.landmark_height,
            max_slope: c.max_slope,
            wavelength: c.wavelength,
            start_height: c.start_height,
            wheel_radius: c.wheel_radius,
            track: c.track,
            wheelbase: c.wheelbase,
            velocity_sigma: c.velocity_sigma,
            rate_sigma: c.rate_sigma,
            gravity: c.gravity,
            wheel_rate_sigma: c.wheel_rate_sigma,
            wheel_slip_sigma: c.wheel_slip_sigma,
            lateral_sigma: c.lateral_sigma,
            vertical_sigma: c.vertical_sigma,
            imu_period: c.imu_period,
            motion_period: c.motion_period,
            frame_period: c.frame_period,
            range_sigma: c.range_sigma,
            azimuth_sigma: c.azimuth_sigma,
            stick_sigma: c.stick_sigma,
            image_sigma: c.image_sigma,
            near_range: c.near_range,
            far_range: c.far_range,
            half_azimuth: c.half_azimuth,
            pan_amplitude: c.pan_amplitude,
            pan_period: c.pan_period,
            stick_amplitude: c.stick_amplitude,
            stick_period: c.stick_period,
            platform: c.platform,
            stick: c.stick,
            velocity_bias: c.velocity_bias,
            rate_bias: c.rate_bias,
            wheel_scale: c.wheel_scale,
            mount_turn: c.mount_turn,
            mount_shift: c.mount_shift,
            value_offset: c.value_offset,
        }
    }

    pub(crate) fn c_value(&self) -> sys::cairn_world_options {
        let mut c = Self::empty_c();
        c.course = self.course.0;
        c.seed = self.seed;
        c.landmarks = self.landmarks;
        c.terrain = self.terrain.0;
        c.contact = self.contact.0;
        c.drive = self.drive.0;
        c.accelerometer = self.accelerometer.0;
        c.stick_noise = self.stick_noise.0;
        c.observe_at_start = i32::from(self.observe_at_start);
        c.traverse_closed = i32::from(self.traverse_closed);
        c.speed = self.speed;
        c.laps = self.laps;
        c.centre = self.centre;
        c.radius = self.radius;
        c.start_azimuth = self.start_azimuth;
        c.round_length = self.round_length;
        c.round_variation = self.round_variation;
        c.strip = self.strip;
        c.landmark_area = self.landmark_area;
        c.landmark_height = self.landmark_height;
        c.max_slope = self.max_slope;
        c.wavelength = self.wavelength;
        c.start_height = self.start_height;
        c.wheel_radius = self.wheel_radius;
        c.track = self.track;
        c.wheelbase = self.wheelbase;
        c.velocity_sigma = self.velocity_sigma;
        c.rate_sigma = self.rate_sigma;
        c.gravity = self.gravity;
        c.wheel_rate_sigma = self.wheel_rate_sigma;
        c.wheel_slip_sigma = self.wheel_slip_sigma;
        c.lateral_sigma = self.lateral_sigma;
        c.vertical_sigma = self.vertical_sigma;
        c.imu_period = self.imu_period;
        c.motion_period = self.motion_period;
        c.frame_period = self.frame_period;
        c.range_sigma = self.range_sigma;
        c.azimuth_sigma = self.azimuth_sigma;
        c.stick_sigma = self.stick_sigma;
        c.image_sigma = self.image_sigma;
        c.near_range = self.near_range;
        c.far_range = self.far_range;
        c.half_azimuth = self.half_azimuth;
        c.pan_amplitude = self.pan_amplitude;
        c.pan_period = self.pan_period;
        c.stick_amplitude = self.stick_amplitude;
        c.stick_period = self.stick_period;
        c.platform = self.platform;
        c.stick = self.stick;
        c.velocity_bias = self.velocity_bias;
        c.rate_bias = self.rate_bias;
        c.wheel_scale = self.wheel_scale;
        c.mount_turn = self.mount_turn;
        c.mount_shift = self.mount_shift;
        c.value_offset = self.value_offset;
        c
    }
}

#[cfg(feature = "sim")]
impl Default for WorldOptions {
    /// The defaults of the library.
    fn default() -> Self {
        let mut c = Self::empty_c();
        // SAFETY: the library writes at most the size that it gets. It fails only for NULL.
        unsafe {
            sys::cairn_world_options_init(&mut c, size_of::<sys::cairn_world_options>(), std::ptr::null_mut());
        }
        Self::from_c(&c)
    }
}

#[cfg(feature = "sim")]
/// A motion sample: measured and true motion of the rover during `dt` seconds. Layout frozen.
#[derive(Clone, Debug, PartialEq, Copy)]
#[repr(C)]
#[cfg(feature = "sim")]
pub struct WorldMotion {
    /// s
    pub dt: f64,
    /// measured velocity, body axes, m/s (`drive`)
    pub velocity: [f64; 3],
    /// measured rate, body axes, rad/s
    pub rate: [f64; 3],
    /// measured turning rates of the left and the right wheels, rad/s: means over dt
    pub wheels: [f64; 2],
    /// true velocity, m/s. With true_rate it leads from the true pose before to the true pose after: T \<- T Exp(\[v;
    /// w\] dt)
    pub true_velocity: [f64; 3],
    /// true rate, rad/s
    pub true_rate: [f64; 3],
    /// true turning rates, rad/s: those that follow from eq. 1 of the paper
    pub true_wheels: [f64; 2],
}

#[cfg(feature = "sim")]
impl WorldMotion {
    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_world_motion) -> Self {
        WorldMotion {
            dt: c.dt,
            velocity: c.velocity,
            rate: c.rate,
            wheels: c.wheels,
            true_velocity: c.true_velocity,
            true_rate: c.true_rate,
            true_wheels: c.true_wheels,
        }
    }
}

#[cfg(feature = "sim")]
/// A step: the motion samples since the previous step ([`World::motions`](crate::World::motions)), then one frame
/// ([`World::observations`](crate::World::observations)).
#[derive(Clone, Debug, PartialEq)]
#[cfg(feature = "sim")]
pub struct WorldStep {
    /// counted from 0; step 0 is the start
    pub number: u64,
    /// s, from 0
    pub time: f64,
    /// true pose of the body in the map at the end of the step
    pub truth: Pose,
    /// noise of the `velocity` of each motion sample, for [`TwistNoise`](crate::TwistNoise). The drift of an
    /// accelerometer is stated by its size at this time, as if it were white noise
    pub velocity_sigma: [f64; 3],
    /// noise of the `rate` of each motion sample
    pub rate_sigma: [f64; 3],
    /// pan angle of the head, from its encoder, rad
    pub pan: f64,
    /// stick angle of the head, from its encoder, rad
    pub stick: f64,
    /// motion samples of the step, for [`World::motions`](crate::World::motions); 0 at step 0
    pub motion_count: u64,
    /// observations of the frame, for [`World::observations`](crate::World::observations)
    pub observation_count: u64,
}

#[cfg(feature = "sim")]
impl WorldStep {
    pub(crate) fn empty_c() -> sys::cairn_world_step {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_world_step = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_world_step>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_world_step) -> Self {
        WorldStep {
            number: c.number,
            time: c.time,
            truth: Pose::from_c(&c.truth),
            velocity_sigma: c.velocity_sigma,
            rate_sigma: c.rate_sigma,
            pan: c.pan,
            stick: c.stick,
            motion_count: c.motion_count,
            observation_count: c.observation_count,
        }
    }
}

#[cfg(feature = "sim")]
impl Default for WorldStep {
    /// Zeros.
    fn default() -> Self {
        let c = Self::empty_c();
        Self::from_c(&c)
    }
}

#[cfg(feature = "sim")]
/// Options of [`Fleet::new`](crate::Fleet::new). Set them by [`FleetOptions::default`](crate::FleetOptions::default)
/// first; the defaults are the figures of the paper, with the open choices filled in.
#[derive(Clone, Debug, PartialEq)]
#[cfg(feature = "sim")]
pub struct FleetOptions {
    /// `CAIRN_FLEET_`...; default [`FleetLayout::UNIFORM`](crate::FleetLayout::UNIFORM)
    pub layout: FleetLayout,
    /// seed of all random draws; default 1
    pub seed: u64,
    /// number of boats, 1 to 64; default 2 (paper)
    pub vehicles: u32,
    /// number of features, 1 to 100000; default 10 (paper: 6, 10, 40)
    pub features: u32,
    /// side of the square, m, > 0; default 10000 (paper)
    pub area: f64,
    /// distance between neighbours at the start, m, > 0, at most half of `area`; default 1500 (not in the paper). Three
    /// or more boats may be closer: see [`Fleet::new`](crate::Fleet::new)
    pub separation: f64,
    /// circumference of each boat's circle, m, > 0, at most `area`; default 1700 (paper)
    pub course_length: f64,
    /// duration of one round, which is the whole drive, s, > 0; default 1500 (paper)
    pub duration: f64,
    /// period of the radars, s, > 0, at most `duration`; default 5 (not in the paper)
    pub period: f64,
    /// range of the radars, m, > 0; default 5000 (paper)
    pub radar_range: f64,
    /// noise of a range, m, >= 0; default 30 (not in the paper)
    pub range_sigma: f64,
    /// noise of a bearing, rad, >= 0; default 0.3 degrees (not in the paper)
    pub bearing_sigma: f64,
    /// difference between executed and commanded speed: white noise, one draw a period, m/s, >= 0; default 0.2 (not in
    /// the paper)
    pub speed_sigma: f64,
    /// the same for the rate of turn, rad/s, >= 0; default 0.1 degrees/s (not in the paper)
    pub rate_sigma: f64,
    /// distance of the mean coast line north of the origin, as a share of `area`, (0, 0.5\]; default 0.35 (not in the
    /// paper)
    pub coast_distance: f64,
    /// largest deviation of the coast line from its mean, as a share of `area`, \[0, 0.5 - coast_distance\]; default
    /// 0.05 (not in the paper)
    pub coast_relief: f64,
    /// width of the strip of water that holds the features, as a share of `area`, \[0, 0.5\]; default 0.03 (not in the
    /// paper). Only [`FleetLayout::COAST`](crate::FleetLayout::COAST) uses it
    pub coast_strip: f64,
}

#[cfg(feature = "sim")]
impl FleetOptions {
    pub(crate) fn empty_c() -> sys::cairn_fleet_options {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_fleet_options = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_fleet_options>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_fleet_options) -> Self {
        FleetOptions {
            layout: FleetLayout(c.layout),
            seed: c.seed,
            vehicles: c.vehicles,
            features: c.features,
            area: c.area,
            separation: c.separation,
            course_length: c.course_length,
            duration: c.duration,
            period: c.period,
            radar_range: c.radar_range,
            range_sigma: c.range_sigma,
            bearing_sigma: c.bearing_sigma,
            speed_sigma: c.speed_sigma,
            rate_sigma: c.rate_sigma,
            coast_distance: c.coast_distance,
            coast_relief: c.coast_relief,
            coast_strip: c.coast_strip,
        }
    }

    pub(crate) fn c_value(&self) -> sys::cairn_fleet_options {
        let mut c = Self::empty_c();
        c.layout = self.layout.0;
        c.seed = self.seed;
        c.vehicles = self.vehicles;
        c.features = self.features;
        c.area = self.area;
        c.separation = self.separation;
        c.course_length = self.course_length;
        c.duration = self.duration;
        c.period = self.period;
        c.radar_range = self.radar_range;
        c.range_sigma = self.range_sigma;
        c.bearing_sigma = self.bearing_sigma;
        c.speed_sigma = self.speed_sigma;
        c.rate_sigma = self.rate_sigma;
        c.coast_distance = self.coast_distance;
        c.coast_relief = self.coast_relief;
        c.coast_strip = self.coast_strip;
        c
    }
}

#[cfg(feature = "sim")]
impl Default for FleetOptions {
    /// The defaults of the library.
    fn default() -> Self {
        let mut c = Self::empty_c();
        // SAFETY: the library writes at most the size that it gets. It fails only for NULL.
        unsafe {
            sys::cairn_fleet_options_init(&mut c, size_of::<sys::cairn_fleet_options>(), std::ptr::null_mut());
        }
        Self::from_c(&c)
    }
}

#[cfg(feature = "sim")]
/// Radar measurement of a feature or of a boat. Layout frozen.
#[derive(Clone, Debug, PartialEq, Copy)]
#[repr(C)]
#[cfg(feature = "sim")]
pub struct FleetSighting {
    /// number of the feature or of the boat; both count from 1
    pub id: u64,
    /// m, > 0: noise that would make it 0 or less is drawn again
    pub range: f64,
    /// in the frame of the boat that measures, rad
    pub bearing: f64,
}

#[cfg(feature = "sim")]
impl FleetSighting {
    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_fleet_sighting) -> Self {
        FleetSighting {
            id: c.id,
            range: c.range,
            bearing: c.bearing,
        }
    }
}

#[cfg(feature = "sim")]
/// A boat at the end of a step. Layout frozen.
#[derive(Clone, Debug, PartialEq, Copy)]
#[repr(C)]
#[cfg(feature = "sim")]
pub struct FleetVehicle {
    /// commanded speed during the step, m/s: the input of a filter; 0 at step 0
    pub speed: f64,
    /// commanded rate during the step, rad/s; 0 at step 0
    pub rate: f64,
    /// true position, east, m
    pub x: f64,
    /// true position, north, m
    pub y: f64,
    /// true heading, rad
    pub heading: f64,
    /// measured features, for [`Fleet::seen_features`](crate::Fleet::seen_features)
    pub feature_count: u64,
    /// measured other boats, for [`Fleet::seen_vehicles`](crate::Fleet::seen_vehicles)
    pub vehicle_count: u64,
}

#[cfg(feature = "sim")]
impl FleetVehicle {
    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_fleet_vehicle) -> Self {
        FleetVehicle {
            speed: c.speed,
            rate: c.rate,
            x: c.x,
            y: c.y,
            heading: c.heading,
            feature_count: c.feature_count,
            vehicle_count: c.vehicle_count,
        }
    }
}

#[cfg(feature = "sim")]
/// A step: all boats move, then all boats scan.
#[derive(Clone, Debug, PartialEq)]
#[cfg(feature = "sim")]
pub struct FleetStep {
    /// counted from 0; step 0 is a scan at the start, before any motion
    pub number: u64,
    /// s, from 0
    pub time: f64,
    /// since the step before, s: `period`, or 0 at step 0
    pub dt: f64,
    /// number of boats, for [`Fleet::vehicles`](crate::Fleet::vehicles)
    pub vehicle_count: u64,
}

#[cfg(feature = "sim")]
impl FleetStep {
    pub(crate) fn empty_c() -> sys::cairn_fleet_step {
        // SAFETY: numbers, for which zero is a value.
        let mut c: sys::cairn_fleet_step = unsafe { zeroed() };
        c.struct_size = size_of::<sys::cairn_fleet_step>() as u32;
        c
    }

    #[allow(dead_code)]
    pub(crate) fn from_c(c: &sys::cairn_fleet_step) -> Self {
        FleetStep {
            number: c.number,
            time: c.time,
            dt: c.dt,
            vehicle_count: c.vehicle_count,
        }
    }
}

#[cfg(feature = "sim")]
impl Default for FleetStep {
    /// Zeros.
    fn default() -> Self {
        let c = Self::empty_c();
        Self::from_c(&c)
    }
}

fn debug_value<T: PartialEq + fmt::Display>(
    f: &mut fmt::Formatter<'_>, name: &str, value: T, constants: &[(T, &str)],
) -> fmt::Result {
    match constants.iter().find(|constant| constant.0 == value) {
        Some(constant) => write!(f, "{name}::{}", constant.1),
        None => write!(f, "{name}({value})"),
    }
}

fn debug_bits(f: &mut fmt::Formatter<'_>, name: &str, value: u32, constants: &[(u32, &str)]) -> fmt::Result {
    let set = constants.iter().filter(|constant| value & constant.0 != 0).map(|constant| constant.1);
    let set: Vec<&str> = set.collect();
    write!(f, "{name}({})", set.join(" | "))
}

#[cfg(test)]
mod layout {
    use super::*;
    use std::mem::{align_of, MaybeUninit};
    use std::ptr::addr_of;

    #[test]
    fn cairn_pose_is_that_of_c() {
        assert_eq!(size_of::<Pose>(), size_of::<sys::cairn_pose>());
        assert_eq!(align_of::<Pose>(), align_of::<sys::cairn_pose>());
        let (memory, c) = (MaybeUninit::<Pose>::uninit(), MaybeUninit::<sys::cairn_pose>::uninit());
        let (start, c) = (memory.as_ptr(), c.as_ptr());
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).position) as usize, addr_of!((*c).position) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).quaternion) as usize, addr_of!((*c).quaternion) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
    }

    #[test]
    fn cairn_landmark_is_that_of_c() {
        assert_eq!(size_of::<Landmark>(), size_of::<sys::cairn_landmark>());
        assert_eq!(align_of::<Landmark>(), align_of::<sys::cairn_landmark>());
        let (memory, c) = (MaybeUninit::<Landmark>::uninit(), MaybeUninit::<sys::cairn_landmark>::uninit());
        let (start, c) = (memory.as_ptr(), c.as_ptr());
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).id) as usize, addr_of!((*c).id) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).observations) as usize, addr_of!((*c).observations) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).position) as usize, addr_of!((*c).position) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).covariance) as usize, addr_of!((*c).covariance) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
    }

    #[test]
    fn cairn_observation_is_that_of_c() {
        assert_eq!(size_of::<Observation>(), size_of::<sys::cairn_observation>());
        assert_eq!(align_of::<Observation>(), align_of::<sys::cairn_observation>());
        let (memory, c) = (MaybeUninit::<Observation>::uninit(), MaybeUninit::<sys::cairn_observation>::uninit());
        let (start, c) = (memory.as_ptr(), c.as_ptr());
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).id) as usize, addr_of!((*c).id) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).z) as usize, addr_of!((*c).z) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).covariance) as usize, addr_of!((*c).covariance) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
    }

    #[test]
    fn cairn_match_is_that_of_c() {
        assert_eq!(size_of::<Match>(), size_of::<sys::cairn_match>());
        assert_eq!(align_of::<Match>(), align_of::<sys::cairn_match>());
        let (memory, c) = (MaybeUninit::<Match>::uninit(), MaybeUninit::<sys::cairn_match>::uninit());
        let (start, c) = (memory.as_ptr(), c.as_ptr());
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).landmark) as usize, addr_of!((*c).landmark) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).result) as usize, addr_of!((*c).result) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).reason) as usize, addr_of!((*c).reason) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).distance) as usize, addr_of!((*c).distance) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).threshold) as usize, addr_of!((*c).threshold) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
    }

    #[cfg(feature = "sim")]
    #[test]
    fn cairn_world_motion_is_that_of_c() {
        assert_eq!(size_of::<WorldMotion>(), size_of::<sys::cairn_world_motion>());
        assert_eq!(align_of::<WorldMotion>(), align_of::<sys::cairn_world_motion>());
        let (memory, c) = (MaybeUninit::<WorldMotion>::uninit(), MaybeUninit::<sys::cairn_world_motion>::uninit());
        let (start, c) = (memory.as_ptr(), c.as_ptr());
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).dt) as usize, addr_of!((*c).dt) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).velocity) as usize, addr_of!((*c).velocity) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).rate) as usize, addr_of!((*c).rate) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).wheels) as usize, addr_of!((*c).wheels) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).true_velocity) as usize, addr_of!((*c).true_velocity) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).true_rate) as usize, addr_of!((*c).true_rate) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).true_wheels) as usize, addr_of!((*c).true_wheels) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
    }

    #[cfg(feature = "sim")]
    #[test]
    fn cairn_fleet_sighting_is_that_of_c() {
        assert_eq!(size_of::<FleetSighting>(), size_of::<sys::cairn_fleet_sighting>());
        assert_eq!(align_of::<FleetSighting>(), align_of::<sys::cairn_fleet_sighting>());
        let (memory, c) = (MaybeUninit::<FleetSighting>::uninit(), MaybeUninit::<sys::cairn_fleet_sighting>::uninit());
        let (start, c) = (memory.as_ptr(), c.as_ptr());
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).id) as usize, addr_of!((*c).id) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).range) as usize, addr_of!((*c).range) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).bearing) as usize, addr_of!((*c).bearing) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
    }

    #[cfg(feature = "sim")]
    #[test]
    fn cairn_fleet_vehicle_is_that_of_c() {
        assert_eq!(size_of::<FleetVehicle>(), size_of::<sys::cairn_fleet_vehicle>());
        assert_eq!(align_of::<FleetVehicle>(), align_of::<sys::cairn_fleet_vehicle>());
        let (memory, c) = (MaybeUninit::<FleetVehicle>::uninit(), MaybeUninit::<sys::cairn_fleet_vehicle>::uninit());
        let (start, c) = (memory.as_ptr(), c.as_ptr());
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).speed) as usize, addr_of!((*c).speed) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).rate) as usize, addr_of!((*c).rate) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).x) as usize, addr_of!((*c).x) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).y) as usize, addr_of!((*c).y) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).heading) as usize, addr_of!((*c).heading) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).feature_count) as usize, addr_of!((*c).feature_count) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
        // SAFETY: only addresses are computed.
        let (rust, other) = unsafe {
            (addr_of!((*start).vehicle_count) as usize, addr_of!((*c).vehicle_count) as usize)
        };
        assert_eq!(rust - start as usize, other - c as usize);
    }
}
