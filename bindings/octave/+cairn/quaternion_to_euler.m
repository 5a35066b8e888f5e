function [roll, pitch, yaw] = quaternion_to_euler(quaternion)
% [roll, pitch, yaw] = cairn.quaternion_to_euler(quaternion)
% Roll, pitch and yaw (rad) of a quaternion; pitch lies in [-pi/2, pi/2]. At pitch = +-pi/2 roll and yaw turn about the
% same axis; there roll is set to 0.
%
%   quaternion: 4 numbers
%   roll: number, rad
%   pitch: number, rad
%   yaw: number, rad
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
[roll, pitch, yaw] = cairn_mex('quaternion_to_euler', quaternion);
end
