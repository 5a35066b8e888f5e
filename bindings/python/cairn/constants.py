# SPDX-License-Identifier: BSD-3-Clause
# Written by generate.py from the description of the C interface: do not edit.
"""The constants of the C interface, as enumerations. An option takes a member, its value, or its name as a word:
join=Join.SPARSE, join=2 and join="sparse" are the same."""

import enum

__all__ = ["Accelerometer", "Association", "ClosedBy", "Contact", "Course", "Distance", "Doubts", "Drive", "Encoder",
           "FleetLayout", "ID_NONE", "Join", "Loss", "MapForm", "MergeBy", "NoiseLearning", "Packet", "Preset",
           "Reason", "Result", "StateError", "Status", "Stick", "Systematic", "TeamMode", "Terrain", "Vehicle",
           "Verdict", "Yaw"]

ID_NONE = 18446744073709551615
"""The id that no landmark has."""


class Status(enum.IntEnum):
    """Status of every fallible call: 0 is success, a negative value an error. A value never changes its meaning. A
    refused observation is not an error: its MATCH reports the refusal."""

    OK = 0
    """Success."""
    ERROR_ARGUMENT = -1
    """An argument is None, not finite, out of range or not a covariance."""
    ERROR_BUFFER = -2
    """The caller's buffer is too short; `*needed` holds the size that is necessary."""
    ERROR_CAPACITY = -3
    """a capacity set at creation is exhausted (landmarks, observations, sensors)"""
    ERROR_NOT_FOUND = -4
    """No landmark, sensor or vehicle has this id."""
    ERROR_NUMERICAL = -5
    """a covariance would lose positive definiteness, or a result is not finite."""
    ERROR_MEMORY = -6
    """There is not enough memory."""
    ERROR_STATE = -7
    """The handle is in a state that does not allow this call."""
    ERROR_INTERNAL = -8
    """a defect of the library; please report it."""
    ERROR_CALLBACK = -9
    """a callback of the caller returned a negative value and so aborted the call."""


class MapForm(enum.IntEnum):
    """How a map holds the joint uncertainty of its landmarks. Only maps of the same kind can be merged."""

    DENSE = 0
    """Positions and their joint covariance: a single map, or densely joined submaps."""
    SPARSE = 1
    """Submaps and the factor of their information: sparsely joined submaps."""


class MergeBy(enum.IntEnum):
    """How Map.merge finds the landmarks that both maps hold, the common landmarks."""

    ID = 0
    """Landmarks with the same id."""
    GEOMETRY = 1
    """Landmarks that lie in the same way relative to each other; ids are ignored."""


class Yaw(enum.IntEnum):
    """Sign of the yaw rate that follows from two wheel rates."""

    RIGHT_MINUS_LEFT = 0
    """z up: the vehicle turns left (positive yaw rate) when the right wheels turn faster; the default."""
    LEFT_MINUS_RIGHT = 1
    """z down: eq. 1 as printed in the Mars paper."""


class Encoder(enum.IntEnum):
    """How the noise of the two encoders of a head enters (StereoHead)."""

    PER_OBSERVATION = 0
    """The head moves between observations: each has independent noise; the default."""
    PER_FRAME = 1
    """The head stands still: all observations of a frame have the same encoder error."""


class Loss(enum.IntEnum):
    """Loss of a residual at the distance d, in standard deviations (docs/update.md, "Robust losses")."""

    NONE = 0
    """d^2 / 2: least squares; the default."""
    HUBER = 1
    """d^2 / 2 up to the width k, k d - k^2 / 2 beyond: the influence of an observation is bounded."""
    CAUCHY = 2
    """c^2 / 2 log(1 + d^2 / c^2): the influence falls with the distance, and gross outliers have nearly none."""


class Result(enum.IntEnum):
    """Result of an observation."""

    MATCHED = 1
    """It updated the landmark."""
    NEW = 2
    """It placed a new landmark, or placed a landmark again that had been placed wrongly; then `distance` and
    `threshold` are those of its test against the former place."""
    REJECTED = 3
    """It was refused and changed nothing; `reason` says why."""


class Reason(enum.IntEnum):
    """Why an observation was refused."""

    NONE = 0
    """It was not refused."""
    GATE = 1
    """Its distance exceeds the threshold of the gate of one observation (chi-square)"""
    BATCH_GATE = 2
    """It passed its own gate, but was removed so that the whole batch passes the batch gate."""
    NO_IMAGE = 3
    """The estimated landmark cannot give an observation: behind the lens, too near, too steep."""
    NO_PLACE = 4
    """The observation cannot place a landmark: disparity or range too small, range too large beside its noise, or
    the sensor never places landmarks."""
    AMBIGUOUS = 5
    """Unknown ids: it passed its own gate, but the best set of pairs does not contain it."""
    NO_ROOM = 6
    """The observation could place a landmark, but the map is full."""
    CONTRADICTED = 7
    """The observation could place a landmark, but most of what is seen contradicts the pose: nothing is placed
    until it is decided what is wrong."""


class StateError(enum.IntEnum):
    """Error of the state that the filter's covariance describes (docs/invariant_error.md)."""

    INVARIANT = 0
    """Right-invariant error on SE_{K+1}(3): consistent; the default."""
    STANDARD = 1
    """Separate errors of position, attitude and landmarks: standard EKF-SLAM, for comparison."""


class Vehicle(enum.IntEnum):
    """Space in which the vehicle moves (docs/plane.md). The interface of a planar vehicle is the same as that of a
    spatial one: the vehicle lies in z = 0 and turns about z. The filter reads only the rows and columns of x, y and
    yaw of covariances and Jacobians that it gets. Covariances that it returns have zeros elsewhere."""

    SPATIAL = 0
    """Six degrees of freedom; the default."""
    PLANAR = 1
    """x, y and heading; landmarks x and y."""


class Join(enum.IntEnum):
    """How a closed submap joins the map (docs/submaps.md)."""

    AUTO = 0
    """Dense if max_landmarks is at most 100, sparse otherwise; the default."""
    DENSE = 1
    """a filter with the covariance of the whole map: a closing costs O(n^2) for n states of the map."""
    SPARSE = 2
    """Solves for all submaps together on a sparse factor and relinearises them: the total cost is nearly linear."""


class Association(enum.IntEnum):
    """How the filter finds the landmark of an observation (docs/association.md)."""

    KNOWN = 0
    """By the id of the observation; the default."""
    NEAREST = 1
    """Nearest neighbour by Mahalanobis distance; each landmark is matched at most once in a frame. Ids of
    observations are ignored, and landmarks are numbered from 0 in the order in which they are placed."""
    JOINT = 2
    """The largest set of pairs that are jointly compatible (branch and bound); ids as for Association.NEAREST."""


class Distance(enum.IntEnum):
    """Distance by which Association.NEAREST chooses among landmarks."""

    MAHALANOBIS = 0
    """The squared Mahalanobis distance d^2; the default."""
    LIKELIHOOD = 1
    """d^2 + log det S, which is -2 log of the likelihood: if two landmarks have the same d^2, the better known one
    is chosen. The gates still use d^2."""


class NoiseLearning(enum.IntEnum):
    """What becomes of the noise that the filter learns from its innovations (docs/trust.md)."""

    REPORTED = 0
    """Filter.health reports it; the default."""
    APPLIED = 1
    """From when it is known, it scales the stated noise of each sensor and of the motion."""


class ClosedBy(enum.IntEnum):
    """Why a submap was closed."""

    NONE = 0
    """No submap was closed yet."""
    CALLER = 1
    """Filter.close_submap."""
    LANDMARKS = 2
    """Submap_landmarks."""
    DISTANCE = 3
    """Submap_distance."""
    EXTENT = 4
    """Submap_extent."""
    SIGMA = 5
    """Submap_sigma."""
    FIX = 6
    """An absolute position, attitude or heading could not be taken in otherwise."""


class Verdict(enum.IntEnum):
    """The verdict on a filter."""

    GOOD = 0
    """What is seen agrees with the estimate and with the stated noise."""
    DOUBTFUL = 1
    """Something does not agree; the reasons say what."""
    LOST = 2
    """Most of what is seen contradicts the estimate."""


class Doubts(enum.IntFlag):
    """The reasons of a verdict, one bit each."""

    NIS = 1
    """The normalised innovations of the window lie above their band."""
    REFUSALS = 2
    """The gates refuse more than they refuse of honest observations."""
    WIDENED = 4
    """The motion was widened, because most of what was seen contradicted it."""
    SENSOR_NOISE = 8
    """a sensor's noise is more than 1.5 times what is stated."""
    MOTION_NOISE = 16
    """The motion's noise is clearly more than what is stated."""
    BIAS = 32
    """The corrections of the pose have a mean: the motion has a constant error."""
    JUMP = 64
    """a frame contradicts the motion since the last frame: a slip, or another place."""
    LANDMARKS = 128
    """Single landmarks contradict the rest: moved, or under a wrong id."""
    CLOSING = 256
    """a closed submap contradicted the map."""
    BLIND = 512
    """Directions of the pose about which the last frames say nothing."""
    DEFINITE = 1024
    """The covariance of the pose is not positive semidefinite."""


class Systematic(enum.IntEnum):
    """Kinds of systematic errors."""

    VELOCITY_BIAS = 0
    """Of the measured body velocity, m/s; components x, y, z."""
    RATE_BIAS = 1
    """Of the measured body rate, rad/s; components x, y, z."""
    WHEEL_SCALE = 2
    """Of a wheel's measured rate; components left and right."""
    MOUNT_SHIFT = 3
    """Of a sensor against the body, m; components x, y, z."""
    MOUNT_TURN = 4
    """Of a sensor about the origin of the body: a rotation vector, rad."""
    OFFSET = 5
    """Of the values of a sensor's observations, in their units."""


class TeamMode(enum.IntEnum):
    """Mode: how a vehicle uses the packets of its teammates."""

    MONO = 0
    """It ignores them; for comparison."""
    EO_DIAGONAL = 1
    """Extended observations with independent noise, as printed in the cooperative paper: overconfident, and more so
    with more landmarks."""
    EO_FULL = 2
    """Extended observations with the noise that all observations of a scan share through the sighting."""
    JOINT = 3
    """Every vehicle runs the same filter over all poses and all landmarks; the default."""
    SUBMAPS = 4
    """Every vehicle works in its own submaps, which are fused by their common landmarks; sightings between vehicles
    are not used."""


class Packet(enum.IntEnum):
    """Result of a received packet."""

    TAKEN = 1
    """It had its turn and is part of the estimate."""
    WAITING = 2
    """It waits for its turn."""
    REQUEST = 3
    """a teammate misses own packets; they are queued to be sent again."""
    LEAVE = 4
    """a teammate leaves the team when this packet has its turn."""
    REPEATED = 5
    """It was received before."""
    OWN = 6
    """It is an own packet that came back."""
    IGNORED = 7
    """The mode does not use it, or it is for another vehicle."""
    UNKNOWN = 8
    """Its sender is not in the team."""
    PAST = 9
    """Its time does not agree with its number."""
    CONFLICT = 10
    """a different packet of this sender with this number was received before: two vehicles have the same number."""
    FULL = 11
    """Max_waiting packets of this sender wait already."""
    FOREIGN = 12
    """It is not a packet of a team."""
    VERSION = 13
    """This library does not read its version."""
    CUT = 14
    """Bytes are missing, or there are too many."""
    CORRUPT = 15
    """Its checksum is wrong."""
    NONSENSE = 16
    """It is complete, but not a valid step: values that are not finite, noise that is not a covariance, an id or a
    number twice, numbers of absurd size."""
    AHEAD = 17
    """Its time is more than max_jump after that of the sender's packet before it. The next packet of the sender
    decides: if it agrees with this one, both are right, and this one can be received again."""


class Course(enum.IntEnum):
    """Courses. On each the rover has a constant speed over the xy plane of the map."""

    CIRCLE = 0
    """The course of the paper: a circle, driven anticlockwise; the default."""
    LAPS = 1
    """a wandering closed curve, driven several times."""
    TRAVERSE = 2
    """a long drive: a chain of circles, alternately left and right. Each circle is driven 1.25 times before the
    next one is entered where both touch. So each circle closes a loop, and a quarter of it is seen again."""


class Terrain(enum.IntEnum):
    """Ground."""

    ROLLING = 0
    """Seeded smooth hills, shifted to `start_height` at (100, 20); the default."""
    WAVES = 1
    """z = sin(x / 15) + 0.8 cos(y / 12); the same for every seed; not shifted."""
    FLAT = 2
    """z = 0."""


class Contact(enum.IntEnum):
    """How the rover stands on the ground. Seen from above, its x axis points along the course."""

    WHEELS = 0
    """On four wheels; a differential averages the left and the right rocker. All four wheels touch the ground, and
    height and attitude are those of the chassis between them; the default."""
    POINT = 1
    """At one point; its z axis is the normal of the ground."""


class Drive(enum.IntEnum):
    """Measurements that the motion samples of a step hold as `velocity` and `rate`."""

    TWIST = 0
    """Body velocity and body rate from the IMU; the default."""
    WHEELS_GYRO = 1
    """Forward velocity from the wheels (Mars paper, eq. 1), zero along y and z; body rate from the gyro."""


class Accelerometer(enum.IntEnum):
    """Noise of the accelerometer. Table 1 of the paper gives it in m/s."""

    VELOCITY = 0
    """White noise of the body velocity, m/s a sample; the default."""
    ACCELERATION = 1
    """White noise of the acceleration, m/s^2 a sample: the velocity comes from dead reckoning of specific force and
    rate from a known start, and drifts."""


class Stick(enum.IntEnum):
    """How the noise of the stick angle enters."""

    PER_OBSERVATION = 0
    """Independent in each observation's elevation; the default."""
    PER_FRAME = 1
    """All observations of a frame share one encoder error; the image adds noise of `image_sigma` to each elevation."""


class Preset(enum.IntEnum):
    """Worlds for measurements. In the rows, velocity and rate noise are those of a sample of 0.2 s. The rows use
    Terrain.WAVES, Contact.POINT and a radius of 101.98 m."""

    PAPER = 0
    """The defaults: Table 1 as printed."""
    ROW1 = 1
    """0.002 m/s, 0.02 degrees/s, 1 lap in 400 s."""
    ROW2 = 2
    """0.05 m/s, 0.2 degrees/s, 1 lap in 400 s."""
    ROW3 = 3
    """0.05 m/s, 0.2 degrees/s, 2 laps in 400 s."""
    ROW4 = 4
    """0.2 m/s, 1 degree/s, 2 laps in 400 s."""


class FleetLayout(enum.IntEnum):
    """Where the features are. Both layouts have the coast line, but the radars see only features."""

    UNIFORM = 0
    """Uniform in the square, on both sides of the coast line; the default."""
    COAST = 1
    """Along the coast line, in a strip of width `coast_strip` south of it. The coast line runs north of the boats,
    from the western side of the square to the eastern side."""
