function result = build()
% result = cairn.build()
% Instruction set that the loaded library was compiled for: "x86-64" or "x86-64-v3" (on other machines: "generic").

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
result = cairn_mex('build');
end
