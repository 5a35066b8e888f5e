function options = filter_options(varargin)
% options = cairn.filter_options(Name, Value, ...)
% Options of cairn.Filter.
%
%   vehicle: cairn.Vehicle.SPATIAL or cairn.Vehicle.PLANAR; default cairn.Vehicle.SPATIAL
%   state_error: cairn.StateError.INVARIANT or cairn.StateError.STANDARD; default cairn.StateError.INVARIANT
%   max_landmarks: capacity; default 1000. Single map or dense joining: 1 to 30000, the memory grows with the square of
%     this number and is taken at creation. Sparse joining: 1 to 10000000, only a bound, memory is taken as the map
%     grows
%   max_observations: observations of one frame, 1 to 4096; default 64
%   max_sensors: sensors that can be added, 1 to 256; default 8
%   initial_pose: body in the map frame at the start; default identity
%   initial_covariance: covariance of its error [dp; dtheta], symmetric, positive semidefinite; default 0: known exactly
%   iterations: linearisations of an update at most, 1 (plain EKF) to 50; default 3
%   noise_learning: cairn.NoiseLearning.REPORTED or cairn.NoiseLearning.APPLIED; default cairn.NoiseLearning.REPORTED
%   iteration_tolerance: the iteration ends when the linearisation error of the batch is smaller than this, > 0; it is
%     measured in standard deviations of the observations, root of the sum of squares; default 0.1
%   gate_probability: chi-square gate of one observation, in (0, 1]; 1: no gate; default 0.999
%   batch_gate_probability: chi-square gate of a whole batch, in (0, 1]; 1: no gate; default 0.9999
%   error_persistence: number of consecutive observations of a landmark whose errors are fully correlated, 1 to 1000000:
%     an update multiplies the covariance of an observation's noise by this; association, placing and the weights of a
%     robust loss use the noise unchanged; default 1
%   association: cairn.Association.KNOWN, cairn.Association.NEAREST or cairn.Association.JOINT; default
%     cairn.Association.KNOWN
%   association_distance: cairn.Distance.MAHALANOBIS or cairn.Distance.LIKELIHOOD; default cairn.Distance.MAHALANOBIS
%   association_nodes: joint tests of one frame at most, 1 to 1000000; after this number the best set found so far is
%     used; default 2000
%   deferred_sightings: a new landmark is deferred until it was observed this often, 1 to 1000: until then it is part of
%     the estimate, but no map shows it; default 1
%   deferred_frames: a deferred landmark is removed if it is not observed often enough within this many frames, 1 to
%     1000000; default 20
%   missed_frames: a landmark is removed if it lay in a sensor's view (cairn.Filter.set_view), but was not seen, in this
%     many consecutive frames of this sensor; 0, the default: never
%   new_probability: unknown ids: an observation places a new landmark only if its distance from each landmark exceeds
%     the chi-square bound of this probability, in (0, 1). Landmarks that another observation of the frame is paired
%     with do not count. A pair beyond this bound is never made. Default 0.9999
%   submap_landmarks: a submap is closed when it holds this many landmarks, up to 4096; 0, the default: no submaps, one
%     single map
%   join: cairn.Join.AUTO, cairn.Join.DENSE or cairn.Join.SPARSE; default cairn.Join.AUTO
%   join_loss: loss of the landmarks that a closed submap shares with the map: cairn.Loss.NONE, cairn.Loss.HUBER or
%     cairn.Loss.CAUCHY; default cairn.Loss.NONE
%   trajectory_poses: newest poses that are kept for cairn.Filter.trajectory, 0 to 10000000; 0, the default: none. The
%     memory is taken at creation, at most 600 bytes a pose
%   join_loss_width: where `join_loss` leaves the parabola, standard deviations, > 0; default 1.5
%   submap_distance: a submap is also closed when the vehicle has driven this far in it, m; 0, the default: no limit
%   submap_extent: a submap is also closed when a landmark lies this far from its origin, m; 0, the default: no limit
%   submap_sigma: a submap is also closed when the largest standard deviation of the vehicle's position in it exceeds
%     this, m; 0, the default: no limit
%   velocity_bias_sigma: a constant error of the measured body velocity (x, y, z) is a state, with this standard
%     deviation at the start, m/s, >= 0; 0, the default: no state. The velocity is the measured one minus the bias
%     (docs/systematic_errors.md). A planar vehicle has only x and y
%   velocity_bias_walk: random walk of that error, m/s in the square root of a second, >= 0; it needs its
%     velocity_bias_sigma; default 0: constant
%   rate_bias_sigma: the same for the measured body rate, rad/s, >= 0; default 0. A planar vehicle has only z
%   rate_bias_walk: rad/s in the square root of a second, >= 0; default 0
%   wheel_scale_sigma: the same for the scales of the left and the right wheels: a wheel turns at the measured rate
%     times 1 + its scale, >= 0; default 0
%   wheel_scale_walk: in the square root of a second, >= 0; default 0
%   max_sensor_errors: numbers that cairn.Filter.calibrate_sensor makes states, over all sensors, 0 to 64; default 0
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
options = cairn_mex('filter_options_init');
options = cairn.internal.overlay(options, varargin, 'filter_options');
end
