function functions = callbacks()
% functions = callbacks() gives the functions of tests/conformance/README.md: functions.predict_body_point(rows) is the
% function of a sensor with so many rows.

% SPDX-License-Identifier: BSD-3-Clause
functions.predict_body_point = @(rows) @(pose, landmark) body_point(rows, pose, landmark);
functions.predict_body_point_ahead = @(rows) @(pose, landmark) body_point_ahead(rows, pose, landmark);
functions.predict_range_only = @(rows) @range_only;
functions.predict_wrong_jacobian = @(rows) @(pose, landmark) wrong_jacobian(rows, pose, landmark);
functions.predict_unfinished = @(rows) @(pose, landmark) unfinished(rows, pose, landmark);
functions.predict_refusing = @(rows) @refusing;
functions.predict_aborting = @(rows) @aborting;
functions.place_body_point = @(rows) @(pose, z) place_body_point(rows, pose, z);
functions.place_refusing = @(rows) @refusing;
functions.place_aborting = @(rows) @aborting;
end

function R = rotation(pose)
w = pose.quaternion(1); x = pose.quaternion(2); y = pose.quaternion(3); z = pose.quaternion(4);
R = [1 - 2*(y*y + z*z), 2*(x*y - w*z), 2*(x*z + w*y)
     2*(x*y + w*z), 1 - 2*(x*x + z*z), 2*(y*z - w*x)
     2*(x*z - w*y), 2*(y*z + w*x), 1 - 2*(x*x + y*y)];
end

function [b, jacobian_pose, jacobian_landmark] = body_point(rows, pose, landmark)
R = rotation(pose);
d = landmark - pose.position;
b = zeros(rows, 1);
jacobian_pose = zeros(rows, 6);
jacobian_landmark = zeros(rows, 3);
for i = 1:rows
  b(i) = R(1, i)*d(1) + R(2, i)*d(2) + R(3, i)*d(3);
  jacobian_pose(i, :) = [-R(1, i), -R(2, i), -R(3, i), R(2, i)*d(3) - R(3, i)*d(2), ...
                         R(3, i)*d(1) - R(1, i)*d(3), R(1, i)*d(2) - R(2, i)*d(1)];
  jacobian_landmark(i, :) = [R(1, i), R(2, i), R(3, i)];
end
end

function [z, jacobian_pose, jacobian_landmark] = body_point_ahead(rows, pose, landmark)
[z, jacobian_pose, jacobian_landmark] = body_point(rows, pose, landmark);
if z(1) < -5
  aborting();
elseif z(1) < 0
  [z, jacobian_pose, jacobian_landmark] = refusing();
end
end

function [z, jacobian_pose, jacobian_landmark] = range_only(pose, landmark)
d = landmark - pose.position;
z = sqrt(d(1)*d(1) + d(2)*d(2) + d(3)*d(3));
if z < 0.1
  [z, jacobian_pose, jacobian_landmark] = refusing();
  return
end
jacobian_landmark = [d(1)/z, d(2)/z, d(3)/z];
jacobian_pose = [-jacobian_landmark, 0, 0, 0];
end

function [z, jacobian_pose, jacobian_landmark] = wrong_jacobian(rows, pose, landmark)
[z, jacobian_pose, jacobian_landmark] = body_point(rows, pose, landmark);
jacobian_landmark(1, 1) = jacobian_landmark(1, 1) + 0.5;
end

function [z, jacobian_pose, jacobian_landmark] = unfinished(rows, pose, landmark)
[z, jacobian_pose, jacobian_landmark] = body_point(rows, pose, landmark);
jacobian_pose(1, 1) = NaN;
end

function [landmark, jacobian_pose, jacobian_z] = place_body_point(rows, pose, z)
R = rotation(pose);
z(end + 1:3, 1) = 0;
c = zeros(3, 1);
for i = 1:3
  c(i) = R(i, 1)*z(1) + R(i, 2)*z(2) + R(i, 3)*z(3);
end
landmark = pose.position + c;
jacobian_pose = [1, 0, 0, 0, c(3), -c(2); 0, 1, 0, -c(3), 0, c(1); 0, 0, 1, c(2), -c(1), 0];
jacobian_z = R(:, 1:rows);
end

function [z, jacobian_pose, jacobian_landmark] = refusing(varargin)
z = [];
jacobian_pose = [];
jacobian_landmark = [];
end

function [z, jacobian_pose, jacobian_landmark] = aborting(varargin)
error('replay:aborting', 'the function of the sensor aborts');
end
