function quaternion = quaternion_from_euler(roll, pitch, yaw)
% quaternion = cairn.quaternion_from_euler(roll, pitch, yaw)
% Quaternion of roll, pitch and yaw (rad): `R = Rz(yaw) Ry(pitch) Rx(roll)`.
%
%   roll: number, rad
%   pitch: number, rad
%   yaw: number, rad
%   quaternion: 4 numbers
%
% Errors: cairn:ARGUMENT ([], not finite).

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
quaternion = cairn_mex('quaternion_from_euler', roll, pitch, yaw);
end
