function constants()
% constants() prints all constants of the package with their values, one a line.

% SPDX-License-Identifier: BSD-3-Clause
folder = fileparts(which('cairn.version'));
files = dir(fullfile(folder, '*.m'));
for i = 1:numel(files)
  class_name = ['cairn.', files(i).name(1:end - 2)];
  text = fileread(fullfile(folder, files(i).name));
  if isempty(strfind(text, 'properties (Constant)'))
    continue
  end
  names = properties(class_name);
  for j = 1:numel(names)
    value = eval([class_name, '.', names{j}]);
    printf('%s.%s %s\n', class_name, names{j}, strtrim(disp(value)));
  end
end
end
