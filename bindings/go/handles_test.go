// SPDX-License-Identifier: BSD-3-Clause

package cairn_test

import (
	"cairn"
	"errors"
	"fmt"
	"math"
	"os"
	"runtime"
	"strconv"
	"strings"
	"sync"
	"testing"
)

func newFilter(t testing.TB, change func(options *cairn.FilterOptions)) *cairn.Filter {
	t.Helper()
	options := cairn.DefaultFilterOptions()
	if change != nil {
		change(&options)
	}
	filter, err := cairn.NewFilter(options)
	if err != nil {
		t.Fatal(err)
	}
	return filter
}

func small(options *cairn.FilterOptions) {
	options.MaxLandmarks = 20
	options.MaxObservations = 8
}

func cartesian(t testing.TB, filter *cairn.Filter) cairn.Sensor {
	t.Helper()
	sensor, err := filter.AddCartesian(cairn.DefaultCartesian())
	if err != nil {
		t.Fatal(err)
	}
	return sensor
}

// expect fails unless the error has this status and a message that contains this text.
func expect(t *testing.T, err error, status cairn.Status, text string) {
	t.Helper()
	var why *cairn.Error
	if !errors.As(err, &why) || why.Status != status || !errors.Is(err, status) || !strings.Contains(why.Message, text) {
		t.Errorf("%v (%v) with %q is expected, and %v came", status, status.Name(), text, err)
	}
}

func TestErrors(t *testing.T) {
	filter := newFilter(t, small)
	defer filter.Close()
	err := filter.PredictWheels(-1, 0, 0)
	expect(t, err, cairn.ErrArgument, "dt must be > 0, and is -1")
	if errors.Is(err, cairn.ErrNotFound) || err.Error() != "cairn: dt must be > 0, and is -1" {
		t.Error(err)
	}
	if _, err := filter.Map().Landmark(math.MaxUint64 - 1); err == nil {
		t.Error("the map has no such landmark")
	} else {
		expect(t, err, cairn.ErrNotFound, "18446744073709551614") // all 64 bits of an id
	}
	_, _, err = filter.Submap(-1)
	expect(t, err, cairn.ErrArgument, "index must not be negative, and is -1")
	_, err = filter.UpdateLinear([]float64{1, 2}, []float64{1, 0, 1}, nil, nil, nil)
	expect(t, err, cairn.ErrArgument, "covariance must have 4 values, and has 3")
	err = filter.UpdateInto(cartesian(t, filter), make([]cairn.Observation, 2), make([]cairn.Match, 1))
	expect(t, err, cairn.ErrArgument, "matches must have 2 values, and has 1")
	_, err = cairn.NewFilter(cairn.FilterOptions{})
	expect(t, err, cairn.ErrArgument, "") // a struct without its defaults
}

func TestIDs(t *testing.T) {
	filter := newFilter(t, small)
	defer filter.Close()
	sensor := cartesian(t, filter)
	const id = math.MaxUint64 - 1 // beyond 2^53, and beyond int64
	matches, err := filter.Update(sensor, []cairn.Observation{{ID: id, Z: [3]float64{1, 2, 3}}})
	if err != nil || matches[0].Landmark != id || matches[0].Result != cairn.ResultNew {
		t.Error(matches, err)
	}
	_, err = filter.Update(sensor, []cairn.Observation{{ID: cairn.IDNone}})
	if err == nil || cairn.NoID() != cairn.IDNone {
		t.Error("no landmark has this id", err)
	}
}

func TestClosed(t *testing.T) {
	filter := newFilter(t, small)
	sensor, lent := cartesian(t, filter), filter.Map()
	kept, err := lent.Copy()
	if err != nil {
		t.Fatal(err)
	}
	for i := 0; i < 2; i++ {
		if err := filter.Close(); err != nil {
			t.Error(err)
		}
	}
	_, err = filter.Update(sensor, make([]cairn.Observation, 1))
	expect(t, err, cairn.ErrState, "the filter is closed")
	_, _, err = filter.Pose()
	expect(t, err, cairn.ErrState, "the filter is closed")
	_, err = lent.Landmarks()
	expect(t, err, cairn.ErrState, "the filter is closed")
	_, err = filter.Map().Copy()
	expect(t, err, cairn.ErrState, "the filter is closed")
	expect(t, filter.SetLog(nil), cairn.ErrState, "the filter is closed")
	if size, err := kept.Size(); err != nil || size != 0 {
		t.Error(size, err) // a copy outlives its filter
	}
	_, err = kept.Merge(lent, nil)
	expect(t, err, cairn.ErrState, "the filter is closed")
	if err := kept.Close(); err != nil {
		t.Error(err)
	}
	_, err = kept.Size()
	expect(t, err, cairn.ErrState, "the map is closed")
}

// Each goroutine has a filter of its own, and all calls fail at once: each message must be of its own call.
func TestMessagesOfGoroutines(t *testing.T) {
	const goroutines, rounds = 16, 2000
	var wait sync.WaitGroup
	wrong := make([]int, goroutines)
	for g := 0; g < goroutines; g++ {
		wait.Add(1)
		go func(g int) {
			defer wait.Done()
			filter := newFilter(t, small)
			defer filter.Close()
			for i := 0; i < rounds; i++ {
				dt := -float64(1 + g*rounds + i)
				err := filter.PredictWheels(dt, 0, 0)
				if err == nil || err.Error() != fmt.Sprintf("cairn: dt must be > 0, and is %g", dt) {
					wrong[g]++
				}
				if i%64 == 0 {
					runtime.Gosched()
				}
			}
		}(g)
	}
	wait.Wait()
	for g, count := range wrong {
		if count > 0 {
			t.Errorf("%d of %d messages of goroutine %d are not its own", count, rounds, g)
		}
	}
}

// Several goroutines on one filter: changes wait for each other, queries run beside each other.
func TestGoroutinesOnOneFilter(t *testing.T) {
	filter := newFilter(t, nil)
	defer filter.Close()
	sensor := cartesian(t, filter)
	const goroutines, rounds = 8, 50
	var wait sync.WaitGroup
	for g := 0; g < goroutines; g++ {
		wait.Add(2)
		go func(g int) {
			defer wait.Done()
			for i := 0; i < rounds; i++ {
				observation := cairn.Observation{ID: uint64(g + 1), Z: [3]float64{float64(g), 1, 1}}
				if _, err := filter.Update(sensor, []cairn.Observation{observation}); err != nil {
					t.Error(err)
				}
			}
		}(g)
		go func() {
			defer wait.Done()
			for i := 0; i < rounds; i++ {
				if _, _, err := filter.Pose(); err != nil {
					t.Error(err)
				}
				if _, err := filter.Map().Landmarks(); err != nil {
					t.Error(err)
				}
			}
		}()
	}
	wait.Wait()
	for g := 0; g < goroutines; g++ {
		if landmark, err := filter.Map().Landmark(uint64(g + 1)); err != nil || landmark.Observations != rounds {
			t.Error(landmark, err)
		}
	}
}

// Merges in opposite directions must not wait for each other for ever.
func TestMergesOfGoroutines(t *testing.T) {
	var maps [2]*cairn.Map
	for i := range maps {
		filter := newFilter(t, small)
		cartesian(t, filter)
		var err error
		if maps[i], err = filter.Map().Copy(); err != nil {
			t.Fatal(err)
		}
	}
	var wait sync.WaitGroup
	for i := range maps {
		wait.Add(1)
		go func(i int) {
			defer wait.Done()
			for round := 0; round < 1000; round++ {
				if _, err := maps[i].Merge(maps[1-i], nil); !errors.Is(err, cairn.ErrNotFound) {
					t.Error(err)
				}
			}
		}(i)
	}
	wait.Wait()
	_, err := maps[0].Merge(maps[0], nil)
	expect(t, err, cairn.ErrArgument, "")
}

func TestNamesOfConstants(t *testing.T) {
	for text, value := range map[string]fmt.Stringer{"JoinSparse": cairn.JoinSparse, "Join(77)": cairn.Join(77),
		"DoubtNIS|DoubtJump": cairn.DoubtNIS | cairn.DoubtJump, "Doubts(0)": cairn.Doubts(0), "ErrState": cairn.ErrState} {
		if value.String() != text {
			t.Errorf("%s is expected, and %s came", text, value)
		}
	}
}

// residentKiB is the memory of the process that is in use, or 0 where the system does not say.
func residentKiB() int {
	text, _ := os.ReadFile("/proc/self/status")
	for _, line := range strings.Split(string(text), "\n") {
		if fields := strings.Fields(line); len(fields) == 3 && fields[0] == "VmRSS:" {
			kib, _ := strconv.Atoi(fields[1])
			return kib
		}
	}
	return 0
}

// 10,000 filters, each with a custom sensor, a log and a copy of the map. (TestRelease shows that the garbage collector
// destroys what was not closed.)
func TestMemory(t *testing.T) {
	if testing.Short() {
		t.Skip("the memory of the process says nothing under the race detector")
	}
	never := func(cairn.Pose, [3]float64, []float64, []float64, []float64) (bool, error) { return false, nil }
	create := func(count int) {
		for i := 0; i < count; i++ {
			filter := newFilter(t, small)
			if _, err := filter.AddCustom(cairn.DefaultCustom(), never, nil); err != nil {
				t.Fatal(err)
			}
			if err := filter.SetLog(func(string) {}); err != nil {
				t.Fatal(err)
			}
			copied, err := filter.Map().Copy()
			if err != nil {
				t.Fatal(err)
			}
			filter.Close()
			copied.Close()
		}
		runtime.GC()
	}
	create(2000)
	before := residentKiB()
	create(10000)
	report := t.Logf
	grown := residentKiB() - before
	if before == 0 || grown > 4096 {
		report = t.Errorf
	}
	report("10,000 filters: memory has grown by %d KiB from %d KiB", grown, before)
}
