function result = doubt_text(reason)
% result = cairn.doubt_text(reason)
% A reason in words, for example "single landmarks contradict the rest". `reason` is one bit; anything else gives
% "unknown".
%
%   reason: cairn.Doubts

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
result = cairn_mex('doubt_text', reason);
end
