function cartesian = cartesian(varargin)
% cartesian = cairn.cartesian(Name, Value, ...)
% Any sensor that gives a point: `z = (x, y, z)` of the landmark in the sensor's frame, m; for a planar vehicle `z = (x,
% y)`.
%
%   T_body_sensor: sensor in the body; default identity
%   sigma: noise of x, y, z, m, > 0; default 0.1 each
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
cartesian = cairn_mex('cartesian_init');
cartesian = cairn.internal.overlay(cartesian, varargin, 'cartesian');
end
