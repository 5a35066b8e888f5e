function options = merge_options(varargin)
% options = cairn.merge_options(Name, Value, ...)
% Options of cairn.Map.merge.
%
%   association: cairn.MergeBy.ID or cairn.MergeBy.GEOMETRY; default cairn.MergeBy.ID
%   gate_probability: probability that all common landmarks of a correct merge pass their own gates, in (0, 1]; default
%     0.9999
%   joint_gate_probability: probability that they pass the joint gate, in (0, 1]; default 0.9999
%   max_landmarks: capacity of the merged map; 0, the default: no limit
%   max_tilt: by geometry, without has_transform: largest angle between the z axes of both frames, rad, 0 to pi; default
%     pi
%   has_transform: 1: T_map_other is known beforehand, independently of both maps; default 0
%   T_map_other: with has_transform: from the other's frame into the map's frame; default identity
%   covariance: covariance of its error [dp; dtheta], 6x6 row-major, positive semidefinite; default 0: known exactly
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
options = cairn_mex('merge_options_init');
options = cairn.internal.overlay(options, varargin, 'merge_options');
end
