// SPDX-License-Identifier: BSD-3-Clause

package cairn

import (
	"fmt"
	"runtime"
	"sync"
	"sync/atomic"
)

// handle is what all handles of the library have in common: a lock, and an end. It refers to nothing that refers to it,
// so that its finalizer runs.
type handle struct {
	lockOf    sync.RWMutex // the library allows one change at a time, or several queries
	kind      string
	number    uint64 // the order in which a call locks several handles
	destroy   func() // nil: destroyed
	callbacks *callbacks
}

var handles uint64

func newHandle(kind string, callbacks *callbacks, destroy func()) *handle {
	h := &handle{kind: kind, number: atomic.AddUint64(&handles, 1), destroy: destroy, callbacks: callbacks}
	runtime.SetFinalizer(h, func(h *handle) { h.end() })
	return h
}

func (h *handle) end() {
	if h.destroy != nil {
		h.destroy()
		h.destroy = nil
	}
}

// close destroys the handle; a second time it does nothing.
func (h *handle) close() error {
	if err := h.wait(h.lockOf.TryLock, h.lockOf.Lock); err != nil {
		return err
	}
	defer h.lockOf.Unlock()
	if h.callbacks.abandoned() {
		return h.unusable() // a call has not ended in C and never will: its memory is lost
	}
	h.end()
	runtime.SetFinalizer(h, nil)
	return nil
}

// lock begins a change, rlock a query. Both fail where the handle is closed, or runs a callback of this goroutine.
func (h *handle) lock() error {
	if err := h.wait(h.lockOf.TryLock, h.lockOf.Lock); err != nil {
		return err
	}
	if h.destroy == nil || h.callbacks.abandoned() {
		defer h.lockOf.Unlock()
		return h.unusable()
	}
	return nil
}

func (h *handle) unlock() { h.lockOf.Unlock() }

func (h *handle) rlock() error {
	if err := h.wait(h.lockOf.TryRLock, h.lockOf.RLock); err != nil {
		return err
	}
	if h.destroy == nil || h.callbacks.abandoned() {
		defer h.lockOf.RUnlock()
		return h.unusable()
	}
	return nil
}

func (h *handle) runlock() { h.lockOf.RUnlock() }

func (h *handle) wait(try func() bool, lock func()) error {
	if try() {
		return nil
	}
	if h.callbacks.running() && insideCallback() {
		return &Error{Status: ErrState, Message: fmt.Sprintf("a callback must not use the %s that runs it", h.kind)}
	}
	lock()
	return nil
}

func (h *handle) unusable() error {
	if h.destroy == nil {
		return &Error{Status: ErrState, Message: fmt.Sprintf("the %s is closed", h.kind)}
	}
	return &Error{Status: ErrState, Message: fmt.Sprintf("a callback of the %s ended its goroutine in the middle of a call",
		h.kind)}
}

// check makes a Go error of what a change returned. A panic of a callback goes on here.
func (h *handle) check(c *call, status int32) error {
	if status == int32(OK) && !h.callbacks.failed() {
		return nil
	}
	return h.callbacks.settle(c.check(status))
}
