function result = pose_inverse(T_a_b)
% result = cairn.pose_inverse(T_a_b)
% Inverts a pose: `T_b_a` from `T_a_b`.
%
%   T_a_b: struct: position, quaternion
%   result: struct: position, quaternion
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
result = cairn_mex('pose_inverse', T_a_b);
end
