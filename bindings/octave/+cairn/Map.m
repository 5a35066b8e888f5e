classdef Map < cairn.internal.Handle
  % Landmarks in one frame with their joint uncertainty. A filter owns a map (cairn.Filter.map), which follows the
  % filter. The caller owns a copy (cairn.Map.copy). A copy does not follow the filter, and other maps can be merged
  % into it (cairn.Map.merge).
  properties (SetAccess = private, Hidden)
    % The filter or the team that lends the map, which must live as long as it.
    owner = [];
  end

  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  methods
    function self = Map(owner, handle)
      % Maps come from filter.map(), filter.local_map(), team.map() and map.copy().
      self.owner = owner;
      self.handle = handle;
    end

    function count = count(self)
      % count = map.count()
      % Number of landmarks.
      %
      %   count: integer
      %
      % Errors: cairn:ARGUMENT ([]).
      count = cairn_mex('map_size', self.handle);
    end

    function landmark = landmark(self, id)
      % landmark = map.landmark(id)
      % A landmark by its id.
      %
      %   id: uint64
      %   landmark: struct: id, observations, position, covariance
      %
      % Errors: cairn:ARGUMENT, cairn:NOT_FOUND.
      landmark = cairn_mex('map_landmark', self.handle, id);
    end

    function landmarks = landmarks(self)
      % landmarks = map.landmarks()
      % All landmarks, by ascending id.
      %
      %   landmarks: struct with a column for each element: id, observations, position, covariance
      %
      % Errors: cairn:ARGUMENT, cairn:BUFFER.
      landmarks = cairn_mex('map_landmarks', self.handle);
    end

    function landmarks = within(self, centre, radius)
      % landmarks = map.within(centre, radius)
      % Landmarks whose estimate lies within `radius` (m, >= 0) of `centre` (map frame, m): nearest first, ties by id.
      %
      %   centre: 3 numbers, m
      %   radius: number, m
      %   landmarks: struct with a column for each element: id, observations, position, covariance
      %
      % Errors: cairn:ARGUMENT, cairn:BUFFER.
      landmarks = cairn_mex('map_within', self.handle, centre, radius);
    end

    function landmarks = nearest(self, point, count)
      % landmarks = map.nearest(point, count)
      % The `count` landmarks nearest to `point` (map frame, m): nearest first, ties by id. Fewer if the map holds
      % fewer.
      %
      %   point: 3 numbers, m
      %   count: integer
      %   landmarks: struct with a column for each element: id, observations, position, covariance
      %
      % Errors: cairn:ARGUMENT, cairn:BUFFER.
      landmarks = cairn_mex('map_nearest', self.handle, point, count);
    end

    function landmarks = in_box(self, lower, upper)
      % landmarks = map.in_box(lower, upper)
      % Landmarks whose estimate lies in the closed box between `lower` and `upper` (map frame, m), by ascending id.
      %
      %   lower: 3 numbers, m
      %   upper: 3 numbers, m
      %   landmarks: struct with a column for each element: id, observations, position, covariance
      %
      % Errors: cairn:ARGUMENT (also lower > upper), cairn:BUFFER.
      landmarks = cairn_mex('map_in_box', self.handle, lower, upper);
    end

    function matrix = joint_covariance(self, ids)
      % matrix = map.joint_covariance(ids)
      % Joint covariance of the positions of chosen landmarks: `matrix` is 3 count x 3 count, row-major, blocks in the
      % order of `ids`. No id may appear twice.
      %
      %   ids: vector
      %   matrix: square matrix, m^2
      %
      % Errors: cairn:ARGUMENT, cairn:NOT_FOUND, cairn:BUFFER.
      matrix = cairn_mex('map_joint_covariance', self.handle, ids);
    end

    function kind = kind(self)
      % kind = map.kind()
      % Kind of a map: cairn.MapForm.DENSE or cairn.MapForm.SPARSE.
      %
      %   kind: cairn.MapForm
      %
      % Errors: cairn:ARGUMENT ([]).
      kind = cairn_mex('map_kind', self.handle);
    end

    function copy = copy(self)
      % copy = map.copy()
      % Makes a copy of the same kind. The copy stays as it is when the filter goes on or is destroyed. All queries work
      % on it. A copy of a filter's open submap (cairn.Filter.local_map) is in the frame of this submap.
      %
      % Errors: cairn:ARGUMENT ([]), cairn:MEMORY.
      copy = cairn.Map([], cairn_mex('map_copy', self.handle));
    end

    function report = merge(self, other, varargin)
      % report = map.merge(other, Name, Value, ...)
      % Merges the landmarks of `other` into `map`. `map` stays in its own frame. The merge finds the transform between
      % both frames from the common landmarks (with has_transform also from the transform that the caller knows).
      % Afterwards `map` holds the best estimate that follows from both maps (docs/map_merging.md). A call that fails
      % changes neither map.
      %
      % Ids of `map` never change. A common landmark keeps the id that it has in `map`. An added landmark keeps its id.
      % By geometry, an added landmark whose id is already used in `map` gets the smallest free id above all ids of both
      % maps; if there is none, the smallest free id. cairn.Map.merged_ids returns all new ids.
      %
      % The maps must come from independent data. Two copies of one filter's map, or a merged map and one of its parts,
      % are refused, because the data that they share would count twice. Information of a sparse `other` about its own
      % frame (start pose, absolute observations) is not merged. With has_transform its start pose is merged.
      %
      % `map` must be a copy. `other` may be a copy or a filter's map. It is also filled in if the merge is refused
      % because of the contents of the maps.
      %
      %   options: fields of cairn.merge_options; [] or missing: none
      %   report: struct: association, common, added, rows, distance, threshold, T_map_other, covariance, broken_id,
      %     broken_other_id
      %
      % Errors: cairn:ARGUMENT (also map == other), cairn:STATE (`map` belongs to a filter: copy it; the kinds differ;
      % both hold landmarks of the same filter; a sparse `other` was itself merged with has_transform: merge the other
      % way round), cairn:NOT_FOUND (a map is empty, or there are too few common landmarks: with has_transform one is
      % necessary, without it three), cairn:NUMERICAL (the common landmarks lie on a line; they contradict each other,
      % and message and report name the worst pair; by geometry: more than one transform fits), cairn:CAPACITY
      % (max_landmarks), cairn:MEMORY.
      report = cairn_mex('map_merge', self.handle, other.handle, cairn.internal.options(varargin));
    end

    function merged = merged_ids(self)
      % merged = map.merged_ids()
      % Where the landmarks of the other map are after the last merge into this map, by ascending other_id; none before
      % a merge. A copy returns the same.
      %
      %   merged: struct with a column for each element: other_id, id, common
      %
      % Errors: cairn:ARGUMENT, cairn:BUFFER.
      merged = cairn_mex('map_merged_ids', self.handle);
    end
  end
end
