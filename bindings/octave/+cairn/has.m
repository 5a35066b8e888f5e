function result = has(feature)
% result = cairn.has(feature)
% Whether the loaded library has a feature: 1 or 0. Features have names that never change their meaning: "sparse"
% (sparse joining), "teams", "trajectory", "systematic" (estimated systematic errors), "robust" (robust losses),
% "health" (verdicts), "errors" (messages in a error). [] and any other name: 0.
%
%   feature: text; [] or missing: none

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
if nargin < 1, feature = []; end
cairn.internal.library();
result = cairn_mex('has', feature);
end
