function camera = stereo_camera(varargin)
% camera = cairn.stereo_camera(Name, Value, ...)
% Rectified stereo camera: `z = (u_left, u_right, v)` in pixels of a point `(x, y, z)` of the left camera's frame (z out
% of the lens, x right, y down): `u_left = fu x/z + cu`, `u_right = fu (x - baseline)/z + cu`, `v = fv y/z + cv`. If
% both images give a row, pass the mean of both rows and half the variance of one.
%
%   fu: focal length in u, pixels, > 0; default 500
%   fv: focal length in v, pixels, > 0; default 500
%   cu: principal point, pixels; default 320
%   cv: principal point, pixels; default 240
%   baseline: m, > 0; default 0.2
%   T_body_camera: left camera in the body; default: at the origin, looking along x
%   sigma: noise of u_left, u_right, v, pixels, > 0; default 1 each
%   near_depth: a landmark whose predicted depth is below this has no image, m, > 0; default 0.1
%   min_disparity: an observation places a landmark only if its disparity u_left - u_right is at least this, pixels, >
%     0; default 1
%   min_disparity_sigmas: and only if its disparity is at least this many of its standard deviations (from `sigma`), >=
%     0; default 2.5: the depth is known to 40 %. A landmark that is farther away is placed when it is seen from nearer
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
camera = cairn_mex('stereo_camera_init');
camera = cairn.internal.overlay(camera, varargin, 'stereo_camera');
end
