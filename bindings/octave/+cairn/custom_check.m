function worst = custom_check(custom, predict, place, pose, landmark)
% worst = cairn.custom_check(custom, predict, place, pose, landmark)
% Compares a custom sensor's Jacobians with central differences on the manifold, at one pose and landmark. `worst` gets
% the largest difference; each difference is relative to max(1, |numerical value|). A correct Jacobian gives about 1e-6
% or less. If `place` is not [], it is checked at the observation that `predict` gives: its Jacobians, and that it
% returns to the landmark. `relative` is not checked.
%
%   custom: fields of cairn.custom
%   predict: function handle
%   place: function handle; [] or missing: none
%   pose: struct: position, quaternion
%   landmark: 3 numbers, m
%   worst: number
%
% Errors: cairn:ARGUMENT (also if `predict` refuses the landmark), cairn:CALLBACK.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
worst = cairn_mex('custom_check', custom, predict, place, pose, landmark);
end
