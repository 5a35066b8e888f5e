classdef Filter < cairn.internal.Handle
  %DOC cairn_filter
  %
  %   rover = cairn.Filter('submap_landmarks', 60);       % see cairn.filter_options for all options
  %   camera = rover.add_stereo_head('range_sigma', 0.5);
  %   rover.predict_wheels(0.1, 1.0, 1.1);
  %   matches = rover.update(camera, uint64([3 8]), [5 7; 0.1 -0.4; 0 0.02]);
  %   [pose, covariance] = rover.pose();
  %   landmarks = rover.map().within(pose.position, 30);
  methods
    %METHODS

    function matches = update(self, sensor, observations, z, covariance)
      % matches = filter.update(sensor, ids, z)
      % matches = filter.update(sensor, ids, z, covariance)
      %DOC cairn_filter_update
      %
      % With ids: `z` has a column of three values for each id (unused ones are 0), `covariance` a page of 3 x 3.
      if nargin > 3
        ids = observations;
        observations = struct();
        observations.id = ids;
        observations.z = z;
        if nargin > 4
          observations.covariance = covariance;
        end
      end
      matches = cairn_mex('filter_update', self.handle, sensor, observations);
    end
  end
end
