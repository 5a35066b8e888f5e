function radar = range_bearing(varargin)
% radar = cairn.range_bearing(Name, Value, ...)
% Radar, lidar or sonar of a planar vehicle: `z = (range, bearing)` of the landmark in the sensor's frame, m and rad,
% positive to the left.
%
%   T_body_sensor: sensor in the body, in the plane; default identity
%   range_sigma: m, > 0; default 0.1
%   bearing_sigma: rad, > 0; default 0.01
%   near_range: an observation is refused if the predicted range, or the observed range of a new landmark, is below
%     this, m, > 0; default 0.01
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
radar = cairn_mex('range_bearing_init');
radar = cairn.internal.overlay(radar, varargin, 'range_bearing');
end
