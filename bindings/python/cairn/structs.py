# SPDX-License-Identifier: BSD-3-Clause
# Written by generate.py from the description of the C interface: do not edit.
"""The options and reports of the C interface, as typed dictionaries, and the steps of simulations.

Options are keyword arguments: Filter(max_landmarks=500). One that is not given has the default of the library.
"""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Literal, TypedDict

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ._pose_type import Pose, PoseLike
    from .constants import (
        Accelerometer, Association, ClosedBy, Contact, Course, Distance, Doubts, Drive, Encoder, FleetLayout,
        Join, Loss, MergeBy, NoiseLearning, StateError, Status, Stick, TeamMode, Terrain, Vehicle, Verdict, Yaw)

__all__ = ["Calibration", "Cartesian", "ClosingReport", "Custom", "FilterOptions", "FleetOptions", "Health",
           "MergeOptions", "MergeReport", "RangeBearing", "SensorHealth", "StereoCamera", "StereoHead", "TeamOptions",
           "TeamReport", "TwistNoise", "UpdateReport", "Wheels", "WorldOptions"]


class MergeOptions(TypedDict, total=False):
    """Options of Map.merge."""

    association: MergeBy | Literal["id", "geometry"]
    """MergeBy.ID or MergeBy.GEOMETRY; default MergeBy.ID."""
    gate_probability: float
    """Probability that all common landmarks of a correct merge pass their own gates, in (0, 1]; default 0.9999."""
    joint_gate_probability: float
    """Probability that they pass the joint gate, in (0, 1]; default 0.9999."""
    max_landmarks: int
    """Capacity of the merged map; 0, the default: no limit."""
    max_tilt: float
    """By geometry, without has_transform: largest angle between the z axes of both frames, rad, 0 to pi; default pi."""
    has_transform: bool
    """1: T_map_other is known beforehand, independently of both maps; default 0."""
    T_map_other: PoseLike
    """With has_transform: from the other's frame into the map's frame; default identity."""
    covariance: ArrayLike
    """Covariance of its error [dp; dtheta], 6x6 row-major, positive semidefinite; default 0: known exactly."""


class MergeReport(TypedDict):
    """Report of Map.merge, also of a refused merge. Fields that the merge did not reach are 0."""

    association: MergeBy
    """The one of the options."""
    common: int
    """Landmarks that both maps hold."""
    added: int
    """Landmarks that only the other holds."""
    rows: int
    """Degrees of freedom of `distance`: three for each common landmark; without has_transform six less."""
    distance: float
    """Joint squared Mahalanobis distance of the common landmarks."""
    threshold: float
    """Its chi-square bound."""
    T_map_other: Pose
    """Transforms points from the other's frame into the map's frame."""
    covariance: NDArray[np.float64]
    """Covariance of its error [dp; dtheta], 6x6 row-major."""
    broken_id: int
    """Id in the map of a common landmark that failed a test; ID_NONE: none."""
    broken_other_id: int
    """Id of the same landmark in the other map; ID_NONE: none."""


class Wheels(TypedDict, total=False):
    """Four-wheel differential drive; both wheels of a side turn at the same rate (Mars paper, eq. 1): `v_x = r
    (w_left + w_right) / 2`, `w_z = +-(r / B) (w_right - w_left)`. The model has no motion along y and z and no roll
    and pitch rate. Noise is white; each call is one sample with the standard deviations below."""

    yaw_sign: Yaw | Literal["right_minus_left", "left_minus_right"]
    """Yaw.RIGHT_MINUS_LEFT or Yaw.LEFT_MINUS_RIGHT; default Yaw.RIGHT_MINUS_LEFT."""
    radius: float
    """r, m, > 0; default 0.3."""
    track: float
    """B, distance between left and right wheels, m, > 0; default 1.0."""
    rate_sigma: float
    """Noise of each side's wheel rate, rad/s, >= 0; default 0.01."""
    slip_sigma: float
    """Noise of each side's wheel rate in proportion to this rate, >= 0; default 0.02."""
    lateral_sigma: float
    """Side slip: noise of the velocity along y, m/s, >= 0; default 0.01."""
    vertical_sigma: float
    """Noise of the velocity along z, m/s, >= 0; default 0.01."""
    roll_rate_sigma: float
    """Noise of the roll rate, which is not measured, rad/s, >= 0; default 0.05."""
    pitch_rate_sigma: float
    """Noise of the pitch rate, which is not measured, rad/s, >= 0; default 0.05."""


class TwistNoise(TypedDict, total=False):
    """Noise of measured body velocity and body rate (IMU, visual odometry). It is white, with a standard deviation
    per sample and axis (x, y, z of the body). Mars paper, eq. 2, integrated on the group: `T <- T Exp([v; w] dt)`."""

    velocity_sigma: ArrayLike
    """m/s, >= 0; default 0.05 each."""
    rate_sigma: ArrayLike
    """Rad/s, >= 0; default 0.005 each."""


class StereoHead(TypedDict, total=False):
    """Stereo head on a pan and tilt mount (Mars paper, Figures 2 and 3, eq. 4). It observes range, azimuth and
    elevation.  A point `m_c` of the camera frame (x out of the lens, y left, z up) lies in the body frame at `m_b =
    d + Rz(pan) Ry(stick) (s + R(q) m_c)`. The platform stands at `d`. It turns by `pan` about its z axis, and by
    `stick` about the bolt, which is its y axis. The stick carries the camera at `s`, turned by `q`. The observation
    is `z = (range, azimuth, elevation)` of `m_c`: `range = |m_c|` (m), `azimuth = atan2(y, x)` (rad, left
    positive), `elevation = atan2(z, sqrt(x^2 + y^2))` (rad, up positive). A positive stick angle lowers the lens,
    so a stick that turns by -elevation points the lens at the point. With the default mount the camera frame is the
    body frame."""

    encoder_mode: Encoder | Literal["per_observation", "per_frame"]
    """Encoder.PER_OBSERVATION or Encoder.PER_FRAME; default Encoder.PER_OBSERVATION."""
    platform: ArrayLike
    """d: pan axis in the body frame, m; default 0."""
    stick: ArrayLike
    """s: camera in the stick's frame, which has made both turns, m; default 0."""
    camera_quaternion: ArrayLike
    """q: camera axes in the stick's frame, w x y z; default identity."""
    range_sigma: float
    """m, > 0; default 1.0 (Table 1)"""
    azimuth_sigma: float
    """Rad, > 0; default 3 degrees (Table 1)"""
    elevation_sigma: float
    """Rad, > 0; default 3 degrees (Table 1)"""
    pan_sigma: float
    """Encoder noise of pan, rad, >= 0; default 0."""
    stick_sigma: float
    """Encoder noise of the stick, rad, >= 0; default 0."""
    near_range: float
    """An observation is refused if the predicted range, or the observed range of a new landmark, is below this, m,
    > 0; default 0.1."""
    max_elevation: float
    """An observation is also refused above this elevation, where the azimuth is nearly undefined, rad, in (0,
    pi/2); default 85 degrees."""


class StereoCamera(TypedDict, total=False):
    """Rectified stereo camera: `z = (u_left, u_right, v)` in pixels of a point `(x, y, z)` of the left camera's
    frame (z out of the lens, x right, y down): `u_left = fu x/z + cu`, `u_right = fu (x - baseline)/z + cu`, `v =
    fv y/z + cv`. If both images give a row, pass the mean of both rows and half the variance of one."""

    fu: float
    """Focal length in u, pixels, > 0; default 500."""
    fv: float
    """Focal length in v, pixels, > 0; default 500."""
    cu: float
    """Principal point, pixels; default 320."""
    cv: float
    """Principal point, pixels; default 240."""
    baseline: float
    """m, > 0; default 0.2."""
    T_body_camera: PoseLike
    """Left camera in the body; default: at the origin, looking along x."""
    sigma: ArrayLike
    """Noise of u_left, u_right, v, pixels, > 0; default 1 each."""
    near_depth: float
    """a landmark whose predicted depth is below this has no image, m, > 0; default 0.1."""
    min_disparity: float
    """An observation places a landmark only if its disparity u_left - u_right is at least this, pixels, > 0;
    default 1."""
    min_disparity_sigmas: float
    """And only if its disparity is at least this many of its standard deviations (from `sigma`), >= 0; default 2.5:
    the depth is known to 40 %. A landmark that is farther away is placed when it is seen from nearer."""


class RangeBearing(TypedDict, total=False):
    """Radar, lidar or sonar of a planar vehicle: `z = (range, bearing)` of the landmark in the sensor's frame, m
    and rad, positive to the left."""

    T_body_sensor: PoseLike
    """Sensor in the body, in the plane; default identity."""
    range_sigma: float
    """m, > 0; default 0.1."""
    bearing_sigma: float
    """Rad, > 0; default 0.01."""
    near_range: float
    """An observation is refused if the predicted range, or the observed range of a new landmark, is below this, m,
    > 0; default 0.01."""


class Cartesian(TypedDict, total=False):
    """Any sensor that gives a point: `z = (x, y, z)` of the landmark in the sensor's frame, m; for a planar vehicle
    `z = (x, y)`."""

    T_body_sensor: PoseLike
    """Sensor in the body; default identity."""
    sigma: ArrayLike
    """Noise of x, y, z, m, > 0; default 0.1 each."""


class Custom(TypedDict, total=False):
    """A sensor of the caller's own, whose model are two functions (Filter.add_custom)."""

    rows: int
    """Values of an observation, 1 to 3; for a planar vehicle 1 or 2; default 3."""
    angle_mask: int
    """Bit i is set: value i is an angle (rad) and its residual is wrapped to (-pi, pi]; default 0."""
    relative: bool
    """1: z depends on pose and landmark only through the body point R^T (l - p), and the filter makes use of that;
    default 0: any function of both."""
    sigma: ArrayLike
    """Noise of each value, > 0; default 1 each."""


class FilterOptions(TypedDict, total=False):
    """Options of Filter."""

    vehicle: Vehicle | Literal["spatial", "planar"]
    """Vehicle.SPATIAL or Vehicle.PLANAR; default Vehicle.SPATIAL."""
    state_error: StateError | Literal["invariant", "standard"]
    """StateError.INVARIANT or StateError.STANDARD; default StateError.INVARIANT."""
    max_landmarks: int
    """Capacity; default 1000. Single map or dense joining: 1 to 30000, the memory grows with the square of this
    number and is taken at creation. Sparse joining: 1 to 10000000, only a bound, memory is taken as the map grows."""
    max_observations: int
    """Observations of one frame, 1 to 4096; default 64."""
    max_sensors: int
    """Sensors that can be added, 1 to 256; default 8."""
    initial_pose: PoseLike
    """Body in the map frame at the start; default identity."""
    initial_covariance: ArrayLike
    """Covariance of its error [dp; dtheta], symmetric, positive semidefinite; default 0: known exactly."""
    iterations: int
    """Linearisations of an update at most, 1 (plain EKF) to 50; default 3."""
    noise_learning: NoiseLearning | Literal["reported", "applied"]
    """NoiseLearning.REPORTED or NoiseLearning.APPLIED; default NoiseLearning.REPORTED."""
    iteration_tolerance: float
    """The iteration ends when the linearisation error of the batch is smaller than this, > 0; it is measured in
    standard deviations of the observations, root of the sum of squares; default 0.1."""
    gate_probability: float
    """Chi-square gate of one observation, in (0, 1]; 1: no gate; default 0.999."""
    batch_gate_probability: float
    """Chi-square gate of a whole batch, in (0, 1]; 1: no gate; default 0.9999."""
    error_persistence: float
    """Number of consecutive observations of a landmark whose errors are fully correlated, 1 to 1000000: an update
    multiplies the covariance of an observation's noise by this; association, placing and the weights of a robust
    loss use the noise unchanged; default 1."""
    association: Association | Literal["known", "nearest", "joint"]
    """Association.KNOWN, Association.NEAREST or Association.JOINT; default Association.KNOWN."""
    association_distance: Distance | Literal["mahalanobis", "likelihood"]
    """Distance.MAHALANOBIS or Distance.LIKELIHOOD; default Distance.MAHALANOBIS."""
    association_nodes: int
    """Joint tests of one frame at most, 1 to 1000000; after this number the best set found so far is used; default
    2000."""
    deferred_sightings: int
    """a new landmark is deferred until it was observed this often, 1 to 1000: until then it is part of the
    estimate, but no map shows it; default 1."""
    deferred_frames: int
    """a deferred landmark is removed if it is not observed often enough within this many frames, 1 to 1000000;
    default 20."""
    missed_frames: int
    """a landmark is removed if it lay in a sensor's view (Filter.set_view), but was not seen, in this many
    consecutive frames of this sensor; 0, the default: never."""
    new_probability: float
    """Unknown ids: an observation places a new landmark only if its distance from each landmark exceeds the
    chi-square bound of this probability, in (0, 1). Landmarks that another observation of the frame is paired with
    do not count. A pair beyond this bound is never made. Default 0.9999."""
    submap_landmarks: int
    """a submap is closed when it holds this many landmarks, up to 4096; 0, the default: no submaps, one single map."""
    join: Join | Literal["auto", "dense", "sparse"]
    """Join.AUTO, Join.DENSE or Join.SPARSE; default Join.AUTO."""
    join_loss: Loss | Literal["none", "huber", "cauchy"]
    """Loss of the landmarks that a closed submap shares with the map: Loss.NONE, Loss.HUBER or Loss.CAUCHY; default
    Loss.NONE."""
    trajectory_poses: int
    """Newest poses that are kept for Filter.trajectory, 0 to 10000000; 0, the default: none. The memory is taken at
    creation, at most 600 bytes a pose."""
    join_loss_width: float
    """Where `join_loss` leaves the parabola, standard deviations, > 0; default 1.5."""
    submap_distance: float
    """a submap is also closed when the vehicle has driven this far in it, m; 0, the default: no limit."""
    submap_extent: float
    """a submap is also closed when a landmark lies this far from its origin, m; 0, the default: no limit."""
    submap_sigma: float
    """a submap is also closed when the largest standard deviation of the vehicle's position in it exceeds this, m;
    0, the default: no limit."""
    velocity_bias_sigma: ArrayLike
    """a constant error of the measured body velocity (x, y, z) is a state, with this standard deviation at the
    start, m/s, >= 0; 0, the default: no state. The velocity is the measured one minus the bias
    (docs/systematic_errors.md). A planar vehicle has only x and y."""
    velocity_bias_walk: ArrayLike
    """Random walk of that error, m/s in the square root of a second, >= 0; it needs its velocity_bias_sigma;
    default 0: constant."""
    rate_bias_sigma: ArrayLike
    """The same for the measured body rate, rad/s, >= 0; default 0. A planar vehicle has only z."""
    rate_bias_walk: ArrayLike
    """Rad/s in the square root of a second, >= 0; default 0."""
    wheel_scale_sigma: ArrayLike
    """The same for the scales of the left and the right wheels: a wheel turns at the measured rate times 1 + its
    scale, >= 0; default 0."""
    wheel_scale_walk: ArrayLike
    """In the square root of a second, >= 0; default 0."""
    max_sensor_errors: int
    """Numbers that Filter.calibrate_sensor makes states, over all sensors, 0 to 64; default 0."""


class ClosingReport(TypedDict):
    """Report of the last attempt to close a submap."""

    status: Status
    """Status.OK, or the error because of which the submap stayed open."""
    reason: ClosedBy
    """ClosedBy."""
    submaps: int
    """Submaps closed so far."""
    landmarks: int
    """Landmarks of the submap."""
    landmarks_new: int
    """Landmarks of the submap that are new to the map."""
    landmarks_fused: int
    """Landmarks of the submap that the map knows, and that were fused with it."""
    landmarks_refused: int
    """Landmarks of the submap that contradict the map's estimates, and that were left out."""
    landmarks_ambiguous: int
    """Unknown ids: landmarks of the submap that may be landmarks of the map, but no pair is certain: left out."""
    rows: int
    """Degrees of freedom of `distance`."""
    distance: float
    """Joint squared Mahalanobis distance between both estimates of the fused landmarks."""
    threshold: float
    """Its chi-square bound at batch_gate_probability."""
    moved_max: float
    """Largest movement of an older landmark of the map, m."""
    moved_rms: float
    """Root mean square of these movements, m."""
    widened_position: float
    """Most known landmarks of the submap contradicted the map and agreed on another pose of its origin: how far
    from the estimate, m; 0: they did not (docs/update.md, "Finding back")"""
    widened_attitude: float
    """The same of the attitude, rad."""
    association_nodes: int
    """Joint tests of the association with the map."""
    association_exhausted: bool
    """1: it stopped at the bound `association_nodes` of the options."""
    relinearised: int
    """Submaps linearised again (sparse)"""
    refactored: int
    """Blocks of the factor computed again (sparse)"""
    iterations: int
    """Linear solutions."""
    seconds: float
    """Duration of the closing, s; it differs from run to run."""


class UpdateReport(TypedDict):
    """Report of the last update."""

    matched: int
    """Observations that updated a landmark."""
    placed: int
    """Observations that placed a new landmark."""
    placed_again: int
    """Landmarks among `placed` that had been placed wrongly before (docs/update.md, "A landmark that was placed
    wrongly")"""
    rejected: int
    """Observations that were refused."""
    deferred: int
    """Landmarks that do not count after the update: seen too rarely (`deferred_sightings`, or once while gross
    errors are many), or as many observations contradict them as agree."""
    removed: int
    """Landmarks removed after the update: missed too often, not seen again in time, or none of a full submap
    counted."""
    rows: int
    """Rows of the batch after the gates: degrees of freedom of `nis`."""
    nis: float
    """Normalised innovation squared of the batch at the prediction."""
    nis_lower: float
    """95 % band of `nis`: lower bound."""
    nis_upper: float
    """95 % band of `nis`: upper bound."""
    widened_position: float
    """Most of what was seen contradicted the estimate: standard deviation by which the motion since the last
    agreement was widened, m; 0: it was not (docs/update.md, "Finding back")"""
    widened_attitude: float
    """The same of the attitude, rad."""
    iterations: int
    """Number of linearisations."""
    association_nodes: int
    """Joint tests of the association."""
    association_exhausted: bool
    """1: it stopped at the bound `association_nodes` of the options; a better set of pairs may exist."""
    association_seconds: float
    """Duration of the association, s; it differs from run to run."""


class Health(TypedDict):
    """The verdict after the last update, and what supports it. A window counts the last 20 updates or so; older
    updates fade. A factor that is 1 with a standard deviation above 1 is not known."""

    verdict: Verdict
    """Verdict.GOOD, Verdict.DOUBTFUL or Verdict.LOST."""
    reasons: Doubts
    """Bits Doubts; 0 if the verdict is good."""
    blind_directions: int
    """Directions of the pose about which the window says nothing."""
    contradicting: int
    """Landmarks of the last frame whose observations contradict the rest."""
    updates: int
    """Updates so far."""
    good_share: float
    """Share of them with this verdict."""
    doubtful_share: float
    """The same."""
    lost_share: float
    """The same."""
    nis_per_row: float
    """Normalised innovation squared of the window, for each row; 1 is expected."""
    nis_lower: float
    """Its 95 % band: lower bound; 0 before the first row."""
    nis_upper: float
    """Its 95 % band: upper bound; 0 before the first row."""
    refused_share: float
    """Of the window's observations that were compared with known landmarks."""
    widenings: int
    """How often the motion was widened."""
    last_widening: float
    """Amount of the last one; 0: none."""
    motion_scale: float
    """Factor of the motion's stated standard deviations that explains what is seen."""
    motion_scale_sigma: float
    """Its standard deviation."""
    bias_sigmas: float
    """Mean of the pose's corrections in the window, worst axis, over its standard deviation."""
    jump_sigmas: float
    """How far the last frame contradicts the motion since the frame before."""
    pose_pivot: float
    """Smallest pivot of the pose's correlation matrix."""


class SensorHealth(TypedDict):
    """What the observations of one sensor show."""

    compared: int
    """Observations that were compared with known landmarks, so far."""
    refused: int
    """Of these: refused."""
    nis_per_row: float
    """Normalised innovation squared of the window, for each row; 1 is expected."""
    nis_lower: float
    """Its 95 % band: lower bound; 0 before the first row."""
    nis_upper: float
    """Its 95 % band: upper bound; 0 before the first row."""
    scale: float
    """Factor of the sensor's stated standard deviations that explains what is seen."""
    scale_sigma: float
    """Its standard deviation."""
    persistence: NDArray[np.float64]
    """Correlation of a landmark's innovations with those of 1, 2, 3 and 4 sightings before."""


class Calibration(TypedDict, total=False):
    """Systematic errors of one sensor. A standard deviation at the start that is 0 (the default) means: no state. A
    random walk is that in the square root of a second; it needs its standard deviation. The sensor works as if the
    body were at T_map_body E, E = (Exp(turn), shift); an observed value is the predicted one plus its offset."""

    mount_shift_sigma: ArrayLike
    """x, y, z, m, >= 0; default 0. A planar vehicle has only x and y."""
    mount_shift_walk: ArrayLike
    """>= 0; default 0."""
    mount_turn_sigma: ArrayLike
    """Rotation vector, rad, >= 0; default 0. A planar vehicle has only z."""
    mount_turn_walk: ArrayLike
    """>= 0; default 0."""
    offset_sigma: ArrayLike
    """Of each value of an observation, in its unit, >= 0; default 0."""
    offset_walk: ArrayLike
    """>= 0; default 0."""


class TeamOptions(TypedDict, total=False):
    """Options of Team."""

    mode: TeamMode | Literal["mono", "eo_diagonal", "eo_full", "joint", "submaps"]
    """TeamMode; default TeamMode.JOINT."""
    vehicle: int
    """Number of this vehicle; unique in the team; not ID_NONE; default 0."""
    max_vehicles: int
    """Vehicles of the team, this one included, 1 to 256; default 8."""
    baseline: bool
    """1: a second filter uses only this vehicle's data, for comparison by Team.score; default 0."""
    max_lag: float
    """How long the team waits for a missing packet of a teammate, by the times of its own packets, s, > 0; default
    30."""
    time_tolerance: float
    """Packets whose times differ by at most this belong to the same time, s, >= 0; default 0.01."""
    max_jump: float
    """a step that follows the one before it by more than this, s, > 0, is refused until the next one confirms it;
    default 60."""
    max_waiting: int
    """Packets of one teammate that can wait for their turn, 1 to 1000000; default 4096. The one that the others
    wait for has room beside them."""
    history: int
    """Own packets that are kept for teammates that miss them, 1 to 1000000; default 1024."""


class TeamReport(TypedDict):
    """Report of a team."""

    unsettled: int
    """Own steps that still wait for teammates."""
    interrupted: bool
    """1: memory ran out while a submap was closed. The next call closes it first. Until then no further packet has
    its turn. Otherwise 0."""
    sent: int
    """Own steps that became packets."""
    resent: int
    """Packets sent again because a teammate asked."""
    requested: int
    """Requests sent."""
    received: int
    """Packets received."""
    taken: int
    """Received packets that are part of the estimate."""
    reordered: int
    """Received packets that arrived after a later packet of the same sender."""
    repeated: int
    """Received packets that had been received before."""
    own: int
    """Received packets that were own packets."""
    ignored: int
    """Received packets that were not for this vehicle or its mode."""
    unknown: int
    """Received packets whose sender is not in the team."""
    past: int
    """Received packets whose time does not agree with their number."""
    ahead: int
    """Received packets that were too far ahead."""
    conflict: int
    """Received packets that contradict a packet that was received before."""
    full: int
    """Received packets that found no room to wait."""
    foreign: int
    """Received packets that were not packets of a team."""
    version: int
    """Received packets of another version."""
    cut: int
    """Received packets with bytes missing, or too many."""
    corrupt: int
    """Received packets with a wrong checksum."""
    nonsense: int
    """Received packets that were complete, but not a valid step."""
    lost: int
    """Packets that never arrived and were given up after max_lag."""
    matched: int
    """Observations, own and teammates', that updated a landmark."""
    placed: int
    """Observations that placed a new landmark."""
    rejected: int
    """Observations that were refused."""
    sightings_used: int
    """Sightings of vehicles that were used."""
    sightings_refused: int
    """Sightings of vehicles that were refused: the pose of the seen vehicle is unknown, or it has no step at this
    time."""
    vehicles_found: int
    """Starts solved from mutual sightings."""
    failed: int
    """Motions and scans by which the filter could not be updated."""
    scored: int
    """Calls of Team.score."""
    scored_nees: int
    """Scored steps with a covariance that is not singular (at a known start it is singular): the steps of
    `anees_per_dof`."""
    position_rmse: float
    """Root mean square position error of this vehicle, m."""
    anees_per_dof: float
    """Average NEES of its pose over the degrees of freedom: 1 for an honest covariance."""
    claimed_improvement: float
    """(||C_mono|| - ||C||) / ||C_mono||: Frobenius norms of the position's covariance, summed over all scored steps
    (cooperative paper, section 3); 0 without `baseline`."""
    true_improvement: float
    """1 - MSE / MSE_mono of the position; 0 without `baseline`."""


class WorldOptions(TypedDict, total=False):
    """Options of World. The defaults are Table 1 of the paper, with the open choices filled in."""

    course: Course | Literal["circle", "laps", "traverse"]
    """Course; default Course.CIRCLE."""
    seed: int
    """Seed of all random draws; default 1."""
    landmarks: int
    """Number of landmarks, 1 to 10000000; default 200 (Table 1). The length of laps and traverse follows from it."""
    terrain: Terrain | Literal["rolling", "waves", "flat"]
    """Terrain; default Terrain.ROLLING."""
    contact: Contact | Literal["wheels", "point"]
    """Contact; default Contact.WHEELS."""
    drive: Drive | Literal["twist", "wheels_gyro"]
    """Drive; default Drive.TWIST."""
    accelerometer: Accelerometer | Literal["velocity", "acceleration"]
    """Accelerometer; default Accelerometer.VELOCITY."""
    stick_noise: Stick | Literal["per_observation", "per_frame"]
    """CAIRN_STICK_...; default Stick.PER_OBSERVATION."""
    observe_at_start: bool
    """1: step 0, the known start, has a frame, too; default 0: the first frame comes one frame period later."""
    traverse_closed: bool
    """1: the circles of the traverse lie on one big ring, and the drive ends with a round of the first circle; this
    needs at least 1600 landmarks at the default strip and area; default 0."""
    speed: float
    """Speed over the xy plane, m/s, > 0; default 2 pi hypot(100, 20) / 400: the default circle in 400 s (Table 1)"""
    laps: float
    """Rounds of circle and laps, > 0; 0, the default: 1 round of a circle, 2 rounds of laps. Not used by a traverse."""
    centre: ArrayLike
    """Centre of the circle, x and y, m; default the origin (not in the paper)"""
    radius: float
    """Radius of the circle, m, > strip; 0, the default: hypot(100, 20) landmarks / 200. With it the default start
    is (100, 20) as in Table 1, and the density of landmarks does not depend on their number."""
    start_azimuth: float
    """Azimuth of the start as seen from the centre of the circle, rad; default atan2(20, 100)"""
    round_length: float
    """Circumference of the circles of the traverse, m, > 0; default 1500. They are scaled so that all landmarks are
    used."""
    round_variation: float
    """Share by which the seed varies this length, [0, 0.3]; default 0.1."""
    strip: float
    """Landmarks lie within this distance of the course, m, > 0; default 25."""
    landmark_area: float
    """Area of ground for each landmark of laps and traverse, m^2, > 0; default 160."""
    landmark_height: float
    """Landmarks are between 0 and this height above the ground, m, >= 0; default 1.5."""
    max_slope: float
    """Largest slope of the rolling ground, rad, [0, 45 degrees]; default 15 degrees."""
    wavelength: ArrayLike
    """Shortest and longest wave of the rolling ground, m, > 0; default 25 and 150."""
    start_height: float
    """Height of the rolling ground at (100, 20), m; default -0.3174 (Table 1)"""
    wheel_radius: float
    """m, > 0; default 0.3 (Table 1)"""
    track: float
    """Distance between left and right wheels, m, > 0; default 1.0 (not in the paper)"""
    wheelbase: float
    """Distance between front and rear wheels, m, > 0; default 1.2 (not in the paper)"""
    velocity_sigma: float
    """White noise per sample and axis, m/s or m/s^2 (`accelerometer`), >= 0; default 2e-3 (Table 1)"""
    rate_sigma: float
    """White noise of the gyro per sample and axis, rad/s, >= 0; default 0.02 degrees/s (Table 1)"""
    gravity: float
    """m/s^2, >= 0; default 3.71. Only Accelerometer.ACCELERATION uses it."""
    wheel_rate_sigma: float
    """White noise of each side's wheel rate per sample, rad/s, >= 0; default 0.01."""
    wheel_slip_sigma: float
    """White noise of each side's wheel rate in proportion to this rate, >= 0; default 0.02."""
    lateral_sigma: float
    """Noise that a step states for the velocity along y, which wheels do not measure, m/s, >= 0; default 0.01."""
    vertical_sigma: float
    """The same along z, m/s, >= 0; default 0.01."""
    imu_period: float
    """Period of IMU and wheel samples, s, > 0; default 0.05: 20 Hz (Table 1)"""
    motion_period: float
    """Period of the motion samples in a step, s: a multiple of imu_period. IMU samples are composed into one motion
    sample. Default 0.2, the sampling period of Table 1."""
    frame_period: float
    """Period of the camera, s: a multiple of motion_period; default 2: 0.5 Hz (Table 1)"""
    range_sigma: float
    """Noise of a range, m, > 0; default 1 (Table 1)"""
    azimuth_sigma: float
    """Noise of an azimuth, rad, > 0; default 3 degrees (Table 1)"""
    stick_sigma: float
    """Noise of the stick angle, rad, > 0; default 3 degrees (Table 1)"""
    image_sigma: float
    """Noise of each elevation with Stick.PER_FRAME, rad, > 0; default 0.5 degrees."""
    near_range: float
    """Shortest distance at which the camera sees a landmark, m, > 0; default 2 (not in the paper)"""
    far_range: float
    """Longest such distance, m, > near_range; default 40 (not in the paper)"""
    half_azimuth: float
    """Largest azimuth from the axis of the camera, rad, (0, pi]; default 60 degrees (not in the paper)"""
    pan_amplitude: float
    """The head scans: pan = amplitude sin(2 pi t / period), rad, [0, pi]; default 0: fixed forward."""
    pan_period: float
    """s, > 0; default 20."""
    stick_amplitude: float
    """The same for the stick, rad, [0, 60 degrees]; default 0."""
    stick_period: float
    """s, > 0; default 26."""
    platform: ArrayLike
    """d of StereoHead, m; default 0 (not in the paper)"""
    stick: ArrayLike
    """s of StereoHead, m; default 0 (not in the paper)"""
    velocity_bias: ArrayLike
    """Systematic errors of the rover, which World.head and World.wheels do not tell (docs/systematic_errors.md).
    Added to the measured body velocity, m/s; default 0; the wheels turn faster by the first component."""
    rate_bias: ArrayLike
    """Added to the rate of the gyro, rad/s; default 0."""
    wheel_scale: ArrayLike
    """Left and right: a wheel turns at its measured rate times 1 + this, > -1; default 0."""
    mount_turn: ArrayLike
    """Rotation vector by which the head is turned about the origin of the body, rad; default 0."""
    mount_shift: ArrayLike
    """By which the head is shifted after that, m; default 0."""
    value_offset: ArrayLike
    """Added to the observed range (m), azimuth and elevation (rad); default 0."""


@dataclasses.dataclass
class WorldStep:
    """A step: the motion samples since the previous step (World.motions), then one frame (World.observations)."""

    number: int
    """Counted from 0; step 0 is the start."""
    time: float
    """s, from 0."""
    truth: Pose
    """True pose of the body in the map at the end of the step."""
    velocity_sigma: NDArray[np.float64]
    """Noise of the `velocity` of each motion sample, for TwistNoise. The drift of an accelerometer is stated by its
    size at this time, as if it were white noise."""
    rate_sigma: NDArray[np.float64]
    """Noise of the `rate` of each motion sample."""
    pan: float
    """Pan angle of the head, from its encoder, rad."""
    stick: float
    """Stick angle of the head, from its encoder, rad."""


class FleetOptions(TypedDict, total=False):
    """Options of Fleet. The defaults are the figures of the paper, with the open choices filled in."""

    layout: FleetLayout | Literal["uniform", "coast"]
    """FleetLayout; default FleetLayout.UNIFORM."""
    seed: int
    """Seed of all random draws; default 1."""
    vehicles: int
    """Number of boats, 1 to 64; default 2 (paper)"""
    features: int
    """Number of features, 1 to 100000; default 10 (paper: 6, 10, 40)"""
    area: float
    """Side of the square, m, > 0; default 10000 (paper)"""
    separation: float
    """Distance between neighbours at the start, m, > 0, at most half of `area`; default 1500 (not in the paper).
    Three or more boats may be closer: see Fleet."""
    course_length: float
    """Circumference of each boat's circle, m, > 0, at most `area`; default 1700 (paper)"""
    duration: float
    """Duration of one round, which is the whole drive, s, > 0; default 1500 (paper)"""
    period: float
    """Period of the radars, s, > 0, at most `duration`; default 5 (not in the paper)"""
    radar_range: float
    """Range of the radars, m, > 0; default 5000 (paper)"""
    range_sigma: float
    """Noise of a range, m, >= 0; default 30 (not in the paper)"""
    bearing_sigma: float
    """Noise of a bearing, rad, >= 0; default 0.3 degrees (not in the paper)"""
    speed_sigma: float
    """Difference between executed and commanded speed: white noise, one draw a period, m/s, >= 0; default 0.2 (not
    in the paper)"""
    rate_sigma: float
    """The same for the rate of turn, rad/s, >= 0; default 0.1 degrees/s (not in the paper)"""
    coast_distance: float
    """Distance of the mean coast line north of the origin, as a share of `area`, (0, 0.5]; default 0.35 (not in the
    paper)"""
    coast_relief: float
    """Largest deviation of the coast line from its mean, as a share of `area`, [0, 0.5 - coast_distance]; default
    0.05 (not in the paper)"""
    coast_strip: float
    """Width of the strip of water that holds the features, as a share of `area`, [0, 0.5]; default 0.03 (not in the
    paper). Only FleetLayout.COAST uses it."""


@dataclasses.dataclass
class FleetStep:
    """A step: all boats move, then all boats scan."""

    number: int
    """Counted from 0; step 0 is a scan at the start, before any motion."""
    time: float
    """s, from 0."""
    dt: float
    """Since the step before, s: `period`, or 0 at step 0."""
