/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Includes all headers of libcairn. */
/** \page rules Rules for every function
 *  - **Units** are SI units; angles are in radians. **Frames** are right-handed. The body frame has x forward, y left,
 *    z up. The map frame is the frame of the initial pose.
 *  - **Errors**: a call that fails returns a negative \ref cairn_status, and fills in the caller's \ref cairn_error, if
 *    it gave one. Texts that the library returns or takes are UTF-8. A call that fails leaves its handle as it was, bit
 *    for bit, and writes no output except `*needed` and the error.
 *  - **Threads**: "one a handle" means that one thread at a time may use the handle. "any" means that any number of
 *    threads may call the function at the same time. "as any const query of the handle" means that several threads may
 *    call such functions on one handle at the same time, as long as no call changes this handle meanwhile.
 *  - **Complexity** is O(1) where a function does not say otherwise.
 *  - **Matrices** are row-major arrays of `double`.
 *  - **The same inputs and the same build give the same bits.** No estimate and no decision depends on a clock, the
 *    environment or global state. A clock is read only to report durations: fields named `seconds` or `..._seconds`
 *    differ from run to run.
 *  - **Memory** is taken when a filter is created. After that, predictions and updates that succeed allocate nothing.
 *    A call that fails allocates its exception. Queries that fill arrays allocate their indices.
 *  - **Options** start with their `struct_size`, 8 to 65536. Caller and library may be of different age: the library
 *    uses the smaller of both sizes. Fields that an older caller does not have get their defaults. Fields that a newer
 *    caller adds must be zero, as `_init` leaves them: a byte that the library does not know and that is not zero is
 *    refused by name, and so is a field named `reserved` that is not zero. In reports such fields are outputs and are
 *    not read.
 *  - **Types**: each set of constants has a type of its own (\ref cairn_join and its CAIRN_JOIN_ constants), which
 *    fields and parameters use. A \ref cairn_bool is 0 or 1. No public struct holds a pointer or hidden padding; sizes
 *    and offsets are the same on all supported machines.
 *  - **Arrays**: the caller gives a buffer and its capacity, and `*needed` gets the number of elements. A buffer that
 *    is too short gives CAIRN_ERROR_BUFFER. Capacity 0 asks for the number, with any pointer.
 *  - **Callbacks** return 1 for an answer, 0 for none, and a negative value to abort the whole call, which then changes
 *    nothing. The library calls \ref cairn_release_fn when it does not use the caller's pointer any more. */
#ifndef CAIRN_CAIRN_H
#define CAIRN_CAIRN_H

#include <cairn/filter.h>
#include <cairn/health.h>
#include <cairn/map.h>
#include <cairn/motion.h>
#include <cairn/pose.h>
#include <cairn/sensor.h>
#include <cairn/status.h>
#include <cairn/systematic.h>
#include <cairn/team.h>
#include <cairn/trajectory.h>

#endif
