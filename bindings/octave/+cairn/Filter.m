classdef Filter < cairn.internal.Handle
  % Estimates the pose of one vehicle and its map together.
  %
  % filter = cairn.Filter(Name, Value, ...)
  % Creates a filter. Options of an older or a newer header are used as far as both sides know them.
  %
  %   options: fields of cairn.filter_options
  %
  % Errors: cairn:ARGUMENT, cairn:MEMORY.
  %
  %   rover = cairn.Filter('submap_landmarks', 60);       % see cairn.filter_options for all options
  %   camera = rover.add_stereo_head('range_sigma', 0.5);
  %   rover.predict_wheels(0.1, 1.0, 1.1);
  %   matches = rover.update(camera, uint64([3 8]), [5 7; 0.1 -0.4; 0 0.02]);
  %   [pose, covariance] = rover.pose();
  %   landmarks = rover.map().within(pose.position, 30);
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  methods
    function self = Filter(varargin)
      % filter = cairn.Filter(Name, Value, ...)
      % Creates a filter. Options of an older or a newer header are used as far as both sides know them.
      %
      %   options: fields of cairn.filter_options
      %
      % Errors: cairn:ARGUMENT, cairn:MEMORY.
      cairn.internal.library();
      self.handle = cairn_mex('filter_create', cairn.internal.options(varargin));
    end

    function set_log(self, log)
      % filter.set_log(log)
      % Sets the receiver of this filter's log lines (refused batches, numerical refusals). [], the default: no log. The
      % callback runs inside calls of the filter and must not call the same filter.
      %
      %   log: function handle; [] or missing: none
      %
      % Errors: cairn:ARGUMENT.
      if nargin < 2, log = []; end
      cairn_mex('filter_set_log', self.handle, log);
    end

    function sensor = add_stereo_head(self, varargin)
      % sensor = filter.add_stereo_head(Name, Value, ...)
      % Adds a stereo head.
      %
      %   head: fields of cairn.stereo_head
      %   sensor: integer
      %
      % Errors: cairn:ARGUMENT, cairn:CAPACITY.
      sensor = cairn_mex('filter_add_stereo_head', self.handle, cairn.internal.options(varargin));
    end

    function sensor = add_stereo_camera(self, varargin)
      % sensor = filter.add_stereo_camera(Name, Value, ...)
      % Adds a stereo camera.
      %
      %   camera: fields of cairn.stereo_camera
      %   sensor: integer
      %
      % Errors: cairn:ARGUMENT, cairn:CAPACITY.
      sensor = cairn_mex('filter_add_stereo_camera', self.handle, cairn.internal.options(varargin));
    end

    function sensor = add_range_bearing(self, varargin)
      % sensor = filter.add_range_bearing(Name, Value, ...)
      % Adds a planar range-bearing sensor (radar, lidar, sonar).
      %
      %   radar: fields of cairn.range_bearing
      %   sensor: integer
      %
      % Errors: cairn:ARGUMENT (also if the vehicle is spatial), cairn:CAPACITY.
      sensor = cairn_mex('filter_add_range_bearing', self.handle, cairn.internal.options(varargin));
    end

    function sensor = add_cartesian(self, varargin)
      % sensor = filter.add_cartesian(Name, Value, ...)
      % Adds a cartesian sensor, which gives points.
      %
      %   cartesian: fields of cairn.cartesian
      %   sensor: integer
      %
      % Errors: cairn:ARGUMENT, cairn:CAPACITY.
      sensor = cairn_mex('filter_add_cartesian', self.handle, cairn.internal.options(varargin));
    end

    function sensor = add_custom(self, custom, predict, place)
      % sensor = filter.add_custom(custom, predict, place)
      % Adds a sensor of the caller's own. `predict` is required. `place` []: this sensor places no landmarks, it only
      % observes landmarks that other sensors placed. It must be [] if rows < 3 (planar: 2), because such an observation
      % does not determine a position. They must not call the same filter, and no exception and no longjmp may leave
      % them.
      %
      %   custom: fields of cairn.custom
      %   predict: function handle
      %   place: function handle; [] or missing: none
      %   sensor: integer
      %
      % Errors: cairn:ARGUMENT, cairn:CAPACITY.
      if nargin < 4, place = []; end
      sensor = cairn_mex('filter_add_custom', self.handle, custom, predict, place);
    end

    function point_head(self, sensor, pan, stick)
      % filter.point_head(sensor, pan, stick)
      % Sets the pan and stick angle (rad) of a stereo head from now on; both are 0 after it was added. Call this
      % function before each frame that was taken at other angles.
      %
      %   sensor: integer
      %   pan: number, rad
      %   stick: number, rad
      %
      % Errors: cairn:ARGUMENT (not finite, or no stereo head), cairn:NOT_FOUND.
      cairn_mex('filter_point_head', self.handle, sensor, pan, stick);
    end

    function set_loss(self, sensor, loss, width)
      % filter.set_loss(sensor, loss, width)
      % Sets the loss of a sensor's residuals: an observation whose distance is large gets less weight, instead of being
      % refused. `width` (> 0) is where the loss leaves the parabola, in standard deviations of the observation's noise.
      % The weights are found in the iteration of the update, and the covariance is that of the robust estimate
      % (docs/update.md, "Robust losses"). The chi-square gates stay; options with gate probabilities of 1 open them.
      % cairn.Loss.NONE takes the loss away; `width` is then ignored.
      %
      %   sensor: integer
      %   loss: cairn.Loss
      %   width: number
      %
      % Errors: cairn:ARGUMENT, cairn:NOT_FOUND.
      cairn_mex('filter_set_loss', self.handle, sensor, loss, width);
    end

    function set_view(self, sensor, lower, upper)
      % filter.set_view(sensor, lower, upper)
      % Sets the region in which a sensor detects every landmark: all observations between `lower` and `upper`, value by
      % value, in the sensor's units. An infinite value is no bound. A sensor of fewer than 3 rows uses the first
      % values. A frame has missed a landmark if its predicted observation lies inside the region by three standard
      % deviations, and no observation of the frame was compared with the landmark (`missed_frames`).
      %
      %   sensor: integer
      %   lower: 3 numbers, sensor
      %   upper: 3 numbers, sensor
      %
      % Errors: cairn:ARGUMENT, cairn:NOT_FOUND.
      cairn_mex('filter_set_view', self.handle, sensor, lower, upper);
    end

    function set_wheels(self, varargin)
      % filter.set_wheels(Name, Value, ...)
      % Sets the wheels for cairn.Filter.predict_wheels. Until then those of cairn.wheels are used.
      %
      %   wheels: fields of cairn.wheels
      %
      % Errors: cairn:ARGUMENT.
      cairn_mex('filter_set_wheels', self.handle, cairn.internal.options(varargin));
    end

    function set_twist_noise(self, varargin)
      % filter.set_twist_noise(Name, Value, ...)
      % Sets the noise of cairn.Filter.predict_twist. Until then that of cairn.twist_noise is used.
      %
      %   noise: fields of cairn.twist_noise
      %
      % Errors: cairn:ARGUMENT.
      cairn_mex('filter_set_twist_noise', self.handle, cairn.internal.options(varargin));
    end

    function predict_wheels(self, dt, left_rad_per_s, right_rad_per_s)
      % filter.predict_wheels(dt, left_rad_per_s, right_rad_per_s)
      % Moves the vehicle by the turning rates of its left and right wheels (rad/s) over `dt` seconds (> 0). Mars paper,
      % eq. 1 and 2.
      %
      %   dt: number, s
      %   left_rad_per_s: number, rad/s
      %   right_rad_per_s: number, rad/s
      %
      % Errors: cairn:ARGUMENT, cairn:NUMERICAL.
      cairn_mex('filter_predict_wheels', self.handle, dt, left_rad_per_s, right_rad_per_s);
    end

    function predict_wheels_gyro(self, dt, left_rad_per_s, right_rad_per_s, rate)
      % filter.predict_wheels_gyro(dt, left_rad_per_s, right_rad_per_s, rate)
      % Moves the vehicle by the turning rates of its left and right wheels (rad/s) and the body rate of a gyro (rad/s)
      % over `dt` seconds (> 0): the velocity is that of cairn.Filter.predict_wheels, with its noise, and the rate has
      % the noise of cairn.Filter.set_twist_noise. A planar vehicle reads only the rate about z.
      %
      %   dt: number, s
      %   left_rad_per_s: number, rad/s
      %   right_rad_per_s: number, rad/s
      %   rate: 3 numbers, rad/s
      %
      % Errors: cairn:ARGUMENT, cairn:NUMERICAL.
      cairn_mex('filter_predict_wheels_gyro', self.handle, dt, left_rad_per_s, right_rad_per_s, rate);
    end

    function predict_twist(self, dt, velocity, rate)
      % filter.predict_twist(dt, velocity, rate)
      % Moves the vehicle by its body velocity (m/s) and body rate (rad/s) over `dt` seconds (> 0). Mars paper, eq. 2.
      %
      %   dt: number, s
      %   velocity: 3 numbers, m/s
      %   rate: 3 numbers, rad/s
      %
      % Errors: cairn:ARGUMENT, cairn:NUMERICAL.
      cairn_mex('filter_predict_twist', self.handle, dt, velocity, rate);
    end

    function predict_increment(self, T_before_after, covariance)
      % filter.predict_increment(T_before_after, covariance)
      % Moves the vehicle by a relative pose, `T_map_body <- T_map_body T_before_after`, with the covariance (6x6
      % row-major, symmetric, positive semidefinite) of its error [dp; dtheta] in the axes of the body before the
      % motion. An increment has no duration: a filter that estimates a velocity or rate bias refuses it, and no random
      % walk goes on.
      %
      %   T_before_after: struct: position, quaternion
      %   covariance: 6 x 6, pose^2
      %
      % Errors: cairn:ARGUMENT, cairn:NUMERICAL, cairn:STATE (a bias is a state).
      cairn_mex('filter_predict_increment', self.handle, T_before_after, covariance);
    end

    function match = update_linear(self, residual, covariance, jacobian_pose, landmarks, jacobian_landmarks)
      % match = filter.update_linear(residual, covariance, jacobian_pose, landmarks, jacobian_landmarks)
      % Updates the filter by an observation that the caller has linearised: `residual = z - h` (rows values),
      % `covariance` of the noise (rows x rows), `jacobian_pose` = dh/[dp; dtheta] (rows x 6, [] for zero) and
      % `jacobian_landmarks` = dh/d positions (rows x 3 count, columns in the order of `landmarks`); all row-major. With
      % submaps, pose and landmarks are those of the open submap, in its frame. The observation is gated as one of that
      % many rows (gate_probability) and is not iterated. `match` (or []) gets the match; its landmark is the first one,
      % or cairn.Constants.ID_NONE. rows is 1 to 3 max_observations (planar: 2), count at most max_observations.
      %
      %   residual: vector, sensor
      %   covariance: rows x rows, sensor^2
      %   jacobian_pose: rows x 6, sensor/pose; [] or missing: none
      %   landmarks: vector
      %   jacobian_landmarks: rows x 3*count, sensor/m
      %   match: struct: landmark, result, reason, distance, threshold
      %
      % Errors: cairn:ARGUMENT, cairn:NOT_FOUND, cairn:CAPACITY, cairn:NUMERICAL.
      match = cairn_mex('filter_update_linear', self.handle, ...
          residual, covariance, jacobian_pose, landmarks, jacobian_landmarks);
    end

    function match = update_position(self, position, covariance, lever_arm)
      % match = filter.update_position(position, covariance, lever_arm)
      % Updates the filter by an absolute position (GNSS): `z = p + R lever_arm` in the map frame, m; 3x3 `covariance`,
      % positive definite. `match` (or []) gets the match.
      %
      %   position: 3 numbers, m
      %   covariance: 3 x 3, m^2
      %   lever_arm: 3 numbers, m; [] or missing: none
      %   match: struct: landmark, result, reason, distance, threshold
      %
      % Errors: cairn:ARGUMENT, cairn:NUMERICAL.
      if nargin < 4, lever_arm = []; end
      match = cairn_mex('filter_update_position', self.handle, position, covariance, lever_arm);
    end

    function match = update_attitude(self, quaternion, covariance)
      % match = filter.update_attitude(quaternion, covariance)
      % Updates the filter by an absolute attitude (star tracker): quaternion w x y z from body to map; 3x3 `covariance`
      % (rad^2, positive definite) of its error dtheta in the map's axes. `match` (or []) gets the match.
      %
      %   quaternion: 4 numbers
      %   covariance: 3 x 3, rad^2
      %   match: struct: landmark, result, reason, distance, threshold
      %
      % Errors: cairn:ARGUMENT, cairn:NUMERICAL.
      match = cairn_mex('filter_update_attitude', self.handle, quaternion, covariance);
    end

    function match = update_heading(self, heading, sigma)
      % match = filter.update_heading(heading, sigma)
      % Updates the filter by an absolute heading (sun sensor, compass): the yaw of the body's x axis in the map, rad,
      % with its standard deviation (> 0). A tilted body adds noise of second order (docs/sensors.md). The heading is
      % refused (cairn.Reason.NO_IMAGE) if the x axis is within three standard deviations of the tilt of the vertical.
      % `match` (or []) gets the match.
      %
      %   heading: number, rad
      %   sigma: number, rad
      %   match: struct: landmark, result, reason, distance, threshold
      %
      % Errors: cairn:ARGUMENT, cairn:NUMERICAL.
      match = cairn_mex('filter_update_heading', self.handle, heading, sigma);
    end

    function remove_landmark(self, id)
      % filter.remove_landmark(id)
      % Removes a landmark from the map and from the open submap. The information that it gave about other states stays.
      %
      %   id: uint64
      %
      % Errors: cairn:ARGUMENT, cairn:NOT_FOUND.
      cairn_mex('filter_remove_landmark', self.handle, id);
    end

    function match = merge_landmarks(self, id, other)
      % match = filter.merge_landmarks(id, other)
      % Merges two landmarks of the open submap, or of the single map, that are in truth one. The filter observes that
      % their difference is zero; this observation is gated like any other (gate_probability). If it passes, `other` is
      % removed, and `id` stays with the observations of both. `match` (or []) gets the match.
      %
      %   id: uint64
      %   other: uint64
      %   match: struct: landmark, result, reason, distance, threshold
      %
      % Errors: cairn:ARGUMENT, cairn:NOT_FOUND, cairn:CAPACITY (max_observations is 1), cairn:NUMERICAL.
      match = cairn_mex('filter_merge_landmarks', self.handle, id, other);
    end

    function split_landmark(self, id, fresh, covariance)
      % filter.split_landmark(id, fresh, covariance)
      % Splits a landmark that is in truth two landmarks. The new landmark `fresh` gets the position of `id` plus an
      % independent error with this 3x3 covariance (positive definite; it says how far apart the two may be). Later
      % observations separate the two.
      %
      %   id: uint64
      %   fresh: uint64
      %   covariance: 3 x 3, m^2
      %
      % Errors: cairn:ARGUMENT (also if `fresh` exists, or if the filter names landmarks itself and `fresh` is 2^63 or
      % more), cairn:NOT_FOUND, cairn:CAPACITY.
      cairn_mex('filter_split_landmark', self.handle, id, fresh, covariance);
    end

    function close_submap(self)
      % filter.close_submap()
      % Closes the open submap now. Allocates. A call that fails leaves the filter as it was, with the submap open.
      %
      % Errors: cairn:ARGUMENT, cairn:STATE (a single map, or the submap holds no landmark), cairn:CAPACITY
      % (max_landmarks), cairn:NUMERICAL, cairn:MEMORY.
      cairn_mex('filter_close_submap', self.handle);
    end

    function report = last_closing(self)
      % report = filter.last_closing()
      % Reports on the last attempt to close a submap; zeros before the first attempt.
      %
      %   report: struct: status, reason, submaps, landmarks, landmarks_new, landmarks_fused, landmarks_refused,
      %     landmarks_ambiguous, rows, distance, threshold, moved_max, moved_rms, widened_position, widened_attitude,
      %     association_nodes, association_exhausted, relinearised, refactored, iterations, seconds
      %
      % Errors: cairn:ARGUMENT.
      report = cairn_mex('filter_last_closing', self.handle);
    end

    function [pose, covariance] = local_pose(self)
      % [pose, covariance] = filter.local_pose()
      % Pose of the body in the open submap, and the covariance of its error [dp; dtheta] (6x6 row-major). With a single
      % map: in the map.
      %
      %   pose: struct: position, quaternion
      %   covariance: 6 x 6, pose^2
      %
      % Errors: cairn:ARGUMENT.
      [pose, covariance] = cairn_mex('filter_local_pose', self.handle);
    end

    function [pose, covariance] = base_pose(self)
      % [pose, covariance] = filter.base_pose()
      % Pose of the open submap's origin in the map, and the covariance of its error [dp; dtheta] (6x6 row-major). That
      % is what the closed submaps tell: landmarks that the open submap sees again, and fixes in it, correct
      % cairn.Filter.pose at once and the origin at the closing. With a single map: identity and zero.
      %
      %   pose: struct: position, quaternion
      %   covariance: 6 x 6, pose^2
      %
      % Errors: cairn:ARGUMENT.
      [pose, covariance] = cairn_mex('filter_base_pose', self.handle);
    end

    function count = submap_count(self)
      % count = filter.submap_count()
      % Number of submaps closed so far.
      %
      %   count: integer
      %
      % Errors: cairn:ARGUMENT.
      count = cairn_mex('filter_submap_count', self.handle);
    end

    function [base, ids] = submap(self, index)
      % [base, ids] = filter.submap(index)
      % A closed submap, counted from 0: the pose of its origin in the map as known now (dense: as known at its
      % closing), and the ids of its landmarks in the order in which they were placed. Of a submap that a sparse map has
      % fused with others of its place they are the ids of this place.
      %
      %   index: integer
      %   base: struct: position, quaternion
      %   ids: uint64
      %
      % Errors: cairn:ARGUMENT, cairn:NOT_FOUND, cairn:BUFFER.
      [base, ids] = cairn_mex('filter_submap', self.handle, index);
    end

    function report = last_update(self)
      % report = filter.last_update()
      % Reports on the last successful update of any kind; zeros before the first update.
      %
      %   report: struct: matched, placed, placed_again, rejected, deferred, removed, rows, nis, nis_lower, nis_upper,
      %     widened_position, widened_attitude, iterations, association_nodes, association_exhausted,
      %     association_seconds
      %
      % Errors: cairn:ARGUMENT.
      report = cairn_mex('filter_last_update', self.handle);
    end

    function [pose, covariance] = pose(self)
      % [pose, covariance] = filter.pose()
      % Pose of the body in the map, and the covariance of its error [dp; dtheta] (6x6 row-major). With submaps the pose
      % knows what the open submap has seen again of the map, before the submap is closed.
      %
      %   pose: struct: position, quaternion
      %   covariance: 6 x 6, pose^2
      %
      % Errors: cairn:ARGUMENT.
      [pose, covariance] = cairn_mex('filter_pose', self.handle);
    end

    function matrix = joint_covariance(self, ids)
      % matrix = filter.joint_covariance(ids)
      % Joint covariance of the pose's error [dp; dtheta] and the positions of chosen landmarks, in this order,
      % row-major, with 6 + 3 count rows and columns.
      %
      %   ids: vector
      %   matrix: square matrix, [pose, m]^2
      %
      % Errors: cairn:ARGUMENT, cairn:NOT_FOUND, cairn:BUFFER.
      matrix = cairn_mex('filter_joint_covariance', self.handle, ids);
    end

    function result = local_map(self)
      % result = filter.local_map()
      % The landmarks of the open submap, in its frame; with a single map the same as cairn.Filter.map. Fails only for
      % [], and then returns [].
      result = cairn.Map(self, cairn_mex('filter_local_map', self.handle));
    end

    function result = map(self)
      % result = filter.map()
      % The filter's map. With submaps it holds the landmarks of the closed submaps; the landmarks of the open submap
      % join it when this submap is closed. Fails only for [], and then returns [].
      result = cairn.Map(self, cairn_mex('filter_map', self.handle));
    end

    function nees = pose_nees(self, truth)
      % nees = filter.pose_nees(truth)
      % Normalised estimation error squared (NEES) of the pose against the true pose, in the error coordinates of the
      % filter. A consistent filter has 6 on average, for a planar vehicle 3.
      %
      %   truth: struct: position, quaternion
      %   nees: number
      %
      % Errors: cairn:ARGUMENT, cairn:NUMERICAL (the covariance of the pose is singular, as at a known start).
      nees = cairn_mex('filter_pose_nees', self.handle, truth);
    end

    function min_pivot = audit(self)
      % min_pivot = filter.audit()
      % Checks the whole covariance (with submaps, that of the open submap): `min_pivot` gets the smallest pivot of its
      % Cholesky factor after scaling to unit diagonal. It is 0 or less if the covariance is not positive definite.
      % States that are known exactly (zero variance) are left out.
      %
      %   min_pivot: number
      %
      % Errors: cairn:ARGUMENT.
      min_pivot = cairn_mex('filter_audit', self.handle);
    end

    function health = health(self)
      % health = filter.health()
      % The verdict on a filter. All of it is what the last update left: the call computes nothing.
      %
      %   health: struct: verdict, reasons, blind_directions, contradicting, updates, good_share, doubtful_share,
      %     lost_share, nis_per_row, nis_lower, nis_upper, refused_share, widenings, last_widening, motion_scale,
      %     motion_scale_sigma, bias_sigmas, jump_sigmas, pose_pivot
      %
      % Errors: cairn:ARGUMENT.
      health = cairn_mex('filter_health', self.handle);
    end

    function health = sensor_health(self, sensor)
      % health = filter.sensor_health(sensor)
      % What the observations of one sensor show.
      %
      %   sensor: integer
      %   health: struct: compared, refused, nis_per_row, nis_lower, nis_upper, scale, scale_sigma, persistence
      %
      % Errors: cairn:ARGUMENT, cairn:NOT_FOUND (sensor).
      health = cairn_mex('filter_sensor_health', self.handle, sensor);
    end

    function calibrate_sensor(self, sensor, varargin)
      % filter.calibrate_sensor(sensor, Name, Value, ...)
      % Makes systematic errors of a sensor states of the filter. Call it after the sensor was added, before the first
      % motion and the first observation, at most once for a sensor. All sensors together have at most max_sensor_errors
      % of cairn.filter_options. Association (with unknown ids) uses the estimates, but leaves their uncertainty out of
      % its gates.
      %
      %   sensor: integer
      %   calibration: fields of cairn.calibration
      %
      % Errors: cairn:ARGUMENT, cairn:NOT_FOUND (sensor), cairn:CAPACITY, cairn:STATE (too late, or calibrated already),
      % cairn:MEMORY.
      cairn_mex('filter_calibrate_sensor', self.handle, sensor, cairn.internal.options(varargin));
    end

    function [errors, covariance] = systematic_errors(self)
      % [errors, covariance] = filter.systematic_errors()
      % The estimates of all components that are states, those of the motion first, then sensor by sensor in the order
      % of their calibration, each in the order of kinds and components.
      %
      %   errors: struct with a column for each element: kind, sensor, component, value, sigma
      %   covariance: square matrix, kind^2
      %
      % Errors: cairn:ARGUMENT, cairn:BUFFER.
      [errors, covariance] = cairn_mex('filter_systematic_errors', self.handle);
    end

    function number = keep_pose(self)
      % number = filter.keep_pose()
      % Keeps the pose of the body now, as an update does: for a step in which nothing was observed. `number` (or [])
      % gets the number of the pose.
      %
      %   number: uint64
      %
      % Errors: cairn:ARGUMENT, cairn:STATE (`trajectory_poses` is 0).
      number = cairn_mex('filter_keep_pose', self.handle);
    end

    function [first, end_] = trajectory_range(self)
      % [first, end_] = filter.trajectory_range()
      % The numbers of the poses that are kept: from `*first` up to but not including `*end`. `*end` is the number of
      % poses so far.
      %
      %   first: uint64
      %   end_: uint64
      %
      % Errors: cairn:ARGUMENT, cairn:STATE (`trajectory_poses` is 0).
      [first, end_] = cairn_mex('filter_trajectory_range', self.handle);
    end

    function poses = trajectory(self, first)
      % poses = filter.trajectory(first)
      % The poses of the body in the map, as they are known now, from the number `first` to the newest one. Close the
      % open submap first to have its last corrections.
      %
      %   first: uint64
      %   poses: struct with a column for each element: position, quaternion
      %
      % Errors: cairn:ARGUMENT, cairn:STATE (`trajectory_poses` is 0), cairn:CAPACITY (the trajectory has become longer
      % than `trajectory_poses`, and the pose `first` was dropped), cairn:NOT_FOUND (`first` is greater than the number
      % of poses so far), cairn:BUFFER.
      poses = cairn_mex('filter_trajectory', self.handle, first);
    end

    function matches = update(self, sensor, observations, z, covariance)
      % matches = filter.update(sensor, ids, z)
      % matches = filter.update(sensor, ids, z, covariance)
      % matches = filter.update(sensor, observations)
      % Updates the filter by one frame of one sensor. The observations of known landmarks update the state together. An
      % observation with an unknown id places a new landmark, with all its correlations. `matches` gets the match of
      % each observation.
      %
      %   sensor: integer
      %   observations: struct with a column for each element: id, z, covariance
      %   matches: struct with a column for each element: landmark, result, reason, distance, threshold
      %
      % Errors: cairn:ARGUMENT (also an id twice, cairn.Constants.ID_NONE, noise that is not a covariance),
      % cairn:NOT_FOUND (sensor), cairn:CAPACITY (more than max_observations), cairn:NUMERICAL, cairn:CALLBACK (a custom
      % sensor's function aborted).
      %
      % With ids: `z` has a column of three values for each id (unused ones are 0), `covariance` a page of 3 x 3.
      if nargin > 3
        ids = observations;
        observations = struct();
        observations.id = ids;
        observations.z = z;
        if nargin > 4
          observations.covariance = covariance;
        end
      end
      matches = cairn_mex('filter_update', self.handle, sensor, observations);
    end
  end
end
