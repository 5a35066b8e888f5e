function options = team_options(varargin)
% options = cairn.team_options(Name, Value, ...)
% Options of cairn.Team.
%
%   mode: CAIRN_TEAM_...; default cairn.TeamMode.JOINT
%   vehicle: number of this vehicle; unique in the team; not cairn.Constants.ID_NONE; default 0
%   max_vehicles: vehicles of the team, this one included, 1 to 256; default 8
%   baseline: 1: a second filter uses only this vehicle's data, for comparison by cairn.Team.score; default 0
%   max_lag: how long the team waits for a missing packet of a teammate, by the times of its own packets, s, > 0;
%     default 30
%   time_tolerance: packets whose times differ by at most this belong to the same time, s, >= 0; default 0.01
%   max_jump: a step that follows the one before it by more than this, s, > 0, is refused until the next one confirms
%     it; default 60
%   max_waiting: packets of one teammate that can wait for their turn, 1 to 1000000; default 4096. The one that the
%     others wait for has room beside them
%   history: own packets that are kept for teammates that miss them, 1 to 1000000; default 1024
%
% Errors: cairn:ARGUMENT.

% SPDX-License-Identifier: BSD-3-Clause
% Written by generate.py from the description of the C interface: do not edit.
cairn.internal.library();
options = cairn_mex('team_options_init');
options = cairn.internal.overlay(options, varargin, 'team_options');
end
