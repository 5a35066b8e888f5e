function filled = overlay(filled, arguments, what)
% filled = cairn.internal.overlay(defaults, arguments, what) changes the fields that the arguments name.

% SPDX-License-Identifier: BSD-3-Clause
given = cairn.internal.options(arguments);
if isempty(given)
  return
end
names = fieldnames(given);
for i = 1:numel(names)
  if ~isfield(filled, names{i})
    error('cairn:ARGUMENT', '%s: there is no field "%s"', what, names{i});
  end
  filled.(names{i}) = given.(names{i});
end
end
