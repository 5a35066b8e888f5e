function quaternion = quaternion_exp(rotation_vector)
% quaternion = cairn.quaternion_exp(rotation_vector)
% Quaternion of a rotation vector (axis times angle, rad).
%
%   rotation_vector: 3 numbers, rad
%   quaternion: 4 numbers
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
quaternion = cairn_mex('quaternion_exp', rotation_vector);
end
