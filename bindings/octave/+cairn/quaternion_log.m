function rotation_vector = quaternion_log(quaternion)
% rotation_vector = cairn.quaternion_log(quaternion)
% Rotation vector of a quaternion (rad). Its length is at most pi.
%
%   quaternion: 4 numbers
%   rotation_vector: 3 numbers, rad
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
rotation_vector = cairn_mex('quaternion_log', quaternion);
end
