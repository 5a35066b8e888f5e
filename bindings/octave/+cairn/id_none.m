function result = id_none()
% result = cairn.id_none()
% cairn.Constants.ID_NONE, for languages that cannot read a macro.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
result = cairn_mex('id_none');
end
