function result = status_name(status)
% result = cairn.status_name(status)
% Name of a status, for example "cairn.Status.ERROR_ARGUMENT"; "unknown status" for any other value. Never [].
%
%   status: cairn.Status

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
result = cairn_mex('status_name', status);
end
