function result = version_number()
% result = cairn.version_number()
% Version of the loaded library as a number, as cairn.Constants.VERSION is that of the header: 10000 major + 100 minor +
% patch.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
result = cairn_mex('version_number');
end
