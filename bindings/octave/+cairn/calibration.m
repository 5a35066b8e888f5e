function calibration = calibration(varargin)
% calibration = cairn.calibration(Name, Value, ...)
% Systematic errors of one sensor. A standard deviation at the start that is 0 (the default) means: no state. A random
% walk is that in the square root of a second; it needs its standard deviation. The sensor works as if the body were at
% T_map_body E, E = (Exp(turn), shift); an observed value is the predicted one plus its offset.
%
%   mount_shift_sigma: x, y, z, m, >= 0; default 0. A planar vehicle has only x and y
%   mount_shift_walk: >= 0; default 0
%   mount_turn_sigma: rotation vector, rad, >= 0; default 0. A planar vehicle has only z
%   mount_turn_walk: >= 0; default 0
%   offset_sigma: of each value of an observation, in its unit, >= 0; default 0
%   offset_walk: >= 0; default 0
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
calibration = cairn_mex('calibration_init');
calibration = cairn.internal.overlay(calibration, varargin, 'calibration');
end
