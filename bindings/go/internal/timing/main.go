// SPDX-License-Identifier: BSD-3-Clause

// Timing compares an update in Go with the same update in C. Two filters drive the same simulated mission side by side:
// one by the package, one by the C functions; each measures its own updates. It prints the medians over all frames.
package main

/*
#cgo pkg-config: cairn
#define _POSIX_C_SOURCE 199309L
#include <cairn/cairn.h>
#include <time.h>

// Returns the seconds of an update in C, or -1.
static double timed_update(cairn_filter *filter, int32_t sensor, const cairn_observation *observations, size_t count,
                           cairn_match *matches) {
  cairn_error error = {sizeof error, CAIRN_OK, ""};
  struct timespec before, after;
  clock_gettime(CLOCK_MONOTONIC, &before);
  cairn_status status = cairn_filter_update(filter, sensor, observations, count, matches, &error);
  clock_gettime(CLOCK_MONOTONIC, &after);
  if (status != CAIRN_OK) return -1;
  return (double)(after.tv_sec - before.tv_sec) + 1e-9 * (double)(after.tv_nsec - before.tv_nsec);
}

// Returns the seconds of `count` predictions in C, or -1.
static double timed_predictions(cairn_filter *filter, int count) {
  const double velocity[3] = {1, 0, 0}, rate[3] = {0, 0, 0};
  cairn_error error = {sizeof error, CAIRN_OK, ""};
  struct timespec before, after;
  clock_gettime(CLOCK_MONOTONIC, &before);
  for (int i = 0; i < count; ++i)
    if (cairn_filter_predict_twist(filter, 0.01, velocity, rate, &error) != CAIRN_OK) return -1;
  clock_gettime(CLOCK_MONOTONIC, &after);
  return (double)(after.tv_sec - before.tv_sec) + 1e-9 * (double)(after.tv_nsec - before.tv_nsec);
}

static int32_t timed_filter(uint32_t max_observations, const cairn_pose *start, cairn_filter **filter) {
  cairn_filter_options options;
  cairn_stereo_head head;
  int32_t sensor = -1;
  cairn_filter_options_init(&options, sizeof options, NULL);
  options.submap_landmarks = 60;
  options.max_observations = max_observations;
  options.initial_pose = *start;
  cairn_stereo_head_init(&head, sizeof head, NULL);
  if (cairn_filter_create(&options, filter, NULL) == CAIRN_OK)
    cairn_filter_add_stereo_head(*filter, &head, &sensor, NULL);
  return sensor;
}
*/
import "C"

import (
	"cairn"
	"fmt"
	"os"
	"sort"
	"testing"
	"time"
	"unsafe"
)

const rounds = 11

// most is the time that an update in Go may take over C, in microseconds.
const most = 1.0

func fatal(err error) {
	if err != nil {
		fmt.Fprintln(os.Stderr, err)
		os.Exit(1)
	}
}

func median(values []float64) float64 {
	sort.Float64s(values)
	return values[len(values)/2]
}

type frame struct {
	motions      []cairn.WorldMotion
	observations []cairn.Observation
}

func main() {
	options := cairn.DefaultWorldOptions()
	options.Seed = 3
	world, err := cairn.NewWorld(options)
	fatal(err)
	start, err := world.Pose(0)
	fatal(err)
	observations, err := world.MostObservations()
	fatal(err)
	steps, err := world.Steps()
	fatal(err)
	frames := make([]frame, steps)
	for i := range frames {
		_, err = world.Next()
		fatal(err)
		frames[i].motions, err = world.Motions()
		fatal(err)
		frames[i].observations, err = world.Observations()
		fatal(err)
	}
	matches := [2][]cairn.Match{make([]cairn.Match, observations), make([]cairn.Match, observations)}
	var all [2][][]float64
	for language := range all {
		all[language] = make([][]float64, steps)
	}
	for round := 0; round < rounds; round++ {
		filterOptions := cairn.DefaultFilterOptions()
		filterOptions.SubmapLandmarks, filterOptions.MaxObservations, filterOptions.InitialPose = 60, uint32(observations), start
		filter, err := cairn.NewFilter(filterOptions)
		fatal(err)
		sensor, err := filter.AddStereoHead(cairn.DefaultStereoHead())
		fatal(err)
		var inC *C.cairn_filter
		C.timed_filter(C.uint32_t(observations), (*C.cairn_pose)(unsafe.Pointer(&start)), &inC)
		for i, f := range frames {
			for j := range f.motions {
				motion := &f.motions[j]
				fatal(filter.PredictTwist(motion.Dt, motion.Velocity, motion.Rate))
				C.cairn_filter_predict_twist(inC, C.double(motion.Dt), (*C.double)(unsafe.Pointer(&motion.Velocity[0])),
					(*C.double)(unsafe.Pointer(&motion.Rate[0])), nil)
			}
			if len(f.observations) == 0 {
				continue
			}
			for turn := 0; turn < 2; turn++ {
				language := (round + i + turn) % 2 // who begins changes with each frame
				var seconds float64
				if language == 0 {
					seconds = float64(C.timed_update(inC, C.int32_t(sensor),
						(*C.cairn_observation)(unsafe.Pointer(&f.observations[0])), C.size_t(len(f.observations)),
						(*C.cairn_match)(unsafe.Pointer(&matches[0][0]))))
				} else {
					before := time.Now()
					err = filter.UpdateInto(sensor, f.observations, matches[1][:len(f.observations)])
					seconds = time.Since(before).Seconds()
					fatal(err)
				}
				all[language][i] = append(all[language][i], seconds)
			}
			for k := range f.observations {
				if matches[0][k] != matches[1][k] {
					fatal(fmt.Errorf("frame %d: C %v, Go %v", i, matches[0][k], matches[1][k]))
				}
			}
		}
		C.cairn_filter_destroy(inC)
		fatal(filter.Close())
	}
	var both, over []float64
	for i := range frames {
		if len(all[0][i]) > 0 {
			c, g := median(all[0][i]), median(all[1][i])
			both, over = append(both, c), append(over, g-c)
		}
	}
	result, c := median(over)*1e6, median(both)*1e6
	fmt.Printf("an update in C: %.2f us (median of %d frames); in Go %.2f us more (%.1f %%)\n", c, len(over), result,
		100*result/c)

	filter, err := cairn.NewFilter(cairn.DefaultFilterOptions())
	fatal(err)
	sensor, err := filter.AddStereoHead(cairn.DefaultStereoHead())
	fatal(err)
	over = over[:0]
	var inC *C.cairn_filter
	C.timed_filter(1, (*C.cairn_pose)(unsafe.Pointer(&start)), &inC)
	const predictions = 1000
	for round := 0; round < 21; round++ {
		c := float64(C.timed_predictions(inC, predictions))
		before := time.Now()
		for i := 0; i < predictions; i++ {
			fatal(filter.PredictTwist(0.01, [3]float64{1, 0, 0}, [3]float64{}))
		}
		over = append(over, (time.Since(before).Seconds()-c)/predictions*1e6)
	}
	C.cairn_filter_destroy(inC)
	sort.Float64s(over)
	call := over[0]
	fmt.Printf("a prediction in Go takes %.2f us more than in C (median %.2f): the cost of a call\n", call, median(over))
	one := []cairn.Observation{{ID: 1, Z: [3]float64{5, 0.1, 0}}}
	allocations := testing.AllocsPerRun(1000, func() {
		fatal(filter.PredictTwist(0.01, [3]float64{1, 0, 0}, [3]float64{}))
		fatal(filter.UpdateInto(sensor, one, matches[0][:1]))
		_, _, err := filter.Pose()
		fatal(err)
	})
	fmt.Printf("allocations of PredictTwist, UpdateInto and Pose together: %g\n", allocations)
	// Ten times what is allowed: this fails if the way into C is another one, not if the machine is busy.
	if result > 10*most || call > 10*most || allocations > 0 {
		fatal(fmt.Errorf("at most %g us and no allocations are allowed", most))
	}
}
