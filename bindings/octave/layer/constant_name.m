function text = constant_name(value, values, names, bits)
% text = cairn.internal.constant_name(value, values, names, bits): the name of a constant, or of a sum of bits.

% SPDX-License-Identifier: BSD-3-Clause
if bits
  found = names(bitand(double(value), values) ~= 0);
  text = strjoin(found, ' + ');
else
  found = names(values == double(value));
  if isempty(found)
    text = sprintf('%d', value);
  else
    text = found{1};
  end
end
end
