function timing(output_of_c)
% timing(output_of_c) drives a filter as timing.c does, compares the final pose with that of C bit for bit, and prints
% what an update takes more than in C.

% SPDX-License-Identifier: BSD-3-Clause
of_c = textscan(fileread(output_of_c), '%s %s');
of_c = cell2struct(of_c{2}, of_c{1});
frames = 2000;
count = 12;
filter = cairn.Filter('max_landmarks', 100, 'gate_probability', 1, 'batch_gate_probability', 1);
sensor = filter.add_cartesian();
times = zeros(1, frames);
i = 0:count - 1;
velocity = [1 0 0];
rate = [0 0 0.1];
for k = 0:frames - 1
  filter.predict_twist(0.1, velocity, rate);
  ids = uint64(mod(k + i, 20));
  noise = mod(7 * k + 3 * i, 11) - 5;
  observations = struct('id', ids, 'z', [3 + i + 0.001 * noise; i - 6 + 0.001 * noise; 0.25 * i]);
  clock = tic();
  matches = filter.update(sensor, observations);
  times(k + 1) = toc(clock);
end
pose = filter.pose();
assert(num2hex(pose.position(1)), of_c.x);
assert(num2hex(pose.quaternion(4)), of_c.qz);
octave = 1e6 * median(times);
c = str2double(of_c.microseconds);
printf('timing: an update takes %.1f us in Octave, %.1f us in C: %.1f us more; the same bits\n', octave, c, octave - c);
end
