/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Statuses of calls, and the message of the last failure. */
#ifndef CAIRN_STATUS_H
#define CAIRN_STATUS_H

#include <cairn/export.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Result of every fallible call: 0 is success, a negative value an error (one of the CAIRN_ERROR_ constants).
 *  A refused observation is not an error: its \ref cairn_match reports the refusal. */
typedef int32_t cairn_status;

/** Values of \ref cairn_status. A value never changes its meaning. */
enum {
  CAIRN_OK = 0,               /**< success */
  CAIRN_ERROR_ARGUMENT = -1,  /**< an argument is NULL, not finite, out of range or not a covariance */
  CAIRN_ERROR_BUFFER = -2,    /**< the caller's buffer is too short; `*needed` holds the size that is necessary */
  CAIRN_ERROR_CAPACITY = -3,  /**< a capacity set at creation is exhausted (landmarks, observations, sensors) */
  CAIRN_ERROR_NOT_FOUND = -4, /**< no landmark, sensor or vehicle has this id */
  CAIRN_ERROR_NUMERICAL = -5, /**< a covariance would lose positive definiteness, or a result is not finite */
  CAIRN_ERROR_MEMORY = -6,    /**< there is not enough memory */
  CAIRN_ERROR_STATE = -7,     /**< the handle is in a state that does not allow this call */
  CAIRN_ERROR_INTERNAL = -8,  /**< a defect of the library; please report it */
  CAIRN_ERROR_CALLBACK = -9   /**< a callback of the caller returned a negative value and so aborted the call */
};

/** Name of a status, for example "CAIRN_ERROR_ARGUMENT"; "unknown status" for any other value. Never NULL.
 *  Threads: any. \since 0.1.0 */
CAIRN_API const char *cairn_status_name(cairn_status status);

/** One line about the last call of this thread that failed: the argument or variable, the cause, the remedy.
 *  The line is empty before the first failure and stays until the next failure. Never NULL. The library owns the
 * buffer; each thread has its own. Threads: any. \since 0.1.0 */
CAIRN_API const char *cairn_last_message(void);

/** Version of the loaded library, for example "0.1.0". Threads: any. \since 0.1.0 */
CAIRN_API const char *cairn_version(void);

/** Instruction set that the loaded library was compiled for: "x86-64" or "x86-64-v3" (on other machines: "generic").
 *  Threads: any. \since 0.1.0 */
CAIRN_API const char *cairn_build(void);

#ifdef __cplusplus
}
#endif

#endif
