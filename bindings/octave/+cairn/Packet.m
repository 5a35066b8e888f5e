classdef Packet
  % Result of a received packet.
  %
  % cairn.Packet.name(VALUE) gives the name of a value.
  % SPDX-License-Identifier: BSD-3-Clause
  % Written by generate.py from the description of the C interface: do not edit.
  properties (Constant)
    % it had its turn and is part of the estimate
    TAKEN = 1;
    % it waits for its turn
    WAITING = 2;
    % a teammate misses own packets; they are queued to be sent again
    REQUEST = 3;
    % a teammate leaves the team when this packet has its turn
    LEAVE = 4;
    % it was received before
    REPEATED = 5;
    % it is an own packet that came back
    OWN = 6;
    % the mode does not use it, or it is for another vehicle
    IGNORED = 7;
    % its sender is not in the team
    UNKNOWN = 8;
    % its time does not agree with its number
    PAST = 9;
    % a different packet of this sender with this number was received before: two vehicles have the same number
    CONFLICT = 10;
    % max_waiting packets of this sender wait already
    FULL = 11;
    % it is not a packet of a team
    FOREIGN = 12;
    % this library does not read its version
    VERSION = 13;
    % bytes are missing, or there are too many
    CUT = 14;
    % its checksum is wrong
    CORRUPT = 15;
    % it is complete, but not a valid step: values that are not finite, noise that is not a covariance, an id or a
    % number twice, numbers of absurd size
    NONSENSE = 16;
    % its time is more than max_jump after that of the sender's packet before it. The next packet of the sender decides:
    % if it agrees with this one, both are right, and this one can be received again
    AHEAD = 17;
  end

  methods (Static)
    function text = name(value)
      % Name of a value.
      values = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17];
      names = {'TAKEN', 'WAITING', 'REQUEST', 'LEAVE', 'REPEATED', 'OWN', 'IGNORED', 'UNKNOWN', 'PAST', ...
      'CONFLICT', 'FULL', 'FOREIGN', 'VERSION', 'CUT', 'CORRUPT', 'NONSENSE', 'AHEAD'};
      text = cairn.internal.constant_name(value, values, names, false);
    end
  end
end
