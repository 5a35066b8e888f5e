/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  What a call returns, and the sentence that goes with it. */
#ifndef CAIRN_STATUS_H
#define CAIRN_STATUS_H

#include <cairn/export.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Result of every fallible call: 0 is success, a negative value an error (one of the CAIRN_ERROR_ constants).
 *  An observation that was refused is no error: it is reported in its \ref cairn_match. */
typedef int32_t cairn_status;

/** Values of \ref cairn_status. They are pinned: a value never changes its meaning. */
enum {
  CAIRN_OK = 0,               /**< the call did what it says */
  CAIRN_ERROR_ARGUMENT = -1,  /**< an argument is NULL, not finite, out of range or not a covariance */
  CAIRN_ERROR_BUFFER = -2,    /**< the caller's buffer is too short; the size that it takes is in `*needed` */
  CAIRN_ERROR_CAPACITY = -3,  /**< a capacity given at creation is exhausted (landmarks, observations, sensors) */
  CAIRN_ERROR_NOT_FOUND = -4, /**< no landmark or sensor has that id */
  CAIRN_ERROR_NUMERICAL = -5, /**< a covariance would lose positive definiteness, or a result is not finite */
  CAIRN_ERROR_MEMORY = -6,    /**< memory could not be had */
  CAIRN_ERROR_STATE = -7,     /**< the call does not fit what the handle is now */
  CAIRN_ERROR_INTERNAL = -8   /**< a defect of the library: please report it */
};

/** Name of a status, "CAIRN_ERROR_ARGUMENT" for one; "unknown status" for a value that is none. Never NULL.
 *  Threads: any. \since 0.1.0 */
CAIRN_API const char *cairn_status_name(cairn_status status);

/** One line on the last call of this thread that failed: the argument or variable, the cause, the remedy.
 *  It is empty before the first failure, and stays until the next one. Never NULL; the buffer is the library's, one a
 *  thread. Threads: any. \since 0.1.0 */
CAIRN_API const char *cairn_last_message(void);

/** Version of the library that was loaded, "0.1.0" for one. Threads: any. \since 0.1.0 */
CAIRN_API const char *cairn_version(void);

/** Instruction set that the loaded library was compiled for: "x86-64" or "x86-64-v3" (on other machines: "generic").
 *  Threads: any. \since 0.1.0 */
CAIRN_API const char *cairn_build(void);

#ifdef __cplusplus
}
#endif

#endif
