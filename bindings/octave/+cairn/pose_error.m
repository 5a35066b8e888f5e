function difference = pose_error(truth, estimate)
% difference = cairn.pose_error(truth, estimate)
% Error of an estimate against the truth: `difference` gets `[dp; dtheta]` as pose defines it.
%
%   truth: struct: position, quaternion
%   estimate: struct: position, quaternion
%   difference: 6 numbers, pose
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
difference = cairn_mex('pose_error', truth, estimate);
end
