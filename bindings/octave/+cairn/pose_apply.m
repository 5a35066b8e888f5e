function point_a = pose_apply(T_a_b, point_b)
% point_a = cairn.pose_apply(T_a_b, point_b)
% Transforms a point from frame b to frame a (m).
%
%   T_a_b: struct: position, quaternion
%   point_b: 3 numbers, m
%   point_a: 3 numbers, m
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
point_a = cairn_mex('pose_apply', T_a_b, point_b);
end
