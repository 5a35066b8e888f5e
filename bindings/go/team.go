// SPDX-License-Identifier: BSD-3-Clause

package cairn

/*
#include <cairn/cairn.h>
*/
import "C"

// Team is one vehicle's part in a team of planar vehicles that map together.
type Team struct {
	*handle
	ptr   *C.cairn_team
	whole *Map
}

// NewTeam creates a vehicle's view of its team. filter holds the options of the filter that the team runs: Vehicle
// must be [VehiclePlanar], InitialPose is the start of this vehicle in the frame of the team, and SubmapLandmarks must
// be greater than 0 in mode [TeamSubmaps] and 0 in all other modes. radar is the sensor of all vehicles. With extended
// observations it must be mounted at the body's origin.
//
// Errors: ErrArgument, ErrMemory.
//
// Complexity: O(memory).
//
//cairn:doc cairn_team_create
func NewTeam(options TeamOptions, filter FilterOptions, radar RangeBearing) (team *Team, err error) {
	if err = loaded(); err != nil {
		return
	}
	c := newCall()
	defer c.free()
	var ptr *C.cairn_team
	var x struct {
		options C.cairn_team_options
		filter  C.cairn_filter_options
		radar   C.cairn_range_bearing
	}
	options.toC(&x.options)
	filter.toC(&x.filter)
	radar.toC(&x.radar)
	status := C.cairn_team_create(&x.options, &x.filter, &x.radar, &ptr, &c.error)
	if err = c.check(int32(status)); err != nil {
		return
	}
	h := newHandle("team", nil, func() { C.cairn_team_destroy(ptr) })
	return &Team{h, ptr, &Map{h, C.cairn_team_map(ptr), true}}, nil
}

// Close destroys a team and the map that it owns.
//
// Complexity: O(memory).
//
// In Go, a second call does nothing, and a team that nothing refers to is destroyed without it.
//
//cairn:doc cairn_team_destroy
func (t *Team) Close() error { return t.close() }

// Map: the team's map. The team owns this map; it lives as long as the team and follows it.
//
//cairn:doc cairn_team_map
func (t *Team) Map() *Map { return t.whole }
