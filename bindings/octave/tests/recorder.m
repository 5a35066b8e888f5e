function record = recorder(file)
% recorder(file) gives functions that write what a scenario does, one JSON object a line.

% SPDX-License-Identifier: BSD-3-Clause
record.call = @() fprintf(file, '{"what": "call"}\n');
record.give = @(name, value) fprintf(file, '{"what": "give", "name": "%s", "value": %s}\n', name, shown(value));
record.log = @(line) fprintf(file, '{"what": "log", "line": %s}\n', quoted(line));
record.fail = @(problem) fprintf(file, '{"what": "fail", "id": "%s", "message": %s}\n', problem.identifier, ...
                                 quoted(problem.message));
end

function text = quoted(text)
text = ['"', strrep(strrep(text, '\', '\\'), '"', '\"'), '"'];
end

function text = shown(value)
if isobject(value)
  text = '"handle"';
elseif isstruct(value)
  names = fieldnames(value);
  parts = cell(1, numel(names));
  for i = 1:numel(names)
    parts{i} = ['"', names{i}, '": ', shown(value.(names{i}))];
  end
  text = ['{', strjoin(parts, ', '), '}'];
elseif ischar(value)
  text = ['{"text": ', quoted(value), '}'];
else
  if isa(value, 'double')
    values = cellstr(num2hex(value(:)));
    if isempty(value), values = {}; end
  elseif isa(value, 'uint64')
    % sprintf would make a double of it.
    halves = @(v) sprintf('%08X', fliplr(typecast(v, 'uint32')));
    values = arrayfun(halves, value(:)', 'UniformOutput', false);
  else
    values = arrayfun(@(v) sprintf('%d', v), value(:)', 'UniformOutput', false);
  end
  dimensions = strjoin(arrayfun(@(n) sprintf('%d', n), size(value), 'UniformOutput', false), ', ');
  text = ['{"dims": [', dimensions, '], "values": ['];
  if ~isempty(values)
    text = [text, '"', strjoin(values(:)', '", "'), '"'];
  end
  text = [text, ']}'];
end
end
