## SPDX-License-Identifier: BSD-3-Clause
## Tests of the package, for Octave's test("binding.tst").

%!function [filter, camera] = rover(varargin)
%!  filter = cairn.Filter('max_landmarks', 50, varargin{:});
%!  camera = filter.add_cartesian('sigma', [0.05 0.05 0.05]);
%!endfunction

%!function bits = state(filter)
%!  [pose, covariance] = filter.pose();
%!  landmarks = filter.map().landmarks();
%!  bits = {pose, covariance, landmarks};
%!endfunction

%!function [filter, sensor] = calling(predict, place)
%!  filter = cairn.Filter('max_landmarks', 50, 'initial_covariance', 1e-4 * eye(6));
%!  camera = filter.add_cartesian();
%!  filter.update(camera, uint64([1 2]), [5 6; 1 -1; 0 0]);
%!  if nargin < 2, place = []; end
%!  sensor = filter.add_custom(cairn.custom('sigma', [0.1 0.1 0.1]), predict, place);
%!  filter.predict_twist(0.1, [1 0 0], [0 0 0]);
%!endfunction

%!function [z, jacobian_pose, jacobian_landmark] = difference(pose, landmark)
%!  z = landmark - pose.position;
%!  jacobian_pose = [-eye(3), zeros(3)];
%!  jacobian_landmark = eye(3);
%!endfunction

%!function [z, jacobian_pose, jacobian_landmark] = throwing(pose, landmark)
%!  error('my:own', 'my function does not like %s', 'this');
%!endfunction

%!function [z, jacobian_pose, jacobian_landmark] = wrong_shape(pose, landmark)
%!  [z, jacobian_pose, jacobian_landmark] = deal([1; 2], zeros(3, 6), zeros(3, 3));
%!endfunction

%!function [z, jacobian_pose, jacobian_landmark] = invisible(pose, landmark)
%!  [z, jacobian_pose, jacobian_landmark] = deal([]);
%!endfunction

%!function [z, jacobian_pose, jacobian_landmark] = asking(filter, pose, landmark)
%!  filter.pose();
%!  [z, jacobian_pose, jacobian_landmark] = difference(pose, landmark);
%!endfunction

%!function [z, jacobian_pose, jacobian_landmark] = closing(filter, pose, landmark)
%!  filter.close();
%!  [z, jacobian_pose, jacobian_landmark] = difference(pose, landmark);
%!endfunction

%!function [z, jacobian_pose, jacobian_landmark] = nesting(pose, landmark)
%!  other = cairn.Filter('max_landmarks', 5);
%!  other.predict_twist(0.1, [1 0 0], [0 0 0]);
%!  [z, jacobian_pose, jacobian_landmark] = difference(pose, landmark);
%!endfunction

## The twelve lines of the project's README.
%!test
%! [filter, camera] = rover('submap_landmarks', 60);
%! filter.predict_wheels(0.1, 1.0, 1.1);
%! matches = filter.update(camera, uint64([3 8]), [5 7; 1 -4; 0 1]);
%! assert(matches.landmark, uint64([3 8]));
%! assert(matches.result, cairn.Result.NEW * [1 1]);
%! filter.close_submap();
%! [pose, covariance] = filter.pose();
%! assert(size(covariance), [6 6]);
%! assert(size(pose.position), [3 1]);
%! landmarks = filter.map().within([0 0 0], 30);
%! assert(landmarks.id, uint64([3 8]));
%! assert(size(landmarks.position), [3 2]);
%! assert(size(landmarks.covariance), [3 3 2]);
%! assert(size(filter.map().within([0 0 0], 0.1).covariance), [3 3 0]);

## A struct of observations is the same as ids and z.
%!test
%! [a, camera] = rover();
%! b = rover();
%! observations = struct('id', [1 2], 'z', [5 6; 1 2; 0 0], 'covariance', cat(3, 0.01 * eye(3), 0.02 * eye(3)));
%! a.update(camera, observations);
%! b.update(camera, [1 2], observations.z, observations.covariance);
%! assert(state(a), state(b));
%! a.update(camera, []);
%! a.update(camera, struct('id', zeros(1, 0, 'uint64'), 'z', zeros(3, 0)));
%! assert(state(a), state(b));

## Errors carry the status and the message of the library, and change nothing.
%!test
%! [filter, camera] = rover();
%! filter.update(camera, 1, [5; 0; 0]);
%! before = state(filter);
%! try
%!   filter.predict_wheels(-1, 1, 1);
%!   error('no error came');
%! catch problem
%!   assert(problem.identifier, 'cairn:ARGUMENT');
%!   assert(problem.message, 'dt must be > 0, and is -1');
%! end
%! assert(state(filter), before);
%!error id=cairn:NOT_FOUND cairn.Filter().map().landmark(7)
%!error id=cairn:NOT_FOUND cairn.Filter().update(3, [], [])
%!error id=cairn:CAPACITY filter = cairn.Filter('max_sensors', 1); filter.add_cartesian(); filter.add_cartesian();

## Arrays of the wrong shape or type.
%!error id=cairn:ARGUMENT [f, c] = rover(); f.update(c, [1 2], [1 2; 3 4]);
%!error <z must be 3 x 2 numbers, and is 2 x 2 double> [f, c] = rover(); f.update(c, [1 2], [1 2; 3 4]);
%!error <complex double> [f, c] = rover(); f.update(c, 1, 1i * [1; 2; 3]);
%!error <sparse double> [f, c] = rover(); f.update(c, 1, sparse([1; 2; 3]));
%!error <1 x 1 cell> [f, c] = rover(); f.update(c, {1}, [1; 2; 3]);
%!error <1 x 3 char> [f, c] = rover(); f.predict_twist(0.1, 'abc', [0 0 0]);
%!error <a vector of 3 numbers, and is 1 x 2 double> [f, c] = rover(); f.predict_twist(0.1, [1 2], [0 0 0]);
%!error <a matrix of 6 x 6 numbers, and is 3 x 3 double>
%! [f, c] = rover();
%! f.predict_increment(cairn.pose_identity(), eye(3));
%!error <must be a struct> [f, c] = rover(); f.predict_increment(eye(4), eye(6));
%!error <must be a number, and is 1 x 2 double> [f, c] = rover(); f.predict_wheels([1 2], 1, 1);
%!error <sensor must be an integer, and is 0.5> [f, c] = rover(); f.update(0.5, [], []);
%!error <sensor must be an integer, and is nan> [f, c] = rover(); f.update(NaN, [], []);
%!error <of its range, and is 4294967296> cairn.Filter('max_landmarks', 2^32)
%!error <of its range, and is -1> cairn.Filter('max_landmarks', -1)
%!error <true or false> cairn.world_options_preset(struct('observe_at_start', 2), 'row1')
%!error <undefined> [f, c] = rover(); f.predict_increment(cairn.pose_identity());
%!error <has no field "max_landmark"> cairn.Filter('max_landmark', 3)
%!error <has no field "ids"> [f, c] = rover(); f.update(c, struct('ids', 1, 'z', [1; 2; 3]));
%!error <options are a struct, or names and values> cairn.Filter('max_landmarks')
%!error <there is no field "max_landmark"> cairn.filter_options('max_landmark', 3)
%!error <must be one of AUTO, DENSE, SPARSE, and is "dence"> cairn.Filter('join', 'dence')
%!error <other must be a map, and is a filter> f = cairn.Filter(); m = f.map().copy(); m.merge(f);
%!error <there is no function cairn_nothing> cairn_mex('nothing')
%!error <first argument must be the name> cairn_mex(1)

## Single precision and integers are numbers, too.
%!test
%! [a, camera] = rover();
%! a.predict_twist(single(0.5), int32([1 0 0]), uint8([0 0 0]));
%! assert(a.pose().position, [0.5; 0; 0]);

## Ids have 64 bits; a double holds 53.
%!test
%! [filter, camera] = rover();
%! id = intmax('uint64') - 1;
%! matches = filter.update(camera, id, [5; 0; 0]);
%! assert(matches.landmark, id);
%! assert(filter.map().landmarks().id, id);
%! assert(filter.map().landmark(id).id, id);
%! filter.update(camera, 2^53, [3; 0; 0]);
%!error <a uint64 if it is beyond 2\^53> [f, c] = rover(); f.update(c, 2^53 + 2, [5; 0; 0]);
%!error <a uint64 if it is beyond 2\^53> cairn.Filter().map().landmark(2^60)
%!error <a uint64 if it is beyond 2\^53> cairn.Filter().map().landmark(single(2^25))
%!error <of its range> cairn.Filter().map().landmark(-1)
%!error <of its range> cairn.Filter().map().landmark(int64(-1))
%!assert(cairn.id_none(), intmax('uint64'))
%!assert(cairn.Constants.ID_NONE, intmax('uint64'))

## Closed handles.
%!test
%! filter = cairn.Filter();
%! map = filter.map();
%! assert(filter.is_open());
%! filter.close();
%! filter.close();
%! delete(filter);
%! assert(! filter.is_open());
%! fail('filter.pose()', 'pose: the filter is closed');
%! fail('map.count()', 'count: the map is closed');
%!test
%! filter = cairn.Filter();
%! copied = filter.map().copy();
%! copied.close();
%! fail('copied.count()', 'closed');

## A map keeps its filter, which it needs.
%!test
%! [filter, camera] = rover();
%! filter.update(camera, 4, [5; 0; 0]);
%! map = filter.map();
%! clear filter
%! assert(map.landmarks().id, uint64(4));
%! map.close();
%! assert(map.count(), 1);

## Functions of the caller.
%!test
%! [filter, sensor] = calling(@difference);
%! matches = filter.update(sensor, [1 2], [4.9 5.9; 1 -1; 0 0]);
%! assert(matches.result, cairn.Result.MATCHED * [1 1]);
%! filter.close();

## One that throws: its own error, and the filter as before.
%!test
%! [filter, sensor] = calling(@throwing);
%! before = state(filter);
%! try
%!   filter.update(sensor, [1 2], [4.9 5.9; 1 -1; 0 0]);
%!   error('no error came');
%! catch problem
%!   assert(problem.identifier, 'my:own');
%!   assert(problem.message, 'my function does not like this');
%! end
%! assert(state(filter), before);
%!test
%! filter = calling(@difference);
%! before = state(filter);
%! sensor = filter.add_custom(struct('rows', 3), @difference, @(pose, z) error('my:place', 'no place'));
%! fail("filter.update(sensor, 77, [1; 2; 3])", 'no place');
%! assert(state(filter), before);
%!test
%! fail("cairn.custom_check(cairn.custom(), @throwing, [], cairn.pose_identity(), [1 2 3])", 'does not like this');
%!error <z must be a vector of 3 numbers, and is 2 x 1 double>
%! [f, s] = calling(@wrong_shape);
%! f.update(s, 1, [4.9; 1; 0]);
%!error <undefined> [f, s] = calling(@(pose, landmark) no_such_function(pose)); f.update(s, 1, [4.9; 1; 0]);
%!error <predict must be a function handle> [f, s] = calling(7);

## One that says "not visible".
%!test
%! [filter, sensor] = calling(@invisible);
%! matches = filter.update(sensor, 1, [4.9; 1; 0]);
%! assert(matches.reason, cairn.Reason.NO_IMAGE);

## One that uses the filter that calls it.
%!test
%! global victim
%! [victim, ~] = calling(@difference);
%! before = state(victim);
%! asks = victim.add_custom(cairn.custom(), @(pose, landmark) asking(victim, pose, landmark));
%! closes = victim.add_custom(cairn.custom(), @(pose, landmark) closing(victim, pose, landmark));
%! for sensor = [asks closes]
%!   try
%!     victim.update(sensor, 1, [4.9; 1; 0]);
%!     error('no error came');
%!   catch problem
%!     assert(problem.identifier, 'cairn:STATE');
%!     assert(! isempty(strfind(problem.message, 'must not use the handle that calls it')));
%!   end
%!   assert(state(victim), before);
%! end
%! victim.update(0, 1, [4.9; 1; 0]);
%! clear -global victim

## One that uses another filter may.
%!test
%! [filter, sensor] = calling(@nesting);
%! assert(filter.update(sensor, 1, [4.9; 1; 0]).result, cairn.Result.MATCHED);

## The log.
%!function collect(line)
%!  global lines
%!  lines{end + 1} = line;
%!endfunction
%!function slip(filter, camera)
%!  points = [10 * cos(1:8); 10 * sin(1:8); mod(1:8, 3)];
%!  for step = 1:26
%!    filter.predict_twist(1, [0.2 0 0], [0 0 0]);
%!    filter.update(camera, 1:8, points - [0.2 * step + 3 * (step > 24); 0; 0]);
%!  end
%!endfunction
%!test
%! global lines
%! lines = {};
%! [filter, camera] = rover('initial_covariance', 1e-4 * eye(6));
%! filter.set_log(@collect);
%! slip(filter, camera);
%! assert(! isempty(strfind([lines{:}], 'contradict')));
%! count = numel(lines);
%! [filter, camera] = rover('initial_covariance', 1e-4 * eye(6));
%! filter.set_log(@collect);
%! filter.set_log();
%! slip(filter, camera);
%! assert(numel(lines), count);
%! clear -global lines
%!warning <the function of the log failed: no log>
%! [f, c] = rover('initial_covariance', 1e-4 * eye(6));
%! f.set_log(@(line) error('no log'));
%! slip(f, c);

## Matrices look right: rows are rows.
%!test
%! [filter, camera] = rover();
%! filter.update(camera, 1, [2; 1; 0]);
%! jacobian_pose = zeros(1, 6); jacobian_pose(1) = -1;
%! match = filter.update_linear(0.01, 1, jacobian_pose, 1, [1 0 0]);
%! assert(match.result, cairn.Result.MATCHED);
%! world = cairn.World('seed', 3);
%! assert(size(world.contacts(0)), [12 1]);
%! [lower, upper] = world.extent();
%! assert(all(lower < upper));
%! positions = world.landmarks();
%! assert(rows(positions), 3);
%! assert(positions(:, 3), world.landmark(2));

## Options, constants, names.
%!test
%! options = cairn.filter_options('join', 'sparse', 'submap_landmarks', 60);
%! filter = cairn.Filter(options);
%! assert(filter.map().kind(), cairn.MapForm.SPARSE);
%! assert(cairn.MapForm.name(filter.map().kind()), 'SPARSE');
%! assert(cairn.Doubts.name(cairn.Doubts.NIS + cairn.Doubts.BIAS), 'NIS + BIAS');
%! assert(cairn.Filter('join', cairn.Join.DENSE, 'submap_landmarks', 60).map().kind(), cairn.MapForm.DENSE);
%! assert(cairn.Filter('join', 'CAIRN_JOIN_SPARSE', 'submap_landmarks', 60).map().kind(), cairn.MapForm.SPARSE);
%! assert(cairn.version_number(), cairn.Constants.VERSION);
%! assert(cairn.Loss.name(17), '17');
%! options = cairn.merge_options();
%! assert(isa(options.has_transform, 'logical'));

## Merging of maps, a team, a fleet.
%!test
%! [a, camera] = rover();
%! b = rover();
%! points = [5 7 3 9; 1 -4 2 0; 0 1 1 2];
%! a.update(camera, [1 2 3 4], points);
%! b.update(camera, [1 2 3 5], points);
%! merged = a.map().copy();
%! report = merged.merge(b.map());
%! assert(report.common, uint64(3));
%! assert(merged.merged_ids().common, [true true true false]);
%!test
%! planar = cairn.filter_options('vehicle', 'planar', 'max_landmarks', 40);
%! team = cairn.Team(cairn.team_options('vehicle', 1, 'mode', 'joint'), planar, cairn.range_bearing());
%! team.add(2, cairn.pose_identity(), diag([1 1 0 0 0 0.1]));
%! assert(team.members(), uint64([1 2]));
%! team.predict_twist(0.1, [1 0 0], [0 0 0]);
%! team.observe(0.1, struct('id', 7, 'z', [3; 0.2; 0]), []);
%! packet = team.take_packet();
%! assert(class(packet), 'uint8');
%! assert(team.receive(packet), cairn.Packet.OWN);
%! fleet = cairn.Fleet('vehicles', 2);
%! fleet.next();
%! assert(rows(fleet.features()), 2);

## Documentation stands where Octave looks.
%!test
%! assert(! isempty(strfind(get_help_text('cairn.Filter.update'), 'Updates the filter')));
%! assert(! isempty(strfind(get_help_text('cairn.filter_options'), 'submap_landmarks: a submap is closed')));
%! assert(! isempty(strfind(get_help_text('cairn.pose_compose'), 'Composes two poses')));

## "clear all" leaves handles usable. (It clears the functions of this file, too: this test is the last one.)
%!test
%! filter = cairn.Filter();
%! clear -f
%! filter.predict_twist(1, [1 0 0], [0 0 0]);
%! assert(filter.pose().position(1), 1);
