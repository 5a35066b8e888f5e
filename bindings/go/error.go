// SPDX-License-Identifier: BSD-3-Clause

package cairn

import (
	"fmt"
	"strings"
)

// Error says why a call failed. The call has changed nothing.
//
//	if errors.Is(err, cairn.ErrNotFound) { ... }  // a status is an error, too
type Error struct {
	Status  Status // what the library returned
	Message string // one line of the library: the argument or variable, the cause, the remedy

	cause error
}

func (e *Error) Error() string { return "cairn: " + e.Message }

// Is reports whether target is the status of the error.
func (e *Error) Is(target error) bool {
	status, ok := target.(Status)
	return ok && status == e.Status
}

// Unwrap returns the error of the callback that aborted the call, or nil.
func (e *Error) Unwrap() error { return e.cause }

// Error makes a status an error that [errors.Is] finds in an [*Error].
func (s Status) Error() string { return "cairn: " + s.Name() }

type named[T any] struct {
	value T
	name  string
}

func valueName[T ~int32 | ~uint32](kind string, value T, all []named[T]) string {
	for _, constant := range all {
		if constant.value == value {
			return constant.name
		}
	}
	return fmt.Sprintf("%s(%d)", kind, value)
}

func bitsName[T ~int32 | ~uint32](kind string, value T, all []named[T]) string {
	var names []string
	for _, constant := range all {
		if value&constant.value != 0 {
			names = append(names, constant.name)
			value &^= constant.value
		}
	}
	if value != 0 || names == nil {
		names = append(names, fmt.Sprintf("%s(%d)", kind, value))
	}
	return strings.Join(names, "|")
}
