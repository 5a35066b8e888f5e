//go:build !cairn_nosim

// SPDX-License-Identifier: BSD-3-Clause

package cairn_test

import (
	"cairn"
	"errors"
	"math"
	"reflect"
)

// The callbacks of the conformance scenarios. Each product is rounded by its own conversion, so that no machine fuses it
// with an addition.

var errAbort = errors.New("the model aborts")

func rotation(pose cairn.Pose) (R [3][3]float64) {
	w, x, y, z := pose.Quaternion[0], pose.Quaternion[1], pose.Quaternion[2], pose.Quaternion[3]
	one := func(a, b, c, d float64) float64 { return 1 - float64(2*(float64(a*b)+float64(c*d))) }
	sum := func(a, b, c, d float64) float64 { return float64(2 * (float64(a*b) + float64(c*d))) }
	difference := func(a, b, c, d float64) float64 { return float64(2 * (float64(a*b) - float64(c*d))) }
	return [3][3]float64{
		{one(y, y, z, z), difference(x, y, w, z), sum(x, z, w, y)},
		{sum(x, y, w, z), one(x, x, z, z), difference(y, z, w, x)},
		{difference(x, z, w, y), sum(y, z, w, x), one(x, x, y, y)},
	}
}

func offset(pose cairn.Pose, landmark [3]float64) (d [3]float64) {
	for i := range d {
		d[i] = landmark[i] - pose.Position[i]
	}
	return d
}

func dot(a, b [3]float64) float64 {
	return float64(a[0]*b[0]) + float64(a[1]*b[1]) + float64(a[2]*b[2])
}

func column(R [3][3]float64, i int) [3]float64 { return [3]float64{R[0][i], R[1][i], R[2][i]} }

func predictBodyPoint(pose cairn.Pose, landmark [3]float64, z, jacobianPose, jacobianLandmark []float64) (bool, error) {
	R, d := rotation(pose), offset(pose, landmark)
	for i := range z {
		c := column(R, i)
		z[i] = dot(c, d)
		copy(jacobianPose[6*i:], []float64{-c[0], -c[1], -c[2], float64(c[1]*d[2]) - float64(c[2]*d[1]),
			float64(c[2]*d[0]) - float64(c[0]*d[2]), float64(c[0]*d[1]) - float64(c[1]*d[0])})
		copy(jacobianLandmark[3*i:], c[:])
	}
	return true, nil
}

func placeBodyPoint(pose cairn.Pose, z, landmark, jacobianPose, jacobianZ []float64) (bool, error) {
	R := rotation(pose)
	var whole, c [3]float64
	copy(whole[:], z)
	for i := range c {
		c[i] = dot(R[i], whole)
		landmark[i] = pose.Position[i] + c[i]
		copy(jacobianZ[len(z)*i:], R[i][:len(z)])
	}
	copy(jacobianPose, []float64{1, 0, 0, 0, c[2], -c[1], 0, 1, 0, -c[2], 0, c[0], 0, 0, 1, c[1], -c[0], 0})
	return true, nil
}

var predictors = map[string]cairn.PredictFunc{
	"body_point": predictBodyPoint,
	"body_point_ahead": func(pose cairn.Pose, landmark [3]float64, z, jPose, jLandmark []float64) (bool, error) {
		switch ahead := dot(column(rotation(pose), 0), offset(pose, landmark)); {
		case ahead < -5:
			return false, errAbort
		case ahead < 0:
			return false, nil
		}
		return predictBodyPoint(pose, landmark, z, jPose, jLandmark)
	},
	"range_only": func(pose cairn.Pose, landmark [3]float64, z, jPose, jLandmark []float64) (bool, error) {
		d := offset(pose, landmark)
		r := math.Sqrt(dot(d, d))
		if r < 0.1 {
			return false, nil
		}
		z[0] = r
		copy(jPose, []float64{-(d[0] / r), -(d[1] / r), -(d[2] / r), 0, 0, 0})
		copy(jLandmark, []float64{d[0] / r, d[1] / r, d[2] / r})
		return true, nil
	},
	"wrong_jacobian": func(pose cairn.Pose, landmark [3]float64, z, jPose, jLandmark []float64) (bool, error) {
		seen, err := predictBodyPoint(pose, landmark, z, jPose, jLandmark)
		jLandmark[0] += 0.5
		return seen, err
	},
	"unfinished": func(pose cairn.Pose, landmark [3]float64, z, jPose, jLandmark []float64) (bool, error) {
		seen, err := predictBodyPoint(pose, landmark, z, jPose, jLandmark)
		jPose[0] = math.NaN()
		return seen, err
	},
	"refusing": func(cairn.Pose, [3]float64, []float64, []float64, []float64) (bool, error) { return false, nil },
	"aborting": func(cairn.Pose, [3]float64, []float64, []float64, []float64) (bool, error) { return false, errAbort },
}

var placers = map[string]cairn.PlaceFunc{
	"body_point": placeBodyPoint,
	"refusing":   func(cairn.Pose, []float64, []float64, []float64, []float64) (bool, error) { return false, nil },
	"aborting":   func(cairn.Pose, []float64, []float64, []float64, []float64) (bool, error) { return false, errAbort },
}

// callback returns the function of this name and type.
func (r *replay) callback(name string, kind reflect.Type) any {
	found := reflect.ValueOf(nil)
	switch kind {
	case reflect.TypeOf(cairn.PredictFunc(nil)):
		found = reflect.ValueOf(predictors[name])
	case reflect.TypeOf(cairn.PlaceFunc(nil)):
		found = reflect.ValueOf(placers[name])
	case reflect.TypeOf(cairn.LogFunc(nil)):
		if name == "collect" {
			found = reflect.ValueOf(cairn.LogFunc(func(line string) { r.lines = append(r.lines, line) }))
		}
	}
	if !found.IsValid() || found.IsNil() {
		panic("there is no callback " + name)
	}
	return found.Interface()
}
