function bytes = filter_required_bytes(varargin)
% bytes = cairn.filter_required_bytes(Name, Value, ...)
% Bytes that cairn.Filter will take with these options. Only closings of submaps take more: workspace while they run,
% and with sparse joining the memory by which the map grows.
%
%   options: fields of cairn.filter_options
%   bytes: integer
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
bytes = cairn_mex('filter_required_bytes', cairn.internal.options(varargin));
end
