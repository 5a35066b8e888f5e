classdef Handle < handle
  % What cairn.Filter, cairn.Map, cairn.Team, cairn.World and cairn.Fleet have in common: a handle of the library.
  %
  % The handle is closed when the last variable that holds the object is gone, by close(), or by delete(). Using a
  % closed handle is the error cairn:STATE.
  % SPDX-License-Identifier: BSD-3-Clause
  properties (SetAccess = protected, Hidden)
    % The number of the handle in cairn_mex; 0 is no handle.
    handle = uint64(0);
  end

  methods
    function close(self)
      % object.close() frees what the object holds in the library. A map that a filter or a team lends is left alone:
      % it is closed with its owner.
      delete(self);
    end

    function open = is_open(self)
      % open = object.is_open() is true until the handle is closed.
      open = cairn_mex('is_open', self.handle);
    end

    function delete(self)
      % delete(object) is the same as object.close().
      if self.handle
        cairn_mex('close', self.handle);
      end
    end
  end
end
