function replay(folder)
% replay(folder) runs all files replay_NAME.m of a folder; NAME.out tells what each did.

% SPDX-License-Identifier: BSD-3-Clause
addpath(folder);
files = dir(fullfile(folder, 'replay_*.m'));
for i = 1:numel(files)
  name = files(i).name(numel('replay_') + 1:end - 2);
  file = fopen(fullfile(folder, [name, '.out']), 'w');
  feval(['replay_', name], recorder(file));
  fclose(file);
end
end
