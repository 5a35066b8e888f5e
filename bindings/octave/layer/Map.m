classdef Map < cairn.internal.Handle
  %DOC cairn_map
  properties (SetAccess = private, Hidden)
    % The filter or the team that lends the map, which must live as long as it.
    owner = [];
  end

  methods
    function self = Map(owner, handle)
      % Maps come from filter.map(), filter.local_map(), team.map() and map.copy().
      self.owner = owner;
      self.handle = handle;
    end

    %METHODS
  end
end
