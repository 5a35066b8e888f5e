//go:build !cairn_nosim

// SPDX-License-Identifier: BSD-3-Clause

package cairn_test

import (
	"cairn"
	"errors"
	"reflect"
	"runtime"
	"sync"
	"testing"
	"time"
)

// scene is a filter with a sensor whose model a test can change between calls.
type scene struct {
	filter  *cairn.Filter
	sensor  cairn.Sensor
	predict cairn.PredictFunc
}

func newScene(t *testing.T) *scene {
	s := &scene{filter: newFilter(t, small), predict: predictBodyPoint}
	var err error
	s.sensor, err = s.filter.AddCustom(cairn.DefaultCustom(), func(pose cairn.Pose, landmark [3]float64, z, jacobianPose,
		jacobianLandmark []float64) (bool, error) {
		return s.predict(pose, landmark, z, jacobianPose, jacobianLandmark)
	}, placeBodyPoint)
	if err != nil {
		t.Fatal(err)
	}
	s.update(t)
	return s
}

var seen = []cairn.Observation{{ID: 1, Z: [3]float64{3, 1, 0}}, {ID: 2, Z: [3]float64{4, -1, 1}}}

func (s *scene) update(t *testing.T) []cairn.Match {
	t.Helper()
	matches, err := s.filter.Update(s.sensor, seen)
	if err != nil {
		t.Fatal(err)
	}
	return matches
}

// state is all that a user can see of the filter.
func (s *scene) state(t *testing.T) []any {
	t.Helper()
	pose, covariance, err := s.filter.Pose()
	if err != nil {
		t.Fatal(err)
	}
	landmarks, err := s.filter.Map().Landmarks()
	if err != nil {
		t.Fatal(err)
	}
	joint, err := s.filter.JointCovariance([]uint64{1, 2})
	if err != nil {
		t.Fatal(err)
	}
	report, err := s.filter.LastUpdate()
	if err != nil {
		t.Fatal(err)
	}
	report.AssociationSeconds = 0
	return []any{pose, covariance, landmarks, joint, report}
}

// aborted lets the second call of the model do something, and expects the filter to be as before, now and later.
func aborted(t *testing.T, model func(s *scene) (bool, error), check func(s *scene, update func() error)) {
	t.Helper()
	s, twin := newScene(t), newScene(t)
	defer s.filter.Close()
	defer twin.filter.Close()
	before := s.state(t)
	calls := 0
	s.predict = func(pose cairn.Pose, landmark [3]float64, z, jPose, jLandmark []float64) (bool, error) {
		if calls++; calls == 2 {
			return model(s)
		}
		return predictBodyPoint(pose, landmark, z, jPose, jLandmark)
	}
	check(s, func() error {
		_, err := s.filter.Update(s.sensor, seen)
		return err
	})
	if calls != 2 {
		t.Errorf("the model was called %d times", calls)
	}
	if !reflect.DeepEqual(s.state(t), before) {
		t.Error("the filter is not as before")
	}
	s.predict = predictBodyPoint
	if !reflect.DeepEqual(s.update(t), twin.update(t)) || !reflect.DeepEqual(s.state(t), twin.state(t)) {
		t.Error("the filter goes on in another way than one whose call was never aborted")
	}
}

func TestErrorOfCallback(t *testing.T) {
	own := errors.New("the lens is dirty")
	aborted(t, func(*scene) (bool, error) { return false, own }, func(s *scene, update func() error) {
		err := update()
		expect(t, err, cairn.ErrCallback, "")
		if !errors.Is(err, own) {
			t.Errorf("%v does not wrap the model's error", err)
		}
	})
}

func TestPanicOfCallback(t *testing.T) {
	type value struct{ number int }
	aborted(t, func(*scene) (bool, error) { panic(value{7}) }, func(s *scene, update func() error) {
		defer func() {
			if got := recover(); got != (value{7}) {
				t.Errorf("the model's panic is expected, and %v came", got)
			}
		}()
		err := update()
		t.Errorf("the call returned %v", err)
	})
}

func TestCallbackUsesItsFilter(t *testing.T) {
	aborted(t, func(s *scene) (bool, error) {
		_, _, err := s.filter.Pose()
		expect(t, err, cairn.ErrState, "a callback must not use the filter that runs it")
		expect(t, s.filter.Close(), cairn.ErrState, "a callback must not use the filter that runs it")
		return false, err
	}, func(s *scene, update func() error) { expect(t, update(), cairn.ErrCallback, "") })
}

// Another goroutine that uses the filter during a callback waits.
func TestGoroutineWaitsForCallback(t *testing.T) {
	s := newScene(t)
	defer s.filter.Close()
	var wait sync.WaitGroup
	started := false
	s.predict = func(pose cairn.Pose, landmark [3]float64, z, jPose, jLandmark []float64) (bool, error) {
		if !started {
			started = true
			wait.Add(1)
			go func() {
				defer wait.Done()
				if _, _, err := s.filter.Pose(); err != nil {
					t.Error(err)
				}
			}()
			time.Sleep(20 * time.Millisecond)
		}
		return predictBodyPoint(pose, landmark, z, jPose, jLandmark)
	}
	s.update(t)
	wait.Wait()
}

func TestGoroutineEndsInCallback(t *testing.T) {
	s := newScene(t)
	s.predict = func(cairn.Pose, [3]float64, []float64, []float64, []float64) (bool, error) {
		runtime.Goexit()
		return false, nil
	}
	done := make(chan bool)
	go func() {
		defer close(done)
		s.filter.Update(s.sensor, seen)
	}()
	<-done
	_, _, err := s.filter.Pose()
	expect(t, err, cairn.ErrState, "ended its goroutine")
	expect(t, s.filter.Close(), cairn.ErrState, "ended its goroutine")
}

func TestLog(t *testing.T) {
	s := newScene(t)
	defer s.filter.Close()
	var lines []string
	if err := s.filter.SetLog(func(line string) { lines = append(lines, line) }); err != nil {
		t.Fatal(err)
	}
	s.provoke(t)
	if len(lines) == 0 {
		t.Fatal("the filter has no log")
	}
	if err := s.filter.SetLog(func(string) { panic("full") }); err != nil {
		t.Fatal(err)
	}
	func() {
		defer func() {
			if got := recover(); got != "full" {
				t.Errorf("the log's panic is expected, and %v came", got)
			}
		}()
		s.provoke(t)
	}()
	count := len(lines)
	if err := s.filter.SetLog(nil); err != nil {
		t.Fatal(err)
	}
	s.provoke(t)
	if len(lines) != count {
		t.Error("a log that was taken away gets lines")
	}
}

// provoke makes the library write a line: observations that pass their own gates and fail together.
func (s *scene) provoke(t *testing.T) {
	t.Helper()
	s.filter.UpdatePosition([3]float64{1e6, 0, 0}, [9]float64{1, 0, 0, 0, 1, 0, 0, 0, 1}, nil)
}

// The functions of a filter are freed with it, whether it was closed or nothing refers to it: the library calls release.
func TestRelease(t *testing.T) {
	t.Run("closed", func(t *testing.T) { release(t, (*cairn.Filter).Close) })
	t.Run("collected", func(t *testing.T) { release(t, func(*cairn.Filter) error { return nil }) })
}

func release(t *testing.T, end func(*cairn.Filter) error) {
	freed := make(chan bool, 3)
	func() {
		filter := newFilter(t, small)
		type large struct{ data [1 << 16]byte }
		for i := 0; i < 3; i++ {
			object := new(large)
			runtime.SetFinalizer(object, func(*large) { freed <- true })
			var err error
			switch i {
			case 0:
				_, err = filter.AddCustom(cairn.DefaultCustom(), func(cairn.Pose, [3]float64, []float64, []float64,
					[]float64) (bool, error) {
					return object.data[0] > 0, nil
				}, nil)
			case 1:
				err = filter.SetLog(func(string) { object.data[0] = 1 })
			case 2: // a call that fails keeps nothing
				custom := cairn.DefaultCustom()
				custom.Rows = 9
				_, failed := filter.AddCustom(custom, func(cairn.Pose, [3]float64, []float64, []float64,
					[]float64) (bool, error) {
					return object.data[0] > 0, nil
				}, nil)
				expect(t, failed, cairn.ErrArgument, "rows")
			}
			if err != nil {
				t.Fatal(err)
			}
		}
		if err := end(filter); err != nil {
			t.Fatal(err)
		}
	}()
	count := 0
	for tries := 0; count < 3 && tries < 500; tries++ {
		runtime.GC()
		select {
		case <-freed:
			count++
		case <-time.After(10 * time.Millisecond):
		}
	}
	if count != 3 {
		t.Errorf("%d of 3 functions are freed", count)
	}
}

func TestCustomCheck(t *testing.T) {
	custom, pose := cairn.DefaultCustom(), cairn.Pose{Quaternion: [4]float64{1, 0, 0, 0}}
	worst, err := cairn.CustomCheck(custom, predictBodyPoint, placeBodyPoint, pose, [3]float64{3, 2, 1})
	if err != nil || worst > 1e-6 {
		t.Error(worst, err)
	}
	_, err = cairn.CustomCheck(custom, nil, nil, pose, [3]float64{3, 2, 1})
	expect(t, err, cairn.ErrArgument, "predict must not be nil")
	defer func() {
		if got := recover(); got != "broken" {
			t.Error(got)
		}
	}()
	cairn.CustomCheck(custom, func(cairn.Pose, [3]float64, []float64, []float64, []float64) (bool, error) {
		panic("broken")
	}, nil, pose, [3]float64{3, 2, 1})
}
