/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  The whole library. */
/** \mainpage Cairn
 *  Landmark SLAM behind a C ABI: a vehicle that can tell how it moved and where it saw some landmarks calls it, from
 *  any language, and gets its pose, a map, and how far to trust both.
 *
 *  \section rules Rules that hold for every function
 *  - **Units** are SI, angles radians. **Frames**: right-handed, body x forward, y left, z up; the map frame is the one
 *    that the initial pose is given in.
 *  - **Errors**: a negative \ref cairn_status; \ref cairn_last_message tells the rest. A call that fails leaves its
 *    handle as it was, bit for bit, and writes no output but `*needed`.
 *  - **Threads**: a handle serves one thread at a time ("one a handle"); different handles are independent ("any");
 *    calls that take a const handle may run side by side as long as none that changes it runs.
 *  - **Matrices** are row-major `double`.
 *  - **Same inputs, same build, same bits out**: nothing reads a clock, the environment or global state.
 *  - **Memory** is taken when a filter is created. After it, predictions and updates that succeed allocate nothing;
 *    a failure allocates its exception, and queries of arrays their indices.
 *  - **Options** start with their `struct_size`, 8 to 65536. Callers and libraries of different age agree on the smaller
 *    size: what an older caller leaves out has its default, what a newer one adds is ignored (and zeroed by `_init`).
 *    Fields named `reserved` are not read. */
#ifndef CAIRN_CAIRN_H
#define CAIRN_CAIRN_H

#include <cairn/filter.h>
#include <cairn/map.h>
#include <cairn/motion.h>
#include <cairn/pose.h>
#include <cairn/sensor.h>
#include <cairn/status.h>
#include <cairn/team.h>

#endif
