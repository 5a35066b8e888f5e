function options = fleet_options(varargin)
% options = cairn.fleet_options(Name, Value, ...)
% Options of cairn.Fleet.
%
%   layout: CAIRN_FLEET_...; default cairn.FleetLayout.UNIFORM
%   seed: seed of all random draws; default 1
%   vehicles: number of boats, 1 to 64; default 2 (paper)
%   features: number of features, 1 to 100000; default 10 (paper: 6, 10, 40)
%   area: side of the square, m, > 0; default 10000 (paper)
%   separation: distance between neighbours at the start, m, > 0, at most half of `area`; default 1500 (not in the
%     paper). Three or more boats may be closer: see cairn.Fleet
%   course_length: circumference of each boat's circle, m, > 0, at most `area`; default 1700 (paper)
%   duration: duration of one round, which is the whole drive, s, > 0; default 1500 (paper)
%   period: period of the radars, s, > 0, at most `duration`; default 5 (not in the paper)
%   radar_range: range of the radars, m, > 0; default 5000 (paper)
%   range_sigma: noise of a range, m, >= 0; default 30 (not in the paper)
%   bearing_sigma: noise of a bearing, rad, >= 0; default 0.3 degrees (not in the paper)
%   speed_sigma: difference between executed and commanded speed: white noise, one draw a period, m/s, >= 0; default 0.2
%     (not in the paper)
%   rate_sigma: the same for the rate of turn, rad/s, >= 0; default 0.1 degrees/s (not in the paper)
%   coast_distance: distance of the mean coast line north of the origin, as a share of `area`, (0, 0.5]; default 0.35
%     (not in the paper)
%   coast_relief: largest deviation of the coast line from its mean, as a share of `area`, [0, 0.5 - coast_distance];
%     default 0.05 (not in the paper)
%   coast_strip: width of the strip of water that holds the features, as a share of `area`, [0, 0.5]; default 0.03 (not
%     in the paper). Only cairn.FleetLayout.COAST uses it
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
options = cairn_mex('fleet_options_init');
options = cairn.internal.overlay(options, varargin, 'fleet_options');
end
