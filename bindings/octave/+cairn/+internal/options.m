function given = options(arguments)
% given = cairn.internal.options(arguments) makes a struct of names and values; a struct stays as it is.

% SPDX-License-Identifier: BSD-3-Clause
for i = 1:numel(arguments)
  if isa(arguments{i}, 'string')  % of MATLAB
    arguments{i} = char(arguments{i});
  end
end
if isempty(arguments)
  given = [];
elseif numel(arguments) == 1 && (isstruct(arguments{1}) || isempty(arguments{1}))
  given = arguments{1};
elseif mod(numel(arguments), 2) == 0 && iscellstr(arguments(1:2:end))
  given = struct();
  for i = 1:2:numel(arguments)
    given.(arguments{i}) = arguments{i + 1};
  end
else
  error('cairn:ARGUMENT', 'options are a struct, or names and values: ''name'', value, ...');
end
end
