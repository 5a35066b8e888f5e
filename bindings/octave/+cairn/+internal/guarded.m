function [thrown, varargout] = guarded(callback, varargin)
% [thrown, ...] = cairn.internal.guarded(callback, ...) calls a function that the library asks for. `thrown` is what
% rethrow() takes, or [] if nothing was thrown.

% SPDX-License-Identifier: BSD-3-Clause
thrown = [];
varargout = cell(1, nargout - 1);
try
  if nargout == 1
    callback(varargin{:});
  else
    [varargout{:}] = callback(varargin{:});
  end
catch problem
  thrown = struct('message', problem.message, 'identifier', problem.identifier, 'stack', problem.stack);
end
end
