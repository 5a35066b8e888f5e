// SPDX-License-Identifier: BSD-3-Clause

package cairn

/*
#include <cairn/cairn.h>
*/
import "C"

// Map holds landmarks in one frame with their joint uncertainty. The map of a [Filter] or a [Team] follows it and is
// closed with it. A copy ([Map.Copy]) stays as it is, and other maps can be merged into it.
type Map struct {
	*handle // of the filter or the team, or of the copy
	ptr     *C.cairn_map
	lent    bool
}

// Copy makes a copy of the same kind. The copy stays as it is when the filter goes on or is destroyed. All queries
// work on it. The caller owns the copy and frees it with [Map.Close]. A copy of a filter's open submap
// ([Filter.LocalMap]) is in the frame of this submap.
//
// Errors: ErrArgument, ErrMemory.
//
// Complexity: dense O(n^2); sparse O(n): the factor's parts are shared.
//
//cairn:doc cairn_map_copy
func (m *Map) Copy() (copy *Map, err error) {
	if err = m.rlock(); err != nil {
		return
	}
	defer m.runlock()
	c := newCall()
	defer c.free()
	var ptr *C.cairn_map
	if err = c.check(int32(C.cairn_map_copy(m.ptr, &ptr, &c.error))); err != nil {
		return
	}
	return &Map{newHandle("map", nil, func() { C.cairn_map_destroy(ptr) }), ptr, false}, nil
}

// Close frees a copy. A map that a filter owns is not freed: it is destroyed with its filter.
//
// Complexity: O(n).
//
// In Go, a second call does nothing, and a copy that nothing refers to is destroyed without it.
//
//cairn:doc cairn_map_destroy
func (m *Map) Close() error {
	if m.lent {
		return nil
	}
	return m.close()
}

// Merge merges the landmarks of other into map_. map_ stays in its own frame. The merge finds the transform between
// both frames from the common landmarks (with has_transform also from the transform that the caller knows). Afterwards
// map_ holds the best estimate that follows from both maps (docs/map_merging.md). A call that fails changes neither
// map.
//
// Ids of map_ never change. A common landmark keeps the id that it has in map_. An added landmark keeps its id. By
// geometry, an added landmark whose id is already used in map_ gets the smallest free id above all ids of both maps;
// if there is none, the smallest free id. [Map.MergedIDs] returns all new ids.
//
// The maps must come from independent data. Two copies of one filter's map, or a merged map and one of its parts, are
// refused, because the data that they share would count twice. Information of a sparse other about its own frame
// (start pose, absolute observations) is not merged. With has_transform its start pose is merged.
//
// map_ must be a copy. other may be a copy or a filter's map. options may be nil for the defaults. report may be nil;
// set its struct_size first. It is also filled in if the merge is refused because of the contents of the maps.
//
// Errors: ErrArgument (also map == other), ErrState (map_ belongs to a filter: copy it; the kinds differ; both hold
// landmarks of the same filter; a sparse other was itself merged with has_transform: merge the other way round),
// ErrNotFound (a map is empty, or there are too few common landmarks: with has_transform one is necessary, without it
// three), ErrNumerical (the common landmarks lie on a line; they contradict each other, and message and report name
// the worst pair; by geometry: more than one transform fits), ErrCapacity (max_landmarks), ErrMemory.
//
// Complexity: for n landmarks in both maps and k common ones: dense O(n^2 k + k^3); sparse: that of closing all
// submaps of other at once, plus the joint test of at most 300 common landmarks. By geometry additionally O(n log n)
// and the search among triangles, which has a budget.
//
// In Go, the report is filled in, too, if the maps contradict a merge.
//
//cairn:doc cairn_map_merge
func (m *Map) Merge(other *Map, options *MergeOptions) (report MergeReport, err error) {
	if err = m.lockWith(other); err != nil {
		return
	}
	defer m.unlockWith(other)
	c := newCall()
	defer c.free()
	var chosen *C.cairn_merge_options
	if options != nil {
		chosen = new(C.cairn_merge_options)
		options.toC(chosen)
	}
	x := C.cairn_merge_report{struct_size: C.sizeof_cairn_merge_report}
	err = m.check(c, int32(C.cairn_map_merge(m.ptr, other.ptr, chosen, &x, &c.error)))
	report.fromC(&x)
	return
}

// lockWith locks this map for a change and the other one for a query. The order of locks is that of the handles, so that
// two merges in opposite directions do not wait for each other.
func (m *Map) lockWith(other *Map) (err error) {
	switch {
	case m.handle == other.handle:
		return m.lock()
	case m.number < other.number:
		if err = m.lock(); err != nil {
			return
		}
		if err = other.rlock(); err != nil {
			m.unlock()
		}
	default:
		if err = other.rlock(); err != nil {
			return
		}
		if err = m.lock(); err != nil {
			other.runlock()
		}
	}
	return
}

func (m *Map) unlockWith(other *Map) {
	if m.handle != other.handle {
		other.runlock()
	}
	m.unlock()
}
