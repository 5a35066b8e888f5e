function library()
% cairn.internal.library() loads the library once, and says both versions if that fails.

% SPDX-License-Identifier: BSD-3-Clause
persistent loaded
if isempty(loaded)
  try
    cairn_mex('load');
  catch problem
    if strcmp(problem.identifier, 'cairn:LIBRARY')
      rethrow(problem);
    end
    error('cairn:LIBRARY', ['Cairn for Octave is version @VERSION@ and needs the libraries @SONAMES@ ' ...
          'of this version, which did not load: %s'], ...
          strjoin(strsplit(strtrim(problem.message), char(10)), '; '));
  end
  loaded = true;
end
end
