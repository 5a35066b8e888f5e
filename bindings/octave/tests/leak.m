function leak()
% leak() creates and destroys 10,000 filters with all that belongs to one, and fails if memory grows.

% SPDX-License-Identifier: BSD-3-Clause
warm_up = 2000;
for i = 1:warm_up
  once();
end
before = resident();
for i = warm_up + 1:10000
  once();
end
grown = resident() - before;
printf('leak: 10000 filters, the last %d grew the process by %d KiB\n', 10000 - warm_up, grown);
% A filter and its functions take more than 30 KiB: a leak of every one would be 240 MiB.
assert(grown < 4096);
end

function once()
filter = cairn.Filter('max_landmarks', 10, 'max_observations', 4);
filter.add_custom(cairn.custom(), @(pose, landmark) landmark, @(pose, z) z);
filter.set_log(@(line) line);
copied = filter.map().copy();
try
  filter.predict_wheels(-1, 1, 1);
catch
end
end

function kib = resident()
status = fileread('/proc/self/status');
kib = str2double(regexp(status, 'VmRSS:\s+(\d+)', 'tokens', 'once'){1});
end
