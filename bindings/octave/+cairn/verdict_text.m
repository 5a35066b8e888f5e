function result = verdict_text(verdict)
% result = cairn.verdict_text(verdict)
% A verdict in one word: "good", "doubtful" or "lost"; "unknown" for any other value.
%
%   verdict: cairn.Verdict

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
result = cairn_mex('verdict_text', verdict);
end
