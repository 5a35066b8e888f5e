function [options, submap_landmarks] = world_options_preset(options, preset)
% [options, submap_landmarks] = cairn.world_options_preset(options, preset)
% `submap_landmarks` (or []) gets the size of submaps that belongs to the preset: 40, or 20 for rows 3 and 4.
%
%   options: struct: course, seed, landmarks, terrain, contact, drive, accelerometer, stick_noise, observe_at_start,
%     traverse_closed, speed, laps, centre, radius, start_azimuth, round_length, round_variation, strip, landmark_area,
%     landmark_height, max_slope, wavelength, start_height, wheel_radius, track, wheelbase, velocity_sigma, rate_sigma,
%     gravity, wheel_rate_sigma, wheel_slip_sigma, lateral_sigma, vertical_sigma, imu_period, motion_period,
%     frame_period, range_sigma, azimuth_sigma, stick_sigma, image_sigma, near_range, far_range, half_azimuth,
%     pan_amplitude, pan_period, stick_amplitude, stick_period, platform, stick, velocity_bias, rate_bias, wheel_scale,
%     mount_turn, mount_shift, value_offset
%   preset: cairn.Preset
%   options: struct: course, seed, landmarks, terrain, contact, drive, accelerometer, stick_noise, observe_at_start,
%     traverse_closed, speed, laps, centre, radius, start_azimuth, round_length, round_variation, strip, landmark_area,
%     landmark_height, max_slope, wavelength, start_height, wheel_radius, track, wheelbase, velocity_sigma, rate_sigma,
%     gravity, wheel_rate_sigma, wheel_slip_sigma, lateral_sigma, vertical_sigma, imu_period, motion_period,
%     frame_period, range_sigma, azimuth_sigma, stick_sigma, image_sigma, near_range, far_range, half_azimuth,
%     pan_amplitude, pan_period, stick_amplitude, stick_period, platform, stick, velocity_bias, rate_bias, wheel_scale,
%     mount_turn, mount_shift, value_offset
%   submap_landmarks: integer
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
[options, submap_landmarks] = cairn_mex('world_options_preset', options, preset);
end
