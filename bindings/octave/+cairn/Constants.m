classdef Constants
  % Constants that belong to no set.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % Major version of this header. cairn.version returns the version of the loaded library.
    VERSION_MAJOR = 0;
    % minor version of this header
    VERSION_MINOR = 2;
    % patch version of this header
    VERSION_PATCH = 0;
    % Version of this header as one number, for comparisons: 10000 major + 100 minor + patch.
    VERSION = 200;
    % The id that no landmark has.
    ID_NONE = intmax('uint64');
  end
end
