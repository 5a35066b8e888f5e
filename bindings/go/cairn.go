// SPDX-License-Identifier: BSD-3-Clause

// Package cairn is landmark SLAM: a vehicle tells a [Filter] how it moved and where it saw landmarks. The filter returns
// the vehicle's pose, a map of the landmarks, and covariances that say how far to trust both. The package calls the C
// library libcairn and depends on nothing else.
//
// Poses, errors and covariances follow one convention: SI units and radians, quaternions w x y z, matrices row-major.
// The error of a pose is [dp; dtheta] in the axes of the map, see [Pose].
//
// A call that fails returns an [*Error] with the library's message and has changed nothing. A refused observation is no
// failure: its [Match] says why.
//
// Handles ([Filter], [Map], [Team], [World], [Fleet]) may be used by several goroutines: changes of one handle wait for
// each other, and queries run side by side. A handle is destroyed when nothing refers to it, or by its method Close.
package cairn

/*
#cgo pkg-config: cairn
#include <cairn/cairn.h>
#include "version.h"
*/
import "C"

import (
	"fmt"
	"sync"
)

// Sensor is the number of a sensor of a filter, as the functions that add one return it.
type Sensor int32

// call is the memory of one call: the library's error, and room for its arguments. C gets pointers to it in place of
// pointers to local variables, which Go would allocate anew for each call. It holds no pointers of Go.
type call struct {
	error C.cairn_error
	room  [roomOfCalls]float64
}

var calls = sync.Pool{New: func() any {
	return &call{error: C.cairn_error{struct_size: C.sizeof_cairn_error}}
}}

func newCall() *call { return calls.Get().(*call) }

func (c *call) free() { calls.Put(c) }

// check makes a Go error of what a call returned.
func (c *call) check(status int32) error {
	if status == int32(OK) {
		return nil
	}
	return &Error{Status: Status(status), Message: C.GoString(&c.error.message[0])}
}

// version of the library that is loaded, and whether this package can use it.
var wrongVersion = checkVersion(VersionNumber(), Version())

func checkVersion(number uint32, version string) error {
	if number/100 == HeaderVersion/100 {
		return nil
	}
	return &Error{Status: ErrState, Message: fmt.Sprintf("the Go package cairn %d.%d needs libcairn %d.%d, but libcairn %s "+
		"is loaded", HeaderVersionMajor, HeaderVersionMinor, HeaderVersionMajor, HeaderVersionMinor, version)}
}

// loaded fails if another version of the library is loaded than the one that this package was made for.
func loaded() error { return wrongVersion }

// must is for calls that cannot fail in a working program.
func must(err error) {
	if err != nil {
		panic(err)
	}
}

func cBool(value bool) C.cairn_bool {
	if value {
		return 1
	}
	return 0
}

func notNegative(name string, value int) error {
	if value >= 0 {
		return nil
	}
	return &Error{Status: ErrArgument, Message: fmt.Sprintf("%s must not be negative, and is %d", name, value)}
}

func wrongLength(name string, length, wanted int) error {
	return &Error{Status: ErrArgument, Message: fmt.Sprintf("%s must have %d values, and has %d", name, wanted, length)}
}
