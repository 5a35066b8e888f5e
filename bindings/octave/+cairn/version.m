function result = version()
% result = cairn.version()
% Version of the loaded library, for example "0.2.0".

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
result = cairn_mex('version');
end
