// SPDX-License-Identifier: BSD-3-Clause

package cairn

/*
#include <cairn/cairn.h>
*/
import "C"

import "unsafe"

// Filter estimates the pose of a vehicle and a map of landmarks.
type Filter struct {
	*handle
	ptr             *C.cairn_filter
	whole, openOnly *Map
}

// NewFilter creates a filter. Options of an older or a newer header are used as far as both sides know them.
//
// Errors: ErrArgument, ErrMemory.
//
// Complexity: O(memory).
//
//cairn:doc cairn_filter_create
func NewFilter(options FilterOptions) (filter *Filter, err error) {
	if err = loaded(); err != nil {
		return
	}
	c := newCall()
	defer c.free()
	var ptr *C.cairn_filter
	var x C.cairn_filter_options
	options.toC(&x)
	if err = c.check(int32(C.cairn_filter_create(&x, &ptr, &c.error))); err != nil {
		return
	}
	h := newHandle("filter", &callbacks{}, func() { C.cairn_filter_destroy(ptr) })
	return &Filter{h, ptr, &Map{h, C.cairn_filter_map(ptr), true}, &Map{h, C.cairn_filter_local_map(ptr), true}}, nil
}

// Close destroys a filter and the map that it owns.
//
// Complexity: O(memory).
//
// In Go, a second call does nothing, and a filter that nothing refers to is destroyed without it.
//
//cairn:doc cairn_filter_destroy
func (f *Filter) Close() error { return f.close() }

// Map: the filter's map. With submaps it holds the landmarks of the closed submaps; the landmarks of the open submap
// join it when this submap is closed. The filter owns this map; it lives as long as the filter and follows it.
//
//cairn:doc cairn_filter_map
func (f *Filter) Map() *Map { return f.whole }

// LocalMap: the landmarks of the open submap, in its frame; with a single map the same as [Filter.Map]. The filter
// owns this map; it lives as long as the filter and follows it.
//
//cairn:doc cairn_filter_local_map
func (f *Filter) LocalMap() *Map { return f.openOnly }

// Update updates the filter by one frame of one sensor. The observations of known landmarks update the state together.
// An observation with an unknown id places a new landmark, with all its correlations. matches (room for count,) gets
// the match of each observation. count may be 0. Allocates nothing.
//
// Errors: ErrArgument (also an id twice, [IDNone], noise that is not a covariance), ErrNotFound (sensor), ErrCapacity
// (more than max_observations), ErrNumerical, ErrCallback (a custom sensor's function aborted).
//
// Complexity: O(n^2 m) for n states and m rows.
//
//cairn:doc cairn_filter_update
func (f *Filter) Update(sensor Sensor, observations []Observation) ([]Match, error) {
	matches := make([]Match, len(observations))
	if err := f.UpdateInto(sensor, observations, matches); err != nil {
		return nil, err
	}
	return matches, nil
}

// UpdateInto is [Filter.Update] without an allocation: it writes the matches to memory of the caller, which has one
// element for each observation, or is nil.
func (f *Filter) UpdateInto(sensor Sensor, observations []Observation, matches []Match) error {
	if matches != nil && len(matches) != len(observations) {
		return wrongLength("matches", len(matches), len(observations))
	}
	if err := f.lock(); err != nil {
		return err
	}
	defer f.unlock()
	c := newCall()
	defer c.free()
	var first *C.cairn_observation
	var firstMatch *C.cairn_match
	if len(observations) > 0 {
		first = (*C.cairn_observation)(unsafe.Pointer(&observations[0]))
	}
	if len(matches) > 0 {
		firstMatch = (*C.cairn_match)(unsafe.Pointer(&matches[0]))
	}
	return f.check(c, int32(C.cairn_filter_update(f.ptr, C.int32_t(sensor), first, C.size_t(len(observations)), firstMatch,
		&c.error)))
}
