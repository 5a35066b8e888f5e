/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Marks that say what C does not say, for programs that read the headers (docs/api_description.md). For a C compiler
 *  they are empty.
 *
 *  A parameter or field without marks means what C says: a value, a handle, a `const` array of fixed length, a
 *  function. A pointer to a `const` struct that begins with `struct_size` is one input. */
#ifndef CAIRN_DESCRIBE_H
#define CAIRN_DESCRIBE_H

/* Comments stand above the macros: Doxygen would take one behind a macro for a comment on each use of it. */

#ifdef CAIRN_DESCRIBE
#define CAIRN_MARK(text) __attribute__((annotate(text)))
#else
/** Any of the marks below: an annotation if CAIRN_DESCRIBE is defined, otherwise nothing. */
#define CAIRN_MARK(text)
#endif

/** Points to one value that the function reads. */
#define CAIRN_IN CAIRN_MARK("in")
/** Points to one value, or the array, that the function writes. */
#define CAIRN_OUT CAIRN_MARK("out")
/** Points to one value that the function reads and writes. */
#define CAIRN_INOUT CAIRN_MARK("inout")

/** Points to an array that the function reads. Its length is an expression of other parameters, or of fields of a
 *  struct: `3 * count`, `cairn_custom.rows`. */
#define CAIRN_IN_ARRAY(...) CAIRN_MARK("in") CAIRN_MARK("length=" #__VA_ARGS__)

/** Points to an array that the function writes. With the length `capacity` it writes as many elements as the expression
 *  gives with `*needed` for `capacity`. */
#define CAIRN_OUT_ARRAY(...) CAIRN_MARK("out") CAIRN_MARK("length=" #__VA_ARGS__)

/** May be NULL. */
#define CAIRN_OPTIONAL CAIRN_MARK("optional")

/** Unit of a double: SI units, `1` for a plain number, `pose` for the error [dp; dtheta] of a pose (m, rad), `sensor`
 *  for the units of a sensor's values. */
#define CAIRN_UNIT(...) CAIRN_MARK("unit=" #__VA_ARGS__)

/** Values that are allowed, as conditions: `> 0`, or `> 0, <= 1`. */
#define CAIRN_RANGE(...) CAIRN_MARK("range=" #__VA_ARGS__)

/** The result belongs to this parameter and lives as long as it; `library`: it lives for ever; `thread`: until the next
 *  call of this thread that fails. */
#define CAIRN_BORROWED(owner) CAIRN_MARK("borrowed=" #owner)

/** The constants of a type. */
#define CAIRN_VALUES(type) CAIRN_MARK("values=" #type)
/** The bits of a type, each a constant. */
#define CAIRN_BITS(type) CAIRN_MARK("bits=" #type)

#endif
