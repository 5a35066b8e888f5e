function pose = pose_identity()
% pose = cairn.pose_identity()
% Sets a pose to the identity.
%
%   pose: struct: position, quaternion
%
% Errors: cairn:ARGUMENT ([]).

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
pose = cairn_mex('pose_identity');
end
