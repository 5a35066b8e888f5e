function result = pose_compose(T_a_b, T_b_c)
% result = cairn.pose_compose(T_a_b, T_b_c)
% Composes two poses: `T_a_c = T_a_b * T_b_c`. Quaternions are normalised; a quaternion that is zero or not finite is
% refused. `result` may be one of the inputs.
%
%   T_a_b: struct: position, quaternion
%   T_b_c: struct: position, quaternion
%   result: struct: position, quaternion
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
result = cairn_mex('pose_compose', T_a_b, T_b_c);
end
