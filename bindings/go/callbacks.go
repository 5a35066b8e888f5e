// SPDX-License-Identifier: BSD-3-Clause

package cairn

/*
#include "bridge.h"
*/
import "C"

import (
	"errors"
	"runtime"
	"runtime/cgo"
	"strings"
	"sync/atomic"
	"unsafe"
)

// PredictFunc predicts the observation of a landmark: the model of a sensor of the caller's own.
//
// All three outputs are NaN before the call, and every value must be written, zeros too: the observation is refused if
// one is not finite.
//
// 1: all values are written. 0: the landmark cannot be seen from this pose; the observation is refused. A negative
// value aborts the whole call with [ErrCallback], and the handle stays as before, bit for bit. Any other value is
// refused as an error. The same arguments must always give the same answer.
//
// In Go, true stands for 1 and false for 0. An error aborts the call, and the call's error wraps it. A panic aborts the
// call, too, and continues in the caller. The slices are memory of C and valid only during the call: jacobianPose is
// rows x 6 and jacobianLandmark rows x 3, row-major. Do not end the goroutine (runtime.Goexit, or Fatal of a test): the
// call of C can never return then, and the filter refuses all later calls.
//
//cairn:doc cairn_custom_predict_fn
type PredictFunc func(pose Pose, landmark [3]float64, z, jacobianPose, jacobianLandmark []float64) (bool, error)

// PlaceFunc computes where the landmark lies that gave Z: the inverse of [PredictFunc].
//
// 1, 0 or a negative value, as for [PredictFunc]. 0 says that Z cannot place a landmark. The outputs are NaN before
// the call here, too
//
// In Go, the slices are memory of C and valid only during the call: landmark has 3 values, jacobianPose is 3 x 6 and
// jacobianZ 3 x rows, row-major. Results and panics are as those of [PredictFunc].
//
//cairn:doc cairn_custom_place_fn
type PlaceFunc func(pose Pose, z, landmark, jacobianPose, jacobianZ []float64) (bool, error)

// LogFunc receives a line (UTF-8) of a filter's log. payload is the pointer that [Filter.SetLog] got.
//
// In Go, a panic continues in the caller when the call is complete.
//
//cairn:doc cairn_log_fn
type LogFunc func(line string)

// callbacks is what the callbacks of a handle leave behind for the call that they run in. Only that call's goroutine uses
// the outcome; others ask whether a callback runs.
type callbacks struct {
	depth   int32
	lost    int32 // a callback ended its goroutine: the call of C never returned
	outcome *outcome
}

// outcome is the first error or panic of a callback.
type outcome struct {
	err      error
	panicked bool
	value    any
}

func (s *callbacks) running() bool   { return s != nil && atomic.LoadInt32(&s.depth) > 0 }
func (s *callbacks) abandoned() bool { return s != nil && atomic.LoadInt32(&s.lost) > 0 }
func (s *callbacks) failed() bool    { return s != nil && s.outcome != nil }

// settle adds the error of a callback to that of the call, or lets its panic go on.
func (s *callbacks) settle(err error) error {
	if !s.failed() {
		return err
	}
	result := s.outcome
	s.outcome = nil
	if result.panicked {
		panic(result.value)
	}
	var aborted *Error
	if errors.As(err, &aborted) && aborted.Status == ErrCallback {
		aborted.cause = result.err
	}
	return err
}

// run calls a callback. Nothing may unwind through C++: a panic is kept until the call of C has returned.
func (s *callbacks) run(callback func() (bool, error)) (answer C.int32_t) {
	atomic.AddInt32(&s.depth, 1)
	answer = -1
	returned := false
	defer func() {
		atomic.AddInt32(&s.depth, -1)
		if returned {
			return
		}
		if value := recover(); value != nil {
			s.keep(&outcome{panicked: true, value: value})
		} else {
			atomic.StoreInt32(&s.lost, 1)
		}
	}()
	ok, err := callback()
	returned = true
	switch {
	case err != nil:
		s.keep(&outcome{err: err})
		return -1
	case ok:
		return 1
	}
	return 0
}

func (s *callbacks) keep(result *outcome) {
	if s.outcome == nil {
		s.outcome = result
	}
}

// insideCallback reports whether a callback is among the callers of this function.
func insideCallback() bool {
	var counters [64]uintptr
	for skip := 2; ; skip += len(counters) {
		count := runtime.Callers(skip, counters[:])
		if count == 0 {
			return false
		}
		frames := runtime.CallersFrames(counters[:count])
		for more := true; more; {
			var frame runtime.Frame
			frame, more = frames.Next()
			if strings.HasSuffix(frame.Function, "(*callbacks).run") {
				return true
			}
		}
	}
}

// model is what C's `user` stands for: the two functions of a sensor.
type model struct {
	callbacks *callbacks
	rows      int
	predict   PredictFunc
	place     PlaceFunc
}

type logger struct {
	callbacks *callbacks
	log       LogFunc
}

func doubles(first *C.double, count int) []float64 {
	return unsafe.Slice((*float64)(unsafe.Pointer(first)), count)
}

func hasPlace(place PlaceFunc) C.int {
	if place == nil {
		return 0
	}
	return 1
}

func nilPredict(predict PredictFunc) error {
	if predict != nil {
		return nil
	}
	return &Error{Status: ErrArgument, Message: "predict must not be nil"}
}

// CustomCheck compares a custom sensor's Jacobians with central differences on the manifold, at one pose and landmark.
// worst gets the largest difference; each difference is relative to max(1, |numerical value|). A correct Jacobian
// gives about 1e-6 or less. If place is not nil, it is checked at the observation that predict gives: its Jacobians,
// and that it returns to the landmark. Relative is not checked. user is passed to both functions.
//
// Errors: ErrArgument (also if predict refuses the landmark), ErrCallback.
//
//cairn:doc cairn_custom_check
func CustomCheck(custom Custom, predict PredictFunc, place PlaceFunc, pose Pose, landmark [3]float64) (worst float64,
	err error) {
	if err = loaded(); err != nil {
		return
	}
	if err = nilPredict(predict); err != nil {
		return
	}
	var own callbacks
	user := cgo.NewHandle(&model{&own, int(custom.Rows), predict, place})
	defer user.Delete()
	c := newCall()
	defer c.free()
	x := (*struct {
		custom   C.cairn_custom
		pose     C.cairn_pose
		landmark [3]C.double
		worst    C.double
	})(unsafe.Pointer(&c.room))
	custom.toC(&x.custom)
	x.pose = *(*C.cairn_pose)(unsafe.Pointer(&pose))
	x.landmark = *(*[3]C.double)(unsafe.Pointer(&landmark))
	status := C.go_cairn_custom_check(&x.custom, C.uintptr_t(user), hasPlace(place), &x.pose, &x.landmark[0], &x.worst,
		&c.error)
	if err = own.settle(c.check(int32(status))); err != nil {
		return
	}
	return float64(x.worst), nil
}

// AddCustom adds a sensor of the caller's own. predict is required. place nil: this sensor places no landmarks, it
// only observes landmarks that other sensors placed. It must be nil if rows < 3 (planar: 2), because such an
// observation does not determine a position. user is passed to both functions, which run inside [Filter.Update]. They
// must not call the same filter, and no exception and no longjmp may leave them. release gets user when the filter is
// destroyed. If this call fails, user stays the caller's.
//
// Errors: ErrArgument, ErrCapacity.
//
//cairn:doc cairn_filter_add_custom
func (f *Filter) AddCustom(custom Custom, predict PredictFunc, place PlaceFunc) (sensor Sensor, err error) {
	if err = nilPredict(predict); err != nil {
		return
	}
	if err = f.lock(); err != nil {
		return
	}
	defer f.unlock()
	c := newCall()
	defer c.free()
	x := (*struct {
		custom C.cairn_custom
		sensor C.int32_t
	})(unsafe.Pointer(&c.room))
	custom.toC(&x.custom)
	user := cgo.NewHandle(&model{f.callbacks, int(custom.Rows), predict, place})
	status := C.go_cairn_filter_add_custom(f.ptr, &x.custom, C.uintptr_t(user), hasPlace(place), &x.sensor, &c.error)
	if status != C.CAIRN_OK {
		user.Delete()
	}
	if err = f.check(c, int32(status)); err != nil {
		return
	}
	return Sensor(x.sensor), nil
}

// SetLog sets the receiver of this filter's log lines (refused batches, numerical refusals). nil, the default: no log.
// The callback runs inside calls of the filter and must not call the same filter. release gets payload when the log is
// replaced or the filter is destroyed. If this call fails, payload stays the caller's.
//
// Errors: ErrArgument.
//
// In Go, nil ends the log.
//
//cairn:doc cairn_filter_set_log
func (f *Filter) SetLog(log LogFunc) (err error) {
	if err = f.lock(); err != nil {
		return
	}
	defer f.unlock()
	c := newCall()
	defer c.free()
	if log == nil {
		return f.check(c, int32(C.go_cairn_filter_set_log(f.ptr, 0, &c.error)))
	}
	payload := cgo.NewHandle(&logger{f.callbacks, log})
	status := C.go_cairn_filter_set_log(f.ptr, C.uintptr_t(payload), &c.error)
	if status != C.CAIRN_OK {
		payload.Delete()
	}
	return f.check(c, int32(status))
}
