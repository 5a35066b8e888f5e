function options = world_options(varargin)
% options = cairn.world_options(Name, Value, ...)
% Options of cairn.World.
%
%   course: CAIRN_COURSE_...; default cairn.Course.CIRCLE
%   seed: seed of all random draws; default 1
%   landmarks: number of landmarks, 1 to 10000000; default 200 (Table 1). The length of laps and traverse follows from
%     it
%   terrain: CAIRN_TERRAIN_...; default cairn.Terrain.ROLLING
%   contact: CAIRN_CONTACT_...; default cairn.Contact.WHEELS
%   drive: CAIRN_DRIVE_...; default cairn.Drive.TWIST
%   accelerometer: CAIRN_ACCELEROMETER_...; default cairn.Accelerometer.VELOCITY
%   stick_noise: CAIRN_STICK_...; default cairn.Stick.OBSERVATION
%   observe_at_start: 1: step 0, the known start, has a frame, too; default 0: the first frame comes one frame period
%     later
%   traverse_closed: 1: the circles of the traverse lie on one big ring, and the drive ends with a round of the first
%     circle; this needs at least 1600 landmarks at the default strip and area; default 0
%   speed: speed over the xy plane, m/s, > 0; default 2 pi hypot(100, 20) / 400: the default circle in 400 s (Table 1)
%   laps: rounds of circle and laps, > 0; 0, the default: 1 round of a circle, 2 rounds of laps. Not used by a traverse
%   centre: centre of the circle, x and y, m; default the origin (not in the paper)
%   radius: radius of the circle, m, > strip; 0, the default: hypot(100, 20) landmarks / 200. With it the default start
%     is (100, 20) as in Table 1, and the density of landmarks does not depend on their number
%   start_azimuth: azimuth of the start as seen from the centre of the circle, rad; default atan2(20, 100)
%   round_length: circumference of the circles of the traverse, m, > 0; default 1500. They are scaled so that all
%     landmarks are used
%   round_variation: share by which the seed varies this length, [0, 0.3]; default 0.1
%   strip: landmarks lie within this distance of the course, m, > 0; default 25
%   landmark_area: area of ground for each landmark of laps and traverse, m^2, > 0; default 160
%   landmark_height: landmarks are between 0 and this height above the ground, m, >= 0; default 1.5
%   max_slope: largest slope of the rolling ground, rad, [0, 45 degrees]; default 15 degrees
%   wavelength: shortest and longest wave of the rolling ground, m, > 0; default 25 and 150
%   start_height: height of the rolling ground at (100, 20), m; default -0.3174 (Table 1)
%   wheel_radius: m, > 0; default 0.3 (Table 1)
%   track: distance between left and right wheels, m, > 0; default 1.0 (not in the paper)
%   wheelbase: distance between front and rear wheels, m, > 0; default 1.2 (not in the paper)
%   velocity_sigma: white noise per sample and axis, m/s or m/s^2 (`accelerometer`), >= 0; default 2e-3 (Table 1)
%   rate_sigma: white noise of the gyro per sample and axis, rad/s, >= 0; default 0.02 degrees/s (Table 1)
%   gravity: m/s^2, >= 0; default 3.71. Only cairn.Accelerometer.ACCELERATION uses it
%   wheel_rate_sigma: white noise of each side's wheel rate per sample, rad/s, >= 0; default 0.01
%   wheel_slip_sigma: white noise of each side's wheel rate in proportion to this rate, >= 0; default 0.02
%   lateral_sigma: noise that a step states for the velocity along y, which wheels do not measure, m/s, >= 0; default
%     0.01
%   vertical_sigma: the same along z, m/s, >= 0; default 0.01
%   imu_period: period of IMU and wheel samples, s, > 0; default 0.05: 20 Hz (Table 1)
%   motion_period: period of the motion samples in a step, s: a multiple of imu_period. IMU samples are composed into
%     one motion sample. Default 0.2, the sampling period of Table 1
%   frame_period: period of the camera, s: a multiple of motion_period; default 2: 0.5 Hz (Table 1)
%   range_sigma: noise of a range, m, > 0; default 1 (Table 1)
%   azimuth_sigma: noise of an azimuth, rad, > 0; default 3 degrees (Table 1)
%   stick_sigma: noise of the stick angle, rad, > 0; default 3 degrees (Table 1)
%   image_sigma: noise of each elevation with cairn.Stick.FRAME, rad, > 0; default 0.5 degrees
%   near_range: shortest distance at which the camera sees a landmark, m, > 0; default 2 (not in the paper)
%   far_range: longest such distance, m, > near_range; default 40 (not in the paper)
%   half_azimuth: largest azimuth from the axis of the camera, rad, (0, pi]; default 60 degrees (not in the paper)
%   pan_amplitude: the head scans: pan = amplitude sin(2 pi t / period), rad, [0, pi]; default 0: fixed forward
%   pan_period: s, > 0; default 20
%   stick_amplitude: the same for the stick, rad, [0, 60 degrees]; default 0
%   stick_period: s, > 0; default 26
%   platform: d of cairn.stereo_head, m; default 0 (not in the paper)
%   stick: s of cairn.stereo_head, m; default 0 (not in the paper)
%   velocity_bias: systematic errors of the rover, which cairn.World.head and cairn.World.wheels do not tell
%     (docs/systematic_errors.md). Added to the measured body velocity, m/s; default 0; the wheels turn faster by the
%     first component
%   rate_bias: added to the rate of the gyro, rad/s; default 0
%   wheel_scale: left and right: a wheel turns at its measured rate times 1 + this, > -1; default 0
%   mount_turn: rotation vector by which the head is turned about the origin of the body, rad; default 0
%   mount_shift: by which the head is shifted after that, m; default 0
%   value_offset: added to the observed range (m), azimuth and elevation (rad); default 0
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
options = cairn_mex('world_options_init');
options = cairn.internal.overlay(options, varargin, 'world_options');
end
