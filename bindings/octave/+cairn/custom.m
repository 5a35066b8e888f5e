function custom = custom(varargin)
% custom = cairn.custom(Name, Value, ...)
% A sensor of the caller's own, whose model are two functions (cairn.Filter.add_custom).
%
%   rows: values of an observation, 1 to 3; for a planar vehicle 1 or 2; default 3
%   angle_mask: bit i is set: value i is an angle (rad) and its residual is wrapped to (-pi, pi]; default 0
%   relative: 1: z depends on pose and landmark only through the body point R^T (l - p), and the filter makes use of
%     that; default 0: any function of both
%   sigma: noise of each value, > 0; default 1 each
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
custom = cairn_mex('custom_init');
custom = cairn.internal.overlay(custom, varargin, 'custom');
end
