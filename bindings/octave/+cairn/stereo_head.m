function head = stereo_head(varargin)
% head = cairn.stereo_head(Name, Value, ...)
% Stereo head on a pan and tilt mount (Mars paper, Figures 2 and 3, eq. 4). It observes range, azimuth and elevation.
%
% A point `m_c` of the camera frame (x out of the lens, y left, z up) lies in the body frame at `m_b = d + Rz(pan)
% Ry(stick) (s + R(q) m_c)`. The platform stands at `d`. It turns by `pan` about its z axis, and by `stick` about the
% bolt, which is its y axis. The stick carries the camera at `s`, turned by `q`. The observation is `z = (range,
% azimuth, elevation)` of `m_c`: `range = |m_c|` (m), `azimuth = atan2(y, x)` (rad, left positive), `elevation =
% atan2(z, sqrt(x^2 + y^2))` (rad, up positive). A positive stick angle lowers the lens, so a stick that turns by
% -elevation points the lens at the point. With the default mount the camera frame is the body frame.
%
%   encoder_mode: cairn.Encoder.OBSERVATION or cairn.Encoder.FRAME; default cairn.Encoder.OBSERVATION
%   platform: d: pan axis in the body frame, m; default 0
%   stick: s: camera in the stick's frame, which has made both turns, m; default 0
%   camera_quaternion: q: camera axes in the stick's frame, w x y z; default identity
%   range_sigma: m, > 0; default 1.0 (Table 1)
%   azimuth_sigma: rad, > 0; default 3 degrees (Table 1)
%   elevation_sigma: rad, > 0; default 3 degrees (Table 1)
%   pan_sigma: encoder noise of pan, rad, >= 0; default 0
%   stick_sigma: encoder noise of the stick, rad, >= 0; default 0
%   near_range: an observation is refused if the predicted range, or the observed range of a new landmark, is below
%     this, m, > 0; default 0.1
%   max_elevation: an observation is also refused above this elevation, where the azimuth is nearly undefined, rad, in
%     (0, pi/2); default 85 degrees
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
head = cairn_mex('stereo_head_init');
head = cairn.internal.overlay(head, varargin, 'stereo_head');
end
