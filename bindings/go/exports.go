// SPDX-License-Identifier: BSD-3-Clause

package cairn

/*
#include <cairn/cairn.h>
*/
import "C"

import (
	"runtime/cgo"
	"unsafe"
)

// The functions that bridge.c calls. A file with exports may hold no code of C.

//export cairnGoPredict
func cairnGoPredict(user C.uintptr_t, pose *C.cairn_pose, landmark, z, jacobianPose, jacobianLandmark *C.double) C.int32_t {
	m := cgo.Handle(user).Value().(*model)
	return m.callbacks.run(func() (bool, error) {
		return m.predict(*(*Pose)(unsafe.Pointer(pose)), *(*[3]float64)(unsafe.Pointer(landmark)), doubles(z, m.rows),
			doubles(jacobianPose, 6*m.rows), doubles(jacobianLandmark, 3*m.rows))
	})
}

//export cairnGoPlace
func cairnGoPlace(user C.uintptr_t, pose *C.cairn_pose, z, landmark, jacobianPose, jacobianZ *C.double) C.int32_t {
	m := cgo.Handle(user).Value().(*model)
	return m.callbacks.run(func() (bool, error) {
		return m.place(*(*Pose)(unsafe.Pointer(pose)), doubles(z, m.rows), doubles(landmark, 3), doubles(jacobianPose, 18),
			doubles(jacobianZ, 3*m.rows))
	})
}

//export cairnGoLog
func cairnGoLog(payload C.uintptr_t, line *C.char) {
	l := cgo.Handle(payload).Value().(*logger)
	l.callbacks.run(func() (bool, error) {
		l.log(C.GoString(line))
		return true, nil
	})
}

//export cairnGoRelease
func cairnGoRelease(user C.uintptr_t) { cgo.Handle(user).Delete() }
