// SPDX-License-Identifier: BSD-3-Clause
// Written by generate.py from api.json. Do not edit.
use std::marker::{PhantomData, PhantomPinned};
use std::os::raw::{c_char, c_void};

/// Major version of this header. cairn_version returns the version of the loaded library.
pub const CAIRN_VERSION_MAJOR: i32 = 0;

/// minor version of this header
pub const CAIRN_VERSION_MINOR: i32 = 2;

/// patch version of this header
pub const CAIRN_VERSION_PATCH: i32 = 0;

/// Version of this header as one number, for comparisons: 10000 major + 100 minor + patch.
pub const CAIRN_VERSION: i32 = 200;

/// The id that no landmark has.
pub const CAIRN_ID_NONE: u64 = 18446744073709551615;

/// A yes or no: 1 or 0. Any other value is refused.
pub type cairn_bool = i32;

/// Status of every fallible call: 0 is success, a negative value an error. A value never changes its meaning. A refused
/// observation is not an error: its cairn_match reports the refusal.
pub type cairn_status = i32;
/// success
pub const CAIRN_OK: cairn_status = 0;
/// an argument is NULL, not finite, out of range or not a covariance
pub const CAIRN_ERROR_ARGUMENT: cairn_status = -1;
/// the caller's buffer is too short; `*needed` holds the size that is necessary
pub const CAIRN_ERROR_BUFFER: cairn_status = -2;
/// a capacity set at creation is exhausted (landmarks, observations, sensors)
pub const CAIRN_ERROR_CAPACITY: cairn_status = -3;
/// no landmark, sensor or vehicle has this id
pub const CAIRN_ERROR_NOT_FOUND: cairn_status = -4;
/// a covariance would lose positive definiteness, or a result is not finite
pub const CAIRN_ERROR_NUMERICAL: cairn_status = -5;
/// there is not enough memory
pub const CAIRN_ERROR_MEMORY: cairn_status = -6;
/// the handle is in a state that does not allow this call
pub const CAIRN_ERROR_STATE: cairn_status = -7;
/// a defect of the library; please report it
pub const CAIRN_ERROR_INTERNAL: cairn_status = -8;
/// a callback of the caller returned a negative value and so aborted the call
pub const CAIRN_ERROR_CALLBACK: cairn_status = -9;

/// How a map holds the joint uncertainty of its landmarks. Only maps of the same kind can be merged.
pub type cairn_map_form = i32;
/// positions and their joint covariance: a single map, or densely joined submaps
pub const CAIRN_MAP_DENSE: cairn_map_form = 0;
/// submaps and the factor of their information: sparsely joined submaps
pub const CAIRN_MAP_SPARSE: cairn_map_form = 1;

/// How cairn_map_merge finds the landmarks that both maps hold, the common landmarks.
pub type cairn_merge_by = i32;
/// landmarks with the same id
pub const CAIRN_MERGE_BY_ID: cairn_merge_by = 0;
/// landmarks that lie in the same way relative to each other; ids are ignored
pub const CAIRN_MERGE_BY_GEOMETRY: cairn_merge_by = 1;

/// Sign of the yaw rate that follows from two wheel rates.
pub type cairn_yaw = i32;
/// z up: the vehicle turns left (positive yaw rate) when the right wheels turn faster; the default
pub const CAIRN_YAW_RIGHT_MINUS_LEFT: cairn_yaw = 0;
/// z down: eq. 1 as printed in the Mars paper
pub const CAIRN_YAW_LEFT_MINUS_RIGHT: cairn_yaw = 1;

/// How the noise of the two encoders of a head enters (cairn_stereo_head).
pub type cairn_encoder = i32;
/// the head moves between observations: each has independent noise; the default
pub const CAIRN_ENCODER_PER_OBSERVATION: cairn_encoder = 0;
/// the head stands still: all observations of a frame have the same encoder error
pub const CAIRN_ENCODER_PER_FRAME: cairn_encoder = 1;

/// Loss of a residual at the distance d, in standard deviations (docs/update.md, "Robust losses").
pub type cairn_loss = i32;
/// d^2 / 2: least squares; the default
pub const CAIRN_LOSS_NONE: cairn_loss = 0;
/// d^2 / 2 up to the width k, k d - k^2 / 2 beyond: the influence of an observation is bounded
pub const CAIRN_LOSS_HUBER: cairn_loss = 1;
/// c^2 / 2 log(1 + d^2 / c^2): the influence falls with the distance, and gross outliers have nearly none
pub const CAIRN_LOSS_CAUCHY: cairn_loss = 2;

/// Result of an observation.
pub type cairn_result = i32;
/// it updated the landmark
pub const CAIRN_RESULT_MATCHED: cairn_result = 1;
/// it placed a new landmark, or placed a landmark again that had been placed wrongly; then `distance` and `threshold`
/// are those of its test against the former place
pub const CAIRN_RESULT_NEW: cairn_result = 2;
/// it was refused and changed nothing; `reason` says why
pub const CAIRN_RESULT_REJECTED: cairn_result = 3;

/// Why an observation was refused.
pub type cairn_reason = i32;
/// it was not refused
pub const CAIRN_REASON_NONE: cairn_reason = 0;
/// its distance exceeds the threshold of the gate of one observation (chi-square)
pub const CAIRN_REASON_GATE: cairn_reason = 1;
/// it passed its own gate, but was removed so that the whole batch passes the batch gate
pub const CAIRN_REASON_BATCH_GATE: cairn_reason = 2;
/// the estimated landmark cannot give an observation: behind the lens, too near, too steep
pub const CAIRN_REASON_NO_IMAGE: cairn_reason = 3;
/// the observation cannot place a landmark: disparity or range too small, range too large beside its noise, or the
/// sensor never places landmarks
pub const CAIRN_REASON_NO_PLACE: cairn_reason = 4;
/// unknown ids: it passed its own gate, but the best set of pairs does not contain it
pub const CAIRN_REASON_AMBIGUOUS: cairn_reason = 5;
/// the observation could place a landmark, but the map is full
pub const CAIRN_REASON_NO_ROOM: cairn_reason = 6;
/// the observation could place a landmark, but most of what is seen contradicts the pose: nothing is placed until it is
/// decided what is wrong.
pub const CAIRN_REASON_CONTRADICTED: cairn_reason = 7;

/// Error of the state that the filter's covariance describes (docs/invariant_error.md).
pub type cairn_state_error = i32;
/// right-invariant error on SE_{K+1}(3): consistent; the default
pub const CAIRN_STATE_ERROR_INVARIANT: cairn_state_error = 0;
/// separate errors of position, attitude and landmarks: standard EKF-SLAM, for comparison
pub const CAIRN_STATE_ERROR_STANDARD: cairn_state_error = 1;

/// Space in which the vehicle moves (docs/plane.md). The interface of a planar vehicle is the same as that of a spatial
/// one: the vehicle lies in z = 0 and turns about z. The filter reads only the rows and columns of x, y and yaw of
/// covariances and Jacobians that it gets. Covariances that it returns have zeros elsewhere.
pub type cairn_vehicle = i32;
/// six degrees of freedom; the default
pub const CAIRN_VEHICLE_SPATIAL: cairn_vehicle = 0;
/// x, y and heading; landmarks x and y
pub const CAIRN_VEHICLE_PLANAR: cairn_vehicle = 1;

/// How a closed submap joins the map (docs/submaps.md).
pub type cairn_join = i32;
/// dense if max_landmarks is at most 100, sparse otherwise; the default
pub const CAIRN_JOIN_AUTO: cairn_join = 0;
/// a filter with the covariance of the whole map: a closing costs O(n^2) for n states of the map
pub const CAIRN_JOIN_DENSE: cairn_join = 1;
/// solves for all submaps together on a sparse factor and relinearises them: the total cost is nearly linear
pub const CAIRN_JOIN_SPARSE: cairn_join = 2;

/// How the filter finds the landmark of an observation (docs/association.md).
pub type cairn_association = i32;
/// by the id of the observation; the default
pub const CAIRN_ASSOCIATION_KNOWN: cairn_association = 0;
/// nearest neighbour by Mahalanobis distance; each landmark is matched at most once in a frame. Ids of observations are
/// ignored, and landmarks are numbered from 0 in the order in which they are placed
pub const CAIRN_ASSOCIATION_NEAREST: cairn_association = 1;
/// the largest set of pairs that are jointly compatible (branch and bound); ids as for CAIRN_ASSOCIATION_NEAREST
pub const CAIRN_ASSOCIATION_JOINT: cairn_association = 2;

/// Distance by which CAIRN_ASSOCIATION_NEAREST chooses among landmarks.
pub type cairn_distance = i32;
/// the squared Mahalanobis distance d^2; the default
pub const CAIRN_DISTANCE_MAHALANOBIS: cairn_distance = 0;
/// d^2 + log det S, which is -2 log of the likelihood: if two landmarks have the same d^2, the better known one is
/// chosen. The gates still use d^2
pub const CAIRN_DISTANCE_LIKELIHOOD: cairn_distance = 1;

/// What becomes of the noise that the filter learns from its innovations (docs/trust.md).
pub type cairn_noise_learning = i32;
/// cairn_filter_health reports it; the default
pub const CAIRN_NOISE_REPORTED: cairn_noise_learning = 0;
/// from when it is known, it scales the stated noise of each sensor and of the motion
pub const CAIRN_NOISE_APPLIED: cairn_noise_learning = 1;

/// Why a submap was closed.
pub type cairn_closed_by = i32;
/// no submap was closed yet
pub const CAIRN_CLOSED_BY_NONE: cairn_closed_by = 0;
/// cairn_filter_close_submap
pub const CAIRN_CLOSED_BY_CALLER: cairn_closed_by = 1;
/// submap_landmarks
pub const CAIRN_CLOSED_BY_LANDMARKS: cairn_closed_by = 2;
/// submap_distance
pub const CAIRN_CLOSED_BY_DISTANCE: cairn_closed_by = 3;
/// submap_extent
pub const CAIRN_CLOSED_BY_EXTENT: cairn_closed_by = 4;
/// submap_sigma
pub const CAIRN_CLOSED_BY_SIGMA: cairn_closed_by = 5;
/// an absolute position, attitude or heading could not be taken in otherwise
pub const CAIRN_CLOSED_BY_FIX: cairn_closed_by = 6;

/// The verdict on a filter.
pub type cairn_verdict = i32;
/// what is seen agrees with the estimate and with the stated noise
pub const CAIRN_VERDICT_GOOD: cairn_verdict = 0;
/// something does not agree; the reasons say what
pub const CAIRN_VERDICT_DOUBTFUL: cairn_verdict = 1;
/// most of what is seen contradicts the estimate
pub const CAIRN_VERDICT_LOST: cairn_verdict = 2;

/// The reasons of a verdict, one bit each.
pub type cairn_doubts = u32;
/// the normalised innovations of the window lie above their band
pub const CAIRN_DOUBT_NIS: cairn_doubts = 1;
/// the gates refuse more than they refuse of honest observations
pub const CAIRN_DOUBT_REFUSALS: cairn_doubts = 2;
/// the motion was widened, because most of what was seen contradicted it
pub const CAIRN_DOUBT_WIDENED: cairn_doubts = 4;
/// a sensor's noise is more than 1.5 times what is stated
pub const CAIRN_DOUBT_SENSOR_NOISE: cairn_doubts = 8;
/// the motion's noise is clearly more than what is stated
pub const CAIRN_DOUBT_MOTION_NOISE: cairn_doubts = 16;
/// the corrections of the pose have a mean: the motion has a constant error
pub const CAIRN_DOUBT_BIAS: cairn_doubts = 32;
/// a frame contradicts the motion since the last frame: a slip, or another place
pub const CAIRN_DOUBT_JUMP: cairn_doubts = 64;
/// single landmarks contradict the rest: moved, or under a wrong id
pub const CAIRN_DOUBT_LANDMARKS: cairn_doubts = 128;
/// a closed submap contradicted the map
pub const CAIRN_DOUBT_CLOSING: cairn_doubts = 256;
/// directions of the pose about which the last frames say nothing
pub const CAIRN_DOUBT_BLIND: cairn_doubts = 512;
/// the covariance of the pose is not positive semidefinite
pub const CAIRN_DOUBT_DEFINITE: cairn_doubts = 1024;

/// Kinds of systematic errors.
pub type cairn_systematic = i32;
/// of the measured body velocity, m/s; components x, y, z
pub const CAIRN_SYSTEMATIC_VELOCITY_BIAS: cairn_systematic = 0;
/// of the measured body rate, rad/s; components x, y, z
pub const CAIRN_SYSTEMATIC_RATE_BIAS: cairn_systematic = 1;
/// of a wheel's measured rate; components left and right
pub const CAIRN_SYSTEMATIC_WHEEL_SCALE: cairn_systematic = 2;
/// of a sensor against the body, m; components x, y, z
pub const CAIRN_SYSTEMATIC_MOUNT_SHIFT: cairn_systematic = 3;
/// of a sensor about the origin of the body: a rotation vector, rad
pub const CAIRN_SYSTEMATIC_MOUNT_TURN: cairn_systematic = 4;
/// of the values of a sensor's observations, in their units
pub const CAIRN_SYSTEMATIC_OFFSET: cairn_systematic = 5;

/// Mode: how a vehicle uses the packets of its teammates.
pub type cairn_team_mode = i32;
/// it ignores them; for comparison
pub const CAIRN_TEAM_MONO: cairn_team_mode = 0;
/// extended observations with independent noise, as printed in the cooperative paper: overconfident, and more so with
/// more landmarks
pub const CAIRN_TEAM_EO_DIAGONAL: cairn_team_mode = 1;
/// extended observations with the noise that all observations of a scan share through the sighting
pub const CAIRN_TEAM_EO_FULL: cairn_team_mode = 2;
/// every vehicle runs the same filter over all poses and all landmarks; the default
pub const CAIRN_TEAM_JOINT: cairn_team_mode = 3;
/// every vehicle works in its own submaps, which are fused by their common landmarks; sightings between vehicles are
/// not used
pub const CAIRN_TEAM_SUBMAPS: cairn_team_mode = 4;

/// Result of a received packet.
pub type cairn_packet = i32;
/// it had its turn and is part of the estimate
pub const CAIRN_PACKET_TAKEN: cairn_packet = 1;
/// it waits for its turn
pub const CAIRN_PACKET_WAITING: cairn_packet = 2;
/// a teammate misses own packets; they are queued to be sent again
pub const CAIRN_PACKET_REQUEST: cairn_packet = 3;
/// a teammate leaves the team when this packet has its turn
pub const CAIRN_PACKET_LEAVE: cairn_packet = 4;
/// it was received before
pub const CAIRN_PACKET_REPEATED: cairn_packet = 5;
/// it is an own packet that came back
pub const CAIRN_PACKET_OWN: cairn_packet = 6;
/// the mode does not use it, or it is for another vehicle
pub const CAIRN_PACKET_IGNORED: cairn_packet = 7;
/// its sender is not in the team
pub const CAIRN_PACKET_UNKNOWN: cairn_packet = 8;
/// its time does not agree with its number
pub const CAIRN_PACKET_PAST: cairn_packet = 9;
/// a different packet of this sender with this number was received before: two vehicles have the same number
pub const CAIRN_PACKET_CONFLICT: cairn_packet = 10;
/// max_waiting packets of this sender wait already
pub const CAIRN_PACKET_FULL: cairn_packet = 11;
/// it is not a packet of a team
pub const CAIRN_PACKET_FOREIGN: cairn_packet = 12;
/// this library does not read its version
pub const CAIRN_PACKET_VERSION: cairn_packet = 13;
/// bytes are missing, or there are too many
pub const CAIRN_PACKET_CUT: cairn_packet = 14;
/// its checksum is wrong
pub const CAIRN_PACKET_CORRUPT: cairn_packet = 15;
/// it is complete, but not a valid step: values that are not finite, noise that is not a covariance, an id or a number
/// twice, numbers of absurd size
pub const CAIRN_PACKET_NONSENSE: cairn_packet = 16;
/// its time is more than max_jump after that of the sender's packet before it. The next packet of the sender decides:
/// if it agrees with this one, both are right, and this one can be received again
pub const CAIRN_PACKET_AHEAD: cairn_packet = 17;

/// Courses. On each the rover has a constant speed over the xy plane of the map.
pub type cairn_course = i32;
/// the course of the paper: a circle, driven anticlockwise; the default
pub const CAIRN_COURSE_CIRCLE: cairn_course = 0;
/// a wandering closed curve, driven several times
pub const CAIRN_COURSE_LAPS: cairn_course = 1;
/// a long drive: a chain of circles, alternately left and right. Each circle is driven 1.25 times before the next one
/// is entered where both touch. So each circle closes a loop, and a quarter of it is seen again
pub const CAIRN_COURSE_TRAVERSE: cairn_course = 2;

/// Ground.
pub type cairn_terrain = i32;
/// seeded smooth hills, shifted to `start_height` at (100, 20); the default
pub const CAIRN_TERRAIN_ROLLING: cairn_terrain = 0;
/// z = sin(x / 15) + 0.8 cos(y / 12); the same for every seed; not shifted
pub const CAIRN_TERRAIN_WAVES: cairn_terrain = 1;
/// z = 0
pub const CAIRN_TERRAIN_FLAT: cairn_terrain = 2;

/// How the rover stands on the ground. Seen from above, its x axis points along the course.
pub type cairn_contact = i32;
/// on four wheels; a differential averages the left and the right rocker. All four wheels touch the ground, and height
/// and attitude are those of the chassis between them; the default
pub const CAIRN_CONTACT_WHEELS: cairn_contact = 0;
/// at one point; its z axis is the normal of the ground
pub const CAIRN_CONTACT_POINT: cairn_contact = 1;

/// Measurements that the motion samples of a step hold as `velocity` and `rate`.
pub type cairn_drive = i32;
/// body velocity and body rate from the IMU; the default
pub const CAIRN_DRIVE_TWIST: cairn_drive = 0;
/// forward velocity from the wheels (Mars paper, eq. 1), zero along y and z; body rate from the gyro
pub const CAIRN_DRIVE_WHEELS_GYRO: cairn_drive = 1;

/// Noise of the accelerometer. Table 1 of the paper gives it in m/s.
pub type cairn_accelerometer = i32;
/// white noise of the body velocity, m/s a sample; the default
pub const CAIRN_ACCELEROMETER_VELOCITY: cairn_accelerometer = 0;
/// white noise of the acceleration, m/s^2 a sample: the velocity comes from dead reckoning of specific force and rate
/// from a known start, and drifts
pub const CAIRN_ACCELEROMETER_ACCELERATION: cairn_accelerometer = 1;

/// How the noise of the stick angle enters.
pub type cairn_stick = i32;
/// independent in each observation's elevation; the default
pub const CAIRN_STICK_PER_OBSERVATION: cairn_stick = 0;
/// all observations of a frame share one encoder error; the image adds noise of `image_sigma` to each elevation
pub const CAIRN_STICK_PER_FRAME: cairn_stick = 1;

/// Worlds for measurements. In the rows, velocity and rate noise are those of a sample of 0.2 s. The rows use
/// CAIRN_TERRAIN_WAVES, CAIRN_CONTACT_POINT and a radius of 101.98 m.
pub type cairn_preset = i32;
/// the defaults: Table 1 as printed
pub const CAIRN_PRESET_PAPER: cairn_preset = 0;
/// 0.002 m/s, 0.02 degrees/s, 1 lap in 400 s
pub const CAIRN_PRESET_ROW1: cairn_preset = 1;
/// 0.05 m/s, 0.2 degrees/s, 1 lap in 400 s
pub const CAIRN_PRESET_ROW2: cairn_preset = 2;
/// 0.05 m/s, 0.2 degrees/s, 2 laps in 400 s
pub const CAIRN_PRESET_ROW3: cairn_preset = 3;
/// 0.2 m/s, 1 degree/s, 2 laps in 400 s
pub const CAIRN_PRESET_ROW4: cairn_preset = 4;

/// Where the features are. Both layouts have the coast line, but the radars see only features.
pub type cairn_fleet_layout = i32;
/// uniform in the square, on both sides of the coast line; the default
pub const CAIRN_FLEET_UNIFORM: cairn_fleet_layout = 0;
/// along the coast line, in a strip of width `coast_strip` south of it. The coast line runs north of the boats, from
/// the western side of the square to the eastern side
pub const CAIRN_FLEET_COAST: cairn_fleet_layout = 1;

/// Landmarks in one frame with their joint uncertainty. A filter owns a map (cairn_filter_map), which follows the
/// filter. The caller owns a copy (cairn_map_copy). A copy does not follow the filter, and other maps can be merged
/// into it (cairn_map_merge).
#[repr(C)]
pub struct cairn_map {
    _memory: [u8; 0],
    _marker: PhantomData<(*mut u8, PhantomPinned)>,
}

/// Estimates the pose of one vehicle and its map together.
#[repr(C)]
pub struct cairn_filter {
    _memory: [u8; 0],
    _marker: PhantomData<(*mut u8, PhantomPinned)>,
}

/// One vehicle's view of its team. Each vehicle has its own handle, on its own computer. The vehicles exchange packets
/// by any transport. Unlike a filter, a team allocates memory in its calls. A call that fails leaves the team as it
/// was, also if memory runs out; the call can be repeated. Exceptions: cairn_team_observe tells what it keeps of a step
/// that the filter refuses and of a time that is refused. In mode CAIRN_TEAM_SUBMAPS a closing that runs out of memory
/// does not fail the call: the packets that have their turn after it wait, and the next call first makes up for it
/// (`interrupted` of cairn_team_report). If there is still no memory, this next call fails.
#[repr(C)]
pub struct cairn_team {
    _memory: [u8; 0],
    _marker: PhantomData<(*mut u8, PhantomPinned)>,
}

/// A world with one rover that drives through it.
#[repr(C)]
pub struct cairn_world {
    _memory: [u8; 0],
    _marker: PhantomData<(*mut u8, PhantomPinned)>,
}

/// A square of sea with boats that drive in it.
#[repr(C)]
pub struct cairn_fleet {
    _memory: [u8; 0],
    _marker: PhantomData<(*mut u8, PhantomPinned)>,
}

/// Why a call failed. It belongs to the caller: `cairn_error error = {sizeof error};`. Every fallible call takes one as
/// its last parameter, or NULL. A call that fails fills it in. A call that succeeds leaves it as it is. A message that
/// is longer than the struct is cut between two characters.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_error {
    /// sizeof(cairn_error) of the caller; set it before the call
    pub struct_size: u32,
    /// what the call returned
    pub status: cairn_status,
    /// one line of UTF-8, ended by a zero: the argument or variable, the cause, the remedy
    pub message: [c_char; 504],
}

/// Pose of a frame b in a frame a: `p_a = R(quaternion) p_b + position`. SI units, Hamilton quaternion, w first.
///
/// The error of a pose is `[dp; dtheta]` (m, rad), both in the axes of the parent frame a: `position_true = position +
/// dp`, `R_true = Exp(dtheta) R`. Every 6x6 covariance of a pose in this interface is the covariance of this error,
/// row-major. Layout frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_pose {
    /// origin of b in a, m
    pub position: [f64; 3],
    /// rotation from b to a: w x y z, unit length
    pub quaternion: [f64; 4],
}

/// A landmark. Layout frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_landmark {
    /// the caller's id, or the assigned one; it never changes
    pub id: u64,
    /// observations that placed or updated it
    pub observations: u64,
    /// in the map frame, m
    pub position: [f64; 3],
    /// covariance of the position, 3x3 row-major, m^2
    pub covariance: [f64; 9],
}

/// Options of cairn_map_merge. Set them by cairn_merge_options_init first.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_merge_options {
    /// sizeof(cairn_merge_options) of the caller
    pub struct_size: u32,
    /// CAIRN_MERGE_BY_ID or CAIRN_MERGE_BY_GEOMETRY; default CAIRN_MERGE_BY_ID
    pub association: cairn_merge_by,
    /// probability that all common landmarks of a correct merge pass their own gates, in (0, 1\]; default 0.9999
    pub gate_probability: f64,
    /// probability that they pass the joint gate, in (0, 1\]; default 0.9999
    pub joint_gate_probability: f64,
    /// capacity of the merged map; 0, the default: no limit
    pub max_landmarks: u64,
    /// by geometry, without has_transform: largest angle between the z axes of both frames, rad, 0 to pi; default pi
    pub max_tilt: f64,
    /// 1: T_map_other is known beforehand, independently of both maps; default 0
    pub has_transform: cairn_bool,
    /// 0
    pub reserved: u32,
    /// with has_transform: from the other's frame into the map's frame; default identity
    pub T_map_other: cairn_pose,
    /// covariance of its error \[dp; dtheta\], 6x6 row-major, positive semidefinite; default 0: known exactly
    pub covariance: [f64; 36],
}

/// Report of cairn_map_merge, also of a refused merge. Fields that the merge did not reach are 0.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_merge_report {
    /// sizeof(cairn_merge_report) of the caller; set it before the call
    pub struct_size: u32,
    /// the one of the options
    pub association: cairn_merge_by,
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
    pub T_map_other: cairn_pose,
    /// covariance of its error \[dp; dtheta\], 6x6 row-major
    pub covariance: [f64; 36],
    /// id in the map of a common landmark that failed a test; CAIRN_ID_NONE: none
    pub broken_id: u64,
    /// id of the same landmark in the other map; CAIRN_ID_NONE: none
    pub broken_other_id: u64,
}

/// Where a landmark of the other map is after a merge. Layout frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_merged_id {
    /// its id in the other map
    pub other_id: u64,
    /// its id in the merged map
    pub id: u64,
    /// 1: the map held this landmark before; 0: it was added
    pub common: cairn_bool,
    /// 0
    pub reserved: u32,
}

/// Four-wheel differential drive; both wheels of a side turn at the same rate (Mars paper, eq. 1): `v_x = r (w_left +
/// w_right) / 2`, `w_z = +-(r / B) (w_right - w_left)`. The model has no motion along y and z and no roll and pitch
/// rate. Noise is white; each call is one sample with the standard deviations below.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_wheels {
    /// sizeof(cairn_wheels) of the caller
    pub struct_size: u32,
    /// CAIRN_YAW_RIGHT_MINUS_LEFT or CAIRN_YAW_LEFT_MINUS_RIGHT; default CAIRN_YAW_RIGHT_MINUS_LEFT
    pub yaw_sign: cairn_yaw,
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

/// Noise of measured body velocity and body rate (IMU, visual odometry). It is white, with a standard deviation per
/// sample and axis (x, y, z of the body). Mars paper, eq. 2, integrated on the group: `T <- T Exp([v; w] dt)`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_twist_noise {
    /// sizeof(cairn_twist_noise) of the caller
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// m/s, >= 0; default 0.05 each
    pub velocity_sigma: [f64; 3],
    /// rad/s, >= 0; default 0.005 each
    pub rate_sigma: [f64; 3],
}

/// Stereo head on a pan and tilt mount (Mars paper, Figures 2 and 3, eq. 4). It observes range, azimuth and elevation.
///
/// A point `m_c` of the camera frame (x out of the lens, y left, z up) lies in the body frame at `m_b = d + Rz(pan)
/// Ry(stick) (s + R(q) m_c)`. The platform stands at `d`. It turns by `pan` about its z axis, and by `stick` about the
/// bolt, which is its y axis. The stick carries the camera at `s`, turned by `q`. The observation is `z = (range,
/// azimuth, elevation)` of `m_c`: `range = |m_c|` (m), `azimuth = atan2(y, x)` (rad, left positive), `elevation =
/// atan2(z, sqrt(x^2 + y^2))` (rad, up positive). A positive stick angle lowers the lens, so a stick that turns by
/// -elevation points the lens at the point. With the default mount the camera frame is the body frame.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_stereo_head {
    /// sizeof(cairn_stereo_head) of the caller
    pub struct_size: u32,
    /// CAIRN_ENCODER_PER_OBSERVATION or CAIRN_ENCODER_PER_FRAME; default CAIRN_ENCODER_PER_OBSERVATION
    pub encoder_mode: cairn_encoder,
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

/// Rectified stereo camera: `z = (u_left, u_right, v)` in pixels of a point `(x, y, z)` of the left camera's frame (z
/// out of the lens, x right, y down): `u_left = fu x/z + cu`, `u_right = fu (x - baseline)/z + cu`, `v = fv y/z + cv`.
/// If both images give a row, pass the mean of both rows and half the variance of one.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_stereo_camera {
    /// sizeof(cairn_stereo_camera) of the caller
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
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
    pub T_body_camera: cairn_pose,
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

/// Radar, lidar or sonar of a planar vehicle: `z = (range, bearing)` of the landmark in the sensor's frame, m and rad,
/// positive to the left.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_range_bearing {
    /// sizeof(cairn_range_bearing) of the caller
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// sensor in the body, in the plane; default identity
    pub T_body_sensor: cairn_pose,
    /// m, > 0; default 0.1
    pub range_sigma: f64,
    /// rad, > 0; default 0.01
    pub bearing_sigma: f64,
    /// an observation is refused if the predicted range, or the observed range of a new landmark, is below this, m, >
    /// 0; default 0.01
    pub near_range: f64,
}

/// Any sensor that gives a point: `z = (x, y, z)` of the landmark in the sensor's frame, m; for a planar vehicle `z =
/// (x, y)`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_cartesian {
    /// sizeof(cairn_cartesian) of the caller
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// sensor in the body; default identity
    pub T_body_sensor: cairn_pose,
    /// noise of x, y, z, m, > 0; default 0.1 each
    pub sigma: [f64; 3],
}

/// A sensor of the caller's own, whose model are two functions (cairn_filter_add_custom).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_custom {
    /// sizeof(cairn_custom) of the caller
    pub struct_size: u32,
    /// values of an observation, 1 to 3; for a planar vehicle 1 or 2; default 3
    pub rows: u32,
    /// bit i is set: value i is an angle (rad) and its residual is wrapped to (-pi, pi\]; default 0
    pub angle_mask: u32,
    /// 1: z depends on pose and landmark only through the body point R^T (l - p), and the filter makes use of that;
    /// default 0: any function of both
    pub relative: cairn_bool,
    /// noise of each value, > 0; default 1 each
    pub sigma: [f64; 3],
}

/// One observation of one landmark by one sensor. Layout frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_observation {
    /// the caller's id of the landmark; not CAIRN_ID_NONE; once in a frame. Any value if the filter's `association` is
    /// not CAIRN_ASSOCIATION_KNOWN
    pub id: u64,
    /// values in the sensor's units; a custom sensor of fewer rows uses the first
    pub z: [f64; 3],
    /// noise of this observation, 3x3 row-major (custom: rows x rows, packed); all zero: the sensor's noise
    pub covariance: [f64; 9],
}

/// Match of one observation: what it was paired with, and whether it was used. Layout frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_match {
    /// landmark that the observation was compared with or that it placed; CAIRN_ID_NONE if there is none
    pub landmark: u64,
    /// CAIRN_RESULT_MATCHED, CAIRN_RESULT_NEW or CAIRN_RESULT_REJECTED
    pub result: cairn_result,
    /// one of the CAIRN_REASON_ constants
    pub reason: cairn_reason,
    /// squared Mahalanobis distance of the innovation (CAIRN_REASON_BATCH_GATE: that of the whole batch when this
    /// observation was removed); 0 if there is none
    pub distance: f64,
    /// chi-square bound that `distance` was compared with (infinity at a gate probability of 1); 0 if there is none
    pub threshold: f64,
}

/// Options of cairn_filter_create. Set them by cairn_filter_options_init first.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_filter_options {
    /// sizeof(cairn_filter_options) of the caller
    pub struct_size: u32,
    /// CAIRN_VEHICLE_SPATIAL or CAIRN_VEHICLE_PLANAR; default CAIRN_VEHICLE_SPATIAL
    pub vehicle: cairn_vehicle,
    /// CAIRN_STATE_ERROR_INVARIANT or CAIRN_STATE_ERROR_STANDARD; default CAIRN_STATE_ERROR_INVARIANT
    pub state_error: cairn_state_error,
    /// capacity; default 1000. Single map or dense joining: 1 to 30000, the memory grows with the square of this number
    /// and is taken at creation. Sparse joining: 1 to 10000000, only a bound, memory is taken as the map grows
    pub max_landmarks: u32,
    /// observations of one frame, 1 to 4096; default 64
    pub max_observations: u32,
    /// sensors that can be added, 1 to 256; default 8
    pub max_sensors: u32,
    /// body in the map frame at the start; default identity
    pub initial_pose: cairn_pose,
    /// covariance of its error \[dp; dtheta\], symmetric, positive semidefinite; default 0: known exactly
    pub initial_covariance: [f64; 36],
    /// linearisations of an update at most, 1 (plain EKF) to 50; default 3
    pub iterations: u32,
    /// CAIRN_NOISE_REPORTED or CAIRN_NOISE_APPLIED; default CAIRN_NOISE_REPORTED
    pub noise_learning: cairn_noise_learning,
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
    /// CAIRN_ASSOCIATION_KNOWN, CAIRN_ASSOCIATION_NEAREST or CAIRN_ASSOCIATION_JOINT; default CAIRN_ASSOCIATION_KNOWN
    pub association: cairn_association,
    /// CAIRN_DISTANCE_MAHALANOBIS or CAIRN_DISTANCE_LIKELIHOOD; default CAIRN_DISTANCE_MAHALANOBIS
    pub association_distance: cairn_distance,
    /// joint tests of one frame at most, 1 to 1000000; after this number the best set found so far is used; default
    /// 2000
    pub association_nodes: u32,
    /// a new landmark is deferred until it was observed this often, 1 to 1000: until then it is part of the estimate,
    /// but no map shows it; default 1
    pub deferred_sightings: u32,
    /// a deferred landmark is removed if it is not observed often enough within this many frames, 1 to 1000000; default
    /// 20
    pub deferred_frames: u32,
    /// a landmark is removed if it lay in a sensor's view (cairn_filter_set_view), but was not seen, in this many
    /// consecutive frames of this sensor; 0, the default: never
    pub missed_frames: u32,
    /// unknown ids: an observation places a new landmark only if its distance from each landmark exceeds the chi-square
    /// bound of this probability, in (0, 1). Landmarks that another observation of the frame is paired with do not
    /// count. A pair beyond this bound is never made. Default 0.9999
    pub new_probability: f64,
    /// a submap is closed when it holds this many landmarks, up to 4096; 0, the default: no submaps, one single map
    pub submap_landmarks: u32,
    /// CAIRN_JOIN_AUTO, CAIRN_JOIN_DENSE or CAIRN_JOIN_SPARSE; default CAIRN_JOIN_AUTO
    pub join: cairn_join,
    /// loss of the landmarks that a closed submap shares with the map: CAIRN_LOSS_NONE, CAIRN_LOSS_HUBER or
    /// CAIRN_LOSS_CAUCHY; default CAIRN_LOSS_NONE
    pub join_loss: cairn_loss,
    /// newest poses that are kept for cairn_filter_trajectory, 0 to 10000000; 0, the default: none. The memory is taken
    /// at creation, at most 600 bytes a pose
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
    /// numbers that cairn_filter_calibrate_sensor makes states, over all sensors, 0 to 64; default 0
    pub max_sensor_errors: u32,
    /// 0
    pub reserved: u32,
}

/// Report of the last attempt to close a submap.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_closing_report {
    /// sizeof(cairn_closing_report) of the caller; set it before the call
    pub struct_size: u32,
    /// CAIRN_OK, or the error because of which the submap stayed open
    pub status: cairn_status,
    /// CAIRN_CLOSED_BY_...
    pub reason: cairn_closed_by,
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
    pub association_exhausted: cairn_bool,
    /// submaps linearised again (sparse)
    pub relinearised: u32,
    /// blocks of the factor computed again (sparse)
    pub refactored: u32,
    /// linear solutions
    pub iterations: u32,
    /// 0
    pub reserved: u32,
    /// duration of the closing, s; it differs from run to run
    pub seconds: f64,
}

/// Report of the last update.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_update_report {
    /// sizeof(cairn_update_report) of the caller; set it before the call
    pub struct_size: u32,
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
    pub association_exhausted: cairn_bool,
    /// 0
    pub reserved: u32,
    /// duration of the association, s; it differs from run to run
    pub association_seconds: f64,
}

/// The verdict after the last update, and what supports it. A window counts the last 20 updates or so; older updates
/// fade. A factor that is 1 with a standard deviation above 1 is not known.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_health {
    /// sizeof(cairn_health) of the caller; set it before the call
    pub struct_size: u32,
    /// CAIRN_VERDICT_GOOD, CAIRN_VERDICT_DOUBTFUL or CAIRN_VERDICT_LOST
    pub verdict: cairn_verdict,
    /// bits CAIRN_DOUBT_...; 0 if the verdict is good
    pub reasons: cairn_doubts,
    /// directions of the pose about which the window says nothing
    pub blind_directions: u32,
    /// landmarks of the last frame whose observations contradict the rest
    pub contradicting: u32,
    /// 0
    pub reserved: u32,
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

/// What the observations of one sensor show.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_sensor_health {
    /// sizeof(cairn_sensor_health) of the caller; set it before the call
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
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

/// Systematic errors of one sensor. A standard deviation at the start that is 0 (the default) means: no state. A random
/// walk is that in the square root of a second; it needs its standard deviation. The sensor works as if the body were
/// at T_map_body E, E = (Exp(turn), shift); an observed value is the predicted one plus its offset.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_calibration {
    /// sizeof(cairn_calibration) of the caller
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
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

/// The estimate of one component of a systematic error. Layout frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_systematic_error {
    /// CAIRN_SYSTEMATIC_VELOCITY_BIAS and so on
    pub kind: cairn_systematic,
    /// the sensor whose error it is; -1: of the motion
    pub sensor: i32,
    /// counted from 0
    pub component: i32,
    /// 0
    pub reserved: i32,
    /// in the units of its kind
    pub value: f64,
    /// its standard deviation now, in the same units
    pub sigma: f64,
}

/// Options of cairn_team_create. Set them by cairn_team_options_init first.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_team_options {
    /// sizeof(cairn_team_options) of the caller
    pub struct_size: u32,
    /// CAIRN_TEAM_...; default CAIRN_TEAM_JOINT
    pub mode: cairn_team_mode,
    /// number of this vehicle; unique in the team; not CAIRN_ID_NONE; default 0
    pub vehicle: u64,
    /// vehicles of the team, this one included, 1 to 256; default 8
    pub max_vehicles: u32,
    /// 1: a second filter uses only this vehicle's data, for comparison by cairn_team_score; default 0
    pub baseline: cairn_bool,
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

/// Report of a team.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_team_report {
    /// sizeof(cairn_team_report) of the caller; set it before the call
    pub struct_size: u32,
    /// own steps that still wait for teammates
    pub unsettled: u32,
    /// 1: memory ran out while a submap was closed. The next call closes it first. Until then no further packet has its
    /// turn. Otherwise 0
    pub interrupted: cairn_bool,
    /// 0
    pub reserved: u32,
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
    /// calls of cairn_team_score
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

/// Options of cairn_world_create. Set them by cairn_world_options_init first; the defaults are Table 1 of the paper,
/// with the open choices filled in.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_world_options {
    /// sizeof(cairn_world_options) of the caller
    pub struct_size: u32,
    /// CAIRN_COURSE_...; default CAIRN_COURSE_CIRCLE
    pub course: cairn_course,
    /// seed of all random draws; default 1
    pub seed: u64,
    /// number of landmarks, 1 to 10000000; default 200 (Table 1). The length of laps and traverse follows from it
    pub landmarks: u32,
    /// CAIRN_TERRAIN_...; default CAIRN_TERRAIN_ROLLING
    pub terrain: cairn_terrain,
    /// CAIRN_CONTACT_...; default CAIRN_CONTACT_WHEELS
    pub contact: cairn_contact,
    /// CAIRN_DRIVE_...; default CAIRN_DRIVE_TWIST
    pub drive: cairn_drive,
    /// CAIRN_ACCELEROMETER_...; default CAIRN_ACCELEROMETER_VELOCITY
    pub accelerometer: cairn_accelerometer,
    /// CAIRN_STICK_...; default CAIRN_STICK_PER_OBSERVATION
    pub stick_noise: cairn_stick,
    /// 1: step 0, the known start, has a frame, too; default 0: the first frame comes one frame period later
    pub observe_at_start: cairn_bool,
    /// 1: the circles of the traverse lie on one big ring, and the drive ends with a round of the first circle; this
    /// needs at least 1600 landmarks at the default strip and area; default 0
    pub traverse_closed: cairn_bool,
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
    /// m/s^2, >= 0; default 3.71. Only CAIRN_ACCELEROMETER_ACCELERATION uses it
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
    /// noise of each elevation with CAIRN_STICK_PER_FRAME, rad, > 0; default 0.5 degrees
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
    /// d of cairn_stereo_head, m; default 0 (not in the paper)
    pub platform: [f64; 3],
    /// s of cairn_stereo_head, m; default 0 (not in the paper)
    pub stick: [f64; 3],
    /// systematic errors of the rover, which cairn_world_head and cairn_world_wheels do not tell
    /// (docs/systematic_errors.md). Added to the measured body velocity, m/s; default 0; the wheels turn faster by the
    /// first component
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

/// A motion sample: measured and true motion of the rover during `dt` seconds. Layout frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_world_motion {
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

/// A step: the motion samples since the previous step (cairn_world_motions), then one frame (cairn_world_observations).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_world_step {
    /// sizeof(cairn_world_step) of the caller; set it before the call
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// counted from 0; step 0 is the start
    pub number: u64,
    /// s, from 0
    pub time: f64,
    /// true pose of the body in the map at the end of the step
    pub truth: cairn_pose,
    /// noise of the `velocity` of each motion sample, for cairn_twist_noise. The drift of an accelerometer is stated by
    /// its size at this time, as if it were white noise
    pub velocity_sigma: [f64; 3],
    /// noise of the `rate` of each motion sample
    pub rate_sigma: [f64; 3],
    /// pan angle of the head, from its encoder, rad
    pub pan: f64,
    /// stick angle of the head, from its encoder, rad
    pub stick: f64,
    /// motion samples of the step, for cairn_world_motions; 0 at step 0
    pub motion_count: u64,
    /// observations of the frame, for cairn_world_observations
    pub observation_count: u64,
}

/// Options of cairn_fleet_create. Set them by cairn_fleet_options_init first; the defaults are the figures of the
/// paper, with the open choices filled in.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_fleet_options {
    /// sizeof(cairn_fleet_options) of the caller
    pub struct_size: u32,
    /// CAIRN_FLEET_...; default CAIRN_FLEET_UNIFORM
    pub layout: cairn_fleet_layout,
    /// seed of all random draws; default 1
    pub seed: u64,
    /// number of boats, 1 to 64; default 2 (paper)
    pub vehicles: u32,
    /// number of features, 1 to 100000; default 10 (paper: 6, 10, 40)
    pub features: u32,
    /// side of the square, m, > 0; default 10000 (paper)
    pub area: f64,
    /// distance between neighbours at the start, m, > 0, at most half of `area`; default 1500 (not in the paper). Three
    /// or more boats may be closer: see cairn_fleet_create
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
    /// paper). Only CAIRN_FLEET_COAST uses it
    pub coast_strip: f64,
}

/// Radar measurement of a feature or of a boat. Layout frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_fleet_sighting {
    /// number of the feature or of the boat; both count from 1
    pub id: u64,
    /// m, > 0: noise that would make it 0 or less is drawn again
    pub range: f64,
    /// in the frame of the boat that measures, rad
    pub bearing: f64,
}

/// A boat at the end of a step. Layout frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_fleet_vehicle {
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
    /// measured features, for cairn_fleet_seen_features
    pub feature_count: u64,
    /// measured other boats, for cairn_fleet_seen_vehicles
    pub vehicle_count: u64,
}

/// A step: all boats move, then all boats scan.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cairn_fleet_step {
    /// sizeof(cairn_fleet_step) of the caller; set it before the call
    pub struct_size: u32,
    /// 0
    pub reserved: u32,
    /// counted from 0; step 0 is a scan at the start, before any motion
    pub number: u64,
    /// s, from 0
    pub time: f64,
    /// since the step before, s: `period`, or 0 at step 0
    pub dt: f64,
    /// number of boats, for cairn_fleet_vehicles
    pub vehicle_count: u64,
}

/// Receives a pointer of the caller that the library does not use any more: the end of a callback's `user` or
/// `payload`. It runs once, in the thread of the call that ends the use. It must not call the library.
pub type cairn_release_fn = Option<unsafe extern "C" fn(
    user: *mut c_void
)>;

/// Predicts the observation of a landmark: the model of a sensor of the caller's own.
///
/// All three outputs are NaN before the call, and every value must be written, zeros too: the observation is refused if
/// one is not finite.
pub type cairn_custom_predict_fn = Option<unsafe extern "C" fn(
    user: *mut c_void,
    pose: *const cairn_pose,
    landmark: *const f64,
    z: *mut f64,
    jacobian_pose: *mut f64,
    jacobian_landmark: *mut f64
) -> i32>;

/// Computes where the landmark lies that gave `z`: the inverse of cairn_custom_predict_fn.
pub type cairn_custom_place_fn = Option<unsafe extern "C" fn(
    user: *mut c_void,
    pose: *const cairn_pose,
    z: *const f64,
    landmark: *mut f64,
    jacobian_pose: *mut f64,
    jacobian_z: *mut f64
) -> i32>;

/// Receives a line (UTF-8) of a filter's log. `payload` is the pointer that cairn_filter_set_log got.
pub type cairn_log_fn = Option<unsafe extern "C" fn(
    payload: *mut c_void,
    line: *const c_char
)>;

extern "C" {
    /// Name of a status, for example "CAIRN_ERROR_ARGUMENT"; "unknown status" for any other value. Never NULL.
    pub fn cairn_status_name(
        status: cairn_status
    ) -> *const c_char;
    /// The message of the last call of this thread that failed, for programs in C: the line that cairn_error would have
    /// got, in UTF-8. It is empty before the first failure and stays until the next failure. Never NULL. The library
    /// owns the buffer; each thread has its own. A language whose runtime moves calls between threads passes a
    /// cairn_error instead.
    pub fn cairn_last_message(
    ) -> *const c_char;
    /// Version of the loaded library, for example "0.2.0".
    pub fn cairn_version(
    ) -> *const c_char;
    /// Version of the loaded library as a number, as CAIRN_VERSION is that of the header: 10000 major + 100 minor +
    /// patch.
    pub fn cairn_version_number(
    ) -> u32;
    /// Whether the loaded library has a feature: 1 or 0. Features have names that never change their meaning: "sparse"
    /// (sparse joining), "teams", "trajectory", "systematic" (estimated systematic errors), "robust" (robust losses),
    /// "health" (verdicts), "errors" (messages in a cairn_error). NULL and any other name: 0.
    pub fn cairn_has(
        feature: *const c_char
    ) -> cairn_bool;
    /// Instruction set that the loaded library was compiled for: "x86-64" or "x86-64-v3" (on other machines:
    /// "generic").
    pub fn cairn_build(
    ) -> *const c_char;
    /// Sets a pose to the identity.
    pub fn cairn_pose_identity(
        pose: *mut cairn_pose,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Composes two poses: `T_a_c = T_a_b * T_b_c`. Quaternions are normalised; a quaternion that is zero or not finite
    /// is refused. `result` may be one of the inputs.
    pub fn cairn_pose_compose(
        T_a_b: *const cairn_pose,
        T_b_c: *const cairn_pose,
        result: *mut cairn_pose,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Inverts a pose: `T_b_a` from `T_a_b`.
    pub fn cairn_pose_inverse(
        T_a_b: *const cairn_pose,
        result: *mut cairn_pose,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Transforms a point from frame b to frame a (m).
    pub fn cairn_pose_apply(
        T_a_b: *const cairn_pose,
        point_b: *const f64,
        point_a: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Quaternion of roll, pitch and yaw (rad): `R = Rz(yaw) Ry(pitch) Rx(roll)`.
    pub fn cairn_quaternion_from_euler(
        roll: f64,
        pitch: f64,
        yaw: f64,
        quaternion: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Roll, pitch and yaw (rad) of a quaternion; pitch lies in \[-pi/2, pi/2\]. At pitch = +-pi/2 roll and yaw turn
    /// about the same axis; there roll is set to 0.
    pub fn cairn_quaternion_to_euler(
        quaternion: *const f64,
        roll: *mut f64,
        pitch: *mut f64,
        yaw: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Quaternion of a rotation vector (axis times angle, rad).
    pub fn cairn_quaternion_exp(
        rotation_vector: *const f64,
        quaternion: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Rotation vector of a quaternion (rad). Its length is at most pi.
    pub fn cairn_quaternion_log(
        quaternion: *const f64,
        rotation_vector: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Error of an estimate against the truth: `difference` gets `[dp; dtheta]` as cairn_pose defines it.
    pub fn cairn_pose_error(
        truth: *const cairn_pose,
        estimate: *const cairn_pose,
        difference: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Number of landmarks.
    pub fn cairn_map_size(
        map: *const cairn_map,
        count: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// A landmark by its id.
    pub fn cairn_map_landmark(
        map: *const cairn_map,
        id: u64,
        landmark: *mut cairn_landmark,
        error: *mut cairn_error
    ) -> cairn_status;
    /// All landmarks, by ascending id.
    pub fn cairn_map_landmarks(
        map: *const cairn_map,
        landmarks: *mut cairn_landmark,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Landmarks whose estimate lies within `radius` (m, >= 0) of `centre` (map frame, m): nearest first, ties by id.
    pub fn cairn_map_within(
        map: *const cairn_map,
        centre: *const f64,
        radius: f64,
        landmarks: *mut cairn_landmark,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// The `count` landmarks nearest to `point` (map frame, m): nearest first, ties by id. Fewer if the map holds
    /// fewer.
    pub fn cairn_map_nearest(
        map: *const cairn_map,
        point: *const f64,
        count: usize,
        landmarks: *mut cairn_landmark,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Landmarks whose estimate lies in the closed box between `lower` and `upper` (map frame, m), by ascending id.
    pub fn cairn_map_in_box(
        map: *const cairn_map,
        lower: *const f64,
        upper: *const f64,
        landmarks: *mut cairn_landmark,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Joint covariance of the positions of chosen landmarks: `matrix` is 3 count x 3 count, row-major, blocks in the
    /// order of `ids`. `capacity` and `*needed` count doubles. No id may appear twice.
    pub fn cairn_map_joint_covariance(
        map: *const cairn_map,
        ids: *const u64,
        count: usize,
        matrix: *mut f64,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Kind of a map: CAIRN_MAP_DENSE or CAIRN_MAP_SPARSE.
    pub fn cairn_map_kind(
        map: *const cairn_map,
        kind: *mut cairn_map_form,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Makes a copy of the same kind. The copy stays as it is when the filter goes on or is destroyed. All queries work
    /// on it. The caller owns the copy and frees it with cairn_map_destroy. A copy of a filter's open submap
    /// (cairn_filter_local_map) is in the frame of this submap.
    pub fn cairn_map_copy(
        map: *const cairn_map,
        copy: *mut *mut cairn_map,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Frees a copy. NULL is allowed. A map that a filter owns is not freed: it is destroyed with its filter.
    pub fn cairn_map_destroy(
        map: *mut cairn_map
    );
    /// Fills in the defaults and writes at most `struct_size` bytes.
    pub fn cairn_merge_options_init(
        options: *mut cairn_merge_options,
        struct_size: usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Merges the landmarks of `other` into `map`. `map` stays in its own frame. The merge finds the transform between
    /// both frames from the common landmarks (with has_transform also from the transform that the caller knows).
    /// Afterwards `map` holds the best estimate that follows from both maps (docs/map_merging.md). A call that fails
    /// changes neither map.
    ///
    /// Ids of `map` never change. A common landmark keeps the id that it has in `map`. An added landmark keeps its id.
    /// By geometry, an added landmark whose id is already used in `map` gets the smallest free id above all ids of both
    /// maps; if there is none, the smallest free id. cairn_map_merged_ids returns all new ids.
    ///
    /// The maps must come from independent data. Two copies of one filter's map, or a merged map and one of its parts,
    /// are refused, because the data that they share would count twice. Information of a sparse `other` about its own
    /// frame (start pose, absolute observations) is not merged. With has_transform its start pose is merged.
    ///
    /// `map` must be a copy. `other` may be a copy or a filter's map. `options` may be NULL for the defaults. `report`
    /// may be NULL; set its struct_size first. It is also filled in if the merge is refused because of the contents of
    /// the maps.
    pub fn cairn_map_merge(
        map: *mut cairn_map,
        other: *const cairn_map,
        options: *const cairn_merge_options,
        report: *mut cairn_merge_report,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Where the landmarks of the other map are after the last merge into this map, by ascending other_id; none before
    /// a merge. A copy returns the same.
    pub fn cairn_map_merged_ids(
        map: *const cairn_map,
        merged: *mut cairn_merged_id,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Fills in the defaults and writes at most `struct_size` bytes.
    pub fn cairn_wheels_init(
        wheels: *mut cairn_wheels,
        struct_size: usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Fills in the defaults and writes at most `struct_size` bytes.
    pub fn cairn_twist_noise_init(
        noise: *mut cairn_twist_noise,
        struct_size: usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// CAIRN_ID_NONE, for languages that cannot read a macro.
    pub fn cairn_id_none(
    ) -> u64;
    /// Fills in the defaults and writes at most `struct_size` bytes.
    pub fn cairn_stereo_head_init(
        head: *mut cairn_stereo_head,
        struct_size: usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Fills in the defaults and writes at most `struct_size` bytes.
    pub fn cairn_stereo_camera_init(
        camera: *mut cairn_stereo_camera,
        struct_size: usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Fills in the defaults and writes at most `struct_size` bytes.
    pub fn cairn_range_bearing_init(
        radar: *mut cairn_range_bearing,
        struct_size: usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Fills in the defaults and writes at most `struct_size` bytes.
    pub fn cairn_cartesian_init(
        cartesian: *mut cairn_cartesian,
        struct_size: usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Fills in the defaults and writes at most `struct_size` bytes.
    pub fn cairn_custom_init(
        custom: *mut cairn_custom,
        struct_size: usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Compares a custom sensor's Jacobians with central differences on the manifold, at one pose and landmark. `worst`
    /// gets the largest difference; each difference is relative to max(1, |numerical value|). A correct Jacobian gives
    /// about 1e-6 or less. If `place` is not NULL, it is checked at the observation that `predict` gives: its
    /// Jacobians, and that it returns to the landmark. `relative` is not checked. `user` is passed to both functions.
    pub fn cairn_custom_check(
        custom: *const cairn_custom,
        predict: cairn_custom_predict_fn,
        place: cairn_custom_place_fn,
        user: *mut c_void,
        pose: *const cairn_pose,
        landmark: *const f64,
        worst: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Fills in the defaults and writes at most `struct_size` bytes.
    pub fn cairn_filter_options_init(
        options: *mut cairn_filter_options,
        struct_size: usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Bytes that cairn_filter_create will take with these options. Only closings of submaps take more: workspace while
    /// they run, and with sparse joining the memory by which the map grows.
    pub fn cairn_filter_required_bytes(
        options: *const cairn_filter_options,
        bytes: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Creates a filter. The caller destroys it with cairn_filter_destroy. Options of an older or a newer header are
    /// used as far as both sides know them. On an error `*filter` is not written.
    pub fn cairn_filter_create(
        options: *const cairn_filter_options,
        filter: *mut *mut cairn_filter,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Destroys a filter and the map that it owns. NULL is allowed.
    pub fn cairn_filter_destroy(
        filter: *mut cairn_filter
    );
    /// Sets the receiver of this filter's log lines (refused batches, numerical refusals). NULL, the default: no log.
    /// The callback runs inside calls of the filter and must not call the same filter. `release` (or NULL) gets
    /// `payload` when the log is replaced or the filter is destroyed. If this call fails, `payload` stays the caller's.
    pub fn cairn_filter_set_log(
        filter: *mut cairn_filter,
        log: cairn_log_fn,
        payload: *mut c_void,
        release: cairn_release_fn,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Adds a stereo head.
    pub fn cairn_filter_add_stereo_head(
        filter: *mut cairn_filter,
        head: *const cairn_stereo_head,
        sensor: *mut i32,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Adds a stereo camera.
    pub fn cairn_filter_add_stereo_camera(
        filter: *mut cairn_filter,
        camera: *const cairn_stereo_camera,
        sensor: *mut i32,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Adds a planar range-bearing sensor (radar, lidar, sonar).
    pub fn cairn_filter_add_range_bearing(
        filter: *mut cairn_filter,
        radar: *const cairn_range_bearing,
        sensor: *mut i32,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Adds a cartesian sensor, which gives points.
    pub fn cairn_filter_add_cartesian(
        filter: *mut cairn_filter,
        cartesian: *const cairn_cartesian,
        sensor: *mut i32,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Adds a sensor of the caller's own. `predict` is required. `place` NULL: this sensor places no landmarks, it only
    /// observes landmarks that other sensors placed. It must be NULL if rows \< 3 (planar: 2), because such an
    /// observation does not determine a position. `user` is passed to both functions, which run inside
    /// cairn_filter_update. They must not call the same filter, and no exception and no longjmp may leave them.
    /// `release` (or NULL) gets `user` when the filter is destroyed. If this call fails, `user` stays the caller's.
    pub fn cairn_filter_add_custom(
        filter: *mut cairn_filter,
        custom: *const cairn_custom,
        predict: cairn_custom_predict_fn,
        place: cairn_custom_place_fn,
        user: *mut c_void,
        release: cairn_release_fn,
        sensor: *mut i32,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Sets the pan and stick angle (rad) of a stereo head from now on; both are 0 after it was added. Call this
    /// function before each frame that was taken at other angles.
    pub fn cairn_filter_point_head(
        filter: *mut cairn_filter,
        sensor: i32,
        pan: f64,
        stick: f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Sets the loss of a sensor's residuals: an observation whose distance is large gets less weight, instead of being
    /// refused. `width` (> 0) is where the loss leaves the parabola, in standard deviations of the observation's noise.
    /// The weights are found in the iteration of the update, and the covariance is that of the robust estimate
    /// (docs/update.md, "Robust losses"). The chi-square gates stay; options with gate probabilities of 1 open them.
    /// CAIRN_LOSS_NONE takes the loss away; `width` is then ignored. Allocates nothing.
    pub fn cairn_filter_set_loss(
        filter: *mut cairn_filter,
        sensor: i32,
        loss: cairn_loss,
        width: f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Sets the region in which a sensor detects every landmark: all observations between `lower` and `upper`, value by
    /// value, in the sensor's units. An infinite value is no bound. A sensor of fewer than 3 rows uses the first
    /// values. A frame has missed a landmark if its predicted observation lies inside the region by three standard
    /// deviations, and no observation of the frame was compared with the landmark (`missed_frames`).
    pub fn cairn_filter_set_view(
        filter: *mut cairn_filter,
        sensor: i32,
        lower: *const f64,
        upper: *const f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Sets the wheels for cairn_filter_predict_wheels. Until then those of cairn_wheels_init are used.
    pub fn cairn_filter_set_wheels(
        filter: *mut cairn_filter,
        wheels: *const cairn_wheels,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Sets the noise of cairn_filter_predict_twist. Until then that of cairn_twist_noise_init is used.
    pub fn cairn_filter_set_twist_noise(
        filter: *mut cairn_filter,
        noise: *const cairn_twist_noise,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Moves the vehicle by the turning rates of its left and right wheels (rad/s) over `dt` seconds (> 0). Mars paper,
    /// eq. 1 and 2.
    pub fn cairn_filter_predict_wheels(
        filter: *mut cairn_filter,
        dt: f64,
        left_rad_per_s: f64,
        right_rad_per_s: f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Moves the vehicle by the turning rates of its left and right wheels (rad/s) and the body rate of a gyro (rad/s)
    /// over `dt` seconds (> 0): the velocity is that of cairn_filter_predict_wheels, with its noise, and the rate has
    /// the noise of cairn_filter_set_twist_noise. A planar vehicle reads only the rate about z.
    pub fn cairn_filter_predict_wheels_gyro(
        filter: *mut cairn_filter,
        dt: f64,
        left_rad_per_s: f64,
        right_rad_per_s: f64,
        rate: *const f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Moves the vehicle by its body velocity (m/s) and body rate (rad/s) over `dt` seconds (> 0). Mars paper, eq. 2.
    pub fn cairn_filter_predict_twist(
        filter: *mut cairn_filter,
        dt: f64,
        velocity: *const f64,
        rate: *const f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Moves the vehicle by a relative pose, `T_map_body <- T_map_body T_before_after`, with the covariance (6x6
    /// row-major, symmetric, positive semidefinite) of its error \[dp; dtheta\] in the axes of the body before the
    /// motion. An increment has no duration: a filter that estimates a velocity or rate bias refuses it, and no random
    /// walk goes on.
    pub fn cairn_filter_predict_increment(
        filter: *mut cairn_filter,
        T_before_after: *const cairn_pose,
        covariance: *const f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Updates the filter by one frame of one sensor. The observations of known landmarks update the state together. An
    /// observation with an unknown id places a new landmark, with all its correlations. `matches` (room for `count`, or
    /// NULL) gets the match of each observation. `count` may be 0. Allocates nothing.
    pub fn cairn_filter_update(
        filter: *mut cairn_filter,
        sensor: i32,
        observations: *const cairn_observation,
        count: usize,
        matches: *mut cairn_match,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Updates the filter by an observation that the caller has linearised: `residual = z - h` (rows values),
    /// `covariance` of the noise (rows x rows), `jacobian_pose` = dh/\[dp; dtheta\] (rows x 6, NULL for zero) and
    /// `jacobian_landmarks` = dh/d positions (rows x 3 count, columns in the order of `landmarks`); all row-major. With
    /// submaps, pose and landmarks are those of the open submap, in its frame. The observation is gated as one of that
    /// many rows (gate_probability) and is not iterated. `match` (or NULL) gets the match; its landmark is the first
    /// one, or CAIRN_ID_NONE. rows is 1 to 3 max_observations (planar: 2), count at most max_observations.
    pub fn cairn_filter_update_linear(
        filter: *mut cairn_filter,
        residual: *const f64,
        rows: usize,
        covariance: *const f64,
        jacobian_pose: *const f64,
        landmarks: *const u64,
        count: usize,
        jacobian_landmarks: *const f64,
        r#match: *mut cairn_match,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Updates the filter by an absolute position (GNSS): `z = p + R lever_arm` in the map frame, m; 3x3 `covariance`,
    /// positive definite. `lever_arm` (body frame, m) may be NULL: zero. `match` (or NULL) gets the match.
    pub fn cairn_filter_update_position(
        filter: *mut cairn_filter,
        position: *const f64,
        covariance: *const f64,
        lever_arm: *const f64,
        r#match: *mut cairn_match,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Updates the filter by an absolute attitude (star tracker): quaternion w x y z from body to map; 3x3 `covariance`
    /// (rad^2, positive definite) of its error dtheta in the map's axes. `match` (or NULL) gets the match.
    pub fn cairn_filter_update_attitude(
        filter: *mut cairn_filter,
        quaternion: *const f64,
        covariance: *const f64,
        r#match: *mut cairn_match,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Updates the filter by an absolute heading (sun sensor, compass): the yaw of the body's x axis in the map, rad,
    /// with its standard deviation (> 0). A tilted body adds noise of second order (docs/sensors.md). The heading is
    /// refused (CAIRN_REASON_NO_IMAGE) if the x axis is within three standard deviations of the tilt of the vertical.
    /// `match` (or NULL) gets the match.
    pub fn cairn_filter_update_heading(
        filter: *mut cairn_filter,
        heading: f64,
        sigma: f64,
        r#match: *mut cairn_match,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Removes a landmark from the map and from the open submap. The information that it gave about other states stays.
    pub fn cairn_filter_remove_landmark(
        filter: *mut cairn_filter,
        id: u64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Merges two landmarks of the open submap, or of the single map, that are in truth one. The filter observes that
    /// their difference is zero; this observation is gated like any other (gate_probability). If it passes, `other` is
    /// removed, and `id` stays with the observations of both. `match` (or NULL) gets the match.
    pub fn cairn_filter_merge_landmarks(
        filter: *mut cairn_filter,
        id: u64,
        other: u64,
        r#match: *mut cairn_match,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Splits a landmark that is in truth two landmarks. The new landmark `fresh` gets the position of `id` plus an
    /// independent error with this 3x3 covariance (positive definite; it says how far apart the two may be). Later
    /// observations separate the two.
    pub fn cairn_filter_split_landmark(
        filter: *mut cairn_filter,
        id: u64,
        fresh: u64,
        covariance: *const f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Closes the open submap now. Allocates. A call that fails leaves the filter as it was, with the submap open.
    pub fn cairn_filter_close_submap(
        filter: *mut cairn_filter,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Reports on the last attempt to close a submap; zeros before the first attempt. Set `report->struct_size` first.
    pub fn cairn_filter_last_closing(
        filter: *const cairn_filter,
        report: *mut cairn_closing_report,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Pose of the body in the open submap, and the covariance of its error \[dp; dtheta\] (6x6 row-major); each may be
    /// NULL. With a single map: in the map.
    pub fn cairn_filter_local_pose(
        filter: *const cairn_filter,
        pose: *mut cairn_pose,
        covariance: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Pose of the open submap's origin in the map, and the covariance of its error \[dp; dtheta\] (6x6 row-major);
    /// each may be NULL. That is what the closed submaps tell: landmarks that the open submap sees again, and fixes in
    /// it, correct cairn_filter_pose at once and the origin at the closing. With a single map: identity and zero.
    pub fn cairn_filter_base_pose(
        filter: *const cairn_filter,
        pose: *mut cairn_pose,
        covariance: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Number of submaps closed so far.
    pub fn cairn_filter_submap_count(
        filter: *const cairn_filter,
        count: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// A closed submap, counted from 0: the pose of its origin in the map as known now (dense: as known at its
    /// closing), and the ids of its landmarks in the order in which they were placed. Of a submap that a sparse map has
    /// fused with others of its place they are the ids of this place. `base` may be NULL. Capacity 0 asks for the
    /// number of ids.
    pub fn cairn_filter_submap(
        filter: *const cairn_filter,
        index: usize,
        base: *mut cairn_pose,
        ids: *mut u64,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Reports on the last successful update of any kind; zeros before the first update. Set `report->struct_size`
    /// first.
    pub fn cairn_filter_last_update(
        filter: *const cairn_filter,
        report: *mut cairn_update_report,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Pose of the body in the map, and the covariance of its error \[dp; dtheta\] (6x6 row-major); each may be NULL.
    /// With submaps the pose knows what the open submap has seen again of the map, before the submap is closed.
    pub fn cairn_filter_pose(
        filter: *const cairn_filter,
        pose: *mut cairn_pose,
        covariance: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Joint covariance of the pose's error \[dp; dtheta\] and the positions of chosen landmarks, in this order,
    /// row-major, with 6 + 3 count rows and columns. `capacity` and `*needed` count doubles; capacity 0 asks for the
    /// size.
    pub fn cairn_filter_joint_covariance(
        filter: *const cairn_filter,
        ids: *const u64,
        count: usize,
        matrix: *mut f64,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// The landmarks of the open submap, in its frame; with a single map the same as cairn_filter_map. The filter owns
    /// this map; it lives as long as the filter and follows it. Fails only for NULL, and then returns NULL.
    pub fn cairn_filter_local_map(
        filter: *const cairn_filter
    ) -> *const cairn_map;
    /// The filter's map. With submaps it holds the landmarks of the closed submaps; the landmarks of the open submap
    /// join it when this submap is closed. The filter owns this map; it lives as long as the filter and follows it.
    /// Fails only for NULL, and then returns NULL.
    pub fn cairn_filter_map(
        filter: *const cairn_filter
    ) -> *const cairn_map;
    /// Normalised estimation error squared (NEES) of the pose against the true pose, in the error coordinates of the
    /// filter. A consistent filter has 6 on average, for a planar vehicle 3.
    pub fn cairn_filter_pose_nees(
        filter: *const cairn_filter,
        truth: *const cairn_pose,
        nees: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Checks the whole covariance (with submaps, that of the open submap): `min_pivot` gets the smallest pivot of its
    /// Cholesky factor after scaling to unit diagonal. It is 0 or less if the covariance is not positive definite.
    /// States that are known exactly (zero variance) are left out.
    pub fn cairn_filter_audit(
        filter: *mut cairn_filter,
        min_pivot: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// The verdict on a filter. Set `health->struct_size` first. All of it is what the last update left: the call
    /// computes nothing.
    pub fn cairn_filter_health(
        filter: *const cairn_filter,
        health: *mut cairn_health,
        error: *mut cairn_error
    ) -> cairn_status;
    /// What the observations of one sensor show. Set `health->struct_size` first.
    pub fn cairn_filter_sensor_health(
        filter: *const cairn_filter,
        sensor: i32,
        health: *mut cairn_sensor_health,
        error: *mut cairn_error
    ) -> cairn_status;
    /// A verdict in one word: "good", "doubtful" or "lost"; "unknown" for any other value.
    pub fn cairn_verdict_text(
        verdict: cairn_verdict
    ) -> *const c_char;
    /// A reason in words, for example "single landmarks contradict the rest". `reason` is one bit; anything else gives
    /// "unknown".
    pub fn cairn_doubt_text(
        reason: cairn_doubts
    ) -> *const c_char;
    /// Fills in the defaults: no errors.
    pub fn cairn_calibration_init(
        calibration: *mut cairn_calibration,
        struct_size: usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Makes systematic errors of a sensor states of the filter. Call it after the sensor was added, before the first
    /// motion and the first observation, at most once for a sensor. All sensors together have at most max_sensor_errors
    /// of cairn_filter_options. Association (with unknown ids) uses the estimates, but leaves their uncertainty out of
    /// its gates.
    pub fn cairn_filter_calibrate_sensor(
        filter: *mut cairn_filter,
        sensor: i32,
        calibration: *const cairn_calibration,
        error: *mut cairn_error
    ) -> cairn_status;
    /// The estimates of all components that are states, those of the motion first, then sensor by sensor in the order
    /// of their calibration, each in the order of kinds and components. `*needed` is their number. `errors` has room
    /// for `capacity` of them, and `covariance` (NULL: not wanted) for the square of that number: the joint covariance
    /// of the `*needed` components, row-major. Capacity 0 asks for the number.
    pub fn cairn_filter_systematic_errors(
        filter: *const cairn_filter,
        errors: *mut cairn_systematic_error,
        covariance: *mut f64,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Fills in the defaults and writes at most `struct_size` bytes.
    pub fn cairn_team_options_init(
        options: *mut cairn_team_options,
        struct_size: usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Creates a vehicle's view of its team. The caller destroys it with cairn_team_destroy. `filter` holds the options
    /// of the filter that the team runs: `vehicle` must be CAIRN_VEHICLE_PLANAR, `initial_pose` is the start of this
    /// vehicle in the frame of the team, and `submap_landmarks` must be greater than 0 in mode CAIRN_TEAM_SUBMAPS and 0
    /// in all other modes. `radar` is the sensor of all vehicles. With extended observations it must be mounted at the
    /// body's origin. On an error `*team` is not written.
    pub fn cairn_team_create(
        options: *const cairn_team_options,
        filter: *const cairn_filter_options,
        radar: *const cairn_range_bearing,
        team: *mut *mut cairn_team,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Destroys a team and the map that it owns. NULL is allowed.
    pub fn cairn_team_destroy(
        team: *mut cairn_team
    );
    /// Adds a teammate. `start` is its pose before its first packet, and `covariance` (6x6; NULL: known exactly) the
    /// covariance of the error of `start`. Both must be the values that the teammate itself starts with. `start` NULL:
    /// the start is unknown. It is solved from the first mutual sighting, at one time, between the teammate and a
    /// vehicle whose pose is known. Modes with extended observations need no start.
    pub fn cairn_team_add(
        team: *mut cairn_team,
        vehicle: u64,
        start: *const cairn_pose,
        covariance: *const f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Removes a teammate: the team neither waits for it nor uses its packets any more. The information from its
    /// earlier packets stays.
    pub fn cairn_team_remove(
        team: *mut cairn_team,
        vehicle: u64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Numbers of the vehicles of the team, this vehicle's number first. Capacity 0 asks for how many there are.
    pub fn cairn_team_members(
        team: *const cairn_team,
        vehicles: *mut u64,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Moves this vehicle by a relative pose, like cairn_filter_predict_increment. The teammates learn of this motion
    /// by the packet of the next cairn_team_observe.
    pub fn cairn_team_predict_increment(
        team: *mut cairn_team,
        T_before_after: *const cairn_pose,
        covariance: *const f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Moves this vehicle by its body velocity (m/s) and body rate (rad/s) over `dt` seconds (> 0). `noise` NULL: that
    /// of cairn_twist_noise_init.
    pub fn cairn_team_predict_twist(
        team: *mut cairn_team,
        dt: f64,
        velocity: *const f64,
        rate: *const f64,
        noise: *const cairn_twist_noise,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Ends a step of this vehicle at `time` with its scan. `time` is in s, by a clock that all vehicles share, and
    /// must be later than the last one. The scan is ranges and bearings of `landmarks`, by their ids, and of
    /// `vehicles`, by their numbers; both may be empty. Motion and scan become a packet for cairn_team_take_packet. The
    /// filter is updated by the step when the packets of all teammates up to this time have arrived; the order is the
    /// same at every vehicle. If the update by this vehicle's scan fails, the call fails, but the packet is sent all
    /// the same. A time that is more than `max_jump` after the last one is refused, and the motions are kept for the
    /// next call. If the next call has a later time, by at most `max_jump`, both were right, and it succeeds.
    pub fn cairn_team_observe(
        team: *mut cairn_team,
        time: f64,
        landmarks: *const cairn_observation,
        landmark_count: usize,
        vehicles: *const cairn_observation,
        vehicle_count: usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Matches of the last scan of this vehicle that updated the filter: those of landmarks, then those of vehicles, by
    /// their ids, in the order in which they were processed. Capacity 0 asks for how many there are.
    pub fn cairn_team_decisions(
        team: *const cairn_team,
        matches: *mut cairn_match,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Leaves the team: makes a last packet, the farewell, after which the teammates do not wait for this vehicle any
    /// more. Own steps are then refused. Packets of teammates are still used.
    pub fn cairn_team_leave(
        team: *mut cairn_team,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Takes the next packet that is to be sent to all teammates: a step of this vehicle, a repetition that a teammate
    /// asked for, or a request for missing packets. `*needed` gets its size in bytes, 0 if there is no packet. The
    /// packet leaves the queue when it was copied. Own steps wait until they are taken. A packet that was asked for
    /// waits once, however often it was asked for, and so does the request to each teammate: beside own steps the queue
    /// holds at most `history` repetitions and `max_vehicles` requests. Capacity 0 asks for its size.
    pub fn cairn_team_take_packet(
        team: *mut cairn_team,
        packet: *mut u8,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Asks the teammates for all missing packets. The team does so itself when it finds a gap at a step of this
    /// vehicle; call this function at the end of a mission or after a long silence.
    pub fn cairn_team_ask(
        team: *mut cairn_team,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Receives a packet of a teammate. Packets may come late, repeatedly and in any order. `result` (or NULL) gets one
    /// of the CAIRN_PACKET_ constants. A refused packet is counted and changes nothing; the call succeeds all the same.
    pub fn cairn_team_receive(
        team: *mut cairn_team,
        packet: *const u8,
        size: usize,
        result: *mut cairn_packet,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Pose of a vehicle of the team, and the covariance of its error \[dp; dtheta\] (6x6 row-major); each may be NULL.
    /// The own pose is the present one: it includes the motions of own steps that still wait for teammates, but not
    /// their scans. The pose of a teammate is that of its last packet that is part of the estimate; only the modes
    /// CAIRN_TEAM_JOINT and CAIRN_TEAM_SUBMAPS have it.
    pub fn cairn_team_pose(
        team: *const cairn_team,
        vehicle: u64,
        pose: *mut cairn_pose,
        covariance: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Normalised estimation error squared (NEES) of this vehicle's pose against the true pose, in the error
    /// coordinates of the filter. The pose is the one that cairn_team_pose returns. A consistent filter has 3 on
    /// average. On an error `*nees` is not written.
    pub fn cairn_team_pose_nees(
        team: *const cairn_team,
        truth: *const cairn_pose,
        nees: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// The team's map. The team owns this map; it lives as long as the team and follows it. Fails only for NULL, and
    /// then returns NULL.
    pub fn cairn_team_map(
        team: *const cairn_team
    ) -> *const cairn_map;
    /// Compares the present pose of this vehicle with the true pose. With the option `baseline` it compares the pose of
    /// the second filter, too. cairn_team_last_report returns the means.
    pub fn cairn_team_score(
        team: *mut cairn_team,
        truth: *const cairn_pose,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Reports on the team so far. Set `report->struct_size` first.
    pub fn cairn_team_last_report(
        team: *const cairn_team,
        report: *mut cairn_team_report,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Keeps the pose of the body now, as an update does: for a step in which nothing was observed. `number` (or NULL)
    /// gets the number of the pose.
    pub fn cairn_filter_keep_pose(
        filter: *mut cairn_filter,
        number: *mut u64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// The numbers of the poses that are kept: from `*first` up to but not including `*end`. `*end` is the number of
    /// poses so far. Each may be NULL.
    pub fn cairn_filter_trajectory_range(
        filter: *const cairn_filter,
        first: *mut u64,
        end: *mut u64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// The poses of the body in the map, as they are known now, from the number `first` to the newest one. `capacity`
    /// and `*needed` count poses; capacity 0 asks for the number of poses. Close the open submap first to have its last
    /// corrections.
    pub fn cairn_filter_trajectory(
        filter: *const cairn_filter,
        first: u64,
        poses: *mut cairn_pose,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
}

#[cfg(feature = "sim")]
extern "C" {
    /// Fills in the defaults and writes at most `struct_size` bytes.
    pub fn cairn_world_options_init(
        options: *mut cairn_world_options,
        struct_size: usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Sets all options except `struct_size` and `seed` to those of a preset. `submap_landmarks` (or NULL) gets the
    /// size of submaps that belongs to the preset: 40, or 20 for rows 3 and 4. Set `options->struct_size` first.
    pub fn cairn_world_options_preset(
        options: *mut cairn_world_options,
        preset: cairn_preset,
        submap_landmarks: *mut u32,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Creates a world before its first step. The caller destroys it with cairn_world_destroy. Options of an older or a
    /// newer header are used as far as both sides know them. On an error `*world` is not written.
    pub fn cairn_world_create(
        options: *const cairn_world_options,
        world: *mut *mut cairn_world,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Destroys a world. NULL is allowed.
    pub fn cairn_world_destroy(
        world: *mut cairn_world
    );
    /// Returns the next step. Set `step->struct_size` first. Nothing is stored, so memory does not grow with the drive.
    pub fn cairn_world_next(
        world: *mut cairn_world,
        step: *mut cairn_world_step,
        error: *mut cairn_error
    ) -> cairn_status;
    /// The motion samples of the last step, in order; none before the first step. Capacity 0 asks for their number.
    pub fn cairn_world_motions(
        world: *const cairn_world,
        motions: *mut cairn_world_motion,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// The observations of the last step's frame, by ascending id, z as cairn_stereo_head defines it, covariance zero;
    /// none before the first step. Capacity 0 asks for their number.
    pub fn cairn_world_observations(
        world: *const cairn_world,
        observations: *mut cairn_observation,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Goes back to before the first step. The same drive follows, bit for bit.
    pub fn cairn_world_rewind(
        world: *mut cairn_world,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Number of steps, including the start.
    pub fn cairn_world_steps(
        world: *const cairn_world,
        steps: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Upper bound of the number of observations in a frame, for cairn_filter_options.
    pub fn cairn_world_most_observations(
        world: *const cairn_world,
        count: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// The stereo head of the world, to be added to a filter: mount, noise, encoder mode. Set `head->struct_size`
    /// first.
    pub fn cairn_world_head(
        world: *const cairn_world,
        head: *mut cairn_stereo_head,
        error: *mut cairn_error
    ) -> cairn_status;
    /// The wheels of the rover, for cairn_filter_set_wheels, with the noise of the wheel rates of one motion sample.
    /// Set `wheels->struct_size` first. The noise of rates that wheels do not measure is that of cairn_wheels_init.
    pub fn cairn_world_wheels(
        world: *const cairn_world,
        wheels: *mut cairn_wheels,
        error: *mut cairn_error
    ) -> cairn_status;
    /// True pose of the body in the map at `time` (s, 0 to the end of the drive). The origin of the body lies on the
    /// ground in the middle between the wheels.
    pub fn cairn_world_pose(
        world: *const cairn_world,
        time: f64,
        pose: *mut cairn_pose,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Points at which the wheels touch the ground at `time`: front left, front right, rear left, rear right, x y z
    /// each, in the map, m.
    pub fn cairn_world_contacts(
        world: *const cairn_world,
        time: f64,
        points: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Height of the ground at x, y (m), m.
    pub fn cairn_world_height(
        world: *const cairn_world,
        x: f64,
        y: f64,
        height: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// The rectangle in the xy plane that contains the course and all landmarks, m.
    pub fn cairn_world_extent(
        world: *const cairn_world,
        lower: *mut f64,
        upper: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// True position (m) of the landmark `id`, 0 to the number of landmarks minus 1.
    pub fn cairn_world_landmark(
        world: *const cairn_world,
        id: u64,
        position: *mut f64,
        error: *mut cairn_error
    ) -> cairn_status;
    /// True positions of all landmarks, x y z each, m, by ascending id. `capacity` and `*needed` count landmarks;
    /// capacity 0 asks for their number.
    pub fn cairn_world_landmarks(
        world: *const cairn_world,
        positions: *mut f64,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// One line about the last call of this library that failed in this thread, like cairn_last_message for libcairn.
    pub fn cairn_sim_last_message(
    ) -> *const c_char;
    /// Fills in the defaults and writes at most `struct_size` bytes.
    pub fn cairn_fleet_options_init(
        options: *mut cairn_fleet_options,
        struct_size: usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Creates a fleet before its first step. The caller destroys it with cairn_fleet_destroy. Options of an older or a
    /// newer header are used as far as both sides know them. On an error `*fleet` is not written.
    ///
    /// Each boat is commanded once around a circle of radius R = course_length / (2 pi), anticlockwise, at the constant
    /// speed course_length / duration and rate 2 pi / duration. It starts at the southernmost point of the circle,
    /// heading east. The centres of the circles are `separation` apart. The centre of a single boat is the origin. The
    /// centres of two boats are (-separation / 2, 0) and (separation / 2, 0). The centres of more boats form a square
    /// grid about the origin, with as many columns as rows or one more. They are numbered from west to east and row by
    /// row from the south; a last row that is not full is centred. A grid wider than half of `area` is shrunk to that.
    /// With CAIRN_FLEET_COAST all circles must lie south of the coast line.
    pub fn cairn_fleet_create(
        options: *const cairn_fleet_options,
        fleet: *mut *mut cairn_fleet,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Destroys a fleet. NULL is allowed.
    pub fn cairn_fleet_destroy(
        fleet: *mut cairn_fleet
    );
    /// Returns the next step. Set `step->struct_size` first. During a period each boat keeps its executed speed and
    /// rate, and its true pose is their exact integral. Then each boat measures all features and all other boats within
    /// `radar_range` (true distance, not 0). Each measurement has its own noise: two boats that see each other have
    /// independent errors. Nothing is stored, so memory does not grow with the drive.
    pub fn cairn_fleet_next(
        fleet: *mut cairn_fleet,
        step: *mut cairn_fleet_step,
        error: *mut cairn_error
    ) -> cairn_status;
    /// The boats at the end of the last step, boat 1 first; none before the first step. Capacity 0 asks for their
    /// number.
    pub fn cairn_fleet_vehicles(
        fleet: *const cairn_fleet,
        vehicles: *mut cairn_fleet_vehicle,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// The features that boat `vehicle` (counted from 1) measured in the last step, by ascending id; none before the
    /// first step. Capacity 0 asks for their number.
    pub fn cairn_fleet_seen_features(
        fleet: *const cairn_fleet,
        vehicle: u64,
        features: *mut cairn_fleet_sighting,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// The other boats that boat `vehicle` (counted from 1) measured in the last step, by ascending id; none before the
    /// first step. Capacity 0 asks for their number.
    pub fn cairn_fleet_seen_vehicles(
        fleet: *const cairn_fleet,
        vehicle: u64,
        vehicles: *mut cairn_fleet_sighting,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Goes back to before the first step. The same steps follow, bit for bit.
    pub fn cairn_fleet_rewind(
        fleet: *mut cairn_fleet,
        error: *mut cairn_error
    ) -> cairn_status;
    /// Number of steps: 1 plus the number of whole periods in the duration.
    pub fn cairn_fleet_steps(
        fleet: *const cairn_fleet,
        steps: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// True positions of all features, x y each, m; the feature with id 1 is the first. `capacity` and `*needed` count
    /// features; capacity 0 asks for their number.
    pub fn cairn_fleet_features(
        fleet: *const cairn_fleet,
        positions: *mut f64,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
    /// The coast line from west to east: a polyline, x y each, m. The land is north of it. `capacity` and `*needed`
    /// count points; capacity 0 asks for their number.
    pub fn cairn_fleet_coast(
        fleet: *const cairn_fleet,
        points: *mut f64,
        capacity: usize,
        needed: *mut usize,
        error: *mut cairn_error
    ) -> cairn_status;
}

#[cfg(test)]
mod layout {
    use super::*;
    use std::mem::{align_of, size_of, MaybeUninit};
    use std::ptr::addr_of;

    #[test]
    fn cairn_error_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_error>(), 512);
        assert_eq!(align_of::<cairn_error>(), 4);
        let memory = MaybeUninit::<cairn_error>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).status) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).message) } as usize - start as usize, 8);
    }

    #[test]
    fn cairn_pose_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_pose>(), 56);
        assert_eq!(align_of::<cairn_pose>(), 8);
        let memory = MaybeUninit::<cairn_pose>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).position) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).quaternion) } as usize - start as usize, 24);
    }

    #[test]
    fn cairn_landmark_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_landmark>(), 112);
        assert_eq!(align_of::<cairn_landmark>(), 8);
        let memory = MaybeUninit::<cairn_landmark>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).id) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).observations) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).position) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).covariance) } as usize - start as usize, 40);
    }

    #[test]
    fn cairn_merge_options_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_merge_options>(), 392);
        assert_eq!(align_of::<cairn_merge_options>(), 8);
        let memory = MaybeUninit::<cairn_merge_options>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).association) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).gate_probability) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).joint_gate_probability) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).max_landmarks) } as usize - start as usize, 24);
        assert_eq!(unsafe { addr_of!((*start).max_tilt) } as usize - start as usize, 32);
        assert_eq!(unsafe { addr_of!((*start).has_transform) } as usize - start as usize, 40);
        assert_eq!(unsafe { addr_of!((*start).reserved) } as usize - start as usize, 44);
        assert_eq!(unsafe { addr_of!((*start).T_map_other) } as usize - start as usize, 48);
        assert_eq!(unsafe { addr_of!((*start).covariance) } as usize - start as usize, 104);
    }

    #[test]
    fn cairn_merge_report_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_merge_report>(), 408);
        assert_eq!(align_of::<cairn_merge_report>(), 8);
        let memory = MaybeUninit::<cairn_merge_report>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).association) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).common) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).added) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).rows) } as usize - start as usize, 24);
        assert_eq!(unsafe { addr_of!((*start).distance) } as usize - start as usize, 32);
        assert_eq!(unsafe { addr_of!((*start).threshold) } as usize - start as usize, 40);
        assert_eq!(unsafe { addr_of!((*start).T_map_other) } as usize - start as usize, 48);
        assert_eq!(unsafe { addr_of!((*start).covariance) } as usize - start as usize, 104);
        assert_eq!(unsafe { addr_of!((*start).broken_id) } as usize - start as usize, 392);
        assert_eq!(unsafe { addr_of!((*start).broken_other_id) } as usize - start as usize, 400);
    }

    #[test]
    fn cairn_merged_id_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_merged_id>(), 24);
        assert_eq!(align_of::<cairn_merged_id>(), 8);
        let memory = MaybeUninit::<cairn_merged_id>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).other_id) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).id) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).common) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).reserved) } as usize - start as usize, 20);
    }

    #[test]
    fn cairn_wheels_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_wheels>(), 72);
        assert_eq!(align_of::<cairn_wheels>(), 8);
        let memory = MaybeUninit::<cairn_wheels>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).yaw_sign) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).radius) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).track) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).rate_sigma) } as usize - start as usize, 24);
        assert_eq!(unsafe { addr_of!((*start).slip_sigma) } as usize - start as usize, 32);
        assert_eq!(unsafe { addr_of!((*start).lateral_sigma) } as usize - start as usize, 40);
        assert_eq!(unsafe { addr_of!((*start).vertical_sigma) } as usize - start as usize, 48);
        assert_eq!(unsafe { addr_of!((*start).roll_rate_sigma) } as usize - start as usize, 56);
        assert_eq!(unsafe { addr_of!((*start).pitch_rate_sigma) } as usize - start as usize, 64);
    }

    #[test]
    fn cairn_twist_noise_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_twist_noise>(), 56);
        assert_eq!(align_of::<cairn_twist_noise>(), 8);
        let memory = MaybeUninit::<cairn_twist_noise>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).reserved) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).velocity_sigma) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).rate_sigma) } as usize - start as usize, 32);
    }

    #[test]
    fn cairn_stereo_head_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_stereo_head>(), 144);
        assert_eq!(align_of::<cairn_stereo_head>(), 8);
        let memory = MaybeUninit::<cairn_stereo_head>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).encoder_mode) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).platform) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).stick) } as usize - start as usize, 32);
        assert_eq!(unsafe { addr_of!((*start).camera_quaternion) } as usize - start as usize, 56);
        assert_eq!(unsafe { addr_of!((*start).range_sigma) } as usize - start as usize, 88);
        assert_eq!(unsafe { addr_of!((*start).azimuth_sigma) } as usize - start as usize, 96);
        assert_eq!(unsafe { addr_of!((*start).elevation_sigma) } as usize - start as usize, 104);
        assert_eq!(unsafe { addr_of!((*start).pan_sigma) } as usize - start as usize, 112);
        assert_eq!(unsafe { addr_of!((*start).stick_sigma) } as usize - start as usize, 120);
        assert_eq!(unsafe { addr_of!((*start).near_range) } as usize - start as usize, 128);
        assert_eq!(unsafe { addr_of!((*start).max_elevation) } as usize - start as usize, 136);
    }

    #[test]
    fn cairn_stereo_camera_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_stereo_camera>(), 152);
        assert_eq!(align_of::<cairn_stereo_camera>(), 8);
        let memory = MaybeUninit::<cairn_stereo_camera>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).reserved) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).fu) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).fv) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).cu) } as usize - start as usize, 24);
        assert_eq!(unsafe { addr_of!((*start).cv) } as usize - start as usize, 32);
        assert_eq!(unsafe { addr_of!((*start).baseline) } as usize - start as usize, 40);
        assert_eq!(unsafe { addr_of!((*start).T_body_camera) } as usize - start as usize, 48);
        assert_eq!(unsafe { addr_of!((*start).sigma) } as usize - start as usize, 104);
        assert_eq!(unsafe { addr_of!((*start).near_depth) } as usize - start as usize, 128);
        assert_eq!(unsafe { addr_of!((*start).min_disparity) } as usize - start as usize, 136);
        assert_eq!(unsafe { addr_of!((*start).min_disparity_sigmas) } as usize - start as usize, 144);
    }

    #[test]
    fn cairn_range_bearing_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_range_bearing>(), 88);
        assert_eq!(align_of::<cairn_range_bearing>(), 8);
        let memory = MaybeUninit::<cairn_range_bearing>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).reserved) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).T_body_sensor) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).range_sigma) } as usize - start as usize, 64);
        assert_eq!(unsafe { addr_of!((*start).bearing_sigma) } as usize - start as usize, 72);
        assert_eq!(unsafe { addr_of!((*start).near_range) } as usize - start as usize, 80);
    }

    #[test]
    fn cairn_cartesian_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_cartesian>(), 88);
        assert_eq!(align_of::<cairn_cartesian>(), 8);
        let memory = MaybeUninit::<cairn_cartesian>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).reserved) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).T_body_sensor) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).sigma) } as usize - start as usize, 64);
    }

    #[test]
    fn cairn_custom_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_custom>(), 40);
        assert_eq!(align_of::<cairn_custom>(), 8);
        let memory = MaybeUninit::<cairn_custom>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).rows) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).angle_mask) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).relative) } as usize - start as usize, 12);
        assert_eq!(unsafe { addr_of!((*start).sigma) } as usize - start as usize, 16);
    }

    #[test]
    fn cairn_observation_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_observation>(), 104);
        assert_eq!(align_of::<cairn_observation>(), 8);
        let memory = MaybeUninit::<cairn_observation>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).id) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).z) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).covariance) } as usize - start as usize, 32);
    }

    #[test]
    fn cairn_match_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_match>(), 32);
        assert_eq!(align_of::<cairn_match>(), 8);
        let memory = MaybeUninit::<cairn_match>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).landmark) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).result) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).reason) } as usize - start as usize, 12);
        assert_eq!(unsafe { addr_of!((*start).distance) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).threshold) } as usize - start as usize, 24);
    }

    #[test]
    fn cairn_filter_options_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_filter_options>(), 624);
        assert_eq!(align_of::<cairn_filter_options>(), 8);
        let memory = MaybeUninit::<cairn_filter_options>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).vehicle) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).state_error) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).max_landmarks) } as usize - start as usize, 12);
        assert_eq!(unsafe { addr_of!((*start).max_observations) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).max_sensors) } as usize - start as usize, 20);
        assert_eq!(unsafe { addr_of!((*start).initial_pose) } as usize - start as usize, 24);
        assert_eq!(unsafe { addr_of!((*start).initial_covariance) } as usize - start as usize, 80);
        assert_eq!(unsafe { addr_of!((*start).iterations) } as usize - start as usize, 368);
        assert_eq!(unsafe { addr_of!((*start).noise_learning) } as usize - start as usize, 372);
        assert_eq!(unsafe { addr_of!((*start).iteration_tolerance) } as usize - start as usize, 376);
        assert_eq!(unsafe { addr_of!((*start).gate_probability) } as usize - start as usize, 384);
        assert_eq!(unsafe { addr_of!((*start).batch_gate_probability) } as usize - start as usize, 392);
        assert_eq!(unsafe { addr_of!((*start).error_persistence) } as usize - start as usize, 400);
        assert_eq!(unsafe { addr_of!((*start).association) } as usize - start as usize, 408);
        assert_eq!(unsafe { addr_of!((*start).association_distance) } as usize - start as usize, 412);
        assert_eq!(unsafe { addr_of!((*start).association_nodes) } as usize - start as usize, 416);
        assert_eq!(unsafe { addr_of!((*start).deferred_sightings) } as usize - start as usize, 420);
        assert_eq!(unsafe { addr_of!((*start).deferred_frames) } as usize - start as usize, 424);
        assert_eq!(unsafe { addr_of!((*start).missed_frames) } as usize - start as usize, 428);
        assert_eq!(unsafe { addr_of!((*start).new_probability) } as usize - start as usize, 432);
        assert_eq!(unsafe { addr_of!((*start).submap_landmarks) } as usize - start as usize, 440);
        assert_eq!(unsafe { addr_of!((*start).join) } as usize - start as usize, 444);
        assert_eq!(unsafe { addr_of!((*start).join_loss) } as usize - start as usize, 448);
        assert_eq!(unsafe { addr_of!((*start).trajectory_poses) } as usize - start as usize, 452);
        assert_eq!(unsafe { addr_of!((*start).join_loss_width) } as usize - start as usize, 456);
        assert_eq!(unsafe { addr_of!((*start).submap_distance) } as usize - start as usize, 464);
        assert_eq!(unsafe { addr_of!((*start).submap_extent) } as usize - start as usize, 472);
        assert_eq!(unsafe { addr_of!((*start).submap_sigma) } as usize - start as usize, 480);
        assert_eq!(unsafe { addr_of!((*start).velocity_bias_sigma) } as usize - start as usize, 488);
        assert_eq!(unsafe { addr_of!((*start).velocity_bias_walk) } as usize - start as usize, 512);
        assert_eq!(unsafe { addr_of!((*start).rate_bias_sigma) } as usize - start as usize, 536);
        assert_eq!(unsafe { addr_of!((*start).rate_bias_walk) } as usize - start as usize, 560);
        assert_eq!(unsafe { addr_of!((*start).wheel_scale_sigma) } as usize - start as usize, 584);
        assert_eq!(unsafe { addr_of!((*start).wheel_scale_walk) } as usize - start as usize, 600);
        assert_eq!(unsafe { addr_of!((*start).max_sensor_errors) } as usize - start as usize, 616);
        assert_eq!(unsafe { addr_of!((*start).reserved) } as usize - start as usize, 620);
    }

    #[test]
    fn cairn_closing_report_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_closing_report>(), 120);
        assert_eq!(align_of::<cairn_closing_report>(), 8);
        let memory = MaybeUninit::<cairn_closing_report>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).status) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).reason) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).submaps) } as usize - start as usize, 12);
        assert_eq!(unsafe { addr_of!((*start).landmarks) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).landmarks_new) } as usize - start as usize, 20);
        assert_eq!(unsafe { addr_of!((*start).landmarks_fused) } as usize - start as usize, 24);
        assert_eq!(unsafe { addr_of!((*start).landmarks_refused) } as usize - start as usize, 28);
        assert_eq!(unsafe { addr_of!((*start).landmarks_ambiguous) } as usize - start as usize, 32);
        assert_eq!(unsafe { addr_of!((*start).rows) } as usize - start as usize, 36);
        assert_eq!(unsafe { addr_of!((*start).distance) } as usize - start as usize, 40);
        assert_eq!(unsafe { addr_of!((*start).threshold) } as usize - start as usize, 48);
        assert_eq!(unsafe { addr_of!((*start).moved_max) } as usize - start as usize, 56);
        assert_eq!(unsafe { addr_of!((*start).moved_rms) } as usize - start as usize, 64);
        assert_eq!(unsafe { addr_of!((*start).widened_position) } as usize - start as usize, 72);
        assert_eq!(unsafe { addr_of!((*start).widened_attitude) } as usize - start as usize, 80);
        assert_eq!(unsafe { addr_of!((*start).association_nodes) } as usize - start as usize, 88);
        assert_eq!(unsafe { addr_of!((*start).association_exhausted) } as usize - start as usize, 92);
        assert_eq!(unsafe { addr_of!((*start).relinearised) } as usize - start as usize, 96);
        assert_eq!(unsafe { addr_of!((*start).refactored) } as usize - start as usize, 100);
        assert_eq!(unsafe { addr_of!((*start).iterations) } as usize - start as usize, 104);
        assert_eq!(unsafe { addr_of!((*start).reserved) } as usize - start as usize, 108);
        assert_eq!(unsafe { addr_of!((*start).seconds) } as usize - start as usize, 112);
    }

    #[test]
    fn cairn_update_report_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_update_report>(), 96);
        assert_eq!(align_of::<cairn_update_report>(), 8);
        let memory = MaybeUninit::<cairn_update_report>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).matched) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).placed) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).placed_again) } as usize - start as usize, 12);
        assert_eq!(unsafe { addr_of!((*start).rejected) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).deferred) } as usize - start as usize, 20);
        assert_eq!(unsafe { addr_of!((*start).removed) } as usize - start as usize, 24);
        assert_eq!(unsafe { addr_of!((*start).rows) } as usize - start as usize, 28);
        assert_eq!(unsafe { addr_of!((*start).nis) } as usize - start as usize, 32);
        assert_eq!(unsafe { addr_of!((*start).nis_lower) } as usize - start as usize, 40);
        assert_eq!(unsafe { addr_of!((*start).nis_upper) } as usize - start as usize, 48);
        assert_eq!(unsafe { addr_of!((*start).widened_position) } as usize - start as usize, 56);
        assert_eq!(unsafe { addr_of!((*start).widened_attitude) } as usize - start as usize, 64);
        assert_eq!(unsafe { addr_of!((*start).iterations) } as usize - start as usize, 72);
        assert_eq!(unsafe { addr_of!((*start).association_nodes) } as usize - start as usize, 76);
        assert_eq!(unsafe { addr_of!((*start).association_exhausted) } as usize - start as usize, 80);
        assert_eq!(unsafe { addr_of!((*start).reserved) } as usize - start as usize, 84);
        assert_eq!(unsafe { addr_of!((*start).association_seconds) } as usize - start as usize, 88);
    }

    #[test]
    fn cairn_health_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_health>(), 144);
        assert_eq!(align_of::<cairn_health>(), 8);
        let memory = MaybeUninit::<cairn_health>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).verdict) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).reasons) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).blind_directions) } as usize - start as usize, 12);
        assert_eq!(unsafe { addr_of!((*start).contradicting) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).reserved) } as usize - start as usize, 20);
        assert_eq!(unsafe { addr_of!((*start).updates) } as usize - start as usize, 24);
        assert_eq!(unsafe { addr_of!((*start).good_share) } as usize - start as usize, 32);
        assert_eq!(unsafe { addr_of!((*start).doubtful_share) } as usize - start as usize, 40);
        assert_eq!(unsafe { addr_of!((*start).lost_share) } as usize - start as usize, 48);
        assert_eq!(unsafe { addr_of!((*start).nis_per_row) } as usize - start as usize, 56);
        assert_eq!(unsafe { addr_of!((*start).nis_lower) } as usize - start as usize, 64);
        assert_eq!(unsafe { addr_of!((*start).nis_upper) } as usize - start as usize, 72);
        assert_eq!(unsafe { addr_of!((*start).refused_share) } as usize - start as usize, 80);
        assert_eq!(unsafe { addr_of!((*start).widenings) } as usize - start as usize, 88);
        assert_eq!(unsafe { addr_of!((*start).last_widening) } as usize - start as usize, 96);
        assert_eq!(unsafe { addr_of!((*start).motion_scale) } as usize - start as usize, 104);
        assert_eq!(unsafe { addr_of!((*start).motion_scale_sigma) } as usize - start as usize, 112);
        assert_eq!(unsafe { addr_of!((*start).bias_sigmas) } as usize - start as usize, 120);
        assert_eq!(unsafe { addr_of!((*start).jump_sigmas) } as usize - start as usize, 128);
        assert_eq!(unsafe { addr_of!((*start).pose_pivot) } as usize - start as usize, 136);
    }

    #[test]
    fn cairn_sensor_health_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_sensor_health>(), 96);
        assert_eq!(align_of::<cairn_sensor_health>(), 8);
        let memory = MaybeUninit::<cairn_sensor_health>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).reserved) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).compared) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).refused) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).nis_per_row) } as usize - start as usize, 24);
        assert_eq!(unsafe { addr_of!((*start).nis_lower) } as usize - start as usize, 32);
        assert_eq!(unsafe { addr_of!((*start).nis_upper) } as usize - start as usize, 40);
        assert_eq!(unsafe { addr_of!((*start).scale) } as usize - start as usize, 48);
        assert_eq!(unsafe { addr_of!((*start).scale_sigma) } as usize - start as usize, 56);
        assert_eq!(unsafe { addr_of!((*start).persistence) } as usize - start as usize, 64);
    }

    #[test]
    fn cairn_calibration_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_calibration>(), 152);
        assert_eq!(align_of::<cairn_calibration>(), 8);
        let memory = MaybeUninit::<cairn_calibration>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).reserved) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).mount_shift_sigma) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).mount_shift_walk) } as usize - start as usize, 32);
        assert_eq!(unsafe { addr_of!((*start).mount_turn_sigma) } as usize - start as usize, 56);
        assert_eq!(unsafe { addr_of!((*start).mount_turn_walk) } as usize - start as usize, 80);
        assert_eq!(unsafe { addr_of!((*start).offset_sigma) } as usize - start as usize, 104);
        assert_eq!(unsafe { addr_of!((*start).offset_walk) } as usize - start as usize, 128);
    }

    #[test]
    fn cairn_systematic_error_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_systematic_error>(), 32);
        assert_eq!(align_of::<cairn_systematic_error>(), 8);
        let memory = MaybeUninit::<cairn_systematic_error>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).kind) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).sensor) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).component) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).reserved) } as usize - start as usize, 12);
        assert_eq!(unsafe { addr_of!((*start).value) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).sigma) } as usize - start as usize, 24);
    }

    #[test]
    fn cairn_team_options_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_team_options>(), 56);
        assert_eq!(align_of::<cairn_team_options>(), 8);
        let memory = MaybeUninit::<cairn_team_options>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).mode) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).vehicle) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).max_vehicles) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).baseline) } as usize - start as usize, 20);
        assert_eq!(unsafe { addr_of!((*start).max_lag) } as usize - start as usize, 24);
        assert_eq!(unsafe { addr_of!((*start).time_tolerance) } as usize - start as usize, 32);
        assert_eq!(unsafe { addr_of!((*start).max_jump) } as usize - start as usize, 40);
        assert_eq!(unsafe { addr_of!((*start).max_waiting) } as usize - start as usize, 48);
        assert_eq!(unsafe { addr_of!((*start).history) } as usize - start as usize, 52);
    }

    #[test]
    fn cairn_team_report_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_team_report>(), 280);
        assert_eq!(align_of::<cairn_team_report>(), 8);
        let memory = MaybeUninit::<cairn_team_report>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).unsettled) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).interrupted) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).reserved) } as usize - start as usize, 12);
        assert_eq!(unsafe { addr_of!((*start).sent) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).resent) } as usize - start as usize, 24);
        assert_eq!(unsafe { addr_of!((*start).requested) } as usize - start as usize, 32);
        assert_eq!(unsafe { addr_of!((*start).received) } as usize - start as usize, 40);
        assert_eq!(unsafe { addr_of!((*start).taken) } as usize - start as usize, 48);
        assert_eq!(unsafe { addr_of!((*start).reordered) } as usize - start as usize, 56);
        assert_eq!(unsafe { addr_of!((*start).repeated) } as usize - start as usize, 64);
        assert_eq!(unsafe { addr_of!((*start).own) } as usize - start as usize, 72);
        assert_eq!(unsafe { addr_of!((*start).ignored) } as usize - start as usize, 80);
        assert_eq!(unsafe { addr_of!((*start).unknown) } as usize - start as usize, 88);
        assert_eq!(unsafe { addr_of!((*start).past) } as usize - start as usize, 96);
        assert_eq!(unsafe { addr_of!((*start).ahead) } as usize - start as usize, 104);
        assert_eq!(unsafe { addr_of!((*start).conflict) } as usize - start as usize, 112);
        assert_eq!(unsafe { addr_of!((*start).full) } as usize - start as usize, 120);
        assert_eq!(unsafe { addr_of!((*start).foreign) } as usize - start as usize, 128);
        assert_eq!(unsafe { addr_of!((*start).version) } as usize - start as usize, 136);
        assert_eq!(unsafe { addr_of!((*start).cut) } as usize - start as usize, 144);
        assert_eq!(unsafe { addr_of!((*start).corrupt) } as usize - start as usize, 152);
        assert_eq!(unsafe { addr_of!((*start).nonsense) } as usize - start as usize, 160);
        assert_eq!(unsafe { addr_of!((*start).lost) } as usize - start as usize, 168);
        assert_eq!(unsafe { addr_of!((*start).matched) } as usize - start as usize, 176);
        assert_eq!(unsafe { addr_of!((*start).placed) } as usize - start as usize, 184);
        assert_eq!(unsafe { addr_of!((*start).rejected) } as usize - start as usize, 192);
        assert_eq!(unsafe { addr_of!((*start).sightings_used) } as usize - start as usize, 200);
        assert_eq!(unsafe { addr_of!((*start).sightings_refused) } as usize - start as usize, 208);
        assert_eq!(unsafe { addr_of!((*start).vehicles_found) } as usize - start as usize, 216);
        assert_eq!(unsafe { addr_of!((*start).failed) } as usize - start as usize, 224);
        assert_eq!(unsafe { addr_of!((*start).scored) } as usize - start as usize, 232);
        assert_eq!(unsafe { addr_of!((*start).scored_nees) } as usize - start as usize, 240);
        assert_eq!(unsafe { addr_of!((*start).position_rmse) } as usize - start as usize, 248);
        assert_eq!(unsafe { addr_of!((*start).anees_per_dof) } as usize - start as usize, 256);
        assert_eq!(unsafe { addr_of!((*start).claimed_improvement) } as usize - start as usize, 264);
        assert_eq!(unsafe { addr_of!((*start).true_improvement) } as usize - start as usize, 272);
    }

    #[test]
    fn cairn_world_options_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_world_options>(), 544);
        assert_eq!(align_of::<cairn_world_options>(), 8);
        let memory = MaybeUninit::<cairn_world_options>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).course) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).seed) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).landmarks) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).terrain) } as usize - start as usize, 20);
        assert_eq!(unsafe { addr_of!((*start).contact) } as usize - start as usize, 24);
        assert_eq!(unsafe { addr_of!((*start).drive) } as usize - start as usize, 28);
        assert_eq!(unsafe { addr_of!((*start).accelerometer) } as usize - start as usize, 32);
        assert_eq!(unsafe { addr_of!((*start).stick_noise) } as usize - start as usize, 36);
        assert_eq!(unsafe { addr_of!((*start).observe_at_start) } as usize - start as usize, 40);
        assert_eq!(unsafe { addr_of!((*start).traverse_closed) } as usize - start as usize, 44);
        assert_eq!(unsafe { addr_of!((*start).speed) } as usize - start as usize, 48);
        assert_eq!(unsafe { addr_of!((*start).laps) } as usize - start as usize, 56);
        assert_eq!(unsafe { addr_of!((*start).centre) } as usize - start as usize, 64);
        assert_eq!(unsafe { addr_of!((*start).radius) } as usize - start as usize, 80);
        assert_eq!(unsafe { addr_of!((*start).start_azimuth) } as usize - start as usize, 88);
        assert_eq!(unsafe { addr_of!((*start).round_length) } as usize - start as usize, 96);
        assert_eq!(unsafe { addr_of!((*start).round_variation) } as usize - start as usize, 104);
        assert_eq!(unsafe { addr_of!((*start).strip) } as usize - start as usize, 112);
        assert_eq!(unsafe { addr_of!((*start).landmark_area) } as usize - start as usize, 120);
        assert_eq!(unsafe { addr_of!((*start).landmark_height) } as usize - start as usize, 128);
        assert_eq!(unsafe { addr_of!((*start).max_slope) } as usize - start as usize, 136);
        assert_eq!(unsafe { addr_of!((*start).wavelength) } as usize - start as usize, 144);
        assert_eq!(unsafe { addr_of!((*start).start_height) } as usize - start as usize, 160);
        assert_eq!(unsafe { addr_of!((*start).wheel_radius) } as usize - start as usize, 168);
        assert_eq!(unsafe { addr_of!((*start).track) } as usize - start as usize, 176);
        assert_eq!(unsafe { addr_of!((*start).wheelbase) } as usize - start as usize, 184);
        assert_eq!(unsafe { addr_of!((*start).velocity_sigma) } as usize - start as usize, 192);
        assert_eq!(unsafe { addr_of!((*start).rate_sigma) } as usize - start as usize, 200);
        assert_eq!(unsafe { addr_of!((*start).gravity) } as usize - start as usize, 208);
        assert_eq!(unsafe { addr_of!((*start).wheel_rate_sigma) } as usize - start as usize, 216);
        assert_eq!(unsafe { addr_of!((*start).wheel_slip_sigma) } as usize - start as usize, 224);
        assert_eq!(unsafe { addr_of!((*start).lateral_sigma) } as usize - start as usize, 232);
        assert_eq!(unsafe { addr_of!((*start).vertical_sigma) } as usize - start as usize, 240);
        assert_eq!(unsafe { addr_of!((*start).imu_period) } as usize - start as usize, 248);
        assert_eq!(unsafe { addr_of!((*start).motion_period) } as usize - start as usize, 256);
        assert_eq!(unsafe { addr_of!((*start).frame_period) } as usize - start as usize, 264);
        assert_eq!(unsafe { addr_of!((*start).range_sigma) } as usize - start as usize, 272);
        assert_eq!(unsafe { addr_of!((*start).azimuth_sigma) } as usize - start as usize, 280);
        assert_eq!(unsafe { addr_of!((*start).stick_sigma) } as usize - start as usize, 288);
        assert_eq!(unsafe { addr_of!((*start).image_sigma) } as usize - start as usize, 296);
        assert_eq!(unsafe { addr_of!((*start).near_range) } as usize - start as usize, 304);
        assert_eq!(unsafe { addr_of!((*start).far_range) } as usize - start as usize, 312);
        assert_eq!(unsafe { addr_of!((*start).half_azimuth) } as usize - start as usize, 320);
        assert_eq!(unsafe { addr_of!((*start).pan_amplitude) } as usize - start as usize, 328);
        assert_eq!(unsafe { addr_of!((*start).pan_period) } as usize - start as usize, 336);
        assert_eq!(unsafe { addr_of!((*start).stick_amplitude) } as usize - start as usize, 344);
        assert_eq!(unsafe { addr_of!((*start).stick_period) } as usize - start as usize, 352);
        assert_eq!(unsafe { addr_of!((*start).platform) } as usize - start as usize, 360);
        assert_eq!(unsafe { addr_of!((*start).stick) } as usize - start as usize, 384);
        assert_eq!(unsafe { addr_of!((*start).velocity_bias) } as usize - start as usize, 408);
        assert_eq!(unsafe { addr_of!((*start).rate_bias) } as usize - start as usize, 432);
        assert_eq!(unsafe { addr_of!((*start).wheel_scale) } as usize - start as usize, 456);
        assert_eq!(unsafe { addr_of!((*start).mount_turn) } as usize - start as usize, 472);
        assert_eq!(unsafe { addr_of!((*start).mount_shift) } as usize - start as usize, 496);
        assert_eq!(unsafe { addr_of!((*start).value_offset) } as usize - start as usize, 520);
    }

    #[test]
    fn cairn_world_motion_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_world_motion>(), 136);
        assert_eq!(align_of::<cairn_world_motion>(), 8);
        let memory = MaybeUninit::<cairn_world_motion>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).dt) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).velocity) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).rate) } as usize - start as usize, 32);
        assert_eq!(unsafe { addr_of!((*start).wheels) } as usize - start as usize, 56);
        assert_eq!(unsafe { addr_of!((*start).true_velocity) } as usize - start as usize, 72);
        assert_eq!(unsafe { addr_of!((*start).true_rate) } as usize - start as usize, 96);
        assert_eq!(unsafe { addr_of!((*start).true_wheels) } as usize - start as usize, 120);
    }

    #[test]
    fn cairn_world_step_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_world_step>(), 160);
        assert_eq!(align_of::<cairn_world_step>(), 8);
        let memory = MaybeUninit::<cairn_world_step>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).reserved) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).number) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).time) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).truth) } as usize - start as usize, 24);
        assert_eq!(unsafe { addr_of!((*start).velocity_sigma) } as usize - start as usize, 80);
        assert_eq!(unsafe { addr_of!((*start).rate_sigma) } as usize - start as usize, 104);
        assert_eq!(unsafe { addr_of!((*start).pan) } as usize - start as usize, 128);
        assert_eq!(unsafe { addr_of!((*start).stick) } as usize - start as usize, 136);
        assert_eq!(unsafe { addr_of!((*start).motion_count) } as usize - start as usize, 144);
        assert_eq!(unsafe { addr_of!((*start).observation_count) } as usize - start as usize, 152);
    }

    #[test]
    fn cairn_fleet_options_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_fleet_options>(), 128);
        assert_eq!(align_of::<cairn_fleet_options>(), 8);
        let memory = MaybeUninit::<cairn_fleet_options>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).layout) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).seed) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).vehicles) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).features) } as usize - start as usize, 20);
        assert_eq!(unsafe { addr_of!((*start).area) } as usize - start as usize, 24);
        assert_eq!(unsafe { addr_of!((*start).separation) } as usize - start as usize, 32);
        assert_eq!(unsafe { addr_of!((*start).course_length) } as usize - start as usize, 40);
        assert_eq!(unsafe { addr_of!((*start).duration) } as usize - start as usize, 48);
        assert_eq!(unsafe { addr_of!((*start).period) } as usize - start as usize, 56);
        assert_eq!(unsafe { addr_of!((*start).radar_range) } as usize - start as usize, 64);
        assert_eq!(unsafe { addr_of!((*start).range_sigma) } as usize - start as usize, 72);
        assert_eq!(unsafe { addr_of!((*start).bearing_sigma) } as usize - start as usize, 80);
        assert_eq!(unsafe { addr_of!((*start).speed_sigma) } as usize - start as usize, 88);
        assert_eq!(unsafe { addr_of!((*start).rate_sigma) } as usize - start as usize, 96);
        assert_eq!(unsafe { addr_of!((*start).coast_distance) } as usize - start as usize, 104);
        assert_eq!(unsafe { addr_of!((*start).coast_relief) } as usize - start as usize, 112);
        assert_eq!(unsafe { addr_of!((*start).coast_strip) } as usize - start as usize, 120);
    }

    #[test]
    fn cairn_fleet_sighting_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_fleet_sighting>(), 24);
        assert_eq!(align_of::<cairn_fleet_sighting>(), 8);
        let memory = MaybeUninit::<cairn_fleet_sighting>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).id) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).range) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).bearing) } as usize - start as usize, 16);
    }

    #[test]
    fn cairn_fleet_vehicle_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_fleet_vehicle>(), 56);
        assert_eq!(align_of::<cairn_fleet_vehicle>(), 8);
        let memory = MaybeUninit::<cairn_fleet_vehicle>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).speed) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).rate) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).x) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).y) } as usize - start as usize, 24);
        assert_eq!(unsafe { addr_of!((*start).heading) } as usize - start as usize, 32);
        assert_eq!(unsafe { addr_of!((*start).feature_count) } as usize - start as usize, 40);
        assert_eq!(unsafe { addr_of!((*start).vehicle_count) } as usize - start as usize, 48);
    }

    #[test]
    fn cairn_fleet_step_is_that_of_the_description() {
        assert_eq!(size_of::<cairn_fleet_step>(), 40);
        assert_eq!(align_of::<cairn_fleet_step>(), 8);
        let memory = MaybeUninit::<cairn_fleet_step>::uninit();
        let start = memory.as_ptr();
        assert_eq!(unsafe { addr_of!((*start).struct_size) } as usize - start as usize, 0);
        assert_eq!(unsafe { addr_of!((*start).reserved) } as usize - start as usize, 4);
        assert_eq!(unsafe { addr_of!((*start).number) } as usize - start as usize, 8);
        assert_eq!(unsafe { addr_of!((*start).time) } as usize - start as usize, 16);
        assert_eq!(unsafe { addr_of!((*start).dt) } as usize - start as usize, 24);
        assert_eq!(unsafe { addr_of!((*start).vehicle_count) } as usize - start as usize, 32);
    }
}
