function wheels = wheels(varargin)
% wheels = cairn.wheels(Name, Value, ...)
% Four-wheel differential drive; both wheels of a side turn at the same rate (Mars paper, eq. 1): `v_x = r (w_left +
% w_right) / 2`, `w_z = +-(r / B) (w_right - w_left)`. The model has no motion along y and z and no roll and pitch rate.
% Noise is white; each call is one sample with the standard deviations below.
%
%   yaw_sign: cairn.Yaw.RIGHT_MINUS_LEFT or cairn.Yaw.LEFT_MINUS_RIGHT; default cairn.Yaw.RIGHT_MINUS_LEFT
%   radius: r, m, > 0; default 0.3
%   track: B, distance between left and right wheels, m, > 0; default 1.0
%   rate_sigma: noise of each side's wheel rate, rad/s, >= 0; default 0.01
%   slip_sigma: noise of each side's wheel rate in proportion to this rate, >= 0; default 0.02
%   lateral_sigma: side slip: noise of the velocity along y, m/s, >= 0; default 0.01
%   vertical_sigma: noise of the velocity along z, m/s, >= 0; default 0.01
%   roll_rate_sigma: noise of the roll rate, which is not measured, rad/s, >= 0; default 0.05
%   pitch_rate_sigma: noise of the pitch rate, which is not measured, rad/s, >= 0; default 0.05
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
wheels = cairn_mex('wheels_init');
wheels = cairn.internal.overlay(wheels, varargin, 'wheels');
end
