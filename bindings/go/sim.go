//go:build !cairn_nosim

// SPDX-License-Identifier: BSD-3-Clause

package cairn

/*
#cgo pkg-config: cairn-sim
#include <cairn/cairn.h>
#include <cairn/fleet.h>
#include <cairn/sim.h>
*/
import "C"

// World is a simulated rover in a simulated landscape, with the truth. It is in libcairn_sim; a vehicle that does without
// is built with -tags cairn_nosim.
type World struct {
	*handle
	ptr *C.cairn_world
}

// NewWorld creates a world before its first step. Options of an older or a newer header are used as far as both sides
// know them.
//
// Errors: ErrArgument, ErrMemory, ErrNumerical (the ground is too rough for four wheels).
//
// Complexity: O(n log n) for n landmarks; memory: 40 bytes for each landmark.
//
//cairn:doc cairn_world_create
func NewWorld(options WorldOptions) (world *World, err error) {
	if err = loaded(); err != nil {
		return
	}
	c := newCall()
	defer c.free()
	var ptr *C.cairn_world
	var x C.cairn_world_options
	options.toC(&x)
	if err = c.check(int32(C.cairn_world_create(&x, &ptr, &c.error))); err != nil {
		return
	}
	return &World{newHandle("world", nil, func() { C.cairn_world_destroy(ptr) }), ptr}, nil
}

// Close destroys a world.
//
// Complexity: O(memory).
//
// In Go, a second call does nothing, and a world that nothing refers to is destroyed without it.
//
//cairn:doc cairn_world_destroy
func (w *World) Close() error { return w.close() }

// Fleet is a simulated fleet of boats, with the truth.
type Fleet struct {
	*handle
	ptr *C.cairn_fleet
}

// NewFleet creates a fleet before its first step. Options of an older or a newer header are used as far as both sides
// know them.
//
// Each boat is commanded once around a circle of radius R = course_length / (2 pi), anticlockwise, at the constant
// speed course_length / duration and rate 2 pi / duration. It starts at the southernmost point of the circle, heading
// east. The centres of the circles are Separation apart. The centre of a single boat is the origin. The centres of two
// boats are (-separation / 2, 0) and (separation / 2, 0). The centres of more boats form a square grid about the
// origin, with as many columns as rows or one more. They are numbered from west to east and row by row from the south;
// a last row that is not full is centred. A grid wider than half of Area is shrunk to that. With [FleetCoast] all
// circles must lie south of the coast line.
//
// Errors: ErrArgument, ErrMemory.
//
// Complexity: O(features).
//
//cairn:doc cairn_fleet_create
func NewFleet(options FleetOptions) (fleet *Fleet, err error) {
	if err = loaded(); err != nil {
		return
	}
	c := newCall()
	defer c.free()
	var ptr *C.cairn_fleet
	var x C.cairn_fleet_options
	options.toC(&x)
	if err = c.check(int32(C.cairn_fleet_create(&x, &ptr, &c.error))); err != nil {
		return
	}
	return &Fleet{newHandle("fleet", nil, func() { C.cairn_fleet_destroy(ptr) }), ptr}, nil
}

// Close destroys a fleet.
//
// Complexity: O(memory).
//
// In Go, a second call does nothing, and a fleet that nothing refers to is destroyed without it.
//
//cairn:doc cairn_fleet_destroy
func (f *Fleet) Close() error { return f.close() }
