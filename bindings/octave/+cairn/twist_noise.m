function noise = twist_noise(varargin)
% noise = cairn.twist_noise(Name, Value, ...)
% Noise of measured body velocity and body rate (IMU, visual odometry). It is white, with a standard deviation per
% sample and axis (x, y, z of the body). Mars paper, eq. 2, integrated on the group: `T <- T Exp([v; w] dt)`.
%
%   velocity_sigma: m/s, >= 0; default 0.05 each
%   rate_sigma: rad/s, >= 0; default 0.005 each
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
noise = cairn_mex('twist_noise_init');
noise = cairn.internal.overlay(noise, varargin, 'twist_noise');
end
