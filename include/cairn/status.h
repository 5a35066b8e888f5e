/* SPDX-License-Identifier: BSD-3-Clause */
/** \file
 *  Statuses and errors of calls, the boolean type, and the version of the library. */
#ifndef CAIRN_STATUS_H
#define CAIRN_STATUS_H

#include <cairn/describe.h>
#include <cairn/export.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Status of every fallible call: 0 is success, a negative value an error. A value never changes its meaning. A refused
 *  observation is not an error: its \ref cairn_match reports the refusal. */
typedef int32_t cairn_status;
enum CAIRN_VALUES(cairn_status) {
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

/** A yes or no: 1 or 0. Any other value is refused. */
typedef int32_t cairn_bool;

/** Why a call failed. It belongs to the caller: `cairn_error error = {sizeof error};`. Every fallible call takes one as
 *  its last parameter, or NULL. A call that fails fills it in. A call that succeeds leaves it as it is. A message that
 *  is longer than the struct is cut between two characters. */
typedef struct cairn_error {
  uint32_t struct_size; /**< sizeof(cairn_error) of the caller; set it before the call */
  cairn_status status;  /**< what the call returned */
  char message[504];    /**< one line of UTF-8, ended by a zero: the argument or variable, the cause, the remedy */
} cairn_error;

/** Receives a pointer of the caller that the library does not use any more: the end of a callback's `user` or
 *  `payload`. It runs once, in the thread of the call that ends the use. It must not call the library. */
typedef void (*cairn_release_fn)(void *user);

/** Name of a status, for example "CAIRN_ERROR_ARGUMENT"; "unknown status" for any other value. Never NULL.
 *  Threads: any. \since 0.1.0 */
CAIRN_API CAIRN_BORROWED(library) const char *cairn_status_name(cairn_status status);

/** The message of the last call of this thread that failed, for programs in C: the line that \ref cairn_error would
 *  have got, in UTF-8. It is empty before the first failure and stays until the next failure. Never NULL. The library
 *  owns the buffer; each thread has its own. A language whose runtime moves calls between threads passes a cairn_error
 *  instead. Threads: any. \since 0.1.0 */
CAIRN_API CAIRN_BORROWED(thread) const char *cairn_last_message(void);

/** Version of the loaded library, for example "0.2.0". Threads: any. \since 0.1.0 */
CAIRN_API CAIRN_BORROWED(library) const char *cairn_version(void);

/** Version of the loaded library as a number, as CAIRN_VERSION is that of the header: 10000 major + 100 minor + patch.
 *  Threads: any. \since 0.2.0 */
CAIRN_API uint32_t cairn_version_number(void);

/** Whether the loaded library has a feature: 1 or 0. Features have names that never change their meaning: "sparse"
 *  (sparse joining), "teams", "trajectory", "systematic" (estimated systematic errors), "robust" (robust losses),
 *  "health" (verdicts), "errors" (messages in a \ref cairn_error). NULL and any other name: 0. Threads: any.
 *  \since 0.2.0 */
CAIRN_API cairn_bool cairn_has(CAIRN_OPTIONAL const char *feature);

/** Instruction set that the loaded library was compiled for: "x86-64" or "x86-64-v3" (on other machines: "generic").
 *  Threads: any. \since 0.1.0 */
CAIRN_API CAIRN_BORROWED(library) const char *cairn_build(void);

#ifdef __cplusplus
}
#endif

#endif
